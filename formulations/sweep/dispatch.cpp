#include "formulations/sweep/dispatch.hpp"

#include "formulations/basics/expects.hpp"
#include "formulations/kernels/all.hpp"
#include "formulations/simd/instruction_set.hpp"

namespace sphverify {

// Instantiated in the files that are made of kernels.cpp.in.
namespace baseline {
template <template <int> class Kernel, int Dim>
SweepKernels const& loops();
}
namespace avx2 {
template <template <int> class Kernel, int Dim>
SweepKernels const& loops();
}

namespace {

using Loops = SweepKernels const& (*)();

struct OfKernel {
  std::string_view id;
  Loops baseline, avx2;
};

template <int Dim, template <int> class... Kernels>
SweepKernels const* find(KernelPack<Kernels...>, std::string_view kernel, Loops OfKernel::*set) {
#if defined(__x86_64__)
  constexpr OfKernel all[] = {{Kernels<Dim>::id, baseline::loops<Kernels, Dim>, avx2::loops<Kernels, Dim>}...};
#else
  constexpr OfKernel all[] = {{Kernels<Dim>::id, baseline::loops<Kernels, Dim>, nullptr}...};
#endif
  for (OfKernel const& one : all) {
    if (one.id == kernel) return one.*set ? &(one.*set)() : nullptr;
  }
  return nullptr;
}

}  // namespace

template <int Dim>
SweepKernels const* baseline_kernels(std::string_view kernel) {
  return find<Dim>(AllKernels(), kernel, &OfKernel::baseline);
}

template <int Dim>
SweepKernels const* avx2_kernels(std::string_view kernel) {
  return find<Dim>(AllKernels(), kernel, &OfKernel::avx2);
}

template <int Dim>
SweepKernels const& sweep_kernels(std::string_view kernel) {
  static bool const has_avx2 = processor_has_avx2();
  SweepKernels const* const found = has_avx2 ? avx2_kernels<Dim>(kernel) : baseline_kernels<Dim>(kernel);
  expects(found != nullptr);
  return *found;
}

#define SPHVERIFY_INSTANTIATE(Dim)                                        \
  template SweepKernels const* baseline_kernels<Dim>(std::string_view);   \
  template SweepKernels const* avx2_kernels<Dim>(std::string_view);       \
  template SweepKernels const& sweep_kernels<Dim>(std::string_view);
SPHVERIFY_INSTANTIATE(1)
SPHVERIFY_INSTANTIATE(2)
SPHVERIFY_INSTANTIATE(3)
#undef SPHVERIFY_INSTANTIATE

}  // namespace sphverify
