/* trace/derivative.c - one sweep forward that is kept, and sweeps back. */
/* SPDX-License-Identifier: MIT */
#include "trace/derivative.h"

#include "trace/adjoint.h"
#include "trace/frames.h"
#include "trace/rigid.h"

#include <assert.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

/* Rows that nobody asked for: those of one step. */
enum {
    SCRATCH_CURVATURE,
    SCRATCH_BEFORE,
    SCRATCH_AFTER,
    SCRATCH_THICKNESS,
    SCRATCH_CONIC,
    SCRATCH_EVEN,
    SCRATCH_ODD = SCRATCH_EVEN + STEP_TERMS,
    SCRATCH_BLOCKS = 4 /* of eight rows */
};

struct derivative_tape derivative_tape_new(const struct system *system, struct arena *arena)
{
    size_t steps = system->begin[system->places];
    const size_t count = steps + 1 + SCRATCH_BLOCKS;
    /* from a whole line of the cache on: one block more than is used */
    char *memory = arena_buffer_array(arena, count + 1, sizeof(struct ray_block));
    struct ray_block *blocks =
        (struct ray_block *)(void *)(memory + (64 - (uintptr_t)memory % 64) % 64);
    return (struct derivative_tape){
        .blocks = blocks,
        .scratch = blocks[steps + 1].x,
        .lanes = RAYS_BLOCK,
    };
}

static const struct step *step_of_surface(const struct system *system, size_t place)
{
    const struct step *step = &system->steps[system->begin[place]];
    while (step->kind == STEP_MOVE) {
        step++;
    }
    return step;
}

/* Where the rows of a surface stand; those of orders and of displacements follow one another. */
enum {
    SLOT_NONE, /* not derived by: always LENS_NONE */
    SLOT_CURVATURE,
    SLOT_THICKNESS,
    SLOT_INDEX,
    SLOT_CONIC,
    SLOT_A2,
    SLOT_DECENTER_X = SLOT_A2 + LENS_COEFFICIENTS,
    SLOTS = SLOT_DECENTER_X + PARAMETER_KINDS - PARAMETER_DECENTER_X
};

static size_t parameter_slot(enum parameter_kind kind, int order)
{
    static const unsigned char slots[PARAMETER_DECENTER_X] = {
        [PARAMETER_CURVATURE] = SLOT_CURVATURE, [PARAMETER_THICKNESS] = SLOT_THICKNESS,
        [PARAMETER_INDEX] = SLOT_INDEX,         [PARAMETER_CONIC] = SLOT_CONIC,
        [PARAMETER_COEFFICIENT] = SLOT_A2,
    };
    if (kind >= PARAMETER_DECENTER_X) {
        return SLOT_DECENTER_X + (size_t)(kind - PARAMETER_DECENTER_X);
    }
    return slots[kind] + (order > 0 ? (size_t)surface_term(order) : 0);
}

/* Rows of one surface; `surface` may be one before the first: object space. */
struct row_numbering {
    size_t *row, next;
};

static size_t *row_index_at(const struct row_numbering *numbering, size_t surface,
                            enum parameter_kind kind)
{
    return &numbering->row[(surface + 1) * SLOTS + parameter_slot(kind, 0)];
}

/* Decentre and tilt; of a surface by itself there is one more row, which no parameter asks for. */
enum { DISPLACEMENTS = 5 };

/* Number `count` kinds, or orders of one, that follow one another. */
static void row_numbering_add(struct row_numbering *numbering, size_t surface,
                              enum parameter_kind kind, int count)
{
    size_t *row = row_index_at(numbering, surface, kind);
    for (int i = 0; i < count; i++) {
        row[i] = numbering->next++;
    }
}

static void number_displacement(struct row_numbering *numbering, size_t surface)
{
    row_numbering_add(numbering, surface, PARAMETER_DECENTER_X, DISPLACEMENTS);
    numbering->next++;
}

/* Numbers for one surface; a mirror has the medium before it. */
static void number_index(struct row_numbering *numbering, const struct lens *lens, size_t surface)
{
    if (surface != LENS_NONE && surface_reflects(&lens->surfaces[surface])) {
        *row_index_at(numbering, surface, PARAMETER_INDEX) =
            *row_index_at(numbering, surface - 1, PARAMETER_INDEX);
    } else {
        row_numbering_add(numbering, surface, PARAMETER_INDEX, 1);
    }
}

static struct row_numbering numbering_new(size_t surfaces, struct arena *arena)
{
    size_t entries = (surfaces + 1) * SLOTS;
    struct row_numbering numbering = {ARENA_ARRAY(arena, entries, size_t), 0};
    for (size_t i = 0; i < entries; i++) {
        numbering.row[i] = LENS_NONE;
    }
    return numbering;
}

void derivative_layout(const struct system *system, unsigned what, struct arena *arena,
                       struct derivative_layout *layout)
{
    size_t count = system->lens->surface_count;
    struct row_numbering numbering = numbering_new(count, arena);
    row_numbering_add(&numbering, LENS_NONE, PARAMETER_INDEX, 1);
    for (size_t i = 0; i < count; i++) {
        const struct step *step = step_of_surface(system, system_place(system, i));
        row_numbering_add(&numbering, i, PARAMETER_CURVATURE, 2);
        number_index(&numbering, system->lens, i);
        bool odd = step->kind == STEP_ODD || (what & DERIVE_ODD) != 0;
        bool series = odd || step->kind >= STEP_ASPHERE || (what & DERIVE_SERIES) != 0;
        if (series || step->kind >= STEP_CONIC || (what & DERIVE_CONIC) != 0) {
            row_numbering_add(&numbering, i, PARAMETER_CONIC, 1);
        }
        if (series) { /* even powers lie before odd ones */
            row_numbering_add(&numbering, i, PARAMETER_COEFFICIENT,
                              odd ? LENS_COEFFICIENTS : LENS_EVEN);
        }
        if ((what & DERIVE_DISPLACEMENT) != 0) {
            number_displacement(&numbering, i);
        }
        if ((what & DERIVE_BREAK) != 0) {
            row_numbering_add(&numbering, i, PARAMETER_BREAK_DECENTER_X, DISPLACEMENTS);
        }
    }
    *layout = (struct derivative_layout){what, numbering.next, count, numbering.row};
}

static unsigned what_of(struct parameter parameter)
{
    if (parameter.kind >= PARAMETER_BREAK_DECENTER_X) {
        return DERIVE_BREAK;
    }
    if (parameter.kind >= PARAMETER_DECENTER_X) {
        return DERIVE_DISPLACEMENT;
    }
    return 0;
}

static bool has_odd(const struct parameter *parameters, size_t count, size_t surface)
{
    bool odd = false;
    for (size_t i = 0; i < count; i++) {
        odd = odd || (parameters[i].surface == surface && parameters[i].order % 2 == 1);
    }
    return odd;
}

void derivative_layout_of(const struct system *system, const struct parameter *parameters,
                          size_t count, struct arena *arena, struct derivative_layout *layout)
{
    const struct lens *lens = system->lens;
    struct row_numbering numbering = numbering_new(lens->surface_count, arena);
    unsigned what = 0;
    for (size_t i = 0; i < count; i++) {
        /* the surface that an index is of: before mirrors */
        const struct parameter parameter = parameters[i];
        size_t surface = parameter.surface;
        while (parameter.kind == PARAMETER_INDEX && surface != LENS_NONE &&
               surface_reflects(&lens->surfaces[surface])) {
            surface--; /* before the first: LENS_NONE */
        }
        assert(parameter_type(parameters[i].kind)->basis == parameters[i].kind);
        if (*row_index_at(&numbering, surface, parameters[i].kind) == LENS_NONE) {
            /* rows of a kind that some parameter asks for: of all that stand side by side */
            const enum parameter_kind kind = parameters[i].kind;
            const bool odd = has_odd(parameters, count, surface);
            if (kind == PARAMETER_COEFFICIENT) {
                row_numbering_add(&numbering, surface, kind, odd ? LENS_COEFFICIENTS : LENS_EVEN);
            } else if (kind >= PARAMETER_BREAK_DECENTER_X) {
                row_numbering_add(&numbering, surface, PARAMETER_BREAK_DECENTER_X, DISPLACEMENTS);
            } else if (kind >= PARAMETER_DECENTER_X) {
                number_displacement(&numbering, surface);
            } else {
                row_numbering_add(&numbering, surface, kind, 1);
            }
        }
        what |= what_of(parameters[i]);
    }
    for (size_t i = 0; i < lens->surface_count; i++) {
        if (surface_reflects(&lens->surfaces[i])) {
            number_index(&numbering, lens, i);
        }
    }
    *layout = (struct derivative_layout){what, numbering.next, lens->surface_count, numbering.row};
}

static size_t parameter_row(const struct derivative_layout *layout, enum parameter_kind kind,
                            int order, size_t surface)
{
    return layout->row[(surface + 1) * SLOTS + parameter_slot(kind, order)];
}

size_t derivative_row(const struct derivative_layout *layout, struct parameter parameter)
{
    return parameter_row(layout, parameter.kind, parameter.order, parameter.surface);
}

const struct ray_block *derivative_trace(const struct system *system, const struct ray_block *start,
                                         enum instruction_set set,
                                         const struct derivative_tape *tape)
{
    size_t steps = system->begin[system->places];
    tape->blocks[0] = *start;
    KERNEL_FOR(set, kernel_tape)
    (system->steps, steps, system->options.path, tape->lanes, tape->blocks);
    return &tape->blocks[steps];
}

/* One sweep back. */
struct adjoint_sweep {
    const struct system *system;
    const struct derivative_layout *layout;
    const struct derivative_tape *tape;
    struct ray_block *adjoint;
    double *gradient;
    const struct derivative_pass *pass;
    kernel_adjoint *kernel;
};

static double *row_or(const struct adjoint_sweep *sweep, enum parameter_kind kind, size_t surface,
                      double *otherwise)
{
    size_t row = parameter_row(sweep->layout, kind, 0, surface);
    return row == LENS_NONE ? otherwise : sweep->gradient + row * RAYS_BLOCK;
}

/* The thickness that is passed on the way to a place belongs to the surface left of the gap. */
static double *thickness_row(const struct adjoint_sweep *sweep, size_t place)
{
    const struct system *system = sweep->system;
    size_t count = system->lens->surface_count;
    bool reverse = system->options.reverse;
    double *scratch = sweep->tape->scratch + SCRATCH_THICKNESS * RAYS_BLOCK;
    if (place == 0 || (place == count && reverse)) {
        return scratch;
    }
    size_t left = reverse ? count - 1 - place : place - 1;
    return row_or(sweep, PARAMETER_THICKNESS, left, scratch);
}

/* Whether they are asked for or not, a kernel fills all rows of the shape that a surface has. */
static void set_shape_rows(const struct adjoint_sweep *sweep, enum step_kind kind, size_t surface,
                           struct adjoint_rows *rows)
{
    double *scratch = sweep->tape->scratch;
    const size_t odd = parameter_row(sweep->layout, PARAMETER_COEFFICIENT, 1, surface);
    if (odd != LENS_NONE) {
        rows->odd = sweep->gradient + odd * RAYS_BLOCK;
    } else if (kind == STEP_ODD) {
        rows->odd = scratch + SCRATCH_ODD * RAYS_BLOCK;
    } else {
        rows->odd = NULL;
    }
    const bool is_series = rows->odd != NULL || kind >= STEP_ASPHERE;
    rows->coefficient = row_or(sweep, PARAMETER_COEFFICIENT, surface,
                               is_series ? scratch + SCRATCH_EVEN * RAYS_BLOCK : NULL);
    const bool is_conic = rows->coefficient != NULL || kind >= STEP_CONIC;
    rows->conic = row_or(sweep, PARAMETER_CONIC, surface,
                         is_conic ? scratch + SCRATCH_CONIC * RAYS_BLOCK : NULL);
}

static struct adjoint_rows place_rows(const struct adjoint_sweep *sweep, size_t place)
{
    const struct system *system = sweep->system;
    size_t count = system->lens->surface_count, surface = system_surface(system, place);
    bool reverse = system->options.reverse;
    double *scratch = sweep->tape->scratch, *before = scratch + SCRATCH_BEFORE * RAYS_BLOCK;
    struct adjoint_rows rows = {.thickness_sign = reverse ? 1 : -1, .lanes = sweep->tape->lanes};
    if (surface == count) {
        size_t medium = reverse ? LENS_NONE : count - 1;
        rows.curvature = scratch; /* the first of them */
        rows.index_before = row_or(sweep, PARAMETER_INDEX, medium, before);
        rows.index_after = scratch + SCRATCH_AFTER * RAYS_BLOCK;
        return rows;
    }
    rows.curvature = row_or(sweep, PARAMETER_CURVATURE, surface, scratch);
    set_shape_rows(sweep, step_of_surface(system, place)->kind, surface, &rows);
    rows.index_before = row_or(sweep, PARAMETER_INDEX, reverse ? surface : surface - 1, before);
    rows.index_after = row_or(sweep, PARAMETER_INDEX, reverse ? surface - 1 : surface, before);
    if (reverse && place > 0) { /* the way lies along the axis before a coordinate break */
        rows.along_behind = system->lens->surfaces[surface + 1].coordinate_break != NULL;
    }
    if (rows.index_after == rows.index_before) {
        /* a mirror, to which the kernel adds nothing; or asked for neither */
        rows.index_after = scratch + SCRATCH_AFTER * RAYS_BLOCK;
    }
    return rows;
}

void displacement_axes(const struct displacement *decentre, double axes[9])
{
    static const double straight[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    memcpy(axes, straight, sizeof straight);
    if (decentre != NULL) {
        const struct surface_frame frame = frame_of(decentre, 0);
        const double ax = decentre->tilt[0].value.hi;
        axes[4] = cos(ax);
        axes[5] = sin(ax);
        memcpy(axes + 6, frame.turn + 6, 3 * sizeof(double));
    }
}

/* Row by row m v of the rows v of a matrix. */
static void turn_rows(const double m[9], const double rows[9], double turned[9])
{
    for (int k = 0; k < 9; k++) {
        const double *v = rows + k / 3 * 3, *row = m + k % 3 * 3;
        turned[k] = row[0] * v[0] + row[1] * v[1] + row[2] * v[2];
    }
}

/* How a surface moves by itself, in its own axes; false: that is not asked for. */
static bool motion_of(const struct adjoint_sweep *sweep, size_t place, size_t itself,
                      struct adjoint_motion *motion)
{
    static const double straight[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    const struct system *system = sweep->system;
    const size_t surface = system_surface(system, place);
    if (surface >= system->lens->surface_count) {
        return false;
    }
    const size_t row = parameter_row(sweep->layout, PARAMETER_DECENTER_X, 0, surface);
    if (row == LENS_NONE) {
        return false;
    }
    const struct displacement *decentre = system->lens->surfaces[surface].decentre;
    const double *into = decentre != NULL ? system->steps[itself - 1].turn : straight;
    double axes[9];
    displacement_axes(decentre, axes);
    turn_rows(into, straight, motion->shift);
    turn_rows(into, axes, motion->turn);
    motion->rows = sweep->gradient + row * RAYS_BLOCK;
    return true;
}

/* What depends on the place on the surface goes back as that moves. */
static void motion_take_place(const struct adjoint_motion *motion, const struct ray_block *rays,
                              const struct derivative_pass *pass)
{
    for (int i = 0; i < pass->tape->lanes; i++) {
        const double ax = pass->add_x[i], ay = pass->add_y[i];
        const double turn[3] = {-rays->z[i] * ay, rays->z[i] * ax,
                                rays->x[i] * ay - rays->y[i] * ax};
        for (int k = 0; k < 3; k++) {
            const double *e = motion->shift + 3 * k, *axis = motion->turn + 3 * k;
            double *rows = motion->rows + i;
            rows[(k < 2 ? k : DERIVE_SHIFT_Z) * RAYS_BLOCK] -= e[0] * ax + e[1] * ay;
            rows[(2 + k) * RAYS_BLOCK] -= axis[0] * turn[0] + axis[1] * turn[1] + axis[2] * turn[2];
        }
    }
}

/* sign (shift . a + axis . (X x a + p x b)) of every lane. */
static void put_rigid(const struct rigid *motion, const struct ray_block *restrict rays,
                      const struct ray_block *restrict adjoint, double *restrict row)
{
    const double sign = motion->sign, *e = motion->shift, *axis = motion->axis, *at = motion->at;
    for (int i = 0; i < RAYS_BLOCK; i++) {
        double x = rays->x[i] - at[0], y = rays->y[i] - at[1], z = rays->z[i] - at[2];
        double p = rays->p[i], q = rays->q[i], r = rays->r[i];
        double ax = adjoint->x[i], ay = adjoint->y[i], az = adjoint->z[i];
        double bx = adjoint->p[i], by = adjoint->q[i], bz = adjoint->r[i];
        double turn_x = (y * az - z * ay) + (q * bz - r * by);
        double turn_y = (z * ax - x * az) + (r * bx - p * bz);
        double turn_z = (x * ay - y * ax) + (p * by - q * bx);
        row[i] = sign * ((e[0] * ax + e[1] * ay + e[2] * az) +
                         (axis[0] * turn_x + axis[1] * turn_y + axis[2] * turn_z));
    }
}

/* Coordinate breaks act in front of one step: of this place, or the next if light goes back. */
static void sweep_add_breaks(const struct adjoint_sweep *sweep, size_t place)
{
    const struct system *system = sweep->system;
    size_t acting = system->options.reverse ? place - 1 : place, begin = system->begin[place];
    if (acting >= system->lens->surface_count) {
        return;
    }
    size_t surface = system_surface(system, acting);
    for (int i = 0; i < DISPLACEMENTS; i++) {
        enum parameter_kind kind = (enum parameter_kind)(PARAMETER_BREAK_DECENTER_X + i);
        size_t row = parameter_row(sweep->layout, kind, 0, surface);
        struct rigid motion;
        if (row != LENS_NONE && rigid_before(system, kind, surface, begin, &motion)) {
            put_rigid(&motion, &sweep->tape->blocks[begin], sweep->adjoint,
                      sweep->gradient + row * RAYS_BLOCK);
        }
    }
}

static void adjoint_row_add(double *restrict to, const double *restrict row, int lanes)
{
    for (int i = 0; i < lanes; i++) {
        to[i] += row[i];
    }
}

/* Directions before or behind a surface gain what is to be added there. */
static void add_seeds(const struct adjoint_sweep *sweep, size_t place, bool is_behind)
{
    struct ray_block *adjoint = sweep->adjoint;
    double *const directions[] = {adjoint->p, adjoint->q, adjoint->r};
    for (size_t k = 0; k < sweep->pass->seeds.count; k++) {
        const struct derivative_seed *seed = &sweep->pass->seeds.list[k];
        for (int i = 0; i < 3 && seed->place == place; i++) {
            adjoint_row_add(directions[i], is_behind ? seed->behind[i] : seed->before[i],
                            sweep->tape->lanes);
        }
    }
}

static void add_behind(const struct adjoint_sweep *sweep, size_t place)
{
    if (sweep->pass->add_x != NULL && sweep->pass->at == place) {
        /* what stands behind the surface itself gains what is to be added there */
        const double *restrict x = sweep->pass->add_x, *restrict y = sweep->pass->add_y;
        for (int i = 0; i < sweep->tape->lanes; i++) {
            sweep->adjoint->x[i] += x[i];
            sweep->adjoint->y[i] += y[i];
        }
    }
    add_seeds(sweep, place, true);
}

static void sweep_place(const struct adjoint_sweep *sweep, size_t place)
{
    const struct system *system = sweep->system;
    size_t begin = system->begin[place], end = system->begin[place + 1];
    size_t surface = system_surface(system, place), count = system->lens->surface_count;
    bool is_decentred = surface < count && system->lens->surfaces[surface].decentre != NULL;
    size_t itself = end - (is_decentred ? 2 : 1);
    struct adjoint_rows rows = place_rows(sweep, place);
    struct adjoint_motion motion;
    bool moves = motion_of(sweep, place, itself, &motion);
    for (size_t i = end; i-- > begin;) {
        if (i == itself) {
            add_behind(sweep, place);
        }
        rows.motion = i == itself && moves ? &motion : NULL;
        rows.thickness = i == begin ? thickness_row(sweep, place)
                                    : sweep->tape->scratch + SCRATCH_THICKNESS * RAYS_BLOCK;
        sweep->kernel(&system->steps[i], &sweep->tape->blocks[i], &sweep->tape->blocks[i + 1],
                      sweep->adjoint, &rows);
        if (i == itself) {
            add_seeds(sweep, place, false);
        }
        if (i == itself && moves && sweep->pass->add_x != NULL && sweep->pass->at == place) {
            motion_take_place(&motion, &sweep->tape->blocks[i + 1], sweep->pass);
        }
    }
    if ((sweep->layout->what & DERIVE_BREAK) != 0) {
        sweep_add_breaks(sweep, place);
    }
}

void derivative_pass_begin(const struct derivative_pass *pass, size_t from)
{
    const struct ray_block *end = &pass->tape->blocks[pass->system->begin[from]];
    const size_t lanes = (size_t)pass->tape->lanes;
    for (size_t row = 0; row < pass->layout->rows; row++) {
        memset(pass->gradient + row * RAYS_BLOCK, 0, lanes * sizeof(double));
    }
    for (size_t i = 0; i < lanes; i++) {
        pass->adjoint->x[i] += 0 * end->x[i]; /* NaN where a ray is lost, and so all that follows */
    }
}

void derivative_pass_part(const struct derivative_pass *pass, size_t from, size_t to)
{
    const struct adjoint_sweep sweep = {pass->system,
                                        pass->layout,
                                        pass->tape,
                                        pass->adjoint,
                                        pass->gradient,
                                        pass,
                                        KERNEL_FOR(pass->set, kernel_adjoint)};
    for (size_t place = from; place-- > to;) {
        sweep_place(&sweep, place);
    }
}

void derivative_sweep(const struct system *system, const struct derivative_layout *layout,
                      enum instruction_set set, const struct derivative_tape *tape,
                      struct ray_block *adjoint, double *gradient)
{
    const struct derivative_pass pass = {.system = system,
                                         .layout = layout,
                                         .set = set,
                                         .tape = tape,
                                         .adjoint = adjoint,
                                         .gradient = gradient};
    derivative_pass_begin(&pass, system->places);
    derivative_pass_part(&pass, system->places, 0);
}
