# The way in. `make run` and `make test` need Python 3.11 or newer and a network once; nothing else.

VENV := .venv/bin
# The first Python on the path that is new enough; to choose another: make PYTHON=/path/to/python3 install
PYTHON = $(shell for python in python3.11 python3.12 python3.13 python3.14 python3; do \
	$$python -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null && echo $$python && break; done)

.PHONY: help install run test test-long check docs wheel gallery examples lock clean

help:
	@echo "make install   set up .venv in this folder (once; later calls only check)"
	@echo "make run       set up, then solve the reference pump at 2100 r/min, 35 MPa, full displacement"
	@echo "make test      set up, then run all tests but those of minutes"
	@echo "make test-long set up, then run the tests of minutes"
	@echo "make check     set up, then style (ruff), types (mypy), direction of imports (import-linter), documentation"
	@echo "make docs      set up, then build the documentation site into build/site; needs no network"
	@echo "make wheel     set up, then build the wheel and run the first examples with it alone; needs a network"
	@echo "make gallery   set up, then solve the examples of the gallery and draw docs/gallery.md anew"
	@echo "make examples  set up, then run the examples and write docs/examples anew"
	@echo "make lock      resolve pyproject.toml anew into requirements.lock, keeping versions that still fit"
	@echo "make clean     remove .venv and every cache; keeps runs/"

install:
	@test -n "$(PYTHON)" || { echo "No Python 3.11 or newer on the path: install Debian's python3." >&2; exit 1; }
	@$(PYTHON) tools/bootstrap.py

run: install
	$(VENV)/swashfilm run ref90 --speed 2100rpm --pressure 35MPa --displacement 1.0

test: install
	$(VENV)/python -m pytest -n 2 --dist worksteal

test-long: install
	$(VENV)/python -m pytest -m long

check: install
	$(VENV)/ruff check
	$(VENV)/ruff format --check
	$(VENV)/mypy
	$(VENV)/lint-imports --no-cache
	@$(MAKE) --no-print-directory docs

docs: install
	$(VENV)/sphinx-build -q -W --keep-going -j 2 -c docs/site -b html . build/site
	@echo "build/site/index.html"

wheel: install
	$(VENV)/python tools/try_wheel.py

gallery: install
	$(VENV)/python docs/site/gallery.py

examples: install
	$(VENV)/python docs/site/example_pages.py

lock: install
	$(VENV)/uv pip compile --quiet pyproject.toml --extra dev --extra cluster --extra recordings --universal \
		--python-version 3.11 --generate-hashes --no-header --no-annotate --output-file requirements.lock

clean:
	rm -rf .venv dist build .mypy_cache .ruff_cache .hypothesis
	find . -name __pycache__ -type d -prune -exec rm -rf {} +
