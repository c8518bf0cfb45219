/* commands/photo/cmd_diffraction.c - lenscalc diffraction: Airy disc, contrast, limits. */
/* SPDX-License-Identifier: MIT */
#include "commands/photo/photo_lens.h"
#include "commands/photo/sharpness.h"
#include "photo/diffraction.h"

#include <math.h>

struct diffraction_input {
    double magnification;
    struct photo_lens_question lens;
    struct sharpness sharp;
    double pixels, film; /* film in line pairs per mm */
    double defocus, frequency;
    double focus_spread, near, far;
};

#define NUMBER(member_name) OPTION(struct diffraction_input, member_name)
#define FINITE              OPTION_POSITIVE, .flags = OPTION_ABOVE_LOWEST | OPTION_NO_INFINITY

static const struct option options[] = {
    PHOTO_LENS_OPTIONS(struct diffraction_input, lens),
    OPTION_APERTURE(struct diffraction_input, lens.fnumber, 0),
    {NUMBER(frequency), .name = "frequency", .quantity = "spatial frequency", .column = "frequency",
     .dimension = &dimension_frequency, .unit = "per_mm", .lowest = 0, .highest = INFINITY,
     .flags = OPTION_NO_INFINITY, .value = "FREQUENCY",
     .excludes = "coc print viewing acuity pixels film focus-spread near focal-length",
     .help = "contrast at this spatial frequency on the sensor; 10..100:10 for a table"},
    {NUMBER(magnification), .name = "magnification", .letter = 'm', .column = "magnification",
     .dimension = &dimension_ratio, .lowest = 0, .highest = INFINITY, .flags = OPTION_NO_INFINITY,
     .fallback = "0", .value = "RATIO", .help = "magnification: 1:2 or 0.5"},
    OPTION_PUPIL_OF_LENS(struct diffraction_input, lens.pupil, NULL),
    SHARPNESS_OPTIONS_DARK(struct diffraction_input, sharp, 0, "d/1500", NULL),
    OPTION_WAVELENGTH_OF_LENS(struct diffraction_input, lens.wavelength, NULL),
    {NUMBER(pixels), .name = "pixels", .dimension = &dimension_number, FINITE, .fallback = "2",
     .wants = "aperture|lens", .value = "NUMBER",
     .help = "how many pixels wide the Airy disc may be"},
    {NUMBER(film), .name = "film", .column = "film", .dimension = &dimension_frequency,
     .unit = "per_mm", FINITE, .value = "FREQUENCY",
     .help = "resolution of the film: gives the f-number at which diffraction equals it"},
    {NUMBER(defocus), .name = "defocus", .quantity = "blur by defocus", .column = "defocus",
     .dimension = &dimension_length, .unit = "um", .lowest = 0, .highest = INFINITY,
     .flags = OPTION_NO_INFINITY, .fallback = "0", .value = "LENGTH",
     .help = "diameter of the blur disc that defocus makes on the sensor"},
    {NUMBER(focus_spread), .name = "focus-spread", .column = "focus_spread",
     .dimension = &dimension_length, .unit = "mm", FINITE, .value = "LENGTH",
     .help = "between the images of the nearest and farthest points: gives the best f-number"},
    OPTION_FOCAL_LENGTH(struct diffraction_input, lens.focal, 0),
    {NUMBER(near), .name = "near", .quantity = "nearest point", .column = "near",
     .dimension = &dimension_length, .unit = "m", FINITE, .value = "LENGTH",
     .help = "nearest point that must be sharp, with -f or --lens: the best f-number"},
    {NUMBER(far), .name = "far", .quantity = "farthest point", .column = "far",
     .dimension = &dimension_length, .unit = "m", OPTION_POSITIVE, .flags = OPTION_ABOVE_LOWEST,
     .fallback = "inf", .value = "LENGTH", .wants = "near",
     .help = "farthest point that must be sharp"},
};

struct diffraction_row {
    struct diffraction_setting setting;
    struct diffraction airy;
    struct diffraction_mtf mtf;
    struct diffraction_angles angles;
    struct diffraction_optimum optimum;
    double wavelength, pitch, coc, pixels, film, frequency; /* mm */
    double focal, near, far, spread;
    double mtf50, mtf10;
    double fnumber_pixel, fnumber_coc, fnumber_film;
    struct photo_real real;
    const char *sensor, *criterion;
};

#define LENGTH(member_name, in_unit)                                                               \
    COLUMN(struct diffraction_row, member_name), .dimension = &dimension_length, .unit = in_unit
#define FREQUENCY(member_name)                                                                     \
    COLUMN(struct diffraction_row, member_name), .dimension = &dimension_frequency, .unit = "per_mm"
#define ANGLE(member_name)                                                                         \
    COLUMN(struct diffraction_row, member_name), .dimension = &dimension_angle, .unit = "arcsec"

#define COLUMN_CUTOFF(more)                                                                        \
    {                                                                                              \
        FREQUENCY(airy.cutoff), .name = "cutoff", .flags = (more), .symbol = "nu0",                \
                                .label = "cut-off frequency",                                      \
                                .help = "where the contrast of a perfect lens ends"                \
    }
#define COLUMN_NYQUIST                                                                             \
    {                                                                                              \
        FREQUENCY(airy.nyquist), .name = "nyquist",                                                \
                                 .when = "with --pitch, or a camera of known pixels",              \
                                 .symbol = "Ny", .label = "Nyquist frequency of the pixels",       \
                                 .help = "finest pattern the pixels can record"                    \
    }
/* What contrast and Airy disc have in common. */
#define COLUMNS_ASSUMED                                                                            \
    COLUMN_WAVELENGTH(struct diffraction_row, wavelength),                                         \
        {COLUMN(struct diffraction_row, setting.m),                                                \
         .name = "magnification",                                                                  \
         .flags = COLUMN_ASSUMED | COLUMN_EXTRA | COLUMN_ECHO,                                     \
         .symbol = "m",                                                                            \
         .depends = "magnification",                                                               \
         .label = "magnification",                                                                 \
         .help = "size on the sensor over size of the subject"},                                   \
        COLUMN_PUPIL(struct diffraction_row, setting.P),                                           \
        COLUMN_SENSOR(struct diffraction_row, sensor),                                             \
    {                                                                                              \
        LENGTH(pitch, "um"), .name = "pitch", .flags = COLUMN_ASSUMED | COLUMN_EXTRA,              \
                             .symbol = "p", .depends = "pitch sensor", .label = "pixel pitch",     \
                             .help = "distance from pixel to pixel"                                \
    }
/* What --near or --focus-spread bring. */
#define COLUMNS_SPREAD(more)                                                                       \
    {LENGTH(spread, "mm"),                                                                         \
     .name = "focus_spread",                                                                       \
     .when = "with --near or --focus-spread",                                                      \
     .flags = (more),                                                                              \
     .symbol = "dv",                                                                               \
     .label = "focus spread",                                                                      \
     .help = "between the images of nearest and farthest point"},                                  \
        {COLUMN(struct diffraction_row, optimum.fnumber),                                          \
         .name = "optimum_fnumber",                                                                \
         .when = "with --near or --focus-spread",                                                  \
         .flags = (more),                                                                          \
         .symbol = "No",                                                                           \
         .label = "best f-number",                                                                 \
         .help = "sharpest ends of the focus spread"},                                             \
    {                                                                                              \
        LENGTH(optimum.blur, "um"), .name = "optimum_blur",                                        \
                                    .when = "with --near or --focus-spread", .flags = (more),      \
                                    .symbol = "bo", .label = "blur at the best f-number",          \
                                    .help = "defocus and Airy disc at the ends, combined"          \
    }

static const struct column columns[] = {
    PHOTO_LENS_COLUMNS(struct diffraction_row, real),
    COLUMN_FNUMBER(struct diffraction_row, setting.N, 0),
    {COLUMN(struct diffraction_row, airy.working_fnumber), .name = "working_fnumber",
     .symbol = "Nw", .label = "working f-number", .help = "f-number that diffracts, N (1 + m/P)"},
    {LENGTH(airy.airy_diameter, "um"), .name = "airy_diameter", .flags = COLUMN_BRIEF,
     .symbol = "A", .label = "Airy disc, diameter", .help = "to the first dark ring"},
    {LENGTH(airy.airy_radius, "um"), .name = "airy_radius", .symbol = "a",
     .label = "Airy disc, radius", .help = "Rayleigh: two points this far apart are just resolved"},
    {FREQUENCY(airy.rayleigh_frequency), .name = "resolution", .flags = COLUMN_BRIEF, .symbol = "R",
     .label = "resolution by Rayleigh", .help = "1 / Airy radius"},
    COLUMN_CUTOFF(COLUMN_BRIEF),
    COLUMN_NYQUIST,
    {FREQUENCY(mtf50), .name = "mtf50", .flags = COLUMN_BRIEF, .label = "MTF50, 50 % contrast at",
     .help = "frequency of 50 % contrast: lens, defocus and pixels together"},
    {FREQUENCY(mtf10), .name = "mtf10", .label = "MTF10, 10 % contrast at",
     .help = "frequency of 10 % contrast"},
    {COLUMN(struct diffraction_row, fnumber_pixel), .name = "fnumber_pixel",
     .when = "with --pitch, or a camera of known pixels", .symbol = "Np",
     .label = "f-number of the pixels", .help = "where the Airy disc is --pixels wide"},
    {COLUMN(struct diffraction_row, fnumber_coc), .name = "fnumber_coc", .symbol = "Nc",
     .label = "f-number of the circle of confusion",
     .help = "where the Airy disc is as wide as the circle of confusion"},
    {COLUMN(struct diffraction_row, fnumber_film), .name = "fnumber_film", .when = "with --film",
     .symbol = "Nf", .label = "f-number of the film",
     .help = "where the Rayleigh limit is that of --film"},
    COLUMNS_SPREAD(0),
    {ANGLE(angles.rayleigh), .name = "rayleigh", .with = "focal-length lens", .symbol = "th",
     .label = "Rayleigh angle", .help = "smallest angle resolved at infinity"},
    {ANGLE(angles.dawes), .name = "dawes", .with = "focal-length lens", .label = "Dawes' limit",
     .help = "two stars just resolved, an empirical rule"},
    {FREQUENCY(frequency), .name = "frequency", .flags = COLUMN_EXTRA | COLUMN_ECHO,
     .with = "frequency", .symbol = "nu", .label = "spatial frequency",
     .help = "frequency on the sensor"},
    {COLUMN(struct diffraction_row, mtf.lens), .name = "mtf_lens", .flags = COLUMN_EXTRA,
     .with = "frequency", .symbol = "M", .label = "contrast, lens",
     .help = "perfect lens in focus"},
    {COLUMN(struct diffraction_row, mtf.total), .name = "mtf_total", .flags = COLUMN_EXTRA,
     .with = "frequency", .label = "combined MTF", .help = "lens, defocus and pixels"},
    COLUMN_COC(struct diffraction_row, coc, 0, ""),
    COLUMN_CRITERION(struct diffraction_row, criterion),
    {COLUMN(struct diffraction_row, pixels), .name = "pixels", .symbol = "k",
     .flags = COLUMN_EXTRA | COLUMN_ECHO, .with = "pixels", .label = "pixels across the Airy disc",
     .help = "width of the Airy disc that fnumber_pixel allows"},
    {FREQUENCY(film), .name = "film", .symbol = "Rf", .flags = COLUMN_EXTRA | COLUMN_ECHO,
     .with = "film", .label = "film", .help = "what the film resolves"},
    {LENGTH(setting.blur, "um"), .name = "defocus", .flags = COLUMN_EXTRA | COLUMN_ECHO,
     .with = "defocus", .symbol = "b", .label = "defocus", .help = "diameter of the blur disc"},
    COLUMNS_ASSUMED,
    PHOTO_LENS_WARNING_COLUMN(struct diffraction_row, real),
};

/* With --frequency: contrast alone, a row a frequency. */
static const struct column contrast_columns[] = {
    PHOTO_LENS_COLUMNS(struct diffraction_row, real),
    COLUMN_FNUMBER(struct diffraction_row, setting.N, 0),
    {FREQUENCY(frequency), .name = "frequency", .flags = COLUMN_ECHO | COLUMN_BRIEF,
     .with = "frequency", .symbol = "nu", .label = "spatial frequency",
     .help = "frequency on the sensor"},
    {COLUMN(struct diffraction_row, mtf.lens), .name = "mtf_lens", .flags = COLUMN_BRIEF,
     .symbol = "Ml", .label = "contrast, lens", .help = "perfect lens in focus"},
    {COLUMN(struct diffraction_row, mtf.defocus), .name = "mtf_defocus", .flags = COLUMN_BRIEF,
     .symbol = "Md", .label = "contrast, defocus", .help = "disc of defocus alone"},
    {COLUMN(struct diffraction_row, mtf.pixel), .name = "mtf_pixel", .flags = COLUMN_BRIEF,
     .symbol = "Mp", .label = "contrast, pixels", .help = "square pixels without gaps alone"},
    {COLUMN(struct diffraction_row, mtf.total), .name = "mtf_total", .flags = COLUMN_BRIEF,
     .symbol = "M", .label = "combined MTF", .help = "the product"},
    {COLUMN(struct diffraction_row, airy.working_fnumber), .name = "working_fnumber",
     .symbol = "Nw", .label = "working f-number", .help = "f-number that diffracts, N (1 + m/P)"},
    COLUMN_CUTOFF(0),
    COLUMN_NYQUIST,
    {LENGTH(setting.blur, "um"), .name = "defocus",
     .flags = COLUMN_ASSUMED | COLUMN_EXTRA | COLUMN_ECHO, .symbol = "b", .depends = "defocus",
     .label = "defocus", .help = "diameter of the blur disc"},
    COLUMNS_ASSUMED,
    PHOTO_LENS_WARNING_COLUMN(struct diffraction_row, real),
};

/* Without --aperture, with --near or --focus-spread: the best f-number. */
static const struct column best_columns[] = {
    PHOTO_LENS_COLUMNS(struct diffraction_row, real),
    COLUMN_FOCAL(struct diffraction_row, focal, COLUMN_EXTRA),
    {LENGTH(near, "m"), .name = "near", .flags = COLUMN_ECHO | COLUMN_EXTRA, .with = "near",
     .symbol = "n", .label = "near point", .help = "nearest point that must be sharp"},
    {LENGTH(far, "m"), .name = "far", .flags = COLUMN_ECHO | COLUMN_EXTRA | COLUMN_INFINITE,
     .with = "near", .symbol = "r", .label = "far point", .help = "farthest point"},
    COLUMNS_SPREAD(COLUMN_BRIEF),
    COLUMNS_ASSUMED,
    PHOTO_LENS_WARNING_COLUMN(struct diffraction_row, real),
};

static const struct sheet best = SHEET(best_columns, struct diffraction_row);
static const struct sheet contrast = SHEET(contrast_columns, struct diffraction_row);
static const struct sheet all = SHEET(columns, struct diffraction_row);
static const struct sheet *const sheets[] = {&all, &best, &contrast, NULL};

static const struct sheet *diffraction_choose_sheet(const void *data,
                                                    const struct option_query *asking)
{
    (void)data;
    bool spread = asking_given(asking, "near") || asking_given(asking, "focus-spread");
    bool wants_best = spread && !asking_given(asking, "aperture");
    if (asking_given(asking, "frequency")) {
        return &contrast;
    }
    if (wants_best) {
        return &best;
    }
    return &all;
}

static double um_from_mm(double length)
{
    return 1000 * length;
}

/* Absent until computed. */
static const struct diffraction_row empty = {
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

/* Without an f-number the answer is the best one, to which what is sharp says nothing. */
static bool check_best(const struct diffraction_input *input, const struct sharpness *sharp,
                       struct error *error)
{
    const bool is_best =
        isnan(input->lens.fnumber) && (!isnan(input->near) || !isnan(input->focus_spread));
    const char *idle = !input->sharp.coc.is_fallback      ? "coc"
                       : sharp->coc.coc.kind == COC_PRINT ? "print"
                       : !isnan(input->film)              ? "film"
                       : input->defocus > 0               ? "defocus"
                                                          : NULL;
    return !is_best || idle == NULL ||
           fail(error, ERROR_USAGE,
                "{--%s} says nothing of the best f-number: give {--aperture} too", idle);
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

static bool diffraction_answer(const void *data, const struct photo_lens *lens, struct run *run,
                               struct error *error)
{
    const struct diffraction_input *input = data;
    struct sharpness implied;
    const struct sharpness *sharp = &implied;
    struct diffraction_row row = empty;
    if (!sharpness_imply(&input->sharp, PITCH_FOR_MORE, &implied, error) ||
        !check_best(input, sharp, error)) {
        return false;
    }
    sharpness_doubt_pitch(sharp, run->doubts);
    row.real = *lens->real;
    row.focal = lens->f;
    row.wavelength = lens->wavelength;
    row.pitch = sharpness_pitch(sharp);
    row.setting = (struct diffraction_setting){.N = lens->N,
                                               .m = input->magnification,
                                               .P = lens->P,
                                               .wavelength = um_from_mm(lens->wavelength),
                                               .blur = input->defocus,
                                               .pitch = isnan(row.pitch) ? 0 : row.pitch};
    row.pixels = input->pixels;
    row.film = input->film;
    row.frequency = input->frequency;
    row.sensor = sharp->sensor.name;
    row.criterion = sharp->coc.criterion;
    if (isnan(lens->N) && !isnan(input->frequency)) {
        return fail(error, ERROR_USAGE, "{--frequency} needs {--aperture}");
    }
    if (!sharpness_resolve_in(sharp, lens->wavelength,
                              diffracting_fnumber(lens->N, input->magnification, lens->P), &row.coc,
                              error) ||
        !compute_limits(input, &row, error) || !compute_optimum(input, &row, error)) {
        return false;
    }
    /* without an f-number there is still what limits it */
    if (!isnan(lens->N) && (!compute_airy(&row, error) || !compute_contrast(input, &row, error))) {
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
    {"diffraction -N 8 --frequency 10..100:10 --pitch 4um", "a table of contrast"},
    {"diffraction -N 16 -m 1:1", "life size: f/16 works as f/32"},
    {"diffraction --lens cooke-triplet-50", "a real lens wide open, in its own light"},
    {"diffraction -f 150 --near 2m --far inf --sensor 4x5", "the best f-number for a landscape"},
    {NULL, NULL},
};

PHOTO_LENS_MAKES_MANY(struct diffraction_input, lens)

const struct command command_diffraction = {
    .name = "diffraction",
    .group = "photography",
    .summary = "Airy disc, contrast (MTF), and the f-number where diffraction takes over",
    COMMAND_ASKS(struct diffraction_input),
    COMMAND_ANSWERS(struct diffraction_row),
    .run = diffraction_run,
    .choose_sheet = diffraction_choose_sheet,
    .sheets = sheets,
    .makes_many = makes_many,
    .varies = varies,
    .plot = "mtf_total|airy_diameter_um|fnumber",
    .cell = "airy_diameter_um",
};
