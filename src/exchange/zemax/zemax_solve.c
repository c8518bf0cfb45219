/* exchange/zemax/zemax_solve.c - solves and pick-ups of a .zmx file. */
/* SPDX-License-Identifier: MIT */
#include "exchange/zemax/zemax.h"

#include "exchange/keep_notes.h"
#include "file/lens_solve.h"

#include <math.h>

void zemax_set_curvature(struct zemax_file *file, struct figure curvature, struct surface *to)
{
    const struct figure none = {.variable = LENS_NONE};
    to->is_plane = true;
    to->has_curvature = false;
    to->radius = to->curvature = none;
    if (curvature.value.hi == 0) {
        return;
    }
    to->is_plane =
        !figure_radius_of(&curvature, file->build.lens->unit, file->job->arena, &to->radius);
    to->has_curvature = to->is_plane;
    to->curvature = to->is_plane ? curvature : none;
}

/* The codes of a curvature's solves, CURV c code a b column; 0 fixed, 1 variable. */
enum {
    MARGINAL_ANGLE = 2,
    CHIEF_ANGLE,
    PICK_UP,
    MARGINAL_NORMAL,
    CHIEF_NORMAL,
    APLANATIC,
    ELEMENT_POWER,
    CONCENTRIC_SURFACE,
    CONCENTRIC_RADIUS,
    F_NUMBER
};

/* A number that was read without a unit, as a length. */
static struct pair length_at(const struct solver_state *solving, const struct zemax_line *line,
                             size_t at)
{
    struct pair value = {0, 0};
    if (at < line->count) {
        struct text typed = line->numbers[at].typed;
        text_pair(typed, solving->unit, &value);
    }
    return value;
}

static struct figure rounded_length(const struct solver_state *solving, struct pair value)
{
    return figure_rounded(value, solving->unit, solving->file->job->arena);
}

static const char through_loss[] = "follows rays through what is lost";
static const char open_aperture[] = "follows a ray whose height follows from the lens";

/* The number that stands in the file is kept, which is said once. */
static void keep_unsolved(struct solver_state *solving, size_t at, const struct zemax_line *line,
                          const char *why)
{
    struct zemax_surface *surface = &solving->file->surfaces[at];
    const struct zemax_line *number = line;
    if (line == surface->curvature) {
        surface->has_free_curvature = true;
    } else {
        number = surface->thickness;
        surface->solve = NULL;
    }
    const char *what = arena_printf(solving->file->job->arena, "a solve that %s", why);
    if (number != NULL && number->count > 0 && why != through_loss) {
        zemax_stands(solving->file, line, what);
    } else {
        zemax_loss(solving->file, line, LOSS_OF_NOTHING, "the file's number is kept", "%s", what);
    }
}

/* The ray at a surface; false where there is none, and the file's number is kept. */
static bool follow_to(struct solver_state *solving, size_t at, const struct zemax_line *line,
                      enum solve_ray ray, struct solve_state *state)
{
    struct arena *arena = solving->file->job->arena;
    struct error why;
    if (!solve_follow(&solving->lens, solving->places[at], ray, arena, state, &why)) {
        keep_unsolved(solving, at, line, arena_printf(arena, "has no answer (%s)", why.message));
        return false;
    }
    return true;
}

/* Is the size of the marginal ray one that only the whole lens gives? */
static bool has_open_beam(const struct solver_state *solving)
{
    const struct zemax_line *line = solving->file->aperture;
    return line != NULL && text_same(line->keyword, "FNUM") && zemax_number(line, 1) != 0 &&
           !solving->lens.object_is_infinite;
}

/* MAZH height zone, CHZH height: the paraxial ray has the height at the next surface. */
static void ray_height(struct solver_state *solving, size_t at, const struct zemax_line *line,
                       struct figure *figure)
{
    struct solve_state state;
    bool chief = text_same(line->keyword, "CHZH");
    const char *why = NULL;
    if (!chief && zemax_number(line, 1) != 0) {
        why = "follows a real ray";
    } else if (solving->file->job->lost_power != NULL) {
        why = through_loss;
    } else if (!chief && zemax_number(line, 0) != 0 && has_open_beam(solving)) {
        why = open_aperture;
    }
    if (why != NULL) {
        keep_unsolved(solving, at, line, why);
        return;
    }
    if (!follow_to(solving, at, line, chief ? SOLVE_CHIEF : SOLVE_MARGINAL, &state)) {
        return;
    }
    struct pair value = solve_thickness(&state, length_at(solving, line, 0));
    if (fabs(value.hi) < 1e12) {
        *figure = rounded_length(solving, value);
    } else {
        keep_unsolved(solving, at, line, "has its answer at infinity");
    }
}

/* PZUP surface scale offset */
static void pick_up(struct solver_state *solving, size_t at, const struct zemax_line *line,
                    struct figure *figure)
{
    double from = zemax_number(line, 0);
    if (line->count < 2 || !(from >= 0 && from < (double)at)) {
        keep_unsolved(solving, at, line, "follows no earlier surface");
        return;
    }
    if (zemax_number(line, 3) != 0) {
        keep_unsolved(solving, at, line, "follows another column");
        return;
    }
    struct pair value =
        pair_multiply(solving->thickness[(size_t)from].value, line->numbers[1].value);
    *figure = figure_computed(pair_add(value, length_at(solving, line, 2)), solving->unit,
                              solving->file->job->arena);
}

/* TCOM i sum: t_i and this one; TOLE i sum: all from t_i to this one. */
static void compensate(struct solver_state *solving, size_t at, const struct zemax_line *line,
                       struct figure *figure)
{
    double from = zemax_number(line, 0);
    bool all = text_same(line->keyword, "TOLE");
    if (line->count < 2 || !(from >= 1 && from < (double)at)) {
        keep_unsolved(solving, at, line, "follows no earlier surface");
        return;
    }
    struct pair value = length_at(solving, line, 1);
    for (size_t i = (size_t)from; i < (all ? at : (size_t)from + 1); i++) {
        value = pair_subtract(value, solving->thickness[i].value);
    }
    *figure = figure_computed(value, solving->unit, solving->file->job->arena);
}

/* EDGE thickness height: 0 is the height of the surface's own clear aperture */
static void edge_thickness(struct solver_state *solving, size_t at, const struct zemax_line *line,
                           struct figure *figure)
{
    const struct surface *surface = &solving->lens.surfaces[solving->places[at]];
    double height = length_at(solving, line, 1).hi;
    if (height == 0 && surface->has_diameter) {
        height = surface->diameter.value.hi / 2;
    }
    size_t next = zemax_gap_place(solving->file, solving->places, at) + 1;
    bool last = next >= solving->lens.surface_count;
    double sags = surface_sag(surface, height) -
                  (last ? 0 : surface_sag(&solving->lens.surfaces[next], height));
    if (height > 0 && isfinite(sags)) {
        *figure = rounded_length(solving, pair_add(length_at(solving, line, 0), pair_of(sags)));
    } else {
        keep_unsolved(solving, at, line, "has no clear aperture");
    }
}

static const struct {
    const char *word;
    void (*solve)(struct solver_state *solving, size_t at, const struct zemax_line *line,
                  struct figure *figure);
} solves[] = {{"MAZH", ray_height}, {"CHZH", ray_height}, {"PZUP", pick_up},
              {"TCOM", compensate}, {"TOLE", compensate}, {"EDGE", edge_thickness}};

bool zemax_focuses(const struct zemax_file *file)
{
    const struct zemax_surface *last = &file->surfaces[file->surface_count - 2];
    const struct zemax_line *solve = last->solve;
    bool is_stored =
        file->job->lost_power != NULL && last->thickness != NULL && last->thickness->count > 0;
    return !is_stored && !zemax_is_tilted(file, file->surface_count - 1) && solve != NULL &&
           text_same(solve->keyword, "MAZH") && zemax_number(solve, 0) == 0 &&
           zemax_number(solve, 1) == 0;
}

/* A curvature that follows from an earlier surface; false: there is none such. */
static bool curvature_of_surface(const struct solver_state *solving, size_t at, int code,
                                 struct pair *value)
{
    const struct zemax_line *line = solving->file->surfaces[at].curvature;
    double from = zemax_number(line, 2);
    if (!(from >= 1 && from < (double)at) || solving->places[(size_t)from] == LENS_NONE ||
        zemax_number(line, 4) != 0) {
        return false;
    }
    const struct surface *source = &solving->lens.surfaces[solving->places[(size_t)from]];
    struct pair curvature = surface_curvature(source, SECTION_Y), radius = {0, 0};
    if (code == PICK_UP) {
        *value = pair_multiply(curvature, line->numbers[3].value);
        return line->count > 3;
    }
    if (code == CONCENTRIC_RADIUS && curvature.hi == 0) {
        return false;
    }
    if (code == CONCENTRIC_RADIUS) {
        radius = pair_divide(pair_of(1), curvature);
    }
    /* The distance from an earlier surface's vertex to that of this one. */
    struct pair apart = {0, 0};
    for (size_t i = (size_t)from; i < at; i++) {
        apart = pair_add(apart, solving->thickness[i].value);
    }
    *value = pair_divide(pair_of(1), pair_subtract(radius, apart));
    return true;
}

/*
 * A curvature from the paraxial ray that meets the surface.
 *
 * Formula   angle: u' as given; f-number: u' = -1/(2 N), of light that goes to the left +1/(2 N);
 *           normal: c = -u/y; aplanatic: the ray aims at s = R (n + n')/n, so
 *           c = -(n + n') u/(n y)
 * Source    [OpticStudio25], curvature solves; the aplanatic points of a sphere
 */
static struct pair curvature_of_ray(const struct solver_state *solving, size_t at, int code,
                                    const struct solve_state *state)
{
    const struct zemax_line *line = solving->file->surfaces[at].curvature;
    struct pair target = line->count > 2 ? line->numbers[2].value : pair_of(0);
    struct pair normal =
        pair_negate(pair_divide(pair_divide(state->before, state->index_before), state->y));
    switch (code) {
    case F_NUMBER:
        target = pair_divide(pair_of(state->index_after.hi < 0 ? 0.5 : -0.5), target);
        return solve_curvature(state, target);
    case MARGINAL_NORMAL:
    case CHIEF_NORMAL:
        return normal;
    case APLANATIC:
        return pair_multiply(normal, pair_divide(pair_add(state->index_before, state->index_after),
                                                 state->index_before));
    default:
        return solve_curvature(state, target);
    }
}

static bool is_of_ray(int code)
{
    return code == MARGINAL_ANGLE || code == CHIEF_ANGLE || code == F_NUMBER ||
           (code >= MARGINAL_NORMAL && code <= APLANATIC);
}

/* What the solve gives; false where the file's number is kept. */
static bool solved_curvature(struct solver_state *solving, size_t at, int code, struct pair *value)
{
    const struct zemax_line *line = solving->file->surfaces[at].curvature;
    const bool chief = code == CHIEF_ANGLE || code == CHIEF_NORMAL;
    const bool is_sized = code == MARGINAL_ANGLE || code == F_NUMBER;
    struct solve_state state;
    const char *why = NULL;
    if (is_of_ray(code) && solving->file->job->lost_power != NULL) {
        why = through_loss;
    } else if (is_sized && has_open_beam(solving)) {
        why = open_aperture;
    } else if (is_of_ray(code)) {
        if (!follow_to(solving, at, line, chief ? SOLVE_CHIEF : SOLVE_MARGINAL, &state)) {
            return false;
        }
        *value = curvature_of_ray(solving, at, code, &state);
    } else if (code > F_NUMBER || code == ELEMENT_POWER) {
        why = "lenscalc does not know";
    } else if (!curvature_of_surface(solving, at, code, value)) {
        why = "follows no earlier surface";
    }
    if (why == NULL && !(fabs(value->hi) < 1e12)) {
        why = "has no answer";
    }
    if (why != NULL) {
        keep_unsolved(solving, at, line, why);
    }
    return why == NULL;
}

/* Which solve a curvature has; those beyond the last are all unknown. */
static int curve_code(const struct zemax_line *line)
{
    return (int)fmax(0, fmin(zemax_number(line, 1), F_NUMBER + 1));
}

/* The curvature of a surface by its solve; the file's digits where they are the same number. */
static void solve_curve(struct solver_state *solving, size_t at)
{
    struct zemax_surface *from = &solving->file->surfaces[at];
    const struct zemax_line *line = from->curvature;
    int code = line != NULL && !from->has_free_curvature ? curve_code(line) : 0;
    struct pair value = {0, 0};
    if (code < MARGINAL_ANGLE || solving->places[at] == LENS_NONE ||
        !surface_has(&solving->lens.surfaces[solving->places[at]], SURFACE_HAS_CURVE) ||
        !solved_curvature(solving, at, code, &value)) {
        return;
    }
    struct figure figure = figure_per_length(line->numbers[0], solving->file->build.lens->unit, -1);
    if (!(fabs(pair_subtract(value, figure.value).hi) <= 4e-15 * fabs(value.hi))) {
        /* Digits of 1/mm in the file's unit: of what a ray decides those of a double. */
        const char *unit = solving->file->build.lens->unit;
        const struct figure one = {.typed = text_of("1"), .variable = LENS_NONE};
        struct arena *arena = solving->file->job->arena;
        struct pair plain = pair_multiply(value, figure_per_length(one, unit, 1).value);
        figure = is_of_ray(code) ? figure_of(plain.hi, arena)
                                 : figure_computed(plain, NUMBER_UNSCALED, arena);
        figure = figure_per_length(figure, unit, -1);
    }
    solving->curvature[at] = figure;
    zemax_set_curvature(solving->file, figure, &solving->lens.surfaces[solving->places[at]]);
}

void zemax_solve_surface(struct solver_state *solving, size_t at)
{
    solve_curve(solving, at);
    /* The last solve only says where the image is: the file's number stays beside it. */
    const struct zemax_file *file = solving->file;
    bool focus = at + 2 == file->surface_count && zemax_focuses(file);
    const struct zemax_line *line = focus ? NULL : file->surfaces[at].solve;
    struct figure *figure = &solving->thickness[at];
    for (size_t i = 0; line != NULL && i < sizeof solves / sizeof solves[0]; i++) {
        if (text_same(line->keyword, solves[i].word)) {
            solves[i].solve(solving, at, line, figure);
        }
    }
    if (solving->places[at] != LENS_NONE) {
        solving->lens.surfaces[zemax_gap_place(solving->file, solving->places, at)].thickness =
            *figure;
    }
}

bool zemax_solve_in(const struct solver_state *solving, size_t at, bool is_curvature,
                    const struct lens *lens, struct arena *arena, struct pair *value)
{
    const struct zemax_surface *from = &solving->file->surfaces[at];
    const int code = is_curvature ? curve_code(from->curvature) : 0;
    bool chief = is_curvature ? code == CHIEF_ANGLE || code == CHIEF_NORMAL
                              : text_same(from->solve->keyword, "CHZH");
    bool of_ray = is_curvature ? is_of_ray(code) : chief || text_same(from->solve->keyword, "MAZH");
    struct solve_state state;
    struct error unknown;
    size_t place =
        is_curvature ? solving->places[at] : zemax_gap_place(solving->file, solving->places, at);
    if (!of_ray ||
        !solve_follow(lens, place, chief ? SOLVE_CHIEF : SOLVE_MARGINAL, arena, &state, &unknown)) {
        return false;
    }
    *value = is_curvature ? curvature_of_ray(solving, at, code, &state)
                          : solve_thickness(&state, length_at(solving, from->solve, 0));
    return isfinite(value->hi);
}

/* PZUP surface scale offset */
static void keep_gap(const struct solver_state *solving, size_t at)
{
    const struct zemax_file *file = solving->file;
    const struct zemax_line *line = file->surfaces[at].solve;
    const size_t *places = solving->places;
    double from = zemax_number(line, 0);
    if (line != NULL && text_same(line->keyword, "PZUP") && line->count >= 2 &&
        zemax_number(line, 3) == 0 && from >= 1 && from < (double)at && places[at] != LENS_NONE &&
        places[(size_t)from] != LENS_NONE) {
        size_t what = zemax_gap_place(file, places, at);
        size_t source = zemax_gap_place(file, places, (size_t)from);
        keep_pickup(file->build.lens, (struct parameter){what, PARAMETER_THICKNESS, 0},
                    (struct parameter){source, PARAMETER_THICKNESS, 0}, line->numbers[1].value,
                    length_at(solving, line, 2), file->job->arena);
    }
}

void zemax_keep_pickups(const struct solver_state *solving)
{
    const struct zemax_file *file = solving->file;
    for (size_t i = 1; i + 1 < file->surface_count && file->configurations < 2; i++) {
        /* CURV c 4 surface scale */
        const struct zemax_line *line = solving->file->surfaces[i].curvature;
        double from = zemax_number(line, 2);
        if (line != NULL && line->count > 3 && zemax_number(line, 1) == PICK_UP &&
            solving->curvature[i].typed.start != NULL && from >= 1 && from < (double)i) {
            keep_pickup(solving->file->build.lens,
                        (struct parameter){solving->places[i], PARAMETER_CURVATURE, 0},
                        (struct parameter){solving->places[(size_t)from], PARAMETER_CURVATURE, 0},
                        line->numbers[3].value, pair_of(0), solving->file->job->arena);
        }
        keep_gap(solving, i);
    }
}
