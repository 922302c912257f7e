// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include "reports/table/compare.hpp"
#include "reports/table/setting.hpp"

namespace sphverify {

/// Run time in which a series reaches an error [s].
struct TimeToTarget {
  Number seconds;
  MedianSeconds median{};
  bool is_bound = false;  ///< the coarsest level reached it already
};

/// Methods whose stable steps are reported, as documents name them.
inline constexpr std::array<char const*, 5> stable_step_methods{
    "explicit-euler", "heun", "classical-runge-kutta", "runge-kutta", "leapfrog"};

/// One series, reduced to what the tables show.
struct SeriesRow : Setting {
  std::size_t index = 0;  ///< of the series in its document
  std::string case_id, parameters, formulation;

  std::string field;  ///< the one whose error is shown
  std::string norm;   ///< of it
  bool discontinuous = false;
  int finest = 0;         ///< resolution of the level that is shown
  Number error;           ///< at the finest level, absolute
  Number relative_error;  ///< to the same norm of the exact field
  Number order, half_width;
  Number lower, upper;                  ///< ends of the order's interval
  Number floor, floor_low, floor_high;  ///< what the error tends to, and its interval; as relative_error
  TargetResolution percent_target;  ///< where the fitted law comes down to 1%; an empty remark: nothing known
  Number round_off;                 ///< error that rounding alone explains, the largest at the finest level
  Number seed_half_width;           ///< of the error's 95% interval by its scatter over seeds
  std::string verdict, reason;      ///< of the order
  std::string failures;             ///< "unstable 3/5" at the finest level, empty if none
  Number wall_flux_error;     ///< largest over the walls at the finest level, relative to the largest flux in
                              ///< the domain
  Number energy_drift;        ///< largest at the finest level, relative to the energy
  Number wall_budget_defect;  ///< the same
  bool is_timed_apart = false;  ///< on several machines: it has no times
  Number seconds;             ///< mean at the finest level
  MedianSeconds median{};     ///< means of the medians and of the ends of their intervals there
  Number busy;                ///< lowest of the series: processor time over wall time
  TimeToTarget to_percent, to_permille;  ///< to 1% and to 0.1% of the exact field's norm
  bool heat_crosses_walls = false;       ///< an exact wall flux is not zero
  Number time_error_share;               ///< largest over all runs of the series
  bool time_error_is_unknown = false;    ///< of a run at the finest level that was integrated in time

  // Of a moving gas, the worst at the finest level.
  Number plateau_pressure;      ///< relative error behind a shock
  Number shock_position_error;  ///< [m]
  Number wall_heating;          ///< relative error of the internal energy nearest a wall
  Number wall_impulse_defect;   ///< of the largest impulse that a wall prescribes
  Number momentum_drift;        ///< of the same; where walls prescribe none, of sqrt(2 mass energy), which no
                                ///< momentum of that gas exceeds
  Number energy_pair_drift;     ///< of the energy
  Number energy_routes;         ///< relative difference between the two work forms

  // Drifts, taken apart, the worst at the finest level.
  Number energy_step_drift;                   ///< what time stepping left, of the energy
  Number momentum_pair_drift;                 ///< what pairs created, of the momentum's scale
  Number energy_rounding, momentum_rounding;  ///< up to where a drift says nothing

  std::optional<Stability> stability;   ///< worst of the finest level: the most growth, the shortest steps
  std::optional<SecondLaw> second_law;  ///< the same: the largest breaches, the smallest entropy production
};

/// One series of a document, at its finest level or at that of a resolution.
SeriesRow series_row(NamedResults const& document, Series const& series, std::string const& region,
                     std::string const& norm, std::optional<int> resolution = std::nullopt);

/// The rows of all documents, in their order.
/// @param norm empty: l1 where the solution jumps, else l2
std::vector<SeriesRow> series_rows(std::vector<NamedResults> const& documents, std::string const& region,
                                   std::string const& norm);

}  // namespace sphverify
