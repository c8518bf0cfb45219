/* cli/batch/queue.c - rows of a batch that wait until there are enough to compute them together. */
/* SPDX-License-Identifier: MIT */
#include "cli/batch/queue.h"

#include <string.h>

void queue_open(struct queue *queue, const struct command *command, const struct sheet *sheet,
                size_t passed_count, struct arena *arena)
{
    *queue = (struct queue){.capacity = BLOCK_INPUTS,
                            .input_size = command->input_size,
                            .row_size = sheet->row_size,
                            .passed_count = passed_count};
    queue->inputs = arena_array(arena, BLOCK_INPUTS, queue->input_size);
    queue->rows = arena_array(arena, BLOCK_INPUTS, queue->row_size);
    queue->errors = ARENA_ARRAY(arena, BLOCK_INPUTS, struct error);
    queue->passed = ARENA_ARRAY(arena, BLOCK_INPUTS * passed_count + 1, struct passed_cell);
    queue->lines = ARENA_ARRAY(arena, BLOCK_INPUTS, long);
}

void queue_add(struct queue *queue, const void *input, const struct batch *batch)
{
    size_t i = queue->count++;
    memcpy(queue->inputs + i * queue->input_size, input, queue->input_size);
    queue->errors[i].code = ERROR_NONE;
    queue->lines[i] = batch->line;
    if (queue->passed_count > 0) {
        memcpy(queue->passed + i * queue->passed_count, batch->passed,
               queue->passed_count * sizeof *queue->passed);
    }
}

void queue_run(struct queue *queue, const struct command *command, struct run *run)
{
    if (queue->count > 0) {
        command->run_block(&(struct block){.inputs = queue->inputs,
                                           .count = queue->count,
                                           .rows = queue->rows,
                                           .errors = queue->errors},
                           run);
    }
}
