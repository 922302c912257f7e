// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "reports/results.hpp"

namespace sphverify {

/// What the rows of a table differ in: document, formulation and numerical choices.
struct Setting {
  std::string document;
  FormulationChoice choice;
  Discretisation discretisation;
  double smoothing_exponent = 0.0;
  int first_resolution = 0;  ///< where h/dx is the nominal ratio; 0: not known
};

/// Of a series, in a document of that name.
Setting setting_of(std::string document, Series const& series);

/// Whether particles are drawn by lot, so that a seed belongs to them.
bool is_drawn(LayoutChoice const& layout);
std::string layout_name(LayoutChoice const& layout);
std::string viscosity_name(ViscosityChoice const& viscosity);
/// "h/dx 1.2", or of a refinement path "h/dx 1.2 (N/25)^0.5".
std::string smoothing_text(Setting const& setting);
std::string parameters_text(std::map<std::string, ParameterValue> const& parameters);

/// The choices of a setting, all of them, for documents that programs read.
std::vector<std::pair<std::string, std::string>> setting_words(Setting const& setting);

/// Short names of settings among others: only what differs among them is named.
class SettingNames {
 public:
  explicit SettingNames(std::vector<Setting> const& settings);

  /// "brookshaw", "p-rho2 + total (walls off)": a partner is named only where the form has several of its
  /// kind.
  std::string formulation(Setting const& setting) const;

  /// Formulation, and the choices that differ.
  std::vector<std::string> row(Setting const& setting) const;
  /// The names of these columns.
  std::vector<std::string> header() const;

  /// Layout, and h/dx where it grows or differs among them.
  std::string column(Setting const& setting) const;

 private:
  /// A choice that may differ, and what it says of a setting.
  struct Choice {
    char const* name;
    std::string (*of)(Setting const&);
    bool (*means_something)(Setting const&);  ///< of others nothing is shown
  };
  static std::vector<Choice> const& choices();

  std::vector<Choice> varying_;
  bool smoothing_varies_ = false;
  std::set<std::string> several_works_, several_conductions_;  ///< forms that have several partners of a kind
};

}  // namespace sphverify
