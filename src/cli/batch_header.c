/* cli/batch_header.c - what the columns of a batch mean. */
/* SPDX-License-Identifier: MIT */
#include "cli/batch.h"

#include <math.h>
#include <string.h>

bool batch_read_cell(const struct batch *batch, const struct batch_column *column, struct text cell,
                     void *input, struct error *error)
{
    char *member = (char *)input + column->option->offset;
    if (column->is_infinite) {
        if (text_equal(cell, "true")) {
            *(double *)(void *)member = INFINITY;
        } else if (text_equal(cell, "false")) {
            /* no infinity is left over from the row before */
            if (isinf(*(const double *)(const void *)member)) {
                memcpy(member, (const char *)batch->constants + column->option->offset,
                       sizeof(double));
            }
        } else {
            return fail(error, ERROR_DATA, "'%.*s' is neither true nor false", text_shown(cell),
                        cell.start);
        }
        return true;
    }
    if (text_same(cell, "undef")) {
        /* exiftool's word for no value */
        memcpy(member, (const char *)batch->constants + column->option->offset,
               column->option->kind->size);
        return true;
    }
    return option_read(batch->reader, &column->as_read, cell, member, error);
}

bool batch_has(const struct batch *batch, const char *option)
{
    for (size_t i = 0; i < batch->column_count; i++) {
        const struct batch_column *column = &batch->columns[i];
        if (column->option != NULL && strcmp(column->option->name, option) == 0) {
            return true;
        }
    }
    return false;
}

const char *batch_called(const struct batch *batch, const struct option *option)
{
    const char *called = NULL;
    for (size_t i = 0; i < batch->column_count; i++) {
        const struct batch_column *column = &batch->columns[i];
        /* a companion only says that the other column is infinite */
        if (column->option == option && !column->is_ignored &&
            (called == NULL || !column->is_infinite)) {
            called = column->as_read.called;
        }
    }
    return called;
}

enum { MOST_COLUMNS = 4096 };

/* Tags by which cameras and exiftool name what an option takes. */
static const struct {
    const char *tag, *option;
} tags[] = {
    {"FNumber", "aperture"},         {"ExposureTime", "time"},        {"ShutterSpeed", "time"},
    {"FocusDistance", "distance"},   {"SubjectDistance", "distance"}, {"Model", "sensor"},
    {"Camera Model Name", "sensor"},
};

/* Is the column named by a tag of photographs? */
static const char *tagged_option(struct text name)
{
    for (size_t i = 0; i < sizeof tags / sizeof tags[0]; i++) {
        if (text_same_name(name, text_of(tags[i].tag))) {
            return tags[i].option;
        }
    }
    return NULL;
}

/* As people and other programs write names: case, '_' and '-' do not count. */
static const struct option *option_like(const struct batch *batch, struct text name)
{
    const struct command *command = batch->arguments->command;
    const char *tagged = tagged_option(name);
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

/* The option that a name without unit stands for: "f", "focal_length", "FocalLength" or "focal". */
static const struct option *option_of(const struct batch *batch, struct text name)
{
    const struct command *command = batch->arguments->command;
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

/* "far_is_infinite" beside "far_m" in the rows of another lenscalc. */
static bool find_companion(const struct batch *batch, struct text name, struct batch_column *column)
{
    static const char suffix[] = "_is_infinite";
    size_t length = sizeof suffix - 1;
    if (name.length <= length || memcmp(name.start + name.length - length, suffix, length) != 0) {
        return false;
    }
    column->option = option_of(batch, (struct text){name.start, name.length - length});
    column->is_infinite = column->option != NULL && column->option->kind == &kind_quantity;
    return column->is_infinite;
}

/* Split "focal_length_mm" or "speed_m_s" into the option and its unit, at any '_'. */
static const struct option *find_with_unit(const struct batch *batch, struct text name,
                                           const char **unit, struct text *typed)
{
    const struct option *without_unit = NULL;
    for (size_t at = 1; at + 1 < name.length; at++) {
        if (name.start[at] != '_') {
            continue;
        }
        const struct option *option = option_of(batch, (struct text){name.start, at});
        struct text behind = {name.start + at + 1, name.length - at - 1};
        if (option == NULL || option->dimension == NULL) {
            continue;
        }
        const struct unit *found = unit_find(option->dimension, behind);
        *typed = behind;
        if (found != NULL) {
            *unit = found->name;
            return option;
        }
        without_unit = option;
    }
    return without_unit;
}

/* Is this the name, with or without unit, of a column of the sheet that is always printed? */
static bool is_column(const struct sheet *sheet, struct text name)
{
    for (size_t i = 0; i < sheet->column_count; i++) {
        const struct column *column = &sheet->columns[i];
        size_t length = strlen(column->name);
        bool begins = name.length >= length && memcmp(name.start, column->name, length) == 0;
        struct text rest = {name.start + length, begins ? name.length - length : 0};
        if (begins && (column->flags & COLUMN_EXTRA) == 0 &&
            (rest.length == 0 || text_equal(rest, "_is_infinite") ||
             (column->unit != NULL && rest.start[0] == '_' &&
              text_equal((struct text){rest.start + 1, rest.length - 1}, column->unit)))) {
            return true;
        }
    }
    return false;
}

/* Will the command print a column of this name itself? */
static bool is_computed(const struct batch *batch, struct text name)
{
    return text_equal(name, "error") || is_column(&batch->arguments->command->sheet, name);
}

/* Does any command print a column of this name? */
static bool is_printed(struct text name)
{
    for (size_t i = 0; commands[i] != NULL; i++) {
        if (is_column(&commands[i]->sheet, name)) {
            return true;
        }
    }
    return false;
}

static bool is_unit_of_any(struct text name)
{
    for (size_t i = 0; dimensions[i] != NULL; i++) {
        if (unit_find(dimensions[i], name) != NULL) {
            return true;
        }
    }
    return false;
}

static bool wrong_unit(const struct batch_column *column, struct error *error)
{
    struct text name = column->name, typed = column->typed_unit;
    return fail(error, ERROR_DATA, "column '%.*s': '%.*s' is not a unit of --%s (a %s)",
                text_shown(name), name.start, (int)(typed.length < 20 ? typed.length : 20),
                typed.start, column->doubtful->name, column->doubtful->dimension->name);
}

static void set_scale(struct batch_column *column, const struct reader *reader)
{
    const struct unit *unit = option_unit(&column->as_read);
    column->scale = unit != NULL ? unit->scale : NUMBER_UNSCALED;
    column->factor = unit != NULL ? unit->factor : 1;
    bool limited = column->option->lowest != 0 || column->option->highest != 0;
    column->lowest = limited ? column->option->lowest : -INFINITY;
    column->highest = limited ? column->option->highest : INFINITY;
    if (column->option->unusual != NULL) {
        /* the short way leaves what is doubted to the long one */
        column->lowest = fmax(column->lowest, column->option->usual[0]);
        column->highest = fmin(column->highest, column->option->usual[1]);
    }
    column->offset = column->option->offset;
    column->is_coc = column->option->kind == &kind_coc;
    bool labels = reader->nominal && option_has_series(column->option);
    column->is_plain = (column->option->kind == &kind_quantity && !labels) || column->is_coc;
}

/*
 * A tag that says what is known already: by an option, or by a column before it. Photographs have
 * several tags for one thing, and none of them was meant for this program.
 */
static bool is_spare_tag(const struct batch *batch, struct text name, const struct option *option)
{
    return tagged_option(name) != NULL &&
           (arguments_given(batch->arguments, option->name) || batch_has(batch, option->name));
}

static bool find_column(const struct batch *batch, struct text name, struct batch_column *column,
                        struct error *error)
{
    const char *unit = NULL;
    struct text typed;
    *column = (struct batch_column){.name = name};
    const char *called =
        arena_printf(batch->reader->arena, "column '%.*s'", text_shown(name), name.start);
    if (find_companion(batch, name, column)) {
        column->as_read = *column->option;
        column->as_read.called = called;
        return true;
    }
    column->option = option_of(batch, name);
    if (column->option != NULL && is_spare_tag(batch, name, column->option)) {
        column->option = NULL;
        return true;
    }
    if (column->option == NULL) {
        column->option = find_with_unit(batch, name, &unit, &typed);
        if (column->option != NULL && unit == NULL) {
            /* s_id is a name of its own beside s_m, near_diopter comes from another run */
            column->doubtful = is_printed(name) ? NULL : column->option;
            column->typed_unit = typed;
            column->option = NULL;
            if (column->doubtful != NULL && is_unit_of_any(typed)) {
                return wrong_unit(column, error);
            }
        }
    }
    if (column->option != NULL) {
        column->as_read = *column->option;
        column->as_read.unit = unit != NULL ? unit : column->option->unit;
        column->as_read.called = called;
        set_scale(column, batch->reader);
    }
    return true;
}

/* Is it named as the option's column, and not only as the option? "rays_wanted" */
static bool is_own_name(const struct batch_column *column)
{
    const char *own = column->option->column;
    const size_t length = own != NULL ? strlen(own) : 0;
    return own != NULL && column->name.length >= length &&
           memcmp(column->name.start, own, length) == 0;
}

/* Beside the column of an option, a result that bears the option's name does not mean it. */
static void prefer_own_name(const struct batch *batch, struct batch_column *one,
                            struct batch_column *other)
{
    struct batch_column *const result = is_own_name(one) ? other : one;
    if (one->option == other->option && is_own_name(one) != is_own_name(other) &&
        is_computed(batch, result->name)) {
        result->option = NULL;
    }
}

static bool check_new(struct batch *batch, struct batch_column *column, struct error *error)
{
    for (size_t i = 0; i < batch->column_count; i++) {
        struct batch_column *other = &batch->columns[i];
        if (column->option != NULL && other->option != NULL) {
            prefer_own_name(batch, column, other);
        }
        bool same_name = text_identical(other->name, column->name);
        bool same_option = column->option != NULL && column->option == other->option &&
                           !column->is_infinite && !other->is_infinite;
        if (same_name || same_option) {
            return fail(error, ERROR_DATA, "columns '%.*s' and '%.*s' mean the same",
                        text_shown(other->name), other->name.start, text_shown(column->name),
                        column->name.start);
        }
    }
    return true;
}

bool batch_add_column(struct batch *batch, struct text name, size_t at, struct error *error)
{
    struct batch_column column;
    if (!find_column(batch, name, &column, error) || !check_new(batch, &column, error)) {
        return error_locate(error, batch->source, batch->line, at);
    }
    if (batch->column_count == MOST_COLUMNS) {
        fail(error, ERROR_DATA, "the file has more than %d columns", MOST_COLUMNS);
        return error_locate(error, batch->source, batch->line, at);
    }
    if (batch->column_count == batch->column_capacity) {
        size_t capacity = batch->column_capacity == 0 ? 16 : 2 * batch->column_capacity;
        struct batch_column *columns =
            ARENA_ARRAY(batch->reader->arena, capacity, struct batch_column);
        if (batch->column_count > 0) {
            memcpy(columns, batch->columns, batch->column_count * sizeof *columns);
        }
        batch->columns = columns;
        batch->column_capacity = capacity;
    }
    column.place = at;
    batch->columns[batch->column_count++] = column;
    return true;
}

/* Is every option that a goal would solve for already there? */
static bool has_all_settings(const struct batch *batch)
{
    const struct command *command = batch->arguments->command;
    bool any = false;
    for (size_t i = 0; i < command->option_count; i++) {
        const struct option *option = &command->options[i];
        if ((option->flags & OPTION_SETTING) == 0) {
            continue;
        }
        any = true;
        if (!batch_has(batch, option->name) && !arguments_given(batch->arguments, option->name)) {
            return false;
        }
    }
    return any;
}

/*
 * Decide what is handed through. Results of an earlier run in the same file are computed anew, and
 * do not count as goals where the row has all the settings.
 */
bool batch_settle_columns(struct batch *batch, struct error *error)
{
    bool settled = has_all_settings(batch);
    batch->passed_names = ARENA_ARRAY(batch->reader->arena, batch->column_count, struct text);
    batch->passed = ARENA_ARRAY(batch->reader->arena, batch->column_count, struct text);
    batch->passed_bare = ARENA_ARRAY(batch->reader->arena, batch->column_count, bool);
    for (size_t i = 0; i < batch->column_count; i++) {
        struct batch_column *column = &batch->columns[i];
        const struct option *meant = column->doubtful;
        if (meant != NULL && !batch_has(batch, meant->name) &&
            !arguments_given(batch->arguments, meant->name)) {
            wrong_unit(column, error);
            return error_locate(error, batch->source, batch->line, column->place);
        }
        bool goal = column->option != NULL && (column->option->flags & OPTION_GOAL) != 0;
        if (goal && settled) {
            column->is_ignored = true;
            column->is_plain = false;
        } else if (column->option == NULL && is_computed(batch, column->name)) {
            column->is_ignored = true;
        } else if (column->option == NULL) {
            column->passed = batch->passed_count;
            batch->passed_names[batch->passed_count++] = column->name;
        } else if (arguments_given(batch->arguments, column->option->name)) {
            return fail(error, ERROR_USAGE, "--%s is given, and a column of the batch too ('%.*s')",
                        column->option->name, (int)column->name.length, column->name.start);
        }
    }
    return true;
}
