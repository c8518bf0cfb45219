/* photo/sky_object.c - how large things in the sky are, and their images. */
/* SPDX-License-Identifier: MIT */
#include "photo/sky_object.h"

#include "base/constants.h"

#include <math.h>

const struct word sky_objects[] = {
    {"none", "no object"},
    {"moon", "31.1 arcmin at its mean distance"},
    {"sun", "32.0 arcmin at its mean distance"},
    {"mercury", "11.0 arcsec between Earth and Sun"},
    {"venus", "60.3 arcsec between Earth and Sun"},
    {"mars", "17.9 arcsec at a mean opposition"},
    {"jupiter", "46.9 arcsec at a mean opposition"},
    {"saturn", "19.5 arcsec at a mean opposition, without its rings"},
    {"saturn-rings", "44.2 arcsec at a mean opposition, to the edge of the A ring"},
    {"uranus", "3.9 arcsec at a mean opposition"},
    {"neptune", "2.4 arcsec at a mean opposition"},
    {"andromeda", "178 arcmin, the galaxy M31"},
    {"triangulum", "73 arcmin, the galaxy M33"},
    {"whirlpool", "11 arcmin, the galaxy M51"},
    {"pleiades", "110 arcmin, the open cluster M45"},
    {"orion-nebula", "85 arcmin, the nebula M42"},
    {"hercules-cluster", "20 arcmin, the globular cluster M13"},
    {"dumbbell", "8 arcmin, the planetary nebula M27"},
    {"ring-nebula", "1.4 arcmin, the planetary nebula M57"},
    {NULL, NULL},
};

/* Of sun, moon and planets the equatorial radius and the distance, km; of others the angle. */
static const struct {
    double radius, distance;
    double arcmin;
} sizes[sizeof sky_objects / sizeof sky_objects[0]] = {
    [1] = {1738.1, 384400, 0},
    {695700, 149.6e6, 0},
    {2439.7, 149.6e6 - 57.9e6, 0},
    {6051.8, 149.6e6 - 108.2e6, 0},
    {3396.2, 227.9e6 - 149.6e6, 0},
    {71492, 778.3e6 - 149.6e6, 0},
    {60268, 1427.0e6 - 149.6e6, 0},
    {136775, 1427.0e6 - 149.6e6, 0},
    {25559, 2871.0e6 - 149.6e6, 0},
    {24764, 4497.1e6 - 149.6e6, 0},
    {.arcmin = 178},
    {.arcmin = 73},
    {.arcmin = 11},
    {.arcmin = 110},
    {.arcmin = 85},
    {.arcmin = 20},
    {.arcmin = 8},
    {.arcmin = 1.4},
};

double sky_angle(int object)
{
    const double arcmin = sizes[object].arcmin;
    return arcmin > 0 ? arcmin / 60 / DEGREES_PER_RADIAN
                      : 2 * asin(sizes[object].radius / sizes[object].distance);
}

double sky_distance(double size, double angle)
{
    return size / (2 * tan(angle / 2));
}

double sky_subtended(double size, double distance)
{
    return 2 * atan(size / (2 * distance));
}

bool sky_image(const struct fov_setting *setting, double angle, double *image, struct error *error)
{
    double height;
    if (!fov_height(setting->projection, angle / 2, &height, error)) {
        return false;
    }
    *image = 2 * fov_scale(setting) * height;
    return true;
}
