#pragma once

#include <functional>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "formulations/support/domain.hpp"
#include "formulations/support/scheme.hpp"
#include "formulations/support/walls.hpp"

namespace sphverify {

template <int Dim>
using ScalarFunction = std::function<double(Vector<Dim> const& x, double time)>;
template <int Dim>
using VectorFunction = std::function<Vector<Dim>(Vector<Dim> const& x, double time)>;

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

  /// Exact rates at time 0, for the operator cases.
  VectorFunction<Dim> acceleration;
  std::map<Rate, ScalarFunction<Dim>> heating;

  /// Numbers that describe the exact solution at a time, such as the position of a front.
  std::map<std::string, std::function<double(double time)>> landmarks;

  /// Absolute accuracy that the exact solution promises for its main field.
  double accuracy = 0.0;
};

using AnyProblem = std::variant<Problem<1>, Problem<2>, Problem<3>>;

}  // namespace sphverify
