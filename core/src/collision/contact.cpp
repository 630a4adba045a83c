#include "plumbline/core/collision/contact.hpp"

#include <stdexcept>
#include <type_traits>

#include "plumbline/core/collision/contact_manifold.hpp"
#include "plumbline/core/collision/time_of_impact.hpp"

namespace plumbline {
namespace {

std::string describe(const Body& body) { return std::string(shape_name(body.shape)) + " '" + body.name + "'"; }

void refuse_cylinder(const Body& body) {
  if (!std::holds_alternative<Cylinder>(body.shape)) return;
  throw std::invalid_argument("the contact of " + describe(body) + " cannot be computed: of solids only spheres and " +
                              "boxes; take a sphere of the same radius and moments of inertia where that will do");
}

// In the order of Pair: spheres, boxes, half-spaces.
bool comes_after(const Body& a, const Body& b) { return a.shape.index() > b.shape.index(); }
static_assert(std::is_same_v<Shape, std::variant<Sphere, Box, HalfSpace, Cylinder>>);

bool is_half_space(const Body& body) { return std::holds_alternative<HalfSpace>(body.shape); }

}  // namespace

Contact sphere_sphere_contact(const BodyState& a, double radius_a, const BodyState& b, double radius_b) {
  Contact contact;
  const Vec3 d = a.p_WB - b.p_WB;
  const double distance = d.norm();
  if (distance != 0) contact.normal_W = d / distance;
  contact.gap = distance - (radius_a + radius_b);
  contact.point_W = b.p_WB + (radius_b + 0.5 * contact.gap) * contact.normal_W;
  return contact;
}

Contact sphere_half_space_contact(const BodyState& sphere, double radius, const BodyState& half_space,
                                  const Vec3& normal_W) {
  Contact contact;
  contact.normal_W = normal_W;
  contact.gap = normal_W.dot(sphere.p_WB - half_space.p_WB) - radius;
  contact.point_W = sphere.p_WB - radius * normal_W;
  return contact;
}

Contact sphere_box_contact(const BodyState& sphere, double radius, const BodyState& box, const Vec3& size) {
  const Mat3 axes = box.q_WB.toRotationMatrix();
  const Vec3 half = 0.5 * size, centre = axes.transpose() * (sphere.p_WB - box.p_WB);
  const Vec3 nearest = centre.cwiseMax(-half).cwiseMin(half);
  Vec3 normal = centre - nearest;
  double distance = normal.norm();  // of the centre from the surface
  if (distance != 0) {
    normal /= distance;
  } else {
    int axis = 0;
    distance = -(half - centre.cwiseAbs()).minCoeff(&axis);
    normal = Vec3::Unit(axis) * (centre(axis) < 0 ? -1 : 1);
  }
  Contact contact;
  contact.normal_W = axes * normal;
  contact.gap = distance - radius;
  contact.point_W = sphere.p_WB - (radius + 0.5 * contact.gap) * contact.normal_W;
  return contact;
}

std::array<Contact, 8> box_half_space_contacts(const BodyState& box, const Vec3& size, const BodyState& half_space,
                                               const Vec3& normal_W) {
  std::array<Contact, 8> contacts;
  for (int k = 0; k < 8; ++k) {
    Contact& contact = contacts[static_cast<std::size_t>(k)];
    contact.normal_W = normal_W;
    contact.point_W = box.p_WB + box.q_WB * box_corner(size, k);
    contact.gap = normal_W.dot(contact.point_W - half_space.p_WB);
  }
  return contacts;
}

std::vector<Pair> contact_pairs(std::span<const Body> bodies) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (std::size_t j = i + 1; j < bodies.size(); ++j) {
      if (bodies[i].fixed && bodies[j].fixed) continue;
      refuse_cylinder(bodies[i]);
      refuse_cylinder(bodies[j]);
      if (is_half_space(bodies[i]) && is_half_space(bodies[j])) {
        throw std::invalid_argument("the contact of " + describe(bodies[i]) + " with " + describe(bodies[j]) +
                                    " cannot be computed: half-spaces never move; make both fixed");
      }
      pairs.push_back(comes_after(bodies[i], bodies[j]) ? Pair{j, i} : Pair{i, j});
    }
  }
  return pairs;
}

void append_contacts(std::span<const Body> bodies, std::span<const BodyState> states, Pair pair,
                     std::vector<Contact>& contacts) {
  const Shape &shape_a = bodies[pair.a].shape, &shape_b = bodies[pair.b].shape;
  const BodyState &a = states[pair.a], &b = states[pair.b];
  const std::size_t first = contacts.size();
  if (const auto* half = std::get_if<HalfSpace>(&shape_b)) {
    if (const auto* box = std::get_if<Box>(&shape_a)) {
      const auto corners = box_half_space_contacts(a, box->size, b, half->normal);
      contacts.insert(contacts.end(), corners.begin(), corners.end());
    } else {
      contacts.push_back(sphere_half_space_contact(a, std::get<Sphere>(shape_a).radius, b, half->normal));
    }
  } else if (const auto* box_b = std::get_if<Box>(&shape_b)) {
    if (const auto* box_a = std::get_if<Box>(&shape_a)) {
      const auto corners = box_box_contacts(a, box_a->size, b, box_b->size);
      contacts.insert(contacts.end(), corners.begin(), corners.end());
    } else {
      contacts.push_back(sphere_box_contact(a, std::get<Sphere>(shape_a).radius, b, box_b->size));
    }
  } else {
    contacts.push_back(sphere_sphere_contact(a, std::get<Sphere>(shape_a).radius, b, std::get<Sphere>(shape_b).radius));
  }
  for (std::size_t k = first; k < contacts.size(); ++k) {
    contacts[k].body_a = pair.a;
    contacts[k].body_b = pair.b;
  }
}

Vec3 point_velocity(const BodyState& state, const Vec3& point_W) {
  return state.v_WB + state.w_WB.cross(point_W - state.p_WB);
}

Vec3 contact_velocity(const Contact& contact, std::span<const BodyState> states) {
  return point_velocity(states[contact.body_a], contact.point_W) -
         point_velocity(states[contact.body_b], contact.point_W);
}

double approach_speed(const Contact& contact, std::span<const BodyState> states) {
  return -contact.normal_W.dot(contact_velocity(contact, states));
}

}  // namespace plumbline
