/* tests/unit/test_air.c - air's index, and a glass far from its reference temperature. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "optics/air.h"

#include <stddef.h>

/* Dry air with 450 ppm CO2 at 633 nm, (n - 1) 1e8: [Ciddor96] table 1. */
static void test_table(void)
{
    static const struct {
        double temperature, pressure, refractivity;
    } rows[] = {{20, 80000, 21458.0},
                {20, 100000, 26824.4},
                {20, 120000, 32191.6},
                {10, 100000, 27774.7},
                {30, 100000, 25937.2}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const struct air air = {AIR_CIDDOR, rows[i].temperature, rows[i].pressure};
        /* his own density of air is within 4e-9 of Edlen's */
        CHECK_NEAR(1e8 * air_refractivity(&air, 0.633), rows[i].refractivity, 0.4, "table 1");
    }
}

/* The formulas of the header, worked out with 40 decimal digits. */
static void test_formulas(void)
{
    static const struct {
        struct air air;
        double wavelength, refractivity;
    } rows[] = {
        {{AIR_CIDDOR, 15, 101325}, 0.4, 0.0002827618234821788924},
        {{AIR_CIDDOR, 15, 101325}, 0.5875618, 0.0002771748469566318937},
        {{AIR_CIDDOR, 15, 101325}, 1.7, 0.0002731519892172747984},
        {{AIR_EDLEN, 15, 101325}, 0.4, 0.0002827476616035484068},
        {{AIR_EDLEN, 15, 101325}, 0.5875618, 0.0002771617502737445626},
        {{AIR_EDLEN, 15, 101325}, 1.7, 0.0002731438670974329978},
        {{AIR_EDLEN, -30, 60000}, 0.4, 0.0001984321472703110796},
        {{AIR_EDLEN, -30, 60000}, 1.7, 0.0001916922097762802491},
        {{AIR_KOHLRAUSCH, 25, 0.8 * 101325}, 0.4, 0.0002186002146750864168},
        {{AIR_KOHLRAUSCH, 25, 0.8 * 101325}, 0.5875618, 0.0002142761882007204917},
        {{AIR_KOHLRAUSCH, 25, 0.8 * 101325}, 1.7, 0.0002111604217685177975},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        CHECK_RELATIVE(air_refractivity(&rows[i].air, rows[i].wavelength), rows[i].refractivity,
                       2e-15, "formula");
    }
}

/* N-BK7 as SCHOTT's data sheet of 2014 has it. */
static struct glass n_bk7(void)
{
    static const double numbers[] = {1.03961212,   0.00600069867, 0.231792344,
                                     0.0200179144, 1.01046945,    103.560653};
    struct glass glass = {.formula = GLASS_SELLMEIER,
                          .count = sizeof numbers / sizeof numbers[0],
                          .shortest = 0.3,
                          .longest = 2.5,
                          .thermal = {20, 1.86e-6, 1.31e-8, -1.37e-11, 4.34e-7, 6.27e-10, 0.17}};
    for (size_t i = 0; i < glass.count; i++) {
        glass.coefficients[i] = pair_of(numbers[i]);
    }
    return glass;
}

/*
 * A hundred degrees from the reference all terms of dn/dT count. Expected: the index in vacuum by
 * the integrated formula with 40 digits, and its difference quotient over 2e-6 K.
 */
static void test_far_temperatures(void)
{
    static const struct {
        double wavelength, temperature, slope, change;
    } rows[] = {
        {0.5460740, -80, -1.077601848425732e-8, -7.707088268454428906e-5},
        {0.5460740, 20, 1.493264930176790e-6, 0},
        {0.5460740, 120, 2.643733426847721e-6, 2.097963549511432234e-4},
        {1.060, -80, -3.747451675638714e-7, -3.170361943609125229e-5},
        {1.060, 120, 1.930427270179833e-6, 1.469622413232764858e-4},
    };
    const struct glass glass = n_bk7();
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const struct air vacuum = {AIR_EDLEN, rows[i].temperature, 0};
        const struct air standard = {AIR_EDLEN, 20, AIR_STANDARD_PRESSURE};
        double l = rows[i].wavelength, n = glass_n(&glass, l);
        struct glass_state state;
        struct error error;
        CHECK_NEAR(glass_dn_dT(&glass, l, rows[i].temperature), rows[i].slope, 1e-17, "dn/dT");
        CHECK(glass_in_air(&glass, l, &vacuum, &state, &error));
        CHECK_NEAR(state.dn_dT, rows[i].slope, 1e-17, "dn/dT with the index");
        CHECK_NEAR(state.n, n * (1 + air_refractivity(&standard, l)) + rows[i].change, 4e-16,
                   "index in vacuum");
    }
}

int main(void)
{
    test_table();
    test_formulas();
    test_far_temperatures();
    return check_report();
}
