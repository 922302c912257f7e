// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "formulations/walls/walls.hpp"

// Walls that meet. The fluid is where every wall of the scene has its inner side, so that each wall's face is
// the part of its plane that the others leave: a convex region, of which a particle sees what its kernel
// intercepts. Derived in docs/theory/face-weights.md. A wall takes part where its plane lies within the
// support; one that cuts nothing there changes no bit of what the infinite plane gives.
namespace sphverify {

/// Face weight of a particle at x, inside the fluid, for the face of one of the walls.  [1/m]
/// FaceWeight::exact is the integral of W over the face, FaceWeight::campbell the value W(d) at the foot
/// point on the plane times the area of the face within the support (Campbell 1989, Eqs. 69-71, in corners
/// our reading of them). Zero where the support does not reach the face. The quadrature's error is below
/// 2e-14/h, measured against adaptive quadrature on random corners; `balanced` is not for this function.
template <int Dim>
double face_weight(Vector<Dim> const& x, std::vector<Wall<Dim>> const& walls, std::size_t index,
                   double smoothing_length, FaceWeight rule, Kernel const& kernel);

/// Gamma(x): the part of the kernel inside the fluid, for x inside or on its boundary: 1 far from every wall,
/// 1/2 on a face, 1/4 on a right edge, 1/8 at a right corner. On two parallel walls with the fluid between
/// them too. The error is below 1e-14, measured against adaptive quadrature along rays in 2D; a point nearer
/// to a wall than 1e-14 h counts as that far from it.
template <int Dim>
double inner_fraction(Vector<Dim> const& x, std::vector<Wall<Dim>> const& walls, double smoothing_length,
                      Kernel const& kernel);

/// What a kernel sum at a foot point is multiplied with, 1/Gamma(foot): exactly 2 where only its own wall is
/// within reach, as the report has everywhere (Campbell 1989, Eqs. 13, 15, 74).
template <int Dim>
double wall_interpolation_factor(Vector<Dim> const& foot, std::vector<Wall<Dim>> const& walls,
                                 double smoothing_length, Kernel const& kernel);

/// The point of a wall's face that is nearest to x: the foot point on its plane, unless that lies beyond
/// another wall, as it may at obtuse corners. Empty where the other walls leave nothing of the plane.
/// @param smoothing_length sets the round-off below which lengths count as zero
template <int Dim>
std::optional<Vector<Dim>> nearest_on_face(Vector<Dim> const& x, std::vector<Wall<Dim>> const& walls,
                                           std::size_t index, double smoothing_length);

}  // namespace sphverify
