// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/run/gas_stability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "harness/integrate/ode.hpp"
#include "harness/measure/mode_shape.hpp"
#include "harness/measure/spectrum.hpp"

namespace sphverify {

namespace {

/// Part of a typical unknown (of the spacing, for places) by which each is moved for a difference. The
/// kernel's third derivative jumps where its pieces meet, and lattices have particles there: the error of a
/// difference is of first order. It meets that of rounding at about this size.
constexpr double jacobian_difference = 1e-7;

template <int Dim>
class GasModes {
 public:
  GasModes(Problem<Dim> const& problem, SceneChoice const& choice)
      : scene_(problem, choice),
        state_(scene_.initial_state()),
        sizes_(scene_.scales()),
        origin_(state_.size()) {
    std::fill_n(sizes_.begin(), scene_.coordinates(), scene_.spacing());
    rate(state_, origin_);
  }

  std::size_t size() const { return state_.size(); }
  MovingScene<Dim>& scene() { return scene_; }

  /// How far the state is from standing still, as accelerations go: |a| dx/c^2, at worst.
  double unrest() const {
    double largest = 0.0;
    std::size_t const n = scene_.coordinates();
    double const speed = sizes_[n];
    for (std::size_t k = 0; k < n; ++k) largest = std::max(largest, std::abs(origin_[n + k]));
    return largest * scene_.spacing() / (speed * speed);
  }

  /// @param part of its size by which each unknown is moved
  Eigen::MatrixXd jacobian(double part, std::function<bool()> const& out_of_time) {
    auto const n = static_cast<Eigen::Index>(size());
    Eigen::MatrixXd matrix(n, n);
    std::vector<double> y = state_;
    std::vector<double> above(size()), below(size());
    for (std::size_t k = 0; k < size(); ++k) {
      if (out_of_time()) return {};
      double const step = part * sizes_[k];
      y[k] = state_[k] + step;
      rate(y, above);
      y[k] = state_[k] - step;
      rate(y, below);
      y[k] = state_[k];
      for (std::size_t i = 0; i < size(); ++i) {
        // In units of typical sizes, so that a matrix of mixed units is balanced; eigenvalues do not mind.
        matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
            (above[i] - below[i]) / (2.0 * step) * sizes_[k] / sizes_[i];
      }
    }
    return matrix;
  }

  /// Whether leapfrog keeps small perturbations small.
  bool keeps(double dt, std::function<bool()> const& out_of_time) {
    constexpr std::uint64_t steps = 2000;
    constexpr double growth_of_no_return = 1e3;
    std::size_t const n = scene_.coordinates();
    std::vector<double> y = state_;
    std::mt19937_64 random(1);
    for (std::size_t k = 0; k < n; ++k)
      y[k] += 1e-7 * sizes_[k] * (2.0 * static_cast<double>(random() >> 11) * 0x1p-53 - 1.0);
    OdeSystem system;
    system.size = size();
    double first = 0.0;
    std::uint64_t step = 0;
    system.monitor = [&](double, double const* state, double const*) -> std::string {
      double largest = 0.0;
      for (std::size_t k = n; k < 2 * n; ++k) largest = std::max(largest, std::abs(state[k]));
      if (!std::isfinite(largest)) return "not finite";
      // The perturbation of places needs a while to show in velocities.
      if (++step <= 20) first = std::max(first, largest);
      if (step > 20 && largest > growth_of_no_return * first) return "grew";
      return out_of_time() ? "out of time" : "";
    };
    OdeResult const result =
        integrate_leapfrog(system, std::move(y), static_cast<double>(steps) * dt,
                           {.coordinates = n,
                            .impulses = 0,
                            .rate =
                                [this](double, double const* state, double* dydt) {
                                  scene_.evaluate(0.0, state, dydt);
                                  scene_.rates(dydt);
                                },
                            .drift =
                                [this](double, double const* state, double const* velocities, double* rates) {
                                  scene_.drift(state, velocities);
                                  scene_.drift_rates(rates);
                                },
                            .largest_step = [dt](double) { return dt; },
                            .smallest_step = 0.0,
                            .most_steps = 2 * steps,
                            .threads = scene_.threads()});
    return result.outcome == OdeOutcome::finished;
  }

 private:
  void rate(std::vector<double> const& y, std::vector<double>& out) {
    scene_.evaluate(0.0, y.data());
    scene_.rates(out.data());
  }

  MovingScene<Dim> scene_;
  std::vector<double> state_;
  std::vector<double> sizes_;
  std::vector<double> origin_;
};

template <int Dim>
Number measured_leapfrog_step(GasModes<Dim>& gas, double guess, std::function<bool()> const& out_of_time) {
  double low = 0.5 * guess;
  double high = 2.0 * guess;
  auto const keeps = [&](double dt) {
    try {
      return gas.keeps(dt, out_of_time);
    } catch (BrokenRun const&) {
      return false;
    }
  };
  if (!keeps(low) || keeps(high)) return std::nullopt;
  while (high > 1.005 * low && !out_of_time()) {
    double const middle = 0.5 * (low + high);
    (keeps(middle) ? low : high) = middle;
  }
  return out_of_time() ? std::nullopt : Number(low);
}

}  // namespace

template <int Dim>
Stability gas_stability(Problem<Dim> const& problem, SceneChoice const& choice, bool with_modes,
                        bool measure_step, std::function<bool()> const& out_of_time) {
  Stability stability;
  GasModes<Dim> gas(problem, choice);
  if (gas.size() > 2 * largest_dense_spectrum) {
    stability.remark = fmt::format("not computed for more than {} unknowns: found {}",
                                   2 * largest_dense_spectrum, gas.size());
    return stability;
  }
  Eigen::MatrixXd const jacobian = gas.jacobian(jacobian_difference, out_of_time);
  Eigen::MatrixXd const coarser = gas.jacobian(3.0 * jacobian_difference, out_of_time);
  if (jacobian.size() == 0 || coarser.size() == 0) {
    stability.remark = "the time budget was spent";
    return stability;
  }
  double const jacobian_error = (jacobian - coarser).norm() / jacobian.norm();
  Spectrum const found = dense_spectrum(jacobian, jacobian_error);
  MovingScene<Dim>& scene = gas.scene();
  auto const shape = [&](std::size_t k) {
    // The places' part of a mode says where it is; a mode of energies and densities alone has none.
    return mode_shape<Dim>(found.eigenvalues[k],
                           found.modes[k].head(static_cast<Eigen::Index>(scene.coordinates())),
                           scene.particles(), problem.domain, scene.walls(), scene.spacing());
  };
  stability = stability_of(found);
  if (found.eigenvalues.empty()) return stability;
  // Neither is of interest here: no explicit method but leapfrog moves a gas, and density and energy that
  // change together leave its rate as it is.
  stability.largest_stable_step.reset();
  stability.unseen_modes.reset();
  if (stability.growing_modes) stability.remark.clear();
  if (stability.spectral_abscissa) stability.worst_mode = shape(0);
  double fastest = 0.0;
  double doubtful = 0.0;
  for (std::size_t k = 0; k < found.eigenvalues.size(); ++k) {
    double const frequency = std::abs(found.eigenvalues[k].imag());
    double& kind = frequency > found.uncertainty[k] ? fastest : doubtful;
    kind = std::max(kind, frequency);
  }
  if (with_modes) {
    for (std::size_t k = 0; k < found.eigenvalues.size(); ++k) stability.modes.push_back(shape(k));
  }
  if (double const unrest = gas.unrest(); unrest > 1e-6) {
    if (!stability.remark.empty()) stability.remark += "; ";
    stability.remark += fmt::format("the initial state does not stand still: |a| dx/c^2 is {:.2g}", unrest);
  }
  StableStep& leapfrog = stability.stable_steps["leapfrog"];
  if (stability.growing_modes.value_or(0) > 0) {
    leapfrog.remark = "no step is stable: a mode grows";
  } else if (doubtful > fastest) {
    leapfrog.remark = "the fastest mode is not known well enough";
  } else if (fastest > 0.0) {
    leapfrog.theory = 2.0 / fastest;
    if (measure_step) {
      leapfrog.measured = measured_leapfrog_step(gas, *leapfrog.theory, out_of_time);
      if (!leapfrog.measured) {
        leapfrog.remark = "no step between half and twice that of theory separates stable from unstable";
      }
    }
  } else {
    leapfrog.remark = "any step is stable: no mode oscillates";
  }
  return stability;
}

#define SPHVERIFY_INSTANTIATE(Dim)                                                      \
  template Stability gas_stability(Problem<Dim> const&, SceneChoice const&, bool, bool, \
                                   std::function<bool()> const&);
SPHVERIFY_INSTANTIATE(1)
SPHVERIFY_INSTANTIATE(2)
SPHVERIFY_INSTANTIATE(3)
#undef SPHVERIFY_INSTANTIATE

}  // namespace sphverify
