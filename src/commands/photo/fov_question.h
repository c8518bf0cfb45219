/* commands/photo/fov_question.h - what `fov` is asked, and the rows that answer it. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_PHOTO_FOV_QUESTION_H
#define LENSCALC_COMMANDS_PHOTO_FOV_QUESTION_H

#include "commands/photo/by_rays.h"
#include "commands/photo/photo_lens.h"
#include "commands/photo/pixels.h"
#include "commands/photo/sharpness.h"
#include "commands/photo/sky_subject.h"
#include "photo/fov_solve.h"

/* How angles are found: by the lens's rays, or a projection of photo/fov.h behind them. */
enum view_way { VIEW_AUTO, VIEW_RAYS, VIEW_PROJECTIONS };

/* The words of --projection for them, in that order, the projections behind them. */
extern const struct word fov_ways[];

/* The options of the command fill it; lengths in mm, angles in rad, NaN = not given. */
struct fov_input {
    double distance, magnification, squeeze;
    struct photo_lens_question lens;
    struct sensor_value sensor;
    int projection;
    double horizontal, vertical, diagonal;            /* wanted angles, rad */
    double field_width, field_height, field_diagonal; /* wanted fields, mm */
    struct size_value field;                          /* width and height at once */
    bool telecentric;                                 /* no focal length, a magnification */
    double fnumber, na, blur; /* its working f-number or aperture at the subject, and px allowed */
    struct pixels_value pixels;
    double pitch;            /* of the pixels, mm */
    double density;          /* wanted pixels on the subject, px/mm */
    int task;                /* 1 + index into viewing_tasks; 0 = none */
    bool dori;               /* one row for each of the first DORI_TASKS */
    bool line_scan;          /* the sensor is one row of pixels */
    double speed, line_rate; /* of what passes it, mm/s and Hz */
    double altitude, gsd;    /* of a camera in the air, mm */
    double converter, crop;  /* factors */
    struct sky_question sky;
    double fx;     /* focal length in pixels */
    bool is_bare;  /* pixels of no known size: no length on the sensor is known */
    bool portrait; /* the camera is held upright */
    bool is_pair;  /* the distance is that of an angle and a field */
    int focus_by;
    const char *gap;
    /* of a lens that is focused by its gaps, as it stands for infinity, and its position */
    const struct photo_lens *at_infinity;
    const char *position;
};

struct fov_row {
    struct fov_setting setting;
    struct fov fov;
    double focal, converter; /* of the lens alone, mm; the converter's factor */
    double magnification, width, height, crop, image, sensor_distance, circle, pitch;
    struct fov_ground ground;
    struct sky_row sky;
    double breathing; /* NaN: not asked for */
    struct photo_real real;
    struct by_rays_row rays;
    const char *solved_for, *solved_by; /* null: everything was given */
    double density, object_pixel;       /* px/mm and mm in the plane of focus; NaN = not known */
    double fx;                          /* scale in pixels a radian; NaN = not known */
    double per_degree;                  /* the same by the degree */
    const char *task;
    double speed, line_rate;
    double fnumber, depth, blur; /* of a telecentric lens: mm, and px */
    const char *sensor, *projection, *from;
};

/* The words of --task, `none` first. */
extern const struct word fov_tasks[];

/* The row of a lens of which nothing is known. */
extern const struct fov_row fov_row_none;

/* What is wanted, in the plane of focus and as angles. */
struct fov_goals fov_input_goals(const struct fov_input *input);

/* How many fields are wanted, a pixel's among them. */
int fov_goals_fields(const struct fov_goals *goals);

/* The pixels in the plane of focus, and how fast they are scanned. Errors: a speed without them. */
bool fov_fill_pixels(const struct fov_input *input, struct fov_row *row, struct error *error);

/* Answer for a telecentric lens, whose field is the sensor over its magnification; of another where
   a field on a sensor is all that is known. */
bool fov_telecentric(const struct fov_input *input, struct run *run, struct error *error);

/*
 * A focal length in pixels as one in mm: by the pitch of the pixels, or of any pitch where none is
 * known.
 *
 * Formula   fx = f (1 + m)/pitch = 1/((1/f - 1/s) pitch)
 * Source    pinhole model of a camera; thin lens
 * Errors    ERROR_USAGE: pixels of which neither pitch nor number is known
 */
bool fov_take_pixels(struct fov_input *input, struct error *error);

/* The sensor and its pixels of a camera that is held upright. */
void fov_hold_upright(struct fov_input *input, struct arena *arena);

/*
 * Is it a question that needs no lens: how far away a subject of a size and angle is, how many
 * pixels lie over a field, how large a field is on a sensor? And its answer.
 */
bool fov_is_bare(const struct fov_input *input);
bool fov_bare(const struct fov_input *input, struct run *run, struct error *error);

/*
 * An angle of view and the same side of a field, in place of which the distance is put.
 *
 * Result    was there such a pair, and nothing else that settles the view?
 * Formula   s = W/(2 tan(a/2)), from the entrance pupil
 * Source    geometry
 */
bool fov_take_pair(struct fov_input *input);

/* The `run` of the command. */
bool fov_run(const void *data, struct run *run, struct error *error);

#endif
