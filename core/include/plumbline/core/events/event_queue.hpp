// Who is next? The earliest of the pending times of n bodies.
//
// A tournament: the bodies are the leaves of a binary tree, each inner node holds the earlier of its two children, the
// root the earliest of all. A new time for one body replays its matches up to the root, log2 n of them; nothing is
// ever searched for or removed. Equal times are won by the smaller index, so the order of events is defined.
//   Knuth, The Art of Computer Programming 3, 5.4.1 (trees of losers and winners); Marin, Risso and Cordero,
//   J. Comput. Phys. 109, 306 (1993), on queues for hard spheres.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

namespace plumbline {

class EventQueue {
 public:
  EventQueue() = default;
  // For n > 0 bodies without events: their time is infinite.
  explicit EventQueue(int n);

  // The next event of that body [s]; infinity for none. NaN is not a time.
  void set(int body, double time);
  int first() const { return winner_[1]; }
  double time(int body) const { return times_[static_cast<std::size_t>(body)]; }

 private:
  int earlier(int a, int b) const { return time(b) < time(a) || (time(b) == time(a) && b < a) ? b : a; }

  std::size_t leaves_ = 0;     // a power of two; those beyond the bodies never happen
  std::vector<double> times_;  // of each leaf
  std::vector<int> winner_;    // node 1 is the root, the children of k are 2k and 2k + 1
};

}  // namespace plumbline
