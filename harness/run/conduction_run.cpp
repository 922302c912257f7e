// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/run/conduction_run.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "harness/measure/mode_shape.hpp"
#include "harness/measure/norms.hpp"
#include "harness/measure/spectrum.hpp"
#include "harness/measure/stable_step.hpp"
#include "harness/run/compared.hpp"
#include "harness/run/conduction_integration.hpp"
#include "harness/run/error_context.hpp"
#include "harness/run/exact_fields.hpp"
#include "harness/scene/wall_geometry.hpp"

namespace sphverify {

namespace {

/// Relative tolerances from loose to tight; absolute ones are the same part of the temperature scale.
constexpr std::array<double, 5> conduction_tolerances{1e-4, 1e-6, 1e-8, 1e-10, 1e-12};
constexpr double watch_tolerance = 1e-9;

template <int Dim>
class ConductionRun : ConductionIntegration<Dim> {
 public:
  ConductionRun(Problem<Dim> const& problem, SceneChoice const& choice, RunOptions const& options,
                MeasuredRun& run)
      : ConductionIntegration<Dim>(problem, options, run.record, temperature_scale(problem), 0.0),
        run_(run),
        conduction_(problem, choice, scale_),
        particles_(conduction_.scene().particles()),
        exact_(sample(problem.scalars.at(Field::temperature), particles_, problem.final_time)),
        volumes_(exact_volumes(problem, particles_, problem.final_time)),
        regions_(
            regions(particles_, problem.walls, {}, final_features(problem), smooth_margin(problem.domain))) {}

  void run() {
    std::optional<OdeResult> const accepted = choose_tolerance();
    describe_scene();
    if (accepted) measure(*accepted);
    if (record_.status == "ok") {
      if (options_.measure.contains(Measure::second_law)) {
        measure_second_law();
      }
      run_.awaits_timing = options_.measure.contains(Measure::cost);
    }
    run_.spent_seconds = spent();
    if (options_.measure.contains(Measure::stability) || options_.measure.contains(Measure::spectrum) ||
        options_.measure.contains(Measure::stable_step)) {
      measure_stability();
    }
  }

 private:
  using Base = ConductionIntegration<Dim>;
  using Base::history_;
  using Base::integrate;
  using Base::options_;
  using Base::problem_;
  using Base::record_;
  using Base::scale_;
  using Base::spent;
  using Base::watch_;

  double round_off() const { return 64.0 * std::numeric_limits<double>::epsilon() * scale_; }

  FieldErrors errors_of(std::vector<double> const& temperature, std::vector<double> const& reference) const {
    return field_errors({temperature}, {reference}, volumes_, regions_, round_off());
  }

  std::optional<OdeResult> choose_tolerance() {
    bool const with_quadratures =
        options_.measure.contains(Measure::conservation) || options_.measure.contains(Measure::history);
    Integration& integration = record_.integration.emplace();
    integration.method = record_.discretisation.integrator;
    integration.remark = no_time_error_because_it_broke;
    auto const set_tolerance = [&](double tolerance) {
      integration.relative_tolerance = tolerance;
      integration.absolute_tolerance = tolerance * scale_;
    };
    std::optional<OdeResult> looser;
    History history;
    double accepted = 0.0;
    for (double const tolerance : conduction_tolerances) {
      set_tolerance(tolerance);  // the one that a run which breaks was at
      std::optional<OdeResult> tighter = integrate(conduction_, tolerance, with_quadratures);
      if (!tighter) {
        // Only the check ran out of time: what it was to check stands, as well as is known.
        if (looser && record_.reason.starts_with("time budget") && integration.time_error_share) {
          integration.remark = next_tolerance_out_of_time;
          record_.status = "ok";
          record_.reason.clear();
          set_tolerance(accepted);
          history_ = std::move(history);
          return looser;
        }
        // Newton's iteration may not converge over long steps of one size.
        bool const may_do_better = record_.discretisation.integrator == "implicit-runge-kutta" &&
                                   tolerance != conduction_tolerances.back() && record_.status == "unstable";
        if (!may_do_better) return std::nullopt;
        looser.reset();
        integration.time_error = integration.time_error_share = std::nullopt;
        integration.remark = no_time_error_because_it_broke;
        continue;
      }
      record_.status = "ok";
      record_.reason.clear();
      if (looser) {
        FieldErrors const change = errors_of(looser->y, tighter->y);
        double const share = time_error_share(change, errors_of(tighter->y, exact_));
        put_time_error(change.at("all").error.l2, share, integration);
        // What is no number will be none at any tolerance.
        if (!(share > largest_time_error_share)) {
          set_tolerance(accepted);
          history_ = std::move(history);
          return looser;
        }
      }
      accepted = tolerance;
      looser = std::move(tighter);
      history = history_;
    }
    // The tightest tolerance of all is taken.
    integration.remark =
        integration.time_error_share
            ? fmt::format(
                  "no tolerance down to {:g} brings it below {:g}: what is given is that of the last but "
                  "one, which bounds it",
                  conduction_tolerances.back(), largest_time_error_share)
            : "only the tightest tolerance got through: there is nothing to compare it with";
    return looser;
  }

  void describe_scene() {
    record_.scene = conduction_.scene().record();
    if (record_.discretisation.face_weight == "balanced")
      record_.smallest_face_weight = smallest_face_weight(conduction_.scene().geometry());
  }

  void measure(OdeResult const& result) {
    Scene<Dim>& scene = conduction_.scene();
    double const end = problem_.final_time;
    conduction_.evaluate(end, result.y.data());
    std::vector<ComparedField> fields{{"temperature", {result.y}, {exact_}}};
    VectorField<Dim> exact_flux;
    if (scene.scheme().first_passes.writes().contains(Field::flux) &&
        problem_.vectors.contains(Field::flux)) {
      exact_flux = sample(problem_.vectors.at(Field::flux), particles_, end);
      fields.push_back({"flux", components(particles_.vector(Field::flux)), components(exact_flux)});
    }
    require_finite(record_, fields, volumes_, regions_);
    if (options_.measure.contains(Measure::error)) {
      for (ComparedField const& field : fields) {
        record_.errors[std::string(field.name)] = field_errors(
            field.computed, field.exact, volumes_, regions_, field.name == "flux" ? 0.0 : round_off());
      }
      add_error_context(problem_, particles_, volumes_, regions_, record_.errors);
      measure_wall_flux();
    }
    if (options_.measure.contains(Measure::conservation)) measure_energy(result);
    require_finite_budgets(record_);
    if (options_.measure.contains(Measure::profile))
      record_.profile = make_profile(particles_, fields, volumes_, regions_);
    if (options_.measure.contains(Measure::history)) record_.history = history_;
  }

  void measure_wall_flux() {
    if (!problem_.vectors.contains(Field::flux)) return;
    Scene<Dim>& scene = conduction_.scene();
    // Else there is none but what the walls prescribe.
    if (!scene.scheme().wall_terms_are_exchange && !scene.geometry().contacts.empty()) return;
    auto const power = scene.wall_power();
    auto const areas = scene.wall_areas();
    double scale = 0.0;
    for (std::size_t i = 0; i < particles_.size(); ++i) {
      Vector<Dim> const flux =
          problem_.vectors.at(Field::flux)(particles_.positions()[i], problem_.final_time);
      for (Wall<Dim> const& wall : problem_.walls)
        scale = larger(scale, std::abs(flux.dot(wall.outward_normal)));
    }
    for (std::size_t w = 0; w < problem_.walls.size(); ++w) {
      Number const inward = exact_wall_flux(problem_.vectors.at(Field::flux), problem_.walls[w], particles_,
                                            volumes_, problem_.final_time);
      if (!inward) continue;
      double const measured = power[w] / areas[w];
      record_.wall_flux.push_back({measured, *inward, measured - *inward, scale});
    }
  }

  void measure_energy(OdeResult const& result) {
    std::size_t const walls = problem_.walls.size();
    Budget budget;
    budget.initial =
        energy_of(particles_, sample(problem_.scalars.at(Field::temperature), particles_, 0.0).data());
    budget.final = energy_of(particles_, result.y.data());
    for (std::size_t k = 0; k < walls + 1; ++k) budget.exchanged += result.quadratures[k];
    budget.drift = budget.final - budget.initial - budget.exchanged;
    budget.pair_drift = result.quadratures[walls + 1];
    auto const prescribed = conduction_.scene().prescribed_wall_power(problem_.final_time);
    bool known = !prescribed.empty() && conduction_.scene().scheme().wall_terms_are_exchange;
    double defect = 0.0;
    for (std::size_t w = 0; w < prescribed.size(); ++w) {
      known = known && prescribed[w].has_value();
      defect += result.quadratures[w] - result.quadratures[walls + 2 + w];
    }
    if (known) budget.wall_budget_defect = defect;
    if (!conduction_.scene().exchange_is_known()) {
      budget.exchanged = budget.drift = std::numeric_limits<double>::quiet_NaN();
      budget.pair_drift.reset();
    }
    record_.conservation["energy"] = budget;

    Budget mass;  // frozen particles carry theirs along
    for (double const m : particles_.masses()) mass.final += m;
    mass.initial = mass.final;
    record_.conservation["mass"] = mass;
  }

  /// Of the rate linearised about the exact solution at the final time.
  void measure_stability() {
    Stability& stability = record_.stability.emplace();
    if (particles_.size() > largest_sparse_spectrum) {
      stability.remark = fmt::format("not computed for more than {} particles", largest_sparse_spectrum);
      return;
    }
    ColouredJacobian& jacobian = conduction_.jacobian();
    Spectrum const found =
        spectrum(jacobian.pattern(), jacobian.evaluate(problem_.final_time, exact_.data()), jacobian.error());
    stability = stability_of(found);
    if (stability.spectral_abscissa) {
      stability.worst_mode = mode_shape(found.eigenvalues.front(), found.modes.front(), particles_,
                                        problem_.domain, problem_.walls, conduction_.scene().spacing());
    }
    if (found.complete) measure_stable_steps(found);
    if (!options_.measure.contains(Measure::spectrum)) return;
    for (auto const& lambda : found.eigenvalues) record_.spectrum.push_back({lambda.real(), lambda.imag()});
  }

  void measure_stable_steps(Spectrum const& found) {
    Stability& stability = *record_.stability;
    auto const out_of_time = [&] {
      if (options_.interrupted && *options_.interrupted) throw Interrupted();
      // The repeats have the other half.
      double const part = run_.awaits_timing ? 0.5 : 1.0;
      return options_.time_budget > 0.0 && spent() > part * options_.time_budget;
    };
    auto const rate = [&](double const* T, double* out) {
      conduction_.evaluate(problem_.final_time, T);
      conduction_.scene().heating(problem_.final_time, out);
    };
    // Affine rates may be perturbed by any amount; others by little enough to stay on the tangent.
    double const amplitude = (problem_.conducts_linearly() ? 1.0 : 1e-6) * scale_;
    for (ButcherTable const& method : explicit_methods()) {
      StableStep& step = stability.stable_steps[method.name] = stable_step(method, found);
      if (!options_.measure.contains(Measure::stable_step) || !step.theory) continue;
      step.measured = measured_stable_step(method, rate, exact_, amplitude, *step.theory, out_of_time);
      if (!step.measured)
        step.remark = "no step was found in the time budget that separates stable from unstable";
    }
  }

  /// One more run, watched at times that do not depend on its steps, at a tolerance at which what was
  /// accepted for the end holds for the first moments too.
  void measure_second_law() {
    double const tolerance = std::min(watch_tolerance, *record_.integration->relative_tolerance);
    if (problem_.source) {
      record_.second_law.emplace().remark = "a source gives heat: what is conducted cannot be told apart";
      return;
    }
    watch_.emplace(conduction_.scene(), scale_, 2.0 * tolerance * scale_);
    if (integrate(conduction_, tolerance, false)) {
      record_.second_law = watch_->result();
    } else {
      // The measured run stands; only the watch over it is lost, and was to the time budget.
      record_.second_law.emplace().remark = record_.reason;
      record_.status = "ok";
      record_.reason.clear();
    }
    watch_.reset();
  }

  MeasuredRun& run_;
  FrozenConduction<Dim> conduction_;
  Particles<Dim> const& particles_;
  std::vector<double> exact_, volumes_;
  std::vector<Region> regions_;
};

}  // namespace

template <int Dim>
void run_conduction(Problem<Dim> const& problem, SceneChoice const& choice, RunOptions const& options,
                    MeasuredRun& run) {
  ConductionRun<Dim>(problem, choice, options, run).run();
}

template <int Dim>
Repetition repeat_conduction(Problem<Dim> const& problem, SceneChoice const& choice,
                             RunOptions const& options, RunRecord const& record) {
  double const scale = temperature_scale(problem);
  double const tolerance = *record.integration->relative_tolerance;
  return [&problem, choice, &options, scale, tolerance](double spent_seconds) -> std::optional<Cost> {
    RunRecord ignored;  // the measured run stands, whatever becomes of its repeats
    ignored.discretisation = choice.discretisation;
    Clock const clock;
    ConductionIntegration<Dim> integration(problem, options, ignored, scale, spent_seconds);
    FrozenConduction<Dim> conduction(problem, choice, scale);
    double const setup = clock.seconds();
    auto const result = integration.integrate(conduction, tolerance, false);
    double const seconds = clock.seconds();
    double const cpu_seconds = clock.cpu_seconds();
    if (!result) return std::nullopt;
    Cost cost;
    cost.seconds = seconds;
    cost.cpu_seconds = options.threads == 1 ? Number(cpu_seconds) : std::nullopt;
    cost.setup_seconds = setup;
    cost.steps = result->steps;
    cost.rate_evaluations = conduction.scene().work().evaluations;
    cost.pair_interactions = conduction.scene().work().pair_interactions;
    cost.peak_bytes = conduction.bytes();
    return cost;
  };
}

template void run_conduction(Problem<1> const&, SceneChoice const&, RunOptions const&, MeasuredRun&);
template Repetition repeat_conduction(Problem<1> const&, SceneChoice const&, RunOptions const&,
                                      RunRecord const&);
template void run_conduction(Problem<2> const&, SceneChoice const&, RunOptions const&, MeasuredRun&);
template Repetition repeat_conduction(Problem<2> const&, SceneChoice const&, RunOptions const&,
                                      RunRecord const&);
template void run_conduction(Problem<3> const&, SceneChoice const&, RunOptions const&, MeasuredRun&);
template Repetition repeat_conduction(Problem<3> const&, SceneChoice const&, RunOptions const&,
                                      RunRecord const&);

}  // namespace sphverify
