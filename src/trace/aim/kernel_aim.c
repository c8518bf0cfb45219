/* trace/aim/kernel_aim.c - Broyden's steps of a block of rays: a lane loop for each instruction set. */
/* SPDX-License-Identifier: MIT */
#include "trace/aim/aim_block.h"
#include "trace/kernel/lanes.h"

/* m so that it takes the change of the miss to the step. */
INLINE void kernel_aim_correct(struct aim_block *restrict block, bool takes, double x, double y,
                               int i)
{
    double sa = block->step_a[i], sb = block->step_b[i];
    double m0 = block->m[0][i], m1 = block->m[1][i], m2 = block->m[2][i], m3 = block->m[3][i];
    double change_x = block->miss_x[i] - x, change_y = block->miss_y[i] - y;
    double moved_a = m0 * change_x + m1 * change_y, moved_b = m2 * change_x + m3 * change_y;
    double along = sa * moved_a + sb * moved_b, size2 = sa * sa + sb * sb;
    bool corrects = takes & (fabs(along) > 1e-12 * size2);
    double over = 1 / (corrects ? along : 1);
    double back_x = (sa * m0 + sb * m2) * over, back_y = (sa * m1 + sb * m3) * over;
    double more_a = corrects ? sa - moved_a : 0, more_b = corrects ? sb - moved_b : 0;
    block->m[0][i] = m0 + more_a * back_x;
    block->m[1][i] = m1 + more_a * back_y;
    block->m[2][i] = m2 + more_b * back_x;
    block->m[3][i] = m3 + more_b * back_y;
}

/* What comes next: AIM_ASTRAY where the step is not taken, but for rounding. */
INLINE void kernel_aim_go_on(struct aim_block *restrict block, double next, int i)
{
    double x = block->miss_x[i], y = block->miss_y[i];
    bool goes_on = next != AIM_DONE;
    block->step_a[i] = goes_on ? block->m[0][i] * x + block->m[1][i] * y : 0;
    block->step_b[i] = goes_on ? block->m[2][i] * x + block->m[3][i] * y : 0;
    block->next_a[i] = block->a[i] + block->step_a[i];
    block->next_b[i] = block->b[i] + block->step_b[i];
    block->state[i] = next;
}

/* Who is near enough makes the last step without looking where it leads. */
INLINE void arrive(struct aim_block *restrict block, int i)
{
    bool arrives = block->state[i] == AIM_LAST;
    block->a[i] = arrives ? block->next_a[i] : block->a[i];
    block->b[i] = arrives ? block->next_b[i] : block->b[i];
    block->miss_x[i] = arrives ? 0 : block->miss_x[i];
    block->miss_y[i] = arrives ? 0 : block->miss_y[i];
    block->state[i] = arrives ? AIM_DONE : block->state[i];
}

INLINE void kernel_aim_judge(const struct ray_block *restrict at, double enough2, double near2,
                             struct aim_block *restrict block, int i)
{
    double x = block->goal_x[i] - at->x[i], y = block->goal_y[i] - at->y[i];
    double old_x = block->miss_x[i], old_y = block->miss_y[i], state = block->state[i];
    double before2 = old_x * old_x + old_y * old_y, after2 = x * x + y * y;
    bool takes = (state == AIM_OPEN) & (at->lost[i] == 0) & (after2 < before2);
    kernel_aim_correct(block, takes, x, y, i);
    block->miss_x[i] = takes ? x : old_x;
    block->miss_y[i] = takes ? y : old_y;
    block->a[i] += takes ? block->step_a[i] : 0;
    block->b[i] += takes ? block->step_b[i] : 0;
    double stuck = before2 <= near2 ? AIM_DONE : AIM_ASTRAY;
    /* what the next step will leave, if it brings as much as this one */
    double going = 100 * after2 * after2 <= enough2 * before2 ? AIM_LAST : AIM_OPEN;
    double next = takes ? going : stuck;
    kernel_aim_go_on(block, state == AIM_OPEN ? next : state, i);
}

void NAME(kernel_aim, KERNEL)(const struct ray_block *restrict at_stop, double enough2,
                              double near2, struct aim_block *restrict block)
{
    const int lanes = block->lanes;
    for (int i = 0; i < LANES_OF(lanes); i++) {
        kernel_aim_judge(at_stop, enough2, near2, block, i);
    }
    for (int i = 0; i < LANES_OF(lanes); i++) {
        arrive(block, i);
    }
}
