// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "formulations/basics/flag_set.hpp"
#include "formulations/neighbours/cell_grid.hpp"
#include "formulations/particles/particles.hpp"
#include "formulations/particles/smoothing_length.hpp"

namespace sphverify {

/// What a scheme may ask of a wall at a particle's foot point.
enum class BoundaryValue { pressure, velocity, temperature, conductivity, flux };
using BoundaryValueSet = FlagSet<BoundaryValue>;

/// How the surface integral A of the kernel over a wall is computed (equations.md, "face weight").
enum class FaceWeight {
  campbell,  ///< Eqs. 69-71: foot-point value of W times the whole intercepted area; exact in 1D only
  exact,     ///< the integral itself
  balanced   ///< -n . sum_j (m_j/rho_j) grad_i W_ij within reach of exactly one wall, elsewhere `exact`
};

/// What to use at a wall for a partner that the scene does not prescribe.
enum class Closure {
  interpolated,  ///< f_B = 2 sum_j (m_j/rho_j) f_j W(r_j - r_B)  (Campbell 1989, Eqs. 15, 39, 74); where
                 ///< another wall is within reach of the foot point, 1/Gamma(r_B) for 2, which is ours
  quotient,      ///< f_B = sum_j (m_j/rho_j) f_j W(r_j - r_B) / sum_j (m_j/rho_j) W(r_j - r_B): right for a
                 ///< constant, whatever the volumes; ours
  one_sided  ///< the law that rules between gas and wall: Fourier's between particle and foot point for flux
             ///< or temperature; for pressure or velocity the wave that a Riemann problem between the gas, by
             ///< the quotient, and the wall sends into the gas; ours
};

/// Where a wall stands that prescribes a pressure and goes with the gas.
enum class WallMotion {
  velocity,  ///< a material surface: its place is the time integral of its velocity v_B, prescribed or closed
  mass  ///< where the mass between it and the nearest particle is half that particle's, so that Eq. 13 goes
        ///< on holding at it; in one dimension only; ours
};

template <int Dim>
using ScalarAtWall = std::function<double(Vector<Dim> const& foot, double time)>;
template <int Dim>
using VectorAtWall = std::function<Vector<Dim>(Vector<Dim> const& foot, double time)>;

/// Heat that a wall loses by its own temperature, as by radiation. Neither that temperature nor the flux is
/// prescribed then: the wall's balance with the fluid decides both (wall_heat_balance.hpp).
struct HeatLoss {
  std::function<double(double wall_temperature)> flux;  ///< out of the fluid [W/m^2]; rises with temperature
  double environment;                                   ///< temperature at which nothing is lost [K]
};

/// A plane wall and what it prescribes; empty functions are not prescribed. A wall that prescribes
/// temperature prescribes conductivity too. The fluid lies on the inner sides of all walls of a scene: where
/// walls meet, each has a face that ends (formulations/walls/finite_face.hpp).
template <int Dim>
struct Wall {
  Vector<Dim> point;           ///< any point of the plane [m]
  Vector<Dim> outward_normal;  ///< of unit length, pointing out of the fluid
  ScalarAtWall<Dim> pressure{};
  VectorAtWall<Dim> velocity{};
  ScalarAtWall<Dim> temperature{};
  ScalarAtWall<Dim> conductivity{};
  VectorAtWall<Dim> flux{};

  /// Where the wall's point is at a time, for a wall that moves on a prescribed path; else it stays, or goes
  /// with the gas that it pushes.
  std::function<Vector<Dim>(double time)> path{};
  double gamma =
      0.0;  ///< of the gas inside; without one Closure::one_sided interpolates pressure and velocity
  std::optional<HeatLoss> heat_loss{};  ///< instead of temperature and flux

  /// Distance into the fluid; negative outside.
  double distance(Vector<Dim> const& x) const { return (point - x).dot(outward_normal); }
  Vector<Dim> foot(Vector<Dim> const& x) const { return x + distance(x) * outward_normal; }
  /// A heat loss counts as flux.
  bool prescribes(BoundaryValue value) const;
  bool prescribes_flux_only() const;  ///< and no temperature
};

/// The particles within the kernel's support of one wall's face, with what depends on geometry alone, and
/// the boundary values at their foot points. All arrays but `interpolation_*` have one entry per contact.
///
/// The foot point is the point of the face nearest to the particle. At an obtuse corner of angle beta it may
/// lie on the edge, up to d |cot beta| along the plane from the plane's own foot point. The distance stays
/// that to the plane: differences such as (T_B - T_i)/d_i stand for the derivative along the normal, and are
/// that for all which varies along the normal alone, wherever on the face T_B is taken.
template <int Dim>
struct WallContacts {
  Vector<Dim> outward_normal;
  bool prescribes_flux_only = false;  ///< flux, as a heat loss too, but no temperature

  std::vector<std::uint32_t> particle;  ///< ascending
  std::vector<double> distance;         ///< d_i, to the plane [m]
  std::vector<double> face_weight;      ///< A_i [1/m]
  std::vector<double> foot_density;     ///< rho_B(i), see foot_density()
  VectorField<Dim> foot;                ///< r_B [m]
  VectorField<Dim> offset;              ///< from r_B to the centroid of a cell's face on the wall [m]; empty unless a scheme reads it

  std::vector<double> pressure, temperature, conductivity;  ///< empty unless a scheme asked for them
  VectorField<Dim> velocity, flux;

  std::vector<std::size_t> interpolation_first;        ///< contacts + 1 offsets into the two below
  std::vector<std::uint32_t> interpolation_neighbour;  ///< particles within support of the foot point
  std::vector<double> interpolation_kernel;            ///< W(r_j - r_B)/Gamma(r_B), away from corners 2 W

  std::size_t size() const { return particle.size(); }
  std::size_t bytes() const;
};

/// Contacts of every particle of the grid with a wall. Expects the grid's reach to hold the largest support;
/// a particle's foot point is judged by that particle's smoothing length.
/// A wall whose face the support does not reach, cut short by others as it may be, is no contact.
/// @param wall one of all_walls itself, not a copy
/// @param all_walls the scene's walls, which bound each other's faces
/// @param density needed by FaceWeight::balanced only, else may be empty
/// Throws std::invalid_argument when a particle lies on or outside the wall.
template <int Dim>
WallContacts<Dim> find_wall_contacts(CellGrid<Dim> const& grid, Wall<Dim> const& wall,
                                     std::vector<Wall<Dim>> const& all_walls, SmoothingLength const& h,
                                     std::vector<double> const& mass, std::vector<double> const& density,
                                     FaceWeight rule, int threads = 1);

/// Density at a wall's foot point: 2 sum_j m_j W(r_j - r_B)  (Eqs. 13, 73, 83). Where a second wall is within
/// reach of the foot point, 1/Gamma(r_B) takes the place of 2, which it stands for.
template <int Dim>
double foot_density(CellGrid<Dim> const& grid, Vector<Dim> const& foot, std::vector<Wall<Dim>> const& walls,
                    double smoothing_length, std::vector<double> const& mass, Kernel const& kernel);

/// Adds those that a foot point interpolates from, and their kernels, to the last contact's.
/// @return foot_density() there; where it is 0 nothing is added
template <int Dim>
double add_foot_interpolation(WallContacts<Dim>& contacts, CellGrid<Dim> const& grid, Vector<Dim> const& foot,
                              std::vector<Wall<Dim>> const& walls, double smoothing_length, std::vector<double> const& mass,
                              Kernel const& kernel);

/// Face weight of one particle at distance d >= 0 from a plane that nothing cuts within the support, by a
/// rule that needs the distance only (campbell, exact).  [1/m]
template <int Dim>
double face_weight(double d, double smoothing_length, FaceWeight rule, Kernel const& kernel);

/// Fills the boundary values in `wanted`: what the wall prescribes at this time, else the closure's value.
/// `flux` and `temperature` by Closure::one_sided need the other of the two, and the conductivity. Of a wall
/// that loses heat they are those of its balance, which the closure's temperature, conductivity and mean
/// distance enter.
template <int Dim>
void fill_boundary_values(WallContacts<Dim>& contacts, Wall<Dim> const& wall, Particles<Dim> const& particles,
                          BoundaryValueSet wanted, Closure closure, double time, int threads = 1);

}  // namespace sphverify
