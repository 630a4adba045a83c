// Contacts: where two bodies touch, and how far they are from it.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "plumbline/core/scenario.hpp"

namespace plumbline {

struct Contact {
  std::size_t body_a = 0, body_b = 0;
  Vec3 point_W = Vec3::Zero();    // [m]
  Vec3 normal_W = Vec3::UnitZ();  // unit, from b to a: pushing a along it and b against it parts them
  double gap = 0;                 // [m]; negative where they overlap
};

// The closest points of two spheres of those radii [m]; the contact point is halfway between them. Spheres with the
// same centre have no direction to part along: the normal is then the z axis.
Contact sphere_sphere_contact(const BodyState& a, double radius_a, const BodyState& b, double radius_b);

// The lowest point of a sphere (body a) above a half-space (body b) whose surface passes through b's position.
Contact sphere_half_space_contact(const BodyState& sphere, double radius, const BodyState& half_space,
                                  const Vec3& normal_W);

// The point of a box (body b) of that size [m] (full edge lengths) nearest to a sphere (body a), halfway between the
// two surfaces. A centre inside the box leaves it through the nearest face.
Contact sphere_box_contact(const BodyState& sphere, double radius, const BodyState& box, const Vec3& size);

// All eight corners of a box (body a) of that size [m] above a half-space (body b). A corner is a contact when its
// gap is within the tolerance of whoever asks: a box that lies has four of them.
std::array<Contact, 8> box_half_space_contacts(const BodyState& box, const Vec3& size, const BodyState& half_space,
                                               const Vec3& normal_W);

// Two bodies that may touch, in the order in which their contacts name them: a sphere before a box, and both before a
// half-space.
struct Pair {
  std::size_t a, b;
};

// All pairs of bodies of which at least one moves. Throws std::invalid_argument, naming the bodies, for two half-spaces
// of which one is not fixed: they have no contact that could be computed.
std::vector<Pair> contact_pairs(std::span<const Body> bodies);

// Appends the contacts of that pair, touching or not (two boxes far apart may have none: contact_manifold.hpp);
// bodies[i] is in states[i].
void append_contacts(std::span<const Body> bodies, std::span<const BodyState> states, Pair pair,
                     std::vector<Contact>& contacts);

// Velocity of the point of a body that is at point_W [m/s].
Vec3 point_velocity(const BodyState& state, const Vec3& point_W);

// Velocity of a's point of contact relative to b's [m/s]. Its part along the normal is negative on approach.
Vec3 contact_velocity(const Contact& contact, std::span<const BodyState> states);

// The rate at which the gap closes [m/s]: positive on approach.
double approach_speed(const Contact& contact, std::span<const BodyState> states);

}  // namespace plumbline
