/* commands/design/design.h - what fit, optimize and tolerance share. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_DESIGN_DESIGN_H
#define LENSCALC_COMMANDS_DESIGN_DESIGN_H

#include "cli/question/division.h"
#include "commands/lens/lens_options.h"
#include "design/merit/merit.h"

/* What is seen of a lens while it changes, and by which rays; `positions`: of --position. */
#define DESIGN_VIEW_OPTIONS(S, positions)                                                          \
    ENTRY(                                                                                         \
        OPTION(S, waves), .name = "wavelength", .letter = 'w',                                     \
        .dimension = &dimension_wavelength_um, .unit = "nm", .value = "WAVES",                     \
        .help =                                                                                    \
            "wavelengths to evaluate, each with a weight: d:1,F:0.5; default those of the lens"),  \
        LENS_FIELDS_OPTION(S, question),                                                           \
        ENTRY(OPTION(S, question.position), .name = "position", .value = "NAMES",                  \
              .help = positions "; default all"),                                                  \
        LENS_FNUMBER_OPTION(S, question), LENS_SECTION_OPTION(S, question)

/* `...`: how many rays there are where nobody says it. */
#define DESIGN_RAYS_OPTIONS(S, ...)                                                                \
    ENTRY(OPTION(S, pattern), .name = "pattern", .words = patterns, .fallback = "gauss",           \
          .value = "PATTERN", .help = "sampling pattern of the pupil"),                            \
        ENTRY(OPTION(S, rays), .name = "rays", .lowest = 1, .highest = 1e5, .value = "COUNT",      \
              __VA_ARGS__)

/* What a lens that is written says of how it was found; null: nothing. */
void design_note(struct lens *lens, const char *note, struct arena *arena);

/* What a source says is of the lens that it was: nothing is stated any more, and a note says what
   became of the source, "optimized from". */
void design_note_source(struct lens *lens, const char *words, struct arena *arena);

/*
 * What of a merit the options say that optimize and tolerance share: the lens and its positions, by
 * default all, fields, wavelengths, section and f-number.
 *
 * Errors    as lens_positions and lens_fields_asked
 */
bool design_view(const struct lens_question *asked, const struct spectrum_value *waves,
                 struct arena *arena, struct merit_question *view, struct error *error);

/* The part that is asked for; of parts that are merged the first; count 0: the run is whole. */
struct part design_part(const struct run *run, struct part asked);

#endif
