// The simple motion simulator of course slide 24, made exact: spheres that meet each other and walls, every impact at
// its own time and in its own turn. It is also the zero-tolerance policy of slide 33: no overlap, ever.
//
// Between impacts a ball moves on a parabola, p + v t + a t^2/2, that is known in closed form; nothing is integrated.
// Each ball keeps the earliest event that its present course leads to: an impact on a ball or wall, or the crossing
// into the next cell of a grid. The earliest of all happens, only the balls that take part are brought to its time and
// given new predictions; all others stay as they are, with their own clocks. An impact changes a ball's course, and a
// counter of courses tells a prediction made with the old one from a valid one (it is then made anew). Since a ball
// looks for partners in the cells around its own only, an impact costs the same for a hundred balls and a hundred
// thousand, but for the logarithm in the queue.
//   Alder and Wainwright, J. Chem. Phys. 31, 459 (1959); Rapaport, J. Comput. Phys. 34, 184 (1980);
//   Lubachevsky, J. Comput. Phys. 94, 255 (1991): one event for each ball, and balls with their own clocks.
//
// Exactness. Times of impact come from the quadratic equation (relative motion is linear; a ball that falls on one that
// rests meets it on a parabola, which is searched to 1e-13 of the distance). Positions carry the rounding of their
// coordinates and times that of the clock: about 2e-16 max(|p|, v t) [m]. An elastic impact keeps energy and momentum
// to rounding. What no arithmetic can keep is the trajectory of many balls beyond some dozen impacts each: two gases
// that differ in the last digit are strangers after that.
//
// Events at the same time are taken in the order of the ball's index, one after the other, each with the velocities
// that the one before has left. A cascade through touching balls is so resolved within one instant. For Newton's cradle
// with gaps of 0 that is the limit of gaps that close from the struck end on (as many balls leave as have come); for a
// ball that strikes two others at once it makes one of them the first. Rigid bodies have no unique answer there.
//
// Infinitely many impacts in a finite time (Zeno) end by stated rules (EventRules):
// - A ball on a wall. With the acceleration -a along the wall's normal and e < 1, the bounces after the rebound speed u
//   last 2u/a (1 + e + e^2 + ...) = 2u / (a (1 - e)). When that is below train_time and nobody can meet the ball
//   before, the train is taken as a whole: bounce_train.hpp gives the state at every time in it, and at its end the
//   ball rests on the wall and slides along it without friction. A ball that comes near in the meantime takes the train
//   back: it is again followed bounce by bounce, from its exact state. Exact.
// - A hop lower than the rounding of the ball's coordinates, 4 eps (|p| + r), about 1e-15 m, is rest. With trains this
//   is met by balls that come to rest on two walls at once; without them it cuts the series short by some 1e-8 s.
// - A ball that rests is woken by an impact that would lift it higher than that.
// - Balls that collapse onto each other (three balls of small e; a ball that comes to rest on a ball). There is no
//   series to sum, and the rule is a model, the TC model of Luding and McNamara, Granular Matter 1, 113 (1998): balls
//   that meet again within collapse_time lose no energy while that lasts. Impacts of one cascade (cascade_time) and the
//   first of a pair are not touched. A ball on a ball so keeps hopping, about 1e-10 m high, and each such contact costs
//   some 5e5 impacts a second: a pile is not what this simulator is for, and that is the price of zero tolerance.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "plumbline/core/events/bounce_train.hpp"
#include "plumbline/core/events/event_cells.hpp"
#include "plumbline/core/events/event_queue.hpp"
#include "plumbline/core/events/event_scene.hpp"

namespace plumbline {

// One impact, as it stands in the log. Impacts are listed one by one, but for trains of bounces: these have one entry
// for all of them, at the time when the ball comes to rest or the train is taken back. The sum of the impulses so
// always is the momentum that went over.
struct Impact {
  double time = 0;          // [s]
  std::size_t ball = 0;     // of two balls the one with the smaller index
  std::size_t partner = 0;  // the other ball, or the wall
  bool with_wall = false;
  bool comes_to_rest = false;     // on that wall
  Vec3 impulse_W = Vec3::Zero();  // on `ball`; the partner gets its opposite [N s]
};

struct EventCounts {
  std::uint64_t impacts = 0;
  std::uint64_t crossings = 0;    // of cell faces
  std::uint64_t stale = 0;        // predictions whose partner had changed its course
  std::uint64_t predictions = 0;  // a ball against all around it
};

class EventDrivenSimulator {
 public:
  // Throws std::invalid_argument, naming the ball or wall, for radii, masses, coefficients or walls that make no sense,
  // for balls that overlap by more than 1e-10 of their size, and for NaN.
  explicit EventDrivenSimulator(EventScene scene, const EventRules& rules = {});

  // Goes on to the next impact and returns it, or to the time `until` [s] when there is none before. An impact at
  // exactly `until` still happens. With `until` infinite, time stands still after the last impact of all. Throws
  // std::invalid_argument for a time in the past or NaN.
  std::optional<Impact> next_impact(double until);
  // All impacts up to then; their number.
  std::uint64_t run_until(double until);
  // The same, with the list.
  std::vector<Impact> record_until(double until);

  double time() const { return now_; }  // [s]
  std::size_t size() const { return bodies_.size(); }
  // At time(), in the periodic box if there is one.
  Ball ball(std::size_t index) const;
  std::vector<Ball> balls() const;
  // Centre as if the box were not periodic: what has been travelled counts [m].
  Vec3 unwrapped_position(std::size_t index) const;
  // Rests on (or slides along) a wall.
  bool rests(std::size_t index) const;

  double kinetic_energy() const;    // [J], of the balls that can move
  double potential_energy() const;  // [J], -m g.p
  Vec3 momentum() const;            // [kg m/s]
  const EventCounts& counts() const { return counts_; }

 private:
  static constexpr int kNobody = -1;
  static constexpr double kNever = std::numeric_limits<double>::infinity();
  enum class EventKind : std::uint8_t { kNone, kCrossing, kBall, kWall, kTrainEnd };

  struct Event {
    double time = kNever;
    int partner = kNobody;     // ball or wall; for a crossing 2 * axis + (1 for upwards)
    std::uint32_t course = 0;  // of the partner, when this was predicted
    EventKind kind = EventKind::kNone;
  };

  // A ball on its course since `time`. In a train, p and v are those of the ball as if it slid along the wall.
  struct Body {
    Vec3 p, v, a;
    double time = 0;
    double radius, inverse_mass;
    std::uint32_t course = 0;
    bool in_train = false;  // up to here is what neighbours look at: two cache lines
    int streak = 0;         // impacts on other balls in quick succession, ...
    int last_partner = kNobody;
    double last_impact = -kNever;
    double elastic_until = -kNever;
    Eigen::Vector3i images = Eigen::Vector3i::Zero();  // edges of the periodic box that were crossed
    std::vector<int> supports;                         // walls on which it rests, or slides while in a train
    bool fixed() const { return inverse_mass == 0; }
  };

  // The motion of one body as another one sees it at this moment.
  struct Sight {
    Vec3 d, v, a;  // relative
    double reach;  // sum of the radii
  };

  // event_driven_setup.cpp
  void check_scene() const;
  void check_overlaps() const;
  void build_cells();

  // event_driven_simulator.cpp: what happens at an event
  void count_at_once();
  std::optional<Impact> collide(int i, int j);
  Impact hit_wall(int i, int wall);
  void cross(int i, int face);
  bool collapses(Body& body, int partner) const;
  // Where a body is now, hops of a train included.
  void place_now(Body& body, std::size_t index) const;

  // event_prediction.cpp: what comes next for a body
  void fly(Body& body) const;
  Sight sight(const Body& me, const Body& other, const Vec3& shift) const;
  double meeting_time(const Sight& s, const Body& me, const Body& other, double before) const;
  double wall_time(const Body& body, const Wall& wall, double margin) const;
  Event crossing(int i, const Body& body) const;
  Event predict(int i);
  void schedule(int i);

  // zeno_rule.cpp: rest, and trains of bounces that end in it
  void support(Body& body) const;
  void lift_or_keep(Body& body) const;
  void rest_on(Body& body, int wall) const;
  bool come_to_rest(int i, int wall, double rebound, double e);
  bool may_meet(const Body& sliding, int wall, double height, const Body& other, double other_height, const Vec3& shift,
                double within) const;
  bool undisturbed(int i, int wall, const BounceTrain& train) const;
  double hop_height(int i) const;
  void leave_train(int i);
  Impact end_train(int i);

  EventScene scene_;
  EventRules rules_;
  double now_ = 0;
  double last_event_ = -kNever;  // the last time at which something happened ...
  long events_at_once_ = 0;      // ... and how much
  double largest_radius_ = 0;
  std::vector<Body> bodies_;
  std::vector<Event> events_;  // the earliest of each body
  EventQueue queue_;
  EventCells cells_;
  struct Train {
    BounceTrain bounces;
    int wall;
  };
  std::map<int, Train> trains_;  // by body
  std::vector<Impact> due_;      // entries of trains that were taken back, to be listed next
  EventCounts counts_;
};

}  // namespace plumbline
