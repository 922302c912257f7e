// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/codes/code_budgets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sphverify {

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr int looks_at_walls = 33;  // at which walls are looked at

constexpr double at_rest = 1e-12;  // of the sound speed: sin(n pi) is not 0

/// Whether the gas does no work on a wall, by what the wall prescribes or else by the exact velocity there.
template <int Dim>
bool stands(Wall<Dim> const& wall, Problem<Dim> const& problem, Vector<Dim> const& place, double t) {
  if (wall.velocity && wall.velocity(place, t).dot(wall.outward_normal) == 0.0) return true;
  double const speed = problem.vectors.at(Field::velocity)(place, t).dot(wall.outward_normal);
  double const e = problem.scalars.at(Field::internal_energy)(place, t);
  return std::abs(speed) <= at_rest * std::sqrt(problem.gamma * (problem.gamma - 1.0) * std::max(e, 0.0));
}

/// Whether no heat passes a wall, by what it prescribes or else by the exact flux.
template <int Dim>
bool is_insulated(Wall<Dim> const& wall, Problem<Dim> const& problem, Vector<Dim> const& place, double t) {
  if (wall.flux) return wall.flux(place, t).dot(wall.outward_normal) == 0.0;
  auto const flux = problem.vectors.find(Field::flux);
  return flux != problem.vectors.end() && flux->second(place, t).dot(wall.outward_normal) == 0.0;
}

/// Whether by the exact solution no energy passes a wall: no work, as it stands, and no heat.
template <int Dim>
bool keeps_energy(Wall<Dim> const& wall, Problem<Dim> const& problem, CaseKind kind) {
  if (wall.heat_loss) return false;
  for (int k = 0; k < looks_at_walls; ++k) {
    double const t = problem.final_time * k / (looks_at_walls - 1);
    Vector<Dim> const place = wall.path ? wall.path(t) : wall.point;
    if (moves(kind) && !stands(wall, problem, place, t)) return false;
    if (problem.conductivity && !is_insulated(wall, problem, place, t)) return false;
  }
  return true;
}

template <int Dim>
struct Totals {
  double mass = 0.0, energy = unknown;
  std::vector<double> momentum{};  ///< empty: not known
};

/// Empty numbers where the columns are not there.
template <int Dim>
Totals<Dim> totals_of(Snapshot const& s, CaseKind kind) {
  Totals<Dim> sum;
  auto const& m = s.columns.at("m");
  for (double const one : m) sum.mass += one;
  std::vector<std::vector<double> const*> velocity;
  for (std::size_t k = 0; k < Dim && s.has(velocity_columns[k]); ++k) velocity.push_back(&s.columns.at(velocity_columns[k]));
  if (moves(kind) && !velocity.empty()) {
    for (auto const* component : velocity) {
      double p = 0.0;
      for (std::size_t i = 0; i < m.size(); ++i) p += m[i] * (*component)[i];
      sum.momentum.push_back(p);
    }
  }
  char const* const column = moves(kind) ? "e" : "T";  // specific heat 1
  if (!s.has(column) || (moves(kind) && velocity.empty())) return sum;
  auto const& e = s.columns.at(column);
  sum.energy = 0.0;
  for (std::size_t i = 0; i < m.size(); ++i) {
    double kinetic = 0.0;
    if (moves(kind)) {
      for (auto const* component : velocity) kinetic += 0.5 * (*component)[i] * (*component)[i];
    }
    sum.energy += m[i] * (e[i] + kinetic);
  }
  return sum;
}

Budget budget_of(double initial, double final, bool nothing_crosses) {
  Budget b;
  b.initial = initial;
  b.final = final;
  b.exchanged = nothing_crosses ? 0.0 : unknown;
  b.drift = nothing_crosses ? final - initial : unknown;
  return b;
}

}  // namespace

template <int Dim>
void measure_code_budgets(Problem<Dim> const& problem, CaseKind kind, std::vector<Snapshot> const& history,
                          bool keeps_history, RunRecord& record) {
  if (history.size() < 2) return;
  std::vector<Totals<Dim>> totals;
  for (Snapshot const& one : history) totals.push_back(totals_of<Dim>(one, kind));
  Totals<Dim> const& first = totals.front();
  Totals<Dim> const& last = totals.back();
  bool const is_driven = problem.source || problem.body_force;
  bool const keeps = !is_driven && std::all_of(problem.walls.begin(), problem.walls.end(), [&](Wall<Dim> const& wall) {
    return keeps_energy(wall, problem, kind);
  });
  record.conservation["mass"] = budget_of(first.mass, last.mass, true);
  if (!std::isnan(first.energy) && !std::isnan(last.energy))
    record.conservation["energy"] = budget_of(first.energy, last.energy, keeps);
  if (!first.momentum.empty() && !last.momentum.empty()) {
    // Walls push against each other, more or less.
    bool const is_free = !is_driven && problem.walls.empty();
    for (std::size_t k = 0; k < Dim; ++k) record.momentum.push_back(budget_of(first.momentum[k], last.momentum[k], is_free));
  }
  if (!keeps_history) return;
  History& kept = record.history.emplace();
  for (std::size_t n = 0; n < history.size(); ++n) {
    kept.time.push_back(history[n].time.value_or(unknown));
    kept.energy.push_back(totals[n].energy);
    kept.exchanged.push_back(keeps ? 0.0 : unknown);
    if (!totals[n].momentum.empty()) kept.momentum.push_back(totals[n].momentum.front());
  }
}

template void measure_code_budgets(Problem<1> const&, CaseKind, std::vector<Snapshot> const&, bool, RunRecord&);
template void measure_code_budgets(Problem<2> const&, CaseKind, std::vector<Snapshot> const&, bool, RunRecord&);
template void measure_code_budgets(Problem<3> const&, CaseKind, std::vector<Snapshot> const&, bool, RunRecord&);

}  // namespace sphverify
