/* commands/photo/dof_scale.c - dof --scale: the depth-of-field scale of a lens barrel. */
/* SPDX-License-Identifier: MIT */
#include "base/arena.h"
#include "commands/photo/dof_question.h"
#include "draw/barrel.h"
#include "photo/dof.h"

#include <math.h>

/* The f-numbers of a lens barrel and the one in use among them, ascending. */
static size_t barrel_fnumbers(double chosen, double *fnumbers, size_t *at)
{
    static const double usual[] = {1, 1.4, 2, 2.8, 4, 5.6, 8, 11, 16, 22, 32, 45, 64};
    size_t count = 0;
    bool placed = false;
    for (size_t i = 0; i < sizeof usual / sizeof usual[0]; i++) {
        if (!placed && chosen <= usual[i] * 1.03) {
            *at = count;
            fnumbers[count++] = chosen;
            placed = true;
            if (chosen > usual[i] / 1.03) {
                continue;
            }
        }
        /* far from the one in use the marks would lie on the index or off the scale */
        if (usual[i] > chosen / 9 && usual[i] < chosen * 5) {
            fnumbers[count++] = usual[i];
        }
    }
    if (!placed) {
        *at = count;
        fnumbers[count++] = chosen;
    }
    return count;
}

bool dof_draw_scale(const struct artifact_job *job, struct output *sink, struct error *error)
{
    struct dof_question own = *(const struct dof_question *)job->inputs[0];
    const struct dof_question *input = &own;
    struct svg svg = {.arena = job->run->arena};
    struct photo_lens lens, room;
    struct attached_lens attached;
    struct dof_setting setting;
    struct barrel_mark marks[16];
    struct barrel barrel = {.marks = marks};
    double fnumbers[16];
    if (!sharpness_settle(&own.sharp, PITCH_FOR_COC, NULL, error) ||
        !photo_lens_single(&input->lens, dof_question_use(input), svg.arena, &lens, error) ||
        !dof_question_open(input, &lens, &room, &attached, &setting, error) ||
        !dof_question_solve(input, &attached, &setting, error)) {
        return false;
    }
    barrel.mark_count = barrel_fnumbers(setting.N, fnumbers, &barrel.chosen);
    for (size_t i = 0; i < barrel.mark_count; i++) {
        double near, far;
        dof_vergences(&setting, fnumbers[i], &near, &far);
        marks[i] = (struct barrel_mark){fnumbers[i], 1000 * near, 1000 * far};
    }
    barrel.focus_diopter = 1000 / setting.s;
    barrel.title = lens.real->title != NULL
                       ? arena_printf(svg.arena, "Depth of field of %s", lens.real->title)
                       : arena_printf(svg.arena, "Depth of field of a %.4g mm lens", setting.f);
    barrel.subtitle =
        arena_printf(svg.arena,
                     "focused at %.4g m, f/%.4g, circle of confusion %.4g mm, distances from the "
                     "front principal plane",
                     setting.s / 1000, setting.N, setting.c);
    return barrel_draw(&barrel, &svg, error) && drawing_write(job, &svg, sink, error);
}
