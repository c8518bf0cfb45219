/* design/tolerance/tolerance_run.c - many lenses as they may be made: what is counted of them. */
/* SPDX-License-Identifier: MIT */
#include "design/tolerance/tolerance_run.h"

#include "base/parallel.h"
#include "base/random.h"

#include <math.h>
#include <string.h>

/* -------- errors -------- */

void tolerance_errors(const struct tolerance_question *question, uint64_t seed, uint64_t trial,
                      double *errors)
{
    const size_t count = question->perturbation_count;
    for (size_t i = 0; i < count; i += 2) {
        const struct random_words words =
            random_words(RANDOM_TOLERANCES, seed, trial, (uint32_t)(i / 2));
        errors[i] = random_unit_of(words.w[0], words.w[1]);
        if (i + 1 < count) {
            errors[i + 1] = random_unit_of(words.w[2], words.w[3]);
        }
    }
    perturbation_errors(question->perturbations, count, errors, errors);
}

/* -------- what is judged -------- */

static double badness(const struct tolerance *tolerance, size_t figure, double value)
{
    return criterion_badness(tolerance->question.criterion.kind, value, tolerance->nominal[figure]);
}

/* The mean by the weights of the fields. */
static double mean_figure(const struct tolerance *tolerance, const double *figures)
{
    double sum = 0, weights = 0;
    for (size_t i = 0; i < tolerance->figure_count; i++) {
        const struct tolerance_figure *figure = &tolerance->figures[i];
        const double weight = figure->field != NULL ? figure->field->weight : 1;
        sum += weight * figures[i];
        weights += weight;
    }
    return sum / weights;
}

static size_t worst_figure(const struct tolerance *tolerance, const double *figures)
{
    size_t worst = 0;
    for (size_t i = 1; i < tolerance->figure_count; i++) {
        worst = badness(tolerance, i, figures[i]) > badness(tolerance, worst, figures[worst])
                    ? i
                    : worst;
    }
    return worst;
}

double tolerance_judged(const struct tolerance *tolerance, enum tolerance_of of,
                        const double *figures)
{
    return of == TOLERANCE_OF_MEAN ? mean_figure(tolerance, figures)
                                   : figures[worst_figure(tolerance, figures)];
}

/* How bad a lens is: by the figure of one column, or as a whole. */
static double column_badness(const struct tolerance *tolerance, enum tolerance_of of, size_t column,
                             const double *figures)
{
    if (of == TOLERANCE_OF_MEAN) {
        return criterion_badness(tolerance->question.criterion.kind,
                                 mean_figure(tolerance, figures),
                                 mean_figure(tolerance, tolerance->nominal));
    }
    const size_t at = of == TOLERANCE_OF_EACH ? column : worst_figure(tolerance, figures);
    return badness(tolerance, at, figures[at]);
}

bool tolerance_passes(const struct tolerance *tolerance, const struct tolerance_run *run,
                      size_t column, const double *figures)
{
    return criterion_passes(tolerance->question.criterion.kind,
                            column_badness(tolerance, run->of, column, figures), run->limit);
}

/* -------- counting -------- */

void tolerance_result_open(const struct tolerance_run *run, const struct tolerance *tolerance,
                           size_t worst, struct arena *arena, struct tolerance_result *result)
{
    const bool each = run->of == TOLERANCE_OF_EACH;
    *result = (struct tolerance_result){.tolerance = tolerance,
                                        .column_count = each ? tolerance->figure_count : 1,
                                        .worst_most = worst,
                                        .arena = arena};
    result->columns = ARENA_ARRAY(arena, result->column_count, struct tolerance_column);
    result->moves = ARENA_ARRAY(arena, tolerance_moves(tolerance), struct trial_statistics);
    result->worst = ARENA_ARRAY(arena, worst + 1, struct tolerance_worst);
    result->reasons = ARENA_ARRAY(arena, TOLERANCE_REASONS + 1, struct tolerance_reason);
    for (size_t i = 0; i < result->column_count; i++) {
        struct tolerance_column *column = &result->columns[i];
        column->of = each ? &tolerance->figures[i] : NULL;
        trial_statistics_open(each ? tolerance->nominal[i]
                                   : tolerance_judged(tolerance, run->of, tolerance->nominal),
                              run->total, arena, &column->tally);
        trial_statistics_open(column_badness(tolerance, run->of, i, tolerance->nominal), run->total,
                              arena, &column->badness);
    }
    for (size_t i = 0; i < tolerance_moves(tolerance); i++) {
        trial_statistics_open(tolerance->nominal_moves[i], run->total, arena, &result->moves[i]);
    }
}

static void keep_worst(struct tolerance_result *result, struct tolerance_worst one)
{
    size_t at = result->worst_count;
    while (at > 0 && (one.badness > result->worst[at - 1].badness ||
                      (one.badness == result->worst[at - 1].badness &&
                       one.trial < result->worst[at - 1].trial))) {
        at--;
    }
    if (at >= result->worst_most) {
        return;
    }
    const size_t last =
        result->worst_count < result->worst_most ? result->worst_count : result->worst_most - 1;
    memmove(&result->worst[at + 1], &result->worst[at], (last - at) * sizeof one);
    result->worst[at] = one;
    result->worst_count = last + 1;
}

static void add_reason(struct tolerance_reason *has, const struct tolerance_reason *one)
{
    has->first = has->count == 0 || one->first < has->first ? one->first : has->first;
    has->count += one->count;
}

/* Those whose words come first in the alphabet are kept, whatever came before: so the counts are
   the same for any threads and parts. */
static void keep_reason(struct tolerance_result *result, struct tolerance_reason one)
{
    size_t i = 0;
    int order = -1;
    while (i < result->reason_count && (order = strcmp(result->reasons[i].why, one.why)) < 0) {
        i++;
    }
    if (i < result->reason_count && order == 0) {
        add_reason(&result->reasons[i], &one);
        return;
    }
    if (i == TOLERANCE_REASONS) {
        add_reason(&result->others, &one);
        return;
    }
    if (result->reason_count == TOLERANCE_REASONS) {
        add_reason(&result->others, &result->reasons[--result->reason_count]);
    }
    memmove(&result->reasons[i + 1], &result->reasons[i], (result->reason_count - i) * sizeof one);
    one.why = arena_string(result->arena, one.why, strlen(one.why));
    result->reasons[i] = one;
    result->reason_count++;
}

/* -------- threads -------- */

/* What a thread has: opened when it takes its first piece. */
struct trial_worker {
    bool is_open;
    struct tolerance *tolerance; /* null: to second order, in */
    double *lanes;               /* errors, figures and movements */
    struct tolerance_result result;
    struct tolerance_trial trial;
    double *errors;
    struct error error;
};

struct tolerance_team {
    const struct tolerance_run *run;
    struct tolerance_result *result;
    struct trial_worker workers[PARALLEL_MOST];
    struct parallel threads;
    const struct tolerance_round *round;
};

/* A trial that was made. */
static void count_trial(const struct tolerance_team *team, struct trial_worker *worker, size_t at,
                        bool found)
{
    const struct tolerance_run *run = team->run;
    const struct tolerance_round *round = team->round;
    const struct tolerance *tolerance = team->result->tolerance;
    const struct tolerance_trial *trial = &worker->trial;
    struct tolerance_result *result = &worker->result;
    const uint64_t number = round->begin + at;
    const size_t moves = tolerance_moves(tolerance);
    if (round->trials != NULL) {
        struct tolerance_trial *kept = &round->trials[at];
        round->made[at] = true;
        round->found[at] = found;
        memcpy(kept->figures, trial->figures, tolerance->figure_count * sizeof(double));
        memcpy(kept->moves, trial->moves, moves * sizeof(double));
        kept->why = trial->why;
    }
    result->done++;
    if (!found) {
        result->failed++;
        keep_reason(result, (struct tolerance_reason){1, number, trial->why.message});
        return;
    }
    for (size_t i = 0; i < result->column_count; i++) {
        struct tolerance_column *column = &result->columns[i];
        const double bad = column_badness(tolerance, run->of, i, trial->figures);
        trial_statistics_add(&column->tally,
                             column->of != NULL
                                 ? trial->figures[i]
                                 : tolerance_judged(tolerance, run->of, trial->figures));
        trial_statistics_add(&column->badness, bad);
        column->passed += criterion_passes(run->question->criterion.kind, bad, run->limit) ? 1 : 0;
    }
    for (size_t i = 0; i < moves; i++) {
        trial_statistics_add(&result->moves[i], trial->moves[i]);
    }
    const enum tolerance_of whole = run->of == TOLERANCE_OF_EACH ? TOLERANCE_OF_WORST : run->of;
    keep_worst(result, (struct tolerance_worst){
                           number, column_badness(tolerance, whole, 0, trial->figures)});
}

/* A lens of its own; to second order none is needed. */
static bool worker_open(const struct tolerance_team *team, size_t thread, struct arena *arena,
                        struct trial_worker *worker)
{
    const struct tolerance *nominal = team->result->tolerance;
    const struct tolerance_run *run = team->run;
    const size_t figures = nominal->figure_count, moves = tolerance_moves(nominal);
    const size_t errors = run->question->perturbation_count;
    if (run->differential != NULL) {
        worker->lanes = ARENA_ARRAY(arena, SECOND_ORDER_LANES * (errors + figures + moves), double);
    } else if (thread == 0 && run->ready != NULL) {
        worker->tolerance = run->ready;
    } else {
        struct tolerance_question question = *run->question;
        question.view.watch = NULL; /* that counts trials */
        worker->tolerance = ARENA_NEW(arena, struct tolerance);
        if (!tolerance_open(&question, arena, worker->tolerance, &worker->error)) {
            return false;
        }
    }
    tolerance_result_open(run, nominal, team->result->worst_most, arena, &worker->result);
    worker->trial.figures = ARENA_ARRAY(arena, figures, double);
    worker->trial.moves = ARENA_ARRAY(arena, moves, double);
    worker->errors = ARENA_ARRAY(arena, errors + 1, double);
    worker->is_open = true;
    return true;
}

/* SECOND_ORDER_LANES of them at most; a lane that nobody asked for has no errors. */
static void run_second_order(const struct tolerance_team *team, struct trial_worker *worker,
                             size_t begin, size_t end)
{
    enum { LANES = SECOND_ORDER_LANES };
    const struct tolerance_run *run = team->run;
    const size_t n = run->question->perturbation_count;
    const size_t figures = team->result->tolerance->figure_count;
    const size_t moves = tolerance_moves(team->result->tolerance);
    double *errors = worker->lanes, *results = errors + n * LANES;
    memset(errors, 0, n * LANES * sizeof *errors);
    for (size_t at = begin; at < end; at++) {
        tolerance_errors(run->question, run->seed, team->round->begin + at, worker->errors);
        for (size_t i = 0; i < n; i++) {
            errors[i * LANES + at - begin] = worker->errors[i];
        }
    }
    second_order_trials(run->differential, errors, results);
    for (size_t at = begin; at < end; at++) {
        for (size_t f = 0; f < figures; f++) {
            worker->trial.figures[f] = results[f * LANES + at - begin];
        }
        for (size_t m = 0; m < moves; m++) {
            worker->trial.moves[m] = results[(figures + m) * LANES + at - begin];
        }
        count_trial(team, worker, at, true);
    }
}

/* parallel_work: some trials, until the watch stops them. */
static void run_trials(void *context, const struct parallel_piece *piece)
{
    struct tolerance_team *team = context;
    struct trial_worker *worker = &team->workers[piece->thread];
    const struct tolerance_run *run = team->run;
    const size_t step = run->differential != NULL ? SECOND_ORDER_LANES : 1;
    if (worker->error.code != ERROR_NONE || !watch_add(run->watch, piece->end - piece->begin) ||
        (!worker->is_open && !worker_open(team, piece->thread, piece->arena, worker))) {
        return;
    }
    for (size_t at = piece->begin; at < piece->end; at += step) {
        if (run->differential != NULL) {
            run_second_order(team, worker, at, at + step < piece->end ? at + step : piece->end);
            continue;
        }
        tolerance_errors(run->question, run->seed, team->round->begin + at, worker->errors);
        count_trial(team, worker, at,
                    tolerance_trial(worker->tolerance, worker->errors, &worker->trial));
    }
}

struct tolerance_team *tolerance_team_open(const struct tolerance_run *run,
                                           struct tolerance_result *result)
{
    struct tolerance_team *team = ARENA_NEW(result->arena, struct tolerance_team);
    team->run = run;
    team->result = result;
    team->threads.threads = run->threads;
    return team;
}

bool tolerance_team_round(struct tolerance_team *team, const struct tolerance_round *round,
                          struct error *error)
{
    enum { PIECE = 8, MANY = 500 }; /* rays of large pieces take long, and are to stop soon */
    const size_t exact = team->run->question->view.rays < MANY ? PIECE : 1;
    const size_t piece = team->run->differential != NULL ? SECOND_ORDER_LANES : exact;
    team->round = round;
    parallel_pieces(&team->threads, round->count, piece, run_trials, team);
    for (size_t i = 0; i < PARALLEL_MOST; i++) {
        if (team->workers[i].error.code != ERROR_NONE) {
            *error = team->workers[i].error;
            return false;
        }
    }
    return true;
}

void tolerance_team_close(struct tolerance_team *team)
{
    struct tolerance_result *result = team->result;
    for (size_t k = 0; k < PARALLEL_MOST; k++) {
        const struct tolerance_result *more = &team->workers[k].result;
        if (!team->workers[k].is_open || team->workers[k].error.code != ERROR_NONE) {
            continue;
        }
        result->done += more->done;
        result->failed += more->failed;
        for (size_t i = 0; i < result->column_count; i++) {
            trial_statistics_join(&result->columns[i].tally, &more->columns[i].tally);
            trial_statistics_join(&result->columns[i].badness, &more->columns[i].badness);
            result->columns[i].passed += more->columns[i].passed;
        }
        for (size_t i = 0; i < tolerance_moves(result->tolerance); i++) {
            trial_statistics_join(&result->moves[i], &more->moves[i]);
        }
        for (size_t i = 0; i < more->worst_count; i++) {
            keep_worst(result, more->worst[i]);
        }
        for (size_t i = 0; i < more->reason_count; i++) {
            keep_reason(result, more->reasons[i]);
        }
        if (more->others.count > 0) {
            add_reason(&result->others, &more->others);
        }
    }
    parallel_free(&team->threads);
}

bool tolerance_run(const struct tolerance_run *run, struct tolerance_result *result,
                   struct error *error)
{
    struct tolerance_team *team = tolerance_team_open(run, result);
    const struct tolerance_round round = {.begin = run->begin,
                                          .count = (size_t)(run->end - run->begin)};
    const bool done = tolerance_team_round(team, &round, error);
    tolerance_team_close(team);
    return done;
}

/* -------- lines -------- */

/* Of the first line: of trials, of what follows, and the other reasons. */
enum { HEAD_NUMBERS = 6 };

struct text tolerance_result_write(const struct tolerance_result *result, struct arena *arena)
{
    const uint64_t head[HEAD_NUMBERS] = {result->done,         result->failed,
                                         result->worst_count,  result->reason_count,
                                         result->others.count, result->others.first};
    struct text_buffer text = {.arena = arena};
    for (size_t i = 0; i < HEAD_NUMBERS; i++) {
        growing_format(&text, "%lld%c", (long long)head[i], i + 1 < HEAD_NUMBERS ? ' ' : '\n');
    }
    for (size_t i = 0; i < result->worst_count; i++) {
        int64_t bits;
        memcpy(&bits, &result->worst[i].badness, sizeof bits);
        growing_format(&text, "%lld %lld\n", (long long)result->worst[i].trial, (long long)bits);
    }
    for (size_t i = 0; i < result->reason_count; i++) {
        const struct tolerance_reason *reason = &result->reasons[i];
        growing_format(&text, "%lld %lld %s\n", (long long)reason->count, (long long)reason->first,
                       reason->why);
    }
    for (size_t i = 0; i < result->column_count; i++) {
        growing_format(&text, "%lld\n", (long long)result->columns[i].passed);
        trial_statistics_write(&result->columns[i].tally, &text);
        trial_statistics_write(&result->columns[i].badness, &text);
    }
    for (size_t i = 0; i < tolerance_moves(result->tolerance); i++) {
        trial_statistics_write(&result->moves[i], &text);
    }
    return growing_done(&text);
}

static bool take_numbers(struct text *line, uint64_t *numbers, size_t count)
{
    bool took = true;
    for (size_t i = 0; i < count && took; i++) {
        int64_t number;
        took = trial_statistics_take(line, &number);
        numbers[i] = (uint64_t)number;
    }
    return took;
}

bool tolerance_result_read(struct text body, struct tolerance_result *result)
{
    struct text rest = body, line = text_cut(&rest, '\n');
    uint64_t head[HEAD_NUMBERS], one[2];
    bool read = take_numbers(&line, head, HEAD_NUMBERS);
    if (!read) {
        return false;
    }
    result->done += head[0];
    result->failed += head[1];
    for (uint64_t i = 0; i < head[2] && read; i++) {
        struct tolerance_worst worst;
        line = text_cut(&rest, '\n');
        read = take_numbers(&line, one, 2);
        if (read) {
            worst.trial = one[0];
            memcpy(&worst.badness, &one[1], sizeof one[1]);
            keep_worst(result, worst);
        }
    }
    for (uint64_t i = 0; i < head[3] && read; i++) {
        line = text_cut(&rest, '\n');
        read = take_numbers(&line, one, 2) && line.start != NULL;
        if (read) {
            const char *why = arena_string(result->arena, line.start, line.length);
            keep_reason(result, (struct tolerance_reason){one[0], one[1], why});
        }
    }
    if (read && head[4] > 0) {
        add_reason(&result->others, &(struct tolerance_reason){.count = head[4], .first = head[5]});
    }
    for (size_t i = 0; i < result->column_count && read; i++) {
        struct tolerance_column *column = &result->columns[i];
        line = text_cut(&rest, '\n');
        read = take_numbers(&line, one, 1) && trial_statistics_read(&rest, &column->tally) &&
               trial_statistics_read(&rest, &column->badness);
        column->passed += read ? one[0] : 0;
    }
    for (size_t i = 0; i < tolerance_moves(result->tolerance) && read; i++) {
        read = trial_statistics_read(&rest, &result->moves[i]);
    }
    return read;
}
