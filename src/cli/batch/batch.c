/* cli/batch/batch.c - inputs from the rows of a file or pipe. */
/* SPDX-License-Identifier: MIT */
#include "cli/batch/batch.h"

#include "base/quantity.h"
#include "cli/batch/gaps.h"
#include "cli/batch/photographs.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { BLOCK = BATCH_BLOCK, BEHIND = BATCH_BEHIND };

/* One cell of a separated row: its content without quotes, and where it starts in the line. */
struct batch_cell {
    struct text text;
    size_t column;
};

/* Cut the next cell off the row. False if a quote is not closed or text follows it. */
static bool cut_cell(struct batch *batch, struct text *rest, struct batch_cell *cell)
{
    if (rest->length == 0 || rest->start[0] != '"') {
        cell->text = text_cut(rest, batch->separator);
        return true;
    }
    char *content = arena_array(batch->reader->arena, rest->length, 1);
    size_t used = 0, at = 1;
    while (at < rest->length) {
        if (rest->start[at] == '"') {
            if (at + 1 >= rest->length || rest->start[at + 1] != '"') {
                break;
            }
            at++;
        }
        content[used++] = rest->start[at++];
    }
    bool closed = at < rest->length;
    at++;
    cell->text = (struct text){content, used};
    if (closed && at < rest->length && rest->start[at] == batch->separator) {
        *rest = (struct text){rest->start + at + 1, rest->length - at - 1};
        return true;
    }
    bool last = at == rest->length;
    *rest = (struct text){NULL, 0};
    return closed && last;
}

static bool row_fail(struct batch *batch, struct error *error, size_t column)
{
    /* a wrong cell is the file's fault, not the command line's */
    if (error->code == ERROR_USAGE) {
        error->code = ERROR_DATA;
    }
    error_locate(error, batch->source, batch->line, column);
    return false;
}

/* The same of an object, which may have several lines. */
static bool object_fail(struct batch *batch, struct text object, struct error *error)
{
    size_t column = (size_t)error->column, begin = 0;
    long line = batch->line;
    for (size_t i = 0; i + 1 < column && i < object.length; i++) {
        if (object.start[i] == '\n') {
            line++;
            begin = i + 1;
        }
    }
    batch->line = line;
    row_fail(batch, error, column > begin ? column - begin : 0);
    return error_count_characters(error,
                                  (struct text){object.start + begin, object.length - begin});
}

static bool set_cell(struct batch *batch, struct batch_column *column, struct text cell, size_t at,
                     void *input, struct error *error)
{
    if (column->is_padding && text_trim(cell).length > 0) {
        fail(error, ERROR_DATA, "'%.*s' stands in one of several columns without a name",
             text_shown(cell), cell.start);
        return row_fail(batch, error, at);
    }
    if (column->is_ignored) {
        return true;
    }
    if (column->option == NULL) {
        batch->passed[column->passed].text = cell;
        return true;
    }
    if (!batch_read_cell(batch, column, text_trim(cell), input, error)) {
        return row_fail(batch, error, at + (error->caret > 0 ? (size_t)error->caret - 1 : 0));
    }
    return true;
}

/*
 * Any row: quotes, blanks, units, names. After a bad cell the others are still looked at: what is
 * passed through belongs to its row even if that fails.
 */
static bool batch_read_row(struct batch *batch, struct text line, void *input, struct error *error)
{
    struct text rest = line;
    struct error later;
    size_t cells = 0;
    bool good = true;
    batch->row_decimals = batch->decimals;
    while (rest.start != NULL) {
        size_t at = (size_t)(rest.start - line.start) + 1;
        struct batch_cell cell;
        if (!cut_cell(batch, &rest, &cell)) {
            fail(error, ERROR_DATA, "a quoted cell is not closed, or text follows it");
            row_fail(batch, error, at);
            return error_count_characters(error, line);
        }
        if (cells < batch->column_count &&
            !set_cell(batch, &batch->columns[cells], cell.text, at, input, good ? error : &later)) {
            good = false;
        }
        cells++;
    }
    if (!good) {
        return error_count_characters(error, line);
    }
    if (cells != batch->column_count) {
        fail(error, ERROR_DATA, "the row has %zu cells where the header has %zu", cells,
             batch->column_count);
        return row_fail(batch, error, 0);
    }
    batch->decimals = batch->row_decimals;
    return true;
}

struct plain_number {
    const char *behind; /* null if the cell is not a number and nothing else */
    double value;
};

/* Out of line, so that short numbers need not make room for it. */
__attribute__((noinline)) static struct plain_number read_longer(const struct batch_plain *plain,
                                                                 const char *at, const char *end)
{
    struct plain_number number = {NULL, 0};
    const char *behind = number_read(at, end, plain->scale, &number.value);
    if (behind != NULL && behind != end && *behind == plain->behind) {
        number.behind = behind;
    }
    return number;
}

static inline struct plain_number batch_read_plain(const struct batch_plain *plain, const char *at,
                                                   const char *end)
{
    struct number_short number;
    const bool negative = *at == '-';
    const char *behind = number_read_short(at + negative, &number);
    if (behind == NULL || *behind != plain->behind) {
        return read_longer(plain, at, end);
    }
    double value = number.mantissa * plain->up / plain->down[number.decimals];
    return (struct plain_number){behind, negative ? 0 - value : value};
}

/*
 * A row of bare numbers, as most are, straight from the buffer: no character is looked at twice.
 * Anything else (a blank, a unit, a value at the edge of its range, a row that has not
 * arrived whole) is left to read_row, with nothing taken.
 */
static bool take_plain_row(struct batch *batch, void *input)
{
    const char *at = batch->at;
    const struct batch_plain *plain = batch->plain, *behind = plain + batch->column_count;
    for (; plain < behind; plain++) {
        struct plain_number number = batch_read_plain(plain, at, batch->end);
        double value = number.value * plain->factor;
        /* an infinite value may be one that was too large */
        if (number.behind == NULL || !(value > plain->lowest && value < plain->highest)) {
            return false;
        }
        at = number.behind + 1;
        void *member = (char *)input + plain->offset;
        if (plain->is_coc) {
            struct coc_value *coc = member;
            coc->coc.kind = COC_LENGTH;
            coc->coc.value = value;
            coc->criterion = COC_GIVEN;
            coc->is_fallback = false;
        } else if (plain->is_focal) {
            struct focal_value *focal = member;
            focal->length = value;
            focal->equivalent = NAN;
            focal->of_camera = false;
        } else {
            *(double *)member = value;
        }
    }
    batch->at = at;
    batch->line = batch->next_line++;
    return true;
}

/* "--distance hyperfocal" says nothing in a row with a distance of its own. */
static void settle_hyperfocal(const struct batch *batch, void *input)
{
    const struct option *distance = arguments_find(batch->arguments, text_of("distance"))->option;
    const struct option *far_limit = arguments_find(batch->arguments, text_of("far"))->option;
    if (!batch_is_filled(batch, distance, input)) {
        batch_reset_member(batch, far_limit, input);
    } else if (!batch_has(batch, far_limit->name)) {
        option_clear(far_limit, (char *)input + far_limit->offset);
    }
}

/* Any row of a table: not only one of bare numbers. */
static enum batch_result batch_next_line(struct batch *batch, void *input, struct error *error)
{
    struct text line;
    bool read;
    /* no cell of an earlier row is left when this one is cut short */
    for (size_t i = 0; i < batch->passed_count; i++) {
        batch->passed[i] =
            (struct passed_cell){.text = {"", 0}, .is_bare = batch->format == BATCH_JSONL};
    }
    /* the next row of whatever the file has */
    if (!(batch->is_array ? batch_next_object(batch, &line, error)
                          : batch_next_row(batch, &line, error))) {
        return error->code == ERROR_NONE ? BATCH_END : BATCH_FAILED;
    }
    batch->rows++;
    if (batch->format == BATCH_JSONL) {
        read = batch_json_row(batch, line, input, error) || object_fail(batch, line, error);
    } else {
        read = batch_read_row(batch, line, input, error);
        if (memchr(line.start, '"', line.length) != NULL) {
            batch->next_line += batch_breaks(line);
        }
    }
    return read ? BATCH_ROW : BATCH_BAD_ROW;
}

enum batch_result batch_next(struct batch *batch, void *input, struct error *error)
{
    if (batch->plain != NULL && take_plain_row(batch, input)) {
        return BATCH_ROW;
    }
    const enum batch_result result = batch->photographs != NULL
                                         ? photographs_next(batch, input, error)
                                         : batch_next_line(batch, input, error);
    if (result == BATCH_ROW && batch->arguments->is_hyperfocal) {
        settle_hyperfocal(batch, input);
    }
    return result;
}

/* Does it stand in the line, outside quotes? */
static bool has_separator(struct text line, char separator)
{
    bool is_quoted = false;
    for (size_t i = 0; i < line.length; i++) {
        is_quoted = is_quoted != (line.start[i] == '"');
        if (!is_quoted && line.start[i] == separator) {
            return true;
        }
    }
    return false;
}

static void set_format(struct batch *batch, enum batch_format format, struct text first)
{
    bool tabs = first.length > 0 && memchr(first.start, '\t', first.length) != NULL;
    if (format == BATCH_AUTO) {
        struct text trimmed = text_trim(first);
        bool json = trimmed.length > 0 && (trimmed.start[0] == '{' || trimmed.start[0] == '[');
        if (json) {
            format = BATCH_JSONL;
        } else if (tabs) {
            format = BATCH_TSV;
        } else {
            format = BATCH_CSV;
        }
    }
    const bool semicolons =
        format == BATCH_CSV && !has_separator(first, ',') && has_separator(first, ';');
    batch->format = format;
    batch->separator = semicolons ? ';' : ',';
    if (format == BATCH_TSV) {
        batch->separator = '\t';
    }
}

/* Does a line begin behind a carriage return that is outside quotes and before no line break? */
static bool has_bare_return(struct text line, char separator)
{
    bool is_quoted = false;
    for (size_t i = 0; i + 1 < line.length; i++) {
        const char here = line.start[i], next = line.start[i + 1];
        if (here == '"') {
            /* behind another one it stands for itself, within quotes as before */
            const char before = i > 0 ? line.start[i - 1] : separator;
            is_quoted = !is_quoted && (before == separator || before == '"');
        } else if (!is_quoted && here == '\r' && next != '\r' && next != '\n') {
            return true;
        }
    }
    return false;
}

/* Is it a quantity of any dimension, "50", "f/2.8", "1/125 s", as no name of a column is? */
static bool is_value(struct text cell)
{
    struct error ignored;
    double value;
    bool found = false;
    for (size_t i = 0; dimensions[i] != NULL && !found; i++) {
        found = quantity_read(cell, dimensions[i], NULL, &value, NULL, &ignored);
    }
    return found;
}

/* Does the line where names of columns stand have values, and no name that means anything? */
static bool header_has_values(struct batch *batch, struct text line)
{
    struct text rest = line;
    struct batch_cell cell;
    bool any = false;
    while (rest.start != NULL && cut_cell(batch, &rest, &cell)) {
        const struct text name = text_trim(cell.text);
        struct batch_column column = {.name = name};
        batch_find_meaning(batch, name, &column);
        if (column.option != NULL) {
            return false;
        }
        any = any || is_value(name);
    }
    return any;
}

/* Names of the columns from the header line. */
static bool read_header(struct batch *batch, struct text line, struct error *error)
{
    struct text rest = line;
    if (memchr(line.start, '\0', line.length) != NULL) {
        fail(error, ERROR_DATA, "NUL bytes in the header: this is not UTF-8 text (UTF-16?)");
        return error_locate(error, batch->source, batch->line, 0);
    }
    if (has_bare_return(line, batch->separator)) {
        fail(error, ERROR_DATA,
             "lines end in a carriage return alone: expected a line feed, as tr '\\r' '\\n' makes "
             "it");
        return error_locate(error, batch->source, batch->line, 0);
    }
    if (header_has_values(batch, line)) {
        gaps_refuse_values(error, batch, line);
        return error_locate(error, batch->source, batch->line, 0);
    }
    while (rest.start != NULL) {
        size_t at = (size_t)(rest.start - line.start) + 1;
        struct batch_cell cell;
        if (!cut_cell(batch, &rest, &cell)) {
            fail(error, ERROR_DATA, "a quoted column name is not closed");
            return error_locate(error, batch->source, batch->line, at);
        }
        struct text name = text_trim(cell.text);
        name.start = arena_string(batch->arena, name.start, name.length);
        if (!batch_add_column(batch, name, at, error)) {
            return false;
        }
    }
    return true;
}

/*
 * Split the scale into factors that leave a short number one rounding: mantissa x up below 2^53,
 * powers of ten up to 10^22. False if it is too large for that.
 */
static bool batch_set_factors(struct batch_plain *plain)
{
    int power = plain->scale.power;
    plain->up = plain->scale.multiplier;
    for (; power > 0 && plain->up < 1e9; power--) {
        plain->up *= 10;
    }
    plain->down[0] = 1;
    for (; power < 0 && plain->down[0] < 1e15; power++) {
        plain->down[0] *= 10;
    }
    for (int decimals = 1; decimals <= NUMBER_SHORT_DIGITS; decimals++) {
        plain->down[decimals] = 10 * plain->down[decimals - 1];
    }
    return power == 0 && plain->up * 1e7 < 0x1p53;
}

/* Make rows of bare numbers fast, if all columns may be such. */
static void prepare_plain(struct batch *batch)
{
    size_t count = batch->column_count;
    if (batch->separator == ';' || batch->arguments->is_hyperfocal) {
        return; /* all cells say together how fractions are written; or whether that is asked */
    }
    struct batch_plain *plain = ARENA_ARRAY(batch->arena, count, struct batch_plain);
    for (size_t i = 0; i < count; i++) {
        plain[i] = batch->columns[i].plain;
        plain[i].behind = i + 1 < count ? batch->separator : '\n';
        if (!batch->columns[i].is_plain || !batch_set_factors(&plain[i])) {
            return;
        }
    }
    batch->plain = plain;
}

/* An array of objects, as exiftool -json writes it: `line` is where it begins, then its first. */
static bool open_array(struct batch *batch, struct text *line, struct error *error)
{
    batch->is_array = true;
    batch->at = line->start;
    batch->next_line = batch->line;
    if (!batch_next_object(batch, line, error)) {
        if (error->code != ERROR_NONE) {
            return false;
        }
        fail(error, ERROR_DATA, "the array is empty: expected objects with values");
        return error_locate(error, batch->source, batch->line, 0);
    }
    return true;
}

static bool batch_begin(struct batch *batch, enum batch_format format, struct error *error)
{
    struct text line;
    batch->format = format;
    batch->separator = format == BATCH_TSV ? '\t' : ',';
    /* a BOM may stand before everything, comments too */
    error->code = ERROR_NONE;
    while (batch->end - batch->at < 3 && !batch->at_end) {
        if (!batch_refill(batch, error) && error->code != ERROR_NONE) {
            return false;
        }
    }
    if (batch->end - batch->at >= 3 && memcmp(batch->at, "\xef\xbb\xbf", 3) == 0) {
        batch->at += 3;
    }
    if (!batch_next_row(batch, &line, error)) {
        if (error->code != ERROR_NONE) {
            return false;
        }
        fail(error, ERROR_DATA, "the file is empty: expected a line of column names");
        return error_locate(error, batch->source, 0, 0);
    }
    batch->header_line = batch->line;
    set_format(batch, format, line);
    if (batch->format != BATCH_JSONL) {
        return read_header(batch, line, error);
    }
    if (text_trim(line).start[0] == '[' && !open_array(batch, &line, error)) {
        return false;
    }
    if (!batch_json_header(batch, line, error)) {
        return false;
    }
    /* the first object is a row too */
    batch->at = line.start;
    batch->next_line = batch->line;
    return true;
}

bool batch_open(struct batch *batch, const char *path, enum batch_format format,
                struct error *error)
{
    const bool is_piped = strcmp(path, "-") == 0;
    batch->source = is_piped ? "standard input" : path;
    batch->descriptor = STDIN_FILENO;
    batch->capacity = BLOCK;
    batch->next_line = 1;
    if (!is_piped) {
        batch->descriptor = open(path, O_RDONLY | O_CLOEXEC);
        if (batch->descriptor < 0) {
            return fail(error, ERROR_IO, "cannot read %s: %s", path, strerror(errno));
        }
    }
    batch->buffer = malloc(BLOCK + BEHIND);
    if (batch->buffer == NULL) {
        return fail(error, ERROR_IO, "out of memory reading %s", path);
    }
    batch->at = batch->end = batch->buffer;
    return batch_begin(batch, format, error);
}

bool batch_settle(struct batch *batch, const struct sheet *sheet, bool hands_late,
                  struct error *error)
{
    batch->sheet = sheet;
    batch->hands_late = hands_late;
    if (!batch_settle_columns(batch, error)) {
        return false;
    }
    if (batch->format != BATCH_JSONL && batch->photographs == NULL) {
        prepare_plain(batch);
    }
    return true;
}

bool batch_is_file(const struct batch *batch, int descriptor)
{
    struct stat read, written;
    return fstat(batch->descriptor, &read) == 0 && fstat(descriptor, &written) == 0 &&
           S_ISREG(read.st_mode) && read.st_dev == written.st_dev && read.st_ino == written.st_ino;
}

double batch_share(const struct batch *batch)
{
    struct stat file;
    if (batch->photographs != NULL) {
        return photographs_share(batch);
    }
    off_t at = lseek(batch->descriptor, 0, SEEK_CUR);
    if (at < 0 || fstat(batch->descriptor, &file) != 0 || !S_ISREG(file.st_mode) ||
        file.st_size == 0) {
        return NAN;
    }
    return (double)(at - (batch->end - batch->at)) / (double)file.st_size;
}

void batch_close(struct batch *batch)
{
    free(batch->buffer);
    if (batch->descriptor > STDIN_FILENO) {
        close(batch->descriptor);
    }
}
