/* commands/design/optimize_job.h - what optimize is asked, and what it found. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_DESIGN_OPTIMIZE_JOB_H
#define LENSCALC_COMMANDS_DESIGN_OPTIMIZE_JOB_H

#include "analysis/rays/clear_diameters.h"
#include "cli/options/goals.h"
#include "commands/design/design.h"
#include "design/closer_look.h"
#include "design/glass_choice.h"
#include "design/optimize.h"
#include "design/optimize_global.h"
#include "design/test_plates.h"

#include <time.h>

enum optimize_show {
    OPTIMIZE_ANSWER,
    OPTIMIZE_MERIT,
    OPTIMIZE_VARIABLES,
    OPTIMIZE_SPOTS,
    OPTIMIZE_GLASSES,
    OPTIMIZE_PLATES,
    OPTIMIZE_SHOWS
};

/* Of a search: as many as --global many, which goes on until time or a signal ends it. */
enum { OPTIMIZE_MOST_STARTS = 1000000 };

struct optimize_input {
    struct lens_question question;
    struct spectrum_value waves;
    const char *vary, *hold, *goals, *no_goal, *glasses, *plates, *grade, *tolerances;
    const char *start; /* words of a lens from nothing; null: from the lens */
    int show, solver, aim, pattern;
    long rays,                  /* 0: the usual ones, or more where these see too little */
        seed, iterations;       /* iterations: 0 = as many as it takes */
    long threads;               /* 0: one per core */
    long global, keep, escapes; /* global: 0 = from the lens alone */
    long relocate;              /* lenses whose elements are put in elsewhere */
    double spread;
    struct part part; /* count 0: all of it */
    double seconds;   /* NaN = as long as it takes */
    double margin;    /* of --set-diameters; NaN = they stay */
    bool clip, no_clip;
};

/* One lens being optimised. */
struct optimize_job {
    const struct optimize_job *earlier; /* of a sweep, while its jobs are kept; null: the first */
    const struct optimize_input *input;
    struct run *run;
    const struct lens *lens; /* as read */
    struct variables variables;
    const char *goals; /* in words that --goals takes */
    bool guards;       /* the last goal keeps rays from loss, and is none of these words */
    struct perturbations errors; /* of the goal asbuilt */
    const char *made;            /* what they are, in words; null: there is no such goal */
    struct merit merit;
    struct optimize_task task;
    const struct glass_candidate *glasses; /* of --glasses */
    size_t glass_count;
    const struct glass_choice *choice; /* what they were used for; null: there are none */
    struct test_plate *plates;         /* of --test-plates */
    size_t plate_count;
    const struct plate_choice *fitted; /* to them; null: there are none */
    const char *unfitted;              /* radii that are not, and why; null: all are */
    struct optimize_answer answer;
    const struct closer_look *look; /* at the answer; null: not yet */
    const struct lens *found;
    const char *status, *warning; /* null: nothing is doubtful */
    const char *incomplete;       /* why it is not the best, in words; null: it is */
    double until;                 /* of progress_clock; infinite: no limit */
    bool is_late;
    /* of --global */
    const char *search; /* in words; null: there is none */
    struct optimize_global *global;
    struct optimize_best *best;         /* of --output while it goes on; null: nobody wants it */
    const struct optimize_start *start; /* of --start; null: the lens is given */
    struct optimize_job *layouts;       /* of it, each with a lens of its own */
    size_t layout_count;
    struct part_head part, state; /* of --part, and of --state, which is asked less */
    const char *state_path;       /* null: nobody wants one */
    time_t saved;                 /* when the state was written last */
    struct optimize_job *kept;    /* the best first, each a job with an answer */
    size_t kept_count;
    long rank, hits;  /* of one of them; starts that led to it */
    long evaluations; /* of the search */
    double *ends;     /* the best merit of each start that has one, the best first */
    size_t end_count;
};

/* What rows of every sheet have: what a sweep varies, so that they can be told apart, the lens. */
struct optimize_about {
    double fnumber;
    long seed, rank;
    const char *fields, *wavelengths, *rays, *lens, *warning;
};

#define OPTIMIZE_SWEPT_COLUMNS(S)                                                                  \
    LENS_FNUMBER_COLUMN(S, about.fnumber),                                                         \
        LENS_SEED_COLUMN(S, about.seed,                                                            \
                         "seed of the starts of --global and of the sobol pattern"),               \
    {                                                                                              \
        COLUMN(S, about.rank), .flags = COLUMN_EXTRA, .name = "rank", .with = "global",            \
                               .label = "rank", .help = "of the lenses that are kept, 1 the best"  \
    }
#define OPTIMIZE_SEEN_COLUMN(S, member, on, words)                                                 \
    ENTRY(COLUMN(S, about.member), .flags = COLUMN_EXTRA | COLUMN_ASSUMED, .name = #member,        \
          .depends = on, .label = #member, .help = words)

#define OPTIMIZE_LENS_COLUMNS(S)                                                                   \
    OPTIMIZE_SEEN_COLUMN(S, fields, "field lens", "that it is optimized for"),                     \
        OPTIMIZE_SEEN_COLUMN(S, wavelengths, "wavelength lens", "that it is optimized for"),       \
        OPTIMIZE_SEEN_COLUMN(S, rays, "rays pattern aim clip no-clip",                             \
                             "those of each field and wavelength"),                                \
        LENS_TITLE_COLUMN(S, about.lens), LENS_WARNING_COLUMN(S, about.warning)

/* Of the first row of a sheet with what is doubtful. */
struct optimize_about optimize_about_of(const struct optimize_job *job, bool is_first);

/* -------- goals where none is given -------- */

/*
 * What is wanted where nothing is said, in words that --goals takes, but for what --no-goal names.
 *
 * Given     job->goals  those that are given, or of the lens; null receives the usual ones
 * Formula   poly; in each position the focal length that is stated, or else its own; the f-number
 *           that is stated, where the aperture does not have it anyway; the image behind the last
 *           vertex; no glass and no gap thinner than so much of the shortest focal length, or than
 *           the thinnest that is there. What cannot be told, and an image in front of the last
 *           vertex that the lens begins with, is left out
 * Errors    ERROR_USAGE: a name in --no-goal that is none of a usual goal, or that is not grazing
 *           where goals are given; nothing is left
 */
bool optimize_usual_open(struct optimize_job *job, const struct merit_question *question,
                         struct error *error);

/* Is a goal named by --no-goal? */
bool optimize_usual_is_off(const struct optimize_input *input, const char *name);

/* After an answer: the lens that was found, how it ended, and what is doubtful about it. */
bool optimize_judge(struct optimize_job *job, struct error *error);

/* One doubt more, as by printf. */
void optimize_warn(struct optimize_job *job, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* A lens in the position of a place of the merit, its image plane placed. */
bool optimize_open_setup(const struct optimize_job *job, const struct lens *lens, size_t place,
                         const struct setup_wavelength *lights, size_t light_count,
                         bool takes_telecentric, struct setup *setup, struct error *error);

/* Diameters that beams of the merit need in the lens that was found, with a margin, a share. */
struct clear_diameters_question optimize_beams(const struct optimize_job *job, double margin);

/* How far a figure is on the wrong side of what is wanted; of '=' how far away. */
double optimize_wrong_by(const struct operand *operand, double value);

/* A figure of a goal in the unit that it has, of many surfaces the worst, of rays the root of their
   sum of squares; and its part of the merit. */
double optimize_value_of(const struct optimize_state *state, const struct merit_slot *slot);
double optimize_merit_of(const struct optimize_state *state, const struct merit_slot *slot);

/* The position that a goal is of; null: there is one alone, or it compares several. */
const char *optimize_position_of(const struct merit *merit, const struct merit_slot *slot);

/* Is it what keeps rays from loss, that nobody asked for, and has nothing to say? */
bool optimize_is_quiet(const struct optimize_job *job, const struct merit_slot *slot);

/* The lens that was found, as it is written: with its goals, and notes of what it was. */
struct lens optimize_lens_written(const struct optimize_job *job);

/* A variable of a lens, mm, 1/mm, rad or 1; of a glass that took a model's place its nd or Vd. */
double optimize_variable_in(const struct optimize_job *job, const struct lens *lens, size_t which);

/* What there is to say of it: the glass or plate that it became, or its bound; null: nothing. */
const char *optimize_variable_note(const struct optimize_job *job, size_t which, bool *is_at_bound);

/* -------- optimize_refine.c: more rays and fields than were asked for -------- */

/*
 * After an answer: where twice the rays, or fields between, see a lens that is worse than the merit
 * has it, it goes on with more of them, unless the command says how many there are, up to three
 * times; what was seen is a warning. The merit is that of the last.
 *
 * Result    did it?
 */
bool optimize_refine(struct optimize_job *job);

/* The same of the lens that was found, with what is to be asked for. */
void optimize_warn_of_look(struct optimize_job *job);

/* The rows of --show. */
extern const struct sheet *const optimize_sheets[];
bool optimize_emit(struct optimize_job *job, struct error *error);

/* --output, after `run`. */
bool optimize_save(const struct artifact_job *job, struct output *sink, struct error *error);

/* A part goes into a file that is called so. */
bool optimize_check_saved(const struct artifact_job *job, struct error *error);

/* --state, after `run`. */
bool optimize_save_state(const struct artifact_job *job, struct output *sink, struct error *error);

/* --report: the lens before and after, side by side. */
bool optimize_report(const struct artifact_job *job, struct output *sink, struct error *error);

/* --plot: the merit against the iteration. */
bool optimize_plot(const struct artifact_job *job, struct output *sink, struct error *error);

/* -------- parts and states of a search: what starts led to, in files -------- */

/*
 * Before a search.
 *
 * Given     job  its search, of whose starts none is done; receives which of them are searched, and
 *                what files say of the others: parts that are merged, the state it goes on from
 * Errors    ERROR_USAGE: --part without a file; as division_head and division_found; ERROR_DATA: a
 *           file that does not hold what its head says
 */
bool optimize_part_begin(struct optimize_job *job, struct error *error);

/* Write the state where it is wanted, at once; what cannot be written is said at the end. */
void optimize_part_save(struct optimize_job *job);

/* -------- optimize --glasses: model glasses end as real ones -------- */

/*
 * Read --glasses, where it is given: before anything is optimised, with the merit open.
 *
 * Errors    ERROR_USAGE: what is neither a catalogue nor a glass, with a suggestion. ERROR_DOMAIN:
 *           no model glass varies; a glass that does not reach to all wavelengths, or whose nd and
 *           Vd are not known; nothing left
 */
bool optimize_glasses_open(struct optimize_job *job, struct error *error);

/* Replace the model glasses of what was optimised; errors as glass_choose. */
bool optimize_glasses_choose(struct optimize_job *job, struct error *error);

/*
 * The answer to the whole question: of the start, and of the last step, which had so many of the
 * job's variables, `origin` in their list.
 */
void optimize_answer_join(struct optimize_job *job, const struct optimize_answer *last,
                          const size_t *origin, size_t variables);

/* Rows of --show glasses. */
extern const struct sheet optimize_glass_sheet;
bool optimize_emit_glasses(struct optimize_job *job, struct error *error);

/* -------- optimize --test-plates: radii end as those of a maker's list -------- */

/*
 * Read --test-plates, where it is given.
 *
 * Errors    ERROR_USAGE: --show plates without it. ERROR_DOMAIN: no radius of a sphere varies.
 *           ERROR_IO, ERROR_DATA with line and column: what is wrong with the file
 */
bool optimize_plates_open(struct optimize_job *job, struct error *error);

/* Replace the radii of what was optimised; errors as plates_fit, and a beam that does not arrive
   where diameters are not stated. */
bool optimize_plates_fit(struct optimize_job *job, struct error *error);

/* How many were and what that cost, in words; null: nobody asked. */
const char *optimize_plates_words(const struct optimize_job *job);

/* Is a variable one of the radii that were fitted? */
bool optimize_plates_hold(const struct optimize_job *job, const struct variable *variable);

/* Rows of --show plates. */
extern const struct sheet optimize_plate_sheet;
bool optimize_emit_plates(struct optimize_job *job, struct error *error);

/* How many lenses it keeps at most. */
size_t optimize_keep_count(const void *input);

/*
 * Read, optimise from the lens or search, look at what was found: job->answer, or job->kept.
 *
 * Errors    ERROR_USAGE: options that do not go together; ERROR_DOMAIN: nothing that can be judged
 *           was found, with what is wrong with the lens itself
 */
bool optimize_job_run(struct optimize_job *job, struct error *error);

/* -------- optimize --start: lenses from nothing -------- */

/*
 * Read --start, and make a job of each layout, whose lens has the stop in another gap.
 *
 * Given     job  with its input; receives start and layouts
 * Errors    ERROR_USAGE: a word that is none, lacks, is there twice or out of its range, words that
 *           contradict each other
 */
bool optimize_start_open(struct optimize_job *job, struct error *error);

/* The lens, variables and merit of the layout that a start has; nothing without --start. */
void optimize_start_layout(struct optimize_job *one, size_t start);

/* optimize_global.place, of the job: a layout by third-order theory (design/predesign.h). */
bool optimize_start_place(void *context, size_t number, struct arena *arena, double *numbers);

/* How many starts are searched from: of --global, or those of --start. */
size_t optimize_start_count(const struct optimize_input *input);

/* -------- the best lens while the search goes on -------- */

/* Where --output names a file it holds the best lens from the first that is found on, with a note;
   the end puts another in its place. Before the search. */
void optimize_best_open(struct optimize_job *job);

/* With --global, whose merit is that of the question. */
bool optimize_search(struct optimize_job *job, const struct merit_question *question,
                     struct error *error);

#endif
