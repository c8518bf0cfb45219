/* tests/unit/test_pareto.c - rows of shares and histograms: what is drawn, and where. */
/* SPDX-License-Identifier: MIT */
#include "check.h"

#include "base/arena.h"
#include "base/error.h"
#include "draw/pareto.h"
#include "draw/svg.h"
#include "draw/tally_plot.h"

#include <stdlib.h>

/* How often a string stands in another. */
static int count_of(const char *text, const char *what)
{
    int count = 0;
    for (const char *at = strstr(text, what); at != NULL; at = strstr(at + 1, what)) {
        count++;
    }
    return count;
}

/* Labels of rows are 18 px apart, in a font of 11 px; those beyond the last row are one. */
static void check_rows(void)
{
    enum { COUNT = 75, MOST = 60 };
    struct arena arena = {0};
    struct svg svg = {.arena = &arena};
    struct error error;
    struct pareto_bar bars[COUNT];
    for (int i = 0; i < COUNT; i++) {
        bars[i] =
            (struct pareto_bar){arena_printf(&arena, "row %d", i), 0.25 / (i + 1), 0.5 / (i + 1)};
    }
    const struct pareto pareto = {.title = "shares",
                                  .part_name = "by itself",
                                  .whole_name = "in all",
                                  .bars = bars,
                                  .count = COUNT,
                                  .most = MOST};
    CHECK(pareto_draw(&pareto, &svg, &error));
    CHECK(count_of(svg.data, ">row ") == MOST - 1);
    CHECK(count_of(svg.data, ">16 others<") == 1);
    CHECK(count_of(svg.data, ">50.0 %<") == 1);
    double last = -1;
    for (const char *at = strstr(svg.data, ">row "); at != NULL; at = strstr(at + 1, ">row ")) {
        const char *place = at;
        while (strncmp(place, " y=\"", 4) != 0) {
            place--;
        }
        const double y = strtod(place + 4, NULL);
        CHECK(last < 0 || y - last == 18);
        last = y;
    }
    arena_free(&arena);
    const struct pareto none = {.part_name = "", .whole_name = "", .count = 0, .most = MOST};
    struct svg empty = {.arena = &arena};
    CHECK(!pareto_draw(&none, &empty, &error));
    arena_free(&arena);
}

/* The marks are within the page, even where no bar is; what fails has another colour. */
static void check_marks(void)
{
    struct arena arena = {0};
    struct svg svg = {.arena = &arena};
    struct error error;
    const double values[] = {1, 3, 2, 1};
    struct tally_plot histogram = {.low = 10,
                                   .high = 14,
                                   .values = values,
                                   .count = 4,
                                   .nominal = 8,
                                   .limit = 12,
                                   .fails_above = true,
                                   .marks = {"nominal 8", "limit 12"}};
    CHECK(tally_plot_draw(&histogram, &svg, &error));
    CHECK(count_of(svg.data, ">nominal 8<") == 1 && count_of(svg.data, ">limit 12<") == 1);
    CHECK(count_of(svg.data, "fill=\"#d55e00\"") == 2 && count_of(svg.data, "#0072b2") == 2);
    struct svg none = {.arena = &arena};
    histogram.low = histogram.high = histogram.nominal = histogram.limit = 12;
    CHECK(!tally_plot_draw(&histogram, &none, &error));
    CHECK_TEXT(error.message, "all figures are the same: there is nothing to draw");
    arena_free(&arena);
}

int main(void)
{
    check_rows();
    check_marks();
    return check_report();
}
