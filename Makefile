# What a clone can do. Every target sets up what it needs, once: a stamp in .venv is missing or older than
# pyproject.toml only when there is something to set up. It carries the folder's checksum, since a .venv cannot be moved.

.NOTPARALLEL:
.PHONY: demo test lint docs clean

# Python keeps what it has compiled, whatever the environment says: tests start hundreds of processes.
export PYTHONDONTWRITEBYTECODE :=

READY := .venv/.carom-$(shell pwd -P | cksum | cut -d' ' -f1)

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

# Strictly: a link, an anchor or a picture that is not there fails. The theme tells of its successor; its versions are held.
docs: $(READY)-docs
	NO_MKDOCS_2_WARNING=1 .venv/bin/mkdocs build --quiet

clean:
	rm -rf .venv out

$(READY)-%: pyproject.toml .ci/setup
	.ci/setup $*
	@touch $@
