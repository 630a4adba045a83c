// The event-driven simulator as the truth: smooth spheres among themselves and on half-spaces, each impact at its time.
//
// Between impacts the motion is a parabola and nothing is integrated, so what is off is the rounding of clocks and
// places, magnified by the impacts (event_driven_simulator.hpp).
#pragma once

#include <memory>
#include <string>

#include "plumbline/core/events/event_driven_simulator.hpp"
#include "plumbline/core/reference.hpp"
#include "plumbline/core/scenario.hpp"

namespace plumbline {

class EventReference final : public Reference {
 public:
  // Throws std::invalid_argument for a scenario that is not smooth spheres and half-spaces under gravity.
  EventReference(const Scenario& scenario, std::string citation);
  // One thread at a time; cheap as long as t rises.
  BodyState at(std::size_t body, double t) const override;
  // What two spheres that start a rounding apart have made of it at the end.
  double uncertainty() const override { return uncertainty_; }
  std::string_view citation() const override { return citation_; }
  std::string_view kind() const override { return "events"; }
  std::string_view bound_source() const override {
    return "distance at the end to a run from initial places that are 1e-15 of the length off";
  }

 private:
  void go_to(double t) const;

  std::string citation_;
  std::vector<BodyState> initial_;
  std::vector<std::size_t> ball_of_;  // per body; kNoBall for half-spaces
  std::unique_ptr<const EventDrivenSimulator> start_;
  mutable std::unique_ptr<EventDrivenSimulator> now_;
  double uncertainty_ = 0;
};

}  // namespace plumbline
