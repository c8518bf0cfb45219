/* commands/analysis/analysis_options.c - what the options of analyses ask for. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/analysis_options.h"

#include "commands/analysis/analysis_words.h"
#include "trace/aim/sample.h"

#include <string.h>

const struct word analysis_aims[] = {
    [ANALYSIS_AIM_STOP] = {"stop", "the stop, as real rays cross it"},
    [ANALYSIS_AIM_ENTRANCE] = {"entrance", "the paraxial entrance pupil"},
    {NULL, NULL},
};

const struct word analysis_weights[] = {
    [ANALYSIS_WEIGHT_PUPIL] = {"pupil", "the pupil that --aim says"},
    [ANALYSIS_WEIGHT_BEAM] = {"beam", "the entering beam, as light has it"},
    {NULL, NULL},
};

static bool is_given(double first, double second)
{
    return !isnan(first) || !isnan(second);
}

static bool analysis_options_check(const struct analysis_question *question,
                                   const struct analysis_policy *policy, struct error *error)
{
    const bool angle = is_given(question->field, question->field_x);
    const double quarter = PI / 2, x = fabs(question->field_x), y = fabs(question->field);
    if (angle && is_given(question->height, question->height_x)) {
        return fail(error, ERROR_USAGE, "{--field} and {--height} exclude each other");
    }
    if (x > 0 && y > 0 && !(x < quarter && y < quarter)) {
        return fail(error, ERROR_DOMAIN,
                    "{--field} and {--field-x}: where neither is 0 both must be below 90 degrees");
    }
    if (question->spectrum.text != NULL && policy->one_wavelength) {
        return fail(error, ERROR_USAGE, "{--spectrum}: this is an answer for one wavelength");
    }
    if (!isnan(question->fnumber) && question->lens.lens != NULL &&
        question->lens.lens->stop == LENS_NONE) {
        fail(error, ERROR_DOMAIN, "{--aperture}: the lens has no stop");
        return lens_hint_stop(error);
    }
    return true;
}

/* The field that the options name; false: none. */
static bool field_asked(const struct analysis_question *question, struct setup_field *field)
{
    if (is_given(question->height, question->height_x)) {
        *field = lens_field(question->real ? FIELD_REAL : FIELD_IMAGE, question->height_x,
                            question->height, question->section);
        return true;
    }
    *field = lens_field(FIELD_ANGLE, question->field_x, question->field, question->section);
    return is_given(question->field, question->field_x);
}

/* Beyond it squares of distances overflow; the lens has the same limit. */
static const double farthest_image = 1e100;

static bool analysis_options_place(const struct analysis_question *question,
                                   const struct analysis_policy *policy, struct setup *setup,
                                   struct error *error)
{
    if (policy->no_image) {
        return true;
    }
    if (!lens_place_image(setup, &question->focus, error)) {
        return false;
    }
    if (!isnan(question->defocus)) {
        setup->image += question->defocus;
        if (isnan(setup->image)) {
            return fail(
                error, ERROR_DOMAIN,
                "{--defocus}: there is no image plane to move, the image is infinitely far away");
        }
    }
    if (fabs(setup->image) > farthest_image) {
        return fail(error, ERROR_DOMAIN,
                    "the image plane lies %.4g mm from the last vertex: at most 1e100 mm",
                    setup->image);
    }
    return true;
}

static const char *analysis_options_warning_of(const struct analysis_question *question,
                                               const struct setup *setup)
{
    const char *both = lens_warnings_join(
        question->lens.warning, first_order_warning(setup->lens, setup->arena), setup->arena);
    const char *width =
        question->no_clip ? NULL : setup_width_warning(setup, question->fnumber, setup->arena);
    both = lens_warnings_join(both, setup->warning, setup->arena);
    return lens_warnings_join(both, width, setup->arena);
}

static bool analysis_options_visit_position(const struct analysis_question *question,
                                            const struct analysis_policy *policy, size_t position,
                                            struct arena *arena, struct analysis_case *one,
                                            struct error *error)
{
    struct setup *setup = ARENA_NEW(arena, struct setup);
    struct setup_field *field = ARENA_NEW(arena, struct setup_field);
    const bool asked = field_asked(question, field);
    const struct setup_question of = {
        .lens = question->lens.lens,
        .position = position,
        .section = (enum lens_section)question->section,
        .object = isnan(question->object) ? NULL : &question->object,
        .wavelength =
            question->wavelength.name != NULL ? question->wavelength.wavelength : (double)NAN,
        .wavelengths = policy->wavelengths,
        .spectrum = question->spectrum.items,
        .spectrum_count = question->spectrum.count,
        .fnumber = question->fnumber,
        .fields = field,
        .field_count = asked,
        /* an axis that is asked for is not taken for a field that nobody states */
        .field_policy = asked && policy->fields == FIELDS_EDGE ? FIELDS_LARGEST : policy->fields,
        .takes_telecentric = true,
    };
    if (!setup_open(&of, arena, setup, error) ||
        !analysis_options_place(question, policy, setup, error)) {
        return false;
    }
    *one = (struct analysis_case){.question = question,
                                  .setup = setup,
                                  .clip = !question->no_clip,
                                  .warning = analysis_options_warning_of(question, setup),
                                  .spectrum = analysis_spectrum_words(setup)};
    return true;
}

bool analysis_each(const struct analysis_question *question, const struct analysis_policy *policy,
                   struct arena *arena, analysis_visit *visit, void *context, struct error *error)
{
    const size_t *positions;
    size_t count;
    if (!analysis_options_check(question, policy, error) ||
        !lens_positions(question->lens.lens, question->position, arena, &positions, &count,
                        error)) {
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        struct analysis_case *one = ARENA_NEW(arena, struct analysis_case);
        if (!analysis_options_visit_position(question, policy, positions[i], arena, one, error) ||
            !visit(one, context, error)) {
            return false;
        }
    }
    return true;
}

static struct analysis_point analysis_point_of_lens(const struct analysis_case *one)
{
    const struct setup *setup = one->setup;
    return (struct analysis_point){
        .position = setup->position,
        .spectrum = one->spectrum,
        .focus = setup->focus,
        .lens = setup->lens->title,
        .warning = one->warning,
        .wavelength = setup->wavelength_count == 1 ? setup->wavelengths[0].wavelength : (double)NAN,
        .field = NAN,
        .field_x = NAN,
        .height = NAN,
        .height_x = NAN,
        .image = setup->image,
        .defocus = one->question->defocus,
    };
}

struct analysis_point analysis_point_of(const struct analysis_case *one, size_t field)
{
    struct analysis_point point = analysis_point_of_lens(one);
    const struct field_point *at = &one->setup->fields[field].point;
    const bool angle = at->kind == FIELD_ANGLE || at->kind == FIELD_NONE;
    point.field = angle ? at->value[1] : (double)NAN;
    point.field_x = angle ? at->value[0] : (double)NAN;
    point.height = angle ? (double)NAN : at->value[1];
    point.height_x = angle ? (double)NAN : at->value[0];
    return point;
}

struct bundle_question analysis_bundle(const struct analysis_case *one, size_t field)
{
    const struct analysis_question *asked = one->question;
    return (struct bundle_question){.setup = one->setup,
                                    .field = &one->setup->fields[field].point,
                                    .clip = one->clip,
                                    .from_entrance = asked->aim == ANALYSIS_AIM_ENTRANCE,
                                    .weight = asked->weight == ANALYSIS_WEIGHT_BEAM ? WEIGHT_BEAM
                                                                                    : WEIGHT_PUPIL,
                                    .pattern = (enum pattern)asked->pattern,
                                    .seed = (uint64_t)asked->seed};
}

const char *analysis_weight_words(const struct analysis_question *question)
{
    static const char *const words[2][2] = {
        {"equal areas of the stop", "equal areas of the entrance pupil"},
        {"equal areas of the entering beam, out to the stop",
         "equal areas of the entering beam, out to the entrance pupil"}};
    const struct lens *lens = question->lens.lens;
    if (lens != NULL && lens->stop == LENS_NONE && question->aim == ANALYSIS_AIM_STOP) {
        return "equal areas of the entering beam, as the lens has no stop";
    }
    return words[question->weight][question->aim];
}

double analysis_weight(const void *input)
{
    enum { RAYS = 1000 }; /* at least, as a question without --rays has them */
    const long rays = ((const struct analysis_question *)input)->rays;
    return ANSWER_BY_RAYS * fmax((double)rays / RAYS, 1);
}

int analysis_threads(const void *input)
{
    return parallel_threads(((const struct analysis_question *)input)->threads);
}

void analysis_doubt_aperture(const struct analysis_question *question, struct warnings *doubts)
{
    const struct lens *lens = question->lens.lens;
    const bool is_best =
        question->focus.kind == PLANE_BEST ||
        (question->focus.kind == PLANE_OF_LENS && lens != NULL && lens->focus == FOCUS_BEST);
    if (!isnan(question->fnumber) && !is_best) {
        warnings_add(doubts, "--aperture changes nothing here: chief rays and what is next to them "
                             "are the same at any f-number");
    }
}

bool analysis_makes_many(const struct analysis_question *question,
                         const struct analysis_policy *policy)
{
    const struct lens *lens = question->lens.lens;
    bool one = policy->fields != FIELDS_ALL || is_given(question->field, question->field_x) ||
               is_given(question->height, question->height_x);
    return lens != NULL &&
           ((!one && lens->field_count > 1) || lens_positions_several(lens, question->position));
}

bool analysis_brings(const void *input, const char *option)
{
    const struct analysis_question *question = input;
    return !is_given(question->field, question->field_x) &&
           !is_given(question->height, question->height_x) &&
           lens_brings(question->lens.lens, option);
}

bool analysis_varies(const void *input, const char *option)
{
    const struct analysis_question *question = input;
    return strcmp(option, "position") == 0 &&
           lens_positions_several(question->lens.lens, question->position);
}
