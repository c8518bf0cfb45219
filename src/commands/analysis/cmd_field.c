/* commands/analysis/cmd_field.c - lenscalc field: field curvature and astigmatism. */
/* SPDX-License-Identifier: MIT */
#include "analysis/rays/field_curvature.h"
#include "commands/analysis/analysis_cursor.h"
#include "draw/panels.h"

#include <string.h>

struct field_input {
    struct analysis_question question;
};

static const struct analysis_policy policy = {.wavelengths = WAVELENGTHS_PRIMARY,
                                              .fields = FIELDS_ALL,
                                              .one_wavelength = true,
                                              .is_narrow = true};

static const struct option options[] = {
    ANALYSIS_OPTIONS(LENS_PRIMARY_WAVELENGTH, ""),
    ANALYSIS_FIELD_OPTIONS,
};

struct field_row {
    struct analysis_point point;
    struct field_curvature at;
    const char *status;
    long lost;
};

#define LENGTH(member_name, more)                                                                  \
    COLUMN_OF_LENGTH(struct field_row, member_name, "mm"), .flags = (more)
#define PLAIN(member_name, more) COLUMN(struct field_row, member_name), .flags = (more)

static const struct column columns[] = {
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

static const struct sheet sheet = SHEET(columns, struct field_row);

static bool field_run(const void *data, struct run *run, struct error *error)
{
    struct analysis_cursor at = analysis_begin(data, &policy, run);
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
        analysis_begin_row(&at, &sheet, &row);
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
    const struct setup *setup;
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
                            size_t field)
{
    struct arena *arena = painter->run->arena;
    const struct field_point *point = &one->setup->fields[field].point;
    const char *words =
        analysis_figure_words(one, FIGURE_WAVELENGTHS | FIGURE_PLANE | FIGURE_DEFOCUS, arena);
    struct field_curves *curves = NULL;
    for (size_t i = 0; i < painter->count; i++) {
        bool same = strcmp(painter->curves[i].words, words) == 0 &&
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
                                        .setup = one->setup,
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

/* One panel: defocus to the right, field upwards. */
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
        struct field_curvature found;
        struct error ignored;
        point.value[0] *= at / extent;
        point.value[1] *= at / extent;
        y[i] = unit * at;
        if (!field_curvature(curves->setup, 0, &point, &found, &ignored)) {
            found.tangential = found.sagittal = found.petzval = NAN;
        }
        x[SAGITTAL][i] = found.sagittal;
        x[TANGENTIAL][i] = found.tangential;
        x[PETZVAL][i] = found.petzval;
    }
    return (struct panel){.series = series, .count = CURVES};
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
    bool one_kind = true, one_lens = true;
    for (size_t i = 0; i < painter->count; i++) {
        const struct field_curves *curves = &painter->curves[i];
        one_lens = one_lens && strcmp(curves->setup->lens->title, first->setup->lens->title) == 0;
        one_kind = one_kind && curves->edge.kind == first->edge.kind;
        if (isnan(curves->setup->image)) {
            return fail(error, ERROR_DOMAIN,
                        "{--plot}: the image is infinitely far away, there is no plane to draw "
                        "distances from");
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
        .title = one_lens ? arena_printf(arena, "Field curvature of %s", first->setup->lens->title)
                          : "Field curvature",
        .subtitle = painter->count == 1 ? first->words : NULL,
        .x_label = "distance from the image plane (mm)",
        .y_label = one_kind ? field_label(first->edge.kind) : NULL,
        .keys = keys,
        .key_count = CURVES,
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
        struct analysis_policy wide = policy;
        if (lens != NULL && !(lens_field_extent(lens) > 0)) {
            wide.fields = FIELDS_EDGE;
        }
        struct analysis_cursor at = analysis_begin(input, &wide, job->run);
        while (analysis_next(&at, error)) {
            field_add_field(&painter, at.one, at.field);
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

static const struct artifact artifacts[] = {
    {ARTIFACT_OPTION("plot", drawing_types, "draw both foci and the Petzval surface by field"),
     .scope = ARTIFACT_OF_SWEEP, .make = field_draw},
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
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"field double-gauss", "at the fields of the lens, from its image plane"},
    {"field double-gauss --field 0..14#15 --plot field.svg", "the curves, and their numbers"},
    {"field double-gauss --field 14deg -w d,F,C", "by wavelength, from one image plane"},
    {"field nikkor-z-14-24 --position all --csv", "all positions of a zoom"},
    {NULL, NULL},
};

const struct command command_field = {
    .name = "field",
    .stop_size_wants = "",
    .summary = "field curvature and astigmatism: tangential and sagittal foci",
    COMMAND_ASKS(struct field_input),
    COMMAND_ANSWERS(struct field_row),
    .run = field_run,
    .makes_many = analysis_several,
    ANALYSIS_COMMAND,
    .cell = "tangential",
    COMMAND_MAKES(artifacts),
    .most_answers = 100000,
};
