/* optics/refract.c - one spherical surface: conjugate points, and one ray exactly. */
/* SPDX-License-Identifier: MIT */
#include "optics/refract.h"

#include "base/constants.h"

#include <math.h>

double refract_power(const struct refract_surface *surface)
{
    double after = surface->mirror ? -surface->n : surface->n_after;
    return isinf(surface->R) ? 0 : (after - surface->n) / surface->R;
}

double refract_critical_angle(double n, double n_after)
{
    return n_after < n ? asin(n_after / n) : NAN;
}

double refract_brewster_angle(double n, double n_after)
{
    return atan(n_after / n);
}

bool refract_index_of(double n, double incidence, double refraction, double *n_after,
                      struct error *error)
{
    if (!(fabs(incidence) < PI / 2 && fabs(refraction) < PI / 2 && incidence * refraction > 0)) {
        return fail(error, ERROR_DOMAIN,
                    "an index follows from {angle} and {refracted} on the same side of the "
                    "normal, above 0 and below 90 deg");
    }
    *n_after = n * sin(incidence) / sin(refraction);
    return true;
}

double refract_condition(const struct refract_surface *surface)
{
    double V = isinf(surface->z) ? 0 : surface->n / surface->z;
    double P = refract_power(surface);
    double sum = fabs(V) + fabs(P);
    return sum > 0 && isfinite(sum) ? sum / fabs(V + P) : 1;
}

static bool refract_check_index(double n, const char *where, struct error *error)
{
    return isnan(n) || (n > 0 && isfinite(n)) ||
           fail(error, ERROR_DOMAIN,
                "index %s the surface %.6g is out of range: it must be above 0", where, n);
}

/* Exactly one of the five may be missing. */
static bool refract_check(const struct refract_surface *s, struct error *error)
{
    if (isnan(s->n) + isnan(s->n_after) + isnan(s->R) + isnan(s->z) + isnan(s->z_image) != 1) {
        return fail(error, ERROR_USAGE,
                    "one of the indices, the radius, the object and the image follows from the "
                    "other four: give four");
    }
    if (!refract_check_index(s->n, "before", error) ||
        (!s->mirror && !refract_check_index(s->n_after, "after", error))) {
        return false;
    }
    if (s->R == 0) {
        return fail(error, ERROR_DOMAIN, "radius 0 mm is not a surface: inf is a plane");
    }
    if ((s->z == 0 || s->z_image == 0) && !isnan(s->z) && !isnan(s->z_image)) {
        return fail(error, ERROR_DOMAIN,
                    "object or image in the vertex, at 0 mm: every surface images its vertex onto "
                    "itself, nothing follows from that");
    }
    return true;
}

/* n/z, 0 for infinity. */
static double refract_vergence(double n, double z)
{
    return isinf(z) ? 0 : n / z;
}

/* 1/a - 1/b */
static double reciprocal_difference(double a, double b)
{
    return isinf(a) || isinf(b) ? 1 / a - 1 / b + 0.0 /* not -0 */ : (b - a) / a / b;
}

/* n / V with the infinity that is meant where V is 0. */
static double point_at(double n, double V, double infinity)
{
    return V == 0 ? infinity : n / V;
}

/* The index on the side of point z from the one on the side of `other`. */
static bool refract_solve_index(double n, double other, double z, double R, double *found,
                                struct error *error)
{
    double near = reciprocal_difference(z, R), far = reciprocal_difference(other, R);
    if (near == 0) {
        return fail(error, ERROR_DOMAIN,
                    "point at the centre of curvature, %.6g mm: it is imaged onto itself whatever "
                    "the indices",
                    z);
    }
    *found = n * far / near;
    return (*found > 0 && !isinf(*found)) ||
           fail(error, ERROR_DOMAIN,
                "the index would be %.6g: it must be above 0 (a real object has a negative, a "
                "real image a positive coordinate)",
                *found);
}

bool refract_solve(struct refract_surface *s, struct error *error)
{
    if (s->mirror && !isnan(s->n)) {
        s->n_after = s->n;
    }
    if (s->mirror && isnan(s->n)) {
        return fail(error, ERROR_USAGE, "a mirror works the same in every medium: give the index");
    }
    if (!refract_check(s, error)) {
        return false;
    }
    double after = s->mirror ? -s->n : s->n_after;
    if (isnan(s->R)) {
        double power = refract_vergence(after, s->z_image) - refract_vergence(s->n, s->z);
        if (after == s->n) {
            return fail(error, ERROR_DOMAIN,
                        "equal indices %.6g on both sides: no radius has any effect", s->n);
        }
        s->R = point_at(after - s->n, power, INFINITY);
        return true;
    }
    if (isnan(s->n_after)) {
        return refract_solve_index(s->n, s->z, s->z_image, s->R, &s->n_after, error);
    }
    if (isnan(s->n)) {
        return refract_solve_index(after, s->z_image, s->z, s->R, &s->n, error);
    }
    double P = refract_power(s);
    if (!isfinite(P)) {
        return fail(error, ERROR_DOMAIN, "radius %.6g mm is too small for these indices", s->R);
    }
    if (isnan(s->z)) {
        s->z = s->z_image == 0 ? 0
                               : point_at(s->n, refract_vergence(after, s->z_image) - P, -INFINITY);
    } else {
        s->z_image = s->z == 0 ? 0 : point_at(after, refract_vergence(s->n, s->z) + P, INFINITY);
    }
    return true;
}

static double curvature(const struct refract_surface *s)
{
    return 1 / s->R; /* 0 for inf */
}

static bool refract_misses(const struct refract_surface *s, double height, struct error *error)
{
    return fail(
        error, ERROR_DOMAIN,
        "the ray misses the surface: at height %.6g mm it passes a sphere of radius %.6g mm",
        fabs(height), fabs(s->R));
}

/* Where a ray through y0 in the vertex plane, its slope in `ray`, meets the surface. */
static bool intersect(const struct refract_surface *s, double y0, struct refract_ray *ray,
                      struct error *error)
{
    double c = curvature(s);
    double G = ray->cos_u - c * y0 * ray->sin_u;
    double discriminant = (G - c * y0) * (G + c * y0);
    if (!(discriminant >= 0) || !(G > 0)) {
        return refract_misses(s, y0, error);
    }
    double t = c * y0 * y0 / (G + sqrt(discriminant));
    ray->height = y0 + t * ray->sin_u;
    ray->sag = t * ray->cos_u;
    return (fabs(c * ray->height) <= 1 && c * ray->sag <= 1) ||
           fail(error, ERROR_DOMAIN,
                "the ray misses the surface: it meets the sphere only beyond the hemisphere "
                "around the vertex");
}

/* The height is given: the point of the surface is known first. */
static bool place_height(const struct refract_surface *s, const struct refract_aim *aim,
                         struct refract_ray *ray, struct error *error)
{
    double c = curvature(s), h = aim->height;
    if (!(fabs(c * h) <= 1)) {
        return refract_misses(s, h, error);
    }
    ray->height = h;
    ray->sag = c * h * h / (1 + sqrt((1 - c * h) * (1 + c * h)));
    if (!isnan(aim->angle)) {
        ray->sin_u = sin(aim->angle);
        ray->cos_u = cos(aim->angle);
        if (aim->angle == 0) {
            ray->z = -INFINITY;
            ray->inverse_s = 0;
        } else {
            ray->z = ray->sag - h * ray->cos_u / ray->sin_u;
            ray->inverse_s = -ray->sin_u / h; /* infinite where the object is the vertex */
        }
        return true;
    }
    if (isinf(ray->z)) {
        ray->sin_u = ray->inverse_s = 0;
        ray->cos_u = 1;
        return true;
    }
    double distance = ray->sag - ray->z;
    if (distance == 0) {
        return fail(error, ERROR_DOMAIN,
                    "the object at %.6g mm lies straight below the point of the surface: no ray "
                    "through both makes an angle with the axis below 90 deg",
                    ray->z);
    }
    double rho = copysign(hypot(distance, h), distance);
    ray->sin_u = h / rho;
    ray->cos_u = distance / rho;
    ray->inverse_s = -1 / rho;
    return true;
}

/* Only the line of the ray is given: it must be cut with the surface. */
static bool place_line(const struct refract_surface *s, const struct refract_aim *aim,
                       struct refract_ray *ray, struct error *error)
{
    double y0 = aim->height;
    if (isnan(aim->angle)) {
        double slope = isinf(ray->z) ? 0 : -y0 / ray->z;
        if (!isfinite(slope)) {
            return fail(error, ERROR_DOMAIN,
                        "an object in the vertex sends no ray through height "
                        "%.6g mm of the vertex plane",
                        y0);
        }
        ray->cos_u = 1 / sqrt(1 + slope * slope);
        ray->sin_u = slope * ray->cos_u;
    } else {
        ray->sin_u = sin(aim->angle);
        ray->cos_u = cos(aim->angle);
        if (isnan(y0)) {
            y0 = ray->z == 0 ? 0 : -ray->z * (ray->sin_u / ray->cos_u);
        } else {
            ray->z = aim->angle == 0 ? -INFINITY : -y0 * ray->cos_u / ray->sin_u;
        }
    }
    if (!intersect(s, y0, ray, error)) {
        return false;
    }
    /* s cos U = z - sag */
    ray->inverse_s = isinf(ray->z) ? 0 : ray->cos_u / (ray->z - ray->sag);
    return true;
}

bool refract_place(const struct refract_surface *s, const struct refract_aim *aim,
                   struct refract_ray *ray, struct error *error)
{
    if (isnan(aim->height) + isnan(aim->angle) + isnan(s->z) != 1) {
        return fail(error, ERROR_USAGE,
                    "a ray follows from two of its height, its angle and the object: give two");
    }
    if (isinf(aim->height)) {
        return refract_misses(s, aim->height, error);
    }
    if (!isnan(aim->angle) && !(fabs(aim->angle) < PI / 2)) {
        return fail(error, ERROR_DOMAIN,
                    "angle %.6g deg is out of range: it must be above -90 to below 90 deg",
                    aim->angle * DEGREES_PER_RADIAN);
    }
    if (isinf(s->z) && !isnan(aim->angle)) {
        return fail(error, ERROR_DOMAIN,
                    "an object at infinity sends rays of angle 0: give a height instead, or height "
                    "and angle without an object");
    }
    if (s->z == 0 && isnan(aim->angle) && aim->height == 0) {
        return fail(error, ERROR_DOMAIN, "a ray from the vertex needs an angle, not a height");
    }
    ray->z = isinf(s->z) ? -INFINITY : s->z;
    bool on_surface = !isnan(aim->height) && !aim->at_vertex;
    if (!(on_surface ? place_height(s, aim, ray, error) : place_line(s, aim, ray, error))) {
        return false;
    }
    ray->slope = atan2(ray->sin_u, ray->cos_u);
    return true;
}

/* 1 - cos of an angle whose sine and cosine are known, without cancellation. */
static double versine(double sine, double cosine)
{
    return cosine > -0.5 ? sine * sine / (1 + cosine) : 1 - cosine;
}

/* crossing - z', see the header. K and Kp are n'/s' and n'/z', `gain` is G - (n' - n). */
static double longitudinal(const struct refract_surface *s, const struct refract_ray *ray,
                           double after, double K, double gain, double versine_after)
{
    double z = ray->z;
    double Kp = refract_vergence(s->n, z) + refract_power(s);
    if (z == 0) {
        return ray->height == 0 ? 0 : NAN;
    }
    if (K == 0 || Kp == 0) {
        return NAN;
    }
    double before =
        isinf(z) ? 0 : s->n * (z * versine(ray->sin_u, ray->cos_u) - ray->sag) / z / (z - ray->sag);
    double D = before - gain * curvature(s);
    return ray->sag + after * (D - versine_after * Kp) / K / Kp;
}

/*
 * Sine of the angle of incidence from sin U, so that an object at the centre is met without a rest;
 * from that of an object at infinity, where it is one. Of paraxial angles likewise.
 */
static double incidence_from(const struct refract_surface *s, double z, double sin_u, double far)
{
    if (isinf(z)) {
        return far;
    }
    return isinf(s->R) ? sin_u : sin_u * ((s->R - z) / s->R);
}

/* The paraxial ray to the same height. */
static void follow_paraxially(const struct refract_surface *s, double after,
                              struct refract_ray *ray)
{
    double h = ray->height, z = ray->z;
    double u = isinf(z) ? 0 : -h / z;
    if (z == 0) {
        u = h == 0 ? ray->sin_u / ray->cos_u : NAN;
    }
    ray->paraxial_slope = u;
    ray->paraxial_incidence = incidence_from(s, z, u, h / s->R);
    ray->paraxial_refraction = s->n * ray->paraxial_incidence / after;
    ray->paraxial_slope_after = (s->n * u - h * refract_power(s)) / after;
}

bool refract_through(const struct refract_surface *s, struct refract_ray *ray, struct error *error)
{
    double n = s->n, after = s->mirror ? -n : s->n_after, c = curvature(s);
    double sin_phi = c * ray->height;
    double cos_phi = sqrt((1 - sin_phi) * (1 + sin_phi));
    /* sin I from the distance of the ray from the centre, cos I from the angles */
    double sin_i = incidence_from(s, ray->z, ray->sin_u, sin_phi);
    double cos_i = ray->cos_u * cos_phi - ray->sin_u * sin_phi;
    if (!(cos_i >= 0)) {
        return fail(error, ERROR_DOMAIN,
                    "the ray misses the surface: at height %.6g mm the surface is turned away from "
                    "it",
                    ray->height);
    }
    ray->normal = asin(sin_phi);
    ray->incidence = atan2(sin_i, cos_i);
    double sin_after = n * sin_i / after;
    if (!(fabs(sin_after) <= 1)) {
        return fail(
            error, ERROR_DOMAIN,
            "total reflection: the angle of incidence %.6g deg is beyond the critical angle "
            "%.6g deg, asin(%.6g/%.6g)",
            fabs(ray->incidence) * DEGREES_PER_RADIAN, asin(after / n) * DEGREES_PER_RADIAN, after,
            n);
    }
    double cos_after = sqrt((1 - sin_after) * (1 + sin_after));
    ray->refraction = atan2(sin_after, cos_after);
    /* the oblique power G/R in place of (n' - n)/R */
    double sum = after * cos_after + n * cos_i;
    double G = after - n, gain = 0;
    if (s->mirror) {
        G = -2 * n * cos_i;
        gain = 2 * n * versine(sin_i, cos_i);
    } else if (sum > 0) {
        G *= (after + n) / sum;
        gain =
            (after - n) * (after * versine(sin_after, cos_after) + n * versine(sin_i, cos_i)) / sum;
    }
    double sin_u = (n * ray->sin_u - G * sin_phi) / after;
    double cos_u = (n * ray->cos_u + G * cos_phi) / after;
    ray->slope_after = atan2(sin_u, cos_u);
    /* the ray cuts the axis */
    double K = n * ray->inverse_s + G * c;
    ray->crossing = K == 0 ? INFINITY : ray->sag + after * cos_u / K;
    ray->difference = longitudinal(s, ray, after, K, gain, versine(sin_u, cos_u));
    ray->transverse = -ray->difference * sin_u / cos_u;
    follow_paraxially(s, after, ray);
    return true;
}
