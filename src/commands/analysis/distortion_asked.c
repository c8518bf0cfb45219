/* commands/analysis/distortion_asked.c - a lens beside the projection that is asked for. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/distortion_asked.h"

const struct analysis_policy distortion_by_field = {
    .wavelengths = WAVELENGTHS_PRIMARY, .fields = FIELDS_ALL, .one_wavelength = true};
const struct analysis_policy distortion_as_whole = {
    .wavelengths = WAVELENGTHS_PRIMARY, .fields = FIELDS_EDGE, .one_wavelength = true};

/* The field that is balanced: as far as the lens says it goes, whatever is asked for. */
static struct field_point edge_of(const struct setup *setup)
{
    const struct lens *lens = setup->lens;
    struct field_point edge = {.kind = lens->field_kind, .value = {0, lens_field_extent(lens)}};
    return lens->field_count > 0 && edge.value[1] > 0 ? edge : setup->edge;
}

static enum projection projection_of(const struct distortion_input *input)
{
    const bool is_fisheye = input->fit == 1 + MODEL_FISHEYE;
    return input->projection > 0 ? (enum projection)(input->projection - 1)
           : is_fisheye          ? EQUIDISTANT
                                 : RECTILINEAR;
}

static bool calibrate(const struct setup *setup, struct distortion_case *ready, struct error *error)
{
    const struct field_point edge = edge_of(setup);
    if (edge.kind == FIELD_NONE) {
        return fail(error, ERROR_DOMAIN,
                    "{--calibrated}: the lens states no field whose distortion could be balanced");
    }
    if (!distortion_calibrate(&ready->map, &edge, &ready->calibrated, error)) {
        return error_prefix(error, "{--calibrated}: ");
    }
    ready->map.scale = ready->calibrated;
    return true;
}

bool distortion_ready(const struct distortion_input *input, const struct analysis_case *one,
                      struct distortion_case *ready, struct error *error)
{
    const struct setup *setup = one->setup;
    const enum projection projection = projection_of(input);
    *ready = (struct distortion_case){.focal = NAN,
                                      .magnification = NAN,
                                      .calibrated = NAN,
                                      .projection = projections[projection].word};
    if (!distortion_open(setup, 0, projection, setup->arena, &ready->map, error)) {
        return false;
    }
    if (setup->object.is_infinite) {
        ready->focal = ready->map.scale;
    } else {
        ready->magnification = ready->map.scale;
    }
    return !input->calibrated || input->fit > 0 || calibrate(setup, ready, error);
}
