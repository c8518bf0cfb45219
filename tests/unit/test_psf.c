/* tests/unit/test_psf.c - inner loops of images of points; what is said of light beyond them. */
/* SPDX-License-Identifier: MIT */
#include "analysis/image/psf.h"
#include "analysis/image/psf_light.h"
#include "base/processor.h"
#include "check.h"
#include "lens_of.h"

#include <math.h>
#include <string.h>

enum { ROWS = 96 };

static const long double pi = 3.14159265358979323846264338327950288L;

/* Those that this processor has. */
static size_t sets(kernel_psf *list[3])
{
    size_t count = 0;
    list[count++] = kernel_psf_sse2;
    if (processor_has_avx2()) {
        list[count++] = kernel_psf_avx2;
    }
    if (processor_has_avx512()) {
        list[count++] = kernel_psf_avx512;
    }
    return count;
}

/* From four values of a cubic, three of which are 0, what it is at the first rows. */
static struct psf_steps cubic(void)
{
    struct psf_steps steps = {.rows = ROWS, .at = {2, 30, 60, 93}};
    for (int k = 0; k < PSF_NODES; k++) {
        double y[PSF_NODES];
        for (int j = 0; j < PSF_NODES; j++) {
            y[j] = 1;
            for (int m = 0; m < PSF_NODES; m++) {
                y[j] *= m == k ? 1 : (j - steps.at[m]) / (steps.at[k] - steps.at[m]);
            }
        }
        steps.differences[0][k] = y[0];
        steps.differences[1][k] = y[1] - y[0];
        steps.differences[2][k] = y[2] - 2 * y[1] + y[0];
        steps.differences[3][k] = y[3] - 3 * y[2] + 3 * y[1] - y[0];
    }
    return steps;
}

/* A sphere of 50 mm with 1700 waves a mm, and an image of 0.1 mm, off its middle. */
static void test_wavelet(void)
{
    kernel_psf *list[3];
    const struct psf_wavelet wavelet = {0.3, 0.25, 1700, 50, 4, -3};
    const struct psf_steps steps = cubic();
    double first[2][ROWS * PSF_LANES];
    for (size_t k = 0, count = sets(list); k < count; k++) {
        double re[ROWS * PSF_LANES] = {0}, im[ROWS * PSF_LANES] = {0}, worst = 0;
        const struct psf_strip strip = {0.02, -0.05, 0.001, re, im};
        list[k](&wavelet, &steps, &strip);
        for (int i = 0; i < ROWS * PSF_LANES; i++) {
            const long double x = strip.x + (i % PSF_LANES) * (long double)strip.pitch;
            const long double y = strip.y + (i / PSF_LANES) * (long double)strip.pitch;
            const long double more = x * x + y * y + 2 * (wavelet.bx * x + wavelet.by * y);
            const long double r = sqrtl(wavelet.radius * wavelet.radius + more);
            const long double angle =
                2 * pi * (wavelet.turns - wavelet.waves * (r - wavelet.radius));
            const long double size = wavelet.amplitude * wavelet.radius / r;
            worst = fmax(worst, fabs(re[i] - (double)(size * cosl(angle))));
            worst = fmax(worst, fabs(im[i] - (double)(size * sinl(angle))));
        }
        CHECK_NEAR(worst, 0, 2e-8, "a cubic leaves 1700 3/50^3 0.1^4/384 turns at most");
        if (k == 0) {
            memcpy(first[0], re, sizeof re);
            memcpy(first[1], im, sizeof im);
        }
        CHECK(memcmp(first[0], re, sizeof re) == 0 && memcmp(first[1], im, sizeof im) == 0);
    }
}

/*
 * Of an image that is too small the centroid of all light is told from its rays: 1.25 times as far
 * from the pixels' as theirs is. A paraboloid of f = 100 and 160 mm wide, open in a disc above its
 * middle, and a plane 0.02 mm behind the focus: a ray from the height h goes h/(100 - h^2/400) mm
 * aside a mm. By direction cosines the beam is 1.9 times as bright at the rim as in the middle.
 */
static void test_rays_centroid(bool turned)
{
    const double miss = 0.02;
    const int up = turned ? 0 : 1;
    struct arena arena = {0};
    struct lens lens = lens_of(turned ? "wavelength d\nobject inf\naperture stop\n"
                                        "surface -200 -100 mirror 160 k=-1 stop\n"
                                        "pass circle 82 decenter=38,0\n"
                                      : "wavelength d\nobject inf\naperture stop\n"
                                        "surface -200 -100 mirror 160 k=-1 stop\n"
                                        "pass circle 82 decenter=0,38\n",
                               &arena);
    struct setup setup = {0};
    struct error error = {0};
    struct psf psf = {0};
    const struct field_point axis = {FIELD_NONE, {0, 0}};
    const struct setup_question asked = {.lens = &lens, .wavelength = NAN, .fnumber = NAN};
    const struct plane_value plane = {PLANE_AT, -100 - miss};
    const struct psf_question question = {.bundle = {.setup = &setup, .field = &axis, .clip = true},
                                          .method = PSF_PLANE,
                                          .size = 64,
                                          .pitch = 0.0003};
    const bool found = setup_open(&asked, &arena, &setup, &error) &&
                       setup_place_image(&setup, &plane, &error) &&
                       psf_find(&question, &arena, &psf, &error);
    CHECK(found);
    if (!found) {
        printf("%s\n", error.message);
    }
    double sum = 0, area = 0;
    enum { STEPS = 400 };
    for (int i = 0; i < STEPS * STEPS; i++) {
        const double x = 80 * (2 * (i % STEPS + 0.5) / STEPS - 1);
        const double y = 80 * (2 * (i / STEPS + 0.5) / STEPS - 1), square = x * x + y * y;
        if (hypot(x, y - 38) <= 41) {
            area += 1;
            sum -= miss * y / (100 - square / 400);
        }
    }
    CHECK_RELATIVE(psf.centroid[up] + psf.centroid_error[up] / 1.25, sum / area, 0.0015,
                   "of all rays");
    CHECK_NEAR(psf.centroid[1 - up] + psf.centroid_error[1 - up] / 1.25, 0, 1e-9, "beside it");
    arena_free(&arena);
}

int main(void)
{
    test_rays_centroid(false);
    test_rays_centroid(true);
    test_wavelet();
    return check_report();
}
