/* trace/dispatch.c - the choice of instructions, and blocks cut among threads. */
/* SPDX-License-Identifier: MIT */
#include "trace/dispatch.h"

#include "base/parallel.h"
#include "base/processor.h"
#include "trace/adjoint.h"
#include "trace/aim_block.h"
#include "trace/aim_map.h"
#include "trace/beam_block.h"
#include "trace/tangent.h"

bool instruction_set_works(enum instruction_set set)
{
    return set == SET_AVX2     ? processor_has_avx2()
           : set == SET_AVX512 ? processor_has_avx512()
                               : true;
}

const char *instruction_set_name(enum instruction_set set)
{
    static const char names[][8] = {"best", "sse2", "avx2", "avx512"};
    return names[set];
}

enum instruction_set instruction_set_best(enum instruction_set set)
{
    if (set != SET_BEST) {
        return set;
    }
    return instruction_set_works(SET_AVX512) ? SET_AVX512
           : instruction_set_works(SET_AVX2) ? SET_AVX2
                                             : SET_SSE2;
}

static kernel_trace *trace_of(enum instruction_set set)
{
    static kernel_trace *const kernels[] = {NULL, kernel_trace_sse2, kernel_trace_avx2,
                                            kernel_trace_avx512};
    return kernels[instruction_set_best(set)];
}

kernel_tape *dispatch_tape(enum instruction_set set)
{
    static kernel_tape *const kernels[] = {NULL, kernel_tape_sse2, kernel_tape_avx2,
                                           kernel_tape_avx512};
    return kernels[instruction_set_best(set)];
}

kernel_adjoint *dispatch_adjoint(enum instruction_set set)
{
    static kernel_adjoint *const kernels[] = {NULL, kernel_adjoint_sse2, kernel_adjoint_avx2,
                                              kernel_adjoint_avx512};
    return kernels[instruction_set_best(set)];
}

kernel_displace *dispatch_displace(enum instruction_set set)
{
    static kernel_displace *const kernels[] = {NULL, kernel_displace_sse2, kernel_displace_avx2,
                                               kernel_displace_avx512};
    return kernels[instruction_set_best(set)];
}

kernel_tangent *dispatch_tangent(enum instruction_set set)
{
    static kernel_tangent *const kernels[] = {NULL, kernel_tangent_sse2, kernel_tangent_avx2,
                                              kernel_tangent_avx512};
    return kernels[instruction_set_best(set)];
}

kernel_aim *dispatch_aim(enum instruction_set set)
{
    static kernel_aim *const kernels[] = {NULL, kernel_aim_sse2, kernel_aim_avx2,
                                          kernel_aim_avx512};
    return kernels[instruction_set_best(set)];
}

kernel_map *dispatch_map(enum instruction_set set)
{
    static kernel_map *const kernels[] = {NULL, kernel_map_sse2, kernel_map_avx2,
                                          kernel_map_avx512};
    return kernels[instruction_set_best(set)];
}

kernel_beam *dispatch_beam(enum instruction_set set)
{
    static kernel_beam *const kernels[] = {NULL, kernel_beam_sse2, kernel_beam_avx2,
                                           kernel_beam_avx512};
    return kernels[instruction_set_best(set)];
}

void rays_watch(const struct system *system, const struct rays *rays,
                const struct rim_watching *watching)
{
    static kernel_watch *const kernels[] = {NULL, kernel_watch_sse2, kernel_watch_avx2,
                                            kernel_watch_avx512};
    const bool few = rays->count <= RAYS_FEW;
    kernel_watch *kernel = few ? kernel_watch_few : kernels[instruction_set_best(SET_BEST)];
    kernel(system->steps, system->begin[system->places], system->options.path,
           few ? kernel_lanes_few(rays->count) : kernel_lanes(rays->count), watching, rays->blocks);
}

struct work {
    kernel_trace *kernel;
    const struct step *steps;
    size_t count;
    bool path, few;
    const struct rays *rays;
};

static void trace_blocks(void *context, size_t begin, size_t end)
{
    const struct work *work = context;
    for (size_t i = begin; i < end; i++) {
        const size_t left = work->rays->count - i * RAYS_BLOCK;
        const int lanes = work->few ? kernel_lanes_few(left) : kernel_lanes(left);
        work->kernel(work->steps, work->count, work->path, lanes, &work->rays->blocks[i]);
    }
}

enum { BLOCKS_A_PIECE = 64 };

void rays_trace_part(const struct system *system, size_t from, size_t to, const struct rays *rays,
                     const struct trace_way *way)
{
    static const struct trace_way usual = {SET_BEST, 1};
    way = way == NULL ? &usual : way;
    bool few = way->set == SET_BEST && rays->count <= RAYS_FEW;
    struct work work = {few ? kernel_trace_few : trace_of(way->set),
                        system->steps + system->begin[from],
                        system->begin[to] - system->begin[from],
                        system->options.path,
                        few,
                        rays};
    const size_t blocks = rays_blocks(rays);
    if (way->threads <= 1 || blocks <= BLOCKS_A_PIECE) {
        trace_blocks(&work, 0, blocks);
    } else {
        parallel_for(way->threads, blocks, BLOCKS_A_PIECE, trace_blocks, &work);
    }
}

void rays_trace(const struct system *system, const struct rays *rays, const struct trace_way *way)
{
    rays_trace_part(system, 0, system->places, rays, way);
}
