/* analysis/layout/layout_lens.c - outlines of elements, mirrors and stop of a lens. */
/* SPDX-License-Identifier: MIT */
#include "analysis/layout/layout.h"

#include "base/constants.h"
#include "optics/aperture.h"

enum { SAMPLES = 48, HATCHES = 28 };
static const double THINNEST = 0.12; /* edge of an element, against its middle */
static const double STEEPEST = 2;    /* slope of an edge */

struct layout_part *layout_add(struct layout *layout, enum layout_kind kind, size_t count,
                               double **z, double **y)
{
    layout->parts = arena_grow(layout->arena, layout->parts, layout->part_count, &layout->part_room,
                               sizeof layout->parts[0]);
    struct layout_part *part = &layout->parts[layout->part_count++];
    *z = ARENA_ARRAY(layout->arena, count, double);
    *y = ARENA_ARRAY(layout->arena, count, double);
    *part = (struct layout_part){.kind = kind, .z = *z, .y = *y, .count = count};
    return part;
}

void layout_line(struct layout *layout, enum layout_kind kind, struct layout_ends ends,
                 const char *label)
{
    double *z, *y;
    struct layout_part *part = layout_add(layout, kind, 2, &z, &y);
    z[0] = ends.z1;
    y[0] = ends.y1;
    z[1] = ends.z2;
    y[1] = ends.y2;
    part->label = label;
}

void layout_note(struct layout *layout, const char *note)
{
    const char **notes = ARENA_ARRAY(layout->arena, layout->note_count + 1, const char *);
    for (size_t i = 0; i < layout->note_count; i++) {
        notes[i] = layout->notes[i];
    }
    notes[layout->note_count++] = note;
    layout->notes = notes;
}

/* Sag in the section drawn. */
static double sag(const struct layout *layout, size_t surface, double r)
{
    const struct surface *one = &layout->setup->lens->surfaces[surface];
    double weight = surface_section(one)->weight[layout->setup->section == SECTION_Y ? 1 : 0];
    return weight * surface_sag(one, r);
}

static bool is_glass(const struct layout *layout, size_t surface)
{
    return surface < layout->setup->lens->surface_count &&
           !medium_is_air(&layout->setup->lens->surfaces[surface].medium);
}

/* Glass between this surface and the next: is there a piece to draw? */
static bool has_element(const struct layout *layout, size_t surface)
{
    return surface + 1 < layout->setup->lens->surface_count && is_glass(layout, surface);
}

/* The surface's own edge in z; what lies beyond its clear diameter is a flat. */
static double lens_edge(const struct layout *layout, size_t surface)
{
    return layout->vertex[surface] + sag(layout, surface, layout->semi[surface]);
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

/* Thickness of the glass after a surface, both surfaces continued to r. */
static double thickness(const struct layout *layout, size_t i, double r)
{
    return (layout->vertex[i + 1] + sag(layout, i + 1, r) - layout->vertex[i] - sag(layout, i, r)) *
           layout->direction[i + 1];
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

/* Is there room between two neighbouring surfaces, each with a flat beyond its diameter, to r? */
static bool is_apart(const struct layout *layout, size_t i, double r)
{
    const struct surface *surface = &layout->setup->lens->surfaces[i];
    bool both = i + 1 < layout->setup->lens->surface_count && layout->is_drawn[i] &&
                layout->is_drawn[i + 1] && !surface_has(surface, SURFACE_HAS_FOCAL) &&
                !surface_has(surface + 1, SURFACE_HAS_FOCAL);
    for (int k = 1; both && k <= SAMPLES; k++) {
        double h = r * k / SAMPLES;
        double left = sag(layout, i, fmin(h, layout->semi[i]));
        double right = sag(layout, i + 1, fmin(h, layout->semi[i + 1]));
        double gap = layout->vertex[i + 1] + right - layout->vertex[i] - left;
        double least = is_glass(layout, i) ? THINNEST * fabs(thickness(layout, i, 0)) : 0;
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
    double rise = sag(layout, i, r) - sag(layout, i, 0.98 * r);
    return fabs(rise) < STEEPEST * 0.02 * r && is_apart(layout, i, r) &&
           (i == 0 || is_apart(layout, i - 1, r));
}

static bool find_diameters(struct layout *layout, struct error *error)
{
    const struct lens *lens = layout->setup->lens;
    size_t guessed = 0;
    for (size_t i = 0; i < lens->surface_count; i++) {
        const struct surface *surface = &lens->surfaces[i];
        double y = layout->marginal[i].y, bar = layout->chief[i].y;
        double stated = aperture_reach(surface);
        if (surface->has_diameter) {
            layout->semi[i] = surface->diameter.value.hi / 2;
        } else if (isfinite(stated)) {
            layout->semi[i] = stated;
        } else {
            layout->semi[i] = fabs(y) + (isfinite(bar) ? fabs(bar) : 0);
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
    for (size_t i = 0; i < lens->surface_count; i++) {
        if (layout->is_drawn[i]) {
            /* less, until there is a sag and, where nobody stated the diameter, room for it */
            const bool is_guess = !isfinite(aperture_reach(&lens->surfaces[i]));
            for (int step = 0; step < 400 && !(isfinite(sag(layout, i, layout->semi[i])) &&
                                               (!is_guess || is_sensible(layout, i)));
                 step++) {
                layout->semi[i] *= 0.99;
            }
            layout->size = fmax(layout->size, layout->semi[i]);
        }
    }
    if (guessed > 0) {
        layout_note(layout,
                    arena_printf(layout->arena,
                                 "%zu of %zu surfaces have no stated diameter: theirs follow from "
                                 "the heights of the paraxial marginal and chief rays",
                                 guessed, lens->surface_count));
    }
    return true;
}

static void layout_lens_reach(struct layout *layout, double z)
{
    layout->left = fmin(layout->left, z);
    layout->right = fmax(layout->right, z);
}

/* Up the first surface, along the rim, down the second; flats reach out to the larger one. */
static void add_element(struct layout *layout, size_t i)
{
    double *z, *y;
    size_t count = 0;
    struct layout_part *part = layout_add(layout, LAYOUT_ELEMENT, 2 * (SAMPLES + 1) + 4, &z, &y);
    double r = fmax(layout->semi[i], layout->semi[i + 1]);
    bool stepped = (lens_edge(layout, i + 1) - lens_edge(layout, i)) * layout->direction[i + 1] > 0;
    for (size_t side = 0; side < 2; side++) {
        size_t surface = i + side;
        double semi = layout->semi[surface], up = side == 0 ? 1 : -1;
        bool flat = stepped && semi < r;
        if (flat) {
            z[count] = lens_edge(layout, surface);
            y[count] = -up * r;
            layout_lens_put(layout, surface, &z[count], &y[count]);
            count++;
        }
        for (int k = 0; k <= SAMPLES; k++) {
            double h = up * semi * sin(PI / 2 * (2.0 * k / SAMPLES - 1)); /* denser at the rims */
            z[count] = layout->vertex[surface] + sag(layout, surface, h);
            y[count] = h;
            layout_lens_put(layout, surface, &z[count], &y[count]);
            layout_lens_reach(layout, z[count++]);
        }
        if (flat) {
            z[count] = lens_edge(layout, surface);
            y[count] = up * r;
            layout_lens_put(layout, surface, &z[count], &y[count]);
            count++;
        }
    }
    part->count = count;
    const char *name = layout_glass_name(layout, &layout->setup->lens->surfaces[i].medium);
    const struct text kept = text_of(name);
    part->glass = name_table_find(&layout->glass_names, kept);
    if (part->glass == NAME_NONE) {
        layout->glasses[layout->glass_count++] = name;
        part->glass = name_table_add(&layout->glass_names, kept, layout->arena);
    }
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
            z[j] = layout->vertex[i] + sag(layout, i, y[j]);
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
        z[k] = layout->vertex[i] + sag(layout, i, y[k]);
        layout_lens_put(layout, i, &z[k], &y[k]);
        layout_lens_reach(layout, z[k]);
    }
    int strokes = (int)fmax(3, HATCHES * fabs(to - from) / layout->size);
    layout_add(layout, LAYOUT_HATCH, 3 * (size_t)strokes, &hatch_z, &hatch_y);
    for (int k = 0; k < strokes; k++) {
        double h = from + (to - from) * (k + 0.5) / strokes;
        double at = layout->vertex[i] + sag(layout, i, h);
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
    double at = layout->vertex[stop] + sag(layout, stop, r);
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

bool layout_lens(struct layout *layout, struct error *error)
{
    const struct lens *lens = layout->setup->lens;
    const size_t count = lens->surface_count;
    layout->left = INFINITY;
    layout->right = -INFINITY;
    layout->glasses = ARENA_ARRAY(layout->arena, count, const char *);
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
        layout->is_drawn[i] = surface_traits(surface)->is_drawn || is_glass(layout, i) ||
                              (i > 0 && is_glass(layout, i - 1));
    }
    layout->light_direction = direction;
    find_frames(layout);
    if (!find_diameters(layout, error)) {
        return false;
    }
    /* A cemented surface reaches to the smaller of the two outer rims, where it can. */
    for (size_t i = 1; i + 1 < layout->setup->lens->surface_count; i++) {
        if (!has_element(layout, i) || !has_element(layout, i - 1)) {
            continue;
        }
        double r = fmin(layout->semi[i - 1], layout->semi[i + 1]);
        if (r > layout->semi[i] && thickness(layout, i, r) > 0 && thickness(layout, i - 1, r) > 0) {
            layout->semi[i] = r;
        }
    }
    for (size_t i = 0; i < count; i++) {
        if (has_element(layout, i)) {
            add_element(layout, i);
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
