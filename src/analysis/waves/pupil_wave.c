/* analysis/waves/pupil_wave.c - the wave front and the amplitude of a pupil from some of its rays. */
/* SPDX-License-Identifier: MIT */
#include "analysis/waves/pupil_wave.h"

#include "base/constants.h"

#include <math.h>
#include <string.h>

/* -------- rules -------- */

/* Least squares in the points, and in the places of a pupil. */
static struct pupil_fit fit_of_points(const struct pupil_rule *rule, double *rows)
{
    return (struct pupil_fit){&rule->form,   rule->room,   rule->x, rule->y,
                              rule->weights, rule->factor, rows};
}

static struct pupil_fit fit_of_places(const struct pupil_wave *wave)
{
    const struct pupil_rule *rule = wave->rule;
    return (struct pupil_fit){&rule->form,   rule->room,   wave->place[0], wave->place[1],
                              rule->weights, wave->factor, wave->rows};
}

bool pupil_rule_open(const struct pupil_point *points, size_t count, struct arena *arena,
                     struct pupil_rule *rule, struct error *error)
{
    const size_t room = pupil_room(count);
    *rule = (struct pupil_rule){.count = count,
                                .room = room,
                                .form = pupil_form_of(count),
                                .x = ARENA_ARRAY(arena, room, double),
                                .y = ARENA_ARRAY(arena, room, double),
                                .weights = ARENA_ARRAY(arena, room, double)};
    const size_t terms = rule->form.terms;
    rule->factor = ARENA_ARRAY(arena, terms * terms, double);
    /* 2 k rings have four times the points of k, and some more */
    struct sample sample;
    if (!sample_make(PATTERN_GAUSS, 4 * rule->count - 2 * (rule->form.orders - 1), 0, arena,
                     &sample, error)) {
        return false;
    }
    rule->fine_count = sample.count;
    rule->fine_room = pupil_room(sample.count);
    rule->fine_x = ARENA_ARRAY(arena, rule->fine_room, double);
    rule->fine_y = ARENA_ARRAY(arena, rule->fine_room, double);
    rule->fine_weights = ARENA_ARRAY(arena, rule->fine_room, double);
    for (size_t i = 0; i < sample.count; i++) {
        rule->fine_x[i] = sample.points[i].x;
        rule->fine_y[i] = sample.points[i].y;
        rule->fine_weights[i] = sample.points[i].weight;
    }
    for (size_t i = 0; i < count; i++) {
        rule->x[i] = points[i].x;
        rule->y[i] = points[i].y;
        rule->weights[i] = points[i].weight;
    }
    const struct pupil_fit fit = fit_of_points(rule, ARENA_ARRAY(arena, room * terms, double));
    return pupil_fit_open(&fit) ||
           fail(error, ERROR_DOMAIN, "%zu rays do not say what the pupil is like", count);
}

void pupil_wave_open(const struct pupil_rule *rule, struct arena *arena, struct pupil_wave *wave)
{
    const size_t room = rule->room, terms = rule->form.terms;
    *wave = (struct pupil_wave){.rule = rule};
    double **arrays[] = {&wave->place[0],    &wave->place[1],    &wave->amplitude,
                         &wave->rest[0],     &wave->rest[1],     &wave->front[0][0],
                         &wave->front[0][1], &wave->front[1][0], &wave->front[1][1],
                         &wave->work[0],     &wave->work[1],     &wave->work[2],
                         &wave->work[3],     &wave->work[4],     &wave->work[5]};
    for (size_t i = 0; i < sizeof arrays / sizeof arrays[0]; i++) {
        *arrays[i] = ARENA_ARRAY(arena, room, double);
    }
    for (int i = 0; i < PUPIL_PARTS; i++) {
        wave->parts[i] = ARENA_ARRAY(arena, room, double);
        wave->back[i] = ARENA_ARRAY(arena, room, double);
    }
    for (int i = 0; i < 8; i++) {
        wave->slope[i / 2][i % 2] = ARENA_ARRAY(arena, room, double);
        wave->copy[i] = ARENA_ARRAY(arena, room, double);
    }
    for (int k = 0; k < 2; k++) {
        wave->c[k] = ARENA_ARRAY(arena, terms, double);
        wave->by_c[k] = ARENA_ARRAY(arena, terms, double);
        wave->sums[k] = ARENA_ARRAY(arena, terms, double);
    }
    wave->factor = ARENA_ARRAY(arena, terms * terms, double);
    wave->rows = ARENA_ARRAY(arena, room * terms, double);
}

/* -------- polynomials -------- */

/* Two functions at points of the pupil: those of the rays, or the fine ones. */
static struct pupil_look pupil_rule_look(const struct pupil_rule *rule, bool fine,
                                         double *const value[2], double *slope[2][2])
{
    return (struct pupil_look){fine ? rule->fine_room : rule->room,
                               fine ? rule->fine_x : rule->x,
                               fine ? rule->fine_y : rule->y,
                               {value[0], value[1]},
                               {{slope[0][0], slope[0][1]}, {slope[1][0], slope[1][1]}}};
}

/* Two functions of the rays there. */
static void pupil_wave_find_at(struct pupil_wave *wave, const double *const values[2],
                               const struct pupil_look *look)
{
    const struct pupil_fit fit = fit_of_points(wave->rule, NULL);
    pupil_fit_find(&fit, values, wave->work, wave->sums);
    pupil_look(&wave->rule->form, (const double *const *)wave->sums, look);
}

/* From coefficients in `sums` to what each ray is by: added to `back`. */
static void pupil_wave_rays_back(struct pupil_wave *wave, double *const back[2])
{
    const struct pupil_rule *rule = wave->rule;
    const struct pupil_fit fit = fit_of_points(rule, NULL);
    const struct pupil_look look = {
        .count = rule->room, .x = rule->x, .y = rule->y, .value = {wave->work[0], wave->work[1]}};
    pupil_fit_solve(&fit, wave->sums[0]);
    pupil_fit_solve(&fit, wave->sums[1]);
    pupil_look(&rule->form, (const double *const *)wave->sums, &look);
    for (int k = 0; k < 2; k++) {
        for (size_t i = 0; i < rule->room; i++) {
            back[k][i] += rule->weights[i] * wave->work[k][i];
        }
    }
}

/* The same through slopes at the rays alone, and where they are wanted the edge. */
static void slopes_back(struct pupil_wave *wave, double *by_slope[2][2],
                        double (*by_rim)[2 * PUPIL_ORDERS], double *const back[2])
{
    const struct pupil_form *form = &wave->rule->form;
    memset(wave->work[0], 0, wave->rule->room * sizeof(double));
    memset(wave->work[1], 0, wave->rule->room * sizeof(double));
    const struct pupil_look look = pupil_rule_look(wave->rule, false, wave->work, by_slope);
    pupil_gather(form, &look, wave->sums);
    for (int k = 0; k < 2 && by_rim != NULL; k++) {
        size_t term = 0;
        for (size_t i = 0; i < 2 * form->orders; i++) {
            for (size_t j = 0; j < form->radial[i / 2] && i != 1; j++) {
                wave->sums[k][term++] += by_rim[k][i]; /* T_j(1) = 1 */
            }
        }
    }
    pupil_wave_rays_back(wave, back);
}

/* -------- the pupil -------- */

/* The linear function of the points, and what of a number of a ray it takes. */
static void linear_shares(const struct pupil_rule *rule, size_t i, double shares[3])
{
    shares[0] = rule->weights[i];
    shares[1] = 4 * rule->weights[i] * rule->x[i];
    shares[2] = 4 * rule->weights[i] * rule->y[i];
}

static bool pupil_wave_find_places(struct pupil_wave *wave)
{
    const struct pupil_rule *rule = wave->rule;
    double linear[2][3] = {{0}}, shares[3];
    double *m = wave->matrix, *inverse = wave->inverse;
    for (size_t i = 0; i < rule->count; i++) {
        linear_shares(rule, i, shares);
        for (int n = 0; n < 6; n++) {
            linear[n / 3][n % 3] += shares[n % 3] * wave->parts[n / 3][i];
        }
    }
    m[0] = linear[0][1], m[1] = linear[0][2], m[2] = linear[1][1], m[3] = linear[1][2];
    const double over = 1 / (m[0] * m[3] - m[1] * m[2]);
    inverse[0] = m[3] * over, inverse[1] = -m[1] * over;
    inverse[2] = -m[2] * over, inverse[3] = m[0] * over;
    for (size_t i = 0; i < rule->count; i++) {
        const double x = wave->parts[PUPIL_TO_X][i] - linear[0][0];
        const double y = wave->parts[PUPIL_TO_Y][i] - linear[1][0];
        wave->place[0][i] = inverse[0] * x + inverse[1] * y;
        wave->place[1][i] = inverse[2] * x + inverse[3] * y;
    }
    return isfinite(over);
}

/* Areas of the beam, of one sign: false, they have not. */
static bool find_energy(struct pupil_wave *wave, struct error *error)
{
    const struct pupil_rule *rule = wave->rule;
    const double *const from[2] = {wave->parts[PUPIL_FROM_X], wave->parts[PUPIL_FROM_Y]};
    double sum = 0;
    bool is_one = true;
    const struct pupil_look look = pupil_rule_look(rule, false, wave->work, wave->slope + 2);
    pupil_wave_find_at(wave, from, &look);
    wave->sign = pupil_area(wave->slope + 2, 0) < 0 ? -1 : 1;
    for (size_t i = 0; i < rule->count; i++) {
        const double area = wave->sign * pupil_area(wave->slope + 2, i);
        sum += rule->weights[i] * area;
        is_one = is_one && area > 0;
    }
    wave->energy = PI * sum;
    return (is_one && isfinite(sum)) ||
           fail(error, ERROR_DOMAIN, "the beam is folded within the pupil: there is no contrast");
}

bool pupil_wave_find(struct pupil_wave *wave, struct error *error)
{
    const struct pupil_rule *rule = wave->rule;
    const double *const places[2] = {wave->place[0], wave->place[1]};
    const double *const values[2] = {wave->parts[PUPIL_WAVE], wave->amplitude};
    const struct pupil_fit fit = fit_of_places(wave);
    const struct pupil_look look = {
        .count = rule->room,
        .x = wave->place[0],
        .y = wave->place[1],
        .value = {wave->rest[0], wave->rest[1]},
        .slope = {{wave->front[0][0], wave->front[0][1]}, {wave->front[1][0], wave->front[1][1]}}};
    if (!pupil_wave_find_places(wave)) {
        return fail(error, ERROR_DOMAIN, "all light comes from one direction");
    }
    if (!find_energy(wave, error)) {
        return false;
    }
    const struct pupil_look slopes = pupil_rule_look(rule, false, wave->work, wave->slope);
    pupil_wave_find_at(wave, places, &slopes);
    /* the edge of the places, from the coefficients in `sums` */
    const struct pupil_form *form = &wave->rule->form;
    for (int k = 0; k < 2; k++) {
        size_t term = 0;
        for (size_t i = 0; i < 2 * form->orders; i++) {
            wave->rim[k][i] = 0;
            for (size_t j = 0; j < form->radial[i / 2] && i != 1; j++) {
                wave->rim[k][i] += wave->sums[k][term++];
            }
        }
    }
    bool is_one = true;
    for (size_t i = 0; i < wave->rule->count; i++) {
        const double ratio =
            wave->sign * pupil_area(wave->slope + 2, i) / pupil_area(wave->slope, i);
        wave->amplitude[i] = sqrt(ratio);
        is_one = is_one && ratio > 0;
    }
    if (!is_one) {
        return fail(error, ERROR_DOMAIN,
                    "the beam folds over itself behind the lens: there is no diffraction MTF");
    }
    if (!pupil_fit_open(&fit)) {
        return fail(error, ERROR_DOMAIN, "the pupil is too distorted for the diffraction MTF");
    }
    pupil_fit_find(&fit, values, wave->work, wave->c);
    pupil_look(&rule->form, (const double *const *)wave->c, &look);
    for (int k = 0; k < 2; k++) {
        for (size_t i = 0; i < rule->room; i++) {
            wave->rest[k][i] = values[k][i] - wave->rest[k][i];
        }
    }
    return true;
}

/* -------- backwards -------- */

/*
 * Through the least squares in places: of coefficients c = G^-1 Z'w f, G = Z'w Z, a combination
 * by . c changes by mu'(Z'w df + dZ'w (f - Z c) - Z'w dZ c), mu = G^-1 by.
 */
static void fit_back(struct pupil_wave *wave, double *const by_value[2], double *const by_place[2])
{
    const struct pupil_rule *rule = wave->rule;
    const struct pupil_fit fit = fit_of_places(wave);
    double *const *work = wave->work;
    const struct pupil_look look = {.count = rule->room,
                                    .x = wave->place[0],
                                    .y = wave->place[1],
                                    .value = {by_value[0], by_value[1]},
                                    .slope = {{work[0], work[1]}, {work[2], work[3]}}};
    pupil_fit_solve(&fit, wave->by_c[0]);
    pupil_fit_solve(&fit, wave->by_c[1]);
    pupil_look(&rule->form, (const double *const *)wave->by_c, &look);
    for (size_t i = 0; i < rule->room; i++) {
        const double weight = rule->weights[i];
        for (int axis = 0; axis < 2; axis++) {
            by_place[axis][i] = 0;
            for (int k = 0; k < 2; k++) {
                by_place[axis][i] += weight * (wave->rest[k][i] * look.slope[k][axis][i] -
                                               by_value[k][i] * wave->front[k][axis][i]);
            }
        }
        by_value[0][i] *= weight;
        by_value[1][i] *= weight;
    }
}

/* An area as its slopes are moved: into them in place. */
static void area_back(double *slope[2][2], size_t i, double by)
{
    const double xx = slope[0][0][i], xy = slope[0][1][i];
    const double yx = slope[1][0][i], yy = slope[1][1][i];
    slope[0][0][i] = by * yy;
    slope[0][1][i] = -by * yx;
    slope[1][0][i] = -by * xy;
    slope[1][1][i] = by * xx;
}

void pupil_wave_begin_back(struct pupil_wave *wave)
{
    for (int k = 0; k < 2; k++) {
        memset(wave->by_c[k], 0, wave->rule->form.terms * sizeof(double));
    }
    memset(wave->by_rim, 0, sizeof wave->by_rim);
    memset(wave->by_matrix, 0, sizeof wave->by_matrix);
    wave->by_energy = 0;
}

void pupil_wave_back(struct pupil_wave *wave)
{
    const struct pupil_rule *rule = wave->rule;
    double *const by_value[2] = {wave->back[PUPIL_WAVE], wave->back[PUPIL_FROM_X]};
    double *const by_place[2] = {wave->work[4], wave->work[5]};
    double *slopes[4][2];
    fit_back(wave, by_value, by_place);
    for (int k = 0; k < 8; k++) { /* what is there stays: another direction follows */
        slopes[k / 2][k % 2] = wave->copy[k];
        memcpy(wave->copy[k], wave->slope[k / 2][k % 2], rule->room * sizeof(double));
    }
    for (size_t i = 0; i < rule->room; i++) {
        const double amplitude = wave->amplitude[i], by = by_value[1][i];
        const bool is_ray = i < rule->count;
        const double beam = pupil_area(wave->slope + 2, i), place = pupil_area(wave->slope, i);
        area_back(slopes, i, is_ray ? -by * amplitude / (2 * place) : 0);
        area_back(slopes + 2, i,
                  is_ray ? by * amplitude / (2 * beam) +
                               wave->by_energy * PI * wave->sign * rule->weights[i]
                         : 0);
    }
    slopes_back(wave, slopes, wave->by_rim, by_place);
    /* from places to direction cosines, and by their linear function */
    const double *inverse = wave->inverse;
    double by[2][3], shares[3];
    for (int k = 0; k < 2; k++) {
        by[k][0] = 0;
        by[k][1] = wave->by_matrix[2 * k];
        by[k][2] = wave->by_matrix[2 * k + 1];
    }
    for (size_t i = 0; i < rule->count; i++) {
        for (int k = 0; k < 2; k++) {
            const double here = inverse[k] * by_place[0][i] + inverse[2 + k] * by_place[1][i];
            wave->back[k][i] = here;
            by[k][0] -= here;
            by[k][1] -= here * wave->place[0][i];
            by[k][2] -= here * wave->place[1][i];
        }
    }
    for (size_t i = 0; i < rule->count; i++) {
        linear_shares(rule, i, shares);
        for (int n = 0; n < 6; n++) {
            wave->back[n / 3][i] += by[n / 3][n % 3] * shares[n % 3];
        }
    }
    memset(wave->back[PUPIL_FROM_X], 0, rule->room * sizeof(double));
    memset(wave->back[PUPIL_FROM_Y], 0, rule->room * sizeof(double));
    slopes_back(wave, slopes + 2, NULL, wave->back + PUPIL_FROM_X);
}

/* -------- by rays -------- */

void pupil_spot_open(const struct pupil_rule *rule, struct arena *arena, struct pupil_spot *spot)
{
    double **arrays[] = {&spot->place[0],    &spot->place[1], &spot->area,     &spot->by_place[0],
                         &spot->by_place[1], &spot->by_area,  &spot->spare[0], &spot->spare[1]};
    pupil_wave_open(rule, arena, &spot->wave);
    for (size_t i = 0; i < sizeof arrays / sizeof arrays[0]; i++) {
        *arrays[i] = ARENA_ARRAY(arena, rule->fine_room, double);
    }
    for (int i = 0; i < 4; i++) {
        spot->slope[i / 2][i % 2] = ARENA_ARRAY(arena, rule->fine_room, double);
        spot->copy[i / 2][i % 2] = ARENA_ARRAY(arena, rule->fine_room, double);
    }
}

bool pupil_spot_find(struct pupil_spot *spot, struct error *error)
{
    double *none[2][2] = {{NULL}};
    struct pupil_wave *wave = &spot->wave;
    const struct pupil_rule *rule = wave->rule;
    const double *const from[2] = {wave->parts[PUPIL_FROM_X], wave->parts[PUPIL_FROM_Y]};
    const double *const to[2] = {wave->parts[PUPIL_TO_X], wave->parts[PUPIL_TO_Y]};
    bool is_one = true;
    const struct pupil_look places = pupil_rule_look(rule, true, spot->place, none);
    const struct pupil_look slopes = pupil_rule_look(rule, true, spot->spare, spot->slope);
    pupil_wave_find_at(wave, to, &places);
    pupil_wave_find_at(wave, from, &slopes);
    spot->sign = pupil_area(spot->slope, 0) < 0 ? -1 : 1;
    for (size_t i = 0; i < rule->fine_count; i++) {
        const double area = spot->sign * pupil_area(spot->slope, i);
        spot->area[i] = rule->fine_weights[i] * area;
        is_one = is_one && area > 0;
    }
    return is_one ||
           fail(error, ERROR_DOMAIN, "the beam is folded within the pupil: there is no contrast");
}

void pupil_spot_back(struct pupil_spot *spot)
{
    double *none[2][2] = {{NULL}};
    struct pupil_wave *wave = &spot->wave;
    const struct pupil_rule *rule = wave->rule;
    for (size_t i = 0; i < rule->fine_room; i++) {
        for (int k = 0; k < 4; k++) { /* what is there stays: another direction follows */
            spot->copy[k / 2][k % 2][i] = spot->slope[k / 2][k % 2][i];
        }
        area_back(spot->copy, i,
                  i < rule->fine_count ? spot->by_area[i] * rule->fine_weights[i] * spot->sign : 0);
        spot->spare[0][i] = spot->spare[1][i] = 0;
    }
    for (int part = 0; part < PUPIL_PARTS; part++) {
        memset(wave->back[part], 0, rule->room * sizeof(double));
    }
    const struct pupil_look places = pupil_rule_look(rule, true, spot->by_place, none);
    const struct pupil_look slopes = pupil_rule_look(rule, true, spot->spare, spot->copy);
    pupil_gather(&rule->form, &places, wave->sums);
    pupil_wave_rays_back(wave, wave->back + PUPIL_TO_X);
    pupil_gather(&rule->form, &slopes, wave->sums);
    pupil_wave_rays_back(wave, wave->back + PUPIL_FROM_X);
}
