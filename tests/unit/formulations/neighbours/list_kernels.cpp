// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/neighbours/candidates.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <limits>
#include <utility>
#include <vector>

#include "tests/support/random_particles.hpp"

namespace sphverify {

extern ListKernels const baseline_list_kernels[3];
#if defined(__x86_64__)
extern ListKernels const avx2_list_kernels[3];
#endif

}  // namespace sphverify

BOOST_AUTO_TEST_SUITE(formulations_neighbours_list_kernels)

using namespace sphverify;
using namespace sphverify::tests;

/// Those that this processor can run.
template <int Dim>
std::vector<ListKernels const*> all_kernels() {
  std::vector<ListKernels const*> all{&baseline_list_kernels[Dim - 1]};
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    all.push_back(&avx2_list_kernels[Dim - 1]);
#endif
  return all;
}

/// Particles at random places of a box of edge 3 about 0, two of them at the same place. The first `home` are
/// in a box of edge 1 about 0.
template <int Dim>
struct Crowd {
  static constexpr double reach = 0.8;
  static constexpr std::size_t home = 11;
  std::size_t count;
  std::vector<double> x[Dim];
  std::vector<double> half_reach;
  std::vector<std::uint32_t> number;

  explicit Crowd(std::size_t n) : count(n), half_reach(n + candidates_at_a_time) {
    Random random(24);
    for (auto& along : x) {
      along.resize(n + candidates_at_a_time);
      for (std::size_t i = 0; i < n; ++i)
        along[i] = i < home ? random.uniform(-0.5, 0.5) : random.uniform(-1.5, 1.5);
      along[9] = along[2];
    }
    for (double& half : half_reach) half = random.uniform(0.1, 0.4);
    for (std::size_t i = 0; i < half_reach.size(); ++i)
      number.push_back(static_cast<std::uint32_t>(1000 - 3 * i));
  }
  SortedPlaces view(bool own_reach, PairSupport support) const {
    SortedPlaces all{.x = {}, .half_reach = own_reach ? half_reach.data() : nullptr, .number = number.data(), .support = support};
    for (int k = 0; k < Dim; ++k) all.x[k] = x[k].data();
    return all;
  }
  double own_reach(std::size_t i, std::size_t j, PairSupport support) const {
    return support == PairSupport::mean ? half_reach[i] + half_reach[j] : 2.0 * std::max(half_reach[i], half_reach[j]);
  }
  double distance(std::size_t i, std::size_t j, Vector<Dim> const& shift) const {
    Vector<Dim> r;
    for (int k = 0; k < Dim; ++k) r[k] = x[k][i] - (x[k][j] + shift[k]);
    return r.norm();
  }
};

template <int Dim>
HomeBox unit_home(double reach, float largest_half_reach) {
  HomeBox home{.centre = {},
               .per_reach = 1.0 / reach,
               .half_extent = {},
               .largest_half_reach = largest_half_reach,
               .margin = 1e-5f};
  for (float& half : home.half_extent) half = static_cast<float>(0.5 / reach);
  return home;
}

/// Memory for candidates.
struct Room {
  std::vector<float> places;
  std::vector<std::uint32_t> numbers;
  std::vector<CandidateRun> runs;
  Candidates all{};

  explicit Room(std::size_t most) : places(4 * most), numbers(2 * most) {
    for (std::size_t k = 0; k < 3; ++k) all.x[k] = places.data() + k * most;
    all.half_reach = places.data() + 3 * most;
    all.place = numbers.data();
    all.number = numbers.data() + most;
  }
  void end_run(std::size_t first, Vector<3> const& shift) {
    runs.push_back({.first = first, .shift = {shift[0], shift[1], shift[2]}});
    all.runs = runs.data();
    all.run_count = runs.size();
  }
  void fill_up() {
    for (std::size_t n = all.count; n % candidates_at_a_time != 0; ++n) {
      all.x[0][n] = std::numeric_limits<float>::infinity();
    }
  }
};

BOOST_AUTO_TEST_CASE_TEMPLATE(all_instruction_sets_find_and_list_those_that_are_near, D, Dimensions) {
  constexpr int Dim = D::value;
  using Crowd = Crowd<Dim>;
  Vector<3> const far_shift(0.3, -0.2, 0.1);
  for (ListKernels const* kernels : all_kernels<Dim>()) {
    for (auto const& [own_reach, support] :
         {std::pair{false, PairSupport::mean}, std::pair{true, PairSupport::mean}, std::pair{true, PairSupport::larger}}) {
      for (std::size_t const count : {11u, 12u, 16u, 19u, 300u}) {
        Crowd const crowd(count);
        SortedPlaces const all = crowd.view(own_reach, support);
        HomeBox const home = unit_home<Dim>(Crowd::reach, 0.5f);
        Room room(2 * count + 8 * candidates_at_a_time);
        double const none[3] = {};
        // The home's own, the rest, and what is not home once more as an image.
        room.end_run(0, Vector<3>::Zero());
        kernels->add(all, home, 0, Crowd::home, none, room.all);
        BOOST_REQUIRE_EQUAL(room.all.count, Crowd::home);
        kernels->add(all, home, Crowd::home, count, none, room.all);
        room.end_run(room.all.count, far_shift);
        kernels->add(all, home, Crowd::home, count, far_shift.data(), room.all);
        room.fill_up();
        if (count == 300u) BOOST_TEST(room.all.count < 2 * count - Crowd::home);  // some are out of reach
        for (std::size_t i = 0; i < Crowd::home; ++i) {
          std::vector<std::uint32_t> expected;
          bool expect_same_place = false;
          for (std::size_t image = 0; image < 2; ++image) {
            for (std::size_t j = image * Crowd::home; j < count; ++j) {
              if (j == i) continue;
              Vector<Dim> const shift =
                  image == 0 ? Vector<Dim>::Zero().eval() : far_shift.head<Dim>().eval();
              double const distance = crowd.distance(i, j, shift);
              double const reach = own_reach ? crowd.own_reach(i, j, support) : Crowd::reach;
              if (distance < reach) expected.push_back(crowd.number[j]);
              expect_same_place = expect_same_place || distance == 0.0;
            }
          }
          std::vector<std::uint8_t> near(room.all.count / 8 + 16, 0xff);
          bool same_place = false;
          std::size_t const length =
              kernels->find_near(all, home, room.all, i, Crowd::reach, near.data(), same_place);
          BOOST_REQUIRE_EQUAL(length, expected.size());
          BOOST_TEST(same_place == expect_same_place);
          std::vector<std::uint32_t> found(length + 2, 7u);
          kernels->list(room.all.number, near.data(), found.data() + 1, found.data() + 1 + length);
          BOOST_TEST(found.front() == 7u);  // nothing is written beside the row
          BOOST_TEST(found.back() == 7u);
          BOOST_TEST(std::equal(expected.begin(), expected.end(), found.begin() + 1));
        }
      }
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
