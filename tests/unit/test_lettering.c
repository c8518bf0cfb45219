/* tests/unit/test_lettering.c - letters in pictures: what they look like, and where they lie. */
/* SPDX-License-Identifier: MIT */
#include "check.h"

#include "draw/lettering.h"

#include <math.h>
#include <string.h>

enum { WIDE = 160, HIGH = 60 };
static const double HEIGHT = 40, LEFT = 10, BASE = 50;

static struct image letter_picture(struct arena *arena, const char *text)
{
    struct image image = {.width = WIDE, .height = HIGH, .channels = 1};
    struct error error;
    CHECK(image_new(&image, arena, &error));
    lettering_write(&image, LEFT, BASE, HEIGHT, text);
    return image;
}

/* Is there ink at a place, in heights of a digit from its left and above the base line? */
static bool has_ink(const struct image *image, double x, double y)
{
    const size_t column = (size_t)(LEFT + x * HEIGHT), row = (size_t)(BASE - y * HEIGHT);
    return image_row(image, row)[column] > 0.5F;
}

/* Where everybody's digits have ink and have none: openings and bowls. */
static void test_shapes(void)
{
    static const struct {
        const char *letter;
        double x, y;
        bool is_set;
    } places[] = {
        {"0", 0.3, 0.5, false},   {"0", 0.3, 0.98, true},  {"0", 0.3, 0.02, true},
        {"0", 0.03, 0.5, true},   {"0", 0.57, 0.5, true},  {"1", 0.32, 0.5, true},
        {"1", 0.05, 0.3, false},  {"2", 0.3, 0.02, true},  {"2", 0.05, 0.5, false},
        {"2", 0.3, 0.98, true},   {"3", 0.02, 0.5, false}, {"3", 0.54, 0.25, true},
        {"3", 0.51, 0.75, true},  {"4", 0.42, 0.1, true},  {"4", 0.3, 0.3, true},
        {"4", 0.1, 0.8, false},   {"5", 0.3, 0.98, true},  {"5", 0.5, 0.8, false},
        {"5", 0.1, 0.75, true},   {"5", 0.55, 0.32, true}, {"6", 0.3, 0.32, false},
        {"6", 0.05, 0.4, true},   {"6", 0.55, 0.8, false}, {"6", 0.3, 0.02, true},
        {"7", 0.3, 0.98, true},   {"7", 0.1, 0.5, false},  {"7", 0.2, 0.03, true},
        {"8", 0.3, 0.75, false},  {"8", 0.3, 0.25, false}, {"8", 0.3, 0.5, true},
        {"9", 0.3, 0.68, false},  {"9", 0.55, 0.6, true},  {"9", 0.05, 0.2, false},
        {"9", 0.3, 0.98, true},   {"-", 0.3, 0.42, true},  {"-", 0.3, 0.7, false},
        {"+", 0.28, 0.6, true},   {"+", 0.1, 0.42, true},  {"+", 0.1, 0.6, false},
        {"/", 0.19, 0.48, true},  {"/", 0.1, 0.8, false},  {"c", 0.03, 0.34, true},
        {"c", 0.55, 0.34, false}, {"d", 0.52, 0.9, true},  {"d", 0.1, 0.9, false},
        {"e", 0.3, 0.34, true},   {"e", 0.55, 0.2, false}, {"m", 0.05, 0.3, true},
        {"m", 0.42, 0.3, true},   {"m", 0.79, 0.3, true},  {"m", 0.23, 0.2, false},
        {"²", 0.15, 0.5, true},   {"²", 0.15, 0.2, false},
    };
    struct arena arena = {0};
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        const struct image image = letter_picture(&arena, places[i].letter);
        char what[64];
        snprintf(what, sizeof what, "letter %s at %g, %g", places[i].letter, places[i].x,
                 places[i].y);
        check_at(has_ink(&image, places[i].x, places[i].y) == places[i].is_set, __FILE__, __LINE__,
                 what);
    }
    arena_free(&arena);
}

/* A line of a ninth of the height: the ink of a minus is its length times that, with its ends. */
static void test_ink(void)
{
    struct arena arena = {0};
    const struct image image = letter_picture(&arena, "-");
    double sum = 0;
    const double wide = 0.11 * HEIGHT, length = 0.46 * HEIGHT;
    for (size_t i = 0; i < (size_t)WIDE * HIGH; i++) {
        sum += (double)image.pixels[i];
    }
    CHECK_NEAR(sum, length * wide + acos(-1) / 4 * wide * wide, 1, "ink of a minus");
    arena_free(&arena);
}

/* A text lies within its width, and one beyond the edges is cut without harm. */
static void test_width(void)
{
    struct arena arena = {0};
    const char *text = "7e+07";
    const struct image image = letter_picture(&arena, text);
    const double right = LEFT + lettering_width(text, HEIGHT);
    double last = 0;
    for (size_t i = 0; i < (size_t)WIDE * HIGH; i++) {
        last = image.pixels[i] > 0.5F ? fmax(last, (double)(i % WIDE) + 1) : last;
    }
    CHECK_NEAR(last, right, 3, "right edge");
    CHECK_NEAR(lettering_width("", HEIGHT), 0, 0, "width of nothing");
    CHECK_NEAR(lettering_width("xyz", HEIGHT), 0, 0, "width of what is no letter");
    struct image small = {.width = 3, .height = 3, .channels = 3};
    struct error error;
    CHECK(image_new(&small, &arena, &error));
    lettering_write(&small, -20, 2, 30, "888");
    lettering_write(&small, 2, 50, 30, "888");
    CHECK(isfinite(small.pixels[0]));
    arena_free(&arena);
}

int main(void)
{
    test_shapes();
    test_ink();
    test_width();
    return check_report();
}
