// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

#include "formulations/kernels/columns.hpp"

namespace sphverify {

/// What lists say of a kernel.
struct KernelInfo {
  std::string_view id, title, source, equation;
  double support_ratio;
};

/// A function of q = r/h that is a polynomial on each of the pieces that make up a kernel's support.
class PiecewisePolynomial {
 public:
  static constexpr std::size_t terms = 16;
  struct Piece {
    double to;  ///< it begins where the one before ends
    double
        origin;  ///< of its powers, chosen so that they cancel little: 0, the middle, or the support's edge
    int degree;
    std::array<double, terms> coefficient;

    /// The value at q = origin + t.
    double at_shift(double t) const {
      double sum = coefficient[static_cast<std::size_t>(degree)];
      for (int n = degree - 1; n >= 0; --n) sum = coefficient[static_cast<std::size_t>(n)] + t * sum;
      return sum;
    }
  };

  PiecewisePolynomial() = default;
  explicit PiecewisePolynomial(std::vector<Piece> pieces) : pieces_(std::move(pieces)) {}

  std::vector<Piece> const& pieces() const { return pieces_; }

  /// Zero beyond the last piece.
  double operator()(double q) const {
    for (Piece const& piece : pieces_) {
      if (q < piece.to) return piece.at_shift(q - piece.origin);
    }
    return 0.0;
  }

 private:
  std::vector<Piece> pieces_;
};

/// A smoothing kernel in some dimension, W(r, h) = sigma/h^Dim w(q) with q = r/h, its integrals over planes,
/// and the moments of its shape w that the integrals over parts of planes are made of. All of them follow
/// from the polynomials that w is made of, by one derivation for every kernel (docs/theory/face-weights.md);
/// each is off by less than 1e-14 of its largest value. Loops over pairs take its columns.
class Kernel {
 public:
  KernelInfo const& info() const { return info_; }
  std::string_view id() const { return info_.id; }
  int dimension() const { return dimension_; }
  double support_ratio() const { return info_.support_ratio; }  ///< support / smoothing length
  double sigma() const { return sigma_; }

  double value(double r, double h) const { return value_(r, h); }    ///< W  [m^-Dim]
  double radial(double r, double h) const { return radial_(r, h); }  ///< (dW/dr)/r  [m^-(Dim+2)]

  /// Integral of W over a plane at distance d >= 0 from its centre, the `exact` face weight.  [1/m]
  double plane_integral(double d, double h) const;

  /// Gamma(d): the part of the kernel on the inner side of a plane at distance d >= 0, between 1/2 and 1. Its
  /// derivative by d is plane_integral.
  double inner_fraction(double d, double h) const;

  KernelColumns const& columns() const { return columns_; }  ///< for this processor

  // From here on lengths are in units of h.

  double shape(double q) const { return shape_(q); }  ///< w

  /// The pieces' ends between 0 and the support: there a derivative of w may jump.
  std::vector<double> const& knots() const { return knots_; }

  /// int_q^R w q' dq', R the support
  double first_moment_beyond(double q) const { return first_moment_(q); }

  /// int_0^R w q^2 dq
  double whole_second_moment() const { return whole_second_moment_; }

  /// -(1/q) int_0^q w q'^2 dq' - int_q^R w q' dq': what is left of the potential of the flux that Gamma is
  /// made of in 3D when its pole `whole_second_moment`/q is taken away.
  double smooth_potential(double q) const {
    if (q < inner_potential_.to) return inner_potential_.at_shift(q - inner_potential_.origin);
    return (second_moment_(q) - whole_second_moment_) / q - first_moment_(q);
  }

  /// Integral of w over part of a line at distance d, between the places from < to along it, both within the
  /// support.
  double line_integral(double d, double from, double to) const;

  /// Integral of w in a plane over what that part of the line hides from the centre: int M(q)/q^2 d ds with M
  /// the first moment beyond q.
  double hidden_by_line(double d, double from, double to) const;

  template <class Definition, int Dim>
  static Kernel of();

 private:
  Kernel() = default;

  KernelInfo info_{};
  KernelColumns columns_{};
  int dimension_ = 0;
  double sigma_ = 0.0;
  double (*value_)(double, double) = nullptr;
  double (*radial_)(double, double) = nullptr;
  double (*shape_)(double) = nullptr;
  std::vector<double> knots_;
  PiecewisePolynomial polynomials_;    ///< w
  PiecewisePolynomial moment_;         ///< int_q^R w dq'
  PiecewisePolynomial first_moment_;   ///< int_q^R w q' dq'
  PiecewisePolynomial second_moment_;  ///< int_q^R w q'^2 dq'
  PiecewisePolynomial twice_;          ///< int_q^R int_q'^R w q'' dq'' dq'
  PiecewisePolynomial::Piece inner_potential_{};
  double whole_second_moment_ = 0.0;
};

/// A kernel in 1, 2 and 3 dimensions. kernel_part<Kernel>() of kernel_of.hpp makes it of a header.
using KernelPart = std::array<Kernel, 3>;

/// Adds a kernel to those of AllKernels, before anything else is asked of them. Throws std::invalid_argument if there is one of that identifier.
void add_kernel(KernelPart const& part);

/// The kernel of an id in 1, 2 or 3 dimensions; it lives as long as the program. Throws std::invalid_argument
/// where there is none.
Kernel const& kernel(std::string_view id, int dimension);

/// What is taken where nothing else is asked for: the cubic spline.
Kernel const& default_kernel(int dimension);

/// Those of AllKernels in its order, then those that were added.
std::vector<KernelInfo> all_kernel_infos();

}  // namespace sphverify
