// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/scheme.hpp"

/// A sum that makes no sense, of everything that a formula may use; tests/cli/test_formulas.py has it once more.
struct Operations {
  static constexpr sphverify::SchemeInfo info{
      .id = "conduction/operations",
      .title = "Everything that a formula may use",
      .source = "a test",
      .equation = "sum_j of everything",
      .remarks = "a test",
      .rate = sphverify::Rate::conduction_heating,
      .reads = {sphverify::Field::density, sphverify::Field::temperature, sphverify::Field::conductivity,
                sphverify::Field::velocity},
      .kernel = {sphverify::KernelWeight::gradient, sphverify::KernelWeight::radial, sphverify::KernelWeight::value}};

  static auto pair(auto const& i, auto const& j, auto const& W) {
    auto const a = exp(-i.T()) + log(j.T()) + pow(i.K(), j.T()) + cbrt(j.K()) + tanh(i.T() - j.T()) + abs(i.T() - j.T());
    auto const b = select(i.T() < j.T(), 2.0 * i.T(), 3.0) + select(i.T() <= j.T(), 1.0, j.K()) +
                   select(i.K() > j.K(), i.K(), 0.5) + select(i.K() >= j.K(), 0.25, j.T()) + min(i.T(), j.K()) +
                   max(i.K(), j.T()) + select(i.T() == j.T(), i.T(), 2.0) + select(i.T() != j.T(), i.T(), 3.0);
    // Densities are divided by so often that they carry their inverse along.
    auto const c = sqrt(i.rho()) + pow(i.rho(), 1.5) + cbrt(j.rho()) + log(j.rho()) + exp(-i.rho()) + 2.0 * i.rho() -
                   (i.rho() - j.rho()) + max(i.rho(), j.rho()) - min(i.rho(), j.rho()) + i.rho() / j.rho() + 1.0 / i.rho() +
                   select(i.rho() < j.rho(), i.T(), 2.0) + (i.rho() + j.rho()) * i.T() + (i.T() - j.rho()) +
                   select(i.rho() <= j.rho(), i.T(), 2.0) + select(i.rho() > j.rho(), i.T(), 3.0) +
                   select(i.rho() >= j.rho(), i.T(), 4.0) + select(i.rho() == j.rho(), i.T(), 5.0) +
                   select(i.rho() != j.rho(), i.T(), 6.0) + select(i.rho() > 1.0, i.T(), 7.0) + abs(i.rho()) + tanh(j.rho()) +
                   max(i.rho(), 1.0) + min(j.rho(), i.T()) + pow(2.0, i.rho()) + select(i.T() < j.T(), i.rho(), j.rho());
    auto const v = (-i.v() + 2.0 * j.v() - j.v() / 3.0 + i.v() * j.T()).eval();
    auto const d = v.dot(W.separation()) + v.squaredNorm() + W.h();
    // A tensor times a vector, two ways along: (a b^T) c = a (b.c).
    auto const t = outer(W.separation(), W.gradient());
    auto const e = (t * v).dot(v) + (2.0 * t - t + t).trace() + (t * W.gradient()).dot(v) + (t * 2.0 + -t).trace() +
                   (W.gradient() * 2.0 + (W.gradient() + W.gradient())).dot(v) + outer(W.gradient(), W.gradient()).trace() +
                   outer(W.gradient(), W.separation()).trace();
    return j.m() * ((a + b + c + d) * W.value() + e + W.gradient().dot(v) + W.distance() * W.radial());
  }
  static auto wall(auto const&, auto const&) { return 0.0; }
};
