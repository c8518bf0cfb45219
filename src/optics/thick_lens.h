/* optics/thick_lens.h - an ideal thick lens, and a prescription with one in place of a lens. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_OPTICS_THICK_LENS_H
#define LENSCALC_OPTICS_THICK_LENS_H

#include "base/arena.h"
#include "optics/lens.h"

#include <math.h>
#include <stdbool.h>

/* A ray where it crosses a plane: place in mm, and slopes dx/dz and dy/dz (not sines). */
struct slope_ray {
    double x, y, p, q;
};

enum { THICK_DISTORTIONS = 3 };

/* Signs as for surfaces: n is negative where light runs to the left. */
struct thick_lens {
    double focal;                         /* 1/power, mm, in any media */
    double front;                         /* H from the front reference plane, mm */
    double rear;                          /* H' from the rear reference plane, mm */
    double index_object, index_image;     /* n, n' */
    double distortion[THICK_DISTORTIONS]; /* d1, d2, d3 */
    double object; /* distance of the object to the left of the front reference plane, mm; infinite
                      for distant ones; only distortion asks for it */
};

/*
 * Slopes behind the principal planes.
 *
 * Given     power   1/focal, 1/mm
 *           n, m    index before and behind
 *           slope   before, in one section
 *           height  at H, in that section; the ray leaves H' at the same height
 * Formula   n' u' = n u - P h with u the tangent, for rays of any height and slope: it takes
 *           points to points, lines to lines and planes to planes (a collineation), and is the
 *           paraxial lens wherever that is
 * Source    [BornWolf99] 4.3
 */
static inline double thick_lens_slope(double power, double n, double m, double slope, double height)
{
    return (n * slope - power * height) / m;
}

/* Slopes of the line from the object point of a ray through H on the axis. */
static inline void thick_lens_line(const struct thick_lens *lens, struct slope_ray ray, double *u,
                                   double *v)
{
    const bool is_near = isfinite(lens->object);
    *u = is_near ? (ray.p * lens->object - ray.x) / (lens->object + lens->front) : ray.p;
    *v = is_near ? (ray.q * lens->object - ray.y) / (lens->object + lens->front) : ray.q;
}

/*
 * A ray from the front to the rear reference plane.
 *
 * Formula   h = x + H p; s = p^2 + q^2 for an object at infinity, else of the line from the object
 *           point through H on the axis; n' p' = n (p + w d) - P h with w that line's slope and
 *           d = d1 s + d2 s^2 + d3 s^3: all rays of a point meet again in one point, whose
 *           height is that of the perspective image times 1 + d
 */
static inline struct slope_ray thick_lens_map(const struct thick_lens *lens, struct slope_ray ray)
{
    double x = ray.x + lens->front * ray.p, y = ray.y + lens->front * ray.q;
    double power = 1 / lens->focal, n = lens->index_object, m = lens->index_image;
    double u, v;
    thick_lens_line(lens, ray, &u, &v);
    double s = u * u + v * v;
    double d = s * (lens->distortion[0] + s * (lens->distortion[1] + s * lens->distortion[2]));
    struct slope_ray out = {.p = thick_lens_slope(power, n, m, ray.p + u * d, x),
                            .q = thick_lens_slope(power, n, m, ray.q + v * d, y)};
    out.x = x - lens->rear * out.p;
    out.y = y - lens->rear * out.q;
    return out;
}

/*
 * The ray that a hole in H would pass in place of the lens: from the same point of the object.
 *
 * Formula   that line's slope w in place of p, h = 0; the ray leaves H' on the axis
 */
static inline struct slope_ray thick_lens_pinhole(const struct thick_lens *lens,
                                                  struct slope_ray ray)
{
    double u, v;
    thick_lens_line(lens, ray, &u, &v);
    struct slope_ray out = {.p = lens->index_object * u / lens->index_image,
                            .q = lens->index_object * v / lens->index_image};
    out.x = -lens->rear * out.p;
    out.y = -lens->rear * out.q;
    return out;
}

/* What stands in for the lens. Places as in struct thick_lens. */
struct thick_stand_in {
    struct thick_lens thick;
    double length;         /* of the real lens, first to last vertex, mm */
    double pupil;          /* place of the entrance pupil, mm; NaN = no stop */
    double pupil_diameter; /* mm */
    double fnumber;        /* where there is no stop; NaN = no aperture */
    double image;          /* from the last vertex, mm */
    const char *title, *note;
};

/*
 * The lens with its surfaces replaced: a plane at the first vertex, the entrance pupil as stop, the
 * thick lens, a plane at the last vertex. So H, H', pupils and focal points are counted from the
 * same places as before. Object, fields, wavelengths and media outside stay.
 *
 * Given     lens  in one position
 * Result    passes lens_check; what it points to lies in the arena or belongs to `lens`
 */
struct lens thick_element_lens(const struct lens *lens, const struct thick_stand_in *stand_in,
                               struct arena *arena);

#endif
