// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tuple>

#include "cases/conduction/barenblatt.hpp"
#include "cases/conduction/box.hpp"
#include "cases/conduction/half_space_step.hpp"
#include "cases/conduction/manufactured.hpp"
#include "cases/conduction/marshak.hpp"
#include "cases/conduction/slab_dirichlet.hpp"
#include "cases/conduction/slab_flux.hpp"
#include "cases/conduction/slab_insulated.hpp"
#include "cases/coupled/conducting_shock.hpp"
#include "cases/coupled/hot_wall.hpp"
#include "cases/coupled/manufactured.hpp"
#include "cases/extreme/cold_front.hpp"
#include "cases/extreme/conductivity_contrast.hpp"
#include "cases/extreme/density_contrast.hpp"
#include "cases/extreme/pressure_ratio.hpp"
#include "cases/extreme/radiative_cooling.hpp"
#include "cases/extreme/radiative_wall.hpp"
#include "cases/extreme/units.hpp"
#include "cases/hydro/acoustic.hpp"
#include "cases/hydro/gresho.hpp"
#include "cases/hydro/manufactured.hpp"
#include "cases/hydro/noh.hpp"
#include "cases/hydro/piston.hpp"
#include "cases/hydro/riemann.hpp"
#include "cases/hydro/sedov.hpp"
#include "cases/hydro/simple_wave.hpp"
#include "cases/hydro/uniform.hpp"
#include "cases/hydro/vacuum_release.hpp"
#include "cases/operator/polynomial.hpp"
#include "cases/operator/sine.hpp"

namespace sphverify {

/// The one list of cases: the command line, the contract tests, the documentation and the reports come from
/// it.
using AllCases = std::tuple<OperatorPolynomial, OperatorSine,                                               //
                            SlabDirichlet, SlabInsulated, SlabFlux, HalfSpaceStep,                          //
                            ConductionSquare, ConductionCube,                                               //
                            ManufacturedConduction, BarenblattPulse, MarshakWave,                           //
                            UniformGas, ManufacturedGas, AcousticWave, SimpleWavePiston,                    //
                            PistonOfVelocity, PistonOfPressure, RiemannProblem, NohProblem, VacuumRelease,  //
                            SedovExplosion, GreshoVortex,                                                   //
                            ManufacturedConductingGas, HotWallGas, ConductingShockWave,                     //
                            PressureRatio, DensityContrast, ConductivityContrast, ColdFront,                //
                            ConductionUnits, GasUnits, RadiativeWall, RadiativeCooling>;

}  // namespace sphverify
