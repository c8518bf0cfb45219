/* file/lens_build.c - put a lens together while another program's file is read. */
/* SPDX-License-Identifier: MIT */
#include "file/lens_build.h"

#include "data/lines.h"
#include "file/decimal.h"
#include "file/lens_unit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const struct figure no_figure = {.variable = LENS_NONE};

struct figure figure_zero(void)
{
    struct figure zero = no_figure;
    zero.typed = text_of("0");
    return zero;
}

struct figure figure_negate(struct figure figure, struct arena *arena)
{
    if (figure.variable != LENS_NONE || figure.value.hi == 0) {
        return figure;
    }
    if (isinf(figure.value.hi)) {
        figure.typed = text_of(figure.value.hi > 0 ? "-inf" : "inf");
    } else if (figure.typed.length > 0) {
        figure.typed = decimal_negate(figure.typed, arena);
    }
    figure.value = pair_negate(figure.value);
    return figure;
}

void lens_build_begin(struct lens_build *build, struct lens *lens, struct arena *arena)
{
    *build = (struct lens_build){.lens = lens, .arena = arena};
    *lens = (struct lens){.unit = lens_units[0].word,
                          .object_is_infinite = true,
                          .object = {{INFINITY, 0}, {NULL, 0}, LENS_NONE},
                          .object_medium = medium_air,
                          .aperture = no_figure,
                          .focus = FOCUS_PARAXIAL,
                          .stop = LENS_NONE};
    lens->object.typed = text_of("inf");
}

struct surface *lens_build_surface(struct lens_build *build)
{
    struct lens *lens = build->lens;
    struct surface *surface =
        ARENA_ADD(build->arena, lens->surfaces, lens->surface_count, build->surface_room);
    *surface = (struct surface){.kind = SURFACE_REFRACT,
                                .is_plane = true,
                                .has_thickness = true,
                                .radius = no_figure,
                                .curvature = no_figure,
                                .thickness = figure_zero(),
                                .focal = no_figure,
                                .hiatus = no_figure,
                                .distortion = {no_figure, no_figure, no_figure},
                                .diameter = no_figure,
                                .conic = no_figure,
                                .medium = medium_air};
    for (int i = 0; i < LENS_COEFFICIENTS; i++) {
        surface->coefficient[i] = no_figure;
    }
    return surface;
}

void lens_build_stop(struct lens_build *build, size_t index)
{
    struct lens *lens = build->lens;
    struct surface *surface = &lens->surfaces[index];
    bool bare = surface->kind == SURFACE_REFRACT && surface->is_plane && !surface->has_curvature &&
                surface->coefficients == 0 && surface->conic.value.hi == 0 &&
                surface_is_round(surface) &&
                medium_is_same(index > 0 ? &lens->surfaces[index - 1].medium : &lens->object_medium,
                               &surface->medium);
    surface->kind = bare ? SURFACE_STOP : surface->kind;
    surface->is_stop = true;
    lens->stop = index;
}

const char *lens_build_string(struct lens_build *build, struct text text)
{
    char *string = arena_array(build->arena, 3 * text.length + 1, 1), *to = string;
    for (size_t i = 0; i < text.length; i++) {
        unsigned char c = (unsigned char)text.start[i];
        bool begins = i == 0 || to[-1] == ' ';
        if (c == '#' && begins) {
            memcpy(to, "No.", 3);
            to += 3;
        } else if (c == 0xc2 && i + 1 < text.length && (unsigned char)text.start[i + 1] < 0xa0) {
            *to++ = ' '; /* U+0080 to U+009F, control characters that no file may have */
            i++;
        } else {
            *to++ = (char)(c < ' ' || c == 127 ? ' ' : c);
        }
    }
    return string;
}

void lens_build_note(struct lens_build *build, struct text note)
{
    struct lens *lens = build->lens;
    *ARENA_ADD(build->arena, lens->notes, lens->note_count, build->note_room) =
        lens_build_string(build, note);
}

struct lens_wavelength *lens_build_wavelength(struct lens_build *build, double micrometres,
                                              double weight)
{
    struct lens *lens = build->lens;
    struct lens_wavelength *one =
        ARENA_ADD(build->arena, lens->wavelengths, lens->wavelength_count, build->wavelength_room);
    *one = (struct lens_wavelength){.wavelength = micrometres, .weight = weight};
    char number[NUMBER_LENGTH];
    char *end = number_write_shortest(number, micrometres);
    one->typed = text_of(arena_printf(build->arena, "%.*sum", (int)(end - number), number));
    static const char *const lines[] = {"d",  "F", "C", "e", "g", "F'",
                                        "C'", "h", "i", "r", "s", "t"};
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        double wavelength;
        bool same = lines_standard(text_of(lines[i]), &wavelength) && wavelength == micrometres;
        one->typed = same ? text_of(lines[i]) : one->typed;
    }
    if (weight != 1) {
        end = number_write_shortest(number, weight);
        one->weight_typed = text_of(arena_string(build->arena, number, (size_t)(end - number)));
    }
    return one;
}

struct lens_field *lens_build_field(struct lens_build *build)
{
    struct lens *lens = build->lens;
    lens->fields = arena_grow(build->arena, lens->fields, lens->field_count, &build->field_room,
                              sizeof lens->fields[0]);
    lens->fields[lens->field_count] = lens_field_none;
    return &lens->fields[lens->field_count++];
}

size_t lens_build_variable(struct lens_build *build, const char *name, const struct figure *values)
{
    struct lens *lens = build->lens;
    *ARENA_ADD(build->arena, lens->variables, lens->variable_count, build->variable_room) =
        (struct lens_variable){.name = text_of(arena_string(build->arena, name, strlen(name))),
                               .values = values};
    return lens->variable_count - 1;
}

static struct figure figure_typed(const char *start, const char *end, struct number_scale unit,
                                  struct arena *arena)
{
    struct figure figure = no_figure;
    figure.typed = text_of(arena_string(arena, start, (size_t)(end - start)));
    text_pair(figure.typed, unit, &figure.value);
    return figure;
}

struct figure figure_computed(struct pair value, struct number_scale unit, struct arena *arena)
{
    char text[PAIR_LENGTH];
    return figure_typed(text, pair_write_shortest(text, value, unit), unit, arena);
}

struct figure figure_rounded(struct pair value, struct number_scale unit, struct arena *arena)
{
    static const char one[] = "1";
    char text[NUMBER_LENGTH];
    struct pair length = {1, 0};
    pair_read(one, one + 1, unit, &length);
    return figure_typed(text, number_write_shortest(text, pair_divide(value, length).hi), unit,
                        arena);
}

struct figure figure_of(double value, struct arena *arena)
{
    char text[NUMBER_LENGTH];
    return figure_typed(text, number_write_shortest(text, value), NUMBER_UNSCALED, arena);
}

struct figure figure_per_length(struct figure figure, const char *unit, int power)
{
    const struct number_scale scale = lens_unit_scale(unit);
    const char *end = figure.typed.start + figure.typed.length;
    if (power == 1) {
        pair_read(figure.typed.start, end, scale, &figure.value);
        return figure;
    }
    static const char one[] = "1";
    struct pair length = {1, 0}, factor = {1, 0};
    pair_read(one, one + 1, scale, &length);
    pair_read(figure.typed.start, end, NUMBER_UNSCALED, &figure.value);
    for (int i = 0; i < abs(power); i++) {
        factor = pair_multiply(factor, length);
    }
    figure.value =
        power < 0 ? pair_divide(figure.value, factor) : pair_multiply(figure.value, factor);
    return figure;
}

double figure_rounding(const struct figure *figure)
{
    double typed = 0, power = 0.5;
    bool behind = false;
    const char *at = figure->typed.start, *end = at + figure->typed.length;
    for (; at < end && (*at | 32) != 'e'; at++) {
        power /= behind && *at >= '0' && *at <= '9' ? 10 : 1;
        behind = behind || *at == '.';
    }
    number_read(figure->typed.start, at, NUMBER_UNSCALED, &typed);
    return typed != 0 ? fabs(power * (figure->value.hi / typed)) : 0;
}

bool figure_radius_of(const struct figure *curvature, const char *unit, struct arena *arena,
                      struct figure *radius)
{
    enum { FEW = 12, MANY = 20, DOUBLE = 15, LONG = 25 };
    /* Significant digits of a typed number. */
    int digits = 0;
    for (size_t i = 0; i < curvature->typed.length && (curvature->typed.start[i] | 32) != 'e';
         i++) {
        bool digit = curvature->typed.start[i] >= '0' && curvature->typed.start[i] <= '9';
        digits += digit && (digits > 0 || curvature->typed.start[i] != '0');
    }
    if (curvature->value.hi == 0) {
        return false;
    }
    bool is_double = digits >= DOUBLE && digits < LONG;
    const struct number_scale scale = lens_unit_scale(unit);
    const struct pair exact = pair_divide(pair_of(1), curvature->value);
    for (int count = 1; count <= (digits < LONG ? FEW : MANY); count++) {
        char text[PAIR_LENGTH];
        struct figure figure =
            figure_typed(text, pair_write_digits(text, exact, scale, count), scale, arena);
        /* Is the curvature what a program that works with doubles makes of this radius? */
        double c = 0, r = 0;
        text_number(curvature->typed, NUMBER_UNSCALED, &c);
        text_number(figure.typed, NUMBER_UNSCALED, &r);
        const bool is_reciprocal = c == 1 / r;
        /* The same to all digits that a pair has. */
        struct pair rest = pair_subtract(pair_multiply(curvature->value, figure.value), pair_of(1));
        if (is_double ? is_reciprocal : fabs(rest.hi) <= 1e-28) {
            *radius = figure_computed(figure.value, scale, arena);
            return true;
        }
    }
    return false;
}
