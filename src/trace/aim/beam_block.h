/* trace/aim/beam_block.h - the kernels that start rays of a beam. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_AIM_BEAM_BLOCK_H
#define LENSCALC_TRACE_AIM_BEAM_BLOCK_H

#include "trace/aim/beam.h"
#include "trace/dispatch.h"

/* See beam_start. */
typedef void kernel_beam(const struct beam *beam, const double *a, const double *b, size_t count,
                         struct ray_block *block);
kernel_beam kernel_beam_sse2, kernel_beam_avx2, kernel_beam_avx512;

#endif
