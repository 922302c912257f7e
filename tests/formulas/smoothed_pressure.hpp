// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/scheme.hpp"

/// A gradient of the pressure that the kernel has smoothed, whose two sums need the kernel's own value:
///
///   w_i = sum_j V_j W_ij + V_i W_ii,   p_i = (sum_j V_j P_j W_ij + V_i P_i W_ii)/w_i,   V = m/rho
///   a_i = -sum_j m_j (p_i + p_j)/(rho_i rho_j) grad_i W_ij
struct SmoothedPressure {
  struct Weight {
    static constexpr sphverify::PassInfo info{.name = "weight",
                                              .writes = sphverify::Field::pass_number,
                                              .reads = {sphverify::Field::density},
                                              .kernel = {sphverify::KernelWeight::value}};
    static auto pair(auto const&, auto const& j, auto const& W) { return j.m() / j.rho() * W.value(); }
    static auto wall(auto const&, auto const&) { return 0.0; }
    static auto finish(auto const& i, auto const& sum) { return sum + i.m() / i.rho() * i.W0(); }
  };
  struct Smoothed {
    static constexpr sphverify::PassInfo info{.name = "smoothed",
                                              .writes = sphverify::Field::pass_number_2,
                                              .reads = {sphverify::Field::density, sphverify::Field::pressure},
                                              .kernel = {sphverify::KernelWeight::value}};
    static auto pair(auto const&, auto const& j, auto const& W) { return j.m() / j.rho() * j.P() * W.value(); }
    static auto wall(auto const&, auto const&) { return 0.0; }
    static auto finish(auto const& i, auto const& sum) {
      return (sum + i.m() / i.rho() * i.P() * i.W0()) / i.pass_number();
    }
  };

  static constexpr sphverify::SchemeInfo info{.id = "momentum/smoothed-pressure",
                                              .title = "Gradient of a smoothed pressure",
                                              .source = "a test",
                                              .equation = "w_i\np_i\na_i",
                                              .remarks = "a test",
                                              .rate = sphverify::Rate::acceleration,
                                              .reads = {sphverify::Field::density},
                                              .kernel = {sphverify::KernelWeight::gradient},
                                              .conserves = {sphverify::Invariant::momentum},
                                              .first_passes = {Weight::info, Smoothed::info},
                                              .work_partner = "work/internal-energy"};
  using passes = sphverify::PassList<Weight, Smoothed>;

  static auto pair(auto const& i, auto const& j, auto const& W) {
    return (-j.m() * (i.pass_number_2() + j.pass_number_2()) / (i.rho() * j.rho()) * W.gradient()).eval();
  }
  static auto wall(auto const&, auto const& B) { return (0.0 * B.S()).eval(); }
};
