/* tests/unit/test_nufft.c - nonuniform Fourier transforms against their sums. */
/* SPDX-License-Identifier: MIT */
#include "base/nufft.h"

#include "check.h"

#include <math.h>

static const long double pi = 3.14159265358979323846264338327950288L;

/* Waves of frequencies without a pattern, in the least and greatest cells, and above a turn. */
enum { WAVES = 40, MOST = 301, CELLS = 1024 };

static double wave_turns(int k)
{
    static const double odd[] = {0, 0.5, -1e-17, 0.999999999, -0.25, 7.3, -3.001};
    return k < 7 ? odd[k] : fmod(0.7548776662466927 * k * k, 1);
}

static void test_places(size_t count)
{
    struct arena arena = {0};
    const struct nufft nufft = nufft_open(count, &arena);
    const size_t length = nufft.fft.length;
    double re[CELLS] = {0}, im[CELLS] = {0}, worst = 0;
    CHECK(length >= 2 * count && length <= CELLS);
    for (int k = 0; k < WAVES; k++) {
        const struct nufft_wave wave = nufft_wave(&nufft, wave_turns(k));
        for (size_t i = 0, cell = wave.first; i < NUFFT_TAPS; i++) {
            re[cell] += wave.shares[i] * cos(k);
            im[cell] += wave.shares[i] * sin(k);
            cell = nufft_next(&nufft, cell);
        }
    }
    const struct fft_lines line = {re, im, 1, length, 1};
    fft_transform(&nufft.fft, false, &line, SET_BEST, &arena);
    for (size_t i = 0; i < count; i++) {
        const long double x = (long double)i - (long double)(count / 2);
        long double sum[2] = {0, 0};
        for (int k = 0; k < WAVES; k++) {
            const long double angle = k - 2 * pi * x * (long double)wave_turns(k);
            sum[0] += cosl(angle);
            sum[1] += sinl(angle);
        }
        const size_t cell = nufft_cell(&nufft, i);
        worst = fmax(worst, fabs(re[cell] / nufft.left[i] - (double)sum[0]));
        worst = fmax(worst, fabs(im[cell] / nufft.left[i] - (double)sum[1]));
    }
    CHECK_NEAR(worst / WAVES, 0, 2e-11, "of the sum of all amplitudes");
    arena_free(&arena);
}

int main(void)
{
    test_places(1);
    test_places(8);
    test_places(128);
    test_places(MOST);
    return check_report();
}
