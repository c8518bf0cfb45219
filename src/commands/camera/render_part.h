/* commands/camera/render_part.h - parts of a picture: their tiles in files, and back. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_CAMERA_RENDER_PART_H
#define LENSCALC_COMMANDS_CAMERA_RENDER_PART_H

#include "cli/question/division.h"
#include "commands/camera/render.h"

#include <time.h>

/* A picture that is divided, is merged, or neither; internal but for its place. */
struct render_part {
    const struct artifact_job *job;
    const struct photograph_question *question;
    struct part_head head;         /* of the part that is made, or of the run that is merged */
    struct part_range own;         /* tiles that are to be taken */
    size_t tiles;                  /* of the whole picture */
    unsigned char *done;           /* of each */
    const struct part_file *files; /* with tiles that are there already */
    size_t file_count;
    uint64_t counts[PHOTOGRAPH_COUNTS]; /* of these */
    bool is_filled;
    time_t saved; /* when it was written last */
};

/* Is a part asked for, rather than a picture? */
bool render_is_part(const struct artifact_job *job);

/* Errors: ERROR_USAGE: parts in files that are not called so, a merged picture that is */
bool render_check_part(const struct artifact_job *job, struct error *error);

/*
 * Before a picture is taken.
 *
 * Given     scene     digest of its files; "": of a card, whose file is asked for
 *           question  of all of it; receives which tiles are to be taken: those of the part that no
 *                     file of it has yet, of a merged run none
 *           part      must stay where it is as long as the question is asked
 * Errors    as division_head and division_read; ERROR_DATA: a file that is not of this run
 */
bool render_part_begin(const struct artifact_job *job, const struct analysis_case *one,
                       const char *scene, struct photograph_question *question,
                       struct render_part *part, struct error *error);

/* After it: tiles that were there already go into it; it is incomplete if some are missing. */
void render_part_fill(struct render_part *part, struct photograph *photograph);

/* The file of the part; what is incomplete becomes the shortfall of the run. */
void render_part_write(struct render_part *part, struct photograph *photograph,
                       struct output *sink);

#endif
