// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/integrate/coloured_jacobian.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sphverify {

namespace {
double const root_epsilon = std::sqrt(std::numeric_limits<double>::epsilon());
}  // namespace

ColouredJacobian::ColouredJacobian(DependencyPattern pattern, Rate rate, bool affine, double scale)
    : pattern_(std::move(pattern)), rate_(std::move(rate)), affine_(affine), scale_(scale) {
  values_.resize(pattern_.column.size());
  colour();
}

/// Greedy: each column takes the smallest colour that no column sharing a row with it has.
void ColouredJacobian::colour() {
  std::size_t const n = pattern_.rows();
  std::vector<std::int64_t> first_of_column(n + 1, 0);
  for (std::int64_t const c : pattern_.column) ++first_of_column[c + 1];
  for (std::size_t c = 0; c < n; ++c) first_of_column[c + 1] += first_of_column[c];
  std::vector<std::int64_t> row_of(pattern_.column.size());
  std::vector<std::int64_t> next(first_of_column.begin(), first_of_column.end() - 1);
  for (std::size_t row = 0; row < n; ++row) {
    for (std::int64_t k = pattern_.first[row]; k < pattern_.first[row + 1]; ++k) {
      row_of[next[pattern_.column[k]]++] = static_cast<std::int64_t>(row);
    }
  }

  constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  colour_of_.assign(n, none);
  std::vector<std::size_t> taken_for;  // taken_for[colour] == column: forbidden for it
  for (std::size_t column = 0; column < n; ++column) {
    for (std::int64_t r = first_of_column[column]; r < first_of_column[column + 1]; ++r) {
      for (std::int64_t k = pattern_.first[row_of[r]]; k < pattern_.first[row_of[r] + 1]; ++k) {
        std::uint32_t const other = colour_of_[pattern_.column[k]];
        if (other != none) taken_for[other] = column + 1;
      }
    }
    std::uint32_t chosen = 0;
    while (chosen < taken_for.size() && taken_for[chosen] == column + 1) ++chosen;
    if (chosen == taken_for.size()) taken_for.push_back(0);
    colour_of_[column] = chosen;
  }
  colours_ = taken_for.size();
}

std::vector<double> const& ColouredJacobian::evaluate(double t, double const* y) {
  if (affine_ && known_) return values_;
  std::size_t const n = pattern_.rows();
  std::vector<double> base(n), perturbed(y, y + n), changed(n);
  rate_(t, y, base.data());
  auto const step = [&](std::size_t column) {
    return affine_ ? scale_ : root_epsilon * std::max(std::abs(y[column]), scale_);
  };
  for (std::uint32_t colour = 0; colour < colours_; ++colour) {
    for (std::size_t c = 0; c < n; ++c) perturbed[c] = colour_of_[c] == colour ? y[c] + step(c) : y[c];
    rate_(t, perturbed.data(), changed.data());
    for (std::size_t row = 0; row < n; ++row) {
      for (std::int64_t k = pattern_.first[row]; k < pattern_.first[row + 1]; ++k) {
        std::size_t const c = static_cast<std::size_t>(pattern_.column[k]);
        if (colour_of_[c] == colour) values_[k] = (changed[row] - base[row]) / (perturbed[c] - y[c]);
      }
    }
  }
  known_ = true;
  return values_;
}

double ColouredJacobian::error() const {
  return affine_ ? 16.0 * std::numeric_limits<double>::epsilon() : 4.0 * root_epsilon;
}

std::size_t ColouredJacobian::bytes() const {
  return sizeof(std::int64_t) * (pattern_.first.capacity() + pattern_.column.capacity()) +
         sizeof(std::uint32_t) * colour_of_.capacity() + sizeof(double) * values_.capacity();
}

}  // namespace sphverify
