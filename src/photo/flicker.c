/* photo/flicker.c - exposures that lamps on the mains do not make flicker. */
/* SPDX-License-Identifier: MIT */
#include "photo/flicker.h"

#include "base/constants.h"
#include "photo/given.h"

#include <math.h>

/* Of a pulse: what an eye does not see, and how well cameras keep their frame rate. */
static const double visible = 0.01, kept = 1e-4;

double flicker_time(double mains, long pulses)
{
    return (double)pulses / (2 * mains);
}

double flicker_angle(double mains, double rate, long pulses)
{
    return 2 * PI * rate * flicker_time(mains, pulses);
}

static bool is_whole(double x, double slack)
{
    return rint(x) >= 1 && fabs(x - rint(x)) <= slack * fmin(x, 1);
}

bool flicker_check(double mains, double t, double rate, struct flicker *flicker,
                   struct error *error)
{
    const struct given numbers[] = {{"mains frequency", " Hz", mains},
                                    {"exposure time", " s", t},
                                    {"frame rate", " fps", rate}};
    const double most = 1e9; /* pulses that are counted */
    if (!given_positive(numbers, 3, error)) {
        return false;
    }
    double in_frame = 2 * mains / rate, pulses = 2 * mains * t;
    double longest = fmin(floor(in_frame * (1 + 1e-12)), most);
    double nearest = fmax(1, rint(fmin(pulses, most)));
    *flicker = (struct flicker){.longest = is_given(in_frame) ? (long)longest : 0,
                                .pulses = pulses,
                                .is_free = is_whole(pulses, visible),
                                .is_steady = is_whole(in_frame, kept),
                                .nearest = NAN};
    if (is_given(in_frame)) {
        nearest = fmin(nearest, longest);
    }
    if (is_given(pulses) && nearest >= 1) {
        flicker->nearest = flicker_time(mains, (long)nearest);
    }
    return true;
}
