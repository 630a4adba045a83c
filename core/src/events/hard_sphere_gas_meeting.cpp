// This file alone is compiled with -O3 and without errno for sqrt, so that the second loop below becomes one of
// vectors; and where the compiler can, once more for AVX2 and for AVX-512, chosen when the program starts. Every
// operation is rounded as IEEE 754 says and none is fused or reordered, so all of them give the same bits.
#include "hard_sphere_gas_meeting.hpp"

#include <cmath>
#include <limits>

#if defined(__x86_64__) && defined(__linux__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__)
#define PLUMBLINE_FOR_EACH_PROCESSOR __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define PLUMBLINE_FOR_EACH_PROCESSOR
#endif

namespace plumbline {

PLUMBLINE_FOR_EACH_PROCESSOR
void find_meeting_times(const GasSphere& me, double now, double diameter_square, const GasSphere* spheres,
                        const GasCells::Shift* shifts, GasCandidates& near) {
  constexpr int kBlock = 8;
  struct alignas(64) {
    double x[kBlock], y[kBlock], z[kBlock], vx[kBlock], vy[kBlock], vz[kBlock], time[kBlock];
  } q;
  for (int start = 0; start < near.count; start += kBlock) {
    for (int k = 0; k < kBlock; ++k) {
      const int c = start + k < near.count ? start + k : near.count - 1;
      const GasSphere& other = spheres[near.id[c]];
      const double* shift = shifts[near.neighbour[c]].by;
      q.x[k] = other.p[0] + shift[0];
      q.y[k] = other.p[1] + shift[1];
      q.z[k] = other.p[2] + shift[2];
      q.vx[k] = other.v[0];
      q.vy[k] = other.v[1];
      q.vz[k] = other.v[2];
      q.time[k] = other.time;
    }
    for (int k = 0; k < kBlock; ++k) {
      const double behind = now - q.time[k];
      const double x = q.x[k] + q.vx[k] * behind - me.p[0];
      const double y = q.y[k] + q.vy[k] * behind - me.p[1];
      const double z = q.z[k] + q.vz[k] * behind - me.p[2];
      const double vx = q.vx[k] - me.v[0], vy = q.vy[k] - me.v[1], vz = q.vz[k] - me.v[2];
      const double rv = x * vx + y * vy + z * vz;
      const double gap = x * x + y * y + z * z - diameter_square;
      const double radicand = rv * rv - (vx * vx + vy * vy + vz * vz) * gap;
      const bool meet = (rv < 0) & (radicand >= 0);
      const double root = std::sqrt(radicand < 0 ? 0.0 : radicand);
      const double wait = (gap < 0 ? 0.0 : gap) / (root - rv);
      near.time[start + k] = meet ? now + wait : std::numeric_limits<double>::infinity();
    }
  }
}

}  // namespace plumbline
