/* photo/projector.c - throw, image size and brightness of a projector. */
/* SPDX-License-Identifier: MIT */
#include "photo/projector.h"

#include "base/constants.h"
#include "photo/given.h"

#include <math.h>

#define MM2_PER_M2 1e6

static bool projector_check(const struct projector *a, struct error *error)
{
    const struct given numbers[] = {
        {"throw ratio", "", a->throw_ratio},
        {"distance", " mm", a->distance},
        {"aspect ratio", "", a->aspect},
        {"width of the image", " mm", a->width},
        {"height of the image", " mm", a->height},
        {"diagonal of the image", " mm", a->diagonal},
        {"screen gain", "", a->gain},
        {"luminous flux", " lm", a->flux},
        {"illuminance", " lx", a->illuminance},
        {"luminance", " cd/m2", a->luminance},
    };
    if (is_given(a->width) + is_given(a->height) + is_given(a->diagonal) > 1) {
        return fail(error, ERROR_USAGE,
                    "give one of {width of the image}, {height of the image} and {diagonal of the "
                    "image}: {aspect ratio} gives the others");
    }
    if (is_given(a->illuminance) && is_given(a->luminance)) {
        return fail(error, ERROR_USAGE, "give one of {illuminance} and {luminance}");
    }
    return given_positive(numbers, sizeof numbers / sizeof numbers[0], error);
}

/* The width of the image, from whatever gives it; NaN: nothing does. */
static double projector_width(const struct projector *a)
{
    if (is_given(a->width)) {
        return a->width;
    }
    if (is_given(a->height)) {
        return a->height * a->aspect;
    }
    if (is_given(a->diagonal)) {
        return a->diagonal * (a->aspect / hypot(a->aspect, 1));
    }
    if (is_given(a->throw_ratio) && is_given(a->distance)) {
        return a->distance / a->throw_ratio;
    }
    return sqrt(a->flux / a->illuminance * MM2_PER_M2 * a->aspect);
}

bool projector_solve(struct projector *a, struct error *error)
{
    if (!projector_check(a, error)) {
        return false;
    }
    const bool has_size = is_given(a->width) || is_given(a->height) || is_given(a->diagonal);
    const bool has_throw = is_given(a->throw_ratio) && is_given(a->distance);
    if (is_given(a->luminance)) {
        a->illuminance = a->luminance * PI / a->gain;
    }
    const bool has_light = is_given(a->flux) && is_given(a->illuminance);
    if (has_size + has_throw + has_light > 1) {
        return fail(error, ERROR_USAGE,
                    has_light ? "image size, {luminous flux} and brightness: two of them give the "
                                "third, leave one out"
                              : "image size, {throw ratio} and {distance}: two of them give the "
                                "third, leave one out");
    }
    a->width = projector_width(a);
    if (!is_given(a->width)) {
        return fail(error, ERROR_USAGE,
                    "the image has no size: give {diagonal of the image}, {width of the image}, "
                    "{throw ratio} and {distance}, or {luminous flux} and a brightness");
    }
    a->height = a->width / a->aspect;
    a->diagonal = hypot(a->width, a->height);
    if (is_given(a->distance)) {
        a->throw_ratio = a->distance / a->width;
    } else {
        a->distance = a->throw_ratio * a->width;
    }
    const double area = a->width * a->height / MM2_PER_M2;
    if (is_given(a->illuminance)) {
        a->flux = a->illuminance * area;
    } else {
        a->illuminance = a->flux / area;
    }
    a->luminance = a->gain * a->illuminance / PI;
    return true;
}
