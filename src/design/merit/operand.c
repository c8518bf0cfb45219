/* design/merit/operand.c - what a lens is wanted to have: a table of kinds. */
/* SPDX-License-Identifier: MIT */
#include "design/merit/operand.h"

#include "design/merit/expression.h"

const char *const operand_relations[OPERAND_RELATIONS] = {"=", "<", ">", "=="};

enum {
    W = OPERAND_AT_WAVELENGTH,
    F = OPERAND_AT_FIELD,
    SURFACES = OPERAND_AT_SURFACES,
    TARGET = OPERAND_NEEDS_TARGET,
    ALL_W = W | OPERAND_OF_WAVELENGTHS,
    RAYS = ALL_W | F | OPERAND_OF_RAYS | OPERAND_TRACES,
    CONTRAST = ALL_W | F | TARGET | OPERAND_AT_FREQUENCY | OPERAND_NEEDS_FREQUENCY |
               OPERAND_HAS_ORIENTATION
};

#define LENGTH &dimension_length, "mm"
#define NUMBER &dimension_number, ""
#define ANGLE  &dimension_angle, "deg"
#define MASS   &dimension_mass, "g"
#define POWER  &dimension_vergence, "dpt"

/* clang-format off */
static const struct operand_type types[OPERAND_KINDS] = {
    [OPERAND_EFL] = {"efl", "focal length, 1/power", LENGTH, W | TARGET},
    [OPERAND_BFL] = {"bfl", "last vertex to rear focal point", LENGTH, W | TARGET},
    [OPERAND_FFL] = {"ffl", "first vertex to front focal point", LENGTH, W | TARGET},
    [OPERAND_LENGTH] = {"length", "first to last vertex", LENGTH, TARGET},
    [OPERAND_TRACK] = {"track", "first vertex to image plane", LENGTH, TARGET},
    [OPERAND_FOCUS] = {"focus", "paraxial image behind the image plane", LENGTH, W},
    [OPERAND_POWER] = {"power", "of a group of surfaces", POWER, W | SURFACES | TARGET},
    [OPERAND_MAGNIFICATION] = {"magnification", "of a near object", NUMBER, W | TARGET},
    [OPERAND_FNUMBER] = {"fnumber", "focal length over entrance pupil", NUMBER, W | TARGET},
    [OPERAND_PETZVAL] = {"petzval", "Petzval radius", LENGTH, W | TARGET},
    [OPERAND_AXIAL] = {"axial", "axial colour", LENGTH, ALL_W},
    [OPERAND_S1] = {"S1", "Seidel sum of spherical aberration", LENGTH, W | F},
    [OPERAND_S2] = {"S2", "Seidel sum of coma", LENGTH, W | F},
    [OPERAND_S3] = {"S3", "Seidel sum of astigmatism", LENGTH, W | F},
    [OPERAND_S4] = {"S4", "Seidel sum of field curvature", LENGTH, W | F},
    [OPERAND_S5] = {"S5", "Seidel sum of distortion", LENGTH, W | F},
    [OPERAND_HEIGHT] = {"height", "of the chief ray in the image", LENGTH,
                        W | F | OPERAND_NEEDS_FIELD | TARGET},
    [OPERAND_DISTORTION] = {"distortion", "of the chief ray, percent", NUMBER, W | F},
    [OPERAND_LATERAL] = {"lateral", "lateral colour in the image", LENGTH, ALL_W | F},
    [OPERAND_TELECENTRIC] = {"telecentric", "angle of the chief ray in image space", ANGLE, W | F},
    [OPERAND_INCIDENCE] = {"incidence", "largest angle of incidence", ANGLE,
                           W | F | SURFACES | TARGET},
    [OPERAND_EDGE] = {"edge", "thickness of glass at its edge", LENGTH, SURFACES | TARGET},
    [OPERAND_CENTER] = {"center", "thickness of glass on the axis", LENGTH, SURFACES | TARGET},
    [OPERAND_AIR] = {"air", "thickness of air, on the axis and at the edge", LENGTH,
                     SURFACES | TARGET},
    [OPERAND_SAG] = {"sag", "of a surface at its clear edge", LENGTH, SURFACES | TARGET},
    [OPERAND_SLOPE] = {"slope", "largest angle of a surface to its vertex", ANGLE,
                       SURFACES | TARGET},
    [OPERAND_RATIO] = {"ratio", "radius over semi-diameter of a surface", NUMBER,
                       SURFACES | TARGET},
    [OPERAND_ASPECT] = {"aspect", "diameter over centre thickness of glass", NUMBER,
                        SURFACES | TARGET},
    [OPERAND_WEIGHT] = {"weight", "of glass", MASS, SURFACES | TARGET},
    [OPERAND_COST] = {"cost", "of glass, by weight and relative price", NUMBER, SURFACES | TARGET},
    [OPERAND_SPOT] = {"spot", "spots, each about its own centroid", LENGTH, RAYS},
    [OPERAND_POLY] = {"poly", "spots, of all wavelengths about one centroid", LENGTH, RAYS},
    [OPERAND_ASBUILT] = {"asbuilt", "the same, with what errors of a lens that is made add", LENGTH,
                         RAYS},
    [OPERAND_OPD] = {"opd", "optical path differences, wavelengths", NUMBER, RAYS},
    [OPERAND_GRAZING] = {"grazing", "largest angle of a ray at a surface, near loss", ANGLE,
                         TARGET},
    [OPERAND_MTF] = {"mtf", "contrast at a spatial frequency, with diffraction", NUMBER, CONTRAST},
    [OPERAND_GMTF] = {"gmtf", "the same, geometric", NUMBER, CONTRAST},
    [OPERAND_NUMBER] = {NULL, "of the prescription", NUMBER, TARGET},
    [OPERAND_EXPRESSION] = {NULL, "arithmetic", NUMBER, TARGET},
};
/* clang-format on */

static const char *const aliases[OPERAND_KINDS] = {[OPERAND_TELECENTRIC] = "cra"};

const struct operand_type *operand_type(enum operand_kind kind)
{
    return &types[kind];
}

struct operand_unit operand_unit(const struct operand *operand)
{
    const struct operand_type *type = &types[operand->kind];
    return operand->kind == OPERAND_EXPRESSION
               ? operand->expression->unit
               : (struct operand_unit){type->dimension, type->unit, type->unit};
}

const struct operand *operand_terms(const struct operand *operand, size_t *count)
{
    const bool is_expression = operand->kind == OPERAND_EXPRESSION;
    *count = is_expression ? operand->expression->term_count : 1;
    return is_expression ? operand->expression->terms : operand;
}

const char *operand_alias(enum operand_kind kind)
{
    return aliases[kind];
}

enum operand_kind operand_find(struct text name)
{
    for (int i = 0; i < OPERAND_KINDS; i++) {
        if ((types[i].name != NULL && text_same(name, types[i].name)) ||
            (aliases[i] != NULL && text_same(name, aliases[i]))) {
            return (enum operand_kind)i;
        }
    }
    return OPERAND_KINDS;
}
