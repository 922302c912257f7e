// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "cases/support/case.hpp"
#include "harness/measure/allowed_order.hpp"
#include "tests/support/walls_at.hpp"

// What every case says of where its solution is not smooth, against its fields alone: they are sampled along
// a line, averaged over a width, and the order in the width of what that changes is measured.
BOOST_AUTO_TEST_SUITE(case_features)

using namespace sphverify;
using namespace sphverify::tests;

/// A scene of a case other than that of its defaults.
struct Scene {
  char const* id;
  std::vector<std::pair<char const*, ParameterValue>> values;
};

std::vector<Scene> const other_scenes{
    {"conduction/marshak", {{"exponent", 1.0}, {"final_time", 0.05}}},
    {"conduction/marshak", {{"exponent", 0.75}, {"final_time", 0.05}}},
    {"conduction/marshak", {{"exponent", 0.4}, {"final_time", 0.05}}},
    {"conduction/barenblatt", {{"exponent", 3.0}}},
    {"conduction/barenblatt", {{"exponent", 4.0}}},
    {"conduction/barenblatt", {{"exponent", 1.4}}},
    {"extreme/cold-front", {{"exponent", 3.0}}},
    {"extreme/cold-front", {{"exponent", 1.0}}},
    {"extreme/conductivity-contrast", {{"contrast", 0.01}}},
    {"extreme/conductivity-contrast", {{"contrast", 1.0}}},
    {"extreme/density-contrast", {{"contrast", 1.0}}},
    {"extreme/gas-units", {{"length_unit", 3.0}, {"time_unit", 5.0}}},
    {"hydro/riemann", {{"preset", std::string("toro-2")}}},
    {"hydro/riemann", {{"preset", std::string("toro-3")}}},
    {"hydro/riemann", {{"preset", std::string("toro-4")}}},
    {"hydro/riemann", {{"preset", std::string("toro-5")}}},
    {"hydro/riemann", {{"preset", std::string("leblanc")}}},
    {"hydro/riemann",  // parts and leaves a vacuum
     {{"left", std::vector<double>{1.0, -3.0, 0.4}}, {"right", std::vector<double>{1.0, 3.0, 0.4}}}},
    {"hydro/riemann",  // meets itself
     {{"left", std::vector<double>{1.0, 0.5, 1.0}}, {"right", std::vector<double>{1.0, 0.5, 1.0}}}},
    {"hydro/riemann",  // a contact alone
     {{"left", std::vector<double>{1.0, 0.5, 1.0}}, {"right", std::vector<double>{2.0, 0.5, 1.0}}}},
    {"hydro/riemann",  // cold streams that collide
     {{"left", std::vector<double>{1.0, 1.0, 0.0}}, {"right", std::vector<double>{2.0, -1.0, 0.0}}}},
    {"hydro/vacuum-release", {{"gamma", 1.4}}},
    {"hydro/vacuum-release", {{"gamma", 2.5}}},
    {"hydro/piston-velocity", {{"pressure", 0.5}}},
    {"hydro/noh", {{"gamma", 1.4}}},
    {"hydro/sedov", {{"gamma", 1.4}}},
    {"hydro/gresho", {{"boundary", std::string("velocity")}}},
    {"hydro/acoustic", {{"boundary", std::string("periodic")}}},
    {"conduction/slab-dirichlet", {{"turn", 30.0}, {"dimension", 2.0}}},
};

/// Calls check(info, problem) for every case in every dimension that it knows, and for the other scenes.
template <class Check>
void for_each_scene(Check const& check) {
  auto const visit = [&](CaseInfo const& info, std::string const& what, AnyProblem const& problem) {
    std::visit(
        [&]<int Dim>(Problem<Dim> const& p) {
          BOOST_TEST_CONTEXT(info.id << what << " in " << Dim << " dimensions") { check(info, p); }
        },
        problem);
  };
  for (Case const& one : all_cases()) {
    auto const& specs = one.info.parameters;
    bool const has_dimension = std::any_of(
        specs.begin(), specs.end(), [](ParameterSpec const& spec) { return spec.name == "dimension"; });
    for (double dimension = 1.0; dimension <= (has_dimension ? 3.0 : 1.0); dimension += 1.0) {
      Parameters parameters(specs);
      if (has_dimension) parameters.set("dimension", dimension);
      visit(one.info, "", one.problem(parameters));
    }
    for (Scene const& scene : other_scenes) {
      if (scene.id != one.info.id) continue;
      Parameters parameters(specs);
      for (auto const& [name, value] : scene.values) parameters.set(name, value);
      visit(one.info, std::string(", other ") + scene.values.front().first, one.problem(parameters));
    }
  }
}

template <int Dim>
Features<Dim> features_of(Problem<Dim> const& problem) {
  return problem.features ? problem.features(problem.final_time) : Features<Dim>{};
}

/// A straight line along the first axis of the domain, from wall to wall at the final time, at a part of the
/// other extents.
template <int Dim>
struct Line {
  Vector<Dim> start, direction;
  double length;

  Line(Problem<Dim> const& problem, double part) {
    Domain<Dim> const& domain = problem.domain;
    direction = domain.axes.col(0);
    Vector<Dim> from = domain.lower + part * domain.extent();
    from[0] = domain.lower[0];
    start = domain.to_space(from);
    Vector<Dim> end = start + domain.extent()[0] * direction;
    for (Wall<Dim> const& wall : walls_at(problem, problem.final_time)) {
      double const facing = wall.outward_normal.dot(direction);
      if (facing < -0.5) start += (wall.point - start).dot(direction) * direction;
      if (facing > 0.5) end += (wall.point - end).dot(direction) * direction;
    }
    length = (end - start).norm();
  }
  Vector<Dim> at(double s) const { return start + s * direction; }
};

constexpr std::array<double, 2> offsets{0.06, 0.53};  // one crosses what is round about a corner, or a centre

/// The scalars of a problem and the components of its vectors, at its final time.
template <int Dim, class Use>
void for_each_component(Problem<Dim> const& problem, Use const& use) {
  double const t = problem.final_time;
  for (auto const& [field, f] : problem.scalars) {
    use(field, [&f = f, t](Vector<Dim> const& x) { return f(x, t); });
  }
  for (auto const& [field, f] : problem.vectors) {
    for (int k = 0; k < Dim; ++k) use(field, [&f = f, t, k](Vector<Dim> const& x) { return f(x, t)[k]; });
  }
}

/// What an average over 2 reach + 1 samples with the weights 1 - (j/(reach + 1))^2 changes in the middle
/// ones.
std::vector<double> smearing(std::vector<double> const& samples, std::size_t reach) {
  std::vector<double> change;
  double total = 0.0;
  std::vector<double> weights;
  for (std::size_t j = 0; j <= 2 * reach; ++j) {
    double const u =
        (static_cast<double>(j) - static_cast<double>(reach)) / (static_cast<double>(reach) + 1.0);
    weights.push_back(1.0 - u * u);
    total += weights.back();
  }
  for (std::size_t i = reach; i + reach < samples.size(); ++i) {
    double sum = 0.0;
    for (std::size_t j = 0; j <= 2 * reach; ++j) sum += weights[j] * (samples[i + j - reach] - samples[i]);
    change.push_back(sum / total);
  }
  return change;
}

double largest(std::vector<double> const& values) {
  double most = 0.0;
  for (double const value : values) most = std::max(most, std::abs(value));
  return most;
}

BOOST_AUTO_TEST_CASE(a_field_is_smooth_wherever_its_case_names_no_feature_of_it) {
  std::size_t pieces = 0;
  for_each_scene([&]<int Dim>(CaseInfo const&, Problem<Dim> const& problem) {
    constexpr std::size_t samples = 2001;
    auto const features = features_of(problem);
    double const t = problem.final_time;
    for (double const offset : offsets) {
      Line<Dim> const line(problem, offset);
      double const step = line.length / (samples - 1);
      for_each_component(problem, [&](Field field, auto const& f) {
        std::vector<double> piece;
        double scale = 0.0;
        double from = 0.0;
        std::vector<std::pair<double, std::vector<double>>> found;
        for (std::size_t k = 0; k < samples; ++k) {
          // From inside, lest rounding puts an end beyond a wall.
          Vector<Dim> const x = line.at(
              std::clamp(static_cast<double>(k) * step, 1e-9 * line.length, (1.0 - 1e-9) * line.length));
          bool const rough = std::any_of(features.begin(), features.end(), [&](Feature<Dim> const& one) {
            return one.exponents.contains(field) && one.distance(x) < 0.025 * line.length;
          });
          if (rough || (problem.holds && !problem.holds(x, t))) {
            found.emplace_back(from, std::move(piece));
            piece.clear();
            continue;
          }
          if (piece.empty()) from = static_cast<double>(k) * step;
          piece.push_back(f(x));
          scale = std::max(scale, std::abs(piece.back()));
        }
        found.emplace_back(from, std::move(piece));
        for (auto const& [start, values] : found) {
          if (values.size() < 50) continue;
          double const coarse = largest(smearing(values, 20));
          double const fine = largest(smearing(values, 5));
          if (fine <= 1e-10 * scale) continue;
          BOOST_TEST(std::log2(coarse / fine) / 2.0 > 1.5,
                     info(field).name << " from " << start << " on a line at " << offset << ": " << coarse
                                      << ", " << fine << " of " << scale);
          ++pieces;
        }
      });
    }
  });
  BOOST_TEST(pieces > 300u);
}

/// A line's place nearest to a feature, if it crosses it.
template <int Dim>
double crossing(Feature<Dim> const& feature, Line<Dim> const& line) {
  constexpr int samples = 4000;
  auto const distance = [&](double s) { return feature.distance(line.at(s)); };
  double nearest = 0.0;
  // Beyond the ends too: the gas may end with the feature.
  for (int k = -samples / 100; k <= samples + samples / 100; ++k) {
    double const s = line.length * k / samples;
    if (distance(s) < distance(nearest)) nearest = s;
  }
  double low = nearest - line.length / samples;
  double high = nearest + line.length / samples;
  while (high - low > 1e-13 * line.length) {
    double const third = (high - low) / 3.0;
    if (distance(low + third) < distance(high - third)) {
      high -= third;
    } else {
      low += third;
    }
  }
  double const s = 0.5 * (low + high);
  return distance(s) < 1e-9 * line.length ? s : std::numeric_limits<double>::quiet_NaN();
}

BOOST_AUTO_TEST_CASE(a_field_is_as_rough_at_a_feature_as_its_case_says) {
  std::size_t checked = 0;
  std::map<std::string, int> names;
  for_each_scene([&]<int Dim>(CaseInfo const& info_of_case, Problem<Dim> const& problem) {
    auto const features = features_of(problem);
    for (Feature<Dim> const& feature : features) {
      if (feature.exponents.empty()) continue;
      BOOST_TEST(feature.codimension == 1, "the line measures surfaces only");
      bool crossed = false;
      for (double const offset : offsets) {
        Line<Dim> const line(problem, offset);
        double const place = crossing(feature, line);
        if (std::isnan(place)) continue;
        crossed = true;
        // A window that holds no other feature.
        double half = 0.02 * line.length;
        for (Feature<Dim> const& other : features) {
          if (&other == &feature || other.exponents.empty()) continue;
          half = std::min(half, 0.5 * other.distance(line.at(place)));
        }
        constexpr int samples = 1500;  // on either side; it lies between two of them
        std::map<Field, bool> seen;
        for_each_component(problem, [&](Field field, auto const& f) {
          auto const exponent = feature.exponents.find(field);
          if (exponent == feature.exponents.end()) return;
          std::vector<double> values;
          for (int k = -samples; k < samples; ++k)
            values.push_back(f(line.at(place + (k + 0.5) * half / samples)));
          NormSet const expected = feature_orders(exponent->second, 1.0);
          std::array<NormSet, 2> size;
          for (std::size_t level = 0; level < 2; ++level) {
            std::size_t const reach = level == 0 ? 100 : 25;
            std::vector<double> change = smearing(values, reach);
            // The same piece of the line at both widths.
            auto const skip = static_cast<std::ptrdiff_t>(100 - reach);
            change = {change.begin() + skip, change.end() - skip};
            size[level] = norms(change, std::vector<double>(change.size(), 1.0));
          }
          double const scale = largest(values);
          if (size[1].linf <= 1e-11 * scale) {
            // A component across which nothing happens, such as the velocity along a shock.
            return;
          }
          seen[field] = true;
          auto const order = [&](double NormSet::*norm) {
            return std::log2(size[0].*norm / (size[1].*norm)) / 2.0;
          };
          BOOST_TEST_CONTEXT(feature.name << ", " << info(field).name << ", s = " << exponent->second) {
            BOOST_TEST(std::abs(order(&NormSet::l1) - expected.l1) < 0.2, order(&NormSet::l1)
                                                                              << " " << expected.l1);
            BOOST_TEST(std::abs(order(&NormSet::l2) - expected.l2) < 0.2, order(&NormSet::l2)
                                                                              << " " << expected.l2);
            BOOST_TEST(std::abs(order(&NormSet::linf) - expected.linf) < 0.2, order(&NormSet::linf)
                                                                                  << " " << expected.linf);
          }
          ++checked;
          ++names[feature.name];
        });
        for (auto const& [field, s] : feature.exponents) {
          BOOST_TEST(seen[field], feature.name << ": " << info(field).name << " is smooth");
        }
      }
      BOOST_TEST(crossed, feature.name << " of " << info_of_case.id << " is not where the gas is");
    }
  });
  BOOST_TEST(checked > 150u);
  for (char const* name :
       {"shock", "contact", "fan head", "fan tail", "vacuum front", "front", "kink", "interface"})
    BOOST_TEST(names[name] > 0, name);
}

BOOST_AUTO_TEST_CASE(cases_that_jump_have_features_and_smooth_ones_have_none_of_jumps) {
  for_each_scene([]<int Dim>(CaseInfo const& info, Problem<Dim> const& problem) {
    bool jumps = false;
    for (Feature<Dim> const& feature : features_of(problem)) {
      for (auto const& [field, s] : feature.exponents) {
        BOOST_TEST(s >= 0.0);
        jumps = jumps || s == 0.0;
      }
    }
    if (!info.discontinuous) BOOST_TEST(!jumps, info.id);
    if (info.discontinuous) BOOST_TEST(static_cast<bool>(problem.features), info.id);
  });
}

BOOST_AUTO_TEST_SUITE_END()
