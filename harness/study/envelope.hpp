// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "harness/run/run.hpp"

namespace sphverify {

/// A parameter to drive from where runs should hold to where they may fail.
struct EnvelopeChoice {
  std::string parameter;  ///< a number of the case, or `smoothing_ratio`, or `amplitude` of a jittered layout
  double from = 0.0, to = 0.0;
  bool logarithmic = false;
  int bisections = 6;
};

/// A run with another value of the parameter. Throws BadValue if it has no such parameter.
RunSpec with_value(RunSpec spec, EnvelopeChoice const& choice, double value);

/// Tries `to`; if that fails, `from`; if that holds, halves what lies between as often as asked for. A run
/// holds if its status is `ok`.
/// @param run carries out the run of a value; `step` counts those of this envelope
Envelope find_envelope(RunSpec const& spec, EnvelopeChoice const& choice,
                       std::function<RunRecord(RunSpec const& spec, int step)> const& run);

/// The most runs that an envelope takes.
constexpr int most_runs(EnvelopeChoice const& choice) { return 2 + choice.bisections; }

}  // namespace sphverify
