/* file/zemax_solve.c - thicknesses of a .zmx file: solves, pick-ups, configurations. */
/* SPDX-License-Identifier: MIT */
#include "file/lens_solve.h"
#include "file/zemax_surface.h"

#include <math.h>
#include <string.h>

/* The thicknesses in one position, by the file's surface numbers. */
struct solving {
    struct zemax_file *file;
    const size_t *places;
    struct lens lens; /* in this position */
    struct figure *thickness;
    size_t position;
    struct number_scale unit;
};

/* A number that was read without a unit, as a length. */
static struct pair length_of(const struct solving *solving, const struct zemax_line *line,
                             size_t at)
{
    struct pair value = {0, 0};
    if (at < line->count) {
        struct text typed = line->numbers[at].typed;
        pair_read(typed.start, typed.start + typed.length, solving->unit, &value);
    }
    return value;
}

static struct figure rounded(const struct solving *solving, struct pair value)
{
    return figure_rounded(value, solving->unit, solving->file->job->arena);
}

/* The number that stands in the file is kept, and the solve is lost. */
static bool keep(const struct solving *solving, const struct zemax_line *line, const char *why,
                 struct error *error)
{
    return zemax_loss(solving->file, line, error, "a solve that %s: the file's number stands", why);
}

static bool marginal(struct solving *solving, size_t at, const struct zemax_line *line,
                     struct figure *figure, struct error *error)
{
    struct solve_state state;
    if (zemax_number(line, 1) != 0) {
        return keep(solving, line, "follows a real ray", error);
    }
    if (!solve_follow(&solving->lens, solving->places[at], SOLVE_MARGINAL,
                      solving->file->job->arena, &state, error)) {
        return foreign_loss(solving->file->job, &line->words, line->keyword, error,
                            "the solve has no answer (%s): the file's number stands",
                            error->message);
    }
    struct pair value = solve_thickness(&state, length_of(solving, line, 0));
    if (!(fabs(value.hi) < 1e12)) {
        return keep(solving, line, "has its answer at infinity", error);
    }
    *figure = rounded(solving, value);
    return true;
}

/* PZUP surface scale offset */
static bool pick_up(struct solving *solving, size_t at, const struct zemax_line *line,
                    struct figure *figure, struct error *error)
{
    double from = zemax_number(line, 0);
    if (line->count < 2 || !(from >= 0 && from < (double)at)) {
        return keep(solving, line, "follows no earlier surface", error);
    }
    struct pair value =
        pair_multiply(solving->thickness[(size_t)from].value, line->numbers[1].value);
    *figure = figure_computed(pair_add(value, length_of(solving, line, 2)), solving->unit,
                              solving->file->job->arena);
    return true;
}

/* TCOM i sum: t_i and this one; TOLE i sum: all from t_i to this one. */
static bool compensate(struct solving *solving, size_t at, const struct zemax_line *line,
                       struct figure *figure, struct error *error)
{
    double from = zemax_number(line, 0);
    bool all = text_same(line->keyword, "TOLE");
    if (line->count < 2 || !(from >= 1 && from < (double)at)) {
        return keep(solving, line, "follows no earlier surface", error);
    }
    struct pair value = length_of(solving, line, 1);
    for (size_t i = (size_t)from; i < (all ? at : (size_t)from + 1); i++) {
        value = pair_subtract(value, solving->thickness[i].value);
    }
    *figure = figure_computed(value, solving->unit, solving->file->job->arena);
    return true;
}

/* EDGE thickness height: 0 is the height of the surface's own rim */
static bool edge(struct solving *solving, size_t at, const struct zemax_line *line,
                 struct figure *figure, struct error *error)
{
    size_t place = solving->places[at];
    const struct surface *surface = &solving->lens.surfaces[place];
    double height = length_of(solving, line, 1).hi;
    if (height == 0 && surface->has_diameter) {
        height = surface->diameter.value.hi / 2;
    }
    bool last = place + 1 >= solving->lens.surface_count;
    double sags = surface_sag(surface, height) - (last ? 0 : surface_sag(surface + 1, height));
    if (!(height > 0) || !isfinite(sags)) {
        return keep(solving, line, "has no rim", error);
    }
    *figure = rounded(solving, pair_add(length_of(solving, line, 0), pair_of(sags)));
    return true;
}

static const struct {
    const char *word;
    bool (*solve)(struct solving *solving, size_t at, const struct zemax_line *line,
                  struct figure *figure, struct error *error);
} solves[] = {{"MAZH", marginal},
              {"PZUP", pick_up},
              {"TCOM", compensate},
              {"TOLE", compensate},
              {"EDGE", edge}};

bool zemax_focuses(const struct zemax_file *file)
{
    const struct zemax_line *solve = file->surfaces[file->surface_count - 2].solve;
    return solve != NULL && text_same(solve->keyword, "MAZH") && zemax_number(solve, 0) == 0 &&
           zemax_number(solve, 1) == 0;
}

/* The last solve only says where the image is: the file's number stays beside it. */
static bool solve_one(struct solving *solving, size_t at, struct error *error)
{
    const struct zemax_file *file = solving->file;
    bool focus = at + 2 == file->surface_count && zemax_focuses(file);
    const struct zemax_line *line = focus ? NULL : file->surfaces[at].solve;
    struct figure *figure = &solving->thickness[at];
    for (size_t i = 0; line != NULL && i < sizeof solves / sizeof solves[0]; i++) {
        if (text_same(line->keyword, solves[i].word) &&
            !solves[i].solve(solving, at, line, figure, error)) {
            return false;
        }
    }
    if (solving->places[at] != LENS_NONE) {
        solving->lens.surfaces[solving->places[at]].thickness = *figure;
    }
    return true;
}

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
    for (size_t i = 1; i + 1 < file->surface_count; i++) {
        if (!solve_one(solving, i, error)) {
            return false;
        }
    }
    return true;
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
    struct figure *values = ARENA_ARRAY(file->job->arena, file->configurations, struct figure);
    for (size_t p = 0; p < file->configurations; p++) {
        bool next = setting != NULL && setting->configuration == (long)p + 1 &&
                    zemax_number(setting->line, 2) > 0;
        if (!next) {
            return setting == NULL ||
                   zemax_loss(file, setting->line, error,
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
        bool aperture = text_same(line->keyword, "APER") && line->count > 2 &&
                        lens->aperture_kind > APERTURE_STOP;
        bool varies =
            is_same_operand(before, one) && zemax_number(before->line, 2) != zemax_number(line, 2);
        if (aperture && !set_aperture(file, one, apertures)) {
            return lens_words_fail(&line->words, line->numbers[2].typed, error,
                                   "the aperture must be above 0");
        }
        bool diameter = text_same(line->keyword, "SDIA");
        if (diameter && !set_diameters(file, places, one, error)) {
            return false;
        }
        if (varies && !aperture && !diameter && !text_same(line->keyword, "THIC") &&
            !zemax_loss(file, line, error,
                        "%.4s %ld changes between the configurations: the first one's value "
                        "stands",
                        line->keyword.start, one->surface)) {
            return false;
        }
        before = one;
    }
    lens->aperture = lens->apertures != NULL ? apertures[0] : lens->aperture;
    return true;
}

/* Solves that follow a ray through many surfaces take their time. */
static bool check_work(struct zemax_file *file, struct error *error)
{
    const double most = 1e6; /* about a second */
    double work = 0;
    for (size_t i = 0; i < file->surface_count; i++) {
        work += file->surfaces[i].solve != NULL;
    }
    work *= (double)file->surface_count * (double)file->configurations;
    if (work > most) {
        fail(error, ERROR_DATA, "too many solves");
        return error_locate(error, file->job->source, 0, 0);
    }
    return true;
}

bool zemax_thicknesses(struct zemax_file *file, const size_t *places, struct error *error)
{
    struct lens *lens = file->build.lens;
    struct arena *arena = file->job->arena;
    size_t positions = file->configurations;
    struct figure **thickness = ARENA_ARRAY(arena, positions, struct figure *);
    struct figure *values = ARENA_ARRAY(arena, positions, struct figure);
    if (!check_work(file, error)) {
        return false;
    }
    for (size_t p = 0; p < positions; p++) {
        struct solving solving = {.file = file, .places = places, .position = p};
        thickness[p] = ARENA_ARRAY(arena, file->surface_count, struct figure);
        solving.thickness = thickness[p];
        solving.unit = lens_unit_scale(lens->unit);
        if (!read_thicknesses(file, thickness[p], error) || !solve_position(&solving, error)) {
            return false;
        }
    }
    for (size_t i = 1; i + 1 < file->surface_count; i++) {
        for (size_t p = 0; p < positions; p++) {
            values[p] = thickness[p][i];
        }
        if (places[i] != LENS_NONE) {
            set_thickness(file, &lens->surfaces[places[i]], places[i] + 1, values);
        }
    }
    struct surface *last = &lens->surfaces[lens->surface_count - 1];
    last->has_thickness = !zemax_focuses(file) || last->thickness.variable != LENS_NONE ||
                          last->thickness.value.hi != 0;
    return set_objects(file, thickness, error) && check_settings(file, places, error);
}
