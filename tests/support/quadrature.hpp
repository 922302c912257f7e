// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>

#include <memory>
#include <stdexcept>

namespace sphverify::tests {

/// Integral of f from a to b by GSL's adaptive 61-point Gauss-Kronrod rule, to a relative tolerance or to
/// round-off.
template <class Function>
double quadrature(Function const& f, double a, double b, double tolerance = 1e-13) {
  if (!(a < b)) return 0.0;
  constexpr std::size_t intervals = 400;
  static std::unique_ptr<gsl_integration_workspace, decltype(&gsl_integration_workspace_free)> const
      workspace(gsl_integration_workspace_alloc(intervals), &gsl_integration_workspace_free);
  gsl_function integrand;
  integrand.function = [](double x, void* data) { return (*static_cast<Function const*>(data))(x); };
  integrand.params = const_cast<Function*>(&f);
  double result = 0.0;
  double error = 0.0;
  gsl_error_handler_t* const handler = gsl_set_error_handler_off();
  int const status = gsl_integration_qag(&integrand, a, b, 0.0, tolerance, intervals, GSL_INTEG_GAUSS61,
                                         workspace.get(), &result, &error);
  gsl_set_error_handler(handler);
  // At a step between two points of a machine's numbers it divides on; what is left is no wider than they
  // are.
  bool const settled =
      status == GSL_SUCCESS || status == GSL_EROUND || error <= 1e-11 * std::abs(result) + 1e-14;
  if (!settled) throw std::runtime_error(gsl_strerror(status));
  return result;
}

}  // namespace sphverify::tests
