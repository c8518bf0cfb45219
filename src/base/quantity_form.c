/* base/quantity_form.c - quantities that are more than a number and a unit. */
/* SPDX-License-Identifier: MIT */
#include "base/quantity_form.h"

#include <math.h>
#include <string.h>

#define DEGREE_SIGN "\xc2\xb0"

bool quantity_wrong(struct quantity_parser *reading, const char *at, const char *what)
{
    size_t caret = (size_t)(at - reading->text.start) + 1;
    return fail_at(reading->error, ERROR_USAGE, reading->text, caret, "%s", what);
}

static enum quantity_form form_wrong(struct quantity_parser *form, const char *at, const char *what)
{
    quantity_wrong(form, at, what);
    return QUANTITY_FORM_WRONG;
}

void quantity_skip_blanks(struct quantity_parser *reading)
{
    while (reading->at < reading->end && (*reading->at == ' ' || *reading->at == '\t')) {
        reading->at++;
    }
}

static bool form_has_number(const struct quantity_parser *form)
{
    return form->at < form->end && (char_is_digit(*form->at) || *form->at == '.');
}

/* A number without sign, exponent or infinity. */
static bool form_number(struct quantity_parser *form, double *value)
{
    const char *end = form->at;
    while (end < form->end && (char_is_digit(*end) || *end == '.')) {
        end++;
    }
    const char *behind = number_read(form->at, end, NUMBER_UNSCALED, value);
    if (!form_has_number(form) || behind != end || isinf(*value)) {
        return false;
    }
    form->at = behind;
    return true;
}

/* "/2" behind a numerator divides it; false: there is none. */
static bool form_denominator(struct quantity_parser *form, double *value)
{
    double denominator;
    if (form->at == form->end || *form->at++ != '/' || !form_number(form, &denominator) ||
        !(denominator > 0)) {
        return false;
    }
    *value /= denominator;
    return true;
}

/*
 * A number, a fraction, or a whole number and a fraction: "6", "1/2", "6 1/2". False if none of
 * them stands here; `*mixed` tells the last.
 */
static bool read_mixed(struct quantity_parser *form, double *value, bool *mixed)
{
    double part;
    *mixed = false;
    if (!form_number(form, value)) {
        return false;
    }
    if (form->at < form->end && *form->at == '/') {
        return form_denominator(form, value);
    }
    struct quantity_parser ahead = *form;
    quantity_skip_blanks(&ahead);
    if (ahead.at == form->at || !form_number(&ahead, &part) || !form_denominator(&ahead, &part)) {
        return true;
    }
    *form = ahead;
    *value += part;
    *mixed = true;
    return part < 1;
}

/* The words for infinity. */
static enum quantity_form form_infinity(const struct quantity_parser *form,
                                        struct quantity_formed *formed)
{
    static const char *const words[] = {"\xe2\x88\x9e", "infinity", "inf", "infinite"};
    struct text word = form->text;
    const bool negative = word.length > 0 && word.start[0] == '-';
    if (word.length > 0 && (negative || word.start[0] == '+')) {
        word = (struct text){word.start + 1, word.length - 1};
    }
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        if (text_same(word, words[i])) {
            *formed = (struct quantity_formed){negative ? -INFINITY : INFINITY, NULL};
            return QUANTITY_FORM_READ;
        }
    }
    return QUANTITY_FORM_NONE;
}

/* One of several units that stand behind one another, the largest first. */
struct rung {
    const char *unit;  /* its name */
    double count;      /* how many of it make one of the rung before */
    const char *words; /* how it may be typed here */
};

struct ladder {
    const struct dimension *dimension;
    const char *wrong; /* what is said of too many of a smaller unit */
    struct rung rungs[3];
    int count;
};

#define MINUTE_SIGNS "' \xe2\x80\xb2 \xe2\x80\x99"
#define SECOND_SIGNS "\" \xe2\x80\xb3 \xe2\x80\x9d ''"

static const struct ladder ladders[] = {
    {&dimension_time,
     "seconds behind minutes, and minutes behind hours, must be 0 to less than 60",
     {{"h", 0, "h hr hour hours"},
      {"min", 60, "min minute minutes mins m " MINUTE_SIGNS},
      {"s", 60, "s sec secs second seconds " SECOND_SIGNS}},
     3},
    {&dimension_length,
     "inches behind feet must be 0 to less than 12",
     {{"ft", 0, "ft feet foot " MINUTE_SIGNS}, {"in", 12, "in inch inches " SECOND_SIGNS}},
     2},
    {&dimension_angle,
     "minutes and seconds of arc must be 0 to less than 60",
     {{"deg", 0, "deg degree degrees " DEGREE_SIGN},
      {"arcmin", 60, "arcmin " MINUTE_SIGNS},
      {"arcsec", 60, "arcsec " SECOND_SIGNS}},
     3},
};

static bool is_ascii_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/* Step over the longest of the words that stands here as a whole word. */
static bool form_word(struct quantity_parser *form, const char *words)
{
    struct text rest = text_of(words);
    size_t longest = 0;
    while (rest.start != NULL) {
        struct text word = text_cut(&rest, ' ');
        size_t room = (size_t)(form->end - form->at);
        bool here = word.length <= room && memcmp(form->at, word.start, word.length) == 0;
        const char *behind = form->at + word.length;
        bool whole = here && (behind == form->end || !is_ascii_letter(*behind) ||
                              !is_ascii_letter(word.start[0]));
        if (whole && word.length > longest) {
            longest = word.length;
        }
    }
    form->at += longest;
    return longest > 0;
}

/* One number and its unit, which is the next smaller one if it is left out at the end. */
struct quantity_form_step {
    const char *from;
    double number;
    int rung;
};

/* False if no number with a unit below `above` stands here; `above` is -1 at the first. */
static bool read_step(struct quantity_parser *form, const struct ladder *ladder, int above,
                      struct quantity_form_step *step)
{
    bool mixed;
    quantity_skip_blanks(form);
    step->from = form->at;
    if (!read_mixed(form, &step->number, &mixed)) {
        return false;
    }
    quantity_skip_blanks(form);
    bool bare = form->at == form->end;
    step->rung = above + 1;
    while (!bare && step->rung < ladder->count &&
           !form_word(form, ladder->rungs[step->rung].words)) {
        step->rung++;
    }
    quantity_skip_blanks(form);
    return step->rung < ladder->count && !(bare && above < 0);
}

/* "2min30s", "5' 6 1/2\"", "30\"": numbers with ever smaller units; the last may lack its own. */
static enum quantity_form read_ladder(struct quantity_parser *form, const struct ladder *ladder,
                                      struct quantity_formed *formed)
{
    double sum = 0;
    int rung = -1, steps = 0;
    struct quantity_form_step step;
    for (; form->at < form->end; steps++) {
        if (!read_step(form, ladder, rung, &step)) {
            return QUANTITY_FORM_NONE;
        }
        for (int i = rung + 1; steps > 0 && i <= step.rung; i++) {
            sum *= ladder->rungs[i].count;
        }
        if (steps > 0 && !(step.number < ladder->rungs[step.rung].count)) {
            return form_wrong(form, step.from, ladder->wrong);
        }
        const struct unit *unit =
            unit_find(ladder->dimension, text_of(ladder->rungs[step.rung].unit));
        formed->typed = steps == 0 ? unit : formed->typed;
        rung = step.rung;
        sum += step.number;
        formed->value = unit_to_own(unit, sum);
    }
    /* "1h30m" are minutes, "2m" are metres */
    bool metres = steps == 1 && form->end[-1] == 'm';
    return steps == 0 || metres ? QUANTITY_FORM_NONE : QUANTITY_FORM_READ;
}

/* 2:30 is two and a half minutes, 1:02:30 an hour more. */
static enum quantity_form read_clock(struct quantity_parser *form, struct quantity_formed *formed)
{
    double seconds = 0;
    int count = 0;
    do {
        const char *from = form->at;
        double number;
        if (!form_number(form, &number) || count == 3) {
            return QUANTITY_FORM_NONE;
        }
        bool more = form->at < form->end && *form->at == ':';
        if (more && number != floor(number)) {
            return QUANTITY_FORM_NONE;
        }
        if (count > 0 && !(number < 60)) {
            return form_wrong(form, from, ladders[0].wrong);
        }
        seconds = seconds * 60 + number;
        count++;
    } while (form->at < form->end && *form->at++ == ':');
    *formed = (struct quantity_formed){seconds, NULL};
    return form->at == form->end && count > 1 ? QUANTITY_FORM_READ : QUANTITY_FORM_NONE;
}

/* As cameras show a time: 1"3 is 1.3 s. */
static enum quantity_form read_display(struct quantity_parser *form, struct quantity_formed *formed)
{
    char digits[32];
    const char *quote = memchr(form->at, '"', form->text.length);
    if (quote == NULL || quote + 1 >= form->end || form->text.length >= sizeof digits ||
        !form_has_number(form)) {
        return QUANTITY_FORM_NONE;
    }
    memcpy(digits, form->at, form->text.length);
    digits[quote - form->at] = '.';
    const char *end = digits + form->text.length;
    for (const char *c = digits; c < end; c++) {
        if (!char_is_digit(*c) && c != digits + (quote - form->at)) {
            return QUANTITY_FORM_NONE;
        }
    }
    *formed = (struct quantity_formed){0, NULL};
    number_read(digits, end, NUMBER_UNSCALED, &formed->value);
    return QUANTITY_FORM_READ;
}

/* "1 2/3 stops": a whole number, a fraction less than 1, and the unit. */
static enum quantity_form read_fraction(struct quantity_parser *form,
                                        struct quantity_formed *formed)
{
    double number;
    bool mixed;
    const char *from = form->at;
    if (!form->dimension->fraction) {
        return QUANTITY_FORM_NONE;
    }
    bool read = read_mixed(form, &number, &mixed);
    if (!mixed) {
        return QUANTITY_FORM_NONE;
    }
    if (!read) {
        return form_wrong(form, from, "a fraction behind a whole number must be less than 1");
    }
    struct text name = text_trim(text_between(form->at, form->end));
    const struct unit *unit = form->unit;
    if (name.length > 0) {
        unit = formed->typed = unit_find(form->dimension, name);
    } else {
        formed->typed = NULL;
    }
    if (unit == NULL) {
        return QUANTITY_FORM_NONE;
    }
    formed->value = unit_to_own(unit, number);
    return QUANTITY_FORM_READ;
}

/* "10-stop", "50-mm": the unit behind a hyphen. */
static enum quantity_form read_hyphened(struct quantity_parser *form,
                                        struct quantity_formed *formed)
{
    double number;
    if (!form_number(form, &number) || form->at == form->end || *form->at++ != '-') {
        return QUANTITY_FORM_NONE;
    }
    formed->typed = unit_find(form->dimension, text_between(form->at, form->end));
    if (formed->typed == NULL || form->at == form->end) {
        return QUANTITY_FORM_NONE;
    }
    formed->value = unit_to_own(formed->typed, number);
    return QUANTITY_FORM_READ;
}

enum { DIN_LOWEST = 8, DIN_HIGHEST = 51 };

/* Speeds as films and cameras are marked, a degree DIN apart. */
static const int din_speeds[DIN_HIGHEST - DIN_LOWEST + 1] = {
    5,     6,     8,     10,    12,    16,    20,    25,    32,    40,    50,
    64,    80,    100,   125,   160,   200,   250,   320,   400,   500,   640,
    800,   1000,  1250,  1600,  2000,  2500,  3200,  4000,  5000,  6400,  8000,
    10000, 12800, 16000, 20000, 25600, 32000, 40000, 51200, 64000, 80000, 102400};

/* "27DIN", "27\xc2\xb0", "DIN 27": degrees. */
static bool read_degrees(struct quantity_parser *form, double *degrees)
{
    static const char marks[] = "DIN din Din " DEGREE_SIGN "DIN " DEGREE_SIGN;
    bool marked = form_word(form, "DIN din Din");
    quantity_skip_blanks(form);
    if (!form_number(form, degrees)) {
        return false;
    }
    quantity_skip_blanks(form);
    marked = form_word(form, marks) || marked;
    return marked && form->at == form->end;
}

/* A film speed by degrees, or as boxes have it: 400/27\xc2\xb0. */
static enum quantity_form read_speed(struct quantity_parser *form, struct quantity_formed *formed)
{
    double degrees, speed = NAN;
    const char *slash = memchr(form->at, '/', form->text.length), *from = form->at;
    if (form_word(form, "ISO iso Iso ASA asa")) {
        quantity_skip_blanks(form);
    }
    if (slash != NULL) {
        if (!form_number(form, &speed) || form->at != slash) {
            return QUANTITY_FORM_NONE;
        }
        from = ++form->at;
        if (!form_number(form, &degrees) || (form_word(form, DEGREE_SIGN), form->at != form->end)) {
            return QUANTITY_FORM_NONE;
        }
    } else if (!read_degrees(form, &degrees)) {
        return QUANTITY_FORM_NONE;
    }
    if (!(degrees >= DIN_LOWEST && degrees <= DIN_HIGHEST) || degrees != floor(degrees)) {
        return form_wrong(form, from, "degrees DIN are whole numbers from 8 to 51");
    }
    double marked = din_speeds[(int)degrees - DIN_LOWEST];
    /* labels differ by less than half a step of a third of a stop */
    if (!isnan(speed) && !(fabs(log2(speed / marked)) < 1 / 6.0)) {
        return form_wrong(form, from,
                          "speed and degrees contradict each other (ISO 400 is 27 degrees)");
    }
    *formed = (struct quantity_formed){isnan(speed) ? marked : speed, NULL};
    return QUANTITY_FORM_READ;
}

enum quantity_form quantity_form_read(const struct quantity_parser *form,
                                      struct quantity_formed *formed)
{
    static const struct {
        const struct dimension *of; /* null: any */
        enum quantity_form (*read)(struct quantity_parser *form, struct quantity_formed *formed);
    } forms[] = {{&dimension_time, read_clock},
                 {&dimension_time, read_display},
                 {&dimension_iso, read_speed},
                 {NULL, read_hyphened},
                 {NULL, read_fraction}};
    enum quantity_form result = form_infinity(form, formed);
    /* each is tried from the text's beginning */
    for (size_t i = 0; i < sizeof ladders / sizeof ladders[0] && result == QUANTITY_FORM_NONE;
         i++) {
        struct quantity_parser copy = *form;
        if (form->dimension == ladders[i].dimension) {
            result = read_ladder(&copy, &ladders[i], formed);
        }
    }
    for (size_t i = 0; i < sizeof forms / sizeof forms[0] && result == QUANTITY_FORM_NONE; i++) {
        struct quantity_parser copy = *form;
        if (forms[i].of == NULL || forms[i].of == form->dimension) {
            result = forms[i].read(&copy, formed);
        }
    }
    return result;
}
