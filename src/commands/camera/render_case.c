/* commands/camera/render_case.c - the lens of a picture, focused. */
/* SPDX-License-Identifier: MIT */
#include "commands/camera/render.h"

static const struct analysis_policy policy = {.wavelengths = WAVELENGTHS_ALL,
                                              .fields = FIELDS_LARGEST};

bool render_open(const struct render_input *input, const struct spectrum_value *channels,
                 struct run *run, const struct analysis_case **one, struct error *error)
{
    struct analysis_question *question = ARENA_NEW(run->arena, struct analysis_question);
    *question = input->question;
    question->field = question->field_x = question->height = question->height_x = NAN;
    question->object = NAN;
    if (channels != NULL) {
        question->spectrum = *channels;
    }
    if (!isnan(input->distance) && !render_focus(input, run->arena, question, error)) {
        return false;
    }
    struct analysis_cursor at = analysis_begin(question, &policy, run);
    const bool found = analysis_next_case(&at, error);
    *one = at.one;
    return found && render_model(input, &policy, run, one, error);
}

double render_object(const struct analysis_case *one)
{
    return one->question->object;
}

bool render_stopped(const struct render_input *input, const struct analysis_case *one,
                    double fnumber, struct arena *arena, struct setup *setup, struct error *error)
{
    const struct lens *lens = input->question.lens.lens;
    const double object = render_object(one);
    const size_t *positions;
    size_t count;
    if (!lens_positions(lens, input->question.position, arena, &positions, &count, error)) {
        return false;
    }
    const struct setup_question question = {.lens = lens,
                                            .position = positions[0],
                                            .object = isnan(object) ? NULL : &object,
                                            .wavelength = NAN,
                                            .wavelengths = WAVELENGTHS_PRIMARY,
                                            .fnumber = fnumber};
    return setup_open(&question, arena, setup, error);
}

/* Its f-number wide open, if more than that is asked for; else, or if it has none, NaN. */
static double widest_of(const struct render_input *input, const struct analysis_case *one,
                        struct arena *arena)
{
    const double asked = input->question.fnumber;
    struct setup own;
    struct error ignored;
    return !isnan(asked) && render_stopped(input, one, NAN, arena, &own, &ignored) &&
                   asked < SETUP_WIDTH_SLACK * own.first.fnumber
               ? own.first.fnumber
               : (double)NAN;
}

double render_fnumber(const struct render_input *input, const struct analysis_case *one,
                      struct arena *arena)
{
    const double widest = widest_of(input, one, arena);
    const bool is_limited = setup_width_warning(one->setup, input->question.fnumber, arena) != NULL;
    return is_limited && !isnan(widest) ? widest : one->setup->first.fnumber;
}

void render_doubts(const struct render_input *input, const struct analysis_case *one,
                   const struct render_arrival *arrival, struct text_buffer *remarks)
{
    const double widest = widest_of(input, one, remarks->arena);
    if (!isnan(widest) && lens_model_replaces((enum lens_model)input->model)) {
        growing_format(remarks,
                       "warning: the lens is f/%.4g wide open: all of f/%.4g passes its model, "
                       "which has no clear apertures\n",
                       widest, input->question.fnumber);
    }
    if (one->warning != NULL) {
        growing_format(remarks, "warning: %s\n", one->warning);
    }
    const double beside = hypot(arrival->lit_at[0], arrival->lit_at[1]);
    if (beside > 0) {
        growing_format(remarks,
                       "warning: the middle of the film stays dark: a place %.4g mm from it, where "
                       "light arrives, stands for it\n",
                       beside);
    } else if (arrival->largest < arrival->corner) {
        growing_format(remarks,
                       "warning: light arrives up to %.4g mm from the axis; the corners of the "
                       "film, at %.4g mm, stay dark\n",
                       arrival->largest, arrival->corner);
    } else if (arrival->share < 0.5) {
        growing_format(remarks,
                       "warning: %.2g %% of the rays arrive: the pupil is too small to be "
                       "followed over the film, and some of the light may be missing%s\n",
                       100 * arrival->share,
                       isnan(input->time) ? ": the time, which rests on it, may be far too long"
                                          : "");
    }
}

struct film_question render_film(const struct render_input *input, const struct analysis_case *one)
{
    return (struct film_question){.setup = one->setup,
                                  .width = input->sensor.size.width,
                                  .height = input->sensor.size.height,
                                  .blades = {.count = (unsigned)input->blades,
                                             .turn = input->blade_turn,
                                             .rounding = input->blade_rounding},
                                  .model = (enum lens_model)input->model};
}
