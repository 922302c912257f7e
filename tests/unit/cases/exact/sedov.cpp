// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/sedov.hpp"

#include <array>
#include <boost/numeric/odeint.hpp>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/unit/cases/exact/numerics.hpp"

BOOST_AUTO_TEST_SUITE(cases_exact_sedov)

using namespace sphverify::exact;
using namespace sphverify::tests;

constexpr int dimensions[] = {1, 2, 3};
// Both sides of 2, where the closed form has a limit, and the limit itself.
constexpr double gammas[] = {1.1, 1.4, 5.0 / 3.0, 1.999999, 2.0, 2.001, 3.0, 6.5};
constexpr double whole_angle[] = {2.0, 2.0 * std::numbers::pi, 4.0 * std::numbers::pi};

constexpr double density = 1.3;
constexpr double energy = 0.8;

/// Calls check(solution, dimension, gamma) for all of both lists.
template <class Check>
void for_each_explosion(Check const& check) {
  for (int const dimension : dimensions) {
    for (double const gamma : gammas) {
      BOOST_TEST_CONTEXT("d = " << dimension << ", gamma = " << gamma)
      check(Sedov(dimension, gamma, density, energy), dimension, gamma);
    }
  }
}

/// The Euler equations of a self-similar flow, v = D xi V(xi), rho = rho0 g(xi), P = rho0 D^2 h(xi),
/// integrated from the shock inwards. As D falls as R^(-d/2), with ' = d/d(ln xi),
///
///   (V - 1) (ln g)' + V' + d V = 0
///   (V - 1) (V' + V) - d V/2 + h'/(xi^2 g) = 0
///   (V - 1) (ln h)' + gamma (V' + d V) - d = 0.
class Integrated {
 public:
  using Real = long double;
  using State = std::array<Real, 4>;  // V, ln g, ln h, and the energy between here and the shock

  Integrated(int dimension, double gamma)
      : d_(dimension),
        gamma_(gamma),
        state_{2 / (gamma_ + 1), std::log((gamma_ + 1) / (gamma_ - 1)), std::log(2 / (gamma_ + 1)), 0} {}

  /// To be called with falling xi.
  State const& at(Real xi) {
    namespace odeint = boost::numeric::odeint;
    auto const stepper = odeint::make_controlled<odeint::runge_kutta_fehlberg78<State, Real>>(1e-18L, 1e-18L);
    auto const slope = [this](State const& y, State& dy, Real log_xi) {
      auto const& [V, log_g, log_h, e] = y;
      Real const xi2 = std::exp(2 * log_xi);
      Real const g = std::exp(log_g);
      Real const h = std::exp(log_h);
      Real const hotness = h / (xi2 * g);  // c^2/(gamma (D xi)^2)
      // V' from the last two equations.
      Real const w = V - 1;
      Real const dV =
          (hotness * (d_ - gamma_ * d_ * V) + w * (w * V - d_ * V / 2)) / (gamma_ * hotness - w * w);
      Real const divergence = dV + d_ * V;
      dy = {dV, -divergence / w, (d_ - gamma_ * divergence) / w,
            -std::exp(d_ * log_xi) * (g * xi2 * V * V / 2 + h / (gamma_ - 1))};
    };
    odeint::integrate_adaptive(stepper, slope, state_, log_xi_, std::log(xi), Real(-1e-3));
    log_xi_ = std::log(xi);
    return state_;
  }

  /// alpha; the rest of the energy, about the centre, is that of its pressure.
  Real energy_constant() const {
    Real const rest = std::exp(d_ * log_xi_ + state_[2]) / (d_ * (gamma_ - 1));
    return 4 / ((d_ + 2) * (d_ + 2)) * whole_angle[static_cast<int>(d_) - 1] * (state_[3] + rest);
  }

 private:
  Real d_, gamma_;
  Real log_xi_ = 0;
  State state_;
};

double error(double found, long double expected) {
  return std::abs(static_cast<double>((found - expected) / expected));
}

BOOST_AUTO_TEST_CASE(profiles_and_energy_are_those_of_integrated_equations_as_accurately_as_promised) {
  for_each_explosion([](Sedov const& exact, int dimension, double gamma) {
    BOOST_TEST(exact.accuracy() < 1e-12);
    Integrated integrated(dimension, gamma);
    double const t = 0.7;
    double const R = exact.shock_radius(t);
    double const D = exact.shock_speed(t);
    // Nearer to the centre rounding grows in the integration.
    for (double const xi : {0.999, 0.98, 0.9, 0.8, 0.6, 0.4, 0.2, 0.1}) {
      auto const& [V, log_g, log_h, e] = integrated.at(xi);
      GasState const found = exact.at(xi * R, t);
      BOOST_TEST(error(found.density, density * std::exp(log_g)) <= exact.accuracy());
      BOOST_TEST(error(found.velocity, D * xi * V) <= exact.accuracy());
      BOOST_TEST(error(found.pressure, density * D * D * std::exp(log_h)) <= exact.accuracy());
    }
    // Where the pressure is that of the centre to 1e-12: the sooner, the faster the gas thins out.
    integrated.at(gamma < 1.3 ? 0.1 : 1e-4);
    BOOST_TEST(error(exact.energy_constant(), integrated.energy_constant()) < 1e-11);
  });
}

// The energies that Kamm & Timmes, LA-UR-07-2849, give for these radii at t = 1, planar for one side. They
// are good to 4e-4, the spherical one to its last digit.
BOOST_AUTO_TEST_CASE(shocks_of_the_literature_are_where_it_says) {
  BOOST_TEST(Sedov(1, 1.4, 1, 2.0 * 0.0673185).shock_radius(1) == 0.5, boost::test_tools::tolerance(1.3e-4));
  BOOST_TEST(Sedov(2, 1.4, 1, 0.311357).shock_radius(1) == 0.75, boost::test_tools::tolerance(1e-5));
  BOOST_TEST(Sedov(3, 1.4, 1, 0.851072).shock_radius(1) == 1.0, boost::test_tools::tolerance(1e-6));
}

/// Integral of quantity(state) over all that the shock has passed, by the fields alone.
template <class Quantity>
double content(Sedov const& exact, int dimension, double t, Quantity const& quantity) {
  auto const shell = [&](double r) {
    return quantity(exact.at(r, t)) * std::pow(r, dimension - 1) * whole_angle[dimension - 1];
  };
  double const R = exact.shock_radius(t);
  // The shock's own place belongs to the gas ahead.
  return integral(shell, 0.0, 0.7 * R) + integral(shell, 0.7 * R, R * (1.0 - 1e-15));
}

BOOST_AUTO_TEST_CASE(mass_and_energy_behind_the_shock_are_what_was_there_and_what_was_released) {
  for_each_explosion([](Sedov const& exact, int dimension, double gamma) {
    for (double const t : {0.01, 0.7}) {
      double const swept =
          whole_angle[dimension - 1] * density * std::pow(exact.shock_radius(t), dimension) / dimension;
      double const mass = content(exact, dimension, t, [](GasState const& s) { return s.density; });
      BOOST_TEST(mass == swept, boost::test_tools::tolerance(1e-10));
      auto const energy_density = [&](GasState const& s) {
        return 0.5 * s.density * s.velocity * s.velocity + s.pressure / (gamma - 1.0);
      };
      BOOST_TEST(content(exact, dimension, t, energy_density) == energy, boost::test_tools::tolerance(1e-10));
    }
  });
}

BOOST_AUTO_TEST_CASE(mass_momentum_and_energy_pass_the_shock_unchanged) {
  for_each_explosion([](Sedov const& exact, int, double gamma) {
    double const t = 0.3;
    double const R = exact.shock_radius(t);
    double const D = first_derivative([&](double s) { return exact.shock_radius(s); }, t, 1e-3);
    BOOST_TEST(exact.shock_speed(t) == D, boost::test_tools::tolerance(1e-9));
    GasState const before = exact.at(R, t);
    GasState const after = exact.at(R * (1.0 - 1e-13), t);
    BOOST_TEST(before.density == density);
    BOOST_TEST(before.pressure == 0.0);
    BOOST_TEST(before.velocity == 0.0);
    BOOST_TEST(after.density * (D - after.velocity) == density * D, boost::test_tools::tolerance(1e-9));
    BOOST_TEST(after.pressure == density * D * after.velocity, boost::test_tools::tolerance(1e-9));
    double const w = D - after.velocity;
    BOOST_TEST(gamma / (gamma - 1.0) * after.pressure / after.density + 0.5 * w * w == 0.5 * D * D,
               boost::test_tools::tolerance(1e-9));
  });
}

BOOST_AUTO_TEST_CASE(fields_solve_the_euler_equations) {
  for_each_explosion([](Sedov const& exact, int dimension, double gamma) {
    double const t = 0.5;
    double const R = exact.shock_radius(t);
    for (double const xi : {0.3, 0.6, 0.9, 0.97}) {
      double const r = xi * R;
      // By logarithms, since powers of r and t are what a thin gas is made of.
      double const h = 1e-3;
      auto const in_time = [&](auto const& f) {
        return first_derivative([&](double s) { return f(exact.at(r, t * std::exp(s))); }, 0.0, h) / t;
      };
      auto const in_space = [&](auto const& f) {
        return first_derivative([&](double s) { return f(exact.at(r * std::exp(s), t)); }, 0.0, h) / r;
      };
      auto const log_density = [](GasState const& s) { return std::log(s.density); };
      auto const velocity = [](GasState const& s) { return s.velocity; };
      auto const pressure = [](GasState const& s) { return s.pressure; };
      auto const log_entropy = [&](GasState const& s) {
        return std::log(s.pressure) - gamma * std::log(s.density);
      };
      GasState const gas = exact.at(r, t);
      double const v = gas.velocity;
      double const divergence = in_space(velocity) + (dimension - 1) * v / r;
      double const mass = in_time(log_density) + v * in_space(log_density) + divergence;
      double const momentum = in_time(velocity) + v * in_space(velocity) + in_space(pressure) / gas.density;
      double const entropy = in_time(log_entropy) + v * in_space(log_entropy);
      BOOST_TEST_CONTEXT("xi = " << xi) {
        double const steepness = in_space(log_density) * v;
        BOOST_TEST(std::abs(mass) < 1e-7 * steepness);
        double const rounding = 1e-12 * gas.pressure / (gas.density * r);
        BOOST_TEST(std::abs(momentum) < 1e-7 * v / t * (1.0 + steepness * t) + rounding);
        BOOST_TEST(std::abs(entropy) < 1e-7 * gamma * steepness);
      }
    }
  });
}

// Near the centre the density falls as r^(d/(gamma-1)), the pressure has a value of its own.
BOOST_AUTO_TEST_CASE(centre_is_empty_and_under_pressure) {
  for_each_explosion([](Sedov const& exact, int dimension, double gamma) {
    double const t = 0.4;
    double const R = exact.shock_radius(t);
    GasState const centre = exact.at(0.0, t);
    BOOST_TEST(centre.density == 0.0);
    BOOST_TEST(centre.velocity == 0.0);
    BOOST_TEST(centre.pressure > 0.0);
    GasState const near = exact.at(1e-4 * R, t);
    GasState const far = exact.at(2e-4 * R, t);
    BOOST_TEST(near.pressure == centre.pressure, boost::test_tools::tolerance(1e-6));
    BOOST_TEST(std::log2(far.density / near.density) == dimension / (gamma - 1.0),
               boost::test_tools::tolerance(1e-3));
    BOOST_TEST(near.velocity == 2.0 / (dimension + 2.0) * 1e-4 * R / (t * gamma),
               boost::test_tools::tolerance(1e-3));
    GasState const innermost = exact.at(1e-300, t);
    BOOST_TEST((innermost.density >= 0.0 && innermost.density < 1e-20));
    BOOST_TEST(innermost.pressure == centre.pressure, boost::test_tools::tolerance(1e-9));
  });
}

BOOST_AUTO_TEST_CASE(at_the_start_all_gas_is_at_rest) {
  for (double const r : {0.0, 1e-9, 1.0}) {
    GasState const gas = Sedov(3, 1.4, density, energy).at(r, 0.0);
    BOOST_TEST(gas.density == density);
    BOOST_TEST(gas.velocity == 0.0);
    BOOST_TEST(gas.pressure == 0.0);
  }
}

BOOST_AUTO_TEST_CASE(shock_is_at_a_radius_when_it_says_so) {
  for_each_explosion([](Sedov const& exact, int, double) {
    for (double const radius : {0.01, 0.7, 3.0}) {
      BOOST_TEST(exact.shock_radius(exact.shock_time(radius)) == radius, boost::test_tools::tolerance(1e-14));
    }
    BOOST_TEST(exact.shock_radius(0.0) == 0.0);
  });
}

BOOST_AUTO_TEST_CASE(invalid_input_is_refused) {
  BOOST_TEST(refuses([] { Sedov(0, 1.4, 1, 1); }, "dimension must be 1 or more, found 0"));
  BOOST_TEST(refuses([] { Sedov(4, 1.4, 1, 1); }, "dimension must be 1, 2 or 3, found 4"));
  BOOST_TEST(refuses([] { Sedov(3, 1.0, 1, 1); }, "gamma must be above 1, found 1"));
  BOOST_TEST(refuses([] { Sedov(3, 7.0, 1, 1); },
                     "gamma must be below 7 for gas to reach the centre in 3D, found 7"));
  BOOST_CHECK_NO_THROW(Sedov(2, 7.0, 1, 1));
  BOOST_TEST(refuses([] { Sedov(3, 1.4, 0, 1); }, "density must be positive, found 0"));
  BOOST_TEST(refuses([] { Sedov(3, 1.4, 1, -1); }, "energy must be positive, found -1"));
  BOOST_TEST(refuses([] { Sedov(3, 1.4, 1, 1).at(-1, 1); }, "radius must be zero or positive, found -1"));
  BOOST_TEST(refuses([] { Sedov(3, 1.4, 1, 1).at(1, -1); }, "time must be zero or positive, found -1"));
  BOOST_CHECK_THROW(Sedov(3, std::numeric_limits<double>::quiet_NaN(), 1, 1), std::invalid_argument);
}

// What `describe hydro/sedov` says. Kamm & Timmes, LA-UR-07-2849, list 0.0673185 for a half space.
BOOST_AUTO_TEST_CASE(planar_energy_counts_both_half_spaces) {
  struct Known {
    double gamma;
    std::array<double, 3> alpha;
  };
  for (Known const& known :
       {Known{1.4, {1.077486, 0.984074, 0.851072}}, Known{5.0 / 3.0, {0.602935, 0.564283, 0.493590}}}) {
    for (int const d : dimensions) {
      double const alpha = Sedov(d, known.gamma, 1.0, 1.0).energy_constant();
      BOOST_TEST(std::abs(alpha - known.alpha[static_cast<std::size_t>(d - 1)]) < 6e-7);
      Integrated independent(d, known.gamma);
      independent.at(1e-4L);
      BOOST_TEST(std::abs(alpha - static_cast<double>(independent.energy_constant())) < 1e-9);
    }
  }
  double const alpha = Sedov(1, 1.4, 1.0, 1.0).energy_constant();
  BOOST_TEST(std::abs(alpha * 0.125 - 0.134686) < 5e-7);
  BOOST_TEST(std::abs(0.5 * alpha * 0.125 - 0.0673428) < 5e-8);
  BOOST_TEST(std::abs(Sedov(1, 1.4, 1.0, 0.134686).shock_radius(1.0) - 0.5) < 1e-6);
  BOOST_TEST(std::abs(Sedov(1, 1.4, 1.0, 2.0 * 0.0673185).shock_radius(1.0) - 0.49994) < 5e-6);
}

BOOST_AUTO_TEST_SUITE_END()
