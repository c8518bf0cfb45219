/* tests/unit/test_distance_from.c - distances from sensor and pupil. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "photo/distance_from.h"

static const struct dof_targets no_targets = {NAN, NAN, NAN, NAN, NAN};
static const struct distance_reference from_sensor = {FROM_SENSOR, 0, NAN};
static const struct distance_reference from_entrance = {FROM_ENTRANCE, 0, NAN};

/* T = f (2 + m + 1/m): at 1:1 the sensor is 4 f from the subject, at 1:2 4.5 f. */
static void check_sensor(void)
{
    struct error error;
    double s;
    CHECK(distance_to_principal(50, 1, 200, &from_sensor, &s, &error));
    CHECK_NEAR(s, 100, 0, "1:1");
    CHECK(distance_to_principal(50, 1, 225, &from_sensor, &s, &error));
    CHECK_NEAR(s, 150, 1e-13, "1:2");
    CHECK(!distance_to_principal(50, 1, 199.9, &from_sensor, &s, &error));
    CHECK(error.code == ERROR_DOMAIN && strstr(error.message, "200") != NULL);
    CHECK(distance_to_principal(50, 1, INFINITY, &from_sensor, &s, &error) && isinf(s));
}

/* The entrance pupil of a lens with P = 2 lies f/2 behind the front principal plane. */
static void check_entrance(void)
{
    struct error error;
    double s;
    CHECK(distance_to_principal(100, 2, 950, &from_entrance, &s, &error));
    CHECK_NEAR(s, 1000, 0, "from the pupil");
    struct dof_setting setting = {100, 4, 0.03, 1000, 2};
    CHECK_NEAR(distance_offset(&setting, &from_entrance), -50, 0, "offset");
}

/* A thick lens: what lies between its principal planes is added, whatever its sign. */
static void check_thick(void)
{
    struct error error;
    double s;
    const struct distance_reference apart = {FROM_SENSOR, 12.5, 7},
                                    crossed = {FROM_SENSOR, -12.5, 7};
    const struct distance_reference front = {FROM_FRONT, 12.5, 7}, none = {FROM_FRONT, 0, NAN};
    const struct dof_setting setting = {50, 4, 0.03, 150, 1};
    CHECK(distance_to_principal(50, 1, 237.5, &apart, &s, &error));
    CHECK_NEAR(s, 150, 1e-13, "planes apart");
    CHECK(distance_to_principal(50, 1, 212.5, &crossed, &s, &error));
    CHECK_NEAR(s, 150, 1e-13, "planes crossed");
    CHECK(!distance_to_principal(50, 1, 212.4, &apart, &s, &error));
    CHECK(error.code == ERROR_DOMAIN && strstr(error.message, "212.5") != NULL);
    CHECK_NEAR(distance_offset(&setting, &apart), 87.5, 0, "75 + 12.5");
    CHECK_NEAR(distance_offset(&setting, &crossed), 62.5, 0, "75 - 12.5");
    CHECK(distance_to_principal(50, 1, 143, &front, &s, &error));
    CHECK_NEAR(s, 150, 0, "from the front");
    CHECK_NEAR(distance_offset(&setting, &front), -7, 0, "to the front");
    CHECK(!distance_to_principal(50, 1, 143, &none, &s, &error));
    CHECK(error.code == ERROR_USAGE && strstr(error.message, "lens") != NULL);
    CHECK_NEAR(distance_image(50, 150), 75, 0, "image");
    CHECK_NEAR(distance_image(50, INFINITY), 50, 0, "image of infinity");

    /* near and far wanted from the sensor, s and N unknown */
    struct dof dof;
    struct dof_setting unknown = {50, NAN, 0.03, NAN, 1};
    struct dof_targets limits = no_targets;
    CHECK(dof_compute(&setting, DOF_EXACT, &dof, &error));
    limits.near = dof.near + 62.5;
    limits.far = dof.far + 62.5;
    CHECK(distance_solve(&unknown, &limits, &crossed, &error));
    CHECK_RELATIVE(unknown.s, 150.0, 1e-11, "distance from limits");
    CHECK_RELATIVE(unknown.N, 4.0, 1e-9, "f-number from limits");
}

/* Measured from the sensor and put back: the same lens and subject, whatever is given. */
static void check_round_trips(void)
{
    static const double focal[] = {8, 50, 400}, ratio[] = {2, 3, 20, 1000};
    for (size_t i = 0; i < 3; i++) {
        for (size_t j = 0; j < 4; j++) {
            double f = focal[i], s = f * ratio[j];
            struct dof_setting truth = {f, 4, 0.001 * f / 50, s, 1};
            struct error error;
            struct dof dof;
            CHECK(dof_compute(&truth, DOF_EXACT, &dof, &error));
            double v = distance_offset(&truth, &from_sensor);
            CHECK_RELATIVE(1 / s + 1 / v, 1 / f, 1e-14, "thin lens");
            struct dof_setting given = truth;
            given.s = s + v;
            CHECK(distance_solve(&given, &no_targets, &from_sensor, &error));
            /* at 1:1 dT/ds = 0: half the digits are left */
            CHECK_RELATIVE(given.s, s, ratio[j] == 2 ? 1e-7 : 1e-12, "distance");
            struct dof_setting unknown = {f, NAN, truth.c, NAN, 1};
            struct dof_targets limits = no_targets;
            limits.near = dof.near + v;
            limits.far = dof.far + v;
            if (isfinite(limits.far) && ratio[j] > 2) {
                CHECK(distance_solve(&unknown, &limits, &from_sensor, &error));
                CHECK_RELATIVE(unknown.s, s, 1e-9, "distance from limits");
                CHECK_RELATIVE(unknown.N, 4.0, 1e-6, "f-number from limits");
            }
        }
    }
}

static void check_refusals(void)
{
    struct error error;
    struct dof_setting unknown = {NAN, 4, 0.03, 1000, 1};
    struct dof_targets targets = no_targets;
    targets.far = 1200;
    CHECK(!distance_solve(&unknown, &targets, &from_sensor, &error));
    CHECK(error.code == ERROR_USAGE);
}

int main(void)
{
    check_sensor();
    check_entrance();
    check_thick();
    check_round_trips();
    check_refusals();
    return check_report();
}
