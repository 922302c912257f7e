#pragma once

#include <atomic>
#include <stdexcept>

#include "cases/support/case.hpp"
#include "formulations/support/flag_set.hpp"
#include "harness/measure/timing.hpp"
#include "reports/results.hpp"

namespace sphverify {

/// What a study may ask to be measured.
enum class Measure {
  error,
  conservation,
  cost,
  stability,
  stable_step,
  second_law,
  profile,
  history,
  spectrum,
  energy_routes
};
using MeasureSet = FlagSet<Measure>;

/// One run: a case, a formulation, a discretisation and a resolution.
struct RunSpec {
  Case const* scene_case;
  Parameters parameters;
  FormulationChoice formulation;
  std::string label;
  Discretisation discretisation;
  double smoothing_exponent;
  int resolution;
  double smoothing_ratio;  ///< h/dx at this resolution
};

struct RunOptions {
  MeasureSet measure;
  int threads = 1;
  RepeatRule repeat;         ///< of what is timed
  double time_budget = 0.0;  ///< seconds for everything that a run does; 0: none
  std::atomic<bool> const* interrupted = nullptr;
};

/// The user asked to stop while a run was in flight.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

/// Carries out a run. Whatever goes wrong with the numbers is a status and a reason in the record.
/// Throws Interrupted.
RunRecord execute(RunSpec const& spec, RunOptions const& options);

}  // namespace sphverify
