/* optics/fifth_order.c - fifth-order aberrations (Buchdahl), surface by surface. */
/* SPDX-License-Identifier: MIT */
#include "optics/fifth_order.h"

#include <math.h>

/*
 * A series in the invariants a = P.P, b = P.H, c = H.H of the relative pupil point P and the
 * relative field H, up to their second power: 1, a, b, c, aa, ab, ac, bb, bc, cc.
 */
enum { MONOMIALS = 10 };

struct series {
    double of[MONOMIALS];
};

/* A vector across the axis: pupil P + field H. */
struct series_vector {
    struct series pupil, field;
};

/* z = f[0] s + f[1] s^2 + f[2] s^3, s = r^2 */
struct profile {
    double f[3];
};

/* A ray in the plane of a vertex: height, and slope (tangent) times index. */
struct series_ray {
    struct series_vector y, v;
};

static struct series series_of(double value)
{
    return (struct series){{value}};
}

static struct series series_scaled(struct series a, double factor)
{
    for (size_t i = 0; i < MONOMIALS; i++) {
        a.of[i] *= factor;
    }
    return a;
}

/* a + factor b */
static struct series series_add(struct series a, double factor, struct series b)
{
    for (size_t i = 0; i < MONOMIALS; i++) {
        a.of[i] += factor * b.of[i];
    }
    return a;
}

static struct series series_multiply(struct series a, struct series b)
{
    /* [i][j]: which monomial the product of two of the first degree is */
    static const size_t product[4][4] = {{0, 1, 2, 3}, {1, 4, 5, 6}, {2, 5, 7, 8}, {3, 6, 8, 9}};
    struct series sum = {{a.of[0] * b.of[0]}};
    for (size_t i = 1; i < 4; i++) {
        for (size_t j = 1; j < 4; j++) {
            sum.of[product[i][j]] += a.of[i] * b.of[j];
        }
    }
    for (size_t i = 1; i < MONOMIALS; i++) {
        sum.of[i] += a.of[0] * b.of[i] + a.of[i] * b.of[0];
    }
    return sum;
}

/* The powers of 1 + r, r without a constant: 1 + exponent r + exponent (exponent - 1)/2 r^2. */
static struct series series_power(struct series a, double exponent)
{
    const double scale = pow(a.of[0], exponent);
    struct series rest = series_scaled(a, 1 / a.of[0]);
    rest.of[0] = 0;
    const struct series square = series_multiply(rest, rest);
    struct series power = series_add(series_of(1), exponent, rest);
    power = series_add(power, exponent * (exponent - 1) / 2, square);
    return series_scaled(power, scale);
}

/* The product of two vectors. */
static struct series vector_dot(const struct series_vector *a, const struct series_vector *b)
{
    static const struct series aa = {{0, 1}}, ab = {{0, 0, 1}}, bb = {{0, 0, 0, 1}};
    const struct series mixed =
        series_add(series_multiply(a->pupil, b->field), 1, series_multiply(a->field, b->pupil));
    struct series sum = series_multiply(aa, series_multiply(a->pupil, b->pupil));
    sum = series_add(sum, 1, series_multiply(ab, mixed));
    return series_add(sum, 1, series_multiply(bb, series_multiply(a->field, b->field)));
}

/* a + factor b */
static struct series_vector vector_add(struct series_vector a, double factor,
                                       struct series_vector b)
{
    return (struct series_vector){series_add(a.pupil, factor, b.pupil),
                                  series_add(a.field, factor, b.field)};
}

/* a + factor b */
static struct series_vector vector_add_times(struct series_vector a, struct series factor,
                                             struct series_vector b)
{
    return (struct series_vector){series_add(a.pupil, 1, series_multiply(factor, b.pupil)),
                                  series_add(a.field, 1, series_multiply(factor, b.field))};
}

static struct series_vector vector_times(struct series factor, struct series_vector a)
{
    return (struct series_vector){series_multiply(factor, a.pupil),
                                  series_multiply(factor, a.field)};
}

/* What a vector is without aberrations. */
static struct series_vector vector_paraxial(const struct series_vector *a)
{
    return (struct series_vector){series_of(a->pupil.of[0]), series_of(a->field.of[0])};
}

/* -------- surfaces -------- */

/* A sphere's z = c/2 s + c^3/8 s^2 + c^5/16 s^3, with (1 + k) and its square of a conic. */
static struct profile profile_at(const struct seidel_question *question, size_t i)
{
    const struct surface *surface = &question->lens->surfaces[i];
    const size_t axis = question->section == SECTION_Y ? 1 : 0;
    const double vertex = question->system->curvature[i].hi;
    struct profile profile = {{vertex / 2, 0, 0}};
    if (surface_section(surface)->weight[axis] != 0 && surface_has(surface, SURFACE_HAS_CURVE)) {
        const double c = surface_base_curvature(surface).hi, shape = 1 + surface->conic.value.hi;
        profile.f[1] = shape * pow(c, 3) / 8 + surface->coefficient[surface_term(4)].value.hi;
        profile.f[2] =
            shape * shape * pow(c, 5) / 16 + surface->coefficient[surface_term(6)].value.hi;
    }
    return profile;
}

/* The ray behind the surface, where the index goes from n to m. */
static struct series_ray series_refract(const struct series_ray *ray, const struct profile *profile,
                                        double before, double after)
{
    const double k = before / after;
    const double *f = profile->f;
    const struct series_vector slope = {series_scaled(ray->v.pupil, 1 / before),
                                        series_scaled(ray->v.field, 1 / before)};
    /* intersect the surface: each turn is right for one more power */
    struct series_vector point = ray->y;
    struct series s = vector_dot(&point, &point), z = {{0}};
    for (int turn = 0; turn < 2; turn++) {
        z = series_add(series_scaled(s, f[0]), f[1], series_multiply(s, s));
        point = vector_add_times(ray->y, z, slope);
        s = vector_dot(&point, &point);
    }
    /* normal (-2 f' point, 1), its square, that of (slope, 1) and their product */
    struct series steep = series_add(series_of(f[0]), 2 * f[1], s);
    steep = series_add(steep, 3 * f[2], series_multiply(s, s));
    const struct series normal =
        series_add(series_of(1), 4, series_multiply(s, series_multiply(steep, steep)));
    const struct series direction = series_add(series_of(1), 1, vector_dot(&slope, &slope));
    const struct series across =
        series_add(series_of(1), -2, series_multiply(steep, vector_dot(&point, &slope)));
    /* refract */
    const struct series refracted =
        series_add(series_scaled(series_multiply(normal, direction), 1 - k * k), k * k,
                   series_multiply(across, across));
    const struct series bend = series_multiply(
        series_add(series_scaled(series_power(refracted, 0.5), after), -before, across),
        series_power(normal, -1));
    const struct series along = series_power(series_add(series_of(before), 1, bend), -1);
    const struct series_vector turned =
        vector_add_times(ray->v, series_scaled(series_multiply(bend, steep), -2), point);
    const struct series_vector out = vector_times(along, turned); /* the slope */
    /* back to the plane of the vertex */
    return (struct series_ray){
        .y = vector_add_times(point, series_scaled(z, -1), out),
        .v = {series_scaled(out.pupil, after), series_scaled(out.field, after)}};
}

/* -n (y V - u Y) of two spaces, the second less the first, as the twelve. */
static void fifth_order_change(const struct series_ray *before, const struct series_ray *after,
                               double values[FIFTH_TERMS])
{
    enum { AA = 4, AB, AC, BB, BC, CC };
    const double y = before->y.pupil.of[0];
    const double u = before->v.pupil.of[0], u_after = after->v.pupil.of[0];
    struct series_vector change =
        vector_add((struct series_vector){{{0}}, {{0}}}, u_after, after->y);
    change = vector_add(change, -y, after->v);
    change = vector_add(change, -u, before->y);
    change = vector_add(change, y, before->v);
    const double *pupil = change.pupil.of, *field = change.field.of;
    values[FIFTH_B5] = pupil[AA];
    values[FIFTH_F1] = field[AA] + pupil[AB] / 2;
    values[FIFTH_F2] = pupil[AB] / 2;
    values[FIFTH_M1] = pupil[AC] + field[AB];
    values[FIFTH_M2] = pupil[AC];
    values[FIFTH_M3] = pupil[BB];
    values[FIFTH_N1] = field[AC] + (pupil[BC] + field[BB]) / 2;
    values[FIFTH_N2] = (pupil[BC] + field[BB]) / 2;
    values[FIFTH_N3] = pupil[BC] / 2;
    values[FIFTH_C5] = field[BC] / 4;
    values[FIFTH_PI5] = pupil[CC] - field[BC] / 4;
    values[FIFTH_E5] = field[CC];
}

/* -------- the lens -------- */

static bool fifth_order_check(const struct lens *lens, struct error *error)
{
    for (size_t i = 0; i < lens->surface_count; i++) {
        const struct surface *surface = &lens->surfaces[i];
        if (surface_has(surface, SURFACE_HAS_CURVE) &&
            surface->coefficient[surface_term(5)].value.hi != 0) {
            return fail(error, ERROR_DOMAIN,
                        "surface %zu: A5 r^5 makes an aberration of lower order than the fifth",
                        i + 1);
        }
    }
    return true;
}

bool fifth_order_compute(const struct seidel_question *question, struct arena *arena,
                         struct fifth_order *fifth, struct error *error)
{
    const struct paraxial_system *system = question->system;
    struct seidel_rays rays;
    if (!fifth_order_check(question->lens, error) || !seidel_object_rays(question, &rays, error)) {
        return false;
    }
    *fifth =
        (struct fifth_order){.parts = ARENA_ARRAY(arena, system->count, struct fifth_order_part)};
    struct series_ray ray = {.y = {series_of(rays.y.hi), series_of(rays.chief_y.hi)},
                             .v = {series_of(rays.v.hi), series_of(rays.chief_v.hi)}};
    for (size_t i = 0; i < system->count; i++) {
        struct fifth_order_part *part = &fifth->parts[i];
        const struct profile profile = profile_at(question, i);
        const double before = system->index[i].hi, after = system->index[i + 1].hi;
        if (i == system->stop && !question->first->is_telecentric && !isnan(ray.y.field.of[0])) {
            ray.y.field.of[0] = 0; /* by definition */
        }
        struct series_ray behind = ray;
        *part = (struct fifth_order_part){{0}, {0}};
        if (surface_has(&question->lens->surfaces[i], SURFACE_HAS_FOCAL)) {
            behind.v = vector_add(ray.v, -system->surfaces[i].power.hi, ray.y);
        } else {
            const struct series_ray clean = {vector_paraxial(&ray.y), vector_paraxial(&ray.v)};
            const struct series_ray clean_behind = series_refract(&clean, &profile, before, after);
            behind = series_refract(&ray, &profile, before, after);
            fifth_order_change(&ray, &behind, part->sum);
            fifth_order_change(&clean, &clean_behind, part->intrinsic);
        }
        for (size_t k = 0; k < FIFTH_TERMS; k++) {
            fifth->total.sum[k] += part->sum[k];
            fifth->total.intrinsic[k] += part->intrinsic[k];
        }
        ray = behind;
        ray.y = vector_add(ray.y, system->surfaces[i].reduced.hi, ray.v);
    }
    return true;
}
