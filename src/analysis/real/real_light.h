/* analysis/real/real_light.h - how much light a lens brings to the middle of its film. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_REAL_REAL_LIGHT_H
#define LENSCALC_ANALYSIS_REAL_REAL_LIGHT_H

#include "analysis/setup/setup_question.h"
#include "base/arena.h"
#include "base/error.h"

#include <stdbool.h>

struct real_light_question {
    struct setup_question lens; /* its object is not used; wavelengths count by their weights */
    double object;              /* before the first vertex, mm; may be infinite */
    double film;                /* behind the last vertex, mm */
    bool uncoated;              /* faces reflect */
};

struct real_light {
    double irradiance;    /* per radiance of the subject, sr, without losses in glass */
    double transmittance; /* of its faces; 1 where these are not asked for */
    double t_stop;        /* of both: as bright as a lens of this f-number without any loss */
};

/*
 * Light on the axis.
 *
 * Formula   E/L by analysis/rays/illumination.h; T = sqrt(pi/(4 tau E/L)), since E = pi L/(4 T^2)
 * of a
 *           subject far away
 * Source    [IsoAperture08]
 * Errors    as setup_open, relative_illumination_open
 */
bool real_light_find(const struct real_light_question *question, struct arena *arena,
                     struct real_light *light, struct error *error);

#endif
