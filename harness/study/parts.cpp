// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/parts.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <tuple>

#include "harness/study/study_units.hpp"
#include "reports/user_error.hpp"

namespace sphverify {

namespace {

constexpr int most_parts = 1'000'000;

/// Longest ladders first, of each the longest unit first.
void sort_by_work(std::vector<StudyUnit>& units) {
  std::map<std::size_t, double> longest;
  for (StudyUnit const& unit : units) longest[unit.ladder] = std::max(longest[unit.ladder], unit.work);
  std::stable_sort(units.begin(), units.end(), [&](StudyUnit const& a, StudyUnit const& b) {
    return std::tuple(-longest[a.ladder], a.ladder, -a.work) < std::tuple(-longest[b.ladder], b.ladder, -b.work);
  });
}

}  // namespace

Part read_part(std::string const& text) {
  Part part{0, 0};
  char const* const end = text.data() + text.size();
  auto const first = std::from_chars(text.data(), end, part.number);
  bool const is_divided = first.ec == std::errc() && first.ptr != end && *first.ptr == '/';
  auto const second = is_divided ? std::from_chars(first.ptr + 1, end, part.of) : first;
  bool const is_read = is_divided && second.ec == std::errc() && second.ptr == end;
  if (!is_read || part.number < 1 || part.number > part.of || part.of > most_parts)
    throw UserError("study", "--part", text, "K/M with K from 1 to M, such as 1/4");
  return part;
}

std::vector<std::size_t> runs_of_part(Study const& study, std::vector<RunSpec> const& runs, Part part) {
  std::vector<StudyUnit> units = study_units(study, runs);
  sort_by_work(units);
  auto const parts = static_cast<std::size_t>(part.of);
  std::vector<double> of_all(parts, 0.0);
  std::vector<double> of_ladder(parts, 0.0);
  std::vector<std::size_t> chosen;
  for (std::size_t n = 0; n < units.size(); ++n) {
    if (n > 0 && units[n].ladder != units[n - 1].ladder) std::fill(of_ladder.begin(), of_ladder.end(), 0.0);
    std::size_t least = 0;
    for (std::size_t k = 1; k < parts; ++k) {
      if (std::tuple(of_ladder[k], of_all[k]) < std::tuple(of_ladder[least], of_all[least])) least = k;
    }
    of_ladder[least] += units[n].work;
    of_all[least] += units[n].work;
    if (least + 1 == static_cast<std::size_t>(part.number))
      chosen.insert(chosen.end(), units[n].runs.begin(), units[n].runs.end());
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

}  // namespace sphverify
