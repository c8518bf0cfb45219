/* scene/spectra.h - the spectra of a scene as numbers in bands, each different one summed once. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_SCENE_SPECTRA_H
#define LENSCALC_SCENE_SPECTRA_H

#include "base/arena.h"
#include "base/error.h"
#include "base/name_table.h"
#include "light/bands.h"
#include "scene/scene.h"

#include <stddef.h>

/* A spectrum in bands. */
struct banded {
    double of[BANDS_MOST]; /* of light of luminance 1 cd/m^2; of a surface its shares */
    double held;           /* how much of its colour that is, 0 to 1 */
    double off;            /* of light in many bands: bands_off; else 0 */
};

/* Whatever of a scene has one of these spectra shares its numbers. Start with bands and arena. */
struct spectra {
    const struct bands *bands;
    struct arena *arena;
    struct name_table index; /* by what tells spectra apart */
    const struct banded **list;
    size_t room;
};

/*
 * Given     place  where it is written
 * Result    null: the error
 * Errors    of bands_of_light and bands_of_surface, with the place
 */
const struct banded *spectra_light(struct spectra *spectra, const struct spectrum *light,
                                   const struct typed_place *place, struct error *error);
const struct banded *spectra_surface(struct spectra *spectra, const struct spectrum *surface,
                                     const struct typed_place *place, struct error *error);

#endif
