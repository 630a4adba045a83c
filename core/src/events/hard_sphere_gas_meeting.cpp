// This file alone is compiled with -O3 and without errno for sqrt, so that the roots of several lanes become one
// instruction. Every operation is rounded as IEEE 754 says and none is fused or reordered: all widths give the same
// bits.
#include "hard_sphere_gas_meeting.hpp"

#include <cmath>
#include <limits>

namespace plumbline {
namespace {

template <int kLanes>
struct Vector {
  using Type __attribute__((vector_size(kLanes * sizeof(double)))) = double;
  using Mask __attribute__((vector_size(kLanes * sizeof(double)))) = long long;
};

// Rows become columns: first blocks of half the size change places across the diagonal, then quarters, ...
template <int kLanes, int kBlock = kLanes / 2>
[[gnu::always_inline]] inline void transpose(typename Vector<kLanes>::Type* rows) {
  typename Vector<kLanes>::Mask upper, lower;
  for (int k = 0; k < kLanes; ++k) {
    upper[k] = (k & kBlock) == 0 ? k : kLanes + k - kBlock;
    lower[k] = (k & kBlock) == 0 ? k + kBlock : kLanes + k;
  }
  for (int i = 0; i < kLanes; ++i) {
    if ((i & kBlock) != 0) continue;
    const auto a = rows[i], b = rows[i + kBlock];
    rows[i] = __builtin_shuffle(a, b, upper);
    rows[i + kBlock] = __builtin_shuffle(a, b, lower);
  }
  if constexpr (kBlock > 1) transpose<kLanes, kBlock / 2>(rows);
}

// kLanes candidates at once; what is left of the last group repeats its last candidate.
template <int kLanes>
[[gnu::always_inline]] inline void find_by_lanes(const GasSphere& me, double now, double diameter_square,
                                                 const GasSphere* spheres, const GasCells::Shift* shifts,
                                                 GasCandidates& near) {
  using Lanes = typename Vector<kLanes>::Type;
  const GasSphere own = me;  // a copy, which nothing written below can change
  for (int start = 0; start < near.count; start += kLanes) {
    // One sphere a row, eight numbers long: px py pz vx vy vz time meet.
    Lanes rows[8];
    for (int k = 0; k < kLanes; ++k) {
      const int c = start + k < near.count ? start + k : near.count - 1;
      const auto* numbers = reinterpret_cast<const Lanes*>(&spheres[near.id[c]]);
      const auto* shift = reinterpret_cast<const Lanes*>(&shifts[near.neighbour[c]]);
      for (int part = 0; part < 8 / kLanes; ++part) rows[part * kLanes + k] = numbers[part] + shift[part];
    }
    for (int part = 0; part < 8 / kLanes; ++part) transpose<kLanes>(rows + part * kLanes);
    alignas(64) double q[8][kLanes];
    for (int part = 0; part < 8; ++part) *reinterpret_cast<Lanes*>(q[part]) = rows[part];
    double* time = near.time + start;
    for (int k = 0; k < kLanes; ++k) {
      const double behind = now - q[6][k];
      const double x = q[0][k] + q[3][k] * behind - own.p[0];
      const double y = q[1][k] + q[4][k] * behind - own.p[1];
      const double z = q[2][k] + q[5][k] * behind - own.p[2];
      const double vx = q[3][k] - own.v[0], vy = q[4][k] - own.v[1], vz = q[5][k] - own.v[2];
      const double rv = x * vx + y * vy + z * vz;
      const double gap = x * x + y * y + z * z - diameter_square;
      const double radicand = rv * rv - (vx * vx + vy * vy + vz * vz) * gap;
      const double root = std::sqrt(radicand < 0 ? 0.0 : radicand);
      const double wait = (gap < 0 ? 0.0 : gap) / (root - rv);
      const bool meet = (rv < 0) & (radicand >= 0) & (now + wait < q[7][k]);
      time[k] = meet ? now + wait : std::numeric_limits<double>::infinity();
    }
  }
}

void find_two(const GasSphere& me, double now, double diameter_square, const GasSphere* spheres,
              const GasCells::Shift* shifts, GasCandidates& near) {
  find_by_lanes<2>(me, now, diameter_square, spheres, shifts, near);
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void find_four(const GasSphere& me, double now, double diameter_square,
                                       const GasSphere* spheres, const GasCells::Shift* shifts, GasCandidates& near) {
  find_by_lanes<4>(me, now, diameter_square, spheres, shifts, near);
}

[[gnu::target("avx512f")]] void find_eight(const GasSphere& me, double now, double diameter_square,
                                           const GasSphere* spheres, const GasCells::Shift* shifts,
                                           GasCandidates& near) {
  find_by_lanes<8>(me, now, diameter_square, spheres, shifts, near);
}
#endif

}  // namespace

int widest_lanes() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f")) return 8;
  if (__builtin_cpu_supports("avx2")) return 4;
#endif
  return 2;
}

FindMeetingTimes meeting_times_by(int lanes) {
#if defined(__x86_64__)
  if (lanes == 8) return find_eight;
  if (lanes == 4) return find_four;
#endif
  return find_two;
}

}  // namespace plumbline
