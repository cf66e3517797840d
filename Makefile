# Each target does its own set-up on a machine that has Python >= 3.10, make and a C compiler, says
# what it installs, and keeps it all in .venv; what tests run beside it (a browser, ROS, CBMC) comes
# from Debian.

PYTHON ?= python3
READY := .venv/.ready
RUN := .venv/bin
HUSKY_RECORDING := ../shared/data/husky_outdoor.bag
# Python keeps what it has compiled: tests start hundreds of programs, and each worker reads all tests.
unexport PYTHONDONTWRITEBYTECODE

.PHONY: help dist demo evaluate study site test check deep bench fmt fuzz clean browser compiler display drawing ros1 prover

help:
	@echo "make demo    rules, checked, compiled and run over a recording; skills, checked and run; the robot,"
	@echo "             and how it learns with rules and without them"
	@echo "make evaluate  all experiments on 30 seeds -> docs/experiments.md; a repeated call continues;"
	@echo "               and films of them -> docs/gallery.md"
	@echo "make study   all trainings on 10 seeds -> docs/learning.md; a repeated call continues; some hours"
	@echo "make site    the documentation site -> build/site"
	@echo "make test    the tests, a quarter of an hour on two processors; OPTIONS='...' are options of pytest"
	@echo "make check   format, lint, types, import layers, and the tests"
	@echo "make deep    slow tests and proofs -> docs/reference/deep-tests.md; two to three hours"
	@echo "make bench   measure, and write docs/reference/performance*.md, beside-nav2.md, library-reuse.md"
	@echo "make dist    build the wheels -> dist/, check them, and try them in each Python of this machine"
	@echo "make fmt     format the code"
	@echo "make fuzz    look for files that crash a reader, for SECONDS=60 each; TARGET=mcap for one"
	@echo "make clean   remove everything that make made"

$(READY): pyproject.toml $(wildcard packages/*/pyproject.toml) constraints.txt tools/setup.sh
	@PYTHON="$(PYTHON)" tools/setup.sh
	@touch $@

compiler:
	@command -v "$${CC:-cc}" >/dev/null || tools/setup_debian.sh gcc libc6-dev

# The timeline is looked at in a browser; without one that test is skipped, and says so.
browser:
	@command -v chromium >/dev/null || command -v chromium-browser >/dev/null || \
	command -v google-chrome >/dev/null || tools/setup_debian.sh chromium

# A window is opened; without a display to open it on that test is skipped, and says so.
display: $(READY)
	@command -v Xvfb >/dev/null || tools/setup_debian.sh xvfb libgl1 libgl1-mesa-dri

# Generated nodes are run; without ROS 1 these tests are skipped, and say so. Only Debian has it.
ros1:
	@command -v rosmaster >/dev/null && command -v catkin_make >/dev/null || \
	! command -v apt-get >/dev/null || tools/setup_ros1.sh

# The generated C is proved; without CBMC 6 these tests are skipped, and say so. Where Debian has no
# package of it, it is in this folder.
PROGRAMS = $(or $(XDG_CACHE_HOME),$(HOME)/.cache)/rossmarie/prover/programs
prover: $(READY)
	@tools/setup_prover.sh

# The simulation is drawn without a display; where that cannot be, the page is without pictures.
drawing: $(READY)
	@$(RUN)/python -c 'import ctypes.util, sys; sys.exit(not ctypes.util.find_library("EGL"))' || \
	tools/setup_debian.sh libegl1 libgl1 libgl1-mesa-dri

demo: $(READY) compiler drawing
	$(RUN)/python examples/demo/record.py build/demo
	$(RUN)/rossmarie check examples/demo/demo.ross
	$(RUN)/rossmarie replay examples/demo/demo.ross build/demo --out build/demo/report
ifneq ($(wildcard $(HUSKY_RECORDING)),)
	$(RUN)/rossmarie replay examples/husky/husky.ross $(HUSKY_RECORDING) --out build/husky
	@echo "the real drive:  open $(CURDIR)/build/husky/timeline.html in a browser"
endif
	$(RUN)/ezskiros check examples/pick_place/skills
	$(RUN)/ezskiros show pick_and_place examples/pick_place/skills --depth 1 --no-conditions
	$(RUN)/ezskiros show pick_and_place examples/pick_place/skills --depth 1 --format svg --out build/demo/tree.svg
	$(RUN)/ezskiros run PickAndPlace examples/pick_place/skills \
		--scene examples/pick_place/lab.turtle --out build/demo/lab_after.turtle \
		Object=starter Gripper=gripper PlacingLocation=shelf
	$(RUN)/heron demo --out build/demo/heron.html || [ $$? -eq 2 ]
	$(RUN)/heron learn tree --arm unguarded --arm guard --steps 40000 --out build/demo || [ $$? -eq 2 ]
	@echo "mistakes that are planted, in rules and in skills:"
	@$(RUN)/rossmarie check examples/thesis/arm_as_printed.ross || true
	@$(RUN)/ezskiros check examples/pick_place/planted || true
	@echo "the tree:        open $(CURDIR)/build/demo/tree.svg in a browser"
	@echo "the timeline:    open $(CURDIR)/build/demo/report/timeline.html in a browser"
	@[ ! -e build/demo/heron.html ] || echo "the robot:       open $(CURDIR)/build/demo/heron.html in a browser"
	@[ ! -e build/demo/learning.md ] || echo "the learning:    open $(CURDIR)/build/demo/learning/tree-cma-es-40000.svg in a browser"

evaluate: $(READY) compiler drawing
	$(RUN)/heron evaluate --out docs
	$(RUN)/heron gallery --out docs

study: $(READY) compiler
	$(RUN)/heron learn steps --seeds 10 --out docs
	$(RUN)/heron learn tree --seeds 10 --out docs
	$(RUN)/heron learn moves --arm unguarded --arm guard --arm guard_feedback --seeds 10 --out docs
	$(RUN)/heron learn steps --algorithm sac --arm unguarded --arm guard --seeds 10 --out docs

# The tests build the site too, strictly, and follow its links.
site: $(READY)
	@$(RUN)/python tools/website/build_site.py

# Live tests mostly wait, so there are more workers than processors. A worker takes whole files, in
# the order of tests/support/order.py.
WORKERS ?= $(shell expr $$(getconf _NPROCESSORS_ONLN) + 2)
test: $(READY) compiler browser display ros1 prover
	$(RUN)/pytest -n $(WORKERS) --dist loadfile --no-loadscope-reorder $(OPTIONS)

# Wheels and source distributions of packages/. The trials fetch from PyPI what the wheels need.
dist: $(READY)
	$(RUN)/python tools/dist.py

# Before a change of the generator, the semantics or the nodes lands.
deep: $(READY) compiler browser display ros1 prover
	$(RUN)/python tools/deep.py

check: $(READY)
	$(RUN)/ruff format --check
	$(RUN)/ruff check
	$(RUN)/mypy
	$(RUN)/lint-imports
	$(MAKE) test
	@$(RUN)/python tools/deep.py --remind

bench: $(READY) compiler ros1 prover
	@benchmarks/peers/setup.sh
	PYTHONPATH=tests $(RUN)/python benchmarks/run.py --out docs/reference/performance.md
	PYTHONPATH=tests:$$PYTHONPATH $(RUN)/python benchmarks/ros_nodes.py --out docs/reference/performance-nodes.md
	PYTHONPATH=tests:$$PYTHONPATH $(RUN)/python benchmarks/recovering.py --out docs/reference/performance-recovery.md
	$(RUN)/python benchmarks/operators.py --out docs/reference/performance-operators.md
	$(RUN)/python benchmarks/places.py --out docs/reference/performance-places.md
	$(RUN)/python benchmarks/scans.py --out docs/reference/performance-scans.md
	$(RUN)/python benchmarks/queries.py --out docs/reference/performance-queries.md
	$(RUN)/python benchmarks/replaying.py --out docs/reference/performance-replay.md
	PYTHONPATH=tests:$$PYTHONPATH $(RUN)/python benchmarks/beside_nav2.py --out docs/reference/beside-nav2.md
	PYTHONPATH=tests:$$PYTHONPATH $(RUN)/python benchmarks/library_reuse.py --out docs/reference/library-reuse.md
	PATH=$(PROGRAMS):$$PATH $(RUN)/python benchmarks/proofs.py --out docs/reference/performance-proofs.md
	$(RUN)/python benchmarks/guarding.py --out docs/reference/performance-guard.md
	$(RUN)/python benchmarks/heron_run.py --out docs/reference/performance-heron.md
	$(RUN)/python benchmarks/learning.py --out docs/reference/performance-learning.md
	$(RUN)/python benchmarks/ezskiros_run.py --out docs/reference/performance-ezskiros.md

fmt: $(READY)
	$(RUN)/ruff format
	$(RUN)/clang-format -i $$(find src/rossmarie/runtime tests/rossmarie/runtime -name "*.h" -o -name "*.cpp" -o -name "*.c")
	$(RUN)/ruff check --fix
	$(RUN)/rossmarie fmt $(filter-out %_as_printed.ross,$(wildcard examples/*/*.ross src/heron/rules/*.ross))

SECONDS ?= 60
TARGET ?= all
fuzz: $(READY)
	@$(RUN)/python -c 'import atheris' 2>/dev/null || EXTRAS=fuzz tools/setup.sh || \
	echo "without atheris: random changes, not led by coverage"
	PYTHONPATH=tests $(RUN)/python -m fuzz.fuzz_check --seconds $(SECONDS) --target $(TARGET)

clean:
	rm -rf .venv build dist .mypy_cache .ruff_cache .pytest_cache .hypothesis .import_linter_cache
	rm -rf src/*.egg-info
	find src tests examples benchmarks tools -name __pycache__ -type d -prune -exec rm -rf {} +
