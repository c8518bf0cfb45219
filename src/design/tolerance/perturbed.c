/* design/tolerance/perturbed.c - a lens as it was made: its numbers and their errors. */
/* SPDX-License-Identifier: MIT */
#include "design/tolerance/perturbed.h"

#include <math.h>
#include <string.h>

static bool is_motion(const struct perturbation *one)
{
    return one->kind == TOLERANCE_ELEMENT_TILT || one->kind == TOLERANCE_ELEMENT_DECENTER;
}

static bool perturbed_is_of_medium(const struct perturbation *one)
{
    return one->kind == TOLERANCE_INDEX || one->kind == TOLERANCE_ABBE;
}

static bool is_pose(enum parameter_kind kind)
{
    return kind >= PARAMETER_DECENTER_X && kind <= PARAMETER_TILT_Z;
}

static struct parameter thickness_behind(size_t surface)
{
    return (struct parameter){surface, PARAMETER_THICKNESS, 0};
}

/* Which half of a decentre or a tilt. */
static size_t perturbed_part_of(const struct perturbation *one)
{
    return one->axis == PERTURBATION_Y ? 1 : 0;
}

/* -------- opening -------- */

/* Numbers of a surface that perturbed_keep may add: its thickness, decentres and tilts. */
enum { KINDS_KEPT = 6 };

/* The number, made where it is not there yet. */
static size_t perturbed_number_of(struct perturbed *perturbed, struct parameter what)
{
    size_t i = 0;
    while (i < perturbed->number_count &&
           !parameter_is_identical(perturbed->numbers[i].what, what)) {
        i++;
    }
    if (i == perturbed->number_count) {
        perturbed->numbers[perturbed->number_count++] = (struct perturbed_number){.what = what};
    }
    return i;
}

static bool add_medium(struct perturbed *perturbed, size_t at, struct error *error)
{
    const struct perturbation *one = &perturbed->list[at];
    const size_t surface = one->what.surface, space = surface + 1;
    bool has_abbe = true;
    for (size_t p = 0; p < perturbed->position_count; p++) {
        struct melt *melt = perturbed_melt(perturbed, p, space);
        const struct lens *lens = perturbed->at[p];
        if (!perturbed->is_melted[space]) {
            melt_open(surface == LENS_NONE ? &lens->object_medium : &lens->surfaces[surface].medium,
                      melt);
        }
        has_abbe = has_abbe && melt->has_abbe;
    }
    perturbed->is_melted[space] = true;
    perturbed->target[at] = space;
    return one->kind == TOLERANCE_INDEX || has_abbe ||
           fail(error, ERROR_DOMAIN, "%s: the medium behind surface %zu has no Abbe number",
                one->name, space);
}

static bool perturbed_add(struct perturbed *perturbed, size_t at, struct error *error)
{
    const struct perturbation *one = &perturbed->list[at];
    perturbed->target[at] = LENS_NONE;
    if (is_motion(one)) {
        for (size_t i = one->first + 1; i <= one->last; i++) {
            if (perturbed->lens->surfaces[i].coordinate_break != NULL) {
                return fail(error, ERROR_DOMAIN,
                            "%s: the axis bends within the element, before surface %zu", one->name,
                            i + 1);
            }
        }
        /* tilt about x and y of one tolerance are one motion, as are decentres along them */
        for (size_t i = 0; i < at && perturbed->target[at] == LENS_NONE; i++) {
            const struct perturbation *other = &perturbed->list[i];
            if (other->kind == one->kind && other->thing == one->thing &&
                other->first == one->first && other->last == one->last &&
                perturbed_part_of(other) != perturbed_part_of(one)) {
                perturbed->target[at] = perturbed->target[i];
            }
        }
        if (perturbed->target[at] == LENS_NONE) {
            perturbed->target[at] = perturbed->motion_count;
            perturbed->motions[perturbed->motion_count++] = (struct perturbed_motion){
                .first = one->first, .last = one->last, .pivot = one->pivot};
        }
        for (size_t i = one->first; i <= one->last; i++) {
            perturbed->is_posed[i] = true;
            perturbed_number_of(perturbed, thickness_behind(i));
        }
        if (one->first > 0) {
            perturbed_number_of(perturbed, thickness_behind(one->first - 1));
        }
        return true;
    }
    if (perturbed_is_of_medium(one)) {
        return add_medium(perturbed, at, error);
    }
    if (one->kind == TOLERANCE_FOCUS) {
        const struct parameter last = thickness_behind(perturbed->lens->surface_count - 1);
        perturbed->target[at] = perturbed_number_of(perturbed, last);
    } else if (one->kind != TOLERANCE_IRREGULARITY) {
        perturbed->target[at] = perturbed_number_of(perturbed, one->what);
        perturbed_keep(perturbed, one->what);
    }
    return true;
}

bool perturbed_open(const struct perturbed_question *question, struct arena *arena,
                    struct perturbed *perturbed, struct error *error)
{
    const struct lens *lens = question->lens;
    const size_t surfaces = lens->surface_count, count = question->count;
    *perturbed = (struct perturbed){
        .lens = lens, .list = question->list, .count = count, .lenses = question->lenses};
    perturbed->position_count = lens->position_count > 0 ? lens->position_count : 1;
    perturbed->numbers =
        ARENA_ARRAY(arena, count + KINDS_KEPT * surfaces + 1, struct perturbed_number);
    perturbed->motions = ARENA_ARRAY(arena, count + 1, struct perturbed_motion);
    perturbed->target = ARENA_ARRAY(arena, count + 1, size_t);
    perturbed->melts = ARENA_ARRAY(arena, perturbed->position_count * (surfaces + 1), struct melt);
    perturbed->off = arena_array(arena, surfaces + 1, sizeof *perturbed->off);
    perturbed->is_melted = ARENA_ARRAY(arena, surfaces + 1, bool);
    perturbed->is_posed = ARENA_ARRAY(arena, surfaces + 1, bool);
    perturbed->poses = ARENA_ARRAY(arena, surfaces + 1, struct perturbed_pose);
    perturbed->at = ARENA_ARRAY(arena, perturbed->position_count, const struct lens *);
    for (size_t p = 0; p < perturbed->position_count; p++) {
        perturbed->at[p] = lens_at_position(lens, p, arena);
    }
    /* Radii before curvatures, which are added to what those have made. */
    for (int bends = 1; bends >= 0; bends--) {
        for (size_t i = 0; i < perturbed->count; i++) {
            const bool is_radius = perturbed->list[i].what.kind == PARAMETER_RADIUS;
            if (is_radius == (bends == 1) && !perturbed_add(perturbed, i, error)) {
                return false;
            }
        }
    }
    return true;
}

void perturbed_keep(struct perturbed *perturbed, struct parameter what)
{
    perturbed_number_of(perturbed, what);
    if (is_pose(what.kind)) {
        perturbed->is_posed[what.surface] = true;
    }
}

/* -------- poses -------- */

/* Rx(a) Ry(b) Rz(c), row by row, as trace/frames.h has it. */
static void perturbed_turn_of(const double tilt[3], double turn[9])
{
    const double sa = sin(tilt[0]), ca = cos(tilt[0]), sb = sin(tilt[1]), cb = cos(tilt[1]);
    const double sc = tilt[2] != 0 ? sin(tilt[2]) : 0, cc = tilt[2] != 0 ? cos(tilt[2]) : 1;
    const double all[9] = {cb * cc,
                           -cb * sc,
                           sb,
                           ca * sc + sa * sb * cc,
                           ca * cc - sa * sb * sc,
                           -sa * cb,
                           sa * sc - ca * sb * cc,
                           sa * cc + ca * sb * sc,
                           ca * cb};
    memcpy(turn, all, sizeof all);
}

/* Less the axial place that it would have unturned: 1 - cos without loss of digits. */
static void perturbed_move(const struct perturbed_motion *motion, double from_pivot, bool is_round,
                           struct perturbed_pose *pose)
{
    const double tilt[3] = {motion->tilt[0], motion->tilt[1], 0};
    if (tilt[0] == 0 && tilt[1] == 0) {
        pose->decenter[0] += motion->shift[0];
        pose->decenter[1] += motion->shift[1];
        return;
    }
    double R[9], M[9], T[9];
    perturbed_turn_of(tilt, R);
    perturbed_turn_of(pose->tilt, M);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            T[3 * i + j] = R[3 * i] * M[j] + R[3 * i + 1] * M[3 + j] + R[3 * i + 2] * M[6 + j];
        }
    }
    const double x = pose->decenter[0], y = pose->decenter[1], z = from_pivot + pose->z;
    const double half_a = sin(tilt[0] / 2), half_b = sin(tilt[1] / 2);
    const double drop = 2 * (half_a * half_a + half_b * half_b) -
                        4 * half_a * half_a * half_b * half_b; /* 1 - cos a cos b */
    pose->decenter[0] = R[0] * x + R[1] * y + R[2] * z + motion->shift[0];
    pose->decenter[1] = R[3] * x + R[4] * y + R[5] * z + motion->shift[1];
    pose->z += R[6] * x + R[7] * y - drop * z;
    pose->tilt[0] = atan2(-T[5], T[8]);
    pose->tilt[1] = asin(T[2]);
    pose->tilt[2] = is_round ? 0 : atan2(-T[1], T[0]);
}

/* Where the vertices of an element are along the axis, from that of its first. */
static double place_within(const struct lens *lens, size_t first, size_t surface)
{
    double z = 0;
    for (size_t i = first; i < surface; i++) {
        z += surface_advance(&lens->surfaces[i]).hi;
    }
    return z;
}

/* Poses as the errors have them, motions apart. */
static void begin_poses(struct perturbed *perturbed, const struct lens *nominal)
{
    for (size_t i = 0; i < perturbed->lens->surface_count; i++) {
        const struct displacement *base = nominal->surfaces[i].decentre;
        struct perturbed_pose *pose = &perturbed->poses[i];
        *pose = (struct perturbed_pose){.z = 0};
        for (int k = 0; k < 2 && base != NULL; k++) {
            pose->decenter[k] = base->decenter[k].value.hi;
        }
        for (int k = 0; k < 3 && base != NULL; k++) {
            pose->tilt[k] = base->tilt[k].value.hi;
        }
    }
    for (size_t i = 0; i < perturbed->number_count; i++) {
        const struct perturbed_number *number = &perturbed->numbers[i];
        struct perturbed_pose *pose = &perturbed->poses[number->what.surface];
        const enum parameter_kind kind = number->what.kind;
        if (is_pose(kind) && kind >= PARAMETER_TILT_X) {
            pose->tilt[kind - PARAMETER_TILT_X] += number->sum;
        } else if (is_pose(kind)) {
            pose->decenter[kind - PARAMETER_DECENTER_X] += number->sum;
        }
    }
}

static void put_pose(struct perturbed *perturbed, size_t position, size_t i)
{
    const struct perturbed_pose *pose = &perturbed->poses[i];
    struct lens_numbers *lens = &perturbed->lenses[position];
    struct displacement *room = &lens->displacements[2 * i];
    struct surface *surface = &lens->lens.surfaces[i];
    const struct displacement *base = perturbed->at[position]->surfaces[i].decentre;
    struct displacement now = base != NULL ? *base : displacement_none;
    bool is_moved = false;
    for (int k = 0; k < 2; k++) {
        is_moved = is_moved || now.decenter[k].value.hi != pose->decenter[k];
        now.decenter[k].value = now.decenter[k].value.hi == pose->decenter[k]
                                    ? now.decenter[k].value
                                    : pair_of(pose->decenter[k]);
    }
    for (int k = 0; k < 3; k++) {
        is_moved = is_moved || now.tilt[k].value.hi != pose->tilt[k];
        now.tilt[k].value =
            now.tilt[k].value.hi == pose->tilt[k] ? now.tilt[k].value : pair_of(pose->tilt[k]);
    }
    for (int k = 0; k < 5 && is_moved; k++) { /* no digits were typed of these */
        if (k < 2) {
            now.decenter[k].typed = (struct text){NULL, 0};
        } else {
            now.tilt[k - 2].typed = (struct text){NULL, 0};
        }
    }
    *room = now;
    surface->decentre = is_moved || base != NULL ? room : NULL;
}

/* -------- putting -------- */

/* A number as the lens has it, with all of its digits. */
static void restore(const struct surface *from, struct parameter what, struct surface *to)
{
    if (what.kind == PARAMETER_RADIUS || what.kind == PARAMETER_CURVATURE) {
        to->radius = from->radius;
        to->curvature = from->curvature;
        to->is_plane = from->is_plane;
        to->has_curvature = from->has_curvature;
    } else if (what.kind == PARAMETER_THICKNESS) {
        to->thickness = from->thickness;
    } else if (what.kind == PARAMETER_CONIC) {
        to->conic = from->conic;
    } else {
        memcpy(to->coefficient, from->coefficient, sizeof to->coefficient);
        to->coefficients = from->coefficients;
    }
}

/* -------- adding up -------- */

/* Sums of the errors: of numbers, motions and media. */
static void sum_errors(struct perturbed *perturbed, const double *errors)
{
    for (size_t i = 0; i < perturbed->number_count; i++) {
        perturbed->numbers[i].sum = 0;
    }
    for (size_t i = 0; i < perturbed->motion_count; i++) {
        struct perturbed_motion *motion = &perturbed->motions[i];
        motion->shift[0] = motion->shift[1] = motion->tilt[0] = motion->tilt[1] = 0;
    }
    memset(perturbed->off, 0, (perturbed->lens->surface_count + 1) * sizeof *perturbed->off);
    for (size_t i = 0; i < perturbed->count; i++) {
        const struct perturbation *one = &perturbed->list[i];
        const size_t target = perturbed->target[i];
        const double error = one->amount * errors[i];
        if (one->kind == TOLERANCE_ELEMENT_TILT) {
            perturbed->motions[target].tilt[perturbed_part_of(one)] += error;
        } else if (one->kind == TOLERANCE_ELEMENT_DECENTER) {
            perturbed->motions[target].shift[perturbed_part_of(one)] += error;
        } else if (perturbed_is_of_medium(one)) {
            perturbed->off[target][one->kind == TOLERANCE_ABBE ? 1 : 0] += error;
        } else if (target != LENS_NONE) {
            perturbed->numbers[target].sum += error;
        }
    }
}

void perturbed_put(struct perturbed *perturbed, const double *errors)
{
    const size_t count = perturbed->lens->surface_count;
    sum_errors(perturbed, errors);
    for (size_t p = 0; p < perturbed->position_count; p++) {
        struct lens_numbers *numbers = &perturbed->lenses[p];
        struct lens *lens = &numbers->lens;
        const struct surface *base = perturbed->at[p]->surfaces;
        for (size_t i = 0; i < perturbed->number_count; i++) {
            const struct parameter what = perturbed->numbers[i].what;
            if (!is_pose(what.kind)) {
                restore(&base[what.surface], what, &lens->surfaces[what.surface]);
            }
        }
        for (size_t i = 0; i < perturbed->number_count; i++) {
            const struct perturbed_number *number = &perturbed->numbers[i];
            if (number->sum != 0 && !is_pose(number->what.kind)) {
                lens_numbers_set(numbers, number->what,
                                 parameter_get(lens, number->what) + number->sum);
            }
        }
        for (size_t space = 0; space <= count; space++) {
            if (perturbed->is_melted[space]) {
                const double *off = perturbed->off[space];
                struct medium *medium =
                    space == 0 ? &lens->object_medium : &lens->surfaces[space - 1].medium;
                *medium = *melt_set(perturbed_melt(perturbed, p, space), off[0], off[1]);
            }
        }
        begin_poses(perturbed, perturbed->at[p]);
        for (size_t m = 0; m < perturbed->motion_count; m++) {
            const struct perturbed_motion *motion = &perturbed->motions[m];
            for (size_t i = motion->first; i <= motion->last; i++) {
                const double z = place_within(lens, motion->first, i) - motion->pivot;
                perturbed_move(motion, z, surface_is_round(&lens->surfaces[i]),
                               &perturbed->poses[i]);
            }
        }
        for (size_t i = 0; i < count; i++) {
            if (perturbed->is_posed[i]) {
                put_pose(perturbed, p, i);
            }
        }
        /* Vertices that went along the axis, by the thicknesses before and behind them. */
        for (size_t i = 0; i < count; i++) {
            const double behind = i + 1 < count ? perturbed->poses[i + 1].z : 0;
            const double more = behind - perturbed->poses[i].z;
            if (more != 0) {
                const double now = parameter_get(lens, thickness_behind(i));
                lens_numbers_set(numbers, thickness_behind(i), now + more);
            }
        }
    }
}

/* -------- small errors -------- */

size_t perturbed_links(const struct perturbed *perturbed, size_t perturbation,
                       struct perturbed_link *links)
{
    const struct perturbation *one = &perturbed->list[perturbation];
    if (is_motion(one)) {
        const struct lens *lens = &perturbed->lenses[0].lens;
        const bool is_tilt = one->kind == TOLERANCE_ELEMENT_TILT;
        const bool is_y = perturbed_part_of(one) == 1;
        size_t count = 0;
        for (size_t i = one->first; i <= one->last; i++) {
            const double z = place_within(lens, one->first, i) - one->pivot;
            const bool along_y = is_tilt ? !is_y : is_y;
            double shift = 1;
            if (is_tilt) {
                shift = is_y ? z : -z;
            }
            links[count++] = (struct perturbed_link){
                {i, along_y ? PARAMETER_DECENTER_Y : PARAMETER_DECENTER_X, 0}, one->amount * shift};
            if (is_tilt) {
                links[count++] = (struct perturbed_link){
                    {i, is_y ? PARAMETER_TILT_Y : PARAMETER_TILT_X, 0}, one->amount};
            }
        }
        return count;
    }
    if (one->kind == TOLERANCE_IRREGULARITY) {
        return 0;
    }
    const size_t target = perturbed->target[perturbation];
    const struct parameter what =
        perturbed_is_of_medium(one) ? one->what : perturbed->numbers[target].what;
    links[0] = (struct perturbed_link){what, one->amount};
    return 1;
}

/* -------- forms of surfaces -------- */

bool perturbed_forms_of(const struct lens *lens, const struct perturbation *list, size_t count,
                        struct arena *arena, struct perturbed_forms *forms, struct error *error)
{
    static const enum irregularity_form kinds[] = {[PERTURBATION_ROUND] = IRREGULARITY_SPHERICAL,
                                                   [PERTURBATION_X] = IRREGULARITY_COS,
                                                   [PERTURBATION_Y] = IRREGULARITY_SIN};
    *forms = (struct perturbed_forms){ARENA_ARRAY(arena, count + 1, struct irregularity),
                                      ARENA_ARRAY(arena, count + 1, size_t), 0};
    for (size_t i = 0; i < count; i++) {
        const struct perturbation *one = &list[i];
        if (one->kind != TOLERANCE_IRREGULARITY) {
            continue;
        }
        const struct surface *surface = &lens->surfaces[one->first];
        if (!surface->has_diameter) {
            return fail(error, ERROR_DOMAIN,
                        "%s: surface %zu has no diameter for its irregularity to be over",
                        one->name, one->first + 1);
        }
        forms->from[forms->count] = i;
        forms->list[forms->count++] =
            (struct irregularity){.surface = one->first,
                                  .form = kinds[one->axis],
                                  .radius = surface->diameter.value.hi / 2};
    }
    return true;
}
