// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/least_squares/quadratic_weights.hpp"

#include <boost/test/unit_test.hpp>

#include "formulations/basics/undefined_rate.hpp"
#include "tests/support/cell_scenes.hpp"

BOOST_AUTO_TEST_SUITE(formulations_least_squares_quadratic_weights)

using namespace sphverify;
using namespace sphverify::tests;

/// 1 + g.x + x.H.x/2
template <int Dim>
struct Quadratic {
  Vector<Dim> g;
  Matrix<Dim> H;
  explicit Quadratic(std::uint64_t seed) {
    Random random(seed);
    g = random.vector<Dim>(-2.0, 2.0);
    for (int k = 0; k < Dim; ++k) H.col(k) = random.vector<Dim>(-3.0, 3.0);
    H = (0.5 * (H + H.transpose())).eval();
  }
  double operator()(Vector<Dim> const& x) const { return 1.0 + g.dot(x) + 0.5 * x.dot(H * x); }
  Vector<Dim> gradient(Vector<Dim> const& x) const { return g + H * x; }
};

/// Particles in a box of walls, each second one of which prescribes flux.
template <int Dim>
RandomScene<Dim> box(double amplitude, bool turned) {
  Domain<Dim> const domain = box_of<Dim>(Sides::walls, turned);
  int const resolution = Dim == 3 ? 7 : 12;
  Layout<Dim> const layout = jittered(domain, resolution, amplitude, 3);
  RandomScene<Dim> scene{.particles = Particles<Dim>(layout.positions.size(), 1.4 * layout.spacing),
                         .domain = domain, .walls = walls_of(domain)};
  scene.particles.allocate(all_fields);
  scene.particles.positions() = layout.positions;
  scene.particles.masses() = layout.volumes;
  scene.particles.scalar(Field::density).assign(layout.volumes.size(), 1.0);
  for (std::size_t w = 0; w < scene.walls.size(); w += 2)
    scene.walls[w].flux = [](Vector<Dim> const&, double) -> Vector<Dim> { return Vector<Dim>::Zero(); };
  for (std::size_t w = 1; w < scene.walls.size(); w += 2) {
    scene.walls[w].temperature = [](Vector<Dim> const&, double) { return 0.0; };
    scene.walls[w].conductivity = [](Vector<Dim> const&, double) { return 1.0; };
  }
  return scene;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(differences_give_the_laplacian_of_every_quadratic_into_corners, D, Dimensions) {
  constexpr int Dim = D::value;
  for (bool const turned : {false, true}) {
    if (turned && Dim == 1) continue;
    for (double const amplitude : {0.0, 0.1, 0.3, 0.45}) {
      RandomScene<Dim> const scene = box<Dim>(amplitude, turned);
      PairGeometry<Dim> const given = geometry_of(scene);
      QuadraticWeights<Dim> weights;
      PairGeometry<Dim> const& g = weights.on(scene.particles, given, 2);
      Quadratic<Dim> const f(5);
      auto const& x = scene.particles.positions();
      std::vector<double> sum(x.size(), 0.0), gross(x.size(), 0.0);
      auto const add = [&](std::size_t i, double what) {
        sum[i] += what;
        gross[i] += std::abs(what);
      };
      for (std::size_t i = 0; i < x.size(); ++i) {
        for (std::size_t k = g.neighbours.first[i]; k < g.neighbours.first[i + 1]; ++k)
          add(i, g.neighbours.slope[k] * (f(x[g.neighbours.neighbour[k]]) - f(x[i])));
      }
      for (WallContacts<Dim> const& contacts : g.contacts) {
        for (std::size_t c = 0; c < contacts.size(); ++c) {
          std::size_t const i = contacts.particle[c];
          Vector<Dim> const foot = contacts.foot[c];
          contacts.prescribes_flux_only
              ? add(i, contacts.face_weight[c] * f.gradient(foot).dot(contacts.outward_normal))
              : add(i, contacts.face_weight[c] / contacts.distance[c] * (f(foot) - f(x[i])));
        }
      }
      double worst = 0.0;
      for (std::size_t i = 0; i < x.size(); ++i) worst = std::max(worst, std::abs(sum[i] - f.H.trace()) / gross[i]);
      BOOST_TEST(worst < 1e-11, amplitude << ": " << worst);
    }
  }
}

BOOST_AUTO_TEST_CASE(weights_are_kept_until_something_moves) {
  RandomScene<2> scene = box<2>(0.2, false);
  PairGeometry<2> geometry = geometry_of(scene);
  QuadraticWeights<2> weights;
  double const* const first = weights.on(scene.particles, geometry, 1).neighbours.slope.data();
  std::vector<double> const before(first, first + geometry.neighbours.pairs());
  BOOST_TEST(weights.on(scene.particles, geometry, 1).neighbours.slope.data() == first);
  auto const changed = [&] {
    auto const& now = weights.on(scene.particles, geometry, 1).neighbours.slope;
    return !same_bits(std::vector<double>(now.begin(), now.end()), before);
  };
  BOOST_TEST(!changed());
  scene.particles.positions().add(7, Vector<2>(1e-4, 0.0));
  BOOST_TEST(changed());
  scene.particles.positions().add(7, Vector<2>(-1e-4, 0.0));
  BOOST_TEST(!changed());  // found anew where they were
  double const place = geometry.contacts[1].foot.component(0)[0];
  geometry.contacts[1].foot.component(0)[0] += 1e-3;
  PairGeometry<2> const& moved = weights.on(scene.particles, geometry, 1);
  BOOST_TEST(moved.contacts[1].foot.component(0)[0] != place);
  BOOST_TEST(changed());  // of a particle's pairs beside that wall
  geometry.contacts[1].foot.component(0)[0] = place;
  BOOST_TEST(!changed());
  geometry.contacts[1].distance[0] *= 2.0;
  double const before_wall = weights.last().contacts[1].face_weight[0];
  BOOST_TEST(weights.on(scene.particles, geometry, 1).contacts[1].face_weight[0] == 2.0 * before_wall);
}

BOOST_AUTO_TEST_CASE(every_particle_goes_by_its_own_smoothing_length) {
  RandomScene<2> scene = box<2>(0.2, false);
  PairGeometry<2> const geometry = geometry_of(scene);
  RandomScene<2> own = scene;
  own.particles.vary_smoothing_length();
  QuadraticWeights<2> common, each;
  auto const weights_in = [&](QuadraticWeights<2>& weights, RandomScene<2> const& of) {
    auto const& now = weights.on(of.particles, geometry, 1).neighbours.slope;
    return std::vector<double>(now.begin(), now.end());
  };
  std::vector<double> const alike = weights_in(common, scene);
  BOOST_TEST(same_bits(weights_in(each, own), alike));
  own.particles.smoothing_lengths()[5] *= 0.9;
  std::vector<double> const varied = weights_in(each, own);
  for (std::size_t i = 0; i < scene.particles.size(); ++i) {
    bool same = true;
    for (std::size_t k = geometry.neighbours.first[i]; k < geometry.neighbours.first[i + 1]; ++k) same = same && varied[k] == alike[k];
    BOOST_TEST(same == (i != 5), i);
  }
}

BOOST_AUTO_TEST_CASE(does_not_depend_on_threads) {
  RandomScene<3> const scene = box<3>(0.3, true);
  PairGeometry<3> const geometry = geometry_of(scene);
  QuadraticWeights<3> one, two;
  auto const& a = one.on(scene.particles, geometry, 1).neighbours.slope;
  auto const& b = two.on(scene.particles, geometry, 2).neighbours.slope;
  BOOST_TEST(same_bits({a.begin(), a.end()}, {b.begin(), b.end()}));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(too_few_partners_or_all_on_one_line_are_refused_by_number, D, Dimensions) {
  constexpr int Dim = D::value;
  auto const names = [](std::string const& who) {
    return [who](TooFewPartners const& error) { return std::string(error.what()).starts_with(who + ": too few partners"); };
  };
  RandomScene<Dim> scene = box<Dim>(0.0, false);
  scene.walls.clear();
  scene.particles.positions().set(4, scene.domain.upper + Vector<Dim>::Constant(5.0));
  scene.domain.upper += Vector<Dim>::Constant(6.0);
  QuadraticWeights<Dim> weights;
  BOOST_CHECK_EXCEPTION(weights.on(scene.particles, geometry_of(scene), 2), TooFewPartners, names("particle 4"));
  if constexpr (Dim > 1) {
    RandomScene<Dim> row = lattice_scene<Dim>(8, 0.1, 3.0);
    for (std::size_t i = 0; i < row.particles.size(); ++i)
      row.particles.positions().set(i, 0.05 * static_cast<double>(i) * Vector<Dim>::Ones());
    row.domain.upper = Vector<Dim>::Constant(50.0);
    BOOST_CHECK_EXCEPTION(weights.on(row.particles, geometry_of(row), 1), TooFewPartners, names("particle 0"));
  }
}

BOOST_AUTO_TEST_SUITE_END()
