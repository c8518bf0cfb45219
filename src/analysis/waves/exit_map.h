/* analysis/waves/exit_map.h - polynomials of two variables and their slopes, many places at once. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_WAVES_EXIT_MAP_H
#define LENSCALC_ANALYSIS_WAVES_EXIT_MAP_H

#include <stddef.h>

enum { EXIT_MAP_ORDER = 14, EXIT_MAP_LANES = 16 };

/* Sums c T_i(x) T_j(y), i + j <= order, the terms by i, then j; T: Chebyshev's polynomials. */
struct exit_map {
    size_t order;
    const double *first, *second; /* coefficients of two functions */
};

/* Places, and what the functions are there; area: |d(first, second)/d(x, y)|. */
struct exit_map_lanes {
    double x[EXIT_MAP_LANES], y[EXIT_MAP_LANES];
    double first[EXIT_MAP_LANES], second[EXIT_MAP_LANES], area[EXIT_MAP_LANES];
};

/* Compiled once for each instruction set, with the same bits. */
typedef void kernel_exit_map(const struct exit_map *map, struct exit_map_lanes *lanes);
kernel_exit_map kernel_exit_map_sse2, kernel_exit_map_avx2, kernel_exit_map_avx512;

/* The same without the area. */
typedef kernel_exit_map kernel_exit_form;
kernel_exit_form kernel_exit_form_sse2, kernel_exit_form_avx2, kernel_exit_form_avx512;

#endif
