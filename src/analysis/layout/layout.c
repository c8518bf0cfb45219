/* analysis/layout/layout.c - a lens in section: its parts put together. */
/* SPDX-License-Identifier: MIT */
#include "analysis/layout/layout.h"

#include <math.h>

bool layout_is_centred(const struct lens *lens)
{
    for (size_t i = 0; i < lens->surface_count; i++) {
        if (lens->surfaces[i].decentre != NULL || lens->surfaces[i].coordinate_break != NULL) {
            return false;
        }
    }
    return true;
}

enum plane_kind layout_plane(const struct lens *lens)
{
    bool has_table = lens->surfaces[lens->surface_count - 1].has_thickness;
    return layout_is_centred(lens) || !has_table ? PLANE_OF_LENS : PLANE_TABLE;
}

static struct paraxial_ray *layout_follow(const struct layout *layout, double y, double v)
{
    struct paraxial_ray *rays =
        ARENA_ARRAY(layout->arena, layout->light->system.count, struct paraxial_ray);
    paraxial_follow(&layout->light->system, pair_of(y), pair_of(v), rays);
    return rays;
}

/* As high as the rays that arrive there, across the axis behind the last surface. */
static void layout_add_image(struct layout *layout)
{
    size_t last = layout->setup->lens->surface_count - 1;
    const struct layout_frame *axis = &layout->axis[last];
    double along = layout->image - layout->vertex[last], half = 0.2 * layout->size;
    double ahead = cos(axis->angle), aside = sin(axis->angle);
    double z = axis->z + along * ahead, y = axis->y + along * aside;
    if (!isfinite(layout->image)) {
        return;
    }
    for (size_t i = 0; i < layout->part_count; i++) {
        const struct layout_part *part = &layout->parts[i];
        if (part->kind == LAYOUT_OBLIQUE || part->kind == LAYOUT_CHIEF ||
            part->kind == LAYOUT_AXIAL) {
            size_t end = part->count - 1;
            half = fmax(half, 1.1 * fabs((part->y[end] - y) * ahead - (part->z[end] - z) * aside));
        }
    }
    layout_line(layout, LAYOUT_IMAGE,
                (struct layout_ends){z + half * aside, y - half * ahead, z - half * aside,
                                     y + half * ahead},
                "image");
}

/* From vertex to vertex where the axis is folded, and a little farther at both ends. */
static void add_folded_axis(struct layout *layout)
{
    const struct lens *lens = layout->setup->lens;
    const size_t count = lens->surface_count;
    double *z, *y, more = 0.6 * layout->size;
    layout_add(layout, LAYOUT_AXIS, count + 2, &z, &y);
    z[0] = -more;
    y[0] = 0;
    for (size_t i = 0; i < count; i++) {
        z[i + 1] = layout->axis[i].z;
        y[i + 1] = layout->axis[i].y;
    }
    const struct surface *last = &lens->surfaces[count - 1];
    double t = last->has_thickness ? last->thickness.value.hi : more * layout->light_direction;
    double angle = layout->axis[count - 1].angle;
    z[count + 1] = z[count] + t * cos(angle);
    y[count + 1] = y[count] + t * sin(angle);
}

static bool add_bundles(struct layout *layout, const struct layout_request *request,
                        struct error *error)
{
    /* The image plane, where it lies behind the lens and not too far; else it is only noted. */
    double distance = layout->setup->image;
    double reach = 8 * (layout->right - layout->left + 2 * layout->size);
    layout->image = NAN;
    if (distance * layout->light_direction >= 0 && fabs(distance) <= reach) {
        layout->image = layout_rear(layout) + distance;
    } else if (isfinite(distance)) {
        layout_note(layout,
                    arena_printf(layout->arena, "the image is not shown: it lies %.5g mm %s",
                                 fabs(distance),
                                 distance * layout->light_direction > 0
                                     ? "behind the last vertex"
                                     : "before the last vertex (virtual)"));
    } else {
        layout_note(layout, "the image is at infinity");
    }
    if (!request->no_rays && !layout_rays(layout, error)) {
        return false;
    }
    layout_add_image(layout);
    if (request->planes) {
        layout_planes(layout, true);
    }
    return true;
}

bool layout_make(const struct setup *setup, const struct layout_request *request,
                 struct arena *arena, struct layout *layout, struct error *error)
{
    const struct first_order *first = &request->light->first;
    *layout = (struct layout){.setup = setup,
                              .wavelength = request->wavelength,
                              .light = request->light,
                              .arena = arena,
                              .is_centred = layout_is_centred(setup->lens),
                              .image = NAN};
    layout->marginal = layout_follow(layout, first->marginal_y, first->marginal_v);
    layout->chief = layout_follow(layout, first->chief_y, first->chief_v);
    if (!layout_lens(layout, error)) {
        return false;
    }
    if (!layout->is_centred) {
        add_folded_axis(layout);
    }
    if (!(request->construction ? layout_construction(layout, error)
                                : add_bundles(layout, request, error))) {
        return false;
    }
    if (layout->is_centred) {
        /* Through everything that is drawn, and a little farther. */
        double left = layout->left, right = layout->right;
        for (size_t i = 0; i < layout->part_count; i++) {
            const struct layout_part *part = &layout->parts[i];
            for (size_t k = 0; k < part->count; k++) {
                left = fmin(left, part->z[k]);
                right = fmax(right, part->z[k]);
            }
        }
        double more = 0.02 * (right - left) + 0.05 * layout->size;
        layout_line(layout, LAYOUT_AXIS, (struct layout_ends){left - more, 0, right + more, 0},
                    NULL);
    }
    return true;
}
