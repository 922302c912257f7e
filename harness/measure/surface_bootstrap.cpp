// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/measure/surface_bootstrap.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>

namespace sphverify {

namespace {

constexpr int draws = 200;
constexpr double tail = 0.025;
constexpr double enough = 0.9;
constexpr std::uint64_t seed = 20151;

/// The residuals of a fit as what those of a row have in common, those of a column, and each one's own: the
/// components of variance of a two-way layout. Rows and columns are few, and how far they scatter is known
/// badly: they are drawn from Student's distribution. Of the rest there are enough to draw from themselves.
class Residuals {
 public:
  Residuals(std::vector<SurfaceDatum> const& data, SurfaceFit const& fit)
      : data_(data), rest_(fit.residuals) {
    std::vector<double> const rows = take_means(&SurfaceDatum::row);
    std::vector<double> const columns = take_means(&SurfaceDatum::column);
    double const n = static_cast<double>(data.size());
    double const i = static_cast<double>(rows.size());
    double const j = static_cast<double>(columns.size());
    double const own = squares(rest_) / std::max(n - i - j + 1.0, 1.0);
    // What the fit took: from the rows a level, a slope and where t is fitted one more of the other term;
    // from the columns a level and two slopes, or all that they have in common.
    double const used_by_rows = fit.law.spacing_exponent != 0.0 ? 3.0 : 2.0;
    rows_ = component(rows, used_by_rows, own / j);
    if (fit.law.sampling.empty()) columns_ = component(columns, 3.0, own / i);
    double const widened = std::sqrt(own / std::max(squares(rest_) / n, std::numeric_limits<double>::min()));
    for (double& r : rest_) r *= widened;
  }

  /// One draw, by datum. Not by the library's distributions, which differ between libraries.
  std::vector<double> draw(std::mt19937_64& random) const {
    std::vector<double> of_rows, of_columns, all;
    for (SurfaceDatum const& datum : data_) {
      while (of_rows.size() <= datum.row) of_rows.push_back(rows_.draw(random));
      while (of_columns.size() <= datum.column) of_columns.push_back(columns_.draw(random));
    }
    for (SurfaceDatum const& datum : data_) {
      double const own = rest_[random() % rest_.size()];
      all.push_back(of_rows[datum.row] + of_columns[datum.column] + (random() >> 63 == 0 ? own : -own));
    }
    return all;
  }

 private:
  struct Component {
    double scale = 0.0, degrees = 1.0;

    double draw(std::mt19937_64& random) const {
      double const part = (static_cast<double>(random() >> 11) + 0.5) * 0x1p-53;
      constexpr double farthest = 12.7;  // 97.5% of one degree of freedom
      return scale * std::clamp(gsl_cdf_tdist_Pinv(part, degrees), -farthest, farthest);
    }
  };

  static double squares(std::vector<double> const& values) {
    double sum = 0.0;
    for (double const value : values) sum += value * value;
    return sum;
  }

  /// @param used degrees of freedom that the fit took
  /// @param noise variance of a mean by what its members scatter
  static Component component(std::vector<double> const& means, double used, double noise) {
    double const degrees = std::max(static_cast<double>(means.size()) - used, 1.0);
    return {std::sqrt(std::max(squares(means) / degrees - noise, 0.0)), degrees};
  }

  std::vector<double> take_means(std::size_t SurfaceDatum::*place) {
    std::vector<double> means, counts;
    for (std::size_t k = 0; k < data_.size(); ++k) {
      std::size_t const at = data_[k].*place;
      means.resize(std::max(means.size(), at + 1), 0.0);
      counts.resize(means.size(), 0.0);
      means[at] += rest_[k];
      counts[at] += 1.0;
    }
    for (std::size_t k = 0; k < means.size(); ++k) means[k] /= std::max(counts[k], 1.0);
    for (std::size_t k = 0; k < data_.size(); ++k) rest_[k] -= means[data_[k].*place];
    return means;
  }

  std::vector<SurfaceDatum> const& data_;
  std::vector<double> rest_;
  Component rows_, columns_;
};

/// The ratios of a grid are a sample of all, and a power through sampling errors that oscillate depends on
/// it.
void redraw_slope(SurfaceLaw& law, std::mt19937_64& random) {
  std::size_t const n = law.sampling.size();
  std::vector<SamplingAtRatio> sample;
  for (std::size_t k = 0; k < n; ++k) sample.push_back(law.sampling[random() % n]);
  if (double const slope = sampling_slope(sample); slope != 0.0) law.sampling_exponent = slope;
}

}  // namespace

SurfaceBootstrap::SurfaceBootstrap(std::vector<SurfaceDatum> const& data,
                                   std::vector<SurfaceFit> const& rivals, HuberThreshold threshold,
                                   std::function<Answers(SurfaceLaw const&)> const& answer) {
  SurfaceFit const& best = rivals.front();
  answers_ = answer(best.law);
  Residuals const residuals(data, best);
  std::mt19937_64 random(seed);
  std::vector<SurfaceDatum> drawn = data;
  for (int k = 0; k < draws; ++k) {
    std::vector<double> const errors = residuals.draw(random);
    for (std::size_t i = 0; i < data.size(); ++i)
      drawn[i].error = data[i].error * std::exp(errors[i] - best.residuals[i]);
    std::optional<SurfaceFit> winner;
    for (SurfaceFit const& rival : rivals) {
      auto fit = fit_surface(drawn, rival.model, threshold, rival.parameters);
      if (fit && (!winner || fit->criterion < winner->criterion)) winner = std::move(fit);
    }
    if (!winner) continue;
    redraw_slope(winner->law, random);
    for (auto const& [name, value] : answer(winner->law)) draws_[name].push_back(value);
  }
  for (auto& [name, values] : draws_) std::sort(values.begin(), values.end());
}

Estimate SurfaceBootstrap::estimate(std::string const& name) const {
  Estimate estimate;
  auto const known = answers_.find(name);
  if (known == answers_.end()) return estimate;
  estimate.value = known->second;
  auto const found = draws_.find(name);
  if (found == draws_.end() || static_cast<double>(found->second.size()) < enough * draws) return estimate;
  std::vector<double> const& values = found->second;
  auto const cut = static_cast<std::size_t>(tail * static_cast<double>(values.size()));
  estimate.lower = std::min(values[cut], *estimate.value);
  estimate.upper = std::max(values[values.size() - 1 - cut], *estimate.value);
  return estimate;
}

}  // namespace sphverify
