/* commands/photo/sharpness.h - the options that say how sharp is sharp. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_PHOTO_SHARPNESS_H
#define LENSCALC_COMMANDS_PHOTO_SHARPNESS_H

#include "commands/photo/photo_options.h"
#include "commands/tables.h"

/* A circle of confusion, and what it may be derived from. */
struct sharpness {
    struct coc_value coc;
    struct sensor_value sensor;
    double pitch; /* mm; NaN = that of the sensor */
    struct print_value print;
    double viewing;    /* mm; NaN = not given, as the next */
    double acuity;     /* line pairs per mm at 25 cm */
    double wavelength; /* mm; of a command without --lens */
};

/*
 * Initialisers of the options for a member of that type in a command's input; `pitch_use` is
 * coc_is_pixels, or null where --pitch is for more than --coc.
 */
#define SHARPNESS_OPTIONS(member, more, coc_fallback, pitch_use)                                   \
    SHARPNESS_OPTIONS_DARK(member, more, coc_fallback, pitch_use),                                 \
        OPTION_WAVELENGTH(member.wavelength, "coc=airy")

/* The same for a command with --lens; `question` is a struct photo_lens_question. */
#define SHARPNESS_OPTIONS_OF_LENS(member, question, more, coc_fallback, pitch_use)                 \
    SHARPNESS_OPTIONS_DARK(member, more, coc_fallback, pitch_use),                                 \
        OPTION_WAVELENGTH_OF_LENS(question.wavelength, "lens|coc=airy")

/* What both have: all but the light. */
#define SHARPNESS_OPTIONS_DARK(member, more, coc_fallback, pitch_use)                              \
    OPTION_COC(member.coc, more, coc_fallback), OPTION_SENSOR(member.sensor),                      \
        OPTION_PITCH(member.pitch, pitch_use), OPTION_PRINT(member.print),                         \
        OPTION_VIEWING(member.viewing), OPTION_ACUITY(member.acuity)

/* With one of these wishes the circle of confusion may be the unknown of every row. */
#define SHARPNESS_WISHES " +near +far +dof +hyperfocal"

/* The circle of confusion; `wishes` is SHARPNESS_WISHES where the command has them, else "". */
#define COLUMN_COC(member, more, wishes)                                                           \
    ENTRY(LENGTH(member, "mm"), .name = "coc", .flags = COLUMN_ASSUMED | (more), .symbol = "c",    \
          .depends = "coc sensor crop pitch print viewing acuity wavelength" wishes,               \
          .label = "circle of confusion", .help = "circle of confusion, diameter on the sensor")

#define COLUMN_CRITERION(member)                                                                   \
    ENTRY(SHOWN(member), .name = "coc_criterion", ASSUMED_BY("coc pitch print viewing acuity"),    \
          .symbol = "criterion", .label = "criterion",                                             \
          .help = "where the circle of confusion comes from")

#define COLUMN_WAVELENGTH(member)                                                                  \
    ENTRY(LENGTH(member, "nm"), .name = "wavelength", ASSUMED_BY("wavelength lens") | COLUMN_ECHO, \
          .symbol = "w", .help = "of the light in a real lens and in the Airy disc")

/* What is a pixel pitch of the command for? */
enum pitch_use { PITCH_FOR_COC, PITCH_FOR_MORE };

/*
 * The criterion that follows from the other options where --coc is not given: print from those of
 * a print, 2px from a pitch that is for nothing else. They are never without effect.
 *
 * Given     sharpness  of the options; receives their criterion
 *           doubts     of a pitch that is used and an estimate; null: nobody listens
 * Errors    ERROR_USAGE: options of two criteria
 */
bool sharpness_settle(struct sharpness *sharpness, enum pitch_use use, struct warnings *doubts,
                      struct error *error);

/* Is --coc, or its default, all there is, so that nothing is to be settled? */
static inline bool sharpness_is_plain(const struct sharpness *a)
{
    return isnan(a->pitch) && isnan(a->print.longer) && isnan(a->viewing) && isnan(a->acuity) &&
           a->coc.coc.kind != COC_PIXELS;
}

/* The pixel pitch: as given, else that of the sensor; NaN where neither is known. */
double sharpness_pitch(const struct sharpness *sharpness);

/* Where the sensor's own pitch was used: say so if it is an estimate. */
void sharpness_doubt_pitch(const struct sharpness *sharpness, struct warnings *doubts);

/*
 * The circle of confusion.
 *
 * Given     fnumber  for the Airy disc, at work: N (1 + m/P); NaN where it is not known yet
 *           c        receives the diameter, mm; NaN if no criterion is given
 * Errors    as coc_resolve
 */
bool sharpness_resolve(const struct sharpness *sharpness, double fnumber, double *c,
                       struct error *error);

/* The same in light of this wavelength, mm. */
bool sharpness_resolve_in(const struct sharpness *sharpness, double wavelength, double fnumber,
                          double *c, struct error *error);

/* The f-number that diffracts. */
static inline double diffracting_fnumber(double N, double m, double P)
{
    return N * (1 + m / P);
}

/* Does the criterion follow from the wavelength? */
static inline bool sharpness_is_airy(const struct sharpness *sharpness)
{
    return sharpness->coc.coc.kind == COC_AIRY;
}

#endif
