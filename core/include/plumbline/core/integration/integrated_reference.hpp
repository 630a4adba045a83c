// A scenario's smooth motion by integration, as its truth: joints, springs, drives and force laws, but no contact.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "plumbline/core/reference.hpp"
#include "plumbline/core/scenario.hpp"

namespace plumbline {

class IntegratedReference final : public Reference {
 public:
  // `uncertainty`: what is claimed of it, relative to the length scale; certification.hpp checks it by a second method.
  // Throws std::invalid_argument for a scenario with contact or with limits of joints: their motion is not smooth.
  IntegratedReference(const Scenario& scenario, std::string citation, double uncertainty);
  ~IntegratedReference() override;
  // One thread at a time; cheap as long as t rises.
  BodyState at(std::size_t body, double t) const override;
  double uncertainty() const override { return uncertainty_; }
  std::string_view citation() const override { return citation_; }
  std::string_view kind() const override { return "ode"; }
  std::string_view bound_source() const override { return "agreement with a second method of integration"; }

 private:
  struct Integration;
  std::unique_ptr<Integration> integration_;
  std::string citation_;
  double uncertainty_;
};

}  // namespace plumbline
