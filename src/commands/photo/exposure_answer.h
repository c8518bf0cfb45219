/* commands/photo/exposure_answer.h - one question about exposure, answered; and about lamps. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_PHOTO_EXPOSURE_ANSWER_H
#define LENSCALC_COMMANDS_PHOTO_EXPOSURE_ANSWER_H

#include "base/error.h"
#include "cli/options/option_light.h"
#include "commands/photo/photo_lens.h"
#include "photo/exposure.h"
#include "photo/neutral.h"

#include <stdbool.h>

/* What the options say of lamps; NaN = not given. */
struct lamps {
    double kelvin, balance; /* colour temperature of the light, and that of film or camera, K */
    double mains;           /* Hz */
};

/* What is answered of them; NaN and null = absent. */
struct lamp_row {
    double kelvin, balance, shift, filtered, wanted, conversion_shift;
    const char *conversion;
    double mains, free_time;
    const char *flicker, *free_times, *free_angles;
};

/* What is given; NaN = not given. Options of the command. */
struct exposure_input {
    struct exposure_given given; /* its f-number comes with the lens */
    struct scene_value scene;
    struct loss_value filter;
    double transmittance, t_stop, magnification;
    double shutter_angle, frame_rate;
    struct film_value film;
    double corrected_time;
    double metered; /* s, without what takes light */
    bool focal_plane;
    double vignetting, off_axis;
    struct series_value series;
    bool equivalent;
    struct photo_lens_question lens;
    struct lamps lamps;
    bool propose; /* which filters make the time so long */
    struct filters_value own;
    bool fresnel; /* with what its faces reflect */
};

/* Everything about one exposure; NaN and null = absent. */
struct exposure_row {
    struct exposure x;
    const char *nominal_fnumber, *nominal_time, *nominal_iso;
    double metered, time_to_set; /* s, of a question with --metered */
    const char *timer;           /* time_to_set in words; filled in by the command */
    double residual, label_residual;
    double deviation, compensation, loss, transmittance, t_stop, magnification;
    double corrected_time, reciprocity_stops;
    double shutter_angle, frame_rate;
    double q, focal_plane, glass, off_axis, vignetting;
    double K, C;
    struct photo_real real;
    double pupil;                  /* of a real lens */
    const char *traced, *spectrum; /* by which rays the T-stop is; null: by none */
    const char *speed, *filter, *film, *film_source, *scene, *scene_source;
    struct lamp_row lamps; /* filled in by the command */
    /* of a question which filters to put on */
    const char *proposed;
    double wanted, longer; /* s, stops */
    double stops_wanted;   /* all that is to be taken off */
};

/* Is an exposure asked for at all, or only what lamps do, perhaps in a given time? */
bool exposure_is_asked(const struct exposure_input *input);

/*
 * The questions with filters put on that come nearest to the wanted time, --time, from both sides.
 *
 * Given     input      what is left to be found without --time is the time
 *           arena      of what is found
 *           questions  receives them, each to be answered by exposure_answer
 *           proposed   receives the filters of each
 *           stops      receives what is to be taken off, as metered
 *           count      receives their number, 1 to NEUTRAL_STACKS
 * Errors    ERROR_USAGE: no --time, or nothing to find it by; ERROR_DOMAIN: the time is as long
 *           without a filter; as exposure_answer and neutral_stacks
 */
bool exposure_propose(const struct exposure_input *input, struct arena *arena,
                      struct exposure_input questions[NEUTRAL_STACKS],
                      const char *proposed[NEUTRAL_STACKS], size_t *count, double *stops,
                      struct error *error);

/* A row without an exposure but its time. Errors as shutter_solve. */
bool exposure_blank(const struct exposure_input *input, struct exposure_row *row,
                    struct error *error);

/*
 * Solve for what is not given, and all that follows from it but exposure_label's.
 *
 * Errors    what the cores refuse (photo/exposure.h, stops.h, reciprocity.h); two ways to say one
 *           thing (ERROR_USAGE)
 */
bool exposure_answer(const struct exposure_input *input, struct exposure_row *row,
                     struct error *error);

/* Labels of the series next to an answer's settings, and how far these are off. */
void exposure_label(const struct exposure_input *input, struct exposure_row *row);

/*
 * One of the equal exposures.
 *
 * Given     answer  of exposure_answer;  step  of the f-number in the input's series, f/1 is 0
 * Result    line    false where f-number or time have no label
 */
bool exposure_equivalent_row(const struct exposure_input *input, const struct exposure_row *answer,
                             int step, struct exposure_row *line);

/*
 * Answer what is asked of lamps: their colour, their flicker.
 *
 * Given     filter   before the lens, mired, as struct loss_value has it; 0 for none
 *           t, rate  exposure time, s, and frames per second; NaN = not known
 * Errors    --balance without --kelvin (ERROR_USAGE); as photo/mired.h and photo/flicker.h
 */
bool lamps_answer(const struct lamps *lamps, double filter, double t, double rate, struct run *run,
                  struct lamp_row *row, struct error *error);

#endif
