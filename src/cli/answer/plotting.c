/* cli/answer/plotting.c - plots of a sweep. */
/* SPDX-License-Identifier: MIT */
#include "cli/answer/collect.h"
#include "draw/plot.h"
#include "draw/plot_sample.h"
#include "report/row.h"

#include <math.h>
#include <string.h>

/* Where the curves come from: x runs along one axis, groups along all others. */
struct plotting_layout {
    const struct axis *x;
    size_t x_stride; /* combinations from one x to the next */
    size_t groups;
    struct shown *shown;
    size_t shown_count;
};

/* The axis with the most values; of equals the last, which is fastest. */
static bool choose_x(const struct collection *collection, struct plotting_layout *layout,
                     struct error *error)
{
    const struct sweep *sweep = collection->sweep;
    size_t stride = 1;
    for (size_t i = sweep->axis_count; i-- > 0;) {
        const struct axis *axis = &sweep->axes[i];
        if (axis_is_number(axis) && (layout->x == NULL || axis->count > layout->x->count)) {
            layout->x = axis;
            layout->x_stride = stride;
        }
        stride *= axis->count;
    }
    if (layout->x == NULL) {
        fail(error, ERROR_USAGE, "--plot needs an option with several numbers, such as a range");
        return sweep->axis_count > 0 &&
               error_hint(error, "values of --%s tell curves apart, they are no axis",
                          sweep->axes[0].option->name);
    }
    layout->groups = sweep->total / layout->x->count;
    if (layout->groups * layout->shown_count > 64) {
        return fail(error, ERROR_USAGE,
                    "--plot would draw %zu curves: at most 64 can be distinguished",
                    layout->groups * layout->shown_count);
    }
    return true;
}

/* The combination of group g at x index i. */
static size_t combination(const struct plotting_layout *layout, size_t group, size_t i)
{
    size_t inner = group % layout->x_stride, outer = group / layout->x_stride;
    return (outer * layout->x->count + i) * layout->x_stride + inner;
}

/* "f-number 2.8, focal length 50 mm": the values of all axes but x in a group. */
static const char *group_words(const struct collection *collection,
                               const struct plotting_layout *layout, size_t group)
{
    const struct sweep *sweep = collection->sweep;
    size_t index = combination(layout, group, 0);
    const char *words = NULL;
    for (size_t i = sweep->axis_count; i-- > 0;) {
        const struct axis *axis = &sweep->axes[i];
        size_t at = index % axis->count;
        index /= axis->count;
        if (axis != layout->x) {
            const char *value = axis_value(collection, axis, at, true);
            bool speaks = axis->option->dimension == &dimension_fnumber; /* f/2.8 needs no name */
            const char *one = speaks ? value
                                     : arena_printf(collection->arena, "%s %s",
                                                    axis_label(collection, axis), value);
            words = words == NULL ? one : arena_printf(collection->arena, "%s, %s", one, words);
        }
    }
    return words;
}

/* A number or a whole number; NaN if absent. */
static double column_value(const void *row, const struct column *column)
{
    if (column->type == COLUMN_NUMBER) {
        return row_number(row, column);
    }
    return row_is_absent(row, column) ? NAN : (double)row_integer(row, column);
}

/* The same in the unit that is shown; NaN of no row. */
static double shown_value(const void *row, const struct shown *shown)
{
    const double value = row != NULL ? column_value(row, shown->column) : NAN;
    return shown->unit != NULL ? unit_from_own(shown->unit, value) : value;
}

/* Which of the shown columns has this name? Their count: none. */
static size_t find_shown(const struct plotting_layout *layout, struct text name)
{
    size_t k = 0;
    while (k < layout->shown_count && !text_equal(name, layout->shown[k].column->name)) {
        k++;
    }
    return k;
}

/* The band that the command's zone makes of the columns; false: it fills nothing. */
static bool find_zone(const struct collection *collection, const struct plotting_layout *layout,
                      struct plot_band *band)
{
    struct text rest = text_of(collection->command->zone != NULL ? collection->command->zone : "");
    while (rest.length > 0) {
        struct text pair = text_cut(&rest, '|');
        const size_t low = find_shown(layout, text_cut(&pair, ' '));
        const size_t high = pair.start != NULL ? find_shown(layout, pair) : PLOT_UNBOUNDED;
        if (low < layout->shown_count && high != layout->shown_count) {
            *band = (struct plot_band){low, high};
            return true;
        }
    }
    return false;
}

static void plotting_add_curves(const struct collection *collection,
                                const struct plotting_layout *layout, struct plot *plot)
{
    size_t columns = layout->shown_count, groups = layout->groups;
    struct plot_series *series =
        ARENA_ARRAY(collection->arena, groups * columns, struct plot_series);
    struct plot_band *bands = ARENA_ARRAY(collection->arena, groups, struct plot_band), zone;
    const bool fills = groups <= 3 && find_zone(collection, layout, &zone);
    for (size_t g = 0; g < groups; g++) {
        for (size_t k = 0; k < columns; k++) {
            struct plot_series *one = &series[g * columns + k];
            double *y = ARENA_ARRAY(collection->arena, layout->x->count, double);
            for (size_t i = 0; i < layout->x->count; i++) {
                const void *row = collection_row(collection, combination(layout, g, i));
                y[i] = shown_value(row, &layout->shown[k]);
            }
            one->y = y;
            one->style = groups > 1 ? g : k;
            /* near and far of a group look alike: one label is enough */
            if (groups == 1) {
                one->label = column_label(layout->shown[k].column);
            } else if (k + 1 == columns || columns == 1) {
                one->label = group_words(collection, layout, g);
            } else {
                one->label = NULL;
            }
        }
        if (fills) {
            const bool open = zone.high == PLOT_UNBOUNDED;
            bands[g] = (struct plot_band){g * columns + zone.low,
                                          open ? PLOT_UNBOUNDED : g * columns + zone.high};
        }
    }
    plot->series = series;
    plot->series_count = groups * columns;
    plot->bands = bands;
    plot->band_count = fills ? groups : 0;
}

/* -------- between the samples -------- */

/* A group of curves that is asked for more. */
struct curve_group {
    const struct collection *collection;
    const struct plotting_layout *layout;
    size_t group;
};

static bool curve_group_at(void *context, double x, double *y)
{
    const struct curve_group *group = context;
    const struct collection *collection = group->collection;
    const struct plotting_layout *layout = group->layout;
    const struct unit *unit = layout->x->unit;
    const double own = unit != NULL ? unit_to_own(unit, x) : x;
    sweep_set(collection->sweep, combination(layout, group->group, 0), collection->input);
    if (!axis_set_number(collection->sweep, layout->x, own, collection->input)) {
        return false;
    }
    const void *row = collection->answer(collection->asked, collection->input);
    for (size_t k = 0; k < layout->shown_count; k++) {
        y[k] = shown_value(row, &layout->shown[k]);
    }
    return true;
}

/* What lies between the samples, where the curves are bent or end. */
static void refine_curves(const struct collection *collection, const struct plotting_layout *layout,
                          struct plot *plot)
{
    const size_t columns = layout->shown_count, most_together = 6000;
    const struct command *command = collection->command;
    const double weight = command->weight != NULL ? command->weight(collection->input) : 1;
    /* as long as answers cost so little that a drawing may ask for more */
    const size_t all = (size_t)((double)most_together / fmax(weight, 1));
    const size_t most = command->needs_ceres != NULL ? 0 : all / layout->groups;
    struct plot_series *refined =
        ARENA_ARRAY(collection->arena, plot->series_count, struct plot_series);
    const double **y = ARENA_ARRAY(collection->arena, columns, const double *);
    for (size_t g = 0; g < layout->groups && most > 0; g++) {
        struct curve_group group = {collection, layout, g};
        const struct plot_source source = {columns, curve_group_at, &group, most};
        struct plot_curves curves;
        for (size_t k = 0; k < columns; k++) {
            y[k] = plot->series[g * columns + k].y;
        }
        plot_sample(plot, plot->x, y, plot->count, &source, &curves, collection->arena);
        for (size_t k = 0; k < columns; k++) {
            struct plot_series *one = &refined[g * columns + k];
            *one = plot->series[g * columns + k];
            one->x = curves.x;
            one->y = curves.y[k];
            one->places = curves.places;
            one->count = curves.count;
        }
    }
    plot->series = most > 0 ? refined : plot->series;
}

static const char *with_unit(const struct collection *collection, const char *label,
                             const struct unit *unit)
{
    return unit != NULL && unit->label[0] != '\0'
               ? arena_printf(collection->arena, "%s (%s)", label, unit->label)
               : label;
}

/* "near limit and far limit"; what many curves have in common is their dimension: "angle". */
static const char *title_words(const struct collection *collection,
                               const struct plotting_layout *layout)
{
    if (layout->shown_count > 2 && layout->shown[0].column->dimension != NULL) {
        return layout->shown[0].column->dimension->name;
    }
    const char *words = column_label(layout->shown[0].column);
    for (size_t k = 1; k < layout->shown_count; k++) {
        words = arena_printf(collection->arena, "%s%s%s", words,
                             k + 1 == layout->shown_count ? " and " : ", ",
                             column_label(layout->shown[k].column));
    }
    return words;
}

/* Everything that can be wrong with the question. */
static bool plotting_lay_out(const struct collection *collection, const char *columns, bool typed,
                             struct plotting_layout *layout, struct error *error)
{
    *layout = (struct plotting_layout){0};
    if (columns == NULL) {
        return fail(error, ERROR_USAGE, "--plot: say what to plot with --columns");
    }
    return collection_columns(collection, columns, ',', !typed, &layout->shown,
                              &layout->shown_count, error) &&
           collection_check_units(layout->shown, layout->shown_count, "--plot", true, error) &&
           choose_x(collection, layout, error);
}

/* Does any of the columns repeat the swept option, or have no value at all? */
static bool says_nothing(const struct collection *collection, const struct plotting_layout *layout)
{
    for (size_t k = 0; k < layout->shown_count; k++) {
        const struct column *column = layout->shown[k].column;
        const char *swept = layout->x->option->column;
        bool any = collection_first_row(collection) == NULL; /* before the rows are there */
        for (size_t i = 0; i < collection->sweep->total && !any; i++) {
            const void *row = collection_row(collection, i);
            any = row != NULL && isfinite(column_value(row, column));
        }
        if (!any || (swept != NULL && strcmp(swept, column->name) == 0)) {
            return true;
        }
    }
    return false;
}

/*
 * The columns to plot: those the user named, or the first of the command's choices (separated by
 * '|') that say something about this sweep.
 */
static bool choose_columns(const struct collection *collection, const char *columns, bool typed,
                           struct plotting_layout *layout, struct error *error)
{
    struct text rest = text_of(columns != NULL ? columns : "");
    if (columns == NULL || typed) {
        return plotting_lay_out(collection, columns, typed, layout, error);
    }
    while (rest.start != NULL) {
        struct text choice = text_cut(&rest, '|');
        const char *names = arena_string(collection->arena, choice.start, choice.length);
        bool fits = plotting_lay_out(collection, names, false, layout, error);
        if (rest.start == NULL || (fits && !says_nothing(collection, layout))) {
            return fits;
        }
    }
    return false;
}

bool collection_plot_check(const struct collection *collection, const char *columns, bool typed,
                           struct error *error)
{
    struct plotting_layout layout;
    return choose_columns(collection, columns, typed, &layout, error);
}

bool collection_plot(const struct collection *collection, const char *columns, bool typed,
                     const char *subtitle, struct svg *svg, struct error *error)
{
    struct plotting_layout layout;
    if (collection->is_ambiguous) {
        return fail(error, ERROR_USAGE,
                    "--plot needs one row per combination, but this question has several");
    }
    if (!choose_columns(collection, columns, typed, &layout, error)) {
        return false;
    }
    double *x = ARENA_ARRAY(collection->arena, layout.x->count, double);
    for (size_t i = 0; i < layout.x->count; i++) {
        double value = axis_number(layout.x, i);
        x[i] = layout.x->unit != NULL ? unit_from_own(layout.x->unit, value) : value;
    }
    const char *words = title_words(collection, &layout);
    const char *x_label = axis_label(collection, layout.x);
    struct plot plot = {.x = x, .count = layout.x->count};
    plot.title = arena_printf(collection->arena, "%s by %s", words, x_label);
    plot.subtitle = subtitle;
    plot.x_label = with_unit(collection, x_label, layout.x->unit);
    plot.y_label = with_unit(collection, words, layout.shown[0].unit);
    if (layout.x->option->dimension->series != NULL && layout.x->count <= 12) {
        plot.x_ticks = x;
        plot.x_tick_count = layout.x->count;
    }
    plotting_add_curves(collection, &layout, &plot);
    plot_choose_axes(&plot);
    refine_curves(collection, &layout, &plot);
    return plot_draw(&plot, svg, error);
}
