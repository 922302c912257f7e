// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/table/changes_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "reports/printable.hpp"
#include "reports/table/number_text.hpp"

namespace sphverify {

namespace {

constexpr std::size_t most_rows = 20;
constexpr std::size_t most_names = 5;
constexpr std::size_t narrowest_words = 30;  // columns
constexpr char const* where_all_are = "--section changes --format csv";

/// Names of series among those of their case in both documents: only what differs is said.
class SeriesNames {
 public:
  explicit SeriesNames(Changes const& changes) {
    std::map<std::string, std::vector<Setting>> settings;
    for (NamedResults const* document : {changes.before, changes.after}) {
      for (Series const& s : document->results.series) {
        settings[s.case_id].push_back(setting_of("", s));
        note(s.case_id, s.parameters);
      }
      for (Envelope const& e : document->results.envelopes) {
        settings[e.case_id].push_back({"", e.formulation, e.discretisation, 0.0, e.resolution});
        note(e.case_id, e.parameters);
      }
    }
    for (auto const& [case_id, members] : settings) names_.emplace(case_id, members);
  }

  std::string of(Change const& change) const {
    std::map<std::string, ParameterValue> said;
    for (auto const& [name, value] : change.parameters) {
      if (values_.at(change.case_id).at(name).size() > 1) said[name] = value;
    }
    std::string text = change.case_id;
    if (!said.empty()) text += " " + parameters_text(said);
    SettingNames const& names = names_.at(change.case_id);
    std::vector<std::string> const words = names.row(change.setting);
    return fmt::format("{}: {} {}", text, fmt::join(words, " "), names.column(change.setting));
  }

 private:
  void note(std::string const& case_id, std::map<std::string, ParameterValue> const& parameters) {
    for (auto const& [name, value] : parameters) {
      auto& values = values_[case_id][name];
      if (std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
    }
  }

  std::map<std::string, SettingNames> names_;  // by case: a gas differs from a frozen slab in much
  std::map<std::string, std::map<std::string, std::vector<ParameterValue>>> values_;
};

std::string size_text(Change const& change) {
  double const before = *change.before;
  double const after = *change.after;
  if (change.measure == "order") return fmt::format("{:+.2f}", after - before);
  if (before == 0.0) return "from 0";
  double const ratio = after / before;
  if (ratio > 0.5 && ratio < 2.0) return fmt::format("{:+.2g}%", 100.0 * (ratio - 1.0));
  return fmt::format("x{:.3g}", ratio);
}

/// The last column, of words, broken into lines where the table would be too wide, or below the rows where
/// little room is left for it.
void break_last_column(TextTable& table, std::size_t columns) {
  std::size_t taken = 0;
  for (std::size_t c = 0; c + 1 < table.header.size(); ++c) {
    std::size_t width = text_width(table.header[c]);
    for (auto const& row : table.rows) width = std::max(width, text_width(row[c]));
    taken += width + 2;
  }
  std::size_t const left = columns - std::min(columns, taken);
  if (left < narrowest_words) {
    table.note_name = table.header.back();
    table.header.pop_back();
    --table.label_columns;
    for (auto& row : table.rows) {
      table.notes.push_back(row.back());
      row.pop_back();
    }
    return;
  }
  std::vector<std::vector<std::string>> rows;
  for (auto& row : table.rows) {
    auto const lines = lines_of_words(row.back(), left);
    row.back() = lines.front();
    rows.push_back(std::move(row));
    for (std::size_t k = 1; k < lines.size(); ++k) {
      rows.emplace_back(table.header.size());
      rows.back().back() = lines[k];
    }
  }
  table.rows = std::move(rows);
}

std::string show(TextTable table, std::size_t all, CompareOptions const& options) {
  std::size_t const shown = table.rows.size();
  if (options.style.format == TableFormat::table) break_last_column(table, options.style.columns);
  std::string text = render(table, options.style);
  if (shown < all) text += fmt::format("\nand {} more: {}\n", all - shown, where_all_are);
  return text + "\n";
}

/// Failures first, then verdicts.
std::string words_text(Changes const& changes, SeriesNames const& names, CompareOptions const& options) {
  TextTable table;
  table.title = "Words that changed";
  table.header = {"measure", "before", "after", "N", "series"};
  table.label_columns = table.header.size();
  std::size_t all = 0;
  for (Change const& change : changes.list) {
    if (change.before || ++all > most_rows) continue;
    table.rows.push_back({change.measure, change.before_word, change.after_word,
                          fmt::format("{}", change.resolution), names.of(change)});
  }
  return all == 0 ? "" : show(std::move(table), all, options);
}

std::string numbers_text(Changes const& changes, SeriesNames const& names, CompareOptions const& options) {
  TextTable table;
  table.title = "Numbers that changed beyond noise, the largest changes first";
  table.header = {"", "measure", "before", "after", "change", "noise", "N", "series"};
  table.label_columns = table.header.size();
  std::size_t all = 0;
  for (Change const& change : changes.list) {
    if (!change.before || ++all > most_rows) continue;
    table.rows.push_back({change.direction, change.measure, fmt::format("{:.3g}", *change.before),
                          fmt::format("{:.3g}", *change.after), size_text(change), scientific(change.noise),
                          fmt::format("{}", change.resolution), names.of(change)});
  }
  return all == 0 ? "" : show(std::move(table), all, options);
}

std::string counts_text(Changes const& changes, CompareOptions const& options) {
  TextTable table;
  table.title = "How many";
  table.header = {"measure", "same", "within noise", "better", "worse", "changed"};
  table.label_columns = table.header.size();
  for (MeasureCount const& count : changes.counts) {
    std::vector<std::string> cells{count.measure};
    for (int const n : {count.same, count.within_noise, count.better, count.worse, count.changed})
      cells.push_back(n == 0 ? "" : fmt::format("{}", n));
    table.rows.push_back(std::move(cells));
  }
  return render(table, options.style) + "\n";
}

std::string context_text(NamedResults const& document, std::size_t columns) {
  Context const& c = document.results.context;
  std::string flags = c.flags.substr(std::min(c.flags.find_first_not_of(' '), c.flags.size()));
  return indented_lines(fmt::format("{}: version {}, commit {}, {} {}, {}, {} cores, {}", document.name,
                                    c.version, c.commit, c.compiler, flags, c.processor, c.cores, c.date),
                        columns);
}

std::string names_text(std::vector<std::string> const& names, std::string const& what, std::size_t columns) {
  if (names.empty()) return "";
  std::string text = fmt::format("{} {}:\n", names.size(), what);
  for (std::size_t k = 0; k < std::min(names.size(), most_names); ++k)
    text += indented_lines("- " + printable(names[k]), columns) + "\n";
  if (names.size() > most_names) text += fmt::format("  and {} more\n", names.size() - most_names);
  return text;
}

}  // namespace

std::string changes_text(Changes const& changes, CompareOptions const& options) {
  bool const is_markdown = options.style.format == TableFormat::markdown;
  std::size_t const columns = options.style.columns;
  std::string const gap = is_markdown ? "\n\n" : "\n";
  std::string text = fmt::format("{}What changed: {} against {}{}", is_markdown ? "## " : "",
                                 changes.after->name, changes.before->name, gap);
  text += context_text(*changes.before, columns) + gap + context_text(*changes.after, columns) + gap;
  text += fmt::format("{} series in both, compared at their finest common level.\n", changes.in_both);
  text += names_text(changes.only_before, "only in " + changes.before->name, columns);
  text += names_text(changes.only_after, "only in " + changes.after->name, columns);
  text += names_text(changes.not_comparable, "in both, without a level or a range that is the same", columns);
  text += names_text(changes.unknown_noise, "whose numbers differ, and nobody knows the time error in them",
                     columns);
  if (changes.same_machine && changes.not_repeated > 0)
    text += hanging_lines("",
                          fmt::format("The same build on the same machine: {} numbers and words should have "
                                      "repeated exactly.",
                                      changes.not_repeated),
                          0, columns);
  text += "\n";
  if (changes.in_both == 0) return text;
  text += counts_text(changes, options);
  if (changes.list.empty())
    return text + (changes.unknown_noise.empty() ? "Nothing" : "Nothing else") + " changed beyond noise.\n";
  SeriesNames const names(changes);
  return text + words_text(changes, names, options) + numbers_text(changes, names, options);
}

std::string changes_csv(std::vector<Changes> const& changes) {
  TextTable table;
  table.header = {"results", "against", "case", "parameters", "formulation"};
  for (auto const& [name, value] : setting_words(Setting{})) table.header.push_back(name);
  for (char const* name : {"resolution", "measure", "direction", "before", "after", "noise"})
    table.header.emplace_back(name);
  for (Changes const& one : changes) {
    for (Change const& change : one.list) {
      std::vector<std::string> cells{one.after->name, one.before->name, change.case_id,
                                     parameters_text(change.parameters), change.formulation};
      for (auto& [name, value] : setting_words(change.setting)) cells.push_back(std::move(value));
      cells.push_back(fmt::format("{}", change.resolution));
      cells.push_back(change.measure);
      cells.push_back(change.direction);
      cells.push_back(change.before ? fmt::format("{}", *change.before) : change.before_word);
      cells.push_back(change.after ? fmt::format("{}", *change.after) : change.after_word);
      cells.push_back(change.noise ? fmt::format("{}", *change.noise) : "");
      table.rows.push_back(std::move(cells));
    }
  }
  return render(table, {TableFormat::csv});
}

Json changes_json(std::vector<Changes> const& changes) {
  Json all = Json::array();
  for (Changes const& one : changes) {
    Json entry = {{"results", one.after->name},
                  {"against", one.before->name},
                  {"same_build_and_machine", one.same_machine},
                  {"in_both", one.in_both},
                  {"only_before", one.only_before},
                  {"only_after", one.only_after},
                  {"not_comparable", one.not_comparable},
                  {"unknown_noise", one.unknown_noise},
                  {"counts", Json::array()},
                  {"changes", Json::array()}};
    for (MeasureCount const& c : one.counts) {
      entry["counts"].push_back({{"measure", c.measure},
                                 {"same", c.same},
                                 {"within_noise", c.within_noise},
                                 {"better", c.better},
                                 {"worse", c.worse},
                                 {"changed", c.changed}});
    }
    for (Change const& change : one.list) {
      Json item = {{"case", change.case_id},
                   {"parameters", parameters_text(change.parameters)},
                   {"formulation", change.formulation}};
      for (auto const& [name, value] : setting_words(change.setting)) item[name] = value;
      item["resolution"] = change.resolution;
      item["measure"] = change.measure;
      item["direction"] = change.direction;
      item["before"] = change.before ? Json(*change.before) : Json(change.before_word);
      item["after"] = change.after ? Json(*change.after) : Json(change.after_word);
      item["noise"] = change.noise ? Json(*change.noise) : Json(nullptr);
      entry["changes"].push_back(std::move(item));
    }
    all.push_back(std::move(entry));
  }
  return all;
}

}  // namespace sphverify
