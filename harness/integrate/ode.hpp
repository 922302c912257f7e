// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "harness/integrate/coloured_jacobian.hpp"

namespace sphverify {

/// A rate met a state in which it makes no sense. An adaptive integrator may have come there by too long a
/// step: an implicit one tries a shorter one first, of the explicit one a tighter tolerance has to be asked.
class RateFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// dy/dt = rate(t, y), with quadratures dq/dt = quadrature(t, y) that nothing depends on.
struct OdeSystem {
  std::size_t size = 0;
  std::size_t quadratures = 0;  ///< 0: not integrated, and not paid for
  std::function<void(double t, double const* y, double* dydt)> rate;
  std::function<void(double t, double const* y, double* dqdt)> quadrature;

  int threads = 1;  ///< for the vectors of runge-kutta; results are the same bits at any

  /// An explicit adaptive method gives up where a thousand steps are below it on average; 0: it goes on.
  double smallest_step = 0.0;

  /// Sizes of typical unknowns and then quadratures, which multiply the absolute tolerance; empty: all 1.
  std::vector<double> scales;
  ColouredJacobian* jacobian = nullptr;  ///< for the implicit method; null: it does without

  /// Called after every step with the quadratures so far; a non-empty answer ends the run, with that reason.
  std::function<std::string(double t, double const* y, double const* q)> monitor;

  /// Times from 0 to the final one, ascending, at which `sample` is called with what the state was then,
  /// wherever the steps end: by dense output (bdf, runge-kutta), or by steps that are made to end there
  /// (runge-kutta-chebyshev, implicit-runge-kutta). Not of leapfrog. Empty: none.
  std::vector<double> sample_times{};
  std::function<void(double t, double const* y, double const* q)> sample{};
};

struct Tolerances {
  double relative;
  double absolute;
};

enum class OdeOutcome {
  finished,
  stopped,      ///< by the monitor
  failed,       ///< the integrator gave up
  not_finite,   ///< an unknown or its rate is no number; no step however short goes on from there
  out_of_steps  ///< of Stepping::most_steps
};

struct OdeResult {
  OdeOutcome outcome = OdeOutcome::finished;
  std::string reason;              ///< of a stop (from the monitor) or a failure (from the integrator)
  std::size_t not_finite = 0;      ///< index of that unknown
  bool rate_is_not_finite = true;  ///< else the unknown itself is not
  double time = 0.0;               ///< that was reached
  std::vector<double> y;
  std::vector<double> quadratures;
  std::uint64_t steps = 0;
  std::size_t bytes = 0;  ///< of the vectors that the integrator kept (runge-kutta, leapfrog; of the others 0)
};

/// Implicit backward differentiation formulas of variable order and step (SUNDIALS CVODES) with a sparse
/// direct solver (KLU) or, without a Jacobian, GMRES. Linear invariants of the rate are kept to the solver's
/// tolerance.
OdeResult integrate_bdf(OdeSystem const& system, std::vector<double> y, double final_time,
                        Tolerances tolerances);

/// Explicit adaptive Runge-Kutta of order 5 (Dormand & Prince 1980; of our own, since a library's keeps every stage: docs/decisions/0022).
/// Keeps six copies of the unknowns, eight if there are samples. A rate that is no number ends the run at once. Asks for a quadrature only right after the rate at the same state.
OdeResult integrate_runge_kutta(OdeSystem const& system, std::vector<double> y, double final_time,
                                Tolerances tolerances);

/// Explicit Runge-Kutta-Chebyshev of order 2 (Sommeijer, Shampine & Verwer, J. Comput. Appl. Math. 88 (1998)
/// 315), for stiff rates whose eigenvalues lie near the negative real axis: s stages reach 0.65 s^2 over the
/// spectral radius, which is measured on the way. Adaptive in step and stages.
OdeResult integrate_chebyshev(OdeSystem const& system, std::vector<double> y, double final_time,
                              Tolerances tolerances);

/// Implicit Runge-Kutta of order 3, L-stable, in steps of one size (Kennedy & Carpenter 2003, ARK3(2)4L[2]SA;
/// SUNDIALS ARKODE), with the linear solvers of the formulas above.
/// @param newton what Newton's iterations are held to; what is linear closes to it
OdeResult integrate_implicit_runge_kutta(OdeSystem const& system, std::vector<double> y, double final_time,
                                         std::uint64_t steps, Tolerances newton);

/// How a leapfrog steps.
struct Stepping {
  std::size_t coordinates;  ///< y[0, coordinates) are places, which move with y[coordinates, 2 coordinates)
  std::size_t impulses;     ///< the first so many quadratures are fed by forces, the others by what moves

  /// The system's rate at a state: all but those of places, dydt[0, coordinates), which are given. With these velocities
  /// all moves, forces aside.
  std::function<void(double t, double const* y, double* dydt)> rate;

  /// What follows the places once more, where the last `rate` was asked for, with other velocities: the rates of
  /// y[2 coordinates, size) alone. What `rate` had predicted of these is known better by now, and given in y.
  std::function<void(double t, double const* y, double const* velocities, double* rates)> drift;

  std::function<double(double t)> largest_step;  ///< asked right after a rate
  double smallest_step;                          ///< below it the step has collapsed
  std::uint64_t most_steps;
  int threads = 1;
};

/// Leapfrog in its kick-drift-kick form, of second order. All that follows the places, such as densities and
/// energies, drifts with the velocities of the middle of the step, by the mean of its rates at either end, so
/// that sound is a leapfrog too, neither damped nor growing while a step resolves it; with predicted
/// velocities instead short waves grow. One evaluation a step, and of what follows the places a second one at its
/// beginning, where they are already. Forces that depend on
/// velocity take that which the old acceleration predicts. Momentum closes to round-off against the impulses,
/// and whatever is linear in the rest against the other quadratures. Asks for a quadrature only right after
/// the rate, or the drift, at the same state. Keeps two copies of the unknowns.
OdeResult integrate_leapfrog(OdeSystem const& system, std::vector<double> y, double final_time,
                             Stepping const& stepping);

}  // namespace sphverify
