/* commands/photo/cmd_diffraction.c - lenscalc diffraction: Airy disc, contrast, limits. */
/* SPDX-License-Identifier: MIT */
#include "commands/photo/photo_lens.h"
#include "commands/photo/sharpness.h"
#include "commands/tables.h"
#include "photo/diffraction.h"

#include <math.h>

struct diffraction_input {
    double magnification, na, diameter;
    struct photo_lens_question lens;
    struct sharpness sharp;
    double pixels, film; /* film in line pairs per mm */
    double defocus, frequency;
    double focus_spread, near, far;
};

#define INPUT struct diffraction_input

static const struct option options[] = {
    PHOTO_LENS_OPTIONS(lens),
    OPTION_APERTURE(lens.fnumber, 0),
    {MEASURE(diameter, length, "mm", "LENGTH"), REPEATED("diameter"), ABOVE_0,
     .excludes = "aperture na lens magnification near focus-spread",
     .help =
         "diameter of a telescope, in place of -N: the angles that it resolves; with -f all of it"},
    OPTION_NA(na,
              "numerical aperture in place of -N: at the subject with -m, else at the image; the "
              "Airy disc is that on the sensor",
              .excludes = "aperture focal-length near focus-spread"),
    {MEASURE(frequency, frequency, "per_mm", "FREQUENCY"), REPEATED("frequency"),
     .quantity = "spatial frequency", FROM_0,
     .excludes = "coc print viewing acuity pixels film focus-spread near focal-length",
     .help = "MTF at this spatial frequency on the sensor; 10..100:10 for a table"},
    {MEASURE(magnification, ratio, NULL, "RATIO"), REPEATED("magnification"), .letter = 'm', FROM_0,
     .fallback = "0", .help = "magnification: 1:2 or 0.5"},
    OPTION_PUPIL_OF_LENS(lens.pupil, NULL),
    SHARPNESS_OPTIONS_DARK(sharp, 0, "d/1500", NULL),
    OPTION_WAVELENGTH_OF_LENS(lens.wavelength, NULL),
    {MEASURE(pixels, number, NULL, "NUMBER"), .name = "pixels", ABOVE_0, .fallback = "2",
     .wants = "aperture|lens", .help = "how many pixels wide the Airy disc may be"},
    {MEASURE(film, frequency, "per_mm", "FREQUENCY"), REPEATED("film"), ABOVE_0,
     .help = "resolution of the film: gives the f-number at which diffraction equals it"},
    {MEASURE(defocus, length, "um", "LENGTH"), REPEATED("defocus"), .quantity = "blur by defocus",
     FROM_0, .fallback = "0", .help = "diameter of the blur disc that defocus makes on the sensor"},
    {MEASURE(focus_spread, length, "mm", "LENGTH"), .name = "focus-spread",
     .column = "focus_spread", ABOVE_0,
     .help =
         "distance between the images of the nearest and farthest points: gives the best f-number"},
    OPTION_FOCAL_LENGTH(lens.focal, 0),
    {MEASURE(near, length, "m", "LENGTH"), REPEATED("near"), .quantity = "nearest point", ABOVE_0,
     .help = "nearest point that must be sharp, with -f or --lens: the best f-number"},
    {MEASURE(far, length, "m", "LENGTH"), REPEATED("far"), .quantity = "farthest point",
     ABOVE_0_OR_INFINITE, .fallback = "inf", .wants = "near",
     .help = "farthest point that must be sharp"},
};

struct diffraction_row {
    struct diffraction_setting setting;
    struct diffraction airy;
    struct diffraction_mtf mtf;
    struct diffraction_angles angles;
    struct diffraction_optimum optimum;
    double wavelength, pitch, coc, pixels, film, frequency; /* mm */
    double na, focal, near, far, spread, diameter;
    double mtf50, mtf10;
    double fnumber_pixel, fnumber_coc, fnumber_film;
    struct photo_real real;
    const char *sensor, *criterion;
};

#define ROW struct diffraction_row

#define COLUMN_CUTOFF(more)                                                                        \
    ENTRY(MEASURED(airy.cutoff, frequency, "per_mm"), .name = "cutoff", .flags = (more),           \
          .symbol = "nu0", .label = "cut-off frequency",                                           \
          .help = "where the contrast of a perfect lens ends")
#define COLUMN_NYQUIST                                                                             \
    ENTRY(MEASURED(airy.nyquist, frequency, "per_mm"), .name = "nyquist",                          \
          .when = "with --pitch, or a camera of known pixels", .symbol = "Ny",                     \
          .label = "Nyquist frequency of the pixels",                                              \
          .help = "finest pattern the pixels can record")
#define COLUMN_DIAMETER                                                                            \
    ENTRY(LENGTH(diameter, "mm"), .name = "diameter", ECHO_WITH("diameter"), .symbol = "D",        \
          .help = "of the entrance pupil")
#define COLUMNS_ANGLES(more)                                                                       \
    ENTRY(MEASURED(angles.rayleigh, angle, "arcsec"), .name = "rayleigh", .symbol = "th", more,    \
          .label = "Rayleigh angle", .help = "smallest angle resolved at infinity"),               \
        ENTRY(MEASURED(angles.dawes, angle, "arcsec"), .name = "dawes", more,                      \
              .label = "Dawes' limit", .help = "two stars just resolved, an empirical rule")
/* What contrast and Airy disc have in common. */
#define COLUMNS_ASSUMED                                                                            \
    COLUMN_WAVELENGTH(wavelength),                                                                 \
        ENTRY(SHOWN(setting.m), .name = "magnification",                                           \
              ASSUMED_BY("magnification") | COLUMN_ECHO, .symbol = "m",                            \
              .help = "size on the sensor over size of the subject"),                              \
        COLUMN_PUPIL(setting.P), COLUMN_SENSOR(sensor),                                            \
        ENTRY(LENGTH(pitch, "um"), .name = "pitch", ASSUMED_BY("pitch sensor"), .symbol = "p",     \
              .label = "pixel pitch", .help = "distance from pixel to pixel")
/* What --near or --focus-spread bring. */
#define COLUMNS_SPREAD(more)                                                                       \
    ENTRY(LENGTH(spread, "mm"), .name = "focus_spread", .flags = (more),                           \
          .when = "with --near or --focus-spread", .symbol = "dv", .label = "focus spread",        \
          .help = "between the images of nearest and farthest point"),                             \
        ENTRY(SHOWN(optimum.fnumber), .name = "optimum_fnumber", .flags = (more),                  \
              .when = "with --near or --focus-spread", .symbol = "No", .label = "best f-number",   \
              .help = "sharpest ends of the focus spread"),                                        \
        ENTRY(LENGTH(optimum.blur, "um"), .name = "optimum_blur", .flags = (more),                 \
              .when = "with --near or --focus-spread", .symbol = "bo",                             \
              .label = "blur at the best f-number",                                                \
              .help = "defocus and Airy disc at the ends, combined")

static const struct column columns[] = {
    PHOTO_LENS_COLUMNS(real),
    COLUMN_NA(na),
    COLUMN_FNUMBER(setting.N, 0),
    COLUMN_DIAMETER,
    {SHOWN(airy.working_fnumber), .name = "working_fnumber", .symbol = "Nw",
     .label = "working f-number", .help = "f-number that diffracts, N (1 + m/P)"},
    {LENGTH(airy.airy_diameter, "um"), .name = "airy_diameter", BRIEF, .symbol = "A",
     .label = "Airy disc, diameter", .help = "to the first dark ring"},
    {LENGTH(airy.airy_radius, "um"), .name = "airy_radius", .symbol = "a",
     .label = "Airy disc, radius", .help = "Rayleigh: two points this far apart are just resolved"},
    {MEASURED(airy.rayleigh_frequency, frequency, "per_mm"), .name = "resolution", BRIEF,
     .symbol = "R", .label = "resolution by Rayleigh", .help = "1 / Airy radius"},
    COLUMN_CUTOFF(COLUMN_BRIEF),
    COLUMN_NYQUIST,
    {MEASURED(mtf50, frequency, "per_mm"), .name = "mtf50", BRIEF,
     .label = "MTF50, 50 % contrast at",
     .help = "frequency of 50 % contrast: lens, defocus and pixels together"},
    {MEASURED(mtf10, frequency, "per_mm"), .name = "mtf10", .label = "MTF10, 10 % contrast at",
     .help = "frequency of 10 % contrast"},
    {SHOWN(fnumber_pixel), .name = "fnumber_pixel",
     .when = "with --pitch, or a camera of known pixels", .symbol = "Np",
     .label = "f-number of the pixels", .help = "where the Airy disc is --pixels wide"},
    {SHOWN(fnumber_coc), .name = "fnumber_coc", .symbol = "Nc",
     .label = "f-number of the circle of confusion",
     .help = "where the Airy disc is as wide as the circle of confusion"},
    {SHOWN(fnumber_film), .name = "fnumber_film", .when = "with --film", .symbol = "Nf",
     .label = "f-number of the film", .help = "where the Rayleigh limit is that of --film"},
    COLUMNS_SPREAD(0),
    COLUMNS_ANGLES(.with = "focal-length lens"),
    {MEASURED(frequency, frequency, "per_mm"), .name = "frequency", ECHO_WITH("frequency"),
     .symbol = "nu", .label = "spatial frequency", .help = "frequency on the sensor"},
    {SHOWN(mtf.lens), .name = "mtf_lens", WITH("frequency"), .symbol = "M",
     .label = "contrast, lens", .help = "perfect lens in focus"},
    {SHOWN(mtf.total), .name = "mtf_total", WITH("frequency"), .label = "combined MTF",
     .help = "lens, defocus and pixels"},
    COLUMN_COC(coc, 0, ""),
    COLUMN_CRITERION(criterion),
    {SHOWN(pixels), .name = "pixels", ECHO_WITH("pixels"), .symbol = "k",
     .label = "pixels across the Airy disc",
     .help = "width of the Airy disc that fnumber_pixel allows"},
    {MEASURED(film, frequency, "per_mm"), .name = "film", ECHO_WITH("film"), .symbol = "Rf",
     .help = "what the film resolves"},
    {LENGTH(setting.blur, "um"), .name = "defocus", ECHO_WITH("defocus"), .symbol = "b",
     .help = "diameter of the blur disc"},
    COLUMNS_ASSUMED,
    PHOTO_LENS_WARNING_COLUMN(real),
};

/* With --frequency: contrast alone, a row a frequency. */
static const struct column contrast_columns[] = {
    PHOTO_LENS_COLUMNS(real),
    COLUMN_NA(na),
    COLUMN_FNUMBER(setting.N, 0),
    {MEASURED(frequency, frequency, "per_mm"), .name = "frequency", BRIEF | COLUMN_ECHO,
     .symbol = "nu", .with = "frequency", .label = "spatial frequency",
     .help = "frequency on the sensor"},
    {SHOWN(mtf.lens), .name = "mtf_lens", BRIEF, .symbol = "Ml", .label = "contrast, lens",
     .help = "perfect lens in focus"},
    {SHOWN(mtf.defocus), .name = "mtf_defocus", BRIEF, .symbol = "Md", .label = "contrast, defocus",
     .help = "disc of defocus alone"},
    {SHOWN(mtf.pixel), .name = "mtf_pixel", BRIEF, .symbol = "Mp", .label = "contrast, pixels",
     .help = "square pixels without gaps alone"},
    {SHOWN(mtf.total), .name = "mtf_total", BRIEF, .symbol = "M", .label = "combined MTF",
     .help = "the product"},
    {SHOWN(airy.working_fnumber), .name = "working_fnumber", .symbol = "Nw",
     .label = "working f-number", .help = "f-number that diffracts, N (1 + m/P)"},
    COLUMN_CUTOFF(0),
    COLUMN_NYQUIST,
    {LENGTH(setting.blur, "um"), .name = "defocus", ASSUMED_BY("defocus") | COLUMN_ECHO,
     .symbol = "b", .help = "diameter of the blur disc"},
    COLUMNS_ASSUMED,
    PHOTO_LENS_WARNING_COLUMN(real),
};

/* Without --aperture, with --near or --focus-spread: the best f-number. */
static const struct column best_columns[] = {
    PHOTO_LENS_COLUMNS(real),
    COLUMN_FOCAL(focal, COLUMN_EXTRA),
    {LENGTH(near, "m"), .name = "near", ECHO_WITH("near"), .symbol = "n", .label = "near point",
     .help = "nearest point that must be sharp"},
    {LENGTH(far, "m"), .name = "far", ECHO_WITH("near") | COLUMN_INFINITE, .symbol = "r",
     .label = "far point", .help = "farthest point"},
    COLUMNS_SPREAD(COLUMN_BRIEF),
    COLUMNS_ASSUMED,
    PHOTO_LENS_WARNING_COLUMN(real),
};

/* With --diameter alone: angles, to which sensor and f-number say nothing. */
static const struct column angle_columns[] = {
    COLUMN_DIAMETER,
    COLUMNS_ANGLES(.flags = COLUMN_BRIEF),
    {MEASURED(angles.sparrow, angle, "arcsec"), .name = "sparrow", .label = "Sparrow limit",
     .help = "where the dip between two equal stars vanishes"},
    COLUMN_WAVELENGTH(wavelength),
};

static const struct sheet angle_sheet = SHEET(angle_columns, struct diffraction_row);
static const struct sheet best = SHEET(best_columns, struct diffraction_row);
static const struct sheet contrast = SHEET(contrast_columns, struct diffraction_row);
static const struct sheet all = SHEET(columns, struct diffraction_row);
static const struct sheet *const sheets[] = {&all, &best, &contrast, &angle_sheet, NULL};

static const struct sheet *diffraction_choose_sheet(const void *data,
                                                    const struct option_query *asking)
{
    (void)data;
    bool spread = asking_given(asking, "near") || asking_given(asking, "focus-spread");
    bool wants_best = spread && !asking_given(asking, "aperture");
    if (asking_given(asking, "diameter") && !asking_given(asking, "focal-length")) {
        return &angle_sheet;
    }
    if (asking_given(asking, "frequency")) {
        return &contrast;
    }
    return wants_best ? &best : &all;
}

/* Where the Airy disc outgrows pixels, circle of confusion and film. */
static bool compute_limits(const struct diffraction_input *input, struct diffraction_row *row,
                           struct error *error)
{
    const struct diffraction_setting *s = &row->setting;
    const struct {
        double diameter; /* mm; NaN = not asked for */
        double *fnumber;
    } limits[] = {
        {row->pitch * input->pixels, &row->fnumber_pixel},
        {row->coc > 0 ? row->coc : NAN, &row->fnumber_coc},
        {2 / input->film, &row->fnumber_film},
    };
    for (size_t i = 0; i < sizeof limits / sizeof limits[0]; i++) {
        if (!isnan(limits[i].diameter) &&
            !diffraction_fnumber(limits[i].diameter, s->wavelength, s->m, s->P, limits[i].fnumber,
                                 error)) {
            return false;
        }
    }
    return true;
}

static bool compute_optimum(const struct diffraction_input *input, struct diffraction_row *row,
                            struct error *error)
{
    row->spread = input->focus_spread;
    row->near = input->near;
    row->far = input->far;
    if (!isnan(input->near)) {
        if (!isnan(input->focus_spread) || isnan(row->focal)) {
            return fail(
                error, ERROR_USAGE,
                "{--near} needs {--focal-length} or {--lens}, and no {--focus-spread} of its own");
        }
        if (!diffraction_focus_spread(row->focal, input->near, input->far, &row->spread, error)) {
            return false;
        }
    }
    return isnan(row->spread) ||
           diffraction_optimum(row->spread, row->setting.wavelength, row->setting.m, row->setting.P,
                               &row->optimum, error);
}

static bool compute_airy(struct diffraction_row *row, struct error *error)
{
    if (!diffraction_compute(&row->setting, &row->airy, error)) {
        return false;
    }
    row->airy.nyquist = isnan(row->pitch) ? NAN : row->airy.nyquist;
    return isnan(row->focal) || diffraction_resolve(row->focal / row->setting.N,
                                                    row->setting.wavelength, &row->angles, error);
}

static bool compute_contrast(const struct diffraction_input *input, struct diffraction_row *row,
                             struct error *error)
{
    if (!isnan(input->frequency)) {
        return diffraction_mtf_at(&row->setting, input->frequency, &row->mtf, error);
    }
    return diffraction_frequency(&row->setting, 0.5, &row->mtf50, error) &&
           diffraction_frequency(&row->setting, 0.1, &row->mtf10, error);
}

/* Without an f-number the answer is the best one, to which what is sharp says nothing. */
static bool check_best(const struct diffraction_input *input, const struct sharpness *sharp,
                       struct error *error)
{
    const bool is_best = isnan(input->lens.fnumber) && isnan(input->na) &&
                         (!isnan(input->near) || !isnan(input->focus_spread));
    const char *idle = SAID_FIRST({!input->sharp.coc.is_fallback, "coc"},
                                  {sharp->coc.coc.kind == COC_PRINT, "print"},
                                  {!isnan(input->film), "film"}, {input->defocus > 0, "defocus"});
    if (is_best && idle != NULL) {
        return fail(error, ERROR_USAGE,
                    "{--%s} says nothing of the best f-number: give {--aperture} too", idle);
    }
    return true;
}

/* Beside a diameter alone nothing is known of the image. */
static bool check_angles(const struct diffraction_input *input, const struct sharpness *sharp,
                         struct error *error)
{
    const char *idle =
        SAID_FIRST({!isnan(input->frequency), "frequency"}, {!input->sharp.coc.is_fallback, "coc"},
                   {sharp->coc.coc.kind == COC_PRINT, "print"}, {!isnan(sharp->pitch), "pitch"},
                   {!sharp->sensor.is_fallback, "sensor"}, {!isnan(input->film), "film"},
                   {input->defocus > 0, "defocus"}, {!isnan(input->lens.pupil), "pupil"});
    return idle == NULL ||
           fail(error, ERROR_USAGE, "{--%s} needs {--focal-length} beside a diameter", idle);
}

/* As given, or what a numerical aperture or a diameter makes it; NaN: nothing does. */
static double diffraction_fnumber_of(const struct diffraction_input *input,
                                     const struct photo_lens *lens)
{
    if (!isnan(input->diameter)) {
        return lens->f / input->diameter;
    }
    return isnan(input->na) ? lens->N : fnumber_from_na(input->na, input->magnification, lens->P);
}

/* The angles of a diameter, whatever the focal length; nothing else. */
static bool diffraction_is_angles_alone(const struct diffraction_input *input,
                                        const struct photo_lens *lens)
{
    return !isnan(input->diameter) && isnan(lens->f);
}

static bool diffraction_answer(const void *data, const struct photo_lens *lens, struct run *run,
                               struct error *error)
{
    const struct diffraction_input *input = data;
    struct sharpness own = input->sharp;
    const struct sharpness *sharp = &own;
    if (!sharpness_settle(&own, PITCH_FOR_MORE, run->doubts, error) ||
        !check_best(input, sharp, error)) {
        return false;
    }
    const double pitch = sharpness_pitch(sharp);
    const double N = diffraction_fnumber_of(input, lens);
    struct diffraction_row row = {
        .setting = {.N = N,
                    .m = input->magnification,
                    .P = lens->P,
                    .wavelength = 1000 * lens->wavelength, /* um */
                    .blur = input->defocus,
                    .pitch = isnan(pitch) ? 0 : pitch},
        .wavelength = lens->wavelength,
        .pitch = pitch,
        .pixels = input->pixels,
        .film = input->film,
        .frequency = input->frequency,
        .na = input->na,
        .focal = lens->f,
        .diameter = input->diameter,
        .real = *lens->real,
        .sensor = sharp->sensor.name,
        .criterion = sharp->coc.criterion,
        /* absent until computed */
        .airy = {NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN},
        .mtf = {NAN, NAN, NAN, NAN},
        .angles = {NAN, NAN, NAN},
        .optimum = {NAN, NAN, NAN, NAN, NAN},
        .mtf50 = NAN,
        .mtf10 = NAN,
        .fnumber_pixel = NAN,
        .fnumber_film = NAN,
        .fnumber_coc = NAN,
    };
    if (diffraction_is_angles_alone(input, lens)) {
        return check_angles(input, sharp, error) &&
               diffraction_resolve(input->diameter, row.setting.wavelength, &row.angles, error) &&
               (run_emit(run, &row), true);
    }
    if (isnan(N) && !isnan(input->frequency)) {
        return fail(error, ERROR_USAGE, "{--frequency} needs {--aperture}");
    }
    if (!sharpness_resolve_in(sharp, lens->wavelength,
                              diffracting_fnumber(N, input->magnification, lens->P), &row.coc,
                              error) ||
        !compute_limits(input, &row, error) || !compute_optimum(input, &row, error)) {
        return false;
    }
    /* without an f-number there is still what limits it */
    if (!isnan(N) && (!compute_airy(&row, error) || !compute_contrast(input, &row, error))) {
        return false;
    }
    run_emit(run, &row);
    return true;
}

static bool diffraction_run(const void *data, struct run *run, struct error *error)
{
    const struct diffraction_input *input = data;
    bool solves = !isnan(input->near) || !isnan(input->focus_spread);
    return photo_lens_each(&input->lens, solves ? PHOTO_LENS_SOLVES_FNUMBER : 0, run,
                           diffraction_answer, input, error);
}

static const struct explanation explanations[] = {
    {"working_fnumber", "Nw = {N} (1 + {m}/{P})", "[Kingslake92]", NULL},
    {"airy_diameter", "A = 2 x 1.21967 {w} {Nw}", "[BornWolf99] 8.5.2; first zero of J1 over pi",
     "scalar and paraxial: below f/1.4 or so take 1/(2 sin theta') for the f-number"},
    {"airy_radius", "a = 1.21967 {w} {Nw}", "[BornWolf99] 8.5.2, Rayleigh's criterion", NULL},
    {"cutoff", "nu0 = 1/({w} {Nw})", "[Goodman05] ch. 6", "a perfect lens; no real one is better"},
    {"nyquist", "Ny = 1/(2 {p})", "sampling theorem", "finer patterns come out as coarser ones"},
    {"mtf_lens", "Ml = (2/pi)(acos x - x sqrt(1 - x^2)), x = {nu}/{nu0}", "[Goodman05] ch. 6",
     NULL},
    {"mtf_defocus", "Md = |2 J1(z)/z|, z = pi {b} {nu}", "[Goodman05] ch. 6, geometric",
     "an approximation where the blur is about as wide as the Airy disc"},
    {"mtf_pixel", "Mp = |sin(z)/z|, z = pi p {nu}", "[Goodman05]", "square pixels, no gaps"},
    {"mtf_total", "M = {Ml} {Md} {Mp}", "[Goodman05] ch. 6", NULL},
    {"fnumber_pixel", "Np = {k} {p}/(2 x 1.21967 {w} (1 + {m}/{P}))",
     "[BornWolf99] 8.5.2: Airy disc = k pixels", "a convention: 2 pixels are usual"},
    {"fnumber_coc", "Nc = {c}/(2 x 1.21967 {w} (1 + {m}/{P}))",
     "[BornWolf99] 8.5.2: Airy disc = circle of confusion", NULL},
    {"fnumber_film", "Nf = 1/(1.21967 {w} {Rf} (1 + {m}/{P}))",
     "[BornWolf99] 8.5.2: Rayleigh distance = one line pair", NULL},
    {"optimum_fnumber", "No = sqrt({dv}/(4 x 1.21967 {w}))/(1 + {m}/{P})",
     "[Hansma96]; defocus disc dv/(2 N) = Airy disc",
     "the root of the sum of squares is used for both blurs together"},
    {"rayleigh", "th = 1.21967 {w} {N}/f", "[BornWolf99] 8.5.2", "without air and aberrations"},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"diffraction -N 64 -w 500nm", "the Airy disc of group f/64"},
    {"diffraction -N 2.8..32 --sensor \"Nikon D1\"", "stopping down a camera from the list"},
    {"diffraction -N 8 --frequency 10..100:10 --pitch 4um", "a table of the MTF"},
    {"diffraction -N 16 -m 1:1", "life size: f/16 works as f/32"},
    {"diffraction --na 0.65 -m 40", "a microscope objective, on its camera"},
    {"diffraction --lens cooke-triplet-50", "a real lens wide open, at its own wavelength"},
    {"diffraction -f 150 --near 2m --far inf --sensor 4x5", "the best f-number for a landscape"},
    {NULL, NULL},
};

PHOTO_LENS_MAKES_MANY(lens)

const struct command command_diffraction = {
    .name = "diffraction",
    .stop_size_wants = "",
    COMMAND_OF("photography",
               "Airy disc, contrast (MTF), and the f-number where diffraction takes over"),
    .run = diffraction_run,
    .choose_sheet = diffraction_choose_sheet,
    .sheets = sheets,
    .makes_many = makes_many,
    .varies = varies,
    .plot = "mtf_total|airy_diameter_um|fnumber",
    .plot_titles = "MTF with diffraction|Airy disc|Sharpest f-number",
    .cell = "airy_diameter_um",
};
