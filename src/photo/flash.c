/* photo/flash.c - guide numbers, several flashes, flash against the light that is there. */
/* SPDX-License-Identifier: MIT */
#include "photo/flash.h"

#include <math.h>

#include "photo/given.h"

static bool flash_check_setting(const struct flash_setting *s, struct error *error)
{
    const struct given numbers[] = {
        {"guide number", " mm", s->GN}, {"f-number", "", s->N},
        {"distance", " mm", s->d},      {"ISO speed", "", s->S},
        {"flash power", "", s->power},  {"number of flashes", "", s->flashes}};
    if (!given_positive(numbers, 6, error)) {
        return false;
    }
    if (s->power > 1) {
        return fail(error, ERROR_DOMAIN, "{flash power} %.10g must lie above 0 and up to 1",
                    s->power);
    }
    return require_within("light loss", " stops", s->loss, 0, 100, error);
}

static void flash_assume(double *value, double usual)
{
    if (!is_given(*value)) {
        *value = usual;
    }
}

/* Of the light: as good as the same. */
static const double same_flash = 0.003;

/* By how much light a full flash at ISO 100 must be multiplied. */
static double gain(const struct flash_setting *s)
{
    return s->flashes * (s->S / 100) * s->power * exp2(-s->loss);
}

/* Do numbers of which none is missing, as in the rows of an answer, keep the equation? */
static bool is_solved(const struct flash_setting *s)
{
    const double needed = s->N * s->d / s->GN;
    return fabs(needed * needed / gain(s) - 1) <= same_flash;
}

/* Decide what is asked and fill in what may be assumed. */
static bool flash_find_unknown(struct flash_setting *s, enum flash_unknown *unknown,
                               struct error *error)
{
    int missing = !is_given(s->GN) + !is_given(s->N) + !is_given(s->d);
    if (missing > 1) {
        return fail(error, ERROR_USAGE,
                    "too little is given: of {guide number}, {f-number} and {distance} two are "
                    "needed");
    }
    if (missing == 1) {
        const enum flash_unknown other = is_given(s->N) ? FLASH_D : FLASH_N;
        *unknown = is_given(s->GN) ? other : FLASH_GN;
        flash_assume(&s->power, 1);
    } else if (!is_given(s->power)) {
        *unknown = FLASH_POWER;
    } else if (!is_given(s->S)) {
        *unknown = FLASH_S;
    } else if (!is_given(s->flashes)) {
        *unknown = FLASH_FLASHES;
    } else if (is_solved(s)) {
        *unknown = FLASH_N;
    } else {
        return fail(error, ERROR_USAGE,
                    "nothing is left to solve for: leave out one of {guide number}, {f-number}, "
                    "{distance}, {flash power}, {ISO speed} and {number of flashes}");
    }
    if (*unknown != FLASH_S) {
        flash_assume(&s->S, 100);
    }
    if (*unknown != FLASH_FLASHES) {
        flash_assume(&s->flashes, 1);
    }
    return true;
}

bool flash_solve(struct flash_setting *s, enum flash_unknown *unknown, struct error *error)
{
    flash_assume(&s->loss, 0);
    if (!flash_check_setting(s, error) || !flash_find_unknown(s, unknown, error)) {
        return false;
    }
    if (is_solved(s)) {
        return true;
    }
    double needed = s->N * s->d / s->GN; /* NaN while GN, N or d is the unknown */
    double lost = exp2(s->loss);
    switch (*unknown) {
    case FLASH_GN:
        s->GN = s->N * s->d / sqrt(gain(s));
        return answer_positive("the guide number", s->GN, error);
    case FLASH_N:
        s->N = s->GN * sqrt(gain(s)) / s->d;
        return answer_positive("the f-number", s->N, error);
    case FLASH_D:
        s->d = s->GN * sqrt(gain(s)) / s->N;
        return answer_positive("the distance", s->d, error);
    case FLASH_S:
        s->S = 100 * needed * needed * lost / (s->flashes * s->power);
        return answer_positive("the ISO speed", s->S, error);
    case FLASH_POWER:
        s->power = needed * needed * lost / (s->flashes * (s->S / 100));
        if (!(s->power <= 1)) {
            return fail(error, ERROR_DOMAIN,
                        "the flash would need %.4g times its full power: it is %.3g stops too weak",
                        s->power, log2(s->power));
        }
        return answer_positive("the power", s->power, error);
    case FLASH_FLASHES:
        break;
    }
    s->flashes = needed * needed * lost / (s->power * (s->S / 100));
    return answer_positive("the number of flashes", s->flashes, error);
}

bool flash_sum(const double *GN, int count, double *sum, struct error *error)
{
    double squares = 0;
    if (count < 1) {
        return fail(error, ERROR_USAGE, "{guide number} is missing");
    }
    for (int i = 0; i < count; i++) {
        if (!require_positive("guide number", " mm", GN[i], error)) {
            return false;
        }
        squares += GN[i] * GN[i];
    }
    *sum = sqrt(squares);
    return answer_positive("the guide number", *sum, error);
}

bool flash_zoomed(const struct flash_mark *marks, int count, double f, double *GN,
                  struct error *error)
{
    int at = 0;
    for (int i = 0; i < count; i++) {
        if (!require_positive("focal length of a mark", " mm", marks[i].f, error) ||
            !require_positive("guide number", " mm", marks[i].GN, error)) {
            return false;
        }
        if (i > 0 && !(marks[i].f > marks[i - 1].f)) {
            return fail(error, ERROR_DOMAIN, "the focal lengths of the marks must rise: %.6g, %.6g",
                        marks[i - 1].f, marks[i].f);
        }
    }
    if (count < 1 || !(f >= marks[0].f && f <= marks[count - 1].f)) {
        return fail(error, ERROR_DOMAIN, "%.6g mm lies outside the marks, %.6g to %.6g mm", f,
                    count > 0 ? marks[0].f : NAN, count > 0 ? marks[count - 1].f : NAN);
    }
    while (at + 2 < count && f > marks[at + 1].f) {
        at++;
    }
    const struct flash_mark *low = &marks[at], *high = &marks[at + 1 < count ? at + 1 : at];
    bool is_high = !(f < high->f);
    *GN = is_high ? high->GN
                  : low->GN * pow(high->GN / low->GN, log(f / low->f) / log(high->f / low->f));
    return true;
}

bool flash_bounce(double along, double flash_gap, double subject_gap, double *d,
                  struct error *error)
{
    *d = hypot(along, flash_gap + subject_gap);
    return check_not_negative("distance", " mm", along, error) &&
           require_positive("ceiling over the flash", " mm", flash_gap, error) &&
           require_positive("ceiling over the subject", " mm", subject_gap, error);
}

bool flash_falloff(double near, double far, double *stops, struct error *error)
{
    *stops = 2 * log2(far / near);
    return require_positive("nearest point", " mm", near, error) &&
           require_positive("farthest point", " mm", far, error);
}

bool lighting_ratio(double stops, double *ratio, struct error *error)
{
    *ratio = exp2(stops) + 1;
    return require_within("key to fill", " stops", stops, -100, 100, error);
}

bool lighting_stops(double ratio, double *stops, struct error *error)
{
    if (!(ratio > 1 && isfinite(ratio))) {
        return fail(error, ERROR_DOMAIN, "{lighting ratio} %.10g must be above 1 and finite",
                    ratio);
    }
    *stops = log2(ratio - 1);
    return true;
}

/* All that enters the two exposures is given and legal. */
static bool check_ambient(const struct flash_ambient *light, struct error *error)
{
    const struct flash_setting *s = &light->flash;
    return flash_check_setting(s, error) && require_positive("guide number", " mm", s->GN, error) &&
           require_positive("f-number", "", s->N, error) &&
           require_positive("distance", " mm", s->d, error) &&
           require_positive("ISO speed", "", s->S, error) &&
           require_positive("flash power", "", s->power, error) &&
           require_positive("number of flashes", "", s->flashes, error) &&
           require_positive("exposure time", " s", light->t, error) &&
           require_within("exposure value at ISO 100", "", light->ev100, -100, 100, error);
}

static bool check_sync(double t, double sync, struct error *error)
{
    return !is_given(sync) ||
           (require_positive("flash sync time", " s", sync, error) &&
            (t >= sync ||
             fail(error, ERROR_DOMAIN,
                  "{exposure time} %.6g s is shorter than {the flash sync time} %.6g s", t, sync)));
}

bool flash_against_ambient(const struct flash_ambient *light, struct flash_balance *balance,
                           struct error *error)
{
    struct flash_ambient given = *light;
    struct flash_setting *s = &given.flash;
    flash_assume(&s->loss, 0);
    if (!check_ambient(&given, error) || !check_sync(given.t, given.sync, error)) {
        return false;
    }
    double flash = 2 * log2(s->GN / (s->N * s->d)) + log2(gain(s));
    double ambient = given.ev100 + log2(s->S / 100) - log2(s->N * s->N / given.t);
    *balance = (struct flash_balance){.flash = flash,
                                      .ambient = ambient,
                                      .flash_to_ambient = flash - ambient,
                                      .ratio = exp2(flash - ambient) + 1,
                                      /* the brighter light plus what the other adds: no overflow */
                                      .total = fmax(flash, ambient) +
                                               log2(1 + exp2(-fabs(flash - ambient)))};
    return answer_positive("the lighting ratio", balance->ratio, error);
}
