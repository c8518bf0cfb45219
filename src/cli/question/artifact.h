/* cli/question/artifact.h - drawings, lens files, texts: what a command makes besides rows. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_QUESTION_ARTIFACT_H
#define LENSCALC_CLI_QUESTION_ARTIFACT_H

#include "base/file_type.h"
#include "cli/options/option.h"
#include "draw/svg.h"
#include "report/output.h"

#include <stdbool.h>
#include <stddef.h>

struct report;
struct run;
struct sweep;
struct arguments;
struct common;
struct command;
struct artifact;

/* Which options a question has, on the command line or as columns of its batch. */
struct option_query {
    bool (*given)(const void *asked, const char *option);
    bool (*in_rows)(const void *asked, const char *option); /* as a column, whose cells differ */
    const void *asked;
};

static inline bool asking_given(const struct option_query *asking, const char *option)
{
    return asking->given(asking->asked, option);
}

static inline bool asking_in_rows(const struct option_query *asking, const char *option)
{
    return asking->in_rows(asking->asked, option);
}

/* What an artifact is made of. */
enum artifact_scope {
    ARTIFACT_OF_ANSWER, /* one input, whatever number of rows it makes */
    ARTIFACT_OF_ROW,    /* one input that makes one row */
    ARTIFACT_OF_SWEEP,  /* all inputs of a sweep, at most 100 */
    ARTIFACT_OF_EACH,   /* the same, in a file each: NAME.png or NAME-1.png, NAME-2.png ... */
    ARTIFACT_OF_ROWS,   /* the rows of all of them, which the driver keeps and counts */
};

/* What becomes of what `make` writes: see cli/question/showing.h. */
enum artifact_form {
    ARTIFACT_AS_MADE,
    ARTIFACT_SHOWN,  /* on the terminal: the file is called "term" */
    ARTIFACT_AS_PNG, /* a drawing, by another program */
    ARTIFACT_AS_PDF
};

/* An artifact that was asked for. */
struct artifact_job {
    const struct artifact *artifact;
    enum artifact_form form;
    const char *path;             /* null: standard output */
    const struct file_type *type; /* of artifact->option.types; null if it has none */
    const void *const *inputs;    /* as the options set them; of one answer inputs[0] alone */
    size_t count;
    size_t first, files;    /* of its sinks, and how many it has: one, or one each */
    bool is_forced;         /* what is kept is written over */
    struct svg_dress dress; /* of what is drawn */
    const struct option_query *asking;
    const struct report *report; /* the columns of the rows */
    struct run *run;             /* arena, database, and `state` as the command's `run` left it */
    const void *context;         /* the driver's own */
};

struct artifact {
    struct option option; /* "scale", whose value is the file; ARTIFACT_OPTION */
    enum artifact_scope scope;
    const char *varies;  /* ARTIFACT_OF_EACH: options that may be swept, separated by blanks */
    const char *gathers; /* ARTIFACT_OF_EACH: the ending of files that hold all inputs; or null */
    bool is_kept;        /* a file that is there already is replaced with --force only */
    bool is_binary;      /* bytes that are not shown on a terminal */
    bool needs_no_rows;  /* `make` finds, and says, all that is wrong with the question by itself */
    /* The type that the input asks for, whatever the file is called; null: its name decides. */
    const struct file_type *(*choose)(const void *input);
    const char *chooser; /* the option that does that */
    /* How many files one answer is, numbered as those of a sweep are; null: one. */
    size_t (*count)(const void *input);
    /* Refuse what cannot be made, before anything is computed; null: nothing is refused. */
    bool (*check)(const struct artifact_job *job, struct error *error);
    /*
     * Write it.
     *
     * Given     job   after `run` has answered, if the command has one: what that allocated in
     *                 run->arena is still there
     *           sink  takes any bytes; what it got is kept only if all goes well;
     *                 an array of job->files where there are several
     */
    bool (*make)(const struct artifact_job *job, struct output *sink, struct error *error);
};

/* How the option is called, what files it writes, and what help says. */
#define ARTIFACT_OPTION(option_name, file_types_of, words)                                         \
    .option = {.kind = &kind_text,                                                                 \
               .name = option_name,                                                                \
               .value = "FILE",                                                                    \
               .flags = OPTION_FILE,                                                               \
               .types = file_types_of,                                                             \
               .help = words}

/* The answer itself, of a command without rows: it goes to standard output or to this file. */
#define ARTIFACT_ANSWER(file_types_of)                                                             \
    .option = {.kind = &kind_text,                                                                 \
               .name = "output",                                                                   \
               .letter = 'o',                                                                      \
               .value = "FILE",                                                                    \
               .flags = OPTION_FILE,                                                               \
               .types = file_types_of,                                                             \
               .help = "write to FILE, which appears only when it is complete"}

/* What a drawing may be written as, and to write it so. */
file_types drawing_types;
bool drawing_write(const struct artifact_job *job, const struct svg *drawing, struct output *sink,
                   struct error *error);

/* The artifacts of one question. */
struct artifacts {
    struct artifact_job *jobs;
    size_t count;
    struct output *sinks; /* of each job its own, one after the other */
    struct output *inner; /* in memory, of those that become something else */
    size_t files, open;
    const struct common *common;
    struct arena *arena;
    bool has_rows; /* before what is shown */
};

/* The driver's part of every job. */
struct artifact_setting {
    const struct command *command;
    const struct arguments *arguments;
    const struct common *common;
    const struct sweep *sweep;
    void *input; /* changes with the sweep */
    bool is_batch, many;
    bool is_inside; /* sinks stay in memory */
    bool is_text;   /* rows are printed as a table for reading */
    const struct option_query *asking;
    const struct report *report;
    struct run *run;
    struct arena *arena;
};

/* Is any of a command's own asked for? */
bool artifacts_asked(const struct command *command, const struct arguments *arguments);

/*
 * Find the artifacts that are asked for, refuse what cannot be made, and open their files.
 *
 * Given     columns  the artifact of the common --plot; null: it is not asked for
 *           context  for that one
 * A drawing or PNG whose file is called "term" is shown on standard output; a drawing whose file
 * ends in .png or .pdf is converted.
 *
 * Errors    ERROR_USAGE: a file name with the ending of something else, two artifacts in one file,
 *           several answers or more inputs than an artifact shows; ERROR_IO: a file that is kept,
 *           or cannot be written; as the artifact's own `check`
 */
bool artifacts_order(struct artifacts *artifacts, const struct artifact_setting *setting,
                     const struct artifact *columns, const void *context, struct error *error);

/* Make them. Errors as the artifact's `make`. */
bool artifacts_make(const struct artifacts *artifacts, struct error *error);

/* As output_abandon, of all that are open. */
void artifacts_abandon(const struct artifacts *artifacts);

/*
 * Their files appear, if `keep`; else none of them does.
 *
 * Errors    ERROR_IO
 */
bool artifacts_close(struct artifacts *artifacts, bool keep, struct error *error);

/*
 * Refuse to write over a file that only the making finds out is read, as a scene names pictures.
 *
 * Errors    ERROR_IO: a file of the job is this one, and no --force says that it is meant so
 */
bool artifact_spares(const struct artifact_job *job, const char *path, struct error *error);

/* Of several files the one by this number from 0: "night.png" becomes "night-01.png". */
const char *artifact_path(const char *path, size_t files, size_t number, struct arena *arena);

/* What they have to say on standard error: of lines that are alike the first. */
struct text artifacts_remarks(const struct artifacts *artifacts, struct arena *arena);

#endif
