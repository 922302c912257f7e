// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/claims/defects.hpp"
#include "harness/claims/random_scene.hpp"
#include "reports/extremes.hpp"

namespace sphverify::claims {

namespace {

constexpr double spacing = 0.1;
constexpr double usual_ratio = 1.3;  // of smoothing length and spacing
constexpr double rho = 1.3, P = 0.9, T = 1.1, K = 0.7;

/// A uniform state on a lattice so large that the particle at the origin sees no edge through any pass.
template <int Dim>
RandomScene<Dim> lattice(SchemeInfo const& scheme, Kernel const& kernel, double ratio = usual_ratio) {
  int const reach = static_cast<int>(std::ceil(supports_seen(scheme) * kernel.support_ratio() * ratio));
  RandomScene<Dim> scene = lattice_scene<Dim>(2 * reach + 1, spacing, ratio);
  Particles<Dim>& p = scene.particles;
  p.set_kernel(kernel);
  p.scalar(Field::density).assign(p.size(), rho);
  for (double& m : p.masses()) m *= rho;
  p.scalar(Field::pressure).assign(p.size(), P);
  p.scalar(Field::temperature).assign(p.size(), T);
  p.scalar(Field::conductivity).assign(p.size(), K);
  return scene;
}

template <int Dim>
std::size_t centre(RandomScene<Dim> const& scene) {
  return scene.particles.size() / 2;
}

/// D = -sum_j V (x_i - x_j) dW_ij/dx_i of the particle in the middle: what a derivative on this lattice is multiplied by.
template <int Dim>
double lattice_factor(RandomScene<Dim> const& scene, Kernel const& kernel) {
  Particles<Dim> const& p = scene.particles;
  Vector<Dim> const x = p.positions()[centre(scene)];
  double sum = 0.0;
  for (std::size_t j = 0; j < p.size(); ++j) {
    Vector<Dim> const r = x - p.positions()[j];
    if (j != centre(scene)) sum -= p.masses()[j] / rho * r[0] * r[0] * kernel.radial(r.norm(), p.smoothing_length());
  }
  return sum;
}

/// The rate of the particle in the middle, and a size for it: what its neighbours add without cancelling.
template <int Dim>
struct Middle {
  Vector<Dim> acceleration = Vector<Dim>::Zero();
  double heating = 0.0;

  Middle(RandomScene<Dim> const& scene, std::string_view id) {
    // A lattice has partners enough, but for a quadratic; so much wider a kernel would see its edge.
    bool const is_quadratic = find_scheme(id)->least_squares;
    Rates<Dim> const rates = is_quadratic ? evaluate(scene, id) : evaluate(scene, id, geometry_for(id, scene));
    if (!rates.acceleration.empty()) acceleration = rates.acceleration[centre(scene)];
    if (!rates.heating.empty()) heating = rates.heating[centre(scene)];
  }
  double size() const { return acceleration.norm() + std::abs(heating); }
};

/// Of a rate of the uniform state: pressure, or conductivity and temperature, per density and length.
double scale_of(Rate rate) {
  double const h = usual_ratio * spacing;
  return rate == Rate::acceleration ? P / (rho * h) : rate == Rate::conduction_heating ? K * T / (rho * h * h) : P / (rho * h);
}

template <int Dim>
double uniform(SchemeInfo const& scheme, RandomScene<Dim> scene) {
  Vector<Dim> const u = Random(1).vector<Dim>(-1.0, 1.0);
  for (std::size_t i = 0; i < scene.particles.size(); ++i) scene.particles.vector(Field::velocity).set(i, u);
  return Middle<Dim>(scene, scheme.id).size() / scale_of(scheme.rate);
}

}  // namespace

template <int Dim>
std::optional<double> uniform_on_lattice(SchemeInfo const& scheme, Kernel const& kernel) {
  // At 1 neighbours lie on the edge of the support.
  return larger(uniform(scheme, lattice<Dim>(scheme, kernel)), uniform(scheme, lattice<Dim>(scheme, kernel, 1.0)));
}

template <int Dim>
std::optional<double> uniform_on_jittered(SchemeInfo const& scheme, Kernel const& kernel) {
  RandomScene<Dim> scene = lattice<Dim>(scheme, kernel);
  Random random(5);
  for (std::size_t i = 0; i < scene.particles.size(); ++i)
    scene.particles.positions().add(i, 0.2 * spacing * random.vector<Dim>(-1.0, 1.0));
  return uniform(scheme, scene);
}

template <int Dim>
std::optional<double> linear_on_lattice(SchemeInfo const& scheme, Kernel const& kernel) {
  RandomScene<Dim> scene = lattice<Dim>(scheme, kernel);
  Particles<Dim>& p = scene.particles;
  int const powers = scheme.claims.lattice_factors < 0 ? derivatives_taken(scheme) : scheme.claims.lattice_factors;
  double const factor = std::pow(lattice_factor(scene, kernel), powers);
  Random random(2);
  // So small gradients of pressure and conductivity that any function and any mean of them is linear too.
  Vector<Dim> const of_pressure = 1e-4 * random.vector<Dim>(0.5, 2.0);
  Vector<Dim> const of_temperature = random.vector<Dim>(0.2, 0.9);
  Vector<Dim> const of_conductivity = 1e-4 * random.vector<Dim>(0.2, 0.9);
  Matrix<Dim> of_velocity;
  for (int k = 0; k < Dim; ++k) of_velocity.col(k) = random.vector<Dim>(-1.0, 1.0);
  for (std::size_t i = 0; i < p.size(); ++i) {
    Vector<Dim> const x = p.positions()[i];
    if (scheme.rate == Rate::acceleration) p.scalar(Field::pressure)[i] += of_pressure.dot(x);
    p.vector(Field::velocity).set(i, of_velocity * x);
    p.scalar(Field::temperature)[i] += of_temperature.dot(x);
    p.scalar(Field::conductivity)[i] += of_conductivity.dot(x);
  }
  Middle<Dim> const found(scene, scheme.id);
  if (scheme.rate == Rate::acceleration) {
    Vector<Dim> const expected = -factor * of_pressure / rho;
    return (found.acceleration - expected).norm() / expected.norm();
  }
  // div(K grad T) of linear K and T; the work of compression.
  double const expected = scheme.rate == Rate::conduction_heating
                              ? factor * of_temperature.dot(of_conductivity) / rho
                              : -P / rho * factor * of_velocity.trace();
  return std::abs(found.heating - expected) / std::abs(expected);
}

#define SPHVERIFY_INSTANTIATE(Dim)                                                             \
  template std::optional<double> uniform_on_lattice<Dim>(SchemeInfo const&, Kernel const&);  \
  template std::optional<double> uniform_on_jittered<Dim>(SchemeInfo const&, Kernel const&); \
  template std::optional<double> linear_on_lattice<Dim>(SchemeInfo const&, Kernel const&);
SPHVERIFY_INSTANTIATE(1)
SPHVERIFY_INSTANTIATE(2)
SPHVERIFY_INSTANTIATE(3)
#undef SPHVERIFY_INSTANTIATE

}  // namespace sphverify::claims
