// Six scenes on Bullet's own API, rigid bodies: raw_bullet_f32 or raw_bullet_f64 ROW CASE PROFILE DT FILE writes the
// trajectory to FILE. The row is that of the precision it was compiled for.
#include <btBulletDynamicsCommon.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace {

const double g = 9.81;
const bool kDouble = sizeof(btScalar) == sizeof(double);

btVector3 vec(double x, double y, double z) { return btVector3(btScalar(x), btScalar(y), btScalar(z)); }

struct Scene {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
  bool matched;
  std::vector<std::string> names;
  std::vector<std::unique_ptr<btCollisionShape>> shapes;
  std::vector<std::unique_ptr<btRigidBody>> bodies;
  std::vector<std::unique_ptr<btTypedConstraint>> joints;
  std::function<void()> push = [] {};  // what acts at the start of a step
  double duration = 0;

  explicit Scene(bool is_matched) : matched(is_matched) {
    world.setGravity(vec(0, 0, 0));
    if (!matched) return;  // all else is as Bullet has it
    configuration.setPlaneConvexMultipointIterations(4, 4);
    btContactSolverInfo& info = world.getSolverInfo();
    info.m_numIterations = 50;
    info.m_restitutionVelocityThreshold = 0;
    info.m_splitImpulsePenetrationThreshold = 0;
  }
  ~Scene() {
    for (const auto& joint : joints) world.removeConstraint(joint.get());
    for (const auto& body : bodies) world.removeRigidBody(body.get());
  }

  btRigidBody* add(const char* name, std::unique_ptr<btCollisionShape> shape, double mass, const btVector3& inertia,
                   const btVector3& p) {
    btRigidBody::btRigidBodyConstructionInfo info(btScalar(mass), nullptr, shape.get(), inertia);
    info.m_startWorldTransform.setOrigin(p);
    info.m_friction = 0;
    bodies.push_back(std::make_unique<btRigidBody>(info));
    btRigidBody* body = bodies.back().get();
    if (matched) {
      body->setContactProcessingThreshold(0);
      if (mass > 0) body->setActivationState(DISABLE_DEACTIVATION);
    }
    world.addRigidBody(body);
    names.push_back(name);
    shapes.push_back(std::move(shape));
    return body;
  }
  btRigidBody* add_box(const char* name, double m, double a, double b, double c, const btVector3& p) {
    const double k = m / 12.0;
    return add(name, std::make_unique<btBoxShape>(vec(0.5 * a, 0.5 * b, 0.5 * c)), m,
               vec(k * (b * b + c * c), k * (c * c + a * a), k * (a * a + b * b)), p);
  }
  btRigidBody* add_sphere(const char* name, double m, double r, const btVector3& p) {
    const double i = 0.4 * m * r * r;
    return add(name, std::make_unique<btSphereShape>(btScalar(r)), m, vec(i, i, i), p);
  }
};

void falling_box(Scene& scene) {
  btRigidBody* box = scene.add_box("box", 1, 1, 1, 1, vec(0, 0, 5));
  box->setLinearVelocity(vec(2, 1, 3));
  scene.push = [box] { box->applyCentralForce(vec(0, 0, -9.8)); };
  scene.duration = 2;
}

void drag_ship(Scene& scene) {
  const double m = 1000, T = 5000, c = 250;
  scene.world.setGravity(vec(0, 0, -g));
  btRigidBody* ship = scene.add_box("ship", m, 20, 6, 4, vec(0, 0, 0));
  ship->setLinearVelocity(vec(30, 0, 0));
  scene.push = [=] { ship->applyCentralForce(vec(T - c * double{ship->getLinearVelocity().x()}, 0, m * g)); };
  scene.duration = m / c;
}

void two_sphere(Scene& scene) {
  btRigidBody* one = scene.add_sphere("one", 2, 0.5, vec(0, 0, 0));
  btRigidBody* two = scene.add_sphere("two", 1, 0.3, vec(3.12, 0, 0.48));
  one->setLinearVelocity(vec(2, 0, 0));
  two->setLinearVelocity(vec(-1, 0, 0));
  one->setRestitution(1);  // Bullet multiplies the two
  two->setRestitution(btScalar(0.5));
  scene.duration = 1.5;
}

void free_rotation(Scene& scene) {
  scene.add_box("box", 10, 0.1, 0.4, 0.9, vec(0, 0, 0))->setAngularVelocity(vec(0.1, 5, 0.1));
  scene.duration = 1;
}

void pendulum(Scene& scene) {
  scene.world.setGravity(vec(0, 0, -g));
  btRigidBody* bob = scene.add_sphere("bob", 1, 0.1, vec(1, 0, 0));
  // A quarter turn about -x: Bullet's hinges turn about z of their frames, this one about y.
  const btQuaternion turn(btScalar(-1 / std::sqrt(2.0)), 0, 0, btScalar(std::sqrt(2.0) / 2));
  scene.joints.push_back(std::make_unique<btHingeConstraint>(
      btTypedConstraint::getFixedBody(), *bob, btTransform(turn, vec(0, 0, 0)), btTransform(turn, vec(-1, 0, 0))));
  scene.world.addConstraint(scene.joints.back().get());
  scene.duration = 2;
}

void incline(Scene& scene) {
  const double slope = 20 * M_PI / 180;
  scene.world.setGravity(vec(g * std::sin(slope), 0, -g * std::cos(slope)));
  auto plane = std::make_unique<btStaticPlaneShape>(vec(0, 0, 1), btScalar(0));
  scene.add("ground", std::move(plane), 0, vec(0, 0, 0), vec(0, 0, 0))->setFriction(1);  // Bullet multiplies the two
  scene.add_box("box", 10, 1, 1, 0.5, vec(0, 0, 0.25))->setFriction(btScalar(0.2));
  scene.duration = 2;
}

const std::map<std::string, void (*)(Scene&)> kScenes = {{"particle/falling_box", falling_box},
                                                         {"particle/drag_ship/v0=30", drag_ship},
                                                         {"collision/two_sphere/e=0.5,b=0.48", two_sphere},
                                                         {"rotation/free_rotation", free_rotation},
                                                         {"joint/pendulum", pendulum},
                                                         {"friction/incline/mu=0.2", incline}};

void write(std::FILE* file, double t, const Scene& scene) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const btRigidBody& body = *scene.bodies[i];
    const btVector3 &p = body.getWorldTransform().getOrigin(), &v = body.getLinearVelocity(),
                    &w = body.getAngularVelocity();
    const btQuaternion rotation = body.getWorldTransform().getRotation();
    // Made a unit in double precision: what comes from a matrix of floats is one to 1e-7 only.
    double q[4] = {rotation.w(), rotation.x(), rotation.y(), rotation.z()};
    const double norm = std::sqrt((q[1] * q[1] + q[3] * q[3]) + (q[2] * q[2] + q[0] * q[0]));
    for (double& x : q) x /= norm;
    std::fprintf(file, "%.17g,%s,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", t,
                 scene.names[i].c_str(), double{p.x()}, double{p.y()}, double{p.z()}, q[0], q[1], q[2], q[3],
                 double{v.x()}, double{v.y()}, double{v.z()}, double{w.x()}, double{w.y()}, double{w.z()});
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string row = argc > 1 ? argv[1] : "", name = argc > 2 ? argv[2] : "", profile = argc > 3 ? argv[3] : "";
  const double dt = argc > 4 ? std::atof(argv[4]) : 0;
  const std::string only_row = kDouble ? "bullet-f64" : "bullet-f32";
  if (argc != 6 || row != only_row || kScenes.count(name) == 0 || (profile != "default" && profile != "matched") ||
      !(dt > 0)) {
    std::fprintf(stderr, "usage: raw_bullet %s CASE default|matched DT FILE, with CASE one of\n", only_row.c_str());
    for (const auto& scene : kScenes) std::fprintf(stderr, "  %s\n", scene.first.c_str());
    return 2;
  }
  std::FILE* file = std::fopen(argv[5], "w");
  if (file == nullptr) {
    std::fprintf(stderr, "cannot write %s\n", argv[5]);
    return 2;
  }
  Scene scene(profile == "matched");
  kScenes.at(name)(scene);
  std::fprintf(file, "t,body,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz\n");
  write(file, 0, scene);
  const int steps = static_cast<int>(std::floor(scene.duration / dt * (1 + 1e-9)));
  for (int k = 1; k <= steps; ++k) {
    scene.push();
    scene.world.stepSimulation(btScalar(dt), 0);
    write(file, k * dt, scene);
  }
  std::fclose(file);
}
