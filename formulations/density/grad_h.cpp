// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/density/grad_h.hpp"

#include "formulations/basics/parallel.hpp"
#include "formulations/walls/finite_face.hpp"

namespace sphverify {

template <int Dim>
std::vector<double> grad_h_terms(CellGrid<Dim> const& grid, SmoothingLength const& h, std::vector<double> const& mass,
                                 std::vector<double> const& density, std::vector<Wall<Dim>> const& walls, int threads) {
  std::vector<double> omega(mass.size());
  Kernel const& kernel = h.kernel();
  for_each_row(mass.size(), threads, [&](std::size_t i) {
    Vector<Dim> const x = grid.positions()[i];
    double sum = 0.0;
    grid.for_each_within_reach(x, [&](std::uint32_t j, Vector<Dim> const&, double distance) {
      sum -= mass[j] * distance * distance * kernel.radial(distance, h(i));
    });
    sum /= density[i];
    double inside = 1.0;
    if (!walls.empty()) {
      inside = inner_fraction(x, walls, h(i), kernel);
      for (std::size_t w = 0; w < walls.size(); ++w)
        sum += walls[w].distance(x) * face_weight(x, walls, w, h(i), FaceWeight::exact, kernel);
    }
    omega[i] = sum / (Dim * inside);
  });
  return omega;
}

#define SPHVERIFY_INSTANTIATE(Dim)                                                                                    \
  template std::vector<double> grad_h_terms(CellGrid<Dim> const&, SmoothingLength const&, std::vector<double> const&, \
                                            std::vector<double> const&, std::vector<Wall<Dim>> const&, int);
SPHVERIFY_INSTANTIATE(1)
SPHVERIFY_INSTANTIATE(2)
SPHVERIFY_INSTANTIATE(3)
#undef SPHVERIFY_INSTANTIATE

}  // namespace sphverify
