// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "reports/hdf5.hpp"
#include "reports/hdf5/library.hpp"
#include "reports/hdf5/names.hpp"

namespace sphverify {

namespace hdf5 {

namespace {

constexpr std::size_t chunk_bytes = std::size_t{1} << 20;      // what the library keeps at a time
constexpr std::size_t compact_bytes = 1024;                    // up to here a chunk's index costs more than it saves
constexpr std::size_t most_compact_bytes = std::size_t{1} << 15;  // a scalar cannot be in chunks
constexpr unsigned deflate_level = 1;
constexpr std::size_t memory_step = std::size_t{1} << 24;

void require(bool has_worked, std::string const& name) {
  if (!has_worked) throw std::runtime_error("the HDF5 library cannot write '" + name + "'");
}

/// numpy's `bool`.
Type boolean_type() {
  Type type(H5Tenum_create(H5T_STD_I8LE));
  std::int8_t const no = 0, yes = 1;
  H5Tenum_insert(type, "FALSE", &no);
  H5Tenum_insert(type, "TRUE", &yes);
  return type;
}

Type text_type(std::size_t size) {
  Type type(H5Tcopy(H5T_C_S1));
  H5Tset_size(type, size);
  H5Tset_cset(type, H5T_CSET_UTF8);
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  return type;
}

/// Lists of numbers that are all as long as each other: rows of a table. 0: they are not.
std::size_t width_of_table(Column const& list) {
  if (list.kind != Column::Kind::list || list.rows() == 0 || !list.is_full()) return 0;
  Column const& elements = list.elements.front();
  if (elements.kind != Column::Kind::number && elements.kind != Column::Kind::whole) return 0;
  std::size_t const width = list.starts[1];
  for (std::size_t k = 0; k < list.rows(); ++k) {
    if (list.starts[k + 1] - list.starts[k] != width) return 0;
  }
  return width;
}

class Writer {
 public:
  Writer() : with_utf8_(H5Pcreate(H5P_LINK_CREATE)), of_groups_(H5Pcreate(H5P_GROUP_CREATE)) {
    H5Pset_char_encoding(with_utf8_, H5T_CSET_UTF8);
    H5Pset_link_phase_change(of_groups_, 1024, 512);  // names beside each other rather than in a tree
    H5Pset_obj_track_times(of_groups_, false);  // the same results are the same bytes
    can_deflate_ = H5Zfilter_avail(H5Z_FILTER_DEFLATE) > 0;
  }

  /// @param around which rows the object has whose key this is; none: all
  /// @param lists how many lists this is in, from its name on
  /// @param is_alone whether it is in no list at all
  void put(hid_t group, std::string const& name, Column const& column, std::vector<std::uint8_t> const* around, int lists,
           bool is_alone) {
    is_alone_ = is_alone;
    if (needs_gaps(column, around)) put_set(group, missing_of(name, lists), H5T_STD_U8LE, H5T_NATIVE_UINT8, {column.rows()}, column.gaps.data());
    std::vector<hsize_t> const extent{column.rows()};
    switch (column.kind) {
      case Column::Kind::nothing: {
        std::vector<double> const none(column.rows(), std::numeric_limits<double>::quiet_NaN());
        return put_set(group, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, extent, none.data());
      }
      case Column::Kind::boolean: {
        Type const type = boolean_type();
        return put_set(group, name, type, type, extent, column.booleans.data());
      }
      case Column::Kind::whole:
      case Column::Kind::number: return put_numbers(group, name, column, extent);
      case Column::Kind::text:
      case Column::Kind::json: return put_texts(group, name, column);
      case Column::Kind::object: return put_object(group, name, column, is_alone);
      case Column::Kind::list: return put_list(group, name, column, lists);
    }
  }

 private:
  static bool needs_gaps(Column const& column, std::vector<std::uint8_t> const* around) {
    bool const has_nan = column.kind == Column::Kind::number || column.kind == Column::Kind::nothing;
    for (std::size_t k = 0; k < column.rows(); ++k) {
      if (around != nullptr && (*around)[k] != Column::there) continue;
      if (column.gaps[k] == Column::absent || (column.gaps[k] == Column::null && !has_nan)) return true;
    }
    return false;
  }

  void put_object(hid_t group, std::string const& name, Column const& column, bool is_alone) {
    Group const made(H5Gcreate2(group, name.c_str(), with_utf8_, of_groups_, H5P_DEFAULT));
    require(made.is_open(), name);
    for (auto const& [key, member] : column.members) put(made, name_of_key(key), member, &column.gaps, 0, is_alone);
  }

  void put_list(hid_t group, std::string const& name, Column const& list, int lists) {
    is_alone_ = false;
    std::size_t const width = lists > 0 ? width_of_table(list) : 0;
    if (width > 0) return put_numbers(group, name, list.elements.front(), {list.rows(), width});
    put_set(group, starts_of(name, lists), H5T_STD_I64LE, H5T_NATIVE_UINT64, {list.starts.size()}, list.starts.data());
    put(group, name, list.elements.front(), nullptr, lists + 1, false);
  }

  void put_numbers(hid_t group, std::string const& name, Column const& column, std::vector<hsize_t> const& extent) {
    if (column.kind == Column::Kind::whole) {
      put_set(group, name, H5T_STD_I64LE, H5T_NATIVE_INT64, extent, column.wholes.data());
    } else {
      put_set(group, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, extent, column.numbers.data());
    }
  }

  void put_set(hid_t group, std::string const& name, hid_t stored, hid_t given, std::vector<hsize_t> const& extent, void const* values) {
    Set const set = make_set(group, name, stored, extent);
    require(extent.front() == 0 || H5Dwrite(set, given, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0, name);
  }

  /// All as long as the longest, which deflating makes up for; a part of the rows at a time.
  void put_texts(hid_t group, std::string const& name, Column const& column) {
    std::size_t size = 1;
    for (std::string const& text : column.texts) size = std::max(size, text.size());
    Type const type = text_type(size);
    Set const set = make_set(group, name, type, {column.rows()});
    if (column.kind == Column::Kind::json) put_mark(set, "json");
    if (is_alone_) {
      require(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, column.texts.front().c_str()) >= 0, name);
      return;
    }
    Space const file(H5Dget_space(set));
    std::size_t const most = std::max<std::size_t>(1, chunk_bytes / size);
    std::vector<char> rows;
    for (std::size_t first = 0; first < column.rows(); first += most) {
      hsize_t const from = first;
      hsize_t const count = std::min(most, column.rows() - first);
      rows.assign(count * size, '\0');
      for (std::size_t k = 0; k < count; ++k) std::memcpy(&rows[k * size], column.texts[first + k].data(), column.texts[first + k].size());
      Space const memory(H5Screate_simple(1, &count, nullptr));
      H5Sselect_hyperslab(file, H5S_SELECT_SET, &from, nullptr, &count, nullptr);
      require(H5Dwrite(set, type, memory, file, H5P_DEFAULT, rows.data()) >= 0, name);
    }
  }

  static void put_mark(hid_t set, char const* name) {
    Space const space(H5Screate(H5S_SCALAR));
    Type const type = boolean_type();
    Attribute const mark(H5Acreate2(set, name, type, space, H5P_DEFAULT, H5P_DEFAULT));
    std::int8_t const yes = 1;
    require(H5Awrite(mark, type, &yes) >= 0, name);
  }

  Set make_set(hid_t group, std::string const& name, hid_t stored, std::vector<hsize_t> const& extent) {
    std::size_t row = H5Tget_size(stored);
    for (std::size_t k = 1; k < extent.size(); ++k) row *= extent[k];
    std::size_t const bytes = row * extent.front();
    Properties const properties(H5Pcreate(H5P_DATASET_CREATE));
    H5Pset_obj_track_times(properties, false);
    H5Pset_fill_time(properties, H5D_FILL_TIME_NEVER);
    if (bytes <= (is_alone_ ? most_compact_bytes : compact_bytes)) {
      H5Pset_layout(properties, H5D_COMPACT);
    } else if (!is_alone_) {
      std::vector<hsize_t> chunk = extent;
      chunk.front() = std::clamp<hsize_t>(chunk_bytes / row, 1, extent.front());
      H5Pset_chunk(properties, static_cast<int>(chunk.size()), chunk.data());
      if (can_deflate_) {
        H5Pset_shuffle(properties);
        H5Pset_deflate(properties, deflate_level);
      }
    }
    Space const space(is_alone_ ? H5Screate(H5S_SCALAR) : H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr));
    Set set(H5Dcreate2(group, name.c_str(), stored, space, with_utf8_, properties, H5P_DEFAULT));
    require(set.is_open(), name);
    return set;
  }

  Properties with_utf8_, of_groups_;
  bool can_deflate_ = false;
  bool is_alone_ = false;
};

}  // namespace

}  // namespace hdf5

bool can_use_hdf5() { return true; }

std::string hdf5_file(Column const& document) {
  using namespace hdf5;
  std::scoped_lock const lock(library());
  be_quiet();
  Properties const access(H5Pcreate(H5P_FILE_ACCESS));
  H5Pset_fapl_core(access, memory_step, false);
  File const file(H5Fcreate(in_memory, H5F_ACC_TRUNC, H5P_DEFAULT, access));
  require(file.is_open(), "results");
  // Of 2016 on: checksums over all but the numbers, which deflating gives theirs, and chunks without trees. The file itself
  // begins as before: of a newer beginning 1.10 gives away an image with a wrong checksum.
  H5Fset_libver_bounds(file, H5F_LIBVER_V110, H5F_LIBVER_V110);
  Writer writer;
  for (auto const& [key, member] : document.members) writer.put(file, name_of_key(key), member, nullptr, 0, true);
  require(H5Fflush(file, H5F_SCOPE_GLOBAL) >= 0, "results");
  ssize_t const size = H5Fget_file_image(file, nullptr, 0);
  require(size > 0, "results");
  std::string bytes(static_cast<std::size_t>(size), '\0');
  require(H5Fget_file_image(file, bytes.data(), bytes.size()) == size, "results");
  return bytes;
}

}  // namespace sphverify
