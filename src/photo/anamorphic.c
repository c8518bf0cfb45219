/* photo/anamorphic.c - what an anamorphic lens does across the picture. */
/* SPDX-License-Identifier: MIT */
#include "photo/anamorphic.h"

#include "photo/given.h"

bool anamorphic_view(const struct dof_setting *setting, const struct dof *dof,
                     const struct sensor *sensor, double squeeze, struct anamorphic *view,
                     struct error *error)
{
    *view =
        (struct anamorphic){setting->f / squeeze, squeeze * sensor->width / dof->magnification,
                            sensor->height / dof->magnification, dof->blur_at_infinity / squeeze};
    return check_positive("squeeze", "", squeeze, error);
}
