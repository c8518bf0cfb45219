/* commands/camera/render_picture.c - a photograph of a card, exposed and written. */
/* SPDX-License-Identifier: MIT */
#include "camera/develop.h"
#include "camera/photograph.h"
#include "commands/camera/render.h"
#include "file/image_file.h"
#include "photo/sensitometry.h"
#include "report/spoken.h"
#include "report/version.h"

#include <stdlib.h>
#include <string.h>

enum { USUAL_SAMPLES = 64, MOST_SAMPLES = 1 << 20, USUAL_BITS = 8 };

/* About where the primaries of sRGB lie, um: each channel is traced at one wavelength. */
static const struct setup_wavelength channels[PHOTOGRAPH_CHANNELS] = {
    {0.611, 1}, {0.549, 1}, {0.464, 1}};

/* Where white comes that nobody exposes for: half a stop below what saturates. */
#define WHITE_SHARE 0.70710678118654752

/* -------- what is asked -------- */

/* "chart:edge" or a file with a picture. */
static bool read_scene(const struct render_input *input, struct arena *arena, struct card *card,
                       struct error *error)
{
    static const char prefix[] = "chart:";
    if (strncmp(input->scene, prefix, sizeof prefix - 1) == 0) {
        const char *name = input->scene + sizeof prefix - 1;
        for (size_t i = 0; charts[i].word != NULL; i++) {
            if (strcmp(charts[i].word, name) == 0) {
                card->chart = (enum chart)(i + 1);
                return true;
            }
        }
        fail(error, ERROR_USAGE, "there is no chart '%.40s'", name);
        return error_hint(error, "edge, star, grid, checker, bars, wedge or points");
    }
    struct image *picture = ARENA_NEW(arena, struct image);
    card->picture = picture;
    return image_file_read(input->scene, IMAGE_LIGHT, arena, picture, error) &&
           (image_check(picture, IMAGE_POSITIVE, error) ||
            error_prefix(error, "%.200s: ", input->scene));
}

/* What only some kinds of files can hold. */
static bool check_file(const struct artifact_job *job, struct error *error)
{
    const struct render_input *input = job->inputs[0];
    const bool is_png = job->type == NULL || strcmp(job->type->ending, ".png") == 0;
    if (input->bits != 0 && !is_png) {
        return fail(error, ERROR_USAGE, "{--bits} %ld: only a .png has a choice", input->bits);
    }
    if (input->raw && input->bits != 0 && input->bits != 16) {
        return fail(error, ERROR_USAGE, "{--bits} %ld: {--raw} numbers take 16", input->bits);
    }
    if (render_senses(input) && !is_png) {
        return fail(error, ERROR_USAGE,
                    "what a sensor sees is written as .png; %s holds the light itself",
                    job->type->ending);
    }
    if (input->bits != 0 && input->bits != 8 && input->bits != 16) {
        return fail(error, ERROR_USAGE, "{--bits} %ld: a PNG has 8 or 16", input->bits);
    }
    return true;
}

bool render_check_picture(const struct artifact_job *job, struct error *error)
{
    const struct render_input *input = job->inputs[0];
    struct render_frame frame;
    if (input->scene == NULL) {
        fail(error, ERROR_USAGE, "what is to be photographed is not said");
        return error_hint(error, "a picture (card.png), or chart:edge, chart:star and the like");
    }
    if (isnan(input->distance)) {
        fail(error, ERROR_USAGE, "how far away the card is is not said");
        return error_hint(error, "give {--distance}, as -s 2m");
    }
    const long samples = input->samples;
    if (samples > MOST_SAMPLES || (samples & (samples - 1)) != 0) {
        return fail(error, ERROR_USAGE,
                    "{--samples} %ld: rays of a pixel are a power of two, at most %d", samples,
                    MOST_SAMPLES);
    }
    if (input->question.spectrum.count > 0) {
        return fail(error, ERROR_USAGE,
                    "{--spectrum} is for {--rays}: a picture has three colours, or one "
                    "{--wavelength}");
    }
    return check_file(job, error) && render_check_sensor(input, error) &&
           render_check_film(job, error) && render_check_depths(input, error) &&
           render_frame_read(input, &frame, error);
}

/* -------- exposed -------- */

struct exposure {
    double luminance; /* of white, cd/m^2 */
    double time, iso; /* s */
    double metered;   /* s, of which a film loses nothing: the light that counts */
    double full;      /* what saturates, lx s */
    bool is_chosen;   /* nobody gave a time */
};

static bool expose(const struct render_input *input, double axis, struct exposure *exposure,
                   struct error *error)
{
    const double iso = render_speed(input), full = saturation_exposure(iso);
    *exposure = (struct exposure){.luminance = input->luminance,
                                  .time = input->time,
                                  .metered = WHITE_SHARE * full / (input->luminance * axis),
                                  .iso = iso,
                                  .full = full,
                                  .is_chosen = isnan(input->time)};
    return render_film_time(input, &exposure->time, &exposure->metered, error);
}

/* The least and the most of a picture's values. */
struct range {
    double least, most;
};

/* Pixels become lx s, or shares of what saturates. */
static struct range scale(struct image *image, double by)
{
    struct range range = {(double)INFINITY, 0};
    for (size_t i = 0; i < image->width * image->height * image->channels; i++) {
        image->pixels[i] = (float)(by * (double)image->pixels[i]);
        range.least = fmin(range.least, (double)image->pixels[i]);
        range.most = fmax(range.most, (double)image->pixels[i]);
    }
    return range;
}

/* -------- what is said of it -------- */

static void note(struct image *image, struct arena *arena, const char *key, const char *value)
{
    image_note(image, arena, text_of(key), text_of(value));
}

static void add_notes(const struct analysis_case *one, const struct render_input *input,
                      const struct exposure *exposure, struct image *image, struct arena *arena)
{
    const struct setup *setup = one->setup;
    note(image, arena, "Software", "lenscalc " LENSCALC_VERSION);
    note(image, arena, "Scene", input->scene);
    note(image, arena, "Lens", setup->lens->title != NULL ? setup->lens->title : "");
    note(image, arena, "Aperture", arena_printf(arena, "f/%.4g", setup->first.fnumber));
    note(image, arena, "Lens model", lens_models[input->model].word);
    note(image, arena, "Image plane", arena_printf(arena, "%.9g mm", setup->image));
    note(image, arena, "Exposure time", arena_printf(arena, "%.6g s", exposure->time));
    if (render_is_film(input)) {
        note(image, arena, "Film", input->film.name);
    }
    note(image, arena, "ISO", arena_printf(arena, "%.6g", exposure->iso));
    note(image, arena, "White", arena_printf(arena, "%.6g cd/m2", exposure->luminance));
    note(image, arena, "Seed", arena_printf(arena, "%ld", input->seed));
    if (input->crop != NULL) {
        note(image, arena, "Crop", input->crop);
    }
}

/* Too much light, or too little, and what would mend it; shares of what saturates. */
static void add_warnings(const struct range *shares, double iso, struct growing *remarks)
{
    if (shares->least > 1) {
        growing_format(remarks,
                       "warning: every pixel is saturated: the time or the ISO must be less than "
                       "1/%.3g of it\n",
                       shares->least);
    } else if (shares->most > 1) {
        growing_format(remarks,
                       "warning: the brightest pixel has %.3g times what saturates at ISO %.4g\n",
                       shares->most, iso);
    }
    if (shares->most == 0) {
        growing_format(remarks, "warning: no light: all is black\n");
    } else if (shares->most < 1.0 / 4096) {
        growing_format(remarks,
                       "warning: all is black: it takes %.3g times the time or the ISO until the "
                       "brightest pixel saturates\n",
                       1 / shares->most);
    }
}

static void add_remarks(const struct photograph *photograph, const struct exposure *exposure,
                        bool is_film, struct growing *remarks)
{
    char time[64];
    spoken_time(time, exposure->time, 3);
    growing_format(remarks, "%.4g x %.4g mm of the card; white of %.4g cd/m2, %s at ISO %.4g%s\n",
                   photograph->card.width, photograph->card.height, exposure->luminance, time,
                   exposure->iso,
                   !exposure->is_chosen ? ""
                   : is_film            ? ": 18 % grey as a meter exposes it"
                                        : ": white half a stop below saturation");
}

/* -------- the picture -------- */

struct picture_job {
    const struct artifact_job *job;
    struct output *sink;
    struct render_frame frame;
};

/* Light becomes what the file shall hold: lx s, shares of white, numbers, densities. */
static bool receive_light(const struct picture_job *picture, bool is_png,
                          const struct exposure *exposure, struct image *image,
                          struct growing *remarks, struct error *error)
{
    const struct render_input *input = picture->job->inputs[0];
    const bool senses = render_senses(input), is_film = render_is_film(input);
    const struct image light = *image;
    scale(image, !is_png || senses || is_film ? exposure->full : DEVELOP_HEADROOM);
    if (!senses && !is_film) {
        return true;
    }
    if (!(is_film ? render_develop(input, is_png, &picture->frame, image, remarks, error)
                  : render_sense(input, exposure->time, &picture->frame, image, remarks, error))) {
        return false;
    }
    for (size_t i = 0; i < light.note_count; i++) {
        note(image, remarks->arena, light.notes[i].key, light.notes[i].value);
    }
    return true;
}

static bool write_image(const struct picture_job *picture, struct image *image,
                        const struct exposure *exposure, struct growing *remarks,
                        struct error *error)
{
    const struct artifact_job *job = picture->job;
    const struct render_input *input = job->inputs[0];
    struct arena *arena = job->run->arena;
    const struct file_type *type = job->type != NULL ? job->type : image_file_types(0);
    const bool is_png = strcmp(type->ending, ".png") == 0;
    struct image_way way = {.bits = input->bits == 0 ? USUAL_BITS : (int)input->bits,
                            .values = IMAGE_LIGHT,
                            .packed = true};
    struct text bytes;
    if (!receive_light(picture, is_png, exposure, image, remarks, error)) {
        return false;
    }
    if (input->raw) {
        way.bits = 16;
        way.values = IMAGE_CODES;
    }
    picture->sink->remarks = growing_done(remarks);
    if (!render_frame_cut(&picture->frame, arena, image, error) ||
        !image_file_bytes(image, type, &way, arena, &bytes, error)) {
        return false;
    }
    output_text(picture->sink, bytes.start, bytes.length);
    return true;
}

static bool take_picture(const struct analysis_case *one, void *context, struct error *error)
{
    struct picture_job *picture = context;
    const struct artifact_job *job = picture->job;
    const struct render_input *input = job->inputs[0];
    struct arena *arena = job->run->arena;
    struct render_frame *frame = &picture->frame;
    struct photograph_question question = {
        .film = render_film(input, one),
        .samples = input->samples == 0 ? USUAL_SAMPLES : (size_t)input->samples,
        .seed = (uint64_t)input->seed,
        .threads = parallel_threads(input->threads),
        .card = {.distance = render_object(one),
                 .width = isnan(input->field_width) ? 0 : input->field_width},
        .watch = job->run->watch};
    struct photograph photograph;
    if (!render_frame_read(input, frame, error)) {
        return false;
    }
    question.columns = frame->columns;
    question.rows = frame->rows;
    question.crop = frame->taken;
    if (!read_scene(input, arena, &question.card, error) ||
        !render_depths(input, question.card.picture, arena, &question.depths, error) ||
        !photograph_take(&question, arena, &photograph, error)) {
        return false;
    }
    struct exposure exposure;
    if (!expose(input, photograph.axis, &exposure, error)) {
        return false;
    }
    struct growing remarks = {.arena = arena};
    const struct range shares =
        scale(&photograph.image, exposure.luminance * exposure.metered / exposure.full);
    add_remarks(&photograph, &exposure, render_is_film(input), &remarks);
    if (!render_is_film(input)) {
        add_warnings(&shares, exposure.iso, &remarks);
    }
    render_say_depths(input, &photograph, &remarks);
    render_doubts(one, photograph.largest, photograph.corner, &remarks);
    add_notes(one, input, &exposure, &photograph.image, arena);
    if (photograph.is_incomplete) {
        note(&photograph.image, arena, "Incomplete", "interrupted");
        fail(&job->run->shortfall, ERROR_DOMAIN,
             "interrupted: the picture is incomplete, and black where it is missing");
    }
    return write_image(picture, &photograph.image, &exposure, &remarks, error);
}

bool render_picture(const struct artifact_job *job, struct output *sink, struct error *error)
{
    const struct render_input *input = job->inputs[0];
    struct picture_job picture = {.job = job, .sink = sink};
    const struct spectrum_value colours = {"channels", channels, PHOTOGRAPH_CHANNELS};
    const bool one_colour = input->question.wavelength.name != NULL;
    return render_open(input, one_colour ? NULL : &colours, job->run, take_picture, &picture,
                       error);
}
