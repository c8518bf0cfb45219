/* trace/rigid.c - surfaces and axes that shift and turn a little. */
/* SPDX-License-Identifier: MIT */
#include "trace/rigid.h"

#include "trace/frames.h"
#include "trace/kernel/step.h"

#include <math.h>

/* The shift, or the axis of the tilt, number 0 .. 4 of a displacement; null = centred. */
static struct rigid rigid_motion_of(const struct displacement *displacement, int number, double t)
{
    struct rigid motion = {.sign = 1, .at = {0, 0, t}};
    double ax = 0;
    struct surface_frame frame = {.turn = {1, 0, 0, 0, 1, 0, 0, 0, 1}};
    if (displacement != NULL) {
        frame = frame_of(displacement, t);
        ax = displacement->tilt[0].value.hi;
        motion.at[0] = frame.shift[0];
        motion.at[1] = frame.shift[1];
    }
    if (number < 2) {
        motion.shift[number] = 1;
    } else if (number == 2) {
        motion.axis[0] = 1;
    } else if (number == 3) {
        motion.axis[1] = cos(ax);
        motion.axis[2] = sin(ax);
    } else {
        for (int i = 0; i < 3; i++) {
            motion.axis[i] = frame.turn[6 + i];
        }
    }
    return motion;
}

static bool parameter_is_own(enum parameter_kind kind)
{
    return kind >= PARAMETER_DECENTER_X && kind <= PARAMETER_TILT_Z;
}

/* The step that the surface by itself begins with, and the one after its last. */
static size_t own_step(const struct system *system, size_t surface, size_t *end)
{
    *end = system->begin[system_place(system, surface) + 1];
    return *end - (system->lens->surfaces[surface].decentre != NULL ? 3 : 1);
}

bool rigid_before(const struct system *system, enum parameter_kind kind, size_t surface,
                  size_t step, struct rigid *motion)
{
    if (kind >= PARAMETER_BREAK_DECENTER_X) {
        const int number = (int)(kind - PARAMETER_BREAK_DECENTER_X);
        const struct surface *surfaces = system->lens->surfaces;
        const struct displacement *coordinate_break = surfaces[surface].coordinate_break;
        size_t place = system_place(system, surface);
        double t = surface > 0 ? surfaces[surface - 1].thickness.value.hi : 0;
        if (!system->options.reverse) {
            *motion = rigid_motion_of(coordinate_break, number, t);
            motion->sign = -1;
            return step == system->begin[place];
        }
        /* light leaves what stands behind the break */
        *motion = rigid_motion_of(coordinate_break, number, 0);
        /* into the frame of the coordinate break, about its origin */
        struct rigid old = *motion;
        motion->at[0] = motion->at[1] = motion->at[2] = 0;
        if (coordinate_break != NULL) {
            struct surface_frame frame = frame_of(coordinate_break, 0);
            for (int i = 0; i < 3; i++) {
                const double *row = &frame.turn[(ptrdiff_t)3 * i];
                motion->shift[i] =
                    row[0] * old.shift[0] + row[1] * old.shift[1] + row[2] * old.shift[2];
                motion->axis[i] =
                    row[0] * old.axis[0] + row[1] * old.axis[1] + row[2] * old.axis[2];
            }
        }
        return surface > 0 && step == system->begin[place + 1];
    }
    size_t end;
    if (!parameter_is_own(kind) || step != own_step(system, surface, &end)) {
        return false;
    }
    const struct step *s = &system->steps[step];
    *motion = rigid_motion_of(system->lens->surfaces[surface].decentre,
                              (int)(kind - PARAMETER_DECENTER_X),
                              s->kind == STEP_MOVE ? s->shift[2] : s->t);
    motion->sign = -1;
    return true;
}

bool rigid_behind(const struct system *system, enum parameter_kind kind, size_t surface,
                  size_t step, struct rigid *motion)
{
    size_t end;
    if (!parameter_is_own(kind) || (own_step(system, surface, &end), step + 1 != end)) {
        return false;
    }
    *motion = rigid_motion_of(system->lens->surfaces[surface].decentre,
                              (int)(kind - PARAMETER_DECENTER_X), 0);
    return true;
}
