/* optics/thick_lens.c - an ideal thick lens, and a prescription with one in place of a lens. */
/* SPDX-License-Identifier: MIT */
#include "optics/thick_lens.h"

#include <math.h>
#include <string.h>

/* A plane that is only there to count from. */
static struct surface plane_surface(double thickness, const struct medium *medium)
{
    struct surface surface = {.is_plane = true, .has_thickness = true, .medium = *medium};
    surface.radius = surface.curvature = surface.conic = figure_number(pair_of(0));
    surface.diameter = surface.focal = surface.hiatus = figure_number(pair_of(0));
    for (int i = 0; i < LENS_COEFFICIENTS; i++) {
        surface.coefficient[i].variable = LENS_NONE;
    }
    surface.thickness = figure_number(pair_of(thickness));
    return surface;
}

static void set_surfaces(struct lens *lens, const struct thick_stand_in *stand_in,
                         const struct medium *behind)
{
    const struct medium *before = &lens->object_medium;
    double front = stand_in->thick.front;
    bool has_stop = isfinite(stand_in->pupil) && stand_in->pupil_diameter > 0;
    size_t count = 0;
    lens->surfaces[count++] = plane_surface(has_stop ? stand_in->pupil : front, before);
    if (has_stop) {
        lens->stop = count;
        struct surface stop = plane_surface(front - stand_in->pupil, before);
        stop.kind = SURFACE_STOP;
        stop.is_stop = stop.has_diameter = true;
        stop.diameter = figure_number(pair_of(stand_in->pupil_diameter));
        lens->surfaces[count++] = stop;
    }
    const struct thick_lens *thick = &stand_in->thick;
    struct surface ideal = plane_surface(-thick->rear, behind);
    ideal.kind = SURFACE_THICK;
    ideal.focal = figure_number(pair_of(thick->focal));
    ideal.hiatus = figure_number(pair_of(stand_in->length + thick->rear - thick->front));
    for (size_t i = 0; i < THICK_DISTORTIONS; i++) {
        ideal.distortion[i] = figure_number(pair_of(thick->distortion[i]));
    }
    lens->surfaces[count++] = ideal;
    lens->surfaces[count++] = plane_surface(stand_in->image, behind);
    lens->surface_count = count;
    if (has_stop) {
        lens->aperture_kind = APERTURE_STOP;
    } else if (stand_in->fnumber > 0 && stand_in->fnumber < INFINITY) {
        lens->aperture_kind = APERTURE_FNUMBER;
    } else {
        lens->aperture_kind = APERTURE_NONE;
    }
    lens->aperture =
        figure_number(pair_of(lens->aperture_kind == APERTURE_FNUMBER ? stand_in->fnumber : 0));
}

struct lens thick_element_lens(const struct lens *lens, const struct thick_stand_in *stand_in,
                               struct arena *arena)
{
    struct lens all = *lens;
    all.title = stand_in->title;
    all.kind = NULL;
    all.notes = ARENA_ARRAY(arena, 1, const char *);
    all.notes[0] = stand_in->note;
    all.note_count = 1;
    /* typed digits are in the file's unit: from here on all is in mm, and computed */
    all.unit = "mm";
    all.object.typed = (struct text){NULL, 0};
    all.fields = ARENA_ARRAY(arena, lens->field_count + 1, struct lens_field);
    for (size_t i = 0; i < lens->field_count; i++) {
        all.fields[i] = lens->fields[i];
        all.fields[i].at[0].typed = all.fields[i].at[1].typed = (struct text){NULL, 0};
    }
    all.position_count = all.variable_count = 0;
    all.objects = all.apertures = NULL;
    memset(all.stated, 0, sizeof all.stated);
    all.tolerances = NULL; /* they are of surfaces that are no more */
    all.tolerance_count = 0;
    all.stop = LENS_NONE;
    all.surfaces = ARENA_ARRAY(arena, 4, struct surface);
    set_surfaces(&all, stand_in, &lens->surfaces[lens->surface_count - 1].medium);
    return all;
}
