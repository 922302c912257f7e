// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/evaluate/against.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "formulations/rate_operator.hpp"
#include "reports/json/lists_json.hpp"
#include "reports/listed_identifiers.hpp"

namespace sphverify {

namespace {

/// One number or vector per particle.
std::vector<std::vector<double>> read_list(Node const& node) {
  std::vector<std::vector<double>> list;
  for (Node const& one : node.elements()) {
    if (one.is_array()) {
      list.push_back(one.numbers());
    } else {
      list.push_back({one.number()});
    }
  }
  return list;
}

double length(std::vector<double> const& v) {
  double squares = 0.0;
  for (double const c : v) squares = std::hypot(squares, c);
  return squares;
}

/// Why ours has no such list; empty if it has.
std::string why_not_comparable(Json const& ours, RateComparison const& one) {
  Json const& rates = ours.at("rates");
  if (!rates.contains(one.scheme)) {
    Json const& left_out = ours.at("left_out");
    if (left_out.contains(one.scheme)) return left_out.at(one.scheme).get<std::string>();
    std::vector<std::string> known{"viscosity/monaghan", "viscosity/riemann"};
    for (SchemeInfo const* scheme : all_scheme_infos()) known.emplace_back(scheme->id);
    return "sphverify has no such rates: " + one_listed_by("sphverify list formulations", one.scheme, known);
  }
  Json const& found = rates.at(one.scheme);
  if (!found.contains(one.quantity)) {
    std::string names;
    for (auto const& [name, list] : found.items()) names += (names.empty() ? "" : ", ") + name;
    return "sphverify gives " + names;
  }
  return found.at(one.quantity).is_null() ? found.value("reason", "undefined on this state") : "";
}

void measure_difference(Node const& node, Json const& ours, double limit, RateComparison& one) {
  auto const theirs = read_list(node);
  Json const& reference = ours.at("rates").at(one.scheme).at(one.quantity);
  auto const expected = read_list(Node(reference, node.file(), node.key()));
  if (theirs.size() != expected.size()) {
    one.problem = fmt::format("{} particles, expected {}", theirs.size(), expected.size());
    return;
  }
  double largest = 0.0;
  double farthest = -1.0;
  for (std::size_t i = 0; i < theirs.size(); ++i) {
    if (theirs[i].size() != expected[i].size()) {
      one.problem = fmt::format("{} components of particle {}, expected {}", theirs[i].size(), i, expected[i].size());
      return;
    }
    std::vector<double> difference;
    for (std::size_t k = 0; k < theirs[i].size(); ++k) difference.push_back(theirs[i][k] - expected[i][k]);
    double const far = length(difference);
    largest = std::max(largest, length(expected[i]));
    one.l1 += far;
    one.l2 = std::hypot(one.l2, far);
    if (far <= farthest) continue;
    farthest = far;
    one.worst = i;
  }
  if (!std::isfinite(one.l1) || !std::isfinite(one.l2) || !std::isfinite(largest)) {
    one.problem = fmt::format("differences that are no numbers, the first at particle {}", one.worst);
    return;
  }
  auto const n = static_cast<double>(theirs.size());
  double const scale = largest > 0.0 ? largest : 1.0;
  one.l1 /= n * scale;
  one.l2 /= std::sqrt(n) * scale;
  one.linf = std::max(farthest, 0.0) / scale;
  one.theirs = theirs[one.worst];
  one.ours = expected[one.worst];
  // Where terms cancel, no sum is nearer than their rounding.
  Json const& rounding = ours.at("round_off");
  double const round_off = rounding.contains(one.scheme) && rounding.at(one.scheme).is_number()
                               ? rounding.at(one.scheme).get<double>()
                               : 0.0;
  one.holds = one.linf <= limit || farthest <= round_off;
}

}  // namespace

std::set<std::string> schemes_in(Node const& theirs) {
  std::set<std::string> schemes;
  for (auto const& [scheme, lists] : theirs.at("rates").members()) schemes.insert(scheme);
  if (schemes.empty()) theirs.at("rates").complain("one scheme or more");
  return schemes;
}

std::vector<RateComparison> compare_rates(Node const& theirs, Json const& ours, double limit) {
  std::vector<RateComparison> all;
  for (auto const& [scheme, lists] : theirs.at("rates").members()) {
    if (lists.members().empty()) lists.complain("lists of rates, such as \"heating\"");
    for (auto const& [quantity, node] : lists.members()) {
      if (quantity == "reason" || node.is_null()) continue;  // of a document of ours
      RateComparison one{.scheme = scheme, .quantity = quantity};
      one.problem = why_not_comparable(ours, one);
      if (one.problem.empty()) measure_difference(node, ours, limit, one);
      all.push_back(std::move(one));
    }
  }
  return all;
}

Json to_json(RateComparison const& one) {
  Json json = {{"scheme", one.scheme}, {"quantity", one.quantity}, {"holds", one.holds}};
  if (!one.problem.empty()) {
    json["problem"] = one.problem;
    return json;
  }
  json["l1"] = one.l1;
  json["l2"] = one.l2;
  json["linf"] = one.linf;
  json["worst"] = {{"particle", one.worst}, {"theirs", one.theirs}, {"ours", one.ours}};
  return json;
}

}  // namespace sphverify
