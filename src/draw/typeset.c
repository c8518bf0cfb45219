/* draw/typeset.c - words of drawings as books set them, and how wide they are. */
/* SPDX-License-Identifier: MIT */
#include "draw/typeset.h"

#include "base/arena.h"
#include "optics/growing.h"

#include <ctype.h>
#include <string.h>

/* Widths of the characters from blank to tilde, thousandths of an em: regular and bold. */
static const unsigned short widths[2]['~' - ' ' + 1] = {
    {318,  401, 460, 838, 636, 950, 780, 275, 390, 390, 500, 838, 318, 361, 318, 337,
     636,  636, 636, 636, 636, 636, 636, 636, 636, 636, 337, 337, 838, 838, 838, 531,
     1000, 684, 686, 698, 770, 632, 575, 775, 752, 295, 295, 656, 557, 863, 748, 787,
     603,  787, 695, 635, 611, 732, 684, 989, 685, 611, 685, 390, 337, 390, 838, 500,
     500,  613, 635, 550, 635, 615, 352, 635, 634, 278, 278, 579, 278, 974, 634, 612,
     635,  635, 411, 521, 392, 634, 592, 818, 592, 592, 525, 636, 337, 636, 838},
    {348,  456, 521, 838, 696, 1002, 872, 306,  457, 457, 523, 838, 380, 415,  380, 365,
     696,  696, 696, 696, 696, 696,  696, 696,  696, 696, 400, 400, 838, 838,  838, 580,
     1000, 774, 762, 734, 830, 683,  683, 821,  837, 372, 372, 775, 637, 995,  837, 850,
     733,  850, 770, 720, 682, 812,  774, 1103, 771, 724, 725, 457, 365, 457,  838, 500,
     500,  675, 716, 593, 716, 678,  435, 716,  712, 343, 343, 665, 343, 1042, 712, 687,
     716,  716, 493, 595, 478, 712,  652, 924,  645, 652, 582, 712, 365, 712,  838}};

static const struct {
    const char *character;
    unsigned short width;
} sign_widths[] = {{"°", 500}, {"²", 438}, {"³", 438}, {"⁰", 438}, {"⁴", 438},
                   {"⁵", 438}, {"⁶", 438}, {"⁷", 438}, {"⁸", 438}, {"⁹", 438},
                   {"⁻", 528}, {"¹", 438}, {"×", 838}, {"−", 838}, {"∞", 838},
                   {"′", 264}, {"″", 447}, {"·", 380}, {"–", 500}, {"…", 1000}};

/* The width of a character and how many bytes it has, in thousandths of an em. */
static double character_width(const char *at, bool bold, size_t *bytes)
{
    const unsigned char byte = (unsigned char)*at;
    *bytes = 1;
    if (byte >= ' ' && byte <= '~') {
        return widths[bold][byte - ' '];
    }
    while (((unsigned char)at[*bytes] & 0xc0) == 0x80) {
        ++*bytes;
    }
    for (size_t i = 0; i < sizeof sign_widths / sizeof sign_widths[0]; i++) {
        if (strncmp(at, sign_widths[i].character, *bytes) == 0) {
            return sign_widths[i].width;
        }
    }
    if (byte < 0xe2) { /* accented letters, Greek, Cyrillic */
        return bold ? 740 : 680;
    }
    return 1000;
}

/* Bytes of "_{" or of the '}' that ends it; 0: there is neither. */
static size_t subscript_mark(const char *at, bool *inside)
{
    if (!*inside && strncmp(at, "_{", 2) == 0 && strchr(at, '}') != NULL) {
        *inside = true;
        return 2;
    }
    if (*inside && *at == '}') {
        *inside = false;
        return 1;
    }
    return 0;
}

double typeset_width(const char *text, double size, bool bold)
{
    double width = 0;
    bool inside = false;
    for (size_t bytes; *text != '\0'; text += bytes) {
        bytes = subscript_mark(text, &inside);
        if (bytes == 0) {
            const double own = character_width(text, bold, &bytes);
            width += own * (inside ? SUBSCRIPT_SIZE : 1);
        }
    }
    return width * size / 1000;
}

size_t typeset_fitting(const char *text, double size, bool bold, double width)
{
    double used = 0;
    size_t length = 0;
    while (text[length] != '\0') {
        size_t bytes;
        used += character_width(text + length, bold, &bytes) * size / 1000;
        if (used > width) {
            break;
        }
        length += bytes;
    }
    return length;
}

/* What stands behind a number, or in parentheses. */
static const struct {
    const char *typed, *set;
    bool joins; /* it follows the number without a blank */
} units[] = {{"um", "µm", false},   {"us", "µs", false},       {"deg", "°", true},
             {"mm2", "mm²", false}, {"cd/m2", "cd/m²", false}, {"m2", "m²", false}};

static bool is_word(char byte)
{
    return isalnum((unsigned char)byte) || ((unsigned char)byte & 0x80) != 0 || byte == '_';
}

/* The unit that begins here; its place in the table, or their count. */
static size_t unit_at(const char *at)
{
    const size_t count = sizeof units / sizeof units[0];
    size_t i = 0;
    while (i < count && (strncmp(at, units[i].typed, strlen(units[i].typed)) != 0 ||
                         is_word(at[strlen(units[i].typed)]))) {
        i++;
    }
    return i;
}

/* One step of typeset: what is written for the bytes that begin at `at`; null: they stay. */
static const char *typeset_step(const char *text, const char *at, size_t *bytes)
{
    const char before = at > text ? at[-1] : ' ', digit = at > text ? before : '\0';
    const bool opens = before == ' ' || before == '(' || before == '[';
    if (*at == ' ' && isdigit((unsigned char)digit)) {
        const size_t i = unit_at(at + 1);
        if (i < sizeof units / sizeof units[0] && units[i].joins) {
            *bytes = 1 + strlen(units[i].typed);
            return units[i].set;
        }
        if (strncmp(at, " x ", 3) == 0 && isdigit((unsigned char)at[3])) {
            *bytes = 3;
            return " × ";
        }
    }
    if (*at == '-' && opens && (isdigit((unsigned char)at[1]) || at[1] == '.')) {
        *bytes = 1;
        return "−";
    }
    const bool counted = before == ' ' && at - text > 1 && isdigit((unsigned char)at[-2]);
    const size_t i = counted || before == '(' ? unit_at(at) : sizeof units / sizeof units[0];
    if (i < sizeof units / sizeof units[0]) {
        *bytes = strlen(units[i].typed);
        return units[i].set;
    }
    return NULL;
}

const char *typeset(struct arena *arena, const char *text)
{
    struct text_buffer set = {.arena = arena};
    const char *kept = text;
    for (const char *at = text; *at != '\0';) {
        size_t bytes = 1;
        const char *step = typeset_step(text, at, &bytes);
        if (step != NULL) {
            growing_format(&set, "%.*s%s", (int)(at - kept), kept, step);
            kept = at + bytes;
        }
        at += bytes;
    }
    if (kept == text) {
        return text;
    }
    growing_format(&set, "%s", kept);
    return set.data;
}
