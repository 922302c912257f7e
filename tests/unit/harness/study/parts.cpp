// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/parts.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <map>

#include "harness/study/expected_work.hpp"
#include "reports/user_error.hpp"
#include "tests/support/runs.hpp"

BOOST_AUTO_TEST_SUITE(harness_study_parts)

using namespace sphverify;
using namespace sphverify::tests;

/// Ladders of some forms, in the order of a study: the forms outside.
std::vector<RunSpec> ladders(std::vector<char const*> const& forms, std::vector<int> const& resolutions) {
  std::vector<RunSpec> all;
  for (char const* form : forms) {
    for (int const resolution : resolutions) {
      RunChoice choice;
      choice.formulation = form;
      choice.resolution = resolution;
      all.push_back(make_spec(choice));
    }
  }
  return all;
}

std::vector<std::vector<std::size_t>> all_parts(Study const& study, std::vector<RunSpec> const& runs, int count) {
  std::vector<std::vector<std::size_t>> parts;
  for (int k = 1; k <= count; ++k) parts.push_back(runs_of_part(study, runs, {k, count}));
  return parts;
}

BOOST_AUTO_TEST_CASE(every_run_is_in_one_part_and_parts_differ_by_less_than_the_longest_run) {
  auto const runs = ladders({"conduction/brookshaw", "conduction/lucy-flux", "conduction/campbell-flux"}, {10, 20, 30, 40, 50, 60, 80});
  auto const work = expected_work(runs);
  double longest = 0.0;
  for (auto const& run : work) longest = std::max(longest, run.work);
  for (int const count : {1, 2, 3, 5, 21, 40}) {
    std::vector<int> times(runs.size(), 0);
    double most = 0.0, least = 1e300;
    for (auto const& part : all_parts({}, runs, count)) {
      BOOST_TEST(std::is_sorted(part.begin(), part.end()));
      double sum = 0.0;
      for (std::size_t const k : part) {
        ++times[k];
        sum += work[k].work;
      }
      most = std::max(most, sum);
      least = std::min(least, sum);
    }
    BOOST_TEST((times == std::vector<int>(runs.size(), 1)));
    BOOST_TEST(most - least <= longest * (1.0 + 1e-12), count << " parts");
  }
}

/// A form may take ten times as long as another at the same work.
BOOST_AUTO_TEST_CASE(each_ladder_is_spread_over_the_parts) {
  auto const runs = ladders({"conduction/brookshaw", "conduction/lucy-flux"}, {20, 40, 41, 80});
  for (auto const& part : all_parts({}, runs, 2)) {
    std::map<std::string, std::vector<int>> levels;
    for (std::size_t const k : part) levels[runs[k].formulation.id].push_back(runs[k].resolution);
    for (auto const& [form, resolutions] : levels) {
      bool const has_finest = std::find(resolutions.begin(), resolutions.end(), 80) != resolutions.end();
      BOOST_TEST((resolutions == (has_finest ? std::vector<int>{80} : std::vector<int>{20, 40, 41})));
    }
    BOOST_TEST(levels.size() == 2u);
  }
  // The finest of one and the finest of the other are in different parts.
  auto const first = runs_of_part({}, runs, {1, 2});
  BOOST_TEST((std::count(first.begin(), first.end(), 3u) + std::count(first.begin(), first.end(), 7u)) == 1);
  // One long run of one form leaves the other's ladder spread all the same.
  auto unequal = ladders({"conduction/brookshaw"}, {80});
  for (RunSpec const& run : ladders({"conduction/lucy-flux"}, {20, 24, 28})) unequal.push_back(run);
  BOOST_TEST((all_parts({}, unequal, 2) == std::vector<std::vector<std::size_t>>{{0, 1, 2}, {3}}));
}

BOOST_AUTO_TEST_CASE(runs_that_take_turns_stay_together) {
  auto const runs = ladders({"conduction/brookshaw", "conduction/lucy-flux"}, {20, 40, 60});
  Study study;
  study.measure = {Measure::cost};
  study.repeat = {.most = 3, .least = 3, .spread = 0.0, .seconds = 0.0};
  for (auto const& part : all_parts(study, runs, 3)) {
    BOOST_TEST(part.size() == 2u);
    BOOST_TEST(part.back() - part.front() == 3u, "the same resolution of the other form");
  }
  study.repeat.most = 1;
  std::size_t apart = 0;
  for (auto const& part : all_parts(study, runs, 3)) apart += part.size() != 2u || part.back() - part.front() != 3u;
  BOOST_TEST(apart > 0u, "what is timed once takes no turns");
}

BOOST_AUTO_TEST_CASE(a_part_is_a_number_and_how_many_there_are) {
  Part const part = read_part("12/300");
  BOOST_TEST(part.number == 12);
  BOOST_TEST(part.of == 300);
  for (char const* words : {"0/4", "5/4", "1/0", "1/", "/1", "1", "", " 1/2", "1/2 ", "1/2/3", "+1/2", "1/1000001"})
    BOOST_CHECK_THROW(read_part(words), UserError);
}

BOOST_AUTO_TEST_SUITE_END()
