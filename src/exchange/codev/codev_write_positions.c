/* exchange/codev/codev_write_positions.c - the positions of a lens as CODE V's zoom positions. */
/* SPDX-License-Identifier: MIT */
#include "exchange/codev/codev_writer.h"

#include <math.h>
#include <string.h>

static void codev_put_values(struct lens_writer *writing, const char *name,
                             const struct figure *values, int power, bool halve)
{
    size_t column = strlen(name);
    writing_put(writing, "%s", name);
    for (size_t i = 0; i < writing->lens->position_count; i++) {
        const char *number = "0.1e14";
        if (!isinf(values[i].value.hi)) {
            number = halve ? writing_half(writing, &values[i])
                           : writing_length(writing, &values[i], power);
        }
        codev_put_number(writing, &column, number);
    }
    writing_put(writing, "\n");
}

/* The same in every position. */
static void codev_put_pupils(struct lens_writer *writing)
{
    const size_t count = writing->lens->position_count;
    struct figure *pupils = ARENA_ARRAY(writing->arena, count, struct figure);
    for (size_t i = 0; i < count; i++) {
        pupils[i].variable = LENS_NONE;
        if (!writing_pupil(writing, i, &pupils[i])) {
            return;
        }
    }
    codev_put_values(writing, "ZOO EPD", pupils, 1, false);
}

/* CODE V counts the planes that were put in for coordinate breaks. */
static size_t codev_surface_number(const struct lens *lens, size_t index)
{
    size_t number = 1;
    for (size_t i = 0; i <= index; i++) {
        number += i < index;
        number += lens->surfaces[i].decentre != NULL && lens->surfaces[i].coordinate_break != NULL;
    }
    return number;
}

/* What a parameter is called, and what stands behind the surface's number; null: by no word. */
static const char *codev_setting_word(const struct surface *surface, struct parameter parameter,
                                      struct arena *arena, const char **rest)
{
    static const char *const moves[] = {
        [PARAMETER_DECENTER_X] = "XDE", [PARAMETER_BREAK_DECENTER_X] = "XDE",
        [PARAMETER_DECENTER_Y] = "YDE", [PARAMETER_BREAK_DECENTER_Y] = "YDE",
        [PARAMETER_TILT_X] = "ADE",     [PARAMETER_BREAK_TILT_X] = "ADE",
        [PARAMETER_TILT_Y] = "BDE",     [PARAMETER_BREAK_TILT_Y] = "BDE",
        [PARAMETER_TILT_Z] = "CDE",     [PARAMETER_BREAK_TILT_Z] = "CDE"};
    const bool along_x = surface->curved == CURVED_X, is_odd = codev_is_odd(surface);
    *rest = "";
    switch (parameter.kind) {
    case PARAMETER_RADIUS:
        return along_x ? "RDX" : "RDY";
    case PARAMETER_CURVATURE:
        return along_x ? "CUX" : "CUY";
    case PARAMETER_CONIC:
        *rest = is_odd ? " K" : "";
        return is_odd ? "SCO" : "K";
    case PARAMETER_COEFFICIENT:
        if (!is_odd) {
            return codev_coefficient_word(parameter.order, false, arena);
        }
        *rest = arena_printf(arena, " %s", codev_coefficient_word(parameter.order, true, arena));
        return "SCO";
    default:
        return parameter.kind < sizeof moves / sizeof moves[0] ? moves[parameter.kind] : NULL;
    }
}

/* ADE and BDE turn left-handed; a plane has the radius 0. */
static const char *codev_setting_value(const struct lens_writer *writing,
                                       struct parameter parameter, const struct figure *figure)
{
    if (isinf(figure->value.hi)) {
        return "0.0";
    }
    switch (parameter.kind) {
    case PARAMETER_TILT_X:
    case PARAMETER_TILT_Y:
    case PARAMETER_BREAK_TILT_X:
    case PARAMETER_BREAK_TILT_Y:
        return writing_turned(writing, figure);
    case PARAMETER_TILT_Z:
    case PARAMETER_BREAK_TILT_Z:
        return writing_degrees(writing, figure);
    default:
        return writing_length(writing, figure, parameter_length(parameter.kind, parameter.order));
    }
}

static void codev_put_setting(struct codev_output *output, const struct lens_setting *one)
{
    struct lens_writer *writing = &output->writing;
    const struct parameter parameter = one->parameter;
    const struct surface *surface = &writing->lens->surfaces[parameter.surface];
    const bool on_plane = parameter.kind >= PARAMETER_BREAK_DECENTER_X &&
                          surface->decentre != NULL && surface->coordinate_break != NULL;
    const size_t number = codev_surface_number(writing->lens, parameter.surface) - on_plane;
    const char *rest = "", *word = "GLA";
    if (one->media == NULL) {
        word = codev_setting_word(surface, parameter, writing->arena, &rest);
    }
    if (word == NULL) {
        foreign_lose(writing->job, LOSS_OF_RAYS, "the first position's is kept",
                     "what the positions set %s to", parameter_write(parameter, writing->arena));
        return;
    }
    const char *command = arena_printf(writing->arena, "ZOO %s S%zu%s", word, number, rest);
    size_t column = strlen(command);
    writing_put(writing, "%s", command);
    for (size_t p = 0; p < writing->lens->position_count; p++) {
        if (one->media == NULL) {
            codev_put_number(writing, &column,
                             codev_setting_value(writing, parameter, &one->figures[p]));
        } else if (medium_is_air(&one->media[p])) {
            writing_put(writing, " AIR");
        } else {
            codev_put_medium(output, &one->media[p]);
        }
    }
    writing_put(writing, "\n");
}

/* XAN Z2 .., YAN Z2 .., WTF Z2 .. */
static void codev_put_zoom_fields(struct lens_writer *writing, size_t position)
{
    const struct lens *lens = writing->lens;
    for (int row = CODEV_X; row < CODEV_ROWS; row++) {
        const char *word = row == CODEV_WEIGHTS ? "WTF" : codev_field_words[lens->field_kind][row];
        codev_put_fields(writing, arena_printf(writing->arena, "%s Z%zu", word, position + 1),
                         &lens->points[position], (enum codev_row)row);
    }
}

/* ZOO THI S4 .. of a figure that a variable stands for. */
static void codev_put_variable(struct lens_writer *writing, const char *word, size_t number,
                               const struct figure *figure, bool halve)
{
    if (figure->variable != LENS_NONE) {
        codev_put_values(writing, arena_printf(writing->arena, "ZOO %s S%zu", word, number),
                         writing->lens->variables[figure->variable].values, 1, halve);
    }
}

void codev_put_positions(struct codev_output *output)
{
    struct lens_writer *writing = &output->writing;
    const struct lens *lens = writing->lens;
    struct arena *arena = writing->arena;
    if (lens->position_count == 0) {
        return;
    }
    writing_put(writing, "ZOO %zu\nZOO TIT\n", lens->position_count);
    for (size_t i = 0; i < lens->position_count; i++) {
        codev_put_text(writing, arena_printf(arena, "TIT Z%zu", i + 1), lens->positions[i]);
    }
    if (lens->apertures != NULL && lens->aperture_kind > APERTURE_STOP) {
        codev_put_values(writing,
                         arena_printf(arena, "ZOO %s", codev_aperture_words[lens->aperture_kind]),
                         lens->apertures, lens->aperture_kind == APERTURE_EPD, false);
    }
    if (lens->aperture_kind == APERTURE_STOP) {
        codev_put_pupils(writing);
    }
    if (lens->objects != NULL) {
        codev_put_values(writing, "ZOO THI SO", lens->objects, 1, false);
    }
    for (size_t i = 0; i < lens->surface_count; i++) {
        const struct surface *surface = &lens->surfaces[i];
        const size_t number = codev_surface_number(lens, i);
        if (surface->has_thickness) {
            codev_put_variable(writing, "THI", number, &surface->thickness, false);
        }
        if (surface->has_diameter) {
            codev_put_variable(writing, "CIR", number, &surface->diameter, true);
        }
    }
    for (size_t p = 0; p < lens->position_count; p++) {
        if (lens->stops != NULL) {
            writing_put(writing, "STO S%zu Z%zu\n", codev_surface_number(lens, lens->stops[p]),
                        p + 1);
        }
        if (lens->lights != NULL) {
            codev_put_waves(writing, arena_printf(arena, "WL Z%zu", p + 1), &lens->lights[p],
                            false);
            codev_put_waves(writing, arena_printf(arena, "WTW Z%zu", p + 1), &lens->lights[p],
                            true);
        }
        if (lens->points != NULL) {
            codev_put_zoom_fields(writing, p);
        }
    }
    for (size_t i = 0; i < lens->setting_count; i++) {
        codev_put_setting(output, &lens->settings[i]);
    }
}
