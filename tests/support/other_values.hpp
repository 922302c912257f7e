// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <boost/test/unit_test.hpp>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "cases/support/case.hpp"

// What the parameters of all cases may be besides their defaults: a case or parameter that is new is varied
// as soon as it is in the list.
namespace sphverify::tests {

using Table = std::vector<std::vector<double>>;
using Choice = std::pair<std::string, ParameterValue>;
using Choices = std::vector<Choice>;

/// What the words and lists of the cases may be besides their defaults, and numbers that the rule below does
/// not fit.
inline std::vector<ParameterValue> const* listed(std::string const& id, std::string const& name) {
  static std::map<std::string, std::vector<ParameterValue>> const of_name{
      {"walls", {std::string("mixed")}},
      {"turn", {30.0}},
      {"preset", {std::string("toro-2"), std::string("toro-3"), std::string("leblanc")}},  // toro-1 is Sod
      {"modes", {Table{{2.0, 0.7}}}},
      {"mach", {0.5}}};
  static std::map<std::string, std::vector<ParameterValue>> const of_case{
      {"hydro/riemann left", {std::vector<double>{2.0, 0.1, 1.5}}},
      {"hydro/riemann right", {std::vector<double>{0.2, 0.3, 0.2}}},
      {"hydro/uniform boundary", {std::string("velocity"), std::string("periodic")}},
      {"hydro/acoustic boundary", {std::string("periodic")}},
      {"hydro/noh window", {std::vector<double>{0.05, 0.35}}},
      {"hydro/gresho boundary", {std::string("velocity")}},
      {"extreme/density-contrast boundary", {std::string("pressure")}},
      {"hydro/manufactured drive", {std::string("pressure"), std::string("both")}},
      {"coupled/manufactured drive", {std::string("pressure"), std::string("both")}},
      {"hydro/simple-wave drive", {std::string("pressure")}},
      {"conduction/square modes", {Table{{2.0, 1.0, 0.7}}}},
      {"conduction/cube modes", {Table{{2.0, 1.0, 1.0, 0.7}}}},
      {"extreme/cold-front exponent", {3.0}},
      {"extreme/radiative-cooling exponent", {1.0}}};
  auto const own = of_case.find(id + " " + name);
  if (own != of_case.end()) return &own->second;
  auto const common = of_name.find(name);
  return common != of_name.end() ? &common->second : nullptr;
}

/// Other values than the default.
inline std::vector<ParameterValue> others(CaseInfo const& info, ParameterSpec const& spec) {
  if (auto const* const values = listed(info.id, spec.name)) return *values;
  BOOST_TEST_REQUIRE(std::holds_alternative<double>(spec.default_value),
                     info.id << ": which other values may " << spec.name << " have?");
  double const value = std::get<double>(spec.default_value);
  if (spec.name == "dimension") return {value == 1.0 ? 2.0 : 1.0, 3.0};
  if (spec.integer) return {value + 1.0};
  return {value == 0.0 ? 0.1 : 1.1 * value};
}

/// Without which a parameter means nothing.
inline Choices needs(std::string const& id, std::string const& name) {
  if (name == "turn") return {{"dimension", 2.0}};
  if (id == "hydro/riemann" && name == "left") return {{"right", std::vector<double>{0.2, 0.3, 0.2}}};
  if (id == "hydro/riemann" && name == "right") return {{"left", std::vector<double>{2.0, 0.1, 1.5}}};
  if (id == "hydro/riemann" && name == "gamma")
    return {{"left", std::vector<double>{2.0, 0.1, 1.5}}, {"right", std::vector<double>{0.2, 0.3, 0.2}}};
  return {};
}

inline Parameters with(CaseInfo const& info, Choices const& choices) {
  Parameters parameters(info.parameters);
  for (auto const& [name, value] : choices) parameters.give(name, value);
  return parameters;
}

}  // namespace sphverify::tests
