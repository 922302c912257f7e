// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <functional>
#include <utility>

#include "reports/hdf5.hpp"
#include "reports/json/checked_numbers.hpp"
#include "reports/json/lists_json.hpp"
#include "reports/json/results_json.hpp"
#include "reports/json/series_json.hpp"
#include "reports/json/surface_json.hpp"
#include "reports/run_statuses.hpp"

namespace sphverify {

std::map<std::string, ParameterValue> read_parameters(Node const& node) {
  std::map<std::string, ParameterValue> parameters;
  for (auto const& [name, value] : node.members()) {
    if (value.is_string()) {
      parameters[name] = value.string();
    } else if (!value.is_array()) {
      parameters[name] = value.number();
    } else if (auto const elements = value.elements(); !elements.empty() && elements.front().is_array()) {
      std::vector<std::vector<double>> table;
      for (Node const& row : elements) table.push_back(row.numbers());
      parameters[name] = table;
    } else {
      parameters[name] = value.numbers();
    }
  }
  return parameters;
}

FormulationChoice read_formulation(Node const& node) {
  FormulationChoice f;
  f.id = node.at("formulation").string();
  f.work = optional_string(node.at("work"));
  f.conduction = optional_string(node.at("conduction"));
  f.walls = WallChoice(node.at("walls").string());
  return f;
}

Discretisation read_discretisation(Node const& node) {
  Discretisation d;
  d.kernel = node.at("kernel").string();
  d.density = node.at("density").string();
  d.smoothing_ratio = node.at("smoothing_ratio").positive_number();
  Node const layout = node.at("layout");
  if (layout.is_string()) {
    d.layout = {layout.string()};
  } else {
    d.layout.id = layout.at("id").string();
    for (char const* key : {"amplitude", "separation", "gap"}) {
      if (auto const amplitude = layout.find(key)) d.layout.amplitude = amplitude->number();
    }
    if (auto const seed = layout.find("seed")) d.layout.seed = count(*seed);
    d.layout.voronoi_masses = layout.find("masses").has_value();
  }
  if (auto const weight = node.find("pair_weight")) d.pair_weight = weight->string();  // 0.2 had the kernel's alone
  d.face_weight = node.at("face_weight").string();
  d.closure = node.at("closure").string();
  d.integrator = node.at("integrator").string();
  d.smoothing = node.at("smoothing").string();
  d.wall_motion = node.at("wall_motion").string();
  if (Node const v = node.at("viscosity"); v.is_string()) {
    d.viscosity.riemann = v.string() == "riemann";
  } else {
    d.viscosity = {v.at("alpha").number(), v.at("beta").number()};
  }
  return d;
}

Cost read_cost(Node const& node) {
  Cost c;
  c.seconds = size_of(node.at("seconds"));
  c.cpu_seconds = optional_size(node.at("cpu_seconds"));
  auto const counted = [&](char const* key) { return node.at(key).is_null() ? 0 : count(node.at(key)); };
  if (!node.at("setup_seconds").is_null()) c.setup_seconds = size_of(node.at("setup_seconds"));
  c.median = read_median(node);
  if (auto const busy = node.find("busy")) c.busy = optional_size(*busy);
  c.repeats = static_cast<int>(count(node.at("repeats")));
  if (auto const batch = node.find("batch")) c.batch = static_cast<int>(count(*batch));
  if (auto const warm_up = node.find("warm_up")) c.warm_up = warm_up->boolean();
  if (auto const machine = node.find("machine")) c.machine = machine->string();
  if (auto const occasion = node.find("occasion"); occasion && !occasion->is_null())
    c.occasion = occasion->string();
  if (auto const rounds = node.find("round_seconds")) {
    for (Node const& round : rounds->elements()) c.round_seconds.push_back(size_of(round));
  }
  c.steps = counted("steps");
  c.rate_evaluations = counted("rate_evaluations");
  c.pair_interactions = counted("pair_interactions");
  c.peak_bytes = counted("peak_bytes");
  return c;
}

namespace {

Mode read_mode(Node const& node) {
  return {measured(node.at("growth")), measured(node.at("frequency")), optional_number(node.at("wavelength")),
          optional_number(node.at("wall_share")), measured_list(node.at("centre"))};
}

Stability read_stability(Node const& node) {
  Stability s;
  s.spectral_abscissa = optional_number(node.at("spectral_abscissa"));
  s.abscissa_uncertainty = optional_size(node.at("abscissa_uncertainty"));
  s.spectral_radius = optional_size(node.at("spectral_radius"));
  s.largest_stable_step = optional_size(node.at("largest_stable_step"));
  if (!node.at("growing_modes").is_null()) s.growing_modes = count(node.at("growing_modes"));
  s.remark = node.at("remark").string();
  s.largest_imaginary = optional_number(node.at("largest_imaginary"));
  if (!node.at("unseen_modes").is_null()) s.unseen_modes = count(node.at("unseen_modes"));
  s.method = node.at("method").string();
  if (!node.at("worst_mode").is_null()) s.worst_mode = read_mode(node.at("worst_mode"));
  for (auto const& [method, step] : node.at("stable_steps").members()) {
    s.stable_steps[method] = {optional_size(step.at("theory")), optional_size(step.at("measured")),
                              step.at("remark").string()};
  }
  if (auto const modes = node.find("modes")) {
    for (Node const& mode : modes->elements()) s.modes.push_back(read_mode(mode));
  }
  return s;
}

SecondLaw read_second_law(Node const& node) {
  auto const breach = [&](char const* key) {
    Node const b = node.at(key);
    return Breach{size_of(b.at("size")), measured(b.at("time")), measured_list(b.at("position"))};
  };
  return {breach("overshoot"),        breach("undershoot"),
          breach("cold_to_hot"),      optional_number(node.at("smallest_entropy_production")),
          node.at("remark").string(), node.find("instants") ? count(node.at("instants")) : 0};
}

Envelope read_envelope(Node const& node) {
  Envelope e;
  e.case_id = node.at("case").string();
  e.parameters = read_parameters(node.at("parameters"));
  e.formulation = read_formulation(node);
  e.label = node.at("label").string();
  e.discretisation = read_discretisation(node.at("discretisation"));
  e.resolution = read_resolution(node);
  e.parameter = node.at("parameter").string();
  e.logarithmic = node.at("scale").string() == "logarithmic";
  e.held = optional_number(node.at("held"));
  e.failed = optional_number(node.at("failed"));
  e.status = node.at("status").word(run_statuses);
  e.reason = optional_string(node.at("reason"));
  for (Node const& point : node.at("points").elements())
    e.points.push_back({measured(point.at("value")), point.at("status").word(run_statuses)});
  return e;
}

Integration read_integration(Node const& node) {
  return {node.at("method").string(),
          optional_number(node.at("relative_tolerance")),
          optional_number(node.at("absolute_tolerance")),
          optional_number(node.at("courant_factor")),
          optional_number(node.at("time_error")),
          optional_number(node.at("time_error_share")),
          node.find("remark") ? node.at("remark").string() : ""};
}

Budget read_budget(Node const& b) {
  return {measured(b.at("initial")),           measured(b.at("final")),
          measured(b.at("exchanged")),         measured(b.at("drift")),
          optional_number(b.at("pair_drift")), optional_number(b.at("wall_budget_defect"))};
}

/// Component k of a momentum budget, whose entries are lists.
Budget read_component(Node const& b, std::size_t k) {
  auto const at = [&](char const* key) {
    auto const components = b.at(key).elements();
    if (k >= components.size()) b.at(key).complain("one number per dimension");
    return components[k];
  };
  return {measured(at("initial")),           measured(at("final")),
          measured(at("exchanged")),         measured(at("drift")),
          optional_number(at("pair_drift")), optional_number(at("wall_budget_defect"))};
}

WallBudget read_wall_budget(Node const& node) {
  Node const impulse = node.at("impulse");
  Node const energy = node.at("energy");
  return {measured_list(node.at("position")),      measured_list(impulse.at("measured")),
          measured_list(impulse.at("prescribed")), measured(energy.at("measured")),
          measured(energy.at("prescribed")),       measured(energy.at("heat"))};
}

ShockRecord read_shock(Node const& node) {
  Node const plateau = node.at("plateau");
  return {measured(node.at("position")), optional_number(node.at("position_error")),
          optional_number(plateau.at("pressure")), optional_number(plateau.at("density")),
          optional_number(plateau.at("velocity"))};
}

Motion read_motion(Node const& node) {
  Motion m;
  for (auto const& [limit, steps] : node.at("steps_bound_by").members())
    m.steps_bound_by[limit] = count(steps);
  m.smallest_step = optional_size(node.at("smallest_step"));
  m.largest_step = optional_size(node.at("largest_step"));
  m.lowest_density = measured(node.at("lowest_density"));
  m.lowest_pressure = measured(node.at("lowest_pressure"));
  m.volume_defect = optional_number(node.at("volume_defect"));
  m.wall_heating = optional_number(node.at("wall_heating"));
  m.energy_routes = optional_number(node.at("energy_routes"));
  return m;
}

}  // namespace

RunRecord read_run(Node const& node) {
  RunRecord r;
  r.case_id = node.at("case").string();
  r.parameters = read_parameters(node.at("parameters"));
  r.formulation = read_formulation(node);
  r.label = node.at("label").string();
  r.discretisation = read_discretisation(node.at("discretisation"));
  r.smoothing_exponent = node.at("smoothing_exponent").number();
  r.resolution = read_resolution(node);
  r.particles = count(node.at("particles"));
  r.spacing = size_of(node.at("spacing"));
  r.smoothing_length = size_of(node.at("smoothing_length"));
  r.status = node.at("status").word(run_statuses);
  r.reason = optional_string(node.at("reason"));
  if (auto const output = node.find("output")) r.output = output->string();
  if (auto const remarks = node.find("remarks")) {
    for (Node const& remark : remarks->elements()) r.remarks.push_back(remark.string());
  }
  for (Node const& field : node.at("scene").at("fields").elements()) r.scene.fields.push_back(field.string());
  for (auto const& [pass, times] : node.at("scene").at("pass_counts").members())
    r.scene.passes[pass] = count(times);
  if (auto const smallest = node.at("scene").find("smallest_face_weight")) {
    r.smallest_face_weight = optional_number(*smallest);
  }
  for (auto const& [field, regions] : node.at("errors").members()) {
    for (auto const& [region, e] : regions.members()) {
      RegionError& error = r.errors[field][region];
      error = {read_norms(e), read_norms(e.at("scale")), size_of(e.at("round_off"))};
      if (auto const initial = e.find("initial")) error.initial = read_norms(*initial);
      error.mean = found_number(e, "mean");
      if (auto const allowed = e.find("allowed")) error.allowed = read_sizes(*allowed);
    }
  }
  // Ladders are errors over spacings.
  if (!r.errors.empty() && !(r.spacing > 0.0)) node.at("spacing").complain("a positive number, where there are errors");
  for (auto const& [quantity, b] : node.at("conservation").members()) {
    if (b.is_null()) continue;
    if (quantity == "momentum") {
      std::size_t const components = b.at("initial").elements().size();
      if (components > 3) b.at("initial").complain("one number per dimension");
      for (std::size_t k = 0; k < components; ++k) r.momentum.push_back(read_component(b, k));
    } else {
      r.conservation[quantity] = read_budget(b);
    }
  }
  if (auto const walls = node.find("wall_budgets")) {
    for (Node const& wall : walls->elements()) r.wall_budgets.push_back(read_wall_budget(wall));
  }
  if (auto const shocks = node.find("shocks")) {
    for (Node const& shock : shocks->elements()) r.shocks.push_back(read_shock(shock));
  }
  if (auto const motion = node.find("motion")) r.motion = read_motion(*motion);
  for (Node const& w : node.at("wall_flux").elements()) {
    r.wall_flux.push_back({measured(w.at("measured")), measured(w.at("exact")), measured(w.at("error")),
                           size_of(w.at("scale"))});
  }
  if (Node const cost = node.at("cost"); !cost.is_null()) r.cost = read_cost(cost);
  if (Node const stability = node.at("stability"); !stability.is_null())
    r.stability = read_stability(stability);
  if (auto const second_law = node.find("second_law")) r.second_law = read_second_law(*second_law);
  if (Node const integration = node.at("integration"); !integration.is_null()) {
    r.integration = read_integration(integration);
  }
  if (auto const profile = node.find("profile")) r.profile = read_profile(*profile);
  if (auto const history = node.find("history")) r.history = read_history(*history);
  if (auto const spectrum = node.find("spectrum")) r.spectrum = measured_lists(*spectrum);
  return r;
}

namespace {

Context read_context(Node const& node) {
  Context context{node.at("version").string(),
                  node.at("commit").string(),
                  node.at("compiler").string(),
                  node.at("flags").string(),
                  node.at("processor").string(),
                  node.at("date").string(),
                  static_cast<int>(node.at("cores").integer(0, 1 << 30))};
  // Documents of 0.1 have none of these.
  if (auto const program = node.find("program")) context.program = program->string();
  if (auto const added = node.find("added")) {
    for (Node const& id : added->elements()) context.added.push_back(id.string());
  }
  if (auto const machine = node.find("machine")) context.machine = machine->string();
  return context;
}

}  // namespace

namespace {

using Entry = std::function<void(Node const&)>;
/// Calls back with each entry of one of the document's lists; returns whether the document has it.
using Lists = std::function<bool(std::string const& list, Entry const& entry)>;

Results results_of(Node const& document, Lists const& lists) {
  document.require_schema("sphverify-results/1");
  auto const read_list = [&](char const* list, Entry const& entry) {
    if (!lists(list, entry)) throw UserError(document.file(), list, "nothing", "this key");
  };
  Results results;
  results.context = read_context(document.at("context"));
  results.study = document.at("study").json().dump();
  if (auto const part = document.find("part")) {
    results.part.emplace();
    for (Node const& run : part->at("runs").elements()) results.part->push_back(count(run));
  }
  lists("shares", [&](Node const& share) { results.shares.push_back({read_context(share.at("context")), count(share.at("runs"))}); });
  read_list("runs", [&](Node const& run) { results.runs.push_back(read_run(run)); });
  read_list("series", [&](Node const& series) {
    results.series.push_back(read_series(series));
    for (std::size_t const run : results.series.back().runs) {
      if (run >= results.runs.size()) series.at("runs").complain("indices of runs in this document");
    }
  });
  lists("surfaces", [&](Node const& surface) { results.surfaces.push_back(read_surface(surface)); });
  read_list("skipped", [&](Node const& s) {
    results.skipped.push_back({s.at("case").string(), s.at("formulation").string(), s.at("reason").string()});
  });
  lists("envelopes", [&](Node const& envelope) { results.envelopes.push_back(read_envelope(envelope)); });
  return results;
}

Results results_of(Json const& json, std::string const& path) {
  Node const document(json, path);
  return results_of(document, [&](std::string const& list, Entry const& entry) {
    auto const found = document.find(list);
    if (found) {
      for (Node const& node : found->elements()) entry(node);
    }
    return found.has_value();
  });
}

/// Entries become JSON one after the other, which takes less memory than all of them together.
Results results_of(Column const& columns, std::string const& path) {
  auto const is_list = [](Column const& column) { return column.kind == Column::Kind::list && column.is_full(); };
  Json top = Json::object();
  for (auto const& [key, column] : columns.members) {
    if (!is_list(column)) top[key] = column.row(0);
  }
  return results_of(Node(top, path), [&](std::string const& list, Entry const& entry) {
    auto const found = columns.members.find(list);
    if (found == columns.members.end()) return false;
    if (!is_list(found->second)) Node(top, path).at(list).complain("a list");
    Column const& entries = found->second.elements.front();
    for (std::size_t k = 0; k < entries.rows(); ++k) {
      Json const json = entries.row(k);
      entry(Node(json, path, fmt::format("{}[{}]", list, k)));
    }
    return true;
  });
}

}  // namespace

Results read_results(std::string const& path) {
  std::string bytes = read_file(path);
  if (is_hdf5(bytes)) return results_of(read_hdf5_file(std::move(bytes), path), path);
  Json const json = parse_json(bytes, path);
  bytes = {};
  return results_of(json, path);
}

Results read_whole_results(std::string const& path) {
  Results results = read_results(path);
  if (results.part)
    throw UserError(path, "part", "a part of a study, which has no orders", "a whole one: `sphverify merge` puts parts together");
  return results;
}

}  // namespace sphverify
