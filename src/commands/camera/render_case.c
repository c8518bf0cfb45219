/* commands/camera/render_case.c - the lens of a picture, focused. */
/* SPDX-License-Identifier: MIT */
#include "commands/camera/render.h"
#include "commands/photo/photo_lens.h"
#include "optics/conjugates.h"

/*
 * What the distance says: from the first vertex, mm.
 *
 * Errors    ERROR_DOMAIN: no stop, a card within the focal length; as photo_lens_single,
 *           distance_to_principal and conjugates_working_distance
 */
static bool find_object(const struct render_input *input, struct arena *arena, double *object,
                        struct error *error)
{
    const struct photo_lens_question question = {.lens = input->question.lens,
                                                 .position = input->question.position,
                                                 .focal = NAN,
                                                 .wavelength = NAN,
                                                 .fnumber = NAN,
                                                 .pupil = NAN,
                                                 .from = input->from};
    struct photo_lens lens;
    double s;
    if (input->question.lens.lens->stop == LENS_NONE) {
        return fail(error, ERROR_DOMAIN, "the lens has no stop: how much light comes is not known");
    }
    if (!photo_lens_single(&question, 0, arena, &lens, error) ||
        !distance_to_principal(lens.f, lens.P, input->distance, &lens.measuring, &s, error)) {
        return false;
    }
    if (s <= lens.f) {
        return fail(error, ERROR_DOMAIN,
                    "the card lies %.6g mm before the front principal plane: that must be more "
                    "than the focal length, %.6g mm",
                    s, lens.f);
    }
    return conjugates_working_distance(s, lens.measuring.front, object, error);
}

bool render_open(const struct render_input *input, const struct spectrum_value *channels,
                 struct arena *arena, analysis_visit *visit, void *context, struct error *error)
{
    static const struct analysis_policy policy = {.wavelengths = WAVELENGTHS_ALL,
                                                  .fields = FIELDS_LARGEST};
    struct analysis_question *question = ARENA_NEW(arena, struct analysis_question);
    *question = input->question;
    question->field = question->field_x = question->height = question->height_x = NAN;
    question->object = NAN;
    if (channels != NULL) {
        question->spectrum = *channels;
    }
    if (!isnan(input->distance)) {
        if (!find_object(input, arena, &question->object, error)) {
            return false;
        }
        if (question->focus.kind == PLANE_OF_LENS) {
            question->focus.kind = PLANE_PARAXIAL;
        }
    }
    return analysis_each(question, &policy, arena, visit, context, error);
}

double render_object(const struct analysis_case *one)
{
    return one->question->object;
}

void render_doubts(const struct analysis_case *one, double largest, double corner,
                   struct growing *remarks)
{
    if (one->warning != NULL) {
        growing_format(remarks, "warning: %s\n", one->warning);
    }
    if (largest < corner) {
        growing_format(remarks,
                       "warning: light arrives up to %.4g mm from the axis; the corners of the "
                       "film, at %.4g mm, stay dark\n",
                       largest, corner);
    }
}

struct film_question render_film(const struct render_input *input, const struct analysis_case *one)
{
    return (struct film_question){.setup = one->setup,
                                  .width = input->sensor.size.width,
                                  .height = input->sensor.size.height,
                                  .blades = {.count = (unsigned)input->blades,
                                             .turn = input->blade_turn,
                                             .rounding = input->blade_rounding}};
}
