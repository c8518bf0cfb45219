/* data/camera_name.c - names of cameras as people shorten them. */
/* SPDX-License-Identifier: MIT */
#include "data/camera_name.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

static const char *const series[] = {"eos",   "alpha",   "cybershot", "cyber", "shot",
                                     "dsc",   "dc",      "dmc",       "rebel", "powershot",
                                     "lumix", "coolpix", "finepix",   "galaxy"};

static const char *const romans[] = {"ii", "iii", "iv", "v", "vi", "vii", "viii", "ix"};

static char small_letter(char c)
{
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

static bool is_letter(char c)
{
    return c >= 'a' && c <= 'z';
}

/* The number that ends these letters in Roman figures, 0 if none does; `before` receives the
   letters in front of it and of the word Mark. */
static char roman_end(const char *letters, size_t length, size_t *before)
{
    char digit = 0;
    *before = length;
    for (size_t i = 0; i < sizeof romans / sizeof romans[0]; i++) {
        const size_t size = strlen(romans[i]);
        if (size <= length && length - size < *before &&
            memcmp(letters + length - size, romans[i], size) == 0) {
            digit = (char)('2' + i);
            *before = length - size;
        }
    }
    return digit;
}

/* Without the word Mark, or what is short for it, at the end of `length` letters. */
static size_t without_mark(const char *letters, size_t length)
{
    static const char *const marks[] = {"mark", "mk"};
    for (size_t i = 0; i < sizeof marks / sizeof marks[0]; i++) {
        const size_t size = strlen(marks[i]);
        if (size <= length && memcmp(letters + length - size, marks[i], size) == 0) {
            return length - size;
        }
    }
    return length;
}

/* How many of these letters stay in the name, and the digit that takes the place of the rest; 0 for
   none. */
static size_t letters_fold(const char *letters, size_t length, bool has_digit, bool is_before_digit,
                           char *digit)
{
    size_t before;
    for (size_t i = 0; i < sizeof series / sizeof series[0]; i++) {
        if (strlen(series[i]) == length && memcmp(letters, series[i], length) == 0) {
            return 0;
        }
    }
    const char number = is_before_digit ? 0 : roman_end(letters, length, &before);
    if (number != 0) {
        const size_t unmarked = without_mark(letters, before);
        if (before == 0 || unmarked < before || (has_digit && before == 1)) {
            *digit = number;
            return unmarked;
        }
    }
    return without_mark(letters, length);
}

struct text camera_name_fold(struct text model, char folded[MOST_CAMERA_NAME])
{
    size_t used = 0;
    bool has_digit = false;
    char letters[MOST_CAMERA_NAME];
    for (size_t i = 0; i < model.length && used + 2 < MOST_CAMERA_NAME;) {
        size_t length = 0;
        while (i < model.length && used + length + 2 < MOST_CAMERA_NAME &&
               is_letter(small_letter(model.start[i]))) {
            letters[length++] = small_letter(model.start[i++]);
        }
        if (length > 0) {
            size_t next = i;
            while (next < model.length && strchr(" -_", model.start[next]) != NULL) {
                next++;
            }
            const bool is_glued = next == i;
            const bool is_before_digit = next < model.length && char_is_digit(model.start[next]) &&
                                         (is_glued || without_mark(letters, length) < length);
            char digit = 0;
            const size_t kept = letters_fold(letters, length, has_digit, is_before_digit, &digit);
            memcpy(folded + used, letters, kept);
            used += kept;
            if (digit != 0) {
                folded[used++] = digit;
            }
            continue;
        }
        if (strchr(" -_", model.start[i]) == NULL) {
            has_digit = has_digit || char_is_digit(model.start[i]);
            folded[used++] = model.start[i];
        }
        i++;
    }
    folded[used] = '\0';
    return (struct text){folded, used};
}

/* What makers are called besides their names in cameras.tsv. */
static const struct {
    const char *typed, *maker;
} maker_names[] = {
    {"Fuji", "Fujifilm"},     {"Blackmagic Design", "Blackmagic"},   {"BMD", "Blackmagic"},
    {"Olympus", "OM System"}, {"OM Digital Solutions", "OM System"},
};

static bool cut_word(struct text *name, struct text word)
{
    for (size_t i = 1; word.length > 0 && i < name->length; i++) {
        if (text_same_name((struct text){name->start, i}, word)) {
            *name = (struct text){name->start + i, name->length - i};
            return true;
        }
    }
    return false;
}

bool camera_name_cut_maker(struct text *name, struct text maker)
{
    bool cut = cut_word(name, maker);
    for (size_t i = 0; i < sizeof maker_names / sizeof maker_names[0] && !cut; i++) {
        cut = text_equal(maker, maker_names[i].maker) &&
              cut_word(name, text_of(maker_names[i].typed));
    }
    return cut;
}

void camera_name_offer_maker(struct nearest *nearest, struct text maker)
{
    nearest_offer(nearest, maker);
    for (size_t i = 0; i < sizeof maker_names / sizeof maker_names[0]; i++) {
        if (text_equal(maker, maker_names[i].maker)) {
            nearest_offer(nearest, text_of(maker_names[i].typed));
        }
    }
}

/* The next character of a name that counts, as a small letter; NUL at the end. */
static char next_of_name(struct text *rest)
{
    char c = '\0';
    do {
        c = rest->length > 0 ? small_letter(rest->start[0]) : '\0';
        *rest = (struct text){rest->start + (c != '\0'), rest->length - (c != '\0')};
    } while (c != '\0' && strchr(" -_", c) != NULL);
    return c;
}

/* The number whose digits so far are `number` and goes on with a digit and those behind it. */
static double number_to_end(double number, char next, struct text rest)
{
    while (char_is_digit(next)) {
        number = 10 * number + (next - '0');
        next = rest.length > 0 ? rest.start[0] : '\0';
        rest = (struct text){rest.start + (next != '\0'), rest.length - (next != '\0')};
    }
    return number;
}

double camera_name_numbers_apart(struct text a, struct text b)
{
    double shared = 0; /* of the digits that both names have where they begin to differ */
    char c, d;
    while ((c = next_of_name(&a)) == (d = next_of_name(&b)) && c != '\0') {
        shared = char_is_digit(c) ? 10 * shared + (c - '0') : 0;
    }
    return fabs(number_to_end(shared, c, a) - number_to_end(shared, d, b));
}
