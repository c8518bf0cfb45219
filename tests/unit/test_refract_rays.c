/* tests/unit/test_refract_rays.c - one ray at one surface, all its numbers, each way to aim. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "optics/refract.h"

#include <stddef.h>

#include "ranges.h"

/* Snell's law in vectors with 50 decimal digits; in the order of the members. */
static const struct {
    const char *name;
    struct refract_surface surface;
    struct refract_aim aim;
    struct {
        double z, height, sag, slope, normal, incidence, refraction, slope_after, crossing,
            difference, transverse, paraxial_slope, paraxial_incidence, paraxial_refraction,
            paraxial_slope_after;
    } ray;
} rows[] = {
    {"object at infinity, height",
     {1.25, 1.625, 50, -INFINITY, NAN, false},
     {12, NAN, false},
     {-INFINITY, 12, 1.4613556019536120378, 0, 0.2423658510389632327, 0.2423658510389632327,
      0.1856805057095585449, -0.056685345329404687, 212.92949190258571091, -3.737174764080955748,
      -0.212070234095298165, 0, 0.24, 0.1846153846153846153, -0.055384615384615384}},
    {"object before, height",
     {1.25, 1.625, 50, -80, NAN, false},
     {12, NAN, false},
     {-80, 12, 1.4613556019536120378, 0.1462572396471513709, 0.2423658510389632327,
      0.3886230906861146036, 0.2957660494355597901, 0.0534001983965965573, -223.0432692163648550,
      -23.04326921636485506, 1.2316861214781338395, 0.15, 0.39, 0.3, 0.06}},
    {"object before, height negative R",
     {1.25, 1.625, -50, -80, NAN, false},
     {-12, NAN, false},
     {-80, -12, -1.461355601953612037, -0.151618432736082671, 0.2423658510389632327,
      0.0907474183028805610, 0.0697665191765503581, -0.172599331862412874, -70.29476544623783857,
      -0.024495175967568303, -0.004270340700479302, -0.15, 0.09, 0.0692307692307692307,
      -0.170769230769230769}},
    {"virtual object",
     {1.25, 1.625, 50, 80, NAN, false},
     {12, NAN, false},
     {80, 12, 1.4613556019536120378, -0.151618432736082671, 0.2423658510389632327,
      0.0907474183028805610, 0.0697665191765503581, -0.172599331862412874, 70.294765446237838573,
      0.0244951759675683031, 0.0042703407004793027, -0.15, 0.09, 0.0692307692307692307,
      -0.170769230769230769}},
    {"object and angle",
     {1.25, 1.625, 50, -80, NAN, false},
     {NAN, 0.125, false},
     {-80, 10.184116152350089229, 1.0481483680602535867, 0.1250000000000000000,
      0.2051176275560077949, 0.3301176275560077949, 0.2520084455273085242, 0.0468908179713007292,
      -215.9805023117613012, -15.98050231176130122, 0.7498885110610319678, 0.1273014519043761153,
      0.3309837749513778999, 0.2546029038087522307, 0.0509205807617504461}},
    {"object close, and angle",
     {0.5, 0.75, 0.5, -0.25, NAN, false},
     {NAN, 0.125, false},
     {-0.25, 0.0315388981467459890, 0.0009956935018604647, 0.1250000000000000000,
      0.0631197004422637870, 0.1881197004422637870, 0.1250000000000000000, 0.0618802995577362129,
      -0.508029507441948424, -0.008029507441948424, 0.0004975034967042929, 0.1261555925869839562,
      0.1892333888804759343, 0.1261555925869839562, 0.0630777962934919781}},
    {"object in the vertex",
     {1.25, 1.625, 50, 0, NAN, false},
     {NAN, 0.125, false},
     {0, 0, 0, 0.1250000000000000000, 0, 0.1250000000000000000, 0.0960512653078911590,
      0.0960512653078911590, 0, 0, 0, 0.1256551365751309677, 0.1256551365751309677,
      0.0966577973654853598, 0.0966577973654853598}},
    {"height and angle",
     {1.25, 1.625, 50, NAN, NAN, false},
     {12, -0.125, false},
     {96.960833992357746172, 12, 1.4613556019536120378, -0.125000000000000000,
      0.2423658510389632327, 0.1173658510389632327, 0.0901965473658059372, -0.152169303673157295,
      79.711268219448828615, 0.0223865746004728800, 0.0034330887565184568, -0.123761311716293770,
      0.1162386882837062296, 0.0894143756028509459, -0.150585624397149054}},
    {"height in the vertex plane, and angle",
     {1.25, 1.625, 50, NAN, NAN, false},
     {12, 0.25, true},
     {-46.99580837575128126, 12.398762802348061103, 1.5616816872105885589, 0.2499999999999999999,
      0.2505896712906517943, 0.5005896712906517943, 0.3781339363390657714, 0.1275442650484139771,
      -95.12206427349491826, -10.03514091136485673, 1.2869105412891253144, 0.2638269928929561226,
      0.5118022489399173447, 0.3936940376460902651, 0.1457187815991290431}},
    {"height in the vertex plane, angle 0",
     {1.25, 1.625, -50, NAN, NAN, false},
     {12, 0, true},
     {-INFINITY, 12.000000000000000000, -1.461355601953612037, 0, -0.242365851038963232,
      -0.242365851038963232, -0.185680505709558544, 0.0566853453294046878, -212.9294919025857109,
      3.7371747640809557482, -0.212070234095298165, 0, -0.240000000000000000, -0.184615384615384615,
      0.0553846153846153846}},
    {"height in the vertex plane, object",
     {1.25, 1.625, 50, -80, NAN, false},
     {12, NAN, true},
     {-80, 12.227733717540967662, 1.5182247836064510836, 0.1488899476094972505,
      0.2470603947277826380, 0.3959503423372798886, 0.3012151924419497361, 0.0541547977141670981,
      -224.0532536233972755, -24.05325362339727553, 1.3038739756659206329, 0.1528466714692620957,
      0.3974013458200814490, 0.3056933429385241915, 0.0611386685877048383}},
    {"height in the vertex plane, object at infinity",
     {1.25, 1.625, 50, -INFINITY, NAN, false},
     {12, NAN, true},
     {-INFINITY, 12.000000000000000000, 1.4613556019536120378, 0, 0.2423658510389632327,
      0.2423658510389632327, 0.1856805057095585449, -0.056685345329404687, 212.92949190258571091,
      -3.737174764080955748, -0.212070234095298165, 0, 0.2400000000000000000, 0.1846153846153846153,
      -0.055384615384615384}},
    {"plane, object",
     {1.25, 1.625, INFINITY, -80, NAN, false},
     {12, NAN, false},
     {-80, 12, 0, 0.1488899476094972505, 0, 0.1488899476094972505, 0.1143571296922626918,
      0.1143571296922626918, -104.4766002509652876, -0.476600250965287619, 0.0547414731896447804,
      0.15, 0.15, 0.1153846153846153846, 0.1153846153846153846}},
    {"into the rarer",
     {1.625, 1.25, 50, -80, NAN, false},
     {12, NAN, false},
     {-80, 12, 1.4613556019536120378, 0.1462572396471513709, 0.2423658510389632327,
      0.3886230906861146036, 0.5150621088890534574, 0.2726962578500902247, -41.44741746311378968,
      3.4964027616053114359, -0.977814795021984645, 0.15, 0.39, 0.507, 0.267}},
    {"mirror, object at infinity",
     {1.25, 1, -50, -INFINITY, NAN, true},
     {12, NAN, false},
     {-INFINITY, 12, -1.461355601953612037, 0, -0.242365851038963232, -0.242365851038963232,
      0.2423658510389632327, 0.4847317020779264655, -24.24732364280221351, 0.7526763571977864824,
      -0.396389403784885724, 0, -0.24, 0.24, 0.48}},
    {"mirror, object",
     {1.25, 1, 50, -80, NAN, true},
     {12, NAN, false},
     {-80, 12, 1.4613556019536120378, 0.1462572396471513709, 0.2423658510389632327,
      0.3886230906861146036, -0.388623090686114603, -0.630988941725077836, 17.885526367018004812,
      -1.162092680601042806, -0.849060349328256654, 0.15, 0.39, -0.39, -0.63}},
};

static void check_number(double actual, double expected, const char *name, const char *member)
{
    char what[120];
    snprintf(what, sizeof what, "%s: %s", name, member);
    if (isnan(expected)) {
        check_at(!isfinite(actual), __FILE__, __LINE__, what);
        return;
    }
    CHECK_NEAR(actual, expected, 1e-14 + 5e-15 * fabs(expected), what);
}

static void test_rays(void)
{
#define MEMBER(m) check_number(ray.m, rows[i].ray.m, rows[i].name, #m)
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct refract_surface surface = rows[i].surface;
        struct refract_ray ray;
        CHECK(refract_place(&surface, &rows[i].aim, &ray, &error));
        surface.z = ray.z;
        CHECK(refract_solve(&surface, &error));
        CHECK(refract_through(&surface, &ray, &error));
        MEMBER(z);
        MEMBER(height);
        MEMBER(sag);
        MEMBER(slope);
        MEMBER(normal);
        MEMBER(incidence);
        MEMBER(refraction);
        MEMBER(slope_after);
        MEMBER(crossing);
        MEMBER(difference);
        MEMBER(transverse);
        MEMBER(paraxial_slope);
        MEMBER(paraxial_incidence);
        MEMBER(paraxial_refraction);
        MEMBER(paraxial_slope_after);
    }
}

static bool place(double R, double z, double height, double angle, bool at_vertex)
{
    const struct refract_surface surface = {1, 1.5, R, z, NAN, false};
    const struct refract_aim aim = {height, angle, at_vertex};
    struct refract_ray ray;
    return refract_place(&surface, &aim, &ray, &error);
}

static void test_aims(void)
{
    const double right = PI / 2;
    MISUSED(place(50, -80, NAN, NAN, false),
            "a ray follows from two of its height, its angle and the object: give two");
    MISUSED(place(50, -80, 1, 0.1, false),
            "a ray follows from two of its height, its angle and the object: give two");
    INSIDE(place(INFINITY, -0.25, NAN, -1.5, false));
    OUTSIDE(place(INFINITY, -0.25, NAN, right, false),
            "angle 90 deg is out of range: it must be above -90 to below 90 deg");
    OUTSIDE(place(INFINITY, -0.25, NAN, -right, false),
            "angle -90 deg is out of range: it must be above -90 to below 90 deg");
    OUTSIDE(
        place(50, -INFINITY, NAN, 0.1, false),
        "an object at infinity sends rays of angle 0: give a height instead, or height and angle "
        "without an object");
    OUTSIDE(place(50, 0, 0, NAN, false), "a ray from the vertex needs an angle, not a height");
    OUTSIDE(place(50, 0, 3, NAN, true),
            "an object in the vertex sends no ray through height 3 mm of the vertex plane");
    INSIDE(place(50, -0.25, 0, NAN, false));
    INSIDE(place(50, -INFINITY, 50, NAN, false));
    CHECK(!place(50, -INFINITY, 50.5, NAN, false));
    CHECK(!place(50, -INFINITY, INFINITY, NAN, false));
}

int main(void)
{
    test_rays();
    test_aims();
    return check_report();
}
