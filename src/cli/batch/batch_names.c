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

/* What people write over the columns of spreadsheets, beside the names of options. */
static const struct header_word {
    const char *word, *option;
} header_words[] = {
    {"f-stop", "aperture"},
    {"f/stop", "aperture"},
    {"f/", "aperture"},
    {"f/#", "aperture"},
    {"f#", "aperture"},
    {"f/number", "aperture"},
    {"f/no", "aperture"},
    {"f-no", "aperture"},
    {"f/ratio", "aperture"},
    {"f-ratio", "aperture"},
    {"focal ratio", "aperture"},
    {"diaphragm", "aperture"},
    {"FL", "focal-length"},
    {"EFL", "focal-length"},
    {"effective focal length", "focal-length"},
    {"lens focal length", "focal-length"},
    {"distance to subject", "distance"},
    {"distance to object", "distance"},
    {"object distance", "distance"},
    {"focusing distance", "distance"},
    {"focussing distance", "distance"},
    {"shutter", "time"},
    {"shutter time", "time"},
    {"film speed", "iso"},
    {"ISO speed", "iso"},
    {"ISO sensitivity", "iso"},
    {"ASA", "iso"},
    {"camera", "sensor"},
    {"camera body", "sensor"},
    {"sensor size", "sensor"},
    {"sensor format", "sensor"},
    {"film format", "sensor"},
    {"circle of confusion", "coc"},
    {"pupil ratio", "pupil"},
    {"numerical aperture", "na"},
    {"lambda", "wavelength"},
};

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

/* The name of the option that a word over a column means, "F-stop" or "f/No."; null: none. */
static const char *header_word_option(struct text name)
{
    name.length -= name.length > 0 && name.start[name.length - 1] == '.';
    if (text_equal(name, "camera")) {
        return NULL; /* of 'list cameras', which has sizes of its own beside it */
    }
    for (size_t i = 0; i < sizeof header_words / sizeof header_words[0]; i++) {
        if (text_same_name(name, text_of(header_words[i].word))) {
            return header_words[i].option;
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
    const char *const meant = header_word_option(name);
    const struct argument *argument =
        meant != NULL ? arguments_find(batch->arguments, text_of(meant)) : NULL;
    return argument != NULL && argument->is_input ? argument->option : NULL;
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

/* Is the text the unit's name, or a spelling of it, but for its case? */
static bool is_unit_like(const struct unit *unit, struct text typed)
{
    struct text rest = text_of(unit->spellings != NULL ? unit->spellings : "");
    bool found = text_same_name(typed, text_of(unit->name));
    while (rest.length > 0 && !found) {
        found = text_same_name(typed, text_cut(&rest, ' '));
    }
    return found;
}

/*
 * A unit as it is typed, as the heads of tables have it, "1/mm", or in other case, "(Feet)", where
 * that is one unit only.
 */
static const struct unit *header_unit(const struct dimension *dimension, struct text typed)
{
    const struct unit *found = unit_find(dimension, typed);
    for (size_t i = 0; i < dimension->unit_count && found == NULL && typed.length > 0; i++) {
        found = text_equal(typed, dimension->units[i].label) ? &dimension->units[i] : NULL;
    }
    if (found != NULL || typed.length == 0) {
        return found;
    }
    size_t alike = 0;
    for (size_t i = 0; i < dimension->unit_count; i++) {
        if (is_unit_like(&dimension->units[i], typed)) {
            found = &dimension->units[i];
            alike++;
        }
    }
    return alike == 1 ? found : NULL;
}

/* A name and what may be the unit behind it; false: it is no such name with such a unit. */
static bool match_unit(const struct batch *batch, struct text name, struct text typed,
                       struct batch_column *column)
{
    const struct option *option = batch_option_of(batch, name);
    if (option == NULL || option->dimension == NULL) {
        return false;
    }
    const struct unit *unit = header_unit(option->dimension, typed);
    column->typed_unit = typed;
    if (unit != NULL) {
        column->option = option;
        column->as_read.unit = unit->name;
    } else {
        column->doubtful = option;
    }
    return unit != NULL;
}

/* "Distance m", "Distance, m", "Distance/m", "Distance in m". What is no unit is passed over. */
static bool match_loose_unit(const struct batch *batch, struct text name,
                             struct batch_column *column)
{
    for (size_t at = 1; at + 1 < name.length; at++) {
        if (strchr(" ,/", name.start[at]) == NULL) {
            continue;
        }
        struct batch_column tried = *column;
        struct text behind = text_trim((struct text){name.start + at + 1, name.length - at - 1});
        const struct text in = text_behind(behind, "in ");
        if (match_unit(batch, text_trim((struct text){name.start, at}),
                       in.start != NULL ? text_trim(in) : behind, &tried)) {
            *column = tried;
            return true;
        }
    }
    return false;
}

/* "Focal Length (mm)", "Distance [ft]"; in brackets may also stand another name, "ISO (ASA)". */
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
    const struct text inside = text_trim((struct text){name.start + at + 1, name.length - at - 2});
    const struct text before = text_trim((struct text){name.start, at});
    if (match_unit(batch, before, inside, column)) {
        return true;
    }
    const struct option *option = batch_option_of(batch, before);
    if (option == NULL || batch_option_of(batch, inside) != option) {
        return false;
    }
    column->option = option;
    return true;
}

void batch_find_meaning(const struct batch *batch, struct text name, struct batch_column *column)
{
    /* spreadsheets break the lines of a narrow head */
    char *const line = arena_string(batch->arena, name.start, name.length);
    for (size_t i = 0; i < name.length; i++) {
        line[i] = line[i] == '\n' || line[i] == '\r' ? ' ' : line[i];
    }
    name.start = line;
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
    if (found || match_brackets(batch, name, column) || match_loose_unit(batch, name, column)) {
        column->doubtful = NULL;
    }
}
