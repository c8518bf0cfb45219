/* commands/camera/render_card.c - a picture or a chart, its depths, and what of it is in focus. */
/* SPDX-License-Identifier: MIT */
#include "base/choice.h"
#include "base/constants.h"
#include "commands/camera/render.h"
#include "file/depth_file.h"
#include "file/image_file.h"
#include "optics/wavelength.h"
#include "photo/distance_from.h"

#include <math.h>
#include <string.h>

bool render_card(const struct render_input *input, struct arena *arena, struct card *card,
                 struct error *error)
{
    static const char prefix[] = "chart:";
    if (strncmp(input->subject, prefix, sizeof prefix - 1) == 0) {
        struct choice choice = {.typed = text_of(input->subject + sizeof prefix - 1)};
        for (size_t i = 0; charts[i].word != NULL; i++) {
            if (text_same(choice.typed, charts[i].word)) {
                card->chart = (enum chart)(i + 1);
                return true;
            }
            choice_offer(&choice, charts[i].word);
        }
        return choice_refuse(&choice, error) || error_prefix(error, "chart ");
    }
    const struct image_wish wish = {IMAGE_LIGHT, IMAGE_SEEN_MOST};
    struct image *picture = ARENA_NEW(arena, struct image);
    card->picture = picture;
    return image_file_read(input->subject, &wish, arena, picture, error) &&
           (image_check(picture, IMAGE_POSITIVE, error) ||
            error_prefix(error, "%.200s: ", input->subject));
}

/* -------- depths -------- */

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
    /* A map of a format that does not say so has square pixels. */
    const double enough = 1e-6; /* between the digits of formats */
    if (picture == NULL) {
        return true;
    }
    const double wide = image_proportion(map), needed = image_proportion(picture);
    return fabs(wide / needed - 1) <= enough ||
           fail(error, ERROR_DATA,
                "%.200s has %zu x %zu pixels, %.6g times as wide as high, the picture %zu x %zu, "
                "%.6g times: they must have the same shape",
                input->depth_map, map->width, map->height, wide, picture->width, picture->height,
                needed);
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

/* -------- focus -------- */

bool render_autofocus_place(const char *text, double place[2], struct error *error)
{
    return (render_numbers(text, ":", false, place) && place[0] <= 1 && place[1] <= 1) ||
           fail(error, ERROR_USAGE,
                "{--autofocus} '%.40s': fractions of width and height from the upper left, 0 to 1 "
                "each, as 0.5:0.5",
                text);
}

bool render_check_autofocus(const struct render_input *input, struct error *error)
{
    double place[2];
    if (input->autofocus == NULL) {
        return true;
    }
    if (!render_autofocus_place(input->autofocus, place, error)) {
        return false;
    }
    if (!isnan(input->field_width)) {
        return fail(error, ERROR_USAGE,
                    "{--autofocus} and {--field-width} exclude each other: where the card ends is "
                    "known only when the lens is focused");
    }
    return input->depth_map == NULL || isnan(input->distance) ||
           fail(error, ERROR_USAGE,
                "{--autofocus} takes the distance from the depth map: not with {--distance}");
}

bool render_autofocus(const struct render_input *input, struct arena *arena,
                      struct render_input *focused, struct error *error)
{
    struct photograph_depths depths;
    double place[2];
    *focused = *input;
    if (input->autofocus == NULL || input->depth_map == NULL) {
        return true; /* a flat card lies as far away everywhere */
    }
    if (!render_autofocus_place(input->autofocus, place, error) ||
        !render_depths(input, NULL, arena, &depths, error)) {
        return false;
    }
    /*
     * What the depth map has there, m. A map as large as the film sees is wider than it, or higher,
     * where the shapes differ.
     */
    const struct image *map = depths.map;
    const double proportion = image_proportion(map);
    const double width = fmax(input->sensor.size.width, proportion * input->sensor.size.height);
    const double x = 0.5 + (place[0] - 0.5) * input->sensor.size.width / width;
    const double y = 0.5 + (place[1] - 0.5) * input->sensor.size.height / (width / proportion);
    const double column = fmin(floor(x * (double)map->width), (double)map->width - 1);
    const double row = fmin(floor(y * (double)map->height), (double)map->height - 1);
    const double depth = (double)image_row(map, (size_t)row)[(size_t)column * map->channels];
    focused->from = FROM_SENSOR;
    focused->distance = depth * MM_PER_M;
    return (depth > 0 && isfinite(depth)) ||
           fail(error, ERROR_DOMAIN,
                isinf(depth)
                    ? "{--autofocus} %.40s: the depth map has infinity there, and pictures "
                      "take finite distances"
                    : "{--autofocus} %.40s: the depth map has no distance there",
                input->autofocus);
}

void render_say_autofocus(const struct render_input *input, double distance,
                          struct text_buffer *remarks)
{
    if (input->autofocus != NULL && isinf(distance)) {
        growing_format(remarks, "focused on infinity: nothing lies at %s\n", input->autofocus);
    } else if (input->autofocus != NULL) {
        growing_format(remarks, "focused on %.6g mm before the first vertex, what lies at %s\n",
                       distance, input->autofocus);
    }
}

/* Cycles a mm on the film of as many over the width of the card. */
static double on_film(const struct photograph *photograph, const struct setup *setup, double cycles)
{
    return cycles / photograph->card.width / fabs(setup->first.magnification);
}

static void say_picture(const char *path, const struct image *picture, struct text_buffer *remarks)
{
    const char *remark = image_file_remark(path, picture, remarks->arena);
    if (remark != NULL) {
        growing_format(remarks, "%s\n", remark);
    }
}

void render_say_card(const struct render_input *input, const struct photograph *photograph,
                     const struct setup *setup, struct text_buffer *remarks)
{
    const struct card *card = &photograph->card;
    const double rim = 2 * PI * CHART_STAR_RADIUS * card->height / card->width;
    const double mesh = card->width / CHART_MESHES;
    switch (card->chart) {
    case CHART_EDGE:
        growing_format(remarks, "edge %g degrees from upright, contrast %g:1 (ISO 12233)\n",
                       CHART_EDGE_DEGREES, 1 / CHART_EDGE_DARK);
        break;
    case CHART_STAR:
        growing_format(remarks,
                       "%d cycles about the middle: %.4g cycles/mm on the film at the rim, twice "
                       "that at half its radius\n",
                       CHART_STAR_CYCLES, on_film(photograph, setup, CHART_STAR_CYCLES / rim));
        break;
    case CHART_BARS:
        growing_format(remarks, "bars of");
        for (int i = 0; i < CHART_GROUPS; i++) {
            growing_format(remarks, "%s %.4g", i == 0 ? "" : ",",
                           on_film(photograph, setup, ldexp(CHART_BARS_LEAST, i)));
        }
        growing_format(remarks, " cycles/mm on the film\n");
        break;
    case CHART_WEDGE:
        growing_format(remarks, "%d greys, densities 0 to %.4g\n", CHART_WEDGE_FIELDS,
                       0.5 * (CHART_WEDGE_FIELDS - 1) * log10(2));
        break;
    case CHART_GRID:
        growing_format(remarks, "meshes of %.4g mm\n", mesh);
        break;
    case CHART_CHECKER:
        growing_format(remarks, "squares of %.4g mm\n", mesh);
        break;
    case CHART_POINTS:
        growing_format(remarks, "discs, in steps of %.4g mm\n", mesh);
        break;
    case CHART_STARS:
        growing_format(remarks, "stars of magnitudes 0 to %d, the brightest as bright as white\n",
                       CHART_MAGNITUDES);
        break;
    case CHART_NONE:
        say_picture(input->subject, card->picture, remarks);
        break;
    }
}
