/* commands/photo/cmd_dof.c - lenscalc dof: depth of field. */
/* SPDX-License-Identifier: MIT */
#include "commands/photo/dof_carry.h"
#include "commands/photo/dof_question.h"
#include "commands/tables.h"
#include "photo/anamorphic.h"
#include "photo/dof.h"
#include "photo/stops.h"
#include "report/report.h"

#include <math.h>

#define INPUT struct dof_question

static const struct option options[] = {
    OPTION_FOCAL_LENGTH(lens.focal, OPTION_SETTING | OPTION_OF_CAMERA),
    PHOTO_LENS_OPTIONS(lens),
    OPTION_APERTURE(lens.fnumber, OPTION_SETTING),
    OPTION_NA(
        na, "numerical aperture at the subject, in place of -N",
        .excludes =
            "aperture near far dof hyperfocal stack exact scale disc card t-stop close-up tube "
            "converter"),
    OPTION_DISTANCE(distance, OPTION_SETTING,
                    "distance of the subject; inf for stars, or hyperfocal"),
    SHARPNESS_OPTIONS_OF_LENS(sharp, lens, 0, "d/1500", coc_is_pixels),
    OPTION_PUPIL_OF_LENS(lens.pupil, NULL),
    OPTION_FROM(lens.from, distances_from),
    {ASKED(model), REPEATED("model"), .words = dof_models, .fallback = "exact", .value = "MODEL",
     .help = "exact formulas, or a shortcut that other programs use"},
    {MEASURE(targets.near, length, "m", "LENGTH"), REPEATED("near"), .quantity = "near limit",
     ABOVE_0_OR_INFINITE | OPTION_GOAL, .help = "wanted near limit: solves for what is not given"},
    {MEASURE(targets.far, length, "m", "LENGTH"), REPEATED("far"), .quantity = "far limit",
     ABOVE_0_OR_INFINITE | OPTION_GOAL, .help = "wanted far limit; may be inf"},
    {MEASURE(targets.total, length, "m", "LENGTH"), REPEATED("dof"), .quantity = "depth of field",
     ABOVE_0_OR_INFINITE | OPTION_GOAL, .help = "wanted depth of field"},
    {MEASURE(targets.hyperfocal, length, "m", "LENGTH"), REPEATED("hyperfocal"),
     .quantity = "hyperfocal distance", ABOVE_0_OR_INFINITE | OPTION_GOAL,
     .no_number = "that of a lens and an f-number is in the answer of lenscalc hyperfocal",
     .help = "wanted hyperfocal distance"},
    {MEASURE(targets.magnification, ratio, NULL, "RATIO"), REPEATED("magnification"), .letter = 'm',
     FROM_0 | OPTION_GOAL, .help = "wanted magnification: 1:2 or 0.5"},
    {ASKED(stack), .name = "stack",
     .help = "plan a focus stack, one row per shot: from --near to --far, or as deep as --dof; -m "
             "is the magnification of the first shot"},
    {ASKED(rail), .name = "rail", .wants = "stack",
     .help =
         "the camera moves along a rail, at -m for all shots: their number and the rail's step, "
         "with or without -f"},
    {MEASURE(overlap, ratio, NULL, "FRACTION"), .name = "overlap", .wants = "stack", .lowest = 0,
     .highest = 0.95, .fallback = "0.2",
     .help = "overlap of successive shots, as a fraction of the depth of field, for --stack"},
    {MEASURE(blur_at, length, "m", "LENGTH"), .name = "blur-at", .quantity = "background",
     .column = "background", ABOVE_0_OR_INFINITE, .excludes = "blur-behind",
     .help = "blur disc of a background at this distance: in mm, % of the picture and pixels"},
    {MEASURE(blur_behind, length, "m", "LENGTH"), .name = "blur-behind",
     .quantity = "background behind the subject", ABOVE_0_OR_INFINITE,
     .help = "the same of a background this far behind the subject"},
    {ASKED(other), .name = "equal-on", .value = "NAME|WxH",
     .help = "focal length and f-number for the same picture on another format"},
    ATTACHMENT_OPTIONS(attached),
    OPTION_SQUEEZE(squeeze, NULL,
                   "anamorphic squeeze: adds the results for the horizontal direction"),
    OPTION_T_NUMBER(t_stop, "T-stop of the lens, for exposure; -N gives the depth of field"),
    BY_RAYS_EXACT_OPTION(lens.rays, "limits from the exact rays of --lens, aberrations included"),
    BY_RAYS_CRITERION_OPTION(lens.rays),
};

struct dof_row {
    struct dof_setting setting; /* of lens and attachments together */
    struct dof dof;
    struct photo_real real;
    struct by_rays_row rays;
    double na, focal, fnumber, distance;
    struct attachments attached;
    const char *lens_focus;
    double t_stop, working_t_stop, squeeze;
    struct anamorphic across;
    struct dof_background background;
    double step, travel;                             /* of a rail */
    double sensor_distance, sensor_near, sensor_far; /* from the sensor */
    double wavelength;                               /* NaN where it does not matter */
    const char *sensor, *criterion, *model, *from;
    long shot, shots;
    const char *other_sensor;
    double other_focal, other_fnumber, other_coc;
};

#define ROW struct dof_row

static const struct column columns[] = {
    {LENGTH(setting.f, "mm"), .name = "combined_focal", ECHO_WITH(ATTACHMENT_NAMES), .symbol = "f",
     .label = "combined focal length", .help = "focal length of lens and attachments"},
    {SHOWN(setting.N), .name = "combined_fnumber", ECHO_WITH(ATTACHMENT_NAMES), .symbol = "N",
     .label = "combined f-number", .help = "f-number of lens and attachments"},
    PHOTO_LENS_COLUMNS(real),
    {SHOWN(shot), .name = "shot", ECHO_WITH("stack"),
     .help = "number of the shot in a focus stack, nearest first"},
    {SHOWN(shots), .name = "shots", BRIEF_WITH("rail"), .when = "with --stack",
     .help = "number of shots in the focus stack"},
    {LENGTH(step, "mm"), .name = "step", BRIEF_WITH("rail"), .label = "step of the rail",
     .help = "between two shots of the focus stack"},
    {LENGTH(travel, "mm"), .name = "travel", WITH("rail"), .label = "travel of the rail",
     .help = "from the first shot to the last"},
    COLUMN_FOCAL(focal, 0),
    COLUMN_NA(na),
    COLUMN_FNUMBER(fnumber, 0),
    {SHOWN(t_stop), .name = "t_stop", ECHO_WITH("t-stop lens"), .symbol = "T", .label = "T-stop",
     .help = "T-stop as marked"},
    ATTACHMENT_COLUMNS(attached),
    {LENGTH(distance, "m"), .name = "distance",
     BRIEF | COLUMN_ECHO | COLUMN_INFINITE | COLUMN_SPARSE, .with = "distance",
     .help = "distance of the subject"},
    COLUMN_SENSOR(sensor),
    COLUMN_COC(setting.c, 0, SHARPNESS_WISHES),
    COLUMN_CRITERION(criterion),
    COLUMN_WAVELENGTH(wavelength),
    {LENGTH(dof.hyperfocal, "m"), .name = "hyperfocal", .flags = COLUMN_INFINITE | COLUMN_SPARSE,
     .symbol = "H", .label = "hyperfocal distance",
     .help = "nearest focus that keeps infinity sharp, from the front principal plane"},
    {LENGTH(dof.near, "m"), .name = "near", BRIEF | COLUMN_INFINITE | COLUMN_SPARSE,
     .condition = offsetof(struct dof_row, dof.near_condition), .symbol = "n",
     .label = "near limit", .help = "nearest sharp distance"},
    {LENGTH(dof.far, "m"), .name = "far", BRIEF | COLUMN_INFINITE | COLUMN_SPARSE,
     .condition = offsetof(struct dof_row, dof.far_condition), .symbol = "r", .label = "far limit",
     .help = "farthest sharp distance"},
    {LENGTH(dof.front, "m"), .name = "front", BRIEF | COLUMN_INFINITE | COLUMN_SPARSE,
     .symbol = "front", .label = "in front of the subject",
     .help = "depth of field before the subject"},
    {LENGTH(dof.behind, "m"), .name = "behind", BRIEF | COLUMN_INFINITE | COLUMN_SPARSE,
     .condition = offsetof(struct dof_row, dof.far_condition), .symbol = "behind",
     .label = "behind the subject", .help = "depth of field behind the subject"},
    {LENGTH(dof.total, "m"), .name = "dof", BRIEF | COLUMN_INFINITE,
     .condition = offsetof(struct dof_row, dof.far_condition), .symbol = "T",
     .label = "depth of field", .help = "front and behind together"},
    {LENGTH(sensor_distance, "m"), .name = "distance_sensor", BRIEF_WITH("lens") | COLUMN_INFINITE,
     .symbol = "Ds", .label = "distance from the sensor",
     .help = "distance of the subject from the sensor"},
    {LENGTH(sensor_near, "m"), .name = "near_sensor", BRIEF_WITH("lens") | COLUMN_INFINITE,
     .condition = offsetof(struct dof_row, dof.near_condition),
     .label = "near limit from the sensor", .help = "nearest sharp distance, from the sensor"},
    {LENGTH(sensor_far, "m"), .name = "far_sensor", BRIEF_WITH("lens") | COLUMN_INFINITE,
     .condition = offsetof(struct dof_row, dof.far_condition), .label = "far limit from the sensor",
     .help = "farthest sharp distance, from the sensor"},
    COLUMN_MAGNIFICATION(dof.magnification, 0),
    {LENGTH(dof.depth_of_focus, "mm"), .name = "depth_of_focus", .symbol = "t",
     .label = "depth of focus", .help = "tolerance of the sensor's place, both sides together"},
    {LENGTH(dof.blur_at_infinity, "mm"), .name = "blur_at_infinity", .symbol = "b",
     .label = "blur of the background", .help = "blur disc of a point at infinity, on the sensor"},
    {LENGTH(background.distance, "m"), .name = "background",
     WITH("blur-at blur-behind") | COLUMN_INFINITE, .label = "background",
     .help = "distance of what --blur-at or --blur-behind asks about"},
    {LENGTH(background.blur, "mm"), .name = "background_blur", BRIEF_WITH("blur-at blur-behind"),
     .symbol = "bx", .label = "blur at that distance", .help = "its blur disc on the sensor"},
    {MEASURED(background.of_diagonal, ratio, "percent"), .name = "background_blur_diagonal",
     BRIEF_WITH("blur-at blur-behind"), .label = "blur over the diagonal",
     .help = "its blur disc over the diagonal of the picture"},
    {MEASURED(background.of_width, ratio, "percent"), .name = "background_blur_width",
     BRIEF_WITH("blur-at blur-behind"), .label = "blur over the width",
     .help = "its blur disc over the width of the picture"},
    {SHOWN(background.pixels), .name = "background_blur_pixels",
     .flags = COLUMN_EXTRA | COLUMN_SPARSE, .with = "blur-at blur-behind",
     .label = "blur in pixels", .help = "with --pitch, or a camera of known pixels"},
    {SHOWN(dof.working_fnumber), .name = "working_fnumber", .symbol = "Nw",
     .label = "working f-number", .help = "f-number that exposes, N (1 + m/P)"},
    {SHOWN(working_t_stop), .name = "working_t_stop", WITH("t-stop lens"), .symbol = "Tw",
     .label = "working T-stop",
     .help = "T-stop that exposes: as the working f-number, with the lens's own loss"},
    BY_RAYS_COLUMNS(rays),
    {LENGTH(across.focal, "mm"), .name = "horizontal_focal", WITH("squeeze"), .symbol = "fh",
     .label = "horizontal focal length", .help = "focal length across the picture, by the squeeze"},
    {LENGTH(across.width, "m"), .name = "field_width", WITH("squeeze") | COLUMN_INFINITE,
     .symbol = "W", .label = "field width", .help = "width seen at the subject, unsqueezed"},
    {LENGTH(across.height, "m"), .name = "field_height", WITH("squeeze") | COLUMN_INFINITE,
     .label = "field height", .help = "height seen at the subject"},
    {LENGTH(across.blur, "mm"), .name = "blur_width", WITH("squeeze"), .symbol = "bw",
     .label = "blur of the background, width",
     .help = "width of the blur of a point at infinity, unsqueezed, on the sensor's scale"},
    {LENGTH(dof.image, "mm"), .name = "image", .flags = COLUMN_INFINITE | COLUMN_HIDDEN,
     .symbol = "v", .label = "image distance",
     .help = "image of the subject, from the rear principal plane"},
    {LENGTH(dof.image_near, "mm"), .name = "image_near", .flags = COLUMN_INFINITE | COLUMN_HIDDEN,
     .label = "image of the near limit",
     .help = "image of the near limit, from the rear principal plane"},
    {LENGTH(dof.image_far, "mm"), .name = "image_far", .flags = COLUMN_INFINITE | COLUMN_HIDDEN,
     .label = "image of the far limit",
     .help = "image of the far limit, from the rear principal plane"},
    {MEASURED(dof.near_vergence, vergence, "diopter"), .name = "near", .flags = COLUMN_HIDDEN,
     .label = "near limit, reciprocal", .help = "1 / near limit"},
    {MEASURED(dof.far_vergence, vergence, "diopter"), .name = "far", .flags = COLUMN_HIDDEN,
     .label = "far limit, reciprocal", .help = "1 / far limit; 0 at infinity"},
    {SHOWN(other_sensor), .name = "equal_sensor", WITH("equal-on"), .label = "equivalent sensor",
     .help = "the format of the equal picture"},
    {LENGTH(other_focal, "mm"), .name = "equal_focal", BRIEF_WITH("equal-on"),
     .label = "equivalent focal length",
     .help = "focal length with the same framing on the other format"},
    {SHOWN(other_fnumber), .name = "equal_fnumber", BRIEF_WITH("equal-on"),
     .label = "equivalent f-number",
     .help = "f-number with the same depth of field on the other format"},
    {LENGTH(other_coc, "mm"), .name = "equal_coc", WITH("equal-on"),
     .label = "equivalent circle of confusion",
     .help = "circle of confusion in proportion to the other format"},
    COLUMN_PUPIL(setting.P),
    {SHOWN(model), .name = "model", ASSUMED_BY("model"), .help = "the formulas that were used"},
    COLUMN_FROM(from),
    COLUMN_SQUEEZE(squeeze),
    {SHOWN(lens_focus), .name = "lens_focus", ASSUMED_WITH("tube close-up", "distance"),
     .label = "lens itself focused at", .help = "infinity, where no distance is given"},
    PHOTO_LENS_HIATUS_COLUMN(real.hiatus),
    {LENGTH(setting.s, "m"), .name = "principal_distance", .flags = COLUMN_EXTRA | COLUMN_INFINITE,
     .symbol = "s", .label = "distance from the principal plane",
     .help = "distance of the subject from the front principal plane"},
    {LENGTH(background.principal, "m"), .name = "principal_background",
     .flags = COLUMN_EXTRA | COLUMN_INFINITE, .symbol = "x",
     .label = "background from the principal plane",
     .help = "distance of the background from the front principal plane"},
    PHOTO_LENS_WARNING_COLUMN(real),
};

/* Complete a row that has its setting and what follows from it. */
static bool dof_fill_row(const struct dof_question *input, const struct attached_lens *attached,
                         struct dof_row *row, struct error *error)
{
    const struct photo_lens *lens = attached->lens;
    double to_sensor = row->dof.image + lens->measuring.hiatus;
    row->real = *lens->real;
    row->real.hiatus = lens->measuring.hiatus;
    row->lens_focus = isnan(input->distance) && row->setting.s == attached->farthest &&
                              isfinite(attached->farthest)
                          ? "infinity"
                          : NULL;
    row->distance = row->setting.s;
    row->sensor_distance = row->distance + to_sensor;
    row->sensor_near = row->dof.near + to_sensor;
    row->sensor_far = row->dof.far + to_sensor;
    double offset = 0;
    if (input->lens.from != FROM_PRINCIPAL) {
        offset = input->lens.from == FROM_SENSOR ? to_sensor
                                                 : distance_offset(&row->setting, &lens->measuring);
        row->distance += offset;
        row->dof.near += offset;
        row->dof.far += offset;
        row->dof.near_vergence = 1 / row->dof.near;
        row->dof.far_vergence = 1 / row->dof.far;
    }
    row->sensor = input->sharp.sensor.name;
    row->criterion = input->sharp.coc.criterion;
    row->wavelength = photo_lens_light(lens, sharpness_is_airy(&input->sharp));
    row->model = input->lens.rays.exact ? "rays" : dof_models[input->model].word;
    row->from = distances_from[input->lens.from].word;
    /* What attachments, squeeze and T-stop add to a row. */
    double transmittance, T = input->t_stop;
    double exposes = row->dof.working_fnumber / row->setting.N;
    row->attached = input->attached;
    row->focal = isnan(attached->focal) ? row->setting.f : attached->focal;
    row->na = input->na;
    row->fnumber = row->setting.N / attached->fnumber_factor;
    row->t_stop = isnan(T) ? row->fnumber * attached->lens->t_ratio : T;
    row->working_t_stop = row->t_stop * attached->fnumber_factor * exposes;
    row->squeeze = input->squeeze;
    row->across = (struct anamorphic){NAN, NAN, NAN, NAN};
    row->background = dof_background_none;
    row->step = row->travel = NAN;
    const bool has_background = !isnan(input->blur_at) || !isnan(input->blur_behind);
    return (isnan(input->t_stop) ||
            transmittance_from_t_stop(row->fnumber, input->t_stop, &transmittance, error)) &&
           (isnan(input->squeeze) ||
            anamorphic_view(&row->setting, &row->dof, &input->sharp.sensor.size, input->squeeze,
                            &row->across, error)) &&
           (!has_background ||
            dof_question_background(input, &row->setting, offset, &row->background, error));
}

/* The same picture on another format, if that is asked for. */
static bool dof_fill_other_format(const struct dof_question *input, struct dof_row *row,
                                  struct error *error)
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

static bool run_stack(const struct dof_question *input, const struct attached_lens *attached,
                      struct dof_setting *setting, const char *criterion, struct run *run,
                      struct error *error)
{
    struct dof_plan plan;
    struct dof_row row;
    if (!dof_question_plan(input, attached->lens, setting, &plan, error)) {
        return false;
    }
    row.rays = by_rays_none;
    for (long i = 0; i < plan.count; i++) {
        if (!dof_plan_shot(&plan, i, &row.setting, &row.dof, error) ||
            !photo_lens_check_subject(attached->lens, row.setting.s, error) ||
            !attached_check_reach(attached, row.setting.s, error) ||
            !dof_fill_row(input, attached, &row, error)) {
            return false;
        }
        row.shot = i + 1;
        row.shots = plan.count;
        row.criterion = criterion;
        if (!dof_fill_other_format(input, &row, error) || !run_emit(run, &row)) {
            return false;
        }
    }
    return true;
}

/* The row of a magnification whose distances are not known, or are those of no shot alone. */
static struct dof_row dof_row_at(const struct dof_question *input, const struct photo_lens *lens,
                                 const struct dof_setting *setting, double depth)
{
    const double m = input->targets.magnification, none = NAN;
    return (struct dof_row){
        .setting = *setting,
        .dof = {none, none, none, none, none, depth, m,
                2 * setting->N * setting->c * (1 + m / setting->P), none, none, none, none, none,
                none, setting->N * (1 + m / setting->P), 1, 1},
        .real = *lens->real,
        .rays = by_rays_none,
        .attached = input->attached,
        .background = dof_background_none,
        .step = none,
        .travel = none,
        .na = none,
        .focal = setting->f,
        .fnumber = setting->N,
        .distance = none,
        .t_stop = none,
        .working_t_stop = none,
        .squeeze = none,
        .across = {none, none, none, none},
        .sensor_distance = none,
        .sensor_near = none,
        .sensor_far = none,
        .wavelength = photo_lens_light(lens, sharpness_is_airy(&input->sharp)),
        .sensor = input->sharp.sensor.name,
        .criterion = input->sharp.coc.criterion,
        .model = dof_models[input->model].word,
        .from = distances_from[input->lens.from].word,
        .shot = NO_INTEGER,
        .shots = NO_INTEGER,
        .other_focal = none,
        .other_fnumber = none,
        .other_coc = none,
    };
}

/* One row for all shots of a rail, which differ in nothing but their place. */
static bool run_rail(const struct dof_question *input, const struct photo_lens *lens,
                     const struct dof_setting *setting, struct run *run, struct error *error)
{
    struct dof_rail rail;
    if (!dof_question_rail(input, setting, &rail, error)) {
        return false;
    }
    struct dof_row row = dof_row_at(input, lens, setting, rail.depth);
    row.step = rail.step;
    row.travel = rail.travel;
    row.shots = rail.count;
    run_emit(run, &row);
    return true;
}

static bool run_magnification(const struct dof_question *input, const struct photo_lens *lens,
                              const struct dof_setting *setting, struct run *run,
                              struct error *error)
{
    double depth;
    if (!dof_depth_at(setting, input->targets.magnification, &depth, error)) {
        return false;
    }
    const struct dof_row row = dof_row_at(input, lens, setting, depth);
    warnings_add(run->doubts,
                 "no --focal-length: the depth at a magnification depends on it by less than 1 %% "
                 "where it is longer than %.3g mm, and distances are not known",
                 10 * setting->N * setting->c / input->targets.magnification);
    run_emit(run, &row);
    return true;
}

/*
 * With all the rest given, a wish can only be met by the circle of confusion: unless the user
 * insists on one, that is what is asked for.
 */
static bool wants_coc(const struct dof_question *input, const struct dof_setting *setting)
{
    if (!input->sharp.coc.is_fallback) {
        return false; /* as in most batches */
    }
    const struct dof_targets *t = &input->targets;
    bool complete = !isnan(setting->f) && !isnan(setting->N);
    if (input->stack) {
        return complete && !isnan(t->hyperfocal);
    }
    bool wish = !isnan(t->near) || !isnan(t->far) || !isnan(t->total) || !isnan(t->hyperfocal);
    return complete && !isnan(setting->s) && wish;
}

/* The wish that the circle of confusion is to meet stands before the answer, which is not the depth
   of field of the options. */
static void say_wish(const struct dof_question *input, const struct dof_setting *setting,
                     struct run *run)
{
    const struct dof_targets *t = &input->targets;
    const struct {
        double value; /* mm */
        const char *before, *behind;
    } wishes[] = {{t->near, "", " just sharp"},
                  {t->far, "", " just sharp"},
                  {t->total, "the depth of field ", ""},
                  {t->hyperfocal, "", " the hyperfocal distance"}};
    for (size_t i = 0; i < sizeof wishes / sizeof wishes[0]; i++) {
        if (!isnan(wishes[i].value)) {
            const double m = wishes[i].value / 1000;
            const char *wish = isinf(m) ? "infinity" : arena_printf(run->arena, "%.6g m", m);
            const char *one =
                arena_printf(run->arena, "what makes %s%s%s: a circle of confusion of %.4g mm",
                             wishes[i].before, wish, wishes[i].behind, setting->c);
            report_lead(run->leads, one,
                        "what meets the wish of each row: its circle of confusion");
            return;
        }
    }
}

static bool dof_answer(const void *data, const struct photo_lens *lens, struct run *run,
                       struct error *error)
{
    const struct dof_question *input = data;
    struct dof_question own;
    struct photo_lens room, stopped;
    struct attached_lens attached;
    struct dof_row row;
    if (!isnan(input->na)) {
        if (!dof_question_stop(input, lens, &stopped, error)) {
            return false;
        }
        lens = &stopped;
    }
    if (!sharpness_is_plain(&input->sharp)) {
        own = *input;
        if (!sharpness_settle(&own.sharp, PITCH_FOR_COC, run->doubts, error)) {
            return false;
        }
        input = &own;
    }
    struct dof_setting *setting = &row.setting;
    if (!dof_question_open(input, lens, &room, &attached, setting, error)) {
        return false;
    }
    row.rays = by_rays_none;
    bool solves_coc = wants_coc(input, setting);
    if (solves_coc) {
        setting->c = NAN;
    }
    const char *criterion = solves_coc ? "solved" : input->sharp.coc.criterion;
    if (input->rail) {
        return run_rail(input, attached.lens, setting, run, error);
    }
    if (dof_question_is_magnification(input, setting)) {
        return run_magnification(input, attached.lens, setting, run, error);
    }
    if (input->stack) {
        return run_stack(input, &attached, setting, criterion, run, error);
    }
    if (!dof_question_solve(input, &attached, setting, error) ||
        !dof_compute(setting, (enum dof_model)input->model, &row.dof, error) ||
        (input->lens.rays.exact &&
         !dof_question_by_rays(input, &attached, run, setting, &row.dof, &row.rays, error)) ||
        !dof_fill_row(input, &attached, &row, error)) {
        return photo_lens_hint_virtual(lens, setting->s, error);
    }
    row.criterion = criterion;
    if (solves_coc && run->leads != NULL && run->leads->title == NULL) {
        say_wish(input, setting, run);
    }
    row.shot = row.shots = NO_INTEGER;
    return dof_fill_other_format(input, &row, error) && (run_emit(run, &row), true);
}

static bool dof_run(const void *data, struct run *run, struct error *error)
{
    const struct dof_question *input = data;
    if (photo_lens_is_thin(&input->lens)) {
        /* as photo_lens_each does, without a detour through memory: most batches come here */
        const struct photo_lens thin = photo_lens_thin(&input->lens);
        return dof_answer(input, &thin, run, error);
    }
    return photo_lens_each(&input->lens, dof_question_use(input), run, dof_answer, input, error);
}

static bool dof_makes_many(const void *data)
{
    const struct dof_question *input = data;
    return (input->stack && !input->rail) || photo_lens_makes_many(&input->lens);
}

PHOTO_LENS_VARIES(lens)

static const struct explanation explanations[] = {
    {"coc", "c = {criterion}", "criterion of sharpness, see --coc",
     "what counts as sharp is a convention"},
    {"hyperfocal !blur_rule", "H = {f}^2/({N} {c}) + {f}", "[Ray02]; thin lens, exact",
     "without + f it is low by exactly f"},
    {"magnification", "m = {f}/({s} - {f})", "thin lens 1/f = 1/s + 1/v", NULL},
    {"near !blur_rule", "n = {f} (1 - 1/{P}) + {f} (1 + {m}/{P})/({m} + {N} {c}/{f})",
     "[Ray02], with pupil magnification; from the front principal plane", NULL},
    {"far !blur_rule", "r = {f} (1 - 1/{P}) + {f} (1 + {m}/{P})/({m} - {N} {c}/{f})",
     "[Ray02], with pupil magnification; infinite where the denominator is not positive",
     "ill-conditioned near the hyperfocal distance"},
    {"dof !blur_rule", "T = {front} + {behind}",
     "front = X e/(1 + e), behind = X e/(1 - e), X = f (1/m + 1/P), e = N c/(m f)", NULL},
    {"distance_sensor", "Ds = {s} + {v} + {HH'}",
     "[Gauss41] HH' from the front to the rear principal plane",
     "near and far limit likewise: the sensor stays where it is"},
    {"depth_of_focus !blur_rule", "t = 2 {N} {c} (1 + {m}/{P})", "[Ray02]", NULL},
    {"blur_at_infinity !blur_rule", "b = {f} {m}/{N}", "similar triangles at the exit pupil", NULL},
    {"hyperfocal blur_rule",
     "H = distance whose sharpest image lies on the film where infinity blurs c", "exact rays",
     "its blur is measured as blur_rule says"},
    {"near blur_rule", "n = distance where the blur on the film of {s} grows to {c}", "exact rays",
     NULL},
    {"far blur_rule", "r = distance where the blur on the film of {s} grows to {c}", "exact rays",
     "infinite where infinity is no more blurred"},
    {"dof blur_rule", "T = {front} + {behind}", "by the limits", NULL},
    {"depth_of_focus blur_rule", "t = way between the films on which {s} blurs {c}", "exact rays",
     NULL},
    {"blur_at_infinity blur_rule", "b = blur on the film of {s}", "exact rays", NULL},
    {"background_blur", "bx = {f} {m}/{N} abs({x} - {s})/({x} - {f} (1 - 1/{P}))",
     "similar triangles at the entrance pupil, [Ray02]; f m/N where x is infinite",
     "geometric: aberrations and diffraction apart"},
    {"working_fnumber", "Nw = {N} (1 + {m}/{P})", "[Ray02]", NULL},
    {"working_t_stop", "Tw = {T} {Nw}/N", "[IsoAperture08], with N as marked",
     "light only: what is sharp goes by the f-number"},
    {"horizontal_focal", "fh = {f}/{q}", "cylinders in front of the lens",
     "sharpness is that of f: a blur is narrower than high"},
    {"field_width", "W = {q} w/{m}", "similar triangles; w is the width of the sensor", NULL},
    {"blur_width", "bw = {b}/{q}", "the entrance pupil is narrower than high by q",
     "not for cylinders behind the lens"},
    {NULL, NULL, NULL, NULL},
};

static const struct artifact artifacts[] = {
    {ARTIFACT_OPTION("scale", drawing_types, "draw the depth-of-field scale of the lens barrel"),
     .scope = ARTIFACT_OF_ROW, .check = dof_check_scale, .make = dof_draw_scale},
    {ARTIFACT_OPTION("disc", drawing_types,
                     "draw a calculator of two discs to cut out, in true size, for one lens"),
     .scope = ARTIFACT_OF_SWEEP, .check = dof_check_carry, .make = dof_draw_disc},
    {ARTIFACT_OPTION("card", drawing_types,
                     "draw a card, A6, of all lenses, f-numbers and distances that are swept"),
     .scope = ARTIFACT_OF_SWEEP, .check = dof_check_carry, .make = dof_draw_card},
};

static const struct example examples[] = {
    {"dof -f 50mm -N 2.8 -s 3m", "a portrait on 35 mm film"},
    {"dof -f 85 -N 1.8 -s 2m --sensor \"Nikon D1\"", "on a camera from the list"},
    {"dof -f 50 -N 2.8..16 -s 1,2,5,10 --table s,N", "a table to print"},
    {"dof -f 50 -N 8 -s 3 --disc disc.svg", "a calculator disc to cut out"},
    {"dof -f 24,50,85 -N 2.8,5.6,11 -s 1,2,5 --card card.svg", "a card of three lenses"},
    {"dof -f 35mm --near 2m --far 10m", "which distance and f-number make 2 m to 10 m sharp"},
    {"dof --lens double-gauss -N 4 -s 2m", "a real lens, with distances from the sensor too"},
    {"dof -f 85 -N 1.8 -s 2m --blur-at 10m", "how blurred the background is"},
    {"dof -f 100mm -N 8 --near 30cm --far 33cm --stack", "a focus stack"},
    {"dof -f 100mm -N 5.6 -m 1:1 --dof 5mm --stack", "one that begins at life size"},
    {"dof -m 2:1 -N 5.6 --dof 8mm --stack --rail", "on a rail: how many shots, and its step"},
    {"dof -f 50mm -N 8 --tube 25mm", "with a tube, the lens itself focused at infinity"},
    {"dof -f 200mm -N 4 -s 10m --converter 2x", "with a teleconverter"},
    {"dof -f 50mm -N 2.8 --t-stop 3.1 -s 2m --squeeze 2 --sensor scope", "anamorphic cinema"},
    {NULL, NULL},
};

BY_RAYS_WEIGHT(lens.rays)

const struct command command_dof = {
    .name = "dof",
    .stop_size_wants = "exact",
    COMMAND_OF("photography", "depth of field, and the settings for a wanted one"),
    .run = dof_run,
    COMMAND_MAKES(artifacts),
    .makes_many = dof_makes_many,
    .varies = varies,
    .weight = weight,
    .plot = "near_m,far_m",
    .plot_titles = "Depth of field",
    .zone = "near far|near_sensor far_sensor",
    .cell = "near_m+far_m",
};
