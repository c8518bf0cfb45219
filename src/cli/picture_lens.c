/* cli/picture_lens.c - outlines of elements, mirrors and stop from the surfaces of a lens. */
/* SPDX-License-Identifier: MIT */
#include "cli/picture.h"

enum { SAMPLES = 48, HATCHES = 28 };
static const double QUARTER = 1.5707963267948966; /* of a turn */
static const double THINNEST = 0.12;              /* edge of an element, against its middle */
static const double STEEPEST = 2;                 /* slope of an edge */

struct section_part *picture_part(struct picture *picture, enum section_kind kind, size_t count,
                                  double **z, double **y)
{
    if (picture->part_count == picture->part_room) {
        size_t room = 2 * picture->part_room + 32;
        struct section_part *parts = ARENA_ARRAY(picture->arena, room, struct section_part);
        for (size_t i = 0; i < picture->part_count; i++) {
            parts[i] = picture->parts[i];
        }
        picture->parts = parts;
        picture->part_room = room;
    }
    struct section_part *part = &picture->parts[picture->part_count++];
    *z = ARENA_ARRAY(picture->arena, count, double);
    *y = ARENA_ARRAY(picture->arena, count, double);
    *part = (struct section_part){.kind = kind, .z = *z, .y = *y, .count = count};
    return part;
}

void picture_line(struct picture *picture, enum section_kind kind, double z1, double y1, double z2,
                  double y2, const char *label)
{
    double *z, *y;
    struct section_part *part = picture_part(picture, kind, 2, &z, &y);
    z[0] = z1;
    y[0] = y1;
    z[1] = z2;
    y[1] = y2;
    part->label = label;
}

void picture_note(struct picture *picture, const char *note)
{
    const char **notes = ARENA_ARRAY(picture->arena, picture->note_count + 1, const char *);
    for (size_t i = 0; i < picture->note_count; i++) {
        notes[i] = picture->notes[i];
    }
    notes[picture->note_count++] = note;
    picture->notes = notes;
}

double picture_sag(const struct picture *picture, size_t surface, double r)
{
    const struct surface *one = &picture->one->lens->surfaces[surface];
    enum curved other = picture->one->section == SECTION_Y ? CURVED_X : CURVED_Y;
    return one->curved == other || one->kind == SURFACE_STOP ? 0 : surface_sag(one, r);
}

static bool is_glass(const struct picture *picture, size_t surface)
{
    return surface < picture->one->lens->surface_count &&
           !medium_is_air(&picture->one->lens->surfaces[surface].medium);
}

/* Glass between this surface and the next: is there a piece to draw? */
static bool has_element(const struct picture *picture, size_t surface)
{
    return surface + 1 < picture->one->lens->surface_count && is_glass(picture, surface);
}

/* The surface's own edge in z; what lies beyond its clear diameter is a flat. */
static double edge(const struct picture *picture, size_t surface)
{
    return picture->vertex[surface] + picture_sag(picture, surface, picture->semi[surface]);
}

/* Thickness of the glass after a surface, both surfaces continued to r. */
static double thickness(const struct picture *picture, size_t i, double r)
{
    return (picture->vertex[i + 1] + picture_sag(picture, i + 1, r) - picture->vertex[i] -
            picture_sag(picture, i, r)) *
           picture->direction[i + 1];
}

static void find_places(struct picture *picture)
{
    const struct lens *lens = picture->one->lens;
    double z = 0, direction = 1;
    for (size_t i = 0; i < lens->surface_count; i++) {
        const struct surface *surface = &lens->surfaces[i];
        picture->vertex[i] = z;
        picture->direction[i] = direction;
        z += surface_advance(surface).hi;
        direction = surface->kind == SURFACE_REFLECT ? -direction : direction;
        picture->is_drawn[i] = surface->kind == SURFACE_REFLECT || surface->kind == SURFACE_THICK ||
                               is_glass(picture, i) || (i > 0 && is_glass(picture, i - 1));
    }
    picture->heading = direction;
}

/* Shift, then turn, as far as both lie in the plane of the drawing; returns what does not. */
static bool displace(const struct picture *picture, const struct displacement *by,
                     struct picture_frame *frame)
{
    if (by == NULL) {
        return false;
    }
    /* a right-handed turn about x takes z towards -y, one about y takes it towards x */
    bool y_section = picture->one->section == SECTION_Y;
    double shift = by->decenter[y_section ? 1 : 0].value.hi;
    double turn = y_section ? -by->tilt[0].value.hi : by->tilt[1].value.hi;
    frame->z -= shift * sin(frame->angle);
    frame->y += shift * cos(frame->angle);
    frame->angle += turn;
    return by->decenter[y_section ? 0 : 1].value.hi != 0 ||
           by->tilt[y_section ? 1 : 0].value.hi != 0 || by->tilt[2].value.hi != 0;
}

static void find_frames(struct picture *picture)
{
    const struct lens *lens = picture->one->lens;
    struct picture_frame axis = {0, 0, 0};
    bool is_skew = false;
    picture->is_centred = true;
    for (size_t i = 0; i < lens->surface_count; i++) {
        const struct surface *surface = &lens->surfaces[i];
        is_skew = displace(picture, surface->bend, &axis) || is_skew;
        picture->axis[i] = picture->frames[i] = axis;
        is_skew = displace(picture, surface->moved, &picture->frames[i]) || is_skew;
        picture->is_centred =
            picture->is_centred && surface->bend == NULL && surface->moved == NULL;
        double t = surface->has_thickness ? surface->thickness.value.hi : 0;
        axis.z += t * cos(axis.angle);
        axis.y += t * sin(axis.angle);
    }
    if (is_skew) {
        picture_note(picture, "shifts and turns out of the plane of the drawing are left out");
    }
}

void picture_put(const struct picture *picture, size_t surface, double *z, double *y)
{
    if (picture->is_centred) {
        return;
    }
    const struct picture_frame *frame = &picture->frames[surface];
    double along = *z - picture->vertex[surface], across = *y;
    *z = frame->z + along * cos(frame->angle) - across * sin(frame->angle);
    *y = frame->y + along * sin(frame->angle) + across * cos(frame->angle);
}

/* Is there room between two neighbouring surfaces, each with a flat beyond its diameter, to r? */
static bool is_apart(const struct picture *picture, size_t i, double r)
{
    const struct surface *surface = &picture->one->lens->surfaces[i];
    bool both = i + 1 < picture->one->lens->surface_count && picture->is_drawn[i] &&
                picture->is_drawn[i + 1] && surface->kind != SURFACE_THICK &&
                surface[1].kind != SURFACE_THICK;
    for (int k = 1; both && k <= SAMPLES; k++) {
        double h = r * k / SAMPLES;
        double left = picture_sag(picture, i, fmin(h, picture->semi[i]));
        double right = picture_sag(picture, i + 1, fmin(h, picture->semi[i + 1]));
        double gap = picture->vertex[i + 1] + right - picture->vertex[i] - left;
        double least = is_glass(picture, i) ? THINNEST * fabs(thickness(picture, i, 0)) : 0;
        if (gap * picture->direction[i + 1] < least) {
            return false;
        }
    }
    return true;
}

/* Does a diameter that nobody stated make sense: no crossing, no slope beyond that of a lens? */
static bool is_sensible(const struct picture *picture, size_t i)
{
    double r = picture->semi[i];
    double rise = picture_sag(picture, i, r) - picture_sag(picture, i, 0.98 * r);
    return fabs(rise) < STEEPEST * 0.02 * r && is_apart(picture, i, r) &&
           (i == 0 || is_apart(picture, i - 1, r));
}

/* Less, until there is a sag and, where nobody stated the diameter, room for the surface. */
static void shrink(struct picture *picture, size_t i, bool is_guess)
{
    double *semi = &picture->semi[i];
    for (int step = 0; step < 400; step++, *semi *= 0.99) {
        if (isfinite(picture_sag(picture, i, *semi)) && (!is_guess || is_sensible(picture, i))) {
            return;
        }
    }
}

static bool find_diameters(struct picture *picture, struct error *error)
{
    const struct lens *lens = picture->one->lens;
    size_t guessed = 0;
    for (size_t i = 0; i < lens->surface_count; i++) {
        const struct surface *surface = &lens->surfaces[i];
        double y = picture->marginal[i].y, bar = picture->chief[i].y;
        picture->semi[i] = surface->has_diameter ? surface->diameter.value.hi / 2
                                                 : fabs(y) + (isfinite(bar) ? fabs(bar) : 0);
        if (!picture->is_drawn[i]) {
            continue;
        }
        if (!(picture->semi[i] > 0 && picture->semi[i] < INFINITY)) {
            fail(error, ERROR_DOMAIN, "surface %zu has no diameter, and no ray gives it one",
                 i + 1);
            return error_hint(error, "state diameters or an aperture in the file, or give -N");
        }
        guessed += !surface->has_diameter;
    }
    for (size_t i = 0; i < lens->surface_count; i++) {
        if (picture->is_drawn[i]) {
            shrink(picture, i, !lens->surfaces[i].has_diameter);
            picture->size = fmax(picture->size, picture->semi[i]);
        }
    }
    if (guessed > 0) {
        picture_note(picture,
                     arena_printf(picture->arena,
                                  "%zu of %zu surfaces have no stated diameter: theirs follow from "
                                  "the heights of the paraxial marginal and chief rays",
                                  guessed, lens->surface_count));
    }
    return true;
}

/* A cemented surface reaches to the smaller of the two outer rims, where it can. */
static void widen_cemented(struct picture *picture)
{
    for (size_t i = 1; i + 1 < picture->one->lens->surface_count; i++) {
        if (!has_element(picture, i) || !has_element(picture, i - 1)) {
            continue;
        }
        double r = fmin(picture->semi[i - 1], picture->semi[i + 1]);
        if (r > picture->semi[i] && thickness(picture, i, r) > 0 &&
            thickness(picture, i - 1, r) > 0) {
            picture->semi[i] = r;
        }
    }
}

static size_t find_glass(struct picture *picture, struct text written)
{
    const char *name = arena_string(picture->arena, written.start, written.length);
    for (size_t i = 0; i < picture->glass_count; i++) {
        if (text_same(written, picture->glasses[i])) {
            return i;
        }
    }
    picture->glasses[picture->glass_count] = name;
    return picture->glass_count++;
}

static void reach(struct picture *picture, double z)
{
    picture->left = fmin(picture->left, z);
    picture->right = fmax(picture->right, z);
}

/* Up the first surface, along the rim, down the second; flats reach out to the larger one. */
static void add_element(struct picture *picture, size_t i)
{
    double *z, *y;
    size_t count = 0;
    struct section_part *part =
        picture_part(picture, SECTION_ELEMENT, 2 * (SAMPLES + 1) + 4, &z, &y);
    double r = fmax(picture->semi[i], picture->semi[i + 1]);
    bool stepped = (edge(picture, i + 1) - edge(picture, i)) * picture->direction[i + 1] > 0;
    for (size_t side = 0; side < 2; side++) {
        size_t surface = i + side;
        double semi = picture->semi[surface], up = side == 0 ? 1 : -1;
        bool flat = stepped && semi < r;
        if (flat) {
            z[count] = edge(picture, surface);
            y[count] = -up * r;
            picture_put(picture, surface, &z[count], &y[count]);
            count++;
        }
        for (int k = 0; k <= SAMPLES; k++) {
            double h = up * semi * sin(QUARTER * (2.0 * k / SAMPLES - 1)); /* denser at the rims */
            z[count] = picture->vertex[surface] + picture_sag(picture, surface, h);
            y[count] = h;
            picture_put(picture, surface, &z[count], &y[count]);
            reach(picture, z[count++]);
        }
        if (flat) {
            z[count] = edge(picture, surface);
            y[count] = up * r;
            picture_put(picture, surface, &z[count], &y[count]);
            count++;
        }
    }
    part->count = count;
    part->glass = find_glass(picture, picture->one->lens->surfaces[i].medium.written);
}

/* The beam that comes back through a mirror's middle needs a hole there. */
static double find_hole(const struct picture *picture, size_t mirror)
{
    const size_t count = picture->one->lens->surface_count;
    double z = picture->vertex[mirror], hole = 0;
    for (size_t i = mirror + 1; i < count; i++) {
        double start = picture->vertex[i];
        double end = i + 1 < count ? picture->vertex[i + 1]
                                   : picture_rear(picture) + picture->one->first.image;
        double n = picture->one->system.index[i + 1].hi;
        if (!((z - start) * (z - end) < -1e-9)) {
            continue;
        }
        const struct paraxial_ray *y = &picture->marginal[i], *bar = &picture->chief[i];
        double height = fabs(y->y + (z - start) * y->after / n);
        double more = fabs(bar->y + (z - start) * bar->after / n);
        hole = fmax(hole, 1.3 * (height + (isfinite(more) ? more : 0)));
    }
    return picture->is_centred && hole < 0.7 * picture->semi[mirror] ? hole : 0;
}

static void add_mirror(struct picture *picture, size_t i)
{
    double semi = picture->semi[i], hole = find_hole(picture, i);
    double depth = 0.035 * picture->size;
    for (int side = -1; side <= 1; side += 2) {
        double *z, *y, *hatch_z, *hatch_y;
        picture_part(picture, SECTION_MIRROR, SAMPLES + 1, &z, &y);
        for (int k = 0; k <= SAMPLES; k++) {
            y[k] = side * (hole + (semi - hole) * k / SAMPLES);
            z[k] = picture->vertex[i] + picture_sag(picture, i, y[k]);
            picture_put(picture, i, &z[k], &y[k]);
            reach(picture, z[k]);
        }
        int strokes = (int)fmax(3, HATCHES * (semi - hole) / picture->size);
        picture_part(picture, SECTION_HATCH, 3 * (size_t)strokes, &hatch_z, &hatch_y);
        for (int k = 0; k < strokes; k++) {
            double h = side * (hole + (semi - hole) * (k + 0.5) / strokes);
            double at = picture->vertex[i] + picture_sag(picture, i, h);
            hatch_z[3 * k] = at;
            hatch_y[3 * k] = h;
            hatch_z[3 * k + 1] = at + depth * picture->direction[i];
            hatch_y[3 * k + 1] = h - 0.8 * depth;
            picture_put(picture, i, &hatch_z[3 * k], &hatch_y[3 * k]);
            picture_put(picture, i, &hatch_z[3 * k + 1], &hatch_y[3 * k + 1]);
            hatch_z[3 * k + 2] = hatch_y[3 * k + 2] = NAN;
        }
    }
}

static void add_stroke(struct picture *picture, size_t stop, double z1, double y1, double z2,
                       double y2)
{
    picture_put(picture, stop, &z1, &y1);
    picture_put(picture, stop, &z2, &y2);
    picture_line(picture, SECTION_STOP, z1, y1, z2, y2, NULL);
}

/* Its two principal planes. */
static void add_thick(struct picture *picture, size_t i)
{
    double at = picture->vertex[i], r = picture->semi[i], behind = at + picture_hiatus(picture, i);
    picture_line(picture, SECTION_PLANE, at, -r, at, r, "thick lens");
    picture_line(picture, SECTION_PLANE, behind, -r, behind, r, NULL);
    reach(picture, at);
    reach(picture, behind);
}

static void add_stop(struct picture *picture)
{
    size_t stop = picture->one->lens->stop;
    if (stop == LENS_NONE) {
        return;
    }
    double r = picture->one->first.stop_radius, tick = 0.16 * picture->size;
    r = r > 0 ? r : picture->semi[stop];
    double at = picture->vertex[stop] + picture_sag(picture, stop, r);
    if (!(r > 0 && r < INFINITY && isfinite(at))) {
        return;
    }
    for (int side = -1; side <= 1; side += 2) {
        add_stroke(picture, stop, at, side * r, at, side * (r + tick));
        add_stroke(picture, stop, at - 0.3 * tick, side * r, at + 0.3 * tick, side * r);
    }
    double y = 0;
    picture_put(picture, stop, &at, &y);
    reach(picture, at);
}

bool picture_lens(struct picture *picture, struct error *error)
{
    const struct lens *lens = picture->one->lens;
    const size_t count = lens->surface_count;
    picture->left = INFINITY;
    picture->right = -INFINITY;
    picture->glasses = ARENA_ARRAY(picture->arena, count, const char *);
    picture->vertex = ARENA_ARRAY(picture->arena, count, double);
    picture->semi = ARENA_ARRAY(picture->arena, count, double);
    picture->frames = ARENA_ARRAY(picture->arena, count, struct picture_frame);
    picture->axis = ARENA_ARRAY(picture->arena, count, struct picture_frame);
    picture->direction = ARENA_ARRAY(picture->arena, count, double);
    picture->is_drawn = ARENA_ARRAY(picture->arena, count, bool);
    find_places(picture);
    find_frames(picture);
    if (!find_diameters(picture, error)) {
        return false;
    }
    widen_cemented(picture);
    for (size_t i = 0; i < count; i++) {
        if (has_element(picture, i)) {
            add_element(picture, i);
        }
        if (lens->surfaces[i].kind == SURFACE_REFLECT) {
            add_mirror(picture, i);
        }
        if (lens->surfaces[i].kind == SURFACE_THICK) {
            add_thick(picture, i);
        }
    }
    if (!(picture->left <= picture->right)) {
        return fail(error, ERROR_DOMAIN, "nothing to draw: the lens has no glass and no mirror");
    }
    add_stop(picture);
    return true;
}
