/* commands/lens/surface_footprints.c - beams on each surface of a lens, as rows and drawn. */
/* SPDX-License-Identifier: MIT */
#include "commands/lens/surface_footprints.h"

#include "analysis/rays/footprint.h"
#include "commands/tables.h"
#include "draw/panels.h"
#include "report/row.h"

#include <string.h>

static const struct lens_policy policy = {
    .wavelengths = WAVELENGTHS_PRIMARY, .fields = FIELDS_ALL, .telecentric = true};

#define ROW struct footprint_row

struct footprint_row {
    long surface;
    const char *position, *warning, *lens;
    double wavelength, field, field_x, height, height_x; /* um; rad; mm */
    struct footprint at;
    double semi_diameter, filled;
};

#define MM(member, more)    LENGTH(member, "mm"), .flags = (more)
#define PLAIN(member, more) SHOWN(member), .flags = (more)

static const struct column columns[] = {
    LENS_POSITION_COLUMN(ROW, position, COLUMN_BRIEF),
    {ANGLE(field), .name = "field", .flags = COLUMN_ECHO | COLUMN_BRIEF | COLUMN_SPARSE,
     .help = "field angle; absent for a height"},
    {MM(height, COLUMN_ECHO | COLUMN_BRIEF | COLUMN_SPARSE), .name = "height",
     .label = "field height",
     .help = "height of the field, at the object or at the image as the lens has it"},
    {ANGLE(field_x), .name = "field_x", .with = "field-x", .flags = COLUMN_BRIEF | COLUMN_EXTRA,
     .label = "field x", .help = "that in the x-z plane"},
    {MM(height_x, COLUMN_HIDDEN), .name = "height_x", .label = "field height x",
     .help = "of a height the same in x"},
    {COLUMN_OF_WAVELENGTH(ROW, wavelength), .name = "wavelength",
     .flags = COLUMN_ECHO | COLUMN_BRIEF, .help = "wavelength"},
    {PLAIN(surface, COLUMN_BRIEF), .name = "surface", .head = "surf",
     .help = "number of the surface, from 1, the stop counted"},
    {MM(at.low[0], COLUMN_BRIEF), .name = "x_low", .label = "x from",
     .help = "least x of the beam on the surface, in its frame"},
    {MM(at.high[0], COLUMN_BRIEF), .name = "x_high", .label = "x to", .help = "largest x"},
    {MM(at.low[1], COLUMN_BRIEF), .name = "y_low", .label = "y from", .help = "least y"},
    {MM(at.high[1], COLUMN_BRIEF), .name = "y_high", .label = "y to", .help = "largest y"},
    {MM(at.radius, COLUMN_BRIEF), .name = "beam_radius", .label = "largest radius",
     .head = "radius", .help = "largest distance of a ray from the vertex"},
    {MM(semi_diameter, COLUMN_BRIEF | COLUMN_SPARSE), .name = "semi_diameter", .head = "semi-diam",
     .help = "clear semi-diameter of the surface; absent where none is stated"},
    {PLAIN(filled, COLUMN_BRIEF | COLUMN_SPARSE), .name = "filled", .dimension = &dimension_ratio,
     .unit = "percent", .help = "largest radius over that"},
    LENS_TITLE_COLUMN(ROW, lens),
    LENS_WARNING_COLUMN(ROW, warning),
};

const struct sheet footprint_sheet = SHEET(columns, struct footprint_row);

/* The footprints of one field. */
static bool footprints_of(const struct lens_case *one, const struct surfaces_input *input,
                          size_t field, struct arena *arena, struct footprint *list,
                          struct error *error)
{
    /* only the lens counts, no image plane */
    struct setup *setup = ARENA_NEW(arena, struct setup);
    *setup = *one->setup;
    setup->image = NAN;
    const struct bundle_question bundle = {.setup = setup,
                                           .field = &setup->fields[field].point,
                                           .wavelength = one->index,
                                           .clip = !input->no_clip};
    return footprints_find(&bundle, arena, list, error);
}

static struct footprint_row footprint_row_begin(const struct lens_case *one, size_t field)
{
    struct footprint_row row;
    row_clear(&footprint_sheet, &row);
    const struct field_point *point = &one->setup->fields[field].point;
    const bool angle = point->kind == FIELD_ANGLE || point->kind == FIELD_NONE;
    row.position = one->setup->position;
    row.lens = one->setup->lens->title;
    row.warning = one->warning;
    row.wavelength = one->light.wavelength;
    row.field = angle ? point->value[1] : (double)NAN;
    row.field_x = angle ? point->value[0] : (double)NAN;
    row.height = angle ? (double)NAN : point->value[1];
    row.height_x = angle ? (double)NAN : point->value[0];
    return row;
}

bool footprint_rows(const struct surfaces_input *input, struct run *run, struct error *error)
{
    struct lens_cursor at = lens_begin(&input->question, &policy, run->arena);
    while (lens_next(&at, error)) {
        const struct lens *lens = at.one.setup->lens;
        struct footprint *list = ARENA_ARRAY(run->arena, lens->surface_count, struct footprint);
        for (size_t f = 0; f < at.one.setup->field_count; f++) {
            struct footprint_row row = footprint_row_begin(&at.one, f);
            if (!footprints_of(&at.one, input, f, run->arena, list, error)) {
                error_prefix(error,
                             "%s: ", lens_field_words(&at.one.setup->fields[f].point, run->arena));
                if (at.one.setup->field_count == 1) {
                    return false;
                }
                run->shortfall = *error;
                row.warning = arena_printf(run->arena, "%s", error->message);
                error->code = ERROR_NONE;
                if (!run_emit(run, &row)) {
                    return true;
                }
                continue;
            }
            for (size_t i = 0; i < lens->surface_count; i++) {
                const struct surface *surface = &lens->surfaces[i];
                row.surface = (long)i + 1;
                row.at = list[i];
                row.semi_diameter =
                    surface->has_diameter ? surface->diameter.value.hi / 2 : (double)NAN;
                row.filled = list[i].radius / row.semi_diameter;
                if (!run_emit(run, &row)) {
                    return true;
                }
            }
        }
    }
    return error->code == ERROR_NONE;
}

/* -------- the drawing -------- */

enum { FIELDS_MOST = 7 };

/* A page of panels, one a surface, lens by lens. */
struct footprint_page {
    struct arena *arena;
    struct panel *panels;
    size_t count, room;
    const char *keys[FIELDS_MOST];
    size_t key_count, many; /* many: panels of the first lens */
    const char *title, *wavelength;
    bool several;
};

/* Which look a field has: that of the same words before. */
static bool footprint_key(struct footprint_page *page, const char *words, size_t *key,
                          struct error *error)
{
    for (*key = 0; *key < page->key_count; (*key)++) {
        if (strcmp(page->keys[*key], words) == 0) {
            return true;
        }
    }
    if (page->key_count == FIELDS_MOST) {
        return fail(error, ERROR_USAGE, "{--plot} has room for %d fields, not for more",
                    FIELDS_MOST);
    }
    page->keys[page->key_count++] = words;
    return true;
}

/* The panels of a lens: those it has, of another field, or new ones. */
static struct panel *footprint_panels(struct footprint_page *page, const struct lens_case *one,
                                      bool is_new)
{
    const struct lens *lens = one->setup->lens;
    if (!is_new) {
        return page->panels + page->count - lens->surface_count;
    }
    for (size_t i = 0; i < lens->surface_count; i++) {
        const struct surface *surface = &lens->surfaces[i];
        page->panels =
            arena_grow(page->arena, page->panels, page->count, &page->room, sizeof *page->panels);
        const char *name =
            arena_printf(page->arena, i == lens->stop ? "stop (%zu)" : "surface %zu", i + 1);
        page->panels[page->count++] = (struct panel){
            .title = one->setup->position != NULL
                         ? arena_printf(page->arena, "%s, %s", one->setup->position, name)
                         : name,
            .series = ARENA_ARRAY(page->arena, FIELDS_MOST, struct panel_series),
            .circle = surface->has_diameter ? surface->diameter.value.hi / 2 : 0};
    }
    return page->panels + page->count - lens->surface_count;
}

/* Add the outlines of a field to the panels of its lens. */
static void footprint_add(struct footprint_page *page, struct panel *panels, size_t surfaces,
                          const struct footprint *list, size_t key)
{
    for (size_t i = 0; i < surfaces; i++) {
        const size_t count = list[i].count;
        double *x = ARENA_ARRAY(page->arena, count + 1, double);
        double *y = ARENA_ARRAY(page->arena, count + 1, double);
        for (size_t k = 0; k <= count; k++) {
            x[k] = list[i].outline[k % count][0];
            y[k] = list[i].outline[k % count][1];
        }
        struct panel_series *series = ARENA_ARRAY(page->arena, FIELDS_MOST, struct panel_series);
        memcpy(series, panels[i].series, panels[i].count * sizeof *series);
        series[panels[i].count++] =
            (struct panel_series){.x = x, .y = y, .count = count + 1, .key = key};
        panels[i].series = series;
    }
}

static bool footprint_add_lens(struct footprint_page *page, const struct lens_case *one,
                               const struct surfaces_input *input, struct error *error)
{
    const struct setup *setup = one->setup;
    struct footprint *list = ARENA_ARRAY(page->arena, setup->lens->surface_count, struct footprint);
    const bool same = page->title != NULL && strcmp(page->title, setup->lens->title) == 0;
    struct panel *panels = footprint_panels(page, one, !same || setup->position != NULL);
    page->several = page->several || (page->title != NULL && !same);
    page->title = setup->lens->title;
    page->wavelength = arena_printf(page->arena, "%.6g nm", 1000 * one->light.wavelength);
    for (size_t f = 0; f < setup->field_count; f++) {
        const char *words = lens_field_words(&setup->fields[f].point, page->arena);
        struct error dark;
        size_t key;
        if (!footprint_key(page, words, &key, error)) {
            return false;
        }
        if (footprints_of(one, input, f, page->arena, list, &dark)) {
            footprint_add(page, panels, setup->lens->surface_count, list, key);
        }
    }
    return true;
}

bool footprint_figure(const struct artifact_job *job, struct output *sink, struct error *error)
{
    struct svg svg = {.arena = job->run->arena};
    struct footprint_page page = {.arena = svg.arena};
    for (size_t i = 0; i < job->count; i++) {
        const struct surfaces_input *input = job->inputs[i];
        struct lens_cursor at = lens_begin(&input->question, &policy, svg.arena);
        while (lens_next(&at, error)) {
            if (!footprint_add_lens(&page, &at.one, input, error)) {
                return false;
            }
        }
        if (error->code != ERROR_NONE) {
            return false;
        }
    }
    for (size_t i = 0; i < page.count; i++) {
        page.panels[i].note = page.panels[i].count > 0 ? NULL : "no ray arrives";
    }
    const struct panels panels = {
        .title = page.several ? "Footprints" : ARENA_JOIN(svg.arena, "Footprints of ", page.title),
        .subtitle = page.wavelength,
        .unit = "mm",
        .keys = page.keys,
        .key_count = page.key_count,
        .circle_label = "clear aperture",
        .columns = 4,
        .panels = page.panels,
        .count = page.count};
    return panels_draw(&panels, &svg, error) && drawing_write(job, &svg, sink, error);
}
