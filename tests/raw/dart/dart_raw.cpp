// The six cases written directly against DART: what a user of it would write, and nothing else.
//
//   raw_dart ROW CASE PROFILE DT FILE
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dart/collision/ode/OdeCollisionDetector.hpp>
#include <dart/constraint/BoxedLcpConstraintSolver.hpp>
#include <dart/constraint/ContactConstraint.hpp>
#include <dart/constraint/DantzigBoxedLcpSolver.hpp>
#include <dart/constraint/PgsBoxedLcpSolver.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/BoxShape.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/PlaneShape.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/dynamics/SphereShape.hpp>
#include <dart/dynamics/WeldJoint.hpp>
#include <dart/simulation/World.hpp>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace {

using Eigen::Vector3d;
namespace constraint = dart::constraint;
namespace dynamics = dart::dynamics;

struct Request {
  std::string row, name, profile;
  double dt = 0;
  bool matched() const { return profile == "matched"; }
};

class Simulation {
 public:
  explicit Simulation(const Request& request) : request_(request) {
    auto pgs = std::make_shared<constraint::PgsBoxedLcpSolver>();
    auto option = pgs->getOption();
    option.mMaxIteration = request.matched() ? 1000 : 30;
    option.mDeltaXThreshold = request.matched() ? 1e-14 : 1e-6;
    option.mRelativeDeltaXTolerance = request.matched() ? 1e-12 : 1e-3;
    pgs->setOption(option);
    auto dantzig = std::make_shared<constraint::DantzigBoxedLcpSolver>();
    using Solver = constraint::BoxedLcpConstraintSolver;
    world_->setConstraintSolver(request.row == "dart-pgs" ? std::make_unique<Solver>(pgs, nullptr)
                                                          : std::make_unique<Solver>(dantzig, pgs));
    world_->getConstraintSolver()->setCollisionDetector(dart::collision::OdeCollisionDetector::create());
    world_->setGravity(Vector3d::Zero());
    world_->setTimeStep(request.dt);
  }

  void set_gravity(const Vector3d& g) { world_->setGravity(g); }

  dynamics::BodyNode* add_free(const std::string& name, double mass, const Vector3d& moments, const Vector3d& p,
                               const Vector3d& v, const Vector3d& w = Vector3d::Zero()) {
    auto skeleton = dynamics::Skeleton::create(name);
    auto [joint, body] = skeleton->createJointAndBodyNodePair<dynamics::FreeJoint>();
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() = p;
    joint->setTransform(pose);
    joint->setLinearVelocity(v);
    joint->setAngularVelocity(w);
    finish(skeleton, body, mass, moments);
    return body;
  }

  // Hangs from the world by a hinge at the origin; `arm` is the place of the centre of mass.
  void add_hinged(const std::string& name, double mass, const Vector3d& moments, const Vector3d& arm,
                  const Vector3d& axis) {
    auto skeleton = dynamics::Skeleton::create(name);
    auto [joint, body] = skeleton->createJointAndBodyNodePair<dynamics::RevoluteJoint>();
    Eigen::Isometry3d hinge = Eigen::Isometry3d::Identity();
    hinge.translation() = -arm;
    joint->setTransformFromChildBodyNode(hinge);
    joint->setAxis(axis);
    finish(skeleton, body, mass, moments);
  }

  dynamics::BodyNode* add_ground(const std::string& name, const Vector3d& normal) {
    auto skeleton = dynamics::Skeleton::create(name);
    auto [joint, body] = skeleton->createJointAndBodyNodePair<dynamics::WeldJoint>();
    skeleton->setMobile(false);
    skeletons_.push_back(skeleton);
    bodies_.push_back({name, body});
    surface(body, std::make_shared<dynamics::PlaneShape>(normal, 0.0));
    return body;
  }

  void set_contact(double restitution, double friction) {
    restitution_ = restitution;
    friction_ = friction;
  }

  void surface(dynamics::BodyNode* body, const dynamics::ShapePtr& shape) {
    auto* node = body->createShapeNodeWith<dynamics::CollisionAspect, dynamics::DynamicsAspect>(shape);
    // The pair gets the product of both restitutions and the smaller friction.
    node->getDynamicsAspect()->setRestitutionCoeff(std::sqrt(restitution_));
    node->getDynamicsAspect()->setFrictionCoeff(friction_);
    if (request_.matched() && body->getSkeleton()->isMobile()) sliding_.push_back({node, body});
  }

  // `push` is called before every step, on the state at its start.
  int run(double duration, const char* file, const std::function<void()>& push = nullptr) {
    for (const auto& skeleton : skeletons_) world_->addSkeleton(skeleton);
    std::FILE* out = std::fopen(file, "w");
    if (out == nullptr) {
      std::perror(file);
      return 1;
    }
    std::fprintf(out, "t,body,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz\n");
    const int steps = static_cast<int>(std::floor(duration / request_.dt + 1e-9));
    write(out, 0);
    for (int k = 0; k < steps; ++k) {
      if (push) push();
      step();
      write(out, (k + 1) * request_.dt);
    }
    return std::fclose(out) == 0 ? 0 : 1;
  }

 private:
  void finish(const dynamics::SkeletonPtr& skeleton, dynamics::BodyNode* body, double mass, const Vector3d& moments) {
    const Eigen::Matrix3d I = moments.asDiagonal();
    body->setInertia(dynamics::Inertia(mass, Vector3d::Zero(), I));
    skeletons_.push_back(skeleton);
    bodies_.push_back({skeleton->getName(), body});
  }

  void step() {
    using Contact = constraint::ContactConstraint;
    Contact::setErrorReductionParameter(request_.matched() ? 0.2 : 0.01);
    // Matched: a correction never faster than gravity takes back within a step.
    Contact::setMaxErrorReductionVelocity(request_.matched() ? world_->getGravity().norm() * request_.dt : 1e-3);
    Contact::setErrorAllowance(0);
    Contact::setConstraintForceMixing(request_.matched() ? 1e-7 : 1e-5);
    for (auto& [node, body] : sliding_) {
      node->getDynamicsAspect()->setFirstFrictionDirectionFrame(dynamics::Frame::World());
      node->getDynamicsAspect()->setFirstFrictionDirection(body->getLinearVelocity() +
                                                           world_->getGravity() * request_.dt);
    }
    world_->step();
  }

  void write(std::FILE* out, double t) const {
    for (const auto& [name, body] : bodies_) {
      const Eigen::Isometry3d& pose = body->getTransform();
      const Eigen::Quaterniond q(pose.linear());
      const Vector3d p = pose.translation(), v = body->getLinearVelocity(), w = body->getAngularVelocity();
      std::fprintf(out, "%.17g,%s", t, name.c_str());
      for (double x : {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z(), v.x(), v.y(), v.z(), w.x(), w.y(), w.z()}) {
        std::fprintf(out, ",%.17g", x);
      }
      std::fprintf(out, "\n");
    }
  }

  Request request_;
  double restitution_ = 0, friction_ = 0;
  dart::simulation::WorldPtr world_ = dart::simulation::World::create();
  std::vector<dynamics::SkeletonPtr> skeletons_;
  std::vector<std::pair<std::string, dynamics::BodyNode*>> bodies_;
  std::vector<std::pair<dynamics::ShapeNode*, dynamics::BodyNode*>> sliding_;
};

Vector3d box_moments(double m, double a, double b, double c) {
  return m / 12.0 * Vector3d(b * b + c * c, c * c + a * a, a * a + b * b);
}
Vector3d ball_moments(double m, double r) { return Vector3d::Constant(0.4 * m * r * r); }

int falling_box(const Request& request, const char* file) {
  const double m = 1, f = 9.8;
  Simulation s(request);
  auto* box = s.add_free("box", m, box_moments(m, 1, 1, 1), Vector3d(0, 0, 5), Vector3d(2, 1, 3));
  return s.run(2, file, [&] { box->addExtForce(Vector3d(0, 0, -f)); });
}

int drag_ship(const Request& request, const char* file) {
  const double m = 1000, T = 5000, c = 250, g = 9.81;
  Simulation s(request);
  s.set_gravity(Vector3d(0, 0, -g));
  auto* ship = s.add_free("ship", m, box_moments(m, 20, 6, 4), Vector3d::Zero(), Vector3d(30, 0, 0));
  return s.run(m / c, file, [&] { ship->addExtForce(Vector3d(T - c * ship->getLinearVelocity().x(), 0, m * g)); });
}

int two_sphere(const Request& request, const char* file) {
  Simulation s(request);
  s.set_contact(0.5, 0);
  auto* one = s.add_free("one", 2, ball_moments(2, 0.5), Vector3d::Zero(), Vector3d(2, 0, 0));
  auto* two = s.add_free("two", 1, ball_moments(1, 0.3), Vector3d(3.12, 0, 0.48), Vector3d(-1, 0, 0));
  s.surface(one, std::make_shared<dynamics::SphereShape>(0.5));
  s.surface(two, std::make_shared<dynamics::SphereShape>(0.3));
  return s.run(1.5, file);
}

int free_rotation(const Request& request, const char* file) {
  Simulation s(request);
  s.add_free("box", 10, box_moments(10, 0.1, 0.4, 0.9), Vector3d::Zero(), Vector3d::Zero(), Vector3d(0.1, 5, 0.1));
  return s.run(1, file);
}

int pendulum(const Request& request, const char* file) {
  Simulation s(request);
  s.set_gravity(Vector3d(0, 0, -9.81));
  // +y as the z axis of the joint's frame, to the last bit.
  const Vector3d axis = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), Vector3d::UnitY()) * Vector3d::UnitZ();
  s.add_hinged("bob", 1, ball_moments(1, 0.1), Vector3d(1, 0, 0), axis);
  return s.run(2, file);
}

int incline(const Request& request, const char* file) {
  const double g = 9.81, degrees = 20, pi = 3.14159265358979323846, slope = degrees * pi / 180;
  Simulation s(request);
  s.set_gravity(Vector3d(g * std::sin(slope), 0, -g * std::cos(slope)));
  s.set_contact(0, 0.2);
  s.add_ground("ground", Vector3d::UnitZ());
  auto* box = s.add_free("box", 10, box_moments(10, 1, 1, 0.5), Vector3d(0, 0, 0.25), Vector3d::Zero());
  s.surface(box, std::make_shared<dynamics::BoxShape>(Vector3d(1, 1, 0.5)));
  return s.run(2, file);
}

const std::vector<std::pair<std::string, int (*)(const Request&, const char*)>> kCases = {
    {"particle/falling_box", falling_box},
    {"particle/drag_ship/v0=30", drag_ship},
    {"collision/two_sphere/e=0.5,b=0.48", two_sphere},
    {"rotation/free_rotation", free_rotation},
    {"joint/pendulum", pendulum},
    {"friction/incline/mu=0.2", incline},
};

int usage() {
  std::fprintf(
      stderr,
      "usage: raw_dart ROW CASE PROFILE DT FILE\nrows: dart-dantzig dart-pgs\nprofiles: default matched\ncases:\n");
  for (const auto& [name, run] : kCases) std::fprintf(stderr, "  %s\n", name.c_str());
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 6) return usage();
  const Request request = {argv[1], argv[2], argv[3], std::strtod(argv[4], nullptr)};
  if (request.row != "dart-dantzig" && request.row != "dart-pgs") return usage();
  if (request.profile != "default" && request.profile != "matched") return usage();
  if (!(request.dt > 0)) return usage();
  for (const auto& [name, run] : kCases) {
    if (name == request.name) return run(request, argv[5]);
  }
  return usage();
}
