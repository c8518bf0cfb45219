/* commands/lens/trace_start.c - a lens made ready for exact rays, and where they start. */
/* SPDX-License-Identifier: MIT */
#include "commands/lens/trace_answer.h"

#include <float.h>

const struct system *ray_case_system(const struct ray_case *one, struct error *error)
{
    unsigned which = SETUP_PATH;
    which |= one->clip ? SETUP_CLIPPED : 0;
    which |= one->to_image ? SETUP_IMAGE : 0;
    return setup_system(&one->setup, 0, which, error);
}

static bool set_target(const struct target_value *to, struct ray_case *one, struct arena *arena,
                       struct error *error)
{
    size_t count = one->setup.lens->surface_count;
    one->surfaces = count;
    one->to_image =
        to->kind == TARGET_IMAGE || (to->kind == TARGET_USUAL && !isnan(one->setup.image));
    if (to->kind == TARGET_IMAGE && isnan(one->setup.image)) {
        fail(error, ERROR_DOMAIN, "{--to} image: the image is infinitely far away");
        return error_hint(error, "{--to} last, or {--focus} with a number of mm");
    }
    if (to->kind == TARGET_USUAL && isnan(one->setup.image)) {
        one->warning = lens_warnings_join(
            one->warning, "the image is infinitely far away: rays end at the last surface", arena);
    }
    if (to->kind == TARGET_SURFACE) {
        one->surfaces = (size_t)to->surface;
    }
    return one->surfaces <= count ||
           fail(error, ERROR_USAGE, "{--to} %ld: the lens has %zu surfaces", to->surface, count);
}

bool ray_case_open(const struct ray_question *question, size_t position, double wavelength,
                   const struct setup_field *field, struct arena *arena, struct ray_case *one,
                   struct error *error)
{
    const struct setup_question asked = {
        .lens = question->lens.lens,
        .position = position,
        .wavelength = wavelength,
        .wavelengths = WAVELENGTHS_PRIMARY,
        .fnumber = question->fnumber,
        .fields = field,
        .field_count = field != NULL ? 1 : 0,
        .field_policy = FIELDS_ALL,
        .takes_telecentric = true,
    };
    if (question->clip && question->no_clip) {
        return fail(error, ERROR_USAGE, "{--clip} and {--no-clip} exclude each other");
    }
    if (!isnan(question->fnumber) && question->lens.lens->stop == LENS_NONE) {
        fail(error, ERROR_DOMAIN, "{--aperture}: the lens has no stop");
        return lens_hint_stop(error);
    }
    *one = (struct ray_case){.clip = !question->no_clip};
    if (!setup_open(&asked, arena, &one->setup, error) ||
        !lens_place_image(&one->setup, &question->focus, error)) {
        return false;
    }
    one->warning = lens_warnings_join(question->lens.warning, one->setup.warning, arena);
    one->warning = lens_warnings_join(one->warning, setup_stop_warning(&one->setup, arena), arena);
    if (one->clip) {
        one->warning = lens_warnings_join(
            one->warning, setup_width_warning(&one->setup, question->fnumber, arena), arena);
    }
    return set_target(&question->to, one, arena, error);
}

bool trace_is_explicit(const struct trace_input *input)
{
    bool any = input->point.is_given || input->direction.is_given;
    for (int i = 0; i < 3; i++) {
        any = any || !isnan(input->at[i]) || !isnan(input->cosine[i]);
    }
    return any;
}

/* Three numbers that belong together, or a vector. */
static bool read_three(const struct vector_value *vector, const double numbers[3], const char *name,
                       const char *names, double to[3], bool *found, struct error *error)
{
    bool any = !isnan(numbers[0]) || !isnan(numbers[1]) || !isnan(numbers[2]);
    bool all = !isnan(numbers[0]) && !isnan(numbers[1]) && !isnan(numbers[2]);
    if (any && vector->is_given) {
        return fail(error, ERROR_USAGE, "{--%s} and %s exclude each other", name, names);
    }
    if (any && !all) {
        return fail(error, ERROR_USAGE, "%s belong together: one of them is missing", names);
    }
    *found = any || vector->is_given;
    for (int i = 0; i < 3; i++) {
        to[i] = vector->is_given ? vector->at[i] : numbers[i];
    }
    return true;
}

/* Numbers that are of unit length but for rounding stay as they are: they are exact enough. */
static void trace_start_normalise(double cosine[3])
{
    double square = cosine[0] * cosine[0] + cosine[1] * cosine[1] + cosine[2] * cosine[2];
    if (fabs(square - 1) <= 4 * DBL_EPSILON) {
        return;
    }
    double largest = fmax(fmax(fabs(cosine[0]), fabs(cosine[1])), fabs(cosine[2]));
    double a = cosine[0] / largest, b = cosine[1] / largest, c = cosine[2] / largest;
    double length = sqrt(a * a + b * b + c * c);
    cosine[0] = a / length;
    cosine[1] = b / length;
    cosine[2] = c / length;
}

bool trace_start(const struct trace_input *input, struct ray *ray, struct error *error)
{
    bool has_point, has_direction;
    *ray = (struct ray){.status = RAY_OK};
    if (!read_three(&input->point, input->at, "point", "x, y and z", ray->point, &has_point,
                    error) ||
        !read_three(&input->direction, input->cosine, "direction", "cos_x, cos_y and cos_z",
                    ray->cosine, &has_direction, error)) {
        return false;
    }
    if (!has_point) {
        return fail(error, ERROR_USAGE, "the ray has a direction and no point to start from");
    }
    if (trace_has_field(input)) {
        return fail(error, ERROR_USAGE, "give a ray or a field, not both");
    }
    if (!has_direction) {
        ray->cosine[0] = ray->cosine[1] = 0;
        ray->cosine[2] = 1;
    }
    const double *c = ray->cosine;
    double square = c[0] * c[0] + c[1] * c[1] + c[2] * c[2];
    if (!(fmax(fmax(fabs(c[0]), fabs(c[1])), fabs(c[2])) > 0)) {
        return fail(error, ERROR_DOMAIN, "the direction of the ray is 0:0:0");
    }
    if (!input->direction.is_given && !(fabs(square - 1) <= 2e-3)) {
        fail(error, ERROR_DOMAIN, "cos_x, cos_y, cos_z have the length %.6g: it must be 1 +- 0.001",
             sqrt(square));
        return error_hint(error, "{--direction} takes a vector of any length");
    }
    trace_start_normalise(ray->cosine);
    return true;
}
