// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cases/support/parameters.hpp"
#include "reports/user_error.hpp"

namespace sphverify {

using Json = nlohmann::ordered_json;

/// Reads and parses a file; `-` is standard input. Throws UserError, with line and column of what is not
/// JSON.
Json read_json_file(std::string const& path);
/// The two halves of it.
std::string read_file(std::string const& path);
Json parse_json(std::string const& text, std::string const& path);

/// A place in a user's document that knows its file and key, so that every complaint can name them. All reads
/// throw UserError when they find something else.
class Node {
 public:
  Node(Json const& value, std::string file, std::string key = "")
      : value_(&value), file_(std::move(file)), key_(std::move(key)) {}

  Json const& json() const { return *value_; }
  std::string const& file() const { return file_; }
  std::string const& key() const { return key_; }

  bool is_null() const { return value_->is_null(); }
  bool is_string() const { return value_->is_string(); }
  bool is_object() const { return value_->is_object(); }
  bool is_array() const { return value_->is_array(); }

  /// Complains of a key that is not in the list, naming the nearest one that is.
  void require_keys(std::vector<std::string> const& known) const;
  /// Complains of another schema, else of a key that is not known, else of a missing schema.
  void require_document(std::string const& schema, std::vector<std::string> const& known) const;
  /// Complains of a schema other than this.
  void require_schema(std::string const& schema) const;

  Node at(std::string const& key) const;
  std::optional<Node> find(std::string const& key) const;
  /// The elements of an array, or the value itself as the only one.
  std::vector<Node> one_or_many() const;
  std::vector<Node> elements() const;
  std::vector<std::pair<std::string, Node>> members() const;

  double number() const;
  double positive_number() const;
  double number_between(double lowest, double highest) const;
  std::int64_t integer(std::int64_t lowest, std::int64_t highest) const;
  bool boolean() const;
  std::string string() const;
  std::string word(std::vector<std::string> const& allowed) const;
  std::vector<double> numbers() const;

  [[noreturn]] void complain(std::string const& expected) const;
  /// The value in a few words, on one line.
  std::string describe() const;

 private:
  std::string child_key(std::string const& name) const { return key_.empty() ? name : key_ + "." + name; }

  Json const* value_;
  std::string file_;
  std::string key_;
};

/// A parameter's value of the same kind as its default.
ParameterValue read_parameter(Node const& node, ParameterSpec const& spec);

}  // namespace sphverify
