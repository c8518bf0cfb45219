/* tests/unit/test_anamorphic.c - what an anamorphic lens does across the picture. */
/* SPDX-License-Identifier: MIT */
#include "photo/anamorphic.h"

#include "check.h"

static void test_view(void)
{
    /* 50 mm f/2 at 5.05 m: m = 50/5000, blur of infinity 50 x 0.01/2 = 0.25 mm, by hand */
    const struct dof_setting setting = {50, 2, 0.03, 5050, 1};
    const struct sensor sensor = {24, 18, NAN};
    struct dof dof;
    struct anamorphic view;
    struct error error;
    CHECK(dof_compute(&setting, DOF_EXACT, &dof, &error));
    CHECK(anamorphic_view(&setting, &dof, &sensor, 2, &view, &error));
    CHECK_RELATIVE(view.focal, 25.0, 1e-15, "50/2");
    CHECK_RELATIVE(view.width, 4800.0, 1e-14, "2 x 24 mm/0.01");
    CHECK_RELATIVE(view.height, 1800.0, 1e-14, "18 mm/0.01");
    CHECK_RELATIVE(view.blur, 0.125, 1e-14, "half as wide as high");
    CHECK(!anamorphic_view(&setting, &dof, &sensor, 0, &view, &error));
    CHECK_TEXT(error.message, "squeeze 0 must be above 0 and finite");
}

static void test_infinity(void)
{
    const struct dof_setting setting = {50, 2, 0.03, INFINITY, 1};
    const struct sensor sensor = {24, 18, NAN};
    struct dof dof;
    struct anamorphic view;
    struct error error;
    CHECK(dof_compute(&setting, DOF_EXACT, &dof, &error));
    CHECK(anamorphic_view(&setting, &dof, &sensor, 1.33, &view, &error));
    CHECK(isinf(view.width) && isinf(view.height));
    CHECK_NEAR(view.blur, 0, 0, "infinity is in focus");
}

int main(void)
{
    test_view();
    test_infinity();
    return check_report();
}
