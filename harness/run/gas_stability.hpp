// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "harness/run/run.hpp"
#include "harness/scene/moving_scene.hpp"

namespace sphverify {

/// Small perturbations of a gas about its initial state: eigenvalues and modes of the whole moving system
/// (places, velocities, energies, densities), linearised by central differences. Meant for gases at rest;
/// where the initial state does not stand still the record says so. The stable step of leapfrog is 2/omega
/// for the fastest oscillation, and by experiment that of the run's own leapfrog.
/// @param with_modes whether every mode is recorded: growth against wavelength
/// @param measure_step whether to find leapfrog's step by experiment too
/// @param out_of_time asked between evaluations
template <int Dim>
Stability gas_stability(Problem<Dim> const& problem, SceneChoice const& choice, bool with_modes,
                        bool measure_step, std::function<bool()> const& out_of_time);

}  // namespace sphverify
