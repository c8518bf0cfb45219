/* commands/analysis/cmd_fan.c - lenscalc fan: aberrations along two sections of the pupil. */
/* SPDX-License-Identifier: MIT */
#include "analysis/waves/pupil_fan.h"
#include "commands/analysis/analysis_cursor.h"
#include "draw/panels.h"
#include "draw/ticks.h"

#include <string.h>

enum fan_show { FAN_TRANSVERSE, FAN_OPD, FAN_PUPIL };

struct fan_input {
    struct analysis_question question;
    int show, reference;
    long points;
};

static const struct analysis_policy policy = {.wavelengths = WAVELENGTHS_ALL, .fields = FIELDS_ALL};

static const struct word shows[] = {
    [FAN_TRANSVERSE] = {"transverse", "where rays arrive, from the reference"},
    [FAN_OPD] = {"opd", "optical path differences from the reference sphere"},
    [FAN_PUPIL] = {"pupil", "where rays of the paraxial entrance pupil cross the stop, from there"},
    {NULL, NULL},
};

/* Wavelengths that are asked together have one reference, so that their colours show apart. */
static const struct word references[] = {
    [WAVE_CHIEF] = {"chief", "the chief ray, of the first wavelength where there are several"},
    [WAVE_CENTROID] = {"centroid", "the centroid of all rays and wavelengths by their weights"},
    [WAVE_BEST] = {"best", "the centre of the sphere that fits the wave fronts best"},
    {NULL, NULL},
};

/* What --show pupil has no use for. */
#define OF_IMAGE "show=transverse|show=opd"

static const struct option options[] = {
    ANALYSIS_OPTIONS_FOR("all of the lens, each by itself", ", or the fields of one question",
                         OF_IMAGE),
    ANALYSIS_FIELD_OPTIONS,
    ANALYSIS_SPECTRUM_OPTION(struct fan_input, question),
    {OPTION(struct fan_input, show), .name = "show", .words = shows, .fallback = "transverse",
     .value = "WHAT", .help = "what text and --plot show; pupil: rows, too"},
    {OPTION(struct fan_input, reference), .name = "reference", .words = references,
     .fallback = "chief", .value = "WHAT", .wants = OF_IMAGE,
     .help = "reference point of the aberrations"},
    {OPTION(struct fan_input, points), .name = "points", .lowest = 3, .highest = 100001,
     .fallback = "21", .value = "COUNT",
     .help = "rays in each section, an odd number: one lies in the middle"},
    ANALYSIS_AIM_OPTION(OF_IMAGE, "pupil that the ray points lie in"),
    ANALYSIS_CLIP_OPTIONS,
};

struct fan_row {
    struct analysis_point point;
    const char *section, *status, *reference;
    double pupil_x, pupil_y;
    bool is_angular;         /* dx and dy are sines of angles */
    double dx, dy;           /* mm */
    double opd;              /* waves */
    double at_x, at_y, at_z; /* mm */
    double radius;           /* mm */
    long surface;
};

static const struct column_form sines = {&dimension_angle, "mrad",
                                         "of an image at infinity: sine of the angle from the "
                                         "chief ray"};

#define SMALL(member_name, more)                                                                   \
    COLUMN_OR(struct fan_row, member_name, is_angular, &sines), .dimension = &dimension_length,    \
                                                                .unit = "um", .flags = (more)
#define PLACE(member_name, more)                                                                   \
    COLUMN_OF_LENGTH(struct fan_row, member_name, "mm"), .flags = (more)
#define PLAIN(member_name, more) COLUMN(struct fan_row, member_name), .flags = (more)

/* With what people read of the transverse aberrations, and of the path differences. */
#define FAN_COLUMNS(off, path)                                                                     \
    ANALYSIS_ROW_COLUMNS,                                                                          \
        ENTRY(PLAIN(section, COLUMN_BRIEF), .name = "section",                                     \
              .help = "tangential: through the axis and the field point; or sagittal, across it"), \
        ENTRY(PLAIN(pupil_x, COLUMN_BRIEF), .name = "pupil_x", .label = "pupil x",                 \
              .help = "where the ray crosses the pupil, in units of its radius"),                  \
        ENTRY(PLAIN(pupil_y, COLUMN_BRIEF), .name = "pupil_y", .label = "pupil y",                 \
              .help = "the same upwards"),                                                         \
        ENTRY(SMALL(dx, (off) | COLUMN_SPARSE), .name = "dx",                                      \
              .help = "from the reference to where the ray meets the image plane, in x"),          \
        ENTRY(SMALL(dy, (off) | COLUMN_SPARSE), .name = "dy", .help = "and in y"),                 \
        ENTRY(PLAIN(opd, (path)), .name = "opd_waves", .label = "OPD, waves", .symbol = "W",       \
              .help =                                                                              \
                  "optical path of the chief ray less that of the ray, to the reference sphere, "  \
                  "in wavelengths of its own"),                                                    \
        ENTRY(PLAIN(status, COLUMN_BRIEF), .name = "status",                                       \
              .help = "ok, miss, total_reflection, clipped or not_converged"),                     \
        ENTRY(PLAIN(surface, COLUMN_BRIEF | COLUMN_SPARSE), .name = "surface",                     \
              .help =                                                                              \
                  "where the ray was lost, from 1, the stop counted; of a ray on the edge of the " \
                  "clear pupil what ends it"),                                                     \
        ENTRY(PLACE(at_x, COLUMN_HIDDEN), .name = "reference_x", .label = "reference x",           \
              .help = "the reference on the image plane"),                                         \
        ENTRY(PLACE(at_y, COLUMN_HIDDEN), .name = "reference_y", .label = "reference y",           \
              .help = "the same upwards"),                                                         \
        ENTRY(PLACE(at_z, COLUMN_HIDDEN), .name = "reference_z", .label = "reference z",           \
              .help =                                                                              \
                  "of the best-fitting sphere its centre behind that plane, where dx and dy are "  \
                  "too; else 0"),                                                                  \
        ENTRY(PLACE(radius, COLUMN_HIDDEN | COLUMN_INFINITE), .name = "sphere",                    \
              .help = "radius of the reference sphere"),                                           \
        ENTRY(PLAIN(reference, COLUMN_ASSUMED), .name = "reference",                               \
              .depends = "reference lens wavelength spectrum",                                     \
              .help = "reference point of the aberrations"),                                       \
        ANALYSIS_SPECTRUM_COLUMN, ANALYSIS_TAIL_COLUMNS

/* Of pupil aberrations. */
#define SHARE(member_name)                                                                         \
    PLAIN(member_name, COLUMN_BRIEF | COLUMN_SPARSE), .dimension = &dimension_ratio,               \
                                                      .unit = "percent"
static const struct column pupil_columns[] = {
    ANALYSIS_POINT_COLUMNS,
    ANALYSIS_WAVELENGTH_COLUMN,
    {PLAIN(section, COLUMN_BRIEF), .name = "section",
     .help = "tangential: through the axis and the field point; or sagittal, across it"},
    {PLAIN(pupil_x, COLUMN_BRIEF), .name = "pupil_x", .label = "pupil x",
     .help = "where the ray is aimed in the paraxial entrance pupil, in units of its radius"},
    {PLAIN(pupil_y, COLUMN_BRIEF), .name = "pupil_y", .label = "pupil y",
     .help = "the same upwards"},
    {SHARE(dx), .name = "stop_dx", .label = "dx in the stop",
     .help = "where the ray crosses the stop less its paraxial place, in x, over the paraxial "
             "radius of the stop"},
    {SHARE(dy), .name = "stop_dy", .label = "dy in the stop", .help = "and in y"},
    {PLAIN(status, COLUMN_BRIEF), .name = "status",
     .help = "ok, miss, total_reflection or clipped in front of the stop"},
    {PLAIN(surface, COLUMN_BRIEF | COLUMN_SPARSE), .name = "surface",
     .help = "where the ray was lost, from 1"},
    LENS_TITLE_COLUMN(struct analysis_point, lens),
    LENS_WARNING_COLUMN(struct analysis_point, warning),
};

static const struct column transverse_columns[] = {FAN_COLUMNS(COLUMN_BRIEF, COLUMN_HIDDEN)};
static const struct column opd_columns[] = {FAN_COLUMNS(COLUMN_HIDDEN, COLUMN_BRIEF)};

static const struct sheet transverse_sheet = SHEET(transverse_columns, struct fan_row);
static const struct sheet opd_sheet = SHEET(opd_columns, struct fan_row);
static const struct sheet pupil_sheet = SHEET(pupil_columns, struct fan_row);
static const struct sheet *const sheets[] = {
    [FAN_TRANSVERSE] = &transverse_sheet,
    [FAN_OPD] = &opd_sheet,
    [FAN_PUPIL] = &pupil_sheet,
    NULL,
};

static const struct sheet *fan_choose_sheet(const void *data, const struct option_query *asking)
{
    (void)asking;
    return sheets[((const struct fan_input *)data)->show];
}

static bool fan_find(const struct analysis_cursor *at, const struct analysis_case *one,
                     size_t field, void *found, struct error *error)
{
    const struct fan_input *input = at->input;
    if (input->show == FAN_PUPIL) {
        const struct bundle_question bundle = analysis_bundle(one, field);
        return pupil_fan_trace(&bundle, (size_t)input->points, one->setup->arena, found, error);
    }
    const struct fan_question question = {.bundle = analysis_bundle(one, field),
                                          .about = (enum wave_about)input->reference,
                                          .points = (size_t)input->points};
    return fan_trace(&question, one->setup->arena, found, error);
}

/* The rows of a field; false: no more are wanted. */
static bool fan_emit(const struct analysis_cursor *at, struct fan_row *row)
{
    static const char *const names[FAN_SECTIONS] = {"tangential", "sagittal"};
    const struct fan *fan = at->found;
    struct fan_ray *rays = ARENA_ARRAY(at->run->arena, fan->points + FAN_ENDS, struct fan_ray);
    const struct fan_input *input = at->input;
    struct arena *arena = at->run->arena;
    const bool is_pupil = input->show == FAN_PUPIL;
    if (is_pupil || input->reference == WAVE_CHIEF) {
        row->point.spectrum = NULL; /* their weights are not used */
    }
    analysis_warn(at, &row->point, is_pupil ? NULL : fan->no_opd);
    analysis_warn(at, &row->point, lens_island_warning(&fan->islands, arena));
    row->reference = wave_reference_words(at->one, (enum wave_about)input->reference, arena);
    row->is_angular = fan->is_angular;
    if (!fan->is_angular) {
        row->at_x = fan->reference[0];
        row->at_y = fan->reference[1];
        row->at_z = fan->reference[2];
    }
    row->radius = fan->no_opd != NULL ? (double)NAN : fan->radius;
    for (size_t g = 0; g < at->one->setup->wavelength_count; g++) {
        row->point.wavelength = at->one->setup->wavelengths[g].wavelength;
        for (size_t s = 0; s < FAN_SECTIONS; s++) {
            row->section = names[s];
            const size_t count = fan_line(fan, g, (enum fan_section)s, rays);
            for (size_t i = 0; i < count; i++) {
                const struct fan_ray *ray = &rays[i];
                row->pupil_x = ray->pupil[0];
                row->pupil_y = ray->pupil[1];
                row->dx = ray->off[0];
                row->dy = ray->off[1];
                row->opd = 1000 * ray->opd / row->point.wavelength;
                row->status = ray_status_name(ray->status);
                row->surface = ray->surface > 0 ? (long)ray->surface : NO_INTEGER;
                if (!run_emit(at->run, row)) {
                    return false;
                }
            }
        }
    }
    return true;
}

static bool fan_run(const void *data, struct run *run, struct error *error)
{
    const struct fan_input *input = data;
    struct analysis_cursor at =
        analysis_begin_finding(input, &policy, run, fan_find, sizeof(struct fan));
    if (input->points % 2 != 1) {
        return fail(error, ERROR_USAGE,
                    "{--points} %ld: an odd number, so that one ray lies in the middle",
                    input->points);
    }
    while (analysis_next(&at, error)) {
        struct fan_row row;
        analysis_begin_row(&at, &transverse_sheet, &row);
        if (!(at.lost == NULL ? fan_emit(&at, &row) : run_emit(run, &row))) {
            return true;
        }
    }
    return error->code == ERROR_NONE;
}

/* -------- the drawing: two panels a field -------- */

enum { FINE = 201, MOST_KEYS = 64 };

/* The scale of pupil aberrations at least, %: what is less calls for nothing. */
static const double PUPIL_LEAST = 0.5;

/* One wavelength of one field. */
struct fan_curve {
    const char *label; /* of the field */
    double wavelength; /* um */
    size_t row;
    double *x[FAN_SECTIONS], *y[FAN_SECTIONS];
    size_t counts[FAN_SECTIONS];
};

/* The drawing at work. */
struct fan_figure_painter {
    const struct artifact_job *job;
    struct fan_input input; /* the one being answered, with `points` */
    struct arena *arena;
    struct fan_curve *curves;
    size_t count, room;
    const char **rows;   /* what stands beside them */
    const char **lenses; /* and whose they are */
    size_t row_count, row_room, lens_room;
    const char *title, *reference; /* reference: null = no fan arrived */
    const char *words;             /* what all fans have of their cases; null: nothing */
    bool differs, several;         /* the words; the lenses */
    bool is_angular;
};

/* What tells a field from the others: only what differs or is asked for. */
static const char *figure_label_of(const struct fan_figure_painter *painter,
                                   const struct field_point *field, const char *position)
{
    const struct analysis_question *question = &painter->input.question;
    struct arena *arena = painter->arena;
    const char *words = analysis_place_words(field, arena);
    if (lens_positions_several(question->lens.lens, question->position)) {
        words = arena_printf(arena, "%s, %s", position, words);
    }
    if (!isnan(question->defocus)) {
        words = arena_printf(arena, "%s, %s%.4g mm", words, question->defocus < 0 ? "−" : "",
                             fabs(question->defocus));
    }
    if (!isnan(question->fnumber)) {
        words = arena_printf(arena, "%s, f/%.4g", words, question->fnumber);
    }
    if (!isnan(question->object)) {
        words = arena_printf(arena, "%s, from %.6g mm", words, question->object);
    }
    return words;
}

/* The row of a field: that of another wavelength of it, or a new one. */
static size_t fan_row_of(struct fan_figure_painter *painter, const char *lens, const char *label,
                         double wavelength)
{
    for (size_t i = painter->row_count; i-- > 0;) {
        bool taken = strcmp(painter->rows[i], label) != 0 || strcmp(painter->lenses[i], lens) != 0;
        for (size_t k = 0; k < painter->count && !taken; k++) {
            const struct fan_curve *curve = &painter->curves[k];
            taken = curve->row == i && !(fabs(curve->wavelength - wavelength) > 0);
        }
        if (!taken) {
            return i;
        }
    }
    painter->rows = arena_grow(painter->arena, painter->rows, painter->row_count,
                               &painter->row_room, sizeof *painter->rows);
    painter->lenses = arena_grow(painter->arena, painter->lenses, painter->row_count,
                                 &painter->lens_room, sizeof *painter->lenses);
    painter->lenses[painter->row_count] = lens;
    painter->several = painter->several || strcmp(painter->lenses[0], lens) != 0;
    painter->rows[painter->row_count] = label;
    return painter->row_count++;
}

/* The fans of a field; one without light has its row all the same. */
static void fan_figure_add(struct fan_figure_painter *painter, const struct analysis_cursor *at)
{
    const struct setup *setup = at->one->setup;
    const struct fan *fan = at->found;
    const char *label = figure_label_of(painter, &setup->fields[at->field].point, setup->position);
    if (at->lost == NULL || painter->title == NULL) {
        painter->title = setup->lens->title;
    }
    if (at->lost != NULL) {
        fan_row_of(painter, setup->lens->title, label, NAN);
        return;
    }
    const bool is_pupil = painter->input.show == FAN_PUPIL;
    const char *reference =
        is_pupil
            ? "rays aimed at the paraxial entrance pupil, from where they should cross the stop"
            : wave_reference_words(at->one, (enum wave_about)painter->input.reference,
                                   painter->arena);
    bool differs = painter->reference != NULL && strcmp(painter->reference, reference) != 0;
    painter->reference = differs ? "the chief ray of each wavelength" : reference;
    painter->is_angular = fan->is_angular;
    const char *words = analysis_figure_words(
        at->one, is_pupil ? FIGURE_APERTURE : FIGURE_APERTURE | FIGURE_PLANE, painter->arena);
    painter->differs =
        painter->differs || (painter->words != NULL && strcmp(painter->words, words) != 0);
    painter->words = words;
    for (size_t g = 0; g < setup->wavelength_count; g++) {
        struct arena *arena = painter->arena;
        struct fan_curve curve = {
            label,
            setup->wavelengths[g].wavelength,
            fan_row_of(painter, setup->lens->title, label, setup->wavelengths[g].wavelength),
            {0},
            {0},
            {0}};
        const size_t room = fan->points + FAN_ENDS;
        struct fan_ray *rays = ARENA_ARRAY(arena, room, struct fan_ray);
        for (size_t s = 0; s < FAN_SECTIONS; s++) {
            curve.x[s] = ARENA_ARRAY(arena, room, double);
            curve.y[s] = ARENA_ARRAY(arena, room, double);
            curve.counts[s] = fan_line(fan, g, (enum fan_section)s, rays);
            for (size_t i = 0; i < curve.counts[s]; i++) {
                const double *pupil = rays[i].pupil, *along = fan->along;
                curve.x[s][i] = s == FAN_TANGENTIAL ? pupil[0] * along[0] + pupil[1] * along[1]
                                                    : pupil[0] * along[1] - pupil[1] * along[0];
                const double *off = rays[i].off;
                const double aside = s == FAN_TANGENTIAL ? off[0] * along[0] + off[1] * along[1]
                                                         : off[0] * along[1] - off[1] * along[0];
                /* waves; or the component along the section, um, mrad or % */
                const double unit = is_pupil ? 100 : 1000;
                curve.y[s][i] = painter->input.show == FAN_OPD
                                    ? 1000 * rays[i].opd / setup->wavelengths[g].wavelength
                                    : unit * aside;
            }
        }
        painter->curves = arena_grow(arena, painter->curves, painter->count, &painter->room,
                                     sizeof *painter->curves);
        painter->curves[painter->count++] = curve;
    }
}

/* The wavelengths that occur, ascending. */
static size_t find_keys(const struct fan_figure_painter *painter, double *keys)
{
    size_t count = 0;
    for (size_t i = 0; i < painter->count; i++) {
        double wavelength = painter->curves[i].wavelength;
        size_t at = 0;
        while (at < count && keys[at] < wavelength) {
            at++;
        }
        bool known = at < count && !(keys[at] > wavelength);
        if (known || count == MOST_KEYS) {
            continue;
        }
        for (size_t k = count++; k > at; k--) {
            keys[k] = keys[k - 1];
        }
        keys[at] = wavelength;
    }
    return count;
}

/* Panels two a row, with what the axes have to reach in `most`. */
static struct panel *make_panels(const struct fan_figure_painter *painter, const double *keys,
                                 size_t key_count, double *most)
{
    struct arena *arena = painter->arena;
    struct panel *panels = ARENA_ARRAY(arena, FAN_SECTIONS * painter->row_count + 1, struct panel);
    for (size_t i = 0; i < FAN_SECTIONS * painter->row_count; i++) {
        struct panel_series *series = ARENA_ARRAY(arena, painter->count + 1, struct panel_series);
        size_t count = 0, section = i % FAN_SECTIONS, sizes = 0, room = 1;
        for (size_t k = 0; k < painter->count; k++) {
            room += painter->curves[k].counts[section];
        }
        double *size = ARENA_ARRAY(arena, room, double);
        for (size_t k = 0; k < painter->count; k++) {
            const struct fan_curve *curve = &painter->curves[k];
            if (curve->row != i / FAN_SECTIONS) {
                continue;
            }
            size_t key = 0;
            while (key + 1 < key_count && keys[key] < curve->wavelength) {
                key++;
            }
            series[count++] = (struct panel_series){.x = curve->x[section],
                                                    .y = curve->y[section],
                                                    .count = curve->counts[section],
                                                    .key = key};
            for (size_t j = 0; j < curve->counts[section]; j++) {
                size[sizes] = fabs(curve->y[section][j]);
                sizes += isfinite(size[sizes]) ? 1 : 0;
            }
        }
        *most = fmax(*most, ticks_reach(size, sizes));
        panels[i] = (struct panel){
            .series = series, .count = count, .note = sizes > 0 ? NULL : "no ray arrives"};
    }
    return panels;
}

static bool fan_figure(const struct artifact_job *job, struct output *sink, struct error *error)
{
    struct fan_figure_painter painter = {.job = job, .arena = job->run->arena};
    long points = FINE;
    for (size_t i = 0; i < job->count; i++) {
        const long asked = ((const struct fan_input *)job->inputs[i])->points;
        points = asked > points ? asked : points;
    }
    for (size_t i = 0; i < job->count; i++) {
        painter.input = *(const struct fan_input *)job->inputs[i];
        painter.input.points = points;
        struct analysis_cursor at =
            analysis_begin_finding(&painter.input, &policy, job->run, fan_find, sizeof(struct fan));
        at.keeps_lost = true;
        while (analysis_next(&at, error)) {
            fan_figure_add(&painter, &at);
        }
        if (error->code != ERROR_NONE) {
            return false;
        }
    }
    static const char *const heads[FAN_SECTIONS] = {"tangential", "sagittal"};
    struct arena *arena = painter.arena;
    double keys[MOST_KEYS], most = 0;
    size_t key_count = find_keys(&painter, keys);
    const char **words = ARENA_ARRAY(arena, key_count + 1, const char *);
    for (size_t k = 0; k < key_count; k++) {
        words[k] = arena_printf(arena, "%.5g nm", 1000 * keys[k]);
    }
    const struct fan_input *first = painter.job->inputs[0];
    static const char *const titles[] = {"Ray fans", "Optical path differences",
                                         "Pupil aberrations"};
    const char *what = titles[first->show];
    const struct panel *list = make_panels(&painter, keys, key_count, &most);
    most = first->show == FAN_PUPIL ? fmax(most, PUPIL_LEAST) : most;
    const char *transverse =
        painter.is_angular ? "transverse aberration (mrad)" : "transverse aberration (µm)";
    const char *const labels[] = {transverse, "optical path difference (waves)",
                                  "deviation in the stop (% of its radius)"};
    const char *const before[] = {"from ", "against ", ""};
    const bool entrance = first->show == FAN_PUPIL || first->question.aim == ANALYSIS_AIM_ENTRANCE;
    const char *subtitle = NULL;
    if (painter.reference != NULL) {
        subtitle = arena_printf(arena, "%s%s%s%s", before[first->show], painter.reference,
                                painter.differs ? "" : "; ", painter.differs ? "" : painter.words);
    }
    const struct panels panels = {
        .title = painter.several ? what : ARENA_JOIN(arena, what, " of ", painter.title),
        .subtitle = subtitle,
        .x_label = entrance ? "across the entrance pupil, in its radius"
                            : "across the stop, in its radius",
        .y_label = labels[first->show],
        .column_heads = heads,
        .row_heads = painter.rows,
        .row_captions = painter.several ? painter.lenses : NULL,
        .keys = words,
        .key_count = key_count,
        .light = true,
        .x_low = -1,
        .x_high = 1,
        .y_low = -most,
        .y_high = most,
        .columns = FAN_SECTIONS,
        .panels = list,
        .count = FAN_SECTIONS * painter.row_count,
    };
    struct svg svg = {.arena = arena};
    return panels_draw(&panels, &svg, error) && drawing_write(painter.job, &svg, sink, error);
}

static const struct artifact artifacts[] = {
    {ARTIFACT_OPTION("plot", drawing_types, "draw the fans: two panels per field"),
     .scope = ARTIFACT_OF_SWEEP, .needs_no_rows = true, .make = fan_figure},
};

static const struct explanation explanations[] = {
    {"opd_waves",
     "W = OPL(chief ray) - OPL(ray), to the sphere about the reference through the "
     "chief ray's crossing of the paraxial exit pupil",
     "[Welford86]", "no sphere where that pupil lies in the image plane"},
    {"stop_dy_percent",
     "100 (y in the stop/radius - pupil y), the ray aimed at pupil y of the paraxial entrance "
     "pupil",
     "[OpticStudio25] Pupil Aberration", "in the plane of the paraxial entrance pupil"},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"fan double-gauss --plot fans.svg", "ray fans of all fields and wavelengths"},
    {"fan double-gauss --show opd --plot paths.svg", "the same as optical path differences"},
    {"fan double-gauss --show pupil --plot pupil.svg", "aberrations of the entrance pupil"},
    {"fan double-gauss --field 14deg -w d --points 5", "few rays of one field, at one wavelength"},
    {"fan cooke-triplet-50 --reference centroid --csv", "from the centroid, for another program"},
    {NULL, NULL},
};

const struct command command_fan = {
    .name = "fan",
    .summary = "ray fans: aberrations along two sections of the pupil",
    COMMAND_ASKS(struct fan_input),
    .sheet = SHEET(transverse_columns, struct fan_row),
    .choose_sheet = fan_choose_sheet,
    .sheets = sheets,
    .explanations = explanations,
    .run = fan_run,
    .makes_many = command_always_many,
    ANALYSIS_COMMAND,
    COMMAND_MAKES(artifacts),
    .most_answers = 100000,
};
