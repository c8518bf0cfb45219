/* commands/design/cmd_tolerance.c - lenscalc tolerance: a lens as it may be made. */
/* SPDX-License-Identifier: MIT */
#include "base/parallel.h"
#include "commands/analysis/analysis_options.h"
#include "commands/design/tolerance_job.h"
#include "trace/aim/sample.h"

static const struct word shows[] = {
    [TOLERANCE_SUMMARY] = {"summary", "yield, mean, deviation and percentiles"},
    [TOLERANCE_TRIALS] = {"trials", "each lens that was made"},
    [TOLERANCE_YIELD] = {"yield", "the limits that 2 to 98 percent of the lenses keep"},
    [TOLERANCE_SENSITIVITY] = {"sensitivity", "what each error does alone, with both signs"},
    [TOLERANCE_INVERSE] = {"inverse", "tolerances that cost the same each, and --drop together"},
    [TOLERANCE_OFFENDERS] = {"offenders", "which errors make the figures spread, the worst first"},
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
    [TOLERANCE_OF_MEAN] = {"mean", "their mean, by the weights of the fields"},
    [TOLERANCE_OF_EACH] = {"each", "each by itself"},
    {NULL, NULL},
};

static const struct word refocuses[] = {
    [REFOCUS_NONE] = {"none", "the image plane stays where the nominal lens has it"},
    [REFOCUS_PARAXIAL] = {"paraxial", "it goes to the paraxial image"},
    [REFOCUS_BEST] = {"best", "to where spots or wave fronts of all fields are best"},
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
     .help = "how well it is made: commercial, precision or high ('list tolerances'); without it "
             "the marks of the lens, without any precision"},
    {OPTION(struct tolerance_input, tolerances), .name = "tolerances", .value = "FILE",
     .flags = OPTION_FILE, .help = "lines like those with 'tolerance' in a lens, in its place"},
    {OPTION(struct tolerance_input, criterion), .name = "criterion", .value = "WHAT",
     .fallback = "spot",
     .help = "spot, wavefront, mtf@40/mm, efl, bfl, distortion, boresight or color"},
    {OPTION(struct tolerance_input, of), .name = "of", .words = ofs, .fallback = "worst",
     .value = "WHICH", .wants = "show!=sensitivity", .help = "of which fields and positions"},
    {OPTION(struct tolerance_input, limit), .name = "limit", .value = "FIGURE",
     .help = "what passes: up to so much, of mtf at least, of efl and bfl so far off; in the unit "
             "of the criterion, or with one: 12um"},
    {OPTION(struct tolerance_input, refocus), .name = "refocus", .words = refocuses,
     .fallback = "best", .value = "WHERE", .help = "the image plane of every lens"},
    {OPTION(struct tolerance_input, gap), .name = "gap", .value = "GAPS",
     .help = "gaps that are adjusted in every lens, together: last, d5:-1, 'd5,10:-1 [-0.5,0.5]' "
             "with how far they may go"},
    {OPTION(struct tolerance_input, adjust), .name = "adjust", .value = "PARTS",
     .help = "what else is adjusted: ax9,dx4[-1,1],t5, each with bounds"},
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
     .help = "for --show inverse: how much worse than the nominal lens the others may be, in the "
             "unit of the criterion, or with one"},
    {OPTION(struct tolerance_input, save), .name = "save", .value = "WHICH",
     .help = "lenses for --output: worst:3, or trial:17"},
    {OPTION(struct tolerance_input, aim), .name = "aim", .words = aims, .fallback = "nominal",
     .value = "WHERE", .help = "pupil sampling of the evaluation"},
    {OPTION(struct tolerance_input, waves), .name = "wavelength", .letter = 'w',
     .dimension = &dimension_wavelength_um, .unit = "nm", .value = "WAVES",
     .help = "the wavelengths that count, each with a weight: d:1,F:0.5; otherwise those of the "
             "lens"},
    LENS_FIELDS_OPTION(struct tolerance_input, question),
    {OPTION(struct tolerance_input, question.position), .name = "position", .value = "NAMES",
     .help = "positions that are evaluated; default all"},
    LENS_FNUMBER_OPTION(struct tolerance_input, question),
    LENS_SECTION_OPTION(struct tolerance_input, question),
    {OPTION(struct tolerance_input, pattern), .name = "pattern", .words = patterns,
     .fallback = "gauss", .value = "PATTERN", .help = "sampling pattern of the pupil"},
    {OPTION(struct tolerance_input, rays), .name = "rays", .lowest = 1, .highest = 1e5,
     .fallback = "21", .value = "COUNT",
     .help = "approximate number of rays per field and wavelength"},
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

static const struct artifact artifacts[] = {
    {ARTIFACT_OPTION("plot", drawing_types,
                     "draw a histogram, of yields their curve, of single errors who makes the "
                     "figures spread"),
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
