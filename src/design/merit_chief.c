/* design/merit_chief.c - operands of real chief and edge rays. */
/* SPDX-License-Identifier: MIT */
#include "design/merit_chief.h"

#include "design/merit_paraxial.h"
#include "design/merit_ray.h"

#include <math.h>

/* What a slot keeps: the chief rays found last. */
struct chief_memory {
    struct aim_near *near; /* one a chief ray */
};

static struct chief_memory *memory_new(size_t count, struct arena *arena)
{
    struct chief_memory *memory = ARENA_NEW(arena, struct chief_memory);
    memory->near = ARENA_ARRAY(arena, count, struct aim_near);
    return memory;
}

static const struct field_point *field_of(const struct merit_place *place,
                                          const struct operand *operand)
{
    return operand->field != NULL ? &operand->field->point : &place->setup.edge;
}

/* The direction of a field in the object, and how far out: tan t, or mm. */
static double direction_of(const struct merit_place *place, const struct field_point *field,
                           double towards[2])
{
    const bool is_angle = field->kind == FIELD_ANGLE;
    const double sign = is_angle && !place->setup.object.is_infinite ? -1 : 1;
    const double x = sign * (is_angle ? tan(field->value[0]) : field->value[0]);
    const double y = sign * (is_angle ? tan(field->value[1]) : field->value[1]);
    const double size = hypot(x, y);
    const double up = y < 0 || (y == 0 && x < 0) ? -1 : 1;
    towards[0] = size > 0 ? up * x / size : 0;
    towards[1] = size > 0 ? up * y / size : 1;
    return up * size;
}

/* -------- one chief ray -------- */

/* Its end by all columns, into `end`. */
static bool follow(struct merit *merit, const struct merit_slot *slot, double wavelength,
                   size_t passed, struct merit_ray *end)
{
    const struct merit_place *place = &merit->places[slot->place];
    const struct chief_memory *memory = slot->own;
    struct merit_light *light = merit_light(merit, slot, wavelength);
    const struct merit_ray_question question = {.slot = slot,
                                                .light = light,
                                                .field = field_of(place, slot->operand),
                                                .near = &memory->near[light - place->lights]};
    struct merit_ray *start = ARENA_ARRAY(merit->arena, merit_columns(merit), struct merit_ray);
    return merit_ray_start(merit, &question, merit->arena, start) &&
           merit_ray_follow(merit, &question, passed, start, merit->arena, end);
}

static struct dual along(const struct dual *vector, const double towards[2])
{
    return dual_add(dual_scale(vector[0], towards[0]), dual_scale(vector[1], towards[1]));
}

/* The height of the chief ray in the image, into merit->change. */
static bool find_height(struct merit *merit, const struct merit_slot *slot, double wavelength)
{
    struct merit_ray *end = ARENA_ARRAY(merit->arena, merit_columns(merit), struct merit_ray);
    double towards[2];
    direction_of(&merit->places[slot->place], field_of(&merit->places[slot->place], slot->operand),
                 towards);
    if (!follow(merit, slot, wavelength, MERIT_RAY_IMAGE, end)) {
        return false;
    }
    for (size_t j = 0; j < merit_columns(merit); j++) {
        merit->change[j] = along(end[j].at, towards);
    }
    return true;
}

static bool find_distortion(struct merit *merit, const struct merit_slot *slot, double wavelength)
{
    const struct merit_place *place = &merit->places[slot->place];
    const struct field_point *field = field_of(place, slot->operand);
    const bool far = place->setup.object.is_infinite, is_image = field->kind == FIELD_IMAGE;
    double towards[2];
    const double size = direction_of(place, field, towards);
    if (!find_height(merit, slot, wavelength)) {
        return false;
    }
    const struct merit_figures *figures = merit_figures(merit, slot, NAN);
    for (size_t j = 0; j < merit_columns(merit) && figures != NULL; j++) {
        const struct dual_first *first = &figures[j].first;
        const struct dual scale =
            far ? dual_multiply(first->index_object, first->efl) : first->magnification;
        const struct dual object =
            !is_image && far && field->kind != FIELD_ANGLE ? dual_of(NAN) : dual_of(size);
        const struct dual near = field->kind == FIELD_ANGLE && !far
                                     ? dual_scale(object, place->setup.object.distance.hi)
                                     : object;
        const struct dual ideal = is_image ? dual_of(size) : dual_multiply(scale, near);
        merit->change[j] =
            dual_scale(dual_divide(dual_subtract(merit->change[j], ideal), ideal), 100);
    }
    return figures != NULL;
}

static bool find_lateral(struct merit *merit, const struct merit_slot *slot, double wavelength)
{
    const size_t columns = merit_columns(merit);
    struct dual *first = ARENA_ARRAY(merit->arena, columns, struct dual);
    double colours[2];
    (void)wavelength;
    merit_colours(&merit->places[slot->place], slot->operand, colours);
    if (!find_height(merit, slot, colours[0])) {
        return false;
    }
    for (size_t j = 0; j < columns; j++) {
        first[j] = merit->change[j];
    }
    if (!find_height(merit, slot, colours[1])) {
        return false;
    }
    for (size_t j = 0; j < columns; j++) {
        merit->change[j] = dual_subtract(first[j], merit->change[j]);
    }
    return true;
}

static bool find_telecentric(struct merit *merit, const struct merit_slot *slot, double wavelength)
{
    const struct merit_place *place = &merit->places[slot->place];
    struct merit_ray *end = ARENA_ARRAY(merit->arena, merit_columns(merit), struct merit_ray);
    double towards[2];
    direction_of(place, field_of(place, slot->operand), towards);
    if (!follow(merit, slot, wavelength, place->lens->surface_count, end)) {
        return false;
    }
    for (size_t j = 0; j < merit_columns(merit); j++) {
        merit->change[j] =
            dual_arc_tangent(dual_divide(along(end[j].along, towards), end[j].along[2]));
    }
    return true;
}

static bool (*const finds[OPERAND_KINDS])(struct merit *merit, const struct merit_slot *slot,
                                          double wavelength) = {
    [OPERAND_HEIGHT] = find_height,
    [OPERAND_DISTORTION] = find_distortion,
    [OPERAND_LATERAL] = find_lateral,
    [OPERAND_TELECENTRIC] = find_telecentric,
};

bool merit_fill_chief(struct merit *merit, const struct merit_slot *slot, double *residuals,
                      double *jacobian)
{
    const struct arena_mark mark = arena_mark(merit->arena);
    const bool found = finds[slot->operand->kind](merit, slot, slot->operand->wavelength) &&
                       merit_put(merit, slot, 0, residuals, jacobian);
    arena_reset(merit->arena, mark);
    return found;
}

size_t merit_prepare_chief(struct merit *merit, struct merit_slot *slot, struct arena *arena,
                           struct error *error)
{
    const struct merit_place *place = &merit->places[slot->place];
    const enum operand_kind kind = slot->operand->kind;
    const struct field_point *field = field_of(place, slot->operand);
    double towards[2], colours[2];
    if (field->kind == FIELD_NONE) {
        fail(error, ERROR_DOMAIN,
             "the lens states no field off its axis: say which, as in %s@10deg",
             operand_type(kind)->name);
        return 0;
    }
    merit_colours(place, slot->operand, colours);
    if (kind == OPERAND_LATERAL && colours[0] == colours[1]) {
        fail(error, ERROR_DOMAIN, "there is only one wavelength, and so no colour");
        return 0;
    }
    if (kind == OPERAND_DISTORTION && !(fabs(direction_of(place, field, towards)) > 0)) {
        fail(error, ERROR_DOMAIN, "there is no distortion on the axis");
        return 0;
    }
    if (!merit_ray_check(place, field, error) ||
        (kind != OPERAND_TELECENTRIC && !merit_image_check(place, error))) {
        return 0;
    }
    slot->own = memory_new(place->light_count, arena);
    return 1;
}

/* -------- angles of incidence -------- */

/* A ray of a field: a place in the stop. */
static const double pupils[][2] = {{0, 0}, {0, 1}, {0, -1}};
enum { PUPILS = sizeof pupils / sizeof pupils[0] };

static size_t field_count(const struct merit_place *place, const struct operand *operand)
{
    return operand->field != NULL ? 1 : place->setup.field_count;
}

static const struct field_point *field_at(const struct merit_place *place,
                                          const struct operand *operand, size_t i)
{
    return operand->field != NULL ? &operand->field->point : &place->setup.fields[i].point;
}

static size_t end_of(const struct operand *operand, const struct lens *lens)
{
    return operand->first == LENS_NONE ? lens->surface_count : operand->last + 1;
}

static size_t first_of(const struct operand *operand)
{
    return operand->first == LENS_NONE ? 0 : operand->first;
}

/* A plane that only is the stop, or one within a medium, bends nothing. */
static bool bends(const struct lens *lens, size_t i)
{
    const struct surface *surface = &lens->surfaces[i];
    const struct medium *before = i > 0 ? &lens->surfaces[i - 1].medium : &lens->object_medium;
    return surface_reflects(surface) ||
           (surface_has(surface, SURFACE_HAS_MEDIUM) && !medium_is_same(before, &surface->medium));
}

static struct dual cross_square(const struct dual a[3], const struct dual b[3])
{
    struct dual sum = dual_of(0);
    for (int i = 0; i < 3; i++) {
        const int k = (i + 1) % 3, l = (i + 2) % 3;
        const struct dual part =
            dual_subtract(dual_multiply(a[k], b[l]), dual_multiply(a[l], b[k]));
        sum = dual_add(sum, dual_multiply(part, part));
    }
    return sum;
}

static struct dual square(const struct dual a[3])
{
    struct dual sum = dual_of(0);
    for (int i = 0; i < 3; i++) {
        sum = dual_add(sum, dual_multiply(a[i], a[i]));
    }
    return sum;
}

/* The angle whose sine is |p x p'|/(n |p' - p|): of the tangent, so that 90 deg is no pole. */
static struct dual incidence(const struct merit_ray *before, const struct merit_ray *after)
{
    struct dual step[3], dot = dual_of(0);
    for (int i = 0; i < 3; i++) {
        step[i] = dual_subtract(after->along[i], before->along[i]);
        dot = dual_add(dot, dual_multiply(step[i], before->along[i]));
    }
    const struct dual cross = cross_square(before->along, after->along);
    const struct dual size = square(step);
    if (!(cross.value > 1e-28 * size.value)) {
        return dual_of(0); /* at right angles: the slope of |i| has no sign there */
    }
    const struct dual tangent = dual_divide(dual_root(cross), dual_absolute(dot));
    return dual_arc_tangent(tangent);
}

/* Follow one ray to a surface; keep the angle if it is the largest so far. */
static void compare(struct merit *merit, const struct merit_ray_question *question, size_t surface,
                    const struct merit_ray *start, double *largest)
{
    const size_t columns = merit_columns(merit);
    const struct arena_mark mark = arena_mark(merit->arena);
    struct merit_ray *before = ARENA_ARRAY(merit->arena, columns, struct merit_ray);
    struct merit_ray *after = ARENA_ARRAY(merit->arena, columns, struct merit_ray);
    if (merit_ray_follow(merit, question, surface, start, merit->arena, before) &&
        merit_ray_follow(merit, question, surface + 1, start, merit->arena, after) &&
        incidence(&before[0], &after[0]).value > *largest) {
        for (size_t j = 0; j < columns; j++) {
            merit->change[j] = incidence(&before[j], &after[j]);
        }
        *largest = merit->change[0].value;
    }
    arena_reset(merit->arena, mark);
}

/* All rays at one surface, their largest angle into merit->change. */
static bool look(struct merit *merit, const struct merit_slot *slot, size_t surface,
                 struct merit_ray *const *starts)
{
    const struct merit_place *place = &merit->places[slot->place];
    double largest = -1;
    for (size_t i = 0; i < field_count(place, slot->operand) * PUPILS; i++) {
        const double *pupil = pupils[i % PUPILS];
        const struct merit_ray_question question = {
            .slot = slot,
            .light = merit_light(merit, slot, slot->operand->wavelength),
            .field = field_at(place, slot->operand, i / PUPILS),
            .pupil = {pupil[0], pupil[1]}};
        if (starts[i] != NULL) {
            compare(merit, &question, surface, starts[i], &largest);
        }
    }
    return largest >= 0 ||
           fail(&merit->why, ERROR_DOMAIN, "no ray arrives at surface %zu", surface + 1);
}

/* Aim all rays of a slot. */
static struct merit_ray **aim_all(struct merit *merit, const struct merit_slot *slot)
{
    const struct merit_place *place = &merit->places[slot->place];
    const struct chief_memory *memory = slot->own;
    const size_t count = field_count(place, slot->operand) * PUPILS;
    struct merit_ray **starts = ARENA_ARRAY(merit->arena, count, struct merit_ray *);
    for (size_t i = 0; i < count; i++) {
        const double *pupil = pupils[i % PUPILS];
        const struct merit_ray_question question = {
            .slot = slot,
            .light = merit_light(merit, slot, slot->operand->wavelength),
            .field = field_at(place, slot->operand, i / PUPILS),
            .pupil = {pupil[0], pupil[1]},
            .near = &memory->near[i / PUPILS]};
        starts[i] = ARENA_ARRAY(merit->arena, merit_columns(merit), struct merit_ray);
        if (!merit_ray_start(merit, &question, merit->arena, starts[i])) {
            starts[i] = NULL;
        }
    }
    return starts;
}

bool merit_fill_incidence(struct merit *merit, const struct merit_slot *slot, double *residuals,
                          double *jacobian)
{
    const struct arena_mark mark = arena_mark(merit->arena);
    const struct lens *lens = merit->places[slot->place].lens;
    struct merit_ray **starts = aim_all(merit, slot);
    bool done = true;
    size_t at = 0;
    for (size_t i = first_of(slot->operand); i < end_of(slot->operand, lens) && done; i++) {
        done = !bends(lens, i) ||
               (look(merit, slot, i, starts) && merit_put(merit, slot, at++, residuals, jacobian));
    }
    arena_reset(merit->arena, mark);
    return done;
}

size_t merit_prepare_incidence(struct merit *merit, struct merit_slot *slot, struct arena *arena,
                               struct error *error)
{
    const struct merit_place *place = &merit->places[slot->place];
    const struct operand *operand = slot->operand;
    const struct lens *lens = place->lens;
    size_t count = 0;
    if (!merit_needs_aperture(place, error)) {
        return 0;
    }
    for (size_t i = 0; i < field_count(place, operand); i++) {
        if (!merit_ray_check(place, field_at(place, operand, i), error)) {
            return 0;
        }
    }
    for (size_t i = first_of(operand); i < end_of(operand, lens) && i < lens->surface_count; i++) {
        count += bends(lens, i);
        if (lens->surfaces[i].coordinate_break != NULL) {
            fail(error, ERROR_DOMAIN, "surface %zu stands behind a coordinate break", i + 1);
            return 0;
        }
    }
    if (count == 0) {
        fail(error, ERROR_DOMAIN, "none of these surfaces bends light");
    }
    slot->own = memory_new(field_count(place, operand), arena);
    return count;
}
