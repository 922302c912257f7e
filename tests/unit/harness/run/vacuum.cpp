// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "tests/support/runs.hpp"

BOOST_AUTO_TEST_SUITE(harness_run_vacuum)

using namespace sphverify;
using namespace sphverify::tests;

RunRecord released(std::string const& formulation, std::string const& work, std::string const& closure,
                   std::string const& smoothing) {
  Discretisation d;
  d.density = "normalised";
  d.closure = closure;
  d.smoothing = smoothing;
  RunSpec spec = make_spec({.scene_case = "hydro/vacuum-release",
                            .formulation = formulation,
                            .resolution = 30,
                            .discretisation = d});
  spec.formulation.work = work;
  RunOptions options;
  options.measure = {Measure::error, Measure::conservation};
  return execute(spec, options);
}

// The wall runs ahead at the speed of escape, out of the reach of every particle after 1.9 dx of its way.
BOOST_AUTO_TEST_CASE(a_wall_that_outruns_its_gas_neither_stops_nor_stops_the_run) {
  for (auto const& [formulation, work] :
       {std::pair<char const*, char const*>{"momentum/p-rho2", "work/internal-energy"},
        {"momentum/sqrt-p", "work/sqrt-p"}}) {
    for (char const* smoothing : {"uniform", "adaptive"}) {
      RunRecord const record = released(formulation, work, "one-sided", smoothing);
      BOOST_TEST_REQUIRE(record.status == "ok", formulation << " " << smoothing << ": " << record.reason);
      // The front is at 1 + 3 t; the gas that the wall goes by is hotter than the exact one there.
      double const wall = record.wall_budgets.at(1).position.at(0);
      BOOST_TEST((wall > 2.5 && wall < 3.2), wall);
      BOOST_TEST(std::abs(record.conservation.at("energy").pair_drift.value()) < 1e-13);
      // Nothing is out there to push or to work on.
      BOOST_TEST(record.wall_budgets[1].prescribed_impulse.at(0) == 0.0);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
