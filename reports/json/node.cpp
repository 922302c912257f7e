// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/json/node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <limits>

#include "reports/json/case_number.hpp"
#include "reports/json/parse.hpp"
#include "reports/json/places.hpp"
#include "reports/json/syntax.hpp"
#include "reports/printable.hpp"

namespace sphverify {

std::string read_file(std::string const& path) {
  std::string text;
  if (path == "-") {
    text.assign(std::istreambuf_iterator<char>(std::cin), {});
  } else {
    std::ifstream file(path, std::ios::binary);
    if (!file || std::filesystem::is_directory(path))
      throw UserError(path, "", "no readable file", "a JSON document");
    text.assign(std::istreambuf_iterator<char>(file), {});
    if (file.bad()) throw UserError(path, "", "a file that cannot be read", "a JSON document");
  }
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) {
    throw UserError(path, "", "an empty file", "a JSON document");
  }
  return text;
}

Json parse_json(std::string const& text, std::string const& path) {
  if (auto const error = find_syntax_error(text)) {
    throw UserError(place_text(path, {error->line, error->column}), "", error->found, error->expected);
  }
  note_json_file(path);
  try {
    return Json::parse(text);
  } catch (Json::exception const& error) {
    throw UserError(path, "", fmt::format("what its parser refuses: {}", error.what()), "a JSON document");
  }
}

Json read_json_file(std::string const& path) { return parse_json(read_file(path), path); }

std::optional<Json> parse_json(std::string_view text) {
  if (find_syntax_error(text)) return std::nullopt;
  Json json = Json::parse(text, nullptr, false);
  return json.is_discarded() ? std::nullopt : std::optional(std::move(json));
}

std::string Node::describe() const {
  std::string text = value_->dump(-1, ' ', false, Json::error_handler_t::replace);
  if (value_->is_string()) text = "'" + value_->get<std::string>() + "'";
  if (value_->is_object()) text = "an object";
  if (value_->is_array()) text = value_->empty() ? "an empty list" : "a list";
  text = printable(text);
  if (text.size() <= 60) return text;
  std::size_t end = 57;
  while ((static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;  // between characters
  return text.substr(0, end) + "...";
}

void Node::complain(std::string const& expected) const { throw UserError(file_, key_, describe(), expected); }

void Node::require_keys(std::vector<std::string> const& known) const {
  if (!is_object()) complain("an object");
  for (auto const& [name, value] : value_->items()) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw UserError(file_, child_key(name), "an unknown key", one_of(name, known));
    }
  }
}

void Node::require_schema(std::string const& schema) const {
  if (!is_object()) complain(fmt::format("a document of schema {}", schema));
  Node const found = at("schema");
  if (!found.is_string() || found.string() != schema) found.complain(schema);
}

void Node::require_document(std::string const& schema, std::vector<std::string> const& known) const {
  // Of another document no key is to be expected; but who mistypes `schema` has an unknown key.
  if (!is_object() || find("schema")) require_schema(schema);
  require_keys(known);
  require_schema(schema);
}

std::optional<Node> Node::find(std::string const& key) const {
  if (!is_object()) complain("an object");
  auto const it = value_->find(key);
  if (it == value_->end()) return std::nullopt;
  return Node(*it, file_, child_key(key));
}

Node Node::at(std::string const& key) const {
  if (auto const node = find(key)) return *node;
  throw UserError(file_, child_key(key), "nothing", "this key");
}

std::vector<Node> Node::elements() const {
  if (!is_array()) complain("a list");
  std::vector<Node> nodes;
  for (std::size_t i = 0; i < value_->size(); ++i) {
    nodes.emplace_back((*value_)[i], file_, fmt::format("{}[{}]", key_, i));
  }
  return nodes;
}

std::vector<Node> Node::one_or_many() const {
  if (!is_array()) return {*this};
  if (value_->empty()) complain("one value or a list of at least one");
  return elements();
}

std::vector<std::pair<std::string, Node>> Node::members() const {
  if (!is_object()) complain("an object");
  std::vector<std::pair<std::string, Node>> nodes;
  for (auto const& [name, value] : value_->items())
    nodes.emplace_back(name, Node(value, file_, child_key(name)));
  return nodes;
}

double Node::number() const {
  if (!value_->is_number()) complain("a number");
  double const value = value_->get<double>();
  if (!std::isfinite(value)) complain("a finite number");
  return value;
}

double Node::positive_number() const {
  if (!value_->is_number() || !(number() > 0.0)) complain("a positive number");
  return number();
}

double Node::number_between(double lowest, double highest) const {
  if (!value_->is_number() || !(number() >= lowest && number() <= highest)) {
    complain(fmt::format("a number from {:g} to {:g}", lowest, highest));
  }
  return number();
}

std::int64_t Node::integer(std::int64_t lowest, std::int64_t highest) const {
  auto const expected = [&] { return fmt::format("a whole number from {} to {}", lowest, highest); };
  if (!value_->is_number()) complain(expected());
  // What an integer of 64 bits cannot hold is beyond every end.
  constexpr double too_large = 0x1p63;
  double const as_double = number();
  bool const fits = value_->is_number_unsigned() ? value_->get<std::uint64_t>() <= std::numeric_limits<std::int64_t>::max()
                    : value_->is_number_float()  ? as_double == std::floor(as_double) && as_double >= -too_large && as_double < too_large
                                                 : true;
  if (!fits) complain(expected());
  std::int64_t const value = value_->is_number_float() ? static_cast<std::int64_t>(as_double) : value_->get<std::int64_t>();
  if (value < lowest || value > highest) complain(expected());
  return value;
}

bool Node::boolean() const {
  if (!value_->is_boolean()) complain("true or false");
  return value_->get<bool>();
}

std::string Node::string() const {
  if (!value_->is_string()) complain("a string");
  return value_->get<std::string>();
}

std::string Node::word(std::vector<std::string> const& allowed) const {
  if (!value_->is_string()) complain(one_of("", allowed));
  std::string const found = string();
  if (std::find(allowed.begin(), allowed.end(), found) == allowed.end()) complain(one_of(found, allowed));
  return found;
}

std::vector<double> Node::numbers() const {
  std::vector<double> values;
  for (Node const& element : elements()) values.push_back(element.number());
  return values;
}

double read_case_number(Node const& node) {
  constexpr double smallest = 1e-100, largest = 1e100;
  double const value = node.number();
  if (value != 0.0 && !(std::abs(value) >= smallest && std::abs(value) <= largest))
    node.complain("0 or a number of a size from 1e-100 to 1e100");
  return value;
}

namespace {

std::vector<double> case_numbers(Node const& node) {
  std::vector<double> values;
  for (Node const& element : node.elements()) values.push_back(read_case_number(element));
  return values;
}

}  // namespace

ParameterValue read_parameter(Node const& node, ParameterSpec const& spec) {
  if (std::holds_alternative<double>(spec.default_value)) {
    constexpr std::int64_t limit = std::int64_t{1} << 31;
    return spec.integer ? static_cast<double>(node.integer(-limit, limit)) : read_case_number(node);
  }
  if (std::holds_alternative<std::string>(spec.default_value)) return node.string();
  if (std::holds_alternative<std::vector<double>>(spec.default_value)) return case_numbers(node);
  std::vector<std::vector<double>> table;
  for (Node const& row : node.elements()) table.push_back(case_numbers(row));
  return table;
}

}  // namespace sphverify
