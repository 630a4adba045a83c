#include "solution.hpp"

#include <cmath>
#include <optional>

#include "named_solution.hpp"
#include "plumbline/core/exact/planar_pendulum.hpp"
#include "plumbline/core/exact/torque_free_top.hpp"
#include "solution_collision.hpp"
#include "solution_contact.hpp"
#include "solution_linkage.hpp"
#include "solution_particle.hpp"
#include "solution_rotation.hpp"

namespace plumbline {
namespace {

// Bodies on their own: each one a free top, which gravity does not turn; its centre of mass moves on uniformly or
// on a parabola.
class TorqueFreeRotation final : public NamedSolution {
 public:
  TorqueFreeRotation(const Scenario& scenario, std::string citation) : NamedSolution(std::move(citation)) {
    if (!scenario.forces.empty() || !scenario.joints.empty() || !scenario.springs.empty() || scenario.contact) {
      refuse("nothing but gravity may act on the bodies: no force, joint, spring or contact");
    }
    gravity_W_ = scenario.gravity;
    for (const Body& body : scenario.bodies) {
      if (body.fixed) refuse("every body must move");
      tops_.emplace_back(body.inertia, body.initial);
      // exact/torque_free_top.hpp: a few 1e-16 times the angle turned, magnified near the separatrix.
      const double turned = 1 + body.initial.w_WB.norm() * scenario.duration;
      uncertainty_ = std::max(uncertainty_, 8e-16 * turned / (1 - tops_.back().parameter()));
    }
  }
  BodyState at(std::size_t body, double t) const override {
    BodyState state = tops_[body].at(t);
    state.p_WB += 0.5 * t * t * gravity_W_;
    state.v_WB += t * gravity_W_;
    return state;
  }
  double uncertainty() const override { return uncertainty_; }

 private:
  std::vector<TorqueFreeTop> tops_;
  Vec3 gravity_W_ = Vec3::Zero();
  double uncertainty_ = 0;
};

// One body on one hinge that is tied to the world, under gravity at right angles to the hinge.
class PendulumOnHinge final : public NamedSolution {
 public:
  PendulumOnHinge(const Scenario& scenario, std::string citation) : NamedSolution(std::move(citation)) {
    if (scenario.bodies.size() != 1 || scenario.joints.size() != 1 || !scenario.forces.empty() || scenario.contact) {
      refuse("it is for one body on one hinge, without force laws and contact");
    }
    const Body& body = scenario.bodies.front();
    const Joint& joint = scenario.joints.front();
    if (joint.kind != JointKind::kHinge || joint.a != kWorld) refuse("its joint must be a hinge to the world");
    start_ = body.initial;
    axis_W_ = joint.on_a.axis();
    const Vec3 from_anchor = start_.p_WB - joint.on_a.anchor;
    centre_ = joint.on_a.anchor + axis_W_ * axis_W_.dot(from_anchor);  // of the circle that the centre of mass runs on
    arm_ = start_.p_WB - centre_;
    const double g = scenario.gravity.norm(), d = arm_.norm();
    if (!(g > 0) || std::abs(axis_W_.dot(scenario.gravity)) > 1e-12 * g) {
      refuse("the hinge's axis must be at right angles to gravity");
    }
    if (!(d > 0)) refuse("the centre of mass must not lie on the axis");
    const double inertia = axis_W_.dot(inertia_in_world(body, start_.q_WB) * axis_W_) + body.mass * d * d;
    const Vec3 down = scenario.gravity / g;
    const PendulumState initial{std::atan2(axis_W_.dot(down.cross(arm_)), down.dot(arm_)), axis_W_.dot(start_.w_WB)};
    const double w0 = std::sqrt(body.mass * g * d / inertia);
    pendulum_.emplace(w0, initial);
    angle0_ = initial.angle;
    // exact/planar_pendulum.hpp: a few 1e-16 (1 + w0 t) of the arm, magnified near the upright position.
    const double k2 = std::pow(std::sin(initial.angle / 2), 2) + std::pow(initial.rate / (2 * w0), 2);
    uncertainty_ = 8e-16 * (1 + w0 * scenario.duration) / std::abs(1 - k2) * (1 + d / scenario.scales.length);
  }
  BodyState at(std::size_t, double t) const override {
    const PendulumState now = pendulum_->at(t);
    const Quat turn = rotation_by((now.angle - angle0_) * axis_W_);
    BodyState s;
    const Vec3 arm = turn * arm_;
    s.p_WB = centre_ + arm;
    s.q_WB = turn * start_.q_WB;
    s.w_WB = now.rate * axis_W_;
    s.v_WB = s.w_WB.cross(arm);
    return s;
  }
  double uncertainty() const override { return uncertainty_; }

 private:
  BodyState start_;
  Vec3 axis_W_, centre_, arm_;
  double angle0_ = 0, uncertainty_ = 0;
  std::optional<PlanarPendulum> pendulum_;
};

}  // namespace

const std::vector<Solution>& solutions() {
  static const std::vector<Solution> kTable = {
      {"torque_free_rotation",
       "Euler's equations solved by Jacobi's elliptic functions; Landau and Lifshitz, section 37",
       solved_by<TorqueFreeRotation>},
      {"planar_pendulum", "the energy integral solved by Jacobi's elliptic functions; Landau and Lifshitz, section 11",
       solved_by<PendulumOnHinge>},
      {"rocking_block",
       "a pendulum upside down between plastic impacts, by Jacobi's elliptic functions; Housner, Bull. Seism. Soc. Am. "
       "53, 403 (1963), without his small angles",
       solve_rocking_block},
      {"leaving_sphere", "a pendulum upside down until the pressure ends, then a parabola; exact/leaving_sphere.hpp",
       solve_leaving_sphere},
      {"falling_ladder", "the equation of the ladder's angle, integrated; Kapranidis and Koo, CMJ 39 (2008) 374",
       solve_falling_ladder},
      {"curling_disc", "Farkas, Bartels, Unger and Wolf, Physical Review Letters 90 (2003) 248302", solve_curling_disc},
      {"turning_linkage",
       "the equation of the one angle is a pendulum's; Landau and Lifshitz, section 11; Jacobi's elliptic functions",
       solve_turning_linkage},
      {"kepler_orbit", "two-body motion by Kepler's equation; Bate, Mueller and White, Astrodynamics, chapter 4",
       solve_kepler_orbit},
      {"heavy_top", "Lagrange's top by elliptic integrals; Klein and Sommerfeld, Theory of the Top, volume 2",
       solve_heavy_top},
  };
  return kTable;
}

}  // namespace plumbline
