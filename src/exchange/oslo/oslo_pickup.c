/* exchange/oslo/oslo_pickup.c - numbers of an OSLO file that follow those of another surface. */
/* SPDX-License-Identifier: MIT */
#include "exchange/oslo/oslo.h"

#include "file/lens_words.h"

static const struct {
    const char *name;
    enum sequence_what what;
    double scale;
    bool is_length;
} pickups[] = {{"CV", SEQUENCE_PROFILE, 1, false},  {"CVM", SEQUENCE_PROFILE, -1, false},
               {"TH", SEQUENCE_THICKNESS, 1, true}, {"THM", SEQUENCE_THICKNESS, -1, true},
               {"LN", SEQUENCE_LENGTH, 1, true},    {"LNM", SEQUENCE_LENGTH, -1, true},
               {"AP", SEQUENCE_DIAMETER, 1, true},  {"GLA", SEQUENCE_MEDIUM, 1, false},
               {"TD", SEQUENCE_TURNS, 1, false},    {"TDM", SEQUENCE_TURNS, -1, false}};

bool oslo_reference(struct oslo *oslo, size_t word, size_t *surface)
{
    const struct command_word found = commands_word(&oslo->commands, word);
    bool is_relative = found.text.length > 0 && found.text.start[0] == '-';
    struct text digits = {found.text.start + is_relative, found.text.length - is_relative};
    if (!commands_count(&oslo->commands, &found, digits, "number of the surface", 0, surface)) {
        return false;
    }
    if (is_relative ? *surface > oslo->surface : *surface >= oslo->surface) {
        return commands_fail(&oslo->commands, &found,
                             "a pick-up from surface %zu, which is not before surface %zu",
                             *surface, oslo->surface);
    }
    *surface = is_relative ? oslo->surface - *surface : *surface;
    return true;
}

bool oslo_pickup(struct oslo *oslo)
{
    const struct command_word word = commands_word(&oslo->commands, 1);
    struct sequence_pickup pickup = {.target = oslo->surface, .at = oslo->commands.words[0]};
    size_t found = 0, next = 3;
    struct figure offset = {.value = {0, 0}};
    while (found < sizeof pickups / sizeof pickups[0] &&
           !text_same(word.text, pickups[found].name)) {
        found++;
    }
    if (found == sizeof pickups / sizeof pickups[0]) {
        return commands_lose(&oslo->commands, LOSS_OF_RAYS, "the number in the file is kept",
                             "a pick-up that is not known");
    }
    if (!oslo_reference(oslo, 2, &pickup.source)) {
        return false;
    }
    pickup.what = pickups[found].what;
    pickup.scale = pair_of(pickups[found].scale);
    pickup.end = oslo->surface;
    if (pickup.what == SEQUENCE_LENGTH) {
        const struct command_word end = commands_word(&oslo->commands, 3);
        next = 4;
        if (!commands_count(&oslo->commands, &end, end.text, "number of the surface", 0,
                            &pickup.end)) {
            return false;
        }
        pickup.end = pickup.end == 0 ? oslo->surface : pickup.end;
        if (pickup.end > oslo->surface || pickup.end <= pickup.source) {
            return commands_fail(&oslo->commands, &end, "a length from surface %zu to %zu",
                                 pickup.source, pickup.end);
        }
    }
    if (next < oslo->commands.count &&
        !commands_figure(&oslo->commands, next, pickups[found].is_length, "offset", &offset)) {
        return false;
    }
    pickup.offset = offset.value;
    if (!pickups[found].is_length) {
        pickup.offset = lens_words_per_length(pickup.offset, oslo->commands.scale, 1);
    }
    sequence_pick_up(&oslo->sequence, pickup);
    return commands_end(&oslo->commands, next + 1);
}
