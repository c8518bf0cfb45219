/* report/terminal_query.c - which pictures a terminal can show: it is asked. */
/* SPDX-License-Identifier: MIT */
#ifdef __linux__
#define _DEFAULT_SOURCE /* TIOCGWINSZ */
#endif
#include "report/terminal_query.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>

const struct word graphics_words[] = {
    {"auto", "sixel or kitty if the terminal says that it can, else blocks"},
    {"blocks", "characters: Braille dots and half blocks"},
    {"sixel", "sixel graphics"},
    {"kitty", "the graphics protocol of kitty"},
    {NULL, NULL},
};

enum { PATIENCE = 100, ANSWER_MOST = 512 }; /* ms, bytes */

/* A picture of one pixel that kitty only looks at; the size of a cell; what all terminals answer,
   last: their attributes. */
static const char question[] = "\033_Gi=31,s=1,v=1,a=q,t=d,f=24;AAAA\033\\\033[16t\033[c";

/* Where "\033[?62;4c" begins; null: not yet whole. */
static const char *find_attributes(const char *answer)
{
    const char *begin = strstr(answer, "\033[?");
    return begin != NULL && begin[3 + strspn(begin + 3, "0123456789;")] == 'c' ? begin + 3 : NULL;
}

static long milliseconds_since(const struct timespec *begun)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (long)(now.tv_sec - begun->tv_sec) * 1000 + (now.tv_nsec - begun->tv_nsec) / 1000000;
}

/* What it answers until it has told its attributes, or the time is over. */
static void answer_read(int terminal, char *answer)
{
    struct timespec begun;
    size_t length = 0;
    clock_gettime(CLOCK_MONOTONIC, &begun);
    while (length + 1 < ANSWER_MOST && find_attributes(answer) == NULL) {
        const long left = PATIENCE - milliseconds_since(&begun);
        struct pollfd waiting = {.fd = terminal, .events = POLLIN};
        if (left <= 0 || poll(&waiting, 1, (int)left) <= 0) {
            return;
        }
        const ssize_t got = read(terminal, answer + length, ANSWER_MOST - 1 - length);
        if (got <= 0) {
            return;
        }
        length += (size_t)got;
        answer[length] = '\0';
    }
}

static struct terminal_answer answer_parse(const char *answer)
{
    struct terminal_answer found = {.has_sixel = false};
    const char *attributes = find_attributes(answer), *size = strstr(answer, "\033[6;");
    unsigned high = 0, wide = 0;
    char ending = '\0';
    found.has_kitty = strstr(answer, "\033_Gi=31;OK") != NULL;
    while (attributes != NULL && *attributes != 'c') {
        const size_t length = strspn(attributes, "0123456789");
        found.has_sixel = found.has_sixel || (length == 1 && *attributes == '4');
        attributes += length + (attributes[length] == ';');
    }
    const unsigned largest = 1000; /* px; who says more says nonsense */
    if (size != NULL && sscanf(size, "\033[6;%4u;%4u%c", &high, &wide, &ending) == 3 &&
        ending == 't' && high <= largest && wide <= largest) {
        found.cell_width = wide;
        found.cell_height = high;
    }
    return found;
}

/* Hold back what would end or stop this program while the terminal's settings are others. */
static void signals_hold_for_terminal(sigset_t *usual)
{
    static const int all[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGTSTP, SIGTTOU, SIGTTIN};
    sigset_t held;
    sigemptyset(&held);
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        sigaddset(&held, all[i]);
    }
    sigprocmask(SIG_BLOCK, &held, usual);
}

struct terminal_answer terminal_ask(int descriptor)
{
    char answer[ANSWER_MOST] = "";
    const char *name = ttyname(descriptor), *kind = getenv("TERM");
    const struct terminal_answer none = {.has_sixel = false};
    struct termios usual, quiet;
    sigset_t signals;
    if (name == NULL || kind == NULL || strcmp(kind, "dumb") == 0) {
        return none;
    }
    const int terminal = open(name, O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (terminal < 0) {
        return none;
    }
    const pid_t foreground = tcgetpgrp(terminal);
    const bool may_ask = foreground < 0 || foreground == getpgrp();
    if (!may_ask || tcgetattr(terminal, &usual) != 0) {
        close(terminal);
        return none;
    }
    quiet = usual;
    quiet.c_lflag &= ~(tcflag_t)(ICANON | ECHO);
    quiet.c_cc[VMIN] = 0;
    quiet.c_cc[VTIME] = 0;
    signals_hold_for_terminal(&signals);
    if (tcsetattr(terminal, TCSANOW, &quiet) == 0) {
        if (write(terminal, question, sizeof question - 1) == (ssize_t)(sizeof question - 1)) {
            answer_read(terminal, answer);
        }
        tcsetattr(terminal, TCSANOW, &usual);
    }
    sigprocmask(SIG_SETMASK, &signals, NULL);
    close(terminal);
    return answer_parse(answer);
}

size_t terminal_rows(int descriptor)
{
    struct winsize size = {0};
    return isatty(descriptor) && ioctl(descriptor, TIOCGWINSZ, &size) == 0 ? size.ws_row : 0;
}

bool terminal_has_true_color(void)
{
    const char *depth = getenv("COLORTERM");
    return depth != NULL && (strcmp(depth, "truecolor") == 0 || strcmp(depth, "24bit") == 0);
}
