/* commands/analysis/distortion_asked.c - a lens beside the projection that is asked for. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/distortion_asked.h"

const struct analysis_policy distortion_by_field = {
    .wavelengths = WAVELENGTHS_PRIMARY, .fields = FIELDS_ALL, .one_wavelength = true};
const struct analysis_policy distortion_as_whole = {
    .wavelengths = WAVELENGTHS_PRIMARY, .fields = FIELDS_EDGE, .one_wavelength = true};

enum { KEPT = 16 };

/* What a calibrated scale depends on. */
struct calibrated_case {
    size_t lens; /* its serial number: another one may come to lie in the same place */
    const char *position;
    enum projection projection;
    enum field_kind edge_kind;
    double numbers[7];
};

struct distortion_memo {
    struct calibrated_case cases[KEPT];
    double scales[KEPT];
    size_t count; /* of all that were kept; the oldest give way */
};

struct distortion_memo *distortion_memo_new(struct arena *arena)
{
    return ARENA_NEW(arena, struct distortion_memo);
}

/* The field that is balanced: as far as the lens says it goes, whatever is asked for. */
static struct field_point distortion_asked_edge_of(const struct setup *setup)
{
    const struct lens *lens = setup->lens;
    struct field_point edge = {.kind = lens->field_kind, .value = {0, lens_field_extent(lens)}};
    return lens->field_count > 0 && edge.value[1] > 0 ? edge : setup->edge;
}

/* Is there a field that no plane shows: of those asked for, or of the lens? */
static bool has_half_space(const struct setup *setup)
{
    const struct field_point edge = distortion_asked_edge_of(setup);
    bool has = edge.kind == FIELD_ANGLE && edge.value[1] >= PI / 2;
    for (size_t i = 0; i < setup->field_count; i++) {
        const struct field_point *field = &setup->fields[i].point;
        has = has || (field->kind == FIELD_ANGLE &&
                      fmax(fabs(field->value[0]), fabs(field->value[1])) >= PI / 2);
    }
    return has;
}

static enum projection projection_of(const struct distortion_input *input,
                                     const struct setup *setup)
{
    if (input->projection > 0) {
        return (enum projection)(input->projection - 1);
    }
    const bool is_wide = input->fit == 0 && has_half_space(setup);
    return input->fit == 1 + MODEL_FISHEYE || is_wide ? EQUIDISTANT : RECTILINEAR;
}

static struct calibrated_case case_of(const struct distortion_input *input,
                                      const struct setup *setup, const struct field_point *edge)
{
    return (struct calibrated_case){
        .lens = input->question.lens.serial,
        .position = setup->position,
        .projection = projection_of(input, setup),
        .edge_kind = edge->kind,
        .numbers = {edge->value[0], edge->value[1], setup->wavelengths[0].wavelength, setup->image,
                    setup->object.is_infinite ? INFINITY : setup->object.distance.hi,
                    setup->first.stop_radius, setup->section},
    };
}

static bool distortion_asked_is_same(const struct calibrated_case *one,
                                     const struct calibrated_case *other)
{
    bool same = one->lens == other->lens && one->position == other->position &&
                one->projection == other->projection && one->edge_kind == other->edge_kind;
    for (size_t i = 0; i < sizeof one->numbers / sizeof one->numbers[0]; i++) {
        /* NaN, where there is no such number, is the same as no other */
        same = same && one->numbers[i] == other->numbers[i];
    }
    return same;
}

/* Where a case is kept, or room for it. True: it was there. */
static bool recall(struct distortion_memo *memo, const struct calibrated_case *one, double **scale)
{
    for (size_t i = 0; i < KEPT && i < memo->count; i++) {
        if (distortion_asked_is_same(&memo->cases[i], one)) {
            *scale = &memo->scales[i];
            return true;
        }
    }
    *scale = &memo->scales[memo->count % KEPT];
    return false;
}

static bool find_calibrated(const struct distortion_input *input, const struct setup *setup,
                            const struct field_point *edge, struct distortion_memo *memo,
                            struct distortion_case *ready, struct error *error)
{
    const struct calibrated_case one = case_of(input, setup, edge);
    double *kept = NULL;
    if (memo != NULL && recall(memo, &one, &kept)) {
        ready->calibrated = *kept;
        return true;
    }
    if (!distortion_calibrate(&ready->map, edge, &ready->calibrated, error)) {
        return error_prefix(error, "{--calibrated}: ");
    }
    if (memo != NULL) {
        memo->cases[memo->count++ % KEPT] = one;
        *kept = ready->calibrated;
    }
    return true;
}

static bool calibrate(const struct distortion_input *input, const struct setup *setup,
                      struct distortion_memo *memo, struct distortion_case *ready,
                      struct error *error)
{
    const struct field_point edge = distortion_asked_edge_of(setup);
    if (edge.kind == FIELD_NONE) {
        return fail(error, ERROR_DOMAIN,
                    "{--calibrated}: the lens states no field whose distortion could be balanced");
    }
    if (!find_calibrated(input, setup, &edge, memo, ready, error)) {
        return false;
    }
    ready->map.scale = ready->calibrated;
    return true;
}

bool distortion_ready(const struct distortion_input *input, const struct analysis_case *one,
                      struct distortion_memo *memo, struct distortion_case *ready,
                      struct error *error)
{
    const struct setup *setup = one->setup;
    const enum projection projection = projection_of(input, setup);
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
    return !input->calibrated || input->fit > 0 || calibrate(input, setup, memo, ready, error);
}
