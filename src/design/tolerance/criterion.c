/* design/tolerance/criterion.c - what a lens that was made is judged by: a table of kinds. */
/* SPDX-License-Identifier: MIT */
#include "design/tolerance/criterion.h"

#include "base/quantity.h"

#include <math.h>

static const struct criterion_type types[CRITERION_KINDS] = {
    [CRITERION_SPOT] = {"spot", "RMS radius of the spot of all wavelengths", "um", 1e3,
                        &dimension_length, SENSE_LEAST, OPERAND_KINDS, true},
    [CRITERION_WAVEFRONT] = {"wavefront", "RMS of the wave front", "waves", 1, &dimension_number,
                             SENSE_LEAST, OPERAND_KINDS, true},
    [CRITERION_MTF] = {"mtf", "contrast", "1", 1, &dimension_number, SENSE_MOST, OPERAND_MTF, true},
    [CRITERION_EFL] = {"efl", "focal length", "mm", 1, &dimension_length, SENSE_NEAR, OPERAND_EFL,
                       false},
    [CRITERION_BFL] = {"bfl", "back focal length", "mm", 1, &dimension_length, SENSE_NEAR,
                       OPERAND_BFL, false},
    [CRITERION_DISTORTION] = {"distortion", "distortion of the chief ray", "%", 1,
                              &dimension_number, SENSE_SIZE, OPERAND_DISTORTION, true},
    [CRITERION_BORESIGHT] = {"boresight", "shift of the image of the field nearest to the axis",
                             "um", 1e3, &dimension_length, SENSE_LEAST, OPERAND_KINDS, false},
    [CRITERION_COLOR] = {"color", "lateral colour of the chief rays", "um", 1e3, &dimension_length,
                         SENSE_SIZE, OPERAND_LATERAL, true},
};

const struct criterion_type *criterion_type(enum criterion_kind kind)
{
    return &types[kind];
}

bool criterion_read(struct text text, struct arena *arena, struct criterion *criterion,
                    struct error *error)
{
    struct text rest = text;
    const struct text name = text_trim(text_cut(&rest, '@'));
    struct nearest nearest = {.typed = name};
    int kind = 0;
    while (kind < CRITERION_KINDS && !text_equal(name, types[kind].name)) {
        nearest_offer(&nearest, text_of(types[kind++].name));
    }
    if (kind == CRITERION_KINDS) {
        fail(error, ERROR_USAGE,
             "'%.*s' is no criterion: it must be spot, wavefront, mtf@FREQUENCY, efl, bfl, "
             "distortion, boresight or color",
             text_shown(name), name.start);
        return nearest.best.start != NULL &&
               error_hint(error, "did you mean '%.*s'?", (int)nearest.best.length,
                          nearest.best.start);
    }
    const enum operand_kind operand = types[kind].operand;
    if (operand != OPERAND_KINDS && operand_type(operand)->name == NULL) {
        return fail(error, ERROR_USAGE, "the criterion %s is not there yet", types[kind].name);
    }
    *criterion = (struct criterion){.kind = (enum criterion_kind)kind, .frequency = NAN};
    criterion->name = arena_string(arena, text.start, text.length);
    if (kind == CRITERION_MTF && rest.start == NULL) {
        return fail(error, ERROR_USAGE, "mtf needs a frequency, as in mtf@40/mm");
    }
    if (kind == CRITERION_MTF) {
        double *frequency = &criterion->frequency; /* "40/mm", "40": lines per mm */
        return (quantity_read(rest, &dimension_frequency, NULL, frequency, NULL, error) &&
                *frequency > 0 && isfinite(*frequency)) ||
               fail(error, ERROR_USAGE, "'%.*s' is no frequency above 0, as in mtf@40/mm",
                    text_shown(rest), rest.start);
    }
    return rest.start == NULL ||
           fail(error, ERROR_USAGE, "only mtf has something behind '@', a frequency: not %s",
                types[kind].name);
}

double criterion_badness(enum criterion_kind kind, double figure, double nominal)
{
    switch (types[kind].sense) {
    case SENSE_MOST:
        return -figure;
    case SENSE_NEAR:
        return fabs(figure - nominal);
    case SENSE_SIZE:
        return fabs(figure);
    default:
        return figure;
    }
}

bool criterion_passes(enum criterion_kind kind, double badness, double limit)
{
    return types[kind].sense == SENSE_MOST ? -badness >= limit : badness <= limit;
}
