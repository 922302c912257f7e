// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "formulations/basics/tensor_index.hpp"

// Everything that depends on the instruction set lives in a namespace named after it: the linker must never
// take a function that was compiled for one set for another's.
#ifndef SPHVERIFY_INSTRUCTION_SET
#error "only for files that are compiled once per instruction set (generated/*.cpp, list_kernels_*.cpp)"
#endif

// Nothing is inlined by force where sanitizers add checks to every access: functions of a whole sweep would take
// half an hour to compile.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SPHVERIFY_FORCE_INLINE
#else
#define SPHVERIFY_FORCE_INLINE __attribute__((always_inline))
#endif
#define SPHVERIFY_INLINE SPHVERIFY_FORCE_INLINE inline

namespace sphverify::SPHVERIFY_INSTRUCTION_SET {

/// Four numbers on which a scheme's formula works at once, lane by lane. Four serve every machine: one
/// register with AVX2, two with SSE2 or NEON.
struct Pack {
  typedef double Lanes __attribute__((vector_size(32)));
  typedef std::int64_t Mask __attribute__((vector_size(32)));
  static constexpr std::size_t size = 4;

  Lanes lanes;

  Pack() = default;
  SPHVERIFY_INLINE Pack(double all) : lanes{all, all, all, all} {}
  SPHVERIFY_INLINE Pack(Lanes l) : lanes(l) {}

  /// Expects 32-byte alignment.
  SPHVERIFY_INLINE static Pack load(double const* from) { return *reinterpret_cast<Lanes const*>(from); }
  SPHVERIFY_INLINE void store(double* to) const { *reinterpret_cast<Lanes*>(to) = lanes; }

  SPHVERIFY_INLINE friend Pack operator+(Pack a, Pack b) { return a.lanes + b.lanes; }
  SPHVERIFY_INLINE friend Pack operator-(Pack a, Pack b) { return a.lanes - b.lanes; }
  SPHVERIFY_INLINE friend Pack operator*(Pack a, Pack b) { return a.lanes * b.lanes; }
  SPHVERIFY_INLINE friend Pack operator/(Pack a, Pack b) { return a.lanes / b.lanes; }
  SPHVERIFY_INLINE friend Pack operator-(Pack a) { return -a.lanes; }
  SPHVERIFY_INLINE Pack& operator+=(Pack b) {
    lanes += b.lanes;
    return *this;
  }
  SPHVERIFY_INLINE Pack& operator-=(Pack b) {
    lanes -= b.lanes;
    return *this;
  }

  SPHVERIFY_INLINE friend Mask operator<(Pack a, Pack b) { return a.lanes < b.lanes; }
  SPHVERIFY_INLINE friend Mask operator<=(Pack a, Pack b) { return a.lanes <= b.lanes; }
  SPHVERIFY_INLINE friend Mask operator>(Pack a, Pack b) { return a.lanes > b.lanes; }
  SPHVERIFY_INLINE friend Mask operator>=(Pack a, Pack b) { return a.lanes >= b.lanes; }
  SPHVERIFY_INLINE friend Mask operator==(Pack a, Pack b) { return a.lanes == b.lanes; }
  SPHVERIFY_INLINE friend Mask operator!=(Pack a, Pack b) { return a.lanes != b.lanes; }
  SPHVERIFY_INLINE friend Pack select(Mask mask, Pack yes, Pack no) { return mask ? yes.lanes : no.lanes; }
  SPHVERIFY_INLINE friend Pack min(Pack a, Pack b) { return select(a < b, a, b); }
  SPHVERIFY_INLINE friend Pack max(Pack a, Pack b) { return select(a < b, b, a); }
  SPHVERIFY_INLINE friend Pack sqrt(Pack a) {
    return Lanes{__builtin_sqrt(a.lanes[0]), __builtin_sqrt(a.lanes[1]), __builtin_sqrt(a.lanes[2]),
                 __builtin_sqrt(a.lanes[3])};
  }
  SPHVERIFY_INLINE friend Pack abs(Pack a) { return max(a, -a); }

  // Lane by lane through the C library: as accurate as it is, and as slow.
  SPHVERIFY_INLINE friend Pack exp(Pack a) { return each(a, [](double x) { return __builtin_exp(x); }); }
  SPHVERIFY_INLINE friend Pack log(Pack a) { return each(a, [](double x) { return __builtin_log(x); }); }
  SPHVERIFY_INLINE friend Pack cbrt(Pack a) { return each(a, [](double x) { return __builtin_cbrt(x); }); }
  SPHVERIFY_INLINE friend Pack tanh(Pack a) { return each(a, [](double x) { return __builtin_tanh(x); }); }
  SPHVERIFY_INLINE friend Pack pow(Pack a, Pack b) {
    return Lanes{__builtin_pow(a.lanes[0], b.lanes[0]), __builtin_pow(a.lanes[1], b.lanes[1]),
                 __builtin_pow(a.lanes[2], b.lanes[2]), __builtin_pow(a.lanes[3], b.lanes[3])};
  }

  /// To the nearest whole number; expects magnitudes below 2^51.
  SPHVERIFY_INLINE friend Pack nearest_integer(Pack a) {
    Pack const shift = 0x1.8p52;
    return (a + shift) - shift;
  }

  SPHVERIFY_INLINE double sum() const { return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]); }
  SPHVERIFY_INLINE double largest() const {
    double const a = lanes[0] < lanes[1] ? lanes[1] : lanes[0];
    double const b = lanes[2] < lanes[3] ? lanes[3] : lanes[2];
    return a < b ? b : a;
  }

 private:
  SPHVERIFY_INLINE static Pack each(Pack a, double (*function)(double)) {
    return Lanes{function(a.lanes[0]), function(a.lanes[1]), function(a.lanes[2]), function(a.lanes[3])};
  }
};

/// Four numbers that formulas like to divide by, with their inverses: a quotient becomes a product.
struct Divisor {
  Pack value, inverse;

  SPHVERIFY_INLINE operator Pack() const { return value; }
  SPHVERIFY_INLINE friend Divisor operator*(Divisor a, Divisor b) {
    return {a.value * b.value, a.inverse * b.inverse};
  }
  SPHVERIFY_INLINE friend Pack operator/(Pack a, Divisor b) { return a * b.inverse; }
  SPHVERIFY_INLINE friend Pack operator/(Divisor a, Pack b) { return a.value / b; }
  SPHVERIFY_INLINE friend Pack operator/(Divisor a, Divisor b) { return a.value * b.inverse; }
  SPHVERIFY_INLINE friend Pack operator*(Pack a, Divisor b) { return a * b.value; }
  SPHVERIFY_INLINE friend Pack operator*(Divisor a, Pack b) { return a.value * b; }
  SPHVERIFY_INLINE friend Pack operator-(Divisor a) { return -a.value; }
  SPHVERIFY_INLINE friend Pack sqrt(Divisor a) { return sqrt(a.value); }
  SPHVERIFY_INLINE friend Pack abs(Divisor a) { return abs(a.value); }
  SPHVERIFY_INLINE friend Pack exp(Divisor a) { return exp(a.value); }
  SPHVERIFY_INLINE friend Pack log(Divisor a) { return log(a.value); }
  SPHVERIFY_INLINE friend Pack cbrt(Divisor a) { return cbrt(a.value); }
  SPHVERIFY_INLINE friend Pack tanh(Divisor a) { return tanh(a.value); }
};

/// Where one of two is a divisor, and the other that, a pack or a number, the rest is that of packs.
template <class A, class B>
concept OneIsADivisor = (std::is_same_v<A, Divisor> || std::is_same_v<B, Divisor>) && std::is_convertible_v<A, Pack> &&
                        std::is_convertible_v<B, Pack>;
#define SPHVERIFY_WITH_DIVISORS(operation)                                 \
  template <class A, class B>                                              \
    requires OneIsADivisor<A, B>                                           \
  SPHVERIFY_INLINE auto operator operation(A a, B b) {                     \
    return static_cast<Pack>(a) operation static_cast<Pack>(b);            \
  }
SPHVERIFY_WITH_DIVISORS(+)
SPHVERIFY_WITH_DIVISORS(-)
SPHVERIFY_WITH_DIVISORS(<)
SPHVERIFY_WITH_DIVISORS(<=)
SPHVERIFY_WITH_DIVISORS(>)
SPHVERIFY_WITH_DIVISORS(>=)
SPHVERIFY_WITH_DIVISORS(==)
SPHVERIFY_WITH_DIVISORS(!=)
#undef SPHVERIFY_WITH_DIVISORS
#define SPHVERIFY_WITH_DIVISORS(function)                                  \
  template <class A, class B>                                              \
    requires OneIsADivisor<A, B>                                           \
  SPHVERIFY_INLINE Pack function(A a, B b) {                               \
    return function(static_cast<Pack>(a), static_cast<Pack>(b));           \
  }
SPHVERIFY_WITH_DIVISORS(min)
SPHVERIFY_WITH_DIVISORS(max)
SPHVERIFY_WITH_DIVISORS(pow)
#undef SPHVERIFY_WITH_DIVISORS
template <class A, class B>
  requires OneIsADivisor<A, B>
SPHVERIFY_INLINE Pack select(Pack::Mask mask, A yes, B no) {
  return select(mask, static_cast<Pack>(yes), static_cast<Pack>(no));
}

/// x^n
template <int n>
SPHVERIFY_INLINE Pack integer_power(Pack x) {
  if constexpr (n == 1) {
    return x;
  } else {
    return x * integer_power<n - 1>(x);
  }
}

template <int Dim>
struct RadialVector;

/// Four vectors. Has of Eigen's interface what the schemes use.
template <int Dim>
struct PackVector {
  Pack component[Dim];

  SPHVERIFY_INLINE PackVector eval() const { return *this; }
  SPHVERIFY_INLINE Pack dot(PackVector const& b) const {
    Pack sum = component[0] * b.component[0];
    for (int k = 1; k < Dim; ++k) sum += component[k] * b.component[k];
    return sum;
  }
  Pack dot(RadialVector<Dim> const& b) const;
  SPHVERIFY_INLINE Pack squaredNorm() const { return dot(*this); }

  SPHVERIFY_INLINE friend PackVector operator+(PackVector a, PackVector const& b) {
    for (int k = 0; k < Dim; ++k) a.component[k] += b.component[k];
    return a;
  }
  SPHVERIFY_INLINE friend PackVector operator-(PackVector a, PackVector const& b) {
    for (int k = 0; k < Dim; ++k) a.component[k] -= b.component[k];
    return a;
  }
  SPHVERIFY_INLINE friend PackVector operator*(Pack s, PackVector a) {
    for (int k = 0; k < Dim; ++k) a.component[k] = s * a.component[k];
    return a;
  }
  SPHVERIFY_INLINE friend PackVector operator/(PackVector a, Divisor s) { return s.inverse * a; }
  SPHVERIFY_INLINE friend PackVector operator/(PackVector a, Pack s) { return (Pack(1.0) / s) * a; }
  SPHVERIFY_INLINE friend PackVector operator*(PackVector a, Pack s) { return s * a; }
  SPHVERIFY_INLINE friend PackVector operator-(PackVector a) { return Pack(-1.0) * a; }
  SPHVERIFY_INLINE PackVector& operator+=(PackVector const& b) { return *this = *this + b; }
};

/// Four vectors along four others: `along` times `r`, multiplied out as late as can be. All that a row sums
/// points along r_ij, and v.r_ij is then one number that every term of a sweep shares.
template <int Dim>
struct RadialVector {
  Pack along;
  PackVector<Dim> r;

  SPHVERIFY_INLINE PackVector<Dim> eval() const { return along * r; }
  SPHVERIFY_INLINE operator PackVector<Dim>() const { return eval(); }
  SPHVERIFY_INLINE Pack dot(PackVector<Dim> const& b) const { return b.dot(*this); }
  SPHVERIFY_INLINE friend RadialVector operator*(Pack s, RadialVector a) { return {s * a.along, a.r}; }
  SPHVERIFY_INLINE friend RadialVector operator*(RadialVector a, Pack s) { return s * a; }
  SPHVERIFY_INLINE friend RadialVector operator-(RadialVector a) { return {-a.along, a.r}; }
  SPHVERIFY_INLINE friend PackVector<Dim> operator+(RadialVector a, RadialVector b) { return a.eval() + b.eval(); }
  SPHVERIFY_INLINE friend PackVector<Dim> operator-(RadialVector a, RadialVector b) { return a.eval() - b.eval(); }
};
template <int Dim>
SPHVERIFY_INLINE Pack PackVector<Dim>::dot(RadialVector<Dim> const& b) const {
  return b.along * dot(b.r);
}

/// Four symmetric tensors, by their different elements (tensor_index).
template <int Dim>
struct PackTensor {
  static constexpr int components = Dim * (Dim + 1) / 2;
  Pack element[components];

  SPHVERIFY_INLINE Pack operator()(int k, int l) const { return element[tensor_index(k, l)]; }
  SPHVERIFY_INLINE PackTensor eval() const { return *this; }
  SPHVERIFY_INLINE Pack trace() const {
    Pack sum = element[0];
    for (int k = 1; k < Dim; ++k) sum += (*this)(k, k);
    return sum;
  }
  SPHVERIFY_INLINE friend PackTensor operator+(PackTensor a, PackTensor const& b) {
    for (int n = 0; n < components; ++n) a.element[n] += b.element[n];
    return a;
  }
  SPHVERIFY_INLINE friend PackTensor operator-(PackTensor a, PackTensor const& b) {
    for (int n = 0; n < components; ++n) a.element[n] -= b.element[n];
    return a;
  }
  SPHVERIFY_INLINE friend PackTensor operator*(Pack s, PackTensor a) {
    for (int n = 0; n < components; ++n) a.element[n] = s * a.element[n];
    return a;
  }
  SPHVERIFY_INLINE friend PackTensor operator*(PackTensor a, Pack s) { return s * a; }
  SPHVERIFY_INLINE friend PackTensor operator-(PackTensor a) { return Pack(-1.0) * a; }
  SPHVERIFY_INLINE friend PackVector<Dim> operator*(PackTensor const& a, PackVector<Dim> const& v) {
    PackVector<Dim> product;
    for (int k = 0; k < Dim; ++k) {
      product.component[k] = a(k, 0) * v.component[0];
      for (int l = 1; l < Dim; ++l) product.component[k] += a(k, l) * v.component[l];
    }
    return product;
  }
  SPHVERIFY_INLINE friend PackVector<Dim> operator*(PackTensor const& a, RadialVector<Dim> const& v) {
    return v.along * (a * v.r);
  }
  SPHVERIFY_INLINE PackTensor& operator+=(PackTensor const& b) { return *this = *this + b; }
};

/// a b^T of two vectors along each other, which is symmetric.
template <int Dim>
SPHVERIFY_INLINE PackTensor<Dim> outer(PackVector<Dim> const& a, PackVector<Dim> const& b) {
  PackTensor<Dim> product;
  for (int l = 0; l < Dim; ++l)
    for (int k = 0; k <= l; ++k) product.element[tensor_index(k, l)] = a.component[k] * b.component[l];
  return product;
}
template <int Dim>
SPHVERIFY_INLINE PackTensor<Dim> outer(PackVector<Dim> const& a, RadialVector<Dim> const& b) {
  return b.along * outer(a, b.r);
}

template <int Dim>
SPHVERIFY_INLINE PackTensor<Dim> outer(RadialVector<Dim> const& a, PackVector<Dim> const& b) {
  return a.along * outer(a.r, b);
}
template <int Dim>
SPHVERIFY_INLINE PackTensor<Dim> outer(RadialVector<Dim> const& a, RadialVector<Dim> const& b) {
  return a.along * outer(a.r, b);
}

}  // namespace sphverify::SPHVERIFY_INSTRUCTION_SET
