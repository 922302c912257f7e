// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>

#include "tests/support/dense.hpp"

// On a lattice far from walls every scheme returns the derivative that it stands for times a factor of the
// lattice alone, D = -sum_j V (x_i - x_j) dW_ij/dx_i, which is not 1.
BOOST_AUTO_TEST_SUITE(scheme_consistency)

using namespace sphverify;
using namespace sphverify::tests;

constexpr double spacing = 0.1;
constexpr double ratios[] = {1.0, 1.2, 1.5};

/// A lattice so large that both passes of the particle at the origin see no edge.
template <int Dim>
RandomScene<Dim> lattice(double ratio) {
  RandomScene<Dim> scene = lattice_scene<Dim>(2 * static_cast<int>(std::ceil(4.0 * ratio)) + 1, spacing, ratio);
  scene.particles.scalar(Field::density).assign(scene.particles.size(), 1.3);
  for (double& m : scene.particles.masses()) m *= 1.3;
  scene.particles.scalar(Field::pressure).assign(scene.particles.size(), 0.9);
  scene.particles.scalar(Field::temperature).assign(scene.particles.size(), 1.1);
  scene.particles.scalar(Field::conductivity).assign(scene.particles.size(), 0.7);
  return scene;
}

template <int Dim>
std::size_t centre(RandomScene<Dim> const& scene) {
  return scene.particles.size() / 2;
}

template <int Dim>
double factor(RandomScene<Dim> const& scene) {
  dense::State<Dim> const s(scene);
  std::size_t const i = centre(scene);
  BOOST_TEST_REQUIRE(s.x(i).norm() < 1e-14);
  double sum = 0.0;
  for (std::size_t j = 0; j < s.particles(); ++j)
    sum -= s.m(j) / s.rho(j) * (s.x(i) - s.x(j))[0] * s.gradient(i, j)[0];
  return sum;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(linear_fields_give_their_derivative_times_the_lattices_own_factor, D,
                              Dimensions) {
  constexpr int Dim = D::value;
  for (double const ratio : ratios) {
    Random random(2);
    RandomScene<Dim> scene = lattice<Dim>(ratio);
    Particles<Dim>& p = scene.particles;
    std::size_t const i = centre(scene);
    double const rho = 1.3;
    double const D1 = factor(scene);
    BOOST_TEST_MESSAGE(Dim << "D, h/dx = " << ratio << ": factor " << D1);
    BOOST_TEST(D1 == 1.0, boost::test_tools::tolerance(0.12));

    // A small pressure gradient, so that the root of pressure is linear too.
    RandomScene<Dim> pushed = scene;
    Vector<Dim> const g = 1e-4 * random.vector<Dim>(0.5, 2.0);
    for (std::size_t j = 0; j < p.size(); ++j)
      pushed.particles.scalar(Field::pressure)[j] += g.dot(p.positions()[j]);
    // A velocity with divergence and rotation.
    RandomScene<Dim> moving = scene;
    Matrix<Dim> G;
    for (int k = 0; k < Dim; ++k) G.col(k) = random.vector<Dim>(-1.0, 1.0);
    for (std::size_t j = 0; j < p.size(); ++j)
      moving.particles.vector(Field::velocity).set(j, G * p.positions()[j]);
    // Linear temperature in a medium of linear conductivity: div(K grad T) = grad K . grad T.
    RandomScene<Dim> conducting = scene;
    Vector<Dim> const t = random.vector<Dim>(0.2, 0.9);
    Vector<Dim> const k = random.vector<Dim>(0.2, 0.9);
    for (std::size_t j = 0; j < p.size(); ++j) {
      conducting.particles.scalar(Field::temperature)[j] += t.dot(p.positions()[j]);
      conducting.particles.scalar(Field::conductivity)[j] += k.dot(p.positions()[j]);
    }

    for (SchemeInfo const* scheme : all_scheme_infos()) {
      if (!scheme->claims.linear_on_lattice) continue;
      double const of_one_pass = scheme->claims.lattice_factors == 0 ? 1.0 : D1;
      if (scheme->rate == Rate::acceleration) {
        Vector<Dim> const a = evaluate(pushed, scheme->id, geometry_for(scheme->id, pushed)).acceleration[i];
        BOOST_TEST((a + of_one_pass * g / rho).norm() < 1e-7 * g.norm(), scheme->id);
      } else if (scheme->rate == Rate::conduction_heating) {
        // A harmonic mean of conductivities is linear for small gradients only, as the claims have them.
        if (scheme->claims.mean == ConductivityMean::harmonic) continue;
        bool const is_exact = scheme->claims.lattice_factors == 0;
        Rates<Dim> const rates = evaluate(conducting, scheme->id);
        double const factors = is_exact ? 1.0 : pass_count(*scheme) > 1 ? D1 * D1 : D1;
        BOOST_TEST(rates.heating[i] == factors * t.dot(k) / rho, boost::test_tools::tolerance(1e-10));
        if (!rates.flux.empty()) BOOST_TEST((rates.flux[i] + 0.7 * (is_exact ? 1.0 : D1) * t).norm() < 1e-12, scheme->id);
      } else {
        double const heating = evaluate(moving, scheme->id, geometry_for(scheme->id, moving)).heating[i];
        BOOST_TEST(heating == -0.9 / rho * of_one_pass * G.trace(), boost::test_tools::tolerance(1e-10));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(linear_temperature_in_a_uniform_medium_is_steady, D, Dimensions) {
  constexpr int Dim = D::value;
  RandomScene<Dim> scene = lattice<Dim>(1.2);
  Vector<Dim> const t = Random(3).vector<Dim>(0.2, 0.9);
  for (std::size_t j = 0; j < scene.particles.size(); ++j) {
    scene.particles.scalar(Field::temperature)[j] += t.dot(scene.particles.positions()[j]);
  }
  for (SchemeInfo const* scheme : all_scheme_infos()) {
    if (scheme->rate != Rate::conduction_heating) continue;
    auto const heating = evaluate(scene, scheme->id).heating;
    BOOST_TEST(std::abs(heating[centre(scene)]) < 1e-12 * std::max(1.0, largest(heating)), scheme->id);
  }
}

BOOST_AUTO_TEST_SUITE_END()
