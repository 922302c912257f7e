// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "reports/json/node.hpp"
#include "reports/table/compare.hpp"
#include "reports/table/legend.hpp"
#include "reports/table/setting.hpp"
#include "reports/table/text_table.hpp"

namespace sphverify {

/// How far one formulation went along a parameter: an envelope of a document.
struct EnvelopeRow : Setting {
  std::string case_id, parameters, formulation, parameter;
  int resolution = 0;
  Number held, failed;
  Number to;                   ///< the hardest value that was asked for
  std::string status, reason;  ///< of the failure
};

/// The envelopes of all documents, in their order.
std::vector<EnvelopeRow> envelope_rows(std::vector<NamedResults> const& documents);

/// Per case and parameter: the furthest value that held, the nearest that failed and how; of a layout drawn
/// by lot from the worst to the best of its seeds.
std::vector<TextTable> envelope_tables(std::vector<EnvelopeRow> const& rows);

/// What its marks mean.
std::vector<LegendEntry> envelopes_legend();

/// A line, or an entry, per envelope with its numbers in full.
std::string envelopes_csv(std::vector<EnvelopeRow> const& rows);
Json envelopes_json(std::vector<EnvelopeRow> const& rows);

}  // namespace sphverify
