// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "harness/study/study.hpp"

namespace sphverify {

/// One of the equal shares of a study's runs that several machines carry out, counted from 1.
struct Part {
  int number = 1;
  int of = 1;
};

/// Reads "K/M". Throws UserError unless 1 <= K <= M.
Part read_part(std::string const& text);

/// Which runs are a part's, ascending. Every run is in one part, runs that take turns when they are timed are in one, and
/// parts take about equally long: the longest first, each goes to the part that has least of its ladder, and least of all
/// among those. How long ladders take beside each other is not known before they are run, so that each is spread
/// over the parts. The same for everybody who asks.
std::vector<std::size_t> runs_of_part(Study const& study, std::vector<RunSpec> const& runs, Part part);

}  // namespace sphverify
