#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "harness/integrate/coloured_jacobian.hpp"

namespace sphverify {

/// dy/dt = rate(t, y), with quadratures dq/dt = quadrature(t, y) that nothing depends on.
struct OdeSystem {
  std::size_t size = 0;
  std::size_t quadratures = 0;  ///< 0: not integrated, and not paid for
  std::function<void(double t, double const* y, double* dydt)> rate;
  std::function<void(double t, double const* y, double* dqdt)> quadrature;
  ColouredJacobian* jacobian = nullptr;  ///< for the implicit method

  /// Called after every step with the quadratures so far; a non-empty answer ends the run, with that reason.
  std::function<std::string(double t, double const* y, double const* q)> monitor;
};

struct Tolerances {
  double relative;
  double absolute;
};

enum class OdeOutcome { finished, stopped, failed };

struct OdeResult {
  OdeOutcome outcome = OdeOutcome::finished;
  std::string reason;  ///< of a stop (from the monitor) or a failure (from the integrator)
  double time = 0.0;   ///< that was reached
  std::vector<double> y;
  std::vector<double> quadratures;
  std::uint64_t steps = 0;
};

/// Implicit backward differentiation formulas of variable order and step (SUNDIALS CVODES) with a sparse
/// direct solver (KLU). Linear invariants of the rate are kept to the solver's tolerance.
OdeResult integrate_bdf(OdeSystem const& system, std::vector<double> y, double final_time,
                        Tolerances tolerances);

/// Explicit adaptive Runge-Kutta of order 5 (Dormand & Prince 1980; SUNDIALS ARKODE).
OdeResult integrate_runge_kutta(OdeSystem const& system, std::vector<double> y, double final_time,
                                Tolerances tolerances);

}  // namespace sphverify
