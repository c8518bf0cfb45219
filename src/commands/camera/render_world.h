/* commands/camera/render_world.h - scenes that are photographed, and the cameras in them. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_CAMERA_RENDER_WORLD_H
#define LENSCALC_COMMANDS_CAMERA_RENDER_WORLD_H

#include "commands/camera/render.h"
#include "scene/lights.h"

/* Stars of a scene that do not say how wide they are. */
struct render_stars {
    double diameter;  /* that they have, rad; NaN: there are none */
    bool are_a_pixel; /* as wide as one */
};

/* A scene that is photographed. */
struct render_world {
    struct scene scene;
    bool moves, scatters; /* anything in it: the camera, too */
    struct bands bands;
    struct bands seen; /* the same behind the colour of a filter, whose greys are left out */
    double white[3]; /* linear sRGB of white there; of three bands 1: render_filter sees to them */
    struct world world;
    struct lights lights;
    struct path path;
    struct view view;
    struct render_stars stars;
    const char *enclosed; /* what the camera stands within, in words; null: nothing closed */
};

/* Errors: ERROR_USAGE: options that are of cards only; of a card those that are of scenes only */
bool render_check_world(const struct artifact_job *job, struct error *error);

/*
 * Read the scene of the job.
 *
 * Given     world  receives `scene` and its bands
 * Errors    ERROR_IO; as scene_file_read, scene_check and bands_many; ERROR_USAGE: what moves
 *           without an exposure time, or several times in one part
 */
bool render_world_read(const struct artifact_job *job, struct render_world *world,
                       struct error *error);

/*
 * On what the lens is focused: as asked for, as the scene says, or on what is seen at a place. What
 * the scene says counts from where it has the camera, unless its line or --from says otherwise.
 *
 * Given     focused  receives the input with the distance
 * Errors    ERROR_USAGE: nobody says; as render_open
 */
bool render_world_focus(const struct artifact_job *job, struct render_world *world,
                        struct render_input *focused, struct error *error);

/*
 * Make it ready for a picture.
 *
 * Given     question  of the picture: receives its view, and how exact it is to be
 * Errors    ERROR_DOMAIN: something stands within the lens; as world_open, lights_open
 */
bool render_world_open(const struct artifact_job *job, const struct analysis_case *one,
                       struct render_world *world, struct photograph_question *question,
                       struct error *error);

/* Wavelengths of the lens in place of those of red, green and blue; as render_colours. */
struct spectrum_value render_world_colours(const struct render_world *world, struct arena *arena);

/* The plane in focus, as seen from where the scene has the camera, and from the film. */
const char *render_focus_text(const struct analysis_case *one, struct arena *arena);

/* What is to be known of it. */
void render_say_world(const struct render_world *world, struct text_buffer *remarks);

/* In words; null: there are none. */
const char *render_stars_text(const struct render_world *world, struct arena *arena);

#endif
