// Row simbody-rigid: contacts are inequalities between positions, solved as impulses once a step.
#include "simbody_model.hpp"

#include <simbody/internal/ConditionalConstraint.h>
#include <simbody/internal/PGSImpulseSolver.h>
#include <simbody/internal/PLUSImpulseSolver.h>
#include <simbody/internal/SemiExplicitEulerTimeStepper.h>

#include <iostream>

#include "plumbline/adapters/knob_table.hpp"
#include "simbody_rows.hpp"

namespace plumbline {
namespace {

using Stepper = SimTK::SemiExplicitEulerTimeStepper;

struct Knobs {
  Stepper::ImpulseSolverType solver;
  double solver_tolerance;
  int solver_iterations;
  Stepper::RestitutionModel restitution;
  Stepper::InducedImpactModel induced_impacts;
  int induced_impact_rounds;
  Stepper::PositionProjectionMethod projection;
  bool project_after_step;
  double constraint_tolerance, capture_speed, min_restitution_speed, transition_speed;
};

const KnobTable<Knobs>& knob_table() {
  static const KnobTable<Knobs> table =
      KnobTable<Knobs>()
          .choose(&Knobs::solver, "impulse_solver", {{"plus", Stepper::PLUS}, {"pgs", Stepper::PGS}}, "plus", "pgs",
                  "plus: Newton's method on all contacts at once, which can take sliding for sticking; pgs: projected "
                  "Gauss-Seidel")
          .add(&Knobs::solver_tolerance, "solver_tolerance", 1e-10, 1e-12, "m/s",
               "speed that the solver may leave across a contact (Simbody's own: plus 1e-10, pgs 1e-6)")
          .at_least(0)
          .add(&Knobs::solver_iterations, "solver_iterations", 20, 1000, "",
               "sweeps or Newton steps of the solver at most (Simbody's own: plus 20, pgs 100)")
          .at_least(1)
          .choose(&Knobs::restitution, "restitution_model",
                  {{"poisson", Stepper::Poisson}, {"newton", Stepper::Newton}, {"none", Stepper::NoRestitution}},
                  "poisson", "newton", "e as a ratio of impulses or, as scenarios state it, of velocities")
          .choose(
              &Knobs::induced_impacts, "induced_impacts",
              {{"simultaneous", Stepper::Simultaneous}, {"sequential", Stepper::Sequential}, {"mixed", Stepper::Mixed}},
              "simultaneous", "simultaneous", "whether contacts that are hit together answer together")
          .add(&Knobs::induced_impact_rounds, "induced_impact_rounds", 5, 5, "",
               "rounds per step of impacts that are not simultaneous")
          .at_least(1)
          .choose(&Knobs::projection, "position_projection",
                  {{"bilateral", Stepper::Bilateral},
                   {"unilateral", Stepper::Unilateral},
                   {"none", Stepper::NoPositionProjection}},
                  "bilateral", "bilateral",
                  "how a step takes penetration back; a library that was built with assertions undoes it")
          .add(&Knobs::project_after_step, "project_after_step", false, true, "",
               "takes penetration back once more, by Simbody's own projection of positions")
          .add(&Knobs::constraint_tolerance, "constraint_tolerance", 1e-3, 1e-9, "m and m/s",
               "distance at which bodies count as touching, and twice it the least impact speed with a rebound")
          .at_least(0)
          .add(&Knobs::capture_speed, "impact_capture_speed", 0.0, 0.0, "m/s",
               "slower impacts have e = 0; at least twice the constraint tolerance")
          .at_least(0)
          .add(&Knobs::min_restitution_speed, "impact_min_restitution_speed", 0.0, 0.0, "m/s",
               "between the capture speed and this one e falls from 1 to its stated value")
          .at_least(0)
          .add(&Knobs::transition_speed, "friction_transition_speed", 0.0, 0.0, "m/s",
               "slower sliding may stick; at least twice the constraint tolerance")
          .at_least(0);
  return table;
}

// A library with assertions prints its matrices at every step with contact, which takes longer than the step itself.
class Quiet {
 public:
  Quiet() { std::cout.setstate(std::ios::failbit); }
  ~Quiet() { std::cout.clear(before_); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  std::ios::iostate before_ = std::cout.rdstate();
};

class RigidWorld final : public World {
 public:
  RigidWorld(const Scenario& scenario, const Knobs& knobs)
      : model_(scenario), stepper_(model_.system()), project_after_step_(knobs.project_after_step) {
    if (scenario.contact) add_contacts(scenario);
    stepper_.setConstraintTolerance(knobs.constraint_tolerance);
    stepper_.setRestitutionModel(knobs.restitution);
    stepper_.setInducedImpactModel(knobs.induced_impacts);
    stepper_.setMaxInducedImpactsPerStep(knobs.induced_impact_rounds);
    stepper_.setPositionProjectionMethod(knobs.projection);
    stepper_.setDefaultImpactCaptureVelocity(knobs.capture_speed);
    stepper_.setDefaultImpactMinCORVelocity(knobs.min_restitution_speed);
    stepper_.setDefaultFrictionTransitionVelocity(knobs.transition_speed);
    const double rolling_speed = stepper_.getDefaultFrictionTransitionVelocityInUse();
    std::unique_ptr<SimTK::ImpulseSolver> solver;
    if (knobs.solver == Stepper::PGS) {
      solver = std::make_unique<SimTK::PGSImpulseSolver>(rolling_speed);
    } else {
      solver = std::make_unique<SimTK::PLUSImpulseSolver>(rolling_speed);
    }
    solver->setConvergenceTol(knobs.solver_tolerance);
    solver->setMaxIterations(knobs.solver_iterations);
    stepper_.setImpulseSolverType(knobs.solver);
    stepper_.setImpulseSolver(solver.release());
    stepper_.initialize(model_.begin(scenario));
    still_.resize(scenario.bodies.size());
  }

  void apply(std::span<const Wrench> wrenches) override {
    model_.apply(stepper_.updState(), wrenches);
    pushed_ = true;
  }

  void step(double dt) override {
    const double end = SimbodyModel::end_of_step(stepper_.getTime(), dt);
    {
      const Quiet quiet;
      stepper_.stepTo(end);
    }
    if (project_after_step_) project();
    if (pushed_) model_.apply(stepper_.updState(), still_);
    pushed_ = false;
  }

  void read(std::span<BodyState> states) const override { model_.read(stepper_.getState(), states); }

 private:
  // The step computes a correction of its own, but in a library with assertions (Debian's) a line that prints for
  // debugging overwrites it before it is used. The step enables the contacts again that it needs.
  void project() {
    SimTK::State& state = stepper_.updState();
    const SimTK::SimbodyMatterSubsystem& matter = model_.matter();
    std::vector<SimTK::UnilateralContactIndex> apart;
    bool penetrates = false;
    for (SimTK::UnilateralContactIndex k(0); k < matter.getNumUnilateralContacts(); ++k) {
      const SimTK::UnilateralContact& contact = matter.getUnilateralContact(k);
      if (!contact.isEnabled(state)) continue;
      if (contact.getPerr(state) < -stepper_.getConstraintToleranceInUse()) {
        penetrates = true;
      } else {
        apart.push_back(k);
      }
    }
    if (!penetrates) return;
    for (const SimTK::UnilateralContactIndex k : apart) matter.getUnilateralContact(k).disable(state);
    model_.system().realize(state, SimTK::Stage::Position);
    model_.system().projectQ(state, stepper_.getConstraintToleranceInUse());
    model_.system().realize(state, SimTK::Stage::Velocity);
  }

  // There is no search for contacts: every pair that may ever touch is stated.
  void add_contacts(const Scenario& scenario) {
    for (const Body& body : scenario.bodies) planes_.push_back(surface(body));
    for (std::size_t i = 0; i < scenario.bodies.size(); ++i) {
      for (std::size_t j = i + 1; j < scenario.bodies.size(); ++j) {
        const Body &a = scenario.bodies[i], &b = scenario.bodies[j];
        if ((a.fixed && b.fixed) || joined(scenario, i, j)) continue;
        if (const auto* half_a = std::get_if<HalfSpace>(&a.shape)) {
          add_on_plane(*half_a, i, j, b, *scenario.contact);
        } else if (const auto* half_b = std::get_if<HalfSpace>(&b.shape)) {
          add_on_plane(*half_b, j, i, a, *scenario.contact);
        } else {
          const double e = scenario.contact->restitution, mu = scenario.contact->friction;
          model_.matter().adoptUnilateralContact(new SimTK::SphereSphereContact(
              model_.body(i), centre(a), std::get<Sphere>(a.shape).radius, model_.body(j), centre(b),
              std::get<Sphere>(b.shape).radius, e, mu, mu, 0));
        }
      }
    }
  }

  // In the axes of the mobilized body: a fixed one is part of the ground.
  static SimTK::Vec3 centre(const Body& body) {
    return body.fixed ? simbody_vector(body.initial.p_WB) : SimTK::Vec3(0);
  }

  // What the plane of a half-space is fixed to. The contacts forget the height of their plane, so one that is not
  // through the origin of the ground gets a body without mass at its own place.
  SimTK::MobilizedBodyIndex surface(const Body& body) {
    const auto* half = std::get_if<HalfSpace>(&body.shape);
    if (half == nullptr || half->normal.dot(body.initial.p_WB) == 0) return SimTK::MobilizedBodyIndex(0);
    return SimTK::MobilizedBody::Weld(model_.matter().updGround(), simbody_vector(body.initial.p_WB),
                                      SimTK::Body::Massless(), SimTK::Transform());
  }

  void add_on_plane(const HalfSpace& half_space, std::size_t plane, std::size_t i, const Body& body,
                    const ContactMaterial& material) {
    const double e = material.restitution, mu = material.friction;
    const SimTK::UnitVec3 n(simbody_vector(half_space.normal));
    SimTK::MobilizedBody &ground = model_.matter().updMobilizedBody(planes_[plane]), &mobod = model_.body(i);
    if (const auto* sphere = std::get_if<Sphere>(&body.shape)) {
      model_.matter().adoptUnilateralContact(
          new SimTK::SpherePlaneContact(ground, n, 0, mobod, SimTK::Vec3(0), sphere->radius, e, mu, mu, 0));
      return;
    }
    const Vec3 half = 0.5 * std::get<Box>(body.shape).size;
    for (const double x : {-half.x(), half.x()}) {
      for (const double y : {-half.y(), half.y()}) {
        for (const double z : {-half.z(), half.z()}) {
          model_.matter().adoptUnilateralContact(
              new SimTK::PointPlaneContact(ground, n, 0, mobod, SimTK::Vec3(x, y, z), e, mu, mu, 0));
        }
      }
    }
  }

  SimbodyModel model_;
  std::vector<SimTK::MobilizedBodyIndex> planes_;  // for each body that is a half-space
  Stepper stepper_;
  bool project_after_step_;
  std::vector<Wrench> still_;  // no force on anything
  bool pushed_ = false;
};

}  // namespace

std::vector<Setting> simbody_rigid_settings() { return knob_table().rows(); }

std::unique_ptr<World> make_simbody_rigid(const Scenario& scenario, const Settings& settings) {
  return std::make_unique<RigidWorld>(scenario, knob_table().read(settings));
}

}  // namespace plumbline
