/* base/quantity_form.h - quantities that are more than a number and a unit. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_QUANTITY_FORM_H
#define LENSCALC_BASE_QUANTITY_FORM_H

#include "base/error.h"
#include "base/units.h"

/* The reading of one quantity: where it stands, and what to say of it. */
struct quantity_parser {
    struct text text; /* trimmed */
    const char *at, *end;
    const struct dimension *dimension;
    const struct unit *unit;  /* for bare numbers */
    const struct unit *typed; /* the unit that was read, or null */
    struct error *error;
};

/* Refuse it for what stands at this place. Returns false. */
bool quantity_wrong(struct quantity_parser *reading, const char *at, const char *what);

/* Step over blanks. */
void quantity_skip_blanks(struct quantity_parser *reading);

/* What was made of a text. */
enum quantity_form {
    QUANTITY_FORM_NONE, /* it is none of these forms */
    QUANTITY_FORM_READ,
    QUANTITY_FORM_WRONG /* it is one, with a fault that `error` describes */
};

/* A quantity in its own unit and the first unit that was typed (null: none). */
struct quantity_formed {
    double value;
    const struct unit *typed;
};

/*
 * Read the forms of a quantity that are not one number with one unit: the words for infinity;
 * a whole number and a fraction ("6 1/2 in", "1 2/3 stops"); times of several units, by the clock,
 * and as cameras show them ("2min30s", "2:30", "1:02:30", "30\"", "0\"5"); feet and inches with
 * fractions ("5' 6 1/2\"", "5 feet 6 inches"); angles in degrees, minutes and seconds; film speeds
 * in degrees DIN ("27DIN", "400/27\xc2\xb0").
 *
 * Given     form    at the beginning of the text
 *           formed  receives what was read
 * Formula   DIN: the speed is the one on the label beside that many degrees,
 *           100 x 2^((degrees - 21)/3) rounded as films and cameras are marked
 * Errors    QUANTITY_FORM_WRONG, with a caret: a smaller unit that makes more than one of the
 *           larger (70 min behind hours), a fraction of 1 or more behind a whole number, speed and
 *           degrees that contradict each other, degrees outside 8 to 51
 */
enum quantity_form quantity_form_read(const struct quantity_parser *form,
                                      struct quantity_formed *formed);

#endif
