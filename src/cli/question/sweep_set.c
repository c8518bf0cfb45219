/* cli/question/sweep_set.c - one combination of a sweep, and the values of its axes. */
/* SPDX-License-Identifier: MIT */
#include "cli/question/sweep.h"

#include <string.h>

void sweep_set(const struct sweep *sweep, size_t index, void *input)
{
    for (size_t i = sweep->axis_count; i-- > 0;) {
        const struct axis *axis = &sweep->axes[i];
        size_t size = axis->option->kind->size;
        memcpy((char *)input + axis->option->offset, axis->values + index % axis->count * size,
               size);
        index /= axis->count;
    }
}

bool sweep_recall(const struct sweep *sweep, size_t index, void *input, struct error *error)
{
    sweep_set(sweep, index, input);
    for (size_t i = 0; i < sweep->axis_count; i++) {
        const struct option *option = sweep->axes[i].option;
        if (!option_recall(sweep->reader, option, (char *)input + option->offset, error)) {
            return false;
        }
    }
    return focal_settle(&sweep->focal, input, sweep->reader->doubts, error);
}

const struct axis *sweep_axis(const struct sweep *sweep, const char *option)
{
    for (size_t i = 0; i < sweep->axis_count; i++) {
        if (strcmp(sweep->axes[i].option->name, option) == 0) {
            return &sweep->axes[i];
        }
    }
    return NULL;
}

bool axis_is_number(const struct axis *axis)
{
    return axis->option->kind->number_of != NULL;
}

double axis_number(const struct axis *axis, size_t index)
{
    const struct option_kind *kind = axis->option->kind;
    return kind->number_of(axis->values + index * kind->size);
}

bool axis_set_number(const struct sweep *sweep, const struct axis *axis, double number, void *input)
{
    const struct option *option = axis->option;
    void *member = (char *)input + option->offset;
    if (option->kind->set_number != NULL) {
        option->kind->set_number(member, number, axis->unit);
        return true;
    }
    /* what is more than a number, as if it had been typed */
    char text[NUMBER_LENGTH];
    struct error ignored;
    const struct reader plain = {.db = sweep->reader->db, .arena = sweep->reader->arena};
    const double typed = unit_from_own(option_unit(option), number);
    return option_read(&plain, option, text_between(text, number_write_shortest(text, typed)),
                       member, &ignored);
}

bool sweep_check_single(const struct sweep *sweep, const struct command *command,
                        struct error *error)
{
    for (size_t i = 0; i < sweep->axis_count; i++) {
        const char *option = sweep->axes[i].option->name;
        bool may_vary = false; /* does an artifact have a file for each value? */
        for (size_t k = 0; k < command->artifact_count && !may_vary; k++) {
            may_vary = text_lists(command->artifacts[k].varies, text_of(option));
        }
        if (!may_vary) {
            return fail(error, ERROR_USAGE, "--%s has several values: %s takes one", option,
                        command->name);
        }
    }
    return true;
}
