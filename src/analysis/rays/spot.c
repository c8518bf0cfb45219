/* analysis/rays/spot.c - spot diagrams: sizes, energy radii, rays on the image plane. */
/* SPDX-License-Identifier: MIT */
#include "analysis/rays/spot.h"

#include "analysis/pupil/encircled_energy.h"
#include "analysis/rays/spot_radius.h"

#include <float.h>
#include <math.h>

/* Rays to begin with; of a whole pupil, whose edge is known, more cost as little. */
enum { FIRST_RAYS = 60, FIRST_UNCLIPPED = 130, MOST_RAYS = 1 << 17 };

/* A centroid nearer to the chief ray, in root mean squares, is where that is. */
static const double symmetric = 1e-9;

/* A spot at work. */
struct spot_search {
    const struct spot_question *question;
    struct bundle_source *sources; /* one a wavelength */
    struct bundle_question *questions;
    struct spot_plane plane;
    bool has_chief;
};

/* The rays of the spot, and where they are about the origin. */
struct marks {
    struct encircled_energy_mark *list;
    double (*at)[2];
    size_t count, room;
    size_t rays; /* of one wavelength, lost ones too */
    double clear;
    bool has_arms;
    const struct encircled_energy_sheet *sheets;
};

void spot_axes(const double direction[3], double across[2][3])
{
    double length = hypot(direction[1], direction[2]), sign = direction[2] < 0 ? -1 : 1;
    if (length > 0) {
        across[1][0] = 0;
        across[1][1] = sign * direction[2] / length;
        across[1][2] = -sign * direction[1] / length;
    } else {
        across[1][0] = across[1][2] = 0;
        across[1][1] = 1;
    }
    across[0][0] = across[1][1] * direction[2] - across[1][2] * direction[1];
    across[0][1] = across[1][2] * direction[0] - across[1][0] * direction[2];
    across[0][2] = across[1][0] * direction[1] - across[1][1] * direction[0];
    for (int i = 0; i < 3; i++) {
        across[0][i] *= sign;
    }
}

static bool open_seeking(const struct spot_question *question, struct arena *arena,
                         struct spot_search *seeking, struct error *error)
{
    const struct setup *setup = question->bundle.setup;
    *seeking = (struct spot_search){.question = question};
    /* Sources point into themselves: they stay where they are. */
    seeking->sources = ARENA_ARRAY(arena, setup->wavelength_count, struct bundle_source);
    seeking->questions = ARENA_ARRAY(arena, setup->wavelength_count, struct bundle_question);
    struct aim_near *near = ARENA_NEW(arena, struct aim_near);
    for (size_t g = 0; g < setup->wavelength_count; g++) {
        seeking->questions[g] = seeking->question->bundle;
        seeking->questions[g].wavelength = g;
        seeking->questions[g].near = near;
        const struct bundle_source *before = g > 0 ? &seeking->sources[g - 1] : NULL;
        if (!bundle_open_beside(&seeking->questions[g], before, arena, &seeking->sources[g],
                                error)) {
            return false;
        }
    }
    seeking->plane.is_angular = question->to == 0 && isnan(setup->image);
    seeking->plane.to = question->to > 0 ? question->to : seeking->sources[0].system->places;
    /* Where the chief ray meets the plane; without one, where the first ray that arrives does. */
    const struct bundle_source *first = &seeking->sources[0];
    struct ray ray = {.status = RAY_MISS};
    struct bundle bundle;
    if (first->has_chief) {
        ray = bundle_chief(first, seeking->plane.to, arena);
    }
    seeking->has_chief = ray.status == RAY_OK;
    if (!seeking->has_chief) {
        if (!bundle_trace(first, FIRST_RAYS, seeking->plane.to, arena, &bundle, error)) {
            return false;
        }
        for (size_t i = 0; i < bundle.count && ray.status != RAY_OK; i++) {
            ray =
                rays_get(&bundle.rays, i, system_index_after(first->system, seeking->plane.to - 1));
        }
    }
    seeking->plane.origin[0] = ray.point[0];
    seeking->plane.origin[1] = ray.point[1];
    spot_axes(ray.cosine, seeking->plane.across);
    return true;
}

/* The marks of one wavelength, their weights times `weight`. */
static bool spot_add_marks(const struct spot_search *seeking, size_t wavelength, size_t rays,
                           double weight, struct arena *arena, struct marks *marks,
                           struct error *error)
{
    const struct bundle_source *source = &seeking->sources[wavelength];
    struct bundle bundle;
    if (!bundle_trace(source, rays, seeking->plane.to, arena, &bundle, error)) {
        return false;
    }
    double n = system_index_after(source->system, seeking->plane.to - 1);
    if (marks->count + bundle.count > marks->room) {
        /* for so many more, and as many of the wavelengths that are left */
        const size_t left = seeking->question->bundle.setup->wavelength_count - wavelength;
        const struct marks old = *marks;
        marks->room = marks->count + bundle.count * left;
        marks->list = ARENA_ARRAY(arena, marks->room, struct encircled_energy_mark);
        marks->at = arena_array(arena, marks->room, sizeof *marks->at);
        for (size_t i = 0; i < marks->count; i++) {
            marks->list[i] = old.list[i];
            marks->at[i][0] = old.at[i][0];
            marks->at[i][1] = old.at[i][1];
        }
    }
    marks->has_arms = bundle.arms > 0;
    struct encircled_energy_arms arms = encircled_energy_arms_open(&bundle, marks->sheets, arena);
    for (size_t i = 0; i < bundle.count; i++) {
        const struct ray_block *block = &bundle.rays.blocks[i / RAYS_BLOCK];
        const bool arrives = ray_block_status(block, i % RAYS_BLOCK) == RAY_OK;
        if (arrives) {
            spot_place(&seeking->plane, block, i % RAYS_BLOCK, n, marks->at[marks->count]);
            marks->list[marks->count].weight = weight * bundle.points[i].weight;
        }
        encircled_energy_arms_add(&arms, i, marks->list,
                                  arrives ? marks->count++ : ENCIRCLED_ENERGY_ALONE);
    }
    marks->sheets = arms.sheets;
    marks->rays = bundle.count > marks->rays ? bundle.count : marks->rays;
    marks->clear += weight * bundle.clear;
    return true;
}

/* The area of the beam that a weight of 1 stands for, where weights are areas of the beam. */
static double spot_unit_of(const struct bundle_source *source)
{
    const struct stop_beam *pupil = &source->pupil;
    return pupil->weight == WEIGHT_PUPIL || pupil->has_disc
               ? 1
               : fabs(pupil->axes[0] * pupil->axes[3] - pupil->axes[1] * pupil->axes[2]);
}

/* -------- what they say -------- */

/* Root mean squares about the centroid and about the origin. */
static void spot_sum_up(struct marks *marks, bool about_chief, struct spot *spot)
{
    double weight = 0, mean[2] = {0, 0}, square[2] = {0, 0}, widest = 0;
    for (size_t i = 0; i < marks->count; i++) {
        const double each = marks->list[i].weight;
        weight += each;
        mean[0] += each * marks->at[i][0];
        mean[1] += each * marks->at[i][1];
    }
    mean[0] /= weight;
    mean[1] /= weight;
    for (size_t i = 0; i < marks->count; i++) {
        struct encircled_energy_mark *mark = &marks->list[i];
        const double *at = marks->at[i];
        double x = at[0] - mean[0], y = at[1] - mean[1];
        square[0] += mark->weight * x * x;
        square[1] += mark->weight * y * y;
        mark->at[0] = about_chief ? at[0] : x;
        mark->at[1] = about_chief ? at[1] : y;
        widest = fmax(widest, hypot(mark->at[0], mark->at[1]));
    }
    for (int i = 0; i < 2; i++) {
        /* what symmetry makes 0 but for rounding */
        bool is_noise = fabs(mean[i]) < symmetric * sqrt((square[0] + square[1]) / weight);
        spot->centroid[i] = is_noise ? 0 : mean[i];
    }
    spot->rms_x = sqrt(square[0] / weight);
    spot->rms_y = sqrt(square[1] / weight);
    spot->rms = hypot(spot->rms_x, spot->rms_y);
    spot->rms_chief = hypot(spot->rms, hypot(mean[0], mean[1]));
    spot->radius = widest;
    spot->clear = marks->clear;
    spot->rays = marks->rays;
}

/* What coordinates may be off by rounding alone. */
static double rounding(const struct spot_search *seeking)
{
    const struct setup *setup = seeking->question->bundle.setup;
    const struct first_order *first = &setup->first;
    const double *origin = seeking->plane.origin;
    double length = seeking->plane.is_angular ? 1
                                              : hypot(origin[0], origin[1]) + fabs(first->length) +
                                                    fabs(first->stop_radius) + fabs(setup->image);
    return 8 * DBL_EPSILON * (isfinite(length) ? length : 1);
}

/* One sample. */
static bool spot_measure(const struct spot_search *seeking, size_t rays, struct arena *arena,
                         struct spot *spot, struct error *error)
{
    const struct arena_mark mark = arena_mark(arena);
    struct marks marks = {.count = 0};
    const struct setup *setup = seeking->question->bundle.setup;
    double sum = 0, lit = 0;
    for (size_t g = 0; g < setup->wavelength_count; g++) {
        sum += setup->wavelengths[g].weight;
    }
    for (size_t g = 0; g < setup->wavelength_count; g++) {
        double unit = spot_unit_of(&seeking->sources[g]) / spot_unit_of(&seeking->sources[0]);
        double weight = setup->wavelengths[g].weight / sum * unit;
        if (weight > 0 && !spot_add_marks(seeking, g, rays, weight, arena, &marks, error)) {
            return false;
        }
        lit += weight;
    }
    marks.clear /= lit;
    spot_sum_up(&marks, seeking->question->about_chief, spot);
    const struct encircled_energy_sample sample = {marks.list, marks.count, marks.has_arms,
                                                   marks.sheets};
    double share = seeking->question->energy;
    spot->energy_radius = isnan(share) ? share : encircled_energy_find(&sample, share, arena);
    arena_reset(arena, mark);
    return true;
}

/*
 * By how much the root mean squares are off, by what twice the rays change. The largest of their
 * changes: one may vanish by chance, and so may all, wherefore the clear share and what the sample
 * before differed by count a little. A plain pattern is off as one over the root of its rays, by
 * 3.4 times the change.
 */
static double rms_error(const struct spot *before, const struct spot *here,
                        const struct spot *finer, bool is_plain)
{
    const double changes[] = {finer->rms - here->rms,
                              finer->rms_x - here->rms_x,
                              finer->rms_y - here->rms_y,
                              finer->rms_chief - here->rms_chief,
                              0.1 * here->rms * (finer->clear - here->clear) / finer->clear,
                              5e-5 * (here->rms - before->rms)};
    double most = 0;
    for (size_t i = 0; i < sizeof changes / sizeof changes[0]; i++) {
        most = fmax(most, fabs(changes[i]));
    }
    return (is_plain ? 4 : 3) * most;
}

/* The farthest ray of the pupil; of other patterns the farthest of their rays. */
static void find_radius(const struct spot_search *seeking, const struct spot *finer,
                        struct arena *arena, struct spot *spot)
{
    static const double nowhere[2] = {0, 0};
    const struct spot_question *asked = seeking->question;
    const double *about = asked->about_chief ? nowhere : spot->centroid;
    const struct spot_radius_question question = {
        .sources = seeking->sources,
        .count = asked->bundle.setup->wavelength_count,
        .plane = &seeking->plane,
        .about = {about[0], about[1]},
    };
    double change = fabs(finer->radius - spot->radius);
    if (asked->bundle.pattern == PATTERN_GAUSS) {
        spot->radius = spot_radius_find(&question, arena, &change);
    }
    double moved =
        hypot(finer->centroid[0] - spot->centroid[0], finer->centroid[1] - spot->centroid[1]);
    spot->radius_error = 2 * change + (asked->about_chief ? 0 : 3 * moved) + rounding(seeking);
}

/* Samples, each of twice the rays of the one before, until two agree or no more are wanted. */
static bool spot_converge(const struct spot_search *seeking, struct arena *arena, struct spot *spot,
                          struct error *error)
{
    const struct spot_question *question = seeking->question;
    const double least = rounding(seeking);
    const bool is_plain = question->bundle.pattern != PATTERN_GAUSS;
    const size_t first = question->bundle.clip ? FIRST_RAYS : FIRST_UNCLIPPED;
    size_t rays = question->rays > 0 ? question->rays : first;
    struct spot before, here, finer;
    if (!spot_measure(seeking, rays / 2 + 1, arena, &before, error) ||
        !spot_measure(seeking, rays, arena, &here, error)) {
        return false;
    }
    /* known from the second turn on: three changes in a row are not small by chance */
    double energy_change = isnan(question->energy) ? 0 : INFINITY;
    for (bool done = false; !done; rays *= 2) {
        if (!spot_measure(seeking, 2 * rays, arena, &finer, error)) {
            return false;
        }
        *spot = here;
        spot->error = fmax(rms_error(&before, &here, &finer, is_plain), least);
        spot->energy_radius = question->rays > 0 ? here.energy_radius : finer.energy_radius;
        const double energy[] = {fabs(finer.energy_radius - here.energy_radius),
                                 fabs(here.energy_radius - before.energy_radius),
                                 isinf(energy_change) ? 0 : energy_change};
        /* light comes and goes at edges, so that changes are not as regular as those of means */
        const double energy_error = 6 * fmax(energy[0], 0.5 * energy[1]) + least;
        spot->has_converged =
            (spot->error <= question->error * here.rms || !(spot->error > least)) &&
            !(energy_error > question->error * here.energy_radius && energy_error > least) &&
            (!isinf(energy_change) || question->rays > 0);
        /* two may be small by chance */
        spot->energy_error = fmax(energy_error, 1.5 * energy[2] + least);
        energy_change = energy[1];
        done = question->rays > 0 || spot->has_converged || 2 * rays >= MOST_RAYS;
        if (done && question->no_radius) {
            spot->radius = spot->radius_error = NAN;
        } else if (done) {
            find_radius(seeking, &finer, arena, spot);
        }
        before = here;
        here = finer;
    }
    return true;
}

/* All that is asked of a spot. */
static bool spot_look(const struct spot_question *question, struct arena *arena, struct spot *spot,
                      struct error *error)
{
    struct spot_search seeking;
    if (!open_seeking(question, arena, &seeking, error)) {
        return false;
    }
    if (question->about_chief && !seeking.has_chief) {
        return fail(error, ERROR_DOMAIN, "the chief ray that radii are to be about is lost");
    }
    if (!spot_converge(&seeking, arena, spot, error)) {
        return false;
    }
    spot->is_angular = seeking.plane.is_angular;
    spot->islands = bundle_islands(&seeking.sources[0], arena);
    for (int i = 0; i < 2; i++) {
        double origin = seeking.plane.is_angular ? 0 : seeking.plane.origin[i];
        spot->chief[i] = seeking.has_chief ? origin : (double)NAN;
        spot->centroid[i] += origin;
    }
    if (!seeking.has_chief) {
        spot->rms_chief = NAN;
    }
    return true;
}

bool spot_find(const struct spot_question *question, struct arena *arena, struct spot *spot,
               struct error *error)
{
    struct bundle_question one = question->bundle;
    for (one.wavelength = 0; one.wavelength < one.setup->wavelength_count; one.wavelength++) {
        if (!bundle_prepare(&one, error)) {
            return false;
        }
    }
    const struct arena_mark mark = arena_mark(arena);
    const bool found = spot_look(question, arena, spot, error);
    arena_reset(arena, mark);
    return found;
}

bool spot_points_find(const struct spot_question *question, size_t wavelength, size_t rays,
                      struct arena *arena, struct spot_points *points, struct error *error)
{
    struct spot_search seeking;
    struct marks marks = {.count = 0};
    if (!open_seeking(question, arena, &seeking, error) ||
        !spot_add_marks(&seeking, wavelength, rays, 1, arena, &marks, error)) {
        return false;
    }
    *points = (struct spot_points){marks.count, (const double(*)[2])marks.at};
    return true;
}
