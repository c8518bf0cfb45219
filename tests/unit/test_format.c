/* tests/unit/test_format.c - picture areas by rule and by shape. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "photo/format.h"

#include <math.h>

#define COUNT(table) ((int)(sizeof(table) / sizeof *(table)))

/* 4:3 with 16 mm of diagonal an inch from 1/2 inch on, 18 mm below: 4/5 and 3/5 of it, by hand. */
static void test_optical_format(void)
{
    static const struct {
        double inches, width, height;
        const char *source;
    } rows[] = {
        {1, 12.8, 9.6, "optowiki.info: 1 inch is 16 mm"},
        {0.5, 6.4, 4.8, "optowiki.info: 1/2 inch is 8 mm; the trade's 6.4 x 4.8 mm"},
        {1 / 3.0, 4.8, 3.6, "optowiki.info: 1/3 inch is 6 mm; the trade's 4.8 x 3.6 mm"},
        {0.25, 3.6, 2.7, "18 mm x 1/4 = 4.5 mm; the trade's 3.6 x 2.7 mm"},
        {2 / 3.0, 8.533333333333333, 6.4, "16 mm x 2/3 = 10.6667 mm"},
        {1 / 1.28, 10, 7.5, "16 mm/1.28 = 12.5 mm"},
    };
    struct error error;
    struct sensor sensor;
    for (int i = 0; i < COUNT(rows); i++) {
        CHECK(sensor_optical_format(rows[i].inches, &sensor, &error));
        CHECK_NEAR(sensor.width, rows[i].width, 4e-15, rows[i].source);
        CHECK_NEAR(sensor.height, rows[i].height, 2e-15, rows[i].source);
        CHECK(isnan(sensor.pitch));
    }
    CHECK(!sensor_optical_format(0, &sensor, &error));
    CHECK(!sensor_optical_format(5, &sensor, &error));
    CHECK(!sensor_optical_format(NAN, &sensor, &error));
    CHECK(error.code == ERROR_DOMAIN);
}

/* One side is the gate's, the other follows; by hand. */
static void test_extract(void)
{
    static const struct {
        struct sensor gate;
        double ratio, width, height;
        const char *source;
    } rows[] = {
        {{24.9, 18.7, 0.004}, 2.4, 24.9, 10.375, "wider than the gate: 24.9/2.4"},
        {{36, 24, 0.005}, 1.0, 24, 24, "a square of 36 x 24"},
        {{36, 24, 0.005}, 1.5, 36, 24, "its own shape"},
        {{36, 24, 0.005}, 2.0, 36, 18, "36/2"},
        {{24, 36, 0.005}, 1.5, 24, 16, "an upright gate: 24/1.5"},
        {{40, 20, 0.005}, 1.5, 30, 20, "narrower than the gate: 20 x 1.5"},
    };
    struct error error;
    struct sensor part;
    for (int i = 0; i < COUNT(rows); i++) {
        CHECK(sensor_extract(&rows[i].gate, rows[i].ratio, &part, &error));
        CHECK_NEAR(part.width, rows[i].width, 4e-15, rows[i].source);
        CHECK_NEAR(part.height, rows[i].height, 4e-15, rows[i].source);
        CHECK_NEAR(part.pitch, rows[i].gate.pitch, 0, rows[i].source);
    }
    CHECK(!sensor_extract(&rows[0].gate, 0, &part, &error));
    CHECK(!sensor_extract(&rows[0].gate, 11, &part, &error));
    CHECK(!sensor_extract(&rows[0].gate, NAN, &part, &error));
    CHECK(error.code == ERROR_DOMAIN);
}

int main(void)
{
    test_optical_format();
    test_extract();
    return check_report();
}
