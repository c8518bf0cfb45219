/* commands/camera/tone.h - what lenscalc tone is asked, and what it makes. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_CAMERA_TONE_H
#define LENSCALC_COMMANDS_CAMERA_TONE_H

#include "cli/question/command.h"
#include "optics/growing.h"
#include "tone/debevec.h"
#include "tone/merge.h"
#include "tone/operator.h"

struct tone_input {
    const char *files; /* FILE or FILE=TIME, separated by OPTION_MANY_SEPARATOR */
    const char *times; /* "30,15,1/2"; null = of the files */
    int response;      /* enum tone_response */
    bool align;
    double full_well, read_noise;   /* electrons; NaN = of the files, or assumed */
    double calibrate, iso, fnumber; /* cd/m^2; NaN = not given */
    int operation;                  /* enum tone_asked */
    int ceiling;                    /* enum histogram_ceiling */
    double white, gamma, view;      /* cd/m^2, NaN = chosen; view in rad */
    const char *display;            /* "1,100" */
    bool glare, color_loss, acuity;
    bool falsecolor;
    const char *scale; /* "0.1,1000"; null = whole decades of the picture */
    long bits;         /* 0 = the usual ones */
};

enum tone_response { RESPONSE_FILE, RESPONSE_DEBEVEC };
enum tone_asked { ASKED_AUTO, ASKED_NONE, ASKED_FIRST }; /* then enum tone_operator */

/* -------- commands/camera/tone_frames.c -------- */

/* The frames as they were read, and what their files say. */
struct tone_frames {
    struct tone_frame *frames;
    size_t count;
    bool is_timed;                /* by the command line: a picture alone has its time, too */
    double iso, fnumber;          /* NaN = nobody says */
    double full_well, read_noise; /* the same */
    double white;     /* cd/m^2 of the first frame's value of 1, as lenscalc render notes; NaN */
    const char *unit; /* that a file of floats says; null = it says none */
    const char *filtered, *filter; /* a file that notes a filter, and that; null: none does */
};

/*
 * Read all frames.
 *
 * Errors    as image_file_read and frame_take; a time that is missing, given twice or not from
 *           1e-9 to 1e9 s; frames of different sizes; raw data, densities; luminances with a time
 */
bool tone_frames_read(const struct tone_input *input, struct arena *arena,
                      struct tone_frames *frames, struct error *error);

/* -------- commands/camera/tone_light.c -------- */

/* The scene's light, made once for all that is written of it. */
struct tone_light {
    struct image image; /* cd/m^2; the one picture that is made of it alters it in place */
    bool is_taken;      /* by that */
    struct response_curve curves[FRAME_CHANNELS]; /* of RESPONSE_DEBEVEC */
    struct text remarks;
};

bool tone_light_of(const struct artifact_job *job, struct tone_light **light, struct error *error);

/* -------- commands/camera/tone_picture.c -------- */

file_types tone_picture_types;
bool tone_picture_check(const struct artifact_job *job, struct error *error);
bool tone_picture(const struct artifact_job *job, struct output *sink, struct error *error);

#endif
