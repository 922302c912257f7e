#pragma once

#include "cases/support/problem.hpp"
#include "formulations/support/layout.hpp"
#include "reports/results.hpp"

namespace sphverify {

/// The particles of a layout that a study names, for a problem.
/// Throws std::invalid_argument for a layout that the problem's dimension does not have.
template <int Dim>
Layout<Dim> place(Problem<Dim> const& problem, LayoutChoice const& layout, int resolution) {
  if (layout.id == "jittered") return jittered(problem.domain, resolution, layout.amplitude, layout.seed);
  if (layout.id == "lattice") return lattice(problem.domain, resolution);
  if constexpr (Dim == 1) {
    auto const& density = problem.scalars.at(Field::density);
    return equal_mass(problem.domain, resolution, [&](double x) { return density(Vector<1>(x), 0.0); });
  } else {
    throw std::invalid_argument("layout equal-mass is for one dimension");
  }
}

}  // namespace sphverify
