// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "reports/hdf5.hpp"
#include "reports/hdf5/library.hpp"
#include "reports/hdf5/names.hpp"
#include "reports/json/syntax.hpp"

namespace sphverify {

namespace hdf5 {

namespace {

constexpr double most_deflated = 1100.0;     // times; zlib's limit is 1032
constexpr std::size_t text_bytes = std::size_t{1} << 20;  // read at a time
constexpr std::size_t most_objects = 1'000'000;

char const* const our_numbers = "whole or real numbers, yes or no, or texts of one length";

class Reader {
 public:
  Reader(std::string path, std::size_t file_bytes) : path_(std::move(path)), most_rows_(most_deflated * static_cast<double>(file_bytes)) {}

  /// The object whose keys a group has.
  void read_members(hid_t group, std::string const& place, Column& column, int depth) {
    if (depth > deepest) complain(place, "groups inside each other without end", fmt::format("at most {}", deepest));
    for (std::string const& name : names(group, place)) {
      if (name.find('@') != std::string::npos) continue;
      std::string const inner = place.empty() ? name : place + "/" + name;
      column.members.emplace(key_of_name(name), read(group, inner, name, column.rows(), &column.gaps, 0, depth + 1));
    }
  }

 private:
  [[noreturn]] void complain(std::string const& place, std::string const& found, std::string const& expected) const {
    throw UserError(path_, place, found, expected);
  }

  std::vector<std::string> names(hid_t group, std::string const& place) {
    H5G_info_t info{};
    if (H5Gget_info(group, &info) < 0) complain(place, "a group that cannot be read (cut short?)", "a whole file");
    objects_ += info.nlinks;
    if (objects_ > most_objects) complain(place, fmt::format("more than {} names", most_objects), "fewer");
    std::vector<std::string> all;
    for (hsize_t k = 0; k < info.nlinks; ++k) {
      ssize_t const length = H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, k, nullptr, 0, H5P_DEFAULT);
      if (length < 0) complain(place, "a name that cannot be read (cut short?)", "a whole file");
      std::string name(static_cast<std::size_t>(length) + 1, '\0');
      H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, k, name.data(), name.size(), H5P_DEFAULT);
      name.pop_back();
      all.push_back(std::move(name));
    }
    return all;
  }

  static bool has(hid_t group, std::string const& name) { return H5Lexists(group, name.c_str(), H5P_DEFAULT) > 0; }

  /// @param place of what the name is of, for complaints
  /// @param around which rows the object has whose key this is; none: all
  Column read(hid_t group, std::string const& place, std::string const& name, std::size_t rows,
              std::vector<std::uint8_t> const* around, int lists, int depth) {
    if (depth > deepest) complain(place, "lists inside each other without end", fmt::format("at most {}", deepest));
    if (static_cast<double>(rows) > most_rows_) complain(place, fmt::format("{} rows", rows), "what a file of this size can hold");
    Column column;
    column.gaps = gaps(group, place, name, rows, around, lists);
    if (has(group, starts_of(name, lists))) {
      read_list(column, group, place, name, lists, depth);
      return column;
    }
    H5L_info_t link{};
    if (H5Lget_info(group, name.c_str(), &link, H5P_DEFAULT) < 0 || link.type != H5L_TYPE_HARD)
      complain(place, "a link to somewhere else", "numbers, texts or a group");
    Object const object(H5Oopen(group, name.c_str(), H5P_DEFAULT));
    H5I_type_t const kind = object.is_open() ? H5Iget_type(object) : H5I_BADID;
    if (kind == H5I_GROUP) {
      column.kind = Column::Kind::object;
      read_members(object, place, column, depth);
    } else if (kind == H5I_DATASET) {
      read_set(column, object, place, lists > 0);
    } else {
      complain(place, "what is neither (cut short?)", "a data set or a group");
    }
    return column;
  }

  std::vector<std::uint8_t> gaps(hid_t group, std::string const& place, std::string const& name, std::size_t rows,
                                 std::vector<std::uint8_t> const* around, int lists) {
    if (!has(group, missing_of(name, lists))) {
      if (around == nullptr) return std::vector<std::uint8_t>(rows, Column::there);
      std::vector<std::uint8_t> all = *around;
      for (std::uint8_t& gap : all) gap = gap == Column::there ? Column::there : Column::absent;
      return all;
    }
    std::vector<std::uint8_t> found(rows);
    std::string const its_place = missing_of(place, lists);
    Set const set = open_set(group, missing_of(name, lists), its_place);
    require_shape(set, its_place, {rows}, true);
    read_into(set, its_place, H5T_NATIVE_UINT8, found.data());
    for (std::uint8_t const gap : found) {
      if (gap > Column::absent) complain(its_place, std::to_string(gap), "0 (there), 1 (null) or 2 (no such key)");
    }
    return found;
  }

  void read_list(Column& column, hid_t group, std::string const& place, std::string const& name, int lists, int depth) {
    std::string const its_place = starts_of(place, lists);
    Set const set = open_set(group, starts_of(name, lists), its_place);
    require_shape(set, its_place, {column.rows() + 1}, true);
    std::vector<std::int64_t> starts(column.rows() + 1);
    read_into(set, its_place, H5T_NATIVE_INT64, starts.data());
    if (starts.front() != 0 || !std::is_sorted(starts.begin(), starts.end()))
      complain(its_place, "something else", "where each list begins, from 0 on, and where the last ends");
    column.kind = Column::Kind::list;
    column.starts.assign(starts.begin(), starts.end());
    if (!has(group, name)) complain(place, "nothing", "the elements of these lists");
    column.elements.push_back(read(group, place, name, column.starts.back(), nullptr, lists + 1, depth + 1));
  }

  /// @param may_be_table whether it may be lists of numbers that are as long as each other
  void read_set(Column& column, hid_t set, std::string const& place, bool may_be_table) {
    Space const space(H5Dget_space(set));
    std::size_t const rows = column.rows();
    if (may_be_table && H5Sget_simple_extent_ndims(space) == 2) {
      std::array<hsize_t, 2> extent{};
      H5Sget_simple_extent_dims(space, extent.data(), nullptr);
      if (static_cast<double>(extent[0]) * static_cast<double>(extent[1]) > most_rows_)
        complain(place, fmt::format("{} rows of {}", extent[0], extent[1]), "what a file of this size can hold");
      require_shape(set, place, {rows, extent[1]}, false);
      column.kind = Column::Kind::list;
      column.starts.resize(rows + 1);
      for (std::size_t k = 0; k <= rows; ++k) column.starts[k] = k * extent[1];
      Column& elements = column.elements.emplace_back();
      elements.gaps.assign(rows * extent[1], Column::there);
      read_values(elements, set, place);
      return;
    }
    require_shape(set, place, {rows}, true);
    read_values(column, set, place);
  }

  void read_values(Column& column, hid_t set, std::string const& place) {
    Type const type(H5Dget_type(set));
    std::size_t const rows = column.rows();
    switch (H5Tget_class(type)) {
      case H5T_ENUM:
        column.kind = Column::Kind::boolean;
        if (H5Tget_size(type) != 1) complain(place, "an enumeration", our_numbers);
        column.booleans.resize(rows);
        return read_into(set, place, type, column.booleans.data());
      case H5T_INTEGER:
        column.kind = Column::Kind::whole;
        if (H5Tget_size(type) > 8 || (H5Tget_size(type) == 8 && H5Tget_sign(type) == H5T_SGN_NONE))
          complain(place, "integers of another range", "signed ones of 64 bits");
        column.wholes.resize(rows);
        return read_into(set, place, H5T_NATIVE_INT64, column.wholes.data());
      case H5T_FLOAT:
        column.kind = Column::Kind::number;
        column.numbers.resize(rows);
        read_into(set, place, H5T_NATIVE_DOUBLE, column.numbers.data());
        for (std::size_t k = 0; k < rows; ++k) {
          if (column.gaps[k] == Column::there && std::isnan(column.numbers[k])) column.gaps[k] = Column::null;
        }
        return;
      case H5T_STRING: return read_texts(column, set, type, place);
      default: complain(place, "something else", our_numbers);
    }
  }

  void read_texts(Column& column, hid_t set, hid_t type, std::string const& place) {
    if (H5Tis_variable_str(type) > 0) complain(place, "texts of variable length", "texts of one length, as the longest needs");
    bool const is_json = H5Aexists(set, "json") > 0;
    column.kind = is_json ? Column::Kind::json : Column::Kind::text;
    std::size_t const size = H5Tget_size(type);
    std::size_t const most = std::max<std::size_t>(1, text_bytes / std::max<std::size_t>(1, size));
    Space const file(H5Dget_space(set));
    bool const is_scalar = H5Sget_simple_extent_ndims(file) == 0;
    std::vector<char> rows;
    for (std::size_t first = 0; first < column.rows(); first += most) {
      hsize_t const from = first;
      hsize_t const count = std::min(most, column.rows() - first);
      rows.resize(count * size);
      Space const memory(is_scalar ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, nullptr));
      if (!is_scalar) H5Sselect_hyperslab(file, H5S_SELECT_SET, &from, nullptr, &count, nullptr);
      if (H5Dread(set, type, memory, file, H5P_DEFAULT, rows.data()) < 0) complain_of_storage(place);
      for (std::size_t k = 0; k < count; ++k) {
        std::string_view const row(&rows[k * size], size);
        column.texts.emplace_back(row.substr(0, row.find('\0')));
        if (column.gaps[first + k] == Column::there) require_text(column.texts.back(), is_json, place);
      }
    }
  }

  void require_text(std::string const& text, bool is_json, std::string const& place) const {
    if (!is_utf8(text)) complain(place, "bytes that are no text", "text in UTF-8");
    if (!is_json) return;
    if (auto const error = find_syntax_error(text)) complain(place, error->found, error->expected);
  }

  Set open_set(hid_t group, std::string const& name, std::string const& place) {
    Set set(H5Dopen2(group, name.c_str(), H5P_DEFAULT));
    if (!set.is_open()) complain(place, "no data set (cut short?)", "numbers");
    return set;
  }

  /// That it is as large as it has to be, lies in this file, and that the file is large enough to hold it.
  void require_shape(hid_t set, std::string const& place, std::vector<hsize_t> const& expected, bool may_be_scalar) const {
    Space const space(H5Dget_space(set));
    int const rank = H5Sget_simple_extent_ndims(space);
    std::vector<hsize_t> extent(static_cast<std::size_t>(std::max(0, rank)));
    H5Sget_simple_extent_dims(space, extent.data(), nullptr);
    bool const is_null = H5Sget_simple_extent_type(space) == H5S_NULL;
    bool const is_one = may_be_scalar && rank == 0 && !is_null && expected.front() == 1;
    if (!is_one && (extent != expected || is_null))
      complain(place, fmt::format("{} entries", fmt::join(extent, " x ")), fmt::format("{}, one for each row", fmt::join(expected, " x ")));
    Properties const properties(H5Dget_create_plist(set));
    if (H5Pget_layout(properties) == H5D_VIRTUAL || H5Pget_external_count(properties) > 0)
      complain(place, "numbers in another file", "numbers in this one");
    Type const type(H5Dget_type(set));
    double const bytes = static_cast<double>(H5Tget_size(type)) *
                         std::accumulate(expected.begin(), expected.end(), 1.0, [](double n, hsize_t m) { return n * static_cast<double>(m); });
    if (bytes > most_deflated * static_cast<double>(H5Dget_storage_size(set)))
      complain(place, fmt::format("{:.3g} bytes of which the file holds {}", bytes, H5Dget_storage_size(set)), "all of them");
  }

  [[noreturn]] void complain_of_storage(std::string const& place) const {
    complain(place, "a data set that cannot be read (cut short?)", "a whole file");
  }

  void read_into(hid_t set, std::string const& place, hid_t type, void* values) const {
    Space const space(H5Dget_space(set));
    if (H5Sget_simple_extent_npoints(space) == 0) return;
    if (H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0) complain_of_storage(place);
  }

  std::string path_;
  double most_rows_;
  std::size_t objects_ = 0;
};

}  // namespace

}  // namespace hdf5

Column read_hdf5_file(std::string bytes, std::string const& path) {
  using namespace hdf5;
  std::scoped_lock const lock(library());
  be_quiet();
  std::size_t const size = bytes.size();
  File file;
  {
    constexpr std::size_t step = std::size_t{1} << 20;
    Properties const access(H5Pcreate(H5P_FILE_ACCESS));
    H5Pset_fapl_core(access, step, false);
    H5Pset_file_image(access, bytes.data(), size);
    bytes = {};
    file = File(H5Fopen(in_memory, H5F_ACC_RDONLY, access));
  }
  if (!file.is_open()) throw UserError(path, "", "an HDF5 file that cannot be opened (cut short?)", "a whole one");
  Column document;
  document.kind = Column::Kind::object;
  document.gaps = {Column::there};
  Group const root(H5Gopen2(file, "/", H5P_DEFAULT));
  if (H5Lexists(root, "schema", H5P_DEFAULT) <= 0)
    throw UserError(path, "schema", "nothing: an HDF5 file of another kind", "results of sphverify");
  Reader(path, size).read_members(root, "", document, 0);
  return document;
}

}  // namespace sphverify
