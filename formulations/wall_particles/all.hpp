// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tuple>

#include "formulations/wall_particles/dummy.hpp"
#include "formulations/wall_particles/mirror.hpp"

namespace sphverify {

/// The one list of what may stand behind walls in place of wall terms.
using AllWallTreatments = std::tuple<MirrorWalls, DummyWalls>;

}  // namespace sphverify
