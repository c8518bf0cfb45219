/* design/tolerance/perturbed.h - a lens as it was made: its numbers and their errors. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_TOLERANCE_PERTURBED_H
#define LENSCALC_DESIGN_TOLERANCE_PERTURBED_H

#include "design/tolerance/irregularity.h"
#include "design/tolerance/perturbation.h"
#include "optics/lens_numbers.h"
#include "optics/medium.h"

/* A number that perturbations add to, and their sum. */
struct perturbed_number {
    struct parameter what;
    double sum;
};

/* An element, or a group, that is shifted and turned as one piece: about x, then about its y. */
struct perturbed_motion {
    size_t first, last;
    double pivot;    /* mm from the vertex of `first` */
    double shift[2]; /* mm */
    double tilt[2];  /* rad */
};

/* How a surface stands beside its nominal place: by its own displacement, and by motions. */
struct perturbed_pose {
    double decenter[2], tilt[3]; /* its own, as files have them */
    double z;                    /* what thicknesses do not say, mm */
};

/* Which lens, and what may be wrong with it; all of it must outlive its use. */
struct perturbed_question {
    const struct lens *lens; /* in all positions, `focus table` */
    const struct perturbation *list;
    size_t count;
    struct lens_numbers *lenses; /* one a position, opened with that of the lens */
};

struct perturbed {
    const struct lens *lens;
    const struct lens **at; /* one a position */
    const struct perturbation *list;
    size_t count;
    struct lens_numbers *lenses;
    size_t position_count;
    struct perturbed_number *numbers;
    size_t number_count;
    struct perturbed_motion *motions;
    size_t motion_count;
    size_t *target;     /* of each perturbation: its number, motion or medium; LENS_NONE: none */
    struct melt *melts; /* surface_count + 1 a position, object space first: those that change */
    double (*off)[2];   /* of their nd and Vd */
    bool *is_melted, *is_posed; /* of spaces; of surfaces */
    struct perturbed_pose *poses;
};

/* What was melted in place of the medium of a space, object space first. */
static inline struct melt *perturbed_melt(const struct perturbed *perturbed, size_t position,
                                          size_t space)
{
    return &perturbed->melts[position * (perturbed->lens->surface_count + 1) + space];
}

/*
 * Make ready.
 *
 * Errors    ERROR_DOMAIN: an element with a coordinate break within; Vd of a medium that has none
 */
bool perturbed_open(const struct perturbed_question *question, struct arena *arena,
                    struct perturbed *perturbed, struct error *error);

/* Somebody else sets this thickness, decentre or tilt from one perturbed_put to the next, which is
   to find it as it was. */
void perturbed_keep(struct perturbed *perturbed, struct parameter what);

/*
 * The lens with these errors.
 *
 * Given     errors  one a perturbation, in units of its half range
 * Result    in perturbed->lenses. Where all are 0 they are the lens itself, to the bit. There is no
 *           irregularity: surfaces have no number for it
 * Formula   errors of one number add up. An element turns by R = Rx(ax) Ry(ay) about its pivot: a
 *           vertex at v goes to P + R (v - P) + shift, its axes to R M. Motions follow each other
 *           in the order of the list. A vertex that goes along z changes the thicknesses before and
 *           behind it; so that of the first surface carries the frame with it
 * Limits    the roll about its own axis that two tilts make is left out of round surfaces. A
 *           finite object, which is counted from the first vertex, goes along the axis with it:
 *           by z (1 - cos) of the distance z from the pivot, 1e-7 mm of 3 mm and an arc minute
 */
void perturbed_put(struct perturbed *perturbed, const double *errors);

/* Perturbations that are deformations of a surface. */
struct perturbed_forms {
    struct irregularity *list;
    size_t *from; /* of each its perturbation */
    size_t count;
};

/* Errors    ERROR_DOMAIN: a surface without a diameter for one to be over */
bool perturbed_forms_of(const struct lens *lens, const struct perturbation *list, size_t count,
                        struct arena *arena, struct perturbed_forms *forms, struct error *error);

/* What a small error changes first: numbers of the lens, and how fast. */
struct perturbed_link {
    struct parameter what; /* of a thickness also a word of the positions */
    double slope;          /* per unit of the half range */
};

/*
 * The numbers of the nominal lens that a perturbation changes.
 *
 * Given     links  receives them: 2 * surface_count at most
 * Result    how many; of an irregularity 0
 */
size_t perturbed_links(const struct perturbed *perturbed, size_t perturbation,
                       struct perturbed_link *links);

/* -------- design/tolerance/perturbed_write.c -------- */

/*
 * The lens as perturbed->lenses have it now, to be written, with all its positions.
 *
 * Given     wavelengths  um: those that the index of a catalogue's glass is written at
 * Result    without pick-ups: what was made follows nothing. A word of the positions that no longer
 *           holds for a cell gives way to one of its own; what differs between positions is set by
 *           them
 */
struct lens *perturbed_lens(struct perturbed *perturbed, const double *wavelengths,
                            size_t wavelength_count, struct arena *arena);

#endif
