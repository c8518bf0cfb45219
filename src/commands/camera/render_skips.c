/* commands/camera/render_skips.c - what a picture does without, and how it says so. */
/* SPDX-License-Identifier: MIT */
#include "commands/camera/render.h"

#include <inttypes.h>
#include <string.h>

/* Which of skip_words a word is; SKIP_COUNT: all of them; above: none. */
static size_t find_skip(const char *word, size_t length)
{
    size_t i = 0;
    while (skip_words[i].word != NULL && (strlen(skip_words[i].word) != length ||
                                          strncmp(skip_words[i].word, word, length) != 0)) {
        i++;
    }
    return skip_words[i].word != NULL || (length == 3 && strncmp(word, "all", 3) == 0) ? i : i + 1;
}

bool render_kept(const struct render_input *input, unsigned *kept, struct error *error)
{
    *kept = 0;
    for (const char *word = input->no_skip; word != NULL;) {
        const char *comma = strchr(word, ',');
        const size_t length = comma != NULL ? (size_t)(comma - word) : strlen(word);
        const size_t which = find_skip(word, length);
        if (which > SKIP_COUNT) {
            return fail(
                error, ERROR_USAGE,
                "{--no-skip} '%.*s': pupil, colour, blur, uniform, exposures, time, secondary or "
                "all",
                (int)(length < 40 ? length : 40), word);
        }
        *kept |= which == SKIP_COUNT ? (1U << SKIP_COUNT) - 1 : 1U << which;
        word = comma != NULL ? comma + 1 : NULL;
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
    for (int way = 0; way < SPARE_WAYS; way++) {
        all += tiles[way];
    }
    return all;
}

static void explain_colour(const struct photograph_question *question,
                           const struct photograph *photograph, struct growing *remarks)
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
    growing_format(remarks, "%s",
                   as_one     ? "all colours go the same way: one pass of rays"
                   : in_bands ? ""
                              : "a pass of rays for each");
    if (question->view != NULL && !as_one && !in_bands) {
        growing_format(remarks,
                       ", but one for all in %" PRIu64 " of %" PRIu64
                       " tiles, where the lens sends them to within a quarter of a pixel",
                       tiles[SPARE_SHARED], count_tiles(tiles));
    }
    growing_format(remarks, "%s\n", or_kept(question, SKIP_COLOUR));
}

/* Tiles that need few rays, or none. */
static void explain_tiles(const struct photograph_question *question, const uint64_t *tiles,
                          struct growing *remarks)
{
    const uint64_t all = count_tiles(tiles);
    if (question->view == NULL) {
        growing_format(remarks,
                       "blur: below a quarter of a pixel in %" PRIu64 " of %" PRIu64
                       " tiles of 16 x 8 pixels, each "
                       "with one pupil%s\n",
                       tiles[SPARE_SHARP], all, or_kept(question, SKIP_BLUR));
    } else {
        growing_format(remarks, "blur: no tile of a scene goes without: little of its time is that "
                                "of ways through the lens\n");
    }
    growing_format(remarks,
                   "uniform: %" PRIu64 " of %" PRIu64
                   " tiles see the same light everywhere: no rays%s\n",
                   tiles[SPARE_EVEN], all, or_kept(question, SKIP_UNIFORM));
}

/* What a scene goes without. */
static void explain_scene(const struct photograph_question *question, struct growing *remarks)
{
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

/* Why exposures are not of one picture; null: they are. */
static const char *why_anew(const struct artifact_job *job,
                            const struct photograph_question *question)
{
    return render_shutter_varies(job) ? "how a leaf shutter weighs the pupil depends on the time"
           : job->count > 1 && question->duration > 0 && !skip_is_kept(question->kept, SKIP_TIME)
               ? "how far things move depends on the time"
               : NULL;
}

void render_explain(const struct artifact_job *job, const struct photograph_question *question,
                    const struct photograph *photograph, struct growing *remarks)
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
    explain_tiles(question, tiles, remarks);
    growing_format(remarks, "time: %s%s\n",
                   question->duration > 0 ? "each ray has its own"
                                          : "all rays come at once: nothing depends on it",
                   or_kept(question, SKIP_TIME));
    if (question->view != NULL) {
        explain_scene(question, remarks);
    }
    const char *anew = why_anew(job, question);
    growing_format(remarks, "exposures: %zu%s%s%s\n", job->count,
                   anew != NULL ? ", a picture each: " : " of one picture",
                   anew != NULL ? anew : "", or_kept(question, SKIP_EXPOSURES));
}
