/* commands/photo/attachments.c - what is put on the lens of a photographic command. */
/* SPDX-License-Identifier: MIT */
#include "commands/photo/attachments.h"

#include "photo/attach.h"

bool attachments_combine(const struct attachments *a, const struct photo_lens *lens,
                         struct photo_lens *room, struct attached_lens *attached,
                         struct error *error)
{
    const struct distance_reference *bare = &lens->measuring;
    bool has_front = !isnan(bare->front);
    const struct attach_bare sold = {.f = lens->f,
                                     .N = 1,
                                     .P = lens->P,
                                     .front = has_front ? bare->front : 0,
                                     .hiatus = bare->hiatus};
    const struct attach_step steps[] = {{ATTACH_CLOSE_UP, 1000 * a->close_up, 0, 0},
                                        {ATTACH_TUBE, a->tube, 0, 0},
                                        {ATTACH_CONVERTER, a->converter, 0, 0}};
    struct attach_lens all;
    if (isnan(lens->f)) {
        return fail(error, ERROR_USAGE,
                    "{--%s} needs {--focal-length} or {--lens}: it is added to a known lens",
                    SAID_FIRST({!isnan(a->close_up), "close-up"}, {!isnan(a->tube), "tube"},
                               {true, "converter"}));
    }
    if (!isnan(a->converter) && lens->measuring.from == FROM_SENSOR) {
        return fail(
            error, ERROR_USAGE,
            "{--from} sensor works without {--converter}: how far it moves the sensor from the "
            "lens is not known");
    }
    if (!attach_bare(&sold, &all, error) ||
        !attach_apply(&all, steps, sizeof steps / sizeof steps[0], error)) {
        return false;
    }
    *room = *lens;
    room->f = all.f;
    room->N = lens->N * all.N;
    room->P = all.P;
    room->measuring.front = has_front ? all.front : (double)NAN;
    if (!isnan(a->converter)) {
        room->measuring.hiatus = NAN;
    } else if (has_front) { /* all of it moves as a whole; in a thin lens no plane moves */
        room->measuring.hiatus = all.length_far - all.front - all.f * (1 + all.m_far);
    }
    *attached = (struct attached_lens){
        room, lens->f, all.N, all.m_far > 0 ? all.f * (1 + 1 / all.m_far) : (double)INFINITY};
    return true;
}

bool attached_check_reach(const struct attached_lens *attached, double s, struct error *error)
{
    const double rounding = 1e-12;
    return s <= attached->farthest * (1 + rounding) ||
           fail(error, ERROR_DOMAIN,
                "{distance} %.6g mm from the principal plane is out of reach with what is attached "
                "to the lens: %.6g mm at most, with the lens itself focused at infinity",
                s, attached->farthest);
}
