/* exchange/zemax/zemax_break.c - coordinate breaks of .zmx files, and SCBD. */
/* SPDX-License-Identifier: MIT */
#include "exchange/zemax/zemax.h"

#include "base/constants.h"

/* Shifts along x, y and turns about x, y, z: 1 to 5, as the parameters of COORDBRK. */
struct break_motion {
    struct figure part[6];
    bool reversed; /* turned about z, y, x, then shifted */
};

struct medium zemax_medium_before(const struct lens *lens)
{
    return lens->surface_count > 0 ? lens->surfaces[lens->surface_count - 1].medium
                                   : lens->object_medium;
}

void zemax_add_plane(struct zemax_file *file)
{
    const struct medium before = zemax_medium_before(file->build.lens);
    struct surface *to = lens_build_surface(&file->build);
    to->medium = before;
    to->coordinate_break = file->coordinate_break;
    file->coordinate_break = NULL;
}

void zemax_hold_break(struct zemax_file *file, const struct displacement *coordinate_break)
{
    if (file->coordinate_break != NULL) {
        zemax_add_plane(file);
    }
    file->coordinate_break = coordinate_break;
}

bool zemax_is_bare(const struct zemax_file *file, size_t at)
{
    const struct zemax_surface *surface = &file->surfaces[at];
    bool still = surface->thickness == NULL ||
                 (!surface->thickness->infinite && zemax_number(surface->thickness, 0) == 0);
    bool last = at + 2 >= file->surface_count;
    return still && !last && surface->solve == NULL && !surface->is_stop &&
           surface->shift_behind == NULL && file->configurations < 2 &&
           surface->comment.length == 0;
}

static bool is_motion_none(const struct break_motion *turning)
{
    bool null = true;
    for (size_t i = 1; i <= 5; i++) {
        null = null && turning->part[i].value.hi == 0;
    }
    return null;
}

static void add_turning(struct zemax_file *file, const struct break_motion *turning)
{
    static const int parts[2][4] = {{1, 3, 4, 5}, {5, 4, 3, 1}};
    struct arena *arena = file->job->arena;
    const char *unit = file->build.lens->unit;
    struct displacement *coordinate_break = NULL;
    if (is_motion_none(turning)) {
        return;
    }
    for (int i = 0; i < 4; i++) {
        int part = parts[turning->reversed][i];
        bool shift = part == 1;
        struct figure one = turning->part[part], two = turning->part[2];
        if (one.value.hi == 0 && !(shift && two.value.hi != 0) &&
            !(i == 3 && coordinate_break == NULL)) {
            continue;
        }
        if (coordinate_break == NULL || turning->reversed) {
            coordinate_break = ARENA_NEW(arena, struct displacement);
            for (int k = 0; k < 3; k++) {
                coordinate_break->tilt[k] = coordinate_break->decenter[k % 2] = figure_of(0, arena);
            }
            zemax_hold_break(file, coordinate_break);
        }
        if (shift) {
            coordinate_break->decenter[0] = figure_per_length(one, unit, 1);
            coordinate_break->decenter[1] = figure_per_length(two, unit, 1);
        } else {
            coordinate_break->tilt[part - 3] = one;
            coordinate_break->tilt[part - 3].value =
                pair_multiply(one.value, pair_of(RADIANS_PER_DEGREE));
        }
    }
}

void zemax_add_break(struct zemax_file *file, size_t at)
{
    struct break_motion turning = {.reversed = zemax_parameter(file, at, 6).value.hi != 0};
    for (size_t i = 1; i <= 5; i++) {
        turning.part[i] = zemax_parameter(file, at, i);
    }
    add_turning(file, &turning);
}

/* SCBD 1 order status dx dy tx ty tz; none is none. */
static struct break_motion turning_of(const struct zemax_line *line)
{
    struct break_motion turning = {.reversed = zemax_number(line, 1) != 0};
    for (size_t i = 1; i <= 5; i++) {
        bool has = line != NULL && i + 2 < line->count;
        turning.part[i] = has ? line->numbers[i + 2] : figure_zero();
    }
    return turning;
}

void zemax_add_shift(struct zemax_file *file, size_t at, bool behind)
{
    enum { OWN, AS_BEFORE, AS_BEFORE_UNDONE };
    struct zemax_surface *surface = &file->surfaces[at];
    const struct zemax_line *before = surface->shift_before, *line = surface->shift_behind;
    if (!behind) {
        struct break_motion turning = turning_of(before);
        add_turning(file, &turning);
        return;
    }
    const double status = zemax_number(line, 2);
    struct break_motion turning = turning_of(NULL);
    if (status == OWN) {
        turning = turning_of(line);
    } else if (status == AS_BEFORE) {
        turning = turning_of(before);
    } else if (status == AS_BEFORE_UNDONE) {
        turning = turning_of(before); /* what leads back to where the axis was */
        turning.reversed = !turning.reversed;
        for (size_t i = 1; i <= 5; i++) {
            turning.part[i] = figure_negate(turning.part[i], file->job->arena);
        }
    } else {
        zemax_loss(file, line, LOSS_OF_RAYS, NULL,
                   "SCBD: a shift or turn behind a surface that follows another surface");
    }
    const size_t count = file->build.lens->surface_count;
    if (!is_motion_none(&turning) || (line != NULL && file->configurations > 1)) {
        add_turning(file, &turning);
        zemax_add_plane(file);
    }
    surface->planes_behind = file->build.lens->surface_count - count;
}
