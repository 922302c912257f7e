// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "formulations/particles/particles.hpp"
#include "formulations/walls/finite_face.hpp"
#include "formulations/walls/walls.hpp"

namespace sphverify {

/// Where the particle fields lie in memory; null where a field is not allocated.
template <int Dim>
struct FieldPointers {
  double const *m = nullptr, *rho = nullptr, *P = nullptr, *T = nullptr, *K = nullptr;
  double const *c = nullptr, *omega = nullptr;
  double const *pass_number = nullptr, *pass_number_2 = nullptr;
  std::array<double const*, Dim> v{}, F{}, pass_vector{};
  TensorField<Dim> const* pass_tensor = nullptr;
  Particles<Dim> const* all;

  std::vector<Wall<Dim>> const* walls = nullptr;  ///< that cut off a part of the kernel; null: none

  explicit FieldPointers(Particles<Dim> const& particles) : all(&particles) {
    auto const scalar = [&](Field f) { return particles.has(f) ? particles.scalar(f).data() : nullptr; };
    m = scalar(Field::mass);
    rho = scalar(Field::density);
    P = scalar(Field::pressure);
    T = scalar(Field::temperature);
    K = scalar(Field::conductivity);
    c = scalar(Field::sound_speed);
    omega = scalar(Field::omega);
    pass_number = scalar(Field::pass_number);
    pass_number_2 = scalar(Field::pass_number_2);
    if (particles.has(Field::pass_tensor)) pass_tensor = &particles.tensor(Field::pass_tensor);
    for (int k = 0; k < Dim; ++k) {
      if (particles.has(Field::pass_vector)) pass_vector[k] = particles.vector(Field::pass_vector).component(k).data();
      if (particles.has(Field::velocity)) v[k] = particles.vector(Field::velocity).component(k).data();
      if (particles.has(Field::flux)) F[k] = particles.vector(Field::flux).component(k).data();
    }
  }
};

/// One particle as a scheme sees it: the paper's symbols, each read from memory only where it is used. What is not among
/// `reads` does not compile.
template <int Dim, FieldSet reads>
class ParticleView {
 public:
  ParticleView(FieldPointers<Dim> const& fields, std::size_t index) : f_(&fields), i_(index) {}

  double m() const
    requires(reads.contains(Field::mass))
  {
    return f_->m[i_];
  }
  /// W_ii, what a sum over neighbours leaves out  [m^-Dim]
  double W0() const {
    auto const& own = f_->all->smoothing_lengths();
    return f_->all->kernel().value(0.0, own.empty() ? f_->all->smoothing_length() : own[i_]);
  }
  /// The part of the kernel on the inner sides of all walls that have wall terms, between 0 and 1
  double Gamma() const {
    if (f_->walls == nullptr) return 1.0;
    auto const& own = f_->all->smoothing_lengths();
    return inner_fraction(f_->all->positions()[i_], *f_->walls, own.empty() ? f_->all->smoothing_length() : own[i_], f_->all->kernel());
  }
  double rho() const
    requires(reads.contains(Field::density))
  {
    return f_->rho[i_];
  }
  double P() const
    requires(reads.contains(Field::pressure))
  {
    return f_->P[i_];
  }
  double T() const
    requires(reads.contains(Field::temperature))
  {
    return f_->T[i_];
  }
  double K() const
    requires(reads.contains(Field::conductivity))
  {
    return f_->K[i_];
  }
  double c() const
    requires(reads.contains(Field::sound_speed))
  {
    return f_->c[i_];
  }
  Vector<Dim> v() const
    requires(reads.contains(Field::velocity))
  {
    return gather(f_->v);
  }
  Vector<Dim> F() const
    requires(reads.contains(Field::flux))
  {
    return gather(f_->F);
  }
  double Omega() const
    requires(reads.contains(Field::omega))
  {
    return f_->omega[i_];
  }
  double pass_number() const
    requires(reads.contains(Field::pass_number))
  {
    return f_->pass_number[i_];
  }
  double pass_number_2() const
    requires(reads.contains(Field::pass_number_2))
  {
    return f_->pass_number_2[i_];
  }
  Vector<Dim> pass_vector() const
    requires(reads.contains(Field::pass_vector))
  {
    return gather(f_->pass_vector);
  }
  Tensor<Dim> pass_tensor() const
    requires(reads.contains(Field::pass_tensor))
  {
    return (*f_->pass_tensor)[i_];
  }

 private:
  Vector<Dim> gather(std::array<double const*, Dim> const& components) const {
    Vector<Dim> value;
    for (int k = 0; k < Dim; ++k) value[k] = components[k][i_];
    return value;
  }

  FieldPointers<Dim> const* f_;
  std::size_t i_;
};

/// A wall at the foot point of particle i as a scheme sees it: geometry and the density there always, else what is among
/// `reads`, and where it has faces of cells their offsets.
template <int Dim, BoundaryValueSet reads, bool has_faces = false>
class WallView {
 public:
  WallView(WallContacts<Dim> const& contacts, std::size_t contact) : w_(&contacts), c_(contact) {}

  double A() const { return w_->face_weight[c_]; }
  Vector<Dim> n() const { return w_->outward_normal; }
  Vector<Dim> S() const { return w_->face_weight[c_] * w_->outward_normal; }
  double d() const { return w_->distance[c_]; }
  /// From the foot point to the centroid of the cell's face on the wall  [m]
  Vector<Dim> offset() const
    requires(has_faces)
  {
    return w_->offset[c_];
  }
  double rho() const { return w_->foot_density[c_]; }
  double P() const
    requires(reads.contains(BoundaryValue::pressure))
  {
    return w_->pressure[c_];
  }
  double T() const
    requires(reads.contains(BoundaryValue::temperature))
  {
    return w_->temperature[c_];
  }
  double K() const
    requires(reads.contains(BoundaryValue::conductivity))
  {
    return w_->conductivity[c_];
  }
  Vector<Dim> v() const
    requires(reads.contains(BoundaryValue::velocity))
  {
    return w_->velocity[c_];
  }
  Vector<Dim> F() const
    requires(reads.contains(BoundaryValue::flux))
  {
    return w_->flux[c_];
  }
  bool prescribes_flux_only() const { return w_->prescribes_flux_only; }

 private:
  WallContacts<Dim> const* w_;
  std::size_t c_;
};

}  // namespace sphverify
