// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cases/support/case.hpp"
#include "formulations/layouts/layout.hpp"
#include "tests/support/other_values.hpp"

// Whatever a user gives has an effect or is refused: of every case, every parameter is varied, by itself and
// beside every other choice that the case offers, and the problem or its reference changes.
BOOST_AUTO_TEST_SUITE(case_parameters)

using namespace sphverify;
using namespace sphverify::tests;

/// All numbers by which a problem could differ from another one, at given places and times.
template <int Dim>
class Fingerprint {
 public:
  Fingerprint(VectorField<Dim> const& places, double end) : places_(places), end_(end) {}

  std::vector<double> of(Problem<Dim> const& p) {
    numbers_.clear();
    add(p.domain.lower);
    add(p.domain.upper);
    for (bool const periodic : p.domain.periodic) add(periodic ? 1.0 : 0.0);
    for (int k = 0; k < Dim; ++k) add(Vector<Dim>(p.domain.axes.col(k)));
    add(p.final_time);
    add(p.gamma);
    add(p.not_run_because.empty() ? 0.0 : 1.0);
    for (Wall<Dim> const& wall : p.walls) add_wall(wall);
    for (auto const& [field, f] : p.scalars) add_function(f);
    for (auto const& [field, f] : p.vectors) add_function(f);
    for (auto const& [rate, f] : p.heating) add_function(f);
    add_function(p.acceleration);
    add_function(p.source);
    add_function(p.body_force);
    add_function(p.holds);
    if (p.conductivity) {
      for (std::size_t i = 0; i < places_.size(); ++i) {
        for (double const T : {0.1, 1.0, 3.0}) add(p.conductivity(places_[i], T));
      }
    }
    if (p.point_energy) {
      add(p.point_energy->place);
      add(p.point_energy->energy);
    }
    for (double const t : times()) {
      for (auto const& [name, value] : p.landmarks) add(value(t));
    }
    return numbers_;
  }

 private:
  std::vector<double> times() const { return {0.0, 0.4 * end_, end_}; }
  void add(double value) { numbers_.push_back(value); }
  void add(Vector<Dim> const& v) {
    for (double const c : v) add(c);
  }
  template <class F>
  void add_function(F const& f) {
    if (!f) return add(0.0);
    for (double const t : times()) {
      for (std::size_t i = 0; i < places_.size(); ++i) add(f(places_[i], t));
    }
  }
  void add_wall(Wall<Dim> const& wall) {
    add(wall.point);
    add(wall.outward_normal);
    for (auto const* f : {&wall.pressure, &wall.temperature, &wall.conductivity}) add_function(*f);
    for (auto const* f : {&wall.velocity, &wall.flux}) add_function(*f);
    for (double const t : times()) add(wall.path ? wall.path(t) : wall.point);
    if (wall.heat_loss) {
      for (double const T : {0.5, 1.0, 2.0}) add(wall.heat_loss->flux(T));
      add(wall.heat_loss->environment);
    }
  }

  VectorField<Dim> const& places_;
  double end_;
  std::vector<double> numbers_;
};

/// By more than rounding, somewhere.
bool differ(std::vector<double> const& a, std::vector<double> const& b) {
  if (a.size() != b.size()) return true;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::isnan(a[i]) != std::isnan(b[i])) return true;
    if (std::abs(a[i] - b[i]) > 1e-7 * std::max(std::abs(a[i]), std::abs(b[i]))) return true;
  }
  return false;
}

bool differ(AnyProblem const& base, AnyProblem const& other) {
  if (base.index() != other.index()) return true;
  return std::visit(
      [&]<int Dim>(Problem<Dim> const& one) {
        VectorField<Dim> const places = jittered(one.domain, Dim == 1 ? 17 : 5, 0.3, 5).positions;
        Fingerprint<Dim> fingerprint(places, one.final_time);
        return differ(fingerprint.of(one), fingerprint.of(std::get<Problem<Dim>>(other)));
      },
      base);
}

/// Empty where the case refuses the choices.
std::optional<AnyProblem> built(Case const& one, Choices const& choices) {
  try {
    return one.problem(in_use(one, with(one.info, choices)));
  } catch (std::invalid_argument const&) {
    return std::nullopt;
  }
}

/// Calls check(spec, choice) for everything that may be given to a case.
template <class Check>
void for_each_choice(Case const& one, Check const& check) {
  for (ParameterSpec const& spec : one.info.parameters) {
    for (ParameterValue const& value : others(one.info, spec)) check(spec, Choice{spec.name, value});
  }
}

BOOST_AUTO_TEST_CASE(every_parameter_changes_the_problem_or_its_reference) {
  for (Case const& one : all_cases()) {
    for_each_choice(one, [&](ParameterSpec const& spec, Choice const& choice) {
      BOOST_TEST_CONTEXT(one.info.id << " " << spec.name) {
        Choices choices = needs(one.info.id, spec.name);
        auto before = built(one, choices);
        if (!before) before = built(one, {});  // left and right go together
        choices.push_back(choice);
        auto const after = built(one, choices);
        BOOST_TEST_REQUIRE(after.has_value(), "refused");
        BOOST_TEST(differ(*before, *after));
      }
    });
  }
}

// Every choice beside every other one: a gamma beside a preset that has its own must not pass in silence.
BOOST_AUTO_TEST_CASE(beside_any_other_choice_a_parameter_has_an_effect_or_is_refused) {
  std::size_t refused = 0;
  std::size_t changed = 0;
  for (Case const& one : all_cases()) {
    std::vector<Choices> settings;
    for_each_choice(one, [&](ParameterSpec const& spec, Choice const& choice) {
      settings.push_back(needs(one.info.id, spec.name));
      settings.back().push_back(choice);
    });
    for (Choices const& setting : settings) {
      auto const before = built(one, setting);
      if (!before) continue;
      for_each_choice(one, [&](ParameterSpec const& spec, Choice const& choice) {
        for (auto const& [name, value] : setting) {
          if (name == spec.name) return;
        }
        Choices both = setting;
        both.push_back(choice);
        auto const after = built(one, both);
        BOOST_TEST_CONTEXT(one.info.id << " " << spec.name << " beside " << setting.back().first) {
          if (after) BOOST_TEST(differ(*before, *after));
        }
        ++(after ? changed : refused);
      });
    }
  }
  BOOST_TEST(refused >= 10u);
  BOOST_TEST(changed >= 20 * refused);
}

BOOST_AUTO_TEST_CASE(what_a_preset_has_of_its_own_is_refused_and_the_reason_said) {
  Case const& one = *find_case("hydro/riemann");
  auto const says = [](std::string const& word) {
    return [word](BadValue const& error) {
      return error.quantity == word && error.expected.find("has no effect") != std::string::npos;
    };
  };
  Choice const sod{"preset", std::string("sod")};
  Choice const left{"left", std::vector<double>{1.0, 0.0, 1.0}};
  Choice const right{"right", std::vector<double>{0.125, 0.0, 0.1}};
  for (double const gamma : {1.6666, 1.4}) {
    BOOST_CHECK_EXCEPTION(in_use(one, with(one.info, {sod, {"gamma", gamma}})), BadValue, says("gamma"));
    BOOST_CHECK_EXCEPTION(in_use(one, with(one.info, {{"gamma", gamma}})), BadValue, says("gamma"));
  }
  BOOST_CHECK_EXCEPTION(in_use(one, with(one.info, {sod, left, right})), BadValue, says("preset"));
  BOOST_CHECK_THROW(in_use(one, with(one.info, {{"preset", std::string("custom")}})), BadValue);
  BOOST_CHECK_NO_THROW(
      in_use(one, with(one.info, {{"preset", std::string("custom")}, left, right, {"gamma", 1.6}})));
}

// Defaults are no one's wish: those that mean nothing are dropped, so that no document prints them.
BOOST_AUTO_TEST_CASE(defaults_without_effect_are_dropped_and_change_nothing) {
  std::size_t dropped = 0;
  for (Case const& one : all_cases()) {
    Parameters const all(one.info.parameters);
    Parameters const used = in_use(one, all);
    BOOST_TEST(!differ(one.problem(all), one.problem(used)), one.info.id);
    dropped += all.all().size() - used.all().size();
  }
  BOOST_TEST(dropped == 1u);
  Case const& tube = *find_case("hydro/riemann");
  BOOST_TEST(!in_use(tube, Parameters(tube.info.parameters)).all().contains("gamma"));
}

BOOST_AUTO_TEST_CASE(a_question_about_a_time_is_judged_by_that_time) {
  struct Question {
    char const* id;
    Choices choices;
    double early, late;
  };
  for (Question const& q :
       {Question{"hydro/noh", {{"gamma", 2.9}}, 0.1, 0.6}, Question{"hydro/noh", {}, 0.7, 0.76},
        Question{"hydro/noh", {{"dimension", 2.0}, {"gamma", 2.9}}, 0.1, 0.6},
        Question{"conduction/marshak", {{"exponent", 1.0}}, 0.1, 0.5},
        Question{"conduction/barenblatt", {{"half_width", 3.8}}, 0.1, 1.0},
        Question{"hydro/acoustic", {{"amplitude", 0.3}}, 0.75, 1.6},
        Question{"hydro/piston-velocity", {{"pressure", 9.0}}, 0.1, 0.5},
        Question{"hydro/simple-wave", {{"speed", 3.0}}, 0.01, 0.5},
        Question{"hydro/vacuum-release", {{"pressure", 9.0}}, 0.1, 0.5},
        Question{"hydro/sedov", {{"energy", 9.0}}, 0.1, 0.5},
        Question{"extreme/radiative-cooling", {}, 0.05, 1e9}}) {
    Case const& one = *find_case(q.id);
    Parameters const asked = with(one.info, q.choices);
    BOOST_TEST_CONTEXT(q.id) {
      for (double const t : {0.0, q.early}) BOOST_CHECK_NO_THROW(in_use(one, until(one, asked, t)));
      BOOST_CHECK_THROW(in_use(one, until(one, asked, q.late)), std::invalid_argument);
      // The time that is asked for takes the place of an end.
      Parameters named = asked;
      named.give("final_time", q.early);
      BOOST_CHECK_THROW(until(one, named, q.early), BadValue);
    }
  }
  // Final times in a unit of the case's own.
  Case const& units = *find_case("extreme/units");
  Parameters const scaled = until(units, with(units.info, {{"time_unit", 10.0}}), 0.2);
  BOOST_TEST(std::abs(scaled.number("final_time") - 0.02) < 1e-15);
  for (Case const& one : all_cases()) {
    BOOST_TEST_CONTEXT(one.info.id) {
      for (double const t : {0.0, 1e-3})
        BOOST_CHECK_NO_THROW(in_use(one, until(one, Parameters(one.info.parameters), t)));
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
