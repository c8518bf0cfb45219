/* tests/unit/merit_truth.h - residuals of spots in 113 bits, as their definition says. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TESTS_UNIT_MERIT_TRUTH_H
#define LENSCALC_TESTS_UNIT_MERIT_TRUTH_H

#include "quad.h"

#include "design/merit/merit_bundle.h"

/* What of the primary wavelength rays are aimed by. */
struct truth_first {
    real pupil, radius; /* entrance pupil: place, and radius */
    real stop;          /* radius */
    real image, power, magnification, n;
    real exit; /* place of the exit pupil */
};

static real truth_size(real x)
{
    return x < 0 ? -x : x;
}

/* Two basic rays through a lens: heights and n u, unfolded by the sign of n. */
struct truth_rays {
    real y[2], v[2];
};

static void truth_paraxial(const struct system *system, struct truth_rays *whole,
                           struct truth_rays *front)
{
    const struct lens *lens = system->lens;
    real n = precise_of(system->n[0]);
    *whole = (struct truth_rays){{1, 0}, {0, 1}};
    for (size_t i = 0; i < lens->surface_count; i++) {
        const struct surface *surface = &lens->surfaces[i];
        const struct precise_shape shape = precise_shape_of(surface);
        const real c = (shape.c + 2 * shape.coefficient[0]) * shape.wy;
        const real size = precise_of(system->n[i + 1]);
        const real after = surface_reflects(surface) ? -n : n < 0 ? -size : size;
        if (i == lens->stop) {
            *front = *whole;
        }
        for (int k = 0; k < 2; k++) {
            whole->v[k] -= whole->y[k] * (after - n) * c;
            if (i + 1 < lens->surface_count) {
                whole->y[k] += whole->v[k] * precise_of(surface->thickness.value) / after;
            }
        }
        n = after;
    }
}

/* The radius of the entrance pupil that the aperture says. */
static real truth_radius(const struct lens *lens, const struct truth_first *first, real last,
                         double fnumber)
{
    const real value = precise_of(lens->aperture.value);
    if (!isnan(fnumber)) {
        return truth_size(last / first->power) / (real)fnumber / 2;
    }
    if (lens->aperture_kind == APERTURE_EPD) {
        return value / 2;
    }
    if (lens->aperture_kind == APERTURE_FNUMBER) {
        return truth_size(last / first->power) / value / 2;
    }
    if (lens->aperture_kind == APERTURE_NA) {
        return value / precise_root(first->n * first->n - value * value) *
               (precise_of(lens->object.value) + first->pupil);
    }
    return 0;
}

/* fnumber: NaN = as the lens says */
static struct truth_first truth_first_of(const struct system *primary, double fnumber)
{
    const struct lens *lens = primary->lens;
    struct truth_rays whole, front = {{0}, {0}};
    struct truth_first first = {.n = precise_of(primary->n[0])};
    real last = precise_of(primary->n[lens->surface_count]);
    truth_paraxial(primary, &whole, &front);
    for (size_t i = 0; i < lens->surface_count; i++) {
        last = surface_reflects(&lens->surfaces[i]) ? -last : last;
    }
    first.power = -whole.v[0];
    first.pupil = first.n * front.y[1] / front.y[0];
    first.image = -last * whole.y[0] / whole.v[0];
    if (!lens->object_is_infinite) {
        const real reach = precise_of(lens->object.value) / first.n;
        first.magnification = 1 / (whole.v[0] * reach + whole.v[1]);
        first.image = -last * (whole.y[0] * reach + whole.y[1]) * first.magnification;
    }
    /* the chief ray of height -b1 and slope a1 */
    first.exit = -last * (whole.y[1] * front.y[0] - whole.y[0] * front.y[1]) /
                 (whole.v[1] * front.y[0] - whole.v[0] * front.y[1]);
    first.radius = truth_radius(lens, &first, last, fnumber);
    first.stop = truth_size(first.radius * front.y[0]);
    if (lens->aperture_kind == APERTURE_STOP && isnan(fnumber)) {
        first.stop = precise_of(lens->surfaces[lens->stop].diameter.value) / 2;
        first.radius = truth_size(first.stop / front.y[0]);
    }
    if (lens->focus == FOCUS_TABLE) {
        first.image = precise_of(lens->surfaces[lens->surface_count - 1].thickness.value);
    }
    return first;
}

/* A ray of a field point through a point of space: where it starts, at z = 0. */
static struct precise_ray truth_ray(const struct lens *lens, const struct field_point *field,
                                    const struct truth_first *first, const real through[3])
{
    struct precise_ray ray = {.path = 0};
    real u[3] = {0, 0, 1}, length = 0;
    for (int k = 0; k < 2; k++) {
        const real value = (real)field->value[k];
        if (field->kind == FIELD_ANGLE) {
            real cosine, sine;
            precise_turn(value, &cosine, &sine);
            u[k] = sine / cosine;
        } else if (field->kind == FIELD_IMAGE && lens->object_is_infinite) {
            u[k] = value * first->power / first->n;
        }
    }
    if (!lens->object_is_infinite) {
        const real distance = precise_of(lens->object.value);
        u[2] = through[2] + distance;
        for (int k = 0; k < 2; k++) {
            const real value = (real)field->value[k];
            const real point = field->kind == FIELD_ANGLE    ? -u[k] * distance
                               : field->kind == FIELD_HEIGHT ? value
                               : field->kind == FIELD_IMAGE  ? value / first->magnification
                                                             : 0;
            u[k] = through[k] - point;
        }
    }
    length = precise_root(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
    for (int k = 0; k < 3; k++) {
        ray.x[k] = through[k] - u[k] * through[2] / u[2];
        ray.p[k] = first->n * u[k] / length;
    }
    /* less that to the first vertex, or whatever is the same for all rays of the point */
    ray.path = lens->object_is_infinite
                   ? ray.x[0] * ray.p[0] + ray.x[1] * ray.p[1]
                   : first->n * (length * (1 - through[2] / u[2]) - precise_of(lens->object.value));
    return ray;
}

/* One ray to be traced. */
struct truth_question {
    const struct system *system; /* at its wavelength */
    const struct truth_first *first;
    const struct field_point *field;
    bool from_entrance;
    real x, y;     /* in radii */
    real begin[2]; /* near where it crosses z = 0 */
};

/* Newton's method on where the ray crosses z = 0, its slopes by differences. */
static bool truth_aim(const struct truth_question *q, struct precise_ray *ray)
{
    const struct lens *lens = q->system->lens;
    const real goal[2] = {q->x * q->first->stop, q->y * q->first->stop}, h = (real)1e-12;
    real at[3] = {q->begin[0], q->begin[1], 0};
    for (int turn = 0; turn < 6; turn++) {
        real here[2], beside[2], m[4];
        if (!quad_to_stop(q->system, truth_ray(lens, q->field, q->first, at), here)) {
            return false;
        }
        const real x = goal[0] - here[0], y = goal[1] - here[1];
        if (truth_size(x) + truth_size(y) < (real)1e-25) {
            break;
        }
        for (int k = 0; k < 2; k++) {
            real moved[3] = {at[0], at[1], 0};
            moved[k] += h;
            if (!quad_to_stop(q->system, truth_ray(lens, q->field, q->first, moved), beside)) {
                return false;
            }
            m[k] = (beside[0] - here[0]) / h;
            m[2 + k] = (beside[1] - here[1]) / h;
        }
        const real det = m[0] * m[3] - m[1] * m[2];
        at[0] += (m[3] * x - m[1] * y) / det;
        at[1] += (m[0] * y - m[2] * x) / det;
    }
    *ray = truth_ray(lens, q->field, q->first, at);
    return true;
}

/* Where it starts, at z = 0. */
static bool truth_start_of(const struct truth_question *q, struct precise_ray *ray)
{
    const real through[3] = {q->x * q->first->radius, q->y * q->first->radius, q->first->pupil};
    if (!q->from_entrance) {
        return truth_aim(q, ray);
    }
    *ray = truth_ray(q->system->lens, q->field, q->first, through);
    return true;
}

/* From there to where it meets the image plane, with its path. */
static bool truth_trace(const struct truth_question *q, struct precise_ray *ray)
{
    const struct lens *lens = q->system->lens;
    for (size_t i = 0; i < lens->surface_count; i++) {
        if (!precise_surface(ray, q->system, i)) {
            return false;
        }
    }
    const real n = precise_of(q->system->n[lens->surface_count]);
    ray->x[2] -= q->first->image;
    precise_advance(ray, -ray->x[2] / ray->p[2], n * n);
    return true;
}

static bool truth_end(const struct truth_question *q, struct precise_ray *end)
{
    return truth_start_of(q, end) && truth_trace(q, end);
}

/* From the end of a ray along it to the sphere about a chief ray's, through its crossing of a plane
   `way` along that, mm. */
static real truth_meeting(const struct precise_ray *chief, const struct precise_ray *ray, real way,
                          real n)
{
    real along = 0, square = 0;
    for (int k = 0; k < 2; k++) {
        const real d = ray->x[k] - chief->x[k];
        along += d * ray->p[k] / n;
        square += d * d;
    }
    /* |X + t e - C| = R, on the side of the pupil */
    const real root = precise_root(along * along - square + way * way);
    return way > 0 ? -along + root : -along - root;
}

/* The optical path to the sphere about a chief ray's end, through its crossing of a plane. */
static inline real truth_path(const struct precise_ray *chief, const struct precise_ray *ray,
                              real pupil, real n)
{
    const real way = n * pupil / chief->p[2];
    return ray->path + n * (truth_meeting(chief, ray, way, n) - way);
}

#endif
