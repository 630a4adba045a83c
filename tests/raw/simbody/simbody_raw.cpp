// Six cases written for Simbody alone, as somebody would who knows nothing but its manual.
//
//   raw_simbody ROW CASE PROFILE DT FILE
//
// simbody-rigid: conditional constraints and the semi-explicit Euler time stepper. simbody-compliant: contact surfaces
// with Hunt and Crossley's law, and an integrator with error control.
#include <Simbody.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace {

using namespace SimTK;

struct Member {
  std::string name;
  MobilizedBodyIndex mobod;  // invalid: fixed, and at the origin
};

struct Scene {
  bool rigid = false;
  double duration = 0;
  MultibodySystem system;
  SimbodyMatterSubsystem matter{system};
  GeneralForceSubsystem forces{system};
  Force::DiscreteForces pushes{forces, matter};
  std::unique_ptr<ContactTrackerSubsystem> tracker;
  std::unique_ptr<CompliantContactSubsystem> compliant;
  double stiffness = 0, dissipation = 0;
  std::vector<Member> members;
  std::function<void(State&)> start = [](State&) {};
  std::function<Vec3(const State&)> push;  // the force on the only body, evaluated before every step; none: no forces
};

MobilizedBody& add_free(Scene& scene, const char* name, double mass, const Vec3& inertia) {
  MobilizedBody::Free mobod(scene.matter.Ground(), Body::Rigid(MassProperties(mass, Vec3(0), Inertia(inertia))));
  scene.members.push_back({name, mobod.getMobilizedBodyIndex()});
  return scene.matter.updMobilizedBody(mobod.getMobilizedBodyIndex());
}

Vec3 brick_inertia(double m, double a, double b, double c) {
  return Vec3(m / 12.0 * (b * b + c * c), m / 12.0 * (a * a + c * c), m / 12.0 * (a * a + b * b));
}

void place(State& state, const MobilizedBody& mobod, const Vec3& p, const Vec3& v, const Vec3& w = Vec3(0)) {
  mobod.setQToFitTransform(state, Transform(p));
  mobod.setUToFitVelocity(state, SpatialVec(w, v));
}

void falling_box(Scene& scene) {
  const double m = 1, f = 9.8;
  scene.duration = 2;
  Force::UniformGravity(scene.forces, scene.matter, Vec3(0));
  const MobilizedBody& box = add_free(scene, "box", m, brick_inertia(m, 1, 1, 1));
  scene.start = [box](State& state) { place(state, box, Vec3(0, 0, 5), Vec3(2, 1, 3)); };
  scene.push = [=](const State&) { return Vec3(0, 0, -f); };
}

void drag_ship(Scene& scene) {
  const double m = 1000, T = 5000, c = 250, g = 9.81;
  scene.duration = m / c;
  Force::UniformGravity(scene.forces, scene.matter, Vec3(0, 0, -g));
  const MobilizedBody& ship = add_free(scene, "ship", m, brick_inertia(m, 20, 6, 4));
  scene.start = [ship](State& state) { place(state, ship, Vec3(0), Vec3(30, 0, 0)); };
  scene.push = [=](const State& state) { return Vec3(T - c * ship.getBodyOriginVelocity(state)[0], 0, m * g); };
}

void two_sphere(Scene& scene) {
  const double e = 0.5, r1 = 0.5, r2 = 0.3;
  scene.duration = 1.5;
  Force::UniformGravity(scene.forces, scene.matter, Vec3(0));
  const double i1 = 0.4 * 2 * r1 * r1, i2 = 0.4 * 1 * r2 * r2;
  MobilizedBody& one = add_free(scene, "one", 2, Vec3(i1));
  MobilizedBody& two = add_free(scene, "two", 1, Vec3(i2));
  scene.matter.adoptUnilateralContact(new SphereSphereContact(one, Vec3(0), r1, two, Vec3(0), r2, e, 0, 0, 0));
  scene.start = [one, two](State& state) {
    place(state, one, Vec3(0), Vec3(2, 0, 0));
    place(state, two, Vec3(3.12, 0, 0.48), Vec3(-1, 0, 0));
  };
}

void free_rotation(Scene& scene) {
  scene.duration = 1;
  Force::UniformGravity(scene.forces, scene.matter, Vec3(0));
  const MobilizedBody& box = add_free(scene, "box", 10, brick_inertia(10, 0.1, 0.4, 0.9));
  scene.start = [box](State& state) { place(state, box, Vec3(0), Vec3(0), Vec3(0.1, 5, 0.1)); };
}

void pendulum(Scene& scene) {
  scene.duration = 2;
  Force::UniformGravity(scene.forces, scene.matter, Vec3(0, 0, -9.81));
  // A pin turns about z: this frame has its z along the world's y.
  const double s = std::sqrt(2.0);
  const Rotation axes(Quaternion(s / 2, -1 / s, 0, 0));
  const double inertia = 0.4 * 1 * 0.1 * 0.1;
  MobilizedBody::Pin bob(scene.matter.Ground(), Transform(axes),
                         Body::Rigid(MassProperties(1, Vec3(0), Inertia(Vec3(inertia)))),
                         Transform(axes, Vec3(-1, 0, 0)));
  scene.members.push_back({"bob", bob.getMobilizedBodyIndex()});
}

void incline(Scene& scene) {
  const double g = 9.81, slope = 20 * Pi / 180, m = 10, a = 1, h = 0.5, mu = 0.2;
  scene.duration = 2;
  Force::UniformGravity(scene.forces, scene.matter, Vec3(g * std::sin(slope), 0, -g * std::cos(slope)));
  scene.members.push_back({"ground", MobilizedBodyIndex()});
  MobilizedBody& box = add_free(scene, "box", m, brick_inertia(m, a, a, h));
  if (scene.rigid) {
    for (const double x : {-a / 2, a / 2}) {
      for (const double y : {-a / 2, a / 2}) {
        for (const double z : {-h / 2, h / 2}) {
          scene.matter.adoptUnilateralContact(
              new PointPlaneContact(scene.matter.Ground(), UnitVec3(ZAxis), 0, box, Vec3(x, y, z), 0, mu, mu, 0));
        }
      }
    }
  } else {
    const ContactMaterial material(scene.stiffness, scene.dissipation, mu, mu);
    // The half-space of Simbody fills x > 0.
    scene.matter.Ground().updBody().addContactSurface(Transform(Rotation(UnitVec3(Vec3(0, 0, -1)), XAxis)),
                                                      ContactSurface(ContactGeometry::HalfSpace(), material));
    box.updBody().addContactSurface(Transform(),
                                    ContactSurface(ContactGeometry::Brick(Vec3(a / 2, a / 2, h / 2)), material));
  }
  scene.start = [box, h](State& state) { place(state, box, Vec3(0, 0, h / 2), Vec3(0)); };
}

void write_sample(std::FILE* file, const Scene& scene, const State& state, double t) {
  for (const Member& member : scene.members) {
    double x[13] = {0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    if (member.mobod.isValid()) {
      const MobilizedBody& mobod = scene.matter.getMobilizedBody(member.mobod);
      const Vec3 p = mobod.getBodyOriginLocation(state), v = mobod.getBodyOriginVelocity(state);
      const Vec3 w = mobod.getBodyAngularVelocity(state);
      const Quaternion q = mobod.getBodyRotation(state).convertRotationToQuaternion();
      for (int i = 0; i < 3; ++i) x[i] = p[i], x[7 + i] = v[i], x[10 + i] = w[i];
      for (int i = 0; i < 4; ++i) x[3 + i] = q[i];
    }
    std::fprintf(file, "%.17g,%s", t, member.name.c_str());
    for (const double number : x) std::fprintf(file, ",%.17g", number);
    std::fprintf(file, "\n");
  }
}

// The force holds for one step only.
void push(const Scene& scene, State& state, bool on) {
  const Vec3 force = on ? scene.push(state) : Vec3(0);
  scene.pushes.setOneBodyForce(state, scene.matter.getMobilizedBody(MobilizedBodyIndex(1)), SpatialVec(Vec3(0), force));
}

// Contacts that still penetrate are taken apart; those that do not are left alone.
void project(const Scene& scene, State& state, double tolerance) {
  std::vector<UnilateralContactIndex> apart;
  bool deep = false;
  for (UnilateralContactIndex k(0); k < scene.matter.getNumUnilateralContacts(); ++k) {
    const UnilateralContact& contact = scene.matter.getUnilateralContact(k);
    if (!contact.isEnabled(state)) continue;
    if (contact.getPerr(state) < -tolerance) {
      deep = true;
    } else {
      apart.push_back(k);
    }
  }
  if (!deep) return;
  for (const UnilateralContactIndex k : apart) scene.matter.getUnilateralContact(k).disable(state);
  scene.system.realize(state, Stage::Position);
  scene.system.projectQ(state, tolerance);
  scene.system.realize(state, Stage::Velocity);
}

void run_rigid(Scene& scene, bool matched, double dt, std::FILE* file) {
  SemiExplicitEulerTimeStepper stepper(scene.system);
  const double tolerance = matched ? 1e-9 : 1e-3;
  stepper.setConstraintTolerance(tolerance);
  if (matched) {
    stepper.setRestitutionModel(SemiExplicitEulerTimeStepper::Newton);
    stepper.setImpulseSolverType(SemiExplicitEulerTimeStepper::PGS);
    PGSImpulseSolver* solver = new PGSImpulseSolver(2 * tolerance);
    solver->setConvergenceTol(1e-12);
    solver->setMaxIterations(1000);
    stepper.setImpulseSolver(solver);
  }
  State state = scene.system.realizeTopology();
  scene.system.realizeModel(state);
  scene.start(state);
  stepper.initialize(state);
  write_sample(file, scene, stepper.getState(), 0);
  const int steps = static_cast<int>(std::floor(scene.duration / dt + 1e-9));
  for (int k = 1; k <= steps; ++k) {
    if (scene.push) push(scene, stepper.updState(), true);
    stepper.stepTo(stepper.getTime() + dt);
    if (matched) project(scene, stepper.updState(), tolerance);
    write_sample(file, scene, stepper.getState(), k * dt);
    if (scene.push) push(scene, stepper.updState(), false);
  }
}

void run_compliant(Scene& scene, bool matched, bool contact, double dt, std::FILE* file) {
  State state = scene.system.realizeTopology();
  scene.system.realizeModel(state);
  scene.start(state);
  std::unique_ptr<Integrator> integrator;
  if (contact && matched) {
    integrator.reset(new CPodesIntegrator(scene.system));
  } else {
    integrator.reset(new RungeKuttaMersonIntegrator(scene.system));
  }
  integrator->setAllowInterpolation(false);
  integrator->setAccuracy(matched ? 1e-9 : 1e-3);
  integrator->setConstraintTolerance(matched ? 1e-10 : 1e-4);
  TimeStepper stepper(scene.system, *integrator);
  stepper.initialize(state);
  write_sample(file, scene, integrator->getState(), 0);
  const int steps = static_cast<int>(std::floor(scene.duration / dt + 1e-9));
  for (int k = 1; k <= steps; ++k) {
    if (scene.push) {
      push(scene, integrator->updAdvancedState(), true);
      integrator->reinitialize(Stage::Dynamics, false);
    }
    stepper.stepTo(integrator->getTime() + dt);
    write_sample(file, scene, integrator->getState(), k * dt);
    if (scene.push) {
      push(scene, integrator->updAdvancedState(), false);
      integrator->reinitialize(Stage::Dynamics, false);
      scene.system.realize(integrator->getState(), Stage::Velocity);
    }
  }
}

struct Case {
  const char* name;
  void (*build)(Scene&);
  bool contact, restitution;
};
const Case kCases[] = {{"particle/falling_box", falling_box, false, false},
                       {"particle/drag_ship/v0=30", drag_ship, false, false},
                       {"collision/two_sphere/e=0.5,b=0.48", two_sphere, true, true},
                       {"rotation/free_rotation", free_rotation, false, false},
                       {"joint/pendulum", pendulum, false, false},
                       {"friction/incline/mu=0.2", incline, true, false}};

int usage() {
  std::fprintf(stderr,
               "raw_simbody ROW CASE PROFILE DT FILE\nROW: simbody-rigid, simbody-compliant\n"
               "PROFILE: default, matched\nCASE:\n");
  for (const Case& known : kCases) std::fprintf(stderr, "  %s\n", known.name);
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 6) return usage();
  const std::string row = argv[1], name = argv[2], profile = argv[3];
  if (row != "simbody-rigid" && row != "simbody-compliant") return usage();
  if (profile != "default" && profile != "matched") return usage();
  const double dt = std::strtod(argv[4], nullptr);
  if (!(dt > 0)) return usage();
  const bool rigid = row == "simbody-rigid", matched = profile == "matched";
  for (const Case& known : kCases) {
    if (name != known.name) continue;
    if (known.restitution && !rigid) return 77;  // e depends on the speed of the impact there
    std::FILE* file = std::fopen(argv[5], "w");
    if (file == nullptr) return std::perror(argv[5]), 1;
    std::fprintf(file, "t,body,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz\n");
    Scene scene;
    scene.rigid = rigid;
    if (!rigid) {
      scene.tracker.reset(new ContactTrackerSubsystem(scene.system));
      scene.compliant.reset(new CompliantContactSubsystem(scene.system, *scene.tracker));
      scene.compliant->setTransitionVelocity(matched ? 1e-4 : 0.01);
      scene.stiffness = 1e7;
      scene.dissipation = matched ? 1e6 : 1.0;
    }
    known.build(scene);
    if (rigid) {
      run_rigid(scene, matched, dt, file);
    } else {
      run_compliant(scene, matched, known.contact, dt, file);
    }
    return std::fclose(file) == 0 ? 0 : 1;
  }
  return usage();
}
