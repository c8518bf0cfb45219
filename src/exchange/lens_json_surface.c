/* exchange/lens_json_surface.c - a surface of a lens in JSON. */
/* SPDX-License-Identifier: MIT */
#include "exchange/lens_json_reading.h"
#include "file/lens_mark.h"

#include <math.h>
#include <string.h>

/* A number, or one for each position as a variable; null or absent is not given. */
static bool lens_json_surface_read_cell(struct json_reader *reading, const struct json_value *value,
                                        const char *name, struct figure *figure, bool *is_given,
                                        struct error *error)
{
    struct figure *values = NULL;
    *is_given = !json_is_null(value);
    if (!*is_given) {
        return true;
    }
    if (value->kind != JSON_ARRAY) {
        return json_read_figure(reading, value, JSON_LENGTH, figure, error);
    }
    if (!json_check_count(reading, value, error) ||
        !json_read_figures(reading, value, JSON_LENGTH, &values, error)) {
        return false;
    }
    *figure = (struct figure){.typed = text_of(name),
                              .variable = lens_build_variable(&reading->build, name, values)};
    return true;
}

static bool read_displacement(struct json_reader *reading, const struct json_value *value,
                              size_t turns, const struct displacement **displacement,
                              struct error *error)
{
    static const char *const keys[] = {"decenter_mm", "tilt_deg", NULL};
    struct figure *figures = NULL;
    if (json_is_null(value)) {
        return true;
    }
    struct displacement *all = ARENA_NEW(reading->job->arena, struct displacement);
    const struct json_value *shift = json_item(value, keys[0]), *turn = json_item(value, keys[1]);
    if (value->kind != JSON_OBJECT || shift == NULL || shift->count != 2 || turn == NULL ||
        turn->count != 3) {
        return json_wrong(reading, value, error, "expected two decentres and three tilts here");
    }
    if (!json_check_keys(reading, value, keys, error) ||
        !json_read_figures(reading, shift, JSON_LENGTH, &figures, error)) {
        return false;
    }
    memcpy(all->decenter, figures, sizeof all->decenter);
    if (!json_read_figures(reading, turn, JSON_ANGLE, &figures, error)) {
        return false;
    }
    memcpy(all->tilt, figures, sizeof all->tilt);
    *displacement = all;
    return turns == 3 || all->tilt[2].value.hi == 0 ||
           json_wrong(reading, turn, error, "a surface is not turned about z");
}

static bool lens_json_surface_read_coefficients(struct json_reader *reading,
                                                const struct json_value *value,
                                                struct surface *surface, struct error *error)
{
    if (json_is_null(value)) {
        return true;
    }
    if (value->kind != JSON_OBJECT) {
        return json_wrong(reading, value, error, "expected an object with A1 .. A20 here");
    }
    const char *keys[LENS_COEFFICIENTS + 1] = {NULL};
    for (int order = 1; order <= LENS_COEFFICIENTS; order++) {
        const enum parameter_kind kind = PARAMETER_COEFFICIENT;
        struct arena *arena = reading->job->arena;
        struct figure figure;
        keys[order - 1] = parameter_name(kind, order, arena);
        const struct json_value *item = json_item(value, keys[order - 1]);
        if (item == NULL) {
            continue;
        }
        if (!json_read_figure(reading, item, parameter_length(kind, order), &figure, error)) {
            return false;
        }
        parameter_put(surface, kind, order, figure, arena);
    }
    return json_check_keys(reading, value, keys, error);
}

/* A bound; null is none. */
static bool lens_json_surface_read_bound(struct json_reader *reading,
                                         const struct json_value *value, int power, double none,
                                         struct figure *figure, struct error *error)
{
    *figure = (struct figure){{none, 0}, text_of(none < 0 ? "-inf" : "inf"), LENS_NONE};
    return value->kind == JSON_NULL || json_read_figure(reading, value, power, figure, error);
}

static bool lens_json_surface_read_bounds(struct json_reader *reading,
                                          const struct json_value *value, struct vary *vary,
                                          struct error *error)
{
    const struct json_value *low = json_item(value, "low"), *high = json_item(value, "high");
    bool angle = (parameter_type(vary->kind)->is & PARAMETER_IS_ANGLE) != 0;
    int power = angle ? JSON_ANGLE : parameter_length(vary->kind, vary->order);
    vary->has_bounds = low != NULL;
    if (low == NULL) {
        return true;
    }
    if (vary->kind == PARAMETER_GLASS) {
        return json_wrong(reading, low, error, "a glass has no bounds");
    }
    return lens_json_surface_read_bound(reading, low, power, -INFINITY, &vary->low, error) &&
           lens_json_surface_read_bound(reading, high, power, INFINITY, &vary->high, error) &&
           (lens_bounds_are_sound(vary) ||
            json_wrong(reading, low, error, "the lower bound is above the upper"));
}

/* A mark of what the surface has, and where it has one: the position. */
static bool lens_json_surface_read_vary(struct json_reader *reading, const struct json_value *value,
                                        const struct surface *surface, struct vary *vary,
                                        struct error *error)
{
    static const char *const keys[] = {"what", "low", "high", "position", NULL};
    const struct json_value *what = json_item(value, "what"), *low = json_item(value, "low"),
                            *high = json_item(value, "high");
    *vary = (struct vary){.has_bounds = false};
    if (value->kind != JSON_OBJECT || what == NULL || what->kind != JSON_STRING ||
        !parameter_name_read(what->text, &vary->kind, &vary->order) ||
        !parameter_is_mark(vary->kind, surface) || (low == NULL) != (high == NULL)) {
        return json_wrong(reading, value, error, "what varies is %s",
                          parameter_marks(surface, reading->job->arena));
    }
    if (json_item(value, "position") == NULL &&
        parameter_is_marked(vary->kind, vary->order, surface)) {
        return json_wrong(reading, value, error, "'%.*s' is marked twice", text_shown(what->text),
                          what->text.start);
    }
    return json_check_keys(reading, value, keys, error) &&
           lens_json_surface_read_bounds(reading, value, vary, error);
}

/* The mark of a number of one position. */
static bool add_to_position(struct json_reader *reading, const struct json_value *position,
                            const struct surface *surface, const struct vary *vary,
                            struct error *error)
{
    struct lens *lens = reading->build.lens;
    struct arena *arena = reading->job->arena;
    size_t at =
        position->kind == JSON_STRING ? lens_position_find(lens, position->text) : LENS_NONE;
    const struct figure *cell = parameter_figure(surface, vary->kind, vary->order);
    if (at == LENS_NONE || cell == NULL || cell->variable == LENS_NONE) {
        return json_wrong(reading, position, error,
                          "no position in which the number is another one");
    }
    struct lens_variable *word = &lens->variables[cell->variable];
    const struct vary **marks = ARENA_ARRAY(arena, lens->position_count, const struct vary *);
    for (size_t p = 0; p < lens->position_count; p++) {
        marks[p] = word->varies != NULL ? word->varies[p] : NULL;
    }
    if (marks[at] != NULL) {
        return json_wrong(reading, position, error, "a number that is marked twice");
    }
    struct vary *mark = ARENA_NEW(arena, struct vary);
    *mark = *vary;
    marks[at] = mark;
    word->varies = marks;
    return true;
}

static bool read_varies(struct json_reader *reading, const struct json_value *value,
                        struct surface *surface, struct error *error)
{
    if (json_is_null(value)) {
        return true;
    }
    if (value->kind != JSON_ARRAY) {
        return json_wrong(reading, value, error, "expected an array here");
    }
    struct vary *varies = ARENA_ARRAY(reading->job->arena, value->count + 1, struct vary);
    surface->varies = varies;
    for (const struct json_value *item = value->first; item != NULL; item = item->next) {
        const struct json_value *position = json_item(item, "position");
        struct vary *vary = &varies[surface->vary_count];
        if (!lens_json_surface_read_vary(reading, item, surface, vary, error) ||
            (position != NULL && !add_to_position(reading, position, surface, vary, error))) {
            return false;
        }
        surface->vary_count += position == NULL ? 1 : 0;
    }
    return true;
}

/* A radius or a curvature; neither is a plane. */
static bool lens_json_surface_read_curve(struct json_reader *reading,
                                         const struct json_value *object, struct surface *surface,
                                         struct error *error)
{
    const struct json_value *radius = json_item(object, "radius_mm"),
                            *curvature = json_item(object, "curvature_per_mm");
    surface->is_plane = json_is_null(radius);
    surface->has_curvature = !json_is_null(curvature);
    if (!surface->is_plane && surface->has_curvature) {
        return json_wrong(reading, curvature, error, "a curvature beside a radius");
    }
    return json_check_truth(reading, json_item(object, "radius_is_infinite"),
                            surface->is_plane && !surface->has_curvature, "radius_is_infinite",
                            "radius_mm", error) &&
           (surface->is_plane ||
            json_read_figure(reading, radius, JSON_LENGTH, &surface->radius, error)) &&
           (!surface->has_curvature ||
            json_read_figure(reading, curvature, -1, &surface->curvature, error));
}

/* A .lens file has names in double quotes. */
static bool lens_json_surface_read_name(struct json_reader *reading, const struct json_value *value,
                                        struct surface *surface, struct error *error)
{
    bool quoted = !json_is_null(value) && value->kind == JSON_STRING && value->text.length > 0 &&
                  memchr(value->text.start, '"', value->text.length) != NULL;
    return quoted ? json_wrong(reading, value, error, "a name of a surface has no double quotes")
                  : json_read_text(reading, value, &surface->name, error);
}

/* 0 is no conic. */
static bool lens_json_surface_read_conic(struct json_reader *reading,
                                         const struct json_value *value, struct figure *conic,
                                         struct error *error)
{
    struct figure figure;
    if (!json_read_figure(reading, value, JSON_PLAIN, &figure, error)) {
        return false;
    }
    *conic = figure.value.hi != 0 ? figure : *conic;
    return true;
}

static bool lens_json_surface_read_kind(struct json_reader *reading,
                                        const struct json_value *object, struct surface *surface,
                                        struct error *error)
{
    enum { SECTIONS = sizeof surface_sections / sizeof surface_sections[0] };
    const char *kinds[SURFACE_KINDS], *curved[SECTIONS];
    const struct json_value *kind = json_item(object, "kind"), *stop = json_item(object, "is_stop"),
                            *cylinder = json_item(object, "cylinder");
    int choice = 0, sections = 0;
    for (size_t i = 0; i < SURFACE_KINDS; i++) {
        kinds[i] = surface_kinds[i].key;
    }
    for (size_t i = 0; i < SECTIONS; i++) {
        curved[i] = surface_sections[i].key;
    }
    if (kind == NULL) {
        return json_wrong(reading, object, error, "the kind of the surface is missing");
    }
    if (!json_read_choice(reading, kind, kinds, SURFACE_KINDS, &choice, error) ||
        (!json_is_null(stop) && !json_read_truth(reading, stop, &surface->is_stop, error)) ||
        (!json_is_null(cylinder) &&
         !json_read_choice(reading, cylinder, curved, SECTIONS, &sections, error))) {
        return false;
    }
    surface->kind = (enum surface_kind)choice;
    surface->curved = (enum curved)sections;
    bool bare = surface->is_plane && !surface->has_curvature && surface->is_stop;
    return surface->kind != SURFACE_STOP || bare ||
           json_wrong(reading, kind, error, "a stop is a plane with \"is_stop\": true");
}

/* What only a thick lens has, and must have. */
static bool lens_json_surface_read_thick(struct json_reader *reading,
                                         const struct json_value *object, struct surface *surface,
                                         struct error *error)
{
    const struct json_value *focal = json_item(object, "focal_mm");
    const struct json_value *hiatus = json_item(object, "hiatus_mm");
    const struct json_value *distortion = json_item(object, "distortion");
    struct figure *terms = NULL;
    bool is_given;
    if (!surface_has(surface, SURFACE_HAS_FOCAL)) {
        const struct json_value *odd = focal != NULL ? focal : hiatus;
        odd = odd != NULL ? odd : distortion;
        return odd == NULL || json_wrong(reading, odd, error, "only a thick lens has this");
    }
    if (json_is_null(focal) || !surface->is_plane || surface->has_curvature) {
        return json_wrong(reading, object, error, "a thick lens has a focal length and no radius");
    }
    if (!lens_json_surface_read_cell(
            reading, focal,
            arena_printf(reading->job->arena, "f%zu", reading->build.lens->surface_count),
            &surface->focal, &is_given, error) ||
        !lens_json_surface_read_cell(
            reading, hiatus,
            arena_printf(reading->job->arena, "h%zu", reading->build.lens->surface_count),
            &surface->hiatus, &is_given, error)) {
        return false;
    }
    if (json_is_null(distortion)) {
        return true;
    }
    if (distortion->kind != JSON_ARRAY || distortion->count != 3) {
        return json_wrong(reading, distortion, error, "expected three terms of distortion here");
    }
    if (!json_read_figures(reading, distortion, JSON_PLAIN, &terms, error)) {
        return false;
    }
    memcpy(surface->distortion, terms, sizeof surface->distortion);
    return true;
}

/* Surfaces are counted from 1. */
static bool lens_json_surface_check_number(struct json_reader *reading,
                                           const struct json_value *value, struct error *error)
{
    struct figure number;
    size_t count = reading->build.lens->surface_count;
    if (json_is_null(value)) {
        return true;
    }
    return json_read_figure(reading, value, JSON_PLAIN, &number, error) &&
           (number.value.hi == (double)count ||
            json_wrong(reading, value, error, "another surface, where surface %zu is expected",
                       count));
}

/* What a surface without a curve has not. */
static bool check_curve(struct json_reader *reading, const struct json_value *object,
                        const struct surface *surface, struct error *error)
{
    static const char *const keys[] = {"conic", "coefficients_mm", "cylinder"};
    const bool odd[] = {surface->conic.value.hi != 0, !json_is_null(json_item(object, keys[1])),
                        !surface_is_round(surface)};
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++) {
        if (odd[i] && !surface_has(surface, SURFACE_HAS_CURVE)) {
            return json_wrong(reading, json_item(object, keys[i]), error,
                              "%s belongs to a surface that is curved", keys[i]);
        }
    }
    return true;
}

/* The indices are for others: the medium decides, and must not say anything else. */
static bool lens_json_surface_check_index(struct json_reader *reading,
                                          const struct json_value *value,
                                          const struct surface *surface, struct error *error)
{
    const struct lens *lens = reading->build.lens;
    const double rounding = 1e-9; /* of another program that has written them again */
    size_t count = lens->wavelength_count > 0 ? lens->wavelength_count : 1, i = 0;
    if (json_is_null(value)) {
        return true;
    }
    if (value->kind != JSON_ARRAY || value->count != count) {
        return json_wrong(reading, value, error, "expected an array of %zu indices here", count);
    }
    for (const struct json_value *item = value->first; item != NULL; item = item->next, i++) {
        double wavelength = lens->wavelength_count > 0 ? lens->wavelengths[i].wavelength
                                                       : lens_primary_wavelength(lens);
        struct figure figure;
        struct pair index;
        struct error unknown;
        if (!json_read_figure(reading, item, JSON_PLAIN, &figure, error)) {
            return false;
        }
        if (medium_index(&surface->medium, wavelength, &index, &unknown) &&
            !(fabs(figure.value.hi - index.hi) <= rounding)) {
            return json_wrong(reading, item, error, "the index of %.*s is %.10g here",
                              text_shown(surface->medium.written), surface->medium.written.start,
                              index.hi);
        }
    }
    return true;
}

/* A mirror has no medium of its own. */
static bool lens_json_surface_read_medium(struct json_reader *reading,
                                          const struct json_value *object, struct surface *surface,
                                          struct error *error)
{
    const struct json_value *medium = json_item(object, "medium");
    bool is_mirror =
        medium != NULL && medium->kind == JSON_STRING && text_equal(medium->text, "mirror");
    if (!json_is_null(medium) && is_mirror != surface_reflects(surface)) {
        return json_wrong(reading, medium, error,
                          "the kind \"reflect\" and the medium \"mirror\" go together");
    }
    if (surface_reflects(surface)) {
        return true;
    }
    return json_read_medium(reading, medium, &surface->medium, error) &&
           lens_json_surface_check_index(reading, json_item(object, "index"), surface, error);
}

/* Thickness and diameter: numbers, or d3 and a3 in the positions. */
static bool lens_json_surface_read_sizes(struct json_reader *reading,
                                         const struct json_value *object, struct surface *surface,
                                         struct error *error)
{
    struct arena *arena = reading->job->arena;
    size_t number = reading->build.lens->surface_count;
    return lens_json_surface_read_cell(reading, json_item(object, "thickness_mm"),
                                       arena_printf(arena, "d%zu", number), &surface->thickness,
                                       &surface->has_thickness, error) &&
           lens_json_surface_read_cell(reading, json_item(object, "diameter_mm"),
                                       arena_printf(arena, "a%zu", number), &surface->diameter,
                                       &surface->has_diameter, error);
}

/* What may stand beside: it shapes, moves or marks the surface. */
static bool lens_json_surface_read_beside(struct json_reader *reading,
                                          const struct json_value *object, struct surface *surface,
                                          struct error *error)
{
    const struct json_value *conic = json_item(object, "conic");
    return (json_is_null(conic) ||
            lens_json_surface_read_conic(reading, conic, &surface->conic, error)) &&
           check_curve(reading, object, surface, error) &&
           lens_json_surface_read_coefficients(reading, json_item(object, "coefficients_mm"),
                                               surface, error) &&
           read_displacement(reading, json_item(object, "moved"), 2, &surface->decentre, error) &&
           read_displacement(reading, json_item(object, "bend_before"), 3,
                             &surface->coordinate_break, error) &&
           json_read_apertures(reading, json_item(object, "apertures"), surface, error) &&
           lens_json_surface_read_thick(reading, object, surface, error) &&
           read_varies(reading, json_item(object, "vary"), surface, error);
}

bool json_read_surface(struct json_reader *reading, const struct json_value *object,
                       struct error *error)
{
    static const char *const keys[] = {"surface",          "kind",
                                       "is_stop",          "name",
                                       "radius_mm",        "radius_is_infinite",
                                       "medium",           "thickness_mm",
                                       "curvature_per_mm", "index",
                                       "diameter_mm",      "conic",
                                       "cylinder",         "moved",
                                       "bend_before",      "apertures",
                                       "coefficients_mm",  "vary",
                                       "focal_mm",         "hiatus_mm",
                                       "distortion",       NULL};
    struct lens *lens = reading->build.lens;
    if (object->kind != JSON_OBJECT) {
        return json_wrong(reading, object, error, "a surface is an object");
    }
    struct medium medium = lens->surface_count > 0 ? lens->surfaces[lens->surface_count - 1].medium
                                                   : lens->object_medium;
    struct surface *surface = lens_build_surface(&reading->build);
    if (!json_check_keys(reading, object, keys, error) ||
        !lens_json_surface_check_number(reading, json_item(object, "surface"), error) ||
        !lens_json_surface_read_curve(reading, object, surface, error) ||
        !lens_json_surface_read_kind(reading, object, surface, error)) {
        return false;
    }
    surface->medium = surface_reflects(surface) ? medium : medium_air;
    if (surface->is_stop && lens->stop != LENS_NONE) {
        return json_wrong(reading, object, error, "a second stop");
    }
    lens->stop = surface->is_stop ? lens->surface_count - 1 : lens->stop;
    return lens_json_surface_read_medium(reading, object, surface, error) &&
           lens_json_surface_read_name(reading, json_item(object, "name"), surface, error) &&
           lens_json_surface_read_sizes(reading, object, surface, error) &&
           lens_json_surface_read_beside(reading, object, surface, error);
}
