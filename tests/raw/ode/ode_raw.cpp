// Six scenes on ODE's own API: raw_ode ROW CASE PROFILE DT FILE writes the trajectory to FILE.
#include <ode/ode.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace {

const double g = 9.81;

struct Sample {
  std::string name;
  dBodyID body;  // null: fixed, stands at the origin
};

struct Scene {
  dWorldID world = nullptr;
  dSpaceID space = nullptr;
  dJointGroupID contacts = nullptr;
  std::vector<Sample> samples;
  std::function<void()> push = [] {};  // what acts at the start of a step
  double duration = 0;
  bool collide = false;
  double restitution = 0, friction = 0;
  bool matched = false;
};

dBodyID body_of(Scene& scene, const char* name, dGeomID shape, double m, double ix, double iy, double iz) {
  const dBodyID body = dBodyCreate(scene.world);
  dMass mass;
  dMassSetParameters(&mass, m, 0, 0, 0, ix, iy, iz, 0, 0, 0);
  dBodySetMass(body, &mass);
  dGeomSetBody(shape, body);
  scene.samples.push_back({name, body});
  return body;
}

dBodyID add_box(Scene& scene, const char* name, double m, double a, double b, double c) {
  const double k = m / 12.0;
  return body_of(scene, name, dCreateBox(scene.space, a, b, c), m, k * (b * b + c * c), k * (c * c + a * a),
                 k * (a * a + b * b));
}

dBodyID add_sphere(Scene& scene, const char* name, double m, double r) {
  const double i = 0.4 * m * r * r;
  return body_of(scene, name, dCreateSphere(scene.space, r), m, i, i, i);
}

void falling_box(Scene& scene) {
  const dBodyID box = add_box(scene, "box", 1, 1, 1, 1);
  dBodySetPosition(box, 0, 0, 5);
  dBodySetLinearVel(box, 2, 1, 3);
  scene.push = [box] { dBodyAddForce(box, 0, 0, -9.8); };
  scene.duration = 2;
}

void drag_ship(Scene& scene) {
  const double m = 1000, T = 5000, c = 250;
  const dBodyID ship = add_box(scene, "ship", m, 20, 6, 4);
  dBodySetLinearVel(ship, 30, 0, 0);
  dWorldSetGravity(scene.world, 0, 0, -g);
  scene.push = [=] { dBodyAddForce(ship, T - c * dBodyGetLinearVel(ship)[0], 0, m * g); };
  scene.duration = m / c;
}

void two_sphere(Scene& scene) {
  const dBodyID one = add_sphere(scene, "one", 2, 0.5), two = add_sphere(scene, "two", 1, 0.3);
  dBodySetLinearVel(one, 2, 0, 0);
  dBodySetPosition(two, 3.12, 0, 0.48);
  dBodySetLinearVel(two, -1, 0, 0);
  scene.collide = true;
  scene.restitution = 0.5;
  scene.duration = 1.5;
}

void free_rotation(Scene& scene) {
  const dBodyID box = add_box(scene, "box", 10, 0.1, 0.4, 0.9);
  dBodySetAngularVel(box, 0.1, 5, 0.1);
  scene.duration = 1;
}

void pendulum(Scene& scene) {
  const dBodyID bob = add_sphere(scene, "bob", 1, 0.1);
  dBodySetPosition(bob, 1, 0, 0);
  dWorldSetGravity(scene.world, 0, 0, -g);
  const dJointID hinge = dJointCreateHinge(scene.world, nullptr);
  dJointAttach(hinge, bob, nullptr);
  dJointSetHingeAnchor(hinge, 0, 0, 0);
  // +y, as z turned about x by a quaternion: to the last bit of that.
  dJointSetHingeAxis(hinge, 0, 1, 0x1p-52);
  scene.duration = 2;
}

void incline(Scene& scene) {
  const double slope = 20 * M_PI / 180;
  dCreatePlane(scene.space, 0, 0, 1, 0);
  scene.samples.push_back({"ground", nullptr});
  const dBodyID box = add_box(scene, "box", 10, 1, 1, 0.5);
  dBodySetPosition(box, 0, 0, 0.25);
  dWorldSetGravity(scene.world, g * std::sin(slope), 0, -g * std::cos(slope));
  scene.collide = true;
  scene.friction = 0.2;
  scene.duration = 2;
}

const std::map<std::string, void (*)(Scene&)> kScenes = {{"particle/falling_box", falling_box},
                                                         {"particle/drag_ship/v0=30", drag_ship},
                                                         {"collision/two_sphere/e=0.5,b=0.48", two_sphere},
                                                         {"rotation/free_rotation", free_rotation},
                                                         {"joint/pendulum", pendulum},
                                                         {"friction/incline/mu=0.2", incline}};

// Turns the friction pyramid's first axis to where body a slips over body b.
void align(dContact& contact, dBodyID a, dBodyID b) {
  const dReal *p = contact.geom.pos, *n = contact.geom.normal;
  dVector3 va = {}, vb = {};
  if (a != nullptr) dBodyGetPointVel(a, p[0], p[1], p[2], va);
  if (b != nullptr) dBodyGetPointVel(b, p[0], p[1], p[2], vb);
  const double v[3] = {va[0] - vb[0], va[1] - vb[1], va[2] - vb[2]};
  const auto length = [](const double* u) { return std::sqrt(u[0] * u[0] + (u[1] * u[1] + u[2] * u[2])); };
  const double normal = v[0] * n[0] + (v[1] * n[1] + v[2] * n[2]);
  const double slip[3] = {v[0] - normal * n[0], v[1] - normal * n[1], v[2] - normal * n[2]};
  if (length(slip) <= 1e-12 * (1 + length(v))) return;
  contact.surface.mode |= dContactFDir1;
  for (int i = 0; i < 3; ++i) contact.fdir1[i] = slip[i] / length(slip);
}

void near_callback(void* data, dGeomID first, dGeomID second) {
  const Scene& scene = *static_cast<Scene*>(data);
  const dBodyID a = dGeomGetBody(first), b = dGeomGetBody(second);
  dContact contacts[8] = {};
  const int count = dCollide(first, second, 8, &contacts[0].geom, sizeof(dContact));
  for (int i = 0; i < count; ++i) {
    dContact& contact = contacts[i];
    contact.surface.mode = dContactBounce;
    contact.surface.bounce = scene.restitution;
    contact.surface.bounce_vel = 0;
    contact.surface.mu = scene.friction;
    if (scene.matched) {
      contact.surface.mode |= dContactApprox1;
      align(contact, a, b);
    }
    dJointAttach(dJointCreateContact(scene.world, scene.contacts, &contact), a, b);
  }
}

void write(std::FILE* file, double t, const Scene& scene) {
  static const dReal zero[4] = {0, 0, 0, 0}, identity[4] = {1, 0, 0, 0};
  for (const Sample& s : scene.samples) {
    const dReal* p = s.body != nullptr ? dBodyGetPosition(s.body) : zero;
    const dReal* q = s.body != nullptr ? dBodyGetQuaternion(s.body) : identity;
    const dReal* v = s.body != nullptr ? dBodyGetLinearVel(s.body) : zero;
    const dReal* w = s.body != nullptr ? dBodyGetAngularVel(s.body) : zero;
    std::fprintf(file, "%.17g,%s,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", t,
                 s.name.c_str(), p[0], p[1], p[2], q[0], q[1], q[2], q[3], v[0], v[1], v[2], w[0], w[1], w[2]);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string row = argc > 1 ? argv[1] : "", name = argc > 2 ? argv[2] : "", profile = argc > 3 ? argv[3] : "";
  const double dt = argc > 4 ? std::atof(argv[4]) : 0;
  const bool quick = row == "ode-quickstep";
  if (argc != 6 || (!quick && row != "ode-step") || kScenes.count(name) == 0 ||
      (profile != "default" && profile != "matched") || !(dt > 0)) {
    std::fprintf(stderr, "usage: raw_ode ode-step|ode-quickstep CASE default|matched DT FILE, with CASE one of\n");
    for (const auto& scene : kScenes) std::fprintf(stderr, "  %s\n", scene.first.c_str());
    return 2;
  }

  dInitODE2(0);
  dAllocateODEDataForThread(dAllocateMaskAll);
  dRandSetSeed(1);
  Scene scene;
  scene.matched = profile == "matched";
  scene.world = dWorldCreate();
  scene.space = dSimpleSpaceCreate(nullptr);
  scene.contacts = dJointGroupCreate(0);
  if (quick && scene.matched) dWorldSetQuickStepNumIterations(scene.world, 100);
  kScenes.at(name)(scene);
  dVector3 gravity;
  dWorldGetGravity(scene.world, gravity);
  if (scene.matched) {
    // What gravity takes back within one step.
    const double weight = std::sqrt(gravity[0] * gravity[0] + gravity[1] * gravity[1] + gravity[2] * gravity[2]);
    dWorldSetContactMaxCorrectingVel(scene.world, weight * dt);
  }

  std::FILE* file = std::fopen(argv[5], "w");
  if (file == nullptr) {
    std::fprintf(stderr, "cannot write %s\n", argv[5]);
    return 2;
  }
  std::fprintf(file, "t,body,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz\n");
  write(file, 0, scene);
  const int steps = static_cast<int>(std::floor(scene.duration / dt * (1 + 1e-9)));
  for (int k = 1; k <= steps; ++k) {
    scene.push();
    if (scene.collide) dSpaceCollide(scene.space, &scene, near_callback);
    if (quick) {
      dWorldQuickStep(scene.world, dt);
    } else {
      dWorldStep(scene.world, dt);
    }
    dJointGroupEmpty(scene.contacts);
    write(file, k * dt, scene);
  }
  std::fclose(file);
  dJointGroupDestroy(scene.contacts);
  dSpaceDestroy(scene.space);
  dWorldDestroy(scene.world);
  dCloseODE();
}
