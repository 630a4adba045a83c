// Who checks the reference? Second opinions about a scenario's truth, each with what it found and how far it may go.
//
//   motion       the reference in the equation of motion: what it gains over short spans of time against the integral
//                of its own velocities and of the accelerations that forces, springs and joints give it
//   agreement    a reference that was integrated, or a published table, against another integration
//   simulation   where bodies touch or joints have limits: the core's simulator, which cuts its steps at each impact
//   invariant    energy and momenta where nothing changes them
//   certificate  what the file itself states: published values, second derivations
//   threshold    the critical value by bisection on the core's own motion
//   start, touch, joints, validity   what must hold besides: the initial state, bodies that touch at the time of an
//                event, joints that hold, the time up to which chaos allows a comparison
//
// The former group tells by itself whether the motion is right; a reference needs one of them.
#pragma once

#include <string>
#include <vector>

#include "plumbline/core/reference.hpp"
#include "plumbline/core/scenario.hpp"

namespace plumbline {

struct CertificationRow {
  std::string source;       // the word above
  std::string compared;     // what with what, for people
  double figure = 0;        // the worst difference; relative to the scenario's scales, but for certificates
  double bound = 0;         // what it may amount to, in the same unit
  bool independent = true;  // whether the row alone says that the motion is right
  SourcePlace place;        // of a certificate
  bool holds() const { return within(figure, bound); }  // NaN never does
};

struct Certification {
  std::vector<CertificationRow> rows;
  // Second opinions that could not be had, and why: "simulation: the core has no contact of cylinders".
  std::vector<std::string> left_out;

  bool has_second_source() const;
  // All rows hold, and at least one of them is independent.
  bool holds() const;
  // The first row that fails; nullptr when none does.
  const CertificationRow* failure() const;
  // Of the rows that are independent the one that is nearest to its bound, or beyond it; nullptr when there is none.
  const CertificationRow* closest() const;
};

Certification certify(const Scenario& scenario, const Reference& reference);

}  // namespace plumbline
