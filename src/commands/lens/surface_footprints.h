/* commands/lens/surface_footprints.h - what surfaces is asked, and beams on each surface. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_LENS_SURFACE_FOOTPRINTS_H
#define LENSCALC_COMMANDS_LENS_SURFACE_FOOTPRINTS_H

#include "commands/lens/lens_options.h"

enum surfaces_show { SURFACES_PARAXIAL, SURFACES_FOOTPRINTS };

struct surfaces_input {
    struct lens_question question;
    int show; /* enum surfaces_show */
    bool clip, no_clip;
};

extern const struct sheet footprint_sheet;

/* The rows of --show footprints: field by field, surface by surface. */
bool footprint_rows(const struct surfaces_input *input, struct run *run, struct error *error);

/* Their drawing: a panel a surface. */
bool footprint_figure(const struct artifact_job *job, struct output *sink, struct error *error);

#endif
