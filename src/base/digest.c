/* base/digest.c - a fingerprint of bytes: SHA-256. */
/* SPDX-License-Identifier: MIT */
#include "base/digest.h"

#include <string.h>

/* The first 32 bits behind the point of the square roots of the first primes, and of cube roots. */
static const uint32_t square_roots[8] = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                         0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
static const uint32_t cube_roots[64] = {
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

static uint32_t digest_turned(uint32_t x, int by)
{
    return x >> by | x << (32 - by);
}

static void mix(uint32_t state[8], const unsigned char *block)
{
    uint32_t w[64], h[8];
    for (int t = 0; t < 64; t++) {
        if (t < 16) {
            w[t] = (uint32_t)block[4 * t] << 24 | (uint32_t)block[4 * t + 1] << 16 |
                   (uint32_t)block[4 * t + 2] << 8 | block[4 * t + 3];
            continue;
        }
        const uint32_t a = w[t - 15], b = w[t - 2];
        w[t] = w[t - 16] + (digest_turned(a, 7) ^ digest_turned(a, 18) ^ a >> 3) + w[t - 7] +
               (digest_turned(b, 17) ^ digest_turned(b, 19) ^ b >> 10);
    }
    memcpy(h, state, sizeof h);
    for (int t = 0; t < 64; t++) {
        const uint32_t a = h[0], e = h[4];
        const uint32_t first = h[7] +
                               (digest_turned(e, 6) ^ digest_turned(e, 11) ^ digest_turned(e, 25)) +
                               ((e & h[5]) ^ (~e & h[6])) + cube_roots[t] + w[t];
        const uint32_t second =
            (digest_turned(a, 2) ^ digest_turned(a, 13) ^ digest_turned(a, 22)) +
            ((a & h[1]) ^ (a & h[2]) ^ (h[1] & h[2]));
        memmove(h + 1, h, 7 * sizeof *h);
        h[4] += first;
        h[0] = first + second;
    }
    for (int i = 0; i < 8; i++) {
        state[i] += h[i];
    }
}

void digest_begin(struct digest *digest)
{
    memcpy(digest->state, square_roots, sizeof square_roots);
    digest->count = 0;
}

void digest_add(struct digest *digest, const void *data, size_t count)
{
    const unsigned char *at = data;
    while (count > 0) {
        const size_t used = digest->count % 64, room = 64 - used;
        const size_t taken = count < room ? count : room;
        memcpy(digest->block + used, at, taken);
        digest->count += taken;
        at += taken;
        count -= taken;
        if (taken == room) {
            mix(digest->state, digest->block);
        }
    }
}

struct digest_name digest_end(struct digest *digest)
{
    static const unsigned char padding[64] = {0x80};
    static const char digits[] = "0123456789abcdef";
    const uint64_t bits = 8 * digest->count, used = digest->count % 64;
    unsigned char length[8];
    struct digest_name name = {""};
    for (int i = 0; i < 8; i++) {
        length[i] = (unsigned char)(bits >> (56 - 8 * i));
    }
    digest_add(digest, padding, (size_t)(used < 56 ? 56 - used : 120 - used));
    digest_add(digest, length, sizeof length);
    for (int i = 0; i < DIGEST_LENGTH; i++) {
        name.text[i] = digits[digest->state[i / 8] >> (28 - 4 * (i % 8)) & 15];
    }
    return name;
}

void digest_item(struct digest *digest, struct text text)
{
    unsigned char length[8];
    for (int i = 0; i < 8; i++) {
        length[i] = (unsigned char)((uint64_t)text.length >> 8 * i);
    }
    digest_add(digest, length, sizeof length);
    digest_add(digest, text.start, text.length);
}

struct digest_name digest_of(struct text text)
{
    struct digest digest;
    digest_begin(&digest);
    digest_add(&digest, text.start, text.length);
    return digest_end(&digest);
}
