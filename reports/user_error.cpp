// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/user_error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

#include "reports/json/places.hpp"
#include "reports/printable.hpp"

namespace sphverify {

UserError::UserError(std::string_view message) : std::runtime_error(printable(message)) {}

UserError::UserError(std::string_view file, std::string_view key, std::string_view found,
                     std::string_view expected)
    : UserError(key.empty() ? fmt::format("{}: found {}, expected {}", file, found, expected)
                            : fmt::format("{}: {}: found {}, expected {}", file_and_place(file, key), key, found, expected)) {}

namespace {

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      std::size_t const substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
    }
  }
  return row.back();
}

}  // namespace

std::string nearest(std::string_view word, std::vector<std::string> const& candidates) {
  std::string best;
  if (word.empty()) return best;  // was no text: nothing is near
  std::size_t best_distance = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (std::string const& candidate : candidates) {
    // A bare name is as near as its full identifier: 'brookshaw' means 'conduction/brookshaw'.
    std::size_t distance = edit_distance(word, candidate);
    if (auto const slash = candidate.find('/'); slash != std::string::npos) {
      distance = std::min(distance, edit_distance(word, std::string_view(candidate).substr(slash + 1)));
    }
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

std::string one_of(std::string_view found, std::vector<std::string> const& candidates) {
  std::string text = fmt::format("one of {}", fmt::join(candidates, ", "));
  if (std::string const near = nearest(found, candidates); !near.empty()) {
    text += fmt::format(" (did you mean '{}'?)", near);
  }
  return text;
}

}  // namespace sphverify
