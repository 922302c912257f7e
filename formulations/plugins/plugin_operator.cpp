// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/plugins/plugin_operator.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sphverify {

namespace {

double const* data_of(std::vector<double> const& values) { return values.empty() ? nullptr : values.data(); }

template <int Dim>
void point_to(VectorField<Dim> const& field, double const* (&components)[3]) {
  for (int k = 0; k < Dim; ++k) components[k] = data_of(field.component(k));
}

template <int Dim>
void copy(Vector<Dim> const& vector, double (&numbers)[3]) {
  for (int k = 0; k < Dim; ++k) numbers[k] = vector[k];
}

int bits_of(auto const& wall) {
  int bits = 0;
  for (auto const& [bit, value] : {std::pair{SPHVERIFY_VELOCITY, BoundaryValue::velocity},
                                   std::pair{SPHVERIFY_PRESSURE, BoundaryValue::pressure},
                                   std::pair{SPHVERIFY_TEMPERATURE, BoundaryValue::temperature},
                                   std::pair{SPHVERIFY_CONDUCTIVITY, BoundaryValue::conductivity},
                                   std::pair{SPHVERIFY_FLUX, BoundaryValue::flux}}) {
    if (wall.prescribes(value)) bits |= bit;
  }
  return bits;
}

template <int Dim>
class PluginOperator final : public RateOperator<Dim> {
 public:
  explicit PluginOperator(PluginLibrary& library) : library_(library) {}

  SchemeInfo const& info() const override { return library_.info(); }

  void begin_pass(int, Particles<Dim>& particles, PairGeometry<Dim>& geometry, Closure closure, double time, int threads,
                  PairSweep<Dim>&) override {
    for (std::size_t w = 0; w < geometry.contacts.size(); ++w) {
      // A flux has no closure: it is known where the wall prescribes it.
      bool const has_flux = geometry.walls[w].prescribes(BoundaryValue::flux);
      BoundaryValueSet const wanted = has_flux ? info().boundary | info().boundary_if_prescribed : info().boundary;
      fill_boundary_values(geometry.contacts[w], geometry.walls[w], particles, wanted.without(geometry.held), closure, time,
                           threads);
    }
    std::vector<sphverify_wall> const walls = walls_of(geometry);
    sphverify_state const state = state_of(particles, geometry, walls, time);
    clear_terms(walls.size(), particles.size());
    std::vector<std::array<double*, 3>> of_walls;
    for (auto& wall : of_wall_) of_walls.push_back(pointers(wall));
    // An array of three pointers is what std::array holds.
    static_assert(sizeof(std::array<double*, 3>) == sizeof(double* const[3]));
    sphverify_rates rates{{}, of_walls.empty() ? nullptr : reinterpret_cast<double* const(*)[3]>(of_walls.data())};
    std::array<double*, 3> const pairs = pointers(pairs_);
    std::copy(pairs.begin(), pairs.end(), rates.pairs);
    library_.rates(state, rates);
    for (int k = 0; k < components(); ++k) {
      std::copy_n(pairs_[static_cast<std::size_t>(k)].begin(), particles.size(), output(particles, k).begin());
    }
  }

  void end_pass(int, Particles<Dim>& particles, PairGeometry<Dim> const& geometry, WorkCount& work) override {
    if (library_.wants_neighbours()) work.pair_interactions += geometry.neighbours.pairs();
    accelerations_.clear();
    force_.assign(is_vector() ? geometry.contacts.size() : 0, Vector<Dim>::Zero());
    power_.assign(is_vector() ? 0 : geometry.contacts.size(), 0.0);
    for (std::size_t w = 0; w < geometry.contacts.size(); ++w) {
      work.wall_interactions += geometry.contacts[w].size();
      require_contacts_only(geometry.contacts[w], w);
      for (int k = 0; k < components(); ++k) {
        std::vector<double> const& term = of_wall_[w][static_cast<std::size_t>(k)];
        double sum = 0.0;
        for (std::size_t i = 0; i < particles.size(); ++i) {
          output(particles, k)[i] += term[i];
          sum += particles.masses()[i] * term[i];
        }
        (is_vector() ? force_[w][k] : power_[w]) = sum;
      }
      if (is_vector()) accelerations_.push_back(at_contacts(geometry.contacts[w], w));
    }
  }

  void freeze(Particles<Dim>&, PairGeometry<Dim>&, int) override {}
  std::size_t bytes() const override {
    std::size_t numbers = 0;
    for (auto const& component : pairs_) numbers += component.capacity();
    for (auto const& wall : of_wall_) {
      for (auto const& component : wall) numbers += component.capacity();
    }
    return numbers * sizeof(double);
  }

  std::vector<Vector<Dim>> const& wall_force() const override { return force_; }
  std::vector<double> const& wall_power() const override { return power_; }
  std::vector<std::vector<Vector<Dim>>> const& wall_acceleration() const override { return accelerations_; }

 private:
  /// A rate's components, each with a number per particle; unused ones are empty.
  using Terms = std::array<std::vector<double>, 3>;

  bool is_vector() const { return info().rate == Rate::acceleration; }
  int components() const { return is_vector() ? Dim : 1; }

  std::vector<double>& output(Particles<Dim>& particles, int component) const {
    if (is_vector()) return particles.vector(Field::acceleration).component(component);
    return particles.scalar(Field::heating);
  }

  static std::array<double*, 3> pointers(Terms& terms) {
    std::array<double*, 3> to{};
    for (std::size_t k = 0; k < 3; ++k) to[k] = terms[k].empty() ? nullptr : terms[k].data();
    return to;
  }

  void clear_terms(std::size_t walls, std::size_t particles) {
    of_wall_.resize(walls);
    auto const clear = [&](Terms& terms) {
      for (int k = 0; k < components(); ++k) terms[static_cast<std::size_t>(k)].assign(particles, 0.0);
    };
    clear(pairs_);
    for (Terms& wall : of_wall_) clear(wall);
  }

  std::vector<sphverify_wall> walls_of(PairGeometry<Dim> const& geometry) const {
    std::vector<sphverify_wall> walls;
    // Another form may have asked for more.
    auto const asked = [&](BoundaryValue value, std::vector<double> const& values) {
      return info().boundary.contains(value) ? data_of(values) : nullptr;
    };
    for (std::size_t w = 0; w < geometry.contacts.size(); ++w) {
      WallContacts<Dim> const& contacts = geometry.contacts[w];
      sphverify_wall& wall = walls.emplace_back();
      copy(geometry.walls[w].point, wall.point);
      copy(geometry.walls[w].outward_normal, wall.outward_normal);
      wall.prescribes = bits_of(geometry.walls[w]);
      wall.contacts = contacts.size();
      wall.particle = contacts.particle.data();
      wall.distance = contacts.distance.data();
      wall.face_weight = contacts.face_weight.data();
      wall.foot_density = contacts.foot_density.data();
      wall.pressure = asked(BoundaryValue::pressure, contacts.pressure);
      wall.temperature = asked(BoundaryValue::temperature, contacts.temperature);
      wall.conductivity = asked(BoundaryValue::conductivity, contacts.conductivity);
      if (info().boundary.contains(BoundaryValue::velocity)) point_to(contacts.velocity, wall.velocity);
      bool const has_flux = geometry.walls[w].prescribes(BoundaryValue::flux);
      if (has_flux && info().boundary_if_prescribed.contains(BoundaryValue::flux)) point_to(contacts.flux, wall.flux);
    }
    return walls;
  }

  sphverify_state state_of(Particles<Dim> const& particles, PairGeometry<Dim> const& geometry,
                           std::vector<sphverify_wall> const& walls, double time) const {
    sphverify_state state{};
    state.dimension = Dim;
    state.count = particles.size();
    state.time = time;
    state.kernel = particles.kernel().id().data();
    state.support_ratio = particles.kernel().support_ratio();
    state.smoothing_length = particles.smoothing_length();
    state.smoothing_lengths = data_of(particles.smoothing_lengths());
    point_to(particles.positions(), state.position);
    state.mass = particles.masses().data();
    auto const asked = [&](Field field) {
      return library_.asked().contains(field) ? particles.scalar(field).data() : nullptr;
    };
    state.density = asked(Field::density);
    state.pressure = asked(Field::pressure);
    state.temperature = asked(Field::temperature);
    state.conductivity = asked(Field::conductivity);
    state.sound_speed = asked(Field::sound_speed);
    if (library_.asked().contains(Field::velocity)) point_to(particles.vector(Field::velocity), state.velocity);
    copy(geometry.domain.lower, state.lower);
    copy(geometry.domain.upper, state.upper);
    for (int k = 0; k < Dim; ++k) {
      state.periodic[k] = geometry.domain.periodic[k] ? 1 : 0;
      for (int n = 0; n < Dim; ++n) state.axes[k * Dim + n] = geometry.domain.axes(n, k);
    }
    if (library_.wants_neighbours()) {
      state.first = geometry.neighbours.first.data();
      state.neighbour = geometry.neighbours.neighbour.data();
    }
    state.walls = walls.size();
    state.wall = walls.data();
    return state;
  }

  /// What is said of others would be counted as given by a wall that they do not feel.
  void require_contacts_only(WallContacts<Dim> const& contacts, std::size_t w) const {
    for (int k = 0; k < components(); ++k) {
      std::vector<double> const& term = of_wall_[w][static_cast<std::size_t>(k)];
      std::size_t next = 0;
      for (std::size_t i = 0; i < term.size(); ++i) {
        bool const is_contact = next < contacts.size() && contacts.particle[next] == i;
        next += is_contact ? 1 : 0;
        if (!is_contact && term[i] != 0.0) {
          throw std::invalid_argument(std::string(info().id) + " gives wall " + std::to_string(w) + " a part in particle " +
                                      std::to_string(i) + ", which is no contact of it");
        }
      }
    }
  }

  std::vector<Vector<Dim>> at_contacts(WallContacts<Dim> const& contacts, std::size_t w) const {
    std::vector<Vector<Dim>> terms;
    for (std::uint32_t const i : contacts.particle) {
      Vector<Dim>& term = terms.emplace_back();
      for (int k = 0; k < Dim; ++k) term[k] = of_wall_[w][static_cast<std::size_t>(k)][i];
    }
    return terms;
  }

  PluginLibrary& library_;
  Terms pairs_;
  std::vector<Terms> of_wall_;
  std::vector<std::vector<Vector<Dim>>> accelerations_;
  std::vector<Vector<Dim>> force_;
  std::vector<double> power_;
};

}  // namespace

template <int Dim>
std::unique_ptr<RateOperator<Dim>> make_plugin_operator(PluginLibrary& library) {
  return std::make_unique<PluginOperator<Dim>>(library);
}

template std::unique_ptr<RateOperator<1>> make_plugin_operator<1>(PluginLibrary&);
template std::unique_ptr<RateOperator<2>> make_plugin_operator<2>(PluginLibrary&);
template std::unique_ptr<RateOperator<3>> make_plugin_operator<3>(PluginLibrary&);

}  // namespace sphverify
