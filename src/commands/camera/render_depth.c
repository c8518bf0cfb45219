/* commands/camera/render_depth.c - a picture's depths: read, and what they do not show. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "commands/camera/render.h"
#include "file/depth_file.h"
#include "optics/wavelength.h"

#include <math.h>

const struct word render_hidden[] = {
    {"nearby", "what lies next to the edge, as far away as that: a guess"},
    {"black", "nothing: it is not known"},
    {NULL, NULL},
};

bool render_check_depths(const struct render_input *input, struct error *error)
{
    const struct interval_value *depth = &input->depth;
    if (isnan(depth->low) != isnan(depth->high) || (!isnan(depth->low) && !(depth->low > 0))) {
        return fail(error, ERROR_USAGE,
                    "{--depth} NEAR..FAR: two distances above 0, as 0.5m..20m or 1m..inf");
    }
    return true;
}

/* A map of a format that does not say so has square pixels. */
static bool check_shape(const char *name, const struct image *map, const struct image *picture,
                        struct error *error)
{
    const double enough = 1e-6; /* between the digits of formats */
    if (picture == NULL) {
        return true;
    }
    const double wide = image_proportion(map), needed = image_proportion(picture);
    return fabs(wide / needed - 1) <= enough ||
           fail(error, ERROR_DATA,
                "%.200s has %zu x %zu pixels, %.6g times as wide as high, the picture %zu x %zu, "
                "%.6g times: they must have the same shape",
                name, map->width, map->height, wide, picture->width, picture->height, needed);
}

bool render_depths(const struct render_input *input, const struct image *picture,
                   struct arena *arena, struct photograph_depths *depths, struct error *error)
{
    const struct depth_range range = {input->depth.low / MM_PER_M, input->depth.high / MM_PER_M};
    *depths = (struct photograph_depths){.hidden = (enum depth_card_hidden)input->hidden};
    if (input->depth_map == NULL) {
        return true;
    }
    struct image *map = ARENA_NEW(arena, struct image);
    depths->map = map;
    depths->name = input->depth_map;
    if (!depth_file_read(input->depth_map, &range, arena, map, error)) {
        return false;
    }
    return check_shape(input->depth_map, map, picture, error);
}

void render_say_depths(const struct render_input *input, const struct photograph *photograph,
                       struct text_buffer *remarks)
{
    static const char *const seen[] = {"what lies next to it", "black"};
    const double behind = 100 * photograph_share(photograph, SIGHT_BEHIND);
    const double beside = 100 * photograph_share(photograph, SIGHT_BESIDE);
    if (input->depth_map == NULL) {
        return;
    }
    growing_format(remarks,
                   "depths seen from the entrance pupil; what stands before the frame or behind "
                   "edges is missing\n");
    if (!isnan(input->depth.low)) {
        growing_format(remarks, "white is %.6g m from the sensor, black %.6g m\n",
                       input->depth.low / MM_PER_M, input->depth.high / MM_PER_M);
    }
    if (behind > 0 || beside > 0) {
        growing_format(remarks,
                       "%.2g %% of the rays pass behind an edge of the depth map, %.2g %% beside "
                       "it: they see %s\n",
                       behind, beside, seen[input->hidden]);
    }
}
