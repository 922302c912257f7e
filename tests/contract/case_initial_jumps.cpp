// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "cases/support/case.hpp"

// Where the initial state jumps a case says, and nowhere else: particles whose cells a jump cuts are made of
// both sides of it.
BOOST_AUTO_TEST_SUITE(case_initial_jumps)

using namespace sphverify;

/// What particles are made of at a place: density, velocity and internal energy of a gas, density and
/// conductivity of what stands still.
template <int Dim>
std::vector<double> made_of(Problem<Dim> const& problem, Vector<Dim> const& x) {
  std::vector<double> values{problem.scalars.at(Field::density)(x, 0.0)};
  if (problem.gamma > 0.0) {
    values.push_back(problem.scalars.at(Field::internal_energy)(x, 0.0));
    Vector<Dim> const v = problem.vectors.at(Field::velocity)(x, 0.0);
    values.insert(values.end(), v.data(), v.data() + Dim);
  } else if (problem.conductivity) {
    values.push_back(problem.conductivity(x, 1.0));
  }
  return values;
}

/// Largest difference of two such lists, relative to sizes.
double difference(std::vector<double> const& a, std::vector<double> const& b,
                  std::vector<double> const& sizes) {
  double most = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (sizes[k] > 0.0) most = std::max(most, std::abs(a[k] - b[k]) / sizes[k]);
  }
  return most;
}

/// The jumps along an axis on a line through the box, by halving every interval in which much changes.
template <int Dim>
std::vector<double> jumps_along(Problem<Dim> const& problem, int axis, Vector<Dim> const& through) {
  Domain<Dim> const& domain = problem.domain;
  auto const at = [&](double s) {
    Vector<Dim> x = through;
    x[axis] = s;
    return made_of(problem, domain.to_space(x));
  };
  constexpr int intervals = 401;
  std::vector<double> found;
  double const width = domain.extent()[axis] / intervals;
  std::vector<double> sizes(at(domain.lower[axis]).size(), 0.0);
  for (int k = 0; k <= intervals; ++k) {
    auto const values = at(std::min(domain.lower[axis] + k * width, domain.upper[axis]));
    for (std::size_t c = 0; c < sizes.size(); ++c) sizes[c] = std::max(sizes[c], std::abs(values[c]));
  }
  for (int k = 0; k < intervals; ++k) {
    double low = domain.lower[axis] + k * width;
    double high = std::min(low + width, domain.upper[axis]);
    double const before = difference(at(low), at(high), sizes);
    if (before < 1e-3) continue;
    for (int step = 0; step < 45; ++step) {
      double const middle = 0.5 * (low + high);
      bool const left = difference(at(low), at(middle), sizes) > difference(at(middle), at(high), sizes);
      (left ? high : low) = middle;
    }
    if (difference(at(low), at(high), sizes) > 0.3 * before) found.push_back(0.5 * (low + high));
  }
  return found;
}

BOOST_AUTO_TEST_CASE(initial_states_jump_where_their_cases_say_and_nowhere_else) {
  std::size_t jumps = 0;
  for (Case const& one : all_cases()) {
    bool const has_dimension =
        std::any_of(one.info.parameters.begin(), one.info.parameters.end(),
                    [](ParameterSpec const& spec) { return spec.name == "dimension"; });
    for (double dimension = 1.0; dimension <= (has_dimension ? 3.0 : 1.0); dimension += 1.0) {
      Parameters parameters(one.info.parameters);
      if (has_dimension) parameters.set("dimension", dimension);
      std::visit(
          [&]<int Dim>(Problem<Dim> const& problem) {
            BOOST_TEST_CONTEXT(one.info.id << " in " << Dim << " dimensions") {
              BOOST_TEST(std::is_sorted(problem.initial_jumps.begin(), problem.initial_jumps.end()));
              Vector<Dim> through = problem.domain.lower;
              for (int k = 0; k < Dim; ++k) through[k] += (0.377 + 0.1 * k) * problem.domain.extent()[k];
              for (int axis = 0; axis < Dim; ++axis) {
                auto const found = jumps_along(problem, axis, through);
                auto const said = axis == 0 ? problem.initial_jumps : std::vector<double>{};
                BOOST_TEST_REQUIRE(found.size() == said.size());
                for (std::size_t k = 0; k < found.size(); ++k)
                  BOOST_TEST(std::abs(found[k] - said[k]) < 1e-10 * problem.domain.extent()[0]);
                jumps += found.size();
              }
            }
          },
          one.problem(parameters));
    }
  }
  BOOST_TEST(jumps >= 9u);
}

BOOST_AUTO_TEST_SUITE_END()
