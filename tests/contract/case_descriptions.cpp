// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <set>

#include "cases/support/case.hpp"

BOOST_AUTO_TEST_SUITE(case_descriptions)

using namespace sphverify;

BOOST_AUTO_TEST_CASE(the_cases_of_the_contract_are_there) {
  for (char const* id :
       {"operator/polynomial", "operator/sine", "conduction/slab-dirichlet", "conduction/slab-insulated",
        "conduction/slab-flux", "conduction/half-space-step", "conduction/manufactured",
        "conduction/barenblatt", "conduction/marshak", "conduction/square", "conduction/cube"}) {
    BOOST_TEST(find_case(id) != nullptr, id);
  }
  BOOST_TEST(find_case("conduction/none") == nullptr);
  BOOST_TEST(find_case("") == nullptr);
}

BOOST_AUTO_TEST_CASE(every_case_says_everything_of_itself) {
  std::set<std::string> ids;
  for (Case const& one : all_cases()) {
    CaseInfo const& info = one.info;
    BOOST_TEST_CONTEXT(info.id) {
      BOOST_TEST(ids.insert(info.id).second);
      BOOST_TEST(find_case(info.id) == &one);
      for (std::string const* text :
           {&info.id, &info.title, &info.source, &info.equation, &info.domain, &info.walls, &info.initial}) {
        BOOST_TEST(!text->empty());
        BOOST_TEST(text->find('\n') == std::string::npos);
      }
      char const* const room = info.kind == CaseKind::rates        ? "operator/"
                               : info.kind == CaseKind::conduction ? "conduction/"
                               : info.kind == CaseKind::hydro      ? "hydro/"
                                                                   : "coupled/";
      BOOST_TEST((info.id.starts_with(room) || info.id.starts_with("extreme/")));
      std::set<std::string> names;
      for (ParameterSpec const& spec : info.parameters) {
        BOOST_TEST(!spec.meaning.empty(), spec.name);
        BOOST_TEST(names.insert(spec.name).second, spec.name);
      }
      if (info.kind != CaseKind::rates) BOOST_TEST(names.contains("final_time"));
    }
  }
}

BOOST_AUTO_TEST_CASE(every_case_can_be_built_from_its_defaults) {
  for (Case const& one : all_cases()) BOOST_CHECK_NO_THROW(one.problem(Parameters(one.info.parameters)));
}

struct Bad {
  char const* id;
  char const* parameter;
  ParameterValue value;
};

BOOST_AUTO_TEST_CASE(values_that_make_no_sense_are_refused) {
  using Table = std::vector<std::vector<double>>;
  for (Bad const& bad : {Bad{"operator/polynomial", "degree", -1.0},
                         Bad{"operator/polynomial", "dimension", 0.0},
                         Bad{"operator/sine", "dimension", 4.0},
                         Bad{"conduction/manufactured", "dimension", 4.0},
                         Bad{"conduction/manufactured", "conductivity", 0.0},
                         Bad{"conduction/slab-dirichlet", "density", 0.0},
                         Bad{"conduction/slab-dirichlet", "conductivity", -1.0},
                         Bad{"conduction/slab-dirichlet", "modes", Table{{0.5, 1.0}}},
                         Bad{"conduction/slab-dirichlet", "modes", Table{{1.0}}},
                         Bad{"conduction/slab-dirichlet", "modes", Table{{0.0, 1.0}}},
                         Bad{"conduction/slab-dirichlet", "turn", 30.0},
                         Bad{"conduction/square", "modes", Table{{1.0, 1.0}}},
                         Bad{"conduction/square", "modes", Table{{1.0, 0.0, 1.0}}},
                         Bad{"conduction/square", "modes", Table{{1.0, 0.5, 1.0}}},
                         Bad{"conduction/square", "modes", Table{{-1.0, 1.0, 1.0}}},
                         Bad{"conduction/square", "modes", Table{{1.0, 1e7, 1.0}}},
                         Bad{"conduction/square", "walls", std::string("open")},
                         Bad{"conduction/square", "conductivity", 0.0},
                         Bad{"conduction/cube", "modes", Table{{1.0, 1.0, 1.0}}},
                         Bad{"conduction/cube", "modes", Table{{1.0, 1.0, 0.0, 1.0}}},
                         Bad{"conduction/cube", "density", -1.0},
                         Bad{"conduction/slab-insulated", "density", -1.0},
                         Bad{"conduction/slab-insulated", "modes", Table{{-1.0, 1.0}}},
                         Bad{"conduction/slab-flux", "conductivity", 0.0},
                         Bad{"conduction/half-space-step", "density", 0.0},
                         Bad{"conduction/barenblatt", "exponent", 1.0},
                         Bad{"conduction/barenblatt", "start_time", 0.0},
                         Bad{"conduction/barenblatt", "half_width", 1.0},
                         Bad{"conduction/barenblatt", "constant", -1.0},
                         Bad{"conduction/marshak", "exponent", 0.0},
                         Bad{"conduction/marshak", "final_time", 50.0},
                         Bad{"extreme/pressure-ratio", "ratio", 0.0},
                         Bad{"extreme/pressure-ratio", "final_time", 0.0},
                         Bad{"extreme/density-contrast", "contrast", 0.0},
                         Bad{"extreme/density-contrast", "boundary", std::string("periodic")},
                         Bad{"extreme/conductivity-contrast", "contrast", -1.0},
                         Bad{"extreme/cold-front", "ratio", 1.0},
                         Bad{"extreme/cold-front", "exponent", -1.0},
                         Bad{"extreme/cold-front", "exponent", 40.0},
                         Bad{"extreme/units", "length_unit", 0.0},
                         Bad{"extreme/units", "mass_unit", -1.0},
                         Bad{"extreme/units", "final_time", 0.0},
                         Bad{"extreme/gas-units", "time_unit", -1.0},
                         Bad{"extreme/gas-units", "length_unit", 1e200},
                         Bad{"extreme/radiative-cooling", "radiation", 0.0},
                         Bad{"extreme/radiative-cooling", "exponent", 9.0},
                         Bad{"extreme/radiative-cooling", "start", 0.0},
                         Bad{"extreme/radiative-cooling", "environment", -1.0},
                         Bad{"extreme/radiative-cooling", "final_time", 1e9},
                         Bad{"extreme/radiative-wall", "start", 1.0},
                         Bad{"extreme/radiative-wall", "radiation", -1.0}}) {
    Case const* const one = find_case(bad.id);
    BOOST_TEST_REQUIRE(one != nullptr);
    Parameters parameters(one->info.parameters);
    BOOST_TEST_REQUIRE(parameters.all().contains(bad.parameter));
    parameters.set(bad.parameter, bad.value);
    BOOST_TEST_CONTEXT(bad.id << " " << bad.parameter)
    BOOST_CHECK_THROW(one->problem(parameters), std::invalid_argument);
  }
}

BOOST_AUTO_TEST_CASE(modes_may_be_uniform_along_insulated_walls) {
  Case const* const square = find_case("conduction/square");
  Parameters parameters(square->info.parameters);
  parameters.set("walls", std::string("mixed"));
  parameters.set("modes", std::vector<std::vector<double>>{{1.0, 0.0, 1.0}});
  BOOST_CHECK_NO_THROW(square->problem(parameters));
}

BOOST_AUTO_TEST_CASE(dimensions_are_1_2_and_3_and_the_problem_has_the_one_asked_for) {
  std::size_t checked = 0;
  for (Case const& one : all_cases()) {
    for (ParameterSpec const& spec : one.info.parameters) {
      if (spec.name != "dimension") continue;
      BOOST_TEST(spec.integer);
      Parameters parameters(one.info.parameters);
      BOOST_TEST_CONTEXT(one.info.id) {
        for (double const dimension : {1.0, 2.0, 3.0}) {
          parameters.set("dimension", dimension);
          BOOST_TEST(one.problem(parameters).index() + 1 == static_cast<std::size_t>(dimension));
        }
        for (double const dimension : {-1.0, 0.0, 4.0}) {
          parameters.set("dimension", dimension);
          BOOST_CHECK_THROW(one.problem(parameters), std::invalid_argument);
        }
      }
      ++checked;
    }
  }
  BOOST_TEST(checked >= 13u);
  BOOST_TEST(find_case("conduction/square")
                 ->problem(Parameters(find_case("conduction/square")->info.parameters))
                 .index() == 1u);
  BOOST_TEST(find_case("conduction/cube")
                 ->problem(Parameters(find_case("conduction/cube")->info.parameters))
                 .index() == 2u);
}

BOOST_AUTO_TEST_CASE(a_slab_in_one_dimension_says_that_it_cannot_be_turned) {
  Case const* const slab = find_case("conduction/slab-dirichlet");
  Parameters parameters(slab->info.parameters);
  parameters.set("turn", 30.0);
  auto const says_so = [](std::invalid_argument const& error) {
    return std::string(error.what()).starts_with("turn must be 0 in one dimension, found 30");
  };
  BOOST_CHECK_EXCEPTION(slab->problem(parameters), std::invalid_argument, says_so);
  parameters.set("dimension", 2.0);
  BOOST_CHECK_NO_THROW(slab->problem(parameters));
}

// Documents cannot hold such numbers, but `exact --parameter` and tests can.
BOOST_AUTO_TEST_CASE(numbers_that_are_not_finite_are_refused_by_every_case) {
  for (Case const& one : all_cases()) {
    for (ParameterSpec const& spec : one.info.parameters) {
      if (!std::holds_alternative<double>(spec.default_value) || spec.name == "final_time") continue;
      Parameters parameters(one.info.parameters);
      parameters.give(spec.name, std::numeric_limits<double>::quiet_NaN());
      if (spec.integer) continue;
      BOOST_TEST_CONTEXT(one.info.id << " " << spec.name)
      BOOST_CHECK_THROW(in_use(one, parameters), std::invalid_argument);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
