/* commands/photo/cmd_dof.c - lenscalc dof: depth of field. */
/* SPDX-License-Identifier: MIT */
#include "base/arena.h"
#include "commands/photo/photo_lens.h"
#include "commands/photo/sharpness.h"
#include "draw/barrel.h"
#include "photo/dof.h"
#include "photo/dof_plan.h"

#include <math.h>

struct input {
    double distance;
    struct photo_lens_question lens;
    struct sharpness sharp;
    int model;
    struct dof_targets targets;
    bool stack;
    double overlap;
    struct sensor_value other;
};

#define GOAL(member_name)                                                                          \
    OPTION(struct input, targets.member_name), .flags = OPTION_ABOVE_LOWEST | OPTION_GOAL,         \
                                               OPTION_POSITIVE
#define GOAL_LENGTH(member_name)                                                                   \
    GOAL(member_name), .dimension = &dimension_length, .unit = "m", .value = "LENGTH"

static const struct option options[] = {
    OPTION_FOCAL_LENGTH(struct input, lens.focal, OPTION_SETTING),
    PHOTO_LENS_OPTIONS(struct input, lens),
    OPTION_APERTURE(struct input, lens.fnumber, OPTION_SETTING),
    OPTION_DISTANCE(struct input, distance, OPTION_SETTING,
                    "distance of the subject; inf for stars"),
    SHARPNESS_OPTIONS_OF_LENS(struct input, sharp, lens, 0, "d/1500", coc_is_pixels),
    OPTION_PUPIL_OF_LENS(struct input, lens.pupil, NULL),
    OPTION_FROM(struct input, lens.from, distances_from),
    {OPTION(struct input, model), .name = "model", .column = "model", .words = dof_models,
     .fallback = "exact", .value = "MODEL",
     .help = "exact formulas, or a short cut that other programs use"},
    {GOAL_LENGTH(near), .name = "near", .quantity = "near limit", .column = "near",
     .help = "wanted near limit: solves for what is not given"},
    {GOAL_LENGTH(far), .name = "far", .quantity = "far limit", .column = "far",
     .help = "wanted far limit; may be inf"},
    {GOAL_LENGTH(total), .name = "dof", .quantity = "depth of field", .column = "dof",
     .help = "wanted depth of field"},
    {GOAL_LENGTH(hyperfocal), .name = "hyperfocal", .quantity = "hyperfocal distance",
     .column = "hyperfocal", .help = "wanted hyperfocal distance"},
    {OPTION(struct input, targets.magnification), .name = "magnification", .letter = 'm',
     .column = "magnification", .dimension = &dimension_ratio, .lowest = 0, .highest = INFINITY,
     .flags = OPTION_NO_INFINITY | OPTION_GOAL, .value = "RATIO",
     .help = "wanted magnification: 1:2 or 0.5"},
    {OPTION(struct input, stack), .name = "stack",
     .help = "plan a focus stack from --near to --far, one row a shot"},
    {OPTION(struct input, overlap), .name = "overlap", .wants = "stack",
     .dimension = &dimension_ratio, .lowest = 0, .highest = 0.95, .fallback = "0.2",
     .value = "FRACTION",
     .help = "part of each shot's depth that the next one covers again, for --stack"},
    {OPTION(struct input, other), .name = "equal-on", .value = "NAME|WxH",
     .help = "focal length and f-number for the same picture on another format"},
};

struct row {
    struct dof_setting setting;
    struct dof dof;
    struct photo_real real;
    double distance;
    double sensor_distance, sensor_near, sensor_far; /* from the sensor */
    double wavelength;                               /* NaN where it does not matter */
    const char *sensor, *criterion, *model, *from;
    long shot, shots;
    const char *other_sensor;
    double other_focal, other_fnumber, other_coc;
};

#define COLUMN_LENGTH(member_name, in_unit)                                                        \
    COLUMN(struct row, member_name), .dimension = &dimension_length, .unit = in_unit

static const struct column columns[] = {
    PHOTO_LENS_COLUMNS(struct row, real),
    {COLUMN(struct row, shot), .name = "shot", .flags = COLUMN_EXTRA | COLUMN_ECHO, .with = "stack",
     .label = "shot", .help = "number of the shot in a focus stack, nearest first"},
    {COLUMN(struct row, shots), .name = "shots", .flags = COLUMN_EXTRA, .label = "shots",
     .help = "number of shots in the focus stack"},
    COLUMN_FOCAL(struct row, setting.f, 0),
    COLUMN_FNUMBER(struct row, setting.N, 0),
    {COLUMN_LENGTH(distance, "m"), .name = "distance",
     .flags = COLUMN_ECHO | COLUMN_INFINITE | COLUMN_BRIEF, .with = "distance", .label = "distance",
     .help = "distance of the subject"},
    COLUMN_SENSOR(struct row, sensor),
    COLUMN_COC(struct row, setting.c, 0, SHARPNESS_WISHES),
    COLUMN_CRITERION(struct row, criterion),
    COLUMN_WAVELENGTH(struct row, wavelength),
    {COLUMN_LENGTH(dof.hyperfocal, "m"), .name = "hyperfocal", .flags = COLUMN_INFINITE,
     .symbol = "H", .label = "hyperfocal distance",
     .help = "nearest focus that keeps infinity sharp, from the front principal plane"},
    {COLUMN_LENGTH(dof.near, "m"), .name = "near", .flags = COLUMN_INFINITE | COLUMN_BRIEF,
     .symbol = "n", .label = "near limit", .help = "nearest sharp distance",
     .condition = offsetof(struct row, dof.near_condition)},
    {COLUMN_LENGTH(dof.far, "m"), .name = "far", .flags = COLUMN_INFINITE | COLUMN_BRIEF,
     .symbol = "r", .label = "far limit", .help = "farthest sharp distance",
     .condition = offsetof(struct row, dof.far_condition)},
    {COLUMN_LENGTH(dof.front, "m"), .name = "front", .flags = COLUMN_INFINITE | COLUMN_BRIEF,
     .symbol = "front", .label = "in front of the subject",
     .help = "depth of field before the subject"},
    {COLUMN_LENGTH(dof.behind, "m"), .name = "behind", .flags = COLUMN_INFINITE | COLUMN_BRIEF,
     .symbol = "behind", .label = "behind the subject", .help = "depth of field behind the subject",
     .condition = offsetof(struct row, dof.far_condition)},
    {COLUMN_LENGTH(dof.total, "m"), .name = "dof", .flags = COLUMN_INFINITE | COLUMN_BRIEF,
     .symbol = "T", .label = "depth of field", .help = "front and behind together",
     .condition = offsetof(struct row, dof.far_condition)},
    {COLUMN_LENGTH(sensor_distance, "m"), .name = "distance_sensor",
     .flags = COLUMN_EXTRA | COLUMN_INFINITE | COLUMN_BRIEF, .with = "lens", .symbol = "Ds",
     .label = "distance from the sensor", .help = "distance of the subject from the sensor"},
    {COLUMN_LENGTH(sensor_near, "m"), .name = "near_sensor",
     .flags = COLUMN_EXTRA | COLUMN_INFINITE | COLUMN_BRIEF, .with = "lens",
     .label = "near limit from the sensor", .help = "nearest sharp distance, from the sensor",
     .condition = offsetof(struct row, dof.near_condition)},
    {COLUMN_LENGTH(sensor_far, "m"), .name = "far_sensor",
     .flags = COLUMN_EXTRA | COLUMN_INFINITE | COLUMN_BRIEF, .with = "lens",
     .label = "far limit from the sensor", .help = "farthest sharp distance, from the sensor",
     .condition = offsetof(struct row, dof.far_condition)},
    COLUMN_MAGNIFICATION(struct row, dof.magnification, 0),
    {COLUMN_LENGTH(dof.depth_of_focus, "mm"), .name = "depth_of_focus", .symbol = "t",
     .label = "depth of focus", .help = "tolerance of the sensor's place, both sides together"},
    {COLUMN_LENGTH(dof.blur_at_infinity, "mm"), .name = "blur_at_infinity", .symbol = "b",
     .label = "blur of the background", .help = "blur disc of a point at infinity, on the sensor"},
    {COLUMN(struct row, dof.working_fnumber), .name = "working_fnumber", .symbol = "Nw",
     .label = "working f-number", .help = "f-number that exposes, N (1 + m/P)"},
    {COLUMN_LENGTH(dof.image, "mm"), .name = "image", .flags = COLUMN_INFINITE | COLUMN_HIDDEN,
     .symbol = "v", .label = "image distance",
     .help = "image of the subject, from the rear principal plane"},
    {COLUMN_LENGTH(dof.image_near, "mm"), .name = "image_near",
     .flags = COLUMN_INFINITE | COLUMN_HIDDEN, .label = "image of the near limit",
     .help = "image of the near limit, from the rear principal plane"},
    {COLUMN_LENGTH(dof.image_far, "mm"), .name = "image_far",
     .flags = COLUMN_INFINITE | COLUMN_HIDDEN, .label = "image of the far limit",
     .help = "image of the far limit, from the rear principal plane"},
    {COLUMN(struct row, dof.near_vergence), .dimension = &dimension_vergence, .unit = "diopter",
     .name = "near", .flags = COLUMN_HIDDEN, .label = "near limit, reciprocal",
     .help = "1 / near limit"},
    {COLUMN(struct row, dof.far_vergence), .dimension = &dimension_vergence, .unit = "diopter",
     .name = "far", .flags = COLUMN_HIDDEN, .label = "far limit, reciprocal",
     .help = "1 / far limit; 0 at infinity"},
    {COLUMN(struct row, other_sensor), .name = "equal_sensor", .flags = COLUMN_EXTRA,
     .with = "equal-on", .label = "other format", .help = "the format of the equal picture"},
    {COLUMN_LENGTH(other_focal, "mm"), .name = "equal_focal", .flags = COLUMN_EXTRA | COLUMN_BRIEF,
     .with = "equal-on", .label = "equivalent focal length",
     .help = "focal length with the same framing on the other format"},
    {COLUMN(struct row, other_fnumber), .name = "equal_fnumber",
     .flags = COLUMN_EXTRA | COLUMN_BRIEF, .with = "equal-on", .label = "f-number there",
     .help = "f-number with the same depth of field on the other format"},
    {COLUMN_LENGTH(other_coc, "mm"), .name = "equal_coc", .flags = COLUMN_EXTRA, .with = "equal-on",
     .label = "circle of confusion there",
     .help = "circle of confusion in proportion to the other format"},
    COLUMN_PUPIL(struct row, setting.P),
    {COLUMN(struct row, model), .name = "model", .flags = COLUMN_ASSUMED | COLUMN_EXTRA,
     .depends = "model", .label = "model", .help = "the formulas that were used"},
    COLUMN_FROM(struct row, from),
    PHOTO_LENS_HIATUS_COLUMN(struct row, real.hiatus),
    {COLUMN_LENGTH(setting.s, "m"), .name = "principal_distance",
     .flags = COLUMN_EXTRA | COLUMN_INFINITE, .symbol = "s",
     .label = "distance from the principal plane",
     .help = "distance of the subject from the front principal plane"},
    PHOTO_LENS_WARNING_COLUMN(struct row, real),
};

/* Complete a row that has its setting and what follows from it. */
static void fill_row(const struct input *input, const struct photo_lens *lens, struct row *row)
{
    double to_sensor = row->dof.image + lens->measuring.hiatus;
    row->real = *lens->real;
    row->distance = row->setting.s;
    row->sensor_distance = row->distance + to_sensor;
    row->sensor_near = row->dof.near + to_sensor;
    row->sensor_far = row->dof.far + to_sensor;
    if (input->lens.from != FROM_PRINCIPAL) {
        double offset = distance_offset(&row->setting, &lens->measuring);
        row->distance += offset;
        row->dof.near += offset;
        row->dof.far += offset;
        row->dof.near_vergence = 1 / row->dof.near;
        row->dof.far_vergence = 1 / row->dof.far;
    }
    row->sensor = input->sharp.sensor.name;
    row->criterion = input->sharp.coc.criterion;
    row->wavelength = photo_lens_light(lens, sharpness_is_airy(&input->sharp));
    row->model = dof_models[input->model].word;
    row->from = distances_from[input->lens.from].word;
}

/* The same picture on another format, if that is asked for. */
static bool fill_other(const struct input *input, struct row *row, struct error *error)
{
    struct dof_setting other;
    row->other_sensor = input->other.name;
    row->other_focal = row->other_fnumber = row->other_coc = NAN;
    if (input->other.name == NULL) {
        return true;
    }
    double k = sensor_diagonal(&input->other.size) / sensor_diagonal(&input->sharp.sensor.size);
    if (!dof_equal(&row->setting, k, &other, error)) {
        return false;
    }
    row->other_focal = other.f;
    row->other_fnumber = other.N;
    row->other_coc = other.c;
    return true;
}

/* Near and far of a stack, from wherever they are measured. */
static bool stack_limits(const struct input *input, const struct photo_lens *lens, double *near,
                         double *far, struct error *error)
{
    const struct dof_targets *t = &input->targets;
    if (isnan(t->near) || isnan(t->far) || !isnan(input->distance)) {
        return fail(error, ERROR_USAGE,
                    "{--stack} wants {--near} and {--far}, and no {--distance} of its own");
    }
    if (sharpness_is_airy(&input->sharp)) {
        return fail(error, ERROR_USAGE,
                    "{--stack} wants one circle of confusion for all shots: not {--coc} airy");
    }
    if (input->lens.from == FROM_SENSOR || input->model != DOF_EXACT) {
        return fail(error, ERROR_USAGE,
                    "{--stack} goes with exact formulas and distances from the "
                    "principal plane");
    }
    return distance_to_principal(lens->f, lens->P, t->near, &lens->measuring, near, error) &&
           distance_to_principal(lens->f, lens->P, t->far, &lens->measuring, far, error);
}

static bool run_stack(const struct input *input, const struct photo_lens *lens,
                      const struct dof_setting *setting, struct run *run, struct error *error)
{
    struct dof_plan plan;
    struct row row;
    double near, far;
    if (!stack_limits(input, lens, &near, &far, error) ||
        !dof_plan_make(setting, near, far, input->overlap, &plan, error)) {
        return false;
    }
    for (long i = 0; i < plan.count; i++) {
        if (!dof_plan_shot(&plan, i, &row.setting, &row.dof, error)) {
            return false;
        }
        fill_row(input, lens, &row);
        row.shot = i + 1;
        row.shots = plan.count;
        if (!fill_other(input, &row, error) || !run_emit(run, &row)) {
            return false;
        }
    }
    return true;
}

/*
 * With all the rest given, a wish can only be met by the circle of confusion: unless the user
 * insists on one, that is what is asked for.
 */
static bool wants_coc(const struct input *input, const struct dof_setting *setting)
{
    if (!input->sharp.coc.is_fallback) {
        return false; /* as in most batches */
    }
    const struct dof_targets *t = &input->targets;
    bool complete = !isnan(setting->f) && !isnan(setting->N) && !isnan(setting->s);
    bool wish = !isnan(t->near) || !isnan(t->far) || !isnan(t->total) || !isnan(t->hyperfocal);
    return complete && wish;
}

/* Is the f-number what the wishes are for? Otherwise that of a real lens counts. */
static bool solves_fnumber(const struct input *input)
{
    const struct dof_targets *t = &input->targets;
    int wishes = !isnan(t->near) + !isnan(t->far) + !isnan(t->total) + !isnan(t->hyperfocal) +
                 !isnan(t->magnification);
    return !input->stack && wishes > isnan(input->distance);
}

static int use_of(const struct input *input)
{
    return solves_fnumber(input) ? PHOTO_LENS_SOLVES_FNUMBER : 0;
}

static bool set_up(const struct input *input, const struct photo_lens *lens,
                   struct dof_setting *setting, struct error *error)
{
    setting->f = lens->f;
    setting->N = lens->N;
    setting->s = input->distance;
    setting->P = lens->P;
    return sharpness_resolve_in(&input->sharp, lens->wavelength, lens->N, &setting->c, error);
}

/* The Airy disc grows with the magnification, which may follow from it: in turn till they agree. */
static bool solve_airy(const struct input *input, const struct photo_lens *lens,
                       struct dof_setting *setting, struct error *error)
{
    const struct dof_setting given = *setting;
    double m = 0;
    for (int turn = 0; turn < 200; turn++) {
        *setting = given;
        if (!sharpness_resolve_in(&input->sharp, lens->wavelength,
                                  working_fnumber(given.N, m, given.P), &setting->c, error) ||
            !distance_solve(setting, &input->targets, &lens->measuring, error)) {
            return false;
        }
        double next = setting->f / (setting->s - setting->f);
        if (fabs(next - m) <= 4e-16 * next) {
            return true;
        }
        m = next;
    }
    return fail(
        error, ERROR_DOMAIN,
        "no distance agrees with the Airy disc that belongs to it: give {--coc} as a length");
}

static bool solve(const struct input *input, const struct photo_lens *lens,
                  struct dof_setting *setting, struct error *error)
{
    return sharpness_is_airy(&input->sharp)
               ? solve_airy(input, lens, setting, error)
               : distance_solve(setting, &input->targets, &lens->measuring, error);
}

static bool answer(const void *data, const struct photo_lens *lens, struct run *run,
                   struct error *error)
{
    const struct input *input = data;
    struct input own;
    struct row row;
    if (!sharpness_is_plain(&input->sharp)) {
        own = *input;
        if (!sharpness_imply(&input->sharp, PITCH_FOR_COC, &own.sharp, error)) {
            return false;
        }
        input = &own;
    }
    struct dof_setting *setting = &row.setting;
    if (!set_up(input, lens, setting, error)) {
        return false;
    }
    if (sharpness_in_pixels(&input->sharp)) {
        sharpness_doubt_pitch(&input->sharp, run->doubts);
    }
    if (input->stack) {
        return run_stack(input, lens, setting, run, error);
    }
    bool solves_coc = wants_coc(input, setting);
    if (solves_coc) {
        setting->c = NAN;
    }
    if (!solve(input, lens, setting, error) || !photo_lens_check_subject(lens, setting->s, error) ||
        !dof_compute(setting, (enum dof_model)input->model, &row.dof, error)) {
        return false;
    }
    fill_row(input, lens, &row);
    if (solves_coc) {
        row.criterion = "solved";
    }
    row.shot = row.shots = NO_INTEGER;
    return fill_other(input, &row, error) && (run_emit(run, &row), true);
}

static bool run(const void *data, struct run *run, struct error *error)
{
    const struct input *input = data;
    if (photo_lens_is_thin(&input->lens)) {
        /* as photo_lens_each does, without a detour through memory: most batches come here */
        const struct photo_lens thin = photo_lens_thin(&input->lens);
        return answer(input, &thin, run, error);
    }
    return photo_lens_each(&input->lens, use_of(input), run, answer, input, error);
}

static bool makes_many(const void *data)
{
    const struct input *input = data;
    return input->stack || photo_lens_makes_many(&input->lens);
}

PHOTO_LENS_VARIES(struct input, lens)

/* The f-numbers of a lens barrel and the one in use among them, ascending. */
static size_t barrel_fnumbers(double chosen, double *fnumbers, size_t *at)
{
    static const double usual[] = {1, 1.4, 2, 2.8, 4, 5.6, 8, 11, 16, 22, 32, 45, 64};
    size_t count = 0;
    bool placed = false;
    for (size_t i = 0; i < sizeof usual / sizeof usual[0]; i++) {
        if (!placed && chosen <= usual[i] * 1.03) {
            *at = count;
            fnumbers[count++] = chosen;
            placed = true;
            if (chosen > usual[i] / 1.03) {
                continue;
            }
        }
        /* far from the one in use the marks would lie on the index or off the scale */
        if (usual[i] > chosen / 9 && usual[i] < chosen * 5) {
            fnumbers[count++] = usual[i];
        }
    }
    if (!placed) {
        *at = count;
        fnumbers[count++] = chosen;
    }
    return count;
}

static bool draw_scale(const struct artifact_job *job, struct output *sink, struct error *error)
{
    struct input own = *(const struct input *)job->inputs[0];
    const struct input *input = &own;
    const struct sharpness asked = own.sharp;
    struct svg svg = {.arena = job->run->arena};
    struct photo_lens lens;
    struct dof_setting setting;
    struct barrel_mark marks[16];
    struct barrel barrel = {.marks = marks};
    double fnumbers[16];
    if (!sharpness_imply(&asked, PITCH_FOR_COC, &own.sharp, error) ||
        !photo_lens_single(&input->lens, use_of(input), svg.arena, &lens, error) ||
        !set_up(input, &lens, &setting, error) || !solve(input, &lens, &setting, error)) {
        return false;
    }
    barrel.mark_count = barrel_fnumbers(setting.N, fnumbers, &barrel.chosen);
    for (size_t i = 0; i < barrel.mark_count; i++) {
        double near, far;
        dof_vergences(&setting, fnumbers[i], &near, &far);
        marks[i] = (struct barrel_mark){fnumbers[i], 1000 * near, 1000 * far};
    }
    barrel.focus_diopter = 1000 / setting.s;
    barrel.title = lens.real->title != NULL
                       ? arena_printf(svg.arena, "Depth of field of %s", lens.real->title)
                       : arena_printf(svg.arena, "Depth of field of a %.4g mm lens", setting.f);
    barrel.subtitle =
        arena_printf(svg.arena,
                     "focused at %.4g m, f/%.4g, circle of confusion %.4g mm, distances from the "
                     "front principal plane",
                     setting.s / 1000, setting.N, setting.c);
    return barrel_draw(&barrel, &svg, error) && drawing_write(job, &svg, sink, error);
}

static const struct explanation explanations[] = {
    {"coc", "c = {criterion}", "criterion of sharpness, see --coc",
     "what counts as sharp is a convention"},
    {"hyperfocal", "H = {f}^2/({N} {c}) + {f}", "[Ray02]; thin lens, exact",
     "without + f it is low by exactly f"},
    {"magnification", "m = {f}/({s} - {f})", "thin lens 1/f = 1/s + 1/v", NULL},
    {"near", "n = {f} (1 - 1/{P}) + {f} (1 + {m}/{P})/({m} + {N} {c}/{f})",
     "[Ray02], with pupil magnification; from the front principal plane", NULL},
    {"far", "r = {f} (1 - 1/{P}) + {f} (1 + {m}/{P})/({m} - {N} {c}/{f})",
     "[Ray02], with pupil magnification; infinite where the denominator is not positive",
     "ill-conditioned near the hyperfocal distance"},
    {"dof", "T = {front} + {behind}",
     "front = X e/(1 + e), behind = X e/(1 - e), X = f (1/m + 1/P), "
     "e = N c/(m f)",
     NULL},
    {"distance_sensor", "Ds = {s} + {v} + {HH'}",
     "[Gauss41] HH' from the front to the rear principal plane",
     "near and far limit likewise: the sensor stays where it is"},
    {"depth_of_focus", "t = 2 {N} {c} (1 + {m}/{P})", "[Ray02]", NULL},
    {"blur_at_infinity", "b = {f} {m}/{N}", "similar triangles at the exit pupil", NULL},
    {"working_fnumber", "Nw = {N} (1 + {m}/{P})", "[Ray02]", NULL},
    {NULL, NULL, NULL, NULL},
};

static const struct artifact artifacts[] = {
    {ARTIFACT_OPTION("scale", drawing_types, "draw the depth-of-field scale of the lens barrel"),
     .scope = ARTIFACT_OF_ROW, .make = draw_scale},
};

static const struct example examples[] = {
    {"dof -f 50mm -N 2.8 -s 3m", "a portrait on 35 mm film"},
    {"dof -f 85 -N 1.8 -s 2m --sensor \"Nikon D1\"", "on a camera from the list"},
    {"dof -f 50 -N 2.8..16 -s 1,2,5,10 --table s,N", "a table to print"},
    {"dof -f 35mm --near 2m --far 10m", "which distance and f-number make 2 m to 10 m sharp"},
    {"dof --lens double-gauss -N 4 -s 2m", "a real lens, with distances from the sensor too"},
    {"dof -f 100mm -N 8 --near 30cm --far 33cm --stack", "a focus stack"},
    {NULL, NULL},
};

const struct command command_dof = {
    .name = "dof",
    .group = "photography",
    .summary = "depth of field, and the settings for a wanted one",
    COMMAND_ASKS(struct input),
    COMMAND_ANSWERS(struct row),
    COMMAND_MAKES(artifacts),
    .makes_many = makes_many,
    .varies = varies,
    .plot = "near_m,far_m",
    .cell = "near_m+far_m",
};
