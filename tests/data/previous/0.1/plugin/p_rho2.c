// SPDX-License-Identifier: 0BSD
/* A momentum form in C: Campbell's pressure gradient (Campbell 1989, Eqs. 11, 68, 82) with the cubic spline, as a code of
 * one's own would have it. sphverify has the same as momentum/p-rho2: rates must agree to round-off.
 *
 *   cc -O2 -fPIC -shared p_rho2.c -o libp_rho2.so -lm      (-I PREFIX/include where sphverify is not in /usr)
 *   sphverify evaluate state.json --plugin ./libp_rho2.so
 */
#include <math.h>
#include <string.h>

#include "sphverify/plugin.h"

int sphverify_plugin_abi(void) { return SPHVERIFY_PLUGIN_ABI; }

void sphverify_plugin_describe(sphverify_description* d) {
  strcpy(d->name, "p-rho2-in-c");
  strcpy(d->title, "Pressure gradient symmetrised as P/rho^2, in C");
  strcpy(d->source, "Campbell 1989, Eqs. 11, 68, 82");
  strcpy(d->equation,
         "a_i = -sum_j m_j (P_j/rho_j^2 + P_i/rho_i^2) grad_i W_ij - (P_B/rho_B^2 + P_i/rho_i^2) rho_B S_i");
  strcpy(d->work_partner, "work/internal-energy");
  d->rate = SPHVERIFY_ACCELERATION;
  d->reads = SPHVERIFY_DENSITY + SPHVERIFY_PRESSURE;
  d->reads_at_walls = SPHVERIFY_PRESSURE;
  d->conserves = SPHVERIFY_CONSERVES_MOMENTUM + SPHVERIFY_CONSERVES_ENERGY;
  d->wants_neighbours = 1;
  d->thread_safe = 1;
}

/* (dW/dr)/r of the cubic spline (Monaghan & Lattanzio 1985). */
static double slope(double r, double h, int dimension) {
  double const pi = 3.14159265358979323846;
  double const sigma = dimension == 1 ? 2.0 / 3.0 : dimension == 2 ? 10.0 / (7.0 * pi) : 1.0 / pi;
  double const q = r / h;
  double const scale = sigma / pow(h, dimension + 2);
  if (q < 1.0) return scale * (-3.0 + 2.25 * q);
  if (q < 2.0) return scale * -0.75 * (2.0 - q) * (2.0 - q) / q;
  return 0.0;
}

int sphverify_plugin_rates(sphverify_state const* s, sphverify_rates* rates) {
  if (strcmp(s->kernel, "cubic-spline") != 0 || s->smoothing_lengths) return 1; /* this code has no other */
  int const dimension = s->dimension;
  for (size_t i = 0; i < s->count; ++i) {
    double const own = s->pressure[i] / (s->density[i] * s->density[i]);
    for (size_t n = s->first[i]; n < s->first[i + 1]; ++n) {
      size_t const j = s->neighbour[n];
      double r_ij[3] = {0.0, 0.0, 0.0};
      for (int k = 0; k < dimension; ++k) r_ij[k] = s->position[k][i] - s->position[k][j];
      /* The nearest periodic image, along the box's own axes. */
      for (int axis = 0; axis < dimension; ++axis) {
        if (!s->periodic[axis]) continue;
        double const period = s->upper[axis] - s->lower[axis];
        double along = 0.0;
        for (int k = 0; k < dimension; ++k) along += s->axes[axis * dimension + k] * r_ij[k];
        for (int k = 0; k < dimension; ++k) r_ij[k] -= period * round(along / period) * s->axes[axis * dimension + k];
      }
      double const r = sqrt(r_ij[0] * r_ij[0] + r_ij[1] * r_ij[1] + r_ij[2] * r_ij[2]);
      double const strength = s->mass[j] * (s->pressure[j] / (s->density[j] * s->density[j]) + own) *
                              slope(r, s->smoothing_length, dimension);
      for (int k = 0; k < dimension; ++k) rates->pairs[k][i] -= strength * r_ij[k];
    }
  }
  for (size_t w = 0; w < s->walls; ++w) {
    sphverify_wall const* const wall = &s->wall[w];
    for (size_t c = 0; c < wall->contacts; ++c) {
      size_t const i = wall->particle[c];
      double const rho_B = wall->foot_density[c];
      double const strength =
          (wall->pressure[c] / (rho_B * rho_B) + s->pressure[i] / (s->density[i] * s->density[i])) * rho_B *
          wall->face_weight[c];
      for (int k = 0; k < dimension; ++k) rates->wall[w][k][i] -= strength * wall->outward_normal[k];
    }
  }
  return 0;
}
