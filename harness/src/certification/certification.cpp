#include "plumbline/harness/certification.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "second_sources.hpp"

namespace plumbline {
namespace {

constexpr int kTimes = 200;

// A motion that is computed anew whenever time goes back is gone through once; what is asked for again is remembered.
class RememberedReference final : public Reference {
 public:
  RememberedReference(const Scenario& scenario, const Reference& reference, std::vector<double> times)
      : reference_(reference) {
    std::sort(times.begin(), times.end());
    for (const double t : times) states_.emplace(t, states_of(scenario, reference, t));
  }
  BodyState at(std::size_t body, double t) const override {
    const auto found = states_.find(t);
    return found != states_.end() ? found->second[body] : reference_.at(body, t);
  }
  double uncertainty() const override { return reference_.uncertainty(); }
  std::string_view citation() const override { return reference_.citation(); }
  std::string_view kind() const override { return reference_.kind(); }
  std::string_view bound_source() const override { return reference_.bound_source(); }

 private:
  const Reference& reference_;
  std::map<double, std::vector<BodyState>> states_;
};

// Where a certificate that names no time must hold.
std::vector<double> times_of(const Scenario& scenario) {
  if (scenario.threshold || !scenario.pointwise) return {0};
  if (!scenario.known_at.empty()) return scenario.known_at;
  std::vector<double> times;
  for (int k = 0; k <= kTimes; ++k) times.push_back(compared_until(scenario) * k / kTimes);
  return times;
}

void check_certificates(const Scenario& scenario, const Reference& reference, Certification& result) {
  for (const Certificate& certificate : scenario.certificates) {
    Worst worst;
    for (const double t : certificate.time ? std::vector<double>{*certificate.time} : times_of(scenario)) {
      worst.offer(std::abs(certificate.difference(reference, t)), certificate.within, 1, "");
    }
    result.rows.push_back({"certificate", certificate.text + " (" + certificate.source + ")", worst.figure, worst.bound,
                           true, certificate.place});
  }
}

void check_motion_of(const Scenario& scenario, const Reference& reference, Certification& result) {
  const Claim claim = claim_of(scenario, reference, compared_until(scenario));
  check_start(scenario, reference, claim, result);
  if (reference.kind() == "ode") {
    check_agreement(scenario, reference, result);
  } else if (is_smooth(scenario)) {
    check_motion(scenario, reference, claim, result);
  } else {
    check_simulation(scenario, reference, claim, result);
  }
  check_joints(scenario, reference, claim, result);
  check_touch(scenario, reference, claim, result);
  check_invariants(scenario, reference, claim, result);
  check_validity(scenario, reference, result);
}

// How near a row is to its bound, or how far beyond it; a NaN is beyond everything.
double nearness(const CertificationRow& row) {
  const double ratio = row.figure / row.bound;
  return row.holds() ? (row.figure == 0 ? 0 : ratio) : std::isnan(ratio) ? HUGE_VAL : std::max(ratio, 1.0);
}

}  // namespace

bool Certification::has_second_source() const {
  return std::any_of(rows.begin(), rows.end(), [](const CertificationRow& row) { return row.independent; });
}

const CertificationRow* Certification::failure() const {
  const auto found = std::find_if(rows.begin(), rows.end(), [](const CertificationRow& row) { return !row.holds(); });
  return found == rows.end() ? nullptr : &*found;
}

bool Certification::holds() const { return failure() == nullptr && has_second_source(); }

const CertificationRow* Certification::closest() const {
  const CertificationRow* result = nullptr;
  for (const CertificationRow& row : rows) {
    if (row.independent && (result == nullptr || nearness(row) > nearness(*result))) result = &row;
  }
  return result;
}

Certification certify(const Scenario& scenario, const Reference& reference) {
  if (reference.kind() == "ode" && dynamic_cast<const RememberedReference*>(&reference) == nullptr) {
    std::vector<double> times = times_of(scenario);
    for (const Certificate& certificate : scenario.certificates) {
      if (certificate.time) times.push_back(*certificate.time);
    }
    return certify(scenario, RememberedReference(scenario, reference, std::move(times)));
  }
  Certification result;
  if (scenario.threshold) {
    check_threshold(scenario, result);
  } else if (!scenario.pointwise) {
    check_kept(scenario, result);
  } else if (!scenario.known_at.empty()) {
    check_agreement(scenario, reference, result);
  } else {
    check_motion_of(scenario, reference, result);
  }
  check_certificates(scenario, reference, result);
  return result;
}

}  // namespace plumbline
