// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/codes/hdf5/file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <numeric>

#include "harness/codes/snapshot.hpp"
#include "harness/study/available_memory.hpp"
#include "reports/user_error.hpp"

namespace sphverify::hdf5 {

namespace {

bool is_number(hid_t type) {
  H5T_class_t const kind = H5Tget_class(type);
  return kind == H5T_INTEGER || kind == H5T_FLOAT;
}

}  // namespace

InputFile::InputFile(std::string const& path) : path_(path) {
  be_quiet();
  Properties const access(H5Pcreate(H5P_FILE_ACCESS));
  file_ = File(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access));
  if (!file_.is_open()) throw UserError(path, "", "an HDF5 file that cannot be opened (cut short?)", "a whole one");
}

bool InputFile::has(std::string const& place) const {
  for (std::size_t end = place.find('/'); ; end = place.find('/', end + 1)) {
    std::string const part = place.substr(0, end);
    if (!part.empty() && H5Lexists(file_, part.c_str(), H5P_DEFAULT) <= 0) return false;
    if (end == std::string::npos) break;
  }
  return H5Oexists_by_name(file_, place.c_str(), H5P_DEFAULT) > 0;
}

std::vector<std::string> InputFile::names(std::string const& place, std::size_t most) const {
  Group const group(H5Gopen2(file_, place.c_str(), H5P_DEFAULT));
  H5G_info_t info{};
  if (!group.is_open() || H5Gget_info(group, &info) < 0) throw UserError(path_, place, "no such group", "one");
  if (info.nlinks > most)
    throw UserError(path_, place, fmt::format("{} groups", info.nlinks), fmt::format("at most {}", most));
  std::vector<std::string> names;
  for (hsize_t k = 0; k < info.nlinks; ++k) {
    ssize_t const length = H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, k, nullptr, 0, H5P_DEFAULT);
    if (length < 0) continue;
    std::string name(static_cast<std::size_t>(length) + 1, '\0');
    H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, k, name.data(), name.size(), H5P_DEFAULT);
    name.pop_back();
    names.push_back(std::move(name));
  }
  return names;
}

namespace {

Attribute open_attribute(hid_t file, std::string const& place, std::string const& name) {
  if (H5Aexists_by_name(file, place.c_str(), name.c_str(), H5P_DEFAULT) <= 0) return Attribute();
  return Attribute(H5Aopen_by_name(file, place.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT));
}

}  // namespace

std::optional<std::vector<double>> InputFile::numbers(std::string const& place, std::string const& name) const {
  if (!has(place) && place != "/") return std::nullopt;
  Attribute const attribute = open_attribute(file_, place, name);
  if (!attribute.is_open()) return std::nullopt;
  Type const type(H5Aget_type(attribute));
  Space const space(H5Aget_space(attribute));
  hssize_t const count = H5Sget_simple_extent_npoints(space);
  if (!is_number(type) || count < 1 || count > 1024) return std::nullopt;
  std::vector<double> values(static_cast<std::size_t>(count));
  if (H5Aread(attribute, H5T_NATIVE_DOUBLE, values.data()) < 0) return std::nullopt;
  return values;
}

std::optional<std::string> InputFile::text(std::string const& place, std::string const& name) const {
  if (!has(place) && place != "/") return std::nullopt;
  Attribute const attribute = open_attribute(file_, place, name);
  if (!attribute.is_open()) return std::nullopt;
  Type const type(H5Aget_type(attribute));
  Space const space(H5Aget_space(attribute));
  if (H5Tget_class(type) != H5T_STRING || H5Sget_simple_extent_npoints(space) != 1) return std::nullopt;
  if (H5Tis_variable_str(type) > 0) {
    char* pointer = nullptr;
    Type const memory(H5Tcopy(H5T_C_S1));
    H5Tset_size(memory, H5T_VARIABLE);
    H5Tset_cset(memory, H5Tget_cset(type));
    if (H5Aread(attribute, memory, &pointer) < 0 || pointer == nullptr) return std::nullopt;
    std::string value(pointer);
    H5free_memory(pointer);
    return value;
  }
  std::string value(H5Tget_size(type), '\0');
  if (value.size() > 4096 || H5Aread(attribute, type, value.data()) < 0) return std::nullopt;
  return value.substr(0, value.find('\0'));
}

namespace {

constexpr double bytes_per_number = 24.0;     // as read, by column, and where it is used
constexpr double half_rounding = 0x1p-11;

bool is_virtual(hid_t file, char const* place) {
  Set const set(H5Dopen2(file, place, H5P_DEFAULT));
  if (!set.is_open()) return false;
  return H5Pget_layout(Properties(H5Dget_create_plist(set))) == H5D_VIRTUAL;
}

/// Where virtual data sets are parts of each other, or one of itself, the library never comes to an end.
bool has_virtual_part(hid_t file, hid_t properties, std::filesystem::path const& path) {
  std::size_t parts = 0;
  if (H5Pget_virtual_count(properties, &parts) < 0) return false;
  for (std::size_t k = 0; k < parts; ++k) {
    std::array<char, 4096> name{}, set{};
    H5Pget_virtual_filename(properties, k, name.data(), name.size());
    H5Pget_virtual_dsetname(properties, k, set.data(), set.size());
    bool const is_same_file = std::string_view(name.data()) == "." || path.filename() == name.data();
    Handle<H5Fclose> const other(is_same_file ? -1 : H5Fopen((path.parent_path() / name.data()).c_str(), H5F_ACC_RDONLY, H5P_DEFAULT));
    if (is_virtual(is_same_file ? file : static_cast<hid_t>(other), set.data())) return true;
  }
  return false;
}

}  // namespace

/// What it holds is in this file, or in parts of it beside, not in anything that a link or a list of raw files names.
void InputFile::require_own_storage(hid_t set, std::string const& place) const {
  Properties const properties(H5Dget_create_plist(set));
  bool const is_raw = H5Pget_external_count(properties) > 0;
  bool const is_nested = H5Pget_layout(properties) == H5D_VIRTUAL && has_virtual_part(file_, properties, path_);
  H5L_info_t link{};
  bool const is_elsewhere =
      H5Lget_info(file_, place.c_str(), &link, H5P_DEFAULT) >= 0 && link.type == H5L_TYPE_EXTERNAL;
  if (is_raw || is_elsewhere) throw UserError(path_, place, "numbers in another file", "numbers in this one");
  if (is_nested) throw UserError(path_, place, "a virtual data set of virtual ones", "one whose parts hold numbers");
}

DataSet InputFile::read(std::string const& place) const {
  Set const set(H5Dopen2(file_, place.c_str(), H5P_DEFAULT));
  if (!set.is_open()) throw UserError(path_, place, "no data set", "a list of numbers");
  Type const type(H5Dget_type(set));
  Space const space(H5Dget_space(set));
  int const rank = H5Sget_simple_extent_ndims(space);
  if (!is_number(type) || rank < 1 || rank > 2)
    throw UserError(path_, place, "something else", "a list of numbers, or of vectors");
  std::array<hsize_t, 2> extent{0, 1};
  H5Sget_simple_extent_dims(space, extent.data(), nullptr);
  require_own_storage(set, place);
  DataSet data;
  data.rows = extent[0];
  data.columns = extent[1];
  if (data.columns < 1 || data.columns > 16) throw UserError(path_, place, fmt::format("{} columns", data.columns), "1 to 16");
  double const bytes = bytes_per_number * static_cast<double>(data.rows) * static_cast<double>(data.columns);
  if (bytes > available_memory())
    throw UserError(path_, place, fmt::format("{} rows, which take about {:.3g} GB", data.rows, 1e-9 * bytes),
                    fmt::format("what fits into {:.3g} GB", 1e-9 * available_memory()));
  std::size_t const size = H5Tget_size(type);
  if (H5Tget_class(type) == H5T_FLOAT && size < sizeof(double)) data.rounding = size < sizeof(float) ? half_rounding : single_rounding;
  data.values.resize(data.rows * data.columns);
  if (data.rows > 0 && H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, data.values.data()) < 0)
    throw UserError(path_, place, "numbers that cannot be read (cut short?)", "a whole file");
  return data;
}

OutputFile::OutputFile(std::string const& path) : path_(path) {
  be_quiet();
  file_ = File(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  if (!file_.is_open()) throw UserError(path, "", "a place that cannot be written", "a file that can");
}

void OutputFile::group(std::string const& place) {
  Group const made(H5Gcreate2(file_, place.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
}

namespace {

/// Equal particles are equal files: the library would write the time beside each data set.
Properties without_time() {
  Properties made(H5Pcreate(H5P_DATASET_CREATE));
  H5Pset_obj_track_times(made, false);
  return made;
}

}  // namespace

void OutputFile::write(std::string const& place, std::vector<double> const& values, std::size_t columns) {
  std::array<hsize_t, 2> const extent{values.size() / columns, columns};
  Space const space(H5Screate_simple(columns == 1 ? 1 : 2, extent.data(), nullptr));
  Set const set(H5Dcreate2(file_, place.c_str(), H5T_IEEE_F64LE, space, H5P_DEFAULT, without_time(), H5P_DEFAULT));
  if (!set.is_open() || H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    throw UserError(path_, place, "a file that cannot be written", "room for it");
}

void OutputFile::write_ids(std::string const& place, std::size_t count) {
  std::vector<unsigned long long> ids(count);
  std::iota(ids.begin(), ids.end(), 1ULL);
  hsize_t const extent = count;
  Space const space(H5Screate_simple(1, &extent, nullptr));
  Set const set(H5Dcreate2(file_, place.c_str(), H5T_STD_U64LE, space, H5P_DEFAULT, without_time(), H5P_DEFAULT));
  if (!set.is_open() || H5Dwrite(set, H5T_NATIVE_ULLONG, H5S_ALL, H5S_ALL, H5P_DEFAULT, ids.data()) < 0)
    throw UserError(path_, place, "a file that cannot be written", "room for it");
}

namespace {

void put_attribute(hid_t file, std::string const& place, std::string const& name, hid_t stored, hid_t given, hid_t space,
                   void const* values) {
  Object const object(H5Oopen(file, place.c_str(), H5P_DEFAULT));
  Attribute const attribute(H5Acreate2(object, name.c_str(), stored, space, H5P_DEFAULT, H5P_DEFAULT));
  H5Awrite(attribute, given, values);
}

/// One number is a scalar.
Space space_of(std::size_t count) {
  hsize_t const extent = count;
  return Space(count == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &extent, nullptr));
}

}  // namespace

void OutputFile::attribute(std::string const& place, std::string const& name, std::vector<double> const& values) {
  put_attribute(file_, place, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, space_of(values.size()), values.data());
}

void OutputFile::attribute(std::string const& place, std::string const& name, std::vector<int> const& values) {
  put_attribute(file_, place, name, H5T_STD_I32LE, H5T_NATIVE_INT, space_of(values.size()), values.data());
}

void OutputFile::attribute(std::string const& place, std::string const& name, std::string const& text) {
  Type const type(H5Tcopy(H5T_C_S1));
  H5Tset_size(type, std::max<std::size_t>(1, text.size()));
  put_attribute(file_, place, name, type, type, space_of(1), text.c_str());
}

void OutputFile::close() {
  bool const is_whole = H5Fflush(file_, H5F_SCOPE_GLOBAL) >= 0;
  file_ = File();
  if (!is_whole) throw UserError(path_, "", "a file that cannot be written", "room for it");
}

}  // namespace sphverify::hdf5
