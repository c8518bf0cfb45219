/* cli/batch/photographs.c - photographs as rows of a batch. */
/* SPDX-License-Identifier: MIT */
#include "cli/batch/photographs.h"

#include "cli/batch/photograph_sensor.h"
#include "cli/child.h"
#include "cli/question/operands.h"
#include "exchange/metadata/exiftool.h"
#include "exchange/metadata/photo_file.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* So much is handed to one exiftool: any system takes that many words. */
enum { FILES_TOGETHER = 400, LETTERS_TOGETHER = 65536 };

/* Seconds that it may take to start, and for each file; and what it may print of each, bytes. */
static const double PATIENCE_START = 10, PATIENCE_FILE = 1;
enum { PRINTED_MOST = 16384 };

/* A photograph, and what a row takes of it. */
struct photograph_row {
    const char *path;
    const struct error *failure; /* why nothing is known of it; null: something is */
    struct metadata metadata;
    struct sensor_value sensor;         /* its name is null: none */
    const struct error *sensor_failure; /* why none; null: there is one, or nobody asks */
};

struct photographs {
    struct photograph_row *rows;
    size_t count, next;
    bool has_exiftool;
};

static const struct error *failure_keep(const struct error *failure, struct arena *arena)
{
    return arena_copy(arena, failure, 1, 0, sizeof *failure);
}

static bool row_refuse(struct photograph_row *row, enum error_code code, const char *why,
                       struct arena *arena)
{
    struct error failure;
    fail(&failure, code, "%s", why);
    row->failure = failure_keep(&failure, arena);
    return false;
}

/* -------- reading -------- */

/* Is it there, and a regular file? What is not is not asked of another program. */
static bool row_can_be_read(struct photograph_row *row, struct arena *arena)
{
    struct stat file;
    const int descriptor = open(row->path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0) {
        return row_refuse(row, ERROR_IO, arena_printf(arena, "cannot read it: %s", strerror(errno)),
                          arena);
    }
    const bool is_regular = fstat(descriptor, &file) == 0 && S_ISREG(file.st_mode);
    close(descriptor);
    return is_regular || row_refuse(row, ERROR_IO, "this is no regular file", arena);
}

/* Without exiftool. */
static void row_read_plain(struct photograph_row *row, struct arena *arena)
{
    struct error error;
    const char *ending = photo_ending(text_of(row->path));
    if (!photo_is_plain(ending)) {
        row_refuse(row, ERROR_DATA,
                   arena_printf(arena,
                                "%s files are read with exiftool, which is not installed "
                                "(Debian: libimage-exiftool-perl)",
                                ending),
                   arena);
    } else if (!photo_file_read(row->path, &row->metadata, &error)) {
        row->failure = failure_keep(&error, arena);
    }
}

/* Why exiftool has nothing to say of a file. */
static const char *exiftool_failure(const struct child_end *end, double seconds,
                                    struct arena *arena)
{
    if (end->is_late) {
        return arena_printf(arena, "exiftool was ended after %g s without an answer", seconds);
    }
    if (end->is_long) {
        return "exiftool was ended, as it printed too much";
    }
    const int shown = text_shown_up_to(end->said, 200);
    return arena_printf(arena, "exiftool does not read it (%s)%s%.*s", child_status(end, arena),
                        shown > 0 ? ": " : "", shown, end->said.start);
}

/* Ask exiftool about some files, which all can be read. */
static bool exiftool_ask(struct photographs *photographs, struct photograph_row *const *rows,
                         size_t count, struct arena *arena, struct error *error)
{
    size_t options = 0;
    while (exiftool_words[options] != NULL) {
        options++;
    }
    char **words = ARENA_ARRAY(arena, options + count + 1, char *);
    struct exiftool_file *files = ARENA_ARRAY(arena, count, struct exiftool_file);
    for (size_t i = 0; i < options; i++) {
        words[i] = (char *)exiftool_words[i];
    }
    for (size_t i = 0; i < count; i++) {
        files[i].path = words[options + i] = (char *)rows[i]->path;
    }
    const struct child child = {.words = words,
                                .is_read = true,
                                .seconds = PATIENCE_START + PATIENCE_FILE * (double)count,
                                .most = PRINTED_MOST * (count + 1)};
    struct child_end end;
    if (!child_run(&child, &end, arena, error)) {
        return false;
    }
    photographs->has_exiftool = !end.is_missing;
    if (end.is_missing) {
        return true;
    }
    exiftool_take(end.output, files, count, arena);
    for (size_t i = 0; i < count; i++) {
        rows[i]->metadata = files[i].metadata;
        if (!files[i].is_answered) {
            row_refuse(rows[i], ERROR_IO, exiftool_failure(&end, child.seconds, arena), arena);
        }
    }
    return true;
}

static bool photographs_read(struct photographs *photographs, struct arena *arena,
                             struct error *error)
{
    struct photograph_row *together[FILES_TOGETHER];
    photographs->has_exiftool = true;
    for (size_t i = 0; i < photographs->count && photographs->has_exiftool;) {
        size_t count = 0, letters = 0;
        for (; i < photographs->count && count < FILES_TOGETHER && letters < LETTERS_TOGETHER;
             i++) {
            struct photograph_row *row = &photographs->rows[i];
            if (row_can_be_read(row, arena)) {
                together[count++] = row;
                letters += strlen(row->path);
            }
        }
        if (count > 0 && !exiftool_ask(photographs, together, count, arena, error)) {
            return false;
        }
    }
    for (size_t i = 0; i < photographs->count; i++) {
        struct photograph_row *row = &photographs->rows[i];
        if (!photographs->has_exiftool && row_can_be_read(row, arena)) {
            row_read_plain(row, arena);
        }
        if (row->failure == NULL && metadata_is_empty(&row->metadata)) {
            row_refuse(row, ERROR_DATA, "nothing in it says how it was taken", arena);
        }
    }
    return true;
}

/* -------- what tags say, as an option of theirs is written -------- */

static const char *number_words(double number, const char *unit, struct arena *arena)
{
    char digits[NUMBER_LENGTH + 1];
    if (isnan(number)) {
        return NULL;
    }
    *number_write_shortest(digits, number) = '\0';
    return ARENA_JOIN(arena, digits, isinf(number) ? "" : unit);
}

static const char *focal_words(const struct metadata *metadata, struct arena *arena)
{
    return isnan(metadata->focal) ? number_words(metadata->equivalent, "mm-eq", arena)
                                  : number_words(metadata->focal, "mm", arena);
}

static const char *fnumber_words(const struct metadata *metadata, struct arena *arena)
{
    return number_words(metadata->fnumber, "", arena);
}

/* As dials have them: 1/60, which exiftool prints with ten digits. */
static const char *time_words(const struct metadata *metadata, struct arena *arena)
{
    static const double longest = 0.3, same = 1e-8;
    const double parts = 1 / metadata->time;
    if (metadata->time < longest && fabs(parts - round(parts)) < same * parts) {
        return arena_printf(arena, "1/%.0fs", parts);
    }
    return number_words(metadata->time, "s", arena);
}

static const char *iso_words(const struct metadata *metadata, struct arena *arena)
{
    return number_words(metadata->iso, "", arena);
}

static const char *distance_words(const struct metadata *metadata, struct arena *arena)
{
    return number_words(metadata->distance, "mm", arena);
}

static const struct photograph_tag {
    const char *name;  /* of the column, which batch_names.c knows */
    const char *words; /* for messages: what the option takes from it */
    const char *option;
    const char *(*of)(const struct metadata *metadata, struct arena *arena);
} tags[] = {
    {"FocalLength", "focal length", "focal-length", focal_words},
    {"FNumber", "f-number", "aperture", fnumber_words},
    {"ExposureTime", "exposure time", "time", time_words},
    {"ISO", "ISO speed", "iso", iso_words},
    {"SubjectDistance", "distance", "distance", distance_words},
    {"Model", "camera", "sensor", NULL},
};

/* The value of a tag in words; null: the row has none. */
static const char *row_words(const struct photograph_row *row, const struct photograph_tag *tag,
                             struct arena *arena)
{
    if (row->failure != NULL) {
        return NULL;
    }
    return tag->of != NULL ? tag->of(&row->metadata, arena) : row->sensor.name;
}

static const struct option *option_named(const struct batch *batch, const char *name)
{
    const struct argument *argument = arguments_find(batch->arguments, text_of(name));
    return argument != NULL && argument->is_input ? argument->option : NULL;
}

/* Did the user say so of these photographs, and not of all questions? */
static bool is_asked(const struct batch *batch, const char *name)
{
    const struct argument *argument = arguments_find(batch->arguments, text_of(name));
    return argument->is_given && argument_rank(argument) >= RANK_KIT;
}

/* -------- sensors -------- */

/*
 * Must a row have a sensor, as it would silently have the usual one else? Not where one is named,
 * or the circle of confusion that it is for.
 */
static bool sensor_is_needed(const struct batch *batch, const struct option *sensor)
{
    const struct option *coc = option_named(batch, "coc");
    const struct coc_value *value =
        coc != NULL ? (const void *)((const char *)batch->constants + coc->offset) : NULL;
    const bool has_circle = value != NULL && value->coc.kind == COC_LENGTH && !value->is_fallback &&
                            arguments_given(batch->arguments, "coc");
    return sensor->fallback != NULL && !is_asked(batch, sensor->name) && !has_circle;
}

/* Many photographs are of one camera, which is looked for once. */
static bool is_like(const struct metadata *a, const struct metadata *b)
{
    return strcmp(a->make, b->make) == 0 && strcmp(a->model, b->model) == 0 &&
           memcmp(&a->focal, &b->focal, sizeof a->focal) == 0 &&
           memcmp(&a->equivalent, &b->equivalent, sizeof a->equivalent) == 0 &&
           memcmp(&a->long_side, &b->long_side, sizeof a->long_side) == 0 &&
           memcmp(&a->low_side, &b->low_side, sizeof a->low_side) == 0;
}

static bool photographs_find_sensors(struct photographs *photographs, const struct batch *batch,
                                     struct error *error)
{
    const struct option *option = option_named(batch, "sensor");
    struct reader reader = *batch->reader;
    const struct photograph_row *last = NULL;
    reader.arena = batch->arena;
    for (size_t i = 0; i < photographs->count && option != NULL; i++) {
        struct photograph_row *row = &photographs->rows[i];
        if (row->failure != NULL) {
            continue;
        }
        if (last != NULL && is_like(&last->metadata, &row->metadata)) {
            row->sensor = last->sensor;
            row->sensor_failure = last->sensor_failure;
        } else if (!photograph_sensor(&reader, &row->metadata, &row->sensor, reader.doubts,
                                      error)) {
            if (error->code != ERROR_USAGE) {
                return false;
            }
            row->sensor = (struct sensor_value){.name = NULL};
            row->sensor_failure =
                sensor_is_needed(batch, option) ? failure_keep(error, batch->arena) : NULL;
        }
        last = row;
    }
    return true;
}

/* -------- the batch -------- */

static bool add_tag(struct batch *batch, const struct photograph_tag *tag, struct error *error)
{
    const struct photographs *photographs = batch->photographs;
    size_t good = 0, filled = 0;
    for (size_t i = 0; i < photographs->count; i++) {
        const struct photograph_row *row = &photographs->rows[i];
        good += row->failure == NULL;
        filled += row_words(row, tag, batch->arena) != NULL;
    }
    if (option_named(batch, tag->option) == NULL || filled == 0) {
        return true;
    }
    if (filled == good && is_asked(batch, tag->option)) {
        warnings_add(batch->reader->doubts, "--%s says nothing here: %s its own %s", tag->option,
                     good == 1 ? "the photograph has" : "each photograph has", tag->words);
    }
    if (!batch_add_column(batch, text_of(tag->name), 0, error)) {
        return false;
    }
    batch->columns[batch->column_count - 1].as_read.called =
        ARENA_JOIN(batch->arena, "tag '", tag->name, "'");
    return true;
}

bool photographs_find(const struct arguments *arguments, const struct common *common,
                      struct paths *paths, struct arena *arena, struct error *error)
{
    const char *file = common->batch;
    const bool is_one = file != NULL && operand_is_photograph(arguments->command, text_of(file));
    *paths = (struct paths){NULL, 0};
    if (!is_one && arguments->photograph_count == 0) {
        return true;
    }
    paths->all = ARENA_ARRAY(arena, arguments->photograph_count + 1, const char *);
    if (is_one) {
        paths->all[paths->count++] = file;
    }
    for (size_t i = 0; i < arguments->photograph_count; i++) {
        paths->all[paths->count++] = arguments->photographs[i];
    }
    if (file != NULL && !is_one) {
        return fail(error, ERROR_USAGE, "--batch %s and photographs (%s) exclude each other", file,
                    paths->all[0]);
    }
    return common->batch_format == BATCH_AUTO ||
           fail(error, ERROR_USAGE, "--batch-format is of tables, not of photographs (%s)",
                paths->all[0]);
}

bool photographs_open(struct batch *batch, const struct paths *paths, struct error *error)
{
    const size_t count = paths->count;
    struct photographs *photographs = ARENA_NEW(batch->arena, struct photographs);
    photographs->rows = ARENA_ARRAY(batch->arena, count, struct photograph_row);
    photographs->count = count;
    batch->photographs = photographs;
    batch->source = paths->all[0];
    batch->descriptor = -1;
    batch->format = BATCH_CSV;
    batch->separator = ',';
    for (size_t i = 0; i < count; i++) {
        photographs->rows[i].path = paths->all[i];
        metadata_clear(&photographs->rows[i].metadata);
    }
    if (!photographs_read(photographs, batch->arena, error) ||
        !photographs_find_sensors(photographs, batch, error) ||
        !batch_add_column(batch, text_of("SourceFile"), 0, error)) {
        return false;
    }
    for (size_t i = 0; i < sizeof tags / sizeof tags[0]; i++) {
        if (!add_tag(batch, &tags[i], error)) {
            return false;
        }
    }
    return true;
}

static const struct photograph_tag *tag_of(const struct batch_column *column)
{
    size_t i = 0;
    while (!text_equal(column->name, tags[i].name)) {
        i++;
    }
    return &tags[i];
}

static bool row_take(struct batch *batch, const struct photograph_row *row, void *input,
                     struct error *error)
{
    for (size_t i = 1; i < batch->column_count; i++) {
        struct batch_column *column = &batch->columns[i];
        const struct photograph_tag *tag = tag_of(column);
        const char *words = row_words(row, tag, batch->reader->arena);
        if (words == NULL || column->is_ignored) {
            batch_reset_member(batch, column->option, input);
        } else if (tag->of == NULL) {
            *(struct sensor_value *)(void *)((char *)input + column->option->offset) = row->sensor;
        } else if (!batch_read_cell(batch, column, text_of(words), input, error)) {
            return false;
        }
    }
    return true;
}

enum batch_result photographs_next(struct batch *batch, void *input, struct error *error)
{
    struct photographs *photographs = batch->photographs;
    if (batch->before_read != NULL && !batch->before_read(batch->waiting, error)) {
        return BATCH_FAILED;
    }
    if (photographs->next == photographs->count) {
        return BATCH_END;
    }
    const struct photograph_row *row = &photographs->rows[photographs->next++];
    batch->source = row->path;
    batch->line = 0;
    batch->rows++;
    batch->passed[0] = (struct passed_cell){.text = text_of(row->path)};
    bool done = row_take(batch, row, input, error);
    if (row->failure != NULL) {
        *error = *row->failure;
        done = false;
    } else if (done && row->sensor_failure != NULL) {
        *error = *row->sensor_failure;
        done = false;
    }
    if (!done) {
        error_locate(error, row->path, 0, 0);
    }
    return done ? BATCH_ROW : BATCH_BAD_ROW;
}

bool photographs_any(const struct batch *batch)
{
    bool any = false;
    for (size_t i = 0; i < batch->photographs->count && !any; i++) {
        any = batch->photographs->rows[i].failure == NULL;
    }
    return any;
}

double photographs_share(const struct batch *batch)
{
    return (double)batch->photographs->next / (double)batch->photographs->count;
}

const char *photographs_lack(const struct batch *batch)
{
    return batch->photographs->has_exiftool
               ? NULL
               : "exiftool, which reads makers' notes with the distance, is not installed";
}
