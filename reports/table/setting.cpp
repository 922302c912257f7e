// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/table/setting.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace sphverify {

namespace {

/// "brookshaw" for "conduction/brookshaw", "total" for "work/total-energy".
std::string without_room(std::string const& id) {
  std::string name = id.substr(id.find('/') + 1);
  std::string const energy = "-energy";
  if (name.ends_with(energy)) name.erase(name.size() - energy.size());
  return name;
}

std::set<std::string> forms_with_several(std::vector<Setting> const& settings,
                                         std::string FormulationChoice::*partner) {
  std::map<std::string, std::set<std::string>> partners;
  for (Setting const& s : settings) {
    if (!(s.choice.*partner).empty()) partners[s.choice.id].insert(s.choice.*partner);
  }
  std::set<std::string> forms;
  for (auto const& [id, names] : partners) {
    if (names.size() > 1) forms.insert(id);
  }
  return forms;
}

}  // namespace

Setting setting_of(std::string document, Series const& series) {
  Setting setting{std::move(document), series.formulation, series.discretisation, series.smoothing_exponent};
  for (OrderEntry const& order : series.orders) {
    for (SeriesLevel const& level : order.levels) {
      if (setting.first_resolution == 0 || level.resolution < setting.first_resolution)
        setting.first_resolution = level.resolution;
    }
  }
  return setting;
}

std::string smoothing_text(Setting const& setting) {
  std::string const ratio = fmt::format("h/dx {:g}", setting.discretisation.smoothing_ratio);
  if (setting.smoothing_exponent == 0.0) return ratio;
  std::string const first =
      setting.first_resolution == 0 ? "N0" : fmt::format("{}", setting.first_resolution);
  return fmt::format("{} (N/{})^{:g}", ratio, first, setting.smoothing_exponent);
}

std::string layout_name(LayoutChoice const& layout) {
  bool const has_distance = layout.id == "clumped" || layout.id == "touching";
  std::string const name = layout.id == "jittered" ? fmt::format("jitter {:g}", layout.amplitude)
                           : has_distance          ? fmt::format("{} {:g}", layout.id, layout.amplitude)
                                                   : layout.id;
  return layout.voronoi_masses ? name + ", Voronoi masses" : name;
}

std::string viscosity_name(ViscosityChoice const& v) {
  if (v.riemann) return "riemann";
  return v == ViscosityChoice{} ? "off" : fmt::format("{:g} {:g}", v.alpha, v.beta);
}

std::string parameters_text(std::map<std::string, ParameterValue> const& parameters) {
  std::vector<std::string> parts;
  for (auto const& [name, value] : parameters) {
    if (auto const* number = std::get_if<double>(&value))
      parts.push_back(fmt::format("{}={:g}", name, *number));
    if (auto const* word = std::get_if<std::string>(&value))
      parts.push_back(fmt::format("{}={}", name, *word));
    if (auto const* list = std::get_if<std::vector<double>>(&value))
      parts.push_back(fmt::format("{}={}", name, *list));
    if (auto const* table = std::get_if<std::vector<std::vector<double>>>(&value)) {
      parts.push_back(fmt::format("{}={}", name, *table));
    }
  }
  return fmt::format("{}", fmt::join(parts, " "));
}

std::vector<std::pair<std::string, std::string>> setting_words(Setting const& setting) {
  Discretisation const& d = setting.discretisation;
  return {{"kernel", d.kernel},
          {"pair_weight", d.pair_weight},
          {"density", d.density},
          {"layout", layout_name(d.layout)},
          {"face_weight", d.face_weight},
          {"closure", d.closure},
          {"integrator", d.integrator},
          {"wall_motion", d.wall_motion},
          {"smoothing", d.smoothing},
          {"viscosity", viscosity_name(d.viscosity)},
          {"smoothing_ratio", fmt::format("{:g}", d.smoothing_ratio)},
          {"smoothing_exponent", fmt::format("{:g}", setting.smoothing_exponent)}};
}

std::vector<SettingNames::Choice> const& SettingNames::choices() {
  auto const always = [](Setting const&) { return true; };
  auto const with_walls = [](Setting const& s) { return static_cast<bool>(s.choice.walls); };
  auto const with_face_weights = [](Setting const& s) { return s.choice.walls.are_terms() && s.discretisation.pair_weight == "kernel"; };
  static std::vector<Choice> const all{
      {"kernel", [](Setting const& s) { return s.discretisation.kernel; }, always},
      {"pair weight", [](Setting const& s) { return s.discretisation.pair_weight; }, always},
      {"density", [](Setting const& s) { return s.discretisation.density; }, always},
      {"face weight", [](Setting const& s) { return s.discretisation.face_weight; }, with_face_weights},
      {"closure", [](Setting const& s) { return s.discretisation.closure; }, with_walls},
      {"wall motion", [](Setting const& s) { return s.discretisation.wall_motion; }, with_walls},
      {"integrator", [](Setting const& s) { return s.discretisation.integrator; }, always},
      {"smoothing", [](Setting const& s) { return s.discretisation.smoothing; }, always},
      {"viscosity", [](Setting const& s) { return viscosity_name(s.discretisation.viscosity); }, always},
      {"results", [](Setting const& s) { return s.document; }, always}};
  return all;
}

SettingNames::SettingNames(std::vector<Setting> const& settings)
    : several_works_(forms_with_several(settings, &FormulationChoice::work)),
      several_conductions_(forms_with_several(settings, &FormulationChoice::conduction)) {
  for (Choice const& choice : choices()) {
    std::set<std::string> values;
    for (Setting const& s : settings) {
      if (choice.means_something(s)) values.insert(choice.of(s));
    }
    if (values.size() > 1) varying_.push_back(choice);
  }
  smoothing_varies_ = std::any_of(settings.begin(), settings.end(), [&](Setting const& s) {
    return s.discretisation.smoothing_ratio != settings.front().discretisation.smoothing_ratio ||
           s.smoothing_exponent != settings.front().smoothing_exponent;
  });
}

std::string SettingNames::formulation(Setting const& setting) const {
  FormulationChoice const& choice = setting.choice;
  std::string name = without_room(choice.id);
  if (!choice.work.empty() && several_works_.contains(choice.id)) name += " + " + without_room(choice.work);
  if (!choice.conduction.empty() && several_conductions_.contains(choice.id))
    name += " + " + without_room(choice.conduction);
  return choice.walls.are_terms() ? name : name + " (walls " + choice.walls.word + ")";
}

std::vector<std::string> SettingNames::row(Setting const& setting) const {
  std::vector<std::string> names{formulation(setting)};
  for (Choice const& choice : varying_) {
    names.push_back(choice.means_something(setting) ? choice.of(setting) : "");
  }
  return names;
}

std::vector<std::string> SettingNames::header() const {
  std::vector<std::string> names{"formulation"};
  for (Choice const& choice : varying_) names.emplace_back(choice.name);
  return names;
}

std::string SettingNames::column(Setting const& setting) const {
  std::string name = layout_name(setting.discretisation.layout);
  if (smoothing_varies_ || setting.smoothing_exponent != 0.0) name += ", " + smoothing_text(setting);
  return name;
}

}  // namespace sphverify
