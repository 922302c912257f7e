// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "formulations/neighbours/cell_grid.hpp"
#include "formulations/layouts/layout_common.hpp"

namespace sphverify {

namespace {

/// A coordinate that is less than one extent outside [0, extent], mirrored back into it.
double fold(double x, double extent) { return x < 0.0 ? -x : (x > extent ? 2.0 * extent - x : x); }

/// Particles that repel each other in a box from the origin to `extent`, lengths in mean spacings. A particle
/// at distance r pushes with (1 - r/reach)^2: without the finite push at r = 0 pairs would cling together,
/// and a much harder core would let the density of larger regions vary.
template <int Dim>
class Relaxation {
 public:
  Relaxation(VectorField<Dim> positions, Vector<Dim> const& extent, std::array<bool, Dim> const& periodic)
      : count_(positions.size()),
        extent_(extent),
        periodic_(periodic),
        points_(std::move(positions)),
        velocity_(count_) {
    find_partners();
  }

  /// Moves the particles until the root mean square force is small, and gives their positions.
  VectorField<Dim> run() {
    // The forces fall slowly in the end, the particles being nearly free to turn about each other; the
    // density is even long before. Hence a tolerance of a fiftieth, and a limit that large boxes do not
    // reach.
    constexpr int most_steps = 200;
    double const enough = 0.02 * push(1.0);
    for (int step = 0; step < most_steps; ++step) {
      find_forces();
      if (root_mean_square_force() < enough) break;
      move();
    }
    wrap();
    return first_points(count_);
  }

 private:
  // In 3D a shorter reach, at half the cost, gives as even a density: it still holds the second neighbours.
  static constexpr double reach = Dim == 2 ? 3.0 : 2.0;
  static constexpr double skin = 0.5;  ///< partners are sought this much further out, to be used for longer
  static constexpr double mobility = 0.3;
  static constexpr double inertia = 0.7;       ///< of the last move, the part that is done again
  static constexpr double longest_move = 0.1;  ///< in a step, along an axis

  /// An image of a particle, in the box that is `step` boxes away along each axis.
  struct Image {
    std::uint32_t source;
    std::array<int, Dim> step;
  };

  static double push(double distance) {
    double const inside = 1.0 - distance / reach;
    return inside * inside;
  }

  double image_coordinate(double x, int axis, int step) const {
    bool const mirrored = !periodic_[axis] && step % 2 != 0;
    return mirrored ? (step + 1) * extent_[axis] - x : step * extent_[axis] + x;
  }

  VectorField<Dim> first_points(std::size_t count) const {
    VectorField<Dim> points(count);
    for (int k = 0; k < Dim; ++k) {
      auto const& x = points_.component(k);
      std::copy_n(x.begin(), std::min(count, x.size()), points.component(k).begin());
    }
    return points;
  }

  void wrap() {
    for (int k = 0; k < Dim; ++k) {
      if (!periodic_[k]) continue;
      auto& x = points_.component(k);
      for (std::size_t i = 0; i < count_; ++i) x[i] -= extent_[k] * std::floor(x[i] / extent_[k]);
    }
  }

  /// The images that lie within reach of the box, and who is near whom.
  void find_partners() {
    wrap();
    constexpr double far = reach + skin;
    images_.clear();
    std::array<std::vector<int>, Dim> steps;
    for (std::uint32_t i = 0; i < count_; ++i) {
      for (int k = 0; k < Dim; ++k) {
        steps[k].clear();
        int const most = static_cast<int>(std::ceil(far / extent_[k]));
        for (int step = -most; step <= most; ++step) {
          double const x = image_coordinate(points_.component(k)[i], k, step);
          if (x > -far && x < extent_[k] + far) steps[k].push_back(step);
        }
      }
      add_images({.source = i, .step = {}}, 0, steps);
    }
    points_ = first_points(count_ + images_.size());
    place_images();

    CellGrid<Dim> const grid(points_, {.lower = Vector<Dim>::Zero(), .upper = extent_}, far);
    partners_.clear();
    first_partner_.assign(1, 0);
    for (std::uint32_t i = 0; i < count_; ++i) {
      grid.for_each_within_reach(points_[i], [&](std::uint32_t j, Vector<Dim> const&, double) {
        if (j > i) partners_.push_back(j);
      });
      first_partner_.push_back(partners_.size());
    }
    start_ = first_points(count_);
  }

  /// Every combination of the steps along the axes but none at all.
  void add_images(Image image, int axis, std::array<std::vector<int>, Dim> const& steps) {
    if (axis == Dim) {
      if (image.step != std::array<int, Dim>{}) images_.push_back(image);
      return;
    }
    for (int const step : steps[axis]) {
      image.step[axis] = step;
      add_images(image, axis + 1, steps);
    }
  }

  void place_images() {
    for (int k = 0; k < Dim; ++k) {
      auto& x = points_.component(k);
      for (std::size_t g = 0; g < images_.size(); ++g) {
        x[count_ + g] = image_coordinate(x[images_[g].source], k, images_[g].step[k]);
      }
    }
  }

  void find_forces() {
    std::array<double const*, Dim> x;
    std::array<double*, Dim> force;
    for (int k = 0; k < Dim; ++k) {
      x[k] = points_.component(k).data();
      force_.component(k).assign(points_.size(), 0.0);  // those on the images are not used
      force[k] = force_.component(k).data();
    }
    for (std::size_t i = 0; i < count_; ++i) {
      for (std::size_t n = first_partner_[i]; n < first_partner_[i + 1]; ++n) {
        std::uint32_t const j = partners_[n];
        std::array<double, Dim> separation;
        double squared = 0.0;
        for (int k = 0; k < Dim; ++k) {
          separation[k] = x[k][i] - x[k][j];
          squared += separation[k] * separation[k];
        }
        if (squared >= reach * reach || squared == 0.0) continue;
        double const distance = std::sqrt(squared);
        double const factor = push(distance) / distance;
        for (int k = 0; k < Dim; ++k) {
          force[k][i] += factor * separation[k];
          force[k][j] -= factor * separation[k];
        }
      }
    }
  }

  double root_mean_square_force() const {
    double sum = 0.0;
    for (int k = 0; k < Dim; ++k) {
      auto const& f = force_.component(k);
      for (std::size_t i = 0; i < count_; ++i) sum += f[i] * f[i];
    }
    return std::sqrt(sum / static_cast<double>(count_));
  }

  void move() {
    for (int k = 0; k < Dim; ++k) {
      auto& x = points_.component(k);
      auto& v = velocity_.component(k);
      for (std::size_t i = 0; i < count_; ++i) {
        v[i] = std::clamp(inertia * v[i] + mobility * force_.component(k)[i], -longest_move, longest_move);
        x[i] += v[i];
        // Who crosses a wall changes places with his image.
        if (!periodic_[k]) x[i] = fold(x[i], extent_[k]);
      }
    }
    if (2.0 * furthest_from_start() > skin) {
      find_partners();
    } else {
      place_images();
    }
  }

  double furthest_from_start() const {
    double most = 0.0;
    for (std::size_t i = 0; i < count_; ++i) {
      double squared = 0.0;
      for (int k = 0; k < Dim; ++k) {
        double const moved = points_.component(k)[i] - start_.component(k)[i];
        squared += moved * moved;
      }
      most = std::max(most, squared);
    }
    return std::sqrt(most);
  }

  std::size_t count_;
  Vector<Dim> extent_;
  std::array<bool, Dim> periodic_;
  VectorField<Dim> points_;  ///< the particles, then their images
  VectorField<Dim> force_, velocity_;
  std::vector<Image> images_;
  std::vector<std::size_t> first_partner_;  ///< per particle, where its partners start
  std::vector<std::uint32_t> partners_;     ///< of every two near particles the later one, and images
  VectorField<Dim> start_;                  ///< where the particles were when partners were sought
};

}  // namespace

template <int Dim>
Layout<Dim> glass(Domain<Dim> const& domain, int resolution, std::uint64_t seed) {
  static_assert(Dim > 1);
  Domain<Dim> const upright{.lower = Vector<Dim>::Zero(), .upper = domain.extent()};
  Layout<Dim> layout = lattice(upright, resolution);
  share_volume_equally(layout, domain);

  // Up to a whole cell away from the cell's centre nothing is left of the lattice's directions; up to half a
  // cell, the glass would remember them.
  Vector<Dim> const extent = domain.extent() / layout.spacing;
  std::mt19937_64 generator(seed);
  for (std::size_t i = 0; i < layout.positions.size(); ++i) {
    for (int k = 0; k < Dim; ++k) {
      double& x = layout.positions.component(k)[i];
      x = (x + layout.cell[k] * signed_unit_deviate(generator)) / layout.spacing;
      if (!domain.periodic[k]) x = fold(x, extent[k]);
    }
  }
  layout.positions = Relaxation<Dim>(std::move(layout.positions), extent, domain.periodic).run();
  for (std::size_t i = 0; i < layout.positions.size(); ++i) {
    layout.positions.set(i, domain.to_space(domain.lower + layout.spacing * layout.positions[i]));
  }
  return layout;
}

template Layout<2> glass(Domain<2> const&, int, std::uint64_t);
template Layout<3> glass(Domain<3> const&, int, std::uint64_t);

}  // namespace sphverify
