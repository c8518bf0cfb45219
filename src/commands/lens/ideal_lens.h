/* commands/lens/ideal_lens.h - thin lenses and spherical mirrors as options say them. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_LENS_IDEAL_LENS_H
#define LENSCALC_COMMANDS_LENS_IDEAL_LENS_H

#include "optics/lens.h"
#include "optics/thin_lens.h"

#include <stdbool.h>

struct word;

enum ideal_mirror { MIRROR_NONE, MIRROR_CONCAVE, MIRROR_CONVEX, MIRROR_PLANE };
extern const struct word ideal_mirrors[];

/* A thin lens, or a mirror, and the thin lenses behind it. NaN, null = not given. */
struct ideal_question {
    double focal;  /* mm; below 0 diverging; of a convex mirror with either sign */
    double power;  /* 1/mm, in its place */
    double radius; /* of a mirror, mm; a size */
    const char *then;
    const char *lenses; /* focal lengths and gaps in turn, in place of `focal` and `then` */
    int mirror;         /* enum ideal_mirror */
};

/* Is a list of lenses as --then takes it: "gap 14cm, f -9.5cm"? For option.accepts. */
bool ideal_lens_accepts(const char *then, struct error *error);

/* Is a list as --lenses takes it: "25cm,16.5cm,25cm", lens, gap, lens? For option.accepts. */
bool ideal_lenses_accept(const char *lenses, struct error *error);

/*
 * The lens that is asked for: ideal thin lenses, in air, or a mirror in its vertex.
 *
 * Given     given  from which a focal length follows that is not asked for by its number
 *           lens   receives it, in the arena
 * Errors    ERROR_USAGE, ERROR_DOMAIN: numbers that contradict each other; as thin_lens_power
 */
bool ideal_lens_make(const struct ideal_question *question, const struct thin_lens_given *given,
                     struct arena *arena, const struct lens **lens, struct error *error);

/* One of its lenses alone, between the media that it stands in. */
const struct lens *ideal_lens_alone(const struct lens *lens, size_t index, struct arena *arena);

#endif
