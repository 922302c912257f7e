// SPDX-License-Identifier: GPL-3.0-or-later
#include <atomic>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <memory>

#include "formulations/kernels/cubic_spline.hpp"
#include "harness/run/moving_gas.hpp"
#include "tests/support/runs.hpp"

BOOST_AUTO_TEST_SUITE(harness_run_moving)

using namespace sphverify;
using namespace sphverify::tests;
using boost::test_tools::tolerance;

/// A moving gas, as a study would run it.
struct Gas {
  std::string scene_case;
  std::string formulation = "momentum/p-rho2", work = "work/internal-energy", conduction = "";
  int resolution = 30;
  Discretisation discretisation = {};
  std::vector<std::pair<std::string, ParameterValue>> parameters = {};
  double smoothing_ratio = 1.2;
};

constexpr ViscosityChoice usual_viscosity{1.0, 2.0};

Discretisation moved_by(std::string const& integrator, ViscosityChoice viscosity,
                        std::string const& density = "continuity") {
  Discretisation d;
  d.density = density;
  d.integrator = integrator;
  d.viscosity = viscosity;
  return d;
}

RunSpec spec_of(Gas const& gas) {
  RunSpec spec = make_spec({.scene_case = gas.scene_case,
                            .formulation = gas.formulation,
                            .resolution = gas.resolution,
                            .smoothing_ratio = gas.smoothing_ratio,
                            .discretisation = gas.discretisation,
                            .parameters = gas.parameters});
  spec.formulation.work = gas.work;
  spec.formulation.conduction = gas.conduction;
  return spec;
}

RunRecord run(Gas const& gas, MeasureSet measure, double time_budget = 0.0) {
  RunOptions options;
  options.measure = measure;
  options.time_budget = time_budget;
  return execute(spec_of(gas), options);
}

RunRecord run_well(Gas const& gas, MeasureSet measure) {
  RunRecord const record = run(gas, measure);
  BOOST_TEST_REQUIRE(record.status == "ok",
                     gas.scene_case << " " << gas.formulation << ": " << record.reason);
  return record;
}

Problem<1> problem_of(Gas const& gas) {
  RunSpec const spec = spec_of(gas);
  return std::get<Problem<1>>(spec.scene_case->problem(spec.parameters));
}

SceneChoice choice_of(Gas const& gas) {
  return {.formulation = gas.formulation,
          .work = gas.work,
          .conduction = gas.conduction,
          .discretisation = gas.discretisation,
          .resolution = gas.resolution,
          .smoothing_ratio = gas.smoothing_ratio};
}

/// The gas at its final time; `rung` is the part of the usual step limits, or the tolerance of runge-kutta.
std::unique_ptr<MovingGas<1>> integrated(Gas const& gas, std::string const& method, double rung) {
  auto moving =
      std::make_unique<MovingGas<1>>(problem_of(gas), choice_of(gas), method == "leapfrog" ? rung : 1.0);
  OdeResult const result =
      moving->integrate(method, {rung, rung}, [](double, double const*, GasBudgets<1> const&) -> std::string { return ""; });
  BOOST_TEST_REQUIRE((result.outcome == OdeOutcome::finished), result.reason);
  return moving;
}

double root_mean_square(std::vector<double> const& a, std::vector<double> const& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

std::vector<double> const& velocities(MovingGas<1> const& gas) {
  return gas.scene().particles().vector(Field::velocity).component(0);
}

std::vector<double> const& energies(MovingGas<1> const& gas) {
  return gas.scene().particles().scalar(Field::internal_energy);
}

std::string const p_rho2 = "momentum/p-rho2";
std::string const sqrt_p = "momentum/sqrt-p";

// ---- Rest

BOOST_AUTO_TEST_CASE(a_uniform_gas_without_walls_stays_at_rest_and_runs_no_wall_pass) {
  for (char const* density : {"continuity", "summation", "normalised"}) {
    for (char const* integrator : {"leapfrog", "runge-kutta"}) {
      for (std::string const& formulation : {p_rho2, sqrt_p}) {
        Gas gas{.scene_case = "hydro/uniform", .formulation = formulation};
        gas.work = formulation == sqrt_p ? "work/sqrt-p" : "work/internal-energy";
        gas.discretisation = moved_by(integrator, usual_viscosity, density);
        gas.parameters = {{"boundary", std::string("periodic")}};
        RunRecord const record = run_well(gas, {Measure::error, Measure::conservation});
        // An adaptive step grows while nothing happens, until round-off is amplified to below its tolerance.
        double const allowed = gas.discretisation.integrator == "leapfrog" ? 1e-12 : 1e-6;
        BOOST_TEST(record.errors.at("velocity").at("all").error.linf < allowed);
        BOOST_TEST(std::abs(record.momentum.at(0).final) < 1e-13);
        BOOST_TEST(!record.scene.passes.contains("wall-contacts"));
        BOOST_TEST(record.scene.passes.contains("neighbour-search"));
        BOOST_TEST(record.wall_budgets.empty());
      }
    }
  }
  Gas const walled{.scene_case = "hydro/uniform", .discretisation = moved_by("leapfrog", {})};
  BOOST_TEST(run_well(walled, {Measure::error}).scene.passes.at("wall-contacts") > 0u);
}

BOOST_AUTO_TEST_CASE(a_uniform_gas_beside_a_wall_is_not_at_rest_until_h_grows_over_the_spacing) {
  auto const push = [](std::string const& formulation, double smoothing_ratio) {
    Gas const gas{.scene_case = "hydro/uniform",
                  .formulation = formulation,
                  .resolution = 40,
                  .discretisation = moved_by("leapfrog", {}),
                  .parameters = {{"pressure", 3.0}, {"density", 2.0}},
                  .smoothing_ratio = smoothing_ratio};
    MovingScene<1> scene(problem_of(gas), choice_of(gas));
    scene.evaluate(0.0, scene.initial_state().data());
    std::vector<double> rates(scene.unknowns());
    scene.rates(rates.data());
    // Of the first particle, over P/(rho dx).
    return rates[scene.coordinates()] / (3.0 / 2.0 * 40.0);
  };
  for (std::string const& formulation : {p_rho2, sqrt_p}) {
    BOOST_TEST(push(formulation, 1.2) == -0.063, tolerance(0.02));
    BOOST_TEST(std::abs(push(formulation, 1.8)) < 0.015);
    BOOST_TEST(std::abs(push(formulation, 4.8)) < 0.002);
  }
}

// ---- Conservation

struct Conserved {
  std::string formulation, work;
  ViscosityChoice viscosity;
  std::string smoothing;
  double jitter;
  std::string density = "continuity", integrator = "leapfrog";
};

std::ostream& operator<<(std::ostream& out, Conserved const& c) {
  return out << c.formulation << " " << c.work << " " << c.density << " " << c.smoothing << " viscosity "
             << c.viscosity.alpha << " jitter " << c.jitter << " " << c.integrator;
}

RunRecord budgets_of(Conserved const& c, std::string const& scene_case, int resolution, double final_time,
                     double dimension = 1.0) {
  Gas gas{.scene_case = scene_case, .formulation = c.formulation, .work = c.work, .resolution = resolution};
  gas.discretisation = moved_by(c.integrator, c.viscosity, c.density);
  gas.discretisation.smoothing = c.smoothing;
  if (c.jitter > 0.0) gas.discretisation.layout = {"jittered", c.jitter, 3};
  gas.parameters = {{"final_time", final_time}};
  if (dimension > 1.0) gas.parameters.emplace_back("dimension", dimension);
  return run_well(gas, {Measure::conservation});
}

/// What time stepping may create of energy beside what walls and sources exchange: of the loosest tolerance, which each of a few
/// steps may use up, some tens.
double error_in_time(Conserved const& c, double exchanged) { return c.integrator == "runge-kutta" ? 5e-3 * std::abs(exchanged) : 1e-4; }

BOOST_AUTO_TEST_CASE(pairs_of_partners_create_neither_momentum_nor_energy) {
  for (auto const& [formulation, work] :
       {std::pair<char const*, char const*>{"momentum/p-rho2", "work/internal-energy"},
        {"momentum/p-rho2", "work/total-energy"},
        {"momentum/sqrt-p", "work/sqrt-p"},
        {"momentum/gdsph", "work/gdsph"},
        {"momentum/pressure-energy", "work/pressure-energy"},
        {"momentum/rkgc", "work/rkgc"}}) {
    for (ViscosityChoice const viscosity : {ViscosityChoice{}, usual_viscosity}) {
      for (char const* smoothing : {"uniform", "adaptive"}) {
        for (double const jitter : {0.0, 0.15}) {
          for (auto const& [density, integrator] :
               {std::pair<char const*, char const*>{"continuity", "leapfrog"},
                {"normalised", "leapfrog"},
                {"continuity", "runge-kutta"}}) {
            Conserved const c{formulation, work, viscosity, smoothing, jitter, density, integrator};
            // Walls that move and sources, and gas that is far from at rest.
            RunRecord const record = budgets_of(c, "hydro/manufactured", 24, 0.05);
            Budget const& momentum = record.momentum.at(0);
            Budget const& energy = record.conservation.at("energy");
            BOOST_TEST(std::abs(momentum.pair_drift.value()) < 1e-14, c);
            BOOST_TEST(std::abs(momentum.drift) < 1e-14, c << ": " << momentum.drift);
            BOOST_TEST(std::abs(energy.pair_drift.value()) < 1e-14, c);
            // Time stepping keeps what is linear in the unknowns.
            bool const linear = c.work == "work/total-energy";
            BOOST_TEST(std::abs(energy.drift) < (linear ? 2e-14 : error_in_time(c, energy.exchanged)), c << ": " << energy.drift);
            BOOST_TEST(std::abs(energy.exchanged) > 1e-3, c);
          }
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(pairs_of_partners_conserve_in_two_dimensions) {
  for (auto const& [formulation, work] :
       {std::pair<char const*, char const*>{"momentum/p-rho2", "work/internal-energy"},
        {"momentum/p-rho2", "work/total-energy"},
        {"momentum/sqrt-p", "work/sqrt-p"},
        {"momentum/gdsph", "work/gdsph"},
        {"momentum/pressure-energy", "work/pressure-energy"},
        {"momentum/rkgc", "work/rkgc"}}) {
    Conserved const c{formulation, work, usual_viscosity, "adaptive", 0.15};
    RunRecord const record = budgets_of(c, "hydro/manufactured", 8, 0.02, 2.0);
    BOOST_TEST_REQUIRE(record.momentum.size() == 2u);
    for (Budget const& momentum : record.momentum) {
      BOOST_TEST(std::abs(momentum.pair_drift.value()) < 1e-14, c);
      BOOST_TEST(std::abs(momentum.drift) < 1e-14, c);
    }
    Budget const& energy = record.conservation.at("energy");
    BOOST_TEST(std::abs(energy.pair_drift.value()) < 1e-14, c);
    if (c.work == "work/total-energy") BOOST_TEST(std::abs(energy.drift) < 2e-14, c);
  }
}

/// Passes that a momentum form and its partner share are run once a force, and once more where the work is asked for again; those
/// of two forms that are not one another's are run for each.
BOOST_AUTO_TEST_CASE(partners_share_their_first_passes) {
  auto const passes_of = [](char const* work) {
    RunRecord const record = budgets_of({"momentum/rkgc", work, usual_viscosity, "uniform", 0.0}, "hydro/manufactured", 24, 0.01);
    return record.scene.passes;
  };
  auto const shared = passes_of("work/rkgc");
  BOOST_TEST(shared.at("missing-surface") == shared.at("work/rkgc"));
  BOOST_TEST(shared.at("momentum/rkgc") < shared.at("work/rkgc"));
  auto const apart = passes_of("work/pressure-energy");
  BOOST_TEST(apart.at("missing-surface") == apart.at("momentum/rkgc"));
  BOOST_TEST(apart.at("smoothed-pressure") == apart.at("work/pressure-energy"));
}

BOOST_AUTO_TEST_CASE(grad_h_terms_create_neither_momentum_nor_energy) {
  for (char const* density : {"summation", "normalised"}) {
    for (char const* integrator : {"leapfrog", "runge-kutta"}) {
      Conserved const c{"momentum/p-rho2-grad-h", "work/p-rho2-grad-h", usual_viscosity, "adaptive", 0.15, density, integrator};
      RunRecord const record = budgets_of(c, "hydro/manufactured", 24, 0.05);
      Budget const& energy = record.conservation.at("energy");
      BOOST_TEST(std::abs(record.momentum.at(0).pair_drift.value()) < 1e-14, c);
      BOOST_TEST(std::abs(record.momentum.at(0).drift) < 1e-14, c);
      BOOST_TEST(std::abs(energy.pair_drift.value()) < 1e-14, c);
      BOOST_TEST(std::abs(energy.drift) < error_in_time(c, energy.exchanged), c << ": " << energy.drift);
      BOOST_TEST(std::abs(energy.exchanged) > 1e-3, c);
      BOOST_TEST(record.scene.passes.at("grad-h") > 0u);
    }
  }
}

// Without walls and viscosity: a standing wave on disorder, smoothing lengths that follow the density. By the
// pairs' mean h the heat of compression is not that of the summed density, and entropy is made and lost.
BOOST_AUTO_TEST_CASE(with_grad_h_terms_every_particle_keeps_its_entropy_in_smooth_flow) {
  auto const largest_change = [](std::string const& formulation, std::string const& work, double tolerance) {
    Gas gas{.scene_case = "hydro/acoustic", .formulation = formulation, .work = work};
    gas.discretisation = moved_by("runge-kutta", {}, "summation");
    gas.discretisation.smoothing = "adaptive";
    gas.discretisation.layout = {"jittered", 0.2, 3};
    gas.parameters = {{"boundary", std::string("periodic")}, {"amplitude", 0.03}};
    auto const entropies = [](MovingScene<1> const& scene) {
      std::vector<double> all;
      Particles<1> const& p = scene.particles();
      for (std::size_t i = 0; i < p.size(); ++i)
        all.push_back(p.scalar(Field::internal_energy)[i] / std::pow(p.scalar(Field::density)[i], scene.problem().gamma - 1.0));
      return all;
    };
    MovingScene<1> start(problem_of(gas), choice_of(gas));
    start.evaluate(0.0, start.initial_state().data());
    std::vector<double> const before = entropies(start), after = entropies(integrated(gas, "runge-kutta", tolerance)->scene());
    double largest = 0.0;
    for (std::size_t i = 0; i < before.size(); ++i) largest = std::max(largest, std::abs(after[i] / before[i] - 1.0));
    return largest;
  };
  double const kept = largest_change("momentum/p-rho2-grad-h", "work/p-rho2-grad-h", 1e-10);
  double const by_mean_h = largest_change("momentum/p-rho2", "work/internal-energy", 1e-10);
  BOOST_TEST_MESSAGE("entropy: " << kept << " with grad-h terms, " << by_mean_h << " by the mean h");
  BOOST_TEST(kept < 1e-7);
  BOOST_TEST(by_mean_h > 1e-4);
}

BOOST_AUTO_TEST_CASE(direct_gradient_creates_momentum_and_energy) {
  for (double const jitter : {0.0, 0.15}) {
    Conserved const c{"momentum/direct-gradient", "work/internal-energy", {}, "uniform", jitter};
    RunRecord const record = budgets_of(c, "hydro/manufactured", 24, 0.05);
    Budget const& momentum = record.momentum.at(0);
    Budget const& energy = record.conservation.at("energy");
    BOOST_TEST(std::abs(momentum.pair_drift.value()) > 1e-4, c);
    BOOST_TEST(std::abs(energy.pair_drift.value()) > 1e-4, c);
    // The drift is the pairs' work.
    BOOST_TEST(std::abs(momentum.drift - *momentum.pair_drift) < 1e-14, c);
    BOOST_TEST(std::abs(energy.drift - *energy.pair_drift) < 1e-5, c);
  }
}

BOOST_AUTO_TEST_CASE(what_is_no_partner_creates_energy) {
  Conserved const c{sqrt_p, "work/internal-energy", usual_viscosity, "uniform", 0.15};
  Budget const energy = budgets_of(c, "hydro/piston-velocity", 30, 0.2).conservation.at("energy");
  BOOST_TEST(std::abs(energy.pair_drift.value()) > 1e-6);
}

BOOST_AUTO_TEST_CASE(budgets_add_up_wall_by_wall) {
  for (char const* scene_case : {"hydro/piston-velocity", "hydro/piston-pressure", "hydro/noh"}) {
    Gas const gas{.scene_case = scene_case,
                  .resolution = 40,
                  .discretisation = moved_by("leapfrog", usual_viscosity),
                  .parameters = {{"final_time", 0.2}}};
    RunRecord const record = run_well(gas, {Measure::conservation});
    Budget const& momentum = record.momentum.at(0);
    Budget const& energy = record.conservation.at("energy");
    for (Budget const& b : {momentum, energy}) {
      BOOST_TEST(std::abs(b.final - b.initial - b.exchanged - b.drift) < 1e-15);
    }
    BOOST_TEST_REQUIRE(record.wall_budgets.size() == 2u);
    double impulse = 0.0, given = 0.0, impulse_defect = 0.0, energy_defect = 0.0;
    for (WallBudget const& wall : record.wall_budgets) {
      impulse += wall.impulse.at(0);
      given += wall.energy;
      impulse_defect += wall.impulse[0] - wall.prescribed_impulse.at(0);
      energy_defect += wall.energy - wall.prescribed_energy;
      BOOST_TEST(wall.heat == 0.0);
    }
    BOOST_TEST(std::abs(momentum.exchanged - impulse) < 1e-15);
    BOOST_TEST(std::abs(energy.exchanged - given) < 1e-15);
    BOOST_TEST(std::abs(momentum.wall_budget_defect.value() - impulse_defect) < 1e-15);
    BOOST_TEST(std::abs(energy.wall_budget_defect.value() - energy_defect) < 1e-15);
    // What a left wall gives pushes to the right.
    BOOST_TEST(record.wall_budgets[0].impulse[0] > 0.0);
    BOOST_TEST(record.wall_budgets[1].impulse[0] <= 0.0);
    Budget const& mass = record.conservation.at("mass");
    BOOST_TEST(mass.final == 1.0, tolerance(1e-12));
    BOOST_TEST(mass.drift == 0.0);
  }
}

BOOST_AUTO_TEST_CASE(budgets_are_the_exact_ones_of_a_piston) {
  // Gas of P = 0.5 at rest; the shock of P = 1 moves the gas behind it at u = D/3, D^2 = 3/2.
  Gas const gas{.scene_case = "hydro/piston-velocity",
                .resolution = 100,
                .discretisation = moved_by("leapfrog", usual_viscosity)};
  RunRecord const record = run_well(gas, {Measure::conservation});
  double const u = std::sqrt(1.5) / 3.0;
  BOOST_TEST(record.conservation.at("energy").initial == 0.75, tolerance(1e-12));
  BOOST_TEST(record.momentum[0].initial == 0.0);
  BOOST_TEST(record.momentum[0].exchanged == 0.25, tolerance(0.02));
  BOOST_TEST(record.conservation.at("energy").exchanged == 0.5 * u, tolerance(0.02));
  BOOST_TEST(record.wall_budgets[0].impulse[0] == 0.5, tolerance(0.02));
  BOOST_TEST(record.wall_budgets[1].impulse[0] == -0.25, tolerance(0.03));
  BOOST_TEST(std::abs(record.wall_budgets[1].energy) < 1e-3);
  BOOST_TEST(record.wall_budgets[0].position[0] == 0.5 * u, tolerance(1e-12));
  // What the closure says that the walls prescribe: the pressure behind the shock, but for what it is off
  // while the shock is not there yet, and the work of the wall's own speed.
  BOOST_TEST(record.wall_budgets[0].prescribed_impulse[0] == 0.5, tolerance(0.06));
  BOOST_TEST(record.wall_budgets[1].prescribed_impulse[0] == -0.25, tolerance(0.03));
  BOOST_TEST(record.wall_budgets[0].prescribed_energy == 0.5 * u, tolerance(0.06));
  BOOST_TEST(std::abs(record.wall_budgets[1].prescribed_energy) < 1e-3);
  BOOST_TEST(std::abs(record.conservation.at("energy").wall_budget_defect.value()) < 0.03);
  BOOST_TEST(std::abs(record.momentum[0].wall_budget_defect.value()) < 0.03);
  // A wall that stands or moves steadily works at the rate of its force, but for what the scheme loses.
  BOOST_TEST(record.wall_budgets[0].energy == u * record.wall_budgets[0].impulse[0], tolerance(0.02));

  Gas noh = gas;
  noh.scene_case = "hydro/noh";
  RunRecord const cold = run_well(noh, {Measure::conservation});
  BOOST_TEST(cold.momentum[0].initial == -1.0, tolerance(1e-12));
  BOOST_TEST(cold.conservation.at("energy").initial == 0.5, tolerance(1e-12));
}

// By hand from the profile: the particle nearest a wall, and of all walls the one where it is farthest off.
BOOST_AUTO_TEST_CASE(wall_heating_is_the_largest_relative_error_of_the_energy_next_to_a_wall) {
  for (auto const& [id, density] : {std::pair{"hydro/piston-velocity", "continuity"},
                                    {"hydro/piston-velocity", "summation"},
                                    {"hydro/noh", "continuity"},
                                    {"hydro/noh", "summation"}}) {
    Gas const gas{.scene_case = id,
                  .resolution = 40,
                  .discretisation = moved_by("leapfrog", usual_viscosity, density),
                  .parameters = {{"final_time", 0.3}}};
    RunRecord const record = run_well(gas, {Measure::conservation, Measure::error, Measure::profile});
    Profile const& profile = *record.profile;
    double expected = 0.0;
    for (WallBudget const& wall : record.wall_budgets) {
      std::size_t nearest = 0;
      auto const from_wall = [&](std::size_t i) {
        return std::abs(profile.position[i][0] - wall.position[0]);
      };
      for (std::size_t i = 0; i < profile.position.size(); ++i)
        nearest = from_wall(i) < from_wall(nearest) ? i : nearest;
      double const excess = profile.computed.at("internal_energy")[nearest][0] /
                                profile.exact.at("internal_energy")[nearest][0] -
                            1.0;
      if (std::abs(excess) > std::abs(expected)) expected = excess;
    }
    BOOST_TEST(record.motion->wall_heating.value() == expected, tolerance(1e-12));
  }
}

BOOST_AUTO_TEST_CASE(heat_through_walls_is_part_of_their_energy) {
  Gas const gas{.scene_case = "coupled/hot-wall",
                .conduction = "conduction/brookshaw",
                .resolution = 40,
                .discretisation = moved_by("runge-kutta", {}),
                .parameters = {{"final_time", 0.1}}};
  RunRecord const record = run_well(gas, {Measure::conservation, Measure::error});
  Budget const& energy = record.conservation.at("energy");
  double walls = 0.0;
  for (WallBudget const& wall : record.wall_budgets) walls += wall.energy;
  BOOST_TEST(record.wall_budgets[0].heat > 1e-3);
  BOOST_TEST(record.wall_budgets[0].energy > record.wall_budgets[0].heat);  // the piston works as well
  BOOST_TEST(std::abs(energy.drift) < 5e-6);  // a few times the tolerance of the steps
  BOOST_TEST(std::abs(energy.pair_drift.value()) < 1e-14);
  // What the left wall prescribes, heat and work, is what it gives.
  BOOST_TEST(record.wall_budgets[0].prescribed_energy == record.wall_budgets[0].energy, tolerance(0.1));
  // The body force gives the rest.
  BOOST_TEST(std::abs(energy.exchanged - walls) > 1e-6);
  BOOST_TEST(record.wall_flux.at(0).measured == record.wall_flux[0].exact, tolerance(0.1));
}

// ---- Time

/// The error in time of leapfrog, by halving its steps, against runge-kutta at a tight tolerance.
void check_second_order(Gas const& gas, double allowed) {
  auto const reference = integrated(gas, "runge-kutta", 1e-11);
  Problem<1> const problem = problem_of(gas);
  auto const& particles = reference->scene().particles();
  std::vector<double> exact(particles.size());
  for (std::size_t i = 0; i < exact.size(); ++i) {
    exact[i] = problem.vectors.at(Field::velocity)(particles.positions()[i], problem.final_time)[0];
  }
  double const space_error = root_mean_square(velocities(*reference), exact);
  double before_v = 0.0, before_e = 0.0;
  for (double const factor : {1.0, 0.5, 0.25}) {
    auto const leapfrog = integrated(gas, "leapfrog", factor);
    double const v = root_mean_square(velocities(*leapfrog), velocities(*reference));
    double const e = root_mean_square(energies(*leapfrog), energies(*reference));
    BOOST_TEST(v < 0.01 * space_error);
    if (before_v > 0.0) {
      BOOST_TEST(before_v / v == 4.0, tolerance(allowed));
      BOOST_TEST(before_e / e == 4.0, tolerance(allowed));
    }
    before_v = v;
    before_e = e;
  }
}

BOOST_AUTO_TEST_CASE(leapfrog_goes_to_runge_kutta_at_second_order_and_is_far_below_the_error_in_space) {
  for (ViscosityChoice const viscosity : {ViscosityChoice{}, usual_viscosity}) {
    Gas const gas{.scene_case = "hydro/manufactured",
                  .discretisation = moved_by("leapfrog", viscosity),
                  .parameters = {{"final_time", 0.1}}};
    check_second_order(gas, viscosity.alpha > 0.0 ? 0.15 : 0.03);  // viscosity sets in with a kink
  }
}

// Its pressure at a wall of prescribed velocity follows from the gas's velocity there, its velocity at one of prescribed pressure
// from the gas's pressure.
BOOST_AUTO_TEST_CASE(leapfrog_is_of_second_order_where_a_closure_solves_for_what_the_wall_does_not_prescribe) {
  for (char const* drive : {"velocity", "pressure"}) {
    Gas gas{.scene_case = "hydro/manufactured",
            .discretisation = moved_by("leapfrog", {}),
            .parameters = {{"final_time", 0.1}, {"drive", std::string(drive)}}};
    gas.discretisation.closure = "one-sided";
    check_second_order(gas, 0.05);
  }
}

BOOST_AUTO_TEST_CASE(leapfrog_is_of_second_order_with_heat_conduction_and_total_energy) {
  for (char const* work : {"work/internal-energy", "work/total-energy"}) {
    Gas const gas{.scene_case = "coupled/manufactured",
                  .work = work,
                  .conduction = "conduction/brookshaw",
                  .discretisation = moved_by("leapfrog", {}),
                  .parameters = {{"final_time", 0.1}}};
    check_second_order(gas, 0.05);
  }
}

// Each end of a step exchanges what its force does with the same velocities. With even steps what is left of energy telescopes.
BOOST_AUTO_TEST_CASE(leapfrog_keeps_energy_less_an_eighth_of_a_dt_squared_to_round_off) {
  Gas const gas{.scene_case = "hydro/acoustic",
                .discretisation = moved_by("leapfrog", {}),
                .parameters = {{"amplitude", 0.05}, {"mode", 2.0}, {"boundary", std::string("periodic")}}};
  MovingScene<1> scene(problem_of(gas), choice_of(gas));
  std::size_t const n = scene.coordinates();
  double const dt = 0.2 / static_cast<double>(gas.resolution);
  std::vector<double> rates(scene.unknowns());
  auto const kept = [&](double const* y) {
    double sum = scene.energy(y);
    for (std::size_t i = 0; i < n; ++i) sum -= scene.particles().masses()[i] * dt * dt * rates[n + i] * rates[n + i] / 8.0;
    return sum;
  };
  std::vector<double> const start = scene.initial_state();
  scene.evaluate(0.0, start.data());
  scene.rates(rates.data());
  double const first = kept(start.data());
  double worst = 0.0, worst_energy = 0.0;
  OdeSystem system;
  system.size = scene.unknowns();
  system.monitor = [&](double, double const* y, double const*) -> std::string {
    worst = std::max(worst, std::abs(kept(y) / first - 1.0));
    worst_energy = std::max(worst_energy, std::abs(scene.energy(y) / scene.energy(start.data()) - 1.0));
    return "";
  };
  OdeResult const result = integrate_leapfrog(system, start, 100.0 * dt,
                                              {.coordinates = n,
                                               .impulses = 0,
                                               .rate =
                                                   [&](double t, double const* y, double* dydt) {
                                                     scene.evaluate(t, y, dydt);
                                                     scene.rates(dydt);
                                                     rates.assign(dydt, dydt + rates.size());
                                                   },
                                               .drift =
                                                   [&](double, double const* y, double const* velocities, double* out) {
                                                     scene.drift(y, velocities);
                                                     scene.drift_rates(out);
                                                   },
                                               .largest_step = [&](double) { return dt * (1.0 + 1e-9); },
                                               .smallest_step = 0.0,
                                               .most_steps = 1000});
  BOOST_TEST_REQUIRE((result.outcome == OdeOutcome::finished));
  BOOST_TEST(result.steps == 100u);
  BOOST_TEST(worst < 1e-14);
  BOOST_TEST(worst_energy > 1e-9);  // else there is nothing to telescope
}

BOOST_AUTO_TEST_CASE(what_is_measured_on_the_way_changes_no_step) {
  Gas const gas{.scene_case = "hydro/piston-velocity", .discretisation = moved_by("leapfrog", usual_viscosity)};
  RunRecord const plain = run_well(gas, {Measure::profile, Measure::cost});
  RunRecord const watched = run_well(gas, {Measure::profile, Measure::cost, Measure::history});
  BOOST_TEST(watched.cost->rate_evaluations == plain.cost->rate_evaluations);
  BOOST_TEST((watched.profile->position == plain.profile->position));
  BOOST_TEST((watched.profile->computed.at("internal_energy") == plain.profile->computed.at("internal_energy")));
  // The last entry is the final state's, whose energy the budget has too.
  History const& history = *watched.history;
  RunRecord const budgets = run_well(gas, {Measure::conservation});
  BOOST_TEST(history.energy.back() == budgets.conservation.at("energy").final, tolerance(1e-14));
  BOOST_TEST(history.momentum.back() == budgets.momentum.at(0).final, tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(a_leapfrog_run_takes_the_usual_steps_and_reports_what_halving_them_changes) {
  Gas const gas{.scene_case = "hydro/piston-velocity",
                .resolution = 40,
                .discretisation = moved_by("leapfrog", usual_viscosity)};
  RunRecord const record = run_well(gas, {Measure::error, Measure::cost});
  BOOST_TEST(record.integration->method == "leapfrog");
  BOOST_TEST(record.integration->courant_factor.value() == 1.0);
  BOOST_TEST(!record.integration->relative_tolerance.has_value());
  BOOST_TEST(record.integration->time_error.value() > 0.0);
  BOOST_TEST(record.integration->time_error_share.value() > 0.0);
  std::uint64_t bound = 0;
  for (auto const& [limit, steps] : record.motion->steps_bound_by) bound += steps;
  BOOST_TEST(bound == record.cost->steps);
  BOOST_TEST(record.cost->rate_evaluations > 0u);
  BOOST_TEST(record.motion->smallest_step.value() <= record.motion->largest_step.value());
  // 0.3 h/c behind the shock, with viscosity's share.
  BOOST_TEST(record.motion->largest_step.value() < 0.3 * 1.2 / 40.0 / std::sqrt(5.0 / 3.0 * 0.5));
}

// ---- Shocks

std::vector<ShockRecord> shocks_of(Gas const& gas) { return run_well(gas, {Measure::error}).shocks; }

BOOST_AUTO_TEST_CASE(a_piston_of_prescribed_velocity_converges_at_about_first_order) {
  std::vector<double> errors, lags;
  for (int const n : {50, 100, 200, 400}) {
    Gas const gas{.scene_case = "hydro/piston-velocity",
                  .resolution = n,
                  .discretisation = moved_by("leapfrog", usual_viscosity)};
    RunRecord const record = run_well(gas, {Measure::error});
    errors.push_back(record.errors.at("velocity").at("all").error.l1);
    lags.push_back(record.shocks.at(0).position_error.value());
  }
  // A prototype that shares nothing with this project measured 4.4e-3 and 2.9e-3.
  BOOST_TEST(errors[2] == 4.1e-3, tolerance(0.02));
  BOOST_TEST(errors[3] == 2.9e-3, tolerance(0.02));
  double const order = std::log(errors[0] / errors[3]) / std::log(8.0);
  BOOST_TEST((order > 0.8 && order < 1.1), order);
  // At fixed h/dx the shock is late by a part of its way that does not shrink.
  BOOST_TEST(lags[2] == -0.008, tolerance(0.03));
  BOOST_TEST(lags[3] == lags[2], tolerance(0.03));
}

/// Stress of a lattice over its pressure: what a uniform lattice of spacing dx pushes across any point in a
/// symmetric form.
double lattice_stress(double smoothing_ratio) {
  double const dx = 0.01;
  double sum = 0.0;
  for (int k = 1; k * dx < 2.0 * smoothing_ratio * dx; ++k) {
    double const r = k * dx;
    sum -= 2.0 * dx * r * r * CubicSpline<1>::radial(r, smoothing_ratio * dx);
  }
  return sum;
}

BOOST_AUTO_TEST_CASE(a_lattice_pushes_with_its_pressure_but_for_a_factor_of_h_over_dx) {
  BOOST_TEST(lattice_stress(1.0) == 1.0, tolerance(1e-12));
  BOOST_TEST(lattice_stress(1.2) == 1.0224, tolerance(1e-4));
  BOOST_TEST(lattice_stress(1.8) == 0.9907, tolerance(1e-4));
  BOOST_TEST(lattice_stress(40.0) == 1.0, tolerance(1e-4));
}

// The shock moves h/dx from 1.2 to 1.8, and the stress from s(1.2) P0 to s(1.8) P1; it is the stress that
// balances the momentum that the shock takes up.
BOOST_AUTO_TEST_CASE(the_stress_of_the_lattices_explains_the_plateau_behind_a_piston_of_velocity) {
  double const u = std::sqrt(1.5) / 3.0;
  Gas gas{.scene_case = "hydro/piston-velocity",
          .resolution = 200,
          .discretisation = moved_by("leapfrog", usual_viscosity)};
  ShockRecord const late = shocks_of(gas).at(0);
  gas.parameters = {{"final_time", 0.25}};
  ShockRecord const early = shocks_of(gas).at(0);
  double const D = (late.position + *late.position_error - early.position - *early.position_error) / 0.25;
  double const P1 = 1.0 + late.plateau_pressure.value();
  double const taken_up = D * u;
  BOOST_TEST(lattice_stress(1.8) * P1 - lattice_stress(1.2) * 0.5 == taken_up, tolerance(0.005));
  BOOST_TEST(std::abs((P1 - 0.5) / taken_up - 1.0) > 0.03);
  BOOST_TEST(late.plateau_pressure.value() == 0.012, tolerance(0.1));
}

Gas pressed(int resolution, std::string const& closure) {
  Gas gas{.scene_case = "hydro/piston-pressure",
          .formulation = sqrt_p,
          .work = "work/sqrt-p",
          .resolution = resolution,
          .discretisation = moved_by("leapfrog", usual_viscosity, "normalised")};
  gas.discretisation.closure = closure;
  return gas;
}

BOOST_AUTO_TEST_CASE(a_prescribed_pressure_behind_a_wall_of_interpolated_velocity_drives_the_wrong_shock) {
  std::vector<double> plateaus;
  for (int const n : {100, 200}) {
    RunRecord const record = run_well(pressed(n, "interpolated"), {Measure::error, Measure::conservation});
    plateaus.push_back(record.shocks.at(0).plateau_pressure.value());
    BOOST_TEST((plateaus.back() > -0.5 && plateaus.back() < -0.4), plateaus.back());
    // What arrives is what the wall terms give, not what the wall prescribes; and the wall lags behind.
    WallBudget const& wall = record.wall_budgets.at(0);
    BOOST_TEST(wall.prescribed_impulse[0] == 0.5, tolerance(1e-12));
    BOOST_TEST(wall.impulse[0] / 0.5 == 1.0 + plateaus.back(), tolerance(0.03));
    BOOST_TEST(wall.position[0] < 0.1 * 0.5 * std::sqrt(1.5) / 3.0);
  }
  BOOST_TEST(plateaus[1] < plateaus[0]);
}

BOOST_AUTO_TEST_CASE(a_prescribed_pressure_behind_a_wall_of_one_sided_velocity_drives_the_right_shock) {
  for (int const n : {50, 100, 200}) {
    RunRecord const record = run_well(pressed(n, "one-sided"), {Measure::error, Measure::conservation});
    ShockRecord const& shock = record.shocks.at(0);
    BOOST_TEST(std::abs(shock.plateau_pressure.value()) < 0.03);
    BOOST_TEST(std::abs(shock.plateau_density.value()) < 0.03);
    BOOST_TEST(std::abs(shock.plateau_velocity.value()) < 0.01);
    BOOST_TEST(record.wall_budgets.at(0).position[0] == 0.5 * std::sqrt(1.5) / 3.0, tolerance(0.02));
    BOOST_TEST(record.wall_budgets[0].impulse[0] == 0.5, tolerance(0.02));
  }
}

// ---- Energy routes

BOOST_AUTO_TEST_CASE(energy_routes_are_how_far_two_runs_of_the_two_forms_part) {
  for (auto const& [scene_case, viscosity] :
       {std::pair<char const*, ViscosityChoice>{"hydro/manufactured", {}},
        {"hydro/piston-velocity", usual_viscosity}}) {
    Gas gas{.scene_case = scene_case, .resolution = 50, .discretisation = moved_by("leapfrog", viscosity)};
    std::vector<RunRecord> runs;
    for (char const* work : {"work/internal-energy", "work/total-energy"}) {
      gas.work = work;
      runs.push_back(run_well(gas, {Measure::energy_routes, Measure::profile}));
    }
    for (std::size_t const own : {0u, 1u}) {
      auto const& energies = runs[own].profile->computed.at("internal_energy");
      auto const& other = runs[1 - own].profile->computed.at("internal_energy");
      double apart = 0.0, size = 0.0;
      for (std::size_t i = 0; i < energies.size(); ++i) {
        double const volume = runs[own].profile->weight[i];
        apart += volume * (energies[i][0] - other[i][0]) * (energies[i][0] - other[i][0]);
        size += volume * other[i][0] * other[i][0];
      }
      BOOST_TEST_CONTEXT(scene_case << ", " << own) {
        BOOST_TEST(runs[own].motion->energy_routes.value() == std::sqrt(apart / size), tolerance(1e-9));
        BOOST_TEST((*runs[own].motion->energy_routes > 1e-9 && *runs[own].motion->energy_routes < 1e-3));
      }
    }
  }
  Gas const unasked{.scene_case = "hydro/manufactured", .discretisation = moved_by("leapfrog", {})};
  BOOST_TEST(!run_well(unasked, {Measure::error}).motion->energy_routes.has_value());
}

BOOST_AUTO_TEST_CASE(total_and_internal_energy_part_by_four_times_less_when_the_step_is_halved) {
  for (auto const& [scene_case, viscosity] :
       {std::pair<char const*, ViscosityChoice>{"hydro/manufactured", {}},
        {"hydro/piston-velocity", usual_viscosity}}) {
    double before = 0.0;
    // Usual steps hardly resolve how a particle passes a shock.
    double const longest = viscosity.alpha > 0.0 ? 0.125 : 1.0;
    for (double const factor : {longest, 0.5 * longest, 0.25 * longest}) {
      Gas gas{.scene_case = scene_case, .discretisation = moved_by("leapfrog", viscosity)};
      auto const internal = integrated(gas, "leapfrog", factor);
      gas.work = "work/total-energy";
      auto const total = integrated(gas, "leapfrog", factor);
      double const apart = root_mean_square(energies(*internal), energies(*total));
      if (before > 0.0) BOOST_TEST(before / apart == 4.0, tolerance(0.15));
      before = apart;
    }
  }
}

// ---- Statuses

BOOST_AUTO_TEST_CASE(a_density_that_turns_negative_is_a_lost_positivity_with_particle_and_time) {
  Gas const gas{.scene_case = "hydro/riemann",
                .resolution = 60,
                .discretisation = moved_by("leapfrog", usual_viscosity)};
  RunRecord const record = run(gas, {Measure::error, Measure::conservation, Measure::cost});
  BOOST_TEST(record.status == "positivity-lost");
  BOOST_TEST(record.reason.find("density of particle 30 is -") == 0u, record.reason);
  BOOST_TEST(record.reason.find(" at t = 0.01") != std::string::npos, record.reason);
  // Sod's gases are 8 to 1, and the trap is known.
  BOOST_TEST(record.reason.find("; masses differ by a factor of 8, ") != std::string::npos, record.reason);
  BOOST_TEST(record.errors.empty());
  BOOST_TEST(record.conservation.empty());
  BOOST_TEST(!record.cost.has_value());
  BOOST_TEST(!record.scene.passes.empty());
  BOOST_TEST(record.motion.has_value());
}

BOOST_AUTO_TEST_CASE(what_the_reason_says_to_take_instead_of_continuity_beside_unequal_masses_runs) {
  for (char const* density : {"normalised", "summation"}) {
    for (int const resolution : {60, 61}) {  // odd: one particle holds half of either gas
      Gas gas{.scene_case = "hydro/riemann", .resolution = resolution, .discretisation = moved_by("leapfrog", usual_viscosity, density)};
      gas.discretisation.smoothing = "adaptive";
      RunRecord const record = run_well(gas, {Measure::error});
      auto const& error = record.errors.at("density").at("all");
      BOOST_TEST(error.error.l1 < 0.06 * error.scale.l1);
    }
  }
  // Equal masses say nothing of the kind when they break.
  Gas const cold{.scene_case = "hydro/noh", .resolution = 40, .discretisation = moved_by("leapfrog", {})};
  BOOST_TEST(run(cold, {Measure::error}).reason.find("masses differ") == std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_pressure_that_turns_negative_is_a_lost_positivity_of_sqrt_p_alone) {
  // In cold gas total less kinetic energy may turn negative.
  Gas gas{.scene_case = "hydro/noh",
          .formulation = sqrt_p,
          .work = "work/total-energy",
          .resolution = 40,
          .discretisation = moved_by("leapfrog", usual_viscosity)};
  RunRecord const record = run(gas, {Measure::error});
  BOOST_TEST(record.status == "positivity-lost");
  BOOST_TEST(record.reason.find("negative pressure: particle ") != std::string::npos, record.reason);
  BOOST_TEST(record.reason.find(" at t = 0.00") != std::string::npos, record.reason);
  gas.formulation = p_rho2;
  BOOST_TEST(run(gas, {Measure::error}).status == "ok");
}

BOOST_AUTO_TEST_CASE(a_run_out_of_time_is_timed_out) {
  Gas const gas{.scene_case = "hydro/piston-velocity",
                .discretisation = moved_by("leapfrog", usual_viscosity)};
  for (char const* integrator : {"leapfrog", "runge-kutta"}) {
    Gas slow = gas;
    slow.discretisation.integrator = integrator;
    RunRecord const record = run(slow, {Measure::error}, 1e-9);
    BOOST_TEST(record.status == "timed-out");
    BOOST_TEST(record.reason.find("time budget of 1e-09 s spent at t = ") == 0u, record.reason);
    BOOST_TEST(record.errors.empty());
  }
}

/// The run with half the step takes twice as long as the one that it checks: a budget of twice the first holds that alone.
/// A busy machine may take longer for the first time, but not every time.
BOOST_AUTO_TEST_CASE(a_run_stands_whose_check_alone_is_out_of_time) {
  Gas const gas{.scene_case = "hydro/piston-velocity",
                .resolution = 200,
                .discretisation = moved_by("leapfrog", usual_viscosity)};
  RunRecord const whole = run(gas, {Measure::error});
  BOOST_TEST(whole.status == "ok");
  RunRecord found;
  for (int k = 0; k < 10 && (found.status != "ok" || found.integration->time_error); ++k) {
    double const once = run(gas, {Measure::cost}).cost->seconds;
    found = run(gas, {Measure::error}, 2.0 * once);
  }
  BOOST_TEST(found.status == "ok");
  BOOST_TEST(found.reason.empty());
  BOOST_TEST(!found.integration->time_error.has_value());
  BOOST_TEST(found.integration->remark.find("half the step") != std::string::npos, found.integration->remark);
  BOOST_TEST(found.integration->courant_factor.value() == whole.integration->courant_factor.value());
  BOOST_TEST(found.errors.at("density").at("all").error.l1 == whole.errors.at("density").at("all").error.l1);
}

BOOST_AUTO_TEST_CASE(an_interrupted_run_is_no_result) {
  std::atomic<bool> const interrupted{true};
  RunOptions options;
  options.interrupted = &interrupted;
  Gas const gas{.scene_case = "hydro/piston-velocity",
                .discretisation = moved_by("leapfrog", usual_viscosity)};
  for (char const* integrator : {"leapfrog", "runge-kutta"}) {
    Gas one = gas;
    one.discretisation.integrator = integrator;
    BOOST_CHECK_THROW(execute(spec_of(one), options), Interrupted);
  }
}

BOOST_AUTO_TEST_CASE(gas_that_runs_into_its_wall_is_unstable_and_the_reason_says_who_and_when) {
  // With summation density the pressure halves at a wall that prescribes all of it, and goes on to fall.
  for (char const* integrator : {"leapfrog", "runge-kutta"}) {
    Gas const gas{.scene_case = "hydro/uniform",
                  .resolution = 40,
                  .discretisation = moved_by(integrator, usual_viscosity, "summation")};
    RunRecord const record = run(gas, {Measure::error});
    BOOST_TEST(record.status == "unstable");
    BOOST_TEST(record.reason.find("particle ") != std::string::npos, record.reason);
    BOOST_TEST(record.reason.find("wall ") != std::string::npos, record.reason);
    BOOST_TEST(record.reason.find(" at t = 0.2") != std::string::npos, record.reason);
  }
  // Cold gas that nothing holds back.
  Gas const noh{.scene_case = "hydro/noh", .resolution = 40, .discretisation = moved_by("leapfrog", {})};
  RunRecord const record = run(noh, {Measure::error});
  BOOST_TEST(record.status == "unstable");
  BOOST_TEST(record.reason.find("closest to colliding: particle 0 and wall 0") != std::string::npos,
             record.reason);
}

struct Broken {
  std::string status, reason;
};

/// What is said of a state that differs from the initial one in a single unknown.
Broken broken(Gas const& gas, std::size_t unknown, double value) {
  MovingScene<1> scene(problem_of(gas), choice_of(gas));
  std::vector<double> state = scene.initial_state();
  state.at(unknown) = value;
  try {
    scene.evaluate(0.1, state.data());
  } catch (BrokenRun const& error) {
    return {error.status(), error.what()};
  }
  return {"ok", ""};
}

BOOST_AUTO_TEST_CASE(a_state_that_makes_no_sense_is_named_with_who_and_when) {
  Gas const gas{.scene_case = "hydro/piston-velocity",
                .resolution = 10,
                .discretisation = moved_by("leapfrog", {}),
                .parameters = {{"final_time", 0.25}}};
  auto const check = [&](std::size_t unknown, double value, char const* status, char const* reason) {
    Broken const found = broken(gas, unknown, value);
    BOOST_TEST(found.status == status);
    BOOST_TEST(found.reason == reason);
  };
  double const nan = std::numeric_limits<double>::quiet_NaN();
  // The piston is at 0.0408.
  check(0, 0.041, "ok", "");
  check(0, 0.16, "unstable", "particles 0 and 1 crossed at t = 0.1");
  check(0, 0.04, "unstable", "particle 0 overtook wall 0 at t = 0.1");
  check(9, 1.001, "unstable", "particle 9 overtook wall 1 at t = 0.1");
  check(3, nan, "non-finite", "position of particle 3 is not finite at t = 0.1");
  check(30, -0.5, "positivity-lost", "density of particle 0 is -0.5 at t = 0.1");
  check(31, nan, "non-finite", "density of particle 1 is nan at t = 0.1");
}

// Pressure, its work, heat conduction and moving walls at once, against a solution that is none of ours.
BOOST_AUTO_TEST_CASE(shock_that_conduction_smooths_converges_at_first_order) {
  std::vector<double> errors;
  for (int const resolution : {25, 50, 100}) {
    Discretisation d = moved_by("runge-kutta", {}, "normalised");
    d.closure = "one-sided";
    RunRecord const record = run_well({.scene_case = "coupled/conducting-shock",
                                       .conduction = "conduction/brookshaw",
                                       .resolution = resolution,
                                       .discretisation = d},
                                      {Measure::error});
    RegionError const& temperature = record.errors.at("temperature").at("all");
    errors.push_back(temperature.error.l2 / temperature.scale.l2);
  }
  BOOST_TEST(errors[0] < 6e-3);
  BOOST_TEST(errors[1] < 0.65 * errors[0]);
  BOOST_TEST(errors[2] < 0.65 * errors[1]);
}

BOOST_AUTO_TEST_CASE(hot_piston_gives_the_heat_that_fourier_says) {
  Discretisation d = moved_by("runge-kutta", {}, "normalised");
  d.closure = "one-sided";
  RunRecord const record = run_well({.scene_case = "coupled/hot-wall",
                                     .conduction = "conduction/brookshaw",
                                     .resolution = 100,
                                     .discretisation = d,
                                     .smoothing_ratio = 2.4},
                                    {Measure::error});
  BOOST_TEST_REQUIRE(record.wall_flux.size() == 2u);
  BOOST_TEST(record.wall_flux[0].exact > 0.05);
  BOOST_TEST(std::abs(record.wall_flux[0].error) < 0.01 * record.wall_flux[0].exact);
  BOOST_TEST(record.errors.at("temperature").at("all").error.l2 < 2e-3);
}

BOOST_AUTO_TEST_CASE(an_evaluation_is_counted_once_whatever_its_parts) {
  RunRecord const record = run_well(
      {.scene_case = "hydro/piston-velocity", .discretisation = moved_by("leapfrog", usual_viscosity)},
      {Measure::cost});
  // One a step, the first and the final state.
  BOOST_TEST(record.cost->rate_evaluations == record.cost->steps + 2);
}

BOOST_AUTO_TEST_SUITE_END()
