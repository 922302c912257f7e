// SPDX-License-Identifier: GPL-3.0-or-later
#include <cvodes/cvodes.h>
#include <sunlinsol/sunlinsol_klu.h>
#include <sunlinsol/sunlinsol_spgmr.h>
#include <sunmatrix/sunmatrix_sparse.h>

#include <algorithm>

#include "harness/integrate/ode.hpp"
#include "harness/integrate/samples.hpp"
#include "harness/integrate/sundials_handles.hpp"

namespace sphverify {

namespace {

struct DestroyCvode {
  void operator()(void* memory) const { CVodeFree(&memory); }
};

int cvode_rate(realtype t, N_Vector y, N_Vector dydt, void* user) {
  int const status = CallbackData::guarded(user, [&](OdeSystem const& system) {
    system.rate(t, N_VGetArrayPointer(y), N_VGetArrayPointer(dydt));
  });
  return CallbackData::require_finite(user, status, dydt);
}

int cvode_quadrature(realtype t, N_Vector y, N_Vector dqdt, void* user) {
  return CallbackData::guarded(user, [&](OdeSystem const& system) {
    system.quadrature(t, N_VGetArrayPointer(y), N_VGetArrayPointer(dqdt));
  });
}

int cvode_jacobian(realtype t, N_Vector y, N_Vector, SUNMatrix matrix, void* user, N_Vector, N_Vector, N_Vector) {
  return CallbackData::guarded(user, [&](OdeSystem const& system) {
    DependencyPattern const& pattern = system.jacobian->pattern();
    std::vector<double> const& values = system.jacobian->evaluate(t, N_VGetArrayPointer(y));
    SUNMatZero(matrix);
    std::copy(pattern.first.begin(), pattern.first.end(), SUNSparseMatrix_IndexPointers(matrix));
    std::copy(pattern.column.begin(), pattern.column.end(), SUNSparseMatrix_IndexValues(matrix));
    std::copy(values.begin(), values.end(), SUNSparseMatrix_Data(matrix));
  });
}

/// What solves the linear equations of a step.
struct LinearSolver {
  MatrixHandle matrix;
  SolverHandle solver;
};

/// By a sparse factorisation where the system gives its Jacobian; else by GMRES, which asks for no more than
/// rates.
LinearSolver attach_linear_solver(void* cvode, OdeSystem const& system, N_Vector state, SUNContext context) {
  LinearSolver linear;
  if (system.jacobian) {
    auto const n = static_cast<sunindextype>(system.size);
    auto const nonzeros = static_cast<sunindextype>(system.jacobian->pattern().column.size());
    linear.matrix.reset(SUNSparseMatrix(n, n, nonzeros, CSR_MAT, context));
    if (!linear.matrix) throw std::bad_alloc();
    linear.solver.reset(SUNLinSol_KLU(state, linear.matrix.get(), context));
  } else {
    constexpr int directions = 30;  // before GMRES starts anew
    constexpr int restarts = 10;
    linear.solver.reset(SUNLinSol_SPGMR(state, SUN_PREC_NONE, directions, context));
    if (linear.solver) SUNLinSol_SPGMRSetMaxRestarts(linear.solver.get(), restarts);
  }
  if (!linear.solver) throw std::bad_alloc();
  require_sundials(CVodeSetLinearSolver(cvode, linear.solver.get(), linear.matrix.get()),
                   "CVodeSetLinearSolver");
  if (system.jacobian) require_sundials(CVodeSetJacFn(cvode, cvode_jacobian), "CVodeSetJacFn");
  return linear;
}

}  // namespace

OdeResult integrate_bdf(OdeSystem const& system, std::vector<double> y, double final_time,
                        Tolerances tolerances) {
  SundialsContext const context;
  CallbackData data{system};
  OdeResult result;
  result.quadratures.assign(system.quadratures, 0.0);
  VectorHandle const state = wrap(system.size, y.data(), context);
  VectorHandle const integrals = wrap(system.quadratures, result.quadratures.data(), context);

  std::unique_ptr<void, DestroyCvode> const solver(CVodeCreate(CV_BDF, context));
  if (!solver) throw std::bad_alloc();
  void* const cvode = solver.get();
  require_sundials(CVodeInit(cvode, cvode_rate, 0.0, state.get()), "CVodeInit");
  require_sundials(CVodeSetUserData(cvode, &data), "CVodeSetUserData");
  require_sundials(CVodeSStolerances(cvode, tolerances.relative, tolerances.absolute), "CVodeSStolerances");
  require_sundials(CVodeSetStopTime(cvode, final_time), "CVodeSetStopTime");
  require_sundials(CVodeSetErrHandlerFn(
                       cvode, [](int, char const*, char const*, char*, void*) {}, nullptr),
                   "CVodeSetErrHandlerFn");
  // The invariants that the conservation measure checks hold as well as the Newton iteration converges.
  require_sundials(CVodeSetNonlinConvCoef(cvode, 0.01), "CVodeSetNonlinConvCoef");

  LinearSolver const linear = attach_linear_solver(cvode, system, state.get(), context);
  if (system.quadratures > 0)
    require_sundials(CVodeQuadInit(cvode, cvode_quadrature, integrals.get()), "CVodeQuadInit");

  Samples samples(system);
  samples.pass(0.0, y.data(), result.quadratures.data());
  auto const state_at = [&](double t, double* values) {
    VectorHandle const then = wrap(system.size, values, context);
    require_sundials(CVodeGetDky(cvode, t, 0, then.get()), "CVodeGetDky");
    if (system.quadratures == 0) return;
    VectorHandle const integrals_then = wrap(system.quadratures, values + system.size, context);
    require_sundials(CVodeGetQuadDky(cvode, t, 0, integrals_then.get()), "CVodeGetQuadDky");
  };
  while (result.time < final_time) {
    double const before = result.time;
    data.begin_step();
    int const flag = CVode(cvode, final_time, state.get(), &result.time, CV_ONE_STEP);
    data.rethrow();
    if (flag < 0) {
      std::unique_ptr<char, decltype(&std::free)> const name(CVodeGetReturnFlagName(flag), &std::free);
      give_up(data.not_finite, std::string("the implicit integrator gave up (") + name.get() + ")", result);
      break;
    }
    if (result.time == before) {
      // Up to where a rate is no number.
      give_up(data.not_finite_in_step, "the implicit integrator's step shrank to nothing", result);
      break;
    }
    ++result.steps;
    if (system.quadratures > 0) {
      realtype at = result.time;
      require_sundials(CVodeGetQuad(cvode, &at, integrals.get()), "CVodeGetQuad");
    }
    samples.pass(result.time, y.data(), result.quadratures.data(), state_at);
    result.reason = system.monitor ? system.monitor(result.time, y.data(), result.quadratures.data()) : "";
    if (!result.reason.empty()) {
      result.outcome = OdeOutcome::stopped;
      break;
    }
  }
  result.y = std::move(y);
  return result;
}

}  // namespace sphverify
