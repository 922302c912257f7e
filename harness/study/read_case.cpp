// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/read_case.hpp"

#include <algorithm>

#include "cases/exact/require.hpp"
#include "harness/study/parameter_complaint.hpp"
#include "reports/listed_identifiers.hpp"

namespace sphverify {

std::string read_identifier(Node const& node, std::vector<std::string> const& known,
                            char const* listing_command) {
  std::string const found = node.is_string() ? node.string() : "";
  if (std::find(known.begin(), known.end(), found) == known.end())
    node.complain(one_listed_by(listing_command, found, known));
  return found;
}

Parameters sensible(Case const& one, Parameters const& parameters) {
  Parameters used = in_use(one, parameters);
  AnyProblem const problem = one.problem(used);
  double const final_time = std::visit([](auto const& p) { return p.final_time; }, problem);
  if (one.info.kind != CaseKind::rates) exact::require_positive("final_time", final_time);
  return used;
}

StudyCase read_case(Node const& node) {
  bool const bare = node.is_string();
  if (!bare) node.require_keys({"id", "parameters"});
  std::vector<std::string> ids;
  for (Case const& one : all_cases()) ids.push_back(one.info.id);
  std::string const id = read_identifier(bare ? node : node.at("id"), ids, "sphverify list cases");
  Case const* const found = find_case(id);
  StudyCase choice{found, Parameters(found->info.parameters)};
  auto const parameters = bare ? std::nullopt : node.find("parameters");
  if (parameters) {
    std::vector<std::string> names;
    for (ParameterSpec const& spec : found->info.parameters) names.push_back(spec.name);
    parameters->require_keys(names);
    for (ParameterSpec const& spec : found->info.parameters) {
      if (auto const value = parameters->find(spec.name))
        choice.parameters.give(spec.name, read_parameter(*value, spec));
    }
  }
  std::string const place = node.key() + ".parameters";
  try {
    choice.parameters = sensible(*found, choice.parameters);
  } catch (BadValue const& error) {
    throw parameter_complaint(error, found->info, node.file(), place + ".",
                              parameters ? &parameters->json() : nullptr);
  } catch (std::invalid_argument const& error) {
    throw UserError(node.file(), place, error.what(), "values for which the case has a solution");
  }
  return choice;
}

}  // namespace sphverify
