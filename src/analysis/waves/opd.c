/* analysis/waves/opd.c - the reference sphere of an image point and optical path differences to it. */
/* SPDX-License-Identifier: MIT */
#include "analysis/waves/opd.h"

#include <math.h>
#include <string.h>

static bool arrives(const struct ray *ray)
{
    return ray->status == RAY_OK || ray->status == RAY_CLIPPED;
}

static double opd_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Along the chief ray to the pupil's plane; infinite where it never gets there. */
static double way_to_pupil(const struct ray *chief, double pupil)
{
    double way = (pupil - chief->point[2]) / chief->cosine[2];
    return isfinite(way) ? way : INFINITY;
}

bool opd_sphere(const struct ray *chief, double pupil, double n, const double centre[3],
                struct opd_reference *reference, struct error *error)
{
    if (!arrives(chief)) {
        return fail(error, ERROR_DOMAIN, "the chief ray is lost: there is no reference sphere");
    }
    double way = way_to_pupil(chief, pupil), to_pupil[3];
    *reference = (struct opd_reference){.n = n, .radius = INFINITY, .side = 1};
    memcpy(reference->centre, centre != NULL ? centre : chief->point, sizeof reference->centre);
    if (isinf(way)) {
        return true;
    }
    for (int i = 0; i < 3; i++) {
        to_pupil[i] = chief->point[i] - reference->centre[i] + way * chief->cosine[i];
    }
    memcpy(reference->pupil, to_pupil, sizeof reference->pupil);
    reference->radius = sqrt(opd_dot(to_pupil, to_pupil));
    reference->side = opd_dot(to_pupil, chief->cosine) > 0 ? -1 : 1;
    if (!(reference->radius > 0)) {
        return fail(error, ERROR_DOMAIN,
                    "the exit pupil lies in the image plane: there is no reference sphere");
    }
    return true;
}

bool opd_plane(const struct ray *chief, double pupil, double n, struct opd_reference *reference,
               struct error *error)
{
    if (!arrives(chief)) {
        return fail(error, ERROR_DOMAIN, "the chief ray is lost: there is no reference plane");
    }
    double way = way_to_pupil(chief, pupil);
    *reference = (struct opd_reference){.n = n, .is_plane = true, .side = 1};
    reference->plane_way = isinf(way) ? 0 : way;
    memcpy(reference->centre, chief->point, sizeof reference->centre);
    memcpy(reference->normal, chief->cosine, sizeof reference->normal);
    return true;
}

/* q = |D x e|^2 of a sphere's ray, from D and e. */
static double square_across(const double from[3], const double e[3])
{
    const double across[3] = {from[1] * e[2] - from[2] * e[1], from[2] * e[0] - from[0] * e[2],
                              from[0] * e[1] - from[1] * e[0]};
    return opd_dot(across, across);
}

/* sqrt(R^2 - q) */
static double half_chord(double radius, double q)
{
    return sqrt((radius - sqrt(q)) * (radius + sqrt(q)));
}

double opd_path(const struct opd_reference *reference, const struct ray *ray)
{
    if (!arrives(ray)) {
        return NAN;
    }
    if (reference->is_plane) {
        const double *d = reference->normal, *e = ray->cosine;
        double back[3], turn[3];
        for (int i = 0; i < 3; i++) {
            back[i] = reference->centre[i] - ray->point[i];
            turn[i] = d[i] - e[i];
        }
        double way =
            (opd_dot(back, d) + reference->plane_way * opd_dot(turn, turn) / 2) / opd_dot(d, e);
        return ray->path + reference->n * way;
    }
    const double *e = ray->cosine;
    double from[3];
    for (int i = 0; i < 3; i++) {
        from[i] = ray->point[i] - reference->centre[i];
    }
    double q = square_across(from, e), R = reference->radius;
    double bulge = isinf(R) ? 0 : q / (R + half_chord(R, q));
    return ray->path - reference->n * (opd_dot(from, e) - reference->side * bulge);
}

void opd_path_by_centre(const struct opd_reference *reference, const struct ray *ray,
                        double slope[3])
{
    const double *e = ray->cosine, n = reference->n, R = reference->radius;
    double from[3];
    for (int i = 0; i < 3; i++) {
        from[i] = ray->point[i] - reference->centre[i];
        slope[i] = arrives(ray) ? n * e[i] : (double)NAN;
    }
    if (isinf(R)) {
        return;
    }
    const double q = square_across(from, e), S = half_chord(R, q), along = opd_dot(from, e);
    for (int i = 0; i < 3; i++) {
        const double bulge =
            reference->pupil[i] * q / (R * S * (R + S)) + (along * e[i] - from[i]) / S;
        slope[i] += n * reference->side * bulge;
    }
}
