/* commands/photo/cmd_hyperfocal.c - lenscalc hyperfocal: the focus that keeps infinity sharp. */
/* SPDX-License-Identifier: MIT */
#include "commands/photo/by_rays.h"
#include "commands/photo/photo_lens.h"
#include "commands/photo/sharpness.h"
#include "commands/tables.h"
#include "photo/dof.h"
#include "photo/dof_solve.h"

#include <math.h>

struct hyperfocal_input {
    double hyperfocal, near; /* wanted */
    struct photo_lens_question lens;
    struct sharpness sharp;
    double squeeze;
};

#define INPUT struct hyperfocal_input

static const struct option options[] = {
    OPTION_FOCAL_LENGTH(lens.focal, OPTION_SETTING | OPTION_OF_CAMERA),
    PHOTO_LENS_OPTIONS(lens),
    OPTION_APERTURE(lens.fnumber, OPTION_SETTING),
    SHARPNESS_OPTIONS_OF_LENS(sharp, lens, 0, "d/1500", coc_is_pixels),
    OPTION_PUPIL_OF_LENS(lens.pupil, NULL),
    {MEASURE(hyperfocal, length, "m", "LENGTH"), REPEATED("hyperfocal"),
     .quantity = "hyperfocal distance", ABOVE_0 | OPTION_GOAL,
     .help = "wanted hyperfocal distance: solves for focal length or f-number"},
    {MEASURE(near, length, "m", "LENGTH"), REPEATED("near"), .quantity = "near limit",
     ABOVE_0 | OPTION_GOAL,
     .help = "wanted near limit with the focus there, in place of --hyperfocal"},
    OPTION_SQUEEZE(squeeze, NULL,
                   "anamorphic squeeze: adds the horizontal focal length; -f is the marked one"),
    BY_RAYS_EXACT_OPTION(lens.rays, "from the exact rays of --lens, aberrations included"),
    BY_RAYS_CRITERION_OPTION(lens.rays),
};

struct hyperfocal_row {
    double focal, fnumber, coc, pupil, wavelength, hyperfocal, near, image;
    double sensor_hyperfocal, sensor_near; /* from the sensor */
    double squeeze, horizontal_focal;
    struct photo_real real;
    struct by_rays_row rays;
    const char *sensor, *criterion;
};

#define ROW struct hyperfocal_row

static const struct column columns[] = {
    PHOTO_LENS_COLUMNS(real),
    COLUMN_FOCAL(focal, COLUMN_BRIEF),
    COLUMN_FNUMBER(fnumber, COLUMN_BRIEF),
    COLUMN_SENSOR(sensor),
    COLUMN_COC(coc, 0, SHARPNESS_WISHES),
    COLUMN_CRITERION(criterion),
    COLUMN_WAVELENGTH(wavelength),
    {LENGTH(hyperfocal, "m"), .name = "hyperfocal", BRIEF | COLUMN_INFINITE, .symbol = "H",
     .label = "hyperfocal distance",
     .help = "nearest focus that keeps infinity sharp, from the front principal plane"},
    {LENGTH(near, "m"), .name = "near", BRIEF | COLUMN_INFINITE, .symbol = "n",
     .label = "near limit", .help = "near limit when focused at the hyperfocal distance"},
    {LENGTH(sensor_hyperfocal, "m"), .name = "hyperfocal_sensor",
     BRIEF_WITH("lens") | COLUMN_INFINITE, .symbol = "Hs",
     .label = "hyperfocal distance from the sensor",
     .help = "hyperfocal distance as a distance scale has it, from the sensor"},
    {LENGTH(sensor_near, "m"), .name = "near_sensor", BRIEF_WITH("lens") | COLUMN_INFINITE,
     .label = "near limit from the sensor", .help = "near limit, from the sensor"},
    {LENGTH(image, "mm"), .name = "image", .flags = COLUMN_EXTRA | COLUMN_INFINITE, .symbol = "v",
     .label = "image distance", .help = "sensor from the rear principal plane"},
    BY_RAYS_COLUMNS(rays),
    {LENGTH(horizontal_focal, "mm"), .name = "horizontal_focal", WITH("squeeze"), .symbol = "fh",
     .label = "horizontal focal length", .help = "focal length across the picture, by the squeeze"},
    PHOTO_LENS_HIATUS_COLUMN(real.hiatus),
    COLUMN_PUPIL(pupil),
    COLUMN_SQUEEZE(squeeze),
    PHOTO_LENS_WARNING_COLUMN(real),
};

/* What is wanted, as a hyperfocal distance; NaN: nothing is. */
static double hyperfocal_wanted(const struct hyperfocal_input *input,
                                const struct dof_setting *setting)
{
    return isnan(input->near) ? input->hyperfocal
                              : dof_hyperfocal_of_near(setting->f, setting->P,
                                                       setting->N * setting->c, input->near);
}

/* The Airy disc grows with the magnification at that distance: in turn till they agree. */
static bool hyperfocal_solve(const struct hyperfocal_input *input, const struct sharpness *sharp,
                             const struct photo_lens *lens, struct dof_setting *setting,
                             struct error *error)
{
    const struct dof_setting given = *setting;
    struct dof_targets targets = {NAN, NAN, NAN, NAN, NAN};
    double m = 0;
    for (int turn = 0; turn < 200; turn++) {
        *setting = given;
        if (!sharpness_resolve_in(sharp, lens->wavelength, diffracting_fnumber(given.N, m, given.P),
                                  &setting->c, error)) {
            return false;
        }
        targets.hyperfocal = hyperfocal_wanted(input, setting);
        if (!dof_solve(setting, &targets, error) || !dof_check(setting, error)) {
            return false;
        }
        double next = setting->N * setting->c / setting->f;
        if (!sharpness_is_airy(sharp) || fabs(next - m) <= 4e-16 * next) {
            return true;
        }
        m = next;
    }
    return fail(error, ERROR_DOMAIN,
                "no hyperfocal distance agrees with the Airy disc that belongs to it: give {--coc} "
                "as a length");
}

/* By the rays of the lens in place of what formulas gave. */
static bool hyperfocal_find_by_rays(const struct hyperfocal_input *input,
                                    const struct photo_lens *lens, double c, struct run *run,
                                    struct hyperfocal_row *row, struct error *error)
{
    const double front = lens->measuring.front;
    double blur;
    struct real_focus focus;
    struct real_range range;
    const char *other =
        SAID_FIRST({!isnan(input->near), "near"}, {!isnan(input->hyperfocal), "hyperfocal"},
                   {!isnan(input->squeeze), "squeeze"});
    if (other != NULL) {
        return fail(error, ERROR_USAGE,
                    "{--exact} answers for a lens and an f-number: it excludes {--%s}", other);
    }
    if (!by_rays_open(&input->lens, lens, INFINITY, c, run, &focus, &row->rays, error) ||
        !real_range_hyperfocal(&focus, front, c, &row->hyperfocal, &blur, error)) {
        return false;
    }
    if (isnan(row->hyperfocal)) {
        return fail(error, ERROR_DOMAIN,
                    "infinity is never sharp: even its sharpest image is as blurred as a disc of "
                    "%.4g mm, the circle of confusion is %.4g mm",
                    blur, c);
    }
    if (!real_range_find(&focus, front, row->hyperfocal, c, &range, error)) {
        return false;
    }
    row->near = range.near;
    row->image = range.film - lens->real->rear;
    row->rays.blur = range.blur;
    return true;
}

static bool hyperfocal_answer(const void *data, const struct photo_lens *lens, struct run *run,
                              struct error *error)
{
    const struct hyperfocal_input *input = data;
    struct dof_setting setting = {lens->f, lens->N, 0, INFINITY, lens->P};
    if (!isnan(input->near) && !isnan(input->hyperfocal)) {
        return fail(error, ERROR_USAGE, "give only one of {--hyperfocal} and {--near}");
    }
    bool aimless = isnan(input->hyperfocal) && isnan(input->near);
    if (isnan(lens->f) + isnan(lens->N) + aimless != 1) {
        return fail(
            error, ERROR_USAGE,
            "give two of {--focal-length}, {--aperture} and {--hyperfocal} (or {--near}), and the "
            "third is found");
    }
    struct sharpness sharp = input->sharp;
    if (!sharpness_settle(&sharp, PITCH_FOR_COC, run->doubts, error) ||
        !hyperfocal_solve(input, &sharp, lens, &setting, error)) {
        return false;
    }
    struct hyperfocal_row row = {
        .focal = setting.f,
        .fnumber = setting.N,
        .coc = setting.c,
        .pupil = setting.P,
        .wavelength = photo_lens_light(lens, sharpness_is_airy(&input->sharp)),
        .hyperfocal = dof_hyperfocal(setting.f, setting.N, setting.c),
        .near = dof_near_at_hyperfocal(setting.f, setting.N, setting.c, setting.P),
        .squeeze = input->squeeze,
        .horizontal_focal = setting.f / input->squeeze,
        .real = *lens->real,
        .rays = by_rays_none,
        .sensor = input->sharp.sensor.name,
        .criterion = sharp.coc.criterion,
    };
    row.image = distance_image(setting.f, row.hyperfocal);
    if (input->lens.rays.exact &&
        !hyperfocal_find_by_rays(input, lens, setting.c, run, &row, error)) {
        return false;
    }
    double to_sensor = row.image + lens->measuring.hiatus;
    row.sensor_hyperfocal = row.hyperfocal + to_sensor;
    row.sensor_near = row.near + to_sensor;
    run_emit(run, &row);
    return true;
}

static bool hyperfocal_run(const void *data, struct run *run, struct error *error)
{
    const struct hyperfocal_input *input = data;
    bool aimless = isnan(input->hyperfocal) && isnan(input->near);
    return photo_lens_each(&input->lens, aimless ? 0 : PHOTO_LENS_SOLVES_FNUMBER, run,
                           hyperfocal_answer, input, error);
}

static const struct explanation explanations[] = {
    {"coc", "c = {criterion}", "criterion of sharpness, see --coc",
     "what counts as sharp is a convention"},
    {"hyperfocal !blur_rule", "H = {f}^2/({N} {c}) + {f}", "[Ray02]; thin lens, exact",
     "without + f it is low by exactly f"},
    {"hyperfocal_sensor", "Hs = {H} + {v} + {HH'}",
     "[Gauss41] HH' from the front to the rear principal plane", NULL},
    {"near !blur_rule", "n = {f} (1 - 1/{P}) + ({f} + {f}/{P} {N} {c}/{f})/(2 {N} {c}/{f})",
     "[Ray02]; near limit at m = N c/f", "H/2 exactly where P is 1"},
    {"hyperfocal blur_rule",
     "H = distance whose sharpest image lies on the film where infinity blurs c", "exact rays",
     "its blur is measured as blur_rule says"},
    {"near blur_rule", "n = distance where the blur on that film grows to c", "exact rays", NULL},
    {"horizontal_focal", "fh = {f}/{q}", "cylinders in front of the lens",
     "sharpness is that of f: a blur is narrower than high"},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"hyperfocal -f 28mm -N 8", "one lens, one f-number"},
    {"hyperfocal -f 24,35,50,85 -N 2.8..22 --table N,f", "a table to print"},
    {"hyperfocal -f 35mm --hyperfocal 5m", "the f-number for a hyperfocal distance of 5 m"},
    {"hyperfocal -f 24mm --near 1m", "the f-number that is sharp from 1 m to infinity"},
    {"hyperfocal -f 40mm -N 2.8 --squeeze 2 --sensor scope", "anamorphic cinema"},
    {"hyperfocal --lens wide-35 -N 8", "a real lens: what to set on its distance scale"},
    {"hyperfocal --lens wide-35 -N 8 --exact", "and from its exact rays"},
    {NULL, NULL},
};

PHOTO_LENS_MAKES_MANY(lens)

BY_RAYS_WEIGHT(lens.rays)

const struct command command_hyperfocal = {
    .name = "hyperfocal",
    .stop_size_wants = "exact",
    COMMAND_OF("photography", "hyperfocal distance and its near limit"),
    .run = hyperfocal_run,
    .makes_many = makes_many,
    .varies = varies,
    .weight = weight,
    .plot = "hyperfocal_m,near_m",
    .plot_titles = "Hyperfocal distance",
    .zone = "near|near_sensor",
    .cell = "hyperfocal_m+near_m",
};
