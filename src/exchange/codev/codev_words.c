/* exchange/codev/codev_words.c - words of a CODE V line: qualifiers, zeros. */
/* SPDX-License-Identifier: MIT */
#include "exchange/codev/codev.h"

#include <string.h>

/* Displays, tolerances, variables of the optimiser, bookkeeping. */
static const char harmless[][4] = {
    "GO",  "INI", "CCY", "CCX", "THC", "CUC", "GLC", "KC",  "AC",  "BC",  "CC",  "DC",
    "EC",  "FC",  "GC",  "HC",  "JC",  "XDC", "YDC", "ZDC", "ADC", "BDC", "CDC", "DER",
    "CLS", "UID", "WTF", "DOR", "POL", "CA",  "CUM", "THM", "CAX", "COM", "HCC", "DSX",
    "DSY", "BTX", "BTY", "DLF", "DLT", "DLR", "DLN", "DLV", "TIR", "CMP", "SD",  "MFL",
    "CWL", "INT", "RMX", "DEL", "CIN", "TOL", "DPT", "FVR", "SAV", "LDM", "PTB",
};

struct codev_key codev_key(struct text word)
{
    struct codev_key key = {{0}};
    for (size_t i = 0; i < word.length && i < 3; i++) {
        char c = word.start[i];
        key.letters[i] = c >= 'a' && c <= 'z' ? (char)(c - 'a' + 'A') : c;
    }
    return key;
}

bool codev_is_in(const char (*list)[4], size_t count, const char *key)
{
    for (size_t i = 0; i < count; i++) {
        if (strcmp(list[i], key) == 0) {
            return true;
        }
    }
    return false;
}

bool codev_is_zero(const struct codev *codev, size_t first)
{
    const struct number_scale plain = {1, 0};
    for (size_t i = first; i < codev->commands.count; i++) {
        const struct text word = codev->commands.words[i].text;
        double value = 1;
        if (number_read(word.start, word.start + word.length, plain, &value) == NULL ||
            value != 0) {
            return false;
        }
    }
    return true;
}

static bool is_quote(char c)
{
    return c == '\'' || c == '"';
}

/* A number of a surface, in digits alone. */
static bool read_number(struct text text, size_t *number)
{
    size_t value = 0;
    for (size_t i = 0; i < text.length; i++) {
        if (!char_is_digit(text.start[i]) || value > 100000) {
            return false;
        }
        value = 10 * value + (size_t)(text.start[i] - '0');
    }
    *number = value;
    return text.length > 0;
}

/* S3, SO, SI, SS (the stop), S'label'; false where it is none of these. */
static bool surface_named(const struct codev *codev, struct text name, size_t *surface)
{
    const struct sequence *sequence = &codev->sequence;
    char first = name.length > 0 ? (char)(name.start[0] | 32) : 0;
    if (name.length == 1 && (first == 'o' || first == 'i')) {
        *surface = first == 'o' ? 0 : sequence->count - 1;
        return sequence->count > 0;
    }
    for (size_t i = 0; i < sequence->count; i++) {
        const struct sequence_surface *one = &sequence->surfaces[i];
        bool is_stop = name.length == 1 && first == 's' && one->is_stop;
        bool is_label = name.length > 2 && is_quote(first) && one->name != NULL &&
                        text_same((struct text){name.start + 1, name.length - 2}, one->name);
        if (is_stop || is_label) {
            *surface = i;
            return true;
        }
    }
    return read_number(name, surface) && *surface < sequence->count;
}

static bool read_surfaces(struct codev *codev, const struct command_word *word,
                          struct codev_qualifiers *qualifiers, struct error *error)
{
    struct text name = {word->text.start + 1, word->text.length - 1}, last = name;
    for (size_t i = 0; i + 1 < name.length; i++) {
        if (name.start[i] == '.' && name.start[i + 1] == '.') {
            last = (struct text){name.start + i + 2, name.length - i - 2};
            name.length = i;
        }
    }
    qualifiers->has_surface = true;
    return (surface_named(codev, name, &qualifiers->surface) &&
            surface_named(codev, last, &qualifiers->end)) ||
           commands_fail(&codev->commands, word, error, "there is no surface '%.*s'",
                         (int)(word->text.length < 40 ? word->text.length : 40), word->text.start);
}

/* What a word behind a command narrows it to: 's' surfaces, or the number of 'z', 'f', 'w'. */
static char qualifier_kind(const struct command_word *word)
{
    char letter = word->text.length > 1 ? (char)(word->text.start[0] | 32) : 0;
    if (letter == 0 || word->is_quoted) {
        return 0;
    }
    char second = word->text.start[1];
    if (letter == 's') {
        return char_is_digit(second) || word->text.length == 2 || is_quote(second) ? 's' : 0;
    }
    return char_is_digit(second) && strchr("zfw", letter) != NULL ? letter : 0;
}

bool codev_qualifiers(struct codev *codev, size_t first, struct codev_qualifiers *qualifiers,
                      struct error *error)
{
    struct commands *commands = &codev->commands;
    *qualifiers =
        (struct codev_qualifiers){.surface = codev->surface, .end = codev->surface, .next = first};
    for (; qualifiers->next < commands->count; qualifiers->next++) {
        struct command_word word = commands->words[qualifiers->next];
        char kind = qualifier_kind(&word);
        size_t value = 0;
        if (kind == 0) {
            break;
        }
        if (kind == 's') {
            if (!read_surfaces(codev, &word, qualifiers, error)) {
                return false;
            }
            continue;
        }
        struct text number = {word.text.start + 1, word.text.length - 1};
        if (!commands_count(commands, &word, &(struct command_count){number, "number", 1}, &value,
                            error)) {
            return false;
        }
        qualifiers->zoom = kind == 'z' ? value : qualifiers->zoom;
        qualifiers->field = kind == 'f' ? value : qualifiers->field;
    }
    return true;
}

bool codev_is_harmless(struct text word)
{
    const struct codev_key key = codev_key(word);
    return codev_is_in(harmless, sizeof harmless / sizeof harmless[0], key.letters);
}
