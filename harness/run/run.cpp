#include "harness/run/run.hpp"

#include <stdexcept>

#include "harness/run/conduction_run.hpp"
#include "harness/run/moving_run.hpp"
#include "harness/run/rates_run.hpp"
#include "harness/scene/place.hpp"
#include "harness/scene/wall_geometry.hpp"

namespace sphverify {

namespace {

template <int Dim>
void execute_in_dimension(Problem<Dim> const& problem, RunSpec const& spec, RunOptions const& options,
                          RunRecord& record) {
  SceneChoice const choice{.formulation = spec.formulation.id,
                           .work = spec.formulation.work,
                           .conduction = spec.formulation.conduction,
                           .walls = spec.formulation.walls,
                           .discretisation = spec.discretisation,
                           .resolution = spec.resolution,
                           .smoothing_ratio = spec.smoothing_ratio,
                           .threads = options.threads};
  require_closed(problem);
  record.particles = static_cast<std::size_t>(
      particle_count(problem.domain, choice.discretisation.layout, choice.resolution));
  record.spacing = spacing_of(problem.domain, choice.discretisation.layout, choice.resolution);
  record.smoothing_length = spec.smoothing_ratio * record.spacing;
  switch (spec.scene_case->info.kind) {
    case CaseKind::rates:
      return run_rates(problem, choice, options, record);
    case CaseKind::conduction:
      return run_conduction(problem, choice, options, record);
    case CaseKind::hydro:
    case CaseKind::coupled:
      return run_moving(problem, choice, options, record);
  }
}

}  // namespace

RunRecord execute(RunSpec const& spec, RunOptions const& options) {
  RunRecord record;
  record.case_id = spec.scene_case->info.id;
  record.parameters = spec.parameters.all();
  record.formulation = spec.formulation;
  record.label = spec.label;
  record.discretisation = spec.discretisation;
  record.smoothing_exponent = spec.smoothing_exponent;
  record.resolution = spec.resolution;
  try {
    AnyProblem const problem = spec.scene_case->problem(spec.parameters);
    std::visit([&](auto const& in_dimension) { execute_in_dimension(in_dimension, spec, options, record); },
               problem);
  } catch (UndefinedRate const& error) {
    record.status = "positivity-lost";
    record.reason = error.what();
  } catch (std::invalid_argument const& error) {
    // The document was checked before; what is left are combinations that make no sense, such as a support
    // wider than a periodic axis.
    record.status = "invalid";
    record.reason = error.what();
  }
  return record;
}

}  // namespace sphverify
