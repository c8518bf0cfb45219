/* commands/lens/cmd_draw.c - lenscalc draw: cross-section of a lens as SVG. */
/* SPDX-License-Identifier: MIT */
#include "commands/lens/lens_options.h"
#include "commands/tables.h"
#include "draw/section.h"

struct draw_input {
    struct lens_question question;
    bool planes, construction, no_rays;
    const char *title;
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
    {ASKED(title), .name = "title", .value = "TEXT", .help = "title in place of the lens's own"},
};

static bool draw_check(const struct artifact_job *job, struct error *error)
{
    const struct draw_input *input = job->inputs[0];
    if (lens_positions_several(input->question.lens.lens, input->question.position)) {
        return fail(error, ERROR_USAGE, "a drawing shows one position: {--position} NAME");
    }
    if (input->construction && (input->planes || input->no_rays)) {
        return fail(error, ERROR_USAGE, "{--construction} has planes and rays of its own: no %s",
                    input->planes ? "--planes" : "--no-rays");
    }
    return true;
}

static bool draw_draw(const struct artifact_job *job, struct output *sink, struct error *error)
{
    const struct draw_input *input = job->inputs[0];
    const struct lens *lens = input->question.lens.lens;
    const struct plane_value focus = {.kind = lens != NULL ? layout_plane(lens) : PLANE_OF_LENS};
    const struct lens_policy policy = {
        .wavelengths = WAVELENGTHS_PRIMARY, .fields = FIELDS_LARGEST, .focus = &focus};
    struct svg svg = {.arena = job->run->arena};
    struct lens_cursor at = lens_begin(&input->question, &policy, svg.arena);
    if (!lens_next(&at, error)) {
        return false;
    }
    struct arena *arena = svg.arena;
    const struct layout_request request = {.wavelength = at.one.index,
                                           .light = &at.one.light,
                                           .planes = input->planes,
                                           .construction = input->construction,
                                           .no_rays = input->no_rays};
    const char *title = at.one.setup->lens->title;
    struct layout layout;
    if ((input->construction || input->planes) && !layout_is_centred(at.one.setup->lens)) {
        return fail(error, ERROR_DOMAIN,
                    "{--%s} is for centred lenses, and parts of this one are decentred, tilted or "
                    "behind a coordinate break",
                    input->construction ? "construction" : "planes");
    }
    if (!layout_make(at.one.setup, &request, arena, &layout, error)) {
        return false;
    }
    if (at.one.warning != NULL) {
        layout_note(&layout, arena_printf(arena, "warning: %s", at.one.warning));
    }
    const struct first_order *first = &at.one.light.first;
    const char *focal =
        first->is_afocal ? "afocal" : arena_printf(arena, "f = %.5g mm", first->efl);
    const char *speed =
        isfinite(first->fnumber) ? arena_printf(arena, ", f/%.3g", first->fnumber) : "";
    const char *position = at.one.setup->position != NULL
                               ? arena_printf(arena, ", position %s", at.one.setup->position)
                               : "";
    const struct section section = {.title = input->title != NULL ? input->title : title,
                                    .subtitle =
                                        arena_printf(arena, "%s%s%s, at %.5g nm", focal, speed,
                                                     position, 1000 * at.one.light.wavelength),
                                    .layout = &layout,
                                    .faint = input->construction};
    return section_draw(&section, &svg, error) && drawing_write(job, &svg, sink, error);
}

static const struct artifact artifacts[] = {
    {ARTIFACT_ANSWER(drawing_types), .check = draw_check, .make = draw_draw},
};

static const struct example examples[] = {
    {"draw double-gauss", "the cross-section with its rays (to a file: -o FILE.svg)"},
    {"draw double-gauss --planes", "with principal planes and pupils"},
    {"draw double-gauss --construction", "how the equivalent lens makes an image"},
    {"draw nikkor-z-14-24 --position tele", "a zoom in one of its positions"},
    {NULL, NULL},
};

const struct command command_draw = {
    .name = "draw",
    .group = "a lens",
    .summary = "cross-section of a lens as an SVG drawing",
    COMMAND_ASKS(INPUT),
    COMMAND_MAKES(artifacts),
};
