/* commands/lens/cmd_draw.c - lenscalc draw: cross-section of a lens as SVG. */
/* SPDX-License-Identifier: MIT */
#include "commands/lens/draw_elements.h"
#include "commands/lens/lens_options.h"
#include "commands/tables.h"
#include "draw/section.h"

struct draw_input {
    struct lens_question question;
    bool planes, construction, no_rays, list, iso10110;
    long element; /* from 1; NO_INTEGER = not asked for */
};

#define INPUT struct draw_input

static const struct option options[] = {
    LENS_OPTION(INPUT, question),
    LENS_WAVELENGTH_OPTION(INPUT, question, LENS_PRIMARY_WAVELENGTH),
    LENS_FNUMBER_OPTION(INPUT, question),
    LENS_FIELD_OPTIONS(INPUT, question),
    LENS_POSITION_OPTION(INPUT, question),
    LENS_SECTION_OPTION(INPUT, question),
    {ASKED(planes), .name = "planes", .help = "principal planes, focal points and pupils"},
    {ASKED(construction), .name = "construction", .excludes = "field field-x",
     .help = "the three Gauss rays of the equivalent lens in place of the bundles"},
    {ASKED(no_rays), .name = "no-rays", .excludes = "field field-x", .help = "the lens alone"},
    {ASKED(list), .name = "list", .help = "add a table of the elements"},
    {ASKED(element), .name = "element", .wants = "iso10110", .lowest = 1, .highest = 10000,
     .value = "N", .help = "the element to draw by itself, as numbered in the section"},
    {ASKED(iso10110), .name = "iso10110", .wants = "element",
     .excludes = "planes construction no-rays list",
     .help = "a drawing of one element for the shop, in the tabular form of ISO 10110"},
};

static bool draw_check(const struct artifact_job *job, struct error *error)
{
    const struct draw_input *input = job->inputs[0];
    if (input->construction && (input->planes || input->no_rays)) {
        return fail(error, ERROR_USAGE, "{--construction} has planes and rays of its own: no %s",
                    input->planes ? "--planes" : "--no-rays");
    }
    return true;
}

/*
 * How high rays reach in all positions of a lens, of which some surfaces have no diameter: those
 * are the same glass in each of them. Null: there is only one, or nothing is missing.
 */
static const double *draw_heights(const struct draw_input *input, const struct lens_policy *policy,
                                  struct arena *arena)
{
    const struct lens *lens = input->question.lens.lens;
    struct lens_question all = input->question;
    struct error ignored = {0};
    all.position = "all";
    if (lens == NULL || lens->position_count < 2 || layout_states_diameters(lens)) {
        return NULL;
    }
    double *heights = ARENA_ARRAY(arena, lens->surface_count, double);
    for (size_t i = 0; i < lens->surface_count; i++) {
        heights[i] = 0;
    }
    struct lens_cursor at = lens_begin(&all, policy, arena);
    while (lens_next(&at, &ignored)) {
        const struct layout_request request = {.wavelength = at.one.index, .light = &at.one.light};
        layout_ray_heights(at.one.setup, &request, arena, heights);
    }
    return heights;
}

/* The section of one position. */
static bool draw_layout(const struct draw_input *input, const struct lens_case *one,
                        const double *heights, struct layout *layout, struct error *error)
{
    struct arena *arena = one->setup->arena;
    const struct layout_request request = {.wavelength = one->index,
                                           .light = &one->light,
                                           .planes = input->planes,
                                           .construction = input->construction,
                                           .no_rays = input->no_rays,
                                           .heights = heights};
    if ((input->construction || input->planes) && !layout_is_centred(one->setup->lens)) {
        return fail(error, ERROR_DOMAIN,
                    "{--%s} is for centred lenses, and parts of this one are decentred, tilted or "
                    "behind a coordinate break",
                    input->construction ? "construction" : "planes");
    }
    if (!layout_make(one->setup, &request, arena, layout, error)) {
        return false;
    }
    if (one->warning != NULL) {
        layout_note(layout, arena_printf(arena, "warning: %s", one->warning));
    }
    if (one->setup->fields_from != NULL && layout->field_count > 0) {
        layout_note(layout, "the lens states no field: 5° is drawn");
    }
    return true;
}

/* "f = 50.36 mm, f/2.03" */
static const char *draw_caption(const struct lens_case *one)
{
    struct arena *arena = one->setup->arena;
    const struct first_order *first = &one->light.first;
    const char *focal =
        first->is_afocal ? "afocal" : arena_printf(arena, "f = %.5g mm", first->efl);
    return isfinite(first->fnumber) ? arena_printf(arena, "%s, f/%.3g", focal, first->fnumber)
                                    : focal;
}

static bool draw_draw(const struct artifact_job *job, struct output *sink, struct error *error)
{
    const struct draw_input *input = job->inputs[0];
    const struct lens *lens = input->question.lens.lens;
    const struct plane_value focus = {.kind = lens != NULL ? layout_plane(lens) : PLANE_OF_LENS};
    const bool has_fields = lens != NULL && lens->field_count > 0;
    const struct lens_policy policy = {.wavelengths = WAVELENGTHS_PRIMARY,
                                       .fields = has_fields ? FIELDS_ALL : FIELDS_EDGE,
                                       .focus = &focus};
    struct svg svg = {.arena = job->run->arena};
    struct arena *arena = svg.arena;
    struct lens_cursor at = lens_begin(&input->question, &policy, arena);
    const size_t most = lens != NULL && lens->position_count > 0 ? lens->position_count : 1;
    struct section_view *views = ARENA_ARRAY(arena, most, struct section_view);
    struct layout *layouts = ARENA_ARRAY(arena, most, struct layout);
    const double *heights = draw_heights(input, &policy, arena);
    size_t count = 0;
    struct section section = {.views = views, .faint = input->construction};
    while (count < most && lens_next(&at, error)) {
        if (!draw_layout(input, &at.one, heights, &layouts[count], error)) {
            return false;
        }
        const struct setup *setup = at.one.setup;
        const char *caption = draw_caption(&at.one);
        views[count] = (struct section_view){setup->position, caption, &layouts[count]};
        section.title = setup->lens->title;
        section.subtitle = arena_printf(
            arena, "%s%s%s, at %.5g nm", caption, setup->position != NULL ? ", position " : "",
            setup->position != NULL ? setup->position : "", 1000 * at.one.light.wavelength);
        count++;
    }
    if (error->code != ERROR_NONE) {
        return false;
    }
    section.view_count = count;
    if (count > 1) {
        section.subtitle =
            arena_printf(arena, "%zu positions, at %.5g nm", count, 1000 * at.one.light.wavelength);
    }
    if (input->list) {
        section.list = draw_elements_table(&layouts[0]);
    }
    const bool drawn = input->iso10110 ? draw_element_sheet(&layouts[0], input->element,
                                                            section.title, &svg, error)
                                       : section_draw(&section, &svg, error);
    return drawn && drawing_write(job, &svg, sink, error);
}

static const struct artifact artifacts[] = {
    {ARTIFACT_ANSWER(drawing_types), .check = draw_check, .make = draw_draw},
};

static const struct example examples[] = {
    {"draw double-gauss", "the cross-section with its rays (to a file: -o FILE.svg)"},
    {"draw double-gauss --planes", "with principal planes and pupils"},
    {"draw double-gauss --construction", "how the equivalent lens makes an image"},
    {"draw nikkor-z-14-24 --position tele", "a zoom in one of its positions"},
    {"draw nikkor-z-14-24 --position all", "in all of them, one under the other"},
    {"draw double-gauss --list", "with a table of its elements"},
    {"draw double-gauss --element 3 --iso10110", "one of them for the shop"},
    {NULL, NULL},
};

const struct command command_draw = {
    .name = "draw",
    .group = "a lens",
    .summary = "cross-section of a lens as an SVG drawing",
    COMMAND_ASKS(INPUT),
    COMMAND_MAKES(artifacts),
};
