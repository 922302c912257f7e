#pragma once

#include <tuple>

#include "formulations/kernels/cubic_spline.hpp"
#include "formulations/kernels/quintic_spline.hpp"
#include "formulations/kernels/wendland_c2.hpp"
#include "formulations/kernels/wendland_c4.hpp"
#include "formulations/kernels/wendland_c6.hpp"

namespace sphverify {

template <template <int> class... Kernels>
struct KernelPack {
  template <int Dim>
  using InDimension = std::tuple<Kernels<Dim>...>;
};

/// The one list of kernels, in the order in which they are shown; the first is what runs take that name none. A
/// header is named after its type: formulations/CMakeLists.txt makes the loops of each from the includes above.
using AllKernels = KernelPack<CubicSpline, QuinticSpline, WendlandC2, WendlandC4, WendlandC6>;

template <int Dim>
using KernelList = AllKernels::InDimension<Dim>;

}  // namespace sphverify
