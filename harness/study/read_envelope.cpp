// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/read_envelope.hpp"

#include <fmt/format.h>

#include "harness/study/parameter_complaint.hpp"
#include "harness/study/read_case.hpp"
#include "reports/json/case_number.hpp"

namespace sphverify {

namespace {

/// Refuses a parameter that a case does not have, or that cannot be driven.
RunSpec driven_to(Node const& node, RunSpec const& spec, EnvelopeChoice const& choice, double value) {
  try {
    return with_value(spec, choice, value);
  } catch (BadValue const& error) {
    node.at("parameter").complain(error.expected);
  }
}

void require_sensible_end(Node const& node, StudyCase const& one, EnvelopeChoice const& choice,
                          char const* end) {
  RunSpec const spec{one.scene_case, one.parameters, FormulationChoice(), "", Discretisation(), 0.0, 0, 0.0};
  Node const value = node.at(end);
  Parameters const driven = driven_to(node, spec, choice, read_case_number(value)).parameters;
  CaseInfo const& info = one.scene_case->info;
  try {
    sensible(*one.scene_case, driven);
  } catch (BadValue const& error) {
    bool const is_driven = parameter_of(error, info) == choice.parameter;
    value.complain(is_driven ? fmt::format("{} of {} to be {}", choice.parameter, info.id, error.expected)
                             : fmt::format("a {} of {} for which {} is {} (found {})", choice.parameter,
                                           info.id, error.quantity, error.expected, error.found));
  } catch (std::invalid_argument const& error) {
    value.complain(
        fmt::format("a {} for which {} has a solution: {}", choice.parameter, info.id, error.what()));
  }
}

/// The driven values stand in the place of what a case is given.
void require_not_given(Node const& node, StudyCase const& one, std::string const& parameter) {
  if (!one.parameters.is_given(parameter)) return;
  for (ParameterSpec const& spec : one.scene_case->info.parameters) {
    if (spec.name == parameter && spec.default_value != one.parameters.all().at(parameter))
      node.at("parameter")
          .complain("a parameter that no case is given: this drives it, from and to say where");
  }
}

}  // namespace

double read_smoothing_ratio(Node const& node) { return node.number_between(1e-3, 1e6); }

EnvelopeChoice read_envelope(Node const& node, Study const& study) {
  node.require_keys({"parameter", "from", "to", "scale", "bisections"});
  EnvelopeChoice choice;
  choice.parameter = node.at("parameter").string();
  choice.from = node.at("from").number();
  choice.to = node.at("to").number();
  if (auto const scale = node.find("scale"))
    choice.logarithmic = scale->word({"linear", "logarithmic"}) == "logarithmic";
  if (auto const bisections = node.find("bisections"))
    choice.bisections = static_cast<int>(bisections->integer(0, 60));
  if (choice.logarithmic && !(choice.from > 0.0 && choice.to > 0.0))
    node.at("scale").complain("linear, unless both ends are positive");
  if (choice.from == choice.to) node.at("to").complain("another value than from");
  if (choice.parameter == "smoothing_ratio") {
    for (char const* end : {"from", "to"}) read_smoothing_ratio(node.at(end));
    return choice;
  }
  if (choice.parameter == "amplitude") {
    for (char const* end : {"from", "to"}) node.at(end).number_between(0.0, 0.499999);
    for (LayoutChoice const& layout : study.layouts) {
      if (layout.id != "jittered")
        node.at("parameter").complain("jittered layouts only, which have an amplitude");
    }
    return choice;
  }
  for (StudyCase const& one : study.cases) {
    for (char const* end : {"from", "to"}) require_sensible_end(node, one, choice, end);
    require_not_given(node, one, choice.parameter);
  }
  return choice;
}

}  // namespace sphverify
