// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/measure/surface_fit.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_multifit_nlinear.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>

namespace sphverify {

namespace {

using Sampling = SurfaceModel::Sampling;
using Correlation = SurfaceModel::Correlation;

/// How strongly a parameter is held to where the fit started, for where the data do not see it: a part of a
/// residual per unit. The exponent of smoothing is held more, to what theory says of smooth solutions.
constexpr double hold = 0.02;
constexpr double hold_smoothing = 0.1;
constexpr double smoothing_by_theory = 2.0;
constexpr double least_threshold = 0.02;
constexpr double threshold_in_scales = 2.5;
constexpr double smallest_misfit = 1e-8;

std::vector<SurfaceModel> all_models() {
  std::vector<SurfaceModel> models{
      {"smoothing", true, false, Sampling::none, false, Correlation::squares},
      {"smoothing on a floor", true, true, Sampling::none, false, Correlation::squares},
      {"sampling", false, false, Sampling::power, false, Correlation::squares},
      {"sampling that changes with the spacing", false, false, Sampling::power, true, Correlation::squares},
      {"sampling by ratio", false, false, Sampling::by_ratio, false, Correlation::squares},
      {"sampling by ratio that changes with the spacing", false, false, Sampling::by_ratio, true,
       Correlation::squares}};
  for (auto const& [sampling, name] :
       {std::pair{Sampling::power, "sampling"}, std::pair{Sampling::by_ratio, "sampling by ratio"}}) {
    for (bool const spacing : {false, true}) {
      std::string const full =
          std::string("smoothing and ") + name + (spacing ? " that changes with the spacing" : "");
      models.push_back({full, true, false, sampling, spacing, Correlation::squares});
      models.push_back({full + ", added", true, false, sampling, spacing, Correlation::added});
      if (sampling == Sampling::power)
        models.push_back({full + ", correlated", true, false, sampling, spacing, Correlation::fitted});
    }
  }
  return models;
}

/// Where a model's parameters stand in the vector that is fitted: ln A, ln p; ln B, ln s or ln B for each
/// ratio; t; ln F; artanh c.
struct Places {
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  std::size_t smoothing = none, sampling = none, spacing = none, floor = none, correlation = none, count = 0;

  Places(SurfaceModel const& model, std::size_t columns) {
    auto const take = [&](std::size_t& place, std::size_t number) {
      place = count;
      count += number;
    };
    if (model.smoothing) take(smoothing, 2);
    if (model.sampling == Sampling::power) take(sampling, 2);
    if (model.sampling == Sampling::by_ratio) take(sampling, columns);
    if (model.spacing) take(spacing, 1);
    if (model.floor) take(floor, 1);
    if (model.correlation == Correlation::fitted) take(correlation, 1);
  }
};

/// Data and model as the minimiser sees them.
struct LeastSquares {
  struct Point {
    double log_ratio, log_spacing, log_error;
    std::size_t column;
  };
  SurfaceModel model;
  Places places;
  std::vector<Point> points;
  std::vector<double> held_to, holds;
  std::vector<double> ratios;  ///< by column
  double unit = 0.0;

  LeastSquares(std::vector<SurfaceDatum> const& data, SurfaceModel const& m, std::size_t columns)
      : model(m), places(m, columns), ratios(columns, 0.0) {
    unit = std::numeric_limits<double>::infinity();
    for (SurfaceDatum const& datum : data) unit = std::min(unit, datum.spacing);
    for (SurfaceDatum const& datum : data) {
      points.push_back(
          {std::log(datum.ratio), std::log(datum.spacing / unit), std::log(datum.error), datum.column});
      ratios[datum.column] = datum.ratio;
    }
  }

  void hold_to(std::vector<double> const& start) {
    held_to = start;
    holds.assign(start.size(), hold);
    if (!model.smoothing) return;
    held_to[places.smoothing + 1] = std::log(smoothing_by_theory);
    holds[places.smoothing + 1] = hold_smoothing;
  }

  /// ln of the law at a point, and its derivatives by the parameters where they are asked for.
  double log_law(double const* theta, Point const& at, double* slopes) const {
    double const p = model.smoothing ? std::exp(theta[places.smoothing + 1]) : 0.0;
    double const s = model.sampling == Sampling::power ? std::exp(theta[places.sampling + 1]) : 0.0;
    double const reach = at.log_ratio + at.log_spacing;
    double const smoothing = model.smoothing ? std::exp(theta[places.smoothing] + p * reach) : 0.0;
    double const t = model.spacing ? theta[places.spacing] : 0.0;
    double sampling = 0.0;
    if (model.sampling == Sampling::power)
      sampling = std::exp(theta[places.sampling] - s * at.log_ratio + t * at.log_spacing);
    if (model.sampling == Sampling::by_ratio)
      sampling = std::exp(theta[places.sampling + at.column] + t * at.log_spacing);
    double const floor = model.floor ? std::exp(theta[places.floor]) : 0.0;
    double const c = model.correlation == Correlation::fitted  ? std::tanh(theta[places.correlation])
                     : model.correlation == Correlation::added ? 1.0
                                                               : 0.0;
    double const square =
        std::max(smoothing * smoothing + sampling * sampling + 2.0 * c * smoothing * sampling,
                 std::numeric_limits<double>::min());
    double const both = std::sqrt(square);
    double const law = floor + both;
    if (slopes != nullptr) {
      double const share = both / law / square;
      double const by_smoothing = share * (smoothing * smoothing + c * smoothing * sampling);
      double const by_sampling = share * (sampling * sampling + c * smoothing * sampling);
      std::fill(slopes, slopes + places.count, 0.0);
      if (model.smoothing) {
        slopes[places.smoothing] = by_smoothing;
        slopes[places.smoothing + 1] = by_smoothing * p * reach;
      }
      if (model.sampling == Sampling::power) {
        slopes[places.sampling] = by_sampling;
        slopes[places.sampling + 1] = -by_sampling * s * at.log_ratio;
      }
      if (model.sampling == Sampling::by_ratio) slopes[places.sampling + at.column] = by_sampling;
      if (model.spacing) slopes[places.spacing] = by_sampling * at.log_spacing;
      if (model.floor) slopes[places.floor] = floor / law;
      if (model.correlation == Correlation::fitted)
        slopes[places.correlation] = share * smoothing * sampling * (1.0 - c * c);
    }
    return std::log(law);
  }

  static int residuals(gsl_vector const* theta, void* self, gsl_vector* f) {
    auto const& problem = *static_cast<LeastSquares const*>(self);
    std::size_t const n = problem.points.size();
    for (std::size_t k = 0; k < n; ++k) {
      double const r = problem.log_law(theta->data, problem.points[k], nullptr) - problem.points[k].log_error;
      if (!std::isfinite(r)) return GSL_EDOM;
      gsl_vector_set(f, k, r);
    }
    for (std::size_t k = 0; k < problem.places.count; ++k)
      gsl_vector_set(f, n + k, problem.holds[k] * (theta->data[k] - problem.held_to[k]));
    return GSL_SUCCESS;
  }

  static int derivatives(gsl_vector const* theta, void* self, gsl_matrix* j) {
    auto const& problem = *static_cast<LeastSquares const*>(self);
    std::size_t const n = problem.points.size();
    for (std::size_t k = 0; k < n; ++k)
      problem.log_law(theta->data, problem.points[k], gsl_matrix_ptr(j, k, 0));
    for (std::size_t k = 0; k < problem.places.count; ++k) {
      for (std::size_t l = 0; l < problem.places.count; ++l)
        gsl_matrix_set(j, n + k, l, k == l ? problem.holds[k] : 0.0);
    }
    return GSL_SUCCESS;
  }
};

double huber(double residual, double threshold) {
  double const size = std::abs(residual);
  return size <= threshold ? size * size : (2.0 * size - threshold) * threshold;
}

using Workspace = std::unique_ptr<gsl_multifit_nlinear_workspace, decltype(&gsl_multifit_nlinear_free)>;
using GslVector = std::unique_ptr<gsl_vector, decltype(&gsl_vector_free)>;

/// GSL's default ends the program at an error.
class QuietGsl {
 public:
  QuietGsl() : before_(gsl_set_error_handler_off()) {}
  ~QuietGsl() { gsl_set_error_handler(before_); }
  QuietGsl(QuietGsl const&) = delete;
  QuietGsl& operator=(QuietGsl const&) = delete;

 private:
  gsl_error_handler_t* before_;
};

/// The minimum of the robust loss from one start; false where it leads nowhere.
bool minimise(LeastSquares& problem, double threshold, std::vector<double>& theta) {
  std::size_t const n = problem.points.size() + problem.places.count;
  std::size_t const k = problem.places.count;
  gsl_multifit_nlinear_fdf function{};
  function.f = &LeastSquares::residuals;
  function.df = &LeastSquares::derivatives;
  function.n = n;
  function.p = k;
  function.params = &problem;
  gsl_multifit_nlinear_parameters const parameters = gsl_multifit_nlinear_default_parameters();
  Workspace const workspace(gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &parameters, n, k),
                            &gsl_multifit_nlinear_free);
  GslVector const weights(gsl_vector_alloc(n), &gsl_vector_free);
  gsl_vector_set_all(weights.get(), 1.0);
  constexpr int most_reweightings = 10;
  constexpr std::size_t most_steps = 40;
  constexpr double settled = 1e-5;
  double before = std::numeric_limits<double>::infinity();
  for (int round = 0; round < most_reweightings; ++round) {
    gsl_vector_view const start = gsl_vector_view_array(theta.data(), k);
    if (gsl_multifit_nlinear_winit(&start.vector, weights.get(), &function, workspace.get()) != GSL_SUCCESS)
      return false;
    int info = 0;
    gsl_multifit_nlinear_driver(most_steps, 1e-5, 1e-8, 0.0, nullptr, nullptr, &info, workspace.get());
    gsl_vector const* const found = gsl_multifit_nlinear_position(workspace.get());
    for (std::size_t i = 0; i < k; ++i) {
      theta[i] = gsl_vector_get(found, i);
      if (!std::isfinite(theta[i])) return false;
    }
    double loss = 0.0;
    for (std::size_t i = 0; i < problem.points.size(); ++i) {
      double const r =
          problem.log_law(theta.data(), problem.points[i], nullptr) - problem.points[i].log_error;
      loss += huber(r, threshold);
      gsl_vector_set(weights.get(), i, std::min(1.0, threshold / std::max(std::abs(r), 1e-300)));
    }
    if (!std::isfinite(loss)) return false;
    if (std::abs(before - loss) <= settled * loss) break;
    before = loss;
  }
  return true;
}

SurfaceLaw law_of(LeastSquares const& problem, std::vector<double> const& theta) {
  SurfaceModel const& model = problem.model;
  Places const& at = problem.places;
  SurfaceLaw law;
  law.unit = problem.unit;
  if (model.smoothing) {
    law.smoothing_coefficient = std::exp(theta[at.smoothing]);
    law.smoothing_exponent = std::exp(theta[at.smoothing + 1]);
  }
  if (model.sampling == Sampling::power) {
    law.sampling_coefficient = std::exp(theta[at.sampling]);
    law.sampling_exponent = std::exp(theta[at.sampling + 1]);
  }
  if (model.sampling == Sampling::by_ratio) {
    for (std::size_t k = 0; k < problem.ratios.size(); ++k)
      law.sampling.push_back({problem.ratios[k], std::exp(theta[at.sampling + k])});
    law.sampling_exponent = sampling_slope(law.sampling);
  }
  if (model.spacing) law.spacing_exponent = theta[at.spacing];
  if (model.floor) law.floor = std::exp(theta[at.floor]);
  law.correlation = model.correlation == Correlation::fitted  ? std::tanh(theta[at.correlation])
                    : model.correlation == Correlation::added ? 1.0
                                                              : 0.0;
  return law;
}

/// Starts from which the terms are told apart: the smoothing error is looked for at the largest h, the
/// sampling error at the smallest h/dx (or in each column where it is least).
std::vector<std::vector<double>> starts_of(LeastSquares const& problem) {
  auto const widest = std::max_element(problem.points.begin(), problem.points.end(),
                                       [](LeastSquares::Point const& a, LeastSquares::Point const& b) {
                                         return a.log_ratio + a.log_spacing < b.log_ratio + b.log_spacing;
                                       });
  auto const narrowest = std::min_element(
      problem.points.begin(), problem.points.end(), [](LeastSquares::Point const& a, LeastSquares::Point const& b) {
        return a.log_ratio - 1e-3 * a.log_error < b.log_ratio - 1e-3 * b.log_error;
      });
  std::vector<double> least(problem.ratios.size(), std::numeric_limits<double>::infinity());
  double lowest = std::numeric_limits<double>::infinity();
  for (LeastSquares::Point const& point : problem.points) {
    least[point.column] = std::min(least[point.column], point.log_error);
    lowest = std::min(lowest, point.log_error);
  }
  constexpr double part = -0.5;  // ln of the share of an error that one term is taken to have
  std::vector<std::vector<double>> starts;
  SurfaceModel const& model = problem.model;
  Places const& at = problem.places;
  for (double const p : {1.0, 2.0}) {
    for (double const s : {1.5, 4.0}) {
      for (double const t : {0.0, -0.5, 1.0}) {
        for (double const c : {0.5, -0.5}) {
          if ((!model.smoothing && p != 2.0) || (model.sampling != Sampling::power && s != 4.0) ||
              (!model.spacing && t != 0.0) || (model.correlation != Correlation::fitted && c < 0.0)) {
            continue;
          }
          std::vector<double> theta(at.count, 0.0);
          if (model.smoothing) {
            theta[at.smoothing] = widest->log_error + part - p * (widest->log_ratio + widest->log_spacing);
            theta[at.smoothing + 1] = std::log(p);
          }
          if (model.sampling == Sampling::power) {
            theta[at.sampling] =
                narrowest->log_error + part + s * narrowest->log_ratio - t * narrowest->log_spacing;
            theta[at.sampling + 1] = std::log(s);
          }
          if (model.sampling == Sampling::by_ratio) {
            for (std::size_t k = 0; k < least.size(); ++k) theta[at.sampling + k] = least[k] + part;
          }
          if (model.spacing) theta[at.spacing] = t;
          if (model.floor) theta[at.floor] = lowest + part;
          if (model.correlation == Correlation::fitted) theta[at.correlation] = c;
          starts.push_back(std::move(theta));
        }
      }
    }
  }
  return starts;
}

std::size_t columns_of(std::vector<SurfaceDatum> const& data) {
  std::size_t columns = 0;
  for (SurfaceDatum const& datum : data) columns = std::max(columns, datum.column + 1);
  return columns;
}

/// Median of the absolute values, as a normal deviate's standard deviation.
double scale_of(std::vector<double> residuals) {
  for (double& r : residuals) r = std::abs(r);
  std::nth_element(residuals.begin(), residuals.begin() + static_cast<std::ptrdiff_t>(residuals.size() / 2),
                   residuals.end());
  return 1.4826 * residuals[residuals.size() / 2];
}

}  // namespace

std::optional<SurfaceFit> fit_surface(std::vector<SurfaceDatum> const& data, SurfaceModel const& model,
                                      HuberThreshold threshold, std::vector<double> const& start) {
  LeastSquares problem(data, model, columns_of(data));
  double const n = static_cast<double>(data.size());
  double const k = static_cast<double>(problem.places.count) + 1.0;  // and the scatter
  if (n - k - 1.0 < 2.0) return std::nullopt;
  QuietGsl const quiet;
  std::optional<SurfaceFit> best;
  auto const starts = start.empty() ? starts_of(problem) : std::vector<std::vector<double>>{start};
  for (std::vector<double> theta : starts) {
    problem.hold_to(theta);
    if (!minimise(problem, threshold.value, theta)) continue;
    SurfaceFit fit;
    fit.parameters = theta;
    double sum = 0.0;
    for (LeastSquares::Point const& point : problem.points) {
      double const r = point.log_error - problem.log_law(theta.data(), point, nullptr);
      fit.residuals.push_back(r);
      fit.loss += huber(r, threshold.value);
      sum += r * r;
    }
    fit.misfit = std::sqrt(sum / n);
    if (!std::isfinite(fit.misfit) || (best && fit.loss >= best->loss)) continue;
    best = std::move(fit);
  }
  if (!best) return best;
  best->model = model;
  best->law = law_of(problem, best->parameters);
  best->criterion =
      n * std::log(std::max(best->loss / n, smallest_misfit * smallest_misfit)) + 2.0 * k * n / (n - k - 1.0);
  return best;
}

SurfaceFits fit_surface_models(std::vector<SurfaceDatum> const& data) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  SurfaceFits all;
  double scale = infinite;
  for (SurfaceModel const& model : all_models()) {
    auto fit = fit_surface(data, model, {infinite});
    if (!fit) continue;
    scale = std::min(scale, scale_of(fit->residuals));
    all.fits.push_back(std::move(*fit));
  }
  if (all.fits.empty()) return all;
  all.threshold = {std::max(threshold_in_scales * scale, least_threshold)};
  for (SurfaceFit& fit : all.fits) {
    if (auto robust = fit_surface(data, fit.model, all.threshold, fit.parameters)) fit = std::move(*robust);
  }
  std::stable_sort(all.fits.begin(), all.fits.end(),
                   [](SurfaceFit const& a, SurfaceFit const& b) { return a.criterion < b.criterion; });
  return all;
}

}  // namespace sphverify
