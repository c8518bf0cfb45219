/* main.c - argv to command to exit status. */
/* SPDX-License-Identifier: MIT */
#include "cli/answer/complain.h"
#include "cli/answer/driver.h"
#include "cli/question/command.h"
#include "commands/commands.h"
#include "commands/tool/overview.h"
#include "report/version.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static int print_version(void)
{
    static const char line[] = "lenscalc " LENSCALC_VERSION "\n";
    if (write(STDOUT_FILENO, line, sizeof line - 1) != (ssize_t)(sizeof line - 1)) {
        if (errno == EPIPE) {
            return ERROR_PIPE;
        }
        fprintf(stderr, "lenscalc: cannot write to standard output: %s\n", strerror(errno));
        return ERROR_IO;
    }
    return 0;
}

static bool is_list(const char *name)
{
    const struct command *list = command_find(text_of("list"));
    size_t i = 0;
    while (option_word(&list->options[0], i) != NULL &&
           strcmp(option_word(&list->options[0], i)->word, name) != 0) {
        i++;
    }
    return option_word(&list->options[0], i) != NULL;
}

/* The command that the word goes with: an option of the program, a list, a topic of help. */
static const char *meant_with(const char *name)
{
    if (strcmp(name, "version") == 0) {
        return "--";
    }
    if (is_list(name)) {
        return "list ";
    }
    return help_topic_find(name) != NULL ? "help " : NULL;
}

/* The first command whose summary has the word in it, as "telescope" has; null: none. */
static const struct command *command_about(const char *name)
{
    enum { SHORTEST = 4 };
    const struct text word = text_of(name);
    size_t i = 0;
    while (commands[i] != NULL &&
           (word.length < SHORTEST || !text_contains_name(text_of(commands[i]->summary), word))) {
        i++;
    }
    return commands[i];
}

static int unknown_command(const char *name)
{
    struct error error;
    struct nearest nearest = {.typed = text_of(name)};
    for (size_t i = 0; commands[i] != NULL; i++) {
        nearest_offer(&nearest, text_of(commands[i]->name));
    }
    fail(&error, ERROR_USAGE, "unknown %s '%.60s'", name[0] == '-' ? "option" : "command", name);
    if (meant_with(name) != NULL) {
        error_hint(&error, "see 'lenscalc %s%s'", meant_with(name), name);
    } else if (nearest.best.start != NULL) {
        error_hint(&error, "did you mean '%.*s'?", (int)nearest.best.length, nearest.best.start);
    } else if (command_about(name) != NULL) {
        error_hint(&error, "see 'lenscalc %s': %s", command_about(name)->name,
                   command_about(name)->summary);
    } else {
        error_hint(&error, "see 'lenscalc help'");
    }
    error_print(&error, NULL, COLOR_AUTO);
    return ERROR_USAGE;
}

/*
 * Who starts the program with one of its three streams closed would have the first file that it
 * opens take that place, and what is said on the stream go into the file. Something is put there
 * that refuses to be read from (standard input) or written to, as what is closed does.
 */
static bool occupy_streams(void)
{
    bool done = true;
    for (int i = STDIN_FILENO; i <= STDERR_FILENO && done; i++) {
        done = fcntl(i, F_GETFD) >= 0 ||
               open("/dev/null", i == STDIN_FILENO ? O_WRONLY : O_RDONLY) == i;
    }
    return done;
}

int main(int argc, char **argv)
{
    /* a pipe that nobody reads and a file that may not grow are failed writes: files are settled
       before the program ends */
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN);
    if (!occupy_streams()) {
        return ERROR_IO; /* and nowhere to say so */
    }
    if (argc < 2) {
        help_short();
        return ERROR_USAGE;
    }
    if (strcmp(argv[1], "--version") == 0 || strcmp(argv[1], "-V") == 0) {
        return print_version();
    }
    bool wants_help = strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0;
    const struct command *command = command_find(text_of(wants_help ? "help" : argv[1]));
    if (command == NULL) {
        return unknown_command(argv[1]);
    }
    const char *database = getenv("LENSCALC_DB");
    if (database != NULL && database[0] == '\0') {
        database = NULL;
    }
    return command_execute(command_asked(command, argc - 2, argv + 2), commands, argc, argv,
                           database);
}
