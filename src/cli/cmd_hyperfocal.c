/* cli/cmd_hyperfocal.c - lenscalc hyperfocal: the focus that keeps infinity sharp. */
/* SPDX-License-Identifier: MIT */
#include "cli/command.h"
#include "cli/sharpness.h"
#include "photo/dof.h"
#include "photo/dof_solve.h"

#include <math.h>

struct input {
    double focal, fnumber, pupil, hyperfocal;
    struct sharpness sharp;
};

static const struct option options[] = {
    OPTION_FOCAL_LENGTH(struct input, focal, OPTION_SETTING),
    OPTION_APERTURE(struct input, fnumber, OPTION_SETTING),
    SHARPNESS_OPTIONS(struct input, sharp, 0, "d/1500"),
    OPTION_PUPIL(struct input, pupil),
    {OPTION(struct input, hyperfocal), .name = "hyperfocal", .column = "hyperfocal",
     .dimension = &dimension_length, .unit = "m", OPTION_POSITIVE,
     .flags = OPTION_ABOVE_LOWEST | OPTION_NO_INFINITY | OPTION_GOAL, .value = "LENGTH",
     .help = "wanted hyperfocal distance: solves for focal length or f-number"},
};

struct row {
    double focal, fnumber, coc, pupil, wavelength, hyperfocal, near;
    const char *sensor, *criterion;
};

#define LENGTH(member_name, in_unit)                                                               \
    COLUMN(struct row, member_name), .dimension = &dimension_length, .unit = in_unit

static const struct column columns[] = {
    {LENGTH(focal, "mm"), .name = "focal", .flags = COLUMN_ECHO | COLUMN_BRIEF,
     .with = "focal-length", .symbol = "f", .label = "focal length", .help = "focal length"},
    {COLUMN(struct row, fnumber), .name = "fnumber", .flags = COLUMN_ECHO | COLUMN_BRIEF,
     .with = "aperture", .symbol = "N", .label = "f-number", .help = "f-number"},
    {COLUMN(struct row, sensor), .name = "sensor", .flags = COLUMN_ASSUMED | COLUMN_EXTRA,
     .depends = "sensor", .label = "sensor", .help = "format or camera"},
    {LENGTH(coc, "mm"), .name = "coc", .flags = COLUMN_ASSUMED, .symbol = "c",
     .depends = SHARPNESS_DEPENDS, .label = "circle of confusion",
     .help = "circle of confusion, diameter on the sensor"},
    {COLUMN(struct row, criterion), .name = "coc_criterion", .symbol = "criterion",
     .flags = COLUMN_ASSUMED | COLUMN_EXTRA, .depends = "coc", .label = "criterion",
     .help = "where the circle of confusion comes from"},
    {LENGTH(wavelength, "nm"), .name = "wavelength",
     .flags = COLUMN_ASSUMED | COLUMN_EXTRA | COLUMN_ECHO, .depends = "wavelength",
     .label = "wavelength", .help = "of the light that makes the Airy disc"},
    {LENGTH(hyperfocal, "m"), .name = "hyperfocal", .flags = COLUMN_INFINITE | COLUMN_BRIEF,
     .symbol = "H", .label = "hyperfocal distance",
     .help = "nearest focus that keeps infinity sharp, from the front principal plane"},
    {LENGTH(near, "m"), .name = "near", .flags = COLUMN_INFINITE | COLUMN_BRIEF, .symbol = "n",
     .label = "near limit there", .help = "near limit when focused at the hyperfocal distance"},
    {COLUMN(struct row, pupil), .name = "pupil_magnification", .symbol = "P",
     .flags = COLUMN_ASSUMED | COLUMN_EXTRA | COLUMN_ECHO, .depends = "pupil",
     .label = "pupil magnification", .help = "diameter of the exit over the entrance pupil"},
};

static bool run(const void *data, struct run *run, struct error *error)
{
    const struct input *input = data;
    const struct dof_targets targets = {NAN, NAN, NAN, input->hyperfocal, NAN};
    struct dof_setting setting = {input->focal, input->fnumber, 0, INFINITY, input->pupil};
    if (isnan(input->focal) + isnan(input->fnumber) + isnan(input->hyperfocal) != 1) {
        return fail(error, ERROR_USAGE,
                    "give two of --focal-length, --aperture and --hyperfocal, and the third is "
                    "found");
    }
    if (!sharpness_resolve(&input->sharp, setting.N, &setting.c, error) ||
        !dof_solve(&setting, &targets, error) || !dof_check(&setting, error)) {
        return false;
    }
    struct row row = {
        .focal = setting.f,
        .fnumber = setting.N,
        .coc = setting.c,
        .pupil = setting.P,
        .wavelength = sharpness_wavelength(&input->sharp),
        .hyperfocal = dof_hyperfocal(setting.f, setting.N, setting.c),
        .near = dof_near_at_hyperfocal(setting.f, setting.N, setting.c, setting.P),
        .sensor = input->sharp.sensor.name,
        .criterion = input->sharp.coc.criterion,
    };
    run_emit(run, &row);
    return true;
}

static const struct explanation explanations[] = {
    {"coc", "c = {criterion}", "criterion of sharpness, see --coc",
     "what counts as sharp is a convention"},
    {"hyperfocal", "H = {f}^2/({N} {c}) + {f}", "[Ray02]; thin lens, exact",
     "without + f it is low by exactly f"},
    {"near", "n = {f} (1 - 1/{P}) + ({f} + {f}/{P} {N} {c}/{f})/(2 {N} {c}/{f})",
     "[Ray02]; near limit at m = N c/f", "H/2 exactly where P is 1"},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"hyperfocal -f 28mm -N 8", "one lens, one f-number"},
    {"hyperfocal -f 24,35,50,85 -N 2.8..22 --table N,f", "a table to print"},
    {"hyperfocal -f 35mm --hyperfocal 5m", "the f-number for a hyperfocal distance of 5 m"},
    {NULL, NULL},
};

const struct command command_hyperfocal = {
    .name = "hyperfocal",
    .group = "photography",
    .summary = "hyperfocal distance and the near limit beside it",
    .examples = examples,
    .options = options,
    .option_count = sizeof options / sizeof options[0],
    .input_size = sizeof(struct input),
    .sheet = {columns, sizeof columns / sizeof columns[0], sizeof(struct row)},
    .run = run,
    .explanations = explanations,
    .plot = "hyperfocal_m,near_m",
    .cell = "hyperfocal_m+near_m",
};
