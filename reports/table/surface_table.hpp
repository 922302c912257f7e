// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "reports/json/node.hpp"
#include "reports/table/compare.hpp"
#include "reports/table/legend.hpp"
#include "reports/table/setting.hpp"

namespace sphverify {

/// Which h/dx one formulation wants at which N: a surface of a document.
struct SurfaceRow : Setting {
  std::string case_id, parameters, formulation;
  Surface surface;
};

/// The surfaces of all documents, in their order.
std::vector<SurfaceRow> surface_rows(std::vector<NamedResults> const& documents);

/// Per case, of the field that it is about: the answer in a sentence for each formulation, then the best h/dx
/// by resolution, the law that says so, the cheapest path, and what rules for the neighbour number cost
/// beside it.
std::string surfaces_text(std::vector<SurfaceRow> const& rows, CompareOptions const& options);

/// What the marks in that text mean.
std::vector<LegendEntry> surface_legend();

/// A line for each surface (of every field) and resolution with its numbers in full.
std::string surfaces_csv(std::vector<SurfaceRow> const& rows);

/// `{"results", "surface"}` for each surface of every field.
Json surfaces_json(std::vector<SurfaceRow> const& rows);

}  // namespace sphverify
