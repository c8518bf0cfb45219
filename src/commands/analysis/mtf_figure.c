/* commands/analysis/mtf_figure.c - contrast drawn against frequency, focus or field. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/mtf_figure.h"

#include "analysis/image/mtf_curve.h"
#include "commands/analysis/figure_captions.h"
#include "draw/plot.h"
#include "draw/plot_sample.h"

#include <stdlib.h>
#include <string.h>

const struct analysis_policy mtf_policy = {.wavelengths = WAVELENGTHS_ALL, .fields = FIELDS_ALL};

bool mtf_field_open(const struct analysis_cursor *at, const struct analysis_case *one, size_t field,
                    void *source, struct error *error)
{
    const struct mtf_input *input = at->input;
    struct arena *arena = one->setup->arena;
    struct mtf_question *question = ARENA_NEW(arena, struct mtf_question);
    *question = (struct mtf_question){.bundle = analysis_bundle(one, field),
                                      .by_rays = input->method == MTF_BY_RAYS,
                                      .error = input->question.error};
    return mtf_open(question, arena, source, error);
}

/* What the pixels leave of the contrast at a frequency. */
static double mtf_pixels(const struct mtf_input *input, double frequency)
{
    return fabs(mtf_square_pixels(frequency, input->pitch));
}

bool mtf_with_pixels(const struct mtf_source *source, const struct mtf_input *input,
                     double frequency, struct arena *arena, struct mtf *mtf, struct error *error)
{
    if (input->square) {
        return mtf_square_find(source, frequency, input->pitch, arena, mtf, error);
    }
    const double left = mtf_pixels(input, frequency);
    if (!mtf_find(source, frequency, arena, mtf, error)) {
        return false;
    }
    for (size_t k = 0; k < MTF_DIRECTIONS; k++) {
        mtf->contrast[k] *= left;
        mtf->limit[k] *= left;
    }
    return true;
}

/* -------- the drawing -------- */

/* COLOURS: of curves before they come again; DOTTED: the dashes of the limit. */
enum { COLOURS = 7, DOTTED = 3, CURVES_MOST = 14, FIELDS_MANY = 4 };
enum { STEPS = 241, FIRST_STEPS = 17, MOST = 16384 };

/* The default of --error; below it a drawing is made of exact points too. */
static const double usual_error = 1e-4;

/* Of what a drawing shows, and what nobody sees in it: a sixth of a pixel. */
static const double fine = 1e-3, unseen = 5e-4;

/* What contrast is drawn against. */
enum figure_axis { BY_FREQUENCY, BY_FOCUS, BY_FIELD };

/* A point of the drawing. */
struct figure_entry {
    double x, contrast[MTF_DIRECTIONS], limit;
    bool is_between; /* of what was asked for */
    size_t caption;  /* of its curve */
};

struct figure_painter {
    const struct artifact_job *job;
    const struct mtf_input *input;
    struct arena *arena;
    enum figure_axis axis;
    bool is_angle;
    double highest; /* frequency; NaN: as the light has it */
    struct figure_entry *list;
    size_t count;
    struct captions captions;
    bool has_methods; /* several, which legends tell apart; else the subtitle has it */
    double off;       /* what contrasts may be off, where that is known */
    bool is_between;
    bool is_cut; /* some curve ends where its wave front is too steep for a drawing */
};

/* A point more; null: there is no room. */
static struct figure_entry *new_entry(struct figure_painter *painter,
                                      const struct figure_entry *place, struct error *error)
{
    if (painter->count == MOST) {
        fail(error, ERROR_USAGE, "{--plot} has room for %d points, not for more", MOST);
        return NULL;
    }
    struct figure_entry *entry = &painter->list[painter->count++];
    *entry = *place;
    return entry;
}

/*
 * Contrasts at once, up to where the wave front is not too steep: a first curve says how far the
 * drawing goes, others may end before. Wider steps, which want a coarser grid, would show corners:
 * they come last.
 *
 * Given     highest  as far as it may go; receives how far it does
 * Result    false: each has to be found by itself; else contrasts at 0, highest/(steps - 1) ...
 */
static bool figure_find_curve(struct figure_painter *painter, const struct mtf_source *source,
                              struct mtf_curve *curve, size_t *count, size_t *steps,
                              double *highest)
{
    enum { LEAST = 8, TRIES = 24, STEPS_LEAST = 61 };
    const struct mtf_input *input = painter->input;
    const bool may_cut = painter->count == 0 && isnan(input->frequency);
    if (input->square || input->method != MTF_BY_WAVES || input->question.error < usual_error ||
        !(*highest > 0)) {
        return false;
    }
    for (*steps = STEPS; *steps >= STEPS_LEAST; *steps = *steps / 2 + 1) {
        double part = 1;
        for (int i = 0; i < TRIES; i++, part *= 0.8) {
            const double end = *highest * (may_cut ? part : 1);
            *count = may_cut ? *steps : (size_t)((double)*steps * part);
            if (*count >= LEAST &&
                mtf_curve_find(source, end / (double)(*steps - 1), *count, painter->arena, curve)) {
                painter->is_cut = painter->is_cut || i > 0;
                *highest = end;
                return true;
            }
        }
    }
    return false;
}

/* Contrasts of one curve that are found one by one, where a drawing wants them. */
struct contrasts {
    struct figure_painter *painter;
    const struct mtf_source *source;
    struct error *error;
    bool has_failed;
};

static bool contrasts_at(void *context, double frequency, double *y)
{
    struct contrasts *contrasts = context;
    struct figure_painter *painter = contrasts->painter;
    struct mtf mtf;
    if (!mtf_with_pixels(contrasts->source, painter->input, frequency, painter->arena, &mtf,
                         contrasts->error)) {
        contrasts->has_failed = true;
        return false;
    }
    memcpy(y, mtf.contrast, sizeof mtf.contrast);
    y[MTF_DIRECTIONS] = fmax(mtf.limit[0], mtf.limit[1]);
    painter->off = isfinite(mtf.error) ? fmax(painter->off, mtf.error) : painter->off;
    return true;
}

static bool add_contrasts(struct figure_painter *painter, const struct mtf_source *source,
                          double highest, const struct figure_entry *place, struct error *error)
{
    enum { KINDS = MTF_DIRECTIONS + 1, SAMPLES = 21, EACH = 1000 };
    const double ends[] = {0, highest}, page[] = {0, 1};
    const struct plot_series frame = {.y = page};
    const struct plot plot = {.x = ends, .count = 2, .series = &frame, .series_count = 1};
    /* the default is an error of numbers, for which steep wave fronts take many more points */
    struct mtf_question question = *source->question;
    question.error = question.error < usual_error ? question.error : fmax(question.error, unseen);
    struct mtf_source drawn = *source;
    drawn.question = &question;
    struct contrasts contrasts = {painter, &drawn, error, false};
    double x[SAMPLES], values[KINDS][SAMPLES], here[KINDS];
    const double *y[KINDS];
    for (size_t i = 0; i < SAMPLES; i++) {
        x[i] = highest * (double)i / (SAMPLES - 1);
        if (!contrasts_at(&contrasts, x[i], here)) {
            return false;
        }
        for (size_t k = 0; k < KINDS; k++) {
            values[k][i] = here[k];
            y[k] = values[k];
        }
    }
    const struct plot_source from = {
        .curves = KINDS, .at = contrasts_at, .context = &contrasts, .most = EACH};
    struct plot_curves curves;
    plot_sample(&plot, x, y, SAMPLES, &from, &curves, painter->arena);
    for (size_t i = 0; i < curves.count && !contrasts.has_failed; i++) {
        struct figure_entry *entry = new_entry(painter, place, error);
        if (entry == NULL) {
            return false;
        }
        entry->x = curves.x[i];
        entry->is_between = true;
        entry->contrast[MTF_TANGENTIAL] = curves.y[MTF_TANGENTIAL][i];
        entry->contrast[MTF_SAGITTAL] = curves.y[MTF_SAGITTAL][i];
        entry->limit = curves.y[MTF_DIRECTIONS][i];
    }
    return !contrasts.has_failed;
}

/* Against frequency, at once where nobody asks for more than a drawing shows. */
static bool figure_add_curve(struct figure_painter *painter, const struct mtf_source *source,
                             const struct figure_entry *place, struct error *error)
{
    /* Where contrast by waves ends, but no farther than anybody looks: twice what rows have. */
    const double cutoff = fmax(source->cutoff[0], source->cutoff[1]);
    struct mtf_curve curve;
    size_t count, steps;
    double highest = isnan(painter->highest) ? fmin(cutoff, 160) : painter->highest;
    const bool found = figure_find_curve(painter, source, &curve, &count, &steps, &highest);
    painter->highest = highest;
    if (!found) {
        return add_contrasts(painter, source, highest, place, error);
    }
    const double off = fmax(source->off[0], source->off[1]);
    painter->off = isfinite(off) ? fmax(painter->off, off) : painter->off;
    for (size_t i = 0; i < count; i++) {
        struct figure_entry *entry = new_entry(painter, place, error);
        if (entry == NULL) {
            return false;
        }
        entry->x = highest * (double)i / (double)(steps - 1);
        entry->is_between = true;
        const double left = mtf_pixels(painter->input, entry->x);
        for (size_t k = 0; k < MTF_DIRECTIONS; k++) {
            entry->contrast[k] = left * curve.contrast[k][i];
            entry->limit = fmax(entry->limit, left * curve.limit[k][i]);
        }
    }
    return true;
}

/* "diffraction, square bars, pixels of 6 um": what contrasts are of. */
static const char *figure_method_words(const struct figure_painter *painter)
{
    const struct mtf_input *input = painter->input;
    const char *pixels =
        isnan(input->pitch)
            ? ""
            : arena_printf(painter->arena, ", pixels of %.4g \xc2\xb5m", 1000 * input->pitch);
    return ARENA_JOIN(painter->arena, input->method == MTF_BY_RAYS ? "geometric" : "diffraction",
                      input->square ? ", square bars" : "", pixels);
}

static bool figure_add(struct figure_painter *painter, const struct analysis_cursor *at,
                       struct error *error)
{
    const struct analysis_case *one = at->one;
    const struct mtf_source *source = at->found;
    struct arena *arena = painter->arena;
    const struct analysis_point point = analysis_point_of(one, at->field);
    const double frequency = painter->input->frequency;
    const char *kind = painter->has_methods ? figure_method_words(painter) : NULL;
    if (painter->axis != BY_FREQUENCY) {
        const char *cycles = arena_printf(arena, "%.4g cycles/mm", frequency);
        kind = kind != NULL ? ARENA_JOIN(arena, kind, ", ", cycles) : cycles;
    }
    struct figure_entry place = {.caption = captions_add(&painter->captions, one, at->field, kind),
                                 .is_between = painter->is_between};
    painter->is_angle = !isnan(point.field);
    if (painter->captions.count > CURVES_MOST) {
        return fail(error, ERROR_USAGE, "{--plot} would draw more than %d pairs of curves",
                    CURVES_MOST);
    }
    if (painter->axis == BY_FREQUENCY) {
        return figure_add_curve(painter, source, &place, error);
    }
    place.x = point.defocus;
    if (painter->axis == BY_FIELD) {
        place.x = painter->is_angle ? degrees_from_radians(point.field) : point.height;
    }
    /* One point, found by itself. */
    struct contrasts contrasts = {painter, source, error, false};
    struct figure_entry *entry = new_entry(painter, &place, error);
    double y[MTF_DIRECTIONS + 1];
    if (entry == NULL || !contrasts_at(&contrasts, frequency, y)) {
        return false;
    }
    memcpy(entry->contrast, y, sizeof entry->contrast);
    entry->limit = y[MTF_DIRECTIONS];
    return true;
}

/* The points of one input. */
static bool figure_add_input(struct figure_painter *painter, const struct mtf_input *input,
                             struct error *error)
{
    struct analysis_cursor at = analysis_begin_finding(input, &mtf_policy, painter->job->run,
                                                       mtf_field_open, sizeof(struct mtf_source));
    at.keeps_lost = true;
    painter->input = input;
    while (analysis_next(&at, error)) {
        if (at.lost == NULL && !figure_add(painter, &at, error)) {
            return false;
        }
    }
    return error->code == ERROR_NONE;
}

#define MTF_VALUES(member) ANALYSIS_VALUES_OF(job, struct mtf_input, member)

static bool choose_axis(struct figure_painter *painter, struct error *error)
{
    const struct artifact_job *job = painter->job;
    const size_t frequencies = MTF_VALUES(frequency);
    const struct mtf_input *last = job->inputs[job->count - 1];
    const size_t fields = MTF_VALUES(question.field) + MTF_VALUES(question.height) - 1;
    const bool given = !isnan(last->frequency);
    if (MTF_VALUES(question.defocus) > 2) {
        painter->axis = BY_FOCUS;
    } else if (given && fields > FIELDS_MANY) {
        painter->axis = BY_FIELD;
    }
    painter->captions.leaves_out[CAPTION_DEFOCUS] = painter->axis == BY_FOCUS;
    painter->captions.leaves_out[CAPTION_FIELD] = painter->axis == BY_FIELD;
    painter->has_methods = MTF_VALUES(method) * MTF_VALUES(square) * MTF_VALUES(pitch) > 1;
    if (painter->axis == BY_FOCUS && (!given || frequencies > 1)) {
        return fail(error, ERROR_USAGE, "{--plot} through focus shows one {--frequency}");
    }
    for (size_t i = 0; i < job->count; i++) {
        painter->highest =
            fmax(painter->highest, ((const struct mtf_input *)job->inputs[i])->frequency);
    }
    return true;
}

/* What the drawing goes along: the defocus of an input, its field or its height. */
static double *figure_place_of(const struct figure_painter *painter, struct mtf_input *input)
{
    struct analysis_question *question = &input->question;
    if (painter->axis == BY_FOCUS) {
        return &question->defocus;
    }
    return isnan(question->field) ? &question->height : &question->field;
}

static int entry_order(const void *first, const void *second)
{
    const struct figure_entry *a = first, *b = second;
    const int by_caption = (a->caption > b->caption) - (a->caption < b->caption);
    return by_caption != 0 ? by_caption : (a->x > b->x) - (a->x < b->x);
}

/* Is the curve bent at the second of three entries, as far as is seen? */
static bool entry_is_bent(const struct figure_entry *three)
{
    const double seen = 1e-3; /* of the height of the drawing */
    const double part = (three[1].x - three[0].x) / (three[2].x - three[0].x);
    double bend = 0;
    for (size_t k = 0; k < MTF_DIRECTIONS; k++) {
        const double y =
            three[0].contrast[k] + part * (three[2].contrast[k] - three[0].contrast[k]);
        bend = fmax(bend, fabs(three[1].contrast[k] - y));
    }
    return bend > seen; /* no bend where a value is missing */
}

/*
 * Middles of the intervals that a drawing shows bent, or that are wide; ascending, each once.
 *
 * Given     middles  room for two an entry
 */
static size_t middles_find(struct figure_painter *painter, double low, double high, double *middles)
{
    const double widest = (high - low) / (FIRST_STEPS - 1), least = (high - low) / 200;
    size_t count = 0, kept = 0;
    qsort(painter->list, painter->count, sizeof *painter->list, entry_order);
    for (size_t i = 0; i + 1 < painter->count; i++) {
        const struct figure_entry *here = &painter->list[i];
        const double width = here[1].x - here->x;
        const bool one = here->caption == here[1].caption;
        const bool before = i > 0 && here[-1].caption == here->caption;
        const bool behind = i + 2 < painter->count && here[1].caption == here[2].caption;
        const bool bent = (before && entry_is_bent(here - 1)) || (behind && entry_is_bent(here));
        if (one && (width > 1.01 * widest || (bent && width > least))) {
            middles[count++] = here->x + width / 2;
        }
    }
    qsort(middles, count, sizeof *middles, analysis_ascending);
    for (size_t i = 0; i < count; i++) {
        if (kept == 0 || middles[i] - middles[kept - 1] > least / 8) {
            middles[kept++] = middles[i];
        }
    }
    return kept;
}

/* Points between those that were asked for, so that curves are smooth. */
static bool collect_between(struct figure_painter *painter, struct error *error)
{
    enum { ROUNDS = 8 };
    const struct artifact_job *job = painter->job;
    const struct unit *degree = unit_find(&dimension_angle, text_of("deg"));
    struct mtf_input first, here;
    double low = INFINITY, high = -INFINITY;
    double *middles = ARENA_ARRAY(painter->arena, MOST, double);
    memcpy(&first, job->inputs[0], sizeof first);
    for (size_t i = 0; i < painter->count; i++) {
        low = fmin(low, painter->list[i].x);
        high = fmax(high, painter->list[i].x);
    }
    painter->is_between = true;
    for (int round = 0; round < ROUNDS; round++) {
        const size_t count = middles_find(painter, low, high, middles);
        for (size_t i = 0; i < job->count; i++) {
            memcpy(&here, job->inputs[i], sizeof here);
            double *place = figure_place_of(painter, &here);
            if (!(fabs(*place - *figure_place_of(painter, &first)) <= 0)) {
                continue;
            }
            for (size_t k = 0; k < count && painter->count < MOST - CURVES_MOST; k++) {
                const bool is_angle = painter->axis == BY_FIELD && painter->is_angle;
                *place = is_angle ? unit_to_own(degree, middles[k]) : middles[k];
                if (!figure_add_input(painter, &here, error)) {
                    return false;
                }
            }
        }
    }
    painter->input = job->inputs[0];
    return true;
}

/* All points of the sweep; against frequency the curves hold all of them anyway. */
static bool figure_collect(struct figure_painter *painter, struct error *error)
{
    const struct artifact_job *job = painter->job;
    const double first = ((const struct mtf_input *)job->inputs[0])->frequency;
    for (size_t i = 0; i < job->count; i++) {
        const struct mtf_input *input = job->inputs[i];
        const bool again =
            painter->axis == BY_FREQUENCY && input->frequency != first && !isnan(input->frequency);
        if (!again && !figure_add_input(painter, input, error)) {
            return false;
        }
    }
    if (painter->axis != BY_FREQUENCY && !collect_between(painter, error)) {
        return false;
    }
    bool any = false;
    for (size_t i = 0; i < painter->count && !any; i++) {
        any = isfinite(painter->list[i].contrast[0]) || isfinite(painter->list[i].contrast[1]);
    }
    return any || fail(error, ERROR_DOMAIN,
                       painter->count == 0
                           ? "there is no contrast to draw"
                           : "wave fronts are too steep or too rough for the diffraction MTF");
}

/* The points of one caption in their order. */
struct figure_curve {
    double *x, *contrast[MTF_DIRECTIONS], *limit;
    unsigned char *places;
    size_t count;
};

/* The curves, one a caption. */
static void figure_curves_collect(struct figure_painter *painter, struct figure_curve *curves)
{
    for (size_t i = 0; i < painter->count; i++) {
        curves[painter->list[i].caption].count++;
    }
    for (size_t k = 0; k < painter->captions.count; k++) {
        struct figure_curve *curve = &curves[k];
        double *room = ARENA_ARRAY(painter->arena, 4 * curve->count, double);
        curve->x = room;
        curve->limit = room + curve->count;
        curve->contrast[MTF_TANGENTIAL] = room + 2 * curve->count;
        curve->contrast[MTF_SAGITTAL] = room + 3 * curve->count;
        curve->places = ARENA_ARRAY(painter->arena, curve->count, unsigned char);
        curve->count = 0;
    }
    qsort(painter->list, painter->count, sizeof *painter->list, entry_order);
    for (size_t i = 0; i < painter->count; i++) {
        const struct figure_entry *entry = &painter->list[i];
        struct figure_curve *curve = &curves[entry->caption];
        const size_t at = curve->count++;
        curve->x[at] = entry->x;
        curve->limit[at] = entry->limit;
        curve->contrast[MTF_TANGENTIAL][at] = entry->contrast[MTF_TANGENTIAL];
        curve->contrast[MTF_SAGITTAL][at] = entry->contrast[MTF_SAGITTAL];
        curve->places[at] = entry->is_between ? PLOT_BETWEEN : PLOT_SAMPLE;
    }
}

/* "T 14°"; of one pair "tangential". */
static const char *figure_label(const struct figure_painter *painter, const char *direction,
                                const char *alone, size_t caption)
{
    const char *label = captions_label(&painter->captions, caption);
    return label != NULL ? ARENA_JOIN(painter->arena, direction, " ", label) : alone;
}

/* Series of curves: of a colour for each caption, sagittal ones dashed. */
static size_t figure_put_series(const struct figure_painter *painter,
                                const struct figure_curve *curves, struct plot_series *series)
{
    const size_t count = painter->captions.count;
    size_t put = 0;
    for (size_t k = 0; k < count; k++) {
        const struct figure_curve *curve = &curves[k];
        const size_t again = 2 * (k / COLOURS);
        const double *t = curve->contrast[MTF_TANGENTIAL], *s = curve->contrast[MTF_SAGITTAL];
        double off = NAN; /* stays so where beyond the first point nothing is known */
        for (size_t i = curve->count > 1; i < curve->count; i++) {
            off = fmax(off, fabs(t[i] - s[i]));
        }
        if (isnan(off)) {
            continue;
        }
        const bool one = off < fine; /* as on the axis of a lens */
        const struct plot_series common = {
            .x = curve->x, .count = curve->count, .places = curve->places, .style = k};
        series[put] = common;
        series[put].label = one ? figure_label(painter, "T, S", "tangential and sagittal", k)
                                : figure_label(painter, "T", "tangential", k);
        series[put].y = curve->contrast[MTF_TANGENTIAL];
        series[put++].dash = 1 + again;
        if (!one) {
            series[put] = common;
            series[put].label = figure_label(painter, "S", "sagittal", k);
            series[put].y = curve->contrast[MTF_SAGITTAL];
            series[put++].dash = 2 + again;
        }
    }
    if (painter->axis == BY_FREQUENCY) {
        const char *limit = captions_have_settings(&painter->captions)
                                ? figure_label(painter, "limit,", NULL, 0)
                                : "diffraction limit";
        series[put++] = (struct plot_series){.label = limit,
                                             .x = curves[0].x,
                                             .y = curves[0].limit,
                                             .count = curves[0].count,
                                             .places = curves[0].places,
                                             .style = count,
                                             .dash = DOTTED};
    }
    return put;
}

bool mtf_figure(const struct artifact_job *job, struct output *sink, struct error *error)
{
    struct svg svg = {.arena = job->run->arena};
    struct figure_painter painter = {
        .job = job, .arena = svg.arena, .highest = NAN, .captions = {.arena = svg.arena}};
    struct figure_curve curves[CURVES_MOST] = {{0}};
    struct plot_series series[MTF_DIRECTIONS * CURVES_MOST + 1];
    painter.list = ARENA_ARRAY(svg.arena, MOST, struct figure_entry);
    if (!choose_axis(&painter, error) || !figure_collect(&painter, error)) {
        return false;
    }
    figure_curves_collect(&painter, curves);
    const char *subtitle = captions_subtitle(&painter.captions);
    if (!painter.has_methods) {
        subtitle = ARENA_JOIN(svg.arena, figure_method_words(&painter), "; ", subtitle);
    }
    const char *const labels[] = {[BY_FREQUENCY] = "spatial frequency (cycles/mm)",
                                  [BY_FOCUS] = "defocus (mm)",
                                  [BY_FIELD] =
                                      painter.is_angle ? "field (\xc2\xb0)" : "field (mm)"};
    struct plot plot = {.title = captions_title(&painter.captions, "MTF"),
                        .subtitle = subtitle,
                        .x_label = labels[painter.axis],
                        .y_label = "modulation transfer",
                        .is_share = true,
                        .series = series};
    if (painter.is_cut) {
        plot.subtitle =
            ARENA_JOIN(svg.arena, plot.subtitle, "; curves end where wave fronts are too steep");
    }
    if (painter.off > fine) {
        plot.subtitle = arena_printf(svg.arena, "%s; up to %.1g off", plot.subtitle, painter.off);
    }
    plot.series_count = figure_put_series(&painter, curves, series);
    return plot_draw(&plot, &svg, error) && drawing_write(job, &svg, sink, error);
}
