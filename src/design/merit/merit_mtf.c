/* design/merit/merit_mtf.c - contrast at a spatial frequency as an operand. */
/* SPDX-License-Identifier: MIT */
#include "design/merit/merit_mtf.h"

#include "analysis/waves/pupil_overlap.h"
#include "analysis/waves/wave_reference.h"
#include "base/constants.h"
#include "base/turns.h"
#include "design/merit/merit_graze.h"

#include <math.h>
#include <string.h>

enum { TANGENTIAL, SAGITTAL, DIRECTIONS, RAYS_MOST = 1000 };

/* |S| has no derivative at 0. */
static const double least = 1e-6;

double merit_mtf_contrast(double operand)
{
    return operand < least ? sqrt(fmax(2 * operand - least, 0) * least) : operand;
}

/* One field at one wavelength. */
struct mtf_pupil {
    struct pupil_wave *wave;
    struct pupil_overlap overlaps[DIRECTIONS]; /* of mtf */
    struct pupil_spot spot;                    /* of gmtf: `wave` is its */
    double re[DIRECTIONS], im[DIRECTIONS], light;
    double zero;                           /* path of its first ray, mm */
    double *back[DIRECTIONS][PUPIL_PARTS]; /* of `wave` */
};

/* One field. */
struct mtf_field {
    double along[DIRECTIONS][2]; /* in the image plane, of unit length */
    double weight;
    double re[DIRECTIONS], im[DIRECTIONS], light;
    double contrast[DIRECTIONS];
    double *slopes[DIRECTIONS]; /* one a variable */
};

/* What a slot keeps. */
struct merit_mtf {
    struct merit_beams beams;
    struct pupil_rule rule;
    bool by_rays, wants[DIRECTIONS];
    double frequency;
    struct mtf_pupil *pupils; /* one a group of the bundle */
    struct mtf_field *fields;
    double *columns; /* of a sweep */
};

/* -------- opening -------- */

static bool mtf_check(const struct merit *merit, const struct operand *operand, struct error *error)
{
    const struct merit_question *question = &merit->question;
    const double frequency = operand->frequency;
    if (!(operand->target >= 0 && operand->target <= 1)) {
        return fail(error, ERROR_DOMAIN, "contrast is 0 to 1, not %.6g", operand->target);
    }
    if (!(frequency >= 1e-6 && frequency <= 1e6)) {
        return fail(error, ERROR_DOMAIN, "contrast is that of 1e-06 to 1e+06 lines in a mm");
    }
    if (question->pattern != PATTERN_GAUSS) {
        return fail(error, ERROR_DOMAIN, "contrast is integrated over {pattern} gauss alone");
    }
    if (question->clip) {
        return fail(error, ERROR_DOMAIN, "contrast is that of the whole pupil, not clipped");
    }
    return question->rays <= RAYS_MOST ||
           fail(error, ERROR_DOMAIN, "contrast takes up to %d rays, not %zu", RAYS_MOST,
                question->rays);
}

/* Of a field at all wavelengths that count, 1/mm. */
static double cutoff_of(const struct merit_mtf *mtf, size_t field, int d)
{
    const struct merit_bundle *bundle = &mtf->beams.bundle;
    double cutoff = 0;
    for (size_t g = 0; g < bundle->group_count; g++) {
        const struct bundle_group *group = &bundle->groups[g];
        const struct bundle_light *light = &bundle->lights[group->light];
        if (group->field == field && group->weight > 0) {
            const double waves = 1e3 * light->system.index_last / light->wavelength; /* in a mm */
            cutoff = fmax(cutoff, waves * mtf->pupils[g].overlaps[d].cutoff);
        }
    }
    return cutoff;
}

/* The lens at the start: is there contrast? One that has no value as yet says nothing. */
static bool find_contrasts(struct merit *merit, const struct merit_slot *slot);
static bool check_cutoff(struct merit *merit, const struct merit_slot *slot, struct error *error)
{
    const struct merit_mtf *mtf = slot->own;
    const struct merit_bundle *bundle = &mtf->beams.bundle;
    merit->derives = false;
    merit->evaluation++;
    if (mtf->by_rays || !find_contrasts(merit, slot)) {
        return true;
    }
    for (size_t i = 0; i < bundle->wish.field_count * DIRECTIONS; i++) {
        const struct mtf_field *field = &mtf->fields[i / DIRECTIONS];
        const int d = (int)(i % DIRECTIONS);
        if (mtf->wants[d] && field->weight > 0 && field->re[d] == 0 && field->im[d] == 0) {
            return fail(error, ERROR_DOMAIN,
                        "there is no contrast of field %zu beyond the %s cut-off, %.4g/mm",
                        i / DIRECTIONS + 1, d == SAGITTAL ? "sagittal" : "tangential",
                        cutoff_of(mtf, i / DIRECTIONS, d));
        }
    }
    return true;
}

size_t merit_prepare_mtf(struct merit *merit, struct merit_slot *slot, struct arena *arena,
                         struct error *error)
{
    const struct operand *operand = slot->operand;
    struct merit_mtf *mtf = ARENA_NEW(arena, struct merit_mtf);
    slot->own = mtf;
    slot->beams = &mtf->beams;
    mtf->by_rays = operand->kind == OPERAND_GMTF;
    mtf->frequency = operand->frequency;
    mtf->wants[TANGENTIAL] = operand->orientation != ORIENTATION_SAGITTAL;
    mtf->wants[SAGITTAL] = operand->orientation != ORIENTATION_TANGENTIAL;
    if (!mtf_check(merit, operand, error) ||
        !merit_beams_open(merit, slot, !mtf->by_rays, true, arena, &mtf->beams, error)) {
        return 0;
    }
    const struct merit_points *points = &mtf->beams.bundle.groups[0].points;
    if (!pupil_rule_open(points->points, points->count, arena, &mtf->rule, error)) {
        return 0;
    }
    mtf->columns = ARENA_ARRAY(arena, (merit->variable_count + 1) * RAYS_BLOCK, double);
    const struct bundle_wish *wish = &mtf->beams.bundle.wish;
    mtf->fields = ARENA_ARRAY(arena, wish->field_count, struct mtf_field);
    for (size_t i = 0; i < wish->field_count; i++) {
        struct mtf_field *field = &mtf->fields[i];
        wave_section(&wish->fields[i].point, field->along[TANGENTIAL]);
        field->along[SAGITTAL][0] = field->along[TANGENTIAL][1];
        field->along[SAGITTAL][1] = -field->along[TANGENTIAL][0];
        field->weight = wish->fields[i].weight;
        for (int d = 0; d < DIRECTIONS; d++) {
            field->slopes[d] = ARENA_ARRAY(arena, merit->variable_count + 1, double);
        }
    }
    const struct merit_bundle *bundle = &mtf->beams.bundle;
    const size_t lines = pupil_overlap_lines(&mtf->rule.form);
    mtf->pupils = ARENA_ARRAY(arena, bundle->group_count, struct mtf_pupil);
    for (size_t g = 0; g < bundle->group_count; g++) {
        struct mtf_pupil *pupil = &mtf->pupils[g];
        const bool round = bundle->groups[g].symmetry == SYMMETRY_ROUND;
        const bool mirrored = bundle->groups[g].symmetry != SYMMETRY_NONE;
        if (mtf->by_rays) {
            pupil->wave = &pupil->spot.wave;
            pupil_spot_open(&mtf->rule, arena, &pupil->spot);
        } else {
            pupil->wave = ARENA_NEW(arena, struct pupil_wave);
            pupil_wave_open(&mtf->rule, arena, pupil->wave);
        }
        for (int d = 0; d < DIRECTIONS; d++) {
            const struct pupil_mirrors mirrors = {.along = d == TANGENTIAL ? mirrored : round,
                                                  .across = d == TANGENTIAL ? round : mirrored};
            if (!mtf->by_rays) {
                pupil_overlap_open(pupil->wave, lines, mirrors, arena, &pupil->overlaps[d]);
            }
            for (int part = 0; part < PUPIL_PARTS; part++) {
                pupil->back[d][part] = ARENA_ARRAY(arena, mtf->rule.room, double);
            }
        }
    }
    /* residuals: of each field that counts and each direction */
    size_t count = 0;
    for (size_t i = 0; i < mtf->beams.bundle.wish.field_count; i++) {
        for (int d = 0; d < DIRECTIONS; d++) {
            count += mtf->fields[i].weight > 0 && mtf->wants[d];
        }
    }
    if (count == 0) {
        fail(error, ERROR_DOMAIN, "no field counts");
    }
    return count > 0 && check_cutoff(merit, slot, error) ? count : 0;
}

/* -------- values -------- */

/* The numbers of final rays and of their starts, to the pupils. */
static void merit_mtf_put_rays(struct merit_mtf *mtf, const struct bundle_block *block,
                               const struct ray_block *end)
{
    const struct merit_bundle *bundle = &mtf->beams.bundle;
    double path[RAYS_BLOCK] = {0}, to[2][RAYS_BLOCK];
    const double um = 1e-3, wavelength = um * bundle->lights[block->light].wavelength;
    if (mtf->by_rays) {
        memcpy(to[0], end->x, sizeof to[0]);
        memcpy(to[1], end->y, sizeof to[1]);
    } else {
        merit_spheres_meet(mtf->beams.spheres, bundle, block, end, path,
                           (double *const[]){to[0], to[1]});
    }
    for (int i = 0; i < block->aimed.count; i++) {
        const struct bundle_lane *lane = &block->lanes[i];
        struct mtf_pupil *pupil = &mtf->pupils[lane->group];
        double *const *parts = pupil->wave->parts;
        pupil->zero = lane->point == 0 ? path[i] : pupil->zero;
        parts[PUPIL_FROM_X][lane->point] = block->aimed.a[i];
        parts[PUPIL_FROM_Y][lane->point] = block->aimed.b[i];
        parts[PUPIL_TO_X][lane->point] = to[0][i];
        parts[PUPIL_TO_Y][lane->point] = to[1][i];
        parts[PUPIL_WAVE][lane->point] = (path[i] - pupil->zero) / wavelength;
    }
}

/* Is it the same as in the other direction, which has been found? */
static bool is_other(const struct merit_mtf *mtf, size_t group, int direction)
{
    return direction == SAGITTAL && mtf->wants[TANGENTIAL] &&
           mtf->beams.bundle.groups[group].symmetry == SYMMETRY_ROUND;
}

/* The transfer function of one pupil in both directions, and its light. */
static bool find_waves(struct merit_mtf *mtf, size_t group, bool derives, struct error *error)
{
    const struct merit_bundle *bundle = &mtf->beams.bundle;
    const struct bundle_light *light = &bundle->lights[bundle->groups[group].light];
    const struct mtf_field *field = &mtf->fields[bundle->groups[group].field];
    struct mtf_pupil *pupil = &mtf->pupils[group];
    const double um = 1e-3, wavelength = um * light->wavelength;
    const double shift = mtf->frequency * wavelength / light->system.index_last;
    if (!pupil_wave_find(pupil->wave, error)) {
        return false;
    }
    pupil->light = pupil->wave->energy;
    for (int d = 0; d < DIRECTIONS; d++) {
        struct pupil_overlap *overlap = &pupil->overlaps[d];
        overlap->shift[0] = shift * field->along[d][0];
        overlap->shift[1] = shift * field->along[d][1];
        if (is_other(mtf, group, d)) {
            pupil->re[d] = pupil->re[TANGENTIAL];
            pupil->im[d] = pupil->im[TANGENTIAL];
            continue;
        }
        if (mtf->wants[d] && !pupil_overlap_find(overlap, derives, error)) {
            return false;
        }
        pupil->re[d] = overlap->re;
        pupil->im[d] = overlap->im;
    }
    return true;
}

/* exp(2 pi i f x) of a point. */
static void wave_at(const struct merit_mtf *mtf, const struct pupil_spot *spot, size_t i,
                    const double along[2], double at[2])
{
    const double place = spot->place[0][i] * along[0] + spot->place[1][i] * along[1];
    turns_of(mtf->frequency * place, &at[0], &at[1]);
}

/* The same by rays. */
static bool find_rays(struct merit_mtf *mtf, size_t group, struct error *error)
{
    const struct merit_bundle *bundle = &mtf->beams.bundle;
    const struct mtf_field *field = &mtf->fields[bundle->groups[group].field];
    struct mtf_pupil *pupil = &mtf->pupils[group];
    const struct pupil_spot *spot = &pupil->spot;
    if (!pupil_spot_find(&pupil->spot, error)) {
        return false;
    }
    pupil->light = 0;
    memset(pupil->re, 0, sizeof pupil->re);
    memset(pupil->im, 0, sizeof pupil->im);
    for (size_t i = 0; i < mtf->rule.fine_count; i++) {
        pupil->light += spot->area[i];
        for (int d = 0; d < DIRECTIONS; d++) {
            double at[2];
            wave_at(mtf, spot, i, field->along[d], at);
            pupil->re[d] += spot->area[i] * at[0];
            pupil->im[d] += spot->area[i] * at[1];
        }
    }
    return true;
}

static bool find_contrasts(struct merit *merit, const struct merit_slot *slot)
{
    struct merit_mtf *mtf = slot->own;
    struct merit_bundle *bundle = &mtf->beams.bundle;
    bundle->keeps = merit->places[slot->place].graze != NULL;
    if (!merit_beams_aim(merit, slot, &mtf->beams)) {
        return false;
    }
    for (size_t k = 0; k < bundle->block_count; k++) {
        struct ray_block end;
        if (!merit_bundle_trace(bundle, k, false, &end, &merit->why)) {
            return false;
        }
        merit_mtf_put_rays(mtf, &bundle->blocks[k], &end);
        if (bundle->keeps && !merit->derives) { /* else when they are traced again */
            merit_graze_add(merit, slot, bundle, k, &mtf->beams.links[bundle->blocks[k].light]);
        }
    }
    for (size_t g = 0; g < bundle->group_count; g++) {
        const bool done = mtf->by_rays ? find_rays(mtf, g, &merit->why)
                                       : find_waves(mtf, g, merit->derives, &merit->why);
        if (!done) {
            return false;
        }
    }
    for (size_t i = 0; i < bundle->wish.field_count; i++) {
        struct mtf_field *field = &mtf->fields[i];
        memset(field->re, 0, sizeof field->re);
        memset(field->im, 0, sizeof field->im);
        field->light = 0;
    }
    for (size_t g = 0; g < bundle->group_count; g++) {
        const struct mtf_pupil *pupil = &mtf->pupils[g];
        struct mtf_field *field = &mtf->fields[bundle->groups[g].field];
        const double weight = bundle->wish.wavelengths[bundle->groups[g].light].weight;
        field->light += weight * pupil->light;
        for (int d = 0; d < DIRECTIONS; d++) {
            field->re[d] += weight * pupil->re[d];
            field->im[d] += weight * pupil->im[d];
        }
    }
    for (size_t i = 0; i < bundle->wish.field_count * DIRECTIONS; i++) {
        struct mtf_field *field = &mtf->fields[i / DIRECTIONS];
        const int d = (int)(i % DIRECTIONS);
        const double size =
            sqrt(field->re[d] * field->re[d] + field->im[d] * field->im[d]) / field->light;
        field->contrast[d] = size < least ? (size * size / least + least) / 2 : size;
    }
    return true;
}

/* -------- derivatives -------- */

/* What a spot's contrast along a direction is by its rays. */
static void merit_mtf_spot_back(const struct merit_mtf *mtf, struct pupil_spot *spot,
                                const double along[2], const double by_sum[2], double by_light)
{
    for (size_t i = 0; i < mtf->rule.fine_count; i++) {
        double at[2];
        wave_at(mtf, spot, i, along, at);
        const double by_place =
            2 * PI * mtf->frequency * spot->area[i] * (by_sum[1] * at[0] - by_sum[0] * at[1]);
        spot->by_place[0][i] = by_place * along[0];
        spot->by_place[1][i] = by_place * along[1];
        spot->by_area[i] = by_sum[0] * at[0] + by_sum[1] * at[1] + by_light;
    }
    pupil_spot_back(spot);
}

/* What contrasts are by each ray. */
static void find_back(struct merit_mtf *mtf)
{
    const struct merit_bundle *bundle = &mtf->beams.bundle;
    for (size_t i = 0; i < bundle->group_count * DIRECTIONS; i++) {
        const struct bundle_group *group = &bundle->groups[i / DIRECTIONS];
        const struct mtf_field *field = &mtf->fields[group->field];
        struct mtf_pupil *pupil = &mtf->pupils[i / DIRECTIONS];
        const int d = (int)(i % DIRECTIONS);
        if (is_other(mtf, i / DIRECTIONS, d) && !mtf->by_rays) {
            for (int part = 0; part < PUPIL_PARTS; part++) {
                memcpy(pupil->back[d][part], pupil->back[TANGENTIAL][part],
                       mtf->rule.room * sizeof(double));
            }
            continue;
        }
        if (!mtf->wants[d]) {
            continue;
        }
        /* of |S|/E, or (|S|/E)^2/(2 least), of all wavelengths, by S and E of this one */
        const double weight = bundle->wish.wavelengths[group->light].weight;
        const double size =
            sqrt(field->re[d] * field->re[d] + field->im[d] * field->im[d]) / field->light;
        const double steep = weight / (fmax(size, least) * field->light * field->light);
        const double by_sum[2] = {steep * field->re[d], steep * field->im[d]};
        const double by_light = -steep * size * size * field->light;
        memcpy(pupil->wave->back, pupil->back[d], sizeof pupil->wave->back);
        if (mtf->by_rays) {
            merit_mtf_spot_back(mtf, &pupil->spot, field->along[d], by_sum, by_light);
        } else {
            pupil_wave_begin_back(pupil->wave);
            pupil->wave->by_energy = by_light;
            pupil_overlap_back(&pupil->overlaps[d], by_sum);
            pupil_wave_back(pupil->wave);
        }
    }
}

/* What the contrasts of a direction are by the variables, of the rays of a block. */
static void sweep_block(const struct merit *merit, struct merit_mtf *mtf, size_t which, int d,
                        const struct ray_block *end)
{
    struct merit_bundle *bundle = &mtf->beams.bundle;
    const struct merit_spheres *spheres = mtf->beams.spheres;
    struct bundle_block *block = &bundle->blocks[which];
    const double um = 1e-3, wavelength = um * bundle->lights[block->light].wavelength;
    const size_t variable_count = merit->variable_count;
    struct merit_spheres_by by;
    struct ray_block adjoint = {.lost = {0}};
    double start[2][RAYS_BLOCK] = {{0}};
    for (int i = 0; i < block->aimed.count; i++) {
        const size_t at = block->lanes[i].point;
        double *const *from = mtf->pupils[block->lanes[i].group].back[d];
        by.path[i] = from[PUPIL_WAVE][at] / wavelength;
        for (int k = 0; k < 2; k++) {
            by.to[k][i] = from[k][at];
            start[k][i] = from[PUPIL_FROM_X + k][at];
            if (k == 0) {
                adjoint.x[i] = from[k][at];
            } else {
                adjoint.y[i] = from[k][at];
            }
        }
    }
    if (!mtf->by_rays) {
        merit_spheres_back(spheres, bundle, block, end, &by, &adjoint);
    }
    block->aimed.by_start[0] = start[0];
    block->aimed.by_start[1] = start[1];
    merit_bundle_sweep(bundle, which, LENS_NONE, &mtf->beams.links[block->light], variable_count,
                       &adjoint, mtf->columns);
    block->aimed.by_start[0] = block->aimed.by_start[1] = NULL;
    if (!mtf->by_rays) {
        merit_spheres_move(spheres, block, &by, mtf->columns);
    }
    for (size_t j = 0; j < variable_count; j++) {
        for (int i = 0; i < block->aimed.count; i++) {
            mtf->fields[block->lanes[i].field].slopes[d][j] +=
                mtf->columns[j * RAYS_BLOCK + (size_t)i];
        }
    }
}

static bool merit_mtf_find_slopes(struct merit *merit, const struct merit_slot *slot)
{
    struct merit_mtf *mtf = slot->own;
    struct merit_bundle *bundle = &mtf->beams.bundle;
    for (size_t i = 0; i < bundle->wish.field_count; i++) {
        for (int d = 0; d < DIRECTIONS; d++) {
            memset(mtf->fields[i].slopes[d], 0, merit->variable_count * sizeof(double));
        }
    }
    find_back(mtf);
    for (size_t k = 0; k < bundle->block_count; k++) {
        struct ray_block end;
        if (!merit_bundle_trace(bundle, k, true, &end, &merit->why)) {
            return false;
        }
        if (bundle->keeps) {
            merit_graze_add(merit, slot, bundle, k, &mtf->beams.links[bundle->blocks[k].light]);
        }
        for (int d = 0; d < DIRECTIONS; d++) {
            if (mtf->wants[d]) {
                sweep_block(merit, mtf, k, d, &end);
            }
        }
    }
    return true;
}

/* -------- filling -------- */

bool merit_fill_mtf(struct merit *merit, const struct merit_slot *slot, double *residuals,
                    double *jacobian)
{
    struct merit_mtf *mtf = slot->own;
    size_t at = 0;
    if (!find_contrasts(merit, slot) || (merit->derives && !merit_mtf_find_slopes(merit, slot))) {
        return false;
    }
    for (size_t i = 0; i < mtf->beams.bundle.wish.field_count * DIRECTIONS; i++) {
        const struct mtf_field *field = &mtf->fields[i / DIRECTIONS];
        const size_t d = i % DIRECTIONS;
        if (!(field->weight > 0) || !mtf->wants[d]) {
            continue;
        }
        for (size_t j = 0; j < merit->variable_count + 1; j++) {
            merit->change[j] = (struct dual){field->contrast[d], field->slopes[d][j]};
        }
        /* one residual, by the root of the weight of its field */
        const double root = sqrt(field->weight);
        if (!merit_put(merit, slot, at, residuals, jacobian)) {
            return false;
        }
        residuals[at] *= root;
        for (size_t j = 0; j < merit->variable_count && jacobian != NULL; j++) {
            jacobian[at * merit->variable_count + j] *= root;
        }
        at++;
    }
    return true;
}

struct merit_mtf_look merit_mtf_look(const struct merit_slot *slot, size_t group, int direction)
{
    const struct merit_mtf *mtf = slot->own;
    struct merit_mtf_look look = {.bundle = &mtf->beams.bundle};
    for (int part = 0; part < PUPIL_PARTS; part++) {
        look.back[part] = mtf->pupils[group].back[direction][part];
    }
    return look;
}
