// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/html/page_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "reports/table/setting.hpp"

namespace sphverify::page {

namespace {

constexpr std::size_t fewest_points = 16;

std::string viscosity_text(ViscosityChoice const& v) {
  if (v.riemann) return "Riemann";
  return v == ViscosityChoice{} ? "off" : fmt::format("alpha {:g}, beta {:g}", v.alpha, v.beta);
}

/// "1.2", or of a refinement path "1.2 (N/25)^0.5".
std::string ratio_text(double ratio, double exponent, int first_resolution) {
  if (exponent == 0.0) return fmt::format("{:g}", ratio);
  return fmt::format("{:g} (N/{})^{:g}", ratio, first_resolution, exponent);
}

}  // namespace

Json number(double value) {
  if (!std::isfinite(value)) return nullptr;
  return std::strtod(fmt::format("{:.5g}", value).c_str(), nullptr);
}
Json number(Number const& value) { return value ? number(*value) : Json(nullptr); }

Json enough(Number const& resolution) {
  return resolution && *resolution < 1e9 ? Json(std::ceil(*resolution - 1e-9)) : number(resolution);
}

Json numbers(std::vector<double> const& values) {
  Json list = Json::array();
  for (double const value : values) list.push_back(number(value));
  return list;
}

Json Dictionary::operator()(std::string const& word) {
  auto const [place, is_new] = numbers_.try_emplace(word, numbers_.size());
  if (is_new) words_.push_back(word);
  return place->second;
}

Json Dictionary::or_null(std::string const& word) { return word.empty() ? Json(nullptr) : (*this)(word); }

std::vector<std::size_t> spread_evenly(std::size_t size, std::size_t count) {
  std::vector<std::size_t> indices;
  if (size <= count) {
    for (std::size_t i = 0; i < size; ++i) indices.push_back(i);
    return indices;
  }
  for (std::size_t i = 0; i < count; ++i) indices.push_back(i * (size - 1) / (count - 1));
  return indices;
}

Json picked(std::vector<double> const& values, std::vector<std::size_t> const& indices) {
  Json list = Json::array();
  for (std::size_t const i : indices) list.push_back(i < values.size() ? number(values[i]) : Json(nullptr));
  return list;
}

Json picked(std::vector<std::vector<double>> const& values, std::size_t k,
            std::vector<std::size_t> const& indices) {
  Json list = Json::array();
  for (std::size_t const i : indices) {
    bool const exists = i < values.size() && k < values[i].size();
    list.push_back(exists ? number(values[i][k]) : Json(nullptr));
  }
  return list;
}

std::size_t points_each(std::size_t most_numbers, std::size_t numbers_per_point) {
  return std::max(fewest_points, most_numbers / std::max<std::size_t>(1, numbers_per_point));
}

Json time_json(Number const& shortest, MedianSeconds const& m) {
  if (!m.median) return {number(shortest), nullptr, nullptr};
  return {number(m.median), number(m.low), number(m.high)};
}

Json settings_json(Discretisation const& d, double smoothing_exponent, int first_resolution,
                   Dictionary& word) {
  return {{"density", word(d.density)},
          {"closure", word(d.closure)},
          {"face weight", word(d.face_weight)},
          {"layout", word(layout_name(d.layout))},
          {"h/dx", word(ratio_text(d.smoothing_ratio, smoothing_exponent, first_resolution))},
          {"smoothing", word(d.smoothing)},
          {"viscosity", word(viscosity_text(d.viscosity))},
          {"wall motion", word(d.wall_motion)},
          {"integrator", word(d.integrator)},
          {"kernel", word(d.kernel)},
          {"pair weight", word(d.pair_weight)}};
}

void put_formulation(Json& json, FormulationChoice const& f, std::string const& label, Dictionary& word) {
  json["label"] = word(label);
  json["formulation"] = word(f.id);
  json["work"] = f.work.empty() ? Json(nullptr) : word(f.work);
  json["conduction"] = f.conduction.empty() ? Json(nullptr) : word(f.conduction);
  json["walls"] = f.walls.word;
}

}  // namespace sphverify::page
