// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/table/budget_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/second_law_watched.hpp"
#include "reports/table/number_text.hpp"
#include "reports/table/pivot.hpp"

namespace sphverify {

namespace {

std::string amount(Number const& value, double rounding) {
  if (!value) return "-";
  return std::abs(*value) <= rounding ? "rounding" : percent(std::abs(*value));
}

/// What pairs created, and what time stepping left; of momentum the latter is in the whole.
Cell energy_cell(SeriesRow const& row) {
  if (!row.failures.empty()) return {row.failures, std::nullopt};
  if (!row.energy_drift) return {"-", std::nullopt};
  double const rounding = row.energy_rounding.value_or(0.0);
  if (!row.energy_pair_drift) return {amount(row.energy_drift, rounding), row.energy_drift};
  // The best is who creates least by either.
  double const pairs = std::abs(*row.energy_pair_drift);
  double const most = std::max(pairs, std::abs(row.energy_step_drift.value_or(0.0)));
  return {amount(pairs, rounding) + " / " + amount(row.energy_step_drift, rounding),
          most <= rounding ? 0.0 : most};
}

Cell momentum_cell(SeriesRow const& row) {
  if (!row.failures.empty()) return {row.failures, std::nullopt};
  if (!row.momentum_drift) return {"-", std::nullopt};
  double const rounding = row.momentum_rounding.value_or(0.0);
  double const drift = std::abs(*row.momentum_drift);
  return {amount(drift, rounding), drift <= rounding ? 0.0 : drift};
}

/// A number of the stability, if there is one.
template <class Get>
NumberColumn stability_column(std::string const& name, Get const& get) {
  return {name, [get](SeriesRow const& row) { return row.stability ? get(*row.stability) : Cell{"-", {}}; }};
}

TextTable modes_table(std::string const& title, std::vector<SeriesRow> const& rows) {
  auto const count = [](std::optional<std::uint64_t> n) {
    return n ? Cell{fmt::format("{}", *n), static_cast<double>(*n)} : Cell{"-", std::nullopt};
  };
  return number_table(
      title, rows,
      {stability_column("growing modes",
                        [=](Stability const& s) {
                          if (s.growing_modes) return count(s.growing_modes);
                          // Of many modes the outermost alone may be known; if any grows, so does the worst.
                          bool const grows = s.worst_mode && s.spectral_abscissa > 0.0;
                          return Cell{grows ? "some" : "not known", std::nullopt};
                        }),
       // None is best: between insulated walls a uniform temperature has to be one.
       stability_column("unseen modes",
                        [=](Stability const& s) {
                          return Cell{count(s.unseen_modes).text, std::nullopt};
                        }),
       stability_column("abscissa [1/s]",
                        [](Stability const& s) {
                          // Of rounding's size: neither grows nor decays.
                          bool const is_zero = s.spectral_abscissa && s.spectral_radius &&
                                               std::abs(*s.spectral_abscissa) <= 1e-10 * *s.spectral_radius;
                          return Cell{is_zero ? "0" : scientific(s.spectral_abscissa), std::nullopt};
                        }),
       stability_column("radius [1/s]", [](Stability const& s) {
         return Cell{scientific(s.spectral_radius), std::nullopt};
       })});
}

Cell step_cell(Stability const& stability, char const* method) {
  auto const found = stability.stable_steps.find(method);
  if (found == stability.stable_steps.end()) return {"-", std::nullopt};
  StableStep const& step = found->second;
  if (step.measured) return {scientific(step.measured), -*step.measured};
  if (step.theory) return {"~" + scientific(step.theory), -*step.theory};
  bool const none = step.remark.starts_with("no step is stable");
  return {none ? "none" : step.remark.starts_with("any step") ? "any" : "-", std::nullopt};
}

TextTable steps_table(std::string const& title, std::vector<SeriesRow> const& rows) {
  std::vector<NumberColumn> columns;
  for (char const* method : stable_step_methods) {
    bool const is_known = std::any_of(rows.begin(), rows.end(), [&](SeriesRow const& row) {
      return row.stability && row.stability->stable_steps.contains(method);
    });
    if (!is_known) continue;
    columns.push_back(
        stability_column(method, [method](Stability const& s) { return step_cell(s, method); }));
  }
  return number_table(title, rows, columns);
}

template <class Get>
NumberColumn law_column(std::string const& name, Get const& get) {
  return {name, [get](SeriesRow const& row) {
            if (!row.failures.empty()) return Cell{row.failures, std::nullopt};
            return row.second_law ? get(*row.second_law) : Cell{"-", std::nullopt};
          }};
}

TextTable second_law_table(std::string const& title, std::vector<SeriesRow> const& rows) {
  // What was not watched was not kept either.
  auto const column = [](char const* name, Breach SecondLaw::*member, bool (*was_watched)(SecondLaw const&)) {
    return law_column(name, [=](SecondLaw const& s) {
      return was_watched(s) ? Cell{percent((s.*member).size), (s.*member).size} : Cell{"-", std::nullopt};
    });
  };
  return number_table(title, rows,
                      {column("cold to hot", &SecondLaw::cold_to_hot, watched_cold_to_hot),
                       column("overshoot", &SecondLaw::overshoot, watched_bounds),
                       column("undershoot", &SecondLaw::undershoot, watched_bounds),
                       law_column("least entropy made", [](SecondLaw const& s) {
                         Number const& made = s.smallest_entropy_production;
                         return Cell{made ? signed_percent(*made) : "-", std::nullopt};
                       })});
}

}  // namespace

std::vector<TextTable> budget_tables(std::vector<SeriesRow> const& rows) {
  std::vector<TextTable> tables;
  auto const any = [&](auto const& has) { return std::any_of(rows.begin(), rows.end(), has); };
  auto const title = [&](std::string const& words) {
    return fmt::format("{}: {}, N = {}", rows.front().case_id, words, rows.front().finest);
  };
  if (any([](SeriesRow const& r) { return r.energy_drift.has_value(); }))
    tables.push_back(pivot(title("energy created by pairs / by time stepping"), rows, energy_cell));
  if (any([](SeriesRow const& r) { return r.momentum_drift.has_value(); }))
    tables.push_back(pivot(title("momentum created"), rows, momentum_cell));
  if (any([](SeriesRow const& r) { return r.stability && r.stability->spectral_radius; }))
    tables.push_back(modes_table(title("modes of the linearised rate"), rows));
  if (any([](SeriesRow const& r) { return r.stability && !r.stability->stable_steps.empty(); }))
    tables.push_back(steps_table(title("longest stable step [s]"), rows));
  if (any([](SeriesRow const& r) { return r.second_law.has_value(); }))
    tables.push_back(second_law_table(title("second law"), rows));
  return tables;
}

}  // namespace sphverify
