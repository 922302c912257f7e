// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/run/rates_run.hpp"

#include <cmath>
#include <limits>
#include <optional>

#include "harness/measure/norms.hpp"
#include "harness/run/clock.hpp"
#include "harness/run/compared.hpp"
#include "harness/run/exact_fields.hpp"
#include "harness/scene/wall_geometry.hpp"

namespace sphverify {

namespace {

/// Rounding error of a rate that is a difference of terms as large as the fields over powers of the spacing.
template <int Dim>
double rate_round_off(Rate rate, Particles<Dim> const& particles, double spacing) {
  auto const largest = [&](Field field) {
    return particles.has(field) ? largest_magnitude(particles.scalar(field)) : 0.0;
  };
  double term = 0.0;
  switch (rate) {
    case Rate::acceleration:
      term = largest(Field::pressure) / spacing;
      break;
    case Rate::internal_work:
    case Rate::total_work:
      for (int k = 0; k < Dim; ++k) {
        double const speed = largest_magnitude(particles.vector(Field::velocity).component(k));
        term = larger(term, largest(Field::pressure) * speed / spacing);
      }
      break;
    case Rate::density:  // no formulation of its own
      break;
    case Rate::conduction_heating:
      term = largest(Field::conductivity) * largest(Field::temperature) / (spacing * spacing);
      break;
  }
  return 64.0 * std::numeric_limits<double>::epsilon() * term;
}

/// One batch of set-ups and evaluations, divided by their number.
template <int Dim>
Cost time_batch(Problem<Dim> const& problem, SceneChoice const& choice, int batch) {
  Cost cost;
  cost.batch = batch;
  Clock const clock;
  for (int k = 0; k < batch; ++k) {
    double const start = clock.seconds();
    Scene<Dim> timed(problem, choice);
    cost.setup_seconds += (clock.seconds() - start) / batch;
    timed.evaluate(0.0);
    cost.rate_evaluations = timed.work().evaluations;
    cost.pair_interactions = timed.work().pair_interactions;
    cost.peak_bytes = timed.bytes();
  }
  cost.seconds = clock.seconds() / batch;
  if (choice.threads == 1) cost.cpu_seconds = clock.cpu_seconds() / batch;
  return cost;
}

}  // namespace

template <int Dim>
void run_rates(Problem<Dim> const& problem, SceneChoice const& choice, RunOptions const& options,
               MeasuredRun& run) {
  Clock const clock;
  RunRecord& record = run.record;
  Scene<Dim> scene(problem, choice);
  Particles<Dim> const& particles = scene.particles();
  Rate const rate = scene.scheme().rate;
  scene.evaluate(0.0);
  record.scene = scene.record();
  if (choice.discretisation.face_weight == "balanced")
    record.smallest_face_weight = smallest_face_weight(scene.geometry());

  auto const volumes = exact_volumes(problem, particles, 0.0);
  auto const places = regions(particles, problem.walls);
  double const round_off = rate_round_off(rate, particles, scene.spacing());
  std::vector<ComparedField> fields;
  VectorField<Dim> acceleration, flux;
  std::vector<double> heating;
  if (rate == Rate::acceleration) {
    acceleration = sample(problem.acceleration, particles, 0.0);
    fields.push_back(
        {"acceleration", components(particles.vector(Field::acceleration)), components(acceleration)});
  } else {
    heating = sample(problem.heating.at(rate), particles, 0.0);
    fields.push_back({"heating", {particles.scalar(Field::heating)}, {heating}});
  }
  if (scene.scheme().first_passes.writes().contains(Field::flux)) {
    flux = sample(problem.vectors.at(Field::flux), particles, 0.0);
    fields.push_back({"flux", components(particles.vector(Field::flux)), components(flux)});
  }
  require_finite(record, fields, volumes, places);
  if (options.measure.contains(Measure::error)) {
    for (ComparedField const& field : fields) {
      record.errors[std::string(field.name)] =
          field_errors(field.computed, field.exact, volumes, places, field.name == "flux" ? 0.0 : round_off);
    }
    if (rate != Rate::acceleration) {
      for (Region const& region : places) {
        record.errors["heating"].at(region.name).mean =
            mean_difference(particles.scalar(Field::heating), heating, volumes, region);
      }
    }
  }
  if (options.measure.contains(Measure::profile))
    record.profile = make_profile(particles, fields, volumes, places);
  run.awaits_timing = record.status == "ok" && options.measure.contains(Measure::cost);
  run.spent_seconds = clock.seconds();
}

template <int Dim>
Repetition repeat_rates(Problem<Dim> const& problem, SceneChoice const& choice) {
  return [&problem, choice, batch = 0](double) mutable -> std::optional<Cost> {
    if (batch > 0) return time_batch(problem, choice, batch);
    Cost first;
    batch = batch_for([&](int size) {
      first = time_batch(problem, choice, size);
      return first.seconds * size;
    });
    return first;
  };
}

template void run_rates(Problem<1> const&, SceneChoice const&, RunOptions const&, MeasuredRun&);
template Repetition repeat_rates(Problem<1> const&, SceneChoice const&);
template void run_rates(Problem<2> const&, SceneChoice const&, RunOptions const&, MeasuredRun&);
template Repetition repeat_rates(Problem<2> const&, SceneChoice const&);
template void run_rates(Problem<3> const&, SceneChoice const&, RunOptions const&, MeasuredRun&);
template Repetition repeat_rates(Problem<3> const&, SceneChoice const&);

}  // namespace sphverify
