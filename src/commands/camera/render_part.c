/* commands/camera/render_part.c - parts of a picture: their tiles in files, and back. */
/* SPDX-License-Identifier: MIT */
#include "commands/camera/render_part.h"

#include "base/image/bytes.h"

#include <inttypes.h>
#include <string.h>
#include <time.h>

/*
 * A part's body: what was counted, eight bytes each; a byte a tile that says whether it is there;
 * and those that are, a float a channel.
 */
enum {
    TILE_FLOATS = PHOTOGRAPH_PIXELS * PHOTOGRAPH_CHANNELS,
    TILE_BYTES = 4 * TILE_FLOATS,
    COUNT_BYTES = 8 * PHOTOGRAPH_COUNTS,
    SAVED_EVERY = 30 /* s, while it is worked on */
};
enum tile { TILE_WANTED, TILE_DONE, TILE_ELSEWHERE };

bool render_is_part(const struct artifact_job *job)
{
    return job->type == division_types(0);
}

bool render_check_part(const struct artifact_job *job, struct error *error)
{
    const struct render_input *input = job->inputs[0];
    if (job->run->parts != NULL) {
        return !render_is_part(job) ||
               fail(error, ERROR_USAGE, "a merged picture is whole: %s is the name of a part",
                    job->path);
    }
    if (!render_is_part(job)) {
        const char *option = SAID_FIRST({input->part.count > 0, "part"}, {input->resume, "resume"});
        return option == NULL ||
               fail(error, ERROR_USAGE, "{--%s} needs {--output} with a name that ends in .part",
                    option);
    }
    static const char *const of_wholes[] = {"rays", "explain", "seconds"};
    for (size_t i = 0; i < sizeof of_wholes / sizeof of_wholes[0]; i++) {
        if (asking_given(job->asking, of_wholes[i])) {
            return fail(error, ERROR_USAGE,
                        "{--%s} is not of parts: {--output} FILE.part makes one", of_wholes[i]);
        }
    }
    return true;
}

/* What a result depends on besides words and files: glasses, formats, films. */
static bool find_facts(const struct render_input *input, const struct analysis_case *one,
                       struct text_buffer *facts, struct error *error)
{
    const struct setup *setup = one->setup;
    for (size_t w = 0; w < setup->wavelength_count; w++) {
        struct setup_light light;
        if (!setup_light(setup, w, &light, error)) {
            return false;
        }
        growing_format(facts, "%a %a ", light.first.power, light.first.bfl);
    }
    growing_format(facts, "%a %a %a %a", setup->image, input->sensor.size.width,
                   input->sensor.size.height, render_is_film(input) ? input->film.speed : 0);
    return true;
}

/* The files whose tiles are there already. */
static bool find_files(struct render_part *part, struct error *error)
{
    const struct artifact_job *job = part->job;
    const struct render_input *input = job->inputs[0];
    if (!division_found(job->run, &part->head, input->resume ? job->path : NULL, &part->files,
                        &part->file_count, error)) {
        return false;
    }
    for (size_t i = 0; i < part->file_count; i++) {
        /* What a file holds of its tiles: its flags and its length must agree with its head. */
        const struct part_file *file = &part->files[i];
        const struct part_range range = part_range(file->head.part, file->head.total);
        const size_t tiles = (size_t)(range.end - range.begin);
        size_t there = 0;
        for (size_t k = 0; k < tiles && COUNT_BYTES + k < file->body.length; k++) {
            there += file->body.start[COUNT_BYTES + k] == TILE_DONE;
        }
        if (there != file->head.done ||
            file->body.length != COUNT_BYTES + tiles + there * TILE_BYTES) {
            return fail(error, ERROR_DATA, "%s: its tiles are not those that its head says",
                        file->path);
        }
    }
    return true;
}

/* Tiles that are there already go into the picture, once. */
static void part_image_fill(struct render_part *part, struct photograph *photograph)
{
    for (size_t i = 0; i < part->file_count && !part->is_filled; i++) {
        const struct part_file *file = &part->files[i];
        const struct part_range range = part_range(file->head.part, file->head.total);
        const unsigned char *body = (const unsigned char *)file->body.start;
        const unsigned char *flags = body + COUNT_BYTES;
        const unsigned char *from = flags + (range.end - range.begin);
        for (int k = 0; k < PHOTOGRAPH_COUNTS; k++) {
            part->counts[k] += bytes_little(body + 8 * k, 8);
        }
        for (size_t tile = range.begin; tile < range.end; tile++) {
            float pixels[PHOTOGRAPH_PIXELS][PHOTOGRAPH_CHANNELS];
            if (flags[tile - range.begin] != TILE_DONE) {
                continue;
            }
            for (size_t k = 0; k < TILE_FLOATS; k++, from += 4) {
                pixels[k / PHOTOGRAPH_CHANNELS][k % PHOTOGRAPH_CHANNELS] =
                    bytes_float((uint32_t)bytes_little(from, 4));
            }
            photograph_tile(part->question, &photograph->image, tile, TILE_TO_PICTURE, pixels);
        }
    }
    part->is_filled = true;
}

static void part_write_file(struct render_part *part, struct photograph *photograph,
                            struct output *sink)
{
    struct arena arena = {0};
    part_image_fill(part, photograph);
    /* The bytes of the part's file but its head, whose `done` is set. */
    const size_t own = (size_t)(part->own.end - part->own.begin);
    struct bytes bytes = {.arena = &arena};
    part->head.done = 0;
    for (int k = 0; k < PHOTOGRAPH_COUNTS; k++) {
        bytes_put_little(&bytes, photograph->counts[k] + part->counts[k], 8);
    }
    for (size_t tile = part->own.begin; tile < part->own.end; tile++) {
        bytes_put_little(&bytes, part->done[tile], 1);
        part->head.done += part->done[tile] == TILE_DONE;
    }
    bytes_room(&bytes, own * TILE_BYTES);
    for (size_t tile = part->own.begin; tile < part->own.end; tile++) {
        float pixels[PHOTOGRAPH_PIXELS][PHOTOGRAPH_CHANNELS];
        if (part->done[tile] == TILE_DONE) {
            photograph_tile(part->question, &photograph->image, tile, TILE_FROM_PICTURE, pixels);
            for (size_t k = 0; k < TILE_FLOATS; k++) {
                const float value = pixels[k / PHOTOGRAPH_CHANNELS][k % PHOTOGRAPH_CHANNELS];
                bytes_put_little(&bytes, bytes_bits(value), 4);
            }
        }
    }
    division_write(&part->head, bytes_text(&bytes), &arena, sink);
    arena_free(&arena);
}

/* What there is so far is saved now and then: who is killed loses little. */
static void part_save(void *context, struct photograph *photograph)
{
    struct render_part *part = context;
    struct arena arena = {0};
    struct output sink;
    struct error ignored; /* what cannot be written is said at the end */
    if (time(NULL) < part->saved + SAVED_EVERY) {
        return;
    }
    part->saved = time(NULL);
    if (output_open(&sink, part->job->path, &arena, &ignored)) {
        part_write_file(part, photograph, &sink);
        output_close(&sink, true, &ignored);
    }
    arena_free(&arena);
}

bool render_part_begin(const struct artifact_job *job, const struct analysis_case *one,
                       const char *scene, struct photograph_question *question,
                       struct render_part *part, struct error *error)
{
    const struct render_input *input = job->inputs[0];
    struct text_buffer facts = {.arena = job->run->arena};
    *part = (struct render_part){.job = job, .question = question};
    if (!render_is_part(job) && job->run->parts == NULL) {
        return true;
    }
    part->tiles = photograph_tiles(question);
    struct division division = {.part = {1, 1}, .seed = question->seed, .total = part->tiles};
    if (job->run->parts != NULL) {
        division.part.count = job->run->parts[0].head.part.count;
    } else if (input->part.count > 0) {
        division.part = input->part;
    }
    if (!find_facts(input, one, &facts, error)) {
        return false;
    }
    growing_format(&facts, " %s", scene);
    division.facts = growing_done(&facts);
    part->own = part_range(division.part, division.total);
    if (!division_head(job->run, &division, &part->head, error) || !find_files(part, error)) {
        return false;
    }
    part->done = ARENA_ARRAY(job->run->arena, part->tiles, unsigned char);
    part->saved = time(NULL);
    /* Which tiles are to be taken. */
    const bool is_merged = part->job->run->parts != NULL;
    for (size_t i = 0; i < part->file_count; i++) {
        const struct part_file *file = &part->files[i];
        const struct part_range range = part_range(file->head.part, file->head.total);
        memcpy(part->done + range.begin, file->body.start + COUNT_BYTES, range.end - range.begin);
    }
    for (size_t tile = 0; tile < part->tiles; tile++) {
        if (part->done[tile] != TILE_DONE) {
            const bool is_own = tile >= part->own.begin && tile < part->own.end && !is_merged;
            part->done[tile] = is_own ? TILE_WANTED : TILE_ELSEWHERE;
        }
    }
    question->done = part->done;
    if (render_is_part(job)) {
        question->pause = part_save;
        question->pauser = part;
    }
    return true;
}

void render_part_fill(struct render_part *part, struct photograph *photograph)
{
    part_image_fill(part, photograph);
    for (size_t tile = 0; tile < part->tiles; tile++) {
        photograph->is_incomplete = photograph->is_incomplete || part->done[tile] != TILE_DONE;
    }
    for (int k = 0; k < PHOTOGRAPH_COUNTS; k++) {
        photograph->counts[k] += part->counts[k];
    }
}

void render_part_write(struct render_part *part, struct photograph *photograph, struct output *sink)
{
    struct run *run = part->job->run;
    const struct part_head *head = &part->head;
    part_write_file(part, photograph, sink);
    const bool has_none = part->own.end == part->own.begin;
    if (photograph->is_incomplete) {
        fail(&run->shortfall, ERROR_DOMAIN,
             "interrupted: %s is incomplete, %" PRIu64 " of %" PRIu64
             " tiles; the same with {--resume} goes on",
             part->job->path, head->done, part->own.end - part->own.begin);
        return;
    }
    sink->remarks =
        text_of(has_none ? arena_printf(run->arena, "part %ld/%ld: none of %zu tiles\n",
                                        head->part.number, head->part.count, part->tiles)
                         : arena_printf(run->arena,
                                        "part %ld/%ld: tiles %" PRIu64 " to %" PRIu64 " of %zu\n",
                                        head->part.number, head->part.count, part->own.begin + 1,
                                        part->own.end, part->tiles));
}
