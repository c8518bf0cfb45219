/* file/depth_file.h - depth maps: how far away each pixel of a picture is. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_FILE_DEPTH_FILE_H
#define LENSCALC_FILE_DEPTH_FILE_H

#include "base/image/image.h"

/* What a map of whole numbers stands for, m; NaN: nothing is known. */
struct depth_range {
    double near, far; /* far may be infinite */
};

/*
 * Read a depth map.
 *
 * Given     path   PFM or OpenEXR in m, or PNG; one channel, one called Z, or three alike
 *           range  of a PNG, NaN for the others
 * Result    one channel, m; nothing is promised of its numbers
 * Formula   of a PNG 1/depth = 1/far + v (1/near - 1/far), v from 0, black, to 1, white
 * Errors    as image_file_read; ERROR_DATA: another format, channels that differ; ERROR_USAGE: a
 *           PNG without its range, or a range of another format
 */
bool depth_file_read(const char *path, const struct depth_range *range, struct arena *arena,
                     struct image *map, struct error *error);

#endif
