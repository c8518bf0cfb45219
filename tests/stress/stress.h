/* tests/stress/stress.h - what the families of random trials share. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TESTS_STRESS_STRESS_H
#define LENSCALC_TESTS_STRESS_STRESS_H

#include "base/arena.h"

#include <stdbool.h>
#include <stdint.h>

/*
 * A trial is one random case of a family: all that it draws follows from the seed, the family's
 * name and its number, so that it can be had again alone. It tells the driver of figures, whose
 * errors are counted in ulp (2^-53 of the figure) over the condition, and of verdicts, which are
 * right or wrong.
 */
struct trial {
    uint64_t state;
    unsigned long number;
    const char *build;  /* the folder with lenscalc */
    struct arena arena; /* given up after the trial */
    const char *about;  /* what is tried, for whoever repairs it; null = nothing said yet */
    struct tally *tally;
};

/* 0 .. 1; between two numbers; the same evenly in the logarithm; whole numbers low .. high. */
double trial_draw(struct trial *trial);
double trial_between(struct trial *trial, double low, double high);
double trial_magnitude(struct trial *trial, double low, double high);
bool trial_chance(struct trial *trial, double share);
double trial_sign(struct trial *trial);
int trial_whole(struct trial *trial, int low, int high);

/*
 * A figure that is off.
 *
 * Given     off          |figure - truth|
 *           size         |truth|
 *           sensitivity  what the figure changes when each number that it follows from is moved by
 *                        its own size, added up; 0: the figure itself is its condition
 */
void trial_figure(struct trial *trial, const char *what, double off, double size,
                  double sensitivity);

/* Is it so near that nobody has to ask for the sensitivity? It counts as a good figure then. */
bool trial_is_near(struct trial *trial, double off, double size);

/* Right or wrong; the form says how. */
bool trial_verdict(struct trial *trial, bool is_right, const char *form, ...)
    __attribute__((format(printf, 3, 4)));

/* Nothing was tried: what was drawn cannot be, or the truth is not known. */
void trial_skip(struct trial *trial);

/* A family, in the table of stress.c. */
typedef void family_try(struct trial *trial);
family_try try_ordinary_paraxial, try_scales_paraxial, try_flat_paraxial, try_afocal_paraxial,
    try_long_paraxial, try_seidel;
family_try try_rays, try_derivatives, try_paths;
family_try try_bent_rays, try_bent_derivatives, try_bent_paths;
family_try try_chief, try_aim;
family_try try_spot, try_clipped;
family_try try_zernike, try_zernike_fit, try_fft;
family_try try_photography, try_depth_of_field;
family_try try_nist;
family_try try_scene;
family_try try_numbers, try_aspheres, try_wild_aspheres, try_merit;

#endif
