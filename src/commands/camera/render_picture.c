/* commands/camera/render_picture.c - a photograph of a card, exposed and written. */
/* SPDX-License-Identifier: MIT */
#include "cli/progress.h"
#include "commands/camera/render_part.h"
#include "commands/camera/render_world.h"
#include "file/image_file.h"
#include "report/version.h"

#include <string.h>

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
    return check_subject(job, error) && render_check_part(job, error) &&
           (render_is_part(job) || render_check_file(input, job->type, error)) &&
           render_check_light(input, error) && render_check_samples(input, error) &&
           render_check_autofocus(input, error) && render_check_film(job, error) &&
           render_check_depths(input, error) && render_frame_read(input, &frame, error) &&
           render_check_sensor(job, &frame, error);
}

/* -------- the picture -------- */

struct picture_job {
    const struct artifact_job *job;
    struct output *sinks;       /* one an exposure */
    struct render_world *world; /* null: of a card */
    double until;               /* of progress_clock */
};

static bool render_picture_is_over(const void *clock)
{
    return progress_clock() >= *(const double *)clock;
}

/* Take a picture, with all the time that one may have. */
static bool render_picture_take(struct picture_job *picture, struct photograph_question *question,
                                struct photograph *photograph, struct error *error)
{
    const struct render_input *input = picture->job->inputs[0];
    if (!isnan(input->seconds)) {
        picture->until = progress_clock() + input->seconds;
        question->is_over = render_picture_is_over;
        question->clock = &picture->until;
    }
    return photograph_take(question, picture->job->run->arena, photograph, error);
}

/* What is the same in all exposures. */
static void render_picture_add_notes(const struct analysis_case *one,
                                     const struct picture_job *picture, struct image *image)
{
    const struct render_input *input = picture->job->inputs[0];
    struct arena *arena = picture->job->run->arena;
    const struct setup *setup = one->setup;
    render_note(image, arena, "Software", "lenscalc " LENSCALC_VERSION);
    render_note(image, arena, "Scene", input->subject);
    if (input->light.name != NULL) {
        render_note(image, arena, "Light", input->light.name);
    }
    if (input->filter.name != NULL) {
        render_note(image, arena, "Filter", input->filter.name);
    }
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
    }
    const char *stars = picture->world != NULL ? render_stars_text(picture->world, arena) : NULL;
    if (stars != NULL) {
        render_note(image, arena, "Stars", stars);
    }
    render_note(image, arena, "Image plane", arena_printf(arena, "%.9g mm", setup->image));
    render_note_shutter(input, image, arena);
    render_note(image, arena, "Seed", arena_printf(arena, "%ld", input->seed));
    if (input->crop != NULL) {
        render_note(image, arena, "Crop", input->crop);
    }
}

static struct text render_picture_doubts_of(const struct analysis_case *one,
                                            const struct picture_job *picture,
                                            const struct photograph_question *question,
                                            const struct render_shot *shot)
{
    const struct photograph *photograph = &shot->photograph;
    const struct artifact_job *job = picture->job;
    const struct render_input *input = job->inputs[0];
    struct text_buffer doubts = {.arena = job->run->arena};
    const bool all_of_pupil = !skip_is_kept(question->kept, SKIP_PUPIL);
    const struct render_arrival arrival = {
        photograph->largest, photograph->corner, photograph->reference_at,
        all_of_pupil ? (double)photograph->counts[PHOTOGRAPH_PASSED] /
                           (double)photograph->counts[PHOTOGRAPH_TRACED]
                     : NAN};
    render_say_size(input, &shot->frame, &doubts);
    render_say_autofocus(input, render_object(one), &doubts);
    render_say_samples(input, photograph, &doubts);
    render_say_light(input, &doubts);
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
    render_doubts(input, one, &arrival, &doubts);
    if (job->run->explain) {
        render_explain(job, question, photograph, &doubts);
    }
    return growing_done(&doubts);
}

/* All that does not depend on the exposure. */
static void render_picture_finish(const struct analysis_case *one,
                                  const struct picture_job *picture,
                                  const struct photograph_question *question,
                                  struct render_shot *shot)
{
    const struct artifact_job *job = picture->job;
    const struct render_input *input = job->inputs[0];
    struct arena *arena = job->run->arena;
    render_filter(input, one->setup, input->spectral ? picture->world->white : NULL,
                  &shot->photograph);
    render_picture_add_notes(one, picture, &shot->photograph.image);
    shot->photograph.image.aspect = render_aspect(input, &shot->frame);
    if (shot->photograph.is_incomplete) {
        const char *why = job->run->parts != NULL ? "parts are missing" : "interrupted";
        render_note(&shot->photograph.image, arena, "Incomplete", why);
        fail(&job->run->shortfall, ERROR_DOMAIN,
             "%s: the picture is incomplete, and black where it is missing", why);
    }
    shot->doubts = render_picture_doubts_of(one, picture, question, shot);
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

/* Who interrupts a picture has none of those that come after it. */
static void render_picture_leave_out(const struct picture_job *picture, size_t first)
{
    const struct artifact_job *job = picture->job;
    const size_t left = job->count - first;
    for (size_t i = first; i < job->count; i++) {
        picture->sinks[i].is_unused = true;
    }
    fail(&job->run->shortfall, ERROR_DOMAIN,
         "interrupted: the picture is incomplete, and black where it is missing; %zu more %s not "
         "made",
         left, left == 1 ? "is" : "are");
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
            render_picture_leave_out(picture, i);
            break;
        }
        if (is_new && !photograph->is_incomplete) {
            question.duration = duration_of(picture, job->inputs[i], question.kept);
            done = render_shutter(job->inputs[i], one, job->run->arena, &question.film.shutter,
                                  error) &&
                   render_picture_take(picture, &question, &shot->photograph, error);
            if (done) {
                render_picture_finish(one, picture, &question, shot);
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

/* Of all files that a scene is made of. */
static const char *digest_of_world(const struct picture_job *picture)
{
    return picture->world != NULL ? picture->world->scene.digest.text : "";
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
    render_ask_samples(input, &question);
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
        !render_part_begin(job, one, digest_of_world(picture), &question, &part, error) ||
        !render_picture_take(picture, &question, &shot.photograph, error)) {
        return false;
    }
    if (render_is_part(job)) {
        render_part_write(&part, &shot.photograph, picture->sinks);
        return true;
    }
    render_part_fill(&part, &shot.photograph);
    shot.enclosed = picture->world != NULL ? picture->world->enclosed : NULL;
    render_picture_finish(one, picture, &question, &shot);
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
