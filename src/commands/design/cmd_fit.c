/* commands/design/cmd_fit.c - lenscalc fit: thick lenses from exact rays, glasses from indices. */
/* SPDX-License-Identifier: MIT */
#include "commands/design/fit.h"
#include "data/index_table.h"
#include "data/whole_file.h"
#include "design/fit/dispersion.h"
#include "file/lens_file.h"
#include "report/output.h"
#include "trace/aim/sample.h"

#include <string.h>

/* -------- a dispersion formula from measured indices -------- */

static const enum glass_formula formulas[] = {GLASS_SELLMEIER, GLASS_SCHOTT, GLASS_CAUCHY,
                                              GLASS_BUCHDAHL, GLASS_CONRADY};
static const struct word fit_formulas[] = {
    {"sellmeier", "n^2 = 1 + sum B l^2/(l^2 - C)"},
    {"schott", "n^2 = a0 + a1 l^2 + a2/l^2 + a3/l^4 + a4/l^6 + a5/l^8"},
    {"cauchy", "n = A + B/l^2 + C/l^4 + .."},
    {"buchdahl", "n = n0 + v1 w + v2 w^2 + .., w = (l - ld)/(1 + 2.5 (l - ld))"},
    {"conrady", "n = n0 + A/l + B/l^3.5"},
    {NULL, NULL},
};

struct fit_glass_row {
    const char *formula, *coefficients, *status;
    double rms, largest;
    double from, to; /* um */
    double nd, Vd;
    long indices, iterations;
};

#define PLAIN(S, member_name) COLUMN(S, member_name), .flags = COLUMN_BRIEF

static const struct column glass_columns[] = {
    {COLUMN_NAMED(struct fit_glass_row, formula, COLUMN_BRIEF),
     .help = "form of the dispersion, l in um"},
    {COLUMN_NAMED(struct fit_glass_row, coefficients, COLUMN_BRIEF),
     .help = "in the order of the formula, as catalogues have them"},
    {COLUMN_NAMED(struct fit_glass_row, from, COLUMN_BRIEF | COLUMN_ECHO),
     .dimension = &dimension_wavelength_um, .unit = "nm", .help = "shortest measured wavelength"},
    {COLUMN_NAMED(struct fit_glass_row, to, COLUMN_BRIEF | COLUMN_ECHO),
     .dimension = &dimension_wavelength_um, .unit = "nm",
     .help = "longest measured wavelength: the formula holds between the two"},
    {PLAIN(struct fit_glass_row, rms), .name = "rms", .label = "error of the index, rms",
     .help = "difference from the measured indices, root mean square"},
    {PLAIN(struct fit_glass_row, largest), .name = "largest", .label = "largest error",
     .help = "the largest of these differences"},
    {COLUMN_NAMED(struct fit_glass_row, nd, 0), .digits = 7,
     .help = "index at the d line; absent where the range does not reach"},
    {COLUMN(struct fit_glass_row, Vd), .name = "vd", .label = "Vd", .help = "Abbe number"},
    {COLUMN(struct fit_glass_row, indices), .name = "indices", .label = "measured indices",
     .help = "how many there are"},
    {COLUMN_NAMED(struct fit_glass_row, iterations, 0),
     .help = "of the solver, from the best start"},
    {COLUMN_NAMED(struct fit_glass_row, status, 0),
     .help = "converged, or why the fit ended otherwise"},
};

static const struct sheet fit_glass_sheet = SHEET(glass_columns, struct fit_glass_row);

struct index_row {
    double wavelength; /* um */
    double measured, fitted, residual;
};

static const struct column index_columns[] = {
    {COLUMN_NAMED(struct index_row, wavelength, COLUMN_BRIEF | COLUMN_ECHO),
     .dimension = &dimension_wavelength_um, .unit = "nm", .help = "wavelength"},
    {COLUMN_NAMED(struct index_row, measured, COLUMN_BRIEF), .digits = 8, .help = "measured index"},
    {PLAIN(struct index_row, fitted), .name = "index", .digits = 8, .label = "index",
     .help = "index by the formula"},
    {COLUMN_NAMED(struct index_row, residual, COLUMN_BRIEF),
     .help = "index by the formula less the measured one"},
};

static const struct sheet fit_index_sheet = SHEET(index_columns, struct index_row);

/* "1.03961212 0.00600069867 .." */
static const char *coefficients_of(const struct glass *glass, struct arena *arena)
{
    const char *all = "";
    for (size_t i = 0; i < glass->count; i++) {
        char number[NUMBER_LENGTH];
        char *end = number_write_shortest(number, glass->coefficients[i].hi);
        all = arena_printf(arena, "%s%s%.*s", all, i > 0 ? " " : "", (int)(end - number), number);
    }
    return all;
}

static bool fit_glass(const struct fit_input *input, struct run *run, struct error *error)
{
    struct index_table table;
    struct dispersion_fit *fit = ARENA_NEW(run->arena, struct dispersion_fit);
    struct text content;
    if (!whole_file(input->glass, run->arena, &content, error)) {
        return error->code != ERROR_NONE
                   ? false
                   : fail(error, ERROR_IO, "cannot read %s: there is no such file", input->glass);
    }
    if (!index_table_read(run->db, input->glass, content, run->arena, &table, error)) {
        return false;
    }
    const struct dispersion_data data = {table.count, table.wavelength, table.index,
                                         table.deviation};
    const size_t terms = input->terms > 0 ? (size_t)input->terms : 0;
    if (!dispersion_fit(&data, formulas[input->formula], terms, run->arena, fit, error)) {
        return false;
    }
    if (input->show == FIT_ANSWER) {
        const struct glass_summary summary = glass_summary(&fit->glass);
        const struct fit_glass_row row = {.formula = glass_formula_name(fit->glass.formula),
                                          .coefficients = coefficients_of(&fit->glass, run->arena),
                                          .status = fit_status(&fit->summary),
                                          .rms = fit->rms,
                                          .largest = fit->largest,
                                          .from = fit->glass.shortest,
                                          .to = fit->glass.longest,
                                          .nd = summary.nd,
                                          .Vd = summary.Vd,
                                          .indices = (long)table.count,
                                          .iterations = fit->summary.iterations};
        run_emit(run, &row);
    } else if (input->show == FIT_RESIDUALS) {
        bool goes_on = true;
        for (size_t i = 0; i < table.count && goes_on; i++) {
            const struct index_row row = {table.wavelength[i], table.index[i],
                                          table.index[i] + fit->residuals[i], fit->residuals[i]};
            goes_on = run_emit(run, &row);
        }
    } else {
        fit_emit(NULL, fit->parameter_count, fit->names, fit->parameters, &fit->summary,
                 (enum fit_show)input->show, run);
    }
    run->state = fit;
    return true;
}

/* A catalogue of one glass, for DIR/glass/NAME.tsv of --lensdb DIR. */
static bool fit_save_glass(const struct artifact_job *job, struct output *sink, struct error *error)
{
    const struct fit_input *input = job->inputs[0];
    const struct dispersion_fit *fit = job->run->state;
    (void)error;
    output_string(
        sink,
        arena_printf(
            job->run->arena,
            "# fitted by lenscalc to the measured indices of %s: rms %.3g, largest %.3g\n"
            "name\tformula\tcoefficients\tfrom_um\tto_um\tsource\n"
            "%s\t%s\t%s\t%.10g\t%.10g\tfitted to %s\n",
            input->glass, fit->rms, fit->largest, input->name != NULL ? input->name : "FITTED",
            glass_formula_name(fit->glass.formula), coefficients_of(&fit->glass, job->run->arena),
            fit->glass.shortest, fit->glass.longest, input->glass));
    return true;
}

/* -------- the command -------- */

static const struct word shows[] = {
    [FIT_ANSWER] = {"answer", "what was found, one row per lens or glass"},
    [FIT_PARAMETERS] = {"parameters", "each parameter with its standard error"},
    [FIT_CORRELATIONS] = {"correlations", "each pair of parameters"},
    [FIT_RESIDUALS] = {"residuals", "each ray or measured index: where the fit fails"},
    [FIT_MODELS] = {"models", "the fitted lens and simpler models beside each other"},
    [FIT_MATRIX] = {"matrix", "the thick lens as a 4x4 matrix"},
    {NULL, NULL},
};

static const struct word matches[] = {
    [FIT_IMAGE] = {"image", "focus, then image height; the exit pupil settles the rest"},
    [FIT_RAYS] = {"rays", "position and direction: distances in image and exit pupil alike"},
    {NULL, NULL},
};

/* What is for the rays that the thick lens is fitted to. */
#define OF_RAYS "field distortion chromatic match pattern rays seed clip no-clip"

static const struct option options[] = {
    LENS_OPTION(struct fit_input, question),
    {OPTION(struct fit_input, show), .name = "show", .words = shows, .fallback = "answer",
     .value = "WHAT", .help = "which rows"},
    LENS_FIELDS_OPTION(struct fit_input, question),
    LENS_FNUMBER_OPTION(struct fit_input, question),
    {OPTION(struct fit_input, object), .name = "object", .column = "object",
     .dimension = &dimension_length, .unit = "mm", .lowest = 0, .highest = INFINITY,
     .flags = OPTION_ABOVE_LOWEST, .value = "LENGTH",
     .help = "distance of the object from the first vertex, in place of the lens's"},
    LENS_WAVELENGTH_OPTION(struct fit_input, question, LENS_ALL_WAVELENGTHS),
    LENS_POSITION_OPTION(struct fit_input, question),
    LENS_SECTION_OPTION(struct fit_input, question),
    {OPTION(struct fit_input, distortion), .name = "distortion", .dimension = &dimension_number,
     .lowest = 0, .highest = 3, .value = "TERMS",
     .help = "terms of distortion to fit; usually half as many as there are fields off the axis, "
             "at most 3; with 0 the focal length absorbs it"},
    {OPTION(struct fit_input, chromatic), .name = "chromatic", .excludes = "wavelength",
     .help = "f, H and H' of each wavelength instead of one lens for all"},
    {OPTION(struct fit_input, match), .name = "match", .words = matches, .fallback = "image",
     .value = "WHAT", .help = "what is minimised"},
    {OPTION(struct fit_input, pattern), .name = "pattern", .words = patterns, .fallback = "gauss",
     .value = "PATTERN", .help = "rays of each field"},
    {OPTION(struct fit_input, rays), .name = "rays", .lowest = 1, .highest = 1e5, .fallback = "72",
     .column = "rays_wanted", .value = "COUNT",
     .help = "approximate number of rays per field: the pattern takes the next possible number"},
    {OPTION(struct fit_input, seed), .name = "seed", .lowest = 0, .highest = 1e9, .fallback = "0",
     .value = "NUMBER", .wants = "pattern=sobol", .help = "seed of the sobol pattern"},
    {OPTION(struct fit_input, clip), .name = "clip", .excludes = "no-clip",
     .help = "clip rays at apertures and stop (default)"},
    {OPTION(struct fit_input, no_clip), .name = "no-clip",
     .help = "do not clip rays at clear apertures"},
    {OPTION(struct fit_input, goals), .name = "prescription", .value = "GOALS",
     .excludes = "glass aperture object section " OF_RAYS,
     .help = "adjust the lens until it has the measured values: efl=50.2,bfl@F=38.1:0.02, ffl, "
             "length, height@10deg=8.8; the standard deviation follows a colon, otherwise 0.01 mm"},
    {OPTION(struct fit_input, vary), .name = "vary", .value = "PARTS", .wants = "prescription",
     .help = "variables: R1,t3[2,10],n2 (radius, gap, index, with bounds); otherwise the marks R~ "
             "and t~ in the lens"},
    {OPTION(struct fit_input, glass), .name = "glass", .value = "FILE", .flags = OPTION_FILE,
     .excludes = "lens " OF_RAYS " aperture object wavelength position section",
     .help = "fit a dispersion formula to the measured indices of FILE (csv or tsv: wavelength_nm "
             "or wavelength_um, index, perhaps deviation)"},
    {OPTION(struct fit_input, formula), .name = "formula", .words = fit_formulas,
     .fallback = "sellmeier", .value = "FORMULA", .wants = "glass",
     .help = "form of the dispersion"},
    {OPTION(struct fit_input, terms), .name = "terms", .dimension = &dimension_number, .lowest = 1,
     .highest = 7, .value = "COUNT", .wants = "glass",
     .help = "resonances of sellmeier (usually 3), coefficients of cauchy (3) or buchdahl (4)"},
    {OPTION(struct fit_input, name), .name = "name", .value = "NAME", .wants = "output",
     .help = "name of the glass in the file that is written"},
};

static const struct file_type glass_type = {{"tsv", "glass catalogue"}, ".tsv"};

/* What is fitted. */
static const struct fit_kind {
    const char *name;
    bool (*run)(const struct fit_input *input, struct run *run, struct error *error);
    bool (*save)(const struct artifact_job *job, struct output *sink, struct error *error);
    const struct file_type *type;          /* of what is saved */
    const struct sheet *sheets[FIT_SHOWS]; /* null: it has no such rows */
} thick_lens = {"a thick lens",
                fit_lens,
                fit_save_lens,
                &lens_file_type,
                {[FIT_ANSWER] = &fit_lens_sheet,
                 [FIT_PARAMETERS] = &fit_parameter_sheet,
                 [FIT_CORRELATIONS] = &fit_correlation_sheet,
                 [FIT_RESIDUALS] = &fit_ray_sheet,
                 [FIT_MODELS] = &fit_model_sheet,
                 [FIT_MATRIX] = &fit_matrix_sheet}},
  prescription = {"a prescription",
                  fit_prescription,
                  fit_save_prescription,
                  &lens_file_type,
                  {[FIT_ANSWER] = &fit_goal_sheet,
                   [FIT_PARAMETERS] = &fit_parameter_sheet,
                   [FIT_RESIDUALS] = &fit_goal_sheet}},
  glass = {"a glass",
           fit_glass,
           fit_save_glass,
           &glass_type,
           {[FIT_ANSWER] = &fit_glass_sheet,
            [FIT_PARAMETERS] = &fit_parameter_sheet,
            [FIT_CORRELATIONS] = &fit_correlation_sheet,
            [FIT_RESIDUALS] = &fit_index_sheet}};

static const struct sheet *const all_sheets[] = {&fit_lens_sheet,        &fit_parameter_sheet,
                                                 &fit_correlation_sheet, &fit_ray_sheet,
                                                 &fit_model_sheet,       &fit_matrix_sheet,
                                                 &fit_goal_sheet,        &fit_glass_sheet,
                                                 &fit_index_sheet,       NULL};

static const struct fit_kind *fit_kind_of(const struct fit_input *input)
{
    const struct fit_kind *of_lens = input->goals != NULL ? &prescription : &thick_lens;
    return input->glass != NULL ? &glass : of_lens;
}

/* Those that there are not are refused by `run`. */
static const struct sheet *fit_choose_sheet(const void *data, const struct option_query *asking)
{
    const struct fit_input *input = data;
    const struct fit_kind *kind = fit_kind_of(input);
    (void)asking;
    return kind->sheets[kind->sheets[input->show] != NULL ? input->show : FIT_ANSWER];
}

static bool fit_makes_many(const void *data)
{
    const struct fit_input *input = data;
    const struct lens *lens = input->question.lens.lens;
    bool all =
        input->question.position != NULL && text_same(text_of(input->question.position), "all");
    return input->show != FIT_ANSWER || input->goals != NULL ||
           (input->chromatic && input->glass == NULL) ||
           (all && lens != NULL && lens->position_count > 1);
}

static bool fit_run(const void *data, struct run *run, struct error *error)
{
    const struct fit_input *input = data;
    const struct fit_kind *kind = fit_kind_of(input);
    if (kind->sheets[input->show] == NULL) {
        const char *words = "";
        for (int i = 0; i < FIT_SHOWS; i++) {
            if (kind->sheets[i] != NULL) {
                words = arena_printf(run->arena, "%s%s%s", words, i > 0 ? ", " : "", shows[i].word);
            }
        }
        return fail(error, ERROR_USAGE, "{--show} %s: %s has %s", shows[input->show].word,
                    kind->name, words);
    }
    if (floor(input->distortion) < input->distortion) {
        return fail(error, ERROR_USAGE, "{--distortion} %g: terms are a whole number",
                    input->distortion);
    }
    return kind->run(input, run, error);
}

static const struct file_type *fit_saved_types(size_t i)
{
    const struct file_type *const types[] = {&lens_file_type, &glass_type};
    return i < 2 ? types[i] : NULL;
}

/* A file holds one position, a .lens file one lens for all wavelengths. */
static bool fit_check_lens(const struct artifact_job *job, struct error *error)
{
    const struct fit_input *input = job->inputs[0];
    return !lens_positions_several(input->question.lens.lens, input->question.position) ||
           fail(error, ERROR_USAGE, "{--%s} holds one position: name it with {--position}",
                job->artifact->option.name);
}

static bool check_saved(const struct artifact_job *job, struct error *error)
{
    const struct fit_input *input = job->inputs[0];
    const struct fit_kind *kind = fit_kind_of(input);
    if (job->type != kind->type) {
        return fail(error, ERROR_USAGE, "{--output} '%s': %s is saved as %s", job->path, kind->name,
                    kind->type->ending);
    }
    if (input->glass != NULL) {
        return input->name == NULL || strpbrk(input->name, "\t\n:") == NULL ||
               fail(error, ERROR_USAGE, "{--name} has a tab, a line feed or a colon");
    }
    if (input->chromatic && input->goals == NULL) {
        return fail(error, ERROR_USAGE,
                    "a .lens holds one thick lens for all wavelengths: {--output} without "
                    "{--chromatic}");
    }
    if (!fit_check_lens(job, error)) {
        return false;
    }
    if (input->goals != NULL || input->distortion <= 0) {
        return true;
    }
    fail(error, ERROR_USAGE, "a .lens holds no distortion: {--output} needs {--distortion} 0");
    return error_hint(error, "f then makes up for the distortion as well as it can");
}

static bool fit_save(const struct artifact_job *job, struct output *sink, struct error *error)
{
    return fit_kind_of(job->inputs[0])->save(job, sink, error);
}

static const struct artifact artifacts[] = {
    {.option = {.kind = &kind_text,
                .name = "output",
                .letter = 'o',
                .value = "FILE",
                .flags = OPTION_FILE,
                .types = fit_saved_types,
                .help = "write the thick lens or the glass to FILE; rows go to standard output"},
     .is_kept = true,
     .check = check_saved,
     .make = fit_save},
    {.option = {.kind = &kind_text,
                .name = "map",
                .value = "FILE",
                .flags = OPTION_FILE,
                .types = drawing_types,
                .excludes = "prescription glass",
                .help = "map the error of the thick lens over field and pupil"},
     .is_kept = true,
     .check = fit_check_lens,
     .make = fit_draw_map},
};

static const struct explanation explanations[] = {
    {"efl",
     "f, H, H' = argmin sum w (|F (e - e_mean) + e_mean|^2 in the image + 10^-6 |e|^2 in the exit "
     "pupil), e the exact ray less that of the thick lens, n' u' = n (u + w d) - h/f from H to H', "
     "d = d1 s + d2 s^2 + d3 s^3 the distortion; e_mean of the rays of one field, F = 100 over the "
     "rms slope within them",
     "[BornWolf99] 4.3; [Ceres22]",
     "for fields below 90 degrees; the errors tell how well the rays agree with any thick lens"},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"fit double-gauss", "the thick lens that best matches the double Gauss over its fields"},
    {"fit double-gauss --show parameters", "with standard errors"},
    {"fit nikkor-z-14-24 --position all", "a zoom in each position"},
    {"fit double-gauss -N 2,4,8 --columns fnumber,efl_mm,rms_um", "how it changes stopped down"},
    {"fit double-gauss --prescription efl=101,bfl=72.5 --vary R1,R11",
     "radii that give the measured focal length and back focus"},
    {"fit double-gauss --distortion 0 -o equal.lens", "as a lens that every command takes"},
    {"fit double-gauss --map map.svg", "where in field and pupil it deviates"},
    {NULL, NULL},
};

const struct command command_fit = {
    .name = "fit",
    .group = "design",
    .summary = "the thick lens that best matches a real one; a glass from indices",
    .examples = examples,
    .options = options,
    .option_count = sizeof options / sizeof options[0],
    .input_size = sizeof(struct fit_input),
    .choose_sheet = fit_choose_sheet,
    .sheets = all_sheets,
    .makes_many = fit_makes_many,
    .run = fit_run,
    COMMAND_MAKES(artifacts),
    .explanations = explanations,
    .plot = "rms_um|distance_um|index",
    .plot_titles = "Error of the equivalent thick lens||Refractive index",
    .cell = "efl_mm",
    .needs_ceres = "",
    .most_answers = 10000,
};
