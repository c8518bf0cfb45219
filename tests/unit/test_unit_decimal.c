/* tests/unit/test_unit_decimal.c - decimals that were meant, to the last bit. */
/* SPDX-License-Identifier: MIT */
#include "base/quantity.h"
#include "check.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const struct unit *unit_of(const struct dimension *dimension, const char *name)
{
    return unit_find(dimension, text_of(name));
}

/* Nearest doubles of exact products: 1.1 ft = 335.28 mm, 0.3 um = 0.0003 mm, 1.6 mi. */
static void test_values(void)
{
    const struct unit *ft = unit_of(&dimension_length, "ft"),
                      *um = unit_of(&dimension_length, "um");
    const struct unit *mi = unit_of(&dimension_length, "mi"),
                      *deg = unit_of(&dimension_angle, "deg");
    double own = 0;
    CHECK(unit_decimal_to_own(ft, 1.1000000000000003, 1e-15, &own) && own == 335.28);
    CHECK(unit_decimal_to_own(um, 0.30000000000000004, 1e-15, &own) && own == 0.0003);
    CHECK(unit_decimal_to_own(mi, 1.6, 1e-15, &own) && own == 2574950.4);
    CHECK(unit_decimal_to_own(deg, 64.99999999999999, 1e-13, &own) && own == 1.1344640137963142);
    CHECK(unit_decimal_to_own(deg, -1e-17, 1e-15, &own) && own == 0 && !signbit(own));
    CHECK(unit_decimal_to_own(ft, 1e15, 1, &own) == false);
}

static void test_not_meant(void)
{
    const struct unit *deg = unit_of(&dimension_angle, "deg");
    double own = 7;
    CHECK(!unit_decimal_to_own(deg, 1.0 / 3, 1e-15, &own));
    CHECK(!unit_decimal_to_own(deg, 1e-12, 1e-15, &own));
    CHECK(!unit_decimal_to_own(deg, (double)INFINITY, 1e-15, &own));
    CHECK(!unit_decimal_to_own(deg, (double)NAN, 1e-15, &own));
    CHECK(own == 7);
}

/* As typed: all tenths of a degree, computed in radians. */
static void test_as_typed(void)
{
    const struct unit *deg = unit_of(&dimension_angle, "deg");
    double step = unit_to_own(deg, 0.1);
    for (int i = -1800; i <= 1800; i++) {
        char text[32];
        struct error error = {0};
        double typed = 0, own = 1e9;
        snprintf(text, sizeof text, "%s%d.%d", i < 0 ? "-" : "", abs(i) / 10, abs(i) % 10);
        CHECK(quantity_read(text_of(text), &dimension_angle, deg, &typed, NULL, &error));
        CHECK(unit_decimal_to_own(deg, unit_from_own(deg, i * step), 4e-13, &own) && own == typed);
    }
}

int main(void)
{
    test_values();
    test_not_meant();
    test_as_typed();
    return check_report();
}
