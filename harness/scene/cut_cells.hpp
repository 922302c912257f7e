// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

#include "cases/support/problem.hpp"
#include "formulations/layouts/layout.hpp"
#include "reports/results.hpp"

namespace sphverify {

/// A particle's own cell that a jump of the initial state cuts: places in it and the parts of its volume for
/// which they stand, by Gauss's rule on either side of the jump along the domain's first axis.
template <int Dim>
struct CutCell {
  std::size_t particle;
  double volume;  ///< [m^Dim]
  std::vector<std::pair<Vector<Dim>, double>> samples;

  /// The mean over the cell of f(place), a number or a vector.
  template <class F>
  auto mean(F const& f) const {
    using Value = std::decay_t<decltype(f(samples.front().first))>;
    Value sum = samples.front().second * f(samples.front().first);
    for (std::size_t k = 1; k < samples.size(); ++k) sum += samples[k].second * f(samples[k].first);
    return sum;
  }
};

/// What a cell holds of a gas: mass, momentum and energy are the integrals of the exact initial state over
/// it. Where two gases run into each other within it, the energy of their motion against each other is heat.
template <int Dim>
struct CellState {
  double density;          ///< mass over the cell's volume
  Vector<Dim> velocity;    ///< momentum over mass
  double internal_energy;  ///< energy over mass, less velocity^2/2
};

/// The cells of a layout that the problem's initial jumps cut. The cells fill the domain without overlapping,
/// so that what all particles hold is what the exact initial state holds.
///
/// A particle's own cell is, in one dimension, from halfway to one neighbour to halfway to the other, or as
/// much as holds its mass (layout equal-mass); in more of them a box: that of the lattice in which it was
/// placed; in packed layouts as wide as its row or layer, with itself in the middle. In a glass, whose cells
/// have no simple shape, boxes as wide as the spacing are moved along by one length, which makes the volumes
/// on both sides of the jump right.
/// @param layout as `place` gives it
template <int Dim>
std::vector<CutCell<Dim>> cut_cells(Problem<Dim> const& problem, Layout<Dim> const& layout,
                                    LayoutChoice const& choice);

/// Expects a problem with velocity and internal energy.
template <int Dim>
CellState<Dim> held(CutCell<Dim> const& cell, Problem<Dim> const& problem);

}  // namespace sphverify
