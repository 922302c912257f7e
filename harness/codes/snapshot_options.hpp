// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "reports/json/node.hpp"
#include "reports/results.hpp"

namespace sphverify {

/// What a code calls its smoothing length.
enum class LengthConvention {
  as_format,     ///< what the format is known for
  half_support,  ///< ours with the cubic spline: the kernel vanishes at 2h
  support,       ///< the radius at which the kernel vanishes (Gadget, GIZMO)
  two_sigma      ///< twice the kernel's standard deviation (SWIFT)
};

/// What is said of files where they do not say it themselves.
struct SnapshotOptions {
  std::string format = "auto";
  std::map<std::string, std::string> names;  ///< column -> what the file calls it
  LengthConvention smoothing_length = LengthConvention::as_format;
  Number gamma;
  double specific_heat = 1.0;            ///< internal energy over temperature, for files without the former [J/(kg K)]
  std::string array;                     ///< of PySPH's particle arrays; empty: the only one, else `fluid`
  std::vector<std::string> plane;        ///< which of the file's axes are ours, in our order; empty: the first ones
  std::vector<double> shift;             ///< added to the file's positions [m]; empty: as the format needs
  bool is_single = false;                ///< numbers came from single precision, whatever the file stores
  bool drops_outside = false;            ///< particles outside of fixed walls are left out, not refused
  bool sums_density = false;             ///< density by summation where the file has none
  Number density_from_h;                 ///< eta of rho = m (eta/h)^Dim where the file has no density, as Phantom's hfact
};

/// Formats that snapshots have, and those that initial particles are written in.
inline std::vector<std::string> const snapshot_formats{"auto", "csv", "hdf5", "swift", "gadget", "pysph"};
inline std::vector<std::string> const initial_formats{"csv", "hdf5", "swift", "pysph"};

/// Keys of a document that are options of its files.
inline std::vector<std::string> const snapshot_option_keys{"format", "map",       "smoothing_length", "gamma",  "specific_heat",
                                                           "array",  "plane",     "shift",            "precision",
                                                           "outside", "density"};

/// Reads these keys of an object. Throws UserError.
SnapshotOptions read_snapshot_options(Node const& object);

/// The options that are not defaults, as `read_snapshot_options` reads them.
Json to_json(SnapshotOptions const& options);

}  // namespace sphverify
