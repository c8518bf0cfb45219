/* tests/unit/test_element.c - what of a lens is mounted as one piece. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "lens_of.h"
#include "optics/element.h"

/* "1-2 4-6": counted by hand in the prescription. */
static void check_elements(const char *content, const char *expected)
{
    struct arena arena = {0};
    const struct lens lens = lens_of(content, &arena);
    struct element *elements;
    char text[200] = "";
    const size_t count = elements_of(&lens, &arena, &elements);
    for (size_t i = 0; i < count; i++) {
        const size_t length = strlen(text);
        snprintf(text + length, sizeof text - length, "%s%zu-%zu", i > 0 ? " " : "",
                 elements[i].first + 1, elements[i].last + 1);
        CHECK(element_at(elements, count, elements[i].first) == &elements[i]);
        CHECK(element_at(elements, count, elements[i].last) == &elements[i]);
    }
    CHECK_TEXT(text, expected);
    arena_free(&arena);
}

static void test_elements(void)
{
    /* a single lens, a stop, a cemented pair, a plane that does nothing, a mirror */
    check_elements("surface 50 5 1.5 20\nsurface -50 2 air 20\nstop - 2 air 10\n"
                   "surface 40 5 1.5 20\nsurface -40 2 1.6 20\nsurface -90 9 air 20\n"
                   "surface - 3 air 20\nsurface -200 -50 mirror 20\n",
                   "1-2 4-6 8-8");
    /* a front under water, and an image behind glass, as that of an eye; a window by itself */
    check_elements("medium 1.333\nsurface 7.8 0.5 1.376 9\nsurface 6.5 3 air 9\n"
                   "surface 10 9 1.336 9\n",
                   "1-2 3-3");
    check_elements("medium 1.333\nsurface - 5 air 9\nsurface 50 5 1.5 9\nsurface -50 9 air 9\n",
                   "1-1 2-3");
    /* Mangin's mirror: light goes through its glass twice */
    check_elements("surface -100 5 1.5 50\nsurface -150 -5 mirror 50\nsurface -100 -90 air 50\n",
                   "1-3");
    /* a stop within cement, a thick lens */
    check_elements("surface 50 5 1.5 9\nstop - 5 1.5 5\nsurface -50 9 air 9\nthick 50 9 air 9\n",
                   "1-3 4-4");
    check_elements("surface - 5 air 9\nstop - 5 air 9\n", "");
}

int main(void)
{
    test_elements();
    return check_report();
}
