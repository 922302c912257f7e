// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "reports/html/page_json.hpp"

namespace sphverify::page {

/// Eigenvalues of the linearised rate, of each series' finest run that kept them the one that grows most.
/// @param share how many documents share the room of the page
Json spectra_json(Results const& results, std::size_t share);

/// Worst mode and stable steps of every replicate of each series' finest resolution.
Json stabilities_json(Results const& results, Dictionary& word);

/// Small perturbations of a gas about rest: of each conjugate pair one mode. Modes in which no particle moves
/// have no wavelength and are only counted.
Json perturbations_json(Results const& results, std::size_t share);

/// How far the second law was broken, of every replicate of each series' finest resolution.
Json second_laws_json(Results const& results, Dictionary& word);

}  // namespace sphverify::page
