// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/agreement.hpp"

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(reports_agreement)

using namespace sphverify;
using boost::test_tools::tolerance;

RunRecord run() {
  RunRecord record;
  record.errors["temperature"]["all"] = {{1.0, 2.0, 3.0}, {1.0, 1.0, 1.0}, 0.0};
  record.errors["temperature"]["wall"] = {{1.0, 2.0, 4.0}, {1.0, 1.0, 1.0}, 0.0};
  record.conservation["energy"] = {1.0, 1.0, 0.0, 1e-17, {}, {}};
  record.cost.emplace().seconds = 0.5;
  record.cost->steps = 7;
  record.cost->rate_evaluations = 14;
  return record;
}

BOOST_AUTO_TEST_CASE(equal_numbers_agree_to_the_bit_whatever_the_times) {
  RunRecord now = run();
  now.cost->seconds = 99.0;
  now.cost->busy = 0.1;
  now.cost->repeats = 12;
  Agreement const found = agreement(run(), now);
  BOOST_TEST(found.numbers > 20u);
  BOOST_TEST(found.differing == 0u);
  BOOST_TEST(agreement_text(found) == "all " + std::to_string(found.numbers) + " agree to the bit");
}

BOOST_AUTO_TEST_CASE(the_error_that_moved_most_is_named) {
  RunRecord now = run();
  now.errors["temperature"]["all"].error.l1 = 1.0 + 1e-12;
  now.errors["temperature"]["wall"].error.linf = 5.0;
  Agreement const found = agreement(run(), now);
  BOOST_TEST(found.differing == 2u);
  BOOST_REQUIRE(found.worst_error.has_value());
  BOOST_TEST(found.worst_error->relative == 0.2, tolerance(1e-12));
  BOOST_TEST(agreement_text(found) ==
             "2 of " + std::to_string(found.numbers) +
                 " differ, of the errors most temperature wall linf: 2.0e-1 of it (4.0e0, now 5.0e0)");
}

BOOST_AUTO_TEST_CASE(what_differs_beside_the_errors_is_told_too) {
  RunRecord now = run();
  now.cost->steps = 8;
  Agreement const found = agreement(run(), now);
  BOOST_TEST(found.differing == 1u);
  BOOST_TEST(!found.worst_error.has_value());
  BOOST_TEST(agreement_text(found).ends_with("no error among them; the first is cost/steps"),
             agreement_text(found));
}

BOOST_AUTO_TEST_CASE(an_error_that_only_one_of_the_runs_has_differs_wholly) {
  RunRecord now = run();
  now.errors.clear();
  Agreement const found = agreement(run(), now);
  BOOST_REQUIRE(found.worst_error.has_value());
  BOOST_TEST(found.worst_error->relative == 1.0);
  BOOST_TEST(!found.worst_error->now.has_value());
  BOOST_TEST(agreement(now, run()).differing == found.differing);
}

BOOST_AUTO_TEST_SUITE_END()
