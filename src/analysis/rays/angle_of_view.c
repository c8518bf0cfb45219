/* analysis/rays/angle_of_view.c - chief rays from the sensor outwards. */
/* SPDX-License-Identifier: MIT */
#include "analysis/rays/angle_of_view.h"

#include "trace/aim/aim.h"
#include "trace/dispatch.h"
#include "trace/pupil/pupil_inside.h"

#include <math.h>

/* Radians between neighbours on a sunflower: pi (3 - sqrt 5). */
static const double GOLDEN_ANGLE = 2.399963229728653;

/* A lens asked from its film side. */
struct outlook {
    const struct view_question *question;
    const struct system *system; /* reversed, with its clear apertures */
    struct rays work;            /* one block */
    double close; /* a ray that passes the stop's centre this near goes through it, mm */
};

/* A ray from the film: where it crosses the plane of the last vertex, mm. */
struct from_film {
    const double *film; /* x, y on the film, mm */
    double at[2];
};

static void angle_of_view_start(const struct outlook *outlook, size_t lane, const double film[2],
                                const double at[2])
{
    double way[3] = {at[0] - film[0], at[1] - film[1], -outlook->question->film};
    double length = sqrt(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
    const struct ray ray = {.point = {at[0], at[1], 0},
                            .cosine = {way[0] / length, way[1] / length, way[2] / length}};
    rays_set(&outlook->work, lane, outlook->system->index_first, &ray);
}

/* Where the rays cross the stop, in its own frame, beyond clear apertures too; NaN if lost. */
static void to_stop(const struct outlook *outlook, size_t count, double (*points)[2])
{
    const struct system *system = outlook->system;
    const struct ray_block *block = outlook->work.blocks;
    rays_trace_part(system, 0, system_place(system, system->stop) + 1, &outlook->work, NULL);
    for (size_t i = 0; i < count; i++) {
        double point[3] = {block->x[i], block->y[i], block->z[i]};
        system_to_own(system, system->stop, point);
        points[i][0] = point[0];
        points[i][1] = point[1];
    }
}

/* The part of the step, halved again and again in the lanes of one block, that comes nearest. */
static bool take_step(const struct outlook *outlook, struct from_film *ray, double miss,
                      const double step[2])
{
    enum { HALVINGS = 24 };
    double tried[HALVINGS][2], points[HALVINGS][2], scale = 1;
    for (size_t i = 0; i < HALVINGS; i++, scale /= 2) {
        tried[i][0] = ray->at[0] + scale * step[0];
        tried[i][1] = ray->at[1] + scale * step[1];
        angle_of_view_start(outlook, i, ray->film, tried[i]);
    }
    to_stop(outlook, HALVINGS, points);
    for (size_t i = 0; i < HALVINGS; i++) {
        if (hypot(points[i][0], points[i][1]) < miss) {
            ray->at[0] = tried[i][0];
            ray->at[1] = tried[i][1];
            return true;
        }
    }
    return false;
}

/* From a guess to the chief ray. It ends when no step brings it closer, which is at rounding. */
static bool film_find_chief(const struct outlook *outlook, struct from_film *ray)
{
    double miss = INFINITY, step[2];
    for (int turn = 0; turn < 60; turn++) {
        /* Newton's step towards the centre of the stop, the slopes by differences */
        double h = 1e-6 * outlook->question->film, points[3][2];
        angle_of_view_start(outlook, 0, ray->film, ray->at);
        angle_of_view_start(outlook, 1, ray->film, (double[2]){ray->at[0] + h, ray->at[1]});
        angle_of_view_start(outlook, 2, ray->film, (double[2]){ray->at[0], ray->at[1] + h});
        to_stop(outlook, 3, points);
        const double *here = points[0];
        miss = hypot(here[0], here[1]);
        double m[4] = {(points[1][0] - here[0]) / h, (points[2][0] - here[0]) / h,
                       (points[1][1] - here[1]) / h, (points[2][1] - here[1]) / h};
        double det = m[0] * m[3] - m[1] * m[2];
        step[0] = (m[1] * here[1] - m[3] * here[0]) / det;
        step[1] = (m[2] * here[0] - m[0] * here[1]) / det;
        if (!(isfinite(step[0]) && isfinite(step[1]))) {
            return false;
        }
        if (!take_step(outlook, ray, miss, step)) {
            break;
        }
    }
    return miss <= outlook->close;
}

/* One end of a dimension: its outermost chief ray. */
struct end {
    double part;      /* of the way from the sensor's centre */
    double cosine[3]; /* of the ray where it leaves the lens, towards the subject */
    double point[3];  /* from the first vertex, mm */
};

/* How far out a dimension is followed: while the chief ray is not clipped, or any light passes. */
enum reach { REACH_CHIEF, REACH_LIGHT };

/* Does one of a block of rays about the chief ray arrive? First lines, then parts of a disc. */
static bool any_arrives(const struct outlook *outlook, const struct beam *beam,
                        const double middle[2], double radius, size_t block)
{
    enum { LINES = 2, DISC = 8 * RAYS_BLOCK };
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        double a = 0, b = 0;
        if (block < LINES) {
            b = 2 * ((double)(block * RAYS_BLOCK + i) + 0.5) / (LINES * RAYS_BLOCK) - 1;
        } else {
            size_t k = (block - LINES) * RAYS_BLOCK + i;
            double r = sqrt(((double)k + 0.5) / DISC), turn = GOLDEN_ANGLE * (double)k;
            a = r * cos(turn);
            b = r * sin(turn);
        }
        const struct ray ray = beam_ray(beam, middle[0] + radius * a, middle[1] + radius * b);
        rays_set(&outlook->work, i, beam->n, &ray);
    }
    rays_trace(outlook->system, &outlook->work, NULL);
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        if (ray_block_status(outlook->work.blocks, i) == RAY_OK) {
            return true;
        }
    }
    return false;
}

/*
 * Does any light come through to a film point? 256 rays in the plane of the axis, where the last of
 * it is in a round lens, then a disc of 1024, in 1.5 radii of the pupil about the chief ray.
 */
static bool angle_of_view_is_lit(const struct outlook *outlook, const struct from_film *chief)
{
    enum { BLOCKS = 10 };
    const struct system *system = outlook->system;
    const struct view_question *question = outlook->question;
    const struct beam beam = beam_from_film(
        (double[3]){chief->film[0], chief->film[1], question->film}, system->index_first);
    const struct clear_guess guess = clear_guess_of(system, &beam, question->first);
    double middle[2];
    beam_place(&beam, (double[3]){chief->at[0], chief->at[1], 0}, middle);
    for (size_t block = 0; block < BLOCKS; block++) {
        if (any_arrives(outlook, &beam, middle, 1.5 * guess.radius, block)) {
            return true;
        }
    }
    return false;
}

/* Does the lens say itself that it is made for this field? */
static bool is_stated(const struct outlook *outlook, const double film[2], const struct ray *out)
{
    const struct lens *lens = outlook->question->setup->lens;
    bool of_image = lens->field_kind == FIELD_IMAGE || lens->field_kind == FIELD_REAL;
    double here = of_image ? hypot(film[0], film[1])
                           : atan2(hypot(out->cosine[0], out->cosine[1]), -out->cosine[2]);
    return (of_image || lens->field_kind == FIELD_ANGLE) && here <= lens_field_extent(lens);
}

/* Take the chief ray out of the lens; false where it does not get there. */
static bool angle_of_view_leave(const struct outlook *outlook, const struct from_film *ray,
                                enum reach reach, struct end *end)
{
    angle_of_view_start(outlook, 0, ray->film, ray->at);
    rays_trace(outlook->system, &outlook->work, NULL);
    const struct ray out = rays_get(&outlook->work, 0, outlook->system->index_last);
    bool goes_on = out.status == RAY_CLIPPED && isfinite(out.cosine[2]);
    bool counts = out.status == RAY_OK ||
                  (reach == REACH_LIGHT && goes_on &&
                   (is_stated(outlook, ray->film, &out) || angle_of_view_is_lit(outlook, ray)));
    if (!counts) {
        return false;
    }
    for (int i = 0; i < 3; i++) {
        end->cosine[i] = out.cosine[i];
        end->point[i] = out.point[i];
    }
    return true;
}

/* Continue the chief ray from the sensor's centre to `corner`, or as far as there is one. */
static bool angle_of_view_find_end(const struct outlook *outlook, const double corner[2],
                                   enum reach reach, struct end *end, struct error *error)
{
    double zp = outlook->question->first->exit_pupil, z = outlook->question->film;
    double lean = isinf(zp) ? 1 : zp / (zp - z); /* of the paraxial chief ray at the last vertex */
    double offset[2] = {0, 0};                   /* of the exact one from it */
    double film[2] = {0, 0}, step = 0.25;
    struct from_film ray = {.film = film};
    end->part = 0;
    if (!film_find_chief(outlook, &ray) || !angle_of_view_leave(outlook, &ray, reach, end)) {
        return fail(error, ERROR_DOMAIN, "the chief ray of the sensor's centre is lost");
    }
    offset[0] = ray.at[0];
    offset[1] = ray.at[1];
    while (end->part < 1 && step > 1e-9) {
        double part = fmin(end->part + step, 1);
        for (int i = 0; i < 2; i++) {
            film[i] = part * corner[i];
            ray.at[i] = lean * film[i] + offset[i];
        }
        if (!film_find_chief(outlook, &ray) || !angle_of_view_leave(outlook, &ray, reach, end)) {
            step /= 2;
            continue;
        }
        end->part = part;
        offset[0] = ray.at[0] - lean * film[0];
        offset[1] = ray.at[1] - lean * film[1];
    }
    return true;
}

/* The attachment before the lens widens the slope along x. */
static bool unsqueeze(double squeeze, struct end *end, struct error *error)
{
    if (squeeze == 1) {
        return true;
    }
    if (!(end->cosine[2] < 0)) {
        return fail(error, ERROR_DOMAIN,
                    "an anamorphic squeeze %.6g needs field angles below 90 degrees", squeeze);
    }
    end->cosine[0] *= squeeze; /* no unit vector any more: only ratios count */
    end->point[0] *= squeeze;
    return true;
}

/* Where the ray meets the plane of the subject; NaN where it does not. */
static void angle_of_view_meet(const struct end *end, double plane, double place[2])
{
    double t = (plane - end->point[2]) / end->cosine[2];
    bool meets = end->cosine[2] < 0 && t > 0;
    for (int i = 0; i < 2; i++) {
        place[i] = meets ? end->point[i] + t * end->cosine[i] : (double)NAN;
    }
}

static double angle_of_view_tilt_of(const struct end *end)
{
    return atan2(hypot(end->cosine[0], end->cosine[1]), -end->cosine[2]);
}

/* Both ends of a dimension; a round lens is the same on both sides. */
static bool angle_of_view_look_across(const struct outlook *outlook, double x, double y,
                                      struct view_span *span, struct error *error)
{
    const struct view_question *question = outlook->question;
    struct end a, b;
    if (!angle_of_view_find_end(outlook, (double[2]){x, y}, REACH_LIGHT, &a, error) ||
        !unsqueeze(question->squeeze, &a, error)) {
        return false;
    }
    if (lens_is_round(question->setup->lens)) {
        b = a;
        for (int i = 0; i < 2; i++) {
            b.cosine[i] = -a.cosine[i];
            b.point[i] = -a.point[i];
        }
    } else if (!angle_of_view_find_end(outlook, (double[2]){-x, -y}, REACH_LIGHT, &b, error) ||
               !unsqueeze(question->squeeze, &b, error)) {
        return false;
    }
    const double tilts[2] = {angle_of_view_tilt_of(&a), angle_of_view_tilt_of(&b)};
    const bool same_side = a.cosine[0] * b.cosine[0] + a.cosine[1] * b.cosine[1] > 0;
    const bool all_meet = a.cosine[2] < 0 && b.cosine[2] < 0;
    *span = (struct view_span){.angle = same_side ? fabs(tilts[0] - tilts[1]) : tilts[0] + tilts[1],
                               .size = all_meet ? INFINITY : (double)NAN,
                               .part = fmin(a.part, b.part)};
    if (!isinf(question->subject)) {
        double places[2][2];
        angle_of_view_meet(&a, question->subject, places[0]);
        angle_of_view_meet(&b, question->subject, places[1]);
        span->size = hypot(places[0][0] - places[1][0], places[0][1] - places[1][1]);
    }
    return true;
}

static bool open_outlook(const struct view_question *question, struct arena *arena,
                         struct outlook *outlook, struct error *error)
{
    if (!sensor_check(&question->sensor, error)) {
        return false;
    }
    if (!(question->film > 0 && question->film < INFINITY)) {
        return fail(error, ERROR_DOMAIN,
                    "the sensor lies %.6g mm behind the last surface: it must be behind it",
                    question->film);
    }
    *outlook = (struct outlook){.question = question, .work = rays_new(arena, RAYS_BLOCK)};
    outlook->system = setup_system(question->setup, 0, SETUP_REVERSED | SETUP_CLIPPED, error);
    if (outlook->system == NULL) {
        return false;
    }
    /* what stands in the middle of a telescope leaves it its field of view */
    outlook->system = system_outer(outlook->system);
    if (outlook->system->stop == LENS_NONE) {
        return fail(error, ERROR_DOMAIN, "the lens has no stop: it has no chief rays");
    }
    double radius = outlook->system->stop_radius;
    outlook->close = 1e-9 * (radius > 0 ? radius : 1);
    return true;
}

bool view_of_lens(const struct view_question *question, struct arena *arena, struct view *view,
                  struct error *error)
{
    struct outlook outlook;
    double x = question->sensor.width / 2, y = question->sensor.height / 2;
    if (!open_outlook(question, arena, &outlook, error) ||
        !angle_of_view_look_across(&outlook, x, 0, &view->horizontal, error) ||
        !angle_of_view_look_across(&outlook, 0, y, &view->vertical, error) ||
        !angle_of_view_look_across(&outlook, x, y, &view->diagonal, error)) {
        return false;
    }
    /* Where on the diagonal clear apertures begin to stop chief rays; the end itself if nowhere. */
    struct end end;
    double diagonal = 2 * hypot(x, y);
    if (!angle_of_view_find_end(&outlook, (double[2]){x, y}, REACH_CHIEF, &end, error)) {
        return false;
    }
    view->circle = view->diagonal.part < 1 ? view->diagonal.part * diagonal : (double)NAN;
    view->clear = end.part < view->diagonal.part ? end.part * diagonal : (double)NAN;
    return true;
}
