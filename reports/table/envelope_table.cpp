// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/table/envelope_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "reports/table/number_text.hpp"

namespace sphverify {

namespace {

/// Distance from the hardest value: what is nearer held further, wherever the parameter begins.
double distance(EnvelopeRow const& row) {
  return row.held && row.to ? std::abs(*row.to - *row.held) : INFINITY;
}

/// One line of a table: the seeds of a layout, from the one that held least.
using Seeds = std::vector<EnvelopeRow const*>;

/// "0.113" or, of several seeds that differ, "0.113 .. 0.12".
std::string range(Seeds const& seeds, Number EnvelopeRow::*value) {
  auto const text = [&](EnvelopeRow const* row) {
    return row->*value ? fmt::format("{:.4g}", *(row->*value)) : std::string("none");
  };
  std::string const worst = text(seeds.front());
  std::string const best = text(seeds.back());
  return worst == best ? worst : worst + " .. " + best;
}

std::string how_it_failed(Seeds const& seeds) {
  std::vector<std::string> ways;
  for (EnvelopeRow const* row : seeds) {
    std::string const way = row->failed ? row->status : "held to the end";
    if (std::find(ways.begin(), ways.end(), way) == ways.end()) ways.push_back(way);
  }
  return fmt::format("{}", fmt::join(ways, ", "));
}

TextTable table_of(std::vector<EnvelopeRow> const& rows) {
  SettingNames const names({rows.begin(), rows.end()});
  std::vector<std::pair<std::vector<std::string>, Seeds>> lines;
  for (EnvelopeRow const& row : rows) {
    std::vector<std::string> key = names.row(row);
    key.push_back(names.column(row));
    auto const found =
        std::find_if(lines.begin(), lines.end(), [&](auto const& line) { return line.first == key; });
    if (found == lines.end()) {
      lines.push_back({std::move(key), {&row}});
    } else {
      found->second.push_back(&row);
    }
  }
  bool const has_seeds =
      std::any_of(lines.begin(), lines.end(), [](auto const& line) { return line.second.size() > 1; });

  EnvelopeRow const& first = rows.front();
  TextTable table;
  table.title = fmt::format("{}{}{}\nHow far {} could be driven towards {:g}, N = {}", first.case_id,
                            first.parameters.empty() ? "" : "\n  ", first.parameters, first.parameter,
                            first.to.value_or(NAN), first.resolution);
  table.header = names.header();
  for (char const* name : {"layout", "held to", "failed at", "how"}) table.header.emplace_back(name);
  if (has_seeds) table.header.emplace_back("seeds");
  table.label_columns = names.header().size() + 1;
  double nearest = INFINITY;
  for (auto& [key, seeds] : lines) {
    std::stable_sort(seeds.begin(), seeds.end(),
                     [](EnvelopeRow const* a, EnvelopeRow const* b) { return distance(*a) > distance(*b); });
    nearest = std::min(nearest, distance(*seeds.front()));
  }
  for (auto const& [key, seeds] : lines) {
    std::vector<std::string> cells = key;
    cells.push_back(range(seeds, &EnvelopeRow::held));
    cells.push_back(range(seeds, &EnvelopeRow::failed));
    cells.push_back(how_it_failed(seeds));
    if (has_seeds) cells.push_back(fmt::format("{}", seeds.size()));
    std::vector<bool> marks(cells.size(), false);
    marks[table.label_columns] =
        lines.size() > 1 && std::isfinite(nearest) && distance(*seeds.front()) == nearest;
    table.rows.push_back(std::move(cells));
    table.best.push_back(std::move(marks));
  }
  return table;
}

std::vector<std::pair<std::string, std::string>> words_of(EnvelopeRow const& row) {
  std::vector<std::pair<std::string, std::string>> words{{"results", row.document},
                                                         {"case", row.case_id},
                                                         {"parameters", row.parameters},
                                                         {"formulation", row.formulation}};
  for (auto& choice : setting_words(row)) words.push_back(std::move(choice));
  words.insert(words.end(), {{"seed", fmt::format("{}", row.discretisation.layout.seed)},
                             {"resolution", fmt::format("{}", row.resolution)},
                             {"parameter", row.parameter},
                             {"status", row.status},
                             {"reason", row.reason}});
  return words;
}

std::vector<std::pair<std::string, Number>> numbers_of(EnvelopeRow const& row) {
  return {{"to", row.to}, {"held", row.held}, {"failed", row.failed}};
}

}  // namespace

std::vector<EnvelopeRow> envelope_rows(std::vector<NamedResults> const& documents) {
  std::vector<EnvelopeRow> rows;
  for (NamedResults const& document : documents) {
    for (Envelope const& envelope : document.results.envelopes) {
      EnvelopeRow& row = rows.emplace_back();
      row.document = document.name;
      row.choice = envelope.formulation;
      row.discretisation = envelope.discretisation;
      row.case_id = envelope.case_id;
      row.parameters = parameters_text(envelope.parameters);
      row.formulation = envelope.label;
      row.parameter = envelope.parameter;
      row.resolution = envelope.resolution;
      row.held = envelope.held;
      row.failed = envelope.failed;
      row.status = envelope.status;
      row.reason = envelope.reason;
      if (!envelope.points.empty()) row.to = envelope.points.front().value;  // it is tried first
    }
  }
  return rows;
}

std::vector<TextTable> envelope_tables(std::vector<EnvelopeRow> const& rows) {
  auto const group_of = [](EnvelopeRow const& row) {
    return std::tuple(row.case_id, row.parameters, row.parameter, row.to, row.resolution);
  };
  std::vector<TextTable> tables;
  std::vector<bool> is_done(rows.size(), false);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (is_done[k]) continue;
    std::vector<EnvelopeRow> group;
    for (std::size_t other = k; other < rows.size(); ++other) {
      if (group_of(rows[other]) != group_of(rows[k])) continue;
      group.push_back(rows[other]);
      is_done[other] = true;
    }
    tables.push_back(table_of(group));
  }
  return tables;
}

std::vector<LegendEntry> envelopes_legend() {
  return {{"*", "held furthest"}, {"", "A range is that of the seeds, the worst first."}};
}

std::string envelopes_csv(std::vector<EnvelopeRow> const& rows) {
  TextTable table;
  for (auto const& [name, value] : words_of(EnvelopeRow{})) table.header.push_back(name);
  for (auto const& [name, value] : numbers_of(EnvelopeRow{})) table.header.push_back(name);
  for (EnvelopeRow const& row : rows) {
    auto& cells = table.rows.emplace_back();
    for (auto& [name, value] : words_of(row)) cells.push_back(std::move(value));
    for (auto const& [name, value] : numbers_of(row)) cells.push_back(value ? fmt::format("{}", *value) : "");
  }
  return render(table, {TableFormat::csv});
}

Json envelopes_json(std::vector<EnvelopeRow> const& rows) {
  Json all = Json::array();
  for (EnvelopeRow const& row : rows) {
    Json entry;
    for (auto const& [name, value] : words_of(row)) entry[name] = value;
    for (auto const& [name, value] : numbers_of(row)) entry[name] = value ? Json(*value) : Json(nullptr);
    all.push_back(std::move(entry));
  }
  return all;
}

}  // namespace sphverify
