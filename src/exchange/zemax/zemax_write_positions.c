/* exchange/zemax/zemax_write_positions.c - the operands of the configurations of a .zmx file. */
/* SPDX-License-Identifier: MIT */
#include "exchange/zemax/zemax.h"
#include "exchange/zemax/zemax_writer.h"

#include <math.h>

/* What stands behind the value of an operand. */
#define END_OPERAND " 0 0 0 1 1 1 0 0 \"\" 0\r\n"

/* "THIC 4 2 1.5": an operand of a surface, or of another thing that is numbered. */
static void zemax_put_operand(struct lens_writer *writing, const char *word, size_t number,
                              size_t position, const char *value)
{
    writing_put(writing, "%s %zu %zu %s" END_OPERAND, word, number, position + 1, value);
}

/* One that a variable stands for, in each position. */
static void zemax_put_variable(struct lens_writer *writing, const char *word, size_t number,
                               const struct figure *figure, bool halve)
{
    const struct lens *lens = writing->lens;
    for (size_t p = 0; p < lens->position_count && figure->variable != LENS_NONE; p++) {
        const struct figure *value = &lens->variables[figure->variable].values[p];
        zemax_put_operand(writing, word, number, p,
                          halve ? zemax_half(writing, value) : writing_length(writing, value, 1));
    }
}

static void zemax_lose_setting(struct lens_writer *writing, struct parameter parameter)
{
    foreign_lose(writing->job, LOSS_OF_RAYS, "the first position's is kept",
                 "what the positions set %s to", parameter_write(parameter, writing->arena));
}

/* GLSS names a glass of a catalogue; nothing stands for air. */
static bool zemax_put_glasses(struct zemax_writer *writer, const struct lens_setting *one,
                              struct error *error)
{
    struct lens_writer *writing = &writer->writing;
    const size_t count = writing->lens->position_count, surface = one->parameter.surface;
    for (size_t p = 0; p < count; p++) {
        if (one->media[p].kind != MEDIUM_GLASS && !medium_is_air(&one->media[p])) {
            zemax_lose_setting(writing, one->parameter);
            return true;
        }
    }
    for (size_t p = 0; p < count; p++) {
        writing_put(writing, "GLSS %zu %zu ", writer->own_places[surface], p + 1);
        if (!zemax_put_glass_name(writer, &one->media[p], error)) {
            return false;
        }
        writing_put(writing, END_OPERAND);
    }
    return true;
}

/* CRVT, CONN, PAR1 .. PAR8 */
static void zemax_put_numbers(struct zemax_writer *writer, const struct lens_setting *one)
{
    struct lens_writer *writing = &writer->writing;
    const size_t surface = one->parameter.surface;
    const char *word =
        zemax_operand_of(&writing->lens->surfaces[surface], one->parameter, writing->arena);
    if (word == NULL) {
        zemax_lose_setting(writing, one->parameter);
        return;
    }
    for (size_t p = 0; p < writing->lens->position_count; p++) {
        zemax_put_operand(writing, word, writer->own_places[surface], p,
                          zemax_number_of(writing, one->parameter, &one->figures[p]));
    }
}

/* The digits of a double. */
static const char *zemax_double(const struct lens_writer *writing, double value)
{
    char number[NUMBER_LENGTH];
    return arena_string(writing->arena, number,
                        (size_t)(number_write_shortest(number, value) - number));
}

/* WAVE, WLWT */
static void zemax_put_lights(struct lens_writer *writing)
{
    const struct lens *lens = writing->lens;
    for (size_t i = 0; i < 2 * lens->wavelength_count; i++) {
        for (size_t p = 0; p < lens->position_count; p++) {
            const struct lens_wavelength *wave = &lens->lights[p].wavelengths[i / 2];
            zemax_put_operand(writing, i % 2 ? "WLWT" : "WAVE", i / 2 + 1, p,
                              zemax_double(writing, i % 2 ? wave->weight : wave->wavelength));
        }
    }
}

/* XFIE, YFIE, FLWT */
static void zemax_put_points(struct lens_writer *writing)
{
    static const char *const words[] = {"XFIE", "YFIE", "FLWT"};
    const struct lens *lens = writing->lens;
    for (size_t i = 0; i < 3 * lens->field_count; i++) {
        for (size_t p = 0; p < lens->position_count; p++) {
            const struct lens_field *field = &lens->points[p].fields[i / 3];
            zemax_put_operand(writing, words[i % 3], i / 3 + 1, p,
                              i % 3 == 2 ? zemax_double(writing, field->weight)
                                         : zemax_coordinate(writing, &field->at[i % 3]));
        }
    }
}

/* Where there are as many in all positions; else those of the first. */
static void zemax_put_lists(struct lens_writer *writing)
{
    const struct lens *lens = writing->lens;
    bool same_lights = lens->lights != NULL, same_points = lens->points != NULL;
    for (size_t p = 0; p < lens->position_count; p++) {
        same_lights = same_lights && lens->lights[p].count == lens->wavelength_count;
        same_points = same_points && lens->points[p].count == lens->field_count;
    }
    if (same_lights) {
        zemax_put_lights(writing);
    } else if (lens->lights != NULL) {
        foreign_lose(writing->job, LOSS_OF_RAYS, "those of the first are kept",
                     "positions with more or fewer wavelengths");
    }
    if (same_points) {
        zemax_put_points(writing);
    } else if (lens->points != NULL) {
        foreign_lose(writing->job, LOSS_OF_RAYS, "those of the first are kept",
                     "positions with more or fewer points of the field");
    }
}

const char *zemax_coordinate(const struct lens_writer *writing, const struct figure *coordinate)
{
    if (coordinate->typed.start == NULL && coordinate->value.hi == 0) {
        return "0";
    }
    return writing->lens->field_kind == FIELD_ANGLE ? writing_degrees(writing, coordinate)
                                                    : writing_length(writing, coordinate, 1);
}

/* The object's distance, distances, diameters and apertures of each position. */
bool zemax_put_positions(struct zemax_writer *writer, struct error *error)
{
    struct lens_writer *writing = &writer->writing;
    const struct lens *lens = writing->lens;
    const size_t count = lens->position_count;
    writing_put(writing, "MNUM %zu 1\r\n", count > 0 ? count : 1);
    for (size_t p = 0; p < count && lens->objects != NULL; p++) {
        zemax_put_operand(writing, "THIC", 0, p,
                          isinf(lens->objects[p].value.hi)
                              ? "1e10"
                              : writing_length(writing, &lens->objects[p], 1));
    }
    for (size_t i = 0; i < lens->surface_count; i++) {
        const struct surface *surface = &lens->surfaces[i];
        zemax_put_variable(writing, "THIC", writer->places[i], &surface->thickness, false);
        if (surface->has_diameter) {
            zemax_put_variable(writing, "SDIA", writer->own_places[i], &surface->diameter, true);
        }
        if (surface_has(surface, SURFACE_HAS_FOCAL)) {
            zemax_put_variable(writing, "PAR1", writer->own_places[i], &surface->focal, false);
        }
    }
    for (size_t p = 0; p < count && lens->apertures != NULL; p++) {
        zemax_put_operand(
            writing, "APER", 0, p,
            writing_length(writing, &lens->apertures[p], lens->aperture_kind == APERTURE_EPD));
    }
    for (size_t i = 0; i < lens->setting_count; i++) {
        const struct lens_setting *one = &lens->settings[i];
        if (one->media == NULL) {
            zemax_put_numbers(writer, one);
        } else if (!zemax_put_glasses(writer, one, error)) {
            return false;
        }
    }
    for (size_t p = 0; p < count && lens->stops != NULL; p++) {
        writing_put(writing, "STPS 0 %zu %zu" END_OPERAND, p + 1,
                    writer->own_places[lens->stops[p]]);
    }
    zemax_put_lists(writing);
    if (count > 1) { /* a free line, behind which nothing is missing */
        writing_put(writing, "MOFF 0 1 \"\" 0 0 0 1 1 0 0.0 \"\"\r\n");
    }
    return true;
}
