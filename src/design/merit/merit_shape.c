/* design/merit/merit_shape.c - operands of what can be made: thicknesses of glass and air. */
/* SPDX-License-Identifier: MIT */
#include "design/merit/merit_kinds.h"

#include "analysis/waves/wave_reference.h"
#include "design/merit/merit_paraxial.h"
#include "design/merit/merit_ray.h"
#include "design/merit/merit_shape.h"

#include <math.h>
#include <string.h>

/* -------- how far out light comes -------- */

/* What is open: of the axis, and the upper and the lower one of the edge of the field. */
static const size_t edge_rays[] = {0, 2, 3};

/*
 * Make ready: how far out light comes at each surface of the slot's place that states no diameter.
 *
 * Errors    no aperture
 */
bool merit_reach_open(struct merit *merit, const struct merit_slot *slot, struct arena *arena,
                      struct error *error)
{
    struct merit_place *place = &merit->places[slot->place];
    const size_t columns = merit->variable_count > 0 ? merit->variable_count : 1;
    const struct field_point *edge = &place->setup.edge;
    struct error ignored;
    double towards[2];
    if (place->reach != NULL) {
        return true;
    }
    if (!merit_needs_aperture(place, error)) {
        return error_prefix(error, "surfaces without a diameter are as large as the light: ");
    }
    place->reach = ARENA_ARRAY(arena, columns * place->lens->surface_count, struct dual);
    if (place->lens->stop == LENS_NONE || !merit_ray_check(place, edge, &ignored)) {
        return true;
    }
    struct setup_field *fields = ARENA_ARRAY(arena, 2, struct setup_field);
    struct pupil_point *points = ARENA_ARRAY(arena, 2, struct pupil_point);
    struct setup_wavelength *light = ARENA_NEW(arena, struct setup_wavelength);
    wave_section(edge, towards);
    fields[0] = (struct setup_field){{.kind = FIELD_NONE}, 1};
    fields[1] = (struct setup_field){*edge, 1};
    points[0] = (struct pupil_point){towards[0], towards[1], 1};
    points[1] = (struct pupil_point){-towards[0], -towards[1], 1};
    *light = (struct setup_wavelength){place->lights[0].wavelength, 1};
    struct bundle_wish wish = {.fields = fields,
                               .field_count = edge->kind == FIELD_NONE ? 1 : 2,
                               .wavelengths = light,
                               .wavelength_count = 1,
                               .points = points,
                               .point_count = 2,
                               .is_bare = true};
    place->edges = ARENA_NEW(arena, struct merit_beams);
    return merit_ray_open(merit, slot, &wish, arena, place->edges, error);
}

/* The height of a ray and its derivatives, of one that was traced last. */
static bool merit_reach_derive(struct merit *merit, const struct merit_place *place, size_t ray,
                               size_t surface)
{
    const size_t columns = merit_columns(merit), surfaces = place->lens->surface_count;
    struct merit_ray *end = ARENA_ARRAY(merit->arena, columns + 1, struct merit_ray);
    if (!merit_ray_derive(merit, place->edges, ray, surface + 1, end)) {
        return false;
    }
    for (size_t j = 0; j < columns; j++) {
        const struct dual *at = end[j].at;
        const double height = hypot(at[0].value, at[1].value);
        /* on the axis the height has no slope: it is a corner */
        const double slope =
            height > 0 ? (at[0].value * at[0].slope + at[1].value * at[1].slope) / height : 0;
        place->reach[j * surfaces + surface] = (struct dual){height, slope};
    }
    return true;
}

/* Of each surface the ray that is farthest out. */
static bool find_edges(struct merit *merit, const struct merit_slot *slot)
{
    const struct merit_place *place = &merit->places[slot->place];
    const size_t surfaces = place->lens->surface_count;
    const size_t count = place->edges->bundle.wish.field_count > 1 ? 3 : 1;
    size_t *which = ARENA_ARRAY(merit->arena, surfaces, size_t), lost = surfaces;
    for (size_t k = 0; k < count; k++) {
        if (!merit_ray_trace(merit, place->edges, edge_rays[k])) {
            return false;
        }
        for (size_t i = 0; i < lost; i++) {
            struct merit_ray ray;
            lost = merit_ray_at(place->edges, edge_rays[k], i + 1, &ray) ? lost : i;
            const double height = hypot(ray.at[0].value, ray.at[1].value);
            if (!place->lens->surfaces[i].has_diameter &&
                (k == 0 || height > place->reach[i].value)) {
                place->reach[i] = dual_of(height);
                which[i] = edge_rays[k];
            }
        }
    }
    if (lost < surfaces) {
        return fail(&merit->why, ERROR_DOMAIN, "a ray at the edge is lost at surface %zu",
                    lost + 1);
    }
    for (size_t i = 0; i < surfaces && merit->derives; i++) {
        if (!place->lens->surfaces[i].has_diameter &&
            (!merit_ray_trace(merit, place->edges, which[i]) ||
             !merit_reach_derive(merit, place, which[i], i))) {
            return false;
        }
    }
    return true;
}

/*
 * Those distances and their derivatives, into place->reach.
 *
 * Formula   the largest of real rays of the primary wavelength through the edge of the stop: of the
 *           axis, and of the field farthest from it the two in its plane. Where the lens has no
 *           such rays (no stop, an ideal lens, heights of the real image) |y| + |ybar| of the
 *           paraxial marginal and chief ray
 * Errors    merit->why: a ray is lost
 */
bool merit_reach(struct merit *merit, const struct merit_slot *slot)
{
    struct merit_place *place = &merit->places[slot->place];
    if (place->reached == merit->evaluation) {
        return true;
    }
    if (place->edges != NULL && !merit_beams_aim(merit, slot, place->edges)) {
        place->reached = 0;
        return false;
    }
    const struct arena_mark mark = arena_mark(merit->arena);
    const bool done =
        place->edges != NULL ? find_edges(merit, slot) : merit_reach_paraxial(merit, slot);
    place->reached = done ? merit->evaluation : 0;
    arena_reset(merit->arena, mark);
    return done;
}

/* -------- spaces -------- */

/* A place of it. */
enum space_place { SPACE_AXIS, SPACE_EDGE, SPACE_PLACES };

static bool is_only_stop(const struct surface *surface)
{
    return surface->kind == SURFACE_STOP;
}

/* The space behind a surface; false: there is none that counts. */
bool merit_space_behind(const struct lens *lens, size_t surface, struct space *space)
{
    double direction = 1;
    for (size_t i = 0; i <= surface; i++) {
        direction = surface_reflects(&lens->surfaces[i]) ? -direction : direction;
    }
    *space = (struct space){surface, surface + 1, direction,
                            medium_is_air(&lens->surfaces[surface].medium)};
    while (space->right + 1 < lens->surface_count && is_only_stop(&lens->surfaces[space->right])) {
        space->right++;
    }
    return space->right < lens->surface_count && !is_only_stop(&lens->surfaces[surface]) &&
           !is_only_stop(&lens->surfaces[space->right]);
}

/* Does the operand look at this place of the space? */
static bool merit_shape_is_wanted(enum operand_kind kind, const struct space *space,
                                  enum space_place place)
{
    return kind == OPERAND_AIR ? space->is_air
                               : !space->is_air && (kind == OPERAND_EDGE) == (place == SPACE_EDGE);
}

/* -------- sags -------- */

/*
 * A conic ends where it is parallel to the axis. A surface that lenses on the way to a better one
 * have there is continued along its tangent from where the cosine of its slope, s below, is this.
 */
static const double steepest = 0.05;

/*
 * z = c u/(1 + s), s^2 = 1 - (1+k) c^2 u, u = r^2; and the series.
 *
 * The tangent begins at (1+k) c^2 r^2 = 1 - s^2 and has the slope (1 - s^2)^(1/2)/((1+k)^(1/2) s),
 * which is the same for all c: so dz/dc stays what it is there
 */
struct sag merit_sag_at(const struct surface *surface, double r)
{
    struct sag sag = {0};
    if (!surface_has(surface, SURFACE_HAS_CURVE)) {
        return sag;
    }
    const double c = surface_base_curvature(surface).hi, k1 = 1 + surface->conic.value.hi;
    const double last = 1 - steepest * steepest;
    const bool is_beyond = k1 * c * c * r * r > last;
    const double to = is_beyond ? sqrt(last / k1) / fabs(c) : r, u = to * to;
    const double s = is_beyond ? steepest : sqrt(1 - k1 * c * c * u), share = u / (1 + s);
    sag.value = c * share;
    /* ds/dc = -k1 c u/s, ds/dk = -c^2 u/(2 s), ds/dr = -k1 c^2 r/s */
    sag.by_curvature = share + c * share * k1 * c * u / (s * (1 + s));
    sag.by_conic = c * share * c * c * u / (2 * s * (1 + s));
    sag.by_radius = c * to / s;
    if (is_beyond) {
        sag.value += sag.by_radius * (r - to);
        sag.by_conic -= sag.by_radius * (r - to) / (2 * k1);
    }
    if (r > 0) {
        const struct departure departure = surface_departure(surface, r * r);
        sag.value += departure.value;
        sag.by_radius += 2 * r * departure.slope;
    }
    return sag;
}

/* How a sag at r changes by a number of its surface. */
double merit_sag_slope(const struct sag *sag, double r, struct parameter basis)
{
    if (basis.kind == PARAMETER_CURVATURE) {
        return sag->by_curvature;
    }
    if (basis.kind == PARAMETER_CONIC) {
        return sag->by_conic;
    }
    if (basis.kind == PARAMETER_COEFFICIENT) {
        return pow(r, basis.order);
    }
    return 0;
}

/* The semi-diameter of a surface by a variable: half its diameter, or where light comes. */
struct dual merit_reach_of(const struct merit_place *place, size_t surface, size_t column)
{
    const struct surface *at = &place->lens->surfaces[surface];
    return at->has_diameter ? dual_of(at->diameter.value.hi / 2)
                            : place->reach[column * place->lens->surface_count + surface];
}

/* The surface as far out as which the edge is. */
static size_t edge_surface(const struct merit_place *place, const struct space *space)
{
    const double left = merit_reach_of(place, space->left, 0).value;
    const double right = merit_reach_of(place, space->right, 0).value;
    return (left < right) == space->is_air ? space->left : space->right;
}

/* -------- thicknesses -------- */

/* A place of a surface that a thickness is measured to. */
struct thickness_end {
    size_t surface;
    double sign; /* of its sag in the thickness */
    double r;
    size_t rim; /* the surface whose semi-diameter r is; LENS_NONE: of none */
};

static double thickness_end_sag(const struct lens *lens, const struct thickness_end *end)
{
    return end->sign * merit_sag_at(&lens->surfaces[end->surface], end->r).value;
}

/*
 * Where a surface ends a thickness so far from the axis. Beyond its own semi-diameter, as where the
 * other surface of an element is wider, it goes on along its curve or is ground flat, whichever
 * leaves less.
 */
static struct thickness_end thickness_end_at(const struct merit_place *place,
                                             const struct space *space, bool is_right, double r)
{
    const size_t surface = is_right ? space->right : space->left;
    const double sign = is_right ? space->direction : -space->direction;
    const struct thickness_end curve = {surface, sign, r, LENS_NONE};
    if (!(r > 0)) {
        return curve;
    }
    const struct thickness_end rim = {surface, sign, merit_reach_of(place, surface, 0).value,
                                      surface};
    const bool is_flat =
        r > rim.r && thickness_end_sag(place->lens, &rim) < thickness_end_sag(place->lens, &curve);
    return is_flat ? rim : curve;
}

/* On the axis. */
static double space_length(const struct lens *lens, const struct space *space)
{
    double length = 0;
    for (size_t i = space->left; i < space->right; i++) {
        length += lens->surfaces[i].thickness.value.hi;
    }
    return space->direction * length;
}

static double thickness_at(const struct merit_place *place, const struct space *space, double r)
{
    const struct thickness_end left = thickness_end_at(place, space, false, r);
    const struct thickness_end right = thickness_end_at(place, space, true, r);
    return space_length(place->lens, space) + thickness_end_sag(place->lens, &left) +
           thickness_end_sag(place->lens, &right);
}

/* How fast it grows outwards. */
static double thickness_slope(const struct merit_place *place, const struct space *space, double r)
{
    double slope = 0;
    for (int i = 0; i < 2; i++) {
        const struct thickness_end end = thickness_end_at(place, space, i == 1, r);
        const struct surface *surface = &place->lens->surfaces[end.surface];
        slope += end.rim == LENS_NONE ? end.sign * merit_sag_at(surface, r).by_radius : 0;
    }
    return slope;
}

/* Spheres come nearer each other all the way from the axis to the edge, or part all the way. */
static bool has_middle(const struct lens *lens, const struct space *space)
{
    return surface_profile(&lens->surfaces[space->left]) > PROFILE_SPHERE ||
           surface_profile(&lens->surfaces[space->right]) > PROFILE_SPHERE;
}

/* How far out it is thinnest, the edge being at r: among points in equal steps, and between those
   beside the thinnest. */
static double thinnest_place(const struct merit_place *place, const struct space *space, double r)
{
    enum { ZONES = 24, HALVINGS = 32 };
    double least = INFINITY;
    int at = ZONES;
    for (int i = ZONES; i >= 0; i--) {
        const double here = thickness_at(place, space, r * i / ZONES);
        at = here < least ? i : at;
        least = fmin(least, here);
    }
    if (at == ZONES && thickness_slope(place, space, r) <= 0) {
        return r;
    }
    if (at == 0 && thickness_slope(place, space, r / (16 * ZONES)) >= 0) {
        return 0; /* or nearer the axis than anything hangs on */
    }
    double low = at > 0 ? r * (at - 1) / ZONES : 0, high = at < ZONES ? r * (at + 1) / ZONES : r;
    for (int i = 0; i < HALVINGS; i++) {
        const double middle = (low + high) / 2;
        if (thickness_slope(place, space, middle) < 0) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return high;
}

/* What the thickness somewhere counts in the figure of a place. */
struct thickness_part {
    double r, share;
    size_t rim; /* as of its ends on their curves */
};

enum { THICKNESS_PARTS = 3 };

/*
 * The thickness of a place of a space, of parts of which those with a share count.
 *
 * Formula   on the axis and at the edge what it is there; for the edge, where it is thinnest
 *           between them, by d less than on the axis and at the edge, max(least, edge - K d). So it
 *           is the least, but for a d of next to nothing, through which it is joined without a jump
 *           to lenses that are thinnest on the axis, a place of its own
 */
static void thickness_parts(const struct merit_place *place, const struct space *space,
                            enum space_place where, struct thickness_part parts[THICKNESS_PARTS])
{
    static const double steep = 200; /* K */
    struct thickness_part *axis = &parts[0], *edge = &parts[1], *middle = &parts[2];
    *axis = (struct thickness_part){0, where == SPACE_AXIS ? 1 : 0, LENS_NONE};
    *edge = *middle = (struct thickness_part){0, 0, LENS_NONE};
    if (where == SPACE_AXIS) {
        return;
    }
    edge->rim = edge_surface(place, space);
    edge->r = merit_reach_of(place, edge->rim, 0).value;
    edge->share = 1;
    if (!has_middle(place->lens, space)) {
        return;
    }
    middle->r = thinnest_place(place, space, edge->r);
    const double at_edge = thickness_at(place, space, edge->r);
    const double lower = fmin(thickness_at(place, space, 0), at_edge);
    const double least = thickness_at(place, space, middle->r);
    if (!(least < lower)) {
        return;
    }
    if (at_edge - steep * (lower - least) <= least) {
        edge->share = 0;
        middle->share = 1;
    } else { /* the axis is thinner than the edge, as steep > 1 */
        axis->share = -steep;
        middle->share = steep;
    }
}

/* Add a share of the sag of an end, by all columns, to merit->change. */
static void thickness_end_add(struct merit *merit, const struct merit_place *place, double share,
                              const struct thickness_end *end)
{
    const struct sag sag = merit_sag_at(&place->lens->surfaces[end->surface], end->r);
    const struct merit_light *light = &place->lights[0];
    for (size_t j = 0; j < merit_columns(merit); j++) {
        const double moved = end->rim != LENS_NONE ? merit_reach_of(place, end->rim, j).slope : 0;
        merit->change[j].value += share * sag.value;
        merit->change[j].slope += share * moved * sag.by_radius;
    }
    for (size_t i = 0; i < light->link_count && merit->derives; i++) {
        const struct variable_link *link = &light->links[i];
        if (link->basis.surface == end->surface) {
            const double slope = merit_sag_slope(&sag, end->r, link->basis);
            merit->change[link->variable].slope += share * slope * link->slope;
        }
    }
}

/* Add a part of a thickness, by all columns, to merit->change. */
static void thickness_part_add(struct merit *merit, const struct merit_place *place,
                               const struct space *space, const struct thickness_part *part)
{
    const struct merit_light *light = &place->lights[0];
    const double length = space_length(place->lens, space);
    for (size_t j = 0; j < merit_columns(merit); j++) {
        merit->change[j].value += part->share * length;
    }
    for (int i = 0; i < 2 && part->r > 0; i++) {
        struct thickness_end end = thickness_end_at(place, space, i == 1, part->r);
        end.rim = end.rim == LENS_NONE ? part->rim : end.rim;
        thickness_end_add(merit, place, part->share * end.sign, &end);
    }
    for (size_t i = 0; i < light->link_count && merit->derives; i++) {
        const struct variable_link *link = &light->links[i];
        if (link->basis.kind == PARAMETER_THICKNESS && link->basis.surface >= space->left &&
            link->basis.surface < space->right) {
            merit->change[link->variable].slope += space->direction * part->share * link->slope;
        }
    }
}

/* The thickness in one place, by all columns, into merit->change. */
static void merit_shape_measure(struct merit *merit, const struct merit_place *place,
                                const struct space *space, enum space_place where)
{
    struct thickness_part parts[THICKNESS_PARTS];
    thickness_parts(place, space, where, parts);
    memset(merit->change, 0, merit_columns(merit) * sizeof *merit->change);
    for (int i = 0; i < THICKNESS_PARTS; i++) {
        if (parts[i].share != 0) {
            thickness_part_add(merit, place, space, &parts[i]);
        }
    }
}

/* Is the light wanted for the edge of a space? */
static bool wants_reach(const struct lens *lens, enum operand_kind kind, const struct space *space)
{
    return merit_shape_is_wanted(kind, space, SPACE_EDGE) &&
           !(lens->surfaces[space->left].has_diameter && lens->surfaces[space->right].has_diameter);
}

size_t merit_prepare_shape(struct merit *merit, struct merit_slot *slot, struct arena *arena,
                           struct error *error)
{
    struct merit_place *place = &merit->places[slot->place];
    const struct lens *lens = place->lens;
    const enum operand_kind kind = slot->operand->kind;
    size_t count = 0, first, end;
    bool reaches = false;
    struct space space;
    merit_surfaces(slot->operand, lens, &first, &end);
    for (size_t i = first; i < end && i < lens->surface_count; i++) {
        if (merit_space_behind(lens, i, &space)) {
            count += merit_shape_is_wanted(kind, &space, SPACE_AXIS) +
                     merit_shape_is_wanted(kind, &space, SPACE_EDGE);
            reaches = reaches || wants_reach(lens, kind, &space);
        }
    }
    if (count == 0) {
        fail(error, ERROR_DOMAIN, "no %s lies behind these surfaces",
             kind == OPERAND_AIR ? "air" : "glass");
    }
    return reaches && !merit_reach_open(merit, slot, arena, error) ? 0 : count;
}

bool merit_fill_shape(struct merit *merit, const struct merit_slot *slot, double *residuals,
                      double *jacobian)
{
    const struct merit_place *place = &merit->places[slot->place];
    size_t at = 0, first, end;
    struct space space;
    merit_light(merit, slot, NAN);
    if (place->reach != NULL && !merit_reach(merit, slot)) {
        return false;
    }
    merit_surfaces(slot->operand, place->lens, &first, &end);
    for (size_t i = first; i < end && i < place->lens->surface_count; i++) {
        const bool is_there = merit_space_behind(place->lens, i, &space);
        for (int where = 0; is_there && where < SPACE_PLACES; where++) {
            if (!merit_shape_is_wanted(slot->operand->kind, &space, (enum space_place)where)) {
                continue;
            }
            merit_shape_measure(merit, place, &space, (enum space_place)where);
            if (!merit_put(merit, slot, at++, residuals, jacobian)) {
                return false;
            }
        }
    }
    return true;
}
