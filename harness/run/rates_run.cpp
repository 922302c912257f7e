#include "harness/run/rates_run.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "harness/measure/norms.hpp"
#include "harness/run/clock.hpp"
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
        term = std::max(term, largest(Field::pressure) * speed / spacing);
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

/// Index of the first particle whose rate is not finite; their number if there is none.
template <int Dim>
std::size_t first_not_finite(Particles<Dim> const& particles, Field field) {
  std::size_t i = 0;
  for (; i < particles.size(); ++i) {
    bool const finite = info(field).is_vector ? particles.vector(field)[i].allFinite()
                                              : std::isfinite(particles.scalar(field)[i]);
    if (!finite) break;
  }
  return i;
}

}  // namespace

template <int Dim>
void run_rates(Problem<Dim> const& problem, SceneChoice const& choice, RunOptions const& options,
               RunRecord& record) {
  Scene<Dim> scene(problem, choice);
  Particles<Dim> const& particles = scene.particles();
  Rate const rate = scene.scheme().rate;
  scene.evaluate(0.0);
  record.scene = scene.record();
  if (choice.discretisation.face_weight == "balanced")
    record.smallest_face_weight = smallest_face_weight(scene.geometry());
  if (std::size_t const i = first_not_finite(particles, output_field(rate)); i < particles.size()) {
    record.status = "non-finite";
    record.reason = fmt::format("{} of particle {} is not finite", info(output_field(rate)).name, i);
    return;
  }

  if (options.measure.contains(Measure::error)) {
    auto const volumes = exact_volumes(problem, particles, 0.0);
    auto const places = regions(particles, problem.walls);
    double const round_off = rate_round_off(rate, particles, scene.spacing());
    if (rate == Rate::acceleration) {
      VectorField<Dim> const exact = sample(problem.acceleration, particles, 0.0);
      record.errors["acceleration"] = field_errors(components(particles.vector(Field::acceleration)),
                                                   components(exact), volumes, places, round_off);
    } else {
      auto const exact = sample(problem.heating.at(rate), particles, 0.0);
      record.errors["heating"] =
          field_errors({particles.scalar(Field::heating)}, {exact}, volumes, places, round_off);
    }
    if (scene.scheme().two_pass) {
      VectorField<Dim> const exact = sample(problem.vectors.at(Field::flux), particles, 0.0);
      record.errors["flux"] =
          field_errors(components(particles.vector(Field::flux)), components(exact), volumes, places, 0.0);
    }
  }
  if (!options.measure.contains(Measure::cost)) return;

  Cost best;
  best.seconds = std::numeric_limits<double>::infinity();
  best.repeats = std::max(1, options.repeat);
  for (int r = 0; r < best.repeats; ++r) {
    Clock const clock;
    Scene<Dim> timed(problem, choice);
    double const setup = clock.seconds();
    timed.evaluate(0.0);
    double const seconds = clock.seconds();
    double const cpu_seconds = clock.cpu_seconds();
    if (seconds >= best.seconds) continue;
    best.seconds = seconds;
    best.setup_seconds = setup;
    best.cpu_seconds = options.threads == 1 ? Number(cpu_seconds) : std::nullopt;
    best.rate_evaluations = timed.work().evaluations;
    best.pair_interactions = timed.work().pair_interactions;
    best.peak_bytes = timed.bytes();
  }
  record.cost = best;
}

template void run_rates(Problem<1> const&, SceneChoice const&, RunOptions const&, RunRecord&);
template void run_rates(Problem<2> const&, SceneChoice const&, RunOptions const&, RunRecord&);
template void run_rates(Problem<3> const&, SceneChoice const&, RunOptions const&, RunRecord&);

}  // namespace sphverify
