// Six cases written for Box2D alone, as somebody would who knows nothing but its manual.
//
//   raw_box2d ROW CASE PROFILE DT FILE
//
// Box2D's x and y are the x and z of the output; an angle turns x towards z, which is a negative one about +y.
#include <box2d/box2d.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

namespace {

struct Profile {
  bool sleeping;
  float restitution_threshold, box_skin, ground_skin;
};
// What a user gets, and what keeps shells and thresholds out of the way.
constexpr Profile kDefault = {true, 1.0f, b2_polygonRadius, b2_polygonRadius};
constexpr Profile kMatched = {false, 0.0f, b2_linearSlop, 0.0f};

struct Member {
  std::string name;
  b2Body* body;
};

struct Scene {
  explicit Scene(const Profile& p) : profile(p) { world.SetAllowSleeping(p.sleeping); }
  Profile profile;
  b2World world{b2Vec2(0, 0)};
  std::vector<Member> members;
  double duration = 0;
  std::function<void()> push = [] {};  // before every step
};

b2Vec2 vec(double x, double z) { return {static_cast<float>(x), static_cast<float>(z)}; }

// Unturned: an angle about +y of 0 is one of -0 here.
b2Body* put_fixed(Scene& scene, const char* name) {
  b2BodyDef def;
  def.angle = -0.0f;
  return scene.members.emplace_back(Member{name, scene.world.CreateBody(&def)}).body;
}

b2Body* put(Scene& scene, const char* name, double x, double z, double vx, double vz) {
  b2BodyDef def;
  def.type = b2_dynamicBody;
  def.position = vec(x, z);
  def.angle = -0.0f;
  def.linearVelocity = vec(vx, vz);
  def.angularVelocity = -0.0f;
  return scene.members.emplace_back(Member{name, scene.world.CreateBody(&def)}).body;
}

// After the fixtures, which would set a mass of their own.
void weigh(b2Body* body, double mass, double inertia) {
  const b2MassData data = {static_cast<float>(mass), b2Vec2(0, 0), static_cast<float>(inertia)};
  body->SetMassData(&data);
}

// Box2D takes the larger restitution and the root of the product of the frictions: both sides have the same.
void cover(const Scene& scene, b2Body* body, const b2Shape& shape, double restitution, double friction) {
  b2FixtureDef def;
  def.shape = &shape;
  def.restitution = static_cast<float>(restitution);
  def.friction = static_cast<float>(friction);
  def.restitutionThreshold = scene.profile.restitution_threshold;
  body->CreateFixture(&def);
}

void falling_box(Scene& scene) {
  const double m = 1, f = 9.8;
  scene.duration = 2;
  b2Body* box = put(scene, "box", 0, 5, 2, 3);
  weigh(box, m, m / 12.0 * (1.0 + 1.0));
  scene.push = [=] { box->ApplyForceToCenter(vec(0, -f), true); };
}

void drag_ship(Scene& scene) {
  const double m = 1000, T = 5000, c = 250, g = 9.81, v0 = 30;
  scene.duration = m / c;
  scene.world.SetGravity(vec(0, -g));
  b2Body* ship = put(scene, "ship", 0, 0, v0, 0);
  weigh(ship, m, m / 12.0 * (4.0 * 4.0 + 20.0 * 20.0));
  scene.push = [=] {
    const double vx = ship->GetLinearVelocity().x;
    ship->ApplyForceToCenter(vec(T - c * vx, m * g), true);
  };
}

b2Body* put_ball(Scene& scene, const char* name, double r, double m, double x, double z, double vx, double e) {
  b2Body* ball = put(scene, name, x, z, vx, 0);
  b2CircleShape circle;
  circle.m_radius = static_cast<float>(r);
  cover(scene, ball, circle, e, 0);
  weigh(ball, m, 0.4 * m * r * r);
  return ball;
}

void two_sphere(Scene& scene) {
  const double e = 0.5, b = 0.48, m1 = 2, m2 = 1, r1 = 0.5, r2 = 0.3, u1 = 2, u2 = -1, D = 3.12;
  scene.duration = 1.5;
  put_ball(scene, "one", r1, m1, 0, 0, u1, e);
  put_ball(scene, "two", r2, m2, D, b, u2, e);
}

void pendulum(Scene& scene) {
  const double g = 9.81, L = 1, m = 1, r = 0.1;
  scene.duration = 2;
  scene.world.SetGravity(vec(0, -g));
  b2Body* bob = put(scene, "bob", L, 0, 0, 0);
  weigh(bob, m, 0.4 * m * r * r);
  const b2BodyDef standing;
  b2RevoluteJointDef pin;
  pin.bodyA = scene.world.CreateBody(&standing);
  pin.bodyB = bob;
  pin.localAnchorB = vec(-L, 0);
  scene.world.CreateJoint(&pin);
}

void incline(Scene& scene) {
  const double g = 9.81, mu = 0.2, a = 20 * M_PI / 180, m = 10;
  scene.duration = 2;
  scene.world.SetGravity(vec(g * std::sin(a), -g * std::cos(a)));
  b2EdgeShape edge;
  edge.SetTwoSided(b2Vec2(-1000, 0), b2Vec2(1000, 0));
  edge.m_radius = scene.profile.ground_skin;
  cover(scene, put_fixed(scene, "ground"), edge, 0, mu);
  b2Body* box = put(scene, "box", 0, 0.25, 0, 0);
  b2PolygonShape polygon;
  polygon.SetAsBox(0.5f, 0.25f);
  polygon.m_radius = scene.profile.box_skin;
  cover(scene, box, polygon, 0, mu);
  weigh(box, m, m / 12.0 * (0.5 * 0.5 + 1.0));
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
    const b2Vec2 p = member.body->GetWorldCenter(), v = member.body->GetLinearVelocity();
    const double about_y = -double{member.body->GetAngle()}, spin_y = -double{member.body->GetAngularVelocity()};
    std::fprintf(file, "%.17g,%s", t, member.name.c_str());
    for (const double x : {double{p.x}, 0.0, double{p.y}, std::cos(about_y / 2), 0.0, std::sin(about_y / 2), 0.0,
                           double{v.x}, 0.0, double{v.y}, 0.0, spin_y, 0.0}) {
      std::fprintf(file, ",%.17g", x);
    }
    std::fprintf(file, "\n");
  }
}

int usage() {
  std::fprintf(stderr, "raw_box2d ROW CASE PROFILE DT FILE\nROW: box2d\nPROFILE: default, matched\nCASE:\n");
  for (const Case& known : kCases) std::fprintf(stderr, "  %s\n", known.name);
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 6 || std::string(argv[1]) != "box2d") return usage();
  const std::string name = argv[2], profile = argv[3];
  if (profile != "default" && profile != "matched") return usage();
  const double dt = std::strtod(argv[4], nullptr);
  if (!(dt > 0)) return usage();
  for (const Case& known : kCases) {
    if (name != known.name) continue;
    if (known.build == nullptr) return 77;
    std::FILE* file = std::fopen(argv[5], "w");
    if (file == nullptr) return std::perror(argv[5]), 1;
    Scene scene(profile == "default" ? kDefault : kMatched);
    known.build(scene);
    std::fprintf(file, "t,body,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz\n");
    write_sample(file, scene, 0);
    const int steps = static_cast<int>(std::floor(scene.duration / dt + 1e-9));
    for (int k = 1; k <= steps; ++k) {
      scene.push();
      scene.world.Step(static_cast<float>(dt), 8, 3);
      write_sample(file, scene, k * dt);
    }
    return std::fclose(file) == 0 ? 0 : 1;
  }
  return usage();
}
