/* exchange/oslo/oslo_write_aperture.c - what passes or blocks light, as special apertures. */
/* SPDX-License-Identifier: MIT */
#include "exchange/oslo/oslo.h"

#include "file/lens_unit.h"
#include "optics/aperture.h"

/* ATP; 0: there is no such type. */
static int oslo_write_aperture_type_of(const struct aperture *aperture)
{
    static const int types[APERTURE_SHAPES] = {
        [SHAPE_CIRCLE] = 1, [SHAPE_ELLIPSE] = 1, [SHAPE_RECTANGLE] = 2};
    bool turned = aperture->turn.value.hi != 0 && aperture->shape != SHAPE_CIRCLE;
    bool corners = aperture->shape == SHAPE_POLYGON &&
                   (aperture->point_count == 3 || aperture->point_count == 4);
    if (turned) {
        return 0;
    }
    if (corners) {
        return (int)aperture->point_count;
    }
    return types[aperture->shape];
}

static void oslo_write_aperture_put(struct lens_writer *writing, const char *name, char letter,
                                    struct pair value)
{
    const struct figure figure =
        figure_computed(value, lens_unit_scale(writing->lens->unit), writing->arena);
    growing_format(&writing->text, "%s %c ", name, letter);
    growing_text(&writing->text, writing_length(writing, &figure, 1));
    growing_string(&writing->text, "\n");
}

static void oslo_write_aperture_put_one(struct lens_writer *writing,
                                        const struct aperture *aperture, char letter)
{
    static const char *const edges[2][2] = {{"AX1", "AX2"}, {"AY1", "AY2"}};
    const struct pair *centres[] = {&aperture->decenter[0].value, &aperture->decenter[1].value};
    growing_format(&writing->text, "ATP %c %d\nAAC %c %d\n", letter,
                   oslo_write_aperture_type_of(aperture), letter, aperture->blocks ? 2 : 4);
    for (size_t i = 0; i < aperture->point_count; i++) {
        for (int k = 0; k < 2; k++) {
            oslo_write_aperture_put(
                writing, arena_printf(writing->arena, "AV%c%zu", k == 0 ? 'X' : 'Y', i + 1), letter,
                pair_add(*centres[k], aperture->points[i][k].value));
        }
    }
    for (int k = 0; k < 2 && aperture->point_count == 0; k++) {
        const int of = aperture->shape == SHAPE_CIRCLE ? 0 : k;
        const struct pair half = {aperture->size[of].value.hi / 2, aperture->size[of].value.lo / 2};
        oslo_write_aperture_put(writing, edges[k][0], letter, pair_subtract(*centres[k], half));
        oslo_write_aperture_put(writing, edges[k][1], letter, pair_add(*centres[k], half));
    }
}

bool oslo_write_apertures(struct lens_writer *writing, struct foreign_job *job,
                          const struct surface *surface, struct error *error)
{
    enum { MOST = 26 }; /* letters */
    size_t count = 0;
    for (size_t i = 0; i < surface->aperture_count; i++) {
        const struct aperture *one = &surface->apertures[i];
        count += oslo_write_aperture_type_of(one) != 0;
    }
    if (count > 0) {
        growing_format(&writing->text, "APN %zu\n", count < MOST ? count : MOST);
    }
    count = 0;
    for (size_t i = 0; i < surface->aperture_count; i++) {
        const struct aperture *one = &surface->apertures[i];
        if (oslo_write_aperture_type_of(one) != 0 && count < MOST) {
            oslo_write_aperture_put_one(writing, one, (char)('A' + count++));
        } else if (!foreign_lose(job, error,
                                 "surface %zu: a %s that %s: no such aperture is "
                                 "written" LOSS_VIGNETTES LOSS_INSTEAD "left out",
                                 (size_t)(surface - writing->lens->surfaces) + 1,
                                 aperture_shapes[one->shape].word,
                                 one->blocks ? "blocks" : "passes")) {
            return false;
        }
    }
    return true;
}
