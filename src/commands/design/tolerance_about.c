/* commands/design/tolerance_about.c - what all rows of tolerance say of their run. */
/* SPDX-License-Identifier: MIT */
#include "commands/design/tolerance_about.h"

#include "commands/design/tolerance_method.h"
#include "trace/aim/sample.h"

#include <math.h>
#include <string.h>

/* "10deg", "3mm"; of a position "lens". */
const char *tolerance_name_of(const struct tolerance_job *job,
                              const struct tolerance_figure *figure)
{
    static const double degrees = 57.295779513082323;
    struct arena *arena = job->run->arena;
    if (figure == NULL) {
        return job->trials.of == TOLERANCE_OF_MEAN ? "mean" : "worst";
    }
    if (figure->field == NULL || figure->field->point.kind == FIELD_NONE) {
        return figure->field == NULL ? "lens" : "axis";
    }
    const struct field_point *point = &figure->field->point;
    const bool is_angle = point->kind == FIELD_ANGLE;
    const double unit = is_angle ? degrees : 1;
    const char *name = is_angle ? "deg" : "mm";
    static const char *const orientations[] = {"", " T", " S"};
    const char *direction = orientations[figure->orientation];
    return point->value[0] != 0
               ? arena_printf(arena, "%.6g:%.6g%s%s", point->value[0] * unit,
                              point->value[1] * unit, name, direction)
               : arena_printf(arena, "%.6g%s%s", point->value[1] * unit, name, direction);
}

static const char *limit_in_words(const struct tolerance_job *job)
{
    const struct criterion_type *type = criterion_type(job->question.criterion.kind);
    const bool is_plain = strcmp(type->unit, "1") == 0;
    return isnan(job->limit) ? NULL
                             : arena_printf(job->run->arena, "%.6g%s%s", job->limit * type->scale,
                                            is_plain ? "" : " ", is_plain ? "" : type->unit);
}

const char *tolerance_position_of(const struct tolerance_job *job,
                                  const struct tolerance_figure *figure)
{
    return figure != NULL ? tolerance_view(&job->tolerance)->places[figure->place].setup.position
                          : NULL;
}

static const char *adjusted_in_words(const struct tolerance_job *job)
{
    static const char *const planes[] = {"", "paraxial focus", "best focus"};
    const char *words = planes[job->tolerance.question.refocus];
    for (size_t i = 0; i < job->question.compensator_count; i++) {
        words = arena_printf(job->run->arena, "%s%s%s", words, *words != '\0' ? ", " : "",
                             job->question.compensators[i].name);
    }
    return *words != '\0' ? words : "nothing";
}

/* With what rays that are not aimed anew are off by. */
static const char *tolerance_about_rays_in_words(const struct tolerance_job *job)
{
    const struct tolerance_input *input = job->input;
    struct arena *arena = job->run->arena;
    const struct criterion_type *type = criterion_type(job->question.criterion.kind);
    const double rounding = 1e-9; /* where the stop is the first surface */
    const char *aimed =
        job->question.aims      ? "aimed at the stop of every lens"
        : isnan(job->aim_error) ? "those of the nominal lens"
        : job->aim_error <= rounding * fabs(job->result.columns[0].tally.nominal)
            ? "those of the nominal lens (aimed anew: the same)"
            : arena_printf(arena, "those of the nominal lens (aimed anew: %.2g %s rms)",
                           type->scale * job->aim_error, type->unit);
    return arena_printf(arena, "%ld %s, %s, %s", input->rays, patterns[input->pattern].word,
                        job->question.view.clip ? "clipped" : "not clipped", aimed);
}

double tolerance_refocus_of(const struct tolerance_job *job, double refocus)
{
    const struct tolerance_question *question = &job->tolerance.question;
    return question->refocus == REFOCUS_NONE && question->compensator_count > 0 ? NAN : refocus;
}

double tolerance_move_scale(const struct compensator *one, const char **unit)
{
    static const double degrees = 57.295779513082323;
    const bool is_angle = (parameter_type(one->parts[0].what.kind)->is & PARAMETER_IS_ANGLE) != 0;
    *unit = is_angle ? "deg" : "mm";
    return is_angle ? degrees : 1;
}

const char *tolerance_moves_in_words(const struct tolerance_job *job, const double *moves)
{
    const char *words = NULL;
    for (size_t i = 0; i < job->question.compensator_count; i++) {
        const char *unit;
        const double scale = tolerance_move_scale(&job->question.compensators[i], &unit);
        words = arena_printf(job->run->arena, "%s%s%s %.6g %s", words != NULL ? words : "",
                             words != NULL ? ", " : "", job->question.compensators[i].name,
                             moves[i + 1] * scale, unit);
    }
    return words;
}

struct tolerance_about tolerance_about_of(const struct tolerance_job *job)
{
    const struct tolerance_input *input = job->input;
    return (struct tolerance_about){
        .fnumber = input->question.fnumber,
        .seed = input->seed,
        .made = arena_printf(job->run->arena, "%zu error%s, %s", job->perturbations.count,
                             job->perturbations.count == 1 ? "" : "s", job->made),
        .lens = job->lens->title,
        .method = tolerance_method_in_words(job),
        .rays = tolerance_about_rays_in_words(job),
        .adjusted = adjusted_in_words(job),
        .limit = limit_in_words(job),
        .warning = job->warning};
}
