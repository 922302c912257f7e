// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/html/page_data.hpp"

#include "reports/html/page_curves.hpp"
#include "reports/html/page_json.hpp"
#include "reports/html/page_runs.hpp"
#include "reports/html/page_series.hpp"
#include "reports/html/page_stability.hpp"
#include "reports/html/page_summary.hpp"
#include "reports/html/page_surfaces.hpp"
#include "reports/table/time_ratio.hpp"

namespace sphverify {

namespace page {

namespace {

Json envelopes_json(Results const& results, Dictionary& word) {
  Json list = Json::array();
  for (Envelope const& e : results.envelopes) {
    Json json = {{"case", word(e.case_id)}};
    put_formulation(json, e.formulation, e.label, word);
    json["settings"] = settings_json(e.discretisation, 0.0, e.resolution, word);
    json["resolution"] = e.resolution;
    json["parameter"] = e.parameter;
    json["logarithmic"] = e.logarithmic;
    json["held"] = number(e.held);
    json["failed"] = number(e.failed);
    json["status"] = e.status;
    json["reason"] = e.reason;
    json["points"] = Json::array();
    for (auto const& point : e.points) json["points"].push_back({number(point.value), word(point.status)});
    list.push_back(std::move(json));
  }
  return list;
}

Json skipped_json(Results const& results) {
  Json list = Json::array();
  for (Skipped const& s : results.skipped) list.push_back({s.case_id, s.formulation, s.reason});
  return list;
}

/// @param rows of the document's series
/// @param share how many documents share the room of the page
Json document_json(NamedResults const& document, SeriesRow const* rows, std::size_t share,
                   std::set<std::string> const& controls) {
  Results const& results = document.results;
  Context const& c = results.context;
  Dictionary word;
  std::vector<std::size_t> series_of(results.runs.size(), results.series.size());
  Json series = Json::array();
  for (std::size_t s = 0; s < results.series.size(); ++s) {
    for (std::size_t const run : results.series[s].runs) series_of[run] = s;
    series.push_back(series_json(results.series[s], rows[s], results.runs, controls, word));
  }
  Json json = {{"name", document.name},
               {"context",
                {{"version", c.version},
                 {"commit", c.commit},
                 {"compiler", c.compiler},
                 {"flags", c.flags},
                 {"processor", c.processor},
                 {"cores", c.cores},
                 {"program", c.program},
                 {"added", c.added},
                 {"date", c.date}}},
               {"study", Json::parse(results.study)},
               {"disturbance", disturbance({rows, rows + results.series.size()})},
               {"summary", summary_json(summary_of({rows, rows + results.series.size()}, controls))},
               {"surfaces", surfaces_json(results, controls, word)},
               {"series", std::move(series)},
               {"runs", runs_json(results, series_of, word)},
               {"profiles", profiles_json(results, share)},
               {"histories", histories_json(results, share)},
               {"spectra", spectra_json(results, share)},
               {"stabilities", stabilities_json(results, word)},
               {"perturbations", perturbations_json(results, share)},
               {"second_laws", second_laws_json(results, word)},
               {"envelopes", envelopes_json(results, word)},
               {"skipped", skipped_json(results)}};
  json["words"] = word.words();
  return json;
}

}  // namespace

}  // namespace page

Json page_data(std::vector<NamedResults> const& documents, std::set<std::string> const& controls) {
  auto const rows = series_rows(documents, "all", "");
  Json list = Json::array();
  std::size_t first_row = 0;
  for (NamedResults const& document : documents) {
    list.push_back(page::document_json(document, rows.data() + first_row, documents.size(), controls));
    first_row += document.results.series.size();
  }
  return list;
}

}  // namespace sphverify
