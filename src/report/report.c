/* report/report.c - choose columns, and read the values of a row. */
/* SPDX-License-Identifier: MIT */
#include "report/report.h"

#include <math.h>
#include <string.h>

const struct format *const formats[] = {
    &format_text,     &format_csv,   &format_tsv,  &format_json, &format_jsonl,
    &format_markdown, &format_latex, &format_html, NULL,
};

const struct word *format_word(size_t i)
{
    return formats[i] != NULL ? &formats[i]->word : NULL;
}

static const struct unit *report_find_unit(const struct column *column, struct text name)
{
    return column->dimension != NULL ? unit_find(column->dimension, name) : NULL;
}

static struct shown report_show(const struct column *column, const struct unit *unit,
                                struct arena *arena)
{
    struct shown shown = {.column = column, .unit = unit, .name = column->name, .divisor = 1};
    if (unit != NULL) {
        shown.name = ARENA_JOIN(arena, column->name, "_", unit->name);
        /* most are a whole number of own units: then one division converts, exactly rounded */
        bool whole = shown.unit->factor == 1 && shown.unit->scale.power >= 0;
        shown.divisor = whole ? unit_to_own(shown.unit, 1) : 0;
    }
    return shown;
}

static struct shown show_usual(const struct column *column, struct arena *arena)
{
    const struct unit *unit =
        column->unit != NULL ? report_find_unit(column, text_of(column->unit)) : NULL;
    return report_show(column, unit, arena);
}

/* Does `name` ask for this column, by itself or with a unit behind? */
static bool names_column(struct text name, const struct column *column, struct arena *arena,
                         struct shown *shown)
{
    size_t length = strlen(column->name);
    if (name.length < length || memcmp(name.start, column->name, length) != 0) {
        return false;
    }
    if (name.length == length) {
        *shown = show_usual(column, arena);
        return true;
    }
    struct text rest = {name.start + length + 1, name.length - length - 1};
    const struct unit *unit = NULL;
    if (name.start[length] == '_' && column->unit != NULL) {
        unit = report_find_unit(column, rest);
    }
    if (unit != NULL && unit->name[0] != '\0') {
        *shown = report_show(column, unit, arena);
        return true;
    }
    return false;
}

/* What people may call a column: its name in any spelling, before its label or symbol. */
enum calling { BY_NAME, BY_LABEL, CALLINGS };

/* Is it called so: "Near_M", "near-limit", "H"? */
static bool report_is_called(struct text name, const struct column *column, enum calling by)
{
    if (by == BY_NAME) {
        return text_same_name(name, text_of(column->name));
    }
    return text_same_name(name, text_of(column_label(column))) ||
           (column->symbol != NULL && text_equal(name, column->symbol));
}

/* The unit behind the last '_', '-' or blank of a name that is cut off there; null: none. */
static const struct unit *cut_unit(struct text *name, const struct column *column)
{
    size_t at = name->length;
    while (at > 0 && strchr("_- ", name->start[at - 1]) == NULL) {
        at--;
    }
    const struct text last = {name->start + at, name->length - at};
    const struct unit *unit =
        at > 1 && column->unit != NULL ? report_find_unit(column, last) : NULL;
    if (unit == NULL || unit->name[0] == '\0') {
        return NULL;
    }
    *name = text_trim((struct text){name->start, at - 1});
    return unit;
}

/* "did you mean 'near_m', 'front_m' or 'blur_mm'?": the nearest, then those that contain it. */
static void suggest_columns(const struct sheet *sheet, struct text name, struct text nearest,
                            struct arena *arena, struct error *error)
{
    enum { MOST = 4 };
    const char *names[MOST], *words = "";
    size_t count = 0;
    if (nearest.start != NULL) {
        names[count++] = arena_string(arena, nearest.start, nearest.length);
    }
    for (size_t i = 0; i < sheet->column_count && count < MOST && name.length >= 3; i++) {
        const struct column *column = &sheet->columns[i];
        const char *usual = show_usual(column, arena).name;
        bool contains = text_contains_name(text_of(usual), name) ||
                        text_contains_name(text_of(column_label(column)), name);
        bool is_new = nearest.start == NULL ||
                      (!text_equal(nearest, usual) && !text_equal(nearest, column->name));
        if (contains && is_new) {
            names[count++] = usual;
        }
    }
    for (size_t i = 0; i < count; i++) {
        const char *between = i + 1 == count ? " or " : ", ";
        words =
            arena_printf(arena, "%s%s'%s'", words, i == 0 ? "did you mean " : between, names[i]);
    }
    error_hint(error, count > 0 ? "%s? '?' lists all columns" : "%s'?' lists all columns", words);
}

/* By its name, or what else people may call it; `other_unit` but for the unit behind its name. */
static bool report_column_named(const struct sheet *sheet, struct text name, struct arena *arena,
                                struct shown *shown, const struct column **other_unit)
{
    for (size_t i = 0; i < sheet->column_count; i++) {
        const struct column *column = &sheet->columns[i];
        if (names_column(name, column, arena, shown)) {
            return true;
        }
        size_t length = strlen(column->name);
        if (*other_unit == NULL && column->dimension != NULL && name.length > length &&
            name.start[length] == '_' && memcmp(name.start, column->name, length) == 0) {
            *other_unit = column;
        }
    }
    for (enum calling by = BY_NAME; by < CALLINGS; by++) {
        int found = 0;
        for (size_t i = 0; i < sheet->column_count; i++) {
            const struct column *column = &sheet->columns[i];
            struct text bare = name;
            const struct unit *unit = cut_unit(&bare, column);
            const struct shown usual = show_usual(column, arena);
            bool whole = by == BY_NAME && text_same_name(name, text_of(usual.name));
            if (whole || (!column->is_other && report_is_called(name, column, by))) {
                *shown = usual;
                found++;
            } else if (unit != NULL && report_is_called(bare, column, by)) {
                *shown = report_show(column, unit, arena);
                found++;
            }
        }
        if (found == 1) { /* a name that stands for one column only */
            return true;
        }
    }
    return false;
}

struct sheet report_own_columns(const struct sheet *sheet)
{
    struct sheet own = *sheet;
    while (own.column_count > 0 && (own.columns->flags & COLUMN_ADDED) != 0) {
        own.columns++;
        own.column_count--;
    }
    return own;
}

bool report_find_column(const struct sheet *sheet, struct text name, struct arena *arena,
                        struct shown *shown, struct error *error)
{
    const struct sheet own = report_own_columns(sheet);
    const struct column *other_unit = NULL;
    if (report_column_named(&own, name, arena, shown, &other_unit) ||
        report_column_named(sheet, name, arena, shown, &other_unit)) {
        return true;
    }
    if (other_unit != NULL) {
        size_t length = strlen(other_unit->name) + 1;
        return fail(error, ERROR_USAGE, "column '%s' is a %s: it cannot be printed in '%.*s'",
                    other_unit->name, other_unit->dimension->name, (int)(name.length - length),
                    name.start + length);
    }
    struct nearest nearest = {.typed = name};
    for (size_t i = 0; i < sheet->column_count; i++) {
        nearest_offer(&nearest, text_of(show_usual(&sheet->columns[i], arena).name));
        nearest_offer(&nearest, text_of(sheet->columns[i].name));
    }
    fail(error, ERROR_USAGE, "there is no column '%.*s'", text_shown(name), name.start);
    suggest_columns(sheet, name, nearest.best, arena, error);
    return false;
}

/* People see what makes one row differ from the next, before what --columns names. */
static void add_varied(struct report *report, const struct selection *selection)
{
    size_t named = report->shown_count, count = 0;
    struct shown *all =
        ARENA_ARRAY(report->arena, named + report->sheet->column_count, struct shown);
    struct text before = {"", 0};
    for (size_t i = 0; i < report->sheet->column_count; i++) {
        const struct column *column = &report->sheet->columns[i];
        struct text option = column_repeated(column);
        const char *name = arena_string(report->arena, option.start, option.length);
        if (option.length > 0 && !text_equal(before, name) && !report_shows(report, column) &&
            selection->varied(selection->asked, name)) {
            all[count++] = show_usual(column, report->arena);
            before = option;
        }
    }
    for (size_t i = 0; i < named; i++) {
        all[count++] = report->shown[i];
    }
    report->shown = all;
    report->shown_count = count;
}

/* The columns that --columns names, in its order. */
static bool select_named(struct report *report, const struct selection *selection,
                         struct error *error)
{
    struct text rest = text_of(selection->columns);
    size_t most = 1;
    for (size_t i = 0; i < rest.length; i++) {
        most += rest.start[i] == ',';
    }
    report->shown = ARENA_ARRAY(report->arena, most, struct shown);
    while (rest.start != NULL) {
        struct text name = text_trim(text_cut(&rest, ','));
        struct shown shown;
        const bool is_column =
            report_find_column(report->sheet, name, report->arena, &shown, error);
        if (text_equal(name, "error")) {
            /* the reasons of rows that fail; a column that is called so stands beside them */
            report->has_error_column = !is_column || selection->many;
        } else if (!is_column) {
            return error_prefix(error, "{%s}: ", selection->naming);
        }
        if (!is_column) {
            error->code = ERROR_NONE;
            continue;
        }
        for (size_t i = 0; i < report->shown_count; i++) {
            if (strcmp(report->shown[i].name, shown.name) == 0) {
                return fail(error, ERROR_USAGE, "{%s} names '%s' twice", selection->naming,
                            shown.name);
            }
        }
        report->shown[report->shown_count++] = shown;
    }
    if (selection->layout == SELECT_TABLE) {
        add_varied(report, selection);
    }
    return true;
}

/* Does any of the options this assumption follows from change from row to row? */
static bool depends_on_varied(const struct column *column, const struct selection *selection)
{
    struct text rest = text_of(column->depends != NULL ? column->depends : "");
    while (rest.start != NULL) {
        struct text word = text_cut(&rest, ' ');
        char name[40] = {0};
        memcpy(name, word.start, word.length < sizeof name ? word.length : sizeof name - 1);
        if (name[0] == '+' ? selection->many && selection->given(selection->asked, name + 1)
                           : selection->varied(selection->asked, name)) {
            return true;
        }
    }
    return false;
}

/* Is any of the options given that bring this column? */
static bool is_brought(const struct column *column, const struct selection *selection)
{
    struct text rest = text_of(column->with != NULL ? column->with : "");
    while (rest.length > 0) {
        struct text word = text_cut(&rest, ' ');
        char name[40] = {0};
        memcpy(name, word.start, word.length < sizeof name ? word.length : sizeof name - 1);
        if (selection->given(selection->asked, name)) {
            return true;
        }
    }
    return false;
}

/* Does the question have this assumption at all? */
static bool is_assumed(const struct column *column, const struct selection *selection)
{
    return (column->flags & COLUMN_ASSUMED) != 0 &&
           ((column->flags & COLUMN_TIED) == 0 || is_brought(column, selection));
}

static bool report_is_hidden(const struct column *column, const struct selection *selection)
{
    return (column->flags & (COLUMN_HIDDEN | COLUMN_NOTE)) != 0 && selection->layout != SELECT_ALL;
}

/* A column that no other one ties to the question: does this layout show it? */
static bool is_usual(const struct column *column, const struct selection *selection)
{
    bool echo = (column->flags & COLUMN_ECHO) != 0;
    if ((column->flags & COLUMN_WITH) != 0) {
        return selection->layout == SELECT_LIST || is_brought(column, selection);
    }
    if (column->with != NULL && !echo) {
        return is_brought(column, selection);
    }
    return selection->layout == SELECT_LIST || (column->flags & COLUMN_BRIEF) != 0 ||
           (echo && column->with != NULL && selection->varied(selection->asked, column->with));
}

static bool belongs(const struct column *column, const struct selection *selection, bool varies)
{
    if (varies && is_assumed(column, selection)) {
        return true;
    }
    if ((column->flags & COLUMN_TIED) != 0) {
        return false;
    }
    if ((column->flags & COLUMN_EXTRA) != 0) {
        return !report_is_hidden(column, selection) && is_brought(column, selection);
    }
    return selection->layout == SELECT_ALL ||
           (!report_is_hidden(column, selection) && is_usual(column, selection));
}

bool report_select(struct report *report, const struct selection *selection, struct error *error)
{
    const struct sheet *sheet = report->sheet;
    report->shown_count = 0;
    report->assumed_count = 0;
    report->selection = selection;
    report->shown = ARENA_ARRAY(report->arena, sheet->column_count, struct shown);
    report->assumed = ARENA_ARRAY(report->arena, sheet->column_count, struct shown);
    report->are_named = selection->columns != NULL;
    for (size_t i = 0; i < sheet->column_count; i++) {
        const struct column *column = &sheet->columns[i];
        const bool varies = depends_on_varied(column, selection);
        if (is_assumed(column, selection) && !varies) {
            report->assumed[report->assumed_count++] = show_usual(column, report->arena);
        }
        /* everything a row has, but for extras nobody asked for */
        if (!report->are_named && belongs(column, selection, varies)) {
            report->shown[report->shown_count++] = show_usual(column, report->arena);
        }
    }
    if (!report->are_named) {
        return true;
    }
    const bool found = select_named(report, selection, error);
    report->has_value = ARENA_ARRAY(report->arena, report->shown_count + 1, bool);
    return found;
}

void report_lead(struct report *report, const char *one, const char *many)
{
    const char *text = report->many ? many : one;
    if (report->title == NULL) {
        report->title = arena_string(report->arena, text, strlen(text));
    }
}

/* Add the value of a column to a line of words, while the line is short enough for a plot. */
static const char *add_words(const struct report *report, const char *line,
                             const struct shown *shown, const void *row)
{
    enum { LONGEST = 90 };
    if (row_is_absent(row, shown->column)) {
        return line;
    }
    const char *words = report_words(report, shown, row);
    if (line == NULL) {
        return words;
    }
    bool fits = strlen(line) + strlen(words) < LONGEST;
    return fits ? arena_printf(report->arena, "%s, %s", line, words) : line;
}

/* What a picture's title says, and which assumptions take part in what a curve shows. */
static const char titled[] = "lens focal lens_focal";
static const char telling[] =
    "sensor coc wavelength spectrum image projection position fnumber iso "
    "film member held rule_of_thumb";

const char *report_subtitle(const struct report *report, const struct selection *selection,
                            const void *row)
{
    const char *line = NULL;
    const char **told_names =
        ARENA_ARRAY(report->arena, report->sheet->column_count + 1, const char *);
    size_t told_count = 0;
    for (size_t i = 0; i < report->sheet->column_count && row != NULL; i++) {
        const struct column *column = &report->sheet->columns[i];
        struct shown shown;
        struct error ignored;
        const char *option = column->repeats != NULL ? column->repeats : column->with;
        const bool echoes = (column->flags & COLUMN_ECHO) != 0 || option == NULL;
        option = option != NULL ? option : selection->option_of(selection->asked, column->name);
        bool given = echoes && !text_lists(titled, text_of(column->name)) &&
                     selection->given(selection->asked, option) &&
                     !selection->varied(selection->asked, option);
        if (given && report_find_column(report->sheet, text_of(column->name), report->arena, &shown,
                                        &ignored)) {
            struct column *typed = ARENA_ARRAY(report->arena, 1, struct column);
            *typed = *shown.column;
            typed->flags |= COLUMN_ECHO; /* as it was typed */
            shown.column = typed;
            line = add_words(report, line, &shown, row);
            told_names[told_count++] = column->name;
        }
    }
    for (size_t i = 0; i < report->assumed_count && row != NULL; i++) {
        const char *name = report->assumed[i].column->name;
        bool told = false;
        for (size_t k = 0; k < told_count; k++) {
            told = told || strcmp(told_names[k], name) == 0;
        }
        if (!told && text_lists(telling, text_of(name))) {
            line = add_words(report, line, &report->assumed[i], row);
        }
    }
    return line;
}
