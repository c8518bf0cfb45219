/* commands/camera/render_rays.c - the rays that leave a lens, as rows or doubles. */
/* SPDX-License-Identifier: MIT */
#include "base/number.h"
#include "camera/film/lens_rays.h"
#include "commands/camera/render.h"

#include <inttypes.h>
#include <string.h>

/* What is written of a ray, in this order. */
enum { NUMBERS = 11, USUAL_RAYS = 65536 };
static const char *const names[NUMBERS] = {"film_x_mm", "film_y_mm", "wavelength_nm", "x_mm",
                                           "y_mm",      "z_mm",      "cos_x",         "cos_y",
                                           "cos_z",     "weight",    "time"};

/* A kind of file: how it begins, and a ray in it. */
struct ray_file {
    struct file_type type;
    char separator; /* of its rows; 0: numbers as they are in memory */
};

static const struct ray_file files[] = {{{{"csv", "rows, separated by commas"}, ".csv"}, ','},
                                        {{{"tsv", "rows, by tabs"}, ".tsv"}, '\t'},
                                        {{{"raw", "little-endian doubles"}, ".raw"}, 0}};

const struct file_type *render_ray_types(size_t i)
{
    return i < sizeof files / sizeof files[0] ? &files[i].type : NULL;
}

/* Least significant byte first, whatever the machine. */
static char *put_raw_number(char *to, double number)
{
    uint64_t bits;
    memcpy(&bits, &number, sizeof bits);
    for (int k = 0; k < 8; k++) {
        *to++ = (char)(bits >> 8 * k & 0xff);
    }
    return to;
}

static void write_rays(const struct lens_ray *rays, size_t count, char separator,
                       struct output *sink)
{
    for (size_t i = 0; i < count; i++) {
        double numbers[NUMBERS];
        char *to = output_reserve(sink, NUMBERS * (NUMBER_LENGTH + 1));
        numbers[0] = rays[i].film[0];
        numbers[1] = rays[i].film[1];
        /* not what multiplying um by 1000 leaves in the last digit */
        numbers[2] = round(1e9 * rays[i].wavelength) / 1e6;
        for (int k = 0; k < 3; k++) {
            numbers[3 + k] = rays[i].point[k];
            numbers[6 + k] = rays[i].cosine[k];
        }
        numbers[9] = rays[i].weight;
        numbers[10] = rays[i].time;
        for (int k = 0; k < NUMBERS; k++) {
            if (separator == 0) {
                to = put_raw_number(to, numbers[k]);
            } else {
                to = number_write_shortest(to, numbers[k]);
                *to++ = k + 1 == NUMBERS ? '\n' : separator;
            }
        }
        output_advance(sink, to);
    }
}

bool render_rays(const struct artifact_job *job, struct output *sink, struct error *error)
{
    const struct render_input *input = job->inputs[0];
    const struct analysis_case *one;
    const struct ray_file *file = files;
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        file = job->type == &files[i].type ? &files[i] : file;
    }
    struct lens_rays *rays = ARENA_NEW(job->run->arena, struct lens_rays);
    if (!render_open(input, NULL, job->run, &one, error)) {
        return false;
    }
    struct lens_rays_question question = {.film = render_film(input, one),
                                          .samples = input->samples == 0 ? USUAL_RAYS
                                                                         : (uint64_t)input->samples,
                                          .seed = (uint64_t)input->seed};
    const char separator = file->separator, between = separator != 0 ? separator : ' ';
    for (int k = 0; k < NUMBERS; k++) {
        output_string(sink, names[k]);
        output_character(sink, k + 1 == NUMBERS ? '\n' : between);
    }
    watch_begin(job->run->watch, "rays", question.samples);
    if (!render_acceptance(input, job->run->arena, &question.film.acceptance, error) ||
        !render_shutter(input, one, job->run->arena, &question.film.shutter, error) ||
        !lens_rays_open(&question, job->run->arena, rays, error)) {
        return false;
    }
    for (size_t count = lens_rays_next(rays); count > 0; count = lens_rays_next(rays)) {
        write_rays(rays->passed, count, separator, sink);
        if (!watch_add(job->run->watch, count)) {
            return fail(error, ERROR_DOMAIN, "interrupted: what would follow is missing");
        }
    }
    struct text_buffer remarks = {.arena = job->run->arena};
    render_say_model(input, one, &remarks);
    render_say_shutter(input, &question.film, &remarks);
    const double share = (double)rays->arrived / (double)question.samples;
    render_doubts(input, one, rays->film.lit, rays->film.corner, rays->film.region.pole,
                  input->acceptance == NULL ? share : NAN, &remarks);
    if (job->run->explain) {
        render_explain_shutter(question.film.shutter, &remarks);
        growing_format(&remarks,
                       "E/L = integral over pupil directions w of cos(theta) dw, averaged over the "
                       "film: the sum of the weights; [Kolb95] (1)\n"
                       "%.4g %% of %" PRIu64 " rays arrived\n",
                       100 * share, question.samples);
    }
    sink->remarks = growing_done(&remarks);
    return true;
}
