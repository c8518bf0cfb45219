/* analysis/waves/kernel_exit_series.c - wave front and amplitude along lines, and their overlaps. */
/* SPDX-License-Identifier: MIT */
#include "analysis/waves/exit_front.h"

#include <stdbool.h>

#define JOINED(a, b) a##_##b
#define NAMED(a, b)  JOINED(a, b)

enum { LANES = EXIT_SERIES_LANES };

/* T_k of all lanes and the two sums. */
void NAMED(kernel_exit_values, KERNEL)(const struct exit_series *series, const double *places,
                                       double *waves, double *amplitudes)
{
    const size_t both =
        series->wave_count < series->amplitude_count ? series->wave_count : series->amplitude_count;
    const double *c = series->waves, *d = series->amplitudes;
    double x[LANES], before[LANES], here[LANES], w[LANES], a[LANES];
    for (size_t l = 0; l < LANES; l++) {
        x[l] = 2 * places[l];
        before[l] = 1;
        here[l] = places[l];
        w[l] = c[0] + c[1] * here[l];
        a[l] = d[0] + d[1] * here[l];
    }
    for (size_t k = 2; k < both; k++) {
        for (size_t l = 0; l < LANES; l++) {
            const double next = x[l] * here[l] - before[l];
            before[l] = here[l];
            here[l] = next;
            w[l] += c[k] * next;
            a[l] += d[k] * next;
        }
    }
    const bool more = series->wave_count > both;
    const double *e = more ? c : d;
    double *sum = more ? w : a;
    for (size_t k = both; k < (more ? series->wave_count : series->amplitude_count); k++) {
        for (size_t l = 0; l < LANES; l++) {
            const double next = x[l] * here[l] - before[l];
            before[l] = here[l];
            here[l] = next;
            sum[l] += e[k] * next;
        }
    }
    for (size_t l = 0; l < LANES; l++) {
        waves[l] = w[l];
        amplitudes[l] = a[l];
    }
}

void NAMED(kernel_exit_line, KERNEL)(const double *restrict from, const double *restrict shares,
                                     size_t lines, size_t count, double *restrict to)
{
    for (size_t j = 0; j < count; j++) {
        to[j] = shares[0] * from[j];
    }
    for (size_t i = 1; i < lines; i++) {
        for (size_t j = 0; j < count; j++) {
            to[j] += shares[i] * from[i * count + j];
        }
    }
}
