/* cli/options/option_light.c - read values of light: filters, films, scenes, series of stops. */
/* SPDX-License-Identifier: MIT */
#include "cli/options/option_light.h"

#include "cli/options/option.h"
#include "data/lensdb_facts.h"
#include "photo/stops.h"

#include <math.h>
#include <string.h>

/* "published: Kodak F-4017"; null where the table says neither. */
static const char *status_words(const struct reader *reader, struct text status, struct text source)
{
    if (status.length == 0 && source.length == 0) {
        return NULL;
    }
    return arena_printf(reader->arena, "%.*s%s%.*s", (int)status.length, status.start,
                        status.length > 0 ? ": " : "", (int)source.length, source.start);
}

/* What was looked for is not there: say by which option. */
static bool light_blame(const struct option *option, struct error *error)
{
    return error->code == ERROR_USAGE && error_prefix(error, "%s: ", CALLED(option));
}

static bool is_filter_digit(char c)
{
    return (c >= '0' && c <= '9') || c == '.';
}

static bool bad_filter(const struct option *option, struct text piece, const char *what,
                       struct error *error)
{
    return fail(error, ERROR_DOMAIN, "%s '%.*s': %s", TYPED(option, piece), what);
}

static bool filter_number(const struct option *option, struct text piece, struct text number,
                          const struct dimension *dimension, double *value, struct error *error)
{
    return quantity_read(number, dimension, NULL, value, NULL, error) ||
           error_within(error, piece, number) ||
           error_prefix(error, "bad value in %s '%.*s': ", TYPED(option, piece));
}

/* A factor by which light is divided: ND8, 8x. */
static bool read_factor(const struct option *option, struct text piece, struct text number,
                        double *stops, struct error *error)
{
    double factor;
    if (!filter_number(option, piece, number, &dimension_number, &factor, error)) {
        return false;
    }
    *stops = stops_from_factor(factor);
    return (factor >= 1 && factor <= 1e30) ||
           bad_filter(option, piece, "a filter factor is 1 to 1e30", error);
}

static bool filter_ends_with(struct text text, const char *end)
{
    const size_t length = strlen(end);
    return text.length > length &&
           text_same((struct text){text.start + text.length - length, length}, end);
}

/* "10-stop ND filter": without the words behind its strength. */
static struct text without_words(struct text piece)
{
    static const char *const words[] = {" filter", " nd", "-nd"};
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        if (filter_ends_with(piece, words[i])) {
            piece = text_trim((struct text){piece.start, piece.length - strlen(words[i])});
        }
    }
    return piece;
}

static bool filter_stops(const struct option *option, struct text piece, double *stops,
                         struct error *error)
{
    const struct unit *typed;
    if (!quantity_read(piece, &dimension_stops, NULL, stops, &typed, error)) {
        return error_prefix(error, "bad value in %s '%.*s': ", TYPED(option, piece));
    }
    /* a column of a batch may say the unit for all its cells */
    if (typed == NULL && option->unit == NULL) {
        fail(error, ERROR_USAGE, "%s '%.*s' may be stops, a factor or a density",
             TYPED(option, piece));
        return error_hint(error,
                          "write %.*sstops, %.*sx or ND%.*s (ND0.9 is a density, ND8 a "
                          "factor)",
                          text_shown(piece), piece.start, text_shown(piece), piece.start,
                          text_shown(piece), piece.start);
    }
    return (*stops >= 0 && *stops <= 100) ||
           bad_filter(option, piece, "a light loss is 0 to 100 stops", error);
}

/* ND with a decimal point is a density, without one a factor; "ND 6 stops" says what it is. */
static bool read_neutral(const struct option *option, struct text piece, double *stops,
                         struct error *error)
{
    struct text number = text_trim((struct text){piece.start + 2, piece.length - 2});
    double density;
    if (filter_ends_with(number, "stop") || filter_ends_with(number, "stops")) {
        return filter_stops(option, number, stops, error);
    }
    const char last = number.start[number.length - 1];
    if ((last == 'k' || last == 'K') && number.length > 1) { /* ND64k, ND100K */
        struct text thousands = {number.start, number.length - 1};
        double factor;
        if (!filter_number(option, piece, thousands, &dimension_number, &factor, error)) {
            return false;
        }
        *stops = stops_from_factor(1000 * factor);
        return (factor >= 1 && factor <= 1e27) ||
               bad_filter(option, piece, "thousands of a filter factor are 1 to 1e27", error);
    }
    if (memchr(number.start, '.', number.length) == NULL) {
        return read_factor(option, piece, number, stops, error);
    }
    if (!filter_number(option, piece, number, &dimension_number, &density, error)) {
        return false;
    }
    *stops = stops_from_density(density);
    return (density >= 0 && density <= 30) ||
           bad_filter(option, piece, "a density is 0 to 30", error);
}

static bool read_one_filter(const struct reader *reader, const struct option *option,
                            struct text piece, struct loss_value *one, struct error *error)
{
    *one = (struct loss_value){0};
    if (piece.length == 0) {
        return fail(error, ERROR_USAGE, "%s has an empty item", CALLED(option));
    }
    if (is_filter_digit(piece.start[0]) || (piece.length > 2 && is_filter_digit(piece.start[2]))) {
        piece = without_words(piece);
    }
    bool neutral = piece.length > 2 && text_same((struct text){piece.start, 2}, "nd");
    if (neutral && (is_filter_digit(piece.start[2]) || piece.start[2] == ' ')) {
        return read_neutral(option, piece, &one->stops, error);
    }
    if (!is_filter_digit(piece.start[0]) && piece.start[0] != '-') {
        struct lensdb_filter filter;
        if (!lensdb_find_filter(reader->db, piece, &filter, error)) {
            return light_blame(option, error);
        }
        *one = (struct loss_value){lensdb_filter_stops(&filter), filter.mired, NULL};
        return true;
    }
    size_t last = piece.length - 1;
    if (piece.start[last] == 'x' || piece.start[last] == 'X') {
        return read_factor(option, piece, (struct text){piece.start, last}, &one->stops, error);
    }
    struct lensdb_filter filter;
    struct error ignored;
    /* 85B is no number of stops */
    if (filter_stops(option, piece, &one->stops, error)) {
        return true;
    }
    if (!lensdb_find_filter(reader->db, piece, &filter, &ignored)) {
        return false;
    }
    *one = (struct loss_value){lensdb_filter_stops(&filter), filter.mired, NULL};
    return true;
}

static bool read_loss(const struct reader *reader, const struct option *option, struct text text,
                      void *member, struct error *error)
{
    enum { MOST_FILTERS = 16 };
    struct text rest = text_trim(text);
    struct loss_value sum = {0};
    bool more = true;
    size_t joined = 0;
    for (size_t i = 0; i < rest.length; i++) {
        joined += rest.start[i] == '+';
    }
    if (joined >= MOST_FILTERS) {
        return fail(error, ERROR_DOMAIN, "%s '%.*s...' joins more than %d filters",
                    TYPED(option, text), (int)MOST_FILTERS);
    }
    while (more) {
        /* the first filter of a sum; a name may hold a '+' itself ("polarizer-b+w-low") */
        struct lensdb_filter filter;
        struct error ignored;
        struct text piece = rest;
        while (memchr(piece.start, '+', piece.length) != NULL &&
               !lensdb_find_filter(reader->db, piece, &filter, &ignored)) {
            while (piece.start[--piece.length] != '+') {
            }
        }
        struct loss_value one;
        if (!read_one_filter(reader, option, text_trim(piece), &one, error)) {
            return false;
        }
        sum.stops += one.stops;
        sum.mired += one.mired;
        more = piece.length < rest.length;
        rest = more ? (struct text){piece.start + piece.length + 1, rest.length - piece.length - 1}
                    : rest;
    }
    sum.name = arena_printf(reader->arena, "%.*s (%.4g stops)", text_shown(text_trim(text)),
                            text_trim(text).start, sum.stops);
    *(struct loss_value *)member = sum;
    return true;
}

static bool read_filters(const struct reader *reader, const struct option *option, struct text text,
                         void *member, struct error *error)
{
    enum { MOST_OWNED = 32 };
    struct loss_value *items = ARENA_ARRAY(reader->arena, MOST_OWNED, struct loss_value);
    struct text rest = text_trim(text);
    size_t count = 0;
    do {
        const struct text piece = text_trim(text_cut(&rest, ','));
        if (count == MOST_OWNED) {
            return fail(error, ERROR_DOMAIN, "%s has more than %d filters", CALLED(option),
                        (int)MOST_OWNED);
        }
        if (!read_one_filter(reader, option, piece, &items[count], error)) {
            return false;
        }
        if (!(items[count].stops > 0)) {
            return bad_filter(option, piece, "a filter of 0 stops takes no light", error);
        }
        items[count++].name = arena_string(reader->arena, piece.start, piece.length);
    } while (rest.start != NULL && rest.length > 0);
    *(struct filters_value *)member = (struct filters_value){items, count};
    return true;
}

static bool read_film(const struct reader *reader, const struct option *option, struct text text,
                      void *member, struct error *error)
{
    struct lensdb_film film;
    struct reciprocity *model = ARENA_NEW(reader->arena, struct reciprocity);
    if (!lensdb_find_film(reader->db, text, &film, error)) {
        return light_blame(option, error);
    }
    if (!lensdb_film_model(&film, model, error)) {
        return false;
    }
    double speed = lensdb_film_speed(&film, text);
    const char *speeds = NULL; /* "160, 400, 100" */
    while (film.speeds.length > 0) {
        const struct text one = text_cut(&film.speeds, ' ');
        speeds = arena_printf(reader->arena, "%s%s%.*s", speeds != NULL ? speeds : "",
                              speeds != NULL ? ", " : "", (int)one.length, one.start);
    }
    *(struct film_value *)member = (struct film_value){
        .model = model,
        .name =
            arena_printf(reader->arena, "%.*s%s%.*s", (int)film.maker.length, film.maker.start,
                         film.maker.length > 0 ? " " : "", (int)film.name.length, film.name.start),
        .source = status_words(reader, film.status, film.source),
        .speed = speed,
        .type = film.type.length > 0
                    ? arena_printf(reader->arena, "%.*s", (int)film.type.length, film.type.start)
                    : NULL,
        .speed_note = !isnan(speed)
                          ? arena_printf(reader->arena, "ISO %.6g, the film's box speed", speed)
                          : speeds};
    return true;
}

static bool read_scene(const struct reader *reader, const struct option *option, struct text text,
                       void *member, struct error *error)
{
    struct lensdb_scene scene;
    if (!lensdb_find_scene(reader->db, text, &scene, error)) {
        static const char ending[] = ".scene";
        const size_t length = strlen(ending);
        if (text.length > length &&
            text_equal((struct text){text.start + text.length - length, length}, ending)) {
            error_hint(error,
                       "a file with a scene is named without an option: lenscalc render %.*s",
                       text_shown(text), text.start);
        }
        return light_blame(option, error);
    }
    *(struct scene_value *)member = (struct scene_value){
        .ev100 = scene.ev100,
        .name = arena_string(reader->arena, scene.name.start, scene.name.length),
        .source = status_words(reader, scene.confidence, scene.source)};
    return true;
}

/* The labels of a series, by step. */
static bool load_labels(const struct reader *reader, const char *file, const char *series,
                        const struct stop_labels **loaded, struct error *error)
{
    struct stop_labels *labels = ARENA_NEW(reader->arena, struct stop_labels);
    struct lensdb_stop *stops;
    size_t count;
    if (!lensdb_stops(reader->db, file, series, &stops, &count, error)) {
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        int step = stops[i].step;
        if (step >= STOP_FIRST && step < STOP_FIRST + STOP_COUNT) {
            labels->labels[step - STOP_FIRST] = stops[i].label.start;
        }
    }
    *loaded = labels;
    return true;
}

static bool read_series(const struct reader *reader, const struct option *option, struct text text,
                        void *member, struct error *error)
{
    static const char *const names[] = {"full", "half", "third"};
    struct series_value series = {0};
    for (int i = 0; i < 3 && series.per_stop == 0; i++) {
        if (text_same(text_trim(text), names[i])) {
            series.per_stop = i + 1;
        }
    }
    if (series.per_stop == 0) {
        return fail(error, ERROR_USAGE, "%s '%.*s' is none of full, half, third",
                    TYPED(option, text));
    }
    const char *name = names[series.per_stop - 1];
    series.db = reader->db;
    if (!load_labels(reader, "fstops.tsv", name, &series.fnumbers, error) ||
        !load_labels(reader, "shutters.tsv", name, &series.times, error)) {
        return false;
    }
    *(struct series_value *)member = series;
    return true;
}

const char *series_speed(const struct series_value *series, double S, double *exact)
{
    struct lensdb_stop *stops;
    size_t count;
    struct error ignored;
    const char *name = series->per_stop == 1 ? "full" : "third";
    if (!lensdb_stops(series->db, "iso.tsv", name, &stops, &count, &ignored)) {
        return NULL;
    }
    for (size_t i = 0; i < count; i++) {
        if (fabs(log2(S / stops[i].exact)) <= 0.5 / stops[i].divisor) {
            *exact = stops[i].exact;
            return stops[i].label.start;
        }
    }
    return NULL;
}

const struct option_kind kind_loss = {
    .name = "loss",
    .size = sizeof(struct loss_value),
    .is_list = true,
    .read = read_loss,
    OPTION_NAMED(struct loss_value, name),
    .reads = READS_LENSDB,
};

const struct option_kind kind_filters = {
    .name = "filters",
    .size = sizeof(struct filters_value),
    .read = read_filters,
    .reads = READS_LENSDB,
};

const struct option_kind kind_film = {
    .name = "film",
    .size = sizeof(struct film_value),
    .is_list = true,
    .read = read_film,
    OPTION_NAMED(struct film_value, name),
    .reads = READS_LENSDB,
};

const struct option_kind kind_scene = {
    .name = "scene",
    .size = sizeof(struct scene_value),
    .is_list = true,
    .read = read_scene,
    OPTION_NAMED(struct scene_value, name),
    .reads = READS_LENSDB,
};

const struct option_kind kind_series = {
    .name = "series",
    .size = sizeof(struct series_value),
    .read = read_series,
    .reads = READS_LENSDB,
};
