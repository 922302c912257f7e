// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gsl/gsl_integration.h>

#include <boost/test/unit_test.hpp>
#include <memory>
#include <stdexcept>
#include <string>

// What the tests of the exact solutions measure with. Nothing here is used by the solutions themselves.
namespace sphverify::tests {

/// f'(x) by central differences, error h^6 f^(7)/140.
template <class Function>
double first_derivative(Function const& f, double x, double h) {
  return (45.0 * (f(x + h) - f(x - h)) - 9.0 * (f(x + 2 * h) - f(x - 2 * h)) +
          (f(x + 3 * h) - f(x - 3 * h))) /
         (60.0 * h);
}

/// f''(x) by central differences, error h^6 f^(8)/560; rounding about 6 eps |f| / h^2.
template <class Function>
double second_derivative(Function const& f, double x, double h) {
  return (2.0 * (f(x + 3 * h) + f(x - 3 * h)) - 27.0 * (f(x + 2 * h) + f(x - 2 * h)) +
          270.0 * (f(x + h) + f(x - h)) - 490.0 * f(x)) /
         (180.0 * h * h);
}

/// Integral of f from a to b to 1e-12 relative or absolute; algebraic singularities at the ends are allowed.
template <class Function>
double integral(Function const& f, double a, double b) {
  constexpr std::size_t intervals = 1000;
  std::unique_ptr<gsl_integration_workspace, decltype(&gsl_integration_workspace_free)> const workspace(
      gsl_integration_workspace_alloc(intervals), &gsl_integration_workspace_free);
  gsl_function integrand;
  integrand.function = [](double x, void* data) { return (*static_cast<Function const*>(data))(x); };
  integrand.params = const_cast<Function*>(&f);
  double result = 0.0;
  double error = 0.0;
  gsl_integration_qags(&integrand, a, b, 1e-12, 1e-12, intervals, workspace.get(), &result, &error);
  return result;
}

/// Whether the call refuses its input with exactly this sentence.
template <class Call>
bool refuses(Call const& call, std::string const& message) {
  try {
    call();
  } catch (std::invalid_argument const& problem) {
    if (problem.what() == message) return true;
    BOOST_TEST_MESSAGE("expected \"" << message << "\", found \"" << problem.what() << '"');
  }
  return false;
}

}  // namespace sphverify::tests
