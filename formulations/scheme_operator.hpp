// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <exception>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include "formulations/basics/parallel.hpp"
#include "formulations/least_squares/quadratic_weights.hpp"
#include "formulations/rate_operator.hpp"
#include "formulations/sweep/loops.hpp"
#include "formulations/walls/sweep_wall.hpp"

namespace sphverify {

/// Throws UndefinedRate, which names the first of the values that is negative, "particle 7", or whose they are, "wall 1".
void require_non_negative(SchemeInfo const& scheme, std::string_view quantity, std::vector<double> const& values,
                          std::optional<std::size_t> wall = std::nullopt);

/// A scheme as its header has it, behind the common face: its passes one after the other, each over pairs and walls. Its loops
/// over pairs are compiled elsewhere.
template <class Scheme, int Dim>
class SchemeOperator final : public RateOperator<Dim> {
 public:
  using Value = std::conditional_t<Scheme::info.rate == Rate::acceleration, Vector<Dim>, double>;
  static constexpr std::size_t last = std::tuple_size_v<AllPasses<Scheme>> - 1;
  template <std::size_t n>
  using Pass = std::tuple_element_t<n, AllPasses<Scheme>>;

  SchemeInfo const& info() const override { return Scheme::info; }
  std::type_info const& first_passes() const override { return typeid(typename PassesOf<Scheme>::type); }

  void begin_pass(int pass, Particles<Dim>& particles, PairGeometry<Dim>& geometry, Closure closure,
                  double time, int threads, PairSweep<Dim>& sweep) override {
    threads_ = threads;
    with_pass(pass, [&]<std::size_t n>() {
      if (n < last && is_frozen_) return;
      fill_boundaries<n>(particles, geometry, closure, time, threads);
      if constexpr (has_own_weights) {
        // Frozen, nothing has moved: what is held is right, and not looked at again.
        PairGeometry<Dim>& weighted = is_frozen_ ? weights_.last() : weights_.on(particles, geometry, threads);
        fill_boundaries<n>(particles, weighted, closure, time, threads);
        PairSweep<Dim> own(weighted.neighbours, weighted.domain, threads);
        add_pass<n>(particles, weighted, time, threads, own);
        if (!own.empty()) own.run(particles);
      } else {
        add_pass<n>(particles, geometry, time, threads, sweep);
      }
    });
  }

  void end_pass(int pass, Particles<Dim>& particles, PairGeometry<Dim> const& given, WorkCount& work) override {
    if (pass < static_cast<int>(last) && is_frozen_) return;
    PairGeometry<Dim> const& geometry = seen_last(given);
    work.pair_interactions += geometry.neighbours.pairs();
    for (auto const& contacts : geometry.contacts) work.wall_interactions += contacts.size();
    for (auto const& behind : geometry.behind) work.wall_interactions += behind.pairs.pairs();
    with_pass(pass, [&]<std::size_t n>() {
      if constexpr (n == last) {
        wall_terms_.clear();
        exchanged_.clear();
        for (std::size_t w = 0; w < geometry.contacts.size(); ++w) {
          wall_terms_.push_back(add_wall<n>(geometry, w, particles));
          exchanged_.push_back(total(geometry.contacts[w], particles, wall_terms_.back(), threads_));
        }
      } else {
        for (std::size_t w = 0; w < geometry.contacts.size(); ++w) add_wall<n>(geometry, w, particles);
        finish<n>(particles, geometry);
      }
    });
  }

  void freeze(Particles<Dim>& particles, PairGeometry<Dim>& geometry, int threads) override {
    if constexpr (Scheme::info.difference_form) {
      static_assert(!first_reads.contains(Field::temperature) && first_boundary.empty(),
                    "a difference form's first passes run once where particles rest: they read no temperature and nothing of walls");
      WorkCount uncounted;
      for (int pass = 0; pass < static_cast<int>(last); ++pass) {
        PairSweep<Dim> sweep(geometry.neighbours, geometry.domain, threads);
        this->begin_pass(pass, particles, geometry, Closure::interpolated, 0.0, threads, sweep);
        if (!sweep.empty()) sweep.run(particles);
        this->end_pass(pass, particles, geometry, uncounted);
      }
      PairGeometry<Dim> const* seen = &geometry;
      if constexpr (has_own_weights) seen = &weights_.on(particles, geometry, threads);
      PairSweep<Dim> sweep(seen->neighbours, seen->domain, threads);
      conductance_ = sweep.conductances(loops_of_scheme<Scheme, Dim>().conductance, reads_of_pass<Scheme, last>(), particles);
      is_frozen_ = true;
    }
  }

  std::size_t bytes() const override {
    if constexpr (has_own_weights) return conductance_.capacity() * sizeof(double) + weights_.bytes();
    return conductance_.capacity() * sizeof(double);
  }

  std::vector<std::vector<Vector<Dim>>> const& wall_acceleration() const override {
    if constexpr (std::is_same_v<Value, Vector<Dim>>)
      return wall_terms_;
    else
      return no_acceleration_;
  }
  std::vector<Vector<Dim>> const& wall_force() const override {
    if constexpr (std::is_same_v<Value, Vector<Dim>>)
      return exchanged_;
    else
      return no_force_;
  }
  std::vector<double> const& wall_power() const override {
    if constexpr (std::is_same_v<Value, double>)
      return exchanged_;
    else
      return no_power_;
  }

 private:
  static constexpr bool has_own_weights = Scheme::info.least_squares;
  static_assert(!has_own_weights || last == 0, "weights of its own are for a form of one pass");
  static constexpr FieldSet first_reads = [] {
    FieldSet reads;
    for (PassInfo const& pass : Scheme::info.first_passes) reads = reads | pass.reads;
    return reads;
  }();
  static constexpr BoundaryValueSet first_boundary = [] {
    BoundaryValueSet values;
    for (PassInfo const& pass : Scheme::info.first_passes) values = values | pass.boundary;
    return values;
  }();

  /// Calls act.operator()<n>() for the pass of that number.
  template <class Act>
  static void with_pass(int pass, Act const& act) {
    [&]<std::size_t... n>(std::index_sequence<n...>) {
      ((static_cast<int>(n) == pass ? act.template operator()<n>() : void()), ...);
    }(std::make_index_sequence<last + 1>());
  }

  template <class APass, class AnyParticles>
  static auto& output(AnyParticles& particles) {
    constexpr FieldInfo field = sphverify::info(output_of<APass>());
    if constexpr (field.is_tensor) {
      return (particles.tensor(field.field));
    } else if constexpr (field.is_vector) {
      return (particles.vector(field.field));
    } else {
      return (particles.scalar(field.field));
    }
  }

  template <std::size_t n>
  static BoundaryValueSet wall_values(WallContacts<Dim> const& contacts) {
    if constexpr (n == last) {
      constexpr BoundaryValueSet flux_only{BoundaryValue::flux};
      if (Scheme::info.boundary_if_prescribed.contains(BoundaryValue::flux) && contacts.prescribes_flux_only)
        return flux_only;
    }
    return Pass<n>::info.boundary;
  }

  PairGeometry<Dim> const& seen_last(PairGeometry<Dim> const& given) const {
    if constexpr (has_own_weights) return weights_.last();
    return given;
  }

  template <std::size_t n>
  static void fill_boundaries(Particles<Dim> const& particles, PairGeometry<Dim>& geometry, Closure closure, double time,
                              int threads) {
    for (std::size_t w = 0; w < geometry.contacts.size(); ++w) {
      fill_boundary_values(geometry.contacts[w], geometry.walls[w], particles,
                           wall_values<n>(geometry.contacts[w]).without(geometry.held), closure, time, threads);
    }
  }

  /// The pass's pairs, and those with what stands behind walls.
  template <std::size_t n>
  void add_pass(Particles<Dim>& particles, PairGeometry<Dim>& geometry, double time, int threads, PairSweep<Dim>& sweep) {
    if constexpr (reads_face_offsets(Scheme::info)) {
      bool has_faces = has_offsets(geometry.neighbours, Dim);
      for (WallContacts<Dim> const& contacts : geometry.contacts) has_faces = has_faces && contacts.offset.size() == contacts.size();
      if (!has_faces)
        throw UndefinedRate(std::string(Scheme::info.id) + " " + std::string(why_no_kernel_weights(Scheme::info)));
    }
    for (std::size_t w = 0; w < geometry.behind.size(); ++w) sweep_behind<n>(geometry, w, particles, time, threads);
    if constexpr (n == last) {
      check(particles, geometry);
      if constexpr (Scheme::info.difference_form) {
        if (is_frozen_) return conduct(particles, geometry.neighbours, threads);
      }
    }
    sweep.add(loops_of_scheme<Scheme, Dim>().passes[n], reads_of_pass<Scheme, n>(), Pass<n>::info.kernel, output<Pass<n>>(particles));
  }

  /// The pass's pairs of a wall's contacts with what stands behind it, into the field that it writes there.
  template <std::size_t n>
  static void sweep_behind(PairGeometry<Dim>& geometry, std::size_t wall, Particles<Dim> const& fluid, double time, int threads) {
    constexpr FieldSet reads = reads_of_pass<Scheme, n>();
    WallParticles<Dim>& behind = geometry.behind[wall];
    fill_wall_particles(behind, geometry.contacts[wall], geometry.walls, fluid, reads, time);
    if constexpr (Scheme::info.non_negative.contains(Field::pressure))
      require_non_negative(Scheme::info, "pressure behind it", behind.particles.scalar(Field::pressure), wall);
    behind.particles.allocate(output_of<Pass<n>>());
    PairSweep<Dim> sweep(behind.pairs, geometry.domain, threads);
    sweep.add(loops_of_scheme<Scheme, Dim>().passes[n], reads, Pass<n>::info.kernel, output<Pass<n>>(behind.particles));
    sweep.run(behind.particles);
  }

  template <std::size_t n>
  auto add_wall(PairGeometry<Dim> const& geometry, std::size_t wall, Particles<Dim>& particles) const {
    constexpr FieldInfo field = sphverify::info(output_of<Pass<n>>());
    using Term = std::conditional_t<field.is_tensor, Tensor<Dim>, std::conditional_t<field.is_vector, Vector<Dim>, double>>;
    WallContacts<Dim> const& contacts = geometry.contacts[wall];
    if (!geometry.behind.empty()) {
      auto const& sums = output<Pass<n>>(geometry.behind[wall].particles);
      std::vector<Term> terms;
      for (std::size_t c = 0; c < contacts.size(); ++c) {
        terms.push_back(sums[c]);
        increase(output<Pass<n>>(particles), contacts.particle[c], terms.back());
      }
      return terms;
    }
    constexpr BoundaryValueSet of_wall = [] {
      if constexpr (n == last) return Scheme::info.boundary | Scheme::info.boundary_if_prescribed;
      return Pass<n>::info.boundary;
    }();
    constexpr bool reads_faces = Pass<n>::info.kernel.contains(KernelWeight::face_offset);
    return sweep_wall<Term, reads_of_pass<Scheme, n>(), of_wall, reads_faces>(
        contacts, particles, output<Pass<n>>(particles),
        [](auto const& i, auto const& B) { return Pass<n>::wall(i, B); }, threads_);
  }

  /// Makes of a pass's sums what it writes. What fails first, in the order of particles, is thrown.
  template <std::size_t n>
  void finish(Particles<Dim>& particles, PairGeometry<Dim> const& geometry) const {
    using Own = ParticleView<Dim, reads_of_pass<Scheme, n>()>;
    auto& out = output<Pass<n>>(particles);
    if constexpr (requires(Own own) { Pass<n>::finish(own, out[0]); }) {
      FieldPointers<Dim> fields(particles);
      if (!geometry.contacts.empty() && geometry.behind.empty()) fields.walls = &geometry.walls;
      auto const finish_one = [&](std::size_t i) {
        if constexpr (std::is_same_v<decltype(out), std::vector<double>&>) {
          out[i] = Pass<n>::finish(Own(fields, i), out[i]);
        } else {
          out.set(i, Pass<n>::finish(Own(fields, i), out[i]));
        }
      };
      std::exception_ptr const failure = joined_blocks(
          particles.size(), threads_, std::exception_ptr(),
          [&](std::size_t begin, std::size_t end) -> std::exception_ptr {
            for (std::size_t i = begin; i < end; ++i) {
              try {
                finish_one(i);
              } catch (TooFewPartners const& error) {
                return std::make_exception_ptr(TooFewPartners("particle " + std::to_string(i) + ": " + error.what()));
              } catch (...) {
                return std::current_exception();
              }
            }
            return nullptr;
          },
          [](std::exception_ptr& first, std::exception_ptr const& part) {
            if (!first) first = part;
          });
      if (failure) std::rethrow_exception(failure);
    }
  }

  /// sum_i m_i term_i: what the wall gives to the particles, per time.
  static Value total(WallContacts<Dim> const& contacts, Particles<Dim> const& particles,
                     std::vector<Value> const& terms, int threads) {
    Value zero{};
    if constexpr (!std::is_same_v<Value, double>) zero.setZero();
    return sum_of_rows(terms.size(), threads, zero,
                       [&](std::size_t c) -> Value { return particles.masses()[contacts.particle[c]] * terms[c]; });
  }

  void conduct(Particles<Dim>& particles, NeighbourList const& neighbours, int threads) const {
    double const* const temperature = particles.scalar(Field::temperature).data();
    double* const rate = particles.scalar(Field::heating).data();
    for_each_block(neighbours.rows(), threads, [&](std::size_t begin, std::size_t end) {
      loops_of_sweep<Dim>().conduct(neighbours.first.data(), neighbours.neighbour.data(), conductance_.data(), temperature, begin,
                                    end, rate);
    });
  }

  static void check(Particles<Dim> const& particles, PairGeometry<Dim> const& geometry) {
    if constexpr (Scheme::info.non_negative.contains(Field::pressure)) {
      require_non_negative(Scheme::info, "pressure", particles.scalar(Field::pressure));
      for (std::size_t w = 0; w < geometry.contacts.size(); ++w) {
        require_non_negative(Scheme::info, "pressure", geometry.contacts[w].pressure, w);
      }
    }
  }

  struct NoWeights {};
  std::conditional_t<has_own_weights, QuadraticWeights<Dim>, NoWeights> weights_;
  int threads_ = 1;  ///< of the pass that was begun last
  bool is_frozen_ = false;
  std::vector<double> conductance_;             ///< per pair, once frozen
  std::vector<std::vector<Value>> wall_terms_;  ///< per wall and contact
  std::vector<Value> exchanged_;
  std::vector<std::vector<Vector<Dim>>> no_acceleration_;
  std::vector<Vector<Dim>> no_force_;
  std::vector<double> no_power_;
};

/// What to hand to add_scheme.
template <class Scheme>
SchemePart scheme_part() {
  static_assert(IsScheme<Scheme>, "a scheme has a constexpr `info`, in `passes` the code of the first passes that it names, and "
                                  "reads of pass_... only what these write, and the fields from which walls take what they do "
                                  "not prescribe (formulations/scheme.hpp)");
  return {.info = &Scheme::info,
          .in_1d = [] { return std::unique_ptr<RateOperator<1>>(std::make_unique<SchemeOperator<Scheme, 1>>()); },
          .in_2d = [] { return std::unique_ptr<RateOperator<2>>(std::make_unique<SchemeOperator<Scheme, 2>>()); },
          .in_3d = [] { return std::unique_ptr<RateOperator<3>>(std::make_unique<SchemeOperator<Scheme, 3>>()); }};
}

}  // namespace sphverify
