/* commands/photo/dof_question.c - what `dof` is asked, the setting that answers it, its scale. */
/* SPDX-License-Identifier: MIT */
#include "commands/photo/dof_question.h"
#include "base/arena.h"
#include "draw/barrel.h"
#include "photo/diffraction.h"
#include "photo/dof.h"

#include <math.h>

int dof_question_use(const struct dof_question *input)
{
    /* Is the f-number what the wishes are for? Otherwise that of a real lens counts. */
    const struct dof_targets *t = &input->targets;
    int wishes = !isnan(t->near) + !isnan(t->far) + !isnan(t->total) + !isnan(t->hyperfocal) +
                 !isnan(t->magnification);
    const int others = input->stack ? 2 : isnan(input->distance); /* that the wishes may solve */
    return wishes > others ? PHOTO_LENS_SOLVES_FNUMBER : 0;
}

bool dof_question_stop(const struct dof_question *input, const struct photo_lens *lens,
                       struct photo_lens *stopped, struct error *error)
{
    double m = input->targets.magnification, s;
    if (input->na >= 1) {
        fail(error, ERROR_USAGE, "{--na} %g is out of range: in air it is above 0 and below 1",
             input->na);
        return error_hint(error,
                          "of an immersed objective, with its index and diffraction: "
                          "lenscalc microscope --na %g --immersion oil -m 60",
                          input->na);
    }
    if (isnan(lens->f) || (isnan(m) && !isfinite(input->distance))) {
        fail(error, ERROR_USAGE,
             "{--na} needs {--focal-length} or {--lens}, and a {--distance} or {--magnification}");
        return error_hint(error, "of a microscope, with diffraction: lenscalc microscope 40x/0.65");
    }
    if (isnan(m)) {
        if (!distance_to_principal(lens->f, lens->P, input->distance, &lens->measuring, &s,
                                   error)) {
            return false;
        }
        m = lens->f / (s - lens->f);
    }
    *stopped = *lens;
    stopped->N = fnumber_from_na(input->na, m, lens->P);
    return true;
}

static bool dof_question_set_up(const struct dof_question *input,
                                const struct attached_lens *attached, struct dof_setting *setting,
                                struct error *error)
{
    const struct photo_lens *lens = attached->lens;
    setting->f = lens->f;
    setting->N = lens->N;
    setting->s = input->distance;
    setting->P = lens->P;
    if (!isnan(input->t_stop) && isnan(lens->N)) {
        return fail(error, ERROR_USAGE,
                    "{--t-stop} says how the lens exposes, not what is sharp: give {--aperture} "
                    "too");
    }
    return sharpness_resolve_in(&input->sharp, lens->wavelength, lens->N, &setting->c, error);
}

/* The Airy disc grows with the magnification, which may follow from it: in turn till they agree. */
static bool solve_airy(const struct dof_question *input, const struct photo_lens *lens,
                       struct dof_setting *setting, struct error *error)
{
    const struct dof_setting given = *setting;
    double m = 0;
    for (int turn = 0; turn < 200; turn++) {
        *setting = given;
        if (!sharpness_resolve_in(&input->sharp, lens->wavelength,
                                  diffracting_fnumber(given.N, m, given.P), &setting->c, error) ||
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

/* Rays answer for a lens, an f-number and a distance; nothing is solved for. */
static bool dof_question_check_rays(const struct dof_question *input, struct error *error)
{
    const struct dof_targets *t = &input->targets;
    const char *other = SAID_FIRST(
        {input->stack, "stack"}, {input->model != DOF_EXACT, "model"},
        {attachments_any(&input->attached), "tube, --close-up, --converter"},
        {!isnan(input->blur_at), "blur-at"}, {!isnan(input->blur_behind), "blur-behind"},
        {input->other.name != NULL, "equal-on"}, {!isnan(input->squeeze), "squeeze"},
        {!isnan(input->t_stop), "t-stop"}, {!isnan(t->near), "near"}, {!isnan(t->far), "far"},
        {!isnan(t->total), "dof"}, {!isnan(t->hyperfocal), "hyperfocal"});
    return other == NULL || fail(error, ERROR_USAGE,
                                 "{--exact} answers for a lens, an f-number and a distance: it "
                                 "excludes {--%s}",
                                 other);
}

bool dof_question_open(const struct dof_question *input, const struct photo_lens *lens,
                       struct photo_lens *room, struct attached_lens *attached,
                       struct dof_setting *setting, struct error *error)
{
    return (!input->lens.rays.exact || dof_question_check_rays(input, error)) &&
           attachments_apply(&input->attached, lens, room, attached, error) &&
           dof_question_set_up(input, attached, setting, error);
}

bool dof_question_solve(const struct dof_question *input, const struct attached_lens *attached,
                        struct dof_setting *setting, struct error *error)
{
    /* the subject is where the lens itself is focused at infinity if nothing else is said */
    const struct dof_targets *t = &input->targets;
    if (isfinite(attached->farthest) && isnan(input->distance) && isnan(t->near) && isnan(t->far) &&
        isnan(t->total) && isnan(t->magnification) && isnan(t->hyperfocal)) {
        setting->s = attached->farthest;
        return dof_check(setting, error);
    }
    return (sharpness_is_airy(&input->sharp)
                ? solve_airy(input, attached->lens, setting, error)
                : distance_solve(setting, &input->targets, &attached->lens->measuring, error)) &&
           photo_lens_check_subject(attached->lens, setting->s, error) &&
           attached_check_reach(attached, setting->s, error);
}

bool dof_question_is_magnification(const struct dof_question *input,
                                   const struct dof_setting *setting)
{
    const struct dof_targets *t = &input->targets;
    return !input->stack && t->magnification > 0 && isnan(setting->f) && isnan(setting->s) &&
           !isnan(setting->N) && !isnan(setting->c) && isnan(t->near) && isnan(t->far) &&
           isnan(t->total) && isnan(t->hyperfocal) && isnan(input->blur_at) &&
           isnan(input->blur_behind) && isnan(input->squeeze) && isnan(input->t_stop) &&
           input->other.name == NULL && !attachments_any(&input->attached) &&
           input->model == DOF_EXACT && !sharpness_is_airy(&input->sharp);
}

/* -------- what is not in focus -------- */

const struct dof_background dof_background_none = {NAN, NAN, NAN, NAN, NAN, NAN};

bool dof_question_background(const struct dof_question *input, const struct dof_setting *setting,
                             double offset, struct dof_background *background, struct error *error)
{
    const struct sensor *sensor = &input->sharp.sensor.size;
    const bool is_behind = !isnan(input->blur_behind);
    const double x = is_behind ? setting->s + input->blur_behind : input->blur_at - offset;
    struct dof_background *all = background;
    if (!dof_blur_at(setting, x, &all->blur, error)) {
        return error_prefix(error, "{--%s}: ", is_behind ? "blur-behind" : "blur-at");
    }
    all->principal = x;
    all->distance = x + offset;
    all->of_diagonal = all->blur / sensor_diagonal(sensor);
    all->of_width = all->blur / sensor->width;
    all->pixels = all->blur / sharpness_pitch(&input->sharp);
    return true;
}

/* -------- the scale of a barrel -------- */

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

bool dof_draw_scale(const struct artifact_job *job, struct output *sink, struct error *error)
{
    struct dof_question own = *(const struct dof_question *)job->inputs[0];
    const struct dof_question *input = &own;
    struct svg svg = {.arena = job->run->arena};
    struct photo_lens lens, room;
    struct attached_lens attached;
    struct dof_setting setting;
    struct barrel_mark marks[16];
    struct barrel barrel = {.marks = marks};
    double fnumbers[16];
    if (!sharpness_settle(&own.sharp, PITCH_FOR_COC, NULL, error) ||
        !photo_lens_single(&input->lens, dof_question_use(input), svg.arena, &lens, error) ||
        !dof_question_open(input, &lens, &room, &attached, &setting, error) ||
        !dof_question_solve(input, &attached, &setting, error)) {
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
                       ? arena_printf(svg.arena, "Depth of field, %s", lens.real->title)
                       : arena_printf(svg.arena, "Depth of field, %.4g mm lens", setting.f);
    barrel.subtitle =
        arena_printf(svg.arena,
                     "focused at %.4g m, f/%.4g, circle of confusion %.4g mm, distances from the "
                     "front principal plane",
                     setting.s / 1000, setting.N, setting.c);
    return barrel_draw(&barrel, &svg, error) && drawing_write(job, &svg, sink, error);
}

/* -------- focus stacks -------- */

/* Near and far of a stack from the principal plane, once f, N and c are known. */
static bool stack_limits(const struct dof_targets *t, const struct photo_lens *lens,
                         const struct dof_setting *setting, double *near, double *far,
                         struct error *error)
{
    const double nearest = isnan(t->near) ? t->far - t->total : t->near;
    struct dof first;
    if (!isnan(nearest)) {
        if (!distance_to_principal(setting->f, setting->P, nearest, &lens->measuring, near,
                                   error)) {
            return false;
        }
    } else if (dof_compute(setting, DOF_EXACT, &first, error)) {
        *near = first.near;
    } else {
        return false;
    }
    *far = *near + t->total;
    return isnan(t->far) ||
           distance_to_principal(setting->f, setting->P, t->far, &lens->measuring, far, error);
}

bool dof_question_plan(const struct dof_question *input, const struct photo_lens *lens,
                       struct dof_setting *setting, struct dof_plan *plan, struct error *error)
{
    const struct dof_targets *t = &input->targets;
    /* what the first shot shall have; far and depth are those of the whole stack */
    const struct dof_targets first = {.near = isnan(t->near) ? t->far - t->total : t->near,
                                      .far = NAN,
                                      .total = NAN,
                                      .hyperfocal = t->hyperfocal,
                                      .magnification = t->magnification};
    const bool is_known = !isnan(setting->f) && !isnan(setting->N) && !isnan(setting->c) &&
                          isnan(t->magnification) && isnan(t->hyperfocal);
    double near, far;
    const int ends = !isnan(t->near) + !isnan(t->far) + !isnan(t->total);
    if (!isnan(input->distance) || ends + !isnan(t->magnification) < 2) {
        return fail(error, ERROR_USAGE,
                    "{--stack} needs two of {--near}, {--far} and {--dof}, or {--far} or {--dof} "
                    "with the {--magnification} of its first shot, and no {--distance} of its own");
    }
    if (ends == 3) {
        return fail(error, ERROR_USAGE,
                    "{--stack} needs two of {--near}, {--far} and {--dof}: the third follows");
    }
    if (isnan(t->far) && isnan(t->total)) {
        return fail(error, ERROR_USAGE, "{--stack} has no end: give {--far} or {--dof}");
    }
    if (sharpness_is_airy(&input->sharp)) {
        return fail(error, ERROR_USAGE,
                    "{--stack} needs one circle of confusion for all shots: not {--coc} airy");
    }
    if (input->lens.from == FROM_SENSOR || input->model != DOF_EXACT) {
        return fail(error, ERROR_USAGE,
                    "{--stack} works with exact formulas and distances from the "
                    "principal plane");
    }
    if ((!is_known && !distance_solve(setting, &first, &lens->measuring, error)) ||
        !stack_limits(t, lens, setting, &near, &far, error) ||
        !dof_plan_make(setting, near, far, input->overlap, plan, error)) {
        return false;
    }
    if (!isnan(t->magnification)) {
        plan->first = t->magnification + setting->P; /* also where one shot would be enough */
    }
    return true;
}

bool dof_question_rail(const struct dof_question *input, const struct dof_setting *setting,
                       struct dof_rail *rail, struct error *error)
{
    const struct dof_targets *t = &input->targets;
    const char *other =
        SAID_FIRST({!isnan(input->distance), "distance"}, {!isnan(t->near), "near"},
                   {!isnan(t->far), "far"}, {!isnan(t->hyperfocal), "hyperfocal"},
                   {input->other.name != NULL, "equal-on"}, {!isnan(input->blur_at), "blur-at"},
                   {!isnan(input->blur_behind), "blur-behind"}, {!isnan(input->squeeze), "squeeze"},
                   {!isnan(input->t_stop), "t-stop"}, {input->model != DOF_EXACT, "model"});
    if (other != NULL) {
        return fail(error, ERROR_USAGE, "{--rail} excludes {--%s}", other);
    }
    if (isnan(t->magnification) || isnan(t->total) || isnan(setting->N)) {
        return fail(error, ERROR_USAGE,
                    "{--rail} needs the {--magnification}, the f-number and the depth to cover, "
                    "{--dof}");
    }
    return dof_rail_plan(setting, t->magnification, t->total, input->overlap, rail, error);
}

/* -------- by rays -------- */

bool dof_question_by_rays(const struct dof_question *input, const struct attached_lens *attached,
                          struct run *run, struct dof_setting *setting, struct dof *dof,
                          struct by_rays_row *rays, struct error *error)
{
    const struct photo_lens *lens = attached->lens;
    const double front = lens->measuring.front;
    struct real_focus focus;
    struct real_range range;
    double blur; /* of infinity */
    if (!by_rays_open(&input->lens, lens, setting->s, setting->c, run, &focus, rays, error) ||
        (input->lens.from == FROM_SENSOR && !isnan(input->distance) &&
         !by_rays_distance(&focus, lens, setting->s, input->distance, &setting->s, error)) ||
        !real_range_find(&focus, front, setting->s, setting->c, &range, error) ||
        !real_range_hyperfocal(&focus, front, setting->c, &dof->hyperfocal, &blur, error)) {
        return false;
    }
    /* What the rays found, as formulas would have it: distances from principal planes. */
    const double rear = lens->real->rear, before = setting->s - range.near;
    const double behind = isinf(range.far) ? range.far : range.far - setting->s;
    *dof = (struct dof){
        .hyperfocal = dof->hyperfocal,
        .near = range.near,
        .far = range.far,
        .front = before,
        .behind = behind,
        .total = before + behind,
        .magnification = dof->magnification,
        .depth_of_focus = range.film_high - range.film_low,
        .blur_at_infinity = range.blur_at_infinity,
        .image = range.film - rear,
        .image_near = range.film_near - rear,
        .image_far = range.film_far - rear,
        .near_vergence = 1 / range.near,
        .far_vergence = 1 / range.far,
        .working_fnumber = dof->working_fnumber,
        .near_condition = 1,
        .far_condition = 1,
    };
    rays->blur = range.blur;
    return true;
}
