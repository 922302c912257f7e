#pragma once

namespace sphverify {

/// How much further than the support to seek neighbours, in smoothing lengths, for evaluations of moving
/// particles to cost least. A list of skin s has (1 + s)^Dim times as many pairs, and serves s/u evaluations
/// where particles move by u smoothing lengths in one: with the list at `list_cost` times the sweeps of one
/// evaluation it costs (1 + s)^Dim (1 + list_cost u/s) of those sweeps. Its least is at
/// Dim s^2 + (Dim - 1) a s = a, a = list_cost u. No skin, 0, where that costs more than a new list each time,
/// 1 + list_cost.
/// @param movement u, in smoothing lengths; not negative, or not finite (then 0)
double cheapest_skin(double movement, int dimension);

/// A list over all sweeps of one evaluation of a gas: 0.7 to 1.3 from measurement
/// (docs/decisions/0006-sweeps-from-positions.md). The least is flat, and may not depend on the clock: skins
/// decide in which order pairs are summed.
inline constexpr double list_cost = 1.0;

}  // namespace sphverify
