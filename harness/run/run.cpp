// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/run/run.hpp"

#include <memory>
#include <stdexcept>

#include "harness/codes/code_run.hpp"
#include "harness/run/clock.hpp"
#include "harness/run/conduction_run.hpp"
#include "harness/run/moving_run.hpp"
#include "harness/run/rates_run.hpp"
#include "harness/run/remarks.hpp"
#include "harness/scene/place.hpp"
#include "harness/scene/wall_geometry.hpp"

namespace sphverify {

namespace {

SceneChoice choice_of(RunSpec const& spec, RunOptions const& options) {
  return {.formulation = spec.formulation.id,
          .work = spec.formulation.work,
          .conduction = spec.formulation.conduction,
          .walls = spec.formulation.walls,
          .discretisation = spec.discretisation,
          .resolution = spec.resolution,
          .smoothing_ratio = spec.smoothing_ratio,
          .threads = options.threads};
}

template <int Dim>
void measure_in_dimension(Problem<Dim> const& problem, RunSpec const& spec, RunOptions const& options,
                          MeasuredRun& run) {
  SceneChoice const choice = choice_of(spec, options);
  RunRecord& record = run.record;
  require_closed(problem);
  record.particles = static_cast<std::size_t>(
      particle_count(problem.domain, choice.discretisation.layout, choice.resolution));
  record.spacing = spacing_of(problem.domain, choice.discretisation.layout, choice.resolution);
  record.smoothing_length = spec.smoothing_ratio * record.spacing;
  remark_on_support(problem, record);
  switch (spec.scene_case->info.kind) {
    case CaseKind::rates:
      return run_rates(problem, choice, options, run);
    case CaseKind::conduction:
      return run_conduction(problem, choice, options, run);
    case CaseKind::hydro:
    case CaseKind::coupled:
      return run_moving(problem, choice, options, run);
  }
}

template <int Dim>
Repetition repetition_of(Problem<Dim> const& problem, RunSpec const& spec, RunOptions const& options,
                         RunRecord const& record) {
  SceneChoice const choice = choice_of(spec, options);
  switch (spec.scene_case->info.kind) {
    case CaseKind::rates:
      break;
    case CaseKind::conduction:
      return repeat_conduction(problem, choice, options, record);
    case CaseKind::hydro:
    case CaseKind::coupled:
      return repeat_moving(problem, choice, options, record);
  }
  return repeat_rates(problem, choice);
}

}  // namespace

RunRecord begun_record(RunSpec const& spec) {
  RunRecord record;
  record.case_id = spec.scene_case->info.id;
  record.parameters = spec.parameters.all();
  record.formulation = spec.formulation;
  record.label = spec.label;
  record.discretisation = spec.discretisation;
  record.smoothing_exponent = spec.smoothing_exponent;
  record.resolution = spec.resolution;
  return record;
}

MeasuredRun measure_run(RunSpec const& spec, RunOptions const& options) {
  MeasuredRun run;
  RunRecord& record = run.record = begun_record(spec);
  try {
    AnyProblem const problem = spec.scene_case->problem(spec.parameters);
    if (spec.code) {
      run_code(problem, spec, options, run);
      return run;
    }
    std::visit([&](auto const& in_dimension) { measure_in_dimension(in_dimension, spec, options, run); },
               problem);
  } catch (TooFewPartners const& error) {
    record.status = "invalid";
    record.reason = error.what();
    run.awaits_timing = false;
  } catch (UndefinedRate const& error) {
    record.status = "positivity-lost";
    record.reason = error.what();
    run.awaits_timing = false;
  } catch (std::invalid_argument const& error) {
    // The document was checked before; what is left are combinations that make no sense, such as a support
    // wider than a periodic axis.
    record.status = "invalid";
    record.reason = error.what();
    run.awaits_timing = false;
  }
  return run;
}

Repeats repeats_of(RunSpec const& spec, RunOptions const& options, MeasuredRun const& measured) {
  // Repeats refer to the problem: it lives as long as they do.
  auto const problem = std::make_shared<AnyProblem const>(spec.scene_case->problem(spec.parameters));
  Repetition const repetition =
      spec.code ? repeat_code(*problem, spec, options)
                : std::visit([&](auto const& in_dimension) { return repetition_of(in_dimension, spec, options, measured.record); },
                             *problem);
  auto const spent = std::make_shared<double>(measured.spent_seconds);
  auto const once = [problem, repetition, spent, &options]() -> std::optional<Cost> {
    if (options.interrupted && *options.interrupted) throw Interrupted();
    Clock const clock;
    std::optional<Cost> cost;
    try {
      cost = repetition(*spent);
    } catch (UndefinedRate const&) {
      // The measured run stands; only its timing is lost.
    }
    *spent += clock.seconds();
    return cost;
  };
  auto const out_of_time = [spent, budget = options.time_budget] {
    return budget > 0.0 && *spent > 0.5 * budget;
  };
  return {options.repeat, once, out_of_time};
}

void put_cost(MeasuredRun& measured, std::optional<Cost> const& cost) {
  measured.awaits_timing = false;
  if (cost) measured.record.cost = cost;
}

RunRecord execute(RunSpec const& spec, RunOptions const& options) {
  MeasuredRun run = measure_run(spec, options);
  if (!run.awaits_timing) return run.record;
  Repeats repeats = repeats_of(spec, options, run);
  while (!repeats.is_over() && !repeats.is_narrow()) repeats.repeat();
  put_cost(run, repeats.cost());
  return run.record;
}

}  // namespace sphverify
