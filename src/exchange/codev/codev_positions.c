/* exchange/codev/codev_positions.c - zoom positions of a CODE V file, command by command. */
/* SPDX-License-Identifier: MIT */
#include "exchange/codev/codev.h"

#include <string.h>

static bool is_codev_command(const struct codev *codev, const char *name)
{
    return strcmp(codev_key(codev->commands.words[0].text).letters, name) == 0 &&
           !codev->commands.words[0].is_quoted;
}

bool codev_set_positions(struct codev *codev)
{
    const struct command_word word = commands_word(&codev->commands, 1);
    size_t count;
    if (word.is_quoted || word.text.length == 0 || !char_is_digit(word.text.start[0])) {
        return true;
    }
    if (!commands_count(&codev->commands, &word, word.text, "number of positions", 1, &count) ||
        !commands_end(&codev->commands, 2)) {
        return false;
    }
    if (codev->positions > 0 || count > CODEV_MOST_VALUES) {
        return commands_fail(&codev->commands, &word,
                             codev->positions > 0 ? "ZOO stands here twice"
                                                  : "more than 100 positions");
    }
    codev->positions = count > 1 ? count : 0;
    codev->names = ARENA_ARRAY(codev->job->arena, count, const char *);
    for (size_t i = 0; i < count; i++) {
        codev->names[i] = arena_printf(codev->job->arena, "z%zu", i + 1);
    }
    return true;
}

/* Words from `first` on that are no numbers: CLR, L'rim', AR3. */
static size_t next_zoom_value(const struct commands *commands, size_t first, size_t last)
{
    while (first < last && !commands->words[first].is_quoted) {
        const struct text word = commands->words[first].text;
        double value;
        if (number_read(word.start, word.start + word.length, NUMBER_UNSCALED, &value) != NULL) {
            break;
        }
        first++;
    }
    return first;
}

/* ZOO NAME qualifiers v1 .. vn */
static bool codev_place_zoom(struct codev *codev, bool *is_here)
{
    struct commands *commands = &codev->commands;
    const struct command_word name = commands_word(commands, 1);
    const size_t count = codev->positions;
    const size_t first =
        commands->count > 2 ? codev_qualifiers_end(commands, 2, count) : commands->count;
    const size_t given = commands->count - first;
    const size_t values = given > count ? commands->count - count : first;
    *is_here = given > 0 && !codev_is_harmless(name.text) && !text_same(name.text, "TIT");
    if (!*is_here) {
        return true;
    }
    if (count == 0 || given < count || next_zoom_value(commands, first, values) < values) {
        return commands_fail(commands, &commands->words[0], "%zu numbers for %zu positions", given,
                             count);
    }
    commands->words[values] = commands->words[values + codev->position - 1];
    memmove(commands->words, commands->words + 1, values * sizeof commands->words[0]);
    commands->count = values;
    return true;
}

bool codev_place(struct codev *codev, bool *is_here)
{
    struct commands *commands = &codev->commands;
    *is_here = true;
    if (is_codev_command(codev, "ZOO")) {
        return codev_place_zoom(codev, is_here);
    }
    if (is_codev_command(codev, "TIT") || is_codev_command(codev, "PIK")) {
        return true;
    }
    size_t at = 1, zoom = 0;
    const size_t end = codev_qualifiers_end(commands, 1, 1);
    while (at < end && codev_qualifier_kind(&commands->words[0], &commands->words[at]) != 'z') {
        at++;
    }
    if (at >= end) {
        return true;
    }
    const struct command_word word = commands->words[at];
    const struct text digits = {word.text.start + 1, word.text.length - 1};
    const size_t last = codev->positions > 0 ? codev->positions : 1;
    if (!commands_count(commands, &word, digits, "number", 1, &zoom)) {
        return false;
    }
    *is_here = zoom == (codev->positions > 0 ? codev->position : 1);
    if (zoom > last) {
        return codev_is_harmless(commands->words[0].text) ||
               commands_lose(
                   commands, LOSS_OF_RAYS, NULL,
                   arena_printf(commands->job->arena, "it is of position %zu of %zu", zoom, last));
    }
    commands->count--;
    memmove(commands->words + at, commands->words + at + 1,
            (commands->count - at) * sizeof commands->words[0]);
    return true;
}
