// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <mutex>

#include "harness/codes/hdf5.hpp"
#include "harness/codes/hdf5/file.hpp"

namespace sphverify {

namespace {

using hdf5::OutputFile;

/// Vectors, particle by particle; components that there are not are 0.
std::vector<double> joined(Snapshot const& s, std::array<char const*, 3> const& names) {
  std::vector<double> values(3 * s.size(), 0.0);
  for (std::size_t k = 0; k < 3; ++k) {
    auto const found = s.columns.find(names[k]);
    if (found == s.columns.end()) continue;
    for (std::size_t i = 0; i < s.size(); ++i) values[3 * i + k] = found->second[i];
  }
  return values;
}

void write_ours(OutputFile& file, Snapshot const& s, int dimension) {
  file.attribute("/", "schema", std::string("sphverify-snapshot/1"));
  file.attribute("/", "dimension", std::vector<int>{dimension});
  if (s.time) file.attribute("/", "time", std::vector<double>{*s.time});
  if (s.gamma) file.attribute("/", "gamma", std::vector<double>{*s.gamma});
  for (auto const& [name, values] : s.columns) file.write("/" + name, values);
}

/// SWIFT's initial conditions, whose names are those of Gadget's.
void write_swift(OutputFile& file, Snapshot const& s, Hdf5Choice const& choice) {
  auto const n = static_cast<int>(s.size());
  std::vector<double> box(3, choice.box.front());
  for (std::size_t k = 0; k < choice.box.size(); ++k) box[k] = choice.box[k];
  file.group("/Header");
  file.attribute("/Header", "BoxSize", box);
  file.attribute("/Header", "Dimension", std::vector<int>{choice.dimension});
  for (char const* name : {"NumPart_ThisFile", "NumPart_Total"})
    file.attribute("/Header", name, std::vector<int>{n, 0, 0, 0, 0, 0});
  file.attribute("/Header", "NumPart_Total_HighWord", std::vector<int>(6, 0));
  file.attribute("/Header", "MassTable", std::vector<double>(6, 0.0));
  file.attribute("/Header", "NumFilesPerSnapshot", std::vector<int>{1});
  file.attribute("/Header", "Flag_Entropy_ICs", std::vector<int>{0});
  file.attribute("/Header", "Time", std::vector<double>{s.time.value_or(0.0)});
  file.group("/Units");
  for (char const* name : {"Unit mass in cgs (U_M)", "Unit length in cgs (U_L)", "Unit time in cgs (U_t)",
                           "Unit current in cgs (U_I)", "Unit temperature in cgs (U_T)"})
    file.attribute("/Units", name, std::vector<double>{1.0});
  file.group("/PartType0");
  file.write("/PartType0/Coordinates", joined(s, position_columns), 3);
  file.write("/PartType0/Velocities", joined(s, velocity_columns), 3);
  file.write("/PartType0/Masses", s.columns.at("m"));
  std::vector<double> h = s.columns.at("h");
  for (double& one : h) one *= choice.support_over_h / choice.support_over_two_sigma;
  file.write("/PartType0/SmoothingLength", h);
  for (auto const& [column, name] : {std::pair{"e", "InternalEnergy"}, {"rho", "Density"}}) {
    if (s.has(column)) file.write(std::string("/PartType0/") + name, s.columns.at(column));
  }
  file.write_ids("/PartType0/ParticleIDs", s.size());
}

void write_pysph(OutputFile& file, Snapshot const& s) {
  file.group("/solver_data");
  file.attribute("/solver_data", "t", std::vector<double>{s.time.value_or(0.0)});
  file.attribute("/solver_data", "dt", std::vector<double>{0.0});
  file.attribute("/solver_data", "count", std::vector<int>{0});
  for (char const* place : {"/particles", "/particles/fluid", "/particles/fluid/arrays", "/particles/fluid/constants"})
    file.group(place);
  auto const put = [&](std::string const& name, std::vector<double> const& values) {
    std::string const place = "/particles/fluid/arrays/" + name;
    file.write(place, values);
    file.attribute(place, "name", name);
    file.attribute(place, "type", std::string("double"));
    file.attribute(place, "default", std::vector<double>{0.0});
    file.attribute(place, "stride", std::vector<int>{1});
    file.attribute(place, "stored", std::vector<int>{1});
  };
  // Its particles are always in three dimensions.
  std::vector<double> const zeros(s.size(), 0.0);
  for (auto const& [column, name] : {std::pair{"x", "x"}, {"y", "y"}, {"z", "z"}, {"vx", "u"}, {"vy", "v"}, {"vz", "w"}})
    put(name, s.has(column) ? s.columns.at(column) : zeros);
  for (auto const& [column, name] :
       {std::pair{"m", "m"}, {"h", "h"}, {"rho", "rho"}, {"P", "p"}, {"e", "e"}, {"T", "T"}, {"K", "K"}}) {
    if (s.has(column)) put(name, s.columns.at(column));
  }
}

}  // namespace

void write_hdf5_snapshot(std::string const& path, Snapshot const& snapshot, Hdf5Choice const& choice) {
  std::scoped_lock const lock(hdf5::library());
  OutputFile file(path);
  if (choice.format == "swift") {
    write_swift(file, snapshot, choice);
  } else if (choice.format == "pysph") {
    write_pysph(file, snapshot);
  } else {
    write_ours(file, snapshot, choice.dimension);
  }
  file.close();
}

}  // namespace sphverify
