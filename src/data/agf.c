/* data/agf.c - glass catalogues in the AGF format, as makers of glass publish them. */
/* SPDX-License-Identifier: MIT */
#include "data/agf.h"

#include "base/number.h"
#include "data/encoding.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* What a real file stays far below: a bad one must not take long. */
enum { MOST_WARNINGS = 4, MOST_POINTS = 1000, MOST_DAMAGED = 1000 };

/* A file while it is read, and the glass whose lines are being read. */
struct agf_reader {
    struct agf_words words;
    struct arena *arena;
    struct text catalog;
    struct glass_record *glasses;
    size_t count;
    struct glass_point *points; /* room for those of all glasses */
    struct glass_record *glass; /* null before the first NM, and behind damage up to the next */
    struct agf_damage *damaged;
    size_t damaged_count, damaged_room;
    int formula;
    struct pair coefficients[AGF_COEFFICIENTS + 1];
    size_t cut; /* this coefficient and the next may be one, cut by the end of a line; 0 = none */
    struct pair joined;
    bool has_coefficients;
    double nd_unit, Vd_unit; /* half a unit of their last stated digit */
    struct glass_point *transmittance;
    double *thicknesses; /* mm, of the points */
    double *all_thicknesses;
    size_t warnings; /* of the glass */
};

static bool agf_is_number(struct text word, struct pair *value)
{
    return text_pair(word, NUMBER_UNSCALED, value) && isfinite(value->hi);
}

static bool read_pair(const struct agf_reader *reader, struct text word, struct pair *value,
                      struct error *error)
{
    return agf_is_number(word, value) ||
           agf_words_fail(&reader->words, word, error, "is not a number");
}

/* The next numbers; NaN at the end of the line. */
static bool agf_read_numbers(struct agf_reader *reader, double *const *values, size_t count,
                             struct error *error)
{
    for (size_t i = 0; i < count; i++) {
        struct text word = agf_words_next(&reader->words);
        struct pair read = {NAN, 0};
        if (word.length > 0 && !read_pair(reader, word, &read, error)) {
            return false;
        }
        *values[i] = read.hi;
    }
    return true;
}

/* Half a unit of the last digit of a number as it is written: 0.0005 of "1.517". */
static double half_unit(struct text word)
{
    int power = 0;
    bool behind_point = false;
    for (size_t i = 0; i < word.length; i++) {
        char c = word.start[i];
        double exponent;
        if (c == 'e' || c == 'E') {
            const char *at = word.start + i + 1, *end = word.start + word.length;
            if (number_read(at, end, NUMBER_UNSCALED, &exponent) == end && fabs(exponent) <= 300) {
                power += (int)exponent;
            }
            break;
        }
        behind_point = behind_point || c == '.';
        power -= behind_point && c != '.' && power > -300;
    }
    return 0.5 * pow(10, power);
}

static void agf_warn(struct agf_reader *reader, const char *text)
{
    const char *before = reader->glass->warning;
    if (++reader->warnings > MOST_WARNINGS) {
        return;
    }
    text = reader->warnings < MOST_WARNINGS ? text : "and more";
    reader->glass->warning =
        before == NULL ? text : arena_printf(reader->arena, "%s; %s", before, text);
}

/* How many characters of its name a message shows. */
static int shown_name(const struct glass_record *glass)
{
    return (int)(glass->glass.name.length < 60 ? glass->glass.name.length : 60);
}

/* Where in the file, for a warning. */
static const char *agf_place(const struct agf_reader *reader, long line)
{
    return arena_printf(reader->arena, "%s:%ld", reader->words.source, line);
}

/* Say where the formula gives another nd or Vd than is stated. */
static void check_stated(struct agf_reader *reader, const char *what, double is, int digits,
                         double stated, double room)
{
    const struct glass_record *glass = reader->glass;
    if (fabs(is - stated) > room) {
        agf_warn(reader,
                 arena_printf(reader->arena, "%s: %.*s: the formula gives %s %.*f, stated %.10g",
                              agf_place(reader, glass->line), shown_name(glass),
                              glass->glass.name.start, what, digits, is, stated));
    }
}

/* Does the formula, with the coefficients as they are, have the stated nd? */
static bool has_stated(struct agf_reader *reader)
{
    struct glass_record *glass = reader->glass;
    agf_formula_set(reader->formula, reader->coefficients, &glass->glass);
    return fabs(glass_summary(&glass->glass).nd - glass->nd) <= fmax(3e-5, reader->nd_unit);
}

/* The glass whose lines have been read is complete. */
static bool finish_glass(struct agf_reader *reader, struct error *error)
{
    struct glass_record *glass = reader->glass;
    if (glass == NULL) {
        return true;
    }
    if (!reader->has_coefficients) {
        return fail_in(error, reader->words.source, glass->line, 0,
                       "glass '%.*s' has no line CD with its coefficients", shown_name(glass),
                       glass->glass.name.start);
    }
    if (reader->cut > 0) {
        /* A number that may have been cut in two is one where only that has the stated nd. */
        struct pair as_two[AGF_COEFFICIENTS + 1];
        bool is_full = fabs(reader->coefficients[AGF_COEFFICIENTS].hi) > 0;
        bool two = has_stated(reader);
        memcpy(as_two, reader->coefficients, sizeof as_two);
        /* The coefficients with the number that the end of a line has cut as one. */
        struct pair *c = reader->coefficients;
        size_t at = reader->cut - 1;
        c[at] = reader->joined;
        memmove(c + at + 1, c + at + 2, (AGF_COEFFICIENTS - at - 1) * sizeof c[0]);
        c[AGF_COEFFICIENTS] = pair_of(0);
        if (!is_full && (two || !has_stated(reader))) {
            memcpy(reader->coefficients, as_two, sizeof as_two);
        }
    }
    agf_formula_set(reader->formula, reader->coefficients, &glass->glass);
    for (size_t i = agf_formula_count(reader->formula); i < AGF_COEFFICIENTS; i++) {
        if (fabs(reader->coefficients[i].hi) > 0) {
            agf_warn(reader,
                     arena_printf(reader->arena,
                                  "%s: coefficient %zu is none of formula %d and is not used",
                                  agf_place(reader, glass->line), i + 1, reader->formula));
        }
    }
    reader->points += glass->glass.transmittance_count;
    reader->all_thicknesses += glass->glass.transmittance_count;
    const struct glass_summary summary = glass_summary(&glass->glass);
    check_stated(reader, "nd", summary.nd, 6, glass->nd, fmax(3e-5, reader->nd_unit));
    check_stated(reader, "Vd", summary.Vd, 4, glass->Vd,
                 fmax(fmax(0.06, 0.0012 * fabs(glass->Vd)), reader->Vd_unit));
    return true;
}

/* NM name formula glass-code nd Vd exclude status melts */
static bool agf_read_name(struct agf_reader *reader, struct error *error)
{
    double exclude, status;
    struct text name = agf_words_next(&reader->words), number = agf_words_next(&reader->words);
    struct glass_record *glass = &reader->glasses[reader->count++];
    struct pair read;
    *glass = (struct glass_record){.glass = {.catalog = reader->catalog,
                                             .name = name,
                                             .shortest = NAN,
                                             .longest = NAN,
                                             .thermal = {NAN, NAN, NAN, NAN, NAN, NAN, NAN},
                                             .transmittance = reader->points},
                                   .source = text_of(reader->words.source),
                                   .licence = {"", 0},
                                   .density = NAN,
                                   .price = NAN,
                                   .expansion = NAN,
                                   .expansion_hot = NAN,
                                   .place = LENSDB_USER,
                                   .line = reader->words.number};
    reader->glass = glass;
    reader->transmittance = reader->points;
    reader->thicknesses = reader->all_thicknesses;
    reader->has_coefficients = false;
    reader->warnings = 0;
    if (name.length == 0) {
        return agf_words_fail_line(&reader->words, error, "a glass without a name");
    }
    if (!read_pair(reader, number, &read, error)) {
        return false;
    }
    const double formula = read.hi;
    if (!(formula >= 1 && formula <= AGF_FORMULAS) || formula > floor(formula)) {
        return agf_words_fail(&reader->words, number, error,
                              "is not a formula: they have the numbers 1 to 13");
    }
    reader->formula = (int)formula;
    agf_words_next(&reader->words); /* the glass code */
    const struct agf_words before_nd = reader->words;
    reader->nd_unit = half_unit(agf_words_next(&reader->words));
    reader->Vd_unit = half_unit(agf_words_next(&reader->words));
    reader->words = before_nd;
    double *const values[] = {&glass->nd, &glass->Vd, &exclude, &status};
    if (!agf_read_numbers(reader, values, sizeof values / sizeof values[0], error)) {
        return false;
    }
    glass->nd = glass->nd > 0 && fabs(glass->nd - 1) > 0 ? glass->nd : NAN;
    glass->Vd = fabs(glass->Vd) > 0 ? glass->Vd : NAN;
    static const char *const words[] = {"standard", "preferred", "obsolete", "special", "melt"};
    glass->status = text_of(status >= 0 && status < 5 ? words[(int)status] : "");
    return true;
}

/*
 * A coefficient. What is no number but with the word that the next line begins with is one that the
 * end of the line has cut; `joined` receives it where both parts are numbers too.
 */
static bool agf_read_coefficient(struct agf_reader *reader, struct text word, struct pair *value,
                                 struct pair *joined, struct error *error)
{
    struct agf_words ahead = reader->words;
    struct pair behind, whole;
    const struct text rest = agf_words_next(&ahead);
    bool is_cut = ahead.touches && word.length + rest.length < NUMBER_LENGTH &&
                  agf_is_number(text_of(arena_printf(reader->arena, "%.*s%.*s", (int)word.length,
                                                     word.start, (int)rest.length, rest.start)),
                                &whole);
    *joined = pair_of(NAN);
    if (is_cut && !(agf_is_number(word, value) && agf_is_number(rest, &behind))) {
        *value = whole;
        reader->words = ahead;
        return true;
    }
    *joined = is_cut ? whole : *joined;
    return read_pair(reader, word, value, error);
}

static bool agf_read_coefficients(struct agf_reader *reader, struct error *error)
{
    struct text word = agf_words_next(&reader->words);
    memset(reader->coefficients, 0, sizeof reader->coefficients);
    reader->cut = 0;
    for (size_t i = 0; word.length > 0; i++, word = agf_words_next(&reader->words)) {
        struct pair value, joined;
        if (!agf_read_coefficient(reader, word, &value, &joined, error)) {
            return false;
        }
        if (i < AGF_COEFFICIENTS && reader->cut == 0 && !isnan(joined.hi)) {
            reader->cut = i + 1;
            reader->joined = joined;
        }
        if (i < AGF_COEFFICIENTS + (reader->cut > 0)) {
            reader->coefficients[i] = value;
        } else if (fabs(value.hi) > 0) {
            return agf_words_fail(&reader->words, word, error,
                                  "is an eleventh coefficient: no formula has it");
        }
    }
    reader->has_coefficients = true;
    return true;
}

/* TD D0 D1 D2 E0 E1 lambda temperature */
static bool read_thermal(struct agf_reader *reader, struct error *error)
{
    struct glass_thermal *t = &reader->glass->glass.thermal;
    double *const values[] = {&t->d0, &t->d1, &t->d2, &t->e0, &t->e1, &t->resonance, &t->reference};
    if (!agf_read_numbers(reader, values, sizeof values / sizeof values[0], error)) {
        return false;
    }
    bool known = false;
    for (size_t i = 0; i < 5; i++) {
        known = known || fabs(*values[i]) > 0;
    }
    for (size_t i = 0; i < 6 && !known; i++) {
        *values[i] = NAN;
    }
    return true;
}

/* ED expansion expansion-when-hot density ... */
static bool read_properties(struct agf_reader *reader, struct error *error)
{
    struct glass_record *glass = reader->glass;
    double *const values[] = {&glass->expansion, &glass->expansion_hot, &glass->density};
    if (!agf_read_numbers(reader, values, sizeof values / sizeof values[0], error)) {
        return false;
    }
    for (size_t i = 0; i < 3; i++) {
        *values[i] = fabs(*values[i]) > 0 ? *values[i] : NAN;
    }
    glass->density = glass->density > 0 ? glass->density : NAN;
    return true;
}

/* OD price resistances ...; -1 and what is no number stand for a price that is not known */
static bool agf_read_price(struct agf_reader *reader, struct error *error)
{
    struct pair price;
    (void)error;
    reader->glass->price =
        agf_is_number(agf_words_next(&reader->words), &price) && price.hi > 0 ? price.hi : NAN;
    return true;
}

static bool agf_read_range(struct agf_reader *reader, struct error *error)
{
    struct glass *glass = &reader->glass->glass;
    double *const values[] = {&glass->shortest, &glass->longest};
    if (!agf_read_numbers(reader, values, 2, error)) {
        return false;
    }
    if (!(glass->shortest > 0) && !(glass->longest > 0)) { /* 0 0: not stated */
        glass->shortest = glass->longest = NAN;
        return true;
    }
    return (glass->shortest > 0 && glass->longest >= glass->shortest) ||
           agf_words_fail_line(&reader->words, error,
                               "the range of wavelengths, in um, ends before it begins");
}

/* IT wavelength transmittance thickness */
static bool read_transmittance(struct agf_reader *reader, struct error *error)
{
    double wavelength, tau, thickness;
    double *const values[] = {&wavelength, &tau, &thickness};
    if (!agf_read_numbers(reader, values, 3, error)) {
        return false;
    }
    if (!(wavelength > 0 && tau >= 0 && tau <= 1 && thickness > 0)) {
        agf_warn(reader, arena_printf(reader->arena,
                                      "%s: no wavelength, transmittance from 0 to 1 and thickness: "
                                      "not used",
                                      agf_place(reader, reader->words.number)));
        return true;
    }
    if (reader->glass->glass.transmittance_count == MOST_POINTS) {
        return agf_words_fail_line(&reader->words, error,
                                   "more than 1000 transmittances of one glass");
    }
    const struct glass_point point = {
        pair_of(wavelength), pair_of(fabs(thickness - 10) > 0 ? pow(tau, 10 / thickness) : tau)};
    /* Keep a point, by rising wavelength; of two at one wavelength the one of nearly 10 mm. */
    struct glass *glass = &reader->glass->glass;
    struct glass_point *points = reader->transmittance;
    double *thicknesses = reader->thicknesses;
    size_t at = glass->transmittance_count;
    while (at > 0 && !(points[at - 1].wavelength.hi < point.wavelength.hi)) {
        at--;
    }
    bool twice =
        at < glass->transmittance_count && !(points[at].wavelength.hi > point.wavelength.hi);
    if (!twice || (fabs(thickness - 10) < fabs(thicknesses[at] - 10))) {
        if (!twice) {
            size_t behind = glass->transmittance_count++ - at;
            memmove(points + at + 1, points + at, behind * sizeof *points);
            memmove(thicknesses + at + 1, thicknesses + at, behind * sizeof *thicknesses);
        }
        points[at] = point;
        thicknesses[at] = thickness;
    }
    return true;
}

/* Null: comments are passed over. */
static const struct {
    char keyword[3];
    bool (*read)(struct agf_reader *reader, struct error *error);
} keywords[] = {
    {"CD", agf_read_coefficients},
    {"TD", read_thermal},
    {"ED", read_properties},
    {"LD", agf_read_range},
    {"IT", read_transmittance},
    {"OD", agf_read_price},
    {"GC", NULL},
    {"CC", NULL},
};

/* Go on behind a damaged glass. */
static bool agf_leave_out(struct agf_reader *reader, const struct error *error)
{
    if (reader->damaged_count == MOST_DAMAGED) {
        return false;
    }
    *ARENA_ADD(reader->arena, reader->damaged, reader->damaged_count, reader->damaged_room) =
        (struct agf_damage){reader->glass->glass.name, *error};
    reader->glass = NULL;
    reader->count--;
    return true;
}

static bool agf_read_line(struct agf_reader *reader, struct error *error)
{
    struct text keyword = agf_words_next(&reader->words);
    if (text_equal(keyword, "NM")) {
        return (finish_glass(reader, error) || agf_leave_out(reader, error)) &&
               agf_read_name(reader, error);
    }
    if (keyword.length == 0 || reader->glass == NULL) { /* any text may stand above */
        return true;
    }
    for (size_t i = 0; i < sizeof keywords / sizeof keywords[0]; i++) {
        if (text_equal(keyword, keywords[i].keyword)) {
            if (keywords[i].read != NULL && !keywords[i].read(reader, error)) {
                return false;
            }
            /* what a line has beyond its numbers, in the lines too that go on with it */
            while (agf_words_next(&reader->words).length > 0) {
            }
            return true;
        }
    }
    agf_warn(reader, arena_printf(reader->arena, "%s: '%.*s' is not known and not used",
                                  agf_place(reader, reader->words.number),
                                  text_shown_up_to(keyword, 20), keyword.start));
    return true;
}

/* By name, whose case does not count, then by place. */
static int agf_by_name(const void *a, const void *b)
{
    const struct glass_record *left = *(const struct glass_record *const *)a,
                              *right = *(const struct glass_record *const *)b;
    const struct text one = left->glass.name, other = right->glass.name;
    size_t length = one.length < other.length ? one.length : other.length;
    int order = length > 0 ? strncasecmp(one.start, other.start, length) : 0;
    if (order == 0) {
        order = (one.length > other.length) - (one.length < other.length);
    }
    return order != 0 ? order : (left > right) - (left < right);
}

static bool is_same_key(const struct glass_record *a, const struct glass_record *b)
{
    return a->glass.name.length == b->glass.name.length &&
           strncasecmp(a->glass.name.start, b->glass.name.start, a->glass.name.length) == 0;
}

/* A name that stands twice: each of its glasses says so. */
static void mark_duplicates(struct agf_reader *reader)
{
    struct glass_record **all = ARENA_ARRAY(reader->arena, reader->count, struct glass_record *);
    for (size_t i = 0; i < reader->count; i++) {
        all[i] = &reader->glasses[i];
    }
    qsort(all, reader->count, sizeof *all, agf_by_name);
    for (size_t i = 0; i < reader->count; i++) {
        bool before = i > 0 && is_same_key(all[i - 1], all[i]);
        if (before || (i + 1 < reader->count && is_same_key(all[i + 1], all[i]))) {
            reader->glass = all[i];
            reader->warnings = 0;
            agf_warn(reader, arena_printf(reader->arena, "%s: the name stands in line %ld too",
                                          agf_place(reader, reader->glass->line),
                                          all[before ? i - 1 : i + 1]->line));
        }
    }
}

/* "SCHOTT" of "data/schott.agf". */
static struct text catalog_name(const char *source, struct arena *arena)
{
    const char *slash = strrchr(source, '/');
    const char *start = slash != NULL ? slash + 1 : source, *dot = strrchr(start, '.');
    size_t length = dot != NULL && dot > start ? (size_t)(dot - start) : strlen(start);
    char *name = arena_string(arena, start, length);
    for (size_t i = 0; i < length; i++) {
        name[i] = name[i] >= 'a' && name[i] <= 'z' ? (char)(name[i] - 'a' + 'A') : name[i];
    }
    return (struct text){name, length};
}

bool agf_read(const char *source, struct text content, struct arena *arena,
              struct agf_catalog *catalog, struct error *error)
{
    struct agf_reader reader = {
        .words.source = source, .arena = arena, .catalog = catalog_name(source, arena)};
    if (!encoding_to_utf8(source, content, arena, &reader.words.rest, error)) {
        return false;
    }
    /* Room for as many glasses and points as there are lines NM and IT. */
    size_t glasses = 0, points = 0;
    for (struct text rest = reader.words.rest; rest.start != NULL && rest.length > 0;) {
        struct text line = text_trim(text_cut(&rest, '\n'));
        glasses += line.length >= 2 && memcmp(line.start, "NM", 2) == 0;
        points += line.length >= 2 && memcmp(line.start, "IT", 2) == 0;
    }
    reader.glasses = ARENA_ARRAY(reader.arena, glasses + 1, struct glass_record);
    reader.points = ARENA_ARRAY(reader.arena, points + 1, struct glass_point);
    reader.all_thicknesses = ARENA_ARRAY(reader.arena, points + 1, double);
    while (agf_words_line(&reader.words)) {
        if (!agf_read_line(&reader, error) && !agf_leave_out(&reader, error)) {
            return false;
        }
    }
    if (!finish_glass(&reader, error) && !agf_leave_out(&reader, error)) {
        return false;
    }
    if (reader.count == 0 && reader.damaged_count > 0) {
        *error = reader.damaged[0].error;
        return false;
    }
    if (reader.count == 0) {
        return fail_in(error, source, 0, 0, "no glass: no line begins with NM");
    }
    mark_duplicates(&reader);
    *catalog = (struct agf_catalog){.source = source,
                                    .name = reader.catalog,
                                    .glasses = reader.glasses,
                                    .count = reader.count,
                                    .damaged = reader.damaged,
                                    .damaged_count = reader.damaged_count};
    return true;
}
