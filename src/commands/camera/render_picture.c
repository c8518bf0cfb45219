/* commands/camera/render_picture.c - a photograph of a card, exposed and written. */
/* SPDX-License-Identifier: MIT */
#include "camera/sensor/response.h"
#include "cli/progress.h"
#include "commands/camera/render.h"
#include "commands/camera/render_part.h"
#include "commands/camera/render_world.h"
#include "file/image_file.h"
#include "light/colour.h"
#include "photo/mired.h"
#include "report/version.h"

#include <string.h>

/* -------- colours -------- */

/* Are all channels of the same wavelengths, those asked for? */
static bool render_is_grey(const struct render_input *input)
{
    return input->question.wavelength.name != NULL || input->question.spectrum.count > 0;
}

enum { BAND_WAVES = 8 };

/* Red, green and blue, each at one wavelength or at several within its band: for render_open. */
static struct spectrum_value render_colours(const struct render_input *input, struct arena *arena)
{
    static const double middles[PHOTOGRAPH_CHANNELS] = {RESPONSE_RED, RESPONSE_GREEN,
                                                        RESPONSE_BLUE};
    const double band = isnan(input->band) ? 0 : 1000 * input->band;
    const size_t waves = band > 0 ? BAND_WAVES : 1, count = PHOTOGRAPH_CHANNELS * waves;
    struct setup_wavelength *items = ARENA_ARRAY(arena, count, struct setup_wavelength);
    for (size_t i = 0; i < count; i++) {
        const double along = ((double)(i % waves) + 0.5) / (double)waves - 0.5;
        items[i] = (struct setup_wavelength){middles[i / waves] + along * band, 1};
    }
    return (struct spectrum_value){"channels", items, count};
}

/* -------- light -------- */

/* Mean over the wavelengths of a channel, by their weights. */
static double mean_transmittance(const struct render_input *input, const struct setup *setup,
                                 size_t channel)
{
    const size_t parts = render_is_grey(input) ? 1 : PHOTOGRAPH_CHANNELS;
    const size_t waves = setup->wavelength_count / parts;
    double sum = 0, all = 0;
    for (size_t i = 0; i < waves; i++) {
        const struct setup_wavelength *one = &setup->wavelengths[channel % parts * waves + i];
        sum += one->weight * mired_transmittance(input->filter.mired, one->wavelength);
        all += one->weight;
    }
    return sum / all;
}

/*
 * Put the filter before the lens.
 *
 * Given     setup       of the photograph
 *           white       linear sRGB of white behind a filter whose colour the rays have had; null:
 *                       of none
 *           photograph  each channel receives less light, the reference as the brightest of them
 * Formula   2^-stops times mired_transmittance, its mean over the wavelengths of the channel
 */
static void render_filter(const struct render_input *input, const struct setup *setup,
                          const double *white, struct photograph *photograph)
{
    const double grey = exp2(-input->filter.stops);
    struct image *image = &photograph->image;
    double through[PHOTOGRAPH_CHANNELS], most = 0;
    if (input->filter.name == NULL) {
        return;
    }
    for (size_t k = 0; k < PHOTOGRAPH_CHANNELS; k++) {
        const double share = white != NULL ? white[k] : mean_transmittance(input, setup, k);
        through[k] = white != NULL ? grey : grey * share;
        most = fmax(most, grey * share);
        photograph->mean[k] *= through[k];
    }
    for (size_t i = 0; i < image->width * image->height; i++) {
        for (size_t k = 0; k < PHOTOGRAPH_CHANNELS; k++) {
            float *value = &image->pixels[i * PHOTOGRAPH_CHANNELS + k];
            *value = (float)(through[k] * (double)*value);
        }
    }
    photograph->reference *= most; /* white is exposed by its brightest colour */
}

/* -------- rays of a pixel -------- */

enum { USUAL_SAMPLES = 64, USUAL_WITH_ERROR = 4096, MOST_SAMPLES = 1 << 20 };

/* An error that was reached, as a multiple of the one asked for. */
static const char *error_in_words(const struct render_input *input, double reached,
                                  struct arena *arena)
{
    const double percent = 100 * input->error * reached;
    return render_is_world(input)
               ? arena_printf(arena,
                              "%.2g %% of each pixel's light, or %.2g of a grey level if that is "
                              "more",
                              percent, reached)
               : arena_printf(arena, "%.2g %% of white", percent);
}

/* The error that was reached, and how many tiles missed it and by how much. */
static void render_say_samples(const struct render_input *input,
                               const struct photograph *photograph, struct text_buffer *remarks)
{
    const uint64_t *counts = photograph->counts + PHOTOGRAPH_CONVERGENCE;
    const size_t *reached = photograph->reached;
    if (reached[1] > reached[0]) {
        growing_format(remarks, "in the time given %zu to %zu rays a pixel and colour\n",
                       reached[0], reached[1]);
    } else if (reached[1] > 0) {
        growing_format(remarks, "in the time given %zu rays a pixel and colour\n", reached[1]);
    }
    if (isnan(input->error) || counts[CONVERGENCE_TILES] == 0) {
        return;
    }
    growing_format(remarks, "error %s, by %.4g rays a pixel and colour on average\n",
                   error_in_words(input, convergence_error(counts, false), remarks->arena),
                   (double)counts[CONVERGENCE_RAYS] / (double)counts[CONVERGENCE_TILES]);
    if (counts[CONVERGENCE_MISSED] > 0) {
        growing_format(remarks,
                       "warning: %llu of %llu tiles have not reached the error: they have %s\n",
                       (unsigned long long)counts[CONVERGENCE_MISSED],
                       (unsigned long long)counts[CONVERGENCE_TILES],
                       error_in_words(input, convergence_error(counts, true), remarks->arena));
    }
}

/* -------- what is asked -------- */

/* Something, and for a card where. */
static bool check_subject(const struct artifact_job *job, struct error *error)
{
    const struct render_input *input = job->inputs[0];
    if (input->subject != NULL && strcmp(input->subject, "-") == 0) {
        fail(error, ERROR_USAGE, "what is photographed is read from a file, not standard input");
        return error_hint(error, "give its name, as room.scene or card.png");
    }
    if (input->subject == NULL) {
        fail(error, ERROR_USAGE, "what is to be photographed is not said");
        return error_hint(error, "a scene (room.scene), a picture (card.png), or chart:edge, "
                                 "chart:star and the like");
    }
    if (!render_is_world(input) && isnan(input->distance) &&
        (input->autofocus == NULL || input->depth_map == NULL)) {
        struct card card;
        if (!render_card(input, job->run->arena, &card, error)) {
            return error->code == ERROR_DATA && error->hint[0] == '\0' &&
                   error_hint(error, "the name of a scene ends in .scene");
        }
        fail(error, ERROR_USAGE, "how far away the card is is not said");
        return error_hint(error, "give {--distance}, as -s 2m");
    }
    return render_check_world(job, error);
}

bool render_check_picture(const struct artifact_job *job, struct error *error)
{
    const struct render_input *input = job->inputs[0];
    struct render_frame frame;
    if (!check_subject(job, error) || !render_check_part(job, error) ||
        (!render_is_part(job) && !render_check_file(input, job->type, error))) {
        return false;
    }
    if (isnan(input->filter.mired)) {
        return fail(
            error, ERROR_USAGE,
            "{--filter} %s: its colour is not that of a light, and no spectrum of it is known",
            input->filter.name);
    }
    const long samples = input->samples;
    if (samples > MOST_SAMPLES || (samples & (samples - 1)) != 0) {
        return fail(error, ERROR_USAGE,
                    "{--samples} %ld: rays of a pixel are a power of two, at most %d", samples,
                    MOST_SAMPLES);
    }
    if ((!isnan(input->error) || !isnan(input->seconds)) && samples != 0 &&
        samples < CONVERGENCE_LEAST) {
        return fail(error, ERROR_USAGE,
                    "{--samples} %ld: with {--%s} they are the most there may be, %d or more",
                    samples, isnan(input->error) ? "seconds" : "error", CONVERGENCE_LEAST);
    }
    return render_check_autofocus(input, error) && render_check_film(job, error) &&
           render_check_depths(input, error) && render_frame_read(input, &frame, error) &&
           render_check_sensor(job, &frame, error);
}

/* -------- light on the film and in the picture -------- */

/* Of all pixels, lx. */
static double render_mean_of(const struct image *image)
{
    const size_t pixels = image->width * image->height;
    double sum = 0;
    for (size_t i = 0; i < pixels; i++) {
        const float *pixel = &image->pixels[i * image->channels];
        const double rgb[PHOTOGRAPH_CHANNELS] = {(double)pixel[0], (double)pixel[1],
                                                 (double)pixel[2]};
        sum += colour_luminance(rgb);
    }
    return sum / (double)pixels;
}

/*
 * The share that the pixels may have less than the meter finds: four times what is known of its
 * error, and of that of so many more or fewer rays, beside what it leaves out. More they may have:
 * what shines near the lens is larger for the rim of its pupil.
 */
static double allowed_loss(const struct photograph *photograph)
{
    static const double left_out = 0.05, metering_rays = 16384;
    const double traced = (double)photograph->counts[PHOTOGRAPH_TRACED];
    const double rays = fmax(1, traced / (double)photograph->passes);
    return left_out + 4 * photograph->mean_error * sqrt(1 + metering_rays / rays);
}

/*
 * Whether the light on the film is known, and that of a picture's pixels is as much.
 *
 * Given     photograph  behind its filter
 * Formula   camera/photograph/metering.h looks straight at what shines: pixels whose mean is less
 *           by more than four of their standard errors, and more than that leaves out, have missed
 *           some of it
 */
static void render_say_mean(const struct photograph_question *question,
                            const struct photograph *photograph, struct text_buffer *remarks)
{
    const double doubtful = 0.1; /* a sixth of a stop */
    const struct image *image = &photograph->image;
    const bool is_whole = image->width == question->columns && image->height == question->rows &&
                          !photograph->is_incomplete;
    const double metered = colour_luminance(photograph->mean);
    if (photograph->mean_error > doubtful) {
        growing_format(remarks,
                       "warning: the light on the film on average is known to %.2g %% only: few "
                       "rays find what makes it\n",
                       100 * photograph->mean_error);
    }
    const double shown = is_whole ? render_mean_of(image) : NAN;
    if (photograph->is_metered_directly && shown > 0 &&
        shown < (1 - allowed_loss(photograph)) * metered) {
        growing_format(
            remarks,
            "warning: the pixels have %.4g lx on average, and rays straight to what "
            "shines find %.4g lx: small lights are missed, and more --samples find them, "
            "or are blurred beyond the film\n",
            shown, metered);
    }
}

/* -------- the picture -------- */

struct picture_job {
    const struct artifact_job *job;
    struct output *sinks;       /* one an exposure */
    struct render_world *world; /* null: of a card */
    double until;               /* of progress_clock */
};

static bool time_is_over(const void *clock)
{
    return progress_clock() >= *(const double *)clock;
}

/* Take a picture, with all the time that one may have. */
static bool photograph_timed(struct picture_job *picture, struct photograph_question *question,
                             struct photograph *photograph, struct error *error)
{
    const struct render_input *input = picture->job->inputs[0];
    if (!isnan(input->seconds)) {
        picture->until = progress_clock() + input->seconds;
        question->is_over = time_is_over;
        question->clock = &picture->until;
    }
    return photograph_take(question, picture->job->run->arena, photograph, error);
}

/* What is the same in all exposures. */
static void picture_add_notes(const struct analysis_case *one, const struct picture_job *picture,
                              struct image *image)
{
    const struct render_input *input = picture->job->inputs[0];
    struct arena *arena = picture->job->run->arena;
    const struct setup *setup = one->setup;
    render_note(image, arena, "Software", "lenscalc " LENSCALC_VERSION);
    render_note(image, arena, "Scene", input->subject);
    render_note(image, arena, "Light", input->light.name);
    render_note(image, arena, "Filter", input->filter.name);
    render_note(image, arena, "Lens", setup->lens->title != NULL ? setup->lens->title : "");
    render_note(image, arena, "Aperture",
                arena_printf(arena, "f/%.4g", render_fnumber(input, one, arena)));
    render_note(image, arena, "Lens model", lens_models[input->model].word);
    const double object = render_object(one);
    if (isnan(input->distance) && !isnan(object)) {
        render_note(image, arena, "Object",
                    isinf(object) ? "infinity"
                                  : arena_printf(arena, "%.9g mm before the first vertex", object));
    } else if (!isnan(input->distance)) {
        render_note(image, arena, "Distance", arena_printf(arena, "%.9g mm", input->distance));
    }
    if (picture->world != NULL) {
        render_note(image, arena, "In focus", render_focus_text(one, arena));
        render_note(image, arena, "Stars", render_stars_text(picture->world, arena));
    }
    render_note(image, arena, "Image plane", arena_printf(arena, "%.9g mm", setup->image));
    render_note_shutter(input, image, arena);
    render_note(image, arena, "Seed", arena_printf(arena, "%ld", input->seed));
    render_note(image, arena, "Crop", input->crop);
}

static struct text picture_doubts(const struct analysis_case *one,
                                  const struct picture_job *picture,
                                  const struct photograph_question *question,
                                  const struct render_shot *shot)
{
    const struct photograph *photograph = &shot->photograph;
    const struct artifact_job *job = picture->job;
    const struct render_input *input = job->inputs[0];
    struct text_buffer doubts = {.arena = job->run->arena};
    const bool all_of_pupil = !skip_is_kept(question->kept, SKIP_PUPIL);
    const double share = all_of_pupil ? (double)photograph->counts[PHOTOGRAPH_PASSED] /
                                            (double)photograph->counts[PHOTOGRAPH_TRACED]
                                      : NAN;
    render_say_size(input, &shot->frame, &doubts);
    render_say_autofocus(input, render_object(one), &doubts);
    render_say_samples(input, photograph, &doubts);
    /* Which light and which filter, if they have names. */
    if (input->light.name != NULL) {
        growing_format(&doubts, "light of %s, EV %.4g at ISO 100: %s\n", input->light.name,
                       input->light.ev100, input->light.source);
    }
    if (input->filter.name != NULL) {
        growing_format(&doubts, "filter %s\n", input->filter.name);
    }
    if (picture->world != NULL) {
        if (!isinf(render_object(one))) { /* who asks for infinity knows */
            growing_format(&doubts, "in focus: %s\n", render_focus_text(one, doubts.arena));
        }
        render_say_mean(question, photograph, &doubts);
        render_say_world(picture->world, &doubts);
    } else {
        render_say_card(input, photograph, one->setup, &doubts);
    }
    render_say_depths(input, photograph, &doubts);
    render_say_model(input, one, &doubts);
    render_say_shutter(input, &question->film, &doubts);
    render_doubts(input, one, photograph->largest, photograph->corner, photograph->reference_at,
                  share, &doubts);
    if (job->run->explain) {
        render_explain(job, question, photograph, &doubts);
    }
    return growing_done(&doubts);
}

/* All that does not depend on the exposure. */
static void picture_finish(const struct analysis_case *one, const struct picture_job *picture,
                           const struct photograph_question *question, struct render_shot *shot)
{
    const struct artifact_job *job = picture->job;
    const struct render_input *input = job->inputs[0];
    struct arena *arena = job->run->arena;
    render_filter(input, one->setup, input->spectral ? picture->world->white : NULL,
                  &shot->photograph);
    picture_add_notes(one, picture, &shot->photograph.image);
    shot->photograph.image.aspect = render_aspect(input, &shot->frame);
    if (shot->photograph.is_incomplete) {
        const char *why = job->run->parts != NULL ? "parts are missing" : "interrupted";
        render_note(&shot->photograph.image, arena, "Incomplete", why);
        fail(&job->run->shortfall, ERROR_DOMAIN,
             "%s: the picture is incomplete, and black where it is missing", why);
    }
    shot->doubts = picture_doubts(one, picture, question, shot);
}

/* What moves is somewhere else in an exposure of another length. */
static double duration_of(const struct picture_job *picture, const struct render_input *input,
                          unsigned kept)
{
    const bool moves = picture->world != NULL && picture->world->moves;
    if (!moves && !skip_is_kept(kept, SKIP_TIME)) {
        return 0;
    }
    return !moves && isnan(input->time) ? 1 : input->time;
}

/* Is exposure i another picture than the one before it? */
static bool is_another(const struct picture_job *picture, size_t i, unsigned kept)
{
    const struct artifact_job *job = picture->job;
    const struct render_input *one = job->inputs[i - 1], *next = job->inputs[i];
    const bool moves = picture->world != NULL && picture->world->moves;
    return skip_is_kept(kept, SKIP_EXPOSURES) || render_shutter_varies(job) ||
           (moves && next->time != one->time);
}

/* Each exposure of it, taken anew where that is another picture; merged ones are one picture. */
static bool expose_all(const struct analysis_case *one, struct picture_job *picture,
                       struct photograph_question question, struct render_shot *shot,
                       struct error *error)
{
    const struct artifact_job *job = picture->job;
    const struct photograph *photograph = &shot->photograph;
    bool done = true;
    question.done = NULL;
    question.pause = NULL;
    for (size_t i = 0; i < job->count && done; i++) {
        const bool is_new = i > 0 && is_another(picture, i, question.kept);
        if (is_new && photograph->is_incomplete && job->run->parts == NULL) {
            /* Who interrupts a picture has none of those that come after it. */
            const size_t left = job->count - i;
            for (size_t k = i; k < job->count; k++) {
                picture->sinks[k].is_unused = true;
            }
            fail(&job->run->shortfall, ERROR_DOMAIN,
                 "interrupted: the picture is incomplete, and black where it is missing; %zu more "
                 "%s not made",
                 left, left == 1 ? "is" : "are");
            break;
        }
        if (is_new && !photograph->is_incomplete) {
            question.duration = duration_of(picture, job->inputs[i], question.kept);
            done = render_shutter(job->inputs[i], one, job->run->arena, &question.film.shutter,
                                  error) &&
                   photograph_timed(picture, &question, &shot->photograph, error);
            if (done) {
                picture_finish(one, picture, &question, shot);
            }
        }
        if (photograph->is_incomplete && job->run->parts == NULL) {
            shot->aside = output_set_aside(&picture->sinks[i]);
        }
        shot->is_last = i + 1 == job->count;
        shot->is_one_of_many = job->count > 1;
        shot->frame.number = i;
        done = done && render_expose(job, i, shot, &picture->sinks[i], error);
    }
    return done;
}

/* What is photographed. */
static bool ask_subject(const struct picture_job *picture, const struct analysis_case *one,
                        struct photograph_question *question, struct error *error)
{
    const struct render_input *input = picture->job->inputs[0];
    struct arena *arena = picture->job->run->arena;
    question->duration = duration_of(picture, input, question->kept);
    if (picture->world != NULL) {
        question->is_coloured = question->is_coloured && !input->spectral;
        return render_world_open(picture->job, one, picture->world, question, error);
    }
    question->card = (struct card){.distance = render_object(one),
                                   .width = isnan(input->field_width) ? 0 : input->field_width};
    return render_card(input, arena, &question->card, error) &&
           render_depths(input, question->card.picture, arena, &question->depths, error);
}

/* What the lens sees that is focused so. */
static bool take_picture(struct picture_job *picture, const struct render_input *focused,
                         struct error *error)
{
    const struct artifact_job *job = picture->job;
    const struct render_input *input = job->inputs[0];
    struct arena *arena = job->run->arena;
    struct render_shot shot = {.is_world = picture->world != NULL};
    struct render_part part;
    const struct spectrum_value colours = picture->world != NULL && input->spectral
                                              ? render_world_colours(picture->world, arena)
                                              : render_colours(input, arena);
    const struct analysis_case *one;
    if (!render_open(focused, render_is_grey(input) ? NULL : &colours, job->run, &one, error)) {
        return false;
    }
    struct photograph_question question = {.film = render_film(input, one),
                                           .is_coloured = !render_is_grey(input),
                                           .seed = (uint64_t)input->seed,
                                           .threads = parallel_threads(input->threads),
                                           .watch = job->run->watch};
    /* how many rays a pixel has, or until which error */
    long usual = isnan(input->error) ? USUAL_SAMPLES : USUAL_WITH_ERROR;
    usual = isnan(input->seconds) ? usual : MOST_SAMPLES;
    question.samples = (size_t)(input->samples == 0 ? usual : input->samples);
    question.error = isnan(input->error) ? 0 : input->error;
    if (!render_frame_read(input, &shot.frame, error) ||
        !render_kept(input, &question.kept, error)) {
        return false;
    }
    question.film.is_anywhere = skip_is_kept(question.kept, SKIP_PUPIL);
    question.columns = shot.frame.columns;
    question.rows = shot.frame.rows;
    question.crop = shot.frame.taken;
    if (!render_acceptance(input, arena, &question.film.acceptance, error) ||
        !render_shutter(input, one, arena, &question.film.shutter, error) ||
        !ask_subject(picture, one, &question, error) ||
        !render_part_begin(job, one,
                           picture->world != NULL ? picture->world->scene.digest.text : "",
                           &question, &part, error) ||
        !photograph_timed(picture, &question, &shot.photograph, error)) {
        return false;
    }
    if (render_is_part(job)) {
        render_part_write(&part, &shot.photograph, picture->sinks);
        return true;
    }
    render_part_fill(&part, &shot.photograph);
    shot.enclosed = picture->world != NULL ? picture->world->enclosed : NULL;
    picture_finish(one, picture, &question, &shot);
    return expose_all(one, picture, question, &shot, error);
}

bool render_picture(const struct artifact_job *job, struct output *sinks, struct error *error)
{
    const struct render_input *input = job->inputs[0];
    struct picture_job picture = {.job = job, .sinks = sinks};
    struct render_input focused;
    if (!render_is_world(input)) {
        return render_autofocus(input, job->run->arena, &focused, error) &&
               take_picture(&picture, &focused, error);
    }
    picture.world = ARENA_NEW(job->run->arena, struct render_world);
    return render_world_read(job, picture.world, error) &&
           render_world_focus(job, picture.world, &focused, error) &&
           take_picture(&picture, &focused, error);
}

const struct file_type *render_picture_types(size_t i)
{
    size_t images = 0;
    while (image_file_types(images) != NULL) {
        images++;
    }
    return i < images ? image_file_types(i) : division_types(i - images);
}
