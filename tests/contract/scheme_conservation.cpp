// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>

#include "tests/support/random_particles.hpp"

// What pairs exchange adds up to zero where a scheme claims it, and visibly does not where it does not claim
// it: here what tests/contract/claims.cpp does not look at.
BOOST_AUTO_TEST_SUITE(scheme_conservation)

using namespace sphverify;
using namespace sphverify::tests;

constexpr std::size_t count = 60;

/// Sum of m times the rate, and the sum of its magnitudes.
struct Balance {
  double net = 0.0;
  double gross = 0.0;
  double relative() const { return std::abs(net) / gross; }
};

template <int Dim>
Balance balance(RandomScene<Dim> const& scene, Rates<Dim> const& rates) {
  auto const& m = scene.particles.masses();
  Balance sum;
  Vector<Dim> force = Vector<Dim>::Zero();
  for (std::size_t i = 0; i < rates.acceleration.size(); ++i) {
    force += m[i] * rates.acceleration[i];
    sum.gross += m[i] * rates.acceleration[i].norm();
  }
  sum.net = force.norm();
  for (std::size_t i = 0; i < rates.heating.size(); ++i) {
    sum.net += m[i] * rates.heating[i];
    sum.gross += m[i] * std::abs(rates.heating[i]);
  }
  return sum;
}

/// Rate of kinetic plus internal energy of a momentum form with a work form that gives internal energy.
template <int Dim>
Balance energy_balance(RandomScene<Dim> const& scene, std::string_view momentum, std::string_view work) {
  auto const a = evaluate(scene, momentum, false).acceleration;
  auto const heating = evaluate(scene, work, false).heating;
  auto const& v = scene.particles.vector(Field::velocity);
  Balance sum;
  for (std::size_t i = 0; i < count; ++i) {
    double const kinetic = scene.particles.masses()[i] * v[i].dot(a[i]);
    double const internal = scene.particles.masses()[i] * heating[i];
    sum.net += kinetic + internal;
    sum.gross += std::abs(kinetic) + std::abs(internal);
  }
  return sum;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(pairs_conserve_what_is_claimed_and_only_that_across_periodic_boundaries_too, D, Dimensions) {
  constexpr int Dim = D::value;
  for (KernelInfo const& of : all_kernel_infos()) {
    for (bool const periodic : {false, true}) {
      // In 3D, and with a wider kernel in 2D, the box is shorter than two supports.
      if (periodic && (Dim == 3 || (Dim == 2 && of.support_ratio > 2.0))) continue;
      RandomScene<Dim> scene = random_scene<Dim>(kernel(of.id, Dim), 1);
      scene.domain.periodic.fill(periodic);
      for (SchemeInfo const* scheme : all_scheme_infos()) {
        if (periodic && scheme->needs_partners) continue;  // so wide a kernel does not fit
        Invariant const wanted = scheme->rate == Rate::acceleration ? Invariant::momentum : Invariant::energy;
        double const defect = balance(scene, evaluate(scene, scheme->id, false)).relative();
        if (scheme->conserves.contains(wanted))
          BOOST_TEST(defect < 1e-13, scheme->id << ", " << of.id);
        else  // heat made here and lost there may nearly cancel: still far from rounding
          BOOST_TEST(defect > 1e-5, scheme->id << ", " << of.id);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(with_walls_the_particles_gain_exactly_what_the_walls_give, D, Dimensions) {
  constexpr int Dim = D::value;
  for (FaceWeight const rule : {FaceWeight::campbell, FaceWeight::exact, FaceWeight::balanced}) {
    RandomScene<Dim> scene = random_scene<Dim>(1, count);
    scene.face_weight = rule;
    for (SchemeInfo const* scheme : all_scheme_infos()) {
      if (scheme->conserves.empty()) continue;
      Rates<Dim> const rates = evaluate(scene, scheme->id);
      Balance const gained = balance(scene, rates);
      double given = 0.0;
      for (double const power : rates.wall_power) given += power;
      Vector<Dim> force = Vector<Dim>::Zero();
      for (Vector<Dim> const& wall : rates.wall_force) force += wall;
      given += force.norm();
      // So wide a kernel that all have partners feels the walls little.
      BOOST_TEST(std::abs(given) > (scheme->needs_partners ? 1e-5 : 1e-3) * gained.gross, scheme->id);
      BOOST_TEST(std::abs(gained.net - given) < 1e-12 * gained.gross, scheme->id);
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(momentum_forms_conserve_energy_with_their_own_partner_and_with_no_other, D,
                              Dimensions) {
  constexpr int Dim = D::value;
  RandomScene<Dim> const scene = random_scene<Dim>(2, count);
  for (SchemeInfo const* momentum : all_scheme_infos()) {
    if (momentum->rate != Rate::acceleration) continue;
    for (SchemeInfo const* work : all_scheme_infos()) {
      if (work->rate != Rate::internal_work) continue;
      bool const partners =
          momentum->conserves.contains(Invariant::momentum) && momentum->work_partner == work->id;
      double const defect = energy_balance(scene, momentum->id, work->id).relative();
      BOOST_TEST_MESSAGE(Dim << "D " << momentum->id << " with " << work->id << ": " << defect);
      if (partners)
        BOOST_TEST(defect < 1e-13, momentum->id << " with " << work->id);
      else
        BOOST_TEST(defect > 1e-4, momentum->id << " with " << work->id);
    }
  }
}

// Eqs. 41 and 42: total less kinetic energy is internal energy, particle by particle and at the walls too.
BOOST_AUTO_TEST_CASE_TEMPLATE(total_energy_less_the_work_of_p_rho2_is_the_internal_energy_form, D,
                              Dimensions) {
  constexpr int Dim = D::value;
  for (bool const walls : {false, true}) {
    RandomScene<Dim> const scene = random_scene<Dim>(4, count);
    auto const a = evaluate(scene, "momentum/p-rho2", walls).acceleration;
    std::vector<double> internal = evaluate(scene, "work/total-energy", walls).heating;
    for (std::size_t i = 0; i < count; ++i)
      internal[i] -= scene.particles.vector(Field::velocity)[i].dot(a[i]);
    BOOST_TEST(relative_difference(internal, evaluate(scene, "work/internal-energy", walls).heating) < 1e-11);
    auto const wrong = evaluate(scene, "work/sqrt-p", walls).heating;
    BOOST_TEST(relative_difference(internal, wrong) > 1e-3);
  }
}

BOOST_AUTO_TEST_SUITE_END()
