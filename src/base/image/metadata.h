/* base/image/metadata.h - what a file says of how its photograph was taken. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_IMAGE_METADATA_H
#define LENSCALC_BASE_IMAGE_METADATA_H

#include "base/text.h"

#include <stdbool.h>

enum { METADATA_NAME = 64 };

/* Numbers are NaN where the file does not say; else above 0, and finite but for the distance. */
struct metadata {
    char make[METADATA_NAME], model[METADATA_NAME]; /* of the camera; "" = unknown */
    double focal;                                   /* focal length, mm */
    double equivalent;                              /* of the same field on 35 mm film, mm */
    double fnumber;
    double time;                /* of the exposure, s */
    double iso;                 /* speed */
    double distance;            /* of the subject, mm; may be infinite */
    double long_side, low_side; /* pixels of the picture */
};

/* A file that says nothing yet. */
void metadata_clear(struct metadata *metadata);

/* Does the file say nothing of what is asked? */
bool metadata_is_empty(const struct metadata *metadata);

/* Keep a name of the camera: printable characters of ASCII, all others '?', without blanks. */
void metadata_name(char kept[METADATA_NAME], struct text name);

/* The longer side of a picture first, both above 0; else nothing is known. */
void metadata_size(struct metadata *metadata, double width, double height);

#endif
