/* cli/options/option_print.c - read prints: papers, sizes, from where and by which eye they are seen. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "cli/options/option.h"

#include <math.h>

/* Sides in mm, of the trade in inches but for A3+; those of ISO 216 follow a rule. */
static const struct paper {
    const char *name;
    double shorter, longer;
} papers[] = {
    {"letter", 215.9, 279.4}, {"legal", 215.9, 355.6}, {"tabloid", 279.4, 431.8},
    {"ledger", 279.4, 431.8}, {"A3+", 329, 483},       {"super-B", 330.2, 482.6},
    {"arch-D", 609.6, 914.4},
};

/*
 * "A2", "b1": a sheet of ISO 216, halved n times, whole millimetres.
 *
 * Source    [IsoPaper07]
 */
static bool iso_paper(struct text text, struct print_value *print)
{
    char series = text.length == 2 ? text.start[0] : ' ';
    bool is_a = series == 'A' || series == 'a', is_b = series == 'B' || series == 'b';
    if (!(is_a || is_b) || !char_is_digit(text.start[1])) {
        return false;
    }
    print->shorter = is_a ? 841 : 1000;
    print->longer = is_a ? 1189 : 1414;
    for (int n = text.start[1] - '0'; n > 0; n--) {
        double half = floor(print->longer / 2);
        print->longer = print->shorter;
        print->shorter = half;
    }
    return true;
}

static bool named_paper(struct text text, struct print_value *print)
{
    for (size_t i = 0; i < sizeof papers / sizeof papers[0]; i++) {
        if (text_same_name(text, text_of(papers[i].name))) {
            print->shorter = papers[i].shorter;
            print->longer = papers[i].longer;
            return true;
        }
    }
    return iso_paper(text, print);
}

/* "16x24in". */
static bool read_sheet(const struct option *option, struct text text, struct print_value *print,
                       struct error *error)
{
    double sides[2];
    bool has_unit;
    if (!option_read_size(option, text, sides, &has_unit, error)) {
        return false;
    }
    if (!has_unit) {
        fail(error, ERROR_USAGE, "%s '%.*s' has no unit", TYPED(option, text));
        return error_hint(error, "say %.*sin or %.*scm", text_shown(text), text.start,
                          text_shown(text), text.start);
    }
    print->shorter = fmin(sides[0], sides[1]);
    print->longer = fmax(sides[0], sides[1]);
    return (print->shorter > 0 && isfinite(print->longer)) ||
           fail(error, ERROR_DOMAIN, "%s '%.*s': both sides must be above 0 and finite",
                TYPED(option, text));
}

/* `unit` receives that of a length, null where it has none; kept for a paper or a size. */
static bool read_paper(const struct option *option, struct text text, struct print_value *print,
                       const struct unit **unit, struct error *error)
{
    if (named_paper(text, print)) {
        return true;
    }
    if (read_sheet(option, text, print, error)) {
        return true;
    }
    if (error->code != ERROR_NONE) {
        return false;
    }
    if (!quantity_read(text, &dimension_length, option_unit(option), &print->longer, unit, error)) {
        option_blame(option, text, error);
        return error_hint(error,
                          "a print is its long side (30cm), a size (16x24in) or a paper (A2)");
    }
    return option_check_range(option, print->longer, error);
}

/*
 * "20/20", "6/9": the distance over that at which one minute of arc is the finest stroke.
 *
 * Formula   angle of a stroke = denominator/numerator minutes; a line pair is two of them
 */
static bool read_snellen(struct text text, double *acuity)
{
    struct text below = text;
    struct text above = text_cut(&below, '/');
    double distance, normal;
    struct error ignored;
    if (below.start == NULL ||
        !quantity_read(above, &dimension_number, NULL, &distance, NULL, &ignored) ||
        !quantity_read(below, &dimension_number, NULL, &normal, NULL, &ignored) ||
        !(distance > 0 && normal > 0 && isfinite(distance) && isfinite(normal))) {
        return false;
    }
    *acuity = 1 / (2 * 250 * tan(normal / distance / 60 * RADIANS_PER_DEGREE));
    return *acuity > 0;
}

/* What stands behind an '@': where it is seen from, or the eye. */
static bool read_view(const struct option *option, struct text text, struct print_value *print,
                      struct error *error)
{
    double distance;
    const struct unit *unit = NULL;
    if (isnan(print->acuity) && read_snellen(text, &print->acuity)) {
        return true;
    }
    if (isnan(print->viewing) &&
        quantity_read(text, &dimension_length, NULL, &distance, &unit, error) && unit != NULL &&
        distance > 0 && isfinite(distance)) {
        print->viewing = distance;
        return true;
    }
    fail(error, ERROR_USAGE, "%s: '%.*s' is no viewing distance and no eye", TYPED(option, text));
    return error_hint(error, "A2@1m is seen from 1 m, A2@1m@20/20 by an eye of that acuity");
}

static bool read_print(const struct reader *reader, const struct option *option, struct text text,
                       void *member, struct error *error)
{
    struct print_value print = {NAN, NAN, NAN, NAN, NULL};
    struct text trimmed = text_trim(text), rest = trimmed;
    const struct unit *own = option_unit(option), *unit = own;
    struct text paper = text_trim(text_cut(&rest, '@'));
    if (!read_paper(option, paper, &print, &unit, error)) {
        return false;
    }
    while (rest.start != NULL) {
        if (!read_view(option, text_trim(text_cut(&rest, '@')), &print, error)) {
            return false;
        }
    }
    const char *behind = paper.start + paper.length;
    print.criterion =
        arena_printf(reader->arena, "print %.*s%s%s%.*s", (int)paper.length, paper.start,
                     unit == NULL ? " " : "", unit == NULL ? own->name : "",
                     (int)(trimmed.start + trimmed.length - behind), behind);
    *(struct print_value *)member = print;
    return true;
}

/* As typed, for a table over several. */
static const char *print_name(const struct option *option, const void *member)
{
    (void)option;
    const struct print_value *print = member;
    return print->criterion == NULL ? NULL : print->criterion + sizeof "print " - 1;
}

const struct option_kind kind_print = {
    .name = "print",
    .size = sizeof(struct print_value),
    .is_list = true,
    .read = read_print,
    .name_of = print_name,
    .number_of = option_first_number,
    .nan_count = 4,
};
