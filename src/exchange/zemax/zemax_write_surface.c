/* exchange/zemax/zemax_write_surface.c - surfaces and media of a .zmx file. */
/* SPDX-License-Identifier: MIT */
#include "exchange/zemax/zemax.h"
#include "exchange/zemax/zemax_aperture.h"
#include "exchange/zemax/zemax_writer.h"
#include "file/lens_build.h"
#include "file/lens_glass.h"
#include "optics/glass.h"
#include "optics/wavelength.h"

#include "base/constants.h"

#include <math.h>
#include <string.h>

/* The value in the first position. */
static const struct figure *zemax_write_surface_first_of(const struct zemax_writer *writer,
                                                         const struct figure *figure)
{
    return figure->variable == LENS_NONE ? figure
                                         : &writer->lens->variables[figure->variable].values[0];
}

static void zemax_write_surface_put_length(struct zemax_writer *writer, const struct figure *figure)
{
    growing_figure(&writer->out, zemax_write_surface_first_of(writer, figure), writer->unit);
}

/* "  CURV 1/R": so many digits that the reader finds the same radius again. */
static void put_reciprocal(struct zemax_writer *writer, const struct figure *radius)
{
    struct arena *arena = writer->job->arena;
    char text[PAIR_LENGTH];
    double plain_radius = 0;
    struct figure typed = figure_computed(radius->value, writer->unit, arena);
    struct figure curvature, again;
    number_read(typed.typed.start, typed.typed.start + typed.typed.length, NUMBER_UNSCALED,
                &plain_radius);
    char *end = number_write_digits(text, 1 / plain_radius, 17);
    curvature = (struct figure){.typed = {text, (size_t)(end - text)}, .variable = LENS_NONE};
    curvature = figure_per_length(curvature, writer->lens->unit, -1);
    bool found = figure_radius_of(&curvature, writer->lens->unit, arena, &again) &&
                 again.value.hi == radius->value.hi && again.value.lo == radius->value.lo;
    if (!found) {
        struct pair exact = pair_divide(pair_of(1), radius->value);
        struct number_scale inverse = {1, 0};
        struct figure one = {.typed = text_of("1"), .variable = LENS_NONE};
        exact = pair_multiply(exact, figure_per_length(one, writer->lens->unit, 1).value);
        end = pair_write_digits(text, exact, inverse, 31);
    }
    growing_put(&writer->out, text, (size_t)(end - text));
}

/* A curvature as typed; longer where the reader would take it for 1/R of a short radius. */
static void zemax_write_surface_put_curvature(struct zemax_writer *writer,
                                              const struct figure *curvature)
{
    struct figure radius, figure = *curvature;
    char text[PAIR_LENGTH];
    if (figure.typed.start == NULL) {
        struct figure one = {.typed = text_of("1"), .variable = LENS_NONE};
        struct pair unit = figure_per_length(one, writer->lens->unit, 1).value;
        figure =
            figure_computed(pair_multiply(figure.value, unit), NUMBER_UNSCALED, writer->job->arena);
        figure.value = curvature->value;
    }
    if (figure_radius_of(&figure, writer->lens->unit, writer->job->arena, &radius)) {
        struct pair value = {0, 0};
        pair_read(figure.typed.start, figure.typed.start + figure.typed.length, NUMBER_UNSCALED,
                  &value);
        char *end = pair_write_digits(text, value, NUMBER_UNSCALED, 31);
        growing_put(&writer->out, text, (size_t)(end - text));
        return;
    }
    growing_text(&writer->out, figure.typed);
}

/* CATALOG and NAME of a glass as its catalogue spells them. */
static void split_glass(const struct medium *medium, struct text *catalog, struct text *name)
{
    const struct glass *glass = lens_glass_of(medium);
    struct text rest = medium->written, before = text_cut(&rest, ':');
    *name = rest.start != NULL ? rest : before;
    *catalog = rest.start != NULL ? before : ((struct text){NULL, 0});
    if (glass != NULL) {
        *name = glass->name;
        *catalog = glass->catalog;
    }
}

void zemax_note_catalog(struct zemax_writer *writer, const struct medium *medium)
{
    struct text catalog, name;
    if (medium->kind != MEDIUM_GLASS) {
        return;
    }
    split_glass(medium, &catalog, &name);
    for (size_t i = 0; i < writer->catalog_count; i++) {
        if (text_identical(writer->catalogs[i], catalog)) {
            return;
        }
    }
    if (catalog.length > 0 && writer->catalog_count < ZEMAX_MOST_CATALOGS) {
        writer->catalogs[writer->catalog_count++] = catalog;
    }
}

/* nd and Vd beside the name of a glass; 0 where it has none. */
static struct glass_abbe abbe_of(const struct medium *medium)
{
    const struct glass *glass = lens_glass_of(medium);
    const struct glass_abbe none = {0, 0};
    if (glass == NULL || WAVELENGTH_D < glass->shortest || WAVELENGTH_D > glass->longest) {
        return none;
    }
    const struct glass_abbe abbe = glass_abbe(glass);
    return abbe.nd > 1 && abbe.Vd > 0 && abbe.Vd < INFINITY ? abbe : none;
}

/*
 * Would the file be read with another glass of this name: that of an earlier catalogue of its list,
 * or what the other program calls so? nd and Vd stand beside it; 0: they don't.
 */
static bool check_homonym(struct zemax_writer *writer, const struct medium *medium,
                          struct glass_abbe abbe, struct error *error)
{
    struct text catalog, name;
    struct medium other;
    const struct file_words nowhere = {0};
    split_glass(medium, &catalog, &name);
    const struct foreign_name named = {.name = name,
                                       .catalogs = writer->catalogs,
                                       .catalog_count = writer->catalog_count,
                                       .nd = abbe.nd,
                                       .Vd = abbe.Vd,
                                       .has_homonyms = true,
                                       .is_by_name = true};
    if (writer->job->glasses == NULL || lens_glass_of(medium) == NULL) {
        return true;
    }
    if (!foreign_glass(writer->job, &nowhere, &named, &other, error)) {
        return error->code == ERROR_NONE &&
               foreign_lose(writer->job, error, "the glass %.*s:%.*s, of more than %d catalogues",
                            (int)catalog.length, catalog.start, (int)name.length, name.start,
                            ZEMAX_MOST_CATALOGS);
    }
    const struct glass *read = lens_glass_of(&other);
    return (text_identical(read->name, name) && text_identical(read->catalog, catalog)) ||
           foreign_lose(writer->job, error,
                        "the glass %.*s:%.*s: the file would be read with %.*s:%.*s",
                        (int)catalog.length, catalog.start, (int)name.length, name.start,
                        (int)read->catalog.length, read->catalog.start, (int)read->name.length,
                        read->name.start);
}

bool zemax_put_glass_name(struct zemax_writer *writer, const struct medium *medium,
                          struct error *error)
{
    struct text catalog, name;
    const struct glass_abbe none = {0, 0};
    if (medium->kind != MEDIUM_GLASS) {
        growing_string(&writer->out, "\"\"");
        return true;
    }
    split_glass(medium, &catalog, &name);
    growing_text(&writer->out, name);
    return check_homonym(writer, medium, none, error);
}

/* An index alone: Vd = 0 is no dispersion. */
static void put_model(struct zemax_writer *writer, struct text index, struct text abbe)
{
    growing_string(&writer->out, "  GLAS ___BLANK 1 0 ");
    growing_text(&writer->out, index);
    growing_string(&writer->out, " ");
    growing_text(&writer->out, abbe);
    growing_string(&writer->out, " 0 0 0 0 0 0\r\n");
}

static bool put_table(struct zemax_writer *writer, const struct medium *medium, struct error *error)
{
    struct pair index;
    double primary = lens_primary_wavelength(writer->lens);
    if (!medium_index(medium, primary, &index, error)) {
        return false;
    }
    char text[PAIR_LENGTH];
    char *end = pair_write_shortest(text, index, NUMBER_UNSCALED);
    put_model(writer, (struct text){text, (size_t)(end - text)}, text_of("0"));
    return foreign_lose(
        writer->job, error,
        "a medium given by a table" LOSS_INSTEAD "its index at %.6g um is used instead", primary);
}

bool zemax_put_medium(struct zemax_writer *writer, const struct medium *medium, struct error *error)
{
    struct text catalog, name, rest = medium->written, index = text_cut(&rest, '/');
    if (medium_is_air(medium)) {
        return true;
    }
    switch (medium->kind) {
    case MEDIUM_CONSTANT:
        put_model(writer, index, text_of("0"));
        return true;
    case MEDIUM_MODEL:
        put_model(writer, index, rest);
        return true;
    case MEDIUM_TABLE:
        return put_table(writer, medium, error);
    default:
        split_glass(medium, &catalog, &name);
        growing_string(&writer->out, "  GLAS ");
        growing_text(&writer->out, name);
        growing_format(&writer->out, " 0 0 %.8g %.8g 0 0 0 0 0 0\r\n", abbe_of(medium).nd,
                       abbe_of(medium).Vd);
        return (memchr(name.start, ' ', name.length) == NULL ||
                foreign_lose(writer->job, error, "the glass '%.*s': its name has a blank",
                             (int)name.length, name.start)) &&
               check_homonym(writer, medium, abbe_of(medium), error);
    }
}

void zemax_put_surf(struct zemax_writer *writer, const char *type)
{
    growing_format(&writer->out, "SURF %zu\r\n  TYPE %s\r\n", writer->number++, type);
}

static void put_parameter(struct zemax_writer *writer, int number, const struct figure *figure,
                          bool angle, bool negative)
{
    struct figure one = *figure;
    if (angle && one.typed.start == NULL) {
        one.value = pair_divide(one.value, pair_of(RADIANS_PER_DEGREE));
    }
    growing_format(&writer->out, "  PARM %d ", number);
    if (negative && one.value.hi != 0 && one.typed.start != NULL) {
        bool minus = one.typed.start[0] == '-', plus = one.typed.start[0] == '+';
        growing_string(&writer->out, minus ? "" : "-");
        one.typed.start += minus || plus;
        one.typed.length -= minus || plus;
    } else if (negative) {
        one.value = pair_negate(one.value);
    }
    growing_figure(&writer->out, &one, angle ? NUMBER_UNSCALED : writer->unit);
    growing_string(&writer->out, "\r\n");
}

/* A break of the axis, or its undoing. */
static void zemax_write_surface_put_break(struct zemax_writer *writer,
                                          const struct displacement *displacement, bool undo)
{
    zemax_put_surf(writer, "COORDBRK");
    put_parameter(writer, 1, &displacement->decenter[0], false, undo);
    put_parameter(writer, 2, &displacement->decenter[1], false, undo);
    for (int i = 0; i < 3; i++) {
        put_parameter(writer, 3 + i, &displacement->tilt[i], true, undo);
    }
    growing_string(&writer->out, undo ? "  PARM 6 1\r\n" : "  PARM 6 0\r\n");
}

/*
 * The types that hold aspheric terms: term i is the coefficient of r^(step i), in PARM i, or as
 * extra data behind the number of terms and the radius that r is a part of.
 */
static const struct asphere_type {
    const char *name;
    int step, terms;
    bool extra;
} asphere_types[] = {{"EVENASPH", 2, ZEMAX_TERMS, false},
                     {"XASPHERE", 2, LENS_COEFFICIENTS / 2, true},
                     {"ODDASPHE", 1, ZEMAX_TERMS, false},
                     {"XOSPHERE", 1, LENS_COEFFICIENTS, true}};

/* The first type that holds all that was given; null where there is nothing. */
static const struct asphere_type *asphere_type_of(const struct surface *surface)
{
    for (size_t k = 0; surface->coefficients != 0; k++) {
        const struct asphere_type *type = &asphere_types[k];
        unsigned held = 0;
        for (int i = 1; i <= type->terms; i++) {
            held |= 1u << surface_term(i * type->step);
        }
        if ((surface->coefficients & ~held) == 0) {
            return type;
        }
    }
    return NULL;
}

static const char *zemax_write_surface_type_of(const struct surface *surface)
{
    const struct asphere_type *type = asphere_type_of(surface);
    if (surface_has(surface, SURFACE_HAS_FOCAL)) {
        return "PARAXIAL";
    }
    if (!surface_is_round(surface)) {
        return "TOROIDAL";
    }
    if (type != NULL) {
        return type->name;
    }
    return "STANDARD";
}

/* From mm to the lens's unit. */
static void zemax_write_surface_put_coefficient(struct zemax_writer *writer, int order,
                                                struct figure figure)
{
    if (figure.typed.start == NULL && order > 1) {
        struct figure one = {.typed = text_of("1"), .variable = LENS_NONE};
        struct pair unit = figure_per_length(one, writer->lens->unit, order - 1).value;
        figure.value = pair_multiply(figure.value, unit);
    }
    growing_figure(&writer->out, &figure, NUMBER_UNSCALED);
}

const char *zemax_operand_of(const struct surface *surface, struct parameter parameter,
                             struct arena *arena)
{
    const struct asphere_type *type = asphere_type_of(surface);
    switch (parameter.kind) {
    case PARAMETER_RADIUS:
    case PARAMETER_CURVATURE:
        return surface->curved == CURVED_X ? NULL : "CRVT";
    case PARAMETER_CONIC:
        return surface->curved == CURVED_X ? NULL : "CONN";
    case PARAMETER_COEFFICIENT:
        return type == NULL || type->extra
                   ? NULL
                   : arena_printf(arena, "PAR%d", parameter.order / type->step);
    case PARAMETER_FOCAL:
        return "PAR1";
    default:
        return NULL;
    }
}

void zemax_put_number(struct zemax_writer *writer, struct parameter parameter,
                      const struct figure *figure)
{
    if (parameter.kind == PARAMETER_RADIUS && isinf(figure->value.hi)) {
        growing_string(&writer->out, "0");
    } else if (parameter.kind == PARAMETER_RADIUS) {
        put_reciprocal(writer, figure);
    } else if (parameter.kind == PARAMETER_CURVATURE) {
        zemax_write_surface_put_curvature(writer, figure);
    } else if (parameter.kind == PARAMETER_FOCAL) {
        growing_figure(&writer->out, figure, writer->unit);
    } else {
        zemax_write_surface_put_coefficient(writer, parameter.order, *figure);
    }
}

static void zemax_write_surface_put_coefficients(struct zemax_writer *writer,
                                                 const struct surface *surface)
{
    const struct asphere_type *type = asphere_type_of(surface);
    if (type != NULL && type->extra) {
        growing_format(&writer->out, "  XDAT 1 %d 0 0 1 0 0 \"\"\r\n  XDAT 2 1 0 0 1 0 0 \"\"\r\n",
                       type->terms);
    }
    for (int term = 1; type != NULL && term <= type->terms; term++) {
        int order = term * type->step, i = surface_term(order);
        if ((surface->coefficients >> i & 1) == 0) {
            continue;
        }
        growing_format(&writer->out, type->extra ? "  XDAT %d " : "  PARM %d ",
                       type->extra ? term + 2 : term);
        zemax_write_surface_put_coefficient(writer, order, surface->coefficient[i]);
        growing_string(&writer->out, type->extra ? " 0 0 1 0 0 \"\"\r\n" : "\r\n");
    }
}

/* CURV, of the section in y; a cylinder's other way stands in the first parameter, as a radius. */
static void zemax_write_surface_put_curve(struct zemax_writer *writer,
                                          const struct surface *surface)
{
    bool plane = surface->is_plane && !surface->has_curvature;
    bool cross = surface->curved == CURVED_X;
    growing_string(&writer->out, "  CURV ");
    if (plane || cross) {
        growing_string(&writer->out, "0");
    } else if (surface->has_curvature) {
        zemax_write_surface_put_curvature(writer, &surface->curvature);
    } else {
        put_reciprocal(writer, &surface->radius);
    }
    growing_string(&writer->out, " 0 0 0 0 \"\"\r\n");
    if (cross && !plane) {
        struct figure radius = surface->radius;
        if (surface->has_curvature) {
            radius = (struct figure){.value = pair_divide(pair_of(1), surface->curvature.value)};
        }
        put_parameter(writer, 1, &radius, false, false);
    }
}

/* A thick lens is PARAXIAL: one plane, which maps rays as the principal planes do. */
static bool zemax_write_surface_put_thick(struct zemax_writer *writer,
                                          const struct surface *surface, size_t number,
                                          struct error *error)
{
    bool is_distorting = false;
    growing_string(&writer->out, "  CURV 0 0 0 0 0 \"\"\r\n");
    put_parameter(writer, 1, zemax_write_surface_first_of(writer, &surface->focal), false, false);
    growing_string(&writer->out, "  PARM 2 1\r\n");
    for (int i = 0; i < 3; i++) {
        is_distorting = is_distorting || surface->distortion[i].value.hi != 0;
    }
    if (zemax_write_surface_first_of(writer, &surface->hiatus)->value.hi != 0 &&
        !foreign_lose(writer->job, error,
                      "surface %zu: a thick lens whose principal planes lie apart" LOSS_INSTEAD
                      "they fall together, and what lies behind moves",
                      number)) {
        return false;
    }
    return !is_distorting ||
           foreign_lose(writer->job, error,
                        "surface %zu: the distortion of a thick lens" LOSS_INSTEAD "left out",
                        number);
}

static bool zemax_write_surface_put_shape(struct zemax_writer *writer,
                                          const struct surface *surface, size_t number,
                                          struct error *error)
{
    if (surface_has(surface, SURFACE_HAS_FOCAL)) {
        return zemax_write_surface_put_thick(writer, surface, number, error);
    }
    bool cylinder = !surface_is_round(surface), cross = surface->curved == CURVED_X;
    bool has_conic = surface->conic.value.hi != 0;
    zemax_write_surface_put_curve(writer, surface);
    if (has_conic && !cross) {
        growing_string(&writer->out, "  CONI ");
        growing_figure(&writer->out, &surface->conic, NUMBER_UNSCALED);
        growing_string(&writer->out, "\r\n");
    }
    if (!cylinder) {
        zemax_write_surface_put_coefficients(writer, surface);
    }
    return !cylinder || (surface->coefficients == 0 && !(cross && has_conic)) ||
           foreign_lose(writer->job, error,
                        "surface %zu: a cylinder with aspheric terms" LOSS_INSTEAD
                        "they are left out",
                        number);
}

static void zemax_write_surface_put_thickness(struct zemax_writer *writer,
                                              const struct surface *surface, bool last)
{
    growing_string(&writer->out, "  DISZ ");
    if (surface->has_thickness) {
        zemax_write_surface_put_length(writer, &surface->thickness);
    } else {
        growing_string(&writer->out, "0");
    }
    bool paraxial = writer->lens->focus == FOCUS_PARAXIAL || !surface->has_thickness;
    growing_string(&writer->out, last && paraxial ? "\r\n  MAZH 0 0\r\n" : "\r\n");
}

static void put_diameter(struct zemax_writer *writer, const struct surface *surface)
{
    growing_string(&writer->out, "  DIAM ");
    zemax_put_half(writer, zemax_write_surface_first_of(writer, &surface->diameter));
    growing_string(&writer->out, " 1 0 0 1 \"\"\r\n");
}

static bool zemax_write_surface_check_surface(struct zemax_writer *writer,
                                              const struct surface *surface, size_t number,
                                              struct error *error)
{
    return surface->vary_count == 0 ||
           foreign_lose(writer->job, error,
                        "surface %zu: the marks of what may vary" LOSS_IS_MUTE LOSS_INSTEAD
                        "left out",
                        number);
}

bool zemax_put_surface(struct zemax_writer *writer, size_t index, struct error *error)
{
    const struct surface *surface = &writer->lens->surfaces[index];
    bool last = index + 1 == writer->lens->surface_count, is_decentred = surface->decentre != NULL;
    if (!zemax_write_surface_check_surface(writer, surface, index + 1, error)) {
        return false;
    }
    if (surface->coordinate_break != NULL) {
        zemax_write_surface_put_break(writer, surface->coordinate_break, false);
        growing_string(&writer->out, "  DISZ 0\r\n");
    }
    if (is_decentred) {
        zemax_write_surface_put_break(writer, surface->decentre, false);
        growing_string(&writer->out, "  DISZ 0\r\n");
    }
    zemax_put_surf(writer, zemax_write_surface_type_of(surface));
    growing_string(&writer->out, surface->is_stop ? "  STOP\r\n" : "");
    if (surface->name != NULL) {
        growing_string(&writer->out, "  COMM ");
        growing_string(&writer->out, surface->name);
        growing_string(&writer->out, "\r\n");
    }
    if (!zemax_write_surface_put_shape(writer, surface, index + 1, error)) {
        return false;
    }
    if (surface->has_diameter) {
        put_diameter(writer, surface);
    }
    if (!zemax_put_aperture(writer, surface, index + 1, error)) {
        return false;
    }
    if (surface_reflects(surface)) {
        growing_string(&writer->out, "  GLAS MIRROR 0 0 0 0 0 0 0 0 0 0\r\n");
    } else if (!zemax_put_medium(writer, &surface->medium, error)) {
        return false;
    }
    if (is_decentred) {
        growing_string(&writer->out, "  DISZ 0\r\n");
        zemax_write_surface_put_break(writer, surface->decentre, true);
    }
    writer->places[index] = writer->number - 1;
    writer->own_places[index] = writer->number - (is_decentred ? 2 : 1);
    zemax_write_surface_put_thickness(writer, surface, last);
    return true;
}
