// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/cli/case_parameters.hpp"

#include <set>

#include "reports/json/parse.hpp"
#include "reports/listed_identifiers.hpp"
#include "reports/user_error.hpp"

namespace sphverify {

namespace {

/// VALUE is JSON, or a bare word.
Json parse_value(std::string const& text) { return parse_json(text).value_or(Json(text)); }

}  // namespace

Case const& case_named(std::string const& command, std::string const& id) {
  if (Case const* const found = find_case(id)) return *found;
  std::vector<std::string> ids;
  for (Case const& one : all_cases()) ids.push_back(one.info.id);
  throw UserError(command, "CASE", "'" + id + "'", one_listed_by("sphverify list cases", id, ids));
}

Parameters read_assignments(std::string const& command, CaseInfo const& info, std::vector<std::string> const& assignments) {
  Parameters parameters(info.parameters);
  std::vector<std::string> names;
  for (ParameterSpec const& spec : info.parameters) names.push_back(spec.name);
  std::set<std::string> assigned;
  for (std::string const& assignment : assignments) {
    auto const equals = assignment.find('=');
    if (equals == std::string::npos) throw UserError(command, "--parameter", "'" + assignment + "'", "NAME=VALUE");
    std::string const name = assignment.substr(0, equals);
    if (!assigned.insert(name).second)
      throw UserError(command, "--parameter", "'" + assignment + "'", "every name only once");
    bool known = false;
    for (ParameterSpec const& spec : info.parameters) {
      if (spec.name != name) continue;
      Json const value = parse_value(assignment.substr(equals + 1));
      parameters.give(name, read_parameter(Node(value, command, "--parameter " + name), spec));
      known = true;
    }
    if (!known) throw UserError(command, "--parameter", "'" + name + "'", one_of(name, names));
  }
  return parameters;
}

Json assigned_values(std::vector<std::string> const& assignments) {
  Json values = Json::object();
  for (std::string const& assignment : assignments) {
    std::size_t const equals = assignment.find('=');
    values[assignment.substr(0, equals)] = parse_value(assignment.substr(equals + 1));
  }
  return values;
}

}  // namespace sphverify
