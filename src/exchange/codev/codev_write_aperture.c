/* exchange/codev/codev_write_aperture.c - what passes or blocks light, in CODE V's words. */
/* SPDX-License-Identifier: MIT */
#include "exchange/codev/codev.h"
#include "file/decimal.h"

/* One command of an aperture: `half` of a size, or a decentre as it is. */
static void codev_write_aperture_put(struct lens_writer *writing, const char *name,
                                     const char *label, const struct figure *figure, bool half)
{
    const struct text digits = writing_length(writing, figure, 1);
    const struct text value = half ? decimal_half(digits, writing->arena) : digits;
    growing_format(&writing->text, "  %s%s %.*s\n", name, label, (int)value.length, value.start);
}

static void put_shift(struct lens_writer *writing, const char *label,
                      const struct aperture *aperture)
{
    static const char *const names[] = {"ADX", "ADY"};
    for (int k = 0; k < 2; k++) {
        if (aperture->decenter[k].value.hi != 0) {
            codev_write_aperture_put(writing, names[k], label, &aperture->decenter[k], false);
        }
    }
}

/* Why there are no words for it; null: there are. */
static const char *codev_write_aperture_refusal_of(const struct surface *surface,
                                                   const struct aperture *aperture)
{
    const struct aperture_traits *traits = &aperture_shapes[aperture->shape];
    bool circle = aperture->shape == SHAPE_CIRCLE;
    size_t circles = 0;
    for (size_t i = 0; i < surface->aperture_count; i++) {
        const struct aperture *other = &surface->apertures[i];
        circles += !other->blocks && other->shape == SHAPE_CIRCLE ? 1 : 0;
    }
    if (traits->has_points || traits->has_arms || aperture->shape == SHAPE_RING) {
        return "no such shape is written";
    }
    if (!circle && aperture->turn.value.hi != 0) {
        return "none is written that is turned";
    }
    return circle && !aperture->blocks && (surface->has_diameter || circles > 1)
               ? "a surface has one clear circle"
               : NULL;
}

bool codev_put_apertures(struct lens_writer *writing, struct foreign_job *job,
                         const struct surface *surface, struct error *error)
{
    static const char *const names[][2] = {[SHAPE_CIRCLE] = {"CIR", NULL},
                                           [SHAPE_RECTANGLE] = {"REX", "REY"},
                                           [SHAPE_ELLIPSE] = {"ELX", "ELY"}};
    for (size_t i = 0; i < surface->aperture_count; i++) {
        const struct aperture *one = &surface->apertures[i];
        const char *refusal = codev_write_aperture_refusal_of(surface, one);
        bool is_plain = one->shape == SHAPE_CIRCLE && !one->blocks;
        const char *label =
            is_plain ? ""
                     : arena_printf(writing->arena, "%s L'a%zu'", one->blocks ? " OBS" : "", i + 1);
        if (refusal != NULL) {
            if (!foreign_lose(
                    job, error,
                    "surface %zu: a %s that %s: %s" LOSS_VIGNETTES LOSS_INSTEAD "left out",
                    (size_t)(surface - writing->lens->surfaces) + 1,
                    aperture_shapes[one->shape].word, one->blocks ? "blocks" : "passes", refusal)) {
                return false;
            }
            continue;
        }
        for (int k = 0; k < 2 && names[one->shape][k] != NULL; k++) {
            codev_write_aperture_put(writing, names[one->shape][k], label, &one->size[k], true);
        }
        put_shift(writing, label, one);
    }
    return true;
}
