/* optics/thin_lens.c - a thin lens or a spherical mirror from its conjugates. */
/* SPDX-License-Identifier: MIT */
#include "optics/thin_lens.h"

#include <math.h>

static struct pair thin_lens_vergence(double distance)
{
    return isinf(distance) ? pair_of(0) : pair_divide(pair_of(1), pair_of(distance));
}

static bool thin_lens_check(const struct thin_lens_given *given, struct error *error)
{
    const bool has_m = !isnan(given->magnification);
    const int count = !isnan(given->object) + !isnan(given->image) + has_m + !isnan(given->total);
    if (count != 2) {
        return fail(error, ERROR_USAGE,
                    "the focal length follows from two of {object}, {image} and "
                    "{magnification}: %s",
                    count < 2 ? "too little is given" : "one too many is given");
    }
    if (!isnan(given->total) && !has_m) {
        return fail(error, ERROR_USAGE,
                    "a distance from object to image wants {magnification} beside it for the "
                    "focal length");
    }
    if (given->object == 0 || given->image == 0) {
        return fail(error, ERROR_DOMAIN,
                    "object and image in the lens itself are the same for every focal length: "
                    "{%s} 0 says nothing",
                    given->object == 0 ? "object" : "image");
    }
    if (has_m && (given->magnification == 0 || isinf(given->magnification) ||
                  isinf(given->object) || isinf(given->image))) {
        return fail(error, ERROR_DOMAIN,
                    "a magnification gives a focal length beside a finite distance, and neither 0 "
                    "nor inf");
    }
    return isnan(given->total) || given->total > 0 ||
           fail(error, ERROR_DOMAIN,
                "{object} %.6g mm from the image is out of range: it must be above 0 mm",
                given->total);
}

bool thin_lens_power(const struct thin_lens_given *given, struct pair *power, struct error *error)
{
    if (!thin_lens_check(given, error)) {
        return false;
    }
    const struct pair m = pair_of(given->magnification), one = pair_of(1);
    if (!isnan(given->total)) {
        const struct pair square = pair_multiply(pair_subtract(one, m), pair_subtract(one, m));
        *power = pair_negate(pair_divide(square, pair_multiply(m, pair_of(given->total))));
        return true;
    }
    struct pair object = thin_lens_vergence(given->object);
    struct pair image = thin_lens_vergence(given->image);
    if (isnan(given->image)) {
        image = pair_negate(pair_divide(object, m)); /* s' = -m s */
    } else if (isnan(given->object)) {
        object = pair_negate(pair_multiply(image, m));
    }
    *power = pair_add(object, image);
    return true;
}
