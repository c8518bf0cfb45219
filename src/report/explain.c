/* report/explain.c - formulas with symbols, with numbers put in, and their sources. */
/* SPDX-License-Identifier: MIT */
#include "report/explain.h"

#include "report/readable.h"
#include "report/row.h"

#include <stdio.h>
#include <string.h>

enum { LINE = 1024, VALUE = 128, NUMBER = 96 };

static const struct column *by_symbol(const struct sheet *sheet, struct text symbol)
{
    for (size_t i = 0; i < sheet->column_count; i++) {
        const struct column *column = &sheet->columns[i];
        if (column->symbol != NULL && text_equal(symbol, column->symbol)) {
            return column;
        }
    }
    return NULL;
}

static const struct column *explain_by_name(const struct sheet *sheet, struct text name)
{
    for (size_t i = 0; i < sheet->column_count; i++) {
        if (text_equal(name, sheet->columns[i].name)) {
            return &sheet->columns[i];
        }
    }
    return NULL;
}

/* A value with its unit: "50 mm". */
static void explain_write_value(char *to, size_t room, const struct column *column, const void *row)
{
    struct column unpadded = *column;
    struct shown shown = {.column = &unpadded, .name = column->name};
    char number[NUMBER];
    unpadded.flags |= COLUMN_ECHO;
    if (column->unit != NULL) {
        shown.unit = unit_find(column->dimension, text_of(column->unit));
    }
    readable_value(number, sizeof number, row, &shown, shown.unit, 6);
    bool has_unit = shown.unit != NULL && shown.unit->label[0] != '\0';
    snprintf(to, room, "%s%s%s", number, has_unit ? " " : "", has_unit ? shown.unit->label : "");
}

/* Copy a formula, with each {symbol} as itself or, given a row, as its value. */
static void render(char *to, const char *formula, const struct sheet *sheet, const void *row)
{
    size_t used = 0;
    const char *start = formula;
    while (*formula != '\0' && used < LINE - VALUE) {
        const char *close = *formula == '{' ? strchr(formula, '}') : NULL;
        if (close == NULL) {
            /* Is the blank here a product, as between the factors of "2 {N} {c} (1 + {m})"? */
            if (row != NULL && *formula == ' ' && formula > start &&
                strchr("}0123456789)", formula[-1]) != NULL &&
                (formula[1] == '{' || formula[1] == '(')) {
                memcpy(to + used, " x", 2);
                used += 2;
            }
            to[used++] = *formula++;
            continue;
        }
        bool power = row != NULL && close[1] == '^'; /* (50 mm)^2 */
        struct text symbol = text_between(formula + 1, close);
        const struct column *column = by_symbol(sheet, symbol);
        if (row != NULL && column != NULL) {
            char value[VALUE];
            explain_write_value(value, sizeof value, column, row);
            snprintf(to + used, LINE - used, power ? "(%s)" : "%s", value);
        } else {
            snprintf(to + used, LINE - used, "%.*s", (int)symbol.length, symbol.start);
        }
        used += strlen(to + used);
        formula = close + 1;
    }
    to[used] = '\0';
}

static bool explain_is_wanted(const struct report *report, struct text name, const void *row)
{
    for (size_t i = 0; i < report->shown_count; i++) {
        const struct column *column = report->shown[i].column;
        if (text_equal(name, column->name)) {
            return !row_is_absent(row, column);
        }
    }
    return false;
}

/* Is it the formula of this row? `only` is a condition as struct explanation has it. */
static bool applies(const struct report *report, struct text only, const void *row)
{
    if (only.start == NULL) {
        return true;
    }
    const struct text absent = text_behind(only, "!");
    struct text word = absent.start != NULL ? absent : only;
    const struct column *column = explain_by_name(report->sheet, text_cut(&word, '='));
    const bool is_absent = column == NULL || row_is_absent(row, column);
    if (is_absent || absent.start != NULL || word.start == NULL) {
        return is_absent == (absent.start != NULL);
    }
    return text_equal(word, row_text(row, column));
}

const char *explain_row(const struct report *report, const struct explanation *explanations,
                        const void *row)
{
    const char *text = NULL;
    for (size_t i = 0; explanations != NULL && explanations[i].column != NULL; i++) {
        struct text only = text_of(explanations[i].column);
        const struct text name = text_cut(&only, ' ');
        if (explain_is_wanted(report, name, row) && applies(report, only, row)) {
            char symbols[LINE], numbers[LINE], result[VALUE];
            const struct column *column = explain_by_name(report->sheet, name);
            render(symbols, explanations[i].formula, report->sheet, NULL);
            const char *right = strstr(explanations[i].formula, " = ");
            render(numbers, right != NULL ? right + 3 : explanations[i].formula, report->sheet,
                   row);
            explain_write_value(result, sizeof result, column, row);
            /* a formula without symbols would be there twice */
            const bool has_numbers = strchr(explanations[i].formula, '{') != NULL;
            const char *one = arena_printf(
                report->arena, "%s: %s%s%s\n  = %s\n  %s%s%s", column_label(column), symbols,
                has_numbers ? "\n  = " : "", has_numbers ? numbers : "", result,
                explanations[i].source, explanations[i].limits != NULL ? "; " : "",
                explanations[i].limits != NULL ? explanations[i].limits : "");
            text = text == NULL ? one : arena_printf(report->arena, "%s\n%s", text, one);
        }
    }
    return text;
}
