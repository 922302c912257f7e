// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "formulations/basics/parallel.hpp"
#include "formulations/walls/views.hpp"

namespace sphverify {

inline void increase(std::vector<double>& out, std::size_t i, double value) { out[i] += value; }
template <int Dim>
void increase(VectorField<Dim>& out, std::size_t i, Vector<Dim> const& value) {
  out.add(i, value);
}

template <int Dim>
void increase(TensorField<Dim>& out, std::size_t i, Tensor<Dim> const& value) {
  out.add(i, value);
}

/// out_i += term(i, wall) for every contact, of which each particle has one; returns the terms, one per contact.
/// @tparam of_particle, of_wall what the term may read
/// @tparam has_faces whether contacts have the offsets of faces
template <class Value, FieldSet of_particle, BoundaryValueSet of_wall, bool has_faces = false, int Dim, class Out, class Term>
std::vector<Value> sweep_wall(WallContacts<Dim> const& contacts, Particles<Dim> const& particles, Out& out,
                              Term const& term, int threads = 1) {
  FieldPointers<Dim> const fields(particles);
  std::vector<Value> terms(contacts.size());
  for_each_row(contacts.size(), threads, [&](std::size_t c) {
    terms[c] = term(ParticleView<Dim, of_particle>(fields, contacts.particle[c]), WallView<Dim, of_wall, has_faces>(contacts, c));
    increase(out, contacts.particle[c], terms[c]);
  });
  return terms;
}

}  // namespace sphverify
