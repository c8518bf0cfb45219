/* analysis/setup/setup_beam.c - the rays of a field; chief rays aimed at the height of a real image. */
/* SPDX-License-Identifier: MIT */
#include "analysis/setup/setup.h"

#include "base/constants.h"
#include "trace/dispatch.h"

#include <math.h>

/* Chief rays that are there cost a hundredth of it; of one height more is no use to anybody. */
static const size_t most_sought = 30000000;

/* A search for the object point whose chief ray meets the image plane at a height. */
struct setup_beam_search {
    const struct setup *setup;         /* at the primary wavelength, with its image */
    const struct system *open, *image; /* without rims; and with the image plane */
    double goal[2];                    /* x, y in the image plane, mm */
    double size;                       /* of what is looked for there, mm */
    int first;                         /* axis: 1 = in the y-z plane alone, 0 = x too */
    double at[2];                      /* far: the angle, towards (x, y); near: mm */
    double miss[2];                    /* what is left of the goal, mm */
    struct aim_near near;              /* the chief ray looked at last */
    size_t sought;                     /* in search of chief rays, as aim.sought */
    struct error lost;                 /* why a chief ray was not found last */
};

/* Far: at an angle of |at| from the axis, towards it; so nothing is special about 90 degrees. */
static bool beam_at(const struct setup *setup, const double at[2], struct beam *beam,
                    struct error *error)
{
    const double n = fabs(setup->first.index_object);
    if (!setup->object.is_infinite) {
        const double point[3] = {at[0], at[1], -setup->object.distance.hi};
        return beam_from_point(point, n, beam, error);
    }
    const double t = hypot(at[0], at[1]), scale = t > 0 ? sin(t) / t : 1;
    if (!(t < 3.14)) {
        return fail(error, ERROR_DOMAIN, "the field lies behind the lens");
    }
    *beam = beam_along((double[3]){at[0] * scale, at[1] * scale, cos(t)}, n);
    return true;
}

static bool setup_beam_find_chief(struct setup_beam_search *search, const struct beam *beam,
                                  struct ray *chief)
{
    struct aim aim = {.sought = 0};
    if (search->setup->first.is_telecentric) {
        return aim_at_entrance(beam, &search->setup->first, 0, 0, chief, &search->lost);
    }
    if (search->sought > most_sought) {
        return false;
    }
    bool found =
        aim_open_near(search->open, beam, &search->near, search->setup->arena, &aim, &search->lost);
    search->sought += aim.sought;
    *chief = found ? aim_chief(&aim) : (struct ray){.status = RAY_MISS};
    return found;
}

/* How far from the goal the chief ray meets the image plane. */
static bool setup_beam_look(struct setup_beam_search *search, const double at[2], double miss[2])
{
    struct arena *arena = search->setup->arena;
    const struct arena_mark mark = arena_mark(arena);
    struct beam beam;
    struct ray chief;
    bool found = beam_at(search->setup, at, &beam, &search->lost) &&
                 setup_beam_find_chief(search, &beam, &chief);
    if (found) {
        struct rays rays = rays_new(arena, 1);
        rays_set(&rays, 0, search->image->index_first, &chief);
        rays_trace(search->image, &rays, NULL);
        const struct ray end = rays_get(&rays, 0, search->image->index_last);
        found = end.status == RAY_OK || fail(&search->lost, ERROR_DOMAIN,
                                             "the chief ray is lost at surface %zu", end.surface);
        miss[0] = search->goal[0] - end.point[0];
        miss[1] = search->goal[1] - end.point[1];
    }
    arena_reset(arena, mark);
    return found;
}

/* Newton's step, the slopes by differences; false where there are none. */
static bool find_step(struct setup_beam_search *search, double step[2])
{
    double slope[2][2] = {{1, 0}, {0, 1}};
    const double h = search->setup->object.is_infinite
                         ? 1e-6
                         : 1e-6 * (fabs(search->setup->object.distance.hi) + search->size);
    for (int k = search->first; k < 2; k++) {
        double at[2] = {search->at[0], search->at[1]}, beside[2];
        at[k] += h;
        bool found = setup_beam_look(search, at, beside);
        if (!found) {
            at[k] -= 2 * h;
            found = setup_beam_look(search, at, beside);
        }
        if (!found) {
            return false;
        }
        for (int i = 0; i < 2; i++) {
            slope[i][k] = (search->miss[i] - beside[i]) / (at[k] - search->at[k]);
        }
    }
    if (search->first == 1) {
        step[0] = 0;
        step[1] = search->miss[1] / slope[1][1];
    } else {
        const double det = slope[0][0] * slope[1][1] - slope[0][1] * slope[1][0];
        step[0] = (slope[1][1] * search->miss[0] - slope[0][1] * search->miss[1]) / det;
        step[1] = (slope[0][0] * search->miss[1] - slope[1][0] * search->miss[0]) / det;
    }
    return isfinite(step[0]) && isfinite(step[1]);
}

static double setup_beam_left_over(const struct setup_beam_search *search, const double miss[2])
{
    return search->first == 1 ? fabs(miss[1]) : hypot(miss[0], miss[1]);
}

/* One step, halved until it leads nearer; false if none does. */
static bool setup_beam_improve(struct setup_beam_search *search)
{
    double step[2], miss[2];
    const double before = setup_beam_left_over(search, search->miss);
    if (!find_step(search, step)) {
        return false;
    }
    /* at rounding smaller steps lead nowhere either */
    const double smallest = before <= 1e-13 * search->size ? 0.9 : 1e-6;
    for (double share = 1; share > smallest; share /= 2) {
        const double at[2] = {search->at[0] + share * step[0], search->at[1] + share * step[1]};
        if (setup_beam_look(search, at, miss) && setup_beam_left_over(search, miss) < before) {
            for (int i = 0; i < 2; i++) {
                search->at[i] = at[i];
                search->miss[i] = miss[i];
            }
            return true;
        }
    }
    return false;
}

/* From a field near by, in proportion to its height. */
static bool setup_beam_begin_near(struct setup_beam_search *search, const struct setup_near *near)
{
    const double height = hypot(near->goal[0], near->goal[1]);
    const double scale = hypot(search->goal[0], search->goal[1]) / height;
    if (!(height > 0) || !isfinite(scale)) {
        return false;
    }
    search->at[search->first] = scale * near->at[search->first];
    search->at[1] = scale * near->at[1];
    search->near = near->chief;
    return setup_beam_look(search, search->at, search->miss);
}

/* From the paraxial field, or one nearer to the axis whose chief ray is found. */
static bool setup_beam_begin(struct setup_beam_search *search)
{
    enum { TRIES = 24 };
    const struct first_order *first = &search->setup->first;
    const bool is_centre = hypot(search->goal[0], search->goal[1]) == 0; /* none is nearer */
    double share = 1;
    for (int try = 0; try < (is_centre ? 1 : TRIES); try++, share *= 0.75) {
        for (int i = 0; i < 2; i++) {
            const double height = share * search->goal[i];
            search->at[i] = search->setup->object.is_infinite
                                ? atan(height * first->power / first->index_object)
                                : height / first->magnification;
        }
        if (setup_beam_look(search, search->at, search->miss)) {
            return true;
        }
    }
    return false;
}

static bool setup_refuse(const struct setup_beam_search *search, bool begun, struct error *error)
{
    const bool far = search->setup->object.is_infinite;
    const double field = hypot(search->at[0], search->at[1]) * (far ? DEGREES_PER_RADIAN : 1);
    if (!begun) {
        *error = search->lost;
        return error_prefix(error, "no chief ray for a real image height of %.6g mm: ",
                            hypot(search->goal[0], search->goal[1]));
    }
    return fail(error, ERROR_DOMAIN,
                "no chief ray meets the image plane at a height of %.6g mm: the search %s at "
                "%.6g mm, of a field of %.6g %s",
                hypot(search->goal[0], search->goal[1]),
                search->sought > most_sought ? "was given up" : "ended",
                hypot(search->goal[0] - search->miss[0], search->goal[1] - search->miss[1]), field,
                far ? "deg" : "mm");
}

static bool setup_solve(struct setup_beam_search *search, const struct setup_near *near,
                        struct error *error)
{
    enum { STEPS = 60 };
    const double rounding = 2e-16 * search->size, enough = 1e-10 * search->size;
    bool begun = (near != NULL && near->is_known && setup_beam_begin_near(search, near)) ||
                 setup_beam_begin(search);
    for (int step = 0;
         step < STEPS && begun && setup_beam_left_over(search, search->miss) > rounding; step++) {
        if (!setup_beam_improve(search)) {
            break;
        }
    }
    return (begun && setup_beam_left_over(search, search->miss) <= enough) ||
           setup_refuse(search, begun, error);
}

/* At the primary wavelength, and with an image plane: that of the setup, else of the lens. */
static bool setup_beam_open_search(struct setup *primary, struct setup_beam_search *search,
                                   struct error *error)
{
    const double radius = primary->first.stop_radius;
    if (isnan(primary->image) &&
        !setup_place_image(primary, &(struct plane_value){.kind = PLANE_OF_LENS}, error)) {
        return false;
    }
    if (isnan(primary->image)) {
        return fail(error, ERROR_DOMAIN,
                    "the field is the height of a real image, but the image is infinitely far "
                    "away");
    }
    /* a chief ray goes through the centre of the stop, however wide it is */
    primary->first.stop_radius = radius > 0 ? radius : 1;
    search->setup = primary;
    search->open = setup_system(primary, 0, SETUP_OPEN, error);
    search->image =
        search->open != NULL ? setup_system(primary, 0, SETUP_OPEN | SETUP_IMAGE, error) : NULL;
    search->size = fmax(hypot(search->goal[0], search->goal[1]), primary->first.stop_radius);
    return search->image != NULL;
}

/*
 * The object point of a height in the image: an angle towards it, or a height.
 *
 * Formula   Newton's method, steps halved until they lead nearer, on the chief ray of
 * trace/aim/aim,
 *           from the paraxial field; to rounding, 1e-10 of the height at worst. In a round lens
 *           the plane through axis and image point is that of y and z
 */
static bool setup_beam_find_object(const struct setup *setup, const double goal[2],
                                   struct setup_near *near, double at[2], struct error *error)
{
    struct setup primary =
        setup_at_wavelength(setup, lens_primary_wavelength(setup->lens), setup->arena);
    struct setup_beam_search search = {.goal = {goal[0], goal[1]}};
    const bool turns = lens_is_round(setup->lens);
    const double height = hypot(goal[0], goal[1]);
    at[0] = at[1] = 0;
    if (turns && height == 0) {
        return true;
    }
    if (turns) {
        search.first = 1;
        search.goal[0] = 0;
        search.goal[1] = height;
    }
    if (!setup_beam_open_search(&primary, &search, error) || !setup_solve(&search, near, error)) {
        return false;
    }
    if (near != NULL) {
        *near = (struct setup_near){.is_known = true,
                                    .goal = {search.goal[0], search.goal[1]},
                                    .at = {search.at[0], search.at[1]},
                                    .chief = search.near};
    }
    for (int i = 0; i < 2; i++) {
        at[i] = turns ? search.at[1] * (goal[i] / height) : search.at[i];
    }
    return true;
}

struct field_point setup_in_section(const struct setup *setup, const struct field_point *point)
{
    struct field_point meridional = *point;
    const size_t axis = setup_axis(setup);
    if (point->value[1 - axis] != 0) {
        meridional.value[1 - axis] = 0;
        meridional.value[axis] = lens_is_round(setup->lens)
                                     ? field_extent(point->kind, point->value)
                                     : point->value[axis];
    }
    return meridional;
}

bool setup_beam_near(const struct setup *setup, const struct field_point *field,
                     struct setup_near *near, struct beam *beam, struct error *error)
{
    if (field->kind != FIELD_REAL) {
        return beam_of_field(field, &setup->object, &setup->first, beam, error);
    }
    const struct arena_mark mark = arena_mark(setup->arena);
    double at[2];
    const bool found = setup_beam_find_object(setup, field->value, near, at, error);
    arena_reset(setup->arena, mark);
    return found && beam_at(setup, at, beam, error);
}

bool setup_beam(const struct setup *setup, const struct field_point *field, struct beam *beam,
                struct error *error)
{
    return setup_beam_near(setup, field, NULL, beam, error);
}

bool setup_real_in_object(const struct setup *setup, struct field_point *field, struct error *error)
{
    const size_t axis = setup_axis(setup);
    const struct arena_mark mark = arena_mark(setup->arena);
    double at[2];
    *field = setup_in_section(setup, field);
    if (field->kind != FIELD_REAL) {
        return true;
    }
    const bool found = setup_beam_find_object(setup, field->value, NULL, at, error);
    arena_reset(setup->arena, mark);
    field->kind = setup->object.is_infinite ? FIELD_ANGLE : FIELD_HEIGHT;
    field->value[axis] = found ? at[axis] : (double)NAN;
    return found;
}
