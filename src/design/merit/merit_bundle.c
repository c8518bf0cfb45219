/* design/merit/merit_bundle.c - the rays that residuals are made of, block by block. */
/* SPDX-License-Identifier: MIT */
#include "design/merit/merit_bundle.h"

#include "analysis/pupil/bundle.h"
#include "base/watch.h"
#include "design/tolerance/linear_rays.h"
#include "optics/lens_indices.h"

#include <math.h>
#include <string.h>

bool merit_bundle_goes_on(const struct merit_bundle *bundle, size_t rays, struct error *error)
{
    return watch_add(bundle->wish.watch, rays) ||
           fail(error, ERROR_DOMAIN, "interrupted before rays were ready");
}

/* -------- choosing -------- */

/* What has no derivatives is refused. */
static bool merit_bundle_check(const struct bundle_wish *wish, struct error *error)
{
    const struct lens *lens = wish->setup->lens;
    if (lens->focus == FOCUS_BEST && !wish->is_bare) {
        fail(error, ERROR_DOMAIN,
             "the image plane of 'focus best' is looked for anew in every lens");
        return error_hint(error, "focus table with the last thickness varied, or focus paraxial");
    }
    for (size_t i = 0; i < lens->surface_count; i++) {
        if (surface_has(&lens->surfaces[i], SURFACE_HAS_FOCAL)) {
            return fail(error, ERROR_DOMAIN,
                        "surface %zu is a thick lens, whose rays have no derivatives", i + 1);
        }
    }
    return true;
}

/*
 * The points of the pupil of a field at a wavelength: a pattern, or what the lens at the start lets
 * through.
 *
 * Given     before, near  of the wavelength before, as analysis/rays/spot.c has it; null, and
 *                         nothing: this is the first. Receive those of this one
 */
static bool find_sample(const struct bundle_wish *wish, size_t field, size_t light,
                        struct bundle_source **before, struct aim_near *near, struct arena *arena,
                        struct sample *sample, struct error *error)
{
    if (wish->points != NULL) {
        sample->count = wish->point_count;
        sample->points = ARENA_ARRAY(arena, sample->count, struct pupil_point);
        memcpy(sample->points, wish->points, sample->count * sizeof *wish->points);
        return true;
    }
    if (!wish->clip) {
        return sample_make(wish->pattern, wish->rays, wish->seed, arena, sample, error);
    }
    struct setup *setup = ARENA_NEW(arena, struct setup);
    struct bundle_question *question = ARENA_NEW(arena, struct bundle_question);
    struct bundle_source *source = ARENA_NEW(arena, struct bundle_source);
    struct bundle bundle;
    *setup = setup_at_wavelength(wish->setup, wish->wavelengths[light].wavelength, arena);
    *question = (struct bundle_question){.setup = setup,
                                         .field = &wish->fields[field].point,
                                         .clip = true,
                                         .from_entrance = wish->from_entrance,
                                         .pattern = wish->pattern,
                                         .seed = wish->seed,
                                         .near = near};
    if (!bundle_open_beside(question, *before, arena, source, error) ||
        !bundle_trace(source, wish->rays, source->system->places, arena, &bundle, error)) {
        return false;
    }
    *before = source;
    sample->points = ARENA_ARRAY(arena, bundle.count, struct pupil_point);
    sample->count = 0;
    for (size_t i = 0; i < bundle.count; i++) {
        const struct ray_block *block = &bundle.rays.blocks[i / RAYS_BLOCK];
        if (ray_block_status(block, i % RAYS_BLOCK) == RAY_OK) {
            sample->points[sample->count++] = bundle.points[i];
        }
    }
    return true;
}

/* Vignetted as the square of the field against those of the lens. */
static void merit_bundle_vignette(const struct bundle_wish *wish, size_t field,
                                  const struct sample *sample)
{
    const struct setup *setup = wish->setup;
    const struct field_point *at = &wish->fields[field].point;
    const double square = at->value[0] * at->value[0] + at->value[1] * at->value[1];
    double largest = square;
    for (size_t i = 0; i < setup->field_count; i++) {
        const double *value = setup->fields[i].point.value;
        largest = fmax(largest, value[0] * value[0] + value[1] * value[1]);
    }
    const bool is_on_axis = at->kind == FIELD_NONE || !(square > 0);
    const double open = 1 - (is_on_axis ? 0 : wish->vignetting * square / largest);
    for (size_t i = 0; i < sample->count; i++) {
        sample->points[i].x *= open;
        sample->points[i].y *= open;
    }
}

static enum merit_symmetry symmetry_of(const struct bundle_wish *wish, size_t field)
{
    const struct field_point *point = &wish->fields[field].point;
    const bool is_none = point->kind == FIELD_NONE;
    if (!wish->is_round || !lens_is_round(wish->setup->lens)) {
        return SYMMETRY_NONE;
    }
    if (is_none || (point->value[0] == 0 && point->value[1] == 0)) {
        return SYMMETRY_ROUND;
    }
    if (point->value[0] == 0) {
        return SYMMETRY_MIRROR;
    }
    return SYMMETRY_NONE;
}

/* A field at all wavelengths. */
static bool merit_bundle_open_field(struct merit_bundle *bundle, size_t field, struct arena *room,
                                    struct error *error)
{
    const struct bundle_wish *wish = &bundle->wish;
    struct bundle_source *before = NULL;
    struct aim_near near = {.is_known = false};
    for (size_t light = 0; light < wish->wavelength_count; light++) {
        struct bundle_group *group = &bundle->groups[light * wish->field_count + field];
        struct sample sample;
        *group = (struct bundle_group){.field = field,
                                       .light = light,
                                       .symmetry = symmetry_of(wish, field),
                                       .weight = wish->fields[field].weight *
                                                 wish->wavelengths[light].weight};
        if (light > 0 && !wish->clip) { /* the same at all wavelengths */
            group->points = bundle->groups[field].points;
            continue;
        }
        if (!find_sample(wish, field, light, &before, &near, room, &sample, error) ||
            !merit_bundle_goes_on(bundle, sample.count, error)) {
            return false;
        }
        merit_bundle_vignette(wish, field, &sample);
        merit_points_of(&sample, wish->whole ? SYMMETRY_NONE : group->symmetry, bundle->arena,
                        &group->points);
    }
    return true;
}

static bool open_groups(struct merit_bundle *bundle, struct error *error)
{
    const struct bundle_wish *wish = &bundle->wish;
    bundle->group_count = wish->field_count * wish->wavelength_count;
    bundle->groups = ARENA_ARRAY(bundle->arena, bundle->group_count, struct bundle_group);
    struct arena room = {0}; /* what a field lets through is looked for in much more than is kept */
    bool opened = true;
    for (size_t field = 0; field < wish->field_count && opened; field++) {
        opened = merit_bundle_open_field(bundle, field, &room, error);
        arena_reset(&room, (struct arena_mark){NULL, 0});
    }
    arena_free(&room);
    return opened;
}

/* -------- blocks -------- */

static void open_blocks(struct merit_bundle *bundle)
{
    const size_t fields = bundle->wish.field_count;
    const size_t most = fields < RAYS_BLOCK ? fields : RAYS_BLOCK;
    const bool is_apart = bundle->wish.is_apart;
    struct bundle_block *block = NULL;
    size_t points = 0;
    for (size_t i = 0; i < bundle->group_count; i++) {
        points += bundle->groups[i].points.count;
    }
    const size_t full = points / RAYS_BLOCK + 1 + bundle->wish.wavelength_count;
    bundle->blocks = ARENA_ARRAY(bundle->arena, is_apart ? points : full, struct bundle_block);
    for (size_t g = 0; g < bundle->group_count; g++) {
        const struct bundle_group *group = &bundle->groups[g];
        for (size_t done = 0; done < group->points.count;) {
            if (block == NULL || block->light != group->light || is_apart ||
                block->aimed.count == RAYS_BLOCK) {
                block = &bundle->blocks[bundle->block_count++];
                *block = (struct bundle_block){
                    .aimed = {.beams = ARENA_ARRAY(bundle->arena, most, struct aimed_beam)},
                    .lanes = ARENA_ARRAY(bundle->arena, RAYS_BLOCK, struct bundle_lane),
                    .light = group->light};
            }
            struct aimed *aimed = &block->aimed;
            const size_t left = group->points.count - done;
            const size_t room = is_apart ? 1 : (size_t)(RAYS_BLOCK - aimed->count);
            const size_t end = done + (left < room ? left : room);
            const int alike = is_apart ? BUNDLE_ALIKE : 1, count = alike * (int)(end - done);
            aimed->beams[aimed->beam_count++] = (struct aimed_beam){
                bundle->beams[group->field], .first = aimed->count, .count = count};
            for (int i = 0; i < count; i++, aimed->count++) {
                const size_t point = done + (size_t)(i / alike);
                block->lanes[aimed->count] = (struct bundle_lane){g, point, group->field};
                aimed->x[aimed->count] = group->points.points[point].x;
                aimed->y[aimed->count] = group->points.points[point].y;
            }
            done = end;
        }
    }
    for (size_t k = 0; k < bundle->block_count; k++) { /* aimed_open keeps beams only */
        struct aimed *aimed = &bundle->blocks[k].aimed;
        const struct aimed was = *aimed;
        aimed_open(was.beams, was.beam_count, !bundle->wish.from_entrance && !bundle->has_disc,
                   &bundle->work, aimed);
        memcpy(aimed->x, was.x, sizeof was.x);
        memcpy(aimed->y, was.y, sizeof was.y);
    }
}

/* -------- opening -------- */

static bool merit_bundle_open_beams(struct merit_bundle *bundle, struct error *error)
{
    const struct bundle_wish *wish = &bundle->wish;
    bundle->beams = ARENA_ARRAY(bundle->arena, wish->field_count, struct beam);
    for (size_t i = 0; i < wish->field_count; i++) {
        if (!setup_beam(wish->setup, &wish->fields[i].point, &bundle->beams[i], error)) {
            return false;
        }
    }
    return true;
}

/* One wavelength after the other. */
static bool merit_bundle_compile(struct merit_bundle *bundle, size_t light, const struct lens *lens,
                                 double stop_radius, struct error *error)
{
    struct bundle_light *at = &bundle->lights[light];
    struct system_options options = system_options_default();
    options.image = bundle->image;
    options.path = bundle->wish.path;
    options.stop_radius = stop_radius > 0 || !bundle->wish.is_apart ? stop_radius : 1;
    options.indices = at->n;
    if (!lens_indices(lens, at->wavelength, at->asked, at->n, error)) {
        return false;
    }
    if (light > 0) {
        system_recolour(&bundle->lights[0].system, at->wavelength, at->n, &bundle->within,
                        &at->system);
        return true;
    }
    return system_compile(lens, at->wavelength, &options, &bundle->within, &at->system, error);
}

static void open_layout(struct merit_bundle *bundle, size_t light, const struct bundle_links *links)
{
    struct bundle_light *at = &bundle->lights[light];
    const struct lens *lens = at->system.lens;
    const struct bundle_wish *wish = &bundle->wish;
    struct parameter *list =
        ARENA_ARRAY(bundle->arena, links->count + wish->irregularity_count + 1, struct parameter);
    size_t count = 0;
    for (size_t i = 0; i < wish->irregularity_count; i++) {
        list[count++] = irregularity_basis(&wish->irregularities[i]);
    }
    for (size_t i = 0; i < links->count; i++) {
        list[count++] = links->list[i].basis;
    }
    if (bundle->image_moves) {
        list[count++] =
            (struct parameter){.surface = lens->surface_count - 1, .kind = PARAMETER_THICKNESS};
    }
    derivative_layout_of(&at->system, list, count, bundle->arena, &at->layout);
}

static bool open_lights(struct merit_bundle *bundle, const struct bundle_links *links,
                        struct error *error)
{
    const struct bundle_wish *wish = &bundle->wish;
    const struct lens *lens = wish->setup->lens;
    size_t rows = 1;
    bundle->lights = ARENA_ARRAY(bundle->arena, wish->wavelength_count, struct bundle_light);
    for (size_t i = 0; i < wish->wavelength_count; i++) {
        bundle->lights[i] = (struct bundle_light){
            .wavelength = wish->wavelengths[i].wavelength,
            .asked = ARENA_ARRAY(bundle->arena, lens->surface_count + 1, struct medium),
            .n = ARENA_ARRAY(bundle->arena, lens->surface_count + 1, struct pair)};
        if (!merit_bundle_compile(bundle, i, lens, wish->setup->first.stop_radius, error)) {
            return false;
        }
        open_layout(bundle, i, &links[i]);
        const size_t here = bundle->lights[i].layout.rows;
        rows = here > rows ? here : rows;
    }
    bundle->gradient = ARENA_ARRAY(bundle->arena, rows * RAYS_BLOCK, double);
    return true;
}

/* The image plane at the start: its kind stays. */
static bool merit_bundle_open_image(struct merit_bundle *bundle, struct error *error)
{
    struct setup setup = *bundle->wish.setup;
    bundle->image = NAN;
    if (bundle->wish.is_bare) {
        return true;
    }
    if (isnan(setup.image) &&
        !setup_place_image(&setup, &(struct plane_value){.kind = PLANE_OF_LENS}, error)) {
        return false;
    }
    bundle->image = setup.image;
    bundle->image_moves = setup.focus != NULL && strcmp(setup.focus, "paraxial") == 0;
    if (!isfinite(bundle->image) && setup.lens->focus != FOCUS_AFOCAL) {
        bundle->image = 0; /* a lens that begins without an image gets one: merit_bundle_aim */
        bundle->image_moves = true;
    }
    return isfinite(bundle->image) ||
           fail(error, ERROR_DOMAIN,
                "the image is infinitely far away: rays do not meet in a plane");
}

bool merit_bundle_open(const struct bundle_wish *wish, const struct bundle_links *links,
                       size_t variable_count, struct arena *arena, struct merit_bundle *bundle,
                       struct error *error)
{
    *bundle = (struct merit_bundle){.wish = *wish,
                                    .arena = arena,
                                    .within = arena_within(arena),
                                    .has_disc = wish->setup->lens->stop == LENS_NONE};
    bundle->rates = ARENA_ARRAY(arena, variable_count + 1, struct bundle_rate);
    if (!merit_bundle_check(wish, error) || !merit_bundle_open_image(bundle, error) ||
        !merit_bundle_open_beams(bundle, error) || !open_lights(bundle, links, error) ||
        !open_groups(bundle, error)) {
        return false;
    }
    open_blocks(bundle);
    return true;
}

/* -------- the lens as it is now -------- */

static bool move_beams(struct merit_bundle *bundle, struct error *error)
{
    const struct bundle_wish *wish = &bundle->wish;
    for (size_t i = 0; i < wish->field_count; i++) {
        if (merit_bundle_moves(bundle, i) &&
            !beam_of_field(&wish->fields[i].point, &wish->setup->object, &bundle->first,
                           &bundle->beams[i], error)) {
            return false;
        }
    }
    for (size_t k = 0; k < bundle->block_count; k++) {
        struct bundle_block *block = &bundle->blocks[k];
        for (size_t g = 0; g < block->aimed.beam_count; g++) {
            struct aimed_beam *beam = &block->aimed.beams[g];
            beam->beam = bundle->beams[block->lanes[beam->first].field];
        }
    }
    return true;
}

void merit_bundle_forget(struct merit_bundle *bundle)
{
    for (size_t k = 0; k < bundle->block_count; k++) {
        struct aimed *aimed = &bundle->blocks[k].aimed;
        aimed->is_known = false;
        for (size_t g = 0; g < aimed->beam_count; g++) {
            aimed->beams[g].near.is_known = false;
        }
    }
}

void merit_bundle_settle(struct merit_bundle *bundle, bool holds)
{
    for (size_t k = 0; k < bundle->block_count; k++) {
        struct bundle_block *block = &bundle->blocks[k];
        if (!holds) {
            /* what a block has of its rays, kept beside it */
            const size_t count = block->aimed.beam_count;
            if (block->settled == NULL) {
                block->settled = ARENA_NEW(bundle->arena, struct aimed);
                block->settled->beams = ARENA_ARRAY(bundle->arena, count, struct aimed_beam);
            }
            struct aimed_beam *beams = block->settled->beams;
            memcpy(beams, block->aimed.beams, count * sizeof *beams);
            *block->settled = block->aimed;
            block->settled->beams = beams;
            continue;
        }
        block->aimed.at_stop = false; /* nor do derivatives know of any aim */
        memset(block->aimed.by_radius, 0, sizeof block->aimed.by_radius);
        memset(block->aimed.by_place, 0, sizeof block->aimed.by_place);
    }
    bundle->is_settled = !holds;
    bundle->is_held = holds;
}

/* All wavelengths anew, and the image plane. */
static bool compile_all(struct merit_bundle *bundle, const struct lens *lens, double image,
                        double stop_radius, struct error *error)
{
    bundle->image = bundle->wish.is_bare ? (double)NAN : image;
    if (!isfinite(bundle->image) && !bundle->wish.is_bare) {
        return fail(error, ERROR_DOMAIN, "the image is infinitely far away");
    }
    arena_reset(&bundle->within, (struct arena_mark){NULL, 0});
    for (size_t i = 0; i < bundle->wish.wavelength_count; i++) {
        if (!merit_bundle_compile(bundle, i, lens, stop_radius, error)) {
            return false;
        }
    }
    /* more steps than before: a surface that was not moved is */
    for (size_t i = 0; i < bundle->wish.wavelength_count; i++) {
        const struct system *system = &bundle->lights[i].system;
        const size_t steps = system->begin[system->places];
        if (steps > bundle->steps) {
            bundle->steps = steps;
            aimed_work_open(system, bundle->arena, &bundle->work);
        }
    }
    return true;
}

static bool aim_block(struct merit_bundle *bundle, struct bundle_block *block, struct error *error)
{
    const struct system *system = &bundle->lights[block->light].system;
    if (bundle->is_held) {
        block->aimed.system = system;
        return true;
    }
    if (bundle->is_settled) {
        /* but for the beams themselves: of image heights they are those of the lens as it is now */
        struct aimed_beam *beams = block->aimed.beams;
        for (size_t g = 0; g < block->aimed.beam_count; g++) {
            beams[g].near = block->settled->beams[g].near;
        }
        block->aimed = *block->settled;
        block->aimed.beams = beams;
    }
    return block->aimed.at_stop ? aimed_at_stop(&block->aimed, system, &bundle->within, error)
                                : aimed_at_entrance(&block->aimed, system, &bundle->first, error);
}

/* Where a ray is lost that has to arrive. */
static void merit_bundle_limit(const struct merit_bundle *bundle, const struct bundle_lane *lane,
                               size_t surface, bool is_of_aim)
{
    if (bundle->wish.limit != NULL) {
        *bundle->wish.limit = (struct merit_limit){.is_known = true,
                                                   .is_of_aim = is_of_aim,
                                                   .count = bundle->wish.limit->count + is_of_aim,
                                                   .place = bundle->wish.place,
                                                   .field = &bundle->wish.fields[lane->field].point,
                                                   .surface = surface};
    }
}

bool merit_bundle_aim(struct merit_bundle *bundle, const struct lens *lens,
                      const struct dual_first *first, struct error *error)
{
    double stop_radius = bundle->lights[0].system.stop_radius;
    double image = lens->surfaces[lens->surface_count - 1].thickness.value.hi;
    if (first != NULL) {
        const struct first_order *start = &bundle->wish.setup->first;
        bundle->first =
            (struct first_order){.is_telecentric = start->is_telecentric,
                                 .is_afocal = first->power.value == 0,
                                 .index_object = first->index_object.value,
                                 .power = first->power.value,
                                 .magnification = first->magnification.value,
                                 .entrance_pupil = first->entrance_pupil.value,
                                 .entrance_diameter = 2 * fabs(first->entrance_radius.value),
                                 .marginal_v = first->marginal_v.value};
        bundle->first.matrix.c.hi = -first->power.value;
        if (bundle->has_disc) {
            bundle->first.entrance_pupil = 0;
        }
        for (size_t i = 0; i < bundle->wish.field_count; i++) {
            bundle->beams[i].n = fabs(first->index_object.value); /* as it is now */
        }
        stop_radius = fabs(first->stop_radius.value);
        image = bundle->image_moves ? first->image.value : image;
    }
    if (!compile_all(bundle, lens, image, stop_radius, error) ||
        (!bundle->is_held && !move_beams(bundle, error))) {
        return false;
    }
    const bool is_first = !bundle->is_settled && !bundle->is_held;
    for (size_t k = 0; k < bundle->block_count; k++) {
        struct bundle_block *block = &bundle->blocks[k];
        block->is_lost = !aim_block(bundle, block, error);
        if (block->is_lost && block->aimed.at_stop) {
            const struct aimed_beam *beam = &block->aimed.beams[block->aimed.lost_beam];
            merit_bundle_limit(bundle, &block->lanes[beam->first], block->aimed.lost_surface, true);
        }
        if ((block->is_lost && !bundle->wish.is_apart) ||
            (is_first && !merit_bundle_goes_on(bundle, (size_t)block->aimed.lanes, error))) {
            return false;
        }
    }
    return true;
}

bool merit_bundle_trace(struct merit_bundle *bundle, size_t block, bool derives,
                        struct ray_block *end, struct error *error)
{
    bundle->blocks[block].aimed.keeps = bundle->keeps;
    aimed_trace(&bundle->blocks[block].aimed, derives, end);
    for (int i = 0; i < bundle->blocks[block].aimed.count; i++) {
        if (end->lost[i] != 0) {
            merit_bundle_limit(bundle, &bundle->blocks[block].lanes[i],
                               ray_block_surface(end, (size_t)i), false);
            return fail(error, ERROR_DOMAIN, "a ray of field %zu is lost at surface %zu (%s)",
                        bundle->blocks[block].lanes[i].field + 1, ray_block_surface(end, (size_t)i),
                        ray_status_name(ray_block_status(end, (size_t)i)));
        }
    }
    if (bundle->blocks[block].is_deformed) {
        bent_move(bundle->blocks[block].deformed, bundle->wish.irregularity_amounts,
                  bundle->wish.irregularity_count, bundle->blocks[block].aimed.lanes,
                  bundle->wish.path, end);
    }
    return true;
}

void merit_bundle_graze(struct merit_bundle *bundle, size_t block, double limit, bool derives,
                        struct grazing_penalty *grazing)
{
    grazing_find(&bundle->blocks[block].aimed, limit, derives, &bundle->within, grazing);
}

void merit_bundle_start(const struct merit_bundle *bundle, size_t group, size_t point,
                        double place[2])
{
    for (size_t k = 0; k < bundle->block_count; k++) {
        const struct bundle_block *block = &bundle->blocks[k];
        for (int i = 0; i < block->aimed.count; i++) {
            const struct bundle_lane *lane = &block->lanes[i];
            if (lane->group == group && lane->point == point) {
                const struct ray ray =
                    beam_ray(&bundle->beams[lane->field], block->aimed.a[i], block->aimed.b[i]);
                place[0] = ray.point[0] - ray.point[2] * ray.cosine[0] / ray.cosine[2];
                place[1] = ray.point[1] - ray.point[2] * ray.cosine[1] / ray.cosine[2];
            }
        }
    }
}
