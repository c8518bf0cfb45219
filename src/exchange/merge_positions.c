/* exchange/merge_positions.c - one lens with positions, of lenses that differ in numbers. */
/* SPDX-License-Identifier: MIT */
#include "exchange/merge_positions.h"

#include "optics/aperture.h"

#include <math.h>
#include <string.h>

/* Lenses being merged. */
struct merge {
    struct lens_build *build;
    struct arena *arena;
    struct foreign_job *job;
    const struct lens *lenses;
    size_t count;
    struct lens_setting *settings;
    size_t setting_count, setting_room;
};

static bool is_equal_pair(const struct figure *a, const struct figure *b)
{
    return a->value.hi == b->value.hi && a->value.lo == b->value.lo;
}

static const struct surface *surface_in(const struct merge *merge, size_t position, size_t index)
{
    return &merge->lenses[position].surfaces[index];
}

/* A plane that is only the stop counts as any other: it may be the stop in one position. */
static enum surface_kind kind_in_positions(const struct surface *surface)
{
    return surface->kind == SURFACE_STOP ? SURFACE_REFRACT : surface->kind;
}

static bool is_same_aperture(const struct aperture *a, const struct aperture *b)
{
    bool same = a->shape == b->shape && a->blocks == b->blocks && a->arms == b->arms &&
                a->point_count == b->point_count && is_equal_pair(&a->turn, &b->turn);
    for (int i = 0; i < 2; i++) {
        same = same && is_equal_pair(&a->size[i], &b->size[i]) &&
               is_equal_pair(&a->decenter[i], &b->decenter[i]);
    }
    for (size_t i = 0; same && i < a->point_count; i++) {
        same = is_equal_pair(&a->points[i][0], &b->points[i][0]) &&
               is_equal_pair(&a->points[i][1], &b->points[i][1]);
    }
    return same;
}

static bool are_same_apertures(const struct surface *a, const struct surface *b)
{
    bool same = a->aperture_count == b->aperture_count;
    for (size_t i = 0; same && i < a->aperture_count; i++) {
        same = is_same_aperture(&a->apertures[i], &b->apertures[i]);
    }
    return same;
}

/* What no position can set. */
static bool is_surface_alike(const struct surface *a, const struct surface *b)
{
    bool same = kind_in_positions(a) == kind_in_positions(b) && a->curved == b->curved &&
                a->has_thickness == b->has_thickness;
    for (int i = 0; i < 3 && same && surface_has(a, SURFACE_HAS_FOCAL); i++) {
        same = is_equal_pair(&a->distortion[i], &b->distortion[i]);
    }
    return same;
}

/* One number a position, all the same? */
static bool are_all_same(const struct figure *figures, size_t count)
{
    bool same = true;
    for (size_t p = 1; p < count; p++) {
        same = same && is_equal_pair(&figures[p], &figures[0]);
    }
    return same;
}

static struct figure merge_variable(struct merge *merge, const char *prefix, size_t number,
                                    const struct figure *values)
{
    const char *name = arena_printf(merge->arena, "%s%zu", prefix, number);
    return (struct figure){.typed = text_of(name),
                           .variable = lens_build_variable(merge->build, name, values)};
}

/* Thickness and diameter. */
static void merge_cells(struct merge *merge, size_t index)
{
    struct surface *to = &merge->build->lens->surfaces[index];
    struct figure *gaps = ARENA_ARRAY(merge->arena, merge->count, struct figure);
    struct figure *diameters = ARENA_ARRAY(merge->arena, merge->count, struct figure);
    for (size_t p = 0; p < merge->count; p++) {
        gaps[p] = surface_in(merge, p, index)->thickness;
        diameters[p] = surface_in(merge, p, index)->diameter;
    }
    if (to->has_thickness && !are_all_same(gaps, merge->count)) {
        to->thickness = merge_variable(merge, "d", index + 1, gaps);
    }
    size_t clear = 0;
    for (size_t p = 0; p < merge->count; p++) {
        clear += surface_in(merge, p, index)->has_diameter;
    }
    if (clear == merge->count && !are_all_same(diameters, merge->count)) {
        to->diameter = merge_variable(merge, "D", index + 1, diameters);
    }
    to->has_diameter = clear == merge->count;
    if (clear != 0 && clear != merge->count) {
        foreign_lose(merge->job, LOSS_OF_VIGNETTING, "it gets none",
                     "the clear aperture that surface %zu has in some configurations", index + 1);
    }
}

static void merge_add_setting(struct merge *merge, struct lens_setting setting)
{
    *ARENA_ADD(merge->arena, merge->settings, merge->setting_count, merge->setting_room) = setting;
}

/* The radius, infinite of a plane; or, where a position has a curvature, the curvature. */
static void merge_curve(struct merge *merge, size_t index)
{
    struct surface *to = &merge->build->lens->surfaces[index];
    struct figure *figures = ARENA_ARRAY(merge->arena, merge->count, struct figure);
    enum parameter_kind kind = PARAMETER_RADIUS;
    for (size_t p = 0; p < merge->count; p++) {
        kind = surface_in(merge, p, index)->has_curvature ? PARAMETER_CURVATURE : kind;
    }
    for (size_t p = 0; p < merge->count; p++) {
        const struct surface *from = surface_in(merge, p, index);
        const struct figure *figure = parameter_figure(from, kind, 0);
        struct figure flat = {{INFINITY, 0}, text_of("inf"), LENS_NONE};
        if (figure != NULL) {
            figures[p] = *figure;
        } else if (kind == PARAMETER_RADIUS) {
            figures[p] = flat;
        } else {
            figures[p] =
                (struct figure){.value = surface_base_curvature(from), .variable = LENS_NONE};
        }
    }
    if (are_all_same(figures, merge->count)) {
        return;
    }
    parameter_put(to, kind, 0, figures[0], merge->arena);
    merge_add_setting(merge, (struct lens_setting){{index, kind, 0}, figures, NULL});
}

static void merge_medium(struct merge *merge, size_t index)
{
    struct medium *media = ARENA_ARRAY(merge->arena, merge->count, struct medium);
    bool same = true;
    for (size_t p = 0; p < merge->count; p++) {
        media[p] = surface_in(merge, p, index)->medium;
        same = same && medium_is_same(&media[p], &media[0]);
    }
    if (!same && !surface_reflects(surface_in(merge, 0, index))) {
        merge_add_setting(merge, (struct lens_setting){{index, PARAMETER_GLASS, 0}, NULL, media});
    }
}

/* All other numbers that a surface may have; where one position has one, it is 0 in the others. */
static void merge_number(struct merge *merge, size_t index, struct parameter each)
{
    struct surface *to = &merge->build->lens->surfaces[index];
    struct figure *figures = ARENA_ARRAY(merge->arena, merge->count, struct figure);
    bool any = false;
    for (size_t p = 0; p < merge->count; p++) {
        const struct figure *figure =
            parameter_figure(surface_in(merge, p, index), each.kind, each.order);
        any = any || figure != NULL;
        figures[p] = figure != NULL ? *figure : figure_zero();
    }
    if (any && !are_all_same(figures, merge->count)) {
        parameter_put(to, each.kind, each.order, figures[0], merge->arena);
        each.surface = index;
        merge_add_setting(merge, (struct lens_setting){each, figures, NULL});
    }
}

static void take_first_lens(const struct merge *merge)
{
    struct lens_build *build = merge->build;
    *build->lens = merge->lenses[0];
    build->note_room = build->lens->note_count;
    build->wavelength_room = build->lens->wavelength_count;
    build->field_room = build->lens->field_count;
    build->surface_room = build->lens->surface_count;
}

/* What no position can set: the first alone is kept. */
static void keep_first_lens(const struct merge *merge, const char *in)
{
    take_first_lens(merge);
    merge->build->lens->positions = NULL;
    merge->build->lens->position_count = 0;
    merge->build->variable_room = 0;
    foreign_lose(merge->job, LOSS_OF_RAYS, "only the first is kept",
                 "the configurations differ in %s, which the positions of a lens cannot", in);
}

/* False where only the first is kept. */
static bool merge_surface(struct merge *merge, size_t index)
{
    const struct surface *first = surface_in(merge, 0, index);
    for (size_t p = 1; p < merge->count; p++) {
        if (!is_surface_alike(first, surface_in(merge, p, index))) {
            keep_first_lens(merge,
                            arena_printf(merge->arena, "the kind of surface %zu", index + 1));
            return false;
        }
        if (!are_same_apertures(first, surface_in(merge, p, index))) {
            foreign_lose(merge->job, LOSS_OF_VIGNETTING, "those of the first are kept",
                         "the apertures of surface %zu differ between the configurations",
                         index + 1);
        }
    }
    merge_cells(merge, index);
    if (surface_has(first, SURFACE_HAS_CURVE)) {
        merge_curve(merge, index);
    }
    merge_medium(merge, index);
    for (struct parameter each = {0}; each.kind < PARAMETER_KINDS; each = parameter_next(each)) {
        bool other = each.kind != PARAMETER_RADIUS && each.kind != PARAMETER_CURVATURE &&
                     each.kind != PARAMETER_THICKNESS;
        if (other && parameter_suits(each.kind, first)) {
            merge_number(merge, index, each);
        }
    }
    return true;
}

/* The object's distance; the aperture's value, where it is not the stop's diameter. */
static void merge_object_and_aperture(struct merge *merge)
{
    struct lens *lens = merge->build->lens;
    struct figure *objects = ARENA_ARRAY(merge->arena, merge->count, struct figure);
    struct figure *apertures = ARENA_ARRAY(merge->arena, merge->count, struct figure);
    for (size_t p = 0; p < merge->count; p++) {
        objects[p] = merge->lenses[p].object;
        apertures[p] = merge->lenses[p].aperture;
        if (merge->lenses[p].object_is_infinite) {
            objects[p] = (struct figure){{INFINITY, 0}, text_of("inf"), LENS_NONE};
        }
    }
    lens->objects = are_all_same(objects, merge->count) ? NULL : objects;
    bool one = lens->aperture_kind <= APERTURE_STOP || are_all_same(apertures, merge->count);
    lens->apertures = one ? NULL : apertures;
}

static bool is_same_light(const struct lens *a, const struct lens *b)
{
    bool same = a->wavelength_count == b->wavelength_count;
    for (size_t i = 0; same && i < a->wavelength_count; i++) {
        same = a->wavelengths[i].wavelength == b->wavelengths[i].wavelength &&
               a->wavelengths[i].weight == b->wavelengths[i].weight;
    }
    return same;
}

static void merge_light_and_stop(struct merge *merge)
{
    struct lens *lens = merge->build->lens;
    struct lens_light *lights = ARENA_ARRAY(merge->arena, merge->count, struct lens_light);
    size_t *stops = ARENA_ARRAY(merge->arena, merge->count, size_t);
    bool same_light = true, same_stop = true;
    for (size_t p = 0; p < merge->count; p++) {
        const struct lens *one = &merge->lenses[p];
        lights[p] = (struct lens_light){one->wavelengths, one->wavelength_count};
        stops[p] = one->stop;
        same_light = same_light && is_same_light(one, &merge->lenses[0]);
        same_stop = same_stop && one->stop == stops[0];
    }
    lens->lights = same_light ? NULL : lights;
    lens->stops = same_stop ? NULL : stops;
}

static bool are_same_fields(const struct lens *a, const struct lens *b)
{
    bool same = a->field_count == b->field_count;
    for (size_t i = 0; same && i < a->field_count; i++) {
        same = lens_field_is_same(&a->fields[i], &b->fields[i]);
    }
    return same;
}

/* The fields, of one kind in all positions. */
static void merge_fields(struct merge *merge)
{
    struct lens *lens = merge->build->lens;
    struct lens_points *points = ARENA_ARRAY(merge->arena, merge->count, struct lens_points);
    bool same_kind = true, same = true;
    for (size_t p = 0; p < merge->count; p++) {
        const struct lens *one = &merge->lenses[p];
        points[p] = (struct lens_points){one->fields, one->field_count};
        same_kind = same_kind && one->field_kind == lens->field_kind &&
                    (one->field_count > 0) == (lens->field_count > 0);
        same = same && are_same_fields(&merge->lenses[0], one);
    }
    lens->points = same_kind && !same ? points : NULL;
    if (!same_kind) {
        foreign_lose(merge->job, LOSS_OF_RAYS, "those of the first are kept",
                     "the kind of the fields differs between the configurations");
    }
}

/* What has no values of its own in the positions. */
static const char *what_differs(const struct lens *a, const struct lens *b)
{
    if (a->surface_count != b->surface_count) {
        return "the number of surfaces";
    }
    if (a->aperture_kind != b->aperture_kind) {
        return "the kind of aperture";
    }
    if ((a->wavelength_count == 0) != (b->wavelength_count == 0)) {
        return "whether there are wavelengths";
    }
    if (a->focus != b->focus) {
        return "where the image is";
    }
    if ((a->stop == LENS_NONE) != (b->stop == LENS_NONE)) {
        return "whether there is a stop";
    }
    if (!medium_is_same(&a->object_medium, &b->object_medium)) {
        return "the medium of the object";
    }
    if (a->is_telecentric != b->is_telecentric) {
        return "whether the object space is telecentric";
    }
    return NULL;
}

void merge_positions(struct lens_build *build, const struct lens *lenses, struct foreign_job *job)
{
    struct lens *to = build->lens;
    const struct lens *first = &lenses[0];
    struct merge merge = {.build = build,
                          .arena = build->arena,
                          .job = job,
                          .lenses = lenses,
                          .count = to->position_count};
    const struct lens named = *to;
    for (size_t p = 1; p < merge.count; p++) {
        const char *why = what_differs(first, &lenses[p]);
        if (why != NULL) {
            keep_first_lens(&merge, why);
            return;
        }
    }
    take_first_lens(&merge);
    to->positions = named.positions;
    to->position_count = named.position_count;
    to->surfaces = ARENA_COPY(merge.arena, first->surfaces, first->surface_count, 0);
    for (size_t i = 0; i < first->surface_count; i++) {
        if (!merge_surface(&merge, i)) {
            return;
        }
    }
    to->settings = merge.settings;
    to->setting_count = merge.setting_count;
    merge_object_and_aperture(&merge);
    merge_light_and_stop(&merge);
    merge_fields(&merge);
}

/* Position 0: the file has none. */
static bool read_one_position(const struct merge_file *file, size_t position, struct lens *lens,
                              struct arena *arena, struct error *error)
{
    return file->read(arena_copy(arena, file->state, 1, 0, file->size), position, file->content,
                      lens, error);
}

bool merge_read(struct lens_build *build, struct foreign_job *job, const struct merge_file *file,
                struct error *error)
{
    if (file->count == 0) {
        return read_one_position(file, 0, build->lens, job->arena, error);
    }
    struct lens *lenses = ARENA_ARRAY(job->arena, file->count, struct lens);
    const char **numbers = ARENA_ARRAY(job->arena, file->count, const char *);
    for (size_t p = 0; p < file->count; p++) {
        const size_t losses = job->loss_count;
        numbers[p] = arena_printf(job->arena, "%zu", p + 1);
        if (!read_one_position(file, p + 1, &lenses[p], job->arena, error)) {
            return false;
        }
        foreign_forget_repeated(job, p > 0 ? losses : job->loss_count);
    }
    build->lens->positions = file->names != NULL ? file->names : numbers;
    build->lens->position_count = file->count;
    merge_positions(build, lenses, job);
    return true;
}
