/* tests/stress/quad_ray.h - exact rays in 113 bits as textbooks have them. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TESTS_STRESS_QUAD_RAY_H
#define LENSCALC_TESTS_STRESS_QUAD_RAY_H

#include "drawn_lens.h"

#include "trace/aim/beam.h"

/* In the frame of the surface met last: point, direction of unit length, optical path. */
struct quad_ray {
    quad x[3], d[3], path, n;
    quad length;      /* of all optical paths, also of those back */
    bool is_computed; /* where it starts: what its numbers are sums of may be larger than they */
    double way;       /* +1, or -1 after an odd number of mirrors */
    double margin;    /* of what was nearest to being lost, or to not being: 0 is the border */
};

/* What one number of a ray behind a surface is moved by: its rounding. */
#define QUAD_START ((size_t)-1)
struct quad_nudge {
    size_t surface; /* behind this one; QUAD_START: before the first, each number by itself */
    int component;  /* 0 .. 2 point, 3 .. 5 direction, 6 path */
    quad by;        /* of the size of the point, the direction, the path */
};

/*
 * To one surface: the quadratic of its conic, Newton's method on z - sag, the law of refraction of
 * unit vectors. The meeting is where light comes to the front, on the sheet of the vertex.
 *
 * Result    false: lost
 */
bool quad_ray_meet(const struct quad_surface *surface, struct quad_ray *ray);

/* Of an object point, through the plane that its beam is named by; n is 1 there. */
struct quad_ray quad_ray_of_beam(const struct beam *beam, const double at[2]);

/* Through all surfaces, or up to one and into its own axes. */
bool quad_ray_trace(const struct quad_lens *lens, const struct quad_nudge *nudge,
                    struct quad_ray *ray);
bool quad_ray_to_stop(const struct quad_lens *lens, size_t stop, struct quad_ray *ray);

/*
 * How figures move when every number of the lens, and every number of each ray behind each surface,
 * moves by its own size.
 *
 * Given     find     the figures of a lens; false: there are none
 *           step     moved by so much of it
 */
enum { QUAD_FIGURES = 12 };
struct quad_question {
    bool (*find)(const struct quad_lens *lens, const struct quad_nudge *nudge, const void *context,
                 quad *figures);
    const void *context;
    int figures;
    quad step;
};
bool quad_sensitivity(const struct quad_lens *lens, const struct quad_question *question,
                      double *sums);

#endif
