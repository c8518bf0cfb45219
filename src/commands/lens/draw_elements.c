/* commands/lens/draw_elements.c - the elements of a lens in numbers, beside its cross-section. */
/* SPDX-License-Identifier: MIT */
#include "commands/lens/draw_elements.h"

#include "base/arena.h"
#include "optics/lensmaker.h"
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
