/* exchange/lens_json.c - a lens as JSON, for other programs and scripts. */
/* SPDX-License-Identifier: MIT */
#include "exchange/lens_json.h"

#include "base/constants.h"
#include "base/number.h"
#include "exchange/writing.h"
#include "file/lens_change.h"
#include "file/lens_pickup.h"
#include "file/lens_setting.h"
#include "file/lens_tolerance.h"
#include "optics/aperture.h"

#include <math.h>
#include <string.h>

/* In quotes, escaped; what is no UTF-8 becomes the replacement character. A null one is null. */
static const char *json_of_text(struct arena *arena, struct text text)
{
    struct text_buffer to = {.arena = arena};
    growing_string(&to, "\"");
    for (size_t i = 0; i < text.length;) {
        const unsigned char *at = (const unsigned char *)text.start + i;
        size_t length = text_utf8_length(text.start + i, text.length - i);
        if (length == 0) {
            growing_string(&to, "\xef\xbf\xbd"); /* the replacement character */
        } else if (*at == '"' || *at == '\\') {
            growing_format(&to, "\\%c", *at);
        } else if (*at < 0x20) {
            growing_format(&to, "\\u%04x", *at);
        } else {
            growing_text(&to, (struct text){text.start + i, length});
        }
        i += length > 0 ? length : 1;
    }
    growing_put(&to, "\"", sizeof "\"");
    return to.data;
}

static const char *json_of_string(struct arena *arena, const char *string)
{
    return string != NULL ? json_of_text(arena, text_of(string)) : "null";
}

/* With the shortest digits that read back to the same bits; null where it is not finite. */
static const char *json_of_number(struct arena *arena, double value)
{
    char text[NUMBER_LENGTH];
    return isfinite(value)
               ? arena_string(arena, text, (size_t)(number_write_shortest(text, value) - text))
               : "null";
}

/* All digits that a pair has: what is read again has the same bits. */
static const char *json_of_pair(struct arena *arena, struct pair value)
{
    char text[PAIR_LENGTH];
    if (!isfinite(value.hi)) {
        return "null";
    }
    return arena_string(arena, text,
                        (size_t)(pair_write_shortest(text, value, NUMBER_UNSCALED) - text));
}

static const char *json_bool(bool value)
{
    return value ? "true" : "false";
}

/* A number in mm or of no dimension, or an angle in degrees as it was typed. */
static const char *json_value(const struct lens_writer *writing, const struct figure *figure,
                              double unit)
{
    struct pair value = figure->value;
    if (unit != 1 && figure->typed.start != NULL) {
        text_pair(figure->typed, NUMBER_UNSCALED, &value);
    } else if (unit != 1) {
        value = pair_divide(value, pair_of(unit));
    }
    return json_of_pair(writing->arena, value);
}

/* One number a position, or several of a surface. */
static const char *json_values(const struct lens_writer *writing, const struct figure *values,
                               size_t count, double unit)
{
    struct text_buffer list = {.arena = writing->arena};
    for (size_t i = 0; i < count; i++) {
        growing_format(&list, "%s%s", i > 0 ? "," : "[", json_value(writing, &values[i], unit));
    }
    growing_format(&list, count > 0 ? "]" : "[]");
    return arena_string(list.arena, list.data, list.length);
}

/* A number alone, or one a position. */
static const char *json_figure(const struct lens_writer *writing, const struct figure *figure)
{
    const struct lens *lens = writing->lens;
    return figure->variable == LENS_NONE || lens->position_count == 0
               ? json_value(writing, figure, 1)
               : json_values(writing, lens->variables[figure->variable].values,
                             lens->position_count, 1);
}

static void json_put_optional(struct lens_writer *writing, const char *key, bool given,
                              const struct figure *figure)
{
    writing_put(writing, ",\"%s\":%s", key, given ? json_figure(writing, figure) : "null");
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

/* The x or y of all fields. */
static void json_put_axis(struct lens_writer *writing, const char *key, int axis)
{
    const struct lens *lens = writing->lens;
    const double unit = lens->field_kind == FIELD_ANGLE ? RADIANS_PER_DEGREE : 1;
    writing_put(writing, ",\"%s\":[", key);
    for (size_t i = 0; i < lens->field_count; i++) {
        writing_put(writing, "%s%s", i > 0 ? "," : "",
                    json_value(writing, &lens->fields[i].at[axis], unit));
    }
    writing_put(writing, "]");
}

/* Their y; x and weight where some is not 0 and 1. */
static void json_put_fields(struct lens_writer *writing)
{
    static const char *const kinds[] = {[FIELD_NONE] = "null",
                                        [FIELD_ANGLE] = "\"angle_deg\"",
                                        [FIELD_HEIGHT] = "\"height_mm\"",
                                        [FIELD_IMAGE] = "\"image_mm\"",
                                        [FIELD_REAL] = "\"real_mm\""};
    const struct lens *lens = writing->lens;
    bool weighted = false;
    for (size_t i = 0; i < lens->field_count; i++) {
        weighted = weighted || lens->fields[i].weight != 1;
    }
    writing_put(writing, ",\"field_kind\":%s", kinds[lens->field_kind]);
    json_put_axis(writing, "fields", 1);
    if (lens_has_fields_beside(lens)) {
        json_put_axis(writing, "fields_x", 0);
    }
    for (size_t i = 0; i < lens->field_count && weighted; i++) {
        writing_put(writing, "%s%s", i > 0 ? "," : ",\"field_weights\":[",
                    json_of_number(writing->arena, lens->fields[i].weight));
    }
    growing_string(&writing->text, weighted ? "]" : "");
}

static void json_put_use(struct lens_writer *writing)
{
    static const char *const apertures[] = {"null", "\"stop\"", "\"fnumber\"", "\"epd_mm\"",
                                            "\"na\""};
    static const char *const focuses[] = {"paraxial", "table", "best", "afocal"};
    const struct lens *lens = writing->lens;
    const char *aperture = "null";
    if (lens->aperture_kind > APERTURE_STOP) {
        aperture = lens->apertures != NULL
                       ? json_values(writing, lens->apertures, lens->position_count, 1)
                       : json_of_pair(writing->arena, lens->aperture.value);
    }
    json_put_fields(writing);
    writing_put(writing, ",\"aperture_kind\":%s,\"aperture\":%s,\"focus\":\"%s\"",
                apertures[lens->aperture_kind], aperture, focuses[lens->focus]);
    writing_put(writing, "%s",
                lens->stop_is_real && lens->aperture_kind > APERTURE_STOP ? ",\"stop_is_real\":true"
                                                                          : "");
}

static void json_put_turns(struct lens_writer *writing, const char *key,
                           const struct displacement *displacement)
{
    if (displacement != NULL) {
        writing_put(writing, ",\"%s\":{\"decenter_mm\":%s,\"tilt_deg\":%s}", key,
                    json_values(writing, displacement->decenter, 2, 1),
                    json_values(writing, displacement->tilt, 3, RADIANS_PER_DEGREE));
    }
}

/* One more mark; bounds in mm, 1/mm .., null is none. */
static void json_put_vary(struct lens_writer *writing, enum parameter_kind kind,
                          const struct vary *vary, const char *position, size_t *count)
{
    struct arena *arena = writing->arena;
    double unit = (parameter_type(kind)->is & PARAMETER_IS_ANGLE) != 0 ? RADIANS_PER_DEGREE : 1;
    writing_put(writing, "%s{\"what\":%s", (*count)++ == 0 ? ",\"vary\":[" : ",",
                json_of_string(arena, parameter_mark_name(kind, vary->order, arena)));
    if (position != NULL) {
        writing_put(writing, ",\"position\":%s", json_of_string(arena, position));
    }
    if (vary->has_bounds) {
        writing_put(writing, ",\"low\":%s,\"high\":%s", json_value(writing, &vary->low, unit),
                    json_value(writing, &vary->high, unit));
    }
    writing_put(writing, "}");
}

/* What the designer may change: of the surface, and in the positions. */
static void json_put_varies(struct lens_writer *writing, const struct surface *surface)
{
    static const enum parameter_kind cells[] = {PARAMETER_THICKNESS, PARAMETER_FOCAL};
    const struct lens *lens = writing->lens;
    size_t count = 0;
    for (size_t i = 0; i < surface->vary_count; i++) {
        json_put_vary(writing, surface->varies[i].kind, &surface->varies[i], NULL, &count);
    }
    for (size_t i = 0; i < sizeof cells / sizeof cells[0]; i++) {
        const struct figure *cell = parameter_figure(surface, cells[i], 0);
        const struct vary *const *marks = cell != NULL && cell->variable != LENS_NONE
                                              ? lens->variables[cell->variable].varies
                                              : NULL;
        for (size_t p = 0; p < lens->position_count && marks != NULL; p++) {
            if (marks[p] != NULL) {
                json_put_vary(writing, cells[i], marks[p], lens->positions[p], &count);
            }
        }
    }
    growing_string(&writing->text, count > 0 ? "]" : "");
}

static bool json_put_medium(struct lens_writer *writing, const struct surface *surface,
                            struct error *error)
{
    const struct lens *lens = writing->lens;
    size_t waves = lens->wavelength_count > 0 ? lens->wavelength_count : 1;
    if (surface_reflects(surface)) {
        writing_put(writing, ",\"medium\":\"mirror\"");
        return true;
    }
    writing_put(writing,
                ",\"medium\":%s,\"index\":", json_of_text(writing->arena, surface->medium.written));
    for (size_t i = 0; i < waves; i++) {
        struct pair index;
        double wavelength = lens->wavelength_count > 0 ? lens->wavelengths[i].wavelength
                                                       : lens_primary_wavelength(lens);
        if (!medium_index(&surface->medium, wavelength, &index, error)) {
            return false;
        }
        writing_put(writing, "%s%s", i == 0 ? "[" : ",", json_of_number(writing->arena, index.hi));
    }
    writing_put(writing, "]");
    return true;
}

static void json_put_aperture(struct lens_writer *writing, const struct aperture *aperture)
{
    const struct aperture_traits *traits = &aperture_shapes[aperture->shape];
    writing_put(writing, "{\"shape\":%s,\"blocks\":%s,\"size_mm\":%s",
                json_of_string(writing->arena, traits->word), json_bool(aperture->blocks),
                json_values(writing, aperture->size, (size_t)aperture_sizes(aperture->shape), 1));
    if (traits->has_arms) {
        writing_put(writing, ",\"arms\":%u", aperture->arms);
    }
    for (size_t i = 0; i < aperture->point_count; i++) {
        writing_put(writing, "%s%s", i == 0 ? ",\"points_mm\":[" : ",",
                    json_values(writing, aperture->points[i], 2, 1));
    }
    writing_put(writing, "%s,\"decenter_mm\":%s,\"turn_deg\":%s}",
                aperture->point_count > 0 ? "]" : "",
                json_values(writing, aperture->decenter, 2, 1),
                json_value(writing, &aperture->turn, RADIANS_PER_DEGREE));
}

static void json_put_coefficients(struct lens_writer *writing, const struct surface *surface)
{
    const enum parameter_kind kind = PARAMETER_COEFFICIENT;
    const char *before = ",\"coefficients_mm\":{";
    for (int order = 1; order <= LENS_COEFFICIENTS && surface->coefficients != 0; order++) {
        const struct figure *figure = parameter_figure(surface, kind, order);
        if (figure != NULL) {
            writing_put(writing, "%s\"%s\":%s", before, parameter_name(kind, order, writing->arena),
                        json_figure(writing, figure));
            before = ",";
        }
    }
    growing_string(&writing->text, surface->coefficients != 0 ? "}" : "");
}

static bool json_put_surface(struct lens_writer *writing, size_t i, struct error *error)
{
    const struct surface *surface = &writing->lens->surfaces[i];
    bool is_plane = surface->is_plane && !surface->has_curvature;
    writing_put(writing, "%s\n{\"surface\":%zu,\"kind\":\"%s\",\"is_stop\":%s,\"name\":%s",
                i > 0 ? "," : "", i + 1, surface_traits(surface)->key, json_bool(surface->is_stop),
                json_of_string(writing->arena, surface->name));
    json_put_optional(writing, "radius_mm", !is_plane && !surface->has_curvature, &surface->radius);
    writing_put(writing, ",\"radius_is_infinite\":%s", json_bool(is_plane));
    if (surface->has_curvature) {
        json_put_optional(writing, "curvature_per_mm", true, &surface->curvature);
    }
    json_put_optional(writing, "thickness_mm", surface->has_thickness, &surface->thickness);
    if (!json_put_medium(writing, surface, error)) {
        return false;
    }
    json_put_optional(writing, "diameter_mm", surface->has_diameter, &surface->diameter);
    json_put_optional(writing, "conic", true, &surface->conic);
    json_put_coefficients(writing, surface);
    /* What only a thick lens has. */
    if (surface_has(surface, SURFACE_HAS_FOCAL)) {
        json_put_optional(writing, "focal_mm", true, &surface->focal);
        json_put_optional(writing, "hiatus_mm", true, &surface->hiatus);
        for (int j = 0; j < 3; j++) {
            writing_put(writing, "%s%s", j == 0 ? ",\"distortion\":[" : ",",
                        json_of_number(writing->arena, surface->distortion[j].value.hi));
        }
        writing_put(writing, "]");
    }
    if (!surface_is_round(surface)) {
        writing_put(writing, ",\"cylinder\":%s",
                    json_of_string(writing->arena, surface_section(surface)->key));
    }
    json_put_turns(writing, "moved", surface->decentre);
    json_put_turns(writing, "bend_before", surface->coordinate_break);
    for (size_t k = 0; k < surface->aperture_count; k++) {
        growing_string(&writing->text, k == 0 ? ",\"apertures\":[" : ",");
        json_put_aperture(writing, &surface->apertures[k]);
    }
    growing_string(&writing->text, surface->aperture_count > 0 ? "]" : "");
    json_put_varies(writing, surface);
    writing_put(writing, "}");
    return true;
}

static void json_put_strings(struct lens_writer *writing, const char *key,
                             const char *const *strings, size_t count)
{
    writing_put(writing, ",\"%s\":[", key);
    for (size_t i = 0; i < count; i++) {
        writing_put(writing, "%s%s", i > 0 ? "," : "", json_of_string(writing->arena, strings[i]));
    }
    writing_put(writing, "]");
}

/* "0;2,5:0.5", in degrees or mm. */
static const char *json_points(const struct lens_writer *writing, const struct lens_points *points)
{
    const double unit = writing->lens->field_kind == FIELD_ANGLE ? RADIANS_PER_DEGREE : 1;
    struct text_buffer list = {.arena = writing->arena};
    for (size_t i = 0; i < points->count; i++) {
        const struct lens_field *field = &points->fields[i];
        growing_string(&list, i == 0 ? "\"" : ";");
        if (field->at[0].value.hi != 0) {
            growing_format(&list, "%s,", json_value(writing, &field->at[0], unit));
        }
        growing_string(&list, json_value(writing, &field->at[1], unit));
        if (field->weight != 1) {
            growing_format(&list, ":%s", json_of_number(writing->arena, field->weight));
        }
    }
    growing_string(&list, "\"");
    return arena_string(list.arena, list.data, list.length);
}

/* What a position sets: a number, a medium, or a stop, light or fields. */
static const char *json_set_value(const struct lens_writer *writing, const char *what,
                                  const struct lens_setting *one, size_t position)
{
    const struct lens *lens = writing->lens;
    struct arena *arena = writing->arena;
    if (one != NULL && one->media != NULL) {
        return json_of_text(arena, one->media[position].written);
    }
    if (one != NULL) {
        bool angle = (parameter_type(one->parameter.kind)->is & PARAMETER_IS_ANGLE) != 0;
        return json_value(writing, &one->figures[position], angle ? RADIANS_PER_DEGREE : 1);
    }
    if (strcmp(what, "stop") == 0) {
        return arena_printf(arena, "%zu", lens->stops[position] + 1);
    }
    return strcmp(what, "wavelength") == 0
               ? json_of_string(arena, lens_light_write(&lens->lights[position], arena))
               : json_points(writing, &lens->points[position]);
}

/* {"name":"R3","values":[...]}, as the lines with `set` of a .lens file; null is a plane's R. */
static void json_put_setting(struct lens_writer *writing, const char *what,
                             const struct lens_setting *one, const char **between)
{
    writing_put(writing, "%s{\"name\":\"%s\",\"values\":[", *between, what);
    for (size_t p = 0; p < writing->lens->position_count; p++) {
        writing_put(writing, "%s%s", p > 0 ? "," : "", json_set_value(writing, what, one, p));
    }
    writing_put(writing, "]}");
    *between = ",";
}

static void json_put_settings(struct lens_writer *writing)
{
    const struct lens *lens = writing->lens;
    const char *between = "";
    writing_put(writing, ",\"settings\":[");
    for (size_t i = 0; i < lens->setting_count; i++) {
        const struct lens_setting *one = &lens->settings[i];
        json_put_setting(writing, parameter_write(one->parameter, writing->arena), one, &between);
    }
    if (lens->stops != NULL) {
        json_put_setting(writing, "stop", NULL, &between);
    }
    if (lens->lights != NULL) {
        json_put_setting(writing, "wavelength", NULL, &between);
    }
    if (lens->points != NULL) {
        json_put_setting(writing, "field", NULL, &between);
    }
    writing_put(writing, "]");
}

/* One distance, or one for each position. */
static void json_put_object(struct lens_writer *writing)
{
    const struct lens *lens = writing->lens;
    if (lens->objects != NULL) {
        writing_put(writing, ",\"object_mm\":%s,\"object_is_infinite\":",
                    json_values(writing, lens->objects, lens->position_count, 1));
        for (size_t i = 0; i < lens->position_count; i++) {
            writing_put(writing, "%s%s", i == 0 ? "[" : ",",
                        json_bool(isinf(lens->objects[i].value.hi)));
        }
        writing_put(writing, "]");
    } else {
        writing_put(writing, ",\"object_mm\":%s,\"object_is_infinite\":%s",
                    json_of_pair(writing->arena,
                                 lens->object_is_infinite ? pair_of(INFINITY) : lens->object.value),
                    json_bool(lens->object_is_infinite));
    }
    writing_put(writing, "%s,\"object_medium\":%s",
                lens->is_telecentric ? ",\"object_is_telecentric\":true" : "",
                json_of_text(writing->arena, lens->object_medium.written));
}

static void json_put_header(struct lens_writer *writing)
{
    static const char *const stated[] = {"stated_efl_mm", "stated_bfl_mm", "stated_fnumber",
                                         "stated_tstop"};
    const struct lens *lens = writing->lens;
    struct arena *arena = writing->arena;
    writing_put(writing, "{\"lens\":%s,\"source\":%s,\"kind\":%s",
                json_of_string(arena, lens->title), json_of_string(arena, lens->source),
                json_of_string(arena, lens->kind));
    json_put_strings(writing, "notes", lens->notes, lens->note_count);
    json_put_strings(writing, "positions", lens->positions, lens->position_count);
    writing_put(writing, "\n");
    writing_put(writing, ",\"unit\":%s,\"wavelengths\":[", json_of_string(arena, lens->unit));
    for (size_t i = 0; i < lens->wavelength_count; i++) {
        const struct lens_wavelength *one = &lens->wavelengths[i];
        writing_put(writing, "%s{\"name\":%s,\"wavelength_nm\":%s,\"weight\":%s}", i > 0 ? "," : "",
                    json_of_text(arena, one->typed),
                    json_of_number(arena, nanometres(one->wavelength)),
                    json_of_number(arena, one->weight));
    }
    writing_put(writing, "]");
    json_put_object(writing);
    json_put_use(writing);
    writing_put(writing, ",\"stop_surface\":%s",
                lens->stop == LENS_NONE ? "null" : arena_printf(arena, "%zu", lens->stop + 1));
    for (int i = 0; i < STATED_COUNT; i++) {
        writing_put(writing, ",\"%s\":%s", stated[i],
                    json_values(writing, lens->stated[i], lens->stated_count[i], 1));
    }
}

/* One more line of a list. */
static void json_put_line(struct text_buffer *text, const char *key, size_t i, struct text line)
{
    growing_string(text, i == 0 ? key : ",");
    growing_string(text, json_of_text(text->arena, line));
}

/* Pick-ups, goals and tolerances: the lines that a .lens file in mm has of them. */
static void json_put_design(struct text_buffer *text, const struct lens *lens, struct arena *arena)
{
    const struct lens *in_mm = lens_in_unit(lens, "mm", arena);
    for (size_t i = 0; i < lens->pickup_count; i++) {
        struct text_buffer line = {.arena = arena};
        lens_pickup_write(&in_mm->pickups[i], "mm", &line);
        json_put_line(text, ",\"pickups\":[", i, growing_done(&line));
    }
    growing_string(text, lens->pickup_count > 0 ? "]" : "");
    for (size_t i = 0; i < lens->goal_count; i++) {
        json_put_line(text, ",\"goals\":[", i, lens->goals[i].text);
    }
    growing_string(text, lens->goal_count > 0 ? "]" : "");
    for (size_t i = 0; i < lens->tolerance_count; i++) {
        struct text_buffer line = {.arena = arena};
        lens_tolerance_write(&in_mm->tolerances[i], "mm", &line);
        json_put_line(text, ",\"tolerances\":[", i, growing_done(&line));
    }
    growing_string(text, lens->tolerance_count > 0 ? "]" : "");
}

/* In JSON each cell has numbers of its own: a marked word in two of them would vary twice. */
static bool json_check_words(const struct lens *lens, struct error *error)
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

static bool lens_json_write(struct foreign_job *job, const struct lens *lens, struct text *text,
                            struct error *error)
{
    struct lens_writer writing;
    if (!json_check_words(lens, error)) {
        return false;
    }
    writing_begin(&writing, job, lens, true);
    json_put_header(&writing);
    if (lens->setting_count > 0 || lens->stops != NULL || lens->lights != NULL ||
        lens->points != NULL) {
        json_put_settings(&writing);
    }
    json_put_design(&writing.text, lens, job->arena);
    writing_put(&writing, "\n,\"surfaces\":[");
    for (size_t i = 0; i < lens->surface_count; i++) {
        if (!json_put_surface(&writing, i, error)) {
            return error_prefix(error, "surface %zu: ", i + 1);
        }
    }
    writing_put(&writing, "\n]}\n");
    *text = growing_done(&writing.text);
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
    .write = lens_json_write,
    .has_thick = true,
    .has_settings = true,
    .has_design = true,
    .has_apertures = true,
};
