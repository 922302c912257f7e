// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/measure/allowed_order.hpp"

#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "cases/support/boxes.hpp"
#include "cases/support/case.hpp"
#include "formulations/kernels/cubic_spline.hpp"
#include "formulations/layouts/layout.hpp"

BOOST_AUTO_TEST_SUITE(harness_measure_allowed_order)

using namespace sphverify;
using boost::test_tools::tolerance;

constexpr std::array<double NormSet::*, 3> all_norms{&NormSet::l1, &NormSet::l2, &NormSet::linf};

template <int Dim>
Particles<Dim> on_lattice(Domain<Dim> const& domain, int resolution) {
  Layout<Dim> const layout = lattice(domain, resolution);
  Particles<Dim> particles(layout.volumes.size(), 1.2 * layout.spacing);
  particles.positions() = layout.positions;
  return particles;
}

Region const& find(std::vector<Region> const& regions, std::string const& name) {
  for (Region const& region : regions) {
    if (region.name == name) return region;
  }
  throw std::runtime_error("no region " + name);
}

void check(std::optional<NormSet> const& found, double l1, double l2, double linf) {
  BOOST_TEST_REQUIRE(found.has_value());
  BOOST_TEST(found->l1 == l1, tolerance(1e-14));
  BOOST_TEST(found->l2 == l2, tolerance(1e-14));
  BOOST_TEST(std::abs(found->linf - linf) < 1e-14);
}

BOOST_AUTO_TEST_CASE(jumps_kinks_and_fronts_allow_the_orders_that_are_derived) {
  check(feature_orders(0.0, 1), 1.0, 0.5, 0.0);                          // a shock
  check(feature_orders(1.0, 1), 2.0, 1.5, 1.0);                          // a kink
  check(feature_orders(1.0 / 3.0, 1), 4.0 / 3.0, 5.0 / 6.0, 1.0 / 3.0);  // a front with K ~ T^3
  check(feature_orders(3.0, 1), 2.0, 2.0, 2.0);
  check(feature_orders(0.0, 2), 2.0, 1.0, 0.0);           // a point in two dimensions
  check(feature_orders(0.0, 0), 0.0, 0.0, 0.0);           // all of a region that shrinks with it
  check(feature_orders(1.0, 1, 0.25), 0.5, 0.375, 0.25);  // the velocity at a vacuum, gamma = 5/3
}

/// What smearing does to |d|^s on a lattice in D dimensions, d the distance from a plane or a point.
template <int Dim>
NormSet smeared(double exponent, bool from_a_point, int resolution) {
  Domain<Dim> domain{Vector<Dim>::Constant(-1.0), Vector<Dim>::Constant(1.0), {}};
  Layout<Dim> const layout = lattice(domain, resolution);
  double const width = 2.4 * layout.spacing;
  auto const f = [&](Vector<Dim> const& x) {
    if (from_a_point) return std::pow(x.norm(), exponent);
    return x[0] > 0.0 ? std::pow(x[0], exponent) : 0.0;
  };
  std::vector<double> change, weights;
  constexpr int points = 8;
  for (std::size_t i = 0; i < layout.positions.size(); ++i) {
    Vector<Dim> const x = layout.positions[i];
    double sum = 0.0;
    double total = 0.0;
    for (int a = -points; a < points; ++a) {
      for (int b = Dim > 1 ? -points : 0; b < (Dim > 1 ? points : 1); ++b) {
        Vector<Dim> u = Vector<Dim>::Zero();
        u[0] = (a + 0.5) / points;
        if constexpr (Dim > 1) u[1] = (b + 0.5) / points;
        if (u.norm() >= 1.0) continue;
        double const weight = 1.0 - u.squaredNorm();
        sum += weight * f(x + width * u);
        total += weight;
      }
    }
    change.push_back(sum / total - f(x));
    weights.push_back(layout.volumes[i]);
  }
  return norms(change, weights);
}

template <int Dim>
void compare_with_smearing(double exponent, bool from_a_point, int coarse) {
  NormSet const allowed = feature_orders(exponent, from_a_point ? Dim : 1);
  NormSet const before = smeared<Dim>(exponent, from_a_point, coarse);
  NormSet const after = smeared<Dim>(exponent, from_a_point, 4 * coarse);
  for (auto const norm : all_norms) {
    double const order = std::log2(before.*norm / (after.*norm)) / 2.0;
    BOOST_TEST(std::abs(order - allowed.*norm) < 0.1,
               "s = " << exponent << ", " << Dim << "D: " << order << ", derived " << allowed.*norm);
  }
}

BOOST_AUTO_TEST_CASE(smearing_powers_of_the_distance_on_lattices_has_the_derived_orders) {
  for (double const s : {0.0, 0.25, 1.0 / 3.0, 0.5, 1.0}) compare_with_smearing<1>(s, false, 4000);
  compare_with_smearing<2>(0.0, false, 60);
  compare_with_smearing<2>(-0.5 + 1.0, true, 60);
  compare_with_smearing<2>(0.25, true, 60);
}

BOOST_AUTO_TEST_CASE(a_feature_counts_in_the_regions_that_it_reaches_and_for_the_fields_it_has) {
  Domain<1> const domain = slab<1>(0.0, 1.0);
  auto const particles = on_lattice(domain, 100);
  Features<1> const shock{plane_feature<1>("shock", whole_gas(0.0), 0.6)};
  auto const found = regions(particles, slab_walls(domain), {}, shock, smooth_margin(domain));
  for (char const* name : {"all", "interior"})
    check(allowed_orders(Field::velocity, shock, particles, find(found, name)), 1.0, 0.5, 0.0);
  for (char const* name : {"wall", "smooth"})
    BOOST_TEST(!allowed_orders(Field::velocity, shock, particles, find(found, name)).has_value(), name);
  BOOST_TEST(!allowed_orders(Field::temperature, shock, particles, find(found, "all")).has_value());

  Features<1> contact{plane_feature<1>("contact", density_and_energy(0.0), 0.6),
                      plane_feature<1>("fan head", whole_gas(1.0), 0.3)};
  check(allowed_orders(Field::density, contact, particles, find(found, "all")), 1.0, 0.5, 0.0);
  check(allowed_orders(Field::pressure, contact, particles, find(found, "all")), 2.0, 1.5, 1.0);
}

BOOST_AUTO_TEST_CASE(a_feature_that_no_particle_is_near_counts_where_the_nearest_one_is) {
  Domain<1> const domain = slab<1>(0.0, 1.0);
  auto const particles = on_lattice(domain, 100);
  Features<1> const beyond{plane_feature<1>("vacuum front", {{Field::velocity, 1.0}}, 1.5)};
  auto const found = regions(particles, slab_walls(domain));
  BOOST_TEST(allowed_orders(Field::velocity, beyond, particles, find(found, "all")).has_value());
  BOOST_TEST(allowed_orders(Field::velocity, beyond, particles, find(found, "wall")).has_value());
  BOOST_TEST(!allowed_orders(Field::velocity, beyond, particles, find(found, "interior")).has_value());
  // Not in `all` if the nearest one is not to be counted.
  auto const counted = regions(particles, slab_walls(domain), [](std::size_t i) { return i < 90; });
  BOOST_TEST(!allowed_orders(Field::velocity, beyond, particles, find(counted, "all")).has_value());
}

BOOST_AUTO_TEST_CASE(a_front_that_the_particles_resolve_is_none) {
  Domain<1> const domain = slab<1>(0.0, 1.0);
  Features<1> front{plane_feature<1>("front", {{Field::temperature, 0.5}}, 0.6)};
  front[0].width = 0.03;
  for (int const resolution : {20, 100}) {  // h is 0.06 and 0.012
    auto const particles = on_lattice(domain, resolution);
    auto const found = regions(particles, slab_walls(domain), {}, front, smooth_margin(domain));
    bool const counts = allowed_orders(Field::temperature, front, particles, find(found, "all")).has_value();
    BOOST_TEST(counts == (resolution == 20));
    BOOST_TEST((find(found, "smooth").particles.size() == particles.size()) == (resolution == 100));
  }
}

// The region `wall` shrinks as fast as what smears a jump beside the wall: the jump keeps its share of it,
// but a shock that runs along the wall does not.
BOOST_AUTO_TEST_CASE(at_a_wall_a_feature_along_it_has_no_smaller_share_on_finer_levels_one_across_it_does) {
  Domain<1> const line = slab<1>(0.0, 1.0);
  Features<1> const beside{plane_feature<1>("contact", {{Field::density, 0.0}}, 0.01)};
  auto const in_1d = on_lattice(line, 200);
  auto const walls_1d = regions(in_1d, slab_walls(line));
  check(allowed_orders(Field::density, beside, in_1d, find(walls_1d, "wall")), 0.0, 0.0, 0.0);
  check(allowed_orders(Field::density, beside, in_1d, find(walls_1d, "all")), 1.0, 0.5, 0.0);

  Domain<2> const square = unit_box<2>();
  auto const in_2d = on_lattice(square, 100);
  auto const walls_2d = regions(in_2d, box_walls(square));
  Features<2> const across{round_feature<2>("shock", {{Field::density, 0.0}}, 0.5)};
  check(allowed_orders(Field::density, across, in_2d, find(walls_2d, "wall")), 1.0, 0.5, 0.0);
  Features<2> const along{plane_feature<2>("contact", {{Field::density, 0.0}}, 0.0)};
  check(allowed_orders(Field::density, along, in_2d, find(walls_2d, "wall")), 0.0, 0.0, 0.0);
  Features<2> corner{round_feature<2>("origin", {{Field::density, 0.0}}, 0.0)};
  corner[0].codimension = 2;
  check(allowed_orders(Field::density, corner, in_2d, find(walls_2d, "all")), 2.0, 1.0, 0.0);
  check(allowed_orders(Field::density, corner, in_2d, find(walls_2d, "wall")), 1.0, 0.5, 0.0);
  check(allowed_orders(Field::density, corner, in_2d, find(walls_2d, "corner")), 0.0, 0.0, 0.0);
}

/// The exact solution of a case on a lattice, smeared over the support 2h, as the answer: its error.
NormSet smeared_case(Problem<1> const& problem, Field field, int resolution, NormSet& allowed,
                     std::string const& region) {
  auto particles = on_lattice(problem.domain, resolution);
  auto const features = problem.features(problem.final_time);
  auto const found = regions(particles, problem.walls, {}, features, smooth_margin(problem.domain));
  double const width = 2.0 * 1.2 * problem.domain.extent()[0] / resolution;
  auto const exact = [&](double x) {
    if (field == Field::velocity) return problem.vectors.at(field)(Vector<1>(x), problem.final_time)[0];
    return problem.scalars.at(field)(Vector<1>(x), problem.final_time);
  };
  std::vector<double> error;
  for (std::size_t const i : find(found, region).particles) {
    double const x = particles.positions()[i][0];
    if (x - width < problem.domain.lower[0] || x + width > problem.domain.upper[0]) continue;
    double sum = 0.0;
    double total = 0.0;
    for (int k = -20; k < 20; ++k) {
      double const u = (k + 0.5) / 20.0;
      double const weight = 1.0 - u * u;
      sum += weight * exact(x + width * u);
      total += weight;
    }
    error.push_back(sum / total - exact(x));
  }
  allowed = allowed_orders(field, features, particles, find(found, region)).value_or(NormSet{2.0, 2.0, 2.0});
  return norms(error, std::vector<double>(error.size(), 1.0));
}

void compare_case(char const* id, std::map<std::string, ParameterValue> const& values, Field field,
                  std::string const& region = "all") {
  Case const& one = *find_case(id);
  Parameters parameters(one.info.parameters);
  for (auto const& [name, value] : values) parameters.set(name, value);
  auto const problem = std::get<Problem<1>>(one.problem(parameters));
  // How far the nearest particle is from a front changes from level to level: means of nearby ones.
  NormSet allowed;
  auto const logarithm = [&](double NormSet::*norm, int resolution) {
    double sum = 0.0;
    for (int const more : {0, 7, 13, 29, 41})
      sum += std::log2(smeared_case(problem, field, resolution + more, allowed, region).*norm) / 5.0;
    return sum;
  };
  BOOST_TEST_CONTEXT(id << " " << info(field).name << " in " << region) {
    for (auto const norm : all_norms) {
      double const order = (logarithm(norm, 500) - logarithm(norm, 4000)) / 3.0;
      BOOST_TEST(std::abs(order - allowed.*norm) < 0.12, order << ", allowed " << allowed.*norm);
    }
  }
}

BOOST_AUTO_TEST_CASE(exact_solutions_that_are_smeared_over_the_support_have_the_errors_that_are_allowed) {
  compare_case("conduction/marshak", {{"exponent", 3.0}}, Field::temperature);
  compare_case("conduction/marshak", {{"exponent", 1.0}, {"final_time", 0.2}}, Field::temperature);
  compare_case("conduction/barenblatt", {{"exponent", 2.0}}, Field::temperature);
  compare_case("conduction/barenblatt", {{"exponent", 3.0}}, Field::temperature);
  compare_case("extreme/conductivity-contrast", {}, Field::temperature);
  compare_case("extreme/cold-front", {{"exponent", 3.0}}, Field::temperature);
  compare_case("hydro/piston-velocity", {}, Field::velocity);
  for (Field const field : {Field::density, Field::pressure, Field::velocity, Field::internal_energy})
    compare_case("hydro/riemann", {}, field);
  compare_case("hydro/riemann", {{"preset", std::string("toro-2")}}, Field::velocity);
  // Where there is nothing.
  compare_case("conduction/marshak", {{"exponent", 3.0}}, Field::temperature, "smooth");
  compare_case("hydro/riemann", {}, Field::pressure, "smooth");
}

RunRecord run_with(std::optional<NormSet> const& allowed) {
  RunRecord run;
  run.errors["velocity"]["all"].allowed = allowed;
  return run;
}

BOOST_AUTO_TEST_CASE(a_ladder_allows_what_its_finest_level_with_errors_does) {
  RunRecord const coarse = run_with(NormSet{1.0, 0.5, 0.0});
  RunRecord const fine = run_with(std::nullopt);
  RunRecord const kink = run_with(NormSet{2.0, 1.5, 1.0});
  RunRecord failed;
  auto const allowed = [](std::vector<std::vector<RunRecord const*>> const& levels) {
    return allowed_of_ladder(levels, "velocity", "all");
  };
  check(allowed({{&coarse}, {&fine}}), 2.0, 2.0, 2.0);
  check(allowed({{&fine}, {&coarse}}), 1.0, 0.5, 0.0);
  check(allowed({{&fine}, {&coarse}, {&failed}}), 1.0, 0.5, 0.0);
  check(allowed({{&fine, &kink, &failed}}), 2.0, 1.5, 1.0);
  check(allowed({{&failed}}), 2.0, 2.0, 2.0);
  check(allowed({}), 2.0, 2.0, 2.0);
}

BOOST_AUTO_TEST_SUITE_END()
