#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <span>

#include "formulations/support/views.hpp"

namespace sphverify {

/// Calls row(i) for i in [0, count). With several threads every row is still computed by one of them, start
/// to end, so that results do not depend on their number.
template <class Row>
void for_each_row(std::size_t count, int threads, Row const& row) {
  if (threads <= 1) {
    for (std::size_t i = 0; i < count; ++i) row(i);
    return;
  }
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 1024), [&](auto const& rows) {
      for (std::size_t i = rows.begin(); i != rows.end(); ++i) row(i);
    });
  });
}

inline void store(std::vector<double>& out, std::size_t i, double value) { out[i] = value; }
template <int Dim>
void store(VectorField<Dim>& out, std::size_t i, Vector<Dim> const& value) {
  out.set(i, value);
}
inline void increase(std::vector<double>& out, std::size_t i, double value) { out[i] += value; }
template <int Dim>
void increase(VectorField<Dim>& out, std::size_t i, Vector<Dim> const& value) {
  out.add(i, value);
}

/// out_i = sum over neighbours j of term(i, j, kernel): the one pair loop behind every scheme.
template <class Value, int Dim, class Out, class Term>
void sweep_pairs(NeighbourList const& neighbours, PairWeights<Dim> const& weights,
                 Particles<Dim> const& particles, int threads, Out& out, Term const& term) {
  FieldPointers<Dim> const fields(particles);
  for_each_row(neighbours.rows(), threads, [&](std::size_t i) {
    ParticleView<Dim> const particle(fields, i);
    Value sum{};
    if constexpr (!std::is_same_v<Value, double>) sum.setZero();
    for (std::size_t k = neighbours.first[i]; k < neighbours.first[i + 1]; ++k) {
      sum += term(particle, ParticleView<Dim>(fields, neighbours.neighbour[k]), KernelView<Dim>(weights, k));
    }
    store(out, i, sum);
  });
}

/// out_i += term(i, wall) for every contact; returns the terms, one per contact.
template <class Value, int Dim, class Out, class Term>
std::vector<Value> sweep_wall(WallContacts<Dim> const& contacts, Particles<Dim> const& particles, Out& out,
                              Term const& term) {
  FieldPointers<Dim> const fields(particles);
  std::vector<Value> terms;
  terms.reserve(contacts.size());
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    terms.push_back(term(ParticleView<Dim>(fields, contacts.particle[c]), WallView<Dim>(contacts, c)));
    increase(out, contacts.particle[c], terms.back());
  }
  return terms;
}

}  // namespace sphverify
