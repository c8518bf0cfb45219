/* cli/sharpness.c - the options that say how sharp is sharp. */
/* SPDX-License-Identifier: MIT */
#include "commands/photo/sharpness.h"

bool sharpness_resolve_in(const struct sharpness *a, double wavelength, double fnumber, double *c,
                          struct error *error)
{
    if (a->coc.coc.kind == COC_LENGTH) {
        *c = a->coc.coc.value;
        return true;
    }
    if (a->coc.coc.kind == COC_AIRY && isnan(fnumber)) {
        return fail(error, ERROR_USAGE, "--coc airy needs --aperture");
    }
    struct coc coc = a->coc.coc;
    struct sensor sensor = a->sensor.size;
    sensor.pitch = isnan(a->pitch) ? sensor.pitch : a->pitch;
    coc.print = a->print;
    coc.viewing = a->viewing;
    coc.acuity = a->acuity;
    coc.wavelength = wavelength;
    coc.fnumber = fnumber;
    return coc_resolve(&coc, &sensor, c, error);
}

bool sharpness_resolve(const struct sharpness *a, double fnumber, double *c, struct error *error)
{
    return sharpness_resolve_in(a, a->wavelength, fnumber, c, error);
}
