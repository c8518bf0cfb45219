/* trace/kernel/clip.c - one ray after the other against a list of shapes. */
/* SPDX-License-Identifier: MIT */
#include "trace/kernel/clip.h"

#include "trace/kernel/step.h"

#include <math.h>

/*
 * The sides of a polygon that lie on those of its hull have no notch within them, whatever rounding
 * says: less than this of its radius is none.
 */
static const double notch = 1e-9;

/* What of an aperture that passes cuts within its hull; false: nothing. */
static bool inner_of(const struct aperture *aperture, struct arena *arena,
                     struct aperture_form *inner)
{
    *inner = aperture_form_of(aperture, arena);
    if (aperture->blocks) {
        return true;
    }
    if (aperture->shape == SHAPE_RING) {
        inner->shape = SHAPE_CIRCLE;
        inner->half[1] = inner->half[0];
        inner->blocks = true;
        return true;
    }
    return aperture->shape == SHAPE_POLYGON &&
           aperture_hull(aperture, arena).point_count != aperture->point_count;
}

bool clip_cuts(const struct surface *surface, struct arena *arena)
{
    struct aperture_form inner;
    for (size_t i = 0; i < surface->aperture_count; i++) {
        if (inner_of(&surface->apertures[i], arena, &inner)) {
            return true;
        }
    }
    return false;
}

const struct clip *clip_of(const struct surface *surface, enum clip_way way, struct arena *arena)
{
    size_t count = surface->aperture_count;
    if (count == 0) {
        return NULL;
    }
    struct aperture_form *forms = ARENA_ARRAY(arena, 2 * count, struct aperture_form);
    struct clip *clip = ARENA_NEW(arena, struct clip);
    *clip = (struct clip){.forms = forms, .inner = forms + count};
    for (size_t i = 0; i < count; i++) {
        const struct aperture *aperture = &surface->apertures[i];
        if (way == CLIP_ALL) {
            forms[clip->count++] = aperture_form_of(aperture, arena);
        } else if (!aperture->blocks) {
            forms[clip->count++] = aperture_hull(aperture, arena);
        }
        clip->inner_count +=
            way == CLIP_ALL && inner_of(aperture, arena, &forms[count + clip->inner_count]);
    }
    return clip->count > 0 ? clip : NULL;
}

static bool clip_passes(const struct clip *clip, double x, double y)
{
    for (size_t i = 0; i < clip->count; i++) {
        if (!aperture_passes(&clip->forms[i], x, y)) {
            return false;
        }
    }
    return true;
}

void clip_block(const struct step *step, int lanes, struct ray_block *block)
{
    for (int i = 0; i < lanes; i++) {
        double old = block->lost[i];
        if (old < step->clipped && old != step->miss &&
            !clip_passes(step->clip, block->x[i], block->y[i])) {
            block->lost[i] = step->clipped;
        }
    }
}

/* A piece of an edge, by its form and its place there. */
static size_t edge_piece_number(const struct aperture_form *form, size_t i, double x, double y)
{
    return 1024 * (i + 1) + aperture_part(form, x, y);
}

double clip_excess(const struct clip *clip, double x, double y, size_t *part)
{
    double worst = -1;
    for (size_t i = 0; i < clip->count; i++) {
        const struct aperture_form *form = &clip->forms[i];
        double excess = aperture_excess(form, x, y);
        excess = form->blocks ? -excess : excess;
        if (excess > worst) {
            worst = excess;
            if (part != NULL) {
                *part = edge_piece_number(form, i, x, y);
            }
        }
    }
    return worst;
}

double clip_depth(const struct clip *clip, double x, double y, size_t *part)
{
    double worst = -INFINITY;
    for (size_t i = 0; i < clip->inner_count; i++) {
        const struct aperture_form *form = &clip->inner[i];
        double excess = aperture_excess(form, x, y);
        double depth = form->blocks ? -excess : excess - notch;
        if (depth > worst) {
            worst = depth;
            *part = edge_piece_number(form, i, x, y);
        }
    }
    return worst;
}
