#include "scene.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "expression.hpp"
#include "spelling.hpp"

namespace plumbline {
namespace {

Vec3 direction(const Node& node, const Parameters& constants) {
  const Vec3 v = vector3(node, constants);
  if (!(v.norm() > 0)) fail(node, "must not be the zero vector; [0, 0, 1] points up");
  return v / v.norm();
}

Shape read_shape(const Node& node, const Parameters& constants) {
  static const std::vector<std::string> kShapes = {"sphere", "box", "half_space", "cylinder"};
  static constexpr std::string_view kForms =
      "{ sphere = r }, { box = [x, y, z] }, { cylinder = [r, h] } or { half_space = [nx, ny, nz] }";
  if (as_table(node).entries.size() != 1) fail(node, fmt::format("must name one shape: {}", kForms));
  const Entry& shape = node.entries.front();
  if (shape.key == "sphere") return Sphere{positive_number(shape.value, constants)};
  if (shape.key == "half_space") return HalfSpace{direction(shape.value, constants)};
  if (shape.key == "box") {
    const auto& edges = as_array(shape.value, 3);
    return Box{{positive_number(edges[0], constants), positive_number(edges[1], constants),
                positive_number(edges[2], constants)}};
  }
  if (shape.key == "cylinder") {
    const auto& sizes = as_array(shape.value, 2);
    return Cylinder{positive_number(sizes[0], constants), positive_number(sizes[1], constants)};
  }
  fail(shape.key_place, shape.value.path,
       fmt::format("unknown shape; {}write {}", did_you_mean(shape.key, kShapes), kForms));
}

Quat read_attitude(const Node& node, const Parameters& constants) {
  const auto& c = as_array(node, 4);
  Quat q(number(c[0], constants), number(c[1], constants), number(c[2], constants), number(c[3], constants));
  const double norm = q.norm();
  if (!(norm > 0)) fail(node, "must not be zero; [1, 0, 0, 0] (w, x, y, z) is no rotation");
  q.coeffs() /= norm;
  return q;
}

Vec3 read_inertia(const Node& node, const Parameters& constants) {
  const auto& items = as_array(node, 3);
  const Vec3 moments(positive_number(items[0], constants), positive_number(items[1], constants),
                     positive_number(items[2], constants));
  // I_x = sum of m (y^2 + z^2): each moment is at most the sum of the others, and equal for a flat body.
  if (2 * moments.maxCoeff() > moments.sum() * (1 + 1e-12)) {
    fail(node, "no body has these moments: the largest exceeds the sum of the other two");
  }
  return moments;
}

std::string read_name(const Node& table, const std::vector<Body>& earlier) {
  const Node& node = need(table, "name", "name = \"...\"");
  const std::string& name = as_text(node);
  static const std::vector<std::string> kTaken = {"kind", "uncertainty", "citation", "let", "solution"};
  if (std::find(kTaken.begin(), kTaken.end(), name) != kTaken.end()) {
    fail(node, fmt::format("'{}' is a key of [reference]; choose another name", name));
  }
  if (name == "world") fail(node, "'world' is what joints call the rest frame; choose another name");
  if (std::any_of(earlier.begin(), earlier.end(), [&](const Body& b) { return b.name == name; })) {
    fail(node, fmt::format("the name '{}' is used twice; give each body its own", name));
  }
  return name;
}

Body read_body(const Node& table, const Parameters& constants, const std::vector<Body>& earlier) {
  allow_only(table,
             {"name", "shape", "mass", "inertia", "position", "attitude", "velocity", "angular_velocity", "fixed"});
  Body body{read_name(table, earlier), Sphere{1}, false, 0, Vec3::Zero(), {}};
  body.shape = read_shape(need(table, "shape", "shape = { sphere = 0.5 }"), constants);
  if (const Node* p = find(table, "position")) body.initial.p_WB = vector3(*p, constants);
  if (std::holds_alternative<HalfSpace>(body.shape)) {
    body.fixed = true;
    if (const Node* fixed = find(table, "fixed"); fixed != nullptr && !as_boolean(*fixed)) {
      fail(*fixed, "a half_space is always fixed; remove this line");
    }
    for (const char* key : {"mass", "inertia", "attitude", "velocity", "angular_velocity"}) {
      if (const Node* node = find(table, key)) fail(*node, "a half_space is always fixed; remove this line");
    }
    return body;
  }
  if (const Node* q = find(table, "attitude")) body.initial.q_WB = read_attitude(*q, constants);
  if (const Node* fixed = find(table, "fixed"); fixed != nullptr && as_boolean(*fixed)) {
    body.fixed = true;
    for (const char* key : {"mass", "inertia", "velocity", "angular_velocity"}) {
      if (const Node* node = find(table, key)) fail(*node, "a fixed body never moves; remove this line, or fixed");
    }
    return body;
  }
  body.mass = positive_number(need(table, "mass", "mass = 1.0  # kg"), constants);
  const Node* inertia = find(table, "inertia");
  body.inertia = inertia != nullptr ? read_inertia(*inertia, constants) : solid_inertia(body.shape, body.mass);
  if (const Node* v = find(table, "velocity")) body.initial.v_WB = vector3(*v, constants);
  if (const Node* w = find(table, "angular_velocity")) body.initial.w_WB = vector3(*w, constants);
  return body;
}

}  // namespace

std::vector<Body> read_bodies(const Node& root, const Parameters& constants) {
  std::vector<Body> bodies;
  for (const Node& table : tables(root, "body")) bodies.push_back(read_body(table, constants, bodies));
  if (bodies.empty()) fail(root.place, "/body", "is missing; add a [[body]] with name, shape and mass");
  return bodies;
}

std::optional<ContactMaterial> read_contact(const Node& root, const Parameters& constants) {
  const Node* table = find(root, "contact");
  if (table == nullptr) return std::nullopt;
  allow_only(*table, {"restitution", "friction"});
  const Node& e = need(*table, "restitution", "restitution = 0");
  const Node& mu = need(*table, "friction", "friction = 0");
  const ContactMaterial contact{number(e, constants), number(mu, constants)};
  if (!(contact.restitution >= 0 && contact.restitution <= 1)) {
    fail(e, fmt::format("must be in [0, 1], is {}; 0 is plastic, 1 elastic", shortest(contact.restitution)));
  }
  if (!(contact.friction >= 0)) fail(mu, fmt::format("must be >= 0, is {}", shortest(contact.friction)));
  return contact;
}

std::size_t body_named(const Node& node, const std::vector<Body>& bodies) {
  const std::string& name = as_text(node);
  std::vector<std::string> names;
  for (const Body& body : bodies) {
    if (body.name == name) return names.size();
    names.push_back(body.name);
  }
  fail(node, fmt::format("there is no body '{}'; {}the bodies are: {}", name, did_you_mean(name, names),
                         fmt::join(names, ", ")));
}

}  // namespace plumbline
