// SPDX-License-Identifier: 0BSD
/* A formulation of yours, in a shared library of any language, for sphverify to judge.
 *
 * The library exports three functions with C linkage:
 *
 *   int  sphverify_plugin_abi(void);                       the SPHVERIFY_PLUGIN_ABI that it was compiled with
 *   void sphverify_plugin_describe(sphverify_description*);  what it computes, and from what
 *   int  sphverify_plugin_rates(sphverify_state const*, sphverify_rates*);  0, or else what went wrong
 *
 * In a study it is {"id": "plugin/NAME", "library": "path/to/lib.so"}; `sphverify evaluate --plugin lib.so` lists its rates.
 * All numbers are in one coherent system of units, SI for instance. Arrays of vectors come component by component: component
 * k of the velocity of particle i is velocity[k][i], and pointers beyond `dimension` are null, as are fields not asked for.
 * Examples in C and in Fortran: examples/plugin-c, examples/plugin-fortran.
 */
#ifndef SPHVERIFY_PLUGIN_H
#define SPHVERIFY_PLUGIN_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define SPHVERIFY_PLUGIN_ABI 1

/* What is computed, and so what it is compared with. */
enum sphverify_rate {
  SPHVERIFY_ACCELERATION = 0,      /* dv/dt  [m/s^2] */
  SPHVERIFY_INTERNAL_WORK = 1,     /* de/dt of compression  [W/kg] */
  SPHVERIFY_TOTAL_WORK = 2,        /* d(e + v^2/2)/dt of pressure forces  [W/kg] */
  SPHVERIFY_CONDUCTION_HEATING = 3 /* de/dt of heat conduction  [W/kg] */
};

/* What is read of particles, beside position and mass, and at walls: bits to add up. */
#define SPHVERIFY_DENSITY 1
#define SPHVERIFY_VELOCITY 2
#define SPHVERIFY_PRESSURE 4
#define SPHVERIFY_TEMPERATURE 8
#define SPHVERIFY_CONDUCTIVITY 16
#define SPHVERIFY_SOUND_SPEED 32 /* of particles only */
#define SPHVERIFY_FLUX 64        /* at walls that prescribe it */

/* What is conserved between particles, to round-off: bits to add up. */
#define SPHVERIFY_CONSERVES_MOMENTUM 1
#define SPHVERIFY_CONSERVES_ENERGY 2 /* of an acceleration: together with its work_partner */

/* Filled by sphverify_plugin_describe; it comes filled with zeros. Texts end with a zero. */
typedef struct sphverify_description {
  char name[64];          /* NAME of plugin/NAME: words of a-z and 0-9, joined by - */
  char title[160];        /* one line for lists */
  char source[160];       /* citation */
  char equation[480];     /* in plain text */
  char work_partner[64];  /* of an acceleration: the identifier of its energy equation, as work/internal-energy */
  int32_t rate;           /* enum sphverify_rate */
  int32_t reads;          /* of particles */
  int32_t reads_at_walls; /* prescribed by a wall, or what the study's closure says */
  int32_t conserves;
  int32_t wants_neighbours; /* 1: our list of neighbours; 0: you search yourself */
  int32_t passes;           /* how far it sees, in supports: 1, or 2 if a sum is summed again; 0 counts as 1 */
  int32_t thread_safe;      /* 1: several threads may call it for different scenes at once */
} sphverify_description;

/* A plane wall: the fluid lies opposite to its outward normal. `contacts` particles are within the kernel's support of it;
 * arrays have one entry per contact. Values belong to the foot point, the point of the wall nearest to the particle. */
typedef struct sphverify_wall {
  double point[3];          /* any of the plane  [m] */
  double outward_normal[3]; /* of unit length */
  int32_t prescribes;       /* bits as above; what is not among them is the closure's value */
  size_t contacts;
  uint32_t const* particle;     /* ascending */
  double const* distance;       /* to the plane  [m] */
  double const* face_weight;    /* integral of the kernel over the wall  [1/m] */
  double const* foot_density;   /* the kernel's sum of masses at the foot point, doubled at a plane wall  [kg/m^3] */
  double const* pressure;       /* these are null unless asked for; the density at the wall is above */
  double const* temperature;
  double const* conductivity;
  double const* velocity[3];
  double const* flux[3];        /* of heat  [W/m^2]; null unless the wall prescribes it */
} sphverify_wall;

typedef struct sphverify_state {
  int32_t dimension; /* 1, 2 or 3 */
  size_t count;      /* particles */
  double time;       /* [s] */
  char const* kernel;          /* identifier, as cubic-spline */
  double support_ratio;        /* support / smoothing length */
  double smoothing_length;     /* h  [m] */
  double const* smoothing_lengths; /* of every particle; null where all have the one above */
  double const* position[3];
  double const* mass;
  double const* density;
  double const* pressure;
  double const* temperature;
  double const* conductivity;
  double const* sound_speed;
  double const* velocity[3];
  double lower[3], upper[3];   /* the box  [m], along its own axes */
  int32_t periodic[3];         /* 1 where its two sides are the same place */
  double axes[9];              /* the box's axes as unit vectors, one after the other: those of space unless it is turned */
  size_t const* first;         /* count + 1 offsets into neighbour; null unless asked for */
  uint32_t const* neighbour;   /* of particle i: neighbour[first[i]] to neighbour[first[i + 1] - 1], itself not among them;
                                  may hold pairs that are not within the support yet */
  size_t walls;                /* none in the control without wall terms */
  sphverify_wall const* wall;
} sphverify_state;

/* To be filled; all of it comes filled with zeros. The harness adds the walls' parts to the pairs': only so it knows what
 * crossed the walls. Particles that are no contact of a wall must have zero for it. */
typedef struct sphverify_rates {
  double* pairs[3];        /* of every particle; one component where the rate is a number */
  double* const (*wall)[3]; /* wall[w][k][i]: what wall w adds to component k of particle i */
} sphverify_rates;

int sphverify_plugin_abi(void);
void sphverify_plugin_describe(sphverify_description* description);
int sphverify_plugin_rates(sphverify_state const* state, sphverify_rates* rates);

#ifdef __cplusplus
}
#endif

#endif
