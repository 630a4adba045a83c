// A scenario's smooth motion by integration, as its truth: joints, springs, drives and force laws, but no contact.
//
// Equations of motion of its own in extended precision, apart from those of the core's steppers, integrated by
// collocation of order 24 with dense output, joints held to the last digit. Rounded to double at the end. What it is
// worth is not known from itself: integration_agreement.hpp asks other methods.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "plumbline/core/reference.hpp"
#include "plumbline/core/scenario.hpp"

namespace plumbline {

class IntegratedReference final : public Reference {
 public:
  // `uncertainty`: what is claimed of it, relative to the length scale.
  // Throws std::invalid_argument for a scenario with contact or with limits of joints: their motion is not smooth.
  IntegratedReference(const Scenario& scenario, std::string citation, double uncertainty);
  ~IntegratedReference() override;
  // One thread at a time. Integrates up to the latest t that was asked for, once; the states in between are kept.
  // Throws std::runtime_error when the motion is singular, stiff beyond reason or not finite.
  BodyState at(std::size_t body, double t) const override;
  double uncertainty() const override { return uncertainty_; }
  std::string_view citation() const override { return citation_; }
  std::string_view kind() const override { return "ode"; }
  std::string_view bound_source() const override { return "agreement with a second method in extended precision"; }

 private:
  struct Integration;
  std::unique_ptr<Integration> integration_;
  std::string citation_;
  double uncertainty_;
};

}  // namespace plumbline
