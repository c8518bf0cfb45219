/* tests/fuzz/fuzz_command.c - whole commands: a byte for which, one for the ending, the file. */
/* SPDX-License-Identifier: MIT */
#define _GNU_SOURCE /* memfd_create */
#include "base/json_read.h"
#include "cli/answer/driver.h"
#include "cli/question/command.h"
#include "commands/commands.h"
#include "fuzz.h"

#include <ctype.h>
#include <fcntl.h>
#include <sanitizer/common_interface_defs.h>
#include <sys/mman.h>
#include <unistd.h>

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

enum { QUESTIONS = sizeof questions / sizeof questions[0], MOST_WORDS = 16 };

static char path[64];
static int kept[2]; /* standard error as it was; a file for what is said */

/* The words of a question, the file in its place. Result: how many */
static int cut(const char *question, char *room, char **words)
{
    int count = 0;
    words[count++] = strcpy(room, "lenscalc");
    room = strcpy(room + sizeof "lenscalc", question);
    for (char *word = strtok(room, " "); word != NULL; word = strtok(NULL, " ")) {
        words[count++] = strcmp(word, "@") == 0 ? path : word;
    }
    return count;
}

/* What a descriptor's file holds; it is emptied. */
static struct text drain(int file, struct arena *arena)
{
    const off_t length = lseek(file, 0, SEEK_END);
    char *content = arena_array(arena, (size_t)length + 1, 1);
    REQUIRE(pread(file, content, (size_t)length, 0) == length);
    REQUIRE(ftruncate(file, 0) == 0 && lseek(file, 0, SEEK_SET) == 0);
    return (struct text){content, (size_t)length};
}

/* No number of an answer is none; but a file that says it is repeated. */
static bool says_nan(struct text text, bool as_word)
{
    for (size_t i = 0; i + 3 <= text.length; i++) {
        const bool begins = i == 0 || !isalpha((unsigned char)text.start[i - 1]);
        const bool ends = i + 3 == text.length || !isalpha((unsigned char)text.start[i + 3]);
        if ((!as_word || (begins && ends)) && strncasecmp(text.start + i, "nan", 3) == 0) {
            return true;
        }
    }
    return false;
}

static void judge(const char *question, int status, struct text printed, struct text said,
                  struct text asked, struct arena *arena)
{
    struct error error = {0};
    const bool may_say_nan = says_nan(asked, false);
    const bool has_zero = memchr(asked.start, '\0', asked.length) != NULL;
    REQUIRE(status >= 0 && status <= ERROR_IO);
    REQUIRE(status == 0 || memmem(said.start, said.length, "lenscalc: ", 10) != NULL);
    REQUIRE(memchr(said.start, '\033', said.length) == NULL);
    REQUIRE(may_say_nan || (!says_nan(printed, true) && !says_nan(said, true)));
    /* the reader takes no \u0000, which cells of a batch may hold */
    if (strstr(question, "--json") != NULL && printed.length > 0 && !has_zero) {
        struct json json = json_open(printed, arena, &error);
        struct json_value tree;
        REQUIRE(json_tree(&json, &tree));
    }
}

static void begin(void)
{
    snprintf(path, sizeof path, "/dev/shm/lenscalc-fuzz-%d.", (int)getpid());
    kept[0] = dup(STDERR_FILENO);
    kept[1] = memfd_create("said", MFD_CLOEXEC);
    const int printed = memfd_create("printed", 0);
    REQUIRE(kept[0] >= 0 && kept[1] >= 0 && printed >= 0);
    REQUIRE(dup2(printed, STDOUT_FILENO) == STDOUT_FILENO);
    __sanitizer_set_report_fd((void *)(intptr_t)kept[0]);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static size_t stem;
    if (stem == 0) {
        begin();
        stem = strlen(path);
    }
    if (size < 2) {
        return 0;
    }
    const char *question = questions[data[0] % QUESTIONS];
    strcpy(path + stem, endings[data[1] % (sizeof endings / sizeof endings[0])]);
    const int file = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    REQUIRE(file >= 0 && write(file, data + 2, size - 2) == (ssize_t)(size - 2));
    close(file);
    char room[128], *words[MOST_WORDS];
    const int count = cut(question, room, words);
    struct arena arena = {0};
    REQUIRE(dup2(kept[1], STDERR_FILENO) == STDERR_FILENO);
    const int status =
        command_execute(command_asked(command_find(text_of(words[1])), count - 2, words + 2),
                        commands, count, words, NULL);
    fflush(stderr);
    REQUIRE(dup2(kept[0], STDERR_FILENO) == STDERR_FILENO);
    const struct text printed = drain(STDOUT_FILENO, &arena), said = drain(kept[1], &arena);
    judge(question, status, printed, said, (struct text){(const char *)data, size}, &arena);
    unlink(path);
    arena_free(&arena);
    return 0;
}
