/* light/bands.c - lights and surfaces as numbers in bands. */
/* SPDX-License-Identifier: MIT */
#include "light/bands.h"

#include "light/bands_many.h"
#include "light/bands_match.h"
#include "light/colour.h"
#include "light/illuminant.h"
#include "light/observer.h"

#include <math.h>

/* -------- three bands -------- */

/* Linear sRGB of a light, or of what a surface reflects of it. */
static void rgb_of(const struct spectrum *light, const struct spectrum *surface, double rgb[3])
{
    static const double edges[2] = {OBSERVER_LEAST, OBSERVER_MOST};
    double xyz[1][3];
    observer_sum(light, surface, edges, 1, xyz);
    bands_rgb_of_sum(xyz[0], rgb);
}

void bands_three(struct bands *bands)
{
    const struct spectrum white = spectrum_white();
    *bands = (struct bands){.count = 3};
    rgb_of(&white, NULL, bands->white);
    for (int k = 0; k < 3; k++) {
        bands->wavelength[k] = (double)NAN;
        bands->rgb[k][k] = bands->basis[k][k] = 1;
    }
}

/*
 * The same with D65 as white (1, 1, 1): the white of sRGB is that of its standard, rounded, a few
 * 1e-4 beside the sums.
 */
static void white_rgb_of(const struct bands *bands, const struct spectrum *light,
                         const struct spectrum *surface, double rgb[3])
{
    rgb_of(light, surface, rgb);
    for (int i = 0; i < 3; i++) {
        rgb[i] /= bands->white[i];
    }
}

/* Are the bands red, green and blue? */
static bool is_three(const struct bands *bands)
{
    return isnan(bands->wavelength[0]);
}

/* A colour of sRGB, of surfaces or of lights, in the bands. */
static void spread_rgb(const struct bands *bands, const double rgb[3], double of[BANDS_MOST])
{
    for (size_t k = 0; k < bands->count; k++) {
        const double *basis = bands->basis[k];
        of[k] = rgb[0] * basis[0] + rgb[1] * basis[1] + rgb[2] * basis[2];
    }
}

/* -------- surfaces -------- */

static bool check_shares(const struct spectrum *surface, struct error *error)
{
    const bool is_rgb = surface->kind == SPECTRUM_RGB;
    if (!spectrum_check(surface, error)) {
        return false;
    }
    if (!is_rgb && surface->kind != SPECTRUM_TABLE) {
        return fail(error, ERROR_DOMAIN, "a surface has the spectrum of a light");
    }
    const double *shares = is_rgb ? surface->rgb : surface->value;
    for (size_t i = 0; i < (is_rgb ? 3 : surface->count); i++) {
        if (!(shares[i] <= 1)) {
            return fail(error, ERROR_DOMAIN, "a surface reflects %.6g of the light; at most is 1",
                        shares[i]);
        }
    }
    return true;
}

bool bands_of_surface(const struct bands *bands, const struct spectrum *surface,
                      double of[BANDS_MOST], double *held, struct error *error)
{
    const struct spectrum white = spectrum_white();
    double share = 1;
    if (!check_shares(surface, error)) {
        return false;
    }
    if (surface->kind == SPECTRUM_RGB) {
        spread_rgb(bands, surface->rgb, of);
    } else if (is_three(bands)) {
        white_rgb_of(bands, &white, surface, of);
        const double grey = fmin(colour_luminance(of), 1);
        share = colour_share_within(of, grey, 1);
        colour_move_from_grey(of, grey, share);
    } else {
        bands_ratios(bands, &white, surface, of);
    }
    if (held != NULL) {
        *held = share;
    }
    return true;
}

/* -------- lights -------- */

/* In bands, of any luminance; three may be negative. Result: the luminance. */
static double light_parts(const struct bands *bands, const struct spectrum *light,
                          double of[BANDS_MOST])
{
    if (light->kind == SPECTRUM_RGB) {
        spread_rgb(bands, light->rgb, of);
        return colour_luminance(light->rgb);
    }
    if (is_three(bands)) {
        white_rgb_of(bands, light, NULL, of);
        return colour_luminance(of);
    }
    bands_ratios(bands, light, NULL, of);
    return bands_whole(light).part[1];
}

bool bands_of_light(const struct bands *bands, const struct spectrum *light, double of[BANDS_MOST],
                    double *held, struct error *error)
{
    double share = 1;
    if (!spectrum_check(light, error)) {
        return false;
    }
    const double amount = light_parts(bands, light, of);
    if (!(amount > 0 && 1 / amount < (double)INFINITY)) {
        return fail(error, ERROR_DOMAIN,
                    "the spectrum of the light has nothing between %g and %g um: no eye sees it",
                    OBSERVER_LEAST, OBSERVER_MOST);
    }
    for (size_t k = 0; k < bands->count; k++) {
        of[k] /= amount;
    }
    if (is_three(bands)) {
        share = colour_share_within(of, 1, (double)INFINITY);
        colour_move_from_grey(of, 1, share);
    } else if (light->kind != SPECTRUM_RGB) {
        bands_match(bands, light, of);
    }
    if (held != NULL) {
        *held = share;
    }
    return true;
}
