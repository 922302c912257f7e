// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/rate_operator.hpp"

#include <boost/test/unit_test.hpp>
#include <string>

#include "tests/support/random_particles.hpp"

BOOST_AUTO_TEST_SUITE(formulations_rate_operator)

using namespace sphverify;
using namespace sphverify::tests;

BOOST_AUTO_TEST_CASE(schemes_are_found_by_identifier_and_unknown_ones_refused_by_name) {
  for (SchemeInfo const* scheme : all_scheme_infos()) {
    BOOST_TEST(find_scheme(scheme->id) == scheme);
    BOOST_TEST(&make_rate_operator<2>(scheme->id)->info() == scheme, scheme->id);
  }
  BOOST_TEST(find_scheme("momentum/none") == nullptr);
  auto const names_it = [](std::invalid_argument const& problem) {
    return std::string(problem.what()).find("'momentum/none'") != std::string::npos;
  };
  BOOST_CHECK_EXCEPTION(make_rate_operator<1>("momentum/none"), std::invalid_argument, names_it);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(work_is_counted_per_pass_and_added_up_over_evaluations, D, Dimensions) {
  constexpr int Dim = D::value;
  for (SchemeInfo const* scheme : all_scheme_infos()) {
    RandomScene<Dim> scene = random_scene<Dim>(1, 50);
    if (scheme->needs_partners) scene = widened(scene);
    scene.particles.allocate(needed_fields(*scheme));
    PairGeometry<Dim> geometry = geometry_for(scheme->id, scene);
    std::size_t const contacts = geometry.contacts[0].size() + geometry.contacts[1].size();
    std::size_t const passes = pass_count(*scheme);
    auto const operator_ = make_rate_operator<Dim>(scheme->id);
    WorkCount work;
    for (std::size_t n = 1; n <= 3; ++n) {
      operator_->evaluate(scene.particles, geometry, Closure::interpolated, 0.0, 1, work);
      BOOST_TEST(work.evaluations == n);
      BOOST_TEST(work.pair_interactions == n * passes * geometry.neighbours.pairs());
      BOOST_TEST(work.wall_interactions == n * passes * contacts);
    }
  }
}

BOOST_AUTO_TEST_CASE(evaluating_again_gives_the_same_result) {
  for (SchemeInfo const* scheme : all_scheme_infos()) {
    RandomScene<2> scene = random_scene<2>(1, 50);
    if (scheme->needs_partners) scene = widened(scene);
    scene.particles.allocate(needed_fields(*scheme));
    PairGeometry<2> geometry = geometry_for(scheme->id, scene);
    auto const operator_ = make_rate_operator<2>(scheme->id);
    WorkCount work;
    std::vector<double> first;
    for (int n = 0; n < 2; ++n) {
      operator_->evaluate(scene.particles, geometry, Closure::interpolated, 0.0, 1, work);
      bool const vector = scheme->rate == Rate::acceleration;
      std::vector<double> const now = vector ? scene.particles.vector(Field::acceleration).component(0)
                                             : scene.particles.scalar(Field::heating);
      if (n == 0)
        first = now;
      else
        BOOST_TEST(same_bits(now, first), scheme->id);
      BOOST_TEST(operator_->wall_force().size() == (vector ? 2u : 0u));
      BOOST_TEST(operator_->wall_power().size() == (vector ? 0u : 2u));
    }
  }
}

BOOST_AUTO_TEST_CASE(time_reaches_what_the_walls_prescribe) {
  for (SchemeInfo const* scheme : all_scheme_infos()) {
    RandomScene<1> scene = random_scene<1>(1, 30);
    auto const now = evaluate(scene, scheme->id).numbers();
    scene.time += 0.3;
    BOOST_TEST(relative_difference(evaluate(scene, scheme->id).numbers(), now) > 1e-4, scheme->id);
  }
}

BOOST_AUTO_TEST_CASE(needed_fields_are_what_is_read_what_is_written_and_the_flux_of_a_two_pass_form) {
  SchemeInfo const& momentum = *find_scheme("momentum/p-rho2");
  BOOST_TEST((needed_fields(momentum) == FieldSet{Field::density, Field::pressure, Field::acceleration}));
  SchemeInfo const& two_pass = *find_scheme("conduction/campbell-flux");
  BOOST_TEST((needed_fields(two_pass) == FieldSet{Field::density, Field::temperature, Field::conductivity,
                                                  Field::flux, Field::heating}));
}

BOOST_AUTO_TEST_SUITE_END()
