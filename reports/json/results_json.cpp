// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/json/results_json.hpp"

#include <cmath>

#include "reports/json/lists_json.hpp"
#include "reports/json/surface_json.hpp"

namespace sphverify {

namespace {

Json to_json(NormSet const& norms) {
  return {{"l1", number(norms.l1)}, {"l2", number(norms.l2)}, {"linf", number(norms.linf)}};
}

Json errors_json(std::map<std::string, FieldErrors> const& errors) {
  Json fields = Json::object();
  for (auto const& [field, regions] : errors) {
    for (auto const& [region, e] : regions) {
      Json entry = to_json(e.error);
      entry["scale"] = to_json(e.scale);
      entry["round_off"] = number(e.round_off);
      if (e.initial) entry["initial"] = to_json(*e.initial);
      if (e.mean) entry["mean"] = number(*e.mean);
      if (e.allowed) entry["allowed"] = to_json(*e.allowed);
      fields[field][region] = entry;
    }
  }
  return fields;
}

Json to_json(Budget const& b) {
  return {{"initial", number(b.initial)},       {"final", number(b.final)},
          {"exchanged", number(b.exchanged)},   {"drift", number(b.drift)},
          {"pair_drift", number(b.pair_drift)}, {"wall_budget_defect", number(b.wall_budget_defect)}};
}

/// Momentum is a vector: each entry is the list of its components.
Json conservation_json(RunRecord const& run) {
  Json all = {{"mass", nullptr}, {"momentum", nullptr}, {"energy", nullptr}};
  for (auto const& [quantity, b] : run.conservation) all[quantity] = to_json(b);
  for (Budget const& component : run.momentum) {
    Json const budget = to_json(component);
    for (auto const& [key, value] : budget.items()) all["momentum"][key].push_back(value);
  }
  return all;
}

Json to_json(WallBudget const& w) {
  Json defect = Json::array();
  for (std::size_t k = 0; k < w.impulse.size(); ++k)
    defect.push_back(number(w.impulse[k] - w.prescribed_impulse[k]));
  return {
      {"position", numbers(w.position)},
      {"impulse",
       {{"measured", numbers(w.impulse)}, {"prescribed", numbers(w.prescribed_impulse)}, {"defect", defect}}},
      {"energy",
       {{"measured", number(w.energy)},
        {"prescribed", number(w.prescribed_energy)},
        {"defect", number(w.energy - w.prescribed_energy)},
        {"heat", number(w.heat)}}}};
}

Json to_json(ShockRecord const& s) {
  return {{"position", number(s.position)},
          {"position_error", number(s.position_error)},
          {"plateau",
           {{"pressure", number(s.plateau_pressure)},
            {"density", number(s.plateau_density)},
            {"velocity", number(s.plateau_velocity)}}}};
}

Json to_json(Motion const& m) {
  return {{"steps_bound_by", m.steps_bound_by},           {"smallest_step", number(m.smallest_step)},
          {"largest_step", number(m.largest_step)},       {"lowest_density", number(m.lowest_density)},
          {"lowest_pressure", number(m.lowest_pressure)}, {"volume_defect", number(m.volume_defect)},
          {"wall_heating", number(m.wall_heating)},       {"energy_routes", number(m.energy_routes)}};
}

/// Beside the seconds that they are the median of.
void put_median(Json& json, MedianSeconds const& m) {
  json["median_seconds"] = number(m.median);
  json["low_seconds"] = number(m.low);
  json["high_seconds"] = number(m.high);
}

}  // namespace

Json to_json(Cost const& c) {
  Json json = {{"seconds", number(c.seconds)},
               {"cpu_seconds", number(c.cpu_seconds)},
               {"setup_seconds", c.is_counted() ? number(c.setup_seconds) : Json(nullptr)}};
  put_median(json, c.median);
  json["busy"] = number(c.busy);
  json["repeats"] = c.repeats;
  json["batch"] = c.batch;
  json["warm_up"] = c.warm_up;
  if (!c.machine.empty()) json["machine"] = c.machine;
  json["occasion"] = c.occasion.empty() ? Json(nullptr) : Json(c.occasion);
  json["round_seconds"] = numbers(c.round_seconds);
  auto const counted = [&](std::uint64_t n) { return c.is_counted() ? Json(n) : Json(nullptr); };
  json["steps"] = counted(c.steps);
  json["rate_evaluations"] = counted(c.rate_evaluations);
  json["pair_interactions"] = counted(c.pair_interactions);
  json["peak_bytes"] = c.peak_bytes > 0 ? Json(c.peak_bytes) : Json(nullptr);
  return json;
}

namespace {

Json to_json(Mode const& m) {
  return {{"growth", number(m.growth)},
          {"frequency", number(m.frequency)},
          {"wavelength", number(m.wavelength)},
          {"wall_share", number(m.wall_share)},
          {"centre", numbers(m.centre)}};
}

Json to_json(Stability const& s) {
  auto const count = [](std::optional<std::uint64_t> n) { return n ? Json(*n) : Json(nullptr); };
  Json steps = Json::object();
  for (auto const& [method, step] : s.stable_steps) {
    steps[method] = {
        {"theory", number(step.theory)}, {"measured", number(step.measured)}, {"remark", step.remark}};
  }
  Json json = {{"spectral_abscissa", number(s.spectral_abscissa)},
               {"abscissa_uncertainty", number(s.abscissa_uncertainty)},
               {"spectral_radius", number(s.spectral_radius)},
               {"largest_imaginary", number(s.largest_imaginary)},
               {"largest_stable_step", number(s.largest_stable_step)},
               {"growing_modes", count(s.growing_modes)},
               {"unseen_modes", count(s.unseen_modes)},
               {"method", s.method},
               {"worst_mode", s.worst_mode ? to_json(*s.worst_mode) : Json(nullptr)},
               {"stable_steps", steps},
               {"remark", s.remark}};
  if (!s.modes.empty()) {
    json["modes"] = Json::array();
    for (Mode const& mode : s.modes) json["modes"].push_back(to_json(mode));
  }
  return json;
}

Json to_json(Breach const& b) {
  return {{"size", number(b.size)}, {"time", number(b.time)}, {"position", numbers(b.position)}};
}

Json to_json(SecondLaw const& s) {
  return {{"overshoot", to_json(s.overshoot)},
          {"undershoot", to_json(s.undershoot)},
          {"cold_to_hot", to_json(s.cold_to_hot)},
          {"smallest_entropy_production", number(s.smallest_entropy_production)},
          {"instants", s.instants},
          {"remark", s.remark}};
}

Json to_json(Integration const& i) {
  return {{"method", i.method},
          {"relative_tolerance", number(i.relative_tolerance)},
          {"absolute_tolerance", number(i.absolute_tolerance)},
          {"courant_factor", number(i.courant_factor)},
          {"time_error", number(i.time_error)},
          {"time_error_share", number(i.time_error_share)},
          {"remark", i.remark}};
}

Json to_json(ErrorLaw const& law) {
  return {{"floor", number(law.floor)},
          {"coefficient", number(law.coefficient)},
          {"exponent", number(law.exponent)},
          {"next_coefficient", number(law.next_coefficient)},
          {"next_exponent", number(law.next_exponent)}};
}

Json to_json(OrderEntry const& e) {
  Json json = {{"field", e.field}, {"region", e.region}, {"norm", e.norm}, {"allowed", e.allowed}};
  json.update(to_json(e.observed));
  json["levels"] = Json::array();
  for (SeriesLevel const& level : e.levels) {
    json["levels"].push_back({{"resolution", level.resolution},
                              {"spacing", number(level.spacing)},
                              {"replicates", level.replicates},
                              {"error", number(level.error)},
                              {"spread", number(level.spread)},
                              {"mean", number(level.mean)},
                              {"seconds", number(level.seconds)}});
    put_median(json["levels"].back(), level.median);
  }
  return json;
}

Json to_json(Envelope const& e) {
  Json json = {{"case", e.case_id}, {"parameters", parameters_json(e.parameters)}};
  put_formulation(json, e.formulation);
  json["label"] = e.label;
  json["discretisation"] = to_json(e.discretisation);
  json["resolution"] = e.resolution;
  json["parameter"] = e.parameter;
  json["scale"] = e.logarithmic ? "logarithmic" : "linear";
  json["held"] = number(e.held);
  json["failed"] = number(e.failed);
  json["status"] = e.status;
  json["reason"] = e.reason.empty() ? Json(nullptr) : Json(e.reason);
  json["points"] = Json::array();
  for (Envelope::Point const& point : e.points)
    json["points"].push_back({{"value", number(point.value)}, {"status", point.status}});
  return json;
}

Json to_json(Share const& share) { return {{"context", to_json(share.context)}, {"runs", share.runs}}; }

Json to_json(Skipped const& s) { return {{"case", s.case_id}, {"formulation", s.formulation}, {"reason", s.reason}}; }

Json to_json(Series const& s) {
  Json json = {{"case", s.case_id}, {"parameters", parameters_json(s.parameters)}};
  put_formulation(json, s.formulation);
  json["label"] = s.label;
  json["discretisation"] = to_json(s.discretisation);
  // Replicates differ in the seed alone: a series has none.
  if (json["discretisation"]["layout"].is_object()) json["discretisation"]["layout"].erase("seed");
  json["smoothing_exponent"] = s.smoothing_exponent;
  json["discontinuous"] = s.discontinuous;
  if (s.is_timed_apart) json["is_timed_apart"] = true;
  json["runs"] = s.runs;
  json["orders"] = Json::array();
  for (OrderEntry const& entry : s.orders) json["orders"].push_back(to_json(entry));
  json["time_to_error"] = Json::array();
  for (TimeToError const& t : s.time_to_error) {
    json["time_to_error"].push_back({{"field", t.field},
                                     {"region", t.region},
                                     {"norm", t.norm},
                                     {"relative", number(t.relative)},
                                     {"error", number(t.error)},
                                     {"seconds", number(t.seconds)},
                                     {"is_bound", t.is_bound}});
    put_median(json["time_to_error"].back(), t.median);
  }
  return json;
}

}  // namespace

Json to_json(Discretisation const& d) {
  return {{"kernel", d.kernel},
          {"pair_weight", d.pair_weight},
          {"density", d.density},
          {"smoothing_ratio", d.smoothing_ratio},
          {"layout", to_json(d.layout)},
          {"face_weight", d.face_weight},
          {"closure", d.closure},
          {"integrator", d.integrator},
          {"smoothing", d.smoothing},
          {"wall_motion", d.wall_motion},
          {"viscosity", to_json(d.viscosity)}};
}

void put_formulation(Json& json, FormulationChoice const& f) {
  json["formulation"] = f.id;
  json["work"] = f.work.empty() ? Json(nullptr) : Json(f.work);
  json["conduction"] = f.conduction.empty() ? Json(nullptr) : Json(f.conduction);
  json["walls"] = f.walls.word;
}

Json to_json(ObservedOrder const& o) {
  Json pairwise = Json::array();
  for (Number const& p : o.pairwise) pairwise.push_back(number(p));
  Json json = {{"order", number(o.order)},
               {"interval", o.lower ? Json::array({number(o.lower), number(o.upper)}) : Json(nullptr)},
               {"pairwise", pairwise},
               {"verdict", o.verdict},
               {"reason", o.reason},
               {"model", o.model.empty() ? Json(nullptr) : Json(o.model)},
               {"law", o.law ? to_json(*o.law) : Json(nullptr)},
               {"floor", nullptr},
               {"targets", Json::array()}};
  if (o.floor) {
    json["floor"] = {{"value", number(o.floor->value)},
                     {"interval", Json::array({number(o.floor->lower), number(o.floor->upper)})}};
  }
  for (TargetResolution const& target : o.targets) {
    json["targets"].push_back({{"error", number(target.error)},
                               {"relative", number(target.relative)},
                               {"N", number(target.resolution)},
                               {"remark", target.remark}});
  }
  return json;
}

Json to_json(Context const& c) {
  Json json = {{"version", c.version},     {"commit", c.commit}, {"compiler", c.compiler}, {"flags", c.flags},
               {"processor", c.processor}, {"cores", c.cores},   {"date", c.date},
               {"program", c.program},     {"added", c.added}};
  if (!c.machine.empty()) json["machine"] = c.machine;
  return json;
}

Json parameters_json(std::map<std::string, ParameterValue> const& parameters) {
  Json json = Json::object();
  for (auto const& [name, value] : parameters) {
    // Whole numbers are written as such: a degree is 2, not 2.0.
    if (auto const* plain = std::get_if<double>(&value);
        plain && *plain == std::floor(*plain) && std::abs(*plain) < 1e15) {
      json[name] = static_cast<std::int64_t>(*plain);
    } else {
      std::visit([&json, &key = name](auto const& v) { json[key] = v; }, value);
    }
  }
  return json;
}

Json to_json(LayoutChoice const& layout) {
  Json json = {{"id", layout.id}};
  if (layout.id == "clumped") json["separation"] = layout.amplitude;
  if (layout.id == "touching") json["gap"] = layout.amplitude;
  if (layout.id == "jittered") json["amplitude"] = layout.amplitude;
  if (is_drawn(layout)) json["seed"] = layout.seed;
  if (layout.voronoi_masses) json["masses"] = "voronoi";
  return json.size() > 1 ? json : Json(layout.id);
}

Json to_json(ViscosityChoice const& v) {
  if (v.riemann) return "riemann";
  if (v == ViscosityChoice{}) return "off";
  return {{"alpha", v.alpha}, {"beta", v.beta}};
}

Json to_json(FormulationChoice const& f) {
  Json json = {{"id", f.id}, {"walls", f.walls.word}};
  if (!f.work.empty()) json["work"] = f.work;
  if (!f.conduction.empty()) json["conduction"] = f.conduction;
  return json;
}

Json to_json(RunRecord const& r) {
  Json json = {{"case", r.case_id}, {"parameters", parameters_json(r.parameters)}};
  put_formulation(json, r.formulation);
  json["label"] = r.label;
  json["discretisation"] = to_json(r.discretisation);
  json["smoothing_exponent"] = r.smoothing_exponent;
  json["resolution"] = r.resolution;
  json["particles"] = r.particles;
  json["spacing"] = number(r.spacing);
  json["smoothing_length"] = number(r.smoothing_length);
  json["status"] = r.status;
  json["reason"] = r.reason.empty() ? Json(nullptr) : Json(r.reason);
  json["remarks"] = r.remarks;
  if (!r.output.empty()) json["output"] = r.output;
  Json passes = Json::array();
  Json counts = Json::object();
  for (auto const& [pass, times] : r.scene.passes) {
    passes.push_back(pass);
    counts[pass] = times;
  }
  json["scene"] = {{"fields", r.scene.fields}, {"passes", passes}, {"pass_counts", counts}};
  if (r.smallest_face_weight) json["scene"]["smallest_face_weight"] = number(*r.smallest_face_weight);
  json["errors"] = errors_json(r.errors);
  json["conservation"] = conservation_json(r);
  json["wall_flux"] = Json::array();
  for (WallFlux const& w : r.wall_flux) {
    json["wall_flux"].push_back({{"measured", number(w.measured)},
                                 {"exact", number(w.exact)},
                                 {"error", number(w.error)},
                                 {"scale", number(w.scale)}});
  }
  if (r.motion) {
    json["wall_budgets"] = Json::array();
    for (WallBudget const& wall : r.wall_budgets) json["wall_budgets"].push_back(to_json(wall));
    json["shocks"] = Json::array();
    for (ShockRecord const& shock : r.shocks) json["shocks"].push_back(to_json(shock));
    json["motion"] = to_json(*r.motion);
  } else if (!r.shocks.empty()) {  // of a code that is not ours
    json["shocks"] = Json::array();
    for (ShockRecord const& shock : r.shocks) json["shocks"].push_back(to_json(shock));
  }
  json["cost"] = r.cost ? to_json(*r.cost) : Json(nullptr);
  json["stability"] = r.stability ? to_json(*r.stability) : Json(nullptr);
  if (r.second_law) json["second_law"] = to_json(*r.second_law);
  json["integration"] = r.integration ? to_json(*r.integration) : Json(nullptr);
  if (r.profile) json["profile"] = to_json(*r.profile);
  if (r.history) json["history"] = to_json(*r.history, r.motion.has_value() || !r.momentum.empty());
  if (!r.spectrum.empty()) json["spectrum"] = number_lists(r.spectrum);
  return json;
}

Json top_json(Results const& results) {
  Json json = {{"schema", "sphverify-results/1"},
               {"context", to_json(results.context)},
               {"study", Json::parse(results.study)}};
  if (results.part) json["part"] = {{"runs", *results.part}};
  return json;
}

std::vector<ResultsList> lists_of(Results const& results) {
  std::vector<ResultsList> lists;
  auto const add = [&](char const* name, auto const& entries) {
    lists.push_back({name, entries.size(), [&entries](std::size_t k) { return to_json(entries[k]); }});
  };
  if (!results.shares.empty()) add("shares", results.shares);
  add("runs", results.runs);
  add("series", results.series);
  if (!results.surfaces.empty()) add("surfaces", results.surfaces);
  add("skipped", results.skipped);
  if (!results.envelopes.empty()) add("envelopes", results.envelopes);
  return lists;
}

Json to_json(Results const& results) {
  Json json = top_json(results);
  for (ResultsList const& list : lists_of(results)) {
    Json& entries = json[list.name] = Json::array();
    for (std::size_t k = 0; k < list.size; ++k) entries.push_back(list.entry(k));
  }
  return json;
}

}  // namespace sphverify
