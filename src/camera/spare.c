/* camera/spare.c - what a tile sees, before any of its rays is traced. */
/* SPDX-License-Identifier: MIT */
#include "camera/spare.h"

#include "camera/subject.h"
#include "camera/tile_backdrop.h"
#include "trace/dispatch.h"

#include <math.h>
#include <string.h>

enum { X, Y, AXES };
enum { CORNERS = 4, RIM = RAYS_BLOCK / CORNERS };

const struct word skips[] = {
    {"pupil", "rays that the lens would stop"},
    {"colour", "rays of each colour, where nothing disperses"},
    {"blur", "rays all over the pupil, where they see the same"},
    {"uniform", "rays, where everything has the same light"},
    {"exposures", "a picture for each exposure"},
    {"time", "times of rays, where nothing moves"},
    {"secondary", "rays beyond the first, where nothing sends on light"},
    {NULL, NULL},
};

/* Rays from one point all over its pupil, told from the one of its middle. */
struct pupil_rays {
    size_t count;
    struct relief_ray from[RAYS_BLOCK];
    double weight[RAYS_BLOCK]; /* before they are evened out */
};

struct spare_room {
    struct pupil_rays *pupil; /* by pass */
    struct film_samples samples;
    struct rays rays;
    struct tile_rims rims;
};

/* What is added to what the corners see, of its size, on each side. */
static const double around = 0.1;

struct spare_room *spare_room_new(size_t passes, struct arena *arena)
{
    struct spare_room *room = ARENA_NEW(arena, struct spare_room);
    room->pupil = ARENA_ARRAY(arena, passes, struct pupil_rays);
    room->rims = (struct tile_rims){.passes = passes,
                                    .ray = arena_array(arena, passes, sizeof *room->rims.ray),
                                    .passed = arena_array(arena, passes, sizeof *room->rims.passed),
                                    .around = around};
    room->rays = rays_new(arena, RAYS_BLOCK);
    return room;
}

/* -------- light by the distance from the axis -------- */

static double light_at(const struct spare *spare, double h, size_t wavelength, size_t blocks,
                       struct spare_room *room)
{
    const struct film_plan plan = {
        .sobol = spare->film->sobol, .scrambling = {1, 2, 3, 4}, .bottom = h};
    double sum = 0;
    for (uint32_t block = 0; block < blocks; block++) {
        film_rays_plan(&plan, block, SET_BEST, &room->samples);
        spare->film->aim(spare->film, &room->samples, room->rays.blocks);
        acceptance_weigh(spare->film->acceptance, room->rays.blocks, &room->samples);
        lens_film_trace(spare->film, wavelength, &room->samples, &room->rays);
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            sum += room->rays.blocks->lost[i] == 0 ? room->samples.weight[i] : 0;
        }
    }
    return sum / (double)(blocks * RAYS_BLOCK);
}

void spare_open(struct spare *spare, size_t blocks, struct arena *arena)
{
    const struct lens_film *film = spare->film;
    const bool is_dark = spare->view != NULL && spare->backdrop.is_dark; /* black needs no table */
    spare->plane = spare->relief != NULL ? spare->relief->pupil : 0;
    spare->frame = spare->plane + spare->card->distance;
    if (is_dark || !lens_is_round(film->systems[0]->lens) ||
        (film->shutter != NULL && isfinite(film->shutter->run))) {
        return;
    }
    struct spare_room *room = spare_room_new(spare->passes, arena);
    spare->light = ARENA_ARRAY(arena, spare->passes, double *);
    for (size_t w = 0; w < spare->passes; w++) {
        spare->light[w] = ARENA_ARRAY(arena, SPARE_ROWS, double);
        for (int i = 0; i < SPARE_ROWS; i++) {
            const double left = 1 - i / (SPARE_ROWS - 1.0);
            const double h = film->region.largest * (1 - left * left);
            spare->light[w][i] = light_at(spare, h, w, blocks, room);
        }
    }
}

static double light_of(const struct spare *spare, size_t wavelength, double x, double y)
{
    const double share = 1 - fmin(1, hypot(x, y) / spare->film->region.largest);
    const double place = (SPARE_ROWS - 1) * (1 - sqrt(share));
    const int row = (int)fmin(place, SPARE_ROWS - 2);
    const double *light = spare->light[wavelength] + row;
    return light[0] + (place - row) * (light[1] - light[0]);
}

/* The mean over a pixel, by Gauss's four points. */
static double light_of_pixel(const struct spare *spare, const struct spare_tile *tile,
                             size_t wavelength, size_t pixel)
{
    const struct film_plan *plan = tile->plan;
    const double across = plan->width / (double)tile->across;
    const double down = plan->height / (double)tile->down;
    const double x = plan->left + plan->width - ((double)(pixel % tile->across) + 0.5) * across;
    const double y = plan->bottom + ((double)(pixel / tile->across) + 0.5) * down;
    const double dx = across / sqrt(12), dy = down / sqrt(12);
    return (light_of(spare, wavelength, x - dx, y - dy) +
            light_of(spare, wavelength, x + dx, y - dy) +
            light_of(spare, wavelength, x - dx, y + dy) +
            light_of(spare, wavelength, x + dx, y + dy)) /
           4;
}

/* -------- what is seen -------- */

/* Where it passes the frame's lines of sight at w. */
static double seen_at(const struct spare *spare, const struct relief_ray *ray, int axis, double w)
{
    return spare->frame * (ray->x[axis] * w - ray->slope[axis]);
}

/* Trace the samples in the room. */
static void trace(const struct spare *spare, size_t wavelength, struct spare_room *room)
{
    spare->film->aim(spare->film, &room->samples, room->rays.blocks);
    lens_film_trace(spare->film, wavelength, &room->samples, &room->rays);
}

/* From the corners of the tile, RIM rays each, within the rim of the pupil. */
static void trace_rims(const struct spare *spare, const struct film_plan *plan,
                       struct spare_room *room)
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
        trace(spare, w, room);
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
static void widen(const struct spare *spare, const struct spare_room *room, size_t wavelength,
                  const size_t range[2], const double w[2], struct card_part *part)
{
    for (size_t i = range[0]; i < range[1]; i++) {
        for (int k = X; k < AXES && room->rims.passed[wavelength][i]; k++) {
            for (int end = 0; end < 2; end++) {
                const double at = seen_at(spare, &room->rims.ray[wavelength][i], k, w[end]);
                part->low[k] = fmin(part->low[k], at);
                part->high[k] = fmax(part->high[k], at);
            }
        }
    }
}

static const struct card_part nothing = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};

/* Do enough rays of every corner pass to tell what it sees? */
static bool has_rims(const struct spare *spare, const struct spare_room *room)
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
static void find_part(const struct spare *spare, const struct spare_room *room, double w[2],
                      struct card_part *part)
{
    const size_t all[2] = {0, RAYS_BLOCK};
    const struct relief *relief = spare->relief;
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
            relief_range(relief, part, &w[0], &w[1]);
        }
    }
}

/* Is what all rays of each corner see within a quarter of a pixel? */
static bool is_sharp(const struct spare *spare, const struct spare_tile *tile,
                     const struct spare_room *room, const struct card_part *part, const double w[2])
{
    const double more = 1 + 2 * around; /* than the tile's corners see */
    const double pixel[AXES] = {(part->high[X] - part->low[X]) / more / (double)tile->across,
                                (part->high[Y] - part->low[Y]) / more / (double)tile->down};
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

static void fill(const struct spare *spare, const struct spare_tile *tile, struct card_light light,
                 double (*sums)[CARD_CHANNELS])
{
    for (size_t i = 0; i < spare->passes && !is_black(light); i++) {
        const struct spare_pass *pass = &spare->pass[i];
        for (size_t pixel = 0; pixel < RAYS_BLOCK; pixel++) {
            const double weight =
                pass->share * (double)tile->samples * light_of_pixel(spare, tile, i, pixel);
            for (size_t k = pass->begin; k < pass->end; k++) {
                sums[pixel][k] += weight * (double)light.of[k];
            }
        }
    }
}

enum { NODES_ACROSS = 16, NODES_DOWN = RAYS_BLOCK / NODES_ACROSS };

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
static bool trace_pupil(const struct spare *spare, const struct film_plan *plan, size_t wavelength,
                        struct spare_room *room)
{
    const struct film_plan middle = {.sobol = plan->sobol,
                                     .scrambling = {1, 2, 3, 4},
                                     .left = plan->left + plan->width / 2,
                                     .bottom = plan->bottom + plan->height / 2};
    struct pupil_rays *pupil = &room->pupil[wavelength];
    double all = 0;
    film_rays_plan(&middle, 0, SET_BEST, &room->samples);
    room->samples.u[0] = room->samples.v[0] = 0;
    trace(spare, wavelength, room);
    const struct relief_ray chief = subject_ray(room->rays.blocks, 0, spare->plane);
    pupil->count = 0;
    for (size_t i = 1; i < RAYS_BLOCK; i++) {
        const struct relief_ray ray = subject_ray(room->rays.blocks, i, spare->plane);
        if (room->rays.blocks->lost[i] == 0 && room->samples.weight[i] > 0) {
            for (int k = X; k < AXES; k++) {
                pupil->from[pupil->count].x[k] = ray.x[k] - chief.x[k];
                pupil->from[pupil->count].slope[k] = ray.slope[k] - chief.slope[k];
            }
            pupil->weight[pupil->count++] = room->samples.weight[i];
            all += room->samples.weight[i];
        }
    }
    even_out(pupil, all);
    return pupil->count > 0 && room->rays.blocks->lost[0] == 0;
}

/* Rays through the middle of the pupil from a net over the tile; false: one is lost. */
static bool trace_nodes(const struct spare *spare, const struct film_plan *plan, size_t wavelength,
                        struct spare_room *room)
{
    memset(&room->samples, 0, sizeof room->samples);
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        const double across = (double)(i % NODES_ACROSS) / (NODES_ACROSS - 1);
        const double down = (double)(i / NODES_ACROSS) / (NODES_DOWN - 1);
        room->samples.x[i] = plan->left + across * plan->width;
        room->samples.y[i] = plan->bottom + down * plan->height;
    }
    trace(spare, wavelength, room);
    bool all = true;
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        all = all && room->rays.blocks->lost[i] == 0 && room->rays.blocks->r[i] < 0;
        room->rims.ray[wavelength][i] = subject_ray(room->rays.blocks, i, spare->plane);
    }
    return all;
}

/* Between four of the net. */
static struct relief_ray ray_between(const struct relief_ray *net, double across, double down)
{
    const double x = across * (NODES_ACROSS - 1), y = down * (NODES_DOWN - 1);
    const int column = x < NODES_ACROSS - 2 ? (int)x : NODES_ACROSS - 2;
    const int row = y < NODES_DOWN - 2 ? (int)y : NODES_DOWN - 2;
    const double right = x - column, up = y - row;
    const struct relief_ray *at = net + row * NODES_ACROSS + column;
    struct relief_ray ray;
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

static struct card_light look(const struct spare *spare, const struct relief_ray *ray,
                              enum relief_sight *sight)
{
    if (spare->relief != NULL) {
        return relief_look(spare->relief, ray, sight);
    }
    *sight = SIGHT_SEEN;
    const double w = 1 / spare->frame;
    return card_look(spare->card, seen_at(spare, ray, X, w), seen_at(spare, ray, Y, w));
}

static size_t least_of(size_t a, size_t b)
{
    return a < b ? a : b;
}

/* Points of the film alone leave as much noise as twice as many of film and pupil. */
enum { OF_SAMPLES = 2 };
/* Blocks until the watch may end them: half a millisecond. */
enum { ENDED_EVERY = 16 };

/* The light of samples' points of the film, through the net of its wavelength; false: the watch
   has ended it. */
static bool look_through_net(const struct spare *spare, const struct spare_tile *tile,
                             size_t wavelength, struct spare_room *room,
                             uint64_t sights[RELIEF_SIGHTS], double (*sums)[CARD_CHANNELS])
{
    const struct film_plan *plan = tile->plan;
    const struct spare_pass *pass = &spare->pass[wavelength];
    const struct pupil_rays *pupil = &room->pupil[wavelength];
    double weight[RAYS_BLOCK];
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        weight[i] = OF_SAMPLES * light_of_pixel(spare, tile, wavelength, i);
    }
    for (uint32_t block = 0; block < tile->samples / OF_SAMPLES; block++) {
        if (block % ENDED_EVERY == 0 && !watch_ask(spare->watch)) {
            return false;
        }
        film_rays_plan(plan, block, SET_BEST, &room->samples);
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            const double across = (room->samples.x[i] - plan->left) / plan->width;
            const double down = (room->samples.y[i] - plan->bottom) / plan->height;
            const size_t column =
                least_of((size_t)(across * (double)tile->across), tile->across - 1);
            const size_t row = least_of((size_t)(down * (double)tile->down), tile->down - 1);
            const size_t pixel = row * tile->across + (tile->across - 1 - column);
            const size_t of_pupil = (block + 37 * i) % pupil->count;
            struct relief_ray ray = ray_between(room->rims.ray[wavelength], across, down);
            for (int k = X; k < AXES; k++) {
                ray.x[k] += pupil->from[of_pupil].x[k];
                ray.slope[k] += pupil->from[of_pupil].slope[k];
            }
            enum relief_sight sight;
            const struct card_light light = look(spare, &ray, &sight);
            sights[sight]++;
            for (size_t k = pass->begin; k < pass->end; k++) {
                sums[pixel][k] += weight[pixel] * (double)light.of[k];
            }
        }
    }
    return true;
}

/* Does light come to all of it, from a pupil without a hole, the same all around? */
static bool has_light(const struct spare *spare, const struct film_plan *plan)
{
    const double x = fmax(fabs(plan->left), fabs(plan->left + plan->width));
    const double y = fmax(fabs(plan->bottom), fabs(plan->bottom + plan->height));
    return spare->light != NULL && hypot(x, y) < 0.95 * spare->film->region.largest;
}

/* Does all of what is seen lie on the card, whatever hides it? */
static bool may_be_even(const struct spare *spare, const struct card_part *part)
{
    const struct relief *relief = spare->relief;
    const double half[AXES] = {spare->card->width / 2, spare->card->height / 2};
    bool is_within = true;
    for (int k = X; k < AXES; k++) {
        is_within = is_within && part->low[k] >= -half[k] && part->high[k] <= half[k];
    }
    return (spare->kept & 1U << SKIP_UNIFORM) == 0 &&
           (relief == NULL ||
            (relief->hidden == HIDDEN_NEARBY && (is_within || !relief->is_endless)));
}

static enum spare_way take_backdrop(const struct spare *spare, const struct spare_tile *tile,
                                    const struct spare_room *room, double (*sums)[CARD_CHANNELS])
{
    struct card_light light = {{0, 0, 0}};
    if (tile_sees_backdrop(spare->view, &spare->backdrop, &room->rims, &light) &&
        (has_light(spare, tile->plan) || is_black(light))) {
        fill(spare, tile, light, sums);
        return SPARE_EVEN;
    }
    return SPARE_TRACED;
}

static bool trace_nets(const struct spare *spare, const struct film_plan *plan,
                       struct spare_room *room)
{
    bool all = true;
    for (size_t i = 0; i < spare->passes && all; i++) {
        all = trace_pupil(spare, plan, i, room) && trace_nodes(spare, plan, i, room);
    }
    return all;
}

enum spare_way spare_take(const struct spare *spare, const struct spare_tile *tile,
                          struct spare_room *room, uint64_t sights[RELIEF_SIGHTS],
                          double (*sums)[CARD_CHANNELS])
{
    double w[2];
    struct card_part part;
    struct card_light light = {{0, 0, 0}};
    trace_rims(spare, tile->plan, room);
    if (!has_rims(spare, room)) {
        return SPARE_TRACED;
    }
    if (spare->view != NULL) {
        return take_backdrop(spare, tile, room, sums);
    }
    find_part(spare, room, w, &part);
    if (may_be_even(spare, &part) && card_is_even(spare->card, &part, &light) &&
        (has_light(spare, tile->plan) || is_black(light))) {
        fill(spare, tile, light, sums);
        sights[SIGHT_SEEN] += RAYS_BLOCK * tile->samples * spare->passes;
        return SPARE_EVEN;
    }
    if ((spare->kept & 1U << SKIP_BLUR) == 0 && has_light(spare, tile->plan) &&
        !spare->film->region.has_hole && is_sharp(spare, tile, room, &part, w) &&
        trace_nets(spare, tile->plan, room)) {
        bool is_whole = true;
        for (size_t i = 0; i < spare->passes && is_whole; i++) {
            is_whole = look_through_net(spare, tile, i, room, sights, sums);
        }
        return is_whole ? SPARE_SHARP : SPARE_ENDED;
    }
    return SPARE_TRACED;
}
