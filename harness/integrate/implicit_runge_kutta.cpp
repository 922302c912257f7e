// SPDX-License-Identifier: GPL-3.0-or-later
#include <arkode/arkode_arkstep.h>
#include <sunlinsol/sunlinsol_klu.h>
#include <sunlinsol/sunlinsol_spgmr.h>
#include <sunmatrix/sunmatrix_sparse.h>

#include <algorithm>
#include <cmath>

#include "harness/integrate/ode.hpp"
#include "harness/integrate/samples.hpp"
#include "harness/integrate/sundials_handles.hpp"

namespace sphverify {

namespace {

// Steps of one size cannot shrink where Newton's method with a matrix from the start of the step closes
// slowly, as at a wall whose heat loss is suddenly there.
constexpr int most_iterations = 20;

struct DestroyArk {
  void operator()(void* memory) const { ARKStepFree(&memory); }
};

// Quadratures follow the unknowns in one vector. They are the explicit part: nothing depends on them, and
// both parts weigh their stages alike, so that what is linear closes to round-off.

int implicit_rate(realtype t, N_Vector y, N_Vector dydt, void* user) {
  int const status = CallbackData::guarded(user, [&](OdeSystem const& system) {
    double* const out = N_VGetArrayPointer(dydt);
    system.rate(t, N_VGetArrayPointer(y), out);
    std::fill_n(out + system.size, system.quadratures, 0.0);
  });
  return CallbackData::require_finite(user, status, dydt);
}

int quadrature(realtype t, N_Vector y, N_Vector dydt, void* user) {
  return CallbackData::guarded(user, [&](OdeSystem const& system) {
    double* const out = N_VGetArrayPointer(dydt);
    std::fill_n(out, system.size, 0.0);
    system.quadrature(t, N_VGetArrayPointer(y), out + system.size);
  });
}

int jacobian(realtype t, N_Vector y, N_Vector, SUNMatrix matrix, void* user, N_Vector, N_Vector, N_Vector) {
  return CallbackData::guarded(user, [&](OdeSystem const& system) {
    DependencyPattern const& pattern = system.jacobian->pattern();
    std::vector<double> const& values = system.jacobian->evaluate(t, N_VGetArrayPointer(y));
    SUNMatZero(matrix);
    auto* const first = SUNSparseMatrix_IndexPointers(matrix);
    std::copy(pattern.first.begin(), pattern.first.end(), first);
    std::fill_n(first + pattern.first.size(), system.quadratures, pattern.first.back());
    std::copy(pattern.column.begin(), pattern.column.end(), SUNSparseMatrix_IndexValues(matrix));
    std::copy(values.begin(), values.end(), SUNSparseMatrix_Data(matrix));
  });
}

}  // namespace

OdeResult integrate_implicit_runge_kutta(OdeSystem const& system, std::vector<double> y, double final_time,
                                         std::uint64_t steps, Tolerances newton) {
  SundialsContext const context;
  CallbackData data{system};
  OdeResult result;
  y.resize(system.size + system.quadratures, 0.0);
  VectorHandle const state = wrap(y.size(), y.data(), context);
  std::unique_ptr<void, DestroyArk> const solver(
      ARKStepCreate(system.quadratures > 0 ? quadrature : nullptr, implicit_rate, 0.0, state.get(), context));
  if (!solver) throw std::bad_alloc();
  void* const ark = solver.get();
  require_sundials(ARKStepSetUserData(ark, &data), "ARKStepSetUserData");
  require_sundials(ARKStepSetTableNum(ark, ARKODE_ARK324L2SA_DIRK_4_2_3,
                                      system.quadratures > 0 ? ARKODE_ARK324L2SA_ERK_4_2_3 : ARKODE_ERK_NONE),
                   "ARKStepSetTableNum");
  require_sundials(ARKStepSetFixedStep(ark, final_time / static_cast<double>(steps)), "ARKStepSetFixedStep");
  require_sundials(ARKStepSetMaxNumSteps(ark, -1), "ARKStepSetMaxNumSteps");
  require_sundials(ARKStepSetMaxNonlinIters(ark, most_iterations), "ARKStepSetMaxNonlinIters");
  require_sundials(ARKStepSStolerances(ark, newton.relative, newton.absolute), "ARKStepSStolerances");
  require_sundials(ARKStepSetErrHandlerFn(
                       ark, [](int, char const*, char const*, char*, void*) {}, nullptr),
                   "ARKStepSetErrHandlerFn");
  MatrixHandle matrix;
  SolverHandle linear;
  if (system.jacobian) {
    auto const n = static_cast<sunindextype>(y.size());
    auto const nonzeros = static_cast<sunindextype>(system.jacobian->pattern().column.size());
    matrix.reset(SUNSparseMatrix(n, n, nonzeros, CSR_MAT, context));
    if (!matrix) throw std::bad_alloc();
    linear.reset(SUNLinSol_KLU(state.get(), matrix.get(), context));
  } else {
    linear.reset(SUNLinSol_SPGMR(state.get(), SUN_PREC_NONE, 30, context));
    if (linear) SUNLinSol_SPGMRSetMaxRestarts(linear.get(), 10);
  }
  if (!linear) throw std::bad_alloc();
  require_sundials(ARKStepSetLinearSolver(ark, linear.get(), matrix.get()), "ARKStepSetLinearSolver");
  if (system.jacobian) require_sundials(ARKStepSetJacFn(ark, jacobian), "ARKStepSetJacFn");

  Samples samples(system);
  samples.pass(0.0, y.data(), y.data() + system.size);
  while (result.time < final_time) {
    double const before = result.time;
    double const stop = std::min(samples.next(), final_time);
    require_sundials(ARKStepSetStopTime(ark, stop), "ARKStepSetStopTime");
    int const flag = ARKStepEvolve(ark, final_time, state.get(), &result.time, ARK_ONE_STEP);
    data.rethrow();
    if (flag < 0 || result.time == before) {
      std::unique_ptr<char, decltype(&std::free)> const name(ARKStepGetReturnFlagName(flag), &std::free);
      give_up(data.not_finite, std::string("the implicit integrator gave up (") + name.get() + ")", result);
      break;
    }
    ++result.steps;
    if (flag == ARK_TSTOP_RETURN) result.time = stop;
    samples.pass(result.time, y.data(), y.data() + system.size);
    result.reason = system.monitor ? system.monitor(result.time, y.data(), y.data() + system.size) : "";
    if (!result.reason.empty()) {
      result.outcome = OdeOutcome::stopped;
      break;
    }
  }
  result.quadratures.assign(y.begin() + static_cast<std::ptrdiff_t>(system.size), y.end());
  y.resize(system.size);
  result.y = std::move(y);
  return result;
}

}  // namespace sphverify
