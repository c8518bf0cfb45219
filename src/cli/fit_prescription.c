/* cli/fit_prescription.c - radii, gaps and indices that give a lens what was measured. */
/* SPDX-License-Identifier: MIT */
#include "commands/design/fit.h"
#include "design/prescription.h"
#include "file/lens_file.h"
#include "data/lines.h"
#include "report/output.h"

#include <string.h>

enum { MOST_GOALS = 64, MOST_PARTS = 64 };

struct goal_row {
    const char *position, *goal, *lens, *status;
    double target, reached, off; /* mm */
};

#define LENGTH(member_name)                                                                        \
    COLUMN(struct goal_row, member_name), .dimension = &dimension_length, .unit = "mm",            \
                                          .flags = COLUMN_BRIEF

static const struct column columns[] = {
    {COLUMN(struct goal_row, position), .name = "position", .label = "position",
     .help = "zoom or focus position"},
    {COLUMN(struct goal_row, goal), .flags = COLUMN_BRIEF, .name = "goal", .label = "goal",
     .help = "what was measured"},
    {LENGTH(target), .name = "target", .digits = 8, .label = "target", .help = "as measured"},
    {LENGTH(reached), .name = "reached", .digits = 8, .label = "reached",
     .help = "what the fitted lens has"},
    {LENGTH(off), .name = "off", .label = "off", .help = "reached less target"},
    {COLUMN(struct goal_row, status), .name = "status", .label = "status",
     .help = "converged, or why the fit ended otherwise"},
    {COLUMN(struct goal_row, lens), .flags = COLUMN_EXTRA | COLUMN_ASSUMED, .name = "lens",
     .depends = "lens", .label = "lens", .help = "title of the lens"},
};

const struct sheet fit_goal_sheet = {columns, sizeof columns / sizeof columns[0],
                                     sizeof(struct goal_row)};

/* What was asked. */
struct wishes {
    struct prescription_goal goals[MOST_GOALS];
    const char *goal_names[MOST_GOALS];
    size_t goal_count;
    struct prescription_part parts[MOST_PARTS];
    const char *part_names[MOST_PARTS];
    size_t part_count;
};

/* The next item of a list: commas inside of brackets belong to it. */
static struct text next_item(struct text *rest)
{
    size_t length = 0;
    int depth = 0;
    while (length < rest->length && (rest->start[length] != ',' || depth > 0)) {
        depth += rest->start[length] == '[' ? 1 : rest->start[length] == ']' ? -1 : 0;
        length++;
    }
    const struct text item = {rest->start, length};
    *rest = length < rest->length
                ? (struct text){rest->start + length + 1, rest->length - length - 1}
                : (struct text){NULL, 0};
    return text_trim(item);
}

static bool read_length(struct text text, double *value, struct error *error)
{
    return quantity_read(text, &dimension_length, unit_find(&dimension_length, text_of("mm")),
                         value, NULL, error);
}

/* `@10deg` of a height, `@F` of the others: field and wavelength. */
static bool read_place(struct text text, struct run *run, struct prescription_goal *goal,
                       struct error *error)
{
    bool is_line;
    if (goal->kind == GOAL_HEIGHT) {
        return quantity_read(text, &dimension_angle, unit_find(&dimension_angle, text_of("deg")),
                             &goal->field, NULL, error);
    }
    if (!lines_find(run->db, text, (struct number_scale){1, -3}, &is_line, &goal->wavelength,
                    error)) {
        return false;
    }
    double own;
    if (is_line) {
        return true;
    }
    if (!quantity_read(text, &dimension_length, unit_find(&dimension_length, text_of("nm")), &own,
                       NULL, error)) {
        return false;
    }
    goal->wavelength = unit_from_own(unit_find(&dimension_length, text_of("um")), own);
    return true;
}

/* efl=50.2, bfl@F=38.1:0.02, height@10deg=8.85 */
static bool read_goal(struct text item, struct run *run, double wavelength,
                      struct prescription_goal *goal, struct error *error)
{
    static const char *const names[GOAL_KINDS] = {"efl", "bfl", "ffl", "height", "length"};
    struct text value = item, name = text_cut(&value, '='), place = name;
    struct text kind = text_cut(&place, '@'), deviation = value;
    *goal = (struct prescription_goal){GOAL_KINDS, NAN, 1, wavelength, NAN};
    for (int i = 0; i < GOAL_KINDS; i++) {
        goal->kind = text_equal(kind, names[i]) ? (enum goal_kind)i : goal->kind;
    }
    if (goal->kind == GOAL_KINDS || value.start == NULL) {
        fail(error, ERROR_USAGE, "bad goal '%.*s' in --prescription", (int)item.length, item.start);
        return error_hint(error,
                          "goals are efl=50.2, bfl=38.1:0.02, ffl, length, height@10deg=8.8");
    }
    value = text_cut(&deviation, ':');
    if (!read_length(value, &goal->value, error) ||
        (deviation.start != NULL && !read_length(deviation, &goal->deviation, error)) ||
        (place.start != NULL && !read_place(place, run, goal, error))) {
        return error_prefix(error, "bad goal in --prescription: ");
    }
    if (!isfinite(goal->value) || !(goal->deviation > 0 && isfinite(goal->deviation))) {
        return fail(error, ERROR_USAGE,
                    "the goal '%.*s' in --prescription: a finite value, and a deviation above 0",
                    (int)item.length, item.start);
    }
    return (goal->kind == GOAL_HEIGHT) == isfinite(goal->field) ||
           fail(error, ERROR_USAGE,
                "the goal height in --prescription wants its field: "
                "height@10deg=8.8");
}

static bool read_goals(const char *list, struct run *run, double wavelength, struct wishes *wishes,
                       struct error *error)
{
    struct text rest = text_of(list);
    while (rest.start != NULL) {
        struct text item = next_item(&rest);
        if (wishes->goal_count == MOST_GOALS) {
            return fail(error, ERROR_USAGE, "--prescription has more than %d goals", MOST_GOALS);
        }
        if (!read_goal(item, run, wavelength, &wishes->goals[wishes->goal_count], error)) {
            return false;
        }
        struct text name = text_cut(&item, '=');
        wishes->goal_names[wishes->goal_count++] =
            arena_string(run->arena, name.start, name.length);
    }
    return true;
}

static void add_part(struct wishes *wishes, struct run *run, enum part_kind kind, size_t surface,
                     double low, double high)
{
    static const char letters[] = {'R', 't', 'n'};
    size_t at = wishes->part_count++;
    wishes->parts[at] = (struct prescription_part){kind, surface, low, high};
    wishes->part_names[at] = arena_printf(run->arena, "%c%zu", letters[kind], surface + 1);
}

/* R1, t3[2,10], n2 */
static bool read_part(struct text item, struct run *run, struct wishes *wishes, struct error *error)
{
    static const char letters[] = "Rtn";
    struct text bounds = item, name = text_cut(&bounds, '[');
    const char *letter = name.length > 1 ? strchr(letters, name.start[0]) : NULL;
    double number = NAN, low = -INFINITY, high = INFINITY;
    const char *end = name.start + name.length;
    bool sound = letter != NULL &&
                 number_read(name.start + 1, end, (struct number_scale){1, 0}, &number) == end &&
                 number >= 1 && number < 1e6 && floor(number) >= number;
    if (sound && bounds.start != NULL) {
        struct text second = bounds, first;
        sound = bounds.length > 0 && bounds.start[bounds.length - 1] == ']';
        second.length -= sound ? 1 : 0;
        first = text_cut(&second, ',');
        struct error ignored;
        sound = sound && second.start != NULL &&
                quantity_read(first, &dimension_number, NULL, &low, NULL, &ignored) &&
                quantity_read(second, &dimension_number, NULL, &high, NULL, &ignored);
    }
    if (!sound) {
        fail(error, ERROR_USAGE, "bad part '%.*s' in --vary", (int)item.length, item.start);
        return error_hint(error, "parts are R1 (radius), t3[2,10] (gap, with bounds), n2 (index)");
    }
    add_part(wishes, run, (enum part_kind)(letter - letters), (size_t)number - 1, low, high);
    return true;
}

/* The marks R~ and t~ of the file. */
static bool take_marks(const struct lens *lens, struct run *run, struct wishes *wishes,
                       struct error *error)
{
    for (size_t i = 0; i < lens->surface_count; i++) {
        const struct surface *surface = &lens->surfaces[i];
        for (size_t j = 0; j < surface->vary_count; j++) {
            const struct vary *vary = &surface->varies[j];
            bool radius = text_equal(vary->what, "R"), gap = text_equal(vary->what, "t");
            if (wishes->part_count == MOST_PARTS) {
                return fail(error, ERROR_DOMAIN, "the lens has more than %d marks", MOST_PARTS);
            }
            if (radius || gap) {
                add_part(wishes, run, radius ? PART_RADIUS : PART_GAP, i,
                         vary->has_bounds ? vary->low.value.hi : -INFINITY,
                         vary->has_bounds ? vary->high.value.hi : INFINITY);
            }
        }
    }
    return wishes->part_count > 0 ||
           fail(error, ERROR_DOMAIN,
                "nothing may change: give --vary, or mark R~ and t~ in the "
                "lens");
}

static bool read_parts(const struct fit_input *input, const struct lens *lens, struct run *run,
                       struct wishes *wishes, struct error *error)
{
    struct text rest = text_of(input->vary != NULL ? input->vary : "");
    if (input->vary == NULL) {
        return take_marks(lens, run, wishes, error);
    }
    while (rest.start != NULL) {
        struct text item = next_item(&rest);
        if (wishes->part_count == MOST_PARTS) {
            return fail(error, ERROR_USAGE, "--vary has more than %d parts", MOST_PARTS);
        }
        if (!read_part(item, run, wishes, error)) {
            return false;
        }
        for (size_t i = 0; i + 1 < wishes->part_count; i++) {
            if (strcmp(wishes->part_names[i], wishes->part_names[wishes->part_count - 1]) == 0) {
                return fail(error, ERROR_USAGE, "--vary names %s twice", wishes->part_names[i]);
            }
        }
    }
    return true;
}

static bool save(const struct fit_input *input, const struct lens *lens,
                 const struct wishes *wishes, const struct prescription_fit *fit, struct run *run,
                 struct error *error)
{
    const struct lens all =
        prescription_apply(lens, wishes->parts, wishes->part_count, fit, run->arena);
    struct lens_warnings warnings;
    if (!lens_check(&all, run->arena, &warnings, error)) {
        return error_prefix(error, "the fitted lens: ");
    }
    struct text text = lens_write(&all, run->arena);
    return fit_write(input->output, text.start, text.length, run, error);
}

static bool visit(const struct lens_case *one, struct run *run, const void *context,
                  struct error *error)
{
    const struct fit_input *input = context;
    struct wishes *wishes = ARENA_NEW(run->arena, struct wishes);
    struct prescription_fit fit;
    if (one->position != NULL) {
        return fail(error, ERROR_DOMAIN,
                    "a lens with positions: its prescription is not that of one of them");
    }
    if (!read_goals(input->goals, run, one->wavelength, wishes, error) ||
        !read_parts(input, one->lens, run, wishes, error) ||
        !prescription_fit(one->lens, wishes->goals, wishes->goal_count, wishes->parts,
                          wishes->part_count, run->arena, &fit, error)) {
        return false;
    }
    if (input->show == FIT_ANSWER || input->show == FIT_RESIDUALS) {
        for (size_t g = 0; g < wishes->goal_count; g++) {
            const struct goal_row row = {.goal = wishes->goal_names[g],
                                         .lens = one->lens->title,
                                         .status = fit_status(&fit.summary),
                                         .target = wishes->goals[g].value,
                                         .reached = fit.reached[g],
                                         .off = fit.reached[g] - wishes->goals[g].value};
            if (!run_emit(run, &row)) {
                break;
            }
        }
    } else {
        memcpy(fit.summary.standard_error, fit.errors, wishes->part_count * sizeof(double));
        const struct fit_found found = {NULL, wishes->part_count, wishes->part_names, fit.values,
                                        &fit.summary};
        fit_emit(&found, (enum fit_show)input->show, run);
    }
    return input->output == NULL || save(input, one->lens, wishes, &fit, run, error);
}

bool fit_prescription(const struct fit_input *input, struct run *run, struct error *error)
{
    struct lens_question question = input->question;
    if (input->show == FIT_MATRIX || input->show == FIT_CORRELATIONS) {
        return fail(error, ERROR_USAGE, "--prescription shows answer or parameters");
    }
    if (question.wavelength.name == NULL && question.lens.lens != NULL) {
        question.wavelength.wavelength = lens_primary_wavelength(question.lens.lens);
        question.wavelength.name = "primary";
    }
    return lens_each(&question, run, visit, input, error);
}
