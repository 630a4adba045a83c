#include "plumbline/core/collision/contact.hpp"

#include <stdexcept>

#include "plumbline/core/collision/time_of_impact.hpp"

namespace plumbline {
namespace {

bool is_half_space(const Body& body) { return std::holds_alternative<HalfSpace>(body.shape); }

Pair ordered(std::span<const Body> bodies, std::size_t i, std::size_t j) {
  return is_half_space(bodies[i]) ? Pair{j, i} : Pair{i, j};
}

bool computable(const Body& a, const Body& b) {
  if (is_half_space(b)) return !is_half_space(a);
  return std::holds_alternative<Sphere>(a.shape) && std::holds_alternative<Sphere>(b.shape);
}

std::string describe(const Body& body) { return std::string(shape_name(body.shape)) + " '" + body.name + "'"; }

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
      const Pair pair = ordered(bodies, i, j);
      if (!computable(bodies[pair.a], bodies[pair.b])) {
        throw std::invalid_argument("the in-house core cannot compute the contact of " + describe(bodies[i]) +
                                    " with " + describe(bodies[j]) +
                                    ": it knows spheres with spheres, and spheres and boxes with half-spaces");
      }
      pairs.push_back(pair);
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
