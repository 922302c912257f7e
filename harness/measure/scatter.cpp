// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/measure/scatter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "harness/measure/error_law.hpp"

namespace sphverify {

namespace {

constexpr double lowest_log_sigma = -11.5;  // 1e-5
constexpr double highest_log_sigma = 0.7;   // 2
constexpr std::size_t grid = 41;
constexpr double log_sigma_step = (highest_log_sigma - lowest_log_sigma) / (grid - 1);
constexpr double lowest_log_rss = -26.0, highest_log_rss = 9.0;
constexpr std::size_t table_size = 141;
constexpr double probability_of_shared = 0.3;

}  // namespace

Scatter::Scatter(std::vector<LevelError> const& levels) {
  double squares = 0.0, degrees = 0.0, replicates = 0.0;
  for (LevelError const& level : levels) {
    squares += level.scatter_squared;
    degrees += level.replicates - 1;
    replicates += level.replicates;
  }
  double const per_level = replicates / static_cast<double>(levels.size());
  for (std::size_t k = 0; k < grid; ++k)
    log_sigma_.push_back(lowest_log_sigma + static_cast<double>(k) * log_sigma_step);
  if (degrees <= 0.0) {
    log_weight_.assign(grid, 0.0);
    return;
  }
  // The replicates' own sigma has the scaled inverse chi-squared distribution; their mean's is it over the
  // root of their number.
  std::vector<double> own;
  double top = -std::numeric_limits<double>::infinity();
  for (double const log_sigma : log_sigma_) {
    double const of_one = log_sigma + 0.5 * std::log(per_level);
    own.push_back(-degrees * of_one - 0.5 * squares * std::exp(-2.0 * of_one));
    top = std::max(top, own.back());
  }
  double total = 0.0;
  for (double& v : own) {
    v = std::exp(v - top);
    total += v;
  }
  std::vector<double> weight(grid, 0.0);
  for (std::size_t k = 0; k < grid; ++k) {
    double const part = own[k] / total;
    weight[k] += (1.0 - probability_of_shared) * part;
    for (std::size_t shared = 0; shared < grid; ++shared) {
      double const both = 0.5 * std::log(std::exp(2.0 * log_sigma_[k]) + std::exp(2.0 * log_sigma_[shared]));
      auto const at = static_cast<std::size_t>(std::clamp(
          std::lround((both - lowest_log_sigma) / log_sigma_step), 0L, static_cast<long>(grid) - 1));
      weight[at] += probability_of_shared * part / grid;
    }
  }
  for (double const w : weight)
    log_weight_.push_back(w > 0.0 ? std::log(w) : -std::numeric_limits<double>::infinity());
}

ScatterMarginal::ScatterMarginal(Scatter const& scatter, double degrees)
    : scatter_(scatter),
      degrees_(degrees),
      lowest_(lowest_log_rss),
      step_((highest_log_rss - lowest_log_rss) / (table_size - 1)) {
  for (std::size_t k = 0; k < table_size; ++k)
    table_.push_back(exactly(std::exp(lowest_ + static_cast<double>(k) * step_)));
}

double ScatterMarginal::exactly(double rss) const {
  double top = -std::numeric_limits<double>::infinity();
  std::vector<double> terms;
  for (std::size_t k = 0; k < scatter_.log_sigma().size(); ++k) {
    double const log_sigma = scatter_.log_sigma()[k];
    terms.push_back(scatter_.log_weight()[k] - degrees_ * log_sigma - 0.5 * rss * std::exp(-2.0 * log_sigma));
    top = std::max(top, terms.back());
  }
  double sum = 0.0;
  for (double const t : terms) sum += std::exp(t - top);
  return top + std::log(sum);
}

double ScatterMarginal::operator()(double rss) const {
  double const place = rss > 0.0 ? (std::log(rss) - lowest_) / step_ : 0.0;
  if (place <= 0.0) return table_.front();
  if (place >= static_cast<double>(table_size - 1)) return exactly(rss);
  auto const k = static_cast<std::size_t>(place);
  double const part = place - static_cast<double>(k);
  return (1.0 - part) * table_[k] + part * table_[k + 1];
}

std::vector<std::pair<double, double>> ScatterMarginal::parts(double rss) const {
  double const whole = exactly(rss);
  std::vector<std::pair<double, double>> parts;
  for (std::size_t k = 0; k < scatter_.log_sigma().size(); ++k) {
    double const log_sigma = scatter_.log_sigma()[k];
    double const part = std::exp(scatter_.log_weight()[k] - degrees_ * log_sigma -
                                 0.5 * rss * std::exp(-2.0 * log_sigma) - whole);
    if (part > 2e-3) parts.emplace_back(std::exp(log_sigma), part);
  }
  return parts;
}

}  // namespace sphverify
