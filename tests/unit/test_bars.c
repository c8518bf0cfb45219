/* tests/unit/test_bars.c - groups of bars. */
/* SPDX-License-Identifier: MIT */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/error.h"
#include "check.h"
#include "draw/bars.h"
#include "draw/palette.h"
#include "draw/svg.h"

/* The highest bar of a kind, px. */
static double highest(const char *svg, size_t kind)
{
    char group[64];
    double most = 0;
    snprintf(group, sizeof group, "fill=\"%s\"", palette_colour(kind));
    for (const char *at = strstr(svg, group); at != NULL; at = strstr(at + 1, group)) {
        const char *height = strstr(at, " height=\"");
        most = fmax(most, strtod(height + strlen(" height=\""), NULL));
    }
    return most;
}

int main(void)
{
    /* one kind is a thousand times the other, of the same signs */
    static const double first[] = {1000, 0.5}, second[] = {-1000, -1}, third[] = {500, 1};
    static const char *const kinds[] = {"distortion", "coma"};
    const struct bar_group groups[] = {
        {"1", first, NULL, false}, {"2", second, NULL, false}, {"sum", third, NULL, true}};
    struct bars bars = {.kinds = kinds, .kind_count = 2, .groups = groups, .group_count = 3};
    struct arena arena = {0};
    struct svg shared = {.arena = &arena}, own = {.arena = &arena};
    struct error error = {0};
    CHECK(bars_draw(&bars, &shared, &error));
    CHECK(highest(shared.data, 0) > 100 && highest(shared.data, 1) < 12);
    bars.own_scales = true;
    CHECK(bars_draw(&bars, &own, &error));
    CHECK_NEAR(highest(own.data, 0), highest(own.data, 1), 0.02, "both reach as far");
    CHECK(highest(own.data, 0) > 20);
    CHECK(strstr(own.data, ">distortion</text>") != NULL &&
          strstr(own.data, ">coma</text>") != NULL);
    CHECK(strstr(own.data, ">1000</text>") != NULL && strstr(own.data, ">−1</text>") != NULL);
    /* a line across a bar of another kind may lie beyond it */
    static const double far[] = {4000, 0.5};
    struct bar_group marked[] = {{"1", first, far, false}};
    struct svg lines = {.arena = &arena};
    bars.groups = marked;
    bars.group_count = 1;
    CHECK(bars_draw(&bars, &lines, &error));
    CHECK_NEAR(highest(lines.data, 0) / highest(own.data, 0), 0.25 * 2, 0.05,
               "its strip reaches from 0 to four times its bar, not from -1 to 1");
    CHECK(strstr(lines.data, ">1000</text>") == NULL);
    arena_free(&arena);
    return check_report();
}
