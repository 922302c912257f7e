// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "harness/measure/surface_fit.hpp"

namespace sphverify {

/// Draws of numbers that follow from a fitted law, as their data might have come out otherwise.
class SurfaceBootstrap {
 public:
  /// What follows from a law: named numbers, those that exist.
  using Answers = std::map<std::string, double>;

  /// @param rivals the laws that compete in every draw, the one that the data were closest to first
  SurfaceBootstrap(std::vector<SurfaceDatum> const& data, std::vector<SurfaceFit> const& rivals,
                   HuberThreshold threshold, std::function<Answers(SurfaceLaw const&)> const& answer);

  /// The number of the law itself, with the 95% interval of its draws; without one where fewer than nine
  /// draws in ten have the number.
  Estimate estimate(std::string const& name) const;

 private:
  Answers answers_;
  std::map<std::string, std::vector<double>> draws_;  ///< rising
};

}  // namespace sphverify
