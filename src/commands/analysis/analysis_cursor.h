/* commands/analysis/analysis_cursor.h - a question case by case and field by field. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_ANALYSIS_ANALYSIS_CURSOR_H
#define LENSCALC_COMMANDS_ANALYSIS_ANALYSIS_CURSOR_H

#include "analysis/waves/wave_reference.h"
#include "commands/analysis/analysis_options.h"

/* One lens in one position, its image plane placed. */
struct analysis_case {
    const struct analysis_question *question;
    const struct setup *setup;
    bool clip;
    const char *warning;  /* null = all is well */
    const char *spectrum; /* the wavelengths with their weights, in words; null: one of them */
    int threads;          /* that one field may take */
};

struct analysis_cursor;

/*
 * What takes time of a field, into zeroed room. Threads find several fields at once: `one` is the
 * thread's own case, and memory is that of one->setup->arena.
 */
typedef bool analysis_find(const struct analysis_cursor *at, const struct analysis_case *one,
                           size_t field, void *found, struct error *error);

/*
 * Goes through a question:
 *
 *     struct analysis_cursor at = analysis_begin(input, &policy, run);
 *     while (analysis_next(&at, error)) {
 *         ... at.one->setup->fields[at.field] ...
 *     }
 *     return error->code == ERROR_NONE;
 */
struct analysis_cursor {
    const void *input; /* of the command, which begins with this: */
    const struct analysis_question *question;
    const struct analysis_policy *policy;
    struct run *run;
    analysis_find *find; /* null: nothing is found ahead */
    size_t found_size;
    bool keeps_lost; /* a field that fails comes all the same, with `lost` */
    /* where it is */
    const struct analysis_case *one; /* lasts as long as the run's arena */
    size_t field;
    const void *found; /* by `find` */
    const char *lost;  /* why this field has failed; null: it has not */
    /* its own */
    const size_t *positions;
    size_t position_count, next_position, next_field;
    char *all_found;
    struct error *errors;
};

/*
 * Before the first case. Where rows of several fields are asked for, it keeps those that fail.
 *
 * Given     find, found_size  what is found of each field, and how large that is; null: nothing
 */
struct analysis_cursor analysis_begin_finding(const void *input,
                                              const struct analysis_policy *policy, struct run *run,
                                              analysis_find *find, size_t found_size);
struct analysis_cursor analysis_begin(const void *input, const struct analysis_policy *policy,
                                      struct run *run);

/*
 * On to the next field, of the next case where there is none.
 *
 * Result    false: that was the last one, and error->code is ERROR_NONE; else it failed
 * Errors    ERROR_USAGE: options that exclude each other, an unknown position; as setup_open,
 *           setup_place_image and `find`, the field named where there may be several
 */
bool analysis_next(struct analysis_cursor *at, struct error *error);

/* The same in two steps: on to the next case, and there from field to field. */
bool analysis_next_case(struct analysis_cursor *at, struct error *error);
bool analysis_next_field(struct analysis_cursor *at, struct error *error);

/*
 * The present field has failed. Where such fields are kept at->lost says why, the question counts
 * as failed (run->shortfall) and `error` is none; else false, the field named in `error`.
 */
bool analysis_keep_lost(struct analysis_cursor *at, struct error *error);

/* -------- several threads -------- */

/* Item `item` of some work on a case; what it takes of one->setup->arena stays. */
typedef void analysis_work(const struct analysis_case *one, size_t item, void *context);

/*
 * Do items 0 .. count - 1 with the threads of a case. Each has a case, a setup and an arena of its
 * own; an item leaves its results in a place of its own, and they may not depend on which items the
 * same thread did before.
 */
void analysis_divide(const struct analysis_case *one, size_t count, analysis_work *work,
                     void *context);

/* -------- rows and rays -------- */

struct analysis_point analysis_point_of(const struct analysis_case *one, size_t field);

/* A row, which begins with its struct analysis_point: that is filled, the rest absent. */
void analysis_begin_row(const struct analysis_cursor *at, const struct sheet *sheet, void *row);

/* Add to what is doubtful about the row of a cursor; null: nothing is. */
void analysis_warn(const struct analysis_cursor *at, struct analysis_point *point,
                   const char *words);

/* The rays of one field of a case, at its first wavelength, as the options fill the pupil. */
struct bundle_question analysis_bundle(const struct analysis_case *one, size_t field);

/* -------- words of drawings -------- */

/* What was asked for of a case: "wide, 587.562 nm, f/4, defocus 0.1 mm"; null: nothing. */
const char *analysis_case_words(const struct analysis_case *one, struct arena *arena);

/* "f/2.8", "f/2.8 (working f/5.6)"; of an afocal lens "entrance pupil 35 mm"; null: not known. */
const char *analysis_aperture_words(const struct first_order *first, struct arena *arena);

/* The words of figures about a case, in their order. */
enum setting_word {
    SETTING_POSITION,    /* "wide" */
    SETTING_APERTURE,    /* "f/4" */
    SETTING_WAVELENGTHS, /* "486.1, 587.6, 656.3 nm" */
    SETTING_OBJECT,      /* "object at 500 mm" */
    SETTING_PLANE,       /* "image plane paraxial, 36.11 mm from the last vertex" */
    SETTING_DEFOCUS,     /* "defocus +0.1 mm" */
    SETTING_WORDS
};
void analysis_setting_words(const struct analysis_case *one, const char *words[SETTING_WORDS],
                            struct arena *arena);

/* What figures state of their case, joined by |. */
enum figure_part {
    FIGURE_APERTURE = 1,
    FIGURE_WAVELENGTHS = 2, /* where no legend shows them */
    FIGURE_PLANE = 4,
    FIGURE_THROUGH_FOCUS = 7,
    FIGURE_DEFOCUS = 8, /* where the figure does not go through focus */
    FIGURE_ALL = 15
};

/*
 * "wide; f/4; 486.1, 587.6, 656.3 nm; image plane paraxial, 36.11 mm from the last vertex; defocus
 * +0.1 mm": below the title of a figure.
 */
const char *analysis_figure_words(const struct analysis_case *one, unsigned parts,
                                  struct arena *arena);

/* What a field is called in a figure: "14°", "12 mm", "x 3°, y 4°", "axis". */
const char *analysis_place_words(const struct field_point *at, struct arena *arena);

/* The same with its position, and of several questions with what was asked: "14°, f/4". */
const char *analysis_field_words(const struct analysis_case *one, size_t field, bool several,
                                 struct arena *arena);

/* The wavelengths of a setup with their weights: "587.6 nm x 1, 486.1 nm x 0.5"; null: one. */
const char *analysis_spectrum_words(const struct setup *setup);

/* "the chief ray at 587.6 nm" */
const char *wave_reference_words(const struct analysis_case *one, enum wave_about about,
                                 struct arena *arena);

/* What a curve of one case is called in a drawing, `name` by analysis_case_words. */
const char *analysis_curve_words(const char *title, const char *name, bool one_lens,
                                 struct arena *arena);

/* How many different values a member has among the inputs of a job. */
#define ANALYSIS_VALUES_OF(job, input, member)                                                     \
    analysis_values_of(job, offsetof(input, member), sizeof(((const input *)0)->member))
size_t analysis_values_of(const struct artifact_job *job, size_t offset, size_t size);

/* For qsort: doubles, ascending. */
int analysis_ascending(const void *first, const void *second);

/* A number to three digits, without an exponent as far as people read numbers so. */
const char *analysis_number(double value, struct arena *arena);

#endif
