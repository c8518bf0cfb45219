/* exchange/metadata/photo_file.c - files that are photographs. */
/* SPDX-License-Identifier: MIT */
#include "exchange/metadata/photo_file.h"

#include "base/image/exif.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Those that the program reads itself stand first. */
static const struct file_type types[] = {
    {{"jpeg", "JPEG"}, ".jpg"},      {{"jpeg", "JPEG"}, ".jpeg"},
    {{"jpeg", "JPEG"}, ".jpe"},      {{"tiff", "TIFF"}, ".tif"},
    {{"tiff", "TIFF"}, ".tiff"},     {{"heif", "HEIF"}, ".heic"},
    {{"heif", "HEIF"}, ".heif"},     {{"heif", "HEIF"}, ".hif"},
    {{"raw", "Adobe"}, ".dng"},      {{"raw", "Canon"}, ".cr3"},
    {{"raw", "Canon"}, ".cr2"},      {{"raw", "Canon"}, ".crw"},
    {{"raw", "Nikon"}, ".nef"},      {{"raw", "Nikon"}, ".nrw"},
    {{"raw", "Sony"}, ".arw"},       {{"raw", "Sony"}, ".sr2"},
    {{"raw", "Sony"}, ".srf"},       {{"raw", "Fujifilm"}, ".raf"},
    {{"raw", "Panasonic"}, ".rw2"},  {{"raw", "Leica"}, ".rwl"},
    {{"raw", "Olympus"}, ".orf"},    {{"raw", "OM System"}, ".ori"},
    {{"raw", "Pentax"}, ".pef"},     {{"raw", "Samsung"}, ".srw"},
    {{"raw", "Sigma"}, ".x3f"},      {{"raw", "Hasselblad"}, ".3fr"},
    {{"raw", "Hasselblad"}, ".fff"}, {{"raw", "Phase One"}, ".iiq"},
    {{"raw", "Leaf"}, ".mos"},       {{"raw", "Mamiya"}, ".mef"},
    {{"raw", "Minolta"}, ".mrw"},    {{"raw", "Kodak"}, ".dcr"},
    {{"raw", "Kodak"}, ".kdc"},      {{"raw", "Epson"}, ".erf"},
    {{"raw", "GoPro"}, ".gpr"},
};

enum { TYPES = sizeof types / sizeof types[0], PLAIN_TYPES = 5 };

const struct file_type *photo_types(size_t i)
{
    return i < TYPES ? &types[i] : NULL;
}

bool photo_is_plain(const struct file_type *type)
{
    return type < types + PLAIN_TYPES;
}

static bool file_bytes(const void *context, size_t at, void *into, size_t count)
{
    const int descriptor = *(const int *)context;
    size_t got = 0;
    while (got < count) {
        const ssize_t more = pread(descriptor, (char *)into + got, count - got, (off_t)(at + got));
        if (more == 0 || (more < 0 && errno != EINTR)) {
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
    const struct exif_bytes bytes = {
        .read = file_bytes, .context = &descriptor, .length = (size_t)file.st_size};
    const bool done = S_ISREG(file.st_mode) ? exif_read(&bytes, metadata, error)
                                            : fail(error, ERROR_DATA, "this is no regular file");
    close(descriptor);
    return done;
}
