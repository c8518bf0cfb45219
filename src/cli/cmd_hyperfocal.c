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
    COLUMN_FOCAL(struct row, focal, COLUMN_BRIEF),
    COLUMN_FNUMBER(struct row, fnumber, COLUMN_BRIEF),
    COLUMN_SENSOR(struct row, sensor),
    COLUMN_COC(struct row, coc, 0, SHARPNESS_WISHES),
    COLUMN_CRITERION(struct row, criterion),
    COLUMN_WAVELENGTH(struct row, wavelength),
    {LENGTH(hyperfocal, "m"), .name = "hyperfocal", .flags = COLUMN_INFINITE | COLUMN_BRIEF,
     .symbol = "H", .label = "hyperfocal distance",
     .help = "nearest focus that keeps infinity sharp, from the front principal plane"},
    {LENGTH(near, "m"), .name = "near", .flags = COLUMN_INFINITE | COLUMN_BRIEF, .symbol = "n",
     .label = "near limit there", .help = "near limit when focused at the hyperfocal distance"},
    COLUMN_PUPIL(struct row, pupil),
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
    COMMAND_ASKS(struct input),
    COMMAND_ANSWERS(struct row),
    .plot = "hyperfocal_m,near_m",
    .cell = "hyperfocal_m+near_m",
};
