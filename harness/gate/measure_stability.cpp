// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/gate/measure.hpp"
#include "harness/gate/measuring.hpp"

namespace sphverify {

std::vector<Quantity<Stability>> const& stability_table() {
  static std::vector<Quantity<Stability>> const table{
      {"spectral_abscissa", [](Stability const& s) { return s.spectral_abscissa; }, "1/s"},
      {"spectral_radius", [](Stability const& s) { return s.spectral_radius; }, "1/s"},
      {"largest_stable_step", [](Stability const& s) { return s.largest_stable_step; }, "s"},
      {"growing_modes",
       [](Stability const& s) {
         return s.growing_modes ? Number(static_cast<double>(*s.growing_modes)) : Number();
       },
       ""}};
  return table;
}

std::vector<std::string> const& stability_quantities() {
  static std::vector<std::string> const names = [] {
    std::vector<std::string> all;
    for (auto const& quantity : stability_table()) all.emplace_back(quantity.name);
    return all;
  }();
  return names;
}

void measure_stability(Measuring& measuring, Measured& m) {
  Gate const& gate = measuring.gate;
  std::set<std::string> known;
  if (m.run->stability) known.insert("stability");
  if (!measuring.name("measure", "stability", known)) {
    m.problem = m.run->status == "ok" ? "stability was not measured" : failure(*m.run);
    return;
  }
  Stability const& stability = *m.run->stability;
  put(m, find_quantity(stability_table(), gate.quantity).value(stability),
      gate.quantity + " is null" + (stability.remark.empty() ? "" : ": " + stability.remark));
  if (gate.quantity == "spectral_abscissa") m.round_off = stability.abscissa_uncertainty;
}

}  // namespace sphverify
