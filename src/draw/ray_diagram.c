/* draw/ray_diagram.c - the textbook construction of an image by thin lenses or a mirror, in SVG. */
/* SPDX-License-Identifier: MIT */
#include "draw/ray_diagram.h"

#include "base/arena.h"
#include "base/error.h"
#include "draw/palette.h"
#include "draw/svg.h"

#include <math.h>

/* The page, px: the frame of the rays, and what stands below it. */
static const double WIDTH = 1000, HEIGHT = 540;
static const double LEFT = 50, RIGHT = 950, TOP = 84, BOTTOM = 400, AXIS = 242;
static const double DISTANCES = 440, NOTES = 486;

static const char *const BLACK = "#1d1d1d", *const GREY = "#666", *const GREEN = "#1a7a3c";

/* How far beyond all else, in its lengths, an image may lie that is still shown. */
static const double FARTHEST = 4;

enum { PARALLEL_RAY, CENTRAL_RAY, FOCAL_RAY, RAYS };

/* An object or image on its way: z from the first lens, height; z is infinite far away. */
struct place {
    double z, height;
    bool is_virtual;
};

struct construction {
    const struct ray_diagram *diagram;
    struct place object, images[RAY_DIAGRAM_MOST];
    double y[RAYS][RAY_DIAGRAM_MOST];     /* of the rays at each lens, mm */
    double slope[RAYS][RAY_DIAGRAM_MOST]; /* behind it, along the light */
    double first_slope[RAYS];
    bool is_drawn[RAYS];
    double left, right, top; /* mm */
    double fold;             /* behind a mirror z runs back: -1 */
    const char *unit;
    double in_unit; /* of one mm */
    struct svg *svg;
};

static double page_x(const struct construction *c, double z)
{
    return LEFT + (RIGHT - LEFT) * (z - c->left) / (c->right - c->left);
}

static double page_y(const struct construction *c, double y)
{
    return AXIS - (BOTTOM - TOP) / 2 * y / c->top;
}

/* Where a mirror meets a ray of this height, as it is drawn: bent by a few pixels; of lenses 0. */
static double mirror_z(const struct construction *c, double y)
{
    const double power = c->diagram->elements[0].power, t = y / c->top;
    const double pixel = (c->right - c->left) / (RIGHT - LEFT);
    if (!c->diagram->is_mirror || power == 0) {
        return 0;
    }
    return (power > 0 ? -16 : 16) * t * t * pixel;
}

static bool is_shown(const struct construction *c, double z)
{
    return z >= c->left && z <= c->right;
}

static const char *length_words(const struct construction *c, double length)
{
    return arena_printf(c->svg->arena, "%.4g %s", length * c->in_unit, c->unit);
}

/* -------- the construction -------- */

static void find_images(struct construction *c)
{
    const struct ray_diagram *d = c->diagram;
    struct place from = c->object;
    for (size_t i = 0; i < d->count; i++) {
        const double z = d->elements[i].z;
        const double s = i == 0 ? d->object : z - from.z; /* of an object at -inf: inf */
        const double vergence = d->elements[i].power - (isinf(s) ? 0 : 1 / s);
        struct place *image = &c->images[i];
        const double distance =
            fabs(vergence) < 1e-12 * fabs(d->elements[i].power) ? INFINITY : 1 / vergence;
        image->is_virtual = distance < 0;
        image->z = isinf(distance) ? INFINITY : z + c->fold * distance;
        const size_t k = PARALLEL_RAY; /* any would do */
        image->height = isinf(distance) ? 0 : c->y[k][i] + c->slope[k][i] * distance;
        from = *image;
        if (isinf(image->z)) {
            from.z = -INFINITY;
        }
    }
}

/* Parallel to the axis, through the centre, through the focal point in front. */
static void find_rays(struct construction *c)
{
    const struct ray_diagram *d = c->diagram;
    const double s = d->object, h = c->object.height, power = d->elements[0].power;
    const bool far = isinf(s), has_focal = power != 0 && fabs(s * power - 1) > 1e-9;
    const double y[RAYS] = {h, 0, far ? -h : -h / (s * power - 1)};
    const double slope[RAYS] = {0, far ? 0 : -h / s, far ? 0 : -h * power / (s * power - 1)};
    for (size_t k = 0; k < RAYS; k++) {
        c->first_slope[k] = slope[k];
        c->is_drawn[k] = k != FOCAL_RAY || far || has_focal;
        double at = y[k], u = slope[k];
        for (size_t i = 0; i < d->count; i++) {
            c->y[k][i] = at;
            u -= at * d->elements[i].power;
            c->slope[k][i] = u;
            at += i + 1 < d->count ? u * (d->elements[i + 1].z - d->elements[i].z) : 0;
        }
    }
}

static void reach(struct construction *c, double z)
{
    c->left = fmin(c->left, z);
    c->right = fmax(c->right, z);
}

/* What is shown: object, lenses, focal points, and images where they are not too far away. */
static void find_view(struct construction *c)
{
    const struct ray_diagram *d = c->diagram;
    c->left = c->right = 0;
    for (size_t i = 0; i < d->count; i++) {
        reach(c, d->elements[i].z);
        if (d->elements[i].power != 0) {
            reach(c, d->elements[i].z - 1 / d->elements[i].power);
            reach(c, d->elements[i].z + c->fold / d->elements[i].power);
        }
    }
    if (isfinite(c->object.z)) {
        reach(c, c->object.z);
    }
    const double span = c->right - c->left, least = c->left, most = c->right;
    c->top = fabs(c->object.height);
    for (size_t i = 0; i < d->count; i++) {
        const struct place *image = &c->images[i];
        if (image->z > least - FARTHEST * span && image->z < most + FARTHEST * span) {
            reach(c, image->z);
            c->top = fmax(c->top, fabs(image->height));
        }
    }
    for (size_t k = 0; k < RAYS; k++) { /* one that leaves the page by far is left out */
        for (size_t i = 0; i < d->count; i++) {
            c->is_drawn[k] = c->is_drawn[k] && fabs(c->y[k][i]) < 4 * c->top;
        }
    }
    for (size_t k = 0; k < RAYS; k++) {
        for (size_t i = 0; i < d->count && c->is_drawn[k]; i++) {
            c->top = fmax(c->top, fabs(c->y[k][i]));
        }
    }
    const double margin = 0.08 * (c->right - c->left);
    c->left -= margin;
    c->right += margin + (isinf(c->images[d->count - 1].z) ? 2 * margin : 0);
    c->top *= 1.25;
}

static void choose_unit(struct construction *c)
{
    const double size = c->right - c->left;
    const bool is_small = size<20, is_large = size> 5000;
    c->unit = is_small ? "mm" : "cm";
    c->in_unit = is_small ? 1 : 0.1;
    if (is_large) {
        c->unit = "m";
        c->in_unit = 1e-3;
    }
}

/* -------- the page -------- */

/* A ray from one place to another, mm, cut where it leaves the frame on the way along z. */
static void draw_ray(const struct construction *c, size_t k, bool dashed, double z0, double y0,
                     double z1, double y1)
{
    const struct svg_style style = {
        .stroke = palette_colour(k), .width = dashed ? 1.1 : 1.7, .dash = dashed ? "6 5" : NULL};
    svg_styled_line(c->svg, &style, page_x(c, z0), page_y(c, y0), page_x(c, z1), page_y(c, y1));
}

/* From the lens to where light, or its continuation, ends. */
static void draw_behind(const struct construction *c, size_t k, size_t i)
{
    const struct ray_diagram *d = c->diagram;
    const struct place *image = &c->images[i];
    const bool is_last = i + 1 == d->count;
    const double z = d->elements[i].z, y = c->y[k][i], u = c->fold * c->slope[k][i];
    const double edge = c->fold > 0 ? c->right : c->left;
    double end = is_last ? edge : d->elements[i + 1].z;
    draw_ray(c, k, false, z + mirror_z(c, y), y, end, y + u * (end - z));
    if (isinf(image->z) && is_last) { /* where the eye looks for it */
        end = c->fold > 0 ? c->left : c->right;
        draw_ray(c, k, true, z, y, end, y + u * (end - z));
    }
    const bool is_beyond = !is_last && image->z > end;
    if (isfinite(image->z) && (image->is_virtual || is_beyond)) {
        draw_ray(c, k, true, z, y, image->z, y + u * (image->z - z));
    }
}

static void draw_rays(const struct construction *c)
{
    const struct ray_diagram *d = c->diagram;
    svg_clip_begin(c->svg, LEFT - 20, TOP, RIGHT - LEFT + 40, BOTTOM - TOP);
    for (size_t k = 0; k < RAYS; k++) {
        if (!c->is_drawn[k]) {
            continue;
        }
        const double u = c->first_slope[k], y = c->y[k][0];
        const bool is_real = d->object > 0 && isfinite(d->object);
        const double start = is_real ? c->object.z : c->left;
        draw_ray(c, k, false, start, y + u * start, mirror_z(c, y), y);
        if (k == FOCAL_RAY && is_real && d->elements[0].power < 0) { /* it aims at F behind */
            const double focus = -1 / d->elements[0].power;
            draw_ray(c, k, true, 0, y, focus, y + u * focus);
        }
        if (d->object < 0) {
            draw_ray(c, k, true, 0, y, c->object.z, y + u * c->object.z);
        }
        for (size_t i = 0; i < d->count; i++) {
            draw_behind(c, k, i);
        }
    }
    svg_group_end(c->svg);
}

/* An upright arrow of the height of an object or image. */
static void draw_arrow(const struct construction *c, const struct place *place, const char *colour,
                       bool is_final, const char *words)
{
    struct svg *svg = c->svg;
    const double x = page_x(c, place->z), y = page_y(c, place->height);
    const double up = place->height < 0 ? 1 : -1, tip = fmin(11, fabs(y - AXIS));
    const struct svg_style line = {
        .stroke = colour, .width = 3, .dash = place->is_virtual ? "7 4" : NULL};
    const struct svg_style area = {.fill = colour};
    if (!is_shown(c, place->z)) {
        return;
    }
    if (place->height == 0) {
        svg_styled_circle(svg, &area, x, AXIS, 4);
    } else {
        const double xs[] = {x - tip / 2, x + tip / 2, x}, ys[] = {y - up * tip, y - up * tip, y};
        svg_styled_line(svg, &line, x, AXIS, x, y - up * tip);
        svg_styled_polygon(svg, &area, xs, ys, 3);
    }
    double label = y + (up > 0 ? 18 : -8);
    if (!is_final && place->height != 0) { /* where the last one has none */
        label = AXIS + (up > 0 ? -8 : 18);
    }
    svg_words(svg, x, label, 14, SVG_MIDDLE, colour, words);
}

/* A mirror, hollow or bulging towards the light; its back is grey. */
static void draw_mirror(const struct construction *c)
{
    enum { POINTS = 33 };
    double x[POINTS], y[POINTS];
    for (size_t i = 0; i < POINTS; i++) {
        const double t = 2.0 * (double)i / (POINTS - 1) - 1;
        x[i] = page_x(c, mirror_z(c, t * c->top));
        y[i] = AXIS + t * (BOTTOM - TOP) / 2;
    }
    svg_styled_polyline(c->svg, &(struct svg_style){.stroke = BLACK, .width = 2.5}, x, y, POINTS);
    for (size_t i = 0; i < POINTS; i++) {
        x[i] += 4;
    }
    svg_styled_polyline(c->svg, &(struct svg_style){.stroke = "#bbb", .width = 5}, x, y, POINTS);
}

/* Lines with the arrows of textbooks: outwards where it converges, inwards where not. */
static void draw_lens(const struct construction *c, const struct ray_diagram_element *lens)
{
    const struct svg_style line = {.stroke = BLACK, .width = 2};
    const double x = page_x(c, lens->z), turn = lens->power > 0 ? 10 : -10;
    svg_styled_line(c->svg, &line, x, TOP, x, BOTTOM);
    for (int end = 0; end < 2; end++) {
        const double tip = end == 0 ? TOP : BOTTOM, in = end == 0 ? turn : -turn;
        const double xs[] = {x - 8, x, x + 8}, ys[] = {tip + in, tip, tip + in};
        svg_styled_polyline(c->svg, &line, xs, ys, 3);
    }
}

static void draw_focal_points(const struct construction *c, size_t i)
{
    const struct ray_diagram_element *lens = &c->diagram->elements[i];
    struct arena *arena = c->svg->arena;
    const char *number = c->diagram->count > 1 ? arena_printf(arena, "%zu", i + 1) : "";
    if (lens->power == 0) {
        return;
    }
    for (int side = 0; side < (c->diagram->is_mirror ? 1 : 2); side++) {
        const double z = lens->z + (side == 0 ? -1 : 1) / lens->power, x = page_x(c, z);
        const char *words = arena_printf(arena, "F%s%s", number, side == 0 ? "" : "'");
        svg_styled_circle(c->svg, &(struct svg_style){.fill = GREEN}, x, AXIS, 3.5);
        svg_words(c->svg, x, AXIS + 19 + (i % 2 == 0 ? 0 : 16), 14, SVG_MIDDLE, GREEN, words);
    }
}

/* A distance from a lens, below the frame. */
static void draw_distance(const struct construction *c, double z, const struct place *place,
                          double y, const char *words)
{
    if (!is_shown(c, place->z)) {
        return;
    }
    const double a = page_x(c, z), b = page_x(c, place->z);
    svg_scale_bar(c->svg, GREY, fmin(a, b), fmax(a, b), y);
    svg_words(c->svg, (a + b) / 2, y - 7, 13, SVG_MIDDLE, BLACK, words);
}

static void draw_axis(const struct construction *c)
{
    const struct svg_style axis = {.stroke = GREY, .width = 1, .dash = "14 4 3 4"};
    svg_styled_line(c->svg, &axis, LEFT - 20, AXIS, RIGHT + 20, AXIS);
}

/* "image: virtual, upright, 0.6 times as large, 6 cm in front of the lens". */
static const char *image_words(const struct construction *c)
{
    const struct ray_diagram *d = c->diagram;
    struct arena *arena = c->svg->arena;
    const struct place *image = &c->images[d->count - 1];
    if (isinf(image->z)) {
        return "image at infinity: the rays leave parallel";
    }
    const char *kind = image->is_virtual ? "virtual" : "real";
    if (image->height == 0) {
        return arena_printf(arena, "image: %s, a point", kind);
    }
    const double m = image->height / c->object.height;
    const char *size = d->has_height ? arena_printf(arena, ", %s high instead of %s",
                                                    length_words(c, fabs(image->height)),
                                                    length_words(c, fabs(c->object.height)))
                                     : "";
    return arena_printf(arena, "image: %s, %s, %.4g times as large%s%s", kind,
                        m > 0 ? "upright" : "inverted", fabs(m), size,
                        is_shown(c, image->z) ? "" : "; it lies beyond the drawing");
}

static void draw_notes(const struct construction *c)
{
    static const char *const names[] = {"parallel ray", "central ray", "focal ray"};
    const struct ray_diagram *d = c->diagram;
    struct svg *svg = c->svg;
    double x = LEFT;
    for (size_t k = 0; k < RAYS && isfinite(d->object); k++) {
        if (c->is_drawn[k]) {
            const struct svg_style style = {.stroke = palette_colour(k), .width = 2};
            svg_styled_line(svg, &style, x, NOTES - 5, x + 26, NOTES - 5);
            svg_words(svg, x + 33, NOTES, 13, SVG_START, BLACK, names[k]);
            x += 150;
        }
    }
    svg_words(svg, x, NOTES, 13, SVG_START, GREY,
              "dashed: no light, lines drawn on; heights are not to the scale of distances");
    svg_words(svg, LEFT, NOTES + 24, 13, SVG_START, BLACK, image_words(c));
}

static void draw_page(const struct construction *c)
{
    const struct ray_diagram *d = c->diagram;
    struct arena *arena = c->svg->arena;
    const struct place *image = &c->images[d->count - 1];
    const char *focal = "";
    for (size_t i = 0; i < d->count && d->elements[i].power != 0; i++) {
        const char *number = d->count > 1 ? arena_printf(arena, "%zu", i + 1) : "";
        focal = arena_printf(arena, "%s%sf%s = %s", focal, i > 0 ? ", " : "", number,
                             length_words(c, 1 / d->elements[i].power));
    }
    svg_begin(c->svg, WIDTH, HEIGHT, d->title);
    const struct svg_label title = {.x = WIDTH / 2,
                                    .y = 34,
                                    .size = 18,
                                    .width = WIDTH - 40,
                                    .anchor = SVG_MIDDLE,
                                    .bold = true};
    const struct svg_label below = {.x = WIDTH / 2,
                                    .y = 58,
                                    .size = 14,
                                    .width = WIDTH - 40,
                                    .anchor = SVG_MIDDLE,
                                    .colour = GREY};
    svg_title(c->svg, &title, d->title);
    svg_subtitle(c->svg, &below, focal);
    draw_axis(c);
    draw_rays(c);
    for (size_t i = 0; i < d->count; i++) {
        if (d->is_mirror) {
            draw_mirror(c);
        } else {
            draw_lens(c, &d->elements[i]);
        }
        draw_focal_points(c, i);
        if (i + 1 < d->count) {
            draw_arrow(c, &c->images[i], GREY, false, arena_printf(arena, "image %zu", i + 1));
            const struct place next = {.z = d->elements[i + 1].z};
            draw_distance(c, d->elements[i].z, &next, DISTANCES - 24,
                          length_words(c, next.z - d->elements[i].z));
        }
    }
    if (isfinite(d->object)) {
        draw_arrow(c, &c->object, BLACK, true, "object");
        draw_distance(c, 0, &c->object, DISTANCES,
                      arena_printf(arena, "s = %s", length_words(c, d->object)));
    }
    draw_arrow(c, image, "#0060a0", true, "image");
    const double z = d->elements[d->count - 1].z;
    const bool is_apart = d->count == 1 && d->object > 0 && (image->z > 0) && !d->is_mirror;
    draw_distance(c, z, image, is_apart ? DISTANCES : DISTANCES + 22,
                  arena_printf(arena, "s' = %s", length_words(c, c->fold * (image->z - z))));
    draw_notes(c);
    svg_end(c->svg);
}

bool ray_diagram_draw(const struct ray_diagram *diagram, struct svg *svg, struct error *error)
{
    struct construction c = {.diagram = diagram, .fold = diagram->is_mirror ? -1 : 1, .svg = svg};
    if (diagram->object == 0) {
        return fail(error, ERROR_DOMAIN, "nothing to construct: the object lies in the lens");
    }
    c.object = (struct place){-diagram->object, diagram->height, diagram->object < 0};
    find_rays(&c);
    find_images(&c);
    find_view(&c);
    choose_unit(&c);
    draw_page(&c);
    return true;
}
