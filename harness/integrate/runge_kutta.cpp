#include <arkode/arkode_erkstep.h>

#include <cmath>

#include "harness/integrate/ode.hpp"
#include "harness/integrate/samples.hpp"
#include "harness/integrate/sundials_handles.hpp"

namespace sphverify {

namespace {

struct DestroyErk {
  void operator()(void* memory) const { ERKStepFree(&memory); }
};

/// Steps that are on average too short, over so many of them, will not end the run. A few may well be short:
/// a rate that jumps (a particle comes into a wall's reach) is passed by steps whose error does not count.
constexpr std::uint64_t steps_to_judge = 1000;

/// Quadratures follow the unknowns in one vector; nothing depends on them.
int explicit_rate(realtype t, N_Vector y, N_Vector dydt, void* user) {
  int const status = CallbackData::guarded(user, [&](OdeSystem const& system) {
    double const* const values = N_VGetArrayPointer(y);
    double* const out = N_VGetArrayPointer(dydt);
    system.rate(t, values, out);
    if (system.quadratures > 0) system.quadrature(t, values, out + system.size);
  });
  return CallbackData::require_finite(user, status, dydt);
}

/// What its callbacks get.
struct ExplicitData : CallbackData {
  Tolerances tolerances;
};

/// What errors are multiplied with, found where it is asked for: a vector of absolute tolerances, and the solver's copy of it,
/// would be two more of many.
int error_weights(N_Vector y, N_Vector weights, void* user) {
  auto const& data = *static_cast<ExplicitData const*>(static_cast<CallbackData const*>(user));
  std::vector<double> const& scales = data.system.scales;
  double const* const values = N_VGetArrayPointer(y);
  double* const out = N_VGetArrayPointer(weights);
  auto const size = static_cast<std::size_t>(N_VGetLength(y));
  for (std::size_t k = 0; k < size; ++k) {
    double const scale = k < scales.size() ? scales[k] : 1.0;
    out[k] = 1.0 / (data.tolerances.relative * std::abs(values[k]) + data.tolerances.absolute * scale);
  }
  return 0;
}

}  // namespace

OdeResult integrate_runge_kutta(OdeSystem const& system, std::vector<double> y, double final_time,
                                Tolerances tolerances) {
  SundialsContext const context;
  ExplicitData data{{system}, tolerances};
  OdeResult result;
  y.resize(system.size + system.quadratures, 0.0);
  VectorHandle const state = wrap(y.size(), y.data(), context);

  std::unique_ptr<void, DestroyErk> const solver(ERKStepCreate(explicit_rate, 0.0, state.get(), context));
  if (!solver) throw std::bad_alloc();
  void* const erk = solver.get();
  require_sundials(ERKStepSetUserData(erk, static_cast<CallbackData*>(&data)), "ERKStepSetUserData");
  require_sundials(ERKStepSetTableNum(erk, ARKODE_DORMAND_PRINCE_7_4_5), "ERKStepSetTableNum");
  require_sundials(ERKStepWFtolerances(erk, error_weights), "ERKStepWFtolerances");
  // The best interpolation keeps two more vectors. It serves samples alone; at the end of a step any is exact.
  if (system.sample_times.empty())
    require_sundials(ERKStepSetInterpolantDegree(erk, 3), "ERKStepSetInterpolantDegree");
  require_sundials(ERKStepSetStopTime(erk, final_time), "ERKStepSetStopTime");
  require_sundials(ERKStepSetErrHandlerFn(
                       erk, [](int, char const*, char const*, char*, void*) {}, nullptr),
                   "ERKStepSetErrHandlerFn");

  Samples samples(system);
  samples.pass(0.0, y.data(), y.data() + system.size);
  auto const state_at = [&](double t, double* values) {
    VectorHandle const then = wrap(y.size(), values, context);
    require_sundials(ERKStepGetDky(erk, t, 0, then.get()), "ERKStepGetDky");
    data.rethrow();
  };
  double judged = 0.0;  // the time up to which steps have been judged
  while (result.time < final_time) {
    double const before = result.time;
    data.begin_step();
    int const flag = ERKStepEvolve(erk, final_time, state.get(), &result.time, ARK_ONE_STEP);
    data.rethrow();
    if (flag < 0) {
      data.rethrow_failure();
      std::unique_ptr<char, decltype(&std::free)> const name(ERKStepGetReturnFlagName(flag), &std::free);
      result.time = before;  // it was a stage's
      give_up(data.not_finite, std::string("the explicit integrator gave up (") + name.get() + ")", result);
      break;
    }
    if (result.time == before) {
      // Up to where a rate is no number.
      give_up(data.not_finite_in_step, "the explicit integrator's step shrank to nothing", result);
      break;
    }
    ++result.steps;
    if (result.steps % steps_to_judge == 0) {
      if (result.time - judged < steps_to_judge * system.smallest_step) {
        result.outcome = OdeOutcome::failed;
        result.reason = "the explicit integrator's step collapsed";
        break;
      }
      judged = result.time;
    }
    samples.pass(result.time, y.data(), y.data() + system.size, state_at);
    result.reason = system.monitor ? system.monitor(result.time, y.data(), y.data() + system.size) : "";
    if (!result.reason.empty()) {
      result.outcome = OdeOutcome::stopped;
      break;
    }
  }
  long int numbers = 0, integers = 0;
  require_sundials(ERKStepGetWorkSpace(erk, &numbers, &integers), "ERKStepGetWorkSpace");
  result.bytes = sizeof(double) * (static_cast<std::size_t>(numbers) + y.size() + system.scales.size());
  result.quadratures.assign(y.begin() + static_cast<std::ptrdiff_t>(system.size), y.end());
  y.resize(system.size);
  result.y = std::move(y);
  return result;
}

}  // namespace sphverify
