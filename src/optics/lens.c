/* optics/lens.c - positions of a lens, and what is physically wrong with it. */
/* SPDX-License-Identifier: MIT */
#include "optics/lens.h"

#include "base/constants.h"
#include "optics/aperture.h"
#include "optics/pickup.h"
#include "optics/wavelength.h"

#include <math.h>
#include <string.h>

const struct lens_field lens_field_none = {.at = {{.variable = LENS_NONE}, {.variable = LENS_NONE}},
                                           .weight = 1};

const char *lens_field_wrong(const struct lens_field *field, double half_turn)
{
    const double x = fabs(field->at[0].value.hi), y = fabs(field->at[1].value.hi);
    if (!(fmax(x, y) <= half_turn)) {
        return "a field angle is not beyond 180 degrees";
    }
    return x > 0 && y > 0 && !(fmax(x, y) < half_turn / 2)
               ? "of a field with an angle in x and one in y both are below 90 degrees"
               : NULL;
}

double field_extent(enum field_kind kind, const double at[2])
{
    if (at[0] == 0 || at[1] == 0) {
        return fabs(at[0]) + fabs(at[1]);
    }
    return kind == FIELD_ANGLE ? atan(hypot(tan(at[0]), tan(at[1]))) : hypot(at[0], at[1]);
}

bool lens_field_is_same(const struct lens_field *a, const struct lens_field *b)
{
    bool same = a->weight == b->weight;
    for (int i = 0; i < 2; i++) {
        same = same && a->at[i].value.hi == b->at[i].value.hi &&
               a->at[i].value.lo == b->at[i].value.lo;
    }
    return same;
}

bool lens_has_fields_beside(const struct lens *lens)
{
    for (size_t i = 0; i < lens->field_count; i++) {
        if (lens->fields[i].at[0].value.hi != 0) {
            return true;
        }
    }
    return false;
}

double lens_field_extent(const struct lens *lens)
{
    double largest = NAN;
    for (size_t i = 0; i < lens->field_count; i++) {
        const struct lens_field *field = &lens->fields[i];
        const double at[2] = {field->at[0].value.hi, field->at[1].value.hi};
        largest = fmax(largest, field_extent(lens->field_kind, at));
    }
    return largest;
}

const char *lens_field_from_degrees(struct lens_field *field)
{
    const char *wrong = lens_field_wrong(field, 180);
    for (int i = 0; i < 2 && wrong == NULL; i++) {
        field->at[i].value = pair_multiply(field->at[i].value, pair_of(RADIANS_PER_DEGREE));
    }
    return wrong;
}

static void substitute(const struct lens *lens, struct figure *figure, size_t position)
{
    if (figure->variable != LENS_NONE) {
        *figure = lens->variables[figure->variable].values[position];
    }
}

const struct lens *lens_at_position(const struct lens *lens, size_t position, struct arena *arena)
{
    if (lens->position_count == 0) {
        return lens;
    }
    struct lens *copy = lens_copy(lens, arena);
    for (size_t i = 0; i < lens->surface_count; i++) {
        struct surface *surface = &copy->surfaces[i];
        substitute(lens, &surface->thickness, position);
        substitute(lens, &surface->diameter, position);
        if (surface_has(surface, SURFACE_HAS_FOCAL)) {
            substitute(lens, &surface->focal, position);
            substitute(lens, &surface->hiatus, position);
        }
    }
    for (size_t i = 0; i < lens->setting_count; i++) {
        const struct parameter *one = &lens->settings[i].parameter;
        if (lens->settings[i].media != NULL) {
            parameter_put_medium(copy, one->surface, &lens->settings[i].media[position]);
        } else {
            parameter_put(&copy->surfaces[one->surface], one->kind, one->order,
                          lens->settings[i].figures[position], arena);
        }
    }
    copy->settings = NULL;
    copy->setting_count = 0;
    if (lens->stops != NULL) {
        /* A plane that was only the stop stays as a plane. */
        size_t stop = lens->stops[position];
        struct surface *from = &copy->surfaces[copy->stop];
        if (stop != copy->stop) {
            from->is_stop = false;
            from->kind = from->kind == SURFACE_STOP ? SURFACE_REFRACT : from->kind;
            copy->surfaces[stop].is_stop = true;
            copy->stop = stop;
        }
    }
    if (lens->lights != NULL) {
        copy->wavelengths = lens->lights[position].wavelengths;
        copy->wavelength_count = lens->lights[position].count;
    }
    if (lens->points != NULL) {
        copy->fields = lens->points[position].fields;
        copy->field_count = lens->points[position].count;
    }
    if (lens->objects != NULL) {
        copy->object = lens->objects[position];
        copy->object_is_infinite = isinf(copy->object.value.hi);
    }
    if (lens->apertures != NULL) {
        copy->aperture = lens->apertures[position];
    }
    lens_pickups_put(copy, copy, arena);
    copy->pickups = NULL;
    copy->pickup_count = 0;
    return copy;
}

size_t lens_position_find(const struct lens *lens, struct text name)
{
    for (size_t i = 0; i < lens->position_count; i++) {
        if (text_same(name, lens->positions[i])) {
            return i;
        }
    }
    return LENS_NONE;
}

double lens_stated(const struct lens *lens, int what, size_t position)
{
    if (lens->stated[what] == NULL) {
        return NAN;
    }
    return lens->stated[what][lens->stated_count[what] > 1 ? position : 0].value.hi;
}

double lens_primary_wavelength(const struct lens *lens)
{
    return lens->wavelength_count > 0 ? lens->wavelengths[0].wavelength : WAVELENGTH_D;
}

/* One lens being checked. */
struct check {
    const struct lens *lens;
    struct arena *arena;
    struct lens_warnings *warnings;
    bool has_thick; /* a thick lens is among the surfaces */
};

enum { MOST_WARNINGS = 20 };

static void lens_warn(const struct check *check, const char *text)
{
    struct lens_warnings *warnings = check->warnings;
    for (size_t i = 0; i < warnings->count; i++) {
        if (strcmp(warnings->texts[i], text) == 0) {
            return;
        }
    }
    if (warnings->count < MOST_WARNINGS) {
        warnings->texts[warnings->count++] = text;
    }
}

bool lens_hint_stop(struct error *error)
{
    return error_hint(error, "in its file a line 'stop' in place of a plane 'surface', or the word "
                             "'stop' behind another one, says where it is");
}

static bool lens_is_sound(struct pair value)
{
    return fabs(value.hi) < 1e100;
}

static bool are_sound(const struct surface *surface)
{
    const struct pair values[] = {surface->radius.value,    surface->curvature.value,
                                  surface->thickness.value, surface->diameter.value,
                                  surface->conic.value,     surface->focal.value,
                                  surface->hiatus.value};
    for (size_t i = 0; i < sizeof values / sizeof values[0]; i++) {
        if (!lens_is_sound(values[i])) {
            return false;
        }
    }
    return true;
}

static bool check_numbers(const struct surface *surface, size_t number, struct error *error)
{
    if (!are_sound(surface)) {
        return fail(error, ERROR_DATA, "surface %zu has a number beyond 1e100", number);
    }
    if (surface_has(surface, SURFACE_HAS_FOCAL) && !(fabs(surface->focal.value.hi) > 1e-100)) {
        return fail(error, ERROR_DATA, "surface %zu is a thick lens with the focal length 0",
                    number);
    }
    if (!surface->is_plane && !surface->has_curvature &&
        !(fabs(surface->radius.value.hi) > 1e-100)) {
        return fail(error, ERROR_DATA, "surface %zu has the radius 0: a plane is '-' or 'inf'",
                    number);
    }
    if (surface->has_diameter && !(surface->diameter.value.hi > 0)) {
        return fail(error, ERROR_DATA, "surface %zu has the diameter %.6g: it must be above 0",
                    number, surface->diameter.value.hi);
    }
    for (size_t i = 0; i < surface->aperture_count; i++) {
        if (!aperture_check(&surface->apertures[i], error)) {
            return error_prefix(error, "surface %zu: ", number);
        }
    }
    const struct medium *medium = &surface->medium;
    bool has_index = medium->kind == MEDIUM_CONSTANT || medium->kind == MEDIUM_MODEL;
    return !has_index || medium->index.hi > 0 ||
           fail(error, ERROR_DATA, "surface %zu: the index %.6g is not above 0", number,
                medium->index.hi);
}

/* Glass or air between two surfaces must not be negative inside both apertures. */
static void check_gap(const struct check *check, size_t i, double direction)
{
    const struct surface *left = &check->lens->surfaces[i], *right = left + 1;
    bool air = medium_is_air(&left->medium);
    if (check->has_thick) {
        return; /* planes before and behind an ideal lens may lie on either side of it */
    }
    double gap = direction * left->thickness.value.hi;
    if (gap < 0) {
        lens_warn(check,
                  arena_printf(check->arena, "the %s after surface %zu is negative: %.6g mm",
                               air ? "air gap" : "thickness", i + 1, left->thickness.value.hi));
        return;
    }
    if (!left->has_diameter || !right->has_diameter) {
        return;
    }
    double r = fmin(left->diameter.value.hi, right->diameter.value.hi) / 2;
    double edge = gap + direction * (surface_sag(right, r) - surface_sag(left, r));
    if (edge < -1e-9 * (1 + r) && surface_has(left, SURFACE_HAS_CURVE) &&
        surface_has(right, SURFACE_HAS_CURVE)) {
        lens_warn(check,
                  arena_printf(check->arena,
                               "surfaces %zu and %zu overlap inside their apertures (by %.3g mm at "
                               "%.6g mm from the axis)",
                               i + 1, i + 2, -edge, r));
    }
}

static bool check_position(const struct check *check, struct error *error)
{
    const struct lens *lens = check->lens;
    double direction = 1;
    for (size_t i = 0; i < lens->surface_count; i++) {
        const struct surface *surface = &lens->surfaces[i];
        if (!check_numbers(surface, i + 1, error)) {
            return false;
        }
        size_t number = i + 1;
        if (surface->has_diameter && isnan(surface_sag(surface, surface->diameter.value.hi / 2))) {
            lens_warn(check,
                      arena_printf(check->arena,
                                   "surface %zu: the diameter %.6g mm is beyond the sag's domain",
                                   number, surface->diameter.value.hi));
        }
        if (surface_is_cone(surface)) {
            lens_warn(check,
                      arena_printf(check->arena,
                                   "surface %zu is a cone at its vertex (A1): no ray is paraxial "
                                   "there, and paraxial results leave A1 out",
                                   number));
        }
        if (surface->medium.warning != NULL) {
            lens_warn(check, surface->medium.warning);
        }
        direction = surface_reflects(surface) ? -direction : direction;
        if (i + 1 < lens->surface_count) {
            check_gap(check, i, direction);
        }
    }
    if (!lens->object_is_infinite && !lens_is_sound(lens->object.value)) {
        return fail(error, ERROR_DATA, "the object's distance is beyond 1e100");
    }
    bool needs_value = lens->aperture_kind > APERTURE_STOP;
    return !needs_value || (lens->aperture.value.hi > 0 && lens_is_sound(lens->aperture.value)) ||
           fail(error, ERROR_DATA, "the aperture %.6g is not above 0", lens->aperture.value.hi);
}

static bool lens_check_stop(const struct lens *lens, struct error *error)
{
    size_t stops = 0, last = 0;
    for (size_t i = 0; i < lens->surface_count; i++) {
        if (lens->surfaces[i].is_stop && stops++ > 0) {
            return fail(error, ERROR_DATA, "two stops: surfaces %zu and %zu", last + 1, i + 1);
        }
        last = lens->surfaces[i].is_stop ? i : last;
    }
    if (lens->aperture_kind != APERTURE_STOP) {
        return true;
    }
    if (stops == 0) {
        return fail(error, ERROR_DATA, "'aperture stop' needs a stop, and the lens has none");
    }
    return lens->surfaces[last].has_diameter ||
           fail(error, ERROR_DATA, "'aperture stop' needs the diameter of the stop, surface %zu",
                last + 1);
}

bool lens_is_round(const struct lens *lens)
{
    for (size_t i = 0; i < lens->surface_count; i++) {
        const struct surface *surface = &lens->surfaces[i];
        if (surface->decentre != NULL || surface->coordinate_break != NULL ||
            !surface_is_round(surface)) {
            return false;
        }
        for (size_t k = 0; k < surface->aperture_count; k++) {
            if (!aperture_is_round(&surface->apertures[k])) {
                return false;
            }
        }
    }
    return true;
}

bool lens_check(const struct lens *lens, struct arena *arena, struct lens_warnings *warnings,
                struct error *error)
{
    *warnings = (struct lens_warnings){ARENA_ARRAY(arena, MOST_WARNINGS, const char *), 0};
    if (lens->surface_count == 0) {
        return fail(error, ERROR_DATA, "the lens has no surface");
    }
    if (lens->surface_count > LENS_MOST_SURFACES) {
        return fail(error, ERROR_DATA, "more than %d surfaces", LENS_MOST_SURFACES);
    }
    /* What its reader found doubtful. */
    if (lens->lost_power != NULL) {
        warnings->texts[warnings->count++] = lens->lost_power;
    }
    if (lens->cut_short != NULL) {
        warnings->texts[warnings->count++] = lens->cut_short;
    }
    for (size_t i = 0; i < lens->pickup_count; i++) {
        if (lens->pickups[i].warning != NULL && warnings->count < MOST_WARNINGS) {
            warnings->texts[warnings->count++] = lens->pickups[i].warning;
        }
    }
    size_t positions = lens->position_count > 0 ? lens->position_count : 1;
    for (size_t i = 0; i < positions; i++) {
        const bool is_far =
            lens->objects != NULL ? isinf(lens->objects[i].value.hi) : lens->object_is_infinite;
        if (lens->is_telecentric && is_far) {
            return fail(error, ERROR_DATA,
                        "a telecentric object space needs an object at a distance");
        }
        struct check check = {lens_at_position(lens, i, arena), arena, warnings, false};
        for (size_t j = 0; j < lens->surface_count; j++) {
            check.has_thick = check.has_thick || surface_has(&lens->surfaces[j], SURFACE_HAS_FOCAL);
        }
        if (!lens_check_stop(check.lens, error) || !check_position(&check, error)) {
            return false;
        }
    }
    return true;
}
