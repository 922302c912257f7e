// SPDX-License-Identifier: GPL-3.0-or-later
// A snapshot in HDF5 that is what it should be for that library, and says anything: its groups, numbers and
// links are built of lines such as `set /PartType0/Masses f4 4,3 0.1 nan`, `attribute /Header Time f8 1 0.1`,
// `text / schema swift`.
#include <hdf5.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <vector>

#include "harness/codes/hdf5/file.hpp"
#include "tests/fuzz/target.hpp"
#include "tests/fuzz/targets/assess_file.hpp"

namespace sphverify::fuzz {

namespace {

using hdf5::Handle;
using File = Handle<H5Fclose>;
using Group = Handle<H5Gclose>;
using Object = Handle<H5Oclose>;
using Set = Handle<H5Dclose>;
using Space = Handle<H5Sclose>;
using Type = Handle<H5Tclose>;
using Properties = Handle<H5Pclose>;
using Attribute = Handle<H5Aclose>;

constexpr hsize_t most_numbers = 4096;  // that are written; more are left to the file's filling

Type type_of(std::string const& word) {
  if (word == "f2") {
    Type half(H5Tcopy(H5T_IEEE_F32LE));
    H5Tset_fields(half, 15, 10, 5, 0, 10);
    H5Tset_size(half, 2);
    H5Tset_ebias(half, 15);
    return half;
  }
  if (word == "text") return Type(H5Tcopy(H5T_C_S1));
  if (word == "texts") {
    Type variable(H5Tcopy(H5T_C_S1));
    H5Tset_size(variable, H5T_VARIABLE);
    return variable;
  }
  if (word == "pair") {
    Type pair(H5Tcreate(H5T_COMPOUND, 16));
    H5Tinsert(pair, "a", 0, H5T_NATIVE_DOUBLE);
    H5Tinsert(pair, "b", 8, H5T_NATIVE_DOUBLE);
    return pair;
  }
  hid_t const known = word == "f4"    ? H5T_IEEE_F32LE
                      : word == "F8"  ? H5T_IEEE_F64BE
                      : word == "i1"  ? H5T_STD_I8LE
                      : word == "i4"  ? H5T_STD_I32BE
                      : word == "u8"  ? H5T_STD_U64LE
                      : word == "ref" ? H5T_STD_REF_OBJ
                                      : H5T_IEEE_F64LE;
  return Type(H5Tcopy(known));
}

/// Extents as in 4,3; none of them: a single number, empty: none at all.
std::vector<hsize_t> extent_of(std::string const& word) {
  std::vector<hsize_t> extent;
  std::istringstream parts(word);
  for (std::string part; extent.size() < 4 && std::getline(parts, part, ',');)
    extent.push_back(std::strtoull(part.c_str(), nullptr, 10));
  return extent;
}

Space space_of(std::string const& word) {
  auto const extent = extent_of(word);
  if (word == "scalar") return Space(H5Screate(H5S_SCALAR));
  if (word == "null") return Space(H5Screate(H5S_NULL));
  return Space(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr));
}

/// As many numbers as a space has, those that are said one after the other and again from the first.
std::vector<double> numbers_in(std::istringstream& line, hid_t space) {
  std::vector<double> said;
  for (std::string word; line >> word;) said.push_back(std::strtod(word.c_str(), nullptr));
  hssize_t const count = H5Sget_simple_extent_npoints(space);
  if (said.empty() || count < 1 || count > static_cast<hssize_t>(most_numbers)) return {};
  std::vector<double> all(static_cast<std::size_t>(count));
  for (std::size_t k = 0; k < all.size(); ++k) all[k] = said[k % said.size()];
  return all;
}

void add_set(hid_t file, std::string const& storage, std::istringstream& line) {
  std::string place, type, extent;
  line >> place >> type >> extent;
  Space const space = space_of(extent);
  Type const stored = type_of(type);
  Properties const how(H5Pcreate(H5P_DATASET_CREATE));
  Properties const links(H5Pcreate(H5P_LINK_CREATE));
  H5Pset_create_intermediate_group(links, 1);
  int const rank = H5Sget_simple_extent_ndims(space);
  std::array<hsize_t, 4> const chunk{8, 1, 1, 1};
  if (storage != "set" && rank > 0) H5Pset_chunk(how, rank, chunk.data());
  if (storage == "deflated") H5Pset_deflate(how, 1);
  if (storage == "raw") H5Pset_external(how, "input", 0, H5F_UNLIMITED);
  if (storage == "parts") H5Pset_virtual(how, space, "input.hdf5", place == "/x" ? "/y" : "/x", space);
  Set const set(H5Dcreate2(file, place.c_str(), stored, space, links, how, H5P_DEFAULT));
  auto const numbers = set.is_open() ? numbers_in(line, space) : std::vector<double>{};
  H5T_class_t const kind = H5Tget_class(stored);
  if (!numbers.empty() && (kind == H5T_FLOAT || kind == H5T_INTEGER))
    H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data());
}

void add_attribute(hid_t file, std::istringstream& line) {
  std::string place, name, type, extent;
  line >> place >> name >> type >> extent;
  std::replace(name.begin(), name.end(), '_', ' ');  // "Kernel gamma"
  Space const space = space_of(extent);
  Type const stored = type_of(type);
  Object const object(H5Oopen(file, place.c_str(), H5P_DEFAULT));
  if (!object.is_open()) return;
  Attribute const attribute(H5Acreate2(object, name.c_str(), stored, space, H5P_DEFAULT, H5P_DEFAULT));
  auto const numbers = attribute.is_open() ? numbers_in(line, space) : std::vector<double>{};
  H5T_class_t const kind = H5Tget_class(stored);
  if (!numbers.empty() && (kind == H5T_FLOAT || kind == H5T_INTEGER))
    H5Awrite(attribute, H5T_NATIVE_DOUBLE, numbers.data());
}

void add_text(hid_t file, std::istringstream& line) {
  std::string place, name, words;
  line >> place >> name;
  std::getline(line >> std::ws, words);
  Object const object(H5Oopen(file, place.c_str(), H5P_DEFAULT));
  if (!object.is_open()) return;
  Type const type(H5Tcopy(H5T_C_S1));
  H5Tset_size(type, std::max<std::size_t>(1, words.size()));
  Attribute const attribute(
      H5Acreate2(object, name.c_str(), type, Space(H5Screate(H5S_SCALAR)), H5P_DEFAULT, H5P_DEFAULT));
  if (attribute.is_open()) H5Awrite(attribute, type, words.c_str());
}

void add(hid_t file, std::string const& text) {
  std::istringstream line(text);
  std::string what, from, to;
  line >> what;
  if (what == "set" || what == "chunked" || what == "deflated" || what == "raw" || what == "parts")
    return add_set(file, what, line);
  if (what == "attribute") return add_attribute(file, line);
  if (what == "text") return add_text(file, line);
  line >> from >> to;
  Properties const links(H5Pcreate(H5P_LINK_CREATE));
  H5Pset_create_intermediate_group(links, 1);
  if (what == "group") Group const made(H5Gcreate2(file, from.c_str(), links, H5P_DEFAULT, H5P_DEFAULT));
  if (what == "soft") H5Lcreate_soft(to.c_str(), file, from.c_str(), links, H5P_DEFAULT);
  if (what == "hard") H5Lcreate_hard(file, to.c_str(), file, from.c_str(), links, H5P_DEFAULT);
  if (what == "elsewhere")
    H5Lcreate_external("input.hdf5", to.c_str(), file, from.c_str(), links, H5P_DEFAULT);
}

/// @return the format that the first line names, if it names one
std::string build(std::string const& from, std::string const& to) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  File const file(H5Fcreate(to.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  std::string format = "auto";
  std::ifstream input(from, std::ios::binary);
  for (std::string line; std::getline(input, line);) {
    for (char const* known : {"hdf5", "swift", "gadget", "pysph"}) {
      if (line == known) format = known;
    }
    add(file, line);
  }
  return format;
}

}  // namespace

void take_built_hdf5(std::string const& file) {
  std::string const built = file + ".hdf5";
  assess_file(built, build(file, built));
}

}  // namespace sphverify::fuzz
