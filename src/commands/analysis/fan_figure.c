/* commands/analysis/fan_figure.c - the drawing of lenscalc fan: two panels a field. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/analysis_fields.h"
#include "commands/analysis/fan_input.h"

#include "commands/analysis/wavefront_input.h"

#include "draw/panels.h"

#include <string.h>

enum { FINE = 201, MOST_KEYS = 64 };

/* One wavelength of one field. */
struct fan_figure_curve {
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
    struct fan_figure_curve *curves;
    size_t count, room;
    const char **rows; /* what stands beside them */
    size_t row_count, row_room;
    const char *title, *reference; /* reference: null = no fan arrived */
    bool is_angular;
    size_t points;
};

/* What tells a field from the others: only what differs or is asked for. */
static const char *fan_figure_label_of(const struct fan_figure_painter *painter,
                                       const struct field_point *field, const char *position)
{
    const struct analysis_question *question = &painter->input.question;
    struct arena *arena = painter->arena;
    const char *words = lens_field_words(field, arena);
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
static size_t fan_figure_row_of(struct fan_figure_painter *painter, const char *label,
                                double wavelength)
{
    for (size_t i = painter->row_count; i-- > 0;) {
        bool taken = strcmp(painter->rows[i], label) != 0;
        for (size_t k = 0; k < painter->count && !taken; k++) {
            const struct fan_figure_curve *curve = &painter->curves[k];
            taken = curve->row == i && !(fabs(curve->wavelength - wavelength) > 0);
        }
        if (!taken) {
            return i;
        }
    }
    painter->rows = arena_grow(painter->arena, painter->rows, painter->row_count,
                               &painter->row_room, sizeof *painter->rows);
    painter->rows[painter->row_count] = label;
    return painter->row_count++;
}

/* The component along the section, um or mrad; or the path difference in waves. */
static double fan_figure_value_of(const struct fan_figure_painter *painter, const struct fan *fan,
                                  const struct fan_ray *ray, size_t section, double wavelength)
{
    const double *along = fan->along;
    if (painter->input.show == FAN_OPD) {
        return 1000 * ray->opd / wavelength;
    }
    double off = section == FAN_TANGENTIAL ? ray->off[0] * along[0] + ray->off[1] * along[1]
                                           : ray->off[0] * along[1] - ray->off[1] * along[0];
    return 1000 * off;
}

static void fan_figure_add_curve(struct fan_figure_painter *painter, const struct fan *fan,
                                 size_t g, double wavelength, const char *label)
{
    struct arena *arena = painter->arena;
    struct fan_figure_curve curve = {
        label, wavelength, fan_figure_row_of(painter, label, wavelength), {0}, {0}, {0}};
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
            curve.y[s][i] = fan_figure_value_of(painter, fan, &rays[i], s, wavelength);
        }
    }
    painter->curves =
        arena_grow(arena, painter->curves, painter->count, &painter->room, sizeof *painter->curves);
    painter->curves[painter->count++] = curve;
}

static bool add_fan(const struct analysis_case *one, size_t field, void *context,
                    struct error *error)
{
    struct fan_figure_painter *painter = context;
    const struct setup *setup = one->setup;
    struct fan fan;
    if (!fan_of_case(one, field, &painter->input, painter->arena, &fan, error)) {
        return false;
    }
    const char *label = fan_figure_label_of(painter, &setup->fields[field].point, setup->position);
    painter->title = setup->lens->title;
    const char *reference =
        wave_reference_words(one, (enum wave_about)painter->input.reference, painter->arena);
    bool differs = painter->reference != NULL && strcmp(painter->reference, reference) != 0;
    painter->reference = differs ? "the chief ray of each wavelength" : reference;
    painter->is_angular = fan.is_angular;
    for (size_t g = 0; g < setup->wavelength_count; g++) {
        fan_figure_add_curve(painter, &fan, g, setup->wavelengths[g].wavelength, label);
    }
    return true;
}

/* A field without light has its row all the same. */
static bool add_nothing(const struct analysis_point *point, void *context)
{
    struct fan_figure_painter *painter = context;
    const struct field_point at = {isnan(point->field) ? FIELD_IMAGE : FIELD_ANGLE,
                                   {isnan(point->field) ? point->height_x : point->field_x,
                                    isnan(point->field) ? point->height : point->field}};
    fan_figure_row_of(painter, fan_figure_label_of(painter, &at, point->position), NAN);
    painter->title = painter->title != NULL ? painter->title : point->lens;
    return true;
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

static size_t fan_figure_key_of(const double *keys, size_t count, double wavelength)
{
    size_t at = 0;
    while (at + 1 < count && keys[at] < wavelength) {
        at++;
    }
    return at;
}

/* The greatest value; false: there is none. */
static bool find_most(const double *y, size_t count, double *most)
{
    bool any = false;
    for (size_t i = 0; i < count; i++) {
        any = any || isfinite(y[i]);
        *most = isfinite(y[i]) ? fmax(*most, fabs(y[i])) : *most;
    }
    return any;
}

/* Panels two a row, with the greatest value in `most`. */
static struct panel *make_panels(const struct fan_figure_painter *painter, const double *keys,
                                 size_t key_count, double *most)
{
    struct arena *arena = painter->arena;
    struct panel *panels = ARENA_ARRAY(arena, FAN_SECTIONS * painter->row_count + 1, struct panel);
    for (size_t i = 0; i < FAN_SECTIONS * painter->row_count; i++) {
        struct panel_series *series = ARENA_ARRAY(arena, painter->count + 1, struct panel_series);
        size_t count = 0, section = i % FAN_SECTIONS;
        bool any = false;
        for (size_t k = 0; k < painter->count; k++) {
            const struct fan_figure_curve *curve = &painter->curves[k];
            if (curve->row != i / FAN_SECTIONS) {
                continue;
            }
            series[count++] =
                (struct panel_series){.x = curve->x[section],
                                      .y = curve->y[section],
                                      .count = curve->counts[section],
                                      .key = fan_figure_key_of(keys, key_count, curve->wavelength)};
            any = find_most(curve->y[section], curve->counts[section], most) || any;
        }
        panels[i] =
            (struct panel){.series = series, .count = count, .note = any ? NULL : "no ray arrives"};
    }
    return panels;
}

static bool fan_figure_draw(const struct fan_figure_painter *painter, struct output *sink,
                            struct error *error)
{
    static const char *const heads[FAN_SECTIONS] = {"tangential", "sagittal"};
    struct arena *arena = painter->arena;
    double keys[MOST_KEYS], most = 0;
    size_t key_count = find_keys(painter, keys);
    const char **words = ARENA_ARRAY(arena, key_count + 1, const char *);
    for (size_t k = 0; k < key_count; k++) {
        words[k] = arena_printf(arena, "%.5g nm", 1000 * keys[k]);
    }
    const struct fan_input *first = painter->job->inputs[0];
    bool opd = first->show == FAN_OPD;
    const struct panel *list = make_panels(painter, keys, key_count, &most);
    const struct panels panels = {
        .title = arena_printf(arena, "%s of %s", opd ? "Optical path differences" : "Ray fans",
                              painter->title),
        .subtitle =
            painter->reference == NULL
                ? NULL
                : arena_printf(arena, "%s %s", opd ? "against" : "from", painter->reference),
        .x_label = first->question.aim == ANALYSIS_AIM_ENTRANCE
                       ? "across the entrance pupil, in its radius"
                       : "across the stop, in its radius",
        .y_label = opd                   ? "optical path difference (waves)"
                   : painter->is_angular ? "transverse aberration (mrad)"
                                         : "transverse aberration (µm)",
        .column_heads = heads,
        .row_heads = painter->rows,
        .keys = words,
        .key_count = key_count,
        .light = true,
        .x_low = -1,
        .x_high = 1,
        .y_low = -most,
        .y_high = most,
        .columns = FAN_SECTIONS,
        .panels = list,
        .count = FAN_SECTIONS * painter->row_count,
    };
    struct svg svg = {.arena = arena};
    return panels_draw(&panels, &svg, error) && drawing_write(painter->job, &svg, sink, error);
}

bool fan_figure(const struct artifact_job *job, struct output *sink, struct error *error)
{
    static const struct analysis_answers answers = {.answer = add_fan, .lost = add_nothing};
    struct fan_figure_painter painter = {.job = job, .arena = job->run->arena};
    for (size_t i = 0; i < job->count; i++) {
        size_t points = (size_t)((const struct fan_input *)job->inputs[i])->points;
        painter.points = points > painter.points ? points : painter.points;
        painter.points = painter.points > FINE ? painter.points : FINE;
    }
    for (size_t i = 0; i < job->count; i++) {
        painter.input = *(const struct fan_input *)job->inputs[i];
        painter.input.points = (long)painter.points;
        if (!analysis_each_field(&painter.input.question, &fan_policy, job->run, &answers, &painter,
                                 error)) {
            return false;
        }
    }
    return fan_figure_draw(&painter, sink, error);
}
