/* design/tolerance/linear_rays.h - rays that are moved by what is known of them to first order. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_TOLERANCE_LINEAR_RAYS_H
#define LENSCALC_DESIGN_TOLERANCE_LINEAR_RAYS_H

#include "base/instruction_set.h"
#include "trace/kernel/rays.h"

#include <stdbool.h>
#include <stddef.h>

/* What moves: x, y, p, q and the path. */
enum { LINEAR_RAYS_PARTS = 5 };

/*
 * Move rays.
 *
 * Given     rows     of each part `count` rows of `lanes`: derivatives by each amount
 *           lanes    a multiple of RAYS_FEW
 *           path     that moves too; else its rows are not read
 *           end      receives the change; (p, q, r) keeps its length, to first order
 */
typedef void kernel_bend(const double *rows, const double *amounts, size_t count, int lanes,
                         bool path, struct ray_block *end);
kernel_bend kernel_bend_sse2, kernel_bend_avx2, kernel_bend_avx512;

/* The same, with the best kernel. */
static inline void bent_move(const double *rows, const double *amounts, size_t count, int lanes,
                             bool path, struct ray_block *end)
{
    KERNEL_FOR(SET_BEST, kernel_bend)(rows, amounts, count, lanes, path, end);
}

#endif
