// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/density/density.hpp"

#include "formulations/basics/parallel.hpp"
#include "formulations/sweep/pair_sweep.hpp"
#include "formulations/walls/finite_face.hpp"

namespace sphverify {

template <int Dim>
std::vector<double> summation_density(CellGrid<Dim> const& grid, SmoothingLength const& h,
                                      std::vector<double> const& mass, int threads) {
  std::vector<double> density(mass.size());
  Kernel const& kernel = h.kernel();
  for_each_row(mass.size(), threads, [&](std::size_t i) {
    double sum = 0.0;
    grid.for_each_within_reach(grid.positions()[i],
                               [&](std::uint32_t j, Vector<Dim> const&, double distance) {
                                 sum += mass[j] * kernel.value(distance, h(i));
                               });
    density[i] = sum;
  });
  return density;
}

template <int Dim>
void sum_density(Particles<Dim>& particles, NeighbourList const& neighbours, Domain<Dim> const& domain,
                 int threads) {
  auto& density = particles.scalar(Field::density);
  PairSweep<Dim> sweep(neighbours, domain, threads);
  sweep.add(loops_of_sweep<Dim>().density, {Field::mass}, {}, density);
  sweep.run(particles);
  double const own = particles.kernel().value(0.0, particles.smoothing_length());
  for_each_row(density.size(), threads, [&](std::size_t i) { density[i] += particles.masses()[i] * own; });
}

template <int Dim>
double kernel_inside(Vector<Dim> const& x, std::vector<Wall<Dim>> const& walls, double h,
                     Kernel const& kernel) {
  return inner_fraction(x, walls, h, kernel);
}

#define SPHVERIFY_INSTANTIATE(Dim)                                                             \
  template std::vector<double> summation_density(CellGrid<Dim> const&, SmoothingLength const&, \
                                                 std::vector<double> const&, int);             \
  template void sum_density(Particles<Dim>&, NeighbourList const&, Domain<Dim> const&, int);   \
  template double kernel_inside(Vector<Dim> const&, std::vector<Wall<Dim>> const&, double, Kernel const&);
SPHVERIFY_INSTANTIATE(1)
SPHVERIFY_INSTANTIATE(2)
SPHVERIFY_INSTANTIATE(3)
#undef SPHVERIFY_INSTANTIATE

}  // namespace sphverify
