// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/particles/smoothing_length.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>

#include "formulations/density/density.hpp"
#include "tests/support/dense.hpp"
#include "tests/support/gathered_pairs.hpp"

BOOST_AUTO_TEST_SUITE(formulations_particles_smoothing_length)

using namespace sphverify;
using namespace sphverify::tests;
using boost::test_tools::tolerance;

/// Random particles whose smoothing lengths vary by a factor of two, independent of all else. In 2D and 3D
/// with more particles, so that the box holds two of the largest supports along a periodic axis.
template <int Dim>
RandomScene<Dim> varied_scene(std::uint64_t seed, bool periodic = false) {
  RandomScene<Dim> scene = random_scene<Dim>(seed, Dim == 1 ? 60 : (Dim == 2 ? 120 : 300));
  if (periodic) {
    scene.domain.periodic.fill(true);
    scene.walls.clear();
  }
  scene.particles.vary_smoothing_length();
  Random random(seed + 77);
  for (double& h : scene.particles.smoothing_lengths()) h *= random.uniform(0.6, 1.2);
  return scene;
}

template <int Dim>
Particles<Dim> evaluated(RandomScene<Dim> scene, PairGeometry<Dim> geometry, std::string_view id) {
  auto const scheme = make_rate_operator<Dim>(id);
  WorkCount work;
  scheme->evaluate(scene.particles, geometry, scene.closure, scene.time, 1, work);
  return scene.particles;
}

BOOST_AUTO_TEST_CASE(one_for_all_until_each_particle_gets_its_own) {
  Particles<2> particles(3, 0.3);
  SmoothingLength const common(particles);
  BOOST_TEST(common.is_uniform());
  BOOST_TEST(particles.smoothing_lengths().empty());
  BOOST_TEST(common(2) == 0.3);
  BOOST_TEST(common(0, 2) == 0.3);
  BOOST_TEST(common.largest() == 0.3);

  std::size_t const bytes = particles.bytes();
  particles.vary_smoothing_length();
  BOOST_TEST((particles.smoothing_lengths() == std::vector<double>{0.3, 0.3, 0.3}));
  BOOST_TEST(particles.bytes() == bytes + 3 * sizeof(double));
  particles.smoothing_lengths() = {0.3, 0.7, 0.1};
  SmoothingLength const own(particles);
  BOOST_TEST(!own.is_uniform());
  BOOST_TEST(own(1) == 0.7);
  BOOST_TEST(own(2) == 0.1);
  BOOST_TEST(own(0, 1) == 0.5, tolerance(1e-15));
  BOOST_TEST(own(1, 2) == own(2, 1));
  BOOST_TEST(own(1, 1) == 0.7);
  BOOST_TEST(own.largest() == 0.7);
  particles.smoothing_lengths()[2] = 0.9;  // it looks, it does not copy
  BOOST_TEST(own.largest() == 0.9);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(neighbours_are_the_pairs_within_the_support_of_their_mean_smoothing_length, D,
                              Dimensions) {
  constexpr int Dim = D::value;
  for (bool const periodic : {false, true}) {
    if (periodic && Dim == 3) continue;  // the box is shorter than two supports
    RandomScene<Dim> const scene = varied_scene<Dim>(1, periodic);
    NeighbourList const list = geometry_of(scene).neighbours;
    auto const& x = scene.particles.positions();
    auto const& h = scene.particles.smoothing_lengths();
    bool good = true;
    std::size_t beyond_own = 0;  // pairs that only the larger of the two would have chosen
    for (std::size_t i = 0; i < x.size(); ++i) {
      std::vector<std::uint32_t> expected;
      for (std::size_t j = 0; j < x.size(); ++j) {
        Vector<Dim> r = x[i] - x[j];
        if (periodic) r -= r.array().round().matrix().eval();
        if (j == i || r.norm() >= h[i] + h[j]) continue;
        expected.push_back(static_cast<std::uint32_t>(j));
        beyond_own += r.norm() > 2.0 * h[i] ? 1 : 0;
      }
      good = good && sorted_row(list, i) == expected;
    }
    BOOST_TEST(good, "periodic " << periodic);
    BOOST_TEST(beyond_own > 0u);
  }
}

BOOST_AUTO_TEST_CASE(pair_is_one_up_to_the_sum_of_its_smoothing_lengths) {
  for (double const distance : {0.399, 0.401}) {
    Particles<1> particles(2, 0.1);
    particles.positions().component(0) = {0.0, distance};
    particles.vary_smoothing_length();
    particles.smoothing_lengths()[1] = 0.3;
    SmoothingLength const h(particles);
    Domain<1> const domain{.lower = Vector<1>(0.0), .upper = Vector<1>(1.0)};
    CellGrid<1> const grid(particles.positions(), domain, 2.0 * h.largest());
    BOOST_TEST(find_neighbours(grid, h).pairs() == (distance < 0.4 ? 2u : 0u));
    BOOST_TEST(find_neighbours(grid).pairs() == 2u);  // the grid's reach alone
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(kernel_of_a_pair_is_symmetric_and_its_gradient_antisymmetric_to_the_last_bit, D,
                              Dimensions) {
  constexpr int Dim = D::value;
  for (bool const periodic : {false, true}) {
    if (periodic && Dim == 3) continue;
    RandomScene<Dim> const scene = varied_scene<Dim>(2, periodic);
    PairGeometry<Dim> const geometry = geometry_of(scene);
    auto const& x = scene.particles.positions();
    auto const& h = scene.particles.smoothing_lengths();
    GatheredPairs<Dim> const pairs = gathered_pairs(scene.particles, geometry);
    NeighbourList const& list = geometry.neighbours;
    double const h_least = *std::ranges::min_element(h);
    double const scale = dense::kernel<Dim>(0.0, h_least) / h_least;
    bool exact = true;
    double worst = 0.0;
    for (std::uint32_t i = 0; i < x.size(); ++i) {
      for (std::size_t k = list.first[i]; k < list.first[i + 1]; ++k) {
        std::uint32_t const j = list.neighbour[k];
        auto const row = list.row(j);
        auto const back = std::ranges::find(row, i);
        BOOST_TEST_REQUIRE((back != row.end()));
        std::size_t const other = list.first[j] + static_cast<std::size_t>(back - row.begin());
        exact = exact && pairs.radial[k] == pairs.radial[other] &&
                (pairs.separation[k] + pairs.separation[other]).norm() == 0.0;
        Vector<Dim> r = x[i] - x[j];
        if (periodic) r -= r.array().round().matrix().eval();
        Vector<Dim> const expected = dense::slope<Dim>(r.norm(), 0.5 * (h[i] + h[j])) * r / r.norm();
        worst = std::max(worst, (pairs.gradient(k) - expected).norm());
      }
    }
    BOOST_TEST(exact);
    BOOST_TEST(worst < 1e-13 * scale);
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(symmetric_forms_conserve_momentum_and_energy_with_own_smoothing_lengths, D,
                              Dimensions) {
  constexpr int Dim = D::value;
  for (bool const periodic : {false, true}) {
    if (periodic && Dim == 3) continue;
    RandomScene<Dim> const scene = varied_scene<Dim>(3, periodic);
    PairGeometry<Dim> const geometry = geometry_of(scene, false);
    for (std::string_view const id : {"momentum/p-rho2", "momentum/sqrt-p"}) {
      std::string_view const partner = find_scheme(id)->work_partner;
      Particles<Dim> const momentum = evaluated(scene, geometry, id);
      Particles<Dim> const work = evaluated(scene, geometry, partner);
      Particles<Dim> const total = evaluated(scene, geometry, "work/total-energy");
      Vector<Dim> force = Vector<Dim>::Zero();
      double gross_force = 0.0, power = 0.0, gross_power = 0.0, total_power = 0.0;
      for (std::size_t i = 0; i < momentum.size(); ++i) {
        double const m = scene.particles.masses()[i];
        Vector<Dim> const a = momentum.vector(Field::acceleration)[i];
        double const kinetic = m * scene.particles.vector(Field::velocity)[i].dot(a);
        double const internal = m * work.scalar(Field::heating)[i];
        force += m * a;
        gross_force += m * a.norm();
        power += kinetic + internal;
        gross_power += std::abs(kinetic) + std::abs(internal);
        total_power += m * total.scalar(Field::heating)[i];
      }
      BOOST_TEST(gross_force > 0.0);
      BOOST_TEST(force.norm() < 1e-13 * gross_force, id);
      BOOST_TEST(std::abs(power) < 1e-13 * gross_power, id);
      BOOST_TEST(std::abs(total_power) < 1e-13 * gross_power);
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(conduction_conserves_energy_with_own_smoothing_lengths, D, Dimensions) {
  constexpr int Dim = D::value;
  RandomScene<Dim> const scene = varied_scene<Dim>(4);
  PairGeometry<Dim> const geometry = geometry_of(scene, false);
  std::size_t conservative = 0;
  for (SchemeInfo const* scheme : all_scheme_infos()) {
    if (scheme->rate != Rate::conduction_heating || !scheme->conserves.contains(Invariant::energy)) continue;
    Particles<Dim> const found = evaluated(scene, geometry, scheme->id);
    double power = 0.0, gross = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      power += found.masses()[i] * found.scalar(Field::heating)[i];
      gross += found.masses()[i] * std::abs(found.scalar(Field::heating)[i]);
    }
    BOOST_TEST(std::abs(power) < 1e-13 * gross, scheme->id);
    ++conservative;
  }
  BOOST_TEST(conservative > 0u);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(foot_point_is_judged_by_the_smoothing_length_of_its_particle, D, Dimensions) {
  constexpr int Dim = D::value;
  for (FaceWeight const rule : {FaceWeight::campbell, FaceWeight::exact, FaceWeight::balanced}) {
    RandomScene<Dim> scene = varied_scene<Dim>(5);
    scene.face_weight = rule;
    PairGeometry<Dim> const geometry = geometry_of(scene);
    auto const& each = scene.particles.smoothing_lengths();
    for (std::size_t w = 0; w < 2; ++w) {
      WallContacts<Dim> const& contacts = geometry.contacts[w];
      std::size_t c = 0;
      for (std::size_t i = 0; i < each.size(); ++i) {
        // A uniform scene with the smoothing length of this particle.
        RandomScene<Dim> uniform = scene;
        uniform.particles = Particles<Dim>(each.size(), each[i]);
        uniform.particles.positions() = scene.particles.positions();
        uniform.particles.masses() = scene.particles.masses();
        dense::State<Dim> const s(uniform);
        if (!s.touches(i, w)) continue;
        BOOST_TEST_REQUIRE(c < contacts.size());
        BOOST_TEST(contacts.particle[c] == i);
        BOOST_TEST(contacts.distance[c] == s.d(i, w), tolerance(1e-13));
        BOOST_TEST(contacts.foot_density[c] == s.rho(i, w), tolerance(1e-9));
        double expected = 0.0;
        if (rule == FaceWeight::balanced && !s.is_near(i, 1 - w)) {
          for (std::size_t j = 0; j < each.size(); ++j) {
            Vector<Dim> const r = s.x(i) - s.x(j);
            if (i == j) continue;
            double const slope = dense::slope<Dim>(r.norm(), 0.5 * (each[i] + each[j]));
            expected -= s.m(j) / scene.particles.scalar(Field::density)[j] * slope * r.dot(s.n(w)) / r.norm();
          }
        } else {
          if (rule == FaceWeight::balanced) uniform.face_weight = FaceWeight::exact;
          expected = s.A(i, w);
        }
        BOOST_TEST(std::abs(contacts.face_weight[c] - expected) < 1e-12 / s.h());
        ++c;
      }
      BOOST_TEST(c > 0u);
      BOOST_TEST(contacts.size() == c);
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(sum_for_the_density_takes_the_particles_own_smoothing_length, D, Dimensions) {
  constexpr int Dim = D::value;
  RandomScene<Dim> const scene = varied_scene<Dim>(6);
  SmoothingLength const h(scene.particles);
  CellGrid<Dim> const grid(scene.particles.positions(), scene.domain, 2.0 * h.largest());
  auto const& x = scene.particles.positions();
  std::vector<double> expected(x.size(), 0.0);
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (std::size_t j = 0; j < x.size(); ++j)
      expected[i] += scene.particles.masses()[j] * dense::kernel<Dim>((x[i] - x[j]).norm(), h(i));
  }
  BOOST_TEST(relative_difference(summation_density(grid, h, scene.particles.masses()), expected) < 1e-13);
}

// The same neighbours, contacts and density to the last bit; rates, where r/h is the one and r (1/h) the
// other, to round-off.
BOOST_AUTO_TEST_CASE_TEMPLATE(equal_lengths_give_what_one_length_for_all_gives, D, Dimensions) {
  constexpr int Dim = D::value;
  for (FaceWeight const rule : {FaceWeight::campbell, FaceWeight::exact, FaceWeight::balanced}) {
    RandomScene<Dim> scene = random_scene<Dim>(7, 60);
    scene.face_weight = rule;
    scene.particles.allocate({Field::density_rate, Field::pass_number, Field::pass_tensor});
    RandomScene<Dim> own = scene;
    own.particles.vary_smoothing_length();
    PairGeometry<Dim> const uniform = geometry_of(scene);
    PairGeometry<Dim> const equal = geometry_of(own);
    BOOST_TEST((equal.neighbours.first == uniform.neighbours.first));
    BOOST_TEST((equal.neighbours.neighbour == uniform.neighbours.neighbour));
    for (std::size_t w = 0; w < 2; ++w) {
      BOOST_TEST((equal.contacts[w].particle == uniform.contacts[w].particle));
      BOOST_TEST(same_bits(equal.contacts[w].face_weight, uniform.contacts[w].face_weight));
      BOOST_TEST(same_bits(equal.contacts[w].foot_density, uniform.contacts[w].foot_density));
      BOOST_TEST(same_bits(equal.contacts[w].interpolation_kernel, uniform.contacts[w].interpolation_kernel));
    }
    for (SchemeInfo const* scheme : all_scheme_infos()) {
      if (scheme->needs_partners) continue;  // some have too few here
      if (reads_face_offsets(*scheme)) continue;  // knows no smoothing length
      Particles<Dim> const one = evaluated(scene, uniform, scheme->id);
      Particles<Dim> const other = evaluated(own, equal, scheme->id);
      if (scheme->rate == Rate::acceleration) {
        for (int k = 0; k < Dim; ++k) {
          BOOST_TEST(relative_difference(other.vector(Field::acceleration).component(k),
                                         one.vector(Field::acceleration).component(k)) < 1e-13,
                     scheme->id);
        }
      } else {
        BOOST_TEST(relative_difference(other.scalar(Field::heating), one.scalar(Field::heating)) < 1e-13,
                   scheme->id);
      }
    }
    CellGrid<Dim> const grid(scene.particles.positions(), scene.domain,
                             2.0 * scene.particles.smoothing_length());
    auto const& m = scene.particles.masses();
    BOOST_TEST(same_bits(summation_density(grid, SmoothingLength(own.particles), m),
                         summation_density(grid, SmoothingLength(scene.particles), m)));
  }
}

BOOST_AUTO_TEST_CASE(particles_have_the_cubic_spline_until_they_are_given_another_kernel) {
  Particles<2> particles(3, 0.3);
  BOOST_TEST(&particles.kernel() == &kernel("cubic-spline", 2));
  BOOST_TEST(&SmoothingLength(particles).kernel() == &particles.kernel());
  BOOST_TEST(SmoothingLength(particles).support(1) == 0.6, tolerance(1e-15));
  particles.set_kernel(kernel("quintic-spline", 2));
  particles.vary_smoothing_length();
  particles.smoothing_lengths() = {0.3, 0.7, 0.1};
  SmoothingLength const own(particles);
  BOOST_TEST(own.kernel().id() == "quintic-spline");
  BOOST_TEST(own.support(1) == 2.1, tolerance(1e-15));
  BOOST_TEST(own.support(0, 1) == 1.5, tolerance(1e-15));
  BOOST_TEST(SmoothingLength(0.2, kernel("quintic-spline", 1)).support(5) == 0.6, tolerance(1e-15));
  Particles<2> const copy = particles;
  BOOST_TEST(&copy.kernel() == &particles.kernel());
}

BOOST_AUTO_TEST_SUITE_END()
