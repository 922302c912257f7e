// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/scheme.hpp"
#include "formulations/simd/pack.hpp"
#include "formulations/sweep/sweep.hpp"

namespace sphverify::SPHVERIFY_INSTRUCTION_SET {

/// Reads of one particle what the schemes call by the paper's symbols. What a scheme does not declare among its `reads` does
/// not compile.
template <int Dim, FieldSet reads, class Read>
class View {
 public:
  SPHVERIFY_INLINE View(RecordSlots const& slots, Read const& read) : slots_(slots), read_(read) {}

  SPHVERIFY_INLINE Pack m() const
    requires(reads.contains(Field::mass))
  {
    return read_(slots_.m);
  }
  SPHVERIFY_INLINE Divisor rho() const
    requires(reads.contains(Field::density))
  {
    return {read_(slots_.rho), read_(slots_.per_rho)};
  }
  SPHVERIFY_INLINE Pack P() const
    requires(reads.contains(Field::pressure))
  {
    return read_(slots_.P);
  }
  SPHVERIFY_INLINE Pack T() const
    requires(reads.contains(Field::temperature))
  {
    return read_(slots_.T);
  }
  SPHVERIFY_INLINE Pack K() const
    requires(reads.contains(Field::conductivity))
  {
    return read_(slots_.K);
  }
  SPHVERIFY_INLINE Pack c() const
    requires(reads.contains(Field::sound_speed))
  {
    return read_(slots_.c);
  }
  SPHVERIFY_INLINE PackVector<Dim> v() const
    requires(reads.contains(Field::velocity))
  {
    return vector(slots_.v);
  }
  SPHVERIFY_INLINE PackVector<Dim> u() const
    requires(reads.contains(Field::velocity))
  {
    return vector(slots_.u);
  }
  SPHVERIFY_INLINE PackVector<Dim> F() const
    requires(reads.contains(Field::flux))
  {
    return vector(slots_.F);
  }
  SPHVERIFY_INLINE Pack Omega() const
    requires(reads.contains(Field::omega))
  {
    return read_(slots_.omega);
  }
  SPHVERIFY_INLINE Pack pass_number() const
    requires(reads.contains(Field::pass_number))
  {
    return read_(slots_.pass_number);
  }
  SPHVERIFY_INLINE Pack pass_number_2() const
    requires(reads.contains(Field::pass_number_2))
  {
    return read_(slots_.pass_number_2);
  }
  SPHVERIFY_INLINE PackVector<Dim> pass_vector() const
    requires(reads.contains(Field::pass_vector))
  {
    return vector(slots_.pass_vector);
  }
  SPHVERIFY_INLINE PackTensor<Dim> pass_tensor() const
    requires(reads.contains(Field::pass_tensor))
  {
    PackTensor<Dim> value;
    for (int n = 0; n < PackTensor<Dim>::components; ++n) value.element[n] = read_(slots_.pass_tensor + n);
    return value;
  }

 private:
  SPHVERIFY_INLINE PackVector<Dim> vector(int slot) const {
    PackVector<Dim> value;
    for (int k = 0; k < Dim; ++k) value.component[k] = read_(slot + k);
    return value;
  }

  RecordSlots const& slots_;
  Read read_;
};

/// A row's own particle, in all lanes.
struct ReadOwn {
  double const* own;
  SPHVERIFY_INLINE Pack operator()(int slot) const { return own[slot]; }
};

/// The records of four neighbours of a batch.
struct FourRecords {
  double const* record[Pack::size];
  SPHVERIFY_INLINE FourRecords(Batch const& batch, std::size_t k) {
    for (std::size_t l = 0; l < Pack::size; ++l) record[l] = batch.records + batch.neighbour[k + l] * batch.stride;
  }
};

/// Four neighbours, read where their records lie.
struct ReadRecords {
  FourRecords four;
  SPHVERIFY_INLINE Pack operator()(int slot) const {
    return Pack::Lanes{four.record[0][slot], four.record[1][slot], four.record[2][slot], four.record[3][slot]};
  }
};

/// Four neighbours in registers.
struct ReadRegisters {
  Pack const* columns;
  SPHVERIFY_INLINE Pack operator()(int slot) const { return columns[slot]; }
};

/// The kernel between a row's particle and its neighbours k to k + 3 of a batch.
template <int Dim>
class KernelOfPairs {
 public:
  SPHVERIFY_INLINE KernelOfPairs(Batch const& batch, std::size_t k) : batch_(batch), k_(k) {}

  SPHVERIFY_INLINE Pack radial() const { return Pack::load(batch_.radial + k_); }  ///< (r_ij . grad_i W_ij)/r_ij^2
  SPHVERIFY_INLINE Pack value() const { return Pack::load(batch_.value + k_); }  ///< W_ij
  SPHVERIFY_INLINE Pack distance() const { return Pack::load(batch_.distance + k_); }  ///< r_ij
  SPHVERIFY_INLINE Pack squared_distance() const { return distance() * distance(); }
  SPHVERIFY_INLINE PackVector<Dim> separation() const { return vector(batch_.separation); }  ///< r_i - r_j
  SPHVERIFY_INLINE RadialVector<Dim> gradient() const { return {radial(), separation()}; }  ///< grad_i W_ij
  SPHVERIFY_INLINE PackVector<Dim> offset() const { return vector(batch_.offset); }  ///< from (r_i + r_j)/2 to the centroid of their face
  SPHVERIFY_INLINE RadialVector<Dim> gradient_i() const {  ///< grad_i W(r_ij, h_i)
    return {Pack::load(batch_.radial_i + k_), separation()};
  }
  SPHVERIFY_INLINE RadialVector<Dim> gradient_j() const {  ///< grad_i W(r_ij, h_j)
    return {Pack::load(batch_.radial_j + k_), separation()};
  }
  SPHVERIFY_INLINE Pack h() const {  ///< of the pair
    if (batch_.pair_h == nullptr) return batch_.h;
    return Pack::load(batch_.pair_h + k_);
  }
  /// `x` where the two are within the support, else 0: a list may hold pairs that are not near yet.
  SPHVERIFY_INLINE Pack where_near(Pack x) const { return select(distance() < Pack(batch_.support_ratio) * h(), x, 0.0); }

 private:
  SPHVERIFY_INLINE PackVector<Dim> vector(double const* columns) const {
    PackVector<Dim> value;
    for (std::size_t n = 0; n < Dim; ++n) value.component[n] = Pack::load(columns + n * batch_.capacity + k_);
    return value;
  }

  Batch const& batch_;
  std::size_t k_;
};

/// The kernel as a scheme may use it: what it does not declare (PassInfo::kernel) may not have been gathered, and does not
/// compile.
template <KernelWeightSet weights, class Kernel>
class DeclaredKernel {
 public:
  SPHVERIFY_INLINE explicit DeclaredKernel(Kernel const& all) : all_(all) {}

  SPHVERIFY_INLINE Pack distance() const { return all_.distance(); }
  SPHVERIFY_INLINE Pack h() const { return all_.h(); }
  SPHVERIFY_INLINE Pack value() const
    requires(weights.contains(KernelWeight::value))
  {
    return all_.value();
  }
  SPHVERIFY_INLINE Pack radial() const
    requires(weights.contains(KernelWeight::radial) || weights.contains(KernelWeight::gradient))
  {
    return all_.radial();
  }
  SPHVERIFY_INLINE auto separation() const
    requires(weights.contains(KernelWeight::gradient))
  {
    return all_.separation();
  }
  SPHVERIFY_INLINE auto gradient() const
    requires(weights.contains(KernelWeight::gradient))
  {
    return all_.gradient();
  }
  SPHVERIFY_INLINE auto offset() const
    requires(weights.contains(KernelWeight::face_offset))
  {
    return all_.offset();
  }
  SPHVERIFY_INLINE auto gradient_i() const
    requires(weights.contains(KernelWeight::own_gradients))
  {
    return all_.gradient_i();
  }
  SPHVERIFY_INLINE auto gradient_j() const
    requires(weights.contains(KernelWeight::own_gradients))
  {
    return all_.gradient_j();
  }

 private:
  Kernel const& all_;
};

}  // namespace sphverify::SPHVERIFY_INSTRUCTION_SET
