// A calendar of events: one a sphere, in buckets of time.
//
// A bucket is an unsorted list. Buckets are so narrow that the current one holds an event or two, and looking for the
// earliest of these costs less than keeping anything sorted: insert, move and take out all cost the same however
// many events there are. There are four buckets a sphere, used over and over like the days of a wall calendar. An
// event that lies further ahead than that waits in the last bucket and is put off when its turn comes.
#pragma once

#include <cstdint>
#include <limits>

#include "hard_sphere_gas_cells.hpp"
#include "hard_sphere_gas_pages.hpp"

namespace plumbline {

class GasCalendar {
 public:
  static constexpr std::int32_t kNobody = 0;  // spheres are numbered from 1
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  // What a sphere waits for; one line of the cache, which only those touch whose event it is.
  struct alignas(64) Event {
    double due = kNever;             // when to wake: the smaller of the next collision or search, and of `cross`
    double cross = kNever;           // leaves its cell
    std::int32_t partner = kNobody;  // of the collision; nobody: time to look for one
    std::int32_t before = kNobody, after = kNobody;  // in the list of the bucket
    std::int32_t bucket = 0;
    std::int32_t leaves_by = 0;  // axis of the side by which it leaves, 0 to 2
    GasCell cell = {};           // in which it is
  };

  // `rate`: about how many events a sphere has per unit of time.
  GasCalendar(std::size_t spheres, double rate) : events_(spheres + 1) {
    std::size_t buckets = 16;
    while (buckets < 4 * spheres) buckets *= 2;
    heads_.assign(buckets, kNobody);
    mask_ = static_cast<std::int64_t>(buckets) - 1;
    per_time_ = rate * static_cast<double>(spheres);
  }

  Event& operator[](std::int32_t id) { return events_[static_cast<std::size_t>(id)]; }
  const Event& operator[](std::int32_t id) const { return events_[static_cast<std::size_t>(id)]; }
  PagedVector<Event>& events() { return events_; }

  // Empties all buckets and starts at time 0; the events themselves stay and are to be inserted again.
  void restart() {
    heads_.assign(heads_.size(), kNobody);
    current_ = 0;
  }

  void insert(std::int32_t id, double due) {
    Event& event = (*this)[id];
    event.due = due;
    std::int64_t bucket = bucket_of(due);
    if (bucket < current_) bucket = current_;
    if (bucket > current_ + mask_) bucket = current_ + mask_;
    event.bucket = static_cast<std::int32_t>(bucket & mask_);
    std::int32_t& head = heads_[static_cast<std::size_t>(event.bucket)];
    event.before = kNobody;
    event.after = head;
    if (head != kNobody) (*this)[head].before = id;
    head = id;
  }

  void remove(std::int32_t id) {
    const Event& event = (*this)[id];
    if (event.before != kNobody) {
      (*this)[event.before].after = event.after;
    } else {
      heads_[static_cast<std::size_t>(event.bucket)] = event.after;
    }
    if (event.after != kNobody) (*this)[event.after].before = event.before;
  }

  // The sphere whose event is the earliest; it stays in the calendar. Of several at one time the lowest number.
  std::int32_t first() {
    for (;;) {
      std::int32_t& head = heads_[static_cast<std::size_t>(current_ & mask_)];
      std::int32_t earliest = kNobody;
      double due = kNever;
      for (std::int32_t id = head; id != kNobody; id = (*this)[id].after) {
        const double at = (*this)[id].due;
        if (at > due || bucket_of(at) > current_) continue;
        if (at < due || id < earliest) {
          due = at;
          earliest = id;
        }
      }
      if (earliest != kNobody) return earliest;
      put_off(head);
    }
  }

 private:
  // Times beyond the range of the calendar, infinity among them, fall on its last day.
  std::int64_t bucket_of(double time) const {
    const double bucket = time * per_time_;
    return bucket < kLastBucket ? static_cast<std::int64_t>(bucket) : static_cast<std::int64_t>(kLastBucket);
  }

  // On to the next day; what is left in the current one was not yet due.
  void put_off(std::int32_t& head) {
    std::int32_t waiting = head;
    head = kNobody;
    ++current_;
    while (waiting != kNobody) {
      const std::int32_t id = waiting;
      waiting = (*this)[id].after;
      insert(id, (*this)[id].due);
    }
  }

  static constexpr double kLastBucket = 4e18;

  PagedVector<Event> events_;
  PagedVector<std::int32_t> heads_;
  std::int64_t mask_;
  std::int64_t current_ = 0;
  double per_time_;  // buckets per unit of time
};

}  // namespace plumbline
