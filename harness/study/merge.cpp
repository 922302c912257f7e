// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/merge.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <utility>

#include "harness/measure/machine.hpp"
#include "harness/measure/series.hpp"
#include "harness/measure/surface.hpp"
#include "harness/study/context.hpp"
#include "harness/study/expand.hpp"
#include "harness/study/same_run.hpp"

namespace sphverify {

namespace {

constexpr std::size_t most_named = 5;

/// A part's run of the study, or the runs of one of its envelopes.
struct Unit {
  std::string const* file;
  std::vector<RunRecord*> runs;
  Envelope const* envelope = nullptr;
};

std::string name_of(RunSpec const& run) {
  return fmt::format("{} on {} at resolution {}", run.label, run.scene_case->info.id, run.resolution);
}

void require_same_build(NamedPart const& part) {
  Context const ours = current_context();
  Context const& its = part.results.context;
  auto const require = [&](char const* key, std::string const& found, std::string const& expected) {
    if (found != expected)
      throw UserError(part.file, std::string("context.") + key, found, expected + ", which this program is, as all parts");
  };
  require("program", its.program, ours.program);
  require("version", its.version, ours.version);
  require("commit", its.commit, ours.commit);
  require("compiler", its.compiler, ours.compiler);
  require("flags", its.flags, ours.flags);
}

void require_same_study(NamedPart const& part, NamedPart const& first) {
  if (part.results.study != first.results.study)
    throw UserError(part.file, "study", "another study than that of " + first.file, "parts of one study");
  if (part.results.context.added != first.results.context.added)
    throw UserError(part.file, "context.added", fmt::format("{}", fmt::join(part.results.context.added, ", ")),
                    fmt::format("{}, as in {}", fmt::join(first.results.context.added, ", "), first.file));
}

/// The units of a part, by their number in the study.
std::map<std::size_t, Unit> units_of(NamedPart& part, Study const& study, std::vector<RunSpec> const& specs) {
  Results& results = part.results;
  std::vector<std::size_t> const& numbers = *results.part;
  std::size_t next = 0;
  std::map<std::size_t, Unit> units;
  auto const require = [&](bool holds, std::string const& found) {
    if (!holds) throw UserError(part.file, "part.runs", found, "the runs that this document holds, as the study has them");
  };
  if (study.envelope) require(results.envelopes.size() == numbers.size(), fmt::format("{} numbers for {} envelopes", numbers.size(), results.envelopes.size()));
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    require(numbers[k] < specs.size(), fmt::format("{} of {}", numbers[k], specs.size()));
    Unit unit{&part.file, {}, study.envelope ? &results.envelopes[k] : nullptr};
    std::size_t const count = unit.envelope ? unit.envelope->points.size() : 1;
    require(next + count <= results.runs.size(), fmt::format("{} numbers for {} runs", numbers.size(), results.runs.size()));
    for (std::size_t n = 0; n < count; ++n) unit.runs.push_back(&results.runs[next++]);
    require(unit.envelope || is_of(*unit.runs.front(), specs[numbers[k]]),
            fmt::format("{} for {} on {} at resolution {}", numbers[k], unit.runs.front()->label, unit.runs.front()->case_id,
                        unit.runs.front()->resolution));
    require(units.emplace(numbers[k], std::move(unit)).second, fmt::format("{} twice", numbers[k]));
  }
  require(next == results.runs.size(), fmt::format("{} numbers for {} runs", numbers.size(), results.runs.size()));
  return units;
}

/// The build's, and of the machines what all of them share.
Context common_context(std::vector<NamedPart> const& parts) {
  Context common = parts.front().results.context;
  std::vector<std::string> processors;
  for (NamedPart const& part : parts) {
    Context const& its = part.results.context;
    common.date = std::min(common.date, its.date);
    common.cores = std::max(common.cores, its.cores);
    if (std::find(processors.begin(), processors.end(), its.processor) == processors.end()) processors.push_back(its.processor);
    if (its.machine != parts.front().results.context.machine) common.machine.clear();
  }
  common.processor = fmt::format("{}", fmt::join(processors, " and "));
  return common;
}

}  // namespace

Merged merge_parts(std::vector<NamedPart> parts) {
  for (NamedPart const& part : parts) {
    if (!part.results.part)
      throw UserError(part.file, "part", "nothing: this is a whole study", "a part, of `study --part K/M` or of `merge --missing`");
    require_same_build(part);
    require_same_study(part, parts.front());
  }
  NamedPart const& first = parts.front();
  Json const document = Json::parse(first.results.study);
  Study study = read_study(Node(document, first.file, "study"));
  Expansion const expansion = expand(study);
  std::map<std::size_t, Unit> units;
  Merged merged;
  for (NamedPart& part : parts) {
    for (auto& [number, unit] : units_of(part, study, expansion.runs)) {
      auto const [known, is_new] = units.emplace(number, std::move(unit));
      if (!is_new)
        throw UserError(part.file, "part.runs", fmt::format("run {} ({}), which {} has, too", number, name_of(expansion.runs[number]), *known->second.file),
                        "every run in one part");
    }
    merged.results.shares.push_back({part.results.context, part.results.runs.size()});
  }
  std::vector<std::string> named;
  for (std::size_t k = 0; k < expansion.runs.size(); ++k) {
    if (units.contains(k)) continue;
    merged.missing.push_back(k);
    if (named.size() < most_named) named.push_back(fmt::format("{} ({})", k, name_of(expansion.runs[k])));
  }
  merged.missing_text = fmt::format("{}", fmt::join(named, ", "));
  if (merged.missing.size() > most_named) merged.missing_text += fmt::format(" and {} more", merged.missing.size() - most_named);
  merged.rest = study;
  merged.rest.runs = merged.missing;
  if (!merged.missing.empty()) return merged;

  Results& results = merged.results;
  results.context = common_context(parts);
  results.study = first.results.study;
  results.skipped = expansion.skipped;
  for (auto const& [number, unit] : units) {
    for (RunRecord* run : unit.runs) results.runs.push_back(std::move(*run));
    if (unit.envelope) results.envelopes.push_back(*unit.envelope);
  }
  if (!study.envelope) {
    results.series = build_series(results.runs, own_cores());
    results.surfaces = build_surfaces(results.runs);
  }
  return merged;
}

}  // namespace sphverify
