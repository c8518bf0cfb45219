/* optics/paraxial_dual.c - first-order data and Seidel sums with their derivatives. */
/* SPDX-License-Identifier: MIT */
#include "optics/paraxial_dual.h"

#include "optics/medium.h"

/* Height and n u. */
struct dual_ray {
    struct dual y, v;
};

static struct dual paraxial_dual_product(struct dual a, struct dual b, struct dual c)
{
    return dual_multiply(dual_multiply(a, b), c);
}

static struct dual paraxial_dual_inverse(struct dual a)
{
    return dual_divide(dual_of(1), a);
}

/* -------- the lens -------- */

/* A cylinder is in one section only. */
static bool is_curved_in(const struct paraxial_dual *dual, const struct surface *surface)
{
    const size_t axis = dual->section == SECTION_Y ? 1 : 0;
    return surface_section(surface)->weight[axis] != 0;
}

bool paraxial_dual_read(const struct lens *lens, double wavelength, struct paraxial_dual *dual,
                        struct error *error)
{
    dual->lens = lens;
    for (size_t i = 0; i < dual->count; i++) {
        const struct surface *surface = &lens->surfaces[i];
        const bool is_curved = is_curved_in(dual, surface);
        struct dual_surface to = {.is_thick = surface_has(surface, SURFACE_HAS_FOCAL)};
        to.thickness = dual_of(surface->thickness.value.hi);
        if (to.is_thick) {
            to.hiatus = dual_of(surface->hiatus.value.hi);
            to.power = dual_of(1 / surface->focal.value.hi);
        } else if (is_curved && surface_has(surface, SURFACE_HAS_CURVE)) {
            to.curvature = dual_of(surface_base_curvature(surface).hi);
            to.conic = dual_of(surface->conic.value.hi);
            to.second = dual_of(surface->coefficient[surface_term(2)].value.hi);
            to.fourth = dual_of(surface->coefficient[surface_term(4)].value.hi);
        }
        dual->surfaces[i] = to;
    }
    /* the indices: behind a mirror negative */
    struct dual *index = dual->index;
    struct pair n;
    if (!medium_index(&lens->object_medium, wavelength, &n, error)) {
        return false;
    }
    index[0] = dual_of(n.hi);
    for (size_t i = 0; i < lens->surface_count; i++) {
        const struct surface *behind = &lens->surfaces[i];
        double sign = index[i].value < 0 ? -1 : 1;
        if (surface_reflects(behind)) {
            index[i + 1] = dual_of(-index[i].value);
            continue;
        }
        if (!medium_index(&behind->medium, wavelength, &n, error)) {
            return error_prefix(error, "surface %zu: ", i + 1);
        }
        index[i + 1] = dual_of(sign * n.hi);
    }
    return true;
}

struct paraxial_dual paraxial_dual_new(const struct lens *lens, enum lens_section section,
                                       struct arena *arena)
{
    return (struct paraxial_dual){
        .lens = lens,
        .section = section,
        .count = lens->surface_count,
        .stop = lens->stop,
        .surfaces = ARENA_ARRAY(arena, lens->surface_count, struct dual_surface),
        .index = ARENA_ARRAY(arena, lens->surface_count + 1, struct dual)};
}

void paraxial_dual_rest(struct paraxial_dual *dual)
{
    for (size_t i = 0; i < dual->count; i++) {
        struct dual_surface *at = &dual->surfaces[i];
        at->curvature.slope = at->conic.slope = at->second.slope = at->fourth.slope = 0;
        at->thickness.slope = at->hiatus.slope = at->power.slope = 0;
    }
    for (size_t i = 0; i <= dual->count; i++) {
        dual->index[i].slope = 0;
    }
}

/* The number of a surface that a parameter is; null: none that counts here. */
static struct dual *paraxial_dual_number_of(struct dual_surface *at, struct parameter basis,
                                            bool bends)
{
    switch (basis.kind) {
    case PARAMETER_THICKNESS:
        return &at->thickness;
    case PARAMETER_HIATUS:
        return &at->hiatus;
    case PARAMETER_FOCAL:
        return &at->power;
    case PARAMETER_CURVATURE:
        return bends ? &at->curvature : NULL;
    case PARAMETER_CONIC:
        return bends ? &at->conic : NULL;
    case PARAMETER_COEFFICIENT:
        if (bends && basis.order == 2) {
            return &at->second;
        }
        return bends && basis.order == 4 ? &at->fourth : NULL;
    default:
        return NULL;
    }
}

void paraxial_dual_change(struct paraxial_dual *dual, struct parameter basis, double slope)
{
    if (basis.kind == PARAMETER_INDEX) { /* LENS_NONE + 1 is 0: the space before the first */
        struct dual *index = &dual->index[basis.surface + 1];
        index->slope += index->value < 0 ? -slope : slope;
        return;
    }
    struct dual_surface *at = &dual->surfaces[basis.surface];
    const bool bends = is_curved_in(dual, &dual->lens->surfaces[basis.surface]);
    struct dual *number = paraxial_dual_number_of(at, basis, bends);
    if (number != NULL) { /* of a focal length the power: d(1/f) = -df/f^2 */
        number->slope +=
            basis.kind == PARAMETER_FOCAL ? -at->power.value * at->power.value * slope : slope;
    }
}

/* At the vertex. */
static struct dual vertex_curvature(const struct dual_surface *at)
{
    return dual_add(at->curvature, dual_scale(at->second, 2));
}

static struct dual paraxial_dual_power_of(const struct paraxial_dual *dual, size_t i)
{
    const struct dual_surface *at = &dual->surfaces[i];
    return at->is_thick ? at->power
                        : dual_multiply(dual_subtract(dual->index[i + 1], dual->index[i]),
                                        vertex_curvature(at));
}

static struct dual_ray refracted(struct dual_ray ray, struct dual power)
{
    ray.v = dual_subtract(ray.v, dual_multiply(ray.y, power));
    return ray;
}

static struct dual_ray transferred(struct dual_ray ray, struct dual reduced)
{
    ray.y = dual_add(ray.y, dual_multiply(ray.v, reduced));
    return ray;
}

/* t/n to the next surface; behind the last there is none. */
static struct dual reduced_of(const struct paraxial_dual *dual, size_t i)
{
    return i + 1 < dual->count ? dual_divide(dual->surfaces[i].thickness, dual->index[i + 1])
                               : dual_of(0);
}

struct dual paraxial_dual_group(const struct paraxial_dual *dual, size_t first, size_t end)
{
    struct dual_ray ray = {dual_of(1), dual_of(0)};
    for (size_t i = first; i < end; i++) {
        ray = refracted(ray, paraxial_dual_power_of(dual, i));
        ray = i + 1 < end ? transferred(ray, reduced_of(dual, i)) : ray;
    }
    return dual_scale(ray.v, -1);
}

/* -------- first order -------- */

/* The rays of height 1 and of slope 1, behind the lens and at the stop. */
struct basic {
    struct dual_ray height, slope;
    struct dual stop_a, stop_b; /* their heights there */
};

static struct basic paraxial_dual_trace(const struct paraxial_dual *dual, struct dual_first *first)
{
    const struct dual one = dual_of(1), none = dual_of(0), absent = dual_of(NAN);
    struct basic rays = {{one, none}, {none, one}, absent, absent};
    struct dual petzval = none, length = none;
    for (size_t i = 0; i < dual->count; i++) {
        const struct dual_surface *at = &dual->surfaces[i];
        const struct dual power = paraxial_dual_power_of(dual, i), reduced = reduced_of(dual, i);
        if (i == dual->stop) {
            rays.stop_a = rays.height.y;
            rays.stop_b = rays.slope.y;
        }
        if (!at->is_thick) {
            petzval = dual_add(
                petzval, dual_divide(power, dual_multiply(dual->index[i], dual->index[i + 1])));
        }
        rays.height = transferred(refracted(rays.height, power), reduced);
        rays.slope = transferred(refracted(rays.slope, power), reduced);
        length = dual_add(length, at->hiatus);
        length = i + 1 < dual->count ? dual_add(length, at->thickness) : length;
    }
    first->index_object = dual->index[0];
    first->length = length;
    first->petzval = dual_scale(dual_multiply(dual->index[dual->count], petzval), -1);
    return rays;
}

static void set_cardinal(const struct paraxial_dual *dual, const struct dual_question *question,
                         const struct basic *rays, struct dual_first *first)
{
    const struct dual n = dual->index[0], last = dual->index[dual->count], c = rays->height.v;
    first->power = dual_scale(c, -1);
    first->efl = dual_scale(paraxial_dual_inverse(c), -1);
    first->bfl = dual_scale(dual_divide(dual_multiply(last, rays->height.y), c), -1);
    first->ffl = dual_divide(dual_multiply(n, rays->slope.v), c);
    first->image = first->bfl;
    first->magnification = dual_of(0);
    if (!question->object->is_infinite) {
        const struct dual reach = dual_divide(dual_of(question->object->distance.hi), n);
        const struct dual y = dual_add(dual_multiply(rays->height.y, reach), rays->slope.y);
        const struct dual v = dual_add(dual_multiply(c, reach), rays->slope.v);
        first->image = dual_scale(dual_divide(dual_multiply(last, y), v), -1);
        first->magnification = paraxial_dual_inverse(v);
    }
    first->entrance_scale = paraxial_dual_inverse(rays->stop_a);
    first->entrance_pupil = dual_divide(dual_multiply(n, rays->stop_b), rays->stop_a);
    /* where the ray through the centre of the stop, of heights -b1, and a1 the slope, leaves for */
    const struct dual chief_y = dual_subtract(dual_multiply(rays->slope.y, rays->stop_a),
                                              dual_multiply(rays->height.y, rays->stop_b));
    const struct dual chief_v =
        dual_subtract(dual_multiply(rays->slope.v, rays->stop_a), dual_multiply(c, rays->stop_b));
    first->exit_pupil = question->object->is_telecentric
                            ? first->bfl
                            : dual_scale(dual_divide(dual_multiply(last, chief_y), chief_v), -1);
}

/* Of the marginal ray of a numerical aperture: tan(asin(na/n)). */
static struct dual paraxial_dual_slope_of(const struct dual_question *question, struct dual n)
{
    const double na = question->aperture->value;
    if (question->object->is_infinite || !(na < n.value)) {
        return dual_of(NAN);
    }
    const double root = sqrt((n.value - na) * (n.value + na));
    return (struct dual){na / root, -na * n.value * n.slope / (root * root * root)};
}

/* Radius of the entrance pupil of an aperture that is not the stop's, not signed. */
static struct dual paraxial_dual_radius_of(const struct paraxial_dual *dual,
                                           const struct dual_question *question,
                                           const struct dual_first *first)
{
    const struct aperture_setting *aperture = question->aperture;
    const struct dual last = dual->index[dual->count];
    if (aperture->kind == APERTURE_EPD) {
        return dual_of(aperture->value / 2);
    }
    if (aperture->kind == APERTURE_FNUMBER) {
        return dual_absolute(
            dual_scale(dual_multiply(last, first->efl), 1 / (2 * aperture->value)));
    }
    return aperture->kind == APERTURE_NA
               ? dual_multiply(
                     paraxial_dual_slope_of(question, dual->index[0]),
                     dual_add(dual_of(question->object->distance.hi), first->entrance_pupil))
               : dual_of(NAN);
}

/* The stop and the entrance pupil, of which one follows from the other. */
static void set_stop(const struct paraxial_dual *dual, const struct dual_question *question,
                     struct dual_first *first)
{
    const struct dual_first *primary = question->primary;
    const struct aperture_setting *aperture = question->aperture;
    const bool has_stop = dual->stop != LENS_NONE;
    if (primary != NULL || aperture->kind == APERTURE_STOP) {
        first->stop_radius = primary != NULL ? primary->stop_radius : dual_of(aperture->value / 2);
        if (has_stop) {
            first->entrance_radius = dual_multiply(first->stop_radius, first->entrance_scale);
        } else if (primary != NULL) {
            first->entrance_radius = primary->entrance_radius;
        } else {
            first->entrance_radius = dual_of(NAN);
        }
        return;
    }
    first->entrance_radius = paraxial_dual_radius_of(dual, question, first);
    if (has_stop) { /* the marginal ray is positive at the stop */
        first->entrance_radius = dual_with_sign(first->entrance_radius, first->entrance_scale);
    }
    first->stop_radius = dual_divide(first->entrance_radius, first->entrance_scale);
}

static void set_marginal(const struct paraxial_dual *dual, const struct dual_question *question,
                         struct dual_first *first)
{
    const struct dual n = dual->index[0], last = dual->index[dual->count];
    const struct conjugate_object *object = question->object;
    const struct dual distance = dual_of(object->distance.hi);
    struct dual slope = dual_of(0);
    if (object->is_telecentric) {
        slope = paraxial_dual_slope_of(question, n);
    } else if (!object->is_infinite) {
        slope = dual_divide(first->entrance_radius, dual_add(distance, first->entrance_pupil));
    }
    first->marginal_v = dual_multiply(n, slope);
    first->marginal_y =
        object->is_infinite ? first->entrance_radius : dual_multiply(slope, distance);
    const struct dual behind = object->is_infinite
                                   ? dual_multiply(first->entrance_radius, first->power)
                                   : dual_divide(first->marginal_v, first->magnification);
    first->working_fnumber = dual_absolute(paraxial_dual_inverse(dual_scale(behind, 2)));
    first->fnumber = dual_absolute(
        dual_divide(dual_multiply(last, first->efl), dual_scale(first->entrance_radius, 2)));
}

/* The height of a near object that a field means, by the primary wavelength. */
static struct dual object_height(const struct dual_question *question,
                                 const struct dual_first *primary)
{
    const double field = question->field;
    if (question->field_kind == FIELD_HEIGHT) {
        return dual_of(field);
    }
    return question->field_kind == FIELD_ANGLE
               ? dual_of(-tan(field) * question->object->distance.hi)
               : dual_divide(dual_of(field), primary->magnification);
}

static void set_chief(const struct paraxial_dual *dual, const struct dual_question *question,
                      struct dual_first *first)
{
    const struct dual n = dual->index[0];
    const struct dual_first *primary = question->primary != NULL ? question->primary : first;
    const struct conjugate_object *object = question->object;
    first->chief_y = first->chief_v = dual_of(NAN);
    if (question->field_kind == FIELD_NONE) {
        return;
    }
    if (object->is_telecentric) {
        first->chief_v = dual_of(0);
        first->chief_y = object_height(question, primary);
        return;
    }
    if (question->field_kind == FIELD_ANGLE) {
        first->chief_v = dual_scale(n, tan(question->field));
    } else if (object->is_infinite) { /* tan t = y' P/n */
        first->chief_v = dual_scale(
            dual_multiply(primary->power, dual_divide(n, primary->index_object)), question->field);
    } else {
        first->chief_v =
            dual_scale(dual_divide(dual_multiply(n, object_height(question, primary)),
                                   dual_add(dual_of(object->distance.hi), first->entrance_pupil)),
                       -1);
    }
    first->chief_y =
        dual_scale(dual_multiply(dual_divide(first->chief_v, n), first->entrance_pupil), -1);
}

void paraxial_dual_first(const struct paraxial_dual *dual, const struct dual_question *question,
                         struct dual_first *first)
{
    const struct basic rays = paraxial_dual_trace(dual, first);
    set_cardinal(dual, question, &rays, first);
    set_stop(dual, question, first);
    set_marginal(dual, question, first);
    set_chief(dual, question, first);
}

void paraxial_dual_reach(const struct paraxial_dual *dual, const struct dual_first *first,
                         struct dual *reach)
{
    const bool has_chief = !isnan(first->chief_y.value);
    struct dual_ray marginal = {first->marginal_y, first->marginal_v};
    struct dual_ray chief = {has_chief ? first->chief_y : dual_of(0),
                             has_chief ? first->chief_v : dual_of(0)};
    for (size_t i = 0; i < dual->count; i++) {
        const struct dual power = paraxial_dual_power_of(dual, i), reduced = reduced_of(dual, i);
        reach[i] = dual_add(dual_absolute(marginal.y), dual_absolute(chief.y));
        marginal = transferred(refracted(marginal, power), reduced);
        chief = transferred(refracted(chief, power), reduced);
    }
}

/* -------- Seidel sums -------- */

/* after/a - before/b */
static struct dual quotient_change(struct dual after, struct dual a, struct dual before,
                                   struct dual b)
{
    return dual_subtract(dual_divide(after, a), dual_divide(before, b));
}

/* 8 G (n' - n), G the departure from the sphere of the vertex curvature. */
static struct dual strength_of(const struct dual_surface *at, struct dual step)
{
    const struct dual c0 = at->curvature, c = vertex_curvature(at);
    const struct dual cubes = dual_subtract(
        dual_multiply(dual_add(at->conic, dual_of(1)), paraxial_dual_product(c0, c0, c0)),
        paraxial_dual_product(c, c, c));
    return dual_multiply(dual_add(cubes, dual_scale(at->fourth, 8)), step);
}

/* What a surface adds; rays before it, and the marginal ray behind it. */
static void paraxial_dual_add_surface(const struct paraxial_dual *dual, size_t i,
                                      const struct dual_ray *marginal, const struct dual_ray *chief,
                                      struct dual sums[DUAL_SUMS])
{
    const struct dual_surface *at = &dual->surfaces[i];
    const struct dual n = dual->index[i], after = dual->index[i + 1], one = dual_of(1);
    const struct dual c = vertex_curvature(at), nc = dual_multiply(n, c);
    const struct dual y = marginal->y, ybar = chief->y;
    const struct dual A = dual_add(marginal->v, dual_multiply(nc, y));
    const struct dual Abar = dual_add(chief->v, dual_multiply(nc, ybar));
    const struct dual H =
        dual_subtract(dual_multiply(y, chief->v), dual_multiply(ybar, marginal->v));
    const struct dual nn = dual_multiply(n, n), aa = dual_multiply(after, after);
    const struct dual v = refracted(*marginal, paraxial_dual_power_of(dual, i)).v;
    const struct dual ybend =
        dual_scale(dual_multiply(y, quotient_change(v, aa, marginal->v, nn)), -1);
    const struct dual petzval = dual_multiply(c, quotient_change(one, after, one, n));
    const struct dual yAbar = dual_multiply(y, Abar);
    const struct dual inner = dual_subtract(dual_scale(yAbar, 2), dual_multiply(ybar, A));
    const struct dual terms[DUAL_SUMS] = {
        paraxial_dual_product(A, A, ybend), paraxial_dual_product(A, Abar, ybend),
        paraxial_dual_product(Abar, Abar, ybend),
        dual_scale(paraxial_dual_product(H, H, petzval), -1),
        dual_multiply(Abar, dual_subtract(paraxial_dual_product(ybar, petzval, inner),
                                          paraxial_dual_product(
                                              Abar, yAbar, quotient_change(one, aa, one, nn))))};
    const struct dual strength = strength_of(at, dual_subtract(after, n));
    const struct dual yy = dual_multiply(y, y), cross = dual_multiply(y, ybar);
    const struct dual barred = dual_multiply(ybar, ybar);
    const struct dual aspheric[DUAL_SUMS] = {
        paraxial_dual_product(strength, yy, yy), paraxial_dual_product(strength, yy, cross),
        paraxial_dual_product(strength, yy, barred), dual_of(0),
        paraxial_dual_product(strength, cross, barred)};
    for (size_t k = 0; k < DUAL_SUMS; k++) {
        sums[k] = dual_add(sums[k], dual_add(terms[k], aspheric[k]));
    }
}

void paraxial_dual_seidel(const struct paraxial_dual *dual, const struct dual_first *first,
                          struct dual sums[DUAL_SUMS])
{
    struct dual_ray marginal = {first->marginal_y, first->marginal_v};
    struct dual_ray chief = {first->chief_y, first->chief_v};
    for (size_t k = 0; k < DUAL_SUMS; k++) {
        sums[k] = dual_of(0);
    }
    for (size_t i = 0; i < dual->count; i++) {
        const struct dual power = paraxial_dual_power_of(dual, i), reduced = reduced_of(dual, i);
        if (!dual->surfaces[i].is_thick) {
            paraxial_dual_add_surface(dual, i, &marginal, &chief, sums);
        }
        marginal = transferred(refracted(marginal, power), reduced);
        chief = transferred(refracted(chief, power), reduced);
    }
}
