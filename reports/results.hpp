// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cases/support/parameters.hpp"
#include "reports/error_surface.hpp"

namespace sphverify {

/// The results document as structs (contract: sphverify-results/1). A number that does not exist is an empty
/// optional, and `null` in JSON; there are no NaN.
using Number = std::optional<double>;

/// What was run on what: opens every results document.
struct Context {
  std::string version, commit, compiler, flags, processor, date;
  int cores = 0;
  std::string program = "sphverify";  ///< what wrote the results
  std::vector<std::string> added{};   ///< identifiers of its parts that are not ours
  std::string machine{};              ///< names the machine without saying which it is; empty: not known
};

struct LayoutChoice {
  std::string id;          ///< lattice, jittered, glass, random, ...
  double amplitude = 0.0;  ///< of the displacement; of clumped the separation, of touching the gap; [dx]
  std::uint64_t seed = 0;  ///< of a layout that is drawn by lot
  bool voronoi_masses = false;  ///< masses are density times the Voronoi cells' volumes, not the layout's own
  bool operator==(LayoutChoice const&) const = default;
};

/// Whether a seed decides where particles are.
inline bool is_drawn(LayoutChoice const& layout) {
  return layout.id == "jittered" || layout.id == "glass" || layout.id == "random";
}

/// Artificial viscosity: Monaghan's, both coefficients 0: off; or that of Riemann problems, which has none.
struct ViscosityChoice {
  double alpha = 0.0, beta = 0.0;
  bool riemann = false;
  bool operator==(ViscosityChoice const&) const = default;
};

struct Discretisation {
  std::string kernel = "cubic-spline";
  std::string density = "given";
  double smoothing_ratio = 1.2;  ///< nominal h/dx, at the first resolution
  LayoutChoice layout{"lattice"};
  std::string face_weight = "exact";
  std::string closure = "interpolated";
  std::string integrator = "bdf";
  std::string smoothing = "uniform";  ///< one smoothing length for all, or `adaptive`: from the density
  std::string wall_motion = "velocity";
  ViscosityChoice viscosity;
  std::string pair_weight = "kernel";
  bool operator==(Discretisation const&) const = default;
};

/// What stands for the walls of a scene: a formulation's own wall terms, nothing, or particles behind them.
struct WallChoice {
  std::string word = "on";  ///< on, off, or the identifier of a treatment (formulations/wall_particles)

  WallChoice() = default;
  WallChoice(bool own_terms) : word(own_terms ? "on" : "off") {}
  explicit WallChoice(std::string named) : word(std::move(named)) {}

  /// Whether anything stands for them.
  operator bool() const { return word != "off"; }
  bool are_terms() const { return word == "on"; }
  bool operator==(WallChoice const&) const = default;
};

/// A formulation as a study names it.
struct FormulationChoice {
  std::string id;
  std::string work, conduction;  ///< partners of a momentum form; empty: none
  WallChoice walls;
  bool operator==(FormulationChoice const&) const = default;
};

struct NormSet {
  double l1 = 0.0, l2 = 0.0, linf = 0.0;
};

/// Error of a field in a region, the same norms of the exact field, and the error that rounding alone
/// explains.
struct RegionError {
  NormSet error;
  NormSet scale;
  double round_off = 0.0;
  std::optional<NormSet>
      initial{};  ///< the error if the initial state were the answer: what doing nothing scores
  Number mean{};  ///< weighted mean of computed - exact, with its sign; of scalar fields
  std::optional<NormSet> allowed{};  ///< highest orders that features of the exact solution in the region
                                     ///< permit; empty: there are none
};

/// region -> error; a region without particles is absent.
using FieldErrors = std::map<std::string, RegionError>;

/// Budget of one conserved quantity.
struct Budget {
  double initial = 0.0, final = 0.0;
  double exchanged = 0.0;     ///< through walls and sources, by the scheme; NaN: not known
  double drift = 0.0;         ///< final - initial - exchanged: what pairs and time stepping created; NaN likewise
  Number pair_drift;          ///< of it, what the pairs created
  Number wall_budget_defect;  ///< what crossed the walls less what their prescribed values say
};

struct WallFlux {
  double measured = 0.0;  ///< at the final time, per area, positive inward
  double exact = 0.0;
  double error = 0.0;  ///< measured - exact
  double scale = 0.0;  ///< largest exact flux along the wall's normal anywhere in the domain at that time
};

/// Median of repeated timings, and the 95% interval of it where there are enough of them [s].
struct MedianSeconds {
  Number median, low, high;
};

struct Cost {
  double seconds = 0.0;        ///< wall time of set-up and run, minimum over the repeats
  Number cpu_seconds;          ///< processor time of the same repeat; empty with several threads
  double setup_seconds = 0.0;  ///< of it, before the first step
  MedianSeconds median{};      ///< of the wall time of all repeats
  Number busy{};               ///< processor time over wall time of all repeats; empty with several threads
  int repeats = 0;
  int batch = 1;         ///< runs timed together as one repeat, whose time is divided by their number
  bool warm_up = false;  ///< whether the same was run before the first repeat
  std::string machine;   ///< where it was timed, as Context names it; empty: not known
  std::string occasion;  ///< names the rounds in which this and other runs took turns; empty: timed alone
  std::vector<double> round_seconds;  ///< wall time of the repeat of each round, in their order [s]
  std::uint64_t steps = 0, rate_evaluations = 0, pair_interactions = 0;
  std::uint64_t peak_bytes = 0;  ///< 0: not known

  /// Whether steps, evaluations, pairs and the time of the set-up are known: not of a code that is not ours.
  bool is_counted() const { return rate_evaluations > 0; }
};

/// A mode of a linearised rate, and where and how short it is.
struct Mode {
  double growth = 0.0, frequency = 0.0;  ///< real and imaginary part of its eigenvalue [1/s]
  Number wavelength;                     ///< [dx]; empty for a mode that is the same everywhere
  Number wall_share;                     ///< part of its squared amplitude within the support of a wall
  std::vector<double> centre;            ///< of its squared amplitude [m]
};

/// The longest step that a method can take for ever.
struct StableStep {
  Number theory;       ///< from the spectrum and the method's stability polynomial [s]
  Number measured;     ///< by bisection on steps of the method itself [s]; empty unless asked for
  std::string remark;  ///< why a number is missing
};

struct Stability {
  Number spectral_abscissa;     ///< largest real part of an eigenvalue of the linearised rate [1/s]
  Number abscissa_uncertainty;  ///< how far off that may be, by rounding and what the matrix is off [1/s]
  Number spectral_radius;       ///< largest modulus [1/s]
  Number largest_imaginary;     ///< largest imaginary part [1/s]
  Number largest_stable_step;   ///< of explicit Euler by theory [s]; empty where a mode grows
  std::optional<std::uint64_t> growing_modes;
  std::optional<std::uint64_t> unseen_modes;  ///< dimension of the rate's kernel: what it does not see
  std::string method;                         ///< `dense`, or `arnoldi` for few eigenvalues of many
  std::optional<Mode> worst_mode;             ///< the one of the largest real part
  std::map<std::string, StableStep> stable_steps;
  std::vector<Mode> modes;  ///< all, of a gas about rest; only if the spectrum is asked for
  std::string remark;       ///< why a number is missing
};

/// Where the second law, or the maximum principle that follows from it, was broken most.
struct Breach {
  double size = 0.0;
  double time = 0.0;             ///< [s]
  std::vector<double> position;  ///< of the particle [m]
};

/// Whether heat conduction without sources kept the second law.
struct SecondLaw {
  /// Largest excess of a temperature above, or below, all that the initial state and the walls held till
  /// then, relative to their range.
  Breach overshoot, undershoot;
  /// Largest heating of a particle that was at least as hot as all around it (or cooling of one at most as
  /// warm), as a part of the largest heating anywhere at the time: heat that flowed from cold to hot.
  Breach cold_to_hot;
  Number smallest_entropy_production;  ///< relative to sum m |q|/T at the time; empty if a wall's temperature
                                       ///< is not known
  std::string remark;                  ///< why a number is missing
  std::uint64_t instants = 0;          ///< at which the run was looked at: all of the above is of these
};

/// How time was integrated and what of the error is its fault.
struct Integration {
  std::string method;
  Number relative_tolerance, absolute_tolerance;  ///< of an adaptive method
  Number courant_factor;    ///< of a method that steps within limits: part of the usual limits
  Number time_error;        ///< l2 norm of the change of the leading field when the tolerance is tightened a
                            ///< hundredfold, or the step halved
  Number time_error_share;  ///< the largest ratio of that change to the space error, over regions and norms
  std::string remark{};     ///< why these two are missing, or what limits what they say
};

/// What crossed a wall in the scheme, what its prescribed values (a closure's in their place) say, over the
/// run.
struct WallBudget {
  std::vector<double> position;                     ///< of the wall's point at the final time [m]
  std::vector<double> impulse, prescribed_impulse;  ///< given to the gas, by axis
  double energy = 0.0, prescribed_energy = 0.0;     ///< given to the gas, as work and heat
  double heat = 0.0;                                ///< of it, by conduction
};

/// A shock measured as one.
struct ShockRecord {
  double position = 0.0;    ///< exact [m]
  Number position_error;    ///< where the pressure crosses the middle of the jump, less the exact place [m]
  Number plateau_pressure;  ///< relative error of the mean over the middle of the plateau behind it
  Number plateau_density;   ///< likewise
  Number plateau_velocity;  ///< likewise, absolute [m/s]
};

/// How a gas moved.
struct Motion {
  std::map<std::string, std::uint64_t> steps_bound_by;  ///< step limit -> steps that it bound
  Number smallest_step, largest_step;                   ///< [s]
  double lowest_density = 0.0, lowest_pressure = 0.0;   ///< of any particle after any step
  Number volume_defect;  ///< volume between the walls less the sum of m/rho, as a part of that sum; none
                         ///< without walls all round
  Number wall_heating;   ///< relative error of the internal energy nearest a wall, the largest; at shocks
  Number energy_routes;  ///< l2 difference of internal energy to the same run with the other work form,
                         ///< relative to its l2 norm; if asked for
};

/// Fields along the particles at the final time (of rates, at the one time that there is), with all that the
/// errors are taken from.
struct Profile {
  std::vector<std::vector<double>> position;
  std::vector<double> weight;                                 ///< V_i of the norms [m^Dim], not normalised
  std::map<std::string, std::vector<std::uint64_t>> regions;  ///< whose errors are taken: particles, by index
  std::map<std::string, std::vector<std::vector<double>>> computed, exact;  ///< one list per particle
};

/// Budgets over time.
struct History {
  std::vector<double> time, energy, exchanged;
  std::vector<double> momentum;  ///< along the first axis, of a moving gas
  std::vector<std::vector<double>> wall_impulse_defect, wall_energy_defect;  ///< per wall, over time
};

/// What was allocated and what ran, by the scene itself.
struct SceneRecord {
  std::vector<std::string> fields;
  std::map<std::string, std::uint64_t> passes;  ///< name -> times that it ran
};

struct RunRecord {
  std::string case_id;
  std::map<std::string, ParameterValue> parameters;
  FormulationChoice formulation;
  std::string label;
  Discretisation discretisation;
  double smoothing_exponent = 0.0;
  int resolution = 0;
  std::size_t particles = 0;
  double spacing = 0.0, smoothing_length = 0.0;
  std::string status = "ok";
  std::string reason;
  std::string output;                ///< end of what a code that is not ours printed
  std::vector<std::string> remarks;  ///< what a reader of the numbers should know of how the run was set up
  SceneRecord scene;
  std::map<std::string, FieldErrors> errors;
  std::map<std::string, Budget> conservation;  ///< mass and energy: those that exist
  std::vector<Budget> momentum;                ///< by axis, of a moving gas
  std::vector<WallBudget> wall_budgets;        ///< of a moving gas
  std::vector<ShockRecord> shocks;
  std::optional<Motion> motion;
  std::vector<WallFlux> wall_flux;
  std::optional<Cost> cost;
  std::optional<Stability> stability;
  std::optional<SecondLaw> second_law;
  std::optional<Integration> integration;
  std::optional<Number> smallest_face_weight;  ///< reported for `balanced`
  std::optional<Profile> profile;
  std::optional<History> history;
  std::vector<std::vector<double>> spectrum;  ///< [real, imaginary] per eigenvalue; empty unless asked for
};

/// What an error tends to as the spacing goes to 0, with its 95% interval, in the unit of the error.
struct ErrorFloor {
  double value = 0.0, lower = 0.0, upper = 0.0;
};

/// The fitted law of an error, F + A d^p (1 + c d^q), d the spacing in units of the finest level's.
struct ErrorLaw {
  double floor = 0.0;             ///< F, in the unit of the error
  double coefficient = 0.0;       ///< A, likewise
  double exponent = 0.0;          ///< p
  double next_coefficient = 0.0;  ///< c
  double next_exponent = 1.0;     ///< q
};

/// Where the fitted law comes down to an error.
struct TargetResolution {
  double error = 0.0;
  Number relative;    ///< the error over the exact field's norm, where that is known
  Number resolution;  ///< particles along the first axis (of `spacing` ladders: 1/spacing); empty: see remark
  std::string
      remark;  ///< why there is none (never, or not known), or that it lies beyond the levels that were run
};

/// An observed order with its 95% interval. Order, interval and floor are empty where the data cannot say.
struct ObservedOrder {
  Number order, lower, upper;
  std::vector<Number> pairwise;  ///< between neighbouring levels
  std::string verdict;
  std::string reason;  ///< for the verdict, in words
  std::string model;   ///< which law explains the levels best; empty: none does
  std::optional<ErrorLaw> law;
  std::optional<ErrorFloor> floor;
  std::vector<TargetResolution> targets;
};

/// One level of a ladder: a resolution, its replicates merged.
struct SeriesLevel {
  int resolution = 0;
  double spacing = 0.0;
  int replicates = 0;
  Number error;   ///< mean over the replicates
  Number spread;  ///< their standard deviation; empty for fewer than two
  Number seconds;
  MedianSeconds median{};  ///< means over the replicates
  Number mean{};  ///< of computed - exact, with its sign, over region and replicates; of scalar fields
};

struct OrderEntry {
  std::string field, region, norm;
  double allowed = 2.0;  ///< highest order that the solution allows in this norm
  ObservedOrder observed;
  std::vector<SeriesLevel> levels;
};

struct TimeToError {
  std::string field, region, norm;
  double relative = 0.0;  ///< target relative to the exact field's norm
  double error = 0.0;     ///< target, absolute
  Number seconds;
  bool is_bound = false;   ///< the coarsest level reached it already: an upper bound
  MedianSeconds median{};  ///< the same of the medians and of the ends of their intervals
};

/// Runs that differ only in resolution (and in the seed of a layout that is drawn by lot).
struct Series {
  std::string case_id, label;
  std::map<std::string, ParameterValue> parameters;
  FormulationChoice formulation;
  Discretisation discretisation;  ///< of the first run
  double smoothing_exponent = 0.0;
  std::vector<std::size_t> runs;  ///< indices into Results::runs
  bool discontinuous = false;     ///< the exact solution jumps
  bool is_timed_apart = false;    ///< runs of the study were timed on several machines: it has no times
  std::vector<OrderEntry> orders;
  std::vector<TimeToError> time_to_error;
};

/// Runs that differ only in resolution and h/dx (and in the seed of a layout that is drawn by lot).
struct Surface {
  std::string case_id, label;
  std::map<std::string, ParameterValue> parameters;
  FormulationChoice formulation;
  Discretisation discretisation;  ///< of the first run; its h/dx means nothing
  ErrorSurface error;
};

struct Skipped {
  std::string case_id, formulation, reason;
};

/// How far a parameter can be driven before a run breaks.
struct Envelope {
  struct Point {
    double value;
    std::string status;
  };
  std::string case_id, label, parameter;
  std::map<std::string, ParameterValue> parameters;  ///< the others
  FormulationChoice formulation;
  Discretisation discretisation;
  int resolution = 0;
  bool logarithmic = false;
  Number held, failed;         ///< the last value that held and the first that failed, as near as was tried
  std::string status, reason;  ///< of the failure
  std::vector<Point> points;   ///< as tried
};

/// What one machine did of a study that several shared.
struct Share {
  Context context;
  std::size_t runs = 0;
};

/// The whole document. The study is kept as it was run, defaults filled in, in the form of the document.
struct Results {
  Context context;
  std::string study;  ///< JSON text
  /// Of a part, which runs of the study it holds (of an envelope, which searches), as `expand` counts them;
  /// empty: all. A part has no series.
  std::optional<std::vector<std::size_t>> part{};
  std::vector<Share> shares{};  ///< of what was merged from parts, in their order
  std::vector<RunRecord> runs;
  std::vector<Series> series;
  std::vector<Surface> surfaces;
  std::vector<Skipped> skipped;
  std::vector<Envelope> envelopes;
};

}  // namespace sphverify
