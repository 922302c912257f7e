// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/basics/square.hpp"
#include "formulations/scheme.hpp"

// momentum/p-rho2 and work/internal-energy in passes that only carry what these read, under names that both use for different
// things: rates must be theirs.
using sphverify::square;

/// Sums nothing: what it writes its `finish` makes of the particle alone.
struct OfItself {
  static auto pair(auto const&, auto const& j, auto const&) { return 0.0 * j.m(); }
  static auto wall(auto const&, auto const&) { return 0.0; }
};

struct MomentumByPasses {
  struct PerDensity : OfItself {
    static constexpr sphverify::PassInfo info{
        .name = "per-density", .writes = sphverify::Field::pass_number, .reads = {sphverify::Field::density}, .kernel = {}};
    static auto finish(auto const& i, auto const&) { return 1.0 / i.rho(); }
  };
  struct Pressure : OfItself {
    static constexpr sphverify::PassInfo info{
        .name = "pressure", .writes = sphverify::Field::pass_number_2, .reads = {sphverify::Field::pressure}, .kernel = {}};
    static auto finish(auto const& i, auto const&) { return i.P() * square(i.pass_number()); }
  };

  static constexpr sphverify::SchemeInfo info{.id = "momentum/by-passes",
                                              .title = "momentum/p-rho2 in passes",
                                              .source = "a test",
                                              .equation = "1/rho\nP/rho^2\nmomentum/p-rho2",
                                              .remarks = "a test",
                                              .rate = sphverify::Rate::acceleration,
                                              .reads = {sphverify::Field::density, sphverify::Field::pressure},
                                              .kernel = {sphverify::KernelWeight::gradient},
                                              .boundary = {sphverify::BoundaryValue::pressure},
                                              .conserves = {sphverify::Invariant::momentum},
                                              .first_passes = {PerDensity::info, Pressure::info},
                                              .work_partner = "work/by-passes",
                                              .claims = {.energy_with_partner = true},
                                              .supports_seen = 1};
  using passes = sphverify::PassList<PerDensity, Pressure>;

  static auto pair(auto const& i, auto const& j, auto const& W) {
    return (-j.m() * (j.pass_number_2() + i.pass_number_2()) * W.gradient()).eval();
  }
  static auto wall(auto const& i, auto const& B) {
    return (-(B.P() / square(B.rho()) + i.pass_number_2()) * B.rho() * B.S()).eval();
  }
};

struct WorkByPasses {
  struct Pressure : OfItself {
    static constexpr sphverify::PassInfo info{.name = "pressure",
                                              .writes = sphverify::Field::pass_number,
                                              .reads = {sphverify::Field::density, sphverify::Field::pressure},
                                              .kernel = {}};
    static auto finish(auto const& i, auto const&) { return i.P() / square(i.rho()); }
  };
  struct Velocity {
    static constexpr sphverify::PassInfo info{.name = "velocity",
                                              .writes = sphverify::Field::pass_vector,
                                              .reads = {sphverify::Field::velocity},
                                              .kernel = {sphverify::KernelWeight::gradient}};
    static auto pair(auto const&, auto const& j, auto const& W) { return (0.0 * j.m() * W.gradient()).eval(); }
    static auto wall(auto const&, auto const& B) { return (0.0 * B.S()).eval(); }
    static auto finish(auto const& i, auto const&) { return i.v(); }
  };

  static constexpr sphverify::SchemeInfo info{
      .id = "work/by-passes",
      .title = "work/internal-energy in passes",
      .source = "a test",
      .equation = "P/rho^2\nv\nwork/internal-energy",
      .remarks = "a test",
      .rate = sphverify::Rate::internal_work,
      .reads = {sphverify::Field::density, sphverify::Field::pressure, sphverify::Field::velocity},
      .kernel = {sphverify::KernelWeight::gradient},
      .boundary = {sphverify::BoundaryValue::pressure, sphverify::BoundaryValue::velocity},
      .first_passes = {Pressure::info, Velocity::info},
      .claims = {.lattice_factors = 1, .steady_on_any_particles = true},
      .supports_seen = 1};
  using passes = sphverify::PassList<Pressure, Velocity>;

  static auto pair(auto const& i, auto const& j, auto const& W) {
    return -j.m() * j.pass_number() * (j.pass_vector() - i.pass_vector()).dot(W.gradient());
  }
  static auto wall(auto const& i, auto const& B) { return -(B.P() / B.rho()) * (B.v() - i.pass_vector()).dot(B.S()); }
};
