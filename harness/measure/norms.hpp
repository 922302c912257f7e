#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "formulations/support/particles.hpp"
#include "formulations/support/walls.hpp"
#include "reports/results.hpp"

namespace sphverify {

/// Weighted l1, l2 and maximum norm of numbers; the weights are normalised to sum 1, so that l1 <= l2 <=
/// linf. All NaN where a value or a weight is not finite. Expects as many weights as values and a positive
/// sum.
NormSet norms(std::span<double const> values, std::span<double const> weights);

/// Which particles an error is taken over. Two-pass forms feel a wall to twice the support, 4h.
struct Region {
  std::string name;
  std::vector<std::size_t> particles;
};

/// `all`; `wall`: within the support 2h of a wall; `corner`: of those, within 2h of two that are not
/// parallel; `interior`: beyond 4h from every wall. Regions without particles are left out.
/// @param counts which particles count at all; empty: all of them
template <int Dim>
std::vector<Region> regions(Particles<Dim> const& particles, std::vector<Wall<Dim>> const& walls,
                            std::function<bool(std::size_t)> const& counts = {});

/// Norms of |computed - exact| and of |exact| by region. `components` lists of one value per particle each; a
/// vector's error is the length of the difference.
/// @param weights V_i, volumes of the exact solution
/// @param round_off error that rounding alone explains
FieldErrors field_errors(std::vector<std::span<double const>> const& computed,
                         std::vector<std::span<double const>> const& exact, std::span<double const> weights,
                         std::vector<Region> const& regions, double round_off);

}  // namespace sphverify
