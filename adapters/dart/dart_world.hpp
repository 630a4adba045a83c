// One scenario in a world of DART, apart from the rows: DART's headers are slow to compile, and only one file needs
// them.
#pragma once

#include <memory>

#include "plumbline/core/engine.hpp"

namespace plumbline {

enum class LcpSolver { kDantzig, kPgs };
enum class Detector { kOde, kFcl };
enum class FrictionAxis { kFixed, kMotion };

struct DartKnobs {
  LcpSolver solver = LcpSolver::kDantzig;
  Detector detector;
  FrictionAxis friction_axis;
  double error_reduction, max_error_reduction_velocity;
  bool correct_within_gravity_step;
  double error_allowance, force_mixing;
  double loop_error_reduction;
  bool pgs_fallback;
  int pgs_iterations;
  double pgs_absolute_change, pgs_relative_change;
};

std::unique_ptr<World> make_dart_world(const Scenario& scenario, const DartKnobs& knobs);

}  // namespace plumbline
