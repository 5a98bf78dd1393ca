# lom is built and tested by make: see README.md.
#
#   make                        the program build/lom and the library build/liblom.a, build/liblom.so
#   make demo                   draws the demo scenes, to demo.png and demo-lake.png, with this processor's lanes alone
#   make check                  the tests; the last line is "N passed, N failed"
#   make lint, make format      what the house asks of the source; clang-format over all of it
#   make install, uninstall     into PREFIX (/usr/local), under DESTDIR
#   make bench                  milliseconds a frame of every workload; bench-*: the experiments of bench/results
#   make wasm                   for WebAssembly: the program and the library in build/wasm, a page a lesson, to be
#                               opened in a browser, in build/web (docs/wasm.md)
#   make matrix                 one hash from every compiler and architecture
#   make fuzz SECONDS=60        every fuzz target of tests/fuzz under libFuzzer (clang) for that long
#   make coverage               lines and branches of src/ that make check executes, a file a line
#   make check-long             every float through every conversion and lane function; runs shared out among workers;
#                               scenes out of numbers, every way of drawing them, for SECONDS;
#                               the pictures of the pages drawn again (docs/pictures.sh);
#                               Mesa, FFTW, MPFR and OpenVDB as witnesses, where they are installed
#   make docs                   all pages, lessons and the headers' comments as HTML, in build/docs
#   make clean, make help
#
#   CC=clang O=0 BUILD=dir      another compiler, level and folder
#   SAN=address                 address, undefined, thread or memory sanitizer
#   SDL=                        no window for lom view, else one where pkg-config finds SDL2's headers
#   VARIANTS="4 8"              these lane widths alone: quicker to compile, the same pictures
#   RECORDED=                   without lom explain, steps and overlay: quicker still
#   V=1                         whole commands instead of one short line a file

# As many jobs as processors, unless -j says otherwise.
ifeq ($(MAKELEVEL)$(filter -j%,$(MAKEFLAGS)),0)
MAKEFLAGS += -j$(shell nproc 2>/dev/null || echo 1)
endif

CC     = gcc
AR     = ar
O      = 3
BUILD  = build
PREFIX = /usr/local
SAN    =

VERSION := $(shell sed -n 's/^\#define LOM_VERSION *"\(.*\)"/\1/p' include/lom/base.h)
MACHINE := $(shell $(CC) -dumpmachine)
# The number in the name of the shared library and in the version of its symbols: raised when a program that was linked
# with the one before would not run with this one.
ABI = 0

# The float flags are the contract (docs/numerics.md: same input, same bytes); a user's shader is compiled with the same ones.
# Straight-line vectorizing is off since gcc 11 and 12 drop the rounding of (double)(float)x in it (tests/base/test_double).
FLOAT_FLAGS = -fwrapv -ffp-contract=off -fno-math-errno -fno-trapping-math -fno-tree-slp-vectorize
WARNINGS    = -Wall -Wextra -Wshadow -Wstrict-prototypes -Wmissing-prototypes -Wno-psabi -Wno-format-zero-length -Wno-uninitialized
CPPFLAGS    = -D_GNU_SOURCE -Iinclude -Isrc
# Where variables live is half of the time that vectors as wide as these take to compile; -O0 knows it without.
CFLAGS      = -std=gnu11 -O$(O) -g -fno-var-tracking $(PIC) -fvisibility=hidden -fno-asynchronous-unwind-tables $(FLOAT_FLAGS) $(WARNINGS)
PIC         = -fPIC
LDLIBS      = -lm -lpthread
comma := ,
# Sanitized code is optimised little: it compiles many times faster and says more.
ifneq ($(SAN),)
O       = 1
BUILD   = build-$(SAN)
# What gcc and clang leave out of "undefined".
SANITIZERS = $(SAN)$(if $(findstring undefined,$(SAN)),$(comma)float-cast-overflow)
CFLAGS += -fsanitize=$(SANITIZERS) -fno-omit-frame-pointer -fno-sanitize-recover=all
LDFLAGS += -fsanitize=$(SANITIZERS)
endif

# What is executed is counted beside the objects (make coverage).
ifneq ($(COVERAGE),)
CFLAGS += --coverage -fprofile-update=atomic
LDFLAGS += --coverage
COUNTING = $(BUILD)/tests/house/coverage.o
$(BUILD)/lom: private LDFLAGS += -Wl,--wrap=nanosleep
endif

AVX512 = -mavx2 -mavx512f -mavx512dq -mavx512bw -mavx512vl -mavx512cd
# One object for each width. On x86-64 the widths 8 and 16 exist twice: for AVX2 and AVX-512, and lowered to the baseline.
# VARIANTS="4 8" builds those alone (4 is always of them): quicker to compile, the same pictures.
ifneq ($(filter x86_64%,$(MACHINE)),)
ALL_VARIANTS = 4 8 16 8_plain 16_plain
else
ALL_VARIANTS = 4 8 16
endif
VARIANTS = $(ALL_VARIANTS)
ifneq ($(VARIANTS),$(ALL_VARIANTS))
EACH_VARIANT := -DLOM_EACH_VARIANT(X,name)=$(subst $() ,,$(foreach v,$(VARIANTS),X(name,$v)))
CPPFLAGS += '$(EACH_VARIANT)'
endif
# The recorded variant says what it does to the pixels that are watched (include/lom/record.h) and draws nothing else.
# RECORDED= leaves it out: a third less to compile, the same pictures, and every draw is one that is not recorded.
RECORDED          = 4_recorded
FLAGS_4_recorded  = -DLOM_ALL_LANES -DLOM_LANES=4 -DLOM_VARIANT=4_recorded -DLOM_RECORD $(if $(filter 3,$(O)),-Os)
FLAGS_4        = -DLOM_ALL_LANES -DLOM_LANES=4 -DLOM_VARIANT=4
# Nobody waits for the lowered widths, which show on any CPU what the others draw, so they are compiled for size. Only
# x86-64 has wider ones of its own (lanes/variants.c); without vectors, -O3 of 16 lanes takes minutes and gigabytes a file.
LOWERED        = -DLOM_LOWERED $(if $(filter 3,$(O)),-Os)
FLAGS_8_plain  = -DLOM_ALL_LANES -DLOM_LANES=8 -DLOM_VARIANT=8_plain $(LOWERED)
FLAGS_16_plain = -DLOM_ALL_LANES -DLOM_LANES=16 -DLOM_VARIANT=16_plain $(LOWERED)
ifneq ($(filter x86_64%,$(MACHINE)),)
FLAGS_8  = -DLOM_ALL_LANES -DLOM_LANES=8 -DLOM_VARIANT=8 -mavx2
FLAGS_16 = -DLOM_ALL_LANES -DLOM_LANES=16 -DLOM_VARIANT=16 $(AVX512)
else
FLAGS_8  = -DLOM_ALL_LANES -DLOM_LANES=8 -DLOM_VARIANT=8 $(LOWERED)
FLAGS_16 = -DLOM_ALL_LANES -DLOM_LANES=16 -DLOM_VARIANT=16 $(LOWERED)
endif

# What the system has chooses among files: WebAssembly has no threads, signals and owners of files (docs/wasm.md). Its
# stack lies first, so that one that overflows is an error and never another object's bytes.
elsewhere = src/base/threads_none.c src/base/system_wasi.c src/cli/start_wasi.c src/cli/processes_none.c src/cli/background_none.c
ifneq ($(filter wasm32%,$(MACHINE)),)
elsewhere = src/base/threads.c src/base/system_posix.c src/cli/signals.c src/cli/processes.c src/cli/background.c
PIC    =
LDLIBS = -Wl,--stack-first -Wl,-z,stack-size=4194304 -Wl,--strip-all
endif

# The window of lom view, where pkg-config knows SDL2 and the compiler makes programs for this machine; SDL= leaves it out.
# Its headers alone are wanted: the program opens the library when it opens the window (-ldl: dlopen, before glibc 2.34).
# What a sanitizer has not compiled may hide its errors, or show those of others.
ifeq ($(firstword $(subst -, ,$(MACHINE))),$(shell uname -m))
SDL = $(if $(SAN),,$(shell pkg-config --exists sdl2 2>/dev/null && echo sdl2))
endif
DL_LIBS = $(if $(SDL),-ldl)
elsewhere += src/cli/$(if $(SDL),view_sdl_none,view_sdl).c

sources      := $(filter-out $(elsewhere) src/web/%,$(sort $(wildcard src/*/*.c src/*/*/*.c)))
cli_sources  := $(filter src/cli/%,$(sources))
# What the program measures with is not in the library.
measure_sources := $(filter src/measure/%,$(sources))
wide_sources := $(filter %.wide.c,$(filter-out src/cli/% src/measure/%,$(sources)))
# What no shader calls: no pixel is explained by it.
unrecorded   := $(filter src/waves/fft% src/waves/sea_step% src/march/light_grid% src/cloud/detail_noise% src/cloud/shape% src/render/tone%,$(wide_sources))
lib_sources  := $(filter-out %.wide.c src/cli/% src/measure/%,$(sources))
objects_of   = $(patsubst %.c,$(BUILD)/%.o,$(filter-out %.wide.c,$(1))) $(foreach v,$(VARIANTS),$(patsubst %.wide.c,$(BUILD)/%.w$(v).o,$(filter %.wide.c,$(1))))
lib_objects     := $(call objects_of,$(lib_sources) $(wide_sources)) \
	$(foreach v,$(RECORDED),$(patsubst %.wide.c,$(BUILD)/%.w$v.o,$(filter-out $(unrecorded),$(wide_sources))))
measure_objects := $(call objects_of,$(measure_sources))
cli_objects  := $(cli_sources:%.c=$(BUILD)/%.o)

# A lesson is docs/lessons/NAME/NAME.c: a program, and contained in lom under another name than main.
lesson_sources := $(foreach folder,$(wildcard docs/lessons/*/),$(wildcard $(folder)$(notdir $(folder:/=)).c))
lessons        := $(lesson_sources:%.c=$(BUILD)/%) $(BUILD)/docs/lessons/mistakes/gallery
lesson_objects := $(lesson_sources:%.c=$(BUILD)/%.contained.o) $(BUILD)/docs/lessons/grade/judge.o
# What a lesson's page asks of it (src/web/lesson_page.c): another main, the lesson's own calls led past it.
page_programs  := $(lesson_sources:%.c=$(BUILD)/%.page)
page_objects   := $(patsubst %.c,$(BUILD)/%.o,$(wildcard src/web/*.c) src/cli/explain_text.c src/cli/explain_names.c src/cli/json.c src/cli/page.c src/cli/steps_page.c)
PAGE_CALLS     = open_device close_device make_texture texture_of_image free_texture begin_pass draw end_pass read_texture create_image convert_image write_image

# How much speed is worth: lanes are compiled for speed, as are these folders and each file whose head says "Compiled for
# speed"; what runs briefly or seldom for size, the rest in between. (How large the program may be: tests/cli/test_limits.sh.)
FOR_SPEED = base march pipeline reference
FOR_SIZE  = cli geometry inspect measure render scene
within    = $(foreach folder,$(1),$(filter src/$(folder)/%,$(sources)))
plain_sources := $(filter-out %.wide.c,$(sources))
speed_sources := $(call within,$(FOR_SPEED)) $(shell grep -l 'Compiled for speed' $(plain_sources))
size_sources  := $(filter-out %.wide.c $(speed_sources),$(call within,$(FOR_SIZE)))
ifeq ($(O),3)
$(size_sources:%.c=$(BUILD)/%.o) $(lesson_objects): private CFLAGS += -Os
$(patsubst %.c,$(BUILD)/%.o,$(filter-out $(speed_sources) $(size_sources),$(plain_sources))): private CFLAGS += -O2
endif

tests        := $(sort $(filter-out %.wide.c,$(wildcard tests/*/test_*.c)))
wide_tests   := $(sort $(wildcard tests/*/test_*.wide.c))
test_scripts := $(sort $(wildcard tests/*/test_*.sh))
# The tests of records are built as the variant that makes them.
inspect_tests := $(filter tests/inspect/%,$(wide_tests))
programs     := $(tests:%.c=$(BUILD)/%) $(foreach v,$(VARIANTS),$(patsubst %.wide.c,$(BUILD)/%.w$(v),$(filter-out $(inspect_tests),$(wide_tests)))) \
	$(foreach v,$(RECORDED),$(inspect_tests:%.wide.c=$(BUILD)/%.w$v))
fuzz_targets := $(patsubst tests/fuzz/%.c,%,$(sort $(wildcard tests/fuzz/fuzz_*.c)))

.PHONY: all demo docs pages check check-long coverage wasm matrix fuzz lint format install uninstall clean help
.PHONY: bench bench-peers bench-water-models bench-sea bench-fft bench-particles bench-serial bench-shallow bench-light-grid bench-clouds \
	bench-octaves bench-impostors bench-mathematics bench-sampling
.DELETE_ON_ERROR:

# $(call short,CC) before a command: a short line with the target's name, nothing with make -s, the command with V=1.
ifneq ($(V),1)
short = @$(if $(findstring s,$(firstword -$(MAKEFLAGS))),,echo "  $(1)  $@";)
endif

all: $(BUILD)/lom $(BUILD)/liblom.a $(BUILD)/liblom.so

help:
	@sed -n '/^#/!q; s/^# \{0,1\}//p' Makefile

$(BUILD)/liblom.a: $(lib_objects)
	@rm -f $@
	$(call short,AR)$(AR) rcs $@ $^

# Only what the public headers declare is visible (LOM_API_BEGIN in lom/base.h), under a version of its own.
$(BUILD)/liblom.so: $(lib_objects) $(BUILD)/liblom.map
	$(call short,LD)$(CC) -shared $(LDFLAGS) -Wl,-soname,liblom.so.$(ABI) -Wl,--version-script=$(BUILD)/liblom.map -o $@ $(lib_objects) $(LDLIBS)

$(BUILD)/liblom.map: Makefile
	@mkdir -p $(@D)
	@echo 'LOM_$(ABI) { global: lom_*; local: *; };' >$@

$(BUILD)/measure.a: $(measure_objects)
	@rm -f $@
	$(call short,AR)$(AR) rcs $@ $^

$(BUILD)/lom: $(cli_objects) $(lesson_objects) $(COUNTING) $(BUILD)/measure.a $(BUILD)/liblom.a $(BUILD)/window
	$(call short,LD)$(CC) $(LDFLAGS) -o $@ $(filter %.o %.a,$^) $(DL_LIBS) $(LDLIBS)

# Linked again when it gets a window or loses it.
$(BUILD)/window: FORCE
	@mkdir -p $(@D)
	@echo "$(SDL)" | cmp -s - $@ || echo "$(SDL)" > $@

$(BUILD)/src/cli/view_sdl.o: private CPPFLAGS += $(shell pkg-config --cflags $(SDL))

# The program's parts, for their tests.
$(BUILD)/cli.a: $(filter-out $(BUILD)/src/cli/main.o,$(cli_objects))
	@rm -f $@
	$(call short,AR)$(AR) rcs $@ $^

# Rebuilt when the flags change, so that a build folder never mixes two. They are read before any target adds its own.
build_flags := $(CC) $(CPPFLAGS) $(CFLAGS) $(foreach v,$(VARIANTS) $(RECORDED),$(FLAGS_$(v)))
$(BUILD)/flags: FORCE
	@mkdir -p $(@D)
	@echo "$(build_flags)" | cmp -s - $@ || echo "$(build_flags)" > $@
FORCE:

define wide_rule
$(BUILD)/src/%.w$(1).o: src/%.wide.c $(BUILD)/flags
	@mkdir -p $$(@D)
	$$(call short,CC)$$(CC) $$(CPPFLAGS) $$(CFLAGS) $$(FLAGS_$(1)) -MMD -MP -c -o $$@ $$<

$(BUILD)/tests/%.w$(1): tests/%.wide.c $(BUILD)/liblom.a tests/check.h
	@mkdir -p $$(@D)
	$$(call short,CC)$$(CC) $$(CPPFLAGS) -Itests $$(CFLAGS) $$(FLAGS_$(1)) -ULOM_ALL_LANES -MMD -MP $$(LDFLAGS) -o $$@ $$< $(BUILD)/liblom.a $$(LDLIBS)

$(BUILD)/bench/%.w$(1): bench/%.wide.c $(BUILD)/liblom.a
	@mkdir -p $$(@D)
	$$(call short,CC)$$(CC) $$(CPPFLAGS) $$(CFLAGS) $$(FLAGS_$(1)) -ULOM_ALL_LANES $$(LDFLAGS) -o $$@ $$< $(BUILD)/liblom.a $$(LDLIBS)
endef
$(foreach v,$(VARIANTS) $(RECORDED),$(eval $(call wide_rule,$(v))))
$(lib_objects): private CPPFLAGS += $(RECORDED:%=-DLOM_HAS_RECORDED)

$(BUILD)/src/%.o: src/%.c $(BUILD)/flags
	@mkdir -p $(@D)
	$(call short,CC)$(CC) $(CPPFLAGS) $(CFLAGS) -MMD -MP -c -o $@ $<

$(BUILD)/tests/%: tests/%.c $(BUILD)/liblom.a tests/check.h
	@mkdir -p $(@D)
	$(call short,CC)$(CC) $(CPPFLAGS) -Itests $(CFLAGS) -MMD -MP $(LDFLAGS) -o $@ $< $(BUILD)/liblom.a $(LDLIBS)

# The programs of the lessons, with public headers alone.
$(BUILD)/docs/lessons/%: docs/lessons/%.c $(BUILD)/liblom.a
	@mkdir -p $(@D)
	$(call short,CC)$(CC) -Iinclude $(CFLAGS) -MMD -MP $(LDFLAGS) -o $@ $< $(BUILD)/liblom.a $(LDLIBS)

$(BUILD)/docs/lessons/%.contained.o: docs/lessons/%.c $(BUILD)/flags
	@mkdir -p $(@D)
	$(call short,CC)$(CC) -Iinclude $(CFLAGS) -Dmain=lom_lesson_$(*F) -Wno-missing-prototypes -MMD -MP -c -o $@ $<

# A lesson for its page: recorded, and each of its stores told where the compiler can (clang).
PAGE_FLAGS = -DLOM_LANES=4 -DLOM_VARIANT=4_recorded -DLOM_RECORD -Dmain=lom_lesson_main -Wno-missing-prototypes -Isrc -include web/lesson_told.h
$(BUILD)/docs/lessons/%.page.o: docs/lessons/%.c $(BUILD)/flags
	@mkdir -p $(@D)
	$(call short,CC)$(CC) -Iinclude $(CFLAGS) -O1 $(PAGE_FLAGS) $(if $(findstring clang,$(CC)),-fsanitize-coverage=func$(comma)trace-stores) -MMD -MP -c -o $@ $<

$(BUILD)/docs/lessons/%.page: $(BUILD)/docs/lessons/%.page.o $(page_objects) $(BUILD)/liblom.a
	$(call short,LD)$(CC) $(LDFLAGS) $(PAGE_CALLS:%=-Wl,--wrap=lom_%) -o $@ $^ $(LDLIBS)

# The pages themselves, in PAGES, of programs for WebAssembly (make wasm).
PAGES = $(BUILD)/web
ifneq ($(filter wasm32%,$(MACHINE)),)
define page_rule
$(PAGES)/$(1).html: $(BUILD)/docs/lessons/$(1)/$(1).page $(wildcard docs/lessons/$(1)/*) $(wildcard src/web/*) src/cli/lesson_answers.h
	@mkdir -p $$(@D)
	$$(call short,PAGE)node src/web/page.mjs $(1) $$< $$@
endef
$(foreach lesson,$(notdir $(lesson_sources:.c=)),$(eval $(call page_rule,$(lesson))))

pages: $(foreach lesson,$(notdir $(lesson_sources:.c=)),$(PAGES)/$(lesson).html)
	node src/web/page.mjs index $(PAGES)/index.html
endif

# What compares a student's stage with the right one, in lom: by the gallery's files.
$(BUILD)/docs/lessons/grade/judge.o: docs/lessons/grade/judge.c $(BUILD)/flags
	@mkdir -p $(@D)
	$(call short,CC)$(CC) -Iinclude -Isrc $(CFLAGS) -MMD -MP -c -o $@ $<

# The tests of what the program measures with.
$(BUILD)/tests/measure/%: private LDLIBS := $(BUILD)/measure.a $(BUILD)/liblom.a $(LDLIBS)
$(patsubst %.c,$(BUILD)/%,$(wildcard tests/measure/*.c)): $(BUILD)/measure.a

# The tests of the program's parts.
$(BUILD)/tests/cli/%: private LDLIBS := $(BUILD)/cli.a $(BUILD)/liblom.a $(LDLIBS)
$(patsubst %.c,$(BUILD)/%,$(wildcard tests/cli/*.c)): $(BUILD)/cli.a

# The calls that tests/faults lets fail in turn.
FAULTS = aligned_alloc lom_release pthread_create read write openat linkat fsync close renameat
$(BUILD)/tests/faults/%: private LDFLAGS += $(FAULTS:%=-Wl,--wrap=%)
$(BUILD)/tests/faults/test_trade_faults: private LDLIBS := $(BUILD)/measure.a $(BUILD)/liblom.a $(LDLIBS)
$(BUILD)/tests/faults/test_trade_faults: $(BUILD)/measure.a

# Outside witnesses, for make check-long alone: no library of theirs is ever linked with lom.
$(BUILD)/tests/witness/witness_mathematics.w4: private LDLIBS := -lmpfr -lgmp $(LDLIBS)
$(BUILD)/tests/witness/witness_transforms: private LDLIBS := -lfftw3 $(LDLIBS)
$(BUILD)/tests/witness/witness_picture.w4: private LDLIBS := -lEGL -lGLESv2 $(LDLIBS)
$(BUILD)/tests/witness/witness_volume: tests/witness/witness_volume.cc $(BUILD)/liblom.a tests/check.h
	@mkdir -p $(@D)
	$(call short,CXX)$(CXX) -std=c++17 -O1 -Wno-psabi -Iinclude -Itests $(LDFLAGS) -o $@ $< $(BUILD)/liblom.a -lopenvdb -ltbb -lImath-3_1 $(LDLIBS)

# Another system's answers.
$(BUILD)/tests/base/test_cpu: private LDFLAGS += -Wl,--wrap=sysconf -Wl,--wrap=sched_getaffinity

# tests/render/test_shaders tries the shaders of all draws.
$(foreach v,$(VARIANTS),$(BUILD)/tests/render/test_shaders.w$v): private LDFLAGS += -Wl,--wrap=lom_draw -Wl,--wrap=lom_hold_draw

# tests/world counts which files are opened.
$(BUILD)/tests/world/test_world: private LDFLAGS += -Wl,--wrap=openat

# A fuzz target on files given as arguments, without libFuzzer: tests/fuzz/test_corpus.sh runs the corpus with these.
$(BUILD)/tests/fuzz/run_%: tests/fuzz/%.c tests/fuzz/main.c tests/fuzz/bytes.h $(BUILD)/liblom.a
	@mkdir -p $(@D)
	$(call short,CC)$(CC) $(CPPFLAGS) $(CFLAGS) $(LDFLAGS) -o $@ $< tests/fuzz/main.c $(PROGRAM_PART) $(BUILD)/liblom.a $(LDLIBS)

$(BUILD)/tests/fuzz/fuzz_%: tests/fuzz/fuzz_%.c tests/fuzz/bytes.h $(BUILD)/liblom.a
	@mkdir -p $(@D)
	$(call short,CC)$(CC) $(CPPFLAGS) $(CFLAGS) $(LDFLAGS) -fsanitize=fuzzer -o $@ $< $(PROGRAM_PART) $(BUILD)/liblom.a $(LDLIBS)

# The command line belongs to the program, not to the library.
OPTIONS_FUZZERS = $(BUILD)/tests/fuzz/run_fuzz_options $(BUILD)/tests/fuzz/fuzz_options
$(OPTIONS_FUZZERS): private PROGRAM_PART = $(BUILD)/src/cli/options.o
$(OPTIONS_FUZZERS): $(BUILD)/src/cli/options.o

SECONDS = 60
fuzz:
	$(MAKE) CC=clang BUILD=build-fuzz SAN=address,undefined,fuzzer-no-link $(fuzz_targets:%=build-fuzz/tests/fuzz/%)
	for target in $(fuzz_targets); do \
	    mkdir -p build-fuzz/corpus/$$target; \
	    build-fuzz/tests/fuzz/$$target -max_total_time=$(SECONDS) -artifact_prefix=build-fuzz/ -print_final_stats=1 \
	        -close_fd_mask=2 \
	        build-fuzz/corpus/$$target $$(ls -d tests/fuzz/corpus/$$target 2>/dev/null) || exit 1; \
	done

# Every page and public header as HTML, its links followed (docs/site.sh; wants cmark-gfm).
docs:
	docs/site.sh $(BUILD)/docs $(BUILD)/web

# Waits for what drawing a scene on this processor needs alone: of the program's objects those are left out that are of other
# lanes or of commands but render, and what nothing else calls. A function that is not there stops the demo with a sentence
# ($(BUILD)/demo/absent.c). The others are the whole program's, and make goes on from there.
demo: $(BUILD)/demo/lom
	$(BUILD)/demo/lom render assets/scenes/lake.toml -o demo-lake.png
	$(BUILD)/demo/lom render assets/scenes/flight.toml -o demo.png

NM = nm
cpu           := $(if $(filter demo,$(MAKECMDGOALS)),$(shell grep -m1 ^flags /proc/cpuinfo 2>/dev/null))
widest        := $(if $(filter-out $(cpu),avx512f avx512dq avx512bw avx512vl avx512cd),$(if $(filter avx2,$(cpu)),8),16)
demo_variants := $(filter 4 $(widest),$(VARIANTS))
demo_cli      := $(patsubst %,src/cli/%.c,main render frame_output frame_stats json one_colour options part paths picture_kinds progress \
	scene_options shard show_pass signals watch)
demo_inspect  := $(patsubst %,src/inspect/%.c,eyes show show_surface)
demo_geometry := $(patsubst %,src/geometry/%.c,build_% builder% crease erode_% make_% model obj_write output paint_% shapes)
demo_apart    := $(filter-out $(demo_cli) $(demo_inspect),$(filter src/cli/% src/inspect/% src/image/compare_% $(demo_geometry),$(sources)))
demo_objects  := $(filter-out $(BUILD)/src/lanes/variants.o $(patsubst %.c,$(BUILD)/%.o,$(demo_apart)) \
	$(foreach v,$(filter-out $(demo_variants),$(VARIANTS) $(RECORDED)),%.w$v.o),$(cli_objects) $(lib_objects))

$(BUILD)/demo/lom: $(demo_objects) $(COUNTING) $(BUILD)/demo/variants.o $(BUILD)/demo/absent.o
	$(call short,LD)$(CC) $(LDFLAGS) -o $@ $^ $(LDLIBS)

$(BUILD)/demo/variants.o: src/lanes/variants.c $(BUILD)/flags
	@mkdir -p $(@D)
	$(call short,CC)$(CC) $(CPPFLAGS) -ULOM_EACH_VARIANT '-DLOM_EACH_VARIANT(X,name)=$(foreach v,$(demo_variants),X(name,$v))' $(CFLAGS) -MMD -MP -c -o $@ $<

$(BUILD)/demo/absent.o: $(BUILD)/demo/absent.c
	$(call short,CC)$(CC) $(CFLAGS) -c -o $@ $<

$(BUILD)/demo/absent.c: $(demo_objects)
	@mkdir -p $(@D)
	@$(NM) -g -P $^ | awk -v all='$(ALL_VARIANTS) $(RECORDED)' 'BEGIN { gsub(" ", "|", all); \
	    print "\43include <stdio.h>\n\43include <stdlib.h>\nstatic void stop(void)\n{\n    fputs(\"lom: make demo has compiled what draws a scene here and nothing else; make compiles all of it.\\n\", stderr);\n    exit(2);\n}" } \
	    $$2 == "U" { used[$$1] } $$2 ~ /^[A-TV-Z]$$/ { there[$$1] } END { for (name in used) \
	    if (!(name in there) && (name ~ "_(" all ")$$" || name ~ /^lom_command_/)) print "void " name "(void);\nvoid " name "(void)\n{\n    stop();\n}" }' >$@

check: all $(programs) $(lessons) $(fuzz_targets:%=$(BUILD)/tests/fuzz/run_%)
	@CC='$(CC)' BUILD='$(BUILD)' SAN='$(SAN)' tests/run $(programs) $(test_scripts)

# Tests that fail are shown and are no reason to stop: what they executed counts. The lowered widths run on every processor.
LEAST = 98
coverage:
	-$(MAKE) COVERAGE=1 O=1 BUILD=build-coverage VARIANTS="4 8_plain 16_plain" check
	@BUILD=build-coverage LEAST=$(LEAST) tests/house/coverage.sh

$(BUILD)/tests/house/coverage.o: tests/house/coverage.c $(BUILD)/flags
	@mkdir -p $(@D)
	$(call short,CC)$(CC) $(CPPFLAGS) $(CFLAGS) -c -o $@ $<

# Every float through every conversion (a minute) and every unary lane function (a quarter of an hour).
LONG_TESTS = $(BUILD)/tests/image/test_convert $(BUILD)/tests/image/test_convert_lanes.w4 $(BUILD)/tests/lanes/test_mathematics.w4 $(BUILD)/tests/lanes/test_every_float.w4 $(BUILD)/tests/render/test_key_ranges $(BUILD)/tests/render/test_change $(BUILD)/tests/render/test_packets $(BUILD)/tests/render/test_shaders.w4 $(BUILD)/tests/inspect/test_explain
check-long: all $(LONG_TESTS)
	for program in $(LONG_TESTS); do LOM_EXHAUSTIVE=1 LOM_SECONDS=$(SECONDS) $$program || exit 1; done
	BUILD='$(BUILD)' docs/pictures.sh --check
	BUILD='$(BUILD)' tests/house/many_machines.sh
	MAKE='$(MAKE)' CC='$(CC)' CXX='$(CXX)' BUILD='$(BUILD)' VARIANTS='$(VARIANTS)' tests/witness/witnesses.sh

# For WebAssembly, by the newest clang; SIMD= leaves out its vectors of 128 bits. The pages want node and cmark-gfm.
WASM_CC = $(or $(lastword $(sort $(notdir $(wildcard /usr/bin/clang-[1-9][0-9])))),clang)
SIMD    = -msimd128
MISSING = $(strip $(foreach tool,node cmark-gfm,$(if $(shell command -v $(tool)),,$(tool))))
WASM_GOALS = $(BUILD)/wasm/lom.wasm $(if $(MISSING),,pages)
wasm:
	$(MAKE) CC='$(LAUNCHER) $(WASM_CC) --target=wasm32-wasi $(SIMD)' AR=llvm-ar VARIANTS=4 SAN= BUILD=$(BUILD)/wasm PAGES=$(BUILD)/web $(WASM_GOALS)
	@$(if $(MISSING),echo "SKIP the lessons' pages: they need $(MISSING).")

$(BUILD)/lom.wasm: $(BUILD)/lom
	cp $< $@

# One hash from gcc and clang at every level, and from emulated architectures (bench/results/matrix.md).
matrix:
	@BUILD='$(BUILD)' ROWS='$(ROWS)' LAUNCHER='$(LAUNCHER)' tests/house/matrix.sh

# Milliseconds a frame of every workload; against other renderers, in turn, into bench/results/peers-1280x720.md.
bench: $(BUILD)/lom
	$(BUILD)/lom bench

bench-peers: $(BUILD)/lom
	BUILD='$(BUILD)' bench/peers.sh

# Milliseconds of every model of water, and its error against the reference (bench/results/water-models.md).
bench-water-models: $(BUILD)/lom
	BUILD='$(BUILD)' bench/water_models.sh

# Milliseconds of every stage of a large sea (bench/results/sea.md).
bench-sea: $(BUILD)/lom
	BUILD='$(BUILD)' bench/sea.sh

# Fourier transforms against FFTW's, which has to be installed (bench/results/fft.md).
bench-fft: $(BUILD)/bench/fft
	BUILD='$(BUILD)' bench/fft.sh

$(BUILD)/bench/fft: bench/fft.c $(BUILD)/liblom.a
	@mkdir -p $(@D)
	$(call short,CC)$(CC) $(CPPFLAGS) -Isrc $(CFLAGS) $(LDFLAGS) -o $@ $< $(BUILD)/liblom.a -lfftw3f $(LDLIBS)

# Drops of a waterfall: placed, made into sprites, ordered, drawn (bench/results/particles.md).
bench-particles: $(BUILD)/lom $(BUILD)/bench/particles
	BUILD='$(BUILD)' bench/particles.sh

$(BUILD)/bench/particles: bench/particles.c $(BUILD)/liblom.a
	@mkdir -p $(@D)
	$(call short,CC)$(CC) $(CPPFLAGS) -Isrc $(CFLAGS) $(LDFLAGS) -o $@ $< $(BUILD)/liblom.a $(LDLIBS)

# A changed key of flight and lake (bench/results/change.md).
bench-change: $(BUILD)/bench/change
	BUILD='$(BUILD)' bench/change.sh

$(BUILD)/bench/change: bench/change.c $(BUILD)/liblom.a
	@mkdir -p $(@D)
	$(call short,CC)$(CC) $(CPPFLAGS) $(CFLAGS) $(LDFLAGS) -o $@ $< $(BUILD)/liblom.a $(LDLIBS)

# Where one worker of a frame is alone, by processor time (bench/results/serial.md).
DOORS = lom_run_pool lom_offer_work lom_device_shared_seconds
bench-serial: $(BUILD)/bench/serial
	$< 320x180 2 6 assets/scenes/*.toml assets/scenes/features/*.toml
	$< 1280x720 2 4 assets/scenes/*.toml

$(BUILD)/bench/serial: bench/serial.c $(BUILD)/liblom.a
	@mkdir -p $(@D)
	$(call short,CC)$(CC) $(CPPFLAGS) $(CFLAGS) $(LDFLAGS) $(DOORS:%=-Wl,--wrap=%) -o $@ $< $(BUILD)/liblom.a $(LDLIBS)

# Steps of shallow water (bench/results/shallow.md).
bench-shallow: $(BUILD)/bench/shallow
	BUILD='$(BUILD)' bench/shallow.sh

$(BUILD)/bench/shallow: bench/shallow.c $(BUILD)/liblom.a
	@mkdir -p $(@D)
	$(call short,CC)$(CC) $(CPPFLAGS) $(CFLAGS) $(LDFLAGS) -o $@ $< $(BUILD)/liblom.a $(LDLIBS)

# Sweeps of a grid of light, towards suns all around (bench/results/light-grid.md).
bench-light-grid: $(BUILD)/bench/light_grid
	$<

$(BUILD)/bench/light_grid: bench/light_grid.c $(BUILD)/liblom.a
	@mkdir -p $(@D)
	$(call short,CC)$(CC) $(CPPFLAGS) $(CFLAGS) $(LDFLAGS) -o $@ $< $(BUILD)/liblom.a $(LDLIBS)

# What models of clouds scatter, against random paths (bench/results/cloud-octaves.md).
bench-octaves: $(BUILD)/bench/octaves
	$(BUILD)/bench/octaves

$(BUILD)/bench/octaves: bench/octaves.c $(BUILD)/liblom.a
	@mkdir -p $(@D)
	$(call short,CC)$(CC) $(CPPFLAGS) $(CFLAGS) $(LDFLAGS) -o $@ $< $(BUILD)/liblom.a $(LDLIBS)

# The experiments on clouds (bench/results/clouds-*.csv, docs/cloud-experiments.md).
bench-clouds: $(BUILD)/lom $(BUILD)/bench/next_power.w4
	BUILD='$(BUILD)' bench/clouds.sh

# Milliseconds of every stage of a flight past 30 clouds on impostors (bench/results/impostors.md).
bench-impostors: $(BUILD)/lom
	BUILD='$(BUILD)' bench/impostors.sh

# Nanoseconds a value of the lane mathematics (bench/results/lane-mathematics.md).
bench-mathematics: $(foreach v,4 8 16,$(BUILD)/bench/lane_mathematics.w$(v))
	for program in $^; do $$program || exit 1; done

# Nanoseconds a texture sample (bench/results/sampling.md).
bench-sampling: $(foreach v,4 8 16,$(BUILD)/bench/sampling.w$(v))
	for program in $^; do $$program || exit 1; done

format:
	clang-format -i $(wildcard include/lom/*.h src/*/*.[ch] src/*/*/*.[ch] tests/*.h tests/*/*.[ch] docs/lessons/*/*.[ch])

# The installed library: header files, both libraries, the program, pkg-config's file, the compiler of shaders and the lessons.
INSTALL_BIN = $(DESTDIR)$(PREFIX)/bin
INSTALL_LIB = $(DESTDIR)$(PREFIX)/lib
INSTALL_INC = $(DESTDIR)$(PREFIX)/include/lom
INSTALL_LESSONS = $(DESTDIR)$(PREFIX)/share/lom/lessons
lesson_files := $(patsubst docs/lessons/%,%,$(wildcard docs/lessons/*.md docs/lessons/*/*))
FILL = sed -e 's|@PREFIX@|$(PREFIX)|g; s|@LIBDIR@|$(PREFIX)/lib|g; s|@INCLUDEDIR@|$(PREFIX)/include|g' \
	-e 's|@VERSION@|$(VERSION)|g; s|@FLOAT_FLAGS@|$(FLOAT_FLAGS)|g; s|@FLAGS_AVX512@|$(AVX512)|g' \
	-e 's|@VARIANTS@|4 $(filter-out 4,$(VARIANTS))|g; s| @EACH_VARIANT@|$(EACH_VARIANT:%= %)|g'
install: all
	mkdir -p $(INSTALL_BIN) $(INSTALL_LIB)/pkgconfig $(INSTALL_INC)
	install -m 755 $(BUILD)/lom $(INSTALL_BIN)/lom
	install -m 644 $(BUILD)/liblom.a $(INSTALL_LIB)/liblom.a
	install -m 755 $(BUILD)/liblom.so $(INSTALL_LIB)/liblom.so.$(ABI)
	ln -sf liblom.so.$(ABI) $(INSTALL_LIB)/liblom.so
	install -m 644 include/lom/*.h $(INSTALL_INC)
	$(FILL) src/lanes/lom.pc.in > $(INSTALL_LIB)/pkgconfig/lom.pc
	$(FILL) src/lanes/lom-cc > $(INSTALL_BIN)/lom-cc
	chmod 755 $(INSTALL_BIN)/lom-cc
	mkdir -p $(addprefix $(INSTALL_LESSONS)/,$(sort $(dir $(lesson_files))))
	for file in $(lesson_files); do install -m 644 docs/lessons/$$file $(INSTALL_LESSONS)/$$file || exit 1; done

# What install puts there, and its folder of headers where it is empty then.
uninstall:
	rm -f $(INSTALL_BIN)/lom $(INSTALL_BIN)/lom-cc $(INSTALL_LIB)/liblom.a $(INSTALL_LIB)/liblom.so $(INSTALL_LIB)/liblom.so.$(ABI) \
	    $(INSTALL_LIB)/pkgconfig/lom.pc $(patsubst include/lom/%,$(INSTALL_INC)/%,$(wildcard include/lom/*.h))
	rm -f $(addprefix $(INSTALL_LESSONS)/,$(lesson_files))
	-rmdir $(INSTALL_INC) $(addprefix $(INSTALL_LESSONS)/,$(filter-out ./,$(sort $(dir $(lesson_files))))) \
	    $(INSTALL_LESSONS) $(DESTDIR)$(PREFIX)/share/lom 2>/dev/null

# Format, layers, conversions to integers, exported names, header files alone in C and C++, cppcheck. Tools that are not installed are named.
lint: $(BUILD)/liblom.a
	CC='$(CC)' BUILD='$(BUILD)' tests/house/lint.sh

clean:
	rm -rf $(BUILD)

-include $(BUILD)/demo/variants.d $(lib_objects:.o=.d) $(measure_objects:.o=.d) $(cli_objects:.o=.d) $(lesson_objects:.o=.d) $(page_objects:.o=.d) $(page_programs:=.d) $(programs:=.d) $(lessons:=.d)
