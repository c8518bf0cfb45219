/* tests/unit/test_typeset.c - unit tests of draw/typeset.c, and of drawings in another dress. */
/* SPDX-License-Identifier: MIT */
#include "base/arena.h"
#include "check.h"
#include "draw/svg.h"
#include "draw/typeset.h"

#include <string.h>

/* SI Brochure, 9th edition, 5.4: unit symbols, spaces and signs. */
static void test_units(struct arena *arena)
{
    static const struct {
        const char *typed, *set;
    } cases[] = {
        {"field 10 deg", "field 10°"},
        {"field 10 deg, 5 um", "field 10°, 5 µm"},
        {"angle (deg)", "angle (°)"},
        {"2 deg/s", "2°/s"},
        {"1957 mm2, 3 us", "1957 mm², 3 µs"},
        {"36 x 24 mm", "36 × 24 mm"},
        {"-0.4 to -.2 mm (-1)", "−0.4 to −.2 mm (−1)"},
        {"f-number 10-20, n-bk7", "f-number 10-20, n-bk7"},
        {"10 degrees, 5 umm, 4 x B", "10 degrees, 5 umm, 4 x B"},
        {"um deg", "um deg"},
        {"", ""},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        CHECK_TEXT(typeset(arena, cases[i].typed), cases[i].set);
    }
}

/* Advance widths of the fonts, as fontTools 4.38 reads them, in 2048ths of an em. */
static void test_widths(void)
{
    CHECK_NEAR(typeset_width("A", 2048, false), 1401, 1.1, "A");
    CHECK_NEAR(typeset_width("mm", 2048, false), 2 * 1995, 1.1, "mm");
    CHECK_NEAR(typeset_width("A", 2048, true), 1585, 1.1, "bold A");
    CHECK_NEAR(typeset_width("−", 2048, false), 1716, 1.1, "minus");
    CHECK_NEAR(typeset_width("n_{d}", 2048, false), 1298 + 0.7 * 1300, 2, "subscript");
    CHECK(typeset_fitting("AAAA", 10, false, 14) == 2);
    CHECK(typeset_fitting("−−", 10, false, 9) == strlen("−"));
}

static void test_dress(struct arena *arena)
{
    struct svg svg = {.arena = arena};
    svg_begin(&svg, 200, 100, "name");
    svg_heading(&svg, 10, 20, 10, 60, "old");
    svg_subheading(&svg, 10, 40, 10, 60, NULL);
    svg_words(&svg, 10, 60, 10, SVG_START, "#0072b2", "n_{d} of fill=\"#0072b2\"");
    svg_end(&svg);
    CHECK(strstr(svg.data, "n<tspan dy=\"2.2\" font-size=\"7\">d</tspan><tspan dy=\"-2.2\"> of") !=
          NULL);
    const struct svg same = svg_dress(&svg, &(struct svg_dress){.theme = PALETTE_LIGHT});
    CHECK(same.data == svg.data);
    const struct svg_dress dress = {PALETTE_DARK, "a < b & c", "5 um and far too long"};
    const struct svg dressed = svg_dress(&svg, &dress);
    CHECK(strstr(dressed.data, "<title>a &lt; b &amp; c</title>") != NULL);
    CHECK(strstr(dressed.data, ">a &lt; b &amp; c</text>") != NULL);
    CHECK(strstr(dressed.data, ">old<") == NULL);
    CHECK(strstr(dressed.data, ">5 µm and…</text>") != NULL);
    CHECK(strstr(dressed.data, "fill=\"#7f9cff\"") != NULL);
    CHECK(strstr(dressed.data, "fill=&quot;#0072b2&quot;") != NULL); /* words stay */
    CHECK(strstr(dressed.data, "fill=\"#17191d\"") != NULL);
    CHECK(strlen(dressed.data) == dressed.length);
}

int main(void)
{
    struct arena arena = {0};
    test_units(&arena);
    test_widths();
    test_dress(&arena);
    arena_free(&arena);
    return check_report();
}
