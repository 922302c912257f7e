// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/basics/parallel.hpp"
#include "formulations/walls/sweep_wall.hpp"

#include <atomic>
#include <boost/test/unit_test.hpp>

#include "tests/support/random_particles.hpp"

BOOST_AUTO_TEST_SUITE(formulations_walls_sweep_wall)

using namespace sphverify;
using namespace sphverify::tests;

BOOST_AUTO_TEST_CASE(every_row_is_called_exactly_once_at_any_number_of_threads) {
  for (int const threads : {1, 2, 4}) {
    for (std::size_t const count : {0u, 1u, 1023u, 1024u, 1025u, 10000u}) {
      std::vector<std::atomic<int>> calls(count);
      for_each_row(count, threads, [&](std::size_t i) { ++calls[i]; });
      bool once = true;
      for (auto const& n : calls) once = once && n == 1;
      BOOST_TEST(once, count << " rows, " << threads << " threads");
    }
  }
}

// 5000 rows are five blocks of 1024, so that several threads really share them.
BOOST_AUTO_TEST_CASE_TEMPLATE(rates_are_identical_bit_for_bit_at_any_number_of_threads, D, Dimensions) {
  constexpr int Dim = D::value;
  RandomScene<Dim> const scene = random_scene<Dim>(9, 5000);
  for (SchemeInfo const* scheme : all_scheme_infos()) {
    Rates<Dim> const one = evaluate(scene, scheme->id, true, 1);
    for (int const threads : {2, 4}) {
      Rates<Dim> const several = evaluate(scene, scheme->id, true, threads);
      BOOST_TEST(same_bits(several.numbers(), one.numbers()), scheme->id << " at " << threads << " threads");
      BOOST_TEST(same_bits(several.wall_power, one.wall_power), scheme->id);
      BOOST_TEST(relative_difference(several.wall_force, one.wall_force) == 0.0, scheme->id);
    }
  }
}

BOOST_AUTO_TEST_CASE(blocks_are_all_rows_once_and_none_where_there_are_none) {
  for (int const threads : {1, 2, 4}) {
    for (std::size_t const count : {0u, 1u, 1023u, 1024u, 1025u, 10000u}) {
      std::vector<std::atomic<int>> calls(count);
      std::atomic<bool> empty_block = false;
      for_each_block(count, threads, [&](std::size_t begin, std::size_t end) {
        if (begin >= end) empty_block = true;
        for (std::size_t i = begin; i < end; ++i) ++calls[i];
      });
      bool once = true;
      for (auto const& n : calls) once = once && n == 1;
      BOOST_TEST(once, count << " rows, " << threads << " threads");
      BOOST_TEST(!empty_block);
    }
  }
}

BOOST_AUTO_TEST_CASE(pair_sweep_overwrites_and_wall_sweep_adds_and_returns_its_terms) {
  RandomScene<1> const scene = random_scene<1>(1, 20);
  PairGeometry<1> const geometry = geometry_of(scene);
  std::vector<double> out(20, 99.0);
  PairSweep<1> sweep(geometry.neighbours, geometry.domain, 1);
  TermLoops const one{.sum = [](Batch const& batch, RowTerm const* term) {
    for (std::size_t row = 0; row < batch.rows; ++row)
      term->outputs[0][batch.begin + row] = batch.first[row + 1] > batch.first[row] ? 1.0 : 0.0;
  }, .components = 1};
  sweep.add(one, {}, {}, out);
  sweep.run(scene.particles);
  for (std::size_t i = 0; i < 20; ++i) BOOST_TEST(out[i] == (geometry.neighbours.row(i).empty() ? 0.0 : 1.0));
  std::vector<double> const pairs_only = out;
  std::vector<double> const terms = sweep_wall<double, FieldSet{}, BoundaryValueSet{}>(geometry.contacts[0], scene.particles, out,
                                                       [](auto const&, auto const& B) { return B.d(); });
  for (std::size_t c = 0; c < geometry.contacts[0].size(); ++c) {
    std::uint32_t const i = geometry.contacts[0].particle[c];
    BOOST_TEST(out[i] == pairs_only[i] + geometry.contacts[0].distance[c]);
    BOOST_TEST(terms[c] == geometry.contacts[0].distance[c]);
  }
}

BOOST_AUTO_TEST_SUITE_END()
