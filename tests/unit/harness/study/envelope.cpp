// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/envelope.hpp"

#include <boost/test/unit_test.hpp>
#include <stdexcept>

#include "tests/support/runs.hpp"

BOOST_AUTO_TEST_SUITE(harness_study_envelope)

using namespace sphverify;
using namespace sphverify::tests;
using boost::test_tools::tolerance;

/// Runs that hold up to a value of final_time.
struct Limit {
  double highest;
  int runs = 0;

  RunRecord operator()(RunSpec const& spec, int step) {
    BOOST_TEST(step == runs);
    ++runs;
    RunRecord record;
    double const value = spec.parameters.number("final_time");
    record.status = value <= highest ? "ok" : "unstable";
    if (value > highest) record.reason = "beyond";
    return record;
  }
};

EnvelopeChoice const linear{
    .parameter = "final_time", .from = 1.0, .to = 9.0, .logarithmic = false, .bisections = 5};

BOOST_AUTO_TEST_CASE(a_limit_is_bracketed_by_halving) {
  Limit limit{4.3};
  Envelope const found = find_envelope(make_spec({}), linear, std::ref(limit));
  BOOST_TEST(*found.held <= 4.3);
  BOOST_TEST(*found.failed > 4.3);
  BOOST_TEST(*found.failed - *found.held == 8.0 / 32.0, tolerance(1e-12));
  BOOST_TEST(limit.runs == 7);
  BOOST_TEST(limit.runs <= most_runs(linear));
  BOOST_TEST(found.points.size() == 7u);
  BOOST_TEST(found.status == "unstable");
  BOOST_TEST(found.reason == "beyond");
  BOOST_TEST(found.parameter == "final_time");
  BOOST_TEST(!found.parameters.contains("final_time"));
}

BOOST_AUTO_TEST_CASE(decades_are_halved_as_decades_and_either_way) {
  EnvelopeChoice choice{
      .parameter = "final_time", .from = 1e-8, .to = 1e8, .logarithmic = true, .bisections = 4};
  Limit limit{3.0};
  Envelope const found = find_envelope(make_spec({}), choice, std::ref(limit));
  BOOST_TEST(*found.held == 1.0, tolerance(1e-9));
  BOOST_TEST(*found.failed == 10.0, tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(what_never_fails_and_what_never_holds_take_no_halving) {
  Limit all{100.0};
  Envelope const held = find_envelope(make_spec({}), linear, std::ref(all));
  BOOST_TEST(*held.held == 9.0);
  BOOST_TEST(!held.failed.has_value());
  BOOST_TEST(held.status == "ok");
  BOOST_TEST(all.runs == 1);
  Limit none{0.0};
  Envelope const failed = find_envelope(make_spec({}), linear, std::ref(none));
  BOOST_TEST(!failed.held.has_value());
  BOOST_TEST(*failed.failed == 1.0);
  BOOST_TEST(none.runs == 2);
}

BOOST_AUTO_TEST_CASE(numbers_of_the_discretisation_can_be_driven_too) {
  RunSpec spec = make_spec({.discretisation = jittered_by(0.1, 1)});
  spec.smoothing_ratio = 2.4;  // a refined level: twice the nominal 1.2
  spec.discretisation.smoothing_ratio = 1.2;
  RunSpec const wider = with_value(spec, {.parameter = "smoothing_ratio"}, 3.0);
  BOOST_TEST(wider.discretisation.smoothing_ratio == 3.0);
  BOOST_TEST(wider.smoothing_ratio == 6.0, tolerance(1e-14));
  BOOST_TEST(with_value(spec, {.parameter = "amplitude"}, 0.4).discretisation.layout.amplitude == 0.4);
  BOOST_CHECK_THROW(with_value(make_spec({}), {.parameter = "amplitude"}, 0.4), std::invalid_argument);
  BOOST_CHECK_THROW(with_value(spec, {.parameter = "modes"}, 1.0), std::invalid_argument);
  BOOST_CHECK_THROW(with_value(spec, {.parameter = "colour"}, 1.0), std::invalid_argument);
  BOOST_CHECK_THROW(with_value(spec, {.parameter = "dimension"}, 2.0), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
