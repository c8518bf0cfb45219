/* commands/camera/render_expose.c - a photograph exposed, and written as files hold it. */
/* SPDX-License-Identifier: MIT */
#include "camera/sensor/develop.h"
#include "commands/camera/render.h"
#include "file/image_file.h"
#include "light/colour.h"
#include "photo/exposure.h"
#include "photo/sensitometry.h"
#include "report/spoken.h"

#include <float.h>
#include <string.h>

/* Where white comes that nobody exposes for: half a stop below what saturates. */
#define WHITE_SHARE 0.70710678118654752

const struct word render_packings[] = {
    {"zip", "ZIP, 16 rows at once"}, {"none", "as it is"}, {NULL, NULL}};

/* -------- kinds of files -------- */

/* Bits of a number that a kind of file can have, the usual ones first. */
static const struct {
    const char *ending;
    int bits[2];
} depths[] = {{".png", {8, 16}}, {".exr", {32, 16}}};

static bool is_file_type(const struct file_type *type, const char *ending)
{
    return strcmp(type->ending, ending) == 0;
}

/* Those asked for, or the usual ones; 0: the kind has no choice, or not this one. */
static int file_bits(const struct render_input *input, const struct file_type *type)
{
    const int bits = input->raw ? 16 : (int)input->bits;
    for (size_t i = 0; i < sizeof depths / sizeof depths[0]; i++) {
        if (is_file_type(type, depths[i].ending)) {
            if (bits == 0 || bits == depths[i].bits[0]) {
                return depths[i].bits[0];
            }
            if (bits == depths[i].bits[1]) {
                return bits;
            }
            return 0;
        }
    }
    return 0;
}

bool render_check_file(const struct render_input *input, const struct file_type *type,
                       struct error *error)
{
    const bool is_png = is_file_type(type, ".png");
    if (input->raw && input->bits != 0 && input->bits != 16) {
        return fail(error, ERROR_USAGE, "{--bits} %ld: {--raw} numbers take 16", input->bits);
    }
    if (render_senses(input) && !is_png) {
        return fail(error, ERROR_USAGE,
                    "what a sensor sees is written as .png; %s holds the light itself",
                    type->ending);
    }
    if (input->bits != 0 && file_bits(input, type) == 0) {
        return fail(error, ERROR_USAGE,
                    "{--bits} %ld: a .png has 8 or 16, an .exr 16 or 32, others have no choice",
                    input->bits);
    }
    if (input->packing != 0 && !is_file_type(type, ".exr")) {
        return fail(error, ERROR_USAGE, "{--packing} %s: only an .exr has a choice",
                    render_packings[input->packing].word);
    }
    return !input->radiance || !is_png ||
           fail(error, ERROR_USAGE, "{--radiance}: a .png holds shares of white, not cd/m2");
}

/* -------- exposed -------- */

struct picture_exposure {
    double luminance; /* of white, cd/m^2 */
    double time, iso; /* s */
    double metered;   /* s, of which a film loses nothing: the light that counts */
    double full;      /* what saturates, lx s */
    bool is_chosen;   /* nobody gave a time */
};

static bool exposure_of(const struct render_input *input, const struct render_shot *shot,
                        struct arena *arena, struct picture_exposure *exposure, struct error *error)
{
    double iso;
    if (!render_speed(input, &shot->frame, arena, &iso, error)) {
        return false;
    }
    const struct photograph *photograph = &shot->photograph;
    const double full = saturation_exposure(iso), mean = colour_luminance(photograph->mean);
    const double ev = input->light.name != NULL ? input->light.ev100 : input->ev;
    const double luminance = isnan(ev) ? input->luminance : exposure_white(ev);
    const double white = shot->is_world ? 1 : luminance; /* its light is absolute */
    if (shot->is_world && isnan(input->time) && !(mean > 0)) {
        if (shot->enclosed != NULL) {
            return fail(error, ERROR_DOMAIN,
                        "no light was found that reaches the film: %s, and no light comes in",
                        shot->enclosed);
        }
        fail(error, ERROR_DOMAIN, "no light was found that reaches the film: nothing to meter");
        return error_hint(error,
                          input->bounces == 0
                              ? "{--bounces} 0 shows only what shines itself: give 1 or more"
                              : "what the camera sees neither shines nor sends light on, or "
                                "few rays find it: see its at= and look=, and the colours; or "
                                "give {--time}");
    }
    *exposure = (struct picture_exposure){
        .luminance = white,
        .time = input->time,
        .metered = shot->is_world ? recommended_exposure(iso) / mean
                                  : WHITE_SHARE * full / (white * photograph->reference),
        .iso = iso,
        .full = full,
        .is_chosen = isnan(input->time)};
    return render_film_time(input, &exposure->time, &exposure->metered, error);
}

/* What the pixels are of E/L: those of a file, or what sensor and film take. */
static double pixel_unit(const struct render_input *input, const struct picture_exposure *exposure,
                         const struct file_type *type, double reference)
{
    const double light = exposure->luminance * exposure->metered;
    const bool is_received = render_senses(input) || render_is_film(input);
    if (input->radiance) {
        return exposure->luminance / reference;
    }
    return (is_file_type(type, ".png") && !is_received) ? DEVELOP_HEADROOM * light / exposure->full
                                                        : light;
}

/* Floats are rounded, so that half of the least one is black; a .hdr has no exponent below. */
static struct render_floor file_floor(const struct file_type *type, bool half)
{
    if (half) {
        return (struct render_floor){0x1p-25, 0x1p-24, 0x1p-14, "half floats"};
    }
    if (is_file_type(type, ".hdr")) {
        return (struct render_floor){0x1p-128, 0x1p-128, 0x1p-128, "pixels of a .hdr"};
    }
    return (struct render_floor){0x1p-150, FLT_TRUE_MIN, FLT_MIN, "floats"};
}

/* Light itself must be numbers that pixels hold; a PNG and film say themselves what is too dark. */
static bool check_file_light(const struct render_input *input, const struct file_type *type,
                             const struct image *image, double unit, struct text_buffer *remarks,
                             struct error *error)
{
    const double most = render_clipping_of(image, unit, 1).most;
    const char *name = input->radiance ? "cd/m2" : "lx s";
    const struct render_floor floor = file_floor(type, file_bits(input, type) == 16);
    if (!(most <= (double)FLT_MAX)) {
        return fail(error, ERROR_DOMAIN, "the brightest pixel has %.3g %s: pixels hold %.3g", most,
                    name, (double)FLT_MAX);
    }
    return is_file_type(type, ".png") || render_is_film(input) ||
           render_check_dark(image, unit, &floor, name, remarks, error);
}

/* -------- what is said of it -------- */

void render_note(struct image *image, struct arena *arena, const char *key, const char *value)
{
    if (value != NULL) {
        image_note(image, arena, text_of(key), text_of(value));
    }
}

static void exposure_add_notes(const struct render_input *input, const struct render_shot *shot,
                               const struct picture_exposure *exposure, bool is_png,
                               struct image *image, struct arena *arena)
{
    const bool is_film = render_is_film(input);
    render_note(image, arena, "Exposure time", arena_printf(arena, "%.6g s", exposure->time));
    render_note(image, arena, "Film", is_film ? input->film.name : NULL);
    render_note(image, arena, "ISO", arena_printf(arena, "%.6g", exposure->iso));
    if (!shot->is_world) {
        render_note(image, arena, "White", arena_printf(arena, "%.6g cd/m2", exposure->luminance));
    }
    /* what a value of 1 is where that is light on the sensor */
    const double light = 1 / (shot->photograph.reference * exposure->metered);
    const double white = is_png ? exposure->full / DEVELOP_HEADROOM * light : light;
    if (!input->raw && !input->radiance && !is_film) {
        render_note(image, arena, is_png ? RENDER_NOTE_WHITE : RENDER_NOTE_LIGHT,
                    arena_printf(arena, "%.6g cd/m2", white));
    }
    if (!is_png) {
        const char *unit = input->radiance ? "cd/m2" : "lx s";
        render_note(image, arena, "Unit", is_film ? "density" : unit);
    }
}

/*
 * Too much light, or too little, and what would mend it. Files of light hold any; a sensor says
 * itself what it cannot hold.
 */
static void exposure_add_warnings(const struct render_input *input, const struct render_shot *shot,
                                  const struct picture_exposure *exposure, bool is_png,
                                  struct text_buffer *remarks)
{
    const double unit = exposure->luminance * exposure->metered / exposure->full;
    const struct image *image = &shot->photograph.image;
    const struct clipping_share clipping =
        is_png ? render_clipping_of(image, DEVELOP_HEADROOM * unit, RENDER_OVER_WHITE)
               : render_clipping_of(image, unit, 1);
    if (!is_png && !input->radiance) {
        render_say_held(&clipping, exposure->iso, remarks);
    }
    if (clipping.most == 0 && !shot->photograph.is_incomplete) { /* else it is not there yet */
        const bool is_lit = colour_luminance(shot->photograph.mean) > 0;
        growing_format(remarks, "warning: no light was found that reaches %s: all is black%s%s\n",
                       input->crop != NULL ? "these pixels" : "the film",
                       is_lit && input->crop == NULL ? ", and more --samples would find some" : "",
                       shot->enclosed != NULL ? arena_printf(remarks->arena, "; %s", shot->enclosed)
                                              : "");
    }
    if (is_png && !render_senses(input)) {
        render_say_clipping(&clipping, remarks);
    }
    if (is_png && clipping.most > 0 && clipping.most < 1.0 / 4096) {
        growing_format(remarks,
                       "warning: all is black: it takes %.3g times the time or the ISO until the "
                       "brightest pixel saturates\n",
                       1 / clipping.most);
    }
}

/* What all exposures share, and this one. */
static void exposure_add_remarks(const struct render_input *input, const struct render_shot *shot,
                                 const struct picture_exposure *exposure,
                                 struct text_buffer *remarks)
{
    const bool is_leaf = input->shutter.kind == SHUTTER_LEAF;
    const struct photograph *photograph = &shot->photograph;
    const char *why = ": white half a stop below saturation";
    char time[64];
    if (!exposure->is_chosen) {
        why = "";
    } else if (shot->is_world) {
        why = ": metered, 10/ISO lx s on average (ISO 2720)";
    } else if (render_is_film(input)) {
        why = ": 18 % grey as a meter exposes it";
    }
    spoken_time(time, exposure->time, 3);
    if (shot->is_world) {
        growing_format(remarks, "%.4g lx on the film on average",
                       colour_luminance(photograph->mean));
    } else {
        growing_format(remarks, "%.4g x %.4g mm of the card; white of %.4g cd/m2",
                       photograph->card.width, photograph->card.height, exposure->luminance);
    }
    growing_format(remarks, "%s%s%s at ISO %.4g%s\n", shot->is_one_of_many ? "\n" : ", ",
                   shot->is_world && is_leaf ? "as if fully open for " : "", time, exposure->iso,
                   why);
}

/* -------- a file -------- */

/* Light becomes what the file shall hold: numbers, shares of white, densities. */
static bool receive_light(const struct render_input *input, const struct render_shot *shot,
                          const struct picture_exposure *exposure, bool is_png, struct image *image,
                          struct text_buffer *remarks, struct error *error)
{
    const struct image light = *image;
    const bool is_film = render_is_film(input);
    if (!render_senses(input) && !is_film) {
        return true;
    }
    if (!(is_film ? render_develop(input, is_png, &shot->frame, image, remarks, error)
                  : render_sense(input, exposure->time, shot, image, remarks, error))) {
        return false;
    }
    image->aspect = light.aspect;
    for (size_t i = 0; i < light.note_count; i++) {
        render_note(image, remarks->arena, light.notes[i].key, light.notes[i].value);
    }
    return render_frame_cut(&shot->frame, remarks->arena, image, error);
}

/* The file, and all that is used for it in the arena of the remarks. */
static bool expose(const struct render_input *input, const struct render_shot *shot,
                   const struct file_type *type, struct text_buffer *remarks, struct text *bytes,
                   struct error *error)
{
    const struct photograph *photograph = &shot->photograph;
    const bool is_png = is_file_type(type, ".png"), is_film = render_is_film(input);
    const bool is_hasty = shot->aside != NULL; /* somebody waits for the end */
    const struct image_way way = {.bits = file_bits(input, type),
                                  .half = file_bits(input, type) == 16,
                                  .values = input->raw ? IMAGE_CODES : IMAGE_LIGHT,
                                  .packed = input->packing == 0 && !is_hasty,
                                  .stored = is_hasty,
                                  .threads = parallel_threads(input->threads)};
    struct picture_exposure exposure;
    struct image image;
    if (!exposure_of(input, shot, remarks->arena, &exposure, error)) {
        return false;
    }
    exposure_add_remarks(input, shot, &exposure, remarks);
    if (!is_film) {
        exposure_add_warnings(input, shot, &exposure, is_png, remarks);
    }
    growing_text(remarks, shot->doubts);
    const double unit = pixel_unit(input, &exposure, type, photograph->reference);
    const bool is_share = is_png && !is_film && !render_senses(input);
    if (!(is_share || check_file_light(input, type, &photograph->image, unit, remarks, error))) {
        return false;
    }
    /* A picture in other units, in its own place if nobody needs it any more. */
    const struct image *from = &shot->photograph.image;
    image = *from;
    if (!shot->is_last && !image_new(&image, remarks->arena, error)) {
        return false;
    }
    for (size_t i = 0; i < image.width * image.height * image.channels; i++) {
        image.pixels[i] = (float)(unit * (double)from->pixels[i]);
    }
    exposure_add_notes(input, shot, &exposure, is_png, &image, remarks->arena);
    return receive_light(input, shot, &exposure, is_png, &image, remarks, error) &&
           image_file_bytes(&image, type, &way, remarks->arena, bytes, error);
}

bool render_expose(const struct artifact_job *job, size_t which, const struct render_shot *shot,
                   struct output *sink, struct error *error)
{
    struct arena scratch = {0};
    struct text_buffer remarks = {.arena = &scratch}, kept = {.arena = job->run->arena};
    struct text bytes;
    const bool done = expose(job->inputs[which], shot, job->type, &remarks, &bytes, error);
    if (done) {
        output_text(sink, bytes.start, bytes.length);
    }
    growing_text(&kept, growing_done(&remarks));
    if (shot->aside != NULL) {
        growing_format(&kept, "%s is what there is of the picture that was interrupted\n",
                       shot->aside);
    }
    sink->remarks = growing_done(&kept);
    arena_free(&scratch);
    return done;
}
