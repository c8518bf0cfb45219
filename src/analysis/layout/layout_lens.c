/* analysis/layout/layout_lens.c - outlines of elements, mirrors and stop of a lens. */
/* SPDX-License-Identifier: MIT */
#include "analysis/layout/layout.h"

#include "base/constants.h"
#include "optics/aperture.h"

enum { SAMPLES = 48, HATCHES = 28 };

/* The surface's own edge in z; what lies beyond its clear diameter is a flat. */
static double lens_edge(const struct layout *layout, size_t surface)
{
    return layout->vertex[surface] + layout_sag(layout, surface, layout->semi[surface]);
}

/* As a legend has it: of a model glass that was optimised no digits that nobody reads. */
static const char *layout_glass_name(const struct layout *layout, const struct medium *medium)
{
    enum { LONGEST = 13 }; /* "1.51680/64.17" */
    const struct text written = medium->written;
    return medium->kind == MEDIUM_MODEL && written.length > LONGEST
               ? arena_printf(layout->arena, "%.5f/%.2f", medium->index.hi, medium->abbe.hi)
               : arena_string(layout->arena, written.start, written.length);
}

/* Shift, then turn, as far as both lie in the plane of the drawing; returns what does not. */
static bool layout_lens_displace(const struct layout *layout, const struct displacement *by,
                                 struct layout_frame *frame)
{
    if (by == NULL) {
        return false;
    }
    /* a right-handed turn about x takes z towards -y, one about y takes it towards x */
    bool y_section = layout->setup->section == SECTION_Y;
    double shift = by->decenter[y_section ? 1 : 0].value.hi;
    double turn = y_section ? -by->tilt[0].value.hi : by->tilt[1].value.hi;
    frame->z -= shift * sin(frame->angle);
    frame->y += shift * cos(frame->angle);
    frame->angle += turn;
    return by->decenter[y_section ? 0 : 1].value.hi != 0 ||
           by->tilt[y_section ? 1 : 0].value.hi != 0 || by->tilt[2].value.hi != 0;
}

static void find_frames(struct layout *layout)
{
    const struct lens *lens = layout->setup->lens;
    struct layout_frame axis = {0, 0, 0};
    bool is_skew = false;
    layout->is_centred = true;
    for (size_t i = 0; i < lens->surface_count; i++) {
        const struct surface *surface = &lens->surfaces[i];
        is_skew = layout_lens_displace(layout, surface->coordinate_break, &axis) || is_skew;
        layout->axis[i] = layout->frames[i] = axis;
        is_skew = layout_lens_displace(layout, surface->decentre, &layout->frames[i]) || is_skew;
        layout->is_centred =
            layout->is_centred && surface->coordinate_break == NULL && surface->decentre == NULL;
        double t = surface->has_thickness ? surface->thickness.value.hi : 0;
        axis.z += t * cos(axis.angle);
        axis.y += t * sin(axis.angle);
    }
    if (is_skew) {
        layout_note(layout, "shifts and turns out of the plane of the drawing are left out");
    }
}

/* From the straight axis to the drawing: a point that belongs to a surface. */
static void layout_lens_put(const struct layout *layout, size_t surface, double *z, double *y)
{
    if (layout->is_centred) {
        return;
    }
    const struct layout_frame *frame = &layout->frames[surface];
    double along = *z - layout->vertex[surface], across = *y;
    *z = frame->z + along * cos(frame->angle) - across * sin(frame->angle);
    *y = frame->y + along * sin(frame->angle) + across * cos(frame->angle);
}

static void layout_lens_reach(struct layout *layout, double z)
{
    layout->left = fmin(layout->left, z);
    layout->right = fmax(layout->right, z);
}

/* -------- what apertures leave -------- */

/* Between two heights of a surface, in the plane of the drawing. */
struct lens_stretch {
    double low, high;
};
enum { STRETCHES = 16, STRETCH_STEPS = 600 };

static bool passes_at(const struct layout *layout, const struct aperture_form *forms, size_t count,
                      double h)
{
    bool y = layout->setup->section == SECTION_Y;
    for (size_t i = 0; i < count; i++) {
        if (!aperture_passes(&forms[i], y ? 0 : h, y ? h : 0)) {
            return false;
        }
    }
    return true;
}

/* The stretches from one height up to another where the apertures pass, or where they do not. */
static size_t find_stretches(const struct layout *layout, size_t surface, bool passing,
                             struct lens_stretch whole, struct lens_stretch *stretches)
{
    const struct surface *one = &layout->setup->lens->surfaces[surface];
    const size_t count = one->aperture_count;
    struct aperture_form *forms = ARENA_ARRAY(layout->arena, count, struct aperture_form);
    double step = (whole.high - whole.low) / STRETCH_STEPS, before = whole.low;
    size_t found = 0;
    for (size_t i = 0; i < count; i++) {
        forms[i] = aperture_form_of(&one->apertures[i], layout->arena);
    }
    bool is = passes_at(layout, forms, count, before) == passing;
    stretches[0].low = before;
    for (int k = 1; k <= STRETCH_STEPS && found < STRETCHES; k++) {
        double here = k == STRETCH_STEPS ? whole.high : whole.low + k * step, low = before;
        bool will = passes_at(layout, forms, count, here) == passing;
        for (double high = here; will != is && high - low > 1e-9 * step;) {
            double middle = (low + high) / 2;
            bool still = (passes_at(layout, forms, count, middle) == passing) == is;
            if (still) {
                low = middle;
            } else {
                high = middle;
            }
        }
        if (is && !will) {
            stretches[found++].high = low;
        } else if (will && !is) {
            stretches[found].low = low;
        }
        is = will;
        before = here;
    }
    if (is && found < STRETCHES) {
        stretches[found++].high = whole.high;
    }
    return found;
}

/* Where apertures of a surface that is no mirror block light. */
static void add_blocks(struct layout *layout, size_t i)
{
    const struct surface *surface = &layout->setup->lens->surfaces[i];
    struct lens_stretch stretches[STRETCHES];
    double semi = layout->is_drawn[i] || surface->has_diameter ? layout->semi[i] : layout->size;
    if (surface->aperture_count == 0 || surface_reflects(surface)) {
        return;
    }
    size_t count = find_stretches(layout, i, false, (struct lens_stretch){-semi, semi}, stretches);
    for (size_t k = 0; k < count; k++) {
        double *z, *y, low = stretches[k].low, high = stretches[k].high;
        layout_add(layout, LAYOUT_BLOCK, SAMPLES + 1, &z, &y);
        for (int j = 0; j <= SAMPLES; j++) {
            y[j] = low + (high - low) * j / SAMPLES;
            z[j] = layout->vertex[i] + layout_sag(layout, i, y[j]);
            layout_lens_put(layout, i, &z[j], &y[j]);
            layout_lens_reach(layout, z[j]);
        }
    }
}

/* The beam that comes back through a mirror's middle needs a hole there. */
static double mirror_hole(const struct layout *layout, size_t mirror)
{
    const size_t count = layout->setup->lens->surface_count;
    double z = layout->vertex[mirror], hole = 0;
    for (size_t i = mirror + 1; i < count; i++) {
        double start = layout->vertex[i];
        double end = i + 1 < count ? layout->vertex[i + 1]
                                   : layout_rear(layout) + layout->light->first.image;
        double n = layout->light->system.index[i + 1].hi;
        if (!((z - start) * (z - end) < -1e-9)) {
            continue;
        }
        const struct paraxial_ray *y = &layout->marginal[i], *bar = &layout->chief[i];
        double height = fabs(y->y + (z - start) * y->after / n);
        double more = fabs(bar->y + (z - start) * bar->after / n);
        hole = fmax(hole, 1.3 * (height + (isfinite(more) ? more : 0)));
    }
    return layout->is_centred && hole < 0.7 * layout->semi[mirror] ? hole : 0;
}

/* One piece of a mirror, with strokes behind it. */
static void add_mirror_piece(struct layout *layout, size_t i, double from, double to)
{
    double depth = 0.035 * layout->size, *z, *y, *hatch_z, *hatch_y;
    layout_add(layout, LAYOUT_MIRROR, SAMPLES + 1, &z, &y);
    for (int k = 0; k <= SAMPLES; k++) {
        y[k] = from + (to - from) * k / SAMPLES;
        z[k] = layout->vertex[i] + layout_sag(layout, i, y[k]);
        layout_lens_put(layout, i, &z[k], &y[k]);
        layout_lens_reach(layout, z[k]);
    }
    int strokes = (int)fmax(3, HATCHES * fabs(to - from) / layout->size);
    layout_add(layout, LAYOUT_HATCH, 3 * (size_t)strokes, &hatch_z, &hatch_y);
    for (int k = 0; k < strokes; k++) {
        double h = from + (to - from) * (k + 0.5) / strokes;
        double at = layout->vertex[i] + layout_sag(layout, i, h);
        hatch_z[3 * k] = at;
        hatch_y[3 * k] = h;
        hatch_z[3 * k + 1] = at + depth * layout->direction[i];
        hatch_y[3 * k + 1] = h - 0.8 * depth;
        layout_lens_put(layout, i, &hatch_z[3 * k], &hatch_y[3 * k]);
        layout_lens_put(layout, i, &hatch_z[3 * k + 1], &hatch_y[3 * k + 1]);
        hatch_z[3 * k + 2] = hatch_y[3 * k + 2] = NAN;
    }
}

static void add_mirror(struct layout *layout, size_t i)
{
    double semi = layout->semi[i], hole = mirror_hole(layout, i);
    struct lens_stretch stretches[STRETCHES];
    if (layout->setup->lens->surfaces[i].aperture_count == 0) {
        add_mirror_piece(layout, i, -hole, -semi);
        add_mirror_piece(layout, i, hole, semi);
        return;
    }
    size_t count = find_stretches(layout, i, true, (struct lens_stretch){-semi, semi}, stretches);
    for (size_t k = 0; k < count; k++) {
        add_mirror_piece(layout, i, stretches[k].low, stretches[k].high);
    }
}

/* Radius of the hole in a mirror: what its apertures or the light that comes back leave. */
static double mirror_gap(const struct layout *layout, size_t i)
{
    const double semi = layout->semi[i];
    struct lens_stretch stretches[STRETCHES];
    if (layout->setup->lens->surfaces[i].aperture_count == 0) {
        return mirror_hole(layout, i);
    }
    size_t count = find_stretches(layout, i, true, (struct lens_stretch){-semi, semi}, stretches);
    return count == 2 && stretches[1].low > 0 ? stretches[1].low : 0;
}

/* Radius of the hole in the glass before a pierced mirror, where something else stands in it. */
static double element_hole(const struct layout *layout, size_t i)
{
    const struct lens *lens = layout->setup->lens;
    const double a = layout->vertex[i], b = layout->vertex[i + 1], near = 1e-9 * layout->size;
    double hole = 0;
    for (size_t side = 0; side < 2; side++) {
        if (layout->is_centred && surface_reflects(&lens->surfaces[i + side])) {
            hole = fmax(hole, mirror_gap(layout, i + side));
        }
    }
    for (size_t k = 0; hole > 0 && k < lens->surface_count; k++) {
        if (layout->is_drawn[k] && layout->semi[k] <= hole &&
            layout->vertex[k] > fmin(a, b) + near && layout->vertex[k] < fmax(a, b) - near) {
            return hole < fmin(layout->semi[i], layout->semi[i + 1]) ? hole : 0;
        }
    }
    return 0;
}

/* -------- elements -------- */

/*
 * Up the first surface from one height to another, along the rim, down the second; flats reach out
 * to the larger one.
 */
static struct layout_part *add_outline(struct layout *layout, size_t i, double from, double to)
{
    double *z, *y;
    size_t count = 0;
    struct layout_part *part = layout_add(layout, LAYOUT_ELEMENT, 2 * (SAMPLES + 1) + 4, &z, &y);
    bool stepped = (lens_edge(layout, i + 1) - lens_edge(layout, i)) * layout->direction[i + 1] > 0;
    for (size_t side = 0; side < 2; side++) {
        size_t surface = i + side;
        double semi = layout->semi[surface], up = side == 0 ? 1 : -1;
        double low = fmax(from, -semi), high = fmin(to, semi);
        for (int k = -1; k <= SAMPLES + 1; k++) {
            double turn = fmin(fmax((double)k / SAMPLES, 0), 1);
            /* denser at the rims */
            double h = (low + high) / 2 + up * (high - low) / 2 * sin(PI / 2 * (2 * turn - 1));
            bool flat = k < 0 || k > SAMPLES;
            double end = h > 0 ? to : from;
            if (flat && !(stepped && fabs(h) >= semi * (1 - 1e-12) && fabs(end) > semi)) {
                continue;
            }
            z[count] = layout->vertex[surface] + layout_sag(layout, surface, h);
            y[count] = flat ? end : h;
            layout_lens_put(layout, surface, &z[count], &y[count]);
            layout_lens_reach(layout, z[count++]);
        }
    }
    part->count = count;
    return part;
}

/* Which of the layout's glasses it is, a new one if it was not there before. */
static size_t layout_glass(struct layout *layout, size_t i)
{
    const char *name = layout_glass_name(layout, &layout->setup->lens->surfaces[i].medium);
    const struct text kept = text_of(name);
    size_t glass = name_table_find(&layout->glass_names, kept);
    if (glass == NAME_NONE) {
        layout->glasses[layout->glass_count++] = name;
        glass = name_table_add(&layout->glass_names, kept, layout->arena);
    }
    return glass;
}

/* Has light been through this glass before, on its way to a mirror and back? */
static bool is_element_again(const struct layout *layout, size_t i)
{
    for (size_t k = 0; k < layout->element_count; k++) {
        const size_t before = layout->elements[k].surface;
        const double near = 1e-9 * layout->size;
        if (fabs(layout->vertex[before] - layout->vertex[i + 1]) <= near &&
            fabs(layout->vertex[before + 1] - layout->vertex[i]) <= near) {
            return true;
        }
    }
    return false;
}

static void add_element(struct layout *layout, size_t i, double hole)
{
    const size_t glass = layout_glass(layout, i);
    const double r = fmax(layout->semi[i], layout->semi[i + 1]);
    if (hole > 0) {
        add_outline(layout, i, -r, -hole)->glass = glass;
        add_outline(layout, i, hole, r)->glass = glass;
    } else {
        add_outline(layout, i, -r, r)->glass = glass;
    }
    if (!is_element_again(layout, i)) {
        double z = (lens_edge(layout, i) + lens_edge(layout, i + 1)) / 2, y = -r;
        layout_lens_put(layout, i, &z, &y);
        layout->elements[layout->element_count++] =
            (struct layout_element){.surface = i, .glass = glass, .z = z, .low = y};
    }
}

static void add_stroke(struct layout *layout, size_t stop, double z1, double y1, double z2,
                       double y2)
{
    layout_lens_put(layout, stop, &z1, &y1);
    layout_lens_put(layout, stop, &z2, &y2);
    layout_line(layout, LAYOUT_STOP, (struct layout_ends){z1, y1, z2, y2}, NULL);
}

static void layout_lens_add_stop(struct layout *layout)
{
    size_t stop = layout->setup->lens->stop;
    if (stop == LENS_NONE) {
        return;
    }
    const double real = layout->setup->real_stop;
    double r = isnan(real) ? layout->light->first.stop_radius : real, tick = 0.16 * layout->size;
    r = r > 0 ? r : layout->semi[stop];
    double at = layout->vertex[stop] + layout_sag(layout, stop, r);
    if (!(r > 0 && r < INFINITY && isfinite(at))) {
        return;
    }
    for (int side = -1; side <= 1; side += 2) {
        add_stroke(layout, stop, at, side * r, at, side * (r + tick));
        add_stroke(layout, stop, at - 0.3 * tick, side * r, at + 0.3 * tick, side * r);
    }
    double y = 0;
    layout_lens_put(layout, stop, &at, &y);
    layout_lens_reach(layout, at);
}

bool layout_lens(struct layout *layout, const struct layout_request *request, struct error *error)
{
    const struct lens *lens = layout->setup->lens;
    const size_t count = lens->surface_count;
    layout->left = INFINITY;
    layout->right = -INFINITY;
    layout->glasses = ARENA_ARRAY(layout->arena, count, const char *);
    layout->elements = ARENA_ARRAY(layout->arena, count, struct layout_element);
    layout->vertex = ARENA_ARRAY(layout->arena, count, double);
    layout->semi = ARENA_ARRAY(layout->arena, count, double);
    layout->frames = ARENA_ARRAY(layout->arena, count, struct layout_frame);
    layout->axis = ARENA_ARRAY(layout->arena, count, struct layout_frame);
    layout->direction = ARENA_ARRAY(layout->arena, count, double);
    layout->is_drawn = ARENA_ARRAY(layout->arena, count, bool);
    double z = 0, direction = 1;
    for (size_t i = 0; i < lens->surface_count; i++) {
        const struct surface *surface = &lens->surfaces[i];
        layout->vertex[i] = z;
        layout->direction[i] = direction;
        z += surface_advance(surface).hi;
        direction = surface_reflects(surface) ? -direction : direction;
    }
    layout->light_direction = direction;
    find_frames(layout);
    if (!layout_find_diameters(layout, request, error)) {
        return false;
    }
    /* A cemented surface reaches to the smaller of the two outer rims, where it can. */
    for (size_t i = 1; i + 1 < layout->setup->lens->surface_count; i++) {
        if (!layout_has_element(layout, i) || !layout_has_element(layout, i - 1)) {
            continue;
        }
        double r = fmin(layout->semi[i - 1], layout->semi[i + 1]);
        if (r > layout->semi[i] && layout_thickness(layout, i, r) > 0 &&
            layout_thickness(layout, i - 1, r) > 0) {
            layout->semi[i] = r;
        }
    }
    for (size_t i = 0; i < count; i++) {
        if (layout_has_element(layout, i)) {
            add_element(layout, i, element_hole(layout, i));
        }
        if (surface_reflects(&lens->surfaces[i])) {
            add_mirror(layout, i);
        }
        if (surface_has(&lens->surfaces[i], SURFACE_HAS_FOCAL)) {
            /* Its two principal planes. */
            double at = layout->vertex[i], semi = layout->semi[i],
                   behind = at + layout_hiatus(layout, i);
            layout_line(layout, LAYOUT_PLANE, (struct layout_ends){at, -semi, at, semi},
                        surface_is_thin(&lens->surfaces[i]) ? "thin lens" : "thick lens");
            layout_line(layout, LAYOUT_PLANE, (struct layout_ends){behind, -semi, behind, semi},
                        NULL);
            layout_lens_reach(layout, at);
            layout_lens_reach(layout, behind);
        }
        add_blocks(layout, i);
    }
    if (!(layout->left <= layout->right)) {
        return fail(error, ERROR_DOMAIN, "nothing to draw: the lens has no glass and no mirror");
    }
    layout_lens_add_stop(layout);
    return true;
}
