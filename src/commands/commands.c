/* commands/commands.c - the table of commands: one line each. */
/* SPDX-License-Identifier: MIT */
#include "commands/commands.h"

extern const struct command command_dof, command_hyperfocal, command_fov;
extern const struct command command_exposure, command_flash, command_bracket, command_motion,
    command_stars;
extern const struct command command_focus, command_diffraction, command_equivalent;
extern const struct command command_visual, command_microscope;
extern const struct command command_pinhole;
extern const struct command command_tilt, command_panorama, command_timelapse;
extern const struct command command_survey, command_projector;
extern const struct command command_refract, command_lensmaker;
extern const struct command command_trace, command_check, command_pupil, command_draw;
extern const struct command command_lens, command_surfaces, command_sag, command_matrix,
    command_conjugate;
extern const struct command command_seidel, command_color;
extern const struct command command_list, command_glass, command_convert;
extern const struct command command_spot, command_fan, command_field, command_wavefront,
    command_mtf, command_psf, command_energy, command_spread;
extern const struct command command_distortion;
extern const struct command command_fit, command_optimize, command_tolerance, command_merge,
    command_render;
extern const struct command command_tone;
extern const struct command command_bench, command_help, command_completion;
extern const struct command command_illumination, command_report;

const struct command *const commands[] = {
    &command_dof,
    &command_hyperfocal,
    &command_fov, /* photography */
    &command_focus,
    &command_exposure,
    &command_flash,
    &command_bracket,
    &command_motion,
    &command_stars,
    &command_diffraction,
    &command_equivalent,
    &command_pinhole,
    &command_tilt,
    &command_panorama,
    &command_timelapse,
    &command_survey,
    &command_projector,
    &command_visual,
    &command_microscope,
    &command_refract,
    &command_lensmaker, /* one surface, one lens */
    &command_lens,
    &command_surfaces,
    &command_sag,
    &command_matrix,
    &command_conjugate,
    &command_trace,
    &command_check,
    &command_pupil,
    &command_draw, /* a lens */
    &command_seidel,
    &command_spot,
    &command_illumination,
    &command_fan,
    &command_wavefront,
    &command_psf,
    &command_energy,
    &command_spread,
    &command_mtf,
    &command_field,
    &command_color,
    &command_distortion,
    &command_report, /* analyses */
    &command_fit,
    &command_optimize,
    &command_tolerance,
    &command_merge, /* design */
    &command_render,
    &command_tone, /* camera */
    &command_list,
    &command_glass,
    &command_convert, /* data */
    &command_bench,
    &command_help,
    &command_completion, /* tool */
    NULL,
};

const struct command *command_find(struct text name)
{
    for (size_t i = 0; commands[i] != NULL; i++) {
        if (text_equal(name, commands[i]->name)) {
            return commands[i];
        }
    }
    return NULL;
}
