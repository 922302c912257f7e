#pragma once

#include <string>
#include <vector>

#include "reports/table/compare.hpp"

namespace sphverify {

/// One series, reduced to what the tables show.
struct SeriesRow {
  std::string document, case_id, parameters, formulation;
  bool walls;
  Discretisation discretisation;
  double smoothing_exponent;

  std::string field;      ///< the one whose error is shown
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
  Number seconds_to_percent;  ///< to 1% of the exact field's norm
  bool percent_is_bound = false;    ///< the coarsest level reached it already
  bool heat_crosses_walls = false;  ///< an exact wall flux is not zero
  Number time_error_share;          ///< largest over all runs of the series
};

/// The rows of all documents, in their order.
std::vector<SeriesRow> series_rows(std::vector<NamedResults> const& documents, std::string const& region,
                                   std::string const& norm);

}  // namespace sphverify
