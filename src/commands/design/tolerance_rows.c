/* commands/design/tolerance_rows.c - what trials gave, as rows of --show. */
/* SPDX-License-Identifier: MIT */
#include "commands/design/tolerance_job.h"
#include "trace/aim/sample.h"

#include <math.h>
#include <string.h>

/* -------- summary -------- */

enum { PERCENTILES = 7 };
static const double shares[PERCENTILES] = {0.02, 0.1, 0.2, 0.5, 0.8, 0.9, 0.98};

struct summary_row {
    struct tolerance_about about;
    const char *position, *criterion, *of, *unit;
    double nominal, yield, yield_error, mean, error, sd, sd_error, worst;
    double p[PERCENTILES];
    double nominal_refocus, refocus, refocus_sd;
    long failed, trials;
    const char *moves;
};

#define PERCENTILE_COLUMN(k, number, called, more)                                                 \
    ENTRY(COLUMN(struct summary_row, p[k]), .flags = (more), .name = called, .label = called,      \
          .help = number " % of the lenses have less")

static const struct column summary_columns[] = {
    TOLERANCE_CRITERION_COLUMNS(struct summary_row),
    {COLUMN_NAMED(struct summary_row, nominal, COLUMN_BRIEF),
     .help = "figure of the lens without errors, adjusted as all are"},
    {COLUMN(struct summary_row, yield), .flags = COLUMN_BRIEF | COLUMN_SPARSE,
     .name = "yield_fraction", .when = "with --limit", .label = "yield",
     .help = "share of all trials that pass the limit; what failed does not"},
    {COLUMN(struct summary_row, yield_error), .flags = COLUMN_HIDDEN,
     .name = "yield_standard_error", .when = "with --limit", .label = "error of the yield",
     .help = "standard error of the yield"},
    {COLUMN_NAMED(struct summary_row, mean, COLUMN_BRIEF), .help = "of those that have a figure"},
    {COLUMN(struct summary_row, error), .flags = COLUMN_BRIEF, .name = "standard_error",
     .head = "+-", .digits = 2, .label = "standard error", .help = "of the mean"},
    {COLUMN(struct summary_row, sd), .flags = COLUMN_BRIEF, .name = "sd", .label = "deviation",
     .help = "standard deviation of the figures"},
    {COLUMN(struct summary_row, sd_error), .flags = COLUMN_HIDDEN, .name = "sd_standard_error",
     .label = "error of the deviation", .help = "standard error of the deviation"},
    PERCENTILE_COLUMN(0, "2", "p02", COLUMN_HIDDEN),
    PERCENTILE_COLUMN(1, "10", "p10", COLUMN_BRIEF),
    PERCENTILE_COLUMN(2, "20", "p20", COLUMN_HIDDEN),
    PERCENTILE_COLUMN(3, "50", "p50", COLUMN_BRIEF),
    PERCENTILE_COLUMN(4, "80", "p80", COLUMN_HIDDEN),
    PERCENTILE_COLUMN(5, "90", "p90", COLUMN_BRIEF),
    PERCENTILE_COLUMN(6, "98", "p98", COLUMN_HIDDEN),
    {COLUMN_NAMED(struct summary_row, worst, COLUMN_BRIEF), .help = "the worst figure"},
    {COLUMN_NAMED(struct summary_row, failed, COLUMN_BRIEF),
     .help = "lenses without a figure: rays miss a surface, say"},
    {COLUMN_NAMED(struct summary_row, trials, COLUMN_BRIEF), .help = "lenses that were made"},
    {COLUMN(struct summary_row, nominal_refocus), .unit = "mm", .dimension = &dimension_length,
     .flags = COLUMN_HIDDEN, .name = "nominal_refocus", .label = "nominal refocus",
     .help = "how far the image plane of the lens without errors goes; absent where something else "
             "is adjusted and --refocus is none"},
    {COLUMN_NAMED(struct summary_row, refocus, COLUMN_HIDDEN), .unit = "mm",
     .dimension = &dimension_length, .help = "how far the image plane goes on average"},
    {COLUMN(struct summary_row, refocus_sd), .unit = "mm", .dimension = &dimension_length,
     .flags = COLUMN_HIDDEN, .name = "refocus_sd", .label = "deviation of the refocus",
     .help = "standard deviation of how far it goes"},
    {COLUMN(struct summary_row, moves), .flags = COLUMN_HIDDEN | COLUMN_SPARSE,
     .name = "compensation", .label = "compensation",
     .help = "what else was adjusted: mean +- standard deviation of each"},
    TOLERANCE_ABOUT_COLUMNS(struct summary_row),
};

static const struct sheet summary_sheet = SHEET(summary_columns, struct summary_row);

static bool emit_summaries(struct tolerance_job *job, struct error *error)
{
    (void)error;
    const enum criterion_kind kind = job->question.criterion.kind;
    const struct criterion_type *type = criterion_type(kind);
    const double scale = type->scale, done = (double)job->result.done;
    for (size_t i = 0; i < job->result.column_count; i++) {
        struct tolerance_column *column = &job->result.columns[i];
        struct trial_statistics *tally = &column->tally;
        const struct trial_statistics_moments moments = trial_statistics_moments(tally);
        const struct trial_statistics_moments moves =
            trial_statistics_moments(&job->result.moves[0]);
        const double yield = (double)column->passed / done;
        const bool judges = !isnan(job->limit);
        /* of a sense that looks both ways the one that is farther off */
        const bool is_high = criterion_badness(kind, tally->highest, tally->nominal) >=
                             criterion_badness(kind, tally->lowest, tally->nominal);
        const double worst = is_high ? tally->highest : tally->lowest;
        struct summary_row row = {.about = tolerance_about_of(job),
                                  .position = tolerance_position_of(job, column->of),
                                  .criterion = job->question.criterion.name,
                                  .of = tolerance_name_of(job, column->of),
                                  .unit = type->unit,
                                  .nominal = scale * tally->nominal,
                                  .yield = judges ? yield : NAN,
                                  .yield_error = judges ? sqrt(yield * (1 - yield) / done) : NAN,
                                  .mean = scale * moments.mean,
                                  .error = scale * moments.mean_error,
                                  .sd = scale * moments.sd,
                                  .sd_error = scale * moments.sd_error,
                                  .worst = tally->count > 0 ? scale * worst : NAN,
                                  .failed = (long)job->result.failed,
                                  .trials = (long)job->result.done,
                                  .nominal_refocus =
                                      tolerance_refocus_of(job, job->tolerance.nominal_moves[0]),
                                  .refocus = tolerance_refocus_of(job, moves.mean),
                                  .refocus_sd = tolerance_refocus_of(job, moves.sd),
                                  .moves = tolerance_moves_in_words(job, NULL)};
        for (int k = 0; k < PERCENTILES; k++) {
            row.p[k] = scale * trial_statistics_quantile(tally, shares[k], NULL);
        }
        run_emit(job->run, &row);
    }
    return true;
}

/* -------- yield -------- */

struct yield_row {
    struct tolerance_about about;
    const char *position, *criterion, *of, *unit;
    double yield, figure, error;
    long failed, trials;
};

static const struct column yield_columns[] = {
    TOLERANCE_CRITERION_COLUMNS(struct yield_row),
    {COLUMN(struct yield_row, yield), .flags = COLUMN_BRIEF, .name = "yield_fraction",
     .label = "yield", .help = "share of all trials that are no worse"},
    {COLUMN_NAMED(struct yield_row, figure, COLUMN_BRIEF),
     .help = "the limit that lets so many pass; of efl and bfl the departure from the nominal one; "
             "absent where more have failed"},
    {COLUMN(struct yield_row, error), .flags = COLUMN_BRIEF, .name = "standard_error", .head = "+-",
     .digits = 2, .label = "standard error", .help = "of the figure"},
    {COLUMN_NAMED(struct yield_row, failed, COLUMN_BRIEF), .help = "lenses without a figure"},
    {COLUMN_NAMED(struct yield_row, trials, COLUMN_BRIEF), .help = "lenses that were made"},
    TOLERANCE_ABOUT_COLUMNS(struct yield_row),
};

static const struct sheet yield_sheet = SHEET(yield_columns, struct yield_row);

static bool emit_yields(struct tolerance_job *job, struct error *error)
{
    const struct criterion_type *type = criterion_type(job->question.criterion.kind);
    (void)error;
    for (size_t i = 0; i < job->result.column_count; i++) {
        struct tolerance_column *column = &job->result.columns[i];
        struct yield_row row = {.about = tolerance_about_of(job),
                                .position = tolerance_position_of(job, column->of),
                                .criterion = job->question.criterion.name,
                                .of = tolerance_name_of(job, column->of),
                                .unit = type->unit,
                                .failed = (long)job->result.failed,
                                .trials = (long)job->result.done};
        for (int k = 0; k < PERCENTILES; k++) {
            const double share =
                shares[k] * (double)job->result.done / (double)column->badness.count;
            double off;
            const double bad =
                share <= 1 ? trial_statistics_quantile(&column->badness, share, &off) : (off = NAN);
            row.yield = shares[k];
            row.figure = type->scale * (type->sense == SENSE_MOST ? -bad : bad);
            row.error = type->scale * off;
            run_emit(job->run, &row);
        }
    }
    return true;
}

/* -------- trials -------- */

struct trial_row {
    struct tolerance_about about;
    const char *position, *criterion, *of, *unit, *moves, *why;
    double figure, refocus;
    long trial;
    bool passes;
};

static const struct column trial_columns[] = {
    {COLUMN_NAMED(struct trial_row, trial, COLUMN_BRIEF), .help = "its number, from 1"},
    TOLERANCE_CRITERION_COLUMNS(struct trial_row),
    {COLUMN_NAMED(struct trial_row, figure, COLUMN_BRIEF),
     .help = "of the lens; absent where it failed"},
    {COLUMN_NAMED(struct trial_row, passes, COLUMN_HIDDEN),
     .help = "it keeps the limit; without a limit it has a figure"},
    {COLUMN_NAMED(struct trial_row, refocus, COLUMN_BRIEF | COLUMN_SPARSE), .unit = "mm",
     .dimension = &dimension_length, .help = "how far its image plane goes"},
    {COLUMN(struct trial_row, moves), .flags = COLUMN_BRIEF | COLUMN_SPARSE, .name = "compensation",
     .label = "compensation", .help = "what else was adjusted, and how far"},
    {COLUMN(struct trial_row, why), .flags = COLUMN_BRIEF | COLUMN_SPARSE, .name = "failure",
     .label = "failure", .help = "why it has no figure"},
    TOLERANCE_ABOUT_COLUMNS(struct trial_row),
};

static const struct sheet trial_sheet = SHEET(trial_columns, struct trial_row);

/* Up to the first that was not made. */
static bool emit_trials(struct tolerance_job *job, struct error *error)
{
    enum { AT_ONCE = 2048 };
    struct arena *arena = job->run->arena;
    const struct tolerance *tolerance = &job->tolerance;
    const struct criterion_type *type = criterion_type(job->question.criterion.kind);
    struct tolerance_round round = {.begin = job->trials.begin,
                                    .trials = ARENA_ARRAY(arena, AT_ONCE, struct tolerance_trial),
                                    .made = ARENA_ARRAY(arena, AT_ONCE, bool),
                                    .found = ARENA_ARRAY(arena, AT_ONCE, bool)};
    struct trial_row row = {.about = tolerance_about_of(job),
                            .criterion = job->question.criterion.name,
                            .unit = type->unit};
    for (size_t i = 0; i < AT_ONCE; i++) {
        round.trials[i].figures = ARENA_ARRAY(arena, tolerance->figure_count, double);
        round.trials[i].moves = ARENA_ARRAY(arena, tolerance_moves(tolerance), double);
    }
    watch_begin(job->run->watch, "trials", (size_t)(job->trials.end - round.begin));
    struct tolerance_team *team = tolerance_team_open(&job->trials, &job->result);
    bool goes_on = true, done = true;
    while (round.begin < job->trials.end && goes_on && done) {
        const uint64_t left = job->trials.end - round.begin;
        round.count = left < AT_ONCE ? (size_t)left : AT_ONCE;
        memset(round.made, 0, round.count * sizeof *round.made);
        memset(round.found, 0, round.count * sizeof *round.found);
        done = tolerance_team_round(team, &round, error);
        const struct arena_mark mark = arena_mark(arena);
        for (size_t k = 0; k < round.count && goes_on && done; k++) {
            const struct tolerance_trial *trial = &round.trials[k];
            const bool found = round.found[k];
            goes_on = round.made[k];
            row.moves = found ? tolerance_moves_in_words(job, trial->moves) : NULL;
            row.why = found ? NULL : trial->why.message;
            row.refocus = found ? tolerance_refocus_of(job, trial->moves[0]) : NAN;
            row.trial = (long)round.begin + 1;
            for (size_t i = 0; i < job->result.column_count && goes_on; i++) {
                const struct tolerance_figure *of = job->result.columns[i].of;
                row.position = tolerance_position_of(job, of);
                row.of = tolerance_name_of(job, of);
                row.figure = NAN;
                if (found) {
                    row.figure =
                        type->scale *
                        (of != NULL ? trial->figures[i]
                                    : tolerance_judged(tolerance, job->trials.of, trial->figures));
                }
                row.passes =
                    found && (isnan(job->limit) ||
                              tolerance_passes(tolerance, &job->trials, i, trial->figures));
                goes_on = run_emit(job->run, &row);
            }
            round.begin += goes_on;
        }
        arena_reset(arena, mark);
    }
    tolerance_team_close(team);
    if (round.begin < job->trials.end && watch_is_ended(job->run->watch)) {
        fail(&job->run->shortfall, ERROR_DOMAIN,
             "interrupted after %llu of %llu trials: those so far, incomplete",
             (unsigned long long)(round.begin - job->trials.begin),
             (unsigned long long)(job->trials.end - job->trials.begin));
    }
    return done;
}

/* -------- which -------- */

const struct sheet *const tolerance_sheets[] = {[TOLERANCE_SUMMARY] = &summary_sheet,
                                                [TOLERANCE_TRIALS] = &trial_sheet,
                                                [TOLERANCE_YIELD] = &yield_sheet,
                                                [TOLERANCE_SENSITIVITY] =
                                                    &tolerance_sensitivity_sheet,
                                                [TOLERANCE_INVERSE] = &tolerance_inverse_sheet,
                                                [TOLERANCE_OFFENDERS] = &tolerance_offenders_sheet,
                                                [TOLERANCE_SHOWS] = NULL};

bool tolerance_emit(struct tolerance_job *job, struct error *error)
{
    static bool (*const emits[])(struct tolerance_job *, struct error *) = {
        [TOLERANCE_SUMMARY] = emit_summaries,
        [TOLERANCE_TRIALS] = emit_trials,
        [TOLERANCE_YIELD] = emit_yields,
        [TOLERANCE_SENSITIVITY] = tolerance_emit_sensitivity,
        [TOLERANCE_INVERSE] = tolerance_emit_inverse,
        [TOLERANCE_OFFENDERS] = tolerance_emit_offenders,
    };
    return emits[job->input->show](job, error);
}
