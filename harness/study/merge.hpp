// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "harness/study/study.hpp"
#include "reports/results.hpp"

namespace sphverify {

/// The results of a part, and where they are from.
struct NamedPart {
  std::string file;
  Results results;
};

/// What parts of a study are together.
struct Merged {
  Results results;                   ///< whole, with series, unless runs are missing
  std::vector<std::size_t> missing;  ///< runs (of an envelope: searches) that no part has, ascending
  std::string missing_text;          ///< the first few of them in words
  Study rest;                        ///< the study of these alone
};

/// Puts parts of one study together, as one process would have written it but for times and contexts. Throws UserError
/// unless all are parts of one study, of this build of the program, and no run is in two of them.
Merged merge_parts(std::vector<NamedPart> parts);

}  // namespace sphverify
