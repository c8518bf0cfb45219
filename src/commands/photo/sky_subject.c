/* commands/photo/sky_subject.c - pixels against the sky, and the images of what is there. */
/* SPDX-License-Identifier: MIT */
#include "commands/photo/sky_subject.h"

#include <math.h>

bool sky_focal_length(const struct sky_question *question, double pitch,
                      struct fov_setting *setting, struct error *error)
{
    if (isnan(question->scale)) {
        return true;
    }
    if (isnan(pitch)) {
        return fail(error, ERROR_USAGE,
                    "{--pixel-scale} needs the pixel pitch: give {--pitch}, or a camera as "
                    "{--sensor}");
    }
    return fov_focal_length(setting, pitch, 2 * atan(question->scale / 2), &setting->f, error);
}

bool sky_fill_subject(const struct sky_question *question, double distance, struct sky_row *row,
                      struct error *error)
{
    const bool has_subject = question->subject > 0, has_size = !isnan(question->size);
    *row = (struct sky_row){NAN, question->angle, NAN, NAN, NAN, NULL, question->size, NAN};
    if (has_subject) {
        row->subject = sky_objects[question->subject].word;
    }
    if (has_subject && isnan(row->angle)) {
        row->angle = sky_angle(question->subject);
    }
    if (!has_size) {
        return true;
    }
    if (isnan(row->angle) == isinf(distance)) {
        return fail(error, ERROR_USAGE,
                    "{--subject-size} with one of {--subject-angle}, {--subject} and {--distance} "
                    "gives the rest: give one of them");
    }
    row->distance = isinf(distance) ? sky_distance(question->size, row->angle) : distance;
    row->angle = sky_subtended(question->size, row->distance);
    return true;
}

bool sky_fill(const struct sky_question *question, const struct fov_setting *setting,
              const struct sensor *sensor, double pitch, struct sky_row *row, struct error *error)
{
    if (!sky_fill_subject(question, setting->s, row, error)) {
        return false;
    }
    row->scale = pitch / fov_scale(setting);
    if (isnan(row->angle)) {
        return true;
    }
    if (!sky_image(setting, row->angle, &row->image, error)) {
        return false;
    }
    row->pixels = row->image / pitch;
    row->part = row->image / sensor->height;
    return true;
}
