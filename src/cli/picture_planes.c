/* cli/picture_planes.c - cardinal points, pupils and the construction with the Gauss rays. */
/* SPDX-License-Identifier: MIT */
#include "cli/picture.h"

/* Cardinal points on the drawing's axis, mm from the first vertex. */
struct cardinal {
    double F, F2, H, H2, N, N2; /* 2: on the image side, F' H' N' */
};

static struct cardinal cardinal_points(const struct picture *picture)
{
    const struct first_order *first = &picture->one->first;
    double end = first->length;
    return (struct cardinal){first->ffl,
                             end + first->bfl,
                             first->front_principal,
                             end + first->rear_principal,
                             first->front_nodal,
                             end + first->rear_nodal};
}

/* Is a place near enough to be drawn? Otherwise it is noted, with its place. */
static bool is_near(struct picture *picture, double z, const char *name)
{
    double image = isfinite(picture->image) ? picture->image : picture->right;
    double left = fmin(picture->left, image), right = fmax(picture->right, image);
    double more = 1.2 * (right - left) + picture->size;
    if (isnan(z)) {
        return false;
    }
    if (z >= left - more && z <= right + more) {
        return true;
    }
    picture_note(picture, isfinite(z)
                              ? arena_printf(picture->arena,
                                             "%s lies outside the drawing, %.5g mm from the first "
                                             "vertex",
                                             name, z)
                              : arena_printf(picture->arena, "%s is at infinity", name));
    return false;
}

static void add_point(struct picture *picture, double at, const char *name)
{
    double *z, *y;
    if (is_near(picture, at, name)) {
        struct section_part *part = picture_part(picture, SECTION_POINT, 1, &z, &y);
        z[0] = at;
        y[0] = 0;
        part->label = name;
    }
}

static void add_plane(struct picture *picture, double at, double half, const char *name)
{
    if (is_near(picture, at, name)) {
        picture_line(picture, SECTION_PLANE, at, -half, at, half, name);
    }
}

static void add_pupil(struct picture *picture, double at, double diameter, const char *name)
{
    double r = diameter / 2, tick = 0.3 * picture->size;
    if (!isnan(at) && isfinite(r) && is_near(picture, at, name)) {
        picture_line(picture, SECTION_PUPIL, at, -r, at, -r - tick, name);
        picture_line(picture, SECTION_PUPIL, at, r, at, r + tick, NULL);
    }
}

void picture_planes(struct picture *picture, bool with_pupils)
{
    const struct first_order *first = &picture->one->first;
    const struct cardinal at = cardinal_points(picture);
    double half = 1.25 * picture->size;
    add_plane(picture, at.H, half, "H");
    add_plane(picture, at.H2, half, "H'");
    add_point(picture, at.F, "F");
    add_point(picture, at.F2, "F'");
    if (with_pupils) {
        add_pupil(picture, first->entrance_pupil, first->entrance_diameter, "entrance pupil");
        add_pupil(picture, first->length + first->exit_pupil, first->exit_diameter, "exit pupil");
    }
}

static void add_lines(struct picture *picture, enum section_kind kind, const double *from_z,
                      const double *from_y, size_t count)
{
    double *z, *y;
    picture_part(picture, kind, count, &z, &y);
    for (size_t i = 0; i < count; i++) {
        z[i] = from_z[i];
        y[i] = from_y[i];
    }
}

/* Behind H': to the image if it lies there; else onwards, and dashed back to the image. */
static void leave(struct picture *picture, double z, double y, double image_z, double image_y,
                  double end)
{
    bool real = image_z > z;
    double slope = (image_y - y) / (image_z - z);
    picture_line(picture, SECTION_GAUSS, z, y, real ? image_z : end,
                 real ? image_y : y + slope * (end - z), NULL);
    if (!real) {
        picture_line(picture, SECTION_EXTENDED, image_z, image_y, z, y, NULL);
    }
}

bool picture_construction(struct picture *picture, struct error *error)
{
    const struct cardinal at = cardinal_points(picture);
    const struct first_order *first = &picture->one->first;
    if (first->is_afocal || !isfinite(at.F) || !isfinite(at.F2)) {
        return fail(error, ERROR_DOMAIN, "the lens is afocal: it has no equivalent lens");
    }
    if (picture->heading < 0) {
        return fail(error, ERROR_DOMAIN,
                    "an odd number of mirrors: light leaves to the left, and the construction "
                    "is for lenses");
    }
    double front = at.H - at.F, rear = at.F2 - at.H2, h = 0.7 * picture->size;
    double object = at.H - 2.4 * fabs(front);
    /* the ray through F leaves at the image's height, the parallel one through F' */
    double through = (at.H - object) / (at.F - object), y = h - h * through;
    double image = at.H2 + rear * (1 - y / h), end = at.H2 + 1.2 * fabs(rear);
    const double parallel_z[] = {object, at.H, at.H2}, parallel_y[] = {h, h, h};
    const double focal_z[] = {object, at.H, at.H2}, focal_y[] = {h, y, y};
    const double nodal_y[] = {h, 0, 0}, nodal_z[] = {object, at.N, at.N2};
    add_lines(picture, SECTION_GAUSS, parallel_z, parallel_y, 3);
    leave(picture, at.H2, h, image, y, end);
    add_lines(picture, SECTION_GAUSS, focal_z, focal_y, 3);
    leave(picture, at.H2, y, image, y, end);
    add_lines(picture, SECTION_GAUSS, nodal_z, nodal_y, 3);
    leave(picture, at.N2, 0, image, y, end);
    picture_line(picture, SECTION_ARROW, object, 0, object, h, NULL);
    picture_line(picture, SECTION_ARROW, image, 0, image, y, NULL);
    double half = fmax(1.25 * picture->size, 1.1 * fabs(y));
    picture_line(picture, SECTION_PLANE, at.H, -half, at.H, half, "H");
    picture_line(picture, SECTION_PLANE, at.H2, -half, at.H2, half, "H'");
    const char *names[] = {"F", "F'", "N", "N'"};
    const double places[] = {at.F, at.F2, at.N, at.N2};
    for (size_t i = 0; i < 4; i++) {
        double *point_z, *point_y;
        struct section_part *part = picture_part(picture, SECTION_POINT, 1, &point_z, &point_y);
        point_z[0] = places[i];
        part->label = names[i];
    }
    picture_note(picture,
                 arena_printf(picture->arena,
                              "equivalent lens, magnification %.3g: parallel to the axis and "
                              "through F'; through F and parallel; to N and on from N'",
                              y / h));
    return true;
}
