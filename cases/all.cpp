// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/all.hpp"

#include <algorithm>
#include <stdexcept>

#include "cases/support/case.hpp"

namespace sphverify {

namespace {

std::deque<Case>& cases() {
  static std::deque<Case> all =
      std::apply([](auto... one) { return std::deque<Case>{case_part<decltype(one)>()...}; }, AllCases{});
  return all;
}

}  // namespace

std::deque<Case> const& all_cases() { return cases(); }

void add_case(Case const& one) {
  if (find_case(one.info.id)) throw std::invalid_argument("two cases are called " + one.info.id);
  cases().push_back(one);
}

Case const* find_case(std::string_view id) {
  for (Case const& one : all_cases()) {
    if (one.info.id == id) return &one;
  }
  return nullptr;
}

Parameters in_use(Case const& one, Parameters const& parameters) {
  auto const seen = std::make_shared<std::set<std::string>>();
  one.problem(parameters.noting(seen));
  Parameters used = parameters;
  for (ParameterSpec const& spec : one.info.parameters) {
    if (seen->contains(spec.name)) continue;
    if (parameters.is_given(spec.name)) {
      throw BadValue(spec.name,
                     "none, since it has no effect beside these parameters (it is: " + spec.meaning + ")",
                     "");
    }
    used.drop(spec.name);
  }
  return used;
}

Parameters until(Case const& one, Parameters const& parameters, double time) {
  auto const spec = std::find_if(one.info.parameters.begin(), one.info.parameters.end(),
                                 [](ParameterSpec const& each) { return each.name == "final_time"; });
  if (spec == one.info.parameters.end()) return parameters;
  // A final time counts in seconds or in the unit that another parameter names.
  if (parameters.is_given("final_time"))
    throw BadValue("final_time", "none, since the time that is asked for takes its place", "");
  double const unit = spec->unit == "s" ? 1.0 : parameters.number(spec->unit);
  if (!(unit > 0.0)) return parameters;  // the case says so
  double const asked = time / unit;
  double const known = parameters.number("final_time");
  Parameters judged = parameters;
  // No scene ends when it begins: at the start nothing has gone wrong yet.
  judged.set("final_time", asked > 0.0 ? asked : known > 0.0 ? 1e-12 * known : 1e-30);
  return judged;
}

}  // namespace sphverify
