#include "harness/scene/moving_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "formulations/support/cubic_spline.hpp"
#include "formulations/support/self_consistent_smoothing.hpp"
#include "formulations/support/sweep.hpp"

namespace sphverify {

namespace {

/// Beyond the support, in smoothing lengths: a list that is a tenth wider has a third more pairs in 3D, and
/// pays if it serves a few times.
constexpr double usual_skin = 0.1;
constexpr double least_uses = 3.0;

}  // namespace

template <int Dim>
MovingGeometry<Dim>::MovingGeometry(Domain<Dim> const& domain, Choice const& choice) : choice_(choice) {
  geometry_.domain = domain;
}

template <int Dim>
std::size_t MovingGeometry<Dim>::bytes() const {
  return geometry_.bytes() + sizeof(double) * (Dim * found_at_.size() + reach_.capacity());
}

template <int Dim>
void MovingGeometry<Dim>::follow(Particles<Dim>& particles, std::vector<Wall<Dim>> const& walls,
                                 std::vector<Wall<Dim>> const& all_walls) {
  if (choice_.adaptive) {
    sums_density() ? solve_smoothing_length(particles, all_walls) : set_smoothing_length(particles);
    ++passes_["smoothing-length"];
  }
  if (has_outrun_list(particles)) find_list(particles);
  ++uses_;
  if (sums_density()) set_density(particles, *grid_, all_walls);
  if (walls.empty()) return;
  SmoothingLength const h(particles);
  geometry_.walls = walls;
  geometry_.contacts.clear();
  for (Wall<Dim> const& wall : walls) {
    geometry_.contacts.push_back(find_wall_contacts(*grid_, wall, walls, h, particles.masses(),
                                                    particles.scalar(Field::density), choice_.face_weight));
  }
  ++passes_["wall-contacts"];
}

/// The list holds every pair that was closer than (reach_i + reach_j) supports of one length. A pair is now
/// closer than its support only if it was closer than that plus what both have moved.
template <int Dim>
bool MovingGeometry<Dim>::has_outrun_list(Particles<Dim> const& particles) const {
  if (!grid_) return true;
  SmoothingLength const h(particles);
  double farthest = 0.0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    Vector<Dim> const moved = geometry_.domain.nearest_image(particles.positions()[i] - found_at_[i]);
    double const reach = h.is_uniform() ? reach_.front() : reach_[i];
    // Not only beyond: a place that is not a number is not within either.
    if (!(h(i) + moved.norm() <= reach)) return true;
    farthest = std::max(farthest, moved.norm());
  }
  // The grid is asked for all within the largest support, whoever has moved.
  return CubicSpline<Dim>::support_ratio * h.largest() + farthest > grid_->reach();
}

template <int Dim>
double MovingGeometry<Dim>::choose_skin(Particles<Dim> const& particles) const {
  if (!grid_ || uses_ == 0) return usual_skin;
  double farthest = 0.0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    Vector<Dim> const moved = geometry_.domain.nearest_image(particles.positions()[i] - found_at_[i]);
    farthest = std::max(farthest, moved.norm());
  }
  double const per_use = farthest / static_cast<double>(uses_);
  return usual_skin * particles.smoothing_length() >= least_uses * per_use ? usual_skin : 0.0;
}

template <int Dim>
void MovingGeometry<Dim>::find_list(Particles<Dim> const& particles) {
  SmoothingLength const h(particles);
  double const wider = 1.0 + choose_skin(particles);
  double const support = CubicSpline<Dim>::support_ratio * h.largest();
  // Where a periodic axis is just long enough for the support, there is no room for a skin.
  double reach = wider * support;
  for (int k = 0; k < Dim; ++k) {
    double const half = 0.5 * geometry_.domain.extent()[k];
    if (geometry_.domain.periodic[k] && reach > half) reach = std::max(support, half);
  }
  double const fitted = reach / support;
  NeighbourList old = std::move(geometry_.neighbours);
  geometry_.neighbours.first.assign(particles.size() + 1, 0);  // should what follows not succeed
  geometry_.neighbours.neighbour.clear();
  grid_.reset();
  CellGrid<Dim> const grid(particles.positions(), geometry_.domain, reach);
  geometry_.neighbours = find_neighbours(grid, h, fitted - 1.0, choice_.threads, std::move(old));
  grid_.emplace(grid);
  reach_.assign(h.is_uniform() ? 1 : particles.size(), fitted * particles.smoothing_length());
  if (!h.is_uniform()) {
    for (std::size_t i = 0; i < reach_.size(); ++i) reach_[i] = fitted * h(i);
  }
  found_at_ = particles.positions();
  uses_ = 0;
  ++passes_["neighbour-search"];
}

template <int Dim>
void MovingGeometry<Dim>::set_density(Particles<Dim>& particles, CellGrid<Dim> const& grid,
                                      std::vector<Wall<Dim>> const& walls) {
  SmoothingLength const h(particles);
  auto& density = particles.scalar(Field::density);
  if (h.is_uniform()) {
    sum_density(particles, geometry_.neighbours, geometry_.domain, choice_.threads);
  } else {
    density = summation_density(grid, h, particles.masses());
  }
  ++passes_["density-summation"];
  if (choice_.density != DensityRule::normalised || walls.empty()) return;
  for (std::size_t i = 0; i < density.size(); ++i) {
    density[i] /= kernel_inside(particles.positions()[i], walls, h(i));
  }
  ++passes_["density-normalisation"];
}

/// h_i = (h/dx) (m_i/rho_i)^(1/Dim), with the densities that are there.
template <int Dim>
void MovingGeometry<Dim>::set_smoothing_length(Particles<Dim>& particles) {
  auto& h = particles.smoothing_lengths();
  auto const& density = particles.scalar(Field::density);
  for (std::size_t i = 0; i < h.size(); ++i) {
    h[i] = choice_.smoothing_ratio * std::pow(particles.masses()[i] / density[i], 1.0 / Dim);
  }
}

template <int Dim>
void MovingGeometry<Dim>::solve_smoothing_length(Particles<Dim>& particles,
                                                 std::vector<Wall<Dim>> const& walls) {
  std::vector<Wall<Dim>> const none;
  SelfConsistentSmoothing<Dim> const equations{
      particles.positions(),   particles.masses(),
      geometry_.domain,        choice_.density == DensityRule::normalised ? walls : none,
      choice_.smoothing_ratio, choice_.threads,
  };
  equations.solve(particles.smoothing_lengths());
}

template class MovingGeometry<1>;
template class MovingGeometry<2>;
template class MovingGeometry<3>;

}  // namespace sphverify
