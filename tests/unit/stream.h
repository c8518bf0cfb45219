/* tests/unit/stream.h - random numbers, points and axes for tests, one after the other. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TESTS_UNIT_STREAM_H
#define LENSCALC_TESTS_UNIT_STREAM_H

#include "base/constants.h"
#include "base/random.h"
#include "scene/vector.h"

struct stream {
    uint64_t seed;
    uint64_t count;
};

static inline double next(struct stream *stream)
{
    return random_unit(stream->seed, stream->count++, 0);
}

static inline double between(struct stream *stream, double low, double high)
{
    return low + (high - low) * next(stream);
}

static inline struct vector vector_in(struct stream *stream, double half)
{
    const double x = between(stream, -half, half), y = between(stream, -half, half);
    return (struct vector){x, y, between(stream, -half, half)};
}

/* All directions alike. */
static inline struct vector direction(struct stream *stream)
{
    const double z = between(stream, -1, 1), turn = 2 * PI * next(stream), r = sqrt(1 - z * z);
    return (struct vector){r * cos(turn), r * sin(turn), z};
}

static inline struct frame random_frame(struct stream *stream)
{
    struct frame frame = {.z = direction(stream)};
    frame.x = vector_unit(vector_cross(frame.z, direction(stream)));
    frame.y = vector_cross(frame.z, frame.x);
    return frame;
}

#endif
