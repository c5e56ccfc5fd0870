# Targets are listed by `make help`, from the comments after ##.

SHELL := /bin/bash
.SHELLFLAGS := -euo pipefail -c
.DEFAULT_GOAL := all
.PHONY: all digests docs pictures setup setup-all test peers python rtl bench pareto exhaustive cluster formal formal-quick synth gates mutants mutants-rust fuzz \
	alterations c header install uvm book package clean help

CARGO ?= cargo
RESULTS ?= results
# Presets for exhaustive and mutants; none named means those they choose themselves.
PRESETS ?=
# One profile for all of `make test`, and there the programs that the tests built: `cargo run` would leave out what only
# tests ask of the libraries, and so compile them all again.
TARGET = $(or $(CARGO_TARGET_DIR),target)
CHECKED = --profile release-checked
TESTED = $(TARGET)/release-checked/blysk-under-test
BLYSK = $(CARGO) run --release --locked --quiet --bin blysk --
VENV = target/venv
# Properties are tried on the same inputs every time, so that the same tree gives the same answer. Others come with
# `make test PROPTEST_RNG_SEED=2 PROPTEST_CASES=40000`.
export PROPTEST_RNG_SEED ?= 1
# What of scripts/freeze takes seconds; all of it takes minutes, and is for a change that moves code.
FREEZE = scripts/freeze --blysk $(TESTED) --out $(RESULTS)/frozen \
	--only example_small/ --only example_parabolas/ --only example_quartics/ --only alone/
FORMAL = scripts/formal.py --blysk "$(BLYSK)"

# Exit status 1 of `blysk report` says that a bound does not hold for some preset. Here that is a
# finding, which the table shows; anything greater is an error.
REPORT = status=0; $(BLYSK) report --all-presets $(1) || status=$$?; test $$status -le 1 || exit $$status

all: ## build, measure every preset, and write reports, plots and test vectors to results/
	@echo "Building blysk and measuring every preset..."
	@$(call REPORT,--out $(RESULTS)); \
	$(BLYSK) vectors --preset paper --count 4096 --seed 1 --out $(RESULTS)/paper/vectors; \
	echo; \
	echo "Results are in $(RESULTS)/, one directory for each preset:"; \
	echo "  error_vs_n.csv, .json        every part of the error, for every exponent n"; \
	echo "  error_vs_n.svg, .png         error on the epicentre against n, with the bound (the paper's Fig. 1)"; \
	echo "  error_full_range.svg, .png   the parts of the error on all of [0, 1]"; \
	echo "  curves.svg, .png             Phong, Schlick and the hardware against the angle (Fig. 3)"; \
	echo "  paper/vectors/               stimulus, expected results and ROM for an RTL testbench"; \
	if [ $$status -eq 1 ]; then \
		echo "On the epicentre the bound does not hold for every preset: the table above says for which."; \
	else \
		echo "On the epicentre the bound holds for every exponent of every preset."; \
	fi

docs: ## write the hardware reference, docs/hardware/, and docs/CLAIMS.md again
	@mkdir -p target
	@$(BLYSK) document --all-presets --out docs/hardware
	@$(BLYSK) claims --format markdown > target/claims.md
	@mv target/claims.md docs/CLAIMS.md

# One scene and preset to a line of the list below; each gives the named picture of `blysk render`.
PICTURES = torus_knot:paper:pipeline:480x270 one_material:paper:methods:240x180 \
	many_materials:paper:pipeline:480x300 many_materials:paper:difference:480x300

pictures: ## docs/pictures/, and the mesh and the schema of docs/scenes, written again
	@$(BLYSK) mesh --out docs/scenes/torus_knot.obj
	@mkdir -p docs/pictures $(RESULTS)
	@$(BLYSK) scene --schema > $(RESULTS)/scene.schema.json
	@mv $(RESULTS)/scene.schema.json docs/scene.schema.json
	@for picture in $(PICTURES); do \
		IFS=: read -r scene preset name size <<< "$$picture"; \
		out=$(RESULTS)/scenes/$${scene}_$$preset; \
		$(BLYSK) render docs/scenes/$$scene.json --preset $$preset --size $$size --out $$out --format csv > /dev/null; \
		target=$${scene}_$$([ $$name = pipeline ] && echo $$preset || echo $$name).png; \
		cp $$out/$$name.png docs/pictures/$$target; \
	done

setup: ## install what the tests need and cargo does not bring
	@scripts/setup

setup-all: ## and what proofs and synthesis need
	@scripts/setup --all

test: setup ## everything that is checked: format, spelling, lints, documentation, tests, RTL
	$(CARGO) fmt --all --check
	$(VENV)/bin/typos
	PATH="$$PWD/$(VENV)/bin:$$PATH" $(CARGO) deny --locked check licenses bans sources
	$(CARGO) clippy $(CHECKED) --workspace --all-targets --locked -- -D warnings
	RUSTDOCFLAGS="-D warnings" $(CARGO) doc $(CHECKED) --workspace --no-deps --locked
	$(CARGO) test $(CHECKED) --workspace --locked
	$(PACKAGE) --no-verify --allow-dirty --quiet
	@tests/netlist/test_block_registers.py
	@scripts/synth.py --check --blysk $(TESTED)
	@scripts/delays.py --check --blysk $(TESTED)
	@rm -rf $(RESULTS)/frozen
	@$(FREEZE) --against tests/frozen/DIGESTS
	$(TARGET)/release-checked/cosimulate --covering

digests: ## tests/frozen/DIGESTS written again, after a change of output that is meant
	$(CARGO) build $(CHECKED) --locked --quiet --bin blysk-under-test
	@rm -rf $(RESULTS)/frozen
	@$(FREEZE)
	@cp $(RESULTS)/frozen/DIGESTS tests/frozen/DIGESTS

rtl: setup ## every preset's RTL in Icarus and both Verilators, beside the model
	$(CARGO) run $(CHECKED) --locked --quiet --bin cosimulate

peers: ## certified bounds and refined integers beside Sollya's, where that is installed
	$(CARGO) build --release --locked --quiet --bin blysk
	@tests/peers/supnorm.py --blysk "$(BLYSK)"
	@tests/peers/fpminimax.py --blysk "$(BLYSK)"

python: setup ## the wheel of hw-model/bindings/python, installed in target/venv-python, with its tests
	@scripts/python

bench: setup ## speed beside Verilator's, results checked first; DOCS=1 writes docs/BENCHMARKS.md
	$(CARGO) run --locked --quiet --release --bin bench -- $(if $(DOCS),--docs docs/BENCHMARKS.md)
	$(CARGO) bench --package analysis --bench throughput --locked
	$(CARGO) bench --package blysk-c --bench checker --locked

pareto: ## what precision costs, every contender at every x: docs/pareto.csv, docs/PARETO.md and its plots; minutes
	@mkdir -p target
	@$(BLYSK) pareto --synth docs/synthesis.csv --out $(RESULTS)/pareto --format markdown > target/pareto.md
	@mkdir -p docs/pareto
	@cp $(RESULTS)/pareto/pareto.csv docs/pareto.csv
	@cp $(RESULTS)/pareto/*.svg docs/pareto/
	@sed -i -e '/^<!-- tables/,/^<!-- end/{/^<!--/!d}' -e '/^<!-- tables/r target/pareto.md' docs/PARETO.md

exhaustive: setup ## every representable x: the error of every preset, and the RTL of two; takes long
	@$(call REPORT,--exhaustive --out $(RESULTS)/exhaustive); \
	echo "Results are in $(RESULTS)/exhaustive/."
	$(CARGO) run --locked --quiet --release --bin exhaustive -- $(PRESETS)

cluster: ## a Slurm of four nodes here: a worker killed, a node lost, and the report of one machine; wants root, minutes
	$(CARGO) build --release --locked --quiet --bin blysk
	scripts/cluster --blysk $(TARGET)/release/blysk

formal: setup-all ## prove the RTL: handshake, arithmetic, pipeline; some minutes
	@$(FORMAL) --out $(RESULTS)/formal

formal-quick: setup-all ## the handshake alone, and that the proof finds bugs planted in it
	@$(FORMAL) --preset compact --property handshake

synth: setup-all ## synthesise every preset for two FPGAs, and write the table of docs/SYNTHESIS.md
	@scripts/synth.py --blysk "$(BLYSK)" --out $(RESULTS)/synth

gates: setup-all ## the area of every preset in the cells of a free library, and the table of docs/SYNTHESIS.md
	@scripts/gates.py --blysk "$(BLYSK)"

mutants: setup ## wrong RTL, made on purpose, under the emitted vectors; takes long
	BLYSK_JUDGED=all $(CARGO) test --locked --quiet --release --package blysk-tests --test equivalent_mutants \
		judgements_are_those_of_every_input
	$(CARGO) run --locked --quiet --release --bin mutants -- $(PRESETS)

mutants-rust: ## the Rust code altered on purpose: which alterations its tests do not see; takes hours
	@scripts/mutants-rust

fuzz: ## every reader on altered files, for MINUTES=30; what is found is kept in results/fuzz
	$(CARGO) run $(CHECKED) --locked --quiet --bin fuzz -- $(or $(MINUTES),30) $(SEED)

alterations: ## thousands of altered and resealed certificates: none accepted that says what is not so
	BLYSK_ALTERATIONS=$(or $(ALTERATIONS),2500) $(CARGO) test $(CHECKED) --locked --package blysk-tests \
		--test altered_certificates -- --nocapture

c: ## the C library with header, pkg-config file, DPI-C and VPI sources, in target/c/
	$(CARGO) build --release --locked --package blysk-c
	@scripts/c-library $(TARGET)/release target/c $(CURDIR)/target/c

uvm: setup c ## the UVM environment of the C library on emitted RTL, in Verilator; minutes
	@rm -rf $(RESULTS)/uvm
	@$(BLYSK) rtl --preset compact --count 16 --seed 1 --out $(RESULTS)/uvm
	@scripts/uvm $(RESULTS)/uvm target/c/lib/libblysk.a

header: ## the header of the C library, written again from its sources
	BLYSK_HEADER=write $(CARGO) test $(CHECKED) --locked --quiet --package blysk-c --test header

# DESTDIR is for packagers: what is installed there says that it stands in PREFIX.
PREFIX ?= /usr/local
install: ## the command, its completions and manual pages, and the C library, in PREFIX=/usr/local
	$(CARGO) build --release --locked --package cli --package blysk-c
	@install -D -m 755 $(TARGET)/release/blysk $(DESTDIR)$(PREFIX)/bin/blysk
	@scripts/command-pages $(TARGET)/release/blysk $(DESTDIR)$(PREFIX)
	@scripts/c-library $(TARGET)/release $(DESTDIR)$(PREFIX) $(PREFIX)
	@echo "Installed in $(DESTDIR)$(PREFIX); try: PKG_CONFIG_PATH=$(PREFIX)/lib/pkgconfig pkg-config --libs blysk"

book: ## the pages of docs/ as a book in target/book/, where mdBook is installed
	@command -v mdbook > /dev/null || { echo "make book: mdbook is missing; cargo install --locked mdbook" >&2; exit 1; }
	mdbook build

# Without the tests' crates, which nobody depends on.
PACKAGE = $(CARGO) package --workspace --exclude blysk-tests --exclude naive --locked
package: ## the crates as they would be published, each built from its own package; minutes
	$(PACKAGE)

clean: ## remove everything that was built or written
	$(CARGO) clean
	rm -rf $(RESULTS)

help: ## list the targets
	@sed -nE 's/^([a-z-]+):.*## (.*)/\1\t\2/p' $(firstword $(MAKEFILE_LIST)) | while IFS=$$'\t' read -r target words; do \
		fold -s -w 80 <<< "$$words" | while IFS= read -r line; do \
			printf '  %-17s %s\n' "$${target:+make $$target}" "$${line% }"; target=; \
		done; \
	done
