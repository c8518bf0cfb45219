/* tests/unit/test_acceptance.c - what pixels take of slanting light and of colours, by hand. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "camera/film/acceptance.h"
#include "camera/sensor/response.h"
#include "check.h"

static struct arena arena;
static struct error error;
static struct acceptance acceptance;

/* The weight of a ray that falls so many degrees aslant, in a medium of index n. */
static double weight(double degrees, double n)
{
    static struct film_samples samples;
    struct rays rays = rays_new(&arena, RAYS_BLOCK);
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        rays.blocks->p[i] = 0.6 * n * sin(degrees * RADIANS_PER_DEGREE);
        rays.blocks->q[i] = -0.8 * n * sin(degrees * RADIANS_PER_DEGREE);
        rays.blocks->r[i] = -n * cos(degrees * RADIANS_PER_DEGREE);
        samples.weight[i] = 0.5;
    }
    acceptance_weigh(&acceptance, rays.blocks, &samples);
    CHECK(samples.weight[0] == samples.weight[RAYS_BLOCK - 1]);
    return samples.weight[0] / 0.5;
}

static void test_powers(void)
{
    static const double powers[] = {0, 1, 2.5, 40};
    for (size_t i = 0; i < sizeof powers / sizeof *powers; i++) {
        CHECK(acceptance_power(powers[i], &acceptance, &error));
        CHECK_NEAR(weight(0, 1), 1, 1e-7, "straight");
        for (double angle = 5; angle < 80; angle += 13) {
            const double expected = pow(cos(angle * RADIANS_PER_DEGREE), powers[i]);
            CHECK_NEAR(weight(angle, 1), expected, 2e-6, "a power of the cosine");
            CHECK_NEAR(weight(angle, 1.33), expected, 2e-6, "in water");
        }
    }
    CHECK(!acceptance_power(-1, &acceptance, &error) && error.code == ERROR_DOMAIN);
    CHECK(!acceptance_power(100.5, &acceptance, &error));
    CHECK(!acceptance_power(NAN, &acceptance, &error));
}

static void test_table(void)
{
    const double angle[] = {0, 10 * RADIANS_PER_DEGREE, 40 * RADIANS_PER_DEGREE};
    const double taken[] = {1, 0.9, 0.3};
    CHECK(acceptance_table(angle, taken, 3, &acceptance, &error));
    CHECK_NEAR(weight(5, 1), 0.95, 1e-5, "between rows");
    CHECK_NEAR(weight(25, 1), 0.6, 1e-5, "between rows");
    CHECK_NEAR(weight(39.9, 1), 0.302, 1e-4, "at the end");
    CHECK_NEAR(weight(41, 1), 0, 1e-12, "beyond it");
    const double back[] = {0, 0.2, 0.1}, late[] = {0.1, 0.2, 0.3}, much[] = {1, 1.1, 0};
    CHECK(!acceptance_table(back, taken, 3, &acceptance, &error));
    CHECK(!acceptance_table(late, taken, 3, &acceptance, &error));
    CHECK(!acceptance_table(angle, much, 3, &acceptance, &error));
    CHECK(!acceptance_table(angle, taken, 1, &acceptance, &error));
}

/*
 * Photons of 1 lx s of 611, 549 and 464 nm over those of 555 nm: (l/555)/V, V of the CIE; times
 * the shares of red, green and blue in white: 0.2126, 0.7152, 0.0722.
 */
static void test_response(void)
{
    static const double photons[] = {0.47719963, 0.71259049, 0.85123218};
    const double nm[] = {0.4, 0.464, 0.549, 0.7};
    const double red[] = {0, 0, 0, 0.5}, green[] = {0, 0.1, 0.4, 0}, blue[] = {0, 0.5, 0, 0};
    struct response_table table = {3, 4, nm, {red, green, blue}, {"R", "G", "B"}};
    const struct sensor_response_traits *traits;
    CHECK(response_open(&table, &arena, &traits, &error));
    /* 611 nm lies 62/151 of the way from 549 to 700 nm */
    CHECK_RELATIVE(traits->seen->at[0][0], 0.5 * 62 / 151 * photons[0], 1e-7, "red of red");
    CHECK_RELATIVE(traits->seen->at[1][0], 0.4 * 89 / 151 * photons[0], 1e-7, "green of red");
    CHECK_RELATIVE(traits->seen->at[1][1], 0.4 * photons[1], 1e-7, "green of green");
    CHECK_RELATIVE(traits->seen->at[1][2], 0.1 * photons[2], 1e-7, "green of blue");
    CHECK_RELATIVE(traits->seen->at[2][2], 0.5 * photons[2], 1e-7, "blue of blue");
    CHECK(traits->reference == 1 && traits->channels == 3);
    table.channels = 2;
    CHECK(!response_open(&table, &arena, &traits, &error));
    table.channels = 1;
    CHECK(response_open(&table, &arena, &traits, &error) && traits->reference == 0);
    table.rows = 3; /* up to 549 nm */
    CHECK(!response_open(&table, &arena, &traits, &error) && error.code == ERROR_DOMAIN);
    CHECK_TEXT(error.message, "the response does not reach 611 nm");
    static const struct {
        double nm[2], efficiency[2];
        const char *message; /* null: none */
    } rows[] = {
        {{0.464, 0.611}, {0, 1}, NULL},
        {{0.465, 0.7}, {0, 1}, "the response does not reach 464 nm"},
        {{0.464, 0.6105}, {0, 1}, "the response does not reach 611 nm"},
        {{0.7, 0.4}, {0, 1}, "the wavelengths of a response must rise: 400 nm"},
        {{0.4, 0.4}, {0, 1}, "the wavelengths of a response must rise: 400 nm"},
        {{0.4, 0.7}, {0, 1.001}, "the efficiency 1.001 of 'R' at 700 nm is not from 0 to 1"},
        {{0.4, 0.7}, {-0.001, 1}, "the efficiency -0.001 of 'R' at 400 nm is not from 0 to 1"},
        {{0.4, 0.7}, {0, 0}, "'R' of the response sees nothing of 611, 549 and 464 nm"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const struct response_table two = {1, 2, rows[i].nm, {rows[i].efficiency}, {"R"}};
        CHECK(response_open(&two, &arena, &traits, &error) == (rows[i].message == NULL));
        if (rows[i].message != NULL) {
            CHECK_TEXT(error.message, rows[i].message);
        }
    }
}

int main(void)
{
    test_powers();
    test_table();
    test_response();
    arena_free(&arena);
    return check_report();
}
