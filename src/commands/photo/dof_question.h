/* commands/photo/dof_question.h - what `dof` is asked, and the setting that answers it. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_PHOTO_DOF_QUESTION_H
#define LENSCALC_COMMANDS_PHOTO_DOF_QUESTION_H

#include "commands/photo/attachments.h"
#include "commands/photo/by_rays.h"
#include "commands/photo/photo_lens.h"
#include "commands/photo/sharpness.h"
#include "photo/dof.h"
#include "photo/dof_plan.h"
#include "photo/dof_solve.h"

/* The options of the command fill it; NaN = not given. */
struct dof_question {
    double distance, na;
    struct photo_lens_question lens;
    struct sharpness sharp;
    int model;
    struct dof_targets targets;
    bool stack, rail;
    double overlap;
    struct sensor_value other;
    struct attachments attached;
    double squeeze, t_stop;
    double blur_at, blur_behind; /* a point from where distances are measured, or the subject */
};

/* A point out of focus, and how blurred it is; NaN = not asked for. */
struct dof_background {
    double principal;             /* distance from the front principal plane, mm */
    double distance;              /* as distances are measured, mm */
    double blur;                  /* diameter on the sensor, mm */
    double of_diagonal, of_width; /* as parts of those of the sensor */
    double pixels;
};

extern const struct dof_background dof_background_none;

/*
 * The point that --blur-at or --blur-behind names.
 *
 * Given     setting  solved
 *           offset   from the front principal plane to where distances are measured from, mm
 * Errors    ERROR_USAGE: beside --exact; as dof_blur_at
 */
bool dof_question_background(const struct dof_question *input, const struct dof_setting *setting,
                             double offset, struct dof_background *background, struct error *error);

/* Is a magnification all that is known of lens and distance? The depth follows from it. */
bool dof_question_is_magnification(const struct dof_question *input,
                                   const struct dof_setting *setting);

/* enum photo_lens_use: a real lens's own f-number does not count where that is what is wished. */
int dof_question_use(const struct dof_question *input);

/*
 * The lens with the f-number that has the numerical aperture at the subject.
 *
 * Given     lens  of the question;  stopped  receives it
 * Errors    ERROR_USAGE: no focal length, no distance and no magnification
 */
bool dof_question_stop(const struct dof_question *input, const struct photo_lens *lens,
                       struct photo_lens *stopped, struct error *error);

/*
 * What is known of the setting: the lens with its attachments, and the circle of confusion.
 *
 * Given     lens      of the question
 *           room      as attachments_apply, as `attached`
 *           setting   receives what is known, NaN for the rest
 * Errors    as attachments_apply and sharpness_resolve; ERROR_USAGE: a T-stop without an
 *           f-number, what rays do not answer
 */
bool dof_question_open(const struct dof_question *input, const struct photo_lens *lens,
                       struct photo_lens *room, struct attached_lens *attached,
                       struct dof_setting *setting, struct error *error);

/*
 * The rest of the setting, by the wishes; with nothing but a tube or close-up lens the subject is
 * where the lens itself is focused at infinity.
 *
 * Errors    as distance_solve; a subject out of the reach of the attachments or inside the lens
 */
bool dof_question_solve(const struct dof_question *input, const struct attached_lens *attached,
                        struct dof_setting *setting, struct error *error);

/*
 * The shots of a focus stack: its near end is --near, --far less --dof, or the near limit of a
 * first shot at the magnification; its far end --far, or --dof behind the near one. What of f, N
 * and c is NaN follows from the magnification with a near end, and from the hyperfocal distance.
 *
 * Given     setting  as dof_question_open has it; receives the rest but s
 * Errors    ERROR_USAGE: ends that are not given, or said twice; an own distance, the Airy disc,
 *           another model, distances from the sensor; as distance_solve and dof_plan_make
 */
bool dof_question_plan(const struct dof_question *input, const struct photo_lens *lens,
                       struct dof_setting *setting, struct dof_plan *plan, struct error *error);

/*
 * The stack of a camera on a rail: as deep as --dof says, at the magnification.
 *
 * Errors    ERROR_USAGE: these not given, others that are; as dof_rail_plan
 */
bool dof_question_rail(const struct dof_question *input, const struct dof_setting *setting,
                       struct dof_rail *rail, struct error *error);

/*
 * Limits, focus and blurs by the rays of the lens in place of those that formulas gave.
 *
 * Given     setting  solved; its distance is met again where that is from the sensor
 *           dof      of dof_compute
 * Errors    as by_rays_open and real_range_find
 */
bool dof_question_by_rays(const struct dof_question *input, const struct attached_lens *attached,
                          struct run *run, struct dof_setting *setting, struct dof *dof,
                          struct by_rays_row *rays, struct error *error);

/* Draw the depth-of-field scale of the barrel, an artifact of the command. */
bool dof_draw_scale(const struct artifact_job *job, struct output *sink, struct error *error);

#endif
