#include "plumbline/core/events/event_cells.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace plumbline {

EventCells::EventCells(const Vec3& low, const Vec3& high, double least_width, int bodies, bool periodic)
    : low_(low), edge_(high - low), periodic_(periodic) {
  // Empty cells cost memory and crossings: few bodies in a large box get wider cells.
  const double most = 4.0 * bodies + 27;
  double width = least_width;
  const auto counted = [&](double w) {
    const Vec3 n = (edge_ / w).array().floor().max(1.0);
    return n;
  };
  while (counted(width).prod() > most) width *= 1.1;
  Vec3 counts = counted(width);
  if (periodic) {
    if (!(counted(least_width).minCoeff() >= 3)) {
      throw std::invalid_argument("a periodic box must be more than 3.1 diameters of the largest ball wide");
    }
    counts = counts.cwiseMax(3.0);
  }
  counts_ = counts.cast<int>();
  width_ = edge_.cwiseQuotient(counts);
  const auto n = static_cast<std::size_t>(bodies);
  places_.assign(n, Eigen::Vector3i::Zero());
  next_.assign(n, kNobody);
  previous_.assign(n, kNobody);
  first_.assign(static_cast<std::size_t>(counts_.prod()), kNobody);
}

void EventCells::insert(int body, const Vec3& p) {
  Eigen::Vector3i& cell = places_[static_cast<std::size_t>(body)];
  for (int axis = 0; axis < 3; ++axis) {
    const double k = width_[axis] > 0 ? std::floor((p[axis] - low_[axis]) / width_[axis]) : 0;
    cell[axis] = static_cast<int>(std::clamp(k, 0.0, static_cast<double>(counts_[axis] - 1)));
  }
  link(body);
}

double EventCells::cross(int body, int axis, bool upwards) {
  unlink(body);
  Eigen::Vector3i& cell = places_[static_cast<std::size_t>(body)];
  cell[axis] += upwards ? 1 : -1;
  Vec3 shift = Vec3::Zero();
  wrap(cell, shift);
  link(body);
  return -shift[axis];
}

void EventCells::link(int body) {
  const auto b = static_cast<std::size_t>(body);
  int& head = first_[index(places_[b])];
  next_[b] = head;
  previous_[b] = kNobody;
  if (head != kNobody) previous_[static_cast<std::size_t>(head)] = body;
  head = body;
}

void EventCells::unlink(int body) {
  const auto b = static_cast<std::size_t>(body);
  if (next_[b] != kNobody) previous_[static_cast<std::size_t>(next_[b])] = previous_[b];
  if (previous_[b] != kNobody) {
    next_[static_cast<std::size_t>(previous_[b])] = next_[b];
  } else {
    first_[index(places_[b])] = next_[b];
  }
}

}  // namespace plumbline
