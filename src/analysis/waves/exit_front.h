/* analysis/waves/exit_front.h - wave front and amplitude of an exit pupil as series along its lines. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_WAVES_EXIT_FRONT_H
#define LENSCALC_ANALYSIS_WAVES_EXIT_FRONT_H

#include "analysis/waves/exit_lines.h"

#include <stddef.h>

enum { EXIT_SERIES_LANES = 32 };

/* Sums c_k T_k(x) of one line; T: Chebyshev's polynomials. At least 2 of each. */
struct exit_series {
    const double *waves, *amplitudes; /* coefficients */
    size_t wave_count, amplitude_count;
};

/*
 * W and the amplitude at places -1..1. Compiled once for each instruction set, with the same bits.
 */
typedef void kernel_exit_values(const struct exit_series *series, const double x[EXIT_SERIES_LANES],
                                double waves[EXIT_SERIES_LANES],
                                double amplitudes[EXIT_SERIES_LANES]);
kernel_exit_values kernel_exit_values_sse2, kernel_exit_values_avx2, kernel_exit_values_avx512;

/*
 * Numbers of many lines to those of one: to[j] = sum of share[i] from[i * count + j].
 *
 * Given     lines, count  >= 1
 */
typedef void kernel_exit_line(const double *from, const double *shares, size_t lines, size_t count,
                              double *to);
kernel_exit_line kernel_exit_line_sse2, kernel_exit_line_avx2, kernel_exit_line_avx512;

enum { EXIT_FRONT_MOST = 96 };

/*
 * A span of the lines of a piece: sums c_ik T_i(2 angle/pi) T_k(x), x = -1..1 from its lower edge
 * to its upper one; T: Chebyshev's polynomials.
 */
struct exit_sheet {
    size_t lines, wave_count, amplitude_count;
    double *waves, *amplitudes; /* [lines][wave_count], [lines][amplitude_count] */
};

struct exit_front {
    const struct exit_pupil *pupil;
    const struct exit_lines *lines;
    struct exit_sheet *sheets; /* [piece * EXIT_SPANS + span] */
    double off; /* what it may make of a contrast that is not so; from 1 on it is not complete */
};

/*
 * Find the series.
 *
 * Given     error  of contrasts that is wanted
 * Formula   W and amplitude at Chebyshev's points of angle and x, of the pupil's polynomials where
 *           these leave less than half the error, else of traced rays; ever more of them until the
 *           last terms leave less than a tenth of it, or there are EXIT_FRONT_MOST, or no hope
 * Source    [Berrut04] 5; tested by what tests of contrasts find
 */
void exit_front_find(const struct exit_pupil *pupil, const struct exit_lines *lines, double error,
                     struct arena *arena, struct exit_front *front);

/* One line of a piece. */
struct exit_line {
    double t, slope; /* dt/d(angle) */
    struct exit_spans spans;
    struct exit_series series[EXIT_SPANS]; /* of its spans */
    double room[2 * EXIT_SPANS][EXIT_FRONT_MOST];
};

/* The line at an angle within -pi/2 .. pi/2. It refers to itself: it is not to be copied. */
void exit_front_line(const struct exit_front *front, size_t piece, double angle,
                     struct exit_line *line);

#endif
