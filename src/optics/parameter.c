/* optics/parameter.c - what of a lens may change: the table, and the numbers in a lens. */
/* SPDX-License-Identifier: MIT */
#include "optics/parameter.h"

#include "optics/glass.h"
#include "optics/lens.h"

#include <assert.h>
#include <math.h>
#include <string.h>

/* What a kind of surface must have for it. */
enum { CURVE = SURFACE_HAS_CURVE, FOCAL = SURFACE_HAS_FOCAL, MEDIUM = SURFACE_HAS_MEDIUM };

/* How a number lies in a surface; `offset` is that of its figure. */
struct storage {
    const struct figure *(*look)(const struct surface *surface, size_t offset);
    void (*put)(struct surface *surface, size_t offset, struct figure figure,
                struct displacement *room);
    double (*get)(const struct surface *surface, size_t offset); /* null = that of the figure */
    void (*set)(struct surface *surface, size_t offset, double value);
};

static const struct figure *parameter_at(const void *start, size_t offset)
{
    return (const struct figure *)(const void *)((const char *)start + offset);
}

static struct figure *parameter_place(void *start, size_t offset)
{
    return (struct figure *)(void *)((char *)start + offset);
}

/* A member of the surface that is there in any case. */
static const struct figure *look_member(const struct surface *surface, size_t offset)
{
    return parameter_at(surface, offset);
}

static void put_member(struct surface *surface, size_t offset, struct figure figure,
                       struct displacement *room)
{
    (void)room;
    *parameter_place(surface, offset) = figure;
}

static const struct figure *look_radius(const struct surface *surface, size_t offset)
{
    return surface->is_plane ? NULL : parameter_at(surface, offset);
}

static void parameter_put_radius(struct surface *surface, size_t offset, struct figure figure,
                                 struct displacement *room)
{
    (void)room;
    surface->is_plane = isinf(figure.value.hi);
    surface->has_curvature = false;
    surface->curvature = figure_number(pair_of(0));
    *parameter_place(surface, offset) = surface->is_plane ? figure_number(pair_of(0)) : figure;
}

static double get_radius(const struct surface *surface, size_t offset)
{
    if (surface->has_curvature) {
        return 1 / surface->curvature.value.hi;
    }
    return surface->is_plane ? INFINITY : parameter_at(surface, offset)->value.hi;
}

static const struct figure *look_curvature(const struct surface *surface, size_t offset)
{
    return surface->has_curvature ? parameter_at(surface, offset) : NULL;
}

static void parameter_put_curvature(struct surface *surface, size_t offset, struct figure figure,
                                    struct displacement *room)
{
    (void)room;
    surface->is_plane = surface->has_curvature = true;
    surface->radius = figure_number(pair_of(0));
    *parameter_place(surface, offset) = figure;
}

static double get_curvature(const struct surface *surface, size_t offset)
{
    if (surface->has_curvature) {
        return parameter_at(surface, offset)->value.hi;
    }
    return surface->is_plane ? 0 : pair_divide(pair_of(1), surface->radius.value).hi;
}

/* As a curvature only where the surface has one: a file is read with radii. */
static void parameter_set_curvature(struct surface *surface, size_t offset, double value)
{
    if (surface->has_curvature) {
        parameter_put_curvature(surface, offset, figure_number(pair_of(value)), NULL);
    } else {
        parameter_put_radius(surface, offsetof(struct surface, radius),
                             figure_number(pair_divide(pair_of(1), pair_of(value))), NULL);
    }
}

static const struct figure *look_thickness(const struct surface *surface, size_t offset)
{
    return surface->has_thickness ? parameter_at(surface, offset) : NULL;
}

static void parameter_put_thickness(struct surface *surface, size_t offset, struct figure figure,
                                    struct displacement *room)
{
    surface->has_thickness = true;
    put_member(surface, offset, figure, room);
}

static unsigned coefficient_bit(size_t offset)
{
    return 1u << (offset - offsetof(struct surface, coefficient)) / sizeof(struct figure);
}

static const struct figure *look_coefficient(const struct surface *surface, size_t offset)
{
    return (surface->coefficients & coefficient_bit(offset)) != 0 ? parameter_at(surface, offset)
                                                                  : NULL;
}

static void parameter_put_coefficient(struct surface *surface, size_t offset, struct figure figure,
                                      struct displacement *room)
{
    surface->coefficients |= coefficient_bit(offset);
    put_member(surface, offset, figure, room);
}

static const struct figure *look_decentre(const struct surface *surface, size_t offset)
{
    return surface->decentre != NULL ? parameter_at(surface->decentre, offset) : NULL;
}

static const struct figure *look_break(const struct surface *surface, size_t offset)
{
    return surface->coordinate_break != NULL ? parameter_at(surface->coordinate_break, offset)
                                             : NULL;
}

/* Another displacement with one number changed, or the same; without one the others are 0. */
static const struct displacement *displaced(const struct displacement *from, size_t offset,
                                            struct figure figure, struct displacement *to)
{
    if (to != from) {
        *to = from != NULL ? *from : displacement_none;
    }
    *parameter_place(to, offset) = figure;
    return to;
}

static void put_decentre(struct surface *surface, size_t offset, struct figure figure,
                         struct displacement *room)
{
    surface->decentre = displaced(surface->decentre, offset, figure, room);
}

static void parameter_put_break(struct surface *surface, size_t offset, struct figure figure,
                                struct displacement *room)
{
    surface->coordinate_break = displaced(surface->coordinate_break, offset, figure, room);
}

static const struct storage member = {look_member, put_member, NULL, NULL},
                            radius = {look_radius, parameter_put_radius, get_radius, NULL},
                            curvature = {look_curvature, parameter_put_curvature, get_curvature,
                                         parameter_set_curvature},
                            thickness = {look_thickness, parameter_put_thickness, NULL, NULL},
                            coefficient = {look_coefficient, parameter_put_coefficient, NULL, NULL},
                            decentre = {look_decentre, put_decentre, NULL, NULL},
                            coordinate_break = {look_break, parameter_put_break, NULL, NULL};

enum {
    MARK = PARAMETER_IS_MARK,
    ANGLE = PARAMETER_IS_ANGLE,
    BEHIND = PARAMETER_IS_BEHIND,
    ORDERS = PARAMETER_HAS_ORDERS
};

/* kind, basis, what it wants of the kind of surface, where it lies; then struct parameter_type */
#define ROW(kind, by, wants, where, ...)                                                           \
    [PARAMETER_##kind] = {{__VA_ARGS__, .basis = PARAMETER_##by}, wants, where}
#define IN(part, what)  &(part), offsetof(struct surface, what)
#define DECENTRE(what)  &decentre, offsetof(struct displacement, what)
#define BREAK(what)     &coordinate_break, offsetof(struct displacement, what)
#define IN_MEDIUM(what) NULL, offsetof(struct medium, what)
#define ONE(kind, where, ...)                                                                      \
    [PARAMETER_##kind] = {{__VA_ARGS__, .basis = PARAMETER_##kind}, 0, where}

/* clang-format off */
static const struct parameter_row {
    struct parameter_type type;
    unsigned wants;               /* SURFACE_HAS_ of the kind of surface; 0 = all have it */
    const struct storage *stored; /* null = in the medium, with its digits in the medium's text */
    size_t offset;
} rows[PARAMETER_KINDS] = {
    ROW(RADIUS, CURVATURE, CURVE, IN(radius, radius), "R", "radius", 1, MARK, TURN_WITH_AXES),
    ROW(CURVATURE, CURVATURE, CURVE, IN(curvature, curvature),
        "c", "curvature", -1, MARK, TURN_WITH_AXES),
    ROW(THICKNESS, THICKNESS, 0, IN(thickness, thickness),
        "t", "thickness", 1, MARK | BEHIND, TURN_WITH_MIRRORS),
    ROW(CONIC, CONIC, CURVE, IN(member, conic), "k", "conic", 0, MARK, TURN_KEEPS),
    ROW(COEFFICIENT, COEFFICIENT, CURVE, IN(coefficient, coefficient),
        "A", "coefficient", 1, MARK | ORDERS, TURN_WITH_AXES),
    ROW(FOCAL, KINDS, FOCAL, IN(member, focal),
        "f", "focal length", 1, MARK, TURN_KEEPS, "focal"),
    ROW(HIATUS, KINDS, FOCAL, IN(member, hiatus), "hiatus", "hiatus", 1, 0, TURN_WITH_MIRRORS),
    ROW(INDEX, INDEX, MEDIUM, IN_MEDIUM(index), "n", "index", 0, BEHIND, TURN_KEEPS),
    ROW(ABBE, INDEX, MEDIUM, IN_MEDIUM(abbe), "V", "Abbe number", 0, BEHIND, TURN_KEEPS),
    ROW(GLASS, KINDS, MEDIUM, IN_MEDIUM(written), "glass", "glass", 0, MARK | BEHIND, TURN_KEEPS),
    ONE(DECENTER_X, DECENTRE(decenter[0]),
        "decenter_x", "decentre in x", 1, MARK, TURN_WITH_AXES, "dx"),
    ONE(DECENTER_Y, DECENTRE(decenter[1]),
        "decenter_y", "decentre in y", 1, MARK, TURN_KEEPS, "dy"),
    ONE(TILT_X, DECENTRE(tilt[0]),
        "tilt_x", "tilt about x", 0, MARK | ANGLE, TURN_WITH_AXES, "ax"),
    ONE(TILT_Y, DECENTRE(tilt[1]),
        "tilt_y", "tilt about y", 0, MARK | ANGLE, TURN_KEEPS, "ay"),
    ONE(TILT_Z, DECENTRE(tilt[2]), "tilt_z", "tilt about z", 0, ANGLE, TURN_WITH_AXES),
    ONE(BREAK_DECENTER_X, BREAK(decenter[0]),
        "bend_decenter_x", "coordinate break's decentre in x", 1, 0, TURN_WITH_AXES),
    ONE(BREAK_DECENTER_Y, BREAK(decenter[1]),
        "bend_decenter_y", "coordinate break's decentre in y", 1, 0, TURN_KEEPS),
    ONE(BREAK_TILT_X, BREAK(tilt[0]),
        "bend_tilt_x", "coordinate break's tilt about x", 0, ANGLE, TURN_WITH_AXES),
    ONE(BREAK_TILT_Y, BREAK(tilt[1]),
        "bend_tilt_y", "coordinate break's tilt about y", 0, ANGLE, TURN_KEEPS),
    ONE(BREAK_TILT_Z, BREAK(tilt[2]),
        "bend_tilt_z", "coordinate break's tilt about z", 0, ANGLE, TURN_WITH_AXES),
};
/* clang-format on */

const struct parameter_type *parameter_type(enum parameter_kind kind)
{
    return &rows[kind].type;
}

int parameter_length(enum parameter_kind kind, int order)
{
    return rows[kind].type.length - order;
}

struct parameter parameter_next(struct parameter parameter)
{
    int term = parameter.order > 0 ? surface_term(parameter.order) + 1 : LENS_COEFFICIENTS;
    if (term == LENS_COEFFICIENTS) {
        parameter.kind = (enum parameter_kind)(parameter.kind + 1);
        term = 0;
    }
    bool has_orders = parameter.kind < PARAMETER_KINDS &&
                      (rows[parameter.kind].type.is & PARAMETER_HAS_ORDERS) != 0;
    parameter.order = has_orders ? surface_order(term) : 0;
    return parameter;
}

bool parameter_suits(enum parameter_kind kind, const struct surface *surface)
{
    return rows[kind].wants == 0 || surface_has(surface, rows[kind].wants);
}

/* Where the figure lies: coefficients one behind the other. */
static size_t offset_of(enum parameter_kind kind, int order)
{
    size_t term = order > 0 ? (size_t)surface_term(order) : 0;
    assert((order > 0) == ((rows[kind].type.is & PARAMETER_HAS_ORDERS) != 0));
    assert(term < LENS_COEFFICIENTS);
    return rows[kind].offset + term * sizeof(struct figure);
}

const struct figure *parameter_figure(const struct surface *surface, enum parameter_kind kind,
                                      int order)
{
    const struct storage *stored = rows[kind].stored;
    return stored != NULL && parameter_suits(kind, surface)
               ? stored->look(surface, offset_of(kind, order))
               : NULL;
}

/* Room for what lies beside the surface, if the number does. */
static struct displacement *new_displacement(enum parameter_kind kind, struct arena *arena)
{
    return kind >= PARAMETER_DECENTER_X ? ARENA_NEW(arena, struct displacement) : NULL;
}

void parameter_put(struct surface *surface, enum parameter_kind kind, int order,
                   struct figure figure, struct arena *arena)
{
    assert(rows[kind].stored != NULL && parameter_suits(kind, surface));
    rows[kind].stored->put(surface, offset_of(kind, order), figure, new_displacement(kind, arena));
}

static bool check_medium(const struct medium *medium, struct parameter parameter,
                         struct error *error)
{
    bool model = medium->kind == MEDIUM_MODEL, number = model || medium->kind == MEDIUM_CONSTANT;
    return parameter.kind == PARAMETER_GLASS || model ||
           (number && parameter.kind == PARAMETER_INDEX) ||
           fail(error, ERROR_DOMAIN,
                "the medium %.*s after surface %zu has no %s of its own to vary: only %s has",
                text_shown(medium->written), medium->written.start, parameter.surface + 1,
                rows[parameter.kind].type.words,
                parameter.kind == PARAMETER_INDEX ? "a number or nd/Vd" : "nd/Vd");
}

bool parameter_is_same(struct parameter a, struct parameter b)
{
    bool same = a.kind == b.kind && a.order == b.order;
    bool curve = rows[a.kind].type.basis == PARAMETER_CURVATURE &&
                 rows[b.kind].type.basis == PARAMETER_CURVATURE;
    bool glass = a.kind == PARAMETER_GLASS || b.kind == PARAMETER_GLASS;
    bool medium = glass && rows[a.kind].stored == NULL && rows[b.kind].stored == NULL;
    return a.surface == b.surface && (same || curve || medium);
}

/* Do the positions set it, or one that stands for the same? */
static bool is_set(const struct lens *lens, struct parameter parameter)
{
    for (size_t i = 0; i < lens->setting_count; i++) {
        if (parameter_is_same(lens->settings[i].parameter, parameter)) {
            return true;
        }
    }
    return false;
}

bool parameter_check(const struct lens *lens, struct parameter parameter, struct error *error)
{
    const struct parameter_row *row = &rows[parameter.kind];
    size_t number = parameter.surface + 1, count = lens->surface_count;
    const char *words = row->type.words;
    if (parameter.surface == LENS_NONE && row->stored == NULL) {
        return check_medium(&lens->object_medium, parameter, error);
    }
    if (parameter.surface >= count) {
        return fail(error, ERROR_DOMAIN, "there is no %s %zu to vary: the lens has %zu surfaces",
                    words, number, count);
    }
    const struct surface *surface = &lens->surfaces[parameter.surface];
    if (!parameter_suits(parameter.kind, surface)) {
        return fail(error, ERROR_DOMAIN, "surface %zu has no %s to vary", number, words);
    }
    if (is_set(lens, parameter)) {
        return fail(error, ERROR_DOMAIN, "the %s of surface %zu is another in every position",
                    words, number);
    }
    if (row->stored == NULL) {
        return check_medium(&surface->medium, parameter, error);
    }
    const struct figure *figure = parameter_figure(surface, parameter.kind, parameter.order);
    if (figure == NULL && parameter.kind == PARAMETER_THICKNESS) {
        return fail(error, ERROR_DOMAIN, "the lens states no %s behind surface %zu", words, number);
    }
    if (figure != NULL && figure->variable != LENS_NONE) {
        const struct text name = lens->variables[figure->variable].name;
        return fail(error, ERROR_DOMAIN,
                    "the %s of surface %zu is %.*s, which has a number of its own in every "
                    "position",
                    words, number, text_shown(name), name.start);
    }
    return true;
}

static const struct medium *parameter_medium_of(const struct lens *lens, size_t surface)
{
    return surface == LENS_NONE ? &lens->object_medium : &lens->surfaces[surface].medium;
}

static const struct pair *medium_number(const struct medium *medium, enum parameter_kind kind)
{
    return (const struct pair *)(const void *)((const char *)medium + rows[kind].offset);
}

double parameter_get(const struct lens *lens, struct parameter parameter)
{
    const struct storage *stored = rows[parameter.kind].stored;
    assert(parameter.kind != PARAMETER_GLASS);
    if (stored == NULL) {
        return medium_number(parameter_medium_of(lens, parameter.surface), parameter.kind)->hi;
    }
    const struct surface *surface = &lens->surfaces[parameter.surface];
    size_t offset = offset_of(parameter.kind, parameter.order);
    if (stored->get != NULL) {
        return stored->get(surface, offset);
    }
    const struct figure *figure = stored->look(surface, offset);
    return figure != NULL ? figure->value.hi : 0;
}

/* With its text, as a .lens file has it. */
static struct medium medium_with(const struct medium *from, enum parameter_kind kind, double value,
                                 char written[PARAMETER_WRITTEN])
{
    struct medium to = *from;
    if (kind == PARAMETER_INDEX) {
        to.index = pair_of(value);
    } else {
        to.abbe = pair_of(value);
    }
    char *end = number_write_shortest(written, to.index.hi);
    if (to.kind == MEDIUM_MODEL) {
        *end++ = '/';
        end = number_write_shortest(end, to.abbe.hi);
    }
    to.written = (struct text){written, (size_t)(end - written)};
    return to;
}

void parameter_put_medium(struct lens *lens, size_t surface, const struct medium *medium)
{
    if (surface == LENS_NONE) {
        lens->object_medium = *medium;
    } else {
        lens->surfaces[surface].medium = *medium;
    }
    for (size_t i = surface + 1; i < lens->surface_count && surface_reflects(&lens->surfaces[i]);
         i++) {
        lens->surfaces[i].medium = *medium;
    }
}

void parameter_set_in(struct lens *lens, struct parameter parameter, double value,
                      const struct parameter_room *room)
{
    const struct storage *stored = rows[parameter.kind].stored;
    if (parameter_get(lens, parameter) == value) {
        return; /* with all that the decimal typed has beyond a double */
    }
    if (stored == NULL) {
        const struct medium to = medium_with(parameter_medium_of(lens, parameter.surface),
                                             parameter.kind, value, room->written);
        parameter_put_medium(lens, parameter.surface, &to);
        return;
    }
    struct surface *surface = &lens->surfaces[parameter.surface];
    size_t offset = offset_of(parameter.kind, parameter.order);
    if (stored->set != NULL) {
        stored->set(surface, offset, value);
    } else {
        stored->put(surface, offset, figure_number(pair_of(value)), room->displacement);
    }
}

void parameter_set(struct lens *lens, struct parameter parameter, double value, struct arena *arena)
{
    const bool has_text = rows[parameter.kind].stored == NULL;
    const struct parameter_room room = {
        new_displacement(parameter.kind, arena),
        has_text ? ARENA_ARRAY(arena, PARAMETER_WRITTEN, char) : NULL,
    };
    parameter_set_in(lens, parameter, value, &room);
}

struct lens *lens_copy(const struct lens *lens, struct arena *arena)
{
    struct lens *copy = ARENA_NEW(arena, struct lens);
    *copy = *lens;
    copy->surfaces = ARENA_ARRAY(arena, lens->surface_count, struct surface);
    memcpy(copy->surfaces, lens->surfaces, lens->surface_count * sizeof(struct surface));
    return copy;
}

struct lens *parameter_apply(const struct lens *lens, const struct parameter *parameters,
                             const double *values, size_t count, struct arena *arena)
{
    struct lens *to = lens_copy(lens, arena);
    for (size_t i = 0; i < count; i++) {
        parameter_set(to, parameters[i], values[i], arena);
    }
    return to;
}

double parameter_slope(const struct lens *lens, struct parameter parameter, double wavelength)
{
    const struct parameter_row *row = &rows[parameter.kind];
    if (row->type.basis == PARAMETER_KINDS) {
        return NAN;
    }
    if (row->stored == NULL) {
        /* dn by nd, or Vd: of a glass with nd = 2, n - 1 is what nd - 1 is multiplied by. */
        const struct medium *medium = parameter_medium_of(lens, parameter.surface);
        const struct glass unit = glass_nd_vd(pair_of(2), medium->abbe);
        if (medium->kind != MEDIUM_MODEL) {
            return parameter.kind == PARAMETER_INDEX ? 1 : NAN;
        }
        double n = glass_n(&unit, wavelength);
        return parameter.kind == PARAMETER_INDEX
                   ? n - 1
                   : -(medium->index.hi - 1) * (n - 2) / medium->abbe.hi;
    }
    if (parameter.kind == PARAMETER_RADIUS) {
        double R = parameter_get(lens, parameter);
        return -1 / (R * R);
    }
    return 1;
}
