#!/bin/sh
# tests/structure/check_format.sh - is everything laid out as clang-format does?
# SPDX-License-Identifier: MIT
if ! command -v clang-format > /dev/null; then
    echo "clang-format: not here: skipped"
    echo "0 passed, 0 failed"
    exit 0
fi
if [ ! -f .clang-format ]; then
    echo "FAILED no .clang-format"
    echo "0 passed, 1 failed"
    exit 1
fi
# many files a call, two calls at a time: one a file takes seven times as long
files=$(find src tests -name '*.[ch]' -o -name '*.cc' | sort)
wrong=$(echo "$files" | xargs -n 50 -P 2 clang-format --dry-run -Werror 2>&1 |
    sed -n 's/^\([^: ]*\.[a-z]*\):[0-9]*:[0-9]*: error:.*/\1/p' | sort -u)
for file in $wrong; do
    echo "FAILED $file is not laid out as clang-format does: make format"
done
failed=$(echo "$wrong" | grep -c .)
passed=$(($(echo "$files" | grep -c .) - failed))
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
