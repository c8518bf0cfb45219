/* commands/lens/trace_answer.h - the questions and answers of lenscalc trace. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_LENS_TRACE_ANSWER_H
#define LENSCALC_COMMANDS_LENS_TRACE_ANSWER_H

#include "commands/lens/lens_options.h"
#include "trace/kernel/rays.h"

#include <math.h>

/* What the options say of lens and rays. Compared byte by byte: values only, set by copying. */
struct ray_question {
    struct lens_value lens;
    const char *position;
    double fnumber; /* NaN = that of the lens */
    struct plane_value focus;
    struct target_value to;
    bool clip, no_clip;
};

/* One lens in one position at one wavelength, and where its rays end. */
struct ray_case {
    struct setup setup;
    bool clip;
    bool to_image;       /* rays end on the image plane */
    size_t surfaces;     /* else behind so many surfaces */
    const char *warning; /* null = all is well */
};

#define RAY_FOCUS_OPTION(S, member)                                                                \
    ENTRY(OPTION(S, member.focus), .name = "focus", .dimension = &dimension_length, .unit = "mm",  \
          .value = "PLANE",                                                                        \
          .help = "the image plane: paraxial, table, best, or mm from the "                        \
                  "last vertex; default that of the lens")

#define RAY_CLIP_OPTIONS(S, member)                                                                \
    ENTRY(OPTION(S, member.clip), .name = "clip",                                                  \
          .help = "clip rays at apertures and stop (default)"),                                    \
        ENTRY(OPTION(S, member.no_clip), .name = "no-clip",                                        \
              .help = "do not clip rays at clear apertures")

/*
 * Make a lens ready.
 *
 * Given     position    from 0
 *           wavelength  um; NaN = primary
 *           field       in place of those of the lens; null = those
 *           arena       for all that the case points to
 * Errors    ERROR_USAGE: --clip and --no-clip, a surface that is not there; ERROR_DOMAIN: as
 *           setup_open and setup_place_image, no image plane where rays are to end there, no stop
 *           for the f-number
 */
bool ray_case_open(const struct ray_question *question, size_t position, double wavelength,
                   const struct setup_field *field, struct arena *arena, struct ray_case *one,
                   struct error *error);

/* The case's own system, clipped as the question says, with the image plane if rays end there. */
const struct system *ray_case_system(const struct ray_case *one, struct error *error);

struct trace_input {
    struct ray_question question;
    double wavelength;       /* um; NaN = primary */
    double field, field_x;   /* rad; NaN = not given */
    double height, height_x; /* mm at the image */
    struct vector_value point, direction;
    double at[3], cosine[3]; /* the same as six numbers; NaN = not given */
    struct pupil_value pupil;
    double pupil_at[2]; /* the same as two numbers; NaN = not given */
    int aim, pattern;
    long rays, seed;
    bool all, paraxial, verify, real;
};

enum { AIM_STOP, AIM_ENTRANCE };

/* --pattern: the few rays that everyone wants to see, else 1 + enum pattern. */
enum { TRACE_FEW };

struct trace_row {
    const char *position, *ray, *status, *focus, *lens, *warning;
    double wavelength;    /* um */
    double field, height; /* rad; mm; one of them is absent */
    double field_x, height_x;
    double pupil[2], weight;          /* in units of its radius; absent for a ray as given */
    double start[3], start_cosine[3]; /* mm */
    double point[3], cosine[3], path; /* mm */
    double incidence, refraction;     /* rad */
    double paraxial[2], slope[2];     /* mm */
    double point_error, cosine_error, path_error;
    double image; /* mm */
    long surface;
};

/* Does the input say where a ray starts? */
bool trace_is_explicit(const struct trace_input *input);

/* Does it name a point of the pupil? */
static inline bool trace_has_pupil(const struct trace_input *input)
{
    return input->pupil.is_given || !isnan(input->pupil_at[0]) || !isnan(input->pupil_at[1]);
}

/* Does it name a field? */
static inline bool trace_has_field(const struct trace_input *input)
{
    return !isnan(input->field) || !isnan(input->field_x) || !isnan(input->height) ||
           !isnan(input->height_x);
}

/*
 * The ray that the input says.
 *
 * Errors    ERROR_USAGE, ERROR_DOMAIN: point and numbers, some of three numbers, a direction of
 *           length 0, cosines whose squares do not add up to 1 (within 0.001: rounded to three
 *           decimals), a field beside them
 */
bool trace_start(const struct trace_input *input, struct ray *ray, struct error *error);

/* All rows of one input, a struct trace_input. */
bool trace_answer(const void *data, struct run *run, struct error *error);

/* Many inputs that say one ray each; see struct command. */
void trace_block(const struct block *block, struct run *run);

/* Internal to trace_answer.c and trace_block.c: rays at one wavelength, and what a row says. */
struct trace_job {
    const struct trace_input *input;
    const struct ray_case *one;
    const struct system *system;         /* clipped if the input says so */
    const struct system *open, *clipped; /* for rays of fields: without clip, and with it */
    double wavelength;                   /* um */
    size_t to;                           /* place before which rays end */
    struct trace_row blank;              /* what is the same in all rows */
};

bool trace_job_open(const struct trace_input *input, const struct ray_case *one,
                    struct trace_job *job, struct error *error);

/* A row without its results: the blank, and the start. */
static inline void trace_row_begin(const struct trace_job *job, const struct ray *start,
                                   struct trace_row *row)
{
    *row = job->blank;
    for (int i = 0; i < 3; i++) {
        row->start[i] = start->point[i];
        row->start_cosine[i] = start->cosine[i];
    }
}

/* The end of a ray: `block` after the trace to job->to. */
void trace_row_end(const struct trace_job *job, const struct ray_block *block, size_t lane,
                   struct trace_row *row);

/* --paraxial and --verify; `place` is the surface of the row. */
bool trace_row_extras(const struct trace_job *job, const struct ray *start, size_t place,
                      struct arena *arena, struct trace_row *row, struct error *error);

#endif
