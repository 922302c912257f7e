#pragma once

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>

#include <memory>
#include <stdexcept>

namespace sphverify::tests {

/// Integral of f from a to b by GSL's adaptive 61-point Gauss-Kronrod rule, to a relative 1e-13 or to
/// round-off.
template <class Function>
double quadrature(Function const& f, double a, double b) {
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
  int const status = gsl_integration_qag(&integrand, a, b, 0.0, 1e-13, intervals, GSL_INTEG_GAUSS61,
                                         workspace.get(), &result, &error);
  gsl_set_error_handler(handler);
  if (status != GSL_SUCCESS && status != GSL_EROUND) throw std::runtime_error(gsl_strerror(status));
  return result;
}

}  // namespace sphverify::tests
