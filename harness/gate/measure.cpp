#include "harness/gate/measure.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <type_traits>

#include "cases/support/case.hpp"
#include "formulations/support/field.hpp"
#include "harness/gate/select.hpp"
#include "harness/gate/text.hpp"
#include "reports/json/results_json.hpp"
#include "reports/norm_of.hpp"
#include "reports/table/time_ratio.hpp"
#include "reports/user_error.hpp"

namespace sphverify {

namespace {

/// The field that a case is about, the first of these that it has.
constexpr std::array<char const*, 4> leading_fields{"temperature", "velocity", "acceleration", "heating"};

template <class Record>
struct Quantity {
  char const* name;
  std::function<Number(Record const&)> value;
  char const* unit;
};

std::vector<Quantity<Stability>> const& stability_table() {
  static std::vector<Quantity<Stability>> const table{
      {"spectral_abscissa", [](Stability const& s) { return s.spectral_abscissa; }, "1/s"},
      {"spectral_radius", [](Stability const& s) { return s.spectral_radius; }, "1/s"},
      {"largest_stable_step", [](Stability const& s) { return s.largest_stable_step; }, "s"},
      {"growing_modes",
       [](Stability const& s) {
         return s.growing_modes ? Number(static_cast<double>(*s.growing_modes)) : Number();
       },
       ""}};
  return table;
}

std::vector<Quantity<Cost>> const& cost_table() {
  auto const count = [](std::uint64_t Cost::*member) {
    return [member](Cost const& c) { return Number(static_cast<double>(c.*member)); };
  };
  static std::vector<Quantity<Cost>> const table{
      {"seconds", [](Cost const& c) { return Number(c.seconds); }, ""},
      {"median_seconds", [](Cost const& c) { return c.median.median; }, ""},
      {"cpu_seconds", [](Cost const& c) { return c.cpu_seconds; }, ""},
      {"setup_seconds", [](Cost const& c) { return Number(c.setup_seconds); }, ""},
      {"steps", count(&Cost::steps), ""},
      {"rate_evaluations", count(&Cost::rate_evaluations), ""},
      {"pair_interactions", count(&Cost::pair_interactions), ""},
      {"peak_bytes", count(&Cost::peak_bytes), ""}};
  return table;
}

template <class Record>
std::vector<std::string> names_of(std::vector<Quantity<Record>> const& table) {
  std::vector<std::string> names;
  for (auto const& quantity : table) names.emplace_back(quantity.name);
  return names;
}

template <class Record>
Quantity<Record> const& find_quantity(std::vector<Quantity<Record>> const& table, std::string const& name) {
  return *std::find_if(table.begin(), table.end(), [&](auto const& q) { return q.name == name; });
}

/// Puts a number into an entry; what was written as null, or is relative to nothing, is a problem.
void put(Measured& m, Number const& value, std::string const& missing) {
  if (value && std::isfinite(*value)) {
    m.value = value;
  } else {
    m.problem = missing;
  }
}

std::string failure(RunRecord const& run) {
  return run.reason.empty() ? run.status : run.status + ": " + run.reason;
}

/// What the measures share: the gate, the document and the names that were found.
class Measurer {
 public:
  Measurer(Gate const& gate, Results const& results, std::string const* file)
      : gate_(gate), results_(results), file_(file) {}

  std::vector<Measured> operator()() {
    switch (gate_.measure) {
      case GateMeasure::order:
        return of_series([this](Measured& m) { measure_order(m); });
      case GateMeasure::time_to_error:
        return of_series([this](Measured& m) { measure_time(m); });
      case GateMeasure::error:
        return of_runs([this](Measured& m) { measure_error(m); });
      case GateMeasure::conservation:
        return of_runs([this](Measured& m) { measure_budget(m); });
      case GateMeasure::wall_flux:
        return of_runs([this](Measured& m) { measure_wall_flux(m); });
      case GateMeasure::stability:
        return of_runs([this](Measured& m) { measure_stability(m); });
      case GateMeasure::cost:
        return of_runs([this](Measured& m) { measure_cost(m); });
      case GateMeasure::status:
        return of_runs([](Measured& m) { m.word = m.run->status; });
    }
    return {};
  }

 private:
  using Fill = std::function<void(Measured&)>;

  /// The selected runs of every series that the gate's level choice takes.
  std::vector<RunRecord const*> levels(Series const& series) const {
    std::vector<RunRecord const*> selected;
    int finest = 0;
    for (std::size_t const index : series.runs) {
      RunRecord const& run = results_.runs[index];
      if (!matches(gate_.select, run) || is_reference(run.formulation)) continue;
      selected.push_back(&run);
      finest = std::max(finest, run.resolution);
    }
    if (gate_.levels == LevelChoice::all) return selected;
    int const wanted = gate_.levels == LevelChoice::one ? gate_.resolution : finest;
    std::erase_if(selected, [&](RunRecord const* run) { return run->resolution != wanted; });
    return selected;
  }

  std::vector<Measured> of_runs(Fill const& fill) {
    std::vector<Measured> all;
    for (Series const& series : results_.series) {
      for (RunRecord const* run : levels(series)) {
        Measured& m = all.emplace_back();
        m.run = run;
        m.series = &series;
        // A spectrum is that of the scheme on its particles, whatever became of the run.
        bool const may_fail = gate_.measure == GateMeasure::status || gate_.measure == GateMeasure::stability;
        if (run->status != "ok" && !may_fail) {
          m.problem = failure(*run);
          continue;
        }
        fill(m);
        sound_ = true;
      }
    }
    require_names();
    return all;
  }

  std::vector<Measured> of_series(Fill const& fill) {
    std::vector<Measured> all;
    for (Series const& series : results_.series) {
      if (!matches(gate_.select, series) || is_reference(series.formulation)) continue;
      Measured& m = all.emplace_back();
      m.series = &series;
      auto const failed = std::find_if(series.runs.begin(), series.runs.end(), [&](std::size_t index) {
        return results_.runs[index].status != "ok";
      });
      if (failed != series.runs.end()) {
        RunRecord const& run = results_.runs[*failed];
        m.problem = fmt::format("at N = {} {}", run.resolution, failure(run));
        continue;
      }
      fill(m);
      sound_ = true;
    }
    require_names();
    return all;
  }

  /// What the key of a gate names must exist somewhere among the sound runs that it selects.
  bool name(std::string const& key, std::string const& wanted, std::set<std::string> const& existing) {
    Named& named = names_[key];
    named.wanted = wanted;
    named.existing.insert(existing.begin(), existing.end());
    bool const found = existing.contains(wanted);
    named.found = named.found || found;
    return found;
  }

  void require_names() const {
    if (file_ == nullptr || !sound_) return;
    for (auto const& [key, named] : names_) {
      if (named.found) continue;
      std::vector<std::string> const existing(named.existing.begin(), named.existing.end());
      throw UserError(*file_, gate_.key + "." + key, "'" + without_control(named.wanted) + "'",
                      existing.empty() ? "what the selected runs have measured, which is none of it"
                                       : one_of(named.wanted, existing));
    }
  }

  /// The run or series itself is what it would be compared to.
  bool is_reference(FormulationChoice const& f) const {
    return !gate_.relative_to.id.empty() && matches(gate_.relative_to, f);
  }

  void measure_error(Measured& m) {
    std::string const field = field_of(gate_, m);
    std::set<std::string> fields;
    for (auto const& [known, regions] : m.run->errors) fields.insert(known);
    m.problem = fmt::format("no error of {} in '{}'", field.empty() ? "any field" : field, gate_.region);
    if (!name("field", field, fields)) return;
    FieldErrors const& regions = m.run->errors.at(field);
    std::set<std::string> known;
    for (auto const& [region, error] : regions) known.insert(region);
    if (!name("region", gate_.region, known)) return;
    m.problem.clear();
    RegionError const& error = regions.at(gate_.region);
    double const value = norm_of(error.error, gate_.norm);
    if (!gate_.relative) return put(m, value, "the error is null");
    double const scale = norm_of(error.scale, gate_.norm);
    put(m, scale > 0.0 ? Number(value / scale) : Number(), "the exact field's norm is zero or null");
  }

  /// The entry that a gate names in a list of a series; null if there is none.
  template <class Entry>
  Entry const* find_entry(std::vector<Entry> const& entries, Measured& m) {
    std::string const field = field_of(gate_, m);
    std::set<std::string> fields;
    std::set<std::string> regions;
    for (Entry const& entry : entries) {
      fields.insert(entry.field);
      if (entry.field == field) regions.insert(entry.region);
    }
    if (!name("field", field, fields) || !name("region", gate_.region, regions)) return nullptr;
    for (Entry const& entry : entries) {
      if (entry.field != field || entry.region != gate_.region || entry.norm != gate_.norm) continue;
      if constexpr (std::is_same_v<Entry, TimeToError>) {
        if (entry.relative != gate_.target) continue;
      }
      return &entry;
    }
    return nullptr;
  }

  void measure_order(Measured& m) {
    OrderEntry const* const entry = find_entry(m.series->orders, m);
    if (entry == nullptr) {
      m.problem = fmt::format("no order of {} in '{}'", field_of(gate_, m), gate_.region);
      return;
    }
    m.word = entry->observed.verdict;
    put(m, entry->observed.order, fmt::format("no order: {}", entry->observed.reason));
    m.lower = entry->observed.lower;
    m.upper = entry->observed.upper;
  }

  /// The one that differs in the formulation alone; null if there is none. Throws UserError for several.
  template <class Subject, class Same>
  Subject const* find_reference(std::vector<Subject> const& all, FormulationChoice const& f,
                                Same const& same) const {
    std::vector<Subject const*> found;
    for (Subject const& other : all) {
      bool const walls = gate_.relative_to.walls || other.formulation.walls == f.walls;
      if (matches(gate_.relative_to, other.formulation) && walls && same(other)) found.push_back(&other);
    }
    if (found.size() > 1) {
      // Partners that are not named are those of the formulation itself.
      auto const others = std::remove_if(found.begin(), found.end(), [&](Subject const* other) {
        return other->formulation.work != f.work || other->formulation.conduction != f.conduction;
      });
      if (others != found.begin()) found.erase(others, found.end());
    }
    if (found.size() > 1 && file_ != nullptr) {
      std::vector<std::string> labels;
      for (Subject const* other : found) labels.push_back(other->label);
      throw UserError(*file_, gate_.key + ".relative_to", fmt::format("{}", fmt::join(labels, " and ")),
                      "work or conduction that tell them apart");
    }
    return found.empty() ? nullptr : found.front();
  }

  void name_reference() {
    std::set<std::string> ids;
    bool found = false;
    for (RunRecord const& run : results_.runs) {
      ids.insert(run.formulation.id);
      found = found || matches(gate_.relative_to, run.formulation);
    }
    // Partners or walls that no run has.
    if (!found) ids.erase(gate_.relative_to.id);
    name("relative_to", gate_.relative_to.id, ids);
  }

  static bool same_setting(Series const& a, Series const& b) {
    return a.case_id == b.case_id && a.parameters == b.parameters && a.discretisation == b.discretisation &&
           a.smoothing_exponent == b.smoothing_exponent;
  }
  static bool same_setting(RunRecord const& a, RunRecord const& b) {
    return a.case_id == b.case_id && a.parameters == b.parameters && a.discretisation == b.discretisation &&
           a.smoothing_exponent == b.smoothing_exponent && a.resolution == b.resolution;
  }

  /// The time of a series, which is at most that where its coarsest level was good enough already.
  void measure_time(Measured& m) {
    name_reference();
    Series const* const other =
        find_reference(results_.series, m.series->formulation,
                       [&](Series const& candidate) { return same_setting(candidate, *m.series); });
    if (other == nullptr) {
      m.problem = fmt::format("{} was not run on this", gate_.relative_to.id);
      return;
    }
    TimeToError const* const own = find_entry(m.series->time_to_error, m);
    std::set<std::string> targets;
    for (TimeToError const& t : m.series->time_to_error) targets.insert(fmt::format("{}", t.relative));
    if (!m.series->time_to_error.empty()) name("target", fmt::format("{}", gate_.target), targets);
    Measured reference;
    reference.series = other;
    TimeToError const* const its = find_entry(other->time_to_error, reference);
    auto const reached = [](TimeToError const* t) { return t != nullptr && t->seconds && *t->seconds > 0.0; };
    if (!reached(own) || !reached(its)) {
      m.problem = fmt::format("{} never reached {:g} of the exact norm",
                              reached(own) ? other->label : m.series->label, gate_.target);
      return;
    }
    std::optional<TimeRatio> const known = time_ratio(of_target(*own), of_target(*its));
    if (!known) {
      m.problem = fmt::format("the median run time of {} is zero", other->label);
      return;
    }
    TimeRatio const& ratio = *known;
    m.value = ratio.value;
    put_noise(m, ratio);
    if (!own->is_bound && !its->is_bound) return;
    double const infinity = std::numeric_limits<double>::infinity();
    m.lower = own->is_bound ? 0.0 : ratio.low.value_or(ratio.value);
    m.upper = its->is_bound ? infinity : ratio.high.value_or(ratio.value);
    if (!ratio.low) return;
    // Noise moves the closed end alone.
    if (own->is_bound) m.kindest_lower = 0.0;
    if (its->is_bound) m.kindest_upper = infinity;
  }

  static TimeToTarget of_target(TimeToError const& t) { return {t.seconds, t.median, t.is_bound}; }

  /// The interval of a ratio of times: a gate may take any number in it.
  static void put_noise(Measured& m, TimeRatio const& ratio) {
    m.lower = m.kindest_upper = ratio.low;
    m.upper = m.kindest_lower = ratio.high;
  }

  void measure_cost(Measured& m) {
    name_reference();
    if (!name("measure", "cost", m.run->cost ? std::set<std::string>{"cost"} : std::set<std::string>{})) {
      m.problem = "cost was not measured";
      return;
    }
    RunRecord const* const other =
        find_reference(results_.runs, m.run->formulation,
                       [&](RunRecord const& candidate) { return same_setting(candidate, *m.run); });
    if (other == nullptr || !other->cost || other->status != "ok") {
      m.problem = other == nullptr ? fmt::format("{} was not run on this", gate_.relative_to.id)
                  : other->cost    ? other->label + ": " + failure(*other)
                                   : other->label + ": cost was not measured";
      return;
    }
    auto const& quantity = find_quantity(cost_table(), gate_.quantity);
    Number const own = quantity.value(*m.run->cost);
    Number const its = quantity.value(*other->cost);
    put(m, own && its && *its > 0.0 ? Number(*own / *its) : Number(), gate_.quantity + " is null or zero");
    if (!m.value || (gate_.quantity != "seconds" && gate_.quantity != "median_seconds")) return;
    auto ratio =
        time_ratio({m.run->cost->seconds, m.run->cost->median}, {other->cost->seconds, other->cost->median});
    if (!ratio || !ratio->low) return;
    // The minimum has no interval of its own: it takes the median's, as far as that must be widened to hold
    // it.
    ratio->low = std::min(*ratio->low, *m.value);
    ratio->high = std::max(*ratio->high, *m.value);
    put_noise(m, *ratio);
  }

  void measure_stability(Measured& m) {
    if (!name("measure", "stability",
              m.run->stability ? std::set<std::string>{"stability"} : std::set<std::string>{})) {
      m.problem = m.run->status == "ok" ? "stability was not measured" : failure(*m.run);
      return;
    }
    std::string const& remark = m.run->stability->remark;
    put(m, find_quantity(stability_table(), gate_.quantity).value(*m.run->stability),
        gate_.quantity + " is null" + (remark.empty() ? "" : ": " + remark));
  }

  void measure_wall_flux(Measured& m) {
    std::set<std::string> walls;
    for (std::size_t k = 0; k < m.run->wall_flux.size(); ++k) walls.insert(fmt::format("{}", k));
    m.problem = "no flux of this wall";
    if (gate_.wall && !name("wall", fmt::format("{}", *gate_.wall), walls)) return;
    if (!name("measure", "wall_flux",
              walls.empty() ? std::set<std::string>{} : std::set<std::string>{"wall_flux"})) {
      return;
    }
    m.problem.clear();
    Number worst;
    for (std::size_t k = 0; k < m.run->wall_flux.size(); ++k) {
      if (gate_.wall && *gate_.wall != k) continue;
      WallFlux const& wall = m.run->wall_flux[k];
      double const error = std::abs(wall.error) / (gate_.relative ? wall.scale : 1.0);
      if (!std::isfinite(error)) return put(m, std::nullopt, fmt::format("wall {}: no error or no scale", k));
      worst = std::max(worst.value_or(0.0), error);
    }
    put(m, worst, "no flux");
  }

  static Number part_of(Budget const& b, std::string const& what) {
    if (what == "pair_drift") return b.pair_drift;
    if (what == "wall_budget_defect") return b.wall_budget_defect;
    return b.drift;
  }

  void measure_budget(Measured& m) {
    std::vector<Budget> budgets = m.run->momentum;
    std::set<std::string> known;
    if (!m.run->momentum.empty()) known.insert("momentum");
    for (auto const& [quantity, budget] : m.run->conservation) known.insert(quantity);
    m.problem = "no budget of " + gate_.quantity;
    if (!name("quantity", gate_.quantity, known)) return;
    m.problem.clear();
    if (gate_.quantity != "momentum") budgets = {m.run->conservation.at(gate_.quantity)};
    double scale = 0.0;
    for (Budget const& b : budgets)
      scale = std::max({scale, std::abs(b.initial), std::abs(b.final), std::abs(b.exchanged)});
    if (gate_.quantity == "momentum") {
      // Walls that push against each other exchange nothing in sum.
      for (WallBudget const& wall : m.run->wall_budgets) {
        for (double const impulse : wall.prescribed_impulse) scale = std::max(scale, std::abs(impulse));
      }
    }
    Number worst;
    for (Budget const& b : budgets) {
      Number const part = part_of(b, gate_.what);
      if (!part || !std::isfinite(*part)) return put(m, std::nullopt, gate_.what + " is null");
      worst = std::max(worst.value_or(0.0), std::abs(*part));
    }
    if (!gate_.relative) return put(m, worst, gate_.what + " is null");
    if (scale == 0.0 && worst == 0.0) return put(m, 0.0, "");
    put(m, scale > 0.0 ? Number(*worst / scale) : Number(), "nothing was there and nothing exchanged");
  }

  struct Named {
    std::string wanted;
    std::set<std::string> existing;
    bool found = false;
  };

  Gate const& gate_;
  Results const& results_;
  std::string const* file_;  ///< null: missing names are no one's error
  bool sound_ = false;       ///< whether a run or series could be measured at all
  std::map<std::string, Named> names_;
};

/// Those that are not the case's defaults.
std::string describe_parameters(std::string const& case_id,
                                std::map<std::string, ParameterValue> const& parameters) {
  std::map<std::string, ParameterValue> special = parameters;
  if (Case const* const found = find_case(case_id)) {
    for (ParameterSpec const& spec : found->info.parameters) {
      auto const own = special.find(spec.name);
      if (own != special.end() && own->second == spec.default_value) special.erase(own);
    }
  }
  return special.empty() ? case_id : case_id + " " + parameters_json(special).dump();
}

std::string describe_layout(LayoutChoice const& layout, bool with_seed) {
  std::string text = layout.id;
  if (layout.amplitude > 0.0) text += fmt::format(" {:g}", layout.amplitude);
  if (with_seed && (layout.id == "jittered" || layout.id == "glass"))
    text += fmt::format(" seed {}", layout.seed);
  return text;
}

}  // namespace

std::vector<std::string> const& stability_quantities() {
  static std::vector<std::string> const names = names_of(stability_table());
  return names;
}

std::vector<std::string> const& cost_quantities() {
  static std::vector<std::string> const names = names_of(cost_table());
  return names;
}

std::vector<Measured> measure(Gate const& gate, Results const& results, std::string const& file) {
  return Measurer(gate, results, &file)();
}

std::vector<Measured> measure_baseline(Gate const& gate, Results const& baseline) {
  return Measurer(gate, baseline, nullptr)();
}

std::string label_of(Gate const& gate) {
  std::string const relative = gate.relative ? "rel. " : "";
  switch (gate.measure) {
    case GateMeasure::order:
      return gate.limit.equals_word.empty() ? "order" : "ladder";
    case GateMeasure::error:
      return relative + gate.norm + " error";
    case GateMeasure::conservation:
      return relative + gate.quantity + " " + gate.what;
    case GateMeasure::wall_flux:
      return relative + "wall flux error";
    case GateMeasure::status:
      return "status";
    case GateMeasure::stability:
      return gate.quantity;
    case GateMeasure::time_to_error:
      return "time ratio";
    case GateMeasure::cost:
      return gate.quantity + " ratio";
  }
  return "";
}

std::string unit_of(Gate const& gate, std::string const& field) {
  if (gate.relative) return "";
  if (gate.measure == GateMeasure::error) {
    for (FieldInfo const& info : field_infos) {
      if (info.name == field) return std::string(info.unit);
    }
  }
  if (gate.measure == GateMeasure::stability) return find_quantity(stability_table(), gate.quantity).unit;
  if (gate.measure == GateMeasure::wall_flux) return "W/m^2";
  if (gate.measure == GateMeasure::conservation)
    return gate.quantity == "mass" ? "kg" : gate.quantity == "momentum" ? "kg m/s" : "J";
  return "";
}

std::string field_of(Gate const& gate, Measured const& measured) {
  if (!gate.field.empty()) return gate.field;
  for (char const* field : leading_fields) {
    if (measured.run != nullptr) {
      if (measured.run->errors.contains(field)) return field;
      continue;
    }
    for (OrderEntry const& entry : measured.series->orders) {
      if (entry.field == field) return field;
    }
  }
  return "";
}

bool same_subject(Measured const& a, Measured const& b) {
  auto const same = [](auto const& x, auto const& y) {
    return x.case_id == y.case_id && x.parameters == y.parameters && x.formulation == y.formulation &&
           x.discretisation == y.discretisation && x.smoothing_exponent == y.smoothing_exponent;
  };
  if (a.run != nullptr && b.run != nullptr)
    return same(*a.run, *b.run) && a.run->resolution == b.run->resolution;
  return a.run == nullptr && b.run == nullptr && same(*a.series, *b.series);
}

std::string describe(Measured const& measured) {
  auto const text = [](auto const& s, bool with_seed) {
    Discretisation const& d = s.discretisation;
    return fmt::format("{}, {}, {}, density {}, face weight {}, closure {}, h/dx {:g}, exponent {:g}",
                       describe_parameters(s.case_id, s.parameters), s.label,
                       describe_layout(d.layout, with_seed), d.density, d.face_weight, d.closure,
                       d.smoothing_ratio, s.smoothing_exponent);
  };
  if (measured.run == nullptr) return text(*measured.series, false);
  return text(*measured.run, true) + fmt::format(", N = {}", measured.run->resolution);
}

}  // namespace sphverify
