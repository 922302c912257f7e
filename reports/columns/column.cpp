// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/columns/column.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reports/printable.hpp"

namespace sphverify {

namespace {

constexpr double not_there = std::numeric_limits<double>::quiet_NaN();

std::string json_text(Json const& value) { return value.dump(-1, ' ', false, Json::error_handler_t::replace); }

/// JSON's text has the three bytes of U+FFFD for what is not UTF-8.
std::string clean(std::string const& text) {
  return is_utf8(text) ? text : Json::parse(json_text(text)).get<std::string>();
}

/// Up to here every integer is a double.
constexpr std::int64_t largest_exact = std::int64_t{1} << 53;
bool is_exact(std::int64_t whole) { return whole >= -largest_exact && whole <= largest_exact; }

Column::Kind kind_of(Json const& value) {
  if (value.is_boolean()) return Column::Kind::boolean;
  if (value.is_number_unsigned() && value.get<std::uint64_t>() > std::numeric_limits<std::int64_t>::max()) return Column::Kind::json;
  if (value.is_number_integer()) return Column::Kind::whole;
  if (value.is_number()) return Column::Kind::number;
  if (value.is_string())  // HDF5 ends a text at a zero
    return value.get_ref<std::string const&>().find('\0') == std::string::npos ? Column::Kind::text : Column::Kind::json;
  return value.is_object() ? Column::Kind::object : Column::Kind::list;
}

/// JSON has neither NaN nor infinity: they are written as null.
bool is_null(Json const& value) {
  return value.is_null() || (value.is_number_float() && !std::isfinite(value.get<double>()));
}

/// Integers as real numbers, if that changes none.
bool turn_into_numbers(Column& column) {
  if (!std::all_of(column.wholes.begin(), column.wholes.end(), is_exact)) return false;
  column.numbers.assign(column.wholes.begin(), column.wholes.end());
  column.wholes = {};
  column.kind = Column::Kind::number;
  return true;
}

/// A row that is not there, in whatever holds the column's values.
void fill_row(Column& column) {
  if (column.kind == Column::Kind::whole && !turn_into_numbers(column)) column.turn_into_json();
  switch (column.kind) {
    case Column::Kind::nothing:
    case Column::Kind::whole: break;
    case Column::Kind::boolean: column.booleans.push_back(0); break;
    case Column::Kind::number: column.numbers.push_back(not_there); break;
    case Column::Kind::text:
    case Column::Kind::json: column.texts.emplace_back(); break;
    case Column::Kind::object:
      for (auto& [name, member] : column.members) member.append_absent();
      break;
    case Column::Kind::list: column.starts.push_back(column.starts.back()); break;
  }
}

/// The first value says what a column is of.
void begin(Column& column, Column::Kind kind) {
  column.kind = kind == Column::Kind::whole && column.rows() > 0 ? Column::Kind::number : kind;
  if (kind == Column::Kind::list) {
    column.starts.push_back(0);
    column.elements.emplace_back();
  }
  for (std::size_t k = 0; k < column.rows(); ++k) fill_row(column);
}

/// Makes a column take a value; returns the kind that it then is of.
Column::Kind accommodate(Column& column, Json const& value) {
  using Kind = Column::Kind;
  Kind const kind = kind_of(value);
  if (column.kind == Kind::nothing) begin(column, kind);
  if (column.kind == kind || column.kind == Kind::json) return column.kind;
  if (column.kind == Kind::whole && kind == Kind::number && turn_into_numbers(column)) return kind;
  if (column.kind == Kind::number && kind == Kind::whole && is_exact(value.get<std::int64_t>())) return Kind::number;
  column.turn_into_json();
  return Kind::json;
}

void append_object(Column& column, Json const& object) {
  std::size_t const rows = column.rows();
  for (auto const& [key, value] : object.items()) {
    Column& member = column.members[key];
    while (member.rows() < rows) member.append_absent();
    member.append(value);
  }
  for (auto& [name, member] : column.members) {
    if (member.rows() == rows) member.append_absent();
  }
}

}  // namespace

bool is_utf8(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    std::size_t const size = static_cast<unsigned char>(text[at]) < 0x80U ? 1 : utf8_size(text.substr(at));
    if (size == 0) return false;
    at += size;
  }
  return true;
}

void Column::append(Json const& value) {
  if (is_null(value)) {
    fill_row(*this);
    gaps.push_back(null);
    return;
  }
  switch (accommodate(*this, value)) {
    case Kind::nothing: break;
    case Kind::boolean: booleans.push_back(value.get<bool>()); break;
    case Kind::whole: wholes.push_back(value.get<std::int64_t>()); break;
    case Kind::number: numbers.push_back(value.get<double>()); break;
    case Kind::text: texts.push_back(clean(value.get_ref<std::string const&>())); break;
    case Kind::json: texts.push_back(json_text(value)); break;
    case Kind::object: append_object(*this, value); break;
    case Kind::list:
      for (Json const& element : value) elements.front().append(element);
      starts.push_back(elements.front().rows());
      break;
  }
  gaps.push_back(there);
}

void Column::append_absent() {
  fill_row(*this);
  gaps.push_back(absent);
}

bool Column::is_full() const {
  return std::all_of(gaps.begin(), gaps.end(), [](std::uint8_t gap) { return gap == there; });
}

Json Column::row(std::size_t k) const {
  if (gaps[k] != there) return nullptr;
  switch (kind) {
    case Kind::nothing: return nullptr;
    case Kind::boolean: return booleans[k] != 0;
    case Kind::whole: return wholes[k];
    case Kind::number: return numbers[k];
    case Kind::text: return texts[k];
    case Kind::json: return Json::parse(texts[k]);
    case Kind::object: {
      Json object = Json::object();
      for (auto const& [name, member] : members) {
        if (member.gaps[k] != absent) object[name] = member.row(k);
      }
      return object;
    }
    case Kind::list: {
      Json list = Json::array();
      for (std::uint64_t n = starts[k]; n < starts[k + 1]; ++n) list.push_back(elements.front().row(n));
      return list;
    }
  }
  return nullptr;
}

void Column::turn_into_json() {
  Column all;
  all.kind = Kind::json;
  for (std::size_t k = 0; k < rows(); ++k) all.texts.push_back(gaps[k] == there ? json_text(row(k)) : "");
  all.gaps = std::move(gaps);
  *this = std::move(all);
}

}  // namespace sphverify
