// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string_view>

#include "formulations/basics/flag_set.hpp"

namespace sphverify {

/// What a particle can carry. Position and mass always exist; every other array only if somebody needs it.
enum class Field {
  position,
  mass,
  density,
  velocity,
  pressure,
  internal_energy,
  temperature,
  conductivity,
  flux,
  acceleration,
  heating,
  sound_speed,
  density_rate,
  omega,  ///< how the density answers where h follows it (density/grad_h.hpp)
  // What a scheme's first passes write that has no name above; each scheme means something of its own by them.
  pass_number,
  pass_number_2,
  pass_vector,
  pass_tensor  ///< symmetric
};

using FieldSet = FlagSet<Field>;

struct FieldInfo {
  Field field;
  std::string_view name;  ///< as written in documents
  bool is_vector;
  std::string_view unit;  ///< in SI; any coherent system of units serves
  bool is_tensor = false;

  /// Numbers per particle.
  constexpr int components(int dimension) const {
    return is_vector ? dimension : is_tensor ? dimension * (dimension + 1) / 2 : 1;
  }
};

inline constexpr std::array<FieldInfo, 18> field_infos{{
    {Field::position, "position", true, "m"},
    {Field::mass, "mass", false, "kg"},
    {Field::density, "density", false, "kg/m^3"},
    {Field::velocity, "velocity", true, "m/s"},
    {Field::pressure, "pressure", false, "Pa"},
    {Field::internal_energy, "internal_energy", false, "J/kg"},
    {Field::temperature, "temperature", false, "K"},
    {Field::conductivity, "conductivity", false, "W/(m K)"},
    {Field::flux, "flux", true, "W/m^2"},
    {Field::acceleration, "acceleration", true, "m/s^2"},
    {Field::heating, "heating", false, "W/kg"},
    {Field::sound_speed, "sound_speed", false, "m/s"},
    {Field::density_rate, "density_rate", false, "kg/(m^3 s)"},
    {Field::omega, "omega", false, "1"},
    {Field::pass_number, "pass_number", false, "the scheme's"},
    {Field::pass_number_2, "pass_number_2", false, "the scheme's"},
    {Field::pass_vector, "pass_vector", true, "the scheme's"},
    {Field::pass_tensor, "pass_tensor", false, "the scheme's", true},
}};

/// Those that a scheme gives a meaning of its own.
inline constexpr FieldSet pass_fields{Field::pass_number, Field::pass_number_2, Field::pass_vector, Field::pass_tensor};

constexpr FieldInfo const& info(Field field) { return field_infos[static_cast<std::size_t>(field)]; }

}  // namespace sphverify
