/* report/json.c - one JSON object of all rows, or one JSON object a line. */
/* SPDX-License-Identifier: MIT */
#include "report/report.h"
#include "report/version.h"

#include <math.h>
#include <string.h>

/* Of a UTF-8 sequence of at most three bytes. */
static unsigned code_point(const char *start, size_t length)
{
    static const unsigned char masks[] = {0, 0x7f, 0x1f, 0x0f};
    unsigned code = (unsigned char)start[0] & masks[length];
    for (size_t i = 1; i < length; i++) {
        code = code << 6 | ((unsigned char)start[i] & 0x3f);
    }
    return code;
}

static void json_write_string(struct output *output, const char *start, size_t length)
{
    output_character(output, '"');
    for (size_t i = 0; i < length;) {
        unsigned char c = (unsigned char)start[i];
        size_t sequence = text_utf8_length(start + i, length - i);
        if (sequence == 0) {
            output_string(output, "\xef\xbf\xbd"); /* replacement character */
            i++;
            continue;
        }
        if (c == '"' || c == '\\') {
            output_character(output, '\\');
            output_character(output, (char)c);
        } else if (c == '\n' || c == '\t') {
            output_string(output, c == '\n' ? "\\n" : "\\t");
        } else if (text_unprintable(start + i, length - i) > 0) {
            output_printf(output, "\\u%04x", code_point(start + i, sequence));
        } else {
            output_text(output, start + i, sequence);
        }
        i += sequence;
    }
    output_character(output, '"');
}

static void write_key(struct output *output, const char *name, const char *suffix)
{
    output_character(output, '"');
    output_string(output, name);
    output_string(output, suffix);
    output_string(output, "\":");
}

/* In its unit: what is a number in the program's own may be too large for one there. */
static double shown_number(const void *row, const struct shown *shown)
{
    const double value = row_number(row, shown->column);
    return shown->unit != NULL ? unit_from_own(shown->unit, value) : value;
}

static void json_write_value(struct report *report, const void *row, const struct shown *shown)
{
    const struct column *column = shown->column;
    if (row == NULL || row_is_absent(row, column) ||
        (column->type == COLUMN_NUMBER && !isfinite(shown_number(row, shown)))) {
        output_string(report->output, "null");
    } else if (column->type == COLUMN_NUMBER) {
        char *to = output_reserve(report->output, NUMBER_LENGTH);
        output_advance(report->output, shown_write_number(to, row, shown, report->digits));
    } else if (column->type == COLUMN_INTEGER) {
        output_printf(report->output, "%ld", row_integer(row, column));
    } else if (column->type == COLUMN_FLAG) {
        output_string(report->output, row_flag(row, column) ? "true" : "false");
    } else {
        json_write_string(report->output, row_text(row, column), strlen(row_text(row, column)));
    }
}

/* Is the column shown in another unit already? One companion serves both. */
static bool json_stands_before(const struct shown *shown, size_t index)
{
    for (size_t i = 0; i < index; i++) {
        if (shown[i].column == shown[index].column) {
            return true;
        }
    }
    return false;
}

/* `,"key":value` for each column, and the companions of columns that can be infinite. */
static void write_members(struct report *report, const void *row, const struct shown *shown,
                          size_t count, bool comma)
{
    for (size_t i = 0; i < count; i++) {
        if (comma) {
            output_character(report->output, ',');
        }
        comma = true;
        write_key(report->output, shown[i].name, "");
        json_write_value(report, row, &shown[i]);
        if ((shown[i].column->flags & COLUMN_INFINITE) != 0 && !json_stands_before(shown, i)) {
            output_character(report->output, ',');
            write_key(report->output, shown[i].column->name, "_is_infinite");
            const char *infinite = "null"; /* a row that failed has none */
            if (row != NULL) {
                infinite = isinf(shown_number(row, &shown[i])) ? "true" : "false";
            }
            output_string(report->output, infinite);
        }
    }
}

/* What is passed through of the first keys, then the columns of the row and why it failed. */
static void write_object(struct report *report, const void *row, const struct passed_cell *passed,
                         size_t passed_count, const struct error *failure)
{
    output_character(report->output, '{');
    bool comma = false;
    for (size_t i = 0; i < passed_count; i++) {
        struct text name = report->passed_names[i];
        if (passed[i].text.start == NULL) {
            continue; /* a key that this row does not have */
        }
        if (comma) {
            output_character(report->output, ',');
        }
        comma = true;
        json_write_string(report->output, name.start, name.length);
        output_character(report->output, ':');
        if (!passed[i].is_bare) {
            json_write_string(report->output, passed[i].text.start, passed[i].text.length);
        } else if (passed[i].text.length > 0) {
            output_text(report->output, passed[i].text.start, passed[i].text.length);
        } else {
            output_string(report->output, "null");
        }
    }
    write_members(report, row, report->shown, report->shown_count, comma);
    if (failure != NULL) {
        output_string(report->output,
                      comma || report->shown_count > 0 ? ",\"error\":" : "\"error\":");
        json_write_string(report->output, failure->message, strlen(failure->message));
    }
    output_character(report->output, '}');
}

/* Failed rows that came before the first good one. */
struct pending_row {
    struct passed_cell *passed;
    size_t passed_count; /* later rows may have more */
    struct error failure;
    struct pending_row *next;
};

struct json_state {
    bool has_head;
    struct pending_row *first, **last;
};

static void write_start(struct report *report, const void *row)
{
    struct json_state *state = report->state;
    state->has_head = true;
    /* The head waits for the first good row, which knows the assumptions. */
    output_printf(report->output, "{\"command\":\"%s\",\"version\":\"%s\",\"assumptions\":{",
                  report->command, LENSCALC_VERSION);
    write_members(report, row, report->assumed, report->assumed_count, false);
    if (report->nominal != NULL) {
        output_string(report->output, report->assumed_count > 0 ? ",\"stops\":\"nominal\""
                                                                : "\"stops\":\"nominal\"");
    }
    if (report->defaults != NULL) {
        const bool is_first = report->assumed_count == 0 && report->nominal == NULL;
        output_string(report->output, is_first ? "\"defaults\":" : ",\"defaults\":");
        json_write_string(report->output, report->defaults, strlen(report->defaults));
    }
    output_string(report->output, "},\"rows\":[");
    for (struct pending_row *at = state->first; at != NULL; at = at->next) {
        output_string(report->output, at == state->first ? "\n" : ",\n");
        write_object(report, NULL, at->passed, at->passed_count, &at->failure);
    }
}

/* Enough failures in a row that no good one is to be waited for: memory must not grow. */
enum { MOST_PENDING = 1000 };

static void json_begin(struct report *report)
{
    struct json_state *state = ARENA_NEW(report->arena, struct json_state);
    state->last = &state->first;
    report->state = state;
}

static void json_row(struct report *report, const void *row, const struct passed_cell *passed,
                     const struct error *failure)
{
    struct json_state *state = report->state;
    if (!state->has_head && row == NULL && report->rows < MOST_PENDING) {
        struct pending_row *pending = ARENA_NEW(report->arena, struct pending_row);
        pending->failure = *failure;
        pending->passed_count = report->passed_count;
        pending->passed = ARENA_ARRAY(report->arena, report->passed_count, struct passed_cell);
        for (size_t i = 0; i < report->passed_count; i++) {
            const struct text text = passed[i].text;
            pending->passed[i].text.start =
                text.start != NULL ? arena_string(report->arena, text.start, text.length) : NULL;
            pending->passed[i].text.length = text.length;
            pending->passed[i].is_bare = passed[i].is_bare;
        }
        *state->last = pending;
        state->last = &pending->next;
        return;
    }
    if (!state->has_head) {
        write_start(report, row);
    }
    output_string(report->output, report->rows == 0 ? "\n" : ",\n");
    write_object(report, row, passed, report->passed_count, failure);
}

static void json_end(struct report *report)
{
    struct json_state *state = report->state;
    if (!state->has_head) {
        write_start(report, NULL);
    }
    output_string(report->output, report->rows > 0 ? "\n]" : "]");
    if (report->explain != NULL) {
        output_string(report->output, ",\"explain\":");
        json_write_string(report->output, report->explain, strlen(report->explain));
    }
    const struct warnings *doubts = report->doubts;
    const size_t count = doubts != NULL ? doubts->count : 0;
    for (size_t i = 0; i < count; i++) {
        output_string(report->output, i == 0 ? ",\"warnings\":[" : ",");
        json_write_string(report->output, doubts->texts[i], strlen(doubts->texts[i]));
    }
    const char *more = count > 0 ? warnings_left_out(report->doubts) : NULL;
    if (more != NULL) {
        output_string(report->output, ",");
        json_write_string(report->output, more, strlen(more));
    }
    output_string(report->output, count > 0 ? "]}\n" : "}\n");
}

static void jsonl_begin(struct report *report)
{
    (void)report;
}

static void jsonl_row(struct report *report, const void *row, const struct passed_cell *passed,
                      const struct error *failure)
{
    write_object(report, row, passed, report->passed_count, failure);
    output_character(report->output, '\n');
}

const struct format format_json = {{"json", "one JSON object"},
                                   .is_keyed = true,
                                   .begin = json_begin,
                                   .row = json_row,
                                   .end = json_end};
const struct format format_jsonl = {{"jsonl", "one JSON object per row"},
                                    .is_keyed = true,
                                    .begin = jsonl_begin,
                                    .row = jsonl_row,
                                    .end = jsonl_begin};
