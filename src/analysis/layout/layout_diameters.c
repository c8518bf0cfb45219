/* analysis/layout/layout_diameters.c - how wide the surfaces of a section are. */
/* SPDX-License-Identifier: MIT */
#include "analysis/layout/layout.h"

#include "optics/aperture.h"

enum { SAMPLES = 48 };
static const double THINNEST = 0.12; /* edge of an element, against its middle */
static const double STEEPEST = 2;    /* slope of an edge */
static const double ASTRAY = 4;      /* height of exact rays, against paraxial ones */

double layout_sag(const struct layout *layout, size_t surface, double r)
{
    const struct surface *one = &layout->setup->lens->surfaces[surface];
    double weight = surface_section(one)->weight[layout->setup->section == SECTION_Y ? 1 : 0];
    return weight * surface_sag(one, r);
}

static bool layout_is_glass(const struct layout *layout, size_t surface)
{
    return surface < layout->setup->lens->surface_count &&
           !medium_is_air(&layout->setup->lens->surfaces[surface].medium);
}

bool layout_has_element(const struct layout *layout, size_t surface)
{
    return surface + 1 < layout->setup->lens->surface_count && layout_is_glass(layout, surface);
}

double layout_thickness(const struct layout *layout, size_t i, double r)
{
    return (layout->vertex[i + 1] + layout_sag(layout, i + 1, r) - layout->vertex[i] -
            layout_sag(layout, i, r)) *
           layout->direction[i + 1];
}

/* Is there room between two neighbouring surfaces, each with a flat beyond its diameter, to r? */
static bool is_apart(const struct layout *layout, size_t i, double r)
{
    const struct surface *surface = &layout->setup->lens->surfaces[i];
    bool both = i + 1 < layout->setup->lens->surface_count && layout->is_drawn[i] &&
                layout->is_drawn[i + 1] && !surface_has(surface, SURFACE_HAS_FOCAL) &&
                !surface_has(surface + 1, SURFACE_HAS_FOCAL);
    for (int k = 1; both && k <= SAMPLES; k++) {
        double h = r * k / SAMPLES;
        double left = layout_sag(layout, i, fmin(h, layout->semi[i]));
        double right = layout_sag(layout, i + 1, fmin(h, layout->semi[i + 1]));
        double gap = layout->vertex[i + 1] + right - layout->vertex[i] - left;
        double least =
            layout_is_glass(layout, i) ? THINNEST * fabs(layout_thickness(layout, i, 0)) : 0;
        if (gap * layout->direction[i + 1] < least) {
            return false;
        }
    }
    return true;
}

/* Does a diameter that nobody stated make sense: no crossing, no slope beyond that of a lens? */
static bool is_sensible(const struct layout *layout, size_t i)
{
    double r = layout->semi[i];
    double rise = layout_sag(layout, i, r) - layout_sag(layout, i, 0.98 * r);
    return fabs(rise) < STEEPEST * 0.02 * r && is_apart(layout, i, r) &&
           (i == 0 || is_apart(layout, i - 1, r));
}

/* Is there something of a surface to draw? */
static bool layout_draws(const struct lens *lens, size_t i)
{
    return surface_traits(&lens->surfaces[i])->is_drawn ||
           !medium_is_air(&lens->surfaces[i].medium) ||
           (i > 0 && !medium_is_air(&lens->surfaces[i - 1].medium));
}

bool layout_states_diameters(const struct lens *lens)
{
    for (size_t i = 0; i < lens->surface_count; i++) {
        if (layout_draws(lens, i) && !isfinite(aperture_reach(&lens->surfaces[i]))) {
            return false;
        }
    }
    return true;
}

/*
 * Less, until there is a sag and, where nobody stated the diameter, room for it; what holds off
 * rays there does so on the other surfaces of the same piece, too. `heights` is room to work in.
 */
static void layout_shrink(struct layout *layout, double *heights)
{
    const struct lens *lens = layout->setup->lens;
    const size_t count = lens->surface_count;
    for (size_t first = 0, end; first < count; first = end) {
        double least = 1;
        for (end = first; end == first || (end < count && layout_is_glass(layout, end - 1));
             end++) {
            const bool is_guess = !isfinite(aperture_reach(&lens->surfaces[end]));
            const double asked = layout->semi[end];
            for (int step = 0; step < 400 && layout->is_drawn[end] &&
                               !(isfinite(layout_sag(layout, end, layout->semi[end])) &&
                                 (!is_guess || is_sensible(layout, end)));
                 step++) {
                layout->semi[end] *= 0.99;
            }
            least = is_guess ? fmin(least, layout->semi[end] / asked) : least;
            heights[end] = asked;
        }
        for (size_t i = first; i < end; i++) {
            const bool is_guess = !isfinite(aperture_reach(&lens->surfaces[i]));
            layout->semi[i] =
                is_guess ? fmin(layout->semi[i], least * heights[i]) : layout->semi[i];
            layout->size = layout->is_drawn[i] ? fmax(layout->size, layout->semi[i]) : layout->size;
        }
    }
}

bool layout_find_diameters(struct layout *layout, const struct layout_request *request,
                           struct error *error)
{
    const struct lens *lens = layout->setup->lens;
    double *heights = ARENA_ARRAY(layout->arena, lens->surface_count, double);
    size_t guessed = 0, by_paraxial = 0;
    for (size_t i = 0; i < lens->surface_count; i++) {
        heights[i] = request->heights != NULL ? request->heights[i] : 0;
        layout->is_drawn[i] = layout_draws(lens, i);
    }
    const bool has_rays = !layout_states_diameters(lens) &&
                          layout_ray_heights(layout->setup, request, layout->arena, heights);
    for (size_t i = 0; i < lens->surface_count; i++) {
        const struct surface *surface = &lens->surfaces[i];
        double y = layout->marginal[i].y, bar = layout->chief[i].y;
        double stated = aperture_reach(surface),
               paraxial = fabs(y) + (isfinite(bar) ? fabs(bar) : 0);
        if (surface->has_diameter) {
            layout->semi[i] = surface->diameter.value.hi / 2;
        } else if (isfinite(stated)) {
            layout->semi[i] = stated;
        } else if (has_rays && heights[i] > 0) {
            /* those that go astray do not count */
            layout->semi[i] = paraxial > 0 ? fmin(heights[i], ASTRAY * paraxial) : heights[i];
        } else {
            layout->semi[i] = paraxial;
            by_paraxial += layout->is_drawn[i];
        }
        if (!layout->is_drawn[i]) {
            continue;
        }
        if (!(layout->semi[i] > 0 && layout->semi[i] < INFINITY)) {
            fail(error, ERROR_DOMAIN, "surface %zu has no diameter, and no ray gives it one",
                 i + 1);
            return error_hint(error, "state diameters or an aperture in the file, or give -N");
        }
        guessed += isfinite(stated) ? 0 : 1;
    }
    layout_shrink(layout, heights);
    if (guessed > 0) {
        layout_note(layout,
                    arena_printf(layout->arena,
                                 "%zu of %zu surfaces have no stated diameter: theirs follow from "
                                 "the heights of %s",
                                 guessed, lens->surface_count,
                                 by_paraxial > 0 ? "the paraxial marginal and chief rays"
                                                 : "the rays of all fields"));
    }
    return true;
}
