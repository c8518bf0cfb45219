/* exchange/codev/codev_system.h - what a CODE V file says of the whole lens. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_CODEV_CODEV_SYSTEM_H
#define LENSCALC_EXCHANGE_CODEV_CODEV_SYSTEM_H

#include "exchange/codev/codev.h"

/* NA, beside the kinds of aperture that codev_aperture_of_lens knows by their numbers. */
enum { CODEV_IMAGE_NA = -1 };

codev_command codev_title;
codev_command codev_radius_mode; /* RDM */
codev_command codev_unit;        /* DIM */
codev_command codev_waves;       /* WL WTW */
codev_command codev_reference;   /* REF */
codev_command codev_aperture_of_lens;
codev_command codev_fields;

/* Does this word only matter to displays, tolerances or optimisers? */
bool codev_is_harmless(struct text word);

/* Wavelengths and fields, when all of the file is read. */
bool codev_finish_system(struct codev *codev);

#endif
