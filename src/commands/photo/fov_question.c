/* commands/photo/fov_question.c - what answers of `fov` share, whatever the lens. */
/* SPDX-License-Identifier: MIT */
#include "commands/photo/fov_question.h"
#include "photo/pixel_density.h"

#include <math.h>

const struct word fov_tasks[] = {
    {"none", "no task"},
    {"monitor", "12.5 px/m, IEC 62676-4:2014 as the next five"},
    {"detect", "25 px/m"},
    {"observe", "62.5 px/m"},
    {"recognise", "125 px/m"},
    {"identify", "250 px/m"},
    {"inspect", "1000 px/m"},
    {"overview", "20 px/m, IEC 62676-4:2025 as the rest"},
    {"outline", "40 px/m"},
    {"discern", "80 px/m"},
    {"perceive", "125 px/m"},
    {"characterise", "250 px/m"},
    {"validate", "500 px/m"},
    {"scrutinise", "1500 px/m"},
    {NULL, NULL},
};

const struct fov_row fov_row_none = {
    .setting = {RECTILINEAR, NAN, NAN, NAN, NAN},
    .fov = {NAN, NAN, NAN, NAN, NAN, NAN, NULL},
    .focal = NAN,
    .converter = NAN,
    .magnification = NAN,
    .width = NAN,
    .height = NAN,
    .crop = NAN,
    .pitch = NAN,
    .image = NAN,
    .sensor_distance = NAN,
    .circle = NAN,
    .ground = {NAN, NAN, NAN, NAN},
    .sky = {NAN, NAN, NAN, NAN, NAN, NULL, NAN, NAN},
    .fx = NAN,
    .per_degree = NAN,
    .breathing = NAN,
    .real = {.focal = NAN, .hiatus = NAN, .wavelength = NAN, .rear = NAN},
    .rays = {NAN, NULL, NULL},
    .fnumber = NAN,
    .depth = NAN,
    .blur = NAN,
};

int fov_goals_fields(const struct fov_goals *goals)
{
    return !isnan(goals->field_width) + !isnan(goals->field_height) +
           !isnan(goals->field_diagonal) + !isnan(goals->pixel);
}

struct fov_goals fov_input_goals(const struct fov_input *input)
{
    const bool is_size = !isnan(input->field.width);
    return (struct fov_goals){
        .horizontal = input->horizontal,
        .vertical = input->vertical,
        .diagonal = input->diagonal,
        .field_width = is_size ? input->field.width : input->field_width,
        .field_height = is_size ? input->field.height : input->field_height,
        .field_diagonal = input->field_diagonal,
        .pixel = 1 / input->density,
    };
}

bool fov_fill_pixels(const struct fov_input *input, struct fov_row *row, struct error *error)
{
    const bool is_near = row->magnification > 0 && !isnan(row->pitch);
    row->density =
        is_near ? pixel_density(row->magnification, row->pitch, input->squeeze) : (double)NAN;
    row->object_pixel = 1 / row->density;
    row->speed = row->line_rate = NAN;
    /* rows of other commands bring the speed of something else */
    if (!input->line_scan || (isnan(input->speed) && isnan(input->line_rate))) {
        return true;
    }
    row->speed = input->speed;
    row->line_rate = input->line_rate;
    if (!is_near) {
        return fail(error, ERROR_USAGE, "{--%s} needs a finite {--distance}, or a field",
                    isnan(input->speed) ? "line-rate" : "speed");
    }
    if (isnan(row->speed)) {
        row->speed = input->line_rate / row->density;
    } else {
        row->line_rate = line_rate(row->speed, row->density);
    }
    return true;
}
