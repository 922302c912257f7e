// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tuple>

#include "formulations/conduction/brookshaw.hpp"
#include "formulations/conduction/campbell_flux.hpp"
#include "formulations/conduction/cleary_monaghan.hpp"
#include "formulations/conduction/corrected_flux.hpp"
#include "formulations/conduction/gamma_brookshaw.hpp"
#include "formulations/conduction/gmls.hpp"
#include "formulations/conduction/lucy_flux.hpp"
#include "formulations/momentum/direct_gradient.hpp"
#include "formulations/momentum/gdsph.hpp"
#include "formulations/momentum/p_rho2.hpp"
#include "formulations/momentum/p_rho2_grad_h.hpp"
#include "formulations/momentum/pressure_energy.hpp"
#include "formulations/momentum/rkgc.hpp"
#include "formulations/momentum/sqrt_p.hpp"
#include "formulations/momentum/voronoi.hpp"
#include "formulations/work/gdsph.hpp"
#include "formulations/work/internal_energy.hpp"
#include "formulations/work/p_rho2_grad_h.hpp"
#include "formulations/work/pressure_energy.hpp"
#include "formulations/work/rkgc.hpp"
#include "formulations/work/sqrt_p.hpp"
#include "formulations/work/total_energy.hpp"
#include "formulations/work/voronoi.hpp"

namespace sphverify {

/// The one list of schemes: the command line, the contract tests, the documentation and the reports come from it.
using AllSchemes = std::tuple<PressureOverDensitySquared, SquareRootOfPressure, DirectGradient,  //
                              TotalEnergyWork, InternalEnergyWork, SquareRootOfPressureWork,     //
                              Brookshaw, LucyFlux, CampbellFlux,                                 //
                              ClearyMonaghan, GammaBrookshaw, Gmls, CorrectedFlux,               //
                              GeometricDensity, GeometricDensityWork,                            //
                              PressureEnergy, PressureEnergyWork,                                //
                              ReverseCorrectedGradient, ReverseCorrectedWork,                    //
                              VoronoiPressure, VoronoiWork,                                      //
                              PressureOverDensitySquaredGradH, InternalEnergyWorkGradH>;

}  // namespace sphverify
