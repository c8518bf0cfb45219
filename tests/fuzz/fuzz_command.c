/* tests/fuzz/fuzz_command.c - whole commands: a byte for which, one for the ending, the file. */
/* SPDX-License-Identifier: MIT */
#define _GNU_SOURCE /* memfd_create */
#include "ask.h"

/* What is asked of the file, `@`; kept short, since thousands a minute are to be tried. */
static const char *const questions[] = {
    "lens @ --json",
    "lens @ --position all",
    "surfaces @ --json",
    "check @ --json --steps 2",
    "draw @",
    "pupil @ --json",
    "trace @ --json --pattern gauss --rays 12",
    "conjugate @ --object 2m --json",
    "dof --lens @ -N 8 -s 3 --json",
    "seidel @ --json",
    "spot @ --json --rays 12",
    "field @ --json",
    "distortion @ --json",
    "fan @ --json --points 3",
    "convert @",
    "convert @ --to zmx --lossy",
    "convert @ --to json",
    "optimize @ --vary all-R --rays 12 --iterations 3 --json",
    "fit @ --json --rays 12",
    "fit --glass @ --json",
    "dof --batch @ --json",
    "hyperfocal --batch @ -N 8",
    "exposure --batch @ --csv",
};
static const char *const endings[] = {"lens", "json", "zmx", "seq", "len", "dat", "csv", "jsonl"};

enum { QUESTIONS = sizeof questions / sizeof questions[0] };

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size < 2) {
        return 0;
    }
    const char *ending = endings[data[1] % (sizeof endings / sizeof endings[0])];
    char question[ASK_LONGEST];
    struct arena arena = {0};
    ask_file(ending, data + 2, size - 2);
    const char *asked = questions[data[0] % QUESTIONS], *file = strchr(asked, '@') + 1;
    snprintf(question, sizeof question, "%.*s%s%s", (int)(file - asked), asked, ending, file);
    ask(question, (struct text){(const char *)data, size}, &arena);
    ask_take(ending, &arena);
    arena_free(&arena);
    return 0;
}
