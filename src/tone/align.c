/* tone/align.c - how far a camera has moved between two exposures. */
/* SPDX-License-Identifier: MIT */
#include "tone/align.h"

#include "base/image/bytes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { GREYS = 256, BESIDE = 4, SIDE_LEAST = 16, LOOK_MOST = 1 << 20, DARKEST = 10 };
static const double TAKEN = 0.8; /* of the pixels that differ without a shift */
static const double SEEN = 0.01; /* of all that must be compared */

/* Shades of grey, halved and halved again. */
struct shades {
    size_t width[ALIGN_LEVELS], height[ALIGN_LEVELS];
    uint8_t *of[ALIGN_LEVELS];
    int count;
};

enum bits { BRIGHT = 1, CLEAR = 2 };

/* The median of green, within a hundredth; of positive floats the order is that of their bits. */
static float median_of(const struct tone_frame *frame, struct arena *arena)
{
    enum { KEPT = 16 };
    const size_t count = frame->width * frame->height;
    size_t *counts = ARENA_ARRAY(arena, 1U << KEPT, size_t), sum = 0;
    for (size_t i = 0; i < count; i++) {
        counts[bytes_bits(fmaxf(frame->values[FRAME_CHANNELS * i + 1], 0)) >> (32 - KEPT)]++;
    }
    uint32_t bin = 0;
    while (bin + 1 < 1U << KEPT && 2 * (sum += counts[bin]) < count) {
        bin++;
    }
    return bytes_float(bin << (32 - KEPT));
}

static struct shades shades_of(const struct tone_frame *frame, struct arena *arena)
{
    struct shades shades = {.count = 0};
    size_t width = frame->width, height = frame->height;
    while (shades.count < ALIGN_LEVELS && (shades.count == 0 || width >= SIDE_LEAST) &&
           (shades.count == 0 || height >= SIDE_LEAST)) {
        const int level = shades.count++;
        shades.width[level] = width;
        shades.height[level] = height;
        shades.of[level] = ARENA_ARRAY(arena, width * height, uint8_t);
        if (level > 0) {
            const size_t across = shades.width[level - 1];
            for (size_t y = 0; y < shades.height[level]; y++) {
                const uint8_t *above = shades.of[level - 1] + 2 * y * across,
                              *below = above + across;
                uint8_t *to = shades.of[level] + y * shades.width[level];
                for (size_t x = 0; x < shades.width[level]; x++) {
                    to[x] = (uint8_t)((above[2 * x] + above[2 * x + 1] + below[2 * x] +
                                       below[2 * x + 1] + 2) /
                                      4);
                }
            }
        } else if (frame->bits == 0) {
            /* only the order matters: the median in the middle, 48 shades an octave */
            uint8_t *grey = shades.of[0];
            struct arena scratch = {0};
            const double median = fmax((double)median_of(frame, &scratch), 1e-30);
            for (size_t i = 0; i < frame->width * frame->height; i++) {
                const double share = (double)frame->values[FRAME_CHANNELS * i + 1] / median;
                grey[i] = (uint8_t)fmin(fmax(128 + 48 * log2(fmax(share, 1e-9)), 0), 255);
            }
            arena_free(&scratch);
        } else {
            /* [Ward03]: 54 red, 183 green and 19 blue of 256 */
            uint8_t *grey = shades.of[0];
            for (size_t i = 0; i < frame->width * frame->height; i++) {
                grey[i] = (uint8_t)((54 * frame_byte(frame, i, 0) + 183 * frame_byte(frame, i, 1) +
                                     19 * frame_byte(frame, i, 2)) >>
                                    8);
            }
        }
        width /= 2;
        height /= 2;
    }
    return shades;
}

/* The shade below which a share of the pixels lies. */
static int quantile(const struct shades *shades, int level, double share)
{
    size_t counts[GREYS] = {0}, sum = 0;
    const size_t count = shades->width[level] * shades->height[level];
    for (size_t i = 0; i < count; i++) {
        counts[shades->of[level][i]]++;
    }
    int grey = 0;
    while (grey < GREYS - 1 && (double)(sum += counts[grey]) < share * (double)count) {
        grey++;
    }
    return grey;
}

static bool is_exposed(int grey)
{
    return grey >= DARKEST && grey < GREYS - DARKEST;
}

/* A quantile that is neither black nor white in both; 0: there is none. */
static double choose_quantile(const struct shades *a, const struct shades *b)
{
    static const double shares[] = {0.5, 0.67, 0.33, 0.83, 0.17, 0.92, 0.08};
    for (size_t i = 0; i < sizeof shares / sizeof shares[0]; i++) {
        if (is_exposed(quantile(a, 0, shares[i])) && is_exposed(quantile(b, 0, shares[i]))) {
            return shares[i];
        }
    }
    return 0;
}

/* Bits of each pixel, in an array of its own. */
static uint8_t *align_bits_of(const struct shades *shades, int level, double share,
                              struct arena *arena)
{
    const size_t count = shades->width[level] * shades->height[level];
    const int middle = quantile(shades, level, share);
    uint8_t *bits = ARENA_ARRAY(arena, count, uint8_t);
    for (size_t i = 0; i < count; i++) {
        const int grey = shades->of[level][i];
        bits[i] =
            (uint8_t)((grey > middle ? BRIGHT : 0) | (abs(grey - middle) > BESIDE ? CLEAR : 0));
    }
    return bits;
}

/* Two frames as bits. */
struct align_pair {
    const uint8_t *a, *b;
    size_t width, height;
};

/* Share of the pixels compared that differ, b being shifted; NaN: too few are compared. */
static double differing(const struct align_pair *pair, long right, long down)
{
    const size_t step = pair->width * pair->height / LOOK_MOST + 1;
    const long width = (long)pair->width, height = (long)pair->height;
    const long left = right < 0 ? -right : 0, end = right > 0 ? width - right : width;
    size_t seen = 0, differ = 0, all = 0;
    for (long y = down < 0 ? -down : 0; y < height && y + down < height; y += (long)step) {
        const uint8_t *a = pair->a + y * width + left;
        const uint8_t *b = pair->b + (y + down) * width + left + right;
        unsigned row_seen = 0, row_differ = 0;
        for (long x = 0; x < end - left; x++) {
            const unsigned clear = (unsigned)(a[x] & b[x]) >> 1;
            row_seen += clear;
            row_differ += clear & (unsigned)(a[x] ^ b[x]);
        }
        seen += row_seen;
        differ += row_differ;
        all += end > left ? (size_t)(end - left) : 0;
    }
    return (double)seen > SEEN * (double)all ? (double)differ / (double)seen : NAN;
}

/* One pixel each way at each size; the smallest first. */
static void find_shift(const struct shades *a, const struct shades *b, double share, long shift[2],
                       struct align_step *step)
{
    struct arena scratch = {0};
    shift[0] = shift[1] = 0;
    for (int level = a->count - 1; level >= 0; level--) {
        const struct align_pair pair = {align_bits_of(a, level, share, &scratch),
                                        align_bits_of(b, level, share, &scratch), a->width[level],
                                        a->height[level]};
        const long from[2] = {2 * shift[0], 2 * shift[1]};
        double best = differing(&pair, from[0], from[1]);
        shift[0] = from[0];
        shift[1] = from[1];
        for (int i = 0; i < 9; i++) {
            const long to[2] = {from[0] + i % 3 - 1, from[1] + i / 3 - 1};
            const double differ = differing(&pair, to[0], to[1]);
            if (differ < best) {
                best = differ;
                shift[0] = to[0];
                shift[1] = to[1];
            }
        }
        if (level == 0) {
            step->before = differing(&pair, 0, 0);
            step->now = best;
        }
    }
    step->is_told = step->before >= 0 && step->now >= 0;
    step->limit = (1L << a->count) - 1;
    const bool is_beyond = labs(shift[0]) == step->limit || labs(shift[1]) == step->limit;
    if (step->is_told && is_beyond && step->now < TAKEN * step->before) {
        step->is_beyond = true;
    }
    if (step->is_beyond || !(step->now < TAKEN * step->before)) {
        shift[0] = shift[1] = 0;
        step->now = step->before;
    }
    arena_free(&scratch);
}

void align_frames(struct tone_frame *frames, size_t count, struct align_step *steps)
{
    size_t order[FRAMES_MOST];
    frames_order(frames, count, order);
    struct arena here = {0}, next = {0};
    struct shades before = shades_of(&frames[order[0]], &here);
    frames[order[0]].right = frames[order[0]].down = 0;
    steps[order[0]] = (struct align_step){.is_told = true};
    for (size_t i = 1; i < count; i++) {
        struct tone_frame *frame = &frames[order[i]];
        const struct tone_frame *longer = &frames[order[i - 1]];
        struct align_step *step = &steps[order[i]];
        const struct shades shades = shades_of(frame, &next);
        const double share = choose_quantile(&before, &shades);
        long shift[2] = {0, 0};
        *step = (struct align_step){.is_told = false};
        if (share > 0) {
            find_shift(&before, &shades, share, shift, step);
        }
        frame->right = longer->right + shift[0];
        frame->down = longer->down + shift[1];
        arena_free(&here);
        here = next;
        next = (struct arena){0};
        before = shades;
    }
    arena_free(&here);
    const long right = frames[0].right, down = frames[0].down;
    for (size_t i = 0; i < count; i++) {
        frames[i].right -= right;
        frames[i].down -= down;
    }
}
