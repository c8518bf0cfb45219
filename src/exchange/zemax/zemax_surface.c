/* exchange/zemax/zemax_surface.c - the surfaces of a .zmx file as those of a lens. */
/* SPDX-License-Identifier: MIT */
#include "exchange/zemax/zemax.h"

#include "base/constants.h"
#include "file/lens_unit.h"

#include <math.h>
#include <string.h>

const struct zemax_asphere zemax_aspheres[ZEMAX_ASPHERES] = {
    {"EVENASPH", 2, ZEMAX_TERMS, false},
    {"XASPHERE", 2, LENS_COEFFICIENTS / 2, true},
    {"ODDASPHE", 1, ZEMAX_TERMS, false},
    {"XOSPHERE", 1, LENS_COEFFICIENTS, true}};

static bool is_type(const struct zemax_surface *surface, const char *type)
{
    return surface->type == NULL || surface->type->first.start == NULL
               ? strcmp(type, "STANDARD") == 0
               : text_same(surface->type->first, type);
}

static bool is_mirror(const struct zemax_surface *surface)
{
    return surface->glass != NULL && text_same(surface->glass->keyword, "MIRROR");
}

bool zemax_medium(struct zemax_file *file, const struct zemax_surface *surface,
                  const struct medium *before, struct medium *medium)
{
    const struct zemax_line *line = surface->glass;
    *medium = is_type(surface, "COORDBRK") || is_mirror(surface) ? *before : medium_air;
    if (line == NULL || is_mirror(surface) || text_same(line->keyword, "AIR")) {
        return true;
    }
    return zemax_glass(file, line, medium);
}

/* A figure in the file's unit to a power, from one that was read without a unit. */
static struct figure zmx_in_unit(struct zemax_file *file, struct figure figure, int power)
{
    return figure_per_length(figure, file->build.lens->unit, power);
}

static void set_coefficient(struct zemax_file *file, struct surface *to, int order,
                            struct figure figure)
{
    if (figure.value.hi != 0) {
        int i = surface_term(order);
        to->coefficient[i] = zmx_in_unit(file, figure, 1 - order);
        to->coefficients |= 1u << i;
    }
}

/* XDAT 1 N, XDAT 2 r0, XDAT i+2 alpha_i: alpha (r/r0)^(i step) */
static void read_extended(struct zemax_file *file, size_t at, int step, struct surface *to)
{
    const struct zemax_surface *from = &file->surfaces[at];
    double terms = zemax_number(from->extras[1], 1), norm = zemax_number(from->extras[2], 1);
    struct pair scale = pair_of(1), r0 = pair_of(1);
    if (from->extras[2] != NULL && norm != 0) {
        r0 = from->extras[2]->numbers[1].value;
    }
    for (size_t i = 1; (double)i <= terms && i + 2 < ZEMAX_EXTRAS; i++) {
        const struct zemax_line *line = from->extras[i + 2];
        int order = step * (int)i;
        for (int k = 0; k < step; k++) {
            scale = pair_multiply(scale, r0);
        }
        if (zemax_number(line, 1) == 0) {
            continue;
        }
        if (order > LENS_COEFFICIENTS) {
            zemax_loss(file, line, LOSS_OF_RAYS, NULL,
                       "the coefficient A%d: lenscalc goes up to A20", order);
            return;
        }
        struct figure figure = line->numbers[1];
        if (r0.hi != 1 || r0.lo != 0) {
            figure = figure_computed(pair_divide(figure.value, scale), NUMBER_UNSCALED,
                                     file->job->arena);
        }
        set_coefficient(file, to, order, figure);
    }
}

/* The tangents of a plane z = x tan a + y tan b as turns about its vertex. */
static const struct displacement *slopes_as_tilt(struct zemax_file *file, size_t at)
{
    struct displacement *decentre = ARENA_NEW(file->job->arena, struct displacement);
    double a = zemax_parameter(file, at, 1).value.hi, b = zemax_parameter(file, at, 2).value.hi;
    double turns[3] = {atan(b), atan(-a * cos(atan(b))) + 0., 0}; /* -0 + 0 is 0 */
    for (int i = 0; i < 3; i++) {
        decentre->tilt[i] = figure_of(turns[i] / RADIANS_PER_DEGREE, file->job->arena);
        decentre->tilt[i].value =
            pair_multiply(decentre->tilt[i].value, pair_of(RADIANS_PER_DEGREE));
        decentre->decenter[i % 2] = figure_of(0, file->job->arena);
    }
    return decentre;
}

/*
 * A surface of the type PARAXIAL: a thick lens whose principal planes fall together, of the focal
 * length PARM 1, 1/power in any media. PARM 2 says how paths are counted, and moves no ray.
 *
 * Formula   n' u' = n u - h/f with u the tangents, as thick_lens_slope
 * Errors    no focal length, or 0; a mirror; further parameters are losses
 */
static bool set_paraxial(struct zemax_file *file, size_t at, struct surface *to)
{
    const struct zemax_surface *from = &file->surfaces[at];
    const struct figure focal = zmx_in_unit(file, zemax_parameter(file, at, 1), 1);
    const struct zemax_line *given = from->parameters[1];
    const struct zemax_line *place = given != NULL ? given : from->type;
    if (from->glass != NULL && text_same(from->glass->keyword, "MIRROR")) {
        return zemax_loss(file, from->glass, LOSS_OF_LENS, NULL, "an ideal lens that is a mirror");
    }
    if (focal.value.hi == 0) {
        return zemax_fail(place, given != NULL ? place->keyword : place->first,
                          given != NULL ? "an ideal lens of the focal length 0"
                                        : "an ideal lens without a focal length");
    }
    for (size_t i = 3; i < ZEMAX_PARAMETERS; i++) {
        if (zemax_number(from->parameters[i], 1) != 0) {
            zemax_loss(file, from->parameters[i], LOSS_OF_RAYS, "left out",
                       "parameter %zu of an ideal lens", i);
        }
    }
    if (zemax_number(from->curvature, 0) != 0 || zemax_number(from->conic, 0) != 0) {
        zemax_remark(file, "surface %zu is an ideal lens: its curvature and conic do nothing",
                     from->number);
    }
    const struct figure none = {.variable = LENS_NONE};
    to->kind = SURFACE_THICK;
    to->is_plane = true;
    to->has_curvature = false;
    to->radius = to->curvature = to->conic = none;
    to->focal = focal;
    to->hiatus = figure_zero();
    return true;
}

/*
 * Types that are what STANDARD is where their own numbers are 0; a grating without lines, or of the
 * order 0; a Jones matrix, which only acts on polarised light.
 */
static bool is_standard_there(struct zemax_file *file, size_t at)
{
    static const char *const shapes[] = {"IRREGULA", "BINARY_1", "BINARY_2",
                                         "XPOLYNOM", "SZERNSAG", "FZERNSAG"};
    const struct zemax_surface *from = &file->surfaces[at];
    for (size_t i = 0; i < sizeof shapes / sizeof shapes[0]; i++) {
        if (is_type(from, shapes[i])) {
            /* all that stand behind the first two of XDAT, which are a count and a length */
            bool none = true, stated = from->extras[1] != NULL;
            for (size_t k = 1; k < ZEMAX_PARAMETERS; k++) {
                none = none && zemax_parameter(file, at, k).value.hi == 0;
                stated = stated || from->parameters[k] != NULL;
            }
            for (size_t k = 3; k < ZEMAX_EXTRAS; k++) {
                none = none && zemax_number(from->extras[k], 1) == 0;
            }
            return none && stated;
        }
    }
    bool bends =
        from->parameters[1] == NULL || from->parameters[2] == NULL ||
        (zemax_parameter(file, at, 1).value.hi != 0 && zemax_parameter(file, at, 2).value.hi != 0);
    return is_type(from, "JONESMAT") || (is_type(from, "DGRATING") && !bends);
}

static bool set_type(struct zemax_file *file, size_t at, struct surface *to)
{
    const struct zemax_surface *from = &file->surfaces[at];
    for (size_t k = 0; k < ZEMAX_ASPHERES; k++) {
        const struct zemax_asphere *type = &zemax_aspheres[k];
        if (is_type(from, type->name) && type->extra) {
            read_extended(file, at, type->step, to);
            return true;
        }
        if (is_type(from, type->name)) {
            for (int i = 1; i <= type->terms; i++) {
                set_coefficient(file, to, type->step * i, zemax_parameter(file, at, (size_t)i));
            }
            return true;
        }
    }
    if (is_type(from, "STANDARD") || is_type(from, "COORDBRK")) {
        return true;
    }
    if (is_type(from, "TILTSURF")) {
        to->decentre = slopes_as_tilt(file, at);
        return true;
    }
    if (is_type(from, "TOROIDAL")) {
        /* CURV is that of the y-z section, PARM 1 the radius of the other one, 0 a plane. */
        struct figure radius = zemax_parameter(file, at, 1);
        bool other = false;
        for (size_t i = 2; i < ZEMAX_PARAMETERS; i++) {
            other = other || zemax_parameter(file, at, i).value.hi != 0;
        }
        bool both = radius.value.hi != 0 && (!to->is_plane || to->has_curvature);
        if (both || other) {
            zemax_loss(file, file->surfaces[at].type, LOSS_OF_POWER,
                       "its y-z section is used instead, as a cylinder", "a toroid");
        }
        to->curved = CURVED_Y;
        if (radius.value.hi != 0 && !both) {
            to->curved = CURVED_X;
            to->is_plane = false;
            to->radius = zmx_in_unit(file, radius, 1);
        }
        return true;
    }
    if (is_type(from, "PARAXIAL")) {
        return set_paraxial(file, at, to);
    }
    struct text type = from->type->first;
    if (is_standard_there(file, at)) {
        zemax_remark(file, "line %ld: %.*s acts as STANDARD here", from->type->words.number,
                     text_shown(type), type.start);
        return true;
    }
    return foreign_loss(file->job, &from->type->words, type, LOSS_OF_POWER,
                        "its standard form with curvature and conic is used instead",
                        "a surface of the type %.*s", text_shown_up_to(type, 20), type.start);
}

/* Is a pick-up's number a surface before this one, in the same configuration? */
static bool is_earlier(double source, size_t at, double configuration)
{
    return source >= 0 && source < (double)at && configuration == 0;
}

/* DIAM value code surface column scale: does the semi-diameter not follow as it says? */
static bool is_diameter_astray(const struct zemax_file *file, size_t at)
{
    const struct zemax_line *line = file->surfaces[at].diameter;
    if (zemax_number(line, 1) != 2) {
        return false;
    }
    double source = zemax_number(line, 2);
    bool sound = is_earlier(source, at, zemax_number(line, 3));
    const struct zemax_line *other = sound ? file->surfaces[(size_t)source].diameter : NULL;
    double scale = line->count > 4 ? zemax_number(line, 4) : 1, is = zemax_number(line, 0);
    return !(fabs(scale * zemax_number(other, 0) - is) <= 1e-9 * is);
}

static bool is_parameter_astray(const struct zemax_line *line, size_t at)
{
    return line != NULL &&
           !(line->count >= 3 && is_earlier(zemax_number(line, 1), at, zemax_number(line, 4)));
}

/*
 * The numbers of other pick-ups stand as the program stored them; where that is not what the
 * pick-up gives, it is said. CONI has no place for a scale.
 */
static void check_astray(struct zemax_file *file, size_t at)
{
    const struct zemax_surface *from = &file->surfaces[at];
    if (is_diameter_astray(file, at)) {
        zemax_stands(file, from->diameter, "a semi-diameter that follows another number");
    }
    if (zemax_number(from->conic, 1) > 1) {
        zemax_stands(file, from->conic, "a conic that follows another number");
    }
    for (size_t i = 0; i < ZEMAX_PARAMETERS; i++) {
        if (is_parameter_astray(from->pickups[i], at)) {
            zemax_stands(file, from->pickups[i], "a parameter that follows no earlier surface");
        }
    }
}

/*
 * The radius of a circular aperture about the vertex, else the semi-diameter; null where there is
 * none. Of an aperture that is lost only an automatic semi-diameter stands: it surrounds the beam,
 * and clips nothing that the aperture lets through.
 */
static const struct figure *clear_radius_of(const struct zemax_surface *from)
{
    const struct figure *half = from->diameter != NULL ? &from->diameter->numbers[0] : NULL;
    if (from->has_lost_aperture) {
        return zemax_number(from->diameter, 1) == 0 ? half : NULL;
    }
    bool is_centred = from->clear != NULL && from->aperture_shift == NULL;
    return is_centred ? &from->clear->numbers[1] : half;
}

static void set_comment(struct zemax_file *file, const struct zemax_surface *from,
                        struct surface *to)
{
    if (from->comment.length > 0) {
        const char *text = lens_build_string(&file->build, from->comment);
        char *name = arena_string(file->job->arena, text, strlen(text));
        for (char *c = name; *c != '\0'; c++) {
            *c = (char)(*c == '"' ? '\'' : *c);
        }
        to->name = name;
    }
}

static bool add_zmx_surface(struct zemax_file *file, size_t at)
{
    const struct zemax_surface *from = &file->surfaces[at];
    const struct medium before = zemax_medium_before(file->build.lens);
    struct surface *to = lens_build_surface(&file->build);
    to->coordinate_break = file->coordinate_break;
    file->coordinate_break = NULL;
    if (!zemax_medium(file, from, &before, &to->medium)) {
        return false;
    }
    if (zemax_number(from->curvature, 0) != 0) {
        zemax_set_curvature(file, zmx_in_unit(file, from->curvature->numbers[0], -1), to);
    }
    if (is_mirror(from)) {
        to->kind = SURFACE_REFLECT;
    }
    if (zemax_number(from->conic, 0) != 0) {
        to->conic = from->conic->numbers[0];
    }
    if (!set_type(file, at, to)) {
        return false;
    }
    /* Twice the radius. */
    const struct figure *radius = clear_radius_of(from);
    if (radius != NULL && radius->value.hi > 0) {
        struct pair twice = {2 * radius->value.hi, 2 * radius->value.lo};
        to->diameter =
            figure_computed(twice, lens_unit_scale(file->build.lens->unit), file->job->arena);
        to->has_diameter = true;
    }
    set_comment(file, from, to);
    to->is_stop = from->is_stop;
    return zemax_set_aperture(file, from, to);
}

/* A surface, or a break with what it needs; `place` receives where it is in the lens, if it is. */
static bool add_next(struct zemax_file *file, size_t at, size_t *place)
{
    struct lens *lens = file->build.lens;
    const struct zemax_surface *surface = &file->surfaces[at];
    *place = LENS_NONE;
    zemax_add_shift(file, at, false);
    if (is_type(surface, "COORDBRK")) {
        zemax_add_break(file, at);
        if (zemax_is_bare(file, at)) {
            return true;
        }
        zemax_add_plane(file);
        set_comment(file, surface, &lens->surfaces[lens->surface_count - 1]);
    } else if (!add_zmx_surface(file, at)) {
        return false;
    }
    *place = lens->surface_count - 1;
    if (surface->is_stop && lens->stop != LENS_NONE) {
        return zemax_fail(surface->surf, surface->surf->keyword, "a second stop");
    }
    if (surface->is_stop) {
        lens_build_stop(&file->build, *place);
    }
    zemax_add_shift(file, at, true);
    return true;
}

bool zemax_surfaces(struct zemax_file *file)
{
    size_t *places = ARENA_ARRAY(file->job->arena, file->surface_count, size_t);
    places[0] = places[file->surface_count - 1] = LENS_NONE;
    for (size_t i = 1; i + 1 < file->surface_count; i++) {
        places[i] = LENS_NONE;
        check_astray(file, i);
        if (i > file->passed && !add_next(file, i, &places[i])) {
            return false;
        }
    }
    if (!zemax_thicknesses(file, places)) {
        return false;
    }
    /* A plane that turns the axis at the image. */
    const size_t at = file->surface_count - 1;
    if (zemax_is_tilted(file, at)) {
        zemax_add_shift(file, at, false);
        if (is_type(&file->surfaces[at], "TILTSURF")) {
            zemax_hold_break(file, slopes_as_tilt(file, at));
        }
        zemax_add_plane(file);
    }
    return true;
}

/* -------- pick-ups that go in a circle -------- */

/* What is picked up: the parameters by their numbers, and behind them the others. */
enum { THICKNESS = ZEMAX_PARAMETERS, CURVATURE, DIAMETER, KINDS };

/* The line of a pick-up, and where in it the surface, then the column, stand; null: none. */
static const struct zemax_line *pickup_of(const struct zemax_surface *surface, size_t kind,
                                          size_t *source, size_t *column)
{
    const struct zemax_line *line = NULL;
    switch (kind) {
    case THICKNESS: /* PZUP surface scale offset column */
        *source = 0;
        *column = 3;
        line = surface->solve;
        return line != NULL && text_same(line->keyword, "PZUP") ? line : NULL;
    case CURVATURE: /* CURV c 4 surface scale column */
        *source = 2;
        *column = 4;
        line = surface->curvature;
        return zemax_number(line, 1) == 4 ? line : NULL;
    case DIAMETER: /* DIAM value 2 surface column */
        *source = 2;
        *column = 3;
        line = surface->diameter;
        return zemax_number(line, 1) == 2 ? line : NULL;
    default: /* PPAR number surface scale offset column */
        *source = 1;
        *column = 4;
        return surface->pickups[kind];
    }
}

/* The surface that a number follows; surface_count: none, or another column of one. */
static size_t source_of(const struct zemax_file *file, size_t at, size_t kind,
                        const struct zemax_line **line)
{
    size_t place = 0, column = 0;
    *line = pickup_of(&file->surfaces[at], kind, &place, &column);
    double source = zemax_number(*line, place);
    bool follows = *line != NULL && place < (*line)->count && zemax_number(*line, column) == 0;
    return follows && source >= 0 && source < (double)file->surface_count ? (size_t)source
                                                                          : file->surface_count;
}

/* From a pick-up of a later surface, or of its own, along those that it follows. */
static bool check_from(const struct zemax_file *file, size_t at, size_t kind)
{
    const struct zemax_line *line, *next;
    size_t source = source_of(file, at, kind, &line), walk = source;
    if (source < at) {
        return true; /* a circle has one that follows a later surface */
    }
    for (size_t i = 0; i < file->surface_count && walk < file->surface_count; i++) {
        if (walk == at) {
            return zemax_fail(line, line->keyword,
                              "the pick-ups go in a circle: surface %zu follows surface %zu, "
                              "which follows it",
                              at, source);
        }
        walk = source_of(file, walk, kind, &next);
    }
    return true;
}

bool zemax_check_circles(const struct zemax_file *file)
{
    for (size_t at = 0; at < file->surface_count; at++) {
        for (size_t kind = 0; kind < KINDS; kind++) {
            if (!check_from(file, at, kind)) {
                return false;
            }
        }
    }
    return true;
}
