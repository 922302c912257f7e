// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "cases/support/parameters.hpp"
#include "cases/support/problem.hpp"

namespace sphverify {

/// What a case compares, and so which formulations make sense on it.
enum class CaseKind {
  rates,       ///< rates on given fields, no time: every scheme alone
  conduction,  ///< heat conduction on particles that stand still: conduction forms
  hydro,       ///< moving gas: momentum forms with their work
  coupled      ///< moving gas that conducts: momentum forms with work and conduction
};

/// Whether the particles of a case move.
constexpr bool moves(CaseKind kind) { return kind == CaseKind::hydro || kind == CaseKind::coupled; }

/// What a case says of itself; parameters, domain, walls and initial state are its documentation.
struct CaseInfo {
  std::string id;
  std::string title;
  std::string source;    ///< citation of the reference solution
  std::string equation;  ///< what it solves and the solution, in plain text
  std::string domain;
  std::string walls;
  std::string initial;
  CaseKind kind;
  std::vector<ParameterSpec> parameters;
  bool discontinuous = false;  ///< the solution has jumps: viscosity is wanted, and orders are at most 1
  std::string remarks{};       ///< what to know before believing its numbers; may be empty
};

/// A case behind a common face.
struct Case {
  CaseInfo info;
  AnyProblem (*problem)(Parameters const&);  ///< throws BadValue for values that make no sense
};

/// What to hand to add_case: of a struct with `static CaseInfo info()` and `static AnyProblem problem(Parameters const&)`.
template <class Definition>
Case case_part() {
  return {Definition::info(), &Definition::problem};
}

/// Adds a case to those of `AllCases`, before anything else is asked of them. Throws std::invalid_argument if there is one of
/// that identifier.
void add_case(Case const& one);

/// All cases, in the order of the list, then those that were added.
std::deque<Case> const& all_cases();

/// Null if there is none of that identifier.
Case const* find_case(std::string_view id);

/// The parameters that the case looks at, of these: the others change nothing, such as the gamma of custom
/// states beside a preset that has its own. Throws BadValue if the user gave one of the others, and as the
/// case does for values that make no sense.
Parameters in_use(Case const& one, Parameters const& parameters);

/// The parameters for a question about one time [s]: their `final_time` is that time, so that a case judges
/// what was asked and not a default that nobody asked for. Throws BadValue if a final time is given beside
/// it.
Parameters until(Case const& one, Parameters const& parameters, double time);

/// Dispatches on the `dimension` parameter: calls `make.operator()<Dim>()` for 1, 2 or 3.
template <class Make>
AnyProblem in_dimension(int dimension, Make const& make) {
  switch (dimension) {
    case 1:
      return make.template operator()<1>();
    case 2:
      return make.template operator()<2>();
    case 3:
      return make.template operator()<3>();
    default:
      throw BadValue("dimension", "1, 2 or 3", std::to_string(dimension));
  }
}

}  // namespace sphverify
