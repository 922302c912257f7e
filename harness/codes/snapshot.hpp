// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "reports/results.hpp"

namespace sphverify {

/// A list that snapshots hold, one number per particle.
struct SnapshotColumn {
  std::string_view name;      ///< in files of ours (contract, "Other codes")
  std::string_view quantity;  ///< as documents call the field that it is of, or is a component of
  std::string_view unit;      ///< in SI; any coherent system of units serves
};

inline constexpr std::array<SnapshotColumn, 13> snapshot_columns{{{"x", "position", "m"},
                                                                  {"y", "position", "m"},
                                                                  {"z", "position", "m"},
                                                                  {"vx", "velocity", "m/s"},
                                                                  {"vy", "velocity", "m/s"},
                                                                  {"vz", "velocity", "m/s"},
                                                                  {"m", "mass", "kg"},
                                                                  {"rho", "density", "kg/m^Dim"},
                                                                  {"h", "smoothing_length", "m"},
                                                                  {"P", "pressure", "Pa"},
                                                                  {"e", "internal_energy", "J/kg"},
                                                                  {"T", "temperature", "K"},
                                                                  {"K", "conductivity", "W/(m K)"}}};

inline constexpr std::array<char const*, 3> position_columns{"x", "y", "z"};
inline constexpr std::array<char const*, 3> velocity_columns{"vx", "vy", "vz"};

/// Particles at one time as a file holds them: lists of equal length by the names above.
struct Snapshot {
  std::string file;    ///< for what is said of it
  std::string format;  ///< csv, hdf5, swift, gadget, pysph
  Number time{};       ///< if the file says it [s]
  Number gamma{};      ///< ratio of specific heats, likewise
  std::map<std::string, std::vector<double>> columns{};
  Number support_over_h{};  ///< the kernel's support in units of the column h; empty: that of the kernel which it is for
  std::map<std::string, double> rounding{};  ///< by column, how far off a number may be by how it is stored, relative to
                                             ///< it; double precision where there is none
  std::vector<std::string> remarks{};        ///< what was taken for what, and what was left out

  bool has(std::string const& column) const { return columns.contains(column); }
  std::size_t size() const { return columns.empty() ? 0 : columns.begin()->second.size(); }
};

/// Half of the distance between neighbouring numbers of single precision, relative to them.
inline constexpr double single_rounding = 0x1p-24;

/// Keeps the particles for which a list is not 0.
void keep_only(Snapshot& snapshot, std::vector<char> const& keep);

}  // namespace sphverify
