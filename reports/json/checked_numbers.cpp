// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/json/checked_numbers.hpp"

#include <fmt/format.h>

#include <limits>

#include "reports/json/lists_json.hpp"

namespace sphverify {

Number optional_number(Node const& node) { return node.is_null() ? Number() : Number(node.number()); }

std::string optional_string(Node const& node) { return node.is_null() ? "" : node.string(); }

std::uint64_t count(Node const& node) {
  return static_cast<std::uint64_t>(node.integer(0, std::numeric_limits<std::int64_t>::max()));
}

int read_resolution(Node const& node) {
  return static_cast<int>(node.at("resolution").integer(0, 100'000'000));
}

double size_of(Node const& node) {
  double const value = measured(node);
  if (value < 0.0) node.complain("a number of 0 or more");
  return value;
}

Number optional_size(Node const& node) { return node.is_null() ? Number() : Number(size_of(node)); }

Number found_number(Node const& node, char const* key) {
  auto const found = node.find(key);
  return found ? optional_number(*found) : Number();
}

std::pair<double, double> read_ends(Node const& node) {
  auto const ends = node.elements();
  if (ends.size() != 2) node.complain("[lower, upper]");
  std::pair<double, double> const interval{ends[0].number(), ends[1].number()};
  if (interval.first > interval.second)
    throw UserError(node.file(), node.key(), node.json().dump(), "[lower, upper], the lower end first");
  return interval;
}

MedianSeconds read_median(Node const& node) {
  auto const seconds = [&](char const* key) {
    auto const found = node.find(key);
    return found ? optional_size(*found) : Number();
  };
  MedianSeconds const m{seconds("median_seconds"), seconds("low_seconds"), seconds("high_seconds")};
  if (m.median && m.low && *m.low > *m.median)
    node.at("low_seconds").complain(fmt::format("at most median_seconds, {}", *m.median));
  if (m.median && m.high && *m.high < *m.median)
    node.at("high_seconds").complain(fmt::format("at least median_seconds, {}", *m.median));
  return m;
}

NormSet read_sizes(Node const& node) {
  return {size_of(node.at("l1")), size_of(node.at("l2")), size_of(node.at("linf"))};
}

NormSet read_norms(Node const& node) {
  NormSet const norms = read_sizes(node);
  constexpr double rounding = 1.0 + 1e-6;
  if (norms.l1 > norms.l2 * rounding) node.at("l1").complain(fmt::format("at most l2, {}", norms.l2));
  if (norms.l2 > norms.linf * rounding) node.at("l2").complain(fmt::format("at most linf, {}", norms.linf));
  return norms;
}

}  // namespace sphverify
