/* photo/reciprocity_parse.c - the film table's text for a reciprocity model. */
/* SPDX-License-Identifier: MIT */
#include <math.h>

#include "base/number.h"
#include "photo/reciprocity.h"

/* What is being read; `at` moves towards `end`. */
struct reciprocity_parse_reader {
    struct text whole;
    const char *at, *end;
    struct error *error;
};

static bool fail_here(const struct reciprocity_parse_reader *reader, const char *what)
{
    size_t caret = (size_t)(reader->at - reader->whole.start) + 1;
    return fail_at(reader->error, ERROR_DATA, reader->whole, caret,
                   "bad reciprocity parameters at character %zu: %s", caret, what);
}

static bool reciprocity_parse_accept(struct reciprocity_parse_reader *reader, char c)
{
    if (reader->at < reader->end && *reader->at == c) {
        reader->at++;
        return true;
    }
    return false;
}

static bool reciprocity_parse_read_number(struct reciprocity_parse_reader *reader, double *value)
{
    const char *next = number_read(reader->at, reader->end, NUMBER_UNSCALED, value);
    if (next == NULL || !isfinite(*value)) {
        return fail_here(reader, "a number is expected");
    }
    reader->at = next;
    return true;
}

static bool reciprocity_parse_add_point(struct reciprocity_parse_reader *reader,
                                        struct reciprocity *film, double Tm, double Tc)
{
    int n = film->points;
    if (n == RECIPROCITY_POINTS) {
        return fail_here(reader, "too many points");
    }
    if (!(Tm > 0 && Tc >= Tm)) {
        return fail_here(reader, "times must be above 0 and not shortened");
    }
    if (n > 0 && !(Tm > film->metered[n - 1] && Tc > film->corrected[n - 1])) {
        return fail_here(reader, "times must ascend");
    }
    film->metered[n] = Tm;
    film->corrected[n] = Tc;
    film->points++;
    return true;
}

/* `name=value` and nothing else. */
static bool parse_constant(struct reciprocity_parse_reader *reader, char name, double *value)
{
    if (!reciprocity_parse_accept(reader, name) || !reciprocity_parse_accept(reader, '=')) {
        return fail_here(reader, "name=value is expected");
    }
    return reciprocity_parse_read_number(reader, value) &&
           (reader->at == reader->end || fail_here(reader, "nothing may follow"));
}

static bool parse_power(struct reciprocity_parse_reader *reader, struct reciprocity *film)
{
    film->model = RECIPROCITY_POWER;
    if (!parse_constant(reader, 'p', &film->p)) {
        return false;
    }
    if (!(film->p >= 1 && film->onset >= 1)) { /* else Tm^p would shorten the time */
        return fail_here(reader, "a power needs p and the onset at or above 1");
    }
    return true;
}

static bool parse_gainer(struct reciprocity_parse_reader *reader, struct reciprocity *film)
{
    film->model = RECIPROCITY_GAINER;
    return parse_constant(reader, 'a', &film->a) &&
           (film->a > 0 || fail_here(reader, "a must be above 0"));
}

static bool parse_none(struct reciprocity_parse_reader *reader, struct reciprocity *film)
{
    film->model = RECIPROCITY_NONE;
    return isfinite(film->valid_to) ||
           fail_here(reader, "a film without correction needs a longest published time");
}

/* A table ends where its points do, and its onset is its first point. */
static bool finish_table(struct reciprocity_parse_reader *reader, struct reciprocity *film)
{
    if (film->points == 0 || film->corrected[0] > film->metered[0]) {
        return fail_here(reader, "the first point must be one without correction");
    }
    if (film->points == 1) { /* nothing but "none up to T" */
        film->model = RECIPROCITY_NONE;
    }
    film->onset = film->metered[0];
    film->valid_to = fmin(film->valid_to, film->metered[film->points - 1]);
    return true;
}

static bool parse_table(struct reciprocity_parse_reader *reader, struct reciprocity *film)
{
    film->model = RECIPROCITY_TABLE;
    do {
        double Tm = 0, Tc = 0;
        if (!reciprocity_parse_read_number(reader, &Tm)) {
            return false;
        }
        if (!reciprocity_parse_accept(reader, ':')) {
            return fail_here(reader, "':' is expected");
        }
        if (!reciprocity_parse_read_number(reader, &Tc) ||
            !reciprocity_parse_add_point(reader, film, Tm, Tc)) {
            return false;
        }
    } while (reciprocity_parse_accept(reader, ';'));
    return reader->at == reader->end ? finish_table(reader, film)
                                     : fail_here(reader, "';' is expected");
}

/* One item: [<|<=] time [-time] : stops [note] */
static bool parse_stop_item(struct reciprocity_parse_reader *reader, struct reciprocity *film)
{
    bool below = reciprocity_parse_accept(reader, '<');
    bool included = reciprocity_parse_accept(reader, '=');
    double from = 0, stops = 0;
    if (!reciprocity_parse_read_number(reader, &from)) {
        return false;
    }
    double to = from;
    if (reciprocity_parse_accept(reader, '-') && !reciprocity_parse_read_number(reader, &to)) {
        return false;
    }
    if (!reciprocity_parse_accept(reader, ':')) {
        return fail_here(reader, "':' is expected");
    }
    /* A number, or a fraction like +1/3. */
    double divisor = 1;
    if (!reciprocity_parse_read_number(reader, &stops)) {
        return false;
    }
    if (reciprocity_parse_accept(reader, '/') &&
        (!reciprocity_parse_read_number(reader, &divisor) || !(divisor > 0))) {
        return fail_here(reader, "a fraction needs a divisor above 0");
    }
    stops /= divisor;
    if (below && !included) {
        from = to = nextafter(from, 0); /* the limit itself is not free of correction */
    }
    double factor = exp2(stops);
    return reciprocity_parse_add_point(reader, film, from, from * factor) &&
           (!(to > from) || reciprocity_parse_add_point(reader, film, to, to * factor));
}

static bool parse_stops(struct reciprocity_parse_reader *reader, struct reciprocity *film)
{
    struct text rest = reader->whole;
    film->model = RECIPROCITY_TABLE;
    while (rest.start != NULL) {
        struct text item = text_cut(&rest, ';');
        struct text question = item;
        text_cut(&question, '?');
        /* not published, or published as unknown: the range ends before it */
        if (question.start != NULL || (item.length > 0 && item.start[0] == '>')) {
            break;
        }
        reader->at = item.start;
        reader->end = item.start + item.length;
        if (!parse_stop_item(reader, film)) {
            return false;
        }
        if (reader->at != reader->end && *reader->at != ' ') {
            return fail_here(reader, "';' or a note is expected");
        }
    }
    return finish_table(reader, film);
}

bool reciprocity_parse(struct text model, struct text parameters, double onset, double valid_to,
                       struct reciprocity *film, struct error *error)
{
    static const struct {
        const char *name;
        bool (*parse)(struct reciprocity_parse_reader *reader, struct reciprocity *film);
    } models[] = {{"power", parse_power},
                  {"table", parse_table},
                  {"stops", parse_stops},
                  {"gainer", parse_gainer},
                  {"none", parse_none}};
    struct reciprocity_parse_reader reader = {parameters, parameters.start,
                                              parameters.start + parameters.length, error};
    *film = (struct reciprocity){.onset = onset, .valid_to = valid_to > 0 ? valid_to : INFINITY};
    if (!(onset >= 0)) {
        return fail(error, ERROR_DATA, "onset %.10g s of a reciprocity model must be 0 or above",
                    onset);
    }
    for (size_t i = 0; i < sizeof models / sizeof *models; i++) {
        if (text_equal(model, models[i].name)) {
            return models[i].parse(&reader, film);
        }
    }
    return fail(error, ERROR_DATA,
                "reciprocity model '%.*s' is none of power table stops gainer none",
                text_shown_up_to(model, 40), model.start);
}
