// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "reports/json/node.hpp"

namespace sphverify {

/// What many objects have under one key, a row for each: numbers beside each other rather than in as many objects. Objects
/// become a column for each of their keys, lists one column of the elements of all of them. What is appended is what is read
/// again, but that keys of objects come back in alphabetical order and that 2 and 2.0 are one number.
struct Column {
  enum class Kind {
    nothing,  ///< no row has a value
    boolean,
    whole,    ///< integers, one in every row
    number,   ///< real numbers, and integers where there are gaps or real numbers beside them
    text,
    json,  ///< values that are not alike, each as text of JSON
    object,
    list
  };
  enum Gap : std::uint8_t { there = 0, null = 1, absent = 2 };

  Kind kind = Kind::nothing;
  std::vector<std::uint8_t> gaps;  ///< by row; of a row that is not there the values below mean nothing

  std::vector<std::uint8_t> booleans;
  std::vector<std::int64_t> wholes;
  std::vector<double> numbers;     ///< NaN at gaps
  std::vector<std::string> texts;  ///< of `text` and `json`
  std::map<std::string, Column> members;  ///< each as long as this
  std::vector<std::uint64_t> starts;      ///< row k of a list has elements starts[k] to starts[k + 1]
  std::vector<Column> elements;           ///< one

  std::size_t rows() const { return gaps.size(); }

  void append(Json const& value);
  void append_absent();

  /// Whether all rows have a value.
  bool is_full() const;

  /// The value of a row that is not absent.
  Json row(std::size_t k) const;

  /// Makes it a column of JSON's text, as one becomes by itself when what is appended is not like what was before.
  void turn_into_json();
};

/// Whether a text is UTF-8.
bool is_utf8(std::string_view text);

}  // namespace sphverify
