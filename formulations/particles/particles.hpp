// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "formulations/basics/vector.hpp"
#include "formulations/kernels/kernel.hpp"
#include "formulations/particles/field.hpp"

namespace sphverify {

/// One vector per particle, stored component by component.
template <int Dim>
class VectorField {
 public:
  VectorField() = default;
  explicit VectorField(std::size_t count) {
    for (auto& component : components_) component.assign(count, 0.0);
  }

  std::size_t size() const { return components_[0].size(); }

  Vector<Dim> operator[](std::size_t i) const {
    Vector<Dim> v;
    for (int k = 0; k < Dim; ++k) v[k] = components_[k][i];
    return v;
  }
  void set(std::size_t i, Vector<Dim> const& v) {
    for (int k = 0; k < Dim; ++k) components_[k][i] = v[k];
  }
  void add(std::size_t i, Vector<Dim> const& v) {
    for (int k = 0; k < Dim; ++k) components_[k][i] += v[k];
  }

  std::vector<double>& component(int k) { return components_[k]; }
  std::vector<double> const& component(int k) const { return components_[k]; }

 private:
  std::array<std::vector<double>, Dim> components_;
};

/// One symmetric tensor per particle, its different elements stored one after the other.
template <int Dim>
class TensorField {
 public:
  static constexpr int components = Dim * (Dim + 1) / 2;

  TensorField() = default;
  explicit TensorField(std::size_t count) {
    for (auto& element : elements_) element.assign(count, 0.0);
  }

  std::size_t size() const { return elements_[0].size(); }

  Tensor<Dim> operator[](std::size_t i) const {
    Tensor<Dim> t;
    for (int k = 0; k < Dim; ++k)
      for (int l = 0; l < Dim; ++l) t(k, l) = component(tensor_index(k, l))[i];
    return t;
  }
  void set(std::size_t i, Tensor<Dim> const& t) {
    for (int l = 0; l < Dim; ++l)
      for (int k = 0; k <= l; ++k) component(tensor_index(k, l))[i] = t(k, l);
  }
  void add(std::size_t i, Tensor<Dim> const& t) { set(i, (*this)[i] + t); }

  std::vector<double>& component(int n) { return elements_[static_cast<std::size_t>(n)]; }
  std::vector<double> const& component(int n) const { return elements_[static_cast<std::size_t>(n)]; }

 private:
  std::array<std::vector<double>, components> elements_;
};

/// Particles as structure of arrays. A field is empty until `allocate` is called for it.
template <int Dim>
class Particles {
 public:
  /// @param count number of particles
  /// @param smoothing_length h, one for all until `vary_smoothing_length` [m]; must be positive
  Particles(std::size_t count, double smoothing_length);

  std::size_t size() const { return size_; }
  double smoothing_length() const { return smoothing_length_; }

  /// The kernel that they have their smoothing lengths for: the default one until another is set.
  Kernel const& kernel() const { return *kernel_; }
  /// Expects a kernel of this dimension that lives as long as the particles, as those of kernel() in
  /// kernel.hpp do.
  void set_kernel(Kernel const& kernel);

  /// Gives every particle its own smoothing length, at first the common one.
  void vary_smoothing_length() { smoothing_lengths_.assign(size_, smoothing_length_); }
  /// Empty where all have the common one.
  std::vector<double>& smoothing_lengths() { return smoothing_lengths_; }
  std::vector<double> const& smoothing_lengths() const { return smoothing_lengths_; }

  void allocate(Field field);
  void allocate(FieldSet fields);
  bool has(Field field) const;
  std::size_t bytes() const;

  /// Field of numbers; expects that it is allocated.
  std::vector<double>& scalar(Field field);
  std::vector<double> const& scalar(Field field) const;

  /// Field of vectors; expects that it is allocated.
  VectorField<Dim>& vector(Field field);
  VectorField<Dim> const& vector(Field field) const;

  /// Field of symmetric tensors; expects that it is allocated.
  TensorField<Dim>& tensor(Field field);
  TensorField<Dim> const& tensor(Field field) const;

  VectorField<Dim>& positions() { return vector(Field::position); }
  VectorField<Dim> const& positions() const { return vector(Field::position); }
  std::vector<double>& masses() { return scalar(Field::mass); }
  std::vector<double> const& masses() const { return scalar(Field::mass); }

 private:
  std::size_t size_;
  double smoothing_length_;
  Kernel const* kernel_ = &default_kernel(Dim);
  std::vector<double> smoothing_lengths_;
  std::array<std::vector<double>, field_infos.size()> scalars_;
  std::array<VectorField<Dim>, field_infos.size()> vectors_;
  TensorField<Dim> tensor_;  ///< there is one
};

extern template class Particles<1>;
extern template class Particles<2>;
extern template class Particles<3>;

}  // namespace sphverify
