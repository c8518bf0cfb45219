/* cli/child.c - another program, started without a shell, and its end. */
/* SPDX-License-Identifier: MIT */
#include "cli/child.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

extern char **environ; /* POSIX leaves its declaration to the program */

enum { STREAMS = 2 };

/* What it writes, while that is read: standard output and standard error. */
struct child_stream {
    int from, to; /* ends of the pipe; -1 = closed */
    char *bytes;
    size_t count, room;
};

/* -------- interruptions -------- */

static const int ending[] = {SIGINT, SIGTERM, SIGHUP};
enum { ENDING = sizeof ending / sizeof ending[0] };

/*
 * Hold back the signals that would end this program, until the other one has been ended. What comes
 * meanwhile takes effect behind signals_release.
 *
 * Given     usual  receives the signals that were held back before
 */
static void signals_hold(sigset_t *usual)
{
    sigset_t held;
    sigemptyset(&held);
    for (size_t i = 0; i < ENDING; i++) {
        struct sigaction action;
        if (sigaction(ending[i], NULL, &action) == 0 && action.sa_handler != SIG_IGN) {
            sigaddset(&held, ending[i]);
        }
    }
    sigprocmask(SIG_BLOCK, &held, usual);
}

static void signals_release(const sigset_t *usual)
{
    sigprocmask(SIG_SETMASK, usual, NULL);
}

/* Has one come? Others that are held back were so before. */
static bool signal_waits(const sigset_t *usual)
{
    sigset_t waiting;
    bool found = false;
    sigpending(&waiting);
    for (size_t i = 0; i < ENDING && !found; i++) {
        found = sigismember(&waiting, ending[i]) == 1 && sigismember(usual, ending[i]) == 0;
    }
    return found;
}

/* -------- start -------- */

/*
 * One that is read is in a group of its own, so that all that it starts can be ended.
 *
 * Given     input  a descriptor that it reads; -1: nothing
 *           mask   the signals that are to be held back from it; null: as they are
 */
static int child_spawn(const struct child *child, int input, const struct child_stream *streams,
                       const sigset_t *mask, pid_t *id)
{
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;
    sigset_t usual;
    short flags = POSIX_SPAWN_SETSIGDEF;
    int failure = posix_spawn_file_actions_init(&files);
    if (failure != 0) {
        return failure;
    }
    failure = posix_spawnattr_init(&attributes);
    if (failure != 0) {
        posix_spawn_file_actions_destroy(&files);
        return failure;
    }
    if (input >= 0) {
        posix_spawn_file_actions_adddup2(&files, input, STDIN_FILENO);
    } else {
        posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    }
    if (child->is_read) {
        posix_spawn_file_actions_adddup2(&files, streams[0].to, STDOUT_FILENO);
        posix_spawn_file_actions_adddup2(&files, streams[1].to, STDERR_FILENO);
        posix_spawnattr_setsigmask(&attributes, mask);
        posix_spawnattr_setpgroup(&attributes, 0);
        flags |= POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP;
    } else {
        posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    }
    sigemptyset(&usual); /* this program ignores broken pipes; others need not */
    sigaddset(&usual, SIGPIPE);
    sigaddset(&usual, SIGXFSZ);
    posix_spawnattr_setsigdefault(&attributes, &usual);
    posix_spawnattr_setflags(&attributes, flags);
    failure = posix_spawnp(id, child->words[0], &files, &attributes, child->words, environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    return failure;
}

static void end_close(int *end)
{
    if (*end >= 0) {
        close(*end);
    }
    *end = -1;
}

static bool streams_open(struct child_stream *streams)
{
    bool done = true;
    for (size_t i = 0; i < STREAMS; i++) {
        streams[i] = (struct child_stream){.from = -1, .to = -1};
    }
    for (size_t i = 0; i < STREAMS && done; i++) {
        int ends[2];
        done = pipe(ends) == 0;
        if (done) {
            streams[i].from = ends[0];
            streams[i].to = ends[1];
            fcntl(ends[0], F_SETFD, FD_CLOEXEC);
            fcntl(ends[1], F_SETFD, FD_CLOEXEC);
        }
    }
    return done;
}

static void streams_close(struct child_stream *streams)
{
    for (size_t i = 0; i < STREAMS; i++) {
        end_close(&streams[i].from);
        end_close(&streams[i].to);
    }
}

/* -------- reading -------- */

/* What has arrived; the end of the stream closes it. */
static void stream_read(struct child_stream *stream, struct arena *arena)
{
    enum { BLOCK = 16384 };
    if (stream->room - stream->count < BLOCK) {
        const size_t more = stream->room + 2 * (size_t)BLOCK;
        stream->bytes = arena_copy(arena, stream->bytes, stream->count, more, 1);
        stream->room = stream->count + more;
    }
    const ssize_t got = read(stream->from, stream->bytes + stream->count, BLOCK);
    if (got > 0) {
        stream->count += (size_t)got;
    } else if (got == 0 || errno != EINTR) {
        end_close(&stream->from);
    }
}

static double seconds_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* A program that is read, while it runs. */
struct child_reading {
    const struct child *child;
    struct child_stream *streams;
    struct child_end *end;
    double begun;          /* of seconds_now */
    const sigset_t *usual; /* as signals_hold found them */
};

/* May it go on? It may not when its time is over, and where this program is to end. */
static bool reading_goes_on(const struct child_reading *reading)
{
    reading->end->is_late = seconds_now() - reading->begun >= reading->child->seconds;
    for (size_t i = 0; i < STREAMS; i++) {
        reading->end->is_long |= reading->streams[i].count > reading->child->most;
    }
    return !reading->end->is_late && !reading->end->is_long && !signal_waits(reading->usual);
}

/* Until both streams end. False: it is to be ended. */
static bool reading_follow(const struct child_reading *reading, struct arena *arena)
{
    enum { MOMENT = 50 }; /* ms, after which signals and the time are looked at */
    struct child_stream *const streams = reading->streams;
    while (streams[0].from >= 0 || streams[1].from >= 0) {
        struct pollfd waiting[STREAMS];
        for (size_t i = 0; i < STREAMS; i++) {
            waiting[i] = (struct pollfd){.fd = streams[i].from, .events = POLLIN};
        }
        if (!reading_goes_on(reading)) {
            return false;
        }
        const int ready = poll(waiting, STREAMS, MOMENT);
        for (size_t i = 0; i < STREAMS && ready > 0; i++) {
            if (waiting[i].revents != 0) {
                stream_read(&streams[i], arena);
            }
        }
    }
    return true;
}

/* It may go on though it has closed its streams. False: it is to be ended. */
static bool reading_wait(const struct child_reading *reading, pid_t id)
{
    enum { MOMENT = 5 }; /* ms */
    while (waitpid(id, &reading->end->status, WNOHANG) == 0) {
        if (!reading_goes_on(reading)) {
            return false;
        }
        poll(NULL, 0, MOMENT);
    }
    return true;
}

static void child_wait(pid_t id, int *status)
{
    while (waitpid(id, status, 0) < 0 && errno == EINTR) {
    }
}

static struct text first_line(struct text text)
{
    return text.length > 0 ? text_trim(text_cut(&text, '\n')) : text_of("");
}

static bool child_read(const struct child *child, int input, struct child_end *end,
                       struct arena *arena, struct error *error)
{
    struct child_stream streams[STREAMS];
    sigset_t usual;
    pid_t id;
    if (!streams_open(streams)) {
        const int reason = errno;
        streams_close(streams);
        return fail(error, ERROR_IO, "no pipe to read from %s: %s", child->words[0],
                    strerror(reason));
    }
    signals_hold(&usual);
    const int failure = child_spawn(child, input, streams, &usual, &id);
    end_close(&streams[0].to);
    end_close(&streams[1].to);
    if (failure == 0) {
        const struct child_reading reading = {child, streams, end, seconds_now(), &usual};
        if (!reading_follow(&reading, arena) || !reading_wait(&reading, id)) {
            kill(-id, SIGKILL);
            child_wait(id, &end->status);
        }
        end->output = (struct text){streams[0].bytes, streams[0].count};
        end->said = first_line((struct text){streams[1].bytes, streams[1].count});
    }
    streams_close(streams);
    signals_release(&usual);
    end->is_missing = failure == ENOENT;
    return failure == 0 || end->is_missing ||
           fail(error, ERROR_IO, "%s does not start: %s", child->words[0], strerror(failure));
}

/* -------- what it reads -------- */

static void input_close(FILE *input)
{
    if (input != NULL) {
        fclose(input);
    }
}

/* A temporary file of its input, which it reads from the beginning. */
static bool input_open(const struct child *child, FILE **input, struct error *error)
{
    const struct text text = child->input;
    *input = tmpfile();
    const bool done = *input != NULL && fcntl(fileno(*input), F_SETFD, FD_CLOEXEC) == 0 &&
                      fwrite(text.start, 1, text.length, *input) == text.length &&
                      fflush(*input) == 0 && fseek(*input, 0, SEEK_SET) == 0 &&
                      lseek(fileno(*input), 0, SEEK_SET) == 0;
    if (!done) {
        const int reason = errno;
        input_close(*input);
        *input = NULL;
        return fail(error, ERROR_IO, "no temporary file for what %s reads: %s", child->words[0],
                    strerror(reason));
    }
    return true;
}

bool child_run(const struct child *child, struct child_end *end, struct arena *arena,
               struct error *error)
{
    pid_t id;
    FILE *input = NULL;
    *end = (struct child_end){.output = {"", 0}, .said = {"", 0}};
    /* who ignores its children, as what started this program may do, is not told how they end */
    signal(SIGCHLD, SIG_DFL);
    if (child->input.start != NULL && !input_open(child, &input, error)) {
        return false;
    }
    const int from = input != NULL ? fileno(input) : -1;
    if (child->is_read) {
        const bool done = child_read(child, from, end, arena, error);
        input_close(input);
        return done;
    }
    const int failure = child_spawn(child, from, NULL, NULL, &id);
    input_close(input);
    if (failure != 0) {
        return fail(error, ERROR_IO, "%s does not start: %s", child->words[0], strerror(failure));
    }
    child_wait(id, &end->status);
    return true;
}

const char *child_status(const struct child_end *end, struct arena *arena)
{
    const bool is_killed = WIFSIGNALED(end->status);
    return arena_printf(arena, "%s %d", is_killed ? "signal" : "status",
                        is_killed ? WTERMSIG(end->status) : WEXITSTATUS(end->status));
}
