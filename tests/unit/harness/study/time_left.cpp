// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/time_left.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "cases/support/case.hpp"

BOOST_AUTO_TEST_SUITE(harness_study_time_left)

using namespace sphverify;
using boost::test_tools::tolerance;
using State = RunProgress::State;

BOOST_AUTO_TEST_CASE(runs_of_a_known_size_take_what_those_before_took) {
  // A cheap and a costly level: work says 4 to 1, the clock 9 to 1.
  std::vector<RunProgress> const runs{{0, 1.0, State::finished, 2.0},
                                      {0, 4.0, State::finished, 18.0},
                                      {0, 1.0, State::waiting},
                                      {0, 4.0, State::waiting},
                                      {0, 4.0, State::waiting}};
  BOOST_TEST(*seconds_left(runs, 1) == 38.0, tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(a_larger_run_than_any_yet_takes_more_by_its_work) {
  std::vector<RunProgress> const runs{
      {0, 1.0, State::finished, 0.5}, {0, 4.0, State::finished, 3.0}, {0, 16.0, State::waiting}};
  BOOST_TEST(*seconds_left(runs, 1) == 12.0, tolerance(1e-12));  // from the nearest, not from the first
}

BOOST_AUTO_TEST_CASE(a_kind_that_nothing_is_known_of_is_measured_by_all_others) {
  std::vector<RunProgress> const runs{
      {0, 2.0, State::finished, 1.0}, {1, 8.0, State::finished, 9.0}, {2, 3.0, State::waiting}};
  BOOST_TEST(*seconds_left(runs, 1) == 3.0, tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(a_run_under_way_has_only_its_rest_left_and_never_less_than_none) {
  std::vector<RunProgress> runs{{0, 1.0, State::finished, 10.0}, {0, 1.0, State::running, 4.0}};
  BOOST_TEST(*seconds_left(runs, 1) == 6.0, tolerance(1e-12));
  runs[1].seconds = 25.0;
  BOOST_TEST(*seconds_left(runs, 1) == 0.0);
}

BOOST_AUTO_TEST_CASE(runs_share_the_jobs_but_no_run_is_shared) {
  std::vector<RunProgress> runs{{0, 1.0, State::finished, 1.0},
                                {0, 1.0, State::waiting},
                                {0, 1.0, State::waiting},
                                {0, 2.0, State::waiting}};
  BOOST_TEST(*seconds_left(runs, 1) == 4.0, tolerance(1e-12));
  BOOST_TEST(*seconds_left(runs, 2) == 2.0, tolerance(1e-12));
  BOOST_TEST(*seconds_left(runs, 16) == 2.0, tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(without_a_finished_run_nothing_is_said) {
  BOOST_TEST(!seconds_left({}, 1).has_value());
  BOOST_TEST(!seconds_left({{0, 1.0, State::running, 5.0}}, 1).has_value());
  // One taken over from a journal tells no time.
  BOOST_TEST(!seconds_left({{0, 1.0, State::finished_before}, {0, 1.0, State::waiting}}, 1).has_value());
}

BOOST_AUTO_TEST_CASE(what_is_left_is_always_a_finite_time) {
  for (double const work : {0.0, 1e-300, 1.0, 1e300}) {
    for (double const seconds : {0.0, 1e-9, 1e6}) {
      std::vector<RunProgress> const runs{
          {0, 1.0, State::finished, seconds}, {0, work, State::waiting}, {1, work, State::running, 3.0}};
      for (int const at_a_time : {0, 1, 64}) {
        auto const left = seconds_left(runs, at_a_time);
        BOOST_TEST_REQUIRE(left.has_value());
        BOOST_TEST((std::isfinite(*left) && *left >= 0.0), work << " " << seconds << " " << *left);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(work_is_pairs_times_steps_in_every_dimension) {
  for (int const dimension : {1, 2, 3}) {
    Case const& slab = *find_case("conduction/slab-dirichlet");
    Parameters parameters(slab.info.parameters);
    parameters.set("dimension", static_cast<double>(dimension));
    AnyProblem const problem = slab.problem(parameters);
    double const coarse = estimated_work(problem, {"lattice"}, 20, 1.2);
    double const fine = estimated_work(problem, {"lattice"}, 40, 1.2);
    BOOST_TEST(fine / coarse == std::pow(2.0, dimension + 1), tolerance(1e-12));
    BOOST_TEST(estimated_work(problem, {"lattice"}, 20, 2.4) / coarse == std::pow(2.0, dimension),
               tolerance(1e-12));
  }
}

BOOST_AUTO_TEST_CASE(durations_are_told_in_a_unit_that_suits) {
  BOOST_TEST(duration_text(0.2) == "0 s");
  BOOST_TEST(duration_text(119.0) == "119 s");
  BOOST_TEST(duration_text(720.0) == "12 min");
  BOOST_TEST(duration_text(12240.0) == "3.4 h");
}

BOOST_AUTO_TEST_SUITE_END()
