/* commands/photo/crop.c - a part of the sensor, by its crop factor. */
/* SPDX-License-Identifier: MIT */
#include "commands/photo/crop.h"

#include <math.h>
#include <string.h>

bool crop_sensor(const struct sensor_value *whole, double crop, struct arena *arena,
                 struct sensor_value *part, struct error *error)
{
    *part = *whole;
    if (isnan(crop)) {
        return true;
    }
    if (crop < 1 && !whole->is_fallback) {
        return fail(error, ERROR_DOMAIN,
                    "{--crop} %.6g is below 1: there is no more than the whole of {--sensor} %s",
                    crop, whole->name);
    }
    part->size.width /= crop;
    part->size.height /= crop;
    /* the size first, so that it reads back as one */
    const size_t name = strcspn(whole->name, "(");
    part->name = arena_printf(arena, "%.6g x %.6g mm (%.*s%scropped %.6gx)", part->size.width,
                              part->size.height, (int)name, whole->name,
                              whole->name[name] == '\0' ? " " : "", crop);
    return true;
}
