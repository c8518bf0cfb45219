/* photo/attach.c - tubes, close-up lenses, converters, reversed and stacked lenses. */
/* SPDX-License-Identifier: MIT */
#include "photo/attach.h"

#include "photo/given.h"

#include <math.h>

static bool add_tube(struct attach_lens *lens, const struct attach_step *step, struct error *error)
{
    double e = step->value;
    if (!check_not_negative("tube", " mm", e, error)) {
        return false;
    }
    lens->m_far += e / lens->f;
    lens->m_near += e / lens->f;
    lens->length_far += e;
    lens->length_near += e;
    return true;
}

/* Put a thin lens of focal length F `gap` before the front. */
static bool attach_put_before(struct attach_lens *lens, double F, double gap, struct error *error)
{
    if (!check_not_negative("gap", " mm", gap, error)) {
        return false;
    }
    double d = gap + lens->front;
    double ratio = 1 + (lens->f - d) / F; /* f/f' */
    double pupil = 1 - (d - lens->f * (1 - 1 / lens->P)) / F;
    if (!(pupil > 0)) { /* then f/f' is positive too: above f/(P F) */
        return fail(error, ERROR_DOMAIN,
                    "{gap} %g mm brings the focus of the front lens (%g mm) before the pupil: no "
                    "image (less than %g mm)",
                    gap, F, F - lens->front + lens->f * (1 - 1 / lens->P));
    }
    lens->m_far = lens->f / F + lens->m_far * ratio;
    lens->m_near = lens->f / F + lens->m_near * ratio;
    lens->N *= pupil / ratio;
    lens->P *= pupil;
    lens->front = d / ratio;
    lens->f /= ratio;
    lens->length_far += gap;
    lens->length_near += gap;
    return true;
}

static bool add_close_up(struct attach_lens *lens, const struct attach_step *step,
                         struct error *error)
{
    return check_positive("close-up lens", " dioptres", step->value, error) &&
           attach_put_before(lens, 1000 / step->value, step->gap, error);
}

static bool add_converter(struct attach_lens *lens, const struct attach_step *step,
                          struct error *error)
{
    double k = step->value;
    if (!check_positive("converter factor", "", k, error) ||
        !check_not_negative("length of the converter", " mm", step->gap, error)) {
        return false;
    }
    lens->front += (k - 1) * lens->f;
    lens->f *= k;
    lens->N *= k;
    lens->P *= k;
    lens->m_far *= k;
    lens->m_near *= k;
    lens->length_far += step->gap;
    lens->length_near += step->gap;
    return true;
}

static bool add_reversed(struct attach_lens *lens, const struct attach_step *step,
                         struct error *error)
{
    double v = step->value;
    if (!(v >= lens->f && isfinite(v))) {
        return fail(error, ERROR_DOMAIN,
                    "a sensor %g mm behind the reversed lens lies within its focal length: no real "
                    "image (%g mm or more)",
                    v, lens->f);
    }
    lens->N /= lens->P;
    lens->P = 1 / lens->P;
    lens->m_far = lens->m_near = (v - lens->f) / lens->f;
    lens->front = step->extra;
    lens->length_far = lens->length_near = step->extra + step->gap + v;
    return true;
}

static bool add_stacked(struct attach_lens *lens, const struct attach_step *step,
                        struct error *error)
{
    double F = step->value;
    if (!check_positive("stacked lens", " mm", F, error) ||
        !check_not_negative("f-number of the stacked lens", "", step->extra, error)) {
        return false;
    }
    lens->N = fmax(lens->N, lens->f * step->extra / F); /* the narrower beam */
    return attach_put_before(lens, F, step->gap, error);
}

/* In the order of enum attach_kind. */
static bool (*const adders[])(struct attach_lens *, const struct attach_step *, struct error *) = {
    add_tube, add_close_up, add_converter, add_reversed, add_stacked};

bool attach_bare(const struct attach_bare *bare, struct attach_lens *lens, struct error *error)
{
    if (!check_positive("focal length", " mm", bare->f, error) ||
        !check_positive("f-number", "", bare->N, error) ||
        !check_positive("pupil magnification", "", bare->P, error) ||
        !check_not_negative("magnification", "", bare->m_near, error)) {
        return false;
    }
    if (!(isfinite(bare->front) && isfinite(bare->hiatus))) {
        return fail(error, ERROR_DOMAIN,
                    "{front principal plane} %g mm and {hiatus} %g mm must be finite", bare->front,
                    bare->hiatus);
    }
    double length = bare->front + bare->hiatus + bare->f;
    *lens = (struct attach_lens){.f = bare->f,
                                 .N = bare->N,
                                 .P = bare->P,
                                 .m_near = bare->m_near,
                                 .front = bare->front,
                                 .length_far = length,
                                 .length_near = length + bare->f * bare->m_near};
    return true;
}

bool attach_apply(struct attach_lens *lens, const struct attach_step *steps, size_t count,
                  struct error *error)
{
    for (size_t i = 0; i < count; i++) {
        if (isnan(steps[i].value)) {
            continue;
        }
        if (steps[i].kind == ATTACH_REVERSED && i > 0) {
            return fail(error, ERROR_USAGE,
                        "reversing must come first: reverse the lens, then attach to it");
        }
        if (!adders[steps[i].kind](lens, &steps[i], error)) {
            return false;
        }
        if (!(isfinite(lens->f) && isfinite(lens->N) && isfinite(lens->front) &&
              isfinite(lens->length_far) && isfinite(lens->length_near))) {
            return fail(error, ERROR_DOMAIN,
                        "with what is attached the lens has lengths too large for a number");
        }
    }
    return true;
}

bool attach_focused(const struct attach_lens *lens, bool near, struct attach_focus *focus,
                    struct error *error)
{
    double m = near ? lens->m_near : lens->m_far;
    double s = lens->f * (1 + 1 / m);
    double working = s - lens->front;
    if (!(working > 0)) {
        return fail(error, ERROR_DOMAIN,
                    "at magnification %g the subject would lie %g mm inside the lens (less "
                    "magnification)",
                    m, -working);
    }
    *focus = (struct attach_focus){.m = m,
                                   .distance = s,
                                   .working_distance = working,
                                   .sensor_distance =
                                       working + (near ? lens->length_near : lens->length_far),
                                   .working_fnumber = lens->N * (1 + m / lens->P)};
    return true;
}
