// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

// One sweep over pairs in 3D, momentum/p-rho2 with Wendland's C2, written once for any vector type: what the choice of the
// type is worth (docs/decisions/0014-packs.md).
namespace sphverify::bench {

/// Particles by records of eight numbers, x y z m rho 1/rho P and one unused, aligned to 64 bytes.
struct PackSample {
  double const* records;
  std::vector<std::size_t> first;
  std::vector<std::uint32_t> neighbour;
  double h;
};
inline constexpr std::size_t record = 8;

/// Writes three numbers per particle.
using Sweep = void (*)(PackSample const&, double*);

/// @tparam Numbers has size, Numbers(double), + - * and unary -, sqrt, max, sum(), first(n) and columns()
template <class Numbers>
void sweep_rows(PackSample const& sample, double* out) {
  constexpr std::size_t lanes = Numbers::size;
  double const per_h = 1.0 / sample.h;
  double const h2 = per_h * per_h;
  Numbers const scale(21.0 / (16.0 * 3.14159265358979323846) * h2 * h2 * per_h);
  for (std::size_t i = 0; i + 1 < sample.first.size(); ++i) {
    double const* const own = sample.records + i * record;
    Numbers ax(0.0), ay(0.0), az(0.0);
    Numbers const own_part(own[6] * own[5] * own[5]);
    std::size_t const end = sample.first[i + 1];
    for (std::size_t k = sample.first[i]; k < end; k += lanes) {
      double const* rows[lanes];
      for (std::size_t l = 0; l < lanes; ++l) rows[l] = sample.records + sample.neighbour[k + l < end ? k + l : end - 1] * record;
      Numbers place[4], rest[4];
      Numbers::columns(rows, place);
      for (std::size_t l = 0; l < lanes; ++l) rows[l] += 4;
      Numbers::columns(rows, rest);
      Numbers const x = Numbers(own[0]) - place[0], y = Numbers(own[1]) - place[1], z = Numbers(own[2]) - place[2];
      Numbers const r2 = x * x + y * y + z * z;
      Numbers const p = max(Numbers(1.0) - Numbers(0.5 * per_h) * sqrt(r2), Numbers(0.0));
      Numbers slope = scale * Numbers(-5.0) * (p * p * p);
      if (k + lanes > end) slope = slope.first(end - k);
      Numbers const strength = -(place[3] * (rest[2] * rest[1] * rest[1] + own_part) * slope);
      ax = ax + strength * x;
      ay = ay + strength * y;
      az = az + strength * z;
    }
    out[3 * i] = ax.sum();
    out[3 * i + 1] = ay.sum();
    out[3 * i + 2] = az.sum();
  }
}

void ours_of_four(PackSample const&, double*);
void ours_of_eight(PackSample const&, double*);
void xsimd_of_four(PackSample const&, double*);
void xsimd_of_eight(PackSample const&, double*);
void highway_of_four(PackSample const&, double*);
void highway_of_eight(PackSample const&, double*);

}  // namespace sphverify::bench
