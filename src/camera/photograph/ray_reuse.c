/* camera/photograph/ray_reuse.c - what a tile sees, before any of its rays is traced. */
/* SPDX-License-Identifier: MIT */
#include "camera/photograph/ray_reuse.h"

#include "camera/photograph/tile_backdrop.h"
#include "camera/photograph/tiling.h"
#include "camera/subject/card.h"
#include "camera/subject/depth_card.h"
#include "camera/subject/subject.h"
#include "camera/subject/view.h"
#include "scene/backdrop.h"
#include "trace/dispatch.h"

#include <math.h>
#include <string.h>

enum { X, Y, AXES };

const struct word skip_words[] = {
    [SKIP_PUPIL] = {"pupil", "rays that the lens would stop"},
    [SKIP_COLOUR] = {"colour", "rays of each colour, where nothing disperses"},
    [SKIP_BLUR] = {"blur", "rays all over the pupil, where they see the same"},
    [SKIP_UNIFORM] = {"uniform", "rays, where everything has the same light"},
    [SKIP_EXPOSURES] = {"exposures", "a picture for each exposure"},
    [SKIP_TIME] = {"time", "times of rays, where nothing moves"},
    [SKIP_SECONDARY] = {"secondary", "rays beyond the first, where nothing sends on light"},
    [SKIP_LAMPS] = {"lamps", "rays that meet small lamps by chance"},
    [SKIP_COUNT] = {NULL, NULL}};

/* -------- the light on the film -------- */

enum { ROWS = 49 };

struct irradiance_table {
    double largest;       /* distance from the axis up to which light arrives, mm */
    double (*rows)[ROWS]; /* E/L by pass, sr */
};

/*
 * Given     film    of a lens that is the same all around, and so is its shutter
 *           passes  one a wavelength of it, or one for all
 *           blocks  of rays for each number of the table
 * Result    E/L up to where light ends, closer to each other there
 */
static const struct irradiance_table *irradiance_table_new(const struct lens_film *film,
                                                           size_t passes, size_t blocks,
                                                           struct arena *arena)
{
    struct irradiance_table *light = ARENA_NEW(arena, struct irradiance_table);
    struct film_samples *samples = ARENA_NEW(arena, struct film_samples);
    const struct rays rays = rays_new(arena, RAYS_BLOCK);
    struct lens_film aimed = *film;
    aimed.start = film->aim;
    light->largest = film->region.largest;
    light->rows = arena_array(arena, passes, sizeof *light->rows);
    for (size_t w = 0; w < passes; w++) {
        for (int i = 0; i < ROWS; i++) {
            const double left = 1 - i / (ROWS - 1.0);
            const double at[2] = {0, light->largest * (1 - left * left)};
            light->rows[w][i] = lens_film_light(&aimed, at, w, blocks, samples, &rays);
        }
    }
    return light;
}

/* By the cubic through four rows: [Abramowitz64] 25.2.13. */
static double irradiance_table_at(const struct irradiance_table *light, size_t wavelength, double x,
                                  double y)
{
    const double share = 1 - fmin(1, hypot(x, y) / light->largest);
    const double place = (ROWS - 1) * (1 - sqrt(share));
    const int row = (int)fmax(1, fmin(place, ROWS - 3));
    const double *rows = light->rows[wavelength] + row, t = place - row;
    const double value = rows[-1] * t * (t - 1) * (2 - t) / 6 +
                         rows[0] * (t + 1) * (t - 1) * (t - 2) / 2 +
                         rows[1] * (t + 1) * t * (2 - t) / 2 + rows[2] * (t + 1) * t * (t - 1) / 6;
    return fmax(value, 0);
}

/*
 * E/L of a pixel of a tile, sr: the mean over it.
 *
 * Given     plan   of the tile
 *           pixel  of TILE_PIXELS, in rows from the upper left of the picture
 * Formula   at Gauss's four points of the pixel
 */
static double irradiance_table_of(const struct irradiance_table *light, size_t wavelength,
                                  const struct film_plan *plan, size_t pixel)
{
    const double across = plan->width / TILE_ACROSS, down = plan->height / TILE_DOWN;
    const double x = plan->left + plan->width - ((double)(pixel % TILE_ACROSS) + 0.5) * across;
    const double y = plan->bottom + ((double)(pixel / TILE_ACROSS) + 0.5) * down;
    const double dx = across / sqrt(12), dy = down / sqrt(12);
    return (irradiance_table_at(light, wavelength, x - dx, y - dy) +
            irradiance_table_at(light, wavelength, x + dx, y - dy) +
            irradiance_table_at(light, wavelength, x - dx, y + dy) +
            irradiance_table_at(light, wavelength, x + dx, y + dy)) /
           4;
}

/* -------- through a grid of few rays -------- */

/* Rays from one point all over its pupil, told from the one of its middle. */
struct pupil_rays {
    size_t count;
    struct depth_card_ray from[RAYS_BLOCK];
    double weight[RAYS_BLOCK]; /* before they are evened out */
};

struct reuse_grid {
    struct pupil_rays *pupil; /* by pass */
    struct depth_card_ray (
        *nodes)[RAYS_BLOCK]; /* by pass: in rows from the lower left of the film */
    struct film_samples samples;
    struct rays rays;
};

enum { NODES_ACROSS = 16, NODES_DOWN = RAYS_BLOCK / NODES_ACROSS };

/* -------- traced -------- */

/* Trace the samples of the grid. */
static void corners_trace(const struct ray_reuse *reuse, size_t wavelength, struct reuse_grid *grid)
{
    reuse->film->aim(reuse->film, &grid->samples, grid->rays.blocks);
    lens_film_trace(reuse->film, wavelength, &grid->samples, &grid->rays);
}

/* Rays of a tile's middle, all over the pupil: how far they are from that of its middle. */
static bool trace_pupil(const struct ray_reuse *reuse, const struct film_plan *plan,
                        size_t wavelength, struct reuse_grid *grid)
{
    const struct film_plan middle = {.sobol = plan->sobol,
                                     .scrambling = {1, 2, 3, 4},
                                     .left = plan->left + plan->width / 2,
                                     .bottom = plan->bottom + plan->height / 2};
    struct pupil_rays *pupil = &grid->pupil[wavelength];
    double all = 0;
    film_rays_plan(&middle, NULL, 0, SET_BEST, &grid->samples);
    grid->samples.u[0] = grid->samples.v[0] = 0;
    corners_trace(reuse, wavelength, grid);
    const struct depth_card_ray chief = subject_ray(grid->rays.blocks, 0, reuse->plane);
    pupil->count = 0;
    for (size_t i = 1; i < RAYS_BLOCK; i++) {
        const struct depth_card_ray ray = subject_ray(grid->rays.blocks, i, reuse->plane);
        if (grid->rays.blocks->lost[i] == 0 && grid->samples.weight[i] > 0) {
            for (int k = X; k < AXES; k++) {
                pupil->from[pupil->count].x[k] = ray.x[k] - chief.x[k];
                pupil->from[pupil->count].slope[k] = ray.slope[k] - chief.slope[k];
            }
            pupil->weight[pupil->count++] = grid->samples.weight[i];
            all += grid->samples.weight[i];
        }
    }
    /* each as often as its weight wants, so that all count the same */
    const struct pupil_rays from = *pupil;
    double sum = 0;
    size_t taken = 0;
    for (size_t i = 0; i < from.count; i++) {
        sum += from.weight[i];
        while (taken < from.count && ((double)taken + 0.5) * all < sum * (double)from.count) {
            pupil->from[taken++] = from.from[i];
        }
    }
    pupil->count = taken;
    return pupil->count > 0 && grid->rays.blocks->lost[0] == 0;
}

/* Rays through the middle of the pupil from a grid over the tile; false: one is lost. */
static bool trace_nodes(const struct ray_reuse *reuse, const struct film_plan *plan,
                        size_t wavelength, struct reuse_grid *grid)
{
    memset(&grid->samples, 0, sizeof grid->samples);
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        const double across = (double)(i % NODES_ACROSS) / (NODES_ACROSS - 1);
        const double down = (double)(i / NODES_ACROSS) / (NODES_DOWN - 1);
        grid->samples.x[i] = plan->left + across * plan->width;
        grid->samples.y[i] = plan->bottom + down * plan->height;
    }
    corners_trace(reuse, wavelength, grid);
    bool all = true;
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        all = all && grid->rays.blocks->lost[i] == 0 && grid->rays.blocks->r[i] < 0;
        grid->nodes[wavelength][i] = subject_ray(grid->rays.blocks, i, reuse->plane);
    }
    return all;
}

/*
 * Trace the grids of a tile: rays through the middle of the pupil, and how far others of the tile's
 * middle are from these.
 *
 * Result    false: one of a grid is lost, or the pupil is dark
 */
static bool reuse_grid_trace(const struct ray_reuse *reuse, const struct film_plan *plan,
                             struct reuse_grid *grid)
{
    bool all = true;
    for (size_t i = 0; i < reuse->passes && all; i++) {
        all = trace_pupil(reuse, plan, i, grid) && trace_nodes(reuse, plan, i, grid);
    }
    return all;
}

/* -------- looked through -------- */

/* Between four of the grid. */
static struct depth_card_ray ray_between(const struct depth_card_ray *nodes, double across,
                                         double down)
{
    const double x = across * (NODES_ACROSS - 1), y = down * (NODES_DOWN - 1);
    const int column = x < NODES_ACROSS - 2 ? (int)x : NODES_ACROSS - 2;
    const int row = y < NODES_DOWN - 2 ? (int)y : NODES_DOWN - 2;
    const double right = x - column, up = y - row;
    const struct depth_card_ray *at = nodes + row * NODES_ACROSS + column;
    struct depth_card_ray ray;
    for (int k = X; k < AXES; k++) {
        const double a = at[0].x[k] + right * (at[1].x[k] - at[0].x[k]);
        const double b =
            at[NODES_ACROSS].x[k] + right * (at[NODES_ACROSS + 1].x[k] - at[NODES_ACROSS].x[k]);
        const double c = at[0].slope[k] + right * (at[1].slope[k] - at[0].slope[k]);
        const double d = at[NODES_ACROSS].slope[k] +
                         right * (at[NODES_ACROSS + 1].slope[k] - at[NODES_ACROSS].slope[k]);
        ray.x[k] = a + up * (b - a);
        ray.slope[k] = c + up * (d - c);
    }
    return ray;
}

static struct card_light corner_look(const struct ray_reuse *reuse,
                                     const struct depth_card_ray *ray, enum depth_card_sight *sight)
{
    if (reuse->relief != NULL) {
        return depth_card_look(reuse->relief, ray, sight);
    }
    *sight = SIGHT_SEEN;
    const double w = 1 / reuse->frame;
    return card_look(reuse->card, ray_reuse_seen_at(reuse, ray, X, w),
                     ray_reuse_seen_at(reuse, ray, Y, w));
}

/* Points of the film alone leave as much noise as twice as many of film and pupil. */
enum { OF_SAMPLES = 2 };
/* Blocks until the watch may end them: half a millisecond. */
enum { ENDED_EVERY = 16 };

/* The light of samples' points of the film, through the grid of its wavelength; false: the watch
   has ended it. */
static bool grid_look_through(const struct ray_reuse *reuse, const struct film_plan *plan,
                              size_t samples, size_t wavelength, struct reuse_grid *grid,
                              uint64_t sights[DEPTH_CARD_SIGHTS], double (*sums)[CARD_CHANNELS])
{
    const struct ray_reuse_pass *pass = &reuse->pass[wavelength];
    const struct pupil_rays *pupil = &grid->pupil[wavelength];
    double weight[RAYS_BLOCK];
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        weight[i] = OF_SAMPLES * irradiance_table_of(reuse->light, wavelength, plan, i);
    }
    for (uint32_t block = 0; block < samples / OF_SAMPLES; block++) {
        if (block % ENDED_EVERY == 0 && !watch_ask(reuse->watch)) {
            return false;
        }
        film_rays_plan(plan, NULL, block, SET_BEST, &grid->samples);
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            const double across = (grid->samples.x[i] - plan->left) / plan->width;
            const double down = (grid->samples.y[i] - plan->bottom) / plan->height;
            const size_t pixel = tile_cell_of(plan, grid->samples.x[i], grid->samples.y[i]).pixel;
            const size_t of_pupil = (block + 37 * i) % pupil->count;
            struct depth_card_ray ray = ray_between(grid->nodes[wavelength], across, down);
            for (int k = X; k < AXES; k++) {
                ray.x[k] += pupil->from[of_pupil].x[k];
                ray.slope[k] += pupil->from[of_pupil].slope[k];
            }
            enum depth_card_sight sight;
            const struct card_light light = corner_look(reuse, &ray, &sight);
            sights[sight]++;
            for (size_t k = pass->begin; k < pass->end; k++) {
                sums[pixel][k] += weight[pixel] * (double)light.of[k];
            }
        }
    }
    return true;
}

/* -------- tiles before their rays are traced -------- */

enum { CORNERS = 4, RIM = RAYS_BLOCK / CORNERS };

struct ray_reuse_scratch {
    struct reuse_grid *grid;
    struct film_samples samples;
    struct rays rays;
    struct tile_rims rims;
};

/* What is added to what the corners see, of its size, on each side. */
static const double around = 0.1;

struct ray_reuse_scratch *ray_reuse_scratch_new(size_t passes, struct arena *arena)
{
    struct ray_reuse_scratch *scratch = ARENA_NEW(arena, struct ray_reuse_scratch);
    struct reuse_grid *grid = ARENA_NEW(arena, struct reuse_grid);
    grid->pupil = ARENA_ARRAY(arena, passes, struct pupil_rays);
    grid->nodes = arena_array(arena, passes, sizeof *grid->nodes);
    grid->rays = rays_new(arena, RAYS_BLOCK);
    scratch->grid = grid;
    scratch->rims =
        (struct tile_rims){.passes = passes,
                           .ray = arena_array(arena, passes, sizeof *scratch->rims.ray),
                           .passed = arena_array(arena, passes, sizeof *scratch->rims.passed),
                           .around = around};
    scratch->rays = rays_new(arena, RAYS_BLOCK);
    return scratch;
}

void ray_reuse_open(struct ray_reuse *reuse, size_t blocks, struct arena *arena)
{
    const struct lens_film *film = reuse->film;
    const bool is_dark = reuse->view != NULL && reuse->backdrop.is_dark; /* black needs no table */
    const bool is_round = lens_is_round(film->models[0].system->lens) &&
                          (film->shutter == NULL || !isfinite(film->shutter->run));
    reuse->plane = reuse->relief != NULL ? reuse->relief->pupil : 0;
    reuse->frame = reuse->plane + reuse->card->distance;
    reuse->light =
        is_round && !is_dark ? irradiance_table_new(film, reuse->passes, blocks, arena) : NULL;
}

/* -------- what is seen -------- */

/* From the corners of the tile, RIM rays each, within the rim of the pupil. */
static void trace_rims(const struct ray_reuse *reuse, const struct film_plan *plan,
                       struct ray_reuse_scratch *scratch)
{
    static const double v[] = {0.98, 0.9, 0.8, 0.5};
    const struct ray_block *rays = scratch->rays.blocks;
    scratch->rims.before = 0;
    for (size_t w = 0; w < reuse->passes; w++) {
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            const size_t corner = i / RIM;
            scratch->samples.x[i] = plan->left + (corner % 2 == 0 ? 0 : plan->width);
            scratch->samples.y[i] = plan->bottom + (corner < 2 ? 0 : plan->height);
            scratch->samples.u[i] = ((double)(i % RIM) + 0.5) / RIM;
            scratch->samples.v[i] = v[i % 4];
        }
        reuse->film->aim(reuse->film, &scratch->samples, scratch->rays.blocks);
        lens_film_trace(reuse->film, w, &scratch->samples, &scratch->rays);
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            scratch->rims.passed[w][i] = rays->lost[i] == 0 && rays->r[i] < 0;
            scratch->rims.ray[w][i] = subject_ray(rays, i, reuse->plane);
            if (scratch->rims.passed[w][i]) {
                scratch->rims.before =
                    fmax(scratch->rims.before, fabs((reuse->plane - rays->z[i]) / rays->r[i]));
            }
        }
    }
}

/* Rays begin .. begin + count - 1 of a wavelength between two w: what they see. */
static void widen(const struct ray_reuse *reuse, const struct ray_reuse_scratch *scratch,
                  size_t wavelength, const size_t range[2], const double w[2],
                  struct card_part *part)
{
    for (size_t i = range[0]; i < range[1]; i++) {
        for (int k = X; k < AXES && scratch->rims.passed[wavelength][i]; k++) {
            for (int end = 0; end < 2; end++) {
                const double at =
                    ray_reuse_seen_at(reuse, &scratch->rims.ray[wavelength][i], k, w[end]);
                part->low[k] = fmin(part->low[k], at);
                part->high[k] = fmax(part->high[k], at);
            }
        }
    }
}

static const struct card_part nothing = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};

/* Do enough rays of every corner pass to tell what it sees? */
static bool has_rims(const struct ray_reuse *reuse, const struct ray_reuse_scratch *scratch)
{
    bool all = true;
    for (size_t pass = 0; pass < reuse->passes; pass++) {
        size_t passed[CORNERS] = {0};
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            passed[i / RIM] += scratch->rims.passed[pass][i];
        }
        for (size_t corner = 0; corner < CORNERS; corner++) {
            all = all && passed[corner] >= RIM / 2;
        }
    }
    return all;
}

/* All of it, and between which w it lies. */
static void find_part(const struct ray_reuse *reuse, const struct ray_reuse_scratch *scratch,
                      double w[2], struct card_part *part)
{
    const size_t all[2] = {0, RAYS_BLOCK};
    const struct depth_card *relief = reuse->relief;
    w[0] = w[1] = 1 / reuse->frame;
    if (relief != NULL) {
        w[0] = relief->is_endless ? relief->farthest[relief->levels - 1][0] : 0;
        w[1] = relief->nearest[relief->levels - 1][0];
    }
    for (int turn = 0; turn < 3; turn++) {
        *part = nothing;
        for (size_t i = 0; i < reuse->passes; i++) {
            widen(reuse, scratch, i, all, w, part);
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
static bool is_sharp(const struct ray_reuse *reuse, const struct ray_reuse_scratch *scratch,
                     const struct card_part *part, const double w[2])
{
    const double more = 1 + 2 * around; /* than the tile's corners see */
    const double pixel[AXES] = {(part->high[X] - part->low[X]) / more / TILE_ACROSS,
                                (part->high[Y] - part->low[Y]) / more / TILE_DOWN};
    for (size_t i = 0; i < reuse->passes; i++) {
        for (size_t corner = 0; corner < CORNERS; corner++) {
            const size_t range[2] = {corner * RIM, (corner + 1) * RIM};
            struct card_part spot = nothing;
            widen(reuse, scratch, i, range, w, &spot);
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

static void ray_reuse_fill(const struct ray_reuse *reuse, const struct film_plan *plan,
                           size_t samples, struct card_light light, double (*sums)[CARD_CHANNELS])
{
    for (size_t i = 0; i < reuse->passes && !is_black(light); i++) {
        const struct ray_reuse_pass *pass = &reuse->pass[i];
        for (size_t pixel = 0; pixel < RAYS_BLOCK; pixel++) {
            const double weight =
                pass->share * (double)samples * irradiance_table_of(reuse->light, i, plan, pixel);
            for (size_t k = pass->begin; k < pass->end; k++) {
                sums[pixel][k] += weight * (double)light.of[k];
            }
        }
    }
}

/* Does light come to all of it, from a pupil without a hole, the same all around? */
static bool has_light(const struct ray_reuse *reuse, const struct film_plan *plan)
{
    const double x = fmax(fabs(plan->left), fabs(plan->left + plan->width));
    const double y = fmax(fabs(plan->bottom), fabs(plan->bottom + plan->height));
    return reuse->light != NULL && hypot(x, y) < 0.95 * reuse->film->region.largest;
}

/* Does all of what is seen lie on the card, whatever hides it? */
static bool may_be_even(const struct ray_reuse *reuse, const struct card_part *part)
{
    const struct depth_card *relief = reuse->relief;
    const double half[AXES] = {reuse->card->width / 2, reuse->card->height / 2};
    bool is_within = true;
    for (int k = X; k < AXES; k++) {
        is_within = is_within && part->low[k] >= -half[k] && part->high[k] <= half[k];
    }
    return !skip_is_kept(reuse->kept, SKIP_UNIFORM) &&
           (relief == NULL ||
            (relief->hidden == HIDDEN_NEARBY && (is_within || !relief->is_endless)));
}

static enum ray_reuse_way take_backdrop(const struct ray_reuse *reuse, const struct film_plan *plan,
                                        size_t samples, const struct ray_reuse_scratch *scratch,
                                        double (*sums)[CARD_CHANNELS])
{
    struct card_light light = {{0, 0, 0}};
    if (tile_sees_backdrop(reuse->view, &reuse->backdrop, &scratch->rims, &light) &&
        (has_light(reuse, plan) || is_black(light))) {
        ray_reuse_fill(reuse, plan, samples, light, sums);
        return RAY_REUSE_EVEN;
    }
    return RAY_REUSE_TRACED;
}

enum ray_reuse_way ray_reuse_take(const struct ray_reuse *reuse, const struct film_plan *plan,
                                  size_t samples, struct ray_reuse_scratch *scratch,
                                  uint64_t sights[DEPTH_CARD_SIGHTS], double (*sums)[CARD_CHANNELS])
{
    double w[2];
    struct card_part part;
    struct card_light light = {{0, 0, 0}};
    trace_rims(reuse, plan, scratch);
    if (!has_rims(reuse, scratch)) {
        return RAY_REUSE_TRACED;
    }
    if (reuse->view != NULL) {
        return take_backdrop(reuse, plan, samples, scratch, sums);
    }
    find_part(reuse, scratch, w, &part);
    if (may_be_even(reuse, &part) && card_is_even(reuse->card, &part, &light) &&
        (has_light(reuse, plan) || is_black(light))) {
        ray_reuse_fill(reuse, plan, samples, light, sums);
        sights[SIGHT_SEEN] += RAYS_BLOCK * samples * reuse->passes;
        return RAY_REUSE_EVEN;
    }
    if (!skip_is_kept(reuse->kept, SKIP_BLUR) && has_light(reuse, plan) &&
        !reuse->film->region.has_hole && is_sharp(reuse, scratch, &part, w) &&
        reuse_grid_trace(reuse, plan, scratch->grid)) {
        /* the light of half of the samples' points of the film, through grids that were traced */
        bool is_whole = true;
        for (size_t i = 0; i < reuse->passes && is_whole; i++) {
            is_whole = grid_look_through(reuse, plan, samples, i, scratch->grid, sights, sums);
        }
        return is_whole ? RAY_REUSE_SHARP : RAY_REUSE_ENDED;
    }
    return RAY_REUSE_TRACED;
}
