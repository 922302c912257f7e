#pragma once

#include "formulations/density/continuity.hpp"
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
  static constexpr bool wants_radial = true;
  static constexpr int components = info(output_of<Pass>()).components(Dim);
  decltype(zero_of<output_of<Pass>(), Dim>()) sum = zero_of<output_of<Pass>(), Dim>();

  SPHVERIFY_INLINE explicit PassTerm(void const*) {}
  template <class Kernel>
  SPHVERIFY_INLINE void add(auto const& i, auto const& j, Kernel const& W) {
    sum += Pass::pair(i, j, DeclaredKernel<Pass::info.kernel, Kernel>(W));
  }
  SPHVERIFY_INLINE void write(double, double* out) const { add_to(sum, out); }
};

/// Its sum over a row, for the files that only name it: scheme_loops.hpp has the code.
template <class Scheme, std::size_t n, int Dim>
void sum_pass(Row const& row, void const* parameters, double* out);

/// That of its rate, the last.
template <class Scheme, int Dim>
using RateTerm = PassTerm<Scheme, std::tuple_size_v<AllPasses<Scheme>> - 1, Dim>;

/// sum_j m_j W(r_ij, h_i)
template <int Dim, class Kernel>
struct DensityTerm {
  static constexpr FieldSet reads{Field::mass};
  static constexpr bool wants_radial = false;
  static constexpr int components = 1;
  Pack sum = 0.0;

  SPHVERIFY_INLINE explicit DensityTerm(void const*) {}
  SPHVERIFY_INLINE void add(auto const&, auto const& j, auto const& W) {
    sum += j.m() * Kernel::shape(W.distance() * Pack(1.0 / W.own_h()));
  }
  SPHVERIFY_INLINE void write(double h, double* out) const {
    *out += (Pack(Kernel::sigma) * integer_power<Dim>(Pack(1.0 / h)) * Pack(sum.sum())).lanes[0];
  }
};

/// Artificial viscosity by a law: acceleration, heating, largest |mu|.
template <int Dim, class Kernel, class Law>
struct ViscosityTerm {
  static constexpr FieldSet reads{Field::mass, Field::density, Field::velocity, Field::sound_speed};
  static constexpr bool reads_state_velocity = true;
  static constexpr bool has_divisor = true;
  static constexpr bool wants_radial = true;
  static constexpr int components = Dim + 2;
  Law law;
  PackVector<Dim> acceleration{};
  Pack heating = 0.0;
  Pack largest = 0.0;

  SPHVERIFY_INLINE explicit ViscosityTerm(void const* parameters)
      : law(*static_cast<Law const*>(parameters)) {}
  SPHVERIFY_INLINE static Pack mean_rho(auto const& i, auto const& j) {
    return Pack(0.5) * (i.rho() + j.rho());
  }
  SPHVERIFY_INLINE static Pack divisor(auto const& i, auto const& j, auto const& W) {
    return Law::divisor(W.squared_distance(), W.h(), mean_rho(i, j));
  }
  SPHVERIFY_INLINE void add(auto const& i, auto const& j, auto const& W) {
    auto const v_ji = j.u() - i.u();  // as the work has it: one difference serves both
    Pack const h = W.h();
    // Beyond the support nothing rubs; a list may hold pairs that are not near yet.
    Pack const approach =
        select(W.distance() < Pack(Kernel::support_ratio) * h, -v_ji.dot(W.separation()), 0.0);
    auto const [mu, Pi] =
        law.pair(approach, h, Pack(0.5) * (i.c() + j.c()), mean_rho(i, j), W.with_inverse(divisor(i, j, W)));
    auto const push = (j.m() * Pi) * W.gradient();
    acceleration = acceleration - push.eval();
    heating -= Pack(0.5) * v_ji.dot(push);
    largest = max(largest, -mu);
  }
  SPHVERIFY_INLINE void write(double, double* out) const {
    add_to(acceleration, out);
    add_to(heating, out + Dim);
    raise_to(largest, out + Dim + 1);
  }
};

/// Largest rate_of_approach().
template <int Dim, class Kernel>
struct ApproachTerm {
  static constexpr FieldSet reads{Field::velocity};
  static constexpr bool wants_radial = false;
  static constexpr int components = 1;
  Pack largest = 0.0;

  SPHVERIFY_INLINE explicit ApproachTerm(void const*) {}
  SPHVERIFY_INLINE void add(auto const& i, auto const& j, auto const& W) {
    Pack const r = W.distance();
    Pack const rate = rate_of_approach<Dim, Pack>(-((i.u() - j.u()).dot(W.separation())), r * r, W.h());
    largest = max(largest, select(r < Pack(Kernel::support_ratio) * W.h(), rate, 0.0));
  }
  SPHVERIFY_INLINE void write(double, double* out) const { raise_to(largest, out); }
};

/// A term's sum over a row that has been copied.
template <class Term, int Dim>
void sum_row(Row const& row, void const* parameters, double* out) {
  View<Dim, Term::reads, ReadOwn> const i(row.slots, ReadOwn{row.own});
  Term term(parameters);
  for (std::size_t k = 0; k < row.count; k += Pack::size) {
    View<Dim, Term::reads, ReadColumns> const j(row.slots, ReadColumns{row.columns + k});
    term.add(i, j, KernelColumns<Dim>(row, k));
  }
  term.write(row.h, out);
}

/// By which a term is known: its sum over a row.
template <class Term, int Dim>
inline constexpr RowFunction row_sum = sum_row<Term, Dim>;
template <class Scheme, std::size_t n, int Dim>
inline constexpr RowFunction row_sum<PassTerm<Scheme, n, Dim>, Dim> = sum_pass<Scheme, n, Dim>;

}  // namespace sphverify::SPHVERIFY_INSTRUCTION_SET
