// Six scenes written directly against MuJoCo. Usage: raw_mujoco ROW CASE PROFILE DT FILE.
#include <mujoco/mujoco.h>

#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

namespace {

constexpr double kPi = 3.14159265358979323846;

std::string text(const char* format, ...) {
  char line[1000];
  va_list values;
  va_start(values, format);
  std::vsnprintf(line, sizeof line, format, values);
  va_end(values);
  return line;
}

// The direction +y as the turn from +z gives it in doubles: z is one unit in the last place of y.
constexpr const char* kHingeAboutY = "<joint type='hinge' pos='-1 0 0' axis='0 1 2.220446049250313e-16'/>";

struct Body {
  const char* name;
  double p[3];
  double v[3];
  double w[3];  // in the world; every body starts unturned
  bool fixed;
  bool hinged;
};

struct Scene {
  std::string worldbody;
  std::string pair;  // geoms and friction, without solver parameters
  std::vector<Body> bodies;
  double gravity[3] = {0, 0, 0};
  double duration = 0;
  double restitution = 0, friction = 0;
  void (*force)(const double v[3], double f[3]) = nullptr;
};

std::string ball(const char* name, double x, double y, double z, double r, double m, const char* joint) {
  const double i = 0.4 * m * r * r;
  return text(
             "<body name='%s' pos='%.17g %.17g %.17g'>%s<inertial pos='0 0 0' mass='%.17g' diaginertia='%.17g %.17g "
             "%.17g'/>",
             name, x, y, z, joint, m, i, i, i) +
         text("<geom name='%s' type='sphere' size='%.17g' contype='0' conaffinity='0'/></body>", name, r);
}

std::string box(const char* name, double x, double y, double z, double a, double b, double c, double m) {
  return text("<body name='%s' pos='%.17g %.17g %.17g'><freejoint/><inertial pos='0 0 0' mass='%.17g' ", name, x, y, z,
              m) +
         text("diaginertia='%.17g %.17g %.17g'/>", m / 12 * (b * b + c * c), m / 12 * (a * a + c * c),
              m / 12 * (a * a + b * b)) +
         text("<geom name='%s' type='box' size='%.17g %.17g %.17g' contype='0' conaffinity='0'/></body>", name, a / 2,
              b / 2, c / 2);
}

bool make_scene(const std::string& name, Scene& s) {
  const double g = 9.81;
  if (name == "particle/falling_box") {
    s.duration = 2;
    s.worldbody = box("box", 0, 0, 5, 1, 1, 1, 1);
    s.bodies = {{"box", {0, 0, 5}, {2, 1, 3}, {0, 0, 0}, false, false}};
    s.force = [](const double*, double f[3]) { f[2] = -9.8; };
  } else if (name == "particle/drag_ship/v0=30") {
    s.duration = 1000.0 / 250.0;
    s.gravity[2] = -g;
    s.worldbody = box("ship", 0, 0, 0, 20, 6, 4, 1000);
    s.bodies = {{"ship", {0, 0, 0}, {30, 0, 0}, {0, 0, 0}, false, false}};
    s.force = [](const double v[3], double f[3]) {
      f[0] = 5000.0 - 250.0 * v[0];
      f[2] = 1000.0 * 9.81;
    };
  } else if (name == "collision/two_sphere/e=0.5,b=0.48") {
    s.duration = 1.5;
    s.restitution = 0.5;
    s.worldbody = ball("one", 0, 0, 0, 0.5, 2, "<freejoint/>") + ball("two", 3.12, 0, 0.48, 0.3, 1, "<freejoint/>");
    s.pair = "geom1='one' geom2='two' condim='1'";
    s.bodies = {{"one", {0, 0, 0}, {2, 0, 0}, {0, 0, 0}, false, false},
                {"two", {3.12, 0, 0.48}, {-1, 0, 0}, {0, 0, 0}, false, false}};
  } else if (name == "rotation/free_rotation") {
    s.duration = 1;
    s.worldbody = box("box", 0, 0, 0, 0.1, 0.4, 0.9, 10);
    s.bodies = {{"box", {0, 0, 0}, {0, 0, 0}, {0.1, 5, 0.1}, false, false}};
  } else if (name == "joint/pendulum") {
    s.duration = 2;
    s.gravity[2] = -g;
    s.worldbody = ball("bob", 1, 0, 0, 0.1, 1, kHingeAboutY);
    s.bodies = {{"bob", {1, 0, 0}, {0, 0, 0}, {0, 0, 0}, false, true}};
  } else if (name == "friction/incline/mu=0.2") {
    const double slope = 20 * kPi / 180;
    s.duration = 2;
    s.gravity[0] = g * std::sin(slope);
    s.gravity[2] = -g * std::cos(slope);
    s.friction = 0.2;
    s.worldbody = "<geom name='ground' type='plane' size='0 0 1' contype='0' conaffinity='0'/>" +
                  box("box", 0, 0, 0.5 / 2, 1, 1, 0.5, 10);
    s.pair = "geom1='ground' geom2='box' condim='3' friction='0.2 0.2 0 0 0'";
    s.bodies = {{"ground", {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, true, false},
                {"box", {0, 0, 0.5 / 2}, {0, 0, 0}, {0, 0, 0}, false, false}};
  } else {
    return false;
  }
  return true;
}

// How a contact reacts, as attributes of <pair>.
std::string contact_parameters(const Scene& s, bool matched, bool rk4, double dt) {
  if (!matched) return " solref='0.02 1' solimp='0.9 0.95 0.001'";
  double b = (rk4 ? 2 : 1 + s.restitution) / dt;
  if (s.friction > 0 && s.restitution == 0) b = std::fmin(10, b);
  const bool gravity = s.gravity[0] != 0 || s.gravity[2] != 0;
  const double k = gravity ? (1 - s.restitution) * std::fmin(b / 0.25, b * b / 4) : 0;
  return text(" solref='%.17g %.17g' solimp='0.9999 0.9999 0.001'", -k, -b);
}

struct State {
  double p[3], q[4], v[3], w[3];
};

State state_of(const mjModel* m, const mjData* d, mjData* scratch, const Body& body) {
  State s = {{body.p[0], body.p[1], body.p[2]}, {1, 0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  if (body.fixed) return s;
  const int id = mj_name2id(m, mjOBJ_BODY, body.name);
  if (!body.hinged) {
    const mjtNum* qpos = d->qpos + m->jnt_qposadr[m->body_jntadr[id]];
    const mjtNum* qvel = d->qvel + m->jnt_dofadr[m->body_jntadr[id]];
    mju_copy3(s.p, qpos);
    mju_copy4(s.q, qpos + 3);
    mju_copy3(s.v, qvel);
    mju_rotVecQuat(s.w, qvel + 3, qpos + 3);
    return s;
  }
  mju_copy(scratch->qpos, d->qpos, m->nq);
  mju_copy(scratch->qvel, d->qvel, m->nv);
  mj_kinematics(m, scratch);
  mj_comPos(m, scratch);
  mj_comVel(m, scratch);
  mjtNum twist[6];
  mj_objectVelocity(m, scratch, mjOBJ_BODY, id, twist, 0);
  mju_copy3(s.p, scratch->xpos + 3 * id);
  mju_copy4(s.q, scratch->xquat + 4 * id);
  mju_copy3(s.w, twist);
  mju_copy3(s.v, twist + 3);
  return s;
}

void print(std::FILE* file, double t, const Body& body, const State& s) {
  std::fprintf(file, "%.17g,%s", t, body.name);
  for (double x : s.p) std::fprintf(file, ",%.17g", x);
  for (double x : s.q) std::fprintf(file, ",%.17g", x);
  for (double x : s.v) std::fprintf(file, ",%.17g", x);
  for (double x : s.w) std::fprintf(file, ",%.17g", x);
  std::fputc('\n', file);
}

int usage() {
  std::fputs(
      "usage: raw_mujoco ROW CASE PROFILE DT FILE\n"
      "rows: mujoco-euler mujoco-implicit mujoco-rk4\n"
      "cases: particle/falling_box particle/drag_ship/v0=30 collision/two_sphere/e=0.5,b=0.48 rotation/free_rotation "
      "joint/pendulum friction/incline/mu=0.2\n"
      "profiles: default matched\n",
      stderr);
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 6) return usage();
  const std::string row = argv[1], profile = argv[3];
  const double dt = std::atof(argv[4]);
  const bool matched = profile == "matched", rk4 = row == "mujoco-rk4";
  Scene scene;
  if ((row != "mujoco-euler" && row != "mujoco-implicit" && !rk4) || (!matched && profile != "default") || !(dt > 0) ||
      !make_scene(argv[2], scene)) {
    return usage();
  }
  if (rk4 && scene.restitution > 0) return 77;  // its four evaluations per step do not add up to a rebound

  std::string xml = "<mujoco><compiler angle='radian' inertiafromgeom='false'/>";
  xml += text("<option timestep='%.17g' gravity='%.17g %.17g %.17g' integrator='%s' ", dt, scene.gravity[0],
              scene.gravity[1], scene.gravity[2],
              rk4                        ? "RK4"
              : row == "mujoco-implicit" ? "implicit"
                                         : "Euler");
  xml += matched ? "cone='elliptic' tolerance='0' solver='Newton' iterations='100' impratio='1'/>"
                 : "cone='pyramidal' tolerance='1e-8' solver='Newton' iterations='100' impratio='1'/>";
  xml += "<worldbody>" + scene.worldbody + "</worldbody>";
  if (!scene.pair.empty()) {
    xml += "<contact><pair " + scene.pair + contact_parameters(scene, matched, rk4, dt) + "/></contact>";
  }
  xml += "</mujoco>";

  mjVFS* files = new mjVFS;
  mj_defaultVFS(files);
  mj_makeEmptyFileVFS(files, "scene.xml", static_cast<int>(xml.size()));
  std::memcpy(files->filedata[0], xml.data(), xml.size());
  char error[1000] = "";
  mjModel* m = mj_loadXML("scene.xml", files, error, sizeof error);
  if (m == nullptr) {
    std::fprintf(stderr, "%s\n", error);
    return 1;
  }
  mjData* d = mj_makeData(m);
  mjData* scratch = mj_makeData(m);
  for (const Body& body : scene.bodies) {
    if (body.fixed || body.hinged) continue;
    mjtNum* qvel = d->qvel + m->jnt_dofadr[m->body_jntadr[mj_name2id(m, mjOBJ_BODY, body.name)]];
    mju_copy3(qvel, body.v);
    mju_copy3(qvel + 3, body.w);
  }

  std::FILE* file = std::fopen(argv[5], "w");
  if (file == nullptr) {
    std::perror(argv[5]);
    return 1;
  }
  std::fputs("t,body,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz\n", file);
  const int steps = static_cast<int>(std::floor(scene.duration / dt + 1e-9));
  for (int k = 0; k <= steps; ++k) {
    for (const Body& body : scene.bodies) print(file, k * dt, body, state_of(m, d, scratch, body));
    if (k == steps) break;
    if (scene.force != nullptr) {
      const Body& body = scene.bodies[0];
      scene.force(state_of(m, d, scratch, body).v, d->xfrc_applied + 6 * mj_name2id(m, mjOBJ_BODY, body.name));
    }
    mj_step(m, d);
  }
  std::fclose(file);
  mj_deleteData(scratch);
  mj_deleteData(d);
  mj_deleteModel(m);
  mj_deleteVFS(files);
  delete files;
  return 0;
}
