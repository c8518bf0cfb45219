/* exchange/metadata/photo_file.c - files that are photographs. */
/* SPDX-License-Identifier: MIT */
#include "exchange/metadata/photo_file.h"

#include "base/file_type.h"
#include "base/image/exif.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Of JPEG, TIFF, HEIF, and raw files of Adobe, Canon, Nikon, Sony, Fujifilm, Panasonic, Leica,
   Olympus, OM System, Pentax, Samsung, Sigma, Hasselblad, Phase One, Leaf, Mamiya, Minolta, Kodak,
   Epson and GoPro. Those that the program reads itself stand first. */
static const char endings[][6] = {".jpg", ".jpeg", ".jpe", ".tif", ".tiff", ".heic", ".heif",
                                  ".hif", ".dng",  ".cr3", ".cr2", ".crw",  ".nef",  ".nrw",
                                  ".arw", ".sr2",  ".srf", ".raf", ".rw2",  ".rwl",  ".orf",
                                  ".ori", ".pef",  ".srw", ".x3f", ".3fr",  ".fff",  ".iiq",
                                  ".mos", ".mef",  ".mrw", ".dcr", ".kdc",  ".erf",  ".gpr"};
enum { ENDINGS = sizeof endings / sizeof endings[0], PLAIN_ENDINGS = 5 };

const char *photo_ending(struct text path)
{
    size_t i = 0;
    while (i < ENDINGS && !file_type_ends(path, endings[i])) {
        i++;
    }
    return i < ENDINGS ? endings[i] : NULL;
}

bool photo_is_plain(const char *ending)
{
    return ending < endings[PLAIN_ENDINGS];
}

/* A file that is read here and there. */
struct photo_source {
    int descriptor;
    int *reason; /* errno of a read that failed; 0 = none has, the end of the file is no failure */
};

static bool file_bytes(const void *context, size_t at, void *into, size_t count)
{
    const struct photo_source *source = context;
    size_t got = 0;
    while (got < count) {
        const ssize_t more =
            pread(source->descriptor, (char *)into + got, count - got, (off_t)(at + got));
        if (more == 0 || (more < 0 && errno != EINTR)) {
            *source->reason = more < 0 ? errno : *source->reason;
            return false;
        }
        got += more > 0 ? (size_t)more : 0;
    }
    return true;
}

bool photo_file_read(const char *path, struct metadata *metadata, struct error *error)
{
    struct stat file;
    const int descriptor = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0 || fstat(descriptor, &file) != 0) {
        fail(error, ERROR_IO, "cannot read it: %s", strerror(errno));
        if (descriptor >= 0) {
            close(descriptor);
        }
        return false;
    }
    int reason = 0;
    const struct photo_source source = {descriptor, &reason};
    const struct exif_bytes bytes = {
        .read = file_bytes, .context = &source, .length = (size_t)file.st_size};
    const bool done = S_ISREG(file.st_mode) ? exif_read(&bytes, metadata, error)
                                            : fail(error, ERROR_DATA, "this is no regular file");
    close(descriptor);
    return reason == 0 ? done : fail(error, ERROR_IO, "cannot read it: %s", strerror(reason));
}
