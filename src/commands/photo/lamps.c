/* commands/photo/lamps.c - what lamps do to a photograph: their colour, their flicker. */
/* SPDX-License-Identifier: MIT */
#include "commands/photo/lamps.h"

#include "base/arena.h"
#include "base/constants.h"
#include "data/lensdb_facts.h"
#include "photo/mired.h"

static bool answer_colour(const struct lamps *lamps, double filter, struct run *run,
                          struct lamp_row *row, struct error *error)
{
    double behind = lamps->kelvin;
    if (isnan(lamps->kelvin)) {
        return isnan(lamps->balance) || fail(error, ERROR_USAGE, "{--balance} wants {--kelvin}");
    }
    if (!isnan(filter)) {
        if (!mired_filtered(lamps->kelvin, filter, &behind, error)) {
            return false;
        }
        row->filtered = behind;
    }
    if (isnan(lamps->balance)) {
        return true;
    }
    if (isnan(filter)) {
        return fail(error, ERROR_USAGE,
                    "{--filter} has a colour that is none of light: leave it out to find the "
                    "conversion filter");
    }
    return mired_shift(behind, lamps->balance, &row->wanted, error) &&
           lensdb_nearest_conversion(run->db, row->wanted, run->arena, &row->conversion,
                                     &row->conversion_shift, error);
}

/* "1/50": a number of pulses in seconds. */
static const char *time_words(double mains, long pulses, struct arena *arena)
{
    double per_second = 2 * mains;
    if (per_second != floor(per_second) || per_second > 1e6) {
        return arena_printf(arena, "%.4g", flicker_time(mains, pulses));
    }
    long below = (long)per_second, above = pulses, divisor = below, rest = above;
    while (rest > 0) { /* Euclid */
        long next = divisor % rest;
        divisor = rest;
        rest = next;
    }
    return below == divisor ? arena_printf(arena, "%ld", above / divisor)
                            : arena_printf(arena, "%ld/%ld", above / divisor, below / divisor);
}

/* The times without flicker and their angles, the first of them. */
static void lamps_list_free(const struct lamps *lamps, const struct flicker *flicker, double rate,
                            struct arena *arena, struct lamp_row *row)
{
    enum { FOR_A_PICTURE = 6, MOST = 12 };
    bool film = !isnan(rate);
    const long longest = flicker->longest < MOST ? flicker->longest : MOST;
    const long count = film ? longest : FOR_A_PICTURE;
    for (long i = 1; i <= count; i++) {
        const char *comma = i > 1 ? ", " : "";
        row->free_times = arena_printf(arena, "%s%s%s", i > 1 ? row->free_times : "", comma,
                                       time_words(lamps->mains, i, arena));
        if (film) {
            double angle = degrees_from_radians(flicker_angle(lamps->mains, rate, i));
            row->free_angles =
                arena_printf(arena, "%s%s%.5g", i > 1 ? row->free_angles : "", comma, angle);
        }
    }
}

static const char *flicker_words(const struct flicker *flicker, double rate, struct arena *arena)
{
    bool film = !isnan(rate);
    if (film && flicker->longest == 0) {
        return "cannot be avoided: a frame is shorter than a pulse of the lamps";
    }
    if (isnan(flicker->pulses)) {
        return flicker->is_steady ? "none between frames at any shutter angle" : NULL;
    }
    if (flicker->is_free) {
        return "none";
    }
    if (flicker->is_steady) {
        return "none between frames; bands with a rolling shutter";
    }
    return arena_printf(arena, "%s: %.4g pulses of the lamps",
                        film ? "visible" : "uneven, or bands", flicker->pulses);
}

static bool answer_flicker(const struct lamps *lamps, double t, double rate, struct run *run,
                           struct lamp_row *row, struct error *error)
{
    struct flicker flicker;
    if (isnan(lamps->mains)) {
        return true;
    }
    if (!flicker_check(lamps->mains, t, rate, &flicker, error)) {
        return false;
    }
    row->free_time = flicker.nearest;
    row->flicker = flicker_words(&flicker, rate, run->arena);
    lamps_list_free(lamps, &flicker, rate, run->arena, row);
    return true;
}

bool lamps_answer(const struct lamps *lamps, double filter, double t, double rate, struct run *run,
                  struct lamp_row *row, struct error *error)
{
    *row = (struct lamp_row){.kelvin = lamps->kelvin,
                             .balance = lamps->balance,
                             .shift = fabs(filter) > 0 || !isnan(lamps->kelvin) ? filter : NAN,
                             .filtered = NAN,
                             .wanted = NAN,
                             .conversion_shift = NAN,
                             .mains = lamps->mains,
                             .free_time = NAN};
    return answer_colour(lamps, filter, run, row, error) &&
           answer_flicker(lamps, t, rate, run, row, error);
}
