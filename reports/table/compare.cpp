// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/table/compare.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "reports/json/results_json.hpp"
#include "reports/table/sections.hpp"

namespace sphverify {

namespace {

Json context_json(NamedResults const& document) {
  Json json = {{"name", document.name}};
  json.update(to_json(document.results.context));
  return json;
}

bool is_wanted(Section const& section, CompareOptions const& options) {
  return options.section.empty() ? section.is_unasked : options.section == section.name;
}

std::string json(Comparison const& comparison) {
  CompareOptions const& options = comparison.options;
  Json document = {{"schema", "sphverify-comparison/1"},
                   {"region", options.region},
                   {"norm", options.norm.empty() ? "auto" : options.norm},
                   {"documents", Json::array()}};
  for (NamedResults const& one : comparison.documents) document["documents"].push_back(context_json(one));
  for (Section const& section : sections()) {
    if (section.is_unasked || is_wanted(section, options)) document[section.key] = section.json(comparison);
  }
  return document_text(document);
}

/// A file of commas holds one table.
std::string csv(Comparison const& comparison) {
  bool const has_envelopes =
      std::any_of(comparison.documents.begin(), comparison.documents.end(),
                  [](NamedResults const& document) { return !document.results.envelopes.empty(); });
  std::string wanted = comparison.options.section;
  if (wanted.empty()) wanted = comparison.rows.empty() && has_envelopes ? "envelopes" : "series";
  auto const section = std::find_if(sections().begin(), sections().end(),
                                    [&](Section const& one) { return one.name == wanted; });
  return section->csv(comparison);
}

std::string text(Comparison const& comparison) {
  CompareOptions const& options = comparison.options;
  std::vector<std::string> parts;
  std::vector<LegendEntry> marks;
  for (Section const& section : sections()) {
    if (!is_wanted(section, options)) continue;
    std::string part = section.text(comparison);
    if (part.empty()) continue;
    parts.push_back(std::move(part));
    for (LegendEntry& entry : section.legend()) marks.push_back(std::move(entry));
  }
  if (parts.empty()) {
    return options.section.empty() ? "No series: the study ran nothing.\n"
                                   : fmt::format("Nothing to show of {}.\n", options.section);
  }
  if (options.legend && !marks.empty()) parts.push_back(legend(marks, options.style));
  return fmt::format("{}", fmt::join(parts, "\n"));
}

}  // namespace

std::string compare(std::vector<NamedResults> const& documents, CompareOptions const& options) {
  Comparison const comparison{documents, options, series_rows(documents, options.region, options.norm)};
  if (options.style.format == TableFormat::csv) return csv(comparison);
  if (options.style.format == TableFormat::json) return json(comparison);
  return text(comparison);
}

}  // namespace sphverify
