// SPDX-License-Identifier: 0BSD
// A momentum form and its energy equation that sphverify does not have.
#pragma once

#include "formulations/scheme.hpp"

/// Pressure gradient with the geometric mean of the densities (Monaghan 1992, Annu. Rev. Astron. Astrophys. 30, 543;
/// Wadsley et al. 2017, MNRAS 471, 2357), with wall terms in the manner of Campbell 1989.
///
///   a_i = -sum_j m_j (P_i + P_j)/(rho_i rho_j) grad_i W_ij - (P_i + P_B)/rho_i S_i   [m/s^2]
struct GeometricDensityAverage {
  static constexpr sphverify::SchemeInfo info{
      .id = "momentum/gdf",
      .title = "Pressure gradient with the geometric mean of the densities",
      .source = "Monaghan 1992; Wadsley et al. 2017",
      .equation = "a_i = -sum_j m_j (P_i + P_j)/(rho_i rho_j) grad_i W_ij - (P_i + P_B)/rho_i S_i",
      .remarks = "An example of a scheme from outside.",
      .rate = sphverify::Rate::acceleration,
      .reads = {sphverify::Field::density, sphverify::Field::pressure},
      .kernel = {sphverify::KernelWeight::gradient},
      .boundary = {sphverify::BoundaryValue::pressure},
      .conserves = {sphverify::Invariant::momentum},
      .work_partner = "work/gdf",
      .claims = {.energy_with_partner = true}};

  static auto pair(auto const& i, auto const& j, auto const& W) {
    return (-j.m() * (i.P() + j.P()) / (i.rho() * j.rho()) * W.gradient()).eval();
  }
  static auto wall(auto const& i, auto const& B) { return (-(i.P() + B.P()) / i.rho() * B.S()).eval(); }
};

/// Its work on internal energy: with it internal plus kinetic energy is conserved between particles.
///
///   de_i/dt = sum_j m_j P_i/(rho_i rho_j) (v_i - v_j).grad_i W_ij + P_B/rho_i (v_i - v_B).S_i   [W/kg]
struct GeometricDensityAverageWork {
  static constexpr sphverify::SchemeInfo info{
      .id = "work/gdf",
      .title = "Work of compression, partner of momentum/gdf",
      .source = "Wadsley et al. 2017",
      .equation = "de_i/dt = sum_j m_j P_i/(rho_i rho_j) (v_i - v_j).grad_i W_ij + P_B/rho_i (v_i - v_B).S_i",
      .remarks = "An example of a scheme from outside.",
      .rate = sphverify::Rate::internal_work,
      .reads = {sphverify::Field::density, sphverify::Field::pressure, sphverify::Field::velocity},
      .kernel = {sphverify::KernelWeight::gradient},
      .boundary = {sphverify::BoundaryValue::pressure, sphverify::BoundaryValue::velocity},
      .claims = {.steady_on_any_particles = true}};

  static auto pair(auto const& i, auto const& j, auto const& W) {
    return j.m() * i.P() / (i.rho() * j.rho()) * (i.v() - j.v()).dot(W.gradient());
  }
  static auto wall(auto const& i, auto const& B) { return B.P() / i.rho() * (i.v() - B.v()).dot(B.S()); }
};
