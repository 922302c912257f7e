// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/envelope.hpp"

#include <cmath>

#include "cases/exact/bad_value.hpp"

namespace sphverify {

RunSpec with_value(RunSpec spec, EnvelopeChoice const& choice, double value) {
  if (choice.parameter == "smoothing_ratio") {
    spec.smoothing_ratio *= value / spec.discretisation.smoothing_ratio;
    spec.discretisation.smoothing_ratio = value;
  } else if (choice.parameter == "amplitude") {
    if (spec.discretisation.layout.id != "jittered")
      throw BadValue("amplitude", "one of a jittered layout", "");
    spec.discretisation.layout.amplitude = value;
  } else {
    auto const known = spec.parameters.all().find(choice.parameter);
    for (ParameterSpec const& parameter : spec.scene_case->info.parameters) {
      if (parameter.name != choice.parameter) continue;
      if (parameter.integer)
        throw BadValue(choice.parameter, "no whole number, which cannot be halved at will", "");
      if (known == spec.parameters.all().end())
        throw BadValue(choice.parameter,
                       "another one, since it has no effect beside the parameters of " +
                           spec.scene_case->info.id + " (it is: " + parameter.meaning + ")",
                       "");
    }
    if (known == spec.parameters.all().end() || !std::holds_alternative<double>(known->second)) {
      throw BadValue(choice.parameter,
                     "smoothing_ratio, amplitude or a number of " + spec.scene_case->info.id, "");
    }
    spec.parameters.give(choice.parameter, value);
  }
  return spec;
}

Envelope find_envelope(RunSpec const& spec, EnvelopeChoice const& choice,
                       std::function<RunRecord(RunSpec const& spec, int step)> const& run) {
  Envelope envelope;
  envelope.case_id = spec.scene_case->info.id;
  envelope.label = spec.label;
  envelope.parameter = choice.parameter;
  envelope.parameters = spec.parameters.all();
  envelope.parameters.erase(choice.parameter);
  envelope.formulation = spec.formulation;
  envelope.discretisation = spec.discretisation;
  envelope.resolution = spec.resolution;
  envelope.logarithmic = choice.logarithmic;
  envelope.status = "ok";
  auto const holds = [&](double value) {
    RunRecord const record = run(with_value(spec, choice, value), static_cast<int>(envelope.points.size()));
    envelope.points.push_back({value, record.status});
    if (record.status == "ok") {
      envelope.held = value;
      return true;
    }
    envelope.failed = value;
    envelope.status = record.status;
    envelope.reason = record.reason;
    return false;
  };
  if (holds(choice.to) || !holds(choice.from)) return envelope;
  for (int k = 0; k < choice.bisections; ++k) {
    double const middle = choice.logarithmic ? std::sqrt(*envelope.held) * std::sqrt(*envelope.failed)
                                             : 0.5 * (*envelope.held + *envelope.failed);
    holds(middle);
  }
  return envelope;
}

}  // namespace sphverify
