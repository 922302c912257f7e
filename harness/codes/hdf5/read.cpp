// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>

#include "formulations/plugins/crash_guard.hpp"
#include "harness/codes/hdf5.hpp"
#include "harness/codes/hdf5/file.hpp"
#include "reports/user_error.hpp"

namespace sphverify {

namespace {

using hdf5::DataSet;
using hdf5::InputFile;

constexpr std::size_t most_groups = 4096;

/// What a format calls the columns; several are alternatives, and a set of vectors stands for as many columns.
struct Name {
  std::vector<std::string> columns;
  std::vector<std::string> sets;
};

std::vector<std::string> const positions{"x", "y", "z"};
std::vector<std::string> const velocities{"vx", "vy", "vz"};

/// Those of SWIFT's and of Gadget's snapshots and initial conditions.
std::vector<Name> const names_of_part_types{{positions, {"Coordinates"}},
                                            {velocities, {"Velocities"}},
                                            {{"m"}, {"Masses"}},
                                            {{"rho"}, {"Densities", "Density"}},
                                            {{"h"}, {"SmoothingLengths", "SmoothingLength"}},
                                            {{"e"}, {"InternalEnergies", "InternalEnergy"}},
                                            {{"P"}, {"Pressures", "Pressure"}},
                                            {{"T"}, {"Temperatures", "Temperature"}}};
std::vector<Name> const names_of_pysph{{{"x"}, {"x"}},  {{"y"}, {"y"}},  {{"z"}, {"z"}},     {{"vx"}, {"u"}},
                                       {{"vy"}, {"v"}}, {{"vz"}, {"w"}}, {{"m"}, {"m"}},     {{"rho"}, {"rho"}},
                                       {{"h"}, {"h"}},  {{"P"}, {"p"}},  {{"e"}, {"e"}},     {{"T"}, {"T", "temperature"}},
                                       {{"K"}, {"K"}}};

std::vector<Name> names_of_ours() {
  std::vector<Name> names;
  for (SnapshotColumn const& one : snapshot_columns) names.push_back({{std::string(one.name)}, {std::string(one.name)}});
  return names;
}

/// Takes a column, or as many as a set has.
void put(Snapshot& snapshot, InputFile const& file, std::string const& place, std::vector<std::string> const& columns) {
  DataSet const set = file.read(place);
  if (set.rows == 0) return;  // a place held for what was not stored
  if (set.columns > columns.size())
    throw UserError(file.path(), place, fmt::format("{} numbers per particle", set.columns), fmt::format("{}", columns.size()));
  if (snapshot.size() > 0 && set.rows != snapshot.size())
    throw UserError(file.path(), place, fmt::format("{} particles", set.rows), fmt::format("{}, as before", snapshot.size()));
  for (std::size_t k = 0; k < set.columns; ++k) {
    std::vector<double> values(set.rows);
    for (std::size_t i = 0; i < set.rows; ++i) values[i] = set.values[i * set.columns + k];
    snapshot.columns[columns[k]] = std::move(values);
    if (set.rounding > 0.0) snapshot.rounding[columns[k]] = set.rounding;
  }
}

/// What a group of particles holds, under the names that the user or else the format gives.
void read_columns(Snapshot& snapshot, InputFile const& file, std::string const& group, std::vector<Name> const& names,
                  SnapshotOptions const& options) {
  std::vector<std::string> const inside = file.names(group, most_groups);
  std::string const within = group == "/" ? "" : group + "/";
  auto const holds = [&](std::string const& set) { return std::find(inside.begin(), inside.end(), set) != inside.end(); };
  for (auto const& [column, set] : options.names) {
    if (!holds(set)) throw UserError(file.path(), "map." + column, "no data set " + within + set, one_of(set, inside));
    std::vector<std::string> columns{column};
    if (column == "x") columns = positions;
    if (column == "vx") columns = velocities;
    put(snapshot, file, within + set, columns);
  }
  for (Name const& name : names) {
    if (snapshot.has(name.columns.front())) continue;
    for (std::string const& set : name.sets) {
      if (!holds(set)) continue;
      put(snapshot, file, within + set, name.columns);
      break;
    }
  }
}

Number first(std::optional<std::vector<double>> const& values) {
  return values ? Number(values->front()) : std::nullopt;
}

/// SWIFT, Gadget and GIZMO: particles by type, gas is type 0.
void read_part_types(Snapshot& snapshot, InputFile const& file, SnapshotOptions const& options) {
  snapshot.time = first(file.numbers("Header", "Time"));
  Number const scale_factor = first(file.numbers("Header", "Scale-factor"));
  Number const redshift = first(file.numbers("Header", "Redshift"));
  Number const comoving = first(file.numbers("Header", "ComovingIntegrationOn"));
  bool const expands = (scale_factor && std::abs(*scale_factor - 1.0) > 1e-6) || comoving.value_or(0.0) != 0.0 ||
                       (!scale_factor && std::abs(redshift.value_or(0.0)) > 1e-6);
  if (expands) {
    throw UserError(file.path(), "Header", scale_factor ? fmt::format("a scale factor of {:g}", *scale_factor) : "a comoving run",
                    "a run that does not expand");
  }
  read_columns(snapshot, file, "PartType0", names_of_part_types, options);
  if (!snapshot.has("m")) {
    auto const table = file.numbers("Header", "MassTable");
    if (table && table->front() > 0.0) {
      snapshot.columns["m"].assign(snapshot.size(), table->front());
      snapshot.remarks.push_back("masses from the header's table");
    }
  }
  std::vector<std::string> others;
  for (int type = 1; type < 7; ++type) {
    std::string const group = fmt::format("PartType{}", type);
    if (file.has(group)) others.push_back(group);
  }
  if (!others.empty()) snapshot.remarks.push_back(fmt::format("left out: {}", fmt::join(others, ", ")));
  if (snapshot.format == "swift") {
    snapshot.gamma = first(file.numbers("HydroScheme", "Adiabatic index"));
    snapshot.support_over_h = first(file.numbers("HydroScheme", "Kernel gamma"));
    if (snapshot.has("h") && !snapshot.support_over_h && options.smoothing_length == LengthConvention::as_format)
      throw UserError(file.path(), "HydroScheme", "no \"Kernel gamma\"", "it, or `smoothing_length` in the document");
  } else {
    snapshot.support_over_h = 1.0;
  }
}

/// Of the particle arrays the one that is meant.
std::string array_of(InputFile const& file, std::string const& asked) {
  auto const arrays = file.names("particles", most_groups);
  auto const is_there = [&](std::string const& name) { return std::find(arrays.begin(), arrays.end(), name) != arrays.end(); };
  if (!asked.empty()) {
    if (!is_there(asked)) throw UserError(file.path(), "array", "no array '" + asked + "'", one_of(asked, arrays));
    return asked;
  }
  if (arrays.size() == 1) return arrays.front();
  if (is_there("fluid")) return "fluid";
  throw UserError(file.path(), "particles", fmt::format("arrays {}", fmt::join(arrays, ", ")), "`array` to say which is meant");
}

void read_pysph(Snapshot& snapshot, InputFile const& file, SnapshotOptions const& options) {
  snapshot.time = first(file.numbers("solver_data", "t"));
  std::string const array = array_of(file, options.array);
  std::string const group = "particles/" + array + "/arrays";
  read_columns(snapshot, file, group, names_of_pysph, options);
  std::size_t const n = snapshot.size();
  if (file.names("particles", most_groups).size() > 1) snapshot.remarks.push_back(fmt::format("array {}", array));
  if (file.has(group + "/tag")) {
    DataSet const tags = file.read(group + "/tag");
    if (tags.columns != 1 || tags.rows != n)
      throw UserError(file.path(), group + "/tag", fmt::format("{} tags", tags.rows), fmt::format("{}, one per particle", n));
    std::vector<char> keep(n, 1);
    for (std::size_t i = 0; i < n; ++i) keep[i] = tags.values[i] == 0.0;
    std::size_t const ghosts = static_cast<std::size_t>(std::count(keep.begin(), keep.end(), 0));
    keep_only(snapshot, keep);
    if (ghosts > 0) snapshot.remarks.push_back(fmt::format("{} ghosts left out (tag not 0)", ghosts));
  }
}

std::string format_of(InputFile const& file) {
  if (file.text("/", "schema") == "sphverify-snapshot/1") return "hdf5";
  if (file.has("solver_data") && file.has("particles")) return "pysph";
  if (file.has("PartType0")) {
    bool const is_swift = file.has("HydroScheme") || file.text("Header", "Code").value_or("").starts_with("SWIFT");
    return is_swift ? "swift" : "gadget";
  }
  throw UserError(file.path(), "", "an HDF5 file of another kind",
                  "one with PartType0 (SWIFT, Gadget, GIZMO), particles (PySPH) or our own");
}

/// Particles that a code keeps in its lists though they are gone.
void drop_dead(Snapshot& snapshot) {
  if (!snapshot.has("h")) return;
  std::vector<char> keep;
  for (double const h : snapshot.columns.at("h")) keep.push_back(!(h <= 0.0));
  std::size_t const dead = static_cast<std::size_t>(std::count(keep.begin(), keep.end(), 0));
  if (dead == 0) return;
  keep_only(snapshot, keep);
  snapshot.remarks.push_back(fmt::format("{} dead particles left out (h not positive)", dead));
}

}  // namespace

bool can_read_hdf5() { return true; }

Snapshot read_hdf5_snapshot(std::string const& path, SnapshotOptions const& options) {
  std::scoped_lock const lock(hdf5::library());
  // Of some damaged files the library makes addresses.
  CrashGuard const guard("the HDF5 library", path.c_str());
  InputFile const file(path);
  Snapshot snapshot{.file = path, .format = options.format == "auto" ? format_of(file) : options.format};
  if (options.format == "auto") snapshot.remarks.push_back("taken for the format " + snapshot.format);
  if (snapshot.format == "pysph") {
    if (!file.has("particles") || !file.has("solver_data"))
      throw UserError(path, "format", "no groups particles and solver_data", "a file of PySPH");
    read_pysph(snapshot, file, options);
  } else if (snapshot.format == "hdf5") {
    snapshot.time = first(file.numbers("/", "time"));
    snapshot.gamma = first(file.numbers("/", "gamma"));
    read_columns(snapshot, file, "/", names_of_ours(), options);
  } else {
    if (!file.has("PartType0")) throw UserError(path, "format", "no group PartType0", "a file of " + snapshot.format);
    read_part_types(snapshot, file, options);
  }
  drop_dead(snapshot);
  return snapshot;
}

}  // namespace sphverify
