// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/sweep/pair_sweep.hpp"

#include <algorithm>
#include <new>

#include "formulations/basics/expects.hpp"
#include "formulations/basics/parallel.hpp"

namespace sphverify {

namespace {

constexpr std::size_t alignment = 64;  // a cache line

/// A support that ends nowhere. Its fourth power is a number still.
constexpr double everywhere = 1e60;

/// Memory that starts on a cache line, is not written before it is used, and is kept for the next who asks on
/// the same thread: given back and taken anew at every sweep it would cost as much as the sweep.
class Workspace {
 public:
  double* of(std::size_t count) {
    if (count > size_) {
      data_.reset();
      data_.reset(static_cast<double*>(::operator new(count * sizeof(double), std::align_val_t(alignment))));
      size_ = count;
    }
    return data_.get();
  }

 private:
  struct Delete {
    void operator()(double* p) const { ::operator delete(p, std::align_val_t(alignment)); }
  };
  std::unique_ptr<double, Delete> data_;
  std::size_t size_ = 0;
};
thread_local Workspace record_space;
thread_local Workspace row_space;

}  // namespace

/// Particles as one record each: what a row gathers of a neighbour lies side by side in memory.
template <int Dim>
struct PairSweep<Dim>::Records {
  RecordSlots slots;
  double* values;

  Records(FieldSet reads, Particles<Dim> const& particles, VectorField<Dim> const* state_velocity,
          int threads)
      : slots(record_slots(reads, Dim, !particles.smoothing_lengths().empty(), state_velocity != nullptr)),
        values(record_space.of(slots.stride() * std::max<std::size_t>(1, particles.size()))) {
    std::vector<double const*> const sources = sources_of(particles, state_velocity);
    std::size_t const stride = slots.stride();
    for_each_block(particles.size(), threads, [&](std::size_t begin, std::size_t end) {
      // Slot after slot, on as many records at a time as the nearest cache holds.
      for (std::size_t first = begin; first < end; first += records_at_a_time) {
        std::size_t const last = std::min(first + records_at_a_time, end);
        for (std::size_t s = 0; s < stride; ++s) fill_slot(s, sources[s], first, last);
      }
    });
  }

 private:
  static constexpr std::size_t records_at_a_time = 128;

  /// @param source null where the slot holds 1/rho or nothing
  void fill_slot(std::size_t slot, double const* source, std::size_t first, std::size_t last) {
    std::size_t const stride = slots.stride();
    if (source != nullptr) {
      for (std::size_t i = first; i < last; ++i) values[i * stride + slot] = source[i];
    } else if (static_cast<int>(slot) == slots.per_rho) {
      for (std::size_t i = first; i < last; ++i)
        values[i * stride + slot] = 1.0 / values[i * stride + slots.rho];
    } else {
      for (std::size_t i = first; i < last; ++i) values[i * stride + slot] = 0.0;
    }
  }

  /// Per slot where its values are; null for what is computed or nothing.
  std::vector<double const*> sources_of(Particles<Dim> const& particles,
                                        VectorField<Dim> const* state_velocity) const {
    std::vector<double const*> sources(slots.stride(), nullptr);
    auto const scalar = [&](Field field, int slot) {
      if (slot >= 0) sources[static_cast<std::size_t>(slot)] = particles.scalar(field).data();
    };
    auto const vector = [&](VectorField<Dim> const& field, int slot) {
      for (int k = 0; k < Dim; ++k) sources[static_cast<std::size_t>(slot + k)] = field.component(k).data();
    };
    vector(particles.positions(), 0);
    scalar(Field::mass, slots.m);
    scalar(Field::density, slots.rho);
    scalar(Field::pressure, slots.P);
    scalar(Field::temperature, slots.T);
    scalar(Field::conductivity, slots.K);
    scalar(Field::sound_speed, slots.c);
    if (slots.h >= 0) sources[static_cast<std::size_t>(slots.h)] = particles.smoothing_lengths().data();
    if (slots.v >= 0) vector(particles.vector(Field::velocity), slots.v);
    if (state_velocity && slots.u >= 0) vector(*state_velocity, slots.u);
    if (slots.F >= 0) vector(particles.vector(Field::flux), slots.F);
    scalar(Field::omega, slots.omega);
    scalar(Field::pass_number, slots.pass_number);
    scalar(Field::pass_number_2, slots.pass_number_2);
    if (slots.pass_vector >= 0) vector(particles.vector(Field::pass_vector), slots.pass_vector);
    if (slots.pass_tensor >= 0) {
      auto const& tensor = particles.tensor(Field::pass_tensor);
      for (int n = 0; n < TensorField<Dim>::components; ++n)
        sources[static_cast<std::size_t>(slots.pass_tensor + n)] = tensor.component(n).data();
    }
    return sources;
  }
};

namespace {

/// Whether records have all that a loop was made for in the places that it knows.
bool fits(RecordSlots const& made_for, RecordSlots const& there) {
  for (auto const slot :
       {&RecordSlots::m, &RecordSlots::rho, &RecordSlots::P, &RecordSlots::T, &RecordSlots::K, &RecordSlots::c,
        &RecordSlots::per_rho, &RecordSlots::v, &RecordSlots::F, &RecordSlots::omega, &RecordSlots::pass_number,
        &RecordSlots::pass_number_2, &RecordSlots::pass_vector, &RecordSlots::pass_tensor, &RecordSlots::u, &RecordSlots::h}) {
    if (made_for.*slot >= 0 && made_for.*slot != there.*slot) return false;
  }
  return true;
}

BatchFunction fitting(std::array<LoopForSlots, 2> const& made, RecordSlots const& slots) {
  for (LoopForSlots const& one : made) {
    if (one.sum != nullptr && fits(one.slots, slots)) return one.sum;
  }
  return nullptr;
}

/// How many of the terms from the first on a loop of several serves: all of its own, or none.
std::size_t served(LoopOfSeveral const& loop, std::span<RowTerm const> terms) {
  std::size_t same = 0;
  while (same < loop.terms.size() && loop.terms[same] != nullptr) {
    if (same == terms.size() || terms[same].loops->sum != loop.terms[same]) return 0;
    ++same;
  }
  return same;
}

}  // namespace

/// For the terms one after the other, the loop that serves most of those that follow.
template <int Dim>
void PairSweep<Dim>::choose_loops(RecordSlots const& slots) {
  loops_.clear();
  loop_terms_.clear();
  for (std::size_t t = 0; t < terms_.size();) {
    TermLoops const& own = *terms_[t].loops;
    BatchFunction chosen = fitting(own.made, slots);
    if (chosen == nullptr) chosen = own.sum;
    std::size_t most = 1;
    for (LoopOfSeveral const& several : loops_of_sweep<Dim>().of_several) {
      std::size_t const count = served(several, std::span(terms_).subspan(t));
      if (count <= most) continue;
      if (BatchFunction const together = fitting(several.made, slots)) {
        chosen = together;
        most = count;
      }
    }
    loops_.push_back(chosen);
    loop_terms_.push_back(t);
    t += most;
  }
}

template <int Dim>
void PairSweep<Dim>::add(TermLoops const& loops, FieldSet reads, KernelWeightSet kernel,
                         std::vector<double*> const& out, void const* parameters) {
  expects(terms_.size() < most_terms && static_cast<int>(out.size()) == loops.components);
  RowTerm term{.loops = &loops, .parameters = parameters, .outputs = {}};
  std::copy(out.begin(), out.end(), term.outputs.begin());
  terms_.push_back(term);
  reads_ = reads_ | reads;
  if (kernel.contains(KernelWeight::gradient) || kernel.contains(KernelWeight::radial)) wants_radial_ = true;
  if (kernel.contains(KernelWeight::value)) {
    expects(neighbours_.slope.empty());  // beside stored slopes there is no W: who reads it is refused before (why_no_pair_weights)
    wants_value_ = true;
  }
  if (loops.wants_value) wants_value_ = true;
  if (kernel.contains(KernelWeight::face_offset)) {
    expects(has_offsets(neighbours_, Dim));
    wants_offset_ = true;
  }
  if (kernel.contains(KernelWeight::own_gradients)) wants_own_radial_ = wants_separation_ = true;
  if (kernel.contains(KernelWeight::gradient) || reads.contains(Field::velocity)) wants_separation_ = true;
}

template <int Dim>
void PairSweep<Dim>::add(TermLoops const& loops, FieldSet reads, KernelWeightSet kernel, std::vector<double>& out,
                         void const* parameters) {
  add(loops, reads, kernel, std::vector<double*>{out.data()}, parameters);
}

template <int Dim>
void PairSweep<Dim>::add(TermLoops const& loops, FieldSet reads, KernelWeightSet kernel, VectorField<Dim>& out) {
  std::vector<double*> components;
  for (int k = 0; k < Dim; ++k) components.push_back(out.component(k).data());
  add(loops, reads, kernel, components, nullptr);
}

template <int Dim>
void PairSweep<Dim>::add(TermLoops const& loops, FieldSet reads, KernelWeightSet kernel, TensorField<Dim>& out) {
  std::vector<double*> components;
  for (int n = 0; n < TensorField<Dim>::components; ++n) components.push_back(out.component(n).data());
  add(loops, reads, kernel, components, nullptr);
}

template <int Dim>
SweepPlan PairSweep<Dim>::plan(Particles<Dim> const& particles, Records const& records) const {
  SweepPlan plan{.records = records.values,
                 .stride = records.slots.stride(),
                 .slots = records.slots,
                 .first = neighbours_.first.data(),
                 .neighbour = neighbours_.neighbour.data(),
                 .slope = neighbours_.slope.empty() ? nullptr : neighbours_.slope.data(),
                 .offset = {},
                 .kernel = particles.kernel().columns(),
                 .support_ratio = neighbours_.slope.empty() ? particles.kernel().support_ratio() : everywhere,
                 .h = particles.smoothing_length(),
                 .wrapping = Wrapping::none,
                 .period = {},
                 .inverse_period = {},
                 .axes = {},
                 .wants_separation = wants_separation_,
                 .wants_radial = wants_radial_ || (wants_own_radial_ && records.slots.h < 0),
                 .wants_value = wants_value_,
                 .wants_own_radial = wants_own_radial_,
                 .terms = terms_.data(),
                 .loops = loops_.data(),
                 .loop_terms = loop_terms_.data(),
                 .loop_count = loops_.size()};
  if (domain_.is_periodic()) plan.wrapping = domain_.is_turned() ? Wrapping::turned : Wrapping::along_axes;
  for (std::size_t k = 0; wants_offset_ && k < Dim; ++k) plan.offset[k] = neighbours_.offset[k].data();
  for (int k = 0; k < Dim; ++k) {
    for (int n = 0; n < Dim; ++n) plan.axes[static_cast<std::size_t>(k * Dim + n)] = domain_.axes(n, k);
    if (!domain_.periodic[k]) continue;
    plan.period[static_cast<std::size_t>(k)] = domain_.extent()[k];
    plan.inverse_period[static_cast<std::size_t>(k)] = 1.0 / domain_.extent()[k];
  }
  return plan;
}

namespace {

/// Pairs that batches of some rows hold: those of the longest row, if it is that long.
std::size_t capacity_of(NeighbourList const& neighbours, std::size_t begin, std::size_t end) {
  std::size_t longest = batch_pairs;
  for (std::size_t i = begin; i < end; ++i)
    longest = std::max(longest, neighbours.first[i + 1] - neighbours.first[i] + 3);
  return longest / 4 * 4;
}

}  // namespace

template <int Dim>
void PairSweep<Dim>::run(Particles<Dim> const& particles, VectorField<Dim> const* state_velocity) {
  Records const records(reads_, particles, state_velocity, threads_);
  choose_loops(records.slots);
  SweepPlan const sweep = plan(particles, records);
  SweepLoops const& loops = loops_of_sweep<Dim>();
  for_each_block(neighbours_.rows(), threads_, [&](std::size_t begin, std::size_t end) {
    std::size_t const capacity = capacity_of(neighbours_, begin, end);
    loops.rows(sweep, begin, end, capacity, row_space.of(scratch_size(capacity)));
  });
}

template <int Dim>
std::vector<double> PairSweep<Dim>::conductances(void (*of_batch)(Batch const&, double*), FieldSet reads,
                                                 Particles<Dim> const& particles) {
  expects(particles.smoothing_lengths().empty());
  wants_radial_ = wants_separation_ = wants_value_ = true;  // once a scene
  Records const records(reads, particles, nullptr, threads_);
  SweepPlan const sweep = plan(particles, records);
  SweepLoops const& loops = loops_of_sweep<Dim>();
  std::vector<double> all(neighbours_.pairs());
  for_each_block(neighbours_.rows(), threads_, [&](std::size_t begin, std::size_t end) {
    std::size_t const capacity = capacity_of(neighbours_, begin, end);
    loops.conductances(sweep, of_batch, begin, end, capacity, row_space.of(scratch_size(capacity)), all.data());
  });
  return all;
}

template class PairSweep<1>;
template class PairSweep<2>;
template class PairSweep<3>;

}  // namespace sphverify
