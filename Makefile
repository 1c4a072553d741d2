# Every target sets up .venv by itself, once, from pyproject.toml. Needs Python 3.11+, a C++ compiler and make.
PYTHON ?= python3
BIN := .venv/bin
READY := .venv/.ready
TRAIN_READY := .venv/.train-ready

.DEFAULT_GOAL := help
.PHONY: help setup drive test check format evaluate train train-smoke clean

help: ## Show this list.
	@awk -F ':.*## ' '/^[a-z-]+:.*## /{printf "  make %-12s %s\n", $$1, $$2}' $(MAKEFILE_LIST)

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

test: $(READY) ## Run all tests but those of the training.
	$(BIN)/python -m pytest -m "not train"

check: $(READY) ## Lint, types, import layers.
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports

evaluate: $(READY) ## Measure the translation: benchmark, false activations, attacks, confidence (some 15 minutes).
	$(BIN)/wayword eval translation benchmark
	$(BIN)/wayword eval activation
	-$(BIN)/wayword eval attack
	$(BIN)/wayword eval confidence

$(TRAIN_READY): $(READY)
	@echo "Setting up the extra train: PyTorch and what goes with it ..."
	$(BIN)/pip install --quiet --disable-pip-version-check --editable '.[dev,train]'
	@touch $@

train: $(TRAIN_READY) ## Fine-tune the translation model (hours; call again to go on).
	$(BIN)/wayword train

train-smoke: $(TRAIN_READY) ## Prove the fine-tuning recipe end to end on a small slice (minutes).
	$(BIN)/python -m pytest -m train

format: $(READY) ## Format the code and mend what the linter can mend.
	$(BIN)/ruff format .
	$(BIN)/ruff check --fix .

clean: ## Remove .venv, out/ and caches.
	rm -rf .venv out .mypy_cache .ruff_cache .pytest_cache .import_linter_cache
