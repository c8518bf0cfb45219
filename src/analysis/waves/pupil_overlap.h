/* analysis/waves/pupil_overlap.h - a pupil laid over itself: transfer at one frequency. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_WAVES_PUPIL_OVERLAP_H
#define LENSCALC_ANALYSIS_WAVES_PUPIL_OVERLAP_H

#include "analysis/waves/pupil_wave.h"

/* A point of the edge, and how it moves with its angle. */
struct pupil_edge {
    double turn;                                     /* of the angle */
    double cosine[PUPIL_ORDERS], sine[PUPIL_ORDERS]; /* of m times the angle */
    double at[2], slope[2], bend[2];                 /* by radians */
};

/*
 * What mirrors leave to be done: where the pupil is its own image in a mirror along the shift, half
 * of the lines; in one across it, half of each line, and no imaginary part.
 */
struct pupil_mirrors {
    bool along, across;
};

/* One pupil and one shift; looked at again and again. */
struct pupil_overlap {
    struct pupil_wave *wave;
    double shift[2]; /* of direction cosines: given */
    double re, im;   /* receive the sum */
    bool is_empty;   /* beyond the cut-off: there is none */
    double cutoff;   /* the longest shift along this one that has an overlap, in such */
    /* internal */
    struct pupil_mirrors mirrors;
    size_t lines, each, count, room;            /* points: `each` of a line */
    double *angles, *angle_weights;             /* shares of the way from corner to corner */
    double *nodes, *weights;                    /* of a line, from left to right */
    double moved[2];                            /* the shift in places */
    struct pupil_edge corners[2][2], *edges[2]; /* right and left */
    double *x, *y, *weight, *value[2], *slope[2][2], *part[2]; /* twice `room`: both places */
    double *by_value[2], *by_place[2];
};

/*
 * As many as see the wave front as well as the rays of its rings do. More rays are for steeper
 * ones, which turn the phase many times along a line: so many take the time of the least squares.
 */
size_t pupil_overlap_lines(const struct pupil_form *form);

/* Given     lines  so many, of as many points each, where nothing mirrors */
void pupil_overlap_open(struct pupil_wave *wave, size_t lines, struct pupil_mirrors mirrors,
                        struct arena *arena, struct pupil_overlap *overlap);

/*
 * The sum over what the pupil and the one that is shifted have in common.
 *
 * Given     wave      found
 *           derives   pupil_overlap_back follows
 * Formula   integral of A(x + d) A(x) exp(2 pi i (W(x + d) - W(x))) over places x, d the shift: by
 *           Gauss's rules along the angle of the right edge, between the corners of the overlap,
 *           and along the line from there to the left edge
 * Source    [Hopkins55]; derived here
 * Errors    ERROR_DOMAIN: the edge is so distorted that no corners are found
 */
bool pupil_overlap_find(struct pupil_overlap *overlap, bool derives, struct error *error);

/*
 * Backwards: add to by_c, by_rim and by_matrix of the wave.
 *
 * Given     by  derivatives of something by re and im
 */
void pupil_overlap_back(struct pupil_overlap *overlap, const double by[2]);

#endif
