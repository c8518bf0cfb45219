/* base/digest.h - a fingerprint of bytes: SHA-256. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_DIGEST_H
#define LENSCALC_BASE_DIGEST_H

#include "base/text.h"

#include <stddef.h>
#include <stdint.h>

/* What has been put in so far. */
struct digest {
    uint32_t state[8];
    unsigned char block[64];
    uint64_t count; /* bytes */
};

/* 64 hexadecimal digits and a NUL, as sha256sum prints them. */
enum { DIGEST_LENGTH = 64 };
struct digest_name {
    char text[DIGEST_LENGTH + 1];
};

/*
 * SHA-256 of all that is added between beginning and end.
 *
 * Source    [FIPS15] sections 5.1.1, 5.3.3, 6.2
 */
void digest_begin(struct digest *digest);
void digest_add(struct digest *digest, const void *data, size_t count);
struct digest_name digest_end(struct digest *digest);

/* A text as one of several: its length goes in before it, so that "ab", "c" is not "a", "bc". */
void digest_item(struct digest *digest, struct text text);

/* Of one text. */
struct digest_name digest_of(struct text text);

#endif
