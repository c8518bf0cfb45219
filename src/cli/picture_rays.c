/* cli/picture_rays.c - exact rays through the drawn lens, as its rims let them pass. */
/* SPDX-License-Identifier: MIT */
#include "cli/image_plane.h"
#include "cli/picture.h"
#include "trace/aim.h"
#include "trace/clear.h"
#include "trace/follow.h"

#include <string.h>

static const double DEGREE = 57.29577951308232; /* per rad */
enum { DIRECTIONS = 64, LEAST_FIELDS = 60 };

/* What the rays need: the lens with a rim at every surface that is drawn. */
struct beams {
    struct picture *picture;
    struct system clipped, open; /* with and without rims */
    struct conjugate_object object;
    bool has_stop; /* of a size */
};

/* Surfaces without a diameter have that of the drawing, and a little more: nobody stated it. */
static const struct lens *with_rims(const struct picture *picture)
{
    const struct lens *lens = picture->one->lens;
    struct lens *copy = ARENA_NEW(picture->arena, struct lens);
    struct surface *surfaces = ARENA_ARRAY(picture->arena, lens->surface_count, struct surface);
    *copy = *lens;
    memcpy(surfaces, lens->surfaces, lens->surface_count * sizeof *surfaces);
    for (size_t i = 0; i < lens->surface_count; i++) {
        if (picture->is_drawn[i] && !surfaces[i].has_diameter) {
            surfaces[i].has_diameter = true;
            surfaces[i].diameter.value = pair_of(2.04 * picture->semi[i]);
        }
    }
    copy->surfaces = surfaces;
    return copy;
}

static bool open_beams(struct picture *picture, struct beams *beams, struct error *error)
{
    const struct lens_case *one = picture->one;
    struct system_options options = system_options_default();
    bool has_stop = one->lens->stop != LENS_NONE && isfinite(one->first.stop_radius);
    options.stop_radius = has_stop ? fabs(one->first.stop_radius) : (double)NAN;
    *beams =
        (struct beams){.picture = picture, .object = lens_object(one->lens), .has_stop = has_stop};
    if (!system_compile(one->lens, one->wavelength, &options, picture->arena, &beams->open,
                        error)) {
        return false;
    }
    options.clip = true;
    return system_compile(with_rims(picture), one->wavelength, &options, picture->arena,
                          &beams->clipped, error);
}

/* From the frame of a surface's axis to the drawing. */
static void place(const struct picture *picture, size_t surface, double along, double across,
                  double *z, double *y)
{
    const struct picture_frame *axis = &picture->axis[surface];
    *z = axis->z + along * cos(axis->angle) - across * sin(axis->angle);
    *y = axis->y + along * sin(axis->angle) + across * cos(axis->angle);
}

/* How far a ray is drawn before the first and behind the last surface, mm along the ray. */
static double lead(const struct picture *picture)
{
    return 0.3 * (picture->right - picture->left) + 0.5 * picture->size;
}

/* Back from the first surface to the left of everything, or to the object. */
static void begin_ray(const struct picture *picture, const double cosine[3], int section, double *z,
                      double *y)
{
    const struct lens *lens = picture->one->lens;
    double back = lead(picture);
    if (cosine[2] > 0.2) {
        back += fmax(z[1] - picture->left, 0) / cosine[2];
    }
    if (!lens->object_is_infinite && cosine[2] > 0) {
        back = fmin(back, fmax(z[1] + lens->object.value.hi, 0) / cosine[2]);
    }
    z[0] = z[1] - back * cosine[2];
    y[0] = y[1] - back * cosine[section];
}

/* On to the image plane, or a little way. */
static void end_ray(const struct picture *picture, const struct ray *last, size_t surface,
                    int section, double *z, double *y)
{
    double way = lead(picture);
    if (isfinite(picture->image)) {
        size_t count = picture->one->lens->surface_count;
        double plane = picture->image - picture->vertex[count - 1];
        /* the frame is that of the last surface that is drawn */
        double gap = picture->vertex[count - 1] - picture->vertex[surface];
        way = (plane + gap - last->point[2]) / last->cosine[2];
    }
    place(picture, surface, last->point[2] + way * last->cosine[2],
          last->point[section] + way * last->cosine[section], z, y);
}

static void add_ray(const struct beams *beams, enum section_kind kind, const struct ray *start)
{
    struct picture *picture = beams->picture;
    const size_t count = picture->one->lens->surface_count;
    const int section = picture->one->section == SECTION_Y ? 1 : 0;
    struct ray_meeting *meetings = ARENA_ARRAY(picture->arena, count, struct ray_meeting);
    size_t used = 1, last = LENS_NONE;
    double *z, *y;
    ray_follow(&beams->open, start, picture->arena, meetings);
    if (meetings[count - 1].ray.status != RAY_OK) {
        return;
    }
    struct section_part *part = picture_part(picture, kind, 2 * count + 2, &z, &y);
    for (size_t i = 0; i < count; i++) {
        if (picture->is_drawn[i]) {
            const double *point = meetings[i].ray.point;
            double hiatus = picture_hiatus(picture, i);
            if (hiatus != 0) {
                /* it leaves H' as high as it came to H */
                place(picture, i, point[2] - hiatus, point[section], &z[used], &y[used]);
                used++;
            }
            place(picture, i, point[2], point[section], &z[used], &y[used]);
            used++;
            last = i;
        }
    }
    begin_ray(picture, start->cosine, section, z, y);
    if (last != LENS_NONE) {
        end_ray(picture, &meetings[last].ray, last, section, &z[used], &y[used]);
        used++;
    }
    part->count = used;
}

/* One bundle: the edges that the rims leave of it in the plane of the drawing, its chief ray. */
struct bundle {
    struct beam beam;
    struct clear_pupil clear;
    struct aim aim;
    bool has_chief;
};

static bool find_bundle(struct beams *beams, const struct field_point *field, struct bundle *bundle)
{
    struct picture *picture = beams->picture;
    const struct first_order *first = &picture->one->first;
    struct error ignored;
    if (!beam_of_field(field, &beams->object, first, &bundle->beam, &ignored)) {
        return false;
    }
    struct clear_guess guess = clear_guess_of(&beams->clipped, &bundle->beam, first);
    clear_find(&beams->clipped, &bundle->beam, &guess, DIRECTIONS, picture->arena, &bundle->clear);
    bundle->has_chief = beams->has_stop && aim_open(&beams->open, &bundle->beam, picture->arena,
                                                    &bundle->aim, &ignored);
    return !bundle->clear.is_empty;
}

static const struct clear_edge *edge_of(const struct beams *beams, const struct bundle *bundle,
                                        int side)
{
    bool up = beams->picture->one->section == SECTION_Y; /* edges begin below, counterclockwise */
    size_t high = up ? DIRECTIONS / 2 : DIRECTIONS / 4;
    size_t low = up ? 0 : 3 * (size_t)DIRECTIONS / 4;
    return &bundle->clear.edges[side > 0 ? high : low];
}

static void add_edges(const struct beams *beams, enum section_kind kind,
                      const struct bundle *bundle)
{
    for (int side = -1; side <= 1; side += 2) {
        const double *at = edge_of(beams, bundle, side)->at;
        struct ray ray = beam_ray(&bundle->beam, at[0], at[1]);
        add_ray(beams, kind, &ray);
    }
}

/* The surface whose stated rim cuts the bundle before the stop does; LENS_NONE if none does. */
static size_t cutting(const struct beams *beams, const struct bundle *bundle)
{
    const struct lens *lens = beams->picture->one->lens;
    for (int side = -1; side <= 1; side += 2) {
        const struct clear_edge *edge = edge_of(beams, bundle, side);
        size_t i = edge->surface - 1;
        if (edge->status == RAY_CLIPPED && i < lens->surface_count && i != lens->stop &&
            lens->surfaces[i].has_diameter) {
            return i;
        }
    }
    return LENS_NONE;
}

static void add_axial(struct beams *beams)
{
    struct picture *picture = beams->picture;
    const struct field_point axis = {.kind = FIELD_NONE};
    struct bundle bundle;
    if (!find_bundle(beams, &axis, &bundle)) {
        picture_note(picture, "no ray of the point on the axis passes the rims");
        return;
    }
    size_t cut = cutting(beams, &bundle);
    if (cut != LENS_NONE && beams->has_stop) {
        picture_note(
            picture,
            arena_printf(picture->arena,
                         "the axial beam is cut by the rim of surface %zu, not by the stop",
                         cut + 1));
    }
    add_edges(beams, SECTION_AXIAL, &bundle);
}

/* The bundle at the edge of the field, or as near to it as rays pass. */
static double find_edge(struct beams *beams, struct bundle *bundle)
{
    const struct lens_case *one = beams->picture->one;
    double share = 1;
    for (int step = 0; step < LEAST_FIELDS; step++, share *= 0.97) {
        struct field_point field = {.kind = one->field_kind};
        field.value[one->section == SECTION_Y ? 1 : 0] = share * one->field;
        if (find_bundle(beams, &field, bundle)) {
            return share;
        }
    }
    return 0;
}

static void note_share(struct picture *picture, double share)
{
    const struct lens_case *one = picture->one;
    bool angle = one->field_kind == FIELD_ANGLE;
    picture_note(picture,
                 arena_printf(picture->arena,
                              "the oblique bundle is drawn at %.3g%s, not %.3g%s: no ray from "
                              "there passes the rims",
                              share * one->field * (angle ? DEGREE : 1), angle ? "°" : " mm",
                              one->field * (angle ? DEGREE : 1), angle ? "°" : " mm"));
}

static bool has_mirror(const struct lens *lens)
{
    for (size_t i = 0; i < lens->surface_count; i++) {
        if (lens->surfaces[i].kind == SURFACE_REFLECT) {
            return true;
        }
    }
    return false;
}

static void add_oblique(struct beams *beams)
{
    struct picture *picture = beams->picture;
    struct bundle bundle;
    double share = find_edge(beams, &bundle);
    if (!(share > 0)) {
        picture_note(picture, "no ray from the edge of the field passes the rims");
        return;
    }
    if (share < 1) {
        note_share(picture, share);
    } else if (cutting(beams, &bundle) != LENS_NONE) {
        picture_note(picture, "the oblique bundle is cut by the rims of the elements");
    }
    add_edges(beams, SECTION_OBLIQUE, &bundle);
    /* of mirrors about the axis a secondary one would be in its way */
    if (bundle.has_chief && !(picture->is_centred && has_mirror(picture->one->lens))) {
        struct ray chief = aim_chief(&bundle.aim);
        add_ray(beams, SECTION_CHIEF, &chief);
    }
}

double picture_focus(const struct picture *picture)
{
    const struct lens_case *one = picture->one;
    struct error ignored;
    double focus;
    return image_plane_best(one->lens, &one->first, fabs(one->first.stop_radius), picture->arena,
                            &focus, &ignored)
               ? focus
               : (double)NAN;
}

bool picture_rays(struct picture *picture, struct error *error)
{
    const struct lens_case *one = picture->one;
    struct beams beams;
    bool has_rim = isfinite(one->first.stop_radius) || isfinite(one->first.entrance_diameter);
    for (size_t i = 0; i < one->lens->surface_count; i++) {
        has_rim = has_rim || one->lens->surfaces[i].has_diameter;
    }
    if (!has_rim) {
        picture_note(picture, "no rays: the lens states no aperture (give -N)");
        return true;
    }
    if (!open_beams(picture, &beams, error)) {
        return false;
    }
    add_axial(&beams);
    if (one->field_kind != FIELD_NONE && isfinite(one->field) && one->field != 0) {
        add_oblique(&beams);
    }
    return true;
}
