# What a clone can do. Every target sets up what it needs, once: a stamp in .venv is older than
# pyproject.toml or missing only when there is something to set up.

.NOTPARALLEL:
.PHONY: demo test lint clean

READY := .venv/.carom

demo: $(READY)-run
	.venv/bin/carom run billiards --record out/billiards.rrd --film out/billiards.mp4 --picture out/billiards.png

# Kernels are compiled before the workers start, so that two workers never compile the same one.
test: $(READY)-test
	.venv/bin/carom warm
	.venv/bin/python -m pytest -n 2 $(PYTEST_ARGUMENTS)

lint: $(READY)-dev
	.venv/bin/ruff check .
	.venv/bin/ruff format --check .
	.venv/bin/mypy

clean:
	rm -rf .venv out

$(READY)-%: pyproject.toml .ci/setup
	.ci/setup $*
