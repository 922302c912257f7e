// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "harness/measure/surface_law.hpp"

namespace sphverify {

/// One place of a grid over resolution and h/dx, with its error.
struct SurfaceDatum {
  double spacing = 0.0;    ///< dx, any unit
  double ratio = 0.0;      ///< h/dx
  double error = 0.0;      ///< above 0
  std::size_t row = 0;     ///< which spacing it is
  std::size_t column = 0;  ///< which h/dx it is
};

/// What a model of an error surface holds; see `SurfaceLaw`.
struct SurfaceModel {
  enum class Sampling { none, power, by_ratio };
  enum class Correlation { squares, added, fitted };  ///< c = 0, c = 1, or what the data say
  std::string name;
  bool smoothing = true;
  bool floor = false;
  Sampling sampling = Sampling::none;
  bool spacing = false;  ///< t is fitted; otherwise 0
  Correlation correlation = Correlation::squares;
};

/// A model put through data.
struct SurfaceFit {
  SurfaceModel model;
  SurfaceLaw law;
  std::vector<double> parameters;  ///< of the fit, to start another from
  std::vector<double> residuals;   ///< ln(error / law), by datum
  double loss = 0.0;               ///< Huber's, of the residuals
  double criterion = 0.0;          ///< Akaike's information criterion with its correction for few data
  double misfit = 0.0;             ///< root mean square of the residuals
};

/// Residuals at most so large count by their square, larger ones by their size (Huber 1964).
struct HuberThreshold {
  double value;
};

/// Least squares of the logarithms, robust by iterated weights (GSL's `multifit_nlinear`,
/// Levenberg-Marquardt, analytic derivatives). Empty where there are too few data for the model or no start
/// leads to a finite law.
/// @param start parameters of an earlier fit of the same model and grid; empty: several starts are tried
std::optional<SurfaceFit> fit_surface(std::vector<SurfaceDatum> const& data, SurfaceModel const& model,
                                      HuberThreshold threshold, std::vector<double> const& start = {});

/// All models that the data are enough for, from the one of the least criterion. The threshold is common to
/// all: two and a half times the scale of the residuals of the closest.
struct SurfaceFits {
  std::vector<SurfaceFit> fits;
  HuberThreshold threshold{0.0};
};
SurfaceFits fit_surface_models(std::vector<SurfaceDatum> const& data);

}  // namespace sphverify
