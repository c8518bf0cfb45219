/* scene/distant_lights.c - distant lights: discs infinitely far away, suns and stars. */
/* SPDX-License-Identifier: MIT */
#include "scene/distant_lights.h"

#include "base/constants.h"
#include "scene/discrete.h"

#include <stdlib.h>
#include <string.h>

/* -------- cells of the sphere: rows of even height y, columns of longitude -------- */

enum { ROWS_MOST = 512 };

static size_t cell_row(const struct distant_lights *discs, double y)
{
    return discrete_step((y + 1) / 2, discs->rows);
}

/* Columns go round: longitudes beyond half a turn are another's. */
static size_t cell_column(const struct distant_lights *discs, double longitude)
{
    const double turns = longitude / (2 * PI) + 0.5;
    return discrete_step(turns - floor(turns), discs->columns);
}

static size_t cell_of_direction(const struct distant_lights *discs, struct vector direction)
{
    return cell_row(discs, direction.y) * discs->columns +
           cell_column(discs, atan2(direction.x, direction.z));
}

/* Count the discs of each cell, or list them where they were counted. */
static void cells_fill(struct distant_lights *discs, size_t *next, bool lists)
{
    for (size_t i = 0; i < discs->count; i++) {
        const struct distant_light *disc = &discs->all[i];
        const double reach = disc->radius * (1 + 1e-9) + 1e-12;
        const double y = disc->direction.y, across = sqrt(disc->direction.x * disc->direction.x +
                                                          disc->direction.z * disc->direction.z);
        const double latitude = atan2(y, across);
        const double low = latitude - reach, high = latitude + reach;
        /* the cells that it may lie in: columns on from the first, round */
        const size_t from = low <= -PI / 2 ? 0 : cell_row(discs, sin(low));
        const size_t to = high >= PI / 2 ? discs->rows - 1 : cell_row(discs, sin(high));
        size_t column = 0, columns = discs->columns;
        if (low > -PI / 2 && high < PI / 2) {
            const double half = asin(fmin(1, sin(reach) / cos(latitude))) * (1 + 1e-9) + 1e-12;
            const double longitude = atan2(disc->direction.x, disc->direction.z);
            const size_t last = cell_column(discs, longitude + half);
            column = cell_column(discs, longitude - half);
            columns = half >= PI / 2 ? discs->columns
                                     : (last + discs->columns - column) % discs->columns + 1;
        }
        for (size_t row = from; row <= to; row++) {
            for (size_t k = 0; k < columns; k++) {
                const size_t cell = row * discs->columns + (column + k) % discs->columns;
                if (lists) {
                    discs->listed[next[cell]] = i;
                }
                next[cell]++;
            }
        }
    }
}

/* About one disc a cell, but cells no smaller than discs are in the mean. */
static void discs_put_in_cells(struct distant_lights *discs, struct arena *arena)
{
    double radii = 0;
    for (size_t i = 0; i < discs->count; i++) {
        radii += discs->all[i].radius;
    }
    double rows = fmin(sqrt((double)discs->count), 2 * (double)discs->count / radii);
    rows = fmax(1, fmin(rows, ROWS_MOST));
    discs->rows = (size_t)rows;
    discs->columns = discs->rows;
    const size_t cells = discs->rows * discs->columns;
    size_t *next = ARENA_ARRAY(arena, cells + 1, size_t);
    discs->begins = ARENA_ARRAY(arena, cells + 1, size_t);
    cells_fill(discs, next, false);
    for (size_t i = 0; i < cells; i++) {
        discs->begins[i + 1] = discs->begins[i] + next[i];
        next[i] = discs->begins[i];
    }
    discs->listed = ARENA_ARRAY(arena, discs->begins[cells], size_t);
    cells_fill(discs, next, true);
}

/* -------- what they shine -------- */

static bool is_distant_light(const struct scene_light *light)
{
    return (light->kind == LIGHT_SUN || light->kind == LIGHT_STAR) && light->amount > 0;
}

/* 1 - cos r, without losing the digits of small ones; the square of the chord is twice that. */
static double cap_height(double radius)
{
    const double half = sin(radius / 2);
    return 2 * half * half;
}

/* -------- discs that lie on each other -------- */

static int compare_numbers(double a, double b)
{
    return (a > b) - (a < b);
}

/* Do they differ in more than in how bright they are? */
static int by_disc(const struct distant_light *a, const struct distant_light *b)
{
    const int signs[] = {compare_numbers(a->direction.x, b->direction.x),
                         compare_numbers(a->direction.y, b->direction.y),
                         compare_numbers(a->direction.z, b->direction.z),
                         compare_numbers(a->radius, b->radius)};
    for (size_t i = 0; i < sizeof signs / sizeof signs[0]; i++) {
        if (signs[i] != 0) {
            return signs[i];
        }
    }
    return a->unit == b->unit ? 0 : memcmp(a->unit->of, b->unit->of, sizeof a->unit->of);
}

/* The first of the scene goes before others like it. */
static int by_disc_and_number(const void *a, const void *b)
{
    const struct distant_light *p = *(struct distant_light *const *)a;
    const struct distant_light *q = *(struct distant_light *const *)b;
    const int sign = by_disc(p, q);
    return sign != 0 ? sign : (p > q) - (p < q);
}

/*
 * Discs of one place, size and colour become the first of them: rays would look at each. The others
 * have no amount any more; `amount`: lx of each.
 */
static void discs_join_alike(struct distant_lights *discs, double *amount)
{
    struct arena work = {0};
    struct distant_light **order = ARENA_ARRAY(&work, discs->count, struct distant_light *);
    for (size_t i = 0; i < discs->count; i++) {
        order[i] = &discs->all[i];
    }
    qsort(order, discs->count, sizeof order[0], by_disc_and_number);
    struct distant_light *first = order[0];
    for (size_t i = 1; i < discs->count; i++) {
        if (by_disc(first, order[i]) != 0) {
            first = order[i];
            continue;
        }
        first->luminance += order[i]->luminance;
        amount[first - discs->all] += amount[order[i] - discs->all];
        amount[order[i] - discs->all] = 0;
    }
    arena_free(&work);
}

void distant_lights_open(const struct scene *scene, const struct banded *const *units,
                         struct arena *arena, struct distant_lights *discs)
{
    *discs = (struct distant_lights){.count = 0};
    for (size_t i = 0; i < scene->light_count; i++) {
        discs->count += is_distant_light(&scene->lights[i]) ? 1 : 0;
    }
    if (discs->count == 0) {
        return;
    }
    discs->all = ARENA_ARRAY(arena, discs->count, struct distant_light);
    discs->below = ARENA_ARRAY(arena, discs->count + 1, double);
    double *amount = ARENA_ARRAY(arena, discs->count, double);
    size_t count = 0;
    for (size_t i = 0; i < scene->light_count; i++) {
        if (is_distant_light(&scene->lights[i])) {
            const struct scene_light *light = &scene->lights[i];
            const double radius = light->diameter / 2, sine = sin(radius);
            discs->all[count] =
                (struct distant_light){.direction = light->direction,
                                       .radius = radius,
                                       .chord = 2 * cap_height(radius),
                                       .luminance = light->amount / (PI * sine * sine),
                                       .unit = units[i]};
            amount[count++] = scene->lights[i].amount;
        }
    }
    discs_join_alike(discs, amount);
    /* What is left of them, in the order of the scene, and how often each is chosen. */
    count = 0;
    for (size_t i = 0; i < discs->count; i++) {
        if (amount[i] > 0) {
            discs->all[count] = discs->all[i];
            discs->below[count + 1] = discs->below[count] + amount[i];
            count++;
        }
    }
    discs->count = count;
    discs->total = discs->below[count];
    for (size_t i = 0; i < count; i++) {
        const double share = (discs->below[i + 1] - discs->below[i]) / discs->total;
        discs->all[i].pdf = share / (2 * PI * cap_height(discs->all[i].radius));
    }
    discs_put_in_cells(discs, arena);
}

struct vector distant_light_direction(const struct distant_light *disc, const double u[2])
{
    const struct frame frame = frame_about(disc->direction);
    const double height = cap_height(disc->radius) * u[0]; /* even in the solid angle */
    const double sine = sqrt(height * (2 - height));
    const double angle = 2 * PI * u[1];
    const struct vector own = {sine * cos(angle), sine * sin(angle), 1 - height};
    return vector_unit(frame_out(&frame, own));
}

struct vector distant_lights_sample(const struct distant_lights *discs, const double u[3])
{
    const struct discrete_sample pick = discrete_sample_of(discs->below, discs->count, u[0]);
    return distant_light_direction(&discs->all[pick.index], u + 1);
}

/* -------- looking -------- */

static bool lies_in(const struct distant_light *disc, struct vector direction)
{
    const struct vector off = vector_minus(direction, disc->direction);
    return vector_dot(off, off) <= disc->chord;
}

double distant_lights_pdf(const struct distant_lights *discs, struct vector direction)
{
    double pdf = 0;
    if (discs->count > 0) {
        const size_t cell = cell_of_direction(discs, direction);
        for (size_t i = discs->begins[cell]; i < discs->begins[cell + 1]; i++) {
            const struct distant_light *disc = &discs->all[discs->listed[i]];
            pdf += lies_in(disc, direction) ? disc->pdf : 0;
        }
    }
    return pdf;
}

void distant_lights_add(const struct distant_lights *discs, struct vector direction,
                        const struct lanes *lanes, struct radiance *light)
{
    if (discs->count == 0) {
        return;
    }
    const size_t cell = cell_of_direction(discs, direction);
    for (size_t i = discs->begins[cell]; i < discs->begins[cell + 1]; i++) {
        const struct distant_light *disc = &discs->all[discs->listed[i]];
        for (size_t k = 0; k < lanes->count && lies_in(disc, direction); k++) {
            light->of[k] += disc->luminance * disc->unit->of[lanes->band[k]];
        }
    }
}
