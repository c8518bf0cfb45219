/* commands/camera/render_model.c - the model of a lens in its place. */
/* SPDX-License-Identifier: MIT */
#include "commands/camera/render.h"
#include "commands/design/fit.h"

/* Is it one already, as `fit -o` writes them: no power but that of thick lenses? */
static bool is_thick(const struct lens *lens)
{
    size_t thick = 0, others = 0;
    for (size_t i = 0; i < lens->surface_count; i++) {
        const struct surface *surface = &lens->surfaces[i];
        thick += surface->kind == SURFACE_THICK;
        others += surface->kind != SURFACE_THICK && surface_profile(surface) != PROFILE_PLANE;
    }
    return thick == 1 && others == 0;
}

/* By eighths as far as the film goes, for a lens that states no fields. */
static struct fields_value fields_of_film(const struct sensor *film, const struct setup *setup)
{
    enum { STEPS = 8 };
    const double corner = hypot(film->width, film->height) / 2;
    struct field_item *items = ARENA_ARRAY(setup->arena, STEPS + 1, struct field_item);
    for (int i = 0; i <= STEPS; i++) {
        const double height = corner * i / STEPS;
        items[i] = (struct field_item){.angle = atan(height / fabs(setup->first.efl)),
                                       .height = height / fabs(setup->first.magnification),
                                       .weight = 1};
    }
    return (struct fields_value){"to the corner of the film", items, STEPS + 1};
}

/* Fitted as `lenscalc fit --distortion 0` does, to rays from the object of the picture. */
static bool fit_lens_of(const struct render_input *input, const struct analysis_case *one,
                        struct run *run, struct lens *stand_in, struct error *error)
{
    static const struct lens_policy policy = {.wavelengths = WAVELENGTHS_ALL,
                                              .fields = FIELDS_SPREAD};
    struct lens *lens = ARENA_NEW(run->arena, struct lens);
    if (run->no_solver != NULL) {
        *error = *run->no_solver;
        return false;
    }
    /* without what `answer` adds, the fit of twice the rays */
    const struct fit_input fitting = {.object = NAN,
                                      .distortion = 0,
                                      .show = FIT_PARAMETERS,
                                      .match = FIT_IMAGE,
                                      .pattern = PATTERN_GAUSS,
                                      .rays = 72};
    *lens = *one->setup->lens;
    lens->object = (struct figure){one->setup->object.distance, {NULL, 0}, LENS_NONE};
    lens->object_is_infinite = one->setup->object.is_infinite;
    lens->objects = NULL;
    struct lens_question question = {.lens = one->question->lens,
                                     .fnumber = one->question->fnumber,
                                     .field = NAN,
                                     .field_x = NAN};
    question.lens.lens = lens;
    if (lens->field_count == 0) {
        question.fields = fields_of_film(&input->sensor.size, one->setup);
    }
    struct lens_cursor at = lens_begin(&question, &policy, run->arena);
    bool found = lens_next_setup(&at, error);
    if (found) {
        struct fit_job job = {
            .input = &fitting, .run = run, .setup = at.one.setup, .warning = at.one.warning};
        found = setup_light(at.one.setup, 0, &job.light, error) && fit_job_run(&job, error);
        *stand_in = found ? fit_equal_lens(&job) : *lens;
    }
    return found || error_prefix(error, "no thick lens could be fitted: ");
}

/* Where the film of a model stands: in its own image if that is what was asked for. */
static struct plane_value render_model_plane_of(const struct analysis_case *one,
                                                const struct render_input *input)
{
    const struct plane_value *asked = &one->question->focus;
    const enum focus_kind own = one->setup->lens->focus;
    const bool is_of_lens = asked->kind == PLANE_OF_LENS;
    const double defocus = isnan(one->question->defocus) ? 0 : one->question->defocus;
    if (asked->kind == PLANE_TABLE || (is_of_lens && own == FOCUS_TABLE)) {
        return (struct plane_value){.kind = PLANE_AT, .distance = one->setup->image - defocus};
    }
    if (input->gap != NULL || (input->model == MODEL_PARAXIAL &&
                               (asked->kind == PLANE_BEST || (is_of_lens && own == FOCUS_BEST)))) {
        return (struct plane_value){.kind = PLANE_PARAXIAL};
    }
    return *asked;
}

bool render_model(const struct render_input *input, const struct analysis_policy *policy,
                  struct run *run, const struct analysis_case **one, struct error *error)
{
    const enum lens_model model = (enum lens_model)input->model;
    const struct setup *setup = (*one)->setup;
    if (model == MODEL_EXACT || (model == MODEL_FITTED && is_thick(setup->lens))) {
        return true;
    }
    struct analysis_question *question = ARENA_NEW(run->arena, struct analysis_question);
    *question = *(*one)->question;
    question->focus = render_model_plane_of(*one, input);
    if (lens_model_replaces(model)) {
        struct lens *stand_in = ARENA_NEW(run->arena, struct lens);
        if (!lens_model_check(setup->lens, &setup->first, error) ||
            (model == MODEL_FITTED && !fit_lens_of(input, *one, run, stand_in, error))) {
            return false;
        }
        if (model != MODEL_FITTED) {
            *stand_in = lens_model_lens(model, setup->lens, &setup->first, run->arena);
        }
        question->lens.lens = stand_in;
        question->position = NULL;
    }
    struct analysis_cursor at = analysis_begin(question, policy, run);
    const bool found = analysis_next_case(&at, error);
    *one = at.one;
    return found;
}

void render_say_model(const struct render_input *input, const struct analysis_case *one,
                      struct text_buffer *remarks)
{
    const struct lens *lens = one->setup->lens;
    const bool is_fitted = input->model == MODEL_FITTED && lens->note_count > 0;
    if (input->model != MODEL_EXACT) {
        growing_format(remarks, "model %s: f %.6g mm%s%s\n", lens_models[input->model].word,
                       one->setup->first.efl, is_fitted ? "; " : "",
                       is_fitted ? lens->notes[0] : "");
    }
}
