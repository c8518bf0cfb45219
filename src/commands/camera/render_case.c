/* commands/camera/render_case.c - the lens of a picture, focused. */
/* SPDX-License-Identifier: MIT */
#include "commands/camera/render.h"

static const struct analysis_policy policy = {.wavelengths = WAVELENGTHS_ALL,
                                              .fields = FIELDS_LARGEST};

static bool take_model(const struct analysis_case *one, void *context, struct error *error)
{
    return render_model(context, one, &policy, error);
}

bool render_open(const struct render_input *input, const struct spectrum_value *channels,
                 struct run *run, analysis_visit *visit, void *context, struct error *error)
{
    struct render_opening opening = {input, run, visit, context};
    struct analysis_question *question = ARENA_NEW(run->arena, struct analysis_question);
    *question = input->question;
    question->field = question->field_x = question->height = question->height_x = NAN;
    question->object = NAN;
    if (channels != NULL) {
        question->spectrum = *channels;
    }
    return (isnan(input->distance) || render_focus(input, run->arena, question, error)) &&
           analysis_each(question, &policy, run->arena, take_model, &opening, error);
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

double render_widest(const struct render_input *input, const struct analysis_case *one,
                     struct arena *arena)
{
    const double tenth_of_stop = 0.966; /* between labels and what lenses are */
    const double asked = input->question.fnumber;
    struct setup own;
    struct error ignored;
    return !isnan(asked) && render_stopped(input, one, NAN, arena, &own, &ignored) &&
                   asked < tenth_of_stop * own.first.fnumber
               ? own.first.fnumber
               : (double)NAN;
}

void render_doubts(const struct render_input *input, const struct analysis_case *one,
                   const struct render_arrival *arrival, struct growing *remarks)
{
    const double widest = render_widest(input, one, remarks->arena);
    const char *said = setup_width_warning(one->setup, input->question.fnumber, remarks->arena);
    if (!isnan(widest) && said == NULL) { /* a model has no clear apertures to say it by */
        growing_format(remarks,
                       "warning: the lens is f/%.4g wide open: light of f/%.4g passes only where "
                       "its clear apertures let it\n",
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
