// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/run/remarks.hpp"

#include <fmt/format.h>

#include "formulations/kernels/kernel.hpp"

namespace sphverify {

template <int Dim>
void remark_on_support(Problem<Dim> const& problem, RunRecord& record) {
  double const width =
      2.0 * kernel(record.discretisation.kernel, Dim).support_ratio() * record.smoothing_length;
  for (int k = 0; k < Dim; ++k) {
    double const extent = problem.domain.extent()[k];
    if (problem.domain.periodic[static_cast<std::size_t>(k)] || !(width > extent)) continue;
    record.remarks.push_back(
        fmt::format("{}: {:.3g} m against {:.3g} m along axis {}", wide_support, width, extent, k + 1));
    return;
  }
}

template void remark_on_support(Problem<1> const&, RunRecord&);
template void remark_on_support(Problem<2> const&, RunRecord&);
template void remark_on_support(Problem<3> const&, RunRecord&);

}  // namespace sphverify
