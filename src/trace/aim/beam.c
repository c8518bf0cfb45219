/* trace/aim/beam.c - rays of one object point. */
/* SPDX-License-Identifier: MIT */
#include "trace/aim/beam.h"

#include "base/constants.h"
#include "trace/dispatch.h"

#include <math.h>

/* Across the axis: sagittal at right angles to the z axis too, meridional upwards. */
static void set_across(struct beam *beam)
{
    const double *d = beam->axis;
    double side = sqrt(d[0] * d[0] + d[1] * d[1]);
    double up[2] = {side > 0 ? d[0] / side : 0, side > 0 ? d[1] / side : 1};
    if (up[1] < 0 || (up[1] == 0 && up[0] < 0)) {
        /* the same two axes for a field and its opposite */
        up[0] = -up[0];
        up[1] = -up[1];
        side = -side;
    }
    double *sagittal = beam->across[0], *meridional = beam->across[1];
    sagittal[0] = up[1];
    sagittal[1] = -up[0];
    sagittal[2] = 0;
    meridional[0] = up[0] * d[2];
    meridional[1] = up[1] * d[2];
    meridional[2] = -side;
}

struct beam beam_along(const double direction[3], double n)
{
    struct beam beam = {
        .axis = {direction[0], direction[1], direction[2]}, .distance = INFINITY, .n = n};
    set_across(&beam);
    return beam;
}

struct beam beam_from_infinity(const double angle[2], double n)
{
    double axis[3];
    if (angle[0] == 0 || angle[1] == 0) {
        double t = fabs(angle[0]) + fabs(angle[1]), sine = sin(t), scale = t > 0 ? sine / t : 1;
        axis[0] = angle[0] * scale;
        axis[1] = angle[1] * scale;
        axis[2] = cos(t);
    } else {
        double x = tan(angle[0]), y = tan(angle[1]), length = sqrt(1 + x * x + y * y);
        axis[0] = x / length;
        axis[1] = y / length;
        axis[2] = 1 / length;
    }
    return beam_along(axis, n);
}

bool beam_from_point(const double point[3], double n, struct beam *beam, struct error *error)
{
    double length = hypot(hypot(point[0], point[1]), point[2]);
    if (!(length > 0)) {
        return fail(error, ERROR_DOMAIN, "the object lies in the first vertex of the lens");
    }
    double sign = point[2] > 0 ? 1 : -1;
    *beam = (struct beam){.distance = -sign * length, .n = n};
    for (int i = 0; i < 3; i++) {
        beam->axis[i] = sign * point[i] / length;
    }
    set_across(beam);
    return true;
}

struct beam beam_from_film(const double point[3], double n)
{
    double length = hypot(hypot(point[0], point[1]), point[2]);
    struct beam beam = {.distance = length, .n = n};
    for (int i = 0; i < 3; i++) {
        beam.axis[i] = -point[i] / length;
    }
    set_across(&beam);
    return beam;
}

struct beam beam_to_pupil(const double point[3], double pupil, double n)
{
    /* where the way to the middle of the pupil crosses the plane of the vertex */
    const double share =
        isfinite(pupil) && fabs(pupil - point[2]) > 0 ? pupil / (pupil - point[2]) : 1;
    const double foot[3] = {share * point[0], share * point[1], 0};
    const double from[3] = {point[0] - foot[0], point[1] - foot[1], point[2]};
    struct beam beam = beam_from_film(from, n);
    beam.foot[0] = foot[0];
    beam.foot[1] = foot[1];
    return beam;
}

static bool from_angle(const double angle[2], const struct conjugate_object *object, double n,
                       struct beam *beam, struct error *error)
{
    const double degree = DEGREES_PER_RADIAN;
    bool both = angle[0] != 0 && angle[1] != 0;
    double t = fmax(fabs(angle[0]), fabs(angle[1]));
    if (both && !(t < PI / 2)) {
        return fail(error, ERROR_DOMAIN,
                    "a field of the angles %.6g and %.6g deg: where there is one in x and one in y "
                    "both must be below 90",
                    angle[0] * degree, angle[1] * degree);
    }
    if (object->is_infinite) {
        if (!(t < PI)) {
            return fail(error, ERROR_DOMAIN, "a field angle of %.6g deg: it must be below 180",
                        t * degree);
        }
        *beam = beam_from_infinity(angle, n);
        return true;
    }
    if (!(t < PI / 2)) {
        return fail(error, ERROR_DOMAIN,
                    "a field angle of %.6g deg: for an object at a distance it must be below 90",
                    t * degree);
    }
    double distance = object->distance.hi, point[3] = {0, 0, -distance};
    for (int i = 0; i < 2; i++) {
        double size = fabs(angle[i]);
        point[i] = size > 0 ? angle[i] * (-distance * tan(size) / size) : 0;
    }
    return beam_from_point(point, n, beam, error);
}

bool beam_of_field(const struct field_point *field, const struct conjugate_object *object,
                   const struct first_order *first, struct beam *beam, struct error *error)
{
    double n = fabs(first->index_object), value[2] = {field->value[0], field->value[1]};
    if (field->kind == FIELD_NONE) {
        value[0] = value[1] = 0;
    }
    if (field->kind == FIELD_HEIGHT || (field->kind == FIELD_IMAGE && !object->is_infinite)) {
        double m = field->kind == FIELD_IMAGE ? first->magnification : 1;
        if (object->is_infinite || !(m != 0)) {
            return fail(error, ERROR_DOMAIN,
                        "the field is an object's height, but the object is infinitely far away");
        }
        if (isinf(m)) {
            return fail(error, ERROR_DOMAIN,
                        "the field is an image height, but the image is infinitely far away");
        }
        double point[3] = {value[0] / m, value[1] / m, -object->distance.hi};
        return beam_from_point(point, n, beam, error);
    }
    if (field->kind == FIELD_IMAGE) {
        if (first->is_afocal) {
            return fail(error, ERROR_DOMAIN,
                        "the field is an image height, but the lens is afocal");
        }
        for (int i = 0; i < 2; i++) {
            value[i] = atan(-value[i] * first->matrix.c.hi / first->index_object);
        }
    }
    if (field->kind == FIELD_REAL) {
        return fail(error, ERROR_DOMAIN, "the field is the height of a real image");
    }
    return from_angle(value, object, n, beam, error);
}

struct ray beam_ray(const struct beam *beam, double a, double b)
{
    struct ray ray = {.status = RAY_OK};
    double across[3];
    for (int i = 0; i < 3; i++) {
        across[i] = a * beam->across[0][i] + b * beam->across[1][i];
        ray.point[i] = across[i];
        ray.cosine[i] = beam->axis[i];
    }
    if (isinf(beam->distance)) {
        return ray;
    }
    double d = fabs(beam->distance), sign = beam->distance > 0 ? 1 : -1, r2 = a * a + b * b;
    double length = sqrt(d * d + r2);
    for (int i = 0; i < 3; i++) {
        ray.point[i] = beam->foot[i] + across[i];
        ray.cosine[i] = (d * beam->axis[i] + sign * across[i]) / length;
    }
    ray.path = sign * beam->n * (r2 / (length + d));
    return ray;
}

void beam_slope(const struct beam *beam, const double at[2], int k, double point[3],
                double direction[3])
{
    const double d = beam->distance, *across = beam->across[k], sign = d > 0 ? 1 : -1;
    const double over = isinf(d) ? 0 : 1 / sqrt(d * d + at[0] * at[0] + at[1] * at[1]);
    const struct ray ray = beam_ray(beam, at[0], at[1]);
    for (int i = 0; i < 3; i++) {
        point[i] = across[i];
        direction[i] = beam->n * over * (sign * across[i] - over * at[k] * ray.cosine[i]);
    }
}

void beam_start(const struct beam *beam, const double *a, const double *b, size_t count,
                struct ray_block *block)
{
    KERNEL_FOR(SET_BEST, kernel_beam)(beam, a, b, count, block);
}

void beam_fill(const struct beam *beam, const double (*at)[2], size_t count,
               struct ray_block *block)
{
    double a[RAYS_BLOCK], b[RAYS_BLOCK];
    for (size_t i = 0; i < count; i++) {
        a[i] = at[i][0];
        b[i] = at[i][1];
    }
    beam_start(beam, a, b, count, block);
}

static double dot_product(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

void beam_tangents(const struct beam *beam, const double way[2], const struct ray_block *rays,
                   size_t count, struct ray_block *tangents)
{
    const double d = beam->distance, n = beam->n, *foot = beam->foot;
    double u[3];
    for (int j = 0; j < 3; j++) {
        u[j] = way[0] * beam->across[0][j] + way[1] * beam->across[1][j];
    }
    for (size_t i = 0; i < count; i++) {
        double turn[3] = {0, 0, 0};
        if (isfinite(d)) {
            /* the direction is the point less the object, of length sqrt(d^2 + r^2) */
            const double x = rays->x[i] - foot[0], y = rays->y[i] - foot[1];
            const double z = rays->z[i] - foot[2], square = d * d + x * x + y * y + z * z;
            const double p = rays->p[i] / n, q = rays->q[i] / n, r = rays->r[i] / n;
            const double along = u[0] * p + u[1] * q + u[2] * r;
            const double over = copysign(n / sqrt(square), d);
            turn[0] = (u[0] - along * p) * over;
            turn[1] = (u[1] - along * q) * over;
            turn[2] = (u[2] - along * r) * over;
        }
        tangents->x[i] = u[0], tangents->y[i] = u[1], tangents->z[i] = u[2];
        tangents->p[i] = turn[0], tangents->q[i] = turn[1], tangents->r[i] = turn[2];
        tangents->path[i] = 0;
    }
}

void beam_place(const struct beam *beam, const double at[3], double place[2])
{
    const double point[3] = {at[0] - beam->foot[0], at[1] - beam->foot[1], at[2] - beam->foot[2]};
    double a = dot_product(point, beam->across[0]), b = dot_product(point, beam->across[1]);
    if (isinf(beam->distance)) {
        place[0] = a;
        place[1] = b;
        return;
    }
    /* seen from the object, at distance + along */
    double along = dot_product(point, beam->axis),
           scale = beam->distance / (beam->distance + along);
    place[0] = a * scale;
    place[1] = b * scale;
}
