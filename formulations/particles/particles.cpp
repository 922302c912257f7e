// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/particles/particles.hpp"

#include "formulations/basics/expects.hpp"

namespace sphverify {

namespace {
std::size_t index(Field field) { return static_cast<std::size_t>(field); }
}  // namespace

template <int Dim>
Particles<Dim>::Particles(std::size_t count, double smoothing_length)
    : size_(count), smoothing_length_(smoothing_length) {
  expects(smoothing_length > 0.0);
  allocate({Field::position, Field::mass});
}

template <int Dim>
void Particles<Dim>::set_kernel(Kernel const& kernel) {
  expects(kernel.dimension() == Dim);
  kernel_ = &kernel;
}

template <int Dim>
void Particles<Dim>::allocate(Field field) {
  if (has(field)) return;
  if (info(field).is_tensor) {
    tensor_ = TensorField<Dim>(size_);
  } else if (info(field).is_vector) {
    vectors_[index(field)] = VectorField<Dim>(size_);
  } else {
    scalars_[index(field)].assign(size_, 0.0);
  }
}

template <int Dim>
void Particles<Dim>::allocate(FieldSet fields) {
  for (FieldInfo const& field : field_infos) {
    if (fields.contains(field.field)) allocate(field.field);
  }
}

template <int Dim>
bool Particles<Dim>::has(Field field) const {
  if (info(field).is_tensor) return tensor_.size() > 0;
  return info(field).is_vector ? vectors_[index(field)].size() > 0 : !scalars_[index(field)].empty();
}

template <int Dim>
std::size_t Particles<Dim>::bytes() const {
  std::size_t bytes = smoothing_lengths_.capacity() * sizeof(double);
  for (auto const& field : scalars_) bytes += field.capacity() * sizeof(double);
  for (auto const& field : vectors_) bytes += Dim * field.component(0).capacity() * sizeof(double);
  for (int n = 0; n < TensorField<Dim>::components; ++n) bytes += tensor_.component(n).capacity() * sizeof(double);
  return bytes;
}

template <int Dim>
std::vector<double>& Particles<Dim>::scalar(Field field) {
  expects(!info(field).is_vector && !info(field).is_tensor && has(field));
  return scalars_[index(field)];
}

template <int Dim>
std::vector<double> const& Particles<Dim>::scalar(Field field) const {
  expects(!info(field).is_vector && !info(field).is_tensor && has(field));
  return scalars_[index(field)];
}

template <int Dim>
VectorField<Dim>& Particles<Dim>::vector(Field field) {
  expects(info(field).is_vector && has(field));
  return vectors_[index(field)];
}

template <int Dim>
VectorField<Dim> const& Particles<Dim>::vector(Field field) const {
  expects(info(field).is_vector && has(field));
  return vectors_[index(field)];
}

template <int Dim>
TensorField<Dim>& Particles<Dim>::tensor(Field field) {
  expects(info(field).is_tensor && has(field));
  return tensor_;
}

template <int Dim>
TensorField<Dim> const& Particles<Dim>::tensor(Field field) const {
  expects(info(field).is_tensor && has(field));
  return tensor_;
}

template class Particles<1>;
template class Particles<2>;
template class Particles<3>;

}  // namespace sphverify
