/* commands/analysis/cmd_field.c - lenscalc field: foci and working f-numbers by field. */
/* SPDX-License-Identifier: MIT */
#include "analysis/rays/field_curvature.h"
#include "analysis/waves/working_fnumber.h"
#include "commands/analysis/field_map.h"
#include "draw/panels.h"

#include <string.h>

enum field_show { FIELD_FOCI, FIELD_FNUMBERS };

struct field_input {
    struct analysis_question question;
    int show; /* enum field_show */
};

static const struct analysis_policy policies[] = {
    [FIELD_FOCI] = {.wavelengths = WAVELENGTHS_PRIMARY,
                    .fields = FIELDS_ALL,
                    .one_wavelength = true,
                    .is_narrow = true},
    [FIELD_FNUMBERS] = {.wavelengths = WAVELENGTHS_PRIMARY,
                        .fields = FIELDS_ALL,
                        .one_wavelength = true},
};

static const struct word shows[] = {
    [FIELD_FOCI] = {"foci", "tangential and sagittal foci of narrow beams"},
    [FIELD_FNUMBERS] = {"fnumbers", "working f-numbers of the whole beam in both sections"},
    {NULL, NULL},
};

static const struct option options[] = {
    ANALYSIS_OPTIONS(LENS_PRIMARY_WAVELENGTH, ", or the fields of one question"),
    ANALYSIS_FIELD_OPTIONS,
    {OPTION(struct field_input, show), .name = "show", .words = shows, .fallback = "foci",
     .value = "WHAT", .help = "what rows and --plot are of"},
    ANALYSIS_CLIP_OPTIONS_FOR("show=fnumbers"),
    ANALYSIS_OVER_FIELD_OPTIONS,
};

struct field_row {
    struct analysis_point point;
    struct field_curvature at;
    const char *status;
    long lost;
    struct working_fnumber working;
    double paraxial;
};

#define LENGTH(member_name, more)                                                                  \
    COLUMN_OF_LENGTH(struct field_row, member_name, "mm"), .flags = (more)
#define PLAIN(member_name, more) COLUMN(struct field_row, member_name), .flags = (more)

static const struct column foci_columns[] = {
    ANALYSIS_ROW_COLUMNS,
    {LENGTH(at.height[1], COLUMN_BRIEF | COLUMN_SPARSE), .name = "image_height", .symbol = "h",
     .label = "image height", .help = "where the chief ray meets the image plane"},
    {LENGTH(at.height[0], COLUMN_EXTRA | COLUMN_BRIEF), .name = "image_height_x",
     .with = "field-x height-x", .label = "image height x", .help = "the same in x"},
    {LENGTH(at.tangential, COLUMN_BRIEF | COLUMN_SPARSE | COLUMN_INFINITE), .name = "tangential",
     .symbol = "T",
     .help = "tangential focus from the image plane, along the axis; positive to the right"},
    {LENGTH(at.sagittal, COLUMN_BRIEF | COLUMN_SPARSE | COLUMN_INFINITE), .name = "sagittal",
     .symbol = "S", .help = "sagittal focus from the image plane"},
    {LENGTH(at.medial, COLUMN_BRIEF | COLUMN_SPARSE), .name = "medial", .symbol = "M",
     .help = "half way between the two"},
    {LENGTH(at.astigmatism, COLUMN_BRIEF | COLUMN_SPARSE), .name = "astigmatism", .symbol = "A",
     .help = "tangential less sagittal"},
    {LENGTH(at.petzval, COLUMN_BRIEF | COLUMN_SPARSE), .name = "petzval", .symbol = "P",
     .label = "Petzval", .help = "Petzval surface at that image height, from the image plane"},
    {PLAIN(at.tangential_power, COLUMN_BRIEF | COLUMN_SPARSE), .name = "tangential_per_m",
     .label = "tangential, vergence",
     .help = "where the image is at infinity: index over the distance of "
             "the tangential focus from the exit pupil, 1/m"},
    {PLAIN(at.sagittal_power, COLUMN_BRIEF | COLUMN_SPARSE), .name = "sagittal_per_m",
     .label = "sagittal, vergence", .help = "the same of the sagittal focus, 1/m"},
    {LENGTH(at.beam.tangential_z, COLUMN_HIDDEN | COLUMN_INFINITE), .name = "tangential_z",
     .label = "tangential z", .help = "tangential focus from the last vertex"},
    {LENGTH(at.beam.sagittal_z, COLUMN_HIDDEN | COLUMN_INFINITE), .name = "sagittal_z",
     .label = "sagittal z", .help = "sagittal focus from the last vertex"},
    {COLUMN_OF_ANGLE(struct field_row, at.beam.turn, "deg"), .name = "section_turn",
     .flags = COLUMN_HIDDEN, .label = "sections turned",
     .help = "of the tangential section out of the plane of chief ray and axis: 0 in round lenses"},
    {PLAIN(status, COLUMN_HIDDEN), .name = "status",
     .help = "of the chief ray, which is traced on in any case: ok, or clipped by an aperture"},
    {PLAIN(lost, COLUMN_SPARSE | COLUMN_BRIEF), .name = "surface", .label = "clipped at surface",
     .help = "surface that clips the chief ray"},
    ANALYSIS_TAIL_COLUMNS,
};

#define FNUMBER(member_name)                                                                       \
    COLUMN(struct field_row, member_name), .flags = COLUMN_BRIEF | COLUMN_SPARSE | COLUMN_INFINITE

static const struct column fnumber_columns[] = {
    ANALYSIS_ROW_COLUMNS,
    {LENGTH(working.height[1], COLUMN_BRIEF | COLUMN_SPARSE), .name = "image_height", .symbol = "h",
     .label = "image height", .help = "where the chief ray meets the image plane"},
    {LENGTH(working.height[0], COLUMN_EXTRA | COLUMN_BRIEF), .name = "image_height_x",
     .with = "field-x height-x", .label = "image height x", .help = "the same in x"},
    {FNUMBER(working.tangential), .name = "fnumber_tangential", .symbol = "Nt",
     .label = "tangential f-number", .head = "tangential",
     .help = "working f-number of the marginal rays in the plane of axis and field point"},
    {FNUMBER(working.sagittal), .name = "fnumber_sagittal", .symbol = "Ns",
     .label = "sagittal f-number", .head = "sagittal", .help = "and of those across it"},
    {FNUMBER(working.both), .name = "working_fnumber", .symbol = "N", .label = "working f-number",
     .head = "both", .help = "of all four: by the mean of their squared numerical apertures"},
    {COLUMN(struct field_row, paraxial), .name = "paraxial_fnumber", .label = "paraxial f-number",
     .head = "paraxial", .flags = COLUMN_BRIEF | COLUMN_SPARSE,
     .help = "paraxial working f-number on the axis, for comparison"},
    ANALYSIS_TAIL_COLUMNS,
};

static const struct sheet foci_sheet = SHEET(foci_columns, struct field_row);
static const struct sheet fnumber_sheet = SHEET(fnumber_columns, struct field_row);
static const struct sheet *const sheets[] = {&foci_sheet, &fnumber_sheet, NULL};

static const struct sheet *field_choose_sheet(const void *data, const struct option_query *asking)
{
    (void)asking;
    return sheets[((const struct field_input *)data)->show];
}

static bool field_find_fnumber(const struct analysis_cursor *at, const struct analysis_case *one,
                               size_t field, void *found, struct error *error)
{
    (void)at;
    const struct bundle_question bundle = analysis_bundle(one, field);
    return working_fnumber_find(&bundle, one->setup->arena, found, error);
}

static bool field_run_fnumbers(const void *data, struct run *run, struct error *error)
{
    struct analysis_cursor at = analysis_begin_finding(
        data, &policies[FIELD_FNUMBERS], run, field_find_fnumber, sizeof(struct working_fnumber));
    while (analysis_next(&at, error)) {
        const double paraxial = at.one->setup->first.working_fnumber;
        struct field_row row;
        analysis_begin_row(&at, &fnumber_sheet, &row);
        row.paraxial = isfinite(paraxial) ? paraxial : (double)NAN;
        if (at.lost == NULL) {
            row.working = *(const struct working_fnumber *)at.found;
            analysis_warn(&at, &row.point, lens_island_warning(&row.working.islands, run->arena));
            if (isnan(row.working.both)) {
                analysis_warn(&at, &row.point,
                              "the image is infinitely far away: no cone, no "
                              "working f-number");
            }
        }
        if (!run_emit(run, &row)) {
            return true;
        }
    }
    return error->code == ERROR_NONE;
}

static bool field_run(const void *data, struct run *run, struct error *error)
{
    if (((const struct field_input *)data)->show == FIELD_FNUMBERS) {
        return field_run_fnumbers(data, run, error);
    }
    struct analysis_cursor at = analysis_begin(data, &policies[FIELD_FOCI], run);
    analysis_doubt_aperture(at.question, run->doubts);
    while (analysis_next(&at, error)) {
        const struct setup *setup = at.one->setup;
        struct field_row row;
        struct field_curvature found;
        const bool is_there =
            field_curvature(setup, 0, &setup->fields[at.field].point, &found, error);
        if (!is_there && !analysis_keep_lost(&at, error)) {
            return false;
        }
        analysis_begin_row(&at, &foci_sheet, &row);
        if (is_there) {
            row.at = found;
            if (!isnan(setup->image)) {
                row.at.tangential_power = row.at.sagittal_power = NAN;
            }
            row.status = ray_status_name(found.status);
            row.lost = found.surface > 0 ? (long)found.surface : NO_INTEGER;
        }
        if (!run_emit(run, &row)) {
            return true;
        }
    }
    return error->code == ERROR_NONE;
}

/* -------- the plot -------- */

/* The curves of one lens in one case, over all the fields that are asked for. */
struct field_curves {
    const char *words; /* what is the case; curves are told apart by it */
    const char *name;  /* what of it was asked for, null = nothing */
    const struct analysis_case *one;
    const struct setup *setup;
    int show;                /* enum field_show */
    struct field_point edge; /* the farthest field; where it points to is up */
    double low, high;        /* along there: rad or mm */
};

enum { POINTS = 61, MOST_CURVES = 24, SAGITTAL = 0, TANGENTIAL, PETZVAL, CURVES };

struct field_painter {
    struct run *run;
    struct field_curves *curves;
    size_t count, room;
};

/* How far a field lies along the direction of the farthest one. */
static double field_along(const struct field_point *edge, const struct field_point *point)
{
    const double *a = edge->value, *b = point->value;
    return copysign(field_extent(point->kind, b), a[0] * b[0] + a[1] * b[1] < 0 ? -1.0 : 1.0);
}

static void field_add_field(struct field_painter *painter, const struct analysis_case *one,
                            size_t field, int show)
{
    struct arena *arena = painter->run->arena;
    const struct field_point *point = &one->setup->fields[field].point;
    const unsigned aperture = show == FIELD_FNUMBERS ? FIGURE_APERTURE : 0;
    const char *words = analysis_figure_words(
        one, FIGURE_WAVELENGTHS | FIGURE_PLANE | FIGURE_DEFOCUS | aperture, arena);
    struct field_curves *curves = NULL;
    for (size_t i = 0; i < painter->count; i++) {
        bool same = strcmp(painter->curves[i].words, words) == 0 &&
                    painter->curves[i].one->clip == one->clip &&
                    strcmp(painter->curves[i].setup->lens->title, one->setup->lens->title) == 0 &&
                    painter->curves[i].edge.kind == point->kind;
        curves = same ? &painter->curves[i] : curves;
    }
    if (curves == NULL) {
        painter->curves = arena_grow(arena, painter->curves, painter->count, &painter->room,
                                     sizeof *painter->curves);
        curves = &painter->curves[painter->count++];
        *curves = (struct field_curves){.words = words,
                                        .name = analysis_case_words(one, arena),
                                        .one = one,
                                        .setup = one->setup,
                                        .show = show,
                                        .edge = *point};
    }
    if (field_extent(point->kind, point->value) >
        field_extent(curves->edge.kind, curves->edge.value)) {
        /* what lay on the other side still does */
        if (field_along(&curves->edge, point) < 0) {
            double low = curves->low;
            curves->low = -curves->high;
            curves->high = -low;
        }
        curves->edge = *point;
    }
    double here = field_along(&curves->edge, point);
    curves->low = fmin(curves->low, here);
    curves->high = fmax(curves->high, here);
}

/* How many curves there are: f-numbers have no Petzval surface. */
static size_t field_curve_count(int show)
{
    return show == FIELD_FNUMBERS ? PETZVAL : CURVES;
}

/* What a panel shows at one of its fields; NaN: nothing. */
static void field_measure(const struct field_curves *curves, const struct field_point *point,
                          struct arena *arena, double found[CURVES])
{
    struct error ignored;
    found[SAGITTAL] = found[TANGENTIAL] = found[PETZVAL] = NAN;
    if (curves->show == FIELD_FNUMBERS) {
        struct working_fnumber working;
        const struct bundle_question bundle = {
            .setup = curves->setup, .field = point, .clip = curves->one->clip};
        if (working_fnumber_find(&bundle, arena, &working, &ignored)) {
            found[SAGITTAL] = working.sagittal;
            found[TANGENTIAL] = working.tangential;
        }
    } else {
        struct field_curvature foci;
        if (field_curvature(curves->setup, 0, point, &foci, &ignored)) {
            found[SAGITTAL] = foci.sagittal;
            found[TANGENTIAL] = foci.tangential;
            found[PETZVAL] = foci.petzval;
        }
    }
}

/* One panel: defocus or f-number to the right, field upwards. */
static struct panel panel_of(const struct field_curves *curves, struct arena *arena)
{
    struct panel_series *series = ARENA_ARRAY(arena, CURVES, struct panel_series);
    double *x[CURVES], *y = ARENA_ARRAY(arena, POINTS, double);
    const double extent = field_extent(curves->edge.kind, curves->edge.value);
    const double unit = curves->edge.kind == FIELD_ANGLE ? DEGREES_PER_RADIAN : 1;
    for (size_t k = 0; k < CURVES; k++) {
        x[k] = ARENA_ARRAY(arena, POINTS, double);
        series[k] = (struct panel_series){.x = x[k], .y = y, .count = POINTS, .key = k};
    }
    for (size_t i = 0; i < POINTS; i++) {
        const double share = (double)i / (POINTS - 1);
        const double at = curves->low + share * (curves->high - curves->low);
        struct field_point point = curves->edge;
        point.value[0] *= at / extent;
        point.value[1] *= at / extent;
        y[i] = unit * at;
        double found[CURVES];
        field_measure(curves, &point, arena, found);
        for (size_t k = 0; k < CURVES; k++) {
            x[k][i] = found[k];
        }
    }
    return (struct panel){.series = series, .count = field_curve_count(curves->show)};
}

static const char *field_label(enum field_kind kind)
{
    static const char *const labels[] = {[FIELD_NONE] = "field",
                                         [FIELD_ANGLE] = "field angle (deg)",
                                         [FIELD_HEIGHT] = "object height (mm)",
                                         [FIELD_IMAGE] = "paraxial image height (mm)",
                                         [FIELD_REAL] = "image height (mm)"};
    return labels[kind];
}

static bool field_paint(struct field_painter *painter, struct svg *svg, struct error *error)
{
    static const char *const keys[CURVES] = {
        [SAGITTAL] = "S: sagittal", [TANGENTIAL] = "T: tangential", [PETZVAL] = "Petzval surface"};
    struct arena *arena = svg->arena;
    struct panel *panels = ARENA_ARRAY(arena, painter->count + 1, struct panel);
    const struct field_curves *first = &painter->curves[0];
    const size_t many = painter->count == 4 ? 2 : 3;
    const bool fnumbers = first->show == FIELD_FNUMBERS;
    const char *what = fnumbers ? "Working f-numbers" : "Field curvature";
    bool one_kind = true, one_lens = true;
    for (size_t i = 0; i < painter->count; i++) {
        const struct field_curves *curves = &painter->curves[i];
        one_lens = one_lens && strcmp(curves->setup->lens->title, first->setup->lens->title) == 0;
        one_kind = one_kind && curves->edge.kind == first->edge.kind;
        if (isnan(curves->setup->image)) {
            return fail(error, ERROR_DOMAIN, "{--plot}: the image is infinitely far away, %s",
                        fnumbers ? "its beams have no cone"
                                 : "there is no plane to draw distances from");
        }
    }
    for (size_t i = 0; i < painter->count; i++) {
        const struct field_curves *curves = &painter->curves[i];
        panels[i] = panel_of(curves, arena);
        panels[i].y_label = field_label(curves->edge.kind);
        if (painter->count > 1) {
            panels[i].title =
                analysis_curve_words(curves->setup->lens->title, curves->name, one_lens, arena);
        }
    }
    const struct panels page = {
        .title = one_lens ? ARENA_JOIN(arena, what, " of ", first->setup->lens->title) : what,
        .subtitle = painter->count == 1 ? first->words : NULL,
        .x_label = fnumbers ? "working f-number" : "distance from the image plane (mm)",
        .y_label = one_kind ? field_label(first->edge.kind) : NULL,
        .keys = keys,
        .key_count = field_curve_count(first->show),
        .own_y = !one_kind,
        .tall = true,
        .columns = painter->count < 3 ? painter->count : many,
        .panels = panels,
        .count = painter->count,
    };
    return panels_draw(&page, svg, error);
}

static bool field_draw(const struct artifact_job *job, struct output *sink, struct error *error)
{
    struct svg svg = {.arena = job->run->arena};
    struct field_painter painter = {.run = job->run};
    for (size_t i = 0; i < job->count; i++) {
        const struct field_input *input = job->inputs[i];
        /* A curve wants a field: of a lens that states none but the axis another one is taken. */
        const struct lens *lens = input->question.lens.lens;
        struct analysis_policy wide = policies[input->show];
        if (lens != NULL && !(lens_field_extent(lens) > 0)) {
            wide.fields = FIELDS_EDGE;
        }
        struct analysis_cursor at = analysis_begin(input, &wide, job->run);
        while (analysis_next(&at, error)) {
            field_add_field(&painter, at.one, at.field, input->show);
        }
        if (error->code != ERROR_NONE) {
            return false;
        }
    }
    return (painter.count <= MOST_CURVES ||
            fail(error, ERROR_USAGE,
                 "{--plot} would draw %zu panels: at most %d can be distinguished", painter.count,
                 MOST_CURVES)) &&
           field_paint(&painter, &svg, error) && drawing_write(job, &svg, sink, error);
}

/* -------- over the image -------- */

static bool field_map_foci(const struct analysis_cursor *at, const struct analysis_case *one,
                           size_t field, void *found, struct error *error)
{
    (void)at;
    double *values = found;
    struct field_curvature foci;
    if (!field_curvature(one->setup, 0, &one->setup->fields[field].point, &foci, error)) {
        return false;
    }
    values[FIELD_MAP_TANGENTIAL] = foci.tangential;
    values[FIELD_MAP_SAGITTAL] = foci.sagittal;
    values[FIELD_MAP_TURN] = foci.beam.turn;
    return true;
}

static bool field_over_field(const struct artifact_job *job, struct output *sink,
                             struct error *error)
{
    static const struct field_map_kind kind = {.policy = &policies[FIELD_FOCI],
                                               .find = field_map_foci,
                                               .values = FIELD_MAP_VALUES,
                                               .what = "Astigmatism over the image",
                                               .is_bars = true};
    return field_map_make(job, &kind, sink, error);
}

static bool field_check_over_field(const struct artifact_job *job, struct error *error)
{
    return ((const struct field_input *)job->inputs[0])->show == FIELD_FOCI ||
           fail(error, ERROR_USAGE, "{--over-field} maps the foci: not with {--show} fnumbers");
}

static const struct artifact artifacts[] = {
    {ARTIFACT_OPTION("plot", drawing_types,
                     "draw both foci and the Petzval surface, or both f-numbers, by field"),
     .scope = ARTIFACT_OF_SWEEP, .make = field_draw},
    {ARTIFACT_OPTION("over-field", drawing_types, "draw both foci over the image, as bars"),
     .scope = ARTIFACT_OF_SWEEP, .needs_no_rows = true, .check = field_check_over_field,
     .make = field_over_field},
};

static const struct explanation explanations[] = {
    {"tangential", "z of the tangential focus less z of the image plane",
     "Coddington's equations by exact derivatives of the chief ray, [Welford86]",
     "rays farther from the chief ray meet elsewhere"},
    {"sagittal", "z of the sagittal focus less z of the image plane", "the same", NULL},
    {"medial", "{M} = ({T} + {S})/2", "the same", NULL},
    {"astigmatism", "{A} = {T} - {S}", "the same", NULL},
    {"petzval", "{P} = paraxial image + {h}^2/(2 R), 1/R = -n' sum (n' - n) c/(n n')",
     "[Welford86]", "of third order"},
    {"working_fnumber", "{N} = 1/(2 sqrt(mean of NA^2)), NA = n' sin(angle from the chief ray)",
     "[OpticStudio25], of its four marginal rays; each section by its own two",
     "of the last rays that are clear, whatever blocks light between them"},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"field double-gauss", "at the fields of the lens, from its image plane"},
    {"field double-gauss --field 0..14#15 --plot field.svg", "the curves, and their numbers"},
    {"field double-gauss --field 14deg -w d,F,C", "by wavelength, from one image plane"},
    {"field nikkor-z-14-24 --position all --csv", "all positions of a zoom"},
    {"field double-gauss --show fnumbers", "working f-numbers, with vignetting"},
    {NULL, NULL},
};

const struct command command_field = {
    .name = "field",
    .stop_size_wants = "show=fnumbers",
    .summary = "field curvature and astigmatism, working f-numbers",
    COMMAND_ASKS(struct field_input),
    .sheet = SHEET(foci_columns, struct field_row),
    .choose_sheet = field_choose_sheet,
    .sheets = sheets,
    .explanations = explanations,
    .run = field_run,
    .makes_many = analysis_several,
    ANALYSIS_COMMAND,
    .cell = "tangential",
    COMMAND_MAKES(artifacts),
    .most_answers = 100000,
};
