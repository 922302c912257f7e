// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <variant>
#include <vector>

#include "formulations/pair_geometry.hpp"
#include "formulations/sweep/pair_sweep.hpp"
#include "formulations/viscosity/monaghan.hpp"
#include "formulations/viscosity/riemann.hpp"

namespace sphverify {

/// The law that says Pi_ij.
using Viscosity = std::variant<MonaghanViscosity, RiemannViscosity>;

inline bool is_on(Viscosity const& viscosity) {
  return std::visit([](auto const& law) { return law.is_on(); }, viscosity);
}

/// What viscosity adds to a gas, and what walls took part in.
template <int Dim>
struct ViscousRates {
  VectorField<Dim> acceleration;        ///< [m/s^2]
  std::vector<double> heating;          ///< of internal energy [W/kg]
  std::vector<double> largest_mu;       ///< largest |mu_ij|, or speed of approach, of each particle, for the step limit [m/s]
  std::vector<Vector<Dim>> wall_force;  ///< per wall, on the gas [N]
  std::vector<double> wall_power;       ///< per wall: what it gives to internal plus kinetic energy per time
};

/// Evaluates
///
///   a_i     = -sum_j m_j Pi_ij grad_i W_ij                       - Pi_iB rho_B S_i
///   de_i/dt = 1/2 sum_j m_j Pi_ij (v_i - v_j).grad_i W_ij        + Pi_iB rho_B (v_i - v_B).S_i
///
/// Pairs conserve momentum and internal plus kinetic energy. The wall terms are ours (docs/decisions/0020): of a
/// wall of prescribed velocity Pi_iB is the pair term with the particle's own image, 2d away (at least 0.1 h) and
/// closing in with 2 (v_i - v_B).n, and rho_B S_i the sum over all images. All of their heat stays in the gas,
/// so that a wall at rest gives it no energy. Where the wall moves as its closure says it has none: a closure
/// that does not return constants would rub against gas that moves along with the wall.
///
/// Pi_iB is the gas's viscous pressure q/rho^2 and the wall's, in the shares that the momentum form's wall term gives to the gas's
/// pressure and to P_B (SchemeInfo::wall_pressure_share). Of the wall's share goes what P_B has of it: all where P_B is prescribed
/// too; the wave's, up to that share, where Closure::one_sided has solved for it.
/// Reads density, velocity, sound speed, the contacts' velocity; for the wave pressure, the particles' and contacts'.
///
/// First the pairs, as a term of a sweep, which writes to `rates`.
/// @param viscosity must live until the sweep has run
template <int Dim>
void add_viscosity(Viscosity const& viscosity, Particles<Dim> const& particles, PairSweep<Dim>& sweep,
                   ViscousRates<Dim>& rates);
template <int Dim>
void add_viscosity(Viscosity const&&, Particles<Dim> const&, PairSweep<Dim>&, ViscousRates<Dim>&) = delete;

/// Then the walls, on top of what the sweep left in `rates`: their terms, or the pairs with what stands behind them.
/// @param share SchemeInfo::wall_pressure_share of the momentum form beside it
template <int Dim>
void add_viscous_walls(Viscosity const& viscosity, Particles<Dim> const& particles, PairGeometry<Dim>& geometry, Closure closure,
                       double share, double time, int threads, ViscousRates<Dim>& rates);

}  // namespace sphverify
