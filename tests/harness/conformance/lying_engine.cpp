#include "lying_engine.hpp"

#include <algorithm>
#include <stdexcept>

#include "plumbline/core/kinetics/simulator.hpp"

namespace plumbline::testing_support {
namespace {

// Worlds that have ended in this process.
int buried = 0;

// The truth: the in-house core. It takes no contacts beside joints; in the kit's one scene that has both, the only two
// bodies are tied to each other and so do not collide. It takes no contact of cylinders either; in the kit's scenes one
// on its side moves like a ball of its radius, and one on its end like a box as high that stands within its rim: mass,
// inertia and the points of contact are the same.
class HonestWorld final : public World {
 public:
  HonestWorld(const Scenario& scenario, const Scheme& scheme)
      : springs_(scenario), simulator_(as_the_core_can(scenario), scheme) {
    springs_.forces.clear();
    springs_.drives.clear();
  }
  void apply(std::span<const Wrench> wrenches) override {
    simulator_.apply(wrenches);  // refuses what is no wrench for every body
    given_.assign(wrenches.begin(), wrenches.end());
  }
  // It offers springs of its own: their force is added to what it is given.
  void step(double dt) override {
    std::vector<Wrench> all(simulator_.states().size());
    evaluate_forces(springs_, 0, simulator_.states(), all);
    for (std::size_t i = 0; i < given_.size(); ++i) {
      all[i].f_W += given_[i].f_W;
      all[i].tau_W += given_[i].tau_W;
    }
    given_.clear();
    simulator_.apply(all);
    simulator_.step(dt);
  }
  void read(std::span<BodyState> states) const override { std::ranges::copy(simulator_.states(), states.begin()); }

 private:
  static Scenario as_the_core_can(Scenario scenario) {
    if (!scenario.joints.empty()) scenario.contact.reset();
    for (Body& body : scenario.bodies) {
      const auto* cylinder = std::get_if<Cylinder>(&body.shape);
      if (cylinder == nullptr) continue;
      const double r = cylinder->radius, h = cylinder->height;
      const bool stands = std::abs((body.initial.q_WB * Vec3::UnitZ()).z()) > 0.5;
      body.shape = stands ? Shape(Box{Vec3(std::sqrt(2) * r, std::sqrt(2) * r, h)}) : Shape(Sphere{r});
    }
    return scenario;
  }
  Scenario springs_;
  Simulator simulator_;
  std::vector<Wrench> given_;
};

class LyingWorld final : public World {
 public:
  LyingWorld(const Lie& lie, const Scenario& stated, const Scenario& built, const Scheme& scheme)
      : lie_(lie), witness_{stated, 0, false, buried}, truth_(built, scheme), kept_(stated.bodies.size()) {}
  ~LyingWorld() override { ++buried; }

  void apply(std::span<const Wrench> wrenches) override {
    kept_.assign(wrenches.begin(), wrenches.end());
    if (lie_.apply) {
      std::vector<BodyState> states(kept_.size());
      truth_.read(states);
      lie_.apply(witness_, states, kept_);
    }
    truth_.apply(kept_);
  }
  void step(double dt) override {
    const double taken = lie_.step ? lie_.step(witness_, dt) : dt;
    if (lie_.keeps_wrenches) truth_.apply(kept_);
    if (taken > 0 || !(dt > 0)) truth_.step(taken);  // a lie that takes no step at all sleeps
    witness_.time += dt;
    witness_.looked = false;
  }
  void read(std::span<BodyState> states) const override {
    truth_.read(states);
    if (lie_.read) lie_.read(witness_, states);
    witness_.looked = true;
  }

 private:
  Lie lie_;
  mutable Witness witness_;
  HonestWorld truth_;
  std::vector<Wrench> kept_;
};

class LyingEngine final : public Engine {
 public:
  explicit LyingEngine(Lie lie) : lie_(std::move(lie)) {
    info_.name = "liar";
    info_.library = "the in-house core";
    info_.version = "1";
    info_.scheme = "as its setting says";
    info_.features = FeatureSet::all();
    info_.settings = {{"integrator", std::string("euler"), std::string("verlet"), "", "how free bodies are stepped"},
                      {"spare", 1.0, 1.0, "", "not used: that it cannot be NaN is up to the door"}};
    if (lie_.describe) lie_.describe(info_);
  }
  const EngineInfo& info() const override { return info_; }
  std::unique_ptr<World> create(const Scenario& scenario, const Settings& given) const override {
    Settings settings = given;
    if (lie_.settings) lie_.settings(settings);
    const std::string& word = setting_text(settings, "integrator");
    if (word != "euler" && word != "verlet") throw std::invalid_argument("integrator is euler or verlet");
    Scheme scheme;
    scheme.integrator = word == "euler" ? Integrator::kSemiImplicitEuler : Integrator::kVelocityVerlet;
    scheme.impact = ImpactRule::kExactTime;
    if (lie_.scheme) lie_.scheme(scheme);
    Scenario built = scenario;
    if (lie_.build) lie_.build(built);
    return std::make_unique<LyingWorld>(lie_, scenario, built, scheme);
  }

 private:
  Lie lie_;
  EngineInfo info_;
};

void each_joint(Scenario& scenario, const std::function<void(Joint&, const std::vector<BodyState>&)>& change) {
  std::vector<BodyState> states;
  for (const Body& body : scenario.bodies) states.push_back(body.initial);
  for (Joint& joint : scenario.joints) change(joint, states);
}

void drop_joints(Scenario& scenario, JointKind kind) {
  std::erase_if(scenario.joints, [&](const Joint& joint) { return joint.kind == kind; });
}

bool overlaps(const Scenario& scenario) {
  return scenario.bodies.size() == 2 && scenario.contact &&
         (scenario.bodies[0].initial.p_WB - scenario.bodies[1].initial.p_WB).norm() < 0.5;
}

// Steps that all worlds together have taken since the newest was built.
int steps_of_all = 0;
int worlds_built = 0;

std::vector<Lie> every_lie() {
  std::vector<Lie> all;
  const auto add = [&](Lie lie) { all.push_back(std::move(lie)); };

  add({.name = "forgets to tell its version", .caught_by = {"row_describes_itself"}, .describe = [](EngineInfo& info) {
         info.version.clear();
       }});
  add({.name = "gives its settings no meaning",
       .caught_by = {"row_describes_itself"},
       .describe = [](EngineInfo& info) { info.settings[0].meaning.clear(); }});
  add({.name = "takes any word for a setting",
       .caught_by = {"impossible_settings_are_refused"},
       .settings = [](Settings& s) {
         if (setting_text(s, "integrator") != "verlet") s["integrator"] = std::string("euler");
       }});
  add({.name = "prints its settings and uses none", .caught_by = {"settings_act"}, .scheme = [](Scheme& scheme) {
         scheme.integrator = Integrator::kSemiImplicitEuler;
       }});

  add({.name = "has one percent more mass", .caught_by = {"force_echoes_the_mass"}, .build = [](Scenario& s) {
         for (Body& body : s.bodies) body.mass *= 1.01;
       }});
  add({.name = "turns bodies by pushing them",
       .caught_by = {"force_echoes_the_mass"},
       .apply = [](const Witness&, std::span<const BodyState>, std::span<Wrench> w) {
         for (Wrench& wrench : w) wrench.tau_W += 0.1 * wrench.f_W;
       }});
  add({.name = "swaps two moments of inertia", .caught_by = {"torque_echoes_the_inertia"}, .build = [](Scenario& s) {
         for (Body& body : s.bodies) std::swap(body.inertia.x(), body.inertia.z());
       }});
  add({.name = "derives the inertia from the shape",
       .caught_by = {"torque_echoes_the_inertia"},
       .build = [](Scenario& s) {
         for (Body& body : s.bodies) {
           if (!body.fixed) body.inertia = solid_inertia(body.shape, body.mass);
         }
       }});
  add({.name = "keeps the inertia along the world's axes",
       .caught_by = {"inertia_turns_with_the_body"},
       .apply = [](const Witness& witness, std::span<const BodyState> states, std::span<Wrench> w) {
         for (std::size_t i = 0; i < w.size(); ++i) {
           const Body& body = witness.stated.bodies[i];
           if (body.fixed) continue;
           w[i].tau_W = inertia_in_world(body, states[i].q_WB) * w[i].tau_W.cwiseQuotient(body.inertia);
         }
       }});

  add({.name = "reads the conjugate quaternion",
       .caught_by = {"initial_state_reads_back"},
       .read = [](const Witness&, std::span<BodyState> states) {
         for (BodyState& s : states) s.q_WB = s.q_WB.conjugate();
       }});
  add({.name = "takes and gives the conjugate quaternion",
       .caught_by = {"spin_turns_right_handed"},
       .build =
           [](Scenario& s) {
             for (Body& body : s.bodies) body.initial.q_WB = body.initial.q_WB.conjugate();
           },
       .read =
           [](const Witness&, std::span<BodyState> states) {
             for (BodyState& s : states) s.q_WB = s.q_WB.conjugate();
           }});
  add({.name = "lets quaternions grow",
       .caught_by = {"spin_turns_right_handed"},
       .read = [](const Witness& witness, std::span<BodyState> states) {
         for (BodyState& s : states) s.q_WB.coeffs() *= 1 + 1e-3 * witness.time;
       }});
  add({.name = "keeps angular velocities in body axes",
       .caught_by = {"angular_velocity_is_in_world_axes"},
       .build =
           [](Scenario& s) {
             for (Body& body : s.bodies) body.initial.w_WB = body.initial.q_WB * body.initial.w_WB;
           },
       .read =
           [](const Witness&, std::span<BodyState> states) {
             for (BodyState& s : states) s.w_WB = s.q_WB.conjugate() * s.w_WB;
           }});
  add({.name = "leaves out the gyroscopic term",
       .caught_by = {"free_body_keeps_its_angular_momentum"},
       .scheme = [](Scheme& scheme) { scheme.gyroscopic = GyroscopicTerm::kNone; }});
  add({.name = "stays in its plane, though it is no planar engine",
       .caught_by = {"motion_across_the_plane"},
       .read = [](const Witness& witness, std::span<BodyState> states) {
         for (std::size_t i = 0; i < states.size(); ++i) {
           states[i].p_WB.y() = witness.stated.bodies[i].initial.p_WB.y();
         }
       }});
  add({.name = "steps by its own clock", .caught_by = {"a_step_lasts_dt"}, .step = [](const Witness&, double dt) {
         return dt > 0 ? 1.0 / 64 : dt;
       }});
  add({.name = "lists its bodies backwards",
       .caught_by = {"bodies_keep_their_order", "forces_go_to_their_body"},
       .read = [](const Witness&, std::span<BodyState> states) { std::ranges::reverse(states); }});

  add({.name = "turns gravity round", .caught_by = {"gravity_pulls_where_it_is_stated"}, .build = [](Scenario& s) {
         s.gravity = -s.gravity;
       }});
  add({.name = "lets gravity point down, wherever it is stated to",
       .caught_by = {"gravity_pulls_where_it_is_stated"},
       .build = [](Scenario& s) { s.gravity = Vec3(0, 0, -s.gravity.norm()); }});
  add({.name = "replaces gravity by the force",
       .caught_by = {"forces_add_to_gravity"},
       .apply = [](const Witness& witness, std::span<const BodyState>, std::span<Wrench> w) {
         for (std::size_t i = 0; i < w.size(); ++i) {
           if (w[i].f_W.norm() > 0) w[i].f_W -= witness.stated.bodies[i].mass * witness.stated.gravity;
         }
       }});
  add({.name = "keeps a force until the next",
       .caught_by = {"force_and_torque_last_one_step"},
       .keeps_wrenches = true});
  add({.name = "pushes the next body",
       .caught_by = {"forces_go_to_their_body"},
       .apply = [](const Witness&, std::span<const BodyState>, std::span<Wrench> w) {
         std::rotate(w.begin(), w.begin() + 1, w.end());
       }});
  add({.name = "pushes along body axes",
       .caught_by = {"wrenches_are_in_world_axes"},
       .apply = [](const Witness&, std::span<const BodyState> states, std::span<Wrench> w) {
         for (std::size_t i = 0; i < w.size(); ++i) w[i].f_W = states[i].q_WB * w[i].f_W;
       }});
  add({.name = "turns along body axes",
       .caught_by = {"wrenches_are_in_world_axes"},
       .apply = [](const Witness&, std::span<const BodyState> states, std::span<Wrench> w) {
         for (std::size_t i = 0; i < w.size(); ++i) w[i].tau_W = states[i].q_WB * w[i].tau_W;
       }});
  add({.name = "turns torques round",
       .caught_by = {"torque_turns_right_handed", "torque_echoes_the_inertia"},
       .apply = [](const Witness&, std::span<const BodyState>, std::span<Wrench> w) {
         for (Wrench& wrench : w) wrench.tau_W = -wrench.tau_W;
       }});
  add({.name = "puts slow bodies to sleep",
       .caught_by = {"slow_bodies_stay_awake"},
       .step = [](const Witness& witness, double dt) {
         const bool slow =
             std::ranges::all_of(witness.stated.bodies, [](const Body& b) { return b.initial.v_WB.norm() < 2e-3; });
         return slow && witness.stated.gravity.isZero() && witness.time > 0.5 ? 0.0 : dt;
       }});

  add({.name = "lets all bodies collide",
       .caught_by = {"without_material_bodies_pass_through"},
       .build = [](Scenario& s) {
         if (!s.contact && s.bodies.size() == 4 && s.bodies[0].fixed) s.contact = ContactMaterial{1, 0};
       }});
  add({.name = "collides boxes along the world's axes",
       .caught_by = {"box_collides_in_its_attitude"},
       .build = [](Scenario& s) {
         for (Body& body : s.bodies) {
           if (s.contact && std::holds_alternative<Box>(body.shape)) body.initial.q_WB = Quat::Identity();
         }
       }});
  add({.name = "turns everything the other way, and agrees with itself",
       .caught_by = {"spinning_ball_rolls_away"},
       .build =
           [](Scenario& s) {
             for (Body& body : s.bodies) {
               body.initial.q_WB = body.initial.q_WB.conjugate();
               body.initial.w_WB = -body.initial.w_WB;
             }
           },
       .apply =
           [](const Witness&, std::span<const BodyState>, std::span<Wrench> w) {
             for (Wrench& wrench : w) wrench.tau_W = -wrench.tau_W;
           },
       .read =
           [](const Witness&, std::span<BodyState> states) {
             for (BodyState& s : states) {
               s.q_WB = s.q_WB.conjugate();
               s.w_WB = -s.w_WB;
             }
           }});
  add({.name = "multiplies the restitution of both bodies",
       .caught_by = {"restitution_of_the_pair", "half_space_stands_where_stated"},
       .build = [](Scenario& s) {
         if (s.contact) s.contact->restitution *= s.contact->restitution;
       }});
  add({.name = "lets slow impacts have no restitution",
       .caught_by = {"restitution_of_the_pair"},
       .build = [](Scenario& s) {
         const bool slow = std::ranges::all_of(s.bodies, [](const Body& b) { return b.initial.v_WB.norm() < 0.1; });
         if (s.contact && slow) s.contact->restitution = 0;
       }});
  add({.name = "puts every half-space through the origin",
       .caught_by = {"half_space_stands_where_stated"},
       .build = [](Scenario& s) {
         for (Body& body : s.bodies) {
           if (std::holds_alternative<HalfSpace>(body.shape)) body.initial.p_WB.setZero();
         }
       }});
  add({.name = "turns half-spaces by their attitude",
       .caught_by = {"half_space_stands_where_stated"},
       .build = [](Scenario& s) {
         for (Body& body : s.bodies) {
           if (auto* half = std::get_if<HalfSpace>(&body.shape)) half->normal = body.initial.q_WB * half->normal;
         }
       }});
  add({.name = "moves fixed bodies that are hit",
       .caught_by = {"fixed_bodies_send_others_back"},
       .build = [](Scenario& s) {
         for (Body& body : s.bodies) body.fixed = body.fixed && !std::holds_alternative<Sphere>(body.shape);
       }});
  add({.name = "multiplies the friction of both bodies",
       .caught_by = {"friction_of_the_pair"},
       .build = [](Scenario& s) {
         if (s.contact) s.contact->friction *= s.contact->friction;
       }});
  add({.name = "has a pyramid for a friction cone", .caught_by = {"friction_is_a_cone"}, .build = [](Scenario& s) {
         if (!s.contact || s.bodies.size() != 2) return;
         const Vec3& v = s.bodies[1].initial.v_WB;
         if (v.norm() > 0) s.contact->friction *= v.head<2>().lpNorm<1>() / v.norm();
       }});
  add({.name = "knows only some corners of a box", .caught_by = {"box_lands_flat"}, .build = [](Scenario& s) {
         for (Body& body : s.bodies) {
           if (s.contact && std::holds_alternative<Box>(body.shape)) body.initial.w_WB += Vec3(0, 0.05, 0);
         }
       }});

  add({.name = "hangs bodies by their centre",
       .caught_by = {"ball_joint_moves_as_stated", "hinge_moves_as_stated"},
       .build = [](Scenario& s) {
         each_joint(s, [&](Joint& j, const std::vector<BodyState>& states) {
           if (j.kind != JointKind::kBall && j.kind != JointKind::kHinge) return;
           s.bodies[j.b].initial.v_WB.setZero();
           j = joint_at(j.kind, j.a, j.b, states, states[j.b].p_WB, states[j.b].q_WB * j.on_b.axis());
         });
       }});
  add({.name = "takes the x axis of a joint's frame",
       .caught_by = {"hinge_moves_as_stated", "slider_moves_as_stated"},
       .build = [](Scenario& s) {
         each_joint(s, [](Joint& j, const std::vector<BodyState>&) {
           const Quat x_for_z(rotation_by(Vec3(0, std::acos(0.0), 0)));
           j.on_a.attitude = j.on_a.attitude * x_for_z;
           j.on_b.attitude = j.on_b.attitude * x_for_z;
         });
       }});
  add({.name = "makes hinges of sliders", .caught_by = {"slider_moves_as_stated"}, .build = [](Scenario& s) {
         each_joint(s, [](Joint& j, const std::vector<BodyState>&) {
           if (j.kind == JointKind::kSlider) j.kind = JointKind::kHinge;
         });
       }});
  add({.name = "makes fixed joints of balls", .caught_by = {"ball_joint_moves_as_stated"}, .build = [](Scenario& s) {
         each_joint(s, [](Joint& j, const std::vector<BodyState>&) {
           if (j.kind == JointKind::kBall) j.kind = JointKind::kFixed;
         });
       }});
  add({.name = "forgets fixed joints", .caught_by = {"fixed_joint_moves_as_stated"}, .build = [](Scenario& s) {
         drop_joints(s, JointKind::kFixed);
       }});
  add({.name = "forgets rods", .caught_by = {"distance_joint_moves_as_stated"}, .build = [](Scenario& s) {
         drop_joints(s, JointKind::kDistance);
       }});
  add({.name = "makes rods a tenth longer", .caught_by = {"distance_joint_moves_as_stated"}, .build = [](Scenario& s) {
         for (Joint& j : s.joints) j.length *= 1.1;
       }});
  add({.name = "snaps axes to those of the world", .caught_by = {"axis_may_be_oblique"}, .build = [](Scenario& s) {
         each_joint(s, [](Joint& j, const std::vector<BodyState>& states) {
           if (j.kind != JointKind::kHinge || j.a != kWorld) return;
           const Vec3 axis_W = states[j.b].q_WB * j.on_b.axis(), anchor_W = j.on_a.anchor;
           Eigen::Index largest = 0;
           axis_W.cwiseAbs().maxCoeff(&largest);
           j = joint_at(j.kind, j.a, j.b, states, anchor_W, Vec3::Unit(largest));
         });
       }});
  add({.name = "mixes up the two bodies of a joint",
       .caught_by = {"either_body_may_come_first"},
       .build = [](Scenario& s) {
         for (Joint& j : s.joints) {
           if (j.a != kWorld && j.a > j.b) std::swap(j.on_a, j.on_b);
         }
       }});
  add({.name = "nails the first body of a joint to the world",
       .caught_by = {"joints_keep_momentum", "either_body_may_come_first"},
       .build = [](Scenario& s) {
         each_joint(s, [](Joint& j, const std::vector<BodyState>& states) {
           if (j.a == kWorld) return;
           const BodyState& a = states[j.a];
           j.on_a = {a.p_WB + a.q_WB * j.on_a.anchor, a.q_WB * j.on_a.attitude};
           j.a = kWorld;
         });
       }});
  add({.name = "drives joined bodies apart where they overlap",
       .caught_by = {"joined_bodies_do_not_collide"},
       .read = [](const Witness& witness, std::span<BodyState> states) {
         if (witness.stated.joints.empty() || !overlaps(witness.stated) || witness.time == 0) return;
         states[0].v_WB.x() -= 1e-3;
         states[1].v_WB.x() += 1e-3;
       }});

  add({.name = "rolls dice", .caught_by = {"same_run_same_bits"}, .build = [](Scenario& s) {
         for (Body& body : s.bodies) body.initial.v_WB *= 1 + 1e-12 * (++worlds_built % 1000);
       }});
  add({.name = "shares a clock between worlds",
       .caught_by = {"two_worlds_do_not_mix"},
       .build = [](Scenario&) { steps_of_all = 0; },
       .step = [](const Witness&, double dt) { return dt * (1 + 1e-12 * (++steps_of_all % 2)); }});
  add({.name = "frees what other worlds still use",
       .caught_by = {"worlds_outlive_each_other"},
       .step = [](const Witness& witness, double dt) { return dt * (buried > witness.buried ? 1 + 1e-12 : 1); }});
  add({.name = "is disturbed by being read",
       .caught_by = {"reading_disturbs_nothing"},
       .step = [](const Witness& witness, double dt) { return dt * (witness.looked ? 1 + 1e-12 : 1); }});

  add({.name = "builds whatever it is told",
       .caught_by = {"impossible_bodies_are_refused"},
       .build =
           [](Scenario& s) {
             for (Body& body : s.bodies) {
               if (!(body.mass > 0 && std::isfinite(body.mass))) body.mass = 1;
             }
           },
       .door_is_open = true});
  add({.name = "swallows NaN",
       .caught_by = {"force_that_is_nan_shows"},
       .apply = [](const Witness&, std::span<const BodyState>, std::span<Wrench> w) {
         for (Wrench& wrench : w) {
           if (!wrench.f_W.allFinite()) wrench.f_W.setZero();
         }
       }});
  add({.name = "takes a step of its own for one of zero",
       .caught_by = {"step_of_zero_moves_nothing"},
       .step = [](const Witness&, double dt) { return dt > 0 ? dt : 1.0 / 60; }});
  add({.name = "drives coincident bodies the same way",
       .caught_by = {"coincident_bodies_stay_finite"},
       .build =
           [](Scenario& s) {
             if (s.joints.empty() && overlaps(s)) s.contact.reset();
           },
       .read =
           [](const Witness& witness, std::span<BodyState> states) {
             if (!witness.stated.joints.empty() || !overlaps(witness.stated) || witness.time == 0) return;
             for (BodyState& s : states) s.v_WB.x() += 0.1;
           }});
  add({.name = "divides by the distance of coincident bodies",
       .caught_by = {"coincident_bodies_stay_finite"},
       .build =
           [](Scenario& s) {
             if (s.joints.empty() && overlaps(s)) s.contact.reset();
           },
       .read =
           [](const Witness& witness, std::span<BodyState> states) {
             if (!witness.stated.joints.empty() || !overlaps(witness.stated) || witness.time == 0) return;
             for (BodyState& s : states) s.v_WB /= (states[0].p_WB - states[1].p_WB).norm();
           }});
  add({.name = "slows fast bodies down", .caught_by = {"huge_speed_is_kept"}, .build = [](Scenario& s) {
         for (Body& body : s.bodies) {
           if (body.initial.v_WB.norm() > 120) body.initial.v_WB *= 120 / body.initial.v_WB.norm();
         }
       }});
  append_spring_lies(all);
  append_lies_about_stops_and_cylinders(all);
  return all;
}

}  // namespace

std::unique_ptr<Engine> lying_engine(const Lie& lie) { return std::make_unique<LyingEngine>(lie); }

std::unique_ptr<World> build_lying(const Lie& lie, const Engine& engine, const Scenario& scenario,
                                   const Settings& settings) {
  if (!lie.door_is_open) return engine.build(scenario, settings);
  return static_cast<const LyingEngine&>(engine).create(scenario, settings);
}

Lie honest() { return {.name = "honest", .caught_by = {}}; }

Lie honest_in_the_plane() {
  return {.name = "honest in the plane",
          .caught_by = {},
          .describe =
              [](EngineInfo& info) {
                info.features = info.features.without({Feature::kSpatial});
                info.dimension = 2;
              },
          .build =
              [](Scenario& s) {
                for (Body& body : s.bodies) body.initial.v_WB.y() = 0;
              }};
}

const std::vector<Lie>& lies() {
  static const std::vector<Lie> all = every_lie();
  return all;
}

}  // namespace plumbline::testing_support
