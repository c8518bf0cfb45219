/* tone/debevec.c - the response of a camera from a bracket. */
/* SPDX-License-Identifier: MIT */
#include "tone/debevec.h"

#include "base/cholesky.h"
#include "base/image/srgb.h"

#include <math.h>
#include <string.h>

enum { PIXELS_MOST = 4096, N = FRAME_LEVELS, TOP = FRAME_LEVELS - 1 };

/* Of the smoothness, for each value of a code on average. */
static const double SMOOTHNESS = 1;

/* Equations of one channel: A g = b, of which the lower triangle is used. */
struct equations {
    double *a; /* N x N */
    double b[N];
    double values; /* weighted ones that came in */
    size_t pairs;  /* pixels that are exposed in two frames */
};

/* A pixel in all frames. */
struct seen {
    size_t count;
    unsigned code[FRAMES_MOST];
    double weight[FRAMES_MOST], time[FRAMES_MOST]; /* w^2; ln t */
};

/* How many pixels are looked at, and which: spread over the picture, no row or column left out. */
static size_t pixels_of(const struct tone_frame *frame)
{
    const size_t pixels = frame->width * frame->height;
    return pixels < PIXELS_MOST ? pixels : PIXELS_MOST;
}

static size_t place_of(const struct tone_frame *frame, size_t i)
{
    const size_t count = pixels_of(frame), row = i * frame->height / count;
    const double turn =
        (double)i * 0.61803398874989485; /* the golden section: evenly in any part */
    return row * frame->width + (size_t)((turn - floor(turn)) * (double)frame->width);
}

static double weight_of(unsigned code)
{
    const double w = code <= TOP / 2 ? code : TOP - code;
    return w / (TOP / 2);
}

/* The codes of a pixel, of a channel, in the frames that have it and know something of it. */
static void see(const struct tone_frame *frames, size_t count, size_t at, size_t channel,
                struct seen *seen)
{
    const long column = (long)(at % frames->width), row = (long)(at / frames->width);
    seen->count = 0;
    for (size_t f = 0; f < count; f++) {
        const struct tone_frame *frame = &frames[f];
        const long x = column + frame->right, y = row + frame->down;
        if (x < 0 || y < 0 || x >= (long)frame->width || y >= (long)frame->height) {
            continue;
        }
        const unsigned code = frame_byte(frame, (size_t)y * frame->width + (size_t)x, channel);
        const double weight = weight_of(code);
        if (weight > 0) {
            seen->code[seen->count] = code;
            seen->weight[seen->count] = weight * weight;
            seen->time[seen->count] = log(frame->time);
            seen->count++;
        }
    }
}

/* ln E is the weighted mean of g - ln t; what is left of the sum of squares is in g alone. */
static void add_pixel(const struct seen *seen, struct equations *equations)
{
    double weights = 0, times = 0;
    for (size_t i = 0; i < seen->count; i++) {
        weights += seen->weight[i];
        times += seen->weight[i] * seen->time[i];
    }
    if (seen->count < 2) {
        return;
    }
    equations->pairs++;
    for (size_t i = 0; i < seen->count; i++) {
        const unsigned z = seen->code[i];
        const double w = seen->weight[i];
        equations->values += w;
        equations->b[z] += w * (seen->time[i] - times / weights);
        equations->a[z * N + z] += w;
        for (size_t k = 0; k < seen->count; k++) {
            equations->a[z * N + seen->code[k]] -= w * seen->weight[k] / weights;
        }
    }
}

static void add_smoothness(struct equations *equations)
{
    static const double second[3] = {1, -2, 1};
    for (unsigned z = 1; z < TOP; z++) {
        const double w = weight_of(z) * weight_of(z) * SMOOTHNESS * equations->values / N;
        for (unsigned i = 0; i < 3; i++) {
            for (unsigned k = 0; k < 3; k++) {
                equations->a[(z - 1 + i) * N + z - 1 + k] += w * second[i] * second[k];
            }
        }
    }
    /* g of the middle is 0: anything there is no information elsewhere */
    equations->a[DEBEVEC_MIDDLE * N + DEBEVEC_MIDDLE] += equations->values;
}

static double rms_of(const struct tone_frame *frames, size_t count, size_t channel, const double *g)
{
    double sum = 0, weights = 0;
    struct seen seen;
    for (size_t at = 0; at < pixels_of(frames); at++) {
        double mean = 0, own = 0;
        see(frames, count, place_of(frames, at), channel, &seen);
        for (size_t i = 0; i < seen.count; i++) {
            mean += seen.weight[i] * (g[seen.code[i]] - seen.time[i]);
            own += seen.weight[i];
        }
        for (size_t i = 0; i < seen.count && seen.count > 1; i++) {
            const double off = g[seen.code[i]] - seen.time[i] - mean / own;
            sum += seen.weight[i] * off * off;
            weights += seen.weight[i];
        }
    }
    return sqrt(sum / weights);
}

static void fill_curve(const double *g, struct response_curve *curve)
{
    const double middle = srgb_light((double)DEBEVEC_MIDDLE / TOP);
    for (int z = 0; z < N; z++) {
        curve->light[z] = middle * exp(g[z] - g[DEBEVEC_MIDDLE]);
        if (z > 0 && !(curve->light[z] >= curve->light[z - 1])) {
            curve->light[z] = curve->light[z - 1];
            curve->held++;
        }
    }
}

static bool recover_channel(const struct tone_frame *frames, size_t count, size_t channel,
                            struct arena *arena, struct response_curve *curve, struct error *error)
{
    struct equations equations = {.a = ARENA_ARRAY(arena, (size_t)N * N, double)};
    struct seen seen;
    for (size_t at = 0; at < pixels_of(frames); at++) {
        see(frames, count, place_of(frames, at), channel, &seen);
        add_pixel(&seen, &equations);
    }
    add_smoothness(&equations);
    if (equations.pairs < 2 || !cholesky_factor(equations.a, N)) {
        return fail(error, ERROR_DOMAIN,
                    "no response can be told: %zu of %zu pixels are neither black nor full in two "
                    "frames",
                    equations.pairs, pixels_of(frames));
    }
    cholesky_forward(equations.a, N, equations.b);
    cholesky_backward(equations.a, N, equations.b);
    fill_curve(equations.b, curve);
    curve->rms = rms_of(frames, count, channel, equations.b);
    return true;
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
        if (!recover_channel(frames, count, k, arena, &curves[k], error)) {
            return false;
        }
    }
    return true;
}
