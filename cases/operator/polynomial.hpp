// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cases/exact/profile.hpp"
#include "cases/operator/operator_problem.hpp"
#include "cases/support/case.hpp"

namespace sphverify {

/// Every scheme's rate on the polynomial x^degree + 1.
struct OperatorPolynomial {
  static CaseInfo info() {
    return {.id = "operator/polynomial",
            .title = "Rates on x^degree + 1; degree 0 is the constant state",
            .source = "differentiation",
            .equation =
                "f = x^degree + 1: P = T = f, v = f e_x, rho = K = 1; "
                "dv/dt = -f', work = -f f' (internal) or -(f f)' (total), heating = f''",
            .domain = "0 <= x <= 1, other axes periodic with period 1",
            .walls = "x = 0 and x = 1 prescribe pressure, velocity and temperature",
            .initial = "f, no time",
            .kind = CaseKind::rates,
            .parameters = {{"degree", "", "degree of the polynomial", 0.0, true},
                           {"dimension", "", "1, 2 or 3", 1.0, true}}};
  }
  static AnyProblem problem(Parameters const& p) {
    int const degree = p.integer("degree");
    if (degree < 0) throw BadValue("degree", "0 or more", std::to_string(degree));
    return in_dimension(p.integer("dimension"), [&]<int Dim>() -> AnyProblem {
      return operator_problem<Dim>(exact::PolynomialProfile(degree));
    });
  }
};

}  // namespace sphverify
