// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cases/exact/profile.hpp"
#include "cases/operator/operator_problem.hpp"
#include "cases/support/case.hpp"

namespace sphverify {

/// Every scheme's rate on offset + sin(k x + phase).
struct OperatorSine {
  static CaseInfo info() {
    return {.id = "operator/sine",
            .title = "Rates on offset + sin(k x + phase)",
            .source = "differentiation",
            .equation =
                "f = offset + sin(k x + phase): P = T = f, v = f e_x, rho = K = 1; "
                "dv/dt = -f', work = -f f' (internal) or -(f f)' (total), heating = f''",
            .domain = "0 <= x <= 1, other axes periodic with period 1",
            .walls = "x = 0 and x = 1 prescribe pressure, velocity and temperature",
            .initial = "f, no time",
            .kind = CaseKind::rates,
            .parameters = {{"wavenumber", "1/m", "k", 3.0},
                           {"phase", "", "phase at x = 0", 0.3},
                           {"offset", "", "mean of f; above 1 keeps it positive", 2.0},
                           {"dimension", "", "1, 2 or 3", 1.0, true}}};
  }
  static AnyProblem problem(Parameters const& p) {
    exact::SineProfile const profile(p.number("wavenumber"), p.number("phase"), p.number("offset"));
    return in_dimension(p.integer("dimension"),
                        [&]<int Dim>() -> AnyProblem { return operator_problem<Dim>(profile); });
  }
};

}  // namespace sphverify
