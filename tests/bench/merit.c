/* tests/bench/merit.c - spots as operands and their derivatives, against the bare trace of rays. */
/* SPDX-License-Identifier: MIT */
#include "design/merit/merit.h"
#include "base/constants.h"
#include "clock.h"
#include "design/solver/solver_normal.h"
#include "exchange/lens_open.h"
#include "trace/dispatch.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/*
 * Prints one figure a line, "name value": nine spots of the double Gauss of the slides (0, 10 and
 * 14 degrees at d, F and C, 127 rays in rings each, entrance pupil 50 mm), by ten curvatures and
 * the distance of the image: residuals alone, with derivatives and normal equations, and these by
 * bare traces of 9 times 127 rays; and the contrast of the same fields, of all wavelengths together
 * in both directions by 36 rays, with derivatives and normal equations. Times are of the processor,
 * the least of many turns; the lens changes a little in each.
 */
enum { FIELDS = 3, COLOURS = 3, RAYS = 127, TURNS = 2000, VARIABLES = 11 };

struct fixture {
    struct arena arena;
    struct lens lens;
    struct variable list[VARIABLES];
    struct variables variables;
    struct operand operand;
    struct setup_wavelength wavelengths[COLOURS];
    struct setup_field fields[FIELDS];
    struct merit_question question;
    struct merit merit;
    double v[VARIABLES];
    double *residuals, *jacobian;
};

static void stop(const struct error *error)
{
    fprintf(stderr, "merit: %s\n", error->message);
    exit(1);
}

static void list_variables(struct fixture *fixture)
{
    size_t count = 0;
    for (size_t i = 0; i < fixture->lens.surface_count; i++) {
        if (!fixture->lens.surfaces[i].is_plane) {
            fixture->list[count++].what = (struct parameter){i, PARAMETER_RADIUS, 0};
        }
    }
    fixture->list[count++].what =
        (struct parameter){fixture->lens.surface_count - 1, PARAMETER_THICKNESS, 0};
    for (size_t i = 0; i < count; i++) {
        struct variable *one = &fixture->list[i];
        one->position = LENS_NONE;
        one->low = -INFINITY;
        one->high = INFINITY;
        one->name = "";
    }
    if (count != VARIABLES) {
        exit(1);
    }
}

static void set_up(struct fixture *fixture, bool from_entrance, enum operand_kind kind)
{
    const bool is_contrast = kind == OPERAND_MTF;
    static const double degrees[FIELDS] = {0, 10, 14};
    static const double wavelengths[COLOURS] = {0.5875618, 0.4861327, 0.6562725};
    struct arena *arena = &fixture->arena;
    struct lensdb db = {.arena = arena};
    struct error error;
    for (size_t i = 0; i < FIELDS; i++) {
        fixture->fields[i] =
            (struct setup_field){{FIELD_ANGLE, {0, degrees[i] * RADIANS_PER_DEGREE}}, 1};
        fixture->wavelengths[i] = (struct setup_wavelength){wavelengths[i], 1};
    }
    if (!lens_open(&db, text_of("double-gauss"), arena, &fixture->lens, &error)) {
        stop(&error);
    }
    fixture->lens.aperture_kind = APERTURE_EPD;
    fixture->lens.aperture.value = pair_of(50);
    fixture->lens.focus = FOCUS_TABLE;
    list_variables(fixture);
    fixture->operand = (struct operand){
        .kind = kind, .deviation = 1, .wavelength = NAN, .position = LENS_NONE, .frequency = 10};
    fixture->question =
        (struct merit_question){.lens = &fixture->lens,
                                .variables = &fixture->variables,
                                .variable_count = VARIABLES,
                                .operands = &fixture->operand,
                                .operand_count = 1,
                                .wavelengths = fixture->wavelengths,
                                .wavelength_count = COLOURS,
                                .fields = fixture->fields,
                                .field_count = FIELDS,
                                .fnumber = NAN,
                                .from_entrance = from_entrance,
                                .pattern = is_contrast ? PATTERN_GAUSS : PATTERN_HEXAPOLAR,
                                .rays = is_contrast ? 36 : RAYS};
    if (!variables_open(&fixture->lens, fixture->list, VARIABLES, arena, &fixture->variables,
                        &error) ||
        !merit_open(&fixture->question, arena, &fixture->merit, &error)) {
        stop(&error);
    }
    variables_get(&fixture->variables, fixture->v);
    const size_t rows = fixture->merit.residual_count;
    fixture->residuals = ARENA_ARRAY(arena, rows, double);
    fixture->jacobian = ARENA_ARRAY(arena, rows * VARIABLES, double);
}

/* Seconds of an evaluation, of a lens that is another each time. */
static double time_merit(struct fixture *fixture, bool derives)
{
    double best = INFINITY, normal[VARIABLES * VARIABLES], gradient[VARIABLES];
    for (int turn = 0; turn < TURNS; turn++) {
        double v[VARIABLES];
        for (int i = 0; i < VARIABLES; i++) {
            v[i] = fixture->v[i] * (1 + 1e-4 * sin(turn + i));
        }
        const double began = processor_time();
        if (!merit_evaluate(&fixture->merit, v, fixture->residuals,
                            derives ? fixture->jacobian : NULL)) {
            stop(&fixture->merit.why);
        }
        if (derives) {
            static double room[(VARIABLES + 1) * SOLVER_ROWS];
            const struct solver_rows rows = {.rows = fixture->merit.residual_count,
                                             .columns = VARIABLES,
                                             .jacobian = fixture->jacobian,
                                             .residuals = fixture->residuals,
                                             .room = room};
            solver_normal(&rows, normal, gradient);
        }
        best = fmin(best, processor_time() - began);
    }
    return best;
}

/* Seconds of the bare trace of as many rays. */
static double time_trace(struct fixture *fixture)
{
    struct system_options options = system_options_default();
    struct system system;
    struct error error;
    double best = INFINITY;
    options.image = 72.228;
    options.stop_radius = 15;
    if (!system_compile(&fixture->lens, 0.5875618, &options, &fixture->arena, &system, &error)) {
        stop(&error);
    }
    struct rays rays = rays_new(&fixture->arena, (size_t)FIELDS * COLOURS * RAYS_BLOCK);
    struct ray_block start = rays.blocks[0];
    for (int i = 0; i < RAYS_BLOCK; i++) {
        start.y[i] = 25.0 * i / RAYS_BLOCK;
    }
    for (int turn = 0; turn < TURNS; turn++) {
        double spent = 0;
        for (size_t i = 0; i < rays_blocks(&rays); i++) {
            rays.blocks[i] = start;
        }
        rays.count = (size_t)FIELDS * COLOURS * RAYS_BLOCK;
        const double began = processor_time();
        rays_trace(&system, &rays, NULL);
        spent = processor_time() - began;
        best = fmin(best, spent * RAYS / RAYS_BLOCK);
    }
    return best;
}

int main(void)
{
    static struct fixture entrance, stopped, contrast;
    set_up(&entrance, true, OPERAND_SPOT);
    set_up(&stopped, false, OPERAND_SPOT);
    set_up(&contrast, false, OPERAND_MTF);
    const double trace = time_trace(&entrance);
    const double whole = time_merit(&entrance, true), aimed = time_merit(&stopped, true);
    printf("merit %.1f\n", 1e6 * time_merit(&entrance, false));
    printf("normal %.1f\n", 1e6 * whole);
    printf("normal/trace %.2f\n", whole / trace);
    printf("aimed %.1f\n", 1e6 * aimed);
    printf("aimed/trace %.2f\n", aimed / trace);
    printf("contrast %.1f\n", 1e6 * time_merit(&contrast, true));
    arena_free(&contrast.arena);
    arena_free(&entrance.arena);
    arena_free(&stopped.arena);
    return 0;
}
