/* base/fft.c - discrete Fourier transforms of lengths 2^a 3^b 5^c. */
/* SPDX-License-Identifier: MIT */
#include "base/fft.h"

#include "base/turns.h"

static const size_t radices[] = {4, 2, 3, 5};
enum { RADICES = sizeof radices / sizeof radices[0] };

bool fft_has(size_t length)
{
    size_t rest = length;
    for (size_t i = 1; i < RADICES && length > 0; i++) {
        while (rest % radices[i] == 0) {
            rest /= radices[i];
        }
    }
    return rest == 1 && length <= FFT_MOST;
}

size_t fft_length_from(size_t length)
{
    while (!fft_has(length)) {
        length++;
    }
    return length;
}

struct fft fft_open(size_t length, struct arena *arena)
{
    struct fft fft = {.length = length};
    size_t left = length;
    for (size_t i = 0; i < RADICES; i++) {
        for (; left % radices[i] == 0; left /= radices[i]) {
            /* of `left` numbers, `part` parts of a radix: exp(-2 pi i p k/left), k from 1 */
            const size_t part = left / radices[i], count = part * (radices[i] - 1);
            double *cosine = ARENA_ARRAY(arena, count, double),
                   *sine = ARENA_ARRAY(arena, count, double);
            for (size_t j = 0; j < count; j++) {
                const size_t p = j / (radices[i] - 1), k = j % (radices[i] - 1) + 1;
                turns_of_ratio(p * k, left, &cosine[j], &sine[j]);
                sine[j] = -sine[j];
            }
            fft.passes[fft.count++] = (struct fft_pass){radices[i], part, cosine, sine};
        }
    }
    return fft;
}

/* Number k of every line side by side; where there are fewer lines zeros stand in for them. */
static void fft_gather(const struct fft_lines *lines, const double *from, size_t length, double *to)
{
    const size_t line = lines->line, step = lines->step, here = lines->count;
    for (size_t k = 0; k < length && here == FFT_LANES; k++, from += step, to += FFT_LANES) {
        for (size_t i = 0; i < FFT_LANES; i++) {
            to[i] = from[i * line];
        }
    }
    for (size_t k = 0; k < length && here < FFT_LANES; k++, from += step, to += FFT_LANES) {
        for (size_t i = 0; i < FFT_LANES; i++) {
            to[i] = i < here ? from[i * line] : 0;
        }
    }
}

static void fft_scatter(const struct fft_lines *lines, const double *from, size_t length,
                        double *to)
{
    const size_t line = lines->line, step = lines->step, here = lines->count;
    for (size_t k = 0; k < length; k++, from += FFT_LANES, to += step) {
        for (size_t i = 0; i < here; i++) {
            to[i * line] = from[i];
        }
    }
}

void fft_transform(const struct fft *fft, bool inverse, const struct fft_lines *lines,
                   enum instruction_set set, struct arena *arena)
{
    const struct arena_mark mark = arena_mark(arena);
    const size_t room = fft->length * FFT_LANES;
    double *work = ARENA_ARRAY(arena, 4 * room, double);
    kernel_fft *kernel = KERNEL_FOR(set, kernel_fft);
    /* the other sign is that of the numbers with their parts exchanged */
    double *re = inverse ? lines->im : lines->re, *im = inverse ? lines->re : lines->im;
    for (size_t first = 0; first < lines->count; first += FFT_LANES) {
        const size_t left = lines->count - first, at = first * lines->line;
        struct fft_lines few = *lines;
        few.count = left < FFT_LANES ? left : FFT_LANES;
        fft_gather(&few, re + at, fft->length, work);
        fft_gather(&few, im + at, fft->length, work + room);
        kernel(fft, work, work + room, work + 2 * room, work + 3 * room);
        fft_scatter(&few, work, fft->length, re + at);
        fft_scatter(&few, work + room, fft->length, im + at);
    }
    arena_reset(arena, mark);
}

void fft_plane(const struct fft *fft, bool inverse, double *re, double *im, struct arena *arena)
{
    const size_t n = fft->length;
    const struct fft_lines across = {re, im, n, n, 1}, down = {re, im, n, 1, n};
    fft_transform(fft, inverse, &across, SET_BEST, arena);
    fft_transform(fft, inverse, &down, SET_BEST, arena);
}
