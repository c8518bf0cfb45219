/* cli/batch/batch_names.c - which option the name of a batch's column stands for. */
/* SPDX-License-Identifier: MIT */
#include "cli/batch/batch.h"

#include "base/text.h"

#include <string.h>

/*
 * Tags by which cameras and exiftool name what an option takes; null: the one of that name. Several
 * may say the same thing, as they are written by programs for whoever reads them.
 */
static const struct photo_tag {
    const char *tag, *option;
    bool zero_is_unknown;
} tags[] = {
    {"FNumber", "aperture", false},
    {"Aperture", NULL, false},
    {"ExposureTime", "time", false},
    {"ShutterSpeed", "time", false},
    {"FocalLength", NULL, false},
    {"ISO", NULL, false},
    {"FocusDistance", "distance", false},
    {"SubjectDistance", "distance", true}, /* Exif 2.3, table 7: a numerator of 0 is "unknown" */
    {"Distance", NULL, false},
    {"Model", "sensor", false},
    {"Camera Model Name", "sensor", false},
};

enum { TAG_COUNT = sizeof tags / sizeof tags[0] };

/* Groups of exiftool whose tags are the photograph's own, not its maker's or its thumbnail's. */
static const char *const own_groups[] = {"EXIF", "IFD0", "ExifIFD", "Composite"};

/* Cut the last group, "ExifIFD", off a name such as "EXIF:ExifIFD:FNumber" of exiftool -G0:1. */
static struct text cut_group(struct text *name)
{
    struct text group = {name->start, 0}, rest = *name;
    while (memchr(rest.start, ':', rest.length) != NULL) {
        group = text_cut(&rest, ':');
        *name = rest;
    }
    return group;
}

static const struct photo_tag *find_tag(struct text name)
{
    for (size_t i = 0; i < TAG_COUNT; i++) {
        if (text_same_name(name, text_of(tags[i].tag))) {
            return &tags[i];
        }
    }
    return NULL;
}

/* Written as exiftool writes tags, most of which mean nothing here: "Lens", "DOF". */
static bool is_tag_like(struct text name)
{
    bool is_word = name.length > 1 && name.start[0] >= 'A' && name.start[0] <= 'Z';
    for (size_t i = 0; i < name.length && is_word; i++) {
        is_word = (name.start[i] >= 'A' && name.start[i] <= 'Z') ||
                  (name.start[i] >= 'a' && name.start[i] <= 'z') || char_is_digit(name.start[i]);
    }
    return is_word;
}

/* As people and other programs write names: case, blanks, '_' and '-' do not count. */
static const struct option *option_like(const struct batch *batch, struct text name)
{
    const struct command *command = batch->arguments->command;
    const struct photo_tag *tag = find_tag(name);
    const char *const tagged = tag != NULL ? tag->option : NULL;
    for (size_t i = 0; i < command->option_count; i++) {
        const struct option *option = &command->options[i];
        if (tagged != NULL && strcmp(option->name, tagged) == 0) {
            return option;
        }
        if (tagged == NULL && name.length > 1 &&
            (text_same_name(name, text_of(option->name)) ||
             (option->column != NULL && text_same_name(name, text_of(option->column))))) {
            return option;
        }
    }
    return NULL;
}

const struct option *batch_option_of(const struct batch *batch, struct text name)
{
    const struct command *command = batch->arguments->command;
    if (batch->is_photographs && is_tag_like(name) && find_tag(name) == NULL) {
        return NULL;
    }
    for (size_t i = 0; i < command->option_count; i++) {
        const struct option *option = &command->options[i];
        if ((name.length == 1 && name.start[0] == option->letter) ||
            (option->column != NULL && text_equal(name, option->column))) {
            return option;
        }
    }
    const struct argument *argument = arguments_find(batch->arguments, name);
    return argument != NULL && argument->is_input ? argument->option : option_like(batch, name);
}

/* A name and what may be the unit behind it; false: it is no such name with such a unit. */
static bool match_unit(const struct batch *batch, struct text name, struct text typed,
                       struct batch_column *column)
{
    const struct option *option = batch_option_of(batch, name);
    if (option == NULL || option->dimension == NULL) {
        return false;
    }
    /* as it is typed, or as the heads of tables have it: "1/mm" */
    const struct unit *unit = unit_find(option->dimension, typed);
    for (size_t i = 0; i < option->dimension->unit_count && unit == NULL && typed.length > 0; i++) {
        unit = text_equal(typed, option->dimension->units[i].label) ? &option->dimension->units[i]
                                                                    : NULL;
    }
    column->typed_unit = typed;
    if (unit != NULL) {
        column->option = option;
        column->as_read.unit = unit->name;
    } else {
        column->doubtful = option;
    }
    return unit != NULL;
}

/* "Focal Length (mm)", "Distance [ft]". */
static bool match_brackets(const struct batch *batch, struct text name, struct batch_column *column)
{
    const char last = name.length > 0 ? name.start[name.length - 1] : '\0';
    size_t at = last == ')' || last == ']' ? name.length - 1 : 0;
    while (at > 0 && name.start[at] != (last == ')' ? '(' : '[')) {
        at--;
    }
    if (at == 0) {
        return false;
    }
    const struct text inside = {name.start + at + 1, name.length - at - 2};
    return match_unit(batch, text_trim((struct text){name.start, at}), text_trim(inside), column);
}

void batch_find_meaning(const struct batch *batch, struct text name, struct batch_column *column)
{
    struct text bare = name;
    const struct text group = cut_group(&bare);
    const struct photo_tag *tag = find_tag(bare);
    if (tag != NULL && (group.length > 0 || text_equal(bare, tag->tag))) {
        bool is_own = group.length == 0;
        for (size_t i = 0; i < sizeof own_groups / sizeof own_groups[0] && !is_own; i++) {
            is_own = text_same_name(group, text_of(own_groups[i]));
        }
        column->option = batch_option_of(batch, bare);
        column->tag = tag->tag;
        column->is_copy = !is_own;
        column->zero_is_unknown = tag->zero_is_unknown;
        return;
    }
    column->option = batch_option_of(batch, name);
    bool found = column->option != NULL;
    /* "focal_length_mm" or "speed_m_s": the option and its unit, at any '_' */
    for (size_t at = 1; at + 1 < name.length && !found; at++) {
        const struct text behind = {name.start + at + 1, name.length - at - 1};
        found = name.start[at] == '_' &&
                match_unit(batch, (struct text){name.start, at}, behind, column);
    }
    if (found || match_brackets(batch, name, column)) {
        column->doubtful = NULL;
    }
}
