/* analysis/rays/clear_diameters.c - diameters of surfaces from the beams that cross them. */
/* SPDX-License-Identifier: MIT */
#include "analysis/rays/clear_diameters.h"

#include "analysis/pupil/bundle.h"
#include "base/constants.h"
#include "optics/parameter.h"
#include "trace/follow.h"

#include <math.h>

enum { DIRECTIONS = 64 };

/* Heights in the stop, in units of its radius: near a caustic the rim is not the outermost. */
static const double heights[] = {1, 0.9, 0.7, 0.4};
enum { HEIGHTS = sizeof heights / sizeof heights[0] };

/* How far out light comes, mm. */
struct clear_reach {
    const struct clear_diameters_question *question;
    struct arena *arena;
    double *reach; /* one a surface */
};

/* "field 14 deg", "field height 3 mm", with x where there is one. */
static const char *field_in_words(const struct field_point *field, struct arena *arena)
{
    const bool is_angle = field->kind == FIELD_ANGLE;
    const double scale = is_angle ? DEGREES_PER_RADIAN : 1;
    const char *unit = is_angle ? "deg" : "mm";
    if (field->kind == FIELD_NONE) {
        return "the axis";
    }
    return field->value[0] != 0
               ? arena_printf(arena, "field %.4g, %.4g %s", scale * field->value[0],
                              scale * field->value[1], unit)
               : arena_printf(arena, "field %.4g %s", scale * field->value[1], unit);
}

/* All rays of a field at a wavelength. */
static bool clear_reach_add_field(struct clear_reach *clear, const struct setup *setup,
                                  size_t wavelength, const struct field_point *field,
                                  struct error *error)
{
    struct arena *arena = clear->arena;
    const size_t surfaces = setup->lens->surface_count;
    const struct bundle_question asked = {
        .setup = setup, .field = field, .wavelength = wavelength, .pattern = PATTERN_HEXAPOLAR};
    struct pupil_point points[DIRECTIONS * HEIGHTS];
    struct bundle_source source;
    for (size_t i = 0; i < DIRECTIONS * HEIGHTS; i++) {
        const double angle = 2 * PI * (double)(i % DIRECTIONS) / DIRECTIONS;
        const double height = heights[i / DIRECTIONS];
        points[i] = (struct pupil_point){height * cos(angle), height * sin(angle), 1};
    }
    if (!bundle_open(&asked, arena, &source, error)) {
        return error_prefix(error, "%s: ", field_in_words(field, arena));
    }
    if (!source.has_chief) {
        return fail(error, ERROR_DOMAIN, "%s has no chief ray", field_in_words(field, arena));
    }
    struct ray_intersection *meetings =
        ARENA_ARRAY(arena, source.open->places + 1, struct ray_intersection);
    struct rays rays = rays_new(arena, DIRECTIONS * HEIGHTS);
    bundle_aim(&source, points, DIRECTIONS * HEIGHTS, &rays);
    for (size_t i = 0; i < rays.count; i++) {
        const struct arena_mark mark = arena_mark(arena);
        const struct ray start = rays_get(&rays, i, source.open->index_first);
        struct ray last = start;
        if (start.status == RAY_OK) {
            ray_follow(source.open, &start, arena, meetings);
        }
        for (size_t k = 0; k < surfaces && last.status == RAY_OK; k++) {
            last = meetings[k].ray;
            clear->reach[k] = fmax(clear->reach[k], hypot(last.point[0], last.point[1]));
        }
        arena_reset(arena, mark);
        if (last.status != RAY_OK) {
            fail(error, ERROR_DOMAIN,
                 "surfaces cannot be as large as the beam: a ray of %s%s is lost at surface %zu",
                 field_in_words(field, arena),
                 hypot(points[i].x, points[i].y) > 0.95 ? " at the edge of the pupil" : "",
                 last.surface);
            return error_hint(error,
                              "a smaller field or a larger f-number has a beam that arrives");
        }
    }
    return true;
}

static bool clear_reach_add_position(struct clear_reach *clear, size_t position,
                                     struct error *error)
{
    const struct clear_diameters_question *question = clear->question;
    const struct setup_question asked = {.lens = question->lens,
                                         .position = position,
                                         .section = SECTION_Y,
                                         .wavelength = NAN,
                                         .wavelengths = WAVELENGTHS_ALL,
                                         .spectrum = question->wavelengths,
                                         .spectrum_count = question->wavelength_count,
                                         .fnumber = question->fnumber,
                                         .fields = question->fields,
                                         .field_count = question->field_count,
                                         .field_policy = FIELDS_ALL,
                                         .takes_telecentric = true};
    struct setup setup;
    if (!setup_open(&asked, clear->arena, &setup, error) ||
        !setup_place_image(&setup, &(struct plane_value){.kind = PLANE_OF_LENS}, error)) {
        return false;
    }
    for (size_t f = 0; f < setup.field_count; f++) {
        for (size_t w = 0; w < setup.wavelength_count; w++) {
            if (!clear_reach_add_field(clear, &setup, w, &setup.fields[f].point, error)) {
                return setup.position != NULL && error_prefix(error, "%s: ", setup.position);
            }
        }
    }
    return true;
}

/* Does a surface get a diameter of the beam? */
static bool clear_diameters_concern(const struct lens *lens, size_t i)
{
    const struct surface *surface = &lens->surfaces[i];
    const bool is_stop = i == lens->stop || surface->kind == SURFACE_STOP;
    if (is_stop && (surface->has_diameter || surface->kind == SURFACE_STOP)) {
        return false;
    }
    return !surface->has_diameter || surface->diameter.variable == LENS_NONE;
}

/* To 4 digits, upwards; not for what is rounding. */
static double rounded_up(double length)
{
    const double step = pow(10, 3 - floor(log10(length)));
    return step < 1e300 && step > 1e-300 ? ceil(length * step * (1 - 1e-9)) / step : length;
}

/* The diameter of a surface that light reaches so far out; `short_of` is set where it has less than
   the margin. */
static double clear_diameter(const struct surface *surface, double reach, double margin,
                             bool *short_of)
{
    double share = margin, least = 0;
    if (!isnan(surface_sag(surface, rounded_up(2 * reach * (1 + margin)) / 2))) {
        return rounded_up(2 * reach * (1 + margin));
    }
    *short_of = true;
    for (int step = 0; step < 50; step++) {
        const double middle = (least + share) / 2;
        if (isnan(surface_sag(surface, reach * (1 + middle)))) {
            share = middle;
        } else {
            least = middle;
        }
    }
    return 2 * reach * (1 + least);
}

bool clear_diameters_find(const struct clear_diameters_question *question, struct arena *arena,
                          const struct lens **found, const char **notes, struct error *error)
{
    const struct lens *lens = question->lens;
    const size_t positions = lens->position_count > 0 ? lens->position_count : 1;
    struct clear_reach clear = {.question = question,
                                .arena = arena,
                                .reach = ARENA_ARRAY(arena, lens->surface_count, double)};
    struct lens *sized = lens_copy(lens, arena);
    *notes = NULL;
    for (size_t p = 0; p < positions; p++) {
        if (!clear_reach_add_position(&clear, p, error)) {
            return false;
        }
    }
    for (size_t i = 0; i < lens->surface_count; i++) {
        struct surface *surface = &sized->surfaces[i];
        bool short_of = false;
        if (!clear_diameters_concern(lens, i) || !(clear.reach[i] > 0)) {
            continue;
        }
        const double diameter =
            clear_diameter(surface, clear.reach[i], question->margin, &short_of);
        surface->has_diameter = true;
        surface->diameter = figure_number(pair_of(diameter));
        if (short_of) {
            *notes = arena_printf(arena,
                                  "%s%ssurface %zu ends %.3g %% beyond the beam, at a diameter of "
                                  "%.6g mm: that is its margin",
                                  *notes != NULL ? *notes : "", *notes != NULL ? "; " : "", i + 1,
                                  100 * (diameter / (2 * clear.reach[i]) - 1), diameter);
        }
    }
    *found = sized;
    return true;
}
