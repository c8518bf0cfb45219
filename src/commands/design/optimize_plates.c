/* commands/design/optimize_plates.c - optimize --test-plates: radii end as those of a maker's list. */
/* SPDX-License-Identifier: MIT */
#include "commands/design/optimize_job.h"

#include "data/tsv.h"
#include "data/whole_file.h"

#include <math.h>
#include <string.h>

/* -------- the list -------- */

/* A column by its name and a unit of length behind it: "radius_mm". */
static bool plates_find_column(const struct tsv *tsv, const char *name, size_t *column,
                               const struct unit **unit, struct error *error)
{
    for (size_t k = 0; k < tsv->columns; k++) {
        const struct text behind = text_behind(tsv->names[k], name);
        if (behind.start != NULL && behind.length > 1 && behind.start[0] == '_') {
            *unit =
                unit_find(&dimension_length, (struct text){behind.start + 1, behind.length - 1});
            *column = k;
            if (*unit != NULL) {
                return true;
            }
        }
    }
    fail_in(error, tsv->source, tsv->line, 0, "there is no column %s_mm", name);
    return error_hint(error, "its first line names columns with their units: radius_mm, "
                             "diameter_mm; or _in, _cm");
}

bool optimize_plates_open(struct optimize_job *job, struct error *error)
{
    const struct optimize_input *input = job->input;
    struct arena *arena = job->run->arena;
    static const char *const names[] = {"radius", "diameter"};
    const struct unit *units[2];
    size_t columns[2], room = 0;
    struct text content;
    struct tsv tsv;
    if (input->plates == NULL) {
        return input->show != OPTIMIZE_PLATES ||
               fail(error, ERROR_USAGE, "{--show} plates needs {--test-plates}");
    }
    size_t *surfaces = ARENA_ARRAY(arena, job->variables.count + 1, size_t);
    if (plate_surfaces(&job->variables, surfaces) == 0) {
        fail(error, ERROR_DOMAIN, "{--test-plates}: no radius of a sphere varies");
        return error_hint(error, "those that do are fitted: {--vary} R3, or the mark R~");
    }
    if (!whole_file(input->plates, arena, &content, error)) {
        return error->code == ERROR_NONE &&
               fail(error, ERROR_IO, "there is no file %.200s", input->plates);
    }
    if (!tsv_open_foreign(&tsv, input->plates, content, error)) {
        return false;
    }
    for (size_t k = 0; k < 2; k++) {
        if (!plates_find_column(&tsv, names[k], &columns[k], &units[k], error)) {
            return false;
        }
    }
    while (tsv_next(&tsv, error)) {
        double value[2];
        for (size_t k = 0; k < 2; k++) {
            if (!tsv_number(&tsv, columns[k], &value[k], error)) {
                return false;
            }
            value[k] = unit_to_own(units[k], value[k]);
            if (!(value[k] > 0) || (k == 1 && isinf(value[k]))) {
                return tsv_fail(&tsv, columns[k], error,
                                k == 0 ? "is no radius above 0 (both signs can be made by a pair)"
                                       : "is no diameter above 0");
            }
        }
        job->plates = arena_grow(arena, job->plates, job->plate_count, &room, sizeof *job->plates);
        job->plates[job->plate_count++] = (struct test_plate){value[0], value[1]};
    }
    return error->code == ERROR_NONE &&
           (job->plate_count > 0 ||
            fail(error, ERROR_DATA, "%s: there is no plate in it", input->plates));
}

/* -------- what they do -------- */

/* Of every surface what its plate has to cover, as stated or else as the beam, and 2 % more. */
static bool find_sizes(struct optimize_job *job, double *diameters, struct error *error)
{
    const struct clear_diameters_question asked = optimize_beams(job, 0.02);
    const struct lens *sized = job->found;
    bool are_stated = true;
    const char *notes;
    for (size_t i = 0; i < job->found->surface_count; i++) {
        are_stated = are_stated && job->found->surfaces[i].has_diameter;
    }
    if (!are_stated && !clear_diameters_find(&asked, job->run->arena, &sized, &notes, error)) {
        return error_prefix(error, "surfaces without a diameter are as large as the light: ");
    }
    for (size_t i = 0; i < job->found->surface_count; i++) {
        const struct surface *stated = &job->found->surfaces[i], *found = &sized->surfaces[i];
        const struct surface *surface = stated->has_diameter ? stated : found;
        diameters[i] = surface->has_diameter ? surface->diameter.value.hi : 0;
    }
    return true;
}

bool optimize_plates_hold(const struct optimize_job *job, const struct variable *variable)
{
    const struct parameter what = variable->what;
    bool is = false;
    for (size_t i = 0; job->fitted != NULL && i < job->fitted->count && !is; i++) {
        is = job->fitted->fits[i].surface == what.surface &&
             (what.kind == PARAMETER_RADIUS || what.kind == PARAMETER_CURVATURE);
    }
    return is;
}

/* Curved surfaces that have no plate, as their radii do not vary or they are no spheres. */
static void plates_warn_of_others(struct optimize_job *job)
{
    const char *names = NULL;
    struct arena *arena = job->run->arena;
    for (size_t i = 0; i < job->found->surface_count; i++) {
        const struct surface *surface = &job->found->surfaces[i];
        const struct variable radius = {.what = {.surface = i, .kind = PARAMETER_RADIUS}};
        bool is_said = !surface_has(surface, SURFACE_HAS_CURVE) ||
                       surface_profile(surface) == PROFILE_PLANE ||
                       optimize_plates_hold(job, &radius);
        for (size_t k = 0; k < job->fitted->missing; k++) {
            is_said = is_said || job->fitted->left[k] == i;
        }
        if (!is_said) {
            names = arena_printf(arena, "%s%s%zu", names == NULL ? "" : names,
                                 names == NULL ? "" : ", ", i + 1);
        }
    }
    if (names != NULL) {
        optimize_warn(job,
                      "fitted to no test plate, as their radii do not vary or they are no "
                      "spheres: surfaces %s",
                      names);
    }
}

/* Radii that were not fitted, and why, in words; null: all were. */
static const char *plates_left(const struct plate_choice *fitted, struct arena *arena)
{
    const char *names = NULL;
    for (size_t i = 0; i < fitted->missing; i++) {
        names = arena_printf(arena, "%s%sR%zu", names == NULL ? "" : names,
                             names == NULL ? "" : ", ", fitted->left[i] + 1);
    }
    if (names == NULL) {
        return NULL;
    }
    return fitted->is_stopped
               ? arena_printf(arena, "there was no time to fit %s to a test plate", names)
               : arena_printf(arena,
                              "no test plate is as large as the surface, within the bounds, "
                              "for %s",
                              names);
}

bool optimize_plates_fit(struct optimize_job *job, struct error *error)
{
    struct arena *arena = job->run->arena;
    struct plate_choice *fitted = ARENA_NEW(arena, struct plate_choice);
    if (job->input->plates == NULL) {
        return true;
    }
    double *diameters = ARENA_ARRAY(arena, job->found->surface_count, double);
    const struct plate_task task = {.question = &job->merit.question,
                                    .how = &job->task,
                                    .plates = job->plates,
                                    .plate_count = job->plate_count,
                                    .lens = job->found,
                                    .merit = job->answer.after.merit,
                                    .missed = job->answer.summary.excess,
                                    .diameters = diameters};
    if (!find_sizes(job, diameters, error) || !plates_fit(&task, arena, fitted, error)) {
        return error_prefix(error, "{--test-plates}: ");
    }
    job->fitted = fitted;
    if (fitted->fitted > 0) {
        /* these variables in the list of the job, by those of the glasses' exchange */
        const bool has_glasses = job->choice != NULL && job->choice->count > 0;
        for (size_t i = 0; i < fitted->variables.count && has_glasses; i++) {
            fitted->origin[i] = job->choice->origin[fitted->origin[i]];
        }
        optimize_answer_join(job, &fitted->answer, fitted->origin, fitted->variables.count);
        job->found = fitted->lens;
        job->merit = fitted->merit;
        job->look = NULL;
    }
    job->answer.summary.evaluations += fitted->evaluations;
    job->answer.summary.iterations += fitted->iterations;
    if (fitted->is_stopped) {
        job->answer.summary.status = SOLVER_STOPPED;
    }
    job->unfitted = plates_left(fitted, arena);
    plates_warn_of_others(job);
    return true;
}

const char *optimize_plates_words(const struct optimize_job *job)
{
    const struct plate_choice *fitted = job->fitted;
    if (fitted == NULL) {
        return NULL;
    }
    const double cost =
        fitted->count > 0 ? fitted->fits[fitted->count - 1].after - fitted->fits[0].before : 0;
    return arena_printf(job->run->arena, "%zu of %zu radii by %zu test plates, which cost %.4g",
                        fitted->fitted, fitted->fitted + fitted->missing, job->plate_count, cost);
}

/* -------- rows -------- */

struct optimize_plate_row {
    struct optimize_about about;
    double radius, fitted, plate, diameter, before, after, loss;
    long surface;
};

static const struct column plate_columns[] = {
    OPTIMIZE_SWEPT_COLUMNS(struct optimize_plate_row),
    {COLUMN_NAMED(struct optimize_plate_row, surface, COLUMN_BRIEF),
     .help = "whose radius was replaced, in the order in which that was done"},
    {COLUMN_OF_LENGTH(struct optimize_plate_row, radius, "mm"), .name = "radius_before",
     .flags = COLUMN_BRIEF | COLUMN_INFINITE, .digits = 6, .label = "radius before",
     .help = "as it was then, or that of another plate"},
    {COLUMN_OF_LENGTH(struct optimize_plate_row, fitted, "mm"), .name = "radius",
     .flags = COLUMN_BRIEF | COLUMN_INFINITE, .digits = 6, .help = "of the plate, with its sign"},
    {COLUMN_OF_LENGTH(struct optimize_plate_row, diameter, "mm"), .name = "diameter",
     .flags = COLUMN_BRIEF, .help = "of the surface, as stated or else of the beam and 2 % more"},
    {COLUMN_OF_LENGTH(struct optimize_plate_row, plate, "mm"), .name = "plate_diameter",
     .flags = COLUMN_BRIEF, .label = "plate diameter", .help = "of the plate"},
    {COLUMN(struct optimize_plate_row, before), .flags = COLUMN_BRIEF, .name = "merit_before",
     .label = "merit before", .help = "before this radius was replaced"},
    {COLUMN(struct optimize_plate_row, after), .flags = COLUMN_BRIEF, .name = "merit_after",
     .label = "merit after", .help = "after it, everything else optimised again"},
    {COLUMN_NAMED(struct optimize_plate_row, loss, COLUMN_BRIEF),
     .help = "how much the merit has grown; of two replaced at once in the row of the second"},
    OPTIMIZE_LENS_COLUMNS(struct optimize_plate_row),
};

const struct sheet optimize_plate_sheet = SHEET(plate_columns, struct optimize_plate_row);

bool optimize_emit_plates(struct optimize_job *job, struct error *error)
{
    (void)error;
    for (size_t i = 0; i < job->fitted->count; i++) {
        const struct plate_fit *fit = &job->fitted->fits[i];
        const struct optimize_plate_row row = {.about = optimize_about_of(job, i == 0),
                                               .surface = (long)fit->surface + 1,
                                               .radius = fit->radius,
                                               .fitted = fit->fitted,
                                               .plate = fit->plate->diameter,
                                               .diameter = fit->diameter,
                                               .before = fit->before,
                                               .after = fit->after,
                                               .loss = fit->is_joined ? (double)NAN
                                                                      : fit->after - fit->before};
        if (!run_emit(job->run, &row)) {
            break;
        }
    }
    return true;
}
