// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "harness/gate/measuring.hpp"

namespace sphverify {

namespace {

/// Rounding of a sum, or of many steps that add up, as a part of its largest term.
constexpr double rounding = 64.0 * std::numeric_limits<double>::epsilon();

Number part_of(Budget const& b, std::string const& what) {
  if (what == "pair_drift") return b.pair_drift;
  if (what == "wall_budget_defect") return b.wall_budget_defect;
  return b.drift;
}

}  // namespace

void measure_budget(Measuring& measuring, Measured& m) {
  Gate const& gate = measuring.gate;
  std::vector<Budget> budgets = m.run->momentum;
  std::set<std::string> known;
  if (!m.run->momentum.empty()) known.insert("momentum");
  for (auto const& [quantity, budget] : m.run->conservation) known.insert(quantity);
  m.problem = "no budget of " + gate.quantity;
  if (!measuring.name("quantity", gate.quantity, known)) return;
  m.problem.clear();
  if (gate.quantity != "momentum") budgets = {m.run->conservation.at(gate.quantity)};
  double scale = 0.0;
  for (Budget const& b : budgets)
    scale = std::max({scale, std::abs(b.initial), std::abs(b.final), std::abs(b.exchanged)});
  if (gate.quantity == "momentum") {
    // Walls that push against each other exchange nothing in sum.
    for (WallBudget const& wall : m.run->wall_budgets) {
      for (double const impulse : wall.prescribed_impulse) scale = std::max(scale, std::abs(impulse));
    }
  }
  Number worst;
  for (Budget const& b : budgets) {
    Number const part = part_of(b, gate.what);
    if (!part || !std::isfinite(*part)) {
      bool const is_open = std::isnan(b.exchanged);
      return put(m, std::nullopt, gate.what + (is_open ? " is null: what crossed the walls is not known" : " is null"));
    }
    worst = std::max(worst.value_or(0.0), std::abs(*part));
  }
  m.round_off = gate.relative ? rounding : rounding * scale;
  if (!gate.relative) return put(m, worst, gate.what + " is null");
  if (scale == 0.0 && worst == 0.0) return put(m, 0.0, "");
  put(m, scale > 0.0 ? Number(*worst / scale) : Number(), "nothing was there and nothing exchanged");
}

void measure_wall_flux(Measuring& measuring, Measured& m) {
  Gate const& gate = measuring.gate;
  std::set<std::string> walls;
  for (std::size_t k = 0; k < m.run->wall_flux.size(); ++k) walls.insert(fmt::format("{}", k));
  m.problem = walls.empty() ? "no flux through any wall is known" : "no flux of this wall";
  if (gate.wall && !measuring.name("wall", fmt::format("{}", *gate.wall), walls)) return;
  if (!measuring.name("measure", "wall_flux",
                      walls.empty() ? std::set<std::string>{} : std::set<std::string>{"wall_flux"})) {
    return;
  }
  m.problem.clear();
  Number worst;
  double round_off = 0.0;
  for (std::size_t k = 0; k < m.run->wall_flux.size(); ++k) {
    if (gate.wall && *gate.wall != k) continue;
    WallFlux const& wall = m.run->wall_flux[k];
    double const unit = gate.relative ? wall.scale : 1.0;
    double const error = std::abs(wall.error) / unit;
    if (!std::isfinite(error)) return put(m, std::nullopt, fmt::format("wall {}: no error or no scale", k));
    worst = std::max(worst.value_or(0.0), error);
    double const largest = std::max({std::abs(wall.measured), std::abs(wall.exact), wall.scale});
    round_off = std::max(round_off, rounding * largest / unit);
  }
  put(m, worst, "no flux");
  m.round_off = round_off;
}

}  // namespace sphverify
