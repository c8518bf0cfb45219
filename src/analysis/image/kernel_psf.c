/* analysis/image/kernel_psf.c - the inner loops of point spread functions. */
/* SPDX-License-Identifier: MIT */
#include "analysis/image/psf_light.h"
#include "base/turns.h"

#include <math.h>

#define JOINED(a, b) a##_##b
#define NAMED(a, b)  JOINED(a, b)

enum { LANES = PSF_LANES, NODES = PSF_NODES };

static inline void kernel_psf_turn(const double *restrict turns, double *restrict c,
                                   double *restrict s)
{
    for (int l = 0; l < LANES; l++) {
        turns_of(turns[l], &c[l], &s[l]);
    }
}

/* Something along the columns of a strip. */
struct along {
    double of[NODES][LANES]; /* at the nodes; then the first value and its differences */
};

/* Turns and amplitudes of a wavelet at the nodes of a strip. */
static void kernel_psf_look(const struct psf_wavelet *wavelet, const struct psf_steps *steps,
                            const struct psf_strip *strip, struct along *turns, struct along *sizes)
{
    const struct psf_wavelet w = *wavelet;
    const double radius2 = w.radius * w.radius, first = strip->x, pitch = strip->pitch;
    for (int k = 0; k < NODES; k++) {
        const double y = strip->y + pitch * steps->at[k], aside = y * y + 2 * w.by * y;
        for (int l = 0; l < LANES; l++) {
            const double x = first + pitch * (double)l;
            const double more = aside + x * (x + 2 * w.bx);
            const double r = sqrt(radius2 + more);
            /* one quotient for both: of the way, and of the amplitude */
            const double sum = w.radius + r, over = 1 / (r * sum);
            turns->of[k][l] = w.turns - w.waves * (more * r * over);
            sizes->of[k][l] = w.amplitude * (w.radius * sum * over);
        }
    }
}

/* From values at the nodes to the first one and its differences. */
static void differ(const struct psf_steps *steps, struct along *along)
{
    double found[NODES][LANES];
    for (int m = 0; m < NODES; m++) {
        const double *by = steps->differences[m];
        for (int l = 0; l < LANES; l++) {
            const double base = along->of[0][l];
            found[m][l] = (m == 0 ? base : 0) +
                          (by[1] * (along->of[1][l] - base) + by[2] * (along->of[2][l] - base) +
                           by[3] * (along->of[3][l] - base));
        }
    }
    for (int m = 0; m < NODES; m++) {
        for (int l = 0; l < LANES; l++) {
            along->of[m][l] = found[m][l];
        }
    }
}

/* A lane of a difference to the next row, by the next difference. */
static inline void turn_on(double (*a)[LANES], double (*c)[LANES], double (*s)[LANES], int m, int l)
{
    const double before = c[m][l], side = s[m][l];
    a[m][l] += a[m + 1][l];
    c[m][l] = before * c[m + 1][l] - side * s[m + 1][l];
    s[m][l] = before * s[m + 1][l] + side * c[m + 1][l];
}

void NAMED(kernel_psf, KERNEL)(const struct psf_wavelet *wavelet, const struct psf_steps *steps,
                               const struct psf_strip *strip)
{
    struct along turns, sizes;
    double c[NODES][LANES], s[NODES][LANES], a[NODES][LANES]; /* which nothing else can be */
    kernel_psf_look(wavelet, steps, strip, &turns, &sizes);
    differ(steps, &turns);
    differ(steps, &sizes);
    for (int m = 0; m < NODES; m++) {
        kernel_psf_turn(turns.of[m], c[m], s[m]);
        for (int l = 0; l < LANES; l++) {
            a[m][l] = sizes.of[m][l];
        }
    }
    for (size_t row = 0; row < steps->rows; row++) {
        double *restrict re = strip->re + row * LANES, *restrict im = strip->im + row * LANES;
        for (int l = 0; l < LANES; l++) {
            re[l] += a[0][l] * c[0][l];
            im[l] += a[0][l] * s[0][l];
            turn_on(a, c, s, 0, l);
            turn_on(a, c, s, 1, l);
            turn_on(a, c, s, 2, l);
        }
    }
}
