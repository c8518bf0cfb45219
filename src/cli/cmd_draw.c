/* cli/cmd_draw.c - lenscalc draw: cross-section of a lens as SVG. */
/* SPDX-License-Identifier: MIT */
#include "commands/lens/lens_options.h"
#include "cli/picture.h"

struct input {
    struct lens_question question;
    bool planes, construction, no_rays;
    const char *title;
};

static const struct option options[] = {
    LENS_OPTION(struct input, question),
    LENS_WAVELENGTH_OPTION(struct input, question, LENS_PRIMARY_WAVELENGTH),
    LENS_FNUMBER_OPTION(struct input, question),
    LENS_FIELD_OPTION(struct input, question),
    LENS_POSITION_OPTION(struct input, question),
    LENS_SECTION_OPTION(struct input, question),
    {OPTION(struct input, planes), .name = "planes",
     .help = "principal planes, focal points and pupils"},
    {OPTION(struct input, construction), .name = "construction",
     .help = "the three Gauss rays of the equivalent lens in place of the bundles"},
    {OPTION(struct input, no_rays), .name = "no-rays", .help = "the lens alone"},
    {OPTION(struct input, title), .name = "title", .value = "TEXT",
     .help = "title in place of the lens's own"},
};

/* What draws, and where the drawing goes. */
struct drawer {
    const struct input *input;
    struct svg svg;
};

static struct paraxial_ray *follow(const struct lens_case *one, double y, double v,
                                   struct arena *arena)
{
    struct paraxial_ray *rays = ARENA_ARRAY(arena, one->system.count, struct paraxial_ray);
    paraxial_follow(&one->system, pair_of(y), pair_of(v), rays);
    return rays;
}

/* The image plane, where it lies behind the lens and not too far; else it is only noted. */
static void find_image(struct picture *picture)
{
    const struct lens *lens = picture->one->lens;
    const struct surface *last = &lens->surfaces[lens->surface_count - 1];
    double best = lens->focus == FOCUS_BEST ? picture_focus(picture) : (double)NAN;
    bool table = (lens->focus == FOCUS_TABLE || !picture->is_centred) && last->has_thickness;
    double distance = table         ? last->thickness.value.hi
                      : isnan(best) ? picture->one->first.image
                                    : best;
    double reach = 8 * (picture->right - picture->left + 2 * picture->size);
    picture->image = NAN;
    if (distance * picture->heading >= 0 && fabs(distance) <= reach) {
        picture->image = picture_rear(picture) + distance;
    } else if (isfinite(distance)) {
        picture_note(picture,
                     arena_printf(picture->arena, "the image is not shown: it lies %.5g mm %s",
                                  fabs(distance),
                                  distance * picture->heading > 0
                                      ? "behind the last vertex"
                                      : "before the last vertex (virtual)"));
    } else {
        picture_note(picture, "the image is at infinity");
    }
}

/* As high as the rays that arrive there, across the axis behind the last surface. */
static void add_image(struct picture *picture)
{
    size_t last = picture->one->lens->surface_count - 1;
    const struct picture_frame *axis = &picture->axis[last];
    double along = picture->image - picture->vertex[last], half = 0.2 * picture->size;
    double ahead = cos(axis->angle), aside = sin(axis->angle);
    double z = axis->z + along * ahead, y = axis->y + along * aside;
    if (!isfinite(picture->image)) {
        return;
    }
    for (size_t i = 0; i < picture->part_count; i++) {
        const struct section_part *part = &picture->parts[i];
        if (part->kind == SECTION_OBLIQUE || part->kind == SECTION_CHIEF ||
            part->kind == SECTION_AXIAL) {
            size_t end = part->count - 1;
            half = fmax(half, 1.1 * fabs((part->y[end] - y) * ahead - (part->z[end] - z) * aside));
        }
    }
    picture_line(picture, SECTION_IMAGE, z + half * aside, y - half * ahead, z - half * aside,
                 y + half * ahead, "image");
}

/* From vertex to vertex where the axis bends, and a little farther at both ends. */
static void add_bent_axis(struct picture *picture)
{
    const struct lens *lens = picture->one->lens;
    const size_t count = lens->surface_count;
    double *z, *y, more = 0.6 * picture->size;
    picture_part(picture, SECTION_AXIS, count + 2, &z, &y);
    z[0] = -more;
    y[0] = 0;
    for (size_t i = 0; i < count; i++) {
        z[i + 1] = picture->axis[i].z;
        y[i + 1] = picture->axis[i].y;
    }
    const struct surface *last = &lens->surfaces[count - 1];
    double t = last->has_thickness ? last->thickness.value.hi : more * picture->heading;
    double angle = picture->axis[count - 1].angle;
    z[count + 1] = z[count] + t * cos(angle);
    y[count + 1] = y[count] + t * sin(angle);
}

/* Through everything that is drawn, and a little farther. */
static void add_axis(struct picture *picture)
{
    double left = picture->left, right = picture->right;
    for (size_t i = 0; i < picture->part_count; i++) {
        const struct section_part *part = &picture->parts[i];
        for (size_t k = 0; k < part->count; k++) {
            left = fmin(left, part->z[k]);
            right = fmax(right, part->z[k]);
        }
    }
    double more = 0.02 * (right - left) + 0.05 * picture->size;
    picture_line(picture, SECTION_AXIS, left - more, 0, right + more, 0, NULL);
}

static const char *subtitle_of(const struct lens_case *one, struct arena *arena)
{
    const struct first_order *first = &one->first;
    const char *focal =
        first->is_afocal ? "afocal" : arena_printf(arena, "f = %.5g mm", first->efl);
    const char *speed =
        isfinite(first->fnumber) ? arena_printf(arena, ", f/%.3g", first->fnumber) : "";
    const char *position =
        one->position != NULL ? arena_printf(arena, ", position %s", one->position) : "";
    return arena_printf(arena, "%s%s%s, at %.5g nm", focal, speed, position,
                        1000 * one->wavelength);
}

static bool draw_case(const struct lens_case *one, struct run *run, const void *context,
                      struct error *error)
{
    struct drawer *drawer = run->driver;
    const struct input *input = context;
    struct picture picture = {.one = one, .arena = run->arena};
    picture.marginal = follow(one, one->first.marginal_y, one->first.marginal_v, run->arena);
    picture.chief = follow(one, one->first.chief_y, one->first.chief_v, run->arena);
    if (!picture_lens(&picture, error)) {
        return false;
    }
    if (!picture.is_centred && (input->construction || input->planes)) {
        return fail(error, ERROR_DOMAIN,
                    "--%s is for centred lenses, and parts of this one are decentred, tilted or "
                    "bent",
                    input->construction ? "construction" : "planes");
    }
    if (!picture.is_centred) {
        add_bent_axis(&picture);
    }
    if (input->construction) {
        picture.image = NAN;
        if (!picture_construction(&picture, error)) {
            return false;
        }
    } else {
        find_image(&picture);
        if (!input->no_rays && !picture_rays(&picture, error)) {
            return false;
        }
        add_image(&picture);
        if (input->planes) {
            picture_planes(&picture, true);
        }
    }
    if (picture.is_centred) {
        add_axis(&picture);
    }
    if (one->warning != NULL) {
        picture_note(&picture, arena_printf(run->arena, "warning: %s", one->warning));
    }
    const struct section section = {
        .title = input->title != NULL ? input->title : one->lens->title,
        .subtitle = subtitle_of(one, run->arena),
        .parts = picture.parts,
        .part_count = picture.part_count,
        .glasses = picture.glasses,
        .glass_count = picture.glass_count,
        .notes = picture.notes,
        .note_count = picture.note_count,
        .faint = input->construction,
    };
    return section_draw(&section, &drawer->svg, error);
}

static bool refuse(const struct input *input, struct error *error)
{
    if (lens_positions_several(input->question.lens.lens, input->question.position)) {
        return fail(error, ERROR_USAGE, "a drawing shows one position: --position NAME");
    }
    if (input->construction && (input->planes || input->no_rays)) {
        return fail(error, ERROR_USAGE, "--construction has planes and rays of its own: no %s",
                    input->planes ? "--planes" : "--no-rays");
    }
    return true;
}

static bool print(const void *data, struct output *output, struct error *error)
{
    const struct input *input = data;
    struct lens_question question = input->question;
    struct arena arena = {0};
    struct drawer drawer = {.input = input, .svg = {.arena = &arena}};
    struct run run = {.arena = &arena, .driver = &drawer};
    if (question.wavelength.name == NULL && question.lens.lens != NULL) {
        question.wavelength =
            (struct wavelength_value){lens_primary_wavelength(question.lens.lens), "primary"};
    }
    bool done = refuse(input, error) && lens_each(&question, &run, draw_case, input, error);
    if (done) {
        output_text(output, drawer.svg.data, drawer.svg.length);
    }
    arena_free(&arena);
    return done;
}

static const struct example examples[] = {
    {"draw double-gauss", "the cross-section with its rays (to a file: -o FILE.svg)"},
    {"draw double-gauss --planes", "with principal planes and pupils"},
    {"draw double-gauss --construction", "how the equivalent lens makes an image"},
    {"draw nikkor-z-14-24 --position tele", "a zoom in one of its positions"},
    {NULL, NULL},
};

const struct command command_draw = {
    .name = "draw",
    .group = "a lens",
    .summary = "cross-section of a lens as an SVG drawing",
    COMMAND_ASKS(struct input),
    .print = print,
};
