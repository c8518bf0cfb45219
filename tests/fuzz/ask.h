/* tests/fuzz/ask.h - a whole command asked in this process, and what every answer must be. */
/* SPDX-License-Identifier: MIT */
/*
 * The files that a question reads are written to memory, and so are those that it makes. In a
 * question `@lens` stands for the file with this ending, read or made. SHOW=1 in the environment
 * prints files, question and answer, to see what an input of bytes asks: SHOW=1 fuzz_odd FILE.
 */
#ifndef LENSCALC_TESTS_FUZZ_ASK_H
#define LENSCALC_TESTS_FUZZ_ASK_H

#include "base/json_read.h"
#include "cli/answer/driver.h"
#include "cli/question/command.h"
#include "commands/commands.h"
#include "fuzz.h"

#include <ctype.h>
#include <fcntl.h>
#include <sanitizer/common_interface_defs.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

enum { ASK_WORDS = 48, ASK_LONGEST = 1024, ASK_PATH = 64 };

static char ask_stem[ASK_PATH]; /* of the files, up to the ending */
static int ask_error, ask_said; /* standard error as it was; a file for what is said */

static inline void ask_begin(void)
{
    if (ask_stem[0] != '\0') {
        return;
    }
    snprintf(ask_stem, sizeof ask_stem, "/dev/shm/lenscalc-fuzz-%d.", (int)getpid());
    ask_error = dup(STDERR_FILENO);
    ask_said = memfd_create("said", MFD_CLOEXEC);
    const int printed = memfd_create("printed", 0);
    REQUIRE(ask_error >= 0 && ask_said >= 0 && printed >= 0);
    REQUIRE(dup2(printed, STDOUT_FILENO) == STDOUT_FILENO);
    __sanitizer_set_report_fd((void *)(intptr_t)ask_error);
}

static inline const char *ask_path(const char *ending, char room[2 * ASK_PATH])
{
    snprintf(room, 2 * ASK_PATH, "%s%s", ask_stem, ending);
    return room;
}

/* What a descriptor's file holds; it is emptied. */
static inline struct text ask_drain(int file, struct arena *arena)
{
    const off_t length = lseek(file, 0, SEEK_END);
    char *content = arena_array(arena, (size_t)length + 1, 1);
    REQUIRE(pread(file, content, (size_t)length, 0) == length);
    REQUIRE(ftruncate(file, 0) == 0 && lseek(file, 0, SEEK_SET) == 0);
    return (struct text){content, (size_t)length};
}

static inline void ask_show(const char *title, struct text text)
{
    if (getenv("SHOW") != NULL) {
        dprintf(ask_error, "--- %s\n%.*s\n", title, (int)text.length, text.start);
    }
}

/* Write a file that questions may read. */
static inline void ask_file(const char *ending, const void *content, size_t size)
{
    char path[2 * ASK_PATH];
    ask_begin();
    const int file = open(ask_path(ending, path), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    REQUIRE(file >= 0 && write(file, content, size) == (ssize_t)size);
    close(file);
    ask_show(ending, (struct text){content, size});
}

/* Take a file away, read or made. Result: what it held, a NUL behind it */
static inline struct text ask_take(const char *ending, struct arena *arena)
{
    char path[2 * ASK_PATH];
    struct text content = {"", 0};
    const int file = open(ask_path(ending, path), O_RDWR);
    if (file >= 0) {
        content = ask_drain(file, arena);
        close(file);
        unlink(path);
    }
    return content;
}

/* The words of a question, files in their places. Result: how many */
static inline int ask_words(const char *question, struct arena *arena, char **words)
{
    char *room = arena_array(arena, ASK_LONGEST, 1);
    REQUIRE(strlen(question) < ASK_LONGEST);
    strcpy(room, question);
    int count = 0;
    words[count++] = "lenscalc";
    for (char *word = strtok(room, " "); word != NULL; word = strtok(NULL, " ")) {
        REQUIRE(count + 1 < ASK_WORDS);
        if (word[0] == '@') {
            const char *path = ask_path(word + 1, arena_array(arena, 2 * ASK_PATH, 1));
            words[count++] = strcpy(arena_array(arena, 2 * ASK_PATH, 1), path);
        } else {
            words[count++] = word;
        }
    }
    words[count] = NULL;
    return count;
}

/* No number of an answer is none; but a file that says it is repeated. */
static inline bool ask_says_nan(struct text text, bool as_word)
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

static inline struct text ask_seconds(clock_t begun, struct arena *arena)
{
    char *text = arena_array(arena, 32, 1);
    snprintf(text, 32, "%.2f", (double)(clock() - begun) / CLOCKS_PER_SEC);
    return text_of(text);
}

/*
 * Ask, and require of the answer what holds for all of them.
 *
 * Given     question  its words, the command first
 *           asked     what the fuzzer wrote, which answers may repeat
 * Result    what is printed, in the arena
 */
static inline struct text ask(const char *question, struct text asked, struct arena *arena)
{
    char *words[ASK_WORDS];
    struct error error = {0};
    ask_begin();
    ask_show("question", text_of(question));
    const int count = ask_words(question, arena, words);
    const clock_t begun = clock();
    REQUIRE(dup2(ask_said, STDERR_FILENO) == STDERR_FILENO);
    const int status =
        command_execute(command_asked(command_find(text_of(words[1])), count - 2, words + 2),
                        commands, count, words, NULL);
    fflush(stderr);
    REQUIRE(dup2(ask_error, STDERR_FILENO) == STDERR_FILENO);
    const struct text printed = ask_drain(STDOUT_FILENO, arena), said = ask_drain(ask_said, arena);
    ask_show("printed", printed);
    ask_show("said", said);
    ask_show("seconds of the processor", ask_seconds(begun, arena));
    const bool may_say_nan = ask_says_nan(asked, false);
    const bool has_zero = memchr(asked.start, '\0', asked.length) != NULL;
    REQUIRE(status >= 0 && status <= ERROR_IO);
    REQUIRE(status == 0 || memmem(said.start, said.length, "lenscalc: ", 10) != NULL);
    REQUIRE(memchr(said.start, '\033', said.length) == NULL);
    REQUIRE(may_say_nan || (!ask_says_nan(printed, true) && !ask_says_nan(said, true)));
    /* the reader takes no \u0000, which cells of a batch may hold */
    if (strstr(question, "--json") != NULL && printed.length > 0 && !has_zero) {
        struct json json = json_open(printed, arena, &error);
        struct json_value tree;
        REQUIRE(json_tree(&json, &tree));
    }
    return printed;
}

#endif
