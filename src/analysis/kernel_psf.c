/* analysis/kernel_psf.c - the inner loops of images of points. */
/* SPDX-License-Identifier: MIT */
#include "analysis/psf_kernels.h"
#include "base/turns.h"

#include <math.h>

#define JOINED(a, b) a##_##b
#define NAMED(a, b)  JOINED(a, b)

static void add_wave(const struct psf_wave *wave, const struct psf_row *row)
{
    const double amplitude = wave->amplitude, turns = wave->turns, step = wave->step;
    double *restrict re = row->re, *restrict im = row->im;
    for (size_t i = 0; i < row->count; i++) {
        double c, s;
        turns_of(turns + step * (double)(int)i, &c, &s);
        re[i] += amplitude * c;
        im[i] += amplitude * s;
    }
}

static void add_row(const struct psf_row *from, double c, double s, const struct psf_row *row)
{
    const double *restrict x = from->re, *restrict y = from->im;
    double *restrict re = row->re, *restrict im = row->im;
    for (size_t i = 0; i < row->count; i++) {
        re[i] += c * x[i] - s * y[i];
        im[i] += c * y[i] + s * x[i];
    }
}

static void add_wavelet(const struct psf_wavelet *wavelet, const struct psf_row *row)
{
    const struct psf_wavelet w = *wavelet;
    const double radius2 = w.radius * w.radius, aside = w.y * w.y + 2 * w.by * w.y;
    double *restrict re = row->re, *restrict im = row->im;
    for (size_t i = 0; i < row->count; i++) {
        const double x = w.first + w.pitch * (double)(int)i;
        const double more = aside + x * (x + 2 * w.bx);
        const double r = sqrt(radius2 + more);
        double c, s;
        /* one quotient for both: of the way, and of the amplitude */
        const double sum = w.radius + r, over = 1 / (r * sum);
        turns_of(w.turns - w.waves * (more * r * over), &c, &s);
        const double amplitude = w.amplitude * (w.radius * sum * over);
        re[i] += amplitude * c;
        im[i] += amplitude * s;
    }
}

const struct psf_kernels NAMED(psf_kernels, KERNEL) = {add_wave, add_row, add_wavelet};
