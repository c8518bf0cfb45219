/* exchange/lens_json_surface.c - a surface of a lens in JSON. */
/* SPDX-License-Identifier: MIT */
#include "exchange/lens_json.h"
#include "file/lens_mark.h"
#include "optics/aperture.h"

#include <math.h>
#include <string.h>

/* A number, or one for each position as a variable d3; null or absent is not given. */
static bool json_cell(struct json_reader *reading, const struct json_value *value,
                      const char *prefix, struct figure *figure, bool *is_given)
{
    struct figure *values = NULL;
    *is_given = !json_is_null(value);
    if (!*is_given) {
        return true;
    }
    if (value->kind != JSON_ARRAY) {
        return json_read_figure(reading, value, JSON_LENGTH, figure);
    }
    const char *name =
        arena_printf(reading->job->arena, "%s%zu", prefix, reading->build.lens->surface_count);
    if (!json_check_count(reading, value) ||
        !json_read_figures(reading, value, JSON_LENGTH, &values)) {
        return false;
    }
    *figure = (struct figure){.typed = text_of(name),
                              .variable = lens_build_variable(&reading->build, name, values)};
    return true;
}

static bool json_displacement(struct json_reader *reading, const struct json_value *value,
                              size_t turns, const struct displacement **displacement)
{
    if (json_is_null(value)) {
        return true;
    }
    struct displacement *all = ARENA_NEW(reading->job->arena, struct displacement);
    const struct json_value *shift = json_item(value, "decenter_mm"),
                            *turn = json_item(value, "tilt_deg");
    if (value->kind != JSON_OBJECT || shift == NULL || shift->count != 2 || turn == NULL ||
        turn->count != 3) {
        return json_wrong(reading, value, "expected two decentres and three tilts here");
    }
    if (!json_check_keys(reading, value, "decenter_mm tilt_deg") ||
        !json_read_row(reading, shift, JSON_LENGTH, all->decenter, 2, NULL) ||
        !json_read_row(reading, turn, JSON_ANGLE, all->tilt, 3, NULL)) {
        return false;
    }
    *displacement = all;
    return turns == 3 || all->tilt[2].value.hi == 0 ||
           json_wrong(reading, turn, "a surface is not turned about z");
}

static bool json_coefficients(struct json_reader *reading, const struct json_value *value,
                              struct surface *surface)
{
    if (json_is_null(value)) {
        return true;
    }
    if (value->kind != JSON_OBJECT) {
        return json_wrong(reading, value, "expected an object with A1 .. A20 here");
    }
    struct arena *arena = reading->job->arena;
    const char *keys = NULL;
    for (int order = 1; order <= LENS_COEFFICIENTS; order++) {
        const enum parameter_kind kind = PARAMETER_COEFFICIENT;
        const char *key = parameter_name(kind, order, arena);
        const struct json_value *item = json_item(value, key);
        struct figure figure;
        keys = order == 1 ? key : arena_printf(arena, "%s %s", keys, key);
        if (item == NULL) {
            continue;
        }
        if (!json_read_figure(reading, item, parameter_length(kind, order), &figure)) {
            return false;
        }
        parameter_put(surface, kind, order, figure, arena);
    }
    return json_check_keys(reading, value, keys);
}

static const char x_and_y[] = "expected x and y here";

static bool json_corners(struct json_reader *reading, const struct json_value *value,
                         struct aperture *aperture)
{
    if (json_is_null(value)) {
        return true;
    }
    if (!json_check_array(reading, value, "corners")) {
        return false;
    }
    struct figure(*points)[2] = arena_array(reading->job->arena, value->count, sizeof *points);
    for (const struct json_value *item = value->first; item != NULL; item = item->next) {
        if (json_is_null(item)) {
            return json_wrong(reading, item, x_and_y);
        }
        if (!json_read_row(reading, item, JSON_LENGTH, points[aperture->point_count++], 2,
                           x_and_y)) {
            return false;
        }
    }
    aperture->points = (const struct figure(*)[2])points;
    return true;
}

static bool json_arms(struct json_reader *reading, const struct json_value *value,
                      struct aperture *aperture)
{
    struct figure figure;
    if (json_is_null(value)) {
        return true;
    }
    if (!json_read_figure(reading, value, JSON_PLAIN, &figure)) {
        return false;
    }
    double count = figure.value.hi;
    aperture->arms = count >= 1 && count <= APERTURE_MOST_ARMS ? (unsigned)count : 0;
    return (double)aperture->arms == count ||
           json_wrong(reading, value, "a spider has 1 to %d arms", APERTURE_MOST_ARMS);
}

/* Shape and sizes. */
static bool json_shape(struct json_reader *reading, const struct json_value *object,
                       struct aperture *aperture)
{
    const char *words[APERTURE_SHAPES];
    const struct json_value *shape = json_item(object, "shape"),
                            *blocks = json_item(object, "blocks"),
                            *sizes = json_item(object, "size_mm");
    int choice = 0;
    bool dark = false;
    for (size_t i = 0; i < APERTURE_SHAPES; i++) {
        words[i] = aperture_shapes[i].word;
    }
    if (shape == NULL || blocks == NULL) {
        return json_wrong(reading, object, "an aperture has \"shape\" and \"blocks\"");
    }
    if (!json_read_choice(reading, shape, words, APERTURE_SHAPES, &choice) ||
        !json_read_truth(reading, blocks, &dark)) {
        return false;
    }
    *aperture = aperture_of((enum aperture_shape)choice, dark);
    const size_t count = (size_t)aperture_sizes(aperture->shape);
    if ((json_is_null(sizes) ? 0 : sizes->count) != count) {
        return json_wrong(reading, json_is_null(sizes) ? object : sizes, "a %s has %zu sizes",
                          words[choice], count);
    }
    return count == 0 || json_read_row(reading, sizes, JSON_LENGTH, aperture->size, count, NULL);
}

static bool json_aperture(struct json_reader *reading, const struct json_value *object,
                          struct aperture *aperture)
{
    static const char keys[] = "shape blocks size_mm arms points_mm decenter_mm turn_deg";
    const struct json_value *turn = json_item(object, "turn_deg");
    struct error wrong;
    if (object->kind != JSON_OBJECT) {
        return json_wrong(reading, object, "an aperture is an object");
    }
    if (!json_check_keys(reading, object, keys) || !json_shape(reading, object, aperture) ||
        !json_arms(reading, json_item(object, "arms"), aperture) ||
        !json_corners(reading, json_item(object, "points_mm"), aperture) ||
        !json_read_row(reading, json_item(object, "decenter_mm"), JSON_LENGTH, aperture->decenter,
                       2, x_and_y) ||
        (!json_is_null(turn) && !json_read_figure(reading, turn, JSON_ANGLE, &aperture->turn))) {
        return false;
    }
    return aperture_check(aperture, &wrong) || json_wrong(reading, object, "%s", wrong.message);
}

static bool json_apertures(struct json_reader *reading, const struct json_value *value,
                           struct surface *surface)
{
    if (json_is_null(value)) {
        return true;
    }
    if (!json_check_array(reading, value, "apertures")) {
        return false;
    }
    struct aperture *all = ARENA_ARRAY(reading->job->arena, value->count, struct aperture);
    surface->apertures = all;
    for (const struct json_value *item = value->first; item != NULL; item = item->next) {
        if (!json_aperture(reading, item, &all[surface->aperture_count++])) {
            return false;
        }
    }
    return true;
}

/* A bound; null is none. */
static bool json_bound(struct json_reader *reading, const struct json_value *value, int power,
                       double none, struct figure *figure)
{
    *figure = (struct figure){{none, 0}, text_of(none < 0 ? "-inf" : "inf"), LENS_NONE};
    return value->kind == JSON_NULL || json_read_figure(reading, value, power, figure);
}

static bool json_bounds(struct json_reader *reading, const struct json_value *value,
                        struct vary *vary)
{
    const struct json_value *low = json_item(value, "low"), *high = json_item(value, "high");
    int power = (parameter_type(vary->kind)->is & PARAMETER_IS_ANGLE) != 0
                    ? JSON_ANGLE
                    : parameter_length(vary->kind, vary->order);
    vary->has_bounds = low != NULL;
    if (low == NULL) {
        return true;
    }
    if (vary->kind == PARAMETER_GLASS) {
        return json_wrong(reading, low, "a glass has no bounds");
    }
    return json_bound(reading, low, power, -INFINITY, &vary->low) &&
           json_bound(reading, high, power, INFINITY, &vary->high) &&
           (lens_bounds_are_sound(vary) ||
            json_wrong(reading, low, "the lower bound is above the upper"));
}

/* A mark of what the surface has, and where it has one: the position. */
static bool json_vary(struct json_reader *reading, const struct json_value *value,
                      const struct surface *surface, struct vary *vary)
{
    const struct json_value *what = json_item(value, "what"), *low = json_item(value, "low"),
                            *high = json_item(value, "high");
    *vary = (struct vary){.has_bounds = false};
    if (value->kind != JSON_OBJECT || what == NULL || what->kind != JSON_STRING ||
        !parameter_name_read(what->text, &vary->kind, &vary->order) ||
        !parameter_is_mark(vary->kind, surface) || (low == NULL) != (high == NULL)) {
        return json_wrong(reading, value, "what varies is %s",
                          parameter_marks(surface, reading->job->arena));
    }
    if (json_item(value, "position") == NULL &&
        parameter_is_marked(vary->kind, vary->order, surface)) {
        return json_wrong(reading, value, "'%.*s' is marked twice", text_shown(what->text),
                          what->text.start);
    }
    return json_check_keys(reading, value, "what low high position") &&
           json_bounds(reading, value, vary);
}

/* The mark of a number of one position. */
static bool json_vary_in_position(struct json_reader *reading, const struct json_value *position,
                                  const struct surface *surface, const struct vary *vary)
{
    struct lens *lens = reading->build.lens;
    struct arena *arena = reading->job->arena;
    size_t at =
        position->kind == JSON_STRING ? lens_position_find(lens, position->text) : LENS_NONE;
    const struct figure *cell = parameter_figure(surface, vary->kind, vary->order);
    if (at == LENS_NONE || cell == NULL || cell->variable == LENS_NONE) {
        return json_wrong(reading, position, "no position in which the number is another one");
    }
    struct lens_variable *word = &lens->variables[cell->variable];
    const struct vary **marks = ARENA_ARRAY(arena, lens->position_count, const struct vary *);
    for (size_t p = 0; p < lens->position_count; p++) {
        marks[p] = word->varies != NULL ? word->varies[p] : NULL;
    }
    if (marks[at] != NULL) {
        return json_wrong(reading, position, "a number that is marked twice");
    }
    struct vary *mark = ARENA_NEW(arena, struct vary);
    *mark = *vary;
    marks[at] = mark;
    word->varies = marks;
    return true;
}

static bool json_varies(struct json_reader *reading, const struct json_value *value,
                        struct surface *surface)
{
    if (json_is_null(value)) {
        return true;
    }
    if (value->kind != JSON_ARRAY) {
        return json_wrong(reading, value, "expected an array here");
    }
    struct vary *varies = ARENA_ARRAY(reading->job->arena, value->count + 1, struct vary);
    surface->varies = varies;
    for (const struct json_value *item = value->first; item != NULL; item = item->next) {
        const struct json_value *position = json_item(item, "position");
        struct vary *vary = &varies[surface->vary_count];
        if (!json_vary(reading, item, surface, vary) ||
            (position != NULL && !json_vary_in_position(reading, position, surface, vary))) {
            return false;
        }
        surface->vary_count += position == NULL ? 1 : 0;
    }
    return true;
}

/* A radius or a curvature; neither is a plane. */
static bool json_curve(struct json_reader *reading, const struct json_value *object,
                       struct surface *surface)
{
    const struct json_value *radius = json_item(object, "radius_mm"),
                            *curvature = json_item(object, "curvature_per_mm");
    surface->is_plane = json_is_null(radius);
    surface->has_curvature = !json_is_null(curvature);
    if (!surface->is_plane && surface->has_curvature) {
        return json_wrong(reading, curvature, "a curvature beside a radius");
    }
    return json_check_truth(reading, json_item(object, "radius_is_infinite"),
                            surface->is_plane && !surface->has_curvature, "radius_is_infinite",
                            "radius_mm") &&
           (surface->is_plane ||
            json_read_figure(reading, radius, JSON_LENGTH, &surface->radius)) &&
           (!surface->has_curvature ||
            json_read_figure(reading, curvature, -1, &surface->curvature));
}

/* A .lens file has names in double quotes. */
static bool json_surface_name(struct json_reader *reading, const struct json_value *value,
                              struct surface *surface)
{
    bool quoted = !json_is_null(value) && value->kind == JSON_STRING && value->text.length > 0 &&
                  memchr(value->text.start, '"', value->text.length) != NULL;
    return quoted ? json_wrong(reading, value, "a name of a surface has no double quotes")
                  : json_read_text(reading, value, &surface->name);
}

static bool json_surface_kind(struct json_reader *reading, const struct json_value *object,
                              struct surface *surface)
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
        return json_wrong(reading, object, "the kind of the surface is missing");
    }
    if (!json_read_choice(reading, kind, kinds, SURFACE_KINDS, &choice) ||
        (!json_is_null(stop) && !json_read_truth(reading, stop, &surface->is_stop)) ||
        (!json_is_null(cylinder) &&
         !json_read_choice(reading, cylinder, curved, SECTIONS, &sections))) {
        return false;
    }
    surface->kind = (enum surface_kind)choice;
    surface->curved = (enum curved)sections;
    bool bare = surface->is_plane && !surface->has_curvature && surface->is_stop;
    return surface->kind != SURFACE_STOP || bare ||
           json_wrong(reading, kind, "a stop is a plane with \"is_stop\": true");
}

/* What only a thick lens has, and must have. */
static bool json_thick(struct json_reader *reading, const struct json_value *object,
                       struct surface *surface)
{
    const struct json_value *focal = json_item(object, "focal_mm");
    const struct json_value *hiatus = json_item(object, "hiatus_mm");
    const struct json_value *distortion = json_item(object, "distortion");
    bool is_given;
    if (!surface_has(surface, SURFACE_HAS_FOCAL)) {
        const struct json_value *odd = focal != NULL ? focal : hiatus;
        odd = odd != NULL ? odd : distortion;
        return odd == NULL || json_wrong(reading, odd, "only a thick lens has this");
    }
    if (json_is_null(focal) || !surface->is_plane || surface->has_curvature) {
        return json_wrong(reading, object, "a thick lens has a focal length and no radius");
    }
    return json_cell(reading, focal, "f", &surface->focal, &is_given) &&
           json_cell(reading, hiatus, "h", &surface->hiatus, &is_given) &&
           json_read_row(reading, distortion, JSON_PLAIN, surface->distortion, 3,
                         "expected three terms of distortion here");
}

/* Surfaces are counted from 1. */
static bool json_check_number(struct json_reader *reading, const struct json_value *value)
{
    struct figure number;
    size_t count = reading->build.lens->surface_count;
    if (json_is_null(value)) {
        return true;
    }
    return json_read_figure(reading, value, JSON_PLAIN, &number) &&
           (number.value.hi == (double)count ||
            json_wrong(reading, value, "another surface, where surface %zu is expected", count));
}

/* What a surface without a curve has not. */
static bool json_check_curve(struct json_reader *reading, const struct json_value *object,
                             const struct surface *surface)
{
    static const char *const keys[] = {"conic", "coefficients_mm", "cylinder"};
    const bool odd[] = {surface->conic.value.hi != 0, !json_is_null(json_item(object, keys[1])),
                        !surface_is_round(surface)};
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++) {
        if (odd[i] && !surface_has(surface, SURFACE_HAS_CURVE)) {
            return json_wrong(reading, json_item(object, keys[i]),
                              "%s belongs to a surface that is curved", keys[i]);
        }
    }
    return true;
}

/* The indices are for others: the medium decides, and must not say anything else. */
static bool json_check_index(struct json_reader *reading, const struct json_value *value,
                             const struct surface *surface)
{
    const struct lens *lens = reading->build.lens;
    const double rounding = 1e-9; /* of another program that has written them again */
    size_t count = lens->wavelength_count > 0 ? lens->wavelength_count : 1, i = 0;
    if (json_is_null(value)) {
        return true;
    }
    if (value->kind != JSON_ARRAY || value->count != count) {
        return json_wrong(reading, value, "expected an array of %zu indices here", count);
    }
    for (const struct json_value *item = value->first; item != NULL; item = item->next, i++) {
        double wavelength = lens->wavelength_count > 0 ? lens->wavelengths[i].wavelength
                                                       : lens_primary_wavelength(lens);
        struct figure figure;
        struct pair index;
        struct error unknown;
        if (!json_read_figure(reading, item, JSON_PLAIN, &figure)) {
            return false;
        }
        if (medium_index(&surface->medium, wavelength, &index, &unknown) &&
            !(fabs(figure.value.hi - index.hi) <= rounding)) {
            return json_wrong(reading, item, "the index of %.*s is %.10g here",
                              text_shown(surface->medium.written), surface->medium.written.start,
                              index.hi);
        }
    }
    return true;
}

/* A mirror has no medium of its own. */
static bool json_surface_medium(struct json_reader *reading, const struct json_value *object,
                                struct surface *surface)
{
    const struct json_value *medium = json_item(object, "medium");
    bool is_mirror =
        medium != NULL && medium->kind == JSON_STRING && text_equal(medium->text, "mirror");
    if (!json_is_null(medium) && is_mirror != surface_reflects(surface)) {
        return json_wrong(reading, medium,
                          "the kind \"reflect\" and the medium \"mirror\" go together");
    }
    if (surface_reflects(surface)) {
        return true;
    }
    return json_read_medium(reading, medium, &surface->medium) &&
           json_check_index(reading, json_item(object, "index"), surface);
}

/* What may stand beside: it shapes, moves or marks the surface. */
static bool json_details(struct json_reader *reading, const struct json_value *object,
                         struct surface *surface)
{
    const struct json_value *conic = json_item(object, "conic");
    struct figure figure = surface->conic;
    if (!json_is_null(conic) && !json_read_figure(reading, conic, JSON_PLAIN, &figure)) {
        return false;
    }
    surface->conic = figure.value.hi != 0 ? figure : surface->conic; /* 0 is no conic */
    return json_check_curve(reading, object, surface) &&
           json_coefficients(reading, json_item(object, "coefficients_mm"), surface) &&
           json_displacement(reading, json_item(object, "moved"), 2, &surface->decentre) &&
           json_displacement(reading, json_item(object, "bend_before"), 3,
                             &surface->coordinate_break) &&
           json_apertures(reading, json_item(object, "apertures"), surface) &&
           json_thick(reading, object, surface) &&
           json_varies(reading, json_item(object, "vary"), surface);
}

bool json_read_surface(struct json_reader *reading, const struct json_value *object)
{
    static const char keys[] =
        "surface kind is_stop name radius_mm radius_is_infinite medium thickness_mm "
        "curvature_per_mm index diameter_mm conic cylinder moved bend_before apertures "
        "coefficients_mm vary focal_mm hiatus_mm distortion";
    struct lens *lens = reading->build.lens;
    if (object->kind != JSON_OBJECT) {
        return json_wrong(reading, object, "a surface is an object");
    }
    struct medium medium = lens->surface_count > 0 ? lens->surfaces[lens->surface_count - 1].medium
                                                   : lens->object_medium;
    struct surface *surface = lens_build_surface(&reading->build);
    if (!json_check_keys(reading, object, keys) ||
        !json_check_number(reading, json_item(object, "surface")) ||
        !json_curve(reading, object, surface) || !json_surface_kind(reading, object, surface)) {
        return false;
    }
    surface->medium = surface_reflects(surface) ? medium : medium_air;
    if (surface->is_stop && lens->stop != LENS_NONE) {
        return json_wrong(reading, object, "a second stop");
    }
    lens->stop = surface->is_stop ? lens->surface_count - 1 : lens->stop;
    return json_surface_medium(reading, object, surface) &&
           json_surface_name(reading, json_item(object, "name"), surface) &&
           json_cell(reading, json_item(object, "thickness_mm"), "d", &surface->thickness,
                     &surface->has_thickness) &&
           json_cell(reading, json_item(object, "diameter_mm"), "a", &surface->diameter,
                     &surface->has_diameter) &&
           json_details(reading, object, surface);
}
