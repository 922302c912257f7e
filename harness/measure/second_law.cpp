// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/measure/second_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "formulations/basics/finite.hpp"
#include "reports/extremes.hpp"
#include "reports/second_law_watched.hpp"

namespace sphverify {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Coldest and hottest of what a particle feels.
struct Range {
  double lowest = infinity, highest = -infinity;

  void include(double value) { include(Range{value, value}); }
  void include(Range const& other) {
    lowest = smaller(lowest, other.lowest);
    highest = larger(highest, other.highest);
  }
};

template <int Dim>
bool brings_flux(Wall<Dim> const& wall, WallContacts<Dim> const& contacts, double time) {
  if (wall.temperature || !wall.flux) return false;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (!wall.flux(contacts.foot[c], time).isZero(0.0)) return true;
  }
  return false;
}

void keep_worse(Breach& worst, double size, double time, auto const& position) {
  if (size > worst.size) worst = {size, time, {position.begin(), position.end()}};
}

}  // namespace

template <int Dim>
SecondLawWatch<Dim>::SecondLawWatch(Scene<Dim>& scene, double temperature_scale, double temperature_error)
    : scene_(scene),
      round_off_(1e-12 * temperature_scale),
      temperature_error_(temperature_error),
      lowest_(infinity),
      highest_(-infinity),
      rate_(scene.particles().size()) {
  auto const& exact = scene_.problem().scalars.at(Field::temperature);
  for (std::size_t i = 0; i < rate_.size(); ++i) {
    double const T = exact(scene_.particles().positions()[i], 0.0);
    lowest_ = smaller(lowest_, T);
    highest_ = larger(highest_, T);
  }
}

/// What temperatures that are off by as much as they may be, every other one to the other side, change the
/// heating by at most.
template <int Dim>
double SecondLawWatch<Dim>::measure_noise(double time, double const* temperature) {
  std::size_t const n = rate_.size();
  std::vector<double> moved(temperature, temperature + n), moved_rate(n);
  for (std::size_t i = 0; i < n; ++i) moved[i] += (i % 2 == 0 ? 1.0 : -1.0) * temperature_error_;
  scene_.set_temperature(moved.data());
  scene_.evaluate(time);
  scene_.heating(time, moved_rate.data());
  double largest = 0.0;
  for (std::size_t i = 0; i < n; ++i) largest = larger(largest, std::abs(moved_rate[i] - rate_[i]));
  return largest;
}

template <int Dim>
bool SecondLawWatch<Dim>::is_noise() const {
  constexpr double clear = 100.0;
  return !(largest_ > clear * *noise_) || largest_ == 0.0;
}

template <int Dim>
void SecondLawWatch<Dim>::stop(std::string const& why) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  stopped_ = true;
  result_.overshoot = result_.undershoot = result_.cold_to_hot = {unknown, unknown, {}};
  result_.smallest_entropy_production.reset();
  result_.remark = why;
}

template <int Dim>
void SecondLawWatch<Dim>::observe(double time, double const* temperature) {
  if (stopped_) return;
  scene_.set_temperature(temperature);
  scene_.evaluate(time);
  scene_.heating(time, rate_.data());
  std::string const why = why_not_finite("heating", {rate_});
  if (!why.empty()) return stop(fmt::format("{} at t = {:.6g}", why, time));
  largest_ = 0.0;
  for (double const rate : rate_) largest_ = std::max(largest_, std::abs(rate));
  if (!noise_ || !scene_.problem().conducts_linearly()) {
    noise_ = measure_noise(time, temperature);
    scene_.set_temperature(temperature);
    scene_.evaluate(time);
  }
  ++result_.instants;
  widen_range(time);
  if (std::isnan(lowest_) || std::isnan(highest_))
    return stop(
        fmt::format("the temperature of a wall, or of the initial state, is not finite at t = {:.6g}", time));
  watch_range(time, temperature);
  watch_extrema(time, temperature);
  watch_entropy(time, temperature);
}

template <int Dim>
void SecondLawWatch<Dim>::widen_range(double time) {
  PairGeometry<Dim> const& geometry = scene_.geometry();
  for (std::size_t w = 0; w < geometry.contacts.size(); ++w) {
    Wall<Dim> const& wall = geometry.walls[w];
    WallContacts<Dim> const& contacts = geometry.contacts[w];
    if (brings_flux(wall, contacts, time)) {
      bounded_ = false;
      result_.remark = fmt::format("{}: temperatures have no bounds, entropy no balance", wall_brings_heat);
    }
    Range outside;
    if (wall.heat_loss) outside.include(wall.heat_loss->environment);
    for (std::size_t c = 0; wall.temperature && c < contacts.size(); ++c)
      outside.include(wall.temperature(contacts.foot[c], time));
    lowest_ = smaller(lowest_, outside.lowest);
    highest_ = larger(highest_, outside.highest);
  }
}

template <int Dim>
void SecondLawWatch<Dim>::watch_range(double time, double const* temperature) {
  double const range = highest_ - lowest_;
  if (!bounded_ || !(range > round_off_)) return;
  auto const& places = scene_.particles().positions();
  for (std::size_t i = 0; i < rate_.size(); ++i) {
    double const T = temperature[i];
    if (T > highest_ + round_off_) keep_worse(result_.overshoot, (T - highest_) / range, time, places[i]);
    if (T < lowest_ - round_off_) keep_worse(result_.undershoot, (lowest_ - T) / range, time, places[i]);
  }
}

template <int Dim>
void SecondLawWatch<Dim>::watch_extrema(double time, double const* temperature) {
  PairGeometry<Dim> const& geometry = scene_.geometry();
  std::size_t const n = rate_.size();
  std::vector<Range> around(n);
  for (std::size_t w = 0; w < geometry.contacts.size(); ++w) {
    Wall<Dim> const& wall = geometry.walls[w];
    WallContacts<Dim> const& contacts = geometry.contacts[w];
    bool const unbounded = brings_flux(wall, contacts, time);
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      if (unbounded) around[contacts.particle[c]].include(Range{-infinity, infinity});
      if (wall.temperature) around[contacts.particle[c]].include(wall.temperature(contacts.foot[c], time));
      if (wall.heat_loss) around[contacts.particle[c]].include(wall.heat_loss->environment);
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::uint32_t const j : geometry.neighbours.row(i)) around[i].include(temperature[j]);
  }
  // Behind a wall it feels what is made of others of the fluid.
  for (std::size_t w = 0; w < geometry.behind.size(); ++w) {
    WallParticles<Dim> const& behind = geometry.behind[w];
    std::size_t const contacts = behind.pairs.rows();
    for (std::size_t c = 0; c < contacts; ++c) {
      for (std::uint32_t const k : behind.pairs.row(c)) {
        for (auto const& [source, weight] : behind.placed[k - contacts].sources)
          around[geometry.contacts[w].particle[c]].include(temperature[source]);
      }
    }
  }
  // Forms of several passes feel their neighbours' neighbours.
  for (int pass = 1; pass < supports_seen(scene_.scheme()); ++pass) {
    std::vector<Range> const nearer = around;
    for (std::size_t i = 0; i < n; ++i) {
      for (std::uint32_t const j : geometry.neighbours.row(i)) around[i].include(nearer[j]);
    }
  }
  if (is_noise()) return;
  auto const& places = scene_.particles().positions();
  for (std::size_t i = 0; i < n; ++i) {
    // Strictly: between equals rounding decides.
    bool const hottest =
        temperature[i] >= around[i].highest && temperature[i] > around[i].lowest + round_off_;
    bool const coldest =
        temperature[i] <= around[i].lowest && temperature[i] < around[i].highest - round_off_;
    double const wrong = hottest ? rate_[i] : coldest ? -rate_[i] : 0.0;
    if (wrong > std::max(1e-10 * largest_, *noise_))
      keep_worse(result_.cold_to_hot, wrong / largest_, time, places[i]);
  }
}

template <int Dim>
void SecondLawWatch<Dim>::watch_entropy(double time, double const* temperature) {
  PairGeometry<Dim> const& geometry = scene_.geometry();
  auto const refuse = [&](char const* why) {
    result_.smallest_entropy_production.reset();
    if (result_.remark.empty()) result_.remark = fmt::format("{} needs {}", no_entropy, why);
  };
  if (!result_.remark.empty()) return refuse("");
  if (!scene_.exchange_is_known()) return refuse("what crosses the walls, which this form's wall terms do not tell");
  double production = 0.0;
  double turnover = 0.0;
  double largest_power = 0.0;  // of all that particles gain, beside which a wall's may be rounding
  for (std::size_t i = 0; i < rate_.size(); ++i) {
    if (!(temperature[i] > 0.0)) return refuse("temperatures above zero");
    double const gain = scene_.particles().masses()[i] * rate_[i] / temperature[i];
    production += gain;
    turnover += std::abs(gain);
    largest_power += std::abs(scene_.particles().masses()[i] * rate_[i]);
  }
  std::vector<double> const power = scene_.exchanged_power(scene_.prescribed_wall_power(time));
  for (std::size_t w = 0; w < geometry.contacts.size(); ++w) {
    if (std::abs(power[w]) <= 1e-14 * largest_power) continue;
    Wall<Dim> const& wall = geometry.walls[w];
    WallContacts<Dim> const& contacts = geometry.contacts[w];
    if (!wall.temperature) return refuse("the temperature of every wall that gives heat");
    Range range;
    for (std::size_t c = 0; c < contacts.size(); ++c) range.include(wall.temperature(contacts.foot[c], time));
    if (!(range.lowest > 0.0)) return refuse("temperatures above zero");
    if (range.highest - range.lowest > round_off_) return refuse("walls of one temperature each");
    production -= power[w] / range.lowest;
    turnover += std::abs(power[w]) / range.lowest;
  }
  if (is_noise() || !(turnover > 0.0)) return;
  double const relative = production / turnover;
  if (!result_.smallest_entropy_production || relative < *result_.smallest_entropy_production)
    result_.smallest_entropy_production = relative;
}

template class SecondLawWatch<1>;
template class SecondLawWatch<2>;
template class SecondLawWatch<3>;

}  // namespace sphverify
