/* commands/lens/draw_elements.c - the elements of a lens in numbers, beside its cross-section. */
/* SPDX-License-Identifier: MIT */
#include "commands/lens/draw_elements.h"

#include "base/arena.h"
#include "base/constants.h"
#include "draw/element_sheet.h"
#include "optics/lensmaker.h"
#include "optics/tolerance.h"
#include "optics/wavelength.h"

#include <math.h>

/* One piece of glass. */
struct draw_element {
    const struct surface *front, *back; /* where light comes in, and leaves */
    double radius[2];                   /* mm; infinite: a plane */
    double diameter[2];                 /* as drawn, mm */
    double thickness;                   /* mm */
    double index;                       /* at the wavelength of the drawing */
    double focal;                       /* in air, mm */
};

static struct draw_element draw_element_of(const struct layout *layout, size_t number)
{
    const struct setup *setup = layout->setup;
    const size_t i = layout->elements[number].surface;
    const struct surface *surfaces = &setup->lens->surfaces[i];
    struct draw_element element = {.front = &surfaces[0],
                                   .back = &surfaces[1],
                                   .thickness = fabs(surfaces[0].thickness.value.hi),
                                   .index = fabs(layout->light->system.index[i + 1].hi)};
    for (size_t side = 0; side < 2; side++) {
        double c = surface_curvature(&surfaces[side], setup->section).hi;
        element.radius[side] = c > 0 || c < 0 ? 1 / c : INFINITY;
        element.diameter[side] = 2 * layout->semi[i + side];
    }
    const struct lensmaker lens = {.n0 = 1,
                                   .n = element.index,
                                   .n1 = 1,
                                   .R1 = element.radius[0],
                                   .R2 = element.radius[1],
                                   .d = element.thickness};
    struct lensmaker_facts facts;
    lensmaker_facts(&lens, &facts);
    element.focal = facts.efl;
    return element;
}

/* Reciprocal dispersion (n - 1)/(n1 - n2); NaN where the medium has no index there. um. */
static double draw_element_dispersion(const struct medium *medium, double middle, double shorter,
                                      double longer)
{
    const double wavelengths[] = {middle, shorter, longer};
    struct pair n[3];
    struct error none;
    for (size_t i = 0; i < 3; i++) {
        if (!medium_index(medium, wavelengths[i], &n[i], &none)) {
            return NAN;
        }
    }
    return (n[0].hi - 1) / (n[1].hi - n[2].hi);
}

/* A number of so many digits, "∞", or a dash. */
static const char *cell_text(double value, int digits, struct arena *arena)
{
    if (isfinite(value)) {
        return arena_printf(arena, "%.*g", digits, value);
    }
    return isnan(value) ? "–" : "∞";
}

struct section_table draw_elements_table(const struct layout *layout)
{
    static const char *const heads[] = {"element", "surfaces", "glass",   "n",
                                        "V_d",     "R1 (mm)",  "R2 (mm)", "thickness (mm)",
                                        "Ø (mm)",  "f (mm)"};
    enum { COLUMNS = sizeof heads / sizeof heads[0] };
    struct arena *arena = layout->arena;
    const char **cells = ARENA_ARRAY(arena, COLUMNS * layout->element_count, const char *);
    for (size_t k = 0; k < layout->element_count; k++) {
        const struct draw_element element = draw_element_of(layout, k);
        const size_t i = layout->elements[k].surface;
        const char **row = &cells[COLUMNS * k];
        row[0] = arena_printf(arena, "%zu", k + 1);
        row[1] = arena_printf(arena, "%zu-%zu", i + 1, i + 2);
        row[2] = layout->glasses[layout->elements[k].glass];
        row[3] = cell_text(element.index, 6, arena);
        row[4] = cell_text(draw_element_dispersion(&element.front->medium, WAVELENGTH_D,
                                                   WAVELENGTH_F, WAVELENGTH_C),
                           4, arena);
        row[5] = cell_text(element.radius[0], 6, arena);
        row[6] = cell_text(element.radius[1], 6, arena);
        row[7] = cell_text(element.thickness, 5, arena);
        row[8] = cell_text(fmax(element.diameter[0], element.diameter[1]), 4, arena);
        row[9] = cell_text(element.focal, 5, arena);
    }
    return (struct section_table){COLUMNS, layout->element_count, heads, cells};
}

/* -------- for the shop -------- */

static const char *const NOT_STATED = "\u2013";

/* What the file allows of a surface, or of the glass behind it; of several lines the last. */
static const struct lens_tolerance *element_tolerance(const struct lens *lens,
                                                      enum tolerance_kind kind, size_t surface)
{
    const struct lens_tolerance *found = NULL;
    for (size_t i = 0; i < lens->tolerance_count; i++) {
        const struct lens_tolerance *one = &lens->tolerances[i];
        const size_t first = kind == TOLERANCE_WEDGE && !one->is_range ? one->last : one->first;
        if (one->kind == kind && first <= surface && surface <= one->last) {
            found = one;
        }
    }
    return found;
}

/* An amount behind plus and minus; empty where there is none, or where it is in fringes. */
static const char *element_allowed(const struct lens *lens, enum tolerance_kind kind,
                                   size_t surface, struct arena *arena)
{
    const struct lens_tolerance *one = element_tolerance(lens, kind, surface);
    if (one == NULL || one->unit == TOLERANCE_FRINGES) {
        return "";
    }
    return arena_printf(arena, " \u00b1 %.4g%s", one->amount.value.hi,
                        one->unit == TOLERANCE_PERCENT ? " %" : "");
}

/* 3/A(B): sagitta error and irregularity in fringes of 546.07 nm; a dash where it is not stated. */
static const char *element_form(const struct lens *lens, size_t surface, struct arena *arena)
{
    const struct lens_tolerance *power = element_tolerance(lens, TOLERANCE_RADIUS, surface);
    const struct lens_tolerance *irregular =
        element_tolerance(lens, TOLERANCE_IRREGULARITY, surface);
    const bool has_power = power != NULL && power->unit == TOLERANCE_FRINGES;
    const char *A = has_power ? arena_printf(arena, "%.3g", power->amount.value.hi) : NOT_STATED;
    if (irregular == NULL) {
        return arena_printf(arena, "3/ %s", A);
    }
    const double fringes = irregular->unit == TOLERANCE_FRINGES
                               ? irregular->amount.value.hi
                               : irregular->amount.value.hi / TOLERANCE_FRINGE_MM;
    return arena_printf(arena, "3/ %s(%.3g)", A, fringes);
}

static const char *element_centring(const struct lens *lens, size_t surface, struct arena *arena)
{
    const struct lens_tolerance *tilt = element_tolerance(lens, TOLERANCE_TILT, surface);
    const struct lens_tolerance *wedge = element_tolerance(lens, TOLERANCE_WEDGE, surface);
    if (tilt != NULL) {
        return arena_printf(arena, "4/ %.3g'", tilt->amount.value.hi * DEGREES_PER_RADIAN * 60);
    }
    if (wedge != NULL && wedge->unit == TOLERANCE_ANGLE) {
        return arena_printf(arena, "4/ %.3g'", wedge->amount.value.hi * DEGREES_PER_RADIAN * 60);
    }
    return wedge != NULL ? arena_printf(arena, "4/ runout %.3g mm", wedge->amount.value.hi)
                         : arena_printf(arena, "4/ %s", NOT_STATED);
}

/* "R 58.95 ± 0.1" */
static const char *element_radius(const struct layout *layout, const struct draw_element *element,
                                  size_t i, size_t side)
{
    const double R = element->radius[side];
    return isinf(R) ? "R \u221e"
                    : arena_printf(layout->arena, "R %.7g%s", fabs(R),
                                   element_allowed(layout->setup->lens, TOLERANCE_RADIUS, i + side,
                                                   layout->arena));
}

static void element_surface_lines(const struct layout *layout, const struct draw_element *element,
                                  size_t i, size_t side, const char **lines)
{
    struct arena *arena = layout->arena;
    const struct lens *lens = layout->setup->lens;
    const double R = element->radius[side];
    const bool convex = side == 0 ? R > 0 : R < 0;
    const bool is_stated = lens->surfaces[i + side].has_diameter;
    const char *diameter =
        arena_printf(arena, is_stated ? "%.5g" : "(%.5g)", element->diameter[side]);
    const char *kind = convex ? "CX" : "CC";
    lines[0] = isinf(R) ? "R \u221e"
                        : arena_printf(arena, "R %.7g %s%s", fabs(R), kind,
                                       element_allowed(lens, TOLERANCE_RADIUS, i + side, arena));
    lines[1] = arena_printf(arena, "\u00d8e %s", diameter);
    lines[2] = arena_printf(arena, "Prot. chamfer %s", NOT_STATED);
    lines[3] = arena_printf(arena, "Coating %s", NOT_STATED);
    lines[4] = element_form(lens, i + side, arena);
    lines[5] = element_centring(lens, i + side, arena);
    lines[6] = arena_printf(arena, "5/ %s", NOT_STATED);
    lines[7] = arena_printf(arena, "6/ %s    texture %s", NOT_STATED, NOT_STATED);
}

static void element_material_lines(const struct layout *layout, const struct draw_element *element,
                                   size_t number, const char **lines)
{
    struct arena *arena = layout->arena;
    const struct lens *lens = layout->setup->lens;
    const size_t i = layout->elements[number].surface;
    const double V = draw_element_dispersion(&element->front->medium, WAVELENGTH_E,
                                             WAVELENGTH_F_PRIME, WAVELENGTH_C_PRIME);
    struct pair n;
    struct error none;
    lines[0] = layout->glasses[layout->elements[number].glass];
    lines[1] = medium_index(&element->front->medium, WAVELENGTH_E, &n, &none)
                   ? arena_printf(arena, "n(546.07 nm) %.5f%s", n.hi,
                                  element_allowed(lens, TOLERANCE_INDEX, i, arena))
                   : arena_printf(arena, "n(546.07 nm) %s", NOT_STATED);
    lines[2] = arena_printf(arena, "\u03bd(546.07 nm) %s%s", cell_text(V, 4, arena),
                            element_allowed(lens, TOLERANCE_ABBE, i, arena));
    lines[3] = arena_printf(arena, "0/ %s", NOT_STATED);
    lines[4] = arena_printf(arena, "1/ %s", NOT_STATED);
    lines[5] = arena_printf(arena, "2/ %s", NOT_STATED);
    lines[6] = lines[7] = NULL;
}

/* Up the left surface, along the rim, down the right one, with flats out to the larger of them. */
static void element_outline(const struct layout *layout, const struct draw_element *element,
                            struct element_sheet *sheet)
{
    enum { SAMPLES = 64 };
    double *z = ARENA_ARRAY(layout->arena, 2 * (SAMPLES + 3), double);
    double *y = ARENA_ARRAY(layout->arena, 2 * (SAMPLES + 3), double);
    const struct surface *surfaces[] = {element->front, element->back};
    const double r = fmax(element->diameter[0], element->diameter[1]) / 2;
    for (size_t side = 0; side < 2; side++) {
        const double semi = element->diameter[side] / 2, up = side == 0 ? 1 : -1;
        sheet->vertex[side] = side == 0 ? 0 : element->thickness;
        for (int k = -1; k <= SAMPLES + 1; k++) {
            const double h = up * semi * fmin(fmax(2.0 * k / SAMPLES - 1, -1), 1);
            const bool flat = k < 0 || k > SAMPLES;
            z[sheet->count] = sheet->vertex[side] + surface_sag(surfaces[side], h);
            y[sheet->count++] = flat ? copysign(r, h) : h;
        }
        sheet->edge[side] = sheet->vertex[side] + surface_sag(surfaces[side], semi);
    }
    sheet->z = z;
    sheet->y = y;
    sheet->diameter = 2 * r;
}

/* Conic and coefficients, which the table has no place for, in as many lines as they take. */
static size_t element_asphere(const struct surface *surface, const char *name, struct arena *arena,
                              const char **lines)
{
    enum { FIRST = 4, MORE = 6 }; /* coefficients in a line */
    size_t count = 0, room = FIRST;
    if (surface->coefficients == 0 && !(fabs(surface->conic.value.hi) > 0)) {
        return 0;
    }
    lines[count++] =
        arena_printf(arena, "%s surface aspheric: k = %.7g", name, surface->conic.value.hi);
    for (int i = 0; i < LENS_COEFFICIENTS; i++) {
        if ((surface->coefficients >> i & 1) == 0) {
            continue;
        }
        if (room == 0) {
            lines[count++] = "";
            room = MORE;
        }
        const char *line = lines[count - 1];
        lines[count - 1] = arena_printf(arena, "%s%sA%d = %.7g", line, line[0] != '\0' ? ", " : "",
                                        surface_order(i), surface->coefficient[i].value.hi);
        room--;
    }
    return count;
}

/* How high from the axis the surfaces cross, flats out to the rim among them, mm; NaN: nowhere. */
static double element_crossing(const struct draw_element *element)
{
    enum { STEPS = 1000 };
    const double *diameter = element->diameter, rim = fmax(diameter[0], diameter[1]) / 2;
    const double rounding = 1e-9 * rim; /* surfaces may meet in a sharp edge */
    for (int k = 0; k <= STEPS; k++) {
        const double h = rim * k / STEPS;
        const double front = surface_sag(element->front, fmin(h, diameter[0] / 2));
        const double back = surface_sag(element->back, fmin(h, diameter[1] / 2));
        if (element->thickness + back - front < -rounding) {
            return h;
        }
    }
    return NAN;
}

bool draw_element_sheet(const struct layout *layout, long number, const char *title,
                        struct svg *svg, struct error *error)
{
    struct arena *arena = layout->arena;
    const struct lens *lens = layout->setup->lens;
    if (!(number >= 1 && (size_t)number <= layout->element_count)) {
        return fail(error, ERROR_USAGE, "{--element} %ld: the lens has elements 1 to %zu", number,
                    layout->element_count);
    }
    const size_t k = (size_t)number - 1, i = layout->elements[k].surface;
    const struct draw_element element = draw_element_of(layout, k);
    if (!surface_is_round(element.front) || !surface_is_round(element.back) ||
        layout->direction[i + 1] < 0) {
        return fail(error, ERROR_DOMAIN,
                    "{--iso10110} draws round elements that light passes from the left: not %ld",
                    number);
    }
    const double crossing = element_crossing(&element);
    if (!isnan(crossing)) {
        return fail(error, ERROR_DOMAIN,
                    "element %ld cannot be made: its surfaces %zu and %zu cross %.2g mm from the "
                    "axis, inside the rim",
                    number, i + 1, i + 2, crossing);
    }
    const char *notes[2 + 2 * LENS_COEFFICIENTS];
    struct element_sheet sheet = {
        .title = title,
        .part = arena_printf(arena, "element %ld of %zu, surfaces %zu and %zu", number,
                             layout->element_count, i + 1, i + 2),
        .thickness = arena_printf(arena, "%.6g%s", element.thickness,
                                  element_allowed(lens, TOLERANCE_THICKNESS, i, arena)),
        .across =
            arena_printf(arena, "\u00d8 %.5g", fmax(element.diameter[0], element.diameter[1])),
        .radius = {element_radius(layout, &element, i, 0), element_radius(layout, &element, i, 1)},
        .notes = notes,
    };
    element_outline(layout, &element, &sheet);
    element_surface_lines(layout, &element, i, 0, sheet.left);
    element_material_lines(layout, &element, k, sheet.material);
    element_surface_lines(layout, &element, i, 1, sheet.right);
    notes[sheet.note_count++] =
        "Dimensions in mm. \u2013: not stated in the lens file. \u00d8 as "
        "drawn: the larger clear diameter, without an allowance for mounting.";
    if (!element.front->has_diameter || !element.back->has_diameter) {
        notes[sheet.note_count++] = "Diameters in parentheses follow from rays.";
    }
    sheet.note_count += element_asphere(element.front, "left", arena, &notes[sheet.note_count]);
    sheet.note_count += element_asphere(element.back, "right", arena, &notes[sheet.note_count]);
    element_sheet_draw(&sheet, svg);
    return true;
}
