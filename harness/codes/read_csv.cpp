// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>

#include "harness/codes/csv.hpp"
#include "reports/json/places.hpp"
#include "reports/user_error.hpp"

namespace sphverify {

namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
constexpr std::size_t most_shown = 120;       // of a line, in a complaint
constexpr std::size_t most_candidates = 50;   // among which the nearest name is looked for
constexpr int digits_of_double = 15;          // with fewer a decimal number is coarser than double precision
constexpr std::size_t enough_to_judge = 10;   // different numbers of a column
constexpr std::array<std::string_view, 5> placed{"x", "y", "z", "m", "h"};

std::string_view without_blanks(std::string_view text) {
  std::size_t const first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return text.substr(text.size());  // empty, but still somewhere
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// A cell without blanks and quotation marks around it.
std::string_view trimmed(std::string_view text) {
  text = without_blanks(text);
  bool const is_quoted = text.size() >= 2 && text.front() == '"' && text.back() == '"';
  return is_quoted ? trimmed(text.substr(1, text.size() - 2)) : text;
}

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (std::size_t from = 0; from <= line.size();) {
    std::size_t const to = std::min(line.find(',', from), line.size());
    cells.push_back(trimmed(line.substr(from, to - from)));
    from = to + 1;
  }
  return cells;
}

std::optional<double> number_in(std::string_view cell) {
  if (!cell.empty() && cell.front() == '+') cell.remove_prefix(1);
  double value = 0.0;
  auto const [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (cell.empty() || end != cell.data() + cell.size()) return std::nullopt;
  if (error == std::errc::result_out_of_range) return std::strtod(std::string(cell).c_str(), nullptr);  // infinite, or 0
  return error == std::errc{} ? std::optional(value) : std::nullopt;
}

/// Of "-0.05100e-3" four: those from the first that is not 0.
int significant_digits(std::string_view cell) {
  int digits = 0;
  for (char const c : cell) {
    if (c == 'e' || c == 'E') break;
    if (c >= '0' && c <= '9' && (c != '0' || digits > 0)) ++digits;
  }
  return digits;
}

/// How finely a column is written.
struct Digits {
  int most = 0;
  std::set<std::string_view> different;  ///< up to as many as are needed

  void see(std::string_view cell) {
    most = std::max(most, significant_digits(cell));
    if (different.size() < enough_to_judge) different.insert(cell);
  }
  /// Relative; 0: double precision, or too few numbers to tell.
  double rounding() const {
    bool const is_known = different.size() >= enough_to_judge && most > 0 && most < digits_of_double;
    return is_known ? 0.5 * std::pow(10.0, 1 - most) : 0.0;
  }
};

/// A column of ours and where it stands in the lines.
struct Wanted {
  std::string column;
  std::size_t cell;
  Digits digits{};
};

class Reader {
 public:
  Reader(std::string const& path, std::map<std::string, std::string> const& names) : path_(path), names_(names) {}

  Snapshot read() {
    std::string const text = contents();
    std::string_view rest = text;
    if (rest.starts_with(byte_order_mark)) rest.remove_prefix(byte_order_mark.size());
    while (!rest.empty()) {
      ++line_;
      std::size_t const end = std::min(rest.find('\n'), rest.size());
      raw_line_ = rest.substr(0, end);
      std::string_view const line = without_blanks(raw_line_);
      rest.remove_prefix(std::min(end + 1, rest.size()));
      if (line.empty()) continue;
      if (line.front() == '#') {
        read_comment(line.substr(1));
      } else if (wanted_.empty()) {
        read_names(line);
      } else {
        read_particle(line);
      }
    }
    if (wanted_.empty()) throw UserError(path_, "", "no line of names", "names such as x,vx,m,rho, then one line per particle");
    if (snapshot_.size() == 0) throw UserError(path_, "", "no particles", "one line per particle below the names");
    for (Wanted const& one : wanted_) {
      // Where particles are and what they weigh may well be short numbers.
      bool const is_placed = std::find(placed.begin(), placed.end(), one.column) != placed.end();
      double const rounding = one.digits.rounding();
      if (rounding > 0.0) snapshot_.rounding[one.column] = rounding;
      if (rounding > 0.0 && !is_placed) {
        snapshot_.remarks.push_back(fmt::format("{} has {} digits: errors below {:.1g} of it say nothing", one.column,
                                                one.digits.most, rounding));
      }
    }
    return std::move(snapshot_);
  }

 private:
  std::string contents() const {
    std::ifstream file(path_, std::ios::binary);
    std::ostringstream text;
    if (!file || !(text << file.rdbuf())) {
      bool const is_empty = file.good() && file.peek() == std::ifstream::traits_type::eof();
      throw UserError(path_, "", is_empty ? "an empty file" : "a file that cannot be read", "a snapshot");
    }
    return std::move(text).str();
  }

  /// @param what the piece of the line that is complained of
  [[noreturn]] void complain(std::string_view what, std::string const& key, std::string const& found, std::string const& expected) const {
    std::size_t const at = static_cast<std::size_t>(what.data() - raw_line_.data());
    throw UserError(place_text(path_, {line_, place_in(raw_line_, at).column}), key, found, expected);
  }

  /// "time = 0.05" among words.
  void read_comment(std::string_view text) {
    for (auto const& [name, value] : {std::pair{std::string_view("time"), &snapshot_.time}, {"gamma", &snapshot_.gamma}}) {
      std::string_view const said = trimmed(text);
      if (!said.starts_with(name)) continue;
      std::string_view const after = trimmed(said.substr(name.size()));
      if (!after.starts_with('=') && !after.starts_with(':')) continue;
      auto const number = number_in(trimmed(after.substr(1)));
      if (!number || !std::isfinite(*number))
        complain(after.substr(1), std::string(name), fmt::format("'{}'", after.substr(1)), "a number");
      *value = *number;
    }
  }

  void read_names(std::string_view line) {
    auto const cells = cells_of(line);
    if (cells.size() == 1 && line.find(';') != std::string_view::npos)
      complain(line.substr(line.find(';')), "", "names with ';' between them", "commas");
    if (std::all_of(cells.begin(), cells.end(), [](auto const& cell) { return number_in(cell).has_value(); }))
      complain(line, "", "numbers", "a line of names first, such as x,vx,m,rho");
    std::set<std::string_view> seen;
    for (auto const& cell : cells) {
      if (!cell.empty() && !seen.insert(cell).second) complain(cell, "", fmt::format("'{}' twice", cell), "every name once");
    }
    for (SnapshotColumn const& column : snapshot_columns) {
      auto const named = names_.find(std::string(column.name));
      std::string const name = named == names_.end() ? std::string(column.name) : named->second;
      auto const found = std::find(cells.begin(), cells.end(), name);
      if (found != cells.end()) {
        wanted_.push_back({std::string(column.name), static_cast<std::size_t>(found - cells.begin())});
      } else if (named != names_.end()) {
        complain(line, "map", fmt::format("no column '{}'", name), one_of(name, {cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(std::min(cells.size(), most_candidates))}));
      }
    }
    if (wanted_.empty()) {
      std::vector<std::string> known;
      for (SnapshotColumn const& column : snapshot_columns) known.emplace_back(column.name);
      bool const has_units = line.find('[') != std::string_view::npos || line.find('(') != std::string_view::npos;
      complain(line, "", fmt::format("names {}{}", line.substr(0, most_shown), line.size() > most_shown ? "..." : ""),
               fmt::format("{}{}", one_of(cells.front().substr(0, most_shown), known), has_units ? " without units; `map` says which is which" : ""));
    }
    width_ = cells.size();
    for (Wanted const& one : wanted_) snapshot_.columns[one.column];
  }

  void read_particle(std::string_view line) {
    // Only what is asked for is made a number.
    std::size_t cell = 0;
    std::size_t next = 0;
    row_.assign(wanted_.size(), {});
    for (std::size_t from = 0; from <= line.size(); ++cell) {
      std::size_t const to = std::min(line.find(',', from), line.size());
      for (next = 0; next < wanted_.size(); ++next) {
        if (wanted_[next].cell == cell) row_[next] = trimmed(line.substr(from, to - from));
      }
      from = to + 1;
    }
    // Some programs end every line with one more comma.
    bool const ends_with_comma = cell == width_ + 1 && line.back() == ',';
    if (cell != width_ && !ends_with_comma) {
      complain(line, "", fmt::format("{} values", cell),
               fmt::format("{}, one per name{}", width_,
                           cell > width_ ? " (a comma in place of a decimal point?)" : " (was the file cut short?)"));
    }
    for (std::size_t k = 0; k < wanted_.size(); ++k) {
      auto const value = number_in(row_[k]);
      if (!value) complain(row_[k], wanted_[k].column, fmt::format("'{}'", row_[k]), "a number");
      snapshot_.columns.at(wanted_[k].column).push_back(*value);
      wanted_[k].digits.see(row_[k]);
    }
  }

  std::string const& path_;
  std::map<std::string, std::string> const& names_;
  Snapshot snapshot_{.file = path_, .format = "csv"};
  std::vector<Wanted> wanted_;
  std::vector<std::string_view> row_;
  std::string_view raw_line_;
  std::size_t line_ = 0, width_ = 0;
};

}  // namespace

Snapshot read_csv_snapshot(std::string const& path, std::map<std::string, std::string> const& names) {
  return Reader(path, names).read();
}

std::string csv_text(Snapshot const& snapshot) {
  fmt::memory_buffer text;
  auto const out = std::back_inserter(text);
  if (snapshot.time) fmt::format_to(out, "# time = {}\n", *snapshot.time);
  if (snapshot.gamma) fmt::format_to(out, "# gamma = {}\n", *snapshot.gamma);
  std::vector<std::vector<double> const*> lists;
  for (SnapshotColumn const& column : snapshot_columns) {
    auto const found = snapshot.columns.find(std::string(column.name));
    if (found == snapshot.columns.end()) continue;
    fmt::format_to(out, "{}{}", lists.empty() ? "" : ",", column.name);
    lists.push_back(&found->second);
  }
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    for (std::size_t k = 0; k < lists.size(); ++k) fmt::format_to(out, "{}{}", k == 0 ? '\n' : ',', (*lists[k])[i]);
  }
  text.push_back('\n');
  return fmt::to_string(text);
}

}  // namespace sphverify
