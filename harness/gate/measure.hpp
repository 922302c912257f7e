// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "harness/gate/gates.hpp"

namespace sphverify {

std::vector<std::string> const& stability_quantities();
std::vector<std::string> const& cost_quantities();

/// What a gate looks at in a results document: one entry per selected run or series, in their order; empty if
/// the gate selects nothing. A run that is not `ok`, or a number that is null, is an entry with a problem.
/// Throws UserError for a name (field, region, quantity, ...) that exists in no selected run, and says what
/// does.
/// @param file the gates document, for complaints
std::vector<Measured> measure(Gate const& gate, Results const& results, std::string const& file);

/// The same of a baseline, in which a name that exists nowhere is an entry with a problem.
std::vector<Measured> measure_baseline(Gate const& gate, Results const& baseline);

/// How many runs or series a gate looks at in a results document, sound or not.
std::size_t count_selected(Gate const& gate, Results const& results);

/// What the number is, in words, such as "l2 error".
std::string label_of(Gate const& gate);

/// Of an absolute number; empty if it has none.
std::string unit_of(Gate const& gate, std::string const& field);

/// The field that a gate means on a run or series: its own, or else the one that the case is about.
std::string field_of(Gate const& gate, Measured const& measured);

/// Whether two entries, of this and another results document, are of the same run or series.
bool same_subject(Measured const& a, Measured const& b);

/// Case, formulation, discretisation and resolution of an entry, in one line.
std::string describe(Measured const& measured);

}  // namespace sphverify
