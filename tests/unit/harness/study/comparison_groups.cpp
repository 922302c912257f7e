// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/comparison_groups.hpp"

#include <boost/test/unit_test.hpp>

#include "tests/support/runs.hpp"

BOOST_AUTO_TEST_SUITE(harness_study_comparison_groups)

using namespace sphverify;
using namespace sphverify::tests;

BOOST_AUTO_TEST_CASE(runs_that_differ_in_the_formulation_alone_are_a_group) {
  RunSpec const spec = make_spec({});
  std::vector<RunSpec> runs{spec, make_spec({.formulation = "conduction/lucy-flux"}),
                            make_spec({.walls = false})};
  auto const beside = [&](auto const& change) {
    runs.push_back(spec);
    change(runs.back());
  };
  beside([](RunSpec& other) { other.formulation.conduction = "a partner"; });
  beside([](RunSpec& other) { other.resolution = 50; });
  beside([](RunSpec& other) { other.parameters.set("final_time", 0.5); });
  beside([](RunSpec& other) { other.discretisation.layout = {"jittered", 0.1, 1}; });
  beside([](RunSpec& other) { other.discretisation.layout = {"jittered", 0.1, 2}; });
  beside([](RunSpec& other) { other.smoothing_exponent = 0.5; });
  beside([](RunSpec& other) { other.scene_case = find_case("conduction/slab-flux"); });
  beside([](RunSpec&) {});
  BOOST_TEST((comparison_groups(runs) == std::vector<std::size_t>{0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 0}));
  BOOST_TEST(comparison_groups({}).empty());
}

BOOST_AUTO_TEST_SUITE_END()
