// Row simbody-compliant: contacts are springs and dampers at the surfaces, and an integrator with error control takes
// as many steps within a step as its accuracy needs.
#include "simbody_model.hpp"

#include <simbody/internal/CompliantContactSubsystem.h>
#include <simbody/internal/ContactSurface.h>
#include <simbody/internal/ContactTrackerSubsystem.h>
#include <simmath/CPodesIntegrator.h>
#include <simmath/RungeKuttaMersonIntegrator.h>
#include <simmath/TimeStepper.h>

#include <optional>
#include <stdexcept>

#include "plumbline/adapters/knob_table.hpp"
#include "simbody_rows.hpp"

namespace plumbline {
namespace {

enum class Method { kMerson, kCPodes };

struct Knobs {
  Method integrator, contact_integrator;
  double accuracy, constraint_tolerance;
  double stiffness, dissipation, transition_speed;
};

const KnobTable<Knobs>& knob_table() {
  const std::vector<std::pair<std::string, Method>> methods = {{"merson", Method::kMerson},
                                                               {"cpodes", Method::kCPodes}};
  static const KnobTable<Knobs> table =
      KnobTable<Knobs>()
          .choose(&Knobs::integrator, "integrator", methods, "merson", "merson",
                  "merson: explicit Runge-Kutta of order 4 with error control; cpodes: implicit multistep")
          .choose(&Knobs::contact_integrator, "contact_integrator", methods, "merson", "cpodes",
                  "the same for scenarios with contact, which a small e makes stiff")
          .add(&Knobs::accuracy, "accuracy", 1e-3, 1e-9, "1", "relative error that one step of the integrator may make")
          .at_least(1e-15)
          .add(&Knobs::constraint_tolerance, "constraint_tolerance", 1e-4, 1e-10, "m, rad, m/s and rad/s",
               "how far joints that are held by constraints may be off before they are projected back")
          .at_least(1e-15)
          .add(&Knobs::stiffness, "stiffness", 1e7, 1e7, "Pa", "of the surfaces; about that of rubber")
          .at_least(1e-15)
          .add(
              &Knobs::dissipation, "dissipation", 1.0, 1e6, "s/m",
              "Hunt and Crossley's c of the surfaces: slow impacts have e = 1 - c v, fast ones part with less than "
              "1/c; for e = 0 Simbody's own rule (1 - e)/v gives 1 at 1 m/s, the stated problem wants it without bound")
          .at_least(0)
          .add(&Knobs::transition_speed, "friction_transition_speed", 0.01, 1e-4, "m/s",
               "slower sliding has less friction: what should stick creeps at up to this speed")
          .at_least(1e-15);
  return table;
}

class CompliantWorld final : public World {
 public:
  CompliantWorld(const Scenario& scenario, const Knobs& knobs)
      : model_(scenario), tracker_(model_.system()), contact_(model_.system(), tracker_) {
    model_.close_loops(scenario);
    contact_.setTransitionVelocity(knobs.transition_speed);
    if (scenario.contact) add_surfaces(scenario, knobs);
    const SimTK::State start = model_.begin(scenario);
    const Method method = scenario.contact ? knobs.contact_integrator : knobs.integrator;
    if (method == Method::kMerson || start.getNU() == 0) {  // the implicit one aborts where nothing moves
      integrator_ = std::make_unique<SimTK::RungeKuttaMersonIntegrator>(model_.system());
    } else {
      integrator_ = std::make_unique<SimTK::CPodesIntegrator>(model_.system());
    }
    // Without this the implicit method runs ahead, over impacts, and interpolates back.
    integrator_->setAllowInterpolation(false);
    integrator_->setAccuracy(knobs.accuracy);
    integrator_->setConstraintTolerance(knobs.constraint_tolerance);
    stepper_.emplace(model_.system(), *integrator_);
    stepper_->initialize(start);
    still_.resize(scenario.bodies.size());
  }

  void apply(std::span<const Wrench> wrenches) override { push(wrenches, true); }

  void step(double dt) override {
    const double end = SimbodyModel::end_of_step(integrator_->getTime(), dt);
    stepper_->stepTo(end);
    if (integrator_->getTime() != end) throw std::runtime_error("the integrator stopped before the end of the step");
    if (pushed_) push(still_, false);
  }

  void read(std::span<BodyState> states) const override { model_.read(integrator_->getState(), states); }

 private:
  void push(std::span<const Wrench> wrenches, bool pushed) {
    model_.apply(integrator_->updAdvancedState(), wrenches);
    // The integrator would go on with the accelerations of the forces before.
    integrator_->reinitialize(SimTK::Stage::Dynamics, false);
    model_.system().realize(integrator_->getState(), SimTK::Stage::Velocity);
    pushed_ = pushed;
  }

  void add_surfaces(const Scenario& scenario, const Knobs& knobs) {
    const double mu = scenario.contact->friction;
    const SimTK::ContactMaterial material(knobs.stiffness, knobs.dissipation, mu, mu);
    std::vector<SimTK::ContactSurface> surfaces;
    for (const Body& body : scenario.bodies) surfaces.emplace_back(geometry(body.shape), material);
    // Surfaces of one clique do not touch.
    for (const Joint& joint : scenario.joints) {
      if (joint.a == kWorld) continue;
      const SimTK::ContactCliqueId clique = SimTK::ContactSurface::createNewContactClique();
      surfaces[joint.a].joinClique(clique);
      surfaces[joint.b].joinClique(clique);
    }
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
      model_.body(i).updBody().addContactSurface(place(scenario.bodies[i]), surfaces[i]);
    }
  }

  static SimTK::ContactGeometry geometry(const Shape& shape) {
    if (const auto* sphere = std::get_if<Sphere>(&shape)) return SimTK::ContactGeometry::Sphere(sphere->radius);
    if (const auto* box = std::get_if<Box>(&shape))
      return SimTK::ContactGeometry::Brick(simbody_vector(0.5 * box->size));
    return SimTK::ContactGeometry::HalfSpace();
  }

  // Where the surface sits in the axes of its mobilized body: a fixed one is part of the ground.
  static SimTK::Transform place(const Body& body) {
    if (!body.fixed) return {};
    const SimTK::Vec3 p = simbody_vector(body.initial.p_WB);
    if (const auto* half = std::get_if<HalfSpace>(&body.shape)) {
      // Simbody's half-space is where its own x is positive.
      return {SimTK::Rotation(SimTK::UnitVec3(simbody_vector(-half->normal)), SimTK::XAxis), p};
    }
    return {simbody_rotation(body.initial.q_WB), p};
  }

  SimbodyModel model_;
  SimTK::ContactTrackerSubsystem tracker_;
  SimTK::CompliantContactSubsystem contact_;
  std::unique_ptr<SimTK::Integrator> integrator_;
  std::optional<SimTK::TimeStepper> stepper_;
  std::vector<Wrench> still_;  // no force on anything
  bool pushed_ = false;
};

}  // namespace

std::vector<Setting> simbody_compliant_settings() { return knob_table().rows(); }

std::unique_ptr<World> make_simbody_compliant(const Scenario& scenario, const Settings& settings) {
  return std::make_unique<CompliantWorld>(scenario, knob_table().read(settings));
}

}  // namespace plumbline
