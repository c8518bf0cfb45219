/* exchange/zemax/zemax_write_surface.c - surfaces and media of a .zmx file. */
/* SPDX-License-Identifier: MIT */
#include "exchange/zemax/zemax.h"
#include "exchange/zemax/zemax_writer.h"
#include "file/lens_build.h"
#include "file/lens_glass.h"
#include "optics/glass.h"
#include "optics/wavelength.h"

#include <math.h>
#include <string.h>

/* The lens's unit to a power, in mm. */
static struct pair zemax_unit(const struct lens_writer *writing, int power)
{
    const struct figure one = {.typed = text_of("1"), .variable = LENS_NONE};
    return figure_per_length(one, writing->lens->unit, power).value;
}

static const char *zemax_digits(const struct lens_writer *writing, const char *digits,
                                const char *end)
{
    return arena_string(writing->arena, digits, (size_t)(end - digits));
}

/* 1/R, with so many digits that the reader finds the same radius again. */
static const char *zemax_reciprocal(const struct lens_writer *writing, const struct figure *radius)
{
    char text[PAIR_LENGTH];
    double plain_radius = 0;
    const char *unit = writing->lens->unit;
    struct figure typed = figure_computed(radius->value, writing->scale, writing->arena), again;
    text_number(typed.typed, NUMBER_UNSCALED, &plain_radius);
    char *end = number_write_digits(text, 1 / plain_radius, 17);
    struct figure curvature = {.typed = text_between(text, end), .variable = LENS_NONE};
    curvature = figure_per_length(curvature, unit, -1);
    bool found = figure_radius_of(&curvature, unit, writing->arena, &again) &&
                 again.value.hi == radius->value.hi && again.value.lo == radius->value.lo;
    if (!found) {
        struct pair exact = pair_divide(pair_of(1), radius->value);
        exact = pair_multiply(exact, zemax_unit(writing, 1));
        end = pair_write_digits(text, exact, NUMBER_UNSCALED, 31);
    }
    return zemax_digits(writing, text, end);
}

/* A curvature as typed; longer where the reader would take it for 1/R of a short radius. */
static const char *zemax_curvature(const struct lens_writer *writing,
                                   const struct figure *curvature)
{
    struct figure radius, figure = *curvature;
    if (figure.typed.start == NULL) {
        const struct pair value = pair_multiply(figure.value, zemax_unit(writing, 1));
        figure = figure_computed(value, NUMBER_UNSCALED, writing->arena);
        figure.value = curvature->value;
    }
    if (figure_radius_of(&figure, writing->lens->unit, writing->arena, &radius)) {
        char text[PAIR_LENGTH];
        struct pair value = {0, 0};
        text_pair(figure.typed, NUMBER_UNSCALED, &value);
        return zemax_digits(writing, text, pair_write_digits(text, value, NUMBER_UNSCALED, 31));
    }
    return arena_string(writing->arena, figure.typed.start, figure.typed.length);
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
static struct glass_abbe zemax_abbe(const struct medium *medium)
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
static bool zemax_check_homonym(struct zemax_writer *writer, const struct medium *medium,
                                struct glass_abbe abbe, struct error *error)
{
    struct foreign_job *job = writer->writing.job;
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
    if (job->glasses == NULL || lens_glass_of(medium) == NULL) {
        return true;
    }
    if (!foreign_glass(job, &nowhere, &named, &other, error)) {
        if (error->code != ERROR_NONE) {
            return false;
        }
        foreign_lose(job, LOSS_OF_RAYS, NULL, "the glass %.*s:%.*s, of more than %d catalogues",
                     (int)catalog.length, catalog.start, (int)name.length, name.start,
                     ZEMAX_MOST_CATALOGS);
        return true;
    }
    const struct glass *read = lens_glass_of(&other);
    if (!text_identical(read->name, name) || !text_identical(read->catalog, catalog)) {
        foreign_lose(job, LOSS_OF_RAYS, NULL,
                     "the glass %.*s:%.*s: the file would be read with %.*s:%.*s",
                     (int)catalog.length, catalog.start, (int)name.length, name.start,
                     (int)read->catalog.length, read->catalog.start, (int)read->name.length,
                     read->name.start);
    }
    return true;
}

bool zemax_put_glass_name(struct zemax_writer *writer, const struct medium *medium,
                          struct error *error)
{
    struct text catalog, name;
    const struct glass_abbe none = {0, 0};
    if (medium->kind != MEDIUM_GLASS) {
        writing_put(&writer->writing, "\"\"");
        return true;
    }
    split_glass(medium, &catalog, &name);
    growing_text(&writer->writing.text, name);
    return zemax_check_homonym(writer, medium, none, error);
}

/* An index alone: Vd = 0 is no dispersion. */
static void zemax_put_model(struct lens_writer *writing, struct text index, struct text abbe)
{
    writing_put(writing, "  GLAS ___BLANK 1 0 %.*s %.*s 0 0 0 0 0 0\r\n", (int)index.length,
                index.start, (int)abbe.length, abbe.start);
}

static bool zemax_put_table(struct lens_writer *writing, const struct medium *medium,
                            struct error *error)
{
    struct pair index;
    double primary = lens_primary_wavelength(writing->lens);
    if (!medium_index(medium, primary, &index, error)) {
        return false;
    }
    char text[PAIR_LENGTH];
    zemax_put_model(writing, text_between(text, pair_write_shortest(text, index, NUMBER_UNSCALED)),
                    text_of("0"));
    foreign_lose(writing->job, LOSS_OF_RAYS,
                 arena_printf(writing->arena, "its index at %.6g um is used instead", primary),
                 "a medium given by a table");
    return true;
}

bool zemax_put_medium(struct zemax_writer *writer, const struct medium *medium, struct error *error)
{
    struct lens_writer *writing = &writer->writing;
    struct text catalog, name, rest = medium->written, index = text_cut(&rest, '/');
    if (medium_is_air(medium)) {
        return true;
    }
    switch (medium->kind) {
    case MEDIUM_CONSTANT:
        zemax_put_model(writing, index, text_of("0"));
        return true;
    case MEDIUM_MODEL:
        zemax_put_model(writing, index, rest);
        return true;
    case MEDIUM_TABLE:
        return zemax_put_table(writing, medium, error);
    default:
        break;
    }
    const struct glass_abbe abbe = zemax_abbe(medium);
    split_glass(medium, &catalog, &name);
    writing_put(writing, "  GLAS %.*s 0 0 %.8g %.8g 0 0 0 0 0 0\r\n", (int)name.length, name.start,
                abbe.nd, abbe.Vd);
    if (memchr(name.start, ' ', name.length) != NULL) {
        foreign_lose(writing->job, LOSS_OF_RAYS, NULL, "the glass '%.*s': its name has a blank",
                     (int)name.length, name.start);
    }
    return zemax_check_homonym(writer, medium, abbe, error);
}

void zemax_put_surf(struct zemax_writer *writer, const char *type)
{
    writing_put(&writer->writing, "SURF %zu\r\n  TYPE %s\r\n", writer->number++, type);
}

/* A number with the other sign: as typed, or computed. */
static struct figure zemax_negative(const struct lens_writer *writing, struct figure figure)
{
    if (figure.value.hi == 0 || figure.typed.start == NULL) {
        figure.value = pair_negate(figure.value);
        return figure;
    }
    bool minus = figure.typed.start[0] == '-', plus = figure.typed.start[0] == '+';
    const char *digits = arena_string(writing->arena, figure.typed.start + (minus || plus),
                                      figure.typed.length - (minus || plus));
    figure.typed = text_of(minus ? digits : ARENA_JOIN(writing->arena, "-", digits));
    return figure;
}

/* A break of the axis, or its undoing. */
static void zemax_put_break(struct zemax_writer *writer, const struct displacement *displacement,
                            bool undo)
{
    struct lens_writer *writing = &writer->writing;
    zemax_put_surf(writer, "COORDBRK");
    for (int i = 0; i < 5; i++) {
        struct figure figure = i < 2 ? displacement->decenter[i] : displacement->tilt[i - 2];
        figure = undo ? zemax_negative(writing, figure) : figure;
        writing_put(writing, "  PARM %d %s\r\n", i + 1,
                    i < 2 ? writing_length(writing, &figure, 1)
                          : writing_degrees(writing, &figure));
    }
    writing_put(writing, "  PARM 6 %d\r\n", undo);
}

/* The first type that holds all that was given; null where there is nothing. */
static const struct zemax_asphere *asphere_type_of(const struct surface *surface)
{
    for (size_t k = 0; k < ZEMAX_ASPHERES && surface->coefficients != 0; k++) {
        const struct zemax_asphere *type = &zemax_aspheres[k];
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

static const char *zemax_surface_type(const struct surface *surface)
{
    const struct zemax_asphere *type = asphere_type_of(surface);
    if (surface_has(surface, SURFACE_HAS_FOCAL)) {
        return "PARAXIAL";
    }
    if (!surface_is_round(surface)) {
        return "TOROIDAL";
    }
    return type != NULL ? type->name : "STANDARD";
}

/* From mm to the lens's unit. */
static const char *zemax_coefficient(const struct lens_writer *writing, int order,
                                     struct figure figure)
{
    if (figure.typed.start == NULL && order > 1) {
        figure.value = pair_multiply(figure.value, zemax_unit(writing, order - 1));
    }
    return writing_length(writing, &figure, 0);
}

const char *zemax_operand_of(const struct surface *surface, struct parameter parameter,
                             struct arena *arena)
{
    const struct zemax_asphere *type = asphere_type_of(surface);
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

const char *zemax_number_of(const struct lens_writer *writing, struct parameter parameter,
                            const struct figure *figure)
{
    switch (parameter.kind) {
    case PARAMETER_RADIUS:
        return isinf(figure->value.hi) ? "0" : zemax_reciprocal(writing, figure);
    case PARAMETER_CURVATURE:
        return zemax_curvature(writing, figure);
    case PARAMETER_FOCAL:
        return writing_length(writing, figure, 1);
    default:
        return zemax_coefficient(writing, parameter.order, *figure);
    }
}

static void zemax_put_coefficients(struct lens_writer *writing, const struct surface *surface)
{
    const struct zemax_asphere *type = asphere_type_of(surface);
    if (type != NULL && type->extra) {
        writing_put(writing, "  XDAT 1 %d 0 0 1 0 0 \"\"\r\n  XDAT 2 1 0 0 1 0 0 \"\"\r\n",
                    type->terms);
    }
    for (int term = 1; type != NULL && term <= type->terms; term++) {
        int order = term * type->step, i = surface_term(order);
        if ((surface->coefficients >> i & 1) == 0) {
            continue;
        }
        const char *digits = zemax_coefficient(writing, order, surface->coefficient[i]);
        if (type->extra) {
            writing_put(writing, "  XDAT %d %s 0 0 1 0 0 \"\"\r\n", term + 2, digits);
        } else {
            writing_put(writing, "  PARM %d %s\r\n", term, digits);
        }
    }
}

/* CURV, of the section in y; a cylinder's other way stands in the first parameter, as a radius. */
static void zemax_put_curve(struct lens_writer *writing, const struct surface *surface)
{
    bool plane = surface->is_plane && !surface->has_curvature;
    bool cross = surface->curved == CURVED_X;
    const char *curvature = "0";
    if (!plane && !cross) {
        curvature = surface->has_curvature ? zemax_curvature(writing, &surface->curvature)
                                           : zemax_reciprocal(writing, &surface->radius);
    }
    writing_put(writing, "  CURV %s 0 0 0 0 \"\"\r\n", curvature);
    if (cross && !plane) {
        struct figure radius = surface->radius;
        if (surface->has_curvature) {
            radius = (struct figure){.value = pair_divide(pair_of(1), surface->curvature.value),
                                     .variable = LENS_NONE};
        }
        writing_put(writing, "  PARM 1 %s\r\n", writing_length(writing, &radius, 1));
    }
}

/* A thick lens is PARAXIAL: one plane, which maps rays as the principal planes do. */
static void zemax_put_thick(struct lens_writer *writing, const struct surface *surface,
                            size_t number)
{
    const size_t variable = surface->hiatus.variable;
    const struct figure *hiatus =
        variable == LENS_NONE ? &surface->hiatus : &writing->lens->variables[variable].values[0];
    bool is_distorting = false;
    writing_put(writing, "  CURV 0 0 0 0 0 \"\"\r\n  PARM 1 %s\r\n  PARM 2 1\r\n",
                writing_length(writing, &surface->focal, 1));
    for (int i = 0; i < 3; i++) {
        is_distorting = is_distorting || surface->distortion[i].value.hi != 0;
    }
    if (hiatus->value.hi != 0) {
        foreign_lose(writing->job, LOSS_OF_RAYS, "they fall together, and what lies behind moves",
                     "surface %zu: a thick lens whose principal planes lie apart", number);
    }
    if (is_distorting) {
        foreign_lose(writing->job, LOSS_OF_RAYS, "left out",
                     "surface %zu: the distortion of a thick lens", number);
    }
}

static void zemax_put_shape(struct lens_writer *writing, const struct surface *surface,
                            size_t number)
{
    bool cylinder = !surface_is_round(surface), cross = surface->curved == CURVED_X;
    bool has_conic = surface->conic.value.hi != 0;
    if (surface_has(surface, SURFACE_HAS_FOCAL)) {
        zemax_put_thick(writing, surface, number);
        return;
    }
    zemax_put_curve(writing, surface);
    if (has_conic && !cross) {
        writing_put(writing, "  CONI %s\r\n", writing_length(writing, &surface->conic, 0));
    }
    if (!cylinder) {
        zemax_put_coefficients(writing, surface);
    } else if (surface->coefficients != 0 || (cross && has_conic)) {
        foreign_lose(writing->job, LOSS_OF_RAYS, "they are left out",
                     "surface %zu: a cylinder with aspheric terms", number);
    }
}

bool zemax_put_surface(struct zemax_writer *writer, size_t index, struct error *error)
{
    struct lens_writer *writing = &writer->writing;
    const struct surface *surface = &writing->lens->surfaces[index];
    bool last = index + 1 == writing->lens->surface_count, is_decentred = surface->decentre != NULL;
    bool paraxial = writing->lens->focus == FOCUS_PARAXIAL || !surface->has_thickness;
    if (surface->vary_count > 0) {
        foreign_lose(writing->job, LOSS_OF_NOTHING, "left out",
                     "surface %zu: the marks of what may vary", index + 1);
    }
    if (surface->coordinate_break != NULL) {
        zemax_put_break(writer, surface->coordinate_break, false);
        writing_put(writing, "  DISZ 0\r\n");
    }
    if (is_decentred) {
        zemax_put_break(writer, surface->decentre, false);
        writing_put(writing, "  DISZ 0\r\n");
    }
    zemax_put_surf(writer, zemax_surface_type(surface));
    growing_string(&writing->text, surface->is_stop ? "  STOP\r\n" : "");
    if (surface->name != NULL) {
        writing_put(writing, "  COMM %s\r\n", surface->name);
    }
    zemax_put_shape(writing, surface, index + 1);
    if (surface->has_diameter) {
        writing_put(writing, "  DIAM %s 1 0 0 1 \"\"\r\n", zemax_half(writing, &surface->diameter));
    }
    zemax_put_aperture(writing, surface, index + 1);
    if (surface_reflects(surface)) {
        writing_put(writing, "  GLAS MIRROR 0 0 0 0 0 0 0 0 0 0\r\n");
    } else if (!zemax_put_medium(writer, &surface->medium, error)) {
        return false;
    }
    if (is_decentred) {
        writing_put(writing, "  DISZ 0\r\n");
        zemax_put_break(writer, surface->decentre, true);
    }
    writer->places[index] = writer->number - 1;
    writer->own_places[index] = writer->number - (is_decentred ? 2 : 1);
    writing_put(writing, "  DISZ %s\r\n%s",
                surface->has_thickness ? writing_length(writing, &surface->thickness, 1) : "0",
                last && paraxial ? "  MAZH 0 0\r\n" : "");
    return true;
}
