// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/measure/series.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

BOOST_AUTO_TEST_SUITE(harness_measure_series)

using namespace sphverify;
using boost::test_tools::tolerance;

RunRecord run_at(int resolution, double error, double seconds = 0.0) {
  RunRecord run;
  run.case_id = "conduction/slab-dirichlet";
  run.formulation.id = run.label = "conduction/brookshaw";
  run.resolution = resolution;
  run.spacing = 1.0 / resolution;
  run.errors["temperature"]["all"] = {{0.5 * error, error, 2.0 * error}, {1.0, 2.0, 4.0}, 1e-15};
  if (seconds > 0.0) run.cost.emplace().seconds = seconds;
  return run;
}

RunRecord seeded(RunRecord run, std::uint64_t seed) {
  run.discretisation.layout = {"jittered", 0.1, seed};
  return run;
}

OrderEntry const* find(Series const& series, std::string const& norm) {
  for (OrderEntry const& entry : series.orders) {
    if (entry.field == "temperature" && entry.region == "all" && entry.norm == norm) return &entry;
  }
  return nullptr;
}

BOOST_AUTO_TEST_CASE(runs_that_differ_only_in_resolution_are_one_series_from_coarse_to_fine) {
  auto const all =
      build_series({run_at(100, 1e-4), run_at(25, 16e-4), run_at(200, 0.25e-4), run_at(50, 4e-4)});
  BOOST_TEST(all.size() == 1u);
  BOOST_TEST(all[0].runs.size() == 4u);
  OrderEntry const* const l2 = find(all[0], "l2");
  BOOST_TEST_REQUIRE(l2 != nullptr);
  BOOST_TEST(l2->levels[0].resolution == 25);
  BOOST_TEST(*l2->levels[2].error == 1e-4);
  BOOST_TEST(*l2->observed.order == 2.0, tolerance(1e-4));
  BOOST_TEST(l2->observed.verdict == "asymptotic");
  BOOST_TEST(!l2->levels[0].spread.has_value());
  BOOST_TEST(!l2->levels[0].seconds.has_value());
  BOOST_TEST(*find(all[0], "linf")->levels[0].error == 32e-4);
  BOOST_TEST(*find(all[0], "l1")->levels[0].error == 8e-4);
}

BOOST_AUTO_TEST_CASE(an_error_that_is_no_number_is_none) {
  for (double const wrong : std::initializer_list<double>{NAN, INFINITY}) {
    std::vector<RunRecord> runs{run_at(25, 16e-4, 1.0), run_at(50, 4e-4, 2.0), run_at(100, 1e-4, 4.0),
                                run_at(200, wrong, 8.0)};
    for (RunRecord& run : runs)
      run.errors["temperature"]["all"].mean = run.errors["temperature"]["all"].error.l2;
    Series const series = build_series(runs).at(0);
    OrderEntry const* const l2 = find(series, "l2");
    BOOST_TEST_REQUIRE(l2 != nullptr);
    BOOST_TEST(!l2->levels.back().error.has_value());
    BOOST_TEST(!l2->levels.back().mean.has_value());
    BOOST_TEST(l2->observed.verdict == "diverging", "as of a finest level that broke");
    for (TimeToError const& target : series.time_to_error)
      BOOST_TEST((!target.seconds || std::isfinite(*target.seconds)));
  }
}

BOOST_AUTO_TEST_CASE(the_order_is_taken_on_the_spacing_not_on_the_resolution) {
  std::vector<RunRecord> runs{run_at(25, 1.0), run_at(50, 1.0), run_at(100, 1.0)};
  for (RunRecord& run : runs) {
    run.spacing = std::pow(run.resolution, -0.5);
    run.errors["temperature"]["all"].error.l2 = 3.0 * run.spacing;
  }
  BOOST_TEST(*find(build_series(runs)[0], "l2")->observed.order == 1.0, tolerance(1e-4));
}

BOOST_AUTO_TEST_CASE(whatever_else_differs_makes_another_series) {
  RunRecord const one = run_at(25, 1.0);
  std::vector<RunRecord> runs{one};
  auto const add = [&](auto const& change) {
    RunRecord run = one;
    change(run);
    runs.push_back(run);
  };
  add([](RunRecord& r) { r.case_id = "conduction/slab-insulated"; });
  add([](RunRecord& r) { r.parameters["left"] = 2.0; });
  add([](RunRecord& r) { r.formulation.walls = false; });
  add([](RunRecord& r) { r.formulation.id = "conduction/lucy-flux"; });
  add([](RunRecord& r) { r.discretisation.density = "summation"; });
  add([](RunRecord& r) { r.discretisation.smoothing_ratio = 1.0; });
  add([](RunRecord& r) { r.discretisation.face_weight = "balanced"; });
  add([](RunRecord& r) { r.discretisation.closure = "one-sided"; });
  add([](RunRecord& r) { r.discretisation.integrator = "runge-kutta"; });
  add([](RunRecord& r) { r.discretisation.layout = {"jittered", 0.1, 1}; });
  add([](RunRecord& r) { r.discretisation.layout = {"jittered", 0.2, 1}; });
  add([](RunRecord& r) { r.smoothing_exponent = 0.5; });
  BOOST_TEST(build_series(runs).size() == runs.size());
  BOOST_TEST(build_series({}).empty());
}

BOOST_AUTO_TEST_CASE(seeds_are_replicates_of_a_level_with_their_mean_and_spread) {
  std::vector<RunRecord> runs;
  for (int const n : {25, 50, 100}) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed)
      runs.push_back(seeded(run_at(n, static_cast<double>(seed) / n, 0.1 * static_cast<double>(seed)), seed));
  }
  auto const all = build_series(runs);
  BOOST_TEST(all.size() == 1u);
  SeriesLevel const& level = find(all[0], "l2")->levels[1];
  BOOST_TEST(level.replicates == 3);
  BOOST_TEST(*level.error == 2.0 / 50.0, tolerance(1e-13));
  BOOST_TEST(*level.spread == 1.0 / 50.0, tolerance(1e-13));
  BOOST_TEST(*level.seconds == 0.2, tolerance(1e-13));
  for (Number const& p : find(all[0], "l2")->observed.pairwise) BOOST_TEST(*p == 1.0, tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(signed_means_targets_and_time_errors_reach_the_order) {
  std::vector<RunRecord> runs;
  double error = 8e-2;
  for (int const n : {25, 50, 100, 200}) {
    runs.push_back(run_at(n, error));
    runs.back().errors["temperature"]["all"].mean = n < 100 ? -0.5 * error : 0.5 * error;
    runs.back().integration.emplace().time_error_share = n == 50 ? 0.4 : 0.01;
    error *= 0.5;
  }
  OrderEntry const crossing = *find(build_series(runs)[0], "l2");
  BOOST_TEST(*crossing.levels[0].mean == -4e-2, tolerance(1e-12));
  BOOST_TEST(crossing.observed.reason.find("passes through zero between levels 2 and 3") !=
             std::string::npos);
  for (RunRecord& run : runs) run.errors["temperature"]["all"].mean.reset();
  OrderEntry const entry = *find(build_series(runs)[0], "l2");
  BOOST_TEST(entry.observed.reason.find("errors in time may be 40% of these") != std::string::npos);
  // The exact field's l2 norm is 2: 1% of it is the error at N = 100, 0.1% that at N = 1000.
  BOOST_TEST_REQUIRE(entry.observed.targets.size() == 2u);
  BOOST_TEST(*entry.observed.targets[0].relative == 0.01);
  BOOST_TEST(*entry.observed.targets[0].resolution == 100.0, tolerance(1e-3));
  BOOST_TEST(*entry.observed.targets[1].resolution == 1000.0, tolerance(1e-3));
}

BOOST_AUTO_TEST_CASE(a_level_has_the_mean_of_its_replicates_signed_means_if_all_have_one) {
  std::vector<RunRecord> runs{seeded(run_at(25, 0.1), 1), seeded(run_at(25, 0.1), 2)};
  runs[0].errors["temperature"]["all"].mean = -0.3;
  BOOST_TEST(!find(build_series(runs)[0], "l2")->levels[0].mean.has_value());
  runs[1].errors["temperature"]["all"].mean = 0.1;
  BOOST_TEST(*find(build_series(runs)[0], "l2")->levels[0].mean == -0.1, tolerance(1e-13));
}

BOOST_AUTO_TEST_CASE(a_level_of_which_a_replicate_failed_has_no_error) {
  std::vector<RunRecord> runs;
  for (int const n : {25, 50, 100}) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) runs.push_back(seeded(run_at(n, 1.0 / n), seed));
  }
  runs.back().status = "unstable";
  runs.back().errors.clear();
  OrderEntry const entry = *find(build_series(runs)[0], "l2");
  BOOST_TEST(!entry.levels[2].error.has_value());
  BOOST_TEST(entry.levels[2].replicates == 3);
  BOOST_TEST(entry.observed.verdict == "diverging");
  BOOST_TEST(*entry.levels[1].error == 1.0 / 50.0, tolerance(1e-13));
}

BOOST_AUTO_TEST_CASE(errors_of_a_run_that_did_not_end_well_do_not_count) {
  std::vector<RunRecord> runs{run_at(25, 1.0), run_at(50, 0.5), run_at(100, 0.25)};
  runs.back().status = "unstable";
  BOOST_TEST(find(build_series(runs)[0], "l2")->observed.verdict == "diverging");
}

// That we had no more time for it says nothing of the formulation.
BOOST_AUTO_TEST_CASE(a_finest_level_that_ran_out_of_time_is_not_refined_unless_one_of_it_broke) {
  std::vector<RunRecord> runs;
  for (int const n : {25, 50, 100}) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) runs.push_back(seeded(run_at(n, 1.0 / n), seed));
  }
  runs.back().errors.clear();
  for (char const* status : {"timed-out", "failed"}) {
    runs.back().status = status;
    OrderEntry const entry = *find(build_series(runs)[0], "l2");
    BOOST_TEST(entry.observed.verdict == "not-refined", status);
    BOOST_TEST(entry.observed.reason == "the finest level ran out of time, or its command failed");
    BOOST_TEST(!entry.levels[2].error.has_value());
  }
  runs[6].status = "unstable";
  runs[6].errors.clear();
  BOOST_TEST(find(build_series(runs)[0], "l2")->observed.verdict == "diverging");
}

BOOST_AUTO_TEST_CASE(a_ladder_of_which_every_run_failed_still_has_a_verdict) {
  std::vector<RunRecord> runs{run_at(25, 1.0), run_at(50, 0.5), run_at(100, 0.25)};
  for (RunRecord& run : runs) {
    run.status = "unstable";
    run.errors.clear();
  }
  auto const all = build_series(runs);
  BOOST_TEST_REQUIRE(!all[0].orders.empty());
  for (OrderEntry const& entry : all[0].orders) BOOST_TEST(entry.observed.verdict == "diverging");
}

BOOST_AUTO_TEST_CASE(round_off_of_the_runs_floors_the_ladder) {
  std::vector<RunRecord> runs{run_at(25, 1e-16), run_at(50, 2e-16), run_at(100, 1e-16)};
  for (RunRecord& run : runs) run.errors["temperature"]["all"].round_off = 1e-14;
  BOOST_TEST(find(build_series(runs)[0], "l2")->observed.verdict == "floored");
}

BOOST_AUTO_TEST_CASE(time_to_an_error_is_interpolated_in_logarithms) {
  // The l2 scale is 2: 10% is 0.2, 1% is 0.02, 0.1% is 0.002. Error goes as seconds^-1/2.
  auto const all = build_series(
      {run_at(25, 0.4, 1.0), run_at(50, 0.1, 16.0), run_at(100, 0.025, 256.0), run_at(200, 0.00625, 4096.0)});
  std::vector<TimeToError> l2;
  for (TimeToError const& t : all[0].time_to_error) {
    if (t.norm == "l2") l2.push_back(t);
  }
  BOOST_TEST_REQUIRE(l2.size() == 3u);
  BOOST_TEST(l2[0].relative == 0.1);
  BOOST_TEST(l2[0].error == 0.2, tolerance(1e-13));
  BOOST_TEST(*l2[0].seconds == 4.0, tolerance(1e-10));
  BOOST_TEST(*l2[1].seconds == 400.0, tolerance(1e-10));
  BOOST_TEST(!l2[2].seconds.has_value());
}

RunRecord within(RunRecord run, double low, double median, double high) {
  run.cost.emplace().seconds = low;
  run.cost->median = {median, low, high};
  return run;
}

TimeToError l2_time(std::vector<RunRecord> const& runs, double relative) {
  auto const all = build_series(runs);
  for (TimeToError const& t : all.at(0).time_to_error) {
    if (t.norm == "l2" && t.relative == relative) return t;
  }
  return {};
}

BOOST_AUTO_TEST_CASE(the_interval_of_a_time_to_an_error_is_interpolated_between_those_of_the_runs) {
  // 10% is 0.2, a third of the way from 0.4 to 0.05 in logarithms.
  std::vector<RunRecord> runs{within(run_at(25, 0.4), 0.5, 1.0, 2.0),
                              within(run_at(50, 0.05), 4.0, 8.0, 54.0)};
  TimeToError const t = l2_time(runs, 0.1);
  BOOST_TEST(*t.seconds == 0.5 * std::cbrt(4.0 / 0.5), tolerance(1e-12));
  BOOST_TEST(*t.median.median == 2.0, tolerance(1e-12));
  BOOST_TEST(*t.median.low == 1.0, tolerance(1e-12));
  BOOST_TEST(*t.median.high == 6.0, tolerance(1e-12));
  BOOST_TEST(!t.is_bound);
  BOOST_TEST(!l2_time(runs, 0.01).median.median.has_value(), "never reached");
  runs[0].cost->median.low.reset();
  BOOST_TEST(*l2_time(runs, 0.1).median.median == 2.0, tolerance(1e-12));
  BOOST_TEST(!l2_time(runs, 0.1).median.low.has_value(), "one end is not known");
}

BOOST_AUTO_TEST_CASE(a_bound_has_the_interval_of_its_run) {
  TimeToError const t =
      l2_time({within(run_at(25, 0.1), 0.5, 1.0, 2.0), within(run_at(50, 0.05), 4, 8, 16)}, 0.1);
  BOOST_TEST(t.is_bound);
  BOOST_TEST(*t.median.median == 1.0);
  BOOST_TEST(*t.median.low == 0.5);
  BOOST_TEST(*t.median.high == 2.0);
}

BOOST_AUTO_TEST_CASE(replicates_of_a_level_have_the_means_of_their_times_and_ends) {
  auto const all = build_series(
      {seeded(within(run_at(25, 0.1), 1.0, 2.0, 3.0), 1), seeded(within(run_at(25, 0.1), 3.0, 4.0, 9.0), 2)});
  SeriesLevel const& level = find(all[0], "l2")->levels[0];
  BOOST_TEST(*level.seconds == 2.0);
  BOOST_TEST(*level.median.median == 3.0);
  BOOST_TEST(*level.median.low == 2.0);
  BOOST_TEST(*level.median.high == 6.0);
}

BOOST_AUTO_TEST_CASE(an_error_reached_at_once_takes_the_time_of_the_coarsest_run) {
  auto const all = build_series({run_at(25, 0.1, 3.0), run_at(50, 0.05, 9.0), run_at(100, 0.0, 27.0)});
  for (TimeToError const& t : all[0].time_to_error) {
    if (t.norm == "l2" && t.relative == 0.1) BOOST_TEST(*t.seconds == 3.0);
    if (t.norm == "l2" && t.relative == 0.001) BOOST_TEST(*t.seconds == 27.0);
  }
}

BOOST_AUTO_TEST_CASE(without_timings_there_is_no_time_to_an_error) {
  BOOST_TEST(build_series({run_at(25, 0.1), run_at(50, 0.05)})[0].time_to_error.empty());
}

/// A ladder of a case by name, whose l1, l2 and linf errors all fall at one order.
std::vector<RunRecord> ladder_of(std::string const& case_id, double order,
                                 std::vector<int> const& resolutions) {
  std::vector<RunRecord> runs;
  for (int const n : resolutions) {
    runs.push_back(run_at(n, std::pow(n / 25.0, -order)));
    runs.back().case_id = case_id;
  }
  return runs;
}

/// The same with a jump in the region.
std::vector<RunRecord> ladder_with_jump(std::string const& case_id, double order,
                                        std::vector<int> const& resolutions) {
  auto runs = ladder_of(case_id, order, resolutions);
  for (RunRecord& run : runs) run.errors["temperature"]["all"].allowed = NormSet{1.0, 0.5, 0.0};
  return runs;
}

BOOST_AUTO_TEST_CASE(orders_are_judged_by_what_features_in_the_region_allow_not_by_the_case) {
  Series const jumps = build_series(ladder_with_jump("hydro/piston-velocity", 1.0, {25, 50, 100}))[0];
  BOOST_TEST(jumps.discontinuous);
  auto elsewhere = ladder_with_jump("hydro/piston-velocity", 1.0, {25, 50, 100});
  for (RunRecord& run : elsewhere) {
    run.errors["temperature"]["wall"] = run.errors["temperature"]["all"];
    run.errors["temperature"]["wall"].allowed.reset();
  }
  for (OrderEntry const& entry : build_series(elsewhere)[0].orders) {
    if (entry.region != "wall") continue;
    BOOST_TEST(entry.allowed == 2.0);
    BOOST_TEST(entry.observed.reason.find("jumps") == std::string::npos);
  }
  BOOST_TEST(find(jumps, "l1")->allowed == 1.0);
  BOOST_TEST(find(jumps, "l2")->allowed == 0.5);
  BOOST_TEST(find(jumps, "linf")->allowed == 0.0);
  for (char const* smooth_case : {"hydro/manufactured", "conduction/slab-dirichlet", "no/such-case"}) {
    Series const smooth = build_series(ladder_of(smooth_case, 1.0, {25, 50, 100}))[0];
    BOOST_TEST(!smooth.discontinuous);
    for (char const* norm : {"l1", "l2", "linf"}) BOOST_TEST(find(smooth, norm)->allowed == 2.0);
  }
}

BOOST_AUTO_TEST_CASE(the_largest_error_at_a_jump_is_floored_unless_it_diverges) {
  for (double const order : {1.0, 0.3, 0.0}) {
    Series const jumps = build_series(ladder_with_jump("hydro/noh", order, {25, 50, 100, 200}))[0];
    BOOST_TEST(find(jumps, "linf")->observed.verdict == "floored");
    BOOST_TEST(find(jumps, "linf")->observed.reason.find("the solution jumps") != std::string::npos);
    for (Number const& p : find(jumps, "linf")->observed.pairwise) BOOST_TEST(std::abs(*p - order) < 1e-9);
    Series const smooth = build_series(ladder_of("hydro/manufactured", order, {25, 50, 100, 200}))[0];
    BOOST_TEST(find(smooth, "linf")->observed.verdict == find(smooth, "l1")->observed.verdict);
    BOOST_TEST(find(jumps, "l1")->observed.verdict == find(smooth, "l1")->observed.verdict);
  }
  Series const grows = build_series(ladder_with_jump("hydro/noh", -1.0, {25, 50, 100}))[0];
  BOOST_TEST(find(grows, "linf")->observed.verdict == "diverging");
  auto broken = ladder_with_jump("hydro/noh", 1.0, {25, 50, 100});
  broken.back().status = "unstable";
  BOOST_TEST(find(build_series(broken)[0], "linf")->observed.verdict == "diverging");
}

BOOST_AUTO_TEST_CASE(a_first_order_error_in_l1_is_asymptotic_at_a_jump) {
  Series const jumps = build_series(ladder_with_jump("hydro/piston-velocity", 1.0, {25, 50, 100, 200}))[0];
  BOOST_TEST(find(jumps, "l1")->observed.verdict == "asymptotic");
  BOOST_TEST(*find(jumps, "l1")->observed.order == 1.0, tolerance(1e-4));
}

BOOST_AUTO_TEST_CASE(what_differs_in_how_a_gas_moves_makes_another_series) {
  RunRecord const one = run_at(25, 1.0);
  std::vector<RunRecord> runs{one};
  auto const add = [&](auto const& change) {
    RunRecord run = one;
    change(run);
    runs.push_back(run);
  };
  add([](RunRecord& r) { r.discretisation.viscosity = {1.0, 2.0}; });
  add([](RunRecord& r) { r.discretisation.viscosity = {1.0, 0.0}; });
  add([](RunRecord& r) { r.discretisation.smoothing = "adaptive"; });
  add([](RunRecord& r) { r.discretisation.wall_motion = "mass"; });
  add([](RunRecord& r) { r.formulation.work = "work/total-energy"; });
  add([](RunRecord& r) { r.formulation.conduction = "conduction/brookshaw"; });
  BOOST_TEST(build_series(runs).size() == runs.size());
}

BOOST_AUTO_TEST_CASE(a_moving_gas_of_which_every_run_failed_is_judged_by_its_velocity) {
  std::vector<RunRecord> runs = ladder_of("hydro/noh", 1.0, {25, 50, 100});
  for (RunRecord& run : runs) {
    run.formulation.id = "momentum/p-rho2";
    run.formulation.work = "work/internal-energy";  // what moves has one, whatever the form is called
    run.status = "positivity-lost";
    run.errors.clear();
  }
  auto const all = build_series(runs);
  BOOST_TEST_REQUIRE(all[0].orders.size() == 3u);
  for (OrderEntry const& entry : all[0].orders) {
    BOOST_TEST(entry.field == "velocity");
    BOOST_TEST(entry.observed.verdict == "diverging");
  }
}

BOOST_AUTO_TEST_SUITE_END()
