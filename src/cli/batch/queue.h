/* cli/batch/queue.h - rows of a batch that wait until there are enough to compute them together. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_BATCH_QUEUE_H
#define LENSCALC_CLI_BATCH_QUEUE_H

#include "cli/batch/batch.h"

struct queue {
    size_t capacity, count; /* capacity 0: the command computes one by one */
    size_t input_size, row_size, passed_count;
    char *inputs, *rows;
    struct error *errors;
    struct passed_cell *passed; /* passed_count a row; they point into the batch's buffer */
    long *lines;                /* in the file */
};

void queue_open(struct queue *queue, const struct command *command, const struct sheet *sheet,
                size_t passed_count, struct arena *arena);

/* Keep the input that the batch has just read. */
void queue_add(struct queue *queue, const void *input, const struct batch *batch);

/* Compute what waits: rows and errors. */
void queue_run(struct queue *queue, const struct command *command, struct run *run);

static inline const void *queue_row(const struct queue *queue, size_t i)
{
    return queue->rows + i * queue->row_size;
}

static inline const void *queue_input(const struct queue *queue, size_t i)
{
    return queue->inputs + i * queue->input_size;
}

static inline const struct passed_cell *queue_passed(const struct queue *queue, size_t i)
{
    return queue->passed + i * queue->passed_count;
}

#endif
