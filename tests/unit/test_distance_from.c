/* tests/unit/test_distance_from.c - distances from sensor and pupil. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "photo/distance_from.h"

static const struct dof_targets no_targets = {NAN, NAN, NAN, NAN, NAN};

/* T = f (2 + m + 1/m): at 1:1 the sensor is 4 f from the subject, at 1:2 4.5 f. */
static void check_sensor(void)
{
    struct error error;
    double s;
    CHECK(distance_to_principal(50, 1, 200, FROM_SENSOR, &s, &error));
    CHECK_NEAR(s, 100, 0, "1:1");
    CHECK(distance_to_principal(50, 1, 225, FROM_SENSOR, &s, &error));
    CHECK_NEAR(s, 150, 1e-13, "1:2");
    CHECK(!distance_to_principal(50, 1, 199.9, FROM_SENSOR, &s, &error));
    CHECK(error.code == ERROR_DOMAIN && strstr(error.message, "200") != NULL);
    CHECK(distance_to_principal(50, 1, INFINITY, FROM_SENSOR, &s, &error) && isinf(s));
}

/* The entrance pupil of a lens with P = 2 lies f/2 behind the front principal plane. */
static void check_entrance(void)
{
    struct error error;
    double s;
    CHECK(distance_to_principal(100, 2, 950, FROM_ENTRANCE, &s, &error));
    CHECK_NEAR(s, 1000, 0, "from the pupil");
    struct dof_setting setting = {100, 4, 0.03, 1000, 2};
    CHECK_NEAR(distance_offset(&setting, FROM_ENTRANCE), -50, 0, "offset");
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
            double v = distance_offset(&truth, FROM_SENSOR);
            CHECK_RELATIVE(1 / s + 1 / v, 1 / f, 1e-14, "thin lens");
            struct dof_setting given = truth;
            given.s = s + v;
            CHECK(distance_solve(&given, &no_targets, FROM_SENSOR, &error));
            /* at 1:1 dT/ds = 0: half the digits are left */
            CHECK_RELATIVE(given.s, s, ratio[j] == 2 ? 1e-7 : 1e-12, "distance");
            struct dof_setting unknown = {f, NAN, truth.c, NAN, 1};
            struct dof_targets limits = no_targets;
            limits.near = dof.near + v;
            limits.far = dof.far + v;
            if (isfinite(limits.far) && ratio[j] > 2) {
                CHECK(distance_solve(&unknown, &limits, FROM_SENSOR, &error));
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
    CHECK(!distance_solve(&unknown, &targets, FROM_SENSOR, &error));
    CHECK(error.code == ERROR_USAGE);
}

int main(void)
{
    check_sensor();
    check_entrance();
    check_round_trips();
    check_refusals();
    return check_report();
}
