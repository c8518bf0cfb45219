/* optics/tolerance.c - the kinds of tolerances. */
/* SPDX-License-Identifier: MIT */
#include "optics/tolerance.h"

enum {
    IN_LENGTH = 1 << TOLERANCE_LENGTH,
    IN_ANGLE = 1 << TOLERANCE_ANGLE,
    IN_NUMBER = 1 << TOLERANCE_NUMBER,
    IN_PERCENT = 1 << TOLERANCE_PERCENT,
    IN_FRINGES = 1 << TOLERANCE_FRINGES
};

static const struct tolerance_type types[TOLERANCE_KINDS] = {
    [TOLERANCE_RADIUS] = {"radius", PARAMETER_RADIUS, TOLERANCE_OF_SURFACE,
                          IN_LENGTH | IN_PERCENT | IN_FRINGES},
    [TOLERANCE_THICKNESS] = {"thickness", PARAMETER_THICKNESS, TOLERANCE_OF_SURFACE,
                             IN_LENGTH | IN_PERCENT},
    [TOLERANCE_AIR] = {"air", PARAMETER_KINDS, TOLERANCE_OF_SURFACE, IN_LENGTH | IN_PERCENT},
    [TOLERANCE_INDEX] = {"index", PARAMETER_INDEX, TOLERANCE_OF_SURFACE, IN_NUMBER},
    [TOLERANCE_ABBE] = {"abbe", PARAMETER_ABBE, TOLERANCE_OF_SURFACE, IN_NUMBER | IN_PERCENT},
    [TOLERANCE_TILT] = {"tilt", PARAMETER_KINDS, TOLERANCE_OF_SURFACE, IN_ANGLE},
    [TOLERANCE_DECENTER] = {"decenter", PARAMETER_KINDS, TOLERANCE_OF_SURFACE, IN_LENGTH},
    [TOLERANCE_ELEMENT_TILT] = {"tilt", PARAMETER_KINDS, TOLERANCE_OF_ELEMENT, IN_ANGLE},
    [TOLERANCE_ELEMENT_DECENTER] = {"decenter", PARAMETER_KINDS, TOLERANCE_OF_ELEMENT, IN_LENGTH},
    [TOLERANCE_ELEMENT_ROLL] = {"roll", PARAMETER_KINDS, TOLERANCE_OF_ELEMENT, IN_ANGLE},
    [TOLERANCE_WEDGE] = {"wedge", PARAMETER_KINDS, TOLERANCE_OF_ELEMENT, IN_LENGTH | IN_ANGLE},
    [TOLERANCE_IRREGULARITY] = {"irregularity", PARAMETER_KINDS, TOLERANCE_OF_SURFACE, IN_FRINGES},
    [TOLERANCE_CONIC] = {"conic", PARAMETER_CONIC, TOLERANCE_OF_SURFACE, IN_NUMBER | IN_PERCENT},
    [TOLERANCE_COEFFICIENT] = {"coefficient", PARAMETER_COEFFICIENT, TOLERANCE_OF_SURFACE,
                               IN_NUMBER | IN_PERCENT},
    [TOLERANCE_FOCUS] = {"focus", PARAMETER_KINDS, TOLERANCE_OF_LENS, IN_LENGTH},
};

const struct tolerance_type *tolerance_type(enum tolerance_kind kind)
{
    return &types[kind];
}

const char *tolerance_name(const struct lens_tolerance *tolerance, struct arena *arena)
{
    const struct tolerance_type *type = tolerance_type(tolerance->kind);
    const size_t first = tolerance->first, last = tolerance->last;
    if (type->owner == TOLERANCE_OF_LENS) {
        return type->word;
    }
    if (type->parameter != PARAMETER_KINDS) {
        const struct parameter from = {first, type->parameter, tolerance->order};
        const struct parameter to = {last, type->parameter, tolerance->order};
        const char *name = parameter_write(from, arena);
        return first == last ? name : ARENA_JOIN(arena, name, "..", parameter_write(to, arena));
    }
    const char *element = tolerance->is_range ? "elements" : "element";
    const char *owner = type->owner == TOLERANCE_OF_SURFACE ? "surface" : element;
    return first == last
               ? arena_printf(arena, "%s %zu %s", owner, first + 1, type->word)
               : arena_printf(arena, "%s %zu..%zu %s", owner, first + 1, last + 1, type->word);
}
