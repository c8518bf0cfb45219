/* design/merit/merit_beams.c - the rays of the fields and wavelengths of an operand, kept aimed. */
/* SPDX-License-Identifier: MIT */
#include "design/merit/merit_beams.h"

#include "design/merit/merit_paraxial.h"

#include <math.h>

static bool displaces(const struct variable_link *links, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (links[i].basis.kind >= PARAMETER_DECENTER_X) {
            return true;
        }
    }
    return false;
}

/* The links as they are now. */
static void merit_beams_find_links(struct merit *merit, const struct merit_slot *slot,
                                   struct merit_beams *beams)
{
    const struct bundle_wish *wish = &beams->bundle.wish;
    for (size_t i = 0; i < wish->wavelength_count; i++) {
        const struct merit_light *light = merit_light(merit, slot, wish->wavelengths[i].wavelength);
        beams->links[i] = (struct bundle_links){light->links, light->link_count};
    }
}

bool merit_beams_begin(struct merit *merit, const struct merit_slot *slot, struct bundle_wish *wish,
                       struct arena *arena, struct merit_beams *beams, struct error *error)
{
    wish->limit = merit->limit;
    wish->place = slot->place;
    *beams = (struct merit_beams){.bundle = {.wish = *wish}};
    beams->links = ARENA_ARRAY(arena, wish->wavelength_count, struct bundle_links);
    merit->derives = true; /* the links of the lens at the start */
    merit->evaluation++;
    merit_beams_find_links(merit, slot, beams);
    for (size_t i = 0; i < wish->wavelength_count; i++) {
        wish->is_round = wish->is_round && !displaces(beams->links[i].list, beams->links[i].count);
    }
    return merit_bundle_open(wish, beams->links, merit->variable_count, arena, &beams->bundle,
                             error);
}

bool merit_beams_open(struct merit *merit, const struct merit_slot *slot, bool path, bool whole,
                      struct arena *arena, struct merit_beams *beams, struct error *error)
{
    const struct merit_question *question = &merit->question;
    struct bundle_wish wish = {.setup = &merit->places[slot->place].setup,
                               .from_entrance = question->from_entrance,
                               .clip = question->clip,
                               .vignetting = question->vignetting,
                               .path = path,
                               .pattern = question->pattern,
                               .rays = question->rays,
                               .seed = question->seed,
                               .watch = question->watch,
                               .is_round = !question->is_skew && question->irregularity_count == 0,
                               .irregularities = question->irregularities,
                               .irregularity_count = question->irregularity_count,
                               .irregularity_amounts = question->irregularity_amounts,
                               .whole = whole};
    wish.from_entrance = wish.from_entrance || wish.setup->first.is_telecentric;
    /* the fields and wavelengths of the operand: its own, or those of the position */
    static const struct setup_field axis = {{.kind = FIELD_NONE}, 1};
    const struct setup *setup = wish.setup;
    const struct operand *operand = slot->operand;
    wish.fields = setup->field_count > 0 ? setup->fields : &axis;
    wish.field_count = setup->field_count > 0 ? setup->field_count : 1;
    wish.wavelengths = setup->wavelengths;
    wish.wavelength_count = setup->wavelength_count;
    if (operand->field != NULL) {
        wish.fields = operand->field;
        wish.field_count = 1;
    }
    if (!isnan(operand->wavelength)) {
        struct setup_wavelength *one = ARENA_NEW(arena, struct setup_wavelength);
        *one = (struct setup_wavelength){operand->wavelength, 1};
        wish.wavelengths = one;
        wish.wavelength_count = 1;
    }
    if (!merit_beams_begin(merit, slot, &wish, arena, beams, error)) {
        return false;
    }
    if (wish.path) {
        beams->spheres =
            merit_spheres_open(&wish, &beams->links[0], merit->variable_count, arena, error);
    }
    return !wish.path || beams->spheres != NULL;
}

/* The exit pupil is that of the first wavelength. */
static bool find_spheres(struct merit *merit, const struct merit_slot *slot,
                         const struct merit_figures *primary, struct merit_beams *beams)
{
    struct merit_spheres *spheres = beams->spheres;
    const struct merit_figures *figures =
        merit_figures(merit, slot, beams->bundle.wish.wavelengths[0].wavelength);
    if (merit->forgets) {
        merit_bundle_forget(&spheres->chief);
    }
    if (figures == NULL || !merit_bundle_aim(&spheres->chief, merit->places[slot->place].lens,
                                             &primary[0].first, &merit->why)) {
        return false;
    }
    for (size_t j = 0; j < merit_columns(merit); j++) {
        spheres->pupil[j] = figures[j].first.exit_pupil;
        spheres->chief.rates[j] = merit_bundle_rate(&spheres->chief, &primary[j].first);
    }
    return merit_spheres_find(spheres, &beams->links[0], merit->derives, &merit->why);
}

/* Figures by a column, the stop as wide as rays fill it. */
static struct dual_first first_with_stop(const struct merit_place *place,
                                         const struct merit_figures *figures, size_t column)
{
    struct dual_first first = figures[column].first;
    if (place->stop != NULL) {
        first.stop_radius = place->stop[column];
    }
    return first;
}

bool merit_beams_aim(struct merit *merit, const struct merit_slot *slot, struct merit_beams *beams)
{
    struct merit_bundle *bundle = &beams->bundle;
    const bool is_bare = bundle->is_held && beams->spheres == NULL; /* nothing is paraxial */
    const struct merit_figures *figures = is_bare ? NULL : merit_figures(merit, slot, NAN);
    if (merit->forgets) {
        merit_bundle_forget(bundle);
    }
    const struct merit_place *place = &merit->places[slot->place];
    if (figures == NULL && !is_bare) {
        return false;
    }
    struct dual_first first = {0};
    if (!is_bare) {
        first = first_with_stop(place, figures, 0);
    }
    if (!merit_bundle_aim(bundle, place->lens, is_bare ? NULL : &first, &merit->why)) {
        return false;
    }
    for (size_t j = 0; merit->derives && j < merit->variable_count; j++) {
        bundle->rates[j] = (struct bundle_rate){0, 0, 0, 0};
        if (!is_bare) {
            first = first_with_stop(place, figures, j);
            bundle->rates[j] = merit_bundle_rate(bundle, &first);
        }
    }
    if (merit->derives && merit->question.by != NULL && bundle->image_moves) {
        bundle->rates[0].image += 1; /* where it is a distance, a link has it */
    }
    merit_beams_find_links(merit, slot, beams);
    return beams->spheres == NULL || find_spheres(merit, slot, figures, beams);
}

void merit_beams_settle(struct merit_beams *beams, bool holds)
{
    merit_bundle_settle(&beams->bundle, holds);
    if (beams->spheres != NULL) {
        merit_bundle_settle(&beams->spheres->chief, holds);
    }
}

bool merit_beams_deform(struct merit_beams *beams, struct error *error)
{
    return merit_bundle_deform(&beams->bundle, error) &&
           (beams->spheres == NULL || merit_bundle_deform(&beams->spheres->chief, error));
}
