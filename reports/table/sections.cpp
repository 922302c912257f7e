// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/table/sections.hpp"

#include "reports/table/changes_table.hpp"
#include "reports/table/envelope_table.hpp"
#include "reports/table/levels.hpp"
#include "reports/table/series_numbers.hpp"
#include "reports/table/series_tables.hpp"
#include "reports/table/summary_numbers.hpp"
#include "reports/table/summary_text.hpp"
#include "reports/table/surface_table.hpp"

namespace sphverify {

namespace {

std::vector<SummaryGroup> groups_of(Comparison const& c) { return summary_of(c.rows, c.options.controls); }

std::vector<EnvelopeRow> envelopes_of(Comparison const& c) { return envelope_rows(c.documents); }

std::vector<Changes> all_changes_of(Comparison const& c) {
  return changes_of(c.documents, c.options.region, c.options.norm);
}

std::string envelopes_text(Comparison const& c) {
  std::string text;
  for (TextTable const& table : envelope_tables(envelopes_of(c)))
    text += (text.empty() ? "" : "\n") + render(table, c.options.style);
  return text;
}

std::string all_changes_text(Comparison const& c) {
  std::string text;
  for (Changes const& changes : all_changes_of(c))
    text += (text.empty() ? "" : "\n") + changes_text(changes, c.options);
  return text;
}

}  // namespace

std::vector<Section> const& sections() {
  static std::vector<Section> const all{
      {"summary", "summary", "each formulation at its best setting over all cases",
       [](Comparison const& c) { return summary_text(groups_of(c), c); },
       [](Comparison const& c) { return summary_csv(groups_of(c)); },
       [](Comparison const& c) { return summary_json(groups_of(c)); }, summary_legend},
      {"series", "series", "case by case, every setting", [](Comparison const& c) { return series_text(c); },
       [](Comparison const& c) { return series_csv(c.rows); },
       [](Comparison const& c) { return series_json(c.rows); }, series_legend},
      {"levels", "levels", "every run's errors in every region and norm",
       [](Comparison const& c) { return levels_text(level_rows(c.documents), c.options.style); },
       [](Comparison const& c) { return levels_csv(level_rows(c.documents)); },
       [](Comparison const& c) { return levels_json(level_rows(c.documents)); }, levels_legend, false,
       "it holds every region and norm"},
      {"envelopes", "envelopes", "how far a parameter could be driven", envelopes_text,
       [](Comparison const& c) { return envelopes_csv(envelopes_of(c)); },
       [](Comparison const& c) { return envelopes_json(envelopes_of(c)); }, envelopes_legend, true,
       "it holds no errors"},
      {"surface", "surfaces", "which h/dx is best at which N, and the cheapest path",
       [](Comparison const& c) { return surfaces_text(surface_rows(c.documents), c.options); },
       [](Comparison const& c) { return surfaces_csv(surface_rows(c.documents)); },
       [](Comparison const& c) { return surfaces_json(surface_rows(c.documents)); }, surface_legend, true,
       "an error surface is of region all, l1 where the solution jumps, l2 elsewhere"},
      {"changes", "changes", "of every document against the first", all_changes_text,
       [](Comparison const& c) { return changes_csv(all_changes_of(c)); },
       [](Comparison const& c) { return changes_json(all_changes_of(c)); },
       [] { return std::vector<LegendEntry>{}; }}};
  return all;
}

}  // namespace sphverify
