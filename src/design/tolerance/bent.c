/* design/tolerance/bent.c - rays that are moved by what is known of them to first order. */
/* SPDX-License-Identifier: MIT */
#include "design/tolerance/bent.h"

#include "base/processor.h"

void bent_move(const double *rows, const double *amounts, size_t count, int lanes, bool path,
               struct ray_block *end)
{
    kernel_bend *kernel = processor_has_avx512() ? kernel_bend_avx512
                          : processor_has_avx2() ? kernel_bend_avx2
                                                 : kernel_bend_sse2;
    kernel(rows, amounts, count, lanes, path, end);
}
