// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cases/support/problem.hpp"

namespace sphverify {

bool has_walls(AnyProblem const& problem);

/// Whether every side of the domain is a wall or periodic.
bool is_closed(AnyProblem const& problem);

/// Whether a wall goes with the gas that it pushes.
bool has_free_wall(AnyProblem const& problem);

}  // namespace sphverify
