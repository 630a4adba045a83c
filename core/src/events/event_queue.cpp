#include "plumbline/core/events/event_queue.hpp"

namespace plumbline {

EventQueue::EventQueue(int n) : leaves_(1) {
  while (leaves_ < static_cast<std::size_t>(n)) leaves_ *= 2;
  times_.assign(leaves_, std::numeric_limits<double>::infinity());
  winner_.resize(2 * leaves_);
  for (std::size_t k = 0; k < leaves_; ++k) winner_[leaves_ + k] = static_cast<int>(k);
  for (std::size_t k = leaves_ - 1; k > 0; --k) winner_[k] = earlier(winner_[2 * k], winner_[2 * k + 1]);
}

void EventQueue::set(int body, double time) {
  times_[static_cast<std::size_t>(body)] = time;
  for (std::size_t k = (leaves_ + static_cast<std::size_t>(body)) / 2; k > 0; k /= 2) {
    const int winner = earlier(winner_[2 * k], winner_[2 * k + 1]);
    // Somebody else has won here before and does now: nothing changes further up.
    if (winner == winner_[k] && winner != body) return;
    winner_[k] = winner;
  }
}

}  // namespace plumbline
