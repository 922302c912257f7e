// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "formulations/plugins/plugin_library.hpp"
#include "formulations/rate_operator.hpp"

namespace sphverify {

/// A plug-in behind the common face. Expects that the library outlives it.
template <int Dim>
std::unique_ptr<RateOperator<Dim>> make_plugin_operator(PluginLibrary& library);

}  // namespace sphverify
