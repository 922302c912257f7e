// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "cases/exact/require.hpp"
#include "cases/exact/riemann.hpp"
#include "cases/hydro/gas_features.hpp"
#include "cases/hydro/gas_problem.hpp"
#include "cases/support/case.hpp"

namespace sphverify {

/// Two uniform gases that meet: shock tubes.
struct RiemannProblem {
  /// The states of a name, [rho, u, P] left and right, with the time at which the literature looks at them.
  struct Preset {
    char const* name;
    exact::GasState left, right;
    double gamma, final_time;
  };
  /// Toro, Riemann Solvers and Numerical Methods for Fluid Dynamics, 3rd ed., Table 4.1 and section 4.3.3;
  /// Sod, J. Comput. Phys. 27 (1978) 1; LeBlanc as in Loubere & Shashkov, J. Comput. Phys. 209 (2005) 105,
  /// its tube of length 9 scaled to 1.
  static constexpr std::array<Preset, 7> presets{{
      {"sod", {1.0, 0.0, 1.0}, {0.125, 0.0, 0.1}, 1.4, 0.2},
      {"toro-1", {1.0, 0.0, 1.0}, {0.125, 0.0, 0.1}, 1.4, 0.25},
      {"toro-2", {1.0, -2.0, 0.4}, {1.0, 2.0, 0.4}, 1.4, 0.15},
      {"toro-3", {1.0, 0.0, 1000.0}, {1.0, 0.0, 0.01}, 1.4, 0.012},
      {"toro-4", {1.0, 0.0, 0.01}, {1.0, 0.0, 100.0}, 1.4, 0.035},
      {"toro-5", {5.99924, 19.5975, 460.894}, {5.99242, -6.19633, 46.0950}, 1.4, 0.035},
      {"leblanc", {1.0, 0.0, 0.0667}, {1e-3, 0.0, 6.67e-11}, 5.0 / 3.0, 0.5},
  }};

  static CaseInfo info() {
    return {.id = "hydro/riemann",
            .title = "Riemann problem: two uniform gases that meet",
            .source = "Toro, Riemann Solvers and Numerical Methods for Fluid Dynamics, 3rd ed., chapter 4",
            .equation = "exact solution of the Euler equations, a function of (x - interface)/t alone",
            .domain = "0 <= x <= 1, longer where the waves need more gas until the final time",
            .walls = "two pistons that move with the undisturbed gas",
            .initial = "left state for x < interface, right state beyond",
            .kind = CaseKind::hydro,
            .parameters = {{"preset", "",
                            "sod, toro-1 to toro-5, leblanc, each with its states and its gamma; or custom: "
                            "left, right, gamma",
                            std::string("sod")},
                           {"left", "", "[density, velocity, pressure]; makes the preset custom",
                            std::vector<double>{}},
                           {"right", "", "likewise; left and right go together", std::vector<double>{}},
                           {"gamma", "",
                            "ratio of specific heats, beside left and right only: a preset has its own", 1.4},
                           {"interface", "m", "where the gases meet", 0.5},
                           {"final_time", "s", "end of the run; 0: the preset's, 0.2 of custom states", 0.0}},
            .discontinuous = true};
  }

  static Preset states(Parameters const& p) {
    std::vector<std::string> names{"custom"};
    for (Preset const& preset : presets) names.emplace_back(preset.name);
    if (p.list("left").empty() && p.list("right").empty()) {
      std::string const& name = p.one_of("preset", names);
      if (name == "custom")
        throw BadValue("preset", "another, or custom beside left and right", "custom without them");
      return *std::find_if(presets.begin(), presets.end(),
                           [&](Preset const& one) { return one.name == name; });
    }
    // Two states make the preset custom without a word; who names another wants something else.
    if (p.is_given("preset") && p.one_of("preset", names) != "custom")
      throw BadValue("preset", "custom or none, since it has no effect beside left and right", "");
    double const gamma = exact::require_above("gamma", p.number("gamma"), 1.0);
    auto const state = [&](char const* side) -> exact::GasState {
      std::vector<double> const& values = p.list(side);
      if (values.size() != 3) {
        throw BadValue(side, "[density, velocity, pressure]",
                       values.empty() ? "nothing" : "a list of " + std::to_string(values.size()));
      }
      return {values[0], values[1], values[2]};
    };
    return {"custom", state("left"), state("right"), gamma, 0.2};
  }

  static AnyProblem problem(Parameters const& p) {
    Preset const states = RiemannProblem::states(p);
    exact::Riemann const riemann(states.left, states.right, states.gamma);
    double const interface = p.number("interface");
    if (!(interface > 0.0 && interface < 1.0)) {
      throw BadValue("interface", "between 0 and 1", exact::brief(interface));
    }
    double const end = exact::require_not_negative("final_time", p.number("final_time"));
    double const final_time = end > 0.0 ? end : states.final_time;
    auto const state = [=](double x, double t) {
      double const distance = x - interface;
      return riemann.at(t > 0.0 ? distance / t
                                : std::copysign(std::numeric_limits<double>::infinity(), distance));
    };
    // As much gas on either side as the waves run through, and a tenth more.
    auto const [left_head, left_tail, contact, right_tail, right_head] = riemann.waves();
    double const lower = std::min(0.0, interface + 1.1 * (left_head - states.left.velocity) * final_time);
    double const upper = std::max(1.0, interface + 1.1 * (right_head - states.right.velocity) * final_time);
    Problem<1> problem = gas_problem(state, slab<1>(lower, upper), states.gamma);
    problem.initial_jumps = {interface};
    prescribe_velocity(problem.walls[0], states.left.velocity);
    prescribe_velocity(problem.walls[1], states.right.velocity);
    if (!(states.left.density > 0.0 && states.right.density > 0.0)) {
      problem.not_run_because = "particles fill no vacuum: hydro/vacuum-release has gas beside one";
    }
    // In a vacuum there is no pressure, and no velocity to speak of.
    auto const star = riemann.star();
    problem.landmarks["star.pressure"] = [=](double) { return star ? star->pressure : 0.0; };
    problem.landmarks["star.velocity"] = [=](double) {
      return star ? star->velocity : std::numeric_limits<double>::quiet_NaN();
    };
    if (star) {
      auto const waves = riemann.waves();
      problem.shocks = [=](double t) {
        std::vector<ShockFront> fronts;
        double const middle = interface + waves.contact * t;
        if (star->pressure > states.left.pressure) {
          double const place = interface + waves.left_head * t;
          fronts.push_back({place, states.left.pressure, place, middle, star->density_left, star->velocity,
                            star->pressure});
        }
        if (star->pressure > states.right.pressure) {
          double const place = interface + waves.right_head * t;
          fronts.push_back({place, states.right.pressure, middle, place, star->density_right, star->velocity,
                            star->pressure});
        }
        return fronts;
      };
    }
    problem.features = [=](double t) {
      return riemann_features(riemann, states.left, states.right, states.gamma, interface, t);
    };
    problem.accuracy = riemann.accuracy();
    problem.final_time = final_time;
    return problem;
  }
};

}  // namespace sphverify
