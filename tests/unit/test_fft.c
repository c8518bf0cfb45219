/* tests/unit/test_fft.c - Fourier transforms against the sum in long double. */
/* SPDX-License-Identifier: MIT */
#include "base/fft.h"

#include "base/processor.h"
#include "base/turns.h"
#include "check.h"

#include <math.h>
#include <string.h>

enum { MOST = 960 };
static const long double pi = 3.14159265358979323846264338327950288L;

/* Numbers between -1 and 1 without a pattern. */
static double noise(size_t i)
{
    return 2 * fmod(0.7548776662466927 * (double)(i * i + 3 * i + 1), 1) - 1;
}

static void dft(const double *re, const double *im, size_t n, size_t k, int sign, long double *to)
{
    to[0] = to[1] = 0;
    for (size_t j = 0; j < n; j++) {
        const long double angle = sign * 2 * pi * (long double)(j * k % n) / (long double)n;
        const long double c = cosl(angle), s = sinl(angle);
        to[0] += re[j] * c - im[j] * s;
        to[1] += re[j] * s + im[j] * c;
    }
}

static void test_length(size_t n, bool inverse, struct arena *arena)
{
    const struct fft fft = fft_open(n, arena);
    double re[MOST], im[MOST], x[MOST], y[MOST];
    long double before = 0, after = 0, off = 0;
    for (size_t i = 0; i < n; i++) {
        re[i] = x[i] = noise(i);
        im[i] = y[i] = noise(7 * i + 5);
        before += (long double)re[i] * re[i] + (long double)im[i] * im[i];
    }
    const struct fft_lines line = {re, im, 1, 0, 1};
    fft_transform(&fft, inverse, &line, SET_BEST, arena);
    for (size_t k = 0; k < n; k++) {
        long double exact[2];
        dft(x, y, n, k, inverse ? 1 : -1, exact);
        off += (re[k] - exact[0]) * (re[k] - exact[0]) + (im[k] - exact[1]) * (im[k] - exact[1]);
        after += (long double)re[k] * re[k] + (long double)im[k] * im[k];
    }
    CHECK_NEAR((double)sqrtl(off / after), 0, 4e-16, "root mean square");
    CHECK_NEAR((double)(after / (before * (long double)n)), 1, 1e-15, "Parseval");
}

static void test_lengths(struct arena *arena)
{
    static const size_t lengths[] = {1,  2,  3,  4,  5,   6,   8,   9,   10,  12,  15, 16,
                                     25, 27, 30, 64, 100, 128, 180, 240, 256, 625, 960};
    for (size_t i = 0; i < sizeof lengths / sizeof lengths[0]; i++) {
        CHECK(fft_has(lengths[i]));
        test_length(lengths[i], false, arena);
        test_length(lengths[i], true, arena);
    }
    CHECK(!fft_has(0) && !fft_has(7) && !fft_has(22) && !fft_has(2 * (size_t)FFT_MOST));
    CHECK(fft_length_from(7) == 8 && fft_length_from(257) == 270 && fft_length_from(97) == 100);
}

/* A square: a plane wave becomes one number; and back. */
static void test_plane(size_t n, struct arena *arena)
{
    const struct fft fft = fft_open(n, arena);
    double *re = ARENA_ARRAY(arena, n * n, double), *im = ARENA_ARRAY(arena, n * n, double);
    const size_t a = 3, b = n - 5;
    for (size_t i = 0; i < n * n; i++) {
        turns_of_ratio((a * (i % n) + b * (i / n)) % n, n, &re[i], &im[i]);
    }
    fft_plane(&fft, false, re, im, arena);
    double most = 0;
    for (size_t i = 0; i < n * n; i++) {
        const double peak = i == b * n + a ? (double)(n * n) : 0;
        most = fmax(most, hypot(re[i] - peak, im[i]));
    }
    CHECK_NEAR(most / (double)(n * n), 0, 1e-15, "a plane wave");
    fft_plane(&fft, true, re, im, arena);
    double c, s;
    turns_of_ratio((a * 7 + b * 2) % n, n, &c, &s);
    CHECK_NEAR(re[2 * n + 7] / (double)(n * n), c, 1e-15, "back");
    CHECK_NEAR(im[2 * n + 7] / (double)(n * n), s, 1e-15, "back");
}

static void test_sets(struct arena *arena)
{
    enum { LENGTH = 480, LINES = 11 };
    static double re[3][LENGTH * LINES], im[3][LENGTH * LINES];
    const struct fft fft = fft_open(LENGTH, arena);
    const bool has[] = {true, processor_has_avx2(), processor_has_avx512()};
    for (size_t set = 0; set < 3; set++) {
        for (size_t i = 0; i < (size_t)LENGTH * LINES; i++) {
            re[set][i] = noise(i);
            im[set][i] = noise(i + 99);
        }
        const struct fft_lines lines = {re[set], im[set], LINES, LENGTH, 1};
        if (has[set]) {
            fft_transform(&fft, false, &lines, (enum instruction_set)(SET_SSE2 + set), arena);
            CHECK(memcmp(re[set], re[0], sizeof re[0]) == 0);
            CHECK(memcmp(im[set], im[0], sizeof im[0]) == 0);
        }
    }
}

static void test_turns(void)
{
    for (int i = -4000; i <= 4000; i++) {
        const double t = i * 0.000737;
        double c, s;
        turns_of(t, &c, &s);
        CHECK_NEAR(c, (double)cosl(2 * pi * (long double)t), 3e-16, "cosine");
        CHECK_NEAR(s, (double)sinl(2 * pi * (long double)t), 3e-16, "sine");
    }
}

int main(void)
{
    struct arena arena = {0};
    test_turns();
    test_lengths(&arena);
    test_plane(64, &arena);
    test_plane(60, &arena);
    test_sets(&arena);
    arena_free(&arena);
    return check_report();
}
