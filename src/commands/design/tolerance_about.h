/* commands/design/tolerance_about.h - what all rows of tolerance say of their run. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_DESIGN_TOLERANCE_ABOUT_H
#define LENSCALC_COMMANDS_DESIGN_TOLERANCE_ABOUT_H

#include "commands/analysis/analysis_options.h"
#include "commands/design/tolerance_job.h"

/* What every row says of the run. */
struct tolerance_about {
    double fnumber;
    long seed;
    const char *made, *lens, *method, *rays, *adjusted, *limit, *warning;
};

/* Whatever trials depend on: some of them say how far rays and methods are right. */
#define TOLERANCE_TRIED_BY                                                                         \
    "lens grade tolerances criterion of refocus gap adjust trials seed method aim wavelength "     \
    "field position aperture section pattern rays clip no-clip"

#define TOLERANCE_ABOUT_COLUMNS(S)                                                                 \
    {COLUMN(S, about.fnumber),                                                                     \
     .flags = COLUMN_ECHO | COLUMN_EXTRA,                                                          \
     .name = "fnumber",                                                                            \
     .dimension = &dimension_fnumber,                                                              \
     .with = "aperture",                                                                           \
     .label = "f-number",                                                                          \
     .help = "f-number in place of the lens's own aperture"},                                      \
        {COLUMN(S, about.seed), .flags = COLUMN_ECHO | COLUMN_EXTRA,                               \
         .name = "seed",        .with = "seed",                                                    \
         .label = "seed",       .help = "another one gives other trials"},                         \
        {COLUMN(S, about.made), .flags = COLUMN_EXTRA | COLUMN_ASSUMED,                            \
         .name = "tolerances",  .depends = "grade tolerances lens",                                \
         .label = "tolerances", .help = "how many independent errors, and where they are from"},   \
        {COLUMN(S, about.limit), .flags = COLUMN_EXTRA | COLUMN_ASSUMED,                           \
         .name = "limit",        .depends = "limit",                                               \
         .label = "limit",       .help = "of the figures of a lens that passes"},                  \
        {COLUMN(S, about.adjusted),                                                                \
         .flags = COLUMN_EXTRA | COLUMN_ASSUMED,                                                   \
         .name = "adjusted",                                                                       \
         .depends = "refocus gap adjust",                                                          \
         .label = "adjusted",                                                                      \
         .help = "what is moved in every lens, to make its spots or wave fronts best"},            \
        {COLUMN(S, about.method), .flags = COLUMN_EXTRA | COLUMN_ASSUMED | COLUMN_SPARSE,          \
         .name = "method",        .depends = TOLERANCE_TRIED_BY,                                   \
         .label = "method",       .help = "how trials were made"},                                 \
        {COLUMN(S, about.rays), .flags = COLUMN_EXTRA | COLUMN_ASSUMED,                            \
         .name = "rays",        .depends = TOLERANCE_TRIED_BY,                                     \
         .label = "rays",       .help = "those of each field and wavelength"},                     \
        LENS_TITLE_COLUMN(S, about.lens), LENS_WARNING_COLUMN(S, about.warning)

/* What a row is of. */
#define TOLERANCE_CRITERION_COLUMNS(S)                                                             \
    LENS_POSITION_COLUMN(S, position, COLUMN_BRIEF),                                               \
        {COLUMN(S, criterion), .flags = COLUMN_BRIEF, .name = "criterion", .label = "criterion",   \
         .help = "what lenses are judged by"},                                                     \
        {COLUMN(S, of), .flags = COLUMN_BRIEF, .name = "of", .label = "of",                        \
         .help = "worst or mean of all fields and positions, or the field"},                       \
    {                                                                                              \
        COLUMN(S, unit), .flags = COLUMN_BRIEF, .name = "unit", .label = "unit",                   \
                         .help = "of its figures"                                                  \
    }

struct tolerance_about tolerance_about_of(const struct tolerance_job *job);

/* "10deg", "3mm"; of a position "lens"; of null "worst" or "mean". */
const char *tolerance_name_of(const struct tolerance_job *job,
                              const struct tolerance_figure *figure);
const char *tolerance_position_of(const struct tolerance_job *job,
                                  const struct tolerance_figure *figure);

/* How far the image plane went, mm; NaN where it stays but for what else is adjusted, which may be
   its gap. */
double tolerance_refocus_of(const struct tolerance_job *job, double refocus);

/* What movements of a compensator are multiplied with to be in `unit`: mm, or of angles deg. */
double tolerance_move_scale(const struct compensator *one, const char **unit);

/* "5:-1 0.02 mm, ay9 0.1 deg" of the movements of a lens, the refocus first, which is left out;
   null: nothing else is adjusted. */
const char *tolerance_moves_in_words(const struct tolerance_job *job, const double *moves);

#endif
