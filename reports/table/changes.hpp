// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "reports/table/compare.hpp"
#include "reports/table/setting.hpp"

namespace sphverify {

/// A number, or a word, that another document has otherwise (docs/compare.md: the rules).
struct Change {
  Setting setting;
  std::string case_id;
  std::map<std::string, ParameterValue> parameters;
  std::string formulation;  ///< label
  std::string measure;
  int resolution = 0;
  std::string direction;                ///< `better`, `worse`, or `changed` where neither is meant
  std::string before_word, after_word;  ///< of a status or a verdict
  Number before, after, noise;
  double size = 0.0;  ///< by which changes are ordered: in powers of 2, infinite for a failure
};

/// What became of one measure over all series.
struct MeasureCount {
  std::string measure;
  int same = 0, within_noise = 0, better = 0, worse = 0, changed = 0;
};

/// What a document has otherwise than the first.
struct Changes {
  NamedResults const* before = nullptr;
  NamedResults const* after = nullptr;
  bool same_machine = false;  ///< same commit, compiler, flags and processor: the same runs repeat exactly
  int not_repeated = 0;       ///< numbers and words of the same runs that moved, those by load left out
  int in_both = 0;            ///< series and envelopes
  std::vector<std::string> only_before, only_after;
  std::vector<std::string> not_comparable;  ///< in both, but without a level or a range that is the same
  std::vector<std::string> unknown_noise;  ///< of which numbers differ by who knows what: the time error of a
                                           ///< run is not known
  std::vector<MeasureCount> counts;
  std::vector<Change> list;  ///< the largest first
};

/// Every document against the first. The documents must outlive the result.
std::vector<Changes> changes_of(std::vector<NamedResults> const& documents, std::string const& region,
                                std::string const& norm);

}  // namespace sphverify
