// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace sphverify {

/// How much further than the support to seek neighbours, as a part of it, for moving particles to cost
/// least. Where they move by u half supports from place to place, a list of skin s >= u serves s/u + 1
/// places rounded down, on average s/u + 1/2, and has (1 + s)^Dim times as many pairs. With the list at
/// `list_cost` times the sweeps of one place, each place costs (1 + s)^Dim (1 + a/w) of these, with
/// a = list_cost u and w = s + u/2. Its least is at Dim w^2 + (Dim - 1) a w = a (1 - u/2). No skin, 0, costs
/// 1 + list_cost.
/// @param movement u, from place to place, in half supports; 0 or more; what is not finite gives 0
double cheapest_skin(double movement, int dimension);

/// A list over all sweeps of one place, about: a list takes as long as one sweep of forces
/// (docs/decisions/0006-sweeps-from-positions.md), and a place has one or two of those and others. The least
/// is flat; and it may not depend on the clock, since skins decide in which order pairs are summed.
inline constexpr double list_cost = 2.0 / 3.0;

}  // namespace sphverify
