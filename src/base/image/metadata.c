/* base/image/metadata.c - what a file says of how its photograph was taken. */
/* SPDX-License-Identifier: MIT */
#include "base/image/metadata.h"

#include <math.h>
#include <string.h>

void metadata_clear(struct metadata *metadata)
{
    *metadata = (struct metadata){.focal = NAN,
                                  .equivalent = NAN,
                                  .fnumber = NAN,
                                  .time = NAN,
                                  .iso = NAN,
                                  .distance = NAN,
                                  .long_side = NAN,
                                  .low_side = NAN};
}

bool metadata_is_empty(const struct metadata *metadata)
{
    return metadata->make[0] == '\0' && metadata->model[0] == '\0' && isnan(metadata->focal) &&
           isnan(metadata->equivalent) && isnan(metadata->fnumber) && isnan(metadata->time) &&
           isnan(metadata->iso) && isnan(metadata->distance);
}

void metadata_name(char kept[METADATA_NAME], struct text name)
{
    const char *const end = memchr(name.start, '\0', name.length);
    name = text_trim(end != NULL ? text_between(name.start, end) : name);
    size_t used = 0;
    for (; used < name.length && used + 1 < METADATA_NAME; used++) {
        const char c = name.start[used];
        kept[used] = c;
        if (c < ' ' || c > '~') {
            kept[used] = '?';
        }
    }
    kept[used] = '\0';
}

void metadata_size(struct metadata *metadata, double width, double height)
{
    if (width > 0 && height > 0 && isfinite(width) && isfinite(height)) {
        metadata->long_side = fmax(width, height);
        metadata->low_side = fmin(width, height);
    }
}
