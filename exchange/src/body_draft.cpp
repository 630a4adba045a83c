#include "body_draft.hpp"

#include <algorithm>
#include <cmath>

#include "plumbline/core/mass/principal_axes.hpp"

namespace plumbline {
namespace {

// Rounding of a tensor that was turned to and fro, and of decimals in a file, is far smaller; a tensor that is meant
// not to be diagonal is far from it.
constexpr double kDiagonal = 1e-9;
constexpr double kCentred = 1e-9;  // of a shape's own size

double size_of(const Shape& shape) {
  if (const auto* sphere = std::get_if<Sphere>(&shape)) return sphere->radius;
  if (const auto* box = std::get_if<Box>(&shape)) return box->size.maxCoeff();
  if (const auto* cylinder = std::get_if<Cylinder>(&shape)) return std::max(cylinder->radius, cylinder->height);
  return 1;
}

std::string told(const DraftShape& shape) {
  return shape.name.empty() ? shape.kind : shape.kind + " '" + shape.name + "'";
}

// What is left of a tensor in a frame that lies along its principal axes.
std::optional<Vec3> diagonal(const Mat3& inertia_W, const Quat& q_WF) {
  const Mat3 r = q_WF.toRotationMatrix();
  const Mat3 turned = r.transpose() * inertia_W * r;
  const double off = std::max({std::abs(turned(0, 1)), std::abs(turned(0, 2)), std::abs(turned(1, 2))});
  if (!(off <= kDiagonal * turned.trace())) return std::nullopt;
  return Vec3(turned.diagonal());
}

class MovingBody {
 public:
  MovingBody(const DraftLink& link, bool touches, ImportedWorld& world)
      : link_(link), touches_(touches), world_(world) {}

  std::optional<Body> make() {
    if (!(link_.mass > 0)) {
      lose("has no mass: it cannot move by itself; give it one, or tie it to its neighbour in the file");
      return std::nullopt;
    }
    Body body{link_.name, Sphere{1}, false, link_.mass, Vec3::Zero(), {}};
    body.initial = {link_.com.p_WF, link_.com.q_WF, link_.v_W, link_.w_W};
    const DraftShape* shape = chosen();
    // Along the shape where that is possible: only then can it collide as it should.
    const Quat preferred = shape != nullptr ? shape->at.q_WF : link_.com.q_WF;
    for (const Quat& axes : {preferred, link_.com.q_WF}) {
      const auto moments = diagonal(link_.inertia_com_W, axes);
      if (!moments) continue;
      body.inertia = *moments;
      body.initial.q_WB = axes;
      break;
    }
    if (body.inertia.isZero(0) && !turn_to_principal_axes(body)) return std::nullopt;
    if (body.inertia.minCoeff() <= 0) {
      lose("has a moment of inertia of 0; every moment must be > 0");
      return std::nullopt;
    }
    place(shape, body);
    return body;
  }

 private:
  void lose(const std::string& what) { world_.losses.push_back("link '" + link_.name + "' " + what); }
  void note(const std::string& what) { world_.notes.push_back("link '" + link_.name + "' " + what); }

  bool turn_to_principal_axes(Body& body) {
    const Mat3 r = link_.com.q_WF.toRotationMatrix();
    try {
      const PrincipalAxes axes = principal_axes(r.transpose() * link_.inertia_com_W * r);
      body.inertia = axes.moments;
      body.initial.q_WB = (link_.com.q_WF * axes.q_FB).normalized();
    } catch (const std::invalid_argument& e) {
      lose(std::string("has an inertia that no body has: ") + e.what());
      return false;
    }
    note("has products of inertia: its frame is turned to the principal axes");
    return true;
  }

  // The shape that collides, or the first that is drawn.
  const DraftShape* chosen() {
    const DraftShape* found = nullptr;
    for (const DraftShape& shape : link_.shapes) {
      if (shape.collides && !shape.shape && touches_) {
        lose("collides with a shape that scenarios do not have, " + told(shape) +
             ": put a sphere, box or cylinder in its place");
        collides_otherwise_ = true;
        continue;
      }
      if (!shape.shape || std::holds_alternative<HalfSpace>(*shape.shape)) {
        if (shape.collides && touches_) {
          lose("carries a plane; only what stands still may be a half_space");
          collides_otherwise_ = true;
        }
        continue;
      }
      if (found == nullptr) {
        found = &shape;
      } else if (shape.collides && found->collides && touches_) {
        lose("collides with several shapes; a body has one: " + told(shape) + " is left out");
      } else if (shape.collides && !found->collides) {
        found = &shape;
      }
    }
    return found;
  }

  void place(const DraftShape* shape, Body& body) {
    const bool needed = shape != nullptr && shape->collides && touches_;
    // In a scenario with contact every body collides.
    if (touches_ && !collides_otherwise_ && (shape == nullptr || !shape->collides)) {
      lose(
          "does not collide with anything, but in a scenario all bodies do: give it a shape, or remove the shapes of "
          "the others");
    }
    if (shape == nullptr) {
      body.shape = Sphere{std::sqrt(2.5 * body.inertia.mean() / body.mass)};
      if (!touches_) note("has no shape: it is drawn as a sphere of about its inertia");
      return;
    }
    body.shape = *shape->shape;
    const double off = (shape->at.p_WF - body.initial.p_WB).norm();
    if (off > kCentred * size_of(body.shape)) {
      const std::string text = "has its " + told(*shape) + " " + shortest(off) + " m away from the centre of mass; ";
      if (needed) {
        lose(text + "a scenario's shapes are centred in it: move the one or the other");
      } else {
        note(text + "nothing collides, so it is drawn there");
      }
    }
    const bool along =
        geodesic_angle(body.initial.q_WB, shape->at.q_WF) < kCentred || std::holds_alternative<Sphere>(body.shape);
    if (!along && needed) lose("has its " + told(*shape) + " out of line with the principal axes of its inertia");
  }

  const DraftLink& link_;
  bool touches_;
  bool collides_otherwise_ = false;  // with what was refused already
  ImportedWorld& world_;
};

}  // namespace

std::string NameList::take(const std::string& wished) {
  static const std::set<std::string, std::less<>> kReserved = {"world", "kind",     "uncertainty", "citation",
                                                               "let",   "solution", "row"};
  const std::string base = wished.empty() ? "body" : wished;
  std::string name = base;
  for (int k = 2; kReserved.contains(name) || taken_.contains(name); ++k) name = base + "_" + std::to_string(k);
  taken_.insert(name);
  return name;
}

std::vector<Body> bodies_of(const DraftLink& link, bool touches, NameList& names, ImportedWorld& world) {
  std::vector<Body> bodies;
  const auto name = [&](const std::string& wished) {
    std::string taken = names.take(wished);
    if (taken != wished) world.notes.push_back("'" + wished + "' is called '" + taken + "': names are unique");
    return taken;
  };
  if (!link.fixed) {
    if (auto body = MovingBody(link, touches, world).make()) {
      body->name = name(link.name);
      bodies.push_back(std::move(*body));
    }
    return bodies;
  }
  for (const DraftShape& shape : link.shapes) {
    if (!shape.collides) continue;  // scenery
    if (!shape.shape) {
      if (touches) {
        world.losses.push_back("the " + told(shape) + " of '" + link.name +
                               "', which stands still: scenarios have spheres, boxes, cylinders and planes");
      }
      continue;
    }
    const auto colliding = [](const DraftShape& s) { return s.collides; };
    const bool only = std::count_if(link.shapes.begin(), link.shapes.end(), colliding) == 1 && link.name != "world";
    const std::string& own = shape.name.empty() ? shape.kind : shape.name;
    Body body{name(only ? link.name : own), *shape.shape, true, 0, Vec3::Zero(), {}};
    body.initial.p_WB = shape.at.p_WF;
    if (!std::holds_alternative<HalfSpace>(body.shape)) body.initial.q_WB = shape.at.q_WF;
    bodies.push_back(std::move(body));
  }
  return bodies;
}

}  // namespace plumbline
