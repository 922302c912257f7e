// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <stdexcept>
#include <string>

#include "cases/conduction/slab_problem.hpp"
#include "cases/exact/box_series.hpp"
#include "cases/exact/require.hpp"
#include "cases/support/boxes.hpp"
#include "cases/support/case.hpp"

namespace sphverify {

/// What the square and the cube share: a box closed by walls on all sides, and a series of products.
template <int Dim>
struct ConductionBox {
  /// @param modes their default
  static CaseInfo info(std::string const& id, std::string const& title, std::string const& domain,
                       std::string const& series, std::string const& row,
                       std::vector<std::vector<double>> const& modes) {
    return {
        .id = id,
        .title = title,
        .source = "Carslaw & Jaeger 1959, chapters V and VI",
        .equation = "rho dT/dt = K lap T; T = left + (right - left) x + sum a " + series,
        .domain = domain,
        .walls =
            "on all sides; walls = dirichlet: they prescribe temperature, all modes are sines; mixed: "
            "x = 0 and x = 1 prescribe temperature, the others zero flux, the modes along them are cosines",
        .initial = "the solution at t = 0",
        .kind = CaseKind::conduction,
        .parameters = {{"walls", "", "dirichlet or mixed", std::string("dirichlet")},
                       {"left", "K", "temperature of the wall x = 0", 1.0},
                       {"right", "K", "temperature of the wall x = 1", 2.0},
                       {"modes", "", "[[" + row + ", amplitude a], ...], 0 allowed along cosines", modes},
                       {"conductivity", "W/(m K)", "K", 1.0},
                       {"density", "kg/m^3", "rho", 1.0},
                       {"final_time", "s", "end of the run", 0.05}}};
  }

  static AnyProblem problem(Parameters const& p, std::string const& row) {
    using Point = Vector<Dim>;
    double const conductivity = p.number("conductivity");
    double const density = p.number("density");
    bool const mixed = p.one_of("walls", {"dirichlet", "mixed"}) == "mixed";
    exact::BoxSeries<Dim> const exact(
        p.number("left"), p.number("right"), modes(p.table("modes"), row, mixed),
        mixed ? exact::BoxSides::insulated : exact::BoxSides::dirichlet, conductivity, density);
    Problem<Dim> problem;
    problem.domain = unit_box<Dim>();
    problem.walls = box_walls(problem.domain);
    problem.scalars[Field::density] = [density](Point const&, double) { return density; };
    problem.scalars[Field::temperature] = [exact](Point const& x, double t) {
      return exact.temperature(x, t);
    };
    problem.vectors[Field::flux] = [exact, conductivity](Point const& x, double t) -> Point {
      return -conductivity * exact.gradient(x, t);
    };
    problem.conductivity = [conductivity](Point const&, double) { return conductivity; };
    for (std::size_t w = 0; w < problem.walls.size(); ++w) {
      Wall<Dim>& wall = problem.walls[w];
      if (mixed && w >= 2) {
        wall.flux = [](Point const&, double) -> Point { return Point::Zero(); };
      } else {
        prescribe_temperature(problem, wall);
      }
    }
    problem.accuracy = exact.accuracy();
    problem.final_time = p.number("final_time");
    return problem;
  }

 private:
  /// [[number along each axis, ..., amplitude], ...] as modes; number 0 only along an axis of cosines.
  static std::vector<exact::BoxMode<Dim>> modes(std::vector<std::vector<double>> const& table,
                                                std::string const& row, bool has_cosines) {
    std::vector<exact::BoxMode<Dim>> modes;
    for (auto const& numbers : table) {
      std::string const place = "modes[" + std::to_string(modes.size()) + "]";
      if (numbers.size() != Dim + 1)
        throw BadValue(place, "[" + row + ", amplitude]", "a list of " + std::to_string(numbers.size()));
      exact::BoxMode<Dim> mode;
      mode.amplitude = numbers.back();
      for (std::size_t k = 0; k < Dim; ++k) {
        double const lowest = has_cosines && k > 0 ? 0.0 : 1.0;
        if (!(numbers[k] >= lowest && numbers[k] <= 1e6) || numbers[k] != std::floor(numbers[k])) {
          throw BadValue(place + "[" + std::to_string(k) + "]",
                         "a whole number from " + exact::brief(lowest) + " to 1e6", exact::brief(numbers[k]));
        }
        mode.numbers[k] = static_cast<int>(numbers[k]);
      }
      modes.push_back(mode);
    }
    return modes;
  }
};

/// A square closed by walls on all four sides.
struct ConductionSquare {
  static CaseInfo info() {
    return ConductionBox<2>::info("conduction/square", "Square between walls on all sides", "0 <= x, y <= 1",
                                  "sin(n pi x) {sin, cos}(m pi y) exp(-(n^2 + m^2) pi^2 K t/rho)", row,
                                  {{1.0, 1.0, 1.0}, {3.0, 2.0, 0.5}});
  }
  static AnyProblem problem(Parameters const& p) { return ConductionBox<2>::problem(p, row); }

 private:
  static constexpr char const* row = "n, m";
};

/// A cube closed by walls on all six sides.
struct ConductionCube {
  static CaseInfo info() {
    return ConductionBox<3>::info(
        "conduction/cube", "Cube between walls on all sides", "0 <= x, y, z <= 1",
        "sin(n pi x) {sin, cos}(m pi y) {sin, cos}(l pi z) exp(-(n^2 + m^2 + l^2) pi^2 K t/rho)", row,
        {{1.0, 1.0, 1.0, 1.0}, {2.0, 1.0, 3.0, 0.5}});
  }
  static AnyProblem problem(Parameters const& p) { return ConductionBox<3>::problem(p, row); }

 private:
  static constexpr char const* row = "n, m, l";
};

}  // namespace sphverify
