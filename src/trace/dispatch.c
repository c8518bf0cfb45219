/* trace/dispatch.c - blocks of rays cut among threads. */
/* SPDX-License-Identifier: MIT */
#include "trace/dispatch.h"

#include "base/parallel.h"

void rays_watch(const struct system *system, const struct rays *rays,
                const struct rim_watch_request *watching)
{
    const bool few = rays->count <= RAYS_FEW;
    kernel_watch *kernel = few ? kernel_watch_few : KERNEL_FOR(SET_BEST, kernel_watch);
    kernel(system->steps, system->begin[system->places], system->options.path,
           few ? kernel_lanes_few(rays->count) : kernel_lanes(rays->count), watching, rays->blocks);
}

struct trace_work {
    kernel_trace *kernel;
    const struct step *steps;
    size_t count;
    bool path, few;
    const struct rays *rays;
};

static void trace_blocks(void *context, size_t begin, size_t end)
{
    const struct trace_work *work = context;
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
    struct trace_work work = {few ? kernel_trace_few : KERNEL_FOR(way->set, kernel_trace),
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
