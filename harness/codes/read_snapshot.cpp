// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/codes/read_snapshot.hpp"

#include <fmt/format.h>

#include <boost/math/quadrature/gauss.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "harness/codes/csv.hpp"
#include "harness/codes/hdf5.hpp"
#include "reports/user_error.hpp"

namespace sphverify {

namespace {

/// What a file begins with.
std::string first_bytes(std::string const& path) {
  std::ifstream file(path, std::ios::binary);
  std::string bytes(16, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
  return bytes;
}

/// HDF5's mark may stand behind a block of the user's own.
bool is_hdf5(std::string const& path) {
  constexpr std::string_view mark = "\x89HDF\r\n\x1a\n";
  std::ifstream file(path, std::ios::binary);
  std::string bytes(mark.size(), '\0');
  for (std::streamoff at = 0; at <= (1 << 20); at = at == 0 ? 512 : 2 * at) {
    file.seekg(at);
    if (!file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()))) return false;
    if (bytes == mark) return true;
  }
  return false;
}

Snapshot read_file(std::string const& path, SnapshotOptions const& options) {
  // Pipes and devices may never end.
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    bool const is_there = std::filesystem::exists(std::filesystem::symlink_status(path, error));
    throw UserError(path, "", is_there ? "something that is no file" : "no such file", "a snapshot");
  }
  if (is_hdf5(path)) {
    if (options.format == "csv") throw UserError(path, "format", "an HDF5 file", "csv");
    return read_hdf5_snapshot(path, options);
  }
  std::string const bytes = first_bytes(path);
  if (bytes.starts_with("PK\x03\x04"))
    throw UserError(path, "", "a NumPy archive (.npz)", "CSV or HDF5: PySPH writes the latter too");
  bool const is_text = bytes.find('\0') == std::string::npos;
  if (!is_text) throw UserError(path, "", "a binary file that is not HDF5", "CSV or HDF5");
  if (options.format != "auto" && options.format != "csv") throw UserError(path, "format", "text", options.format);
  return read_csv_snapshot(path, options.names);
}

/// Adds the particles of another part of the same snapshot.
void append(Snapshot& whole, Snapshot const& part) {
  if (part.size() == 0) return;
  if (whole.size() == 0) {
    whole = part;
    return;
  }
  for (auto const& [name, rounding] : part.rounding) whole.rounding[name] = std::max(whole.rounding[name], rounding);
  for (auto const& [name, values] : whole.columns) {
    if (!part.has(name)) throw UserError(part.file, name, "nothing", "what " + whole.file + " has, of which it is a part");
  }
  if (whole.time && part.time && *whole.time != *part.time)
    throw UserError(part.file, "time", fmt::format("{}", *part.time), fmt::format("{}, as in {}", *whole.time, whole.file));
  for (auto& [name, values] : whole.columns) {
    auto const& more = part.columns.at(name);
    values.insert(values.end(), more.begin(), more.end());
  }
}

}  // namespace

Snapshot read_snapshot(std::vector<std::string> const& files, SnapshotOptions const& options) {
  Snapshot whole = read_file(files.front(), options);
  for (std::size_t k = 1; k < files.size(); ++k) append(whole, read_file(files[k], options));
  if (whole.size() == 0) throw UserError(files.front(), "", "no particles", "some");
  if (files.size() > 1) whole.remarks.push_back(fmt::format("{} files of one snapshot", files.size()));
  if (options.gamma) whole.gamma = options.gamma;
  if (options.is_single) {
    // Computed with it, not only stored: sums of many terms have lost some more.
    for (auto const& [name, values] : whole.columns) whole.rounding[name] = 64.0 * single_rounding;
  }
  return whole;
}

namespace {

/// The file's axes that are meant become ours.
void take_plane(Snapshot& snapshot, std::vector<std::string> const& plane) {
  if (plane.empty()) return;
  std::map<std::string, std::vector<double>> taken;
  std::map<std::string, double> rounding;
  for (std::size_t k = 0; k < plane.size(); ++k) {
    for (std::string const prefix : {"", "v"}) {
      std::string const from = prefix + plane[k];
      std::string const to = prefix + position_columns[k];
      if (!snapshot.has(from)) continue;
      taken[to] = std::move(snapshot.columns.at(from));
      if (snapshot.rounding.contains(from)) rounding[to] = snapshot.rounding.at(from);
    }
  }
  for (std::size_t k = 0; k < 3; ++k) {
    for (char const* name : {position_columns[k], velocity_columns[k]}) {
      snapshot.columns.erase(name);
      snapshot.rounding.erase(name);
    }
  }
  snapshot.columns.merge(taken);
  snapshot.rounding.merge(rounding);
}

template <int Dim>
void require_positions(Snapshot& snapshot) {
  for (std::size_t k = 0; k < 3; ++k) {
    char const* const name = position_columns[k];
    if (k < Dim && !snapshot.has(name))
      throw UserError(snapshot.file, name, "nothing", fmt::format("positions in {} dimensions, as the case has", Dim));
    if (k < Dim) continue;
    snapshot.columns.erase(name);
    snapshot.columns.erase(velocity_columns[k]);
  }
  bool const has_any = std::any_of(velocity_columns.begin(), velocity_columns.end(),
                                   [&](char const* name) { return snapshot.has(name); });
  for (std::size_t k = 0; k < Dim && has_any; ++k) {
    if (!snapshot.has(velocity_columns[k]))
      throw UserError(snapshot.file, velocity_columns[k], "nothing", "as many components as dimensions");
  }
}

template <int Dim>
void place_in(Snapshot& snapshot, SnapshotOptions const& options, Domain<Dim> const& domain) {
  Vector<Dim> shift = Vector<Dim>::Zero();
  if (!options.shift.empty()) {
    if (options.shift.size() != Dim)
      throw UserError(snapshot.file, "shift", fmt::format("{} numbers", options.shift.size()), fmt::format("{}", Dim));
    shift = Eigen::Map<Vector<Dim> const>(options.shift.data());
  } else if (snapshot.format == "swift") {
    shift = domain.lower;  // its boxes begin at 0
  }
  std::size_t wrapped = 0;
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    Vector<Dim> x;
    for (int k = 0; k < Dim; ++k) x[k] = snapshot.columns.at(position_columns[k])[i] + shift[k];
    Vector<Dim> along = domain.to_box(x);
    bool has_moved = false;
    for (int k = 0; k < Dim; ++k) {
      if (!domain.periodic[k] || !std::isfinite(along[k])) continue;
      double const period = domain.upper[k] - domain.lower[k];
      double const periods = std::floor((along[k] - domain.lower[k]) / period);
      along[k] -= periods * period;
      has_moved = has_moved || periods != 0.0;
    }
    if (has_moved) x = domain.to_space(along);
    wrapped += has_moved ? 1 : 0;
    for (int k = 0; k < Dim; ++k) snapshot.columns.at(position_columns[k])[i] = x[k];
  }
  if (!shift.isZero()) {
    snapshot.remarks.push_back(fmt::format("positions moved by {}", fmt::join(shift.begin(), shift.end(), ", ")));
  }
  if (wrapped > 0) snapshot.remarks.push_back(fmt::format("{} particles wrapped into the period", wrapped));
}

/// A column that follows from others, particle by particle.
template <class Value>
void derive(Snapshot& snapshot, char const* column, std::vector<std::string> const& from, char const* how, Value const& value) {
  if (snapshot.has(column)) return;
  double rounding = 0.0;
  for (std::string const& one : from) {
    if (!snapshot.has(one)) return;
    if (auto const known = snapshot.rounding.find(one); known != snapshot.rounding.end()) rounding += known->second;
  }
  std::vector<double> values(snapshot.size());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = value(i);
  snapshot.columns[column] = std::move(values);
  if (rounding > 0.0) snapshot.rounding[column] = rounding;
  snapshot.remarks.push_back(fmt::format("{} {}", column, how));
}

}  // namespace

template <int Dim>
void derive_missing(Snapshot& snapshot, SnapshotOptions const& options, double gamma) {
  auto const at = [&](char const* column, std::size_t i) { return snapshot.columns.at(column)[i]; };
  if (options.density_from_h && !snapshot.has("rho")) {
    derive(snapshot, "rho", {"m", "h"}, "from m and h",
           [&](std::size_t i) { return at("m", i) * std::pow(*options.density_from_h / at("h", i), Dim); });
    if (auto const known = snapshot.rounding.find("h"); known != snapshot.rounding.end() && snapshot.has("rho"))
      snapshot.rounding["rho"] += (Dim - 1) * known->second;
  }
  if (gamma <= 0.0) return;
  double const used = snapshot.gamma.value_or(gamma);
  derive(snapshot, "e", {"P", "rho"}, "from P and rho by gamma",
         [&](std::size_t i) { return at("P", i) / ((used - 1.0) * at("rho", i)); });
  derive(snapshot, "e", {"T"}, "from T by the specific heat",
         [&](std::size_t i) { return options.specific_heat * at("T", i); });
  derive(snapshot, "P", {"e", "rho"}, "from e and rho by gamma",
         [&](std::size_t i) { return (used - 1.0) * at("rho", i) * at("e", i); });
}

void convert_lengths(Snapshot& snapshot, LengthConvention convention, Kernel const& kernel) {
  if (!snapshot.has("h")) return;
  Number ratio = snapshot.support_over_h;
  if (convention == LengthConvention::half_support) ratio = 2.0;
  if (convention == LengthConvention::support) ratio = 1.0;
  if (convention == LengthConvention::two_sigma) ratio = support_over_two_sigma(kernel);
  if (!ratio || *ratio == kernel.support_ratio()) return;
  double const factor = *ratio / kernel.support_ratio();
  for (double& h : snapshot.columns.at("h")) h *= factor;
  snapshot.remarks.push_back(fmt::format("h times {:.6g}: its kernel's support is {:.6g} of it", factor, *ratio));
}

double support_over_two_sigma(Kernel const& kernel) {
  // int r^2 W dV = Dim sigma^2, by Gauss's rule on each of the shape's pieces.
  int const dimension = kernel.dimension();
  std::vector<double> ends{0.0};
  ends.insert(ends.end(), kernel.knots().begin(), kernel.knots().end());
  ends.push_back(kernel.support_ratio());
  double volume = 0.0;
  double second = 0.0;
  using Rule = boost::math::quadrature::gauss<double, 20>;
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    auto const shell = [&](double q) { return kernel.shape(q) * std::pow(q, dimension - 1); };
    volume += Rule::integrate(shell, ends[k], ends[k + 1]);
    second += Rule::integrate([&](double q) { return q * q * shell(q); }, ends[k], ends[k + 1]);
  }
  return 0.5 * kernel.support_ratio() / std::sqrt(second / (volume * dimension));
}

template <int Dim>
void fit_to_domain(Snapshot& snapshot, SnapshotOptions const& options, Domain<Dim> const& domain, Kernel const& kernel,
                   double gamma) {
  take_plane(snapshot, options.plane);
  require_positions<Dim>(snapshot);
  if (!snapshot.has("m"))
    throw UserError(snapshot.file, "m", "nothing", "a mass for every particle: errors are weighted with volumes");
  if (gamma > 0.0 && snapshot.gamma && std::abs(*snapshot.gamma - gamma) > 1e-5 * gamma)
    throw UserError(snapshot.file, "gamma", fmt::format("{}", *snapshot.gamma), fmt::format("{}, as the case has", gamma));
  place_in(snapshot, options, domain);
  convert_lengths(snapshot, options.smoothing_length, kernel);
}

template void derive_missing<1>(Snapshot&, SnapshotOptions const&, double);
template void fit_to_domain(Snapshot&, SnapshotOptions const&, Domain<1> const&, Kernel const&, double);
template void derive_missing<2>(Snapshot&, SnapshotOptions const&, double);
template void fit_to_domain(Snapshot&, SnapshotOptions const&, Domain<2> const&, Kernel const&, double);
template void derive_missing<3>(Snapshot&, SnapshotOptions const&, double);
template void fit_to_domain(Snapshot&, SnapshotOptions const&, Domain<3> const&, Kernel const&, double);

}  // namespace sphverify
