// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "reports/json/node.hpp"
#include "reports/results.hpp"

/// What every part of the page's data is written with.
namespace sphverify::page {

/// Rounded to five digits, more than a plot can show; null where there is none.
Json number(double value);
Json number(Number const& value);

/// The next whole number that is enough; rounded to the page's digits it might not be.
Json enough(Number const& resolution);
Json numbers(std::vector<double> const& values);

/// Words that occur often are written once and then named by their number.
class Dictionary {
 public:
  Json operator()(std::string const& word);
  /// Null for an empty word.
  Json or_null(std::string const& word);
  Json const& words() const { return words_; }

 private:
  std::map<std::string, std::size_t> numbers_;
  Json words_ = Json::array();
};

/// `count` indices spread evenly over [0, size), the first and the last among them.
std::vector<std::size_t> spread_evenly(std::size_t size, std::size_t count);

/// The values at some indices; null where there is none.
Json picked(std::vector<double> const& values, std::vector<std::size_t> const& indices);

/// Component k of every particle at some indices; null where there is none.
Json picked(std::vector<std::vector<double>> const& values, std::size_t k,
            std::vector<std::size_t> const& indices);

/// Points that each of several curves may have, if one point of them all takes that many numbers.
std::size_t points_each(std::size_t most_numbers, std::size_t numbers_per_point);

/// [seconds, low, high]: the median and the interval of it where repeats give one, else the shortest.
Json time_json(Number const& shortest, MedianSeconds const& median);

/// The settings beside the formulation, in the order in which the page names them.
/// @param first_resolution where h/dx is the nominal ratio, if it grows
Json settings_json(Discretisation const& discretisation, double smoothing_exponent, int first_resolution,
                   Dictionary& word);

/// Keys `label`, `formulation`, `work`, `conduction` and `walls`.
void put_formulation(Json& json, FormulationChoice const& choice, std::string const& label, Dictionary& word);

}  // namespace sphverify::page
