/* tests/truth/clear_rays.h - for clear_sums.c: one ray through a lens. */
/* SPDX-License-Identifier: MIT */
#ifndef CLEAR_RAYS_H
#define CLEAR_RAYS_H

#include <math.h>
#include <stdbool.h>

enum { SURFACES = 64, WAVES = 8, TERMS = 8 };

struct surface {
    double c, k, z, clear, blocked, terms[TERMS], n[WAVES];
    double bends[2]; /* 1: curved along x, along y; 0: a cylinder is straight there */
    bool is_mirror, has_terms;
};

static struct surface surfaces[SURFACES];
static int surface_count, wave_count, stop;
static double stop_radius, image_z, weights[WAVES];

struct ray {
    double p[3], d[3], path; /* path: times the index */
};

/* -------- one ray -------- */

static double along(const struct surface *s, const double *a, const double *b)
{
    return s->bends[0] * a[0] * b[0] + s->bends[1] * a[1] * b[1];
}

static double sag_of(const struct surface *s, double r2, double *slope)
{
    const double root = sqrt(1 - (1 + s->k) * s->c * s->c * r2);
    double z = s->c * r2 / (1 + root), power = 1;
    *slope = s->c / (2 * root); /* d sag/d(r^2) */
    for (int i = 0; i < TERMS && s->has_terms; i++) {
        *slope += (i + 1) * s->terms[i] * power;
        power *= r2;
        z += s->terms[i] * power;
    }
    return z;
}

static void advance(struct ray *ray, double t)
{
    for (int i = 0; i < 3; i++) {
        ray->p[i] += t * ray->d[i];
    }
}

/* To the sheet of the conic about its vertex; z from there. way: +1 crossing it to the right. */
static bool meet_conic(const struct surface *s, double c, int way, struct ray *ray)
{
    const double *p = ray->p, *d = ray->d;
    advance(ray, -(p[0] * d[0] + p[1] * d[1] + p[2] * d[2]));
    const double e = 1 + s->k;
    const double a = c * (along(s, d, d) + e * d[2] * d[2]);
    const double b = d[2] - c * (along(s, p, d) + e * p[2] * d[2]);
    const double f = c * (along(s, p, p) + e * p[2] * p[2]) - 2 * p[2];
    const double square = b * b - a * f;
    if (!(square >= 0)) {
        return false;
    }
    advance(ray, f / (b + way * sqrt(square)));
    return 1 - e * c * p[2] > 0;
}

static bool meet(const struct surface *s, int way, struct ray *ray)
{
    if (!s->has_terms) {
        return meet_conic(s, s->c, way, ray);
    }
    struct ray start = *ray;
    if (!meet_conic(s, s->c + 2 * s->terms[0], way, &start)) {
        start = *ray;
        advance(&start, -start.p[2] / start.d[2]);
    }
    *ray = start;
    for (int turn = 0; turn < 60; turn++) {
        double slope, *p = ray->p, *d = ray->d;
        const double miss = sag_of(s, along(s, p, p), &slope) - p[2];
        const double step = miss / (d[2] - 2 * slope * along(s, p, d));
        if (!isfinite(step)) {
            return false;
        }
        advance(ray, step);
        if (fabs(step) < 1e-14 * (1 + fabs(p[2]))) {
            return true;
        }
    }
    return false;
}

static bool turn(const struct surface *s, int way, double before, double behind, struct ray *ray)
{
    double slope, *d = ray->d, normal[3], across = 0, length = 0;
    sag_of(s, along(s, ray->p, ray->p), &slope);
    normal[0] = -2 * slope * s->bends[0] * ray->p[0] * way;
    normal[1] = -2 * slope * s->bends[1] * ray->p[1] * way;
    normal[2] = way;
    for (int i = 0; i < 3; i++) {
        across += normal[i] * d[i];
        length += normal[i] * normal[i];
    }
    length = sqrt(length);
    across /= length;
    const double ratio = before / behind, square = 1 - ratio * ratio * (1 - across * across);
    if (!(across > 0) || !(square >= 0)) {
        return false;
    }
    const double scale = s->is_mirror ? 1 : ratio;
    const double add = s->is_mirror ? -2 * across : sqrt(square) - ratio * across;
    for (int i = 0; i < 3; i++) {
        d[i] = scale * d[i] + add * normal[i] / length;
    }
    return true;
}

/* Which way light goes in front of a surface. */
static int way_before(int surface)
{
    int way = 1;
    for (int i = 0; i < surface; i++) {
        way = surfaces[i].is_mirror ? -way : way;
    }
    return way;
}

static double index_before(int surface, int wave)
{
    return surface == 0 ? 1 : surfaces[surface - 1].n[wave];
}

/* What a ray has come to. */
struct passage {
    bool arrives;
    int limit; /* the first surface that takes it, 1-based; 0: it passes */
    double at_stop[2];
    struct ray ray;
};

/* Forwards from the first surface on, or back from the last; to the stop alone, or all the way. */
static struct passage pass(struct ray ray, int wave, bool back, bool to_stop)
{
    struct passage all = {.arrives = true};
    const int last = to_stop ? stop : back ? 0 : surface_count - 1;
    int way = back ? -way_before(surface_count) : 1;
    double z = 0;
    for (int i = back ? surface_count - 1 : 0;; i += back ? -1 : 1) {
        const struct surface *s = &surfaces[i];
        ray.p[2] -= s->z - z;
        z = s->z;
        const struct ray from = ray;
        if (!meet(s, way, &ray)) {
            return (struct passage){.limit = i + 1};
        }
        for (int k = 0; k < 3; k++) {
            ray.path +=
                (back ? s->n[wave] : index_before(i, wave)) * (ray.p[k] - from.p[k]) * from.d[k];
        }
        const double r2 = ray.p[0] * ray.p[0] + ray.p[1] * ray.p[1];
        const double most = i == stop ? fmin(s->clear, stop_radius) : s->clear;
        const bool passes = r2 <= most * most && r2 >= s->blocked * s->blocked;
        all.limit = all.limit != 0 ? all.limit : passes ? 0 : i + 1;
        if (i == stop) {
            all.at_stop[0] = ray.p[0];
            all.at_stop[1] = ray.p[1];
        }
        const double n[2] = {index_before(i, wave), s->n[wave]};
        if (!turn(s, way, n[back ? 1 : 0], n[back ? 0 : 1], &ray)) {
            return (struct passage){.limit = i + 1};
        }
        way = s->is_mirror ? -way : way;
        if (i == last) {
            break;
        }
    }
    ray.p[2] += z;
    all.ray = ray;
    return all;
}

/* -------- a beam, and its rays by two numbers -------- */

struct beam {
    bool is_film;
    double sine, cosine, height;
    int wave;
};

static struct ray ray_of(const struct beam *beam, double u, double v)
{
    if (beam->is_film) {
        const double rest = 1 - u * u - v * v;
        return (struct ray){{0, beam->height, image_z},
                            {u, v, -way_before(surface_count) * (rest > 0 ? sqrt(rest) : NAN)},
                            0};
    }
    return (struct ray){{u, v * beam->cosine, -v * beam->sine}, {0, beam->sine, beam->cosine}, 0};
}

static struct passage look(const struct beam *beam, double u, double v, bool to_stop)
{
    return pass(ray_of(beam, u, v), beam->wave, beam->is_film, to_stop);
}

/* What takes a ray; 0: it passes. */
static int limit_of(const struct beam *beam, double u, double v)
{
    return look(beam, u, v, false).limit;
}

#endif
