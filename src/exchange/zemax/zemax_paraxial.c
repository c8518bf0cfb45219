/* exchange/zemax/zemax_paraxial.c - the ideal thin lens of a .zmx file, as a thick lens. */
/* SPDX-License-Identifier: MIT */
#include "exchange/zemax/zemax_paraxial.h"

bool zemax_set_paraxial(struct zemax_file *file, const struct zemax_surface *from,
                        struct figure focal, struct surface *to, struct error *error)
{
    const struct zemax_line *given = from->parameters[1];
    const struct zemax_line *place = given != NULL ? given : from->type;
    if (from->glass != NULL && text_same(from->glass->keyword, "MIRROR")) {
        return zemax_loss(file, from->glass, error, "an ideal lens that is a mirror" LOSS_IS_FATAL);
    }
    if (focal.value.hi == 0) {
        return file_words_fail(&place->words, given != NULL ? place->keyword : place->first, error,
                               given != NULL ? "an ideal lens of the focal length 0"
                                             : "an ideal lens without a focal length");
    }
    for (size_t i = 3; i < ZEMAX_PARAMETERS; i++) {
        if (zemax_number(from->parameters[i], 1) != 0 &&
            !zemax_loss(file, from->parameters[i], error,
                        "parameter %zu of an ideal lens" LOSS_INSTEAD "left out", i)) {
            return false;
        }
    }
    if (zemax_number(from->curvature, 0) != 0 || zemax_number(from->conic, 0) != 0) {
        zemax_remark(file, "surface %zu is an ideal lens: its curvature and conic do nothing",
                     from->number);
    }
    const struct figure none = {.variable = LENS_NONE};
    to->kind = SURFACE_THICK;
    to->is_plane = true;
    to->has_curvature = false;
    to->radius = to->curvature = to->conic = none;
    to->focal = focal;
    to->hiatus = figure_zero();
    return true;
}
