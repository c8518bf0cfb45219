/* exchange/codev/codev_write_positions.c - the positions of a lens as CODE V's zoom positions. */
/* SPDX-License-Identifier: MIT */
#include "exchange/codev/codev_writer.h"

#include "file/decimal.h"

#include <math.h>
#include <string.h>

static void codev_write_positions_put_string(struct codev_output *output, const char *string)
{
    growing_string(&output->writing.text, string);
}

static void codev_write_positions_put_values(struct codev_output *output, const char *name,
                                             const struct figure *values, int power, bool halve)
{
    size_t column = strlen(name);
    codev_write_positions_put_string(output, name);
    for (size_t i = 0; i < output->lens->position_count; i++) {
        struct text number = isinf(values[i].value.hi)
                                 ? text_of("0.1e14")
                                 : writing_length(&output->writing, &values[i], power);
        codev_put_number(output, &column,
                         halve ? decimal_half(number, output->job->arena) : number);
    }
    codev_write_positions_put_string(output, "\n");
}

/* The same in every position. */
static void put_pupils(struct codev_output *output)
{
    const struct lens *lens = output->lens;
    struct figure *pupils = ARENA_ARRAY(output->job->arena, lens->position_count, struct figure);
    for (size_t i = 0; i < lens->position_count; i++) {
        pupils[i].variable = LENS_NONE;
        if (!writing_pupil(&output->writing, i, &pupils[i])) {
            return;
        }
    }
    codev_write_positions_put_values(output, "ZOO EPD", pupils, 1, false);
}

/* CODE V counts the planes that were put in for coordinate breaks. */
static size_t codev_write_positions_number_of(const struct lens *lens, size_t index)
{
    size_t number = 1;
    for (size_t i = 0; i <= index; i++) {
        number += i < index;
        number += lens->surfaces[i].decentre != NULL && lens->surfaces[i].coordinate_break != NULL;
    }
    return number;
}

/* What a parameter is called, and what stands behind the surface's number; null: by no word. */
static const char *codev_write_positions_word_of(const struct surface *surface,
                                                 struct parameter parameter, struct arena *arena,
                                                 const char **rest)
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
static struct text codev_write_positions_value_of(struct codev_output *output,
                                                  struct parameter parameter,
                                                  const struct figure *figure)
{
    const struct parameter_type *type = parameter_type(parameter.kind);
    const bool is_left = parameter.kind == PARAMETER_TILT_X || parameter.kind == PARAMETER_TILT_Y ||
                         parameter.kind == PARAMETER_BREAK_TILT_X ||
                         parameter.kind == PARAMETER_BREAK_TILT_Y;
    if (isinf(figure->value.hi)) {
        return text_of("0.0");
    }
    if ((type->is & PARAMETER_IS_ANGLE) == 0) {
        return writing_length(&output->writing, figure,
                              parameter_length(parameter.kind, parameter.order));
    }
    const struct text degrees = writing_degrees(&output->writing, figure);
    return is_left ? decimal_negate(degrees, output->job->arena) : degrees;
}

static bool codev_write_positions_put_setting(struct codev_output *output,
                                              const struct lens_setting *one, struct error *error)
{
    struct arena *arena = output->job->arena;
    const struct parameter parameter = one->parameter;
    const struct surface *surface = &output->lens->surfaces[parameter.surface];
    const bool on_plane = parameter.kind >= PARAMETER_BREAK_DECENTER_X &&
                          surface->decentre != NULL && surface->coordinate_break != NULL;
    const size_t number =
        codev_write_positions_number_of(output->lens, parameter.surface) - on_plane;
    const char *rest = "",
               *word = one->media != NULL
                           ? "GLA"
                           : codev_write_positions_word_of(surface, parameter, arena, &rest);
    if (word == NULL) {
        return foreign_lose(output->job, error,
                            "what the positions set %s to" LOSS_INSTEAD
                            "the first position's is kept",
                            parameter_write(parameter, arena));
    }
    const char *command = arena_printf(arena, "ZOO %s S%zu%s", word, number, rest);
    size_t column = strlen(command);
    codev_write_positions_put_string(output, command);
    for (size_t p = 0; p < output->lens->position_count; p++) {
        if (one->media == NULL) {
            codev_put_number(output, &column,
                             codev_write_positions_value_of(output, parameter, &one->figures[p]));
        } else if (medium_is_air(&one->media[p])) {
            codev_write_positions_put_string(output, " AIR");
        } else if (!codev_put_medium(output, &one->media[p], error)) {
            return false;
        }
    }
    codev_write_positions_put_string(output, "\n");
    return true;
}

static bool codev_write_positions_put_settings(struct codev_output *output, struct error *error)
{
    for (size_t i = 0; i < output->lens->setting_count; i++) {
        if (!codev_write_positions_put_setting(output, &output->lens->settings[i], error)) {
            return false;
        }
    }
    return true;
}

/* XAN Z2 .., YAN Z2 .., WTF Z2 .. */
static void codev_write_positions_put_points(struct codev_output *output,
                                             const struct lens_points *points, size_t position)
{
    for (int what = 0; what < 3; what++) {
        const char *word = what < 2 ? codev_field_words[output->lens->field_kind][what] : "WTF";
        const char *command = arena_printf(output->job->arena, "%s Z%zu", word, position + 1);
        size_t column = strlen(command);
        codev_write_positions_put_string(output, command);
        for (size_t i = 0; i < points->count; i++) {
            const struct lens_field *field = &points->fields[i];
            const struct text weight =
                field->weight_typed.start != NULL ? field->weight_typed : text_of("1");
            codev_put_number(output, &column,
                             what < 2 ? codev_coordinate(output, &field->at[what]) : weight);
        }
        codev_write_positions_put_string(output, "\n");
    }
}

/* WL Z2 .. and WTW Z2 .. */
static void put_light(struct codev_output *output, const struct lens_light *light, size_t position)
{
    for (int weights = 0; weights < 2; weights++) {
        const char *command =
            arena_printf(output->job->arena, "%s Z%zu", weights ? "WTW" : "WL", position + 1);
        size_t column = strlen(command);
        codev_write_positions_put_string(output, command);
        for (size_t i = 0; i < light->count; i++) {
            const struct lens_wavelength *one = &light->wavelengths[i];
            const struct text weight =
                one->weight_typed.start != NULL ? one->weight_typed : text_of("1");
            codev_put_number(
                output, &column,
                weights ? weight : writing_wave(&output->writing, one->wavelength, one->typed, 3));
        }
        codev_write_positions_put_string(output, "\n");
    }
}

static void codev_write_positions_put_stops_and_waves(struct codev_output *output)
{
    const struct lens *lens = output->lens;
    for (size_t p = 0; p < lens->position_count; p++) {
        if (lens->stops != NULL) {
            growing_format(&output->writing.text, "STO S%zu Z%zu\n",
                           codev_write_positions_number_of(lens, lens->stops[p]), p + 1);
        }
        if (lens->lights != NULL) {
            put_light(output, &lens->lights[p], p);
        }
        if (lens->points != NULL) {
            codev_write_positions_put_points(output, &lens->points[p], p);
        }
    }
}

bool codev_put_positions(struct codev_output *output, struct error *error)
{
    const struct lens *lens = output->lens;
    struct arena *arena = output->job->arena;
    if (lens->position_count == 0) {
        return true;
    }
    growing_format(&output->writing.text, "ZOO %zu\nZOO TIT\n", lens->position_count);
    for (size_t i = 0; i < lens->position_count; i++) {
        if (!codev_put_text(output, arena_printf(arena, "TIT Z%zu", i + 1), lens->positions[i],
                            error)) {
            return false;
        }
    }
    if (lens->apertures != NULL && lens->aperture_kind > APERTURE_STOP) {
        codev_write_positions_put_values(
            output, arena_printf(arena, "ZOO %s", codev_aperture_words[lens->aperture_kind]),
            lens->apertures, lens->aperture_kind == APERTURE_EPD, false);
    }
    if (lens->aperture_kind == APERTURE_STOP) {
        put_pupils(output);
    }
    if (lens->objects != NULL) {
        codev_write_positions_put_values(output, "ZOO THI SO", lens->objects, 1, false);
    }
    for (size_t i = 0; i < lens->surface_count; i++) {
        const struct surface *surface = &lens->surfaces[i];
        size_t number = codev_write_positions_number_of(lens, i);
        if (surface->has_thickness && surface->thickness.variable != LENS_NONE) {
            codev_write_positions_put_values(output, arena_printf(arena, "ZOO THI S%zu", number),
                                             lens->variables[surface->thickness.variable].values, 1,
                                             false);
        }
        if (surface->has_diameter && surface->diameter.variable != LENS_NONE) {
            codev_write_positions_put_values(output, arena_printf(arena, "ZOO CIR S%zu", number),
                                             lens->variables[surface->diameter.variable].values, 1,
                                             true);
        }
    }
    codev_write_positions_put_stops_and_waves(output);
    return codev_write_positions_put_settings(output, error);
}
