#include "sdf_links.hpp"

#include <algorithm>
#include <initializer_list>

namespace plumbline {
namespace {

Quat quat(const ignition::math::Quaterniond& q) { return Quat(q.W(), q.X(), q.Y(), q.Z()).normalized(); }

PlacedFrame compose(const PlacedFrame& parent, const ignition::math::Pose3d& pose) {
  return {parent.p_WF + parent.q_WF * vec(pose.Pos()), (parent.q_WF * quat(pose.Rot())).normalized()};
}

// The number at the end of a path of elements, where it is stated.
double stated(sdf::ElementPtr element, std::initializer_list<const char*> path, double otherwise) {
  for (const char* tag : path) {
    if (!element || !element->HasElement(tag)) return otherwise;
    element = element->GetElement(tag);
  }
  return element->Get<double>();
}

DraftShape shape_of(const sdf::Geometry& geometry, const PlacedFrame& at) {
  DraftShape shape;
  shape.at = at;
  switch (geometry.Type()) {
    case sdf::GeometryType::BOX:
      shape.kind = "box";
      shape.shape = Box{vec(geometry.BoxShape()->Size())};
      break;
    case sdf::GeometryType::SPHERE:
      shape.kind = "sphere";
      shape.shape = Sphere{geometry.SphereShape()->Radius()};
      break;
    case sdf::GeometryType::CYLINDER:
      shape.kind = "cylinder";
      shape.shape = Cylinder{geometry.CylinderShape()->Radius(), geometry.CylinderShape()->Length()};
      break;
    case sdf::GeometryType::PLANE:
      shape.kind = "plane";
      shape.shape = HalfSpace{(at.q_WF * vec(geometry.PlaneShape()->Normal())).normalized()};
      break;
    case sdf::GeometryType::MESH:
      shape.kind = "mesh";
      break;
    case sdf::GeometryType::HEIGHTMAP:
      shape.kind = "heightmap";
      break;
    case sdf::GeometryType::CAPSULE:
      shape.kind = "capsule";
      break;
    case sdf::GeometryType::ELLIPSOID:
      shape.kind = "ellipsoid";
      break;
    default:
      shape.kind = "geometry that libsdformat does not know";
  }
  return shape;
}

void read_shapes(const sdf::Link& link, SdfLink& result, DraftLink& draft) {
  for (std::uint64_t i = 0; i < link.CollisionCount(); ++i) {
    const sdf::Collision& collision = *link.CollisionByIndex(i);
    DraftShape shape = shape_of(*collision.Geom(), placed(result.frame, collision.SemanticPose(), collision.RawPose()));
    shape.name = collision.Name();
    const sdf::Surface* const surface = collision.Surface();
    const std::uint16_t mask =
        surface != nullptr && surface->Contact() != nullptr ? surface->Contact()->CollideBitmask() : 0xffff;
    if (result.mask == 0) {
      result.material.friction = stated(collision.Element(), {"surface", "friction", "ode", "mu"}, 1);
      result.material.restitution = stated(collision.Element(), {"surface", "bounce", "restitution_coefficient"}, 0);
    }
    result.mask = static_cast<std::uint16_t>(result.mask | mask);
    shape.collides = mask != 0;
    draft.shapes.push_back(std::move(shape));
  }
  for (std::uint64_t i = 0; i < link.VisualCount(); ++i) {
    const sdf::Visual& visual = *link.VisualByIndex(i);
    DraftShape shape = shape_of(*visual.Geom(), placed(result.frame, visual.SemanticPose(), visual.RawPose()));
    shape.collides = false;
    draft.shapes.push_back(std::move(shape));
  }
}

}  // namespace

Vec3 vec(const ignition::math::Vector3d& v) { return {v.X(), v.Y(), v.Z()}; }

PlacedFrame placed(const PlacedFrame& parent, const sdf::SemanticPose& pose, const ignition::math::Pose3d& raw) {
  ignition::math::Pose3d resolved;
  return compose(parent, pose.Resolve(resolved).empty() ? resolved : raw);
}

SdfLink read_link(const sdf::Link& link, const PlacedFrame& model, bool still, WorldDraft& draft) {
  SdfLink result;
  result.frame = placed(model, link.SemanticPose(), link.RawPose());
  DraftLink body;
  body.name = link.Name();
  body.fixed = still;
  const ignition::math::Inertiald& inertial = link.Inertial();
  body.com = compose(result.frame, inertial.Pose());
  body.mass = inertial.MassMatrix().Mass();
  const ignition::math::Matrix3d moi = inertial.MassMatrix().Moi();
  Mat3 in_frame;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) in_frame(i, j) = moi(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
  }
  const Mat3 axes = body.com.q_WF.toRotationMatrix();
  body.inertia_com_W = axes * in_frame * axes.transpose();
  read_shapes(link, result, body);
  const std::string who = "link '" + body.name + "'";
  if (!still && !link.Element()->HasElement("inertial")) {
    draft.notes.push_back(who + " states no inertia: SDF's default is 1 kg and 1 kg m^2");
  }
  if (!still && stated(link.Element(), {"gravity"}, 1) == 0) draft.losses.push_back(who + " feels no gravity");
  if (link.EnableWind()) draft.losses.push_back(who + " feels the wind");
  for (const char* kind : {"linear", "angular"}) {
    if (stated(link.Element(), {"velocity_decay", kind}, 0) != 0) {
      draft.losses.push_back(who + ": its " + kind + " velocity decays by itself");
    }
  }
  if (link.SensorCount() > 0)
    draft.notes.push_back(who + ": " + std::to_string(link.SensorCount()) + " sensors are left out");
  draft.links.push_back(std::move(body));
  return result;
}

void add_sdf_contacts(const std::vector<SdfLink>& links, WorldDraft& draft) {
  for (std::size_t j = 0; j < links.size(); ++j) {
    for (std::size_t i = 0; i < j; ++i) {
      const SdfLink &a = links[i], &b = links[j];
      if ((a.mask & b.mask) == 0 || (draft.links[i].fixed && draft.links[j].fixed)) continue;
      const bool tied = std::find(a.tied_to.begin(), a.tied_to.end(), j) != a.tied_to.end();
      if (tied || (a.model == b.model && !(a.collides_inside && b.collides_inside))) continue;
      draft.contacts.push_back({i,
                                j,
                                {std::min(a.material.restitution, b.material.restitution),
                                 std::min(a.material.friction, b.material.friction)}});
    }
  }
}

}  // namespace plumbline
