// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "harness/scene/scene.hpp"

namespace sphverify {

/// Watches a run of heat conduction without sources: whether temperatures leave the range of what the initial
/// state and the walls held till then (the maximum principle), whether a particle that is hottest (coldest)
/// of all around it is heated (cooled), and whether entropy is produced:
///
///   sum_i m_i q_i/T_i - sum_B P_B/T_B >= 0   (specific heat 1; P_B what wall B gives, at its temperature
///   T_B)
///
/// Ratios of rates count only while the largest heating is a hundred times what temperatures that are off by
/// the integrator's error would change it by; below, they are noise.
template <int Dim>
class SecondLawWatch {
 public:
  /// @param temperature_scale size of a typical temperature
  /// @param temperature_error what the temperatures to come may be off by
  SecondLawWatch(Scene<Dim>& scene, double temperature_scale, double temperature_error = 0.0);

  /// Takes a state of the run into account. Evaluates the scene there.
  void observe(double time, double const* temperature);

  SecondLaw const& result() const { return result_; }

 private:
  double measure_noise(double time, double const* temperature);
  bool is_noise() const;
  void stop(std::string const& why);
  void widen_range(double time);
  void watch_range(double time, double const* temperature);
  void watch_extrema(double time, double const* temperature);
  void watch_entropy(double time, double const* temperature);

  Scene<Dim>& scene_;
  double round_off_;
  double temperature_error_;
  double largest_ = 0.0;  ///< heating of the state that is looked at
  Number noise_;          ///< of the heating
  bool stopped_ = false;
  bool bounded_ = true;  ///< no wall brings heat by a prescribed flux
  double lowest_, highest_;
  std::vector<double> rate_;
  SecondLaw result_;
};

}  // namespace sphverify
