/* exchange/oslo/oslo_positions.c - what stands behind END in an OSLO file: configurations. */
/* SPDX-License-Identifier: MIT */
#include "exchange/oslo/oslo.h"

#include <string.h>

enum { MOST_POSITIONS = 100 };

bool oslo_enter(struct oslo *oslo, struct text word)
{
    static const struct {
        const char *word;
        enum oslo_block block;
    } blocks[] = {{"RST", OSLO_POINTS},
                  {"CFG", OSLO_CONFIGURATIONS},
                  {"VAR", OSLO_PASSED_OVER},
                  {"OPE", OSLO_PASSED_OVER},
                  {"END", OSLO_NO_BLOCK}};
    for (size_t i = 0; i < sizeof blocks / sizeof blocks[0]; i++) {
        bool begins = blocks[i].block != OSLO_NO_BLOCK;
        if (text_same(word, blocks[i].word) && begins == (oslo->block == OSLO_NO_BLOCK)) {
            oslo->block = blocks[i].block;
            return true;
        }
    }
    return false;
}

/* What configurations may set: of a surface, or of the system; a name with a number behind it. */
static const struct {
    const char *word;
    bool of_surface, is_numbered;
} settings[] = {
    {"TH", true, false},   {"RD", true, false},   {"CV", true, false},   {"CC", true, false},
    {"AD", true, false},   {"AE", true, false},   {"AF", true, false},   {"AG", true, false},
    {"AS", true, true},    {"AP", true, false},   {"GLA", true, false},  {"DCX", true, false},
    {"DCY", true, false},  {"DCZ", true, false},  {"TLA", true, false},  {"TLB", true, false},
    {"TLC", true, false},  {"EBR", false, false}, {"NAO", false, false}, {"FNO", false, false},
    {"ANG", false, false}, {"OBH", false, false}, {"GIH", false, false}, {"WV", false, true},
    {"WW", false, true}};

/* The place in the table of the setting that the command is; the number of all: it is none. */
static size_t oslo_setting_of(const struct commands *commands)
{
    const size_t all = sizeof settings / sizeof settings[0];
    for (size_t i = 0; i < all; i++) {
        struct text name = commands->words[0].text;
        while (settings[i].is_numbered && name.length > 0 &&
               char_is_digit(name.start[name.length - 1])) {
            name.length--;
        }
        bool numbered = name.length < commands->words[0].text.length;
        if (text_same(name, settings[i].word) && numbered == settings[i].is_numbered) {
            const size_t words = settings[i].of_surface ? 4 : 3;
            return commands->count == words ? i : all;
        }
    }
    return all;
}

static bool oslo_count(const struct oslo *oslo, size_t word, const char *what, size_t least,
                       size_t *number)
{
    const struct command_word found = commands_word(&oslo->commands, word);
    return commands_count(&oslo->commands, &found, found.text, what, least, number);
}

bool oslo_count_positions(struct oslo *oslo)
{
    const struct text word = oslo->commands.words[0].text;
    const bool in_block = oslo->block == OSLO_CONFIGURATIONS;
    if (!oslo->has_ended) {
        oslo->has_ended = text_same(word, "END");
        return true;
    }
    if (oslo_enter(oslo, word) || !in_block) {
        return true;
    }
    const size_t at = oslo_setting_of(&oslo->commands);
    const bool is_known = at < sizeof settings / sizeof settings[0];
    size_t number = 0;
    if (!is_known) {
        return true; /* it is lost, or harmless */
    }
    const size_t place = settings[at].of_surface ? 2 : 1;
    if (!oslo_count(oslo, place, "number of the configuration", 1, &number)) {
        return false;
    }
    if (number > MOST_POSITIONS) {
        return commands_fail(&oslo->commands, &oslo->commands.words[place],
                             "more than %d configurations", MOST_POSITIONS);
    }
    oslo->positions = number > oslo->positions && number > 1 ? number : oslo->positions;
    return true;
}

/* A distance that follows another surface's and is set anew: which of the two rules? */
static bool is_picked_up(const struct oslo *oslo, size_t surface)
{
    bool is = false;
    for (size_t i = 0; i < oslo->sequence.pickup_count; i++) {
        is = is || oslo->sequence.pickups[i].target == surface;
    }
    return is;
}

bool oslo_place(struct oslo *oslo, bool *is_here)
{
    struct commands *commands = &oslo->commands;
    const size_t at = oslo_setting_of(commands);
    size_t surface = 0, position = 0;
    *is_here = false;
    if (at == sizeof settings / sizeof settings[0]) {
        return commands_lose(commands, LOSS_OF_RAYS, NULL,
                             "a setting of a configuration that is not known");
    }
    const size_t gone = settings[at].of_surface ? 2 : 1;
    if (!oslo_count(oslo, gone, "number of the configuration", 1, &position) ||
        (gone == 2 && !oslo_count(oslo, 1, "number of the surface", 0, &surface))) {
        return false;
    }
    if (surface >= oslo->sequence.count) {
        return commands_fail(commands, &commands->words[1], "surface %zu of %zu", surface,
                             oslo->sequence.count - 1);
    }
    if (gone == 2 && is_picked_up(oslo, surface)) {
        return commands_lose(commands, LOSS_OF_RAYS, NULL,
                             "a setting of a configuration, of a surface that follows another");
    }
    *is_here = position == (oslo->positions > 0 ? oslo->position : 1);
    oslo->surface = surface;
    memmove(commands->words + 1, commands->words + 1 + gone,
            (commands->count - 1 - gone) * sizeof commands->words[0]);
    commands->count -= gone;
    return true;
}

void oslo_check_solves(const struct oslo *oslo)
{
    const struct sequence *sequence = &oslo->sequence;
    for (size_t i = 0; i < sequence->count && oslo->positions > 0; i++) {
        const struct sequence_solve *solves[] = {&sequence->surfaces[i].curvature_solve,
                                                 &sequence->surfaces[i].thickness_solve};
        for (int k = 0; k < 2; k++) {
            const struct file_words place = commands_place(&oslo->commands, &solves[k]->at);
            if (solves[k]->is_set) {
                foreign_loss(oslo->job, &place, solves[k]->at.text, LOSS_OF_RAYS,
                             "each is solved by itself", "a solve in a file with configurations");
            }
        }
    }
}
