// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/neighbours/candidates.hpp"

namespace sphverify {

/// The loops that find neighbours, for this processor.
template <int Dim>
ListKernels const& list_kernels();

}  // namespace sphverify
