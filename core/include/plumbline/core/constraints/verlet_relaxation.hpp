// Particles that move by position Verlet and are then relaxed onto their constraints: the course's recipe for
// articulated bodies (slides 34-36 with 39-41), known from Jakobsen, Advanced Character Physics, GDC 2001.
//
//   p_next = p + (1 - drag dt)(p - p_previous) + a dt^2,    then relax p_next
//
// No velocity is stored, so a particle that a constraint moved has thereby changed its velocity, and the multiplier of
// each constraint divided by dt^2 is the force that it exerts: forces travel through the constraints (slide 35).
//
// Which way a constraint pulls matters. With converged relaxation, for a pendulum of frequency w:
//
//   Pull::kMinimal  along the gradient where the step ends (slide 34). The force of the constraint is taken at the end
//   of
//                   the step like that of implicit Euler: small oscillations have z = 1/(1 - i w dt), that is frequency
//                   atan(w dt)/dt, second order, but amplitude |z| = 1/sqrt(1 + w^2 dt^2) a step: they die out like
//                   exp(-w^2 dt t/2), first order in dt. A rod that turns freely by the angle phi a step turns by
//                   atan(sin(phi)/(2 - cos(phi))) in the next: angular momentum is lost in first order too. In a chain
//                   each link is put right where the others are not yet, so orders stay and formulas do not.
//   Pull::kStart    along the gradient where the step starts: SHAKE (Ryckaert, Ciccotti, Berendsen, J. Comput. Phys. 23
//                   (1977) 327). Second order in all: frequency 2 asin(w dt/2)/dt, no damping; without outer forces the
//                   angular momentum sum m p_n x p_n+1/dt is kept to rounding, converged or not. Explicit: its tension
//                   must not turn a link by much in one step.
//
// Linear momentum sum m (p_n+1 - p_n)/dt is kept to rounding by both, since no constraint between particles moves the
// centre of mass. With few sweeps links stretch under load (no guarantees, slide 36): a chain acts like an elastic one.
#pragma once

#include "plumbline/core/constraints/assembly.hpp"
#include "plumbline/core/constraints/relaxation.hpp"

namespace plumbline {

enum class Pull { kMinimal, kStart };

struct VerletOptions {
  Vec3 gravity_W = Vec3(0, 0, -9.81);  // [m/s^2]
  double drag = 0;                     // [1/s], 0 <= drag dt <= 1
  Pull pull = Pull::kMinimal;
  RelaxationOptions relaxation;
};

class VerletRelaxation {
 public:
  // The previous positions are p - v dt + g dt^2/2, so that the first step makes p + v dt + g dt^2/2, which is of full
  // order (slide 41 leaves the start open). The constraints' share of the acceleration comes in by the relaxation of
  // that step; the multipliers of this one step are half of what they are later. Throws std::invalid_argument for dt <=
  // 0, for drag dt outside [0, 1], and for what relax() refuses.
  VerletRelaxation(Assembly assembly, double dt, const VerletOptions& options = {});

  // One step. Its report says how well the constraints hold and how hard they pull.
  RelaxationReport step();
  // The same with a force on each particle [N], held over the step. Throws std::invalid_argument when their number
  // differs.
  RelaxationReport step(std::span<const Vec3> forces_W);

  double time() const { return dt_ * static_cast<double>(steps_); }  // [s]
  std::span<const Vec3> positions() const { return assembly_.p_W; }
  std::span<const Vec3> previous_positions() const { return previous_W_; }
  const Assembly& assembly() const { return assembly_; }

 private:
  Assembly assembly_;
  std::vector<Vec3> previous_W_;
  double dt_;
  VerletOptions options_;
  long steps_ = 0;
};

}  // namespace plumbline
