/* commands/analysis/figure_captions.c - titles, subtitles and legends of what is drawn together. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/figure_captions.h"

#include <string.h>

static bool caption_words_equal(const char *a, const char *b)
{
    return a == b || (a != NULL && b != NULL && strcmp(a, b) == 0);
}

/* "A, B"; of nothing and B B */
static const char *caption_join(const char *words, const char *between, const char *more,
                                struct arena *arena)
{
    if (words == NULL || more == NULL) {
        return words != NULL ? words : more;
    }
    return ARENA_JOIN(arena, words, between, more);
}

/* What was asked for, as a legend has it. */
static struct caption caption_of(const struct analysis_case *one, const char *const *words,
                                 struct arena *arena)
{
    const struct analysis_question *question = one->question;
    const bool has_waves = question->wavelength.name != NULL || question->spectrum.text != NULL;
    struct caption caption = {.labels = {[CAPTION_KIND] = words[CAPTION_KIND],
                                         [CAPTION_FIELD] = words[CAPTION_FIELD],
                                         [CAPTION_LENS] = words[CAPTION_LENS],
                                         [CAPTION_POSITION] = words[CAPTION_POSITION],
                                         [CAPTION_OBJECT] = words[CAPTION_OBJECT],
                                         [CAPTION_DEFOCUS] = words[CAPTION_DEFOCUS],
                                         [CAPTION_PLANE] = one->setup->focus}};
    if (!isnan(question->fnumber)) {
        caption.labels[CAPTION_APERTURE] = arena_printf(arena, "f/%.4g", question->fnumber);
    }
    if (has_waves) {
        caption.labels[CAPTION_WAVELENGTHS] = words[CAPTION_WAVELENGTHS];
    }
    return caption;
}

size_t captions_add(struct captions *captions, const struct analysis_case *one, size_t field,
                    const char *kind)
{
    struct arena *arena = captions->arena;
    const char *words[CAPTION_PARTS] = {
        [CAPTION_KIND] = kind,
        [CAPTION_FIELD] = analysis_place_words(&one->setup->fields[field].point, arena),
        [CAPTION_LENS] = one->setup->lens->title};
    analysis_setting_words(one, &words[CAPTION_POSITION], arena);
    struct caption caption = caption_of(one, words, arena);
    size_t at = 0;
    for (size_t k = 0; k < CAPTION_PARTS; k++) {
        if (captions->leaves_out[k]) {
            caption.labels[k] = words[k] = NULL;
        }
        captions->varies[k] =
            captions->count > 0 &&
            (captions->varies[k] || !caption_words_equal(words[k], captions->words[k]));
        captions->words[k] = captions->count > 0 ? captions->words[k] : words[k];
    }
    for (size_t same = 0; at < captions->count && same < CAPTION_PARTS;
         at += same < CAPTION_PARTS) {
        const struct caption *other = &captions->list[at];
        same = 0;
        while (same < CAPTION_PARTS &&
               caption_words_equal(other->labels[same], caption.labels[same])) {
            same++;
        }
    }
    if (at == captions->count) {
        captions->list = arena_grow(arena, captions->list, captions->count, &captions->room,
                                    sizeof *captions->list);
        captions->list[captions->count++] = caption;
    }
    return at;
}

/* Have captions other labels of a part? */
static bool captions_differ(const struct captions *captions, size_t part)
{
    bool differ = false;
    for (size_t i = 1; i < captions->count; i++) {
        differ = differ || !caption_words_equal(captions->list[i].labels[part],
                                                captions->list[0].labels[part]);
    }
    return differ;
}

const char *captions_label(const struct captions *captions, size_t at)
{
    const char *label = NULL;
    for (size_t k = 0; k < CAPTION_PARTS; k++) {
        if (captions_differ(captions, k)) {
            label = caption_join(label, ", ", captions->list[at].labels[k], captions->arena);
        }
    }
    return label;
}

bool captions_have_settings(const struct captions *captions)
{
    bool have = false;
    for (size_t k = 0; k < CAPTION_PARTS; k++) {
        have = have || (k != CAPTION_FIELD && captions_differ(captions, k));
    }
    return have;
}

const char *captions_title(const struct captions *captions, const char *what)
{
    return captions->varies[CAPTION_LENS]
               ? what
               : arena_printf(captions->arena, "%s of %s", what, captions->words[CAPTION_LENS]);
}

/* What all share; of the image plane how it was found alone, or where it lies too. */
static const char *captions_join(const struct captions *captions, bool has_place)
{
    struct arena *arena = captions->arena;
    const char *words = NULL;
    for (size_t k = 0; k < CAPTION_PARTS; k++) {
        const char *part = captions->varies[k] ? NULL : captions->words[k];
        const char *found = captions->list[0].labels[k];
        if (k == CAPTION_PLANE && found != NULL && !captions_differ(captions, k) &&
            (part == NULL || !has_place)) {
            part = ARENA_JOIN(arena, "image plane ", found);
        }
        words = caption_join(words, "; ", k == CAPTION_LENS ? NULL : part, arena);
    }
    return words;
}

const char *captions_subtitle(const struct captions *captions)
{
    enum { MOST = 95 }; /* for which a page of plots has room */
    const char *words = captions_join(captions, true);
    return words == NULL || strlen(words) <= MOST ? words : captions_join(captions, false);
}
