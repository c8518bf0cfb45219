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
    const char *title; /* what the command calls these columns together; null: nothing */
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
            const struct dimension *dimension = axis->option->dimension;
            const char *name = axis_label(collection, axis);
            if (dimension == &dimension_ev || dimension == &dimension_iso) {
                name = dimension == &dimension_ev ? "EV" : "ISO";
            }
            /* f/2.8 and glasses need no name */
            bool speaks = dimension == &dimension_fnumber || axis->option->kind == &kind_glass ||
                          axis->option->kind == &kind_lens;
            const char *one =
                speaks ? value : arena_printf(collection->arena, "%s %s", name, value);
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
            /* near and far of a group look alike */
            one->label = groups == 1 ? column_label(layout->shown[k].column)
                                     : group_words(collection, layout, g);
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
    bool is_stepped = true;
    for (size_t k = 0; k < columns; k++) {
        is_stepped = is_stepped && layout->shown[k].column->type == COLUMN_INTEGER;
    }
    const double weight = command->weight != NULL ? command->weight(collection->input) : 1;
    /* as long as answers cost so little that a drawing may ask for more */
    const size_t all = (size_t)((double)most_together / fmax(weight, 1));
    const size_t most = command->needs_ceres != NULL ? 0 : all / layout->groups;
    struct plot_series *refined =
        ARENA_ARRAY(collection->arena, plot->series_count, struct plot_series);
    const double **y = ARENA_ARRAY(collection->arena, columns, const double *);
    for (size_t g = 0; g < layout->groups && most > 0; g++) {
        struct curve_group group = {collection, layout, g};
        const struct plot_source source = {columns, curve_group_at, &group, most, is_stepped};
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
    if (unit != NULL && unit == unit_find(&dimension_frequency, text_of("per_mm"))) {
        return arena_printf(collection->arena, "%s (cycles/mm)", label);
    }
    return unit != NULL && unit->label[0] != '\0'
               ? arena_printf(collection->arena, "%s (%s)", label, unit->label)
               : label;
}

/* What a label ends with: "limit". */
static const char *last_word(const char *label)
{
    const char *blank = strrchr(label, ' ');
    return blank != NULL ? blank + 1 : label;
}

/* "near and far limit"; what many curves have in common is their dimension: "angle". */
static const char *title_words(const struct collection *collection,
                               const struct plotting_layout *layout)
{
    if (layout->shown_count > 2 && layout->shown[0].column->dimension != NULL) {
        return layout->shown[0].column->dimension->name;
    }
    const char *words = column_label(layout->shown[0].column);
    if (layout->shown_count == 2) {
        const char *other = column_label(layout->shown[1].column), *last = last_word(words);
        const bool shares = last > words && strcmp(last, last_word(other)) == 0;
        const size_t length = shares ? (size_t)(last - words) - 1 : strlen(words);
        words = arena_printf(collection->arena, "%.*s and %s", (int)length, words, other);
    }
    return words;
}

/* "Depth of field": a title begins with a capital. */
static const char *plotting_capital(const struct collection *collection, const char *words)
{
    const char first = words[0];
    const bool is_small = first >= 'a' && first <= 'z' && strncmp(words, "y out", 5) != 0;
    return is_small ? arena_printf(collection->arena, "%c%s", first - 'a' + 'A', words + 1) : words;
}

/* "50 mm lens", "Double Gauss 100 mm f/2": whose plot it is; null: it is told by its curves. */
static const char *plotting_subject(const struct collection *collection,
                                    const struct plotting_layout *layout)
{
    const void *row = collection_first_row(collection);
    for (size_t i = 0; i < collection->sweep->axis_count; i++) {
        const struct axis *axis = &collection->sweep->axes[i];
        if (axis->option->kind == &kind_lens || axis->option->kind == &kind_focal) {
            return NULL;
        }
    }
    const char *subject = NULL;
    for (size_t i = 0; i < collection->sheet->column_count && row != NULL; i++) {
        const struct column *column = &collection->sheet->columns[i];
        bool plotted = false;
        for (size_t k = 0; k < layout->shown_count; k++) {
            plotted = plotted || layout->shown[k].column == column;
        }
        if (strcmp(column->name, "lens") == 0 && column->type == COLUMN_TEXT &&
            !row_is_absent(row, column)) {
            return row_text(row, column);
        }
        if (strcmp(column->name, "focal") == 0 && (column->flags & COLUMN_ECHO) != 0 && !plotted &&
            isfinite(row_number(row, column))) {
            subject = arena_printf(collection->arena, "%.3g mm lens", row_number(row, column));
        }
    }
    return subject;
}

/* "Depth of field, 50 mm lens", "Back focal distance of Double Gauss 100 mm f/2". */
static const char *plotting_title(const struct collection *collection,
                                  const struct plotting_layout *layout, const char *words)
{
    const char *what = plotting_capital(collection, layout->title != NULL ? layout->title : words);
    const char *whose = plotting_subject(collection, layout);
    if (whose == NULL) {
        return what;
    }
    const bool is_name = strstr(whose, " mm lens") == NULL && strstr(what, " of ") == NULL;
    return arena_printf(collection->arena, "%s%s%s", what, is_name ? " of " : ", ", whose);
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

/* Does any of the columns repeat the swept option, or have no value at all, or the same in all? */
static bool says_nothing(const struct collection *collection, const struct plotting_layout *layout)
{
    for (size_t k = 0; k < layout->shown_count; k++) {
        const struct column *column = layout->shown[k].column;
        const char *swept = layout->x->option->column;
        const bool is_open = collection_first_row(collection) == NULL; /* no rows yet */
        double least = INFINITY, most = -INFINITY;
        for (size_t i = 0; i < collection->sweep->total && !is_open; i++) {
            const void *row = collection_row(collection, i);
            const double value = row != NULL ? column_value(row, column) : NAN;
            least = isfinite(value) ? fmin(least, value) : least;
            most = isfinite(value) ? fmax(most, value) : most;
        }
        if ((!is_open && !(most > least)) || (swept != NULL && strcmp(swept, column->name) == 0)) {
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
    struct text titles =
        text_of(collection->command->plot_titles != NULL ? collection->command->plot_titles : "");
    struct plotting_layout first = {0};
    const char *last = NULL;
    bool any_fits = false;
    if (columns == NULL || typed) {
        return plotting_lay_out(collection, columns, typed, layout, error);
    }
    while (rest.start != NULL) {
        struct text choice = text_cut(&rest, '|');
        const char *names = arena_string(collection->arena, choice.start, choice.length);
        const struct text title = text_cut(&titles, '|');
        last = names;
        bool fits = plotting_lay_out(collection, names, false, layout, error);
        layout->title =
            title.length > 0 ? arena_string(collection->arena, title.start, title.length) : NULL;
        if (fits && !says_nothing(collection, layout)) {
            return true;
        }
        if (!any_fits) { /* where none says anything it is the first */
            first = *layout;
            any_fits = fits;
        }
    }
    *layout = first;
    return any_fits || plotting_lay_out(collection, last, false, layout, error);
}

bool collection_plot_check(const struct collection *collection, const char *columns, bool typed,
                           struct error *error)
{
    struct plotting_layout layout;
    return choose_columns(collection, columns, typed, &layout, error);
}

static enum ticks_kind plotting_ticks_kind(const struct dimension *dimension)
{
    static const struct {
        const struct dimension *dimension;
        enum ticks_kind kind;
    } kinds[] = {{&dimension_fnumber, TICKS_FNUMBER},
                 {&dimension_time, TICKS_TIME},
                 {&dimension_iso, TICKS_ISO}};
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        if (dimension == kinds[i].dimension) {
            return kinds[i].kind;
        }
    }
    return TICKS_NUMBERS;
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
    plot.title = plotting_title(collection, &layout, words);
    plot.x_kind = option_has_series(layout.x->option)
                      ? plotting_ticks_kind(layout.x->option->dimension)
                      : TICKS_NUMBERS;
    plot.y_kind = (layout.shown[0].column->flags & COLUMN_SPAN) == 0 &&
                          (layout.shown[0].unit == NULL || unit_is_own(layout.shown[0].unit))
                      ? plotting_ticks_kind(layout.shown[0].column->dimension)
                      : TICKS_NUMBERS;
    plot.subtitle = subtitle;
    plot.x_label = with_unit(collection, x_label, layout.x->unit);
    plot.y_label = with_unit(collection, words, layout.shown[0].unit);
    plot.is_ordered = layout.groups > 1;
    plotting_add_curves(collection, &layout, &plot);
    plot_choose_axes(&plot);
    refine_curves(collection, &layout, &plot);
    return plot_draw(&plot, svg, error);
}
