# lenscalc: optics in a shell. Targets:
#   all        build/lenscalc (the default)          demo       the main job, explained
#   check      build and all fast tests              check-all  clang, sanitizers, valgrind, fuzzing
#   bench      time, as ratios within one run        deps       install what build and tests need
#   install    into PREFIX (and DESTDIR)             uninstall  take it away again
#   dist       a source archive                      format     clang-format over the sources
#   fuzz       long fuzzing: SECONDS=600 JOBS=2      clean      remove build/
#   stress     the worst errors where arithmetic is hardest: SECONDS=60 SEED=1

PREFIX  = /usr/local
DESTDIR =
# STATIC=0 for distributions that forbid static programs (starts slower)
STATIC  = 1
CC      = cc
BUILD   = build
SECONDS = 60
JOBS    = 2
SEED    = 1

# -ffp-contract=off: the same bits on every x86, with or without FMA
# -fno-math-errno -fno-trapping-math: sqrt and comparisons inline; nobody reads errno or FP flags
# -fno-tree-slp-vectorize: pairs of doubles loaded right after being stored one by one would stall
# no -ffast-math: it deletes the NaN tests; no -march=native: one binary for all machines
STANDARD = -std=c17 -D_POSIX_C_SOURCE=200809L
WARNINGS = -Wall -Wextra -Wconversion -Wshadow -Wstrict-prototypes -pedantic -Werror
FLOATING = -ffp-contract=off -fno-math-errno -fno-trapping-math -fno-tree-slp-vectorize
CFLAGS   = -O2
ALL_CFLAGS = $(STANDARD) $(WARNINGS) $(FLOATING) $(CFLAGS) -Isrc
LINK_1   = -static
LINK_0   =
LDFLAGS  =

# compiled once for each instruction set; the program chooses when it runs
kernels := $(wildcard src/trace/kernel*.c)
sources := $(wildcard src/base/*.c src/photo/*.c src/optics/*.c src/report/*.c src/cli/*.c \
                       src/analysis/*.c) \
           $(filter-out $(kernels),$(wildcard src/trace/*.c)) \
           $(filter-out src/file/embed.c,$(wildcard src/file/*.c))
objects := $(sources:src/%.c=$(BUILD)/%.o) $(BUILD)/lensdb.o \
           $(foreach set,sse2 avx2 avx512,$(kernels:src/%.c=$(BUILD)/%_$(set).o))
units   := $(patsubst tests/unit/%.c,$(BUILD)/unit/%,$(wildcard tests/unit/test_*.c))
lensdb  := $(sort $(wildcard lensdb/*.tsv lensdb/lenses/*.lens lensdb/glass/*.tsv))

all: $(BUILD)/lenscalc

# V=1 shows the commands
Q_1 =
Q_  = @
Q   = $(Q_$(V))

# the linker writes in pieces, which lie scattered in the page cache: a copy starts a tenth faster
$(BUILD)/lenscalc: $(BUILD)/main.o $(objects)
	@echo link $@
	$(Q)$(CC) $(ALL_CFLAGS) $(LINK_$(STATIC)) $(LDFLAGS) -o $@.linked $^ -lm
	$(Q)cp $@.linked $@.copy && mv $@.copy $@ && rm $@.linked

# its rays lie side by side and are never stored in between; vectors are passed to inlined functions
# only, so that it does not matter how others would pass them
$(BUILD)/optics/paraxial.o: FLOATING += -ftree-slp-vectorize -Wno-psabi

$(BUILD)/%.o: src/%.c
	@mkdir -p $(@D)
	@echo cc $<
	$(Q)$(CC) $(ALL_CFLAGS) -MMD -MP -c -o $@ $<

# lane loops of the ray tracer: the same bits from each of the three; elsewhere all are plain C
ifneq ($(filter x86_64%,$(shell $(CC) -dumpmachine)),)
SET_avx2   = -mavx2
SET_avx512 = -mavx512f -mavx512vl -mavx512dq -mprefer-vector-width=512
endif
define kernel
$(BUILD)/%_$(1).o: src/%.c
	@mkdir -p $$(@D)
	@echo cc $$< for $(1)
	$$(Q)$$(CC) $$(ALL_CFLAGS) $(if $(findstring -fsanitize,$(CFLAGS)),,-O3) $$(SET_$(1)) \
	    -DKERNEL=$(1) -MMD -MP -c -o $$@ $$<
endef
$(foreach set,sse2 avx2 avx512,$(eval $(call kernel,$(set))))

# lensdb inside the program: const arrays, paged in only where a command looks
$(BUILD)/embed: src/file/embed.c src/file/embedded.h
	@mkdir -p $(@D)
	$(Q)$(CC) $(STANDARD) $(WARNINGS) -Isrc -o $@ $<

$(BUILD)/lensdb.c: $(BUILD)/embed $(lensdb)
	$(Q)$(BUILD)/embed $(lensdb) > $@.new && mv $@.new $@

$(BUILD)/lensdb.o: $(BUILD)/lensdb.c
	$(Q)$(CC) $(ALL_CFLAGS) -c -o $@ $<

$(BUILD)/unit/%: tests/unit/%.c $(objects)
	@mkdir -p $(@D)
	@echo test $<
	$(Q)$(CC) $(ALL_CFLAGS) -Itests/unit -MMD -MP $(LDFLAGS) -o $@ $< $(objects) -lm

-include $(wildcard $(BUILD)/*.d $(BUILD)/*/*.d)

build_packages = gcc make libc6-dev
check_packages = $(build_packages) python3 binutils librsvg2-bin
all_packages   = $(check_packages) clang clang-format libclang-rt-14-dev valgrind mawk mandoc \
                 zsh fish

deps:
	@tests/deps $(all_packages)

demo:
	@tests/deps $(build_packages)
	@$(MAKE) -s all
	@tests/demo $(BUILD)

# one build and all fast tests
check:
	@tests/deps $(check_packages)
	@$(MAKE) -s all $(units)
	@tests/run $(BUILD)

# everything that has an end: other compiler, sanitizers, valgrind, short fuzzing
check-all: deps
	@tests/check-all $(BUILD)

# rewrite the expected outputs of tests/cli, README and pages; the difference is to be reviewed
accept: all
	@tests/cli/run $(BUILD) --accept
	@python3 tests/documents/accept.py $(BUILD)

bench: deps all
	@tests/bench/run $(BUILD)

fuzz: deps
	@tests/fuzz/run $(SECONDS) $(JOBS) $(BUILD)

stress: all
	@tests/stress/run $(SECONDS) $(BUILD) $(SEED)

format:
	clang-format -i $(shell find src tests -name '*.[ch]')

bindir  = $(DESTDIR)$(PREFIX)/bin
mandir  = $(DESTDIR)$(PREFIX)/share/man
bashdir = $(DESTDIR)$(PREFIX)/share/bash-completion/completions
zshdir  = $(DESTDIR)$(PREFIX)/share/zsh/site-functions
fishdir = $(DESTDIR)$(PREFIX)/share/fish/vendor_completions.d

install: all
	install -d $(bindir) $(mandir)/man1 $(mandir)/man5 $(mandir)/man7 $(bashdir) $(zshdir) $(fishdir)
	install $(BUILD)/lenscalc $(bindir)/lenscalc
	install -m 644 $(wildcard man/*.1) $(mandir)/man1
	install -m 644 $(wildcard man/*.5) $(mandir)/man5
	install -m 644 $(wildcard man/*.7) $(mandir)/man7
	$(BUILD)/lenscalc completion bash > $(bashdir)/lenscalc
	$(BUILD)/lenscalc completion zsh > $(zshdir)/_lenscalc
	$(BUILD)/lenscalc completion fish > $(fishdir)/lenscalc.fish

uninstall:
	rm -f $(bindir)/lenscalc $(bashdir)/lenscalc $(zshdir)/_lenscalc $(fishdir)/lenscalc.fish
	rm -f $(patsubst man/%,$(mandir)/man1/%,$(wildcard man/*.1))
	rm -f $(patsubst man/%,$(mandir)/man5/%,$(wildcard man/*.5))
	rm -f $(patsubst man/%,$(mandir)/man7/%,$(wildcard man/*.7))

version := $(shell sed -n 's/.*LENSCALC_VERSION "\(.*\)"/\1/p' src/report/version.h)
dist:
	git archive --prefix=lenscalc-$(version)/ -o lenscalc-$(version).tar.gz HEAD

clean:
	rm -rf $(BUILD)

.PHONY: all deps demo check check-all accept bench fuzz stress format install uninstall dist clean
