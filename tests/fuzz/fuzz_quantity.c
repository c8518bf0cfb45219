/* tests/fuzz/fuzz_quantity.c - quantities of any dimension: first byte the dimension, then text. */
/* SPDX-License-Identifier: MIT */
#include "base/quantity.h"
#include "fuzz.h"

#include <math.h>

static double read_back(const char *text, const char *end, const struct dimension *dimension,
                        const struct unit *unit)
{
    struct error error;
    double again = NAN;
    REQUIRE(quantity_read(text_between(text, end), dimension, unit, &again, NULL, &error));
    return again;
}

/* What is written reads back: exactly in the program's own unit, else within roundings. */
static void require_written(double value, const struct dimension *dimension)
{
    char text[NUMBER_LENGTH + 1], expected[64];
    char *end = quantity_write(text, value, NULL);
    REQUIRE(end > text && end <= text + NUMBER_LENGTH);
    REQUIRE(read_back(text, end, dimension, NULL) == value);
    for (size_t i = 0; i < dimension->unit_count; i++) {
        const struct unit *unit = &dimension->units[i];
        double converted = unit_from_own(unit, value);
        if (!isfinite(converted) || fabs(converted) < 1e-290 || fabs(value) < 1e-290) {
            continue; /* the unit takes it out of range */
        }
        end = quantity_write(text, value, unit);
        double again = read_back(text, end, dimension, unit);
        REQUIRE(fabs(again - value) <= 4 * 0x1p-52 * fabs(value) || again == value);
    }
    for (int digits = 1; digits <= 17; digits++) {
        end = number_write_digits(text, value, digits);
        *end = '\0';
        snprintf(expected, sizeof expected, "%.*g", digits, value);
        REQUIRE(strcmp(text, expected) == 0);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size < 1) {
        return 0;
    }
    size_t count = 0;
    while (dimensions[count] != NULL) {
        count++;
    }
    const struct dimension *dimension = dimensions[data[0] % count];
    const struct unit *unit = &dimension->units[data[0] / count % dimension->unit_count];
    char *text = fuzz_copy(data + 1, size - 1);
    struct error error = {0};
    const struct unit *typed = NULL;
    double value = 42;
    if (quantity_read((struct text){text, size - 1}, dimension, unit, &value, &typed, &error)) {
        REQUIRE(!isnan(value));
        REQUIRE(value != 0 || !signbit(value));
        REQUIRE(typed == NULL ||
                (typed >= dimension->units && typed < dimension->units + dimension->unit_count));
        require_written(value, dimension);
    } else {
        fuzz_require_error(&error);
        REQUIRE(error.code == ERROR_USAGE);
        REQUIRE(error.caret >= 1);
    }
    free(text);
    return 0;
}
