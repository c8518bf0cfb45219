/* commands/design/fit_glass.c - a dispersion formula from measured indices. */
/* SPDX-License-Identifier: MIT */
#include "commands/design/fit.h"
#include "data/index_table.h"
#include "data/whole_file.h"
#include "design/fit/dispersion.h"
#include "report/output.h"

static const enum glass_formula formulas[] = {GLASS_SELLMEIER, GLASS_SCHOTT, GLASS_CAUCHY,
                                              GLASS_BUCHDAHL, GLASS_CONRADY};
const struct word fit_formulas[] = {
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

const struct sheet fit_glass_sheet = SHEET(glass_columns, struct fit_glass_row);

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

const struct sheet fit_index_sheet = SHEET(index_columns, struct index_row);

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

bool fit_glass(const struct fit_input *input, struct run *run, struct error *error)
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
bool fit_save_glass(const struct artifact_job *job, struct output *sink, struct error *error)
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
