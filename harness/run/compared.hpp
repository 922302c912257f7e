// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "formulations/particles/particles.hpp"
#include "harness/measure/norms.hpp"
#include "reports/results.hpp"

namespace sphverify {

/// A field of a run and what it should be, component by component with one value per particle each: what
/// errors are taken of, and what a profile holds. Refers to values that others keep.
struct ComparedField {
  std::string_view name;
  std::vector<std::span<double const>> computed, exact;
};

/// Ends a run that was ok so far as `non-finite`, if something is not.
/// @param why empty: all is finite
void mark_not_finite(RunRecord& record, std::string const& why);

/// Marks a run of which a field that errors are taken of is no number, or its exact counterpart or a weight
/// where errors are taken.
void require_finite(RunRecord& record, std::vector<ComparedField> const& fields,
                    std::span<double const> weights, std::vector<Region> const& regions);

/// Marks a run of which a wall's flux or a budget is no number though all fields are.
void require_finite_budgets(RunRecord& record);

/// What the errors of a run are taken from.
template <int Dim>
Profile make_profile(Particles<Dim> const& particles, std::vector<ComparedField> const& fields,
                     std::vector<double> const& weights, std::vector<Region> const& regions);

/// Largest change of a run by time stepping relative to its error, over regions and norms; changes within
/// round-off do not count. NaN where one of them is.
double time_error_share(FieldErrors const& change, FieldErrors const& error);
/// The share down to which time stepping is refined.
inline constexpr double largest_time_error_share = 0.01;

/// Records the change of the leading field and that share; what is no number is left out and said.
void put_time_error(double change, double share, Integration& integration);

/// Of a run that stands though the one that would have checked it ran out of time.
inline constexpr char const* half_step_out_of_time =
    "the time budget ended the run with half the step: how far the steps are to blame is not known";
inline constexpr char const* next_tolerance_out_of_time =
    "the time budget ended the run with the next tolerance: what is given is that of the last but one, which bounds it";

inline constexpr char const* no_time_error_because_it_broke = "the run broke: nothing was compared";

}  // namespace sphverify
