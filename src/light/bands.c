/* light/bands.c - lights and surfaces as numbers in bands. */
/* SPDX-License-Identifier: MIT */
#include "light/bands.h"

#include "light/bands_match.h"
#include "light/illuminant.h"
#include "light/observer.h"

#include <math.h>

/* -------- many bands -------- */

/*
 * Shares that surfaces of red and green reflect, row by row of the observer's wavelengths; blue is
 * what they leave of 1: the smoothest that look so under D65, of our own programme, which
 * tests/truth/check_basis.py solves. [Mallett19] 3
 */
/* clang-format off */
static const double primaries[OBSERVER_ROWS][2] = {
    {0.025135, 0}, {0.025135, 0}, {0.025135, 0}, {0.025133, 0}, {0.025131, 0}, {0.025126, 0},
    {0.025117, 0}, {0.025101, 0}, {0.025068, 0}, {0.024997, 0}, {0.024865, 0}, {0.024617, 0},
    {0.024173, 0}, {0.023426, 0}, {0.02233, 0}, {0.021004, 0}, {0.019785, 0}, {0.019322, 0},
    {0.020556, 0}, {0.024813, 0}, {0.029419, 0.008395}, {0.023744, 0.050013}, {0.012768, 0.118442},
    {0.002693, 0.204895}, {0, 0.300651}, {0, 0.402755}, {0, 0.507639}, {0, 0.611255}, {0, 0.70991},
    {0, 0.799963}, {0, 0.877614}, {0, 0.939043}, {0, 0.980745}, {0, 1}, {0, 1}, {0, 1}, {0, 1},
    {0, 1}, {0, 1}, {0, 1}, {0, 0.996671}, {0, 0.97606}, {0.035188, 0.92368}, {0.111217, 0.84004},
    {0.217406, 0.733814}, {0.342725, 0.613948}, {0.475966, 0.489442}, {0.607275, 0.368188},
    {0.728052, 0.257118}, {0.831306, 0.161846}, {0.911838, 0.08649}, {0.966537, 0.033463},
    {0.995436, 0.004564}, {1, 0}, {1, 0}, {1, 0}, {1, 0}, {1, 0}, {1, 0}, {1, 0}, {1, 0}, {1, 0},
    {1, 0}, {1, 0}, {1, 0}, {1, 0}, {1, 0}, {1, 0}, {1, 0}, {1, 0}, {1, 0}, {1, 0}, {1, 0}, {1, 0},
    {1, 0}, {1, 0}, {1, 0}, {1, 0}, {1, 0}, {1, 0}, {1, 0}, {1, 0}, {1, 0}, {1, 0}, {1, 0}, {1, 0},
    {1, 0}, {1, 0}, {1, 0}, {1, 0}, {1, 0}, {1, 0}, {1, 0}, {1, 0}, {1, 0},
};
/* clang-format on */

/* Linear sRGB of sums over the spectrum, see observer_sum; white as IEC's matrix has it. */
static void bands_rgb_of_sum(const double xyz[3], double rgb[3])
{
    const struct colour_matrix to_srgb = colour_inverse(&colour_xyz_of_srgb);
    const struct colour colour = colour_turned(&to_srgb, (struct colour){{xyz[0], xyz[1], xyz[2]}});
    for (int i = 0; i < 3; i++) {
        rgb[i] = colour.part[i];
    }
}

/* -------- stretches of the spectrum -------- */

static double band_edge(size_t count, size_t k)
{
    return BANDS_FIRST + (BANDS_LAST - BANDS_FIRST) * (double)k / (double)count;
}

static void band_sums(size_t count, const struct spectrum *light, const struct spectrum *surface,
                      double (*xyz)[3])
{
    double edges[BANDS_MOST + 1];
    for (size_t k = 1; k < count; k++) {
        edges[k] = band_edge(count, k);
    }
    edges[0] = OBSERVER_LEAST;
    edges[count] = OBSERVER_MOST;
    observer_sum(light, surface, edges, count, xyz);
}

/*
 * Light in bands, perhaps reflected by a surface, with D65 as 1 in each: each is the middle of its
 * stretch, the first and the last also hold what is seen beyond. `of` receives the ratio of sum
 * x + y + z of a band to that of D65.
 */
static void bands_ratios(const struct bands *bands, const struct spectrum *light,
                         const struct spectrum *surface, double of[BANDS_MOST])
{
    double xyz[BANDS_MOST][3];
    band_sums(bands->count, light, surface, xyz);
    for (size_t k = 0; k < bands->count; k++) {
        of[k] = (xyz[k][0] + xyz[k][1] + xyz[k][2]) / bands->white[k];
    }
}

/* -------- colours of sRGB -------- */

/* Of surfaces of a primary: shares of each band. */
static void set_basis(struct bands *bands, size_t primary)
{
    double wavelength[OBSERVER_ROWS], value[OBSERVER_ROWS], of[BANDS_MOST];
    for (size_t i = 0; i < OBSERVER_ROWS; i++) {
        wavelength[i] = OBSERVER_LEAST + OBSERVER_STEP * (double)i;
        value[i] = primaries[i][primary];
    }
    const struct spectrum surface = {
        .kind = SPECTRUM_TABLE, .count = OBSERVER_ROWS, .wavelength = wavelength, .value = value};
    const struct spectrum d65 = spectrum_white();
    bands_ratios(bands, &d65, &surface, of);
    for (size_t k = 0; k < bands->count; k++) {
        bands->basis[k][primary] = of[k];
    }
}

bool bands_many(size_t count, struct bands *bands, struct error *error)
{
    if (!(count >= BANDS_LEAST && count <= BANDS_MOST)) {
        return fail(error, ERROR_DOMAIN, "%zu bands of the spectrum; there may be %d to %d", count,
                    BANDS_LEAST, BANDS_MOST);
    }
    double xyz[BANDS_MOST][3];
    const struct spectrum d65 = spectrum_white();
    *bands = (struct bands){.count = count};
    band_sums(count, &d65, NULL, xyz);
    for (size_t k = 0; k < count; k++) {
        bands->wavelength[k] = (band_edge(count, k) + band_edge(count, k + 1)) / 2;
        bands->white[k] = xyz[k][0] + xyz[k][1] + xyz[k][2];
    }
    set_basis(bands, 0);
    set_basis(bands, 1);
    for (size_t k = 0; k < count; k++) {
        const double blue = 1 - bands->basis[k][0] - bands->basis[k][1];
        bands->basis[k][2] = blue > 0 ? blue : 0;
    }
    /*
     * Let the three primaries look as they should: means over a band take some of their saturation,
     * 0.5 % with 32 bands, which all colours get back here. X, Y and Z of each band get factors of
     * their own, near 1: a matrix that is the same for all would take more Y from violet, which has
     * hardly any, than there is.
     */
    for (int i = 0; i < 3; i++) {
        /*
         * The mixture of the primaries' shares by which X, Y or Z of each band must be multiplied
         * so that the primaries have it as they should.
         */
        const double *looks = colour_xyz_of_srgb.at[i];
        struct colour_matrix shared = {{{0}}};
        for (size_t k = 0; k < bands->count; k++) {
            const double *basis = bands->basis[k];
            for (int j = 0; j < 9; j++) {
                shared.at[j / 3][j % 3] += xyz[k][i] * basis[j / 3] * basis[j % 3];
            }
        }
        const struct colour_matrix back = colour_inverse(&shared);
        const struct colour mixture =
            colour_turned(&back, (struct colour){{looks[0], looks[1], looks[2]}});
        for (size_t k = 0; k < bands->count; k++) {
            const double *basis = bands->basis[k];
            xyz[k][i] *= mixture.part[0] * basis[0] + mixture.part[1] * basis[1] +
                         mixture.part[2] * basis[2];
        }
    }
    for (size_t k = 0; k < bands->count; k++) {
        bands_rgb_of_sum(xyz[k], bands->rgb[k]);
    }
    return true;
}

/* -------- surfaces and lights -------- */

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

bool bands_of_surface(const struct bands *bands, const struct spectrum *surface,
                      double of[BANDS_MOST], double *held, struct error *error)
{
    const struct spectrum white = spectrum_white();
    double share = 1;
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

size_t bands_needed(const struct spectrum *light, double most, double *off)
{
    size_t needed = BANDS_MOST;
    *off = (double)INFINITY;
    for (size_t count = BANDS_LEAST; count <= BANDS_MOST && !(*off <= most); count++) {
        struct bands bands;
        struct error error;
        double of[BANDS_MOST];
        if (!bands_many(count, &bands, &error) ||
            !bands_of_light(&bands, light, of, NULL, &error)) {
            continue;
        }
        const double next = bands_off(&bands, light, of);
        if (next < *off) {
            *off = next;
            needed = count;
        }
    }
    return needed;
}
