/* design/tolerance/linear_rays.c - rays that are moved by what is known of them to first order. */
/* SPDX-License-Identifier: MIT */
#include "design/tolerance/linear_rays.h"

#include "base/instruction_set.h"

void bent_move(const double *rows, const double *amounts, size_t count, int lanes, bool path,
               struct ray_block *end)
{
    kernel_bend *kernel = KERNEL_FOR(SET_BEST, kernel_bend);
    kernel(rows, amounts, count, lanes, path, end);
}
