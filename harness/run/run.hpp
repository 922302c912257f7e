// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>

#include "cases/support/case.hpp"
#include "formulations/basics/flag_set.hpp"
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

struct ExternalCode;

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
  std::shared_ptr<ExternalCode const> code{};  ///< that runs it; null: ours do
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

/// A run with everything measured but its repeats.
struct MeasuredRun {
  RunRecord record;
  bool awaits_timing = false;  ///< its cost is that of its repeats, which follow
  double spent_seconds = 0.0;  ///< of its time budget, before the repeats
};

/// What is known of a run before it is carried out.
RunRecord begun_record(RunSpec const& spec);

/// Carries out a run but for its repeats. Whatever goes wrong with the numbers is a status and a reason in
/// the record. Throws Interrupted.
MeasuredRun measure_run(RunSpec const& spec, RunOptions const& options);

/// One repeat of a measured run, set-up and all; empty if it broke.
/// @param spent_seconds of the time budget, before it
using Repetition = std::function<std::optional<Cost>(double spent_seconds)>;

/// The repeats of a run that awaits its timing; spec and options must outlive them. They throw Interrupted.
Repeats repeats_of(RunSpec const& spec, RunOptions const& options, MeasuredRun const& measured);

/// Puts what the repeats cost into the record of a run that awaited it. Where not even the first came to an
/// end, the measured run itself may have been timed.
void put_cost(MeasuredRun& measured, std::optional<Cost> const& cost);

/// Carries out a run and repeats it by itself. Whatever goes wrong with the numbers is a status and a reason
/// in the record. Throws Interrupted.
RunRecord execute(RunSpec const& spec, RunOptions const& options);

}  // namespace sphverify
