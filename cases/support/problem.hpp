// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "cases/support/features.hpp"
#include "formulations/particles/domain.hpp"
#include "formulations/scheme.hpp"
#include "formulations/walls/walls.hpp"

namespace sphverify {

template <int Dim>
using ScalarFunction = std::function<double(Vector<Dim> const& x, double time)>;
template <int Dim>
using VectorFunction = std::function<Vector<Dim>(Vector<Dim> const& x, double time)>;

/// A shock of the exact solution that runs along the first axis, and the plateau of constant state behind it.
struct ShockFront {
  double position;                      ///< [m]
  double pressure_ahead;                ///< [Pa]
  double plateau_lower, plateau_upper;  ///< where the state is constant [m]
  double density, velocity, pressure;   ///< there
};

/// A case with its parameters put in: where the fluid is, what its walls prescribe, what drives it, and the
/// exact solution. The initial state is the exact solution at time 0. It knows nothing of particles or
/// formulations.
template <int Dim>
struct Problem {
  Domain<Dim> domain;            ///< [m]
  std::vector<Wall<Dim>> walls;  ///< planes on sides of the domain, in the order in which they are reported
  double final_time = 0.0;       ///< [s]; 0 where only rates are compared

  /// Exact fields, position and time in. The density among them must not depend on time in a frozen case.
  std::map<Field, ScalarFunction<Dim>> scalars;
  std::map<Field, VectorFunction<Dim>> vectors;

  /// K(x, T) [W/(m K)]; empty where nothing conducts.
  std::function<double(Vector<Dim> const& x, double temperature)> conductivity;
  bool conductivity_depends_on_temperature = false;

  /// Heating per unit mass that the case adds [W/kg]; empty where there is none.
  ScalarFunction<Dim> source;

  /// Force per unit mass that the case adds [m/s^2]; empty where there is none.
  VectorFunction<Dim> body_force;

  double gamma = 0.0;  ///< ratio of specific heats of the gas, P = (gamma - 1) rho e; 0 where nothing flows

  /// The shocks of the exact solution at a time, for what is measured at shocks; empty where there are none.
  std::function<std::vector<ShockFront>(double time)> shocks;

  /// Planes across the domain's first axis on which the initial density, velocity or internal energy jumps,
  /// or the conductivity of what stands still: their places along that axis [m], ascending, inside the
  /// domain. A particle whose cell one of them cuts gets what the cell holds.
  std::vector<double> initial_jumps{};

  /// Where the exact solution is not smooth at a time; empty where it is smooth everywhere, always.
  std::function<Features<Dim>(double time)> features{};

  /// Exact rates at time 0, for the operator cases.
  VectorFunction<Dim> acceleration;
  std::map<Rate, ScalarFunction<Dim>> heating;

  /// Numbers that describe the exact solution at a time, such as the position of a front; `star.pressure` is
  /// the pressure of an object `star`. NaN where there is none.
  std::map<std::string, std::function<double(double time)>> landmarks;

  /// Why no particles run this case: what it says then is a reference only. Empty: they do.
  std::string not_run_because;

  /// Accuracy that the exact solution promises: of temperature or rates absolute, in their unit; of a gas
  /// relative to the largest density, pressure and speed.
  double accuracy = 0.0;

  /// Energy released at a point at the start [J]: it goes to the particles around the point, as much of it as
  /// the kernel about the point says.
  struct PointEnergy {
    Vector<Dim> place;
    double energy;
  };
  std::optional<PointEnergy> point_energy{};

  /// Whether the exact solution holds at a place and time, where it does not everywhere: beyond, a free
  /// surface that it does not know of has been felt. Errors are taken where it holds. Empty: everywhere.
  std::function<bool(Vector<Dim> const& x, double time)> holds{};

  /// Whether rates of heat conduction are affine in the temperatures: what conducts does not depend on them,
  /// and no wall loses heat by its own.
  bool conducts_linearly() const {
    return !conductivity_depends_on_temperature &&
           std::none_of(walls.begin(), walls.end(),
                        [](Wall<Dim> const& wall) { return wall.heat_loss.has_value(); });
  }
};

using AnyProblem = std::variant<Problem<1>, Problem<2>, Problem<3>>;

}  // namespace sphverify
