#pragma once

#include <algorithm>
#include <vector>

#include "formulations/pair_geometry.hpp"
#include "formulations/sweep/pair_sweep.hpp"

namespace sphverify {

/// Monaghan's artificial viscosity (Monaghan & Gingold, J. Comput. Phys. 52 (1983) 374; Monaghan, Annu. Rev.
/// Astron. Astrophys. 30 (1992) 543, Eqs. 4.1-4.3).
///
///   Pi_ij = (-alpha c_ij mu_ij + beta mu_ij^2)/rho_ij where a pair approaches, else 0
///   mu_ij = h_ij v_ij.r_ij/(r_ij^2 + 0.01 h_ij^2)
///
/// with the means c_ij, rho_ij, h_ij of a pair.  [mu] = m/s, Pi in Pa/(kg/m^Dim)^2.
struct MonaghanViscosity {
  double alpha = 0.0;  ///< weight of the term linear in the approach
  double beta = 0.0;   ///< weight of the quadratic one

  bool is_on() const { return alpha != 0.0 || beta != 0.0; }

  template <class Number>
  struct Pair {
    Number mu, Pi;
  };
  /// (r_ij^2 + 0.01 h_ij^2) rho_ij: what mu/rho is divided by. Apart, because divisions are the dearest part
  /// of a vectorised sweep, which finds this one's inverse together with others.
  template <class Number>
  static Number divisor(Number squared_distance, Number h, Number rho) {
    return (squared_distance + 0.01 * h * h) * rho;
  }

  /// @param approach v_ij.r_ij, negative where the two approach  [m^2/s]
  /// @param h, c, rho the pair's means
  /// @param divisor the above, as something to divide by
  template <class Number>
  Pair<Number> pair(Number approach, Number h, Number c, Number rho, auto const& divisor) const {
    using std::min;
    Number const mu_per_rho = h * min(approach, Number(0.0)) / divisor;
    Number const mu = rho * mu_per_rho;
    return {mu, (-alpha * c + beta * mu) * mu_per_rho};
  }
};

/// What viscosity adds to a gas, and what walls took part in.
template <int Dim>
struct ViscousRates {
  VectorField<Dim> acceleration;        ///< [m/s^2]
  std::vector<double> heating;          ///< of internal energy [W/kg]
  std::vector<double> largest_mu;       ///< largest |mu_ij| of each particle, for the step limit [m/s]
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
/// Pi_iB is the gas's viscous pressure q/rho^2 and the wall's, one half each. Of the wall's half goes what P_B has
/// of it: all where P_B is prescribed too; the wave's, up to that half, where Closure::one_sided has solved for it.
/// Reads density, velocity, sound speed, the contacts' velocity; for the wave pressure, the particles' and contacts'.
///
/// First the pairs, as a term of a sweep, which writes to `rates`.
template <int Dim>
void add_viscosity(MonaghanViscosity const& viscosity, Particles<Dim> const& particles, PairSweep<Dim>& sweep,
                   ViscousRates<Dim>& rates);

/// Then the walls, on top of what the sweep left in `rates`: their terms, or the pairs with what stands behind them.
template <int Dim>
void add_viscous_walls(MonaghanViscosity const& viscosity, Particles<Dim> const& particles,
                       PairGeometry<Dim>& geometry, Closure closure, double time, int threads,
                       ViscousRates<Dim>& rates);

}  // namespace sphverify
