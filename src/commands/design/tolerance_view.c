/* commands/design/tolerance_view.c - the drawings of lenscalc tolerance. */
/* SPDX-License-Identifier: MIT */
#include "commands/design/tolerance_job.h"

#include "draw/pareto.h"
#include "draw/tally_plot.h"

#include <math.h>

enum { BARS = 40, STEPS = 200, ROWS = 60 };

bool tolerance_view_check(const struct artifact_job *job, struct error *error)
{
    const struct tolerance_input *input = job->inputs[0];
    const bool is_of_trials = input->show < TOLERANCE_SENSITIVITY;
    return !(is_of_trials && input->of == TOLERANCE_OF_EACH) ||
           fail(error, ERROR_USAGE,
                "{--plot} shows one figure of each lens: {--of} worst or {--of} mean");
}

static const char *title_of(const struct tolerance_job *job, const char *what)
{
    return arena_printf(job->run->arena, "%s: %s of %s", job->lens->title, what,
                        job->question.criterion.name);
}

static const char *tolerance_subtitle_of(const struct tolerance_job *job, const char *which)
{
    const struct tolerance_about about = tolerance_about_of(job);
    return arena_printf(job->run->arena, "%s%s, adjusted: %s", which, about.tolerances,
                        about.adjusted);
}

/* Of the figure of each lens. */
static const char *tolerance_label_of(const struct tolerance_job *job, const char *what)
{
    const struct criterion_type *type = criterion_type(job->question.criterion.kind);
    const bool has_unit = type->unit != NULL && *type->unit != '\0';
    const char *of = job->trials.of == TOLERANCE_OF_MEAN ? "mean" : "worst";
    return has_unit ? arena_printf(job->run->arena, "%s%s, %s field (%s)", what,
                                   job->question.criterion.name, of, type->unit)
                    : arena_printf(job->run->arena, "%s%s, %s field", what,
                                   job->question.criterion.name, of);
}

/* The marks, in the unit of rows; a limit of what may depart to both sides has no place here. */
static void tolerance_view_mark(const struct tolerance_job *job, double nominal,
                                struct tally_plot *plot)
{
    const struct tolerance_column *column = &job->result.columns[0];
    const struct criterion_type *type = criterion_type(job->question.criterion.kind);
    const double yield = 100 * (double)column->passed / (double)job->result.done;
    struct arena *arena = job->run->arena;
    plot->nominal = nominal;
    plot->limit = type->sense == SENSE_LEAST || type->sense == SENSE_MOST || plot->is_curve
                      ? type->scale * job->limit
                      : NAN;
    plot->fails_above = type->sense != SENSE_MOST;
    plot->marks[0] = arena_printf(arena, "nominal %.4g", nominal);
    plot->marks[1] = arena_printf(arena, "limit %.4g: %.3g %% pass", plot->limit, yield);
}

static const char *lenses_of(const struct tolerance_job *job)
{
    return arena_printf(job->run->arena, "%llu lenses%s, ", (unsigned long long)job->result.done,
                        job->incomplete != NULL ? " (incomplete)" : "");
}

/* A histogram of the figures, or how many pass a limit: those below it, or of contrasts those
   above; of departures their size. */
static bool draw_lenses(struct tolerance_job *job, bool is_yield, struct svg *svg,
                        struct error *error)
{
    const struct criterion_type *type = criterion_type(job->question.criterion.kind);
    const bool is_plain = !is_yield || type->sense == SENSE_LEAST || type->sense == SENSE_MOST;
    struct tolerance_column *column = &job->result.columns[0];
    struct trial_statistics *tally = is_plain ? &column->tally : &column->badness;
    const size_t bins = is_yield ? STEPS : BARS;
    double *counts = ARENA_ARRAY(job->run->arena, bins, double), sum = 0;
    double *yields = ARENA_ARRAY(job->run->arena, bins + 1, double);
    struct tally_plot plot = {.title = title_of(job, is_yield ? "yield" : "spread"),
                              .subtitle = tolerance_subtitle_of(job, lenses_of(job)),
                              .x_label = tolerance_label_of(job, is_yield ? "limit of " : ""),
                              .y_label = is_yield ? "lenses that pass (%)" : "lenses",
                              .low = type->scale * tally->lowest,
                              .high = type->scale * tally->highest,
                              .values = is_yield ? yields : counts,
                              .count = bins,
                              .is_curve = is_yield};
    if (tally->count > 0) {
        trial_statistics_histogram(tally, tally->lowest, tally->highest, bins, counts);
    }
    for (size_t i = 0; i <= bins; i++) {
        const double pass = type->sense == SENSE_MOST ? (double)tally->count - sum : sum;
        yields[i] = 100 * pass / (double)job->result.done;
        sum += i < bins ? counts[i] : 0;
    }
    tolerance_view_mark(job, is_plain ? type->scale * tally->nominal : NAN, &plot);
    return tally_plot_draw(&plot, svg, error);
}

static bool draw_offenders(struct tolerance_job *job, struct svg *svg, struct error *error)
{
    const size_t count = job->question.perturbation_count;
    struct tolerance_offender *offenders;
    struct pareto_bar *bars = ARENA_ARRAY(job->run->arena, count + 1, struct pareto_bar);
    if (!tolerance_offenders(job, &offenders, error)) {
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        bars[i] = (struct pareto_bar){job->question.perturbations[offenders[i].perturbation].name,
                                      offenders[i].share.first, offenders[i].share.total};
    }
    const struct pareto pareto = {.title = title_of(job, "who makes the spread"),
                                  .subtitle = tolerance_subtitle_of(job, ""),
                                  .x_label = "share of the variance, mean of all fields",
                                  .part_name = "by itself",
                                  .whole_name = "with what it does together with others",
                                  .bars = bars,
                                  .count = count,
                                  .most = ROWS};
    return pareto_draw(&pareto, svg, error);
}

bool tolerance_view_draw(const struct artifact_job *job, struct output *sink, struct error *error)
{
    struct tolerance_job *done = job->run->state;
    struct svg svg = {.arena = job->run->arena};
    const int show = done->input->show;
    const bool draws = show >= TOLERANCE_SENSITIVITY
                           ? draw_offenders(done, &svg, error)
                           : draw_lenses(done, show == TOLERANCE_YIELD, &svg, error);
    return draws && drawing_write(job, &svg, sink, error);
}
