/* scene/vector.h - points and directions of a scene. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_SCENE_VECTOR_H
#define LENSCALC_SCENE_VECTOR_H

#include <math.h>

/* Right-handed; as a scene is written: x to the right, y up, z towards who looks at it. */
struct vector {
    double x, y, z;
};

/* a + s b */
static inline struct vector vector_along(struct vector a, double s, struct vector b)
{
    return (struct vector){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}

static inline struct vector vector_minus(struct vector a, struct vector b)
{
    return vector_along(a, -1, b);
}

static inline struct vector vector_times(double s, struct vector a)
{
    return (struct vector){s * a.x, s * a.y, s * a.z};
}

static inline double vector_dot(struct vector a, struct vector b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline struct vector vector_cross(struct vector a, struct vector b)
{
    return (struct vector){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static inline double vector_length(struct vector a)
{
    return sqrt(vector_dot(a, a));
}

/* Of length 1; the vector must have a length. */
static inline struct vector vector_unit(struct vector a)
{
    return vector_times(1 / vector_length(a), a);
}

/* Of a direction away from a mirror whose normal has the length 1 the one that it looks in. */
static inline struct vector vector_mirrored(struct vector out, struct vector normal)
{
    return vector_along(vector_times(-1, out), 2 * vector_dot(out, normal), normal);
}

/* Where three directions of one length lie: columns of a rotation. */
struct frame {
    struct vector x, y, z;
};

/* From the frame's own coordinates to those in which it is given. */
static inline struct vector frame_out(const struct frame *frame, struct vector a)
{
    return vector_along(vector_along(vector_times(a.x, frame->x), a.y, frame->y), a.z, frame->z);
}

/* And back. */
static inline struct vector frame_in(const struct frame *frame, struct vector a)
{
    return (struct vector){vector_dot(frame->x, a), vector_dot(frame->y, a),
                           vector_dot(frame->z, a)};
}

/*
 * Axes, any, of which z is a direction of length 1.
 *
 * Source    [Duff17]
 */
static inline struct frame frame_about(struct vector z)
{
    const double sign = copysign(1, z.z), a = -1 / (sign + z.z), b = z.x * z.y * a;
    return (struct frame){
        {1 + sign * z.x * z.x * a, sign * b, -sign * z.x}, {b, sign + z.y * z.y * a, -z.y}, z};
}

#endif
