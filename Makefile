# Every target sets up .venv by itself, once, from pyproject.toml. Needs Python 3.11+, a C++ compiler and make.
PYTHON ?= python3
BIN := .venv/bin
READY := .venv/.ready

.DEFAULT_GOAL := help
.PHONY: help setup drive test check format clean

help: ## Show this list.
	@awk -F ':.*## ' '/^[a-z-]+:.*## /{printf "  make %-10s %s\n", $$1, $$2}' $(MAKEFILE_LIST)

setup: $(READY) ## Make .venv with the package and what the tests need (compiles llama.cpp once: some minutes).

$(READY): pyproject.toml
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' \
	  || { echo "Wayword needs Python 3.11 or newer; name one with: make PYTHON=python3.12"; exit 1; }
	@echo "Setting up .venv; llama.cpp is compiled once, which takes some minutes ..."
	$(PYTHON) -m venv .venv
	$(BIN)/pip install --quiet --disable-pip-version-check --editable '.[dev]'
	@touch $@

drive: $(READY) ## Drive the reference scenario with the embedded model: report, log and plots in out/.
	$(BIN)/wayword drive --scenario reference

test: $(READY) ## Run all tests.
	$(BIN)/python -m pytest

check: $(READY) ## Lint, types, import layers.
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports

format: $(READY) ## Format the code and mend what the linter can mend.
	$(BIN)/ruff format .
	$(BIN)/ruff check --fix .

clean: ## Remove .venv, out/ and caches.
	rm -rf .venv out .mypy_cache .ruff_cache .pytest_cache .import_linter_cache
