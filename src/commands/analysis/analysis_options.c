/* commands/analysis/analysis_options.c - what the options of analyses ask for. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/analysis_options.h"

#include <string.h>

const struct word analysis_aims[] = {
    [ANALYSIS_AIM_STOP] = {"stop", "the stop, as real rays cross it"},
    [ANALYSIS_AIM_ENTRANCE] = {"entrance", "the paraxial entrance pupil"},
    {NULL, NULL},
};

const struct word analysis_weights[] = {
    [ANALYSIS_WEIGHT_PUPIL] = {"pupil", "of the pupil that --aim names"},
    [ANALYSIS_WEIGHT_BEAM] = {"beam", "of the entering beam, as light itself does"},
    {NULL, NULL},
};

bool analysis_is_given(double first, double second)
{
    return !isnan(first) || !isnan(second);
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

bool analysis_makes_many(const struct analysis_question *question, enum field_policy fields)
{
    const struct lens *lens = question->lens.lens;
    bool one = fields != FIELDS_ALL || analysis_is_given(question->field, question->field_x) ||
               analysis_is_given(question->height, question->height_x);
    return lens != NULL &&
           ((!one && lens->field_count > 1) || lens_positions_several(lens, question->position));
}

bool analysis_several(const void *input)
{
    return analysis_makes_many(input, FIELDS_ALL);
}

bool analysis_brings(const void *input, const char *option)
{
    const struct analysis_question *question = input;
    return !analysis_is_given(question->field, question->field_x) &&
           !analysis_is_given(question->height, question->height_x) &&
           lens_brings(question->lens.lens, option);
}

bool analysis_varies(const void *input, const char *option)
{
    const struct analysis_question *question = input;
    return strcmp(option, "position") == 0 &&
           lens_positions_several(question->lens.lens, question->position);
}
