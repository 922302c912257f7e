// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <array>

#include "cases/support/case.hpp"
#include "formulations/particles/field.hpp"
#include "harness/gate/measure.hpp"
#include "harness/gate/measuring.hpp"
#include "reports/json/results_json.hpp"

namespace sphverify {

namespace {

/// The field that a case is about, the first of these that it has.
constexpr std::array<char const*, 4> leading_fields{"temperature", "velocity", "acceleration", "heating"};

/// Those that are not the case's defaults.
std::string describe_parameters(std::string const& case_id,
                                std::map<std::string, ParameterValue> const& parameters) {
  std::map<std::string, ParameterValue> special = parameters;
  if (Case const* const found = find_case(case_id)) {
    for (ParameterSpec const& spec : found->info.parameters) {
      auto const own = special.find(spec.name);
      if (own != special.end() && own->second == spec.default_value) special.erase(own);
    }
  }
  return special.empty() ? case_id : case_id + " " + parameters_json(special).dump();
}

std::string describe_layout(LayoutChoice const& layout, bool with_seed) {
  std::string text = layout.id;
  if (layout.amplitude > 0.0) text += fmt::format(" {:g}", layout.amplitude);
  if (with_seed && is_drawn(layout))
    text += fmt::format(" seed {}", layout.seed);
  if (layout.voronoi_masses) text += ", Voronoi masses";
  return text;
}

}  // namespace

std::string label_of(Gate const& gate) {
  std::string const relative = gate.relative ? "rel. " : "";
  switch (gate.measure) {
    case GateMeasure::order:
      return gate.limit.equals_word.empty() ? "order" : "ladder";
    case GateMeasure::error:
      return relative + gate.norm + " error";
    case GateMeasure::skill:
      return gate.norm + " error / doing nothing";
    case GateMeasure::time_error:
      return "time error share";
    case GateMeasure::conservation:
      return relative + gate.quantity + " " + gate.what;
    case GateMeasure::wall_flux:
      return relative + "wall flux error";
    case GateMeasure::status:
      return "status";
    case GateMeasure::stability:
      return gate.quantity;
    case GateMeasure::time_to_error:
      return "time ratio";
    case GateMeasure::cost:
      return gate.quantity + " ratio";
  }
  return "";
}

std::string unit_of(Gate const& gate, std::string const& field) {
  if (gate.relative) return "";
  if (gate.measure == GateMeasure::error) {
    for (FieldInfo const& info : field_infos) {
      if (info.name == field) return std::string(info.unit);
    }
  }
  if (gate.measure == GateMeasure::stability) return find_quantity(stability_table(), gate.quantity).unit;
  if (gate.measure == GateMeasure::wall_flux) return "W/m^2";
  if (gate.measure == GateMeasure::conservation)
    return gate.quantity == "mass" ? "kg" : gate.quantity == "momentum" ? "kg m/s" : "J";
  return "";
}

std::string field_of(Gate const& gate, Measured const& measured) {
  if (!gate.field.empty()) return gate.field;
  for (char const* field : leading_fields) {
    if (measured.run != nullptr) {
      if (measured.run->errors.contains(field)) return field;
      continue;
    }
    for (OrderEntry const& entry : measured.series->orders) {
      if (entry.field == field) return field;
    }
  }
  return "";
}

bool same_subject(Measured const& a, Measured const& b) {
  auto const same = [](auto const& x, auto const& y) {
    return x.case_id == y.case_id && x.parameters == y.parameters && x.formulation == y.formulation &&
           x.discretisation == y.discretisation && x.smoothing_exponent == y.smoothing_exponent;
  };
  if (a.run != nullptr && b.run != nullptr)
    return same(*a.run, *b.run) && a.run->resolution == b.run->resolution;
  return a.run == nullptr && b.run == nullptr && same(*a.series, *b.series);
}

std::string describe(Measured const& measured) {
  auto const text = [](auto const& s, bool with_seed) {
    Discretisation const& d = s.discretisation;
    return fmt::format("{}, {}, {}, density {}, {}, closure {}, h/dx {:g}, exponent {:g}",
                       describe_parameters(s.case_id, s.parameters), s.label,
                       describe_layout(d.layout, with_seed), d.density,
                       d.pair_weight == "kernel" ? "face weight " + d.face_weight : "pair weight " + d.pair_weight, d.closure,
                       d.smoothing_ratio, s.smoothing_exponent);
  };
  if (measured.run == nullptr) return text(*measured.series, false);
  return text(*measured.run, true) + fmt::format(", N = {}", measured.run->resolution);
}

}  // namespace sphverify
