// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/run/moving_run.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "harness/measure/norms.hpp"
#include "harness/run/compared.hpp"
#include "harness/run/error_context.hpp"
#include "harness/run/exact_fields.hpp"
#include "harness/run/gas_stability.hpp"
#include "harness/run/measure_moving.hpp"
#include "harness/run/moving_integration.hpp"
#include "harness/scene/wall_geometry.hpp"

namespace sphverify {

namespace {

/// From coarse to fine: parts of the usual step limits, and relative tolerances.
constexpr std::array<double, 2> courant_ladder{1.0, 0.5};
constexpr std::array<double, 4> gas_tolerances{1e-4, 1e-6, 1e-8, 1e-10};

template <int Dim>
class MovingRun : MovingIntegration<Dim> {
 public:
  using MovingIntegration<Dim>::MovingIntegration;

  void run() {
    if (asks_for_stability()) measure_stability();
    std::optional<FinalState<Dim>> const state = choose_step();
    if (!state) return;
    measure(*state);
    run_.spent_seconds = spent();
  }

  /// One more at the rung that the record says; empty if it broke.
  std::optional<Cost> repeat() {
    auto const again = integrate(choice_, accepted_rung());
    return again ? std::optional(again->cost) : std::nullopt;
  }

 private:
  double accepted_rung() const {
    return is_leapfrog() ? *record_.integration->courant_factor : *record_.integration->relative_tolerance;
  }

  bool asks_for_stability() const {
    return options_.measure.contains(Measure::stability) || options_.measure.contains(Measure::spectrum) ||
           options_.measure.contains(Measure::stable_step);
  }

  void measure_stability() {
    auto const out_of_time = [&] {
      if (options_.interrupted && *options_.interrupted) throw Interrupted();
      return options_.time_budget > 0.0 && spent() > 0.5 * options_.time_budget;
    };
    try {
      record_.stability = gas_stability(problem_, choice_, options_.measure.contains(Measure::spectrum),
                                        options_.measure.contains(Measure::stable_step), out_of_time);
    } catch (BrokenRun const& broken) {
      record_.stability.emplace().remark = broken.what();
    }
    if (!options_.measure.contains(Measure::spectrum)) return;
    for (Mode const& mode : record_.stability->modes)
      record_.spectrum.push_back({mode.growth, mode.frequency});
  }

  std::vector<Field> scalar_fields() const {
    std::vector<Field> fields{Field::density, Field::pressure, Field::internal_energy};
    if (!choice_.conduction.empty()) fields.push_back(Field::temperature);
    return fields;
  }

  /// Errors of all fields of a state against values at its particles: the exact ones, or another run's.
  std::map<std::string, FieldErrors> differences(FinalState<Dim> const& state,
                                                 Particles<Dim> const* other) const {
    Particles<Dim> const& particles = state.gas->scene().particles();
    double const t = problem_.final_time;
    auto const volumes = exact_volumes(problem_, particles, t);
    auto const places = regions_of(state.gas->scene());
    double const round_off =
        64.0 * std::numeric_limits<double>::epsilon() * std::sqrt(static_cast<double>(state.steps));
    std::map<std::string, FieldErrors> all;
    for (Field const field : scalar_fields()) {
      auto const reference = other ? other->scalar(field) : sample(problem_.scalars.at(field), particles, t);
      all.emplace(info(field).name, field_errors({particles.scalar(field)}, {reference}, volumes, places,
                                                 round_off * largest_magnitude(reference)));
    }
    VectorField<Dim> const velocity =
        other ? other->vector(Field::velocity) : sample(problem_.vectors.at(Field::velocity), particles, t);
    double const speed = state.gas->scene().scales()[state.gas->scene().coordinates()];
    all.emplace("velocity", field_errors(components(particles.vector(Field::velocity)), components(velocity),
                                         volumes, places, round_off * speed));
    return all;
  }

  /// Over fields, regions and norms.
  static double share_of(std::map<std::string, FieldErrors> const& changes,
                         std::map<std::string, FieldErrors> const& errors) {
    double share = 0.0;
    for (auto const& [field, change] : changes)
      share = larger(share, time_error_share(change, errors.at(field)));
    return share;
  }

  std::optional<FinalState<Dim>> choose_step() {
    Integration& integration = record_.integration.emplace();
    integration.method = method();
    integration.remark = no_time_error_because_it_broke;
    auto const describe = [&](double rung) {
      if (is_leapfrog()) {
        integration.courant_factor = rung;
      } else {
        integration.relative_tolerance = integration.absolute_tolerance = rung;
      }
    };
    std::vector<double> rungs(gas_tolerances.begin(), gas_tolerances.end());
    if (is_leapfrog()) rungs.assign(courant_ladder.begin(), courant_ladder.end());
    std::optional<FinalState<Dim>> looser;
    double accepted = 0.0;
    for (double const rung : rungs) {
      describe(rung);
      std::optional<FinalState<Dim>> tighter = integrate(choice_, rung);
      if (!tighter) {
        // Only the check ran out of time: what it was to check stands. Leapfrog's steps are those of the limits; of a
        // tolerance that was never compared nobody knows whether it was enough.
        if (looser && record_.reason.starts_with("time budget") && (is_leapfrog() || integration.time_error_share)) {
          integration.remark = is_leapfrog() ? half_step_out_of_time : next_tolerance_out_of_time;
          record_.status = "ok";
          record_.reason.clear();
          describe(accepted);
          return looser;
        }
        // A loose tolerance can lead where the equations do not.
        bool const may_do_better = !is_leapfrog() && rung != rungs.back() && record_.status != "timed-out";
        if (!may_do_better) return std::nullopt;
        looser.reset();
        integration.time_error = integration.time_error_share = std::nullopt;
        integration.remark = no_time_error_because_it_broke;
        continue;
      }
      record_.status = "ok";
      record_.reason.clear();
      if (!options_.measure.contains(Measure::error)) {
        integration.remark = "the measure error was not asked for: nothing was compared";
        return tighter;
      }
      if (looser) {
        auto const changes = differences(*looser, &tighter->gas->scene().particles());
        double const share = share_of(changes, differences(*looser, nullptr));
        put_time_error(changes.at("velocity").at("all").error.l2, share, integration);
        // Leapfrog is for what jumps: its change on one halving is measured, not brought below a limit.
        if (!(share > largest_time_error_share) || is_leapfrog()) {
          describe(accepted);
          return looser;
        }
      }
      accepted = rung;
      looser = std::move(tighter);
    }
    integration.remark =
        integration.time_error_share
            ? fmt::format(
                  "no tolerance down to {:g} brings it below {:g}: what is given is that of the last but "
                  "one, which bounds it",
                  rungs.back(), largest_time_error_share)
            : "only the tightest tolerance got through: there is nothing to compare it with";
    return looser;
  }

  void measure(FinalState<Dim> const& state) {
    MovingScene<Dim> const& scene = state.gas->scene();
    record_.scene = scene.record();
    Motion& motion = record_.motion.emplace(motion_of(state));
    double volume = 0.0;
    for (std::size_t i = 0; i < scene.particles().size(); ++i) {
      volume += scene.particles().masses()[i] / scene.particles().scalar(Field::density)[i];
    }
    if (auto const defect = scene.volume_defect()) motion.volume_defect = *defect / volume;
    if (record_.discretisation.face_weight == "balanced") {
      record_.smallest_face_weight = smallest_face_weight(scene.geometry());
    }
    compare_fields(scene);
    if (options_.measure.contains(Measure::error)) {
      record_.errors = differences(state, nullptr);
      add_error_context(problem_, scene.particles(),
                        exact_volumes(problem_, scene.particles(), problem_.final_time), regions_of(scene),
                        record_.errors);
      if (!choice_.conduction.empty()) measure_wall_flux(problem_, scene, record_);
      if (problem_.shocks) measure_shocks(problem_, scene, record_, motion);
    }
    if (options_.measure.contains(Measure::conservation)) measure_budgets(problem_, choice_, scene, state.budgets, record_);
    require_finite_budgets(record_);
    if (options_.measure.contains(Measure::history)) record_.history = thinned(state.history);
    if (record_.status != "ok") return;
    if (options_.measure.contains(Measure::energy_routes)) measure_energy_routes(state, motion);
    if (options_.measure.contains(Measure::cost)) measure_cost(state);
  }

  /// Where errors are taken.
  std::vector<Region> regions_of(MovingScene<Dim> const& scene) const {
    auto const counts = [&](std::size_t i) {
      return !problem_.holds || problem_.holds(scene.particles().positions()[i], problem_.final_time);
    };
    return regions(scene.particles(), scene.walls(), counts, final_features(problem_),
                   smooth_margin(problem_.domain));
  }

  /// Notices what is no number, and stores the profile.
  void compare_fields(MovingScene<Dim> const& scene) {
    Particles<Dim> const& particles = scene.particles();
    double const t = problem_.final_time;
    std::map<Field, std::vector<double>> exact;
    std::vector<ComparedField> fields;
    for (Field const field : scalar_fields()) {
      exact[field] = sample(problem_.scalars.at(field), particles, t);
      fields.push_back({info(field).name, {particles.scalar(field)}, {exact[field]}});
    }
    VectorField<Dim> const velocity = sample(problem_.vectors.at(Field::velocity), particles, t);
    fields.push_back({"velocity", components(particles.vector(Field::velocity)), components(velocity)});
    auto const volumes = exact_volumes(problem_, particles, t);
    auto const places = regions_of(scene);
    require_finite(record_, fields, volumes, places);
    if (options_.measure.contains(Measure::profile))
      record_.profile = make_profile(particles, fields, volumes, places);
  }

  /// The same run with the other work form.
  void measure_energy_routes(FinalState<Dim> const& state, Motion& motion) {
    SceneChoice other = choice_;
    bool const total = find_scheme(choice_.work)->rate == Rate::total_work;
    other.work = total ? find_scheme(choice_.formulation)->work_partner : "work/total-energy";
    if (!find_scheme(other.work)) return;  // the form knows of no other
    RunRecord const kept = record_;
    auto const found = integrate(other, accepted_rung());
    if (!found) {
      record_ = kept;  // this run stands; only the comparison is lost
      return;
    }
    auto const apart = differences(state, &found->gas->scene().particles()).at("internal_energy").at("all");
    if (apart.scale.l2 > 0.0) motion.energy_routes = apart.error.l2 / apart.scale.l2;
  }

  /// The measured run warms up. Where it is to be timed once only, or takes all the time that the repeats may
  /// take, it is timed itself instead: a second run would cost more than it tells.
  void measure_cost(FinalState<Dim> const& state) {
    RepeatRule const& rule = options_.repeat;
    bool const out_of_time = options_.time_budget > 0.0 && spent() > 0.5 * options_.time_budget;
    bool const once_is_enough =
        rule.most == 1 || (rule.seconds > 0.0 && state.cost.seconds >= rule.seconds) || out_of_time;
    record_.cost = time_repeats(
        {}, [&] { return std::optional(state.cost); }, [] { return false; });
    record_.cost->warm_up = false;
    run_.awaits_timing = !once_is_enough;
  }

  using Base = MovingIntegration<Dim>;
  using Base::choice_;
  using Base::integrate;
  using Base::is_leapfrog;
  using Base::method;
  using Base::options_;
  using Base::problem_;
  using Base::record_;
  using Base::run_;
  using Base::spent;
};

}  // namespace

template <int Dim>
void run_moving(Problem<Dim> const& problem, SceneChoice const& choice, RunOptions const& options,
                MeasuredRun& run) {
  MovingRun<Dim>(problem, choice, options, run).run();
}

template <int Dim>
Repetition repeat_moving(Problem<Dim> const& problem, SceneChoice const& choice, RunOptions const& options,
                         RunRecord const& record) {
  Integration const integration = *record.integration;
  return [&problem, choice, &options, integration](double spent_seconds) {
    MeasuredRun ignored;  // the measured run stands, whatever becomes of its repeats
    ignored.record.discretisation = choice.discretisation;
    ignored.record.integration = integration;
    ignored.spent_seconds = spent_seconds;
    return MovingRun<Dim>(problem, choice, options, ignored).repeat();
  };
}

template void run_moving(Problem<1> const&, SceneChoice const&, RunOptions const&, MeasuredRun&);
template Repetition repeat_moving(Problem<1> const&, SceneChoice const&, RunOptions const&, RunRecord const&);
template void run_moving(Problem<2> const&, SceneChoice const&, RunOptions const&, MeasuredRun&);
template Repetition repeat_moving(Problem<2> const&, SceneChoice const&, RunOptions const&, RunRecord const&);
template void run_moving(Problem<3> const&, SceneChoice const&, RunOptions const&, MeasuredRun&);
template Repetition repeat_moving(Problem<3> const&, SceneChoice const&, RunOptions const&, RunRecord const&);

}  // namespace sphverify
