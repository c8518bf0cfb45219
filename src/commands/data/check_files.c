/* commands/data/check_files.c - lenscalc convert --check: what becomes of lens files. */
/* SPDX-License-Identifier: MIT */
#include "commands/data/check_files.h"
#include "commands/tables.h"

#include "base/parallel.h"
#include "cli/question/command.h"
#include "data/folder.h"
#include "data/whole_file.h"
#include "exchange/lens_formats.h"
#include "file/lens_glass.h"
#include "optics/first_order.h"

#include <math.h>
#include <string.h>

enum { FILES_A_PIECE = 4 };

struct check_files_input {
    bool check;
    const char *files; /* separated by OPTION_MANY_SEPARATOR */
    long threads;
};

struct check_files_row {
    const char *file, *format, *status, *reasons;
    double efl;
    long surfaces, losses;
};

#define INPUT struct check_files_input

static const struct option options[] = {
    {ASKED(check), .name = "check",
     .help = "only report whether each file can be read, and with what losses; one row per file"},
    {ASKED(files), .name = "files", .value = "FILE", .flags = OPTION_OPERAND | OPTION_TOGETHER,
     .help = "with --check: files, and folders with their contents"},
    {ASKED(threads), .name = "threads", .lowest = 0, .highest = PARALLEL_MOST, .value = "N",
     .fallback = "0", .help = "with --check: threads to work with; 0 = one per core"},
};

#define ROW struct check_files_row

static const struct column columns[] = {
    {SHOWN(file), .name = "file", BRIEF, .help = "its name"},
    {SHOWN(format), .name = "format", .help = "kind of file, by its content or its ending"},
    {SHOWN(status), .name = "status", BRIEF,
     .help = "read, losses (read with --lossy only), refused"},
    {LENGTH(efl, "mm"), .name = "efl", BRIEF, .label = "focal length",
     .help = "at the primary wavelength, in the first position; without what is lost"},
    {SHOWN(surfaces), .name = "surfaces", BRIEF, .help = "number of surfaces, the stop counted"},
    {SHOWN(losses), .name = "losses", .help = "number of losses"},
    {SHOWN(reasons), .name = "reasons", BRIEF,
     .help = "what is lost, with its lines, by what it changes; or why the file is refused"},
};

/* -------- the files -------- */

/* A file, or a folder that cannot be read. */
struct check_item {
    const char *path;
    const char *problem; /* why it cannot be read; null: that is still to be seen */
    bool is_named;       /* by the user: a pipe, too, is read */
};

/* In the order in which they are to be reported. */
struct check_list {
    struct arena *arena;
    struct check_item *items;
    size_t count, room;
};

static void check_list_append(struct check_list *list, struct check_item item)
{
    list->items =
        arena_grow(list->arena, list->items, list->count, &list->room, sizeof list->items[0]);
    list->items[list->count++] = item;
}

/* A folder and those below; as deep as a path can be. */
static void add_folder(struct check_list *list, const char *path, struct name_table *seen)
{
    struct folder_entry *entries;
    size_t count;
    struct error error;
    if (!folder_read(path, seen, list->arena, &entries, &count, &error)) {
        const char *problem = arena_printf(list->arena, "%s", error.message);
        check_list_append(list, (struct check_item){.path = path, .problem = problem});
        return;
    }
    for (size_t i = 0; i < count; i++) {
        const struct folder_entry *entry = &entries[i];
        if (entry->kind == FOLDER_FOLDER) {
            add_folder(list, entry->path, seen);
        } else if (foreign_ends_as_lens(text_of(entry->path))) {
            check_list_append(list, (struct check_item){.path = entry->path});
        }
    }
}

/* -------- each of them -------- */

/* What all threads share, each with a database of its own. */
struct file_check {
    const struct lensdb *db;
    struct watch *watch;
    struct lensdb *of_thread[PARALLEL_MOST];
    const struct check_list *files;
    struct check_files_row *rows;
};

static const char *kept_string(struct arena *arena, const char *text)
{
    return arena_string(arena, text, strlen(text));
}

/* The lens of a file; its row says what became of it. Texts of the row are in `scratch`. */
static void check_files_judge(struct foreign_job *job, struct text content,
                              struct check_files_row *row)
{
    struct arena *scratch = job->arena;
    struct lens lens;
    struct lens_warnings warnings;
    struct first_order first;
    struct error error = {0};
    struct text_buffer reasons = {.arena = scratch};
    row->status = "refused";
    bool done =
        foreign_read(job, content, &lens, &error) && lens_check(&lens, scratch, &warnings, &error);
    bool lacks = false; /* something without which there is no lens: that is in the list */
    for (size_t i = 0; i < job->loss_count; i++) {
        lacks = lacks || job->losses[i].effect == LOSS_OF_LENS;
    }
    if (!done && !lacks) {
        row->reasons = error.line > 0 ? arena_printf(scratch, "%ld: %s", error.line, error.message)
                                      : kept_string(scratch, error.message);
        return;
    }
    foreign_summary(job, &reasons);
    if (done && lens.cut_short != NULL) {
        growing_format(&reasons, "%s%s", reasons.length > 0 ? "; " : "", lens.cut_short);
    }
    row->reasons = reasons.length > 0 ? arena_string(scratch, reasons.data, reasons.length) : NULL;
    if (!done) {
        return;
    }
    row->status = job->loss_count > 0 ? "losses" : "read";
    row->surfaces = (long)lens.surface_count;
    row->losses = (long)job->loss_count;
    if (first_order_of_lens(lens_at_position(&lens, 0, scratch), lens_primary_wavelength(&lens),
                            SECTION_Y, scratch, &first, &error) &&
        !first.is_afocal) {
        row->efl = first.efl;
    }
}

static void check_file(struct lensdb *db, const struct check_item *item, struct arena *kept,
                       struct check_files_row *row)
{
    struct arena scratch = {0};
    struct lens_glasses place = {db, &scratch};
    const struct glass_source glasses = lens_glass_source(&place);
    struct foreign_job job = {.source = row->file,
                              .arena = &scratch,
                              .glasses = &glasses,
                              .reads_beside = true,
                              .lossy = true,
                              .glass_numbers = db->glass_numbers};
    struct text content;
    struct error error = {0};
    const bool has =
        item->problem == NULL &&
        (item->is_named ? whole_file(row->file, &scratch, &content, &error)
                        : regular_file(row->file, WHOLE_FILE_MOST, &scratch, &content, &error));
    if (has) {
        row->format = foreign_format_name(row->file, content, &scratch);
        check_files_judge(&job, content, row);
    } else {
        row->status = "refused";
        if (item->problem != NULL) {
            row->reasons = item->problem;
        } else if (error.code != ERROR_NONE) {
            row->reasons = error.message;
        } else {
            row->reasons = "there is no such file";
        }
    }
    row->reasons = row->reasons != NULL ? kept_string(kept, row->reasons) : NULL;
    row->format = row->format != NULL ? kept_string(kept, row->format) : NULL;
    arena_free(&scratch);
}

static void check_piece(void *context, const struct parallel_piece *piece)
{
    struct file_check *checking = context;
    /* A thread reads its glass catalogues once. */
    struct lensdb **database = &checking->of_thread[piece->thread];
    if (*database == NULL) {
        *database = ARENA_NEW(piece->arena, struct lensdb);
        **database = (struct lensdb){.arena = piece->arena,
                                     .agf = checking->db->agf,
                                     .directory = checking->db->directory,
                                     .lossy = true,
                                     .glass_numbers = checking->db->glass_numbers};
    }
    struct lensdb *db = *database;
    for (size_t i = piece->begin; i < piece->end && !watch_is_ended(checking->watch); i++) {
        struct check_files_row *row = &checking->rows[i];
        *row = (struct check_files_row){.file = checking->files->items[i].path,
                                        .efl = NAN,
                                        .surfaces = NO_INTEGER,
                                        .losses = NO_INTEGER};
        check_file(db, &checking->files->items[i], piece->arena, row);
        watch_add(checking->watch, 1);
    }
}

static bool check_files_run(const void *data, struct run *run, struct error *error)
{
    const struct check_files_input *input = data;
    struct check_list files = {.arena = run->arena};
    size_t refused = 0;
    if (input->files == NULL) {
        return fail(error, ERROR_USAGE, "which files? Give their names, or folders");
    }
    for (struct text rest = text_of(input->files); rest.start != NULL;) {
        /*
         * Add a file, or of a folder all files, also in folders below, whose names end as those of
         * lens files do; in the order of their names. A folder to which several paths lead is read
         * once.
         */
        struct text path = text_cut(&rest, OPTION_MANY_SEPARATOR);
        const char *name = arena_string(files.arena, path.start, path.length);
        struct name_table seen = {0};
        if (folder_exists(name)) {
            add_folder(&files, name, &seen);
        } else {
            check_list_append(&files, (struct check_item){.path = name, .is_named = true});
        }
    }
    struct parallel *parallel = ARENA_NEW(run->arena, struct parallel);
    struct file_check *checking = ARENA_NEW(run->arena, struct file_check);
    *checking = (struct file_check){
        .db = run->db,
        .watch = run->watch,
        .files = &files,
        .rows = ARENA_ARRAY(run->arena, files.count + 1, struct check_files_row)};
    parallel->threads = parallel_threads(input->threads);
    watch_begin(run->watch, "files", files.count);
    parallel_pieces(parallel, files.count, FILES_A_PIECE, check_piece, checking);
    for (size_t i = 0;
         i < files.count && checking->rows[i].file != NULL && run_emit(run, &checking->rows[i]);
         i++) {
        refused += checking->rows[i].surfaces == NO_INTEGER ? 1 : 0;
    }
    if (refused > 0) {
        fail(&run->shortfall, ERROR_DOMAIN, "refused: %zu of %zu files", refused, files.count);
    }
    parallel_free(parallel);
    return files.count > 0 || fail(error, ERROR_DOMAIN, "there is no lens file in the folder");
}

static const struct example examples[] = {
    {"convert --check objectives/", "which lens files of a folder can be read, and what is lost"},
    {"convert --check a.zmx b.seq --csv", "one row a file, for a spreadsheet"},
    {NULL, NULL},
};

const struct command command_convert_check = {
    .name = "convert",
    .group = "data",
    .summary = "report for each file whether it can be read",
    COMMAND_ASKS(struct check_files_input),
    .sheet = SHEET(columns, struct check_files_row),
    .makes_many = command_always_many,
    .reads = READS_LENSDB | READS_GLASSES,
    .run = check_files_run,
};
