/* tests/unit/test_quantity.c - quantities as people write them. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "base/quantity.h"
#include "check.h"

#include <math.h>

/*
 * Expected values are exact by the definitions of the units: inch 25.4 mm, foot 304.8 mm, yard
 * 914.4 mm, mile 1609.344 m (international yard and pound agreement, 1959); foot-candle one lumen
 * per square foot; knot 1852 m per hour; the decimal literals below are rounded once, as the
 * reader must.
 */
static const struct {
    const char *text;
    const struct dimension *dimension;
    const char *unit; /* of a bare number; null = own */
    double expected;
    double tolerance;
} good[] = {
    {"50mm", &dimension_length, "mm", 50, 0},
    {"50", &dimension_length, "mm", 50, 0},
    {"3", &dimension_length, "m", 3000, 0},
    {"3.3m", &dimension_length, "mm", 3300, 0},
    {"0.1 m", &dimension_length, "mm", 100, 0},
    {" 2.54cm ", &dimension_length, NULL, 25.4, 0},
    {"1in", &dimension_length, NULL, 25.4, 0},
    {"1\"", &dimension_length, NULL, 25.4, 0},
    {"1/8in", &dimension_length, NULL, 3.175, 4e-16},
    {"5ft6in", &dimension_length, "m", 1676.4, 3e-13},
    {"5'6\"", &dimension_length, "m", 1676.4, 3e-13},
    {"5 ft 6 in", &dimension_length, "m", 1676.4, 3e-13},
    {"5'6", &dimension_length, "m", 1676.4, 3e-13},
    {"1yd", &dimension_length, NULL, 914.4, 0},
    {"1mi", &dimension_length, NULL, 1609344, 0},
    {"550nm", &dimension_length, NULL, 550e-6, 0},
    {"0.55um", &dimension_length, NULL, 550e-6, 0},
    {"0.55\xc2\xb5m", &dimension_length, NULL, 550e-6, 0},
    {"inf", &dimension_length, "m", INFINITY, 0},
    {"-0", &dimension_length, "m", 0, 0},
    {"1e3", &dimension_length, "mm", 1000, 0},
    {"180deg", &dimension_angle, NULL, 3.14159265358979323846, 4.5e-16},
    {"12arcmin", &dimension_angle, NULL, 0.0034906585039886592, 5e-19},
    {"1/125s", &dimension_time, NULL, 0.008, 0},
    {"1/125", &dimension_time, NULL, 0.008, 0},
    {"2min", &dimension_time, NULL, 120, 0},
    {"1.5h", &dimension_time, NULL, 5400, 0},
    {"180deg@24fps", &dimension_time, NULL, 1 / 48.0, 4e-18},
    {"172.8deg@24fps", &dimension_time, NULL, 0.02, 4e-18},
    {"f/2.8", &dimension_fnumber, NULL, 2.8, 0},
    {"f2.8", &dimension_fnumber, NULL, 2.8, 0},
    {"F/2.8", &dimension_fnumber, NULL, 2.8, 0},
    {"T2.2", &dimension_fnumber, NULL, 2.2, 0},
    {"2.8", &dimension_fnumber, NULL, 2.8, 0},
    {"1:2", &dimension_ratio, NULL, 0.5, 0},
    {"0.5x", &dimension_ratio, NULL, 0.5, 0},
    {"25%", &dimension_ratio, NULL, 0.25, 0},
    {"5:1", &dimension_ratio, NULL, 5, 0},
    {"ISO400", &dimension_iso, NULL, 400, 0},
    {"iso 400", &dimension_iso, NULL, 400, 0},
    {"EV12", &dimension_ev, NULL, 12, 0},
    {"EV-2", &dimension_ev, NULL, -2, 0},
    {"3stops", &dimension_stops, NULL, 3, 0},
    {"100cd/m2", &dimension_luminance, NULL, 100, 0},
    {"1fc", &dimension_illuminance, NULL, 10.763910416709722, 0},
    {"36km/h", &dimension_speed, NULL, 10000, 2e-12},
    {"60mph", &dimension_speed, NULL, 26822.4, 4e-12},
    {"50lp/mm", &dimension_frequency, NULL, 50, 0},
    {"2D", &dimension_vergence, NULL, 0.002, 0},
};

/* As photographers type. Inches are 25.4 mm, feet 304.8 mm; all worked out by hand. */
static const struct {
    const char *text;
    const struct dimension *dimension;
    const char *unit; /* of a bare number; null = own */
    double expected;
    double tolerance;
} typed[] = {
    {"\xc6\x92/2.8", &dimension_fnumber, NULL, 2.8, 0},
    {"\xc6\x92 2.8", &dimension_fnumber, NULL, 2.8, 0},
    {"1:2.8", &dimension_fnumber, NULL, 2.8, 0},
    {"f:2.8", &dimension_fnumber, NULL, 2.8, 0},
    {"F2.8", &dimension_fnumber, NULL, 2.8, 0},
    {"f/ 2.8", &dimension_fnumber, NULL, 2.8, 0},
    {"30\"", &dimension_time, NULL, 30, 0},
    {"0\"5", &dimension_time, NULL, 0.5, 0},
    {"1\"3", &dimension_time, NULL, 1.3, 0},
    {"1'30\"", &dimension_time, NULL, 90, 0},
    {"2min30s", &dimension_time, NULL, 150, 0},
    {"2 min 30 s", &dimension_time, NULL, 150, 0},
    {"2m30s", &dimension_time, NULL, 150, 0},
    {"2min30", &dimension_time, NULL, 150, 0},
    {"1h30m", &dimension_time, NULL, 5400, 0},
    {"1 hour 2 minutes 3.5 seconds", &dimension_time, NULL, 3723.5, 0},
    {"1h30s", &dimension_time, NULL, 3630, 0},
    {"2:30", &dimension_time, NULL, 150, 0},
    {"0:45", &dimension_time, NULL, 45, 0},
    {"1:02:30", &dimension_time, NULL, 3750, 0},
    {"1/125 s", &dimension_time, NULL, 0.008, 0},
    {"1/125 sec", &dimension_time, NULL, 0.008, 0},
    {"1 1/2 s", &dimension_time, NULL, 1.5, 0},
    {"\xe2\x88\x9e", &dimension_length, "m", INFINITY, 0},
    {"-\xe2\x88\x9e", &dimension_length, "m", -INFINITY, 0},
    {"infinity", &dimension_length, "m", INFINITY, 0},
    {"Infinity", &dimension_length, "m", INFINITY, 0},
    {"INF", &dimension_length, "m", INFINITY, 0},
    {"12EV", &dimension_ev, NULL, 12, 0},
    {"-2 EV", &dimension_ev, NULL, -2, 0},
    {"EV 12.5", &dimension_ev, NULL, 12.5, 0},
    {"27DIN", &dimension_iso, NULL, 400, 0},
    {"27 DIN", &dimension_iso, NULL, 400, 0},
    {"DIN 21", &dimension_iso, NULL, 100, 0},
    {"18\xc2\xb0", &dimension_iso, NULL, 50, 0},
    {"24\xc2\xb0"
     "DIN",
     &dimension_iso, NULL, 200, 0},
    {"400/27\xc2\xb0", &dimension_iso, NULL, 400, 0},
    {"ISO 400/27\xc2\xb0", &dimension_iso, NULL, 400, 0},
    {"125/22", &dimension_iso, NULL, 125, 0},
    {"400 ASA", &dimension_iso, NULL, 400, 0},
    {"ASA 64", &dimension_iso, NULL, 64, 0},
    {"5' 6 1/2\"", &dimension_length, "m", 1689.1, 3e-13},
    {"5 feet 6 inches", &dimension_length, "m", 1676.4, 3e-13},
    {"5ft 6 1/2in", &dimension_length, "m", 1689.1, 3e-13},
    {"5\xe2\x80\xb2 6\xe2\x80\xb3", &dimension_length, "m", 1676.4, 3e-13},
    {"5\xe2\x80\x99 6\xe2\x80\x9d", &dimension_length, "m", 1676.4, 3e-13},
    {"5'6''", &dimension_length, "m", 1676.4, 3e-13},
    {"6 1/2\"", &dimension_length, "m", 165.1, 3e-14},
    {"6 1/2 in", &dimension_length, "m", 165.1, 3e-14},
    {"1 1/2 m", &dimension_length, "mm", 1500, 0},
    {"3 feet", &dimension_length, "mm", 914.4, 0},
    {"3 metres", &dimension_length, "mm", 3000, 0},
    {"50 millimeters", &dimension_length, "m", 50, 0},
    {"1 2/3 stops", &dimension_stops, NULL, 5 / 3.0, 3e-16},
    {"10-stop", &dimension_stops, NULL, 10, 0},
    {"6-inch", &dimension_length, "m", 152.4, 0},
    {"2 1/3", &dimension_stops, NULL, 7 / 3.0, 5e-16},
    {"35\xc2\xb0"
     "30'",
     &dimension_angle, NULL, 0.61959188445798699, 2e-16},
    {"0\xc2\xb0 0' 30\"", &dimension_angle, NULL, 0.00014544410433286080, 3e-20},
};

/* What is wrong, and at which character. */
static const struct {
    const char *text;
    const struct dimension *dimension;
    int caret;
    const char *words; /* that the message contains */
} bad[] = {
    {"", &dimension_length, 1, "missing"},
    {"50nn", &dimension_length, 3, "unknown unit 'nn'"},
    {"50s", &dimension_length, 3, "measures a time"},
    {"50mmm", &dimension_length, 3, "unknown unit 'mmm'"},
    {"abc", &dimension_length, 1, "no number"},
    {"nan", &dimension_length, 1, "nan"},
    {"1e999", &dimension_length, 1, "too large"},
    {"1e-999", &dimension_length, 1, "too small"},
    {"1e306km", &dimension_length, 1, "too large"},
    {"2,8", &dimension_fnumber, 2, "decimal comma"},
    {"5ft13in", &dimension_length, 4, "less than 12"},
    {"5m6in", &dimension_length, 3, "unexpected text"},
    {"1/0", &dimension_time, 3, "denominator"},
    {"2.8mm", &dimension_fnumber, 4, "measures a length"},
    {"0x10", &dimension_length, 2, "ratio"},
    {"1 2", &dimension_length, 3, "unexpected text"},
    {"400deg@24fps", &dimension_time, 1, "shutter angle"},
    {"3mm\x01", &dimension_length, 4, "unexpected text"},
    {"2min70s", &dimension_time, 5, "less than 60"},
    {"2:75", &dimension_time, 3, "less than 60"},
    {"2m", &dimension_time, 2, "measures a length"},
    {"1.5:30", &dimension_time, 4, "unexpected text"},
    {"30s2min", &dimension_time, 4, "unexpected text"},
    {"1:2:3:4", &dimension_time, 2, "unexpected text"},
    {"5' 6 3/2\"", &dimension_length, 6, "unexpected text"},
    {"1 3/2 stops", &dimension_stops, 1, "less than 1"},
    {"400/21\xc2\xb0", &dimension_iso, 5, "contradict"},
    {"7DIN", &dimension_iso, 1, "8 to 51"},
    {"27.5DIN", &dimension_iso, 1, "8 to 51"},
    {"f/2.8-f/8", &dimension_fnumber, 6, ".."},
    {"f/2.8 to f/8", &dimension_fnumber, 7, ".."},
    {"24-70mm", &dimension_length, 3, ".."},
    {"infinite loop", &dimension_length, 4, "unknown unit"},
};

static void check_one(const char *text, const struct dimension *dimension, const char *name,
                      double expected, double tolerance)
{
    struct error error = {0};
    double value = NAN;
    const struct unit *unit = NULL;
    if (name != NULL) {
        unit = unit_find(dimension, text_of(name));
        CHECK(unit != NULL);
    }
    check_at(quantity_read(text_of(text), dimension, unit, &value, NULL, &error), __FILE__,
             __LINE__, text);
    CHECK_NEAR(value, expected, tolerance, text);
    CHECK(!signbit(value) || value < 0);
}

static void check_good(void)
{
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
        check_one(good[i].text, good[i].dimension, good[i].unit, good[i].expected,
                  good[i].tolerance);
    }
    for (size_t i = 0; i < sizeof typed / sizeof typed[0]; i++) {
        check_one(typed[i].text, typed[i].dimension, typed[i].unit, typed[i].expected,
                  typed[i].tolerance);
    }
}

static void check_bad(void)
{
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        struct error error = {0};
        double value = 17;
        bool read =
            quantity_read(text_of(bad[i].text), bad[i].dimension, NULL, &value, NULL, &error);
        check_at(!read, __FILE__, __LINE__, bad[i].text);
        check_at(error.code == ERROR_USAGE, __FILE__, __LINE__, bad[i].text);
        check_at(error.caret == bad[i].caret, __FILE__, __LINE__, bad[i].text);
        check_at(strstr(error.message, bad[i].words) != NULL, __FILE__, __LINE__, error.message);
    }
}

/* What was typed with up to 15 digits is written as it was typed, in every unit. */
static void check_round_trips(void)
{
    static const char *const numbers[] = {"1.9999", "0.10523", "35",      "3.3",  "7.3",
                                          "1e-05",  "123456",  "0.00173", "5.67", "2.718281828459"};
    for (size_t d = 0; dimensions[d] != NULL; d++) {
        for (size_t u = 0; u < dimensions[d]->unit_count; u++) {
            const struct unit *unit = &dimensions[d]->units[u];
            for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
                struct error error;
                double value;
                char text[NUMBER_LENGTH + 1];
                CHECK(
                    quantity_read(text_of(numbers[i]), dimensions[d], unit, &value, NULL, &error));
                *quantity_write(text, value, unit) = '\0';
                CHECK_TEXT(text, numbers[i]);
            }
        }
    }
}

/* Every unit is found by all its spellings, and by no other dimension's reader as another size. */
static void check_units(void)
{
    for (size_t d = 0; dimensions[d] != NULL; d++) {
        for (size_t u = 0; u < dimensions[d]->unit_count; u++) {
            const struct unit *unit = &dimensions[d]->units[u];
            CHECK(unit_find(dimensions[d], text_of(unit->name)) == unit);
            struct text rest = text_of(unit->spellings != NULL ? unit->spellings : unit->name);
            while (rest.start != NULL) {
                CHECK(unit_find(dimensions[d], text_cut(&rest, ' ')) == unit);
            }
            CHECK_RELATIVE(unit_from_own(unit, unit_to_own(unit, 1.7)), 1.7, 5e-16, unit->name);
        }
    }
}

/* Kept in um, a wavelength is read to the double of its decimal, and written as it was typed. */
static void check_wavelengths(void)
{
    static const struct {
        const char *typed;
        double um;
        const char *nm;
    } cases[] = {
        {"587.5618", 0.5875618, "587.5618"},
        {"587.5618nm", 0.5875618, "587.5618"},
        {"0.5875618um", 0.5875618, "587.5618"},
        {"700", 0.7, "700"},
        {"0.7um", 0.7, "700"},
        {"0.0006562725mm", 0.6562725, "656.2725"},
        {"10.6um", 10.6, "10600"},
    };
    const struct unit *nm = unit_find(&dimension_wavelength_um, text_of("nm"));
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[NUMBER_LENGTH + 1];
        struct error error;
        double value;
        CHECK(quantity_read(text_of(cases[i].typed), &dimension_wavelength_um, nm, &value, NULL,
                            &error));
        CHECK_NEAR(value, cases[i].um, 0, cases[i].typed);
        *quantity_write(text, value, nm) = '\0';
        CHECK_TEXT(text, cases[i].nm);
    }
}

/* The tests of angles take these constants too: here they are held to the C library's. */
static void check_constants(void)
{
    CHECK_NEAR(PI, acos(-1), 0, "pi");
    CHECK_NEAR(RADIANS_PER_DEGREE, acos(-1) / 180, 0, "a degree");
    CHECK_NEAR(DEGREES_PER_RADIAN, 180 / acos(-1), 0, "a radian");
}

int main(void)
{
    check_constants();
    check_wavelengths();
    check_good();
    check_bad();
    check_round_trips();
    check_units();
    return check_report();
}
