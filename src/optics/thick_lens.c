/* optics/thick_lens.c - the thick lens: a focal length and two principal planes, for any ray. */
/* SPDX-License-Identifier: MIT */
#include "optics/thick_lens.h"

struct slope_ray thick_lens_map(const struct thick_lens *lens, struct slope_ray ray)
{
    double x = ray.x + lens->front * ray.p, y = ray.y + lens->front * ray.q;
    double u = ray.p, v = ray.q;
    double power = 1 / lens->focal, n = lens->index_object, m = lens->index_image;
    if (isfinite(lens->object)) {
        u = (ray.p * lens->object - ray.x) / (lens->object + lens->front);
        v = (ray.q * lens->object - ray.y) / (lens->object + lens->front);
    }
    double s = u * u + v * v;
    double d = s * (lens->distortion[0] + s * (lens->distortion[1] + s * lens->distortion[2]));
    struct slope_ray out = {.p = thick_lens_slope(power, n, m, ray.p + u * d, x),
                            .q = thick_lens_slope(power, n, m, ray.q + v * d, y)};
    out.x = x - lens->rear * out.p;
    out.y = y - lens->rear * out.q;
    return out;
}
