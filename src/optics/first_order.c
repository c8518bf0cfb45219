/* optics/first_order.c - cardinal points, pupils and brightness of a lens, paraxially. */
/* SPDX-License-Identifier: MIT */
#include "optics/first_order.h"

#include "optics/fused.h"
#include "optics/portable.h"

#include <math.h>

struct conjugate_object lens_object(const struct lens *lens)
{
    return (struct conjugate_object){.is_infinite = lens->object_is_infinite,
                                     .distance = lens->object.value,
                                     .is_telecentric = lens->is_telecentric,
                                     .is_afocal = lens->focus == FOCUS_AFOCAL};
}

struct aperture_setting lens_aperture(const struct lens *lens)
{
    struct aperture_setting setting = {lens->aperture_kind, lens->aperture.value.hi};
    if (setting.kind == APERTURE_STOP) {
        /* lens_check refuses a lens without the stop; readers ask before it */
        setting.value =
            lens->stop != LENS_NONE ? lens->surfaces[lens->stop].diameter.value.hi : NAN;
    }
    return setting;
}

/* What is said to be afocal is so if less than this share of its strongest surface is left. */
static const double LEFT_POWER = 1e-3;

/* n a; most often n is 1. */
INLINE struct pair first_order_times(struct pair n, struct pair a, bool fused)
{
    return n.hi == 1 && n.lo == 0 ? a : fused_multiply(n, a, fused);
}

INLINE void set_cardinal_points(struct first_order *all, const struct paraxial_matrix *m,
                                struct pair n, struct pair n_image, bool fused)
{
    struct pair r = fused_reciprocal(m->c, fused);
    struct pair n_d = first_order_times(n, m->d, fused),
                n_a = first_order_times(n_image, m->a, fused), one = pair_of(1);
    /* d - 1 and 1 - a first: in weak lenses that is all there is */
    struct pair H = first_order_times(n, quick_difference(m->d, one), fused);
    struct pair H_rear = first_order_times(n_image, quick_difference(one, m->a), fused);
    all->power = -m->c.hi;
    all->efl = -r.hi;
    all->front_focal = first_order_times(n, r, fused).hi;
    all->rear_focal = -first_order_times(n_image, r, fused).hi;
    all->ffl = fused_quotient(n_d, r, fused);
    all->bfl = -fused_quotient(n_a, r, fused);
    all->front_principal = fused_quotient(H, r, fused);
    all->rear_principal = fused_quotient(H_rear, r, fused);
    if (n.hi == n_image.hi && n.lo == n_image.lo) {
        all->front_nodal = all->front_principal;
        all->rear_nodal = all->rear_principal;
        return;
    }
    all->front_nodal = fused_quotient(quick_difference(n_d, n_image), r, fused);
    all->rear_nodal = fused_quotient(quick_difference(n, n_a), r, fused);
}

/* What is telecentric is so exactly. */
INLINE struct pair vanishing(struct pair a)
{
    return fabs(a.hi) > PARAXIAL_NOTHING ? a : pair_of(0);
}

INLINE void first_order_set_pupils(struct first_order *all, const struct paraxial_trace *trace,
                                   struct pair n, struct pair n_image, bool fused)
{
    struct pair a1 = vanishing(trace->front.a), b1 = trace->front.b;
    struct pair b2 = trace->rear.b, d2 = vanishing(trace->rear.d);
    struct pair by_a1 = fused_reciprocal(a1, fused), by_d2 = fused_reciprocal(d2, fused);
    all->entrance_pupil = fused_quotient(first_order_times(n, b1, fused), by_a1, fused);
    all->entrance_scale = by_a1.hi;
    all->exit_pupil =
        fused_quotient(pair_negate(first_order_times(n_image, b2, fused)), by_d2, fused);
    all->exit_scale = by_d2.hi;
    all->pupil_magnification = fused_quotient(a1, by_d2, fused);
}

INLINE void set_image(struct first_order *all, const struct paraxial_matrix *m,
                      const struct conjugate_object *object, struct pair n, struct pair n_image,
                      bool fused)
{
    if (object->is_infinite) {
        all->image = all->bfl;
        all->magnification = 0;
        return;
    }
    struct pair reduced = pair_divide(object->distance, n);
    struct pair y = pair_add(fused_multiply(m->a, reduced, fused), m->b);
    struct pair v = pair_add(fused_multiply(m->c, reduced, fused), m->d);
    struct pair by_v = fused_reciprocal(v, fused);
    all->image = fused_quotient(pair_negate(first_order_times(n_image, y, fused)), by_v, fused);
    all->magnification = by_v.hi;
}

INLINE void first_order_trace(const struct paraxial_system *system,
                              const struct paraxial_trace *trace,
                              const struct conjugate_object *object, struct first_order *all,
                              bool fused)
{
    struct pair n = system->index[0], n_image = system->index[system->count];
    all->index_object = n.hi;
    all->index_image = n_image.hi;
    all->is_telecentric = object->is_telecentric;
    all->is_afocal = paraxial_is_afocal(system, trace) ||
                     (object->is_afocal && object->is_infinite &&
                      fabs(trace->whole.c.hi) < LEFT_POWER * system->strongest);
    all->angular_magnification = NAN;
    if (all->is_afocal) {
        all->power = 0;
        all->efl = all->rear_focal = all->ffl = all->bfl = INFINITY;
        all->front_focal = all->front_principal = all->rear_principal = INFINITY;
        all->front_nodal = all->rear_nodal = INFINITY;
        all->angular_magnification = pair_divide(pair_multiply(n, trace->whole.d), n_image).hi;
    } else {
        set_cardinal_points(all, &trace->whole, n, n_image, fused);
    }
    if (system->stop != LENS_NONE) {
        first_order_set_pupils(all, trace, n, n_image, fused);
    } else {
        all->entrance_pupil = all->exit_pupil = all->pupil_magnification = NAN;
        all->entrance_scale = all->exit_scale = NAN;
    }
    set_image(all, &trace->whole, object, n, n_image, fused);
    /* What the lens is said to be, wherever its own pupil and image are. */
    if (object->is_telecentric) {
        all->entrance_pupil = INFINITY;
        all->exit_pupil = all->bfl;
        all->entrance_scale = all->exit_scale = NAN;
        all->pupil_magnification = 0;
    }
    if (object->is_afocal) {
        all->image = INFINITY;
        all->magnification = object->is_infinite ? 0 : INFINITY;
    }
    all->petzval_sum = system->petzval;
    all->petzval_radius = system->petzval == 0 ? INFINITY : -1 / (n_image.hi * system->petzval);
    all->length = system->length;
    all->stop_radius = all->entrance_diameter = all->exit_diameter = NAN;
    all->fnumber = all->working_fnumber = all->na_image = NAN;
    all->marginal_y = all->marginal_v = all->chief_y = all->chief_v = all->lagrange = NAN;
    all->matrix = trace->whole; /* last: its parts, just stored, are copied in larger ones */
}

void first_order_compute_portable(const struct paraxial_system *system,
                                  const struct paraxial_trace *trace,
                                  const struct conjugate_object *object,
                                  struct first_order *first_order)
{
    first_order_trace(system, trace, object, first_order, false);
}

#ifdef HAS_FUSED
FUSED static void compute_fused(const struct paraxial_system *system,
                                const struct paraxial_trace *trace,
                                const struct conjugate_object *object, struct first_order *all)
{
    first_order_trace(system, trace, object, all, true);
}
#endif

void first_order_compute(const struct paraxial_system *system, const struct paraxial_trace *trace,
                         const struct conjugate_object *object, struct first_order *first_order)
{
#ifdef HAS_FUSED
    if (fused_here()) {
        compute_fused(system, trace, object, first_order);
        return;
    }
#endif
    first_order_trace(system, trace, object, first_order, false);
}

/* The object's height of an image's; NaN: an image infinitely far away has none. */
static double height_in_object(const struct first_order *all, double field)
{
    return isinf(all->magnification) ? (double)NAN : field / all->magnification;
}

/* n u of the chief ray in object space, through the centre of the entrance pupil. */
static double chief_slope(const struct first_order *all, const struct conjugate_object *object,
                          enum field_kind kind, double field)
{
    bool of_image = kind == FIELD_IMAGE || kind == FIELD_REAL;
    double n = all->index_object, height = field;
    if (kind == FIELD_ANGLE) {
        return n * tan(field);
    }
    if (object->is_infinite) {
        return of_image ? field * all->power : NAN;
    }
    if (of_image) {
        height = height_in_object(all, field);
    }
    return -n * height / (object->distance.hi + all->entrance_pupil);
}

/* What the paraxial marginal ray behind the lens says; v = n' u'. */
static void first_order_set_cone(struct first_order *all, double v)
{
    double slope = v / all->index_image;
    all->working_fnumber = 1 / (2 * fabs(v));
    all->na_image = fabs(all->index_image) * fabs(slope) / sqrt(1 + slope * slope);
}

/* The two rays of a telecentric object space, from the slope of the marginal one. */
static void set_telecentric_beam(struct first_order *all, const struct conjugate_object *object,
                                 double slope, enum field_kind kind, double field)
{
    const double n = all->index_object, distance = object->distance.hi;
    all->marginal_v = n * slope;
    all->marginal_y = slope * distance;
    all->entrance_diameter = INFINITY;
    all->exit_diameter = 2 * fabs(all->marginal_v / all->power);
    all->stop_radius = all->fnumber = NAN;
    first_order_set_cone(all, object->is_afocal ? 0 : all->marginal_v / all->magnification);
    if (kind == FIELD_NONE || isnan(field)) {
        return;
    }
    all->chief_v = 0;
    if (kind == FIELD_ANGLE) {
        all->chief_y = -tan(field) * distance;
    } else if (kind == FIELD_HEIGHT) {
        all->chief_y = field;
    } else {
        all->chief_y = height_in_object(all, field);
    }
    all->lagrange = -all->marginal_v * all->chief_y;
}

/* Pupils, f-numbers and the two rays from the radius of the entrance pupil (signed). */
static void set_beam(struct first_order *all, const struct conjugate_object *object, double radius,
                     enum field_kind kind, double field)
{
    double n = all->index_object;
    double place = all->entrance_pupil;
    all->entrance_diameter = 2 * fabs(radius);
    all->exit_diameter = all->entrance_diameter * fabs(all->pupil_magnification);
    all->fnumber = fabs(all->rear_focal) / all->entrance_diameter;
    if (object->is_infinite) {
        all->marginal_y = radius;
        all->marginal_v = 0;
    } else {
        all->marginal_v = n * radius / (object->distance.hi + place);
        all->marginal_y = all->marginal_v / n * object->distance.hi;
    }
    double v = object->is_infinite ? -radius * all->power : all->marginal_v / all->magnification;
    v = object->is_infinite || all->magnification != 0 ? v : NAN;
    first_order_set_cone(all, object->is_afocal && !object->is_infinite ? 0 : v);
    if (kind == FIELD_NONE || isnan(field)) {
        return;
    }
    all->chief_v = chief_slope(all, object, kind, field);
    all->chief_y = -all->chief_v / n * place;
    /* at the entrance pupil, where ybar = 0 */
    all->lagrange = radius * all->chief_v;
}

void first_order_use_stop(struct first_order *all, const struct conjugate_object *object,
                          double stop_radius, enum field_kind field_kind, double field)
{
    if (!isnan(stop_radius)) {
        all->stop_radius = stop_radius;
        set_beam(all, object, stop_radius * all->entrance_scale, field_kind, field);
    }
}

/* The slope of the marginal ray of a numerical aperture. */
static bool first_order_slope_of(const struct first_order *all,
                                 const struct conjugate_object *object, double aperture,
                                 double *tangent, struct error *error)
{
    double n = all->index_object;
    if (object->is_infinite) {
        return fail(error, ERROR_DOMAIN, "an object at infinity has no numerical aperture");
    }
    if (!(aperture < n)) {
        return fail(error, ERROR_DOMAIN, "the numerical aperture %.6g is not below the index %.6g",
                    aperture, n);
    }
    *tangent = aperture / sqrt((n - aperture) * (n + aperture));
    return true;
}

static bool first_order_radius_of(const struct first_order *all,
                                  const struct conjugate_object *object,
                                  const struct aperture_setting *aperture, double *radius,
                                  struct error *error)
{
    double value = aperture->value;
    if (aperture->kind == APERTURE_STOP) {
        if (isnan(all->entrance_scale)) {
            return fail(error, ERROR_DOMAIN, "the lens has no stop");
        }
        *radius = value / 2 * all->entrance_scale;
    } else if (aperture->kind == APERTURE_EPD) {
        *radius = value / 2;
    } else if (aperture->kind == APERTURE_FNUMBER) {
        if (all->is_afocal) {
            fail(error, ERROR_DOMAIN, "an afocal system has no f-number");
            return error_hint(error, "in its file 'aperture epd 20' says how wide its beam is, mm");
        }
        *radius = fabs(all->rear_focal) / value / 2;
    } else {
        double tangent;
        if (!first_order_slope_of(all, object, value, &tangent, error)) {
            return false;
        }
        *radius = tangent * (object->distance.hi + all->entrance_pupil);
    }
    return true;
}

bool first_order_aperture(struct first_order *first_order, const struct conjugate_object *object,
                          const struct aperture_setting *aperture, enum field_kind field_kind,
                          double field, struct error *error)
{
    double radius = NAN;
    if (aperture->kind == APERTURE_NONE) {
        return true;
    }
    if (object->is_telecentric && aperture->kind != APERTURE_NA) {
        fail(error, ERROR_DOMAIN,
             "the object space is telecentric: only a numerical aperture limits its beams");
        return error_hint(error, "na 0.1 for the aperture in the file");
    }
    if (object->is_telecentric) {
        double slope;
        bool done = first_order_slope_of(first_order, object, aperture->value, &slope, error);
        if (done) {
            set_telecentric_beam(first_order, object, slope, field_kind, field);
        }
        return done;
    }
    if (!first_order_radius_of(first_order, object, aperture, &radius, error)) {
        return false;
    }
    double scale = first_order->entrance_scale;
    if (!isnan(scale) && aperture->kind != APERTURE_STOP) {
        radius = copysign(radius, scale); /* the marginal ray is positive at the stop */
    }
    first_order->stop_radius =
        aperture->kind == APERTURE_STOP ? aperture->value / 2 : radius / scale;
    set_beam(first_order, object, radius, field_kind, field);
    return true;
}

bool first_order_of_lens(const struct lens *lens, double wavelength, enum lens_section section,
                         struct arena *arena, struct first_order *first_order, struct error *error)
{
    struct paraxial_system system;
    struct paraxial_trace trace;
    if (!paraxial_compile(lens, wavelength, section, arena, &system, error)) {
        return false;
    }
    const struct conjugate_object object = lens_object(lens);
    paraxial_trace(&system, &trace);
    first_order_compute(&system, &trace, &object, first_order);
    return true;
}

static bool is_off(double stated, double actual, double tolerance)
{
    return !isnan(stated) && !isnan(actual) && !(fabs(actual - stated) <= tolerance * fabs(stated));
}

const char *lens_stated_warning(const struct lens *lens, size_t position,
                                const struct first_order *first_order, struct arena *arena)
{
    const struct {
        const char *what;
        double stated, actual, tolerance;
    } all[] = {
        {"focal length", lens_stated(lens, STATED_EFL, position), first_order->efl, 0.04},
        {"back focus", lens_stated(lens, STATED_BFL, position), first_order->bfl, 0.1},
        {"f-number", lens_stated(lens, STATED_FNUMBER, position), first_order->fnumber, 0.1},
    };
    const char *warning = NULL;
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        if (is_off(all[i].stated, all[i].actual, all[i].tolerance)) {
            const char *text =
                arena_printf(arena, "the source states the %s %.6g, the prescription has %.6g",
                             all[i].what, all[i].stated, all[i].actual);
            warning = warning == NULL ? text : arena_printf(arena, "%s; %s", warning, text);
        }
    }
    return warning;
}

const char *first_order_warning(const struct lens *lens, struct arena *arena)
{
    static const char focus[] = "'focus best' is that of exact rays: first-order data have the "
                                "image at the paraxial focus";
    const char *warning = lens->focus == FOCUS_BEST ? focus : NULL;
    for (size_t i = 0; i < lens->surface_count; i++) {
        const struct surface *surface = &lens->surfaces[i];
        if (surface->decentre == NULL && surface->coordinate_break == NULL) {
            continue;
        }
        const char *text = arena_printf(
            arena, "surface %zu is %s: first-order data are those of the centred lens", i + 1,
            surface->decentre != NULL ? "decentred or tilted" : "behind a coordinate break");
        return warning == NULL ? text : arena_printf(arena, "%s; %s", text, warning);
    }
    return warning;
}
