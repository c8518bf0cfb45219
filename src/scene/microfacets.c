/* scene/microfacets.c - microfacets: the GGX distribution, its masking and its albedo. */
/* SPDX-License-Identifier: MIT */
#include "scene/microfacets.h"

#include "base/constants.h"

#include <math.h>

/* The cosine in place of 0, by which nothing leaves: from below alpha all facets look the same. */
#define GRAZING 1e-9

/* -------- one normal -------- */

double microfacets_lambda(const struct microfacets *coat, struct vector direction)
{
    const double slope =
        (direction.x * direction.x + direction.y * direction.y) / (direction.z * direction.z);
    return (sqrt(1 + coat->alpha * coat->alpha * slope) - 1) / 2;
}

double microfacets_reflect(const struct microfacets *coat, struct vector out, struct vector normal,
                           struct vector in)
{
    const double own = microfacets_lambda(coat, out);
    if (!(in.z > 0)) {
        return 0;
    }
    /* Fresnel, of natural light that meets a clear medium; c is the cosine of its angle */
    const double index = coat->index;
    const double c = vector_dot(out, normal);
    const double g = sqrt(index * index - 1 + c * c);
    const double across = (g - c) / (g + c);
    const double along = (c * (g + c) - 1) / (c * (g - c) + 1);
    /* of no other medium nothing, at a right angle too, where the second is 0/0 */
    const double reflected = index > 1 ? across * across * (1 + along * along) / 2 : 0;
    return reflected * (1 + own) / (1 + own + microfacets_lambda(coat, in));
}

/* -------- all normals -------- */

/*
 * Gauss and Legendre's rule on 0..1: [Abramowitz64] table 25.4, its abscissas moved from -1..1. As
 * numbers, since what is found by libm's cosine may differ in the last bit between processors, and
 * chances are made of it.
 */
struct quadrature_node {
    double at, weight;
};
enum { ACROSS = 5, ALONG = 12 };
static const struct quadrature_node across_rule[ACROSS] = {
    {0.046910077030668004, 0.11846344252809454},
    {0.23076534494715845, 0.23931433524968324},
    {0.5, 0.28444444444444444},
    {0.76923465505284155, 0.23931433524968324},
    {0.95308992296933200, 0.11846344252809454},
};
static const struct quadrature_node along_rule[ALONG] = {
    {0.0092196828766403782, 0.023587668193255917}, {0.047941371814762601, 0.053469662997659088},
    {0.11504866290284765, 0.080039164271673166},   {0.20634102285669126, 0.10158371336153292},
    {0.31608425050090994, 0.11674626826917739},    {0.43738329574426554, 0.12457352290670144},
    {0.5626167042557344, 0.12457352290670144},     {0.68391574949909006, 0.11674626826917739},
    {0.79365897714330869, 0.10158371336153292},    {0.88495133709715235, 0.080039164271673166},
    {0.95205862818523745, 0.053469662997659088},   {0.99078031712335957, 0.023587668193255917},
};

/* Of an angle: turns add by multiplying. Sine and cosine of libm differ between processors. */
struct unit_complex {
    double cosine, sine;
};

static struct unit_complex unit_complex_turned(struct unit_complex a, struct unit_complex by,
                                               double sign)
{
    return (struct unit_complex){a.cosine * by.cosine - sign * a.sine * by.sine,
                                 a.sine * by.cosine + sign * a.cosine * by.sine};
}

/* Half of an angle of 0 to pi. */
static struct unit_complex half_of(double cosine)
{
    const double within = fmin(fmax(cosine, -1), 1);
    return (struct unit_complex){sqrt((1 + within) / 2), sqrt((1 - within) / 2)};
}

/* Where light comes from, and what of the facets is the same for all of their normals. */
struct incidence {
    const struct microfacets *coat;
    struct vector out;           /* of length 1, in the plane y = 0 */
    struct unit_complex upright; /* of the stretched `out`: cosine with the surface's normal */
    double even;                 /* K */
    struct unit_complex middle;  /* of g where i rises highest */
    double turning;              /* R */
};

/*
 * i rises above the surface where 2 (o.h) h.z > o.z. With n above and s the stretched `out` that is
 *   K + R cos 2(g - middle) > s.z alpha^2 tan^2 b, of q = 1 - alpha^2:
 *   K = s.z q/2, R cos 2 middle = s.z (1 + q/2 - q s.z^2), R sin 2 middle = s.x (1 - q s.z^2)
 */
static struct incidence see_from(const struct microfacets *coat, double cosine)
{
    const double alpha = coat->alpha, sine = sqrt(fmax(0, 1 - cosine * cosine));
    const double length = sqrt(alpha * alpha * sine * sine + cosine * cosine);
    const double x = alpha * sine / length, z = cosine / length, q = 1 - alpha * alpha;
    const double level = z * (1 + q / 2 - q * z * z), upward = x * (1 - q * z * z);
    const double turning = sqrt(level * level + upward * upward);
    return (struct incidence){.coat = coat,
                              .out = {sine, 0, cosine},
                              .upright = {z, x},
                              .even = z * q / 2,
                              .middle = half_of(level / turning),
                              .turning = turning};
}

/* Between which angles g the light leaves; they are less than pi apart. */
static void azimuth_limits(const struct incidence *seen, double tangent,
                           struct unit_complex ends[2])
{
    const double alpha = seen->coat->alpha, upright = seen->upright.cosine;
    const double level = upright * alpha * alpha * tangent * tangent - seen->even;
    const struct unit_complex half = half_of(level / seen->turning);
    const struct unit_complex horizon = {seen->upright.sine, -upright};
    ends[0] = unit_complex_turned(seen->middle, half, -1);
    ends[1] = unit_complex_turned(seen->middle, half, 1);
    ends[0] = ends[0].sine > horizon.sine ? ends[0] : horizon;
    ends[1] = ends[1].cosine > 0 ? ends[1] : (struct unit_complex){0, 1};
}

/* The sum over g: the angle goes by the tangent of its half, about its middle. */
static double sum_along(const struct incidence *seen, struct unit_complex b,
                        const struct unit_complex ends[2])
{
    const double apart = ends[0].cosine * ends[1].cosine + ends[0].sine * ends[1].sine;
    const struct unit_complex half = half_of(apart), quarter = half_of(half.cosine);
    const struct unit_complex middle = unit_complex_turned(ends[0], half, 1);
    const double edge = quarter.sine / quarter.cosine;
    double sum = 0;
    for (int i = 0; i < ALONG; i++) {
        const double u = along_rule[i].at;
        const double place = 2 * u * u * u * (4 - 3 * u) - 1, step = 24 * u * u * (1 - u);
        const double t = edge * place, scale = 1 / (1 + t * t);
        const struct unit_complex turned = {(1 - t * t) * scale, 2 * t * scale};
        const struct unit_complex g = unit_complex_turned(middle, turned, 1);
        /* A normal of the stretched facets, pressed together again. */
        const double x = b.cosine * (g.cosine * seen->upright.sine - g.sine * seen->upright.cosine);
        const double z = b.cosine * (g.sine * seen->upright.sine + g.cosine * seen->upright.cosine);
        const struct vector normal =
            vector_unit((struct vector){seen->coat->alpha * x, seen->coat->alpha * b.sine, z});
        const struct vector in = vector_mirrored(seen->out, normal);
        sum += along_rule[i].weight * step * edge * 2 * scale * g.cosine *
               microfacets_reflect(seen->coat, seen->out, normal, in);
    }
    return sum;
}

static double share_towards(const struct microfacets *coat, double cosine)
{
    const struct incidence seen = see_from(coat, cosine);
    const double alpha = coat->alpha, upright = seen.upright.cosine;
    const double tangent = sqrt((seen.even + seen.turning) / upright) / alpha;
    const double edge = tangent / (1 + sqrt(1 + tangent * tangent));
    double sum = 0;
    for (int i = 0; i < ACROSS; i++) {
        const double t = edge * across_rule[i].at, scale = 1 / (1 + t * t);
        const struct unit_complex b = {(1 - t * t) * scale, 2 * t * scale};
        struct unit_complex ends[2];
        azimuth_limits(&seen, b.sine / b.cosine, ends);
        sum += across_rule[i].weight * edge * 2 * scale * b.cosine * b.cosine *
               sum_along(&seen, b, ends);
    }
    /* both sides of y = 0, over all normals that are seen: pi/2 (1 + s.z) */
    return 2 * sum / (PI / 2 * (1 + upright));
}

/* -------- tables -------- */

/* The cosine of a place between nodes, 0 to 1. */
static double cosine_of(double place)
{
    return place * place * place * place;
}

/* Catmull and Rom's cubic; beyond the ends it goes straight on. */
double microfacets_albedo(const struct microfacets *coat, double cosine)
{
    const double at = sqrt(sqrt(cosine)) * (MICROFACET_NODES - 1);
    const int k = (int)fmin(at, MICROFACET_NODES - 2);
    const double *near = coat->albedo + k, x = at - k, rise = near[1] - near[0];
    const double first = k > 0 ? (near[1] - near[-1]) / 2 : rise;
    const double last = k < MICROFACET_NODES - 2 ? (near[2] - near[0]) / 2 : rise;
    const double bend = 3 * rise - 2 * first - last, twist = first + last - 2 * rise;
    /* which may go a little too far where a coat of almost no index ends */
    return fmax(0, near[0] + x * (first + x * (bend + x * twist)));
}

void microfacets_open(double roughness, double index, struct microfacets *coat)
{
    *coat = (struct microfacets){.alpha = roughness, .index = index};
    coat->albedo[0] = share_towards(coat, GRAZING);
    for (int k = 1; k < MICROFACET_NODES; k++) {
        coat->albedo[k] = share_towards(coat, cosine_of((double)k / (MICROFACET_NODES - 1)));
    }
    /* the integral of 2 c share(c) dc, c = r^4 */
    for (int k = 0; k < MICROFACET_NODES - 1; k++) {
        for (int i = 0; i < ACROSS; i++) {
            const double r = (k + across_rule[i].at) / (MICROFACET_NODES - 1), r3 = r * r * r;
            coat->mean_albedo += across_rule[i].weight / (MICROFACET_NODES - 1) * 8 * cosine_of(r) *
                                 r3 * microfacets_albedo(coat, cosine_of(r));
        }
    }
}
