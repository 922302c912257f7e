// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/least_squares/quadratic_weights.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <string>

#include "formulations/basics/parallel.hpp"
#include "formulations/basics/undefined_rate.hpp"

namespace sphverify {

namespace {

/// Coefficients of a quadratic without its constant: Dim slopes, then the second derivatives.
template <int Dim>
constexpr int coefficients = Dim * (Dim + 3) / 2;
template <int Dim>
using Coefficients = Eigen::Matrix<double, coefficients<Dim>, 1>;

/// x_k and x_k x_l, in the order of the coefficients.
template <int Dim>
Coefficients<Dim> monomials(Vector<Dim> const& x) {
  Coefficients<Dim> p;
  for (int k = 0; k < Dim; ++k) p[k] = x[k];
  for (int l = 0, n = Dim; l < Dim; ++l)
    for (int k = 0; k <= l; ++k) p[n++] = x[k] * x[l];
  return p;
}

/// n.grad of the monomials.
template <int Dim>
Coefficients<Dim> slopes(Vector<Dim> const& x, Vector<Dim> const& n) {
  Coefficients<Dim> p;
  for (int k = 0; k < Dim; ++k) p[k] = n[k];
  for (int l = 0, m = Dim; l < Dim; ++l)
    for (int k = 0; k <= l; ++k) p[m++] = n[k] * x[l] + x[k] * n[l];
  return p;
}

/// Their Laplacian.
template <int Dim>
Coefficients<Dim> laplacian() {
  Coefficients<Dim> e = Coefficients<Dim>::Zero();
  for (int l = 0; l < Dim; ++l) e[Dim + tensor_index(l, l)] = 2.0;
  return e;
}

/// One particle's partners, all lengths in smoothing lengths so that slopes and second derivatives weigh alike.
template <int Dim>
class Partners {
 public:
  Partners(Kernel const& kernel, double h) : kernel_(kernel), h_(h) {}

  /// @param scale by which the weight is multiplied where it is written
  void add_value(Vector<Dim> const& to, double* weight, double scale = 1.0) {
    add(monomials<Dim>(to / h_), to.norm(), weight, scale / (h_ * h_));
  }
  void add_slope(Vector<Dim> const& to, Vector<Dim> const& normal, double* weight) {
    add(slopes<Dim>(to / h_, normal), to.norm(), weight, 1.0 / h_);
  }

  /// Writes the weights. @return whether there are any
  bool solve() {
    if (rows_.size() < static_cast<std::size_t>(coefficients<Dim>)) return false;
    Eigen::Matrix<double, Eigen::Dynamic, coefficients<Dim>> A(rows_.size(), coefficients<Dim>);
    for (std::size_t n = 0; n < rows_.size(); ++n) A.row(static_cast<Eigen::Index>(n)) = rows_[n].root * rows_[n].p.transpose();
    // A^T y = e of the least |y|, with A P = Q R: R^T (Q^T y) = P^T e.
    auto qr = Eigen::ColPivHouseholderQR<decltype(A)>(A.rows(), A.cols());
    qr.setThreshold(1e-9);
    qr.compute(A);
    if (qr.rank() < coefficients<Dim>) return false;
    Eigen::VectorXd y = Eigen::VectorXd::Zero(A.rows());
    y.template head<coefficients<Dim>>() = qr.matrixR()
                                               .template topRows<coefficients<Dim>>()
                                               .template triangularView<Eigen::Upper>()
                                               .transpose()
                                               .solve(qr.colsPermutation().transpose() * laplacian<Dim>());
    y.applyOnTheLeft(qr.householderQ());
    for (std::size_t n = 0; n < rows_.size(); ++n) *rows_[n].weight = rows_[n].scale * rows_[n].root * y[static_cast<Eigen::Index>(n)];
    return true;
  }

 private:
  struct Row {
    Coefficients<Dim> p;
    double root, scale;
    double* weight;
  };
  void add(Coefficients<Dim> const& p, double distance, double* weight, double scale) {
    *weight = 0.0;
    double const w = kernel_.value(distance, h_) / kernel_.value(0.0, h_);
    if (w > 0.0) rows_.push_back({p, std::sqrt(w), scale, weight});
  }

  Kernel const& kernel_;
  double h_;
  std::vector<Row> rows_;
};

/// Everything that the weights depend on, besides lists and what an operator's geometry never changes: its domain, its kernel, and
/// what its walls prescribe.
template <int Dim>
std::vector<double> places(Particles<Dim> const& particles, PairGeometry<Dim> const& geometry) {
  std::vector<double> all(particles.smoothing_lengths());
  all.push_back(particles.smoothing_length());
  auto const take = [&](VectorField<Dim> const& x) {
    for (int k = 0; k < Dim; ++k) all.insert(all.end(), x.component(k).begin(), x.component(k).end());
  };
  take(particles.positions());
  for (auto const& contacts : geometry.contacts) {
    all.insert(all.end(), contacts.distance.begin(), contacts.distance.end());
    take(contacts.foot);
  }
  for (auto const& behind : geometry.behind) take(behind.particles.positions());
  return all;
}

/// Whether two geometries list the same pairs and contacts.
template <int Dim>
bool same_lists(PairGeometry<Dim> const& a, PairGeometry<Dim> const& b) {
  auto const same_pairs = [](NeighbourList const& x, NeighbourList const& y) {
    return x.first == y.first && std::ranges::equal(x.neighbour, y.neighbour);
  };
  return same_pairs(a.neighbours, b.neighbours) &&
         std::ranges::equal(a.contacts, b.contacts,
                            [](auto const& x, auto const& y) { return x.particle == y.particle; }) &&
         std::ranges::equal(a.behind, b.behind, [&](auto const& x, auto const& y) { return same_pairs(x.pairs, y.pairs); });
}

}  // namespace

template <int Dim>
PairGeometry<Dim>& QuadraticWeights<Dim>::on(Particles<Dim> const& particles, PairGeometry<Dim> const& geometry, int threads) {
  std::vector<double> now = places(particles, geometry);
  if (now == places_ && same_lists(weighted_, geometry)) return weighted_;
  weighted_ = geometry;
  places_.clear();  // should the weights not be found
  weigh(particles, threads);
  places_ = std::move(now);
  return weighted_;
}

template <int Dim>
void QuadraticWeights<Dim>::weigh(Particles<Dim> const& particles, int threads) {
  auto const& x = particles.positions();
  auto const& own_h = particles.smoothing_lengths();
  NeighbourList& pairs = weighted_.neighbours;
  pairs.slope = LargeArray<double>(pairs.pairs());
  for (auto& behind : weighted_.behind) behind.pairs.slope = LargeArray<double>(behind.pairs.pairs());
  constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  std::atomic<std::size_t> undefined = none;
  for_each_row(particles.size(), threads, [&](std::size_t i) {
    Partners<Dim> partners(particles.kernel(), own_h.empty() ? particles.smoothing_length() : own_h[i]);
    for (std::size_t k = pairs.first[i]; k < pairs.first[i + 1]; ++k)
      partners.add_value(weighted_.domain.nearest_image(x[pairs.neighbour[k]] - x[i]), &pairs.slope[k]);
    for (std::size_t w = 0; w < weighted_.contacts.size(); ++w) {
      WallContacts<Dim>& contacts = weighted_.contacts[w];
      auto const found = std::ranges::lower_bound(contacts.particle, i);
      if (found == contacts.particle.end() || *found != i) continue;
      auto const c = static_cast<std::size_t>(found - contacts.particle.begin());
      if (!weighted_.behind.empty()) {
        WallParticles<Dim>& behind = weighted_.behind[w];
        for (std::size_t k = behind.pairs.first[c]; k < behind.pairs.first[c + 1]; ++k)
          partners.add_value(weighted_.domain.nearest_image(behind.particles.positions()[behind.pairs.neighbour[k]] - x[i]),
                       &behind.pairs.slope[k]);
        continue;
      }
      Vector<Dim> const to = weighted_.domain.nearest_image(contacts.foot[c] - x[i]);
      if (contacts.prescribes_flux_only) {
        partners.add_slope(to, contacts.outward_normal, &contacts.face_weight[c]);
      } else {
        partners.add_value(to, &contacts.face_weight[c], contacts.distance[c]);
      }
    }
    if (partners.solve()) return;
    std::size_t first = undefined;
    while (i < first && !undefined.compare_exchange_weak(first, i)) {
    }
  });
  if (undefined == none) return;
  throw TooFewPartners("particle " + std::to_string(undefined) + ": too few partners within its support for a quadratic" +
                      (Dim > 1 ? ", or all of them on one curve" : "") + ": take a larger h/dx");
}

template class QuadraticWeights<1>;
template class QuadraticWeights<2>;
template class QuadraticWeights<3>;

}  // namespace sphverify
