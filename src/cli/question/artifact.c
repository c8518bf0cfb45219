/* cli/question/artifact.c - drawings, lens files, texts: what a command makes besides rows. */
/* SPDX-License-Identifier: MIT */
#include "cli/question/artifact.h"

#include "base/name_table.h"
#include "cli/question/arguments.h"
#include "cli/question/inputs.h"
#include "cli/question/showing.h"
#include "cli/question/sweep.h"
#include "optics/growing.h"
#include "report/place.h"
#include "report/terminal.h"

#include <string.h>
#include <unistd.h>

enum { MOST_INPUTS = 100 };

static const struct file_type svg_type = {{"svg", "drawing"}, ".svg"};

const struct file_type *drawing_types(size_t i)
{
    return i == 0 ? &svg_type : NULL;
}

bool drawing_write(const struct artifact_job *job, const struct svg *drawing, struct output *sink,
                   struct error *error)
{
    const struct svg dressed = svg_dress(drawing, &job->dress);
    (void)error;
    output_text(sink, dressed.data, dressed.length);
    return true;
}

/* Endings that tell everyone what is in a file: nothing else goes into it. */
static const char *const known_endings[] = {".svg", ".png", ".pfm",  ".jpg",  ".jpeg", ".pdf",
                                            ".hdr", ".exr", ".tif",  ".tiff", ".gif",  ".eps",
                                            ".csv", ".tsv", ".json", ".html", ".part", ".lens",
                                            ".zmx", ".seq", ".len",  ".agf",  NULL};

/* The endings of what can be written, drawings also in the forms that they are converted to. */
static const char *job_endings(file_types *types, bool is_drawing, struct arena *arena)
{
    if (!is_drawing) {
        return file_type_endings(types, arena);
    }
    const char *all = "";
    for (size_t i = 0; types(i) != NULL; i++) {
        all = arena_printf(arena, "%s%s, ", all, types(i)->ending);
    }
    return arena_printf(arena, "%s.png or .pdf", all);
}

static bool ending_is_known(struct text path)
{
    size_t i = 0;
    while (known_endings[i] != NULL && !file_type_ends(path, known_endings[i])) {
        i++;
    }
    return known_endings[i] != NULL;
}

/* A pipe, a device, something that is open: its name does not say what goes into it. */
static bool job_is_stream(const struct artifact_job *job, struct arena *arena)
{
    return access(job->path, F_OK) == 0 && !place_is_file(job->path, arena);
}

/*
 * Where only one thing can be written any name will do that is not the name of something else; of
 * a drawing, which may have one of three endings, only a name without any, as ./term.
 */
static bool job_takes_any_name(const struct artifact_job *job, bool is_drawing, struct arena *arena)
{
    const char *slash = strrchr(job->path, '/');
    const bool has_ending = strchr(slash != NULL ? slash : job->path, '.') != NULL;
    return job->artifact->option.types(1) == NULL && !ending_is_known(text_of(job->path)) &&
           (!is_drawing || !has_ending || job_is_stream(job, arena));
}

/* What the file shall hold: what the input asks for, else what its name says. */
static bool job_choose_type(struct artifact_job *job, struct arena *arena, struct error *error)
{
    const struct artifact *artifact = job->artifact;
    file_types *types = artifact->option.types;
    job->type = artifact->choose != NULL ? artifact->choose(job->inputs[0]) : NULL;
    if (types == NULL || job->type != NULL) {
        return true;
    }
    const struct file_type *drawing = file_type_of(types, text_of("x.svg"));
    if (job->form == ARTIFACT_SHOWN) {
        job->type = drawing != NULL ? drawing : file_type_of(types, text_of("x.png"));
        return true;
    }
    bool nameless = place_is_standard(job->path, arena);
    struct text path = text_of(nameless ? "" : job->path);
    job->type = file_type_of(types, path);
    if (job->type == NULL && drawing != NULL &&
        (file_type_ends(path, ".png") || file_type_ends(path, ".pdf"))) {
        job->type = drawing;
        job->form = file_type_ends(path, ".png") ? ARTIFACT_AS_PNG : ARTIFACT_AS_PDF;
        return showing_check_converter(job, arena, error);
    }
    if (job->type == NULL && (nameless || job_takes_any_name(job, drawing != NULL, arena))) {
        job->type = types(0);
    }
    if (job->type != NULL) {
        return true;
    }
    fail(error, ERROR_USAGE, "--%s '%s': the name must end in %s", artifact->option.name, job->path,
         job_endings(types, drawing != NULL, arena));
    return artifact->chooser != NULL &&
           error_hint(error, "or choose the format with --%s", artifact->chooser);
}

/* "term" is the terminal, where drawings and pictures can be shown. */
static bool job_find_form(struct artifact_job *job, const struct artifact_setting *setting,
                          struct error *error)
{
    if (job->path == NULL || strcmp(job->path, "term") != 0 ||
        !showing_is_possible(job->artifact->option.types)) {
        return true;
    }
    job->form = ARTIFACT_SHOWN;
    job->path = NULL;
    if (setting->command->run == NULL || setting->is_text ||
        !place_is_standard(setting->common->output, setting->arena)) {
        return true;
    }
    fail(error, ERROR_USAGE,
         "--%s term draws below a table for reading, not among rows for programs",
         job->artifact->option.name);
    return error_hint(error, "--output FILE writes the rows elsewhere; ./term is a file");
}

static bool check_scope(const struct artifact_job *job, const struct artifact_setting *setting,
                        struct error *error)
{
    const char *name = job->artifact->option.name;
    size_t total = setting->sweep->total;
    bool several = setting->is_batch || total > 1;
    if (job->artifact->scope == ARTIFACT_OF_ROWS) {
        return true;
    }
    if (job->artifact->scope == ARTIFACT_OF_EACH) {
        if (total > MOST_INPUTS) {
            return fail(error, ERROR_USAGE, "--%s would be %zu files: at most %d", name, total,
                        MOST_INPUTS);
        }
        return true;
    }
    if (job->artifact->scope == ARTIFACT_OF_SWEEP) {
        if (setting->is_batch) {
            return fail(error, ERROR_USAGE, "--%s works with swept options, not with --batch",
                        name);
        }
        return total <= MOST_INPUTS ||
               fail(error, ERROR_USAGE, "--%s would draw %zu questions: at most %d", name, total,
                    MOST_INPUTS);
    }
    if (several) {
        return fail(error, ERROR_USAGE, "--%s draws a single answer: no lists, ranges or --batch",
                    name);
    }
    return job->artifact->scope != ARTIFACT_OF_ROW || !setting->many ||
           fail(error, ERROR_USAGE, "--%s draws a single row, but this answer has several", name);
}

const char *artifact_path(const char *path, size_t files, size_t number, struct arena *arena)
{
    if (files == 1) {
        return path;
    }
    const char *slash = strrchr(path, '/'), *dot = strrchr(path, '.');
    const bool has_ending = dot != NULL && (slash == NULL || dot > slash);
    const char *ending = has_ending ? dot : path + strlen(path);
    const int digits = 1 + (files > 9) + (files > 99);
    return arena_printf(arena, "%.*s-%0*zu%s", (int)(ending - path), path, digits, number + 1,
                        ending);
}

static const char *numbered(const struct artifact_job *job, size_t number, struct arena *arena)
{
    return artifact_path(job->path, job->files, number, arena);
}

/* An artifact that writes this file already; null: none does. */
static const char *other_writer(const struct artifacts *artifacts,
                                const struct artifact_setting *setting, const char *path)
{
    const char *rows = setting->common->output;
    if (setting->command->run != NULL &&
        place_is_same(rows != NULL ? rows : "-", path, setting->arena)) {
        return "output";
    }
    for (size_t i = 0; i < artifacts->count; i++) {
        const struct artifact_job *job = &artifacts->jobs[i];
        for (size_t k = 0; k < job->files && job->path != NULL; k++) {
            if (place_is_same(numbered(job, k, setting->arena), path, setting->arena)) {
                return job->artifact->option.name;
            }
        }
    }
    return NULL;
}

/* A file that is there already, or is read, and two artifacts in one file. */
static bool job_check_place(const struct artifacts *artifacts, const struct artifact_job *job,
                            const struct artifact_setting *setting, struct error *error)
{
    for (size_t i = 0; i < job->files && job->path != NULL; i++) {
        const char *path = numbered(job, i, setting->arena);
        if (job->artifact->is_kept && !setting->common->force &&
            place_is_file(path, setting->arena)) {
            return fail(error, ERROR_IO, "%s already exists: --force overwrites it", path);
        }
        if (!inputs_spare(setting->arguments, setting->run->db, setting->common->force, path,
                          setting->arena, error)) {
            return false;
        }
        const char *other = other_writer(artifacts, setting, path);
        if (other != NULL) {
            return fail(error, ERROR_USAGE, "--%s and --%s write the same file %s", other,
                        job->artifact->option.name, path);
        }
    }
    return true;
}

/* The inputs of a sweep, one after the other; the input itself where there is only one. */
static const void *const *inputs_of(const struct artifact_setting *setting, size_t count,
                                    struct error *error)
{
    size_t size = setting->command->input_size;
    const void **inputs = ARENA_ARRAY(setting->arena, count, const void *);
    for (size_t i = 0; i < count && count > 1; i++) {
        void *copy = arena_array(setting->arena, 1, size);
        if (!sweep_recall(setting->sweep, i, setting->input, error)) {
            return NULL;
        }
        inputs[i] = memcpy(copy, setting->input, size);
    }
    inputs[0] = count > 1 ? inputs[0] : setting->input;
    return inputs;
}

/* Bytes go to files and pipes. */
static bool check_bytes(const struct artifact_job *job, struct arena *arena, struct error *error)
{
    const char *name = job->artifact->option.name;
    if (!place_is_standard(job->path, arena) || !isatty(STDOUT_FILENO)) {
        return true;
    }
    fail(error, ERROR_USAGE, "a terminal shows no such files");
    return error_hint(error, "--%s FILE writes one, --%s term draws it here", name, name);
}

/* One, or one for each input, or as many as one answer is. */
static size_t job_count_files(const struct artifact_job *job)
{
    const struct artifact *artifact = job->artifact;
    const bool gathers = artifact->gathers != NULL && job->type != NULL &&
                         strcmp(job->type->ending, artifact->gathers) == 0;
    if (artifact->scope == ARTIFACT_OF_EACH && !gathers) {
        return job->count;
    }
    return artifact->count != NULL ? artifact->count(job->inputs[0]) : 1;
}

/* One more, if nothing speaks against it. */
static bool artifact_order(struct artifacts *artifacts, const struct artifact_setting *setting,
                           struct artifact_job job, struct error *error)
{
    const struct artifact *artifact = job.artifact;
    if (!check_scope(&job, setting, error) || !job_find_form(&job, setting, error)) {
        return false;
    }
    const bool is_shown = job.form == ARTIFACT_SHOWN;
    if (artifact->is_binary && !is_shown && !check_bytes(&job, setting->arena, error)) {
        return false;
    }
    const bool is_each = artifact->scope == ARTIFACT_OF_EACH;
    job.count = is_each || artifact->scope == ARTIFACT_OF_SWEEP ? setting->sweep->total : 1;
    job.inputs = inputs_of(setting, job.count, error);
    if (job.inputs == NULL) {
        return false;
    }
    job.asking = setting->asking;
    job.report = setting->report;
    job.is_forced = setting->common->force;
    job.dress = (struct svg_dress){(enum palette_theme)setting->common->theme,
                                   setting->common->title, setting->common->subtitle};
    job.run = setting->run;
    if (!job_choose_type(&job, setting->arena, error)) {
        return false;
    }
    job.first = artifacts->files;
    job.files = job_count_files(&job);
    /* several files want names */
    if (job.files != 1 && !is_shown && place_is_standard(job.path, setting->arena)) {
        return fail(error, ERROR_USAGE, "%zu files do not go to standard output: --%s FILE",
                    job.files, job.artifact->option.name);
    }
    if ((artifact->check != NULL && !artifact->check(&job, error)) ||
        !job_check_place(artifacts, &job, setting, error)) {
        return false;
    }
    artifacts->jobs[artifacts->count++] = job;
    artifacts->files += job.files;
    return true;
}

bool artifacts_asked(const struct command *command, const struct arguments *arguments)
{
    bool asked = false;
    for (size_t i = 0; i < command->artifact_count; i++) {
        asked = asked || arguments->all[command->option_count + i].is_given;
    }
    return asked;
}

/* The option by which a command shows something: its first drawing or picture, else its curves. */
static const char *artifact_shown_by(const struct command *command)
{
    for (size_t i = 0; i < command->artifact_count; i++) {
        if (showing_is_possible(command->artifacts[i].option.types)) {
            return command->artifacts[i].option.name;
        }
    }
    return "plot";
}

/* --terminal has nothing to say where nothing is shown. */
static bool check_terminal(const struct artifacts *artifacts,
                           const struct artifact_setting *setting, struct error *error)
{
    bool any_shown = false;
    for (size_t i = 0; i < artifacts->count; i++) {
        any_shown = any_shown || artifacts->jobs[i].form == ARTIFACT_SHOWN;
    }
    if (any_shown || !asking_given(setting->asking, "terminal")) {
        return true;
    }
    fail(error, ERROR_USAGE, "--terminal says how a drawing is shown, and none is");
    return error_hint(error, "a file called term is the terminal: --%s term",
                      artifact_shown_by(setting->command));
}

/* Their sinks. */
static bool artifacts_open(struct artifacts *artifacts, const struct artifact_setting *setting,
                           struct error *error)
{
    struct arena *arena = setting->arena;
    artifacts->common = setting->common;
    artifacts->arena = arena;
    artifacts->has_rows = setting->command->run != NULL;
    artifacts->sinks = ARENA_ARRAY(arena, artifacts->files + 1, struct output);
    artifacts->inner = ARENA_ARRAY(arena, artifacts->files + 1, struct output);
    for (size_t i = 0; i < artifacts->count; i++) {
        const struct artifact_job *ordered = &artifacts->jobs[i];
        for (size_t k = 0; k < ordered->files; k++) {
            struct output *sink = &artifacts->sinks[artifacts->open];
            if (ordered->form != ARTIFACT_AS_MADE) {
                output_inside(&artifacts->inner[artifacts->open], arena);
            }
            const bool is_shown = ordered->form == ARTIFACT_SHOWN;
            const char *path = is_shown ? NULL : numbered(ordered, k, arena);
            if (setting->is_inside) {
                output_inside(sink, arena);
            } else if (output_open(sink, path, arena, error)) {
                if (!is_shown) {
                    terminal_guard(sink); /* what is shown has been */
                }
            } else {
                return false;
            }
            artifacts->open++;
        }
    }
    return true;
}

bool artifacts_order(struct artifacts *artifacts, const struct artifact_setting *setting,
                     const struct artifact *columns, const void *context, struct error *error)
{
    const struct command *command = setting->command;
    *artifacts = (struct artifacts){0};
    artifacts->jobs = ARENA_ARRAY(setting->arena, command->artifact_count + 1, struct artifact_job);
    for (size_t i = 0; i < command->artifact_count; i++) {
        const struct argument *argument = &setting->arguments->all[command->option_count + i];
        struct artifact_job job = {.artifact = &command->artifacts[i]};
        if (argument->is_given) {
            struct text path = argument->text;
            job.path = arena_string(setting->arena, path.start, path.length);
        }
        if (argument->is_given && job.path[0] == '\0') {
            return fail(error, ERROR_USAGE, "--%s is empty", argument->option->name);
        }
        /* of a command without rows the answer is made unless something else is asked for */
        const bool is_answer =
            command->run == NULL && i == 0 && !artifacts_asked(command, setting->arguments);
        if ((argument->is_given || is_answer) && !artifact_order(artifacts, setting, job, error)) {
            return false;
        }
    }
    const struct artifact_job job = {
        .artifact = columns, .path = setting->common->plot, .context = context};
    if (columns != NULL && !artifact_order(artifacts, setting, job, error)) {
        return false;
    }
    return check_terminal(artifacts, setting, error) && artifacts_open(artifacts, setting, error);
}

/* What was made in memory becomes what was asked for. */
static bool job_convert(const struct artifacts *artifacts, const struct artifact_job *job,
                        struct error *error)
{
    bool done = true;
    for (size_t k = 0; k < job->files && done; k++) {
        struct output *made = &artifacts->inner[job->first + k];
        struct output *sink = &artifacts->sinks[job->first + k];
        sink->remarks = made->remarks;
        sink->is_unused = made->is_unused;
        done = made->is_unused || showing_convert(artifacts, job, output_kept(made), sink, error);
    }
    return done;
}

bool artifacts_make(const struct artifacts *artifacts, struct error *error)
{
    bool done = true;
    for (size_t i = 0; i < artifacts->count && done; i++) {
        const struct artifact_job *job = &artifacts->jobs[i];
        const bool is_converted = job->form != ARTIFACT_AS_MADE;
        struct output *into = is_converted ? artifacts->inner : artifacts->sinks;
        done = job->artifact->make(job, &into[job->first], error) &&
               (!is_converted || job_convert(artifacts, job, error));
        /* some files may not be made: one of that name that is there stays, and is told */
        for (size_t k = 0; done && k < job->files; k++) {
            struct output *sink = &artifacts->sinks[job->first + k];
            if (sink->is_unused && sink->path != NULL && place_is_file(sink->path, sink->arena)) {
                sink->remarks = text_of(arena_printf(
                    sink->arena, "%s stays as it was: it is of an earlier run\n", sink->path));
            }
        }
    }
    return done;
}

bool artifact_spares(const struct artifact_job *job, const char *path, struct error *error)
{
    struct arena *arena = job->run->arena;
    const bool is_free = job->path == NULL || job->is_forced;
    for (size_t i = 0; i < job->files && !is_free; i++) {
        const char *written = numbered(job, i, arena);
        if (place_is_file(written, arena) && place_is_same(written, path, arena)) {
            return fail(error, ERROR_IO, "%s is also written: --force overwrites it", written);
        }
    }
    return true;
}

void artifacts_abandon(const struct artifacts *artifacts)
{
    for (size_t i = 0; i < artifacts->open; i++) {
        output_abandon(&artifacts->sinks[i]);
    }
}

bool artifacts_close(struct artifacts *artifacts, bool keep, struct error *error)
{
    bool done = true;
    /* what is shown stands behind the rows, in the order in which it was asked for */
    for (size_t i = 0; i < artifacts->count && keep; i++) {
        const struct artifact_job *job = &artifacts->jobs[i];
        for (size_t k = 0; k < job->files && job->form == ARTIFACT_SHOWN; k++) {
            const struct text shown = output_kept(&artifacts->inner[job->first + k]);
            output_text(&artifacts->sinks[job->first + k], shown.start, shown.length);
            output_flush(&artifacts->sinks[job->first + k]);
        }
    }
    while (artifacts->open > 0) {
        struct error closing;
        if (!output_close(&artifacts->sinks[--artifacts->open], keep && done, &closing) && keep) {
            *error = done ? closing : *error;
            done = false;
        }
    }
    return done;
}

struct text artifacts_remarks(const struct artifacts *artifacts, struct arena *arena)
{
    struct text_buffer remarks = {.arena = arena};
    struct name_table said = {0};
    for (size_t i = 0; i < artifacts->files && artifacts->sinks != NULL; i++) {
        struct text rest = artifacts->sinks[i].remarks;
        while (rest.length > 0) {
            const struct text line = text_cut(&rest, '\n');
            if (name_table_find(&said, line) == NAME_NONE) {
                name_table_add(&said, line, arena);
                growing_format(&remarks, "%.*s\n", (int)line.length, line.start);
            }
        }
    }
    return growing_done(&remarks);
}
