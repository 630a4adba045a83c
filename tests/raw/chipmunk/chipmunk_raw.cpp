// Six cases written for Chipmunk alone, as somebody would who knows nothing but its manual.
//
//   raw_chipmunk ROW CASE PROFILE DT FILE
//
// Chipmunk's x and y are the x and z of the output; an angle turns x towards z, which is a negative one about +y.
#include <chipmunk/chipmunk.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

namespace {

struct Member {
  std::string name;
  cpBody* body;
};

struct Scene {
  cpSpace* space = cpSpaceNew();
  std::vector<Member> members;
  double duration = 0;
  std::function<void()> push = [] {};  // before every step
};

// A user who sets nothing gets 10 iterations and a slop of 0.1, which suits pixels; this is what suits metres.
void tune(cpSpace* space) {
  cpSpaceSetIterations(space, 50);
  cpSpaceSetCollisionSlop(space, 0.0001);
}

// At rest and unturned: an angle about +y of 0 is one of -0 here.
cpBody* put(Scene& scene, const char* name, cpBody* body, double x, double z) {
  cpBodySetPosition(body, cpv(x, z));
  cpBodySetAngle(body, -0.0);
  scene.members.push_back({name, cpSpaceAddBody(scene.space, body)});
  return body;
}
cpBody* put_moving(Scene& scene, const char* name, cpBody* body, double x, double z, double vx, double vz) {
  cpBodySetVelocity(body, cpv(vx, vz));
  cpBodySetAngularVelocity(body, -0.0);
  return put(scene, name, body, x, z);
}

// Chipmunk multiplies the coefficients of both shapes: one side has the value, the other 1.
void cover(Scene& scene, cpShape* shape, double restitution, double friction) {
  cpShapeSetElasticity(shape, restitution);
  cpShapeSetFriction(shape, friction);
  cpSpaceAddShape(scene.space, shape);
}

void falling_box(Scene& scene) {
  const double m = 1, f = 9.8;
  scene.duration = 2;
  cpBody* box = put_moving(scene, "box", cpBodyNew(m, m / 12.0 * (1.0 + 1.0)), 0, 5, 2, 3);
  scene.push = [=] { cpBodySetForce(box, cpv(0, -f)); };
}

void drag_ship(Scene& scene) {
  const double m = 1000, T = 5000, c = 250, g = 9.81, v0 = 30;
  scene.duration = m / c;
  cpSpaceSetGravity(scene.space, cpv(0, -g));
  cpBody* ship = put_moving(scene, "ship", cpBodyNew(m, m / 12.0 * (4.0 * 4.0 + 20.0 * 20.0)), 0, 0, v0, 0);
  scene.push = [=] { cpBodySetForce(ship, cpv(T - c * cpBodyGetVelocity(ship).x, m * g)); };
}

void two_sphere(Scene& scene) {
  const double e = 0.5, b = 0.48, m1 = 2, m2 = 1, r1 = 0.5, r2 = 0.3, u1 = 2, u2 = -1, D = 3.12;
  scene.duration = 1.5;
  cpBody* one = put_moving(scene, "one", cpBodyNew(m1, 0.4 * m1 * r1 * r1), 0, 0, u1, 0);
  cover(scene, cpCircleShapeNew(one, r1, cpvzero), 1, 0);
  cpBody* two = put_moving(scene, "two", cpBodyNew(m2, 0.4 * m2 * r2 * r2), D, b, u2, 0);
  cover(scene, cpCircleShapeNew(two, r2, cpvzero), e, 0);
}

void pendulum(Scene& scene) {
  const double g = 9.81, L = 1, m = 1, r = 0.1;
  scene.duration = 2;
  cpSpaceSetGravity(scene.space, cpv(0, -g));
  cpBody* bob = put_moving(scene, "bob", cpBodyNew(m, 0.4 * m * r * r), L, 0, 0, 0);
  cpBody* world = cpSpaceGetStaticBody(scene.space);
  cpSpaceAddConstraint(scene.space, cpPivotJointNew2(world, bob, cpvzero, cpv(-L, 0)));
}

void incline(Scene& scene) {
  const double g = 9.81, mu = 0.2, a = 20 * M_PI / 180, m = 10;
  scene.duration = 2;
  cpSpaceSetGravity(scene.space, cpv(g * std::sin(a), -g * std::cos(a)));
  cpBody* ground = put(scene, "ground", cpBodyNewStatic(), 0, 0);
  const cpVect slab[] = {{-1000, 0}, {-1000, -1000}, {1000, -1000}, {1000, 0}};
  cover(scene, cpPolyShapeNewRaw(ground, 4, slab, 0), 0, 1);
  cpBody* box = put_moving(scene, "box", cpBodyNew(m, m / 12.0 * (0.5 * 0.5 + 1.0)), 0, 0.25, 0, 0);
  cover(scene, cpBoxShapeNew(box, 1, 0.5, 0), 0, mu);
}

struct Case {
  const char* name;
  void (*build)(Scene&);  // none: it leaves the plane
};
const Case kCases[] = {{"particle/falling_box", falling_box},
                       {"particle/drag_ship/v0=30", drag_ship},
                       {"collision/two_sphere/e=0.5,b=0.48", two_sphere},
                       {"rotation/free_rotation", nullptr},
                       {"joint/pendulum", pendulum},
                       {"friction/incline/mu=0.2", incline}};

void write_sample(std::FILE* file, const Scene& scene, double t) {
  for (const Member& member : scene.members) {
    const cpVect p = cpBodyGetPosition(member.body), v = cpBodyGetVelocity(member.body);
    const double about_y = -cpBodyGetAngle(member.body), spin_y = -cpBodyGetAngularVelocity(member.body);
    std::fprintf(file, "%.17g,%s", t, member.name.c_str());
    for (const double x :
         {p.x, 0.0, p.y, std::cos(about_y / 2), 0.0, std::sin(about_y / 2), 0.0, v.x, 0.0, v.y, 0.0, spin_y, 0.0}) {
      std::fprintf(file, ",%.17g", x);
    }
    std::fprintf(file, "\n");
  }
}

int usage() {
  std::fprintf(stderr, "raw_chipmunk ROW CASE PROFILE DT FILE\nROW: chipmunk\nPROFILE: default, matched\nCASE:\n");
  for (const Case& known : kCases) std::fprintf(stderr, "  %s\n", known.name);
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 6 || std::string(argv[1]) != "chipmunk") return usage();
  const std::string name = argv[2], profile = argv[3];
  if (profile != "default" && profile != "matched") return usage();
  const double dt = std::strtod(argv[4], nullptr);
  if (!(dt > 0)) return usage();
  for (const Case& known : kCases) {
    if (name != known.name) continue;
    if (known.build == nullptr) return 77;
    std::FILE* file = std::fopen(argv[5], "w");
    if (file == nullptr) return std::perror(argv[5]), 1;
    Scene scene;
    if (profile == "matched") tune(scene.space);
    known.build(scene);
    std::fprintf(file, "t,body,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz\n");
    write_sample(file, scene, 0);
    const int steps = static_cast<int>(std::floor(scene.duration / dt + 1e-9));
    for (int k = 1; k <= steps; ++k) {
      scene.push();
      cpSpaceStep(scene.space, dt);
      write_sample(file, scene, k * dt);
    }
    return std::fclose(file) == 0 ? 0 : 1;
  }
  return usage();
}
