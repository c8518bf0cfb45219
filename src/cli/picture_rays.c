/* cli/picture_rays.c - paraxial rays through the drawn surfaces of a lens. */
/* SPDX-License-Identifier: MIT */
#include "cli/picture.h"

static const double DEGREE = 57.29577951308232; /* per rad */
static const double STEEPEST = 3;               /* |dy/dz| of a ray that is drawn */

/* A ray of the bundle: chief * field + marginal * pupil. */
struct pick {
    double field, pupil;
};

static double mix(struct pick pick, double chief, double marginal)
{
    return (pick.field != 0 ? pick.field * chief : 0) +
           (pick.pupil != 0 ? pick.pupil * marginal : 0);
}

/* How far a ray is drawn before the first and behind the last surface, mm along the ray. */
static double lead(const struct picture *picture)
{
    return 0.3 * (picture->right - picture->left) + 0.5 * picture->size;
}

/* The part of the ray before the lens. */
static void begin_ray(const struct picture *picture, struct pick pick, size_t first, double *z,
                      double *y)
{
    const struct lens *lens = picture->one->lens;
    double slope = mix(pick, picture->chief[first].before, picture->marginal[first].before) /
                   picture->one->system.index[first].hi;
    double start = picture->left - lead(picture) / hypot(1, slope);
    if (!lens->object_is_infinite) {
        start = fmax(start, -lens->object.value.hi);
    }
    y[0] = y[1] - slope * (z[1] - start);
    z[0] = start;
}

static void end_ray(const struct picture *picture, struct pick pick, size_t last, double *z,
                    double *y)
{
    double height = mix(pick, picture->chief[last].y, picture->marginal[last].y);
    double slope = mix(pick, picture->chief[last].after, picture->marginal[last].after) /
                   picture->one->system.index[last + 1].hi;
    if (isfinite(picture->image)) {
        z[1] = picture->image;
        y[1] = height + slope * (picture->image - picture->vertex[last]);
        return;
    }
    double end = picture->heading > 0 ? picture->right : picture->left;
    z[1] = end + picture->heading * lead(picture) / hypot(1, slope);
    y[1] = y[0] + slope * (z[1] - z[0]);
}

static void add_ray(struct picture *picture, enum section_kind kind, struct pick pick)
{
    const size_t count = picture->one->lens->surface_count;
    size_t used = 1, first = LENS_NONE, last = 0;
    double *z, *y;
    struct section_part *part = picture_part(picture, kind, count + 2, &z, &y);
    for (size_t i = 0; i < count; i++) {
        if (!picture->is_drawn[i]) {
            continue;
        }
        double height = mix(pick, picture->chief[i].y, picture->marginal[i].y);
        y[used] = height;
        z[used++] = picture->vertex[i] + picture_sag(picture, i, height);
        first = first == LENS_NONE ? i : first;
        last = i;
    }
    begin_ray(picture, pick, first, z, y);
    end_ray(picture, pick, last, &z[used - 1], &y[used - 1]);
    part->count = used + 1;
}

/* The largest share of the heights that all rims let pass, at most 1. */
static double share(const struct picture *picture, const struct paraxial_ray *rays)
{
    double most = 1;
    for (size_t i = 0; i < picture->one->lens->surface_count; i++) {
        if (picture->is_drawn[i] && fabs(rays[i].y) > picture->semi[i] * 1.0005) {
            most = fmin(most, picture->semi[i] / fabs(rays[i].y));
        }
    }
    return most;
}

/* From the chief ray towards one edge of the pupil, as far as the rims allow. */
static double pupil_reach(const struct picture *picture, double field, double side, double most)
{
    double reach = most;
    for (size_t i = 0; i < picture->one->lens->surface_count; i++) {
        double step = side * picture->marginal[i].y, from = field * picture->chief[i].y;
        double room = picture->semi[i] - (step > 0 ? from : -from);
        if (picture->is_drawn[i] && fabs(step) > 0) {
            reach = fmin(reach, fmax(room, 0) / fabs(step));
        }
    }
    return side * reach;
}

/* On the true surfaces, does the ray go from each to the next without a leap? */
static bool is_smooth(const struct picture *picture, struct pick pick)
{
    double z = NAN, y = NAN;
    for (size_t i = 0; i < picture->one->lens->surface_count; i++) {
        if (picture->is_drawn[i]) {
            double height = mix(pick, picture->chief[i].y, picture->marginal[i].y);
            double at = picture->vertex[i] + picture_sag(picture, i, height);
            if (fabs(height - y) > STEEPEST * (at - z) * picture->direction[i] &&
                fabs(height - y) > 0.02 * picture->size) {
                return false;
            }
            z = at;
            y = height;
        }
    }
    return true;
}

/* The share of the field whose bundle can be drawn. */
static double find_field(const struct picture *picture, double axial)
{
    double field = share(picture, picture->chief);
    field *= field < 1 ? 0.93 : 1; /* room for a bundle about the chief ray */
    for (int step = 0; step < 80; step++, field *= 0.96) {
        double low = pupil_reach(picture, field, -1, axial);
        double high = pupil_reach(picture, field, 1, axial);
        if (is_smooth(picture, (struct pick){field, 0}) &&
            is_smooth(picture, (struct pick){field, low}) &&
            is_smooth(picture, (struct pick){field, high})) {
            break;
        }
    }
    return field;
}

static void add_oblique(struct picture *picture, double axial)
{
    const struct first_order *first = &picture->one->first;
    double field = find_field(picture, axial);
    if (field < 1) {
        double slope = first->chief_v / first->index_object;
        const char *angle =
            picture->one->lens->object_is_infinite
                ? arena_printf(picture->arena, " (%.3g°)", atan(fabs(field * slope)) * DEGREE)
                : "";
        picture_note(picture, arena_printf(picture->arena,
                                           "the oblique bundle is drawn at %.0f %% of the field's "
                                           "edge%s: paraxial rays beyond miss the surfaces",
                                           100 * field, angle));
    }
    double low = pupil_reach(picture, field, -1, axial),
           high = pupil_reach(picture, field, 1, axial);
    if (high - low < 1.99 * axial && !(field < 1)) {
        picture_note(picture, "the oblique bundle is cut by the rims of the elements");
    }
    add_ray(picture, SECTION_OBLIQUE, (struct pick){field, low});
    add_ray(picture, SECTION_OBLIQUE, (struct pick){field, high});
    bool has_mirror = false;
    for (size_t i = 0; i < picture->one->lens->surface_count; i++) {
        has_mirror = has_mirror || picture->one->lens->surfaces[i].kind == SURFACE_REFLECT;
    }
    if (!has_mirror) { /* a secondary mirror would be in the way */
        add_ray(picture, SECTION_CHIEF, (struct pick){field, 0});
    }
}

void picture_rays(struct picture *picture)
{
    const struct first_order *first = &picture->one->first;
    if (!isfinite(first->marginal_y) || !isfinite(first->marginal_v)) {
        picture_note(picture, "no rays: the lens states no aperture (give -N)");
        return;
    }
    double axial = share(picture, picture->marginal);
    if (axial < 1) {
        picture_note(picture,
                     arena_printf(picture->arena,
                                  "the axial beam is drawn at %.0f %% of its height: the rims stop "
                                  "the rest",
                                  100 * axial));
    }
    add_ray(picture, SECTION_AXIAL, (struct pick){0, axial});
    add_ray(picture, SECTION_AXIAL, (struct pick){0, -axial});
    bool has_field = isfinite(first->chief_y) && isfinite(first->chief_v) &&
                     fabs(first->chief_v) + fabs(first->chief_y) > 0;
    if (has_field) {
        add_oblique(picture, axial);
    }
}
