#include "plumbline/core/mass/solids.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace plumbline {
namespace {

using std::numbers::pi;

void require_size(bool positive, const char* what) {
  if (!positive) throw std::invalid_argument(std::string(what) + ": sizes must be finite and > 0");
}

bool is_size(double x) { return x > 0 && std::isfinite(x); }

Mat3 about_z(double across, double along) { return Vec3(across, across, along).asDiagonal(); }

struct Volume {
  double operator()(const Sphere& s) const {
    require_size(is_size(s.radius), "sphere");
    return 4.0 / 3.0 * pi * s.radius * s.radius * s.radius;
  }
  double operator()(const Box& b) const {
    require_size(is_size(b.size.x()) && is_size(b.size.y()) && is_size(b.size.z()), "box");
    return b.size.prod();
  }
  double operator()(const Cylinder& c) const {
    require_size(is_size(c.radius) && is_size(c.height), "cylinder");
    return pi * c.radius * c.radius * c.height;
  }
  double operator()(const Capsule& c) const {
    require_size(is_size(c.radius) && (c.length == 0 || is_size(c.length)), "capsule");
    return pi * c.radius * c.radius * (c.length + 4.0 / 3.0 * c.radius);
  }
  double operator()(const Cone& c) const {
    require_size(is_size(c.radius) && is_size(c.height), "cone");
    return pi * c.radius * c.radius * c.height / 3;
  }
};

struct OfMass {
  double mass;

  MassProperties operator()(const Sphere& s) const {
    return {mass, Vec3::Zero(), Mat3(solid_inertia(s, mass).asDiagonal())};
  }
  MassProperties operator()(const Box& b) const {
    return {mass, Vec3::Zero(), Mat3(solid_inertia(b, mass).asDiagonal())};
  }
  MassProperties operator()(const Cylinder& c) const {
    const double r2 = c.radius * c.radius;
    return {mass, Vec3::Zero(), about_z(mass * (3 * r2 + c.height * c.height) / 12, 0.5 * mass * r2)};
  }
  // The cylinder takes the share h/(h + 4r/3) of the mass, the two half spheres the rest, with their own centres
  // of mass h/2 + 3r/8 from the middle.
  MassProperties operator()(const Capsule& c) const {
    const double r = c.radius, r2 = r * r, h = c.length;
    const double balls = mass * (4 * r) / (3 * h + 4 * r), tube = mass * (3 * h) / (3 * h + 4 * r);
    const double away = 0.5 * h + 0.375 * r;
    const double across = tube * (3 * r2 + h * h) / 12 + balls * (83.0 / 320.0 * r2 + away * away);
    return {mass, Vec3::Zero(), about_z(across, 0.5 * tube * r2 + 0.4 * balls * r2)};
  }
  MassProperties operator()(const Cone& c) const {
    const double r2 = c.radius * c.radius;
    return {mass, Vec3(0, 0, 0.25 * c.height),
            about_z(3.0 / 80.0 * mass * (4 * r2 + c.height * c.height), 0.3 * mass * r2)};
  }
};

}  // namespace

double volume(const Solid& solid) { return std::visit(Volume{}, solid); }

MassProperties solid_of_mass(const Solid& solid, double mass) {
  volume(solid);  // refuses sizes that are none
  if (!is_size(mass)) throw std::invalid_argument("the mass of a solid must be finite and > 0");
  return std::visit(OfMass{mass}, solid);
}

MassProperties solid_of_density(const Solid& solid, double density) {
  if (!is_size(density)) throw std::invalid_argument("the density of a solid must be finite and > 0");
  return solid_of_mass(solid, density * volume(solid));
}

}  // namespace plumbline
