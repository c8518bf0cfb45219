/* photo/diffraction.c - the Airy disc, resolution, and MTF of a perfect lens. */
/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700 /* j1, in POSIX but not in C */
#include "photo/diffraction.h"

#include "base/constants.h"
#include "photo/given.h"

#include <math.h>

/* J1's first zero; beyond it (or pi, for a pixel) a factor may rise again. */
static const double j1_zero = 3.8317059702075123;

/* Empirical: 116 arc seconds for an aperture of 1 mm. */
static const double dawes_mm = 116 * (RADIANS_PER_DEGREE / 3600);

static double mm_from_um(double um)
{
    return um / 1000;
}

static bool diffraction_check_light(double wavelength, double m, double P, struct error *error)
{
    return check_positive("wavelength", " um", wavelength, error) &&
           check_not_negative("magnification", "", m, error) &&
           check_positive("pupil magnification", "", P, error);
}

static bool diffraction_check_setting(const struct diffraction_setting *s, struct error *error)
{
    return check_positive("f-number", "", s->N, error) &&
           diffraction_check_light(s->wavelength, s->m, s->P, error) &&
           check_not_negative("blur by defocus", " mm", s->blur, error) &&
           check_not_negative("pixel pitch", " mm", s->pitch, error);
}

/* Wavelength times working f-number, mm: the unit of everything here. */
static double airy_unit(const struct diffraction_setting *s)
{
    return mm_from_um(s->wavelength) * s->N * (1 + s->m / s->P);
}

bool diffraction_compute(const struct diffraction_setting *setting, struct diffraction *result,
                         struct error *error)
{
    if (!diffraction_check_setting(setting, error)) {
        return false;
    }
    double unit = airy_unit(setting);
    double radius = DIFFRACTION_AIRY_RADIUS * unit;
    *result = (struct diffraction){.working_fnumber = setting->N * (1 + setting->m / setting->P),
                                   .airy_diameter = 2 * radius,
                                   .airy_radius = radius,
                                   .cutoff = 1 / unit,
                                   .rayleigh = radius,
                                   .sparrow = DIFFRACTION_SPARROW * unit,
                                   .rayleigh_frequency = 1 / radius,
                                   .nyquist = 1 / (2 * setting->pitch)};
    return true;
}

/* a - sin a without cancellation; six terms leave less than 1e-17 of it for a <= 0.7. */
static double minus_sine(double a)
{
    if (a > 0.7) {
        return a - sin(a);
    }
    double q = a * a;
    double tail = 1 - q / 110 * (1 - q / 156 * (1 - q / 210));
    return a * q / 6 * (1 - q / 20 * (1 - q / 42 * (1 - q / 72 * tail)));
}

static double mtf_lens(double x)
{
    if (x >= 1) {
        return 0;
    }
    /* 2 t = 4 asin(...); rounding must not make it more than all the contrast there is */
    return fmin(1, minus_sine(4 * asin(sqrt((1 - x) / 2))) / PI);
}

static double mtf_defocus(double z)
{
    return z * z > 0 ? fabs(2 * j1(z) / z) : 1; /* 1 - z^2/8 */
}

static double mtf_pixel(double z)
{
    return z * z > 0 ? fabs(sin(z) / z) : 1; /* 1 - z^2/6 */
}

static struct diffraction_mtf mtf_factors(const struct diffraction_setting *s, double nu)
{
    struct diffraction_mtf mtf = {.lens = mtf_lens(airy_unit(s) * nu),
                                  .defocus = mtf_defocus(PI * s->blur * nu),
                                  .pixel = mtf_pixel(PI * s->pitch * nu)};
    mtf.total = mtf.lens * mtf.defocus * mtf.pixel;
    return mtf;
}

bool diffraction_mtf_at(const struct diffraction_setting *setting, double nu,
                        struct diffraction_mtf *mtf, struct error *error)
{
    *mtf = mtf_factors(setting, nu);
    return diffraction_check_setting(setting, error) &&
           check_not_negative("spatial frequency", " per mm", nu, error);
}

bool diffraction_frequency(const struct diffraction_setting *setting, double level, double *nu,
                           struct error *error)
{
    if (!diffraction_check_setting(setting, error)) {
        return false;
    }
    if (!(level > 0 && level < 1)) {
        return fail(error, ERROR_DOMAIN, "contrast %g is out of range (above 0, below 1)", level);
    }
    double low = 0;
    double high =
        fmin(1 / airy_unit(setting), fmin(j1_zero / (PI * setting->blur), 1 / setting->pitch));
    double middle = high / 2;
    while (low < middle && middle < high) { /* down to neighbouring numbers */
        if (mtf_factors(setting, middle).total > level) {
            low = middle;
        } else {
            high = middle;
        }
        middle = low + (high - low) / 2;
    }
    *nu = middle;
    return true;
}

bool diffraction_fnumber(double diameter, double wavelength, double m, double P, double *N,
                         struct error *error)
{
    *N = diameter / (2 * DIFFRACTION_AIRY_RADIUS * mm_from_um(wavelength) * (1 + m / P));
    return check_positive("diameter on the sensor", " mm", diameter, error) &&
           diffraction_check_light(wavelength, m, P, error);
}

bool diffraction_optimum(double spread, double wavelength, double m, double P,
                         struct diffraction_optimum *result, struct error *error)
{
    if (!check_positive("focus spread", " mm", spread, error) ||
        !diffraction_check_light(wavelength, m, P, error)) {
        return false;
    }
    double l = mm_from_um(wavelength);
    double working = sqrt(spread / (4 * DIFFRACTION_AIRY_RADIUS * l));
    double airy = 2 * DIFFRACTION_AIRY_RADIUS * l * working;
    *result = (struct diffraction_optimum){.fnumber = working / (1 + m / P),
                                           .working_fnumber = working,
                                           .airy_diameter = airy,
                                           .defocus = spread / (2 * working),
                                           .blur = hypot(airy, spread / (2 * working))};
    return true;
}

bool diffraction_focus_spread(double f, double near, double far, double *spread,
                              struct error *error)
{
    if (!check_positive("focal length", " mm", f, error)) {
        return false;
    }
    if (!(near > f && isfinite(near))) {
        return fail(error, ERROR_DOMAIN,
                    "{nearest point} %g mm lies within {the focal length} %g mm: no real image "
                    "(more than %g mm, finite)",
                    near, f, f);
    }
    if (!(far >= near)) {
        return fail(error, ERROR_DOMAIN,
                    "{farthest point} %g mm lies before {the nearest point} %g mm (%g mm or more)",
                    far, near, near);
    }
    *spread = f * f / (near - f) * (isinf(far) ? 1 : (far - near) / (far - f));
    return true;
}

double fnumber_from_na(double na, double m, double P)
{
    return m > 0 ? m / (2 * na * (1 + m / P)) : 1 / (2 * na);
}

bool diffraction_resolve(double diameter, double wavelength, struct diffraction_angles *angles,
                         struct error *error)
{
    if (!check_positive("entrance pupil", " mm", diameter, error) ||
        !check_positive("wavelength", " um", wavelength, error)) {
        return false;
    }
    double unit = mm_from_um(wavelength) / diameter;
    *angles = (struct diffraction_angles){.rayleigh = DIFFRACTION_AIRY_RADIUS * unit,
                                          .sparrow = DIFFRACTION_SPARROW * unit,
                                          .dawes = dawes_mm / diameter};
    return true;
}
