/* tests/unit/test_emulsion.c - characteristic curve, print and grain of a film. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "camera/sensor/emulsion.h"
#include "check.h"

static struct arena arena;
static struct error error;

/* ISO 6: 0.10 over base and fog at 0.8/S, 0.80 more 1.30 farther on; the ends; never back. */
static void test_curve(void)
{
    static const double speeds[] = {25, 100, 3200}, toes[] = {0.05, 0.2, 0.4};
    for (int i = 0; i < 9; i++) {
        struct negative negative = negative_plain(speeds[i / 3]);
        negative.toe = toes[i % 3];
        struct characteristic curve;
        CHECK(characteristic_open(&negative, &curve, &error));
        const double at = 0.8 / negative.speed;
        CHECK_NEAR(characteristic_density(&curve, at), 0.35, 1e-12, "speed point");
        CHECK_NEAR(characteristic_density(&curve, at * pow(10, 1.3)), 1.15, 1e-12, "contrast");
        CHECK(characteristic_density(&curve, 0) == 0.25);
        CHECK_NEAR(characteristic_density(&curve, 1e-300), 0.25, 1e-12, "no light");
        CHECK_NEAR(characteristic_density(&curve, 1e300), 2.5, 1e-12, "much light");
        double before = 0;
        for (int k = -60; k <= 60; k++) {
            const double density = characteristic_density(&curve, pow(10, k / 10.0));
            CHECK(density >= before);
            before = density;
        }
    }
}

/* Both conditions solved by mpmath for the plain negative: gamma, and where the toe ends. */
static void test_solution(void)
{
    struct negative negative = negative_plain(80); /* its speed point is 0.01 lx s */
    struct characteristic curve;
    CHECK(characteristic_open(&negative, &curve, &error));
    CHECK_RELATIVE(curve.gradient, 0.684435578392, 1e-11, "gamma");
    CHECK_NEAR(curve.toe_at, -2 - 0.0146832979409, 1e-11, "toe");
    CHECK_NEAR(curve.shoulder_at, curve.toe_at + 2.25 / 0.684435578392, 1e-10, "shoulder");
}

/* Grey is 0.18; where the curve is straight twice the exposure is twice the light. */
static void test_print(void)
{
    struct negative negative = negative_plain(100);
    negative.most = 4;
    negative.toe = 0.05;
    struct characteristic curve;
    CHECK(characteristic_open(&negative, &curve, &error));
    const double grey = characteristic_print(&curve, characteristic_density(&curve, 0.1));
    const double light = characteristic_print(&curve, characteristic_density(&curve, 0.4));
    CHECK_RELATIVE(grey, 0.18, 1e-14, "grey");
    CHECK_RELATIVE(light, 0.72, 1e-6, "two stops more");
    CHECK(characteristic_print(&curve, 0.25) < 0.18 / 4 && characteristic_print(&curve, 4) > 1);
    /* lg(0.1/0.008) + 0.014683 = 1.111593 is (D - base)/gamma, but for 2e-4 of the toe */
    negative = negative_plain(100);
    CHECK(characteristic_open(&negative, &curve, &error));
    CHECK_RELATIVE(characteristic_print(&curve, 0.25), 0.18 * pow(10, -1.111593), 3e-3, "black");
}

/* Deviation of the density over pixels, within 4 sigma; a pixel of the frame has its own chance. */
static void test_grain(void)
{
    enum { SIDE = 200 };
    struct negative negative = negative_plain(100);
    struct emulsion film = {.granularity = 17, .pitch = 0.01, .seed = 3};
    CHECK(characteristic_open(&negative, &film.curve, &error));
    CHECK_RELATIVE(characteristic_grain(&film.curve, 17, PI * 0.024 * 0.024, 1.25), 0.017, 1e-14,
                   "as stated");
    struct image light = {.width = SIDE, .height = SIDE, .channels = 3}, density, part;
    const struct sensor_place whole = {0, 0, SIDE}, crop = {50, 60, SIDE};
    CHECK(image_new(&light, &arena, &error));
    for (size_t i = 0; i < (size_t)SIDE * SIDE * 3; i++) {
        light.pixels[i] = 0.2F;
    }
    CHECK(emulsion_expose(&film, &light, &whole, &arena, &density, &error));
    double sum = 0, sum2 = 0;
    const double mean = characteristic_density(&film.curve, (double)0.2F);
    for (size_t i = 0; i < (size_t)SIDE * SIDE; i++) {
        const double d = (double)density.pixels[i] - mean;
        sum += d;
        sum2 += d * d;
    }
    const double sigma = 0.017 * sqrt(PI * 0.024 * 0.024 / 1e-4) * sqrt(mean - 0.25);
    CHECK_NEAR(sum / (SIDE * SIDE), 0, 4 * sigma / SIDE, "mean");
    CHECK_RELATIVE(sqrt(sum2 / (SIDE * SIDE)), sigma, 4 / sqrt(2.0) / SIDE, "grain");
    light.width = light.height = 4;
    CHECK(emulsion_expose(&film, &light, &crop, &arena, &part, &error));
    CHECK(part.pixels[5] == density.pixels[61 * SIDE + 51]);
    film.granularity = 0;
    CHECK(emulsion_expose(&film, &light, &crop, &arena, &part, &error));
    CHECK(part.channels == 1 && part.pixels[0] == (float)mean && part.pixels[15] == (float)mean);
    emulsion_print(&film, &part);
    CHECK_RELATIVE((double)part.pixels[3], characteristic_print(&film.curve, (double)(float)mean),
                   1e-6, "print");
    light.pixels[1] = -1;
    CHECK(!emulsion_expose(&film, &light, &crop, &arena, &part, &error));
}

static void refused(double speed, double base, double most, double toe)
{
    const struct negative negative = {speed, base, most, toe};
    struct characteristic curve;
    CHECK(!characteristic_open(&negative, &curve, &error) && error.code == ERROR_DOMAIN);
}

int main(void)
{
    test_curve();
    test_solution();
    test_print();
    test_grain();
    refused(0, 0.25, 2.5, 0.2);
    refused(NAN, 0.25, 2.5, 0.2);
    refused(100, -0.1, 2.5, 0.2);
    refused(100, 0.25, 1.2, 0.2);
    refused(100, 0.25, 2.5, 0.01);
    refused(100, 0.25, 2.5, 0.5);
    refused(100, 0.25, 1.25, 0.4); /* no steepness brings it to 0.9 of 1 in that span */
    arena_free(&arena);
    return check_report();
}
