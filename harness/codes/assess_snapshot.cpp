// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/codes/assess_snapshot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "formulations/density/density.hpp"
#include "formulations/neighbours/cell_grid.hpp"
#include "harness/codes/code_budgets.hpp"
#include "harness/codes/read_snapshot.hpp"
#include "harness/measure/norms.hpp"
#include "harness/measure/shock.hpp"
#include "harness/run/compared.hpp"
#include "harness/run/error_context.hpp"
#include "harness/run/exact_fields.hpp"
#include "harness/scene/initial_particles.hpp"
#include "harness/scene/place.hpp"
#include "reports/user_error.hpp"

namespace sphverify {

namespace {

constexpr double double_round_off = 64.0 * std::numeric_limits<double>::epsilon();
// Of the case's mass, what another layout may hold more or less: a part, and this part of a particle along an axis.
constexpr double mass_slack = 0.01;
constexpr double mass_slack_of_particle = 0.5;
constexpr double same_mass = 1e-5;
constexpr int resolution_of_mass = 48;   // of the lattice with which that mass is found

struct ScalarColumn {
  Field field;
  char const* column;
};

/// Those that a case compares, of which the code may have some.
std::vector<ScalarColumn> scalars_of(CaseKind kind) {
  std::vector<ScalarColumn> all;
  if (moves(kind)) all = {{Field::density, "rho"}, {Field::pressure, "P"}, {Field::internal_energy, "e"}};
  if (kind != CaseKind::hydro) all.push_back({Field::temperature, "T"});
  return all;
}

template <int Dim>
class Assessment {
 public:
  Assessment(AssessedCase const& one, Problem<Dim> const& problem, SnapshotOptions const& options, MeasureSet measure,
             RunRecord& record)
      : case_(one),
        problem_(problem),
        kernel_(kernel(one.discretisation.kernel, Dim)),
        options_(options),
        measure_(measure),
        record_(record),
        spacing_(spacing_of(problem.domain, one.discretisation.layout, one.resolution)) {}

  void assess(std::vector<Snapshot> history) {
    record_.spacing = spacing_;
    record_.smoothing_length = case_.smoothing_ratio * spacing_;
    for (Snapshot& one : history) {
      // What options say is of the code's files: particles that we gave it to start from need no translation.
      SnapshotOptions const& options = one.format.empty() ? ours_ : options_;
      fit_to_domain(one, options, problem_.domain, kernel_, problem_.gamma);
      drop_outside(one);
      if (options.sums_density && !one.has("rho")) sum_the_density(one);
      derive_missing<Dim>(one, options, problem_.gamma);
    }
    Snapshot const& last = history.back();
    record_.remarks.insert(record_.remarks.end(), last.remarks.begin(), last.remarks.end());
    record_.particles = last.size();
    name_fields(last);
    if (std::string const why = not_finite(last, {"x", "y", "z", "m", "h"}); !why.empty()) {
      mark_not_finite(record_, why);
      return;
    }
    require_sense(last);
    Particles<Dim> const particles = particles_of(last);
    measure(particles, last);
    if (measure_.contains(Measure::conservation) || measure_.contains(Measure::history))
      measure_code_budgets(problem_, case_.scene_case->info.kind, history, measure_.contains(Measure::history), record_);
  }

 private:
  /// What the snapshot holds, as documents call it.
  void name_fields(Snapshot const& s) {
    auto& names = record_.scene.fields;
    for (SnapshotColumn const& column : snapshot_columns) {
      if (s.has(std::string(column.name)) && std::find(names.begin(), names.end(), column.quantity) == names.end())
        names.emplace_back(column.quantity);
    }
  }

  static std::string not_finite(Snapshot const& s, std::vector<std::string> const& columns) {
    for (std::string const& name : columns) {
      auto const found = s.columns.find(name);
      if (found == s.columns.end()) continue;
      for (std::size_t i = 0; i < found->second.size(); ++i) {
        if (!std::isfinite(found->second[i])) return fmt::format("{} of particle {} is {}", name, i, found->second[i]);
      }
    }
    return "";
  }

  Vector<Dim> place(Snapshot const& s, std::size_t i) const {
    Vector<Dim> x;
    for (int k = 0; k < Dim; ++k) x[k] = s.columns.at(position_columns[static_cast<std::size_t>(k)])[i];
    return x;
  }

  /// A wall of a gas that prescribes a pressure and no path.
  bool goes_with_gas(Wall<Dim> const& wall) const {
    return moves(case_.scene_case->info.kind) && !wall.path && !wall.velocity;
  }

  /// How far a particle is outside of a wall whose place is known [m]: all but those that go with a gas.
  double outside(Snapshot const& s, std::size_t i) const {
    double most = 0.0;
    for (Wall<Dim> const& wall : problem_.walls) {
      if (goes_with_gas(wall)) continue;
      Wall<Dim> now = wall;
      if (wall.path) now.point = wall.path(s.time.value_or(problem_.final_time));
      most = std::max(most, -now.distance(place(s, i)));
    }
    return most;
  }

  void drop_outside(Snapshot& s) const {
    // A gas may lean against a wall a little beyond it, but not as far as the first particles that stand for the wall; what
    // stands still may not.
    double const allowed = moves(case_.scene_case->info.kind) ? 0.25 * spacing_ : 1e-6 * spacing_;
    std::vector<char> keep(s.size(), 1);
    std::size_t out = 0;
    for (std::size_t i = 0; i < s.size(); ++i) {
      double const by = outside(s, i);
      if (!(by > allowed)) continue;
      if (!options_.drops_outside) {
        throw UserError(s.file, "", fmt::format("particle {} {:.3g} m outside of a wall, at {}", i, by, text_of(place(s, i))),
                        "particles in the domain; \"outside\": \"drop\" leaves out those of walls");
      }
      keep[i] = 0;
      ++out;
    }
    if (out == 0) return;
    keep_only(s, keep);
    s.remarks.push_back(fmt::format("{} particles outside of the walls left out", out));
  }

  static std::string text_of(Vector<Dim> const& x) { return fmt::format("{:.6g}", fmt::join(x.begin(), x.end(), ":")); }

  static void require_positive(Snapshot const& s) {
    for (char const* name : {"m", "h", "rho"}) {
      if (!s.has(name)) continue;
      auto const& values = s.columns.at(name);
      auto const wrong = std::find_if(values.begin(), values.end(), [](double v) { return v <= 0.0; });
      if (wrong != values.end())
        throw UserError(s.file, name, fmt::format("{} of particle {}", *wrong, wrong - values.begin()), "a positive number");
    }
  }

  /// Refuses what cannot be this case's particles.
  void require_sense(Snapshot const& s) {
    if (s.size() == 0) throw UserError(s.file, "", "no particles in the domain", "those of the case");
    require_positive(s);
    Discretisation const lattice;
    InitialParticles<Dim> const start =
        initial_particles(problem_, lattice, Dim == 3 ? resolution_of_mass / 2 : resolution_of_mass, 1.0);
    double expected = 0.0;
    double found = 0.0;
    for (double const m : start.particles.masses()) expected += m;
    for (double const m : s.columns.at("m")) found += m;
    if (std::abs(found - expected) > same_mass * expected)
      record_.remarks.push_back(fmt::format("mass: {:.6g} of what the case begins with", found / expected));
    double const count = particle_count(problem_.domain, case_.discretisation.layout, case_.resolution);
    if (static_cast<double>(s.size()) != count) {
      record_.remarks.push_back(fmt::format("particles: {}, where a {} of N = {} has {:.0f}", s.size(),
                                            case_.discretisation.layout.id, case_.resolution, count));
    }
    if (count > 2.0 * static_cast<double>(s.size()) || static_cast<double>(s.size()) > 2.0 * count)
      throw UserError(s.file, "", fmt::format("{} particles", s.size()),
                      fmt::format("about {:.0f}, as a {} of resolution {} has", count, case_.discretisation.layout.id,
                                  case_.resolution));
    double const slack = mass_slack + mass_slack_of_particle / case_.resolution;
    if (std::abs(found - expected) <= slack * expected) return;
    throw UserError(s.file, "m", fmt::format("{} particles with a mass of {:.6g} together", s.size(), found),
                    fmt::format("about {:.6g}, as {} begins with{}", expected, case_.scene_case->info.id,
                                found < expected ? " (are some missing?)" : ""));
  }

  Particles<Dim> particles_of(Snapshot const& s) const {
    Particles<Dim> particles(s.size(), record_.smoothing_length);
    particles.set_kernel(kernel_);
    for (std::size_t i = 0; i < s.size(); ++i) particles.positions().set(i, place(s, i));
    particles.masses() = s.columns.at("m");
    if (s.has("h")) {
      particles.vary_smoothing_length();
      particles.smoothing_lengths() = s.columns.at("h");
    }
    particles.allocate(Field::density);
    particles.scalar(Field::density) = s.has("rho") ? s.columns.at("rho")
                                                    : sample(problem_.scalars.at(Field::density), particles, problem_.final_time);
    for (ScalarColumn const& one : scalars_of(case_.scene_case->info.kind)) {
      if (!s.has(one.column)) continue;
      particles.allocate(one.field);
      particles.scalar(one.field) = s.columns.at(one.column);
    }
    if (moves(case_.scene_case->info.kind) && s.has("vx")) {
      particles.allocate(Field::velocity);
      for (int k = 0; k < Dim; ++k)
        particles.vector(Field::velocity).component(k) = s.columns.at(velocity_columns[static_cast<std::size_t>(k)]);
    }
    return particles;
  }

  void sum_the_density(Snapshot& s) const {
    if (!not_finite(s, {"x", "y", "z", "m", "h"}).empty()) return;
    require_positive(s);
    Particles<Dim> const particles = particles_of(s);
    SmoothingLength const h(particles);
    CellGrid<Dim> const grid(particles.positions(), problem_.domain, kernel_.support_ratio() * h.largest());
    s.columns["rho"] = summation_density(grid, h, particles.masses());
    s.remarks.push_back(fmt::format("rho summed with the {} kernel", kernel_.id()));
  }

  void say_what_is_not_judged(Snapshot const& s) {
    std::string missing;
    auto const note = [&](std::string const& column) { missing += (missing.empty() ? "" : ", ") + column; };
    for (ScalarColumn const& one : scalars_of(case_.scene_case->info.kind)) {
      if (!s.has(one.column)) note(one.column);
    }
    if (moves(case_.scene_case->info.kind) && !s.has("vx")) note("vx");
    if (!missing.empty()) record_.remarks.push_back(fmt::format("not judged, for want of columns: {}", missing));
  }

  double rounding_of(Snapshot const& s, std::string const& column) const {
    auto const found = s.rounding.find(column);
    return std::max(double_round_off, found == s.rounding.end() ? 0.0 : found->second);
  }

  /// A wall that the gas takes along stands half of the outermost particle's width beyond it: where the code has it is not known.
  std::vector<Wall<Dim>> walls_now(Particles<Dim> const& particles) const {
    std::vector<Wall<Dim>> walls = problem_.walls;
    for (Wall<Dim>& wall : walls) {
      if (wall.path) {
        wall.point = wall.path(problem_.final_time);
      } else if (goes_with_gas(wall)) {
        std::size_t outermost = 0;
        for (std::size_t i = 1; i < particles.size(); ++i) {
          if (wall.distance(particles.positions()[i]) < wall.distance(particles.positions()[outermost])) outermost = i;
        }
        double const volume = particles.masses()[outermost] / particles.scalar(Field::density)[outermost];
        double const beyond = 0.5 * std::pow(volume, 1.0 / Dim) - wall.distance(particles.positions()[outermost]);
        wall.point += beyond * wall.outward_normal;
      }
    }
    return walls;
  }

  void measure(Particles<Dim> const& particles, Snapshot const& s) {
    double const t = problem_.final_time;
    auto const volumes = exact_volumes(problem_, particles, t);
    auto const counts = [&](std::size_t i) { return !problem_.holds || problem_.holds(particles.positions()[i], t); };
    auto const places = regions(particles, walls_now(particles), counts, final_features(problem_), smooth_margin(problem_.domain));
    std::map<Field, std::vector<double>> exact;
    std::vector<ComparedField> fields;
    std::map<std::string, double> round_off;
    for (ScalarColumn const& one : scalars_of(case_.scene_case->info.kind)) {
      if (!s.has(one.column) || !problem_.scalars.contains(one.field)) continue;
      exact[one.field] = sample(problem_.scalars.at(one.field), particles, t);
      fields.push_back({info(one.field).name, {particles.scalar(one.field)}, {exact[one.field]}});
      round_off[std::string(info(one.field).name)] = rounding_of(s, one.column) * largest_magnitude(exact[one.field]);
    }
    VectorField<Dim> velocity;
    if (particles.has(Field::velocity)) {
      velocity = sample(problem_.vectors.at(Field::velocity), particles, t);
      fields.push_back({"velocity", components(particles.vector(Field::velocity)), components(velocity)});
      double largest = 0.0;
      for (int k = 0; k < Dim; ++k) largest = larger(largest, largest_magnitude(velocity.component(k)));
      double rounding = 0.0;
      for (int k = 0; k < Dim; ++k) rounding = std::max(rounding, rounding_of(s, velocity_columns[static_cast<std::size_t>(k)]));
      round_off["velocity"] = rounding * largest;
    }
    if (fields.empty()) {
      std::string names;
      for (ScalarColumn const& one : scalars_of(case_.scene_case->info.kind)) names += std::string(" ") + one.column;
      if (moves(case_.scene_case->info.kind)) names += " vx";
      throw UserError(s.file, "", "no field that the case compares", "one or more of" + names);
    }
    say_what_is_not_judged(s);
    require_finite(record_, fields, volumes, places);
    if (measure_.contains(Measure::error)) {
      for (ComparedField const& field : fields) {
        std::string const name(field.name);
        record_.errors[name] = field_errors(field.computed, field.exact, volumes, places, round_off.at(name));
      }
      add_error_context(problem_, particles, volumes, places, record_.errors);
      if (problem_.shocks && particles.has(Field::velocity) && s.has("P") && s.has("rho")) {
        for (ShockFront const& front : problem_.shocks(t)) record_.shocks.push_back(measure_shock(particles, front));
      }
    }
    if (measure_.contains(Measure::profile)) record_.profile = make_profile(particles, fields, volumes, places);
  }

  AssessedCase const& case_;
  Problem<Dim> const& problem_;
  Kernel const& kernel_;
  SnapshotOptions const& options_;
  SnapshotOptions const ours_{};
  MeasureSet measure_;
  RunRecord& record_;
  double spacing_;
};

/// The case's problem, compared at the time of the snapshot that is judged. Its domain and walls stay those of the case.
AnyProblem at_time(AssessedCase const& one, Snapshot const& last) {
  double const end = std::visit([](auto const& p) { return p.final_time; }, one.problem);
  double const t = last.time.value_or(end);
  if (!(std::abs(t - end) <= time_slack * end)) {
    throw UserError(last.file, "time", fmt::format("{}", t),
                    fmt::format("{} within {}%, the case's final time (final_time among its parameters, where it has one)", end,
                                100.0 * time_slack));
  }
  AnyProblem problem = one.problem;
  std::visit([&](auto& p) { p.final_time = t; }, problem);
  return problem;
}

void assess_until(AssessedCase const& one, AnyProblem const& problem, std::vector<Snapshot> history,
                  SnapshotOptions const& options, MeasureSet measure, RunRecord& record) {
  std::visit(
      [&]<int Dim>(Problem<Dim> const& p) {
        double const end = std::get<Problem<Dim>>(one.problem).final_time;
        if (p.final_time != end)
          record.remarks.push_back(fmt::format("compared at its own time, {:.9g}, not at {:.9g}", p.final_time, end));
        if (!p.not_run_because.empty()) throw UserError("case: " + p.not_run_because);
        Assessment<Dim>(one, p, options, measure, record).assess(std::move(history));
      },
      problem);
}

}  // namespace

void assess_snapshots(AssessedCase const& one, std::vector<Snapshot> history, SnapshotOptions const& options,
                      MeasureSet measure, RunRecord& record) {
  AnyProblem const problem = at_time(one, history.back());
  std::string const file = history.back().file;
  if (!history.back().time) record.remarks.push_back("no time in the file: taken for the final time");
  try {
    assess_until(one, problem, std::move(history), options, measure, record);
  } catch (std::invalid_argument const& error) {
    throw UserError(file, "", error.what(), "particles at a time at which the case has a solution");
  }
}

}  // namespace sphverify
