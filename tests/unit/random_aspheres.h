/* tests/unit/random_aspheres.h - rays at random aspheres, none of which may be lost for nothing. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TESTS_UNIT_RANDOM_ASPHERES_H
#define LENSCALC_TESTS_UNIT_RANDOM_ASPHERES_H

#include "base/constants.h"
#include "file/lens_file.h"
#include "first_meeting.h"
#include "trace/dispatch.h"

#include <stdio.h>
#include <string.h>

enum { ASPHERE_RAYS = RAYS_BLOCK };

/* How strong the surfaces are. */
struct strength {
    double curvature; /* |c| h up to this, h the radius that rays are aimed within */
    double term;      /* |A_i| h^(i - 1) up to this, before it is divided by i */
    double conic;     /* k from -this to this */
    double tilt;      /* of the rays to the axis, rad */
};

struct asphere_tally {
    size_t rays, met, none, lost, wrong, unconverged, later, differ;
    double worst; /* distance of the points, in parts of h */
};

struct random_asphere {
    struct asphere shape;
    double h, direction;
    bool reverse;
    char text[1200];
    struct arena arena;
    struct lens lens;
    struct system system;
};

/* One surface, between index 1 on the side of the light and 1.001: no ray is totally reflected. */
static inline bool random_asphere(unsigned long long *state, const struct strength *strength,
                                  struct random_asphere *one)
{
    *one = (struct random_asphere){.h = chance_between(state, 0.5, 20)};
    struct asphere *s = &one->shape;
    double h = one->h, most = strength->curvature;
    int terms = (int)chance_between(state, 1, 6);
    bool odd = chance(state) < 0.3, has_diameter = chance(state) < 0.5;
    one->reverse = chance(state) < 0.3;
    one->direction = one->reverse ? -1 : 1;
    s->c = chance(state) < 0.15 ? 0 : chance_between(state, -most, most) / h;
    s->k = chance_between(state, -strength->conic, strength->conic);
    double inside = (1 + s->k) * s->c * s->c;
    if (inside * h * h > 0.98) {
        s->c *= sqrt(0.98 / (inside * h * h));
        inside = (1 + s->k) * s->c * s->c;
    }
    s->rim = inside * 9 * h * h > 1 ? 1 / sqrt(inside) : 3 * h;
    for (int i = 0; i < terms; i++) {
        int order =
            odd ? (int)chance_between(state, 1, 10) : 2 + 2 * (int)chance_between(state, 0, 6);
        s->A[order] =
            chance_between(state, -strength->term, strength->term) / order / pow(h, order - 1);
    }
    int length = snprintf(one->text, sizeof one->text, "medium %s\nsurface - - %s ",
                          one->reverse ? "1.001" : "1", one->reverse ? "1" : "1.001");
    length += snprintf(one->text + length, sizeof one->text - (size_t)length,
                       has_diameter ? "%.17g" : "-", 2 * h);
    length += snprintf(one->text + length, sizeof one->text - (size_t)length, " c=%.17g k=%.17g",
                       s->c, s->k);
    for (int i = 1; i <= 20; i++) {
        if (s->A[i] != 0) {
            length += snprintf(one->text + length, sizeof one->text - (size_t)length, " A%d=%.17g",
                               i, s->A[i]);
        }
    }
    struct error error;
    struct system_options options = system_options_default();
    options.reverse = one->reverse;
    return lens_read("random", text_of(one->text), NULL, &one->arena, &one->lens, &error) &&
           system_compile(&one->lens, 0.55, &options, &one->arena, &one->system, &error);
}

/* Through a point near the surface, from some way before it. */
static inline struct ray random_ray(unsigned long long *state, const struct strength *strength,
                                    const struct random_asphere *one)
{
    double turn = chance_between(state, 0, 2 * PI);
    double tilt = strength->tilt * sqrt(chance(state));
    struct ray ray = {
        .cosine = {sin(tilt) * cos(turn), sin(tilt) * sin(turn), one->direction * cos(tilt)}};
    double r = one->h * sqrt(chance(state)), at = chance_between(state, 0, 2 * PI);
    double z = (double)asphere_sag(&one->shape, r, &(real){0});
    double point[3] = {r * cos(at), r * sin(at), z}, back = chance_between(state, 0, 3) * one->h;
    for (int i = 0; i < 3; i++) {
        ray.point[i] = point[i] - back * ray.cosine[i];
    }
    return ray;
}

/* A ray that is lost is searched for; of one that arrives that is done only if `all`. */
static inline void judge(const struct random_asphere *one, const struct ray *start,
                         const struct ray *end, int steps, bool all, struct asphere_tally *tally)
{
    const struct asphere *s = &one->shape;
    real d = 0, slope;
    bool is_lost = end->status == RAY_MISS || end->status == RAY_NOT_CONVERGED;
    bool met = (all || is_lost) &&
               first_meeting(s, start->point, start->cosine, one->direction, steps, &d);
    tally->rays++;
    tally->met += met;
    const char *fault = NULL;
    if (is_lost) {
        tally->none += !met;
        tally->lost += met;
        tally->unconverged += end->status == RAY_NOT_CONVERGED;
        fault = met ? "lost" : end->status == RAY_NOT_CONVERGED ? "not converged" : NULL;
    } else {
        real x = end->point[0], y = end->point[1], r = root_of(x * x + y * y);
        double off = (double)(end->point[2] - asphere_sag(s, r, &slope)), away = 0, first = 0;
        for (int i = 0; i < 3; i++) {
            double expected = (double)(start->point[i] + d * start->cosine[i]);
            away += (end->point[i] - expected) * (end->point[i] - expected);
            first += (end->point[i] - expected) * start->cosine[i];
        }
        double here = sqrt(away) / one->h, steep = 1 + fabs((double)slope);
        bool on = fabs(off) <= 1e-11 * one->h * steep;
        tally->wrong += !on;
        tally->later += met && on && here > 1e-6 && first > 0;
        tally->differ += met && on && here > 1e-6;
        tally->worst = met && here <= 1e-6 ? fmax(tally->worst, here) : tally->worst;
        fault = !on ? "not on the surface" : NULL;
    }
    if (fault != NULL) {
        printf("%s: %s\n  point %.17g %.17g %.17g cosines %.17g %.17g %.17g\n", fault, one->text,
               start->point[0], start->point[1], start->point[2], start->cosine[0],
               start->cosine[1], start->cosine[2]);
    }
}

/* Do all sets of instructions say the same? */
static inline bool same_everywhere(const struct random_asphere *one, const struct ray *starts,
                                   const struct rays *rays, struct arena *arena)
{
    for (enum instruction_set set = SET_SSE2; set <= SET_AVX512; set++) {
        struct rays other = rays_new(arena, ASPHERE_RAYS);
        for (size_t i = 0; i < ASPHERE_RAYS; i++) {
            rays_set(&other, i, one->system.index_first, &starts[i]);
        }
        if (!instruction_set_works(set)) {
            continue;
        }
        rays_trace(&one->system, &other, &(struct trace_way){.set = set});
        if (memcmp(rays->blocks, other.blocks, sizeof *rays->blocks) != 0) {
            return false;
        }
    }
    /* and the kernels for a few */
    struct rays few = rays_new(arena, RAYS_FEW);
    for (size_t i = 0; i < RAYS_FEW; i++) {
        rays_set(&few, i, one->system.index_first, &starts[i]);
    }
    rays_trace(&one->system, &few, NULL);
    return memcmp(rays->blocks->x, few.blocks->x, RAYS_FEW * sizeof(double)) == 0 &&
           memcmp(rays->blocks->z, few.blocks->z, RAYS_FEW * sizeof(double)) == 0 &&
           memcmp(rays->blocks->q, few.blocks->q, RAYS_FEW * sizeof(double)) == 0 &&
           memcmp(rays->blocks->lost, few.blocks->lost, RAYS_FEW * sizeof(double)) == 0;
}

/* A surface and a block of rays, `searched` of them even if not lost; false where sets differ. */
static inline bool try_asphere(unsigned long long *state, const struct strength *strength,
                               int steps, size_t searched, struct asphere_tally *tally)
{
    static struct random_asphere one;
    struct ray starts[ASPHERE_RAYS];
    if (!random_asphere(state, strength, &one)) {
        printf("%s\n", one.text);
        return false;
    }
    struct rays rays = rays_new(&one.arena, ASPHERE_RAYS);
    for (size_t i = 0; i < ASPHERE_RAYS; i++) {
        starts[i] = random_ray(state, strength, &one);
        rays_set(&rays, i, one.system.index_first, &starts[i]);
    }
    rays_trace(&one.system, &rays, NULL);
    bool same = same_everywhere(&one, starts, &rays, &one.arena);
    for (size_t i = 0; i < ASPHERE_RAYS; i++) {
        struct ray end = rays_get(&rays, i, one.system.index_last);
        judge(&one, &starts[i], &end, steps, i < searched, tally);
    }
    arena_free(&one.arena);
    return same;
}

#endif
