// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/cells/voronoi_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>

#include "formulations/basics/parallel.hpp"
#include "formulations/cells/convex_cell.hpp"
#include "formulations/cells/ring_search.hpp"

namespace sphverify {

namespace {

/// Half the first box about a particle, in mean distances of particles. A cell that reaches its sides is cut anew out of a
/// larger one.
constexpr double first_half_box = 3.0, larger_by = 4.0;

/// Edge of the grid's cells, in mean distances: by measurement.
constexpr double grid_edge = 1.1;

/// How often a cell is cut again with a larger tolerance where rounding left no convex body.
constexpr int most_attempts = 4;

/// By whom a plane cuts: particles are numbered from 0 in the order in which they did, walls count from -100 down, and the
/// sides of the box are -1 to -6.
constexpr std::int32_t first_wall = -100;

template <int Dim>
struct BoxWall {
  Vector<Dim> normal;  ///< outward, along the box's axes
  double level;        ///< normal . x on the wall
};

struct Neighbour {
  std::uint32_t particle;
  bool is_nearest_image;
};

/// A particle's cell, as it was found; offsets in space, where wanted.
template <int Dim>
struct FoundCell {
  struct Face {
    Neighbour neighbour;
    double area;
    Vector<Dim> offset;
  };
  struct OnWall {
    std::uint32_t wall;
    double area;
    Vector<Dim> offset;
  };
  double volume = 0.0;
  std::vector<Face> faces;
  std::vector<OnWall> walls;
};

/// How long things are in a scene [m].
struct Lengths {
  double spacing;             ///< mean distance of particles
  double largest_coordinate;  ///< of a particle or a side of the domain
  double whole;               ///< more than anything in the scene, its walls too, is from anything else
};

/// A particle has no cell that could be used.
class NoCell : public std::invalid_argument {
 public:
  NoCell(std::size_t particle, std::string const& what) : std::invalid_argument(what), particle_(particle) {}
  std::size_t particle() const { return particle_; }

 private:
  std::size_t particle_;
};

/// Finds cells, one after the other, with the same memory.
template <int Dim>
class CellFinder {
 public:
  CellFinder(PlacesByCell<Dim> const& places, std::vector<BoxWall<Dim>> const& walls, Lengths const& lengths, bool wants_offsets)
      : domain_(places.grid.domain()),
        positions_(places.grid.positions()),
        search_(places),
        walls_(walls),
        lengths_(lengths),
        wants_offsets_(wants_offsets) {}

  FoundCell<Dim> const& find(std::size_t i) {
    Vector<Dim> const x = domain_.to_box(positions_[i]);
    // Differences of coordinates are no better than that.
    double tolerance = 4.0 * std::numeric_limits<double>::epsilon() * std::max(lengths_.largest_coordinate, lengths_.spacing);
    int attempts = 0;
    for (double half = first_half_box * lengths_.spacing;;) {
      try {
        cut(i, x, half, tolerance);
      } catch (std::length_error const& error) {
        complain(i, error.what());
      }
      bool touches_box = false;
      if (!read(touches_box)) {
        if (++attempts == most_attempts) complain(i, "has a Voronoi cell that rounding leaves without a shape");
        tolerance *= 16.0;
        continue;
      }
      if (!touches_box) break;
      if (half > larger_by * lengths_.whole) complain(i, "has an unbounded Voronoi cell: the fluid has a side with neither wall nor periodic image");
      half *= larger_by;
    }
    check_images(i);
    return found_;
  }

 private:
  void cut(std::size_t i, Vector<Dim> const& x, double half, double tolerance) {
    cutters_.clear();
    cell_.reset(Vector<Dim>::Constant(half), tolerance);
    for (std::size_t w = 0; w < walls_.size(); ++w) {
      double const distance = walls_[w].level - walls_[w].normal.dot(x);
      if (!(distance > 0.0)) complain(i, "lies on or outside wall " + std::to_string(w) + ": it has no Voronoi cell");
      if (distance < half * std::sqrt(static_cast<double>(Dim)))
        cell_.clip(walls_[w].normal, distance, first_wall - static_cast<std::int32_t>(w));
    }
    for (int r = 0;; ++r) {
      double const needed = 2.0 * std::sqrt(cell_.farthest_squared());
      near_.clear();
      double const seen = search_.ring(x, r, needed, [&](std::uint32_t j, Vector<Dim> const& separation, double squared) {
        if (j == i && separation.isZero(0.0)) return;
        if (squared == 0.0)
          complain(std::min<std::size_t>(i, j), "and " + std::to_string(std::max<std::size_t>(i, j)) + " are at the same place");
        near_.push_back({squared, j, separation});
      });
      std::sort(near_.begin(), near_.end(), [](Near const& a, Near const& b) {
        return a.squared != b.squared ? a.squared < b.squared : a.particle < b.particle;
      });
      double farthest = cell_.farthest_squared();
      for (Near const& one : near_) {
        if (one.squared >= 4.0 * farthest) break;
        double const distance = std::sqrt(one.squared);
        if (!cell_.clip(one.separation / distance, 0.5 * distance, static_cast<std::int32_t>(cutters_.size()))) continue;
        cutters_.push_back({one.particle, is_nearest_image(one.separation)});
        farthest = cell_.farthest_squared();
      }
      if (seen >= 2.0 * std::sqrt(farthest)) return;
    }
  }

  /// @return false where the cell has no consistent shape
  bool read(bool& touches_box) {
    found_.volume = 0.0;
    found_.faces.clear();
    found_.walls.clear();
    return cell_.for_each_face(wants_offsets_, [&](CellPlane<Dim> const& plane, double area, Vector<Dim> const& offset) {
      if (plane.cut_by < 0 && plane.cut_by > first_wall) touches_box = true;
      double const positive = std::max(area, 0.0);
      found_.volume += plane.distance * positive / Dim;
      if (plane.cut_by >= 0) {
        found_.faces.push_back({cutters_[static_cast<std::size_t>(plane.cut_by)], positive, domain_.to_space(offset)});
      } else if (plane.cut_by <= first_wall) {
        found_.walls.push_back({static_cast<std::uint32_t>(first_wall - plane.cut_by), positive, domain_.to_space(offset)});
      }
    });
  }

  bool is_nearest_image(Vector<Dim> const& separation) const {
    for (int k = 0; k < Dim; ++k) {
      if (domain_.periodic[static_cast<std::size_t>(k)] && 2.0 * std::abs(separation[k]) > domain_.extent()[k] * (1.0 + 1e-12)) return false;
    }
    return true;
  }

  /// The pair sweeps take every neighbour once, at its nearest image.
  void check_images(std::size_t i) {
    if (!domain_.is_periodic()) return;
    std::vector<std::uint32_t>& met = met_;
    met.clear();
    for (auto const& [neighbour, area, offset] : found_.faces) {
      if (neighbour.particle == i) complain(i, "has a Voronoi cell that meets its own image" + too_few());
      if (!neighbour.is_nearest_image)
        complain(i, "has a Voronoi cell that meets particle " + std::to_string(neighbour.particle) + " beyond half of the periodic axis" + too_few());
      met.push_back(neighbour.particle);
    }
    std::sort(met.begin(), met.end());
    auto const twice = std::adjacent_find(met.begin(), met.end());
    if (twice != met.end())
      complain(i, "has a Voronoi cell that meets two images of particle " + std::to_string(*twice) + too_few());
  }
  static std::string too_few() { return ": a periodic axis has too few particles along it"; }

  [[noreturn]] static void complain(std::size_t i, std::string const& what) {
    throw NoCell(i, (what.starts_with("and ") ? "particles " : "particle ") + std::to_string(i) + " " + what);
  }

  struct Near {
    double squared;
    std::uint32_t particle;
    Vector<Dim> separation;
  };

  Domain<Dim> const& domain_;
  VectorField<Dim> const& positions_;
  RingSearch<Dim> search_;
  std::vector<BoxWall<Dim>> const& walls_;
  Lengths lengths_;
  bool wants_offsets_;
  ConvexCell<Dim> cell_;
  std::vector<Near> near_;
  std::vector<Neighbour> cutters_;
  std::vector<std::uint32_t> met_;
  FoundCell<Dim> found_;
};

/// Of axes along which all particles have one place nothing is known.
template <int Dim>
Lengths lengths_of(VectorField<Dim> const& positions, Domain<Dim> const& domain, std::vector<BoxWall<Dim>> const& walls) {
  Lengths lengths{.spacing = 0.0, .largest_coordinate = 0.0, .whole = 0.0};
  double volume = 1.0;
  int axes = 0;
  for (int k = 0; k < Dim; ++k) {
    auto const [low, high] = std::minmax_element(positions.component(k).begin(), positions.component(k).end());
    double const along = std::max({std::abs(*low), std::abs(*high), std::abs(domain.lower[k]), std::abs(domain.upper[k])});
    lengths.largest_coordinate = std::max(lengths.largest_coordinate, along);
    bool const has_box = domain.periodic[static_cast<std::size_t>(k)] || domain.is_turned();
    double const extent = !has_box && *high - *low > 0.0 ? *high - *low : domain.extent()[k];
    if (!(extent > 0.0)) continue;
    volume *= extent;
    ++axes;
  }
  lengths.whole = 2.0 * std::sqrt(static_cast<double>(Dim)) * lengths.largest_coordinate;
  for (BoxWall<Dim> const& wall : walls) lengths.whole = std::max(lengths.whole, 2.0 * std::abs(wall.level));
  if (axes > 0) lengths.spacing = std::pow(volume / static_cast<double>(positions.size()), 1.0 / axes);
  if (!(lengths.spacing > 0.0)) lengths.spacing = lengths.whole > 0.0 ? lengths.whole : 1.0;
  return lengths;
}

/// Calls block(begin, end, finder) for parts of the particles that together are all. Of several complaints that of the first
/// particle is thrown, at any number of threads.
template <int Dim, class Block>
void find_cells(VectorField<Dim> const& positions, Domain<Dim> const& domain, std::vector<Wall<Dim>> const& walls,
                bool with_offsets, int threads, Block const& block) {
  std::size_t const n = positions.size();
  if (n == 0) return;
  std::vector<BoxWall<Dim>> box_walls;
  for (Wall<Dim> const& wall : walls)
    box_walls.push_back({domain.to_box(wall.outward_normal), wall.point.dot(wall.outward_normal)});
  Lengths const lengths = lengths_of(positions, domain, box_walls);
  double edge = grid_edge * lengths.spacing;
  for (int k = 0; k < Dim; ++k) {
    if (domain.periodic[static_cast<std::size_t>(k)]) edge = std::min(edge, 0.5 * domain.extent()[k]);
  }
  CellGrid<Dim> const grid(positions, domain, edge);
  PlacesByCell<Dim> const places(grid);
  std::mutex lock;
  std::optional<NoCell> first_complaint;
  for_each_block(
      n, threads,
      [&](std::size_t begin, std::size_t end) {
        try {
          CellFinder<Dim> finder(places, box_walls, lengths, with_offsets);
          block(begin, end, finder);
        } catch (NoCell const& error) {
          std::scoped_lock const hold(lock);
          if (!first_complaint || error.particle() < first_complaint->particle()) first_complaint = error;
        }
      },
      256);
  if (first_complaint) throw std::invalid_argument(first_complaint->what());
}

template <int Dim>
struct WallFace {
  std::uint32_t particle, wall;
  double area;
  Vector<Dim> offset;
};

/// What the cells of some particles side by side are, until the lengths of all rows are known.
template <int Dim>
struct Part {
  std::size_t begin = 0;
  std::vector<std::uint32_t> neighbour;
  std::vector<double> area;
  std::vector<Vector<Dim>> offset;  ///< if wanted
  std::vector<WallFace<Dim>> walls;
};

/// Where row j has i; its end if it does not.
std::size_t place_in_row(NeighbourList const& list, std::size_t j, std::size_t i) {
  auto const begin = list.neighbour.begin() + static_cast<std::ptrdiff_t>(list.first[j]);
  auto const end = list.neighbour.begin() + static_cast<std::ptrdiff_t>(list.first[j + 1]);
  return static_cast<std::size_t>(std::find(begin, end, static_cast<std::uint32_t>(i)) - list.neighbour.begin());
}

/// Either particle of a pair has measured their face. What they part by is rounding, and where only one of them saw it the
/// face itself is no more than that.
template <int Dim>
void make_symmetric(VoronoiCells<Dim>& cells, int threads) {
  NeighbourList const& list = cells.faces;
  LargeArray<double> const area = cells.area;
  std::array<LargeArray<double>, Dim> const offset = cells.offset;
  for_each_row(list.rows(), threads, [&](std::size_t i) {
    for (std::size_t k = list.first[i]; k < list.first[i + 1]; ++k) {
      std::size_t const j = list.neighbour[k];
      std::size_t const back = place_in_row(list, j, i);
      bool const is_seen_by_both = back < list.first[j + 1];
      cells.area[k] = is_seen_by_both ? 0.5 * (area[k] + area[back]) : 0.0;
      for (std::size_t n = 0; n < Dim; ++n) {
        if (is_seen_by_both && !offset[n].empty()) cells.offset[n][k] = 0.5 * (offset[n][k] + offset[n][back]);
      }
    }
  });
}

}  // namespace

template <int Dim>
VoronoiCells<Dim> find_voronoi_cells(VectorField<Dim> const& positions, Domain<Dim> const& domain,
                                     std::vector<Wall<Dim>> const& walls, int threads, bool with_offsets) {
  std::size_t const n = positions.size();
  VoronoiCells<Dim> cells;
  cells.volume.resize(n);
  cells.faces.first.assign(n + 1, 0);
  cells.walls.resize(walls.size());
  std::vector<Part<Dim>> parts;
  std::mutex lock;
  find_cells(positions, domain, walls, with_offsets, threads, [&](std::size_t begin, std::size_t end, CellFinder<Dim>& finder) {
    Part<Dim> part{.begin = begin, .neighbour = {}, .area = {}, .offset = {}, .walls = {}};
    for (std::size_t i = begin; i < end; ++i) {
      FoundCell<Dim> const& cell = finder.find(i);
      cells.volume[i] = cell.volume;
      cells.faces.first[i + 1] = cell.faces.size();
      for (auto const& face : cell.faces) {
        part.neighbour.push_back(face.neighbour.particle);
        part.area.push_back(face.area);
        if (with_offsets) part.offset.push_back(face.offset);
      }
      for (auto const& face : cell.walls) part.walls.push_back({static_cast<std::uint32_t>(i), face.wall, face.area, face.offset});
    }
    std::scoped_lock const hold(lock);
    parts.push_back(std::move(part));
  });
  std::sort(parts.begin(), parts.end(), [](Part<Dim> const& a, Part<Dim> const& b) { return a.begin < b.begin; });
  for (std::size_t i = 0; i < n; ++i) cells.faces.first[i + 1] += cells.faces.first[i];
  cells.faces.neighbour.resize(cells.faces.first[n]);
  cells.area.resize(cells.faces.first[n]);
  for (std::size_t k = 0; with_offsets && k < Dim; ++k) cells.offset[k].resize(cells.faces.first[n]);
  for (Part<Dim> const& part : parts) {
    auto const at = static_cast<std::ptrdiff_t>(cells.faces.first[part.begin]);
    std::copy(part.neighbour.begin(), part.neighbour.end(), cells.faces.neighbour.begin() + at);
    std::copy(part.area.begin(), part.area.end(), cells.area.begin() + at);
    for (std::size_t f = 0; f < part.offset.size(); ++f) {
      for (std::size_t k = 0; k < Dim; ++k)
        cells.offset[k][cells.faces.first[part.begin] + f] = part.offset[f][static_cast<Eigen::Index>(k)];
    }
    for (WallFace<Dim> const& face : part.walls) {
      cells.walls[face.wall].particle.push_back(face.particle);
      cells.walls[face.wall].area.push_back(face.area);
      if (with_offsets) cells.walls[face.wall].offset.push_back(face.offset);
    }
  }
  make_symmetric(cells, threads);
  return cells;
}

template <int Dim>
std::vector<double> voronoi_volumes(VectorField<Dim> const& positions, Domain<Dim> const& domain,
                                    std::vector<Wall<Dim>> const& walls, int threads) {
  std::vector<double> volume(positions.size());
  find_cells(positions, domain, walls, false, threads, [&](std::size_t begin, std::size_t end, CellFinder<Dim>& finder) {
    for (std::size_t i = begin; i < end; ++i) volume[i] = finder.find(i).volume;
  });
  return volume;
}

#define SPHVERIFY_INSTANTIATE(Dim)                                                                                   \
  template VoronoiCells<Dim> find_voronoi_cells(VectorField<Dim> const&, Domain<Dim> const&,                         \
                                                std::vector<Wall<Dim>> const&, int, bool);                           \
  template std::vector<double> voronoi_volumes(VectorField<Dim> const&, Domain<Dim> const&,                          \
                                               std::vector<Wall<Dim>> const&, int);
SPHVERIFY_INSTANTIATE(1)
SPHVERIFY_INSTANTIATE(2)
SPHVERIFY_INSTANTIATE(3)
#undef SPHVERIFY_INSTANTIATE

}  // namespace sphverify
