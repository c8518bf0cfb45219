/* analysis/layout/layout.c - a lens in section: its parts put together, cardinal points, Gauss rays. */
/* SPDX-License-Identifier: MIT */
#include "analysis/layout/layout.h"

#include <math.h>

/* Cardinal points on the drawing's axis, mm from the first vertex. */
struct cardinal {
    double F, F2, H, H2, N, N2; /* 2: on the image side, F' H' N' */
};

static struct cardinal cardinal_points(const struct layout *layout)
{
    const struct first_order *first = &layout->light->first;
    double end = first->length;
    return (struct cardinal){first->ffl,
                             end + first->bfl,
                             first->front_principal,
                             end + first->rear_principal,
                             first->front_nodal,
                             end + first->rear_nodal};
}

/* Is a place near enough to be drawn? Otherwise it is noted, with its place. */
static bool layout_planes_is_near(struct layout *layout, double z, const char *name)
{
    double image = isfinite(layout->image) ? layout->image : layout->right;
    double left = fmin(layout->left, image), right = fmax(layout->right, image);
    double more = 1.2 * (right - left) + layout->size;
    if (isnan(z)) {
        return false;
    }
    if (z >= left - more && z <= right + more) {
        return true;
    }
    layout_note(layout, isfinite(z)
                            ? arena_printf(layout->arena,
                                           "%s lies outside the drawing, %.5g mm from the first "
                                           "vertex",
                                           name, z)
                            : arena_printf(layout->arena, "%s is at infinity", name));
    return false;
}

static void layout_planes_add_point(struct layout *layout, double at, const char *name)
{
    double *z, *y;
    if (layout_planes_is_near(layout, at, name)) {
        struct layout_part *part = layout_add(layout, LAYOUT_POINT, 1, &z, &y);
        z[0] = at;
        y[0] = 0;
        part->label = name;
    }
}

static void layout_planes_add_plane(struct layout *layout, double at, double half, const char *name)
{
    if (layout_planes_is_near(layout, at, name)) {
        layout_line(layout, LAYOUT_PLANE, (struct layout_ends){at, -half, at, half}, name);
    }
}

static void planes_add_pupil(struct layout *layout, double at, double diameter, const char *name)
{
    double r = diameter / 2, tick = 0.3 * layout->size;
    if (!isnan(at) && isfinite(r) && layout_planes_is_near(layout, at, name)) {
        layout_line(layout, LAYOUT_PUPIL, (struct layout_ends){at, -r, at, -r - tick}, name);
        layout_line(layout, LAYOUT_PUPIL, (struct layout_ends){at, r, at, r + tick}, NULL);
    }
}

static void layout_planes_add_lines(struct layout *layout, enum layout_kind kind,
                                    const double *from_z, const double *from_y, size_t count)
{
    double *z, *y;
    layout_add(layout, kind, count, &z, &y);
    for (size_t i = 0; i < count; i++) {
        z[i] = from_z[i];
        y[i] = from_y[i];
    }
}

/* Behind H': to the image if it lies there; else onwards, and dashed back to the image. */
static void layout_planes_leave(struct layout *layout, double z, double y, double image_z,
                                double image_y, double end)
{
    bool real = image_z > z;
    double slope = (image_y - y) / (image_z - z);
    layout_line(
        layout, LAYOUT_GAUSS,
        (struct layout_ends){z, y, real ? image_z : end, real ? image_y : y + slope * (end - z)},
        NULL);
    if (!real) {
        layout_line(layout, LAYOUT_EXTENDED, (struct layout_ends){image_z, image_y, z, y}, NULL);
    }
}

/*
 * The three Gauss rays of the equivalent lens: parallel to the axis, through F, through N and N'.
 *
 * Errors    ERROR_DOMAIN: an afocal lens; an odd number of mirrors
 */
static bool layout_construction(struct layout *layout, struct error *error)
{
    const struct cardinal at = cardinal_points(layout);
    const struct first_order *first = &layout->light->first;
    if (first->is_afocal || !isfinite(at.F) || !isfinite(at.F2)) {
        return fail(error, ERROR_DOMAIN, "the lens is afocal: it has no equivalent lens");
    }
    if (layout->light_direction < 0) {
        return fail(error, ERROR_DOMAIN,
                    "an odd number of mirrors: light leaves to the left, and the construction "
                    "is for lenses");
    }
    double front = at.H - at.F, rear = at.F2 - at.H2, h = 0.7 * layout->size;
    double object = at.H - 2.4 * fabs(front);
    /* the ray through F leaves at the image's height, the parallel one through F' */
    double through = (at.H - object) / (at.F - object), y = h - h * through;
    double image = at.H2 + rear * (1 - y / h), end = at.H2 + 1.2 * fabs(rear);
    const double parallel_z[] = {object, at.H, at.H2}, parallel_y[] = {h, h, h};
    const double focal_z[] = {object, at.H, at.H2}, focal_y[] = {h, y, y};
    const double nodal_y[] = {h, 0, 0}, nodal_z[] = {object, at.N, at.N2};
    layout_planes_add_lines(layout, LAYOUT_GAUSS, parallel_z, parallel_y, 3);
    layout_planes_leave(layout, at.H2, h, image, y, end);
    layout_planes_add_lines(layout, LAYOUT_GAUSS, focal_z, focal_y, 3);
    layout_planes_leave(layout, at.H2, y, image, y, end);
    layout_planes_add_lines(layout, LAYOUT_GAUSS, nodal_z, nodal_y, 3);
    layout_planes_leave(layout, at.N2, 0, image, y, end);
    layout_line(layout, LAYOUT_ARROW, (struct layout_ends){object, 0, object, h}, NULL);
    layout_line(layout, LAYOUT_ARROW, (struct layout_ends){image, 0, image, y}, NULL);
    double half = fmax(1.25 * layout->size, 1.1 * fabs(y));
    layout_line(layout, LAYOUT_PLANE, (struct layout_ends){at.H, -half, at.H, half}, "H");
    layout_line(layout, LAYOUT_PLANE, (struct layout_ends){at.H2, -half, at.H2, half}, "H'");
    const char *names[] = {"F", "F'", "N", "N'"};
    const double places[] = {at.F, at.F2, at.N, at.N2};
    for (size_t i = 0; i < 4; i++) {
        double *point_z, *point_y;
        struct layout_part *part = layout_add(layout, LAYOUT_POINT, 1, &point_z, &point_y);
        point_z[0] = places[i];
        part->label = names[i];
    }
    layout_note(layout,
                arena_printf(layout->arena,
                             "equivalent lens, magnification %.3g: parallel to the axis and "
                             "through F'; through F and parallel; to N and on from N'",
                             y / h));
    return true;
}

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
        const struct first_order *first = &layout->light->first;
        const struct cardinal at = cardinal_points(layout);
        double half = 1.25 * layout->size;
        layout_planes_add_plane(layout, at.H, half, "H");
        layout_planes_add_plane(layout, at.H2, half, "H'");
        layout_planes_add_point(layout, at.F, "F");
        layout_planes_add_point(layout, at.F2, "F'");
        planes_add_pupil(layout, first->entrance_pupil, first->entrance_diameter, "entrance pupil");
        planes_add_pupil(layout, first->length + first->exit_pupil, first->exit_diameter,
                         "exit pupil");
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
    if (!layout_lens(layout, request, error)) {
        return false;
    }
    if (!layout->is_centred) {
        /* From vertex to vertex where the axis is folded, and a little farther at both ends. */
        const struct lens *lens = layout->setup->lens;
        const size_t count = lens->surface_count;
        double *z, *y, beyond = 0.6 * layout->size;
        layout_add(layout, LAYOUT_AXIS, count + 2, &z, &y);
        z[0] = -beyond;
        y[0] = 0;
        for (size_t j = 0; j < count; j++) {
            z[j + 1] = layout->axis[j].z;
            y[j + 1] = layout->axis[j].y;
        }
        const struct surface *last = &lens->surfaces[count - 1];
        double t =
            last->has_thickness ? last->thickness.value.hi : beyond * layout->light_direction;
        double angle = layout->axis[count - 1].angle;
        z[count + 1] = z[count] + t * cos(angle);
        y[count + 1] = y[count] + t * sin(angle);
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
