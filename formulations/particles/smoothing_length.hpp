// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <vector>

#include "formulations/particles/particles.hpp"

namespace sphverify {

/// The smoothing length of particles and pairs, one for all or each particle's own, with the kernel that it
/// is of. A pair takes the mean of its two, h_ij = (h_i + h_j)/2, so that W_ij = W_ji and grad_i W_ij =
/// -grad_j W_ij: what the symmetric forms conserve between particles they conserve with either choice. A
/// summed density gathers with h_i instead, which its h_i can be solved for. Where h varies the work of these
/// forms is not the derivative of that density; forms that take either particle's own h (KernelWeight::own_gradients)
/// have terms in grad h.  [m]
class SmoothingLength {
 public:
  SmoothingLength(double uniform, Kernel const& kernel) : uniform_(uniform), kernel_(&kernel) {}
  template <int Dim>
  explicit SmoothingLength(Particles<Dim> const& particles)
      : uniform_(particles.smoothing_length()),
        kernel_(&particles.kernel()),
        each_(particles.smoothing_lengths().empty() ? nullptr : &particles.smoothing_lengths()) {}

  double operator()(std::size_t i) const { return each_ ? (*each_)[i] : uniform_; }
  double operator()(std::size_t i, std::size_t j) const {
    return each_ ? 0.5 * ((*each_)[i] + (*each_)[j]) : uniform_;
  }
  bool is_uniform() const { return each_ == nullptr; }
  Kernel const& kernel() const { return *kernel_; }
  double support(std::size_t i) const { return kernel_->support_ratio() * (*this)(i); }
  double support(std::size_t i, std::size_t j) const { return kernel_->support_ratio() * (*this)(i, j); }
  double largest() const { return each_ ? *std::max_element(each_->begin(), each_->end()) : uniform_; }

 private:
  double uniform_;
  Kernel const* kernel_;
  std::vector<double> const* each_ = nullptr;
};

}  // namespace sphverify
