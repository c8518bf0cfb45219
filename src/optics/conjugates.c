/* optics/conjugates.c - object and image of a lens, in any media. */
/* SPDX-License-Identifier: MIT */
#include "optics/conjugates.h"

#include <math.h>

static const double NOTHING = 8.077935669463161e-28; /* 2^-90: rounding of pairs */
static const double LIMIT = 1e-14;                   /* how near the least distance counts as it */

/* A system with what is asked of it again and again. */
struct optics {
    struct pair a, b, c, d;     /* the whole */
    struct pair a1, b1, b2, d2; /* the part before the stop, and what follows for the rest */
    struct pair n, n_image, length;
    bool is_afocal, has_stop;
};

static struct optics optics_of(const struct paraxial_system *system,
                               const struct paraxial_trace *trace)
{
    const struct paraxial_matrix *m = &trace->whole, *front = &trace->front;
    return (struct optics){
        .a = m->a,
        .b = m->b,
        .c = m->c,
        .d = m->d,
        .a1 = front->a,
        .b1 = front->b,
        .b2 = trace->rear.b,
        .d2 = trace->rear.d,
        .n = system->index[0],
        .n_image = system->index[system->count],
        .length = pair_of(system->length),
        .is_afocal = paraxial_is_afocal(system, trace),
        .has_stop = system->stop != LENS_NONE,
    };
}

/* a x + b y, 0 where the two cancel to rounding. */
static struct pair conjugates_combine(struct pair a, struct pair x, struct pair b, struct pair y)
{
    struct pair first = pair_multiply(a, x), second = pair_multiply(b, y);
    struct pair sum = pair_add(first, second);
    return fabs(sum.hi) <= NOTHING * (fabs(first.hi) + fabs(second.hi)) ? pair_of(0) : sum;
}

static struct conjugate_ray backwards(const struct optics *o, struct conjugate_ray image)
{
    return (struct conjugate_ray){conjugates_combine(o->d, image.y, pair_negate(o->b), image.v),
                                  conjugates_combine(pair_negate(o->c), image.y, o->a, image.v)};
}

static bool check_reference(const struct optics *o, enum conjugate_from from, bool is_image,
                            struct error *error)
{
    bool cardinal = from == CONJUGATE_FROM_PRINCIPAL || from == CONJUGATE_FROM_FOCAL;
    if (cardinal && o->is_afocal) {
        fail(error, ERROR_DOMAIN, "an afocal system has no principal or focal points");
        return error_hint(error, "measure from the vertex: {distance origin} front");
    }
    if (from != CONJUGATE_FROM_ENTRANCE) {
        return true;
    }
    if (!o->has_stop) {
        return fail(error, ERROR_DOMAIN, "without a stop there is no pupil to measure from");
    }
    return (is_image ? o->d2.hi : o->a1.hi) != 0 ||
           fail(error, ERROR_DOMAIN, "the %s pupil is infinitely far",
                is_image ? "exit" : "entrance");
}

/*
 * The ray through a point s to the left of a point at -n y/v: multiplied by v, so that nothing is
 * divided. Behind the lens likewise, for an image s to the right.
 */
static struct conjugate_ray ray_of_place(const struct optics *o, enum conjugate_from from, double s,
                                         bool is_image)
{
    const struct pair reduced = pair_divide(pair_of(s), is_image ? o->n_image : o->n);
    const struct pair one = pair_of(1), d = is_image ? o->a : o->d;
    const struct pair b1 = is_image ? o->b2 : o->b1, a1 = is_image ? o->d2 : o->a1;
    struct conjugate_ray ray = {reduced, one};
    if (isinf(s)) {
        return (struct conjugate_ray){one, pair_of(0)};
    }
    if (from == CONJUGATE_FROM_PRINCIPAL) {
        ray.y = pair_add(pair_multiply(reduced, o->c), pair_subtract(one, d));
        ray.v = o->c;
    } else if (from == CONJUGATE_FROM_FOCAL) {
        ray.y = pair_subtract(pair_multiply(reduced, o->c), d);
        ray.v = o->c;
    } else if (from == CONJUGATE_FROM_ENTRANCE) {
        ray.y = pair_subtract(pair_multiply(reduced, a1), pair_multiply(b1, one));
        ray.v = a1;
    }
    ray.y = is_image ? pair_negate(ray.y) : ray.y;
    return ray;
}

static struct conjugate_ray ray_of_magnification(const struct optics *o, struct pair m)
{
    return (struct conjugate_ray){pair_subtract(pair_of(1), pair_multiply(o->d, m)),
                                  pair_multiply(o->c, m)};
}

/* n' m^2 - k m + n = 0 */
static size_t find_by_total(const struct optics *o, double total, struct conjugate_ray rays[2],
                            struct error *error)
{
    struct pair rest = pair_subtract(pair_of(total), o->length);
    if (isinf(total)) {
        rays[0] = (struct conjugate_ray){pair_of(1), pair_of(0)};
        return 1;
    }
    if (o->is_afocal) {
        struct conjugate_ray *ray = &rays[0];
        struct pair slope =
            pair_subtract(o->n, pair_multiply(o->n_image, pair_multiply(o->a, o->a)));
        struct pair right = pair_add(rest, pair_multiply(o->n_image, pair_multiply(o->a, o->b)));
        if (fabs(slope.hi) <= NOTHING * fabs(o->n.hi)) {
            fail(
                error, ERROR_DOMAIN,
                "this afocal system has the same distance from object to image, %.10g mm, wherever "
                "the object is",
                pair_subtract(o->length, pair_multiply(o->n_image, pair_multiply(o->a, o->b))).hi);
            return 0;
        }
        *ray = (struct conjugate_ray){right, slope};
        return 1;
    }
    struct pair k = pair_add(pair_multiply(o->n_image, o->a), pair_multiply(o->n, o->d));
    struct pair fixed = k;
    k = pair_add(k, pair_multiply(o->c, rest));
    struct pair four = pair_multiply(pair_of(4), pair_multiply(o->n, o->n_image));
    struct pair square = pair_multiply(k, k), inside = pair_subtract(square, four);
    if (inside.hi < 0 && inside.hi >= -LIMIT * square.hi) {
        inside = pair_of(0);
    }
    if (inside.hi < 0) {
        double swing = sqrt(four.hi);
        double one = (swing - fixed.hi) / o->c.hi + o->length.hi;
        double other = (-swing - fixed.hi) / o->c.hi + o->length.hi;
        fail(error, ERROR_DOMAIN,
             "no image is %.10g mm from its object: the distance must be %.10g mm or less, or "
             "%.10g mm or more",
             total, fmin(one, other), fmax(one, other));
        return 0;
    }
    struct pair swing = inside.hi > 0 ? pair_root(inside) : pair_of(0);
    struct pair q =
        pair_divide(k.hi < 0 ? pair_subtract(k, swing) : pair_add(k, swing), pair_of(2));
    struct pair large = pair_divide(q, o->n_image), small = pair_divide(o->n, q);
    rays[0] = ray_of_magnification(o, small);
    rays[1] = ray_of_magnification(o, large);
    return inside.hi > 0 ? 2 : 1;
}

size_t conjugate_find(const struct paraxial_system *system, const struct paraxial_trace *trace,
                      const struct conjugate_question *question, struct conjugate_ray rays[2],
                      struct error *error)
{
    const struct optics o = optics_of(system, trace);
    bool is_image = question->asked == CONJUGATE_IMAGE;
    if (question->asked == CONJUGATE_MAGNIFICATION) {
        if (o.is_afocal) {
            fail(error, ERROR_DOMAIN,
                 "an afocal system has the magnification %.10g wherever the object is", o.a.hi);
            return 0;
        }
        rays[0] = isinf(question->magnification)
                      ? (struct conjugate_ray){pair_negate(o.d), o.c}
                      : ray_of_magnification(&o, pair_of(question->magnification));
        return 1;
    }
    if (question->from == CONJUGATE_FROM_SENSOR) {
        return find_by_total(&o, question->distance, rays, error);
    }
    if (!isinf(question->distance) && !check_reference(&o, question->from, is_image, error)) {
        return 0;
    }
    rays[0] = ray_of_place(&o, question->from, question->distance, is_image);
    rays[0] = is_image ? backwards(&o, rays[0]) : rays[0];
    return 1;
}

static double quotient(struct pair a, struct pair b)
{
    return b.hi == 0 ? INFINITY : pair_divide(a, b).hi + 0.0;
}

/* Object and image on the scale of reduced lengths; infinite ones stay infinite. */
static void set_places(const struct optics *o, struct pair x, struct pair x_image,
                       struct conjugate_points *all)
{
    struct pair one = pair_of(1), n = o->n, n_image = o->n_image;
    all->object = pair_multiply(n, x).hi + 0.0;
    all->image = pair_multiply(n_image, x_image).hi + 0.0;
    all->object_principal = all->object_focal = all->image_principal = all->image_focal = INFINITY;
    if (!o->is_afocal) {
        struct pair h = pair_divide(pair_subtract(one, o->d), o->c);
        struct pair h_image = pair_divide(pair_subtract(one, o->a), o->c);
        all->object_principal = pair_multiply(n, pair_subtract(x, h)).hi + 0.0;
        all->object_focal = pair_multiply(n, pair_add(x, pair_divide(o->d, o->c))).hi + 0.0;
        all->image_principal = pair_multiply(n_image, pair_subtract(x_image, h_image)).hi + 0.0;
        all->image_focal =
            pair_multiply(n_image, pair_add(x_image, pair_divide(o->a, o->c))).hi + 0.0;
    }
    all->object_pupil = all->image_pupil = o->has_stop ? INFINITY : NAN;
    if (o->has_stop && o->a1.hi != 0) {
        all->object_pupil = pair_multiply(n, pair_add(x, pair_divide(o->b1, o->a1))).hi + 0.0;
    }
    if (o->has_stop && o->d2.hi != 0) {
        all->image_pupil =
            pair_multiply(n_image, pair_add(x_image, pair_divide(o->b2, o->d2))).hi + 0.0;
    }
    all->total =
        pair_add(pair_add(pair_multiply(n, x), o->length), pair_multiply(n_image, x_image)).hi +
        0.0;
}

void conjugate_compute(const struct paraxial_system *system, const struct paraxial_trace *trace,
                       const struct conjugate_ray *ray, struct conjugate_points *points)
{
    const struct optics o = optics_of(system, trace);
    struct pair y = conjugates_combine(o.a, ray->y, o.b, ray->v),
                v = conjugates_combine(o.c, ray->y, o.d, ray->v);
    if (o.is_afocal) {
        v = pair_multiply(o.d, ray->v);
    }
    bool far_object = ray->v.hi == 0, far_image = v.hi == 0;
    struct pair x = far_object ? pair_of(0) : pair_divide(ray->y, ray->v);
    struct pair x_image = far_image ? pair_of(0) : pair_negate(pair_divide(y, v));
    double signed_n = o.n.hi / o.n_image.hi;
    set_places(&o, x, x_image, points);
    if (far_object) {
        points->object = points->object_principal = points->object_focal = INFINITY;
        points->object_pupil += INFINITY; /* NaN stays absent */
        points->total = INFINITY;
    }
    if (far_image) {
        points->image = points->image_principal = points->image_focal = INFINITY;
        points->image_pupil += INFINITY;
        points->total = INFINITY;
    }
    points->magnification = o.is_afocal ? o.a.hi : quotient(ray->v, v);
    points->angular = o.is_afocal ? signed_n * o.d.hi : signed_n * quotient(v, ray->v);
    points->longitudinal = points->magnification * points->magnification / signed_n;
    /* light travels back after an odd number of mirrors */
    points->object_is_virtual = points->object * o.n.hi < 0;
    points->image_is_virtual = points->image * o.n_image.hi < 0;
}
