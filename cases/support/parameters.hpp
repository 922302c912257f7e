#pragma once

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace sphverify {

/// The value of a case's parameter: a number, a word, a list of numbers, or a list of lists.
using ParameterValue =
    std::variant<double, std::string, std::vector<double>, std::vector<std::vector<double>>>;

struct ParameterSpec {
  std::string name;
  std::string unit;
  std::string meaning;
  ParameterValue default_value;
  bool integer = false;
};

/// A case's parameters, complete: defaults with the user's values over them.
class Parameters {
 public:
  explicit Parameters(std::vector<ParameterSpec> const& specs) {
    for (auto const& spec : specs) values_[spec.name] = spec.default_value;
  }

  void set(std::string const& name, ParameterValue value) { values_[name] = std::move(value); }

  double number(std::string const& name) const { return std::get<double>(values_.at(name)); }
  int integer(std::string const& name) const { return static_cast<int>(number(name)); }
  std::vector<double> const& list(std::string const& name) const {
    return std::get<std::vector<double>>(values_.at(name));
  }

  /// A word, one of those allowed. Throws std::invalid_argument.
  std::string const& one_of(std::string const& name, std::vector<std::string> const& allowed) const {
    std::string const& word = std::get<std::string>(values_.at(name));
    if (std::find(allowed.begin(), allowed.end(), word) != allowed.end()) return word;
    std::string message = name + " must be one of";
    for (std::string const& one : allowed) message += " " + one;
    throw std::invalid_argument(message + ", found " + word);
  }

  std::vector<std::vector<double>> const& table(std::string const& name) const {
    return std::get<std::vector<std::vector<double>>>(values_.at(name));
  }

  std::map<std::string, ParameterValue> const& all() const { return values_; }
  bool operator==(Parameters const&) const = default;

 private:
  std::map<std::string, ParameterValue> values_;
};

}  // namespace sphverify
