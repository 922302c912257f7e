// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/scene/moving_geometry.hpp"

#include <boost/test/unit_test.hpp>
#include <limits>
#include <utility>

#include "formulations/kernels/cubic_spline.hpp"
#include "harness/scene/list_skin.hpp"
#include "tests/support/dense.hpp"

BOOST_AUTO_TEST_SUITE(harness_scene_moving_geometry)

using namespace sphverify;
using namespace sphverify::tests;

/// A gas on a jittered lattice in a box of unit sides, periodic or between two walls across x, and what
/// follows it.
template <int Dim>
struct Gas {
  static constexpr int side = Dim == 1 ? 60 : (Dim == 2 ? 24 : 12);
  static constexpr double spacing = 1.0 / side;
  static constexpr double movement = 0.03;  ///< of one evaluation, in half supports: worth a skin

  tests::RandomScene<Dim> scene;
  typename MovingGeometry<Dim>::Choice choice;
  MovingGeometry<Dim> geometry;

  Gas(bool walls, DensityRule density, bool adaptive = false, double smoothing_ratio = 1.2, int threads = 1,
      PairSupport support = PairSupport::mean)
      : scene(lattice_scene<Dim>(side, spacing, smoothing_ratio)),
        choice{.density = density,
               .face_weight = FaceWeight::exact,
               .adaptive = adaptive,
               .smoothing_ratio = smoothing_ratio,
               .threads = threads,
               .support = support},
        geometry(box(scene.domain, walls), choice) {
    scene.domain = box(scene.domain, walls);
    Random random(1);
    auto& x = scene.particles.positions();
    VectorField<Dim> const at = x;
    randomise_fields(scene.particles, random);
    for (std::size_t i = 0; i < x.size(); ++i) {
      x.set(i, at[i] + random.vector<Dim>(-0.1, 0.1) * spacing);
      scene.particles.masses()[i] = random.uniform(0.9, 1.1) * std::pow(spacing, Dim);
      scene.particles.scalar(Field::density)[i] = random.uniform(0.9, 1.1);
    }
    if (adaptive) scene.particles.vary_smoothing_length();
    if (!walls) return;
    Vector<Dim> const n = Vector<Dim>::Unit(0);
    scene.walls.push_back({.point = -0.5 * n, .outward_normal = -n});
    scene.walls.push_back({.point = 0.5 * n, .outward_normal = n});
    for (Wall<Dim>& wall : scene.walls) wall.pressure = [](Vector<Dim> const&, double) { return 1.3; };
  }

  static Domain<Dim> box(Domain<Dim> domain, bool walls) {
    domain.periodic.fill(true);
    domain.periodic[0] = !walls;
    return domain;
  }

  /// Half a support, with the cubic spline the smoothing length.
  double h() const {
    return 0.5 * scene.particles.kernel().support_ratio() * scene.particles.smoothing_length();
  }
  void follow() { geometry.follow(scene.particles, scene.walls, scene.walls); }
  std::uint64_t searches() const { return geometry.passes().at("neighbour-search"); }

  /// Follows the gas once before and once after all have moved, and gives the skin of the list that it then
  /// has.
  double follow_until_skin() {
    follow();
    move(movement * h(), 77);
    follow();
    BOOST_TEST_REQUIRE(searches() == 2u);
    return cheapest_skin(movement, Dim);
  }
  /// The same by the growth of the smoothing length of one particle, where each has its own.
  double follow_until_own_skin() {
    follow();
    scene.particles.scalar(Field::density)[9] /= std::pow(1.0 + movement, Dim);
    follow();
    BOOST_TEST_REQUIRE(searches() == 2u);
    return cheapest_skin(movement, Dim);
  }

  /// Moves all by a distance in random directions, back into the box where they leave it.
  void move(double distance, std::uint64_t seed) {
    Random random(seed);
    auto& x = scene.particles.positions();
    for (std::size_t i = 0; i < x.size(); ++i) {
      Vector<Dim> moved = x[i] + distance * random.direction<Dim>();
      for (int k = 0; k < Dim; ++k) {
        if (scene.domain.periodic[static_cast<std::size_t>(k)]) moved[k] -= std::floor(moved[k] + 0.5);
      }
      x.set(i, moved);
    }
  }

  std::vector<double> rates(std::string_view id, Particles<Dim> particles, PairGeometry<Dim> pairs) const {
    auto const scheme = make_rate_operator<Dim>(id);
    WorkCount work;
    scheme->evaluate(particles, pairs, scene.closure, 0.0, 1, work);
    if (scheme->info().rate != Rate::acceleration) return particles.scalar(Field::heating);
    std::vector<double> all;
    for (int k = 0; k < Dim; ++k) {
      auto const& a = particles.vector(Field::acceleration).component(k);
      all.insert(all.end(), a.begin(), a.end());
    }
    return all;
  }

  /// Largest deviation of densities, smoothing lengths, wall contacts and rates from those of a list that is
  /// new.
  double deviation_from_a_new_list() const {
    Particles<Dim> particles = scene.particles;
    MovingGeometry<Dim> fresh(scene.domain, choice);
    fresh.follow(particles, scene.walls, scene.walls);
    double worst =
        relative_difference(scene.particles.scalar(Field::density), particles.scalar(Field::density));
    if (choice.adaptive) {
      worst = std::max(
          worst, relative_difference(scene.particles.smoothing_lengths(), particles.smoothing_lengths()));
    }
    PairGeometry<Dim> const& kept = geometry.geometry();
    PairGeometry<Dim> const& renewed = fresh.geometry();
    for (std::size_t w = 0; w < scene.walls.size(); ++w) {
      worst = std::max(worst,
                       relative_difference(kept.contacts[w].foot_density, renewed.contacts[w].foot_density));
      worst =
          std::max(worst, relative_difference(kept.contacts[w].face_weight, renewed.contacts[w].face_weight));
    }
    std::vector<std::string_view> ids{"momentum/p-rho2", "work/internal-energy", "conduction/brookshaw"};
    if (choice.support == PairSupport::larger) {
      ids.insert(ids.end(), {"momentum/p-rho2-grad-h", "work/p-rho2-grad-h"});
      worst = std::max(worst, relative_difference(scene.particles.scalar(Field::omega), particles.scalar(Field::omega)));
    }
    for (std::string_view const id : ids) {
      worst = std::max(worst,
                       relative_difference(rates(id, scene.particles, kept), rates(id, particles, renewed)));
    }
    return worst;
  }
};

constexpr double round_off = 1e-12;

BOOST_AUTO_TEST_CASE_TEMPLATE(list_is_kept_while_nobody_has_moved_further_than_the_skin, D, Dimensions) {
  constexpr int Dim = D::value;
  for (bool const walls : {false, true}) {
    for (DensityRule const density :
         {DensityRule::summation, DensityRule::normalised, DensityRule::continuity}) {
      Gas<Dim> gas(walls, density);
      double const skin = gas.follow_until_skin();
      for (std::uint64_t n = 1; n <= 3; ++n) {
        gas.move(0.33 * skin * gas.h(), n);
        gas.follow();
        BOOST_TEST(gas.searches() == 2u);
        BOOST_TEST(gas.deviation_from_a_new_list() < round_off);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(list_is_renewed_when_one_has_moved_further, D, Dimensions) {
  constexpr int Dim = D::value;
  for (double const part_of_skin : {0.999, 1.001}) {
    for (char const* id : {"cubic-spline", "quintic-spline"}) {
      Gas<Dim> gas(false, DensityRule::continuity, false, 1.0);
      gas.scene.particles.set_kernel(kernel(id, Dim));
      double const skin = gas.follow_until_skin();
      Vector<Dim> const step = part_of_skin * skin * gas.h() * Random(2).direction<Dim>();
      gas.scene.particles.positions().add(7, step);
      gas.follow();
      BOOST_TEST(gas.searches() == (part_of_skin < 1.0 ? 2u : 3u));
      BOOST_TEST(gas.deviation_from_a_new_list() < round_off);
    }
  }
}

// What is kept must be enough for whatever happens within the skin: all gather at one point.
BOOST_AUTO_TEST_CASE_TEMPLATE(pairs_that_come_within_the_support_are_in_the_list_already, D, Dimensions) {
  constexpr int Dim = D::value;
  Gas<Dim> gas(false, DensityRule::summation);
  double const skin = gas.follow_until_skin();
  std::size_t const before = gas.geometry.geometry().neighbours.pairs();
  auto& x = gas.scene.particles.positions();
  for (std::size_t i = 0; i < x.size(); ++i) x.add(i, -0.99 * skin * gas.h() * x[i].normalized());
  gas.follow();
  BOOST_TEST(gas.searches() == 2u);
  BOOST_TEST(gas.geometry.geometry().neighbours.pairs() == before);
  BOOST_TEST(gas.deviation_from_a_new_list() < round_off);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_step_across_a_periodic_boundary_is_a_short_one, D, Dimensions) {
  constexpr int Dim = D::value;
  Gas<Dim> gas(false, DensityRule::summation);
  auto& x = gas.scene.particles.positions();
  Vector<Dim> at = x[0];
  // The first step tells how fast it is, the second is within the skin for which that speed calls.
  for (double const place : {-0.4999, 0.4999, -0.4999}) {
    at[0] = place;
    x.set(0, at);
    gas.follow();
  }
  BOOST_TEST(gas.searches() == 2u);
  BOOST_TEST(gas.deviation_from_a_new_list() < round_off);
}

BOOST_AUTO_TEST_CASE(first_list_and_those_of_fast_particles_have_no_skin) {
  Gas<2> gas(false, DensityRule::summation);
  auto const pairs_of_no_skin = [&gas] {
    Particles<2> particles = gas.scene.particles;
    MovingGeometry<2> fresh(gas.scene.domain, gas.choice);
    fresh.follow(particles, {}, {});
    return fresh.geometry().neighbours.pairs();
  };
  auto const pairs = [&gas] { return gas.geometry.geometry().neighbours.pairs(); };
  gas.follow();
  // Closer than two smoothing lengths, by brute force.
  std::size_t near = 0;
  auto const& x = gas.scene.particles.positions();
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (std::size_t j = 0; j < x.size(); ++j) {
      near += i != j && gas.scene.domain.nearest_image(x[i] - x[j]).norm() < 2.0 * gas.h() ? 1 : 0;
    }
  }
  BOOST_TEST(pairs() == near);
  std::uint64_t searches = 1;
  for (std::uint64_t n = 1; n <= 3; ++n) {
    gas.move(0.2 * gas.h(), n);
    gas.follow();
    BOOST_TEST(gas.searches() == ++searches);
    BOOST_TEST(pairs() == pairs_of_no_skin());
  }
  gas.follow();  // nothing has moved
  BOOST_TEST(gas.searches() == searches);
  // They slow down.
  gas.move(0.001 * gas.h(), 4);
  gas.follow();
  BOOST_TEST(gas.searches() == ++searches);
  BOOST_TEST(pairs() > pairs_of_no_skin());
  gas.move(0.99 * cheapest_skin(0.001, 2) * gas.h(), 5);
  gas.follow();
  BOOST_TEST(gas.searches() == searches);
  BOOST_TEST(gas.deviation_from_a_new_list() < round_off);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(box_of_two_supports_leaves_no_room_for_a_skin, D, Dimensions) {
  constexpr int Dim = D::value;
  // Supports of 0.25 (room for all of the skin), just below 0.5 (for a part of it), 0.5 (for none).
  for (double const support : {0.25, 0.48, 0.5}) {
    if (Dim == 3 && support < 0.5) continue;
    Gas<Dim> gas(false, DensityRule::summation, false, 0.5 * support * Gas<Dim>::side);
    double const skin = std::min(gas.follow_until_skin(), 0.5 / support - 1.0);
    for (std::uint64_t n = 1; n <= 2; ++n) {
      gas.move(0.45 * skin * gas.h(), n);
      gas.follow();
      BOOST_TEST(gas.searches() == 2u);
      BOOST_TEST(gas.deviation_from_a_new_list() < round_off);
    }
    if (skin < 0.01) continue;
    gas.scene.particles.positions().add(3, 2.5 * skin * gas.h() * Vector<Dim>::Unit(0));
    gas.follow();
    BOOST_TEST(gas.searches() == 3u);
    BOOST_TEST(gas.deviation_from_a_new_list() < round_off);
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(own_smoothing_lengths_renew_the_list_when_they_outgrow_it, D, Dimensions) {
  constexpr int Dim = D::value;
  // h_i = 1.2 (m_i/rho_i)^(1/Dim); the skin is the same part of each. One that shrinks needs none.
  for (double const part_of_skin : {-1.0, 0.5, 0.9, 1.2, 5.0}) {
    Gas<Dim> gas(false, DensityRule::continuity, true);
    double const skin = gas.follow_until_own_skin();
    double const growth = 1.0 + part_of_skin * skin;
    double const before = gas.scene.particles.smoothing_lengths()[5];
    gas.scene.particles.scalar(Field::density)[5] /= std::pow(growth, Dim);
    gas.follow();
    BOOST_TEST(gas.scene.particles.smoothing_lengths()[5] == growth * before,
               boost::test_tools::tolerance(1e-13));
    BOOST_TEST(gas.searches() == (part_of_skin < 1.0 ? 2u : 3u));
    BOOST_TEST(gas.deviation_from_a_new_list() < round_off);
  }
  // Growth and movement share the skin.
  Gas<Dim> gas(false, DensityRule::continuity, true);
  double const skin = gas.follow_until_own_skin();
  double const h = gas.scene.particles.smoothing_lengths()[5];
  gas.scene.particles.scalar(Field::density)[5] /= std::pow(1.0 + 0.6 * skin, Dim);
  gas.scene.particles.positions().add(5, 0.6 * skin * h * Vector<Dim>::Unit(0));
  gas.follow();
  BOOST_TEST(gas.searches() == 3u);
}

// One particle's support grows, all others' shrink while they come nearer: neither alone is more than the skin, what both
// do to their distance is.
BOOST_AUTO_TEST_CASE_TEMPLATE(pairs_within_the_larger_support_are_in_the_list_whoever_moved, D, Dimensions) {
  constexpr int Dim = D::value;
  std::size_t seen_by_one = 0;  // pairs that their mean support would have left out
  for (double const part_of_skin : {0.2, 0.5, 0.9}) {
    Gas<Dim> gas(false, DensityRule::continuity, true, 1.2, 1, PairSupport::larger);
    double const change = part_of_skin * gas.follow_until_own_skin();
    auto& p = gas.scene.particles;
    auto& x = p.positions();
    std::vector<double> const h = p.smoothing_lengths();
    std::size_t const middle = x.size() / 2;
    for (std::size_t i = 0; i < x.size(); ++i) {
      p.scalar(Field::density)[i] /= std::pow(i == middle ? 1.0 + change : 1.0 - change, Dim);
      if (i == middle) continue;
      Vector<Dim> const to_middle = x[middle] - x[i];
      x.add(i, std::min(2.0 * change * h[i], 0.9 * to_middle.norm()) * to_middle.normalized());
    }
    gas.follow();
    NeighbourList const& list = gas.geometry.geometry().neighbours;
    std::size_t missing = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      std::vector<std::uint32_t> const row = sorted_row(list, i);
      for (std::uint32_t j = 0; j < x.size(); ++j) {
        double const r = gas.scene.domain.nearest_image(x[i] - x[j]).norm();
        double const larger = 2.0 * std::max(p.smoothing_lengths()[i], p.smoothing_lengths()[j]);
        if (j == i || r >= larger) continue;
        missing += std::binary_search(row.begin(), row.end(), j) ? 0 : 1;
        seen_by_one += r >= p.smoothing_lengths()[i] + p.smoothing_lengths()[j] ? 1 : 0;
      }
    }
    BOOST_TEST(missing == 0u);
  }
  BOOST_TEST(seen_by_one > 0u);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(omega_is_one_where_h_stays_and_no_number_where_the_density_is_no_sum, D, Dimensions) {
  constexpr int Dim = D::value;
  Gas<Dim> fixed(false, DensityRule::summation);
  fixed.follow();
  for (double const omega : fixed.scene.particles.scalar(Field::omega)) BOOST_TEST(omega == 1.0);
  Gas<Dim> integrated(false, DensityRule::continuity, true);
  integrated.follow();
  for (double const omega : integrated.scene.particles.scalar(Field::omega)) BOOST_TEST(std::isnan(omega));
}

// A leapfrog step begins where the one before it ended.
BOOST_AUTO_TEST_CASE_TEMPLATE(to_look_twice_at_one_place_is_no_movement, D, Dimensions) {
  constexpr int Dim = D::value;
  for (bool const adaptive : {false, true}) {
    auto const pairs_after = [&](int looks) {
      Gas<Dim> gas(false, DensityRule::summation, adaptive);
      for (int k = 0; k < looks; ++k) gas.follow();
      BOOST_TEST(gas.searches() == 1u);
      for (std::uint64_t n = 1; n <= 2; ++n) {
        gas.move(0.01 * gas.h(), n);
        for (int k = 0; k < looks; ++k) gas.follow();
      }
      return gas.geometry.geometry().neighbours.pairs();
    };
    BOOST_TEST(pairs_after(3) == pairs_after(1));
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(own_smoothing_lengths_that_follow_a_sum_solve_their_equation, D, Dimensions) {
  constexpr int Dim = D::value;
  for (auto const& [walls, support] : {std::pair{false, PairSupport::mean}, std::pair{true, PairSupport::mean},
                                       std::pair{false, PairSupport::larger}, std::pair{true, PairSupport::larger}}) {
    Gas<Dim> gas(walls, DensityRule::normalised, true, 1.2, 1, support);
    gas.follow();
    for (std::uint64_t n = 1; n <= 4; ++n) {
      gas.move(0.002 * gas.h(), n);
      gas.follow();
      BOOST_TEST(gas.searches() == 2u);
      BOOST_TEST(gas.deviation_from_a_new_list() < 1e-11);  // of a solution from another guess
      auto const& p = gas.scene.particles;
      double worst = 0.0;
      for (std::size_t i = 0; i < p.size(); ++i) {
        double const h = 1.2 * std::pow(p.masses()[i] / p.scalar(Field::density)[i], 1.0 / Dim);
        worst = std::max(worst, std::abs(h / p.smoothing_lengths()[i] - 1.0));
      }
      BOOST_TEST(worst < 1e-12);
    }
  }
}

/// Density by a double loop, with a particle's own smoothing length.
template <int Dim>
std::vector<double> gathered_density(tests::RandomScene<Dim> const& scene) {
  auto const& x = scene.particles.positions();
  SmoothingLength const h(scene.particles);
  std::vector<double> density(x.size(), 0.0);
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (std::size_t j = 0; j < x.size(); ++j) {
      Vector<Dim> const r = scene.domain.nearest_image(x[i] - x[j]);
      density[i] += scene.particles.masses()[j] * dense::kernel<Dim>(r.norm(), h(i));
    }
  }
  return density;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(sums_for_the_density_are_dense_sums_on_an_old_list, D, Dimensions) {
  constexpr int Dim = D::value;
  for (bool const adaptive : {false, true}) {
    Gas<Dim> gas(false, DensityRule::summation, adaptive);
    gas.follow();
    for (std::uint64_t n = 1; n <= 2; ++n) {
      gas.move(0.005 * gas.h(), n);
      gas.follow();
    }
    BOOST_TEST(gas.searches() == 2u);
    BOOST_TEST(relative_difference(gas.scene.particles.scalar(Field::density), gathered_density(gas.scene)) <
               round_off);
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(contacts_are_found_anew_each_time_and_none_without_walls, D, Dimensions) {
  constexpr int Dim = D::value;
  Gas<Dim> gas(true, DensityRule::continuity);
  gas.follow_until_skin();
  double const before = gas.geometry.geometry().contacts[0].distance[0];
  std::uint32_t const i = gas.geometry.geometry().contacts[0].particle[0];
  gas.scene.particles.positions().add(i, 0.01 * gas.h() * Vector<Dim>::Unit(0));
  gas.scene.walls[0].point[0] -= 0.02 * gas.h();
  gas.follow();
  BOOST_TEST(gas.searches() == 2u);
  BOOST_TEST(gas.geometry.passes().at("wall-contacts") == 3u);
  BOOST_TEST(gas.geometry.geometry().contacts[0].distance[0] == before + 0.03 * gas.h(),
             boost::test_tools::tolerance(1e-10));

  MovingGeometry<Dim> open(gas.scene.domain, gas.choice);
  open.follow(gas.scene.particles, {}, gas.scene.walls);
  BOOST_TEST(open.geometry().contacts.empty());
  BOOST_TEST(!open.passes().contains("wall-contacts"));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(densities_that_are_integrated_are_left_alone, D, Dimensions) {
  constexpr int Dim = D::value;
  for (bool const adaptive : {false, true}) {
    Gas<Dim> gas(false, DensityRule::continuity, adaptive);
    std::vector<double> const density = gas.scene.particles.scalar(Field::density);
    gas.follow();
    BOOST_TEST(same_bits(gas.scene.particles.scalar(Field::density), density));
    BOOST_TEST(!gas.geometry.passes().contains("density-summation"));
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(places_that_are_no_numbers_are_refused_even_with_a_list_at_hand, D,
                              Dimensions) {
  constexpr int Dim = D::value;
  Gas<Dim> gas(false, DensityRule::summation);
  gas.follow();
  gas.scene.particles.positions().component(0)[3] = std::numeric_limits<double>::quiet_NaN();
  BOOST_CHECK_THROW(gas.follow(), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(after_places_that_are_refused_those_before_are_followed_again, D, Dimensions) {
  constexpr int Dim = D::value;
  for (bool const same_place : {false, true}) {
    Gas<Dim> gas(false, DensityRule::summation);
    gas.follow();
    auto& x = gas.scene.particles.positions();
    Vector<Dim> const before = x[3];
    x.set(3,
          same_place ? x[5] : Vector<Dim>(Vector<Dim>::Constant(std::numeric_limits<double>::quiet_NaN())));
    BOOST_CHECK_THROW(gas.follow(), std::invalid_argument);
    x.set(3, before);
    gas.follow();
    BOOST_TEST(gas.deviation_from_a_new_list() < round_off);
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(threads_do_not_change_a_bit, D, Dimensions) {
  constexpr int Dim = D::value;
  auto const followed = [](bool walls, bool adaptive, int threads) {
    Gas<Dim> gas(walls, DensityRule::normalised, adaptive, 1.2, threads);
    // On a list with a skin that was found elsewhere.
    gas.follow();
    for (std::uint64_t n = 1; n <= 2; ++n) {
      gas.move(0.002 * gas.h(), n);
      gas.follow();
    }
    BOOST_TEST(gas.searches() == 2u);
    return std::pair(gas.geometry.geometry(), gas.scene.particles.scalar(Field::density));
  };
  for (auto const& [walls, adaptive] :
       {std::pair(false, false), std::pair(true, false), std::pair(false, true), std::pair(true, true)}) {
    auto const [one, density] = followed(walls, adaptive, 1);
    for (int const threads : {2, 4}) {
      auto const [other, other_density] = followed(walls, adaptive, threads);
      BOOST_TEST((other.neighbours.first == one.neighbours.first));
      BOOST_TEST((other.neighbours.neighbour == one.neighbours.neighbour));
      BOOST_TEST(same_bits(other_density, density));
      BOOST_TEST_REQUIRE(other.contacts.size() == one.contacts.size());
      for (std::size_t w = 0; w < one.contacts.size(); ++w) {
        BOOST_TEST((other.contacts[w].particle == one.contacts[w].particle));
        BOOST_TEST(same_bits(other.contacts[w].face_weight, one.contacts[w].face_weight));
        BOOST_TEST(same_bits(other.contacts[w].foot_density, one.contacts[w].foot_density));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(first_wall_s_complaint_is_heard_at_any_number_of_threads, D, Dimensions) {
  constexpr int Dim = D::value;
  for (int const threads : {1, 2, 4}) {
    Gas<Dim> gas(true, DensityRule::continuity, false, 1.2, threads);
    auto& x = gas.scene.particles.positions();
    x.set(7, x[7] + (0.6 - x[7][0]) * Vector<Dim>::Unit(0));    // beyond the second wall
    x.set(9, x[9] + (-0.55 - x[9][0]) * Vector<Dim>::Unit(0));  // beyond the first
    for (int n = 0; n < 20; ++n) {
      BOOST_CHECK_EXCEPTION(gas.follow(), std::invalid_argument, [](std::invalid_argument const& complaint) {
        return std::string(complaint.what()).starts_with("particle 9 ");
      });
    }
  }
}

// Its density is that of its neighbours' outermost tail, which falls so steeply with h that to iterate to
// and fro between the two, damped or not, would drive it away from the solution.
BOOST_AUTO_TEST_CASE(a_light_particle_beside_heavy_ones_finds_its_smoothing_length) {
  Particles<1> particles(6, 0.06);
  particles.allocate(Field::density);
  for (std::size_t i = 0; i < 6; ++i) {
    particles.positions().set(i, Vector<1>(i == 0 ? 0.0 : 0.05 * static_cast<double>(i + 1)));
    particles.masses()[i] = i == 0 ? 0.01 : 1.0;
  }
  particles.vary_smoothing_length();
  Domain<1> const domain{Vector<1>(-1.0), Vector<1>(1.0), {false}};
  for (DensityRule const density : {DensityRule::summation, DensityRule::normalised}) {
    Particles<1> own = particles;
    MovingGeometry<1> geometry(domain, {density, FaceWeight::exact, true, 1.2, 1});
    BOOST_REQUIRE_NO_THROW(geometry.follow(own, {}, {}));
    for (std::size_t i = 0; i < 6; ++i) {
      BOOST_TEST(own.smoothing_lengths()[i] * own.scalar(Field::density)[i] == 1.2 * own.masses()[i],
                 boost::test_tools::tolerance(1e-12));
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
