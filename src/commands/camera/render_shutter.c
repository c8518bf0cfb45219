/* commands/camera/render_shutter.c - the shutter of a photograph, and what is said of it. */
/* SPDX-License-Identifier: MIT */
#include "commands/camera/render_part.h"
#include "commands/lens/lens_options.h"
#include "report/spoken.h"

/* -------- what is asked -------- */

/* What a shutter cannot do without, beside the exposure time. */
static const char *const needed[SHUTTER_KINDS] = {[SHUTTER_FOCAL] = "travel-time",
                                                  [SHUTTER_LEAF] = "opening-time",
                                                  [SHUTTER_ROLLING] = "readout"};

static struct shutter_question shutter_asked(const struct render_input *input)
{
    const bool is_focal = input->shutter.kind == SHUTTER_FOCAL;
    return (struct shutter_question){
        .kind = (enum shutter_kind)input->shutter.kind,
        .direction = (enum shutter_direction)input->shutter.direction,
        .time = input->time,
        .width = input->sensor.size.width,
        .height = input->sensor.size.height,
        .travel = is_focal ? input->shutter.travel : input->shutter.readout,
        .distance = isnan(input->shutter.distance) ? 0 : input->shutter.distance,
        .overrun = isnan(input->shutter.overrun) ? (double)INFINITY : input->shutter.overrun,
        .opening = input->shutter.opening,
        .closing = isnan(input->shutter.closing) ? input->shutter.opening : input->shutter.closing,
        .stopped = 1};
}

bool render_check_shutter(const struct artifact_job *job, struct error *error)
{
    const struct render_input *input = job->inputs[0];
    struct shutter shutter;
    if (input->shutter.kind == SHUTTER_GLOBAL) {
        return true;
    }
    const char *own = needed[input->shutter.kind];
    const char *missing =
        SAID_FIRST({isnan(input->time), "time"}, {!asking_given(job->asking, own), own});
    if (missing != NULL) {
        return fail(error, ERROR_USAGE, "{--shutter} %s needs {--%s}",
                    shutter_kinds[input->shutter.kind].word, missing);
    }
    for (size_t i = 0; i < job->count; i++) {
        const struct shutter_question question = shutter_asked(job->inputs[i]);
        if (!shutter_open(&question, &shutter, error)) {
            return false;
        }
    }
    return !render_shutter_varies(job) || !render_is_part(job) ||
           fail(error, ERROR_USAGE,
                "a part is of one picture: each {--time} of a leaf shutter makes another one");
}

bool render_shutter_varies(const struct artifact_job *job)
{
    const struct render_input *first = job->inputs[0];
    bool varies = false;
    for (size_t i = 1; i < job->count && first->shutter.kind == SHUTTER_LEAF; i++) {
        const struct render_input *input = job->inputs[i];
        varies = varies || fabs(input->time - first->time) > 0;
    }
    return varies;
}

/* -------- the shutter -------- */

/* The stop's radius by -N, over its radius by what the lens says of itself. */
static bool find_stopped(const struct render_input *input, const struct analysis_case *one,
                         struct arena *arena, double *stopped, struct error *error)
{
    struct setup own, asked;
    *stopped = 1;
    if (isnan(input->question.fnumber)) {
        return true;
    }
    if (!render_stopped(input, one, NAN, arena, &own, error) ||
        !render_stopped(input, one, input->question.fnumber, arena, &asked, error)) {
        return false;
    }
    const double share = fabs(setup_stop_radius(&asked) / setup_stop_radius(&own));
    *stopped = share < 1 ? share : 1; /* NaN: the lens has no aperture but that of -N */
    return true;
}

bool render_shutter(const struct render_input *input, const struct analysis_case *one,
                    struct arena *arena, const struct shutter **shutter, struct error *error)
{
    struct shutter_question question = shutter_asked(input);
    *shutter = NULL;
    if (question.kind == SHUTTER_GLOBAL) {
        return true;
    }
    struct shutter *opened = ARENA_NEW(arena, struct shutter);
    *shutter = opened;
    return (question.kind != SHUTTER_LEAF ||
            find_stopped(input, one, arena, &question.stopped, error)) &&
           shutter_open(&question, opened, error);
}

bool render_shutter_span(const struct render_input *input, const struct analysis_case *one,
                         struct arena *arena, double span[2], struct error *error)
{
    struct film_question question = render_film(input, one);
    const double half = isnan(input->time) ? 0.5 : input->time / 2;
    span[0] = -half;
    span[1] = half;
    if (!render_shutter(input, one, arena, &question.shutter, error)) {
        return false;
    }
    if (question.shutter == NULL) {
        return true;
    }
    if (!(question.shutter->distance > 0)) {
        shutter_span(question.shutter, question.shutter->extent / 2, span);
        return true;
    }
    struct lens_film *film = ARENA_NEW(arena, struct lens_film);
    if (!lens_film_open(&question, arena, film, error)) {
        return false;
    }
    lens_film_span(film, span);
    return true;
}

/* -------- what is said of it -------- */

static const char *shutter_way(const struct render_input *input)
{
    return shutter_directions[input->shutter.direction].word;
}

void render_note_shutter(const struct render_input *input, struct image *image, struct arena *arena)
{
    const struct shutter_question asked = shutter_asked(input);
    const char *words[SHUTTER_KINDS] = {NULL};
    if (asked.kind == SHUTTER_GLOBAL) {
        return;
    }
    words[SHUTTER_FOCAL] = arena_printf(
        arena, "focal, %s in %.6g s, %.6g mm before the film%s", shutter_way(input), asked.travel,
        asked.distance,
        isinf(asked.overrun) ? ""
                             : arena_printf(arena, ", to %.6g mm beyond its edges", asked.overrun));
    words[SHUTTER_LEAF] = arena_printf(arena, "leaf, opens in %.6g s, closes in %.6g s",
                                       asked.opening, asked.closing);
    words[SHUTTER_ROLLING] =
        arena_printf(arena, "rolling, %s in %.6g s", shutter_way(input), asked.travel);
    render_note(image, arena, "Shutter", words[asked.kind]);
}

/*
 * A leaf shutter's effective time is that of the light that fills its stop, seldom evenly; `where`
 * this is, as words before a verb, empty where nothing was followed.
 */
static struct shutter_times times_of(const struct film_question *question, const char **where)
{
    const struct shutter *shutter = question->shutter;
    /* the beam of the axis where the curtains are, mm */
    const struct first_order *first = &question->setup->first;
    const double way = fabs(question->setup->image - first->exit_pupil);
    const double spread =
        isfinite(way) ? fabs(first->exit_diameter) / way : 1 / first->working_fnumber;
    struct shutter_times times = shutter_times(shutter, shutter->distance * spread);
    struct arena scratch = {0};
    struct lens_film *film = ARENA_NEW(&scratch, struct lens_film);
    struct error error;
    *where = "";
    if (shutter->kind == SHUTTER_LEAF && lens_film_open(question, &scratch, film, &error)) {
        const double share =
            lens_film_open_share(film, question->setup->wavelength_count, &scratch);
        if (share > 0) {
            const double *at = film->region.pole;
            times.effective = shutter->time * share;
            *where =
                hypot(at[0], at[1]) > 0 ? "where white is measured " : "in the middle of the film ";
        }
    }
    arena_free(&scratch);
    return times;
}

void render_say_shutter(const struct render_input *input, const struct film_question *film,
                        struct text_buffer *remarks)
{
    const struct shutter *shutter = film->shutter;
    if (shutter == NULL) {
        return;
    }
    const char *where;
    const struct shutter_times times = times_of(film, &where);
    char effective[SPOKEN_LENGTH], total[SPOKEN_LENGTH];
    spoken_time(effective, times.effective, 4);
    spoken_time(total, times.total, 4);
    if (shutter->kind == SHUTTER_FOCAL) {
        growing_format(remarks, "focal plane shutter, %s: a slit of %.4g mm, at %.4g m/s; ",
                       shutter_way(input), shutter->time / shutter->per_mm, 1e-3 / shutter->per_mm);
    } else if (shutter->kind == SHUTTER_LEAF) {
        growing_format(remarks, "leaf shutter, the stop at %.4g of its radius: ", shutter->stopped);
    } else {
        double span[2];
        shutter_span(shutter, 0, span);
        spoken_time(total, span[1] - span[0], 4);
        growing_format(remarks, "rolling shutter, %s: %.4g m/s over the film, all of it takes %s\n",
                       shutter_way(input), 1e-3 / shutter->per_mm, total);
        return;
    }
    growing_format(remarks, "light for %s, %sas much as full light in %s: efficiency %.4g %%\n",
                   total, where, effective, 100 * times.effective / times.total);
}

void render_explain_shutter(const struct shutter *shutter, struct text_buffer *remarks)
{
    static const char *const formulas[SHUTTER_KINDS] = {
        [SHUTTER_FOCAL] =
            "shutter: each ray has t, later by q R/h, q where it passes the curtains, R "
            "their time over the film's h; slit t h/R; efficiency slit/(slit + beam); "
            "[Ives20]",
        [SHUTTER_LEAF] = "shutter: a ray at r of the shutter's radius has t + (a + b)(sqrt(1/2) - "
                         "r), a and b opening and closing time; full light: the mean of rays to "
                         "the middle of the film, or to where white is measured; of a stop that is "
                         "filled evenly to s t + (a + b)(sqrt(1/2) - 2 s/3); [IsoShutter19]",
        [SHUTTER_ROLLING] = "shutter: each line has t, later by q R/h, q where it lies, R the "
                            "readout of the film's h"};
    if (shutter != NULL) {
        growing_format(remarks, "%s\n", formulas[shutter->kind]);
    }
}
