/* commands/camera/render_skips.c - what a picture does without, and how it says so. */
/* SPDX-License-Identifier: MIT */
#include "base/choice.h"
#include "commands/camera/render.h"

#include <inttypes.h>

static const char everything[] = "all";

bool render_kept(const struct render_input *input, unsigned *kept, struct error *error)
{
    struct text rest = text_of(input->no_skip != NULL ? input->no_skip : "");
    *kept = 0;
    while (rest.start != NULL && input->no_skip != NULL) {
        const struct text typed = text_cut(&rest, ','), word = text_trim(typed);
        size_t i = 0;
        while (i < SKIP_COUNT && !text_same(word, skip_words[i].word)) {
            i++;
        }
        if (i == SKIP_COUNT && !text_same(word, everything)) {
            struct choice choice = {.typed = typed};
            for (size_t k = 0; k < SKIP_COUNT; k++) {
                choice_offer(&choice, skip_words[k].word);
            }
            choice_offer(&choice, everything);
            return choice_refuse(&choice, error) || error_prefix(error, "{--no-skip} ");
        }
        *kept |= i == SKIP_COUNT ? (1U << SKIP_COUNT) - 1 : 1U << i;
    }
    return true;
}

static const char *or_kept(const struct photograph_question *question, enum skip skip)
{
    return skip_is_kept(question->kept, skip) ? ", as --no-skip asks" : "";
}

static uint64_t count_tiles(const uint64_t *tiles)
{
    uint64_t all = 0;
    for (int way = 0; way < RAY_REUSE_WAYS; way++) {
        all += tiles[way];
    }
    return all;
}

static void explain_colour(const struct photograph_question *question,
                           const struct photograph *photograph, struct text_buffer *remarks)
{
    const uint64_t *tiles = photograph->counts + PHOTOGRAPH_WAYS;
    const bool as_one = photograph->passes == 1;
    const bool in_bands =
        question->view != NULL && question->view->bands->count > PHOTOGRAPH_CHANNELS;
    growing_format(remarks, "colour: ");
    if (in_bands) {
        growing_format(remarks, "%zu bands, four for each point%s", question->view->bands->count,
                       as_one ? ": " : ", a ray each");
    }
    if (as_one) {
        growing_format(remarks, "all colours go the same way: one pass of rays");
    } else if (!in_bands) {
        growing_format(remarks, "a pass of rays for each");
    }
    if (question->view != NULL && !as_one && !in_bands) {
        growing_format(remarks,
                       ", but one for all in %" PRIu64 " of %" PRIu64
                       " tiles, where the lens sends them to within a quarter of a pixel",
                       tiles[RAY_REUSE_SHARED], count_tiles(tiles));
    }
    growing_format(remarks, "%s\n", or_kept(question, SKIP_COLOUR));
}

/* Why exposures are not of one picture; null: they are. */
static const char *why_anew(const struct artifact_job *job,
                            const struct photograph_question *question)
{
    if (render_shutter_varies(job)) {
        return "how a leaf shutter weighs the pupil depends on the time";
    }
    return (job->count > 1 && question->duration > 0 && !skip_is_kept(question->kept, SKIP_TIME))
               ? "how far things move depends on the time"
               : NULL;
}

void render_explain(const struct artifact_job *job, const struct photograph_question *question,
                    const struct photograph *photograph, struct text_buffer *remarks)
{
    const uint64_t *tiles = photograph->counts + PHOTOGRAPH_WAYS;
    const double traced = (double)photograph->counts[PHOTOGRAPH_TRACED];
    const double passed = (double)photograph->counts[PHOTOGRAPH_PASSED];
    growing_format(remarks,
                   "H = t/A integral over pixel A and directions w of L(T(x, w)) cos(theta) dw dA: "
                   "exposure of a pixel, T the way of a ray through the lens; [Kolb95] (1)\n"
                   "pupil: rays only where light can come from: %.4g %% of %s arrived%s\n",
                   traced > 0 ? 100 * passed / traced : 0,
                   traced > 0 ? "those traced" : "none traced", or_kept(question, SKIP_PUPIL));
    render_explain_shutter(question->film.shutter, remarks);
    explain_colour(question, photograph, remarks);
    /* Tiles that need few rays, or none. */
    const uint64_t all = count_tiles(tiles);
    if (question->view == NULL) {
        growing_format(remarks,
                       "blur: below a quarter of a pixel in %" PRIu64 " of %" PRIu64
                       " tiles of 16 x 8 pixels, each with one pupil%s\n",
                       tiles[RAY_REUSE_SHARP], all, or_kept(question, SKIP_BLUR));
    } else {
        growing_format(remarks, "blur: no tile of a scene goes without: little of its time is that "
                                "of ways through the lens\n");
    }
    growing_format(remarks,
                   "uniform: %" PRIu64 " of %" PRIu64
                   " tiles see the same light everywhere: no rays%s\n",
                   tiles[RAY_REUSE_EVEN], all, or_kept(question, SKIP_UNIFORM));
    growing_format(remarks, "time: %s%s\n",
                   question->duration > 0 ? "each ray has its own"
                                          : "all rays come at once: nothing depends on it",
                   or_kept(question, SKIP_TIME));
    if (question->view != NULL && photograph->lamps > 0) {
        growing_format(remarks,
                       "lamps: %zu by %zu rays of their own through the lens, at each wavelength; "
                       "[Veach97] 10.3.4\n",
                       photograph->lamps, photograph->lamp_rays);
    } else if (question->view != NULL) {
        growing_format(remarks, "lamps: none by rays of its own%s\n",
                       or_kept(question, SKIP_LAMPS));
    }
    if (question->view != NULL) {
        /* What a scene goes without. */
        const int bounces = question->view->path->bounces;
        growing_format(remarks, "secondary: ");
        if (bounces == 0) {
            growing_format(remarks, "light that shines alone is seen: no rays beyond the first%s\n",
                           or_kept(question, SKIP_SECONDARY));
        } else {
            growing_format(remarks, "light comes by up to %d bounces%s\n", bounces,
                           or_kept(question, SKIP_SECONDARY));
        }
    }
    const char *anew = why_anew(job, question);
    growing_format(remarks, "exposures: %zu%s%s%s\n", job->count,
                   anew != NULL ? ", a picture each: " : " of one picture",
                   anew != NULL ? anew : "", or_kept(question, SKIP_EXPOSURES));
}
