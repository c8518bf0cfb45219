/* tests/stress/drawn_lens.c - random lenses, as decimals and as numbers of 113 bits. */
/* SPDX-License-Identifier: MIT */
#include "drawn_lens.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void drawn_put(struct drawn_lens *lens, size_t i, enum drawn_number which, int digits,
                      double value)
{
    snprintf(lens->number[i][which], DRAWN_DIGITS, "%.*g", digits, value);
}

static void drawn_lens_draw_shape(struct trial *trial, const struct drawn_scale *scale, size_t i,
                                  int digits, struct drawn_lens *lens)
{
    if (trial_chance(trial, scale->conics)) {
        drawn_put(lens, i, DRAWN_CONIC, digits, trial_between(trial, -5, 2));
    }
    if (trial_chance(trial, scale->aspheres)) {
        const double h = scale->height, bend = trial_between(trial, -0.03, 0.03);
        drawn_put(lens, i, DRAWN_A4, digits, bend / (h * h * h));
        drawn_put(lens, i, DRAWN_A6, digits, trial_between(trial, -0.5, 0.5) * bend / pow(h, 5));
    }
    if (scale->odd > 0 && trial_chance(trial, scale->odd)) {
        const double h = scale->height, bend = trial_between(trial, -0.03, 0.03);
        drawn_put(lens, i, DRAWN_A3, digits, bend / (h * h));
        drawn_put(lens, i, DRAWN_A5, digits, trial_between(trial, -0.5, 0.5) * bend / pow(h, 4));
    }
    if (scale->cylinders > 0 && trial_chance(trial, scale->cylinders)) {
        lens->cylinder[i] = trial_chance(trial, 0.5) ? 'x' : 'y';
    }
    if (scale->breaks > 0 && trial_chance(trial, scale->breaks)) {
        const double h = scale->height;
        drawn_put(lens, i, DRAWN_BREAK_X, digits, trial_between(trial, -0.1, 0.1) * h);
        drawn_put(lens, i, DRAWN_BREAK_Y, digits, trial_between(trial, -0.1, 0.1) * h);
        drawn_put(lens, i, DRAWN_BREAK_TILT_X, digits, trial_between(trial, -8, 8));
        drawn_put(lens, i, DRAWN_BREAK_TILT_Y, digits, trial_between(trial, -8, 8));
    }
    if (trial_chance(trial, scale->tilts)) {
        const double h = scale->height;
        drawn_put(lens, i, DRAWN_DECENTER_X, digits, trial_between(trial, -0.1, 0.1) * h);
        drawn_put(lens, i, DRAWN_DECENTER_Y, digits, trial_between(trial, -0.1, 0.1) * h);
        drawn_put(lens, i, DRAWN_TILT_X, digits, trial_between(trial, -8, 8));
        drawn_put(lens, i, DRAWN_TILT_Y, digits, trial_between(trial, -8, 8));
    }
}

void drawn_lens_draw(struct trial *trial, const struct drawn_scale *scale, struct drawn_lens *lens)
{
    const int digits = trial_whole(trial, 2, 17), index_digits = digits > 6 ? 6 : digits;
    double way = 1, radius = 0;
    lens->count = (size_t)trial_whole(trial, (int)scale->least, (int)scale->most);
    lens->stop = (size_t)trial_whole(trial, 0, (int)lens->count - 1);
    memset(lens->number, 0, lens->count * sizeof lens->number[0]);
    memset(lens->cylinder, 0, lens->count);
    memset(lens->clear, 0, lens->count * sizeof lens->clear[0]);
    for (size_t i = 0; i < lens->count; i++) {
        const bool mirror = trial_chance(trial, scale->mirrors);
        double R = trial_sign(trial) * trial_magnitude(trial, scale->radius[0], scale->radius[1]);
        double t = trial_magnitude(trial, scale->thickness[0], scale->thickness[1]);
        R = trial_chance(trial, scale->planes) ? 0 : R;
        if (scale->is_concentric) { /* about one point: t = R - R' */
            R = i == 0 ? fabs(R) : radius;
            R = R == 0 ? scale->radius[0] : R;
            t = R * trial_between(trial, -0.5, 0.5);
            t = R > 0 ? fabs(t) : t;
        }
        way = mirror && scale->folds ? -way : way;
        t *= scale->is_concentric ? 1 : way;
        drawn_put(lens, i, DRAWN_RADIUS, digits, R);
        drawn_put(lens, i, DRAWN_THICKNESS, digits, t);
        radius = strtod(lens->number[i][DRAWN_RADIUS], NULL) -
                 strtod(lens->number[i][DRAWN_THICKNESS], NULL);
        double n = trial_between(trial, scale->index[0], scale->index[1]);
        n = trial_chance(trial, scale->air) ? 1 : n;
        drawn_put(lens, i, DRAWN_INDEX, index_digits, mirror ? 0 : n);
        drawn_lens_draw_shape(trial, scale, i, digits, lens);
    }
    snprintf(lens->object, DRAWN_DIGITS, "%.*g", digits,
             trial_chance(trial, scale->far)
                 ? 0
                 : trial_magnitude(trial, scale->object[0], scale->object[1]));
}

/* -------- numbers -------- */

static quad drawn_quad(const struct drawn_lens *drawn, size_t i, enum drawn_number which)
{
    return quad_read(drawn->number[i][which]);
}

void quad_lens_of(const struct drawn_lens *drawn, struct quad_lens *lens)
{
    quad before = 1;
    lens->count = drawn->count;
    lens->stop = drawn->stop;
    lens->object = quad_read(drawn->object);
    for (size_t i = 0; i < drawn->count; i++) {
        const quad R = drawn_quad(drawn, i, DRAWN_RADIUS), n = drawn_quad(drawn, i, DRAWN_INDEX);
        const quad degree = quad_pi() / 180;
        lens->surfaces[i] = (struct quad_surface){
            .c = R == 0 ? 0 : 1 / R,
            .t = drawn_quad(drawn, i, DRAWN_THICKNESS),
            .n = n == 0 ? before : n,
            .k = drawn_quad(drawn, i, DRAWN_CONIC),
            .A4 = drawn_quad(drawn, i, DRAWN_A4),
            .A6 = drawn_quad(drawn, i, DRAWN_A6),
            .decenter = {drawn_quad(drawn, i, DRAWN_DECENTER_X),
                         drawn_quad(drawn, i, DRAWN_DECENTER_Y)},
            .tilt = {degree * drawn_quad(drawn, i, DRAWN_TILT_X),
                     degree * drawn_quad(drawn, i, DRAWN_TILT_Y)},
            .A3 = drawn_quad(drawn, i, DRAWN_A3),
            .A5 = drawn_quad(drawn, i, DRAWN_A5),
            .break_decenter = {drawn_quad(drawn, i, DRAWN_BREAK_X),
                               drawn_quad(drawn, i, DRAWN_BREAK_Y)},
            .break_tilt = {degree * drawn_quad(drawn, i, DRAWN_BREAK_TILT_X),
                           degree * drawn_quad(drawn, i, DRAWN_BREAK_TILT_Y)},
            .weight = {drawn->cylinder[i] != 'y', drawn->cylinder[i] != 'x'},
            .reflects = n == 0,
        };
        before = lens->surfaces[i].n;
    }
}

/* -------- near afocal -------- */

void drawn_lens_make_afocal(struct trial *trial, struct drawn_lens *lens)
{
    static struct quad_lens numbers;
    const size_t last = lens->count - 1;
    quad n = 1, y = 1, v = 0;
    snprintf(lens->object, DRAWN_DIGITS, "0");
    if (strcmp(lens->number[last][DRAWN_RADIUS], "0") == 0) {
        snprintf(lens->number[last][DRAWN_RADIUS], DRAWN_DIGITS, "-20");
    }
    if (strcmp(lens->number[last][DRAWN_INDEX], lens->number[last - 1][DRAWN_INDEX]) == 0 ||
        lens->number[last][DRAWN_INDEX][0] == '0') {
        snprintf(lens->number[last][DRAWN_INDEX], DRAWN_DIGITS, "1.25");
    }
    quad_lens_of(lens, &numbers);
    quad sign = 1;
    for (size_t i = 0; i < last; i++) {
        const struct quad_surface *surface = &numbers.surfaces[i];
        sign = surface->reflects ? -sign : sign;
        v -= y * (sign * surface->n - n) * surface->c;
        n = sign * surface->n;
        y += i + 1 < last ? surface->t / n * v : 0;
    }
    /* v' = v - (y + t v/n) P = 0 */
    const quad P = (sign * numbers.surfaces[last].n - n) * numbers.surfaces[last].c;
    const quad t = v == 0 ? 1 : (v / P - y) * n / v;
    quad_write(lens->number[last - 1][DRAWN_THICKNESS], DRAWN_DIGITS, t, trial_whole(trial, 3, 30));
}

/* -------- text -------- */

const char *drawn_lens_write(const struct drawn_lens *lens, struct arena *arena)
{
    const size_t room = 200 + lens->count * (DRAWN_NUMBERS * (DRAWN_DIGITS + 10) + 40);
    char *text = arena_array(arena, room, 1), *at = text;
    *at = '\0';
    if (strcmp(lens->object, "0") != 0) {
        at += sprintf(at, "object %s\n", lens->object);
    }
    for (size_t i = 0; i < lens->count; i++) {
        const char(*number)[DRAWN_DIGITS] = lens->number[i];
        const bool plane = strcmp(number[DRAWN_RADIUS], "0") == 0;
        const bool mirror = strcmp(number[DRAWN_INDEX], "0") == 0;
        if (number[DRAWN_BREAK_TILT_X][0] != '\0') {
            at += sprintf(at, "bend decenter=%s,%s tilt=%s,%s,0\n", number[DRAWN_BREAK_X],
                          number[DRAWN_BREAK_Y], number[DRAWN_BREAK_TILT_X],
                          number[DRAWN_BREAK_TILT_Y]);
        }
        at += sprintf(at, "surface %s %s %s ", plane ? "-" : number[DRAWN_RADIUS],
                      number[DRAWN_THICKNESS], mirror ? "mirror" : number[DRAWN_INDEX]);
        at += lens->clear[i] > 0 ? sprintf(at, "%.17g", lens->clear[i]) : sprintf(at, "-");
        static const struct {
            const char *word;
            enum drawn_number which;
        } words[] = {{"k", DRAWN_CONIC},
                     {"A4", DRAWN_A4},
                     {"A6", DRAWN_A6},
                     {"A3", DRAWN_A3},
                     {"A5", DRAWN_A5}};
        for (size_t j = 0; j < sizeof words / sizeof words[0]; j++) {
            if (number[words[j].which][0] != '\0') {
                at += sprintf(at, " %s=%s", words[j].word, number[words[j].which]);
            }
        }
        if (lens->cylinder[i] != '\0') {
            at += sprintf(at, " cyl=%c", lens->cylinder[i]);
        }
        if (number[DRAWN_TILT_X][0] != '\0') {
            at += sprintf(at, " decenter=%s,%s tilt=%s,%s", number[DRAWN_DECENTER_X],
                          number[DRAWN_DECENTER_Y], number[DRAWN_TILT_X], number[DRAWN_TILT_Y]);
        }
        at += sprintf(at, "%s\n", i == lens->stop ? " stop" : "");
    }
    return text;
}
