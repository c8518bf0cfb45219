/* optics/seidel.c - third-order and first-order chromatic aberrations, surface by surface. */
/* SPDX-License-Identifier: MIT */
#include "optics/seidel.h"

#include <math.h>

/* One surface: curvature at the vertex; index and its dispersion before and after. */
struct interface {
    struct pair c, n[2], dn[2];
    struct pair departure; /* G of the header, mm^-3 */
    bool is_thick;
};

/* Sums in the making. */
struct exact_part {
    struct pair sum[SEIDEL_TERMS], asphere[SEIDEL_TERMS];
};

static struct pair seidel_product(struct pair a, struct pair b, struct pair c)
{
    return pair_multiply(pair_multiply(a, b), c);
}

static struct pair seidel_scaled(struct pair a, double factor)
{
    return pair_multiply(a, pair_of(factor));
}

/* a + b; 0 where only rounding of the decimals is left. */
static struct pair seidel_sum_of(struct pair a, struct pair b)
{
    const struct pair sum = pair_add(a, b);
    return fabs(sum.hi) <= PARAXIAL_NOTHING * fabs(a.hi) ? pair_of(0) : sum;
}

/* after/a - before/b */
static struct pair seidel_change(struct pair after, struct pair a, struct pair before,
                                 struct pair b)
{
    return pair_subtract(pair_divide(after, a), pair_divide(before, b));
}

/* -------- the two rays in object space -------- */

/* y = (b1/a1) .. of both rays by what the part before the stop does with them. */
static bool trace_back(const struct seidel_question *question, struct seidel_rays *rays,
                       struct error *error)
{
    const struct paraxial_system *system = question->system;
    const struct first_order *first = question->first;
    struct paraxial_trace trace;
    paraxial_trace(system, &trace);
    const struct pair a = trace.front.a, b = trace.front.b, n = system->index[0];
    const struct pair radius = pair_of(first->stop_radius);
    const struct pair distance = pair_divide(question->object->distance, n);
    const struct pair reach = pair_add(pair_multiply(a, distance), b);
    if (question->object->is_infinite) {
        rays->y = pair_divide(radius, a);
        rays->v = pair_of(0);
    } else {
        rays->v = pair_divide(radius, reach);
        rays->y = pair_multiply(rays->v, distance);
    }
    if (question->field_kind == FIELD_HEIGHT) {
        const struct pair part = pair_divide(pair_of(question->field), reach);
        rays->chief_v = pair_negate(pair_multiply(a, part));
        rays->chief_y = pair_multiply(b, part);
    } else if (question->field_kind == FIELD_ANGLE) {
        rays->chief_v = pair_multiply(n, pair_of(tan(question->field)));
        rays->chief_y = pair_negate(pair_multiply(pair_divide(b, a), rays->chief_v));
    } else {
        rays->chief_v = rays->chief_y = pair_of(NAN);
    }
    const bool lost = question->field_kind != FIELD_NONE &&
                      !(isfinite(rays->chief_y.hi) && isfinite(rays->chief_v.hi));
    return (!lost && isfinite(rays->y.hi) && isfinite(rays->v.hi)) ||
           fail(error, ERROR_DOMAIN, "no paraxial %s ray of the field reaches the stop",
                lost ? "chief" : "marginal");
}

bool seidel_object_rays(const struct seidel_question *question, struct seidel_rays *rays,
                        struct error *error)
{
    const struct first_order *first = question->first;
    if (first->is_telecentric) { /* whose beams no stop limits */
        *rays =
            (struct seidel_rays){.y = pair_of(first->marginal_y), .v = pair_of(first->marginal_v)};
        rays->chief_y = pair_of(first->chief_y);
        rays->chief_v = pair_of(first->chief_v);
        return isfinite(first->marginal_v) || fail(error, ERROR_DOMAIN, "the lens has no aperture");
    }
    if (question->system->stop == LENS_NONE) {
        return fail(error, ERROR_DOMAIN, "the lens has no stop: it has no chief rays");
    }
    if (!(first->stop_radius > 0) || isinf(first->stop_radius)) {
        return fail(error, ERROR_DOMAIN,
                    "the lens has no aperture: the height of its marginal ray is not known");
    }
    return trace_back(question, rays, error);
}

/* -------- surfaces -------- */

/* G: what the surface has of r^4 beyond the sphere of its vertex curvature. */
static struct pair departure_of(const struct surface *surface, struct pair c)
{
    const struct pair c0 = surface_base_curvature(surface);
    const struct pair cubes = pair_subtract(
        pair_multiply(pair_add(surface->conic.value, pair_of(1)), seidel_product(c0, c0, c0)),
        seidel_product(c, c, c));
    return pair_add(seidel_scaled(cubes, 0.125), surface->coefficient[surface_term(4)].value);
}

static struct interface interface_at(const struct seidel_question *question, size_t i)
{
    const struct paraxial_system *system = question->system;
    const struct surface *surface = &question->lens->surfaces[i];
    const size_t axis = question->section == SECTION_Y ? 1 : 0;
    struct interface at = {.c = system->curvature[i],
                           .is_thick = surface_has(surface, SURFACE_HAS_FOCAL)};
    for (size_t side = 0; side < 2; side++) {
        at.n[side] = system->index[i + side];
        at.dn[side] = question->blue_n != NULL
                          ? pair_subtract(question->blue_n[i + side], question->red_n[i + side])
                          : pair_of(NAN);
    }
    const bool is_curved = surface_section(surface)->weight[axis] != 0;
    at.departure = is_curved && surface_has(surface, SURFACE_HAS_CURVE)
                       ? departure_of(surface, at.c)
                       : pair_of(0);
    return at;
}

/* H, the same in every space. */
static struct pair invariant(const struct seidel_rays *rays)
{
    return pair_subtract(pair_multiply(rays->y, rays->chief_v),
                         pair_multiply(rays->chief_y, rays->v));
}

static void add_sphere(const struct interface *at, const struct seidel_rays *rays,
                       struct exact_part *part)
{
    const struct pair nc = pair_multiply(at->n[0], at->c), one = pair_of(1);
    const struct pair A = seidel_sum_of(rays->v, pair_multiply(nc, rays->y));
    const struct pair Abar = seidel_sum_of(rays->chief_v, pair_multiply(nc, rays->chief_y));
    const struct pair H = invariant(rays), yAbar = pair_multiply(rays->y, Abar);
    const struct pair squares[2] = {pair_multiply(at->n[0], at->n[0]),
                                    pair_multiply(at->n[1], at->n[1])};
    const struct pair bend = seidel_change(rays->after, squares[1], rays->v, squares[0]);
    const struct pair ybend = pair_negate(pair_multiply(rays->y, bend));
    const struct pair petzval = pair_multiply(at->c, seidel_change(one, at->n[1], one, at->n[0]));
    const struct pair inner =
        pair_subtract(seidel_scaled(yAbar, 2), pair_multiply(rays->chief_y, A));
    part->sum[SEIDEL_SPHERICAL] = seidel_product(A, A, ybend);
    part->sum[SEIDEL_COMA] = seidel_product(A, Abar, ybend);
    part->sum[SEIDEL_ASTIGMATISM] = seidel_product(Abar, Abar, ybend);
    part->sum[SEIDEL_PETZVAL] = pair_negate(seidel_product(H, H, petzval));
    part->sum[SEIDEL_DISTORTION] = pair_multiply(
        Abar, pair_subtract(
                  seidel_product(rays->chief_y, petzval, inner),
                  seidel_product(Abar, yAbar, seidel_change(one, squares[1], one, squares[0]))));
    const struct pair colour =
        pair_multiply(rays->y, seidel_change(at->dn[1], at->n[1], at->dn[0], at->n[0]));
    part->sum[SEIDEL_AXIAL_COLOR] = pair_multiply(A, colour);
    part->sum[SEIDEL_LATERAL_COLOR] = pair_multiply(Abar, colour);
}

static void add_asphere(const struct interface *at, const struct seidel_rays *rays,
                        struct exact_part *part)
{
    static const int powers[] = {[SEIDEL_SPHERICAL] = 0,
                                 [SEIDEL_COMA] = 1,
                                 [SEIDEL_ASTIGMATISM] = 2,
                                 [SEIDEL_DISTORTION] = 3};
    static const enum seidel_term terms[] = {SEIDEL_SPHERICAL, SEIDEL_COMA, SEIDEL_ASTIGMATISM,
                                             SEIDEL_DISTORTION};
    if (at->departure.hi == 0) {
        return;
    }
    const struct pair strength =
        seidel_scaled(pair_multiply(at->departure, pair_subtract(at->n[1], at->n[0])), 8);
    for (size_t i = 0; i < sizeof terms / sizeof terms[0]; i++) {
        struct pair value = strength;
        for (int factor = 0; factor < 4; factor++) {
            value = pair_multiply(value, factor < powers[terms[i]] ? rays->chief_y : rays->y);
        }
        part->asphere[terms[i]] = value;
        part->sum[terms[i]] = pair_add(part->sum[terms[i]], value);
    }
}

/* Rounded once; without -0. */
static struct seidel_part seidel_rounded(const struct exact_part *part)
{
    struct seidel_part out;
    for (size_t i = 0; i < SEIDEL_TERMS; i++) {
        out.sum[i] = part->sum[i].hi + 0.0;
        out.asphere[i] = part->asphere[i].hi + 0.0;
    }
    return out;
}

bool seidel_compute(const struct seidel_question *question, struct arena *arena,
                    struct seidel *seidel, struct error *error)
{
    const struct paraxial_system *system = question->system;
    struct seidel_rays rays;
    struct exact_part total = {0};
    if (!seidel_object_rays(question, &rays, error)) {
        return false;
    }
    *seidel = (struct seidel){.parts = ARENA_ARRAY(arena, system->count, struct seidel_part),
                              .lagrange = invariant(&rays).hi,
                              .distorting = LENS_NONE};
    for (size_t i = 0; i < system->count; i++) {
        const struct surface *surface = &question->lens->surfaces[i];
        const struct interface at = interface_at(question, i);
        struct exact_part part = {0};
        for (int order = 1; order <= 3; order += 2) {
            if (surface_has(surface, SURFACE_HAS_CURVE) &&
                surface->coefficient[surface_term(order)].value.hi != 0) {
                return fail(
                    error, ERROR_DOMAIN,
                    "surface %zu: A%d r%s makes an aberration of lower order than the Seidel "
                    "sums have",
                    i + 1, order, order == 1 ? "" : "^3");
            }
        }
        if (i == system->stop && !question->first->is_telecentric && !isnan(rays.chief_y.hi)) {
            rays.chief_y = pair_of(0); /* by definition */
        }
        /* The rays behind the surface; on to the next. */
        const struct pair power = pair_negate(system->surfaces[i].power);
        rays.after = seidel_sum_of(rays.v, pair_multiply(rays.y, power));
        rays.chief_after = seidel_sum_of(rays.chief_v, pair_multiply(rays.chief_y, power));
        if (at.is_thick) {
            /* Its power is the same for all light: only the media beside it disperse. */
            const struct pair ratio[2] = {pair_divide(at.dn[0], at.n[0]),
                                          pair_divide(at.dn[1], at.n[1])};
            part.sum[SEIDEL_AXIAL_COLOR] =
                pair_multiply(rays.y, pair_subtract(pair_multiply(ratio[1], rays.after),
                                                    pair_multiply(ratio[0], rays.v)));
            part.sum[SEIDEL_LATERAL_COLOR] =
                pair_multiply(rays.y, pair_subtract(pair_multiply(ratio[1], rays.chief_after),
                                                    pair_multiply(ratio[0], rays.chief_v)));
            seidel->distorting = surface->distortion[0].value.hi != 0 ? i : seidel->distorting;
        } else {
            add_sphere(&at, &rays, &part);
            add_asphere(&at, &rays, &part);
        }
        for (size_t k = 0; k < SEIDEL_TERMS; k++) {
            total.sum[k] = pair_add(total.sum[k], part.sum[k]);
            total.asphere[k] = pair_add(total.asphere[k], part.asphere[k]);
        }
        seidel->parts[i] = seidel_rounded(&part);
        seidel->height = rays.y.hi;
        seidel->slope = rays.after.hi;
        /* transfer to the next surface */
        rays.v = rays.after;
        rays.chief_v = rays.chief_after;
        rays.y = pair_add(rays.y, pair_multiply(rays.v, system->surfaces[i].reduced));
        rays.chief_y =
            pair_add(rays.chief_y, pair_multiply(rays.chief_v, system->surfaces[i].reduced));
    }
    seidel->total = seidel_rounded(&total);
    return true;
}

void seidel_convert(const struct seidel_part *part, enum seidel_form form, double unit,
                    double values[SEIDEL_TERMS])
{
    static const double shares[][SEIDEL_TERMS] = {
        [SEIDEL_WAVES] = {0.125, 0.5, 0.5, 0.25, 0.5, 0.5, 1},
        [SEIDEL_TRANSVERSE] = {0.5, 0.5, 0.5, 0.5, 0.5, 1, 1},
    };
    for (size_t i = 0; i < SEIDEL_TERMS; i++) {
        double sum = part->sum[i];
        if (form == SEIDEL_WAVES && i == SEIDEL_PETZVAL) {
            sum += part->sum[SEIDEL_ASTIGMATISM];
        }
        values[i] = shares[form][i] * sum * unit;
    }
}
