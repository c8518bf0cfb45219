/* commands/analysis/cmd_spread.c - lenscalc spread: images of lines and edges. */
/* SPDX-License-Identifier: MIT */
#include "analysis/image/line_spread.h"
#include "commands/analysis/figure_captions.h"
#include "draw/plot.h"

#include <math.h>
#include <string.h>

enum { SPREAD_LINE, SPREAD_EDGE };

struct spread_input {
    struct analysis_question question;
    double offset; /* mm; NaN = not given */
    int draws;
};

static const struct analysis_policy policy = {.wavelengths = WAVELENGTHS_ALL, .fields = FIELDS_ALL};

static const struct word drawings[] = {
    [SPREAD_LINE] = {"line", "the line spread function"},
    [SPREAD_EDGE] = {"edge", "the edge spread function"},
    {NULL, NULL},
};

static const struct option options[] = {
    ANALYSIS_OPTIONS("all of the lens by their weights, together",
                     ", or the fields of one question"),
    ANALYSIS_FIELD_OPTIONS,
    ANALYSIS_SPECTRUM_OPTION(struct spread_input, question),
    {OPTION(struct spread_input, offset), .name = "offset", .column = "offset",
     .dimension = &dimension_length, .unit = "um", .lowest = -1000, .highest = 1000,
     .value = "LENGTH",
     .help = "the functions there, from the chief ray; without it their widths alone"},
    {OPTION(struct spread_input, draws), .name = "draw", .words = drawings, .fallback = "line",
     .value = "WHAT", .wants = "plot", .help = "which of them --plot shows"},
    ANALYSIS_AIM_OPTION(NULL, "pupil that limits the beam"),
    ANALYSIS_CLIP_OPTIONS,
};

struct spread_row {
    struct analysis_point point;
    double offset;
    struct line_spread spread;
    struct line_spread_widths widths;
    double error;
};

#define WIDTH(member_name, more)                                                                   \
    COLUMN_OF_LENGTH(struct spread_row, member_name, "um"), .flags = (more)
#define AT(member_name, more)                                                                      \
    COLUMN(struct spread_row, member_name), .with = "offset", .flags = COLUMN_EXTRA | (more)

static const struct column columns[] = {
    ANALYSIS_ROW_COLUMNS,
    {COLUMN_OF_LENGTH(struct spread_row, offset, "um"), .name = "offset", .symbol = "x",
     .with = "offset", .flags = COLUMN_ECHO | COLUMN_EXTRA | COLUMN_BRIEF,
     .help = "distance from the chief ray, outwards along the section or across it"},
    {AT(spread.line[MTF_TANGENTIAL], COLUMN_BRIEF), .name = "line_tangential", .head = "line T",
     .symbol = "L", .dimension = &dimension_frequency, .unit = "per_mm", .label = "tangential line",
     .help = "light of a line across the section of axis and field point, there, a mm"},
    {AT(spread.line[MTF_SAGITTAL], COLUMN_BRIEF), .name = "line_sagittal", .head = "line S",
     .dimension = &dimension_frequency, .unit = "per_mm", .label = "sagittal line",
     .help = "the same of a line along that section"},
    {AT(spread.edge[MTF_TANGENTIAL], COLUMN_BRIEF), .name = "edge_tangential", .head = "edge T",
     .symbol = "E", .label = "tangential edge",
     .help = "light of an edge across the section, bright below it: 0 to 1"},
    {AT(spread.edge[MTF_SAGITTAL], COLUMN_BRIEF), .name = "edge_sagittal", .head = "edge S",
     .label = "sagittal edge", .help = "the same of an edge along that section"},
    {COLUMN(struct spread_row, error), .name = "edge_error", .label = "error of the edge",
     .flags = COLUMN_HIDDEN, .help = "estimated error of the edges"},
    {WIDTH(widths.line[MTF_TANGENTIAL], COLUMN_BRIEF), .name = "line_width_tangential",
     .head = "line width T", .label = "tangential line width",
     .help = "full width at half maximum of the line's image"},
    {WIDTH(widths.line[MTF_SAGITTAL], COLUMN_BRIEF), .name = "line_width_sagittal",
     .head = "line width S", .label = "sagittal line width",
     .help = "the same of the sagittal line"},
    {WIDTH(widths.edge[MTF_TANGENTIAL], COLUMN_BRIEF), .name = "edge_width_tangential",
     .head = "edge width T", .label = "tangential edge width",
     .help = "of the edge's image, between 10 and 90 %"},
    {WIDTH(widths.edge[MTF_SAGITTAL], COLUMN_BRIEF), .name = "edge_width_sagittal",
     .head = "edge width S", .label = "sagittal edge width",
     .help = "the same of the sagittal edge"},
    ANALYSIS_SPECTRUM_COLUMN,
    ANALYSIS_TAIL_COLUMNS,
};

static bool spread_row_find(const struct analysis_cursor *at, const struct analysis_case *one,
                            size_t field, void *found, struct error *error)
{
    const struct line_spread_question question = {
        .bundle = analysis_bundle(one, field),
        .farthest = fabs(((const struct spread_input *)at->input)->offset)};
    return line_spread_open(&question, one->setup->arena, found, error);
}

static const struct sheet sheet = SHEET(columns, struct spread_row);

static bool spread_run(const void *data, struct run *run, struct error *error)
{
    const struct spread_input *input = data;
    struct analysis_cursor at = analysis_begin_finding(data, &policy, run, spread_row_find,
                                                       sizeof(struct line_spread_image));
    while (analysis_next(&at, error)) {
        const struct line_spread_image *image = at.found;
        struct spread_row row;
        analysis_begin_row(&at, &sheet, &row);
        row.offset = input->offset;
        if (at.lost == NULL) {
            row.spread = line_spread_at(image, input->offset);
            row.widths = line_spread_widths_find(image);
            row.error = fmax(image->error[0], image->error[1]);
            analysis_warn(&at, &row.point, lens_island_warning(&image->islands, run->arena));
        }
        if (!run_emit(run, &row)) {
            return true;
        }
    }
    return error->code == ERROR_NONE;
}

/* -------- the drawing -------- */

enum { CURVES_MOST = 7, POINTS = 301 };

/* Two curves of each case, tangential and sagittal. */
struct spread_drawing {
    struct arena *arena;
    int draws;
    double farthest; /* NaN: as far as is usual */
    struct plot_series series[MTF_DIRECTIONS * CURVES_MOST];
    size_t count;
    struct captions captions;
};

static bool spread_drawing_add(struct spread_drawing *drawing, const struct analysis_cursor *at,
                               struct error *error)
{
    const struct line_spread_image *image = at->found;
    struct arena *arena = drawing->arena;
    const double end = isnan(drawing->farthest) ? image->usual : drawing->farthest;
    double *x = ARENA_ARRAY(arena, POINTS, double), *y[MTF_DIRECTIONS];
    unsigned char *places = ARENA_ARRAY(arena, POINTS, unsigned char);
    const size_t before = drawing->captions.count;
    const size_t caption = captions_add(&drawing->captions, at->one, at->field, NULL);
    if (caption < before) {
        return true;
    }
    if (caption == CURVES_MOST) {
        return fail(error, ERROR_USAGE, "{--plot} would draw more than %d pairs of curves",
                    CURVES_MOST);
    }
    y[0] = ARENA_ARRAY(arena, POINTS, double);
    y[1] = ARENA_ARRAY(arena, POINTS, double);
    for (size_t i = 0; i < POINTS; i++) {
        const double place = end * (2 * (double)i / (POINTS - 1) - 1);
        const struct line_spread spread = line_spread_at(image, place);
        x[i] = 1000 * place;
        places[i] = PLOT_BETWEEN;
        for (size_t k = 0; k < MTF_DIRECTIONS; k++) {
            y[k][i] = drawing->draws == SPREAD_LINE ? spread.line[k] / 1000 : spread.edge[k];
        }
    }
    for (size_t k = 0; k < MTF_DIRECTIONS; k++) {
        drawing->series[drawing->count++] = (struct plot_series){
            .x = x, .y = y[k], .count = POINTS, .places = places, .style = caption, .dash = k + 1};
    }
    return true;
}

/* "T 14°"; of one pair "tangential". */
static void spread_drawing_label(struct spread_drawing *drawing)
{
    static const char *const directions[] = {[MTF_TANGENTIAL] = "T ", [MTF_SAGITTAL] = "S "};
    static const char *const words[] = {
        [MTF_TANGENTIAL] = "tangential", [MTF_SAGITTAL] = "sagittal"};
    for (size_t i = 0; i < drawing->count; i++) {
        const char *label = captions_label(&drawing->captions, i / MTF_DIRECTIONS);
        const size_t k = i % MTF_DIRECTIONS;
        drawing->series[i].label =
            label != NULL ? ARENA_JOIN(drawing->arena, directions[k], label) : words[k];
    }
}

static bool spread_figure(const struct artifact_job *job, struct output *sink, struct error *error)
{
    struct svg svg = {.arena = job->run->arena};
    struct spread_drawing drawing = {
        .arena = svg.arena, .farthest = NAN, .captions = {.arena = svg.arena}};
    const double first = ((const struct spread_input *)job->inputs[0])->offset;
    for (size_t i = 0; i < job->count; i++) {
        drawing.farthest =
            fmax(drawing.farthest, fabs(((const struct spread_input *)job->inputs[i])->offset));
    }
    for (size_t i = 0; i < job->count; i++) {
        struct spread_input input;
        memcpy(&input, job->inputs[i], sizeof input);
        /* one curve holds all offsets */
        if (input.offset < first || input.offset > first) {
            continue;
        }
        input.offset = drawing.farthest;
        drawing.draws = input.draws;
        struct analysis_cursor at = analysis_begin_finding(
            &input, &policy, job->run, spread_row_find, sizeof(struct line_spread_image));
        at.keeps_lost = true;
        while (analysis_next(&at, error)) {
            if (at.lost == NULL && !spread_drawing_add(&drawing, &at, error)) {
                return false;
            }
        }
        if (error->code != ERROR_NONE) {
            return false;
        }
    }
    if (drawing.count == 0) {
        return fail(error, ERROR_DOMAIN, "there is no light to draw");
    }
    spread_drawing_label(&drawing);
    const bool is_line = drawing.draws == SPREAD_LINE;
    const struct plot plot = {
        .title = captions_title(&drawing.captions,
                                is_line ? "Line spread function" : "Edge spread function"),
        .subtitle = captions_subtitle(&drawing.captions),
        .x_label = "distance from the chief ray (\xc2\xb5m)",
        .y_label = is_line ? "share of the light (1/\xc2\xb5m)" : "light of an edge",
        .series = drawing.series,
        .series_count = drawing.count};
    return plot_draw(&plot, &svg, error) && drawing_write(job, &svg, sink, error);
}

static const struct artifact artifacts[] = {
    {ARTIFACT_OPTION("plot", drawing_types, "draw the line or edge spread function, by field"),
     .scope = ARTIFACT_OF_SWEEP, .needs_no_rows = true, .make = spread_figure},
};

static const struct explanation explanations[] = {
    {"line_tangential",
     "{L}({x}) = integral of |F(t, {x})|^2 dt/integral of |A|^2, F = integral of A exp(2 pi i (W - "
     "n "
     "s {x}/wavelength)) ds along lines of the pupil",
     "[Goodman05] 6.3", "the Fourier transform of the complex contrast of lenscalc mtf"},
    {"edge_tangential", "{E}({x}) = integral of L up to {x}", "[Goodman05] 6.3", NULL},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"spread double-gauss -N 8", "widths of the images of lines and edges, all fields"},
    {"spread double-gauss -N 8 --field 14 --offset -4..4:2", "the functions themselves"},
    {"spread double-gauss -N 8 --draw edge --plot edge.svg", "images of edges, drawn"},
    {NULL, NULL},
};

const struct command command_spread = {
    .name = "spread",
    .summary = "line and edge spread functions, their widths",
    COMMAND_ASKS(struct spread_input),
    COMMAND_ANSWERS(struct spread_row),
    .run = spread_run,
    .makes_many = analysis_several,
    ANALYSIS_COMMAND,
    .cell = "line_width_tangential",
    COMMAND_MAKES(artifacts),
    .most_answers = 10000,
};
