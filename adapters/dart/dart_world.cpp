#include "dart_world.hpp"

#include <algorithm>
#include <cmath>
#include <dart/collision/CollisionFilter.hpp>
#include <dart/collision/CollisionResult.hpp>
#include <dart/collision/fcl/FCLCollisionDetector.hpp>
#include <dart/collision/ode/OdeCollisionDetector.hpp>
#include <dart/constraint/BallJointConstraint.hpp>
#include <dart/constraint/BoxedLcpConstraintSolver.hpp>
#include <dart/constraint/ContactConstraint.hpp>
#include <dart/constraint/DantzigBoxedLcpSolver.hpp>
#include <dart/constraint/PgsBoxedLcpSolver.hpp>
#include <dart/constraint/WeldJointConstraint.hpp>
#include <dart/dynamics/BallJoint.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/BoxShape.hpp>
#include <dart/dynamics/CylinderShape.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/PlaneShape.hpp>
#include <dart/dynamics/PrismaticJoint.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/dynamics/SphereShape.hpp>
#include <dart/dynamics/WeldJoint.hpp>
#include <dart/simulation/World.hpp>
#include <stdexcept>

#include "plumbline/adapters/joint_tree.hpp"

namespace plumbline {
namespace {

namespace dd = dart::dynamics;
namespace dc = dart::constraint;

Eigen::Isometry3d pose(const Vec3& p, const Quat& q) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = q.toRotationMatrix();
  X.translation() = p;
  return X;
}

Eigen::Isometry3d pose(const BodyState& s) { return pose(s.p_WB, s.q_WB); }

// The last solver that a step asks, watched: DART takes an answer that is not a number for zero impulses and goes on,
// and PGS leaves out bodies so heavy that 1/mass is next to nothing.
class LastSolver final : public dc::BoxedLcpSolver {
 public:
  LastSolver(std::shared_ptr<dc::BoxedLcpSolver> solver, double least_inverse_mass)
      : solver_(std::move(solver)), least_inverse_mass_(least_inverse_mass) {}
  const std::string& getType() const override { return solver_->getType(); }
  bool solve(int n, double* A, double* x, double* b, int nub, double* lo, double* hi, int* findex,
             bool early_termination) override {
    const int row = n > 1 ? (n + 3) / 4 * 4 : n;  // rows of A are padded so
    for (int i = 0; i < n; ++i) {
      const bool contact = lo[i] == 0;  // those of joints have no bounds
      if (!contact || A[i * row + i] >= least_inverse_mass_) continue;
      throw std::runtime_error(
          "a contact was left out: DART's PGS solver needs 1/mass >= " + shortest(least_inverse_mass_) + " 1/kg there");
    }
    const bool solved = solver_->solve(n, A, x, b, nub, lo, hi, findex, early_termination);
    if (!std::all_of(x, x + n, [](double impulse) { return std::isfinite(impulse); })) {
      throw std::runtime_error("the step failed: DART's solver found impulses that are not numbers");
    }
    return solved;
  }
  bool canSolve(int n, const double* A) override { return solver_->canSolve(n, A); }

 private:
  std::shared_ptr<dc::BoxedLcpSolver> solver_;
  double least_inverse_mass_;
};

void require_noticed(const ContactMaterial& contact) {
  constexpr double kTakenForNone = 1e-3;
  for (double coefficient : {contact.restitution, contact.friction}) {
    if (coefficient == 0 || coefficient > kTakenForNone) continue;
    throw std::invalid_argument("DART takes restitution and friction up to 0.001 for none: state 0 or more than that");
  }
}

class DartWorld final : public World {
 public:
  DartWorld(const Scenario& scenario, const DartKnobs& knobs)
      : scenario_(scenario), knobs_(knobs), nodes_(scenario.bodies.size()) {
    if (scenario.contact) require_noticed(*scenario.contact);
    world_->setGravity(scenario.gravity);
    world_->setConstraintSolver(constraint_solver());
    auto& option = world_->getConstraintSolver()->getCollisionOption();
    max_contacts_ = option.maxNumContacts;
    option.collisionFilter = filter_;
    if (knobs.detector == Detector::kOde) {
      world_->getConstraintSolver()->setCollisionDetector(dart::collision::OdeCollisionDetector::create());
    } else {
      world_->getConstraintSolver()->setCollisionDetector(dart::collision::FCLCollisionDetector::create());
    }
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      if (scenario.bodies[i].fixed) fix(i);
    }
    const JointTree tree = joint_tree(scenario);
    require_coordinates(scenario, tree);
    for (const TreeLink& link : tree.links) hang(link);
    // Only now that they have their shapes: those that come later are found in an order that depends on addresses in
    // memory, and so would the results.
    for (const auto& skeleton : skeletons_) world_->addSkeleton(skeleton);
    for (std::size_t k : tree.left_over) close_loop(scenario.joints[k]);
    for (const Joint& joint : scenario.joints) {
      if (joint.a != kWorld) filter_->addBodyNodePairToBlackList(nodes_[joint.a], nodes_[joint.b]);
    }
  }

  void apply(std::span<const Wrench> wrenches) override {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      if (scenario_.bodies[i].fixed) continue;
      // DART would end the process in an assertion.
      if (!wrenches[i].f_W.allFinite() || !wrenches[i].tau_W.allFinite()) {
        throw std::runtime_error("the force on body '" + scenario_.bodies[i].name + "' is not a number");
      }
      nodes_[i]->addExtForce(wrenches[i].f_W);
      nodes_[i]->addExtTorque(wrenches[i].tau_W);
    }
  }

  void step(double dt) override {
    // DART would keep the step that it had.
    if (!(dt > 0)) throw std::invalid_argument("DART needs a time step > 0");
    if (dt != world_->getTimeStep()) world_->setTimeStep(dt);
    set_statics(dt);
    if (knobs_.friction_axis == FrictionAxis::kMotion) align_friction(dt);
    world_->step();
    if (world_->getLastCollisionResult().getNumContacts() >= max_contacts_) {
      throw std::runtime_error("the step may have dropped contacts: DART keeps at most " +
                               std::to_string(max_contacts_));
    }
  }

  void read(std::span<BodyState> states) const override {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      if (scenario_.bodies[i].fixed) {
        states[i] = {scenario_.bodies[i].initial.p_WB, scenario_.bodies[i].initial.q_WB, Vec3::Zero(), Vec3::Zero()};
        continue;
      }
      const Eigen::Isometry3d& X_WB = nodes_[i]->getWorldTransform();
      states[i].p_WB = X_WB.translation();
      states[i].q_WB = Quat(X_WB.linear());
      states[i].v_WB = nodes_[i]->getLinearVelocity();
      states[i].w_WB = nodes_[i]->getAngularVelocity();
    }
  }

 private:
  std::unique_ptr<dc::ConstraintSolver> constraint_solver() const {
    const auto pgs = std::make_shared<dc::PgsBoxedLcpSolver>();
    dc::PgsBoxedLcpSolver::Option option = pgs->getOption();
    option.mMaxIteration = knobs_.pgs_iterations;
    option.mDeltaXThreshold = knobs_.pgs_absolute_change;
    option.mRelativeDeltaXTolerance = knobs_.pgs_relative_change;
    pgs->setOption(option);
    const auto last = std::make_shared<LastSolver>(pgs, option.mEpsilonForDivision);
    if (knobs_.solver == LcpSolver::kPgs) return std::make_unique<dc::BoxedLcpConstraintSolver>(last, nullptr);
    const auto dantzig = std::make_shared<dc::DantzigBoxedLcpSolver>();
    if (knobs_.pgs_fallback) return std::make_unique<dc::BoxedLcpConstraintSolver>(dantzig, last);
    return std::make_unique<dc::BoxedLcpConstraintSolver>(std::make_shared<LastSolver>(dantzig, 0), nullptr);
  }

  dd::SkeletonPtr new_skeleton() {
    skeletons_.push_back(dd::Skeleton::create("group " + std::to_string(skeletons_.size())));
    skeletons_.back()->enableSelfCollisionCheck();
    skeletons_.back()->enableAdjacentBodyCheck();  // who is exempt is the filter's business
    return skeletons_.back();
  }

  void fix(std::size_t i) {
    const Body& body = scenario_.bodies[i];
    const auto skeleton = new_skeleton();
    const auto [joint, node] = skeleton->createJointAndBodyNodePair<dd::WeldJoint>();
    // A half-space states its plane in W.
    if (!std::holds_alternative<HalfSpace>(body.shape)) joint->setTransformFromParentBodyNode(pose(body.initial));
    skeleton->setMobile(false);
    nodes_[i] = node;
    give_shape(i);
  }

  void hang(const TreeLink& link) {
    const BodyState& initial = scenario_.bodies[link.body].initial;
    if (!link.joint) {
      float_free(link.body);
    } else {
      const Joint& j = *link.joint;
      dd::BodyNode* parent = j.a == kWorld ? nullptr : nodes_[j.a];
      const dd::SkeletonPtr skeleton = parent == nullptr ? new_skeleton() : parent->getSkeleton();
      // The joint's frame has the axes of B, and its coordinate is 0 in the starting pose.
      const Eigen::Isometry3d X_BJ(Eigen::Translation3d(j.on_b.anchor));
      const auto attach = [&]<typename Kind>(std::type_identity<Kind>) {
        const auto [joint, node] = skeleton->createJointAndBodyNodePair<Kind>(parent);
        const Eigen::Isometry3d X_AW = pose(initial_state_of(scenario_, j.a)).inverse();
        joint->setTransformFromParentBodyNode(X_AW * pose(initial) * X_BJ);
        joint->setTransformFromChildBodyNode(X_BJ);
        nodes_[link.body] = node;
        return joint;
      };
      if (j.kind == JointKind::kHinge) {
        const auto joint = attach(std::type_identity<dd::RevoluteJoint>());
        joint->setAxis(j.on_b.axis());
        joint->setVelocity(0, initial_rate(scenario_, j));
        act_on_coordinate(*joint, link);
      } else if (j.kind == JointKind::kSlider) {
        const auto joint = attach(std::type_identity<dd::PrismaticJoint>());
        joint->setAxis(j.on_b.axis());
        joint->setVelocity(0, initial_rate(scenario_, j));
        act_on_coordinate(*joint, link);
      } else if (j.kind == JointKind::kBall) {
        attach(std::type_identity<dd::BallJoint>())->setVelocities(initial_relative_rotation(scenario_, j));
      } else {
        attach(std::type_identity<dd::WeldJoint>());
      }
    }
    const Body& body = scenario_.bodies[link.body];
    const Eigen::Matrix3d I_BBcm_B = body.inertia.asDiagonal();
    nodes_[link.body]->setInertia(dd::Inertia(body.mass, Vec3::Zero(), I_BBcm_B));
    give_shape(link.body);
  }

  void act_on_coordinate(dd::Joint& joint, const TreeLink& link) const {
    if (const auto& range = link.joint->range) {
      joint.setPositionLowerLimit(0, range->low);
      joint.setPositionUpperLimit(0, range->high);
      joint.setLimitEnforcement(true);
    }
    if (const auto spring = spring_on(scenario_, link)) {
      joint.setSpringStiffness(0, spring->stiffness);
      joint.setDampingCoefficient(0, spring->damping);
      joint.setRestPosition(0, spring->rest);
    }
  }

  void float_free(std::size_t i) {
    const BodyState& initial = scenario_.bodies[i].initial;
    const auto skeleton = new_skeleton();
    const auto [joint, node] = skeleton->createJointAndBodyNodePair<dd::FreeJoint>();
    joint->setTransform(pose(initial));
    joint->setLinearVelocity(initial.v_WB);
    joint->setAngularVelocity(initial.w_WB);
    nodes_[i] = node;
  }

  void close_loop(const Joint& j) {
    const BodyState b = scenario_.bodies[j.b].initial;
    const auto hold_point = [&](const Vec3& p_B) {
      const Vec3 p_W = b.p_WB + b.q_WB * p_B;
      world_->getConstraintSolver()->addConstraint(
          j.a == kWorld ? std::make_shared<dc::BallJointConstraint>(nodes_[j.b], p_W)
                        : std::make_shared<dc::BallJointConstraint>(nodes_[j.a], nodes_[j.b], p_W));
    };
    if (j.kind == JointKind::kBall) return hold_point(j.on_b.anchor);
    if (j.kind == JointKind::kHinge) {
      hold_point(j.on_b.anchor - j.on_b.axis());
      return hold_point(j.on_b.anchor + j.on_b.axis());
    }
    if (j.kind == JointKind::kFixed) {
      world_->getConstraintSolver()->addConstraint(
          j.a == kWorld ? std::make_shared<dc::WeldJointConstraint>(nodes_[j.b])
                        : std::make_shared<dc::WeldJointConstraint>(nodes_[j.a], nodes_[j.b]));
      return;
    }
    throw std::invalid_argument("joint '" + j.name + "' closes a loop, for which DART has no slider: state it before " +
                                "the other joints of the loop, so that one of those closes it");
  }

  void give_shape(std::size_t i) {
    if (!scenario_.contact) return;
    const Body& body = scenario_.bodies[i];
    dd::ShapePtr shape;
    if (const auto* half = std::get_if<HalfSpace>(&body.shape)) {
      if (knobs_.detector == Detector::kFcl) {
        throw std::invalid_argument("body '" + body.name +
                                    "': with 'collision_detector' fcl DART has no half-spaces, " +
                                    "only a mesh of limited size; use ode");
      }
      shape = std::make_shared<dd::PlaneShape>(half->normal, half->normal.dot(body.initial.p_WB));
    } else if (const auto* sphere = std::get_if<Sphere>(&body.shape)) {
      shape = std::make_shared<dd::SphereShape>(sphere->radius);
    } else if (const auto* cylinder = std::get_if<Cylinder>(&body.shape)) {
      shape = std::make_shared<dd::CylinderShape>(cylinder->radius, cylinder->height);
    } else {
      shape = std::make_shared<dd::BoxShape>(std::get<Box>(body.shape).size);
    }
    auto* node = nodes_[i]->createShapeNodeWith<dd::CollisionAspect, dd::DynamicsAspect>(shape);
    // DART takes the smaller friction of the two, and the product of the restitutions.
    node->getDynamicsAspect()->setFrictionCoeff(scenario_.contact->friction);
    node->getDynamicsAspect()->setRestitutionCoeff(std::sqrt(scenario_.contact->restitution));
    node->getDynamicsAspect()->setFirstFrictionDirectionFrame(dd::Frame::World());
  }

  // Process-wide in DART: another world may have set them to its own.
  void set_statics(double dt) const {
    double velocity = knobs_.max_error_reduction_velocity;
    if (knobs_.correct_within_gravity_step) velocity = std::min(velocity, scenario_.gravity.norm() * dt);
    dc::ContactConstraint::setErrorReductionParameter(knobs_.error_reduction);
    dc::ContactConstraint::setMaxErrorReductionVelocity(velocity);
    dc::ContactConstraint::setErrorAllowance(knobs_.error_allowance);
    dc::ContactConstraint::setConstraintForceMixing(knobs_.force_mixing);
    dc::DynamicJointConstraint::setErrorReductionParameter(knobs_.loop_error_reduction);
  }

  // Friction is a box whose first axis each body may choose. Along the way that the body would slide without friction
  // it does what Coulomb's cone does; a body at rest has such a way too.
  void align_friction(double dt) {
    if (!scenario_.contact) return;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const Body& body = scenario_.bodies[i];
      if (body.fixed) continue;
      const Vec3 f_W = nodes_[i]->getExternalForceGlobal().tail<3>();
      const Vec3 v_WB = nodes_[i]->getLinearVelocity() + (scenario_.gravity + f_W / body.mass) * dt;
      nodes_[i]->getShapeNode(0)->getDynamicsAspect()->setFirstFrictionDirection(v_WB);
    }
  }

  Scenario scenario_;
  DartKnobs knobs_;
  dart::simulation::WorldPtr world_ = dart::simulation::World::create();
  std::shared_ptr<dart::collision::BodyNodeCollisionFilter> filter_ =
      std::make_shared<dart::collision::BodyNodeCollisionFilter>();
  std::vector<dd::SkeletonPtr> skeletons_;
  std::vector<dd::BodyNode*> nodes_;  // in scenario order
  std::size_t max_contacts_ = 0;
};

}  // namespace

std::unique_ptr<World> make_dart_world(const Scenario& scenario, const DartKnobs& knobs) {
  return std::make_unique<DartWorld>(scenario, knobs);
}

}  // namespace plumbline
