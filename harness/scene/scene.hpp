// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "cases/support/problem.hpp"
#include "formulations/density/density.hpp"
#include "formulations/rate_operator.hpp"
#include "formulations/layouts/layout.hpp"
#include "harness/scene/cut_cells.hpp"
#include "reports/results.hpp"

namespace sphverify {

/// What a scene is built from, besides the problem.
struct SceneChoice {
  std::string formulation;
  std::string work{}, conduction{};  ///< partners of a momentum form; empty: none
  WallChoice walls;
  Discretisation discretisation;
  int resolution = 0;
  double smoothing_ratio = 0.0;  ///< h/dx at this resolution
  int threads = 1;
};

/// Particles that stand still, set up for one formulation on one problem: it holds only the fields and runs
/// only the passes that the two need, and counts them.
template <int Dim>
class Scene {
 public:
  /// Throws std::invalid_argument when the particles or walls make no sense.
  Scene(Problem<Dim> problem, SceneChoice const& choice);

  Problem<Dim> const& problem() const { return problem_; }
  SchemeInfo const& scheme() const { return operator_->info(); }
  Particles<Dim> const& particles() const { return particles_; }
  PairGeometry<Dim> const& geometry() const { return geometry_; }
  double spacing() const { return spacing_; }

  /// Sets the temperature, and the conductivity where it depends on it.
  void set_temperature(double const* temperature);

  /// Promises that from now on only temperatures change, so that pairs of a linear form are computed once.
  void freeze();

  /// Evaluates the scheme's rate on the particles' fields at a time.
  void evaluate(double time);

  /// Rate of the scheme plus the case's source, for conduction: dT/dt. Expects an `evaluate` at the same
  /// time.
  void heating(double time, double* out);

  /// Power that each wall gave in the last evaluation [W], in the order of the problem's walls; zeros without
  /// wall terms.
  std::vector<double> wall_power() const;
  std::vector<Vector<Dim>> wall_force() const;

  /// Power that each wall's prescribed flux, or the closure's where it prescribes none, says [W]; empty where
  /// the scheme knows of no flux there.
  std::vector<Number> prescribed_wall_power(double time);

  /// Power that crosses each wall [W]: by the wall terms, or where these are not what crosses it, as `prescribed`
  /// (prescribed_wall_power) has it; means nothing where `exchange_is_known` is false.
  std::vector<double> exchanged_power(std::vector<Number> const& prescribed) const;
  bool exchange_is_known() const;

  /// Power of the scheme's whole rate in the last evaluation [W]: walls and what the pairs fail to balance.
  double scheme_power() const;

  /// Power of the case's source [W].
  double source_power(double time);

  /// Area of each wall [m^(Dim-1)]: the product of the domain's extents along it.
  std::vector<double> wall_areas() const;

  WorkCount const& work() const { return work_; }
  SceneRecord record() const;
  int threads() const { return threads_; }
  std::size_t bytes() const { return particles_.bytes() + geometry_.bytes() + operator_->bytes(); }

 private:
  void place_particles(SceneChoice const& choice);
  void find_geometry(SceneChoice const& choice);
  void set_density(DensityRule rule, CellGrid<Dim> const& grid, std::vector<double> const& cells);
  void set_fields();
  void set_conductivity();

  Problem<Dim> problem_;
  std::unique_ptr<RateOperator<Dim>> operator_;
  Particles<Dim> particles_;
  PairGeometry<Dim> geometry_;
  std::vector<CutCell<Dim>> cut_cells_;  ///< by jumps of what they are made of
  Closure closure_;
  bool is_frozen_ = false;  ///< first passes have run once and for all
  double spacing_ = 0.0;
  int threads_;
  WorkCount work_;
  std::map<std::string_view, std::uint64_t> passes_;
};

extern template class Scene<1>;
extern template class Scene<2>;
extern template class Scene<3>;

}  // namespace sphverify
