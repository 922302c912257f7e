// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/kernels/cubic_spline.hpp"
#include "formulations/kernels/quintic_spline.hpp"
#include "formulations/kernels/wendland_c2.hpp"
#include "formulations/kernels/wendland_c4.hpp"
#include "formulations/kernels/wendland_c6.hpp"

namespace sphverify {

template <template <int> class... Kernels>
struct KernelPack {};

/// The one list of kernels, in the order in which they are shown; the first is what runs take that name none.
using AllKernels = KernelPack<CubicSpline, QuinticSpline, WendlandC2, WendlandC4, WendlandC6>;

}  // namespace sphverify
