// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/hdf5/library.hpp"

// HDF5 files by the library of that name. Throw UserError, which names the file and the place in it.
namespace sphverify::hdf5 {

/// Numbers of a data set, row by row.
struct DataSet {
  std::vector<double> values;
  std::size_t rows = 0, columns = 1;
  double rounding = 0.0;  ///< relative, of numbers stored with less than double precision
};

class InputFile {
 public:
  explicit InputFile(std::string const& path);

  std::string const& path() const { return path_; }
  bool has(std::string const& place) const;

  /// Names of what a group holds; complains of more than that.
  std::vector<std::string> names(std::string const& group, std::size_t most) const;

  /// Numbers of an attribute, of a group or a data set; empty if there is none, or it is a text.
  std::optional<std::vector<double>> numbers(std::string const& place, std::string const& attribute) const;
  std::optional<std::string> text(std::string const& place, std::string const& attribute) const;

  /// Expects one or two dimensions of numbers.
  DataSet read(std::string const& place) const;

 private:
  void require_own_storage(hid_t set, std::string const& place) const;

  std::string path_;
  File file_;
};

class OutputFile {
 public:
  explicit OutputFile(std::string const& path);
  void group(std::string const& place);
  void write(std::string const& place, std::vector<double> const& values, std::size_t columns = 1);
  void write_ids(std::string const& place, std::size_t count);  ///< 1, 2, ...
  void attribute(std::string const& place, std::string const& name, std::vector<double> const& values);
  void attribute(std::string const& place, std::string const& name, std::vector<int> const& values);
  void attribute(std::string const& place, std::string const& name, std::string const& text);
  void close();

 private:
  std::string path_;
  File file_;
};

}  // namespace sphverify::hdf5
