// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/codes/snapshot_options.hpp"

#include <algorithm>

#include "harness/codes/snapshot.hpp"
#include "harness/study/words.hpp"

namespace sphverify {

namespace {

constexpr Words<LengthConvention, 3> length_words{{{{"half-support", LengthConvention::half_support},
                                                    {"support", LengthConvention::support},
                                                    {"two-sigma", LengthConvention::two_sigma}}}};

/// {"temperature": "Temp", "position": ["px", "py"], "vx": "u"}: a quantity or one of its columns.
std::map<std::string, std::string> read_names(Node const& map) {
  std::vector<std::string> known;
  for (SnapshotColumn const& one : snapshot_columns) {
    if (std::find(known.begin(), known.end(), one.quantity) == known.end()) known.emplace_back(one.quantity);
  }
  for (SnapshotColumn const& one : snapshot_columns) known.emplace_back(one.name);
  map.require_keys(known);
  std::map<std::string, std::string> names;
  for (auto const& [key, node] : map.members()) {
    std::vector<std::string> columns;
    for (SnapshotColumn const& one : snapshot_columns) {
      if (one.name == key || one.quantity == key) columns.emplace_back(one.name);
    }
    auto const found = node.one_or_many();
    if (found.empty() || found.size() > columns.size())
      node.complain(columns.size() == 1 ? "a name in the files" : "names in the files, one per axis");
    for (std::size_t k = 0; k < found.size(); ++k) {
      if (!names.emplace(columns[k], found[k].string()).second)
        node.complain("every column named once: " + columns[k] + " is named before");
    }
  }
  return names;
}

std::vector<std::string> read_plane(Node const& node) {
  std::vector<std::string> axes;
  for (Node const& axis : node.one_or_many()) {
    axes.push_back(axis.word({"x", "y", "z"}));
    if (std::count(axes.begin(), axes.end(), axes.back()) > 1) axis.complain("every axis once");
  }
  if (axes.empty()) node.complain("axes of the files, such as [\"x\", \"z\"]");
  return axes;
}

}  // namespace

SnapshotOptions read_snapshot_options(Node const& object) {
  SnapshotOptions o;
  if (auto const node = object.find("format")) o.format = node->word(snapshot_formats);
  if (auto const node = object.find("map")) o.names = read_names(*node);
  if (auto const node = object.find("smoothing_length"))
    o.smoothing_length = length_words.value(node->word(length_words.all()));
  if (auto const node = object.find("gamma")) o.gamma = node->number_between(1.0 + 1e-9, 100.0);
  if (auto const node = object.find("specific_heat")) o.specific_heat = node->positive_number();
  if (auto const node = object.find("array")) o.array = node->string();
  if (auto const node = object.find("plane")) o.plane = read_plane(*node);
  if (auto const node = object.find("shift")) {
    o.shift = node->numbers();
    if (o.shift.empty() || o.shift.size() > 3) node->complain("one number per axis");
  }
  if (auto const node = object.find("precision")) o.is_single = node->word({"single", "double"}) == "single";
  if (auto const node = object.find("outside")) o.drops_outside = node->word({"refuse", "drop"}) == "drop";
  if (auto const node = object.find("density")) {
    if (node->is_string()) {
      o.sums_density = node->word({"file", "summation"}) == "summation";
    } else {
      node->require_keys({"eta"});
      o.density_from_h = node->at("eta").positive_number();
    }
  }
  return o;
}

Json to_json(SnapshotOptions const& o) {
  Json json = {{"format", o.format}};
  if (!o.names.empty()) json["map"] = o.names;
  if (o.smoothing_length != LengthConvention::as_format) json["smoothing_length"] = length_words.word(o.smoothing_length);
  if (o.gamma) json["gamma"] = *o.gamma;
  if (o.specific_heat != 1.0) json["specific_heat"] = o.specific_heat;
  if (!o.array.empty()) json["array"] = o.array;
  if (!o.plane.empty()) json["plane"] = o.plane;
  if (!o.shift.empty()) json["shift"] = o.shift;
  if (o.is_single) json["precision"] = "single";
  if (o.drops_outside) json["outside"] = "drop";
  if (o.sums_density) json["density"] = "summation";
  if (o.density_from_h) json["density"] = {{"eta", *o.density_from_h}};
  return json;
}

}  // namespace sphverify
