#include "formulations/support/layout.hpp"

#include <cmath>
#include <random>

#include "formulations/support/expects.hpp"

namespace sphverify {

template <int Dim>
Layout<Dim> lattice(Domain<Dim> const& domain, int resolution) {
  expects(resolution > 0);
  Vector<Dim> const extent = domain.extent();
  Layout<Dim> layout;
  layout.spacing = extent[0] / resolution;
  std::array<std::size_t, Dim> count;
  Vector<Dim>& cell = layout.cell;
  std::size_t total = 1;
  double volume = 1.0;
  for (int k = 0; k < Dim; ++k) {
    count[k] = k == 0 ? static_cast<std::size_t>(resolution)
                      : static_cast<std::size_t>(std::max(1L, std::lround(extent[k] / layout.spacing)));
    cell[k] = extent[k] / static_cast<double>(count[k]);
    total *= count[k];
    volume *= cell[k];
  }
  layout.positions = VectorField<Dim>(total);
  layout.volumes.assign(total, volume);
  for (std::size_t i = 0; i < total; ++i) {
    std::size_t rest = i;
    Vector<Dim> x;
    for (int k = Dim - 1; k >= 0; --k) {
      x[k] = domain.lower[k] + (static_cast<double>(rest % count[k]) + 0.5) * cell[k];
      rest /= count[k];
    }
    layout.positions.set(i, x);
  }
  return layout;
}

namespace {

/// Uniform in [-1, 1) from the top 53 bits: std::uniform_real_distribution may differ between standard
/// libraries.
double signed_unit_deviate(std::mt19937_64& generator) {
  return static_cast<double>(generator() >> 11) * 0x1.0p-52 - 1.0;
}

/// Half the distance between a particle's two neighbours, the domain's ends taking the place of a missing
/// one.
void set_voronoi_volumes(Layout<1>& layout, Domain<1> const& domain) {
  auto const& x = layout.positions.component(0);
  std::size_t const n = x.size();
  double const lower = domain.lower[0];
  double const upper = domain.upper[0];
  // Over a periodic end the last particle's image is the first one's neighbour.
  double const across = domain.periodic[0] ? 0.5 * (x.front() + x.back() - (upper - lower)) : lower;
  double left = across;
  for (std::size_t i = 0; i < n; ++i) {
    double const right =
        i + 1 < n ? 0.5 * (x[i] + x[i + 1]) : (domain.periodic[0] ? across + (upper - lower) : upper);
    layout.volumes[i] = right - left;
    left = right;
  }
}

}  // namespace

template <int Dim>
Layout<Dim> jittered(Domain<Dim> const& domain, int resolution, double amplitude, std::uint64_t seed) {
  expects(amplitude >= 0.0 && amplitude < 0.5);
  Layout<Dim> layout = lattice(domain, resolution);
  std::mt19937_64 generator(seed);
  for (std::size_t i = 0; i < layout.volumes.size(); ++i) {
    Vector<Dim> displacement;
    for (int k = 0; k < Dim; ++k)
      displacement[k] = amplitude * layout.cell[k] * signed_unit_deviate(generator);
    layout.positions.add(i, displacement);
  }
  if constexpr (Dim == 1) set_voronoi_volumes(layout, domain);
  return layout;
}

Layout<1> equal_mass(Domain<1> const& domain, int resolution,
                     std::function<double(double x)> const& density) {
  expects(resolution > 0);
  // Mass from the lower end at the edges of cells much finer than the particles, by the midpoint rule, which
  // takes a jump between two cells as it is.
  constexpr int cells_per_particle = 256;
  std::size_t const cells = static_cast<std::size_t>(resolution) * cells_per_particle;
  double const width = domain.extent()[0] / static_cast<double>(cells);
  double const lower = domain.lower[0];
  std::vector<double> mass(cells + 1, 0.0);
  for (std::size_t c = 0; c < cells; ++c) {
    mass[c + 1] = mass[c] + width * density(lower + (static_cast<double>(c) + 0.5) * width);
  }
  double const share = mass.back() / resolution;
  Layout<1> layout;
  layout.spacing = domain.extent()[0] / resolution;
  layout.cell = Vector<1>(layout.spacing);
  layout.positions = VectorField<1>(static_cast<std::size_t>(resolution));
  std::size_t c = 0;
  for (std::size_t i = 0; i < layout.positions.size(); ++i) {
    double const wanted = (static_cast<double>(i) + 0.5) * share;
    while (mass[c + 1] < wanted) ++c;
    double const part = (wanted - mass[c]) / (mass[c + 1] - mass[c]);
    double const x = lower + (static_cast<double>(c) + part) * width;
    layout.positions.set(i, Vector<1>(x));
    layout.volumes.push_back(share / density(x));
  }
  return layout;
}

template Layout<1> lattice(Domain<1> const&, int);
template Layout<2> lattice(Domain<2> const&, int);
template Layout<3> lattice(Domain<3> const&, int);
template Layout<1> jittered(Domain<1> const&, int, double, std::uint64_t);
template Layout<2> jittered(Domain<2> const&, int, double, std::uint64_t);
template Layout<3> jittered(Domain<3> const&, int, double, std::uint64_t);

}  // namespace sphverify
