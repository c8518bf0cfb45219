/* cli/question/distance_word.c - a distance in a word: hyperfocal. */
/* SPDX-License-Identifier: MIT */
#include "cli/question/distance_word.h"

bool distance_word_settle(struct arguments *arguments, struct error *error)
{
    struct argument *distance = arguments_find(arguments, text_of("distance"));
    struct argument *far_limit = arguments_find(arguments, text_of("far"));
    if (distance == NULL || far_limit == NULL || !distance->is_given ||
        (far_limit->option->flags & OPTION_GOAL) == 0 ||
        !text_same(text_trim(distance->text), "hyperfocal")) {
        return true;
    }
    if (far_limit->is_given && far_limit->entry == NULL) {
        return fail(error, ERROR_USAGE,
                    "--distance hyperfocal stands for --far inf, and --far is given as well");
    }
    distance->is_given = false;
    far_limit->is_given = true;
    far_limit->entry = distance->entry;
    far_limit->text = text_of("inf");
    arguments->is_hyperfocal = true;
    arguments_note_given(arguments);
    return true;
}
