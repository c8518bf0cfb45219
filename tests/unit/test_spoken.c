/* tests/unit/test_spoken.c - times, parts, feet and inches as people write them. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "report/spoken.h"

#include <string.h>

static void test_times(void)
{
    /* by hand: what a shutter or a timer would show, with four significant digits */
    static const struct {
        double seconds;
        const char *words;
    } cases[] = {
        {1.0 / 125, "1/125 s"},
        {1.0 / 8000, "1/8000 s"},
        {1.0 / 32000, "1/32000 s"},
        {0.0153, "1/65.36 s"},
        {1.0 / 4, "1/4 s"},
        {1.0 / 3, "1/3 s"},
        {0.5, "1/2 s"},
        {0.3, "0.3 s"},
        {0.4, "0.4 s"},
        {1, "1 s"},
        {2.5, "2.5 s"},
        {15, "15 s"},
        {59.99, "59.99 s"},
        {59.9999, "1 min"},
        {60, "1 min"},
        {150, "2 min 30 s"},
        {150.4, "2 min 30 s"},
        {119.6, "2 min"},
        {1428.2175, "23 min 48 s"},
        {3600, "1 h"},
        {3605, "1 h 5 s"},
        {5400, "1 h 30 min"},
        {90061, "25 h 1 min 1 s"},
        {0, "0 s"},
        {1e-7, "1e-07 s"},
        {1e8, "100000000 s"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char words[SPOKEN_LENGTH];
        spoken_time(words, cases[i].seconds, 4);
        CHECK_TEXT(words, cases[i].words);
    }
    char words[SPOKEN_LENGTH];
    spoken_time(words, 150.271, 6);
    CHECK_TEXT(words, "2 min 30.27 s");
    spoken_span(words, 0.0153, 4);
    CHECK_TEXT(words, "0.0153 s");
    spoken_span(words, 150, 4);
    CHECK_TEXT(words, "2 min 30 s");
}

static void test_parts(void)
{
    char words[SPOKEN_LENGTH];
    spoken_part(words, 1.0 / 16, 4);
    CHECK_TEXT(words, "1/16");
    spoken_part(words, 1, 4);
    CHECK_TEXT(words, "1/1");
    spoken_part(words, 0.3, 4);
    CHECK_TEXT(words, "1/3.333");
}

static void test_feet(void)
{
    /* 1691.1 mm are 5 ft 6.579 in; 25.4 mm an inch, 304.8 mm a foot */
    char words[SPOKEN_LENGTH];
    spoken_feet(words, 1691.1, 4, -1);
    CHECK_TEXT(words, "5' 6.6\"");
    spoken_feet(words, 16911, 4, -1);
    CHECK_TEXT(words, "55' 6\"");
    spoken_feet(words, 16911, 4, 1);
    CHECK_TEXT(words, "55' 5.8\"");
    spoken_feet(words, 1828.79, 4, 1);
    CHECK_TEXT(words, "6' 0.0\"");
    spoken_feet(words, 4e6, 4, -1);
    CHECK_TEXT(words, "13120'");
}

int main(void)
{
    test_times();
    test_parts();
    test_feet();
    return check_report();
}
