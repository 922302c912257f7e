#pragma once

#include <string>
#include <vector>

#include "reports/table/compare.hpp"

namespace sphverify {

/// Run time in which a series reaches an error [s].
struct TimeToTarget {
  Number seconds;
  MedianSeconds median{};
  bool is_bound = false;  ///< the coarsest level reached it already
};

/// One series, reduced to what the tables show.
struct SeriesRow {
  std::string document, case_id, parameters, formulation;
  bool walls;
  FormulationChoice choice;
  Discretisation discretisation;
  double smoothing_exponent;

  std::string field;  ///< the one whose error is shown
  std::string norm;   ///< of it
  bool discontinuous = false;
  int finest = 0;         ///< resolution
  Number error;           ///< at the finest level, absolute
  Number relative_error;  ///< to the same norm of the exact field
  Number order, half_width;
  std::string verdict;
  std::string failures;       ///< "unstable 3/5" at the finest level, empty if none
  Number wall_flux_error;     ///< largest over the walls at the finest level, relative to the largest flux in
                              ///< the domain
  Number energy_drift;        ///< largest at the finest level, relative to the energy
  Number wall_budget_defect;  ///< the same
  Number seconds;             ///< mean at the finest level
  MedianSeconds median{};     ///< means of the medians and of the ends of their intervals there
  Number busy;                ///< lowest of the series: processor time over wall time
  TimeToTarget to_percent, to_permille;  ///< to 1% and to 0.1% of the exact field's norm
  bool heat_crosses_walls = false;       ///< an exact wall flux is not zero
  Number time_error_share;               ///< largest over all runs of the series

  // Of a moving gas, the worst at the finest level.
  Number plateau_pressure;      ///< relative error behind a shock
  Number shock_position_error;  ///< [m]
  Number wall_heating;          ///< relative error of the internal energy nearest a wall
  Number wall_impulse_defect;   ///< of the largest impulse that a wall prescribes
  Number momentum_drift;        ///< of the same
  Number energy_pair_drift;     ///< of the energy
  Number energy_routes;         ///< relative difference between the two work forms
};

/// The rows of all documents, in their order.
/// @param norm empty: l1 where the solution jumps, else l2
std::vector<SeriesRow> series_rows(std::vector<NamedResults> const& documents, std::string const& region,
                                   std::string const& norm);

}  // namespace sphverify
