/* tests/stress/quad_ray.c - exact rays in 113 bits as textbooks have them. */
/* SPDX-License-Identifier: MIT */
#include "quad_ray.h"

#include <math.h>
#include <string.h>

static quad dot(const quad a[3], const quad b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void quad_ray_go(struct quad_ray *ray, quad length)
{
    for (int i = 0; i < 3; i++) {
        ray->x[i] += length * ray->d[i];
    }
    ray->path += ray->n * length;
    ray->length += ray->n * quad_size(length);
}

/* Axes that are turned right-handed about one of them see a vector so. */
static void quad_turn_axes(quad v[3], int axis, quad angle)
{
    const quad c = quad_cosine(angle), s = quad_sine(angle);
    const quad y = v[(axis + 1) % 3], z = v[(axis + 2) % 3];
    v[(axis + 1) % 3] = c * y + s * z;
    v[(axis + 2) % 3] = c * z - s * y;
}

/* Into axes that are shifted, then turned about x and the new y. */
static void quad_ray_into(struct quad_ray *ray, const quad shift[2], const quad turn[2])
{
    ray->x[0] -= shift[0];
    ray->x[1] -= shift[1];
    for (int axis = 0; axis < 2; axis++) {
        if (turn[axis] != 0) {
            quad_turn_axes(ray->x, axis, turn[axis]);
            quad_turn_axes(ray->d, axis, turn[axis]);
        }
    }
}

static void quad_ray_out(struct quad_ray *ray, const struct quad_surface *surface)
{
    for (int axis = 1; axis >= 0; axis--) {
        if (surface->tilt[axis] != 0) {
            quad_turn_axes(ray->x, axis, -surface->tilt[axis]);
            quad_turn_axes(ray->d, axis, -surface->tilt[axis]);
        }
    }
    ray->x[0] += surface->decenter[0];
    ray->x[1] += surface->decenter[1];
}

/* From behind the surface before into a surface's own axes, by way of a break of the axis. */
static void quad_ray_to_axes(const struct quad_lens *lens, size_t i, struct quad_ray *ray)
{
    const struct quad_surface *surface = &lens->surfaces[i];
    ray->x[2] -= i > 0 ? lens->surfaces[i - 1].t : 0;
    quad_ray_into(ray, surface->break_decenter, surface->break_tilt);
    quad_ray_into(ray, surface->decenter, surface->tilt);
}

/* z - sag and its gradient, (0, 0, 0) at the vertex; false beyond the conic. */
static bool sag_gradient(const struct quad_surface *surface, const quad x[3], quad *above,
                         quad gradient[3])
{
    const quad *w = surface->weight;
    const bool is_odd = surface->A3 != 0 || surface->A5 != 0;
    const quad u = w[0] * x[0] * x[0] + w[1] * x[1] * x[1], c = surface->c;
    const quad r = is_odd ? quad_root(u) : 0;
    const quad inside = 1 - (1 + surface->k) * c * c * u;
    if (!(inside > 0)) {
        return false;
    }
    const quad root = quad_root(inside);
    const quad sag = c * u / (1 + root) + u * u * (surface->A4 + u * surface->A6) +
                     u * r * (surface->A3 + u * surface->A5);
    const quad slope = c / root + u * (4 * surface->A4 + 6 * u * surface->A6) +
                       r * (3 * surface->A3 + 5 * u * surface->A5); /* over r */
    *above = x[2] - sag;
    gradient[0] = -slope * w[0] * x[0];
    gradient[1] = -slope * w[1] * x[1];
    gradient[2] = 1;
    return true;
}

/* What stands for a scalar product in the conic of a surface. */
static quad conic_product(const struct quad_surface *surface, const quad a[3], const quad b[3])
{
    const quad *w = surface->weight;
    return w[0] * a[0] * b[0] + w[1] * a[1] * b[1] + (1 + surface->k) * a[2] * b[2];
}

static void conic_gradient(const struct quad_surface *surface, const quad x[3], quad gradient[3])
{
    gradient[0] = -surface->c * surface->weight[0] * x[0];
    gradient[1] = -surface->c * surface->weight[1] * x[1];
    gradient[2] = 1 - surface->c * (1 + surface->k) * x[2];
}

/* Of the conic's two places the one on the vertex's sheet that light comes to from its front. */
static bool quad_ray_to_conic(const struct quad_surface *surface, struct quad_ray *ray)
{
    const quad c = surface->c;
    const quad *x = ray->x, *d = ray->d;
    const quad a = c * conic_product(surface, d, d);
    const quad b = c * conic_product(surface, x, d) - d[2];
    const quad e = c * conic_product(surface, x, x) - 2 * x[2];
    const quad square = b * b - a * e, largest = b * b + quad_size(a * e);
    ray->margin = fmin(ray->margin, largest > 0 ? (double)quad_size(square / largest) : 0);
    if (!(square >= 0)) {
        return false;
    }
    const quad q = -(b + (b < 0 ? -1 : 1) * quad_root(square));
    const quad lengths[2] = {q != 0 ? e / q : 0, a != 0 ? q / a : (quad)NAN};
    for (int i = 0; i < 2; i++) {
        if (!quad_is_finite(lengths[i])) {
            continue;
        }
        quad there[3], normal[3];
        for (int k = 0; k < 3; k++) {
            there[k] = x[k] + lengths[i] * d[k];
        }
        conic_gradient(surface, there, normal);
        if (normal[2] > 0 && dot(normal, d) * (quad)ray->way > 0) {
            ray->margin = fmin(ray->margin, (double)normal[2]);
            quad_ray_go(ray, lengths[i]);
            return true;
        }
    }
    return false;
}

static bool quad_ray_to_asphere(const struct quad_surface *surface, struct quad_ray *ray)
{
    const struct quad_ray before = *ray;
    quad above = 0, gradient[3];
    if (!quad_ray_to_conic(surface, ray)) {
        *ray = before; /* it may meet what lies beside the conic: begin in the vertex plane */
        quad_ray_go(ray, -ray->x[2] / ray->d[2]);
    }
    for (int i = 0; i < 40; i++) {
        if (!sag_gradient(surface, ray->x, &above, gradient)) {
            return false;
        }
        quad_ray_go(ray, -above / dot(gradient, ray->d));
    }
    return sag_gradient(surface, ray->x, &above, gradient) &&
           quad_size(above) <=
               (quad)1e-25 * (quad_size(ray->x[2]) + quad_size(ray->x[0]) + quad_size(ray->x[1])) &&
           dot(gradient, ray->d) * (quad)ray->way > 0;
}

struct quad_ray quad_ray_of_beam(const struct beam *beam, const double at[2])
{
    struct quad_ray ray = {.n = 1, .way = 1, .margin = 1, .is_computed = true};
    quad square = 0, d = isinf(beam->distance) ? 0 : (quad)beam->distance;
    for (int i = 0; i < 3; i++) {
        ray.x[i] = (quad)at[0] * (quad)beam->across[0][i] + (quad)at[1] * (quad)beam->across[1][i];
        ray.d[i] = d == 0 ? (quad)beam->axis[i] : ray.x[i] + d * (quad)beam->axis[i];
        square += ray.d[i] * ray.d[i];
    }
    const quad length = quad_root(square);
    for (int i = 0; i < 3; i++) {
        ray.d[i] /= length;
    }
    ray.path = d == 0 ? 0 : length - d;
    return ray;
}

bool quad_ray_meet(const struct quad_surface *surface, struct quad_ray *ray)
{
    const bool is_conic =
        surface->A4 == 0 && surface->A6 == 0 && surface->A3 == 0 && surface->A5 == 0;
    quad above, gradient[3];
    quad_ray_go(ray, -dot(ray->x, ray->d)); /* from where it is nearest to the vertex */
    if (!(is_conic ? quad_ray_to_conic(surface, ray) : quad_ray_to_asphere(surface, ray))) {
        return false;
    }
    if (is_conic) {
        conic_gradient(surface, ray->x, gradient);
    } else if (!sag_gradient(surface, ray->x, &above, gradient)) {
        return false;
    }
    const quad length = quad_root(dot(gradient, gradient));
    const quad cosine = dot(gradient, ray->d) / length;
    const quad ratio = surface->reflects ? 1 : ray->n / surface->n;
    const quad square = 1 - ratio * ratio * (1 - cosine * cosine);
    if (surface->reflects) {
        ray->way = -ray->way;
    } else {
        ray->margin = fmin(ray->margin, (double)quad_size(square));
    }
    if (square < 0) {
        return false;
    }
    const quad after = (cosine < 0 ? -1 : 1) * (surface->reflects ? -1 : 1) * quad_root(square);
    for (int i = 0; i < 3; i++) {
        ray->d[i] = ratio * ray->d[i] + (after - ratio * cosine) * gradient[i] / length;
    }
    ray->n = surface->n;
    return true;
}

static void quad_ray_nudge(const struct quad_nudge *nudge, struct quad_ray *ray)
{
    const bool is_start = nudge->surface == QUAD_START && !ray->is_computed;
    const int k = nudge->component % 3;
    if (nudge->component < 3) {
        ray->x[k] += nudge->by * (is_start ? ray->x[k] : quad_root(dot(ray->x, ray->x)));
    } else if (nudge->component < 6) {
        ray->d[k] += nudge->by * (is_start ? ray->d[k] : 1);
        const quad length = quad_root(dot(ray->d, ray->d));
        for (int i = 0; i < 3; i++) {
            ray->d[i] /= length;
        }
    } else {
        ray->path += nudge->by * ray->path;
    }
}

bool quad_ray_trace(const struct quad_lens *lens, const struct quad_nudge *nudge,
                    struct quad_ray *ray)
{
    if (nudge != NULL && nudge->surface == QUAD_START) {
        quad_ray_nudge(nudge, ray);
    }
    for (size_t i = 0; i < lens->count; i++) {
        const struct quad_surface *surface = &lens->surfaces[i];
        quad_ray_to_axes(lens, i, ray);
        if (!quad_ray_meet(surface, ray)) {
            return false;
        }
        quad_ray_out(ray, surface);
        if (nudge != NULL && nudge->surface == i) {
            quad_ray_nudge(nudge, ray);
        }
    }
    return true;
}

bool quad_ray_to_stop(const struct quad_lens *lens, size_t stop, struct quad_ray *ray)
{
    for (size_t i = 0; i <= stop; i++) {
        quad_ray_to_axes(lens, i, ray);
        if (!quad_ray_meet(&lens->surfaces[i], ray)) {
            return false;
        }
        if (i < stop) {
            quad_ray_out(ray, &lens->surfaces[i]);
        }
    }
    return true;
}

static bool quad_change(const struct quad_lens *lens, const struct quad_question *question,
                        const struct quad_nudge *nudge, const quad *here, double *sums)
{
    quad there[QUAD_FIGURES];
    if (!question->find(lens, nudge, question->context, there)) {
        return false;
    }
    for (int k = 0; k < question->figures; k++) {
        sums[k] += (double)(quad_size(there[k] - here[k]) / question->step);
    }
    return true;
}

bool quad_sensitivity(const struct quad_lens *lens, const struct quad_question *question,
                      double *sums)
{
    static struct quad_lens moved;
    quad here[QUAD_FIGURES];
    bool good = question->find(lens, NULL, question->context, here);
    moved.count = lens->count;
    moved.stop = lens->stop;
    moved.object = lens->object;
    memcpy(moved.surfaces, lens->surfaces, lens->count * sizeof lens->surfaces[0]);
    memset(sums, 0, (size_t)question->figures * sizeof *sums);
    for (size_t i = 0; i < QUAD_NUMBERS * lens->count && good; i++) {
        quad *number = quad_lens_number(&moved, i);
        const quad before = *number;
        if (before != 0) {
            *number += before * question->step;
            good = quad_change(&moved, question, NULL, here, sums);
            *number = before;
        }
    }
    for (size_t i = 0; i < 7 * (lens->count + 1) && good; i++) {
        const size_t surface = i / 7 < lens->count ? i / 7 : QUAD_START;
        const struct quad_nudge nudge = {surface, (int)(i % 7), question->step};
        good = quad_change(lens, question, &nudge, here, sums);
    }
    return good;
}
