/* tone/debevec.c - the response of a camera from a bracket. */
/* SPDX-License-Identifier: MIT */
#include "tone/debevec.h"

#include "base/cholesky.h"
#include "base/image/srgb.h"

#include <math.h>
#include <string.h>

enum { PIXELS_MOST = 1 << 17, N = FRAME_LEVELS, TOP = FRAME_LEVELS - 1 };
enum { APART_MOST = 24 }; /* codes of neighbours */

/* Of the smoothness, for each value of a code on average: 100 to 10000 recover the same. */
static const double SMOOTHNESS = 1000;

/* Equations of one channel: A g = b, of which the lower triangle is used. */
struct debevec_equations {
    double *a; /* N x N */
    double b[N];
    double values; /* weighted ones that came in */
    size_t pairs;  /* pixels that are exposed in two frames */
};

/* A place in all frames. */
struct debevec_seen {
    size_t count;
    double code[FRAMES_MOST];                      /* a mean */
    double weight[FRAMES_MOST], time[FRAMES_MOST]; /* w^2; ln t */
};

/* How many pixels are looked at, and which: spread over the picture, no row or column left out. */
static size_t pixels_of(const struct tone_frame *frame)
{
    const size_t pixels = frame->width * frame->height;
    return pixels < PIXELS_MOST ? pixels : PIXELS_MOST;
}

static size_t debevec_place_of(const struct tone_frame *frame, size_t i)
{
    const size_t count = pixels_of(frame), row = i * frame->height / count;
    const double turn =
        (double)i * 0.61803398874989485; /* the golden section: evenly in any part */
    return row * frame->width + (size_t)((turn - floor(turn)) * (double)frame->width);
}

static double debevec_weight_of(double code)
{
    return fmax(0, fmin(code, TOP - code)) / (TOP / 2);
}

static size_t held(long at, size_t count)
{
    if (at < 0) {
        return 0;
    }
    if (at >= (long)count) {
        return count - 1;
    }
    return (size_t)at;
}

/* A pixel and its neighbours in a frame. */
struct debevec_spot {
    double own, mean;
    bool is_there, is_even, is_exposed; /* none of them at an end */
};

static struct debevec_spot debevec_spot_of(const struct tone_frame *frame, size_t at,
                                           size_t channel)
{
    const long x = (long)(at % frame->width) + frame->right;
    const long y = (long)(at / frame->width) + frame->down;
    unsigned sum = 0, least = TOP, most = 0;
    bool is_full = false;
    if (x < 0 || y < 0 || x >= (long)frame->width || y >= (long)frame->height) {
        return (struct debevec_spot){.is_there = false, .is_even = true};
    }
    for (long i = 0; i < 9; i++) {
        const size_t row = held(y + i / 3 - 1, frame->height);
        const size_t column = held(x + i % 3 - 1, frame->width);
        const size_t pixel = row * frame->width + column;
        const unsigned code = frame_byte(frame, pixel, channel);
        is_full = is_full || frame_is_full(frame, pixel * FRAME_CHANNELS + channel);
        sum += code;
        least = code < least ? code : least;
        most = code > most ? code : most;
    }
    const bool is_exposed = least > 0 && !is_full;
    return (struct debevec_spot){frame_byte(frame, (size_t)y * frame->width + (size_t)x, channel),
                                 sum / 9.0, true, !is_exposed || most - least <= APART_MOST,
                                 is_exposed};
}

/*
 * The codes of a place, of a channel, in the frames that have it and know something of it: where
 * neighbours are alike in all frames their means, whose noise would flatten the curve.
 */
static void debevec_see(const struct tone_frame *frames, size_t count, size_t at, size_t channel,
                        struct debevec_seen *seen)
{
    struct debevec_spot spots[FRAMES_MOST];
    bool is_even = true;
    for (size_t f = 0; f < count; f++) {
        spots[f] = debevec_spot_of(&frames[f], at, channel);
        is_even = is_even && spots[f].is_even;
    }
    seen->count = 0;
    for (size_t f = 0; f < count; f++) {
        const double code = is_even ? spots[f].mean : spots[f].own,
                     weight = debevec_weight_of(code);
        if (spots[f].is_there && (spots[f].is_exposed || !is_even) && weight > 0) {
            seen->code[seen->count] = code;
            seen->weight[seen->count] = weight * weight;
            seen->time[seen->count] = log(frames[f].time);
            seen->count++;
        }
    }
}

/* What a code between two has of each of them. */
struct share {
    size_t code;
    double of;
};

static void shares_of(double code, double weight, struct share shares[2])
{
    const size_t below = (size_t)code; /* of a mean above 0 and below the last */
    shares[0] = (struct share){below, weight * ((double)below + 1 - code)};
    shares[1] = (struct share){below + 1, weight * (code - (double)below)};
}

/* ln E is the weighted mean of g - ln t; what is left of the sum of squares is in g alone. */
static void add_pixel(const struct debevec_seen *seen, struct debevec_equations *equations)
{
    struct share sums[2 * FRAMES_MOST];
    double weights = 0, times = 0;
    for (size_t i = 0; i < seen->count; i++) {
        weights += seen->weight[i];
        times += seen->weight[i] * seen->time[i];
        shares_of(seen->code[i], seen->weight[i], sums + 2 * i);
    }
    if (seen->count < 2) {
        return;
    }
    equations->pairs++;
    equations->values += weights;
    for (size_t i = 0; i < 2 * seen->count; i++) {
        const struct share *own = sums + i / 2 * 2;
        double *row = equations->a + sums[i].code * N;
        equations->b[sums[i].code] += sums[i].of * (seen->time[i / 2] - times / weights);
        for (size_t k = 0; k < 2; k++) {
            row[own[k].code] += sums[i].of * own[k].of / seen->weight[i / 2];
        }
        for (size_t k = 0; k < 2 * seen->count; k++) {
            row[sums[k].code] -= sums[i].of * sums[k].of / weights;
        }
    }
}

static void add_smoothness(struct debevec_equations *equations)
{
    for (unsigned z = 1; z < TOP; z++) {
        const double slope = 0.5 / z, second[3] = {1 - slope, -2, 1 + slope};
        const double w =
            debevec_weight_of(z) * debevec_weight_of(z) * SMOOTHNESS * equations->values / N;
        for (unsigned i = 0; i < 3; i++) {
            for (unsigned k = 0; k < 3; k++) {
                equations->a[(z - 1 + i) * N + z - 1 + k] += w * second[i] * second[k];
            }
        }
    }
    /* g of the middle is 0: anything there is no information elsewhere */
    equations->a[DEBEVEC_MIDDLE * N + DEBEVEC_MIDDLE] += equations->values;
}

static double debevec_between(const double *g, double code)
{
    struct share shares[2];
    shares_of(code, 1, shares);
    return shares[0].of * g[shares[0].code] + shares[1].of * g[shares[1].code];
}

static double rms_of(const struct tone_frame *frames, size_t count, size_t channel, const double *g)
{
    double sum = 0, weights = 0;
    struct debevec_seen seen;
    for (size_t at = 0; at < pixels_of(frames); at++) {
        double mean = 0, own = 0;
        debevec_see(frames, count, debevec_place_of(frames, at), channel, &seen);
        for (size_t i = 0; i < seen.count; i++) {
            mean += seen.weight[i] * (debevec_between(g, seen.code[i]) - seen.time[i]);
            own += seen.weight[i];
        }
        for (size_t i = 0; i < seen.count && seen.count > 1; i++) {
            const double off = debevec_between(g, seen.code[i]) - seen.time[i] - mean / own;
            sum += seen.weight[i] * off * off;
            weights += seen.weight[i];
        }
    }
    return sqrt(sum / weights);
}

bool debevec_recover(const struct tone_frame *frames, size_t count, struct arena *arena,
                     struct response_curve curves[FRAME_CHANNELS], struct error *error)
{
    bool is_one_time = true;
    for (size_t f = 0; f < count; f++) {
        is_one_time = is_one_time && frames[f].time == frames[0].time;
        if (frames[f].bits != 8) {
            return fail(error, ERROR_DOMAIN,
                        "%.200s: a response is recovered of 8 bits, and it has %s", frames[f].name,
                        frames[f].bits == 16 ? "16" : "floats");
        }
    }
    if (is_one_time) {
        return fail(error, ERROR_DOMAIN, "a response is recovered from frames of different times");
    }
    memset(curves, 0, FRAME_CHANNELS * sizeof *curves);
    for (size_t k = 0; k < FRAME_CHANNELS; k++) {
        struct response_curve *curve = &curves[k];
        struct debevec_equations equations = {.a = ARENA_ARRAY(arena, (size_t)N * N, double)};
        struct debevec_seen seen;
        for (size_t at = 0; at < pixels_of(frames); at++) {
            debevec_see(frames, count, debevec_place_of(frames, at), k, &seen);
            add_pixel(&seen, &equations);
        }
        add_smoothness(&equations);
        if (equations.pairs < 2 || !cholesky_factor(equations.a, N)) {
            return fail(
                error, ERROR_DOMAIN,
                "no response can be told: %zu of %zu pixels are neither black nor full in two "
                "frames",
                equations.pairs, pixels_of(frames));
        }
        cholesky_forward(equations.a, N, equations.b);
        cholesky_backward(equations.a, N, equations.b);
        /* light of the codes, whose logarithm that is; it may not fall */
        const double *g = equations.b;
        const double middle = srgb_light((double)DEBEVEC_MIDDLE / TOP);
        for (int z = 0; z < N; z++) {
            curve->light[z] = middle * exp(g[z] - g[DEBEVEC_MIDDLE]);
            if (z > 0 && !(curve->light[z] >= curve->light[z - 1])) {
                curve->light[z] = curve->light[z - 1];
                curve->held++;
            }
        }
        curve->rms = rms_of(frames, count, k, equations.b);
    }
    return true;
}
