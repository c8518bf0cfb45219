/* exchange/zemax/zemax_positions.c - gaps and apertures of all configurations. */
/* SPDX-License-Identifier: MIT */
#include "exchange/zemax/zemax_solve.h"
#include "file/lens_unit.h"

#include <math.h>
#include <string.h>

enum { MOST_PASSES = 20 };

/* What stands in the file, before the solves. */
static bool read_thicknesses(struct zemax_file *file, struct figure *thickness, struct error *error)
{
    for (size_t i = 0; i < file->surface_count; i++) {
        const struct zemax_line *line = file->surfaces[i].thickness;
        bool inside = i > 0 && i + 1 < file->surface_count;
        if (inside && line != NULL && line->infinite && file->surfaces[i].solve == NULL) {
            return lens_words_fail(&line->words, line->first, error,
                                   "an infinite distance behind surface %zu", i);
        }
        thickness[i] = line != NULL && line->count > 0 ? line->numbers[0] : figure_zero();
    }
    return true;
}

/* The numbers of THIC in one configuration. */
static void set_configuration(struct solving *solving)
{
    const struct zemax_file *file = solving->file;
    for (const struct zemax_setting *one = file->settings; one != NULL; one = one->next) {
        bool here = one->configuration == (long)solving->position + 1 &&
                    one->surface < (long)file->surface_count;
        if (here && text_same(one->line->keyword, "THIC") && one->line->count > 2) {
            solving->thickness[one->surface] = one->line->numbers[2];
        }
    }
}

static bool is_same(const struct figure *a, const struct figure *b)
{
    return fabs(pair_subtract(a->value, b->value).hi) <= 4e-16 * (fabs(a->value.hi) + 1e-9);
}

/* With an f-number or a chief ray what is solved first depends on what is solved last: again. */
static bool solve_all(struct solving *solving, struct error *error)
{
    size_t count = solving->file->surface_count;
    struct figure *before = ARENA_ARRAY(solving->file->job->arena, 2 * count, struct figure);
    bool settled = false;
    for (int pass = 0; pass < MOST_PASSES && !settled; pass++) {
        memcpy(before, solving->thickness, count * sizeof before[0]);
        memcpy(before + count, solving->curvature, count * sizeof before[0]);
        for (size_t i = 1; i + 1 < count; i++) {
            if (!zemax_solve_surface(solving, i, error)) {
                return false;
            }
        }
        settled = true;
        for (size_t i = 0; i < count; i++) {
            settled = settled && is_same(&before[i], &solving->thickness[i]) &&
                      is_same(&before[count + i], &solving->curvature[i]);
        }
    }
    if (!settled) {
        fail(error, ERROR_DATA, "the solves of the file do not settle");
        return error_locate(error, solving->file->job->source, 0, 0);
    }
    return true;
}

static bool solve_position(struct solving *solving, struct error *error)
{
    const struct zemax_file *file = solving->file;
    struct surface *surfaces =
        ARENA_ARRAY(file->job->arena, file->build.lens->surface_count, struct surface);
    memcpy(surfaces, file->build.lens->surfaces,
           file->build.lens->surface_count * sizeof surfaces[0]);
    solving->lens = *file->build.lens;
    solving->lens.surfaces = surfaces;
    solving->lens.position_count = 0;
    set_configuration(solving);
    if (file->configurations > 1 && !solving->lens.object_is_infinite) {
        solving->lens.object = solving->thickness[0];
    }
    for (size_t i = 1; i + 1 < file->surface_count; i++) {
        if (solving->places[i] != LENS_NONE) {
            surfaces[solving->places[i]].thickness = solving->thickness[i];
        }
    }
    return solve_all(solving, error);
}

/* The same digits in all positions are a number, else a variable. */
static void set_thickness(struct zemax_file *file, struct surface *surface, size_t number,
                          const struct figure *values)
{
    bool same = true;
    for (size_t p = 1; p < file->configurations; p++) {
        same = same && values[p].value.hi == values[0].value.hi &&
               values[p].value.lo == values[0].value.lo;
    }
    if (same) {
        surface->thickness = values[0];
        return;
    }
    struct figure *copy = ARENA_ARRAY(file->job->arena, file->configurations, struct figure);
    memcpy(copy, values, file->configurations * sizeof copy[0]);
    const char *name = arena_printf(file->job->arena, "d%zu", number);
    surface->thickness = (struct figure){.typed = text_of(name),
                                         .variable = lens_build_variable(&file->build, name, copy)};
}

/* The object's distance in all positions. */
static bool set_objects(struct zemax_file *file, struct figure *const *thickness,
                        struct error *error)
{
    struct lens *lens = file->build.lens;
    const double far = 1e10;
    bool any = false;
    struct figure *objects = ARENA_ARRAY(file->job->arena, file->configurations, struct figure);
    for (const struct zemax_setting *one = file->settings; one != NULL; one = one->next) {
        any = any || (one->surface == 0 && text_same(one->line->keyword, "THIC"));
    }
    for (size_t p = 0; p < file->configurations && any; p++) {
        objects[p] = thickness[p][0];
        double distance = objects[p].value.hi;
        if (fabs(distance) >= far) {
            objects[p] = (struct figure){{INFINITY, 0}, text_of("inf"), LENS_NONE};
        } else if (!(distance > 0)) {
            fail(error, ERROR_DATA, "configuration %zu: the object is not before the lens", p + 1);
            return error_locate(error, file->job->source, 0, 0);
        }
    }
    if (any) {
        lens->objects = objects;
        lens->object = objects[0];
        lens->object_is_infinite = isinf(objects[0].value.hi);
    }
    return true;
}

static bool set_aperture(struct zemax_file *file, const struct zemax_setting *setting,
                         struct figure *apertures)
{
    struct lens *lens = file->build.lens;
    struct number_scale unit =
        lens->aperture_kind == APERTURE_EPD ? lens_unit_scale(lens->unit) : NUMBER_UNSCALED;
    struct figure figure = setting->line->numbers[2];
    pair_read(figure.typed.start, figure.typed.start + figure.typed.length, unit, &figure.value);
    apertures[setting->configuration - 1] = figure;
    lens->apertures = apertures;
    return figure.value.hi > 0;
}

static bool is_same_operand(const struct zemax_setting *a, const struct zemax_setting *b)
{
    return a != NULL && b != NULL && a->surface == b->surface &&
           memcmp(a->line->keyword.start, b->line->keyword.start, 4) == 0;
}

/* SDIA: the semi-diameters of one surface in all configurations, which stand together. */
static bool set_diameters(struct zemax_file *file, const size_t *places,
                          const struct zemax_setting *setting, struct error *error)
{
    struct lens *lens = file->build.lens;
    size_t place =
        setting->surface < (long)file->surface_count ? places[setting->surface] : LENS_NONE;
    if (place == LENS_NONE || lens->surfaces[place].diameter.variable != LENS_NONE) {
        return true;
    }
    const struct zemax_line *first = setting->line;
    struct figure *values = ARENA_ARRAY(file->job->arena, file->configurations, struct figure);
    for (size_t p = 0; p < file->configurations; p++) {
        bool next = setting != NULL && setting->configuration == (long)p + 1 &&
                    zemax_number(setting->line, 2) > 0;
        if (!next) {
            return zemax_loss(file, setting != NULL ? setting->line : first, error,
                              "semi-diameters that are not one for each configuration");
        }
        struct pair half = setting->line->numbers[2].value;
        values[p] = figure_computed((struct pair){2 * half.hi, 2 * half.lo},
                                    lens_unit_scale(lens->unit), file->job->arena);
        setting = is_same_operand(setting, setting->next) ? setting->next : NULL;
    }
    const char *name = arena_printf(file->job->arena, "D%zu", place + 1);
    lens->surfaces[place].has_diameter = true;
    lens->surfaces[place].diameter = (struct figure){
        .typed = text_of(name), .variable = lens_build_variable(&file->build, name, values)};
    return true;
}

static bool is_aperture(const struct zemax_file *file, const struct zemax_line *line)
{
    return text_same(line->keyword, "APER") && line->count > 2 &&
           file->build.lens->aperture_kind > APERTURE_STOP;
}

/* One that lenscalc has no positions of: its value must be the same in all configurations. */
static bool check_constant(struct zemax_file *file, const struct zemax_setting *before,
                           const struct zemax_setting *one, struct error *error)
{
    bool varies =
        is_same_operand(before, one) && zemax_number(before->line, 2) != zemax_number(one->line, 2);
    return !varies || text_same(one->line->keyword, "THIC") ||
           zemax_loss(file, one->line, error,
                      "%.4s %ld changes between the configurations" LOSS_INSTEAD
                      "the first one's value stands",
                      one->line->keyword.start, one->surface);
}

/* All operands but THIC: an aperture each, or the same value in all configurations. */
static bool check_settings(struct zemax_file *file, const size_t *places, struct error *error)
{
    struct lens *lens = file->build.lens;
    struct figure *apertures = ARENA_ARRAY(file->job->arena, file->configurations, struct figure);
    const struct zemax_setting *before = NULL;
    for (size_t p = 0; p < file->configurations; p++) {
        apertures[p] = lens->aperture;
    }
    for (const struct zemax_setting *one = file->settings; one != NULL; one = one->next) {
        const struct zemax_line *line = one->line;
        if (is_aperture(file, line)) {
            if (!set_aperture(file, one, apertures)) {
                return lens_words_fail(&line->words, line->numbers[2].typed, error,
                                       "the aperture must be above 0");
            }
        } else if (text_same(line->keyword, "SDIA")) {
            if (!set_diameters(file, places, one, error)) {
                return false;
            }
        } else if (!check_constant(file, before, one, error)) {
            return false;
        }
        before = one;
    }
    lens->aperture = lens->apertures != NULL ? apertures[0] : lens->aperture;
    return true;
}

/* The curvatures of the first position; others are lost. */
static bool set_curvatures(struct zemax_file *file, const size_t *places,
                           struct figure *const *curvature, struct error *error)
{
    for (size_t i = 1; i + 1 < file->surface_count; i++) {
        const struct zemax_line *line = file->surfaces[i].curvature;
        if (curvature[0][i].typed.start == NULL || file->surfaces[i].has_free_curvature) {
            continue;
        }
        bool same = true;
        for (size_t p = 1; p < file->configurations; p++) {
            same = same && is_same(&curvature[0][i], &curvature[p][i]);
        }
        if (!same && !zemax_loss(file, line, error,
                                 "a curvature that is solved in every configuration" LOSS_INSTEAD
                                 "that of the first stands")) {
            return false;
        }
        zemax_set_curvature(file, curvature[0][i], &file->build.lens->surfaces[places[i]]);
    }
    return true;
}

/* Solves that follow a ray through many surfaces take their time. */
static bool check_work(struct zemax_file *file, struct error *error)
{
    const double most = 1e6; /* about a second */
    double work = 0;
    for (size_t i = 0; i < file->surface_count; i++) {
        work +=
            (file->surfaces[i].solve != NULL) + (zemax_number(file->surfaces[i].curvature, 1) >= 2);
    }
    work *= (double)file->surface_count * (double)file->configurations;
    if (work > most) {
        fail(error, ERROR_DATA, "too many solves");
        return error_locate(error, file->job->source, 0, 0);
    }
    return true;
}

/* The digits that all positions have in common are a number, else a variable. */
static void set_thicknesses(struct zemax_file *file, const size_t *places,
                            struct figure *const *thickness)
{
    struct lens *lens = file->build.lens;
    struct figure *values = ARENA_ARRAY(file->job->arena, file->configurations, struct figure);
    for (size_t i = 1; i + 1 < file->surface_count; i++) {
        for (size_t p = 0; p < file->configurations; p++) {
            values[p] = thickness[p][i];
        }
        if (places[i] != LENS_NONE) {
            set_thickness(file, &lens->surfaces[places[i]], places[i] + 1, values);
        }
    }
    struct surface *last = &lens->surfaces[lens->surface_count - 1];
    last->has_thickness = !zemax_focuses(file) || last->thickness.variable != LENS_NONE ||
                          last->thickness.value.hi != 0;
}

bool zemax_thicknesses(struct zemax_file *file, const size_t *places, struct error *error)
{
    struct arena *arena = file->job->arena;
    size_t positions = file->configurations;
    struct figure **thickness = ARENA_ARRAY(arena, positions, struct figure *);
    struct figure **curvature = ARENA_ARRAY(arena, positions, struct figure *);
    if (!check_work(file, error)) {
        return false;
    }
    for (size_t p = 0; p < positions; p++) {
        struct solving solving = {.file = file, .places = places, .position = p};
        solving.thickness = thickness[p] = ARENA_ARRAY(arena, file->surface_count, struct figure);
        solving.curvature = curvature[p] = ARENA_ARRAY(arena, file->surface_count, struct figure);
        solving.unit = lens_unit_scale(file->build.lens->unit);
        if (!read_thicknesses(file, thickness[p], error) || !solve_position(&solving, error)) {
            return false;
        }
        if (p == 0) {
            zemax_remark_solves(&solving);
        }
    }
    set_thicknesses(file, places, thickness);
    return set_curvatures(file, places, curvature, error) && set_objects(file, thickness, error) &&
           check_settings(file, places, error);
}
