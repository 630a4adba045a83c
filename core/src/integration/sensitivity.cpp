#include "plumbline/core/integration/sensitivity.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <stdexcept>

#include "gauss_collocation.hpp"
#include "plumbline/core/events/event_reference.hpp"

namespace plumbline {
namespace {

using extended::Column;
using extended::Real;

constexpr double kStartDistance = 1e-9;  // of a copy, in scaled coordinates
constexpr Eigen::Index kMostCopies = 12;
constexpr int kMostTries = 64;
constexpr int kTimes = 1000;  // at which validity is looked at

// The same motion from a slightly other start.
class Copy {
 public:
  virtual ~Copy() = default;
  virtual void read(double t, std::vector<BodyState>& states) = 0;  // t rises
};

// Makes copies; the one that is not displaced is the motion itself.
class Source {
 public:
  virtual ~Source() = default;
  // From the start displaced by 12 numbers for each body, of size 1, times the distance. Null: it cannot start there.
  virtual std::unique_ptr<Copy> displaced(const Eigen::VectorXd& direction, double distance) = 0;
};

// Where b stands as seen from a: 12 numbers a body over the scales.
Eigen::VectorXd difference(const Scenario& scenario, const std::vector<BodyState>& a, const std::vector<BodyState>& b) {
  const Scales& scales = scenario.scales;
  Eigen::VectorXd d(static_cast<Eigen::Index>(12 * a.size()));
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Quat turn = b[i].q_WB * a[i].q_WB.conjugate();
    const double angle = geodesic_angle(a[i].q_WB, b[i].q_WB), sine = turn.vec().norm();
    const Vec3 axis = sine > 0 ? Vec3(std::copysign(1 / sine, turn.w()) * turn.vec()) : Vec3::Zero();
    d.segment<12>(static_cast<Eigen::Index>(12 * i)) << (b[i].p_WB - a[i].p_WB) / scales.length, angle * axis,
        (b[i].v_WB - a[i].v_WB) / scales.velocity(), (b[i].w_WB - a[i].w_WB) * scales.time;
  }
  return d;
}

class SmoothCopy final : public Copy {
 public:
  SmoothCopy(extended::Motion& motion, const Column& x, const Column& u)
      : motion_(motion), method_(motion, x, u, static_cast<Real>(motion.scenario().duration)) {}
  void read(double t, std::vector<BodyState>& states) override {
    method_.read(static_cast<Real>(t), x_, u_);
    motion_.read(x_, u_, states);
  }

 private:
  extended::Motion& motion_;
  extended::GaussCollocation method_;
  Column x_, u_;
};

class SmoothSource final : public Source {
 public:
  explicit SmoothSource(const Scenario& scenario) : motion_(scenario) { motion_.start(x_, u_); }

  std::unique_ptr<Copy> displaced(const Eigen::VectorXd& direction, double distance) override {
    const Scales& scales = motion_.scenario().scales;
    Column x = x_, u = u_, step(u_.size());
    for (Eigen::Index i = 0, b = 0; i < motion_.moving(); ++b) {
      if (motion_.scenario().bodies[static_cast<std::size_t>(b)].fixed) continue;
      const Eigen::Matrix<double, 12, 1> d = distance * direction.segment<12>(12 * b);
      step.segment<6>(6 * i) << scales.length * d.head<3>().cast<Real>(), d.segment<3>(3).cast<Real>();
      u.segment<6>(6 * i).head<3>() += scales.velocity() * d.segment<3>(6).cast<Real>();
      u.segment<6>(6 * i).tail<3>() += d.tail<3>().cast<Real>() / scales.time;
      ++i;
    }
    motion_.displace(x, step);
    motion_.project(x, u);
    return std::make_unique<SmoothCopy>(motion_, x, u);
  }

 private:
  extended::Motion motion_;
  Column x_, u_;
};

class EventCopy final : public Copy {
 public:
  explicit EventCopy(const Scenario& scenario) : reference_(scenario, "") {}
  void read(double t, std::vector<BodyState>& states) override {
    for (std::size_t b = 0; b < states.size(); ++b) states[b] = reference_.at(b, t);
  }

 private:
  EventReference reference_;
};

// Spheres without friction: their attitudes and spins concern nobody and are left alone.
class EventSource final : public Source {
 public:
  explicit EventSource(const Scenario& scenario) : scenario_(scenario) { scenario_.t_valid = 0; }

  std::unique_ptr<Copy> displaced(const Eigen::VectorXd& direction, double distance) override {
    // Spheres that touch at the start may only move apart; where both ways fail their velocities alone differ.
    for (const double places : {1.0, -1.0, 0.0}) {
      Scenario copy = scenario_;
      for (std::size_t b = 0; b < copy.bodies.size(); ++b) {
        Body& body = copy.bodies[b];
        if (body.fixed) continue;
        const auto at = static_cast<Eigen::Index>(12 * b);
        body.initial.p_WB += places * distance * scenario_.scales.length * direction.segment<3>(at);
        body.initial.v_WB += distance * scenario_.scales.velocity() * direction.segment<3>(at + 6);
      }
      try {
        return std::make_unique<EventCopy>(copy);
      } catch (const std::invalid_argument&) {
        if (distance == 0) throw;  // the scenario itself is not for it
      }
    }
    return nullptr;
  }

 private:
  Scenario scenario_;
};

class Growth {
 public:
  explicit Growth(const Scenario& scenario)
      : scenario_(scenario), states_(scenario.bodies.size()), displaced_(scenario.bodies.size()) {
    if (scenario.contact) {
      source_ = std::make_unique<EventSource>(scenario);
    } else {
      source_ = std::make_unique<SmoothSource>(scenario);
    }
    start();
  }

  double at(double t) {
    if (copies_.empty()) return 1;
    motion_->read(t, states_);
    Eigen::MatrixXd D(12 * static_cast<Eigen::Index>(states_.size()), static_cast<Eigen::Index>(copies_.size()));
    for (std::size_t k = 0; k < copies_.size(); ++k) {
      copies_[k]->read(t, displaced_);
      D.col(static_cast<Eigen::Index>(k)) = difference(scenario_, states_, displaced_);
    }
    D = D * from_start_;
    if (!D.allFinite()) return std::nan("");
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> squares(D.transpose() * D, Eigen::EigenvaluesOnly);
    return std::sqrt(std::max(0.0, squares.eigenvalues().maxCoeff()));
  }

 private:
  // Directions are drawn at random, always the same ones, as long as the joints leave something new of them.
  void start() {
    const auto size = static_cast<Eigen::Index>(12 * states_.size());
    motion_ = source_->displaced(Eigen::VectorXd::Zero(size), 0);
    motion_->read(0, states_);
    std::mt19937 random(20221);
    const auto number = [&] { return 2 * static_cast<double>(random()) / static_cast<double>(random.max()) - 1; };
    Eigen::MatrixXd start(size, 0), orthogonal(size, 0);
    for (int tries = 0; tries < kMostTries && start.cols() < kMostCopies; ++tries) {
      Eigen::VectorXd direction = Eigen::VectorXd::NullaryExpr(size, number);
      direction.normalize();
      std::unique_ptr<Copy> copy = source_->displaced(direction, kStartDistance);
      if (copy == nullptr) continue;
      copy->read(0, displaced_);
      const Eigen::VectorXd d = difference(scenario_, states_, displaced_);
      Eigen::VectorXd left = d;
      for (int sweep = 0; sweep < 2; ++sweep) left -= orthogonal * (orthogonal.transpose() * left);
      // What is left of a direction that the others span already is their rounding.
      if (!(left.norm() > 1e-4 * d.norm() && d.norm() > 1e-5 * kStartDistance)) continue;
      orthogonal.conservativeResize(Eigen::NoChange, start.cols() + 1);
      start.conservativeResize(Eigen::NoChange, start.cols() + 1);
      orthogonal.rightCols<1>() = left.normalized();
      start.rightCols<1>() = d;
      copies_.push_back(std::move(copy));
    }
    const Eigen::MatrixXd R = orthogonal.transpose() * start;
    from_start_ = R.triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(R.rows(), R.cols()));
  }

  const Scenario& scenario_;
  std::unique_ptr<Source> source_;
  std::unique_ptr<Copy> motion_;
  std::vector<std::unique_ptr<Copy>> copies_;
  Eigen::MatrixXd from_start_;  // D(0) times this has orthonormal columns
  std::vector<BodyState> states_, displaced_;
};

}  // namespace

std::vector<double> error_growth(const Scenario& scenario, std::span<const double> times) {
  Growth growth(scenario);
  std::vector<double> result;
  for (const double t : times) result.push_back(growth.at(t));
  return result;
}

double time_of_validity(const Scenario& scenario) {
  Growth growth(scenario);
  // Between the impacts of two copies on the same wall their velocities differ much, but no longer than that: only what
  // is still there at the next look counts.
  bool exceeds = false;
  for (int k = 1; k <= kTimes; ++k) {
    const bool exceeded = exceeds;
    exceeds = !(growth.at(scenario.duration * k / kTimes) <= kGrowthOfValidity);
    if (exceeds && (exceeded || !scenario.contact)) return scenario.duration * (exceeded ? k - 1 : k) / kTimes;
  }
  return scenario.duration;
}

}  // namespace plumbline
