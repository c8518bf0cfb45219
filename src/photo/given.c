/* photo/given.c - numbers that may be missing: NaN means "not given, solve for it". */
/* SPDX-License-Identifier: MIT */
#include "photo/given.h"

#include <math.h>

bool is_given(double value)
{
    return !isnan(value);
}

int given_missing(const struct given *numbers, int count)
{
    int missing = 0;
    for (int i = 0; i < count; i++) {
        missing += !is_given(numbers[i].value);
    }
    return missing;
}

static bool given_is_positive(double value)
{
    return value > 0 && isfinite(value);
}

static bool given_is_in_range(double value)
{
    return value >= GIVEN_LEAST && value <= GIVEN_MOST;
}

/* Beyond the range that numbers are taken in; false. */
static bool given_refuse_range(const char *name, const char *unit, double value,
                               struct error *error)
{
    return fail(error, ERROR_DOMAIN, "{%s} %.10g%s is out of range: %g to %g%s", name, value, unit,
                copysign(value < 0 ? GIVEN_MOST : GIVEN_LEAST, value),
                copysign(value < 0 ? GIVEN_LEAST : GIVEN_MOST, value), unit);
}

bool check_positive(const char *name, const char *unit, double value, struct error *error)
{
    if (!given_is_positive(value)) {
        return fail(error, ERROR_DOMAIN, "{%s} %.10g%s must be above 0 and finite", name, value,
                    unit);
    }
    return given_is_in_range(value) || given_refuse_range(name, unit, value, error);
}

bool check_not_negative(const char *name, const char *unit, double value, struct error *error)
{
    if (!(value >= 0 && isfinite(value))) {
        return fail(error, ERROR_DOMAIN, "{%s} %.10g%s must be 0 or more and finite", name, value,
                    unit);
    }
    return value == 0 || given_is_in_range(value) || given_refuse_range(name, unit, value, error);
}

bool check_finite(const char *name, const char *unit, double value, struct error *error)
{
    if (!isfinite(value)) {
        return fail(error, ERROR_DOMAIN, "{%s} %.10g%s must be finite", name, value, unit);
    }
    return value == 0 || given_is_in_range(fabs(value)) ||
           given_refuse_range(name, unit, value, error);
}

bool given_positive(const struct given *numbers, int count, struct error *error)
{
    for (int i = 0; i < count; i++) {
        const struct given *number = &numbers[i];
        if (is_given(number->value) &&
            !check_positive(number->name, number->unit, number->value, error)) {
            return false;
        }
    }
    return true;
}

bool given_above_0(const struct given *numbers, int count, struct error *error)
{
    for (int i = 0; i < count; i++) {
        if (numbers[i].value <= 0) {
            return fail(error, ERROR_DOMAIN, "{%s} %.10g%s must be above 0", numbers[i].name,
                        numbers[i].value, numbers[i].unit);
        }
        if (isfinite(numbers[i].value) && !given_is_in_range(numbers[i].value)) {
            return given_refuse_range(numbers[i].name, numbers[i].unit, numbers[i].value, error);
        }
    }
    return true;
}

bool require_positive(const char *name, const char *unit, double value, struct error *error)
{
    if (!is_given(value)) {
        return fail(error, ERROR_USAGE, "{%s} is missing", name);
    }
    return check_positive(name, unit, value, error);
}

bool require_within(const char *name, const char *unit, double value, double low, double high,
                    struct error *error)
{
    if (!is_given(value)) {
        return fail(error, ERROR_USAGE, "{%s} is missing", name);
    }
    return (value >= low && value <= high) ||
           fail(error, ERROR_DOMAIN, "{%s} %.10g%s lies outside %.10g to %.10g%s", name, value,
                unit, low, high, unit);
}

bool answer_positive(const char *what, double value, struct error *error)
{
    return given_is_positive(value) ||
           fail(error, ERROR_DOMAIN,
                "%s comes out as %.10g: the given numbers are out of all proportion", what, value);
}
