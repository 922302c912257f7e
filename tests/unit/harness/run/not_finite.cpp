// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

#include "reports/json/results_json.hpp"
#include "tests/support/runs.hpp"

BOOST_AUTO_TEST_SUITE(harness_run_not_finite)

using namespace sphverify;
using namespace sphverify::tests;

constexpr double nan_ = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
/// Of 20 on the unit interval.
constexpr std::size_t seventh = 7;
constexpr double place = 0.375;

bool is_there(Vector<1> const& x) { return std::abs(x[0] - place) < 1e-3; }

ScalarFunction<1> broken(ScalarFunction<1> const& inner, double value, bool at_start) {
  return [=](Vector<1> const& x, double t) {
    return is_there(x) && (at_start || t > 0.0) ? value : inner(x, t);
  };
}

/// A case of the list whose problem has one number, at the seventh particle, that is none.
template <class Break>
RunRecord run_broken(RunChoice const& choice, Break const&, MeasureSet measure,
                     std::string const& work = "") {
  RunSpec spec = make_spec(choice);
  static Case const* original = nullptr;
  original = spec.scene_case;
  static Case broken_case;
  broken_case = *original;
  broken_case.problem = [](Parameters const& parameters) -> AnyProblem {
    Problem<1> problem = std::get<Problem<1>>(original->problem(parameters));
    Break()(problem);
    return problem;
  };
  spec.scene_case = &broken_case;
  spec.formulation.work = work;
  RunOptions options;
  options.measure = measure;
  return execute(spec, options);
}

void check(RunRecord const& record, std::string const& what) {
  BOOST_TEST(record.status == "non-finite", record.status << ": " << record.reason);
  std::string const reason = what + " of particle 7 is not finite";
  BOOST_TEST(record.reason.starts_with(reason), record.reason);
}

/// The document has null, and nothing in it is a number that only looks good.
void check_null_norms(RunRecord const& record, std::string const& field) {
  BOOST_TEST_REQUIRE(record.errors.contains(field));
  Json const norms = to_json(record).at("errors").at(field).at("all");
  for (char const* norm : {"l1", "l2", "linf"}) BOOST_TEST(norms.at(norm).is_null(), field << " " << norm);
}

RunChoice const slab{.resolution = 20};

BOOST_AUTO_TEST_CASE(an_exact_field_that_is_no_number_leaves_no_norm) {
  for (char const* integrator : {"bdf", "runge-kutta"}) {
    RunChoice choice = slab;
    choice.discretisation.integrator = integrator;
    auto const break_nan = [](Problem<1>& p) {
      p.scalars[Field::temperature] = broken(p.scalars[Field::temperature], nan_, false);
    };
    RunRecord const record =
        run_broken(choice, break_nan, {Measure::error, Measure::profile, Measure::second_law});
    check(record, "exact temperature");
    check_null_norms(record, "temperature");
    BOOST_TEST(!record.integration->time_error_share.has_value());
    BOOST_TEST(!record.integration->remark.empty());
    BOOST_TEST(to_json(record).at("profile").at("exact").at("temperature")[seventh][0].is_null());
    // The document can be read again.
    Json const json = to_json(record);
    BOOST_TEST(read_run(Node(json, "f")).status == "non-finite");
    auto const break_infinite = [](Problem<1>& p) {
      p.scalars[Field::temperature] = broken(p.scalars[Field::temperature], infinity, false);
    };
    RunRecord const other = run_broken(choice, break_infinite, {Measure::error});
    check(other, "exact temperature");
    check_null_norms(other, "temperature");
  }
}

BOOST_AUTO_TEST_CASE(a_weight_that_is_no_number_leaves_no_norm) {
  auto const break_it = [](Problem<1>& p) {
    p.scalars[Field::density] = broken(p.scalars[Field::density], nan_, false);
  };
  RunRecord const record = run_broken(slab, break_it, {Measure::error});
  check(record, "weight (mass over exact density)");
  check_null_norms(record, "temperature");
}

BOOST_AUTO_TEST_CASE(an_initial_value_that_is_no_number_is_named) {
  auto const break_it = [](Problem<1>& p) {
    p.scalars[Field::temperature] = broken(p.scalars[Field::temperature], nan_, true);
  };
  RunRecord const record = run_broken(slab, break_it, {Measure::error});
  check(record, "initial temperature");
}

BOOST_AUTO_TEST_CASE(a_heating_that_is_no_number_is_named_whatever_integrates_it) {
  for (char const* integrator : {"bdf", "implicit-runge-kutta", "runge-kutta", "runge-kutta-chebyshev"}) {
    BOOST_TEST_CONTEXT(integrator) {
      RunChoice choice = slab;
      choice.discretisation.integrator = integrator;
      auto const at_once = [](Problem<1>& p) {
        p.source = broken([](Vector<1> const&, double) { return 0.0; }, nan_, true);
      };
      RunRecord const record = run_broken(choice, at_once, {Measure::error, Measure::conservation});
      check(record, "heating");
      BOOST_TEST(record.reason.ends_with("at t = 0"), record.reason);
      auto const later = [](Problem<1>& p) {
        p.source = [](Vector<1> const& x, double t) { return is_there(x) && t > 0.01 ? nan_ : 0.0; };
      };
      check(run_broken(choice, later, {Measure::error}), "heating");
      // Of the scheme itself, which passes it on to whoever is near.
      auto const scheme = [](Problem<1>& p) {
        p.conductivity = [](Vector<1> const& x, double) { return is_there(x) ? nan_ : 1.0; };
      };
      RunRecord const spread = run_broken(choice, scheme, {Measure::error});
      BOOST_TEST(spread.status == "non-finite");
      BOOST_TEST(spread.reason.starts_with("heating of particle "), spread.reason);
    }
  }
}

BOOST_AUTO_TEST_CASE(the_flux_through_a_wall_that_is_no_number_is_named) {
  auto const break_it = [](Problem<1>& p) {
    auto const inner = p.vectors[Field::flux];
    p.vectors[Field::flux] = [inner](Vector<1> const& x, double t) {
      return x[0] == 0.0 ? Vector<1>(nan_) : inner(x, t);
    };
  };
  RunRecord const record = run_broken(slab, break_it, {Measure::error});
  BOOST_TEST(record.status == "non-finite");
  BOOST_TEST(record.reason == "exact flux through wall 0 is not finite");
  BOOST_TEST(to_json(record).at("wall_flux")[0].at("error").is_null());
}

BOOST_AUTO_TEST_CASE(a_gas_names_what_is_no_number) {
  for (char const* integrator : {"leapfrog", "runge-kutta"}) {
    BOOST_TEST_CONTEXT(integrator) {
      RunChoice choice{.scene_case = "hydro/acoustic", .formulation = "momentum/p-rho2", .resolution = 20};
      choice.discretisation.density = "continuity";
      choice.discretisation.integrator = integrator;
      MeasureSet const measure{Measure::error, Measure::conservation};
      char const* const work = "work/internal-energy";
      auto const source = [](Problem<1>& p) {
        p.source = broken([](Vector<1> const&, double) { return 0.0; }, nan_, true);
      };
      check(run_broken(choice, source, measure, work), "heating");
      auto const force = [](Problem<1>& p) {
        p.body_force = [](Vector<1> const& x, double) { return Vector<1>(is_there(x) ? nan_ : 0.0); };
      };
      check(run_broken(choice, force, measure, work), "acceleration");
      auto const velocity = [](Problem<1>& p) {
        auto const inner = p.vectors[Field::velocity];
        p.vectors[Field::velocity] = [inner](Vector<1> const& x, double t) {
          return is_there(x) ? Vector<1>(nan_) : inner(x, t);
        };
      };
      check(run_broken(choice, velocity, measure, work), "velocity");
      // The particles have hardly moved by then.
      auto const exact = [](Problem<1>& p) {
        p.scalars[Field::pressure] = broken(p.scalars[Field::pressure], nan_, false);
      };
      RunRecord const record = run_broken(choice, exact, measure, work);
      check(record, "exact pressure");
      check_null_norms(record, "pressure");
      auto const weight = [](Problem<1>& p) {
        p.scalars[Field::density] = broken(p.scalars[Field::density], nan_, false);
      };
      RunRecord const unweighted = run_broken(choice, weight, measure, work);
      check(unweighted, "exact density");
      check_null_norms(unweighted, "velocity");
    }
  }
}

BOOST_AUTO_TEST_CASE(rates_that_are_no_numbers_leave_no_norm) {
  RunChoice const choice{.scene_case = "operator/sine", .resolution = 20};
  auto const exact = [](Problem<1>& p) {
    p.heating[Rate::conduction_heating] = broken(p.heating[Rate::conduction_heating], nan_, true);
  };
  RunRecord const record = run_broken(choice, exact, {Measure::error, Measure::profile, Measure::cost});
  check(record, "exact heating");
  check_null_norms(record, "heating");
  BOOST_TEST(!record.cost.has_value());
  auto const computed = [](Problem<1>& p) {
    p.conductivity = [](Vector<1> const& x, double) { return is_there(x) ? infinity : 1.0; };
  };
  RunRecord const scheme = run_broken(choice, computed, {Measure::error});
  BOOST_TEST(scheme.status == "non-finite");
  BOOST_TEST(scheme.reason.starts_with("heating of particle "), scheme.reason);
  check_null_norms(scheme, "heating");
}

BOOST_AUTO_TEST_SUITE_END()
