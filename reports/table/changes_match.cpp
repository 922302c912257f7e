// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/table/changes_match.hpp"

#include <fmt/format.h>

namespace sphverify {

namespace {

/// A parameter that only one document's version knows does not count.
bool agree(std::map<std::string, ParameterValue> const& a, std::map<std::string, ParameterValue> const& b) {
  return std::all_of(a.begin(), a.end(), [&](auto const& entry) {
    auto const other = b.find(entry.first);
    return other == b.end() || other->second == entry.second;
  });
}

std::string name_of(std::string const& case_id, std::map<std::string, ParameterValue> const& parameters,
                    std::string const& label, Setting const& setting) {
  std::string const column = SettingNames({setting}).column(setting);
  return fmt::format("{} {}: {}, {}, {}", case_id, parameters_text(parameters), label,
                     setting.discretisation.density, column);
}

}  // namespace

Discretisation without_seed(Discretisation discretisation) {
  discretisation.layout.seed = 0;
  return discretisation;
}

bool may_match(Series const& a, Series const& b) {
  return a.case_id == b.case_id && a.formulation == b.formulation &&
         without_seed(a.discretisation) == without_seed(b.discretisation) &&
         a.smoothing_exponent == b.smoothing_exponent && agree(a.parameters, b.parameters);
}

bool may_match(Envelope const& a, Envelope const& b) {
  return a.case_id == b.case_id && a.formulation == b.formulation && a.parameter == b.parameter &&
         a.discretisation == b.discretisation && a.resolution == b.resolution &&
         a.logarithmic == b.logarithmic && agree(a.parameters, b.parameters);
}

std::string name_of(Series const& s) { return name_of(s.case_id, s.parameters, s.label, setting_of("", s)); }

std::string name_of(Envelope const& e) {
  return name_of(e.case_id, e.parameters, e.label, {"", e.formulation, e.discretisation, 0.0, e.resolution}) +
         ", " + e.parameter;
}

}  // namespace sphverify
