/* tests/unit/test_wavefront_spectrum.c - wave fronts of several wavelengths together. */
/* SPDX-License-Identifier: MIT */
#include "analysis/waves/wavefront.h"
#include "base/constants.h"
#include "check.h"
#include "lens_of.h"

#include <math.h>

/* A mirror has no colour: out of focus W = a r^2, a = h^2/2 (1/f - 1/z) in mm, is a/wavelength. */
static void test_defocus(void)
{
    static const struct setup_wavelength lights[] = {
        {.wavelength = 0.6, .weight = 1}, {.wavelength = 0.5, .weight = 3}, {.wavelength = 0.4}};
    struct arena arena = {0};
    struct lens lens = lens_of("wavelength 600nm\nobject inf\naperture stop\n"
                               "surface -2000 -1000 mirror 10 k=-1 stop\n",
                               &arena);
    struct setup setup = {0};
    struct error error = {0};
    struct wavefront_source source;
    struct wavefront figures;
    const struct field_point axis = {FIELD_NONE, {0, 0}};
    const double z = 1010, a = 12.5 * (1 / 1000. - 1 / z);
    const struct setup_question asked = {
        .lens = &lens, .wavelength = NAN, .fnumber = NAN, .spectrum = lights, .spectrum_count = 3};
    const struct plane_value plane = {PLANE_AT, -z};
    const struct wavefront_question question = {
        .bundle = {.setup = &setup, .field = &axis, .clip = true}, .error = 1e-6};
    const bool found = setup_open(&asked, &arena, &setup, &error) &&
                       setup_place_image(&setup, &plane, &error) &&
                       wavefront_open(&question, &arena, &source, &error) &&
                       wavefront_find(&source, true, &arena, &figures, &error);
    CHECK(found);
    if (!found) {
        printf("%s\n", error.message);
        return;
    }
    const double red = a / 0.6e-3, green = a / 0.5e-3;
    const double mean_square = (red * red + 3 * green * green) / 4 / 12;
    CHECK_RELATIVE(figures.rms, sqrt(mean_square), 2e-4, "a/sqrt(12) of each, by weights");
    const double of_red = pow(sin(PI * red) / (PI * red), 2);
    const double of_green = pow(sin(PI * green) / (PI * green), 2);
    CHECK_RELATIVE(figures.strehl, (of_red / 0.36 + 3 * of_green / 0.25) / (1 / 0.36 + 3 / 0.25),
                   5e-4, "light as 1/wavelength^2 of each");
    CHECK(isnan(figures.pv) && isnan(figures.mean));
    CHECK(figures.has_converged && figures.error < 1e-5);
    CHECK_RELATIVE(figures.marechal, exp(-4 * PI * PI * mean_square), 5e-4, "of the mean square");
    arena_free(&arena);
}

int main(void)
{
    test_defocus();
    return check_report();
}
