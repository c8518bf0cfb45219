/* commands/design/optimize_usual.c - what is wanted of a lens where no goals are given. */
/* SPDX-License-Identifier: MIT */
#include "base/choice.h"
#include "commands/design/optimize_job.h"
#include "optics/first_order.h"

#include <math.h>

/* -------- those that are left out -------- */

static const char *const usual_names[] = {"poly",   "efl",  "fnumber", "bfl",
                                          "center", "edge", "air",     "grazing"};
enum { USUAL_NAMES = sizeof usual_names / sizeof usual_names[0] };

bool optimize_usual_is_off(const struct optimize_input *input, const char *name)
{
    struct text rest = text_of(input->no_goal != NULL ? input->no_goal : "");
    bool is_off = false;
    while (rest.start != NULL && input->no_goal != NULL) {
        const struct text typed = text_trim(text_cut(&rest, ','));
        is_off = is_off || text_same(typed, name);
    }
    return is_off;
}

/* Names of --no-goal; has_own: goals are given, of which none is usual but grazing. */
static bool usual_check(const struct optimize_input *input, bool has_own, struct error *error)
{
    struct text rest = text_of(input->no_goal != NULL ? input->no_goal : "");
    while (rest.start != NULL && input->no_goal != NULL) {
        const struct text typed = text_trim(text_cut(&rest, ','));
        struct choice choice = {.typed = typed};
        bool is_usual = false;
        for (size_t i = 0; i < USUAL_NAMES; i++) {
            choice_offer(&choice, usual_names[i]);
            is_usual = is_usual || text_same(typed, usual_names[i]);
        }
        if (!is_usual) {
            choice_refuse(&choice, error);
            return error_prefix(error, "bad goal in {--no-goal}: ");
        }
        if (has_own && !text_same(typed, "grazing")) {
            return input->goals != NULL
                       ? fail(error, ERROR_USAGE,
                              "{--no-goal} leaves out usual goals, and {--goals} is in their place")
                       : fail(error, ERROR_USAGE,
                              "{--no-goal} leaves out usual goals, and the lens has its own");
        }
    }
    return true;
}

/* -------- those of a lens -------- */

/* The least of the lens's own centres, edges or gaps, mm; NaN: it cannot be told. */
static double least_of_goal(struct optimize_job *job, const struct merit_question *question,
                            const char *name)
{
    struct arena *arena = job->run->arena;
    const struct goals_reader reader = {job->run->db, job->lens, arena, "--goals", 1};
    const char *words = arena_printf(arena, "%s > 0", name);
    struct merit_question asked = *question;
    struct merit merit;
    struct goals goals;
    struct error ignored;
    if (!goals_read(&reader, text_of(words), &goals, &ignored)) {
        return NAN;
    }
    asked.operands = goals.list;
    asked.operand_count = goals.count;
    if (!merit_open(&asked, arena, &merit, &ignored)) {
        return NAN;
    }
    merit_aperture_of_wanted(&merit);
    double *numbers = ARENA_ARRAY(arena, job->variables.count + 1, double), least = INFINITY;
    double *residuals = ARENA_ARRAY(arena, merit.residual_count + 1, double);
    variables_get(&job->variables, numbers);
    if (!merit_evaluate(&merit, numbers, residuals, NULL)) {
        return NAN;
    }
    for (size_t i = 0; i < merit.residual_count; i++) {
        least = fmin(least, merit.values[i]);
    }
    return least;
}

/* The least gap, of the focal length. */
#define USUAL_GAP 0.001

/* A list of goals in the making. */
struct usual_list {
    const struct optimize_input *input;
    struct arena *arena;
    const char *words;
};

/* One more, by the name that leaves it out. */
static void usual_add(struct usual_list *list, const char *name, const char *goal)
{
    if (!optimize_usual_is_off(list->input, name)) {
        list->words =
            ARENA_JOIN(list->arena, list->words, list->words[0] != '\0' ? ", " : "", goal);
    }
}

/* Of a position: its focal length, mm, is what is stated, else its own; NaN: it has none. */
static double usual_focal_of(const struct optimize_job *job, const struct merit_question *question,
                             size_t position)
{
    const struct lens *lens = job->lens;
    double focal = lens_stated(lens, STATED_EFL, position);
    struct first_order first;
    struct error ignored;
    if (isnan(focal) && first_order_of_lens(lens_at_position(lens, position, job->run->arena),
                                            lens_primary_wavelength(lens), question->section,
                                            job->run->arena, &first, &ignored)) {
        focal = first.efl;
    }
    return focal;
}

/* The f-number that is stated, unless the aperture is one; a millimetre of the focal length and as
   much of the f-number count alike. */
static void usual_add_fnumber(struct usual_list *list, const struct optimize_job *job,
                              const struct merit_question *question, size_t position, double focal)
{
    const struct lens *lens = job->lens;
    const double stated = lens_stated(lens, STATED_FNUMBER, position);
    const struct aperture_setting own =
        lens_aperture(lens_at_position(lens, position, list->arena));
    const bool is_held = !isnan(question->fnumber) || own.kind == APERTURE_FNUMBER;
    const char *place =
        lens->position_count > 1 ? arena_printf(list->arena, "@%s", lens->positions[position]) : "";
    if (stated > 0 && !is_held && own.kind != APERTURE_NONE) {
        usual_add(list, "fnumber",
                  arena_printf(list->arena, "fnumber%s = %.6g : %.2g", place, stated,
                               stated / fabs(focal)));
    }
}

/* Two digits of a bound, not more than it is. */
static double usual_bound(double least, double usual)
{
    const double bound = least > 0 ? fmin(least, usual) : usual;
    const double step = pow(10, floor(log10(bound)) - 1);
    return floor(bound / step * (1 + 1e-12)) * step;
}

/*
 * The image behind the last vertex, along the light, as far as a gap is wide. Of a far object that
 * is focused paraxially it is the share of the focal length that counts, the height of the marginal
 * ray there, as the back focus itself has a pole where the lens has no power.
 */
static void usual_add_back(struct usual_list *list, const struct optimize_job *job,
                           const struct merit_question *question, double focal)
{
    const struct lens *lens = lens_at_position(
        job->lens, question->position_count > 0 ? question->positions[0] : 0, list->arena);
    const struct surface *last = &lens->surfaces[lens->surface_count - 1];
    const bool is_table = lens->focus == FOCUS_TABLE;
    struct first_order first;
    struct error ignored;
    double direction = 1;
    if (lens->focus == FOCUS_AFOCAL || lens->focus == FOCUS_BEST ||
        (is_table && !last->has_thickness) ||
        !first_order_of_lens(lens, lens_primary_wavelength(lens), question->section, list->arena,
                             &first, &ignored)) {
        return;
    }
    for (size_t i = 0; i < lens->surface_count; i++) {
        direction = surface_reflects(&lens->surfaces[i]) ? -direction : direction;
    }
    const double image = is_table ? last->thickness.value.hi : first.image;
    if (isfinite(image) && direction * image < 0) {
        return;
    }
    if (is_table || !lens->object_is_infinite) {
        const double bound = usual_bound(direction * image, USUAL_GAP * fabs(focal));
        usual_add(list, "bfl",
                  arena_printf(list->arena, "track - length %s %.2g", direction > 0 ? ">" : "<",
                               direction * bound));
    } else {
        const double bound = usual_bound(fabs(image / focal), USUAL_GAP);
        const double sign = first.efl < 0 ? -direction : direction;
        usual_add(list, "bfl",
                  arena_printf(list->arena, "bfl/efl %s %.2g : %.2g", sign > 0 ? ">" : "<",
                               sign * bound, 1 / fabs(focal)));
    }
}

static const char *usual_goals(struct optimize_job *job, const struct merit_question *question)
{
    static const struct {
        const char *name;
        double share;
    } limits[] = {{"center", 0.02}, {"edge", 0.01}, {"air", USUAL_GAP}};
    struct arena *arena = job->run->arena;
    const struct lens *lens = job->lens;
    struct usual_list list = {job->input, arena, ""};
    double size = INFINITY;
    usual_add(&list, "poly", "poly");
    for (size_t i = 0; i < question->position_count; i++) {
        const size_t at = question->positions[i];
        const double focal = usual_focal_of(job, question, at);
        if (isfinite(focal)) {
            const char *place =
                lens->position_count > 1 ? arena_printf(arena, "@%s", lens->positions[at]) : "";
            usual_add(&list, "efl", arena_printf(arena, "efl%s = %.6g", place, focal));
            usual_add_fnumber(&list, job, question, at, focal);
            size = fmin(size, fabs(focal));
        }
    }
    if (isfinite(size)) {
        usual_add_back(&list, job, question, size);
    }
    for (size_t i = 0; i < sizeof limits / sizeof limits[0] && isfinite(size); i++) {
        const double least = least_of_goal(job, question, limits[i].name),
                     usual = limits[i].share * size;
        if (!isnan(least)) {
            usual_add(&list, limits[i].name,
                      arena_printf(arena, "%s > %.2g", limits[i].name, usual_bound(least, usual)));
        }
    }
    return list.words;
}

bool optimize_usual_open(struct optimize_job *job, const struct merit_question *question,
                         struct error *error)
{
    if (!usual_check(job->input, job->goals != NULL, error)) {
        return false;
    }
    job->goals = job->goals != NULL ? job->goals : usual_goals(job, question);
    return job->goals[0] != '\0' || job->input->no_goal == NULL ||
           fail(error, ERROR_USAGE, "{--no-goal} leaves no goal");
}
