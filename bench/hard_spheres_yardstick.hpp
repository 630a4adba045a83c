// A fixed piece of work that tells how fast this processor is just now.
//
// A figure of another program, measured elsewhere and at another time, means nothing beside one measured here. Both
// programs were once run in the same minutes as this loop; multiplied by what the loop takes now over what it took
// then, the other's figure is what it would be here and now, to some 10 %.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace plumbline::bench {

// The character of predicting events: from a record follow a link to another that lies anywhere, solve the quadratic
// equation of two spheres that meet, branch on whether they do, and let the answer decide where to go on.
class Yardstick {
 public:
  Yardstick() : records_(std::size_t{1} << kBits) {
    std::uint64_t bits = 1;
    for (Record& record : records_) {
      for (double& number : record.number) {
        bits = bits * 6364136223846793005u + 1442695040888963407u;  // Knuth's generator
        number = 0x1p-30 * static_cast<double>(bits >> 33) - 1;
      }
    }
  }

  // One step costs some 50 ns; the result must be used.
  double run(std::size_t steps) const {
    double sum = 0;
    std::size_t at = 0;
    for (std::size_t k = 0; k < steps; ++k) {
      const double* p = records_[at].number;
      const double rv = p[0] * p[3] + p[1] * p[4] + p[2] * p[5] - 1;
      const double vv = p[3] * p[3] + p[4] * p[4] + p[5] * p[5];
      const double gap = p[0] * p[0] + p[1] * p[1] + p[2] * p[2] - 0.25;
      const double radicand = rv * rv - vv * gap;
      double time = 0.5 + p[6];
      if (radicand > 0) time = gap / (std::sqrt(radicand) - rv);
      sum += time;
      const double next = std::abs(time * 1e6) + static_cast<double>(k);
      at = static_cast<std::size_t>(next) * 2654435761u >> 7 & (records_.size() - 1);
    }
    return sum;
  }

 private:
  static constexpr int kBits = 15;  // of 64 bytes each: 2 MiB, more than the second cache of most processors
  struct alignas(64) Record {
    double number[8];
  };
  std::vector<Record> records_;
};

}  // namespace plumbline::bench
