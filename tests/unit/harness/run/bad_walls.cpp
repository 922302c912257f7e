// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "cases/hydro/gas_problem.hpp"
#include "tests/support/runs.hpp"

BOOST_AUTO_TEST_SUITE(harness_run_bad_walls)

using namespace sphverify;
using namespace sphverify::tests;

/// Gas at rest between 0 and 1, of which the left wall does what it likes.
template <class Left>
struct Driven {
  static CaseInfo info() {
    CaseInfo info{};
    info.id = "hydro/driven";
    info.kind = CaseKind::hydro;
    info.parameters = {{"final_time", "s", "end of the run", 0.3}};
    info.discontinuous = true;
    return info;
  }
  static AnyProblem problem(Parameters const& p) {
    exact::GasState const rest{1.0, 0.0, 0.6};
    Problem<1> problem = gas_problem([rest](double, double) { return rest; }, slab<1>(0.0, 1.0), 5.0 / 3.0);
    Left::prescribe(problem.walls[0]);
    prescribe_velocity(problem.walls[1], 0.0);
    problem.final_time = p.number("final_time");
    return problem;
  }
};

struct Rams {  // twenty times as fast as sound
  static void prescribe(Wall<1>& wall) { prescribe_velocity(wall, 20.0); }
};
struct Leaps {
  static void prescribe(Wall<1>& wall) {
    prescribe_motion(
        wall, [](double t) { return t > 0.1 ? 0.3 : 0.0; }, [](double) { return 0.0; });
  }
};
struct Leaves {  // a hundred times as fast
  static void prescribe(Wall<1>& wall) { prescribe_velocity(wall, -100.0); }
};
struct Stops {
  static void prescribe(Wall<1>& wall) {
    prescribe_motion(
        wall, [](double t) { return 0.8 * std::min(t, 0.1); }, [](double t) { return t < 0.1 ? 0.8 : 0.0; });
  }
};
struct Pulls {
  static void prescribe(Wall<1>& wall) { prescribe_pressure(wall, -0.3); }
};
struct IsNoNumber {
  static void prescribe(Wall<1>& wall) { prescribe_pressure(wall, std::nan("")); }
};

struct Choice {
  std::string formulation = "momentum/p-rho2", density = "continuity", closure = "interpolated",
              smoothing = "uniform";
};
std::ostream& operator<<(std::ostream& out, Choice const& c) {
  return out << c.formulation << " " << c.density << " " << c.closure << " " << c.smoothing;
}

std::vector<Choice> choices() {
  std::vector<Choice> all;
  for (char const* formulation : {"momentum/p-rho2", "momentum/sqrt-p"})
    for (char const* density : {"continuity", "normalised", "summation"})
      for (char const* closure : {"interpolated", "one-sided"})
        for (char const* smoothing : {"uniform", "adaptive"})
          all.push_back({formulation, density, closure, smoothing});
  return all;
}

template <class Left>
RunRecord driven(Choice const& choice, double final_time, int resolution = 20) {
  static Case const scene_case = case_part<Driven<Left>>();
  RunSpec spec{.scene_case = &scene_case,
               .parameters = Parameters(scene_case.info.parameters),
               .formulation = {.id = choice.formulation,
                               .work = choice.formulation == "momentum/sqrt-p" ? "work/sqrt-p"
                                                                               : "work/internal-energy",
                               .conduction = "",
                               .walls = {}},
               .label = choice.formulation,
               .discretisation = {},
               .smoothing_exponent = 0.0,
               .resolution = resolution,
               .smoothing_ratio = 1.2};
  spec.parameters.set("final_time", final_time);
  spec.discretisation.density = choice.density;
  spec.discretisation.closure = choice.closure;
  spec.discretisation.smoothing = choice.smoothing;
  spec.discretisation.integrator = "leapfrog";
  spec.discretisation.viscosity = {1.0, 2.0};
  RunOptions options;
  options.measure = {Measure::conservation};
  return execute(spec, options);
}

BOOST_AUTO_TEST_CASE(a_wall_that_rams_the_gas_or_stops_at_once_does_not_end_a_run) {
  for (Choice const& choice : choices()) {
    RunRecord const rammed = driven<Rams>(choice, 0.02);
    BOOST_TEST(rammed.status == "ok", choice << ": " << rammed.reason);
    RunRecord const stopped = driven<Stops>(choice, 0.3);
    BOOST_TEST(stopped.status == "ok", choice << ": " << stopped.reason);
    BOOST_TEST(stopped.wall_budgets.at(0).position.at(0) == 0.08, boost::test_tools::tolerance(1e-12));
  }
}

// In one step of the usual length it would be gone, and with it more density than there was.
BOOST_AUTO_TEST_CASE(a_wall_that_leaves_its_gas_behind_does_not_end_a_run) {
  for (Choice const& choice : choices()) {
    RunRecord const record = driven<Leaves>(choice, 0.02);
    BOOST_TEST(record.status == "ok", choice << ": " << record.reason);
    BOOST_TEST(record.motion->lowest_density > 0.2, choice << ": " << record.motion->lowest_density);
    BOOST_TEST(record.motion->steps_bound_by.contains("approach"));
  }
}

BOOST_AUTO_TEST_CASE(a_wall_that_leaps_over_gas_ends_the_run_with_who_and_when) {
  for (Choice const& choice : choices()) {
    RunRecord const record = driven<Leaps>(choice, 0.3);
    BOOST_TEST(record.status == "unstable");
    BOOST_TEST(record.reason.find("particle 0 overtook wall 0 at t = 0.10") == 0u, record.reason);
  }
}

BOOST_AUTO_TEST_CASE(a_wall_that_pulls_is_a_lost_positivity_of_sqrt_p_and_no_trouble_to_others) {
  for (Choice const& choice : choices()) {
    RunRecord const record = driven<Pulls>(choice, 0.3);
    if (choice.formulation == "momentum/p-rho2") {
      BOOST_TEST(record.status == "ok", choice << ": " << record.reason);
    } else {
      BOOST_TEST(record.status == "positivity-lost");
      BOOST_TEST(record.reason.find("negative pressure: wall 0 has -0.3 at t = 0") != std::string::npos,
                 record.reason);
    }
    RunRecord const none = driven<IsNoNumber>(choice, 0.3);
    BOOST_TEST(none.status == "non-finite");
    BOOST_TEST(none.reason.find("acceleration of particle 0 is not finite at t = 0") == 0u, none.reason);
  }
}

BOOST_AUTO_TEST_CASE(one_particle_between_two_walls_is_a_gas_unless_its_smoothing_length_needs_another) {
  for (Choice const& choice : choices()) {
    bool const needs_another = choice.density == "summation" && choice.smoothing == "adaptive";
    for (RunRecord const& record : {driven<Stops>(choice, 0.3, 1), driven<Leaves>(choice, 0.02, 1)}) {
      BOOST_TEST(record.status == (needs_another ? "invalid" : "ok"), choice << ": " << record.reason);
      if (!needs_another) continue;
      BOOST_TEST(record.reason.find("particle 0") != std::string::npos, record.reason);
      BOOST_TEST(record.reason.find("it is alone") != std::string::npos, record.reason);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
