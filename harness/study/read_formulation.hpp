// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "reports/json/node.hpp"
#include "reports/results.hpp"

namespace sphverify {

/// Loads a shared library that a document names; returns its identifier. Throws UserError.
/// @param plugins paths of those named so far; this one is added
std::string load_plugin_named(Node const& library, std::vector<std::string>& plugins);

/// A formulation of a study with its partners; plug-ins are loaded. Throws UserError.
FormulationChoice read_study_formulation(Node const& node, std::vector<std::string>& plugins);

}  // namespace sphverify
