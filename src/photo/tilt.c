/* photo/tilt.c - tilted lens: Scheimpflug, hinge rule, wedge of sharpness, image circle. */
/* SPDX-License-Identifier: MIT */
#include "photo/tilt.h"

#include "base/constants.h"
#include "photo/given.h"

#include <float.h>
#include <math.h>

/* The tilt, given itself or by the hinge's depth. */
static bool solve_tilt(const struct tilt_given *g, double *tilt, struct error *error)
{
    if (isnan(g->tilt) == isnan(g->hinge)) {
        return fail(error, ERROR_USAGE, "give exactly one of {tilt} and {hinge}");
    }
    if (isnan(g->hinge)) {
        *tilt = g->tilt;
    } else if (fabs(g->hinge) >= g->f) {
        *tilt = asin(g->f / g->hinge);
    } else {
        return fail(error, ERROR_DOMAIN,
                    "{hinge} %g mm is nearer than any tilt can bring it with {focal length} %g mm "
                    "(above %g mm on either side)",
                    g->hinge, g->f, g->f);
    }
    return fabs(*tilt) < PI / 2 ||
           fail(error, ERROR_DOMAIN, "{tilt} %g degrees is out of range (-90 to 90, exclusive)",
                degrees_from_radians(*tilt));
}

/* f/v' from whichever of the three was given. */
static bool solve_ratio(const struct tilt_given *g, double tilt, double *ratio, struct error *error)
{
    int count = !isnan(g->image) + !isnan(g->distance) + !isnan(g->angle);
    if (count != 1) {
        return fail(
            error, ERROR_USAGE,
            "give exactly one of {image distance}, {distance} and {angle of the plane of focus}");
    }
    if (!isnan(g->image)) {
        *ratio = g->f / g->image;
        return check_positive("image distance", " mm", g->image, error);
    }
    if (!isnan(g->distance)) {
        if (!(g->distance > g->f / cos(tilt))) {
            return fail(error, ERROR_DOMAIN,
                        "{distance} %g mm lies within the focal length of the tilted lens: no real "
                        "image (more than f/cos(tilt) = %g mm)",
                        g->distance, g->f / cos(tilt));
        }
        *ratio = cos(tilt) - g->f / g->distance;
        return true;
    }
    double size = copysign(1, tilt) * g->angle;
    if (!(fabs(tilt) > 0)) {
        return fail(error, ERROR_DOMAIN,
                    "{angle of the plane of focus} needs a tilt: untilted, the plane of focus is "
                    "parallel to the sensor (a tilt other than 0)");
    }
    if (!(size > fabs(tilt) && size < PI)) {
        double sign = copysign(1, tilt);
        return fail(error, ERROR_DOMAIN,
                    "{angle of the plane of focus} %g degrees cannot be reached with this tilt "
                    "(between %g and %g)",
                    degrees_from_radians(g->angle), degrees_from_radians(tilt), sign * 180);
    }
    *ratio = sin(g->angle - tilt) / sin(g->angle);
    return true;
}

/* u where the line meets rise = y/u; inf where it doesn't, in front of the lens. */
static double tilt_reach(double f, double denominator)
{
    return denominator > 0 ? f / denominator : (double)INFINITY;
}

bool tilt_solve(const struct tilt_given *given, struct tilt *result, struct error *error)
{
    double tilt = NAN, ratio = NAN;
    if (!check_positive("focal length", " mm", given->f, error) ||
        !check_positive("f-number", "", given->N, error)) {
        return false;
    }
    if (!(given->c >= 0 && given->c < given->f / given->N)) {
        return fail(error, ERROR_DOMAIN,
                    "{circle of confusion} %g mm is not narrower than the aperture (0 or more, "
                    "below f/N = %g mm)",
                    given->c, given->f / given->N);
    }
    if (!solve_tilt(given, &tilt, error) || !solve_ratio(given, tilt, &ratio, error)) {
        return false;
    }
    double f = given->f, image = f / ratio, blur = given->N * given->c / f;
    double A = cos(tilt) - ratio, B = sin(tilt);
    if (!isnan(given->angle) && fabs(A) < 4 * DBL_EPSILON) {
        A = 0; /* rounding alone: the plane of focus is parallel to the sensor's normal */
    }
    double A_near = A + ratio * blur, A_far = A - ratio * blur;
    *result = (struct tilt){.f = f,
                            .N = given->N,
                            .c = given->c,
                            .tilt = tilt,
                            .hinge = f / B,
                            .image = isnan(given->image) ? image : given->image,
                            .distance = isnan(given->distance) ? tilt_reach(f, A) : given->distance,
                            .angle = isnan(given->angle) ? atan2(B, A) : given->angle,
                            .near_angle = atan2(B, A_near),
                            .far_angle = atan2(B, A_far),
                            .scheimpflug = image / tan(tilt),
                            .hyperfocal = f / blur,
                            .half_height = blur > 0 ? fabs(ratio * blur / B) : 0,
                            .A = A,
                            .A_near = A_near,
                            .A_far = A_far,
                            .B = B};
    return true;
}

bool tilt_through(double f, const struct tilt_point *first, const struct tilt_point *second,
                  double *tilt, double *image, struct error *error)
{
    if (!check_positive("focal length", " mm", f, error)) {
        return false;
    }
    if (!(first->distance > 0 && second->distance > 0)) {
        return fail(error, ERROR_DOMAIN,
                    "points at %g mm and %g mm: one is not in front of the lens (above 0 mm)",
                    first->distance, second->distance);
    }
    if (!(isfinite(first->rise) && isfinite(second->rise) &&
          fabs(second->rise - first->rise) > 0)) {
        return fail(error, ERROR_DOMAIN,
                    "both points lie in the same direction (slope %g): any tilt serves only one "
                    "of them (two directions)",
                    first->rise);
    }
    double sine = f * (1 / first->distance - 1 / second->distance) / (second->rise - first->rise);
    if (!(fabs(sine) < 1)) {
        return fail(error, ERROR_DOMAIN,
                    "the two points ask for a hinge %g mm from the lens, nearer than "
                    "{the focal length} %g mm (more than that)",
                    f / fabs(sine), f);
    }
    *tilt = asin(sine);
    double ratio = cos(*tilt) - f / first->distance - first->rise * sine;
    if (!(ratio > 0)) {
        return fail(error, ERROR_DOMAIN,
                    "no sensor position images both points: the plane through them lies within "
                    "{the focal length} %g mm (farther away)",
                    f);
    }
    *image = f / ratio;
    return true;
}

struct tilt_reach tilt_along(const struct tilt *camera, double rise)
{
    double D = camera->A - rise * camera->B;
    double D_near = camera->A_near - rise * camera->B;
    double D_far = camera->A_far - rise * camera->B;
    double top = camera->f / camera->image * camera->N * camera->c; /* f (f/v') (N c/f) */
    double front = D > 0 ? top / (D * D_near) : (double)INFINITY;
    double behind = D > 0 && D_far > 0 ? top / (D * D_far) : (double)INFINITY;
    return (struct tilt_reach){.sharp = tilt_reach(camera->f, D),
                               .near = tilt_reach(camera->f, D_near),
                               .far = tilt_reach(camera->f, D_far),
                               .front = front,
                               .behind = behind};
}

bool tilt_coverage(const struct tilt *camera, const struct tilt_frame *frame,
                   struct tilt_coverage *coverage, struct error *error)
{
    double width = frame->width, height = frame->height;
    if (!check_positive("sensor width", " mm", width, error) ||
        !check_positive("sensor height", " mm", height, error)) {
        return false;
    }
    double worst = 0, v = camera->image, sine = camera->B, cosine = cos(camera->tilt);
    for (int i = 0; i < 4; i++) {
        double x = frame->shift + (i & 1 ? width : -width) / 2;
        double y = -frame->rise + (i & 2 ? height : -height) / 2;
        double along = v * cosine + y * sine;
        if (!(along > 0)) {
            return fail(error, ERROR_DOMAIN,
                        "a corner of the frame lies beside the tilted lens: no image circle holds "
                        "it (less {tilt} than %g degrees)",
                        degrees_from_radians(camera->tilt));
        }
        worst = fmax(worst, hypot(x, y * cosine - v * sine) / along);
    }
    *coverage = (struct tilt_coverage){.angle = atan(worst), .circle = 2 * camera->f * worst};
    return true;
}

bool tilt_shift_limit(const struct tilt *camera, double circle, const struct tilt_frame *frame,
                      double *limit, struct error *error)
{
    double f = camera->f, image = camera->image, width = frame->width, height = frame->height;
    if (!check_positive("focal length", " mm", f, error) ||
        !check_positive("image distance", " mm", image, error)) {
        return false;
    }
    double radius = circle / 2 * (image / f);
    *limit = sqrt(radius * radius - width * width / 4) - height / 2;
    return *limit >= 0 ||
           fail(error, ERROR_DOMAIN,
                "{image circle} %g mm does not cover the frame %g x %g mm (%g mm or more)", circle,
                width, height, hypot(width, height) * (f / image));
}
