/* cli/lens_options.h - the options that lens commands share, and the cases they ask for. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_LENS_OPTIONS_H
#define LENSCALC_CLI_LENS_OPTIONS_H

#include "cli/command.h"
#include "optics/first_order.h"

#include <math.h>

/* What the options of a lens command say. */
struct lens_question {
    struct lens_value lens;
    struct wavelength_value wavelength;
    double fnumber, field;
    const char *position;
    int section;
};

/* One lens in one position at one wavelength. */
struct lens_case {
    const struct lens *lens;
    const char *position; /* null = the only one */
    double wavelength;    /* um */
    enum lens_section section;
    enum field_kind field_kind; /* of the edge of the field: asked for, or that of the lens */
    double field;               /* rad or mm; NaN = none */
    struct paraxial_system system;
    struct first_order first;
    const char *warning; /* null = all is well */
};

extern const struct word section_words[];

#define LENS_OPTION(S, member)                                                                     \
    {                                                                                              \
        OPTION(S, member.lens), .name = "lens", .letter = 'l', .value = "LENS",                    \
                                .flags = OPTION_OPERAND | OPTION_FILE | OPTION_MANY,               \
                                .help = "a lens of lensdb (list lenses), a file (.lens .zmx "      \
                                        ".seq .len .dat), or - for standard input"                 \
    }

/* `without`: which wavelengths a command takes without the option */
#define LENS_WAVELENGTH_OPTION(S, member, without)                                                 \
    {                                                                                              \
        OPTION(S, member.wavelength),                                                              \
            .name = "wavelength", .letter = 'w', .column = "wavelength", .value = "WAVE",          \
            .dimension = &dimension_length, .unit = "nm",                                          \
            .help = "wavelength in nm, or a line: d F C e g; without it " without                  \
    }
#define LENS_ALL_WAVELENGTHS    "all of the lens, the primary first"
#define LENS_PRIMARY_WAVELENGTH "the primary one of the lens"

#define LENS_FNUMBER_OPTION(S, member)                                                             \
    {                                                                                              \
        OPTION(S, member.fnumber),                                                                 \
            .name = "aperture", .letter = 'N', .column = "fnumber",                                \
            .dimension = &dimension_fnumber, .lowest = 0, .highest = INFINITY,                     \
            .flags = OPTION_ABOVE_LOWEST | OPTION_NO_INFINITY, .value = "NUMBER",                  \
            .help = "f-number in place of the lens's own aperture"                                 \
    }

#define LENS_FIELD_OPTION(S, member)                                                               \
    {                                                                                              \
        OPTION(S, member.field),                                                                   \
            .name = "field", .column = "field", .dimension = &dimension_angle, .unit = "deg",      \
            .lowest = -1.5706217938696971, .highest = 1.5706217938696971, .value = "ANGLE",        \
            .help = "field angle in object space in place of the lens's "                          \
                    "largest"                                                                      \
    }

#define LENS_POSITION_OPTION(S, member)                                                            \
    {                                                                                              \
        OPTION(S, member.position),                                                                \
            .name = "position", .value = "NAME",                                                   \
            .help = "zoom or focus position, a list, or all; default the first"                    \
    }

#define LENS_SECTION_OPTION(S, member)                                                             \
    {                                                                                              \
        OPTION(S, member.section), .name = "section", .words = section_words, .fallback = "y",     \
                                   .value = "SECTION", .help = "section of a lens with cylinders"  \
    }

/* What the rows of lens commands say of their case. */
#define LENS_WAVELENGTH_COLUMN(S, member)                                                          \
    {                                                                                              \
        COLUMN(S, member), .name = "wavelength", .dimension = &dimension_length, .unit = "nm",     \
                           .flags = COLUMN_ECHO | COLUMN_BRIEF, .label = "wavelength",             \
                           .help = "wavelength; the primary one first"                             \
    }

#define LENS_POSITION_COLUMN(S, member, more)                                                      \
    {                                                                                              \
        COLUMN(S, member), .name = "position", .flags = COLUMN_SPARSE | (more),                    \
                           .label = "position",                                                    \
                           .help = "zoom or focus position; absent where there is only one"        \
    }

#define LENS_WARNING_COLUMN(S, member)                                                             \
    {                                                                                              \
        COLUMN(S, member), .name = "warning", .flags = COLUMN_NOTE, .label = "warning",            \
                           .help = "what is doubtful about the lens; absent if nothing is"         \
    }

#define LENS_TITLE_COLUMN(S, member)                                                               \
    {                                                                                              \
        COLUMN(S, member), .name = "lens", .flags = COLUMN_EXTRA | COLUMN_ASSUMED,                 \
                           .depends = "lens", .label = "lens", .help = "title of the lens"         \
    }

/* A wavelength in um in the program's own unit of length, so that it prints in nm as typed. */
double lens_wavelength_own(double wavelength);

/* Two warnings as one; null = nothing to say. */
const char *lens_warnings_join(const char *first, const char *second, struct arena *arena);

/* Will the question have several answers? */
bool lens_makes_many(const struct lens_question *question);

/*
 * The positions that --position names.
 *
 * Given     names      null = the first; "all"; or a list with commas
 *           positions  receives an array in the arena, of `count`
 * Errors    ERROR_USAGE with a suggestion: no such position
 */
bool lens_positions(const struct lens *lens, const char *names, struct arena *arena,
                    const size_t **positions, size_t *count, struct error *error);

/* Does --position name several? */
bool lens_positions_several(const struct lens *lens, const char *names);

/*
 * Answer a question, case by case: positions, and within each the wavelengths, primary first.
 *
 * Given     visit  gets each case; returns false to fail
 * Errors    ERROR_USAGE: no lens, an unknown position; as first_order_of_lens and
 *           first_order_aperture
 */
bool lens_each(const struct lens_question *question, struct run *run,
               bool (*visit)(const struct lens_case *one, struct run *run, const void *context,
                             struct error *error),
               const void *context, struct error *error);

#endif
