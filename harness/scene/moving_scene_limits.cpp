// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/scene/moving_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "formulations/basics/parallel.hpp"
#include "formulations/sweep/approach.hpp"
#include "harness/scene/kernel_damping.hpp"

// How long a step may be, and what must not happen within one.

namespace sphverify {

namespace {

/// Part of the time in which sound, or what else limits a step, crosses a smoothing length (Monaghan, Annu.
/// Rev. Astron. Astrophys. 30 (1992) 543, section 10).
constexpr double courant_number = 0.3;

}  // namespace

template <int Dim>
std::vector<StepLimit> MovingScene<Dim>::step_limits() const {
  struct Limits {
    double courant, force, viscosity, conduction, approach;
  };
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr Limits none{infinity, infinity, infinity, infinity, 0.0};
  auto const join = [](Limits& all, Limits const& part) {
    all.courant = std::min(all.courant, part.courant);
    all.force = std::min(all.force, part.force);
    all.viscosity = std::min(all.viscosity, part.viscosity);
    all.conduction = std::min(all.conduction, part.conduction);
    all.approach = std::max(all.approach, part.approach);
  };
  SmoothingLength const h(particles_);
  auto const& c = particles_.scalar(Field::sound_speed);
  auto const& v = particles_.vector(Field::velocity);
  double const damping = kernel_damping(particles_.kernel());
  Limits limit = joined_blocks(
      particles_.size(), threads_, none,
      [&](std::size_t begin, std::size_t end) {
        Limits part = none;
        for (std::size_t i = begin; i < end; ++i) {
          part.courant = std::min(part.courant, h(i) / c[i]);
          part.force = std::min(part.force, std::sqrt(h(i) / acceleration_[i].norm()));
          if (is_on(viscosity_)) {
            double const mu = viscous_.largest_mu[i];
            // What of the viscous pressure over density changes with mu, so that h/(damping drag) is where an explicit step
            // would turn stable damping into growth; of one that damps alone that is the step.
            double const drag = std::visit([&](auto const& law) { return law.linear() * c[i] + 2.0 * law.quadratic() * mu; }, viscosity_);
            part.viscosity = std::min(part.viscosity, h(i) / (c[i] + courant_number * damping * drag));
            if (!geometry().neighbours.slope.empty()) part.viscosity = std::min(part.viscosity, viscous_step_of_weights(i, mu));
          }
          if (conduction_operator_) part.conduction = std::min(part.conduction, conduction_step(i));
        }
        return part;
      },
      join);
  limit.approach = largest_approach();
  for (auto const& contacts : geometry().contacts) {
    join(limit, joined_blocks(
                    contacts.size(), threads_, none,
                    [&](std::size_t begin, std::size_t end) {
                      Limits part = none;
                      for (std::size_t k = begin; k < end; ++k) {
                        std::uint32_t const i = contacts.particle[k];
                        double const closing = (v[i] - contacts.velocity[k]).dot(contacts.outward_normal);
                        // What a wall that leaves takes along with it, its pressure and the density's wall term, fades over h.
                        part.approach = std::max(part.approach, closing > 0.0 ? closing / contacts.distance[k] : -closing / h(i));
                        if (!conduction_operator_) continue;
                        double const K = particles_.scalar(Field::conductivity)[i];
                        part.conduction =
                            std::min(part.conduction, contacts.distance[k] * particles_.scalar(Field::density)[i] /
                                                          (4.0 * K * contacts.face_weight[k]));
                      }
                      return part;
                    },
                    join));
  }
  std::vector<StepLimit> limits{{"courant", limit.courant}, {"force", limit.force}, {"approach", 1.0 / limit.approach}};
  if (is_on(viscosity_)) limits.push_back({"viscosity", limit.viscosity});
  if (conduction_operator_) limits.push_back({"conduction", limit.conduction});
  if (reads_face_offsets(momentum_operator_->info())) limits.push_back({"cells", cells_step()});
  for (StepLimit& one : limits) one.step *= courant_number;
  return limits;
}

/// The largest rate_of_approach() of two particles. Viscosity's pairs have found it where these are measured alike: beyond one
/// dimension Monaghan's mu is h times that rate. What stands behind walls is none of them.  [1/s]
template <int Dim>
double MovingScene<Dim>::largest_approach() const {
  SmoothingLength const h(particles_);
  auto const largest = [&](std::vector<double> const& values) {
    return joined_blocks(
        values.size(), threads_, 0.0,
        [&](std::size_t begin, std::size_t end) {
          double most = 0.0;
          for (std::size_t i = begin; i < end; ++i) most = std::max(most, values[i]);
          return most;
        },
        [](double& all, double part) { all = std::max(all, part); });
  };
  bool const is_monaghan = std::holds_alternative<MonaghanViscosity>(viscosity_) && is_on(viscosity_);
  if (Dim > 1 && is_monaghan && h.is_uniform() && geometry().behind.empty())
    return largest(viscous_.largest_mu) / h(0);
  std::vector<double> rates_of_approach(particles_.size());
  PairSweep<Dim> sweep(geometry().neighbours, geometry().domain, threads_);
  sweep.add(loops_of_sweep<Dim>().approach, {Field::velocity}, {}, rates_of_approach);
  sweep.run(particles_);
  return largest(rates_of_approach);
}

/// Where pairs have weights of their own, which a smoothing length says nothing of: two over the sum of the rates at which
/// pairs damp the particle's velocity, m_j |R_ij| r^2 |dPi/dmu| dmu/d(v_ij.r_ij). Twice that sum is Gershgorin's bound.  [s]
template <int Dim>
double MovingScene<Dim>::viscous_step_of_weights(std::size_t i, double largest_mu) const {
  SmoothingLength const h(particles_);
  auto const& x = particles_.positions();
  auto const& c = particles_.scalar(Field::sound_speed);
  auto const& rho = particles_.scalar(Field::density);
  NeighbourList const& list = geometry().neighbours;
  double sum = 0.0;
  for (std::size_t k = list.first[i]; k < list.first[i + 1]; ++k) {
    std::size_t const j = list.neighbour[k];
    double const squared = problem_.domain.nearest_image(x[i] - x[j]).squaredNorm();
    double const sound = 0.5 * (c[i] + c[j]);
    double const density = 0.5 * (rho[i] + rho[j]);
    double const per_mu = std::visit(
        [&]<class Law>(Law const& law) {
          double const mu = law.pair(-1.0, h(i, j), sound, density, Law::divisor(squared, h(i, j), density)).mu;
          return (law.linear() * sound + 2.0 * law.quadratic() * largest_mu) * -mu / density;
        },
        viscosity_);
    sum -= particles_.masses()[j] * list.slope[k] * squared * per_mu;
  }
  return 2.0 / sum;
}

/// Three over a bound of the largest frequency about rest of a gas whose energy is that of its cells' volumes. Its square is
/// the largest eigenvalue of B^T B, B_ij = (c_i/V_i) sqrt(m_i/m_j) |dV_i/dr_j|, and no larger than the largest sum of a row of B
/// times the largest of a column. A face turns about its pair as fast as the pair is short, which no smoothing length knows.  [s]
template <int Dim>
double MovingScene<Dim>::cells_step() const {
  auto const& x = particles_.positions();
  auto const& m = particles_.masses();
  auto const& c = particles_.scalar(Field::sound_speed);
  auto const& rho = particles_.scalar(Field::density);
  NeighbourList const& list = geometry().neighbours;
  std::vector<double> of_row(x.size()), of_column(x.size());
  for_each_row(x.size(), threads_, [&](std::size_t i) {
    double row = 0.0, column = 0.0;
    Vector<Dim> own = Vector<Dim>::Zero();  // dV_i/dr_i/V_i, and as a column's
    for (std::size_t k = list.first[i]; k < list.first[i + 1]; ++k) {
      std::size_t const j = list.neighbour[k];
      Vector<Dim> const half = 0.5 * problem_.domain.nearest_image(x[i] - x[j]);
      Vector<Dim> offset;
      for (int n = 0; n < Dim; ++n) offset[n] = list.offset[static_cast<std::size_t>(n)][k];
      // -2 V_j R_ij = a_ij/(V_i r_ij)
      double const per_volume = -2.0 * list.slope[k] * m[j] / rho[j];
      row += per_volume * std::sqrt(m[i] / m[j]) * (half + offset).norm();
      double const per_other = -2.0 * list.slope[k] * m[i] / rho[i];
      column += per_other * c[j] * std::sqrt(m[j] / m[i]) * (half - offset).norm();
      own += per_volume * (offset - half);
    }
    of_row[i] = c[i] * (row + own.norm());
    of_column[i] = column + c[i] * own.norm();
  });
  double const row = *std::max_element(of_row.begin(), of_row.end());
  double const column = *std::max_element(of_column.begin(), of_column.end());
  return 3.0 / std::sqrt(row * column);
}

/// By the kernel's width; where pairs have weights of their own, by the sum of the particle's conductances, half of which
/// Gershgorin's bound on the spectral radius allows.  [s]
template <int Dim>
double MovingScene<Dim>::conduction_step(std::size_t i) const {
  auto const& K = particles_.scalar(Field::conductivity);
  auto const& rho = particles_.scalar(Field::density);
  NeighbourList const& list = geometry().neighbours;
  if (list.slope.empty()) {
    SmoothingLength const h(particles_);
    return 0.5 * h(i) * h(i) * rho[i] / K[i];
  }
  double sum = 0.0;
  for (std::size_t k = list.first[i]; k < list.first[i + 1]; ++k) {
    std::size_t const j = list.neighbour[k];
    sum -= particles_.masses()[j] * (K[i] + K[j]) / (rho[i] * rho[j]) * list.slope[k];
  }
  return 0.5 / sum;
}

template <int Dim>
std::string MovingScene<Dim>::closest_approach() const {
  SmoothingLength const h(particles_);
  auto const& v = particles_.vector(Field::velocity);
  auto const& x = particles_.positions();
  double fastest = 0.0;
  std::string who;
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    for (std::uint32_t const j : geometry().neighbours.row(i)) {
      Vector<Dim> const r_ij = problem_.domain.nearest_image(x[i] - x[j]);
      if (r_ij.norm() >= h.support(i, j)) continue;
      double const rate = rate_of_approach<Dim>(-(v[i] - v[j]).dot(r_ij), r_ij.squaredNorm(), h(i, j));
      if (rate <= fastest) continue;
      fastest = rate;
      who = fmt::format("particles {} and {}, {:.3g} apart", i, j, r_ij.norm());
    }
  }
  for (std::size_t w = 0; w < geometry().contacts.size(); ++w) {
    auto const& contacts = geometry().contacts[w];
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      std::uint32_t const i = contacts.particle[k];
      double const rate = (v[i] - contacts.velocity[k]).dot(contacts.outward_normal) / contacts.distance[k];
      if (rate <= fastest) continue;
      fastest = rate;
      who = fmt::format("particle {} and wall {}, {:.3g} apart", i, w, contacts.distance[k]);
    }
  }
  return who;
}

template <int Dim>
void MovingScene<Dim>::require_order(double time) const {
  auto const& x = particles_.positions();
  if (auto const lost = first_row(x.size(), threads_, [&](std::size_t i) { return !x[i].allFinite(); }))
    throw BrokenRun("non-finite", fmt::format("position of particle {} is not finite at t = {:.6g}", *lost, time));
  if constexpr (Dim == 1) {
    bool const periodic = problem_.domain.periodic[0];
    double const period = problem_.domain.extent()[0];
    std::size_t const n = order_.size();
    auto const next = [&](std::size_t k) { return order_[(k + 1) % n]; };
    auto const crossed = first_row(n > 1 ? n - (periodic ? 0 : 1) : 0, threads_, [&](std::size_t k) {
      double gap = x[next(k)][0] - x[order_[k]][0];
      // Neighbours along a periodic axis are less than half of it apart.
      if (periodic) gap -= period * std::round(gap / period);
      return !(gap > 0.0);
    });
    if (crossed) {
      throw BrokenRun("unstable", fmt::format("particles {} and {} crossed at t = {:.6g}", order_[*crossed], next(*crossed), time));
    }
  }
  if (!with_walls_) return;
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    if (auto const i = first_row(x.size(), threads_, [&](std::size_t k) { return !(walls_[w].distance(x[k]) > 0.0); }))
      throw BrokenRun("unstable", fmt::format("particle {} overtook wall {} at t = {:.6g}", *i, w, time));
  }
}

#define SPHVERIFY_INSTANTIATE(D)                                        \
  template std::vector<StepLimit> MovingScene<D>::step_limits() const;  \
  template double MovingScene<D>::conduction_step(std::size_t) const;   \
  template double MovingScene<D>::cells_step() const;                   \
  template double MovingScene<D>::largest_approach() const;             \
  template double MovingScene<D>::viscous_step_of_weights(std::size_t, double) const; \
  template std::string MovingScene<D>::closest_approach() const;        \
  template void MovingScene<D>::require_order(double time) const;
SPHVERIFY_INSTANTIATE(1)
SPHVERIFY_INSTANTIATE(2)
SPHVERIFY_INSTANTIATE(3)
#undef SPHVERIFY_INSTANTIATE

}  // namespace sphverify
