# lenscalc: optics in a shell. Targets:
#   all        build/lenscalc and lenscalc-ceres        demo       the main job, explained
#   check      build and all fast tests              check-all  clang, sanitizers, valgrind, fuzzing
#   bench      time, as ratios; ONLY=rays a section   deps       install what build and tests need
#   install    into PREFIX (and DESTDIR)             uninstall  take it away again
#   dist       a source archive                      format     clang-format over the sources
#   clean      remove build/
#   fuzz       long fuzzing: SECONDS=600 JOBS=2, ONLY="odd lens" these
#   faults     memory, reading and writing fail call by call: every command
#   stress     the worst errors where arithmetic is hardest: SECONDS=60 SEED=1;
#              FAMILY=rays of one kind, NUMBER=7 of one trial
#   validate   what the tests find of values from outside: build/validate.tsv, the page, README
#   survey     printed errors of every lens and field of lensdb against outside sums: an hour or two
#   coverage   lines and branches that the fast tests reach, by folder
#   mutate     is a changed sign noticed? COUNT=60 SEED=1,2,3 FOLDERS=light,scene
#   cluster    parts of pictures, searches and trials as arrays of Slurm, a task killed
#   cross      build for aarch64, run the command-line tests under qemu

PREFIX  = /usr/local
DESTDIR =
# STATIC=0 for distributions that forbid static programs (starts slower)
STATIC  = 1
# CERES=0 builds without the commands that need the solver Ceres (fit, bench)
CERES   = 1
CC      = cc
CXX     = c++
# the compiler of this machine, for what runs while building: make CC=aarch64-linux-gnu-gcc works
HOSTCC  = cc
BUILD   = build
SECONDS = 60
JOBS    = 2
SEED    = 1
COUNT   = 60
# nothing that make runs takes the defaults of whoever runs it
export LENSCALC_CONFIG =

# -ffp-contract=off: the same bits on every x86, with or without FMA
# -fno-math-errno -fno-trapping-math: sqrt and comparisons inline; nobody reads errno or FP flags
# -fno-tree-slp-vectorize: pairs of doubles loaded right after being stored one by one would stall
# no -ffast-math: it deletes the NaN tests; no -march=native: one binary for all machines
STANDARD = -std=c17 -D_POSIX_C_SOURCE=200809L
WARNINGS = -Wall -Wextra -Wconversion -Wshadow -Wstrict-prototypes -pedantic -Werror
FLOATING = -ffp-contract=off -fno-math-errno -fno-trapping-math -fno-tree-slp-vectorize
CFLAGS   = -O2
ALL_CFLAGS = $(STANDARD) $(WARNINGS) $(FLOATING) $(CFLAGS) -Isrc
CXX_FLAGS = -std=c++17 -D_POSIX_C_SOURCE=200809L -Wall -Wextra -Wconversion -pedantic -Werror \
            $(FLOATING) $(CFLAGS) -Isrc -isystem $(EIGEN)
EIGEN    = /usr/include/eigen3
LINK_1   = -static
LINK_0   =
LDFLAGS  =

# compiled once for each instruction set; the program chooses when it runs
kernels := $(wildcard src/*/kernel*.c src/*/*/kernel*.c)
# in the order of linking: what every answer needs lies together, on as few pages as can be
folders := base light scene report photo cli cli/options cli/question cli/batch cli/answer commands \
           commands/photo commands/tool optics analysis/setup analysis/pupil analysis/rays \
           analysis/waves analysis/image analysis/model analysis/real analysis/layout trace/kernel trace trace/aim \
           trace/pupil data file exchange exchange/zemax exchange/codev exchange/oslo exchange/metadata commands/lens \
           commands/analysis commands/data design design/merit design/solver design/fit \
           design/tolerance commands/design draw draw/terminal base/image camera/sensor camera/film \
           camera/subject camera/photograph tone commands/camera
apart   := src/main.c src/data/embed.c src/design/solver/solver_engines.c $(kernels)
sources := $(filter-out $(apart),$(foreach folder,$(folders),$(wildcard src/$(folder)/*.c)))
objects := $(sources:src/%.c=$(BUILD)/%.o) $(BUILD)/lensdb.o \
           $(foreach set,sse2 avx2 avx512,$(kernels:src/%.c=$(BUILD)/%_$(set).o)) \
           $(BUILD)/trace/kernel/kernel_few.o $(BUILD)/trace/kernel/kernel_conic_few.o
alone   := $(BUILD)/design/solver/solver_engines.o
ceres   := $(BUILD)/design/solver/solver_engines_ceres.o $(BUILD)/design/solver/solver_ceres.o
units_0 := $(patsubst tests/%.c,$(BUILD)/%,$(wildcard tests/unit/test_*.c))
units_1 := $(patsubst tests/%.c,$(BUILD)/%,$(wildcard tests/ceres/test_*.c))
units   := $(units_0) $(if $(filter 1,$(CERES)),$(units_1))
lensdb  := $(sort $(wildcard lensdb/*.tsv lensdb/lenses/*.lens lensdb/glass/*.tsv))

programs_1 = $(BUILD)/lenscalc-ceres
all: $(BUILD)/lenscalc $(programs_$(CERES))

# what a build depends on besides the times of files, in files that change only with their content:
# a source or a lens that is gone, another flag. Tests and bench link what $(BUILD)/objects lists,
# by names within BUILD, which may be called by another path the next time.
define stamp
$(BUILD)/$(1): FORCE
	@mkdir -p $$(@D)
	@$(3) echo '$(2)' | cmp -s - $$@ || echo '$(2)' > $$@
endef
$(eval $(call stamp,objects,$(objects:$(BUILD)/%=%)))
$(eval $(call stamp,embedded,$(lensdb)))
# what is installed is what was built: the flags of 'make STATIC=0' need not be said again
installs := $(if $(filter install,$(MAKECMDGOALS)),test -f $(BUILD)/flags ||)
$(eval $(call stamp,flags,$(CC) $(CXX) $(ALL_CFLAGS) $(CXX_FLAGS),$(installs)))
# and linking, which objects do not depend on: another link takes over the same ones
$(eval $(call stamp,linked,$(CC) $(CXX) $(LINK_$(STATIC)) $(LDFLAGS),$(installs)))
FORCE:

# V=1 shows the commands
Q_1 =
Q_  = @
Q   = $(Q_$(V))

# the linker writes in pieces, which lie scattered in the page cache: a copy starts a tenth faster
$(BUILD)/lenscalc: $(BUILD)/main.o $(objects) $(alone) $(BUILD)/objects $(BUILD)/linked
	@echo link $@
	$(Q)$(CC) $(ALL_CFLAGS) $(LINK_$(STATIC)) $(LDFLAGS) -o $@.linked $(filter %.o,$^) -lm
	$(Q)cp $@.linked $@.copy && mv $@.copy $@ && rm $@.linked

# its rays lie side by side and are never stored in between; vectors are passed to inlined functions
# only, so that it does not matter how others would pass them
$(BUILD)/optics/paraxial.o: FLOATING += -ftree-slp-vectorize -Wno-psabi

# what it reads of tables stands side by side
$(foreach set,sse2 avx2 avx512,$(BUILD)/camera/film/kernel_film_$(set).o): FLOATING += -ftree-slp-vectorize

# of stb's headers not all is used; its sums run over where a JPEG is damaged
$(BUILD)/base/image/stb.o: FLOATING += -Wno-unused-function -fwrapv

# the same program with Ceres, which lenscalc becomes when a command needs it
$(BUILD)/lenscalc-ceres: $(BUILD)/main.o $(objects) $(ceres) $(BUILD)/objects $(BUILD)/linked
	@echo link $@
	$(Q)$(CXX) $(CXX_FLAGS) $(LDFLAGS) -o $@.linked $(filter %.o,$^) -lceres -lglog -lm
	$(Q)mv $@.linked $@

ceres_header = __has_include(<ceres/ceres.h>) && __has_include(<Eigen/Core>)
$(BUILD)/%.o: src/%.cc $(BUILD)/flags
	@mkdir -p $(@D)
	@printf '\043if !($(ceres_header))\n\043error\n\043endif\n' | \
	    $(CXX) -std=c++17 -isystem $(EIGEN) -E -x c++ - > /dev/null 2>&1 || { \
	    echo "The solver Ceres (libceres-dev) or a C++ compiler is not here. Either 'make deps'"; \
	    echo "installs them, or 'make CERES=0' builds lenscalc without the commands that fit."; \
	    exit 1; } >&2
	@echo c++ $<
	$(Q)$(CXX) $(CXX_FLAGS) -MMD -MP -c -o $@ $<

$(BUILD)/%.o: src/%.c $(BUILD)/flags
	@mkdir -p $(@D)
	@echo cc $<
	$(Q)$(CC) $(ALL_CFLAGS) -MMD -MP -c -o $@ $<

# the table of solvers, with Ceres in it
$(BUILD)/design/solver/solver_engines_ceres.o: src/design/solver/solver_engines.c $(BUILD)/flags
	@mkdir -p $(@D)
	@echo cc $< with Ceres
	$(Q)$(CC) $(ALL_CFLAGS) -DWITH_CERES -MMD -MP -c -o $@ $<

# lane loops of the ray tracer: the same bits from each of the three; elsewhere all are plain C
ifneq ($(filter x86_64%,$(shell $(CC) -dumpmachine 2> /dev/null || uname -m)),)
SET_avx2   = -mavx2
SET_avx512 = -mavx512f -mavx512vl -mavx512dq -mprefer-vector-width=512
endif
SET_few    = -O2 -DKERNEL_FEW
# gcc takes a minute a kernel with those of the sanitizers' checks that addresses do not need
SET_checked = -fno-sanitize=null,alignment,object-size,pointer-overflow
define kernel
$(BUILD)/%_$(1).o: src/%.c $(BUILD)/flags
	@mkdir -p $$(@D)
	@echo cc $$< for $(1)
	$$(Q)$$(CC) $$(ALL_CFLAGS) $(if $(findstring -fsanitize,$(CFLAGS)),$(SET_checked),-O3) $$(SET_$(1)) \
	    -DKERNEL=$(1) -MMD -MP -c -o $$@ $$<
endef
$(foreach set,sse2 avx2 avx512 few,$(eval $(call kernel,$(set))))

# lensdb inside the program: const arrays, paged in only where a command looks
$(BUILD)/embed: src/data/embed.c src/data/embedded.h
	@mkdir -p $(@D)
	$(Q)$(HOSTCC) $(STANDARD) $(WARNINGS) -Isrc -o $@ $<

$(BUILD)/lensdb.c: $(BUILD)/embed $(lensdb) $(BUILD)/embedded
	$(Q)$(BUILD)/embed $(lensdb) > $@.new && mv $@.new $@

$(BUILD)/lensdb.o: $(BUILD)/lensdb.c $(BUILD)/flags
	$(Q)$(CC) $(ALL_CFLAGS) -c -o $@ $<

# All tests of a folder are one program, which links to it call by the name of the test: a program
# for each would take 13 GB of disk where there are sanitizers.
define tests
$(BUILD)/$(1)/test_%.o: tests/$(1)/test_%.c $(BUILD)/flags
	@mkdir -p $$(@D)
	@echo test $$<
	$$(Q)$$(CC) $$(ALL_CFLAGS) -Itests/unit -Dmain=main_of_test_$$* -MMD -MP -c -o $$@ $$<

$(BUILD)/$(1)/all.o: tests/unit/all.c $(BUILD)/$(1)/tests.list $(BUILD)/flags
	$$(Q)$$(CC) $$(ALL_CFLAGS) -I$(BUILD)/$(1) -c -o $$@ $$<

$(BUILD)/$(1)/all: $(BUILD)/$(1)/all.o $(addsuffix .o,$(2)) $(objects) $(3) $(BUILD)/objects $(BUILD)/linked
	@echo link $$@
	$$(Q)$(4) $$(LDFLAGS) -o $$@ $$(filter %.o,$$^) $(5) -lm

$(2): $(BUILD)/$(1)/all
	@ln -sf all $$@

$(call stamp,$(1)/tests.list,$(patsubst %,TEST(%),$(notdir $(2))))
endef
$(eval $(call tests,unit,$(units_0),$(alone),$(CC) $(ALL_CFLAGS)))
$(eval $(call tests,ceres,$(units_1),$(ceres),$(CXX) $(CXX_FLAGS),-lceres -lglog))

# the fuzz targets on the inputs that are kept, without a fuzzer
targets  := $(patsubst tests/fuzz/fuzz_%.c,$(BUILD)/fuzz/replay_%.o,$(wildcard tests/fuzz/fuzz_*.c))
solver_1 = $(ceres)
solver_0 = $(alone)
link_1   = $(CXX) $(CXX_FLAGS)
link_0   = $(CC) $(ALL_CFLAGS)
libs_1   = -lceres -lglog
$(BUILD)/fuzz/replay_%.o: tests/fuzz/fuzz_%.c $(BUILD)/flags
	@mkdir -p $(@D)
	$(Q)$(CC) $(ALL_CFLAGS) -Itests/fuzz -DLLVMFuzzerTestOneInput=replay_$* -MMD -MP -c -o $@ $<

$(BUILD)/replay: tests/fuzz/replay.c $(targets) $(objects) $(solver_$(CERES)) $(BUILD)/objects $(BUILD)/linked
	@echo link $@
	$(Q)$(CC) $(ALL_CFLAGS) -Itests/fuzz -c -o $(BUILD)/fuzz/replay.o $<
	$(Q)$(link_$(CERES)) $(LDFLAGS) -o $@ $(BUILD)/fuzz/replay.o $(filter %.o,$^) $(libs_$(CERES)) -lm

# The programs that bench, stress, faults, mutate and truth link when they run: a change of what they
# call shows at once.
programs := $(patsubst tests/%.c,$(BUILD)/programs/%.o,$(filter-out tests/unit/% tests/ceres/% \
                tests/fuzz/%,$(wildcard tests/*/*.c)))
$(BUILD)/programs/%.o: tests/%.c $(BUILD)/flags
	@mkdir -p $(@D)
	@echo test $<
	$(Q)$(CC) $(ALL_CFLAGS) -MMD -MP -c -o $@ $<

programs: $(programs)

# random trials, with what they are to be compared with
trials := $(patsubst tests/%.c,$(BUILD)/programs/%.o,$(wildcard tests/stress/*.c))
$(BUILD)/stress/trials: $(trials) $(objects) $(solver_$(CERES)) $(BUILD)/objects $(BUILD)/linked
	@mkdir -p $(@D)
	@echo link $@
	$(Q)$(link_$(CERES)) $(LDFLAGS) -o $@ $(filter %.o,$^) $(libs_$(CERES)) -lm

-include $(patsubst %.o,%.d,$(BUILD)/main.o $(objects) $(alone) $(ceres)) $(addsuffix .d,$(units)) $(targets:.o=.d) \
         $(programs:.o=.d)

ceres_packages_1 = g++ libceres-dev
build_packages = gcc make libc6-dev libstb-dev $(ceres_packages_$(CERES))
check_packages = $(build_packages) python3 binutils pmccabe librsvg2-bin fonts-dejavu-core \
                 parallel jq libimage-exiftool-perl
all_packages   = $(check_packages) clang clang-format libclang-rt-14-dev valgrind mawk mandoc \
                 zsh fish
cross_packages = $(build_packages) python3 gcc-aarch64-linux-gnu libc6-dev-arm64-cross qemu-user-static

deps:
	@tests/deps $(all_packages)

demo:
	@tests/deps $(build_packages)
	@$(MAKE) -s all
	@tests/demo $(BUILD)

# one build and all fast tests
check:
	@tests/deps $(check_packages)
	@$(MAKE) -s all programs $(units) $(BUILD)/replay $(BUILD)/stress/trials
	@tests/run $(BUILD)

# everything that has an end: other compiler, sanitizers, valgrind, short fuzzing
check-all: deps
	@tests/check-all $(BUILD)

# rewrite the expected outputs of tests/cli, README and pages; the difference is to be reviewed
accept: all
	@tests/cli/run $(BUILD) --accept
	@python3 tests/documents/accept.py $(BUILD)

bench: deps all
	@tests/bench/run $(BUILD) $(ONLY)

fuzz: deps
	@tests/fuzz/run $(SECONDS) $(JOBS) $(BUILD) $(ONLY)

# a static program asks nobody for its memory
faults: deps
	@$(MAKE) -s BUILD=$(BUILD)/dynamic STATIC=0 all
	@tests/faults/run $(BUILD)/dynamic

stress: all $(BUILD)/stress/trials
	@tests/stress/run $(SECONDS) $(BUILD) $(SEED) "$(FAMILY)" $(NUMBER)

validate:
	@tests/deps $(check_packages)
	@$(MAKE) -s all programs $(units)
	@tests/run $(BUILD) validate
	@python3 tests/validation.py $(BUILD)

survey: deps all
	@tests/truth/survey $(BUILD)

coverage: deps
	@tests/deps gcovr
	@tests/coverage/run $(BUILD)

mutate: deps
	@tests/mutate/run $(BUILD) $(COUNT) $(SEED) $(FOLDERS)

# a picture divided over a Slurm, one of this machine if none answers
cluster:
	@tests/deps $(build_packages) python3
	@$(MAKE) -s all
	@python3 tests/cluster/check_cluster.py $(BUILD)

# another processor, the same answers
cross:
	@tests/deps $(cross_packages)
	@$(MAKE) -s BUILD=$(BUILD)/cross CC=aarch64-linux-gnu-gcc CERES=0 all
	@LENSCALC_WRAPPER=qemu-aarch64-static tests/cli/run $(BUILD)/cross

format:
	clang-format -i $(shell find src tests -name '*.[ch]' -o -name '*.cc')

bindir  = $(DESTDIR)$(PREFIX)/bin
execdir = $(DESTDIR)$(PREFIX)/libexec/lenscalc
mandir  = $(DESTDIR)$(PREFIX)/share/man
bashdir = $(DESTDIR)$(PREFIX)/share/bash-completion/completions
zshdir  = $(DESTDIR)$(PREFIX)/share/zsh/site-functions
fishdir = $(DESTDIR)$(PREFIX)/share/fish/vendor_completions.d

install: all
	install -d $(bindir) $(mandir)/man1 $(mandir)/man5 $(mandir)/man7 $(bashdir) $(zshdir) $(fishdir)
	install $(BUILD)/lenscalc $(bindir)/lenscalc
	$(if $(programs_$(CERES)),install -d $(execdir) && install $(programs_$(CERES)) $(execdir))
	install -m 644 $(wildcard man/*.1) $(mandir)/man1
	install -m 644 $(wildcard man/*.5) $(mandir)/man5
	install -m 644 $(wildcard man/*.7) $(mandir)/man7
	$(BUILD)/lenscalc completion bash > $(bashdir)/lenscalc
	$(BUILD)/lenscalc completion zsh > $(zshdir)/_lenscalc
	$(BUILD)/lenscalc completion fish > $(fishdir)/lenscalc.fish

uninstall:
	rm -f $(execdir)/lenscalc-ceres && { [ ! -d $(execdir) ] || rmdir $(execdir); }
	rm -f $(bindir)/lenscalc $(bashdir)/lenscalc $(zshdir)/_lenscalc $(fishdir)/lenscalc.fish
	rm -f $(patsubst man/%,$(mandir)/man1/%,$(wildcard man/*.1))
	rm -f $(patsubst man/%,$(mandir)/man5/%,$(wildcard man/*.5))
	rm -f $(patsubst man/%,$(mandir)/man7/%,$(wildcard man/*.7))

version := $(shell sed -n 's/.*LENSCALC_VERSION "\(.*\)"/\1/p' src/report/version.h)
dist:
	git archive --prefix=lenscalc-$(version)/ -o lenscalc-$(version).tar.gz HEAD

clean:
	rm -rf $(BUILD)

.PHONY: FORCE all programs deps demo check check-all accept bench fuzz faults stress validate survey coverage mutate cluster cross format install uninstall dist clean
