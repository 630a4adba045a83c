// How sure an integrated reference is: the same motion by other methods (what certifies kind = "ode").
//
//   the reference   Gauss collocation in extended precision, on equations of its own (integrated_reference.hpp)
//   second_method   an explicit Runge-Kutta-Fehlberg pair of order 7(8) from Boost.Odeint, in extended precision too:
//                   another family of methods, other step sizes, somebody else's code; the same equations
//   core_field      Dormand-Prince 8(5,3) in double precision on the core's own equations (constrained_motion.hpp,
//                   force_following.hpp): other equations, derived and written separately
//
// The first finds errors of integration, down to 1e-18 a step; the second errors of the equations, as far as double
// precision and the growth of its roundings (sensitivity.hpp) let it see.
#pragma once

#include "plumbline/core/scenario.hpp"

namespace plumbline {

// Largest distances to the reference, over all bodies and over times that are spread evenly up to
// min(t_valid, duration): places over the scenario's length scale, and angles between attitudes [rad]; the larger.
struct Agreement {
  double second_method = 0;
  double core_field = 0;
};

// Throws as IntegratedReference does, and std::runtime_error when one of the methods cannot go on (a field that is
// singular or not finite).
Agreement integration_agreement(const Scenario& scenario);

}  // namespace plumbline
