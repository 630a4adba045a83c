// Six scenes on Bullet's own API, articulated bodies: raw_bullet_multibody ROW CASE PROFILE DT FILE writes the
// trajectory to FILE. Free bodies are bases without links.
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
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

struct Sample {
  std::string name;
  btMultiBody* body;  // null: fixed, stands at the origin
};

struct Scene {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btMultiBodyConstraintSolver solver;
  btMultiBodyDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
  bool matched;
  std::vector<Sample> samples;
  std::vector<std::unique_ptr<btCollisionShape>> shapes;
  std::vector<std::unique_ptr<btMultiBody>> bodies;
  std::vector<std::unique_ptr<btMultiBodyLinkCollider>> colliders;
  std::unique_ptr<btRigidBody> ground;
  std::function<void()> push = [] {};  // what acts at the start of a step
  double duration = 0;

  explicit Scene(bool is_matched) : matched(is_matched) {
    world.setGravity(btVector3(0, 0, 0));
    if (!matched) return;  // all else is as Bullet has it
    configuration.setPlaneConvexMultipointIterations(4, 4);
    btContactSolverInfo& info = world.getSolverInfo();
    info.m_numIterations = 50;
    info.m_restitutionVelocityThreshold = 0;
    info.m_erp2 = 0;
  }
  ~Scene() {
    for (const auto& collider : colliders) world.removeCollisionObject(collider.get());
    for (const auto& body : bodies) world.removeMultiBody(body.get());
    if (ground) world.removeRigidBody(ground.get());
  }

  btMultiBody* add(const char* name, int links, double mass, const btVector3& inertia, bool fixed) {
    bodies.push_back(std::make_unique<btMultiBody>(links, mass, inertia, fixed, !matched));
    btMultiBody* body = bodies.back().get();
    samples.push_back({name, body});
    if (matched) {
      body->setLinearDamping(0);
      body->setAngularDamping(0);
      body->setMaxCoordinateVelocity(1e18);
    }
    return body;
  }
  btMultiBody* add_free(const char* name, std::unique_ptr<btCollisionShape> shape, double mass,
                        const btVector3& inertia, const btVector3& p) {
    btMultiBody* body = add(name, 0, mass, inertia, false);
    body->finalizeMultiDof();
    body->setBaseWorldTransform(btTransform(btQuaternion::getIdentity(), p));
    world.addMultiBody(body);
    colliders.push_back(std::make_unique<btMultiBodyLinkCollider>(body, -1));
    btMultiBodyLinkCollider* collider = colliders.back().get();
    collider->setCollisionShape(shape.get());
    collider->setWorldTransform(btTransform(btQuaternion::getIdentity(), p));
    collider->setFriction(0);
    if (matched) collider->setContactProcessingThreshold(0);
    world.addCollisionObject(collider, btBroadphaseProxy::DefaultFilter, btBroadphaseProxy::AllFilter);
    body->setBaseCollider(collider);
    shapes.push_back(std::move(shape));
    return body;
  }
  btMultiBody* add_box(const char* name, double m, double a, double b, double c, const btVector3& p) {
    const double k = m / 12.0;
    return add_free(name, std::make_unique<btBoxShape>(btVector3(0.5 * a, 0.5 * b, 0.5 * c)), m,
                    btVector3(k * (b * b + c * c), k * (c * c + a * a), k * (a * a + b * b)), p);
  }
  btMultiBody* add_sphere(const char* name, double m, double r, const btVector3& p) {
    const double i = 0.4 * m * r * r;
    return add_free(name, std::make_unique<btSphereShape>(r), m, btVector3(i, i, i), p);
  }
};

void falling_box(Scene& scene) {
  btMultiBody* box = scene.add_box("box", 1, 1, 1, 1, btVector3(0, 0, 5));
  box->setBaseVel(btVector3(2, 1, 3));
  scene.push = [box] { box->addBaseForce(btVector3(0, 0, -9.8)); };
  scene.duration = 2;
}

void drag_ship(Scene& scene) {
  const double m = 1000, T = 5000, c = 250;
  scene.world.setGravity(btVector3(0, 0, -g));
  btMultiBody* ship = scene.add_box("ship", m, 20, 6, 4, btVector3(0, 0, 0));
  ship->setBaseVel(btVector3(30, 0, 0));
  scene.push = [=] { ship->addBaseForce(btVector3(T - c * ship->getBaseVel().x(), 0, m * g)); };
  scene.duration = m / c;
}

void two_sphere(Scene& scene) {
  btMultiBody* one = scene.add_sphere("one", 2, 0.5, btVector3(0, 0, 0));
  btMultiBody* two = scene.add_sphere("two", 1, 0.3, btVector3(3.12, 0, 0.48));
  one->setBaseVel(btVector3(2, 0, 0));
  two->setBaseVel(btVector3(-1, 0, 0));
  one->getBaseCollider()->setRestitution(1);  // Bullet multiplies the two
  two->getBaseCollider()->setRestitution(0.5);
  scene.duration = 1.5;
}

void free_rotation(Scene& scene) {
  scene.add_box("box", 10, 0.1, 0.4, 0.9, btVector3(0, 0, 0))->setBaseOmega(btVector3(0.1, 5, 0.1));
  scene.duration = 1;
}

void pendulum(Scene& scene) {
  scene.world.setGravity(btVector3(0, 0, -g));
  const double i = 0.4 * 1 * 0.1 * 0.1;
  btMultiBody* arm = scene.add("bob", 1, 0, btVector3(0, 0, 0), true);
  // About +y, as z turned about x by a quaternion: to the last bit of that.
  arm->setupRevolute(0, 1, btVector3(i, i, i), -1, btQuaternion::getIdentity(), btVector3(0, 1, 0x1p-52),
                     btVector3(0, 0, 0), btVector3(1, 0, 0), true);
  arm->finalizeMultiDof();
  scene.world.addMultiBody(arm);
  scene.duration = 2;
}

void incline(Scene& scene) {
  const double slope = 20 * M_PI / 180;
  scene.world.setGravity(btVector3(g * std::sin(slope), 0, -g * std::cos(slope)));
  scene.shapes.push_back(std::make_unique<btStaticPlaneShape>(btVector3(0, 0, 1), 0));
  scene.ground = std::make_unique<btRigidBody>(0, nullptr, scene.shapes.back().get());
  scene.ground->setFriction(1);  // Bullet multiplies the two
  scene.world.addRigidBody(scene.ground.get());
  scene.samples.push_back({"ground", nullptr});
  scene.add_box("box", 10, 1, 1, 0.5, btVector3(0, 0, 0.25))->getBaseCollider()->setFriction(0.2);
  scene.duration = 2;
}

const std::map<std::string, void (*)(Scene&)> kScenes = {{"particle/falling_box", falling_box},
                                                         {"particle/drag_ship/v0=30", drag_ship},
                                                         {"collision/two_sphere/e=0.5,b=0.48", two_sphere},
                                                         {"rotation/free_rotation", free_rotation},
                                                         {"joint/pendulum", pendulum},
                                                         {"friction/incline/mu=0.2", incline}};

void write(std::FILE* file, double t, const Scene& scene) {
  for (const Sample& s : scene.samples) {
    btVector3 p(0, 0, 0), v(0, 0, 0), w(0, 0, 0);
    btQuaternion rotation = btQuaternion::getIdentity();
    if (s.body != nullptr && s.body->getNumLinks() == 0) {
      p = s.body->getBasePos();
      v = s.body->getBaseVel();
      w = s.body->getBaseOmega();
      rotation = s.body->getWorldToBaseRot().inverse();
    } else if (s.body != nullptr) {
      btVector3 v_local[2], w_local[2];  // of base and link, each in its own axes
      s.body->compTreeLinkVelocities(w_local, v_local);
      p = s.body->localPosToWorld(0, btVector3(0, 0, 0));
      v = s.body->localDirToWorld(0, v_local[1]);
      w = s.body->localDirToWorld(0, w_local[1]);
      rotation = (s.body->getParentToLocalRot(0) * s.body->getWorldToBaseRot()).inverse();
    }
    // Made a unit: Bullet's products of quaternions drift from one.
    double q[4] = {rotation.w(), rotation.x(), rotation.y(), rotation.z()};
    const double norm = std::sqrt((q[1] * q[1] + q[3] * q[3]) + (q[2] * q[2] + q[0] * q[0]));
    for (double& x : q) x /= norm;
    std::fprintf(file, "%.17g,%s,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", t,
                 s.name.c_str(), p.x(), p.y(), p.z(), q[0], q[1], q[2], q[3], v.x(), v.y(), v.z(), w.x(), w.y(), w.z());
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string row = argc > 1 ? argv[1] : "", name = argc > 2 ? argv[2] : "", profile = argc > 3 ? argv[3] : "";
  const double dt = argc > 4 ? std::atof(argv[4]) : 0;
  if (argc != 6 || row != "bullet-multibody" || kScenes.count(name) == 0 ||
      (profile != "default" && profile != "matched") || !(dt > 0)) {
    std::fprintf(stderr,
                 "usage: raw_bullet_multibody bullet-multibody CASE default|matched DT FILE, with CASE one of\n");
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
    scene.world.stepSimulation(dt, 0);
    write(file, k * dt, scene);
  }
  std::fclose(file);
}
