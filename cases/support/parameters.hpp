// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "cases/exact/bad_value.hpp"

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

/// A case's parameters, complete: defaults with the user's values over them. It knows which of them the user
/// gave, and can note which of them are looked at.
class Parameters {
 public:
  explicit Parameters(std::vector<ParameterSpec> const& specs) {
    for (auto const& spec : specs) values_[spec.name] = spec.default_value;
  }

  void set(std::string const& name, ParameterValue value) { values_[name] = std::move(value); }

  /// Sets what the user asked for by name: it is to have an effect.
  void give(std::string const& name, ParameterValue value) {
    set(name, std::move(value));
    given_.insert(name);
  }
  bool is_given(std::string const& name) const { return given_.contains(name); }

  /// Forgets a parameter, as though the case had none of that name.
  void drop(std::string const& name) { values_.erase(name); }

  /// The same parameters, which write into `seen` the name of every one that is asked for its value.
  Parameters noting(std::shared_ptr<std::set<std::string>> seen) const {
    Parameters copy = *this;
    copy.seen_ = std::move(seen);
    return copy;
  }

  double number(std::string const& name) const { return std::get<double>(look_up(name)); }
  int integer(std::string const& name) const { return static_cast<int>(number(name)); }
  std::vector<double> const& list(std::string const& name) const {
    return std::get<std::vector<double>>(look_up(name));
  }

  /// A word, one of those allowed. Throws BadValue.
  std::string const& one_of(std::string const& name, std::vector<std::string> const& allowed) const {
    std::string const& word = std::get<std::string>(look_up(name));
    if (std::find(allowed.begin(), allowed.end(), word) != allowed.end()) return word;
    std::string expected;
    for (std::string const& one : allowed) expected += (expected.empty() ? "one of " : ", ") + one;
    throw BadValue(name, expected, "'" + word + "'");
  }

  std::vector<std::vector<double>> const& table(std::string const& name) const {
    return std::get<std::vector<std::vector<double>>>(look_up(name));
  }

  std::map<std::string, ParameterValue> const& all() const { return values_; }

  /// Of the values alone: whether they are defaults or were given makes no other scene.
  bool operator==(Parameters const& other) const { return values_ == other.values_; }

 private:
  ParameterValue const& look_up(std::string const& name) const {
    if (seen_) seen_->insert(name);
    return values_.at(name);
  }

  std::map<std::string, ParameterValue> values_;
  std::set<std::string> given_;
  std::shared_ptr<std::set<std::string>> seen_;  ///< usually none, so that many threads may read
};

}  // namespace sphverify
