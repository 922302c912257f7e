// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/sweep/pair_sweep.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <functional>
#include <numeric>
#include <set>
#include <string>

#include "formulations/all.hpp"
#include "formulations/density/continuity.hpp"
#include "formulations/density/density.hpp"
#include "formulations/kernels/all.hpp"
#include "formulations/viscosity/viscosity.hpp"
#include "tests/support/dense.hpp"
#include "tests/support/gathered_pairs.hpp"

BOOST_AUTO_TEST_SUITE(formulations_sweep_pair_sweep)

using namespace sphverify;
using namespace sphverify::tests;

constexpr double round_off = 1e-12;  ///< of the largest number
MonaghanViscosity const viscosity{.alpha = 0.8, .beta = 1.7};
RiemannViscosity const riemann{1.4};
bool is_viscosity(std::string const& name) { return name == "viscosity" || name == "riemann viscosity"; }

/// Fields, also those that only a second pass or viscosity reads.
template <int Dim>
void fill_fields(Particles<Dim>& particles, Random& random) {
  randomise_fields(particles, random);
  particles.allocate(Field::sound_speed);
  for (double& c : particles.scalar(Field::sound_speed)) c = random.uniform(0.3, 2.0);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    particles.vector(Field::flux).set(i, random.vector<Dim>(-1.0, 1.0));
  }
  Random of_passes(23);  // by itself, so that other fields are what they were without
  particles.allocate({Field::pass_number, Field::pass_tensor});
  for (std::size_t i = 0; i < particles.size(); ++i) {
    particles.scalar(Field::pass_number)[i] = of_passes.uniform(0.5, 1.5);
    for (int n = 0; n < TensorField<Dim>::components; ++n)
      particles.tensor(Field::pass_tensor).component(n)[i] = of_passes.uniform(-1.0, 1.0);
  }
}

template <int Dim>
void vary_lengths(Particles<Dim>& particles, Random& random) {
  particles.vary_smoothing_length();
  for (double& h : particles.smoothing_lengths()) h *= random.uniform(0.6, 1.0);
}

/// Of rows: nothing, less than a pack, packs and a rest, just what a batch holds, more.
std::vector<std::size_t> const row_lengths{0, 1, 3, 4, 5, 8, 23, batch_pairs, batch_pairs + 1};

/// Clusters out of reach of each other. Within one all are neighbours, so that a row is as long as its
/// cluster less one. Particles of a cluster do not follow each other.
template <int Dim>
RandomScene<Dim> clusters(std::uint64_t seed) {
  std::size_t const count = std::accumulate(row_lengths.begin(), row_lengths.end(), row_lengths.size());
  Random random(seed);
  double const h = 0.1;
  RandomScene<Dim> scene{.particles = Particles<Dim>(count, h),
                   .domain = {.lower = Vector<Dim>::Zero(), .upper = Vector<Dim>::Ones()}};
  std::vector<Vector<Dim>> places;
  for (std::size_t c = 0; c < row_lengths.size(); ++c) {
    Vector<Dim> centre = Vector<Dim>::Zero();
    centre[0] = static_cast<double>(c);
    for (std::size_t n = 0; n <= row_lengths[c]; ++n) {
      places.push_back(centre + random.uniform(0.0, 0.99 * h) * random.direction<Dim>());
    }
  }
  for (std::size_t n = count; n > 1; --n) {
    std::swap(places[n - 1], places[static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(n)))]);
  }
  for (std::size_t i = 0; i < count; ++i) scene.particles.positions().set(i, places[i]);
  fill_fields(scene.particles, random);
  return scene;
}

enum class Box { open, along_axes, turned };

/// Particles at random places of a unit box, all axes but perhaps the last periodic, in a box that may be
/// turned.
template <int Dim>
RandomScene<Dim> in_box(std::uint64_t seed, std::size_t count, Box box, bool last_is_periodic = true) {
  Random random(seed);
  double const h = Dim == 1 ? 1.3 / static_cast<double>(count) : (Dim == 2 ? 0.14 : 0.2);
  RandomScene<Dim> scene{.particles = Particles<Dim>(count, h),
                   .domain = {.lower = Vector<Dim>::Constant(-0.3), .upper = Vector<Dim>::Constant(0.7)}};
  if (box != Box::open) scene.domain.periodic.fill(true);
  scene.domain.periodic[Dim - 1] = scene.domain.periodic[Dim - 1] && last_is_periodic;
  if (box == Box::turned) scene.domain.axes = Dim == 2 ? random.rotation<Dim>() : random.reflection<Dim>();
  for (std::size_t i = 0; i < count; ++i) {
    scene.particles.positions().set(i, scene.domain.to_space(random.vector<Dim>(-0.3, 0.7)));
  }
  fill_fields(scene.particles, random);
  return scene;
}

constexpr std::string_view cubic = "cubic-spline";

/// A term of the sweep, by the name of what it sums.
struct Term {
  std::string name;
  TermLoops const* loops;
  FieldSet reads;
  KernelWeightSet kernel;
  int components;
  void const* parameters;
};

/// The loops of an instruction set.
template <int Dim>
struct InstructionSet {
  SweepLoops const& sweep;
  std::vector<SchemeLoops const*> schemes;  ///< in the order of AllSchemes, then the continuity equation
  std::vector<std::pair<std::string_view, KernelColumns>> kernels;

  KernelColumns kernel(std::string_view id) const {
    return std::ranges::find(kernels, id, [](auto const& one) { return one.first; })->second;
  }
};
#define SPHVERIFY_TEST_SET(set)                                                                                              \
  template <int Dim>                                                                                                         \
  InstructionSet<Dim> set##_loops() {                                                                                        \
    auto schemes = std::apply(                                                                                               \
        [](auto... scheme) { return std::vector<SchemeLoops const*>{&set::scheme_loops<decltype(scheme), Dim>()...}; },      \
        AllSchemes{});                                                                                                       \
    schemes.push_back(&set::scheme_loops<ContinuityDensity, Dim>());                                                         \
    auto const kernels = []<template <int> class... Kernels>(KernelPack<Kernels...>) {                                      \
      return std::vector<std::pair<std::string_view, KernelColumns>>{                                                        \
          {Kernels<Dim>::id, set::kernel_columns<Kernels<Dim>, Dim>()}...};                                                  \
    }(AllKernels{});                                                                                                         \
    return {set::sweep_loops<Dim>(), schemes, kernels};                                                                      \
  }
SPHVERIFY_TEST_SET(baseline)
#if defined(__x86_64__)
SPHVERIFY_TEST_SET(avx2)
#endif

bool has_avx2() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
  return false;
#endif
}

/// What sweeps take.
template <int Dim>
InstructionSet<Dim> best_loops() {
#if defined(__x86_64__)
  if (has_avx2()) return avx2_loops<Dim>();
#endif
  return baseline_loops<Dim>();
}

template <int Dim>
std::vector<InstructionSet<Dim>> all_instruction_sets() {
  std::vector<InstructionSet<Dim>> sets{baseline_loops<Dim>()};
#if defined(__x86_64__)
  if (has_avx2()) sets.push_back(avx2_loops<Dim>());
#endif
  return sets;
}

template <int Dim>
std::vector<Term> all_terms(InstructionSet<Dim> const& set = best_loops<Dim>()) {
  std::vector<Term> terms;
  auto const infos = all_scheme_infos();
  for (std::size_t s = 0; s < infos.size(); ++s) {
    SchemeInfo const& info = *infos[s];
    if (reads_face_offsets(info)) continue;  // has no sense with a kernel; tested on cells
    FieldSet written{Field::mass};
    auto const& loops = set.schemes[s]->passes;
    std::size_t n = 0;
    for (PassInfo const& pass : info.first_passes) {
      int const components = sphverify::info(pass.writes).components(Dim);
      terms.push_back({std::string(info.id) + " " + std::string(pass.name), &loops[n++], pass.reads | written, pass.kernel,
                       components, nullptr});
      written.insert(pass.writes);
    }
    int const components = info.rate == Rate::acceleration ? Dim : 1;
    terms.push_back({std::string(info.id), &loops[n], info.reads | written, info.kernel, components, nullptr});
  }
  terms.push_back({"continuity", &set.schemes.back()->passes[0], ContinuityDensity::info.reads | FieldSet{Field::mass},
                   ContinuityDensity::info.kernel, 1, nullptr});
  terms.push_back({"density", &set.sweep.density, {Field::mass}, {}, 1, nullptr});
  terms.push_back({"viscosity",
                   &set.sweep.viscosity,
                   {Field::mass, Field::density, Field::velocity, Field::sound_speed},
                   {KernelWeight::gradient},
                   Dim + 2,
                   &viscosity});
  terms.push_back({"riemann viscosity",
                   &set.sweep.riemann_viscosity,
                   {Field::mass, Field::density, Field::velocity, Field::sound_speed},
                   {KernelWeight::gradient},
                   Dim + 2,
                   &riemann});
  terms.push_back({"approach", &set.sweep.approach, {Field::velocity}, {}, 1, nullptr});
  return terms;
}

FieldSet union_of(std::vector<Term> const& terms) {
  FieldSet reads;
  for (Term const& term : terms) reads = reads | term.reads;
  return reads;
}

/// Per term and component, one number per particle.
using Sums = std::vector<std::vector<std::vector<double>>>;

Sums room_for(std::vector<Term> const& terms, std::size_t count) {
  Sums sums;
  for (Term const& term : terms) {
    sums.emplace_back(static_cast<std::size_t>(term.components), std::vector<double>(count, 99.0));
  }
  return sums;
}

/// In as many sweeps as it takes: one holds most_terms.
template <int Dim>
Sums swept(RandomScene<Dim> const& scene, NeighbourList const& list, std::vector<Term> const& terms,
           int threads = 1, VectorField<Dim> const* state_velocity = nullptr) {
  Sums sums = room_for(terms, scene.particles.size());
  for (std::size_t first = 0; first < terms.size(); first += most_terms) {
    PairSweep<Dim> sweep(list, scene.domain, threads);
    for (std::size_t t = first; t < std::min(first + most_terms, terms.size()); ++t) {
      std::vector<double*> out;
      for (auto& component : sums[t]) out.push_back(component.data());
      sweep.add(*terms[t].loops, terms[t].reads, terms[t].kernel, out, terms[t].parameters);
    }
    sweep.run(scene.particles, state_velocity);
  }
  return sums;
}

std::vector<double> flat(std::vector<std::vector<double>> const& components) {
  std::vector<double> all;
  for (auto const& one : components) all.insert(all.end(), one.begin(), one.end());
  return all;
}

/// The same sums, by a double loop over all particles and all their images.
template <int Dim>
class DenseSums {
 public:
  explicit DenseSums(RandomScene<Dim> const& scene, VectorField<Dim> const* state_velocity = nullptr)
      : s_(scene), domain_(scene.domain), h_(scene.particles) {
    if (state_velocity) {
      u_ = *state_velocity;
    } else {
      u_ = scene.particles.vector(Field::velocity);
    }
    for (std::size_t i = 0; i < s_.particles(); ++i) {
      for (std::size_t j = 0; j < s_.particles(); ++j) {
        Vector<Dim> const r = separation(i, j);
        if (i != j && r.norm() < std::max(h_.support(i), h_.support(j))) near_.push_back({i, j, r});
      }
    }
  }

  std::vector<std::vector<double>> of(Term const& term) const {
    auto const components = static_cast<std::size_t>(term.components);
    std::vector<std::vector<double>> sums(components, std::vector<double>(s_.particles(), 0.0));
    bool const by_either = term.name.find("-grad-h") != std::string::npos;
    for (auto const& [i, j, r] : near_) {
      if (!by_either && r.norm() >= h_.support(i, j)) continue;
      std::vector<double> const add = pair(term.name, i, j, r);
      if (add.size() != components) BOOST_FAIL(term.name << " has " << add.size() << " components");
      for (std::size_t k = 0; k < components; ++k) {
        bool const greatest = term.name == "approach" || (is_viscosity(term.name) && k + 1 == components);
        sums[k][i] = greatest ? std::max(sums[k][i], add[k]) : sums[k][i] + add[k];
      }
    }
    return sums;
  }

  /// The shortest of all images of the box and those around it.
  Vector<Dim> separation(std::size_t i, std::size_t j) const {
    Vector<Dim> const direct = s_.x(i) - s_.x(j);
    Vector<Dim> best = direct;
    int images = 1;
    for (int k = 0; k < Dim; ++k) images *= 3;
    for (int image = 0; image < images; ++image) {
      Vector<Dim> moved = direct;
      int rest = image;
      for (int k = 0; k < Dim; ++k, rest /= 3) {
        if (domain_.periodic[static_cast<std::size_t>(k)]) {
          moved += (rest % 3 - 1) * domain_.extent()[k] * domain_.axes.col(k);
        }
      }
      if (moved.norm() < best.norm()) best = moved;
    }
    return best;
  }

 private:
  static std::vector<double> list(Vector<Dim> const& v) { return {v.data(), v.data() + Dim}; }

  /// dW/dr: of the cubic spline as written down a second time, of others as their polynomials have it.
  double slope(double r, double h) const {
    Kernel const& kernel = h_.kernel();
    return kernel.id() == cubic ? dense::slope<Dim>(r, h) : r * kernel.radial(r, h);
  }
  double value(double r, double h) const {
    Kernel const& kernel = h_.kernel();
    return kernel.id() == cubic ? dense::kernel<Dim>(r, h) : kernel.value(r, h);
  }

  /// equations.md, without walls.
  std::vector<double> pair(std::string const& name, std::size_t i, std::size_t j,
                           Vector<Dim> const& r) const {
    double const m = s_.m(j), rho_i = s_.rho(i), rho_j = s_.rho(j);
    double const P_i = s_.P(i), P_j = s_.P(j), T_i = s_.T(i), T_j = s_.T(j), K_i = s_.K(i), K_j = s_.K(j);
    Vector<Dim> const v_i = s_.v(i), v_j = s_.v(j);
    Vector<Dim> const F_i = s_.F(i), F_j = s_.F(j);
    double const h = h_(i, j);
    Vector<Dim> const W = slope(r.norm(), h) * r / r.norm();
    auto const over_square = [](double f, double rho) { return f / (rho * rho); };
    double const both_P = over_square(P_j, rho_j) + over_square(P_i, rho_i);
    if (name == "momentum/p-rho2") return list(-m * both_P * W);
    auto const by_own = [&](std::size_t of) { return Vector<Dim>(slope(r.norm(), h_(of)) * r / r.norm()); };
    double const own_share = over_square(P_i, rho_i) / s_.Omega(i);
    if (name == "momentum/p-rho2-grad-h")
      return list(-m * (own_share * by_own(i) + over_square(P_j, rho_j) / s_.Omega(j) * by_own(j)));
    if (name == "work/p-rho2-grad-h") return {m * own_share * (v_i - v_j).dot(by_own(i))};
    if (name == "momentum/gdsph") return list(-m * (P_i + P_j) / (rho_i * rho_j) * W);
    if (name == "work/gdsph") return {m * P_i / (rho_i * rho_j) * (v_i - v_j).dot(W)};
    if (name.ends_with("smoothed-pressure")) return {m * P_j / rho_j * value(r.norm(), h)};
    double const product = P_i / rho_i * m * P_j / rho_j;
    if (name == "momentum/pressure-energy") return list(-product * (1.0 / s_.number(i) + 1.0 / s_.number(j)) * W);
    if (name == "work/pressure-energy") return {product / s_.number(i) * (v_i - v_j).dot(W)};
    if (name.ends_with("missing-surface")) return list(-m / rho_j * (s_.tensor(i) + s_.tensor(j)) * W);
    if (name == "momentum/rkgc") return list(-m / (rho_i * rho_j) * (P_i * s_.tensor(j) + P_j * s_.tensor(i)) * W);
    if (name == "work/rkgc") return {m * P_i / (rho_i * rho_j) * (v_i - v_j).dot(s_.tensor(j) * W)};
    if (name == "momentum/sqrt-p")
      return list(-2.0 * std::sqrt(P_i) / rho_i * m * std::sqrt(P_j) / rho_j * W);
    if (name == "momentum/direct-gradient") return list(-1.0 / rho_i * m * P_j / rho_j * W);
    if (name == "work/total-energy") {
      return {-m * (over_square(P_j, rho_j) * v_j + over_square(P_i, rho_i) * v_i).dot(W)};
    }
    if (name == "work/internal-energy") return {-m * over_square(P_j, rho_j) * (v_j - v_i).dot(W)};
    if (name == "work/sqrt-p") {
      return {-std::sqrt(P_i) / rho_i * m * std::sqrt(P_j) / rho_j * (v_j - v_i).dot(W)};
    }
    if (name == "conduction/brookshaw") {
      return {m * (K_i + K_j) / (rho_i * rho_j) * (T_i - T_j) * r.dot(W) / r.squaredNorm()};
    }
    double const radial = r.dot(W) / r.squaredNorm();
    if (name == "conduction/cleary-monaghan") {
      return {m * 4.0 / (1.0 / K_i + 1.0 / K_j) / (rho_i * rho_j) * (T_i - T_j) * radial};
    }
    if (name == "conduction/gamma-brookshaw gamma") return {m / rho_j * value(r.norm(), h)};
    if (name == "conduction/gamma-brookshaw") return {m * (K_i + K_j) / (rho_i * rho_j) * (T_i - T_j) * radial / s_.number(i)};
    if (name == "conduction/gmls") return {0.5 * (K_i + K_j) / rho_i * (T_j - T_i) * radial};
    if (name.ends_with("correction-matrix")) {
      Tensor<Dim> const moment = m / rho_j * -r * W.transpose();
      std::vector<double> elements(TensorField<Dim>::components);
      for (int l = 0; l < Dim; ++l)
        for (int k = 0; k <= l; ++k) elements[static_cast<std::size_t>(tensor_index(k, l))] = moment(k, l);
      return elements;
    }
    if (name == "conduction/corrected-flux flux") return list(m / rho_j * (T_j - T_i) * W);
    if (name == "conduction/corrected-flux") return {-m / (rho_i * rho_j) * (F_j - F_i).dot(s_.tensor(i) * W)};
    // What multiplies the whole sum of a first pass is not the sweep's.
    if (name == "conduction/lucy-flux flux") return list(m / rho_j * T_j * W);
    if (name == "conduction/lucy-flux") return {-1.0 / rho_i * m / rho_j * F_j.dot(W)};
    if (name == "conduction/campbell-flux flux") {
      return list(m * (over_square(T_j, rho_j) + over_square(T_i, rho_i)) * W);
    }
    if (name == "conduction/campbell-flux") {
      return {-m * (F_j / (rho_j * rho_j) + F_i / (rho_i * rho_i)).dot(W)};
    }
    if (name == "continuity") return {m * (v_i - v_j).dot(W)};
    if (name == "density") return {m * value(r.norm(), h)};
    Vector<Dim> const u = u_[i] - u_[j];
    if (name == "approach") return {-u.dot(r) / (r.squaredNorm() + (Dim > 1 ? 0.01 * h * h : 0.0))};
    if (!is_viscosity(name)) return {};
    double const c = 0.5 * (s_.c(i) + s_.c(j));
    double const rho = 0.5 * (rho_i + rho_j);
    double mu = 0.0, Pi = 0.0;
    if (u.dot(r) < 0.0 && name == "viscosity") {
      mu = h * u.dot(r) / (r.squaredNorm() + 0.01 * h * h);
      Pi = (-viscosity.alpha * c * mu + viscosity.beta * mu * mu) / rho;
    } else if (u.dot(r) < 0.0) {
      mu = u.dot(r) / r.norm();
      double const w = -0.5 * mu, b = 0.25 * (riemann.gamma + 1.0);
      Pi = 2.0 * w / rho * (b * w + std::hypot(b * w, c));
    }
    std::vector<double> rates = list(-m * Pi * W);
    rates.push_back(0.5 * m * Pi * u.dot(W));
    rates.push_back(-mu);
    return rates;
  }

  /// Reads the particles; the scene outlives it.
  struct Reader : dense::State<Dim> {
    explicit Reader(RandomScene<Dim> const& scene) : dense::State<Dim>(scene), particles_(&scene.particles) {}
    Vector<Dim> F(std::size_t i) const { return particles_->vector(Field::flux)[i]; }
    double c(std::size_t i) const { return particles_->scalar(Field::sound_speed)[i]; }
    double number(std::size_t i) const { return particles_->scalar(Field::pass_number)[i]; }
    Tensor<Dim> tensor(std::size_t i) const { return particles_->tensor(Field::pass_tensor)[i]; }
    Particles<Dim> const* particles_;
  };

  struct Near {
    std::size_t i, j;
    Vector<Dim> r;
  };

  Reader s_;
  Domain<Dim> const& domain_;
  SmoothingLength h_;
  VectorField<Dim> u_;
  std::vector<Near> near_;  ///< within the larger of two supports
};

/// Largest deviation of any term from the dense sums, relative to the term's largest.
template <int Dim>
void check_against_dense_sums(RandomScene<Dim> const& scene, NeighbourList const& list,
                              VectorField<Dim> const* state_velocity = nullptr) {
  std::vector<Term> const terms = all_terms<Dim>();
  Sums const found = swept(scene, list, terms, 1, state_velocity);
  DenseSums<Dim> const dense_sums(scene, state_velocity);
  for (std::size_t t = 0; t < terms.size(); ++t) {
    BOOST_TEST(relative_difference(flat(found[t]), flat(dense_sums.of(terms[t]))) < round_off, terms[t].name);
  }
}

template <int Dim>
NeighbourList list_of(RandomScene<Dim> const& scene) {
  return geometry_of(scene, false, PairSupport::larger).neighbours;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(every_term_is_its_dense_sum_over_rows_of_every_length, D, Dimensions) {
  constexpr int Dim = D::value;
  for (bool const own_lengths : {false, true}) {
    RandomScene<Dim> scene = clusters<Dim>(1);
    Random random(2);
    if (own_lengths) vary_lengths(scene.particles, random);
    NeighbourList const list = list_of(scene);
    if (!own_lengths) {
      std::set<std::size_t> lengths;
      for (std::size_t i = 0; i < list.rows(); ++i) lengths.insert(list.row(i).size());
      BOOST_TEST((lengths == std::set<std::size_t>(row_lengths.begin(), row_lengths.end())));
    }
    BOOST_TEST_CONTEXT("own smoothing lengths " << own_lengths) check_against_dense_sums(scene, list);
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(every_term_is_its_dense_sum_in_open_and_periodic_and_turned_boxes, D,
                              Dimensions) {
  constexpr int Dim = D::value;
  for (Box const box : {Box::open, Box::along_axes, Box::turned}) {
    for (bool const last_is_periodic : {true, false}) {
      for (bool const own_lengths : {false, true}) {
        RandomScene<Dim> scene = in_box<Dim>(3, 150, box, last_is_periodic);
        Random random(4);
        if (own_lengths) vary_lengths(scene.particles, random);
        BOOST_TEST_CONTEXT("box " << static_cast<int>(box) << ", last axis periodic " << last_is_periodic
                                  << ", own smoothing lengths " << own_lengths)
        check_against_dense_sums(scene, list_of(scene));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_particle_alone_has_nothing_to_sum, D, Dimensions) {
  constexpr int Dim = D::value;
  RandomScene<Dim> const scene = in_box<Dim>(5, 1, Box::open);
  for (auto const& sums : swept(scene, list_of(scene), all_terms<Dim>())) {
    for (auto const& component : sums) BOOST_TEST((component == std::vector<double>{0.0}));
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(gradient_points_from_neighbour_to_particle_and_falls_with_distance, D,
                              Dimensions) {
  constexpr int Dim = D::value;
  for (Box const box : {Box::open, Box::along_axes, Box::turned}) {
    RandomScene<Dim> const scene = in_box<Dim>(6, 120, box);
    PairGeometry<Dim> const geometry = geometry_of(scene, false);
    GatheredPairs<Dim> const pairs = gathered_pairs(scene.particles, geometry);
    DenseSums<Dim> const dense_sums(scene);
    double const h = scene.particles.smoothing_length();
    double const scale = dense::kernel<Dim>(0.0, h) / h;
    BOOST_TEST_REQUIRE(geometry.neighbours.pairs() > 120u);
    double worst_separation = 0.0, worst_distance = 0.0, worst_gradient = 0.0;
    for (std::size_t i = 0; i < 120; ++i) {
      for (std::size_t k = geometry.neighbours.first[i]; k < geometry.neighbours.first[i + 1]; ++k) {
        Vector<Dim> const r = dense_sums.separation(i, geometry.neighbours.neighbour[k]);
        Vector<Dim> const expected = dense::slope<Dim>(r.norm(), h) * r / r.norm();
        worst_separation = std::max(worst_separation, (pairs.separation[k] - r).norm());
        worst_distance = std::max(worst_distance, std::abs(pairs.distance[k] - r.norm()));
        worst_gradient = std::max(worst_gradient, (pairs.gradient(k) - expected).norm());
      }
    }
    BOOST_TEST(worst_separation < 1e-15);
    BOOST_TEST(worst_distance < 1e-15);
    BOOST_TEST(worst_gradient < 1e-13 * scale);
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(gradient_is_exactly_antisymmetric, D, Dimensions) {
  constexpr int Dim = D::value;
  for (Box const box : {Box::open, Box::along_axes, Box::turned}) {
    RandomScene<Dim> const scene = in_box<Dim>(7, 120, box);
    PairGeometry<Dim> const geometry = geometry_of(scene, false);
    NeighbourList const& list = geometry.neighbours;
    GatheredPairs<Dim> const pairs = gathered_pairs(scene.particles, geometry);
    bool exact = true;
    for (std::uint32_t i = 0; i < 120; ++i) {
      for (std::size_t k = list.first[i]; k < list.first[i + 1]; ++k) {
        auto const row = list.row(list.neighbour[k]);
        auto const back = std::ranges::find(row, i);
        BOOST_TEST_REQUIRE((back != row.end()));
        std::size_t const other =
            list.first[list.neighbour[k]] + static_cast<std::size_t>(back - row.begin());
        exact = exact && (pairs.separation[k] + pairs.separation[other]).norm() == 0.0 &&
                pairs.radial[k] == pairs.radial[other];
      }
    }
    BOOST_TEST(exact);
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(lanes_that_fill_up_a_row_add_nothing, D, Dimensions) {
  constexpr int Dim = D::value;
  RandomScene<Dim> const scene = clusters<Dim>(8);
  PairGeometry<Dim> const geometry = geometry_of(scene, false);
  GatheredPairs<Dim> const pairs = gathered_pairs(scene.particles, geometry);
  BOOST_TEST(pairs.idle_lanes_add_nothing);
  BOOST_TEST(pairs.whole_packs);
}

BOOST_AUTO_TEST_CASE(separation_crosses_a_periodic_boundary_the_short_way) {
  RandomScene<1> scene{.particles = Particles<1>(2, 0.1),
                 .domain = {.lower = Vector<1>(0.0), .upper = Vector<1>(1.0), .periodic = {true}}};
  scene.particles.positions().component(0) = {0.05, 0.95};
  scene.particles.allocate(all_fields);
  GatheredPairs<1> const pairs = gathered_pairs(scene.particles, geometry_of(scene));
  BOOST_TEST_REQUIRE(pairs.radial.size() == 2u);
  // r = +h
  BOOST_TEST(pairs.gradient(0)[0] == -0.5 / (0.1 * 0.1), boost::test_tools::tolerance(1e-12));
  BOOST_TEST(pairs.gradient(1)[0] == 0.5 / (0.1 * 0.1), boost::test_tools::tolerance(1e-12));
}

// Loops that were made for certain records or several terms differ from the others by round-off.
BOOST_AUTO_TEST_CASE_TEMPLATE(terms_of_one_sweep_give_what_each_gives_alone, D, Dimensions) {
  constexpr int Dim = D::value;
  for (bool const own_lengths : {false, true}) {
    for (bool const turned : {false, true}) {
      RandomScene<Dim> scene = turned ? in_box<Dim>(9, 150, Box::turned) : clusters<Dim>(9);
      Random random(10);
      if (own_lengths) vary_lengths(scene.particles, random);
      NeighbourList const list = list_of(scene);
      std::vector<Term> terms = all_terms<Dim>();
      // Companies of different terms, so that records are of different lengths.
      for (int company = 0; company < 3; ++company) {
        std::rotate(terms.begin(), terms.begin() + 5, terms.end());
        Sums const together = swept(scene, list, terms);
        for (std::size_t t = 0; t < terms.size(); ++t) {
          auto const alone = flat(swept(scene, list, {terms[t]})[0]);
          BOOST_TEST(relative_difference(flat(together[t]), alone) < 1e-13, terms[t].name);
        }
      }
    }
  }
}

/// The terms that a loop was made for.
std::vector<Term> terms_of(LoopOfSeveral const& several, std::vector<Term> const& all) {
  std::vector<Term> found;
  for (BatchFunction const sum : several.terms) {
    if (!sum) break;
    auto const at = std::ranges::find_if(all, [&](Term const& term) { return term.loops->sum == sum; });
    BOOST_TEST_REQUIRE((at != all.end()));
    found.push_back(*at);
  }
  return found;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(companies_that_have_a_loop_of_their_own_are_dense_sums_too, D, Dimensions) {
  constexpr int Dim = D::value;
  std::vector<RandomScene<Dim>> scenes{clusters<Dim>(26), in_box<Dim>(26, 150, Box::along_axes)};
  std::size_t companies = 0;
  for (RandomScene<Dim> const& scene : scenes) {
    NeighbourList const list = list_of(scene);
    DenseSums<Dim> const dense_sums(scene);
    std::vector<Term> const all = all_terms<Dim>();
    std::vector<std::vector<double>> expected;
    for (Term const& term : all) expected.push_back(flat(dense_sums.of(term)));
    for (LoopOfSeveral const& several : loops_of_sweep<Dim>().of_several) {
      std::vector<Term> const terms = terms_of(several, all);
      ++companies;
      Sums const found = swept(scene, list, terms);
      for (std::size_t t = 0; t < terms.size(); ++t) {
        auto const which =
            std::ranges::find_if(all, [&](Term const& one) { return one.name == terms[t].name; });
        BOOST_TEST(relative_difference(flat(found[t]),
                                       expected[static_cast<std::size_t>(which - all.begin())]) < round_off,
                   terms[t].name << " in a company of " << terms.size());
      }
    }
  }
  BOOST_TEST((companies > 0u || !has_avx2()));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(pairs_beyond_the_support_add_nothing, D, Dimensions) {
  constexpr int Dim = D::value;
  std::vector<Term> const terms = all_terms<Dim>();
  for (Box const box : {Box::open, Box::along_axes, Box::turned}) {
    for (bool const own_lengths : {false, true}) {
      RandomScene<Dim> scene = in_box<Dim>(11, 150, box);
      Random random(12);
      if (own_lengths) vary_lengths(scene.particles, random);
      SmoothingLength const h(scene.particles);
      double const skin = Dim == 3 ? 0.2 : 0.3;
      CellGrid<Dim> const grid(scene.particles.positions(), scene.domain, 2.0 * (1.0 + skin) * h.largest());
      NeighbourList const wide = find_neighbours(grid, h, skin, 1, {}, PairSupport::larger);
      NeighbourList const narrow = list_of(scene);
      BOOST_TEST(wide.pairs() > narrow.pairs() + 20);
      Sums const found = swept(scene, wide, terms);
      Sums const expected = swept(scene, narrow, terms);
      for (std::size_t t = 0; t < terms.size(); ++t) {
        BOOST_TEST(relative_difference(flat(found[t]), flat(expected[t])) < 1e-13, terms[t].name);
      }
    }
  }
}

// Where slopes are stored they may be of pairs farther apart than the kernel reaches: these rub and approach like all others.
BOOST_AUTO_TEST_CASE_TEMPLATE(stored_slopes_end_nowhere, D, Dimensions) {
  constexpr int Dim = D::value;
  RandomScene<Dim> scene = in_box<Dim>(51, 150, Box::along_axes);
  NeighbourList list = list_of(scene);
  std::vector<Term> terms;
  for (Term const& term : all_terms<Dim>()) {
    if (is_viscosity(term.name) || term.name == "approach" || term.name == "work/internal-energy") terms.push_back(term);
  }
  BOOST_TEST(terms.size() == 4u);
  Sums const expected = swept(scene, list, terms);
  // The same slopes, of particles whose own kernel reaches half as far.
  GatheredPairs<Dim> const pairs = gathered_pairs(scene.particles, geometry_of(scene, false));
  BOOST_TEST_REQUIRE(pairs.radial.size() == list.pairs());
  for (double const slope : pairs.radial) list.slope.push_back(slope);
  double const h = scene.particles.smoothing_length();
  RandomScene<Dim> narrow{.particles = Particles<Dim>(150, 0.5 * h), .domain = scene.domain};
  narrow.particles.positions() = scene.particles.positions();
  narrow.particles.allocate(all_fields);
  narrow.particles.masses() = scene.particles.masses();
  for (Field const field : {Field::density, Field::pressure, Field::sound_speed})
    narrow.particles.scalar(field) = scene.particles.scalar(field);
  narrow.particles.vector(Field::velocity) = scene.particles.vector(Field::velocity);
  Sums const found = swept(narrow, list, terms);
  for (std::size_t t = 0; t < terms.size(); ++t) {
    // Beside slopes and separations viscosity and approach read h of the pair.
    if (terms[t].name == "work/internal-energy") {
      BOOST_TEST(relative_difference(flat(found[t]), flat(expected[t])) < round_off, terms[t].name);
      continue;
    }
    for (std::size_t i = 0; i < 150; ++i) {
      bool approaches = false;
      for (std::uint32_t const j : list.row(i)) {
        Vector<Dim> const r = scene.domain.nearest_image(scene.particles.positions()[i] - scene.particles.positions()[j]);
        approaches = approaches || (scene.particles.vector(Field::velocity)[i] - scene.particles.vector(Field::velocity)[j]).dot(r) < 0.0;
      }
      BOOST_TEST((found[t].back()[i] > 0.0) == approaches, terms[t].name << " of particle " << i);
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(threads_do_not_change_a_bit, D, Dimensions) {
  constexpr int Dim = D::value;
  // Five blocks of 1024, so that several threads really share them.
  RandomScene<Dim> scene = random_scene<Dim>(13, 5000);
  Random random(14);
  fill_fields(scene.particles, random);
  PairGeometry<Dim> const geometry = geometry_of(scene, false);
  std::vector<Term> const terms = all_terms<Dim>();
  Sums const one = swept(scene, geometry.neighbours, terms, 1);
  auto const infos = all_scheme_infos();
  for (int const threads : {2, 4}) {
    Sums const several = swept(scene, geometry.neighbours, terms, threads);
    for (std::size_t t = 0; t < terms.size(); ++t) {
      BOOST_TEST(same_bits(flat(several[t]), flat(one[t])), terms[t].name << " at " << threads << " threads");
    }
    for (std::size_t s = 0; s < infos.size(); ++s) {
      auto const of_batch = best_loops<Dim>().schemes[s]->conductance;
      if (!of_batch) continue;
      FieldSet const reads = infos[s]->reads | FieldSet{Field::mass};
      BOOST_TEST(same_bits(PairSweep<Dim>(geometry.neighbours, geometry.domain, threads)
                               .conductances(of_batch, reads, scene.particles),
                           PairSweep<Dim>(geometry.neighbours, geometry.domain, 1)
                               .conductances(of_batch, reads, scene.particles)));
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(density_over_a_list_is_a_dense_sum_with_the_particle_itself, D, Dimensions) {
  constexpr int Dim = D::value;
  for (Box const box : {Box::open, Box::along_axes, Box::turned}) {
    RandomScene<Dim> scene = in_box<Dim>(15, 150, box);
    NeighbourList const list = list_of(scene);
    DenseSums<Dim> const dense_sums(scene);
    std::vector<double> expected(150, 0.0);
    for (std::size_t i = 0; i < 150; ++i) {
      for (std::size_t j = 0; j < 150; ++j) {
        expected[i] += scene.particles.masses()[j] * dense::kernel<Dim>(dense_sums.separation(i, j).norm(),
                                                                        scene.particles.smoothing_length());
      }
    }
    sum_density(scene.particles, list, scene.domain, 1);
    std::vector<double> const one = scene.particles.scalar(Field::density);
    BOOST_TEST(relative_difference(one, expected) < 1e-13);
    sum_density(scene.particles, list, scene.domain, 2);
    BOOST_TEST(same_bits(scene.particles.scalar(Field::density), one));
  }
}

// Viscosity rubs with the velocity of the state where work is done with that of the drift.
BOOST_AUTO_TEST_CASE_TEMPLATE(terms_that_read_the_state_s_velocity_take_it_and_the_others_do_not, D,
                              Dimensions) {
  constexpr int Dim = D::value;
  RandomScene<Dim> const scene = in_box<Dim>(16, 150, Box::along_axes);
  NeighbourList const list = list_of(scene);
  Random random(17);
  VectorField<Dim> state(150);
  for (std::size_t i = 0; i < 150; ++i) state.set(i, random.vector<Dim>(-1.0, 1.0));
  check_against_dense_sums(scene, list, &state);
  std::vector<Term> const terms = all_terms<Dim>();
  Sums const with = swept(scene, list, terms, 1, &state);
  Sums const without = swept(scene, list, terms);
  for (std::size_t t = 0; t < terms.size(); ++t) {
    bool const takes_it = is_viscosity(terms[t].name) || terms[t].name == "approach";
    BOOST_TEST(same_bits(flat(with[t]), flat(without[t])) == !takes_it, terms[t].name);
  }
}

/// A scheme's heating by evaluations that are frozen after the first, at two temperatures.
template <int Dim>
std::vector<double> heating_twice(RandomScene<Dim> scene, std::string_view id, bool frozen, int threads) {
  auto const scheme = make_rate_operator<Dim>(id);
  scene.particles.allocate(needed_fields(scheme->info()));
  PairGeometry<Dim> geometry = geometry_of(scene);
  if (frozen) scheme->freeze(scene.particles, geometry, threads);
  bool const is_kept = frozen && scheme->info().difference_form;
  std::size_t const conductances = is_kept ? geometry.neighbours.pairs() * sizeof(double) : 0;
  // Weights of its own come with lists of their own.
  bool const is_right = scheme->info().least_squares ? scheme->bytes() >= 2 * conductances : scheme->bytes() == conductances;
  BOOST_TEST(is_right, id << ": " << scheme->bytes());
  WorkCount work;
  std::vector<double> rates;
  Random random(19);
  for (int n = 0; n < 2; ++n) {
    scheme->evaluate(scene.particles, geometry, scene.closure, scene.time, threads, work);
    auto const& now = scene.particles.scalar(Field::heating);
    rates.insert(rates.end(), now.begin(), now.end());
    for (double& T : scene.particles.scalar(Field::temperature)) T = random.uniform(0.5, 2.0);
  }
  BOOST_TEST(work.evaluations == 2u);
  std::size_t const passes = is_kept ? 1 : static_cast<std::size_t>(pass_count(scheme->info()));
  BOOST_TEST(work.pair_interactions == 2u * passes * geometry.neighbours.pairs());
  return rates;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(frozen_conductances_give_the_rates_that_positions_give, D, Dimensions) {
  constexpr int Dim = D::value;
  std::vector<RandomScene<Dim>> scenes;
  scenes.push_back(random_scene<Dim>(18, 60));  // with walls
  scenes.push_back(clusters<Dim>(18));
  scenes.push_back(in_box<Dim>(18, 150, Box::along_axes));
  scenes.push_back(in_box<Dim>(18, 150, Box::turned));
  std::size_t linear = 0;
  for (SchemeInfo const* scheme : all_scheme_infos()) {
    if (scheme->rate != Rate::conduction_heating) continue;
    linear += scheme->difference_form ? 1 : 0;
    for (RandomScene<Dim> const& narrow : scenes) {
      if (scheme->needs_partners && &narrow != &scenes.front()) continue;  // lone particles, or boxes too small for more
      RandomScene<Dim> const scene = scheme->needs_partners ? widened(narrow) : narrow;
      std::vector<double> const expected = heating_twice(scene, scheme->id, false, 1);
      std::vector<double> const found = heating_twice(scene, scheme->id, true, 1);
      BOOST_TEST(relative_difference(found, expected) < 1e-13, scheme->id);
      if (!scheme->difference_form) BOOST_TEST(same_bits(found, expected), scheme->id);
      BOOST_TEST(same_bits(heating_twice(scene, scheme->id, true, 2), found), scheme->id);
    }
  }
  BOOST_TEST(linear > 0u);
}

TermLoops const sum_values{.sum = [](Batch const& batch, RowTerm const* term) {
  for (std::size_t row = 0; row < batch.rows; ++row)
    term->outputs[0][batch.begin + row] = std::accumulate(batch.value + batch.first[row], batch.value + batch.first[row + 1], 0.0);
}, .components = 1};
void take_values(Batch const& batch, double* out) { std::copy_n(batch.value, batch.first[batch.rows], out); }

BOOST_AUTO_TEST_CASE_TEMPLATE(rows_have_the_kernel_s_own_value_at_the_mean_smoothing_length, D, Dimensions) {
  constexpr int Dim = D::value;
  for (KernelInfo const& info : all_kernel_infos()) {
    for (Box const box : {Box::open, Box::along_axes, Box::turned}) {
      for (bool const own_lengths : {false, true}) {
        RandomScene<Dim> scene = in_box<Dim>(41, 100, box);
        scene.particles.set_kernel(kernel(info.id, Dim));
        if (box != Box::open && 2.0 * info.support_ratio * scene.particles.smoothing_length() > 1.0) continue;
        Random random(42);
        if (own_lengths) vary_lengths(scene.particles, random);
        NeighbourList const list = list_of(scene);
        DenseSums<Dim> const dense_sums(scene);
        auto const& own = scene.particles.smoothing_lengths();
        auto const value = [&](std::size_t i, std::size_t j) {
          double const h = own_lengths ? 0.5 * (own[i] + own[j]) : scene.particles.smoothing_length();
          return scene.particles.kernel().value(dense_sums.separation(i, j).norm(), h);
        };
        std::vector<double> sums(list.rows(), 0.0), expected(list.rows(), 0.0), of_pairs;
        for (std::size_t i = 0; i < list.rows(); ++i) {
          for (std::uint32_t const j : list.row(i)) {
            of_pairs.push_back(value(i, j));
            expected[i] += of_pairs.back();
          }
        }
        PairSweep<Dim> sweep(list, scene.domain, 2);
        sweep.add(sum_values, {Field::mass}, {KernelWeight::value}, sums);
        sweep.run(scene.particles);
        BOOST_TEST(largest(expected) > 0.0);
        BOOST_TEST(relative_difference(sums, expected) < round_off, info.id);
        if (own_lengths) continue;
        PairSweep<Dim> frozen(list, scene.domain, 2);
        BOOST_TEST(relative_difference(frozen.conductances(take_values, {Field::mass}, scene.particles), of_pairs) < round_off,
                   info.id);
      }
    }
  }
}

/// Memory as the loops want it.
class Aligned {
 public:
  explicit Aligned(std::size_t count) : packs_(count / 4 + 1) {}
  double* data() { return packs_.front().lanes; }

 private:
  struct alignas(32) Four {
    double lanes[4] = {};
  };
  std::vector<Four> packs_;
};

/// A sweep with the loops of one instruction set.
template <int Dim>
class HandmadeSweep {
 public:
  HandmadeSweep(RandomScene<Dim> const& scene, NeighbourList const& list, FieldSet reads)
      : slots_(record_slots(reads, Dim, !scene.particles.smoothing_lengths().empty(), false)),
        stride_(slots_.stride()),
        n_(scene.particles.size()),
        list_(list),
        records_(stride_ * n_) {
    Particles<Dim> const& p = scene.particles;
    for (std::size_t i = 0; i < n_; ++i) {
      double* const record = records_.data() + i * stride_;
      auto const put = [&](int slot, double value) {
        if (slot >= 0) record[slot] = value;
      };
      auto const put_vector = [&](int slot, Vector<Dim> const& value) {
        for (int k = 0; slot >= 0 && k < Dim; ++k) record[slot + k] = value[k];
      };
      put_vector(0, p.positions()[i]);
      put(slots_.m, p.masses()[i]);
      put(slots_.rho, p.scalar(Field::density)[i]);
      put(slots_.per_rho, 1.0 / p.scalar(Field::density)[i]);
      put(slots_.P, p.scalar(Field::pressure)[i]);
      put(slots_.T, p.scalar(Field::temperature)[i]);
      put(slots_.K, p.scalar(Field::conductivity)[i]);
      put(slots_.c, p.scalar(Field::sound_speed)[i]);
      if (slots_.omega >= 0) put(slots_.omega, p.scalar(Field::omega)[i]);
      if (slots_.h >= 0) put(slots_.h, p.smoothing_lengths()[i]);
      put_vector(slots_.v, p.vector(Field::velocity)[i]);
      put_vector(slots_.F, p.vector(Field::flux)[i]);
      put(slots_.pass_number, p.scalar(Field::pass_number)[i]);
      for (int n = 0; slots_.pass_tensor >= 0 && n < TensorField<Dim>::components; ++n)
        record[slots_.pass_tensor + n] = p.tensor(Field::pass_tensor).component(n)[i];
    }
    plan_.slots = slots_;
    plan_.records = records_.data();
    plan_.stride = stride_;
    plan_.first = list.first.data();
    plan_.neighbour = list.neighbour.data();
    plan_.h = p.smoothing_length();
    plan_.support_ratio = p.kernel().support_ratio();
    kernel_ = p.kernel().id();
    plan_.wrapping = !scene.domain.is_periodic() ? Wrapping::none
                     : scene.domain.is_turned()  ? Wrapping::turned
                                                 : Wrapping::along_axes;
    for (int k = 0; k < Dim; ++k) {
      auto const at = static_cast<std::size_t>(k);
      for (int n = 0; n < Dim; ++n)
        plan_.axes[at * Dim + static_cast<std::size_t>(n)] = scene.domain.axes(n, k);
      if (!scene.domain.periodic[at]) continue;
      plan_.period[at] = scene.domain.extent()[k];
      plan_.inverse_period[at] = 1.0 / plan_.period[at];
    }
    plan_.wants_separation = true;
    plan_.wants_radial = true;
    plan_.wants_own_radial = true;
    plan_.wants_value = true;
  }

  /// By the loops that serve any records, most_terms at a time.
  Sums rows(InstructionSet<Dim> const& set, std::vector<Term> const& terms) {
    Sums sums = room_for(terms, n_);
    for (std::size_t first = 0; first < terms.size(); first += most_terms) {
      std::size_t const last = std::min(first + most_terms, terms.size());
      std::vector<RowTerm> row_terms;
      std::vector<BatchFunction> loops;
      std::vector<std::size_t> loop_terms;
      for (std::size_t t = first; t < last; ++t) {
        row_terms.push_back(row_term(terms[t], sums[t]));
        loops.push_back(terms[t].loops->sum);
        loop_terms.push_back(t - first);
      }
      run(set, row_terms, loops, loop_terms);
    }
    return sums;
  }

  /// By one loop for all of them.
  Sums rows(InstructionSet<Dim> const& set, std::vector<Term> const& terms, BatchFunction loop) {
    Sums sums = room_for(terms, n_);
    std::vector<RowTerm> row_terms;
    for (std::size_t t = 0; t < terms.size(); ++t) row_terms.push_back(row_term(terms[t], sums[t]));
    run(set, row_terms, {loop}, {0});
    return sums;
  }

  std::vector<double> conductances(InstructionSet<Dim> const& set, std::size_t scheme) {
    std::vector<double> all(list_.pairs());
    plan_.kernel = set.kernel(kernel_);
    Aligned scratch(scratch_size(capacity_));
    set.sweep.conductances(plan_, set.schemes[scheme]->conductance, 0, n_, capacity_, scratch.data(), all.data());
    return all;
  }

 private:
  static RowTerm row_term(Term const& term, std::vector<std::vector<double>>& sums) {
    RowTerm made{term.loops, term.parameters, {}};
    for (std::size_t k = 0; k < sums.size(); ++k) made.outputs[k] = sums[k].data();
    return made;
  }

  /// In two parts, as threads do.
  void run(InstructionSet<Dim> const& set, std::vector<RowTerm> const& terms, std::vector<BatchFunction> const& loops,
           std::vector<std::size_t> const& loop_terms) {
    plan_.terms = terms.data();
    plan_.loops = loops.data();
    plan_.loop_terms = loop_terms.data();
    plan_.loop_count = loops.size();
    plan_.kernel = set.kernel(kernel_);
    Aligned scratch(scratch_size(capacity_));
    for (auto const& [begin, end] : {std::pair{std::size_t{0}, n_ / 3}, std::pair{n_ / 3, n_}})
      set.sweep.rows(plan_, begin, end, capacity_, scratch.data());
  }

  static constexpr std::size_t capacity_ = 4 * batch_pairs;  // more than any row of these tests has
  std::string_view kernel_;
  RecordSlots slots_;
  std::size_t stride_, n_;
  NeighbourList const& list_;
  Aligned records_;
  SweepPlan plan_{};
};

BOOST_AUTO_TEST_CASE_TEMPLATE(baseline_is_its_dense_sum_too, D, Dimensions) {
  constexpr int Dim = D::value;
  RandomScene<Dim> const scene = in_box<Dim>(21, 150, Box::turned);
  NeighbourList const list = list_of(scene);
  std::vector<Term> const terms = all_terms<Dim>();
  InstructionSet<Dim> const baseline = baseline_loops<Dim>();
  Sums const found =
      HandmadeSweep<Dim>(scene, list, union_of(terms)).rows(baseline, all_terms<Dim>(baseline));
  DenseSums<Dim> const dense_sums(scene);
  for (std::size_t t = 0; t < terms.size(); ++t) {
    BOOST_TEST(relative_difference(flat(found[t]), flat(dense_sums.of(terms[t]))) < round_off, terms[t].name);
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(the_best_instructions_of_the_processor_are_chosen, D, Dimensions) {
  constexpr int Dim = D::value;
  BOOST_TEST(std::string(loops_of_sweep<Dim>().instruction_set) == (has_avx2() ? "avx2" : "baseline"));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(loops_of_every_kernel_are_dense_sums_in_every_instruction_set, D, Dimensions) {
  constexpr int Dim = D::value;
  for (KernelInfo const& info : all_kernel_infos()) {
    RandomScene<Dim> scene = in_box<Dim>(31, 120, Box::open);
    scene.particles.set_kernel(kernel(info.id, Dim));
    NeighbourList const list = list_of(scene);
    DenseSums<Dim> const dense_sums(scene);
    for (InstructionSet<Dim> const& set : all_instruction_sets<Dim>()) {
      std::vector<Term> const terms = all_terms<Dim>(set);
      Sums const found = HandmadeSweep<Dim>(scene, list, union_of(terms)).rows(set, terms);
      for (std::size_t t = 0; t < terms.size(); ++t) {
        BOOST_TEST(relative_difference(flat(found[t]), flat(dense_sums.of(terms[t]))) < round_off,
                   info.id << ", " << set.sweep.instruction_set << ": " << terms[t].name);
      }
    }
  }
}

/// Rows of every length, boxes of every kind, smoothing lengths in common and of each.
template <int Dim>
std::vector<RandomScene<Dim>> scenes_of_every_kind() {
  std::vector<RandomScene<Dim>> scenes{clusters<Dim>(22)};
  for (Box const box : {Box::open, Box::along_axes, Box::turned}) scenes.push_back(in_box<Dim>(22, 150, box));
  scenes.push_back(scenes.back());
  Random random(23);
  vary_lengths(scenes.back().particles, random);
  return scenes;
}

/// The loop among those that were made that serves records without velocities of drift.
BatchFunction of_plain_records(std::array<LoopForSlots, 2> const& made) { return made[0].sum; }

BOOST_AUTO_TEST_CASE_TEMPLATE(loops_made_for_certain_records_give_what_those_for_any_give, D, Dimensions) {
  constexpr int Dim = D::value;
  for (RandomScene<Dim> const& scene : scenes_of_every_kind<Dim>()) {
    NeighbourList const list = list_of(scene);
    for (InstructionSet<Dim> const& set : all_instruction_sets<Dim>()) {
      std::vector<Term> const all = all_terms<Dim>(set);
      bool const specialises = of_plain_records(set.sweep.density.made) != nullptr;
      BOOST_TEST(specialises == (std::string_view(set.sweep.instruction_set) != "baseline" || !has_avx2()));
      std::vector<std::pair<std::vector<Term>, BatchFunction>> companies;
      for (Term const& term : all) companies.push_back({{term}, of_plain_records(term.loops->made)});
      for (LoopOfSeveral const& several : set.sweep.of_several)
        companies.push_back({terms_of(several, all), of_plain_records(several.made)});
      for (auto const& [terms, loop] : companies) {
        BOOST_TEST((loop != nullptr) == specialises);
        if (!loop) continue;
        HandmadeSweep<Dim> sweep(scene, list, union_of(terms));
        Sums const found = sweep.rows(set, terms, loop);
        Sums const expected = sweep.rows(set, terms);
        for (std::size_t t = 0; t < terms.size(); ++t)
          BOOST_TEST(relative_difference(flat(found[t]), flat(expected[t])) < round_off, terms[t].name << " of " << terms.size());
      }
    }
  }
}

#if defined(__x86_64__)
BOOST_AUTO_TEST_CASE_TEMPLATE(instruction_sets_agree_to_round_off, D, Dimensions) {
  if (!has_avx2()) return;
  constexpr int Dim = D::value;
  InstructionSet<Dim> const baseline = baseline_loops<Dim>();
  InstructionSet<Dim> const avx2 = avx2_loops<Dim>();
  for (RandomScene<Dim> const& scene : scenes_of_every_kind<Dim>()) {
    NeighbourList const list = list_of(scene);
    std::vector<Term> const terms = all_terms<Dim>(baseline);
    std::vector<Term> const same_terms = all_terms<Dim>(avx2);
    HandmadeSweep<Dim> sweep(scene, list, union_of(terms));
    Sums const one = sweep.rows(baseline, terms);
    Sums const other = sweep.rows(avx2, same_terms);
    for (std::size_t t = 0; t < terms.size(); ++t) {
      BOOST_TEST(relative_difference(flat(other[t]), flat(one[t])) < round_off, terms[t].name);
    }
    std::size_t linear = 0;
    for (std::size_t s = 0; scene.particles.smoothing_lengths().empty() && s < all_scheme_infos().size();
         ++s) {
      bool const is_linear = baseline.schemes[s]->conductance != nullptr;
      BOOST_TEST(is_linear == all_scheme_infos()[s]->difference_form);
      if (!is_linear) continue;
      ++linear;
      std::vector<double> const c = sweep.conductances(baseline, s);
      BOOST_TEST(relative_difference(sweep.conductances(avx2, s), c) < round_off);
      std::size_t const n = scene.particles.size();
      std::vector<double> first(n), second(n);
      double const* const T = scene.particles.scalar(Field::temperature).data();
      baseline.sweep.conduct(list.first.data(), list.neighbour.data(), c.data(), T, 0, n, first.data());
      avx2.sweep.conduct(list.first.data(), list.neighbour.data(), c.data(), T, 0, n, second.data());
      BOOST_TEST(relative_difference(second, first) < round_off);
    }
    BOOST_TEST((linear > 0u || !scene.particles.smoothing_lengths().empty()));
  }
}
#endif

BOOST_AUTO_TEST_SUITE_END()
