/* optics/aperture.c - circles, rings, rectangles, ellipses, polygons and spiders. */
/* SPDX-License-Identifier: MIT */
#include "optics/aperture.h"

#include "base/constants.h"

#include <math.h>
#include <stdlib.h>

/* -------- how far beyond the edge, and which piece of it -------- */

static size_t one_part(const struct aperture_form *form, double x, double y)
{
    (void)form;
    (void)x;
    (void)y;
    return 0;
}

static double ellipse_excess(const struct aperture_form *form, double x, double y)
{
    double u = x / form->half[0], v = y / form->half[1];
    return u * u + v * v - 1;
}

/* half[0] is the inner radius. */
static double ring_excess(const struct aperture_form *form, double x, double y)
{
    double r2 = x * x + y * y, inner = form->half[0], outer = form->half[1];
    double beyond = r2 / (outer * outer) - 1, within = 1 - r2 / (inner * inner);
    return beyond > within ? beyond : within;
}

static size_t ring_part(const struct aperture_form *form, double x, double y)
{
    return x * x + y * y > form->half[0] * form->half[1] ? 0u : 1u;
}

static double rectangle_excess(const struct aperture_form *form, double x, double y)
{
    double u = fabs(x) / form->half[0], v = fabs(y) / form->half[1];
    return (u > v ? u : v) - 1;
}

static size_t rectangle_part(const struct aperture_form *form, double x, double y)
{
    if (fabs(x) / form->half[0] > fabs(y) / form->half[1]) {
        return x > 0 ? 0 : 2;
    }
    return y > 0 ? 1 : 3;
}

/* Squared distance from the side that begins at a corner. */
static double from_side(const struct aperture_form *form, size_t i, double x, double y)
{
    const double *p = form->points[i], *q = form->points[(i + 1) % form->point_count];
    double dx = q[0] - p[0], dy = q[1] - p[1], length2 = dx * dx + dy * dy;
    double along = (x - p[0]) * dx + (y - p[1]) * dy;
    double share = length2 > 0 ? along / length2 : 0;
    if (share < 0) {
        share = 0;
    } else if (share > 1) {
        share = 1;
    }
    double ex = x - p[0] - share * dx, ey = y - p[1] - share * dy;
    return ex * ex + ey * ey;
}

static bool is_seam(const struct aperture_form *form, size_t side)
{
    return form->seams != NULL && form->seams[side];
}

static size_t polygon_part(const struct aperture_form *form, double x, double y)
{
    size_t nearest = 0;
    double least = INFINITY;
    for (size_t i = 0; i < form->point_count; i++) {
        double distance = from_side(form, i, x, y);
        if (distance < least && !is_seam(form, i)) {
            least = distance;
            nearest = i;
        }
    }
    return nearest;
}

/* Inside where a line from the point crosses the sides an odd number of times. */
static double polygon_excess(const struct aperture_form *form, double x, double y)
{
    bool inside = false;
    double least = INFINITY;
    for (size_t i = 0; i < form->point_count; i++) {
        const double *p = form->points[i], *q = form->points[(i + 1) % form->point_count];
        double distance = from_side(form, i, x, y);
        least = distance < least && !is_seam(form, i) ? distance : least;
        if ((p[1] > y) != (q[1] > y)) {
            double cross = (q[0] - p[0]) * (y - p[1]) - (x - p[0]) * (q[1] - p[1]);
            inside = inside != (q[1] > p[1] ? cross > 0 : cross < 0);
        }
    }
    double relative = sqrt(least) / form->radius;
    if (isnan(x) || isnan(y)) {
        return (double)NAN;
    }
    return inside ? -relative : relative;
}

/* Beyond one arm, mm: across it, or behind the centre where it begins. */
static double beyond_arm(const struct aperture_form *form, size_t arm, double x, double y)
{
    const double *way = form->points[arm];
    double behind = -(x * way[0] + y * way[1]);
    double across = fabs(y * way[0] - x * way[1]) - form->half[0];
    return across > behind ? across : behind;
}

static size_t nearest_arm(const struct aperture_form *form, double x, double y)
{
    size_t best = 0;
    for (size_t i = 1; i < form->point_count; i++) {
        best = beyond_arm(form, i, x, y) < beyond_arm(form, best, x, y) ? i : best;
    }
    return best;
}

static double spider_excess(const struct aperture_form *form, double x, double y)
{
    return beyond_arm(form, nearest_arm(form, x, y), x, y) / form->half[0];
}

/* Of each arm one side, the other, and its beginning. */
static size_t spider_part(const struct aperture_form *form, double x, double y)
{
    size_t arm = nearest_arm(form, x, y);
    const double *way = form->points[arm];
    double side = y * way[0] - x * way[1], behind = -(x * way[0] + y * way[1]);
    size_t own = side > 0 ? 1 : 0;
    return 3 * arm + (fabs(side) - form->half[0] < behind ? 2 : own);
}

const struct aperture_traits aperture_shapes[APERTURE_SHAPES] = {
    [SHAPE_CIRCLE] = {.word = "circle",
                      .sizes = {"diameter"},
                      .excess = ellipse_excess,
                      .part = one_part},
    [SHAPE_RING] = {.word = "ring",
                    .sizes = {"inner diameter", "outer diameter"},
                    .excess = ring_excess,
                    .part = ring_part},
    [SHAPE_RECTANGLE] = {.word = "rectangle",
                         .sizes = {"width along x", "width along y"},
                         .excess = rectangle_excess,
                         .part = rectangle_part},
    [SHAPE_ELLIPSE] = {.word = "ellipse",
                       .sizes = {"width along x", "width along y"},
                       .excess = ellipse_excess,
                       .part = one_part},
    [SHAPE_POLYGON] = {.word = "polygon",
                       .has_points = true,
                       .excess = polygon_excess,
                       .part = polygon_part},
    [SHAPE_SPIDER] = {.word = "spider",
                      .sizes = {"width of an arm"},
                      .has_arms = true,
                      .only_blocks = true,
                      .excess = spider_excess,
                      .part = spider_part}};

int aperture_sizes(enum aperture_shape shape)
{
    const char *const *sizes = aperture_shapes[shape].sizes;
    return (sizes[0] != NULL) + (sizes[1] != NULL);
}

/* -------- soundness -------- */

static bool aperture_is_sound(const struct figure *figure)
{
    return fabs(figure->value.hi) < 1e100;
}

static double aperture_at(const struct figure *point, int axis)
{
    return point[axis].value.hi;
}

/* Is `c` to the left of the line from `a` to `b` (1), to its right (-1), on it? */
static int aperture_side_of(const struct figure *a, const struct figure *b, const struct figure *c)
{
    const double left =
        (aperture_at(b, 0) - aperture_at(a, 0)) * (aperture_at(c, 1) - aperture_at(a, 1));
    const double right =
        (aperture_at(b, 1) - aperture_at(a, 1)) * (aperture_at(c, 0) - aperture_at(a, 0));
    return (left > right) - (left < right);
}

/* How often do sides cross within both, up to one more than `most`? */
static size_t aperture_crossings(const struct aperture *aperture, size_t most)
{
    const size_t count = aperture->point_count;
    size_t found = 0;
    for (size_t i = 0; i < count; i++) {
        for (size_t j = i + 2; j < count && found <= most; j++) {
            const struct figure *const pair[] = {aperture->points[i], aperture->points[i + 1],
                                                 aperture->points[j],
                                                 aperture->points[(j + 1) % count]};
            found += aperture_side_of(pair[0], pair[1], pair[2]) *
                             aperture_side_of(pair[0], pair[1], pair[3]) <
                         0 &&
                     aperture_side_of(pair[2], pair[3], pair[0]) *
                             aperture_side_of(pair[2], pair[3], pair[1]) <
                         0;
        }
    }
    return found;
}

static bool aperture_check_points(const struct aperture *aperture, struct error *error)
{
    bool sound = true;
    for (size_t i = 0; i < aperture->point_count; i++) {
        sound = sound && aperture_is_sound(&aperture->points[i][0]) &&
                aperture_is_sound(&aperture->points[i][1]);
    }
    if (!sound) {
        return fail(error, ERROR_DATA, "a polygon with a corner beyond 1e100");
    }
    if (aperture->point_count < 3) {
        return fail(error, ERROR_DATA, "a polygon has three corners and more");
    }
    if (aperture->point_count > APERTURE_MOST_CORNERS) {
        return fail(error, ERROR_DATA, "a polygon of %zu corners: it may have up to %d",
                    aperture->point_count, APERTURE_MOST_CORNERS);
    }
    /* Twice the area inside, by the corners. */
    double sum = 0;
    for (size_t i = 0; i < aperture->point_count; i++) {
        const struct figure *p = aperture->points[i];
        const struct figure *q = aperture->points[(i + 1) % aperture->point_count];
        sum += p[0].value.hi * q[1].value.hi - q[0].value.hi * p[1].value.hi;
    }
    const size_t crossings = aperture_crossings(aperture, APERTURE_MOST_CROSSINGS);
    if (!(fabs(sum) > 0) && crossings == 0) { /* else its parts have it, gone round either way */
        return fail(error, ERROR_DATA, "a polygon without any area");
    }
    return crossings <= APERTURE_MOST_CROSSINGS ||
           fail(error, ERROR_DATA, "a polygon whose sides cross each other more than %d times",
                APERTURE_MOST_CROSSINGS);
}

bool aperture_check(const struct aperture *aperture, struct error *error)
{
    const struct aperture_traits *traits = &aperture_shapes[aperture->shape];
    if (traits->only_blocks && !aperture->blocks) {
        return fail(error, ERROR_DATA, "a %s blocks light: it lets none pass", traits->word);
    }
    for (int i = 0; i < aperture_sizes(aperture->shape); i++) {
        double size = aperture->size[i].value.hi;
        if (!(size > 0 && size < 1e100)) {
            return fail(error, ERROR_DATA, "the %s of the %s must be above 0, and is %.6g",
                        traits->sizes[i], traits->word, size);
        }
    }
    if (aperture->shape == SHAPE_RING &&
        !(aperture->size[0].value.hi < aperture->size[1].value.hi)) {
        return fail(error, ERROR_DATA,
                    "the inner diameter of a ring, %.6g mm, is not below the "
                    "outer, %.6g mm",
                    aperture->size[0].value.hi, aperture->size[1].value.hi);
    }
    if (traits->has_arms && !(aperture->arms >= 1 && aperture->arms <= APERTURE_MOST_ARMS)) {
        return fail(error, ERROR_DATA, "a %s has 1 to %d arms", traits->word, APERTURE_MOST_ARMS);
    }
    if (!aperture_is_sound(&aperture->decenter[0]) || !aperture_is_sound(&aperture->decenter[1]) ||
        !aperture_is_sound(&aperture->turn)) {
        return fail(error, ERROR_DATA, "a decentre or turn beyond 1e100");
    }
    return !traits->has_points || aperture_check_points(aperture, error);
}

bool aperture_is_round(const struct aperture *aperture)
{
    bool centred = aperture->decenter[0].value.hi == 0 && aperture->decenter[1].value.hi == 0;
    return centred && (aperture->shape == SHAPE_CIRCLE || aperture->shape == SHAPE_RING);
}

struct aperture aperture_of(enum aperture_shape shape, bool blocks)
{
    const struct figure none = {.variable = LENS_NONE};
    return (struct aperture){.shape = shape,
                             .blocks = blocks,
                             .size = {none, none},
                             .decenter = {none, none},
                             .turn = none};
}

/* -------- numbers -------- */

/* Quarters of a turn exactly. */
static void aperture_turn_of(double angle, double *cosine, double *sine)
{
    static const double quarter[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    double quarters = angle / (PI / 2), nearest = rint(quarters);
    *cosine = cos(angle);
    *sine = sin(angle);
    if (fabs(quarters - nearest) <= 1e-15 * fabs(quarters)) {
        int k = (int)(fmod(fmod(nearest, 4) + 4, 4));
        *cosine = quarter[k][0];
        *sine = quarter[k][1];
    }
}

/* Where the arms of a spider point to. */
static const double (*arms_of(unsigned count, struct arena *arena))[2]
{
    double(*ways)[2] = arena_array(arena, count, sizeof *ways);
    for (unsigned i = 0; i < count; i++) {
        aperture_turn_of(2 * PI * (double)i / count, &ways[i][0], &ways[i][1]);
    }
    return (const double(*)[2])ways;
}

/* No point of it is farther from its centre, mm. */
static double aperture_radius_of(const struct aperture *aperture)
{
    double a = aperture->size[0].value.hi / 2, b = aperture->size[1].value.hi / 2;
    if (aperture->shape == SHAPE_SPIDER) {
        return INFINITY;
    }
    double radius = aperture->shape == SHAPE_RECTANGLE ? hypot(a, b) : fmax(a, b);
    for (size_t i = 0; i < aperture->point_count; i++) {
        const struct figure *point = aperture->points[i];
        radius = fmax(radius, hypot(point[0].value.hi, point[1].value.hi));
    }
    return radius;
}

double aperture_reach(const struct surface *surface)
{
    double reach = surface->has_diameter ? surface->diameter.value.hi / 2 : (double)INFINITY;
    for (size_t i = 0; i < surface->aperture_count; i++) {
        const struct aperture *aperture = &surface->apertures[i];
        const struct figure *centre = aperture->decenter;
        if (!aperture->blocks) {
            reach = fmin(reach, hypot(centre[0].value.hi, centre[1].value.hi) +
                                    aperture_radius_of(aperture));
        }
    }
    return reach;
}

/* A side of a polygon, whichever way it is gone along. */
struct polygon_side {
    double low[2], high[2]; /* its ends in the order of compare_points */
    size_t number;
};

static int compare_points(const void *a, const void *b)
{
    const double *p = a, *q = b;
    int by_x = (p[0] > q[0]) - (p[0] < q[0]);
    return by_x != 0 ? by_x : (p[1] > q[1]) - (p[1] < q[1]);
}

static int compare_sides(const void *a, const void *b)
{
    const struct polygon_side *p = a, *q = b;
    const int by_low = compare_points(p->low, q->low);
    return by_low != 0 ? by_low : compare_points(p->high, q->high);
}

/* Sides that are gone along an even number of times: both sides of them are inside, or outside. */
static const bool *seams_of(const struct aperture_form *form, struct arena *arena)
{
    const size_t count = form->point_count;
    struct polygon_side *sides = ARENA_ARRAY(arena, count, struct polygon_side);
    bool *seams = NULL;
    for (size_t i = 0; i < count; i++) {
        const double *p = form->points[i], *q = form->points[(i + 1) % count];
        const bool upwards = compare_points(p, q) <= 0;
        const double *low = upwards ? p : q, *high = upwards ? q : p;
        sides[i] = (struct polygon_side){{low[0], low[1]}, {high[0], high[1]}, i};
    }
    qsort(sides, count, sizeof sides[0], compare_sides);
    for (size_t i = 0, end; i < count; i = end) {
        for (end = i + 1; end < count && compare_sides(&sides[i], &sides[end]) == 0; end++) {
        }
        if ((end - i) % 2 == 0) {
            seams = seams != NULL ? seams : ARENA_ARRAY(arena, count, bool);
            for (size_t k = i; k < end; k++) {
                seams[sides[k].number] = true;
            }
        }
    }
    return seams;
}

struct aperture_form aperture_form_of(const struct aperture *aperture, struct arena *arena)
{
    struct aperture_form form = {.shape = aperture->shape, .blocks = aperture->blocks};
    for (int i = 0; i < 2; i++) {
        form.half[i] = aperture->size[i].value.hi / 2;
        form.centre[i] = aperture->decenter[i].value.hi;
    }
    aperture_turn_of(aperture->turn.value.hi, &form.cosine, &form.sine);
    form.radius = aperture_radius_of(aperture);
    if (aperture->shape == SHAPE_CIRCLE) {
        form.half[1] = form.half[0];
    } else if (aperture->shape == SHAPE_SPIDER) {
        form.points = arms_of(aperture->arms, arena);
        form.point_count = aperture->arms;
    } else if (aperture->shape == SHAPE_POLYGON) {
        double(*points)[2] = arena_array(arena, aperture->point_count, sizeof *points);
        form.points = (const double(*)[2])points;
        form.point_count = aperture->point_count;
        for (size_t i = 0; i < aperture->point_count; i++) {
            points[i][0] = aperture->points[i][0].value.hi;
            points[i][1] = aperture->points[i][1].value.hi;
        }
        form.seams = seams_of(&form, arena);
        /* a little less and more: what is as near to an edge as rounding is decided by the edge */
        const double depth = -polygon_excess(&form, 0, 0);
        form.within2 = depth > 0 ? pow(depth * form.radius, 2) * (1 - 1e-9) : 0;
        form.beyond2 = form.radius * form.radius * (1 + 1e-9);
    }
    return form;
}

/* Is q no corner between p and r, going round counterclockwise? */
static bool turns_back(const double p[2], const double q[2], const double r[2])
{
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]) <= 0;
}

/* One chain of the hull more; sorted points, from the left or from the right. */
static size_t add_chain(const double (*points)[2], size_t count, bool backwards, double (*hull)[2],
                        size_t used)
{
    size_t first = used;
    for (size_t k = 0; k < count; k++) {
        const double *point = points[backwards ? count - 1 - k : k];
        while (used >= first + 2 && turns_back(hull[used - 2], hull[used - 1], point)) {
            used--;
        }
        hull[used][0] = point[0];
        hull[used++][1] = point[1];
    }
    return used - 1; /* where the other chain begins */
}

struct aperture_form aperture_hull(const struct aperture *aperture, struct arena *arena)
{
    struct aperture_form form = aperture_form_of(aperture, arena);
    if (aperture->shape == SHAPE_RING) {
        form.shape = SHAPE_CIRCLE;
        form.half[0] = form.half[1];
    } else if (aperture->shape == SHAPE_POLYGON) {
        double(*points)[2] = arena_array(arena, form.point_count, sizeof *points);
        double(*hull)[2] = arena_array(arena, 2 * form.point_count, sizeof *hull);
        for (size_t i = 0; i < form.point_count; i++) {
            points[i][0] = form.points[i][0];
            points[i][1] = form.points[i][1];
        }
        qsort(points, form.point_count, sizeof *points, compare_points);
        size_t count = add_chain((const double(*)[2])points, form.point_count, false, hull, 0);
        form.point_count =
            add_chain((const double(*)[2])points, form.point_count, true, hull, count);
        form.points = (const double(*)[2])hull;
        form.seams = NULL;
    }
    return form;
}

/* From the vertex to the centre, unturned. */
static void aperture_to_own(const struct aperture_form *form, double *x, double *y)
{
    double dx = *x - form->centre[0], dy = *y - form->centre[1];
    *x = form->cosine * dx + form->sine * dy;
    *y = form->cosine * dy - form->sine * dx;
}

double aperture_excess(const struct aperture_form *form, double x, double y)
{
    aperture_to_own(form, &x, &y);
    return aperture_shapes[form->shape].excess(form, x, y);
}

size_t aperture_part(const struct aperture_form *form, double x, double y)
{
    aperture_to_own(form, &x, &y);
    return aperture_shapes[form->shape].part(form, x, y);
}
