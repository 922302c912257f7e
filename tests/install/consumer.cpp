// SPDX-License-Identifier: GPL-3.0-or-later
// Runs one scheme and one reference solution of an installed sphverify from outside.
#include <cstdio>

#include "cases/support/case.hpp"
#include "formulations/rate_operator.hpp"
#include "formulations/kernels/cubic_spline.hpp"

int main() {
  using namespace sphverify;
  auto const brookshaw = make_rate_operator<2>("conduction/brookshaw");
  Case const* const slab = find_case("conduction/slab-dirichlet");
  auto const problem = std::get<Problem<1>>(slab->problem(Parameters(slab->info.parameters)));
  double const temperature = problem.scalars.at(Field::temperature)(Vector<1>(0.5), 0.0);
  std::printf("%s %.3f %.3f\n", brookshaw->info().id.data(), temperature, CubicSpline<1>::value(0.0, 1.0));
  // 1 + 0.5 + sin(pi/2) + 0.5 sin(3 pi/2) = 2
  return temperature > 1.999 && temperature < 2.001 ? 0 : 1;
}
