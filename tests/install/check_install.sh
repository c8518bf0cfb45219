#!/bin/sh
# tests/install/check_install.sh BUILD_DIR - install into a folder, run from there, uninstall.
# SPDX-License-Identifier: MIT
build=$1
passed=0
failed=0
stage=$(mktemp -d) || exit 1
trap 'rm -rf "$stage"' EXIT
unset MAKEFLAGS MAKELEVEL
export LENSCALC_CONFIG=

check() { # description, command...
    what=$1
    shift
    if "$@" > "$stage.log" 2>&1; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED $what"
        head -n 10 "$stage.log" | sed 's/^/    /'
    fi
    rm -f "$stage.log"
}

same_help() {
    "$root/bin/lenscalc" help > "$stage/one" && "$build/lenscalc" help > "$stage/two" &&
        cmp "$stage/one" "$stage/two"
    status=$?
    rm -f "$stage/one" "$stage/two"
    return $status
}

silent() { # a command that must say nothing
    said=$("$@" 2>&1) && [ -z "$said" ] || {
        echo "$said"
        return 1
    }
}

lint() {
    if command -v mandoc > /dev/null; then
        silent mandoc -T lint -W warning "$1"
    else
        silent groff -ww -z -man -Tutf8 "$1"
    fi
}

root=$stage/usr
ceres=1
[ -x "$build/lenscalc-ceres" ] || ceres=0
linked=$(ls --full-time "$build/lenscalc")
check "make install" make -s install BUILD="$build" CERES=$ceres DESTDIR="$stage" PREFIX=/usr
check "make install builds nothing anew" test "$linked" = "$(ls --full-time "$build/lenscalc")"
check "the program is installed" test -x "$root/bin/lenscalc"
check "the installed program answers" "$root/bin/lenscalc" dof -f 50mm -N 2.8 -s 3m
check "the installed program is the built one" same_help
for page in man/*.[157]; do
    [ -e "$page" ] || continue
    section=${page##*.}
    check "$page is installed" cmp "$page" "$root/share/man/man$section/$(basename "$page")"
    check "$page has no warnings" lint "$page"
done
check "there are pages" test -e "$root/share/man/man1/lenscalc.1"
bash_completion=$root/share/bash-completion/completions/lenscalc
zsh_completion=$root/share/zsh/site-functions/_lenscalc
fish_completion=$root/share/fish/vendor_completions.d/lenscalc.fish
for file in "$bash_completion" "$zsh_completion" "$fish_completion"; do
    check "${file#"$stage"} is installed" test -s "$file"
done
for shell in bash zsh fish; do
    eval "file=\$${shell}_completion"
    if command -v $shell > /dev/null; then
        check "the completion parses in $shell" silent $shell -n "$file"
    else
        echo "completion in $shell: not here: skipped"
    fi
done
find "$stage" -type f ! -perm -444 > "$stage.modes"
check "everything is readable by all" test ! -s "$stage.modes"
rm -f "$stage.modes"
check "no trace of the stage in text files" sh -c \
    "! grep -rIl '$stage' '$root/share' 2> /dev/null | grep ."
check "make uninstall" make -s uninstall BUILD="$build" CERES=$ceres DESTDIR="$stage" PREFIX=/usr
left=$(find "$stage" ! -type d)
check "uninstall leaves nothing: $left" test -z "$left"
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
