/* photo/given.h - numbers that may be missing: NaN means "not given, solve for it". */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_PHOTO_GIVEN_H
#define LENSCALC_PHOTO_GIVEN_H

#include "base/error.h"

/*
 * What lies beyond these is no quantity of photography, in whatever unit: the universe has
 * 1e30 mm. Within them no product of the formulas is lost between 0 and infinity.
 */
#define GIVEN_LEAST 1e-30
#define GIVEN_MOST  1e30

/* A number with the name of the quantity and the unit a message shows it in. */
struct given {
    const char *name; /* "exposure time" */
    const char *unit; /* " s", with its blank; "" for a pure number */
    double value;     /* NaN: not given */
};

/* Was it given? */
bool is_given(double value);

/* How many of the numbers are missing. */
int given_missing(const struct given *numbers, int count);

/* Every number that is given lies in that range; ERROR_DOMAIN names the first that does not. */
bool given_positive(const struct given *numbers, int count, struct error *error);

/* The same where they may be infinite too. */
bool given_above_0(const struct given *numbers, int count, struct error *error);

/* The number lies in that range, or may be 0 too, or negative too; ERROR_DOMAIN if not. */
bool check_positive(const char *name, const char *unit, double value, struct error *error);
bool check_not_negative(const char *name, const char *unit, double value, struct error *error);
bool check_finite(const char *name, const char *unit, double value, struct error *error);

/* The number is given (else ERROR_USAGE) and lies in that range (else ERROR_DOMAIN). */
bool require_positive(const char *name, const char *unit, double value, struct error *error);

/* The number is given (else ERROR_USAGE) and within low..high, both included (else ERROR_DOMAIN).
 */
bool require_within(const char *name, const char *unit, double value, double low, double high,
                    struct error *error);

/* The answer is a finite number above 0; else ERROR_DOMAIN says that `what` left that range. */
bool answer_positive(const char *what, double value, struct error *error);

#endif
