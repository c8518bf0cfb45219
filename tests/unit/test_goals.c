/* tests/unit/test_goals.c - goals as they are written. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "cli/options/goals.h"
#include "file/lens_file.h"

static const char zoom[] = "position wide tele d\n"
                           "let gap 2 8 9\n"
                           "surface 50 5 1.5 20\n"
                           "surface -50 gap air 20\n"
                           "surface 100 5 1.6 20\n"
                           "surface -100 - air 20\n";

/* A goal, and what it means. */
static const struct {
    const char *text, *name;
    enum operand_kind kind;
    enum operand_relation relation;
    double target, deviation, wavelength, field; /* mm, um, rad; NaN: none */
    size_t position;
} good[] = {
    {"efl=100", "efl = 100", OPERAND_EFL, OPERAND_NEAR, 100, 1, NAN, NAN, LENS_NONE},
    {" efl = 10cm ", "efl = 10cm", OPERAND_EFL, OPERAND_NEAR, 100, 1, NAN, NAN, LENS_NONE},
    {"bfl@F>38:0.02", "bfl@F > 38", OPERAND_BFL, OPERAND_ABOVE, 38, 0.02, 0.4861327, NAN,
     LENS_NONE},
    {"bfl@550nm@tele<38 : 20um", "bfl@550nm@tele < 38", OPERAND_BFL, OPERAND_BELOW, 38, 0.02, 0.55,
     NAN, 1},
    {"ffl@550 == -2", "ffl@550 == -2", OPERAND_FFL, OPERAND_EXACT, -2, 1, 0.55, NAN, LENS_NONE},
    {"S3@wide @10deg", "S3@wide @10deg", OPERAND_S3, OPERAND_NEAR, 0, 1, NAN, 0.17453292519943295,
     0},
    {"S3:0.1", "S3", OPERAND_S3, OPERAND_NEAR, 0, 0.1, NAN, NAN, LENS_NONE},
    {"s1@C=0.01", "s1@C = 0.01", OPERAND_S1, OPERAND_NEAR, 0.01, 1, 0.6562725, NAN, LENS_NONE},
    {"height@10=8.8", "height@10 = 8.8", OPERAND_HEIGHT, OPERAND_NEAR, 8.8, 1, NAN,
     0.17453292519943295, LENS_NONE},
    {"cra@10deg < 28", "cra@10deg < 28", OPERAND_TELECENTRIC, OPERAND_BELOW,
     28 * 0.017453292519943295, 0.017453292519943295, NAN, 0.17453292519943295, LENS_NONE},
    {"power 1..2 = 20:0.1", "power 1..2 = 20", OPERAND_POWER, OPERAND_NEAR, 0.02, 1e-4, NAN, NAN,
     LENS_NONE},
    {"weight < 1kg", "weight < 1kg", OPERAND_WEIGHT, OPERAND_BELOW, 1000, 1, NAN, NAN, LENS_NONE},
    {"efl = 2*(30 + 2cm)", "efl = 2*(30 + 2cm)", OPERAND_EFL, OPERAND_NEAR, 100, 1, NAN, NAN,
     LENS_NONE},
    {"length + bfl < 6cm:0.1", "length + bfl < 6cm", OPERAND_EXPRESSION, OPERAND_BELOW, 60, 0.1,
     NAN, NAN, LENS_NONE},
    {"telecentric/2>1", "telecentric/2 > 1", OPERAND_EXPRESSION, OPERAND_ABOVE,
     0.017453292519943295, 0.017453292519943295, NAN, NAN, LENS_NONE},
    {"bfl > efl/2", "bfl > efl/2", OPERAND_EXPRESSION, OPERAND_ABOVE, 0, 1, NAN, NAN, LENS_NONE},
    {"1/efl = 0.02", "1/efl = 0.02", OPERAND_EXPRESSION, OPERAND_NEAR, 0.02, 1, NAN, NAN,
     LENS_NONE},
    {"t1 == 3mm", "t1 == 3mm", OPERAND_EXPRESSION, OPERAND_EXACT, 3, 1, NAN, NAN, LENS_NONE},
    {"fnumber=2", "fnumber = 2", OPERAND_FNUMBER, OPERAND_NEAR, 2, 1, NAN, NAN, LENS_NONE},
};

/* What is wrong with it, and where. */
static const struct {
    const char *text, *message, *hint;
    int caret;
} bad[] = {
    {"", "bad goal in --goals: a goal without a name", "", 1},
    {"efl=1,,", "bad goal in --goals: a goal without a name", "", 1},
    {"eff=100", "bad goal in --goals: unknown goal 'eff'", "did you mean 'efl'?", 1},
    {"efl", "bad goal in --goals: efl has no target", "write efl = 1mm", 1},
    {"efl=", "bad goal in --goals: a number is missing", "", 5},
    {"efl=:2", "bad goal in --goals: a number is missing", "", 5},
    {"efl=100:", "bad goal in --goals: a number is missing", "", 9},
    {"efl=100:0", "bad goal in --goals: a deviation is above 0, from 1e-50 on", "", 9},
    {"efl=100:-1", "bad goal in --goals: a deviation is above 0, from 1e-50 on", "", 9},
    {"efl=inf", "bad goal in --goals: the number must be from -1e+50 to 1e+50", "", 5},
    {"efl=100:inf", "bad goal in --goals: the number must be from -1e+50 to 1e+50", "", 9},
    {"efl=1e300", "bad goal in --goals: the number must be from -1e+50 to 1e+50", "", 5},
    {"efl=100:1e-51", "bad goal in --goals: a deviation is above 0, from 1e-50 on", "", 9},
    {"efl@10deg=100", "bad goal in --goals: efl has no field", "", 5},
    {"efl@5mm=100", "bad goal in --goals: efl has no field", "", 5},
    {"efl@40/mm=100", "bad goal in --goals: efl has no spatial frequency", "", 5},
    {"efl@F@C=100", "bad goal in --goals: the wavelength is there twice", "", 7},
    {"efl@wide@tele=100", "bad goal in --goals: the position is there twice", "", 10},
    {"length@F=100", "bad goal in --goals: length has no wavelength", "", 8},
    {"efl@=100", "bad goal in --goals: nothing stands behind '@'", "", 5},
    {"efl@d=100", "bad goal in --goals: 'd' is a position of the lens and a spectral line",
     "587.562nm is the line", 5},
    {"S3@10=1", "bad goal in --goals: '10' has no unit",
     "fields are 10deg or 5mm, wavelengths F or 550nm, frequencies 40/mm", 4},
    {"efl@wider=3", "bad goal in --goals: 'wider' is no wavelength, field, frequency or position",
     "they are F or 550nm, 10deg or 5mm, 40/mm, or a name that the lens has for a position", 5},
    {"efl tangential=3", "bad goal in --goals: efl has no orientation", "", 5},
    {"efl 1..3=3", "bad goal in --goals: efl has no surface", "", 5},
    {"efl often=3", "bad goal in --goals: unknown word 'often'", "", 5},
    {"height=3", "bad goal in --goals: height is that of a field", "write height@10deg", 1},
    {"efl@-550nm=3", "bad goal in --goals: the wavelength is not within 1 nm to 100 mm", "", 5},
    {"S3@infdeg=1", "bad goal in --goals: a field is finite", "", 4},
    {"length + telecentric < 3",
     "bad goal in --goals: length is in mm and telecentric is in deg: they have no sum", "", 10},
    {"length-2deg<3",
     "bad goal in --goals: length is in mm and 2deg is in deg: they have no "
     "difference",
     "", 8},
    {"efl*efl + bfl < 3",
     "bad goal in --goals: efl*efl is in mm^2 and bfl is in mm: they have no sum", "", 11},
    {"fnumber < bfl",
     "bad goal in --goals: fnumber is a number and bfl is in mm: they have no "
     "difference",
     "", 11},
    {"efl*bfl<3mm", "bad goal in --goals: what it is compared with is in mm^2",
     "write a number without a unit, or a product: 2mm*3mm", 9},
    {"efl*bfl<3mm*2", "bad goal in --goals: it is in 'mm', what it is compared with in 'mm^2'", "",
     9},
    {"length + bfl < 3deg", "bad goal in --goals: unit 'deg' measures an angle, expected a length",
     "", 17},
    {"length + bfl", "bad goal in --goals: length + bfl has no target", "write length + bfl = 1mm",
     1},
    {"length + < 3", "bad goal in --goals: a figure or a number is missing", "", 9},
    {"(length < 3", "bad goal in --goals: no ')' ends this", "", 1},
    {"length + 1) < 3", "bad goal in --goals: no '(' begins what ends here", "", 11},
    {"length + eff < 3", "bad goal in --goals: unknown goal 'eff'", "did you mean 'efl'?", 10},
    {"length + efl@10deg < 3", "bad goal in --goals: efl has no field", "", 14},
    {"2*spot < 3", "bad goal in --goals: spot is a sum over rays and has no value to reckon with",
     "", 3},
    {"2*3 < 7", "bad goal in --goals: no figure of the lens is in it", "", 1},
    {"t9 > 1", "bad goal in --goals: there is no thickness 9 to vary: the lens has 4 surfaces", "",
     1},
    {"t1@F > 1", "bad goal in --goals: 'F' is no position of the lens: a number has no other place",
     "", 4},
    {"2xx*efl > 1", "bad goal in --goals: 'xx' does not belong to a number", "", 2},
    {"efl=1=2", "bad goal in --goals: unexpected text after the number", "", 6},
};

static void test_good(const struct goals_reader *reader)
{
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
        struct goals goals = {0};
        struct error error;
        CHECK(goals_read(reader, text_of(good[i].text), &goals, &error));
        CHECK(goals.count == 1);
        if (goals.count != 1) {
            printf("    %s: %s\n", good[i].text, error.message);
            continue;
        }
        const struct operand *operand = &goals.list[0];
        CHECK_TEXT(operand->name, good[i].name);
        CHECK(operand->kind == good[i].kind);
        CHECK(operand->relation == good[i].relation);
        CHECK(operand->position == good[i].position);
        CHECK_NEAR(operand->target, good[i].target, 1e-14 * fabs(good[i].target), "target");
        CHECK_RELATIVE(operand->deviation, good[i].deviation, 1e-14, "deviation");
        CHECK(isnan(operand->wavelength) == isnan(good[i].wavelength));
        CHECK(isnan(good[i].wavelength) ||
              fabs(operand->wavelength / good[i].wavelength - 1) < 1e-14);
        CHECK((operand->field == NULL) == isnan(good[i].field));
        CHECK(operand->field == NULL ||
              fabs(operand->field->point.value[1] / good[i].field - 1) < 1e-14);
    }
}

static void test_bad(const struct goals_reader *reader)
{
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        struct goals goals;
        struct error error = {.code = ERROR_NONE};
        CHECK(!goals_read(reader, text_of(bad[i].text), &goals, &error));
        CHECK(error.code == ERROR_USAGE);
        CHECK_TEXT(error.message, bad[i].message);
        CHECK_TEXT(error.hint, bad[i].hint);
        CHECK(error.caret == bad[i].caret);
        if (error.caret != bad[i].caret) {
            printf("    %s: character %d\n", bad[i].text, error.caret);
        }
    }
}

/* Several in one text, each with its own. */
static void test_list(const struct goals_reader *reader)
{
    struct goals goals = {0};
    struct error error;
    CHECK(goals_read(reader, text_of("efl=100,S1, S2 ,bfl@wide>30:2"), &goals, &error));
    CHECK(goals.count == 4 && goals.list[2].kind == OPERAND_S2 && goals.list[3].position == 0);
}

/* The kinds with surfaces, which have places of their own. */
static void test_surfaces(const struct goals_reader *reader)
{
    struct goals goals = {0};
    struct error error;
    CHECK(goals_read(reader, text_of("edge 1..4 > 1, center 3 > 0.5, air > 0.1:0.01"), &goals,
                     &error));
    CHECK(goals.count == 3);
    CHECK(goals.list[0].first == 0 && goals.list[0].last == 3);
    CHECK(goals.list[1].first == 2 && goals.list[1].last == 2);
    CHECK(goals.list[2].first == LENS_NONE);
    CHECK_TEXT(goals.list[0].name, "edge 1..4 > 1");
    static const struct {
        const char *text, *message;
        int caret;
    } wrong[] = {
        {"edge 0..2 > 1", "bad goal in --goals: '0..2' names no surfaces", 6},
        {"edge 4..2 > 1", "bad goal in --goals: '4..2' names no surfaces", 6},
        {"edge two > 1", "bad goal in --goals: 'two' names no surfaces", 6},
        {"edge 1..5 > 1", "bad goal in --goals: there is no surface 5: the lens has 4", 9},
        {"edge 1 2 > 1", "bad goal in --goals: the surface is there twice", 8},
        {"edge@10deg > 1", "bad goal in --goals: edge has no field", 6},
        {"edge 1..4", "bad goal in --goals: edge has no target", 1},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        CHECK(!goals_read(reader, text_of(wrong[i].text), &goals, &error));
        CHECK_TEXT(error.message, wrong[i].message);
        CHECK(error.caret == wrong[i].caret);
    }
}

/* Lines of a file: what is wrong has its line and column there. */
static void test_lines(const struct goals_reader *reader)
{
    struct lens_goal lines[] = {
        {text_of("efl = 100, S1"), "zoom.lens", 7, 12},
        {text_of("bfl > 30, efl@10deg = 3"), "zoom.lens", 8, 12},
    };
    struct lens lens = *reader->lens;
    struct goals goals = {0};
    struct error error = {.code = ERROR_NONE};
    lens.goals = lines;
    lens.goal_count = 1;
    CHECK(goals_of_lens(reader, &lens, &goals, &error) && goals.count == 2);
    lens.goal_count = 2;
    CHECK(!goals_of_lens(reader, &lens, &goals, &error));
    CHECK(error.code == ERROR_DATA && error.line == 8 && error.column == 12 + 10 + 4);
    CHECK_TEXT(error.source, "zoom.lens");
    CHECK_TEXT(error.message, "bad goal: efl has no field");
    lens.goal_count = 0;
    CHECK(goals_of_lens(reader, &lens, &goals, &error) && goals.count == 0);
}

int main(void)
{
    struct arena arena = {0};
    struct lensdb db = {0};
    struct error error;
    struct lens lens;
    if (!lens_read("zoom", text_of(zoom), NULL, &arena, &lens, &error)) {
        printf("%s\n", error.message);
        return 1;
    }
    const struct goals_reader reader = {&db, &lens, &arena, "--goals", 1};
    test_good(&reader);
    test_bad(&reader);
    test_list(&reader);
    test_surfaces(&reader);
    test_lines(&reader);
    arena_free(&arena);
    return check_report();
}
