/* analysis/waves/exit_lines.h - what is clear of parallel lines across an exit pupil. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_WAVES_EXIT_LINES_H
#define LENSCALC_ANALYSIS_WAVES_EXIT_LINES_H

#include "analysis/waves/exit_pupil.h"

#include <stddef.h>

enum { EXIT_SPANS = 6, EXIT_PIECES = 12, EXIT_NODES = 16 };

/* The clear parts of a line: low and high in turn. */
struct exit_spans {
    size_t count;
    double edges[2 * EXIT_SPANS];
};

/*
 * Lines between two places across, with as many clear parts each, that the same things end: their
 * edges are smooth in the angle of t = (low + high)/2 + (high - low)/2 sin(angle).
 */
struct exit_piece {
    double low, high;                              /* t */
    size_t count;                                  /* of spans */
    double edges[EXIT_NODES][2 * EXIT_SPANS];      /* at nodes of Gauss in the angle */
    double nodes[EXIT_NODES], weights[EXIT_NODES]; /* these as 0..1; of barycentric interpolation */
};

/* Points are s along + t across. */
struct exit_lines {
    double along[2], across[2];
    struct exit_piece pieces[EXIT_PIECES];
    size_t count;
    bool is_mirrored_across; /* all is the same at t and -t: pieces i and count - 1 - i are alike */
    bool is_mirrored_along;  /* all is the same at s and -s */
};

/*
 * Cut an exit pupil into lines along a direction of unit length.
 *
 * Formula   96 points of each line between the rim, changes bisected to 1e-11 of the pupil; pieces
 *           end where the number of spans or what ends them changes, to 1e-6
 * Limits    what blocks less than 1 % of a line may be missed
 */
void exit_lines_find(const struct exit_pupil *pupil, const double along[2], struct arena *arena,
                     struct exit_lines *lines);

/* A line of a piece at an angle within -pi/2 .. pi/2: its t, dt/d(angle), and its spans. */
double exit_piece_at(const struct exit_piece *piece, double angle, double *slope,
                     struct exit_spans *spans);

#endif
