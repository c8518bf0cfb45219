/* analysis/rays/paraxial_check.c - quantities by exact rays. */
/* SPDX-License-Identifier: MIT */
#include "analysis/rays/paraxial_check.h"

#include "trace/aim/beam.h"
#include "trace/dispatch.h"

#include <math.h>

bool paraxial_check_is_of_field(enum check_quantity quantity)
{
    return quantity >= CHECK_IMAGE_HEIGHT;
}

bool paraxial_check_applies(const struct check_problem *problem, enum check_quantity quantity)
{
    const struct first_order *first = problem->first;
    bool near = !problem->object.is_infinite, afocal = first->is_afocal;
    bool chief = problem->forward->stop != LENS_NONE && problem->field.kind != FIELD_NONE;
    switch (quantity) {
    case CHECK_EFL:
    case CHECK_BFL:
    case CHECK_REAR_PRINCIPAL:
    case CHECK_FFL:
    case CHECK_FRONT_PRINCIPAL:
        return !near && !afocal;
    case CHECK_IMAGE:
    case CHECK_MAGNIFICATION:
        return near && isfinite(first->image);
    case CHECK_EXIT_ANGLE:
        return !near && afocal;
    case CHECK_FNUMBER:
        return isfinite(first->image);
    case CHECK_TRANSVERSE:
        return isfinite(problem->plane);
    case CHECK_IMAGE_HEIGHT:
        return chief && isfinite(problem->plane);
    case CHECK_ANGULAR_MAGNIFICATION:
        return chief && afocal && !near;
    case CHECK_ENTRANCE_PUPIL:
        return chief && isfinite(first->entrance_pupil);
    case CHECK_EXIT_PUPIL:
        return chief && isfinite(first->exit_pupil);
    default:
        return false;
    }
}

/* A ray in the section: height at z = 0 of its frame, slope, and n sin U. */
struct meridional {
    double y, slope, sine; /* mm, dy/dz, n times the direction cosine */
    enum ray_status status;
    size_t surface;
};

/* Through the whole system; the result in the frame of the last surface met. */
static struct meridional check_follow(const struct check_problem *problem,
                                      const struct system *system, const struct ray *start,
                                      struct arena *arena)
{
    size_t axis = problem->section == SECTION_X ? 0 : 1;
    struct arena_mark mark = arena_mark(arena);
    struct rays rays = rays_new(arena, 1);
    rays_set(&rays, 0, system->index_first, start);
    rays_trace(system, &rays, NULL);
    struct ray out = rays_get(&rays, 0, system->index_last);
    arena_reset(arena, mark);
    double slope = out.cosine[axis] / out.cosine[2];
    return (struct meridional){.y = out.point[axis] - out.point[2] * slope,
                               .slope = slope,
                               .sine = system->index_last * out.cosine[axis],
                               .status = out.status,
                               .surface = out.surface};
}

/* A ray that starts in the plane of the first (last) vertex. */
static struct ray start_at(const struct check_problem *problem, double y, double slope,
                           double light_direction)
{
    size_t axis = problem->section == SECTION_X ? 0 : 1;
    double length = sqrt(1 + slope * slope);
    struct ray ray = {.status = RAY_OK};
    ray.point[axis] = y;
    ray.cosine[axis] = light_direction * slope / length;
    ray.cosine[2] = light_direction / length;
    return ray;
}

/* The paraxial ray behind the last vertex. */
static void paraxial_end(const struct first_order *first, double y, double v, double *y_out,
                         double *v_out)
{
    const struct paraxial_matrix *m = &first->matrix;
    *y_out = m->a.hi * y + m->b.hi * v;
    *v_out = m->c.hi * y + m->d.hi * v;
}

/* A line's crossing of the axis. */
static double crossing(const struct meridional *ray)
{
    return -ray->y / ray->slope;
}

static void paraxial_check_lose(const struct meridional *ray, struct check_value *value)
{
    value->status = ray->status;
    value->surface = ray->surface;
    if (ray->status != RAY_OK) {
        value->exact = NAN;
    }
}

static double place_scale(const struct first_order *first)
{
    return first->is_afocal ? fmax(fabs(first->length), 1) : fabs(first->efl);
}

/* -------- by aperture -------- */

static void compare_aperture(const struct check_problem *problem, enum check_quantity quantity,
                             double fraction, struct arena *arena, struct check_value *value)
{
    const struct first_order *first = problem->first;
    double n = first->index_object, y = fraction * first->marginal_y;
    double u = fraction * first->marginal_v / n, y_end, v_end;
    struct ray start = start_at(problem, y, u, 1);
    struct meridional ray = check_follow(problem, problem->forward, &start, arena);
    double sine = fabs(n) * u / sqrt(1 + u * u);
    paraxial_end(first, y, n * u, &y_end, &v_end);
    value->scale = place_scale(first);
    switch (quantity) {
    case CHECK_EFL:
        value->paraxial = first->efl;
        value->exact = -y / ray.sine;
        break;
    case CHECK_REAR_PRINCIPAL:
        value->paraxial = first->rear_principal;
        value->exact = (y - ray.y) / ray.slope;
        break;
    case CHECK_BFL:
    case CHECK_IMAGE:
        value->paraxial = quantity == CHECK_BFL ? first->bfl : first->image;
        value->exact = crossing(&ray);
        break;
    case CHECK_MAGNIFICATION:
        value->paraxial = first->magnification;
        value->exact = sine / ray.sine;
        value->scale = fabs(value->paraxial);
        break;
    case CHECK_FNUMBER:
        value->paraxial = 1 / (2 * fabs(v_end));
        value->exact = 1 / (2 * fabs(ray.sine));
        value->scale = value->paraxial;
        break;
    case CHECK_EXIT_ANGLE:
        value->paraxial = atan(v_end / first->index_image);
        value->exact = atan(ray.slope);
        value->scale = NAN;
        break;
    default:
        value->paraxial = y_end + problem->plane * v_end / first->index_image;
        /* in its own image plane it is 0 by definition, where the sum leaves rounding */
        value->paraxial = fabs(value->paraxial) <= 1e-15 * 8 * fabs(y_end) ? 0 : value->paraxial;
        value->exact = ray.y + problem->plane * ray.slope;
        value->scale = NAN;
    }
    paraxial_check_lose(&ray, value);
}

/* -------- by field -------- */

static struct check_chief paraxial_check_find_chief(const struct check_problem *problem,
                                                    double fraction, struct arena *arena)
{
    struct field_point field = problem->field;
    struct check_chief chief = {.fraction = fraction};
    struct error ignored;
    struct aim aim;
    field.value[0] *= fraction;
    field.value[1] *= fraction;
    chief.has_beam = beam_of_field(&field, &problem->object, problem->first, &chief.beam, &ignored);
    chief.found = chief.has_beam && aim_open(problem->forward, &chief.beam, arena, &aim, &ignored);
    if (chief.found) {
        chief.ray = aim_chief(&aim);
    }
    return chief;
}

/* The same, once for all quantities. */
static struct check_chief recall_chief(const struct check_problem *problem, double fraction,
                                       struct arena *arena)
{
    if (problem->chiefs == NULL) {
        return paraxial_check_find_chief(problem, fraction, arena);
    }
    int exponent;
    double mantissa = frexp(fraction, &exponent);
    size_t slot = (size_t)(mantissa * 1e9) + 37 * (size_t)(64 - exponent);
    struct check_chief *kept = &problem->chiefs[slot % CHECK_CHIEFS];
    if (kept->fraction != fraction) {
        *kept = paraxial_check_find_chief(problem, fraction, arena);
    }
    return *kept;
}

static void compare_field(const struct check_problem *problem, enum check_quantity quantity,
                          double fraction, struct arena *arena, struct check_value *value)
{
    const struct first_order *first = problem->first;
    size_t axis = problem->section == SECTION_X ? 0 : 1;
    const struct check_chief known = recall_chief(problem, fraction, arena);
    const struct beam beam = known.beam;
    const struct ray chief = known.ray;
    value->angle = known.has_beam ? atan2(beam.axis[axis], beam.axis[2]) : (double)NAN;
    if (!known.found) {
        value->status = RAY_NOT_CONVERGED;
        value->surface = problem->forward->stop + 1;
        return;
    }
    double y, u, y_end, v_end, slope = chief.cosine[axis] / chief.cosine[2];
    struct meridional ray = check_follow(problem, problem->forward, &chief, arena);
    /* the paraxial chief ray of the same object point at the first vertex */
    const double z = first->entrance_pupil;
    if (isinf(beam.distance)) {
        u = beam.axis[2] > 1e-9 ? beam.axis[axis] / beam.axis[2] : (double)INFINITY;
        y = -z * u;
    } else {
        const double height = -beam.axis[axis] * beam.distance, far = -beam.axis[2] * beam.distance;
        u = isfinite(z) ? height / (far - z) : 0;
        y = isfinite(z) ? -z * u : height;
    }
    paraxial_end(first, y, first->index_object * u, &y_end, &v_end);
    value->scale = place_scale(first);
    switch (quantity) {
    case CHECK_IMAGE_HEIGHT:
        value->paraxial =
            isfinite(u) ? y_end + problem->plane * v_end / first->index_image : (double)INFINITY;
        value->exact = ray.y + problem->plane * ray.slope;
        value->scale = fabs(value->paraxial);
        break;
    case CHECK_ANGULAR_MAGNIFICATION:
        value->paraxial = first->matrix.d.hi * first->index_object / first->index_image;
        value->exact = ray.slope / slope;
        value->scale = fabs(value->paraxial);
        break;
    case CHECK_ENTRANCE_PUPIL:
        value->paraxial = first->entrance_pupil;
        value->exact = chief.point[2] - chief.point[axis] / slope;
        break;
    default:
        value->paraxial = first->exit_pupil;
        value->exact = crossing(&ray);
    }
    paraxial_check_lose(&ray, value);
}

struct check_value paraxial_check_at(const struct check_problem *problem,
                                     enum check_quantity quantity, double fraction,
                                     struct arena *arena)
{
    const struct first_order *first = problem->first;
    struct check_value value = {
        .paraxial = NAN, .exact = NAN, .scale = NAN, .fnumber = NAN, .height = NAN, .angle = NAN};
    struct arena_mark mark = arena_mark(arena);
    if (paraxial_check_is_of_field(quantity)) {
        compare_field(problem, quantity, fraction, arena, &value);
    } else {
        bool near = !problem->object.is_infinite;
        value.height = fraction * first->entrance_diameter / 2;
        value.fnumber = (near ? first->working_fnumber : first->fnumber) / fraction;
        if (quantity == CHECK_FFL || quantity == CHECK_FRONT_PRINCIPAL) {
            /* Parallel light from behind, in the direction against that of the image space. */
            double light_direction = problem->first->index_image < 0 ? 1 : -1;
            struct ray start = start_at(problem, value.height, 0, light_direction);
            struct meridional ray = check_follow(problem, problem->backward, &start, arena);
            bool focus = quantity == CHECK_FFL;
            value.paraxial = focus ? first->ffl : first->front_principal;
            value.exact = focus ? crossing(&ray) : (value.height - ray.y) / ray.slope;
            value.scale = place_scale(first);
            paraxial_check_lose(&ray, &value);
        } else {
            compare_aperture(problem, quantity, fraction, arena, &value);
        }
    }
    arena_reset(arena, mark);
    if (!isfinite(value.exact)) {
        value.exact = NAN;
    }
    return value;
}

/* -------- the series -------- */

enum { SERIES = 17 };

/* Slope of the straight line through log2 d at steps first .. first + 3. */
static double line(const double *d, size_t first)
{
    double sum = 0;
    for (size_t i = 0; i < 4; i++) {
        sum += log2(d[first + i]) * (1.5 - (double)i);
    }
    return sum / 5;
}

struct check_order paraxial_check_order(const struct check_problem *problem,
                                        enum check_quantity quantity, struct arena *arena)
{
    struct check_order result = {.order = NAN};
    double d[SERIES], largest = 0, scale = place_scale(problem->first);
    size_t straight = SERIES;
    for (size_t k = 0; k < SERIES; k++) {
        struct check_value value = paraxial_check_at(problem, quantity, ldexp(1, -(int)k), arena);
        d[k] = fabs(value.exact - value.paraxial);
        d[k] = quantity == CHECK_FNUMBER ? d[k] / value.scale : d[k]; /* itself goes as 1/h */
        if (quantity == CHECK_FNUMBER) {
            scale = 1;
        } else if (isfinite(value.scale)) {
            scale = value.scale;
        }
        largest = d[k] > largest ? d[k] : largest;
    }
    result.is_equal = largest <= 1e-9 * scale && !(d[0] > 1e-13 * scale);
    for (size_t k = 0; k + 3 < SERIES && !result.is_equal; k++) {
        double low = INFINITY, high = -INFINITY;
        for (size_t i = k; i < k + 3; i++) {
            low = fmin(low, log2(d[i] / d[i + 1]));
            high = fmax(high, log2(d[i] / d[i + 1]));
        }
        straight = high - low <= 0.1 && low > 0.5 ? k : straight; /* false for NaN */
    }
    if (straight == SERIES) {
        return result;
    }
    result.order = line(d, straight);
    for (size_t k = straight + 4; k < SERIES && result.rounding == 0; k++) {
        double expected = d[straight] * exp2(-result.order * (double)(k - straight));
        result.rounding = fabs(d[k] / expected - 1) <= 0.1 ? 0 : ldexp(1, -(int)k);
    }
    return result;
}

static bool paraxial_is_within(const struct check_problem *problem, enum check_quantity quantity,
                               double fraction, double tolerance, struct arena *arena)
{
    struct check_value value = paraxial_check_at(problem, quantity, fraction, arena);
    return fabs(value.exact - value.paraxial) <= tolerance * value.scale;
}

double paraxial_check_trusted(const struct check_problem *problem, enum check_quantity quantity,
                              double tolerance, struct arena *arena)
{
    enum { SAMPLES = 48, HALVINGS = 30 };
    double good = 0, bad = NAN;
    if (isnan(paraxial_check_at(problem, quantity, 1.0 / SAMPLES, arena).scale)) {
        return NAN;
    }
    for (int i = 1; i <= SAMPLES && isnan(bad); i++) {
        double fraction = (double)i / SAMPLES;
        bool within = paraxial_is_within(problem, quantity, fraction, tolerance, arena);
        good = within ? fraction : good;
        bad = within ? bad : fraction;
    }
    for (int i = 0; i < HALVINGS && !isnan(bad); i++) {
        double middle = (good + bad) / 2;
        bool within = paraxial_is_within(problem, quantity, middle, tolerance, arena);
        good = within ? middle : good;
        bad = within ? bad : middle;
    }
    return good < 1e-6 ? 0 : good;
}
