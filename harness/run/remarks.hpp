// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cases/support/problem.hpp"
#include "reports/results.hpp"

namespace sphverify {

/// How remarks on a support begin.
inline constexpr char const* wide_support = "support wider than the domain";

/// Remarks on a support to either side that is wider than the domain between its walls: every particle
/// then feels a wall, and what is measured says nothing of the form inside. Along a periodic axis it is
/// refused.
template <int Dim>
void remark_on_support(Problem<Dim> const& problem, RunRecord& record);

}  // namespace sphverify
