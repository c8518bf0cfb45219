/* tests/mutate/reach.c - notes in a shared file which functions a test enters. */
/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include <fcntl.h>
#include <stdint.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

/* where the library begins, by the linker */
extern const char __ehdr_start[] __attribute__((visibility("hidden")));

static unsigned char *entered;
static size_t entered_size;

/* TESTED_REACH names a file with one byte for every 2^4 bytes of the library (a name that begins
 * with LENSCALC the harness keeps from programs) */
__attribute__((constructor, no_instrument_function)) static void open_map(void)
{
    const char *name = getenv("TESTED_REACH");
    int file = name ? open(name, O_RDWR) : -1;
    if (file < 0) {
        return;
    }
    entered_size = (size_t)lseek(file, 0, SEEK_END);
    void *map = mmap(NULL, entered_size, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    entered = map == MAP_FAILED ? NULL : map;
    close(file);
}

/* the compiler calls it at the start of every function: -finstrument-functions, functions at
 * multiples of 16 by -falign-functions */
__attribute__((no_instrument_function)) void __cyg_profile_func_enter(void *function, void *site)
{
    size_t at = ((uintptr_t)function - (uintptr_t)__ehdr_start) >> 4;
    (void)site;
    if (entered && at < entered_size) {
        entered[at] = 1;
    }
}

__attribute__((no_instrument_function)) void __cyg_profile_func_exit(void *function, void *site)
{
    (void)function;
    (void)site;
}
