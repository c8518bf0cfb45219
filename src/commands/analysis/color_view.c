/* commands/analysis/color_view.c - the three curves of lenscalc color. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/color_view.h"

#include "draw/panels.h"

#include <stdlib.h>

const struct analysis_policy color_policy = {.wavelengths = WAVELENGTHS_ALL, .fields = FIELDS_EDGE};

/* -------- a case -------- */

struct field_point color_field(const struct field_point *edge, long i, long steps)
{
    struct field_point point = *edge;
    for (int k = 0; k < 2; k++) {
        point.value[k] = edge->value[k] * (double)i / (double)steps;
    }
    return point;
}

void color_direction(const struct setup *setup, const struct field_point *field, double along[2])
{
    const double x = field->value[0], y = field->value[1], length = hypot(x, y);
    const double sign = y < 0 || (y == 0 && x < 0) ? -1 : 1;
    along[0] = length > 0 ? sign * x / length : (double)(setup_axis(setup) == 0);
    along[1] = length > 0 ? sign * y / length : (double)(setup_axis(setup) == 1);
}

static const char *color_case_words_of(const struct color_summary *summary, bool afocal,
                                       struct arena *arena)
{
    const double a = 1000 * summary->shortest, b = 1000 * summary->longest;
    if (afocal) {
        return arena_printf(arena, "axial colour from %.5g to %.5g nm: %.4g per metre", a, b,
                            1000 * summary->vergence);
    }
    const char *words = arena_printf(arena, "axial colour from %.5g to %.5g nm: %.4g mm", a, b,
                                     summary->axial.primary);
    return isnan(summary->axial.secondary) ? words
                                           : arena_printf(arena, "%s, secondary spectrum %.4g mm",
                                                          words, summary->axial.secondary);
}

bool color_summarize(const struct analysis_case *one, struct color_summary *summary,
                     struct error *error)
{
    const struct setup *setup = one->setup;
    const double primary = lens_primary_wavelength(setup->lens);
    struct chromatic_focus foci[3];
    *summary = (struct color_summary){.axial = {NAN, NAN}, .vergence = NAN};
    /* the ends are those of the wavelengths asked for at once, else of the lens */
    const struct lens *lens = setup->lens;
    const bool asked = setup->wavelength_count > 1;
    const size_t count = asked ? setup->wavelength_count : lens->wavelength_count;
    double shortest = INFINITY, longest = 0;
    for (size_t i = 0; i < count; i++) {
        const double at =
            asked ? setup->wavelengths[i].wavelength : lens->wavelengths[i].wavelength;
        shortest = fmin(shortest, at);
        longest = fmax(longest, at);
    }
    summary->shortest = shortest < longest ? shortest : (double)NAN;
    summary->longest = shortest < longest ? longest : (double)NAN;
    if (isnan(summary->shortest)) {
        return true;
    }
    if (!chromatic_focus(setup, summary->shortest, &foci[0], error) ||
        !chromatic_focus(setup, primary, &foci[1], error) ||
        !chromatic_focus(setup, summary->longest, &foci[2], error)) {
        return false;
    }
    size_t middle = primary <= summary->shortest ? 0u : 1u;
    if (primary >= summary->longest) {
        middle = 2;
    }
    if (isinf(setup->first.image)) {
        summary->vergence = foci[0].vergence - foci[2].vergence;
    } else {
        summary->axial = chromatic_axial(&foci[0], &foci[middle], &foci[2]);
    }
    summary->words = color_case_words_of(summary, isinf(setup->first.image), setup->arena);
    return true;
}

/* -------- the drawing -------- */

enum { MOST_COLOURS = 5, SAMPLES = 121, ZONES = 40, FIELDS = 32, PANELS = 3 };

static const double TO_NM = 1000, TO_UM = 1000, TO_MRAD = 1000, SMALL = 0.2;

/* The page in the making. */
struct color_painter {
    const struct artifact_job *job;
    const struct color_input *input;
    struct arena *arena;
    const struct analysis_case *one;
    size_t field;
    double *waves; /* um, ascending */
    size_t wave_count;
    struct chromatic_focus primary;
    struct panel panels[PANELS];
};

static const struct color_input *view_input_at(const struct artifact_job *job, size_t i)
{
    return job->inputs[i];
}

/* All that the sweep asks for, and the primary one; each once. */
static void collect_waves(struct color_painter *painter)
{
    const struct setup *setup = painter->one->setup;
    const bool asked = painter->input->question.wavelength.name != NULL;
    const size_t most = (asked ? painter->job->count : setup->wavelength_count) + 1;
    double *waves = ARENA_ARRAY(painter->arena, most, double);
    size_t count = 0;
    waves[most - 1] = lens_primary_wavelength(setup->lens);
    for (size_t i = 0; i + 1 < most; i++) {
        waves[i] = asked ? view_input_at(painter->job, i)->question.wavelength.wavelength
                         : setup->wavelengths[i].wavelength;
    }
    qsort(waves, most, sizeof *waves, analysis_ascending);
    for (size_t i = 0; i < most; i++) {
        if (i == 0 || waves[i] > waves[count - 1]) {
            waves[count++] = waves[i];
        }
    }
    painter->waves = waves;
    painter->wave_count = count;
    /* so many that each can be told apart: both ends, and what lies between in even steps */
    if (count > MOST_COLOURS) {
        for (size_t i = 0; i < MOST_COLOURS; i++) {
            waves[i] = waves[i * (count - 1) / (MOST_COLOURS - 1)];
        }
        painter->wave_count = MOST_COLOURS;
    }
}

/* A shift along the axis: mm, or 1/m of an afocal lens. */
static double axial_of(const struct color_painter *painter, const struct chromatic_focus *focus)
{
    return isinf(painter->one->setup->first.image)
               ? 1000 * (focus->vergence - painter->primary.vergence)
               : focus->image - painter->primary.image;
}

static const char *axial_label(const struct color_painter *painter, const struct panel *panel,
                               bool along_x, const char *words)
{
    const char *unit = "1/m";
    if (!isinf(painter->one->setup->first.image)) {
        /* in thousandths of the unit where all of it is small */
        double most = 0;
        for (size_t s = 0; s < panel->count; s++) {
            const double *values = along_x ? panel->series[s].x : panel->series[s].y;
            for (size_t i = 0; i < panel->series[s].count; i++) {
                most = isfinite(values[i]) ? fmax(most, fabs(values[i])) : most;
            }
        }
        unit = most < SMALL ? "\xc2\xb5m" : "mm";
        for (size_t s = 0; s < panel->count && most < SMALL; s++) {
            /* the painter's own numbers */
            double *values = (double *)(along_x ? panel->series[s].x : panel->series[s].y);
            for (size_t i = 0; i < panel->series[s].count; i++) {
                values[i] *= TO_UM;
            }
        }
    }
    return arena_printf(painter->arena, "%s (%s)", words, unit);
}

/* -------- the panels -------- */

/* The curve, then a dot a wavelength. */
static bool draw_shift(struct color_painter *painter, struct error *error)
{
    const struct setup *setup = painter->one->setup;
    const size_t count = painter->wave_count + 1;
    const double low = painter->waves[0], high = painter->waves[painter->wave_count - 1];
    struct panel_series *series = ARENA_ARRAY(painter->arena, count, struct panel_series);
    for (size_t s = 0; s < count; s++) {
        const size_t points = s == 0 ? SAMPLES : 1;
        double *x = ARENA_ARRAY(painter->arena, points, double),
               *y = ARENA_ARRAY(painter->arena, points, double);
        for (size_t i = 0; i < points; i++) {
            const double at =
                s > 0 ? painter->waves[s - 1] : low + (high - low) * (double)i / (SAMPLES - 1);
            struct chromatic_focus focus;
            if (!chromatic_focus(setup, at, &focus, error)) {
                return false;
            }
            x[i] = TO_NM * at;
            y[i] = axial_of(painter, &focus);
        }
        series[s] = (struct panel_series){
            .x = x, .y = y, .count = points, .key = s > 0 ? s - 1 : 0, .spots = s > 0};
    }
    struct panel *panel = &painter->panels[0];
    *panel = (struct panel){
        .title = "Focal shift", .x_label = "wavelength (nm)", .series = series, .count = count};
    /* the curve beneath the dots is that of the middle colour */
    series[0].key = painter->wave_count / 2;
    panel->y_label = axial_label(painter, panel, false, "shift");
    return true;
}

static bool draw_zones(struct color_painter *painter, struct error *error)
{
    const struct setup *setup = painter->one->setup;
    const bool entrance = painter->input->question.aim == ANALYSIS_AIM_ENTRANCE;
    struct panel_series *series =
        ARENA_ARRAY(painter->arena, painter->wave_count, struct panel_series);
    struct panel *panel = &painter->panels[1];
    *panel = (struct panel){
        .title = "Spherochromatism", .y_label = "zone", .series = series, .x_label = "shift"};
    for (size_t s = 0; s < painter->wave_count; s++) {
        double *x = ARENA_ARRAY(painter->arena, ZONES + 1, double),
               *y = ARENA_ARRAY(painter->arena, ZONES + 1, double);
        for (size_t i = 0; i <= ZONES; i++) {
            struct chromatic_focus focus;
            y[i] = (double)i / ZONES;
            if (!chromatic_zone(setup, painter->waves[s], y[i], entrance, &focus, error)) {
                panel->note = "no ray through a zone"; /* no stop, or no aperture */
                return true;
            }
            x[i] = axial_of(painter, &focus);
        }
        series[s] = (struct panel_series){.x = x, .y = y, .count = ZONES + 1, .key = s};
    }
    panel->count = painter->wave_count;
    panel->x_label = axial_label(painter, panel, true, "shift");
    return true;
}

static bool draw_fields(struct color_painter *painter, struct error *error)
{
    const struct setup *setup = painter->one->setup;
    const struct field_point *edge = &setup->fields[painter->field].point;
    const bool angular = isnan(setup->image), angle = edge->kind == FIELD_ANGLE;
    const double middle = lens_primary_wavelength(setup->lens);
    double along[2];
    struct panel_series *series =
        ARENA_ARRAY(painter->arena, painter->wave_count, struct panel_series);
    struct panel *panel = &painter->panels[2];
    *panel = (struct panel){.title = "Lateral colour",
                            .x_label = angular ? "shift (mrad)" : "shift (\xc2\xb5m)",
                            .y_label = angle ? "field (deg)" : "field height (mm)",
                            .series = series};
    for (size_t s = 0; s < painter->wave_count; s++) {
        series[s] = (struct panel_series){.x = ARENA_ARRAY(painter->arena, FIELDS + 1, double),
                                          .y = ARENA_ARRAY(painter->arena, FIELDS + 1, double),
                                          .count = FIELDS + 1,
                                          .key = s};
    }
    color_direction(setup, edge, along);
    for (long i = 0; i <= FIELDS; i++) {
        const struct field_point at = color_field(edge, i, FIELDS);
        const bool degrees = angle || at.kind == FIELD_NONE;
        const double far = field_extent(at.kind, at.value) * (degrees ? DEGREES_PER_RADIAN : 1);
        struct chromatic_chief primary, chief;
        bool found = chromatic_chief(setup, &at, middle, &primary, error);
        for (size_t s = 0; s < painter->wave_count; s++) {
            found = found && chromatic_chief(setup, &at, painter->waves[s], &chief, error);
            const struct chromatic_lateral lateral =
                found ? chromatic_lateral(&primary, &chief, along)
                      : (struct chromatic_lateral){NAN, NAN};
            ((double *)series[s].x)[i] = angular ? TO_MRAD * lateral.angle : TO_UM * lateral.height;
            ((double *)series[s].y)[i] = far;
        }
        panel->note = found ? panel->note : "no chief ray where a curve ends";
    }
    panel->count = painter->wave_count;
    return true;
}

/* -------- the page -------- */

/* Is it the same question at another wavelength? */
static bool color_is_alike(const struct analysis_question *a, const struct analysis_question *b)
{
    const double pairs[][2] = {{a->fnumber, b->fnumber},   {a->field, b->field},
                               {a->field_x, b->field_x},   {a->height, b->height},
                               {a->height_x, b->height_x}, {a->object, b->object},
                               {a->defocus, b->defocus}};
    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; i++) {
        if (pairs[i][0] < pairs[i][1] || pairs[i][0] > pairs[i][1]) {
            return false;
        }
    }
    return a->lens.lens == b->lens.lens;
}

bool color_view_check(const struct artifact_job *job, struct error *error)
{
    const struct analysis_question *first = &view_input_at(job, 0)->question;
    for (size_t i = 1; i < job->count; i++) {
        if (!color_is_alike(first, &view_input_at(job, i)->question)) {
            return fail(error, ERROR_USAGE,
                        "{--plot} shows one lens and one field: only {--wavelength} may be a list");
        }
    }
    return !lens_positions_several(first->lens.lens, first->position) ||
           fail(error, ERROR_USAGE, "{--plot} shows one position: name it with {--position}");
}

bool color_view_draw(const struct artifact_job *job, struct output *sink, struct error *error)
{
    struct svg svg = {.arena = job->run->arena};
    struct color_painter painter = {.job = job, .input = view_input_at(job, 0), .arena = svg.arena};
    struct analysis_cursor at = analysis_begin(painter.input, &color_policy, job->run);
    if (!analysis_next(&at, error)) {
        return false;
    }
    painter.one = at.one;
    painter.field = at.field;
    const struct setup *setup = at.one->setup;
    const double primary = lens_primary_wavelength(setup->lens);
    struct color_summary summary;
    collect_waves(&painter);
    if (!color_summarize(at.one, &summary, error) ||
        !chromatic_focus(setup, primary, &painter.primary, error) || !draw_shift(&painter, error) ||
        !draw_zones(&painter, error) || !draw_fields(&painter, error)) {
        return false;
    }
    const char **keys = ARENA_ARRAY(painter.arena, painter.wave_count, const char *);
    for (size_t i = 0; i < painter.wave_count; i++) {
        keys[i] = arena_printf(painter.arena, "%.5g nm", TO_NM * painter.waves[i]);
    }
    const char *position = setup->position, *said = summary.words;
    const char *aperture = isfinite(setup->first.fnumber)
                               ? arena_printf(svg.arena, "f/%.4g, ", setup->first.fnumber)
                               : "";
    const struct panels page = {
        .title = arena_printf(painter.arena, "Colour of %s", setup->lens->title),
        .subtitle =
            arena_printf(svg.arena, "%s%s%srelative to %.5g nm%s%s",
                         position != NULL ? position : "", position != NULL ? ", " : "", aperture,
                         TO_NM * primary, said != NULL ? "; " : "", said != NULL ? said : ""),
        .keys = keys,
        .key_count = painter.wave_count,
        .light = true,
        .own_x = true,
        .own_y = true,
        .columns = PANELS,
        .panels = painter.panels,
        .count = PANELS,
    };
    return panels_draw(&page, &svg, error) && drawing_write(job, &svg, sink, error);
}
