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
passed=0
failed=0
for file in $(find src tests -name '*.[ch]' -o -name '*.cc' | sort); do
    if clang-format --dry-run -Werror "$file" > /dev/null 2>&1; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED $file is not laid out as clang-format does: make format"
    fi
done
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
