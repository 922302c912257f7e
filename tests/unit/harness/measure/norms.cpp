// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/measure/norms.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

#include "cases/support/boxes.hpp"
#include "formulations/layouts/layout.hpp"
#include "reports/extremes.hpp"
#include "tests/support/random_particles.hpp"

BOOST_AUTO_TEST_SUITE(harness_measure_norms)

using namespace sphverify;
using namespace sphverify::tests;
using boost::test_tools::tolerance;
using List = std::vector<double>;

List random_list(std::size_t count, double low, double high, std::uint64_t seed) {
  Random random(seed);
  List list(count);
  for (double& value : list) value = random.uniform(low, high);
  return list;
}

std::vector<Region> everything(std::size_t count) {
  Region all{"all", {}};
  for (std::size_t i = 0; i < count; ++i) all.particles.push_back(i);
  return {all};
}

NormSet error_of(List const& computed, List const& exact, List const& weights) {
  return field_errors({computed}, {exact}, weights, everything(computed.size()), 0.0).at("all").error;
}

Region const* find(std::vector<Region> const& regions, std::string const& name) {
  for (Region const& region : regions) {
    if (region.name == name) return &region;
  }
  return nullptr;
}

template <int Dim>
Particles<Dim> on_lattice(Domain<Dim> const& domain, int resolution, double smoothing_ratio) {
  Layout<Dim> const layout = lattice(domain, resolution);
  Particles<Dim> particles(layout.volumes.size(), smoothing_ratio * layout.spacing);
  particles.positions() = layout.positions;
  return particles;
}

BOOST_AUTO_TEST_CASE(an_exact_field_scores_zero_and_its_own_norm_as_scale) {
  List const field = random_list(50, 1.0, 2.0, 1);
  List const weights = random_list(50, 0.1, 3.0, 2);
  RegionError const e = field_errors({field}, {field}, weights, everything(50), 1e-14).at("all");
  BOOST_TEST(e.error.l1 == 0.0);
  BOOST_TEST(e.error.l2 == 0.0);
  BOOST_TEST(e.error.linf == 0.0);
  BOOST_TEST(e.round_off == 1e-14);
  NormSet const own = norms(field, weights);
  BOOST_TEST(e.scale.l1 == own.l1);
  BOOST_TEST(e.scale.l2 == own.l2);
  BOOST_TEST(e.scale.linf == own.linf);
  BOOST_TEST(own.linf > 1.9);
}

BOOST_AUTO_TEST_CASE(a_shifted_field_scores_the_shift_in_every_norm_whatever_the_weights) {
  List const exact = random_list(60, -1.0, 1.0, 3);
  for (double const shift : {0.25, -0.25}) {
    List computed = exact;
    for (double& value : computed) value += shift;
    for (double const size : {1.0, 1e-9, 1e9}) {
      NormSet const e = error_of(computed, exact, random_list(60, size, 7.0 * size, 4));
      BOOST_TEST(e.l1 == 0.25, tolerance(1e-13));
      BOOST_TEST(e.l2 == 0.25, tolerance(1e-13));
      BOOST_TEST(e.linf == 0.25, tolerance(1e-13));
    }
  }
}

BOOST_AUTO_TEST_CASE(one_value_or_weight_that_is_no_number_leaves_no_norm) {
  List const fine = random_list(9, -1.0, 1.0, 11);
  List const weights = random_list(9, 0.5, 1.0, 12);
  auto const is_nothing = [](NormSet const& n) {
    return std::isnan(n.l1) && std::isnan(n.l2) && std::isnan(n.linf);
  };
  for (double const bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                           -std::numeric_limits<double>::infinity()}) {
    for (std::size_t const at : {0u, 4u, 8u}) {
      List broken = fine;
      broken[at] = bad;
      BOOST_TEST(is_nothing(norms(broken, weights)));
      BOOST_TEST(is_nothing(error_of(broken, fine, weights)));
      BOOST_TEST(is_nothing(error_of(fine, broken, weights)));
      List broken_weights = weights;
      broken_weights[at] = bad;
      BOOST_TEST(is_nothing(norms(fine, broken_weights)));
    }
    BOOST_TEST(is_nothing(norms(List(9, bad), weights)));
  }
  // A region that does not hold it has its norms.
  List broken = fine;
  broken[8] = std::numeric_limits<double>::quiet_NaN();
  std::vector<Region> const regions{{"all", {0, 4, 8}}, {"part", {0, 4}}};
  FieldErrors const errors = field_errors({broken}, {fine}, weights, regions, 0.0);
  BOOST_TEST(is_nothing(errors.at("all").error));
  BOOST_TEST(errors.at("part").error.linf == 0.0);
}

BOOST_AUTO_TEST_CASE(the_larger_of_what_is_not_known_is_not_known) {
  double const nothing = std::numeric_limits<double>::quiet_NaN();
  BOOST_TEST(larger(1.0, 2.0) == 2.0);
  BOOST_TEST(smaller(1.0, 2.0) == 1.0);
  for (double const a :
       {larger(1.0, nothing), larger(nothing, 1.0), smaller(1.0, nothing), smaller(nothing, 1.0)})
    BOOST_TEST(std::isnan(a));
  BOOST_TEST((larger_if_known(Number(1.0), Number(3.0)) == Number(3.0)));
  BOOST_TEST(!larger_if_known(Number(1.0), Number()).has_value());
}

BOOST_AUTO_TEST_CASE(norms_are_those_of_the_definition) {
  List const weights{1.0, 2.0, 5.0};
  NormSet const n = norms(List{3.0, -4.0, 1.0}, weights);
  BOOST_TEST(n.l1 == (3.0 + 8.0 + 5.0) / 8.0, tolerance(1e-14));
  BOOST_TEST(n.l2 == std::sqrt((9.0 + 32.0 + 5.0) / 8.0), tolerance(1e-14));
  BOOST_TEST(n.linf == 4.0);
}

BOOST_AUTO_TEST_CASE(swapped_fields_and_permuted_particles_are_noticed) {
  List const a = random_list(40, 0.0, 1.0, 5);
  List const b = random_list(40, 0.0, 1.0, 6);
  List const weights(40, 1.0);
  FieldErrors const swapped = field_errors({b, a}, {a, b}, weights, everything(40), 0.0);
  BOOST_TEST(swapped.at("all").error.l2 > 0.1);
  List permuted = a;
  std::swap(permuted[3], permuted[17]);
  NormSet const e = error_of(permuted, a, weights);
  BOOST_TEST(e.linf == std::abs(a[3] - a[17]));
  BOOST_TEST(e.l1 == e.linf / 20.0, tolerance(1e-13));
}

BOOST_AUTO_TEST_CASE(l1_is_never_above_l2_nor_l2_above_linf) {
  Random random(7);
  for (std::uint64_t round = 0; round < 2000; ++round) {
    std::size_t const count = 1 + round % 30;
    double const low = round % 3 == 0 ? 0.9999999 : -1.0;
    List const values = random_list(count, low, 1.0, 2 * round);
    List weights = random_list(count, 0.0, random.uniform(1e-12, 1e12), 2 * round + 1);
    weights[0] += 1e-13;
    NormSet const n = norms(values, weights);
    BOOST_REQUIRE(n.l1 <= n.l2);
    BOOST_REQUIRE(n.l2 <= n.linf);
    BOOST_REQUIRE(n.l1 > 0.0);
  }
}

BOOST_AUTO_TEST_CASE(huge_and_tiny_values_neither_overflow_nor_vanish) {
  List const shape{1.0, -2.0, 3.0, 0.5};
  List const weights{1.0, 1.0, 2.0, 4.0};
  NormSet const one = norms(shape, weights);
  for (double const size : {1e200, 1e-200, 1e300, 1e-300}) {
    List values = shape;
    for (double& value : values) value *= size;
    NormSet const n = norms(values, weights);
    BOOST_TEST(n.l1 / size == one.l1, tolerance(1e-13));
    BOOST_TEST(n.l2 / size == one.l2, tolerance(1e-13));
    BOOST_TEST(n.linf / size == one.linf, tolerance(1e-13));
  }
  List const huge{1e200, 1e200};
  List const zero{0.0, 0.0};
  List const ones{1.0, 1.0};
  NormSet const vector = field_errors({huge, huge}, {zero, zero}, ones, everything(2), 0.0).at("all").error;
  BOOST_TEST(vector.l2 / 1e200 == std::sqrt(2.0), tolerance(1e-13));
}

BOOST_AUTO_TEST_CASE(a_vector_s_error_is_the_length_of_the_difference) {
  List const zero(3, 0.0);
  List const x{3.0, 0.0, 1.0};
  List const y{4.0, 0.0, 2.0};
  List const z{0.0, 2.0, 2.0};
  List const weights(3, 1.0);
  RegionError const e = field_errors({x, y, zero}, {zero, zero, z}, weights, everything(3), 0.0).at("all");
  BOOST_TEST(e.error.linf == 5.0, tolerance(1e-14));
  BOOST_TEST(e.error.l1 == (5.0 + 2.0 + 3.0) / 3.0, tolerance(1e-14));
  BOOST_TEST(e.scale.l1 == 4.0 / 3.0, tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(an_error_is_taken_over_the_particles_of_its_region_alone) {
  List const computed{1.0, 0.0, 0.0, 5.0};
  List const exact{0.0, 0.0, 0.0, 1.0};
  List const weights{1.0, 1.0, 1.0, 3.0};
  FieldErrors const e =
      field_errors({computed}, {exact}, weights, {{"wall", {0, 3}}, {"interior", {1, 2}}}, 0.0);
  BOOST_TEST(e.size() == 2u);
  BOOST_TEST(e.at("wall").error.l1 == (1.0 + 12.0) / 4.0, tolerance(1e-14));
  BOOST_TEST(e.at("interior").error.linf == 0.0);
  BOOST_TEST(e.at("interior").scale.linf == 0.0);
}

BOOST_AUTO_TEST_CASE(regions_of_a_slab_are_within_2h_and_beyond_4h_of_its_walls) {
  Domain<1> const domain = slab<1>(0.0, 1.0);
  // h = 0.012: particles at 0.005 and 0.015 lie within 0.024, those from 0.055 on beyond 0.048.
  auto const found = regions(on_lattice(domain, 100, 1.2), slab_walls(domain));
  BOOST_TEST(found.size() == 3u);
  BOOST_TEST(find(found, "all")->particles.size() == 100u);
  std::vector<std::size_t> const wall{0, 1, 98, 99};
  BOOST_TEST(find(found, "wall")->particles == wall, boost::test_tools::per_element());
  BOOST_TEST(find(found, "interior")->particles.size() == 90u);
  BOOST_TEST(find(found, "interior")->particles.front() == 5u);
  BOOST_TEST(find(found, "interior")->particles.back() == 94u);
}

BOOST_AUTO_TEST_CASE(regions_in_more_dimensions_know_the_walls_that_there_are) {
  Domain<2> const domain = slab<2>(0.0, 1.0);
  std::vector<Wall<2>> const left{slab_walls(domain)[0]};
  auto const found = regions(on_lattice(domain, 20, 1.1), left);  // h = 0.055
  BOOST_TEST(find(found, "all")->particles.size() == 400u);
  BOOST_TEST(find(found, "wall")->particles.size() == 2u * 20u);
  BOOST_TEST(find(found, "interior")->particles.size() == 16u * 20u);  // beyond 0.22: from 0.225 on
}

BOOST_AUTO_TEST_CASE(corner_is_within_2h_of_two_walls_that_are_not_parallel) {
  Domain<2> const domain = slab<2>(0.0, 1.0);
  auto const particles = on_lattice(domain, 20, 1.1);  // h = 0.055: within 0.11, two particles deep
  auto walls = slab_walls(domain);
  BOOST_TEST(find(regions(particles, walls), "corner") == nullptr);
  walls.push_back({.point = {0.0, 0.0}, .outward_normal = {0.0, -1.0}});
  auto const found = regions(particles, walls);
  std::vector<std::size_t> const corner{0, 1, 20, 21, 360, 361, 380, 381};
  BOOST_TEST_REQUIRE(find(found, "corner") != nullptr);
  BOOST_TEST(find(found, "corner")->particles == corner, boost::test_tools::per_element());
  BOOST_TEST(find(found, "wall")->particles.size() == 2u * 2u * 20u + 2u * 16u);
  // Two walls within reach that are parallel make no corner.
  BOOST_TEST(find(regions(on_lattice(domain, 4, 1.2), slab_walls(domain)), "corner") == nullptr);
}

BOOST_AUTO_TEST_CASE(smooth_is_beyond_4h_and_a_twentieth_of_the_domain_from_features) {
  Domain<1> const domain = slab<1>(0.0, 2.0);
  BOOST_TEST(smooth_margin(domain) == 0.1);
  Features<1> const features{plane_feature<1>("shock", whole_gas(0.0), 0.5),
                             plane_feature<1>("start of the shock", {}, 2.0)};
  struct Expected {
    int resolution;
    double kept;  // 4h = 0.192 on the coarse lattice, the margin 0.1 on the fine one
  };
  for (Expected const& one : {Expected{50, 0.192}, Expected{1000, 0.1}}) {
    auto const particles = on_lattice(domain, one.resolution, 1.2);
    auto const found = regions(particles, slab_walls(domain), {}, features, smooth_margin(domain));
    Region const* const smooth = find(found, "smooth");
    BOOST_TEST_REQUIRE(smooth != nullptr);
    std::vector<std::size_t> expected;
    for (std::size_t i = 0; i < particles.size(); ++i) {
      double const x = particles.positions()[i][0];
      if (std::abs(x - 0.5) > one.kept && x < 2.0 - one.kept) expected.push_back(i);
    }
    BOOST_TEST(smooth->particles == expected, boost::test_tools::per_element());
  }
}

BOOST_AUTO_TEST_CASE(smooth_is_absent_where_a_case_has_no_features_or_they_leave_nothing) {
  Domain<1> const domain = slab<1>(0.0, 1.0);
  auto const particles = on_lattice(domain, 10, 1.2);
  BOOST_TEST(find(regions(particles, slab_walls(domain), {}, {}, 0.05), "smooth") == nullptr);
  Features<1> const middle{plane_feature<1>("front", {{Field::temperature, 0.5}}, 0.5)};
  BOOST_TEST(find(regions(particles, slab_walls(domain), {}, middle, 0.05), "smooth") == nullptr);
  // Particles that do not count are in no region.
  auto const fine = on_lattice(domain, 200, 1.2);
  auto const found = regions(
      fine, slab_walls(domain), [](std::size_t i) { return i < 20; }, middle, 0.05);
  BOOST_TEST(find(found, "smooth")->particles.size() == 20u);
}

BOOST_AUTO_TEST_CASE(the_mean_of_errors_has_their_sign_and_the_weights) {
  List const computed{1.0, 2.0, 9.0};
  List const exact{2.0, 2.5, 0.0};
  List const weights{1.0, 2.0, 5.0};
  BOOST_TEST(*mean_difference(computed, exact, weights, {"wall", {0, 1}}) == (-1.0 - 2.0 * 0.5) / 3.0,
             tolerance(1e-14));
  List const broken{1.0, std::numeric_limits<double>::quiet_NaN(), 9.0};
  BOOST_TEST(!mean_difference(broken, exact, weights, {"wall", {0, 1}}).has_value());
  BOOST_TEST(*mean_difference(broken, exact, weights, {"interior", {2}}) == 9.0);
}

BOOST_AUTO_TEST_CASE(regions_without_particles_are_absent) {
  Domain<1> const domain = slab<1>(0.0, 1.0);
  auto const narrow = regions(on_lattice(domain, 4, 1.2), slab_walls(domain));
  BOOST_TEST(narrow.size() == 2u);
  BOOST_TEST(find(narrow, "interior") == nullptr);
  auto const open = regions(on_lattice(domain, 4, 1.2), {});
  BOOST_TEST(find(open, "wall") == nullptr);
  BOOST_TEST(find(open, "interior")->particles.size() == 4u);
}

BOOST_AUTO_TEST_CASE(regions_go_by_the_support_of_the_kernel) {
  Domain<1> const domain = slab<1>(0.0, 1.0);
  Particles<1> particles = on_lattice(domain, 100, 1.2);
  particles.set_kernel(kernel("quintic-spline", 1));
  // h = 0.012: particles up to 0.035 lie within 0.036, those from 0.075 on beyond 0.072.
  auto const found = regions(particles, slab_walls(domain));
  std::vector<std::size_t> const wall{0, 1, 2, 3, 96, 97, 98, 99};
  BOOST_TEST(find(found, "wall")->particles == wall, boost::test_tools::per_element());
  BOOST_TEST(find(found, "interior")->particles.front() == 7u);
  BOOST_TEST(find(found, "interior")->particles.back() == 92u);
}

BOOST_AUTO_TEST_SUITE_END()
