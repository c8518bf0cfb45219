/* exchange/zemax/zemax_write_positions.c - the operands of the configurations of a .zmx file. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "exchange/zemax/zemax_aperture.h"
#include "exchange/zemax/zemax_writer.h"
#include "file/lens_unit.h"

#include <math.h>

/* What stands behind the value of an operand. */
static void end_operand(struct zemax_writer *writer)
{
    growing_string(&writer->out, " 0 0 0 1 1 1 0 0 \"\" 0\r\n");
}

/* THIC, SDIA and PAR1 of the surfaces whose distance, diameter or focal length changes. */
static void put_variables(struct zemax_writer *writer)
{
    const struct lens *lens = writer->lens;
    size_t count = lens->position_count;
    for (size_t i = 0; i < lens->surface_count; i++) {
        size_t variable = lens->surfaces[i].thickness.variable;
        for (size_t p = 0; p < count && variable != LENS_NONE; p++) {
            growing_format(&writer->out, "THIC %zu %zu ", writer->places[i], p + 1);
            growing_figure(&writer->out, &lens->variables[variable].values[p], writer->unit);
            end_operand(writer);
        }
        variable = lens->surfaces[i].has_diameter ? lens->surfaces[i].diameter.variable : LENS_NONE;
        for (size_t p = 0; p < count && variable != LENS_NONE; p++) {
            growing_format(&writer->out, "SDIA %zu %zu ", writer->own_places[i], p + 1);
            zemax_put_half(writer, &lens->variables[variable].values[p]);
            end_operand(writer);
        }
        variable = surface_has(&lens->surfaces[i], SURFACE_HAS_FOCAL)
                       ? lens->surfaces[i].focal.variable
                       : LENS_NONE;
        for (size_t p = 0; p < count && variable != LENS_NONE; p++) {
            growing_format(&writer->out, "PAR1 %zu %zu ", writer->own_places[i], p + 1);
            growing_figure(&writer->out, &lens->variables[variable].values[p], writer->unit);
            end_operand(writer);
        }
    }
}

static bool lose_setting(struct zemax_writer *writer, struct parameter parameter,
                         struct error *error)
{
    return foreign_lose(writer->job, error,
                        "what the positions set %s to" LOSS_INSTEAD "the first position's is kept",
                        parameter_write(parameter, writer->job->arena));
}

/* GLSS names a glass of a catalogue; nothing stands for air. */
static bool put_glasses(struct zemax_writer *writer, const struct lens_setting *one,
                        struct error *error)
{
    const size_t count = writer->lens->position_count, surface = one->parameter.surface;
    for (size_t p = 0; p < count; p++) {
        if (one->media[p].kind != MEDIUM_GLASS && !medium_is_air(&one->media[p])) {
            return lose_setting(writer, one->parameter, error);
        }
    }
    for (size_t p = 0; p < count; p++) {
        growing_format(&writer->out, "GLSS %zu %zu ", writer->own_places[surface], p + 1);
        if (!zemax_put_glass_name(writer, &one->media[p], error)) {
            return false;
        }
        end_operand(writer);
    }
    return true;
}

/* CRVT, CONN, PAR1 .. PAR8 */
static bool zemax_write_positions_put_numbers(struct zemax_writer *writer,
                                              const struct lens_setting *one, struct error *error)
{
    const struct parameter parameter = one->parameter;
    const char *word =
        zemax_operand_of(&writer->lens->surfaces[parameter.surface], parameter, writer->job->arena);
    if (word == NULL) {
        return lose_setting(writer, parameter, error);
    }
    for (size_t p = 0; p < writer->lens->position_count; p++) {
        growing_format(&writer->out, "%s %zu %zu ", word, writer->own_places[parameter.surface],
                       p + 1);
        zemax_put_number(writer, parameter, &one->figures[p]);
        end_operand(writer);
    }
    return true;
}

static bool zemax_write_positions_put_settings(struct zemax_writer *writer, struct error *error)
{
    const struct lens *lens = writer->lens;
    for (size_t i = 0; i < lens->setting_count; i++) {
        const struct lens_setting *one = &lens->settings[i];
        if (!(one->media != NULL ? put_glasses(writer, one, error)
                                 : zemax_write_positions_put_numbers(writer, one, error))) {
            return false;
        }
    }
    return true;
}

static bool put_waves_of_positions(struct zemax_writer *writer, struct error *error)
{
    const struct lens *lens = writer->lens;
    for (size_t p = 0; p < lens->position_count; p++) {
        if (lens->lights[p].count != lens->wavelength_count) {
            return foreign_lose(writer->job, error,
                                "positions with more or fewer wavelengths" LOSS_INSTEAD
                                "those of the first are kept");
        }
    }
    for (size_t i = 0; i < lens->wavelength_count; i++) {
        for (int weight = 0; weight < 2; weight++) {
            for (size_t p = 0; p < lens->position_count; p++) {
                const struct lens_wavelength *wave = &lens->lights[p].wavelengths[i];
                growing_format(&writer->out, "%s %zu %zu ", weight ? "WLWT" : "WAVE", i + 1, p + 1);
                growing_number(&writer->out, weight ? wave->weight : wave->wavelength);
                end_operand(writer);
            }
        }
    }
    return true;
}

void zemax_put_field(struct zemax_writer *writer, const struct figure *coordinate)
{
    const bool angle = writer->lens->field_kind == FIELD_ANGLE;
    struct figure figure = *coordinate;
    if (figure.typed.start == NULL && angle) {
        figure.value = pair_divide(figure.value, pair_of(RADIANS_PER_DEGREE));
    }
    growing_string(&writer->out, " ");
    if (figure.typed.start == NULL && figure.value.hi == 0) {
        growing_string(&writer->out, "0");
        return;
    }
    growing_figure(&writer->out, &figure, angle ? NUMBER_UNSCALED : writer->unit);
}

/* XFIE, YFIE, FLWT */
static bool put_fields_of_positions(struct zemax_writer *writer, struct error *error)
{
    static const char *const words[] = {"XFIE", "YFIE", "FLWT"};
    const struct lens *lens = writer->lens;
    for (size_t p = 0; p < lens->position_count; p++) {
        if (lens->points[p].count != lens->field_count) {
            return foreign_lose(writer->job, error,
                                "positions with more or fewer points of the field" LOSS_INSTEAD
                                "those of the first are kept");
        }
    }
    for (size_t i = 0; i < 3 * lens->field_count; i++) {
        for (size_t p = 0; p < lens->position_count; p++) {
            const struct lens_field *field = &lens->points[p].fields[i / 3];
            growing_format(&writer->out, "%s %zu %zu", words[i % 3], i / 3 + 1, p + 1);
            if (i % 3 == 2) {
                growing_string(&writer->out, " ");
                growing_number(&writer->out, field->weight);
            } else {
                zemax_put_field(writer, &field->at[i % 3]);
            }
            end_operand(writer);
        }
    }
    return true;
}

static bool zemax_write_positions_put_stops_and_waves(struct zemax_writer *writer,
                                                      struct error *error)
{
    const struct lens *lens = writer->lens;
    for (size_t p = 0; p < lens->position_count && lens->stops != NULL; p++) {
        growing_format(&writer->out, "STPS 0 %zu %zu", p + 1, writer->own_places[lens->stops[p]]);
        end_operand(writer);
    }
    return (lens->lights == NULL || put_waves_of_positions(writer, error)) &&
           (lens->points == NULL || put_fields_of_positions(writer, error));
}

/* The object's distance, distances, diameters and apertures of each position. */
bool zemax_put_positions(struct zemax_writer *writer, struct error *error)
{
    const struct lens *lens = writer->lens;
    size_t count = lens->position_count;
    growing_format(&writer->out, "MNUM %zu 1\r\n", count > 0 ? count : 1);
    for (size_t p = 0; p < count && lens->objects != NULL; p++) {
        growing_format(&writer->out, "THIC 0 %zu ", p + 1);
        if (isinf(lens->objects[p].value.hi)) {
            growing_string(&writer->out, "1e10");
        } else {
            growing_figure(&writer->out, &lens->objects[p], writer->unit);
        }
        end_operand(writer);
    }
    put_variables(writer);
    for (size_t p = 0; p < count && lens->apertures != NULL; p++) {
        growing_format(&writer->out, "APER 0 %zu ", p + 1);
        growing_figure(&writer->out, &lens->apertures[p],
                       lens->aperture_kind == APERTURE_EPD ? writer->unit : NUMBER_UNSCALED);
        end_operand(writer);
    }
    const bool done = zemax_write_positions_put_settings(writer, error) &&
                      zemax_write_positions_put_stops_and_waves(writer, error);
    if (count > 1) { /* a free line, behind which nothing is missing */
        growing_string(&writer->out, "MOFF 0 1 \"\" 0 0 0 1 1 0 0.0 \"\"\r\n");
    }
    return done;
}
