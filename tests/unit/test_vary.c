/* tests/unit/test_vary.c - --vary, --hold and marks as lists of variables. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "check.h"
#include "cli/options/vary.h"
#include "lens_of.h"

static struct arena arena;

static const char *const text =
    "position wide tele\nlet d2 2~ 5~[1,9]\nlet d6 7 8\npickup R5 = -R1\npickup glass5 = glass3\n"
    "surface 50 3 1.5/60 20 R~[60,-40] k~ glass~\nsurface - d2 air 20 t~\n"
    "surface 60 5 1.7/30 20 A4~[-1,1]\nsurface - 3 air 20 c~ c=0.02 ax~[-2,1]\n"
    "surface -50 4 1.7/30 20\nsurface 40 d6 1.5 20\nsurface -60 d2 air 20\nsurface - 30 air 20\n";

/* "R1 t2[2,10]", or the message. */
static const char *said(const struct lens *lens, const char *vary, const char *hold)
{
    const struct vary_reader reader = {.lens = lens, .arena = &arena};
    struct variable *list;
    struct error error = {0};
    size_t count;
    const char *all = "";
    if (!vary_list(&reader, vary, hold, &list, &count, &error)) {
        return arena_printf(&arena, "%s", error.message);
    }
    for (size_t i = 0; i < count; i++) {
        const struct variable *one = &list[i];
        bool bounds = isfinite(one->low) || isfinite(one->high);
        all = arena_printf(&arena, "%s%s%s", all, i > 0 ? " " : "", one->name);
        all = bounds ? arena_printf(&arena, "%s[%.6g,%.6g]", all, one->low, one->high) : all;
    }
    return all;
}

static void check_lists(void)
{
    const struct lens lens = lens_of(text, &arena);
    static const struct {
        const char *vary, *hold, *said;
    } cases[] = {
        {"R1,c4,t1,k1,A4_3,n1,V1,dx1,dy1,ax1,ay1", NULL, "R1 c4 t1 k1 A4_3 n1 V1 dx1 dy1 ax1 ay1"},
        {"decenter_x1, tilt_y2", NULL, "dx1 ay2"},
        {"all-R", NULL, "R1 R3 R4 R6 R7"}, /* 4 has a curvature, 5 follows */
        {"R1..R4", NULL, "R1 R3 R4"},
        {"R3..4[20,90]", NULL, "R3[20,90] R4[20,90]"},
        {"all-R,R3[20,90]", NULL, "R1 R3[20,90] R4 R6 R7"},
        {"R3[20,90],all-R", NULL, "R3[20,90] R1 R4 R6 R7"},
        {"all-R", "R3..R6", "R1 R7"},
        {"all-R,t1", "R1,R7", "R3 R4 R6 t1"},
        {"all-t", NULL, "t1 d2@wide d2@tele t3 t4 t5 d6@wide d6@tele"},
        {"all-t", "d2@tele,t4", "t1 d2@wide t3 t5 d6@wide d6@tele"},
        {"d2", NULL, "d2@wide d2@tele"},
        {"d2@tele[1,9]", NULL, "d2@tele[1,9]"},
        {"glass1", NULL, "n1 V1"},
        {"all-glass", NULL, "n1 V1 n3 V3"}, /* 5 follows, 6 has no Abbe number */
        {"all-n", NULL, "n1 n3 n6"},
        {"glass1,glass3", "glass1", "n3 V3"},
        {"t1[2mm,1cm],ax1[-90deg,90deg],t3[-inf,3]", NULL,
         "t1[2,10] ax1[-1.5708,1.5708] t3[-inf,3]"},
        {NULL, NULL,
         "R1[60,-40] k1 n1 V1 t2 A4_3[-1,1] c4 ax4[-0.0349066,0.0174533] d2@wide "
         "d2@tele[1,9]"},
        {NULL, "R1..R4,glass1,d2", "k1 t2 A4_3[-1,1] ax4[-0.0349066,0.0174533]"},
        {"R1", "R1", "nothing may change: --hold holds all that varies"},
        {"R1", "R3", "--hold names R3, which does not vary"},
        {"R1,c1", NULL, "--vary names R1 as c1 too"},
        {"glass1,n1", NULL, "--vary names n1 twice"},
        {"glass6", NULL,
         "the medium 1.5 after surface 6 is no model glass: only one of nd/Vd varies as a glass"},
        {"glass1[1,2]", NULL, "a glass has no bounds in --vary: give those of n1 and V1"},
        {"d2@mid", NULL, "bad part 'd2@mid' in --vary: the lens has no position 'mid'"},
        {"d3", NULL, "bad part in --vary: 'd3' names nothing of a surface that may change"},
        {"all-focal", NULL, "'all-focal' in --vary holds no focal length that may vary"},
        {"R2..R2", NULL, "'R2..R2' in --vary holds no radius that may vary"},
        {"R1..R9", NULL, "there is no radius 9 to vary: the lens has 8 surfaces"},
        {"glass9", NULL, "there is no glass 9 to vary: the lens has 8 surfaces"},
        {"", NULL, "bad part in --vary: '' names nothing of a surface that may change"},
        {"R1,", NULL, "bad part in --vary: '' names nothing of a surface that may change"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        CHECK_TEXT(said(&lens, cases[i].vary, cases[i].hold), cases[i].said);
    }
    const struct lens bare = lens_of("surface 50 3 1.5 20\nsurface - 3 air 20\n", &arena);
    CHECK_TEXT(said(&bare, NULL, NULL),
               "nothing may change: give --vary, or mark R~ and t~ in the lens");
    const struct lens both = lens_of("surface 50 3 1.5 20 R~ c~\nsurface - 3 air 20\n", &arena);
    CHECK_TEXT(said(&both, NULL, NULL), "the lens has marks of R1 and c1, which are one number");
}

int main(void)
{
    check_lists();
    arena_free(&arena);
    return check_report();
}
