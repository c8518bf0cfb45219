/* cli/batch/batch_cell.c - the value that a cell of a batch has for its option. */
/* SPDX-License-Identifier: MIT */
#include "cli/batch/batch.h"

#include <math.h>
#include <string.h>

void batch_reset_member(const struct batch *batch, const struct option *option, void *input)
{
    memcpy((char *)input + option->offset, (const char *)batch->constants + option->offset,
           option->kind->size);
}

/* -------- decimal commas -------- */

/* Kinds whose values are numbers; a list has commas of its own. */
static const struct option_kind *const decimal_kinds[] = {
    &kind_quantity, &kind_coc,   &kind_loss,  &kind_interval, &kind_wavelength,
    &kind_vector,   &kind_pupil, &kind_print, &kind_plane,    &kind_sensor,
};

bool batch_has_decimals(const struct option *option)
{
    bool found = false;
    for (size_t i = 0; i < sizeof decimal_kinds / sizeof decimal_kinds[0] && !found; i++) {
        found = option->kind == decimal_kinds[i];
    }
    return found;
}

static bool is_decimal(struct text cell, size_t at)
{
    return at > 0 && at + 1 < cell.length && char_is_digit(cell.start[at - 1]) &&
           char_is_digit(cell.start[at + 1]);
}

/* The points of names, "1/2.3", are not meant. */
static enum decimals decimals_of(const struct batch_column *column, struct text cell)
{
    unsigned seen = DECIMALS_UNKNOWN;
    for (size_t i = 0; i < cell.length; i++) {
        if (cell.start[i] == ',' && is_decimal(cell, i)) {
            seen |= DECIMALS_COMMA;
        } else if (cell.start[i] == '.' && column->option->kind != &kind_sensor) {
            seen |= DECIMALS_POINT;
        }
    }
    return (enum decimals)seen;
}

/*
 * Write a decimal comma as a point, where no cell of the file has one, as far as it has been read:
 * 1,234 beside 5.6 would be more than a thousand.
 */
static bool settle_decimals(struct batch *batch, const struct batch_column *column,
                            struct text *cell, struct error *error)
{
    const enum decimals seen = decimals_of(column, *cell);
    if (seen == DECIMALS_UNKNOWN || seen == DECIMALS_BOTH) {
        return true; /* of both, what reads the value complains */
    }
    if (batch->row_decimals == DECIMALS_UNKNOWN) {
        batch->row_decimals = seen;
    }
    if (seen == DECIMALS_POINT) {
        return batch->row_decimals == DECIMALS_POINT ||
               fail(error, ERROR_DATA,
                    "%s '%.*s' has a decimal point, and cells before it decimal commas",
                    column->as_read.called, text_shown(*cell), cell->start);
    }
    if (batch->row_decimals == DECIMALS_COMMA) {
        char *written = arena_string(batch->reader->arena, cell->start, cell->length);
        for (size_t i = 0; i < cell->length; i++) {
            written[i] = written[i] == ',' && is_decimal(*cell, i) ? '.' : written[i];
        }
        cell->start = written;
    }
    return true;
}

/* -------- several columns of one option -------- */

/* A column that has given the option its value in this row; null: none has. */
static const struct batch_column *filled_column(const struct batch *batch,
                                                const struct option *option)
{
    for (size_t i = 0; i < batch->column_count; i++) {
        const struct batch_column *column = &batch->columns[i];
        if (column->option == option && column->filled == batch->rows) {
            return column;
        }
    }
    return NULL;
}

static void leave_member(const struct batch *batch, const struct batch_column *column, void *input)
{
    if (!column->is_shared || filled_column(batch, column->option) == NULL) {
        batch_reset_member(batch, column->option, input);
    }
}

/* Do two cells have the same value? Numbers may be written in different ways. */
static bool is_same_cell(const struct batch_column *column, const struct batch_column *other,
                         const void *value, const void *known)
{
    double (*number_of)(const void *) = column->option->kind->number_of;
    if (number_of == NULL) {
        return text_same_name(column->cell, other->cell);
    }
    const double a = number_of(value), b = number_of(known);
    /* exiftool -n writes ten digits */
    return isinf(a) || isinf(b) ? a == b : fabs(a - b) <= 1e-9 * fabs(b);
}

static bool contradict(const struct batch_column *column, const struct batch_column *other,
                       struct error *error)
{
    fail(error, ERROR_DATA, "%s says '%.*s', and %s '%.*s'", column->as_read.called,
         text_shown(column->cell), column->cell.start, other->as_read.called,
         text_shown(other->cell), other->cell.start);
    return error_hint(error, "leave out the column that is not meant");
}

/* A value that another column may have given already: then it must be the same. */
static bool read_shared(struct batch *batch, struct batch_column *column, struct text cell,
                        char *member, struct error *error)
{
    const struct batch_column *other = filled_column(batch, column->option);
    const size_t size = column->option->kind->size;
    char *value = other != NULL ? arena_array(batch->reader->arena, 1, size) : member;
    if (other != NULL) {
        memcpy(value, member, size);
    }
    if (!option_read(batch->reader, &column->as_read, cell, value, error)) {
        return false;
    }
    column->filled = batch->rows;
    column->cell = cell;
    return other == NULL || is_same_cell(column, other, value, member) ||
           contradict(column, other, error);
}

/* "far_is_infinite" beside "far_m". */
static bool read_companion(struct batch *batch, struct batch_column *column, struct text cell,
                           void *input, struct error *error)
{
    double *number = (double *)(void *)((char *)input + column->option->offset);
    const struct batch_column *other = filled_column(batch, column->option);
    column->cell = cell;
    if (text_equal(cell, "true")) {
        if (other != NULL && !isinf(*number)) {
            return contradict(column, other, error);
        }
        *number = INFINITY;
        column->filled = batch->rows;
    } else if (!text_equal(cell, "false")) {
        return fail(error, ERROR_DATA, "'%.*s' is neither true nor false", text_shown(cell),
                    cell.start);
    } else if (isinf(*number)) {
        leave_member(batch, column, input); /* no infinity is left over from the row before */
    }
    return true;
}

/* Words for no value: of exiftool, and of Exif for a distance that the camera does not know. */
static bool is_absent(const struct batch_column *column, struct text cell)
{
    double value;
    struct error ignored;
    if (cell.length == 0 || text_same(cell, "undef") ||
        (column->tag != NULL && text_equal(cell, "-"))) {
        return true;
    }
    return column->zero_is_unknown &&
           quantity_read(cell, column->option->dimension, option_unit(&column->as_read), &value,
                         NULL, &ignored) &&
           value <= 0 && value >= 0;
}

bool batch_read_cell(struct batch *batch, struct batch_column *column, struct text cell,
                     void *input, struct error *error)
{
    char *member = (char *)input + column->option->offset;
    if (is_absent(column, cell)) {
        leave_member(batch, column, input);
        return true;
    }
    if (column->is_infinite) {
        return read_companion(batch, column, cell, input, error);
    }
    if (column->has_decimals && !settle_decimals(batch, column, &cell, error)) {
        return false;
    }
    if (column->is_shared) {
        return read_shared(batch, column, cell, member, error);
    }
    if (!option_read(batch->reader, &column->as_read, cell, member, error)) {
        return false;
    }
    /* a key that comes later in an object may turn out to say the same */
    column->filled = batch->rows;
    column->cell = cell;
    return true;
}
