/* commands/lens/trace_block.c - lenscalc trace as a filter: the rays of a batch in blocks. */
/* SPDX-License-Identifier: MIT */
#include "commands/lens/trace_answer.h"
#include "trace/dispatch.h"

#include <string.h>

enum { SYSTEMS = 64 };

/* A lens compiled at one wavelength. */
struct compiled {
    double wavelength; /* as typed, um; NaN = primary */
    struct ray_case one;
    struct trace_job job;
};

/* What is kept from block to block: one lens as one set of options has it. */
struct trace_block_kept {
    struct trace_input key; /* whose question the case answers */
    struct ray_case one;    /* at the primary wavelength */
    struct rays work;       /* one block */
    struct compiled compiled[SYSTEMS];
    size_t count;
    struct arena_mark base; /* before the case */
    struct arena_mark mark; /* behind it: systems lie there */
};

static bool trace_block_is_same(const struct trace_input *a, const struct trace_input *b)
{
    return memcmp(&a->question, &b->question, sizeof a->question) == 0;
}

/* The lens as this input wants it; what was kept for another is given up. */
static bool open_case(struct trace_block_kept *kept, const struct trace_input *input,
                      struct run *run, struct error *error)
{
    const size_t *positions;
    size_t count;
    kept->key.question.lens.lens = NULL;
    kept->count = 0;
    arena_reset(run->kept, kept->base);
    if (!lens_positions(input->question.lens.lens, input->question.position, run->kept, &positions,
                        &count, error) ||
        !ray_case_open(&input->question, positions[0], NAN, NULL, run->kept, &kept->one, error)) {
        return false;
    }
    memcpy(&kept->key, input, sizeof kept->key); /* padding too */
    kept->mark = arena_mark(run->kept);
    return true;
}

/* The system for an input: compiled already, or now. Null: `error` says why not. */
static const struct trace_job *find_job(const struct trace_input *input, struct run *run,
                                        struct error *error)
{
    struct trace_block_kept *kept = run->state;
    if (!trace_block_is_same(&kept->key, input) && !open_case(kept, input, run, error)) {
        return NULL;
    }
    for (size_t i = kept->count; i-- > 0;) {
        const struct compiled *compiled = &kept->compiled[i];
        if (compiled->wavelength == input->wavelength ||
            (isnan(compiled->wavelength) && isnan(input->wavelength))) {
            return &compiled->job;
        }
    }
    if (kept->count == SYSTEMS) {
        kept->count = 0;
        arena_reset(run->kept, kept->mark);
    }
    struct compiled *compiled = &kept->compiled[kept->count];
    double wavelength =
        isnan(input->wavelength) ? kept->one.setup.wavelengths[0].wavelength : input->wavelength;
    compiled->one = kept->one;
    compiled->one.setup = setup_at_wavelength(&kept->one.setup, wavelength, run->kept);
    if (!trace_job_open(&kept->key, &compiled->one, &compiled->job, error)) {
        return NULL;
    }
    compiled->wavelength = input->wavelength;
    kept->count++;
    return &compiled->job;
}

/* The inputs of a block that go through one system. */
struct group {
    const struct trace_job *job;
    size_t rows[RAYS_BLOCK]; /* where they stand in the block */
    struct ray starts[RAYS_BLOCK];
    size_t count;
};

static const struct trace_input *trace_block_input_at(const struct block *block, size_t i)
{
    return (const struct trace_input *)(const void *)block->inputs + i;
}

/* All inputs from `first` on that are like it; the others are left for later. */
static void trace_block_gather(const struct block *block, size_t first, bool done[],
                               struct group *group)
{
    const struct trace_input *like = trace_block_input_at(block, first);
    group->count = 0;
    for (size_t i = first; i < block->count; i++) {
        const struct trace_input *input = trace_block_input_at(block, i);
        bool same = i == first || (!done[i] && trace_block_is_same(input, like) &&
                                   (input->wavelength == like->wavelength ||
                                    (isnan(input->wavelength) && isnan(like->wavelength))));
        if (!same || done[i]) {
            continue;
        }
        done[i] = true;
        if (trace_start(input, &group->starts[group->count], &block->errors[i])) {
            group->rows[group->count++] = i;
        }
    }
}

static void trace_group(const struct block *block, const struct group *group, struct run *run)
{
    const struct trace_block_kept *kept = run->state;
    const struct trace_job *job = group->job;
    for (size_t k = 0; k < group->count; k++) {
        rays_set(&kept->work, k, job->system->index_first, &group->starts[k]);
    }
    rays_trace_part(job->system, 0, job->to, &kept->work, NULL);
    for (size_t k = 0; k < group->count; k++) {
        size_t i = group->rows[k];
        struct trace_row *row = (struct trace_row *)(void *)block->rows + i;
        trace_row_begin(job, &group->starts[k], row);
        trace_row_end(job, kept->work.blocks, k, row);
        trace_row_extras(job, &group->starts[k], job->to - 1, run->arena, row, &block->errors[i]);
    }
}

void trace_block(const struct block *block, struct run *run)
{
    bool done[RAYS_BLOCK] = {false};
    struct group group;
    if (run->state == NULL) {
        struct trace_block_kept *kept = ARENA_NEW(run->kept, struct trace_block_kept);
        kept->work = rays_new(run->kept, RAYS_BLOCK);
        kept->base = arena_mark(run->kept);
        run->state = kept;
    }
    for (size_t i = 0; i < block->count; i++) {
        if (done[i]) {
            continue;
        }
        group.job = find_job(trace_block_input_at(block, i), run, &block->errors[i]);
        done[i] = group.job == NULL;
        if (group.job != NULL) {
            trace_block_gather(block, i, done, &group);
            trace_group(block, &group, run);
        }
    }
}
