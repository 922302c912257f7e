#pragma once

#include <tuple>

#include "cases/conduction/barenblatt.hpp"
#include "cases/conduction/half_space_step.hpp"
#include "cases/conduction/manufactured.hpp"
#include "cases/conduction/marshak.hpp"
#include "cases/conduction/slab_dirichlet.hpp"
#include "cases/conduction/slab_flux.hpp"
#include "cases/conduction/slab_insulated.hpp"
#include "cases/operator/polynomial.hpp"
#include "cases/operator/sine.hpp"

namespace sphverify {

/// The one list of cases: the command line, the contract tests, the documentation and the reports come from it.
using AllCases = std::tuple<OperatorPolynomial, OperatorSine,                           //
                            SlabDirichlet, SlabInsulated, SlabFlux, HalfSpaceStep,      //
                            ManufacturedConduction, BarenblattPulse, MarshakWave>;

}  // namespace sphverify
