#include "formulations/support/density.hpp"

#include "formulations/support/cubic_spline.hpp"

namespace sphverify {

template <int Dim>
std::vector<double> summation_density(CellGrid<Dim> const& grid, SmoothingLength const& h,
                                      std::vector<double> const& mass) {
  std::vector<double> density(mass.size());
  for (std::size_t i = 0; i < mass.size(); ++i) {
    double sum = 0.0;
    grid.for_each_within_reach(grid.positions()[i],
                               [&](std::uint32_t j, Vector<Dim> const&, double distance) {
                                 sum += mass[j] * CubicSpline<Dim>::value(distance, h(i));
                               });
    density[i] = sum;
  }
  return density;
}

template <int Dim>
double kernel_inside(Vector<Dim> const& x, std::vector<Wall<Dim>> const& walls, double h) {
  double inside = 1.0;
  for (Wall<Dim> const& wall : walls) inside -= 1.0 - CubicSpline<Dim>::inner_fraction(wall.distance(x), h);
  return inside;
}

#define SPHVERIFY_INSTANTIATE(Dim)                                                             \
  template std::vector<double> summation_density(CellGrid<Dim> const&, SmoothingLength const&, \
                                                 std::vector<double> const&);                  \
  template double kernel_inside(Vector<Dim> const&, std::vector<Wall<Dim>> const&, double);
SPHVERIFY_INSTANTIATE(1)
SPHVERIFY_INSTANTIATE(2)
SPHVERIFY_INSTANTIATE(3)
#undef SPHVERIFY_INSTANTIATE

}  // namespace sphverify
