/* tests/unit/test_row.c - columns that have another dimension in some rows. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "report/row.h"

#include <string.h>

struct row {
    bool is_angular;
    double rms, share, radius, shift;
};

static const struct column_form angle = {&dimension_angle, "mrad", "as an angle"};
static const struct column_form vergence = {&dimension_vergence, "per_m", "as a vergence"};

#define LENGTH(member, form)                                                                       \
    COLUMN_OR(struct row, member, is_angular, form), .dimension = &dimension_length, .unit = "um"

static const struct column columns[] = {
    {LENGTH(rms, &angle), .name = "rms", .help = "of the spot"},
    {COLUMN(struct row, share), .name = "share", .help = "of the light"},
    {LENGTH(radius, &angle), .name = "radius", .help = "the largest"},
    {LENGTH(shift, &vergence), .name = "shift", .help = "of the focus"},
};

int main(void)
{
    static const struct {
        const char *name, *unit;
    } wanted[] = {{"rms", "um"},      {"share", NULL}, {"radius", "um"},  {"rms", "mrad"},
                  {"radius", "mrad"}, {"shift", "um"}, {"shift", "per_m"}};
    const size_t count = sizeof wanted / sizeof wanted[0];
    const struct sheet sheet = SHEET(columns, struct row);
    struct arena arena = {0};
    struct column spread[8];
    struct row row;

    CHECK(sheet_spread(&sheet, spread, &arena) == count);
    for (size_t i = 0; i < count; i++) {
        CHECK_TEXT(spread[i].name, wanted[i].name);
        CHECK(wanted[i].unit == NULL ? spread[i].unit == NULL
                                     : strcmp(spread[i].unit, wanted[i].unit) == 0);
    }
    CHECK(spread[3].dimension == &dimension_angle && spread[6].dimension == &dimension_vergence);
    CHECK_TEXT(spread[3].help, "of the spot; as an angle");

    /* of both forms a row has the one that it says */
    for (int angular = 0; angular < 2; angular++) {
        row = (struct row){angular, 2, 3, 5, 7};
        CHECK(row_is_absent(&row, &spread[0]) == (angular == 1));
        CHECK(row_is_absent(&row, &spread[3]) == (angular == 0));
        CHECK_NEAR(row_number(&row, &spread[angular == 1 ? 4 : 2]), 5, 0, "radius");
        CHECK_NEAR(row_number(&row, &spread[1]), 3, 0, "a column of one form");
    }

    /* a row without values has neither */
    row.is_angular = true;
    row_clear(&sheet, &row);
    CHECK(!row.is_angular && row_is_absent(&row, &spread[0]) && row_is_absent(&row, &spread[3]));
    arena_free(&arena);
    return check_report();
}
