/* commands/photo/focused_lens.h - a real lens focused by its gaps, before its fixed image plane. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_PHOTO_FOCUSED_LENS_H
#define LENSCALC_COMMANDS_PHOTO_FOCUSED_LENS_H

#include "commands/photo/photo_lens.h"

struct focused_question {
    const struct photo_lens_question *question; /* with a lens */
    size_t position;                            /* of that */
    const char *gaps;                           /* as commands/lens/focus_gaps.h reads them */
    double distance; /* of the subject, from where the question says, mm; may be infinite */
};

/*
 * The question for the lens as it stands when it is focused: with that as its only position.
 *
 * Formula   optics/focusing.h, at the question's wavelength, else the primary one: paraxially. Of
 *           several solutions the one that moves least
 * Errors    as focus_gaps_read and focus_solve
 */
bool focused_lens(const struct focused_question *asked, struct arena *arena,
                  struct photo_lens_question *focused, struct error *error);

#endif
