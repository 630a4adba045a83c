#include "plumbline/core/kinetics/free_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "plumbline/core/vector_clones.hpp"

namespace plumbline {
namespace {

constexpr std::size_t kTile = 256;  // bodies that go through all steps together: 32 KiB of numbers

// Half angles of a step up to 1/4 rad are turned by the series; a tile with a larger one takes the slow way.
constexpr double kLargestSquare = 0.0625;

// One tile of each row. No two rows overlap, which `ivdep` tells the compiler: each body is on its own.
struct Tile {
  double *px, *py, *pz;
  double *qx, *qy, *qz, *qw;
  double *vx, *vy, *vz;
  double *wx, *wy, *wz;
  const double *cx, *cy, *cz;
  std::size_t size;
};

PLUMBLINE_VECTOR_CLONES void fall(const Tile& t, double gx, double gy, double gz, double h) {
  double *px = t.px, *py = t.py, *pz = t.pz;
  double *vx = t.vx, *vy = t.vy, *vz = t.vz;
  const std::size_t size = t.size;
#pragma GCC ivdep
  for (std::size_t i = 0; i < size; ++i) {
    vx[i] += gx * h;
    vy[i] += gy * h;
    vz[i] += gz * h;
    px[i] += vx[i] * h;
    py[i] += vy[i] * h;
    pz[i] += vz[i] * h;
  }
}

// Euler's equation in the body frame. Returns how many half angles of the step are too large for the series.
PLUMBLINE_VECTOR_CLONES long long spin(const Tile& t, double h) {
  double *wx = t.wx, *wy = t.wy, *wz = t.wz;
  const double *cx = t.cx, *cy = t.cy, *cz = t.cz;
  const std::size_t size = t.size;
  const double quarter = 0.25 * h * h;
  long long large = 0;
#pragma GCC ivdep
  for (std::size_t i = 0; i < size; ++i) {
    const double x = wx[i], y = wy[i], z = wz[i];
    const double nx = x + h * (cx[i] * (y * z)), ny = y + h * (cy[i] * (z * x)), nz = z + h * (cz[i] * (x * y));
    wx[i] = nx;
    wy[i] = ny;
    wz[i] = nz;
    large += quarter * (nx * nx + ny * ny + nz * nz) > kLargestSquare ? 1 : 0;
  }
  return large;
}

// Horner's scheme for 1 - s c1 (1 - s c2 (1 - ...)), whose constants make it cos a or sin a / a in s = a^2 <= 1/16: the
// first terms left out are s^7/14! < 5e-20 and s^7/15!.
inline double series(double s, double c1, double c2, double c3, double c4, double c5, double c6) {
  return 1 - s * c1 * (1 - s * c2 * (1 - s * c3 * (1 - s * c4 * (1 - s * c5 * (1 - s * c6)))));
}

// q <- q exp(w h)
PLUMBLINE_VECTOR_CLONES void turn(const Tile& t, double h) {
  double *qx = t.qx, *qy = t.qy, *qz = t.qz, *qw = t.qw;
  const double *wx = t.wx, *wy = t.wy, *wz = t.wz;
  const std::size_t size = t.size;
#pragma GCC ivdep
  for (std::size_t i = 0; i < size; ++i) {
    const double ax = 0.5 * h * wx[i], ay = 0.5 * h * wy[i], az = 0.5 * h * wz[i];
    const double s = ax * ax + ay * ay + az * az;
    const double rw = series(s, 1.0 / 2, 1.0 / 12, 1.0 / 30, 1.0 / 56, 1.0 / 90, 1.0 / 132);
    const double sinc = series(s, 1.0 / 6, 1.0 / 20, 1.0 / 42, 1.0 / 72, 1.0 / 110, 1.0 / 156);
    const double rx = sinc * ax, ry = sinc * ay, rz = sinc * az;
    const double x = qx[i], y = qy[i], z = qz[i], w = qw[i];
    const double nx = w * rx + x * rw + y * rz - z * ry, ny = w * ry - x * rz + y * rw + z * rx;
    const double nz = w * rz + x * ry - y * rx + z * rw, nw = w * rw - x * rx - y * ry - z * rz;
    const double scale = 1.5 - 0.5 * (nx * nx + ny * ny + nz * nz + nw * nw);
    qx[i] = scale * nx;
    qy[i] = scale * ny;
    qz[i] = scale * nz;
    qw[i] = scale * nw;
  }
}

// The same for angles of any size.
void turn_far(const Tile& t, double h) {
  for (std::size_t i = 0; i < t.size; ++i) {
    Quat q = Quat(t.qw[i], t.qx[i], t.qy[i], t.qz[i]) * rotation_by(h * Vec3(t.wx[i], t.wy[i], t.wz[i]));
    q.normalize();
    t.qx[i] = q.x();
    t.qy[i] = q.y();
    t.qz[i] = q.z();
    t.qw[i] = q.w();
  }
}

}  // namespace

FreeBodies::FreeBodies(std::span<const Body> bodies, const Vec3& gravity_W)
    : gravity_W_(gravity_W), size_(bodies.size()), stride_((bodies.size() + 7) / 8 * 8), values_(stride_ * kRows) {
  const auto row = rows();
  for (std::size_t i = 0; i < size_; ++i) {
    const Body& body = bodies[i];
    const Vec3& m = body.inertia;
    if (body.fixed || !(body.mass > 0) || !(m.minCoeff() > 0)) {
      throw std::invalid_argument("body '" + body.name +
                                  "' cannot fly freely: it must move, with a mass and three moments of inertia > 0");
    }
    const BodyState& s = body.initial;
    const Vec3 w_B = s.q_WB.conjugate() * s.w_WB;
    const double numbers[kRows] = {s.p_WB.x(),
                                   s.p_WB.y(),
                                   s.p_WB.z(),
                                   s.q_WB.x(),
                                   s.q_WB.y(),
                                   s.q_WB.z(),
                                   s.q_WB.w(),
                                   s.v_WB.x(),
                                   s.v_WB.y(),
                                   s.v_WB.z(),
                                   w_B.x(),
                                   w_B.y(),
                                   w_B.z(),
                                   (m.y() - m.z()) / m.x(),
                                   (m.z() - m.x()) / m.y(),
                                   (m.x() - m.y()) / m.z()};
    for (std::size_t k = 0; k < kRows; ++k) row[k][i] = numbers[k];
  }
}

std::array<double*, FreeBodies::kRows> FreeBodies::rows() {
  std::array<double*, kRows> row;
  for (std::size_t k = 0; k < kRows; ++k) row[k] = values_.data() + k * stride_;
  return row;
}

void FreeBodies::step(double dt, std::size_t steps) {
  if (!(dt > 0)) throw std::invalid_argument("a step of " + std::to_string(dt) + " s: it must be > 0");
  const auto row = rows();
  for (std::size_t first = 0; first < size_; first += kTile) {
    const auto at = [&](std::size_t k) { return row[k] + first; };
    const Tile tile{at(kP),
                    at(kP + 1),
                    at(kP + 2),
                    at(kQ),
                    at(kQ + 1),
                    at(kQ + 2),
                    at(kQ + 3),
                    at(kV),
                    at(kV + 1),
                    at(kV + 2),
                    at(kW),
                    at(kW + 1),
                    at(kW + 2),
                    at(kC),
                    at(kC + 1),
                    at(kC + 2),
                    std::min(kTile, size_ - first)};
    for (std::size_t k = 0; k < steps; ++k) {
      fall(tile, gravity_W_.x(), gravity_W_.y(), gravity_W_.z(), dt);
      if (spin(tile, dt) == 0) {
        turn(tile, dt);
      } else {
        turn_far(tile, dt);
      }
    }
  }
}

void FreeBodies::read(std::span<BodyState> states) const {
  if (states.size() != size_) {
    throw std::invalid_argument("room for " + std::to_string(states.size()) + " states, but there are " +
                                std::to_string(size_) + " bodies");
  }
  const auto value = [&](std::size_t k, std::size_t i) { return values_[k * stride_ + i]; };
  for (std::size_t i = 0; i < size_; ++i) {
    BodyState& s = states[i];
    s.p_WB = Vec3(value(kP, i), value(kP + 1, i), value(kP + 2, i));
    s.q_WB.coeffs() << value(kQ, i), value(kQ + 1, i), value(kQ + 2, i), value(kQ + 3, i);
    s.v_WB = Vec3(value(kV, i), value(kV + 1, i), value(kV + 2, i));
    s.w_WB = s.q_WB * Vec3(value(kW, i), value(kW + 1, i), value(kW + 2, i));
  }
}

}  // namespace plumbline
