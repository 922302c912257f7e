#pragma once

#include "formulations/support/layout.hpp"
#include "reports/results.hpp"

namespace sphverify {

/// The particles of a layout that a study names.
template <int Dim>
Layout<Dim> place(Domain<Dim> const& domain, LayoutChoice const& layout, int resolution) {
  return layout.id == "jittered" ? jittered(domain, resolution, layout.amplitude, layout.seed)
                                 : lattice(domain, resolution);
}

}  // namespace sphverify
