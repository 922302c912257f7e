/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A plug-in that says of itself, and answers, what the test has put into it before (tests/fuzz/targets/plugin.cpp). */
#include <string.h>

#include "sphverify/plugin.h"

int fuzz_abi = SPHVERIFY_PLUGIN_ABI;
sphverify_description fuzz_description;
int fuzz_status = 0;
/* Numbers that stand for the rates, one after the other and again from the first. */
double fuzz_rates[64];
int fuzz_rate_count = 0;
int fuzz_writes_walls = 0;

static int next = 0;

static double one(void) {
  if (fuzz_rate_count == 0) return 0.0;
  next = (next + 1) % fuzz_rate_count;
  return fuzz_rates[next];
}

int sphverify_plugin_abi(void) { return fuzz_abi; }

void sphverify_plugin_describe(sphverify_description* description) {
  memcpy(description, &fuzz_description, sizeof fuzz_description);
}

int sphverify_plugin_rates(sphverify_state const* state, sphverify_rates* rates) {
  next = 0;
  for (int k = 0; k < 3; ++k) {
    for (size_t i = 0; rates->pairs[k] && i < state->count; ++i) rates->pairs[k][i] = one();
  }
  for (size_t w = 0; fuzz_writes_walls && w < state->walls; ++w) {
    for (int k = 0; k < 3; ++k) {
      if (!rates->wall[w][k]) continue;
      for (size_t c = 0; c < state->wall[w].contacts; ++c) rates->wall[w][k][state->wall[w].particle[c]] = one();
      if (fuzz_writes_walls > 1 && state->count > 0) rates->wall[w][k][state->count - 1] = one();
    }
  }
  return fuzz_status;
}
