/* camera/photograph/ray_reuse.c - what a tile sees, before any of its rays is traced. */
/* SPDX-License-Identifier: MIT */
#include "camera/photograph/ray_reuse.h"

#include "camera/photograph/reuse_grid.h"
#include "camera/photograph/tile_backdrop.h"
#include "camera/photograph/tiling.h"
#include "camera/subject/subject.h"

#include <math.h>

enum { X, Y, AXES };
enum { CORNERS = 4, RIM = RAYS_BLOCK / CORNERS };

struct ray_reuse_room {
    struct reuse_grid *net;
    struct film_samples samples;
    struct rays rays;
    struct tile_rims rims;
};

/* What is added to what the corners see, of its size, on each side. */
static const double around = 0.1;

struct ray_reuse_room *ray_reuse_room_new(size_t passes, struct arena *arena)
{
    struct ray_reuse_room *room = ARENA_NEW(arena, struct ray_reuse_room);
    room->net = reuse_grid_new(passes, arena);
    room->rims = (struct tile_rims){.passes = passes,
                                    .ray = arena_array(arena, passes, sizeof *room->rims.ray),
                                    .passed = arena_array(arena, passes, sizeof *room->rims.passed),
                                    .around = around};
    room->rays = rays_new(arena, RAYS_BLOCK);
    return room;
}

void ray_reuse_open(struct ray_reuse *spare, size_t blocks, struct arena *arena)
{
    const struct lens_film *film = spare->film;
    const bool is_dark = spare->view != NULL && spare->backdrop.is_dark; /* black needs no table */
    const bool is_round = lens_is_round(film->systems[0]->lens) &&
                          (film->shutter == NULL || !isfinite(film->shutter->run));
    spare->plane = spare->relief != NULL ? spare->relief->pupil : 0;
    spare->frame = spare->plane + spare->card->distance;
    spare->light =
        is_round && !is_dark ? irradiance_table_new(film, spare->passes, blocks, arena) : NULL;
}

/* -------- what is seen -------- */

/* From the corners of the tile, RIM rays each, within the rim of the pupil. */
static void trace_rims(const struct ray_reuse *spare, const struct film_plan *plan,
                       struct ray_reuse_room *room)
{
    static const double v[] = {0.98, 0.9, 0.8, 0.5};
    const struct ray_block *rays = room->rays.blocks;
    room->rims.before = 0;
    for (size_t w = 0; w < spare->passes; w++) {
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            const size_t corner = i / RIM;
            room->samples.x[i] = plan->left + (corner % 2 == 0 ? 0 : plan->width);
            room->samples.y[i] = plan->bottom + (corner < 2 ? 0 : plan->height);
            room->samples.u[i] = ((double)(i % RIM) + 0.5) / RIM;
            room->samples.v[i] = v[i % 4];
        }
        spare->film->aim(spare->film, &room->samples, room->rays.blocks);
        lens_film_trace(spare->film, w, &room->samples, &room->rays);
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            room->rims.passed[w][i] = rays->lost[i] == 0 && rays->r[i] < 0;
            room->rims.ray[w][i] = subject_ray(rays, i, spare->plane);
            if (room->rims.passed[w][i]) {
                room->rims.before =
                    fmax(room->rims.before, fabs((spare->plane - rays->z[i]) / rays->r[i]));
            }
        }
    }
}

/* Rays begin .. begin + count - 1 of a wavelength between two w: what they see. */
static void widen(const struct ray_reuse *spare, const struct ray_reuse_room *room,
                  size_t wavelength, const size_t range[2], const double w[2],
                  struct card_part *part)
{
    for (size_t i = range[0]; i < range[1]; i++) {
        for (int k = X; k < AXES && room->rims.passed[wavelength][i]; k++) {
            for (int end = 0; end < 2; end++) {
                const double at =
                    ray_reuse_seen_at(spare, &room->rims.ray[wavelength][i], k, w[end]);
                part->low[k] = fmin(part->low[k], at);
                part->high[k] = fmax(part->high[k], at);
            }
        }
    }
}

static const struct card_part nothing = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};

/* Do enough rays of every corner pass to tell what it sees? */
static bool has_rims(const struct ray_reuse *spare, const struct ray_reuse_room *room)
{
    bool all = true;
    for (size_t pass = 0; pass < spare->passes; pass++) {
        size_t passed[CORNERS] = {0};
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            passed[i / RIM] += room->rims.passed[pass][i];
        }
        for (size_t corner = 0; corner < CORNERS; corner++) {
            all = all && passed[corner] >= RIM / 2;
        }
    }
    return all;
}

/* All of it, and between which w it lies. */
static void find_part(const struct ray_reuse *spare, const struct ray_reuse_room *room, double w[2],
                      struct card_part *part)
{
    const size_t all[2] = {0, RAYS_BLOCK};
    const struct depth_card *relief = spare->relief;
    w[0] = w[1] = 1 / spare->frame;
    if (relief != NULL) {
        w[0] = relief->is_endless ? relief->farthest[relief->levels - 1][0] : 0;
        w[1] = relief->nearest[relief->levels - 1][0];
    }
    for (int turn = 0; turn < 3; turn++) {
        *part = nothing;
        for (size_t i = 0; i < spare->passes; i++) {
            widen(spare, room, i, all, w, part);
        }
        for (int k = X; k < AXES; k++) {
            const double rest = around * (part->high[k] - part->low[k]);
            part->low[k] -= rest;
            part->high[k] += rest;
        }
        if (relief != NULL) {
            depth_card_range(relief, part, &w[0], &w[1]);
        }
    }
}

/* Is what all rays of each corner see within a quarter of a pixel? */
static bool is_sharp(const struct ray_reuse *spare, const struct ray_reuse_room *room,
                     const struct card_part *part, const double w[2])
{
    const double more = 1 + 2 * around; /* than the tile's corners see */
    const double pixel[AXES] = {(part->high[X] - part->low[X]) / more / TILE_ACROSS,
                                (part->high[Y] - part->low[Y]) / more / TILE_DOWN};
    for (size_t i = 0; i < spare->passes; i++) {
        for (size_t corner = 0; corner < CORNERS; corner++) {
            const size_t range[2] = {corner * RIM, (corner + 1) * RIM};
            struct card_part spot = nothing;
            widen(spare, room, i, range, w, &spot);
            for (int k = X; k < AXES; k++) {
                if (!(spot.high[k] - spot.low[k] < 0.25 * pixel[k])) {
                    return false;
                }
            }
        }
    }
    return true;
}

/* -------- tiles -------- */

static bool is_black(struct card_light light)
{
    return light.of[0] == 0 && light.of[1] == 0 && light.of[2] == 0;
}

static void ray_reuse_fill(const struct ray_reuse *spare, const struct ray_reuse_tile *tile,
                           struct card_light light, double (*sums)[CARD_CHANNELS])
{
    for (size_t i = 0; i < spare->passes && !is_black(light); i++) {
        const struct ray_reuse_pass *pass = &spare->pass[i];
        for (size_t pixel = 0; pixel < RAYS_BLOCK; pixel++) {
            const double weight = pass->share * (double)tile->samples *
                                  irradiance_table_of(spare->light, i, tile->plan, pixel);
            for (size_t k = pass->begin; k < pass->end; k++) {
                sums[pixel][k] += weight * (double)light.of[k];
            }
        }
    }
}

/* Does light come to all of it, from a pupil without a hole, the same all around? */
static bool has_light(const struct ray_reuse *spare, const struct film_plan *plan)
{
    const double x = fmax(fabs(plan->left), fabs(plan->left + plan->width));
    const double y = fmax(fabs(plan->bottom), fabs(plan->bottom + plan->height));
    return spare->light != NULL && hypot(x, y) < 0.95 * spare->film->region.largest;
}

/* Does all of what is seen lie on the card, whatever hides it? */
static bool may_be_even(const struct ray_reuse *spare, const struct card_part *part)
{
    const struct depth_card *relief = spare->relief;
    const double half[AXES] = {spare->card->width / 2, spare->card->height / 2};
    bool is_within = true;
    for (int k = X; k < AXES; k++) {
        is_within = is_within && part->low[k] >= -half[k] && part->high[k] <= half[k];
    }
    return !skip_is_kept(spare->kept, SKIP_UNIFORM) &&
           (relief == NULL ||
            (relief->hidden == HIDDEN_NEARBY && (is_within || !relief->is_endless)));
}

static enum ray_reuse_way take_backdrop(const struct ray_reuse *spare,
                                        const struct ray_reuse_tile *tile,
                                        const struct ray_reuse_room *room,
                                        double (*sums)[CARD_CHANNELS])
{
    struct card_light light = {{0, 0, 0}};
    if (tile_sees_backdrop(spare->view, &spare->backdrop, &room->rims, &light) &&
        (has_light(spare, tile->plan) || is_black(light))) {
        ray_reuse_fill(spare, tile, light, sums);
        return RAY_REUSE_EVEN;
    }
    return RAY_REUSE_TRACED;
}

enum ray_reuse_way ray_reuse_take(const struct ray_reuse *spare, const struct ray_reuse_tile *tile,
                                  struct ray_reuse_room *room, uint64_t sights[DEPTH_CARD_SIGHTS],
                                  double (*sums)[CARD_CHANNELS])
{
    double w[2];
    struct card_part part;
    struct card_light light = {{0, 0, 0}};
    trace_rims(spare, tile->plan, room);
    if (!has_rims(spare, room)) {
        return RAY_REUSE_TRACED;
    }
    if (spare->view != NULL) {
        return take_backdrop(spare, tile, room, sums);
    }
    find_part(spare, room, w, &part);
    if (may_be_even(spare, &part) && card_is_even(spare->card, &part, &light) &&
        (has_light(spare, tile->plan) || is_black(light))) {
        ray_reuse_fill(spare, tile, light, sums);
        sights[SIGHT_SEEN] += RAYS_BLOCK * tile->samples * spare->passes;
        return RAY_REUSE_EVEN;
    }
    if (!skip_is_kept(spare->kept, SKIP_BLUR) && has_light(spare, tile->plan) &&
        !spare->film->region.has_hole && is_sharp(spare, room, &part, w) &&
        reuse_grid_trace(spare, tile->plan, room->net)) {
        return reuse_grid_look(spare, tile, room->net, sights, sums) ? RAY_REUSE_SHARP
                                                                     : RAY_REUSE_ENDED;
    }
    return RAY_REUSE_TRACED;
}
