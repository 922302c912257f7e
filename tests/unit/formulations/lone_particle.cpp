// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <map>
#include <string>

#include "tests/support/random_particles.hpp"

// One particle beside one wall. Where it is alone within reach, rho_B = 2 m W(d) (Eq. 13), so that of Eq.
// 11's wall term P_B/rho_B S is left P_B S/(2 m W(d)): in 1D S = W(d), and the rate is P_B/(2 m) for all d <
// 2h and 0 beyond. It does not fade out as the kernel does.
BOOST_AUTO_TEST_SUITE(formulations_lone_particle)

using namespace sphverify;
using namespace sphverify::tests;

constexpr double h = 0.25;
constexpr double m = 0.7;
constexpr double rho = 1.3;
constexpr double K = 0.6;
constexpr double wall_pressure = 1.7;
constexpr double wall_velocity = 0.4;
constexpr double own_velocity = 0.9;
constexpr double wall_temperature = 2.1;
constexpr double wall_flux = 0.8;

/// The wall's outward normal is the first axis; the particle is as far inside as asked.
template <int Dim>
RandomScene<Dim> beside_a_wall(double distance, bool with_flux) {
  RandomScene<Dim> scene{.particles = Particles<Dim>(1, h),
                   .domain = {.lower = Vector<Dim>::Constant(-5.0), .upper = Vector<Dim>::Constant(5.0)}};
  scene.particles.allocate(all_fields);
  scene.particles.positions().set(0, -distance * Vector<Dim>::Unit(0));
  scene.particles.masses()[0] = m;
  for (auto const& [field, value] :
       {std::pair{Field::density, rho}, std::pair{Field::pressure, 0.9}, std::pair{Field::conductivity, K},
        std::pair{Field::temperature, 1.1}, std::pair{Field::internal_energy, 1.0}, std::pair{Field::omega, 1.1}})
    scene.particles.scalar(field)[0] = value;
  scene.particles.vector(Field::velocity).set(0, own_velocity * Vector<Dim>::Unit(0));
  Wall<Dim> wall{.point = Vector<Dim>::Zero(), .outward_normal = Vector<Dim>::Unit(0)};
  wall.pressure = [](Vector<Dim> const&, double) { return wall_pressure; };
  wall.velocity = [](Vector<Dim> const&, double) -> Vector<Dim> {
    return wall_velocity * Vector<Dim>::Unit(0);
  };
  wall.temperature = [](Vector<Dim> const&, double) { return wall_temperature; };
  wall.conductivity = [](Vector<Dim> const&, double) { return K; };
  if (with_flux) {
    wall.flux = [](Vector<Dim> const&, double) -> Vector<Dim> { return wall_flux * Vector<Dim>::Unit(0); };
  }
  scene.walls.push_back(wall);
  return scene;
}

/// Acceleration along the normal, or heating.
template <int Dim>
double rate_at(double distance, std::string_view id, bool with_flux = false) {
  Rates<Dim> const rates = evaluate(beside_a_wall<Dim>(distance, with_flux), id);
  return rates.heating.empty() ? rates.acceleration[0][0] : rates.heating[0];
}

// Kernel weights near 2h are cubes of the distance from there: so near, rounding of 2h - d enters.
constexpr double inside = 2.0 * h * (1.0 - 1e-4);
constexpr double outside = 2.0 * h * (1.0 + 1e-4);

BOOST_AUTO_TEST_CASE(rates_that_divide_by_the_wall_density_jump_at_2h_and_no_others_do) {
  std::map<std::string_view, double> const jumps{
      {"momentum/p-rho2", -wall_pressure / (2.0 * m)},
      {"momentum/p-rho2-grad-h", -wall_pressure / (2.0 * m)},
      {"work/internal-energy", wall_pressure * (own_velocity - wall_velocity) / (2.0 * m)},
      {"work/total-energy", -wall_pressure * wall_velocity / (2.0 * m)},
      {"conduction/campbell-flux", -wall_flux / (2.0 * m)}};
  for (SchemeInfo const* scheme : all_scheme_infos()) {
    if (scheme->needs_partners || reads_face_offsets(*scheme)) continue;  // one particle has no partners, and an open cell
    auto const jump = jumps.find(scheme->id);
    double const expected = jump == jumps.end() ? 0.0 : jump->second;
    BOOST_TEST_CONTEXT(scheme->id) {
      BOOST_TEST(rate_at<1>(outside, scheme->id, true) == 0.0);
      BOOST_TEST(std::abs(rate_at<1>(inside, scheme->id, true) - expected) < 1e-6);
      // The words of `describe`.
      bool const says_so = scheme->remarks.find("one support R from a wall") != std::string_view::npos;
      BOOST_TEST(says_so == (jump != jumps.end()));
    }
  }
}

BOOST_AUTO_TEST_CASE(the_flux_of_campbell_s_form_jumps_by_the_wall_temperature) {
  Rates<1> const near = evaluate(beside_a_wall<1>(inside, false), "conduction/campbell-flux");
  BOOST_TEST(std::abs(near.flux[0][0] + K * rho * wall_temperature / (2.0 * m)) < 1e-6);
  BOOST_TEST(std::abs(near.heating[0]) < 1e-6);  // an interpolated F_B fades out
  Rates<1> const far = evaluate(beside_a_wall<1>(outside, false), "conduction/campbell-flux");
  BOOST_TEST(far.flux[0][0] == 0.0);
}

// S/W(d) of the exact face weight near 2h: (32/35) sqrt(4 h (2h - d)) in 2D, pi h (2h - d) in 3D.
BOOST_AUTO_TEST_CASE(in_more_dimensions_the_face_shrinks_before_the_wall_density_does) {
  double const gap = 2.0 * h - inside;
  double const whole = -wall_pressure / (2.0 * m);
  double const in_2d = whole * 32.0 / 35.0 * std::sqrt(4.0 * h * gap);
  double const in_3d = whole * 3.14159265358979 * h * gap;
  BOOST_TEST(std::abs(rate_at<2>(inside, "momentum/p-rho2") / in_2d - 1.0) < 1e-3);
  BOOST_TEST(std::abs(rate_at<3>(inside, "momentum/p-rho2") / in_3d - 1.0) < 1e-3);
}

BOOST_AUTO_TEST_SUITE_END()
