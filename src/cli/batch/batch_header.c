/* cli/batch/batch_header.c - what the columns of a batch mean. */
/* SPDX-License-Identifier: MIT */
#include "cli/batch/batch.h"

#include <math.h>
#include <string.h>

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

bool batch_is_filled(const struct batch *batch, const struct option *option, const void *input)
{
    return memcmp((const char *)input + option->offset,
                  (const char *)batch->constants + option->offset, option->kind->size) != 0;
}

bool batch_knows_any(const struct batch *batch)
{
    bool found = false;
    for (size_t i = 0; i < batch->column_count && !found; i++) {
        found = batch->columns[i].option != NULL;
    }
    return found;
}

const char *batch_called(const struct batch *batch, const struct option *option)
{
    const struct batch_column *called = NULL;
    for (size_t i = 0; i < batch->column_count; i++) {
        const struct batch_column *column = &batch->columns[i];
        /* a companion only says that the other column is infinite */
        if (column->option == option && !column->is_ignored &&
            (called == NULL || (called->is_infinite && !column->is_infinite))) {
            called = column;
        }
    }
    return called != NULL ? called->as_read.called : NULL;
}

enum { MOST_COLUMNS = 4096 };

/* "far_is_infinite" beside "far_m" in the rows of another lenscalc. */
static bool find_companion(const struct batch *batch, struct text name, struct batch_column *column)
{
    static const char suffix[] = "_is_infinite";
    size_t length = sizeof suffix - 1;
    if (name.length <= length || memcmp(name.start + name.length - length, suffix, length) != 0) {
        return false;
    }
    column->option = batch_option_of(batch, (struct text){name.start, name.length - length});
    column->is_infinite = column->option != NULL && column->option->kind == &kind_quantity;
    return column->is_infinite;
}

/* Is this the name, with or without unit, of a column of the sheet that is always printed? */
static bool is_column(const struct sheet *sheet, struct text name)
{
    for (size_t i = 0; i < sheet->column_count; i++) {
        const struct column *column = &sheet->columns[i];
        size_t length = strlen(column->name);
        bool begins = name.length >= length && memcmp(name.start, column->name, length) == 0;
        struct text rest = {name.start + length, begins ? name.length - length : 0};
        if (!begins || (column->flags & COLUMN_EXTRA) != 0) {
            continue;
        }
        /* '_' and one of the units in which machines read it */
        const struct text unit = text_behind(rest, "_");
        if (rest.length == 0 || text_equal(rest, "_is_infinite") ||
            (column->unit != NULL && unit.start != NULL &&
             (text_equal(unit, column->unit) ||
              (column->other != NULL && text_equal(unit, column->other->unit))))) {
            return true;
        }
    }
    return false;
}

/* Will the command print a column of this name itself? */
static bool is_computed(const struct batch *batch, struct text name)
{
    return text_equal(name, "error") || is_column(batch->sheet, name);
}

static bool header_wrong_unit(const struct batch_column *column, struct error *error)
{
    struct text name = column->name, typed = column->typed_unit;
    return fail(error, ERROR_DATA, "column '%.*s': '%.*s' is not a unit of --%s (a %s)",
                text_shown(name), name.start, text_shown_up_to(typed, 20), typed.start,
                column->doubtful->name, column->doubtful->dimension->name);
}

static void set_scale(struct batch_column *column, const struct reader *reader)
{
    const struct unit *unit = option_unit(&column->as_read);
    struct batch_plain *plain = &column->plain;
    plain->scale = unit != NULL ? unit->scale : NUMBER_UNSCALED;
    plain->factor = unit != NULL ? unit->factor : 1;
    bool limited = column->option->lowest != 0 || column->option->highest != 0;
    plain->lowest = limited ? column->option->lowest : -INFINITY;
    plain->highest = limited ? column->option->highest : INFINITY;
    if (column->option->unusual != NULL) {
        /* the short way leaves what is doubted to the long one */
        plain->lowest = fmax(plain->lowest, column->option->usual[0]);
        plain->highest = fmin(plain->highest, column->option->usual[1]);
    }
    plain->offset = column->option->offset;
    plain->is_coc = column->option->kind == &kind_coc;
    bool labels = reader->nominal && option_has_series(column->option);
    plain->is_focal = column->option->kind == &kind_focal;
    column->is_plain = (column->option->kind == &kind_quantity && !labels) || plain->is_coc ||
                       (plain->is_focal && !unit_is_equivalent(unit));
}

static bool header_column(const struct batch *batch, struct text name, struct batch_column *column,
                          struct error *error)
{
    *column = (struct batch_column){.name = name};
    const char *called = arena_printf(batch->arena, "column '%.*s'", text_shown(name), name.start);
    if (find_companion(batch, name, column)) {
        column->as_read = *column->option;
        column->as_read.called = called;
        return true;
    }
    batch_find_meaning(batch, name, column);
    const char *unit = column->as_read.unit;
    /* s_id is a name of its own beside s_m, near_diopter comes from another run */
    for (size_t i = 0; batch->commands[i] != NULL && column->doubtful != NULL; i++) {
        column->doubtful = is_column(&batch->commands[i]->sheet, name) ? NULL : column->doubtful;
    }
    for (size_t i = 0; dimensions[i] != NULL && column->doubtful != NULL; i++) {
        if (unit_find(dimensions[i], column->typed_unit) != NULL) {
            return header_wrong_unit(column, error);
        }
    }
    if (column->option != NULL) {
        column->as_read = *column->option;
        column->as_read.unit = unit != NULL ? unit : column->option->unit;
        column->as_read.called = called;
        column->has_decimals = batch->separator == ';' && batch_has_decimals(column->option);
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

/*
 * Two columns of one option. Of a tag that stands in several groups the photograph's own counts, as
 * exiftool has it without groups; of what else says the same, tags among it, the rows decide. False
 * if nothing tells them apart.
 */
static bool share_option(struct batch_column *one, struct batch_column *other)
{
    const bool is_companion = one->is_infinite || other->is_infinite;
    if (!is_companion && one->tag == NULL && other->tag == NULL) {
        return false;
    }
    if (one->tag == other->tag && one->is_copy != other->is_copy) {
        (one->is_copy ? one : other)->option = NULL;
    } else {
        one->is_shared = other->is_shared = true;
        one->is_plain = other->is_plain = false;
    }
    return true;
}

static bool check_new(struct batch *batch, struct batch_column *column, struct error *error)
{
    for (size_t i = 0; i < batch->column_count; i++) {
        struct batch_column *other = &batch->columns[i];
        if (column->option != NULL && other->option != NULL) {
            /* beside an option's column a result that bears its name does not mean it, such as
               the title of a lens */
            struct batch_column *const result = is_own_name(column) ? other : column;
            const bool is_title = column->option->kind->recall != NULL;
            if (column->option == other->option && is_own_name(column) != is_own_name(other) &&
                (is_title || is_computed(batch, result->name))) {
                result->option = NULL;
                result->is_ignored = is_title;
            }
        }
        bool same_name = text_identical(other->name, column->name);
        bool same_option = column->option != NULL && column->option == other->option;
        if (same_name || (same_option && !share_option(column, other))) {
            return fail(error, ERROR_DATA, "columns '%.*s' and '%.*s' mean the same",
                        text_shown(other->name), other->name.start, text_shown(column->name),
                        column->name.start);
        }
    }
    return true;
}

static bool push_column(struct batch *batch, const struct batch_column *column, struct error *error)
{
    if (batch->column_count == MOST_COLUMNS) {
        return fail(error, ERROR_DATA, "the file has more than %d columns", MOST_COLUMNS);
    }
    batch->columns = arena_grow(batch->arena, batch->columns, batch->column_count,
                                &batch->column_room, sizeof *batch->columns);
    batch->columns[batch->column_count++] = *column;
    batch->is_photographs = batch->is_photographs || text_equal(column->name, "SourceFile");
    return true;
}

bool batch_add_column(struct batch *batch, struct text name, size_t at, struct error *error)
{
    struct batch_column column;
    if (!header_column(batch, name, &column, error)) {
        return error_locate(error, batch->source, batch->line, at);
    }
    for (size_t i = 0; i < batch->column_count && batch->format != BATCH_JSONL; i++) {
        column.is_padding =
            column.is_padding || (name.length == 0 && batch->columns[i].name.length == 0);
    }
    column.is_ignored = column.is_padding;
    if (!column.is_padding && !check_new(batch, &column, error)) {
        return error_locate(error, batch->source, batch->line, at);
    }
    column.place = at;
    return push_column(batch, &column, error) ||
           error_locate(error, batch->source, batch->line, at);
}

/* Is every option that this goal would be solved for already there? */
static bool has_all_settings(const struct batch *batch, const struct option *goal)
{
    const struct command *command = batch->arguments->command;
    const bool of_two = (goal->flags & OPTION_GOAL_OF_TWO) != 0;
    const unsigned settings = OPTION_SETTING | (of_two ? OPTION_SETTING_TOO : 0);
    bool any = false;
    for (size_t i = 0; i < command->option_count; i++) {
        const struct option *option = &command->options[i];
        if ((option->flags & settings) == 0) {
            continue;
        }
        any = true;
        const struct argument *argument = arguments_find(batch->arguments, text_of(option->name));
        if (!batch_has(batch, option->name) &&
            !(argument->is_given && argument_rank(argument) >= RANK_KIT)) {
            return false; /* a default gives way to a goal */
        }
    }
    return any;
}

/* What becomes of a column. A goal is passed over where all it would be solved for is there. */
static bool settle_column(struct batch *batch, struct batch_column *column, struct error *error)
{
    const struct option *meant = column->doubtful;
    if (meant != NULL && !batch_has(batch, meant->name) &&
        !arguments_given(batch->arguments, meant->name)) {
        return header_wrong_unit(column, error);
    }
    bool goal = column->option != NULL && (column->option->flags & OPTION_GOAL) != 0;
    if (goal && has_all_settings(batch, column->option) &&
        !arguments_given(batch->arguments, column->option->name)) {
        column->is_ignored = true;
        column->is_plain = false;
    } else if (column->is_ignored || (column->option == NULL && is_computed(batch, column->name))) {
        column->is_ignored = true;
    } else if (column->option == NULL && column->is_late && !batch->hands_late) {
        column->is_ignored = true;
        warnings_add(batch->reader->doubts,
                     "the first row has no key '%.*s': only json and jsonl pass it through",
                     text_shown(column->name), column->name.start);
    } else if (column->option == NULL) {
        size_t room = batch->passed_room;
        batch->passed_names = arena_grow(batch->arena, batch->passed_names, batch->passed_count,
                                         &room, sizeof *batch->passed_names);
        batch->passed = arena_grow(batch->arena, batch->passed, batch->passed_count,
                                   &batch->passed_room, sizeof *batch->passed);
        column->passed = batch->passed_count;
        batch->passed[batch->passed_count].text = (struct text){"", 0};
        batch->passed_names[batch->passed_count++] = column->name;
    }
    return true;
}

bool batch_settle_columns(struct batch *batch, struct error *error)
{
    for (size_t i = 0; i < batch->column_count; i++) {
        struct batch_column *column = &batch->columns[i];
        if (!settle_column(batch, column, error)) {
            return error_locate(error, batch->source, batch->line, column->place);
        }
    }
    return true;
}

void batch_ignore(struct batch *batch, const struct shown *shown, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        for (size_t j = 0; j < batch->column_count; j++) {
            struct batch_column *gone = &batch->columns[j];
            if (gone->option != NULL || gone->is_ignored ||
                !text_equal(gone->name, shown[i].name)) {
                continue;
            }
            gone->is_ignored = true;
            batch->passed_count--;
            for (size_t k = gone->passed; k < batch->passed_count; k++) {
                batch->passed_names[k] = batch->passed_names[k + 1];
            }
            for (size_t k = 0; k < batch->column_count; k++) {
                struct batch_column *other = &batch->columns[k];
                other->passed -= other->passed > gone->passed ? 1 : 0;
            }
        }
    }
}

struct batch_column *batch_add_late(struct batch *batch, struct text name, struct error *error)
{
    struct batch_column column;
    name.start = arena_string(batch->arena, name.start, name.length);
    if (!header_column(batch, name, &column, error)) {
        return NULL;
    }
    column.is_late = true;
    /* rows may have either of two keys for one option, or both with the same value */
    for (size_t i = 0; i < batch->column_count; i++) {
        struct batch_column *other = &batch->columns[i];
        if (column.option != NULL && column.option == other->option &&
            !share_option(&column, other)) {
            column.is_shared = other->is_shared = true;
        }
    }
    if (!push_column(batch, &column, error)) {
        return NULL;
    }
    struct batch_column *added = &batch->columns[batch->column_count - 1];
    if (!settle_column(batch, added, error)) {
        batch->column_count--;
        return NULL;
    }
    return added;
}
