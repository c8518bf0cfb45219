/* commands/analysis/wavefront_maps.h - what lenscalc wavefront is asked, and its maps. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_ANALYSIS_WAVEFRONT_MAPS_H
#define LENSCALC_COMMANDS_ANALYSIS_WAVEFRONT_MAPS_H

#include "analysis/waves/wavefront.h"
#include "commands/analysis/analysis_map.h"

enum wavefront_mapped { MAPPED_RMS, MAPPED_STREHL };
enum { NO_ZERNIKE }; /* else enum zernike_kind + 1 */

struct wavefront_input {
    struct analysis_question question;
    int reference, zernike; /* enum wave_about; enum zernike_kind, NO_WORD: none */
    long terms, size;       /* size: NO_INTEGER = MAP_SIZE, of a drawing DRAWN_SIZE */
    bool across, fringes;
    int mapped; /* enum wavefront_mapped: by --over-field */
};

extern const struct analysis_policy wavefront_policy;

/*
 * Make a field ready.
 *
 * Errors    as wavefront_open; ERROR_USAGE: several wavelengths, of what is not polychromatic
 */
bool wavefront_field_open(const struct analysis_cursor *at, const struct analysis_case *one,
                          size_t field, bool is_polychromatic, struct wavefront_source *source,
                          struct error *error);

/* Of --plot and --map: over the pupil. */
bool wavefront_maps(const struct artifact_job *job, struct output *sink, struct error *error);
bool wavefront_check_map(const struct artifact_job *job, struct error *error);

/* Of --over-field: over the image. */
bool wavefront_over_field(const struct artifact_job *job, struct output *sink, struct error *error);
bool wavefront_check_over_field(const struct artifact_job *job, struct error *error);

#endif
