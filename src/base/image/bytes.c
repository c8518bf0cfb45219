/* base/image/bytes.c - numbers as files of pictures hold them. */
/* SPDX-License-Identifier: MIT */
#include "base/image/bytes.h"

unsigned char *bytes_room(struct bytes *bytes, size_t count)
{
    if (bytes->room - bytes->used < count) {
        const size_t room = bytes->used + count + bytes->room;
        unsigned char *larger = arena_buffer_array(bytes->arena, room, 1);
        if (bytes->used > 0) {
            memcpy(larger, bytes->data, bytes->used);
        }
        bytes->data = larger;
        bytes->room = room;
    }
    return bytes->data + bytes->used;
}

void bytes_put(struct bytes *bytes, const void *data, size_t count)
{
    if (count > 0) {
        memcpy(bytes_room(bytes, count), data, count);
        bytes->used += count;
    }
}

void bytes_put_string(struct bytes *bytes, const char *string)
{
    bytes_put(bytes, string, strlen(string));
}

void bytes_put_little(struct bytes *bytes, uint64_t value, int count)
{
    bytes_store_little(bytes_room(bytes, (size_t)count), value, count);
    bytes->used += (size_t)count;
}

void bytes_put_big(struct bytes *bytes, uint64_t value, int count)
{
    unsigned char *at = bytes_room(bytes, (size_t)count);
    for (int i = 0; i < count; i++) {
        at[i] = (unsigned char)(value >> 8 * (count - 1 - i));
    }
    bytes->used += (size_t)count;
}
