// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/cells/voronoi_cells.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <string>

#include "tests/support/cell_scenes.hpp"

BOOST_AUTO_TEST_SUITE(formulations_cells_voronoi_cells)

using namespace sphverify;
using namespace sphverify::tests;

BOOST_AUTO_TEST_CASE_TEMPLATE(faces_close_are_the_same_from_both_sides_and_volumes_fill_the_box, D, Dimensions) {
  constexpr int Dim = D::value;
  for (CellScene<Dim> const& scene : cell_scenes<Dim>()) {
    VoronoiCells<Dim> const cells = scene.cells();
    std::size_t const n = scene.positions.size();
    std::vector<Vector<Dim>> sum(n, Vector<Dim>::Zero());
    std::vector<double> surface(n, 0.0);
    std::map<std::pair<std::size_t, std::size_t>, double> seen;
    double volume = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      volume += cells.volume[i];
      for (std::size_t k = cells.faces.first[i]; k < cells.faces.first[i + 1]; ++k) {
        std::size_t const j = cells.faces.neighbour[k];
        Vector<Dim> const r = scene.domain.nearest_image(scene.positions[j] - scene.positions[i]);
        sum[i] += cells.area[k] * r.normalized();
        surface[i] += cells.area[k];
        seen[{i, j}] = cells.area[k];
        BOOST_TEST_REQUIRE(cells.area[k] >= 0.0);
      }
    }
    for (std::size_t w = 0; w < scene.walls.size(); ++w) {
      double area = 0.0;
      for (std::size_t c = 0; c < cells.walls[w].particle.size(); ++c) {
        std::size_t const i = cells.walls[w].particle[c];
        sum[i] += cells.walls[w].area[c] * scene.walls[w].outward_normal;
        surface[i] += cells.walls[w].area[c];
        area += cells.walls[w].area[c];
      }
      double whole = 1.0;
      for (int k = 0; k < Dim; ++k) {
        if (std::abs(scene.domain.axes.col(k).dot(scene.walls[w].outward_normal)) < 0.5) whole *= scene.domain.extent()[k];
      }
      BOOST_TEST(std::abs(area - whole) < 1e-12 * whole, scene.name);
    }
    double worst = 0.0;
    for (std::size_t i = 0; i < n; ++i) worst = std::max(worst, sum[i].norm() / surface[i]);
    BOOST_TEST(worst < 1e-12, scene.name << ": closure " << worst);
    BOOST_TEST(std::abs(volume - scene.domain.volume()) < 1e-12 * scene.domain.volume(), scene.name);
    bool symmetric = true;
    for (auto const& [pair, area] : seen) {
      auto const back = seen.find({pair.second, pair.first});
      symmetric = symmetric && (back == seen.end() ? area == 0.0 : back->second == area);
    }
    BOOST_TEST(symmetric, scene.name);
  }
}

/// The divergence theorem: sum_f a_f x_f n_f^T = V I with x_f the centroids, of walls too; so sum_f a_f c_f n_f^T is symmetric.
BOOST_AUTO_TEST_CASE_TEMPLATE(centroids_have_the_moments_of_the_divergence_theorem, D, Dimensions) {
  constexpr int Dim = D::value;
  for (CellScene<Dim> const& scene : cell_scenes<Dim>()) {
    VoronoiCells<Dim> const cells = find_voronoi_cells(scene.positions, scene.domain, scene.walls, 1, true);
    std::size_t const n = scene.positions.size();
    std::vector<Matrix<Dim>> moment(n, Matrix<Dim>::Zero());
    std::vector<double> size(n, 0.0);
    std::map<std::pair<std::size_t, std::size_t>, Vector<Dim>> seen;
    double across = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t k = cells.faces.first[i]; k < cells.faces.first[i + 1]; ++k) {
        std::size_t const j = cells.faces.neighbour[k];
        Vector<Dim> const r = scene.domain.nearest_image(scene.positions[j] - scene.positions[i]);
        Vector<Dim> c;
        for (int a = 0; a < Dim; ++a) c[a] = cells.offset[static_cast<std::size_t>(a)][k];
        moment[i] += cells.area[k] * (0.5 * r + c) * r.normalized().transpose();
        size[i] += cells.area[k] * (0.5 * r + c).norm();
        across = std::max(across, cells.area[k] > 0.0 ? std::abs(c.dot(r.normalized())) : 0.0);
        seen[{i, j}] = c;
      }
    }
    for (std::size_t w = 0; w < scene.walls.size(); ++w) {
      for (std::size_t f = 0; f < cells.walls[w].particle.size(); ++f) {
        std::size_t const i = cells.walls[w].particle[f];
        Vector<Dim> const n_B = scene.walls[w].outward_normal;
        Vector<Dim> const x = scene.walls[w].distance(scene.positions[i]) * n_B + cells.walls[w].offset[f];
        moment[i] += cells.walls[w].area[f] * x * n_B.transpose();
        size[i] += cells.walls[w].area[f] * x.norm();
      }
    }
    double worst = 0.0;
    for (std::size_t i = 0; i < n; ++i)
      worst = std::max(worst, (moment[i] - cells.volume[i] * Matrix<Dim>::Identity()).norm() / size[i]);
    BOOST_TEST(worst < 1e-12, scene.name << ": " << worst);
    BOOST_TEST(across < 1e-12, scene.name << ": " << across);
    bool symmetric = true;
    for (auto const& [pair, c] : seen) {
      auto const back = seen.find({pair.second, pair.first});
      symmetric = symmetric && (back == seen.end() || back->second == c);
    }
    BOOST_TEST(symmetric, scene.name);
  }
}

/// Cells of a square that three particles share, by hand: the face between the first two is the lower part of the bisector.
BOOST_AUTO_TEST_CASE(centroids_of_three_cells_in_a_square_are_those_of_a_drawing) {
  Domain<2> square{.lower = Vector<2>::Zero(), .upper = Vector<2>::Constant(4.0)};
  VectorField<2> places(3);
  places.set(0, {1.0, 1.0});
  places.set(1, {3.0, 1.0});
  places.set(2, {2.0, 3.0});
  VoronoiCells<2> const cells = find_voronoi_cells(places, square, walls_of(square), 1, true);
  // All three are 1.25 from (2, 1.75): there their faces meet. That of 0 and 1 runs down to (2, 0), with its middle at 0.875.
  for (std::size_t k = cells.faces.first[0]; k < cells.faces.first[1]; ++k) {
    if (cells.faces.neighbour[k] != 1) continue;
    BOOST_TEST(std::abs(cells.area[k] - 1.75) < 1e-15);
    BOOST_TEST(std::abs(cells.offset[0][k]) < 1e-15);
    BOOST_TEST(std::abs(cells.offset[1][k] - (0.875 - 1.0)) < 1e-15);
  }
  // The lower wall is halved: the first particle's part has its centroid at the particle's foot point.
  for (std::size_t w = 0; w < 4; ++w) {
    if (walls_of(square)[w].outward_normal[1] > -0.5) continue;
    BOOST_TEST_REQUIRE(cells.walls[w].particle.size() == 2u);
    for (std::size_t c = 0; c < 2; ++c) BOOST_TEST(cells.walls[w].offset[c].norm() < 1e-15);
  }
  // The left wall is parted where the bisector of 0 and 2, x + 2 y = 5.5, meets it, at 2.75: beyond the foot of the first.
  for (std::size_t w = 0; w < 4; ++w) {
    if (walls_of(square)[w].outward_normal[0] > -0.5) continue;
    BOOST_TEST_REQUIRE(cells.walls[w].particle.front() == 0u);
    BOOST_TEST(std::abs(cells.walls[w].area.front() - 2.75) < 1e-15);
    BOOST_TEST(std::abs(cells.walls[w].offset.front()[1] - (1.375 - 1.0)) < 1e-15);
  }
}

/// sum_f a_f x_f n_f^T = V I with x_f anywhere on the face's plane gives the trace: sum_f a_f (distance of the plane) = Dim V.
/// Points drawn at random fall to their nearest particle: another way to the volumes.
BOOST_AUTO_TEST_CASE_TEMPLATE(volumes_are_the_share_of_points_that_are_nearest, D, Dimensions) {
  constexpr int Dim = D::value;
  for (Sides const sides : {Sides::walls, Sides::periodic}) {
    Domain<Dim> const domain = box_of<Dim>(sides, false);
    CellScene<Dim> const scene{"", domain, walls_of(domain), jittered(domain, Dim == 1 ? 12 : Dim == 2 ? 6 : 5, 0.4, 2).positions};
    VoronoiCells<Dim> const cells = scene.cells();
    std::size_t const n = scene.positions.size();
    std::vector<double> hits(n, 0.0);
    Random random(3);
    constexpr int draws = 200'000;
    for (int d = 0; d < draws; ++d) {
      Vector<Dim> const x = domain.lower + random.vector<Dim>(0.0, 1.0).cwiseProduct(domain.extent());
      std::size_t nearest = 0;
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < n; ++i) {
        double const away = domain.nearest_image(x - scene.positions[i]).squaredNorm();
        if (away < least) {
          least = away;
          nearest = i;
        }
      }
      hits[nearest] += 1.0;
    }
    for (std::size_t i = 0; i < n; ++i) {
      double const share = cells.volume[i] / domain.volume();
      double const deviation = std::sqrt(share * (1.0 - share) / draws);
      BOOST_TEST(std::abs(hits[i] / draws - share) < 5.0 * deviation);
    }
  }
}

/// Edges of the hexagons of a triangular lattice, faces of the rhombic dodecahedra of a close packing, by hand.
BOOST_AUTO_TEST_CASE(cells_of_lattices_have_the_faces_of_geometry) {
  double const a = 0.1;
  Domain<2> plane{.lower = Vector<2>::Zero(), .upper = {10 * a, 10 * a * std::numbers::sqrt3 / 2.0}};
  plane.periodic.fill(true);
  VectorField<2> triangular(100);
  for (std::size_t i = 0; i < 100; ++i) {
    std::size_t const row = i / 10;
    triangular.set(i, {a * (static_cast<double>(i % 10) + 0.25 + 0.5 * static_cast<double>(row % 2)),
                       a * std::numbers::sqrt3 / 2.0 * (static_cast<double>(row) + 0.5)});
  }
  VoronoiCells<2> const hexagons = find_voronoi_cells<2>(triangular, plane, {}, 1);
  for (std::size_t i = 0; i < 100; ++i) {
    BOOST_TEST(hexagons.faces.row(i).size() == 6u);
    BOOST_TEST(std::abs(hexagons.volume[i] - a * a * std::numbers::sqrt3 / 2.0) < 1e-15);
  }
  for (double const area : hexagons.area) BOOST_TEST(std::abs(area - a / std::numbers::sqrt3) < 1e-14);

  Domain<3> cube{.lower = Vector<3>::Zero(), .upper = Vector<3>::Ones()};
  cube.periodic.fill(true);
  Layout<3> const packed = close_packed(cube, 6);
  double const edge = packed.cell[0];
  VoronoiCells<3> const dodecahedra = find_voronoi_cells<3>(packed.positions, cube, {}, 1);
  for (std::size_t i = 0; i < packed.positions.size(); ++i) {
    BOOST_TEST(dodecahedra.faces.row(i).size() == 12u);
    BOOST_TEST(std::abs(dodecahedra.volume[i] - edge * edge * edge / 4.0) < 1e-14);
  }
  // Rhombi with the diagonals edge/2 and edge/sqrt(2).
  for (double const area : dodecahedra.area) BOOST_TEST(std::abs(area - edge * edge / (4.0 * std::numbers::sqrt2)) < 1e-14);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(any_number_of_threads_finds_the_same, D, Dimensions) {
  constexpr int Dim = D::value;
  Domain<Dim> const domain = box_of<Dim>(Sides::mixed, false);
  CellScene<Dim> const scene{"", domain, walls_of(domain), jittered(domain, Dim == 1 ? 3000 : Dim == 2 ? 60 : 15, 0.4, 1).positions};
  VoronoiCells<Dim> const one = scene.cells(1);
  auto const offsets = find_voronoi_cells(scene.positions, scene.domain, scene.walls, 1, true).offset;
  BOOST_TEST(one.offset[0].empty());
  for (int const threads : {2, 5}) {
    VoronoiCells<Dim> const more = scene.cells(threads);
    BOOST_TEST((find_voronoi_cells(scene.positions, scene.domain, scene.walls, threads, true).offset == offsets));
    BOOST_TEST((more.faces.first == one.faces.first && more.faces.neighbour == one.faces.neighbour && more.area == one.area));
    BOOST_TEST(more.volume == one.volume);
    for (std::size_t w = 0; w < one.walls.size(); ++w)
      BOOST_TEST((more.walls[w].particle == one.walls[w].particle && more.walls[w].area == one.walls[w].area));
    BOOST_TEST(voronoi_volumes(scene.positions, scene.domain, scene.walls, threads) == one.volume);
  }
}

/// What is said of places that have no cells; empty where they have.
template <int Dim>
std::string complaint(VectorField<Dim> const& positions, Domain<Dim> const& domain, std::vector<Wall<Dim>> const& walls, int threads = 1) {
  try {
    find_voronoi_cells(positions, domain, walls, threads);
  } catch (std::invalid_argument const& error) {
    return error.what();
  }
  return "";
}

BOOST_AUTO_TEST_CASE_TEMPLATE(what_has_no_cell_is_named, D, Dimensions) {
  constexpr int Dim = D::value;
  Domain<Dim> const closed = box_of<Dim>(Sides::walls, false);
  std::vector<Wall<Dim>> const walls = walls_of(closed);
  VectorField<Dim> const good = lattice(closed, 6).positions;
  BOOST_TEST(complaint(good, closed, walls) == "");
  auto const with = [&](std::size_t i, Vector<Dim> const& x) {
    VectorField<Dim> bad = good;
    bad.set(i, x);
    return bad;
  };
  for (int const threads : {1, 3}) {
    BOOST_TEST(complaint(with(4, good[2]), closed, walls, threads) == "particles 2 and 4 are at the same place");
    Vector<Dim> x = good[3];
    x[0] = closed.lower[0];
    BOOST_TEST(complaint(with(3, x), closed, walls, threads) == "particle 3 lies on or outside wall 0: it has no Voronoi cell");
    x[0] = closed.upper[0] + 0.01;
    BOOST_TEST(complaint(with(3, x), closed, walls, threads) == "particle 3 lies on or outside wall 1: it has no Voronoi cell");
    std::vector<Wall<Dim>> const open(walls.begin() + 1, walls.end());
    BOOST_TEST(complaint(good, closed, open, threads) ==
               "particle 0 has an unbounded Voronoi cell: the fluid has a side with neither wall nor periodic image");
  }
  // Alone between walls a particle has the whole box.
  VectorField<Dim> alone(1);
  alone.set(0, good[0]);
  BOOST_TEST(complaint(alone, closed, walls) == "");
  BOOST_TEST(std::abs(find_voronoi_cells(alone, closed, walls, 1).volume[0] - closed.volume()) < 1e-13);
  // Along a periodic axis one meets itself, two meet twice, and two of three may meet the long way round.
  Domain<Dim> const periodic = box_of<Dim>(Sides::periodic, false);
  std::string const too_few = ": a periodic axis has too few particles along it";
  BOOST_TEST(complaint(alone, periodic, {}) == "particle 0 has a Voronoi cell that meets its own image" + too_few);
  if constexpr (Dim == 1) {
    auto const at = [&](std::vector<double> const& places) {
      VectorField<1> x(places.size());
      for (std::size_t i = 0; i < places.size(); ++i) x.set(i, Vector<1>(periodic.lower[0] + places[i]));
      return complaint(x, periodic, {});
    };
    BOOST_TEST(at({0.2, 0.7}) == "particle 0 has a Voronoi cell that meets two images of particle 1" + too_few);
    BOOST_TEST(at({0.1, 0.65, 0.7}) == "particle 0 has a Voronoi cell that meets particle 1 beyond half of the periodic axis" + too_few);
    BOOST_TEST(at({0.1, 0.4, 0.7}) == "");
  }
}

/// Far from the origin differences of coordinates are coarse; a lattice stays one with as few faces.
BOOST_AUTO_TEST_CASE_TEMPLATE(a_lattice_far_from_the_origin_or_of_odd_size_keeps_its_faces, D, Dimensions) {
  constexpr int Dim = D::value;
  for (double const shift : {0.0, 1.0, 1e3}) {
    for (double const size : {1e-9, 1.0, 3e7}) {
      Domain<Dim> domain{.lower = Vector<Dim>::Constant(shift * size), .upper = Vector<Dim>::Constant((shift + 1.0) * size)};
      VectorField<Dim> const positions = lattice(domain, 7).positions;
      VoronoiCells<Dim> const cells = find_voronoi_cells(positions, domain, walls_of(domain), 1);
      double volume = 0.0;
      for (double const one : cells.volume) volume += one;
      BOOST_TEST(std::abs(volume - domain.volume()) < 1e-11 * (1.0 + shift) * domain.volume());
      std::size_t const inner = static_cast<std::size_t>(2 * Dim) * positions.size() - static_cast<std::size_t>(2 * Dim) * positions.size() / 7;
      BOOST_TEST(cells.faces.pairs() == inner);
    }
  }
}

/// What is nearer to each other than rounding lets faces be told apart is off by as much as it is near.
BOOST_AUTO_TEST_CASE(a_close_pair_closes_as_far_as_coordinates_tell_it_apart) {
  Domain<3> const box{.lower = Vector<3>::Zero(), .upper = Vector<3>::Ones()};
  for (double const apart : {1e-3, 1e-6, 1e-9}) {
    VectorField<3> positions = jittered(box, 5, 0.4, 6).positions;
    positions.set(60, positions[61] + apart * Vector<3>(0.6, 0.0, 0.8));
    VoronoiCells<3> const cells = find_voronoi_cells(positions, box, walls_of(box), 1);
    double volume = 0.0;
    for (double const one : cells.volume) volume += one;
    BOOST_TEST(std::abs(volume - 1.0) < 1e-12);
    for (std::size_t i = 0; i < positions.size(); ++i) {
      Vector<3> sum = Vector<3>::Zero();
      double surface = 0.0;
      for (std::size_t k = cells.faces.first[i]; k < cells.faces.first[i + 1]; ++k) {
        Vector<3> const r = positions[cells.faces.neighbour[k]] - positions[i];
        sum += cells.area[k] * r.normalized();
        surface += cells.area[k];
      }
      for (std::size_t w = 0; w < cells.walls.size(); ++w) {
        for (std::size_t c = 0; c < cells.walls[w].particle.size(); ++c) {
          if (cells.walls[w].particle[c] == i) sum += cells.walls[w].area[c] * walls_of(box)[w].outward_normal;
        }
      }
      BOOST_TEST(sum.norm() < std::max(1e-13, 1e-15 / apart) * surface);
    }
  }
}

/// A particle in the middle of many on a sphere has as many faces; the planes outgrow their first table.
BOOST_AUTO_TEST_CASE(a_cell_may_have_hundreds_of_faces) {
  Domain<3> const box{.lower = Vector<3>::Constant(-2.0), .upper = Vector<3>::Constant(2.0)};
  constexpr std::size_t around = 600;
  VectorField<3> positions(around + 1);
  positions.set(0, Vector<3>::Zero());
  double const golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
  for (std::size_t k = 0; k < around; ++k) {
    double const z = 1.0 - (2.0 * static_cast<double>(k) + 1.0) / around;
    double const rho = std::sqrt(1.0 - z * z);
    double const angle = golden * static_cast<double>(k);
    positions.set(k + 1, Vector<3>(rho * std::cos(angle), rho * std::sin(angle), z));
  }
  VoronoiCells<3> const cells = find_voronoi_cells(positions, box, walls_of(box), 2);
  BOOST_TEST(cells.faces.row(0).size() == around);
  double surface = 0.0;
  for (std::size_t k = 0; k < around; ++k) surface += cells.area[k];
  // All faces are half a unit away: volume and surface go together, a little more than a ball's.
  BOOST_TEST(std::abs(cells.volume[0] - surface / 6.0) < 1e-13);
  BOOST_TEST(surface > std::numbers::pi);
  BOOST_TEST(surface < 1.02 * std::numbers::pi);
}

BOOST_AUTO_TEST_SUITE_END()
