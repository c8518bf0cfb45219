/* camera/photograph/reuse_grid.c - rays between rays that are traced. */
/* SPDX-License-Identifier: MIT */
#include "camera/photograph/reuse_grid.h"

#include "camera/photograph/tile_cell.h"
#include "camera/subject/subject.h"
#include "trace/dispatch.h"

#include <string.h>

enum { X, Y, AXES };

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

struct reuse_grid *reuse_grid_new(size_t passes, struct arena *arena)
{
    struct reuse_grid *net = ARENA_NEW(arena, struct reuse_grid);
    net->pupil = ARENA_ARRAY(arena, passes, struct pupil_rays);
    net->nodes = arena_array(arena, passes, sizeof *net->nodes);
    net->rays = rays_new(arena, RAYS_BLOCK);
    return net;
}

/* -------- traced -------- */

/* Trace the samples of the net. */
static void corners_trace(const struct ray_reuse *spare, size_t wavelength, struct reuse_grid *net)
{
    spare->film->aim(spare->film, &net->samples, net->rays.blocks);
    lens_film_trace(spare->film, wavelength, &net->samples, &net->rays);
}

/* Each as often as its weight wants, so that all count the same. */
static void even_out(struct pupil_rays *pupil, double all)
{
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
}

/* Rays of a tile's middle, all over the pupil: how far they are from that of its middle. */
static bool trace_pupil(const struct ray_reuse *spare, const struct film_plan *plan,
                        size_t wavelength, struct reuse_grid *net)
{
    const struct film_plan middle = {.sobol = plan->sobol,
                                     .scrambling = {1, 2, 3, 4},
                                     .left = plan->left + plan->width / 2,
                                     .bottom = plan->bottom + plan->height / 2};
    struct pupil_rays *pupil = &net->pupil[wavelength];
    double all = 0;
    film_rays_plan(&middle, 0, SET_BEST, &net->samples);
    net->samples.u[0] = net->samples.v[0] = 0;
    corners_trace(spare, wavelength, net);
    const struct depth_card_ray chief = subject_ray(net->rays.blocks, 0, spare->plane);
    pupil->count = 0;
    for (size_t i = 1; i < RAYS_BLOCK; i++) {
        const struct depth_card_ray ray = subject_ray(net->rays.blocks, i, spare->plane);
        if (net->rays.blocks->lost[i] == 0 && net->samples.weight[i] > 0) {
            for (int k = X; k < AXES; k++) {
                pupil->from[pupil->count].x[k] = ray.x[k] - chief.x[k];
                pupil->from[pupil->count].slope[k] = ray.slope[k] - chief.slope[k];
            }
            pupil->weight[pupil->count++] = net->samples.weight[i];
            all += net->samples.weight[i];
        }
    }
    even_out(pupil, all);
    return pupil->count > 0 && net->rays.blocks->lost[0] == 0;
}

/* Rays through the middle of the pupil from a net over the tile; false: one is lost. */
static bool trace_nodes(const struct ray_reuse *spare, const struct film_plan *plan,
                        size_t wavelength, struct reuse_grid *net)
{
    memset(&net->samples, 0, sizeof net->samples);
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        const double across = (double)(i % NODES_ACROSS) / (NODES_ACROSS - 1);
        const double down = (double)(i / NODES_ACROSS) / (NODES_DOWN - 1);
        net->samples.x[i] = plan->left + across * plan->width;
        net->samples.y[i] = plan->bottom + down * plan->height;
    }
    corners_trace(spare, wavelength, net);
    bool all = true;
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        all = all && net->rays.blocks->lost[i] == 0 && net->rays.blocks->r[i] < 0;
        net->nodes[wavelength][i] = subject_ray(net->rays.blocks, i, spare->plane);
    }
    return all;
}

bool reuse_grid_trace(const struct ray_reuse *spare, const struct film_plan *plan,
                      struct reuse_grid *net)
{
    bool all = true;
    for (size_t i = 0; i < spare->passes && all; i++) {
        all = trace_pupil(spare, plan, i, net) && trace_nodes(spare, plan, i, net);
    }
    return all;
}

/* -------- looked through -------- */

/* Between four of the net. */
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

static struct card_light corner_look(const struct ray_reuse *spare,
                                     const struct depth_card_ray *ray, enum depth_card_sight *sight)
{
    if (spare->relief != NULL) {
        return depth_card_look(spare->relief, ray, sight);
    }
    *sight = SIGHT_SEEN;
    const double w = 1 / spare->frame;
    return card_look(spare->card, ray_reuse_seen_at(spare, ray, X, w),
                     ray_reuse_seen_at(spare, ray, Y, w));
}

/* Points of the film alone leave as much noise as twice as many of film and pupil. */
enum { OF_SAMPLES = 2 };
/* Blocks until the watch may end them: half a millisecond. */
enum { ENDED_EVERY = 16 };

/* The light of samples' points of the film, through the net of its wavelength; false: the watch
   has ended it. */
static bool reuse_grid_look_through(const struct ray_reuse *spare,
                                    const struct ray_reuse_tile *tile, size_t wavelength,
                                    struct reuse_grid *net, uint64_t sights[DEPTH_CARD_SIGHTS],
                                    double (*sums)[CARD_CHANNELS])
{
    const struct film_plan *plan = tile->plan;
    const struct ray_reuse_pass *pass = &spare->pass[wavelength];
    const struct pupil_rays *pupil = &net->pupil[wavelength];
    double weight[RAYS_BLOCK];
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        weight[i] = OF_SAMPLES * irradiance_table_of(spare->light, wavelength, plan, i);
    }
    for (uint32_t block = 0; block < tile->samples / OF_SAMPLES; block++) {
        if (block % ENDED_EVERY == 0 && !watch_ask(spare->watch)) {
            return false;
        }
        film_rays_plan(plan, block, SET_BEST, &net->samples);
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            const double across = (net->samples.x[i] - plan->left) / plan->width;
            const double down = (net->samples.y[i] - plan->bottom) / plan->height;
            const size_t pixel = tile_cell_of(plan, net->samples.x[i], net->samples.y[i]).pixel;
            const size_t of_pupil = (block + 37 * i) % pupil->count;
            struct depth_card_ray ray = ray_between(net->nodes[wavelength], across, down);
            for (int k = X; k < AXES; k++) {
                ray.x[k] += pupil->from[of_pupil].x[k];
                ray.slope[k] += pupil->from[of_pupil].slope[k];
            }
            enum depth_card_sight sight;
            const struct card_light light = corner_look(spare, &ray, &sight);
            sights[sight]++;
            for (size_t k = pass->begin; k < pass->end; k++) {
                sums[pixel][k] += weight[pixel] * (double)light.of[k];
            }
        }
    }
    return true;
}

bool reuse_grid_look(const struct ray_reuse *spare, const struct ray_reuse_tile *tile,
                     struct reuse_grid *net, uint64_t sights[DEPTH_CARD_SIGHTS],
                     double (*sums)[CARD_CHANNELS])
{
    bool is_whole = true;
    for (size_t i = 0; i < spare->passes && is_whole; i++) {
        is_whole = reuse_grid_look_through(spare, tile, i, net, sights, sums);
    }
    return is_whole;
}
