// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cases/exact/require.hpp"
#include "cases/hydro/manufactured.hpp"

namespace sphverify {

/// The manufactured flow of a gas that conducts heat.
struct ManufacturedConductingGas {
  static CaseInfo info() {
    CaseInfo info = ManufacturedGas::info();
    info.id = "coupled/manufactured";
    info.title = "Manufactured smooth flow of a conducting gas between moving walls";
    info.equation = "as hydro/manufactured, with conduction of conductivity scale (1 + T/5)";
    info.walls += "; both prescribe the temperature";
    info.kind = CaseKind::coupled;
    info.parameters.insert(info.parameters.end() - 1, {"conductivity", "W/(m K)", "scale of K", 0.1});
    return info;
  }
  static AnyProblem problem(Parameters const& p) {
    return in_dimension(p.integer("dimension"), [&]<int Dim>() -> AnyProblem {
      using Point = Vector<Dim>;
      double const scale = exact::require_positive("conductivity", p.number("conductivity"));
      exact::GasManufactured<Dim> const exact(p.number("gamma"), scale);
      Problem<Dim> problem = manufactured_gas<Dim>(p, scale);
      problem.scalars[Field::temperature] = problem.scalars[Field::internal_energy];
      problem.vectors[Field::flux] = [exact](Point const& x, double t) { return exact.flux(x, t); };
      problem.conductivity = [exact](Point const&, double T) { return exact.conductivity(T); };
      problem.conductivity_depends_on_temperature = true;
      for (Wall<Dim>& wall : problem.walls) {
        wall.temperature = problem.scalars[Field::temperature];
        wall.conductivity = [exact](Point const& x, double t) {
          return exact.conductivity(exact.internal_energy(x, t));
        };
      }
      return problem;
    });
  }
};

}  // namespace sphverify
