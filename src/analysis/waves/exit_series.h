/* analysis/waves/exit_series.h - wave front and amplitude along a line, many places at once. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_WAVES_EXIT_SERIES_H
#define LENSCALC_ANALYSIS_WAVES_EXIT_SERIES_H

#include <stddef.h>

enum { EXIT_SERIES_LANES = 32 };

/* Sums c_k T_k(x) of one line; T: Chebyshev's polynomials. At least 2 of each. */
struct exit_series {
    const double *waves, *amplitudes; /* coefficients */
    size_t wave_count, amplitude_count;
};

/* Places of two lines, the light from the first and that from the second laid together. */
struct exit_series_lanes {
    double x[2][EXIT_SERIES_LANES];   /* -1..1 */
    double weight[EXIT_SERIES_LANES]; /* 0: nothing is added */
    double phase[EXIT_SERIES_LANES];  /* receives W1 - W2, wavelengths */
    /* sums that weight A1 A2 cos(2 pi (W1 - W2)) is added to, with the sine, and with 1 */
    double re[EXIT_SERIES_LANES], im[EXIT_SERIES_LANES], perfect[EXIT_SERIES_LANES];
};

/* Compiled once for each instruction set, with the same bits. */
typedef void kernel_exit_overlap(const struct exit_series series[2],
                                 struct exit_series_lanes *lanes);
kernel_exit_overlap kernel_exit_overlap_sse2, kernel_exit_overlap_avx2, kernel_exit_overlap_avx512;

/* Places of one line: x as above; receives A cos(2 pi W), with the sine, and A. */
struct exit_wave_lanes {
    double x[EXIT_SERIES_LANES], waves[EXIT_SERIES_LANES];
    double re[EXIT_SERIES_LANES], im[EXIT_SERIES_LANES], amplitudes[EXIT_SERIES_LANES];
};
typedef void kernel_exit_wave(const struct exit_series *series, struct exit_wave_lanes *lanes);
kernel_exit_wave kernel_exit_wave_sse2, kernel_exit_wave_avx2, kernel_exit_wave_avx512;

/*
 * Numbers of many lines to those of one: to[j] = sum of share[i] from[i * count + j].
 *
 * Given     lines, count  >= 1
 */
typedef void kernel_exit_line(const double *from, const double *shares, size_t lines, size_t count,
                              double *to);
kernel_exit_line kernel_exit_line_sse2, kernel_exit_line_avx2, kernel_exit_line_avx512;

#endif
