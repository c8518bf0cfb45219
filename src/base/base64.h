/* base/base64.h - bytes as letters: base 64. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_BASE64_H
#define LENSCALC_BASE_BASE64_H

#include "base/arena.h"
#include "base/text.h"

#include <stddef.h>

/*
 * Four letters of the three bytes from `at` on, or of fewer at the end.
 *
 * Source    RFC 4648, 4
 */
void base64_letters(struct text bytes, size_t at, char four[4]);

/* The bytes of such letters; others between them are passed over. */
struct text base64_bytes(struct text letters, struct arena *arena);

#endif
