// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/sweep/approach.hpp"
#include "formulations/scheme.hpp"
#include "formulations/sweep/views.hpp"
#include "formulations/viscosity/monaghan.hpp"
#include "formulations/viscosity/riemann.hpp"

// What a sweep adds up over a row, four neighbours at a time. Each says what it reads, takes its parameters,
// adds, and writes what it has.
namespace sphverify::SPHVERIFY_INSTRUCTION_SET {

/// Adds up a term's lanes.
SPHVERIFY_INLINE void add_to(Pack sum, double* out) { *out += sum.sum(); }
template <int Dim>
SPHVERIFY_INLINE void add_to(PackVector<Dim> const& sum, double* out) {
  for (int k = 0; k < Dim; ++k) out[k] += sum.component[k].sum();
}
template <int Dim>
SPHVERIFY_INLINE void add_to(PackTensor<Dim> const& sum, double* out) {
  for (int n = 0; n < PackTensor<Dim>::components; ++n) out[n] += sum.element[n].sum();
}
SPHVERIFY_INLINE void raise_to(Pack largest, double* out) {
  double const most = largest.largest();
  *out = *out < most ? most : *out;
}

/// What the pairs of a field are summed in, from zero.
template <Field field, int Dim>
constexpr auto zero_of() {
  if constexpr (info(field).is_tensor) {
    return PackTensor<Dim>{};
  } else if constexpr (info(field).is_vector) {
    return PackVector<Dim>{};
  } else {
    return Pack(0.0);
  }
}

/// The pairs of pass n of a scheme.
template <class Scheme, std::size_t n, int Dim>
struct PassTerm {
  using Pass = std::tuple_element_t<n, AllPasses<Scheme>>;
  static constexpr FieldSet reads = reads_of_pass<Scheme, n>();
  static constexpr int components = info(output_of<Pass>()).components(Dim);
  decltype(zero_of<output_of<Pass>(), Dim>()) sum = zero_of<output_of<Pass>(), Dim>();

  SPHVERIFY_INLINE explicit PassTerm(void const*) {}
  template <class Kernel>
  SPHVERIFY_INLINE void add(auto const& i, auto const& j, Kernel const& W) {
    sum += Pass::pair(i, j, DeclaredKernel<Pass::info.kernel, Kernel>(W));
  }
  SPHVERIFY_INLINE void write(double* out) const { add_to(sum, out); }
};

/// That of its rate, the last.
template <class Scheme, int Dim>
using RateTerm = PassTerm<Scheme, std::tuple_size_v<AllPasses<Scheme>> - 1, Dim>;

/// sum_j m_j W_ij
template <int Dim>
struct DensityTerm {
  static constexpr FieldSet reads{Field::mass};
  static constexpr int components = 1;
  Pack sum = 0.0;

  SPHVERIFY_INLINE explicit DensityTerm(void const*) {}
  SPHVERIFY_INLINE void add(auto const&, auto const& j, auto const& W) { sum += j.m() * W.value(); }
  SPHVERIFY_INLINE void write(double* out) const { add_to(sum, out); }
};

/// Artificial viscosity by a law: acceleration, heating, largest |mu|.
template <int Dim, class Law>
struct ViscosityTerm {
  static constexpr FieldSet reads{Field::mass, Field::density, Field::velocity, Field::sound_speed};
  static constexpr bool reads_state_velocity = true;
  static constexpr int components = Dim + 2;
  Law law;
  PackVector<Dim> acceleration{};
  Pack heating = 0.0;
  Pack largest = 0.0;

  SPHVERIFY_INLINE explicit ViscosityTerm(void const* parameters) : law(*static_cast<Law const*>(parameters)) {}
  SPHVERIFY_INLINE void add(auto const& i, auto const& j, auto const& W) {
    auto const v_ji = j.u() - i.u();  // as the work has it: one difference serves both
    Pack const h = W.h();
    Pack const rho = Pack(0.5) * (i.rho() + j.rho());
    Pack const approach = W.where_near(-v_ji.dot(W.separation()));  // beyond the support nothing rubs
    auto const [mu, Pi] =
        law.pair(approach, h, Pack(0.5) * (i.c() + j.c()), rho, inverted(Law::divisor(W.squared_distance(), h, rho)));
    auto const push = (j.m() * Pi) * W.gradient();
    acceleration = acceleration - push.eval();
    heating -= Pack(0.5) * v_ji.dot(push);
    largest = max(largest, -mu);
  }
  SPHVERIFY_INLINE void write(double* out) const {
    add_to(acceleration, out);
    add_to(heating, out + Dim);
    raise_to(largest, out + Dim + 1);
  }

 private:
  SPHVERIFY_INLINE static Divisor inverted(Pack divisor) { return {divisor, Pack(1.0) / divisor}; }
};

/// Largest rate_of_approach().
template <int Dim>
struct ApproachTerm {
  static constexpr FieldSet reads{Field::velocity};
  static constexpr bool reads_state_velocity = true;
  static constexpr int components = 1;
  Pack largest = 0.0;

  SPHVERIFY_INLINE explicit ApproachTerm(void const*) {}
  SPHVERIFY_INLINE void add(auto const& i, auto const& j, auto const& W) {
    Pack const r = W.distance();
    Pack const rate = rate_of_approach<Dim, Pack>(-((i.u() - j.u()).dot(W.separation())), r * r, W.h());
    largest = max(largest, W.where_near(rate));
  }
  SPHVERIFY_INLINE void write(double* out) const { raise_to(largest, out); }
};

}  // namespace sphverify::SPHVERIFY_INSTRUCTION_SET
