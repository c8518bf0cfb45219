/* commands/design/tolerance_files.c - lenses as they may be made, and parts of a divided run. */
/* SPDX-License-Identifier: MIT */
#include "commands/design/design.h"
#include "commands/design/tolerance_job.h"
#include "file/lens_file.h"

#include <string.h>

const struct file_type *tolerance_types(size_t i)
{
    return i == 0 ? &lens_file_type : division_types(i - 1);
}

static bool is_part(const struct artifact_job *job)
{
    return job->type == division_types(0);
}

size_t tolerance_count_output(const void *data)
{
    const struct tolerance_input *input = data;
    struct text rest = text_of(input->save != NULL ? input->save : "");
    const bool is_worst = text_equal(text_cut(&rest, ':'), "worst");
    double number = 1;
    struct error ignored;
    if (is_worst && rest.start != NULL &&
        !quantity_read(rest, &dimension_number, NULL, &number, NULL, &ignored)) {
        return 1;
    }
    const bool is_one = input->part.count > 0 || !is_worst || !(number >= 1);
    return is_one || number > TOLERANCE_WORST_MOST ? 1 : (size_t)number;
}

bool tolerance_check_output(const struct artifact_job *job, struct error *error)
{
    const struct tolerance_input *input = job->inputs[0];
    if (job->run->parts != NULL && is_part(job)) {
        return fail(error, ERROR_USAGE, "a merged run is whole: %s is the name of a part",
                    job->path);
    }
    if (is_part(job) && input->show == TOLERANCE_TRIALS) {
        return fail(error, ERROR_USAGE,
                    "{--part} holds counts, not rows: {--show} trials is of a whole run");
    }
    if (is_part(job)) {
        return input->part.count > 0 ||
               fail(error, ERROR_USAGE, "%s is the name of a part: {--part} says of which",
                    job->path);
    }
    if (input->part.count > 0 && job->run->parts == NULL) {
        return fail(error, ERROR_USAGE,
                    "{--part} goes into a .part: lenses of {--save} are those that 'lenscalc "
                    "merge' writes, not %s",
                    job->path != NULL ? job->path : "");
    }
    return input->save != NULL ||
           fail(error, ERROR_USAGE, "{--output} %s needs {--save}, which says what is written",
                job->path != NULL ? job->path : "");
}

/* The lens of a trial, which is made once more. */
static bool save_trial(struct tolerance_job *job, uint64_t number, struct output *sink,
                       struct error *error)
{
    struct arena *arena = job->run->arena;
    struct tolerance *tolerance = &job->tolerance;
    const unsigned long long shown = (unsigned long long)number + 1, seed = job->trials.seed;
    double *errors = ARENA_ARRAY(arena, job->perturbations.count + 1, double);
    struct tolerance_trial trial = {.figures = ARENA_ARRAY(arena, tolerance->figure_count, double),
                                    .moves =
                                        ARENA_ARRAY(arena, tolerance_moves(tolerance), double)};
    tolerance_errors(&job->question, job->trials.seed, number, errors);
    if (!tolerance_trial(tolerance, errors, &trial)) {
        *error = trial.why;
        return error_prefix(error, "trial %llu has no figures: ", shown);
    }
    struct lens *lens = tolerance_lens(tolerance, &trial, arena);
    lens->tolerance_count = 0; /* it is made: nothing of it is uncertain */
    const struct criterion_type *type = criterion_type(job->question.criterion.kind);
    design_note(
        lens,
        arena_printf(arena, "as made in trial %llu of seed %llu: %s %.6g %s", shown, seed,
                     job->question.criterion.name,
                     type->scale * tolerance_judged(tolerance, job->trials.of, trial.figures),
                     type->unit),
        arena);
    /* what the figure is by, and what of the trial the lens cannot have */
    design_note(lens, arena_printf(arena, "that is by rays %s", tolerance_about_of(job).rays),
                arena);
    if (job->question.view.clip) {
        design_note(lens,
                    "and what the nominal lens lets through: this one does not quite the same",
                    arena);
    }
    if (tolerance->irregularity_count > 0) {
        design_note(lens, "without the irregularity of its surfaces, which is in that figure",
                    arena);
    }
    design_note_source(lens, "made after", arena);
    const struct text text = lens_write(lens, arena);
    output_text(sink, text.start, text.length);
    return true;
}

bool tolerance_write_output(const struct artifact_job *asked, struct output *sink,
                            struct error *error)
{
    struct tolerance_job *job = asked->run->state;
    if (is_part(asked)) {
        /* The part: what was counted of its trials. */
        struct arena *arena = job->run->arena;
        struct part_head head = job->head;
        head.done = job->result.done;
        division_write(&head, tolerance_result_write(&job->result, arena), arena, sink);
        return true;
    }
    if (job->save_trial > 0) {
        return save_trial(job, (uint64_t)job->save_trial - 1, sink, error);
    }
    for (size_t i = 0; i < asked->files; i++) {
        if (i >= job->result.worst_count) {
            sink[i].is_unused = true;
        } else if (!save_trial(job, job->result.worst[i].trial, &sink[i], error)) {
            return false;
        }
    }
    return job->result.worst_count > 0 ||
           fail(error, ERROR_DOMAIN, "{--save}: no trial has a figure");
}
