// SPDX-License-Identifier: 0BSD
// A case that sphverify does not have.
#pragma once

#include <cmath>
#include <numbers>

#include "cases/support/case.hpp"

/// A wave of temperature in a ring, which conduction flattens:
///
///   T = mean + amplitude sin(2 pi n x) exp(-(2 pi n)^2 K t/rho)   with specific heat 1
struct DecayingWave {
  static sphverify::CaseInfo info() {
    return {.id = "conduction/decaying-wave",
            .title = "Wave of temperature in a ring",
            .source = "separation of variables",
            .equation = "rho dT/dt = K d2T/dx2; T = mean + amplitude sin(2 pi n x) exp(-(2 pi n)^2 K t/rho)",
            .domain = "0 <= x <= 1, periodic",
            .walls = "none",
            .initial = "the solution at t = 0",
            .kind = sphverify::CaseKind::conduction,
            .parameters = {{"mean", "K", "mean temperature", 2.0},
                           {"amplitude", "K", "of the wave", 1.0},
                           {"waves", "", "n, in the ring", 1.0, true},
                           {"conductivity", "W/(m K)", "K", 1.0},
                           {"density", "kg/m^3", "rho", 1.0},
                           {"final_time", "s", "end of the run", 0.02}},
            .remarks = "An example of a case from outside."};
  }

  static sphverify::AnyProblem problem(sphverify::Parameters const& p) {
    using Point = sphverify::Vector<1>;
    double const mean = p.number("mean"), amplitude = p.number("amplitude");
    double const conductivity = p.number("conductivity"), density = p.number("density");
    double const k = 2.0 * std::numbers::pi * p.integer("waves");
    if (!(conductivity > 0.0)) throw sphverify::BadValue("conductivity", "a positive number", std::to_string(conductivity));
    if (!(density > 0.0)) throw sphverify::BadValue("density", "a positive number", std::to_string(density));

    sphverify::Problem<1> problem;
    problem.domain = {.lower = Point(0.0), .upper = Point(1.0), .periodic = {true}};
    problem.final_time = p.number("final_time");
    problem.conductivity = [=](Point const&, double) { return conductivity; };
    problem.scalars[sphverify::Field::density] = [=](Point const&, double) { return density; };
    problem.scalars[sphverify::Field::temperature] = [=](Point const& x, double t) {
      return mean + amplitude * std::sin(k * x[0]) * std::exp(-k * k * conductivity * t / density);
    };
    problem.vectors[sphverify::Field::flux] = [=](Point const& x, double t) {
      return Point(-conductivity * amplitude * k * std::cos(k * x[0]) * std::exp(-k * k * conductivity * t / density));
    };
    problem.accuracy = 1e-14;
    return problem;
  }
};
