/* commands/photo/sharpness.c - the options that say how sharp is sharp. */
/* SPDX-License-Identifier: MIT */
#include "commands/photo/sharpness.h"

/* What an option is where only others of its kind are given. */
static double given_or(double value, double usual)
{
    return isnan(value) ? usual : value;
}

bool sharpness_settle(struct sharpness *a, enum pitch_use use, struct warnings *doubts,
                      struct error *error)
{
    bool is_print = !isnan(a->print.longer) || !isnan(a->viewing) || !isnan(a->acuity),
         is_pitch = !isnan(a->pitch) && use == PITCH_FOR_COC;
    if (coc_is_print(&a->coc) && a->print.criterion != NULL) {
        a->coc.criterion = a->print.criterion;
    }
    if (is_print && is_pitch && a->coc.is_fallback) {
        fail(error, ERROR_USAGE, "{--pitch} and {--print} are two criteria of sharpness");
        return error_hint(error, "{--coc} print or {--coc} 2px says which counts");
    }
    if (is_print && a->coc.is_fallback) {
        const char *print = a->print.criterion != NULL ? a->print.criterion : "print";
        a->coc = (struct coc_value){{.kind = COC_PRINT, .value = 1}, print, false};
    } else if (is_pitch && a->coc.is_fallback) {
        a->coc = (struct coc_value){{.kind = COC_PIXELS, .value = 2}, "2px", false};
    }
    if (use == PITCH_FOR_MORE || coc_is_pixels(&a->coc)) {
        sharpness_doubt_pitch(a, doubts);
    }
    return true;
}

bool sharpness_resolve_in(const struct sharpness *a, double wavelength, double fnumber, double *c,
                          struct error *error)
{
    if (a->coc.coc.kind == COC_LENGTH) {
        *c = a->coc.coc.value;
        return true;
    }
    if (a->coc.coc.kind == COC_AIRY && isnan(fnumber)) {
        return fail(error, ERROR_USAGE, "{--coc} airy needs {--aperture}");
    }
    struct sensor sensor = a->sensor.size;
    sensor.pitch = sharpness_pitch(a);
    if ((!isnan(a->viewing) && !isnan(a->print.viewing)) ||
        (!isnan(a->acuity) && !isnan(a->print.acuity))) {
        return fail(error, ERROR_USAGE, "{--print} gives {--%s} already",
                    isnan(a->print.viewing) || isnan(a->viewing) ? "acuity" : "viewing");
    }
    const struct coc coc = {.kind = a->coc.coc.kind,
                            .value = a->coc.coc.value,
                            .viewing = given_or(given_or(a->viewing, a->print.viewing), 250),
                            .acuity = given_or(given_or(a->acuity, a->print.acuity), 5),
                            .print = given_or(a->print.longer, 254),
                            .print_short = given_or(a->print.shorter, 0),
                            .wavelength = wavelength,
                            .fnumber = fnumber};
    return coc_resolve(&coc, &sensor, c, error);
}

bool sharpness_resolve(const struct sharpness *a, double fnumber, double *c, struct error *error)
{
    return sharpness_resolve_in(a, a->wavelength, fnumber, c, error);
}

double sharpness_pitch(const struct sharpness *a)
{
    return isnan(a->pitch) ? a->sensor.size.pitch : a->pitch;
}

void sharpness_doubt_pitch(const struct sharpness *a, struct warnings *doubts)
{
    if (isnan(a->pitch) && !isnan(a->sensor.size.pitch) && a->sensor.pitch_note != NULL) {
        warnings_add(doubts, "the pixel pitch of %s, %.4g um, is %s", a->sensor.name,
                     1000 * a->sensor.size.pitch, a->sensor.pitch_note);
    }
}

bool coc_is_pixels(const struct coc_value *coc)
{
    return coc->coc.kind == COC_PIXELS;
}

bool coc_is_print(const struct coc_value *coc)
{
    return coc->coc.kind == COC_PRINT;
}
