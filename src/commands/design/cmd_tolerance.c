/* commands/design/cmd_tolerance.c - lenscalc tolerance: a lens as it may be made. */
/* SPDX-License-Identifier: MIT */
#include "base/parallel.h"
#include "commands/analysis/analysis_options.h"
#include "commands/design/design.h"
#include "commands/design/tolerance_job.h"
#include "draw/pareto.h"
#include "draw/tally_plot.h"
#include "file/lens_file.h"
#include "trace/aim/sample.h"

#include <math.h>
#include <string.h>

static const struct word shows[] = {
    [TOLERANCE_SUMMARY] = {"summary", "yield, mean, standard deviation and percentiles"},
    [TOLERANCE_TRIALS] = {"trials", "each lens that was made"},
    [TOLERANCE_YIELD] = {"yield", "the limits that 2 to 98 percent of the lenses meet"},
    [TOLERANCE_SENSITIVITY] = {"sensitivity", "the effect of each error alone, with both signs"},
    [TOLERANCE_INVERSE] = {"inverse", "tolerances that each cost the same, and together --drop"},
    [TOLERANCE_OFFENDERS] = {"offenders",
                             "what each error contributes to the spread, the worst first"},
    {NULL, NULL},
};

static const struct word methods[] = {
    [TOLERANCE_EXACT] = {"exact", "each lens by its rays"},
    [TOLERANCE_DIFFERENTIAL] = {"differential",
                                "to second order in all errors and their products, far faster"},
    {NULL, NULL},
};

static const struct word ofs[] = {
    [TOLERANCE_OF_WORST] = {"worst", "the worst of all fields and positions"},
    [TOLERANCE_OF_MEAN] = {"mean", "the mean of them, by the weights of the fields"},
    [TOLERANCE_OF_EACH] = {"each", "each by itself"},
    {NULL, NULL},
};

static const struct word refocuses[] = {
    [REFOCUS_NONE] = {"none", "the image plane stays where the nominal lens has it"},
    [REFOCUS_PARAXIAL] = {"paraxial", "refocused on the paraxial image"},
    [REFOCUS_BEST] = {"best", "refocused where spots or wave fronts of all fields are best"},
    {NULL, NULL},
};

static const struct word aims[] = {
    [TOLERANCE_AIM_NOMINAL] = {"nominal", "rays that enter the nominal lens"},
    [TOLERANCE_AIM_STOP] = {"stop", "aimed at the stop of every lens"},
    {NULL, NULL},
};

/* Rows of single errors take notice of no trials. */
#define FOR_TRIALS "show=summary|show=trials|show=yield"

static const struct option options[] = {
    LENS_OPTION(struct tolerance_input, question),
    {OPTION(struct tolerance_input, grade), .name = "grade", .value = "NAME",
     .help = "grade of manufacture: commercial, precision or high ('list tolerances'); default the "
             "tolerances in the lens, if it has none precision"},
    {OPTION(struct tolerance_input, tolerances), .name = "tolerances", .value = "FILE",
     .flags = OPTION_FILE,
     .help = "file with 'tolerance' lines as in a lens, used in place of the lens's own"},
    {OPTION(struct tolerance_input, criterion), .name = "criterion", .value = "WHAT",
     .fallback = "spot",
     .help = "spot, wavefront, mtf@40/mm, efl, bfl, distortion, boresight or color"},
    {OPTION(struct tolerance_input, of), .name = "of", .words = ofs, .fallback = "worst",
     .value = "WHICH", .wants = "show!=sensitivity", .help = "which fields and positions count"},
    {OPTION(struct tolerance_input, limit), .name = "limit", .value = "FIGURE",
     .help = "limit to pass: a maximum, of mtf a minimum, of efl and bfl a deviation; in the unit "
             "of the criterion, or with a unit: 12um"},
    {OPTION(struct tolerance_input, refocus), .name = "refocus", .words = refocuses,
     .fallback = "best", .value = "WHERE", .help = "the image plane of every lens"},
    {OPTION(struct tolerance_input, gap), .name = "gap", .value = "GAPS",
     .help = "compensator: gaps adjusted together in every lens: last, d5:-1, or with bounds "
             "'d5,10:-1 [-0.5,0.5]'"},
    {OPTION(struct tolerance_input, adjust), .name = "adjust", .value = "PARTS",
     .help = "further compensators: ax9,dx4[-1,1],t5, each with bounds"},
    {OPTION(struct tolerance_input, trials), .name = "trials", .lowest = 1, .highest = 1e9,
     .fallback = "1000", .value = "COUNT", .wants = FOR_TRIALS,
     .help = "Monte Carlo trials: number of lenses made"},
    {OPTION(struct tolerance_input, seed), .name = "seed", .lowest = 0, .highest = 1e9,
     .fallback = "0", .value = "NUMBER", .wants = FOR_TRIALS,
     .help = "seed of the perturbations; the rays stay the same"},
    {OPTION(struct tolerance_input, show), .name = "show", .words = shows, .fallback = "summary",
     .value = "WHAT", .help = "which rows"},
    {OPTION(struct tolerance_input, method), .name = "method", .words = methods,
     .fallback = "exact", .value = "HOW", .help = "how the perturbed lenses are evaluated"},
    {OPTION(struct tolerance_input, drop), .name = "drop", .value = "FIGURE",
     .help = "for --show inverse: allowed drop from the nominal lens, in the unit of the "
             "criterion, or with a unit"},
    {OPTION(struct tolerance_input, save), .name = "save", .value = "WHICH",
     .help = "lenses for --output: worst:3, or trial:17"},
    {OPTION(struct tolerance_input, aim), .name = "aim", .words = aims, .fallback = "nominal",
     .value = "WHERE", .help = "pupil sampling of the evaluation"},
    DESIGN_VIEW_OPTIONS(struct tolerance_input, "positions to evaluate"),
    DESIGN_RAYS_OPTIONS(struct tolerance_input, .fallback = "21",
                        .help = "approximate number of rays per field and wavelength"),
    {OPTION(struct tolerance_input, clip), .name = "clip", .excludes = "no-clip",
     .help = "only rays that pass the nominal lens (default, but not for mtf)"},
    {OPTION(struct tolerance_input, no_clip), .name = "no-clip",
     .help = "do not clip rays at clear apertures (default for mtf)"},
    {OPTION(struct tolerance_input, threads), .name = "threads", .lowest = 0,
     .highest = PARALLEL_MOST, .value = "N", .fallback = "1", .flags = OPTION_ASIDE,
     .wants = FOR_TRIALS, .help = "threads; 0 = one per core"},
    {OPTION(struct tolerance_input, part), .name = "part", .value = "I/N", .flags = OPTION_ASIDE,
     .wants = "output", .help = "only part I of N, into a .part for 'lenscalc merge'"},
};

static const struct sheet *tolerance_choose_sheet(const void *data,
                                                  const struct option_query *asking)
{
    (void)asking;
    return tolerance_sheets[((const struct tolerance_input *)data)->show];
}

static bool tolerance_command_run(const void *data, struct run *run, struct error *error)
{
    struct tolerance_job *job = ARENA_NEW(run->arena, struct tolerance_job);
    struct tolerance_input *input = ARENA_NEW(run->arena, struct tolerance_input);
    *input = *(const struct tolerance_input *)data; /* a sweep changes it */
    *job = (struct tolerance_job){.input = input, .run = run};
    run->state = job;
    return tolerance_job_run(job, error) && tolerance_emit(job, error);
}

/* -------- lenses as they may be made, and parts of a divided run -------- */

static const struct file_type *tolerance_types(size_t i)
{
    return i == 0 ? &lens_file_type : division_types(i - 1);
}

static bool is_part(const struct artifact_job *job)
{
    return job->type == division_types(0);
}

static size_t tolerance_count_output(const void *data)
{
    const struct tolerance_input *input = data;
    struct text rest = text_of(input->save != NULL ? input->save : "");
    const bool is_worst = text_equal(text_cut(&rest, ':'), "worst");
    double number = 1;
    struct error ignored;
    if (is_worst && rest.start != NULL &&
        !quantity_read(rest, &dimension_number, NULL, &number, NULL, &ignored)) {
        return 1;
    }
    const bool is_one = input->part.count > 0 || !is_worst || !(number >= 1);
    return is_one || number > TOLERANCE_WORST_MOST ? 1 : (size_t)number;
}

static bool tolerance_check_output(const struct artifact_job *job, struct error *error)
{
    const struct tolerance_input *input = job->inputs[0];
    if (job->run->parts != NULL && is_part(job)) {
        return fail(error, ERROR_USAGE, "a merged run is whole: %s is the name of a part",
                    job->path);
    }
    if (is_part(job) && input->show == TOLERANCE_TRIALS) {
        return fail(error, ERROR_USAGE,
                    "{--part} holds counts, not rows: {--show} trials is of a whole run");
    }
    if (is_part(job)) {
        return input->part.count > 0 ||
               fail(error, ERROR_USAGE, "%s is the name of a part: {--part} says of which",
                    job->path);
    }
    if (input->part.count > 0 && job->run->parts == NULL) {
        return fail(error, ERROR_USAGE,
                    "{--part} goes into a .part: lenses of {--save} are those that 'lenscalc "
                    "merge' writes, not %s",
                    job->path != NULL ? job->path : "");
    }
    return input->save != NULL ||
           fail(error, ERROR_USAGE, "{--output} %s needs {--save}, which says what is written",
                job->path != NULL ? job->path : "");
}

/* The lens of a trial, which is made once more. */
static bool save_trial(struct tolerance_job *job, uint64_t number, struct output *sink,
                       struct error *error)
{
    struct arena *arena = job->run->arena;
    struct tolerance *tolerance = &job->tolerance;
    const unsigned long long shown = (unsigned long long)number + 1, seed = job->trials.seed;
    double *errors = ARENA_ARRAY(arena, job->perturbations.count + 1, double);
    struct tolerance_trial trial = {.figures = ARENA_ARRAY(arena, tolerance->figure_count, double),
                                    .moves =
                                        ARENA_ARRAY(arena, tolerance_moves(tolerance), double)};
    tolerance_errors(&job->question, job->trials.seed, number, errors);
    if (!tolerance_trial(tolerance, errors, &trial)) {
        *error = trial.why;
        return error_prefix(error, "trial %llu has no figures: ", shown);
    }
    struct lens *lens = tolerance_lens(tolerance, &trial, arena);
    lens->tolerance_count = 0; /* it is made: nothing of it is uncertain */
    const struct criterion_type *type = criterion_type(job->question.criterion.kind);
    design_note(
        lens,
        arena_printf(arena, "as made in trial %llu of seed %llu: %s %.6g %s", shown, seed,
                     job->question.criterion.name,
                     type->scale * tolerance_judged(tolerance, job->trials.of, trial.figures),
                     type->unit),
        arena);
    /* what the figure is by, and what of the trial the lens cannot have */
    design_note(lens, arena_printf(arena, "that is by rays %s", tolerance_about_of(job).rays),
                arena);
    if (job->question.view.clip) {
        design_note(lens,
                    "and what the nominal lens lets through: this one does not quite the same",
                    arena);
    }
    if (tolerance->irregularity_count > 0) {
        design_note(lens, "without the irregularity of its surfaces, which is in that figure",
                    arena);
    }
    design_note_source(lens, "made after", arena);
    const struct text text = lens_write(lens, arena);
    output_text(sink, text.start, text.length);
    return true;
}

static bool tolerance_write_output(const struct artifact_job *asked, struct output *sink,
                                   struct error *error)
{
    struct tolerance_job *job = asked->run->state;
    if (is_part(asked)) {
        /* The part: what was counted of its trials. */
        struct arena *arena = job->run->arena;
        struct part_head head = job->head;
        head.done = job->result.done;
        division_write(&head, tolerance_result_write(&job->result, arena), arena, sink);
        return true;
    }
    if (job->save_trial > 0) {
        return save_trial(job, (uint64_t)job->save_trial - 1, sink, error);
    }
    for (size_t i = 0; i < asked->files; i++) {
        if (i >= job->result.worst_count) {
            sink[i].is_unused = true;
        } else if (!save_trial(job, job->result.worst[i].trial, &sink[i], error)) {
            return false;
        }
    }
    return job->result.worst_count > 0 ||
           fail(error, ERROR_DOMAIN, "{--save}: no trial has a figure");
}

/* -------- drawings -------- */

enum { BARS = 40, STEPS = 200, ROWS = 60 };

static bool tolerance_view_check(const struct artifact_job *job, struct error *error)
{
    const struct tolerance_input *input = job->inputs[0];
    const bool is_of_trials = input->show < TOLERANCE_SENSITIVITY;
    return !(is_of_trials && input->of == TOLERANCE_OF_EACH) ||
           fail(error, ERROR_USAGE,
                "{--plot} shows one figure of each lens: {--of} worst or {--of} mean");
}

static const char *title_of(const struct tolerance_job *job, const char *what)
{
    return arena_printf(job->run->arena, "%s of %s, %s", what, job->question.criterion.name,
                        job->lens->title);
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
    struct arena *arena = job->run->arena;
    const char *lenses =
        arena_printf(arena, "%llu lenses%s, ", (unsigned long long)job->result.done,
                     job->incomplete != NULL ? " (incomplete)" : "");
    double *counts = ARENA_ARRAY(arena, bins, double), sum = 0;
    double *yields = ARENA_ARRAY(arena, bins + 1, double);
    struct tally_plot plot = {.title = title_of(job, is_yield ? "Yield" : "Spread"),
                              .subtitle = tolerance_subtitle_of(job, lenses),
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
    /* marks in the unit of rows; a limit of what may depart to both sides has no place here */
    const double yield = 100 * (double)column->passed / (double)job->result.done;
    plot.nominal = is_plain ? type->scale * tally->nominal : NAN;
    plot.limit = type->sense == SENSE_LEAST || type->sense == SENSE_MOST || plot.is_curve
                     ? type->scale * job->limit
                     : NAN;
    plot.fails_above = type->sense != SENSE_MOST;
    plot.marks[0] = arena_printf(arena, "nominal %.4g", plot.nominal);
    plot.marks[1] = arena_printf(arena, "limit %.4g: %.3g %% pass", plot.limit, yield);
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
    const struct pareto pareto = {.title = title_of(job, "What makes the spread"),
                                  .subtitle = tolerance_subtitle_of(job, ""),
                                  .x_label = "share of the variance, mean of all fields",
                                  .part_name = "by itself",
                                  .whole_name = "with what it does together with others",
                                  .bars = bars,
                                  .count = count,
                                  .most = ROWS};
    return pareto_draw(&pareto, svg, error);
}

static bool tolerance_view_draw(const struct artifact_job *job, struct output *sink,
                                struct error *error)
{
    struct tolerance_job *done = job->run->state;
    struct svg svg = {.arena = job->run->arena};
    const int show = done->input->show;
    const bool draws = show >= TOLERANCE_SENSITIVITY
                           ? draw_offenders(done, &svg, error)
                           : draw_lenses(done, show == TOLERANCE_YIELD, &svg, error);
    return draws && drawing_write(job, &svg, sink, error);
}

static const struct artifact artifacts[] = {
    {ARTIFACT_OPTION("plot", drawing_types,
                     "draw a histogram, of yields their curve, of single errors their "
                     "contributions to the spread"),
     .scope = ARTIFACT_OF_ANSWER, .check = tolerance_view_check, .make = tolerance_view_draw},
    {.option = {.kind = &kind_text,
                .name = "output",
                .letter = 'o',
                .value = "FILE",
                .flags = OPTION_FILE,
                .types = tolerance_types,
                .help = "write the lens of --save (several: NAME-1.lens and on, from the worst), "
                        "or a .part of --part; rows go to standard output"},
     .is_kept = true,
     .count = tolerance_count_output,
     .check = tolerance_check_output,
     .make = tolerance_write_output},
};

static const struct explanation explanations[] = {
    {"mean",
     "every lens: numbers + half range x quantile of the distribution, evenly spread numbers by "
     "counting from seed, trial and error; s = -sum W b/sum W c of RMS^2 = a + 2 b s + c s^2, or "
     "damped least squares; then figures of exact rays",
     "[Salmon11]; derived in design/tolerance/tolerance_trial.h",
     "errors are independent of each other"},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"tolerance double-gauss --grade precision --limit 90um",
     "how many pass, and how the spots spread"},
    {"tolerance double-gauss --grade precision --show yield", "limits for yields"},
    {"tolerance double-gauss --grade high --criterion efl --limit 0.5mm", "the focal length"},
    {NULL, NULL},
};

static double tolerance_weight(const void *data)
{
    return (double)((const struct tolerance_input *)data)->trials;
}

const struct command command_tolerance = {
    .name = "tolerance",
    .group = "design",
    .summary = "Monte Carlo tolerances: will a built lens work; yield, percentiles",
    COMMAND_ASKS(struct tolerance_input),
    .choose_sheet = tolerance_choose_sheet,
    .sheets = tolerance_sheets,
    .makes_many = command_always_many,
    .run = tolerance_command_run,
    COMMAND_MAKES(artifacts),
    .explanations = explanations,
    .cell = "mean",
    .keeps_best = true,
    .weight = tolerance_weight,
    .is_divided = true,
};
