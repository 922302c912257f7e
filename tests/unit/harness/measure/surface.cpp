// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/measure/surface.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <random>

#include "harness/measure/surface_fit.hpp"
#include "harness/measure/surface_path.hpp"

BOOST_AUTO_TEST_SUITE(harness_measure_surface)

using namespace sphverify;

constexpr double coarsest = 25.0;
constexpr double finest = 400.0;
std::vector<int> const resolutions{25, 50, 100, 200, 400};
std::vector<double> const ratios{0.9, 1.05, 1.25, 1.5, 1.8, 2.15, 2.55, 3.05, 3.65};

/// A law whose two terms are equal at N = 100, h/dx = 1.8.
SurfaceLaw law_of(double p, double s, double t, double c) {
  SurfaceLaw law;
  law.unit = 1.0 / finest;
  law.smoothing_exponent = p;
  law.sampling_exponent = s;
  law.spacing_exponent = t;
  law.correlation = c;
  law.smoothing_coefficient = 1e-3 / std::pow(1.8 * 4.0, p);
  law.sampling_coefficient = 1e-3 * std::pow(1.8, s) / std::pow(4.0, t);
  return law;
}

SurfaceRange const range{coarsest, finest, 1.0 / finest, ratios.front(), ratios.back()};
CostLaw const cost{"pair_interactions", 10.0, 1.2, 1.1, 0.0};

/// The places of a law, with scatter in the logarithm: of each its own, and one that a resolution's have in
/// common.
ErrorSurface surface_of(SurfaceLaw const& law, double own, double in_common, unsigned seed) {
  std::mt19937_64 random(seed);
  auto const normal = [&] {  // the library's differs between libraries
    double sum = -6.0;
    for (int k = 0; k < 12; ++k) sum += static_cast<double>(random() >> 11) * 0x1p-53;
    return sum;
  };
  ErrorSurface surface;
  for (int const n : resolutions) {
    double const row = in_common * normal();
    for (double const ratio : ratios) {
      SurfaceCell cell;
      cell.resolution = n;
      cell.smoothing_ratio = ratio;
      cell.spacing = 1.0 / n;
      cell.error = surface_error(law, cell.spacing, ratio) * std::exp(own * normal() + row);
      cell.pair_interactions = surface_cost(cost, n, ratio);
      surface.cells.push_back(cell);
    }
  }
  return surface;
}

bool holds(Estimate const& e, double truth) { return e.lower && truth >= *e.lower && truth <= *e.upper; }

/// Where the law is least, from its derivative: p S (S + c Q) = s Q (Q + c S).
double best_ratio(SurfaceLaw const& law, double resolution) {
  double const p = law.smoothing_exponent, s = law.sampling_exponent, c = law.correlation;
  double const d = finest / resolution;
  double const terms = (-c * (p - s) + std::sqrt(c * c * (p - s) * (p - s) + 4.0 * p * s)) / (2.0 * p);
  return std::pow(
      terms * law.sampling_coefficient / law.smoothing_coefficient * std::pow(d, law.spacing_exponent - p),
      1.0 / (p + s));
}

BOOST_AUTO_TEST_CASE(a_law_is_least_and_walked_down_where_its_derivatives_say) {
  for (SurfaceLaw const& law : {law_of(2.0, 3.0, 0.0, 0.0), law_of(1.0, 3.5, -0.5, 1.0),
                                law_of(2.0, 4.0, -1.0, -0.4), law_of(2.0, 2.0, 0.3, 0.5)}) {
    SurfaceWalk const walk(law, range);
    BOOST_TEST(walk.best(100.0).ratio == best_ratio(law, 100.0), boost::test_tools::tolerance(1e-3));
    // Lagrange: with cost N^a r^b, P x^2 + c (P - R) x = R for x = S/Q, P = p (a + b), R = s a - t b.
    double const p = law.smoothing_exponent, s = law.sampling_exponent, t = law.spacing_exponent;
    double const a = cost.resolution_exponent, b = cost.ratio_exponent, c = law.correlation;
    double const left = p * (a + b), right = s * a - t * b;
    double const x =
        (-c * (left - right) + std::sqrt(c * c * std::pow(left - right, 2) + 4.0 * left * right)) /
        (2.0 * left);
    auto const path = walk.path(cost);
    BOOST_TEST_REQUIRE(path.size() > 20u);
    for (SurfacePlace const& place : path) {
      if (!place.edge.empty()) continue;
      double const d = finest / place.resolution;
      double const smoothing = law.smoothing_coefficient * std::pow(place.ratio * d, p);
      double const sampling = law.sampling_coefficient * std::pow(place.ratio, -s) * std::pow(d, t);
      BOOST_TEST(smoothing / sampling == x, boost::test_tools::tolerance(0.02));
      BOOST_TEST(surface_cost(cost, place.resolution, place.ratio) == place.cost,
                 boost::test_tools::tolerance(1e-6));
      auto const back = walk.cheapest(place.error, cost);
      BOOST_TEST_REQUIRE(back.has_value());
      BOOST_TEST(back->cost == place.cost, boost::test_tools::tolerance(2e-3));
    }
    auto const k = neighbour_exponent(path);
    BOOST_TEST_REQUIRE(k.has_value());
    if (path.back().edge.empty()) BOOST_TEST(*k == (p - t) / (p + s), boost::test_tools::tolerance(0.01));
  }
}

BOOST_AUTO_TEST_CASE(exact_surfaces_give_their_exponents_back) {
  for (auto const& [p, s, t, c] :
       {std::array{2.0, 3.0, 0.0, 0.0}, {1.0, 3.5, -0.5, 1.0}, {2.0, 4.0, -1.0, -0.4}}) {
    ErrorSurface surface = surface_of(law_of(p, s, t, c), 0.0, 0.0, 1);
    explain_surface(surface);
    BOOST_TEST_REQUIRE(surface.law.has_value());
    BOOST_TEST(*surface.misfit < 1e-3);
    BOOST_TEST(*surface.smoothing_exponent.value == p, boost::test_tools::tolerance(0.02));
    BOOST_TEST(*surface.sampling_exponent.value == s, boost::test_tools::tolerance(0.02));
    BOOST_TEST(*surface.spacing_exponent.value - t == 0.0, boost::test_tools::tolerance(0.02));
    BOOST_TEST(*surface.neighbour_exponent.value == (p - t) / (p + s), boost::test_tools::tolerance(0.02));
    // A law says more than it is told.
    BOOST_TEST(!surface.candidates.empty());
    for (SurfaceCandidate const& one : surface.candidates) {
      BOOST_TEST(one.parameters >= 2);
      BOOST_TEST(one.parameters < static_cast<int>(surface.cells.size()), one.model);
    }
    // What stands beside the path belongs together: at its place the law says its error and its cost.
    BOOST_TEST_REQUIRE(!surface.paths.empty());
    for (SurfacePath const& path : surface.paths) {
      BOOST_TEST_REQUIRE(path.points.size() > 3u);
      for (PathPoint const& point : path.points) {
        double const spacing = 1.0 / point.resolution;
        BOOST_TEST(surface_error(*surface.law, spacing, *point.ratio.value) == point.error,
                   boost::test_tools::tolerance(1e-6));
        BOOST_TEST(surface_cost(path.cost, point.resolution, *point.ratio.value) == point.cost,
                   boost::test_tools::tolerance(1e-6));
      }
      BOOST_TEST_REQUIRE(path.rules.size() == 2u);
      BOOST_TEST(path.rules[0].exponent == 0.0);
      BOOST_TEST(path.rules[1].exponent == 0.5);
    }
  }
}

BOOST_AUTO_TEST_CASE(intervals_hold_the_truth_as_often_as_they_say) {
  int best = 0, best_held = 0, exponents = 0, exponents_held = 0;
  for (auto const& [law, own, in_common] : {std::tuple{law_of(2.0, 3.0, 0.0, 0.0), 0.05, 0.0},
                                            {law_of(1.0, 3.5, -0.5, 1.0), 0.2, 0.0},
                                            {law_of(2.0, 4.0, -1.0, -0.4), 0.05, 0.15}}) {
    for (unsigned seed = 1; seed <= 15; ++seed) {
      ErrorSurface surface = surface_of(law, own, in_common, seed);
      explain_surface(surface);
      BOOST_TEST_REQUIRE(surface.law.has_value());
      for (BestRatio const& entry : surface.best) {
        ++best;
        best_held +=
            holds(entry.ratio, std::clamp(best_ratio(law, entry.resolution), ratios.front(), ratios.back()));
      }
      double const k =
          (law.smoothing_exponent - law.spacing_exponent) / (law.smoothing_exponent + law.sampling_exponent);
      ++exponents;
      exponents_held += holds(surface.neighbour_exponent, k);
    }
  }
  // 95% of 45 surfaces, less two standard deviations of such a count.
  BOOST_TEST_MESSAGE("best " << best_held << "/" << best << ", exponent " << exponents_held << "/"
                             << exponents);
  BOOST_TEST(best_held >= 0.885 * best);
  BOOST_TEST(exponents_held >= 0.885 * exponents);
}

BOOST_AUTO_TEST_CASE(sampling_errors_that_oscillate_are_taken_ratio_by_ratio) {
  SurfaceLaw law = law_of(2.0, 3.0, 0.0, 0.0);
  for (double const ratio : ratios)
    law.sampling.push_back(
        {ratio, law.sampling_coefficient * std::pow(ratio, -3.0) * std::exp(0.9 * std::sin(5.3 * ratio))});
  ErrorSurface surface = surface_of(law, 0.05, 0.0, 3);
  explain_surface(surface);
  BOOST_TEST_REQUIRE(surface.law.has_value());
  BOOST_TEST(surface.law->sampling.size() == ratios.size());
  BOOST_TEST(surface.model.find("by ratio") != std::string::npos);
  SurfaceWalk const truth(law, range);
  for (BestRatio const& entry : surface.best)
    BOOST_TEST(holds(entry.ratio, truth.best(entry.resolution).ratio));
}

BOOST_AUTO_TEST_CASE(an_error_of_one_term_is_best_at_an_end_of_the_grid_and_has_no_exponent) {
  SurfaceLaw smoothing = law_of(2.0, 3.0, 0.0, 0.0);
  smoothing.sampling_coefficient = 0.0;
  ErrorSurface surface = surface_of(smoothing, 0.05, 0.0, 1);
  explain_surface(surface);
  BOOST_TEST(surface.best.back().edge == "lower");
  BOOST_TEST(*surface.best.back().ratio.value == ratios.front());
  SurfaceLaw sampling = law_of(2.0, 3.0, 0.0, 0.0);
  sampling.smoothing_coefficient = 0.0;
  surface = surface_of(sampling, 0.05, 0.0, 1);
  explain_surface(surface);
  BOOST_TEST(surface.best.back().edge == "upper");
  BOOST_TEST(!surface.neighbour_exponent.value.has_value());
}

BOOST_AUTO_TEST_CASE(what_no_law_explains_gets_the_grid_and_a_reason_only) {
  ErrorSurface surface = surface_of(law_of(2.0, 3.0, 0.0, 0.0), 1.2, 0.0, 5);
  explain_surface(surface);
  BOOST_TEST(!surface.law.has_value());
  BOOST_TEST(surface.model.empty());
  BOOST_TEST(surface.reason.starts_with("no law: "));
  BOOST_TEST(surface.paths.empty());
  BOOST_TEST(surface.best.size() == resolutions.size());
  for (BestRatio const& entry : surface.best) {
    BOOST_TEST(!entry.ratio.value.has_value());
    BOOST_TEST(entry.grid_ratio.has_value());
  }
}

BOOST_AUTO_TEST_CASE(rows_and_columns_whose_runs_all_failed_are_no_part_of_the_grid) {
  ErrorSurface surface = surface_of(law_of(2.0, 3.0, 0.0, 0.0), 0.02, 0.0, 1);
  for (SurfaceCell& cell : surface.cells) {
    if (cell.resolution < 400 && cell.smoothing_ratio < 3.6) continue;
    cell.error.reset();
    cell.pair_interactions.reset();
  }
  explain_surface(surface);
  BOOST_TEST_REQUIRE(surface.law.has_value());
  BOOST_TEST(surface.best.size() == resolutions.size() - 1);
  BOOST_TEST(surface.best.back().resolution == 200);
  BOOST_TEST_REQUIRE(!surface.paths.empty());
  for (SurfacePath const& path : surface.paths) {
    for (PathPoint const& point : path.points) BOOST_TEST(point.resolution <= 200.0 * (1.0 + 1e-9));
    for (PathRule const& rule : path.rules) BOOST_TEST(rule.resolution <= 200.0);
  }
  SurfaceLaw sampling = law_of(2.0, 3.0, 0.0, 0.0);
  sampling.smoothing_coefficient = 0.0;
  ErrorSurface falling = surface_of(sampling, 0.02, 0.0, 1);
  for (SurfaceCell& cell : falling.cells) {
    if (cell.smoothing_ratio > 3.6) cell.error.reset();
  }
  explain_surface(falling);
  BOOST_TEST(*falling.best.back().ratio.value == 3.05, boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(too_few_places_with_an_error_get_no_law) {
  ErrorSurface surface = surface_of(law_of(2.0, 3.0, 0.0, 0.0), 0.0, 0.0, 1);
  for (SurfaceCell& cell : surface.cells) {
    if (cell.resolution > 50) cell.error.reset();
  }
  explain_surface(surface);
  BOOST_TEST(!surface.law.has_value());
  BOOST_TEST(surface.reason == "18 of 45 places have an error: too few for a law");
}

BOOST_AUTO_TEST_CASE(a_rule_costs_what_the_law_says) {
  SurfaceLaw const law = law_of(2.0, 3.0, 0.0, 0.0);
  SurfaceWalk const walk(law, range);
  SurfacePlace const start = walk.path(cost, 1).front();
  double const k = 2.0 / 5.0;
  PathRule const own = follow_rule(k, walk, start, cost, range);
  BOOST_TEST(*own.error_ratio.value == 1.0, boost::test_tools::tolerance(2e-3));
  BOOST_TEST(*own.cost_ratio.value == 1.0, boost::test_tools::tolerance(5e-3));
  PathRule const kept = follow_rule(0.0, walk, start, cost, range);
  BOOST_TEST(kept.resolution == finest);
  BOOST_TEST(kept.ratio == start.ratio);
  BOOST_TEST(kept.remark != "h/dx reaches the grid's end there");
  BOOST_TEST(*kept.error_ratio.value > 2.0);
  // Both ratios from their definition.
  double const spent = surface_cost(cost, finest, start.ratio);
  BOOST_TEST(kept.error == walk.error(finest, start.ratio));
  BOOST_TEST(*kept.error_ratio.value == kept.error / walk.best_for(spent, cost).error,
             boost::test_tools::tolerance(1e-9));
  double const cheap = spent / *kept.cost_ratio.value;
  BOOST_TEST(walk.best_for(cheap, cost).error == kept.error, boost::test_tools::tolerance(2e-3));
  PathRule const steep = follow_rule(2.0, walk, start, cost, range);
  BOOST_TEST(steep.ratio == range.highest, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(steep.remark == "h/dx reaches the grid's end there");
}

BOOST_AUTO_TEST_CASE(costs_are_fitted_by_powers_and_those_that_scatter_refused) {
  std::vector<CostDatum> data;
  for (int const n : resolutions) {
    for (double const ratio : ratios)
      data.push_back({static_cast<double>(n), ratio, 7.0 * std::pow(n, 2.1) / ratio});
  }
  auto const law = fit_cost("seconds", data);
  BOOST_TEST_REQUIRE(law.has_value());
  BOOST_TEST(law->resolution_exponent == 2.1, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(law->ratio_exponent == -1.0, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(law->coefficient == 7.0, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(law->misfit < 1e-9);
  BOOST_TEST(!fit_cost("seconds", {data.begin(), data.begin() + 9}).has_value());

  ErrorSurface surface = surface_of(law_of(2.0, 3.0, 0.0, 0.0), 0.02, 0.0, 1);
  for (std::size_t k = 0; k < surface.cells.size(); ++k)
    surface.cells[k].seconds = surface.cells[k].resolution * (k % 2 == 0 ? 1.0 : 5.0);
  explain_surface(surface);
  BOOST_TEST_REQUIRE(surface.paths.size() == 2u);
  BOOST_TEST(surface.paths[0].cost.unit == "pair_interactions");
  BOOST_TEST(!surface.paths[0].points.empty());
  BOOST_TEST(surface.paths[1].points.empty());
  BOOST_TEST(surface.paths[1].reason.starts_with("no law of cost: "));
}

/// A run whose error is a given one in l2 and another in l1.
RunRecord run_of(int resolution, double ratio, std::uint64_t seed, double error) {
  RunRecord run;
  run.case_id = "conduction/slab-dirichlet";
  run.label = "conduction/brookshaw";
  run.formulation.id = "conduction/brookshaw";
  run.resolution = resolution;
  run.particles = static_cast<std::size_t>(resolution);
  run.spacing = 1.0 / resolution;
  run.discretisation.smoothing_ratio = ratio;
  run.discretisation.layout = {"jittered", 0.1, seed};
  run.errors["temperature"]["all"] = {{0.5 * error, error, 2.0 * error}, {1.0, 1.0, 1.0}, 1e-14};
  run.cost.emplace().pair_interactions = 100;
  run.cost->seconds = 0.5;
  return run;
}

BOOST_AUTO_TEST_CASE(runs_are_grouped_over_resolution_ratio_and_seed) {
  std::vector<RunRecord> runs;
  for (int const n : {10, 20, 40}) {
    for (double const ratio : {1.0, 1.5, 2.0}) {
      for (std::uint64_t const seed : {1u, 2u})
        runs.push_back(run_of(n, ratio, seed, 0.1 * static_cast<double>(seed) / n));
    }
  }
  auto const is_first = [](RunRecord const& run) {
    return run.resolution == 10 && run.discretisation.smoothing_ratio == 1.0;
  };
  for (RunRecord& run : runs) {
    if (is_first(run) && run.discretisation.layout.seed == 2) run.status = "unstable";
  }
  auto const surfaces = build_surfaces(runs);
  BOOST_TEST_REQUIRE(surfaces.size() == 1u);
  ErrorSurface const& surface = surfaces[0].error;
  BOOST_TEST((surface.field == "temperature" && surface.norm == "l2" && surface.region == "all"));
  BOOST_TEST_REQUIRE(surface.cells.size() == 9u);
  BOOST_TEST(!surface.cells[0].error.has_value(), "one of its seeds failed");
  SurfaceCell const& cell = surface.cells[4];
  BOOST_TEST((cell.resolution == 20 && cell.smoothing_ratio == 1.5 && cell.replicates == 2));
  BOOST_TEST(*cell.error == 0.0075, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(*cell.spread == 0.005 / std::sqrt(2.0), boost::test_tools::tolerance(1e-12));
  BOOST_TEST((*cell.pair_interactions == 100.0 && *cell.seconds == 0.5 && cell.particles == 20.0));

  for (RunRecord& run : runs) run.cost->cpu_seconds = 0.25;
  BOOST_TEST(*build_surfaces(runs)[0].error.cells[4].seconds == 0.25, "processor time where there is one");

  // Another formulation, walls or layout are a surface of their own; a path of refinement is none.
  std::vector<RunRecord> others = runs;
  for (RunRecord run : runs) {
    run.formulation.walls = false;
    others.push_back(run);
    run.formulation.walls = true;
    run.smoothing_exponent = 0.5;
    others.push_back(run);
  }
  BOOST_TEST(build_surfaces(others).size() == 2u);
}

BOOST_AUTO_TEST_CASE(small_grids_have_no_surface) {
  std::vector<RunRecord> runs;
  for (int const n : {10, 20, 40}) {
    for (double const ratio : {1.0, 1.5}) runs.push_back(run_of(n, ratio, 1, 0.1));
  }
  BOOST_TEST(build_surfaces(runs).empty());
}

BOOST_AUTO_TEST_SUITE_END()
