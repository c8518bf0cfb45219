/* camera/film/outline_search.c - patches of rays that close in on light, and rays strewn beside it. */
/* SPDX-License-Identifier: MIT */
#include "camera/film/outline_search.h"

#include "camera/film/outline_rays.h"

#include <math.h>

/* A square of u, v, and the rays at a grid over it. */
struct patch {
    double centre[2], half[2];
    double points[RAYS_BLOCK][2];
    double least;      /* by which one fails, so far */
    double deepest[2]; /* the ray that passes best, in the middle of a lens with two halves */
};

enum { SIDE = 11, ALL = SIDE * SIDE };

static void look_at_patch(const struct outline_rays *sight, struct patch *patch)
{
    for (size_t i = 0; i < ALL; i++) {
        for (size_t k = 0; k < 2; k++) {
            const double place = (double)(k == 0 ? i % SIDE : i / SIDE) * 2 / (SIDE - 1) - 1;
            patch->points[i][k] = patch->centre[k] + place * patch->half[k];
        }
    }
    clearances_look(&sight->margins, (const double(*)[2])patch->points, ALL);
}

/*
 * A smaller one about the rays that pass, or about that which fails by least.
 *
 * Result    how many pass; SIZE_MAX: none does, nor will
 */
static size_t outline_search_narrow(const struct outline_rays *sight, bool is_half,
                                    struct patch *patch)
{
    const double *excess = sight->margins.excess;
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    size_t lit = 0, best = 0, deepest = ALL / 2;
    for (size_t i = 0; i < ALL; i++) {
        const bool counts = !is_half || i % SIDE == SIDE / 2;
        best = excess[i] < excess[best] ? i : best;
        deepest = counts && excess[i] < excess[deepest] ? i : deepest;
        lit += excess[i] <= 0;
    }
    patch->deepest[0] = patch->points[deepest][0];
    patch->deepest[1] = patch->points[deepest][1];
    for (size_t i = 0; i < ALL; i++) {
        for (int k = 0; k < 2 && (lit == 0 ? i == best : excess[i] <= 0); k++) {
            low[k] = fmin(low[k], patch->points[i][k]);
            high[k] = fmax(high[k], patch->points[i][k]);
        }
    }
    for (int k = 0; k < 2; k++) {
        const double step = 2 * patch->half[k] / (SIDE - 1);
        patch->centre[k] = (low[k] + high[k]) / 2;
        patch->half[k] = (high[k] - low[k]) / 2 + (lit == 0 ? 1.5 : 0.5) * step;
    }
    /* nearing a place that passes it would be less by more than the square is smaller */
    const bool is_dark = lit == 0 && !(excess[best] < patch->least / 2);
    patch->least = excess[best];
    return is_dark ? SIZE_MAX : lit;
}

bool outline_is_lit(const struct pupil_outline_search *search, size_t wavelength,
                    struct pupil_outline *outline)
{
    enum { LEVELS = 9, ENOUGH = 5 };
    const struct arena_mark mark = arena_mark(search->arena);
    struct patch patch = {.half = {0.8, 0.8}, .least = INFINITY};
    struct outline_rays sight;
    size_t lit = 0;
    outline_rays_open(search, wavelength, outline, SIGHT_AROUND, &sight);
    for (int level = 0; level < LEVELS && lit < ENOUGH; level++) {
        look_at_patch(&sight, &patch);
        lit = outline_search_narrow(&sight, outline->is_half, &patch);
    }
    const bool is_lit = lit > 0 && lit != SIZE_MAX;
    if (is_lit) {
        const double right[2] = {patch.centre[0] + patch.half[0], patch.centre[1]};
        const double up[2] = {patch.centre[0], patch.centre[1] + patch.half[1]};
        const struct pupil_outline_point centre = outline_rays_from_disc(&sight, patch.centre);
        const struct pupil_outline_point middle = outline_rays_from_disc(&sight, patch.deepest);
        const struct pupil_outline_point a = outline_rays_from_disc(&sight, right),
                                         b = outline_rays_from_disc(&sight, up);
        const double size_a = hypot(a.x - centre.x, a.y - centre.y);
        const double size_b = hypot(b.x - centre.x, b.y - centre.y);
        outline->centre = (struct pupil_outline_point){outline->is_half ? 0 : middle.x, middle.y};
        outline->size = (struct pupil_outline_point){size_a, size_b};
    }
    arena_reset(search->arena, mark);
    return is_lit;
}

bool outline_discover(const struct pupil_outline_search *search, size_t wavelength,
                      struct pupil_outline *outline)
{
    const struct film_lens *lens = search->lens;
    const struct arena_mark mark = arena_mark(search->arena);
    struct pupil_boundary *star = ARENA_NEW(search->arena, struct pupil_boundary);
    struct outline_rays sight;
    outline->centre = (struct pupil_outline_point){0, 0};
    outline->size = (struct pupil_outline_point){0.1, 0.1};
    outline_rays_open(search, wavelength, outline, 1, &sight);
    const struct clear_guess guess =
        clear_guess_of(lens->systems[wavelength], &sight.beam, lens->first);
    sight.disc.origin[0] = guess.centre[0];
    sight.disc.origin[1] = guess.centre[1];
    sight.disc.axes[0] = sight.disc.axes[3] = SIGHT_AROUND * guess.radius;
    const bool found = pupil_boundary_find(&sight.margins, &sight.probe, search->arena, star);
    if (found) {
        double uv[2], low = INFINITY, high = 0;
        for (size_t i = 0; i < star->count; i++) {
            low = fmin(low, star->edges[i].radius);
            high = fmax(high, star->edges[i].radius);
        }
        outline->centre = outline_rays_from_disc(&sight, star->frame.centre);
        edge_point(&star->frame, 0, (low + high) / 2, uv);
        const struct pupil_outline_point top = outline_rays_from_disc(&sight, uv);
        const double size = hypot(top.x - outline->centre.x, top.y - outline->centre.y);
        outline->size = (struct pupil_outline_point){size, size};
        outline->centre.x = outline->is_half ? 0 : outline->centre.x;
    }
    arena_reset(search->arena, mark);
    return found;
}

/* -------- rays beside it -------- */

/* Rays over 1.6 half widths; those that pass. */
static size_t outline_search_scatter(const struct pupil_outline_search *search, size_t wavelength,
                                     const struct pupil_outline *outline, size_t turn,
                                     struct pupil_outline_point *lit)
{
    /* powers of the plastic number: evenly spread however many there are */
    static const double steps[2] = {0.7548776662466927, 0.5698402909980532};
    const struct arena_mark mark = arena_mark(search->arena);
    double points[RAYS_BLOCK][2];
    struct outline_rays sight;
    size_t count = 0;
    outline_rays_open(search, wavelength, outline, SIGHT_AROUND, &sight);
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        for (int k = 0; k < 2; k++) {
            const double at = (double)(turn * RAYS_BLOCK + i) * steps[k];
            points[i][k] = 1.6 * (at - floor(at)) - 0.8;
        }
    }
    clearances_look(&sight.margins, (const double(*)[2])points, RAYS_BLOCK);
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        if (sight.margins.excess[i] <= 0) {
            struct pupil_outline_point way = outline_rays_from_disc(&sight, points[i]);
            way.x = outline->is_half ? fabs(way.x) : way.x;
            lit[count++] = way;
        }
    }
    arena_reset(search->arena, mark);
    return count;
}

size_t outline_scatter(const struct pupil_outline_search *search, size_t wavelength,
                       const struct pupil_outline *outline, size_t turn,
                       struct pupil_outline_point *lit)
{
    enum { ROUNDS = OUTLINE_SCATTER / RAYS_BLOCK };
    const double more = 1.15;
    struct pupil_outline about = {.place = outline->place,
                                  .is_half = outline->is_half,
                                  .centre = outline->centre,
                                  .size = outline->size};
    size_t count = 0, all = 0;
    bool grows = true;
    for (int round = 0; round < ROUNDS && grows; round++) {
        count = outline_search_scatter(search, wavelength, &about, turn + (size_t)round, lit + all);
        double far = 0;
        for (size_t i = 0; i < count; i++) {
            far = fmax(far, fmax(fabs(lit[all + i].x - about.centre.x),
                                 fabs(lit[all + i].y - about.centre.y)));
        }
        all += count;
        grows = far > more * fmax(about.size.x, about.size.y);
        about.size.x = about.size.y = fmax(far, fmax(about.size.x, about.size.y));
    }
    return all;
}
