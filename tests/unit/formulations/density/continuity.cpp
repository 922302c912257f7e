// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/density/continuity.hpp"

#include <boost/test/unit_test.hpp>

#include "tests/support/dense.hpp"

BOOST_AUTO_TEST_SUITE(formulations_density_continuity)

using namespace sphverify;
using namespace sphverify::tests;
using boost::test_tools::tolerance;

template <int Dim>
std::vector<double> density_rate(RandomScene<Dim> scene, bool with_walls = true, int threads = 1) {
  auto const continuity = make_continuity_operator<Dim>();
  scene.particles.allocate(needed_fields(continuity->info()));
  PairGeometry<Dim> geometry = geometry_of(scene, with_walls);
  WorkCount work;
  continuity->evaluate(scene.particles, geometry, scene.closure, scene.time, threads, work);
  return scene.particles.scalar(Field::density_rate);
}

/// drho_i/dt = sum_j m_j (v_i - v_j).grad_i W_ij + rho_B (v_i - v_B).S_i
template <int Dim>
std::vector<double> equation(dense::State<Dim> const& s, bool with_walls) {
  std::vector<double> rate(s.particles(), 0.0);
  for (std::size_t i = 0; i < s.particles(); ++i) {
    for (std::size_t j = 0; j < s.particles(); ++j) {
      rate[i] += s.m(j) * (s.v(i) - s.v(j)).dot(s.gradient(i, j));
    }
    for (std::size_t w = 0; with_walls && w < s.walls(); ++w) {
      if (s.touches(i, w)) rate[i] += s.rho(i, w) * (s.v(i) - s.v(i, w)).dot(s.S(i, w));
    }
  }
  return rate;
}

/// Adds a velocity to all particles and to what walls prescribe.
template <int Dim>
void boost_all(RandomScene<Dim>& scene, Vector<Dim> const& boost) {
  for (std::size_t i = 0; i < scene.particles.size(); ++i)
    scene.particles.vector(Field::velocity).add(i, boost);
  for (Wall<Dim>& wall : scene.walls) {
    if (!wall.velocity) continue;
    wall.velocity = [boost, old = wall.velocity](Vector<Dim> const& x, double t) -> Vector<Dim> {
      return old(x, t) + boost;
    };
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(agrees_with_a_dense_sum_of_its_equation, D, Dimensions) {
  constexpr int Dim = D::value;
  double worst = 0.0;
  dense::for_each_scene<Dim>([&](RandomScene<Dim> const& scene, bool with_walls) {
    auto const expected = equation(dense::State<Dim>(scene), with_walls);
    worst = std::max(worst, relative_difference(density_rate(scene, with_walls), expected));
  });
  BOOST_TEST(worst < dense::round_off);
}

BOOST_AUTO_TEST_CASE(particles_that_approach_each_other_or_a_wall_grow_denser) {
  RandomScene<1> scene{.particles = Particles<1>(2, 0.2),
                 .domain = {.lower = Vector<1>(-1.0), .upper = Vector<1>(1.0)}};
  scene.particles.allocate(all_fields);
  scene.particles.positions().component(0) = {-0.1, 0.1};
  scene.particles.masses() = {1.0, 3.0};
  scene.particles.scalar(Field::density) = {1.0, 1.0};
  scene.particles.vector(Field::velocity).component(0) = {0.5, -0.5};
  // grad_i W at r = h is 1/(2 h^2), towards the other.
  double const slope = 0.5 / (0.2 * 0.2);
  std::vector<double> const approaching = density_rate(scene);
  BOOST_TEST(approaching[0] == 3.0 * slope, tolerance(1e-12));
  BOOST_TEST(approaching[1] == 1.0 * slope, tolerance(1e-12));

  scene.particles.vector(Field::velocity).component(0) = {0.5, 0.5};
  scene.walls.push_back({.point = Vector<1>(0.3), .outward_normal = Vector<1>(1.0)});
  for (double const wall_speed : {0.0, 1.0}) {
    scene.walls[0].velocity = [wall_speed](Vector<1> const&, double) { return Vector<1>(wall_speed); };
    std::vector<double> const rate = density_rate(scene);
    // rho_B A (v - v_B), with rho_B = 2 m W(h), A = W(h) and W(h) = 1/(6 h).
    double const W = 1.0 / 1.2;
    BOOST_TEST(rate[1] == 2.0 * 3.0 * W * W * (0.5 - wall_speed), tolerance(1e-12));
  }
}

/// A fine lattice of density 1.7 that moves by a random linear velocity field, and its wall with it.
template <int Dim>
struct Compressed {
  RandomScene<Dim> scene;
  double compression;  ///< -div v

  Compressed(int side, double smoothing_ratio) : scene(lattice_scene<Dim>(side, 1.0, smoothing_ratio)) {
    Random random(4);
    Matrix<Dim> gradient;
    for (int k = 0; k < Dim; ++k) gradient.col(k) = random.vector<Dim>(-0.5, 0.5);
    gradient -= Matrix<Dim>::Identity();
    compression = -gradient.trace();
    auto const velocity = [gradient](Vector<Dim> const& x, double) -> Vector<Dim> { return gradient * x; };
    scene.walls.push_back({.point = scene.domain.upper, .outward_normal = Vector<Dim>::Unit(0)});
    scene.walls[0].velocity = velocity;
    for (std::size_t i = 0; i < scene.particles.size(); ++i) {
      scene.particles.masses()[i] *= 1.7;
      scene.particles.scalar(Field::density)[i] *= 1.7;
      scene.particles.vector(Field::velocity).set(i, velocity(scene.particles.positions()[i], 0.0));
    }
  }
  /// Further than a support from every side but the wall's.
  bool sees_the_wall_only(std::size_t i) const {
    Vector<Dim> const x = scene.particles.positions()[i];
    double const reach = 2.0 * scene.particles.smoothing_length();
    for (int k = 0; k < Dim; ++k) {
      if (x[k] - scene.domain.lower[k] <= reach) return false;
      if (k > 0 && scene.domain.upper[k] - x[k] <= reach) return false;
    }
    return true;
  }
};

BOOST_AUTO_TEST_CASE_TEMPLATE(uniform_compression_gives_gamma_c_rho, D, Dimensions) {
  constexpr int Dim = D::value;
  Compressed<Dim> const lattice(Dim == 1 ? 200 : (Dim == 2 ? 30 : 16),
                                Dim == 1 ? 8.0 : (Dim == 2 ? 4.0 : 2.7));
  std::vector<double> const rate = density_rate(lattice.scene);
  double const h = lattice.scene.particles.smoothing_length();
  double worst = 0.0;
  double least = 1.0;
  for (std::size_t i = 0; i < rate.size(); ++i) {
    if (!lattice.sees_the_wall_only(i)) continue;
    double const d = lattice.scene.walls[0].distance(lattice.scene.particles.positions()[i]);
    double const gamma = d < 2.0 * h ? dense::inner_fraction<Dim>(d, h) : 1.0;
    least = std::min(least, gamma);
    worst = std::max(worst, std::abs(rate[i] / (1.7 * lattice.compression) - gamma));
  }
  BOOST_TEST_MESSAGE(Dim << "D: largest deviation from Gamma " << worst << ", least Gamma " << least);
  BOOST_TEST(least < 0.7);
  BOOST_TEST(worst < (Dim == 1 ? 1e-3 : 0.01));
}

BOOST_AUTO_TEST_CASE(rate_at_the_wall_tends_to_half_of_the_compression_as_h_over_dx_grows) {
  double last = 1.0;
  for (double const ratio : {1.2, 4.0, 16.0, 64.0}) {
    Compressed<1> const lattice(400, ratio);
    double const now = density_rate(lattice.scene).back() / (1.7 * lattice.compression);
    BOOST_TEST(now < last);
    last = now;
  }
  BOOST_TEST(last == 0.5, tolerance(0.02));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(without_its_wall_term_the_rate_at_a_wall_is_not_gamma_c_rho, D, Dimensions) {
  constexpr int Dim = D::value;
  Compressed<Dim> const lattice(Dim == 1 ? 200 : (Dim == 2 ? 30 : 16), 2.7);
  std::vector<double> const with = density_rate(lattice.scene);
  std::vector<double> const without = density_rate(lattice.scene, false);
  BOOST_TEST(relative_difference(without, with) > 0.05);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(does_not_depend_on_the_frame, D, Dimensions) {
  constexpr int Dim = D::value;
  Random random(6);
  for (Closure const closure : {Closure::quotient, Closure::one_sided}) {
    // The second wall's velocity comes from the closure.
    RandomScene<Dim> scene = random_scene<Dim>(11, 60, {BoundaryValue::velocity}, {BoundaryValue::pressure});
    scene.closure = closure;
    for (Wall<Dim>& wall : scene.walls) wall.gamma = 1.4;
    std::vector<double> const rest = density_rate(scene);
    boost_all<Dim>(scene, random.vector<Dim>(-10.0, 10.0));
    BOOST_TEST(relative_difference(density_rate(scene), rest) < 1e-12);
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(density_stands_still_exactly_where_all_moves_with_the_wall, D, Dimensions) {
  constexpr int Dim = D::value;
  RandomScene<Dim> scene = random_scene<Dim>(12, 60, {}, {});
  Vector<Dim> const velocity = Random(3).vector<Dim>(-2.0, 2.0);
  for (std::size_t i = 0; i < 60; ++i) scene.particles.vector(Field::velocity).set(i, velocity);
  for (Wall<Dim>& wall : scene.walls)
    wall.velocity = [velocity](Vector<Dim> const&, double) -> Vector<Dim> { return velocity; };
  BOOST_TEST(largest(density_rate(scene)) == 0.0);
  scene.walls[0].velocity = [velocity](Vector<Dim> const&, double) -> Vector<Dim> { return 2.0 * velocity; };
  BOOST_TEST(largest(density_rate(scene)) > 0.1);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(writes_the_density_rate_and_nothing_else, D, Dimensions) {
  constexpr int Dim = D::value;
  auto const continuity = make_continuity_operator<Dim>();
  BOOST_TEST((continuity->info().rate == Rate::density));
  BOOST_TEST((output_field(Rate::density) == Field::density_rate));
  BOOST_TEST(
      (needed_fields(continuity->info()) == FieldSet{Field::density, Field::velocity, Field::density_rate}));

  RandomScene<Dim> scene = random_scene<Dim>(13, 60);
  scene.particles.allocate(Field::density_rate);
  scene.particles.scalar(Field::heating).assign(60, 5.0);
  scene.particles.vector(Field::acceleration).component(0).assign(60, 6.0);
  std::vector<double> const density = scene.particles.scalar(Field::density);
  PairGeometry<Dim> geometry = geometry_of(scene);
  WorkCount work;
  for (int n = 0; n < 2; ++n) {
    continuity->evaluate(scene.particles, geometry, Closure::interpolated, 0.0, 1, work);
    BOOST_TEST(relative_difference(scene.particles.scalar(Field::density_rate), [&] {
                 RandomScene<Dim> at_start = scene;
                 at_start.time = 0.0;
                 return equation(dense::State<Dim>(at_start), true);
               }()) < dense::round_off);
  }
  BOOST_TEST(same_bits(scene.particles.scalar(Field::heating), std::vector<double>(60, 5.0)));
  BOOST_TEST(
      same_bits(scene.particles.vector(Field::acceleration).component(0), std::vector<double>(60, 6.0)));
  BOOST_TEST(same_bits(scene.particles.scalar(Field::density), density));
  BOOST_TEST(work.evaluations == 2u);
  BOOST_TEST(work.pair_interactions == 2 * geometry.neighbours.pairs());
  BOOST_TEST(continuity->wall_force().empty());
}

BOOST_AUTO_TEST_CASE(is_none_of_the_compared_formulations) {
  BOOST_TEST(find_scheme(ContinuityDensity::info.id) == nullptr);
  for (SchemeInfo const* scheme : all_scheme_infos()) BOOST_TEST((scheme->rate != Rate::density));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(threads_do_not_change_a_bit, D, Dimensions) {
  constexpr int Dim = D::value;
  RandomScene<Dim> const scene = random_scene<Dim>(14, 3000);
  BOOST_TEST(same_bits(density_rate(scene, true, 1), density_rate(scene, true, 2)));
}

BOOST_AUTO_TEST_SUITE_END()
