/* exchange/lens_json.c - a lens as JSON, for other programs and scripts. */
/* SPDX-License-Identifier: MIT */
#include "exchange/lens_json.h"

#include "base/constants.h"
#include "base/number.h"
#include "exchange/json_write.h"
#include "exchange/lens_json_design.h"
#include "exchange/writing.h"
#include "file/lens_setting.h"
#include "optics/aperture.h"

#include <math.h>
#include <string.h>

struct lens_json_writer {
    struct lens_writer out;
    const struct lens *lens;
    size_t positions;
};

static void lens_json_put(struct lens_json_writer *writer, const char *string)
{
    growing_text(&writer->out.text, text_of(string));
}

/* A number in mm or of no dimension, or an angle in degrees as it was typed. */
static void put_value(struct lens_json_writer *writer, const struct figure *figure, double unit)
{
    struct pair value = figure->value;
    if (unit != 1 && figure->typed.start != NULL) {
        text_pair(figure->typed, NUMBER_UNSCALED, &value);
    } else if (unit != 1) {
        value = pair_divide(value, pair_of(unit));
    }
    json_put_pair(&writer->out.text, value);
}

/* One number a position as an array; a number alone where they are all the same figure. */
static void lens_json_put_values(struct lens_json_writer *writer, const struct figure *values,
                                 size_t count, double unit)
{
    lens_json_put(writer, "[");
    for (size_t i = 0; i < count; i++) {
        lens_json_put(writer, i > 0 ? "," : "");
        put_value(writer, &values[i], unit);
    }
    lens_json_put(writer, "]");
}

static void lens_json_put_figure(struct lens_json_writer *writer, const struct figure *figure,
                                 double unit)
{
    if (figure->variable == LENS_NONE || writer->positions == 0) {
        put_value(writer, figure, unit);
    } else {
        lens_json_put_values(writer, writer->lens->variables[figure->variable].values,
                             writer->positions, unit);
    }
}

/* ,"key": */
static void put_key(struct lens_json_writer *writer, const char *key)
{
    growing_format(&writer->out.text, ",\"%s\":", key);
}

static void put_optional(struct lens_json_writer *writer, const char *key, bool given,
                         const struct figure *figure)
{
    put_key(writer, key);
    if (given) {
        lens_json_put_figure(writer, figure, 1);
    } else {
        lens_json_put(writer, "null");
    }
}

/* Shifts the decimal point of the shortest digits, so that 0.5875618 um is 587.5618 nm. */
static double nanometres(double micrometres)
{
    char text[NUMBER_LENGTH];
    double value = 1000 * micrometres;
    number_read(text, number_write_shortest(text, micrometres), (struct number_scale){1, 3},
                &value);
    return value;
}

static void lens_json_put_waves(struct lens_json_writer *writer)
{
    const struct lens *lens = writer->lens;
    put_key(writer, "unit");
    json_put_string(&writer->out.text, lens->unit);
    put_key(writer, "wavelengths");
    lens_json_put(writer, "[");
    for (size_t i = 0; i < lens->wavelength_count; i++) {
        const struct lens_wavelength *one = &lens->wavelengths[i];
        lens_json_put(writer, i > 0 ? ",{\"name\":" : "{\"name\":");
        json_put_text(&writer->out.text, one->typed);
        lens_json_put(writer, ",\"wavelength_nm\":");
        json_put_number(&writer->out.text, nanometres(one->wavelength));
        lens_json_put(writer, ",\"weight\":");
        json_put_number(&writer->out.text, one->weight);
        lens_json_put(writer, "}");
    }
    lens_json_put(writer, "]");
}

static void lens_json_put_object(struct lens_json_writer *writer)
{
    const struct lens *lens = writer->lens;
    put_key(writer, "object_mm");
    if (lens->objects != NULL) {
        lens_json_put_values(writer, lens->objects, writer->positions, 1);
    } else {
        json_put_pair(&writer->out.text,
                      lens->object_is_infinite ? pair_of(INFINITY) : lens->object.value);
    }
    put_key(writer, "object_is_infinite");
    if (lens->objects != NULL) {
        for (size_t i = 0; i < writer->positions; i++) {
            lens_json_put(writer, i == 0 ? "[" : ",");
            lens_json_put(writer, isinf(lens->objects[i].value.hi) ? "true" : "false");
        }
        lens_json_put(writer, "]");
    } else {
        lens_json_put(writer, lens->object_is_infinite ? "true" : "false");
    }
    lens_json_put(writer, lens->is_telecentric ? ",\"object_is_telecentric\":true" : "");
    put_key(writer, "object_medium");
    json_put_text(&writer->out.text, lens->object_medium.written);
}

/* Their y; x and weight where some is not 0 and 1. */
static void lens_json_put_fields(struct lens_json_writer *writer)
{
    static const char *const kinds[] = {[FIELD_NONE] = "null",
                                        [FIELD_ANGLE] = "\"angle_deg\"",
                                        [FIELD_HEIGHT] = "\"height_mm\"",
                                        [FIELD_IMAGE] = "\"image_mm\"",
                                        [FIELD_REAL] = "\"real_mm\""};
    const struct lens *lens = writer->lens;
    const double unit = lens->field_kind == FIELD_ANGLE ? RADIANS_PER_DEGREE : 1;
    const bool beside = lens_has_fields_beside(lens);
    bool weighted = false;
    for (size_t i = 0; i < lens->field_count; i++) {
        weighted = weighted || lens->fields[i].weight != 1;
    }
    put_key(writer, "field_kind");
    lens_json_put(writer, kinds[lens->field_kind]);
    put_key(writer, "fields");
    lens_json_put(writer, "[");
    for (size_t i = 0; i < lens->field_count; i++) {
        lens_json_put(writer, i > 0 ? "," : "");
        put_value(writer, &lens->fields[i].at[1], unit);
    }
    lens_json_put(writer, beside ? "],\"fields_x\":[" : "");
    for (size_t i = 0; i < lens->field_count && beside; i++) {
        lens_json_put(writer, i > 0 ? "," : "");
        put_value(writer, &lens->fields[i].at[0], unit);
    }
    lens_json_put(writer, weighted ? "],\"field_weights\":[" : "");
    for (size_t i = 0; i < lens->field_count && weighted; i++) {
        lens_json_put(writer, i > 0 ? "," : "");
        json_put_number(&writer->out.text, lens->fields[i].weight);
    }
    lens_json_put(writer, "]");
}

static void put_use(struct lens_json_writer *writer)
{
    static const char *const apertures[] = {"null", "\"stop\"", "\"fnumber\"", "\"epd_mm\"",
                                            "\"na\""};
    static const char *const focuses[] = {"\"paraxial\"", "\"table\"", "\"best\"", "\"afocal\""};
    const struct lens *lens = writer->lens;
    lens_json_put_fields(writer);
    put_key(writer, "aperture_kind");
    lens_json_put(writer, apertures[lens->aperture_kind]);
    put_key(writer, "aperture");
    if (lens->aperture_kind <= APERTURE_STOP) {
        lens_json_put(writer, "null");
    } else if (lens->apertures != NULL) {
        lens_json_put_values(writer, lens->apertures, writer->positions, 1);
    } else {
        json_put_pair(&writer->out.text, lens->aperture.value);
    }
    put_key(writer, "focus");
    lens_json_put(writer, focuses[lens->focus]);
}

static void put_stated(struct lens_json_writer *writer)
{
    static const char *const keys[] = {"stated_efl_mm", "stated_bfl_mm", "stated_fnumber",
                                       "stated_tstop"};
    const struct lens *lens = writer->lens;
    for (int i = 0; i < STATED_COUNT; i++) {
        put_key(writer, keys[i]);
        lens_json_put_values(writer, lens->stated[i], lens->stated_count[i], 1);
    }
}

static void lens_json_put_displacement(struct lens_json_writer *writer, const char *key,
                                       const struct displacement *displacement)
{
    if (displacement != NULL) {
        put_key(writer, key);
        lens_json_put(writer, "{\"decenter_mm\":");
        lens_json_put_values(writer, displacement->decenter, 2, 1);
        lens_json_put(writer, ",\"tilt_deg\":");
        lens_json_put_values(writer, displacement->tilt, 3, RADIANS_PER_DEGREE);
        lens_json_put(writer, "}");
    }
}

static void lens_json_put_coefficients(struct lens_json_writer *writer,
                                       const struct surface *surface)
{
    const char *before = "{";
    if (surface->coefficients == 0) {
        return;
    }
    put_key(writer, "coefficients_mm");
    for (int order = 1; order <= LENS_COEFFICIENTS; order++) {
        const enum parameter_kind kind = PARAMETER_COEFFICIENT;
        const struct figure *figure = parameter_figure(surface, kind, order);
        if (figure != NULL) {
            growing_format(&writer->out.text, "%s\"%s\":", before,
                           parameter_name(kind, order, writer->out.text.arena));
            lens_json_put_figure(writer, figure, 1);
            before = ",";
        }
    }
    lens_json_put(writer, "}");
}

/* One more mark; bounds in mm, 1/mm .., null is none. */
static void put_vary(struct lens_json_writer *writer, enum parameter_kind kind,
                     const struct vary *vary, const char *position, size_t *count)
{
    bool angle = (parameter_type(kind)->is & PARAMETER_IS_ANGLE) != 0;
    double unit = angle ? RADIANS_PER_DEGREE : 1;
    if (*count == 0) {
        put_key(writer, "vary");
    }
    lens_json_put(writer, (*count)++ == 0 ? "[{\"what\":" : ",{\"what\":");
    json_put_string(&writer->out.text,
                    parameter_mark_name(kind, vary->order, writer->out.text.arena));
    if (position != NULL) {
        put_key(writer, "position");
        json_put_string(&writer->out.text, position);
    }
    if (vary->has_bounds) {
        put_key(writer, "low");
        put_value(writer, &vary->low, unit);
        put_key(writer, "high");
        put_value(writer, &vary->high, unit);
    }
    lens_json_put(writer, "}");
}

/* What the designer may change: of the surface, and in the positions. */
static void put_varies(struct lens_json_writer *writer, const struct surface *surface)
{
    static const enum parameter_kind cells[] = {PARAMETER_THICKNESS, PARAMETER_FOCAL};
    const struct lens *lens = writer->lens;
    size_t count = 0;
    for (size_t i = 0; i < surface->vary_count; i++) {
        put_vary(writer, surface->varies[i].kind, &surface->varies[i], NULL, &count);
    }
    for (size_t i = 0; i < sizeof cells / sizeof cells[0]; i++) {
        const struct figure *cell = parameter_figure(surface, cells[i], 0);
        const struct vary *const *marks = cell != NULL && cell->variable != LENS_NONE
                                              ? lens->variables[cell->variable].varies
                                              : NULL;
        for (size_t p = 0; p < writer->positions && marks != NULL; p++) {
            if (marks[p] != NULL) {
                put_vary(writer, cells[i], marks[p], lens->positions[p], &count);
            }
        }
    }
    lens_json_put(writer, count > 0 ? "]" : "");
}

static bool lens_json_put_medium(struct lens_json_writer *writer, const struct surface *surface,
                                 struct error *error)
{
    const struct lens *lens = writer->lens;
    size_t waves = lens->wavelength_count > 0 ? lens->wavelength_count : 1;
    put_key(writer, "medium");
    if (surface_reflects(surface)) {
        lens_json_put(writer, "\"mirror\"");
        return true;
    }
    json_put_text(&writer->out.text, surface->medium.written);
    put_key(writer, "index");
    for (size_t i = 0; i < waves; i++) {
        struct pair index;
        double wavelength = lens->wavelength_count > 0 ? lens->wavelengths[i].wavelength
                                                       : lens_primary_wavelength(lens);
        if (!medium_index(&surface->medium, wavelength, &index, error)) {
            return false;
        }
        lens_json_put(writer, i == 0 ? "[" : ",");
        json_put_number(&writer->out.text, index.hi);
    }
    lens_json_put(writer, "]");
    return true;
}

/* What only a thick lens has. */
static void lens_json_put_thick(struct lens_json_writer *writer, const struct surface *surface)
{
    if (!surface_has(surface, SURFACE_HAS_FOCAL)) {
        return;
    }
    put_optional(writer, "focal_mm", true, &surface->focal);
    put_optional(writer, "hiatus_mm", true, &surface->hiatus);
    put_key(writer, "distortion");
    for (int i = 0; i < 3; i++) {
        lens_json_put(writer, i == 0 ? "[" : ",");
        json_put_number(&writer->out.text, surface->distortion[i].value.hi);
    }
    lens_json_put(writer, "]");
}

static void lens_json_put_aperture(struct lens_json_writer *writer, const struct aperture *aperture)
{
    const struct aperture_traits *traits = &aperture_shapes[aperture->shape];
    lens_json_put(writer, "{\"shape\":");
    json_put_string(&writer->out.text, traits->word);
    put_key(writer, "blocks");
    lens_json_put(writer, aperture->blocks ? "true" : "false");
    put_key(writer, "size_mm");
    lens_json_put_values(writer, aperture->size, (size_t)aperture_sizes(aperture->shape), 1);
    if (traits->has_arms) {
        growing_format(&writer->out.text, ",\"arms\":%u", aperture->arms);
    }
    for (size_t i = 0; i < aperture->point_count; i++) {
        lens_json_put(writer, i == 0 ? ",\"points_mm\":[" : ",");
        lens_json_put_values(writer, aperture->points[i], 2, 1);
    }
    lens_json_put(writer, aperture->point_count > 0 ? "]" : "");
    put_key(writer, "decenter_mm");
    lens_json_put_values(writer, aperture->decenter, 2, 1);
    put_key(writer, "turn_deg");
    put_value(writer, &aperture->turn, RADIANS_PER_DEGREE);
    lens_json_put(writer, "}");
}

static void lens_json_put_apertures(struct lens_json_writer *writer, const struct surface *surface)
{
    if (surface->aperture_count == 0) {
        return;
    }
    put_key(writer, "apertures");
    for (size_t i = 0; i < surface->aperture_count; i++) {
        lens_json_put(writer, i == 0 ? "[" : ",");
        lens_json_put_aperture(writer, &surface->apertures[i]);
    }
    lens_json_put(writer, "]");
}

static bool lens_json_put_surface(struct lens_json_writer *writer, size_t i, struct error *error)
{
    const struct surface *surface = &writer->lens->surfaces[i];
    bool is_plane = surface->is_plane && !surface->has_curvature;
    growing_format(&writer->out.text, "%s\n{\"surface\":%zu,\"kind\":\"%s\",\"is_stop\":%s",
                   i > 0 ? "," : "", i + 1, surface_traits(surface)->key,
                   surface->is_stop ? "true" : "false");
    put_key(writer, "name");
    json_put_string(&writer->out.text, surface->name);
    put_optional(writer, "radius_mm", !is_plane && !surface->has_curvature, &surface->radius);
    put_key(writer, "radius_is_infinite");
    lens_json_put(writer, is_plane ? "true" : "false");
    if (surface->has_curvature) {
        put_optional(writer, "curvature_per_mm", true, &surface->curvature);
    }
    put_optional(writer, "thickness_mm", surface->has_thickness, &surface->thickness);
    if (!lens_json_put_medium(writer, surface, error)) {
        return false;
    }
    put_optional(writer, "diameter_mm", surface->has_diameter, &surface->diameter);
    put_optional(writer, "conic", true, &surface->conic);
    lens_json_put_coefficients(writer, surface);
    lens_json_put_thick(writer, surface);
    if (!surface_is_round(surface)) {
        put_key(writer, "cylinder");
        json_put_string(&writer->out.text, surface_section(surface)->key);
    }
    lens_json_put_displacement(writer, "moved", surface->decentre);
    lens_json_put_displacement(writer, "bend_before", surface->coordinate_break);
    lens_json_put_apertures(writer, surface);
    put_varies(writer, surface);
    lens_json_put(writer, "}");
    return true;
}

static void put_strings(struct lens_json_writer *writer, const char *key,
                        const char *const *strings, size_t count)
{
    put_key(writer, key);
    lens_json_put(writer, "[");
    for (size_t i = 0; i < count; i++) {
        lens_json_put(writer, i > 0 ? "," : "");
        json_put_string(&writer->out.text, strings[i]);
    }
    lens_json_put(writer, "]");
}

/* {"name":"R3","values":[...]}, as the lines with `set` of a .lens file; null is a plane's R. */
static void put_setting_values(struct lens_json_writer *writer, const struct lens_setting *one)
{
    const struct parameter parameter = one->parameter;
    bool angle = (parameter_type(parameter.kind)->is & PARAMETER_IS_ANGLE) != 0;
    for (size_t p = 0; p < writer->positions; p++) {
        lens_json_put(writer, p > 0 ? "," : "");
        if (one->media != NULL) {
            json_put_text(&writer->out.text, one->media[p].written);
        } else {
            put_value(writer, &one->figures[p], angle ? RADIANS_PER_DEGREE : 1);
        }
    }
}

/* "0;2,5:0.5", in degrees or mm, behind the quote that begins it. */
static void lens_json_put_points(struct lens_json_writer *writer, const struct lens_points *points,
                                 const char *begin)
{
    const double unit = writer->lens->field_kind == FIELD_ANGLE ? RADIANS_PER_DEGREE : 1;
    for (size_t i = 0; i < points->count; i++) {
        const struct lens_field *field = &points->fields[i];
        lens_json_put(writer, i == 0 ? begin : ";");
        if (field->at[0].value.hi != 0) {
            put_value(writer, &field->at[0], unit);
            lens_json_put(writer, ",");
        }
        put_value(writer, &field->at[1], unit);
        if (field->weight != 1) {
            lens_json_put(writer, ":");
            json_put_number(&writer->out.text, field->weight);
        }
    }
    lens_json_put(writer, "\"");
}

static void lens_json_put_settings(struct lens_json_writer *writer, struct arena *arena)
{
    const struct lens *lens = writer->lens;
    const char *between = "";
    put_key(writer, "settings");
    lens_json_put(writer, "[");
    for (size_t i = 0; i < lens->setting_count; i++) {
        const struct lens_setting *one = &lens->settings[i];
        growing_format(&writer->out.text, "%s{\"name\":\"%s\",\"values\":[", between,
                       parameter_write(one->parameter, arena));
        put_setting_values(writer, one);
        lens_json_put(writer, "]}");
        between = ",";
    }
    if (lens->stops != NULL) {
        growing_format(&writer->out.text, "%s{\"name\":\"stop\",\"values\":[", between);
        for (size_t p = 0; p < writer->positions; p++) {
            growing_format(&writer->out.text, "%s%zu", p > 0 ? "," : "", lens->stops[p] + 1);
        }
        lens_json_put(writer, "]}");
        between = ",";
    }
    if (lens->lights != NULL) {
        growing_format(&writer->out.text, "%s{\"name\":\"wavelength\",\"values\":[", between);
        for (size_t p = 0; p < writer->positions; p++) {
            lens_json_put(writer, p > 0 ? "," : "");
            json_put_string(&writer->out.text, lens_light_write(&lens->lights[p], arena));
        }
        lens_json_put(writer, "]}");
        between = ",";
    }
    if (lens->points != NULL) {
        growing_format(&writer->out.text, "%s{\"name\":\"field\",\"values\":[", between);
        for (size_t p = 0; p < writer->positions; p++) {
            lens_json_put_points(writer, &lens->points[p], p > 0 ? ",\"" : "\"");
        }
        lens_json_put(writer, "]}");
    }
    lens_json_put(writer, "]");
}

static void lens_json_put_header(struct lens_json_writer *writer)
{
    const struct lens *lens = writer->lens;
    lens_json_put(writer, "{\"lens\":");
    json_put_string(&writer->out.text, lens->title);
    put_key(writer, "source");
    json_put_string(&writer->out.text, lens->source);
    put_key(writer, "kind");
    json_put_string(&writer->out.text, lens->kind);
    put_strings(writer, "notes", lens->notes, lens->note_count);
    put_strings(writer, "positions", lens->positions, lens->position_count);
    lens_json_put(writer, "\n");
    lens_json_put_waves(writer);
    lens_json_put_object(writer);
    put_use(writer);
    put_key(writer, "stop_surface");
    if (lens->stop == LENS_NONE) {
        lens_json_put(writer, "null");
    } else {
        growing_format(&writer->out.text, "%zu", lens->stop + 1);
    }
    put_stated(writer);
}

/* In JSON each cell has numbers of its own: a marked word in two of them would vary twice. */
static bool check_words(const struct lens *lens, struct error *error)
{
    for (size_t i = 0; i < lens->variable_count; i++) {
        const struct lens_variable *word = &lens->variables[i];
        size_t cells = 0;
        for (size_t k = 0; k < lens->surface_count && word->varies != NULL; k++) {
            const struct figure *gap = parameter_figure(&lens->surfaces[k], PARAMETER_THICKNESS, 0);
            const struct figure *focal = parameter_figure(&lens->surfaces[k], PARAMETER_FOCAL, 0);
            cells += gap != NULL && gap->variable == i ? 1 : 0;
            cells += focal != NULL && focal->variable == i ? 1 : 0;
        }
        if (cells > 1) {
            return fail(
                error, ERROR_DATA,
                "%.*s is marked and stands in %zu places: JSON has no words, and each would "
                "vary by itself",
                text_shown(word->name), word->name.start, cells);
        }
    }
    return true;
}

static bool write_json(struct foreign_job *job, const struct lens *lens, struct text *text,
                       struct error *error)
{
    struct lens_json_writer writer = {.lens = lens, .positions = lens->position_count};
    if (!check_words(lens, error)) {
        return false;
    }
    writing_begin(&writer.out, job, lens, true);
    lens_json_put_header(&writer);
    if (lens->setting_count > 0 || lens->stops != NULL || lens->lights != NULL ||
        lens->points != NULL) {
        lens_json_put_settings(&writer, job->arena);
    }
    json_put_design(&writer.out.text, lens, job->arena);
    lens_json_put(&writer, "\n,\"surfaces\":[");
    for (size_t i = 0; i < lens->surface_count; i++) {
        if (!lens_json_put_surface(&writer, i, error)) {
            return error_prefix(error, "surface %zu: ", i + 1);
        }
    }
    lens_json_put(&writer, "\n]}\n");
    *text = growing_done(&writer.out.text);
    return true;
}

static bool lens_json_is_like(struct text content)
{
    size_t i = 0;
    while (i < content.length && strchr(" \t\r\n", content.start[i]) != NULL &&
           content.start[i] != '\0') {
        i++;
    }
    return i < content.length && content.start[i] == '{';
}

const struct foreign_format lens_json_format = {
    .type = {{"json", "JSON, for other programs"}, ".json"},
    .is_like = lens_json_is_like,
    .read = lens_json_read,
    .write = write_json,
    .has_thick = true,
    .has_settings = true,
    .has_design = true,
    .has_apertures = true,
};
