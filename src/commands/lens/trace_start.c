/* commands/lens/trace_start.c - where a ray starts that is given by point and direction. */
/* SPDX-License-Identifier: MIT */
#include "commands/lens/trace_answer.h"

#include <float.h>

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
