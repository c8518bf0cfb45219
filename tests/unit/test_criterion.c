/* tests/unit/test_criterion.c - what a made lens is judged by: words, units, what is worse. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "design/tolerance/criterion.h"

static struct arena arena;

/* Lengths of microns are figures in mm; the deviation that counts is by hand, of 3 where 5 is
   nominal, and of -3. */
static const struct {
    const char *name, *unit;
    double scale, badness, below;
    bool of_fields;
} kinds[CRITERION_KINDS] = {
    [CRITERION_SPOT] = {"spot", "um", 1000, 3, -3, true},
    [CRITERION_WAVEFRONT] = {"wavefront", "waves", 1, 3, -3, true},
    [CRITERION_MTF] = {"mtf", "1", 1, -3, 3, true},
    [CRITERION_EFL] = {"efl", "mm", 1, 2, 8, false},
    [CRITERION_BFL] = {"bfl", "mm", 1, 2, 8, false},
    [CRITERION_DISTORTION] = {"distortion", "%", 1, 3, 3, true},
    [CRITERION_BORESIGHT] = {"boresight", "um", 1000, 3, -3, false},
    [CRITERION_COLOR] = {"color", "um", 1000, 3, 3, true},
};

static void check_kinds(void)
{
    for (int k = 0; k < CRITERION_KINDS; k++) {
        const enum criterion_kind kind = (enum criterion_kind)k;
        const struct criterion_type *type = criterion_type(kind);
        CHECK_TEXT(type->name, kinds[k].name);
        CHECK_TEXT(type->unit, kinds[k].unit);
        CHECK(type->scale == kinds[k].scale && type->of_fields == kinds[k].of_fields);
        CHECK(criterion_badness(kind, 3, 5) == kinds[k].badness);
        CHECK(criterion_badness(kind, -3, 5) == kinds[k].below);
        /* what just reaches the limit passes; contrast must be as high, all others as low */
        const double worse = kind == CRITERION_MTF ? -0.5 : 0.5;
        CHECK(criterion_passes(kind, worse, 0.5));
        CHECK(criterion_passes(kind, worse - 0.25, 0.5));
        CHECK(!criterion_passes(kind, worse + 0.25, 0.5));
    }
}

static void check_words(void)
{
    static const struct {
        const char *text;
        double frequency;
    } good[] = {{"mtf@40/mm", 40}, {"mtf@2.5", 2.5}, {"mtf @ 10/mm", 10}};
    static const struct {
        const char *text, *message;
    } wrong[] = {
        {"mtf", "mtf needs a frequency, as in mtf@40/mm"},
        {"mtf@", "'' is no frequency above 0, as in mtf@40/mm"},
        {"mtf@0", "'0' is no frequency above 0, as in mtf@40/mm"},
        {"mtf@-3", "'-3' is no frequency above 0, as in mtf@40/mm"},
        {"mtf@inf", "'inf' is no frequency above 0, as in mtf@40/mm"},
        {"spot@3", "only mtf has something behind '@', a frequency: not spot"},
        {"", "'' is no criterion: it must be spot, wavefront, mtf@FREQUENCY, efl, bfl, distortion, "
             "boresight or color"},
    };
    struct criterion criterion;
    struct error error;
    for (int k = 0; k < CRITERION_KINDS; k++) {
        if (k != CRITERION_MTF) {
            CHECK(criterion_read(text_of(kinds[k].name), &arena, &criterion, &error));
            CHECK(criterion.kind == (enum criterion_kind)k && isnan(criterion.frequency));
            CHECK_TEXT(criterion.name, kinds[k].name);
        }
    }
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
        CHECK(criterion_read(text_of(good[i].text), &arena, &criterion, &error));
        CHECK(criterion.kind == CRITERION_MTF);
        CHECK_RELATIVE(criterion.frequency, good[i].frequency, 1e-15, good[i].text);
        CHECK_TEXT(criterion.name, good[i].text);
    }
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        error = (struct error){.code = ERROR_NONE};
        CHECK(!criterion_read(text_of(wrong[i].text), &arena, &criterion, &error));
        CHECK(error.code == ERROR_USAGE);
        CHECK_TEXT(error.message, wrong[i].message);
    }
}

int main(void)
{
    check_kinds();
    check_words();
    arena_free(&arena);
    return check_report();
}
