/* commands/analysis/mtf_figure.c - contrast drawn against frequency, focus or field. */
/* SPDX-License-Identifier: MIT */
#include "analysis/mtf_curve.h"
#include "commands/analysis/analysis_fields.h"
#include "commands/analysis/analysis_map.h"
#include "commands/analysis/analysis_words.h"
#include "commands/analysis/mtf_input.h"
#include "draw/plot.h"

#include <stdlib.h>
#include <string.h>

enum { STEPS = 61, MOST = 4096, CURVES_MOST = 14, FIELDS_MANY = 4, FIELDS_DRAWN = 17 };

/* Colours of curves before they come again, and the dashes of the limit. */
enum { COLOURS = 7, DOTTED = 3 };

/* The default of --error; below it a drawing is made of exact points too. */
static const double usual_error = 1e-4;

/* Of what a drawing shows. */
static const double fine = 1e-3;

/* What contrast is drawn against. */
enum axis { BY_FREQUENCY, BY_FOCUS, BY_FIELD };

/* A point of the drawing. */
struct entry {
    double x, contrast[MTF_DIRECTIONS], limit;
    const char *label, *lens; /* of its curve */
};

struct painter {
    const struct artifact_job *job;
    const struct mtf_input *input;
    struct arena *arena;
    enum axis axis;
    bool is_angle;
    double highest; /* frequency; NaN: as the light has it */
    struct entry *list;
    size_t count;
    const char *subtitle;
    double off;  /* what contrasts may be off, where that is known */
    bool is_cut; /* some curve ends where its wave front is too steep for a drawing */
};

/* A point more; null: there is no room. */
static struct entry *new_entry(struct painter *painter, const struct entry *place,
                               struct error *error)
{
    if (painter->count == MOST) {
        fail(error, ERROR_USAGE, "{--plot} has room for %d points, not for more", MOST);
        return NULL;
    }
    struct entry *entry = &painter->list[painter->count++];
    *entry = *place;
    return entry;
}

static void note_off(struct painter *painter, double off)
{
    painter->off = isfinite(off) ? fmax(painter->off, off) : painter->off;
}

static bool add_entry(struct painter *painter, const struct mtf_source *source, double frequency,
                      const struct entry *place, struct error *error)
{
    struct mtf mtf;
    struct entry *entry = new_entry(painter, place, error);
    if (entry == NULL ||
        !mtf_with_pixels(source, painter->input, frequency, painter->arena, &mtf, error)) {
        return false;
    }
    memcpy(entry->contrast, mtf.contrast, sizeof entry->contrast);
    note_off(painter, mtf.error);
    entry->limit = fmax(mtf.limit[0], mtf.limit[1]);
    return true;
}

/* Where contrast by waves ends, but no farther than anybody looks: twice what rows have. */
static double highest_of(const struct painter *painter, const struct mtf_source *source)
{
    const double cutoff = fmax(source->cutoff[0], source->cutoff[1]);
    return isnan(painter->highest) ? fmin(cutoff, 160) : painter->highest;
}

/*
 * Contrasts at once, up to where the wave front is not too steep: a first curve says how far the
 * drawing goes, others may end before.
 *
 * Result    how many of the STEPS; 0: each has to be found by itself
 */
static size_t find_curve(struct painter *painter, const struct mtf_source *source, double *highest,
                         struct mtf_curve *curve)
{
    enum { LEAST = 8, TRIES = 24 };
    const struct mtf_input *input = painter->input;
    double end = *highest;
    size_t count = STEPS;
    if (input->method != MTF_BY_WAVES || input->question.error < usual_error || !(*highest > 0)) {
        return 0;
    }
    for (int i = 0; i < TRIES && count >= LEAST; i++) {
        if (mtf_curve_find(source, end / (STEPS - 1), count, painter->arena, curve)) {
            painter->is_cut = painter->is_cut || i > 0;
            *highest = end;
            return count;
        }
        if (painter->count == 0 && isnan(input->frequency)) {
            end *= 0.8;
        } else {
            count = count * 4 / 5;
        }
    }
    return 0;
}

/* Against frequency, at once where nobody asks for more than a drawing shows. */
static bool add_curve(struct painter *painter, const struct mtf_source *source,
                      const struct entry *place, struct error *error)
{
    struct mtf_curve curve;
    double highest = highest_of(painter, source);
    const size_t count = find_curve(painter, source, &highest, &curve);
    painter->highest = highest;
    if (count > 0) {
        note_off(painter, fmax(source->off[0], source->off[1]));
    }
    for (size_t i = 0; i < (count > 0 ? count : STEPS); i++) {
        struct entry here = *place;
        here.x = highest * (double)i / (STEPS - 1);
        if (count == 0) {
            if (!add_entry(painter, source, here.x, &here, error)) {
                return false;
            }
            continue;
        }
        struct entry *entry = new_entry(painter, &here, error);
        if (entry == NULL) {
            return false;
        }
        const double left = mtf_pixels(painter->input, here.x);
        for (size_t k = 0; k < MTF_DIRECTIONS; k++) {
            entry->contrast[k] = left * curve.contrast[k][i];
            entry->limit = fmax(entry->limit, left * curve.limit[k][i]);
        }
    }
    return true;
}

static bool find(const struct analysis_case *one, size_t field, const void *context, void *found,
                 struct error *error)
{
    const struct painter *painter = context;
    return mtf_of_case(one, field, painter->input, one->setup->arena, found, error);
}

static bool add(const struct analysis_case *one, size_t field, const void *found, void *context,
                struct error *error)
{
    const struct mtf_source *source = found;
    struct painter *painter = context;
    struct arena *arena = painter->arena;
    const struct analysis_point point = analysis_point_of(one, field);
    const double frequency = painter->input->frequency;
    struct analysis_question question = *one->question;
    struct analysis_case named = *one;
    named.question = &question;
    question.defocus = painter->axis == BY_FOCUS ? (double)NAN : question.defocus;
    struct entry place = {.label = analysis_map_title(&named, field, arena),
                          .lens = one->setup->lens->title};
    painter->subtitle = arena_printf(arena, "%s; focus %s",
                                     painter->input->method == MTF_BY_RAYS ? "by rays" : "by waves",
                                     one->setup->focus);
    painter->is_angle = !isnan(point.field);
    if (painter->axis == BY_FREQUENCY) {
        return add_curve(painter, source, &place, error);
    }
    if (painter->axis == BY_FOCUS) {
        place.x = point.defocus;
    } else {
        place.x = painter->is_angle ? degrees_from_radians(point.field) : point.height;
        place.label = arena_printf(arena, "%.4g/mm", frequency);
    }
    return add_entry(painter, source, frequency, &place, error);
}

/* How many different values something has among the inputs. */
static size_t values_of(const struct artifact_job *job, size_t offset)
{
    size_t count = 0;
    for (size_t i = 0; i < job->count; i++) {
        bool is_new = true;
        double value, other;
        memcpy(&value, (const char *)job->inputs[i] + offset, sizeof value);
        for (size_t k = 0; k < i && is_new; k++) {
            memcpy(&other, (const char *)job->inputs[k] + offset, sizeof other);
            is_new = !(memcmp(&value, &other, sizeof value) == 0);
        }
        count += is_new;
    }
    return count;
}

static bool choose_axis(struct painter *painter, struct error *error)
{
    const struct artifact_job *job = painter->job;
    const size_t frequencies = values_of(job, offsetof(struct mtf_input, frequency));
    const struct mtf_input *last = job->inputs[job->count - 1];
    const size_t fields = values_of(job, offsetof(struct mtf_input, question.field)) +
                          values_of(job, offsetof(struct mtf_input, question.height)) - 1;
    const bool given = !isnan(last->frequency);
    painter->axis = values_of(job, offsetof(struct mtf_input, question.defocus)) > 2 ? BY_FOCUS
                    : given && fields > FIELDS_MANY                                  ? BY_FIELD
                                                                                     : BY_FREQUENCY;
    if (painter->axis == BY_FOCUS && (!given || frequencies > 1)) {
        return fail(error, ERROR_USAGE, "{--plot} through focus shows one {--frequency}");
    }
    for (size_t i = 0; i < job->count; i++) {
        painter->highest =
            fmax(painter->highest, ((const struct mtf_input *)job->inputs[i])->frequency);
    }
    return true;
}

/* The field or the height of an input, whichever it has. */
static double *place_of(struct mtf_input *input)
{
    struct analysis_question *question = &input->question;
    return isnan(question->field) ? &question->height : &question->field;
}

/* Fields between those that were asked for, so that curves are smooth. */
static bool collect_between(struct painter *painter, const struct analysis_answers *answers,
                            struct error *error)
{
    const struct artifact_job *job = painter->job;
    struct mtf_input first, here;
    double low = INFINITY, high = -INFINITY;
    memcpy(&first, job->inputs[0], sizeof first);
    for (size_t i = 0; i < job->count; i++) {
        memcpy(&here, job->inputs[i], sizeof here);
        low = fmin(low, *place_of(&here));
        high = fmax(high, *place_of(&here));
    }
    for (size_t i = 0; i < job->count; i++) {
        memcpy(&here, job->inputs[i], sizeof here);
        if (!(fabs(*place_of(&here) - *place_of(&first)) <= 0)) {
            continue;
        }
        painter->input = &here;
        for (size_t k = 1; k + 1 < FIELDS_DRAWN; k++) {
            *place_of(&here) = low + (high - low) * (double)k / (FIELDS_DRAWN - 1);
            if (!analysis_each_field(&here.question, &mtf_policy, job->run, answers, painter,
                                     error)) {
                return false;
            }
        }
    }
    painter->input = job->inputs[0];
    return true;
}

/* All points of the sweep; against frequency the curves hold all of them anyway. */
static bool collect(struct painter *painter, struct error *error)
{
    static const struct analysis_answers answers = {
        .find = find, .found_size = sizeof(struct mtf_source), .take = add, .lost = analysis_skip};
    const struct artifact_job *job = painter->job;
    const double first = ((const struct mtf_input *)job->inputs[0])->frequency;
    for (size_t i = 0; i < job->count; i++) {
        painter->input = job->inputs[i];
        const bool again = painter->axis == BY_FREQUENCY && painter->input->frequency != first &&
                           !isnan(painter->input->frequency);
        if (!again && !analysis_each_field(&painter->input->question, &mtf_policy, job->run,
                                           &answers, painter, error)) {
            return false;
        }
    }
    bool any = false;
    if (painter->axis == BY_FIELD && !collect_between(painter, &answers, error)) {
        return false;
    }
    for (size_t i = 0; i < painter->count; i++) {
        const double *contrast = painter->list[i].contrast;
        any = any || isfinite(contrast[0]) || isfinite(contrast[1]);
    }
    return any || fail(error, ERROR_DOMAIN,
                       painter->count == 0
                           ? "there is no contrast to draw"
                           : "wave fronts are too steep or too rough for contrasts by waves");
}

/* The title; curves of several lenses are called by them too. */
static const char *name_curves(const struct painter *painter)
{
    const char *lens = painter->list[0].lens;
    bool one = true;
    for (size_t i = 0; i < painter->count; i++) {
        one = one && strcmp(painter->list[i].lens, lens) == 0;
    }
    for (size_t i = 0; i < painter->count && !one; i++) {
        struct entry *entry = &painter->list[i];
        entry->label = arena_printf(painter->arena, "%s, %s", entry->label, entry->lens);
    }
    return one ? arena_printf(painter->arena, "Contrast of %s", lens) : "Contrast";
}

static int by_value(const void *first, const void *second)
{
    const double a = *(const double *)first, b = *(const double *)second;
    return (a > b) - (a < b);
}

/* The different x, ascending. */
static size_t find_x(const struct painter *painter, double *x)
{
    size_t count = 0;
    for (size_t i = 0; i < painter->count; i++) {
        x[i] = painter->list[i].x;
    }
    qsort(x, painter->count, sizeof *x, by_value);
    for (size_t i = 0; i < painter->count; i++) {
        if (count == 0 || x[i] > x[count - 1]) {
            x[count++] = x[i];
        }
    }
    return count;
}

/* The different labels in their order. */
static size_t find_labels(const struct painter *painter, const char **labels, struct error *error)
{
    size_t count = 0;
    for (size_t i = 0; i < painter->count; i++) {
        size_t k = 0;
        while (k < count && strcmp(labels[k], painter->list[i].label) != 0) {
            k++;
        }
        if (k == CURVES_MOST) {
            fail(error, ERROR_USAGE, "{--plot} would draw more than %d pairs of curves",
                 CURVES_MOST);
            return 0;
        }
        labels[k] = painter->list[i].label;
        count += k == count;
    }
    return count;
}

/* The values of all curves in their places; limits: of the first. */
static void put_values(const struct painter *painter, const double *x, size_t points,
                       const char *const *labels, double *y, double *limits)
{
    for (size_t i = 0; i < painter->count; i++) {
        const struct entry *entry = &painter->list[i];
        size_t at = 0, curve = 0;
        while (x[at] < entry->x) {
            at++;
        }
        while (strcmp(labels[curve], entry->label) != 0) {
            curve++;
        }
        for (size_t k = 0; k < MTF_DIRECTIONS; k++) {
            y[(MTF_DIRECTIONS * curve + k) * points + at] = entry->contrast[k];
        }
        if (curve == 0) {
            limits[at] = entry->limit;
        }
    }
}

/* On the axis of a lens both directions are one curve. */
static bool is_one(const double *tangential, const double *sagittal, size_t points)
{
    double off = 0;
    for (size_t i = 0; i < points; i++) {
        off = fmax(off, fabs(tangential[i] - sagittal[i]));
    }
    return off < fine;
}

/* Series of curves, whose values are y: of a colour for each label, sagittal ones dashed. */
static size_t put_series(const struct painter *painter, const double *y, size_t points,
                         const char *const *labels, size_t curves, struct plot_series *series)
{
    size_t count = 0;
    for (size_t k = 0; k < curves; k++) {
        const double *both[] = {y + MTF_DIRECTIONS * k * points,
                                y + (MTF_DIRECTIONS * k + MTF_SAGITTAL) * points};
        const size_t again = 2 * (k / COLOURS);
        const bool one = is_one(both[0], both[1], points);
        series[count++] = (struct plot_series){
            arena_printf(painter->arena, "%s %s", one ? "T, S" : "T", labels[k]), both[0], k,
            1 + again};
        if (!one) {
            series[count++] = (struct plot_series){arena_printf(painter->arena, "S %s", labels[k]),
                                                   both[1], k, 2 + again};
        }
    }
    if (painter->axis == BY_FREQUENCY) {
        series[count++] =
            (struct plot_series){"limit", y + MTF_DIRECTIONS * curves * points, curves, DOTTED};
    }
    return count;
}

/* What the drawing says below its title, and of its axis. */
static void say(const struct painter *painter, struct plot *plot)
{
    const bool through = painter->axis == BY_FOCUS;
    const char *words =
        through ? arena_printf(painter->arena, "%s; %.4g/mm", painter->subtitle,
                               painter->input->frequency)
        : painter->is_cut
            ? arena_printf(painter->arena, "%s; curves end where wave fronts are too steep",
                           painter->subtitle)
            : painter->subtitle;
    plot->subtitle = painter->off > fine
                         ? arena_printf(painter->arena, "%s; up to %.1g off", words, painter->off)
                         : words;
    plot->x_label = painter->axis == BY_FREQUENCY ? "spatial frequency (1/mm)"
                    : through                     ? "defocus (mm)"
                    : painter->is_angle           ? "field (deg)"
                                                  : "field (mm)";
}

static bool draw(const struct painter *painter, struct svg *svg, struct error *error)
{
    struct arena *arena = painter->arena;
    double *x = ARENA_ARRAY(arena, painter->count, double);
    struct plot plot = {.title = name_curves(painter), .y_label = "contrast", .x = x};
    const char *labels[CURVES_MOST];
    const size_t points = find_x(painter, x), curves = find_labels(painter, labels, error);
    const size_t count = MTF_DIRECTIONS * curves + 1;
    double *y = ARENA_ARRAY(arena, points * count, double);
    struct plot_series *series = ARENA_ARRAY(arena, count, struct plot_series);
    if (curves == 0) {
        return false;
    }
    for (size_t i = 0; i < points * count; i++) {
        y[i] = NAN;
    }
    put_values(painter, x, points, labels, y, y + MTF_DIRECTIONS * curves * points);
    say(painter, &plot);
    plot.count = points;
    plot.series = series;
    plot.series_count = put_series(painter, y, points, labels, curves, series);
    return plot_draw(&plot, svg, error);
}

bool mtf_figure(const struct artifact_job *job, struct output *sink, struct error *error)
{
    struct svg svg = {.arena = job->run->arena};
    struct painter painter = {.job = job, .arena = svg.arena, .highest = NAN};
    painter.list = ARENA_ARRAY(svg.arena, MOST, struct entry);
    return choose_axis(&painter, error) && collect(&painter, error) &&
           draw(&painter, &svg, error) && drawing_write(job, &svg, sink, error);
}
