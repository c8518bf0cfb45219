/* analysis/waves/exit_pupil.c - a beam behind the lens, over the direction cosines of the image space. */
/* SPDX-License-Identifier: MIT */
#include "analysis/waves/exit_pupil.h"

#include "analysis/waves/exit_map.h"
#include "base/constants.h"
#include "base/instruction_set.h"
#include "base/linear.h"
#include "trace/dispatch.h"

#include <math.h>
#include <string.h>

enum {
    ORDER_FIRST = 8,
    ORDER_MOST = EXIT_MAP_ORDER,
    TERMS_MOST = (ORDER_MOST + 1) * (ORDER_MOST + 2) / 2
};

/* So well the polynomials are to name rays, in half boxes; rims lie so far within. */
static const double fine = 1e-7, fine_waves = 3e-6, within = 1 - 1e-12;

/* A ray on the reference sphere. */
struct sphere_point {
    double at[2];    /* a, b */
    double slope[2]; /* dW/da, dW/db, mm; of a plane a number */
    double path;     /* mm; NaN: lost */
};

/* Lane i of a block behind the lens, on the reference plane of an afocal image. */
static struct sphere_point meet_plane(const struct exit_pupil *pupil, const struct ray_block *block,
                                      size_t i)
{
    const struct opd_reference *plane = &pupil->reference->opd;
    const double n = pupil->n, *d = plane->normal;
    const double e[3] = {block->p[i] / n, block->q[i] / n, block->r[i] / n};
    const double from[3] = {block->x[i] - plane->centre[0], block->y[i] - plane->centre[1],
                            block->z[i] - plane->centre[2]};
    double turn[3], ahead = 0, turned = 0, straight = 0;
    for (int k = 0; k < 3; k++) {
        turn[k] = e[k] - d[k];
        ahead += from[k] * d[k];
        turned += turn[k] * turn[k];
        straight += d[k] * e[k];
    }
    const double way = (plane->plane_way * turned / 2 - ahead) / straight; /* less plane_way */
    struct sphere_point meeting = {{0, 0}, {0, 0}, block->path[i] + n * way};
    for (int axis = 0; axis < 2; axis++) {
        for (int k = 0; k < 3; k++) {
            const double across = pupil->reference->across[axis][k];
            meeting.at[axis] -= across * (from[k] + way * e[k] + plane->plane_way * turn[k]);
            meeting.slope[axis] += n * across * e[k];
        }
    }
    return meeting;
}

/* Lane i of a block behind the lens. */
static struct sphere_point exit_pupil_meet(const struct exit_pupil *pupil,
                                           const struct ray_block *block, size_t i)
{
    const struct opd_reference *sphere = &pupil->reference->opd;
    const double n = pupil->n, *c = sphere->centre;
    if (sphere->is_plane) {
        return meet_plane(pupil, block, i);
    }
    const double e[3] = {block->p[i] / n, block->q[i] / n, block->r[i] / n};
    const double from[3] = {block->x[i] - c[0], block->y[i] - c[1], block->z[i] - c[2]};
    const double along = from[0] * e[0] + from[1] * e[1] + from[2] * e[2];
    double m[3], q = 0, d[3];
    for (int k = 0; k < 3; k++) {
        m[k] = from[k] - along * e[k];
        q += m[k] * m[k];
    }
    const double R = sphere->radius, over = sphere->side / R;
    const double root = sqrt(1 - q / (R * R));
    for (int k = 0; k < 3; k++) {
        d[k] = root * e[k] - over * m[k];
    }
    const double bulge = q / (R * (1 + root)); /* R - sqrt(R^2 - q); 0 of an infinite one */
    return (struct sphere_point){
        {d[0], d[1]},
        {n * (e[2] * m[0] - e[0] * m[2]) / d[2], n * (e[2] * m[1] - e[1] * m[2]) / d[2]},
        block->path[i] - n * (along - sphere->side * bulge)};
}

/* -------- polynomials -------- */

/* T_0 .. T_order of x. */
static void exit_pupil_chebyshev(double x, size_t order, double *values)
{
    values[0] = 1;
    values[1] = x;
    for (size_t k = 2; k <= order; k++) {
        values[k] = 2 * x * values[k - 1] - values[k - 2];
    }
}

/* Some points to the box of the polynomials, the first again where lanes are left. */
static void put_lanes(const struct exit_pupil *pupil, const double (*at)[2], size_t count,
                      struct exit_map_lanes *lanes)
{
    const double *middle = pupil->middle, *half = pupil->half;
    for (size_t i = 0; i < EXIT_MAP_LANES; i++) {
        const size_t from = i < count ? i : 0;
        lanes->x[i] = (at[from][0] - middle[0]) / half[0];
        lanes->y[i] = (at[from][1] - middle[1]) / half[1];
    }
}

/* Points of the beam's u and v, and what areas of a and b are there; areas null: not wanted. */
static void way_back(const struct exit_pupil *pupil, const double (*at)[2], size_t count,
                     double (*places)[2], double *areas)
{
    kernel_exit_map *find = areas != NULL ? KERNEL_FOR(SET_BEST, kernel_exit_map)
                                          : KERNEL_FOR(SET_BEST, kernel_exit_form);
    const struct exit_map map = {pupil->order, pupil->map[0], pupil->map[1]};
    const double *half = pupil->half;
    struct exit_map_lanes lanes;
    for (size_t done = 0; done < count; done += EXIT_MAP_LANES) {
        const size_t left = count - done, here = left < EXIT_MAP_LANES ? left : EXIT_MAP_LANES;
        put_lanes(pupil, at + done, here, &lanes);
        find(&map, &lanes);
        for (size_t i = 0; i < here; i++) {
            places[done + i][0] = lanes.first[i];
            places[done + i][1] = lanes.second[i];
            if (areas != NULL) {
                areas[done + i] = lanes.area[i] / (half[0] * half[1]);
            }
        }
    }
}

void exit_pupil_form(const struct exit_pupil *pupil, const double (*at)[2], size_t count,
                     double *waves, double *amplitudes)
{
    kernel_exit_map *find = KERNEL_FOR(SET_BEST, kernel_exit_form);
    const struct exit_map map = {pupil->order, pupil->form[0], pupil->form[1]};
    struct exit_map_lanes lanes;
    for (size_t done = 0; done < count; done += EXIT_MAP_LANES) {
        const size_t left = count - done, here = left < EXIT_MAP_LANES ? left : EXIT_MAP_LANES;
        put_lanes(pupil, at + done, here, &lanes);
        find(&map, &lanes);
        memcpy(waves + done, lanes.first, here * sizeof *waves);
        memcpy(amplitudes + done, lanes.second, here * sizeof *amplitudes);
    }
}

/* -------- opening -------- */

/* Points of u and v, where their rays go, and their W, wavelengths. */
struct exit_pupil_pairs {
    double (*from)[2], (*to)[2], *waves;
    size_t count;
};

static struct exit_pupil_pairs trace_pairs(const struct exit_pupil *pupil, const double (*from)[2],
                                           size_t count, struct arena *arena)
{
    const struct wave_light *light = pupil->light;
    struct exit_pupil_pairs pairs = {arena_array(arena, count, sizeof *pairs.from),
                                     arena_array(arena, count, sizeof *pairs.to),
                                     ARENA_ARRAY(arena, count, double), 0};
    const struct rays rays = rays_new(arena, count);
    clearances_start(&light->source.region->margins, from, &rays);
    rays_trace(light->open, &rays, NULL);
    for (size_t i = 0; i < count; i++) {
        const struct ray_block *block = &rays.blocks[i / RAYS_BLOCK];
        const struct sphere_point meeting = exit_pupil_meet(pupil, block, i % RAYS_BLOCK);
        if (isfinite(meeting.path)) {
            for (int k = 0; k < 2; k++) {
                pairs.from[pairs.count][k] = from[i][k];
                pairs.to[pairs.count][k] = meeting.at[k];
            }
            pairs.waves[pairs.count++] = (pupil->zero - meeting.path) * pupil->waves;
        }
    }
    return pairs;
}

/* Points on the rim, and between its corners evenly about the middle of the star. */
static bool exit_pupil_find_rim(struct exit_pupil *pupil, struct arena *arena,
                                struct exit_pupil_pairs *rim)
{
    struct quadrature_region *region = pupil->light->source.region;
    const struct pupil_boundary *star = quadrature_star(region, arena);
    enum { EVEN = EXIT_PUPIL_RIM - PUPIL_BOUNDARY_CORNERS };
    double angles[EXIT_PUPIL_RIM];
    size_t count = 0, corner = 0;
    if (star == NULL) {
        return false;
    }
    const double first = star->corner_count > 0 ? star->corners[0] : 0;
    for (size_t i = 0; i < EVEN; i++) {
        const double angle = first + 2 * PI * (double)i / EVEN;
        for (; corner < star->corner_count && star->corners[corner] <= angle; corner++) {
            angles[count++] = star->corners[corner];
        }
        if (count == 0 || angles[count - 1] < angle) {
            angles[count++] = angle;
        }
    }
    const struct edge_directions directions = {.angles = angles, .count = count};
    const struct quadrature_rim edge = quadrature_edge(region, &directions, arena);
    double(*points)[2] = arena_array(arena, count, sizeof *points);
    for (size_t i = 0; i < count; i++) {
        for (int k = 0; k < 2; k++) {
            const double centre = star->frame.centre[k];
            points[i][k] = centre + within * (edge.points[i][k] - centre);
        }
    }
    *rim = trace_pairs(pupil, (const double(*)[2])points, count, arena);
    return rim->count > 8;
}

static void set_box(struct exit_pupil *pupil, const struct exit_pupil_pairs *rim)
{
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    pupil->rim_count = rim->count;
    for (size_t i = 0; i < rim->count; i++) {
        for (int k = 0; k < 2; k++) {
            pupil->rim[i][k] = rim->to[i][k];
            low[k] = fmin(low[k], rim->to[i][k]);
            high[k] = fmax(high[k], rim->to[i][k]);
        }
    }
    for (int k = 0; k < 2; k++) {
        pupil->middle[k] = (low[k] + high[k]) / 2;
        pupil->half[k] = (high[k] - low[k]) / 2;
    }
}

/* What mirrors do to a function of a and b: it stays, or its sign turns; or there is no mirror. */
enum parity { ANY, EVEN, ODD };

/* Least squares of an order, by the terms that mirrors leave. */
struct exit_pupil_pupil_fit {
    struct exit_pupil *pupil;
    const struct exit_pupil_pairs *all;
    bool is_mirrored[2]; /* a to -a, b to -b */
    struct arena *arena;
};

static bool has_term(size_t k, enum parity parity)
{
    return parity == ANY || k % 2 == (parity == ODD);
}

/* Rows on one side of each mirror say all. */
static bool has_row(const struct exit_pupil_pupil_fit *fitting, size_t row)
{
    const double *to = fitting->all->to[row];
    return (!fitting->is_mirrored[0] || to[0] >= 0) && (!fitting->is_mirrored[1] || to[1] >= 0);
}

/* Fit functions of the same parities: values, one a pair, to coefficients of all terms. */
static void fit_alike(const struct exit_pupil_pupil_fit *fitting, const enum parity parities[2],
                      const double *const *values, size_t count, double *const *forms)
{
    const struct arena_mark mark = arena_mark(fitting->arena);
    const struct exit_pupil *pupil = fitting->pupil;
    const struct exit_pupil_pairs *all = fitting->all;
    const size_t order = pupil->order;
    double *a = ARENA_ARRAY(fitting->arena, all->count * TERMS_MOST, double);
    double *b = ARENA_ARRAY(fitting->arena, all->count, double);
    double x[ORDER_MOST + 1], y[ORDER_MOST + 1], left[TERMS_MOST];
    size_t rows = 0, terms = 0, filled = 0;
    for (size_t row = 0; row < all->count; row++) {
        if (!has_row(fitting, row)) {
            continue;
        }
        exit_pupil_chebyshev((all->to[row][0] - pupil->middle[0]) / pupil->half[0], order, x);
        exit_pupil_chebyshev((all->to[row][1] - pupil->middle[1]) / pupil->half[1], order, y);
        for (size_t i = 0; i <= order; i++) {
            for (size_t j = 0; i + j <= order; j++) {
                if (has_term(i, parities[0]) && has_term(j, parities[1])) {
                    a[filled++] = x[i] * y[j];
                }
            }
        }
        rows++;
        terms = filled / rows;
    }
    const struct linear_factors factors = linear_factor(a, rows, terms, 1e-12, fitting->arena);
    for (size_t f = 0; f < count; f++) {
        for (size_t row = 0, k = 0; row < all->count; row++) {
            if (has_row(fitting, row)) {
                b[k++] = values[f][row];
            }
        }
        linear_solve(&factors, b, left);
        for (size_t i = 0, term = 0, k = 0; i <= order; i++) {
            for (size_t j = 0; i + j <= order; j++, term++) {
                const bool has = has_term(i, parities[0]) && has_term(j, parities[1]);
                forms[f][term] = has ? left[k++] : 0;
            }
        }
    }
    arena_reset(fitting->arena, mark);
}

/* The polynomials of one order; the worst that their u and v are off. */
static double exit_pupil_fit(const struct exit_pupil_pupil_fit *fitting, size_t order)
{
    struct exit_pupil *pupil = fitting->pupil;
    const struct exit_pupil_pairs *all = fitting->all;
    struct arena *arena = fitting->arena;
    enum parity even[2], odd[2];
    const double *extent = pupil->light->source.region->star->frame.stretch;
    const struct stop_beam *beam = &pupil->light->source.pupil;
    double(*places)[2] = arena_array(arena, all->count, sizeof *places), worst = 0, mean = 0;
    double *values[2] = {ARENA_ARRAY(arena, all->count, double),
                         ARENA_ARRAY(arena, all->count, double)};
    double *areas = ARENA_ARRAY(arena, all->count, double);
    pupil->order = order;
    for (int k = 0; k < 2; k++) {
        even[k] = fitting->is_mirrored[k] ? EVEN : ANY;
        odd[k] = fitting->is_mirrored[k] ? ODD : ANY;
        for (size_t row = 0; row < all->count; row++) {
            values[k][row] = all->from[row][k];
        }
    }
    if (!fitting->is_mirrored[0] && !fitting->is_mirrored[1]) {
        fit_alike(fitting, even, (const double *const *)values, 2, pupil->map);
    } else {
        fit_alike(fitting, (const enum parity[]){odd[0], even[1]},
                  (const double *const[]){values[0]}, 1, &pupil->map[0]);
        fit_alike(fitting, (const enum parity[]){even[0], odd[1]},
                  (const double *const[]){values[1]}, 1, &pupil->map[1]);
    }
    way_back(pupil, (const double(*)[2])all->to, all->count, places, areas);
    for (size_t row = 0; row < all->count; row++) {
        for (int k = 0; k < 2; k++) {
            worst = fmax(worst, fabs(places[row][k] - all->from[row][k]) / extent[k]);
        }
        const double *from = all->from[row];
        areas[row] = sqrt(areas[row] * stop_beam_density(beam, from[0], from[1]));
        mean += areas[row] / (double)all->count;
    }
    fit_alike(fitting, even, (const double *const[]){all->waves, areas}, 2, pupil->form);
    exit_pupil_form(pupil, (const double(*)[2])all->to, all->count, values[0], values[1]);
    pupil->off_waves = pupil->off_amplitude = 0;
    for (size_t row = 0; row < all->count; row++) {
        const double off[2] = {values[0][row] - all->waves[row],
                               (values[1][row] - areas[row]) / mean};
        pupil->off_waves += off[0] * off[0] / (double)all->count;
        pupil->off_amplitude += off[1] * off[1] / (double)all->count;
    }
    pupil->off_waves = sqrt(pupil->off_waves);
    pupil->off_amplitude = sqrt(pupil->off_amplitude);
    return worst;
}

/* Do rays on the other side of a mirror go there too? */
static bool exit_pupil_is_mirrored(const struct exit_pupil *pupil,
                                   const struct exit_pupil_pairs *all, int k, struct arena *arena)
{
    enum { TRIED = 24 };
    double from[TRIED][2];
    if (!(fabs(pupil->middle[k]) <= 1e-7 * pupil->half[k]) || all->count < TRIED) {
        return false;
    }
    for (size_t i = 0; i < TRIED; i++) {
        memcpy(from[i], all->from[i * all->count / TRIED], sizeof from[i]);
        from[i][k] = -from[i][k];
    }
    const struct exit_pupil_pairs other =
        trace_pairs(pupil, (const double(*)[2])from, TRIED, arena);
    bool alike = other.count == TRIED;
    for (size_t i = 0; i < TRIED && alike; i++) {
        const size_t row = i * all->count / TRIED;
        const double *to = all->to[row], sign[2] = {k == 0 ? -1 : 1, k == 1 ? -1 : 1};
        for (int d = 0; d < 2; d++) {
            alike = alike && fabs(other.to[i][d] - sign[d] * to[d]) <= fine / 10 * pupil->half[d];
        }
        alike = alike && fabs(other.waves[i] - all->waves[row]) <= fine_waves / 10;
    }
    return alike;
}

static void find_map(struct exit_pupil *pupil, const struct exit_pupil_pairs *rim,
                     const struct quadrature *inside, size_t first, struct arena *arena)
{
    const size_t count = inside->sample.count;
    double(*from)[2] = arena_array(arena, count, sizeof *from);
    for (size_t i = 0; i < count; i++) {
        from[i][0] = inside->sample.points[i].x;
        from[i][1] = inside->sample.points[i].y;
    }
    struct exit_pupil_pairs all = trace_pairs(pupil, (const double(*)[2])from, count, arena);
    struct exit_pupil_pairs both = {arena_array(arena, all.count + rim->count, sizeof *both.from),
                                    arena_array(arena, all.count + rim->count, sizeof *both.to),
                                    ARENA_ARRAY(arena, all.count + rim->count, double), 0};
    for (size_t i = 0; i < all.count + rim->count; i += i < all.count ? 1 : 4, both.count++) {
        const struct exit_pupil_pairs *of = i < all.count ? &all : rim;
        const size_t at = i < all.count ? i : i - all.count;
        for (int k = 0; k < 2; k++) {
            both.from[both.count][k] = of->from[at][k];
            both.to[both.count][k] = of->to[at][k];
        }
        both.waves[both.count] = of->waves[at];
    }
    for (int k = 0; k < 2; k++) {
        pupil->map[k] = ARENA_ARRAY(arena, TERMS_MOST, double);
        pupil->form[k] = ARENA_ARRAY(arena, TERMS_MOST, double);
    }
    struct exit_pupil_pupil_fit fitting = {.pupil = pupil, .all = &both, .arena = arena};
    for (int k = 0; k < 2; k++) {
        fitting.is_mirrored[k] = pupil->is_mirrored[k] =
            exit_pupil_is_mirrored(pupil, &both, k, arena);
    }
    /* as many rays again as terms */
    size_t order = first;
    while (order > 1 && (order + 1) * (order + 2) > both.count) {
        order--;
    }
    pupil->off = exit_pupil_fit(&fitting, order);
    while ((pupil->off > fine || pupil->off_waves > fine_waves) && order + 3 <= ORDER_MOST &&
           (order + 4) * (order + 5) <= both.count) {
        order += 3;
        pupil->off = exit_pupil_fit(&fitting, order);
    }
}

static bool exit_pupil_open_pupil(const struct exit_pupils *pupils, size_t g, struct arena *arena,
                                  struct error *error)
{
    enum { RAYS = 2 * TERMS_MOST };
    const struct wave_light *light = &pupils->lights.list[g];
    const struct wave_reference *reference = &pupils->reference;
    struct exit_pupil *pupil = &pupils->list[g];
    const struct bundle_source *source = &light->source;
    struct exit_pupil_pairs rim;
    *pupil = (struct exit_pupil){.light = light,
                                 .reference = reference,
                                 .n = light->open->index_last,
                                 .waves = 1000 / light->wavelength,
                                 .zero = opd_path(&reference->opd, &light->chief),
                                 .is_blocked = source->region->probe.full != NULL};
    source->region->in_beam = true;
    const struct quadrature inside = quadrature_fill(source->region, RAYS, arena);
    if (inside.is_empty || !exit_pupil_find_rim(pupil, arena, &rim)) {
        return bundle_fail_dark(source, 0, arena, error);
    }
    for (size_t i = 0; i < inside.sample.count; i++) {
        const struct pupil_point *point = &inside.sample.points[i];
        pupil->energy += PI * point->weight * stop_beam_density(&source->pupil, point->x, point->y);
    }
    set_box(pupil, &rim);
    if (!(pupil->half[0] > 0 && pupil->half[1] > 0)) {
        return fail(error, ERROR_DOMAIN, "all light comes from one direction");
    }
    /* wavelengths do not differ in what they need */
    find_map(pupil, &rim, &inside, g > 0 ? pupils->list[0].order : ORDER_FIRST, arena);
    return true;
}

bool exit_pupils_open(const struct bundle_question *bundle, struct arena *arena,
                      struct exit_pupils *pupils, struct error *error)
{
    struct bundle_question asked = *bundle;
    asked.pattern = PATTERN_GAUSS;
    asked.weight = WEIGHT_BEAM;
    if (!wave_open(&asked, arena, &pupils->lights, error) ||
        !wave_reference_find(&pupils->lights, WAVE_CHIEF, arena, &pupils->reference, error)) {
        return false;
    }
    if (pupils->reference.no_opd != NULL) {
        return fail(error, ERROR_DOMAIN, "%s", pupils->reference.no_opd);
    }
    const size_t count = pupils->lights.count;
    pupils->list = ARENA_ARRAY(arena, count, struct exit_pupil);
    pupils->islands = bundle_islands(&pupils->lights.list[0].source, arena);
    for (size_t g = 0; g < count; g++) {
        if (!exit_pupil_open_pupil(pupils, g, arena, error)) {
            return false;
        }
    }
    return true;
}

double exit_pupil_weight(const struct exit_pupil *pupil)
{
    return wave_light_weight(pupil->light);
}

/* -------- asking -------- */

static void exit_pupil_look_block(const struct exit_pupil *pupil, const double (*at)[2],
                                  size_t count, size_t *limits)
{
    const struct clearances *margins = &pupil->light->source.region->margins;
    double places[RAYS_BLOCK][2];
    way_back(pupil, at, count, places, NULL);
    clearances_look(margins, (const double(*)[2])places, count);
    for (size_t i = 0; i < count; i++) {
        limits[i] = margins->excess[i] <= 0 ? EXIT_PUPIL_CLEAR : 1 + margins->limit[i];
    }
    if (pupil->is_blocked && pupil->light->question.clip) {
        struct rays rays = {margins->work.blocks, count};
        clearances_start(margins, (const double(*)[2])places, &rays);
        rays_trace(pupil->light->system, &rays, NULL);
        for (size_t i = 0; i < count; i++) {
            const size_t surface = ray_block_surface(rays.blocks, i);
            if (limits[i] == EXIT_PUPIL_CLEAR && ray_block_status(rays.blocks, i) != RAY_OK) {
                limits[i] = clearances_missed(surface) + RAY_CLIPPED;
            }
        }
    }
}

void exit_pupil_look(const struct exit_pupil *pupil, const double (*at)[2], size_t count,
                     size_t *limits)
{
    for (size_t done = 0; done < count; done += RAYS_BLOCK) {
        const size_t here = count - done < RAYS_BLOCK ? count - done : RAYS_BLOCK;
        exit_pupil_look_block(pupil, at + done, here, limits + done);
    }
}

static void value_block(const struct exit_pupil *pupil, const double (*at)[2], size_t count,
                        double *waves, double *amplitudes)
{
    const struct bundle_source *source = &pupil->light->source;
    const struct clearances *margins = &source->region->margins;
    double places[RAYS_BLOCK][2];
    way_back(pupil, at, count, places, amplitudes);
    for (size_t i = 0; i < count; i++) {
        amplitudes[i] =
            sqrt(amplitudes[i] * stop_beam_density(&source->pupil, places[i][0], places[i][1]));
    }
    struct rays rays = {margins->work.blocks, count};
    clearances_start(margins, (const double(*)[2])places, &rays);
    rays_trace(pupil->light->open, &rays, NULL);
    for (size_t i = 0; i < count; i++) {
        const struct sphere_point meeting = exit_pupil_meet(pupil, rays.blocks, i);
        double wave = pupil->zero - meeting.path;
        for (int k = 0; k < 2; k++) {
            wave += meeting.slope[k] * (at[i][k] - meeting.at[k]);
        }
        waves[i] = wave * pupil->waves;
    }
}

void exit_pupil_values(const struct exit_pupil *pupil, const double (*at)[2], size_t count,
                       double *waves, double *amplitudes)
{
    for (size_t done = 0; done < count; done += RAYS_BLOCK) {
        const size_t here = count - done < RAYS_BLOCK ? count - done : RAYS_BLOCK;
        value_block(pupil, at + done, here, waves + done, amplitudes + done);
    }
}

void exit_pupil_range(const struct exit_pupil *pupil, const double along[2], double range[2])
{
    enum { ABOUT = 5 };
    const size_t n = pupil->rim_count;
    for (int end = 0; end < 2; end++) {
        const double sign = end == 0 ? -1 : 1;
        size_t top = 0;
        double highest = -INFINITY, t[ABOUT];
        for (size_t i = 0; i < n; i++) {
            const double here = sign * (pupil->rim[i][0] * along[0] + pupil->rim[i][1] * along[1]);
            top = here > highest ? i : top;
            highest = fmax(highest, here);
        }
        for (size_t k = 0; k < ABOUT; k++) {
            const double *at = pupil->rim[(top + n + k - ABOUT / 2) % n];
            t[k] = sign * (at[0] * along[0] + at[1] * along[1]);
        }
        /* the top of a parabola, where the rim is smooth */
        const double bend = t[1] - 2 * t[2] + t[3], slope = (t[3] - t[1]) / 2;
        const double beside = fmin(t[0] - 2 * t[1] + t[2], t[2] - 2 * t[3] + t[4]);
        const bool smooth = bend < 0 && bend > 2 * beside;
        range[end] = sign * (t[2] - (smooth ? slope * slope / (2 * bend) : 0));
    }
}
