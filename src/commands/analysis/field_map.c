/* commands/analysis/field_map.c - what an analysis finds of a field, over the image format. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/field_map.h"

#include "analysis/rays/field_curvature.h"
#include "commands/analysis/analysis_map.h"
#include "draw/field_bars.h"
#include "draw/ticks.h"

#include <string.h>

/* Points along a radius at first, at most, and across a lens that is not round. */
enum { RADII_FIRST = 9, RADII_MOST = 257, ACROSS = 25, MAPS_MOST = 24 };
/* Pixels of a map; bars of a drawing, across. */
enum { PIXELS = 256, BARS = 13 };

/* Points along a radius are enough: of the range of the values. */
static const double fine = 0.005;

const struct file_type *field_map_types(size_t i)
{
    const struct file_type *const types[] = {drawing_types(0), map_types(1), NULL};
    return types[i];
}

/* One lens in one case. */
struct field_map {
    struct analysis_cursor at;       /* its case */
    const char *words, *more, *name; /* of its figure; of the kind alone, and with its case */
    double reach;   /* how far out its fields are, mm; of an image at infinity rad */
    double half[2]; /* of the format */
    bool is_disc;   /* within the reach, else a rectangle */
    bool is_round, is_far;
    size_t across[2]; /* points: along the radius and 1; or in x and y */
    double *values;   /* FIELD_MAP_VALUES each; NaN: no ray arrives */
    size_t tried, lost;
    double dark; /* of a round one: where the first point without rays is; infinite */
};

struct field_maps {
    const struct field_map_kind *kind;
    struct arena *arena;
    struct field_map *list;
    size_t count;
};

/* -------- which maps there are -------- */

/* How far out the chief rays of a case arrive, mm, or the angle of its fields. */
static double field_map_reach(const struct analysis_case *one)
{
    const struct setup *setup = one->setup;
    double reach = 0;
    for (size_t i = 0; i < setup->field_count; i++) {
        const struct field_point *point = &setup->fields[i].point;
        struct field_curvature found;
        struct error none;
        if (isnan(setup->image)) {
            reach = fmax(reach, field_extent(point->kind, point->value));
        } else if (field_curvature(setup, 0, point, &found, &none)) {
            reach = fmax(reach, hypot(found.height[0], found.height[1]));
        }
    }
    return reach;
}

static bool field_maps_add(struct field_maps *maps, const struct analysis_cursor *at,
                           struct error *error)
{
    const struct analysis_case *one = at->one;
    /* foci of narrow beams are the same at any f-number */
    const unsigned parts =
        maps->kind->is_bars ? FIGURE_ALL & ~(unsigned)FIGURE_APERTURE : FIGURE_ALL;
    const char *words = analysis_figure_words(one, parts, maps->arena);
    const char *more = maps->kind->words != NULL ? maps->kind->words(at->input, maps->arena) : NULL;
    const char *name = analysis_case_words(one, maps->arena);
    if (more != NULL) {
        name = name != NULL ? ARENA_JOIN(maps->arena, more, ", ", name) : more;
    }
    struct field_map *map = NULL;
    for (size_t i = 0; i < maps->count; i++) {
        const struct field_map *other = &maps->list[i];
        const bool same = strcmp(other->words, words) == 0 && other->at.one->clip == one->clip &&
                          strcmp(other->at.one->setup->lens->title, one->setup->lens->title) == 0 &&
                          (name == NULL || strcmp(other->name, name) == 0);
        map = same ? &maps->list[i] : map;
    }
    if (map == NULL && maps->count == MAPS_MOST) {
        return fail(error, ERROR_USAGE, "{--over-field} has room for %d maps, not for more",
                    MAPS_MOST);
    }
    if (map == NULL) {
        map = &maps->list[maps->count++];
        *map = (struct field_map){.at = *at,
                                  .words = words,
                                  .more = more,
                                  .name = name,
                                  .is_round = lens_is_round(one->setup->lens),
                                  .is_far = isnan(one->setup->image),
                                  .dark = INFINITY};
    }
    map->reach = fmax(map->reach, field_map_reach(one));
    return true;
}

/* The format that is mapped. */
static bool field_map_frame(struct field_map *map, const struct field_map_kind *kind,
                            struct error *error)
{
    const struct sensor *sensor = &map->at.question->format.size;
    if (map->is_far && kind->angular == NULL) {
        return fail(error, ERROR_DOMAIN,
                    "{--over-field}: the image is infinitely far away, there is no plane");
    }
    if (!isnan(sensor->width)) {
        if (map->is_far) {
            return fail(error, ERROR_USAGE,
                        "{--sensor}: the image is infinitely far away, no format catches it");
        }
        map->half[0] = sensor->width / 2;
        map->half[1] = sensor->height / 2;
        map->reach = hypot(map->half[0], map->half[1]);
        return true;
    }
    map->is_disc = true;
    map->half[0] = map->half[1] = map->reach;
    if (!(map->reach > 0)) {
        fail(error, ERROR_DOMAIN,
             "{--over-field}: no field off the axis tells how large the image "
             "is");
        return error_hint(error, "give the format with {--sensor}, or the largest {--field}");
    }
    return true;
}

/* -------- the points -------- */

/* The field whose image lies at x, y. */
static struct field_point field_map_point(const struct field_map *map, double x, double y)
{
    struct field_point point = {map->is_far ? FIELD_ANGLE : FIELD_REAL, {x, y}};
    if (map->is_far && fabs(x) > 0 && fabs(y) > 0) {
        const double angle = hypot(x, y), slope = tan(angle) / angle;
        point.value[0] = atan(slope * x);
        point.value[1] = atan(slope * y);
    }
    return point;
}

/* What is found at points of the format, in order; NaN where no ray arrives. */
static bool field_map_find(struct field_map *map, const struct field_map_kind *kind,
                           const double (*points)[2], size_t count, double *values,
                           struct error *error)
{
    struct arena *arena = map->at.run->arena;
    struct analysis_case *one = ARENA_NEW(arena, struct analysis_case);
    struct setup *setup = ARENA_NEW(arena, struct setup);
    struct setup_field *fields = ARENA_ARRAY(arena, count + 1, struct setup_field);
    struct analysis_cursor at = map->at;
    *one = *map->at.one;
    *setup = *one->setup;
    for (size_t i = 0; i < count; i++) {
        fields[i] = setup->fields[0];
        fields[i].point = field_map_point(map, points[i][0], points[i][1]);
    }
    setup->fields = fields;
    setup->field_count = count;
    one->setup = setup;
    at.one = one;
    at.next_field = 0;
    at.find = kind->find;
    at.found_size = FIELD_MAP_VALUES * sizeof(double);
    at.keeps_lost = true;
    while (analysis_next_field(&at, error)) {
        double *here = values + FIELD_MAP_VALUES * at.field;
        const double *point = points[at.field];
        memcpy(here, at.found, FIELD_MAP_VALUES * sizeof *here);
        map->tried++;
        for (size_t k = 0; at.lost != NULL && k < FIELD_MAP_VALUES; k++) {
            here[k] = NAN;
        }
        if (at.lost != NULL) {
            map->lost++;
            map->dark = fmin(map->dark, hypot(point[0], point[1]));
        }
    }
    return error->code == ERROR_NONE;
}

/*
 * Values at even steps, even about the first, between them: by the cubic through four, by a line
 * where one of those is missing.
 */
static double field_map_between(const double *values, size_t count, double at)
{
    const size_t last = count - 1, i = (size_t)fmin(fmax(at, 0), (double)last - 1);
    const double near = values[FIELD_MAP_VALUES * i], next = values[FIELD_MAP_VALUES * (i + 1)];
    const size_t start = i + 2 > last ? last - 3 : i - 1; /* of the first interval: -1 */
    double four[4], sum = 0;
    for (size_t k = 0; k < 4; k++) {
        const size_t place = i == 0 && k == 0 ? 1 : start + k;
        four[k] = values[FIELD_MAP_VALUES * place];
    }
    const double t = at - (i == 0 ? -1 : (double)start);
    static const double weights[4] = {-1.0 / 6, 1.0 / 2, -1.0 / 2, 1.0 / 6};
    for (size_t k = 0; k < 4; k++) {
        double weight = weights[k];
        for (size_t j = 0; j < 4; j++) {
            weight *= j != k ? t - (double)j : 1;
        }
        sum += weight * four[k];
    }
    return isfinite(sum) ? sum : near + (at - (double)i) * (next - near);
}

/* By how much of their range do new values between others miss what these said? */
static double field_map_missed(const double *values, const double *between, size_t count)
{
    double missed = 0;
    for (size_t k = 0; k < FIELD_MAP_TURN; k++) {
        double low = INFINITY, high = -INFINITY, most = 0;
        for (size_t i = 0; i < count; i++) {
            low = fmin(low, values[FIELD_MAP_VALUES * i + k]);
            high = fmax(high, values[FIELD_MAP_VALUES * i + k]);
        }
        for (size_t i = 0; i + 1 < count; i++) {
            const double said = field_map_between(values + k, count, (double)i + 0.5);
            const double off = fabs(said - between[FIELD_MAP_VALUES * i + k]);
            most = isfinite(off) ? fmax(most, off) : most;
        }
        missed = high > low ? fmax(missed, most / (high - low)) : missed;
    }
    return missed;
}

/* Along the radius of a round lens, ever finer. */
static bool field_map_sample_radius(struct field_map *map, const struct field_map_kind *kind,
                                    struct error *error)
{
    struct arena *arena = map->at.run->arena;
    double(*points)[2] = arena_array(arena, RADII_MOST, sizeof *points);
    double *values = ARENA_ARRAY(arena, FIELD_MAP_VALUES * RADII_MOST, double);
    double *between = ARENA_ARRAY(arena, FIELD_MAP_VALUES * RADII_MOST, double);
    double *both = ARENA_ARRAY(arena, FIELD_MAP_VALUES * RADII_MOST, double), missed = 1;
    size_t count = RADII_FIRST;
    for (size_t i = 0; i < count; i++) {
        points[i][0] = 0;
        points[i][1] = map->reach * (double)i / (double)(count - 1);
    }
    if (!field_map_find(map, kind, (const double(*)[2])points, count, values, error)) {
        return false;
    }
    while (count < RADII_MOST && missed > fine) {
        for (size_t i = 0; i + 1 < count; i++) {
            points[i][1] = map->reach * ((double)i + 0.5) / (double)(count - 1);
        }
        if (!field_map_find(map, kind, (const double(*)[2])points, count - 1, between, error)) {
            return false;
        }
        missed = field_map_missed(values, between, count);
        for (size_t i = 0; i < 2 * count - 1; i++) {
            memcpy(both + FIELD_MAP_VALUES * i,
                   (i % 2 == 0 ? values : between) + FIELD_MAP_VALUES * (i / 2),
                   FIELD_MAP_VALUES * sizeof *both);
        }
        count = 2 * count - 1;
        memcpy(values, both, FIELD_MAP_VALUES * count * sizeof *values);
    }
    map->across[0] = count;
    map->across[1] = 1;
    map->values = values;
    return true;
}

/* Over the whole format, and a step beyond a disc: the edge lies between points. */
static bool field_map_sample_grid(struct field_map *map, const struct field_map_kind *kind,
                                  struct error *error)
{
    struct arena *arena = map->at.run->arena;
    const double longest = fmax(map->half[0], map->half[1]), step = 2 * longest / (ACROSS - 1);
    for (size_t k = 0; k < 2; k++) {
        map->across[k] = 1 + (size_t)ceil(2 * map->half[k] / step - 1e-9);
    }
    const size_t all = map->across[0] * map->across[1];
    double(*points)[2] = arena_array(arena, all, sizeof *points);
    size_t *places = ARENA_ARRAY(arena, all, size_t), count = 0;
    double *found = ARENA_ARRAY(arena, FIELD_MAP_VALUES * all, double);
    map->values = ARENA_ARRAY(arena, FIELD_MAP_VALUES * all, double);
    for (size_t i = 0; i < all; i++) {
        const size_t at[2] = {i % map->across[0], i / map->across[0]};
        double *point = points[count];
        for (size_t k = 0; k < 2; k++) {
            const double last = (double)map->across[k] - 1;
            point[k] = map->half[k] * (2 * (double)at[k] - last) / last;
        }
        places[count] = i;
        count += !map->is_disc || hypot(point[0], point[1]) < map->reach + 1.01 * step;
        for (size_t k = 0; k < FIELD_MAP_VALUES; k++) {
            map->values[FIELD_MAP_VALUES * i + k] = NAN;
        }
    }
    if (!field_map_find(map, kind, (const double(*)[2])points, count, found, error)) {
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        memcpy(map->values + FIELD_MAP_VALUES * places[i], found + FIELD_MAP_VALUES * i,
               FIELD_MAP_VALUES * sizeof *found);
    }
    return true;
}

/* A value of a map at a place; NaN: outside, or no ray arrives. */
static double field_map_at(const struct field_map *map, size_t value, double x, double y)
{
    const double radius = hypot(x, y), slack = 1 + 1e-9;
    if (map->is_disc ? radius > slack * map->reach
                     : fabs(x) > slack * map->half[0] || fabs(y) > slack * map->half[1]) {
        return NAN;
    }
    if (map->is_round) {
        const double at = radius / map->reach * (double)(map->across[0] - 1);
        return field_map_between(map->values + value, map->across[0], at);
    }
    double at[2], sum = 0, weights = 0;
    size_t low[2];
    for (size_t k = 0; k < 2; k++) {
        const double last = (double)map->across[k] - 1;
        at[k] = fmin(fmax(((k == 0 ? x : y) / map->half[k] + 1) / 2 * last, 0), last);
        low[k] = (size_t)fmin(floor(at[k]), last - 1);
        at[k] -= (double)low[k];
    }
    for (size_t i = 0; i < 4; i++) {
        const size_t place = (low[1] + i / 2) * map->across[0] + low[0] + i % 2;
        const double weight = fabs((double)(1 - i % 2) - at[0]) * fabs((double)(1 - i / 2) - at[1]);
        const double here = map->values[FIELD_MAP_VALUES * place + value];
        sum += isfinite(here) ? weight * here : 0;
        weights += isfinite(here) ? weight : 0;
    }
    return weights > 0.5 ? sum / weights : (double)NAN;
}

/* -------- the drawing -------- */

/* Where there is no light. */
static const char *field_map_note(const struct field_map *map, struct arena *arena)
{
    const double unit = map->is_far ? DEGREES_PER_RADIAN : 1;
    if (map->lost == 0) {
        return NULL;
    }
    if (map->is_round) {
        return ARENA_JOIN(arena, "blank: no ray arrives from ",
                          analysis_number(unit * map->dark, arena),
                          map->is_far ? "\xc2\xb0 on" : " mm on");
    }
    return arena_printf(arena, "blank: no ray arrives at %zu of %zu points", map->lost, map->tried);
}

/* One value of a map as pixels. */
static bool field_map_add_raster(const struct field_map *map, const struct field_map_kind *kind,
                                 size_t value, bool alone, struct map_page *page,
                                 struct error *error)
{
    static const char *const sections[] = {"tangential", "sagittal"};
    enum { LINES = 6 };
    struct arena *arena = page->job->run->arena;
    const double half = fmax(map->half[0], map->half[1]);
    double *pixels = ARENA_ARRAY(arena, PIXELS * PIXELS, double), low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < PIXELS * PIXELS; i++) {
        const double x = half * ((2 * (double)(i % PIXELS) + 1) / PIXELS - 1);
        const double y = half * ((2 * (double)(i / PIXELS) + 1) / PIXELS - 1);
        pixels[i] = field_map_at(map, value, x, y);
        low = fmin(low, pixels[i]);
        high = fmax(high, pixels[i]);
    }
    const char *section = kind->values > 1 ? sections[value] : NULL;
    const char *title = alone ? map->more : map->name; /* below the title its case is told */
    if (section != NULL) {
        title = title != NULL ? ARENA_JOIN(arena, section, ", ", title) : section;
    }
    const double unit = map->is_far ? DEGREES_PER_RADIAN : 1;
    const struct raster_map raster = {.title = title,
                                      .note = field_map_note(map, arena),
                                      .size = PIXELS,
                                      .values = pixels,
                                      .half = unit * half,
                                      .step =
                                          high > low ? ticks_round_below((high - low) / LINES) : 0};
    return map_page_add(page, map->at.one, &raster, map->words, error);
}

/* The bars of a map, at places of a grid. */
static struct field_bars_panel field_map_bars(const struct field_map *map, bool alone, bool several,
                                              struct arena *arena)
{
    struct field_bar *bars = ARENA_ARRAY(arena, BARS * BARS, struct field_bar);
    const double half = fmax(map->half[0], map->half[1]);
    size_t count = 0;
    for (size_t i = 0; i < BARS * BARS; i++) {
        /* none lies on the axes' ends alone: places in the middle of cells */
        const double x = half * ((2 * (double)(i % BARS) + 1) / BARS - 1);
        const double y = half * ((2 * (double)(i / BARS) + 1) / BARS - 1);
        const double turn = map->is_round ? 0 : field_map_at(map, FIELD_MAP_TURN, x, y);
        const double radius = hypot(x, y);
        const struct field_bar bar = {.at = {x, y},
                                      /* on the axis the tangential section is that of y and z */
                                      .direction =
                                          (radius > 0.01 * half ? atan2(y, x) : PI / 2) + turn,
                                      .tangential = field_map_at(map, FIELD_MAP_TANGENTIAL, x, y),
                                      .sagittal = field_map_at(map, FIELD_MAP_SAGITTAL, x, y)};
        bars[count] = bar;
        count += isfinite(bar.tangential + bar.sagittal) ? 1 : 0;
    }
    const char *title = alone ? NULL : map->name;
    if (several) {
        const char *lens = map->at.one->setup->lens->title;
        title = title != NULL ? ARENA_JOIN(arena, lens, ", ", title) : lens;
    }
    return (struct field_bars_panel){.title = title,
                                     .note = field_map_note(map, arena),
                                     .bars = bars,
                                     .count = count,
                                     .half = {map->half[0], map->half[1]},
                                     .spacing = 2 * half / BARS,
                                     .is_disc = map->is_disc};
}

static bool field_maps_draw_bars(const struct field_maps *maps, const struct artifact_job *job,
                                 struct output *sink, struct error *error)
{
    struct arena *arena = maps->arena;
    struct field_bars_panel *panels = ARENA_ARRAY(arena, maps->count, struct field_bars_panel);
    const struct analysis_case *first = maps->list[0].at.one;
    bool one_lens = true, one_case = true;
    for (size_t i = 1; i < maps->count; i++) {
        const struct field_map *map = &maps->list[i];
        one_lens =
            one_lens && strcmp(map->at.one->setup->lens->title, first->setup->lens->title) == 0;
        one_case = one_case && strcmp(map->words, maps->list[0].words) == 0;
    }
    for (size_t i = 0; i < maps->count; i++) {
        panels[i] = field_map_bars(&maps->list[i], maps->count == 1, !one_lens, arena);
    }
    const struct field_bars page = {
        .title = one_lens
                     ? arena_printf(arena, "%s of %s", maps->kind->what, first->setup->lens->title)
                     : maps->kind->what,
        .subtitle = one_case ? maps->list[0].words : "",
        .panels = panels,
        .count = maps->count};
    struct svg svg = {.arena = arena};
    return field_bars_draw(&page, &svg, error) && drawing_write(job, &svg, sink, error);
}

static bool field_maps_draw(const struct field_maps *maps, const struct artifact_job *job,
                            struct output *sink, struct error *error)
{
    const struct field_map *first = &maps->list[0];
    struct map_page page = {
        .job = job,
        .rasters = {.x_label = first->is_far ? "field x (\xc2\xb0)" : "x in the image (mm)",
                    .y_label = first->is_far ? "field y (\xc2\xb0)" : "y in the image (mm)",
                    .scale_label = first->is_far ? maps->kind->angular : maps->kind->scale,
                    .colours = RASTER_LIGHT,
                    .highest = maps->kind->highest,
                    .columns = maps->kind->values == 2 ? 2 : 3}};
    if (maps->count > 1 && !map_is_drawing(job)) {
        return fail(error, ERROR_USAGE,
                    "{--over-field}: numbers are those of one map, and this makes %zu: they can "
                    "be drawn",
                    maps->count);
    }
    for (size_t i = 0; i < maps->count; i++) {
        for (size_t k = 0; k < maps->kind->values; k++) {
            if (!field_map_add_raster(&maps->list[i], maps->kind, k, maps->count == 1, &page,
                                      error)) {
                return false;
            }
        }
    }
    return map_page_make(&page, maps->kind->what, sink, error);
}

/* Fill a map; one without any light is an error. */
static bool field_map_fill(struct field_map *map, const struct field_map_kind *kind,
                           struct error *error)
{
    if (!field_map_frame(map, kind, error) ||
        !(map->is_round ? field_map_sample_radius(map, kind, error)
                        : field_map_sample_grid(map, kind, error))) {
        return false;
    }
    if (map->lost == map->tried) {
        *error = map->at.run->shortfall;
        return false;
    }
    return true;
}

bool field_map_make(const struct artifact_job *job, const struct field_map_kind *kind,
                    struct output *sink, struct error *error)
{
    struct arena *arena = job->run->arena;
    struct field_maps maps = {
        .kind = kind, .arena = arena, .list = ARENA_ARRAY(arena, MAPS_MOST, struct field_map)};
    for (size_t i = 0; i < job->count; i++) {
        struct analysis_cursor at = analysis_begin(job->inputs[i], kind->policy, job->run);
        while (analysis_next_case(&at, error)) {
            if (!field_maps_add(&maps, &at, error)) {
                return false;
            }
        }
        if (error->code != ERROR_NONE) {
            return false;
        }
    }
    for (size_t i = 0; i < maps.count; i++) {
        if (!field_map_fill(&maps.list[i], kind, error)) {
            return false;
        }
    }
    return kind->is_bars ? field_maps_draw_bars(&maps, job, sink, error)
                         : field_maps_draw(&maps, job, sink, error);
}
