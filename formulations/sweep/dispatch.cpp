#include "formulations/sweep/dispatch.hpp"

#include <vector>

#include "formulations/all.hpp"
#include "formulations/basics/expects.hpp"
#include "formulations/kernels/all.hpp"
#include "formulations/sweep/stored_slope.hpp"

namespace sphverify {

namespace {

template <template <int> class... Kernels>
std::vector<KernelLoops> loops_of_all(KernelPack<Kernels...>) {
  return {loops_of_kernel<Kernels, AllSchemes>()..., loops_of_kernel<StoredSlope, AllSchemes>()};
}

std::vector<KernelLoops>& all_loops() {
  static std::vector<KernelLoops> all = loops_of_all(AllKernels());
  return all;
}

template <int Dim>
SweepKernels const* find(std::string_view kernel, std::array<KernelLoops::InDimension, 3> KernelLoops::*set) {
  for (KernelLoops const& one : all_loops()) {
    if (one.kernel != kernel) continue;
    auto const loops = (one.*set)[Dim - 1];
    return loops ? &loops() : nullptr;
  }
  return nullptr;
}

}  // namespace

template <int Dim>
SweepKernels const* baseline_kernels(std::string_view kernel) {
  return find<Dim>(kernel, &KernelLoops::baseline);
}

template <int Dim>
SweepKernels const* avx2_kernels(std::string_view kernel) {
  return find<Dim>(kernel, &KernelLoops::avx2);
}

template <int Dim>
SweepKernels const& sweep_kernels(std::string_view kernel) {
  static bool const has_avx2 = processor_has_avx2();
  SweepKernels const* const found = has_avx2 ? avx2_kernels<Dim>(kernel) : baseline_kernels<Dim>(kernel);
  expects(found != nullptr);
  return *found;
}

void add_kernel_loops(KernelLoops const& loops) { all_loops().push_back(loops); }

template <int Dim>
std::vector<FusedWithKernel>& added_fused_loops() {
  static std::vector<FusedWithKernel> added;
  return added;
}

#define SPHVERIFY_INSTANTIATE(Dim)                                      \
  template SweepKernels const* baseline_kernels<Dim>(std::string_view); \
  template SweepKernels const* avx2_kernels<Dim>(std::string_view);     \
  template SweepKernels const& sweep_kernels<Dim>(std::string_view);    \
  template std::vector<FusedWithKernel>& added_fused_loops<Dim>();
SPHVERIFY_INSTANTIATE(1)
SPHVERIFY_INSTANTIATE(2)
SPHVERIFY_INSTANTIATE(3)
#undef SPHVERIFY_INSTANTIATE

}  // namespace sphverify
