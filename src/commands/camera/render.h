/* commands/camera/render.h - what lenscalc render is asked, and what it makes. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_CAMERA_RENDER_H
#define LENSCALC_COMMANDS_CAMERA_RENDER_H

#include "base/image/image.h"
#include "camera/photograph/photograph.h"
#include "cli/options/option_light.h"
#include "commands/analysis/analysis_cursor.h"
#include "commands/photo/photo_options.h"
#include "optics/growing.h"

#include <math.h>

/* What is noted of a sensor: electrons of a PNG's white, and those of its read noise. */
#define RENDER_NOTE_FULL "Electrons of white"
#define RENDER_NOTE_READ "Read noise electrons"

/* And where it is full: three times three numbers, as struct saturation has them. */
#define RENDER_NOTE_SATURATION "Saturation"

/* And of light: what in the scene a value of 1 is, of a PNG and of files that hold lx s. */
#define RENDER_NOTE_WHITE "Luminance of white"
#define RENDER_NOTE_LIGHT "Luminance of 1 lx s"

/* The options of a shutter; NaN: not given. */
struct shutter_input {
    int kind, direction;                      /* enum shutter_kind; enum shutter_direction */
    double travel, readout, opening, closing; /* s */
    double distance, overrun;                 /* mm */
};

struct render_input {
    const char *subject; /* a name: scene, picture or chart */
    struct analysis_question question;
    struct sensor_value sensor;
    const char *size;             /* "360x240"; null = 480 pixels wide */
    const char *crop;             /* "100:50:64x32"; null = all */
    double distance, field_width; /* mm; NaN = not given */
    double luminance, time, iso;  /* cd/m^2; s, NaN = not given */
    double ev;                    /* of the light on the card, at ISO 100; NaN = not given */
    struct scene_value light;
    struct loss_value filter;
    long blades;                       /* 0 = round */
    double blade_turn, blade_rounding; /* rad; 0..1 */
    int from;                          /* enum distance_from */
    int model, focus_at;               /* enum lens_model; enum render_focus_at */
    const char *autofocus;             /* "0.5:0.5"; null = on the distance */
    const char *gap;                   /* "d5,10:-1"; null = the whole lens moves */
    struct part part;                  /* no count: all of it */
    bool resume;                       /* the tiles that are in its file stay */
    bool radiance;                     /* cd/m^2 in place of lx s */
    int packing;                       /* of render_packings */
    bool noise, raw;                   /* of a sensor */
    int mosaic;                        /* enum sensor_mosaic */
    const char *white;
    const char *no_skip;                        /* names of skips, null: none */
    const char *depth_map;                      /* null: the card is flat */
    struct interval_value depth;                /* mm, of a PNG; NaN: not given */
    int hidden;                                 /* enum depth_card_hidden */
    double pitch;                               /* mm; NaN = that of the picture */
    double read_noise, full_well, dark_current; /* electrons, and a second; NaN = not given */
    double fill, efficiency, gain, black; /* of image_sensor and its setting; NaN = not given */
    long adc;                             /* bits; 0 = not given */
    double band;                          /* of each colour, mm; NaN = one wavelength */
    const char *response, *acceptance;    /* a word or number, or a file */
    struct film_value film;
    double grain;        /* rms granularity, as characteristic_grain takes it; NaN = none */
    double error;        /* a share of white; NaN = not given */
    long bounces, bands; /* of light in scenes; wavelengths that it has */
    bool spectral;
    double seconds;                    /* that it may take; NaN = not given */
    long samples, seed, threads, bits; /* samples, bits: 0 = not given */
    struct shutter_input shutter;
};

/* -------- commands/camera/render_case.c -------- */

/* What is brought onto the film. */
enum render_focus_at { FOCUS_AT_THICK, FOCUS_AT_SHARPEST };
extern const struct word render_focus_ats[];

/* -------- commands/camera/render_card.c -------- */

/* Where in the picture: fractions from the upper left. Errors: ERROR_USAGE: no place there */
bool render_autofocus_place(const char *text, double place[2], struct error *error);

/* Errors: ERROR_USAGE: no place in the picture; what contradicts it */
bool render_check_autofocus(const struct render_input *input, struct error *error);

/*
 * The distance of what lies at a place of the picture, in place of the one asked for.
 *
 * Given     focused  receives the input with it: from the depth map, in which the place is that of
 *                    an image without distortion; of a flat card it is the distance of all of it
 * Errors    as render_depths; ERROR_DOMAIN: nothing lies there, or at infinity
 */
bool render_autofocus(const struct render_input *input, struct arena *arena,
                      struct render_input *focused, struct error *error);

/* Given: distance  before the first vertex, mm */
void render_say_autofocus(const struct render_input *input, double distance,
                          struct text_buffer *remarks);

/* Which, unless it is the exact lens; of a fitted one how well it fits. */
void render_say_model(const struct render_input *input, const struct analysis_case *one,
                      struct text_buffer *remarks);

/*
 * The only case that is asked for: focused on the distance, if there is one, with the model of the
 * lens.
 *
 * Given     channels  wavelengths in place of those asked for; null: these
 *           one       receives it, in the arena of the run
 * Errors    ERROR_USAGE: several positions; as analysis_next_case, render_focus and render_model
 */
bool render_open(const struct render_input *input, const struct spectrum_value *channels,
                 struct run *run, const struct analysis_case **one, struct error *error);

/*
 * The lens that is asked for, not its model, by an f-number, at its primary wavelength and with the
 * object of the case.
 *
 * Given     fnumber  NaN = its own, wide open
 * Errors    as lens_positions and setup_open
 */
bool render_stopped(const struct render_input *input, const struct analysis_case *one,
                    double fnumber, struct arena *arena, struct setup *setup, struct error *error);

/*
 * The f-number of the picture: what is asked for, or that of the lens wide open where its clear
 * apertures let no more through.
 */
double render_fnumber(const struct render_input *input, const struct analysis_case *one,
                      struct arena *arena);

/*
 * What is doubtful: of the lens; dark corners of the film; rays that get lost elsewhere.
 *
 * Given     largest, corner  how far from the axis light arrives and the film reaches, mm
 *           lit_at           a place that light reaches, mm: the middle, unless that is dark
 *           share            of the rays, how many arrive; NaN: more are sent than may
 */
void render_doubts(const struct render_input *input, const struct analysis_case *one,
                   double largest, double corner, const double lit_at[2], double share,
                   struct text_buffer *remarks);

/* The film, and the iris before it. */
struct film_question render_film(const struct render_input *input, const struct analysis_case *one);

/* The object before the first vertex of render_open's case, mm; NaN = that of the lens. */
double render_object(const struct analysis_case *one);

/* -------- commands/camera/render_shutter.c -------- */

/*
 * Errors    ERROR_USAGE: a shutter without its times, several exposures by a leaf shutter in a
 *           part; as shutter_open, for each exposure
 */
bool render_check_shutter(const struct artifact_job *job, struct error *error);

/* Do the job's exposures differ by more than how long they are? */
bool render_shutter_varies(const struct artifact_job *job);

/*
 * The shutter of an exposure; null: open to all rays at once. A leaf shutter fully open is as wide
 * as the stop of the lens by its own aperture, or by -N if that is wider or the lens has none.
 *
 * Errors    as shutter_open, setup_open
 */
bool render_shutter(const struct render_input *input, const struct analysis_case *one,
                    struct arena *arena, const struct shutter **shutter, struct error *error);

/*
 * From when to when any ray of an exposure comes, s; of one whose time is not known about a second.
 *
 * Errors    as render_shutter, lens_film_open
 */
bool render_shutter_span(const struct render_input *input, const struct analysis_case *one,
                         struct arena *arena, double span[2], struct error *error);

void render_note_shutter(const struct render_input *input, struct image *image,
                         struct arena *arena);

/* Its slit, and how long light comes; of a film that was opened before. */
void render_say_shutter(const struct render_input *input, const struct film_question *film,
                        struct text_buffer *remarks);

/* Its formula; null: nothing is said. */
void render_explain_shutter(const struct shutter *shutter, struct text_buffer *remarks);

/* -------- commands/camera/render_frame.c -------- */

/*
 * Numbers as they are typed, not below 0: digits and, where they need not be whole, a point and an
 * exponent; no signs, blanks, infinities.
 *
 * Given     marks    what stands between them, as "::x"; an x may be an X
 * Result    numbers  one more of them than marks; false: the text is another one
 */
bool render_numbers(const char *text, const char *marks, bool are_whole, double *numbers);

/* The pixels of a picture. */
struct render_frame {
    size_t columns, rows;    /* of all of it */
    struct image_area crop;  /* that are wanted, */
    struct image_area taken; /* and that are needed for them: of a sensor some beside them */
    size_t number;           /* of the exposure among those of a run, from 0 */
};

/* Errors: ERROR_USAGE: no size, no crop, one that is not within the picture */
bool render_frame_read(const struct render_input *input, struct render_frame *frame,
                       struct error *error);

/* What noise and grain are drawn by: each exposure has its own, the first one's is the seed. */
static inline uint64_t render_frame_seed(const struct render_input *input,
                                         const struct render_frame *frame)
{
    return (uint64_t)frame->number << 32 | (uint64_t)input->seed; /* which is below 2^32 */
}

/*
 * Proportions of a pixel, its width over its height.
 *
 * Result    0: it is square, or as near to it as whole numbers of them let it be
 */
double render_aspect(const struct render_input *input, const struct render_frame *frame);

/* Side of a square as large as a pixel, mm: light and grain go by the area. */
static inline double render_frame_pitch(const struct render_input *input,
                                        const struct render_frame *frame)
{
    const struct sensor *film = &input->sensor.size;
    return sqrt(film->width / (double)frame->columns * (film->height / (double)frame->rows));
}

/* Warns of pixels that are not square. */
void render_say_size(const struct render_input *input, const struct render_frame *frame,
                     struct text_buffer *remarks);

/*
 * Leave of a picture what is wanted.
 *
 * Given     image   with the pixels that were taken; receives those of the crop
 * Errors    as image_new
 */
bool render_frame_cut(const struct render_frame *frame, struct arena *arena, struct image *image,
                      struct error *error);

/* -------- commands/camera/render_clipping.c -------- */

/* White comes with noise and is not too bright by that: over so much of it a pixel is. */
#define RENDER_OVER_WHITE 1.1

/* Numbers of a picture, over what its file can hold at most or what saturates. */
struct clipping_share {
    double share;       /* of the pixels: over the limit in some channel */
    double least, most; /* of all channels */
};

/* Given: unit  times a number of the picture is 1 where its file ends */
struct clipping_share render_clipping_of(const struct image *image, double unit, double limit);

/*
 * Warn of a picture that is too bright for its file, of which a hundredth and more of the pixels
 * is lost or all: less is lights themselves and what reflects them.
 */
void render_say_clipping(const struct clipping_share *clipping, struct text_buffer *remarks);

/* The same of what saturates at a speed and the file holds. */
void render_say_held(const struct clipping_share *clipping, double iso,
                     struct text_buffer *remarks);

/* Where numbers of a kind of file begin. */
struct render_floor {
    double black;       /* less light than this becomes 0 */
    double least, full; /* the first that there is, and the first with all digits */
    const char *name;
};

/*
 * Say how much of a picture is too dark for its file.
 *
 * Given     unit  times a number of the picture is light of `name`, as "lx s"
 * Errors    ERROR_DOMAIN: all light that there is
 */
bool render_check_dark(const struct image *image, double unit, const struct render_floor *floor,
                       const char *name, struct text_buffer *remarks, struct error *error);

/* A picture before it is exposed. */
struct render_shot {
    struct render_frame frame;
    struct photograph photograph; /* with notes of what is the same in all exposures */
    struct text doubts;           /* lines about the lens */
    const char *aside;            /* the file of a picture that was interrupted; null: none */
    const char *enclosed;         /* what the camera of a scene stands within; null: nothing */
    bool is_world;                /* of a scene, whose light is not that of a white card */
    bool is_last;                 /* this exposure of it may use it up */
    bool is_one_of_many;          /* what is true of all exposures stands in a line of its own */
};

/* -------- commands/camera/render_sensor.c -------- */

extern const struct word render_mosaics[];

/* Is a sensor asked for? */
bool render_senses(const struct render_input *input);

/*
 * Given     frame  of the picture
 * Errors    ERROR_USAGE: no balance of white, or one of raw numbers or of a crop; options that
 *           exclude each other; as number_table_read, response_open and sensor_open
 */
bool render_check_sensor(const struct artifact_job *job, const struct render_frame *frame,
                         struct error *error);

/* ISO, as asked for, of the film, or that a gain makes. */
bool render_speed(const struct render_input *input, const struct render_frame *frame,
                  struct arena *arena, double *iso, struct error *error);

/* What pixels accept by the angle; null: all. Errors: as acceptance_power, acceptance_table */
bool render_acceptance(const struct render_input *input, struct arena *arena,
                       const struct acceptance **acceptance, struct error *error);

/*
 * Expose a sensor, and develop what it saw unless its numbers are wanted.
 *
 * Given     time   of the exposure, s
 *           shot   the picture; what is black of an unfinished one has no noise
 *           image  light of the pixels taken, lx s; receives linear sRGB with white 1, or numbers
 *                  over 65535
 * Errors    as sensor_open, sensor_expose, demosaic_bilinear and develop_picture
 */
bool render_sense(const struct render_input *input, double time, const struct render_shot *shot,
                  struct image *image, struct text_buffer *remarks, struct error *error);

/* -------- commands/camera/render_emulsion.c -------- */

/* Is it a film that is exposed, rather than a sensor? */
static inline bool render_is_film(const struct render_input *input)
{
    return input->film.model != NULL;
}

/* Errors: ERROR_USAGE and ERROR_DOMAIN: a film without a curve or speed; what films do not have */
bool render_check_film(const struct artifact_job *job, struct error *error);

/*
 * What a film needs longer, or loses, in long exposures; a sensor nothing.
 *
 * Given     time     of the exposure, s, or NaN: receives it
 *           metered  of which nothing is lost, s: receives it unless `time` is NaN
 * Errors    as reciprocity_corrected and reciprocity_metered
 */
bool render_film_time(const struct render_input *input, double *time, double *metered,
                      struct error *error);

/*
 * Expose a film and develop it.
 *
 * Given     is_print  print the negative
 *           frame     of the picture
 *           image     light of the pixels taken, lx s; receives the light of a print,
 *                     white 1, or densities
 * Errors    as characteristic_open and emulsion_expose
 */
bool render_develop(const struct render_input *input, bool is_print,
                    const struct render_frame *frame, struct image *image,
                    struct text_buffer *remarks, struct error *error);

/* -------- commands/camera/render_world.c -------- */

/* Is it a scene, rather than a card? */
bool render_is_world(const struct render_input *input);

/* -------- commands/camera/render_card.c -------- */

/*
 * "chart:edge" or a file with a picture.
 *
 * Errors    ERROR_USAGE: no such chart; as image_file_read; ERROR_DATA: light that is no number
 *           from 0
 */
bool render_card(const struct render_input *input, struct arena *arena, struct card *card,
                 struct error *error);

/*
 * What a chart measures: angles, frequencies on the film by the paraxial magnification; of a
 * picture, what became of it when it was read.
 */
void render_say_card(const struct render_input *input, const struct photograph *photograph,
                     const struct setup *setup, struct text_buffer *remarks);

/* -------- commands/camera/render_skips.c -------- */

/*
 * What is done though it need not be: 1 << enum skip.
 *
 * Errors    ERROR_USAGE: a word that is none of skip_words
 */
bool render_kept(const struct render_input *input, unsigned *kept, struct error *error);

/* The equation that a picture solves, and what it did without. */
void render_explain(const struct artifact_job *job, const struct photograph_question *question,
                    const struct photograph *photograph, struct text_buffer *remarks);

extern const struct word render_hidden[];

/* Errors: ERROR_USAGE: no two distances above 0 */
bool render_check_depths(const struct render_input *input, struct error *error);

/*
 * The depth map that is asked for, if any.
 *
 * Given     picture  that it lies beside; null: a chart
 * Errors    as depth_file_read; ERROR_DATA: sides in another proportion than the picture's
 */
bool render_depths(const struct render_input *input, const struct image *picture,
                   struct arena *arena, struct photograph_depths *depths, struct error *error);

/* What is to be known of a picture with depths. */
void render_say_depths(const struct render_input *input, const struct photograph *photograph,
                       struct text_buffer *remarks);

/* -------- commands/camera/render_expose.c -------- */

extern const struct word render_packings[];

/* Errors: ERROR_USAGE: something that this kind of file cannot hold */
bool render_check_file(const struct render_input *input, const struct file_type *type,
                       struct error *error);

/*
 * Expose a picture, and write it; several exposures are of one shot.
 *
 * Given     job   of a picture; `which` of its inputs has time, speed and the like
 *           sink  gets the file, and what is to be said of it
 * Errors    as render_sense and image_file_bytes
 */
bool render_expose(const struct artifact_job *job, size_t which, const struct render_shot *shot,
                   struct output *sink, struct error *error);

/* Note something in plain words; null: nothing. */
void render_note(struct image *image, struct arena *arena, const char *key, const char *value);

/* -------- commands/camera/render_rays.c and render_picture.c -------- */

file_types render_ray_types;
bool render_rays(const struct artifact_job *job, struct output *sink, struct error *error);

/* Of pictures, and of their parts. */
file_types render_picture_types;
bool render_check_picture(const struct artifact_job *job, struct error *error);
bool render_picture(const struct artifact_job *job, struct output *sinks, struct error *error);

#endif
