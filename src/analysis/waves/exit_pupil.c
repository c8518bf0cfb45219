/* analysis/waves/exit_pupil.c - a beam behind the lens, over the direction cosines of the image space. */
/* SPDX-License-Identifier: MIT */
#include "analysis/waves/exit_pupil.h"

#include "base/constants.h"
#include "trace/dispatch.h"

#include <math.h>
#include <string.h>

enum { ORDER_FIRST = 8, ORDER_MOST = 14, TERMS_MOST = (ORDER_MOST + 1) * (ORDER_MOST + 2) / 2 };

/* So well the polynomials are to name rays, in half boxes; rims lie so far within. */
static const double fine = 1e-7, fine_waves = 3e-6, within = 1 - 1e-12;

/* A ray on the reference sphere. */
struct sphere_point {
    double at[2];    /* a, b */
    double slope[2]; /* dW/da, dW/db, mm; of a plane a number */
    double path;     /* mm; NaN: lost */
};

/* Lane i of a block behind the lens. */
static struct sphere_point exit_pupil_meet(const struct exit_pupil *pupil,
                                           const struct ray_block *block, size_t i)
{
    const struct opd_reference *reference = &pupil->reference->opd;
    const double n = pupil->n, *c = reference->centre;
    const double e[3] = {block->p[i] / n, block->q[i] / n, block->r[i] / n};
    const double from[3] = {block->x[i] - c[0], block->y[i] - c[1], block->z[i] - c[2]};
    struct sphere_point meeting = {.path = block->path[i]};
    if (reference->is_plane) { /* of an afocal image */
        const double *d = reference->normal;
        double turn[3], ahead = 0, turned = 0, straight = 0;
        for (int k = 0; k < 3; k++) {
            turn[k] = e[k] - d[k];
            ahead += from[k] * d[k];
            turned += turn[k] * turn[k];
            straight += d[k] * e[k];
        }
        const double more = reference->plane_way; /* which is left out of the way */
        const double way = (more * turned / 2 - ahead) / straight;
        meeting.path += n * way;
        for (int axis = 0; axis < 2; axis++) {
            for (int k = 0; k < 3; k++) {
                const double across = pupil->reference->across[axis][k];
                meeting.at[axis] -= across * (from[k] + way * e[k] + more * turn[k]);
                meeting.slope[axis] += n * across * e[k];
            }
        }
        return meeting;
    }
    const double along = from[0] * e[0] + from[1] * e[1] + from[2] * e[2];
    double m[3], q = 0;
    for (int k = 0; k < 3; k++) {
        m[k] = from[k] - along * e[k];
        q += m[k] * m[k];
    }
    const double R = reference->radius, over = reference->side / R;
    const double root = sqrt(1 - q / (R * R)), third = root * e[2] - over * m[2];
    const double bulge = q / (R * (1 + root)); /* R - sqrt(R^2 - q); 0 of an infinite one */
    meeting.path -= n * (along - reference->side * bulge);
    for (int k = 0; k < 2; k++) {
        meeting.at[k] = root * e[k] - over * m[k];
        meeting.slope[k] = n * (e[2] * m[k] - e[k] * m[2]) / third;
    }
    return meeting;
}

/* -------- polynomials -------- */

/*
 * Two of them at points, every `step`-th number of `values`; areas: receives what the two make of
 * areas of a and b; or null.
 */
static void pupil_polynomials(const struct exit_pupil *pupil, double *const c[2],
                              const double (*at)[2], size_t count, double *const values[2],
                              size_t step, double *areas)
{
    enum { BLOCK = 4 * PUPIL_LANES };
    const double *middle = pupil->middle, *scale = pupil->scale;
    double x[BLOCK], y[BLOCK], value[2][BLOCK], slope[2][2][BLOCK];
    struct pupil_look look = {.x = x, .y = y, .value = {value[0], value[1]}};
    for (int k = 0; k < 4 && areas != NULL; k++) {
        look.slope[k / 2][k % 2] = slope[k / 2][k % 2];
    }
    for (size_t done = 0; done < count; done += BLOCK) {
        const size_t here = count - done < BLOCK ? count - done : BLOCK;
        look.count = pupil_room(here);
        for (size_t i = 0; i < look.count; i++) {
            const double *from = at[done + (i < here ? i : 0)];
            x[i] = (from[0] - middle[0]) / scale[0];
            y[i] = (from[1] - middle[1]) / scale[1];
        }
        pupil_look(&pupil->terms, (const double *const *)c, &look);
        for (size_t i = 0; i < here; i++) {
            values[0][(done + i) * step] = value[0][i];
            values[1][(done + i) * step] = value[1][i];
            if (areas != NULL) {
                areas[done + i] = fabs(pupil_area(look.slope, i)) / (scale[0] * scale[1]);
            }
        }
    }
}

/* Points of the beam's u and v, and what areas of a and b are there; areas null: not wanted. */
static void way_back(const struct exit_pupil *pupil, const double (*at)[2], size_t count,
                     double (*places)[2], double *areas)
{
    pupil_polynomials(pupil, pupil->map, at, count, (double *const[]){&places[0][0], &places[0][1]},
                      2, areas);
}

void exit_pupil_form(const struct exit_pupil *pupil, const double (*at)[2], size_t count,
                     double *waves, double *amplitudes)
{
    pupil_polynomials(pupil, pupil->form, at, count, (double *const[]){waves, amplitudes}, 1, NULL);
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

/* Points on the rim, and between its corners evenly about its middle. */
static bool find_rim(struct exit_pupil *pupil, struct arena *arena, struct exit_pupil_pairs *rim)
{
    struct quadrature_region *region = pupil->light->source.region;
    const struct pupil_boundary *boundary = quadrature_boundary(region, arena); /* there is one */
    enum { EVEN = EXIT_PUPIL_RIM - PUPIL_BOUNDARY_CORNERS };
    double angles[EXIT_PUPIL_RIM];
    size_t count = 0, corner = 0;
    const double first = boundary->corner_count > 0 ? boundary->corners[0] : 0;
    for (size_t i = 0; i < EVEN; i++) {
        const double angle = first + 2 * PI * (double)i / EVEN;
        for (; corner < boundary->corner_count && boundary->corners[corner] <= angle; corner++) {
            angles[count++] = boundary->corners[corner];
        }
        if (count == 0 || angles[count - 1] < angle) {
            angles[count++] = angle;
        }
    }
    const struct quadrature_rim edge = quadrature_edge(region, angles, count, NULL, 0, arena);
    double(*points)[2] = arena_array(arena, count, sizeof *points);
    for (size_t i = 0; i < count; i++) {
        for (int k = 0; k < 2; k++) {
            const double centre = boundary->frame.centre[k];
            points[i][k] = centre + within * (edge.points[i][k] - centre);
        }
    }
    *rim = trace_pairs(pupil, (const double(*)[2])points, count, arena);
    return rim->count > 8;
}

/* Only the terms of a function that mirrors leave, which is odd in a or b or even in both. */
static void exit_pupil_mirror(const struct exit_pupil *pupil, const bool odd[2], double *c)
{
    for (size_t i = 0, term = 0; i < 2 * pupil->terms.orders; i++) {
        const size_t m = i / 2, sine = i % 2;
        const bool keeps = (!pupil->is_mirrored[0] || ((m + sine) % 2 == 1) == odd[0]) &&
                           (!pupil->is_mirrored[1] || (sine == 1) == odd[1]);
        for (size_t j = 0; j < pupil->terms.radial[m] && i != 1; j++, term++) {
            c[term] = keeps ? c[term] : 0;
        }
    }
}

/*
 * Two functions of the rays to coefficients, in two rounds: the second one gets the digits back
 * that normal equations lose. What is left of the functions stays in `values`.
 *
 * Given     odd  of each, in a and in b, where the pupil has mirrors
 */
static void exit_pupil_fit_two(const struct exit_pupil *pupil, const struct pupil_fit *fit,
                               const bool odd[2][2], double *const values[2], double *const work[2],
                               double *const c[2])
{
    double more[2][TERMS_MOST];
    const struct pupil_look look = {
        .count = fit->count, .x = fit->x, .y = fit->y, .value = {work[0], work[1]}};
    for (int k = 0; k < 2; k++) {
        memset(c[k], 0, TERMS_MOST * sizeof *c[k]);
    }
    for (int round = 0; round < 2; round++) {
        pupil_fit_find(fit, (const double *const *)values, work,
                       (double *const[]){more[0], more[1]});
        exit_pupil_mirror(pupil, odd[0], more[0]);
        exit_pupil_mirror(pupil, odd[1], more[1]);
        pupil_look(fit->form, (const double *const[]){more[0], more[1]}, &look);
        for (int k = 0; k < 2; k++) {
            for (size_t i = 0; i < fit->form->terms; i++) {
                c[k][i] += more[k][i];
            }
            for (size_t i = 0; i < fit->count; i++) {
                values[k][i] -= work[k][i];
            }
        }
    }
}

/* The polynomials of a degree, and what they leave; false: the rays do not tell them apart. */
static bool exit_pupil_fit(struct exit_pupil *pupil, const struct exit_pupil_pairs *all,
                           size_t degree, struct arena *arena)
{
    static const bool odd[2][2] = {{true, false}, {false, true}}, even[2][2] = {{false}};
    const struct arena_mark mark = arena_mark(arena);
    const double *extent = pupil->light->source.region->boundary->frame.stretch;
    const size_t room = pupil_room(all->count);
    const double each = 1 / (double)all->count;
    double *numbers[8], mean = 0;
    for (size_t k = 0; k < sizeof numbers / sizeof numbers[0]; k++) {
        numbers[k] = ARENA_ARRAY(arena, room, double);
    }
    double *const *values = numbers + 3, *const *work = numbers + 5, *amplitudes = numbers[7];
    pupil->terms = pupil_form_of_degree(degree);
    const struct pupil_fit fit = {
        &pupil->terms,
        room,
        numbers[0],
        numbers[1],
        numbers[2],
        ARENA_ARRAY(arena, pupil->terms.terms * pupil->terms.terms, double),
        ARENA_ARRAY(arena, room * pupil->terms.terms, double)};
    for (size_t i = 0; i < all->count; i++) {
        for (int k = 0; k < 2; k++) {
            numbers[k][i] = (all->to[i][k] - pupil->middle[k]) / pupil->scale[k];
            values[k][i] = all->from[i][k];
        }
        numbers[2][i] = 1;
    }
    const bool fits = pupil_fit_open(&fit);
    if (fits) {
        exit_pupil_fit_two(pupil, &fit, odd, values, work, pupil->map);
        pupil->off = pupil->off_waves = pupil->off_amplitude = 0;
        for (size_t i = 0; i < 2 * all->count; i++) {
            pupil->off = fmax(pupil->off, fabs(values[i % 2][i / 2]) / extent[i % 2]);
        }
        double(*places)[2] = arena_array(arena, all->count, sizeof *places);
        way_back(pupil, (const double(*)[2])all->to, all->count, places, amplitudes);
        for (size_t i = 0; i < all->count; i++) {
            const double *from = all->from[i];
            const double density = stop_beam_density(&pupil->light->source.pupil, from[0], from[1]);
            values[0][i] = all->waves[i];
            values[1][i] = amplitudes[i] = sqrt(amplitudes[i] * density);
            mean += amplitudes[i] * each;
        }
        exit_pupil_fit_two(pupil, &fit, even, values, work, pupil->form);
        for (size_t i = 0; i < all->count; i++) {
            pupil->off_waves += values[0][i] * values[0][i] * each;
            pupil->off_amplitude += values[1][i] * values[1][i] / (mean * mean) * each;
        }
        pupil->off_waves = sqrt(pupil->off_waves);
        pupil->off_amplitude = sqrt(pupil->off_amplitude);
    }
    arena_reset(arena, mark);
    return fits;
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

static bool find_map(struct exit_pupil *pupil, const struct exit_pupil_pairs *rim,
                     const struct quadrature *inside, size_t first, struct arena *arena)
{
    enum { EACH = 4 }; /* of the rim */
    const size_t inner = inside->sample.count;
    const size_t count = inner + (rim->count + EACH - 1) / EACH;
    double(*from)[2] = arena_array(arena, count, sizeof *from);
    for (size_t i = 0; i < count; i++) {
        if (i < inner) {
            from[i][0] = inside->sample.points[i].x;
            from[i][1] = inside->sample.points[i].y;
        } else {
            memcpy(from[i], rim->from[EACH * (i - inner)], sizeof from[i]);
        }
    }
    const struct exit_pupil_pairs all = trace_pairs(pupil, (const double(*)[2])from, count, arena);
    for (int k = 0; k < 2; k++) {
        pupil->map[k] = ARENA_ARRAY(arena, TERMS_MOST, double);
        pupil->form[k] = ARENA_ARRAY(arena, TERMS_MOST, double);
    }
    for (int k = 0; k < 2; k++) {
        pupil->is_mirrored[k] = exit_pupil_is_mirrored(pupil, &all, k, arena);
    }
    /* as many rays again as terms */
    size_t degree = first;
    while (degree > 1 && ((degree + 1) * (degree + 2) > all.count ||
                          !exit_pupil_fit(pupil, &all, degree, arena))) {
        degree--;
    }
    if (degree == 1) {
        return exit_pupil_fit(pupil, &all, degree, arena);
    }
    while ((pupil->off > fine || pupil->off_waves > fine_waves) && degree + 3 <= ORDER_MOST &&
           (degree + 4) * (degree + 5) <= all.count) {
        const double before = pupil->off;
        if (!exit_pupil_fit(pupil, &all, degree + 3, arena) || pupil->off > before) {
            return exit_pupil_fit(pupil, &all, degree, arena);
        }
        degree += 3;
    }
    return true;
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
                                 .is_blocked = source->region->margins.full != NULL};
    source->region->in_beam = true;
    const struct quadrature inside = quadrature_fill(source->region, RAYS, arena);
    if (inside.is_empty || quadrature_boundary(source->region, arena) == NULL) {
        return bundle_fail_dark(source, 0, arena, error);
    }
    if (!find_rim(pupil, arena, &rim)) {
        return fail(error, ERROR_DOMAIN,
                    "rays at the edge of the pupil miss the reference sphere, whose radius is %.4g "
                    "mm: the exit pupil lies too close to the image",
                    reference->opd.radius);
    }
    for (size_t i = 0; i < inside.sample.count; i++) {
        const struct pupil_point *point = &inside.sample.points[i];
        pupil->energy += PI * point->weight * stop_beam_density(&source->pupil, point->x, point->y);
    }
    /* the box about the rim, and the ellipse of its form that all of it lies within */
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    pupil->rim_count = rim.count;
    for (size_t i = 0; i < rim.count; i++) {
        for (int k = 0; k < 2; k++) {
            pupil->rim[i][k] = rim.to[i][k];
            low[k] = fmin(low[k], rim.to[i][k]);
            high[k] = fmax(high[k], rim.to[i][k]);
        }
    }
    double reach = 1;
    for (int k = 0; k < 2; k++) {
        pupil->middle[k] = (low[k] + high[k]) / 2;
        pupil->half[k] = (high[k] - low[k]) / 2;
    }
    for (size_t i = 0; i < rim.count; i++) {
        reach = fmax(reach, hypot((rim.to[i][0] - pupil->middle[0]) / pupil->half[0],
                                  (rim.to[i][1] - pupil->middle[1]) / pupil->half[1]));
    }
    for (int k = 0; k < 2; k++) {
        pupil->scale[k] = reach * pupil->half[k];
    }
    /* wavelengths do not differ in what they need */
    return (pupil->half[0] > 0 && pupil->half[1] > 0 &&
            find_map(pupil, &rim, &inside, g > 0 ? pupils->list[0].terms.orders - 1 : ORDER_FIRST,
                     arena)) ||
           fail(error, ERROR_DOMAIN, "all light comes from one direction");
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

void exit_pupil_meets(const struct exit_pupil *pupil, const double (*at)[2], size_t count,
                      bool *meets)
{
    const double most = 0.02; /* half boxes; polynomials that are off by more are refused */
    const struct clearances *margins = &pupil->light->source.region->margins;
    for (size_t done = 0; done < count; done += RAYS_BLOCK) {
        const size_t here = count - done < RAYS_BLOCK ? count - done : RAYS_BLOCK;
        double places[RAYS_BLOCK][2];
        way_back(pupil, at + done, here, places, NULL);
        struct rays rays = {margins->work.blocks, here};
        clearances_start(margins, (const double(*)[2])places, &rays);
        rays_trace(pupil->light->open, &rays, NULL);
        for (size_t i = 0; i < here; i++) {
            const struct sphere_point meeting = exit_pupil_meet(pupil, rays.blocks, i);
            meets[done + i] = true;
            for (int k = 0; k < 2; k++) {
                const double off = (meeting.at[k] - at[done + i][k]) / pupil->half[k];
                meets[done + i] = meets[done + i] && fabs(off) <= most;
            }
        }
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
