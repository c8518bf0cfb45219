/* analysis/layout/layout_rays.c - exact rays through the drawn lens, clipped. */
/* SPDX-License-Identifier: MIT */
#include "analysis/layout/layout.h"
#include "optics/aperture.h"
#include "trace/aim/aim.h"
#include "trace/follow.h"
#include "trace/pupil/clear_cross.h"

#include "base/constants.h"

#include <string.h>

enum { LEAST_FIELDS = 60, MOST_FIELDS = 6 };

/* What the rays need: the lens with a clear aperture at every surface that is drawn. */
struct rays_beams {
    struct layout *layout;
    const struct system *open; /* without clear apertures */
    struct system clipped;     /* and with those of the drawing */
    bool has_stop;             /* of a size */
};

/* -------- fields -------- */

static double rays_field_value(const struct setup *setup, const struct field_point *field)
{
    return field->value[setup_axis(setup)];
}

/*
 * The fields off the axis, as the section sees them, each once and the farthest last.
 *
 * Given     list  has room for those of the setup
 *           lost  says why the edge is not among them, if it is not
 */
static size_t rays_fields(const struct setup *setup, struct field_point *list, struct error *lost)
{
    size_t count = 0;
    for (size_t i = 0; i <= setup->field_count; i++) {
        struct field_point field =
            i < setup->field_count ? setup->fields[i].point : setup->edge; /* its reason counts */
        if (field.kind == FIELD_NONE || !setup_real_in_object(setup, &field, lost)) {
            continue;
        }
        double value = rays_field_value(setup, &field);
        bool is_new = isfinite(value) && fabs(value) > 0;
        for (size_t k = 0; k < count; k++) {
            double other = rays_field_value(setup, &list[k]);
            is_new = is_new && !(fabs(value - other) <= 1e-9 * fabs(value));
        }
        size_t k = count;
        for (; is_new && k > 0 && fabs(value) < fabs(rays_field_value(setup, &list[k - 1])); k--) {
            list[k] = list[k - 1];
        }
        if (is_new) {
            list[k] = field;
            count++;
        }
    }
    return count;
}

/* "14°", "12 mm". */
static const char *rays_field_text(const struct layout *layout, const struct field_point *field,
                                   double share)
{
    bool angle = field->kind == FIELD_ANGLE;
    double value = share * rays_field_value(layout->setup, field);
    return arena_printf(layout->arena, "%.3g%s", value * (angle ? DEGREES_PER_RADIAN : 1),
                        angle ? "°" : " mm");
}

/* -------- rays -------- */

/* From the frame of a surface's axis to the drawing. */
static void layout_place(const struct layout *layout, size_t surface, double along, double across,
                         double *z, double *y)
{
    const struct layout_frame *axis = &layout->axis[surface];
    *z = axis->z + along * cos(axis->angle) - across * sin(axis->angle);
    *y = axis->y + along * sin(axis->angle) + across * cos(axis->angle);
}

/* How far a ray is drawn before the first and behind the last surface, mm along the ray. */
static double lead(const struct layout *layout)
{
    return 0.3 * (layout->right - layout->left) + 0.5 * layout->size;
}

static void layout_add_ray(const struct rays_beams *beams, enum layout_kind kind, size_t field,
                           const struct ray *start)
{
    struct layout *layout = beams->layout;
    const size_t count = layout->setup->lens->surface_count;
    const int section = layout->setup->section == SECTION_Y ? 1 : 0;
    struct ray_intersection *meetings = ARENA_ARRAY(layout->arena, count, struct ray_intersection);
    size_t used = 1, last = LENS_NONE;
    double *z, *y;
    ray_follow(beams->open, start, layout->arena, meetings);
    if (meetings[count - 1].ray.status != RAY_OK) {
        return;
    }
    struct layout_part *part = layout_add(layout, kind, 2 * count + 2, &z, &y);
    part->field = field;
    for (size_t i = 0; i < count; i++) {
        if (layout->is_drawn[i]) {
            const double *point = meetings[i].ray.point;
            double hiatus = layout_hiatus(layout, i);
            if (hiatus != 0) {
                /* it leaves H' as high as it came to H */
                layout_place(layout, i, point[2] - hiatus, point[section], &z[used], &y[used]);
                used++;
            }
            layout_place(layout, i, point[2], point[section], &z[used], &y[used]);
            used++;
            last = i;
        }
    }
    /* Back from the first surface to the left of everything, or to the object. */
    const struct lens *lens = layout->setup->lens;
    double back = lead(layout);
    if (start->cosine[2] > 0.2) {
        back += fmax(z[1] - layout->left, 0) / start->cosine[2];
    }
    if (!lens->object_is_infinite && start->cosine[2] > 0) {
        back = fmin(back, fmax(z[1] + lens->object.value.hi, 0) / start->cosine[2]);
    }
    z[0] = z[1] - back * start->cosine[2];
    y[0] = y[1] - back * start->cosine[section];
    if (last != LENS_NONE) {
        /* On to the image plane, or a little way. */
        const struct ray *end = &meetings[last].ray;
        double far = lead(layout);
        if (isfinite(layout->image)) {
            double plane = layout->image - layout->vertex[count - 1];
            /* the frame is that of the last surface that is drawn */
            double gap = layout->vertex[count - 1] - layout->vertex[last];
            far = (plane + gap - end->point[2]) / end->cosine[2];
        }
        layout_place(layout, last, end->point[2] + far * end->cosine[2],
                     end->point[section] + far * end->cosine[section], &z[used], &y[used]);
        used++;
    }
    part->count = used;
}

/* One bundle: the edges that the clear apertures leave of it in the plane of the drawing. */
struct rays_bundle {
    struct beam beam;
    struct clear_cross clear;
};

static bool find_bundle(const struct setup *setup, const struct system *clipped,
                        const struct field_point *field, const struct first_order *first,
                        struct arena *arena, struct rays_bundle *bundle)
{
    struct error ignored;
    if (!beam_of_field(field, &setup->object, &setup->first, &bundle->beam, &ignored)) {
        return false;
    }
    struct arena_mark mark = arena_mark(arena);
    struct clear_guess guess = clear_guess_of(clipped, &bundle->beam, first);
    clear_across(clipped, &bundle->beam, &guess, lens_is_round(setup->lens), arena, &bundle->clear);
    arena_reset(arena, mark);
    return !bundle->clear.is_empty;
}

bool layout_ray_heights(const struct setup *setup, const struct layout_request *request,
                        struct arena *arena, double *heights)
{
    const size_t count = setup->lens->surface_count;
    struct field_point *fields = ARENA_ARRAY(arena, setup->field_count + 2, struct field_point);
    struct ray_intersection *meetings = ARENA_ARRAY(arena, count, struct ray_intersection);
    struct rays_bundle bundle;
    struct error ignored;
    const struct system *clipped =
        setup_system(setup, request->wavelength, SETUP_CLIPPED, &ignored);
    if (clipped == NULL || !isfinite(setup->first.stop_radius)) {
        return false;
    }
    fields[0] = (struct field_point){.kind = FIELD_NONE};
    size_t field_count = 1 + rays_fields(setup, fields + 1, &ignored);
    for (size_t k = 0; k < field_count; k++) {
        if (!find_bundle(setup, clipped, &fields[k], &request->light->first, arena, &bundle)) {
            continue;
        }
        for (size_t end = 0; end < 4; end++) {
            const double *at = bundle.clear.ends[end].at;
            struct ray ray = beam_ray(&bundle.beam, at[0], at[1]);
            ray_follow(clipped, &ray, arena, meetings);
            for (size_t i = 0; i < count && meetings[count - 1].ray.status == RAY_OK; i++) {
                const double *point = meetings[i].ray.point;
                heights[i] = fmax(heights[i], hypot(point[0], point[1]));
            }
        }
    }
    return true;
}

static const struct clear_edge *layout_edge_of(const struct rays_beams *beams,
                                               const struct rays_bundle *bundle, int side)
{
    size_t axis = beams->layout->setup->section == SECTION_Y ? 1 : 0;
    return &bundle->clear.ends[side > 0 ? axis : axis + 2];
}

static void add_edges(const struct rays_beams *beams, enum layout_kind kind, size_t field,
                      const struct rays_bundle *bundle)
{
    for (int side = -1; side <= 1; side += 2) {
        const double *at = layout_edge_of(beams, bundle, side)->at;
        struct ray ray = beam_ray(&bundle->beam, at[0], at[1]);
        layout_add_ray(beams, kind, field, &ray);
    }
}

/* The surface whose clear aperture cuts the bundle before the stop does; LENS_NONE: none. */
static size_t cutting(const struct rays_beams *beams, const struct rays_bundle *bundle)
{
    const struct lens *lens = beams->layout->setup->lens;
    for (int side = -1; side <= 1; side += 2) {
        const struct clear_edge *edge = layout_edge_of(beams, bundle, side);
        size_t i = edge->surface - 1;
        if (edge->status == RAY_CLIPPED && i < lens->surface_count && i != lens->stop &&
            isfinite(aperture_reach(&lens->surfaces[i]))) {
            return i;
        }
    }
    return LENS_NONE;
}

static void add_axial(struct rays_beams *beams)
{
    struct layout *layout = beams->layout;
    const struct field_point axis = {.kind = FIELD_NONE};
    struct rays_bundle bundle;
    if (!find_bundle(layout->setup, &beams->clipped, &axis, &layout->light->first, layout->arena,
                     &bundle)) {
        layout_note(layout, "no ray of the point on the axis passes the clear apertures");
        return;
    }
    size_t cut = cutting(beams, &bundle);
    if (cut != LENS_NONE && beams->has_stop) {
        layout_note(
            layout,
            arena_printf(
                layout->arena,
                "the axial beam is cut by the clear aperture of surface %zu, not by the stop",
                cut + 1));
    }
    add_edges(beams, LAYOUT_AXIAL, 0, &bundle);
}

static bool layout_rays_find_at(const struct rays_beams *beams, const struct field_point *edge,
                                double share, struct rays_bundle *bundle)
{
    const struct field_point field = {edge->kind, {share * edge->value[0], share * edge->value[1]}};
    const struct layout *layout = beams->layout;
    return find_bundle(layout->setup, &beams->clipped, &field, &layout->light->first, layout->arena,
                       bundle);
}

/*
 * The bundle at the edge of the field, or as near to it as rays pass, in steps of 3 %: halved
 * between the edge and where the last of these steps leads to. If none pass there, none are drawn:
 * to find that nothing passes takes far longer than to find what does.
 */
static double layout_find_edge(const struct rays_beams *beams, const struct field_point *edge,
                               struct rays_bundle *bundle)
{
    struct rays_bundle nearer;
    int dark = 0, lit = LEAST_FIELDS; /* steps from the edge */
    if (layout_rays_find_at(beams, edge, 1, bundle)) {
        return 1;
    }
    if (!layout_rays_find_at(beams, edge, pow(0.97, lit), bundle)) {
        return 0;
    }
    while (lit - dark > 1) {
        int middle = (lit + dark) / 2;
        if (layout_rays_find_at(beams, edge, pow(0.97, middle), &nearer)) {
            lit = middle;
            *bundle = nearer;
        } else {
            dark = middle;
        }
    }
    return pow(0.97, lit);
}

/* The bundle and the chief ray of a field, or of a share of it. */
static void add_oblique(const struct rays_beams *beams, const struct rays_bundle *bundle,
                        const struct field_point *of, double share)
{
    static const char *const heights[FIELD_KINDS] = {
        [FIELD_ANGLE] = "field", [FIELD_HEIGHT] = "object height", [FIELD_IMAGE] = "image height"};
    struct layout *layout = beams->layout;
    const size_t field = layout->field_count;
    layout->fields[layout->field_count++] =
        arena_printf(layout->arena, "%s %s", heights[of->kind], rays_field_text(layout, of, share));
    add_edges(beams, LAYOUT_OBLIQUE, field, bundle);
    /* of mirrors about the axis a secondary one would be in its way */
    bool has_mirror = false;
    for (size_t i = 0; i < layout->setup->lens->surface_count; i++) {
        has_mirror = has_mirror || surface_reflects(&layout->setup->lens->surfaces[i]);
    }
    struct aim aim;
    struct error ignored;
    if (beams->has_stop && !(layout->is_centred && has_mirror) &&
        aim_open(beams->open, &bundle->beam, layout->arena, &aim, &ignored)) {
        struct ray chief = aim_chief(&aim);
        layout_add_ray(beams, LAYOUT_CHIEF, field, &chief);
    }
}

/* The fields but the last; of more than there is room for an even choice. */
static void add_inner_fields(const struct rays_beams *beams, const struct field_point *fields,
                             size_t count)
{
    const size_t shown = count < MOST_FIELDS ? count : MOST_FIELDS;
    for (size_t k = 1; k < shown; k++) {
        const struct field_point *field = &fields[(k * count + shown - 1) / shown - 1];
        struct rays_bundle bundle;
        if (layout_rays_find_at(beams, field, 1, &bundle)) {
            add_oblique(beams, &bundle, field, 1);
        } else {
            layout_note(beams->layout,
                        arena_printf(beams->layout->arena,
                                     "no ray of the field %s passes the clear apertures",
                                     rays_field_text(beams->layout, field, 1)));
        }
    }
    if (shown < count) {
        layout_note(beams->layout, arena_printf(beams->layout->arena, "%zu of %zu fields are drawn",
                                                shown, count));
    }
}

static void add_edge_of_field(const struct rays_beams *beams, const struct field_point *edge)
{
    struct layout *layout = beams->layout;
    struct rays_bundle bundle;
    double share = layout_find_edge(beams, edge, &bundle);
    if (!(share > 0)) {
        layout_note(layout, "no ray from the edge of the field passes the clear apertures");
        return;
    }
    if (share < 1) {
        layout_note(layout,
                    arena_printf(layout->arena,
                                 "the oblique bundle is drawn at %s, not %s: no ray from there "
                                 "passes the clear apertures",
                                 rays_field_text(layout, edge, share),
                                 rays_field_text(layout, edge, 1)));
    } else if (cutting(beams, &bundle) != LENS_NONE) {
        layout_note(layout, "the oblique bundle is cut by the clear apertures of the elements");
    }
    add_oblique(beams, &bundle, edge, share);
}

bool layout_rays(struct layout *layout, struct error *error)
{
    const struct setup *setup = layout->setup;
    const struct first_order *first = &setup->first;
    struct rays_beams beams;
    bool has_clear_aperture = isfinite(first->stop_radius) || isfinite(first->entrance_diameter);
    for (size_t i = 0; i < setup->lens->surface_count; i++) {
        has_clear_aperture =
            has_clear_aperture || isfinite(aperture_reach(&setup->lens->surfaces[i]));
    }
    if (!has_clear_aperture) {
        layout_note(layout, "no rays: the lens states no aperture (give -N)");
        return true;
    }
    bool has_stop = setup->lens->stop != LENS_NONE && isfinite(setup->first.stop_radius);
    beams = (struct rays_beams){.layout = layout,
                                .open = setup_system(setup, layout->wavelength, SETUP_OPEN, error),
                                .has_stop = has_stop};
    /* Surfaces without a diameter have that of the drawing, and a little more: nobody stated it. */
    const struct lens *lens = layout->setup->lens;
    struct lens *copy = ARENA_NEW(layout->arena, struct lens);
    struct surface *surfaces = ARENA_ARRAY(layout->arena, lens->surface_count, struct surface);
    *copy = *lens;
    memcpy(surfaces, lens->surfaces, lens->surface_count * sizeof *surfaces);
    for (size_t j = 0; j < lens->surface_count; j++) {
        if (layout->is_drawn[j] && !surfaces[j].has_diameter) {
            surfaces[j].has_diameter = true;
            surfaces[j].diameter.value = pair_of(2.04 * layout->semi[j]);
        }
    }
    copy->surfaces = surfaces;
    if (!(beams.open != NULL &&
          setup_compile(setup, copy, layout->wavelength, SETUP_CLIPPED, &beams.clipped, error))) {
        return false;
    }
    add_axial(&beams);
    struct error lost = {0};
    struct field_point *fields =
        ARENA_ARRAY(layout->arena, setup->field_count + 1, struct field_point);
    size_t count = rays_fields(setup, fields, &lost);
    layout->fields = ARENA_ARRAY(layout->arena, count + 1, const char *);
    if (lost.code != ERROR_NONE) {
        layout_note(layout, arena_printf(layout->arena, "no oblique bundle: %s", lost.message));
    }
    if (count > 0) {
        add_inner_fields(&beams, fields, count);
        add_edge_of_field(&beams, &fields[count - 1]);
    }
    return true;
}
