// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/hand_written.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <utility>

#if defined(__x86_64__)
#include <immintrin.h>
// One binary for any x86-64: the loader picks the clone that the processor can run.
#define SPHVERIFY_CLONES __attribute__((target_clones("default", "arch=x86-64-v3")))
#else
#define SPHVERIFY_CLONES
#endif

// What a clone calls must be compiled with the clone.
#define SPHVERIFY_INLINED __attribute__((always_inline))
#define SPHVERIFY_INLINE [[gnu::always_inline]] inline
#define SPHVERIFY_RECORDS(stride)                                                                          \
  {                                                                                                        \
    all_records + std::size_t{stride} * neighbour[0], all_records + std::size_t{stride} * neighbour[1],    \
        all_records + std::size_t{stride} * neighbour[2], all_records + std::size_t{stride} * neighbour[3] \
  }

namespace sphverify::bench::hand_written {

namespace {

constexpr std::size_t lanes = 4;
using Lanes = double __attribute__((vector_size(32)));

constexpr double sigma = std::numbers::inv_pi;  // of the cubic spline in 3D

SPHVERIFY_INLINE Lanes all(double a) { return Lanes{a, a, a, a}; }
SPHVERIFY_INLINE double total(Lanes a) { return (a[0] + a[2]) + (a[1] + a[3]); }
SPHVERIFY_INLINE Lanes positive_part(Lanes a) { return a > 0.0 ? a : all(0.0); }
SPHVERIFY_INLINE Lanes negative_part(Lanes a) { return a < 0.0 ? a : all(0.0); }
SPHVERIFY_INLINE Lanes root(Lanes a) {
  return Lanes{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])};
}

SPHVERIFY_INLINE Lanes load(double const* a) {
  Lanes result;
  std::memcpy(&result, a, sizeof result);
  return result;
}

/// Numbers `at` and `at + 1` of four records, one record per lane: loads and two shuffles instead of gathers.
/// Reads `at + 3` as well: GCC 12 puts two halves together in the load itself only if it may load a whole.
SPHVERIFY_INLINE void load_columns(double const* const (&record)[lanes], std::size_t at, Lanes& a, Lanes& b) {
  Lanes const even = __builtin_shufflevector(load(record[0] + at), load(record[2] + at), 0, 1, 4, 5);
  Lanes const odd = __builtin_shufflevector(load(record[1] + at), load(record[3] + at), 0, 1, 4, 5);
  a = __builtin_shufflevector(even, odd, 0, 4, 2, 6);
  b = __builtin_shufflevector(even, odd, 1, 5, 3, 7);
}

/// Puts lanes beyond the end of a row out of the support, where the kernel is exactly zero.
SPHVERIFY_INLINE Lanes only_first(std::size_t count, Lanes squared) {
  return Lanes{0.0, 1.0, 2.0, 3.0} < static_cast<double>(count) ? squared : all(4.0);
}

/// Calls block(neighbours, squared_or_masked) for each four neighbours of row i. Only the last block pays for
/// its mask; what it reads beyond the row are numbers of other particles.
template <class Block>
SPHVERIFY_INLINE void for_each_block(Rows const& rows, std::size_t i, Block const& block) {
  std::uint32_t const* neighbour = rows.neighbour.data() + rows.first[i];
  std::size_t left = rows.first[i + 1] - rows.first[i];
  for (; left >= lanes; left -= lanes, neighbour += lanes)
    block(neighbour, [](Lanes u2) SPHVERIFY_INLINED { return u2; });
  if (left > 0) block(neighbour, [left](Lanes u2) SPHVERIFY_INLINED { return only_first(left, u2); });
}

// The cubic spline at u = r/h without branches, of the positive parts of 2 - u and 1 - u.

/// h^3 W / sigma
template <class Real>
SPHVERIFY_INLINE Real spline(Real outer, Real inner) {
  return 0.25 * (outer * outer * outer) - inner * inner * inner;
}
/// h^4 (dW/dr) / sigma
template <class Real>
SPHVERIFY_INLINE Real spline_slope(Real outer, Real inner) {
  return 3.0 * (inner * inner) - 0.75 * (outer * outer);
}

}  // namespace

// ---- lists ----------------------------------------------------------------------------------------------

void sort_into_cells(std::size_t n, double const* x, double const* y, double const* z, double reach,
                     Cells& cells) {
  std::array<double const*, 3> const position{x, y, z};
  std::array<double, 3> lower;
  std::array<double, 3> per_length;
  for (std::size_t k = 0; k < 3; ++k) {
    auto const [low, high] = std::minmax_element(position[k], position[k] + n);
    lower[k] = *low;
    double const extent = std::max(*high - *low, reach);
    cells.count[k] = static_cast<std::size_t>(extent / reach);
    per_length[k] = static_cast<double>(cells.count[k]) / extent;
  }
  auto const cell_along = [&](std::size_t k, std::size_t i) {
    // A signed conversion is one instruction.
    auto const c = static_cast<std::int32_t>((position[k][i] - lower[k]) * per_length[k]);
    return std::min(static_cast<std::size_t>(c), cells.count[k] - 1);
  };
  std::vector<std::uint32_t> cell(n);
  cells.first.assign(cells.count[0] * cells.count[1] * cells.count[2] + 1, 0);
  for (std::size_t i = 0; i < n; ++i) {
    std::size_t const c =
        (cell_along(2, i) * cells.count[1] + cell_along(1, i)) * cells.count[0] + cell_along(0, i);
    cell[i] = static_cast<std::uint32_t>(c);
    ++cells.first[c];
  }
  std::uint32_t start = 0;
  for (std::uint32_t& first : cells.first) start += std::exchange(first, start);

  // `first` serves as the place of each cell's next particle, and is one cell ahead afterwards.
  for (auto* const vector : {&cells.x, &cells.y, &cells.z}) vector->resize(n);
  cells.order.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    std::uint32_t const k = cells.first[cell[i]]++;
    cells.order[k] = static_cast<std::uint32_t>(i);
    cells.x[k] = x[i];
    cells.y[k] = y[i];
    cells.z[k] = z[i];
  }
  std::copy_backward(cells.first.begin(), cells.first.end() - 1, cells.first.end());
  cells.first.front() = 0;
}

namespace {

/// Calls run(begin, end) for the particles of the cells around cell (a, b, c): up to nine runs, ascending,
/// since the cells along x follow each other.
template <class Run>
void for_each_run(Cells const& cells, std::size_t a, std::size_t b, std::size_t c, Run const& run) {
  std::size_t const left = a - (a > 0 ? 1 : 0);
  std::size_t const right = std::min(a + 2, cells.count[0]);
  for (std::size_t k = c - (c > 0 ? 1 : 0); k < std::min(c + 2, cells.count[2]); ++k) {
    for (std::size_t j = b - (b > 0 ? 1 : 0); j < std::min(b + 2, cells.count[1]); ++j) {
      std::size_t const line = (k * cells.count[1] + j) * cells.count[0];
      run(cells.first[line + left], cells.first[line + right]);
    }
  }
}

/// Calls visit(a, b, c, begin, end) for each cell and its particles, in their order.
template <class Visit>
void for_each_cell(Cells const& cells, Visit const& visit) {
  std::size_t line = 0;
  for (std::size_t c = 0; c < cells.count[2]; ++c) {
    for (std::size_t b = 0; b < cells.count[1]; ++b, line += cells.count[0]) {
      for (std::size_t a = 0; a < cells.count[0]; ++a)
        visit(a, b, c, cells.first[line + a], cells.first[line + a + 1]);
    }
  }
}

/// Makes room for that many more neighbours, and for what is stored in whole vectors beyond the last.
void reserve_more(Rows& rows, std::size_t used, std::size_t more) {
  if (rows.neighbour.size() < used + more + lanes) rows.neighbour.resize(2 * (used + more) + lanes);
}

/// The last row's last block reads beyond it.
void end_with_valid_numbers(Rows& rows, std::size_t used) {
  reserve_more(rows, used, 0);
  std::fill_n(rows.neighbour.begin() + static_cast<std::ptrdiff_t>(used), lanes, 0u);
}

constexpr double far_away = 1e100;  // its square is still finite

/// Positions and numbers of possible neighbours. There is room for a vector's worth beyond the last.
struct Candidates {
  std::vector<double> x, y, z;
  std::vector<std::uint32_t> number;
  std::size_t size = 0;

  void reserve(std::size_t n) {
    if (number.size() >= n + lanes) return;
    for (auto* const vector : {&x, &y, &z}) vector->resize(2 * n + lanes);
    number.resize(2 * n + lanes);
  }
};

/// Writes the numbers of the candidates closer to a point than the root of `squared_reach`; returns their
/// end.
using AppendNear = std::uint32_t* (*)(Candidates const&, double x, double y, double z, double squared_reach,
                                      std::uint32_t* out);

std::uint32_t* append_near_portable(Candidates const& candidates, double x, double y, double z,
                                    double squared_reach, std::uint32_t* out) {
  for (std::size_t begin = 0; begin < candidates.size; begin += 64) {
    std::size_t const count = std::min<std::size_t>(64, candidates.size - begin);
    double squared[64];
    for (std::size_t k = 0; k < count; ++k) {
      double const dx = candidates.x[begin + k] - x;
      double const dy = candidates.y[begin + k] - y;
      double const dz = candidates.z[begin + k] - z;
      squared[k] = dx * dx + dy * dy + dz * dz;
    }
    for (std::size_t k = 0; k < count; ++k) {
      *out = candidates.number[begin + k];
      out += squared[k] < squared_reach ? 1 : 0;
    }
  }
  return out;
}

#if defined(__x86_64__)

/// For each set of lanes, the bytes of those lanes first.
struct CompressTable {
  alignas(16) std::uint8_t bytes[16][16];
};
constexpr CompressTable make_compress_table() {
  CompressTable table{};
  for (unsigned mask = 0; mask < 16; ++mask) {
    unsigned to = 0;
    for (unsigned from = 0; from < 4; ++from) {
      if ((mask >> from & 1) == 0) continue;
      for (unsigned byte = 0; byte < 4; ++byte)
        table.bytes[mask][4 * to + byte] = static_cast<std::uint8_t>(4 * from + byte);
      ++to;
    }
  }
  return table;
}
constexpr CompressTable compress_table = make_compress_table();

/// Four candidates at a time: their numbers are shuffled to the front and all four stored.
__attribute__((target("arch=x86-64-v3"))) std::uint32_t* append_near_avx2(Candidates const& candidates,
                                                                          double x, double y, double z,
                                                                          double squared_reach,
                                                                          std::uint32_t* out) {
  __m256d const px = _mm256_set1_pd(x);
  __m256d const py = _mm256_set1_pd(y);
  __m256d const pz = _mm256_set1_pd(z);
  __m256d const limit = _mm256_set1_pd(squared_reach);
  for (std::size_t k = 0; k < candidates.size; k += lanes) {
    __m256d const dx = _mm256_loadu_pd(&candidates.x[k]) - px;
    __m256d const dy = _mm256_loadu_pd(&candidates.y[k]) - py;
    __m256d const dz = _mm256_loadu_pd(&candidates.z[k]) - pz;
    __m256d const squared = dx * dx + dy * dy + dz * dz;
    unsigned const mask =
        static_cast<unsigned>(_mm256_movemask_pd(_mm256_cmp_pd(squared, limit, _CMP_LT_OQ)));
    __m128i const number = _mm_loadu_si128(reinterpret_cast<__m128i const*>(&candidates.number[k]));
    __m128i const bytes = _mm_load_si128(reinterpret_cast<__m128i const*>(compress_table.bytes[mask]));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(out), _mm_shuffle_epi8(number, bytes));
    out += _mm_popcnt_u32(mask);
  }
  return out;
}

AppendNear best_append_near() {
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("popcnt") ? append_near_avx2
                                                                            : append_near_portable;
}
#else
AppendNear best_append_near() { return append_near_portable; }
#endif

}  // namespace

void build_rows_scalar(Cells const& cells, double reach, Rows& rows) {
  rows.first.assign(1, 0);
  std::size_t used = 0;
  for_each_cell(cells, [&](std::size_t a, std::size_t b, std::size_t c, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      for_each_run(cells, a, b, c, [&](std::size_t from, std::size_t to) {
        reserve_more(rows, used, to - from);
        for (std::size_t j = from; j < to; ++j) {
          double const dx = cells.x[i] - cells.x[j];
          double const dy = cells.y[i] - cells.y[j];
          double const dz = cells.z[i] - cells.z[j];
          if (dx * dx + dy * dy + dz * dz < reach * reach && j != i)
            rows.neighbour[used++] = static_cast<std::uint32_t>(j);
        }
      });
      rows.first.push_back(used);
    }
  });
  end_with_valid_numbers(rows, used);
}

namespace {

void build_rows(Cells const& cells, double reach, Rows& rows, AppendNear append_near) {
  rows.first.assign(1, 0);
  std::size_t used = 0;
  Candidates candidates;
  for_each_cell(cells, [&](std::size_t a, std::size_t b, std::size_t c, std::size_t begin, std::size_t end) {
    candidates.size = 0;
    std::size_t self = 0;
    for_each_run(cells, a, b, c, [&](std::size_t from, std::size_t to) {
      candidates.reserve(candidates.size + (to - from));
      if (from <= begin && end <= to) self = candidates.size + (begin - from);
      for (std::size_t j = from; j < to; ++j) {
        candidates.x[candidates.size] = cells.x[j];
        candidates.y[candidates.size] = cells.y[j];
        candidates.z[candidates.size] = cells.z[j];
        candidates.number[candidates.size++] = static_cast<std::uint32_t>(j);
      }
    });
    std::fill_n(candidates.x.begin() + static_cast<std::ptrdiff_t>(candidates.size), lanes, far_away);
    for (std::size_t i = begin; i < end; ++i, ++self) {
      reserve_more(rows, used, candidates.size);
      std::uint32_t* const row = rows.neighbour.data() + used;
      double const x = std::exchange(candidates.x[self], far_away);  // no neighbour of itself
      std::uint32_t* const row_end = append_near(candidates, x, cells.y[i], cells.z[i], reach * reach, row);
      candidates.x[self] = x;
      used += static_cast<std::size_t>(row_end - row);
      rows.first.push_back(used);
    }
  });
  end_with_valid_numbers(rows, used);
}

}  // namespace

void build_rows_vectorised(Cells const& cells, double reach, Rows& rows) {
  build_rows(cells, reach, rows, best_append_near());
}
void build_rows_portable(Cells const& cells, double reach, Rows& rows) {
  build_rows(cells, reach, rows, append_near_portable);
}

// ---- conduction -----------------------------------------------------------------------------------------

SPHVERIFY_CLONES
void conduction_scalar(Rows const& rows, Conduction const& in, double* q) {
  double const per_h = 1.0 / in.h;
  double const scale = sigma * std::pow(per_h, 5);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double sum = 0.0;
    for (std::size_t k = rows.first[i]; k < rows.first[i + 1]; ++k) {
      std::uint32_t const j = rows.neighbour[k];
      double const dx = in.x[i] - in.x[j];
      double const dy = in.y[i] - in.y[j];
      double const dz = in.z[i] - in.z[j];
      double const u = std::sqrt(dx * dx + dy * dy + dz * dz) * per_h;
      double const slope = spline_slope(std::max(2.0 - u, 0.0), std::max(1.0 - u, 0.0));
      sum += in.m[j] * (in.K[i] + in.K[j]) * (in.T[i] - in.T[j]) * slope / (in.rho[j] * u);
    }
    q[i] = scale * sum / in.rho[i];
  }
}

SPHVERIFY_CLONES
void conduction_gathered(Rows const& rows, Conduction const& in, double* q) {
  double const per_h = 1.0 / in.h;
  double const scale = sigma * std::pow(per_h, 5);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double sum = 0.0;
    std::uint32_t const* const neighbour = rows.neighbour.data();
    double const xi = in.x[i], yi = in.y[i], zi = in.z[i], Ki = in.K[i], Ti = in.T[i];
#pragma omp simd reduction(+ : sum)
    for (std::size_t k = rows.first[i]; k < rows.first[i + 1]; ++k) {
      std::uint32_t const j = neighbour[k];
      double const dx = xi - in.x[j];
      double const dy = yi - in.y[j];
      double const dz = zi - in.z[j];
      double const u = std::sqrt(dx * dx + dy * dy + dz * dz) * per_h;
      double const outer = 2.0 - u > 0.0 ? 2.0 - u : 0.0;
      double const inner = 1.0 - u > 0.0 ? 1.0 - u : 0.0;
      sum += in.m[j] * (Ki + in.K[j]) * (Ti - in.T[j]) * spline_slope(outer, inner) / (in.rho[j] * u);
    }
    q[i] = scale * sum / in.rho[i];
  }
}

namespace {

/// Fields that the pair loop needs side by side, six of eight numbers: one record is one line of cache.
SPHVERIFY_INLINE void pack(Rows const& rows, Conduction const& in, std::vector<double>& records) {
  records.resize(8 * rows.size());
  double const per_h = 1.0 / in.h;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double* const record = records.data() + 8 * i;
    record[0] = in.x[i] * per_h;
    record[1] = in.y[i] * per_h;
    record[2] = in.z[i] * per_h;
    record[3] = in.K[i];
    record[4] = in.T[i];
    record[5] = in.m[i] / in.rho[i];
  }
}

}  // namespace

SPHVERIFY_CLONES
void conduction_vectorised(Rows const& rows, Conduction const& in, std::vector<double>& records, double* q) {
  pack(rows, in, records);
  double const scale = sigma * std::pow(in.h, -5);
  double const* const all_records = records.data();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double const* const own = all_records + 8 * i;
    Lanes sum = all(0.0);
    for_each_block(rows, i, [&](std::uint32_t const* neighbour, auto const& inside) SPHVERIFY_INLINED {
      double const* const record[lanes] = SPHVERIFY_RECORDS(8);
      Lanes x, y, z, K, T, volume;
      load_columns(record, 0, x, y);
      load_columns(record, 2, z, K);
      load_columns(record, 4, T, volume);
      Lanes const dx = own[0] - x;
      Lanes const dy = own[1] - y;
      Lanes const dz = own[2] - z;
      Lanes const u = root(inside(dx * dx + dy * dy + dz * dz));
      Lanes const slope = spline_slope(positive_part(2.0 - u), positive_part(1.0 - u));
      Lanes const per_u = 1.0 / u;  // divides while the slope is made, unlike slope / u
      sum += volume * (own[3] + K) * (own[4] - T) * (slope * per_u);
    });
    q[i] = scale * total(sum) / in.rho[i];
  }
}

// ---- density --------------------------------------------------------------------------------------------

SPHVERIFY_CLONES
void density_scalar(Rows const& rows, Density const& in, double* rho) {
  double const per_h = 1.0 / in.h;
  double const scale = sigma * per_h * per_h * per_h;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double sum = in.m[i];
    for (std::size_t k = rows.first[i]; k < rows.first[i + 1]; ++k) {
      std::uint32_t const j = rows.neighbour[k];
      double const dx = in.x[i] - in.x[j];
      double const dy = in.y[i] - in.y[j];
      double const dz = in.z[i] - in.z[j];
      double const u = std::sqrt(dx * dx + dy * dy + dz * dz) * per_h;
      sum += in.m[j] * spline(std::max(2.0 - u, 0.0), std::max(1.0 - u, 0.0));
    }
    rho[i] = scale * sum;
  }
}

SPHVERIFY_CLONES
void density_vectorised(Rows const& rows, Density const& in, std::vector<double>& records, double* rho) {
  double const per_h = 1.0 / in.h;
  records.resize(4 * rows.size() + lanes);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double* const record = records.data() + 4 * i;
    record[0] = in.x[i] * per_h;
    record[1] = in.y[i] * per_h;
    record[2] = in.z[i] * per_h;
    record[3] = in.m[i];
  }
  double const scale = sigma * per_h * per_h * per_h;
  double const* const all_records = records.data();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double const* const own = all_records + 4 * i;
    Lanes sum = all(0.0);
    for_each_block(rows, i, [&](std::uint32_t const* neighbour, auto const& inside) SPHVERIFY_INLINED {
      double const* const record[lanes] = SPHVERIFY_RECORDS(4);
      Lanes x, y, z, m;
      load_columns(record, 0, x, y);
      load_columns(record, 2, z, m);
      Lanes const dx = own[0] - x;
      Lanes const dy = own[1] - y;
      Lanes const dz = own[2] - z;
      Lanes const u = root(inside(dx * dx + dy * dy + dz * dz));
      sum += m * spline(positive_part(2.0 - u), positive_part(1.0 - u));
    });
    rho[i] = scale * (in.m[i] + total(sum));
  }
}

// ---- Euler ----------------------------------------------------------------------------------------------

SPHVERIFY_CLONES
void euler_scalar(Rows const& rows, Euler const& in, EulerRates const& out) {
  double const h = in.h;
  double const scale = sigma / (h * h * h * h);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double ax = 0.0, ay = 0.0, az = 0.0, work = 0.0;
    double const own_pressure = in.P[i] / (in.rho[i] * in.rho[i]);
    for (std::size_t k = rows.first[i]; k < rows.first[i + 1]; ++k) {
      std::uint32_t const j = rows.neighbour[k];
      double const dx = in.x[i] - in.x[j];
      double const dy = in.y[i] - in.y[j];
      double const dz = in.z[i] - in.z[j];
      double const r2 = dx * dx + dy * dy + dz * dz;
      double const r = std::sqrt(r2);
      double const approach =
          dx * (in.vx[i] - in.vx[j]) + dy * (in.vy[i] - in.vy[j]) + dz * (in.vz[i] - in.vz[j]);
      double const mu = h * std::min(approach, 0.0) / (r2 + 0.01 * h * h);
      double const viscous =
          (-0.5 * in.alpha * (in.c[i] + in.c[j]) + in.beta * mu) * mu / (0.5 * (in.rho[i] + in.rho[j]));
      double const pressure = in.P[j] / (in.rho[j] * in.rho[j]);
      double const u = r / h;
      double const slope = scale * spline_slope(std::max(2.0 - u, 0.0), std::max(1.0 - u, 0.0));
      double const weight = in.m[j] * slope / r;
      double const force = (own_pressure + pressure + viscous) * weight;
      ax -= force * dx;
      ay -= force * dy;
      az -= force * dz;
      work += (pressure + 0.5 * viscous) * weight * approach;
    }
    out.ax[i] = ax;
    out.ay[i] = ay;
    out.az[i] = az;
    out.u[i] = work;
  }
}

namespace {

/// Ten of twelve numbers.
SPHVERIFY_INLINE void pack(Rows const& rows, Euler const& in, std::vector<double>& records) {
  records.resize(12 * rows.size());
  double const per_h = 1.0 / in.h;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double* const record = records.data() + 12 * i;
    record[0] = in.x[i] * per_h;
    record[1] = in.y[i] * per_h;
    record[2] = in.z[i] * per_h;
    record[3] = in.vx[i];
    record[4] = in.vy[i];
    record[5] = in.vz[i];
    record[6] = in.P[i] / (in.rho[i] * in.rho[i]);
    record[7] = in.rho[i];
    record[8] = in.c[i];
    record[9] = in.m[i];
  }
}

}  // namespace

SPHVERIFY_CLONES
void euler_vectorised(Rows const& rows, Euler const& in, std::vector<double>& records,
                      EulerRates const& out) {
  pack(rows, in, records);
  double const scale = sigma * std::pow(in.h, -4);
  double const alpha = in.alpha;
  double const twice_beta = 2.0 * in.beta;
  double const* const all_records = records.data();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double const* const own = all_records + 12 * i;
    Lanes ax = all(0.0), ay = all(0.0), az = all(0.0), work = all(0.0);
    for_each_block(rows, i, [&](std::uint32_t const* neighbour, auto const& inside) SPHVERIFY_INLINED {
      double const* const record[lanes] = SPHVERIFY_RECORDS(12);
      Lanes x, y, z, vx, vy, vz, pressure, rho, c, m;
      load_columns(record, 0, x, y);
      load_columns(record, 2, z, vx);
      load_columns(record, 4, vy, vz);
      load_columns(record, 6, pressure, rho);
      load_columns(record, 8, c, m);
      Lanes const dx = own[0] - x;
      Lanes const dy = own[1] - y;
      Lanes const dz = own[2] - z;
      Lanes const approach = dx * (own[3] - vx) + dy * (own[4] - vy) + dz * (own[5] - vz);
      Lanes const u2 = inside(dx * dx + dy * dy + dz * dz);
      Lanes const u = root(u2);
      // mu = closing/softened; one division serves 1/u and Pi's 1/(softened^2 rho).
      Lanes const softened = u2 + 0.01;
      Lanes const closing = negative_part(approach);
      Lanes const divisor = softened * softened * (own[7] + rho);
      Lanes const quotient = 1.0 / (u * divisor);
      Lanes const viscous =
          closing * (twice_beta * closing - alpha * (own[8] + c) * softened) * (quotient * u);
      Lanes const slope = spline_slope(positive_part(2.0 - u), positive_part(1.0 - u));
      Lanes const weight = m * slope * (quotient * divisor);
      Lanes const force = (own[6] + pressure + viscous) * weight;
      ax -= force * dx;
      ay -= force * dy;
      az -= force * dz;
      work += (pressure + 0.5 * viscous) * weight * approach;
    });
    out.ax[i] = scale * total(ax);
    out.ay[i] = scale * total(ay);
    out.az[i] = scale * total(az);
    out.u[i] = scale * total(work);
  }
}

// ---- stored weights -------------------------------------------------------------------------------------

SPHVERIFY_CLONES
void stored_scalar(Rows const& rows, double const* weight, double const* T, double* q) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double sum = 0.0;
    for (std::size_t k = rows.first[i]; k < rows.first[i + 1]; ++k)
      sum += weight[k] * (T[i] - T[rows.neighbour[k]]);
    q[i] = sum;
  }
}

SPHVERIFY_CLONES
void stored_vectorised(Rows const& rows, double const* weight, double const* T, double* q) {
  std::uint32_t const* const neighbour = rows.neighbour.data();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double const own = T[i];
    std::size_t const end = rows.first[i + 1];
    std::size_t k = rows.first[i];
    Lanes sum = all(0.0);
    for (; k + lanes <= end; k += lanes) {
      Lanes const there{T[neighbour[k]], T[neighbour[k + 1]], T[neighbour[k + 2]], T[neighbour[k + 3]]};
      sum += load(weight + k) * (own - there);
    }
    double rest = 0.0;
    for (; k < end; ++k) rest += weight[k] * (own - T[neighbour[k]]);
    q[i] = total(sum) + rest;
  }
}

SPHVERIFY_CLONES
void stored_gathered(Rows const& rows, double const* weight, double const* T, double* q) {
  std::uint32_t const* const neighbour = rows.neighbour.data();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double const own = T[i];
    double sum = 0.0;
#pragma omp simd reduction(+ : sum)
    for (std::size_t k = rows.first[i]; k < rows.first[i + 1]; ++k)
      sum += weight[k] * (own - T[neighbour[k]]);
    q[i] = sum;
  }
}

// ---- memory ---------------------------------------------------------------------------------------------

SPHVERIFY_CLONES
void triad(std::size_t n, double s, double const* b, double const* c, double* a) {
#pragma omp simd
  for (std::size_t k = 0; k < n; ++k) a[k] = b[k] + s * c[k];
}

SPHVERIFY_CLONES
double sum(std::size_t n, double const* a) {
  double total = 0.0;
#pragma omp simd reduction(+ : total)
  for (std::size_t k = 0; k < n; ++k) total += a[k];
  return total;
}

}  // namespace sphverify::bench::hand_written
